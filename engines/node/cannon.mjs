// cannon-es: the narrow phase of spheres, boxes, planes, convex polyhedra and a mesh of one triangle, first as a test alone.
import {centered, hasRadius, hullPairs, noRadius, numbers, rotation, serve, turned, versionOf} from './loop.mjs';
import {facesOf} from './faces.mjs';
import {Body, Box, ConvexPolyhedron, Narrowphase, Plane, Sphere, Trimesh, Vec3, World} from 'cannon-es';

const narrowphase = new Narrowphase(new World());
const justTest = true;
const shapes = {
  sphere: ({radius}) => new Sphere(radius),
  box: ({half}) => new Box(new Vec3(...half)),
  plane: () => new Plane(), // its normal is z
  // About the middle of its vertices, on which side of a face cannon-es looks from.
  hull: (shape) => {
    const found = facesOf(shape.vertices);
    if (!found) return null;
    shape.center = [0, 1, 2].map((i) => found.vertices.reduce((sum, v) => sum + v[i] / found.vertices.length, 0));
    return new ConvexPolyhedron({vertices: found.vertices.map((v) => new Vec3(...v.map((x, i) => x - shape.center[i]))), faces: found.triangles});
  },
  triangle: ({vertices}) => new Trimesh(vertices.flat(), [0, 1, 2]),
};
const turn = (shape) => {
  if (shape.kind !== 'plane') return rotation(shape);
  const {normal, axis} = shape;
  const [x, y, z, w] = turned(2, axis);
  return normal[axis] > 0 ? [x, y, z, w] : [w, z, -y, -x];
};

// The narrow phase makes a contact of any two spheres: whether they touch is its test's to say. The contact has no distance.
// A plane comes first in it, and so does the normal.
const boxes = {shapes: 'centered', touching_overlap: 'closed', touching_contact: 'closed', coincident: 'any_unit_normal'};
const onPlane = {...boxes, normal: 'second-to-first'};
const hulls = hullPairs.filter((pair) => pair !== 'capsule_hull');
serve({
  engine: {name: 'cannon', version: versionOf('cannon-es')}, scalar: 'binary64', rounds: ['orientation'],
  pairs: ['sphere_sphere', 'sphere_cube', 'sphere_plane', 'obb_obb', 'sphere_obb', 'cube_obb', 'cube_plane', 'obb_plane', 'triangle_plane',
    ...hulls, 'hull_plane'],
  conventions: {value: 'none', touching_overlap: 'open', touching_contact: 'open', margin: 'none', coincident: 'zero_normal'},
  pair_conventions: {
    sphere_cube: {coincident: 'any_unit_normal', shapes: 'centered'}, sphere_obb: {coincident: 'any_unit_normal', shapes: 'centered'},
    sphere_plane: {touching_overlap: 'closed', touching_contact: 'closed', shapes: 'centered'},
    obb_obb: boxes, cube_obb: boxes, cube_plane: onPlane, obb_plane: onPlane, triangle_plane: onPlane,
    ...Object.fromEntries(hulls.map((pair) => [pair, boxes])), hull_plane: onPlane,
  },
}, ({a, b}) => {
  if (hasRadius(a) || hasRadius(b)) return noRadius;
  const [one, other] = [a, b].map((like) => {
    const shape = centered(like);
    const made = shapes[shape.kind](shape);
    if (!made) return null;
    const body = new Body({mass: 1, position: new Vec3(...shape.center), shape: made});
    body.quaternion.set(...turn(shape));
    return body;
  });
  if (!one || !other) return {unsupported: 'a hull without a volume'};
  // It asks the shape of the lower type first.
  const [first, second] = one.shapes[0].type <= other.shapes[0].type ? [one, other] : [other, one];
  const collide = (...test) => narrowphase[first.shapes[0].type | second.shapes[0].type](first.shapes[0], second.shapes[0], first.position, second.position,
    first.quaternion, second.quaternion, first, second, null, null, ...test);
  const overlap = Boolean(collide(justTest));
  if (!overlap) return {overlap, contact: null};
  narrowphase.result = [];
  narrowphase.frictionResult = [];
  collide();
  // Of several contacts the deepest.
  const found = narrowphase.result.map(({ni, ri, rj}) => {
    const [i, j] = [first.position.vadd(ri), second.position.vadd(rj)];
    return {ni, i, j, gap: j.vsub(i).dot(ni)};
  });
  const {ni, i, j} = found.reduce((deeper, next) => (next.gap < deeper.gap ? next : deeper));
  const [point1, point2] = first === one ? [i, j] : [j, i];
  return {overlap, contact: {normal: numbers(ni), point1: numbers(point1), point2: numbers(point2)}};
});
