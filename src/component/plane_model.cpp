// The plane model.
#include "contact/plane_model.hpp"

#include <cmath>
#include <limits>

#include "component/columns.hpp"
#include "contact/shape_intersectors.hpp"
#include "kernel/floating_point_environment.hpp"

namespace contact::inline CONTACT_ABI {
namespace {

/// Here, so that no linker leaves it out of a program that has planes.
const IntersectorCreator<PlaneDiscreteIntersection> plane_intersectors("Plane");

/// The quotient misses the real one by one rounding, and by what underflows. A quotient beyond the range is infinite,
/// which is right as a bound only outwards; the largest number is, inwards. Not inlined: what RoundToNearest sets must
/// be set before.
[[gnu::noinline]] Box rounded_box_around(const Plane& plane) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box box{Vector3::Constant(-kInfinity), Vector3::Constant(kInfinity)};
  if ((plane.normal.array() != 0).count() != 1) return box;
  Eigen::Index axis = 0;
  plane.normal.cwiseAbs().maxCoeff(&axis);
  const double at = plane.offset / plane.normal[axis];
  const double margin = std::abs(at) * 0x1p-50 + 0x1p-1000;
  if (plane.normal[axis] < 0)
    box.min[axis] = at == kInfinity ? kLargest : at - margin;
  else
    box.max[axis] = at == -kInfinity ? -kLargest : at + margin;
  return box;
}

std::optional<DomainError> outside_domain(const Rows<3>& normals, const Rows<1>& offsets) {
  if (auto error = component::not_finite("normals", normals)) return error;
  if (auto error = component::wrong_length("offsets", offsets.rows(), "normals", normals.rows())) return error;
  if (auto error = component::not_finite("offsets", offsets)) return error;
  for (Index i = 0; i < normals.rows(); ++i)
    if (auto error = contact::outside_domain(component::row("normals", i), normals.vector(i), FieldKind::direction))
      return error;
  return std::nullopt;
}

}  // namespace

Box box_around(const Plane& plane) {
  const kernel::RoundToNearest environment;
  return rounded_box_around(plane);
}

PlaneCollisionModel::PlaneCollisionModel(std::string name, Rows<3> normals, Rows<1> offsets)
    : ModelOf(std::move(name)), normals_(std::move(normals)), offsets_(std::move(offsets)) {
  refuse(outside_domain(normals_, offsets_));
}

Box PlaneCollisionModel::bounding_box(Index index) const { return box_around(plane(index)); }

void PlaneCollisionModel::setPlanes(Rows<3> normals, Rows<1> offsets) {
  refuse(outside_domain(normals, offsets));
  refuse(component::wrong_length("normals", normals.rows(), "planes", getSize()));
  normals_ = std::move(normals);
  offsets_ = std::move(offsets);
}

}  // namespace contact::inline CONTACT_ABI
