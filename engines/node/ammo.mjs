// ammo.js (Bullet): contactPairTest of bodies that are spheres, boxes, capsules or planes.
import {centered, serve, versionOf} from './loop.mjs';
import ammo from 'ammo.js';

const configuration = new ammo.btDefaultCollisionConfiguration();
const world = new ammo.btDiscreteDynamicsWorld(new ammo.btCollisionDispatcher(configuration), new ammo.btDbvtBroadphase(),
  new ammo.btSequentialImpulseConstraintSolver(), configuration);
const numbers = (v) => [v.x(), v.y(), v.z()];
let contact = null;
const callback = new ammo.ConcreteContactResultCallback();
callback.addSingleResult = (pointer) => {
  const point = ammo.wrapPointer(pointer, ammo.btManifoldPoint);
  contact = {
    normal: numbers(point.get_m_normalWorldOnB()), point1: numbers(point.get_m_positionWorldOnA()),
    point2: numbers(point.get_m_positionWorldOnB()), value: point.getDistance(),
  };
  return 0;
};

// It computes in double precision and keeps every number in single.
serve({
  engine: {name: 'ammo', version: versionOf('ammo.js')}, scalar: 'binary32', 
  pairs: ['sphere_sphere', 'sphere_cube', 'sphere_capsule', 'capsule_capsule', 'sphere_plane', 'capsule_plane'],
  conventions: {normal: 'second-to-first', value_less_contact: false, margin: 'none', shapes: 'centered'},
}, ({pair, a, b}) => {
  const made = [];
  const make = (thing) => (made.push(thing), thing);
  const body = (center, shape) => {
    const object = make(new ammo.btPairCachingGhostObject());
    object.setCollisionShape(make(shape));
    object.getWorldTransform().setOrigin(make(new ammo.btVector3(...center)));
    return object;
  };
  const shapes = {
    sphere: ({radius}) => new ammo.btSphereShape(radius),
    box: ({half}) => {
      const shape = new ammo.btBoxShape(make(new ammo.btVector3(...half)));
      shape.setMargin(0); // with one its edges are round
      return shape;
    },
    plane: ({normal}) => new ammo.btStaticPlaneShape(make(new ammo.btVector3(...normal)), 0),
    capsule: ({axis, halfLength, radius}) =>
      new [ammo.btCapsuleShapeX, ammo.btCapsuleShape, ammo.btCapsuleShapeZ][axis](radius, 2 * halfLength),
  };
  const placed = (like) => {
    const shape = centered(like);
    return body(shape.center, shapes[shape.kind](shape));
  };
  contact = null;
  world.contactPairTest(placed(a), placed(b), callback);
  made.forEach((thing) => ammo.destroy(thing));
  // Of other shapes than two spheres it tells of gaps up to the contact breaking threshold too: the distance is for the user to compare.
  if (pair !== 'sphere_sphere' && contact?.value > 0) contact = null;
  return {overlap: contact !== null, contact};
});
