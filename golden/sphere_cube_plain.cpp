// A sphere and a box in plain arithmetic: outside, two spheres, the second the clamped centre without extent.
#include <array>
#include <limits>

#include "golden/plain.hpp"
#include "oracle/truth/clamped.hpp"

namespace contact::golden {
namespace {

/// The contact of a centre inside: out through the nearest face.
template <class Real>
Contact inside(const BallAndBox& shapes, Distances distances, ContactPoints points) {
  const auto& [ball, box] = shapes;
  Eigen::Index axis = 0;
  Real sign = 1;
  Real depth = std::numeric_limits<Real>::infinity();
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Real c = static_cast<Real>(ball.center[i]);
    const std::array<Real, 2> depths{c - static_cast<Real>(box.min[i]), static_cast<Real>(box.max[i]) - c};
    for (std::size_t side = 0; side < 2; ++side)
      if (depths[side] < depth) {
        axis = i;
        sign = side == 0 ? Real{1} : Real{-1};
        depth = depths[side];
      }
  }
  const Real radius = static_cast<Real>(ball.radius);
  Contact contact{Vector3::Zero(), ball.center, ball.center, 0, true};
  contact.normal[axis] = static_cast<double>(sign);
  const Real along = outward(points.first, sign);
  contact.point1[axis] = static_cast<double>(static_cast<Real>(ball.center[axis]) + along * radius);
  contact.point2[axis] = sign > 0 ? box.min[axis] : box.max[axis];
  contact.value = static_cast<double>((-depth - radius) - static_cast<Real>(distances.contact));
  return contact;
}

}  // namespace

bool plain_overlap(const BallAndBox& shapes, Distances distances, Scalar scalar) {
  return plain_overlap(at_clamped(shapes), distances, scalar);
}

std::optional<Contact> plain_contact(const BallAndBox& shapes, Distances distances, Scalar scalar,
                                     ContactPoints points) {
  const Balls balls = at_clamped(shapes);
  if (balls.a.center != balls.b.center) return plain_contact(balls, distances, scalar, points);
  return scalar == Scalar::binary32 ? inside<float>(shapes, distances, points)
                                    : inside<double>(shapes, distances, points);
}

}  // namespace contact::golden
