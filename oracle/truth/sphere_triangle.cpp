// A sphere and a triangle, exactly. The nearest point of the triangle is the best of all its features: three vertices,
// the feet on three edges, the foot on the face. All of these that lie in it are tried, and nobody asks in which region
// the centre lies.
#include <algorithm>
#include <cstddef>

#include "oracle/truth/segments.hpp"

namespace contact::oracle {
namespace {

using Vertices = std::array<Point, 3>;

/// The foot of a point on the plane, where it lies in the triangle: v_0 + s u + t v with (w - s u - t v) at right
/// angles to u and v, by Cramer's rule. Nothing of a triangle without an inside.
std::optional<Point> foot_on_face(const Point& c, const Vertices& vertices) {
  const Point u = vertices[1] - vertices[0];
  const Point v = vertices[2] - vertices[0];
  const Point w = c - vertices[0];
  const Rational determinant = dot(u, u) * dot(v, v) - dot(u, v) * dot(u, v);
  if (CGAL::is_zero(determinant)) return std::nullopt;
  const Rational s = (dot(w, u) * dot(v, v) - dot(w, v) * dot(u, v)) / determinant;
  const Rational t = (dot(w, v) * dot(u, u) - dot(w, u) * dot(u, v)) / determinant;
  const Rational none(0);
  if (s < none || t < none || s + t > Rational(1)) return std::nullopt;
  return vertices[0] + s * u + t * v;
}

std::vector<Point> candidates(const Point& c, const Vertices& vertices) {
  std::vector<Point> all(vertices.begin(), vertices.end());
  for (std::size_t k = 0; k < 3; ++k)
    if (const auto q = foot(c, {vertices[k], vertices[(k + 1) % 3] - vertices[k], 0})) all.push_back(*q);
  if (const auto q = foot_on_face(c, vertices)) all.push_back(*q);
  return all;
}

}  // namespace

ExactTruth exact_truth(const BallAndTriangle& shapes, Distances distances) {
  const auto& [ball, triangle] = shapes;
  const Point c = point_of(ball.center);
  Vertices v;
  std::transform(triangle.vertices.begin(), triangle.vertices.end(), v.begin(), point_of);
  const auto squared = [&](const Point& q) { return dot(q - c, q - c); };
  const std::vector<Point> all = candidates(c, v);
  const Point q = *std::min_element(all.begin(), all.end(),
                                    [&](const Point& x, const Point& y) { return squared(x) < squared(y); });
  double largest = ball.center.cwiseAbs().maxCoeff();
  for (const Vector3& vertex : triangle.vertices) largest = std::max(largest, vertex.cwiseAbs().maxCoeff());
  const Rational scale(largest);
  Cores cores{{c, q}, {Rational(ball.radius), Rational(0)}, {scale, scale}};
  if (c == q) {
    const Point u = v[1] - v[0];
    const Point along = is_zero(u) ? v[2] - v[0] : u;
    cores.meeting = Meeting{Rational(0), {{agreed_normal(cross(u, v[2] - v[0]), along), c}}, {}};
    for (const Point& vertex : v) cores.meeting->apart.push_back(vertex - c);
  }
  return {DistanceTruth(std::move(cores), distances)};
}

Meet cores_meet(const BallAndTriangle& shapes) {
  const Vector3& c = shapes.a.center;
  const auto& [v0, v1, v2] = shapes.b.vertices;
  if (!boxes_meet({c}, {v0, v1, v2}) || surely_off_plane(v0, v1, v2, c)) return Meet::no;
  const ExactTruth truth = exact_truth(shapes, {0, 0});
  return std::get<DistanceTruth>(truth.numbers).degenerate() ? Meet::touching : Meet::no;
}

}  // namespace contact::oracle
