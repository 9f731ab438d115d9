// The exact numbers that a golden file records of two spheres, two boxes, and a sphere and a box: integers on a grid. The nearest points of other
// pairs are not.
#include "oracle/truth/quick_witness.hpp"

#include "oracle/truth/clamped.hpp"
#include "oracle/truth/default_environment.hpp"
#include "oracle/truth/grid.hpp"

namespace contact::oracle {
namespace {

/// D: of most questions in two words, of all others in GMP's integers.
std::string squared_distance(const Vector3& a, const Vector3& b) {
  const OnWords<6> words({a[0], a[1], a[2], b[0], b[1], b[2]});
  if (words.fit()) {
    TwoWords sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) sum += oracle::square(words[axis] - words[axis + 3]);  // of 62 bits
    return sum == 0 ? "0x0p0" : text_of(sum, 2 * words.unit());
  }
  Scratch& s = scratch();
  const Grid centers{std::min({last_exponent(a), last_exponent(b), 0})};
  mpz_set_ui(s.sum, 0);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    centers.place(s.x, a[axis]);
    centers.place(s.y, b[axis]);
    mpz_sub(s.x, s.x, s.y);
    mpz_addmul(s.sum, s.x, s.x);
  }
  return text_of(s.sum, 2 * centers.unit);
}

/// The sum of three lengths in the same way.
std::string reach(double alarm, double radius1, double radius2) {
  const OnWords<3> words({alarm, radius1, radius2});
  if (words.fit()) {
    const std::int64_t sum = words[0] + words[1] + words[2];  // 63 bits
    return text_of(static_cast<TwoWords>(static_cast<std::uint64_t>(sum)), words.unit());
  }
  Scratch& s = scratch();
  const Grid lengths{std::min({last_exponent(alarm), last_exponent(radius1), last_exponent(radius2), 0})};
  lengths.place(s.sum, alarm);
  for (const double radius : {radius1, radius2}) {
    lengths.place(s.x, radius);
    mpz_add(s.sum, s.sum, s.x);
  }
  return text_of(s.sum, lengths.unit);
}

Witness texts(const Balls& balls, Distances distances) {
  Witness w;
  w.distance2 = squared_distance(balls.a.center, balls.b.center);
  w.reach = reach(distances.alarm, balls.a.radius, balls.b.radius);
  return w;
}

Witness texts(const Boxes& boxes, Distances /*distances*/) {
  Scratch& s = scratch();
  Witness w;
  const auto& [a, b] = boxes;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    const Grid grid{std::min({last_exponent(a.min[axis]), last_exponent(a.max[axis]), last_exponent(b.min[axis]),
                              last_exponent(b.max[axis]), 0})};
    grid.place(s.x, a.min[axis]);
    grid.place(s.y, b.max[axis]);
    mpz_sub(s.sum, s.x, s.y);
    grid.place(s.x, b.min[axis]);
    grid.place(s.y, a.max[axis]);
    mpz_sub(s.x, s.x, s.y);
    w.gap[i] = text_of(mpz_cmp(s.sum, s.x) < 0 ? s.x : s.sum, grid.unit);
  }
  return w;
}

/// Those of the sphere and a point of the box, the least that there are.
Witness texts(const BallAndBox& shapes, Distances distances) { return texts(at_clamped(shapes), distances); }

template <class A, class B>
std::optional<Witness> texts(const Two<A, B>& /*shapes*/, Distances /*distances*/) {
  return std::nullopt;
}

}  // namespace

std::optional<Witness> quick_witness(const Query& query) {
  const DefaultEnvironment environment;
  return std::visit([&](const auto& shapes) -> std::optional<Witness> { return texts(shapes, query.distances); },
                    query.shapes);
}

}  // namespace contact::oracle
