// oimo: the world's detector of two spheres.
import {serve, versionOf} from './loop.mjs';
import oimo from 'oimo';

const {SHAPE_SPHERE, ShapeConfig, Sphere, World} = oimo;
const detector = new World({info: false}).detectors[SHAPE_SPHERE][SHAPE_SPHERE];

serve({
  engine: {name: 'oimo', version: versionOf('oimo')}, scalar: 'binary64', pairs: ['sphere_sphere'],
  conventions: {
    points: 'first_only', value_less_contact: false, touching_overlap: 'open', touching_contact: 'open', margin: 'none',
    coincident: 'no_contact',
  },
  claims: ['contact', 'normal', 'point1', 'value'],
}, ({a, b}) => {
  const sphere = ({center, radius}) => {
    const shape = new Sphere(new ShapeConfig(), radius);
    shape.position.set(...center);
    return shape;
  };
  let contact = null;
  detector.detectCollision(sphere(a), sphere(b), {
    addPoint: (x, y, z, nx, ny, nz, penetration) => {
      contact = {normal: [nx, ny, nz], point1: [x, y, z], value: penetration};
    },
  });
  return {contact};
});
