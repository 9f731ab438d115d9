// The table of adapters, and where they are.
#include "engines/adapters.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

#include "formats/program.hpp"

namespace contact::engines {
namespace {

using enum Scalar;

constexpr std::array kAdapters{
    Adapter{"fcl", "FCL: collide; AABB::overlap for two boxes", binary64},
    Adapter{"fcl-distance", "FCL: distance", binary64},
    Adapter{"bullet", "Bullet in double precision: contactPairTest; TestAabbAgainstAabb2 for two boxes", binary64},
    Adapter{"bullet-float", "Bullet in single precision: contactPairTest; TestAabbAgainstAabb2 for two boxes",
            binary32},
    Adapter{"bullet-gjk", "Bullet in double precision: btGjkPairDetector", binary64},
    Adapter{"bullet-gjk-float", "Bullet in single precision: btGjkPairDetector", binary32},
    Adapter{"bullet-box", "Bullet in double precision: btBoxBoxDetector", binary64},
    Adapter{"bullet-box-float", "Bullet in single precision: btBoxBoxDetector", binary32},
    Adapter{"bullet-mpr-float", "Bullet in single precision: btComputeMprPenetration", binary32},
    Adapter{"ode", "Open Dynamics Engine: dCollide", binary64},
    Adapter{"libccd", "libccd: Minkowski portal refinement", binary64},
    Adapter{"libccd-gjk", "libccd: GJK with EPA", binary64},
    Adapter{"mujoco", "MuJoCo: mj_collision on a predefined pair", binary64},
    Adapter{"mujoco-convex", "MuJoCo: mjc_Convex in the place of the functions of two kinds of geoms", binary64},
    Adapter{"dart", "DART: its own collision detector", binary64},
    Adapter{"simbody", "Simbody: ContactTracker::SphereSphere, HalfSpaceSphere, HalfSpaceBrick", binary64},
    Adapter{"cgal-epick", "CGAL: squared distances and do_intersect with a rounded reach", binary64},
    Adapter{"eigen", "Eigen: AlignedBox3d::intersects, squaredExteriorDistance", binary64},
    Adapter{"rapier", "Rapier: contactShape, intersectsShape", binary32, "@dimforge/rapier3d-compat"},
    Adapter{"cannon", "cannon-es: the narrow phase of spheres, boxes, planes and a mesh", binary64, "cannon-es"},
    Adapter{"cannon-aabb", "cannon-es: AABB.overlaps", binary64, "cannon-es"},
    Adapter{"jolt", "Jolt Physics: TransformedShape.CollideShape", binary32, "jolt-physics"},
    Adapter{"physx", "PhysX: PxGjkQuery.proximityInfo", binary32, "physx-js-webidl"},
    Adapter{"havok", "Havok: HP_World_ShapeProximityWithCollector", binary32, "@babylonjs/havok"},
    Adapter{"ammo", "ammo.js (Bullet): contactPairTest", binary32, "ammo.js"},
    Adapter{"oimo", "oimo: the detectors of spheres and boxes", binary64, "oimo"},
    Adapter{"mujoco-js", "MuJoCo's WebAssembly: mj_collision on a predefined pair", binary64, "@mujoco/mujoco"},
    Adapter{"three", "three.js: intersectsSphere, intersectsBox, OBB, Capsule and Octree", binary64, "three"},
};

namespace fs = std::filesystem;

/// The engines in JavaScript, with what npm installed for them.
fs::path node_folder() { return fs::weakly_canonical(formats::data_folder() / "node"); }

fs::path module_of(const Adapter& adapter) { return node_folder() / (std::string(adapter.name) + ".mjs"); }

/// Libraries lie beside this program, which serves them, so that a crash of one is the other's end.
fs::path library_of(const Adapter& adapter) {
  return formats::program().parent_path() / "engines" / (std::string(adapter.name) + ".so");
}

}  // namespace

std::span<const Adapter> adapters() { return kAdapters; }

const Adapter* find_adapter(std::string_view name) {
  const auto found =
      std::find_if(kAdapters.begin(), kAdapters.end(), [&](const Adapter& adapter) { return adapter.name == name; });
  return found == kAdapters.end() ? nullptr : &*found;
}

std::optional<std::vector<std::string>> command_of(const Adapter& adapter) {
  if (!adapter.npm.empty()) {
    if (!fs::exists(node_folder() / "node_modules" / adapter.npm)) return std::nullopt;
    return {{"node", module_of(adapter)}};
  }
  if (!fs::exists(library_of(adapter))) return std::nullopt;
  return {{formats::program(), "serve", "--engine-library", library_of(adapter)}};
}

std::vector<fs::path> files_of(const Adapter& adapter) {
  if (adapter.npm.empty()) return {library_of(adapter)};
  return {module_of(adapter), node_folder() / "package-lock.json"};
}

}  // namespace contact::engines
