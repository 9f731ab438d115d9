// What everyone ships, as fast as it goes: plain double arithmetic over structures of arrays, with the same vectors as
// the batch kernels, for comparison. Its answers are wrong near the boundary.
#pragma once

#include <optional>

#include "contact/pairs.hpp"
#include "kernel/batch.hpp"

namespace contact::bench {

/// One pair after the other over an array of structures, as the compiler makes it.
struct PlainContact {
  Contact contact;
  bool hit;
};

#define CONTACT_TEST(name, A, B) \
  void plain_test(const kernel::PairColumns<A, B>& pairs, double alarm, std::uint8_t* hit);
#define CONTACT_COMPUTE(name, A, B)                                                                                 \
  void plain_compute(const kernel::PairColumns<A, B>& pairs, Distances distances, const kernel::ContactRows& out);  \
  std::size_t plain_compute_hits(const kernel::PairColumns<A, B>& pairs, Distances distances, std::uint32_t* index, \
                                 const kernel::ContactRows& out);
CONTACT_BATCH_PAIRS(CONTACT_TEST)
CONTACT_BATCH_CONTACTS(CONTACT_COMPUTE)
#undef CONTACT_TEST
#undef CONTACT_COMPUTE

/// The kinds that have these, one pair after the other. The last is the function of one pair, as production's is called.
#define CONTACT_PLAIN_SCALAR(X)    \
  X(sphere_sphere, Ball, Ball)     \
  X(sphere_cube, Ball, Box)        \
  X(sphere_capsule, Ball, Capsule) \
  X(capsule_capsule, Capsule, Capsule)
#define CONTACT_SCALAR(name, A, B)                                                                             \
  void plain_compute_scalar(const Two<A, B>* pairs, std::size_t size, Distances distances, PlainContact* out); \
  std::optional<Contact> plain_contact_of_pair(const Two<A, B>& pair, Distances distances);
CONTACT_PLAIN_SCALAR(CONTACT_SCALAR)
#undef CONTACT_SCALAR

/// A sphere's centre in a box: out through the nearest face.
inline void plain_contact_inside(const Ball& ball, const Box& box, double contact_distance, Contact& out) {
  Eigen::Index axis = 0;
  double depth = ball.center[0] - box.min[0];
  double sign = 1;
  const auto nearer = [&](double other, Eigen::Index on, double towards) {
    if (!(other < depth)) return;
    depth = other;
    axis = on;
    sign = towards;
  };
  nearer(box.max[0] - ball.center[0], 0, -1);
  for (Eigen::Index k = 1; k < 3; ++k) {
    nearer(ball.center[k] - box.min[k], k, 1);
    nearer(box.max[k] - ball.center[k], k, -1);
  }
  out = {Vector3::Zero(), ball.center, ball.center, -depth - ball.radius - contact_distance, true};
  out.normal[axis] = sign;
  out.point1[axis] += sign * ball.radius;
  out.point2[axis] = sign > 0 ? box.min[axis] : box.max[axis];
}

}  // namespace contact::bench
