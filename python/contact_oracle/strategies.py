"""Hypothesis strategies: numbers, shapes and whole questions, all of them built from floats and integers, so that they shrink.

Touching questions are made by integers: from a Pythagorean quadruple the distance is a whole number, and plain arithmetic makes no
mistake. What a counterexample shows is then a wrong decision, not a rounding.
"""
from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from hypothesis import strategies as st
from hypothesis.strategies import SearchStrategy

from .datasets import family_named, generate
from .errors import InputError
from .pairs import PAIRS, Array, number_of, pair_named, scalar_named
from .shapes import SHAPES, Capsule, Cube, Hull, Line, Obb, Plane, Point, Question, Ray, Sphere, Triangle

LARGEST = 1e4
LARGEST_SHARE = 64
SCALES = 40
MOST_VERTICES = 12


def numbers(scalar: str = "binary64", largest: float | None = LARGEST, smallest: float = 0.0) -> SearchStrategy[float]:
    """Finite numbers of the scalar: 0, and magnitudes from `smallest` to `largest`, or of every size where that is None."""
    width = 32 if scalar_named(scalar) == "binary32" else 64
    bound = _bound(largest, smallest, width)
    return _without_small(st.floats(None if bound is None else -bound, bound, allow_nan=False, allow_infinity=False, width=width), smallest)


def lengths(scalar: str = "binary64", largest: float | None = LARGEST, smallest: float = 0.0) -> SearchStrategy[float]:
    """The same without a sign."""
    width = 32 if scalar_named(scalar) == "binary32" else 64
    bound = _bound(largest, smallest, width)
    return _without_small(st.floats(0, bound, allow_nan=False, allow_infinity=False, width=width), smallest)


def _without_small(drawn: SearchStrategy[float], smallest: float) -> SearchStrategy[float]:
    return drawn if smallest == 0 else drawn.map(_ZeroBelow(smallest))


@dataclass(frozen=True)
class _ZeroBelow:
    """0 in the place of small numbers: a filter would refuse most of what Hypothesis likes to draw.

    An object and no lambda, whose source Hypothesis would look up at every draw.
    """

    smallest: float

    def __call__(self, x: float) -> float:
        return x if abs(x) >= self.smallest else 0.0


def _bound(largest: float | None, smallest: float, width: int) -> float | None:
    """The largest number of the format that is no larger."""
    # Of what these refuse nothing would be left but 0, of which most laws hold.
    if not 0 <= smallest < np.inf:
        raise InputError("must be a finite number from 0", "smallest", value=smallest)
    if largest is not None and not largest >= smallest:
        raise InputError(f"must not be less than smallest, {smallest}", "largest", value=largest)
    if width == 64 or largest is None:
        return largest if largest is None else float(largest)
    with np.errstate(over="ignore"):
        near = np.float32(largest)
    return float(near if float(near) <= largest else np.nextafter(near, np.float32(0)))


def points(scalar: str = "binary64", largest: float | None = LARGEST, smallest: float = 0.0) -> SearchStrategy[Point]:
    """Triples of `numbers`."""
    number = numbers(scalar, largest, smallest)
    return st.tuples(number, number, number)


def directions(scalar: str = "binary64", largest: float | None = LARGEST, smallest: float = 0.0) -> SearchStrategy[Point]:
    """Triples of `numbers` that are not zero."""
    return points(scalar, largest, smallest).filter(any)


def spheres(scalar: str = "binary64", largest: float | None = LARGEST, smallest: float = 0.0) -> SearchStrategy[Sphere]:
    return st.builds(Sphere, center=points(scalar, largest, smallest), radius=lengths(scalar, largest, smallest))


def _ordered(p: Point, q: Point) -> Cube:
    (x, y, z), (far_x, far_y, far_z) = zip(*(sorted(pair) for pair in zip(p, q)))
    return Cube((x, y, z), (far_x, far_y, far_z))


def cubes(scalar: str = "binary64", largest: float | None = LARGEST, smallest: float = 0.0) -> SearchStrategy[Cube]:
    return st.builds(_ordered, points(scalar, largest, smallest), points(scalar, largest, smallest))


def capsules(scalar: str = "binary64", largest: float | None = LARGEST, smallest: float = 0.0) -> SearchStrategy[Capsule]:
    point = points(scalar, largest, smallest)
    return st.builds(Capsule, start=point, end=point, radius=lengths(scalar, largest, smallest))


def triangles(scalar: str = "binary64", largest: float | None = LARGEST, smallest: float = 0.0) -> SearchStrategy[Triangle]:
    point = points(scalar, largest, smallest)
    return st.builds(Triangle, vertices=st.tuples(point, point, point))


def planes(scalar: str = "binary64", largest: float | None = LARGEST, smallest: float = 0.0) -> SearchStrategy[Plane]:
    return st.builds(Plane, normal=directions(scalar, largest, smallest), offset=numbers(scalar, largest, smallest))


def rays(scalar: str = "binary64", largest: float | None = LARGEST, smallest: float = 0.0) -> SearchStrategy[Ray]:
    return st.builds(Ray, origin=points(scalar, largest, smallest), direction=directions(scalar, largest, smallest),
                     length=lengths(scalar, largest, smallest))


def lines(scalar: str = "binary64", largest: float | None = LARGEST, smallest: float = 0.0) -> SearchStrategy[Line]:
    return st.builds(Line, start=points(scalar, largest, smallest), end=points(scalar, largest, smallest))


def obbs(scalar: str = "binary64", largest: float | None = LARGEST, smallest: float = 0.0) -> SearchStrategy[Obb]:
    number, length = numbers(scalar, largest, smallest), lengths(scalar, largest, smallest)
    return st.builds(Obb, center=points(scalar, largest, smallest), orientation=st.tuples(number, number, number, number).filter(any),
                     extents=st.tuples(length, length, length))


def hulls(scalar: str = "binary64", largest: float | None = LARGEST, smallest: float = 0.0) -> SearchStrategy[Hull]:
    """Hulls of up to `MOST_VERTICES` points: every question is answered exactly, and more take longer."""
    return st.builds(Hull, vertices=st.lists(points(scalar, largest, smallest), min_size=1, max_size=MOST_VERTICES).map(tuple),
                     radius=lengths(scalar, largest, smallest))


OF_SHAPE = {"sphere": spheres, "cube": cubes, "capsule": capsules, "triangle": triangles, "plane": planes, "ray": rays, "line": lines, "obb": obbs,
            "hull": hulls}


def shapes(kind: str, scalar: str = "binary64", largest: float | None = LARGEST, smallest: float = 0.0) -> SearchStrategy[Any]:
    """Shapes by the name of their kind."""
    if kind not in OF_SHAPE:
        raise InputError(f"must be one of {', '.join(OF_SHAPE)}", "kind", value=repr(kind))
    return OF_SHAPE[kind](scalar, largest, smallest)


def pairs() -> SearchStrategy[str]:
    """Names of pairs."""
    return st.sampled_from(tuple(PAIRS))


def questions(pair: str | None = None, scalar: str = "binary64", largest: float | None = LARGEST, smallest: float = 0.0) -> SearchStrategy[Question]:
    """Questions of a pair, or of any."""
    if pair is None:
        return pairs().flatmap(lambda name: questions(name, scalar, largest, smallest))
    a, b = (shapes(kind, scalar, largest, smallest) for kind in pair_named(pair).shapes)
    length = lengths(scalar, largest, smallest)
    return st.builds(Question, pair=st.just(pair), a=a, b=b, alarm=st.just(0.0) | length, contact=st.just(0.0) | length, scalar=st.just(scalar))


def family(pair: str, name: str, scalar: str = "binary64", seed: int = 0) -> SearchStrategy[Question]:
    """Questions of a family of the generator. They shrink to its first one alone; `questions` and `touching` shrink to simple numbers."""
    family_named(pair, name)
    return st.builds(_of_family, st.just(pair), st.just(name), st.just(scalar), st.just(seed), st.integers(0, 2**20))


def _of_family(pair: str, name: str, scalar: str, seed: int, index: int) -> Question:
    return next(iter(generate(pair, name, 1, seed, scalar, first=index)))


def _quadruple(m: int, n: int, p: int, q: int) -> tuple[Array, int]:
    """A vector of whole numbers and its length, which is one too: m, n, p, q are the parts of a quaternion, which turns and stretches x."""
    return np.array([m * m + n * n - p * p - q * q, 2 * (m * q + n * p), 2 * (n * q - m * p)]), m * m + n * n + p * p + q * q


def _beside(delta: Array, which: int) -> tuple[Array, Array]:
    """Two vectors of whole numbers that are perpendicular to delta; along different lines."""
    axes = [np.cross(delta, axis) for axis in np.eye(3, dtype=int)]
    across = [axis for axis in axes if axis.any()]
    u = across[which % len(across)]
    return u, np.cross(delta, u)


def _point(vector: Any, scale: float) -> Point:
    x, y, z = (float(part) * scale for part in vector)
    return (x, y, z)


def _box_beside(q: Array, delta: Array, sizes: tuple[int, int]) -> tuple[Array, Array]:
    """A box whose nearest point to q - delta is q: it begins at q where delta has a component, and is around q elsewhere."""
    low = np.where(delta > 0, q, q - sizes[0])
    high = np.where(delta < 0, q, q + sizes[1])
    return low, high


def _touching(pair: str, scalar: str, parts: tuple[int, int, int, int], origin: tuple[int, int, int], share: tuple[int, int],
              sizes: tuple[int, int], which: int, exponent: int, contact: int, steps: int) -> Question:
    """Two cores that are a whole number apart, around the points `p` and `q`; radii and alarm distance share it."""
    delta, distance = _quadruple(*parts)
    scale = 2.0**exponent
    p = np.array(origin)
    q = p + delta
    u, v = _beside(delta, which)
    first, second = pair_named(pair).shapes
    kinds = [kind in ("sphere", "capsule", "hull") for kind in (first, second)]
    # What is shared among the radii that there are; the alarm distance takes the rest.
    radii = [min(part, distance) * kind for part, kind in zip(share, kinds)]
    if sum(radii) > distance:
        radii[1] = distance - radii[0]
    alarm = distance - sum(radii)

    def core(kind: str, at: Array, along: Array, radius: int, towards: Array) -> Any:
        before, after = at - sizes[0] * along, at + sizes[1] * along
        if kind == "sphere":
            return Sphere(_point(at, scale), radius * scale)
        if kind == "capsule":
            if second == "plane":
                # The end at `at` is the lower one, or both are as low.
                return Capsule(_point(at, scale), _point(at - sizes[0] * delta + sizes[1] * along, scale), radius * scale)
            return Capsule(_point(before, scale), _point(after, scale), radius * scale)
        if kind == "ray":
            return Ray(_point(before, scale), _point(along, scale), float(sum(sizes)))
        if kind == "triangle":
            return Triangle((_point(at - u - v, scale), _point(at + (1 + sizes[0]) * u, scale), _point(at + (1 + sizes[1]) * v, scale)))
        if kind == "plane":
            return Plane(_point(-delta, 1.0), float(-delta @ at) * scale)
        if kind == "hull":
            # A pyramid on a triangle around `at`, or flat; the first corner stands there again inside.
            corners = (at - u - v, at + (1 + sizes[0]) * u, at + (1 + sizes[1]) * v, at + sizes[0] * towards, at)
            return Hull(tuple(_point(corner, scale) for corner in corners), radius * scale)
        if kind == "obb":
            # Its first axis is turned along delta, so `at` is the middle of a face; the axis is as long as a whole number.
            m, x, y, z = map(float, parts)
            return Obb(_point(at + sizes[0] * towards, scale), (x, y, z, m),
                       _point((sizes[0] * distance, sizes[1], sizes[0]), scale))
        low, high = _box_beside(at, towards, sizes)
        return Cube(_point(low, scale), _point(high, scale))

    a, b = core(first, p, u, radii[0], -delta), core(second, q, v, radii[1], delta)
    return _stepped(Question(pair, a, b, alarm * scale, contact * scale, scalar), steps)


def _touching_boxes(scalar: str, origin: tuple[int, int, int], sizes: tuple[int, int], other: tuple[int, int, int], which: int, alarm: int,
                    exponent: int, steps: int) -> Question:
    """Two boxes that are the alarm distance apart on one axis and overlap on the others."""
    scale = 2.0**exponent
    low = np.array(origin)
    first = (low, low + 1 + sizes[0])
    begin = low - np.minimum(1 + sizes[1], np.array(other))
    begin[which % 3] = first[1][which % 3] + alarm
    return _stepped(Question("cube_cube", Cube(_point(first[0], scale), _point(first[1], scale)),
                             Cube(_point(begin, scale), _point(begin + 1 + sizes[1], scale)), alarm * scale, 0.0, scalar), steps)


def _touching_crossing(pair: str, scalar: str, origin: tuple[int, int, int], edges: tuple[tuple[int, int, int], tuple[int, int, int]],
                       through: tuple[int, int, int], which: int, exponent: int) -> Question:
    """A segment that goes through a vertex, the middle of an edge, or ends on the face: 4 parts a unit keep every point whole."""
    scale = 2.0**exponent
    corner, u, v = 4 * np.array(origin), 4 * np.array(edges[0]), 4 * np.array(edges[1])
    normal = np.cross(u, v)
    # A triangle without an inside, and a segment along the plane, are crossed by nothing: the unit triangle stands in for them.
    if not normal.any():
        u, v = np.array([4, 0, 0]), np.array([0, 4, 0])
        normal = np.cross(u, v)
    way = np.array(through)
    if way @ normal == 0:
        way = normal // np.gcd.reduce(normal)
    place = (corner, corner + u // 2, corner + (u + v) // 2, corner + (u + v) // 4)[which % 4]
    inside = which % 4 == 3
    start, end = (place, place + way) if inside else (place - way, place + way)
    triangle = Triangle((_point(corner, scale), _point(corner + u, scale), _point(corner + v, scale)))
    if pair == "triangle_line":
        return Question(pair, triangle, Line(_point(start, scale), _point(end, scale)), 0.0, 0.0, scalar)
    return Question(pair, Ray(_point(start, scale), _point(way, scale), 1.0 if inside else 2.0), triangle, 0.0, 0.0, scalar)


def _touching_cast(pair: str, scalar: str, origin: tuple[int, int, int], parts: tuple[int, int, int, int], which: int, length: int,
                   exponent: int) -> Question:
    """A ray that ends on a shape, at right angles to its surface; every second one is a tangent instead, or goes along a face."""
    scale = 2.0**exponent
    delta, radius = _quadruple(*parts)
    u, v = _beside(delta, which)
    # The shape is on the far side of the point, seen along delta; the ray comes from there, or goes by.
    at = np.array(origin) + delta
    way = u if which % 2 and pair != "cast_plane" else -delta
    ray = Ray(_point(at - length * way, scale), _point(way, scale), float(length))
    kind = pair_named(pair).shapes[1]
    if kind == "sphere":
        return Question(pair, ray, Sphere(_point(origin, scale), radius * scale), 0.0, 0.0, scalar)
    if kind == "capsule":
        return Question(pair, ray, Capsule(_point(origin, scale), _point(np.array(origin) + u, scale), radius * scale), 0.0, 0.0, scalar)
    if kind == "plane":
        return Question(pair, ray, Plane(_point(delta, 1.0), float(delta @ at) * scale), 0.0, 0.0, scalar)
    if kind == "triangle":
        return Question(pair, ray, Triangle((_point(at - u, scale), _point(at + u, scale), _point(at + v, scale))), 0.0, 0.0, scalar)
    low, high = _box_beside(at, -delta, (1, 1))
    # Along a face, which has a normal of its own.
    if which % 2:
        axis = int(np.flatnonzero(delta)[0])
        along = np.eye(3, dtype=int)[(axis + 1) % 3]
        ray = Ray(_point(at - length * along, scale), _point(along, scale), float(length))
    return Question(pair, ray, Cube(_point(low, scale), _point(high, scale)), 0.0, 0.0, scalar)


def _stepped(question: Question, steps: int) -> Question:
    """The question with one length some numbers larger or smaller: no longer touching, by as little as there is."""
    if steps == 0:
        return question
    number = number_of(question.scalar)

    def step(length: float) -> float:
        stepped = number(length)
        for _ in range(abs(steps)):
            stepped = np.nextafter(stepped, number(np.inf if steps > 0 else 0))
        return float(stepped)

    for name, shape in (("a", question.a), ("b", question.b)):
        if isinstance(shape, (Sphere, Capsule, Hull)) and shape.radius > 0:
            changed = replace(shape, radius=step(shape.radius))
            return replace(question, a=changed) if name == "a" else replace(question, b=changed)
    return replace(question, alarm=step(question.alarm))


def touching(pair: str, scalar: str = "binary64", *, steps: SearchStrategy[int] | None = None, scales: int = SCALES) -> SearchStrategy[Question]:
    """Questions exactly at the edge of their decision: touching, at the alarm distance, or through a boundary. All are hits.

    Small whole numbers times one power of two, up to 2^scales and down to 2^-scales: exact in either scalar, and so are the differences and
    squares of an engine.
    """
    scalar_named(scalar)
    description = pair_named(pair)
    step = st.just(0) if steps is None else steps
    # Twenty-four bits hold the numbers of binary32: parts up to 4 keep products of three of them below that.
    small = st.integers(-3, 3)
    origin = st.tuples(small, small, small)
    size = st.integers(0, 2)
    exponent = st.integers(-scales, scales)
    sizes = st.tuples(size, size)
    which = st.integers(0, 5)
    if description.numbers == "none":
        others = st.tuples(size, size, size)
        return st.builds(_touching_boxes, st.just(scalar), origin, sizes, others, which, st.integers(0, LARGEST_SHARE), exponent, step)
    if description.numbers == "crossing":
        return st.builds(_touching_crossing, st.just(pair), st.just(scalar), origin, st.tuples(origin, origin), origin, which, exponent)
    part = st.integers(-2, 2)
    parts = st.tuples(part, part, part, part).filter(any)
    if description.numbers == "cast":
        return st.builds(_touching_cast, st.just(pair), st.just(scalar), origin, parts, which, st.integers(1, 4), exponent)
    share = st.integers(0, LARGEST_SHARE)
    return st.builds(_touching, st.just(pair), st.just(scalar), parts, origin, st.tuples(share, share), sizes, which, exponent, size, step)


def near_touching(pair: str, scalar: str = "binary64", largest_step: int = 4, *, scales: int = SCALES) -> SearchStrategy[Question]:
    """Touching questions with one length up to `largest_step` numbers away, and those that are exactly touching."""
    if not pair_named(pair).has_edge:
        raise InputError("has no length that decides", "pair", value=repr(pair))
    return touching(pair, scalar, steps=st.integers(-largest_step, largest_step), scales=scales)


def _register() -> None:
    """What Hypothesis calls by the entry point ``hypothesis``: the shapes and questions by their types."""
    for kind, shape in SHAPES.items():
        st.register_type_strategy(shape, OF_SHAPE[kind]())
    st.register_type_strategy(Question, questions())
