// What people get wrong about hulls, and about the way out of two cores that overlap.
#include "oracle/diagnosis/wrong_convexes.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "oracle/diagnosis/formulas.hpp"
#include "oracle/truth/cores.hpp"

namespace contact::oracle {
namespace {

using formulas::dot;
using formulas::times;

std::pair<Vector3, Vector3> bounds(const Hull& hull) {
  std::pair<Vector3, Vector3> found{hull.vertices[0], hull.vertices[0]};
  for (const Vector3& v : hull.vertices) found = {found.first.cwiseMin(v), found.second.cwiseMax(v)};
  return found;
}

Numbers plain(const Point& p) { return {CGAL::to_double(p[0]), CGAL::to_double(p[1]), CGAL::to_double(p[2])}; }
Numbers product(const Numbers& u, const Numbers& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

struct PlainCore {
  std::vector<Numbers> vertices;
  std::vector<Numbers> outward;  ///< of unit length
  std::vector<Numbers> edges;    ///< the same, one of each direction

  explicit PlainCore(const Convex& shape) {
    const ExactCore core = exact_core(shape);
    const auto unit = [](const Numbers& v) { return times(1 / std::sqrt(dot(v, v)), v); };
    for (const Point& p : core.vertices) vertices.push_back(plain(p));
    for (const Point& n : core.outward) outward.push_back(unit(plain(n)));
    for (const Feature* edge : core.features_of(1))
      edges.push_back(unit(plain(core.vertices[edge->places[1]] - core.vertices[edge->places[0]])));
  }
  [[nodiscard]] const Numbers& farthest(const Numbers& along) const {
    return *std::max_element(vertices.begin(), vertices.end(),
                             [&](const Numbers& x, const Numbers& y) { return dot(x, along) < dot(y, along); });
  }
};

/// The difference of two cores.
struct PlainCores {
  PlainCore a;
  PlainCore b;
  explicit PlainCores(const Convexes& shapes) : a(shapes.a), b(shapes.b) {}

  [[nodiscard]] Numbers farthest(const Numbers& along) const {
    return formulas::along(a.farthest(along), -1, b.farthest(times(-1, along)));
  }
  /// The least along these, each of its own length.
  [[nodiscard]] std::optional<WayInReals> least_of(const std::vector<Numbers>& axes) const {
    std::optional<WayInReals> least;
    for (const Numbers& n : axes)
      if (const Real depth = dot(farthest(n), n); !least || depth < least->depth) least = {n, depth};
    return least;
  }
  /// The normals of faces, of two solids.
  [[nodiscard]] std::vector<Numbers> faces() const {
    if (a.outward.empty() || b.outward.empty()) return {};
    std::vector<Numbers> all = a.outward;
    for (const Numbers& n : b.outward) all.push_back(times(-1, n));
    return all;
  }
};

std::optional<PlainCores> cores_of(const Query& query) {
  if (!is_convex(query.pair) || has_plane(query.pair)) return std::nullopt;
  return PlainCores(std::get<Convexes>(query.shapes));
}

}  // namespace

void put_on_a_grid(Hull& hull) {
  constexpr double kSteps = 10216;  // from the middle of a hull to its ends
  const auto [low, high] = bounds(hull);
  const Vector3 middle = (low + high) / 2;
  for (Vector3& v : hull.vertices)
    for (int i = 0; i < 3; ++i) {
      const double step = (high[i] - low[i]) / 2 / kSteps;
      if (step > 0) v[i] = middle[i] + std::nearbyint((v[i] - middle[i]) / step) * step;
    }
}

void put_in_a_box(Hull& hull) {
  const auto [low, high] = bounds(hull);
  hull.vertices.clear();
  for (const double x : {low[0], high[0]})
    for (const double y : {low[1], high[1]})
      for (const double z : {low[2], high[2]}) hull.vertices.emplace_back(x, y, z);
}

void walk_down(Query& query) {
  if (query.pair != Pair::hull_plane) return;
  auto& shapes = std::get<Convexes>(query.shapes);
  auto& vertices = std::get<Hull>(shapes.a.shape).vertices;
  const Numbers up = formulas::numbers_of(std::get<Plane>(shapes.b.shape).normal);
  const auto height = [&](std::size_t i) { return dot(formulas::numbers_of(vertices[i]), up); };
  const std::size_t count = vertices.size();
  for (std::size_t here = 0;;) {
    const std::size_t next = (here + 1) % count;
    const std::size_t last = (here + count - 1) % count;
    const std::size_t lower = height(next) < height(last) ? next : last;
    if (!(height(lower) < height(here))) return void(vertices = {Vector3(vertices[here])});
    here = lower;
  }
}

std::optional<WayInReals> way_by_faces(const Query& query) {
  const auto cores = cores_of(query);
  return cores ? cores->least_of(cores->faces()) : std::nullopt;
}

std::optional<WayInReals> way_by_products(const Query& query) {
  constexpr Real kParallel2 = 1e-12L;
  if (query.pair != Pair::obb_obb) return std::nullopt;
  const auto cores = cores_of(query);
  std::vector<Numbers> axes = cores->faces();
  if (axes.empty()) return std::nullopt;
  for (const Numbers& u : cores->a.edges)
    for (const Numbers& v : cores->b.edges)
      if (const Numbers n = product(u, v); dot(n, n) > kParallel2) {
        axes.push_back(n);
        axes.push_back(times(-1, n));
      }
  auto least = cores->least_of(axes);
  least->normal = times(1 / std::sqrt(dot(least->normal, least->normal)), least->normal);
  return least;
}

std::optional<WayInReals> way_by_first_polytope(const Query& query) {
  const auto cores = cores_of(query);
  if (!cores) return std::nullopt;
  std::optional<WayInReals> nearest;
  for (const Real x : {1, -1})
    for (const Real y : {1, -1})
      for (const Real z : {1, -1}) {
        const Numbers corner = cores->farthest({x, 0, 0});
        const Numbers n = product(formulas::along(cores->farthest({0, y, 0}), -1, corner),
                                  formulas::along(cores->farthest({0, 0, z}), -1, corner));
        const Real length = x * y * z * std::sqrt(dot(n, n));
        const Real distance = dot(corner, n) / length;
        if (!(distance > 0)) return std::nullopt;  // flat, or beside the origin
        if (!nearest || distance < nearest->depth) nearest = {times(1 / length, n), distance};
      }
  return nearest;
}

}  // namespace contact::oracle
