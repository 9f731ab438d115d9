// cannon-es: the narrow phase of two spheres, first as a test alone.
import {numbers, serve, versionOf} from './loop.mjs';
import {Body, Narrowphase, Sphere, Vec3, World} from 'cannon-es';

const narrowphase = new Narrowphase(new World());
const type = Sphere.types.SPHERE;
const justTest = true;

// The narrow phase makes a contact of any two spheres: whether they touch is its test's to say. The contact has no distance.
serve({
  engine: {name: 'cannon', version: versionOf('cannon-es')}, scalar: 'binary64', pairs: ['sphere_sphere'],
  conventions: {value: 'none', touching_overlap: 'open', touching_contact: 'open', margin: 'none', coincident: 'zero_normal'},
}, ({a, b}) => {
  const body = ({center, radius}) => new Body({mass: 1, position: new Vec3(...center), shape: new Sphere(radius)});
  const [first, second] = [body(a), body(b)];
  const collide = (...test) => narrowphase[type](first.shapes[0], second.shapes[0], first.position, second.position,
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
