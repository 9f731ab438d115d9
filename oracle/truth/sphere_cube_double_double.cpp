// A sphere and a solid box in pairs of doubles: outside, the sphere pair at the nearest point of the box; inside, sums.
#include <algorithm>
#include <cstddef>

#include "oracle/truth/clamped.hpp"
#include "oracle/truth/double_double_nearest.hpp"

namespace contact::oracle {
namespace {

// Sums of four stay below the largest finite number.
constexpr double kLargestOfSums = 0x1p1000;

/// A face of the box with the centre inside, `depth` below it.
struct Face {
  Eigen::Index axis;
  double sign;  ///< of the way from it into the box
  double at;
  DoubleDouble depth;
};

/// The first of the nearest faces; nothing where the stage cannot tell.
std::optional<Face> nearest_face(const Vector3& c, const Box& box) {
  std::optional<Face> nearest;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    for (const Face& face : {Face{axis, 1, box.min[axis], two_sum(c[axis], -box.min[axis])},
                             Face{axis, -1, box.max[axis], two_sum(box.max[axis], -c[axis])}}) {
      const auto order = nearest ? (face.depth - nearest->depth).sign() : std::optional(-1);
      if (!order) return std::nullopt;
      if (*order < 0) nearest = face;
    }
  return nearest;
}

std::optional<RoundedAnswer> inside(const Ball& ball, const Box& box, Distances distances, Scalar scalar) {
  const auto most = [](const Vector3& v) { return v.array().abs().maxCoeff(); };
  if (!(std::max({most(box.min), most(box.max), ball.radius, distances.contact}) <= kLargestOfSums))
    return std::nullopt;
  const auto face = nearest_face(ball.center, box);
  if (!face) return std::nullopt;
  const auto depth = face->depth.sign();
  if (!depth) return std::nullopt;
  const double r = ball.radius;
  // At a radius and an alarm distance of 0 the surfaces touch where the depth is 0.
  const auto at = [&](double reach) { return *depth > 0 || reach > 0 ? -1 : 0; };
  const DoubleDoubles c = exactly(ball.center);
  DoubleDoubleAlong found{c, c, {}, -face->depth, at(r + distances.alarm), at(r), true, true};
  const auto axis = static_cast<std::size_t>(face->axis);
  found.normal[axis] = {face->sign};
  found.q[axis] = {face->at};
  found.past_reach = -two_sum(r, distances.alarm);
  return case_along(found, r, 0, distances, scalar);
}

}  // namespace

std::optional<RoundedAnswer> double_double_answer(const BallAndBox& shapes, Distances distances, Scalar scalar) {
  const Balls balls = at_clamped(shapes);
  if (balls.a.center == balls.b.center) return inside(shapes.a, shapes.b, distances, scalar);
  return double_double_answer(balls, distances, scalar);
}

}  // namespace contact::oracle
