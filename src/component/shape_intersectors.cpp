// Intersectors of capsules, rays, lines, triangles and planes, and of spheres against solid cubes.
#include "contact/shape_intersectors.hpp"

namespace contact::inline CONTACT_ABI {

CapsuleDiscreteIntersection::CapsuleDiscreteIntersection(DiscreteIntersection& object) : ShapeIntersector(object) {
  object.intersectors.add<CapsuleCollisionModel, CapsuleCollisionModel>(*this);
  object.intersectors.add<SphereCollisionModel, CapsuleCollisionModel>(*this);
  object.intersectors.add<RigidSphereModel, CapsuleCollisionModel>(*this);
}

MeshDiscreteIntersection::MeshDiscreteIntersection(DiscreteIntersection& object) : ShapeIntersector(object) {
  object.intersectors.add<SphereCollisionModel, TriangleCollisionModel>(*this);
  object.intersectors.add<RigidSphereModel, TriangleCollisionModel>(*this);
  object.intersectors.add<TriangleCollisionModel, LineCollisionModel>(*this);
}

RayDiscreteIntersection::RayDiscreteIntersection(DiscreteIntersection& object) : ShapeIntersector(object) {
  object.intersectors.add<RayCollisionModel, SphereCollisionModel>(*this);
  object.intersectors.add<RayCollisionModel, RigidSphereModel>(*this);
  object.intersectors.add<RayCollisionModel, TriangleCollisionModel>(*this);
}

PlaneDiscreteIntersection::PlaneDiscreteIntersection(DiscreteIntersection& object) : ShapeIntersector(object) {
  object.intersectors.add<SphereCollisionModel, PlaneCollisionModel>(*this);
  object.intersectors.add<RigidSphereModel, PlaneCollisionModel>(*this);
  object.intersectors.add<CapsuleCollisionModel, PlaneCollisionModel>(*this);
}

SolidCubeDiscreteIntersection::SolidCubeDiscreteIntersection(DiscreteIntersection& object) : ShapeIntersector(object) {
  object.intersectors.add<SphereCollisionModel, CubeCollisionModel>(*this);
  object.intersectors.add<RigidSphereModel, CubeCollisionModel>(*this);
}

}  // namespace contact::inline CONTACT_ABI
