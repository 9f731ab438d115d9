// three.js: Sphere.intersectsSphere, Box3.intersectsBox and Sphere.intersectsBox; Triangle.closestPointToPoint and
// Plane.distanceToSphere, compared as its own examples do. Its rays are endless.
import {centered, serve, versionOf} from './loop.mjs';
import {Box3, Plane, Sphere, Triangle, Vector3} from 'three';

serve({
  engine: {name: 'three', version: versionOf('three')}, scalar: 'binary64', pairs: ['sphere_sphere', 'cube_cube', 'sphere_cube', 'sphere_triangle', 'sphere_plane'],
  conventions: {margin: 'none'}, pair_conventions: {sphere_plane: {shapes: 'centered'}}, claims: ['overlap'],
}, ({pair, a, b}) => {
  const box = ({min, max}) => new Box3(new Vector3(...min), new Vector3(...max));
  const ball = ({center, radius}) => new Sphere(new Vector3(...center), radius);
  if (pair === 'cube_cube') return {overlap: box(a).intersectsBox(box(b))};
  if (pair === 'sphere_cube') return {overlap: ball(a).intersectsBox(box(b))};
  if (pair === 'sphere_triangle') {
    const nearest = new Triangle(...b.vertices.map((v) => new Vector3(...v))).closestPointToPoint(ball(a).center, new Vector3());
    return {overlap: nearest.distanceToSquared(ball(a).center) <= a.radius * a.radius};
  }
  if (pair === 'sphere_plane') {
    const {normal, offset} = centered(b);
    return {overlap: new Plane(new Vector3(...normal), -offset).distanceToSphere(ball(a)) <= 0};
  }
  return {overlap: ball(a).intersectsSphere(ball(b))};
});
