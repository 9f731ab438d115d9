"""Laws for Hypothesis: statements that the answers of every right engine obey.

    @given(strategies.questions("sphere_sphere"))
    def test_swapped_spheres(question):
        laws.swap(my_engine, question)

Each takes an engine, as `certify` does, and a question. It raises an AssertionError with a line for ``explain`` where the law is
violated, and asks Hypothesis for another question where this one does not suit it. Numbers may differ by `ulps` ulps of their scale
for each of the answers that are compared; with ``ulps=0`` they must have the same bits, and hits are compared however near they are to
their edge. With a `tolerance`, a dict as `certify` takes it, that holds in the place of `ulps`: whatever it allows each answer to be, it
allows here, and `conventions` say what the answers mean. `LAWS` is the list of all, with the questions that each is asked; `check` asks them. The command knows more laws:
docs/properties.md.
"""
from __future__ import annotations

import itertools
import json
import math
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, fields, replace
from fractions import Fraction
from typing import Any

import hypothesis
import numpy as np
from hypothesis import assume
from hypothesis import strategies as st

from . import _core, strategies
from .engines import CLAIMS, Engine, answers_of, by_pair, points_of
from .errors import errors_of_core
from .pairs import number_of, pair_named, rows_of_rotation
from .serving import lines_of
from .shapes import Capsule, Cube, Hull, Obb, Plane, Question, Ray, Sphere, Triangle

ULPS = 8.0
# An engine may decide by squares, which doubles a relative error twice: docs/properties.md#what-is-fair.
MARGIN = 4.0
VECTORS = ("normal", "point1", "point2", "point")
# Numbers whose squares neither overflow nor underflow in either scalar: what a law asks of an engine that declares no scale.
SMALLEST, LARGEST = 1e-4, 1e4
SCALES = 6
# What an engine states in the words of `certify`.
Stated = Mapping[str, Any] | None
# What `scale` scales by at most: a question must be one that the engine serves afterwards too.
LARGEST_EXPONENT = 8


class Answer:
    """What an engine says of one question: numbers under their names, where it says a hit."""

    def __init__(self, engine: Engine, question: Question) -> None:
        self.question = question
        said = by_pair(engine)[0](question.as_questions())
        if said is None:
            raise AssertionError(f"no answer\n  question 1  {question}")
        self._arrays = answers_of(said, 1, question.scalar)
        if self._arrays.get("unsupported", [False])[0]:
            raise AssertionError(f"no answer\n  question 1  {question}")
        decision = next((name for name in ("hit", "overlap", "contact") if name in self._arrays), None)
        if decision is None:
            raise AssertionError(f"an answer without a decision\n  question 1  {question}")
        self.hit = bool(self._arrays[decision][0])
        self.numbers = {name: self._arrays[name][0] for name in (*VECTORS, "value") if name in self._arrays} if self.hit else {}

    def __str__(self) -> str:
        return json.dumps(lines_of(self._arrays)[0], separators=(",", ":"))

    def is_within(self, held: Held, left_out: Collection[str] = ()) -> bool:
        """Whether the tolerance allows this answer but for some numbers, by the judge that golden cases are judged by."""
        line = str(self)
        claims = [name for name in ("overlap", "contact") if name in json.loads(line)] + \
            [name for name in CLAIMS if name in self._arrays and name not in left_out]
        conventions = {**points_of(claims), **(held.conventions or {})}
        declared = {"engine": {"name": "", "version": ""}, "pairs": [self.question.pair], "scalar": self.question.scalar,
                    "conventions": conventions, "claims": claims, "tolerance": held.tolerance}
        with errors_of_core():
            return _core.is_within(json.dumps(declared), str(self.question), line)


@dataclass(frozen=True)
class Held:
    """What answers are held to: a bound in ulps, or a tolerance in its place; and what they mean."""

    ulps: float
    tolerance: Mapping[str, Any] | None = None
    conventions: Mapping[str, Any] | None = None

    def exactly(self) -> Held:
        """Held to the same bits, where no tolerance says otherwise."""
        return replace(self, ulps=0.0)

    def rounded(self) -> Held:
        """The same of numbers that are rounded once more, so that no ulps are one."""
        return replace(self, ulps=max(self.ulps, 1.0))

    def length(self, scale: float) -> float:
        """How far the tolerance allows a length to be off."""
        allowed = self.tolerance or {}
        return float(allowed.get("length", 0.0)) + float(allowed.get("relative", 0.0)) * scale

    def apart(self, name: str, scale: float, scalar: str) -> float:
        """How far two answers may be from each other, in each component."""
        if self.tolerance is None:
            return 2 * self.ulps * _ulp(scale, scalar)
        if name != "normal":
            return 2 * self.length(scale)
        # Each may be turned by the angle, and be longer or shorter by as much.
        angle = float(self.tolerance.get("angle", 0.0))
        return 2 * (2 + angle) * angle


# Whether an engine answers alike, and with numbers, is no question of a tolerance.
EXACTLY = Held(0.0)


def _violated(law: str, why: str, held: Held, *answers: Answer) -> None:
    """Raises, unless a tolerance allows every one of the answers, and with them whatever they have to do with each other."""
    if held.tolerance is not None and all(answer.is_within(held) for answer in answers):
        return
    lines = [f"{law}: {why}"]
    for at, answer in enumerate(answers, 1):
        expect = json.dumps(answer.question.exact().expect, separators=(",", ":"))
        lines += [f"  question {at}  {answer.question}", f"    expected  {expect}", f"    got       {answer}"]
    raise AssertionError("\n".join(lines))


def _is_in_scalar(question: Question) -> bool:
    number = number_of(question.scalar)
    with np.errstate(over="ignore"):
        return all(float(number(part)) == part and abs(part) != math.inf and (part == 0 or abs(part) >= np.finfo(number).tiny)
                   for part in _every_number(question))


def _every_number(question: Question) -> list[float]:
    def flat(value: Any) -> list[float]:
        return [part for entry in value for part in flat(entry)] if isinstance(value, tuple) else [float(value)]

    return [part for shape in (question.a, question.b) for field in fields(shape) for part in flat(getattr(shape, field.name))] + \
        [question.alarm, question.contact]


def _lengths(question: Question) -> list[float]:
    """Every number but those of quaternions, which may have any length."""
    upright = (0.0, 0.0, 0.0, 0.0)
    a, b = (replace(shape, orientation=upright) if isinstance(shape, Obb) else shape for shape in (question.a, question.b))
    return [abs(part) for part in _every_number(replace(question, a=a, b=b))]


def _is_clear(question: Question, held: Held) -> bool:
    """Whether a right engine held to this must decide as the exact numbers do. In ulps crossings and casts have no margin, so none is clear but to the
    bit; of a tolerance the judge says so."""
    if held.tolerance is None and held.ulps == 0:
        return True
    exact = question.exact()
    if exact.gap is not None:
        margin, reach = _nearest(max(exact.gap) - Fraction(question.alarm)), question.alarm
    elif exact.distance2 is not None:
        margin, reach = float(exact.margin(17)), _nearest(exact.reach or Fraction(0))
    else:
        return held.tolerance is not None
    if held.tolerance is not None:
        return abs(margin) > held.length(reach)
    return abs(margin) > MARGIN * held.ulps * _ulp(_scale("value", question), question.scalar)


def _scale(name: str, question: Question) -> float:
    """The length whose ulp measures an error: docs/specification.md#scales-and-ulps. No smaller than it, so no law is too strict."""
    if name == "normal":
        return 1.0
    lengths = _lengths(question)
    if isinstance(question.b, Plane):
        lengths.append(abs(question.b.offset) / math.hypot(*question.b.normal))
    if isinstance(question.a, Ray):
        lengths.append(question.a.length * math.hypot(*question.a.direction))
    if name == "value" and pair_named(question.pair).numbers == "cast":
        return 4.0 * max(float(question.a.length), max(lengths) / max(math.fabs(x) for x in question.a.direction))
    return 4.0 * max(lengths)


def _ulp(scale: float, scalar: str) -> float:
    number = number_of(scalar)
    largest = np.finfo(number).max
    # Beyond it there are no ulps: those of the largest number stand in for them.
    return float(np.spacing(number(scale)) if scale < float(largest) else largest - np.nextafter(largest, number(0)))


def _same(law: str, name: str, one: Any, other: Any, held: Held, scale: float, *answers: Answer) -> None:
    one, other = np.asarray(one, float), np.asarray(other, float)
    with np.errstate(over="ignore", invalid="ignore"):
        near = np.abs(one - other) <= held.apart(name, scale, answers[0].question.scalar)
    same = (one == other) | (np.isnan(one) & np.isnan(other)) | near
    if not same.all():
        _violated(law, f"{name} is {one.tolist()}, and {other.tolist()}", held, *answers)


def _same_hit(law: str, one: Answer, other: Answer, held: Held) -> None:
    if one.hit != other.hit and _is_clear(one.question, held) and _is_clear(other.question, held):
        _violated(law, f"{'a hit' if one.hit else 'a miss'}, and {'a hit' if other.hit else 'a miss'}", held, one, other)


def _agreed(question: Question) -> set[str]:
    """The numbers that are an agreement: a direction where cores meet, and points where many are nearest. Where a ray hits, more than one
    normal may be right; and where cores overlap, or by rounding may seem to: the depth is right for each."""
    if pair_named(question.pair).numbers == "cast":
        return {"normal"}
    exact = question.exact()
    if exact.degenerate or exact.depth2 is not None:
        return set(VECTORS)
    return set() if exact.unique else {"point1", "point2", "point"}


def _compare(law: str, engine: Engine, question: Question, changed: Question, held: Held, back: Callable[[str, Any], Any]) -> None:
    """Both answers are the same once `back` has undone the change of the question."""
    one, other = Answer(engine, question), Answer(engine, changed)
    _same_hit(law, one, other, held)
    for name in sorted(one.numbers.keys() & other.numbers.keys() - _agreed(question)):
        with np.errstate(over="ignore"):  # right answers are infinite too
            undone = back(name, other.numbers[name])
        _same(law, name, one.numbers[name], undone, held, _scale(name, question), one, other)


def decision(engine: Engine, question: Question, *, ulps: float = 0.0, tolerance: Stated = None, conventions: Stated = None) -> None:
    """Every hit and every miss is the exact decision; with `ulps` those near the edge are left out."""
    to = Held(ulps, tolerance, conventions)
    answer, exact = Answer(engine, question), question.exact()
    if _is_clear(question, to) and answer.hit != exact.hit:
        _violated("decision", f"{'a hit' if exact.hit else 'a miss'} is right", to, answer)


def bounds(engine: Engine, question: Question, *, ulps: float = ULPS, tolerance: Stated = None, conventions: Stated = None) -> None:
    """Every number of a hit is the right one, to `ulps` of its scale; those that are an agreement are left out."""
    to = Held(ulps, tolerance, conventions)
    exact = question.exact()
    assume(exact.hit)
    answer = Answer(engine, question)
    if to.tolerance is not None:
        if answer.hit and not answer.is_within(to, _agreed(question)):
            _violated("bounds", "a number is beyond the tolerance", EXACTLY, answer)
        return
    for name in sorted(answer.numbers.keys() & exact.expect.keys() - _agreed(question)):
        right = np.array([float(part) for part in np.ravel(exact.expect[name])]).reshape(np.shape(answer.numbers[name]))
        _same("bounds", name, answer.numbers[name], right, Held(ulps / 2), _scale(name, question), answer)


def repeatable(engine: Engine, question: Question) -> None:
    """The same question gets the same bits again."""
    one, other = Answer(engine, question), Answer(engine, question)
    if one.hit != other.hit:
        _violated("repeatable", "another decision", EXACTLY, one, other)
    for name, number in one.numbers.items():
        _same("repeatable", name, number, other.numbers[name], EXACTLY, 1, one, other)


def swap(engine: Engine, question: Question, *, ulps: float = ULPS, tolerance: Stated = None, conventions: Stated = None) -> None:
    """Two shapes of one kind that change places: same hit and value, the normal turned round, the points exchanged."""
    assume(_has_two_alike(question.pair))
    one, other = Answer(engine, question), Answer(engine, replace(question, a=question.b, b=question.a))
    to = Held(ulps, tolerance, conventions)
    _same_hit("swap", one, other, to)
    partner = {"point1": "point2", "point2": "point1"}
    for name in sorted(one.numbers.keys() - _agreed(question)):
        found = other.numbers.get(partner.get(name, name))
        if found is not None:
            _same("swap", name, one.numbers[name], -found if name == "normal" else found, to, _scale(name, question), one, other)


def _has_two_alike(pair: str) -> bool:
    # A sphere and a rigid sphere are one shape with two names.
    return len(set(pair_named(pair).shapes)) == 1 and pair != "sphere_rigid_sphere"


def _of_lengths(shape: Any, change: Callable[[float], float]) -> Any:
    """The shape with every length changed. A ray's length counts directions, and a plane's offset normals, so one of the two is left; and so is
    an orientation, which has none."""
    def changed(value: Any) -> Any:
        return tuple(map(changed, value)) if isinstance(value, tuple) else change(value)

    left = {Ray: "length", Plane: "normal", Obb: "orientation"}.get(type(shape), "")
    return replace(shape, **{field.name: changed(getattr(shape, field.name)) for field in fields(shape) if field.name != left})


def scale(engine: Engine, question: Question, exponent: int = 1, *, ulps: float = ULPS, tolerance: Stated = None, conventions: Stated = None) -> None:
    """A power of two scales points and value, and changes nothing else: a cast's value counts directions, which are scaled too."""
    factor = 2.0**exponent
    counts_directions = pair_named(question.pair).numbers == "cast"
    scaled = replace(question, a=_of_lengths(question.a, lambda x: x * factor), b=_of_lengths(question.b, lambda x: x * factor),
                     alarm=question.alarm * factor, contact=question.contact * factor)
    assume(_is_in_scalar(question) and _is_in_scalar(scaled))
    _compare("scale", engine, question, scaled, Held(ulps, tolerance, conventions),
             lambda name, number: number if name == "normal" or (name == "value" and counts_directions) else number / factor)


def _moved(shape: Any, by: tuple[float, float, float]) -> Any:
    def step(x: float, d: float) -> float:
        there = x + d
        assume(math.isfinite(there) and Fraction(there) == Fraction(x) + Fraction(d))
        return there

    def moved(value: Any) -> Any:
        return tuple(map(moved, value)) if isinstance(value[0], tuple) else tuple(map(step, value, by))

    names = {"Sphere": ("center",), "Cube": ("min", "max"), "Capsule": ("start", "end"), "Triangle": ("vertices",), "Ray": ("origin",),
             "Line": ("start", "end"), "Obb": ("center",), "Hull": ("vertices",)}[type(shape).__name__]
    return replace(shape, **{name: moved(getattr(shape, name)) for name in names})


def translate(engine: Engine, question: Question, by: tuple[float, float, float] = (1.0, 0.0, 0.0), *, ulps: float = ULPS, tolerance: Stated = None, conventions: Stated = None) -> None:
    """A translation leaves hit, value and normal, and moves the points along. Planes, and translations that would round, do not suit it."""
    assume(not isinstance(question.b, Plane))
    there = replace(question, a=_moved(question.a, by), b=_moved(question.b, by))
    assume(_is_in_scalar(question) and _is_in_scalar(there))
    one, other = Answer(engine, question), Answer(engine, there)
    to = Held(ulps, tolerance, conventions)
    _same_hit("translate", one, other, to)
    for name in sorted(one.numbers.keys() & other.numbers.keys() - _agreed(question)):
        length = max(_scale(name, question), _scale(name, there))
        if name in ("normal", "value"):
            _same("translate", name, one.numbers[name], other.numbers[name], to, length, one, other)
        else:
            # The moved points are rounded elsewhere, so they agree to an ulp of their scale at best.
            moved = np.asarray(one.numbers[name], float) + np.array(by)
            _same("translate", name, moved, other.numbers[name], to.rounded(), length, one, other)


def turn(engine: Engine, question: Question, axes: tuple[int, int, int] = (1, 2, 0), signs: tuple[int, int, int] = (1, 1, 1), *, ulps: float = ULPS, tolerance: Stated = None, conventions: Stated = None) -> None:
    """Axes permuted and reflected permute and reflect the answer. A crossing's normal goes by the order of vertices: it is left out."""
    def turned(value: tuple[float, ...]) -> tuple[float, ...]:
        return tuple(value[axis] * sign for axis, sign in zip(axes, signs))

    mirrors = math.prod(signs) * (1 if axes in ((0, 1, 2), (1, 2, 0), (2, 0, 1)) else -1)

    def box_turned(box: Obb) -> Obb:
        """The box about axes that change places with those of space, so that its quaternion does so too, and nothing is rounded."""
        x, y, z = (part * mirrors for part in turned(box.orientation[:3]))
        center_x, center_y, center_z = turned(box.center)
        along_x, along_y, along_z = (abs(part) for part in turned(box.extents))
        return Obb((center_x, center_y, center_z), (x, y, z, box.orientation[3]), (along_x, along_y, along_z))

    def shape_turned(shape: Any) -> Any:
        if isinstance(shape, Obb):
            return box_turned(shape)
        changed = {field.name: getattr(shape, field.name) for field in fields(shape)}
        for name, value in changed.items():
            if isinstance(value, tuple):
                changed[name] = tuple(map(turned, value)) if isinstance(value[0], tuple) else turned(value)
        if "min" in changed:
            low, high = changed["min"], changed["max"]
            changed = {"min": tuple(map(min, low, high)), "max": tuple(map(max, low, high))}
        return type(shape)(**changed)

    def back(name: str, number: Any) -> Any:
        if name == "value":
            return number
        found = np.empty(3, np.asarray(number).dtype)
        for at, (axis, sign) in enumerate(zip(axes, signs)):
            found[axis] = number[at] * sign
        return found

    changed = replace(question, a=shape_turned(question.a), b=shape_turned(question.b))
    crossing = pair_named(question.pair).numbers == "crossing"
    wrapped = _without_normal(engine) if crossing else engine
    _compare("turn", wrapped, question, changed, Held(ulps, tolerance, conventions), back)


def _nearest(wanted: Fraction) -> float:
    """Infinite beyond the largest number."""
    try:
        return float(wanted)
    except OverflowError:
        return math.inf if wanted > 0 else -math.inf


def _exactly(wanted: Fraction) -> float:
    """A number that there is, or another question."""
    number = _nearest(wanted)
    assume(math.isfinite(number) and Fraction(number) == wanted)
    return number


def rotate(engine: Engine, question: Question, quaternion: tuple[int, int, int, int] = (0, 0, 1, 2), *, ulps: float = ULPS, tolerance: Stated = None, conventions: Stated = None) -> None:
    """A scene turned by a quaternion of small integers, and as many times as long as its squared length, is answered so. Boxes along the axes do not suit it."""
    assume(not isinstance(question.a, Cube) and not isinstance(question.b, Cube))
    x, y, z, w = quaternion
    size = x * x + y * y + z * z + w * w
    rows = rows_of_rotation(quaternion)

    def exact(vector: Any) -> list[Fraction]:
        return [sum((factor * Fraction(float(part)) for factor, part in zip(row, vector)), Fraction(0)) for row in rows]

    def turned(value: tuple[float, ...]) -> tuple[float, ...]:
        return tuple(map(_exactly, exact(value)))

    def further(q: tuple[float, ...]) -> tuple[float, ...]:
        a, b, c, d = map(Fraction, q)
        return tuple(map(_exactly, (w * a + x * d + y * c - z * b, w * b - x * c + y * d + z * a, w * c + x * b - y * a + z * d, w * d - x * a - y * b - z * c)))

    def shape_turned(shape: Any) -> Any:
        def of(name: str, value: Any) -> Any:
            if name == "orientation":
                return further(value)
            if name in ("radius", "offset", "length", "extents"):
                # A ray's length counts its direction; a plane's offset is a length times its normal's.
                times = 1 if name == "length" else size * size if name == "offset" else size
                return tuple(_exactly(times * Fraction(part)) for part in value) if isinstance(value, tuple) else _exactly(times * Fraction(value))
            return tuple(map(turned, value)) if isinstance(value[0], tuple) else turned(value)

        return type(shape)(**{field.name: of(field.name, getattr(shape, field.name)) for field in fields(shape)})

    changed = replace(question, a=shape_turned(question.a), b=shape_turned(question.b), alarm=_exactly(size * Fraction(question.alarm)),
                      contact=_exactly(size * Fraction(question.contact)))
    assume(_is_in_scalar(question) and _is_in_scalar(changed))
    one, other = Answer(engine, question), Answer(engine, changed)
    # A component of the turned answer has the errors of three.
    to = _held_by_both(ulps, tolerance, conventions)
    _same_hit("rotate", one, other, to)
    counts_directions = pair_named(question.pair).numbers == "cast"
    for name in sorted(one.numbers.keys() & other.numbers.keys() - _agreed(question)):
        number = one.numbers[name]
        assume(np.isfinite(number).all())
        if name == "value":
            wanted: Any = float(number) if counts_directions else float(number) * size
        else:
            wanted = [_nearest(part / size if name == "normal" else part) for part in exact(number)]
        _same("rotate", name, wanted, other.numbers[name], to, max(_scale(name, question), _scale(name, changed)), one, other)


def _held_by_both(ulps: float, tolerance: Stated, conventions: Stated) -> Held:
    """What two answers may be off together."""
    return replace(Held(2 * ulps, tolerance, conventions), ulps=max(2 * ulps, 2.0))


def _is_lost(law: str, what: str, to: Held, one: Answer, other: Answer) -> bool:
    """Whether the question that was made of an answer has no contact, so that there is no more to compare; violated where it must have one."""
    if not other.hit and _is_clear(other.question, to) and other.question.exact().hit:
        _violated(law, what, to, one, other)
    return not other.hit


def onto_point(engine: Engine, question: Question, *, ulps: float = ULPS, tolerance: Stated = None, conventions: Stated = None) -> None:
    """A sphere about the engine's own point of the other shape is as deep in it as its radius."""
    assume(isinstance(question.a, Sphere) and question.a.radius > 0 and pair_named(question.pair).numbers == "distance")
    one = Answer(engine, question)
    assume(one.hit and question.exact().hit and "point2" in one.numbers and np.isfinite(one.numbers["point2"]).all())
    derived = replace(question, a=replace(question.a, center=tuple(map(float, one.numbers["point2"]))))
    assume(_is_in_scalar(derived))
    other = Answer(engine, derived)
    to = _held_by_both(ulps, tolerance, conventions)
    if _is_lost("onto_point", "a hit, and a miss about its own point", to, one, other):
        return
    assume("value" in other.numbers)
    _same("onto_point", "value + contact", float(other.numbers["value"]) + derived.contact, -question.a.radius, to,
          max(_scale("value", question), _scale("value", derived)), one, other)


def cut_at_point(engine: Engine, question: Question, which: int = 2, corner: int = 0, *, ulps: float = ULPS, tolerance: Stated = None, conventions: Stated = None) -> None:
    """A capsule, a triangle or a box that is cut at the engine's own point, or a hull with it as one more vertex, has the same value."""
    exact = question.exact()
    assume(pair_named(question.pair).numbers == "distance" and exact.hit and not exact.degenerate and exact.distance2 and exact.depth2 is None)
    shape = question.a if which == 1 else question.b
    assume(isinstance(shape, (Capsule, Triangle, Cube, Hull)))
    one = Answer(engine, question)
    assume(one.hit and f"point{which}" in one.numbers and "value" in one.numbers)
    core = np.asarray(one.numbers[f"point{which}"], float)
    radius = getattr(shape, "radius", 0.0)
    if radius:
        assume("normal" in one.numbers)
        core = core - (radius if which == 1 else -radius) * np.asarray(one.numbers["normal"], float)
    assume(np.isfinite(core).all())
    x, y, z = (float(part) for part in core.astype(number_of(question.scalar)))
    place = (x, y, z)
    if isinstance(shape, Capsule):
        part: Any = replace(shape, **{("start", "end")[corner % 2]: place})
    elif isinstance(shape, Triangle):
        first, second, third = (place if at == corner % 3 else vertex for at, vertex in enumerate(shape.vertices))
        part = Triangle((first, second, third))
    elif isinstance(shape, Cube):
        kept = [(shape.min, shape.max)[corner >> axis & 1][axis] for axis in range(3)]
        low_x, low_y, low_z = (min(pair) for pair in zip(kept, place))
        high_x, high_y, high_z = (max(pair) for pair in zip(kept, place))
        part = Cube((low_x, low_y, low_z), (high_x, high_y, high_z))
    else:
        assume(len(shape.vertices) < 64)
        part = replace(shape, vertices=(*shape.vertices, place))
    derived = replace(question, a=part) if which == 1 else replace(question, b=part)
    assume(_is_in_scalar(derived))
    other = Answer(engine, derived)
    to = _held_by_both(ulps, tolerance, conventions)
    if _is_lost("cut_at_point", "a hit, and a miss of the part with its own point", to, one, other):
        return
    _same("cut_at_point", "value", one.numbers["value"], other.numbers["value"], to, _scale("value", question), one, other)


def _without_normal(engine: Engine) -> Engine:
    def asked(questions: Any) -> Any:
        said = answers_of(by_pair(engine)[0](questions), len(questions), questions.scalar)
        return {name: array for name, array in said.items() if name != "normal"}

    return asked


def unit_normal(engine: Engine, question: Question, *, ulps: float = ULPS, tolerance: Stated = None, conventions: Stated = None) -> None:
    """The normal has unit length."""
    answer = Answer(engine, question)
    assume("normal" in answer.numbers)
    to = Held(ulps, tolerance, conventions)
    normal = np.asarray(answer.numbers["normal"], float)
    most = 4 * max(ulps, 1) * _ulp(1.0, question.scalar) if tolerance is None else to.apart("normal", 1.0, question.scalar) / 2
    if not abs(float(normal @ normal) - 1) <= most:
        _violated("unit_normal", f"the normal is {normal.tolist()}", to, answer)


def finite(engine: Engine, question: Question) -> None:
    """Where the truth is finite, so is the answer."""
    expect = question.exact().expect
    answer = Answer(engine, question)
    for name, number in answer.numbers.items():
        right = np.array([float(part) for part in np.ravel(expect.get(name, 0.0))])
        if np.isfinite(right).all() and not np.isfinite(number).all():
            _violated("finite", f"{name} is {np.asarray(number).tolist()}", EXACTLY, answer)


def _still_a_hit(law: str, engine: Engine, question: Question, larger: Question, held: Held) -> None:
    one, other = Answer(engine, question), Answer(engine, larger)
    assume(one.hit)
    if not other.hit and _is_clear(question, held) and _is_clear(larger, held):
        _violated(law, "a hit, and a miss", held, one, other)


def alarm_growth(engine: Engine, question: Question, growth: float, *, ulps: float = ULPS, tolerance: Stated = None, conventions: Stated = None) -> None:
    """A hit stays a hit when the alarm distance grows."""
    wider = _with_growth(question, alarm=question.alarm + growth)
    _still_a_hit("alarm_growth", engine, question, wider, Held(ulps, tolerance, conventions))


def size_growth(engine: Engine, question: Question, growth: float, *, ulps: float = ULPS, tolerance: Stated = None, conventions: Stated = None) -> None:
    """A hit stays a hit when the first sphere grows."""
    assume(isinstance(question.a, Sphere))
    grown = _with_growth(question, a=replace(question.a, radius=question.a.radius + growth))
    _still_a_hit("size_growth", engine, question, grown, Held(ulps, tolerance, conventions))


def _with_growth(question: Question, **changes: Any) -> Question:
    grown = replace(question, **changes)
    assume(_is_in_scalar(grown))
    return grown


def alarm_changes_no_number(engine: Engine, question: Question, growth: float, *, ulps: float = ULPS, tolerance: Stated = None, conventions: Stated = None) -> None:
    """The alarm distance decides whether there is a contact, and changes no number of it."""
    one, other = Answer(engine, question), Answer(engine, _with_growth(question, alarm=question.alarm + growth))
    assume(one.hit and other.hit)
    to = Held(ulps, tolerance, conventions)
    for name, number in one.numbers.items():
        _same("alarm_changes_no_number", name, number, other.numbers[name], to, _scale(name, question), one, other)


def contact_distance(engine: Engine, question: Question, growth: float, *, ulps: float = ULPS, tolerance: Stated = None, conventions: Stated = None) -> None:
    """The contact distance changes the value alone, by as much as it changes."""
    changed = _with_growth(question, contact=question.contact + growth)
    one, other = Answer(engine, question), Answer(engine, changed)
    assume(one.hit)
    to = Held(ulps, tolerance, conventions)
    if not other.hit:
        _violated("contact_distance", "a hit, and a miss", to, one, other)
        return
    for name, number in one.numbers.items():
        if name != "value":
            _same("contact_distance", name, number, other.numbers[name], to.exactly(), _scale(name, question), one, other)
        elif pair_named(question.pair).numbers == "distance":
            both = float(number) + question.contact, float(other.numbers[name]) + changed.contact
            _same("contact_distance", "value + contact", *both, to.rounded(),
                  max(_scale(name, question), _scale(name, changed)), one, other)


@dataclass(frozen=True)
class Law:
    """A law as `check` asks it.

    check     the law itself
    concerns  whether it is about a pair
    draws     what it takes beside the question
    unfit     the conventions that it does not understand, so that an engine that declares one of them is not asked
    """

    check: Callable[..., None]
    concerns: Callable[[str], bool] = lambda pair: True
    draws: Mapping[str, st.SearchStrategy[Any]] | None = None
    unfit: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        return self.check.__name__

    @property
    def about(self) -> str:
        return (self.check.__doc__ or "").split("\n")[0]


def _has_numbers(pair: str) -> bool:
    return pair_named(pair).numbers != "none"


_GROWTH = {"growth": st.integers(0, 64).map(float)}
_STEP = {"by": st.tuples(*[st.integers(-16, 16).map(float)] * 3)}
_TURN = {"axes": st.sampled_from(list(itertools.permutations((0, 1, 2)))), "signs": st.tuples(*[st.sampled_from((1, -1))] * 3)}
_ROTATION = {"quaternion": st.sampled_from([(1, 0, 0, 2), (0, 1, 0, 2), (0, 0, 1, 2), (1, 1, 1, 0), (1, -1, 0, 1), (1, 1, 1, 2), (2, 0, 1, 2), (1, 2, 2, 4)])}
_CUT = {"which": st.sampled_from((1, 2)), "corner": st.integers(0, 7)}
_EDGES = ("touching_overlap", "touching_contact", "margin")

LAWS: dict[str, Law] = {law.name: law for law in (
    Law(repeatable),
    Law(finite, _has_numbers, unfit=("coincident",)),
    Law(swap, _has_two_alike, unfit=("points", "depth")),
    Law(turn, draws=_TURN, unfit=("depth",)),
    Law(rotate, lambda pair: "cube" not in pair_named(pair).shapes, draws=_ROTATION, unfit=("depth",)),
    Law(unit_normal, _has_numbers, unfit=("normal", "normal_unit", "coincident")),
    Law(scale, draws={"exponent": st.integers(-LARGEST_EXPONENT, LARGEST_EXPONENT)}, unfit=("depth",)),
    Law(translate, lambda pair: "plane" not in pair_named(pair).shapes, draws=_STEP, unfit=("depth",)),
    Law(alarm_growth, lambda pair: pair_named(pair).has_edge, draws=_GROWTH),
    Law(size_growth, lambda pair: pair_named(pair).shapes[0] == "sphere", draws=_GROWTH),
    Law(alarm_changes_no_number, _has_numbers, draws=_GROWTH),
    Law(contact_distance, _has_numbers, draws=_GROWTH, unfit=("value", "value_less_contact")),
    Law(onto_point, lambda pair: pair_named(pair).numbers == "distance" and pair_named(pair).shapes[0] == "sphere",
        unfit=("points", "value", "value_less_contact", "depth")),
    Law(cut_at_point, lambda pair: pair_named(pair).numbers == "distance" and not {"capsule", "triangle", "cube", "hull"}.isdisjoint(pair_named(pair).shapes),
        draws=_CUT, unfit=("normal", "normal_unit", "points", "value", "depth")),
    Law(decision, unfit=_EDGES),
    Law(bounds, _has_numbers, unfit=("normal", "normal_unit", "points", "value", "value_less_contact", "depth")),
)}


class NotAsked(Exception):
    """Why a law was not asked of an engine."""


def questions_for(pair: str, scalar: str, smallest: float, largest: float) -> st.SearchStrategy[Question]:
    """What laws ask: questions of any numbers, of small whole ones, and such that touch or nearly do."""
    near = strategies.touching(pair, scalar, scales=SCALES)
    if pair_named(pair).has_edge:
        near |= strategies.near_touching(pair, scalar, scales=SCALES)
    return near.filter(_IsServed(smallest, largest)) | strategies.questions(pair, scalar, largest, smallest)


@dataclass(frozen=True)
class _IsServed:
    smallest: float
    largest: float

    def __call__(self, question: Question) -> bool:
        return all(part == 0 or self.smallest <= abs(part) <= self.largest for part in _every_number(question))


def check(name: str, engine: Engine, pairs: tuple[str, ...], *, scalar: str = "binary64", examples: int = 100, seed: int | None = None,
          conventions: Mapping[str, Any] | None = None, ulps: float | None = None, tolerance: Mapping[str, Any] | None = None) -> None:
    """Asks a law of random questions about these pairs. Raises what the shrunk question raises, or NotAsked with the reason."""
    law = LAWS[name]
    declared = dict(conventions or {})
    unfit = [key for key in law.unfit if key in declared]
    if unfit:
        raise NotAsked(f"the engine declares {unfit[0]} {declared[unfit[0]]}")
    concerned = [pair for pair in pairs if law.concerns(pair)]
    if not concerned:
        raise NotAsked(f"it is about none of {', '.join(pairs)}")
    scales = [stated["scale"] for stated in (declared, tolerance or {}) if stated.get("scale")]
    beyond = 2.0**LARGEST_EXPONENT
    smallest = max((float(scale["min"]) * beyond for scale in scales if "min" in scale), default=SMALLEST)
    largest = min((float(scale["max"]) / beyond for scale in scales if "max" in scale), default=LARGEST)
    if smallest > largest:
        raise NotAsked(f"the scale is too narrow for it: numbers are left a factor of {beyond:g} from either end")
    asked = st.one_of([questions_for(pair, scalar, smallest, largest) for pair in concerned])
    held: dict[str, Any] = {} if ulps is None else {"ulps": ulps}
    if tolerance is not None:
        held |= {"tolerance": tolerance, "conventions": conventions}
    if name in ("repeatable", "finite"):
        held = {}

    @hypothesis.settings(max_examples=examples, deadline=None, database=None, report_multiple_bugs=False,
                         suppress_health_check=list(hypothesis.HealthCheck))
    @hypothesis.given(asked, st.fixed_dictionaries(dict(law.draws or {})))
    def run(question: Question, drawn: dict[str, Any]) -> None:
        law.check(engine, question, **drawn, **held)

    try:
        (run if seed is None else hypothesis.seed(seed)(run))()
    except hypothesis.errors.Unsatisfiable:
        raise NotAsked("too few questions suit it") from None


def laws_about(pairs: tuple[str, ...]) -> list[str]:
    """The names of the laws that concern one of the pairs."""
    return [name for name, law in LAWS.items() if any(law.concerns(pair) for pair in pairs)]
