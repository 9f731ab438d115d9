// oimo: the world's detectors of spheres and boxes.
import {centered, rotation, serve, versionOf} from './loop.mjs';
import oimo from 'oimo';

const {Box, Quat, ShapeConfig, Sphere, World} = oimo;
const {detectors} = new World({info: false});

// The point of two boxes is a corner of either, or the middle between two edges.
const boxes = {coincident: 'any_unit_normal', shapes: 'centered', points: 'none', depth: 'any_separating'};
serve({
  engine: {name: 'oimo', version: versionOf('oimo')}, scalar: 'binary64', rounds: ['orientation'], pairs: ['sphere_sphere', 'sphere_cube', 'obb_obb', 'sphere_obb', 'cube_obb'],
  conventions: {
    points: 'first_only', value_less_contact: false, touching_overlap: 'open', touching_contact: 'open', margin: 'none',
    coincident: 'no_contact',
  },
  pair_conventions: {
    sphere_cube: {coincident: 'any_unit_normal', shapes: 'centered'}, sphere_obb: {coincident: 'any_unit_normal', shapes: 'centered'},
    obb_obb: boxes, cube_obb: boxes,
  },
  claims: ['contact', 'normal', 'point1', 'value'],
}, ({a, b}) => {
  const placed = (like) => {
    const {kind, center, radius, size, ...shape} = centered(like);
    const made = kind === 'sphere' ? new Sphere(new ShapeConfig(), radius) : new Box(new ShapeConfig(), ...size);
    made.position.set(...center);
    made.rotation.setQuat(new Quat(...rotation(shape)));
    made.updateProxy(); // a box has no axes before
    return made;
  };
  const [first, second] = [a, b].map(placed);
  // Of several contacts the deepest.
  let contact = null;
  detectors[first.type][second.type].detectCollision(first, second, {
    addPoint: (x, y, z, nx, ny, nz, penetration, flip) => {
      if (contact?.value <= penetration) return;
      contact = {normal: [nx, ny, nz].map((n) => (flip ? -n : n)), point1: [x, y, z], value: penetration};
    },
  });
  return {contact};
});
