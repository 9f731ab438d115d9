"""Are golden contact files right? All that they answer is derived again here, from the mathematics alone.
    python3 golden/verify.py FILE|FOLDER...     exit 0: all is right; 1: something is wrong, a line each; 2: not readable

This shares nothing with the program that wrote the files. Numbers are integers, fractions, and integer square roots with
their remainders; a float is only ever a name for 64 or 32 bits, and none is added, multiplied or rounded.
docs/formats.md says what the files mean. Why a case is there, its flags, is counted here and otherwise left to `lint`."""
import hashlib, itertools, json, math, struct, sys
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

# Significand bits; exponent of the smallest subnormal; bit pattern of infinity; struct's names of the float and of its bits.
SCALARS = {"binary64": (53, -1074, 0x7FF << 52, ">d", ">Q"), "binary32": (24, -149, 0xFF << 23, ">f", ">I")}
BALLS = [f"{s}.{x}" for s in "ab" for x in ("center[0]", "center[1]", "center[2]", "radius")] + ["alarm", "contact"]
BOXES = [f"{s}.{x}[{i}]" for s in "ab" for x in ("min", "max") for i in range(3)] + ["alarm", "contact"]
CAPSULES = [f"{s}.{x}" for s in "ab" for x in (*(f"{end}[{i}]" for end in ("start", "end") for i in range(3)), "radius")] + BALLS[-2:]
PLANE = [*(f"b.normal[{i}]" for i in range(3)), "b.offset"] + BALLS[-2:]
TRIANGLE = [f"b.vertices[{k}][{i}]" for k in range(3) for i in range(3)]
RAY = [f"a.{x}[{i}]" for x in ("origin", "direction") for i in range(3)] + ["a.length"]
INPUTS = {"sphere_sphere": BALLS, "rigid_sphere_rigid_sphere": BALLS, "sphere_rigid_sphere": BALLS, "cube_cube": BOXES,
          "sphere_cube": BALLS[:4] + BOXES[6:], "sphere_capsule": BALLS[:4] + CAPSULES[7:], "capsule_capsule": CAPSULES,
          "sphere_triangle": BALLS[:4] + TRIANGLE + BALLS[-2:], "ray_sphere": RAY + BALLS[4:],
          "ray_triangle": RAY + TRIANGLE + BALLS[-2:],
          "triangle_line": [x.replace("b", "a", 1) for x in TRIANGLE] + CAPSULES[7:13] + BALLS[-2:],
          "sphere_plane": BALLS[:4] + PLANE, "capsule_plane": CAPSULES[:7] + PLANE,
          "cast_sphere": RAY + BALLS[4:], "cast_cube": RAY + BOXES[6:], "cast_capsule": RAY + CAPSULES[7:],
          "cast_triangle": RAY + TRIANGLE + BALLS[-2:], "cast_plane": RAY + PLANE}
OBB = [f"a.{x}[{i}]" for x, many in (("center", 3), ("orientation", 4), ("extents", 3)) for i in range(many)]
CORES = {"sphere": BALLS[:4], "capsule": CAPSULES[:7], "cube": BOXES[:6], "obb": OBB, "triangle": INPUTS["triangle_line"][:9]}
CONVEXES = ("sphere_obb capsule_cube capsule_obb capsule_triangle cube_obb cube_triangle obb_obb obb_triangle triangle_triangle "
            "cube_plane obb_plane triangle_plane sphere_hull capsule_hull cube_hull obb_hull triangle_hull hull_hull hull_plane").split()
Written = type("Written", (str,), {})  # a number as it is spelt in the file


def spelt(value):
    """Canonical text. Of a number the shortest decimal that reads back as the same 64 bits, fixed where that is no longer."""
    if not isinstance(value, float):
        return str(value) if isinstance(value, Written) else json.dumps(value, ensure_ascii=False)
    if not math.isfinite(value):
        return f'"{Decimal(value)}"'  # "NaN", "Infinity", "-Infinity"
    decimal = Decimal(repr(value or 0.0)).normalize()
    digits, exponent = f"{decimal:e}".split("e")
    fixed, scientific = f"{decimal:f}", f"{digits}e{int(exponent):+03d}"
    return scientific if abs(value) >= 2**53 else min(fixed, scientific, key=len)


def leaves(value, path=""):
    """Every leaf under its path, such as expect.normal[0]."""
    if not value or not isinstance(value, (dict, list)):
        return {path: value}
    steps = [(f"[{i}]", entry) for i, entry in enumerate(value)] if isinstance(value, list) else [
        ("." * bool(path) + (key if key.isidentifier() else repr(key)), entry) for key, entry in value.items()]
    return {place: leaf for step, entry in steps for place, leaf in leaves(entry, path + step).items()}


def rounded(a, b, D, scalar):
    """The real a + b sqrt(D) to nearest, ties to even."""
    bits, least, infinity, as_float, as_bits = SCALARS[scalar]
    # In units of half the smallest subnormal the real is k / l +- sqrt(m / n) = (k n +- sqrt(q)) / (l n), all of them integers.
    (k, l), (m, n) = (x.as_integer_ratio() for x in (a * 2 ** (1 - least), b * b * D * 4 ** (1 - least)))
    q = m * n * l * l
    root = math.isqrt(q) if b > 0 else -math.isqrt(q - 1) - 1 if q else 0  # the largest integer up to +- sqrt(q)
    floor, rest = divmod(k * n + root, l * n)
    if floor < 0:
        return -rounded(-a, -b, D, scalar)
    drop = max(floor.bit_length() - bits, 1)  # the bits that do not fit: at least the one for halves
    kept, lost, half = floor >> drop, floor % (1 << drop), 1 << (drop - 1)
    kept += lost > half or (lost == half and (rest > 0 or root * root != q or kept % 2))
    # Bit patterns count a scalar's numbers, from 0 to infinity; 2^(bits - 1) of them share an exponent.
    return struct.unpack(as_float, struct.pack(as_bits, min(kept + ((drop - 1) << (bits - 1)), infinity)))[0]


def exactly(x):  # mantissa * 2^exponent / denominator, mantissa and denominator odd; a denominator of 1 is not written
    (n, up), (d, down) = ((k >> (twos := max((k & -k).bit_length() - 1, 0)), twos) for k in (abs(x.numerator), x.denominator))
    return f"{'-' * (x < 0)}{n:#x}p{up - down}" + f"/{d:#x}" * (d > 1)


def apart(c1, r1, c2, r2, along, times, degenerate, unique, alarm, contact, scalar, deep=False):
    """Spheres around two points whose distance, with its sign, is so many times the length of a direction; of cores with an
    inside, in which they meet (`deep`), that is minus their depth."""
    # Every number is a + b sqrt(S). The normal is along / sqrt(S) = (along / S) sqrt(S).
    S, reach, (bits, least, *_) = sum(n * n for n in along), alarm + r1 + r2, SCALARS[scalar]
    ulp = Fraction(2) ** (least + max(int(reach * 2**-least).bit_length() - bits, 0))  # reach is a multiple of 2^least
    D, beyond = times * times * S, {"exact.depth2": exactly(times * times * S)} if deep else {"exact.below": True} if times < 0 else {}
    exact = {"exact.distance2": exactly(Fraction(0) if deep else D), **beyond, "exact.reach": exactly(reach),
             "exact.margin_ulps": rounded(-reach / ulp, times / ulp, S, "binary64")}
    if times > 0 and D > reach * reach:
        return {"expect.hit": False, **exact}
    fields = (("normal", [0, 0, 0], 1), ("point1", c1, r1), ("point2", c2, -r2))  # each is c + r normal
    numbers = {f"expect.{name}[{i}]": rounded(c[i], r * Fraction(along[i]) / S, S, scalar) for name, c, r in fields for i in range(3)}
    numbers["expect.value"] = rounded(-(r1 + r2) - contact, times, S, scalar)
    return {"expect.hit": True, "expect.degenerate": degenerate, **({} if unique else {"expect.unique": False}), **numbers, **exact}


def spheres(c1, r1, c2, r2, alarm, contact, scalar, agreed=(1, 0, 0), unique=True):
    """Spheres around the nearest points of two shapes; `agreed` is a direction to take where these are one point."""
    delta = [q - p for p, q in zip(c1, c2)]
    along, times = (delta, Fraction(1)) if any(delta) else (agreed, Fraction(0))
    return apart(c1, r1, c2, r2, along, times, not any(delta), unique, alarm, contact, scalar)


def dot(x, y):
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]


def cross(x, y):
    return [x[i - 2] * y[i - 1] - x[i - 1] * y[i - 2] for i in range(3)]


def at(start, way, t):
    return [x + t * d for x, d in zip(start, way)]


def least_of(square, turns):
    """Where a convex function on 0 to 1 is least, first and last, if between some places it is a parabola, which three values
    tell: at such a place or at a vertex."""
    ends = sorted({Fraction(0), Fraction(1), *(t for t in turns if 0 < t < 1)})
    tries = set(ends)
    for low, high in zip(ends, ends[1:]):
        f, g, h = (square(low + (high - low) * part) for part in (0, Fraction(1, 2), 1))
        if bend := f - 2 * g + h:
            tries.add(min(max(low + (high - low) * (3 * f - 4 * g + h) / (4 * bend), low), high))
    least = min(map(square, tries))
    return (pick(t for t in tries if square(t) == least) for pick in (min, max))


def parting(across, u):
    """The direction by agreement of cores that meet: along a product, or across a direction."""
    x, y, z = u
    n = next(n for n in (across, [y * y + z * z, -x * y, -x * z], [0, x * x, 0], [1, 0, 0]) if any(n))
    return [-i for i in n] if next(i for i in n if i) < 0 else n


def triangle(c, r, v0, v1, v2, alarm, contact, scalar):
    """At s along one edge the square of the distance to what lies across it is least at a clamped t; that of s is convex, and
    between the places where t leaves its ends a parabola."""
    u, v = at(v1, v0, -1), at(v2, v0, -1)
    level = lambda s: dot(v, at(c, at(v0, u, s), -1)) / (dot(v, v) or 1)  # t, not clamped: linear in s
    nearest = lambda s: at(at(v0, u, s), v, sorted((Fraction(0), level(s), 1 - s))[1])
    slopes = ((level(0), level(1) - level(0)), (level(0) - 1, level(1) - level(0) + 1))  # of t, and of t less 1 - s
    s, _ = least_of(lambda s: dot(*[at(c, nearest(s), -1)] * 2), [-start / slope for start, slope in slopes if slope])
    return spheres(c, r, nearest(s), 0, alarm, contact, scalar, parting(cross(u, v), u if any(u) else v))


def capsules(a1, a2, r1, b1, b2, r2, alarm, contact, scalar):
    """The square of the distance from the first segment to the point at t of the second is convex, and between the points
    level with the first one's ends a parabola."""
    u, v = ([y - x for x, y in zip(*ends)] for ends in ((a1, a2), (b1, b2)))
    level = lambda q: dot(u, at(q, a1, -1)) / (dot(u, u) or 1)  # where q lies along the first segment, as a part of it
    nearest = lambda t: at(a1, u, sorted((Fraction(0), level(at(b1, v, t)), Fraction(1)))[1])
    square = lambda t: dot(*[at(at(b1, v, t), nearest(t), -1)] * 2)
    slope = level(b2) - level(b1)
    first, last = least_of(square, [(end - level(b1)) / slope for end in (0, 1) if slope])
    q = at(b1, v, (first + last) / 2)
    unique = at(b1, v, first) == at(b1, v, last)
    n = parting(cross(u, v), u if any(u) else v)
    return spheres(nearest((first + last) / 2), r1, q, r2, alarm, contact, scalar, n, unique)


def middle(points):
    """Of a point, a segment or a polygon: half way from the least to the greatest of its corners, in the order of lexicons."""
    return [Fraction(x + y) / 2 for x, y in zip(min(points), max(points))]


def over_plane(corners, r, *plane, alarm, contact, scalar):
    """How many normals a point is from the plane is linear: least at a corner, or at several and between them."""
    *n, offset = plane
    normals = {tuple(a): (dot(n, a) - offset) / dot(n, n) for a in corners}
    lowest = [a for a in normals if normals[a] == min(normals.values())]
    p = middle(lowest)
    return apart(p, r, at(p, n, -min(normals.values())), Fraction(0), [-x for x in n], min(normals.values()), False, len(lowest) == 1,
                 alarm, contact, scalar)


def crossing(start, way, corners, sign, scalar):
    """The point of the segment that the plane of the triangle has too lies on the inner side of every edge, or on it."""
    n = cross(*(at(corner, corners[0], -1) for corner in corners[1:]))
    if through := dot(n, way):
        x = at(start, way, part := dot(n, at(corners[0], start, -1)) / through)
        sides = [dot(n, cross(at(b, a, -1), at(x, a, -1))) for a, b in zip(corners, corners[1:] + corners[:1])]
        if 0 <= part <= 1 and min(sides) >= 0:
            names = [f"expect.{name}[{i}]" for name in ("normal", "point1", "point2") for i in range(3)]
            point = [rounded(k, 0, 0, scalar) for k in x]
            numbers = [rounded(0, sign * k / dot(n, n), dot(n, n), scalar) for k in n] + point + point
            return {"expect.hit": True, "expect.degenerate": False, **dict(zip(names, numbers)), "expect.value": 0.0,
                    **{f"exact.crossing[{i}]": exactly(k) for i, k in enumerate(x)}}
    return {"expect.hit": False, "exact.crossing": None}


def away(ways):
    """Of the directions along none of some ways, each divided by the sum of the sizes of its components, the greatest."""
    planes = [*ways, *([Fraction(i == k) for i in range(3)] for k in range(3))]
    products = [n for v in planes for w in planes if any(n := cross(v, w)) and all(dot(n, way) <= 0 for way in ways)]
    return max([x / sum(map(abs, n)) for x in n] for n in products)


def enters(o, d, parts, r):
    """Where a ray comes within r of the first of some parts of an axis, each a start, a way and the ends along it that it has:
    the square of the distance is a parabola, which three values tell. t = m - sqrt(h), and where along the part that is."""
    for start, u, low, high in parts:
        uu = dot(u, u)
        level = lambda x: dot(at(x, start, -1), u) / (uu or 1)
        f, g, k = (dot(*[at(at(x, start, -1), u, -level(x))] * 2) - r * r for x in (at(o, d, Fraction(t)) for t in (-1, 0, 1)))
        if a := (f + k) / 2 - g:
            m = (f - k) / (4 * a)
            if (h := m * m - g / a) >= 0:
                # low <= along m - slope sqrt(h) <= high
                along, slope = level(at(o, d, m)), level(at(o, d, m)) - level(at(o, d, m - 1))
                if all(end is None or sign_of(side * (along - end), -side * slope, h) >= 0 for side, end in ((1, low), (-1, high))):
                    return m, h, (start, u, along, slope)
    return None


def sign_of(a, b, D):
    """Of a + b sqrt(D): that of the difference of two numbers is that of their squares' with signs."""
    x = a * abs(a) + b * abs(b) * D
    return (x > 0) - (x < 0)


def hit_at(o, d, length, t, normal, scalar):
    """A ray at t = m - sqrt(h); `normal` of three (a, b) for a + b sqrt(D), and D. None: it begins there."""
    if t is None or sign_of(t[0], -1, t[1]) < 0 or sign_of(t[0] - length, -1, t[1]) > 0:
        return {"expect.hit": False, "exact.t": None}
    m, h = t
    parts, D = normal()
    right = {f"expect.normal[{i}]": rounded(*part, D, scalar) for i, part in enumerate(parts)}
    right |= {f"expect.{name}[{i}]": rounded(o[i] + m * d[i], -d[i], h, scalar) for name in ("point1", "point2") for i in range(3)}
    return {"expect.hit": True, "expect.degenerate": False, **right, "expect.value": rounded(m, -1, h, scalar),
            "exact.t[0]": exactly(m), "exact.t[1]": exactly(h)}


def begins(o, d, length, scalar):
    right = hit_at(o, d, length, (Fraction(0), Fraction(0)), lambda: ([(0, -x / dot(d, d)) for x in d], dot(d, d)), scalar)
    return right | {"expect.degenerate": True}


def unit(n):
    return [(0, x / dot(n, n)) for x in n], dot(n, n)


def cast_round(o, d, length, start, end, r, scalar):
    """At a sphere or a capsule: beside the axis, before it, past it."""
    u = at(end, start, -1)
    inside = min(max(dot(at(o, start, -1), u) / (dot(u, u) or 1), Fraction(0)), Fraction(1))
    w = at(at(o, start, -1), u, -inside)
    if dot(w, w) <= r * r:
        return begins(o, d, length, scalar)
    zero = [Fraction(0)] * 3
    parts = [(start, u, 0, 1)] * any(u) + [(start, zero, None, None), (end, zero, None, None)]
    found = [enters(o, d, [part], r) for part in parts]
    # Of what it enters, the first: beside the axis where it does so at all.
    found = [x for x in found if x]
    first = found[0] if found else None
    for other in found[1:] if found and not any(found[0][2][1]) else []:
        if before(other, first):
            first = other

    def normal():
        m, h, (origin, way, along, slope) = first
        if r == 0:
            x = at(o, d, m)
            return unit(away([at(start, x, -1), at(end, x, -1)]))
        return [((o[i] + m * d[i] - origin[i] - along * way[i]) / r, (slope * way[i] - d[i]) / r) for i in range(3)], h

    return hit_at(o, d, length, first and first[:2], normal, scalar)


def before(x, y):
    """m - sqrt(h) is less than another: sqrt(other h) is less than a number with a root."""
    (m, h), (n, k) = x[:2], y[:2]
    return sign_of(m - n, 1, k) < 0 or sign_of((m - n) ** 2 + k - h, 2 * (m - n), k) < 0


def cast_flat(o, d, length, corners, inside, tries, scalar):
    """At what has corners: the first of some places that is in it."""
    if inside(o):
        return begins(o, d, length, scalar)
    first = min((t for t in tries if inside(at(o, d, t))), default=None)
    normal = lambda: unit(away([at(corner, at(o, d, first), -1) for corner in corners]))
    return hit_at(o, d, length, None if first is None else (first, Fraction(0)), normal, scalar)


def cast_cube(o, d, length, low, high, scalar):
    tries = [(side[i] - o[i]) / d[i] for side in (low, high) for i in range(3) if d[i]]
    corners = [[(low, high)[k >> i & 1][i] for i in range(3)] for k in range(8)]
    return cast_flat(o, d, length, corners, lambda x: all(a <= b <= c for a, b, c in zip(low, x, high)), tries, scalar)


def cast_triangle(o, d, length, corners, scalar):
    """A point is in it where it is a sum of corners with weights from 0: the areas of three triangles add up to the whole's."""
    n = cross(at(corners[1], corners[0], -1), at(corners[2], corners[0], -1))
    edges = [(corners[k - 1], corners[k]) for k in range(3)]

    def inside(x):
        on_edge = lambda a, b: not any(cross(at(b, a, -1), at(x, a, -1))) and dot(at(a, x, -1), at(b, x, -1)) <= 0
        within = any(n) and dot(n, at(x, corners[0], -1)) == 0 and all(dot(n, cross(at(b, a, -1), at(x, a, -1))) >= 0 for a, b in edges)
        return within or any(on_edge(a, b) for a, b in edges)

    tries = [dot(at(corner, o, -1), d) / dot(d, d) for corner in corners]
    if through := dot(n, d):
        tries.append(dot(n, at(corners[0], o, -1)) / through)
    for a, b in edges:
        if any(q := cross(d, at(b, a, -1))):
            tries.append(dot(cross(at(a, o, -1), at(b, a, -1)), q) / dot(q, q))
    return cast_flat(o, d, length, corners, inside, tries, scalar)


def cast_plane(o, d, length, n, offset, scalar):
    if (height := dot(n, o) - offset) <= 0:
        return begins(o, d, length, scalar)
    t = (-height / dot(n, d), Fraction(0)) if dot(n, d) < 0 else None
    return hit_at(o, d, length, t, lambda: unit(n), scalar)


def sphere_cube(c, r, low, high, alarm, contact, scalar):
    """Outside: the sphere and the nearest point of the box, on each axis the middle one of three numbers."""
    q = [sorted(three)[1] for three in zip(c, low, high)]
    right = spheres(c, r, q, 0, alarm, contact, scalar)
    if q != c:
        return right
    # Inside: out through the first of the nearest faces; the normal points from it into the box.
    depth, i, sign, face = min(((sign * (c[i] - side[i]), i, sign, side[i]) for i in range(3) for sign, side in ((1, low), (-1, high))),
                               key=lambda way: way[0])
    for axis in range(3):
        here, plain = axis == i, rounded(c[axis], 0, 0, scalar)
        right[f"expect.normal[{axis}]"] = float(sign * here)
        right[f"expect.point1[{axis}]"] = rounded(c[axis] + sign * r, 0, 0, scalar) if here else plain
        right[f"expect.point2[{axis}]"] = rounded(face, 0, 0, scalar) if here else plain
    right["expect.value"] = rounded(-r - depth - contact, 0, 0, scalar)
    return right


def fields_of(kind, side, found):
    """The names of a shape's numbers; a hull has from 1 to 64 vertices."""
    many = len({x.split("]")[0] for x in found if x.startswith(f"{side}.vertices[")})
    if kind == "hull" and not 1 <= many <= 64:
        raise ValueError(f"{many} vertices")
    hull = [f"a.vertices[{k}][{i}]" for k in range(many) for i in range(3)] + ["a.radius"]
    return PLANE[:4] if kind == "plane" else [x.replace("a", side, 1) for x in CORES.get(kind, hull)]


def core_of(kind, x):
    """The corners of a shape's core, those of a box by a bit for each axis, and its radius."""
    if kind not in ("cube", "obb"):
        return [x[i:i + 3] for i in range(0, len(x) // 3 * 3, 3)], sum(x[len(x) // 3 * 3:], Fraction(0))
    axes = [[Fraction(i == k) for i in range(3)] for k in range(3)]
    start, ways = x[0:3], [at([Fraction(0)] * 3, axis, x[3 + k] - x[k]) for k, axis in enumerate(axes)]
    if kind == "obb":  # q v q* = (w w - u.u) v + 2 (u.v) u + 2 w u x v, for a quaternion of a vector u and a number w
        u, w = x[3:6], x[6]
        turned = [at(at([(w * w - dot(u, u)) * i for i in v], u, 2 * dot(u, v)), cross(u, v), 2 * w) for v in axes]
        ways = [[2 * extent * i / (w * w + dot(u, u)) for i in v] for v, extent in zip(turned, x[7:10])]
        start = at(start, [sum(i) for i in zip(*ways)], Fraction(-1, 2))
    return [at(start, [sum(way[i] for j, way in enumerate(ways) if k >> j & 1) for i in range(3)], 1) for k in range(8)], Fraction(0)


# What follows is of integers: corners in a unit that divides all their coordinates, directions of any length.
def reduced(n):
    return tuple(i // (math.gcd(*n) or 1) for i in n)


def hull(corners):
    """The ways of edges, each with corners where such an edge begins, and the directions out of the faces. A plane through two
    corners is turned about them, one way and the other, while a corner is above it: where it comes to rest above all it touches
    a face, and the two corners are of an edge if the two faces differ. Of corners on a line all are."""
    edges, faces, corners = {}, set(), sorted(set(corners))
    for p, q in itertools.combinations(corners, 2):
        way, planes, rest = at(q, p, -1), [], [at(c, p, -1) for c in corners]
        for side in (1, -1):
            n = [0, 0, 0]
            for c in rest:
                if dot(n, c) > 0 or not any(n):
                    n = [side * i for i in cross(way, c)]
            if any(dot(n, c) > 0 for c in rest):
                break
            planes.append(reduced(n))
        if len(planes) == 2 and (planes[0] != planes[1] or not any(n)):
            edges.setdefault(reduced(way), []).append(p)
            faces |= {n for n in planes if any(n)}
    return corners, edges, faces


def spanning(ways):
    """The directions and, where they lie in a plane, its normal; on a line, two across it; of none, three axes."""
    ways = ways or [[1, 0, 0]]
    if not any(any(cross(ways[0], way)) for way in ways):
        ways = [*ways, parting([0, 0, 0], ways[0])]
    n = next(n for way in ways if any(n := cross(ways[0], way)))
    return ways if any(dot(n, way) for way in ways) else [*ways, n]


def sides(a, b):
    """The directions out of every facet of the differences of two cores: of a face of either, or along an edge of each that is
    highest there. Flat ones have facets on either side, and others across their edges."""
    (a, some, faces), (b, others, backs) = a, b
    lifts = lambda n, starts, corners: any(all(dot(n, c) <= top for c in corners) for top in {dot(n, p) for p in starts})
    normals = faces | {tuple(-i for i in n) for n in backs}
    for v, w in itertools.product(some, others):
        n = cross(v, w)
        for n, out in ((n, [-i for i in n]), ([-i for i in n], n)) if any(n) else ():
            if lifts(n, some[v], a) and lifts(out, others[w], b):
                normals.add(reduced(n))
    ways = [*some, *others]
    added = spanning(ways)[len(ways):]
    flat = [n for k, v in enumerate(added) for w in (*ways, *added[:k]) if any(n := cross(v, w))]
    return normals | {reduced([sign * i for i in n]) for n in flat for sign in (1, -1)}


def highest(n, corners):
    """The corners of what lies farthest along a direction, around it."""
    top, around = max(dot(n, p) for p in corners), []
    face = sorted({p for p in corners if dot(n, p) == top})
    for half in (face, face[::-1]):
        chain = []
        for p in half:
            while len(chain) > 1 and dot(n, cross(at(chain[-1], chain[-2], -1), at(p, chain[-1], -1))) <= 0:
                chain.pop()
            chain.append(p)
        around += chain[:-1]
    return around or face


def held_by(planes, height):
    """The point of some planes nearest to the origin, times a number above 0, and that number; None where a plane does not hold
    it back: it is -(the sum of the planes' normals, each times a factor), and a factor is below 0."""
    if len(ways := spanning(planes)) == 3:  # else the normals depend on each other, and fewer of them do
        across = [cross(ways[i - 2], ways[i - 1]) for i in range(3)]
        scale = dot(ways[0], across[0])
        across = [[-i if scale < 0 else i for i in v] for v in across]
        x = [sum(height[n] * v[i] for n, v in zip(planes, across)) for i in range(3)]
        if all(dot(x, v) <= 0 for v in across):
            return x, abs(scale)


def nearest_within(height):
    """Of all x with n.x <= height[n] for every n the one nearest to the origin, which at most three of these hold back. To those
    that hold it so far comes one that it breaks, and so it goes farther out, until it breaks none."""
    x, scale, holding = [0, 0, 0], 1, ()
    while broken := {n: over for n in height if (over := dot(n, x) - height[n] * scale) > 0}:
        some = (*holding, max(broken, key=lambda n: broken[n] ** 2 // dot(n, n)))
        tries = ((planes, held_by(planes, height)) for k in (1, 2, 3) for planes in itertools.combinations(some, k))
        holding, (x, scale) = next((planes, held) for planes, held in tries
                                   if held and all(dot(n, held[0]) <= height[n] * held[1] for n in some))
    return [Fraction(i, scale) for i in x]


def way_out(height, a, b):
    """Of cores that meet: the direction of the facet of all differences that is nearest to 0; if they touch, of one through 0."""
    square = {n: Fraction(height[n] ** 2, dot(n, n)) for n in height}
    normals = [n for n in height if square[n] == min(square.values())]
    if min(square.values()) == 0:
        faces = {n: (highest(n, a), highest([-i for i in n], b)) for n in normals}
        ways = {n: [at(p, face[0], -1) for face in faces[n] for p in face] for n in normals}
        normals = [n for n in normals if any(any(cross(v, w)) for v, w in itertools.combinations(ways[n], 2))]
    return max(normals, key=lambda n: [Fraction(i, sum(map(abs, n))) for i in n], default=None)


def clipped(polygon, n, height):
    """What a half-space leaves of a polygon, a segment or a point."""
    kept = []
    for p, q in zip(polygon, polygon[1:] + polygon[:1]):
        f, g = dot(n, p) - height, dot(n, q) - height
        kept += [p] * (f <= 0)
        kept += [tuple(at(p, at(q, p, -1), f / (f - g)))] if f * g < 0 else []
    return kept


def convexes(a, r1, b, r2, alarm, contact, scalar):
    """The differences of points of two cores, of the first less of the second, are n.x <= height[n] for every n, and the cores
    part by an x where that is the nearest to 0 outside them all, or on their surface. p is in the first core, and in the
    second moved by x: a face of the first, clipped."""
    unit = math.lcm(*(i.denominator for corner in a + b for i in corner))
    a, b = ([tuple(int(i * unit) for i in corner) for corner in corners] for corners in (a, b))
    first, second = hull(a), hull(b)
    height = {n: max(dot(n, p) for p in a) - min(dot(n, q) for q in b) for n in sides(first, second)}
    if (lowest := min(height.values())) < 0:
        x = nearest_within(height)
        n, times = [-i for i in x], Fraction(1, unit)
    else:
        n = way_out(height, a, b) or parting([0, 0, 0], [*first[1], *second[1], [0, 0, 0]][0])  # none of a line or a point
        out = Fraction(lowest and height[n], dot(n, n))
        x, times = [out * i for i in n], -out / unit
    polygon = highest(n, a)
    for m in sides(second, hull([(0, 0, 0)])):
        polygon = clipped(polygon, m, max(dot(m, q) for q in b) + dot(m, x))
    p = [i / unit for i in middle(polygon)]
    return apart(p, r1, at(p, x, Fraction(-1, unit)), r2, n, times, lowest == 0, min(polygon) == max(polygon), alarm, contact, scalar,
                 deep=lowest > 0)


def right_case(found, pair, scalar):
    """What should stand in a line: the leaves of its question, and of all that follows from the question."""
    kinds = pair.split("_")
    fields = [fields_of(kind, side, found) for kind, side in zip(kinds, "ab")] if pair in CONVEXES else [INPUTS[pair][:-2], []]
    inputs = {x: float(found[x]) or 0.0 for x in (*fields[0], *fields[1], *BALLS[-2:])}
    counted = [y for kind, names in zip(kinds, fields) for y in [len(names) // 3.0] * (kind == "hull") + [inputs[x] for x in names]]
    packed = b"".join(b"\x7f\xf8" + bytes(6) if x != x else struct.pack(">d", x)
                      for x in (*counted, inputs["alarm"], inputs["contact"]))
    case = {"id": hashlib.sha256(pair.encode() + b"\0" + packed).hexdigest()[:24]}
    case |= {x: rounded(Fraction(n), 0, 0, scalar) if math.isfinite(n) else n for x, n in inputs.items()}  # binary32 in its files
    below = [x for x in inputs if inputs[x] < 0 and (".extents" in x or ("[" not in x and "offset" not in x))]
    ways = [x for x in inputs if x[2:] in ("direction[0]", "normal[0]", "orientation[0]")]
    zero = [x for x in ways if not any(inputs[y] for y in inputs if y.startswith(x[:-2]))]
    outside = [x[:-3] if x in zero else x for x in inputs if not math.isfinite(inputs[x]) or x in below + zero]
    outside += [x for x in inputs if ".min" in x and inputs[x] > inputs[x.replace("min", "max")]]
    if outside:  # The first is named: of a, of b, of the distances; of a box all numbers come before their order.
        return {**case, "flags[0]": "Invalid", "expect.rejected": min(outside, key=lambda x: (x[1] != ".", x[0]))}
    x = [Fraction(number) for number in inputs.values()]
    case |= {f"flags[{i}]": str(found[x]) for i, x in enumerate(x for x in found if x.startswith("flags["))} or {"flags": []}
    if pair in CONVEXES:
        (a, r1), b = core_of(kinds[0], x[:len(fields[0])]), x[len(fields[0]):-2]
        if kinds[1] == "plane":
            return case | over_plane(a, r1, *b, alarm=x[-2], contact=x[-1], scalar=scalar)
        return case | convexes(a, r1, *core_of(kinds[1], b), *x[-2:], scalar)
    if pair == "sphere_capsule":
        return case | capsules(x[0:3], x[0:3], x[3], x[4:7], x[7:10], x[10], x[11], x[12], scalar)
    if pair == "capsule_capsule":
        return case | capsules(x[0:3], x[3:6], x[6], x[7:10], x[10:13], x[13], x[14], x[15], scalar)
    if pair == "sphere_triangle":
        return case | triangle(x[0:3], x[3], x[4:7], x[7:10], x[10:13], x[13], x[14], scalar)
    if pair == "ray_sphere":
        return case | capsules(x[0:3], at(x[0:3], x[3:6], x[6]), Fraction(0), x[7:10], x[7:10], x[10], x[11], x[12], scalar)
    if pair == "ray_triangle":
        return case | crossing(x[0:3], [x[6] * d for d in x[3:6]], [x[7:10], x[10:13], x[13:16]], -1, scalar)
    if pair == "triangle_line":
        return case | crossing(x[9:12], at(x[12:15], x[9:12], -1), [x[0:3], x[3:6], x[6:9]], 1, scalar)
    if pair == "sphere_plane":
        return case | over_plane([x[0:3]], *x[3:8], alarm=x[8], contact=x[9], scalar=scalar)
    if pair == "capsule_plane":
        return case | over_plane([x[0:3], x[3:6]], *x[6:11], alarm=x[11], contact=x[12], scalar=scalar)
    if pair == "sphere_cube":
        return case | sphere_cube(x[0:3], x[3], x[4:7], x[7:10], x[10], x[11], scalar)
    if pair.startswith("cast"):
        ray, b = (x[0:3], x[3:6], x[6]), x[7:]
        shape = {"cast_sphere": lambda: cast_round(*ray, b[0:3], b[0:3], b[3], scalar),
                 "cast_capsule": lambda: cast_round(*ray, b[0:3], b[3:6], b[6], scalar),
                 "cast_cube": lambda: cast_cube(*ray, b[0:3], b[3:6], scalar),
                 "cast_triangle": lambda: cast_triangle(*ray, [b[0:3], b[3:6], b[6:9]], scalar),
                 "cast_plane": lambda: cast_plane(*ray, b[0:3], b[3], scalar)}
        return case | shape[pair]()
    if pair != "cube_cube":
        return case | spheres(x[0:3], x[3], x[4:7], x[7], x[8], x[9], scalar)
    gap = [max(x[i] - x[9 + i], x[6 + i] - x[3 + i]) for i in range(3)]  # max(min1 - max2, min2 - max1)
    return case | {"expect.hit": max(gap) <= x[12]} | {f"exact.gap[{i}]": exactly(gap[i]) for i in range(3)}


def differences(where, right, found):
    pairs = [(x, *(spelt(side[x]) if x in side else "nothing" for side in (right, found))) for x in {**right, **found}]
    return [f"{where}: {x}: expected {expected}, got {got}" for x, expected, got in pairs if expected != got]


def check(path):
    """What is wrong in a dataset, and what a manifest should say of it."""
    data, wrong, asked, flags, hits = path.read_bytes(), [], {}, [], 0
    for at, raw in enumerate(data.split(b"\n")[:-1] if data.endswith(b"\n") else [b"no line feed at the end"], 1):
        try:
            line = json.loads(text := raw.decode(), parse_int=Written, parse_float=Written, parse_constant=Written)
            found = leaves(line)
            if at > 1:
                right = right_case(found, header["pair"], header["scalar"])
            else:
                header = {x: line[x] for x in ("pair", "scalar", "family", "seed", "count", "generator")}
                header |= {"seed": int(line["seed"]), "count": data.count(b"\n") - 1}
                right = {"format": "contact-oracle/dataset", "version": 1, **header, "points": "nearest_surface"}
                right |= {x: int(n) for x, n in found.items() if x.startswith("shard[")}
        except (KeyError, RecursionError, TypeError, ValueError) as problem:
            raise ValueError(f"{path}:{at}: not readable: {problem!r}")
        flags += [leaf for x, leaf in found.items() if x.startswith("flags[")]
        hits += right.get("expect.hit", False)
        canonical = json.dumps(line, separators=(",", ":"), ensure_ascii=False).replace('"', "") == text.replace('"', "")
        found["form"] = "canonical" if canonical and list(right) == list(found) else "other keys, order or spaces"
        found |= {"first asked on line": asked.setdefault(right.get("id"), at), "invalid": at > 1 and header["family"] == "invalid"}
        right |= {"form": "canonical", "first asked on line": at, "invalid": "expect.rejected" in right}
        wrong += differences(f"{path}:{at}", right, found)
    return wrong, {**header, "hits": hits, "flags": {x: flags.count(x) for x in {*flags}}, "sha256": hashlib.sha256(data).hexdigest()}


def main(arguments):
    cases, wrong, untold = 0, [], dict.fromkeys(("origin", "closest", "kills", "digests"))  # what a file does not tell of itself
    for top in map(Path, arguments):
        entries, manifest = {}, top / "manifest.json"
        for path in sorted(x for x in top.rglob("*.jsonl") if b"/results" not in x.read_bytes()[:40]) if top.is_dir() else [top]:
            complaints, entry = check(path)
            wrong += complaints[:20] + [f"{path}: and {len(complaints) - 20} more"] * (len(complaints) > 20)
            cases += entry["count"]
            entries |= {(name := path.relative_to(top).as_posix()): {"path": name, **entry}}
        listed = {entry["path"]: entry for entry in json.loads(manifest.read_text())["files"]} if manifest.exists() else entries
        for name in {**entries, **listed}:
            wrong += differences(f"{manifest}: {name}", *(leaves({**all.get(name, {}), **untold}) for all in (entries, listed)))
    print(*wrong, f"{cases} cases: " + (f"{len(wrong)} complaints" if wrong else "all right" if cases else "nothing"), sep="\n")
    return 1 if wrong else 0 if cases else 2


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except (OSError, ValueError, KeyError) as problem:
        sys.exit(print(problem, file=sys.stderr) or 2)
