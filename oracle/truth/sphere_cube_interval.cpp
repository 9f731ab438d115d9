// A sphere and a solid box in intervals: on each axis the sign of two gaps tells where the centre is.
#include <cstddef>

#include "oracle/truth/interval.hpp"

namespace contact::oracle {
namespace {

/// A face of the box with the centre inside, `depth` below it.
struct Face {
  std::size_t axis;
  int sign;  ///< of the way from it into the box
  double at;
  Interval depth;
};

Face nearest_face(const Ball& ball, const Box& box, mpfr_prec_t precision) {
  const Triple c = triple(precision, ball.center);
  std::vector<Face> faces;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    faces.push_back({axis, 1, box.min[i], c[axis] - Interval(precision, box.min[i])});
    faces.push_back({axis, -1, box.max[i], Interval(precision, box.max[i]) - c[axis]});
  }
  // The first of those that none is nearer than.
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < faces.size(); ++i)
    if (settled((faces[i].depth - faces[nearest].depth).sign()) < 0) nearest = i;
  return faces[nearest];
}

}  // namespace

RoundedAnswer interval_answer(const BallAndBox& shapes, Distances distances, Scalar scalar, mpfr_prec_t precision) {
  const auto& [ball, box] = shapes;
  const Interval radius(precision, ball.radius);
  Vector3 q = ball.center;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Interval c(precision, ball.center[axis]);
    if (settled((Interval(precision, box.min[axis]) - c).sign()) > 0) q[axis] = box.min[axis];
    if (settled((c - Interval(precision, box.max[axis])).sign()) > 0) q[axis] = box.max[axis];
  }
  RoundedAnswer answer =
      answer_of_nearest(nearest_of_points(triple(precision, ball.center), triple(precision, q), precision), radius,
                        Interval(precision, 0), distances, scalar, precision);
  if (!answer.expected.contact || !answer.expected.contact->degenerate) return answer;

  const Face face = nearest_face(ball, box, precision);
  if (settled(face.depth.sign()) > 0) answer.at_alarm = answer.at_zero = -1;
  const auto i = static_cast<Eigen::Index>(face.axis);
  Contact& contact = *answer.expected.contact;
  const Interval c(precision, ball.center[i]);
  const auto rounded = [&](const Interval& x) { return settled(x.rounded(scalar)); };
  contact.normal = Vector3::Unit(i) * face.sign + Vector3::Zero();
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    contact.point1[axis] = contact.point2[axis] = rounded(Interval(precision, ball.center[axis]));
  contact.point1[i] = rounded(face.sign > 0 ? c + radius : c - radius);
  contact.point2[i] = rounded(Interval(precision, face.at));
  contact.value =
      settled((Interval(precision, 0) - radius - face.depth - Interval(precision, distances.contact)).rounded(scalar));
  return answer;
}

}  // namespace contact::oracle
