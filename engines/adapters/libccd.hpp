// libccd sees a shape through functions of its user: as its own examples write them.
#pragma once

#include <ccd/ccd.h>
#include <ccd/vec3.h>

#include "engines/adapters/adapter.hpp"

namespace contact::adapters {

inline void ccd_support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* point) {
  const auto& shape = *static_cast<const Shape*>(object);
  if (shape.is_box()) {
    ccdVec3Set(point, shape.center[0], shape.center[1], shape.center[2]);
    for (int k = 0; k < 3; ++k) {
      double along = 0;
      for (int i = 0; i < 3; ++i) along += direction->v[i] * shape.rotation(i, k);
      for (int i = 0; i < 3; ++i) point->v[i] += ccdSign(along) * shape.half[k] * shape.rotation(i, k);
    }
    return;
  }
  // By its corners: one of a sphere, two of a capsule, three of a triangle, those of a hull.
  ccd_vec3_t end;
  const double* x = shape.vertex(0);
  ccdVec3Set(&end, x[0], x[1], x[2]);
  const int corners = shape.kind == Kind::sphere ? 1 : shape.kind == Kind::capsule ? 2 : shape.vertices();
  for (int i = 1; i < corners; ++i) {
    ccd_vec3_t other;
    x = shape.vertex(i);
    ccdVec3Set(&other, x[0], x[1], x[2]);
    if (ccdVec3Dot(direction, &other) > ccdVec3Dot(direction, &end)) end = other;
  }
  if (shape.kind == Kind::triangle) return ccdVec3Copy(point, &end);
  ccdVec3Copy(point, direction);
  ccdVec3Normalize(point);
  ccdVec3Scale(point, shape.radius);
  ccdVec3Add(point, &end);
}

inline void ccd_center(const void* object, ccd_vec3_t* point) {
  const auto& shape = *static_cast<const Shape*>(object);
  const double* x = shape.center;
  ccdVec3Set(point, x[0], x[1], x[2]);
  if (shape.kind != Kind::triangle && shape.kind != Kind::hull) return;
  const int count = shape.vertices();
  for (int i = 0; i < count; ++i)
    for (int axis = 0; axis < 3; ++axis) point->v[axis] += shape.vertex(i)[axis] / count;
}

/// libccd's header leaves the number of iterations unlimited; its README sets 100.
inline ccd_t ccd_settings() {
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = ccd.support2 = ccd_support;
  ccd.center1 = ccd.center2 = ccd_center;
  ccd.max_iterations = 100;
  return ccd;
}

// The position is "where force should take a place", which is no point of ours. The library exports no version.
inline std::string ccd_declaration(const std::string& name, const std::string& scale) {
  return R"({"engine":{"name":")" + name +
         R"(","version":"2.1"},"scalar":"binary64","rounds":["orientation"],"pairs":["sphere_sphere","sphere_cube","sphere_capsule",)"
         R"("capsule_capsule","sphere_triangle",)" CONVEX_PAIRS "," HULL_PAIRS
         R"(],"conventions":{"points":"none","shapes":"centered",)"
         R"("value":"depth","value_less_contact":false,"margin":"none")" +
         scale +
         R"(},"pair_conventions":{"sphere_capsule":{"shapes":"given"},"capsule_capsule":{"shapes":"given"},)"
         R"("capsule_triangle":{"shapes":"given"}}})";
}

/// Answers by ccdMPRPenetration or ccdGJKPenetration.
inline void ccd_answer(decltype(&ccdMPRPenetration) penetration, const Question& q, Answer& said) {
  static const ccd_t ccd = ccd_settings();
  ccd_real_t depth = 0;
  ccd_vec3_t direction = {{0, 0, 0}};
  ccd_vec3_t position;
  const bool hit = penetration(&q.a, &q.b, &ccd, &depth, &direction, &position) == 0;
  said.hit(hit);
  // Of shapes that only touch it says no more than that, and leaves the rest as it was.
  if (!hit || ccdVec3Eq(&direction, ccd_vec3_origin)) return;
  said.normal(direction.v);
  said.value(depth);
}

}  // namespace contact::adapters
