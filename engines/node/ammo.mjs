// ammo.js (Bullet): contactPairTest of bodies that are spheres, boxes, capsules, planes, hulls, or a triangle: a mesh, or the hull of its
// corners where it comes first.
import {centered, hullPairs, serve, versionOf} from './loop.mjs';
import ammo from 'ammo.js';

const configuration = new ammo.btDefaultCollisionConfiguration();
const world = new ammo.btDiscreteDynamicsWorld(new ammo.btCollisionDispatcher(configuration), new ammo.btDbvtBroadphase(),
  new ammo.btSequentialImpulseConstraintSolver(), configuration);
const numbers = (v) => [v.x(), v.y(), v.z()];
let contact = null;
const callback = new ammo.ConcreteContactResultCallback();
callback.addSingleResult = (pointer) => {
  const point = ammo.wrapPointer(pointer, ammo.btManifoldPoint);
  // Of several contacts the deepest.
  if (contact?.value <= point.getDistance()) return 0;
  contact = {
    normal: numbers(point.get_m_normalWorldOnB()), point1: numbers(point.get_m_positionWorldOnA()),
    point2: numbers(point.get_m_positionWorldOnB()), value: point.getDistance(),
  };
  return 0;
};

// It computes in double precision and keeps every number in single.
serve({
  engine: {name: 'ammo', version: versionOf('ammo.js')}, scalar: 'binary32', rounds: ['orientation'],
  pairs: ['sphere_sphere', 'sphere_cube', 'sphere_capsule', 'capsule_capsule', 'sphere_plane', 'capsule_plane', 'obb_obb', 'sphere_obb', 'capsule_cube', 'capsule_obb', 'capsule_triangle',
    'cube_obb', 'cube_triangle', 'obb_triangle', 'triangle_triangle', 'cube_plane', 'obb_plane', 'triangle_plane',
    ...hullPairs, 'triangle_hull', 'hull_plane'],
  conventions: {normal: 'second-to-first', value_less_contact: false, margin: 'none', shapes: 'centered'},
}, ({pair, a, b}) => {
  const made = [];
  const make = (thing) => (made.push(thing), thing);
  const vector = (numbers) => make(new ammo.btVector3(...numbers));
  const shapes = {
    sphere: ({radius}) => new ammo.btSphereShape(radius),
    box: ({half}) => {
      const shape = new ammo.btBoxShape(vector(half));
      shape.setMargin(0); // with one its edges are round
      return shape;
    },
    plane: ({normal}) => new ammo.btStaticPlaneShape(vector(normal), 0),
    capsule: ({axis, halfLength, radius}) =>
      new [ammo.btCapsuleShapeX, ammo.btCapsuleShape, ammo.btCapsuleShapeZ][axis](radius, 2 * halfLength),
    hull: ({vertices, radius = 0}) => {
      const shape = new ammo.btConvexHullShape();
      vertices.forEach((v) => shape.addPoint(vector(v)));
      shape.setMargin(radius); // which rounds it
      return shape;
    },
    triangle: ({vertices}) => {
      const mesh = make(new ammo.btTriangleMesh());
      mesh.addTriangle(...vertices.map(vector));
      return new ammo.btBvhTriangleMeshShape(mesh, true);
    },
  };
  const placed = (like, i) => {
    const shape = centered(like);
    const object = make(new ammo.btPairCachingGhostObject());
    object.setCollisionShape(make(shapes[shape.kind === 'triangle' && i === 0 ? 'hull' : shape.kind](shape)));
    object.getWorldTransform().setOrigin(vector(shape.center));
    if (shape.turn) object.getWorldTransform().setRotation(make(new ammo.btQuaternion(...shape.turn)));
    return object;
  };
  contact = null;
  world.contactPairTest(...[a, b].map(placed), callback);
  made.forEach((thing) => ammo.destroy(thing));
  // Of other shapes than two spheres it tells of gaps up to the contact breaking threshold too: the distance is for the user to compare.
  if (pair !== 'sphere_sphere' && contact?.value > 0) contact = null;
  return {overlap: contact !== null, contact};
});
