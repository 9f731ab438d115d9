// What the peers are held against: plain double as upstream has it, and production, one pair after the other.
#include <cmath>
#include <concepts>

#include "contact/capsule_capsule.hpp"
#include "contact/capsule_plane.hpp"
#include "contact/cube_cube.hpp"
#include "contact/pair_functions.hpp"
#include "contact/ray_sphere.hpp"
#include "contact/ray_triangle.hpp"
#include "contact/sphere_capsule.hpp"
#include "contact/sphere_cube.hpp"
#include "contact/sphere_plane.hpp"
#include "contact/sphere_sphere.hpp"
#include "contact/sphere_triangle.hpp"
#include "contact/triangle_line.hpp"
#include "golden/plain_crossings.hpp"
#include "golden/plain_planes.hpp"
#include "peers/peers.hpp"

namespace contact::bench {
namespace {

constexpr Distances kNone{.alarm = 0, .contact = 0};

/// A sphere's centre in a box: out through the nearest face.
void contact_inside(const Ball& ball, const Box& box, Contact& out) {
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
  out = {Vector3::Zero(), ball.center, ball.center, -depth - ball.radius, true};
  out.normal[axis] = sign;
  out.point1[axis] += sign * ball.radius;
  out.point2[axis] = sign > 0 ? box.min[axis] : box.max[axis];
}

struct Plain {
  static double distance2(const Balls& p, Vector3& delta) {
    delta = p.b.center - p.a.center;
    return delta[0] * delta[0] + delta[1] * delta[1] + delta[2] * delta[2];
  }
  static bool test(const Balls& p) {
    Vector3 delta;
    const double reach = p.a.radius + p.b.radius;
    return distance2(p, delta) <= reach * reach;
  }
  static bool compute(const Balls& p, Contact& out) {
    Vector3 delta;
    const double d2 = distance2(p, delta);
    const double reach = p.a.radius + p.b.radius;
    if (!(d2 <= reach * reach)) return false;
    const double s = std::sqrt(d2);
    const Vector3 n(delta[0] / s, delta[1] / s, delta[2] / s);
    out = {n, p.a.center + p.a.radius * n, p.b.center - p.b.radius * n, s - reach, false};
    return true;
  }
  static bool test(const Boxes& p) {
    return p.a.min[0] <= p.b.max[0] && p.b.min[0] <= p.a.max[0] && p.a.min[1] <= p.b.max[1] &&
           p.b.min[1] <= p.a.max[1] && p.a.min[2] <= p.b.max[2] && p.b.min[2] <= p.a.max[2];
  }
  // A capsule and a ray by the clamped foot, two capsules and a triangle as Ericson has them.
  static Vector3 on_segment(const golden::Segment<double>& segment, const Vector3& point) {
    return golden::widened(segment.at(segment.part_at(golden::in_scalar<double>(point))));
  }
  static Balls at_nearest(const BallAndCapsule& p) {
    return {p.a, {on_segment(golden::segment_of<double>(p.b), p.a.center), p.b.radius}};
  }
  static Balls at_nearest(const RayAndBall& p) {
    return {{on_segment(golden::segment_of<double>(p.a), p.b.center), 0}, p.b};
  }
  static Balls at_nearest(const Capsules& p) {
    const auto a = golden::segment_of<double>(p.a);
    const auto b = golden::segment_of<double>(p.b);
    return golden::at_nearest(golden::nearest_points(a, b), a.radius, b.radius);
  }
  static Balls at_nearest(const BallAndTriangle& p) {
    const auto c = golden::in_scalar<double>(p.a.center);
    return {p.a, {golden::widened(golden::nearest_point(c, golden::vertices_of<double>(p.b))), 0}};
  }
  template <class A, class B>
  requires requires(const Two<A, B>& p) { at_nearest(p); }
  static bool test(const Two<A, B>& p) { return test(at_nearest(p)); }
  template <class A, class B>
  requires requires(const Two<A, B>& p) { at_nearest(p); }
  static bool compute(const Two<A, B>& p, Contact& out) { return compute(at_nearest(p), out); }
  template <class A>
  static bool test(const Two<A, Plane>& p) {
    return golden::OverPlainPlane<double>(golden::segment_of<double>(p.a), p.b).overlap(kNone);
  }
  template <class A>
  static bool compute(const Two<A, Plane>& p, Contact& out) {
    return write(golden::OverPlainPlane<double>(golden::segment_of<double>(p.a), p.b).contact(kNone, {}), out);
  }
  static bool test(const RayAndTriangle& p) { return golden::plain_crossing(p, Scalar::binary64).has_value(); }
  static bool test(const TriangleAndLine& p) { return golden::plain_crossing(p, Scalar::binary64).has_value(); }
  static bool compute(const RayAndTriangle& p, Contact& out) {
    return write(golden::plain_crossing(p, Scalar::binary64), out);
  }
  static bool compute(const TriangleAndLine& p, Contact& out) {
    return write(golden::plain_crossing(p, Scalar::binary64), out);
  }
  static bool write(const std::optional<Contact>& contact, Contact& out) {
    if (contact) out = *contact;
    return contact.has_value();
  }
  static Balls at_nearest(const BallAndBox& p) { return {p.a, {p.a.center.cwiseMax(p.b.min).cwiseMin(p.b.max), 0}}; }
  static bool test(const BallAndBox& p) { return test(at_nearest(p)); }
  static bool compute(const BallAndBox& p, Contact& out) {
    const Balls balls = at_nearest(p);
    if (balls.a.center != balls.b.center) return compute(balls, out);
    contact_inside(p.a, p.b, out);
    return true;
  }
};

/// By their names: inline they decide what plain arithmetic is certain of.
struct Production {
  static bool test(const Balls& p) { return test_sphere_sphere(p.a, p.b, 0); }
  static bool test(const Boxes& p) { return test_cube_cube(p.a, p.b, 0); }
  static bool test(const BallAndBox& p) { return test_sphere_cube(p.a, p.b, 0); }
  static bool test(const BallAndCapsule& p) { return test_sphere_capsule(p.a, p.b, 0); }
  static bool test(const Capsules& p) { return test_capsule_capsule(p.a, p.b, 0); }
  static bool test(const BallAndTriangle& p) { return test_sphere_triangle(p.a, p.b, 0); }
  static bool test(const RayAndBall& p) { return test_ray_sphere(p.a, p.b, 0); }
  static bool test(const BallAndPlane& p) { return test_sphere_plane(p.a, p.b, 0); }
  static bool test(const CapsuleAndPlane& p) { return test_capsule_plane(p.a, p.b, 0); }
  static bool test(const RayAndTriangle& p) { return test_ray_triangle(p.a, p.b); }
  static bool test(const TriangleAndLine& p) { return test_triangle_line(p.a, p.b); }
  template <class A, class B>
  static bool test(const Two<A, B>& p) {
    return is_hit(p, kNone);
  }
  /// Nothing is kept of a hull.
  struct Made {
    explicit Made(const Convexes& p) : pair(p) {}
    const Convexes& pair;
  };
  static constexpr bool kHasPlanes = true;
  static bool test(const Made& p) { return test(p.pair); }
  static bool compute(const Made& p, Contact& out) { return compute(p.pair, out); }
  static std::optional<Contact> contact_between(const Balls& p) { return compute_sphere_sphere(p.a, p.b, kNone); }
  static std::optional<Contact> contact_between(const BallAndBox& p) { return compute_sphere_cube(p.a, p.b, kNone); }
  static std::optional<Contact> contact_between(const BallAndCapsule& p) {
    return compute_sphere_capsule(p.a, p.b, kNone);
  }
  static std::optional<Contact> contact_between(const Capsules& p) { return compute_capsule_capsule(p.a, p.b, kNone); }
  static std::optional<Contact> contact_between(const BallAndTriangle& p) {
    return compute_sphere_triangle(p.a, p.b, kNone);
  }
  static std::optional<Contact> contact_between(const RayAndBall& p) { return compute_ray_sphere(p.a, p.b, kNone); }
  static std::optional<Contact> contact_between(const BallAndPlane& p) { return compute_sphere_plane(p.a, p.b, kNone); }
  static std::optional<Contact> contact_between(const CapsuleAndPlane& p) {
    return compute_capsule_plane(p.a, p.b, kNone);
  }
  static std::optional<Contact> contact_between(const RayAndTriangle& p) { return compute_ray_triangle(p.a, p.b); }
  static std::optional<Contact> contact_between(const TriangleAndLine& p) { return compute_triangle_line(p.a, p.b); }
  template <class A, class B>
  static std::optional<Contact> contact_between(const Two<A, B>& p) {
    return contact_of(p, kNone);
  }
  template <class A, class B>
  requires(!std::same_as<A, Box>) static bool compute(const Two<A, B>& p, Contact& out) {
    const std::optional<Contact> contact = contact_between(p);
    if (contact) out = *contact;
    return contact.has_value();
  }
};

}  // namespace

std::vector<Peer> own_peers() {
  return {make_peer("plain double", {}, false, std::make_shared<Plain>()),
          make_peer("ours, scalar", {}, false, std::make_shared<Production>())};
}

}  // namespace contact::bench
