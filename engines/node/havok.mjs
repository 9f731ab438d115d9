// Havok: HP_World_ShapeProximityWithCollector of a shape against the one body of a world: spheres, boxes, capsules, hulls, and a
// triangle, which is a mesh as the body and the hull of its corners as the shape that is asked.
import {centered, hasRadius, noRadius, rotation, serve, versionOf} from './loop.mjs';
import {readFileSync} from 'node:fs';
import load from '@babylonjs/havok';

// In Node it would fetch its WebAssembly, which is a file here.
const file = new URL('node_modules/@babylonjs/havok/lib/esm/HavokPhysics.wasm', import.meta.url);
const havok = await load({wasmBinary: readFileSync(file)});
const upright = [0, 0, 0, 1];
const noBody = [0n];
/** What a call returns beside its status. */
const result = ([, value]) => value;
// A capsule is given by its ends and a triangle by its corners, so their bodies are at the origin.
const placeOf = (shape) => (shape.start || shape.vertices ? [[0, 0, 0], upright] : [centered(shape).center, rotation(centered(shape))]);
const bytes = 4;
const allocated = (type, numbers) => {
  const place = havok._malloc(bytes * numbers.length);
  new type(havok.HEAPU8.buffer, place, numbers.length).set(numbers);
  return place;
};
const pointed = (vertices, make, ...indices) => {
  const places = [allocated(Float32Array, vertices.flat()), ...indices.map((list) => allocated(Int32Array, list))];
  try {
    return result(make(places[0], vertices.length, ...places.slice(1).flatMap((place) => [place, 1])));
  } finally {
    places.forEach((place) => havok._free(place));
  }
};
const shaped = (shape, i) => {
  if (shape.vertices) return i === 0 || shape.radius === 0 ? pointed(shape.vertices, havok.HP_Shape_CreateConvexHull) : pointed(shape.vertices, havok.HP_Shape_CreateMesh, [0, 1, 2]);
  if (shape.start) return result(havok.HP_Shape_CreateCapsule(shape.start, shape.end, shape.radius));
  if (shape.min || shape.extents) return result(havok.HP_Shape_CreateBox([0, 0, 0], upright, centered(shape).size));
  return result(havok.HP_Shape_CreateSphere([0, 0, 0], shape.radius));
};
const withBoxes = ['sphere_cube', 'obb_obb', 'sphere_obb', 'capsule_cube', 'capsule_obb', 'cube_obb', 'cube_triangle', 'obb_triangle', 'cube_hull', 'obb_hull'];
const world = result(havok.HP_World_Create());
const collector = result(havok.HP_QueryCollector_Create(1));

// Each surface has its outward normal, so the second's points to the first. The first's point is in its own coordinates.
serve({
  engine: {name: 'havok', version: versionOf('@babylonjs/havok')}, scalar: 'binary32', rounds: ['orientation'],
  pairs: ['sphere_sphere', 'sphere_capsule', 'capsule_capsule', 'sphere_triangle', 'capsule_triangle', 'triangle_triangle', 'sphere_hull', 'capsule_hull', 'triangle_hull', 'hull_hull',
    ...withBoxes],
  conventions: {
    normal: 'second-to-first', points: 'second_only', value_less_contact: false, touching_overlap: 'open',
    touching_contact: 'open', margin: 'exclusive',
  },
  pair_conventions: Object.fromEntries(withBoxes.map((pair) => [pair, {shapes: 'centered'}])),
}, ({a, b, alarm}) => {
  if (hasRadius(a) || hasRadius(b)) return noRadius;
  const [first, second] = [a, b].map(shaped);
  const body = result(havok.HP_Body_Create());
  havok.HP_Body_SetShape(body, second);
  havok.HP_Body_SetQTransform(body, placeOf(b));
  havok.HP_World_AddBody(world, body, false);
  try {
    havok.HP_World_ShapeProximityWithCollector(world, collector, [first, ...placeOf(a), alarm, false, noBody]);
    if (result(havok.HP_QueryCollector_GetNumHits(collector)) === 0) return {overlap: false, contact: null};
    const [distance, , hit] = result(havok.HP_QueryCollector_GetShapeProximityResult(collector, 0));
    return {overlap: true, contact: {normal: hit[4], point2: hit[3], value: distance}};
  } finally {
    havok.HP_World_RemoveBody(world, body);
    havok.HP_Body_Release(body);
    havok.HP_Shape_Release(first);
    havok.HP_Shape_Release(second);
  }
});
