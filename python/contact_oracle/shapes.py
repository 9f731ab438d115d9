"""One question: two shapes of Python's own numbers, an alarm distance and a contact distance."""
from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from .errors import InputError
from .pairs import Field, number_of, pair_named, scalar_named
from .shown import figure_of_case, text

if TYPE_CHECKING:
    from .contacts import Contacts
    from .exact_answers import Exact
    from .questions import Questions

Point = tuple[float, float, float]


@dataclass(frozen=True)
class Sphere:
    """All points within `radius` of `center`.

    >>> import contact_oracle
    >>> str(contact_oracle.Question("sphere_sphere", contact_oracle.Sphere((0, 0, 0), 1), contact_oracle.Sphere((3, 0, 0), 1), alarm=1).answer().value)
    '1.0'
    """

    center: Point
    radius: float


@dataclass(frozen=True)
class Cube:
    """A box along the axes; `min` exceeds `max` nowhere.

    >>> import contact_oracle
    >>> box = contact_oracle.Cube((0, 0, 0), (1, 1, 1))
    >>> bool(contact_oracle.Question("cube_cube", box, box).answer().hit)
    True
    """

    min: Point
    max: Point


@dataclass(frozen=True)
class Capsule:
    """All points within `radius` of the segment from `start` to `end`.

    >>> import contact_oracle
    >>> capsule = contact_oracle.Capsule((0, 0, 0), (4, 0, 0), 0.5)
    >>> contact_oracle.Question("sphere_capsule", contact_oracle.Sphere((1, 2, 0), 1.5), capsule).answer().point2
    array([1. , 0.5, 0. ])
    """

    start: Point
    end: Point
    radius: float


@dataclass(frozen=True)
class Triangle:
    """Three points and what is between them.

    >>> import contact_oracle
    >>> triangle = contact_oracle.Triangle(((0, 0, 0), (4, 0, 0), (0, 4, 0)))
    >>> contact_oracle.Question("sphere_triangle", contact_oracle.Sphere((1, 1, 1), 2), triangle).answer().normal
    array([ 0.,  0., -1.])
    """

    vertices: tuple[Point, Point, Point]


@dataclass(frozen=True)
class Plane:
    """The half-space normal . x <= offset; the normal has any length but 0.

    >>> import contact_oracle
    >>> ground = contact_oracle.Plane((0, 0, 1), 0)
    >>> contact_oracle.Question("sphere_plane", contact_oracle.Sphere((5, 6, 0.75), 1), ground).answer().value
    -0.25
    """

    normal: Point
    offset: float


@dataclass(frozen=True)
class Ray:
    """The segment from `origin` to `origin` + `length` * `direction`; the direction has any length but 0.

    >>> import contact_oracle
    >>> ray = contact_oracle.Ray((0, 0, 0), (1, 0, 0), 9)
    >>> contact_oracle.Question("cast_sphere", ray, contact_oracle.Sphere((4, 0, 0), 1)).answer().value
    3.0
    """

    origin: Point
    direction: Point
    length: float


@dataclass(frozen=True)
class Line:
    """The segment from `start` to `end`.

    >>> import contact_oracle
    >>> triangle = contact_oracle.Triangle(((0, 0, 0), (4, 0, 0), (0, 4, 0)))
    >>> contact_oracle.Question("triangle_line", triangle, contact_oracle.Line((1, 1, -1), (1, 1, 1))).answer().point1
    array([1., 1., 0.])
    """

    start: Point
    end: Point


@dataclass(frozen=True)
class Obb:
    """A rotated box: `center` + R (`extents` * t), every t from -1 to 1. `orientation` is a quaternion x, y, z, w of any length but 0, and R its rotation.

    >>> import contact_oracle
    >>> turned = contact_oracle.Obb((0, 0, 0), (0, 0, 1, 1), (2, 1, 1))  # a quarter turn about z
    >>> contact_oracle.Question("sphere_obb", contact_oracle.Sphere((0, 3, 0), 1), turned).answer().point2
    array([0., 2., 0.])
    """

    center: Point
    orientation: tuple[float, float, float, float]
    extents: Point


@dataclass(frozen=True)
class Hull:
    """All points within `radius` of the convex hull of from 1 to 64 `vertices`. These may be repeated, lie inside, in a plane or on a line.

    >>> import contact_oracle
    >>> hull = contact_oracle.Hull(((0, 0, 0), (4, 0, 0), (0, 4, 0), (0, 0, 4)), 0.25)
    >>> contact_oracle.Question("sphere_hull", contact_oracle.Sphere((1, 1, -1), 1), hull).answer().value
    -0.25
    """

    vertices: tuple[Point, ...]
    radius: float


Shape = Union[Sphere, Cube, Capsule, Triangle, Plane, Ray, Line, Obb, Hull]
SHAPES: dict[str, type] = {"sphere": Sphere, "cube": Cube, "capsule": Capsule, "triangle": Triangle, "plane": Plane, "ray": Ray,
                           "line": Line, "obb": Obb, "hull": Hull}


def json_number(value: float) -> float | str:
    """As in all files: what is not finite is a text."""
    value = float(value)
    if math.isfinite(value):
        return value
    return "NaN" if math.isnan(value) else "Infinity" if value > 0 else "-Infinity"


def _json_value(value: Any) -> Any:
    return [_json_value(part) for part in value] if isinstance(value, (tuple, list, np.ndarray)) else json_number(value)


def plain(value: Any) -> Any:
    """What the package says in JSON: numbers of NumPy are numbers, and what is not finite is a text."""
    if isinstance(value, Mapping):
        return {key: plain(part) for key, part in value.items()}
    if isinstance(value, (tuple, list)):
        return [plain(part) for part in value]
    value = value.item() if isinstance(value, np.generic) else value
    return json_number(value) if isinstance(value, float) else value


def _from_json(value: Any) -> Any:
    if isinstance(value, (list, tuple, np.ndarray)):
        return tuple(map(_from_json, value))
    if isinstance(value, (bool, bytes)) or isinstance(value, str) and value not in ("NaN", "Infinity", "-Infinity"):
        raise TypeError("no number")
    return float(value)


def _shape_of(numbers: Any) -> tuple[int, ...] | None:
    """None where some rows are longer than others."""
    if not isinstance(numbers, tuple):
        return ()
    rows = set(map(_shape_of, numbers))
    row = rows.pop() if len(rows) == 1 else None
    return None if row is None else (len(numbers), *row)


def _numbers_from(value: Any, field: Field) -> Any:
    place = f"{field.side}.{field.name}" if field.side else field.name
    try:
        numbers = _from_json(value)
    except (OverflowError, TypeError, ValueError):
        raise InputError("must be numbers", place, value=repr(value), field=place) from None
    shape = _shape_of(numbers)
    if shape is None or not field.fits(shape):
        wanted = f"numbers of the shape {field.shape_text.replace('..., ', '')}" if field.shape else "one number"
        raise InputError(f"must be {wanted}", place, value=repr(value), field=place)
    return numbers


def _shape_from(query: Mapping[str, Any], side: str, kind: str, of_the_pair: Mapping[str, Field]) -> Any:
    given, names = query.get(side), [field.name for field in fields(SHAPES[kind])]
    if not isinstance(given, Mapping):
        raise InputError(f"must be a {kind}, with {', '.join(names)}", side, value=repr(given), field=side)
    for name in [*given, *names]:
        if name not in names or name not in given:
            raise InputError(f"is no part of a {kind}" if name in given else "is missing", f"{side}.{name}", field=f"{side}.{name}")
    return SHAPES[kind](**{name: _numbers_from(given[name], of_the_pair[side + name]) for name in names})


def _shape_json(shape: Shape) -> dict[str, Any]:
    return {field.name: _json_value(getattr(shape, field.name)) for field in fields(shape)}


@dataclass(frozen=True)
class Question:
    """One question. ``str(question)`` is a line for ``explain``.

    >>> import contact_oracle
    >>> question = contact_oracle.generate("sphere_sphere", "touching", 1, seed=1)[0]
    >>> question == contact_oracle.Question.from_json(str(question))
    True
    """

    pair: str
    a: Any
    b: Any
    alarm: float = 0.0
    contact: float = 0.0
    scalar: str = "binary64"

    @classmethod
    def from_json(cls, line: str | dict[str, Any]) -> Question:
        """From a line as ``explain`` reads it, or what it holds. InputError where it is no question."""
        try:
            query = json.loads(line) if isinstance(line, (str, bytes)) else line
        except (ValueError, RecursionError) as error:
            raise InputError(f"cannot be read: {error}", "question") from None
        if not isinstance(query, Mapping):
            raise InputError("must be a line or a dict", "question", value=repr(query))
        first = query.get("a")
        pair = query.get("pair") or ("cube_cube" if isinstance(first, Mapping) and "min" in first else "sphere_sphere")
        named = {field.side + field.name: field for field in pair_named(pair).numbers_of_a_question}
        a, b = (_shape_from(query, side, kind, named) for side, kind in zip("ab", pair_named(pair).shapes))
        alarm, contact = (_numbers_from(query.get(name, 0), named[name]) for name in ("alarm", "contact"))
        return cls(pair, a, b, alarm, contact, scalar_named(query.get("scalar", "binary64")))

    def __str__(self) -> str:
        return json.dumps({"pair": self.pair, "scalar": self.scalar, "a": _shape_json(self.a), "b": _shape_json(self.b),
                           "alarm": json_number(self.alarm), "contact": json_number(self.contact)}, separators=(",", ":"))

    def arguments(self) -> dict[str, Any]:
        """The arguments of the pair's function, as arrays of the question's scalar."""
        number = number_of(self.scalar)
        pair = pair_named(self.pair)
        values = {field.argument: getattr(self.a if field.side == "a" else self.b, field.name) for field in pair.fields}
        return {name: np.asarray(value, number)[()] for name, value in (*values.items(), ("alarm", self.alarm), ("contact", self.contact))}

    def as_questions(self) -> Questions:
        """The same as a batch of one."""
        from .questions import Questions

        return Questions(self.pair, {name: np.asarray(value)[np.newaxis] for name, value in self.arguments().items()}, self.scalar)

    def answer(self, points: str = "nearest_surface") -> Contacts:
        """The right answer, correctly rounded."""
        return self.as_questions().answer(points)[0]

    def exact(self) -> Exact:
        """The exact numbers behind the answer."""
        return self.as_questions().exact()[0]

    def explain(self) -> str:
        """The answer in words."""
        from .answering import explain

        return explain(str(self))

    def _repr_html_(self) -> str:
        try:
            return text(self.explain())
        except InputError as error:  # a question outside the domain is one all the same
            return text(f"{self}\n{error}")

    def to_figure(self) -> Any:
        """A matplotlib Figure of both shapes, with contact points and normal where there is a contact; InputError without matplotlib.

        A notebook shows it, and ``savefig`` writes it. A plane is drawn near the other shape.

        >>> import contact_oracle
        >>> question = contact_oracle.generate("sphere_obb", "generic", 1)[0]
        >>> question.to_figure().savefig("case.png")  # doctest: +SKIP
        """
        return figure_of_case(self)
