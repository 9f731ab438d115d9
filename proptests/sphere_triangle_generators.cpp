// Questions about a sphere and a triangle.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "golden/plain_triangles.hpp"
#include "proptests/generators.hpp"

namespace contact::proptests {
namespace {

Query triangle_of(const std::vector<double>& x) {
  return {Pair::sphere_triangle,
          BallAndTriangle{{{x[0], x[1], x[2]}, std::abs(x[3])},
                          {{Vector3(x[4], x[5], x[6]), Vector3(x[7], x[8], x[9]), Vector3(x[10], x[11], x[12])}}},
          {std::abs(x[13]), std::abs(x[14])}};
}

/// Fifteen numbers of one kind.
rc::Gen<Query> triangles_from(rc::Gen<double> number) {
  return rc::gen::map(numbers(15, std::move(number)), triangle_of);
}

Vector3 in_the_range(const Range& range, const Vector3& v) {
  return v.unaryExpr([&](double x) { return std::isfinite(x) ? range.rounded(x) : 0.0; });
}

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
      ball.center = in_the_range(range, v[0] + s * u + t * w + away * n);
      break;
    case TriangleLying::over_an_edge:
      ball.center = in_the_range(range, v[0] + s * u + away * n);
      ball.center[0] = range.moved(ball.center[0], ulps);
      break;
    case TriangleLying::over_a_vertex:
      ball.center = in_the_range(range, v[s < 0.5 ? 0 : 1] + away * n);
      ball.center[1] = range.moved(ball.center[1], ulps);
      break;
    case TriangleLying::on_it:
      ball.center = in_the_range(range, v[0] + s * u + (s + t > 1 ? 0 : t) * w);
      break;
    case TriangleLying::on_a_line:
      v[2] = in_the_range(range, v[0] + 4 * (s - t) * u);
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
  return rc::gen::map(
      rc::gen::tuple(triangles_from(std::move(number)), integer(0, 9), integer(-1, 5), integer(0, 4), integer(-1, 1)),
      [range](const std::tuple<Query, int, int, int, int>& parts) {
        const auto& [query, how, s, t, ulps] = parts;
        // Those over the triangle are as many as all others.
        return laid_triangle(range, query, static_cast<TriangleLying>(how < 8 ? how : how - 8), s / 4.0, t / 4.0, ulps);
      });
}

/// The radius is the distance as double computes it, up to 2 ulps off.
rc::Gen<Query> nearly_touching_triangles(const Range& range, rc::Gen<double> number) {
  return rc::gen::map(rc::gen::tuple(triangles_laid_out(range, std::move(number)), integer(-2, 2), integer(0, 2)),
                      [range](const std::tuple<Query, int, int>& parts) {
                        auto [query, ulps, alarm] = parts;
                        auto& [ball, triangle] = std::get<BallAndTriangle>(query.shapes);
                        const auto q = golden::nearest_point(golden::in_scalar<double>(ball.center),
                                                             golden::vertices_of<double>(triangle));
                        const Vector3 delta = golden::widened(q) - ball.center;
                        if (!delta.allFinite() || !std::isfinite(delta.stableNorm())) return query;
                        const double distance = range.rounded(delta.stableNorm());
                        query.distances.alarm = range.rounded(alarm * distance / 4);
                        ball.radius = std::max(0.0, range.moved(range.rounded(distance - query.distances.alarm), ulps));
                        return query;
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
  return rc::gen::weightedOneOf<Query>({{1, triangles_from(any_number(range))},
                                        {1, triangles_from(any_bits(range))},
                                        {1, triangles_from(subnormal(range))},
                                        {1, triangles_from(extreme(range))},
                                        {1, triangles_from(huge(range))},
                                        {1, triangles_from(ordinary(range))},
                                        {2, triangles_from(small_dyadic(range))},
                                        {2, triangles_laid_out(range, any_number(range))},
                                        {2, triangles_laid_out(range, ordinary(range))},
                                        {4, triangles_laid_out(range, small_dyadic(range))},
                                        {1, nearly_touching_triangles(range, any_bits(range))},
                                        {1, nearly_touching_triangles(range, subnormal(range))},
                                        {2, touching_triangles(range)},
                                        {3, nearly_touching_triangles(range, small_dyadic(range))},
                                        {3, nearly_touching_triangles(range, ordinary(range))}});
}

}  // namespace contact::proptests
