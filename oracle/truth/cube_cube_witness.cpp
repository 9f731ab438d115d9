// The witness of two axis-aligned boxes, in integers.
#include "oracle/truth/grid.hpp"

namespace contact::oracle {

Witness quick_witness(const Boxes& boxes, Distances /*distances*/) {
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

}  // namespace contact::oracle
