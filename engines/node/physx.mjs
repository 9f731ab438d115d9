// PhysX: PxGjkQuery.proximityInfo with the alarm distance as its contact distance.
import {centered, numbers, serve, vector, versionOf} from './loop.mjs';
import {readFileSync} from 'node:fs';

// The module is built for browsers and refuses to load anywhere else.
const {process} = globalThis;
Object.assign(globalThis, {process: undefined, window: globalThis});
const {default: load} = await import('physx-js-webidl');
const physx = await load({wasmBinary: readFileSync(new URL('node_modules/physx-js-webidl/physx-js-webidl.wasm', import.meta.url))});
globalThis.process = process;
delete globalThis.window;

physx.CreateFoundation(physx.PHYSICS_VERSION, new physx.PxDefaultAllocator(), new physx.PxDefaultErrorCallback());
const [poseA, poseB] = [0, 1].map(() => new physx.PxTransform(physx.PxIDENTITYEnum.PxIdentity));
const half = new physx.PxVec3(1, 1, 1);
const typicalLength = new physx.PxTolerancesScale().length;
const found = new physx.PxGjkQueryProximityInfoResult();

serve({
  engine: {name: 'physx', version: versionOf('physx-js-webidl')}, scalar: 'binary32', pairs: ['sphere_sphere', 'sphere_cube'],
  conventions: {normal: 'second-to-first', value_less_contact: false, shapes: 'centered'},
}, ({pair, a, b, alarm}) => {
  const box = pair === 'sphere_cube' ? centered(b) : null;
  if (box) Object.assign(half, vector(box.half));
  const first = new physx.SphereSupport(a.radius);
  const second = box ? new physx.BoxSupport(half) : new physx.SphereSupport(b.radius);
  Object.assign(poseA.p, vector(a.center));
  Object.assign(poseB.p, vector((box ?? b).center));
  const hit = physx.PxGjkQuery.prototype.proximityInfo(first, second, poseA, poseB, alarm, typicalLength, found);
  physx.destroy(first);
  physx.destroy(second);
  if (!hit) return {overlap: false, contact: null};
  return {
    overlap: true,
    contact: {
      normal: numbers(found.separatingAxis), point1: numbers(found.pointA), point2: numbers(found.pointB),
      value: found.separation,
    },
  };
});
