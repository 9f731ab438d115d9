// cannon-es: the narrow phase of a sphere and another or a box, first as a test alone.
import {centered, numbers, serve, versionOf} from './loop.mjs';
import {Body, Box, Narrowphase, Sphere, Vec3, World} from 'cannon-es';

const narrowphase = new Narrowphase(new World());
const justTest = true;

// The narrow phase makes a contact of any two spheres: whether they touch is its test's to say. The contact has no distance.
serve({
  engine: {name: 'cannon', version: versionOf('cannon-es')}, scalar: 'binary64', pairs: ['sphere_sphere', 'sphere_cube'],
  conventions: {value: 'none', touching_overlap: 'open', touching_contact: 'open', margin: 'none', coincident: 'zero_normal'},
  pair_conventions: {sphere_cube: {coincident: 'any_unit_normal', shapes: 'centered'}},
}, ({pair, a, b}) => {
  const body = (center, shape) => new Body({mass: 1, position: new Vec3(...center), shape});
  const ball = ({center, radius}) => body(center, new Sphere(radius));
  const box = ({center, half}) => body(center, new Box(new Vec3(...half)));
  const [first, second] = [ball(a), pair === 'sphere_cube' ? box(centered(b)) : ball(b)];
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
