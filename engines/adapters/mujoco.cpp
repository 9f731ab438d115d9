// MuJoCo: mj_collision on one predefined pair of spheres, boxes, capsules, planes and meshes, of which it takes the hull; mju_rayGeom for a ray and a
// sphere. With MUJOCO_CONVEX mjc_Convex, its general convex collision, in the place of the functions of two kinds: the
// table of collision functions is there for users to change.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "engines/adapters/adapter.hpp"

namespace contact::adapters {
namespace {

// Bodies that can move, but for planes, which only the world may have: between geoms of the world nothing is ever
// tested.
struct Scene {
  Scene(const std::string& first, const std::string& second, const std::string& assets = "") {
    const auto geom = [](const std::string& name, const std::string& type) {
      const std::string made = R"(<geom name=")" + name + R"(" type=")" + type + '"' +
                               (type == "mesh" ? R"( mesh=")" + name + '"' : R"( size="1 1 1")") + "/>";
      return type == "plane" ? made : "<body><freejoint/>" + made + "</body>";
    };
    // The world's geoms are numbered before those of bodies.
    first_geom = second == "plane" ? 1 : 0;
    const std::string text = R"(<mujoco><option collision="predefined"/>)" + assets + "<worldbody>" + geom("a", first) +
                             geom("b", second) +
                             R"(</worldbody><contact><pair geom1="a" geom2="b"/></contact></mujoco>)";
    static mjVFS files;  // it holds megabytes
    mj_defaultVFS(&files);
    mj_makeEmptyFileVFS(&files, "model.xml", static_cast<int>(text.size()));
    std::memcpy(files.filedata[0], text.data(), text.size());
    char error[1000] = "";
    model = mj_loadXML("model.xml", &files, error, sizeof error);
    mj_deleteVFS(&files);
    if (!model) throw std::runtime_error(error);
    data = mj_makeData(model);
    mj_kinematics(model, data);
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
  ~Scene() {
    mj_deleteData(data);
    mj_deleteModel(model);
  }
  /// False where its compiler would refuse the shapes: a box without thickness, a capsule without length.
  [[nodiscard]] bool set(const Shape& a, const Shape& b) const { return set(first_geom, a) && set(1 - first_geom, b); }
  [[nodiscard]] bool set(int geom, const Shape& x) const {
    if (x.kind == Kind::hull) return true;  // its model has been made of it
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

/// A hull as its users have it: in a model of its own, which keeps its vertices in single precision and turned to its
/// axes of inertia.
std::string mesh_of(const std::string& name, const Shape& x) {
  if (x.kind != Kind::hull) return "";
  std::ostringstream text;
  text.precision(17);
  for (int i = 0; i < 3 * x.vertices(); ++i) text << x.vertex(0)[i] << ' ';
  return R"(<mesh name=")" + name + R"(" vertex=")" + text.str() + R"("/>)";
}

const char* type_of(const Shape& x) {
  switch (x.kind) {
    case Kind::sphere:
      return "sphere";
    case Kind::capsule:
      return "capsule";
    case Kind::plane:
      return "plane";
    case Kind::hull:
      return "mesh";
    default:
      return "box";
  }
}

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
         (kConvex
              ? ""
              : R"(,"ray_sphere","sphere_plane","capsule_plane","cube_plane","obb_plane","hull_plane",)" SOLID_HULL_PAIRS) +
         R"(],"conventions":{"points":")" + (kConvex ? "none" : "midpoint") +
         R"(",)"
         R"("value_less_contact":false,"shapes":"centered","scale":{"min":0,"max":1e10}},)"
         R"("pair_conventions":{)" +
         (kConvex
              ? ""
              : R"("ray_sphere":{"shapes":"given","margin":"none","normal":"none","points":"none","value":"none"},)"
                R"("sphere_plane":{"normal":"second-to-first"},"capsule_plane":{"normal":"second-to-first"},)"
                R"("cube_plane":{"normal":"second-to-first","points":"manifold"},)"
                R"("obb_plane":{"normal":"second-to-first","points":"manifold"},)"
                R"("hull_plane":{"normal":"second-to-first","points":"manifold"},)" NO_POINTS_OF_HULLS
                ","
                R"("obb_obb":{"depth":"any_separating","points":"manifold"},"cube_obb":{"depth":"any_separating","points":"manifold"})") +
         "}}";
}

void answer(const Question& q, Answer& said) {
  // Its own handler waits for somebody to press Enter.
  mju_user_error = [](const char* message) { throw std::runtime_error(message); };
  if (kConvex)
    for (const int first : {mjGEOM_SPHERE, mjGEOM_CAPSULE, mjGEOM_BOX})
      for (const int second : {mjGEOM_SPHERE, mjGEOM_CAPSULE, mjGEOM_BOX})
        if (first <= second) mjCOLLISIONFUNC[first][second] = mjCOLLISIONFUNC[mjGEOM_MESH][mjGEOM_MESH];
  if (q.pair == CONTACT_RAY_SPHERE) {
    // How far along the direction, in lengths of it; where the ray enters is no nearest point.
    const double* ray = q.a.numbers;
    const double radius[3] = {q.b.radius};
    const mjtNum distance = mju_rayGeom(q.b.center, nullptr, radius, ray, ray + 3, mjGEOM_SPHERE);
    return said.hit(distance >= 0 && distance <= ray[6]);
  }
  const bool of_hull = q.a.kind == Kind::hull || q.b.kind == Kind::hull;
  if ((q.a.kind == Kind::hull && q.a.radius > 0) || (q.b.kind == Kind::hull && q.b.radius > 0))
    return said.unsupported();  // a mesh has none
  const std::string first = type_of(q.a);
  const std::string second = type_of(q.b);
  static std::map<std::string, std::unique_ptr<const Scene>> scenes;
  std::unique_ptr<const Scene>& kept = scenes[first + second];
  if (!kept || of_hull) try {
      kept =
          std::make_unique<const Scene>(first, second, "<asset>" + mesh_of("a", q.a) + mesh_of("b", q.b) + "</asset>");
    } catch (const std::exception&) {
      if (!of_hull) throw;
      return said.unsupported();  // its compiler refuses a mesh without a volume
    }
  const Scene& scene = *kept;
  if (!scene.set(q.a, q.b)) return said.unsupported();
  scene.model->pair_margin[0] = q.alarm;
  mj_collision(scene.model, scene.data);
  said.hit(scene.data->ncon > 0);
  if (scene.data->ncon == 0) return;
  // Parallel capsules may have two, boxes several: the deepest one has the value.
  const mjContact& contact = *std::min_element(scene.data->contact, scene.data->contact + scene.data->ncon,
                                               [](const mjContact& x, const mjContact& y) { return x.dist < y.dist; });
  said.normal(contact.frame);
  const bool is_solid_over_plane = q.b.kind == Kind::plane && (q.a.is_box() || of_hull);
  if (!kConvex && (is_solid_over_plane || (q.a.is_box() && q.b.is_box())))
    std::for_each(scene.data->contact, scene.data->contact + scene.data->ncon,
                  [&](const mjContact& each) { said.add_point(each.pos, -each.dist); });
  else if (!kConvex && !of_hull)
    said.midpoint(contact.pos);  // elsewhere it is where a force would be put
  said.value(contact.dist);
}

}  // namespace contact::adapters
