// Two answers held against each other as an engine's declaration allows: bit for bit, within twice its bounds, or
// within twice its tolerance.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>

#include "oracle/truth/exact_truth.hpp"
#include "proptests/law.hpp"

namespace contact::proptests {

using oracle::Field;
using oracle::Rational;

/// Whether question i may be decided either way: the tolerance says so, or the engine's rounding may, which is not held
/// to correct rounding, and the exact margin is within four times its bound for a value. The laws that compare leave
/// these out; `decision` leaves out what a tolerance allows, and no rounding.
[[nodiscard]] bool undecided(const Case& c, std::size_t i);

/// What differs between the two decisions of questions i and j, which must be the same; nothing where either is
/// undecided.
[[nodiscard]] std::optional<std::string> different_decisions(const Case& c, std::size_t i, std::size_t j);

/// The first number of question j's contact that is not what question i's contact, carried over, makes it. Bit for bit
/// where held to correct rounding, else within twice the larger `allowance`. `exponent` says that lengths were
/// multiplied by 2^exponent, which leaves out numbers that are subnormal before or after.
[[nodiscard]] std::optional<std::string> different_numbers(const Case& c, std::size_t i, std::size_t j,
                                                           const ContactClaim& wanted,
                                                           std::initializer_list<Field> fields, int exponent = 0);

/// Whether another number of a field may be said where question i is asked otherwise: one of many normals, or of many
/// nearest points. Held to correct rounding, that is the reference's, which goes with a change of axes but for a
/// polygon's.
[[nodiscard]] bool may_jump(const Case& c, std::size_t i, Field field);

/// Whether an answer says that the shapes overlap, or have a contact.
[[nodiscard]] bool says_hit(const Claim& claim);

/// Whether question i's truth is degenerate: the centres coincide, or one lies in the other shape.
[[nodiscard]] bool coincident(const Case& c, std::size_t i);

/// Whether the engine may part the shapes of question i along any direction, so that its numbers may jump.
[[nodiscard]] bool parts_anywhere(const Case& c, std::size_t i);

/// How far question i's number may be off the exact one, in each component: by the tolerance, or by the bound.
[[nodiscard]] Rational allowance(const Case& c, std::size_t i, Field field);
/// The same for one point, at the scale of its own shape.
[[nodiscard]] Rational point_allowance(const Case& c, std::size_t i, int shape);

/// A claimed value of question i as a signed distance, without the contact distance.
[[nodiscard]] Rational signed_distance(const Case& c, std::size_t i, double value);
/// The value of question i as the engine gave it, if it is a number.
[[nodiscard]] std::optional<double> finite_value(const Case& c, std::size_t i);
/// How far it may be off. Of shapes inside each other the parts of a value add up to more than the largest of them,
/// which is its scale: half an ulp of the value, which rounding may take, is then more than half an ulp of the scale.
[[nodiscard]] Rational value_error(const Case& c, std::size_t i);

using oracle::point_of;
/// The claimed normal turned to point from the first to the second.
[[nodiscard]] Vector3 first_to_second(const Conventions& conventions, const Vector3& normal);

[[nodiscard]] std::string text(double x);
[[nodiscard]] std::string text(const Vector3& v);

}  // namespace contact::proptests
