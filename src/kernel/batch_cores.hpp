// What the first loop of batch_cores-inl.h leaves to the second one.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/batch.hpp"

namespace contact::kernel {

/// The kinds of pairs whose kernel is a struct Feet, X(name, first shape, second shape): those whose cores have a distance,
/// and all.
#define CONTACT_CORES_APART(X)         \
  X(sphere_capsule, Ball, Capsule)     \
  X(capsule_capsule, Capsule, Capsule) \
  X(sphere_triangle, Ball, Triangle)   \
  X(ray_sphere, Ray, Ball)
#define CONTACT_CORES(X)           \
  CONTACT_CORES_APART(X)           \
  X(sphere_cube, Ball, Box)        \
  X(sphere_plane, Ball, Plane)     \
  X(capsule_plane, Capsule, Plane) \
  X(ray_triangle, Ray, Triangle)   \
  X(triangle_line, Triangle, Line)

/// The cores of a strip of pairs. Vectors are high and low parts, axis by axis: the nearest points are p and p + d, the
/// lowest point over a plane is p, and a segment that crosses goes along d. The coordinates of p are within p_error and
/// the vector d is within d_error, which is infinite where that is not known. Some room between columns keeps them from
/// the same place in a page, where loads look like recent stores to the processor.
struct CoreColumns {
  // What one loop writes for the next stays in the first level cache; of threads with 128 KiB of stack all that is
  // needed takes half.
  static constexpr std::size_t kPairs = 128;
  static constexpr std::size_t kRoom = kPairs + 24;
  double d[6][kRoom];
  double d_error[kRoom];
  double decision[kRoom];  ///< one of the following
  double p[6][kRoom];      ///< of a core that is no point of the question
  double p_error[kRoom];
  /// Coordinates that all points of both shapes share, as masks of vectors, where `has_flat` of a vector's first pair.
  double flat[3][kRoom];
  bool has_flat[kRoom];

  static constexpr double kMiss = 0;
  static constexpr double kHit = 1;
  static constexpr double kOpen = 0.5;
};

/// The pairs of a strip that the vectors leave, and how many of the others are hits.
struct Left {
  std::uint16_t rows[CoreColumns::kPairs];
  std::size_t size = 0;
  std::size_t hits = 0;
  std::size_t exact = 0;  ///< of the others, those that needed exact arithmetic
};

/// A column for shapes without a radius.
inline constexpr double kZeros[CoreColumns::kPairs]{};

// For tests: the cores of a strip of whole vectors. False where the instruction set that serves finds none.
#define CONTACT_FIND_CORES(name, A, B) bool find_cores(const PairColumns<A, B>& pairs, CoreColumns& to);
CONTACT_CORES_APART(CONTACT_FIND_CORES)
#undef CONTACT_FIND_CORES

}  // namespace contact::kernel
