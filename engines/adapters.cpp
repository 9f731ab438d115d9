// The table of adapters, and where they are.
#include "engines/adapters.hpp"

#include <array>
#include <filesystem>

namespace contact::engines {
namespace {

using enum Scalar;

constexpr std::array kAdapters{
    Adapter{"fcl", "FCL: collide; AABB::overlap for boxes", binary64},
    Adapter{"fcl-distance", "FCL: distance", binary64},
    Adapter{"bullet", "Bullet in double precision: contactPairTest; TestAabbAgainstAabb2 for boxes", binary64},
    Adapter{"bullet-float", "Bullet in single precision: contactPairTest; TestAabbAgainstAabb2 for boxes", binary32},
    Adapter{"bullet-gjk", "Bullet in double precision: btGjkPairDetector", binary64},
    Adapter{"bullet-gjk-float", "Bullet in single precision: btGjkPairDetector", binary32},
    Adapter{"ode", "Open Dynamics Engine: dCollide", binary64},
    Adapter{"libccd", "libccd: Minkowski portal refinement", binary64},
    Adapter{"libccd-gjk", "libccd: GJK with EPA", binary64},
    Adapter{"mujoco", "MuJoCo: mj_collision on a predefined pair", binary64},
    Adapter{"dart", "DART: its own collision detector", binary64},
    Adapter{"simbody", "Simbody: ContactTracker::SphereSphere", binary64},
    Adapter{"cgal-epick", "CGAL: compare_squared_distance with a rounded reach", binary64},
    Adapter{"eigen", "Eigen: AlignedBox3d::intersects", binary64},
    Adapter{"rapier", "Rapier: contactShape, intersectsShape", binary32, "@dimforge/rapier3d-compat"},
    Adapter{"cannon", "cannon-es: the narrow phase of spheres", binary64, "cannon-es"},
    Adapter{"cannon-aabb", "cannon-es: AABB.overlaps", binary64, "cannon-es"},
    Adapter{"jolt", "Jolt Physics: TransformedShape.CollideShape", binary32, "jolt-physics"},
    Adapter{"physx", "PhysX: PxGjkQuery.proximityInfo", binary32, "physx-js-webidl"},
    Adapter{"havok", "Havok: HP_World_ShapeProximityWithCollector", binary32, "@babylonjs/havok"},
    Adapter{"ammo", "ammo.js (Bullet): contactPairTest", binary32, "ammo.js"},
    Adapter{"oimo", "oimo: the detector of two spheres", binary64, "oimo"},
    Adapter{"mujoco-js", "MuJoCo's WebAssembly: mj_collision on a predefined pair", binary64, "@mujoco/mujoco"},
    Adapter{"three", "three.js: intersectsSphere, intersectsBox", binary64, "three"},
};

}  // namespace

std::span<const Adapter> adapters() { return kAdapters; }

std::optional<std::vector<std::string>> command_of(const Adapter& adapter) {
  namespace fs = std::filesystem;
  if (!adapter.npm.empty()) {
    const fs::path folder = CONTACT_NODE_DIR;
    if (!fs::exists(folder / "node_modules" / adapter.npm)) return std::nullopt;
    return {{"node", folder / (std::string(adapter.name) + ".mjs")}};
  }
  // The libraries lie beside this program, which serves them, so that a crash of one is the other's end.
  const fs::path program = fs::read_symlink("/proc/self/exe");
  const fs::path library = program.parent_path() / "engines" / (std::string(adapter.name) + ".so");
  if (!fs::exists(library)) return std::nullopt;
  return {{program, "serve", "--engine-library", library}};
}

}  // namespace contact::engines
