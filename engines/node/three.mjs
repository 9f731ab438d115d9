// three.js: Sphere.intersectsSphere and Box3.intersectsBox.
import {serve, versionOf} from './loop.mjs';
import {Box3, Sphere, Vector3} from 'three';

serve({
  engine: {name: 'three', version: versionOf('three')}, scalar: 'binary64', pairs: ['sphere_sphere', 'cube_cube'],
  conventions: {margin: 'none'}, claims: ['overlap'],
}, ({pair, a, b}) => {
  if (pair === 'cube_cube') {
    const box = ({min, max}) => new Box3(new Vector3(...min), new Vector3(...max));
    return {overlap: box(a).intersectsBox(box(b))};
  }
  const ball = ({center, radius}) => new Sphere(new Vector3(...center), radius);
  return {overlap: ball(a).intersectsSphere(ball(b))};
});
