// The questions of every benchmark that is about no family: uniform, half of them hits, in an order that cannot be
// learned; of a ball and a box two in five, and one in sixteen a centre inside; with capsules nearly half; with
// triangles, rays and planes about half.
#pragma once

#include <concepts>
#include <random>

#include "contact/geometry.hpp"

namespace contact::bench {

class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : random_(seed) {}

  /// A shape of any kind.
  template <class Shape>
  Shape shape() {
    if constexpr (std::same_as<Shape, Ball>)
      return ball();
    else if constexpr (std::same_as<Shape, Box>)
      return box();
    else if constexpr (std::same_as<Shape, Capsule>)
      return capsule();
    else if constexpr (std::same_as<Shape, Triangle>)
      return {vector(coordinate_), vector(coordinate_), vector(coordinate_)};
    else if constexpr (std::same_as<Shape, Ray>)
      return {vector(coordinate_), vector(coordinate_), part()};
    else if constexpr (std::same_as<Shape, Line>)
      return {vector(coordinate_), vector(coordinate_)};
    else
      return plane();
  }
  Ball ball() {
    const Vector3 center = vector(coordinate_);
    return {center, radius_(random_)};
  }
  Box box() {
    const Vector3 min = vector(coordinate_);
    return {min, min + vector(extent_)};
  }
  Capsule capsule() {
    const Vector3 start = vector(coordinate_);
    const Vector3 end = vector(coordinate_);
    return {start, end, thin_(random_)};
  }
  /// Deep enough for about half of the balls to be above it.
  Plane plane() {
    const Vector3 normal = vector(coordinate_);
    return {normal, normal.dot(vector(coordinate_)) - 6 * normal.norm()};
  }
  /// Twelve corners on a sphere, all of which are needed.
  Hull hull() {
    const Vector3 center = vector(near_);
    Hull made{{}, 0};
    while (made.vertices.size() < 12) {
      const Vector3 way = vector(coordinate_);
      made.vertices.push_back(center + 5 / way.norm() * way);
    }
    return made;
  }
  /// A number from 0 to 1.
  double part() { return part_(random_); }

 private:
  Vector3 vector(std::uniform_real_distribution<double>& of) {
    const double x = of(random_);
    const double y = of(random_);
    return {x, y, of(random_)};
  }

  std::mt19937_64 random_;
  std::uniform_real_distribution<double> coordinate_{-10, 10};
  // With these every other pair of one shape is a hit.
  std::uniform_real_distribution<double> radius_{0.5, 12.75};
  std::uniform_real_distribution<double> extent_{5.4, 18};
  std::uniform_real_distribution<double> thin_{0.25, 5};
  std::uniform_real_distribution<double> near_{-5, 5};
  std::uniform_real_distribution<double> part_{0, 1};
};

}  // namespace contact::bench
