// Rapier: Shape.contactShape with the alarm distance as its prediction, and Shape.intersectsShape, which has no margin:
// with one, spheres overlap where they have a contact.
import {numbers, serve, vector, versionOf} from './loop.mjs';
import rapier from '@dimforge/rapier3d-compat';

await rapier.init();
const upright = {x: 0, y: 0, z: 0, w: 1};

serve({
  engine: {name: 'rapier', version: versionOf('@dimforge/rapier3d-compat')}, scalar: 'binary32', pairs: ['sphere_sphere'],
  conventions: {value_less_contact: false, touching_contact: 'open', margin: 'exclusive'},
}, ({a, b, alarm}) => {
  const [first, second] = [new rapier.Ball(a.radius), new rapier.Ball(b.radius)];
  const [from, to] = [vector(a.center), vector(b.center)];
  const found = first.contactShape(from, upright, second, to, upright, alarm);
  const overlap = alarm === 0 ? first.intersectsShape(from, upright, second, to, upright) : found !== null;
  return {
    overlap,
    contact: found && {
      normal: numbers(found.normal1), point1: numbers(found.point1), point2: numbers(found.point2), value: found.distance,
    },
  };
});
