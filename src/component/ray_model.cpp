// The ray model.
#include "contact/ray_model.hpp"

#include <cmath>
#include <limits>

#include "component/columns.hpp"
#include "contact/shape_intersectors.hpp"
#include "kernel/floating_point_environment.hpp"

namespace contact::inline CONTACT_ABI {
namespace {

/// Here, so that no linker leaves it out of a program that has rays.
const IntersectorCreator<RayDiscreteIntersection> ray_intersectors("Ray");

/// The end misses the real one by two roundings, and by what underflows; a margin of 2^-50 of both numbers and 2^-1000
/// pays for them. Beyond the range the bound is infinite. Not inlined: what RoundToNearest sets must be set before.
[[gnu::noinline]] Box rounded_box_around(const Ray& ray) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box box{ray.origin, ray.origin};
  if (ray.length == 0) return box;
  for (int axis = 0; axis < 3; ++axis) {
    if (ray.direction[axis] == 0) continue;
    const double way = ray.length * ray.direction[axis];
    const double margin = (std::abs(ray.origin[axis]) * 0x1p-50 + std::abs(way) * 0x1p-50) + 0x1p-1000;
    if (ray.direction[axis] < 0) {
      const double low = (ray.origin[axis] + way) - margin;
      box.min[axis] = low <= -kLargest ? -kInfinity : low;
    } else {
      const double high = (ray.origin[axis] + way) + margin;
      box.max[axis] = high >= kLargest ? kInfinity : high;
    }
  }
  return box;
}

std::optional<DomainError> outside_domain(const Rows<3>& origins, const Rows<3>& directions) {
  if (auto error = component::not_finite("origins", origins)) return error;
  if (auto error = component::not_finite("directions", directions)) return error;
  if (auto error = component::wrong_length("directions", directions.rows(), "origins", origins.rows())) return error;
  for (Index i = 0; i < directions.rows(); ++i)
    if (auto error =
            contact::outside_domain(component::row("directions", i), directions.vector(i), FieldKind::direction))
      return error;
  return std::nullopt;
}

}  // namespace

Box box_around(const Ray& ray) {
  const kernel::RoundToNearest environment;
  return rounded_box_around(ray);
}

RayCollisionModel::RayCollisionModel(std::string name, Rows<3> origins, Rows<3> directions, Rows<1> lengths)
    : ModelOf(std::move(name)),
      origins_(std::move(origins)),
      directions_(std::move(directions)),
      lengths_(std::move(lengths)) {
  refuse(outside_domain(origins_, directions_));
  refuse(component::wrong_length("lengths", lengths_.rows(), "origins", origins_.rows()));
  refuse(component::not_a_length("lengths", lengths_));
}

Box RayCollisionModel::bounding_box(Index index) const { return box_around(ray(index)); }

void RayCollisionModel::setRays(Rows<3> origins, Rows<3> directions) {
  refuse(outside_domain(origins, directions));
  refuse(component::wrong_length("origins", origins.rows(), "lengths", getSize()));
  origins_ = std::move(origins);
  directions_ = std::move(directions);
}

}  // namespace contact::inline CONTACT_ABI
