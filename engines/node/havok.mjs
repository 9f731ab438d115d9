// Havok: HP_World_ShapeProximityWithCollector of a sphere against the one body of a world, a sphere or a box.
import {centered, serve, versionOf} from './loop.mjs';
import {readFileSync} from 'node:fs';
import load from '@babylonjs/havok';

// In Node it would fetch its WebAssembly, which is a file here.
const file = new URL('node_modules/@babylonjs/havok/lib/esm/HavokPhysics.wasm', import.meta.url);
const havok = await load({wasmBinary: readFileSync(file)});
const upright = [0, 0, 0, 1];
const noBody = [0n];
/** What a call returns beside its status. */
const result = ([, value]) => value;
const world = result(havok.HP_World_Create());
const collector = result(havok.HP_QueryCollector_Create(1));

// Each surface has its outward normal, so the second's points to the first. The first's point is in its own coordinates.
serve({
  engine: {name: 'havok', version: versionOf('@babylonjs/havok')}, scalar: 'binary32', pairs: ['sphere_sphere', 'sphere_cube'],
  conventions: {
    normal: 'second-to-first', points: 'second_only', value_less_contact: false, touching_overlap: 'open',
    touching_contact: 'open', margin: 'exclusive', shapes: 'centered',
  },
}, ({pair, a, b, alarm}) => {
  const sphere = ({radius}) => result(havok.HP_Shape_CreateSphere([0, 0, 0], radius));
  const box = pair === 'sphere_cube' ? centered(b) : null;
  const second = box ? result(havok.HP_Shape_CreateBox([0, 0, 0], upright, box.size)) : sphere(b);
  const first = sphere(a);
  const body = result(havok.HP_Body_Create());
  havok.HP_Body_SetShape(body, second);
  havok.HP_Body_SetQTransform(body, [(box ?? b).center, upright]);
  havok.HP_World_AddBody(world, body, false);
  try {
    havok.HP_World_ShapeProximityWithCollector(world, collector, [first, a.center, upright, alarm, false, noBody]);
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
