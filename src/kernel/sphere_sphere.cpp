// Sphere against sphere: the exact decision and the correctly rounded contact.
#include "contact/sphere_sphere.hpp"

#include <array>
#include <limits>
#include <utility>

#include "kernel/exact.hpp"

namespace contact {
namespace {

using kernel::Grid;
using kernel::Integer;

enum class Filtered { hit, miss, undecided };

// u = 2^-53. To nearest, D and reach^2 are each within 5.0001 u of the reals (three roundings of squares that carry two
// or three more), and the product below adds 1 u: a relative gap of 11.1 u decides. A directed rounding mode doubles
// every one of them, 22.2 u, so 32 u decides in every mode.
constexpr double kGap = 0x1p-48;
// Between these bounds no square, product or sum leaves the normal range in a way that matters: what an underflowing or
// flushed square of a component loses is at most 3 * 2^-1022, below 2^-100 of a D of at least 2^-900.
constexpr double kLeast = 0x1p-900;
constexpr double kMost = 0x1p1000;

Filtered filter(const Ball& a, const Ball& b, double alarm) {
  const double dx = b.center[0] - a.center[0];
  const double dy = b.center[1] - a.center[1];
  const double dz = b.center[2] - a.center[2];
  const double D = dx * dx + dy * dy + dz * dz;
  const double reach = (a.radius + b.radius) + alarm;
  const double reach2 = reach * reach;
  if (!(D > kLeast && D < kMost && reach2 > kLeast && reach2 < kMost))
    return alarm == std::numeric_limits<double>::infinity() ? Filtered::hit : Filtered::undecided;
  if (D < reach2 * (1 - kGap)) return Filtered::hit;
  if (D > reach2 * (1 + kGap)) return Filtered::miss;
  return Filtered::undecided;
}

/// The pair as integers on one grid: c, r and the distances over 2^exponent, D over its square.
struct ExactPair {
  ExactPair(const Ball& a, const Ball& b, Distances distances)
      : grid{a.center[0], a.center[1], a.center[2], a.radius,        b.center[0],
             b.center[1], b.center[2], b.radius,    distances.alarm, distances.contact},
        center{{{grid(a.center[0]), grid(a.center[1]), grid(a.center[2])},
                {grid(b.center[0]), grid(b.center[1]), grid(b.center[2])}}},
        radius{grid(a.radius), grid(b.radius)},
        alarm(grid(distances.alarm)),
        contact(grid(distances.contact)) {
    for (std::size_t i = 0; i < 3; ++i) {
      delta[i] = center[1][i] - center[0][i];
      D += delta[i] * delta[i];
    }
  }

  [[nodiscard]] bool hit() const {
    const Integer reach = alarm + radius[0] + radius[1];
    return D <= reach * reach;
  }

  Grid grid;
  std::array<std::array<Integer, 3>, 2> center;
  std::array<Integer, 2> radius;
  Integer alarm;
  Integer contact;
  std::array<Integer, 3> delta;
  Integer D = 0;
};

/// center + sign radius n on one axis, n = delta / sqrt(D), or (1,0,0) where D = 0.
double round_point(const ExactPair& pair, std::size_t sphere, std::size_t axis, PointOn on) {
  const Integer& c = pair.center[sphere][axis];
  const int exponent = pair.grid.exponent();
  if (on == PointOn::center) return kernel::round_integer(c, exponent);
  const bool along_normal = (on == PointOn::nearest_surface) == (sphere == 0);
  const Integer signed_radius = along_normal ? pair.radius[sphere] : -pair.radius[sphere];
  if (pair.D.is_zero()) return kernel::round_integer(axis == 0 ? c + signed_radius : c, exponent);
  return kernel::round_sum(c, signed_radius * pair.delta[axis], pair.D, exponent);
}

Contact round_contact(const ExactPair& pair, ContactPoints points) {
  Contact contact{};
  contact.degenerate = pair.D.is_zero();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    contact.normal[i] =
        contact.degenerate ? (axis == 0 ? 1.0 : 0.0) : kernel::round_sum(0, pair.delta[axis], pair.D, 0);
    contact.point1[i] = round_point(pair, 0, axis, points.first);
    contact.point2[i] = round_point(pair, 1, axis, points.second);
  }
  const Integer t = pair.radius[0] + pair.radius[1] + pair.contact;
  const int exponent = pair.grid.exponent();
  contact.value =
      contact.degenerate ? kernel::round_integer(-t, exponent) : kernel::round_root_less(pair.D, t, exponent);
  return contact;
}

}  // namespace

bool test_sphere_sphere(const Ball& a, const Ball& b, double alarm) {
  switch (filter(a, b, alarm)) {
    case Filtered::hit:
      return true;
    case Filtered::miss:
      return false;
    case Filtered::undecided:
      break;
  }
  return ExactPair(a, b, {alarm, 0}).hit();
}

std::optional<Contact> compute_sphere_sphere(const Ball& a, const Ball& b, Distances distances, ContactPoints points) {
  const Filtered decision = filter(a, b, distances.alarm);
  if (decision == Filtered::miss) return std::nullopt;
  const ExactPair pair(a, b, distances);
  if (decision == Filtered::undecided && !pair.hit()) return std::nullopt;
  return round_contact(pair, points);
}

}  // namespace contact
