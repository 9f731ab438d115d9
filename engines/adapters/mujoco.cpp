// MuJoCo: mj_collision on one predefined pair of a sphere and another or a box.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "engines/adapters/adapter.hpp"

namespace contact::adapters {
namespace {

// Two bodies that can move: between geoms of the world nothing is ever tested.
struct Scene {
  explicit Scene(const std::string& second) {
    const std::string text = R"(<mujoco><option collision="predefined"/><worldbody>
  <body><freejoint/><geom name="a" type="sphere" size="1"/></body>
  <body><freejoint/><geom name="b" type=")" +
                             second + R"(" size="1 1 1"/></body>
</worldbody><contact><pair geom1="a" geom2="b"/></contact></mujoco>)";
    static mjVFS files;  // it holds megabytes
    mj_defaultVFS(&files);
    mj_makeEmptyFileVFS(&files, "model.xml", static_cast<int>(text.size()));
    std::memcpy(files.filedata[0], text.data(), text.size());
    char error[1000] = "";
    model = mj_loadXML("model.xml", &files, error, sizeof error);
    if (!model) throw std::runtime_error(error);
    data = mj_makeData(model);
    mj_kinematics(model, data);  // upright, once and for all
  }
  void place(int geom, const double* center) const { std::copy(center, center + 3, data->geom_xpos + 3 * geom); }
  void sphere(int geom, const double* x) const {
    place(geom, x);
    model->geom_size[3 * geom] = model->geom_rbound[geom] = x[3];
  }
  void box(int geom, const CenteredBox& x) const {
    place(geom, x.center);
    std::copy(x.half, x.half + 3, model->geom_size + 3 * geom);
    model->geom_rbound[geom] = mju_norm3(x.half);  // as its compiler does
  }
  mjModel* model;
  mjData* data;
};

}  // namespace

// The scale is mjMAXVAL, beyond which MuJoCo calls a coordinate bad.
std::string declaration() {
  return R"({"engine":{"name":"mujoco","version":")" + std::string(mj_versionString()) +
         R"("},"scalar":"binary64","pairs":["sphere_sphere","sphere_cube"],"conventions":{"points":"midpoint",)"
         R"("value_less_contact":false,"shapes":"centered","scale":{"min":0,"max":1e10}}})";
}

void answer(const Question& q, Answer& said) {
  // Its own handler waits for somebody to press Enter.
  mju_user_error = [](const char* message) { throw std::runtime_error(message); };
  static const Scene spheres("sphere");
  static const Scene sphere_and_box("box");
  const bool boxed = q.pair == CONTACT_SPHERE_CUBE;
  const Scene& scene = boxed ? sphere_and_box : spheres;
  scene.sphere(0, q.a);
  if (boxed) {
    const CenteredBox box(q.b);
    // Its compiler refuses a box without thickness; to its collider a size of 0 is no limit.
    if (*std::min_element(box.half, box.half + 3) == 0) return said.unsupported();
    scene.box(1, box);
  } else {
    scene.sphere(1, q.b);
  }
  scene.model->pair_margin[0] = q.alarm;
  mj_collision(scene.model, scene.data);
  said.hit(scene.data->ncon > 0);
  if (scene.data->ncon == 0) return;
  const mjContact& contact = scene.data->contact[0];
  said.normal(contact.frame);
  said.midpoint(contact.pos);
  said.value(contact.dist);
}

}  // namespace contact::adapters
