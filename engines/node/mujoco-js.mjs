// MuJoCo's own WebAssembly: mj_collision on one predefined pair of spheres, boxes and capsules.
import {centered, serve, versionOf} from './loop.mjs';
import load from '@mujoco/mujoco';

const mujoco = await load();
// Two bodies that can move: between geoms of the world nothing is ever tested.
const sceneWith = (first, second) => {
  const model = mujoco.MjModel.from_xml_string(`<mujoco><worldbody>
    <body><freejoint/><geom name="a" type="${first}" size="1 1 1"/></body>
    <body><freejoint/><geom name="b" type="${second}" size="1 1 1"/></body>
  </worldbody><contact><pair geom1="a" geom2="b"/></contact></mujoco>`);
  const data = new mujoco.MjData(model);
  return {model, data};
};
const scenes = {
  sphere_sphere: sceneWith('sphere', 'sphere'), sphere_cube: sceneWith('sphere', 'box'),
  sphere_capsule: sceneWith('sphere', 'capsule'), capsule_capsule: sceneWith('capsule', 'capsule'),
};
const mjMAXVAL = 1e10; // beyond it MuJoCo calls a coordinate bad

serve({
  engine: {name: 'mujoco-js', version: versionOf('@mujoco/mujoco')}, scalar: 'binary64', pairs: Object.keys(scenes),
  conventions: {points: 'midpoint', value_less_contact: false, shapes: 'centered', scale: {min: 0, max: mjMAXVAL}},
}, ({pair, a, b, alarm}) => {
  const {model, data} = scenes[pair];
  // Its compiler refuses a box without thickness and a capsule without length; to its collider a size of 0 is no limit.
  const set = (geom, like) => {
    const {kind, center, radius, half, axis, halfLength} = centered(like);
    const sizes = {sphere: [radius], box: half, capsule: [radius, halfLength]}[kind];
    const bounds = {sphere: radius, box: Math.hypot(...(half ?? [])), capsule: radius + halfLength};
    data.geom_xpos.set(center, 3 * geom);
    data.geom_xmat.set([0, 1, 2].flatMap((row) => [0, 1, 2].map((column) => Number(row === (column + axis + 1) % 3))), 9 * geom);
    model.geom_size.set(sizes, 3 * geom);
    model.geom_rbound[geom] = bounds[kind];
    return kind === 'sphere' || !(kind === 'box' ? half : [halfLength]).includes(0);
  };
  if (!set(0, a) || !set(1, b)) return {unsupported: 'a size of 0'};
  model.pair_margin[0] = alarm;
  mujoco.mj_collision(model, data);
  const contacts = data.contact;
  try {
    if (contacts.size() === 0) return {overlap: false, contact: null};
    // Parallel capsules may have two: the deeper one.
    const all = Array.from({length: contacts.size()}, (_, i) => contacts.get(i));
    const {frame, pos, dist} = all.reduce((deeper, other) => (other.dist < deeper.dist ? other : deeper));
    return {overlap: true, contact: {normal: [...frame].slice(0, 3), point: [...pos], value: dist}};
  } finally {
    contacts.delete();
  }
});
