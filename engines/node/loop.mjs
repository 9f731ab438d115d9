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

/** A box by its centre and size. Nothing is rounded: the shapes `centered` keep away boxes whose centre or size is no number. */
export const centered = ({min, max}) => {
  const size = max.map((x, i) => x - min[i]);
  const half = size.map((x) => x / 2);
  return {center: min.map((x, i) => x + half[i]), size, half};
};

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
