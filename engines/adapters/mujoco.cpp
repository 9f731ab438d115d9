// MuJoCo: mj_collision on one predefined pair of spheres.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "engines/adapters/adapter.hpp"

namespace contact::adapters {
namespace {

// Two bodies that can move: between geoms of the world nothing is ever tested.
constexpr char kModel[] = R"(<mujoco><option collision="predefined"/><worldbody>
  <body><freejoint/><geom name="a" type="sphere" size="1"/></body>
  <body><freejoint/><geom name="b" type="sphere" size="1"/></body>
</worldbody><contact><pair geom1="a" geom2="b"/></contact></mujoco>)";

mjModel* load() {
  static mjVFS files;  // it holds megabytes
  mj_defaultVFS(&files);
  mj_makeEmptyFileVFS(&files, "model.xml", sizeof kModel - 1);
  std::memcpy(files.filedata[0], kModel, sizeof kModel - 1);
  char error[1000] = "";
  mjModel* model = mj_loadXML("model.xml", &files, error, sizeof error);
  if (!model) throw std::runtime_error(error);
  return model;
}

}  // namespace

// The scale is mjMAXVAL, beyond which MuJoCo calls a coordinate bad.
std::string declaration() {
  return R"({"engine":{"name":"mujoco","version":")" + std::string(mj_versionString()) +
         R"("},"scalar":"binary64","pairs":["sphere_sphere"],"conventions":{"points":"midpoint",)"
         R"("value_less_contact":false,"scale":{"min":0,"max":1e10}}})";
}

void answer(const Question& q, Answer& said) {
  // Its own handler waits for somebody to press Enter.
  mju_user_error = [](const char* message) { throw std::runtime_error(message); };
  static mjModel* const model = load();
  static mjData* const data = mj_makeData(model);
  for (int i = 0; i < 2; ++i) {
    const double* x = i == 0 ? q.a : q.b;
    std::copy(x, x + 3, data->geom_xpos + 3 * i);
    model->geom_size[3 * i] = model->geom_rbound[i] = x[3];
  }
  model->pair_margin[0] = q.alarm;
  mj_collision(model, data);
  said.hit(data->ncon > 0);
  if (data->ncon == 0) return;
  const mjContact& contact = data->contact[0];
  said.normal(contact.frame);
  said.midpoint(contact.pos);
  said.value(contact.dist);
}

}  // namespace contact::adapters
