// ODE: dCollide on two geometries: spheres, boxes, capsules and planes.
#include <ode/ode.h>

#include <cmath>
#include <concepts>
#include <optional>

#include "engines/adapters/ode_convex.hpp"
#include "peers/adapted.hpp"
#include "peers/peers.hpp"

#ifndef dDOUBLE
#error "ODE is compared in double precision"
#endif

namespace contact::bench {
namespace {

/// One geometry of each kind, moved and resized from question to question.
struct Geometries {
  int started = dInitODE2(0);
  dGeomID sphere = dCreateSphere(nullptr, 1);
  dGeomID box = dCreateBox(nullptr, 1, 1, 1);
  dGeomID capsule = dCreateCapsule(nullptr, 1, 1);
  dGeomID plane = dCreatePlane(nullptr, 0, 0, 1, 0);

  [[nodiscard]] dGeomID set(const Ball& ball) const {
    dGeomSphereSetRadius(sphere, ball.radius);
    dGeomSetPosition(sphere, ball.center[0], ball.center[1], ball.center[2]);
    return sphere;
  }
  [[nodiscard]] dGeomID set(const Box& bounds) const {
    const Vector3 size = bounds.max - bounds.min;
    const Vector3 center = 0.5 * (bounds.min + bounds.max);
    dGeomBoxSetLengths(box, size[0], size[1], size[2]);
    dGeomSetPosition(box, center[0], center[1], center[2]);
    return box;
  }
  [[nodiscard]] dGeomID set(const Obb& given) const {
    const auto& [x, y, z, w] = given.orientation;
    const double length = std::sqrt(x * x + y * y + z * z + w * w);
    const dQuaternion turned{w / length, x / length, y / length, z / length};
    dGeomBoxSetLengths(box, 2 * given.extents[0], 2 * given.extents[1], 2 * given.extents[2]);
    dGeomSetQuaternion(box, turned);
    dGeomSetPosition(box, given.center[0], given.center[1], given.center[2]);
    return box;
  }
  [[nodiscard]] dGeomID set(const Capsule& given) const {
    const Vector3 along = given.end - given.start;
    const Vector3 center = 0.5 * (given.start + given.end);
    dMatrix3 turned;
    dRFromZAxis(turned, along[0], along[1], along[2]);
    dGeomCapsuleSetParams(capsule, given.radius, along.norm());
    dGeomSetRotation(capsule, turned);
    dGeomSetPosition(capsule, center[0], center[1], center[2]);
    return capsule;
  }
  [[nodiscard]] dGeomID set(const Plane& given) const {
    dGeomPlaneSetParams(plane, given.normal[0], given.normal[1], given.normal[2], given.offset);  // makes it a unit one
    return plane;
  }
};

class Ode {
 public:
  template <class A, class B>
  requires requires(const Geometries& made, const Two<A, B>& p) { made.set(p.a), made.set(p.b); }
  bool test(const Two<A, B>& p) { return dCollide(a_.set(p.a), b_.set(p.b), 1, &found_, sizeof found_) > 0; }
  template <class A, class B>
  requires(!std::same_as<A, Box> && requires(const Geometries& made, const Two<A, B>& p) {
    made.set(p.a), made.set(p.b);
  }) bool compute(const Two<A, B>& p, Contact& out) {
    return test(p) && write(out);
  }
  // Two rotated boxes.
  bool test(const Convexes& p) { return test(obbs(p)); }
  bool compute(const Convexes& p, Contact& out) { return compute(obbs(p), out); }
  /// Of a hull, with the faces that Qhull finds.
  struct Made {
    explicit Made(const Convexes& p) : a(p.a), b(p.b) {}
    struct Placed {
      explicit Placed(const Convex& shape) {
        if (std::holds_alternative<Hull>(shape.shape)) {
          geom = hull.emplace(*adapters::polyhedron_of(Adapted(shape).shape())).geom;
          return;
        }
        const auto set = [this](const auto& given) -> dGeomID {
          if constexpr (requires { others.set(given); }) return others.set(given);
          return nullptr;
        };
        geom = std::visit(set, shape.shape);
      }
      Geometries others;
      std::optional<adapters::Convex> hull;
      dGeomID geom;
    };
    Placed a;
    Placed b;
  };
  static constexpr bool kHasPlanes = true;
  bool test(const Made& p) { return dCollide(p.a.geom, p.b.geom, 1, &found_, sizeof found_) > 0; }
  bool compute(const Made& p, Contact& out) { return test(p) && write(out); }

 private:
  bool write(Contact& out) const {
    out.normal = {found_.normal[0], found_.normal[1], found_.normal[2]};
    out.point1 = {found_.pos[0], found_.pos[1], found_.pos[2]};
    out.value = found_.depth;
    return true;
  }
  Geometries a_;
  Geometries b_;
  dContactGeom found_{};
};

}  // namespace

std::vector<Peer> ode_peers() {
  return {make_peer("ODE",
                    {.normal = NormalDirection::second_to_first,
                     .points = Points::midpoint,
                     .value = ValueKind::depth,
                     .margin = Margin::none},
                    false, std::make_shared<Ode>())};
}

}  // namespace contact::bench
