// three.js: Sphere.intersectsSphere, Box3.intersectsBox and Sphere.intersectsBox.
import {serve, versionOf} from './loop.mjs';
import {Box3, Sphere, Vector3} from 'three';

serve({
  engine: {name: 'three', version: versionOf('three')}, scalar: 'binary64', pairs: ['sphere_sphere', 'cube_cube', 'sphere_cube'],
  conventions: {margin: 'none'}, claims: ['overlap'],
}, ({pair, a, b}) => {
  const box = ({min, max}) => new Box3(new Vector3(...min), new Vector3(...max));
  const ball = ({center, radius}) => new Sphere(new Vector3(...center), radius);
  if (pair === 'cube_cube') return {overlap: box(a).intersectsBox(box(b))};
  if (pair === 'sphere_cube') return {overlap: ball(a).intersectsBox(box(b))};
  return {overlap: ball(a).intersectsSphere(ball(b))};
});
