// MuJoCo: mj_collision on one predefined pair of spheres, boxes and capsules.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "engines/adapters/adapter.hpp"

namespace contact::adapters {
namespace {

// Two bodies that can move: between geoms of the world nothing is ever tested.
struct Scene {
  Scene(const std::string& first, const std::string& second) {
    const std::string text = R"(<mujoco><option collision="predefined"/><worldbody>
  <body><freejoint/><geom name="a" type=")" +
                             first + R"(" size="1 1 1"/></body>
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
  }
  /// False where its compiler would refuse the shape: a box without thickness, a capsule without length.
  [[nodiscard]] bool set(int geom, const Shape& x) const {
    mjtNum* size = model->geom_size + 3 * geom;
    mjtNum& bound = model->geom_rbound[geom];  // as its compiler computes it
    std::copy(x.center, x.center + 3, data->geom_xpos + 3 * geom);
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) data->geom_xmat[9 * geom + 3 * row + column] = x.rotation(row, column);
    if (x.kind == Kind::box) {
      std::copy(x.half, x.half + 3, size);
      bound = mju_norm3(x.half);
      return *std::min_element(x.half, x.half + 3) > 0;
    }
    size[0] = x.radius;
    size[1] = x.length() / 2;
    bound = size[0] + size[1];
    return x.kind == Kind::sphere || size[1] > 0;
  }
  mjModel* model;
  mjData* data;
};

}  // namespace

// The scale is mjMAXVAL, beyond which MuJoCo calls a coordinate bad.
std::string declaration() {
  return R"({"engine":{"name":"mujoco","version":")" + std::string(mj_versionString()) +
         R"("},"scalar":"binary64","pairs":["sphere_sphere","sphere_cube","sphere_capsule","capsule_capsule"],)"
         R"("conventions":{"points":"midpoint",)"
         R"("value_less_contact":false,"shapes":"centered","scale":{"min":0,"max":1e10}}})";
}

void answer(const Question& q, Answer& said) {
  // Its own handler waits for somebody to press Enter.
  mju_user_error = [](const char* message) { throw std::runtime_error(message); };
  static const Scene spheres("sphere", "sphere");
  static const Scene sphere_and_box("sphere", "box");
  static const Scene sphere_and_capsule("sphere", "capsule");
  static const Scene capsules("capsule", "capsule");
  const Scene& scene = q.pair == CONTACT_SPHERE_CUBE       ? sphere_and_box
                       : q.pair == CONTACT_SPHERE_CAPSULE  ? sphere_and_capsule
                       : q.pair == CONTACT_CAPSULE_CAPSULE ? capsules
                                                           : spheres;
  if (!scene.set(0, q.a) || !scene.set(1, q.b)) return said.unsupported();
  scene.model->pair_margin[0] = q.alarm;
  mj_collision(scene.model, scene.data);
  said.hit(scene.data->ncon > 0);
  if (scene.data->ncon == 0) return;
  // Parallel capsules may have two: the deeper one.
  const mjContact& contact = *std::min_element(scene.data->contact, scene.data->contact + scene.data->ncon,
                                               [](const mjContact& x, const mjContact& y) { return x.dist < y.dist; });
  said.normal(contact.frame);
  said.midpoint(contact.pos);
  said.value(contact.dist);
}

}  // namespace contact::adapters
