// convexes_enclosed-inl.h for any processor, and for those of x86 that have fma, where std::fma is an instruction and no call. The bits are the same.
#pragma once

#include <hwy/base.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <optional>

#include "kernel/convexes_filter.hpp"
#include "kernel/cores_double_double.hpp"
#include "kernel/sphere_sphere_double_double.hpp"

namespace contact::kernel {

template <DescribedShape Shape>
[[nodiscard]] inline bool in_short_range(const Shape& shape) {
  bool all = true;
  for_each_number(shape, [&](double x) { all = all && in_short_range(x); });
  return all;
}

/// What the corners of a core are given by: points, the lower and the upper end of a box, or its middle, extents and orientation. Those of a hull stay where they are.
struct GivenCorners {
  enum class Kind { points, box, obb };

  explicit GivenCorners(const Ball& x) : given{x.center} {}
  explicit GivenCorners(const Capsule& x) : given{x.start, x.end} {}
  explicit GivenCorners(const Triangle& x) : given{x.vertices[0], x.vertices[1], x.vertices[2]} {}
  template <HullOfVertices Shape>
  explicit GivenCorners(const Shape& x) : given{}, vertices(x.vertices.data()) {}
  explicit GivenCorners(const Box& x) : given{x.min, x.max}, kind(Kind::box) {}
  explicit GivenCorners(const Obb& x) : given{x.center, x.extents}, orientation(x.orientation), kind(Kind::obb) {}

  std::array<Vector3, 3> given;
  Quaternion orientation{};
  Kind kind = Kind::points;
  const Vector3* vertices = nullptr;  ///< of a hull
};

/// What is certain of a contact: whether there is one, and which of its numbers are open.
struct Certain {
  NearSide side;
  unsigned open = kAllNumbers;
};

}  // namespace contact::kernel

#define CONTACT_TARGET plain
#include "kernel/convexes_enclosed-inl.h"
#undef CONTACT_TARGET
#if defined(__x86_64__) && !defined(__FMA__)
#define CONTACT_TARGET by_fma
HWY_PUSH_ATTRIBUTES("avx2,fma")
#include "kernel/convexes_enclosed-inl.h"
HWY_POP_ATTRIBUTES
#undef CONTACT_TARGET
#endif
