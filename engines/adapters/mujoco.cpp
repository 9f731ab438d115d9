// MuJoCo: mj_collision on one predefined pair of spheres, boxes, capsules and planes; mju_rayGeom for a ray and a
// sphere. With MUJOCO_CONVEX mjc_Convex, its general convex collision, in the place of the functions of two kinds: the
// table of collision functions is there for users to change.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "engines/adapters/adapter.hpp"

namespace contact::adapters {
namespace {

// Bodies that can move, but for planes, which only the world may have: between geoms of the world nothing is ever
// tested.
struct Scene {
  Scene(const std::string& first, const std::string& second) {
    const auto geom = [](const std::string& name, const std::string& type) {
      const std::string made = R"(<geom name=")" + name + R"(" type=")" + type + R"(" size="1 1 1"/>)";
      return type == "plane" ? made : "<body><freejoint/>" + made + "</body>";
    };
    // The world's geoms are numbered before those of bodies.
    first_geom = second == "plane" ? 1 : 0;
    const std::string text = R"(<mujoco><option collision="predefined"/><worldbody>)" + geom("a", first) +
                             geom("b", second) +
                             R"(</worldbody><contact><pair geom1="a" geom2="b"/></contact></mujoco>)";
    static mjVFS files;  // it holds megabytes
    mj_defaultVFS(&files);
    mj_makeEmptyFileVFS(&files, "model.xml", static_cast<int>(text.size()));
    std::memcpy(files.filedata[0], text.data(), text.size());
    char error[1000] = "";
    model = mj_loadXML("model.xml", &files, error, sizeof error);
    if (!model) throw std::runtime_error(error);
    data = mj_makeData(model);
  }
  /// False where its compiler would refuse the shapes: a box without thickness, a capsule without length.
  [[nodiscard]] bool set(const Shape& a, const Shape& b) const { return set(first_geom, a) && set(1 - first_geom, b); }
  [[nodiscard]] bool set(int geom, const Shape& x) const {
    mjtNum* size = model->geom_size + 3 * geom;
    mjtNum& bound = model->geom_rbound[geom];  // as its compiler computes it
    std::copy(x.center, x.center + 3, data->geom_xpos + 3 * geom);
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) data->geom_xmat[9 * geom + 3 * row + column] = x.rotation(row, column);
    if (x.kind == Kind::plane) {
      for (int i = 0; i < 3; ++i) {
        data->geom_xpos[3 * geom + i] = x.normal[i] * x.offset;
        data->geom_xmat[9 * geom + 3 * i + 2] = x.normal[i];
      }
      return true;
    }
    if (x.is_box()) {
      std::copy(x.half, x.half + 3, size);
      bound = mju_norm3(x.half);
      return *std::min_element(x.half, x.half + 3) > 0;
    }
    size[0] = x.radius;
    size[1] = x.length() / 2;
    bound = size[0] + size[1];
    return x.kind == Kind::sphere || size[1] > 0;
  }
  int first_geom;
  mjModel* model;
  mjData* data;
};

}  // namespace

#ifdef MUJOCO_CONVEX
constexpr bool kConvex = true;
#else
constexpr bool kConvex = false;
#endif

// The scale is mjMAXVAL, beyond which MuJoCo calls a coordinate bad.
std::string declaration() {
  return std::string(R"({"engine":{"name":"mujoco)") + (kConvex ? "-convex" : "") + R"(","version":")" +
         mj_versionString() +
         R"("},"scalar":"binary64","rounds":["orientation"],"pairs":["sphere_sphere","sphere_cube","sphere_capsule","capsule_capsule","obb_obb",)"
         R"("sphere_obb","capsule_cube","capsule_obb","cube_obb")" +
         (kConvex ? "" : R"(,"ray_sphere","sphere_plane","capsule_plane","cube_plane","obb_plane")") +
         R"(],"conventions":{"points":")" + (kConvex ? "none" : "midpoint") +
         R"(",)"
         R"("value_less_contact":false,"shapes":"centered","scale":{"min":0,"max":1e10}},)"
         R"("pair_conventions":{)" +
         (kConvex ? ""
                  : R"("ray_sphere":{"shapes":"given","margin":"none","normal":"none","points":"none","value":"none"},)"
                    R"("sphere_plane":{"normal":"second-to-first"},"capsule_plane":{"normal":"second-to-first"},)"
                    R"("cube_plane":{"normal":"second-to-first"},"obb_plane":{"normal":"second-to-first"},)"
                    R"("obb_obb":{"depth":"any_separating"},"cube_obb":{"depth":"any_separating"})") +
         "}}";
}

void answer(const Question& q, Answer& said) {
  // Its own handler waits for somebody to press Enter.
  mju_user_error = [](const char* message) { throw std::runtime_error(message); };
  if (kConvex)
    for (const int first : {mjGEOM_SPHERE, mjGEOM_CAPSULE, mjGEOM_BOX})
      for (const int second : {mjGEOM_SPHERE, mjGEOM_CAPSULE, mjGEOM_BOX})
        if (first <= second) mjCOLLISIONFUNC[first][second] = mjCOLLISIONFUNC[mjGEOM_MESH][mjGEOM_MESH];
  static const Scene spheres("sphere", "sphere");
  static const Scene sphere_and_box("sphere", "box");
  static const Scene sphere_and_capsule("sphere", "capsule");
  static const Scene capsules("capsule", "capsule");
  static const Scene sphere_on_plane("sphere", "plane");
  static const Scene capsule_on_plane("capsule", "plane");
  static const Scene boxes("box", "box");
  static const Scene capsule_and_box("capsule", "box");
  static const Scene box_on_plane("box", "plane");
  if (q.pair == CONTACT_RAY_SPHERE) {
    // How far along the direction, in lengths of it; where the ray enters is no nearest point.
    const double* ray = q.a.numbers;
    const double radius[3] = {q.b.radius};
    const mjtNum distance = mju_rayGeom(q.b.center, nullptr, radius, ray, ray + 3, mjGEOM_SPHERE);
    return said.hit(distance >= 0 && distance <= ray[6]);
  }
  const bool of_ball = q.a.kind == Kind::sphere;
  const bool of_capsule = q.a.kind == Kind::capsule;
  const Scene& scene = q.b.kind == Kind::plane     ? of_ball      ? sphere_on_plane
                                                     : of_capsule ? capsule_on_plane
                                                                  : box_on_plane
                       : q.b.is_box()              ? of_ball      ? sphere_and_box
                                                     : of_capsule ? capsule_and_box
                                                                  : boxes
                       : q.b.kind == Kind::capsule ? of_ball ? sphere_and_capsule : capsules
                                                   : spheres;
  if (!scene.set(q.a, q.b)) return said.unsupported();
  scene.model->pair_margin[0] = q.alarm;
  mj_collision(scene.model, scene.data);
  said.hit(scene.data->ncon > 0);
  if (scene.data->ncon == 0) return;
  // Parallel capsules may have two, boxes several: the deepest one.
  const mjContact& contact = *std::min_element(scene.data->contact, scene.data->contact + scene.data->ncon,
                                               [](const mjContact& x, const mjContact& y) { return x.dist < y.dist; });
  said.normal(contact.frame);
  if (!kConvex) said.midpoint(contact.pos);  // elsewhere it is where a force would be put
  said.value(contact.dist);
}

}  // namespace contact::adapters
