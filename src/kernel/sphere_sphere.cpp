// Sphere against sphere: the exact decision and the correctly rounded contact.
#include "contact/sphere_sphere.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <optional>

#include "kernel/exact.hpp"
#include "kernel/floating_point_environment.hpp"
#include "kernel/sphere_sphere_double_double.hpp"

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
double exact_point(const ExactPair& pair, std::size_t sphere, std::size_t axis, bool negative) {
  const Integer& c = pair.center[sphere][axis];
  const int exponent = pair.grid.exponent();
  const Integer signed_radius = negative ? -pair.radius[sphere] : pair.radius[sphere];
  if (pair.D.is_zero()) return kernel::round_integer(axis == 0 ? c + signed_radius : c, exponent);
  return kernel::round_sum(c, signed_radius * pair.delta[axis], pair.D, exponent);
}

double exact_value(const ExactPair& pair) {
  const Integer t = pair.radius[0] + pair.radius[1] + pair.contact;
  const int exponent = pair.grid.exponent();
  return pair.D.is_zero() ? kernel::round_integer(-t, exponent) : kernel::round_root_less(pair.D, t, exponent);
}

/// A hit's contact: each number from the fast stage where its rounding is certain there, else from exact arithmetic.
class Rounding {
 public:
  /// No number depends on the alarm distance.
  Rounding(const Ball& a, const Ball& b, double contact)
      : balls_{&a, &b}, distances_{0, contact}, fast_(kernel::DoubleDoublePair::of(a, b, distances_)) {}

  [[nodiscard]] Contact contact(ContactPoints points) {
    Contact contact{};
    contact.degenerate = !fast_ && exact().D.is_zero();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<Eigen::Index>(axis);
      contact.normal[i] = normal(axis);
      contact.point1[i] = point(0, axis, points.first);
      contact.point2[i] = point(1, axis, points.second);
    }
    contact.value = value();
    return contact;
  }

 private:
  double normal(std::size_t axis) {
    if (const auto certain = fast_ ? fast_->normal(axis).rounded() : std::nullopt) return *certain;
    if (exact().D.is_zero()) return axis == 0 ? 1.0 : 0.0;
    return kernel::round_sum(0, exact().delta[axis], exact().D, 0);
  }

  double point(std::size_t sphere, std::size_t axis, PointOn on) {
    const double center = balls_[sphere]->center[static_cast<Eigen::Index>(axis)];
    if (on == PointOn::center) return std::bit_cast<std::uint64_t>(center) << 1 == 0 ? 0.0 : center;  // -0 is +0
    const bool negative = (on == PointOn::nearest_surface) != (sphere == 0);
    const double radius = balls_[sphere]->radius;
    if (const auto certain = fast_ ? fast_->point(center, negative ? -radius : radius, axis).rounded() : std::nullopt)
      return *certain;
    return exact_point(exact(), sphere, axis, negative);
  }

  double value() {
    if (const auto certain = fast_ ? fast_->value().rounded() : std::nullopt) return *certain;
    return exact_value(exact());
  }

  const ExactPair& exact() {
    if (!exact_) exact_.emplace(*balls_[0], *balls_[1], distances_);
    return *exact_;
  }

  std::array<const Ball*, 2> balls_;
  Distances distances_;
  std::optional<kernel::DoubleDoublePair> fast_;
  std::optional<ExactPair> exact_;
};

// Behind calls that are not inlined: what RoundToNearest sets must be set before anything is computed.

[[gnu::noinline]] bool decide(const Ball& a, const Ball& b, double alarm) {
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

[[gnu::noinline]] std::optional<Contact> contact_of(const Ball& a, const Ball& b, Distances distances,
                                                    ContactPoints points) {
  if (!decide(a, b, distances.alarm)) return std::nullopt;
  return Rounding(a, b, distances.contact).contact(points);
}

}  // namespace

bool test_sphere_sphere(const Ball& a, const Ball& b, double alarm) {
  const kernel::RoundToNearest environment;
  return decide(a, b, alarm);
}

std::optional<Contact> compute_sphere_sphere(const Ball& a, const Ball& b, Distances distances, ContactPoints points) {
  const kernel::RoundToNearest environment;
  return contact_of(a, b, distances, points);
}

}  // namespace contact
