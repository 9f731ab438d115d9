// Sphere against sphere: the exact decision and the correctly rounded contact.
//
//   d = c2 - c1     D = |d|^2     s = sqrt(D)     n = d / s, or (1, 0, 0) where D = 0
//   hit             D <= (r1 + r2 + alarm)^2
//   point k         c_k + sign_k r_k n                sphere_sphere_numbers.hpp, sign_of
//   value           s - (r1 + r2 + contact)
//
// A decision is asked of stages, each where those before leave it open:
//   filter          plain arithmetic and a bound on its error        contact/plain_decision.hpp
//   ScaledPair      scaled, and D - t^2 without cancellation         sphere_sphere_scaled.hpp
//   decide_exactly  integers on a common grid                        ExactPair below, exact.hpp
// The ten numbers of a hit are asked of the next. Each computes with a bound on its error and keeps a number where
// every real number within the bound rounds to the same double; the last has no error.
//   by_one_vector   all of a pair or none, where there are AVX2 and FMA     sphere_sphere_one_vector.hpp
//   round           each number in double-double arithmetic                 sphere_sphere_double_double.hpp
//   round_scaled    the same, scaled, and values near touching              sphere_sphere_scaled.hpp
//   round_exactly   each number that is left, in integers                   ExactPair below, exact.hpp
// A call is compute_sphere_sphere, contact_of_pair, and the stages. docs/specification.md, "Correct rounding", says
// why.
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
#include "kernel/sphere_sphere_scaled.hpp"
#include "kernel/sum_of_two.hpp"

namespace contact::inline CONTACT_ABI {
namespace {

using kernel::filter;
using kernel::Filtered;
using kernel::FixedInteger;
using kernel::Grid;
using kernel::Integer;
using kernel::sign_of;
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

  /// center + sign radius n on one axis, for a sign of +-1.
  [[nodiscard]] double point(std::size_t sphere, std::size_t axis, double sign) const {
    const Number& c = center_[sphere][axis];
    const Number signed_radius = sign < 0 ? -radius_[sphere] : radius_[sphere];
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
  if (alarm == std::numeric_limits<double>::infinity()) return true;
  return exactly(a, b, {alarm, 0}, [](const auto& pair) { return pair.hit(); });
}

#if defined(__x86_64__) && !defined(__FMA__)
template <class Work>
[[gnu::noinline, gnu::flatten, gnu::target("fma")]] auto by_fma(const Work& work) {
  return work();
}
#endif
template <class Work>
[[gnu::noinline, gnu::flatten]] auto portably(const Work& work) {
  return work();
}
/// What work() returns, computed where std::fma is an instruction if the processor has one: the same bits. Never
/// inlined: what RoundToNearest sets must be set before anything is computed.
template <class Work>
[[gnu::always_inline]] inline auto with_fma(const Work& work) {
#if defined(__x86_64__) && !defined(__FMA__)
  if (__builtin_cpu_supports("fma")) return by_fma(work);
#endif
  return portably(work);
}

/// Decides what the filter leaves open.
[[gnu::noinline]] bool decide_open(const Ball& a, const Ball& b, double alarm) {
  const std::optional<bool> scaled = with_fma([&] {
    const auto pair = kernel::ScaledPair::of(a, b);
    return pair ? pair->hit(alarm) : std::nullopt;
  });
  return scaled ? *scaled : decide_exactly(a, b, alarm);
}

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
        contact.point1[axis] = pair.point(0, axis, sign_of(points.first, 1));
      if (numbers >> (2 * kernel::kPointNumber + axis) & 1)
        contact.point2[axis] = pair.point(1, axis, sign_of(points.second, -1));
    }
    if (numbers >> kernel::kValueNumber & 1) contact.value = pair.value();
  });
}

/// Settles numbers of a hit whose bits are set, whatever their size; what is left, as bits.
unsigned round_scaled(const kernel::ScaledPair& pair, const Ball& a, const Ball& b, double contact_distance,
                      ContactPoints points, unsigned numbers, Contact& contact) {
  unsigned open = numbers;
  const auto take = [&](unsigned bit, double& to, const auto& ask) {
    if ((numbers >> bit & 1) == 0) return;
    if (const std::optional<double> certain = ask()) {
      to = *certain;
      open &= ~(1U << bit);
    }
  };
  const double r1 = sign_of(points.first, 1) * a.radius;
  const double r2 = sign_of(points.second, -1) * b.radius;
  for (unsigned axis = 0; axis < 3; ++axis) {
    take(axis, contact.normal[axis], [&] { return pair.normal(axis); });
    take(kernel::kPointNumber + axis, contact.point1[axis], [&] { return pair.point(a.center[axis], r1, axis); });
    take(2 * kernel::kPointNumber + axis, contact.point2[axis], [&] { return pair.point(b.center[axis], r2, axis); });
  }
  take(kernel::kValueNumber, contact.value, [&] { return pair.value(contact_distance); });
  return open;
}
[[gnu::noinline]] unsigned round_scaled(const Ball& a, const Ball& b, double contact_distance, ContactPoints points,
                                        unsigned numbers, Contact& contact) {
  return with_fma([&] {
    const auto pair = kernel::ScaledPair::of(a, b);
    return pair ? round_scaled(*pair, a, b, contact_distance, points, numbers, contact) : numbers;
  });
}

/// Settles the numbers of a hit whose bits are set, and perhaps others: in double-double arithmetic where their
/// rounding is certain, else exactly.
[[gnu::always_inline]] inline void round(const Ball& a, const Ball& b, double contact_distance, ContactPoints points,
                                         unsigned numbers, Contact& contact) {
  contact.degenerate = false;
  unsigned open = kernel::kAllNumbers;
  if (const auto pair = kernel::DoubleDoublePair::of(a, b, {0, contact_distance})) {
    const auto take = [&open](const kernel::Approximation& number, double& to, unsigned bit) {
      if (const auto certain = number.rounded()) {
        to = *certain;
        open &= ~(1U << bit);
      }
    };
    const double r1 = sign_of(points.first, 1) * a.radius;
    const double r2 = sign_of(points.second, -1) * b.radius;
    for (unsigned axis = 0; axis < 3; ++axis) {
      take(pair->normal(axis), contact.normal[axis], axis);
      take(pair->point(a.center[axis], r1, axis), contact.point1[axis], kernel::kPointNumber + axis);
      take(pair->point(b.center[axis], r2, axis), contact.point2[axis], 2 * kernel::kPointNumber + axis);
    }
    take(pair->value(), contact.value, kernel::kValueNumber);
  }
  if ((open & numbers) != 0) open = round_scaled(a, b, contact_distance, points, open & numbers, contact);
  if (points.first == PointOn::center) put_at_center(a.center, contact.point1);
  if (points.second == PointOn::center) put_at_center(b.center, contact.point2);
  if ((open & numbers) != 0) round_exactly(a, b, contact_distance, points, open & numbers, contact);
}

/// The contact of a pair that the filter leaves open and of which a number is far from 1: a miss, a hit whose contact
/// is settled, or neither.
[[gnu::noinline]] Filtered contact_scaled(const Ball& a, const Ball& b, Distances distances, ContactPoints points,
                                          Contact& contact) {
  return with_fma([&] {
    const auto pair = kernel::ScaledPair::of(a, b);
    const std::optional<bool> hit = pair ? pair->hit(distances.alarm) : std::nullopt;
    if (!hit) return Filtered::undecided;
    if (!*hit) return Filtered::miss;
    contact.degenerate = false;
    const unsigned open = round_scaled(*pair, a, b, distances.contact, points, kernel::kAllNumbers, contact);
    return open == 0 ? Filtered::hit : Filtered::undecided;
  });
}

/// The contact of a pair, or false.
[[gnu::always_inline]] inline bool contact_of(const Ball& a, const Ball& b, Distances distances, ContactPoints points,
                                              Contact& contact) {
  const Filtered filtered = plain_decision::filter_balls(a, b, distances.alarm);
  if (filtered == Filtered::miss) return false;
  if (filtered == Filtered::undecided) {
    if (!kernel::ball_in_range(a) || !kernel::ball_in_range(b)) {
      const Filtered scaled = contact_scaled(a, b, distances, points, contact);
      if (scaled != Filtered::undecided) return scaled == Filtered::hit;
    }
    if (!decide_open(a, b, distances.alarm)) return false;
  }
  round(a, b, distances.contact, points, kernel::kAllNumbers, contact);
  return true;
}

/// The one axis along which centres lie, or -1.
int axis_of_both(const Ball& a, const Ball& b) {
  int axis = -1;
  for (int k = 0; k < 3; ++k) {
    if (a.center[k] == b.center[k]) continue;
    if (axis >= 0) return -1;
    axis = k;
  }
  return axis;
}

/// The distance of the surfaces of balls along an axis less another one, rounded once.
double beyond(const Ball& a, const Ball& b, int axis, double distance) {
  const double sign = a.center[axis] < b.center[axis] ? 1 : -1;
  return kernel::one_number::rounded({sign * b.center[axis], -sign * a.center[axis], -a.radius, -b.radius, -distance});
}

/// Whether they are within the alarm distance. An infinite one is no term of a sum.
bool is_within(const Ball& a, const Ball& b, int axis, double alarm) {
  return alarm == std::numeric_limits<double>::infinity() || beyond(a, b, axis, alarm) <= 0;
}

// Behind a call that is not inlined, as with_fma is.
[[gnu::noinline]] bool decide(const Ball& a, const Ball& b, double alarm) {
  const Filtered filtered = plain_decision::filter_balls(a, b, alarm);
  if (filtered != Filtered::undecided) return filtered == Filtered::hit;
  const int axis = axis_of_both(a, b);
  return axis >= 0 ? is_within(a, b, axis, alarm) : decide_open(a, b, alarm);
}

#if CONTACT_HAS_ONE_VECTOR
// Between these no square of the vector leaves the normal range in a way that matters.
constexpr double kLeastSquare = kernel::ForDouble::kLeast;
constexpr double kMostSquare = kernel::ForDouble::kMost;

/// A miss, a hit whose contact is settled, or neither.
[[gnu::noinline, gnu::target("avx2,fma")]] Filtered by_one_vector(const Ball& a, const Ball& b, Distances distances,
                                                                  ContactPoints points, Contact& contact) {
  const double D = squared_distance(a, b);
  const Filtered filtered = filter(a, b, D, distances.alarm);
  if (filtered != Filtered::hit) return filtered;
  const double r1 = sign_of(points.first, 1) * a.radius;
  const double r2 = sign_of(points.second, -1) * b.radius;
  const bool settled = D > kLeastSquare && D < kMostSquare &&
                       kernel::one_vector::contact_of_hit(a, b, D, distances.contact, r1, r2, contact);
  return settled ? Filtered::hit : Filtered::undecided;
}
#endif

/// Along an axis every number is a sum of numbers of the question. False for a miss.
bool contact_along_axis(const Ball& a, const Ball& b, int axis, Distances distances, ContactPoints points,
                        Contact& contact) {
  const double sign = a.center[axis] < b.center[axis] ? 1 : -1;
  if (!is_within(a, b, axis, distances.alarm)) return false;
  contact.degenerate = false;
  contact.unique = true;
  const auto on = [&](const Ball& ball, double signed_radius, Vector3& point) {
    for (int k = 0; k < 3; ++k) {
      const double x = k == axis ? ball.center[k] + sign * signed_radius : ball.center[k];
      point[k] = x == 0 ? 0 : x;  // every zero is +0
    }
  };
  for (int k = 0; k < 3; ++k) contact.normal[k] = k == axis ? sign : 0;
  on(a, sign_of(points.first, 1) * a.radius, contact.point1);
  on(b, sign_of(points.second, -1) * b.radius, contact.point2);
  contact.value = beyond(a, b, axis, distances.contact);
  return true;
}

bool contact_of_pair(const Ball& a, const Ball& b, Distances distances, ContactPoints points, Contact& contact) {
#if CONTACT_HAS_ONE_VECTOR
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    const Filtered said = by_one_vector(a, b, distances, points, contact);
    if (said != Filtered::undecided) return said == Filtered::hit;
  }
#endif
  if (const int axis = axis_of_both(a, b); axis >= 0) return contact_along_axis(a, b, axis, distances, points, contact);
  return with_fma([&] { return contact_of(a, b, distances, points, contact); });
}

}  // namespace

bool out_of_line::test_sphere_sphere(const Ball& a, const Ball& b, double alarm) {
  const kernel::RoundToNearest environment;
  return decide(a, b, alarm);
}

std::optional<Contact> out_of_line::compute_sphere_sphere(const Ball& a, const Ball& b, Distances distances,
                                                          ContactPoints points) {
  const kernel::RoundToNearest environment;
  std::optional<Contact> contact(std::in_place, kernel::Unset());
  if (!contact_of_pair(a, b, distances, points, *contact)) contact.reset();
  return contact;
}

}  // namespace contact::inline CONTACT_ABI

bool contact::kernel::decide_balls(const Ball& a, const Ball& b, double alarm) { return contact::decide(a, b, alarm); }
bool contact::kernel::contact_of_balls(const Ball& a, const Ball& b, Distances distances, ContactPoints points,
                                       Contact& contact) {
  return contact::contact_of_pair(a, b, distances, points, contact);
}
void contact::kernel::round_numbers(const Ball& a, const Ball& b, double contact_distance, ContactPoints points,
                                    unsigned numbers, Contact& contact) {
  round(a, b, contact_distance, points, numbers, contact);
}
