// three.js: Sphere.intersectsSphere, Box3.intersectsBox and Sphere.intersectsBox; Triangle.closestPointToPoint and
// Plane.distanceToSphere, compared as its own examples do. Its rays are endless. Of its addons OBB, Capsule.intersectsBox, and
// Octree.triangleCapsuleIntersect, which Octree.capsuleIntersect asks of each triangle.
import {centered, matrix, serve, versionOf} from './loop.mjs';
import {Box3, Matrix3, Plane, Sphere, Triangle, Vector3} from 'three';
import {Capsule} from 'three/addons/math/Capsule.js';
import {OBB} from 'three/addons/math/OBB.js';
import {Octree} from 'three/addons/math/Octree.js';

const shapes = {
  box: ({min, max}) => new Box3(new Vector3(...min), new Vector3(...max)),
  ball: ({center, radius}) => new Sphere(new Vector3(...center), radius),
  obb: (like) => new OBB(new Vector3(...like.center), new Vector3(...like.extents), new Matrix3(...matrix(centered(like)))),
  capsule: ({start, end, radius}) => new Capsule(new Vector3(...start), new Vector3(...end), radius),
  triangle: ({vertices}) => new Triangle(...vertices.map((v) => new Vector3(...v))),
};
const {ball, box, capsule, obb, triangle} = shapes;
const octree = new Octree();
const overlaps = {
  sphere_sphere: (a, b) => ball(a).intersectsSphere(ball(b)),
  cube_cube: (a, b) => box(a).intersectsBox(box(b)),
  sphere_cube: (a, b) => ball(a).intersectsBox(box(b)),
  sphere_triangle: (a, b) => triangle(b).closestPointToPoint(ball(a).center, new Vector3()).distanceToSquared(ball(a).center) <= a.radius * a.radius,
  sphere_plane: (a, b) => {
    const {normal, offset} = centered(b);
    return new Plane(new Vector3(...normal), -offset).distanceToSphere(ball(a)) <= 0;
  },
  obb_obb: (a, b) => obb(a).intersectsOBB(obb(b)),
  sphere_obb: (a, b) => obb(b).intersectsSphere(ball(a)),
  capsule_cube: (a, b) => capsule(a).intersectsBox(box(b)),
  capsule_triangle: (a, b) => Boolean(octree.triangleCapsuleIntersect(capsule(a), triangle(b))),
  cube_obb: (a, b) => obb(b).intersectsBox3(box(a)),
  cube_triangle: (a, b) => box(a).intersectsTriangle(triangle(b)),
};

const [turned, open] = [{shapes: 'centered'}, {touching_overlap: 'open'}];
serve({
  engine: {name: 'three', version: versionOf('three')}, scalar: 'binary64', rounds: ['orientation'], pairs: Object.keys(overlaps),
  conventions: {margin: 'none'}, claims: ['overlap'],
  pair_conventions: {sphere_plane: turned, obb_obb: turned, sphere_obb: turned, cube_obb: turned, capsule_cube: open, capsule_triangle: open},
}, ({pair, a, b}) => ({overlap: overlaps[pair](a, b)}));
