// Cube against cube (axis-aligned boxes): the exact decision.
#include "contact/cube_cube.hpp"

#include <cmath>

#include "contact/exact_sum.hpp"
#include "contact/pair_functions.hpp"
#include "kernel/floating_point_environment.hpp"

namespace contact::inline CONTACT_ABI {
namespace {

// Below this magnitude a flushed subnormal could matter; above it every rounding mode is monotone and keeps what it can
// represent, so a computed sum beside x lies on the same side of x as the real sum, or is equal to it.
constexpr double kLeast = 0x1p-900;

/// low <= high + alarm, exactly.
bool within(double low, double high, double alarm) {
  const double sum = high + alarm;
  if (std::abs(sum) > kLeast) {
    if (low < sum) return true;
    if (low > sum) return false;
  }
  return sign_of_sum({low, -high, -alarm}) <= 0;
}

// Not inlined: what RoundToNearest sets must be set before anything is computed.
[[gnu::noinline]] bool decide(const Box& a, const Box& b, double alarm) {
  for (int axis = 0; axis < 3; ++axis)
    if (!within(a.min[axis], b.max[axis], alarm) || !within(b.min[axis], a.max[axis], alarm)) return false;
  return true;
}

}  // namespace

bool out_of_line::test_cube_cube(const Box& a, const Box& b, double alarm) {
  const kernel::RoundToNearest environment;
  return decide(a, b, alarm);
}

bool test_cube_cube(const Box& a, const Box& b, double alarm) { return out_of_line::test_cube_cube(a, b, alarm); }

bool is_hit(const Boxes& boxes, Distances distances) { return test_cube_cube(boxes.a, boxes.b, distances.alarm); }
std::optional<Contact> contact_of(const Boxes& /*boxes*/, Distances /*distances*/, ContactPoints /*points*/) {
  return std::nullopt;
}

}  // namespace contact::inline CONTACT_ABI
