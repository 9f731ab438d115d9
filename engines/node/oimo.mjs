// oimo: the world's detectors of a sphere and another or a box.
import {centered, serve, versionOf} from './loop.mjs';
import oimo from 'oimo';

const {Box, ShapeConfig, Sphere, World} = oimo;
const {detectors} = new World({info: false});

serve({
  engine: {name: 'oimo', version: versionOf('oimo')}, scalar: 'binary64', pairs: ['sphere_sphere', 'sphere_cube'],
  conventions: {
    points: 'first_only', value_less_contact: false, touching_overlap: 'open', touching_contact: 'open', margin: 'none',
    coincident: 'no_contact',
  },
  pair_conventions: {sphere_cube: {coincident: 'any_unit_normal', shapes: 'centered'}},
  claims: ['contact', 'normal', 'point1', 'value'],
}, ({pair, a, b}) => {
  const placed = (center, shape) => {
    shape.position.set(...center);
    shape.updateProxy(); // a box has no axes before
    return shape;
  };
  const sphere = ({center, radius}) => placed(center, new Sphere(new ShapeConfig(), radius));
  const box = ({center, size}) => placed(center, new Box(new ShapeConfig(), ...size));
  const [first, second] = [sphere(a), pair === 'sphere_cube' ? box(centered(b)) : sphere(b)];
  let contact = null;
  detectors[first.type][second.type].detectCollision(first, second, {
    addPoint: (x, y, z, nx, ny, nz, penetration) => {
      contact = {normal: [nx, ny, nz], point1: [x, y, z], value: penetration};
    },
  });
  return {contact};
});
