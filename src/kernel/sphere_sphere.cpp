// Sphere against sphere: the exact decision and the correctly rounded contact.
#include "contact/sphere_sphere.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "kernel/exact.hpp"
#include "kernel/floating_point_environment.hpp"
#include "kernel/sphere_sphere_double_double.hpp"
#include "kernel/sphere_sphere_filter.hpp"
#include "kernel/sphere_sphere_numbers.hpp"
#include "kernel/sphere_sphere_one_vector.hpp"

namespace contact {
namespace {

using kernel::filter;
using kernel::Filtered;
using kernel::FixedInteger;
using kernel::Grid;
using kernel::Integer;
using kernel::squared_distance;

Integer on_grid(const Grid& grid, double x, Integer /*as*/) { return grid(x); }
FixedInteger on_grid(const Grid& grid, double x, FixedInteger /*as*/) { return grid.fixed(x); }

/// The pair as integers on one grid: c, r and the distances over 2^exponent, D over its square.
template <class Number>
class ExactPair {
 public:
  ExactPair(const Grid& grid, const Ball& a, const Ball& b, Distances distances)
      : exponent_(grid.exponent()),
        radius_{at(grid, a.radius), at(grid, b.radius)},
        alarm_(at(grid, distances.alarm)),
        contact_(at(grid, distances.contact)) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      center_[0][i] = at(grid, a.center[axis]);
      center_[1][i] = at(grid, b.center[axis]);
      delta_[i] = center_[1][i] - center_[0][i];
      D_ += delta_[i] * delta_[i];
    }
  }

  [[nodiscard]] bool hit() const {
    const Number reach = alarm_ + radius_[0] + radius_[1];
    return D_ <= reach * reach;
  }

  [[nodiscard]] bool coincident() const { return D_.is_zero(); }

  /// n = delta / sqrt(D), or (1,0,0) where D = 0.
  [[nodiscard]] double normal(std::size_t axis) const {
    if (coincident()) return axis == 0 ? 1.0 : 0.0;
    return kernel::round_sum(Number(), delta_[axis], D_, 0);
  }

  /// center + sign radius n on one axis.
  [[nodiscard]] double point(std::size_t sphere, std::size_t axis, bool negative) const {
    const Number& c = center_[sphere][axis];
    const Number signed_radius = negative ? -radius_[sphere] : radius_[sphere];
    if (coincident()) return kernel::round_integer(axis == 0 ? c + signed_radius : c, exponent_);
    return kernel::round_sum(c, signed_radius * delta_[axis], D_, exponent_);
  }

  [[nodiscard]] double value() const {
    const Number t = radius_[0] + radius_[1] + contact_;
    return coincident() ? kernel::round_integer(-t, exponent_) : kernel::round_root_less(D_, t, exponent_);
  }

 private:
  static Number at(const Grid& grid, double x) { return on_grid(grid, x, Number()); }

  int exponent_;
  std::array<std::array<Number, 3>, 2> center_;
  std::array<Number, 2> radius_;
  Number alarm_;
  Number contact_;
  std::array<Number, 3> delta_;
  Number D_;
};

/// Asks of the pair in the integers that are long enough for it.
template <class Ask>
auto exactly(const Ball& a, const Ball& b, Distances distances, const Ask& ask) {
  const Grid grid{a.center[0], a.center[1], a.center[2], a.radius,        b.center[0],
                  b.center[1], b.center[2], b.radius,    distances.alarm, distances.contact};
  if (grid.is_fixed()) return ask(ExactPair<FixedInteger>(grid, a, b, distances));
  return ask(ExactPair<Integer>(grid, a, b, distances));
}

[[gnu::noinline]] bool decide_exactly(const Ball& a, const Ball& b, double alarm) {
  return exactly(a, b, {alarm, 0}, [](const auto& pair) { return pair.hit(); });
}

/// Whether a point moves against the normal.
constexpr bool is_negative(std::size_t sphere, PointOn on) { return (on == PointOn::nearest_surface) != (sphere == 0); }

/// A point at the centre takes no arithmetic; -0 is +0, by the bits, since a sum may flush a subnormal number.
void put_at_center(const Vector3& center, Vector3& point) {
  for (int axis = 0; axis < 3; ++axis)
    point[axis] = std::bit_cast<std::uint64_t>(center[axis]) << 1 == 0 ? 0.0 : center[axis];
}

/// Settles the numbers of a hit whose bits are set, but for points at a centre, and whether it is degenerate. None
/// depends on the alarm distance.
[[gnu::noinline]] void round_exactly(const Ball& a, const Ball& b, double contact_distance, ContactPoints points,
                                     unsigned numbers, Contact& contact) {
  if (points.first == PointOn::center) numbers &= ~(7U << kernel::kPointNumber);
  if (points.second == PointOn::center) numbers &= ~(7U << (2 * kernel::kPointNumber));
  exactly(a, b, {0, contact_distance}, [&](const auto& pair) {
    contact.degenerate = pair.coincident();
    for (unsigned axis = 0; axis < 3; ++axis) {
      if (numbers >> axis & 1) contact.normal[axis] = pair.normal(axis);
      if (numbers >> (kernel::kPointNumber + axis) & 1)
        contact.point1[axis] = pair.point(0, axis, is_negative(0, points.first));
      if (numbers >> (2 * kernel::kPointNumber + axis) & 1)
        contact.point2[axis] = pair.point(1, axis, is_negative(1, points.second));
    }
    if (numbers >> kernel::kValueNumber & 1) contact.value = pair.value();
  });
}

/// The numbers of a hit whose rounding is certain in the fast stage; returns the others.
[[gnu::always_inline]] inline unsigned round_quickly(const Ball& a, const Ball& b, double contact_distance,
                                                     ContactPoints points, Contact& contact) {
  contact.degenerate = false;
  const auto fast = kernel::DoubleDoublePair::of(a, b, {0, contact_distance});
  if (!fast) return kernel::kAllNumbers;
  unsigned open = 0;
  const auto take = [&open](const kernel::Approximation& number, double& to, unsigned bit) {
    if (const auto certain = number.rounded())
      to = *certain;
    else
      open |= 1U << bit;
  };
  for (unsigned axis = 0; axis < 3; ++axis) {
    take(fast->normal(axis), contact.normal[axis], axis);
    const double r1 = is_negative(0, points.first) ? -a.radius : a.radius;
    take(fast->point(a.center[axis], r1, axis), contact.point1[axis], kernel::kPointNumber + axis);
    const double r2 = is_negative(1, points.second) ? -b.radius : b.radius;
    take(fast->point(b.center[axis], r2, axis), contact.point2[axis], 2 * kernel::kPointNumber + axis);
  }
  take(fast->value(), contact.value, kernel::kValueNumber);
  return open;
}

/// Settles the numbers of a hit whose bits are set, and perhaps others.
[[gnu::always_inline]] inline void round(const Ball& a, const Ball& b, double contact_distance, ContactPoints points,
                                         unsigned numbers, Contact& contact) {
  const unsigned open = round_quickly(a, b, contact_distance, points, contact) & numbers;
  if (points.first == PointOn::center) put_at_center(a.center, contact.point1);
  if (points.second == PointOn::center) put_at_center(b.center, contact.point2);
  if (open != 0) round_exactly(a, b, contact_distance, points, open, contact);
}

/// The contact of a pair, or false.
[[gnu::always_inline]] inline bool contact_of(const Ball& a, const Ball& b, Distances distances, ContactPoints points,
                                              Contact& contact) {
  const Filtered filtered = filter(a, b, squared_distance(a, b), distances.alarm);
  if (filtered == Filtered::miss) return false;
  if (filtered == Filtered::undecided && !decide_exactly(a, b, distances.alarm)) return false;
  round(a, b, distances.contact, points, kernel::kAllNumbers, contact);
  return true;
}

// Behind calls that are not inlined: what RoundToNearest sets must be set before anything is computed.

[[gnu::noinline]] bool decide(const Ball& a, const Ball& b, double alarm) {
  switch (filter(a, b, squared_distance(a, b), alarm)) {
    case Filtered::hit:
      return true;
    case Filtered::miss:
      return false;
    case Filtered::undecided:
      break;
  }
  return decide_exactly(a, b, alarm);
}

[[gnu::noinline, gnu::flatten]] bool contact_portably(const Ball& a, const Ball& b, Distances distances,
                                                      ContactPoints points, Contact& contact) {
  return contact_of(a, b, distances, points, contact);
}

#if defined(__x86_64__) && !defined(__FMA__)
/// The same bits: std::fma is an instruction here, and a call above.
[[gnu::noinline, gnu::flatten, gnu::target("fma")]] bool contact_by_fma(const Ball& a, const Ball& b,
                                                                        Distances distances, ContactPoints points,
                                                                        Contact& contact) {
  return contact_of(a, b, distances, points, contact);
}
#endif

bool contact_by_any_means(const Ball& a, const Ball& b, Distances distances, ContactPoints points, Contact& contact) {
#if defined(__x86_64__) && !defined(__FMA__)
  if (__builtin_cpu_supports("fma")) return contact_by_fma(a, b, distances, points, contact);
#endif
  return contact_portably(a, b, distances, points, contact);
}

#if CONTACT_HAS_ONE_VECTOR
/// +-1, or 0 for a point at the centre.
constexpr double sign_of(std::size_t sphere, PointOn on) {
  return on == PointOn::center ? 0 : is_negative(sphere, on) ? -1 : 1;
}

/// Settles most pairs, and leaves the others to any means.
[[gnu::noinline, gnu::target("avx2,fma")]] bool contact_by_one_vector(const Ball& a, const Ball& b, Distances distances,
                                                                      ContactPoints points, Contact& contact) {
  const double D = squared_distance(a, b);
  const Filtered filtered = filter(a, b, D, distances.alarm);
  if (filtered == Filtered::miss) return false;
  if (filtered == Filtered::hit && D > kernel::PlainBounds<double>::kLeast &&
      kernel::one_vector::contact_of_hit(a, b, D, distances.contact, sign_of(0, points.first) * a.radius,
                                         sign_of(1, points.second) * b.radius, contact))
    return true;
  return contact_by_any_means(a, b, distances, points, contact);
}
#endif

bool contact_of_pair(const Ball& a, const Ball& b, Distances distances, ContactPoints points, Contact& contact) {
#if CONTACT_HAS_ONE_VECTOR
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    return contact_by_one_vector(a, b, distances, points, contact);
#endif
  return contact_by_any_means(a, b, distances, points, contact);
}

/// A contact whose numbers are to be written: zeros first would cost as much as a miss.
struct Unset {
  operator Contact() const {  // NOLINT(google-explicit-constructor)
    Contact contact;
    contact.degenerate = false;  // a bool may not be copied before it is set
    return contact;
  }
};

}  // namespace

void kernel::round_numbers(const Ball& a, const Ball& b, double contact_distance, ContactPoints points,
                           unsigned numbers, Contact& contact) {
  round(a, b, contact_distance, points, numbers, contact);
}

bool test_sphere_sphere(const Ball& a, const Ball& b, double alarm) {
  const kernel::RoundToNearest environment;
  return decide(a, b, alarm);
}

std::optional<Contact> compute_sphere_sphere(const Ball& a, const Ball& b, Distances distances, ContactPoints points) {
  const kernel::RoundToNearest environment;
  std::optional<Contact> contact(std::in_place, Unset());
  if (!contact_of_pair(a, b, distances, points, *contact)) contact.reset();
  return contact;
}

}  // namespace contact
