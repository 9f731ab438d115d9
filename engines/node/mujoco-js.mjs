// MuJoCo's own WebAssembly: mj_collision on one predefined pair of spheres, boxes, capsules, planes and
// meshes, of which it takes the hull.
import {centered, hasRadius, hullPairs, noRadius, matrix, serve, versionOf} from './loop.mjs';
import load from '@mujoco/mujoco';

const mujoco = await load();
// Bodies that can move, but for planes, which only the world may have: between geoms of the world nothing is ever tested.
const sceneWith = (first, second, assets = '') => {
  const geom = (name, type) => `<geom name="${name}" type="${type}" ${type === 'mesh' ? `mesh="${name}"` : 'size="1 1 1"'}/>`;
  const body = (name, type) => (type === 'plane' ? geom(name, type) : `<body><freejoint/>${geom(name, type)}</body>`);
  const model = mujoco.MjModel.from_xml_string(`<mujoco>${assets}<worldbody>${body('a', first)}${body('b', second)}</worldbody><contact><pair geom1="a" geom2="b"/></contact></mujoco>`);
  const data = new mujoco.MjData(model);
  mujoco.mj_kinematics(model, data);
  return {model, data};
};
const scenes = {
  sphere_sphere: sceneWith('sphere', 'sphere'), sphere_cube: sceneWith('sphere', 'box'),
  sphere_capsule: sceneWith('sphere', 'capsule'), capsule_capsule: sceneWith('capsule', 'capsule'),
  sphere_plane: sceneWith('sphere', 'plane'), capsule_plane: sceneWith('capsule', 'plane'),
  sphere_obb: sceneWith('sphere', 'box'), capsule_cube: sceneWith('capsule', 'box'), capsule_obb: sceneWith('capsule', 'box'),
  cube_obb: sceneWith('box', 'box'), obb_obb: sceneWith('box', 'box'), cube_plane: sceneWith('box', 'plane'), obb_plane: sceneWith('box', 'plane'),
};
// A hull as its users have it: in a model of its own, which keeps its vertices in single precision and turned to its axes of
// inertia.
const typeOf = (shape) => (shape.kind === 'hull' ? 'mesh' : shape.kind);
const sceneOf = (first, second) => {
  const mesh = ({kind, vertices}, name) => (kind === 'hull' ? `<mesh name="${name}" vertex="${vertices.flat().join(' ')}"/>` : '');
  return sceneWith(typeOf(first), typeOf(second), `<asset>${mesh(first, 'a')}${mesh(second, 'b')}</asset>`);
};
const onPlane = {normal: 'second-to-first'};
const mjMAXVAL = 1e10; // beyond it MuJoCo calls a coordinate bad

serve({
  engine: {name: 'mujoco-js', version: versionOf('@mujoco/mujoco')}, scalar: 'binary64', rounds: ['orientation'], pairs: [...Object.keys(scenes), ...hullPairs, 'hull_plane'],
  conventions: {points: 'midpoint', value_less_contact: false, shapes: 'centered', scale: {min: 0, max: mjMAXVAL}},
  pair_conventions: {
    sphere_plane: onPlane, capsule_plane: onPlane, cube_plane: onPlane, obb_plane: onPlane,
    hull_plane: onPlane, obb_obb: {depth: 'any_separating'}, cube_obb: {depth: 'any_separating'},
  },
}, ({pair, a, b, alarm}) => {
  if (hasRadius(a) || hasRadius(b)) return noRadius;
  let scene = scenes[pair];
  try {
    scene ??= sceneOf(centered(a), centered(b));
  } catch {
    return {unsupported: 'a mesh that its compiler refuses'};
  }
  const {model, data} = scene;
  // Its compiler refuses a box without thickness and a capsule without length; to its collider a size of 0 is no limit.
  const set = (geom, like) => {
    const shape = centered(like);
    const {normal, kind, center, radius, half, halfLength} = shape;
    if (kind === 'hull') return true; // its model has been made of it
    if (kind === 'plane') {
      data.geom_xpos.set(center, 3 * geom);
      data.geom_xmat.set(normal.flatMap((x) => [0, 0, x]), 9 * geom);
      return true;
    }
    const sizes = {sphere: [radius], box: half, capsule: [radius, halfLength]}[kind];
    const bounds = {sphere: radius, box: Math.hypot(...(half ?? [])), capsule: radius + halfLength};
    data.geom_xpos.set(center, 3 * geom);
    data.geom_xmat.set(matrix(shape, 2), 9 * geom);
    model.geom_size.set(sizes, 3 * geom);
    model.geom_rbound[geom] = bounds[kind];
    return kind === 'sphere' || !(kind === 'box' ? half : [halfLength]).includes(0);
  };
  // The world's geoms are numbered before those of bodies.
  const first = pair.endsWith('_plane') ? 1 : 0;
  let contacts = null;
  try {
    if (!set(first, a) || !set(1 - first, b)) return {unsupported: 'a size of 0'};
    model.pair_margin[0] = alarm;
    mujoco.mj_collision(model, data);
    contacts = data.contact;
    if (contacts.size() === 0) return {overlap: false, contact: null};
    // Of several the deepest.
    const all = Array.from({length: contacts.size()}, (_, i) => contacts.get(i));
    const {frame, pos, dist} = all.reduce((deeper, other) => (other.dist < deeper.dist ? other : deeper));
    return {overlap: true, contact: {normal: [...frame].slice(0, 3), point: [...pos], value: dist}};
  } finally {
    contacts?.delete();
    if (!scenes[pair]) [data, model].forEach((thing) => thing.delete());
  }
});
