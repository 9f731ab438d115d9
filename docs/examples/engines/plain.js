// An engine in JavaScript (Node) for contact-oracle: spheres in plain double arithmetic, over the engine protocol.
'use strict';

const hello = {
  op: 'hello', protocol: 1, engine: {name: 'plain-node', version: '1'}, scalar: 'binary64', pairs: ['sphere_sphere'],
  // Squares of these neither overflow nor underflow: outside of it this engine claims nothing.
  conventions: {scale: {min: 1e-100, max: 1e100}}, bounds: {value: 4, normal: 4, point: 4},
};

function spheres({a, b, alarm, contact}) {
  const delta = a.center.map((c, i) => b.center[i] - c);
  const distance2 = delta.reduce((sum, d) => sum + d * d, 0);
  const reach = a.radius + b.radius + alarm;
  if (distance2 > reach * reach) return {overlap: false, contact: null};
  const distance = Math.sqrt(distance2);
  const normal = distance > 0 ? delta.map((d) => d / distance) : [1, 0, 0];
  return {
    overlap: true,
    contact: {
      normal,
      point1: a.center.map((c, i) => c + a.radius * normal[i]),
      point2: b.center.map((c, i) => c - b.radius * normal[i]),
      value: distance - (a.radius + b.radius) - contact,
    },
  };
}

const lines = require('readline').createInterface({input: process.stdin});
lines.on('line', (line) => {
  const message = JSON.parse(line);
  if (message.op === 'stop') return lines.close(); // the program ends when all is written; exit() would not wait
  const reply = message.op === 'hello' ? hello : {op: 'answer', seq: message.seq, ...spheres(message)};
  process.stdout.write(JSON.stringify(reply) + '\n');
});
