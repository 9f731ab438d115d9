// MuJoCo's own WebAssembly: mj_collision on one predefined pair of a sphere and another or a box.
import {centered, serve, versionOf} from './loop.mjs';
import load from '@mujoco/mujoco';

const mujoco = await load();
// Two bodies that can move: between geoms of the world nothing is ever tested.
const sceneWith = (second) => {
  const model = mujoco.MjModel.from_xml_string(`<mujoco><worldbody>
    <body><freejoint/><geom name="a" type="sphere" size="1"/></body>
    <body><freejoint/><geom name="b" type="${second}" size="1 1 1"/></body>
  </worldbody><contact><pair geom1="a" geom2="b"/></contact></mujoco>`);
  const data = new mujoco.MjData(model);
  mujoco.mj_kinematics(model, data); // upright, once and for all
  return {model, data};
};
const scenes = {sphere_sphere: sceneWith('sphere'), sphere_cube: sceneWith('box')};
const mjMAXVAL = 1e10; // beyond it MuJoCo calls a coordinate bad

serve({
  engine: {name: 'mujoco-js', version: versionOf('@mujoco/mujoco')}, scalar: 'binary64', pairs: Object.keys(scenes),
  conventions: {points: 'midpoint', value_less_contact: false, shapes: 'centered', scale: {min: 0, max: mjMAXVAL}},
}, ({pair, a, b, alarm}) => {
  const {model, data} = scenes[pair];
  const place = (geom, {center}, size, bound) => {
    data.geom_xpos.set(center, 3 * geom);
    model.geom_size.set(size, 3 * geom);
    model.geom_rbound[geom] = bound;
  };
  place(0, a, [a.radius], a.radius);
  if (pair === 'sphere_cube') {
    const box = centered(b);
    // Its compiler refuses a box without thickness; to its collider a size of 0 is no limit.
    if (box.half.includes(0)) return {unsupported: 'a box without thickness'};
    place(1, box, box.half, Math.hypot(...box.half));
  } else {
    place(1, b, [b.radius], b.radius);
  }
  model.pair_margin[0] = alarm;
  mujoco.mj_collision(model, data);
  const contacts = data.contact;
  try {
    if (contacts.size() === 0) return {overlap: false, contact: null};
    const {frame, pos, dist} = contacts.get(0);
    return {overlap: true, contact: {normal: [...frame].slice(0, 3), point: [...pos], value: dist}};
  } finally {
    contacts.delete();
  }
});
