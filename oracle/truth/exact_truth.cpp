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

constexpr int kEnoughBits = 128;  // of numbers that are not judged

Exact root(const Rational& x) { return {Rational(0), Rational(1), x}; }

}  // namespace

Rational outward(int shape, PointOn on) {
  if (on == PointOn::center) return Rational(0);
  return (shape == 0) == (on == PointOn::nearest_surface) ? Rational(1) : Rational(-1);
}

DistanceTruth::DistanceTruth(Cores cores, Distances distances)
    : cores_(std::move(cores)), contact_(distances.contact), distance2_(0) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    delta_[axis] = cores_.nearest[1][axis] - cores_.nearest[0][axis];
    distance2_ += square(delta_[axis]);
  }
  radii_ = cores_.radius[0] + cores_.radius[1];
  reach_ = Rational(distances.alarm) + radii_;
  if (meets() && !cores_.meeting)
    cores_.meeting =
        Meeting{Rational(0), {{{Rational(1), Rational(0), Rational(0)}, cores_.nearest[0], cores_.nearest[1]}}, {}};
  settle_along();
}

void DistanceTruth::settle_along() {
  along_ = cores_.cast         ? cores_.cast->along
           : cores_.half_space ? cores_.half_space->inward
           : meets()           ? meeting().ways.front().direction
                               : delta_;
  along2_ = square(along_[0]) + square(along_[1]) + square(along_[2]);
}

DistanceTruth DistanceTruth::by_way(std::size_t way) const {
  DistanceTruth other = *this;
  std::swap(other.cores_.meeting->ways.front(), other.cores_.meeting->ways[way]);
  other.settle_along();
  return other;
}

bool DistanceTruth::below() const { return cores_.half_space && dot(delta_, along_) < Rational(0); }

const Point& DistanceTruth::nearest(int shape) const {
  if (!meets()) return cores_.nearest[index(shape)];
  return shape == 0 ? meeting().ways.front().first : meeting().ways.front().nearest;
}

// Both sides of sqrt(D) <= reach are >= 0, so their squares stand in the same order. What is inside or below is within
// any reach.
Side DistanceTruth::within(const Rational& reach) const {
  return below() || (meets() && !coincident()) ? Side::within : side_of(distance2_ - square(reach));
}
Side DistanceTruth::at_alarm() const { return within(reach_); }
Side DistanceTruth::at_zero() const { return within(radii_); }

Exact DistanceTruth::normal(int axis) const {
  if (cores_.cast) return cores_.cast->normal[index(axis)];
  return {Rational(0), along_[index(axis)] / along2_, along2_};
}

Exact DistanceTruth::point(int shape, int axis, PointOn on) const {
  if (cores_.cast) return cores_.cast->at[index(axis)];
  const Rational radius = outward(shape, on) * cores_.radius[index(shape)];
  return {nearest(shape)[index(axis)], radius * along_[index(axis)] / along2_, along2_};
}

Rational DistanceTruth::point_for(int shape, int axis, PointOn on, const Vector3& normal) const {
  const DefaultEnvironment environment;
  return foot(shape, normal)[index(axis)] + outward(shape, on) * cores_.radius[index(shape)] * Rational(normal[axis]);
}

const Point& DistanceTruth::foot(int shape, const Vector3& normal) const {
  if (shape == 0) return cores_.nearest[0];
  const auto along = [&](const WayOut& way) {
    Rational sum(0);
    for (std::size_t axis = 0; axis < 3; ++axis)
      sum += way.direction[axis] * Rational(normal[static_cast<Eigen::Index>(axis)]);
    return sum;
  };
  return std::max_element(meeting().ways.begin(), meeting().ways.end(),
                          [&](const WayOut& x, const WayOut& y) { return along(x) < along(y); })
      ->nearest;
}

Exact DistanceTruth::midpoint(int axis) const {
  if (cores_.cast) return cores_.cast->at[index(axis)];
  const Rational sum = nearest(0)[index(axis)] + nearest(1)[index(axis)];
  const Rational radii = cores_.radius[0] - cores_.radius[1];
  return {sum / Rational(2), radii * along_[index(axis)] / along2_ / Rational(2), along2_};
}

Exact DistanceTruth::value(bool less_contact) const {
  if (cores_.cast) return cores_.cast->t;
  return core_distance().plus(less_contact ? -radii_ - contact_ : -radii_);
}

Exact DistanceTruth::core_distance() const { return meets() ? depth().scaled(Rational(-1)) : signed_distance(); }

Exact DistanceTruth::margin(Scalar scalar) const { return beyond(reach_).scaled(Rational(1) / ulp(reach_, scalar)); }

Exact DistanceTruth::value_scale() const {
  if (cores_.cast) return cores_.cast->value_scale;
  Rational larger = std::max(radii_, contact_);
  if (meets()) return larger_of(larger, depth());
  if (cores_.half_space) larger = std::max({larger, cores_.farthest[0], cores_.farthest[1]});
  return larger_of(larger, root(cores_.half_space ? std::max(distance2_, cores_.half_space->offset2) : distance2_));
}

Exact DistanceTruth::point_scale(int shape) const {
  if (cores_.cast) return cores_.cast->point_scale;
  const Rational larger = std::max(cores_.radius[index(shape)], cores_.farthest[index(shape)]);
  return cores_.half_space ? larger_of(larger, root(cores_.half_space->offset2)) : Exact(larger);
}

CrossingTruth::CrossingTruth(const Point& at, const Point& normal, const Rational& farthest) : at_(at) {
  Cores cores{{at, at}, {Rational(0), Rational(0)}, {farthest, farthest}};
  cores.half_space = HalfSpace{normal, Rational(0)};
  contact_.emplace(std::move(cores), Distances{0, 0});
}

CastTruth::CastTruth(const LineEnd& entry, const std::optional<LineEnd>& exit, CastHit hit)
    : entry_(entry), exit_(exit) {
  Point near;
  for (std::size_t axis = 0; axis < 3; ++axis) near[axis] = hit.at[axis].enclosure(kEnoughBits).low;
  Cores cores{{near, near}, {Rational(0), Rational(0)}, {Rational(0), Rational(0)}};
  cores.meeting = Meeting{Rational(0), {{hit.along, near, near}}, {}};
  if (hit.against)
    for (const Point& way : *hit.against) cores.meeting->apart.push_back(Rational(-1) * way);
  cores.cast = std::move(hit);
  contact_.emplace(std::move(cores), Distances{0, 0});
}

const Rational& GapTruth::widest_gap() const { return *std::max_element(gap_.begin(), gap_.end()); }
Side GapTruth::at_alarm() const { return side_of(widest_gap() - alarm_); }
Side GapTruth::at_zero() const { return side_of(widest_gap()); }

}  // namespace contact::oracle
