// MuJoCo's own WebAssembly: mj_collision on one predefined pair of spheres.
import {serve, versionOf} from './loop.mjs';
import load from '@mujoco/mujoco';

const mujoco = await load();
// Two bodies that can move: between geoms of the world nothing is ever tested.
const model = mujoco.MjModel.from_xml_string(`<mujoco><worldbody>
  <body><freejoint/><geom name="a" type="sphere" size="1"/></body>
  <body><freejoint/><geom name="b" type="sphere" size="1"/></body>
</worldbody><contact><pair geom1="a" geom2="b"/></contact></mujoco>`);
const data = new mujoco.MjData(model);
const mjMAXVAL = 1e10; // beyond it MuJoCo calls a coordinate bad

serve({
  engine: {name: 'mujoco-js', version: versionOf('@mujoco/mujoco')}, scalar: 'binary64', pairs: ['sphere_sphere'],
  conventions: {points: 'midpoint', value_less_contact: false, scale: {min: 0, max: mjMAXVAL}},
}, ({a, b, alarm}) => {
  [a, b].forEach(({center, radius}, i) => {
    data.geom_xpos.set(center, 3 * i);
    model.geom_size[3 * i] = model.geom_rbound[i] = radius;
  });
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
