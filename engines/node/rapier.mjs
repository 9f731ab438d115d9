// Rapier: Shape.contactShape with the alarm distance as its prediction, and Shape.intersectsShape, which has no margin:
// with one, shapes overlap where they have a contact. Shape.castRay for rays.
import {centered, hullPairs, numbers, rotation, serve, vector, versionOf} from './loop.mjs';
import rapier from '@dimforge/rapier3d-compat';

await rapier.init();
const shapes = {
  sphere: ({radius}) => new rapier.Ball(radius),
  box: ({half}) => new rapier.Cuboid(...half),
  capsule: ({halfLength, radius}) => new rapier.Capsule(halfLength, radius),
  triangle: ({vertices}) => new rapier.Triangle(...vertices.map(vector)),
  // Its hulls are made of points; of one point and of a line it makes none, and says so by having no shape of its own.
  hull: ({vertices, radius}) => {
    const points = new Float32Array(vertices.flat());
    return radius > 0 ? new rapier.RoundConvexPolyhedron(points, null, radius) : new rapier.ConvexPolyhedron(points, null);
  },
  plane: ({normal}) => new rapier.HalfSpace(vector(normal)),
};
const upright = (shape) => {
  const [x, y, z, w] = rotation(shape, 1);
  return {x, y, z, w};
};

const madeOf = (shape) => {
  const raw = shape.intoRaw();
  raw?.free();
  return raw;
};

const closed = {touching_contact: 'closed', margin: 'inclusive', shapes: 'centered'};
const convex = ['obb_obb', 'sphere_obb', 'capsule_cube', 'capsule_obb', 'capsule_triangle', 'cube_obb', 'cube_triangle', 'obb_triangle', 'triangle_triangle', 'cube_plane',
  'obb_plane', 'triangle_plane', ...hullPairs, 'triangle_hull', 'hull_plane'];
const solid = true; // a ray that begins in a ball hits it there

serve({
  engine: {name: 'rapier', version: versionOf('@dimforge/rapier3d-compat')}, scalar: 'binary32', rounds: ['orientation'],
  pairs: ['sphere_sphere', 'sphere_cube', 'sphere_capsule', 'capsule_capsule', 'sphere_triangle', 'ray_sphere', 'sphere_plane', 'capsule_plane', 'ray_triangle',
    ...convex],
  conventions: {value_less_contact: false, touching_contact: 'open', margin: 'exclusive'},
  pair_conventions: {sphere_cube: closed, sphere_capsule: closed, capsule_capsule: closed, sphere_triangle: closed, sphere_plane: closed, capsule_plane: closed,
    // Where a ray enters a ball is no nearest point.
    ray_sphere: {touching_contact: 'closed', margin: 'none', normal: 'none', points: 'none', value: 'none'},
    // It gives the side that the ray comes from.
    ray_triangle: {normal: 'none', value: 'none'},
    ...Object.fromEntries(convex.map((pair) => [pair, closed])),
  },
}, ({a, b, alarm}) => {
  const [from, to] = [centered(a), centered(b)];
  if (from.kind === 'ray') {
    const time = shapes[to.kind](to).castRay(new rapier.Ray(vector(a.origin), vector(a.direction)), vector(to.center), upright(to), a.length, solid);
    if (time === null || time < 0) return {overlap: false, contact: null};
    if (to.kind === 'sphere') return {overlap: true, contact: {}};
    const point = a.origin.map((x, i) => Math.fround(x + Math.fround(time * a.direction[i])));
    return {overlap: true, contact: {point1: point, point2: point}};
  }
  const [first, second] = [from, to].map((shape) => shapes[shape.kind](shape));
  if ([first, second].some((shape) => !madeOf(shape))) return {unsupported: 'a hull that it does not make'};
  const placed = [vector(from.center), upright(from), second, vector(to.center), upright(to)];
  const found = first.contactShape(...placed, alarm);
  const overlap = alarm === 0 ? first.intersectsShape(...placed) : found !== null;
  return {
    overlap,
    contact: found && {
      normal: numbers(found.normal1), point1: numbers(found.point1), point2: numbers(found.point2), value: found.distance,
    },
  };
});
