#!/usr/bin/env python3
"""Draws docs/pairs.svg: a question of each pair with the features that its answer distinguishes. Points, normals and values are
those of `explain`.

    python3 docs/draw_pairs.py build/release/contact-oracle [FILE.svg]"""
import json
import math
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
SCALE, WIDTH, HEIGHT, COLUMNS = 26, 270, 226, 4

TRIANGLE = {"vertices": [[-2, -1.6, 0], [3, -1.6, 0], [-0.5, 2, 0]]}
# Seen from above and aside; all others from the front, with z = 0.
LYING = {"vertices": [[-3, -1, -2], [3.5, -1, -1], [0, -1, 3]]}
TURNED = {"center": [-0.9, -0.5, 0], "orientation": [0, 0, 1, 4], "extents": [1.8, 1, 1]}
LEANING = {"start": [1.2, 1.7, 0], "end": [3, 0.2, 0], "radius": 0.5}
STONE = {"vertices": [[-2.8, -0.6, 0], [-1.4, -1.9, 0], [0.6, -1.4, 0], [0.9, 0.4, 0], [-1.2, 1.2, 0]], "radius": 0}
SLOPE = {"normal": [0.15, 1, 0], "offset": -0.3}
# The pair, its shapes, the features in words, and the lines where one feature takes over from the next.
PANELS = [
    ("sphere_sphere", {"center": [-1.2, -0.5, 0], "radius": 1.8}, {"center": [1.6, 0.7, 0], "radius": 1.5}, "centre to centre", []),
    ("cube_cube", {"min": [-3, -1.7, -1], "max": [0.6, 1, 1]}, {"min": [-0.4, 0, -1], "max": [2.8, 1.9, 1]}, "axis by axis: a hit or none", []),
    ("sphere_cube", {"center": [1.9, 1.7, 0], "radius": 1.5}, {"min": [-3, -1.8, -1], "max": [1.1, 0.9, 1]}, "face, edge or corner; inside, the nearest face",
     [([1.1, 0.9], [3.6, 0.9]), ([1.1, 0.9], [1.1, 2.6]), ([1.1, -1.8], [3.6, -1.8]), ([-3, 0.9], [-3, 2.6])]),
    ("sphere_capsule", {"center": [0.6, 1.5, 0], "radius": 1.2}, {"start": [-2.4, -1.2, 0], "end": [1.6, -0.4, 0], "radius": 0.9},
     "an end, or the side", "ends"),
    ("capsule_capsule", {"start": [-2.8, 1.2, 0], "end": [0, 0.6, 0], "radius": 0.7},
     {"start": [-1.4, -1.7, 0], "end": [2.6, 1.3, 0], "radius": 0.6}, "ends and sides of both; many where parallel", "ends"),
    ("sphere_triangle", {"center": [1.7, 0.9, 0], "radius": 1.2}, TRIANGLE, "face, three edges, three vertices", "edges"),
    ("ray_sphere", {"origin": [-3, -1.4, 0], "direction": [1, 0.25, 0], "length": 5}, {"center": [0.4, 1, 0], "radius": 1.7},
     "origin, side or end", "ends"),
    ("sphere_plane", {"center": [-0.6, 0.7, 0], "radius": 1.6}, {"normal": [0.25, 1, 0], "offset": -0.4}, "above or below: a signed distance", []),
    ("capsule_plane", {"start": [-2, 0.2, 0], "end": [1.8, 1.4, 0], "radius": 0.8}, {"normal": [0.1, 1, 0], "offset": -0.3},
     "the lower end; many where parallel", []),
    ("ray_triangle", {"origin": [-1.6, 2.4, 0.2], "direction": [1, -2.1, 0], "length": 2.2}, LYING, "a point that both have, or none", []),
    ("triangle_line", LYING, {"start": [2.2, 2.2, -0.6], "end": [-0.4, -2.4, 0.3]}, "the same, with the normal turned round", []),
    ("cast_sphere", {"origin": [-3.6, -1.2, 0], "direction": [1, 0.25, 0], "length": 6}, {"center": [0.8, 0.4, 0], "radius": 1.6},
     "the first hit of a ray, or none", []),
    ("cast_cube", {"origin": [-3.6, -1.2, 0], "direction": [1, 0.25, 0], "length": 6}, {"min": [-0.8, -1.7, -1], "max": [2.6, 1.6, 1]},
     "a face, an edge or a corner", []),
    ("cast_capsule", {"origin": [-3.6, -1.6, 0], "direction": [1, 0.25, 0], "length": 6},
     {"start": [-0.4, -1.2, 0], "end": [1.8, 1.4, 0], "radius": 0.8}, "the side, or the ball at an end", []),
    ("cast_triangle", {"origin": [-1.6, 2.4, 0.2], "direction": [1, -2.1, 0], "length": 2.2}, LYING, "from either side", []),
    ("cast_plane", {"origin": [-2.6, 2.2, 0], "direction": [1, -0.8, 0], "length": 5}, {"normal": [0.25, 1, 0], "offset": -0.4},
     "from above, and at once from below", []),
    ("obb_obb", TURNED, {"center": [1.9, 0.4, 0], "orientation": [0, 0, 1, 3], "extents": [1, 0.8, 1]}, "faces, and edges crosswise: 15 ways out", []),
    ("sphere_obb", {"center": [2, 1.3, 0], "radius": 1.1}, TURNED, "face, edge or corner; inside, the nearest face", []),
    ("capsule_cube", LEANING, {"min": [-3.2, -1.8, -1], "max": [0.6, 0.4, 1]}, "as a capsule and a rotated box", []),
    ("capsule_obb", LEANING, TURNED, "an end or the side; a face or an edge", []),
    ("capsule_triangle", {"start": [0.4, 1.9, 0], "end": [3, 1.3, 0], "radius": 0.5}, TRIANGLE, "face, edges and vertices; through it, a depth", []),
    ("cube_obb", {"min": [0.9, -1.6, -1], "max": [3.2, 1, 1]}, TURNED, "as two rotated boxes", []),
    ("cube_triangle", {"min": [1, 0.2, -1], "max": [3.2, 1.8, 1]}, TRIANGLE, "as a rotated box and a triangle", []),
    ("obb_triangle", {"center": [2.2, 1.4, 0], "orientation": [0, 0, 1, 3], "extents": [1, 0.6, 1]}, TRIANGLE, "faces, and edges crosswise", []),
    ("triangle_triangle", LYING, {"vertices": [[-1.5, 1.9, 0], [0.6, 0.4, 0], [2, 2, 0]]}, "apart, or through each other", []),
    ("cube_plane", {"min": [-1.6, 0.2, -1], "max": [1.4, 2, 1]}, SLOPE, "the lowest corner; many where level", []),
    ("obb_plane", {"center": [-0.2, 0.9, 0], "orientation": [0, 0, 1, 5], "extents": [1.6, 0.8, 1]}, SLOPE, "the lowest corner; many where level", []),
    ("triangle_plane", {"vertices": [[-2, 1.4, 0], [0.4, 0.2, 0], [2, 2, 0]]}, SLOPE, "the lowest vertex; many where level", []),
    ("sphere_hull", {"center": [2, 1.4, 0], "radius": 0.9}, STONE, "any face, edge or vertex of the hull", []),
    ("capsule_hull", LEANING, STONE, "ends and side against the hull", []),
    ("cube_hull", {"min": [1, -0.4, -1], "max": [3.2, 1.8, 1]}, STONE, "box and hull", []),
    ("obb_hull", {"center": [2, 1, 0], "orientation": [0, 0, 1, 3], "extents": [1, 0.7, 1]}, STONE, "rotated box and hull", []),
    ("triangle_hull", {"vertices": [[0.8, 1.4, 0], [3.2, 0.2, 0], [2.6, 2.2, 0]]}, STONE, "triangle and hull", []),
    ("hull_hull", {"vertices": [[0.7, 0.9, 0], [2, -0.4, 0], [3.4, 0.6, 0], [2.9, 2, 0], [1.4, 2, 0]], "radius": 0}, STONE,
     "a face, an edge or a vertex of each", []),
    ("hull_plane", {"vertices": [[-1.8, 1, 0], [-0.6, 0.3, 0], [1.2, 0.5, 0], [1.6, 1.8, 0], [-0.8, 2.1, 0]], "radius": 0}, SLOPE, "the lowest vertex; many where level", []),
]
STYLE = """
svg{font:12px system-ui,sans-serif}
.first{fill:#3b82c4;stroke:#1d5a96}.second{fill:#e08a3c;stroke:#a85a13}
.first,.second{fill-opacity:.28;stroke-width:1.5}.thin{fill:none;stroke-width:3;stroke-linecap:round}
.open{stroke:none}.tip{fill:#1d5a96}.core{fill:none;stroke-dasharray:none;stroke-width:1;stroke-opacity:.8}
.border{stroke:#888;stroke-dasharray:3 3;fill:none}.normal{stroke:#0b6e4f;stroke-width:2}.head{fill:#0b6e4f}
.point{fill:#0b6e4f}.near{fill:none;stroke:#555;stroke-width:1.5}text{fill:#222}.name{font-weight:600}.small{font-size:11px;fill:#555}
@media (prefers-color-scheme:dark){text{fill:#eee}.small{fill:#bbb}.normal{stroke:#5fd3a6}.head,.point{fill:#5fd3a6}.near{stroke:#ccc}}
"""


def explained(tool, pair, a, b):
    query = {"pair": pair, "scalar": "binary64", "a": a, "b": b, "alarm": 2, "contact": 0}
    made = subprocess.run([tool, "explain", "--json"], input=json.dumps(query) + "\n", capture_output=True, text=True, check=True)
    return json.loads(made.stdout)["expect"]


def seen(v):
    """Where a point of space lies on a panel."""
    x, y, z = (*v, 0)[:3]
    return WIDTH / 2 + SCALE * (x + 0.35 * z), HEIGHT / 2 - 6 - SCALE * (y - 0.45 * z)


def attributes(**values):
    return " ".join(f'{key.rstrip("_").replace("_", "-")}="{value:.1f}"' if isinstance(value, float) else
                    f'{key.rstrip("_").replace("_", "-")}="{value}"' for key, value in values.items())


def circle(v, radius, style):
    x, y = seen(v)
    return f"<circle {attributes(cx=x, cy=y, r=float(radius), class_=style)}/>"


def line(v, w, style):
    (x1, y1), (x2, y2) = seen(v), seen(w)
    return f"<line {attributes(x1=x1, y1=y1, x2=x2, y2=y2, class_=style)}/>"


def polygon(corners, style):
    points = " ".join(f"{x:.1f},{y:.1f}" for x, y in map(seen, corners))
    return f'<polygon points="{points}" class="{style}"/>'


def ends_of(shape):
    if "origin" in shape:
        return shape["origin"], [x + shape["length"] * d for x, d in zip(shape["origin"], shape["direction"])]
    return shape["start"], shape["end"]


def across(v, w):
    """The unit vector at right angles to the way from v to w, in the plane of the picture."""
    x, y = w[0] - v[0], w[1] - v[1]
    return -y / math.hypot(x, y), x / math.hypot(x, y)


def drawn(shape, style):
    if "orientation" in shape:  # about z
        *_, z, w = shape["orientation"]
        c, s = (w * w - z * z) / (w * w + z * z), 2 * z * w / (w * w + z * z)
        (x, y, _), (u, v, _) = shape["center"], shape["extents"]
        return polygon([[x + c * i * u - s * j * v, y + s * i * u + c * j * v] for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))], style)
    if "center" in shape:
        return circle(shape["center"], shape["radius"] * SCALE, style) + circle(shape["center"], 1.6, f"{style} core")
    if "min" in shape:
        (x, y, _), (u, v, _) = shape["min"], shape["max"]
        return polygon([[x, y], [u, y], [u, v], [x, v]], style)
    if "vertices" in shape:
        return polygon(shape["vertices"], style)
    if "normal" in shape:
        (x, y, _), offset = shape["normal"], shape["offset"]
        left, right = ([u, (offset - x * u) / y] for u in (-4.6, 4.6))
        return polygon([left, right, [4.6, -2.9], [-4.6, -2.9]], f"{style} open") + line(left, right, style)
    start, end = ends_of(shape)
    if "radius" not in shape:
        arrow = f' marker-end="url(#{style})"' if "origin" in shape else ""
        return line(start, end, f"{style} thin").replace("/>", f"{arrow}/>")
    (nx, ny), r = across(start, end), shape["radius"]
    corners = [seen([p[0] + side * r * nx, p[1] + side * r * ny]) for p, side in ((start, 1), (end, 1), (end, -1), (start, -1))]
    (ax, ay), (bx, by), (cx, cy), (dx, dy) = corners
    size = f"{r * SCALE:.1f}"
    path = f"M{ax:.1f} {ay:.1f}L{bx:.1f} {by:.1f}A{size} {size} 0 0 1 {cx:.1f} {cy:.1f}L{dx:.1f} {dy:.1f}A{size} {size} 0 0 1 {ax:.1f} {ay:.1f}Z"
    return f'<path d="{path}" class="{style}"/>' + line(start, end, f"{style} core")


def borders(kind, shapes):
    if kind == "edges":
        corners = [x for x in shapes if "vertices" in x][0]["vertices"]
        lines = []
        for i, v in enumerate(corners):  # outwards from each vertex, at right angles to its two edges
            for w in (corners[i - 1], corners[(i + 1) % 3]):
                n, inner = across(v, w), corners[3 - i - corners.index(w)]
                out = -1 if n[0] * (inner[0] - v[0]) + n[1] * (inner[1] - v[1]) > 0 else 1
                lines.append((v, [v[0] + 0.9 * out * n[0], v[1] + 0.9 * out * n[1]]))
        return lines
    if kind == "ends":
        lines = []
        for shape in shapes:
            if "center" in shape:
                continue
            v, w = ends_of(shape)
            n, reach = across(v, w), shape.get("radius", 0) + 0.7
            lines += [([p[0] + s * reach * n[0], p[1] + s * reach * n[1]], p) for p in (v, w) for s in (1, -1)]
        return lines
    return kind


def panel(tool, name, a, b, words, kind):
    parts = [line(v, w, "border") for v, w in borders(kind, (a, b))]
    parts += [drawn(b, "second"), drawn(a, "first")]
    expect = explained(tool, name, a, b)
    value = "overlap"
    if "normal" in expect:
        n, first, second = expect["normal"], expect["point1"], expect["point2"]
        value = f"value {expect['value']:.3f}"
        for shape, point, side in ((a, first, -1), (b, second, 1)):
            if "radius" in shape:  # the nearest point of its core
                parts.append(circle([x + side * shape["radius"] * d for x, d in zip(point, n)], 3.2, "near"))
            parts.append(circle(point, 3.2, "point"))
        tip = [x + 1.1 * d for x, d in zip(first, n)]
        parts.append(line(first, tip, "normal").replace("/>", ' marker-end="url(#normal)"/>'))
    parts.append(f'<text x="10" y="20" class="name">{name}</text><text x="{WIDTH - 10}" y="20" text-anchor="end">{value}</text>')
    parts.append(f'<text x="10" y="{HEIGHT - 8}" class="small">{words}</text>')
    return "\n".join(parts)


def legend():
    rows = [('<rect x="14" y="{y}" width="16" height="12" class="first"/>', "the first shape"),
            ('<rect x="14" y="{y}" width="16" height="12" class="second"/>', "the second shape"),
            ('<circle cx="22" cy="{m}" r="3.2" class="near"/>', "nearest point of a core"),
            ('<circle cx="22" cy="{m}" r="3.2" class="point"/>', "contact point"),
            ('<line x1="12" y1="{m}" x2="30" y2="{m}" class="normal" marker-end="url(#normal)"/>', "normal, first to second"),
            ('<line x1="12" y1="{m}" x2="32" y2="{m}" class="border"/>', "here another feature begins")]
    parts = []
    for i, (mark, words) in enumerate(rows):
        y = 34 + 26 * i
        parts.append(mark.format(y=y, m=y + 6) + f'<text x="42" y="{y + 10}">{words}</text>')
    return "\n".join(parts)


def main(tool, to=HERE / "pairs.svg"):
    cells = [panel(tool, *p) for p in PANELS] + [legend()]
    rows = -(-len(cells) // COLUMNS)
    heads = "".join(f'<marker id="{name}" orient="auto" refX="3" refY="3" markerWidth="6" markerHeight="6">'
                    f'<path d="M0 0L6 3L0 6Z" class="{style}"/></marker>'
                    for name, style in (("normal", "head"), ("first", "tip")))
    clip = f'<clipPath id="cell"><rect width="{WIDTH}" height="{HEIGHT}"/></clipPath>'
    text = (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {COLUMNS * WIDTH} {rows * HEIGHT}" role="img" '
            f'aria-label="A question of each pair, its nearest points, contact points and normal">\n<style>{STYLE}</style>\n<defs>{heads}{clip}</defs>\n')
    for i, cell in enumerate(cells):
        text += f'<g transform="translate({i % COLUMNS * WIDTH} {i // COLUMNS * HEIGHT})" clip-path="url(#cell)">\n{cell}\n</g>\n'
    Path(to).write_text(text + "</svg>\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
