// libccd: Minkowski portal refinement and GJK on the support functions of a sphere and a box.
#include <ccd/ccd.h>

#include <Eigen/Geometry>

#include <cmath>
#include <concepts>

#include "engines/adapters/libccd.hpp"
#include "peers/adapted.hpp"
#include "peers/peers.hpp"

#ifndef CCD_DOUBLE
#error "libccd is compared in double precision"
#endif

namespace contact::bench {
namespace {

/// Its functions of a shape.
template <class Shape>
constexpr bool kHasSupport = std::same_as<Shape, Ball> || std::same_as<Shape, Box>;

template <class Shape>
struct Support;
template <>
struct Support<Ball> {
  static void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* point) {
    const auto& ball = *static_cast<const Ball*>(object);
    const ccd_real_t* d = direction->v;
    const double scale = ball.radius / std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int k = 0; k < 3; ++k) point->v[k] = ball.center[k] + scale * d[k];
  }
  static void center(const void* object, ccd_vec3_t* point) {
    for (int k = 0; k < 3; ++k) point->v[k] = static_cast<const Ball*>(object)->center[k];
  }
};
template <>
struct Support<Box> {
  static void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* point) {
    const auto& box = *static_cast<const Box*>(object);
    for (int k = 0; k < 3; ++k) point->v[k] = direction->v[k] < 0 ? box.min[k] : box.max[k];
  }
  static void center(const void* object, ccd_vec3_t* point) {
    const auto& box = *static_cast<const Box*>(object);
    for (int k = 0; k < 3; ++k) point->v[k] = 0.5 * (box.min[k] + box.max[k]);
  }
};

/// A rotated box by its axes, as its users keep it.
struct Turned {
  explicit Turned(const Obb& box) : center(box.center), half(box.extents) {
    const auto& [x, y, z, w] = box.orientation;
    axes = Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
  }
  Vector3 center;
  Vector3 half;
  Eigen::Matrix3d axes;
};
template <>
struct Support<Turned> {
  static void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* point) {
    const auto& box = *static_cast<const Turned*>(object);
    Vector3 at = box.center;
    for (int axis = 0; axis < 3; ++axis) {
      const double along = box.axes.col(axis).dot(Vector3(direction->v[0], direction->v[1], direction->v[2]));
      at += (along < 0 ? -box.half[axis] : box.half[axis]) * box.axes.col(axis);
    }
    for (int k = 0; k < 3; ++k) point->v[k] = at[k];
  }
  static void center(const void* object, ccd_vec3_t* point) {
    for (int k = 0; k < 3; ++k) point->v[k] = static_cast<const Turned*>(object)->center[k];
  }
};

template <class Shape, class First = Ball>
ccd_t settings() {
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = Support<First>::support;
  ccd.support2 = Support<Shape>::support;
  ccd.center1 = Support<First>::center;
  ccd.center2 = Support<Shape>::center;
  ccd.max_iterations = 100;  // by default no limit, and then some questions are never answered
  return ccd;
}
template <class Shape>
const ccd_t kSettings = settings<Shape>();
const ccd_t kOfBoxes = settings<Turned, Turned>();

const ccd_t kOfHulls = adapters::ccd_settings();

/// Of a hull, by its vertices.
struct WithHull {
  explicit WithHull(const Convexes& p) : first(p.a), second(p.b), a(first.shape()), b(second.shape()) {}
  Adapted first;
  Adapted second;
  adapters::Shape a;
  adapters::Shape b;
};

struct Mpr {
  template <class Shape>
  requires kHasSupport<Shape>
  static bool test(const Two<Ball, Shape>& p) { return ccdMPRIntersect(&p.a, &p.b, &kSettings<Shape>) != 0; }
  template <class Shape>
  requires kHasSupport<Shape>
  static bool compute(const Two<Ball, Shape>& p, Contact& out) { return penetration(p.a, p.b, kSettings<Shape>, out); }
  static bool test(const Convexes& p) {
    const auto [a, b] = obbs(p);
    const Turned first(a);
    const Turned second(b);
    return ccdMPRIntersect(&first, &second, &kOfBoxes) != 0;
  }
  static bool compute(const Convexes& p, Contact& out) {
    const auto [a, b] = obbs(p);
    const Turned first(a);
    const Turned second(b);
    return penetration(first, second, kOfBoxes, out);
  }
  using Made = WithHull;
  static constexpr bool kHasPlanes = false;
  static bool test(const Made& p) { return ccdMPRIntersect(&p.a, &p.b, &kOfHulls) != 0; }
  static bool compute(const Made& p, Contact& out) { return penetration(p.a, p.b, kOfHulls, out); }

 private:
  template <class A, class B>
  static bool penetration(const A& a, const B& b, const ccd_t& settings, Contact& out) {
    ccd_vec3_t direction;
    ccd_vec3_t position;
    if (ccdMPRPenetration(&a, &b, &settings, &out.value, &direction, &position) != 0) return false;
    out.normal = {direction.v[0], direction.v[1], direction.v[2]};
    out.point1 = {position.v[0], position.v[1], position.v[2]};
    return true;
  }
};

struct Gjk {
  template <class Shape>
  requires kHasSupport<Shape>
  static bool test(const Two<Ball, Shape>& p) { return ccdGJKIntersect(&p.a, &p.b, &kSettings<Shape>) != 0; }
  using Made = WithHull;
  static constexpr bool kHasPlanes = false;
  static bool test(const Made& p) { return ccdGJKIntersect(&p.a, &p.b, &kOfHulls) != 0; }
};

}  // namespace

std::vector<Peer> ccd_peers() {
  // Its point is where a force should act, which is not said to be any point of ours.
  const Conventions conventions{.points = Points::none, .value = ValueKind::depth, .margin = Margin::none};
  return {make_peer("libccd, MPR", conventions, false, std::make_shared<Mpr>()),
          make_peer("libccd, GJK", conventions, true, std::make_shared<Gjk>())};
}

}  // namespace contact::bench
