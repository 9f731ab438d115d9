// A sphere and a triangle, exactly: the centre, and the point of the triangle that is nearest to it.
#include <algorithm>

#include "oracle/truth/segments.hpp"
#include "oracle/truth/triangles.hpp"

namespace contact::oracle {

ExactTruth exact_truth(const BallAndTriangle& shapes, Distances distances) {
  const auto& [ball, triangle] = shapes;
  const Point c = point_of(ball.center);
  const Vertices v = vertices_of(triangle);
  const Point q = nearest_on_triangle(c, v);
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
