// The pairs of shapes, listed once: the names and shapes of a pair, and whether its contacts have numbers.
//
// A new pair is a line in a list below, and files of its own on every floor: docs/architecture.md#where-to-add.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <string_view>
#include <variant>

#include "contact/shapes.hpp"

namespace contact::inline CONTACT_ABI {

/// Two shapes that are asked about, first and second.
template <class A, class B>
struct Two {
  A a;
  B b;
};

/// The rays that are cast: X(Cast, shape).
#define CONTACT_CASTS(X) \
  X(Cast, Ball)          \
  X(Cast, Box)           \
  X(Cast, Capsule)       \
  X(Cast, Triangle)      \
  X(Cast, Plane)

/// The kinds of two shapes: X(first, second). Each floor declares what it has for each kind from this list.
#define CONTACT_KINDS(X) \
  X(Ball, Ball)          \
  X(Box, Box)            \
  X(Ball, Box)           \
  X(Ball, Capsule)       \
  X(Capsule, Capsule)    \
  X(Ball, Triangle)      \
  X(Ray, Ball)           \
  X(Ball, Plane)         \
  X(Capsule, Plane)      \
  X(Ray, Triangle)       \
  X(Triangle, Line)      \
  CONTACT_CASTS(X)       \
  X(Convex, Convex)

/// What the contacts of a pair have: no numbers, those of a point where one shape crosses the other, those of a
/// distance, or those of the first point of a ray that lies in a shape.
enum class Numbers { none, crossing, distance, cast };

/// Pairs of any two convex shapes, which are of one kind.
#define CONTACT_CONVEX_PAIRS(X)                                    \
  X(obb_obb, Obb, Obb, distance, false, false)                     \
  X(sphere_obb, Ball, Obb, distance, false, false)                 \
  X(capsule_cube, Capsule, Box, distance, false, false)            \
  X(capsule_obb, Capsule, Obb, distance, false, false)             \
  X(capsule_triangle, Capsule, Triangle, distance, false, false)   \
  X(cube_obb, Box, Obb, distance, false, false)                    \
  X(cube_triangle, Box, Triangle, distance, false, false)          \
  X(obb_triangle, Obb, Triangle, distance, false, false)           \
  X(triangle_triangle, Triangle, Triangle, distance, false, false) \
  X(cube_plane, Box, Plane, distance, false, false)                \
  X(obb_plane, Obb, Plane, distance, false, false)                 \
  X(triangle_plane, Triangle, Plane, distance, false, false)       \
  X(sphere_hull, Ball, Hull, distance, false, false)               \
  X(capsule_hull, Capsule, Hull, distance, false, false)           \
  X(cube_hull, Box, Hull, distance, false, false)                  \
  X(obb_hull, Obb, Hull, distance, false, false)                   \
  X(triangle_hull, Triangle, Hull, distance, false, false)         \
  X(hull_hull, Hull, Hull, distance, false, false)                 \
  X(hull_plane, Hull, Plane, distance, false, false)

/// The pairs: X(name, first shape, second shape, what its contacts have, the first is rigid, the second is rigid).
/// Under upstream's convention a rigid sphere reports its nearest surface point, a deformable one its centre.
#define CONTACT_PAIRS(X)                                         \
  X(sphere_sphere, Ball, Ball, distance, false, false)           \
  X(rigid_sphere_rigid_sphere, Ball, Ball, distance, true, true) \
  X(sphere_rigid_sphere, Ball, Ball, distance, false, true)      \
  X(cube_cube, Box, Box, none, false, false)                     \
  X(sphere_cube, Ball, Box, distance, false, false)              \
  X(sphere_capsule, Ball, Capsule, distance, false, false)       \
  X(capsule_capsule, Capsule, Capsule, distance, false, false)   \
  X(sphere_triangle, Ball, Triangle, distance, false, false)     \
  X(ray_sphere, Ray, Ball, distance, false, false)               \
  X(sphere_plane, Ball, Plane, distance, false, false)           \
  X(capsule_plane, Capsule, Plane, distance, false, false)       \
  X(ray_triangle, Ray, Triangle, crossing, false, false)         \
  X(triangle_line, Triangle, Line, crossing, false, false)       \
  X(cast_sphere, Cast, Ball, cast, false, false)                 \
  X(cast_cube, Cast, Box, cast, false, false)                    \
  X(cast_capsule, Cast, Capsule, cast, false, false)             \
  X(cast_triangle, Cast, Triangle, cast, false, false)           \
  X(cast_plane, Cast, Plane, cast, false, false)                 \
  CONTACT_CONVEX_PAIRS(X)

#define CONTACT_NAME(name, ...) name,
enum class Pair { CONTACT_PAIRS(CONTACT_NAME) };
#undef CONTACT_NAME

#define CONTACT_KIND(A, B) , Two<A, B>
/// Two shapes of any kind.
template <class... Kinds>
struct AnyOfKinds;
template <class... Kinds>
struct AnyOfKinds<void, Kinds...> {
  using Type = std::variant<Kinds...>;
};
using Shapes = AnyOfKinds<void CONTACT_KINDS(CONTACT_KIND)>::Type;
#undef CONTACT_KIND

using Balls = Two<Ball, Ball>;
using Boxes = Two<Box, Box>;
using BallAndBox = Two<Ball, Box>;
using BallAndCapsule = Two<Ball, Capsule>;
using Capsules = Two<Capsule, Capsule>;
using BallAndTriangle = Two<Ball, Triangle>;
using RayAndBall = Two<Ray, Ball>;
using BallAndPlane = Two<Ball, Plane>;
using CapsuleAndPlane = Two<Capsule, Plane>;
using RayAndTriangle = Two<Ray, Triangle>;
using TriangleAndLine = Two<Triangle, Line>;
template <class Target>
using CastAt = Two<Cast, Target>;

using Convexes = Two<Convex, Convex>;

template <class Kind, class Variant>
inline constexpr bool kIsAlternative = false;
template <class Kind, class... Kinds>
inline constexpr bool kIsAlternative<Kind, std::variant<Kinds...>> = (std::same_as<Kind, Kinds> || ...);
/// Two shapes as the kind that questions about them are of.
template <class A, class B>
[[nodiscard]] auto of_a_kind(const A& a, const B& b) {
  if constexpr (kIsAlternative<Two<A, B>, Shapes>)
    return Two<A, B>{a, b};
  else
    return Convexes{{a}, {b}};
}

struct PairDescription {
  Pair pair;
  std::string_view name;
  Shapes (*zeros)();  ///< its two shapes, every number 0
  Numbers numbers;
  bool first_is_rigid;
  bool second_is_rigid;
};

#define CONTACT_PAIR(name, A, B, numbers, first_is_rigid, second_is_rigid) \
  PairDescription{Pair::name,       #name,          [] { return Shapes(of_a_kind(zero_shape<A>(), zero_shape<B>())); },                \
                  Numbers::numbers, first_is_rigid, second_is_rigid},
inline constexpr PairDescription kPairTable[] = {CONTACT_PAIRS(CONTACT_PAIR)};
#undef CONTACT_PAIR

[[nodiscard]] constexpr const PairDescription& description(Pair pair) {
  return kPairTable[static_cast<std::size_t>(pair)];
}
[[nodiscard]] constexpr std::string_view name(Pair pair) { return description(pair).name; }
[[nodiscard]] constexpr bool has_numbers(Pair pair) { return description(pair).numbers != Numbers::none; }
/// Whether the pair has a distance, which the alarm distance is compared with.
[[nodiscard]] constexpr bool has_distance(Pair pair) { return description(pair).numbers == Numbers::distance; }
/// Whether one shape crosses the other or does not: no distance counts.
[[nodiscard]] constexpr bool is_crossing(Pair pair) { return description(pair).numbers == Numbers::crossing; }
/// Whether a ray is cast at a shape: no distance counts here either.
[[nodiscard]] constexpr bool is_cast(Pair pair) { return description(pair).numbers == Numbers::cast; }
/// ask.operator()<A, B>() of the two shapes of a pair: what follows from the shapes is asked of them, so that a new
/// pair needs no line for it.
#define CONTACT_ASK(name, A, B, ...) \
  case Pair::name:                   \
    return ask.template operator()<A, B>();
template <class Ask>
[[nodiscard]] constexpr bool of_shapes(Pair pair, Ask ask) {
  switch (pair) { CONTACT_PAIRS(CONTACT_ASK) }
  return false;
}
#undef CONTACT_ASK

/// Whether a shape is a core blown up by a radius.
template <class Shape>
inline constexpr bool kHasRadius = requires(Shape shape) {
  shape.radius;
};

/// The radius that it is blown up by, or 0.
template <class Shape>
[[nodiscard]] constexpr double radius_of(const Shape& shape) {
  if constexpr (kHasRadius<Shape>) return shape.radius;
  return 0;
}
/// A shape that is the hull of its vertices, and of which nothing more is known. A triangle's features are.
template <class Shape>
concept HullOfVertices = !std::same_as<Shape, Triangle> && requires(Shape shape) {
  shape.vertices.size();
};

/// Whether one of its shapes is a hull, which has as many numbers as a question says.
[[nodiscard]] constexpr bool has_hull(Pair pair) {
  return of_shapes(pair, []<class A, class B>() { return kIsOneOf<Hull, A, B>; });
}
/// Whether SOFA's DiscreteIntersection has the pair, of two spheres or of two cubes; the others join at run time there.
[[nodiscard]] constexpr bool is_discrete_intersections(Pair pair) {
  return of_shapes(pair, []<class A, class B>() { return std::same_as<A, B> && kIsOneOf<A, Ball, Box>; });
}
/// Whether more than one pair of points of the cores may be nearest: a ball's core is one point, which has one nearest.
[[nodiscard]] constexpr bool may_have_many_nearest(Pair pair) {
  return has_distance(pair) &&
         of_shapes(pair, []<class A, class B>() { return !std::same_as<A, Ball> && !std::same_as<B, Ball>; });
}
/// Whether distances are measured to a half-space, the second shape, so that they are signed and D = 0 is no exception.
[[nodiscard]] constexpr bool has_plane(Pair pair) {
  return has_distance(pair) && of_shapes(pair, []<class A, class B>() { return std::same_as<B, Plane>; });
}
/// Whether the pair is one of any two convex shapes: where its cores overlap, that is an ordinary hit, with a depth.
[[nodiscard]] constexpr bool is_convex(Pair pair) { return pair >= Pair::obb_obb; }
/// Whether the nearest points may be quotients of what is given, so that D is no dyadic. Those of balls and boxes have
/// coordinates that are given.
[[nodiscard]] constexpr bool has_quotients(Pair pair) {
  return of_shapes(pair, []<class A, class B>() { return !(kIsOneOf<A, Ball, Box> && kIsOneOf<B, Ball, Box>); });
}

}  // namespace contact::inline CONTACT_ABI
