// What is exactly true of two spheres.
#include <algorithm>
#include <cstddef>

#include "oracle/truth.hpp"

namespace contact::oracle {
namespace {

Rational square(const Rational& x) { return x * x; }
std::size_t index(int i) { return static_cast<std::size_t>(i); }

/// +1 where the contact point lies from the centre along the normal, -1 against it, 0 at the centre.
Rational side(int sphere, PointOn on) {
  if (on == PointOn::center) return Rational(0);
  return (sphere == 0) == (on == PointOn::nearest_surface) ? Rational(1) : Rational(-1);
}

}  // namespace

SphereTruth::SphereTruth(const Balls& balls, Distances distances)
    : radius_{Rational(balls.a.radius), Rational(balls.b.radius)}, contact_(distances.contact), distance2_(0) {
  for (int axis = 0; axis < 3; ++axis) {
    center_[0][index(axis)] = Rational(balls.a.center[axis]);
    center_[1][index(axis)] = Rational(balls.b.center[axis]);
    delta_[index(axis)] = center_[1][index(axis)] - center_[0][index(axis)];
    distance2_ += square(delta_[index(axis)]);
  }
  radii_ = radius_[0] + radius_[1];
  reach_ = Rational(distances.alarm) + radii_;
}

// Both sides of sqrt(D) <= reach are >= 0, so their squares stand in the same order.
CGAL::Sign SphereTruth::at_alarm() const { return CGAL::sign(distance2_ - square(reach_)); }
CGAL::Sign SphereTruth::at_zero() const { return CGAL::sign(distance2_ - square(radii_)); }

Exact SphereTruth::normal(int axis) const {
  if (degenerate()) return Rational(axis == 0 ? 1 : 0);
  return {Rational(0), delta_[index(axis)] / distance2_, distance2_};
}

Exact SphereTruth::point(int sphere, int axis, PointOn on) const {
  if (degenerate()) return point_for(sphere, axis, on, Vector3::UnitX());
  const Rational along = side(sphere, on) * radius_[index(sphere)] * delta_[index(axis)] / distance2_;
  return {center_[index(sphere)][index(axis)], along, distance2_};
}

Rational SphereTruth::point_for(int sphere, int axis, PointOn on, const Vector3& normal) const {
  return center_[index(sphere)][index(axis)] + side(sphere, on) * radius_[index(sphere)] * Rational(normal[axis]);
}

Exact SphereTruth::midpoint(int axis) const {
  const Rational centers = center_[0][index(axis)] + center_[1][index(axis)];
  const Rational radii = radius_[0] - radius_[1];
  if (degenerate()) return (centers + radii * Rational(axis == 0 ? 1 : 0)) / Rational(2);
  return {centers / Rational(2), radii * delta_[index(axis)] / distance2_ / Rational(2), distance2_};
}

Exact SphereTruth::value(bool less_contact) const {
  return {less_contact ? -radii_ - contact_ : -radii_, Rational(1), distance2_};
}

Exact SphereTruth::margin(Scalar scalar) const {
  return Exact(-reach_, Rational(1), distance2_).scaled(Rational(1) / ulp(reach_, scalar));
}

Exact SphereTruth::value_scale() const {
  const Rational larger = std::max(radii_, contact_);
  const Exact distance(Rational(0), Rational(1), distance2_);
  return distance.compare(larger) == CGAL::LARGER ? distance : Exact(larger);
}

Rational SphereTruth::point_scale(int sphere) const {
  Rational scale = radius_[index(sphere)];
  for (const Rational& c : center_[index(sphere)]) scale = std::max(scale, Rational(CGAL::abs(c)));
  return scale;
}

}  // namespace contact::oracle
