// libccd sees a shape through functions of its user: those of a sphere and a box, as its own examples
// write them.
#pragma once

#include <ccd/ccd.h>
#include <ccd/vec3.h>

#include <variant>

#include "engines/adapters/adapter.hpp"

namespace contact::adapters {

struct CcdSphere {
  explicit CcdSphere(const double* x) : radius(x[3]) { ccdVec3Set(&center, x[0], x[1], x[2]); }
  ccd_vec3_t center;
  ccd_real_t radius;
};

struct CcdBox {
  explicit CcdBox(const double* x) {
    const CenteredBox box(x);
    ccdVec3Set(&center, box.center[0], box.center[1], box.center[2]);
    ccdVec3Set(&half, box.half[0], box.half[1], box.half[2]);
  }
  ccd_vec3_t center;
  ccd_vec3_t half;
};

inline void ccd_support(const void* shape, const ccd_vec3_t* direction, ccd_vec3_t* point) {
  const auto& sphere = *static_cast<const CcdSphere*>(shape);
  ccdVec3Copy(point, direction);
  ccdVec3Normalize(point);
  ccdVec3Scale(point, sphere.radius);
  ccdVec3Add(point, &sphere.center);
}

inline void ccd_support_box(const void* shape, const ccd_vec3_t* direction, ccd_vec3_t* point) {
  const auto& box = *static_cast<const CcdBox*>(shape);
  for (int i = 0; i < 3; ++i) point->v[i] = ccdSign(direction->v[i]) * box.half.v[i];
  ccdVec3Add(point, &box.center);
}

template <class Shape>
void ccd_center(const void* shape, ccd_vec3_t* point) {
  ccdVec3Copy(point, &static_cast<const Shape*>(shape)->center);
}

/// libccd's header leaves the number of iterations unlimited; its README sets 100.
inline ccd_t ccd_settings(bool box) {
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = ccd_support;
  ccd.support2 = box ? ccd_support_box : ccd_support;
  ccd.center1 = ccd_center<CcdSphere>;
  ccd.center2 = box ? ccd_center<CcdBox> : ccd_center<CcdSphere>;
  ccd.max_iterations = 100;
  return ccd;
}

// The position is "where force should take a place", which is no point of ours. The library exports no version.
inline std::string ccd_declaration(const std::string& name, const std::string& scale) {
  return R"({"engine":{"name":")" + name +
         R"(","version":"2.1"},"scalar":"binary64","pairs":["sphere_sphere","sphere_cube"],"conventions":{"points":"none",)"
         R"("value":"depth","value_less_contact":false,"margin":"none","shapes":"centered")" +
         scale + "}}";
}

/// Answers by ccdMPRPenetration or ccdGJKPenetration.
inline void ccd_answer(decltype(&ccdMPRPenetration) penetration, const Question& q, Answer& said) {
  static const ccd_t of_spheres = ccd_settings(false);
  static const ccd_t of_sphere_and_box = ccd_settings(true);
  const CcdSphere a(q.a);
  const bool boxed = q.pair == CONTACT_SPHERE_CUBE;
  const std::variant<CcdSphere, CcdBox> b = boxed ? std::variant<CcdSphere, CcdBox>(CcdBox(q.b)) : CcdSphere(q.b);
  const void* shape_b = std::visit([](const auto& shape) -> const void* { return &shape; }, b);
  ccd_real_t depth = 0;
  ccd_vec3_t direction = {{0, 0, 0}};
  ccd_vec3_t position;
  const bool hit =
      penetration(&a, shape_b, boxed ? &of_sphere_and_box : &of_spheres, &depth, &direction, &position) == 0;
  said.hit(hit);
  // Of shapes that only touch it says no more than that, and leaves the rest as it was.
  if (!hit || ccdVec3Eq(&direction, ccd_vec3_origin)) return;
  said.normal(direction.v);
  said.value(depth);
}

}  // namespace contact::adapters
