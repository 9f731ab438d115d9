// What the pages add to their text: charts (D3), the worst cases in space (three.js), and buttons that copy.
"use strict";
(() => {
  const superscript = (n) => String(n).replace(/./g, (c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]);
  /** 2^power in few characters: 1/8, 1, 1024, 2⁴⁰. */
  const two = (power) => (power < -6 || power > 10 ? "2" + superscript(power) : power < 0 ? "1/" + 2 ** -power : 2 ** power);
  const element = (name, attributes = {}, ...children) => {
    const made = document.createElement(name);
    Object.assign(made, attributes);
    made.append(...children);
    return made;
  };

  // ---- charts ----

  /**
   * Bars on a logarithmic scale, one a column.
   * columns: [{label, title, parts: [[class, count], ...]}], a part being drawn before those behind it.
   */
  function bars(figure, width, columns, axis, bound) {
    const height = 190, left = 44, right = 24, bottom = 38, top = 8;
    const most = d3.max(columns, (c) => d3.max(c.parts, (p) => p[1]));
    const x = d3.scale.ordinal().domain(d3.range(columns.length)).rangeBands([left, width - right], 0.12, 0.1);
    const y = d3.scale.log().domain([0.6, Math.max(most, 10)]).range([height - bottom, top]);
    const svg = d3.select(figure).append("svg").attr({viewBox: `0 0 ${width} ${height}`, role: "img"});
    svg.append("title").text(figure.querySelector("figcaption").textContent);
    const decades = d3.range(Math.ceil(Math.log10(y.domain()[1])) + 1).map((p) => 10 ** p).filter((v) => v <= y.domain()[1]);
    svg.append("g").attr("transform", `translate(${left},0)`)
      .call(d3.svg.axis().scale(y).orient("left").tickValues(decades).tickFormat(d3.format(",")).tickSize(-(width - left - right), 0));
    // As many labels as there is room for; those that are no power always, and then no power beside them.
    const every = Math.ceil(columns.length * 46 / width);
    const always = d3.range(columns.length).filter((i) => columns[i].always);
    const free = (i) => always.every((k) => Math.abs(x(i) - x(k)) > 20 + 3 * columns[k].label.length);
    const labelled = d3.range(columns.length).filter((i) => columns[i].always || (columns[i].power % every === 0 && free(i)));
    svg.append("g").attr("transform", `translate(0,${height - bottom})`)
      .call(d3.svg.axis().scale(x).tickValues(labelled).tickFormat((i) => columns[i].label).tickSize(3, 0));
    svg.append("text").attr({x: (left + width - right) / 2, y: height - 4, "text-anchor": "middle"}).text(axis);
    columns.forEach((column, i) => {
      const group = svg.append("g");
      group.append("title").text(column.title);
      for (const [name, count] of column.parts)
        if (count > 0)
          group.append("rect").attr({class: name, x: x(i), y: y(count), width: x.rangeBand(), height: height - bottom - y(count)});
    });
    const said = columns.filter((column) => column.parts.some((part) => part[1] > 0)).map((column) => column.title);
    figure.append(element("details", {}, element("summary", {}, "as numbers"), element("p", {}, said.join("; "))));
    if (bound !== undefined) {
      const at = x(bound) - 0.06 * x.rangeBand();
      svg.append("line").attr({class: "bound", x1: at, x2: at, y1: top, y2: height - bottom});
    }
  }

  function figure(caption) {
    return element("figure", {className: "chart"}, element("figcaption", {}, caption));
  }

  const name = (family) => `${family.pair}/${family.family}${family.scalar === "binary32" ? ".f32" : ""}`;

  /** How far off the numbers of each field are. */
  function errors(counts, bounds, width) {
    const grid = element("div", {className: "grid"});
    const fields = Object.entries(counts.fields);
    const powers = fields.flatMap(([, f]) => f.errors.map((e) => e[0]));
    if (powers.length === 0 && fields.every(([, f]) => f.not_finite === 0))
      return element("p", {}, fields.length === 0 ? "No number was claimed here." :
        `Nothing to draw: ${d3.sum(fields, ([, f]) => f.judged)} numbers, every one correctly rounded.`);
    const low = Math.min(-2, ...powers), high = Math.max(4, ...powers);
    for (const [field, f] of fields) {
      const bound = Math.log2(bounds[field.startsWith("point") ? "point" : field]);
      const at = new Map(f.errors);
      const columns = [{label: "right", always: true, title: `${f.correctly_rounded} correctly rounded`,
                        parts: [["c0", f.correctly_rounded]]}];
      for (let p = low; p <= high; ++p)
        columns.push({label: two(p), power: p, title: `${at.get(p) || 0} off by ${two(p)} to ${two(p + 1)} ulps`,
                      parts: [[p < bound ? "c1" : "c3", at.get(p) || 0]]});
      columns.push({label: "not finite", always: true, title: `${f.not_finite} not finite`, parts: [["c4", f.not_finite]]});
      const chart = figure(`${field}: ${f.judged} claims, ${f.beyond_bound} beyond the bound, ${f.not_finite} not finite`);
      bars(chart, width, columns, "error in ulps (dashed: the bound)", Math.ceil(bound) - low + 1);
      grid.append(chart);
    }
    return grid;
  }

  /** Which decisions are wrong, by the distance from where hit becomes miss. */
  function decisions(counts, scalar, width) {
    if (counts.margins.length === 0) return element("p", {}, "No decision on a pair with a distance was claimed here.");
    const wrong = counts.margins.filter((m) => m[3] > 0);
    const farthest = wrong.reduce((far, m) => (m[0] !== 0 && (far === null || m[1] > far) ? m[1] : far), null);
    const caption = wrong.length === 0 ? "Every decision is right, however near" :
      `${d3.sum(wrong, (m) => m[3])} wrong decisions` + (farthest === null ? ", all exactly at the limit" :
        `, the farthest ${two(farthest)} to ${two(farthest + 1)} ulps from the limit`);
    const high = Math.min(60, Math.max(4, ...counts.margins.map((m) => m[1])));
    const low = Math.max(-30, Math.min(0, ...counts.margins.map((m) => m[1])));
    const columns = [];
    const column = (side, power, label) => {
      const here = counts.margins.filter((m) => m[0] === side &&
        (side === 0 || Math.min(high, Math.max(low, m[1])) === power));
      const claimed = d3.sum(here, (m) => m[2]), bad = d3.sum(here, (m) => m[3]);
      const where = side === 0 ? "exactly at the limit" : `${two(power)} to ${two(power + 1)} ulps ${side < 0 ? "inside" : "outside"}`;
      columns.push({label, power: side === 0 ? undefined : power, always: side === 0,
                    title: `${where}: ${claimed} decisions, ${bad} wrong`, parts: [["all", claimed], ["c3", bad]]});
    };
    for (let p = high; p >= low; --p) column(-1, p, "−" + two(p));
    column(0, 0, "0");
    for (let p = low; p <= high; ++p) column(1, p, two(p));
    const chart = figure(caption);
    bars(chart, width, columns, `hit ←  √D − reach in ulps of reach (${scalar})  → miss`);
    return chart;
  }

  /** Lines of points [x, y] on two axes, whose scales get their ranges here. lines: [{name, points, apart}], apart: dots alone. */
  function lines_on(figure, title, below, across, up, lines) {
    const width = 420, height = 240, left = 50, right = 12, bottom = 38, top = 8;
    const x = across.scale().range([left + 8, width - right]), y = up.scale().range([height - bottom, top]);
    const svg = d3.select(figure).append("svg").attr({viewBox: `0 0 ${width} ${height}`, role: "img"});
    svg.append("title").text(title);
    svg.append("g").attr("transform", `translate(${left},0)`).call(up.orient("left").tickSize(-(width - left - right), 0));
    svg.append("g").attr("transform", `translate(0,${height - bottom})`).call(across.tickSize(3, 0));
    svg.append("text").attr({x: (left + width - right) / 2, y: height - 4, "text-anchor": "middle"}).text(below);
    const path = d3.svg.line().x((p) => x(p[0])).y((p) => y(p[1]));
    lines.forEach(({name, points, apart}, i) => {
      if (points.length === 0) return;
      const group = svg.append("g").attr("class", "l" + i % 6);
      group.append("title").text(name);
      if (!apart) group.append("path").attr({d: path(points), class: "line"});
      for (const p of points) group.append("circle").attr({cx: x(p[0]), cy: y(p[1]), r: apart ? 3 : 2});
    });
  }

  /** The largest error of each engine against the size of the question's numbers: both in powers of ten. */
  function scales(place, reports) {
    const shown = [-24, 24];  // golden files have every power that there is; beyond these nobody has lengths
    const clamp = (x) => Math.min(shown[1], Math.max(shown[0], x));
    const engines = reports.map((report) => report.engine.name);
    const key = element("p", {className: "key lines"});
    engines.forEach((engine, i) => key.append(element("span", {className: "l" + i % 6}, "━"), " " + engine + " "));
    const grid = element("div", {className: "grid"});
    const measures = [["values and coordinates", "length", 1], ["normals", "radians", 2], ["wrong decisions", "length", 3]];
    for (const [what, unit, at] of measures) {
      const lines = reports.map((report) => report.total.fitness.by_scale
        .filter((row) => Number(row[at]) > 0 && row[0] >= shown[0] && row[0] <= shown[1])
        .map((row) => [row[0], clamp(Math.log10(Math.min(Number(row[at]), 1e300)))]));
      const chart = figure(`${what}: the largest error (${unit})`);
      const every = lines.flat();
      if (every.length === 0) {
        chart.append(element("p", {}, "None is off."));
        grid.append(chart);
        continue;
      }
      const power = (p) => (Number.isInteger(p) ? "10" + superscript(p) : "");
      const x = d3.scale.linear().domain(d3.extent(every, (p) => p[0])), y = d3.scale.linear().domain(d3.extent(every, (p) => p[1])).nice();
      lines_on(chart, `${what}: the largest error by the size of the question's numbers`, "the question's largest number",
               d3.svg.axis().scale(x).ticks(7).tickFormat(power), d3.svg.axis().scale(y).ticks(6).tickFormat(power),
               lines.map((points, i) => ({name: engines[i], points})));
      const numbers = lines.map((points, i) => `${engines[i]}: ` +
        points.map((p) => `10${superscript(p[0])}: ${(10 ** p[1]).toExponential(1)}`).join(", ")).filter((_, i) => lines[i].length > 0);
      chart.append(element("details", {}, element("summary", {}, "as numbers"), element("p", {}, numbers.join("; "))));
      grid.append(chart);
    }
    place.append(...(engines.length > 1 ? [key] : []), grid);
  }

  /** What became of each measure from report to report. On a logarithmic scale 0 stands below everything, infinity above. */
  function history(place, {one_engine, labels, charts}) {
    const grid = element("div", {className: "grid"});
    for (const {what, logarithmic, values} of charts) {
      const chart = figure(what);
      grid.append(chart);
      const said = values.map((value, i) => [i + 1, Number(value)]).filter((_, i) => values[i] !== null);
      if (said.length === 0) {
        chart.append(element("p", {}, "No report says."));
        continue;
      }
      const x = d3.scale.linear().domain([0.7, labels.length + 0.3]), y = d3.scale.linear();
      const up = d3.svg.axis().scale(y);
      let points = said;
      if (logarithmic) {
        const powers = said.map((p) => Math.log10(p[1])), finite = powers.filter(Number.isFinite);
        const zero = powers.includes(-Infinity), endless = powers.includes(Infinity);
        const low = Math.floor(d3.min(finite) ?? 0) - (zero ? 1 : 0);
        const most = Math.max(low + 1, Math.ceil(d3.max(finite) ?? 0) + (endless ? 1 : 0));
        const step = Math.ceil((most - low) / 6), high = low + step * Math.ceil((most - low) / step);
        points = said.map((p, i) => [p[0], Math.min(high, Math.max(low, powers[i]))]);
        y.domain([low, high]);
        up.tickValues(d3.range(low, high + 1, step)).tickFormat((p) => (p === low && zero ? "0" : p === high && endless ? "∞" : "10" + superscript(p)));
      } else {
        const [low, high] = d3.extent(said, (p) => p[1]);
        y.domain(low === high ? [low - 1, low + 1] : [low, high]).nice();
        up.ticks(6);
      }
      lines_on(chart, what + ", report by report", "report",
               d3.svg.axis().scale(x).tickValues(d3.range(1, labels.length + 1, Math.ceil(labels.length / 20))).tickFormat(d3.format("d")),
               up, [{name: what, points, apart: !one_engine}]);
      chart.append(element("details", {}, element("summary", {}, "as numbers"), element("p", {},
        said.map(([i, value]) => `${labels[i - 1]}: ${Number(value.toPrecision(4))}`).join("; "))));
    }
    place.append(grid);
  }

  function charts(section, report) {
    const place = section.querySelector(".charts");
    const shown = element("div");
    const choice = element("select");
    const all = [["all families", report.total], ...report.families.map((f) => [name(f), f])];
    choice.append(...all.map(([label], i) => element("option", {value: i}, label)));
    const draw = () => {
      const counts = all[choice.value || 0][1];
      const width = Math.max(300, place.clientWidth), narrow = width < 984;  // two columns, as the style sheet has them
      shown.replaceChildren(
        element("h3", {}, "How far off the numbers are"), errors(counts, report.bounds, narrow ? width : width / 2 - 12),
        element("h3", {}, "Where decisions go wrong"),
        element("p", {}, "Pale: all decisions of pairs with a distance. Dark: the wrong ones. Both scales are logarithmic."),
        decisions(counts, report.scalar, width));
    };
    choice.addEventListener("change", draw);
    place.append(element("label", {}, "Charts of ", choice), shown);
    draw();
  }

  // ---- space ----

  let renderer = null;  // one for all views: a browser grants a page few
  function space() {
    if (renderer) return renderer;
    document.body.append(element("script", {textContent: document.getElementById("space").textContent}));
    renderer = new THREE.WebGLRenderer({antialias: true, alpha: true, preserveDrawingBuffer: true});
    return renderer;
  }

  const numbers = (v) => v.map(Number);  // "NaN" and "Infinity" are text in JSON
  const finite = (v) => v.every(Number.isFinite);
  const color = (property) => new THREE.Color(getComputedStyle(document.documentElement).getPropertyValue(property).trim());

  /** The points of a shape: its fields that are three numbers; of a plane the foot of another shape's first point. */
  const points = (shape, other) => {
    if (shape.normal) return [foot(shape, points(other)[0])];
    if (shape.vertices) return shape.vertices.map(numbers);
    if (shape.origin) return [numbers(shape.origin), far_end(shape)];
    if (shape.extents) return corners_of(shape);
    return Object.values(shape).filter(Array.isArray).map(numbers);
  };
  const orientation = (box) => {
    const q = numbers(box.orientation), most = Math.max(...q.map(Math.abs));
    return new THREE.Quaternion(...q.map((x) => x / most)).normalize();
  };
  /** The corners of a rotated box, rounded. */
  const corners_of = (box) => [...Array(8).keys()].map((k) => {
    const along = numbers(box.extents).map((x, i) => k >> i & 1 ? x : -x), most = Math.max(...along.map(Math.abs)) || 1;
    const turned = new THREE.Vector3(...along.map((x) => x / most)).applyQuaternion(orientation(box)).toArray();
    return numbers(box.center).map((x, i) => x + most * turned[i]);
  });
  /** The faces of the convex hull of points in the unit ball, rounded: of each its normal and its corners in order around it; of points in a plane
   *  both sides. None of points on a line. */
  function faces_of(all) {
    const near = 1e-7, faces = new Map();
    for (let i = 0; i < all.length; ++i)
      for (let j = 0; j < i; ++j)
        for (let k = 0; k < j; ++k) {
          const n = all[j].clone().sub(all[i]).cross(all[k].clone().sub(all[i]));
          if (n.length() < near * near) continue;
          n.normalize();
          const heights = all.map((p) => n.dot(p) - n.dot(all[i]));
          for (const side of [1, -1]) {
            if (!heights.every((h) => side * h <= near)) continue;
            const there = all.map((_, at) => at).filter((at) => Math.abs(heights[at]) <= near), name = side + there.join();
            const out = n.clone().multiplyScalar(side);
            if (!faces.has(name)) faces.set(name, {n: out, corners: around(there.map((at) => all[at]), out)});
          }
        }
    return [...faces.values()];
  }
  /** The corners of the polygon of some points of a plane, in order around it: from each the next is that which none lies beyond. */
  function around(flat, n) {
    const beyond = (from, p, q) => n.dot(p.clone().sub(from).cross(q.clone().sub(from)));
    const first = flat.reduce((p, q) => q.x < p.x || (q.x === p.x && (q.y < p.y || (q.y === p.y && q.z < p.z))) ? q : p);
    const corners = [first];
    while (corners.length <= flat.length) {
      const from = corners[corners.length - 1];
      const next = flat.filter((p) => p.distanceTo(from) > 0).reduce((p, q) => {
        const turn = beyond(from, p, q);
        return turn < 0 || (turn === 0 && q.distanceTo(from) > p.distanceTo(from)) ? q : p;
      });
      if (next.distanceTo(first) === 0) break;
      corners.push(next);
    }
    return corners;
  }
  /** Where a ray ends, rounded. */
  const far_end = (ray) => numbers(ray.origin).map((x, i) => x + Number(ray.length) * Number(ray.direction[i]));

  const unit = (v) => {
    const n = numbers(v), most = Math.max(...n.map(Math.abs)), shorter = n.map((x) => x / most);
    return {n: shorter.map((x) => x / Math.hypot(...shorter)), length: most * Math.hypot(...shorter)};
  };
  /** Where a point lies on a plane, straight below or above, rounded. */
  const foot = (plane, at) => {
    const {n, length} = unit(plane.normal);
    const s = n[0] * at[0] + n[1] * at[1] + n[2] * at[2] - Number(plane.offset) / length;
    const on = at.map((x, i) => x - s * n[i]);
    return finite(on) ? on : at;
  };

  /** The two shapes, moved and scaled to fit into the unit ball: what is done to every point of theirs. */
  function frame(query) {
    const shapes = [query.a, query.b].map((s) => {
      const at = points(s, query.a), r = Number(s.radius || 0);
      const ends = (least) => [0, 1, 2].map((i) => Math[least](...at.map((p) => p[i])));
      return {low: ends("min").map((x) => x - r), high: ends("max").map((x) => x + r), all: [...at.flat(), r]};
    });
    const largest = Math.max(...shapes.flatMap((s) => s.all.map(Math.abs)));
    // Sums and quotients of these neither overflow nor vanish.
    const k = largest > 2 ** 400 ? 2 ** -700 : largest < 2 ** -400 ? 2 ** 600 : 1;
    const low = [0, 1, 2].map((i) => Math.min(...shapes.map((s) => s.low[i] * k)));
    const high = [0, 1, 2].map((i) => Math.max(...shapes.map((s) => s.high[i] * k)));
    const middle = low.map((x, i) => x / 2 + high[i] / 2);
    const extent = Math.max(...low.map((x, i) => high[i] / 2 - x / 2)) || 1;
    return {point: (v) => new THREE.Vector3(...v.map((x, i) => (x * k - middle[i]) / extent)), length: (x) => x * k / extent};
  }

  function scene(worst, left_out) {
    const {query, claimed, right} = worst;
    const all = new THREE.Scene();
    const {point, length} = frame(query);
    const add = (geometry, material, at) => {
      const mesh = new THREE.Mesh(geometry, material);
      if (at) mesh.position.copy(at);
      all.add(mesh);
      return mesh;
    };
    const centers = [["a", "--first"], ["b", "--second"]].map(([key, property]) => {
      const shape = query[key], paint = color(property);
      const glass = new THREE.MeshPhongMaterial({color: paint, transparent: true, opacity: 0.28, depthWrite: false});
      const lines = new THREE.LineBasicMaterial({color: paint, transparent: true, opacity: 0.55});
      const draw = (geometry, wires, at, turn = new THREE.Quaternion()) => {
        add(geometry, glass, at).quaternion.copy(turn);
        const wired = new THREE.LineSegments(wires, lines);
        wired.position.copy(at);
        wired.quaternion.copy(turn);
        all.add(wired);
      };
      const ball = (at, radius) => draw(new THREE.SphereBufferGeometry(radius, 48, 32),
          new THREE.WireframeGeometry(new THREE.SphereBufferGeometry(radius, 16, 8)), at);
      let at;
      if (shape.extents) {
        at = point(numbers(shape.center));
        const box = new THREE.BoxBufferGeometry(...numbers(shape.extents).map((x) => 2 * length(x)));
        draw(box, new THREE.EdgesGeometry(box), at, orientation(shape));
      } else if (shape.center) {
        at = point(numbers(shape.center));
        ball(at, length(Number(shape.radius)));
      } else if (shape.min) {
        const low = point(numbers(shape.min)), high = point(numbers(shape.max));
        at = low.clone().add(high).multiplyScalar(0.5);
        const box = new THREE.BoxBufferGeometry(...high.sub(low).toArray());
        draw(box, new THREE.EdgesGeometry(box), at);
      } else if (shape.normal) {  // a slab of the half-space, its upper side the plane
        at = point(points(shape, query.a)[0]);
        const n = new THREE.Vector3(...unit(shape.normal).n), slab = new THREE.BoxBufferGeometry(2, 0.3, 2);
        const turn = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 1, 0), n);
        draw(slab, new THREE.EdgesGeometry(slab), at.clone().addScaledVector(n, -0.15), turn);
      } else if (shape.start && "radius" in shape) {  // two balls and the cylinder between them, which stands along y until it is turned
        const start = point(numbers(shape.start)), end = point(numbers(shape.end)), radius = length(Number(shape.radius));
        at = start.clone().add(end).multiplyScalar(0.5);
        for (const tip of [start, end]) ball(tip, radius);
        const along = end.clone().sub(start);
        const side = (sectors) => new THREE.CylinderBufferGeometry(radius, radius, along.length(), sectors, 1, true);
        const turn = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 1, 0), along.clone().normalize());
        if (along.length() > 0) draw(side(48), new THREE.EdgesGeometry(side(16), 1), at, turn);
      } else if (shape.vertices && "radius" in shape) {  // its faces, moved out by the radius, a ball around each corner and tubes along the edges
        const corners = points(shape).map(point), radius = length(Number(shape.radius));
        at = corners.reduce((sum, v) => sum.add(v), new THREE.Vector3()).divideScalar(corners.length);
        const faces = faces_of(corners), edges = new Map();
        const join = (p, q) => edges.set([p, q].map((v) => corners.indexOf(v)).sort().join(), [p, q]);
        for (const face of faces) {
          const out = face.corners.map((v) => v.clone().addScaledVector(face.n, radius));
          const fan = out.slice(2).flatMap((v, i) => [out[0], out[i + 1], v]);
          const glazed = new THREE.BufferGeometry().setFromPoints(fan);
          glazed.computeVertexNormals();
          add(glazed, glass);
          face.corners.forEach((v, i) => join(v, face.corners[(i + 1) % face.corners.length]));
        }
        if (faces.length === 0)  // on a line, or a point: from any of them to all others
          corners.slice(1).forEach((v) => join(corners[0], v));
        all.add(new THREE.LineSegments(new THREE.BufferGeometry().setFromPoints([...edges.values()].flat()), lines));
        for (const v of corners) add(new THREE.SphereBufferGeometry(Math.max(radius, 0.01), 24, 16), glass, v);
        for (const [p, q] of edges.values()) {
          const along = q.clone().sub(p), size = along.length();
          if (radius > 0 && size > 0)
            add(new THREE.CylinderBufferGeometry(radius, radius, size, 24, 1, true), glass, p.clone().addScaledVector(along, 0.5))
                .quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), along.normalize());
        }
      } else if (shape.vertices) {  // both of its sides
        const corners = points(shape).map(point);
        at = corners[0].clone().add(corners[1]).add(corners[2]).divideScalar(3);
        const face = new THREE.BufferGeometry().setFromPoints([...corners, ...corners.slice().reverse()].map((v) => v.clone().sub(at)));
        face.computeVertexNormals();
        draw(face, new THREE.EdgesGeometry(face), at);
      } else if (shape.origin || shape.start) {  // a thin rod; an arrow, thick where the ray begins
        const [start, end] = points(shape).map(point);
        at = start.clone().add(end).multiplyScalar(0.5);
        const along = end.clone().sub(start);
        const turn = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 1, 0), along.clone().normalize());
        const shaft = new THREE.CylinderBufferGeometry(shape.origin ? 0.004 : 0.008, shape.origin ? 0.014 : 0.008, along.length(), 12);
        if (along.length() > 0) draw(shaft, new THREE.EdgesGeometry(shaft), at, turn);
        for (const tip of shape.origin ? [start] : [start, end])
          add(new THREE.SphereBufferGeometry(0.025, 12, 8), new THREE.MeshBasicMaterial({color: paint}), tip);
      } else {  // a shape without a drawing of its own: a dot at its first point
        at = point(points(shape)[0]);
        ball(at, 0.02);
      }
      add(new THREE.SphereBufferGeometry(0.02, 12, 8), new THREE.MeshBasicMaterial({color: paint}), at);
      return at;
    });
    // Right: a ball and a thick, short arrow. Claimed: a cage around it and a thin, long arrow.
    for (const [says, answer, property] of [["right", right, "--right"], ["claimed", claimed, "--claimed"]]) {
      if (!answer.contact) continue;
      const is_right = says === "right", material = new THREE.MeshBasicMaterial({color: color(property), wireframe: !is_right});
      const solid = new THREE.MeshBasicMaterial({color: color(property)});
      const places = ["point1", "point2", "point"].filter((field) => answer.contact[field]).map((field) => [field, answer.contact[field]]);
      for (const [field, place] of places.concat((answer.contact.points ?? []).map((each) => ["points", each]))) {
        const v = numbers(place), at = finite(v) ? point(v) : null;
        if (at && at.length() < 3)
          add(is_right ? new THREE.SphereBufferGeometry(0.035, 16, 12) : new THREE.OctahedronBufferGeometry(0.075), material, at);
        else
          left_out.push(`${says} ${field} (${at ? "far outside" : "not finite"})`);
      }
      if (!answer.contact.normal) continue;
      const n = new THREE.Vector3(...numbers(answer.contact.normal));
      if (!finite(n.toArray()) || n.length() === 0) {
        left_out.push(`${says} normal (${n.length() === 0 ? "zero" : "not finite"})`);
        continue;
      }
      n.normalize();
      const size = is_right ? 0.45 : 0.65, thick = is_right ? 0.016 : 0.007;
      const turn = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 1, 0), n);
      const from = centers[0].clone().add(centers[1]).multiplyScalar(0.5);
      add(new THREE.CylinderBufferGeometry(thick, thick, size, 12), solid, from.clone().addScaledVector(n, size / 2)).quaternion.copy(turn);
      add(new THREE.ConeBufferGeometry(3 * thick, 0.09, 16), solid, from.clone().addScaledVector(n, size)).quaternion.copy(turn);
    }
    all.add(new THREE.HemisphereLight(0xffffff, 0x555555, 1));
    return all;
  }

  function view(figure, worst) {
    const canvas = element("canvas", {tabIndex: 0});
    const caption = element("figcaption");
    figure.append(canvas, caption);
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", `The two shapes, the right and the claimed contact: ${worst.what}. ` +
      "Arrow keys turn, plus and minus zoom, 0 goes back.");
    let drawn, camera, controls, left_out;
    const draw = () => {
      const scale = Math.min(2, devicePixelRatio || 1);
      const width = Math.round(canvas.clientWidth * scale), height = Math.round(canvas.clientHeight * scale);
      if (width === 0 || height === 0) return;
      if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, {width, height});
      camera.aspect = width / height;
      camera.updateProjectionMatrix();
      renderer.setSize(width, height, false);
      renderer.render(drawn, camera);
      const flat = canvas.getContext("2d");
      flat.clearRect(0, 0, width, height);
      flat.drawImage(renderer.domElement, 0, 0);
    };
    const fresh = () => {
      left_out = [];
      drawn = scene(worst, left_out);
    };
    const start = () => {
      try {
        space();
      } catch (error) {
        figure.replaceChildren(element("p", {}, `No view in space: ${error.message || error}`));
        return;
      }
      camera = new THREE.PerspectiveCamera(35, 4 / 3, 0.1, 50);
      const home = () => {
        camera.position.set(1.3, 1.1, 3.5);
        camera.zoom = 1;
        camera.lookAt(0, 0, 0);
      };
      home();
      fresh();
      controls = new THREE.OrbitControls(camera, canvas);
      Object.assign(controls, {enableKeys: false, enableZoom: false, enablePan: false});
      controls.addEventListener("change", draw);
      canvas.addEventListener("keydown", (event) => {
        const turn = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]}[event.key];
        const zoom = {"+": 1.2, "=": 1.2, "-": 1 / 1.2}[event.key];
        if (turn) {
          const place = new THREE.Spherical().setFromVector3(camera.position);
          place.theta += 0.15 * turn[0];
          place.phi += 0.15 * turn[1];
          camera.position.setFromSpherical(place.makeSafe());
        } else if (zoom) {
          camera.zoom = Math.min(50, Math.max(0.3, camera.zoom * zoom));
        } else if (event.key === "0" || event.key === "Home") {
          home();
        } else {
          return;
        }
        event.preventDefault();
        controls.update();
        draw();
      });
      matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
        fresh();
        draw();
      });
      new ResizeObserver(draw).observe(canvas);
      const legend = (name, sign, text) => [element("b", {className: name}, sign + " " + text), "  "];
      caption.append(...legend("a", "◯", "a"), ...legend("b", "◯", "b"), ...legend("r", "●", "right"),
                     ...legend("c", "◇", "claimed"), "· drag or arrow keys; zoom:\u00a0+\u00a0−\u00a00");
      if (left_out.length !== 0) caption.append(element("br"), "Not in the picture: " + left_out.join(", "));
      figure.dataset.drawn = "yes";
      draw();
    };
    new IntersectionObserver((entries, observer) => {
      if (!entries.some((e) => e.isIntersecting)) return;
      observer.disconnect();
      start();
    }, {rootMargin: "200px"}).observe(canvas);
  }

  // ---- the page ----

  const reports = [];
  for (const section of document.querySelectorAll("section")) {
    const report = JSON.parse(section.querySelector("script.data").textContent);
    reports.push(report);
    if (typeof d3 === "undefined") {
      section.querySelector(".charts").append(element("p", {}, "Built without D3 and three.js: no charts and no views."));
      continue;
    }
    charts(section, report);
    for (const article of section.querySelectorAll("article")) {
      const worst = report.worst[article.dataset.case];
      if (inside(worst.query)) view(article.querySelector(".view"), worst);
    }
  }
  if (typeof d3 !== "undefined" && reports.length !== 0) scales(document.getElementById("scales"), reports);
  const told = document.querySelector("script.history");
  if (told && typeof d3 !== "undefined") history(document.getElementById("history"), JSON.parse(told.textContent));
  /** Whether every number of a question is finite, so that it can be drawn. */
  function inside(query) {
    return [query.a, query.b].every((s) => finite(numbers(Object.values(s).flat(2))));
  }

  for (const box of document.querySelectorAll(".copy")) {
    const button = box.querySelector("button"), code = box.querySelector("code");
    button.addEventListener("click", async () => {
      try {
        await navigator.clipboard.writeText(code.textContent);
      } catch {
        getSelection().selectAllChildren(code);  // where the clipboard is not granted
        document.execCommand("copy");
      }
      button.textContent = "Copied";
    });
  }
})();
