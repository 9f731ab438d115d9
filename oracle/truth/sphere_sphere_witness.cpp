// The witness of two spheres, in integers.
#include "oracle/truth/grid.hpp"

namespace contact::oracle {

Witness quick_witness(const Balls& balls, Distances distances) {
  Scratch& s = scratch();
  Witness w;
  const auto& [a, b] = balls;
  const Grid centers{std::min({last_exponent(a.center), last_exponent(b.center), 0})};
  mpz_set_ui(s.sum, 0);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    centers.place(s.x, a.center[axis]);
    centers.place(s.y, b.center[axis]);
    mpz_sub(s.x, s.x, s.y);
    mpz_addmul(s.sum, s.x, s.x);
  }
  w.distance2 = text_of(s.sum, 2 * centers.unit);
  const Grid lengths{std::min({last_exponent(a.radius), last_exponent(b.radius), last_exponent(distances.alarm), 0})};
  lengths.place(s.sum, distances.alarm);
  for (const double radius : {a.radius, b.radius}) {
    lengths.place(s.x, radius);
    mpz_add(s.sum, s.sum, s.x);
  }
  w.reach = text_of(s.sum, lengths.unit);
  return w;
}

}  // namespace contact::oracle
