// Rapier: Shape.contactShape with the alarm distance as its prediction, and Shape.intersectsShape, which has no margin:
// with one, shapes overlap where they have a contact.
import {centered, numbers, serve, vector, versionOf} from './loop.mjs';
import rapier from '@dimforge/rapier3d-compat';

await rapier.init();
const upright = {x: 0, y: 0, z: 0, w: 1};

serve({
  engine: {name: 'rapier', version: versionOf('@dimforge/rapier3d-compat')}, scalar: 'binary32', pairs: ['sphere_sphere', 'sphere_cube'],
  conventions: {value_less_contact: false, touching_contact: 'open', margin: 'exclusive'},
  pair_conventions: {sphere_cube: {touching_contact: 'closed', margin: 'inclusive', shapes: 'centered'}},
}, ({pair, a, b, alarm}) => {
  const box = pair === 'sphere_cube' ? centered(b) : null;
  const [first, second] = [new rapier.Ball(a.radius), box ? new rapier.Cuboid(...box.half) : new rapier.Ball(b.radius)];
  const [from, to] = [vector(a.center), vector((box ?? b).center)];
  const found = first.contactShape(from, upright, second, to, upright, alarm);
  const overlap = alarm === 0 ? first.intersectsShape(from, upright, second, to, upright) : found !== null;
  return {
    overlap,
    contact: found && {
      normal: numbers(found.normal1), point1: numbers(found.point1), point2: numbers(found.point2), value: found.distance,
    },
  };
});
