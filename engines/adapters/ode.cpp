// Open Dynamics Engine: dCollide on sphere, box, capsule and plane geoms, and on a mesh of one triangle, of which it
// knows one side. Not on two such meshes, which ends the process: dCollideTTL walks trees that meshes of one triangle have
// none of.
#include <ode/ode.h>

#include <algorithm>
#include <array>
#include <optional>

#include "engines/adapters/adapter.hpp"

namespace contact::adapters {
namespace {

/// A mesh of one triangle, which stays where it is.
class Mesh {
 public:
  explicit Mesh(const Shape& triangle) {
    for (int i = 0; i < 9; ++i) corners_[4 * (i / 3) + i % 3] = static_cast<dReal>(triangle.numbers[i]);
    const auto build = sizeof(dReal) == sizeof(double) ? dGeomTriMeshDataBuildDouble : dGeomTriMeshDataBuildSingle;
    build(data_, corners_, 4 * sizeof(dReal), 3, order_, 3, 3 * sizeof(dTriIndex));
    geom = dCreateTriMesh(nullptr, data_, nullptr, nullptr, nullptr);
  }
  Mesh(const Mesh&) = delete;
  Mesh& operator=(const Mesh&) = delete;
  ~Mesh() {
    dGeomDestroy(geom);
    dGeomTriMeshDataDestroy(data_);
  }

 private:
  dReal corners_[12] = {};
  dTriIndex order_[3] = {0, 1, 2};
  dTriMeshDataID data_ = dGeomTriMeshDataCreate();

 public:
  dGeomID geom;
};

}  // namespace

// dCollideSphereBox puts its contact on the box, and what is on a plane has it at its own lowest point. A ray has a
// unit direction and a length here, which its user would have to round; so rays are not asked.
std::string declaration() {
  return R"({"engine":{"name":"ode","version":")" dODE_VERSION R"("},"scalar":")" +
         std::string(sizeof(dReal) == sizeof(double) ? "binary64" : "binary32") +
         R"(","rounds":["orientation"],"pairs":["sphere_sphere","sphere_cube","sphere_capsule","capsule_capsule",)"
         R"("sphere_triangle","sphere_plane","capsule_plane","obb_obb","sphere_obb","capsule_cube","capsule_obb",)"
         R"("capsule_triangle","cube_obb","cube_triangle","obb_triangle",)" CONVEX_PLANE_PAIRS
         R"(],"conventions":{"normal":"second-to-first","points":"midpoint",)"
         R"("value":"depth","value_less_contact":false,"margin":"none","shapes":"centered"},)"
         R"("pair_conventions":{"sphere_cube":{"points":"second_only"},"sphere_triangle":{"points":"second_only"},)"
         R"("sphere_plane":{"points":"first_only"},"capsule_plane":{"points":"first_only"},)"
         R"("obb_obb":{"points":"none","depth":"any_separating"},"cube_obb":{"points":"none","depth":"any_separating"},"cube_triangle":{"points":"none"},)"
         R"("obb_triangle":{"points":"none"},"sphere_obb":{"points":"second_only"},)"
         R"("capsule_triangle":{"points":"first_only"},"cube_plane":{"points":"first_only"},)"
         R"("obb_plane":{"points":"first_only"},"triangle_plane":{"points":"first_only"}}})";
}

void answer(const Question& q, Answer& said) {
  [[maybe_unused]] static const int initialized = dInitODE2(0);
  // One of each kind as the first shape and one as the second.
  static const auto made = [] {
    return std::array{dCreateSphere(nullptr, 1), dCreateBox(nullptr, 1, 1, 1), dCreateCapsule(nullptr, 1, 1)};
  };
  static const auto first = made();
  static const auto second = made();
  const auto set = [](const auto& geoms, const Shape& x) {
    const auto real = [](double number) { return static_cast<dReal>(number); };
    const dGeomID geom = geoms[static_cast<std::size_t>(x.is_box() ? Kind::box : x.kind)];
    if (x.kind == Kind::sphere) dGeomSphereSetRadius(geom, real(x.radius));
    if (x.is_box()) dGeomBoxSetLengths(geom, real(x.size[0]), real(x.size[1]), real(x.size[2]));
    if (x.kind == Kind::capsule) dGeomCapsuleSetParams(geom, real(x.radius), real(x.length()));
    dMatrix3 upright{};
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) upright[4 * row + column] = real(x.rotation(row, column));
    dGeomSetRotation(geom, upright);
    dGeomSetPosition(geom, real(x.center[0]), real(x.center[1]), real(x.center[2]));
    return geom;
  };
  static const dGeomID plane = dCreatePlane(nullptr, 0, 0, 1, 0);
  std::optional<Mesh> mesh_a;
  std::optional<Mesh> mesh_b;
  const dGeomID a = q.a.kind == Kind::triangle ? mesh_a.emplace(q.a).geom : set(first, q.a);
  dGeomID b = plane;
  if (q.b.kind == Kind::triangle) {
    b = mesh_b.emplace(q.b).geom;
  } else if (q.b.kind == Kind::plane) {
    const auto real = [](double number) { return static_cast<dReal>(number); };
    dGeomPlaneSetParams(plane, real(q.b.normal[0]), real(q.b.normal[1]), real(q.b.normal[2]), real(q.b.offset));
  } else {
    b = set(second, q.b);
  }
  // Where it tells of many points the deepest is the contact.
  std::array<dContactGeom, 16> contacts;
  const int most = q.pair >= CONTACT_OBB_OBB ? static_cast<int>(contacts.size()) : 1;
  const int count = dCollide(a, b, most, contacts.data(), sizeof contacts[0]);
  said.hit(count > 0);
  if (count == 0) return;
  const dContactGeom& contact =
      *std::max_element(contacts.begin(), contacts.begin() + count,
                        [](const dContactGeom& x, const dContactGeom& y) { return x.depth < y.depth; });
  said.normal(contact.normal);
  if (q.a.kind == Kind::sphere && (q.b.is_box() || q.b.kind == Kind::triangle))
    said.point2(contact.pos);
  else if (q.b.kind == Kind::plane || (q.b.kind == Kind::triangle && !q.a.is_box()))
    said.point1(contact.pos);
  else if (!q.a.is_box())
    said.midpoint(contact.pos);
  said.value(contact.depth);
}

}  // namespace contact::adapters
