// ammo.js (Bullet): contactPairTest of two sphere bodies.
import {serve, versionOf} from './loop.mjs';
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
  engine: {name: 'ammo', version: versionOf('ammo.js')}, scalar: 'binary32', pairs: ['sphere_sphere'],
  conventions: {normal: 'second-to-first', value_less_contact: false, margin: 'none'},
}, ({a, b}) => {
  const made = [];
  const make = (thing) => (made.push(thing), thing);
  const body = ({center, radius}) => {
    const object = make(new ammo.btPairCachingGhostObject());
    object.setCollisionShape(make(new ammo.btSphereShape(radius)));
    object.getWorldTransform().setOrigin(make(new ammo.btVector3(...center)));
    return object;
  };
  contact = null;
  world.contactPairTest(body(a), body(b), callback);
  made.forEach((thing) => ammo.destroy(thing));
  return {overlap: contact !== null, contact};
});
