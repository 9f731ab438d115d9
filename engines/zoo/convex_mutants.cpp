// Mistakes about any two convex shapes: how a box is turned, how large it is, which points make a hull, and which axis
// parts two cores.
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "engines/zoo/mutating.hpp"
#include "oracle/diagnosis/wrong_convexes.hpp"
#include "oracle/truth/cores.hpp"
#include "oracle/truth/default_environment.hpp"
#include "oracle/truth/exact_truth.hpp"

namespace contact::engines {

namespace {

const oracle::DistanceTruth& truth_of_cores(const Query& q) { return *truth_again(q).distance(); }
constexpr int kEnoughBits = 100;
Wide wide(const oracle::Rational& x) {
  const double most = CGAL::to_double(x);
  if (!std::isfinite(most)) return static_cast<Wide>(most);
  return static_cast<Wide>(most) + static_cast<Wide>(CGAL::to_double(x - oracle::Rational(most)));
}

void drop_flat_hulls(const Query& q, Claim& claim) {
  for_each_shape(q, [&]<class Shape>(const Shape& shape) {
    if constexpr (std::same_as<Shape, Hull>)
      if (claim.overlap.value_or(false) && oracle::exact_core(shape).outward.empty()) decide(q, claim, false);
  });
}

/// An overlap is left by the axis that goes through the centres of the shapes' bounds, as by an engine that tries no other.
void leave_by_centers(const Query& q, Claim& claim) {
  if (!claim.contact || !is_convex(q.pair) || has_plane(q.pair) || WideSpheres(q).distance >= 0) return;
  std::vector<std::vector<Wide3>> points;
  for_each_shape(q, [&](const auto& shape) {
    auto& of = points.emplace_back();
    for_each_point(shape, [&](const Vector3& v) { of.push_back(v.template cast<Wide>()); });
  });
  const auto middle = [](const std::vector<Wide3>& of) {
    Wide3 sum = Wide3::Zero();
    for (const Wide3& x : of) sum += x / static_cast<Wide>(of.size());
    return sum;
  };
  const Wide3 along = middle(points[1]) - middle(points[0]);
  if (along.norm() > 0) claim.contact->normal = Vector3((along / along.norm()).cast<double>());
}

/// An overlap is left another way, and what that way does not part overlaps.
template <std::optional<oracle::WayInReals> (*way_out)(const Query&)>
void leave_by_way(const Query& q, Claim& claim) {
  if (!is_convex(q.pair) || has_plane(q.pair)) return;
  const WideSpheres s(q);
  if (s.distance == 0 || (s.distance > 0 && claim.overlap.value_or(false))) return;
  const auto way = way_out(q);
  if (!way) return;
  if (s.distance > 0) {
    if (-way->depth <= s.reach) decide(q, claim, true);
  } else if (std::abs(way->depth + s.distance) > -1e-9L * s.distance) {
    in_contact(claim, [&](ContactClaim& c) {
      const auto& [x, y, z] = way->normal;
      c.normal = Vector3(rounded(x), rounded(y), rounded(z));
      c.value = rounded(-way->depth - s.r1 - s.r2 - s.contact);
    });
  }
}

const std::array kConvexes{
    Mutant{"obb-quaternion-not-normalised", "an orientation is taken for a unit quaternion",
           "quaternion-not-normalised", each<Obb>([](Obb& box) {
             const auto& [x, y, z, w] = box.orientation;
             box.extents *= x * x + y * y + z * z + w * w;
           })},
    Mutant{"obb-turned-back", "a box is turned the other way", "quaternion-inverted",
           each<Obb>([](Obb& box) { box.orientation[3] = -box.orientation[3]; })},
    Mutant{"obb-w-first", "an orientation is read as w, x, y, z", "quaternion-w-first", each<Obb>([](Obb& box) {
             const auto [w, x, y, z] = box.orientation;
             box.orientation = {x, y, z, w};
           })},
    Mutant{"obb-not-turned", "a rotated box is taken for one that is not turned", "orientation-ignored",
           each<Obb>([](Obb& box) {
             box.orientation = {0, 0, 0, 1};
           })},
    Mutant{"obb-half-extents", "half lengths are taken for lengths", "extents-are-lengths",
           each<Obb>([](Obb& box) { box.extents /= 2; })},
    Mutant{"obb-double-extents", "lengths are given where half lengths are asked for", "extents-doubled",
           each<Obb>([](Obb& box) { box.extents *= 2; })},
    Mutant{"hull-radius-missing", "the radius of a hull is never read", "hull-radius-missing",
           each<Hull>([](Hull& hull) { hull.radius = 0; })},
    Mutant{"hull-last-vertex-missing", "a loop over the vertices of a hull ends one too early",
           "hull-last-vertex-ignored", each<Hull>([](Hull& hull) {
             if (hull.vertices.size() > 1) hull.vertices.pop_back();
           })},
    Mutant{"hull-eight-vertices", "a hull has room for eight vertices", "hull-first-vertices-only",
           each<Hull>([](Hull& hull) {
             if (hull.vertices.size() > 8) hull.vertices.resize(8);
           })},
    Mutant{"hull-bounds", "a hull is the box around its vertices", "hull-is-its-bounds",
           each<Hull>([](Hull& hull) { oracle::put_in_a_box(hull); })},
    Mutant{"hull-default-margin", "a hull keeps the margin of 0.04 that a library gives it", "hull-margin-added",
           each<Hull>([](Hull& hull) { hull.radius += 0.04; })},
    Mutant{"hull-vertices-rounded", "the maker of a hull rounds its vertices to a grid", "hull-on-a-grid",
           each<Hull>([](Hull& hull) { oracle::put_on_a_grid(hull); })},
    Mutant{"hull-flat-dropped", "a hull without a volume is never hit", "hull-flat-missed", nullptr, drop_flat_hulls},
    Mutant{"hull-walk", "the lowest vertex of a hull is where both neighbours in the list are higher",
           "hull-walk-ends-early", oracle::walk_down},
    Mutant{"sat-without-edges", "two solids are parted along normals of faces alone", "axes-of-faces-only", nullptr,
           leave_by_way<oracle::way_by_faces>},
    Mutant{"sat-not-divided", "how deep boxes overlap along a cross of edges is not divided by its length",
           "crosses-not-divided", nullptr, leave_by_way<oracle::way_by_products>},
    Mutant{"epa-stops-at-once", "EPA takes the nearest face of the polytope that it begins with", "first-polytope",
           nullptr, leave_by_way<oracle::way_by_first_polytope>},
    Mutant{"gjk-stops-1e-6", "GJK stops where the distance is a millionth too long", "distance-a-millionth-long",
           nullptr,
           [](const Query& q, Claim& claim) {
             if (is_convex(q.pair) && !has_plane(q.pair))
               revalue(q, claim, [](const WideSpheres& s) {
                 return std::max((1 + 1e-6L) * s.distance, s.distance) - s.r1 - s.r2 - s.contact;
               });
           }},
    Mutant{"overlap-without-depth", "cores that overlap are said to touch", "depth-lost", nullptr,
           [](const Query& q, Claim& claim) {
             if (is_convex(q.pair) && !has_plane(q.pair))
               revalue(q, claim,
                       [](const WideSpheres& s) { return std::max(s.distance, Wide{0}) - s.r1 - s.r2 - s.contact; });
           }},
    Mutant{"depth-above-zero", "how deep cores overlap is said as a distance", "depth-unsigned", nullptr,
           [](const Query& q, Claim& claim) {
             if (is_convex(q.pair) && !has_plane(q.pair))
               revalue(q, claim, [](const WideSpheres& s) { return std::abs(s.distance) - s.r1 - s.r2 - s.contact; });
           }},
    Mutant{"overlap-by-centres", "an overlap is left along the way between the centres", "normal-of-centres", nullptr,
           leave_by_centers},
};

}  // namespace

WideBalls at_nearest_of_convexes(const Query& q) {
  const oracle::DistanceTruth& truth = truth_of_cores(q);
  WideBalls balls;
  for (const int shape : {0, 1}) {
    auto& [center, radius] = balls[static_cast<std::size_t>(shape)];
    for (int axis = 0; axis < 3; ++axis)
      center[axis] = wide(truth.point(shape, axis, PointOn::center).enclosure(kEnoughBits).low);
    radius = wide(truth.radius(shape));
  }
  return balls;
}

Wide distance_of_convexes(const Query& q) { return wide(truth_of_cores(q).core_distance().enclosure(kEnoughBits).low); }

std::span<const Mutant> convex_mutants() { return kConvexes; }

}  // namespace contact::engines
