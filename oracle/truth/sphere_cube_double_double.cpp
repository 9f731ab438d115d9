// A sphere and a solid box in pairs of doubles: outside, the sphere pair at the nearest point of the box; inside, sums.
#include <algorithm>

#include "oracle/truth/clamped.hpp"
#include "oracle/truth/double_double.hpp"
#include "oracle/truth/double_double_oracle.hpp"

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
  const auto along = round_to_nearest(two_sum(ball.center[face->axis], face->sign * ball.radius), scalar);
  const auto value = round_to_nearest(-(two_sum(ball.radius, distances.contact) + face->depth), scalar);
  // At a radius and an alarm distance of 0 the surfaces touch where the depth is 0.
  if (!depth || !along || !value) return std::nullopt;
  Contact contact{Vector3::Zero(), ball.center, ball.center, *value, true};
  contact.normal[face->axis] = face->sign;
  contact.point1[face->axis] = *along;
  contact.point2[face->axis] = face->at;
  for (Vector3* point : {&contact.point1, &contact.point2})
    for (double& x : *point) {
      const auto rounded = round_to_nearest(DoubleDouble{x}, scalar);
      if (!rounded) return std::nullopt;
      x = *rounded;
    }
  const auto at = [&](double reach) { return *depth > 0 || reach > 0 ? -1 : 0; };
  const DoubleDouble reach = two_sum(ball.radius, distances.alarm);
  return RoundedAnswer{
      at(ball.radius + distances.alarm), at(ball.radius), {true, contact}, margin_of(-reach, reach, scalar)};
}

}  // namespace

std::optional<RoundedAnswer> double_double_answer(const BallAndBox& shapes, Distances distances, Scalar scalar) {
  const Balls balls = at_clamped(shapes);
  if (balls.a.center == balls.b.center) return inside(shapes.a, shapes.b, distances, scalar);
  return double_double_answer(balls, distances, scalar);
}

}  // namespace contact::oracle
