// The exact numbers of a truth, from the nearest points of two cores, or from three gaps.
#include "oracle/truth/exact_truth.hpp"

#include <algorithm>
#include <cstddef>

#include "oracle/truth/default_environment.hpp"

namespace contact::oracle {
namespace {

Rational square(const Rational& x) { return x * x; }
std::size_t index(int i) { return static_cast<std::size_t>(i); }
Side side_of(const Rational& off) { return static_cast<Side>(static_cast<int>(CGAL::sign(off))); }

/// +1 where the contact point lies from the core along the normal, -1 against it, 0 on the core.
Rational direction(int shape, PointOn on) {
  if (on == PointOn::center) return Rational(0);
  return (shape == 0) == (on == PointOn::nearest_surface) ? Rational(1) : Rational(-1);
}

}  // namespace

DistanceTruth::DistanceTruth(Cores cores, Distances distances)
    : cores_(std::move(cores)), contact_(distances.contact), distance2_(0) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    delta_[axis] = cores_.nearest[1][axis] - cores_.nearest[0][axis];
    distance2_ += square(delta_[axis]);
  }
  radii_ = cores_.radius[0] + cores_.radius[1];
  reach_ = Rational(distances.alarm) + radii_;
}

// Both sides of sqrt(D) <= reach are >= 0, so their squares stand in the same order.
Side DistanceTruth::at_alarm() const { return side_of(distance2_ - square(reach_)); }
Side DistanceTruth::at_zero() const { return side_of(distance2_ - square(radii_)); }

Exact DistanceTruth::normal(int axis) const {
  if (degenerate()) return Rational(axis == 0 ? 1 : 0);
  return {Rational(0), delta_[index(axis)] / distance2_, distance2_};
}

Exact DistanceTruth::point(int shape, int axis, PointOn on) const {
  if (degenerate()) return point_for(shape, axis, on, Vector3::UnitX());
  const Rational along = direction(shape, on) * cores_.radius[index(shape)] * delta_[index(axis)] / distance2_;
  return {cores_.nearest[index(shape)][index(axis)], along, distance2_};
}

Rational DistanceTruth::point_for(int shape, int axis, PointOn on, const Vector3& normal) const {
  const DefaultEnvironment environment;
  return cores_.nearest[index(shape)][index(axis)] +
         direction(shape, on) * cores_.radius[index(shape)] * Rational(normal[axis]);
}

Exact DistanceTruth::midpoint(int axis) const {
  const Rational sum = cores_.nearest[0][index(axis)] + cores_.nearest[1][index(axis)];
  const Rational radii = cores_.radius[0] - cores_.radius[1];
  if (degenerate()) return (sum + radii * Rational(axis == 0 ? 1 : 0)) / Rational(2);
  return {sum / Rational(2), radii * delta_[index(axis)] / distance2_ / Rational(2), distance2_};
}

Exact DistanceTruth::value(bool less_contact) const {
  return {less_contact ? -radii_ - contact_ : -radii_, Rational(1), distance2_};
}

Exact DistanceTruth::margin(Scalar scalar) const {
  return Exact(-reach_, Rational(1), distance2_).scaled(Rational(1) / ulp(reach_, scalar));
}

Exact DistanceTruth::value_scale() const {
  const Rational larger = std::max(radii_, contact_);
  const Exact distance(Rational(0), Rational(1), distance2_);
  return distance.compare(larger) == CGAL::LARGER ? distance : Exact(larger);
}

Rational DistanceTruth::point_scale(int shape) const {
  Rational scale = cores_.radius[index(shape)];
  for (const Rational& c : cores_.nearest[index(shape)]) scale = std::max(scale, Rational(CGAL::abs(c)));
  return scale;
}

const Rational& GapTruth::widest_gap() const { return *std::max_element(gap_.begin(), gap_.end()); }
Side GapTruth::at_alarm() const { return side_of(widest_gap() - alarm_); }
Side GapTruth::at_zero() const { return side_of(widest_gap()); }

}  // namespace contact::oracle
