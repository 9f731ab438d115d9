// A shape as the adapters of engines take it, which make a library's own of it.
#pragma once

#include <utility>
#include <variant>
#include <vector>

#include "contact/geometry.hpp"
#include "engines/adapters/adapter.hpp"

namespace contact::bench {

class Adapted {
 public:
  /// Domain: a sphere, a capsule along an axis, a plane that faces along one, or a hull.
  explicit Adapted(const Convex& given) {
    const auto put = [this](const Vector3& v) { numbers_.insert(numbers_.end(), v.begin(), v.end()); };
    if (const auto* ball = std::get_if<Ball>(&given.shape)) {
      kind_ = adapters::Kind::sphere;
      put(ball->center);
      numbers_.push_back(ball->radius);
    } else if (const auto* capsule = std::get_if<Capsule>(&given.shape)) {
      kind_ = adapters::Kind::capsule;
      put(capsule->start);
      put(capsule->end);
      numbers_.push_back(capsule->radius);
    } else if (const auto* plane = std::get_if<Plane>(&given.shape)) {
      kind_ = adapters::Kind::plane;
      put(plane->normal);
      numbers_.push_back(plane->offset);
    } else {
      const auto& hull = std::get<Hull>(given.shape);
      kind_ = adapters::Kind::hull;
      numbers_ = {static_cast<double>(hull.vertices.size()), hull.radius};
      for (const Vector3& v : hull.vertices) put(v);
    }
  }
  [[nodiscard]] adapters::Shape shape() const { return {kind_, numbers_.data()}; }

 private:
  std::vector<double> numbers_;
  adapters::Kind kind_;
};

}  // namespace contact::bench
