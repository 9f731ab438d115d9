// A sphere and a triangle in pairs of doubles: the foot on the face where its two coordinates there say so, else the
// nearest of the feet on the edges.
#include "oracle/truth/double_double_segments.hpp"

namespace contact::oracle {
namespace {

/// Of the face; nothing where that is not certain, and `beside` where the foot is surely not within.
std::optional<DoubleDoubleNearest> on_face(const Vector3& c, const Triangle& triangle, bool& beside) {
  const auto& [v0, v1, v2] = triangle.vertices;
  const DoubleDoubles u = difference(v1, v0);
  const DoubleDoubles v = difference(v2, v0);
  const DoubleDoubles w = difference(c, v0);
  const DoubleDouble A = dot(u, u);
  const DoubleDouble B = dot(u, v);
  const DoubleDouble E = dot(v, v);
  const DoubleDouble d = dot(w, u);
  const DoubleDouble f = dot(w, v);
  const DoubleDouble determinant = A * E - B * B;
  if (!(determinant.high > 0 && determinant.radius < determinant.high * 0x1p-20)) return std::nullopt;
  const DoubleDouble s = d * E - f * B;
  const DoubleDouble t = f * A - d * B;
  const auto s_sign = s.sign();
  const auto t_sign = t.sign();
  const auto rest_sign = (determinant - s - t).sign();
  beside = s_sign == -1 || t_sign == -1 || rest_sign == -1;
  if (beside || !s_sign || !t_sign || !rest_sign) return std::nullopt;
  const DoubleDouble over = reciprocal(determinant);
  DoubleDoubleNearest nearest{exactly(c), exactly(v0), {}};
  for (std::size_t i = 0; i < 3; ++i) {
    const DoubleDouble along = (s * u[i] + t * v[i]) * over;
    nearest.q[i] = nearest.q[i] + along;
    nearest.delta[i] = along - w[i];
  }
  return nearest;
}

std::optional<DoubleDoubleNearest> nearest_of(const Vector3& c, const Triangle& triangle) {
  bool beside = false;
  std::optional<DoubleDoubleNearest> best = on_face(c, triangle, beside);
  if (!beside) return best;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto found = foot(c, segment_between(triangle.vertices[k], triangle.vertices[(k + 1) % 3]));
    if (!found || !keep_nearer(best, *found)) return std::nullopt;
  }
  return best;
}

}  // namespace

std::optional<RoundedAnswer> double_double_answer(const BallAndTriangle& shapes, Distances distances, Scalar scalar) {
  const auto& [ball, triangle] = shapes;
  const auto& [v0, v1, v2] = triangle.vertices;
  if (!in_short_range({ball.center, v0}) || !in_short_range({v1, v2})) return std::nullopt;
  return case_of_apart(nearest_of(ball.center, triangle), ball.radius, 0, distances, scalar);
}

}  // namespace contact::oracle
