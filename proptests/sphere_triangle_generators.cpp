// Questions about a sphere and a triangle.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "proptests/generators.hpp"

namespace contact::proptests {
namespace {

/// How the centre lies to the triangle, or the triangle's vertices to each other.
enum class TriangleLying {
  over_the_face,
  over_an_edge,
  over_a_vertex,
  on_it,
  on_a_line,
  two_points,
  one_point,
  needle
};

/// What is exact for small integers is nearly so for other numbers.
Query laid_triangle(const Range& range, Query query, TriangleLying lying, double s, double t, int ulps) {
  auto& [ball, triangle] = std::get<BallAndTriangle>(query.shapes);
  auto& v = triangle.vertices;
  const Vector3 u = v[1] - v[0];
  const Vector3 w = v[2] - v[0];
  const Vector3 n = u.cross(w);
  const double away = std::fmod(ball.center[0], 4);
  switch (lying) {
    case TriangleLying::over_the_face:
      ball.center = range.rounded(v[0] + s * u + t * w + away * n);
      break;
    case TriangleLying::over_an_edge:
      ball.center = range.rounded(v[0] + s * u + away * n);
      ball.center[0] = range.moved(ball.center[0], ulps);
      break;
    case TriangleLying::over_a_vertex:
      ball.center = range.rounded(v[s < 0.5 ? 0 : 1] + away * n);
      ball.center[1] = range.moved(ball.center[1], ulps);
      break;
    case TriangleLying::on_it:
      ball.center = range.rounded(v[0] + s * u + (s + t > 1 ? 0 : t) * w);
      break;
    case TriangleLying::on_a_line:
      v[2] = range.rounded(v[0] + 4 * (s - t) * u);
      v[2][2] = range.moved(v[2][2], ulps);
      break;
    case TriangleLying::two_points:
      v[2] = v[s < 0.5 ? 0 : 1];
      break;
    case TriangleLying::one_point:
      v[2] = v[1] = v[0];
      if (t == 0) ball.center = v[0];
      break;
    case TriangleLying::needle:
      v[2] = v[0];
      v[2][0] = range.moved(v[2][0], ulps);
      v[2][1] = range.moved(v[2][1], -ulps);
      break;
  }
  return query;
}

rc::Gen<Query> triangles_laid_out(const Range& range, rc::Gen<double> number) {
  return rc::gen::map(rc::gen::tuple(made_of(Pair::sphere_triangle, std::move(number)), integer(0, 9), integer(-1, 5),
                                     integer(0, 4), integer(-1, 1)),
                      [range](const std::tuple<Query, int, int, int, int>& parts) {
                        const auto& [query, how, s, t, ulps] = parts;
                        // Those over the triangle are as many as all others.
                        return laid_triangle(range, query, static_cast<TriangleLying>(how < 8 ? how : how - 8), s / 4.0,
                                             t / 4.0, ulps);
                      });
}

/// A triangle that a sphere reaches exactly, at alarm 0 or by an alarm distance: in the plane at right angles to a
/// quadruple, around its end or with a vertex or an edge there, on integers times a power of two.
rc::Gen<Query> touching_triangles(const Range& range) {
  return rc::gen::map(
      rc::gen::tuple(rc::gen::elementOf(kQuadruples), rc::gen::container<std::vector<int>>(9, integer(0, 9)),
                     integer(range.bottom, std::max(range.bottom, range.top - 14))),
      [](const std::tuple<Quadruple, std::vector<int>, int>& parts) {
        const auto& [quadruple, k, exponent] = parts;
        const Vector3 delta(quadruple[0], k[0] < 5 ? quadruple[1] : -quadruple[1], quadruple[2]);
        const int axis = delta[0] == 0 && delta[1] == 0 ? 0 : 2;
        const Vector3 u = delta.cross(Vector3::Unit(axis));
        const Vector3 v = delta.cross(Vector3::Unit(1));
        const Vector3 q(k[1], k[2], k[3]);
        // A weight of 0 puts the vertex at the end of the quadruple, two put an edge through it.
        std::array<Vector3, 3> vertices{q + k[4] * u, q + k[5] * v, q - (k[4] == 0 ? 0 : k[6]) * u - k[7] * v};
        std::rotate(vertices.begin(), vertices.begin() + k[8] % 3, vertices.end());
        const double alarm = k[0] % 2 == 0 ? 0 : quadruple[3] / 2.0;
        const double unit = std::ldexp(1.0, exponent);
        for (Vector3& vertex : vertices) vertex *= unit;
        return Query{Pair::sphere_triangle,
                     BallAndTriangle{{unit * (q - delta), unit * (quadruple[3] - alarm)}, {vertices}},
                     {unit * alarm, unit * k[8]}};
      });
}

}  // namespace

rc::Gen<Query> queries(const BallAndTriangle* /*kind*/, const Range& range) {
  return at_every_scale(
      Pair::sphere_triangle, range,
      [&](rc::Gen<double> number) { return triangles_laid_out(range, std::move(number)); }, touching_triangles(range));
}

}  // namespace contact::proptests
