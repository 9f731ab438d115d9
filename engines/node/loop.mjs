// The engine protocol around one function. Import it before the engine: its console must not reach standard output.
import {readFileSync} from 'node:fs';
import {createInterface} from 'node:readline';

for (const level of ['log', 'info', 'debug', 'warn']) console[level] = console.error;

// What is not finite travels as text; JSON would make null of it, and JavaScript 0 of null.
const notFinite = {'NaN': NaN, 'Infinity': Infinity, '-Infinity': -Infinity};
const read = (line) => JSON.parse(line, (_, value) => (typeof value === 'string' && value in notFinite ? notFinite[value] : value));
const written = (_, value) => (typeof value === 'number' && !Number.isFinite(value) ? String(value) : value);

/** The three numbers of an engine's vector. */
export const numbers = ({x, y, z}) => [x, y, z];
/** An engine's vector of three numbers. */
export const vector = ([x, y, z]) => ({x, y, z});

/**
 * A shape by its centre, size and direction, a plane by a unit normal, a ray by its ends, and its kind. Nothing is rounded: a
 * declaration with the shapes `centered` keeps away those for which one of these is no number. Only a rotated box is asked by a
 * unit quaternion, which has been rounded.
 */
export const centered = ({center, orientation, extents, radius, min, max, start, end, vertices, origin, direction, length, normal, offset}) => {
  if (orientation) {
    const long = Math.hypot(...orientation);
    return {kind: 'box', center, turn: orientation.map((x) => x / long), half: extents, size: extents.map((x) => 2 * x)};
  }
  if (vertices) return {kind: radius === undefined ? 'triangle' : 'hull', center: [0, 0, 0], axis: 2, vertices, radius};
  if (origin) return {kind: 'ray', start: origin, end: origin.map((x, i) => x + length * direction[i]), direction, length};
  if (normal) {
    const long = Math.hypot(...normal);
    const unit = normal.map((x) => x / long);
    return {kind: 'plane', normal: unit, offset: offset / long, center: unit.map((x) => x * (offset / long)),
      axis: unit.findIndex((x) => x !== 0)};
  }
  if (start && radius === undefined) return {kind: 'line', start, end};
  if (center) return {kind: 'sphere', center, radius, axis: 2};
  const [from, to] = min ? [min, max] : [start, end];
  const way = to.map((x, i) => x - from[i]);
  const size = way.map(Math.abs);
  const axis = min ? 2 : Math.max(...way.map((x, i) => (x === 0 ? -1 : i)));
  return {
    kind: min ? 'box' : 'capsule', center: from.map((x, i) => x + way[i] / 2), radius, size, half: size.map((x) => x / 2),
    axis: axis < 0 ? 2 : axis, halfLength: Math.max(...size) / 2,
  };
};

/** The rotation that takes one axis to another, as a quaternion of exact numbers. */
export const turned = (from, to) => [[0, 0, 0, 1], [0.5, 0.5, 0.5, 0.5], [-0.5, -0.5, -0.5, 0.5]][(to - from + 3) % 3];

/** The rotation of a shape, as a unit quaternion, for an engine whose capsules lie along one of its axes. */
export const rotation = ({kind, axis, turn}, along) => (kind === 'capsule' ? turned(along, axis) : turn ?? [0, 0, 0, 1]);

/** The same as a matrix, by rows. Quarter turns are exact: the numbers of a quaternion are divided by the square that they have. */
export const matrix = (shape, along) => {
  const [x, y, z, w] = rotation(shape, along);
  const square = x * x + y * y + z * z + w * w;
  return [
    w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y),
    2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x),
    2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z,
  ].map((number) => number / square);
};

/** The pairs of a hull and another shape with an inside. */
export const hullPairs = ['sphere_hull', 'capsule_hull', 'cube_hull', 'obb_hull', 'hull_hull'];
/** For an engine whose hulls have no radius. */
export const noRadius = {unsupported: 'a hull with a radius'};
export const hasRadius = ({vertices, radius}) => Boolean(vertices && radius > 0);

/** The version of an installed package. */
export const versionOf = (name) =>
  JSON.parse(readFileSync(new URL(`node_modules/${name}/package.json`, import.meta.url))).version;

/** Answers questions until told to stop. `answer(question)` gives the claims of a pair; what it throws is its error. */
export function serve(declaration, answer) {
  const lines = createInterface({input: process.stdin});
  lines.on('line', (line) => {
    const message = read(line);
    if (message.op === 'stop') return lines.close();
    let reply = {op: 'hello', protocol: 1, ...declaration};
    if (message.op !== 'hello') {
      reply = {op: 'answer', seq: message.seq};
      try {
        Object.assign(reply, answer(message));
      } catch (problem) {
        reply.error = String(problem);
      }
    }
    process.stdout.write(JSON.stringify(reply, written) + '\n');
  });
}
