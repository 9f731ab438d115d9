// What can go wrong about a sphere and a triangle alone: which of its points is taken for the nearest.
#include "oracle/diagnosis/formulas.hpp"

namespace contact::oracle::formulas {
namespace {

using Weights = std::optional<std::array<Real, 3>>;

/// The vertices from the centre, and what follows from them.
struct Seen {
  std::array<Numbers, 3> w;
  Numbers n;
  Real length2;                     ///< |n|^2
  std::array<Real, 3> over_edge{};  ///< above 0 where the foot on the plane lies inside of edge k, |n|^2 together

  explicit Seen(F f) {
    const auto& triangle = std::get<BallAndTriangle>(f.query.shapes).b;
    for (const std::size_t k : kAxes) w[k] = along(numbers_of(triangle.vertices[k]), -1, f.nearest[0]);
    n = cross(along(w[1], -1, w[0]), along(w[2], -1, w[0]));
    length2 = dot(n, n);
    for (const std::size_t k : kAxes) over_edge[k] = dot(n, cross(w[k], w[(k + 1) % 3]));
  }
  static Numbers cross(const Numbers& x, const Numbers& y) {
    return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
  }
  [[nodiscard]] Real least_over_edge() const { return std::min({over_edge[0], over_edge[1], over_edge[2]}); }
  [[nodiscard]] std::array<Real, 3> on_plane() const {
    return {over_edge[1] / length2, over_edge[2] / length2, over_edge[0] / length2};
  }
  [[nodiscard]] Numbers at(const std::array<Real, 3>& weights) const {
    Numbers point{};
    for (const std::size_t k : kAxes) point = along(point, weights[k], w[k]);
    return point;
  }
  /// The least of some weights.
  template <std::size_t kCount>
  [[nodiscard]] std::array<Real, 3> nearest_of(const std::array<std::array<Real, 3>, kCount>& all) const {
    return *std::min_element(all.begin(), all.end(), [&](const auto& x, const auto& y) {
      const Numbers a = at(x);
      const Numbers b = at(y);
      return dot(a, a) < dot(b, b);
    });
  }
  /// The foot on an edge.
  [[nodiscard]] std::array<Real, 3> on_edge(std::size_t k, bool clamped) const {
    const std::size_t next = (k + 1) % 3;
    const Numbers u = along(w[next], -1, w[k]);
    Real t = dot(u, u) > 0 ? -dot(w[k], u) / dot(u, u) : 0;
    if (clamped) t = std::clamp(t, Real{0}, Real{1});
    std::array<Real, 3> weights{};
    weights[k] = 1 - t;
    weights[next] = t;
    return weights;
  }
};

/// Other weights of the vertices; nothing leaves the nearest point as it is.
Cause at_weights(std::string_view id, std::string_view sentence, Weights (*weights)(const Seen&)) {
  return edit(id, sentence, [weights](Facts& f) {
    const Seen seen(f);
    const auto taken = weights(seen);
    if (!taken) return;
    const Numbers point = along(f.nearest[0], 1, seen.at(*taken));
    if (is_same_point(point, f.nearest[1])) return;
    f.nearest[1] = point;
    f.settle();
  });
}
/// Where a search of the regions, vertices and edges before the face, ends if each comparison with 0 is one with `limit`
/// on the side of ending there: products of two lengths, and of an edge of four. Nothing where it comes to the face.
Weights first_region(const Seen& seen, Real limit) {
  const auto& w = seen.w;
  const Numbers ab = along(w[1], -1, w[0]);
  const Numbers ac = along(w[2], -1, w[0]);
  std::array<Real, 3> b{};  // how far along ab and along ac the centre lies, from each vertex
  std::array<Real, 3> c{};
  for (const std::size_t k : kAxes) b[k] = -dot(ab, w[k]), c[k] = -dot(ac, w[k]);
  if (b[0] < limit && c[0] < limit) return {{1, 0, 0}};
  if (b[1] > -limit && c[1] <= b[1]) return {{0, 1, 0}};
  const auto on = [](Real before, Real behind) { return before == behind ? 0 : before / (before - behind); };
  if (b[0] * c[1] - b[1] * c[0] < limit && b[0] > -limit && b[1] < limit)
    return {{1 - on(b[0], b[1]), on(b[0], b[1]), 0}};
  if (c[2] > -limit && b[2] <= c[2]) return {{0, 0, 1}};
  if (b[2] * c[0] - b[0] * c[2] < limit && c[0] > -limit && c[2] < limit)
    return {{1 - on(c[0], c[2]), 0, on(c[0], c[2])}};
  const Real from_b = c[1] - b[1];
  const Real from_c = b[2] - c[2];
  if (b[1] * c[2] - b[2] * c[1] < limit && from_b > -limit && from_c > -limit)
    return {{0, 1 - on(from_b, -from_c), on(from_b, -from_c)}};
  return std::nullopt;
}
/// A miss where the foot is on one of some features, or something else holds.
Cause misses(std::string_view id, std::string_view sentence, bool (*there)(F, const Seen&)) {
  return decision(id, sentence, [there](F f) { return missed_where(there(f, Seen(f)), f); });
}
bool at_vertex(const Seen& seen) {
  const auto weights = nearest_weights(seen.w);
  return *std::max_element(weights.begin(), weights.end()) == 1;
}

}  // namespace

bool one_inside_the_other(F f, const BallAndTriangle& /*shapes*/) {
  const Seen seen(f);
  return std::all_of(seen.w.begin(), seen.w.end(),
                     [&](const Numbers& w) { return dot(w, w) <= f.radius[0] * f.radius[0]; });
}

std::vector<Cause> wrong_about(const BallAndTriangle* /*kind*/) {
  return {
      misses("triangle-face-only", "edges and vertices of a triangle ignored: a hit only where the foot is on the face",
             [](F, const Seen& seen) { return !(seen.least_over_edge() >= 0 && seen.length2 > 0); }),
      misses("triangle-vertices-ignored", "vertices of a triangle ignored: faces and edges hit alone",
             [](F, const Seen& seen) { return at_vertex(seen); }),
      misses("triangle-one-sided", "a triangle hit from the side of its normal alone",
             [](F, const Seen& seen) { return dot(seen.n, seen.w[0]) > 0; }),
      misses("triangle-flat-missed", "triangles without an inside never hit",
             [](F, const Seen& seen) { return seen.length2 == 0; }),
      misses("triangle-area-1e-6", "triangles whose doubled area is below 1e-6 never hit, whatever the units",
             [](F, const Seen& seen) { return seen.length2 < 1e-12L; }),
      misses("triangle-edge-within-1e-5",
             "a foot within 1e-5 of an edge, in barycentric coordinates, counted as beside",
             [](F, const Seen& seen) { return seen.length2 > 0 && seen.least_over_edge() < 1e-5L * seen.length2; }),
      decision("triangle-within-1e-5", "a face up to 1e-5 away counted as touched, whatever the units",
               [](F f) {
                 const Seen seen(f);
                 const bool over = seen.length2 > 0 && seen.least_over_edge() >= 0;
                 return Said::at_most(f.distance, f.radii() + f.alarm + (over ? 1e-5L : 0));
               }),
      at_weights("triangle-as-plane", "a triangle taken for its whole plane",
                 [](const Seen& seen) { return seen.length2 > 0 ? Weights(seen.on_plane()) : std::nullopt; }),
      at_weights("triangle-as-edges", "the face of a triangle ignored, its edges tried alone",
                 [](const Seen& seen) {
                   return Weights(seen.nearest_of(
                       std::array{seen.on_edge(0, true), seen.on_edge(1, true), seen.on_edge(2, true)}));
                 }),
      at_weights("triangle-as-vertices", "the nearest vertex of a triangle taken for its nearest point",
                 [](const Seen& seen) {
                   using Three = std::array<Real, 3>;
                   return Weights(seen.nearest_of(std::array{Three{1, 0, 0}, Three{0, 1, 0}, Three{0, 0, 1}}));
                 }),
      at_weights("triangle-by-centroid", "the middle of a triangle taken for its nearest point",
                 [](const Seen&) {
                   return Weights({1 / Real{3}, 1 / Real{3}, 1 / Real{3}});
                 }),
      at_weights("triangle-first-vertex", "a triangle taken for its first vertex",
                 [](const Seen&) {
                   return Weights({1, 0, 0});
                 }),
      at_weights(
          "triangle-edge-not-clamped", "a foot beside the face put on the line of an edge, and not clamped to it",
          [](const Seen& seen) -> Weights {
            if (seen.least_over_edge() >= 0) return std::nullopt;
            return seen.nearest_of(std::array{seen.on_edge(0, false), seen.on_edge(1, false), seen.on_edge(2, false)});
          }),
      at_weights("triangle-weights-clamped", "barycentric coordinates clamped one by one and scaled to a sum of 1",
                 [](const Seen& seen) -> Weights {
                   if (!(seen.length2 > 0)) return std::nullopt;
                   auto weights = seen.on_plane();
                   Real all = 0;
                   for (Real& x : weights) all += x = std::max(x, Real{0});
                   for (Real& x : weights) x /= all;
                   return weights;
                 }),
      at_weights("triangle-weights-rotated", "barycentric coordinates in another order: each with the next vertex",
                 [](const Seen& seen) -> Weights {
                   const auto weights = nearest_weights(seen.w);
                   return {{weights[2], weights[0], weights[1]}};
                 }),
      at_weights(
          "triangle-weight-negated", "one barycentric coordinate with the other sign",
          [](const Seen& seen) -> Weights {
            if (!(seen.length2 > 0)) return std::nullopt;
            auto weights = seen.on_plane();
            weights[1] = -weights[1];
            weights[0] = 1 - weights[1] - weights[2];
            if (std::min({weights[0], weights[1], weights[2]}) >= 0) return weights;
            return seen.nearest_of(std::array{seen.on_edge(0, true), seen.on_edge(1, true), seen.on_edge(2, true)});
          }),
      at_weights("triangle-vertex-by-signs",
                 "the vertex of the one positive barycentric coordinate taken, where an edge is nearer",
                 [](const Seen& seen) -> Weights {
                   if (!(seen.length2 > 0)) return std::nullopt;
                   const auto weights = seen.on_plane();
                   std::array<Real, 3> vertex{};
                   int positive = 0;
                   for (const std::size_t k : kAxes)
                     if (weights[k] > 0) ++positive, vertex[k] = 1;
                   return positive == 1 ? Weights(vertex) : std::nullopt;
                 }),
      at_weights(
          "triangle-face-dropped-1e-4",
          "the face of a triangle dropped where its doubled area is below 1e-4, whatever the units",
          [](const Seen& seen) -> Weights {
            if (!(seen.length2 < 1e-8L)) return std::nullopt;
            return seen.nearest_of(std::array{seen.on_edge(0, true), seen.on_edge(1, true), seen.on_edge(2, true)});
          }),
      at_weights(
          "triangle-regions-1e-13",
          "products of two and of four lengths compared with 1e-13, where vertex, edge and face of a triangle are told "
          "apart: the face of a small one is never found",
          [](const Seen& seen) { return first_region(seen, 1e-13L); }),
      {.id = "triangle-flat-zero",
       .sentence = "triangles without an inside answered with a distance of 0",
       .hit = [](F f) { return Seen(f).length2 == 0 ? Said::hit(true) : right_decision(f); },
       .value = [](F f) { return where(Seen(f).length2 == 0, Said(-f.radii() - f.contact)); }},
      {.id = "triangle-flat-not-finite",
       .sentence = "NaN or infinite numbers of triangles without an inside",
       .normal = [](F f) { return where(Seen(f).length2 == 0, kNotFinite); },
       .point = [](F f, std::size_t) { return where(Seen(f).length2 == 0, kNotFinite); },
       .value = [](F f) { return where(Seen(f).length2 == 0, Said(kNaN)); }},
      at_weights("triangle-last-edge-forgotten", "the edge from the last vertex to the first never tried",
                 [](const Seen& seen) -> Weights {
                   if (seen.length2 > 0 && seen.least_over_edge() >= 0) return std::nullopt;
                   return seen.nearest_of(std::array{seen.on_edge(0, true), seen.on_edge(1, true)});
                 }),
      {.id = "triangle-normal-of-winding",
       .sentence = "the normal taken from the order of the vertices, whichever side the sphere is on",
       .normal =
           [](F f) {
             const Seen seen(f);
             return where(f.D > 0 && seen.length2 > 0, Said(times(-1 / std::sqrt(seen.length2), seen.n)));
           }},
      {.id = "triangle-distance-to-plane",
       .sentence = "the distance to the plane of the triangle for the distance to it",
       .value =
           [](F f) {
             const Seen seen(f);
             if (!(seen.length2 > 0)) return Said(std::nullopt);
             return Said(std::abs(dot(seen.n, seen.w[0])) / std::sqrt(seen.length2) - f.radii() - f.contact);
           }},
      value("triangle-value-negated", "minus the distance of the surfaces for the value",
            [](F f) { return Said(-signed_distance(f)); }),
  };
}

}  // namespace contact::oracle::formulas
