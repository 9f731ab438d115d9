// cannon-es: AABB.overlaps, which is closed where the narrow phase of spheres is open.
import {serve, versionOf} from './loop.mjs';
import {AABB, Vec3} from 'cannon-es';

serve({
  engine: {name: 'cannon-aabb', version: versionOf('cannon-es')}, scalar: 'binary64', pairs: ['cube_cube'],
  conventions: {margin: 'none'},
}, ({a, b}) => {
  const box = ({min, max}) => new AABB({lowerBound: new Vec3(...min), upperBound: new Vec3(...max)});
  return {overlap: box(a).overlaps(box(b))};
});
