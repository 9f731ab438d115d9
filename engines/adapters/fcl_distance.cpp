// FCL: fcl::distance, compared with the alarm distance. Not of a sphere and a mesh: where they penetrate, FCL compares
// a number that nobody has set.
#include <fcl/config.h>
#include <fcl/narrowphase/distance.h>

#include "engines/adapters/fcl.hpp"

namespace contact::adapters {

std::string declaration() {
  return R"({"engine":{"name":"fcl-distance","version":")" FCL_VERSION
         R"("},"scalar":"binary64","rounds":["orientation"],"pairs":["sphere_sphere","sphere_cube","sphere_capsule","capsule_capsule",)" CONVEX_PAIRS
         "," HULL_PAIRS R"(],"conventions":{"value_less_contact":false,"shapes":"centered"},)"
         R"("claims":["overlap","contact"]})";
}

void answer(const Question& q, Answer& said) {
  const auto a = fcl_object(q.a);
  const auto b = fcl_object(q.b);
  if (!a || !b) return said.unsupported();
  fcl::DistanceResultd result;
  fcl::distance(&*a, &*b, fcl::DistanceRequestd(true), result);
  said.hit(result.min_distance <= q.alarm);
  // Of shapes that touch or penetrate the plain request says only that they do, by the distance -1: so numbers are not
  // among what it claims.
  if (!(result.min_distance <= q.alarm) || result.min_distance < 0) return;
  said.point1(result.nearest_points[0]);
  said.point2(result.nearest_points[1]);
  said.value(result.min_distance);
}

}  // namespace contact::adapters
