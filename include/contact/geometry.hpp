// The shapes of a question, and the two distances that SOFA's Intersection carries.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <variant>
#include <vector>

#include "contact/version.h"

namespace contact::inline CONTACT_ABI {

using Vector3 = Eigen::Vector3d;
// Vectors pass between files that are compiled with different flags, so no instruction set may ask for more alignment.
static_assert(sizeof(Vector3) == 3 * sizeof(double) && alignof(Vector3) == alignof(double));

/// The index of an element in its model, or of a row, from 0. It is not Eigen::Index, because a macro can change that.
using Index = std::ptrdiff_t;

/// A solid sphere. `radius` >= 0. All numbers of a question have the same length unit.
struct Ball {
  Vector3 center;
  double radius;
};

/// An axis-aligned box, SOFA's Cube. `min` <= `max` on every axis; equality makes a flat box.
struct Box {
  Vector3 min;
  Vector3 max;
};

/// The points within `radius` >= 0 of a segment. `start` = `end` makes it a sphere.
struct Capsule {
  Vector3 start;
  Vector3 end;
  double radius;
};

/// The half-space normal . x <= offset, whose boundary is the plane. `normal` is not zero, and of any length.
struct Plane {
  Vector3 normal;
  double offset;
};

/// A triangle. Any three points will do: they may lie on a line, or be one point.
struct Triangle {
  std::array<Vector3, 3> vertices;
};

/// The segment from `origin` to `origin` + `length` `direction`, exactly. `direction` is not zero, and of any length;
/// `length` >= 0 counts directions.
struct Ray {
  Vector3 origin;
  Vector3 direction;
  double length;
};

/// A ray that is cast: asked where it first hits a shape. It is a type of its own, because the types of two shapes say
/// what is asked of them.
struct Cast : Ray {};

/// The segment between two points, which may be one.
struct Line {
  Vector3 start;
  Vector3 end;
};

/// A quaternion x, y, z, w, not zero, and of any length: it turns v to q v q* / |q|^2, which is exactly a rotation.
using Quaternion = std::array<double, 4>;

/// A box that is turned about its centre. `extents` >= 0 are half its lengths; 0 makes a flat one.
struct Obb {
  Vector3 center;
  Quaternion orientation;
  Vector3 extents;
};

/// The points within `radius` >= 0 of the convex hull of some points, from one to kMostVertices. They may be repeated, lie inside the others, in a plane or
/// on a line.
struct Hull {
  std::vector<Vector3> vertices;
  double radius;
};
inline constexpr std::size_t kMostVertices = 64;

/// A shape of a pair that asks no more of it than that it is a convex core blown up by a radius: which of them, the
/// pair says.
struct Convex {
  std::variant<Ball, Capsule, Box, Obb, Triangle, Plane, Hull> shape;
};

/// The distances of SOFA's Intersection. Pairs up to `alarm` apart are reported. `contact` is subtracted from the value
/// of a contact.
struct Distances {
  double alarm;
  double contact;
};

}  // namespace contact::inline CONTACT_ABI
