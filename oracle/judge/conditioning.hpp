// What the last bit of a question's numbers would have done to its answer: docs/specification.md#conditioning.
#pragma once

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "oracle/judge/judge.hpp"

namespace contact::oracle {

/// How much the right answer changes where each number of the question moves to a neighbour in the engine's scalar: by
/// field, the sum over the numbers of the larger change, rounded down; a normal in radians, else the coordinate that
/// changes most. The neighbours' answers are the oracle's, so it holds where a derivative does not exist.
struct LastBit {
  std::array<double, kFields.size()> effect{};

  [[nodiscard]] double at(Field field) const { return effect[static_cast<std::size_t>(field)]; }
};
/// Domain: a hit with numbers. Nothing changes where the cores meet, or where more points than one are nearest: there
/// the judge knows every right answer.
[[nodiscard]] LastBit last_bit(const Query& query, const Declaration& declared);

/// Of each number of a question, in their order, whether its neighbours in a scalar surely have the same answer; nothing where none
/// is known to.
///   S is a subset of the vertices of A and B whose nearest points, or whose one shortest way out, are those of all; the
/// others lie behind S along the normal n, and do so after their last bit moved them. What is added to S then reaches no
/// farther along n, so that A and B do not come nearer or get deeper along n; and it only makes A and B larger, so that
/// they do not get farther apart, or less deep along any other way.
/// Most vertices of a hull are of this kind, and the oracle need not be asked for them.
/// Domain: nearest surface points, or their middle.
[[nodiscard]] std::vector<bool> numbers_without_effect(const Query& query, Scalar scalar);

/// Whether some question whose numbers are all neighbours of this one's has the other decision: those are taken that
/// move the distance most, one by one for a pair without a distance.
[[nodiscard]] bool last_bit_decides(const Query& query, const Truth& truth, const Declaration& declared);

/// How far the rounding of an orientation, to a unit quaternion or a matrix of the scalar, moves any point of a rotated
/// box at most: so many u = 2^-p times the distance of a corner from the centre.
/// A unit quaternion q = (r, w): the sum of squares is off by 4u of itself, its root by 2u + u, the quotient by u more.
/// So each component is off by at most 4u of itself, and all four by a vector d with |d| <= 4u. The engine makes
/// R = 1 + 2 w [r] + 2 [r]^2 of it, off by 2 dw [r] + 2 w [dr] + 2 ([dr][r] + [r][dr]), of norm
/// <= 2 (|dw||r| + |w||dr|) + 4 |dr||r| <= 2 |d| + 4 |d| = 24u. It rounds the entries 1 - 2 (y^2 + z^2) by at most
/// 4u + u, as y^2 + z^2 <= 1, and 2 (x y - w z) by 2u, as |x y| + |w z| <= 1/2: a matrix of norm
/// <= sqrt(3 * 25 + 6 * 4) u < 10u. Together < 34u.
/// A matrix: each entry is a sum of products over |q|^2, off by 4u |q|^2 in the sum, 4u of itself by |q|^2 and u by the
/// quotient: <= 9u, a matrix of norm <= 27u.
/// The larger of the two, rounded up for what is of second order in u and for the length |v| that is rounded here.
inline constexpr double kOrientationRoundings = 40;
[[nodiscard]] double orientation_rounding(const Obb& box, Scalar scalar);

/// Whether the rounding of orientations that is declared may turn a wrong decision: it moves two shapes, and so their distance or depth, by no more than the sum of both.
[[nodiscard]] bool rounding_decides(const Query& query, const Truth& truth, const Declaration& declared);

/// What is known so far of the last bits of one question: many engines are judged on it, and the neighbours' answers take long. One thread's at
/// a time.
struct KnownLastBits;
using LastBits = std::vector<std::pair<Declaration, std::shared_ptr<KnownLastBits>>>;

/// Marks what is wrong in a verdict and no worse than the inputs' last bit, or than the rounding of an orientation.
void mark_last_bit(const Query& query, const Truth& truth, const Declaration& declared, Verdict& verdict,
                   LastBits& known);

}  // namespace contact::oracle
