// What people get wrong about hulls, and about the way out of two cores that overlap. Causes and mutants make the same
// mistakes: here is each of them.
#pragma once

#include <optional>

#include "oracle/diagnosis/hypotheses.hpp"

namespace contact::oracle {

/// Each vertex moved to the grid of Bullet's btConvexHullComputer, which is as large as the hull.
void put_on_a_grid(Hull& hull);
/// The box around the vertices.
void put_in_a_box(Hull& hull);
/// Of a hull over a plane the one vertex that a walk along the list of its vertices ends at: where both neighbours are
/// higher.
void walk_down(Query& query);

/// A direction that is said to part two cores, from the first to the second, and by how much; below 0 of cores that it
/// finds apart.
struct WayInReals {
  Numbers normal;
  Real depth;
};

// What an engine finds that looks for it otherwise, where it finds one. Domain: any question.
/// Among the normals of the faces of two solids, and no crosses of edges.
[[nodiscard]] std::optional<WayInReals> way_by_faces(const Query& query);
/// Among these and the crosses of edges of two boxes, how deep along a cross being taken for the product, which is
/// less.
[[nodiscard]] std::optional<WayInReals> way_by_products(const Query& query);
/// Through the nearest face of the polytope that EPA may begin with, of the farthest points along the axes.
[[nodiscard]] std::optional<WayInReals> way_by_first_polytope(const Query& query);

}  // namespace contact::oracle
