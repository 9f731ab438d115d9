// The faces of a hull's points, for engines that take no points alone; Qhull finds them.
#pragma once

#include <libqhull_r/qhull_ra.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>
#include <vector>

#include "engines/adapters/adapter.hpp"

namespace contact::adapters {

/// A plane with all of the shape behind it, normal . x <= offset, and the vertices on it, counterclockwise as seen from
/// outside. Qhull rounds its planes; the vertices are those of the question.
struct Face {
  std::array<double, 3> normal;
  double offset;
  std::vector<int> around;
};
struct Polyhedron {
  std::vector<std::array<double, 3>> vertices;  ///< each once, and none that lies inside
  std::vector<Face> faces;
};

/// Nothing where the points span no volume, within Qhull's own tolerance of some ulps of the largest coordinate.
inline std::optional<Polyhedron> polyhedron_of(const Shape& hull) {
  static std::FILE* const nowhere = std::fopen("/dev/null", "w");
  std::vector<double> points(hull.vertex(0), hull.vertex(hull.vertices()));
  // Where a product of its differences overflows, Qhull ends the process: so it sees numbers up to 2, exactly.
  double largest = 0;
  for (const double x : points) largest = std::fmax(largest, std::fabs(x));
  const int exponent = largest > 0 ? std::ilogb(largest) : 0;
  for (double& x : points) x = std::ldexp(x, -exponent);
  qhT qh;
  qh_zero(&qh, nowhere);
  char options[] = "qhull";
  std::optional<Polyhedron> found;
  if (hull.vertices() > 3 && qh_new_qhull(&qh, 3, hull.vertices(), points.data(), 0, options, nullptr, nowhere) == 0) {
    found.emplace();
    std::vector<int> index(static_cast<std::size_t>(hull.vertices()), -1);
    for (const facetT* facet = qh.facet_list; facet && facet->next; facet = facet->next) {
      Face face{{facet->normal[0], facet->normal[1], facet->normal[2]}, std::ldexp(-facet->offset, exponent), {}};
      setT* around = qh_facet3vertex(&qh, const_cast<facetT*>(facet));
      for (int i = qh_setsize(&qh, around) - 1; i >= 0; --i) {  // which it gives clockwise
        const auto* vertex = static_cast<const vertexT*>(around->e[i].p);
        const int id = qh_pointid(&qh, vertex->point);
        int& known = index[static_cast<std::size_t>(id)];
        if (known < 0) {
          known = static_cast<int>(found->vertices.size());
          const double* x = hull.vertex(id);
          found->vertices.push_back({x[0], x[1], x[2]});
        }
        face.around.push_back(known);
      }
      qh_settempfree(&qh, &around);
      found->faces.push_back(std::move(face));
    }
  }
  int memory = 0;
  int blocks = 0;
  qh_freeqhull(&qh, !qh_ALL);
  qh_memfreeshort(&qh, &memory, &blocks);
  return found;
}

}  // namespace contact::adapters
