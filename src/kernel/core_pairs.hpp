// The cores of shapes, and the lengths about them: what a question about two shapes asks of cores_stages.hpp.
#pragma once

#include "contact/pairs.hpp"
#include "kernel/crossing_cores.hpp"
#include "kernel/plane_cores.hpp"
#include "kernel/segment_cores.hpp"
#include "kernel/triangle_cores.hpp"

namespace contact::kernel {

[[nodiscard]] inline const Vector3& core_of(const Ball& ball) { return ball.center; }
[[nodiscard]] inline Segment core_of(const Capsule& capsule) { return {capsule.start, capsule.end}; }
[[nodiscard]] inline Segment core_of(const Line& line) { return {line.start, line.end}; }
[[nodiscard]] inline Corners core_of(const Triangle& triangle) { return {triangle.vertices}; }
[[nodiscard]] inline DirectedSegment core_of(const Ray& ray) { return {ray.origin, ray.direction, ray.length}; }
[[nodiscard]] inline HalfSpace core_of(const Plane& plane) { return {plane.normal, plane.offset}; }

template <class A, class B>
[[nodiscard]] Lengths lengths_of(const A& a, const B& b, Distances distances) {
  return {radius_of(a), radius_of(b), distances.alarm, distances.contact};
}

}  // namespace contact::kernel
