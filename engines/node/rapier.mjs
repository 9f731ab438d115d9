// Rapier: Shape.contactShape with the alarm distance as its prediction, and Shape.intersectsShape, which has no margin:
// with one, shapes overlap where they have a contact.
import {centered, numbers, serve, turned, vector, versionOf} from './loop.mjs';
import rapier from '@dimforge/rapier3d-compat';

await rapier.init();
const shapes = {
  sphere: ({radius}) => new rapier.Ball(radius),
  box: ({half}) => new rapier.Cuboid(...half),
  capsule: ({halfLength, radius}) => new rapier.Capsule(halfLength, radius),
};
const upright = ({kind, axis}) => {
  const [x, y, z, w] = kind === 'capsule' ? turned(1, axis) : [0, 0, 0, 1];
  return {x, y, z, w};
};

const closed = {touching_contact: 'closed', margin: 'inclusive', shapes: 'centered'};

serve({
  engine: {name: 'rapier', version: versionOf('@dimforge/rapier3d-compat')}, scalar: 'binary32', 
  pairs: ['sphere_sphere', 'sphere_cube', 'sphere_capsule', 'capsule_capsule'],
  conventions: {value_less_contact: false, touching_contact: 'open', margin: 'exclusive'},
  pair_conventions: {sphere_cube: closed, sphere_capsule: closed, capsule_capsule: closed},
}, ({a, b, alarm}) => {
  const [from, to] = [centered(a), centered(b)];
  const [first, second] = [from, to].map((shape) => shapes[shape.kind](shape));
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
