// cannon-es: the narrow phase of a sphere and another, a box or a plane, first as a test alone.
import {centered, numbers, serve, turned, versionOf} from './loop.mjs';
import {Body, Box, Narrowphase, Plane, Sphere, Vec3, World} from 'cannon-es';

const narrowphase = new Narrowphase(new World());
const justTest = true;

// The narrow phase makes a contact of any two spheres: whether they touch is its test's to say. The contact has no distance.
serve({
  engine: {name: 'cannon', version: versionOf('cannon-es')}, scalar: 'binary64', pairs: ['sphere_sphere', 'sphere_cube', 'sphere_plane'],
  conventions: {value: 'none', touching_overlap: 'open', touching_contact: 'open', margin: 'none', coincident: 'zero_normal'},
  pair_conventions: {
    sphere_cube: {coincident: 'any_unit_normal', shapes: 'centered'},
    sphere_plane: {touching_overlap: 'closed', touching_contact: 'closed', shapes: 'centered'},
  },
}, ({pair, a, b}) => {
  const body = (center, shape) => new Body({mass: 1, position: new Vec3(...center), shape});
  const ball = ({center, radius}) => body(center, new Sphere(radius));
  const box = ({center, half}) => body(center, new Box(new Vec3(...half)));
  const plane = ({center, normal, axis}) => {
    const placed = body(center, new Plane()); // its normal is z
    const [x, y, z, w] = turned(2, axis);
    placed.quaternion.set(...(normal[axis] > 0 ? [x, y, z, w] : [w, z, -y, -x]));
    return placed;
  };
  const second = {sphere_sphere: ball, sphere_cube: (x) => box(centered(x)), sphere_plane: (x) => plane(centered(x))}[pair](b);
  const first = ball(a);
  const collide = (...test) => narrowphase[first.shapes[0].type | second.shapes[0].type](first.shapes[0], second.shapes[0], first.position, second.position,
    first.quaternion, second.quaternion, first, second, null, null, ...test);
  const overlap = Boolean(collide(justTest));
  if (!overlap) return {overlap, contact: null};
  narrowphase.result = [];
  narrowphase.frictionResult = [];
  collide();
  const {ni, ri, rj} = narrowphase.result[0];
  return {
    overlap,
    contact: {normal: numbers(ni), point1: numbers(first.position.vadd(ri)), point2: numbers(second.position.vadd(rj))},
  };
});
