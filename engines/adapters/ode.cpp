// Open Dynamics Engine: dCollide on sphere, box, capsule, plane and convex geoms, and on a mesh of one triangle, of which
// it knows one side. Not on two such meshes, nor on one and a convex geom, which ends the process: these walk trees that
// meshes of one triangle have none of.
#include <ode/ode.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "engines/adapters/ode_convex.hpp"

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
         R"("capsule_triangle","cube_obb","cube_triangle","obb_triangle",)" CONVEX_PLANE_PAIRS "," SOLID_HULL_PAIRS
         R"(,"hull_plane"],"conventions":{"normal":"second-to-first","points":"midpoint",)"
         R"("value":"depth","value_less_contact":false,"margin":"none","shapes":"centered"},)"
         R"("pair_conventions":{"sphere_cube":{"points":"second_only"},"sphere_triangle":{"points":"second_only"},)"
         R"("sphere_plane":{"points":"first_only"},"capsule_plane":{"points":"first_only"},)"
         R"("obb_obb":{"points":"manifold","depth":"any_separating"},"cube_obb":{"points":"manifold","depth":"any_separating"},"cube_triangle":{"points":"none"},)"
         R"("obb_triangle":{"points":"none"},"sphere_obb":{"points":"second_only"},)" NO_POINTS_OF_HULLS
         R"(,"hull_plane":{"points":"manifold","most_points":16},"capsule_triangle":{"points":"first_only"},"cube_plane":{"points":"manifold"},)"
         R"("obb_plane":{"points":"manifold"},"triangle_plane":{"points":"first_only"}}})";
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
  // Those that are made anew for each question.
  std::array<std::optional<Mesh>, 2> meshes;
  std::array<std::optional<Convex>, 2> hulls;
  const auto placed = [&](const auto& geoms, const Shape& x, std::size_t which) -> dGeomID {
    if (x.kind == Kind::triangle) return meshes[which].emplace(x).geom;
    if (x.kind == Kind::plane) {
      const auto real = [](double number) { return static_cast<dReal>(number); };
      dGeomPlaneSetParams(plane, real(x.normal[0]), real(x.normal[1]), real(x.normal[2]), real(x.offset));
      return plane;
    }
    if (x.kind != Kind::hull) return set(geoms, x);
    const auto found = x.radius > 0 ? std::nullopt : polyhedron_of(x);
    return found ? hulls[which].emplace(*found).geom : nullptr;
  };
  const dGeomID a = placed(first, q.a, 0);
  const dGeomID b = placed(second, q.b, 1);
  if (!a || !b) return said.unsupported();  // a hull with a radius, or without a volume
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
  const bool is_solid_over_plane = q.b.kind == Kind::plane && (q.a.is_box() || q.a.kind == Kind::hull);
  if (is_solid_over_plane || (q.a.is_box() && q.b.is_box())) {
    std::for_each(contacts.begin(), contacts.begin() + count,
                  [&](const dContactGeom& each) { said.add_point(each.pos, each.depth); });
    return said.value(contact.depth);
  }
  if (q.a.kind == Kind::sphere && (q.b.is_box() || q.b.kind == Kind::triangle))
    said.point2(contact.pos);
  else if (q.b.kind == Kind::plane || (q.b.kind == Kind::triangle && !q.a.is_box()))
    said.point1(contact.pos);
  else if (!q.a.is_box() && q.b.kind != Kind::hull)  // where libccd puts a force, which is no point of ours
    said.midpoint(contact.pos);
  said.value(contact.depth);
}

}  // namespace contact::adapters
