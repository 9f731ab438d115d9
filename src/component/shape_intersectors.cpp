// Intersectors of capsules, and of spheres against solid cubes.
#include "contact/shape_intersectors.hpp"

namespace contact {

CapsuleDiscreteIntersection::CapsuleDiscreteIntersection(DiscreteIntersection& object) : ShapeIntersector(object) {
  object.intersectors.add<CapsuleCollisionModel, CapsuleCollisionModel>(*this);
  object.intersectors.add<SphereCollisionModel, CapsuleCollisionModel>(*this);
  object.intersectors.add<RigidSphereModel, CapsuleCollisionModel>(*this);
}

SolidCubeDiscreteIntersection::SolidCubeDiscreteIntersection(DiscreteIntersection& object) : ShapeIntersector(object) {
  object.intersectors.add<SphereCollisionModel, CubeCollisionModel>(*this);
  object.intersectors.add<RigidSphereModel, CubeCollisionModel>(*this);
}

}  // namespace contact
