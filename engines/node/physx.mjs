// PhysX: PxGjkQuery.proximityInfo with the alarm distance as its contact distance.
import {centered, hullPairs, numbers, rotation, serve, vector, versionOf} from './loop.mjs';
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
const extents = new physx.PxVec3(1, 1, 1);
// A triangle is a shape of the user's own, which PhysX knows by its support function.
const dot = (u, v) => u.x * v.x + u.y * v.y + u.z * v.z;
const triangle = ({vertices}) => {
  const corners = vertices.map(vector);
  return Object.assign(new physx.CustomSupportImpl(), {
    getCustomMargin: () => 0,
    getCustomSupportLocal: (direction, result) => {
      const along = physx.wrapPointer(direction, physx.PxVec3);
      const {x, y, z} = corners.reduce((best, corner) => (dot(corner, along) > dot(best, along) ? corner : best));
      Object.assign(physx.wrapPointer(result, physx.PxVec3), {x, y, z});
    },
  });
};
// A hull is cooked, and has a margin.
const scaleOfLengths = new physx.PxTolerancesScale();
const cooking = new physx.PxCookingParams(scaleOfLengths);
const [one, unturned] = [new physx.PxVec3(1, 1, 1), new physx.PxQuat(physx.PxIDENTITYEnum.PxIdentity)];
const hull = ({vertices, radius}) => {
  const points = new physx.PxArray_PxVec3(vertices.length);
  const description = new physx.PxConvexMeshDesc();
  const flags = new physx.PxConvexFlags(physx._emscripten_enum_PxConvexFlagEnum_eCOMPUTE_CONVEX());
  vertices.forEach((v, i) => Object.assign(points.get(i), vector(v)));
  Object.assign(description.points, {count: vertices.length, stride: 12, data: points.begin()});
  description.flags = flags;
  const mesh = physx.PxTopLevelFunctions.prototype.CreateConvexMesh(cooking, description);
  [points, description, flags].forEach((thing) => physx.destroy(thing));
  return physx.getPointer(mesh) ? Object.assign(new physx.ConvexMeshSupport(mesh, one, unturned, radius), {cooked: mesh}) : null;
};
const shapes = {
  triangle,
  hull,
  sphere: ({radius}) => new physx.SphereSupport(radius),
  box: ({half}) => new physx.BoxSupport(Object.assign(extents, vector(half))),
  capsule: ({halfLength, radius}) => new physx.CapsuleSupport(radius, halfLength),
};
const typicalLength = scaleOfLengths.length;
const found = new physx.PxGjkQueryProximityInfoResult();

serve({
  engine: {name: 'physx', version: versionOf('physx-js-webidl')}, scalar: 'binary32', rounds: ['orientation'],
  pairs: ['sphere_sphere', 'sphere_cube', 'sphere_capsule', 'capsule_capsule', 'sphere_triangle', 'obb_obb', 'sphere_obb', 'capsule_cube', 'capsule_obb', 'capsule_triangle',
    'cube_obb', 'cube_triangle', 'obb_triangle', 'triangle_triangle', ...hullPairs, 'triangle_hull'],
  conventions: {normal: 'second-to-first', value_less_contact: false, shapes: 'centered'},
}, ({a, b, alarm}) => {
  const [first, second] = [[a, poseA], [b, poseB]].map(([like, pose]) => {
    const shape = centered(like);
    const [x, y, z, w] = rotation(shape, 0);
    Object.assign(pose.q, {x, y, z, w});
    Object.assign(pose.p, vector(shape.center));
    return shapes[shape.kind](shape);
  });
  const free = () => [first, second].filter(Boolean).forEach((shape) => {
    shape.cooked?.release();
    physx.destroy(shape);
  });
  if (!first || !second) {
    free();
    return {unsupported: 'a hull that it does not cook'};
  }
  const hit = physx.PxGjkQuery.prototype.proximityInfo(first, second, poseA, poseB, alarm, typicalLength, found);
  free();
  if (!hit) return {overlap: false, contact: null};
  return {
    overlap: true,
    contact: {
      normal: numbers(found.separatingAxis), point1: numbers(found.pointA), point2: numbers(found.pointB),
      value: found.separation,
    },
  };
});
