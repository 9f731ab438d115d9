// Causes about any two convex shapes: a quaternion read otherwise, a box of another size, points of a hull that are lost,
// moved or blown up, an axis that is not tried, a depth that is lost.
#include <cmath>

#include "oracle/diagnosis/formulas.hpp"
#include "oracle/diagnosis/wrong_convexes.hpp"
#include "oracle/truth/cores.hpp"

namespace contact::oracle::formulas {
namespace {

/// Calls change(shape) for the shapes of one kind in a question, and asks it.
template <class Changed>
Cause others(std::string_view id, std::string_view sentence, void (*change)(Changed&)) {
  return edit(id, sentence, [change](Facts& f) {
    Query other = f.query;
    for_each_shape(other, [&]<class Shape>(Shape& shape) {
      if constexpr (std::same_as<Shape, Changed>) change(shape);
    });
    f.ask(std::move(other));
  });
}
const auto other_boxes = others<Obb>;
const auto other_hulls = others<Hull>;

constexpr Real kStop = 1e-6L;     ///< a relative tolerance of GJK in many engines
constexpr double kMargin = 0.04;  ///< Bullet's CONVEX_DISTANCE_MARGIN
bool has_flat_hull(const Query& q) {
  bool found = false;
  for_each_shape(q, [&]<class Shape>(const Shape& shape) {
    if constexpr (HullOfVertices<Shape>) found = found || exact_core(shape).outward.empty();
  });
  return found;
}

/// The middle of the points that a shape is given by.
template <class Shape>
Numbers middle_of(const Shape& shape) {
  Numbers sum{};
  Real count = 0;
  for_each_point(shape, [&](const Vector3& v) { sum = along(sum, 1, numbers_of(v)), ++count; });
  return times(1 / std::max(count, Real{1}), sum);
}

double squared_length(const Quaternion& q) { return q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]; }

template <class Say>
Said said_of(F f, const std::optional<WayInReals>& found, Say say) {
  return found && f.depth > 0 ? say(*found) : Said(std::nullopt);
}
/// A way out of two cores that overlap, and what a way that parts some that do not says of them.
Cause other_way(std::string_view id, std::string_view sentence, std::optional<WayInReals> (*way)(const Query&)) {
  const auto of = [way](F f) {
    // The same again, but for roundings, is no other.
    auto found = f.distance > 0 || f.depth > 0 ? way(f.query) : std::nullopt;
    if (found && f.depth > 0 && std::abs(found->depth - f.depth) <= 1e-9L * f.depth) found.reset();
    return found;
  };
  return {.id = id,
          .sentence = sentence,
          .hit =
              [of](F f) {
                if (f.depth > 0 || f.truth->hit()) return right_decision(f);
                const auto found = of(f);
                return found ? Said::at_most(-found->depth, f.radii() + f.alarm, largest_of(f.nearest[0]))
                             : right_decision(f);
              },
          .normal = [of](F f) { return said_of(f, of(f), [](const WayInReals& x) { return Said(x.normal); }); },
          .value =
              [of](F f) {
                return said_of(f, of(f), [&](const WayInReals& x) { return Said(-x.depth - f.radii() - f.contact); });
              }};
}

/// What is said where the cores overlap, and nothing elsewhere.
Said of_overlap(F f, Real value) { return where(f.depth > 0, Said(value)); }

}  // namespace

bool one_inside_the_other(F /*facts*/, const Convexes& /*shapes*/) { return false; }

std::vector<Cause> wrong_about(const Convexes* /*kind*/) {
  return {
      other_boxes("quaternion-not-normalised",
                  "takes an orientation for a unit quaternion: the box is scaled by its squared length",
                  [](Obb& box) { box.extents *= squared_length(box.orientation); }),
      other_boxes("quaternion-inverted", "turns a box the other way",
                  [](Obb& box) { box.orientation[3] = -box.orientation[3]; }),
      other_boxes("quaternion-w-first", "reads an orientation as w, x, y, z",
                  [](Obb& box) {
                    const auto [w, x, y, z] = box.orientation;
                    box.orientation = {x, y, z, w};
                  }),
      other_boxes("orientation-ignored", "takes a rotated box for one that is not turned",
                  [](Obb& box) {
                    box.orientation = {0, 0, 0, 1};
                  }),
      other_boxes("extents-are-lengths", "takes half lengths for lengths: a box is half as large",
                  [](Obb& box) { box.extents /= 2; }),
      other_boxes("extents-doubled", "takes a box for twice as large", [](Obb& box) { box.extents *= 2; }),
      other_hulls("hull-last-vertex-ignored", "leaves out the last vertex of a hull",
                  [](Hull& hull) {
                    if (hull.vertices.size() > 1) hull.vertices.pop_back();
                  }),
      other_hulls("hull-first-vertices-only", "looks at the first eight vertices of a hull",
                  [](Hull& hull) { hull.vertices.resize(std::min<std::size_t>(hull.vertices.size(), 8)); }),
      other_hulls("hull-is-its-bounds", "takes the box around the vertices of a hull for the hull", put_in_a_box),
      other_hulls("hull-margin-added", "blows a hull up by a margin of 0.04",
                  [](Hull& hull) { hull.radius += kMargin; }),
      other_hulls("hull-on-a-grid", "moves the vertices of a hull to a grid of its own size", put_on_a_grid),
      decision("hull-flat-missed", "takes a hull without a volume for nothing",
               [](F f) { return missed_where(has_flat_hull(f.query), f); }),
      edit("hull-walk-ends-early", "takes a vertex of a hull for the lowest whose neighbours in the list are higher",
           [](Facts& f) {
             Query other = f.query;
             walk_down(other);
             f.ask(std::move(other));
           }),
      other_way("axes-of-faces-only",
                "tries the normals of faces as axes that part two solids, and no crosses of edges", way_by_faces),
      other_way("crosses-not-divided", "does not divide how deep boxes overlap along a cross of edges by its length",
                way_by_products),
      other_way("first-polytope", "takes the nearest face of the polytope that EPA begins with", way_by_first_polytope),
      {.id = "normal-of-centres",
       .sentence = "leaves an overlap along the way between the centres of the shapes",
       .normal =
           [](F f) {
             std::array<Numbers, 2> middle;
             std::size_t which = 0;
             for_each_shape(f.query, [&](const auto& shape) { middle[which++] = middle_of(shape); });
             const Numbers way = along(middle[1], -1, middle[0]);
             const Real length = std::sqrt(dot(way, way));
             return where(f.depth > 0 && length > 0, Said(times(1 / length, way)));
           }},
      value("distance-a-millionth-long", "says a distance a millionth too long, as GJK does that stops there",
            [](F f) {
              return where(f.distance > 0 && !has_plane(f.query.pair),
                           Said((1 + kStop) * f.distance - f.radii() - f.contact));
            }),
      value("depth-lost", "says that cores that overlap are at distance 0",
            [](F f) { return of_overlap(f, -f.radii() - f.contact); }),
      value("depth-unsigned", "says the depth of cores that overlap as a distance above 0",
            [](F f) { return of_overlap(f, f.depth - f.radii() - f.contact); }),
  };
}

}  // namespace contact::oracle::formulas
