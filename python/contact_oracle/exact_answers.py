"""The exact numbers behind an answer, as fractions, and their roots to as many decimals as one asks for."""
from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from decimal import Context, Decimal
from fractions import Fraction
from typing import Any

from . import _core
from .asked import Asked, asked
from .errors import InputError
from .pairs import pair_named
from .questions import Questions
from .shapes import Question

DIGITS = 50


def fraction(text: str) -> Fraction:
    """The number that an exact string is.

    >>> fraction("-0x1abdp-12")
    Fraction(-6845, 4096)
    >>> fraction("0x1p2/0x3")
    Fraction(4, 3)
    """
    dyadic, _, denominator = text.partition("/")
    mantissa, exponent = dyadic.split("p")
    return Fraction(int(mantissa, 16)) * Fraction(2) ** int(exponent) / int(denominator or "1", 16)


def decimal(number: Fraction, digits: int = DIGITS) -> Decimal:
    """The decimal nearest to a fraction, of so many significant digits.

    >>> decimal(Fraction(4, 3), 5)
    Decimal('1.3333')
    """
    return Context(prec=digits, Emin=-999999, Emax=999999).divide(Decimal(number.numerator), Decimal(number.denominator))


def root_less(square: Fraction, less: Fraction, digits: int = DIGITS, sign: int = 1) -> Decimal:
    """sign * sqrt(square) - less, rounded once to so many significant digits, whatever cancels.

    >>> root_less(Fraction(2), Fraction(1), 10)
    Decimal('0.4142135624')
    >>> root_less(Fraction(9), Fraction(3), 10)
    Decimal('0')
    """
    p, q = square.numerator, square.denominator
    if math.isqrt(p) ** 2 == p and math.isqrt(q) ** 2 == q:
        return decimal(sign * Fraction(math.isqrt(p), math.isqrt(q)) - less, digits)
    # The root is irrational, so it lies strictly between two neighbours of any grid, and the difference is on no boundary of
    # rounding: a fine enough grid has both neighbours on the same side of every boundary.
    bits = 4 * digits + max(0, q.bit_length() - p.bit_length()) // 2
    while True:
        below = math.isqrt((p << 2 * bits) // q)
        ends = [decimal(sign * Fraction(root, 1 << bits) - less, digits) for root in (below, below + 1)]
        if ends[0] == ends[1]:
            return ends[0]
        bits *= 2


@dataclass(frozen=True)
class Exact:
    """The exact numbers behind the answer to one question.

    question     the question, id its id, flags what is true of it
    expect       the right answer, a dict as in a dataset
    distance2    D, the squared distance of the cores; None for two boxes, crossings and casts
    depth2       of two convex shapes that overlap: the square of the least length that parts their cores; 0 where they touch
    reach        alarm + r1 + r2; None where D is
    below        whether a plane's distance is below 0
    margin_ulps  the distance of the cores less reach in ulps of reach, rounded to a float
    gap          of two boxes: how far apart they are on each axis
    crossing     of a segment and a triangle: the point that they have in common, None on a miss
    t            of a ray that is cast: a and h, where it hits at a - sqrt(h); None on a miss

    Lengths are in the question's unit, squares in its square. AttributeError for a distance that the pair has not.

    >>> import contact_oracle
    >>> answer = contact_oracle.exact("sphere_sphere", (0, 0, 0), 1, (3, 4, 0), 3.5, alarm=1)
    >>> answer.distance2, answer.reach, answer.value()
    (Fraction(25, 1), Fraction(11, 2), Decimal('0.5'))
    """

    question: Question
    id: str
    flags: tuple[str, ...]
    expect: dict[str, Any]
    distance2: Fraction | None = None
    reach: Fraction | None = None
    below: bool = False
    margin_ulps: float | None = None
    gap: tuple[Fraction, Fraction, Fraction] | None = None
    crossing: tuple[Fraction, Fraction, Fraction] | None = None
    t: tuple[Fraction, Fraction] | None = None
    depth2: Fraction | None = None

    def _repr_html_(self) -> str:
        return self.question._repr_html_()

    @property
    def hit(self) -> bool:
        """Whether the shapes are within the alarm distance."""
        return bool(self.expect["hit"])

    @property
    def degenerate(self) -> bool:
        """Whether there is no direction, so that the normal is an agreement."""
        return bool(self.expect.get("degenerate", False))

    @property
    def unique(self) -> bool:
        """Whether one pair of points alone is nearest."""
        return bool(self.expect.get("unique", True))

    def _root_less(self, less: Fraction, digits: int) -> Decimal:
        if self.distance2 is None:
            raise AttributeError(f"{self.question.pair} has no distance")
        if self.depth2 is not None:
            return root_less(self.depth2, less, digits, -1)
        return root_less(self.distance2, less, digits, -1 if self.below else 1)

    def distance(self, digits: int = DIGITS) -> Decimal:
        """sqrt(D), negative below a plane; of convex shapes whose cores overlap, how deep they do, negative.

        A centre in a box of ``sphere_cube`` is at 0, its D: `value` alone has its depth.
        """
        return self._root_less(Fraction(0), digits)

    def margin(self, digits: int = DIGITS) -> Decimal:
        """distance - reach: how far the question is from where its answer changes."""
        return self._root_less(self.reach or Fraction(0), digits)

    def value(self, digits: int = DIGITS) -> Decimal:
        """The distance of the surfaces less the contact distance, also on a miss."""
        radii = (self.reach or Fraction(0)) - Fraction(self.question.alarm)
        return self._root_less(radii + Fraction(self.question.contact) + self._depth(), digits)

    def _depth(self) -> Fraction:
        """How deep a centre is in a box, 0 where it is not."""
        box = self.question.b
        if self.question.pair != "sphere_cube" or self.distance2 != 0:
            return Fraction(0)
        return min(Fraction(inner) - Fraction(outer) for low, at, high in zip(box.min, self.question.a.center, box.max)
                   for inner, outer in ((at, low), (high, at)))


def _fractions(texts: Any) -> Any:
    return None if texts is None else tuple(map(fraction, texts))


def _exact(line: str, pair: str, scalar: str) -> Exact:
    case = json.loads(line)
    numbers = case.get("exact", {})
    return Exact(Question.from_json({**{key: case[key] for key in ("a", "b", "alarm", "contact")}, "pair": pair, "scalar": scalar}),
                 case["id"], tuple(case.get("flags", ())), case["expect"],
                 fraction(numbers["distance2"]) if "distance2" in numbers else None,
                 fraction(numbers["reach"]) if "reach" in numbers else None,
                 bool(numbers.get("below", False)),
                 float(numbers["margin_ulps"]) if "margin_ulps" in numbers else None,
                 _fractions(numbers.get("gap")), _fractions(numbers.get("crossing")), _fractions(numbers.get("t")),
                 fraction(numbers["depth2"]) if "depth2" in numbers else None)


def exact_of(question: Asked) -> list[Exact]:
    with question.naming_errors():
        lines = _core.cases(question.pair.name, question.columns, question.alarm, question.contact, question.scalar)
    return [_exact(line, question.pair.name, question.scalar) for line in lines]


def exact(query: Any, /, *arguments: Any, **named: Any) -> Exact | list[Exact]:
    """The exact numbers behind answers: one `Exact` for one question, a list for many.

    query      a pair's name, with its arguments after it as its function takes them; or a line for ``explain``, a dict like one,
               a `Question` or `Questions`

    >>> import contact_oracle
    >>> answer = contact_oracle.exact("sphere_sphere", (0, 0, 0), 1.0, (1, 1, 0), 0.25)
    >>> answer.distance2, answer.reach
    (Fraction(2, 1), Fraction(5, 4))
    >>> answer.margin(20)
    Decimal('0.16421356237309504880')
    """
    if isinstance(query, Questions):
        return exact_of(query.asked())
    question = asked_of(query, arguments, named)
    answers = exact_of(question)
    return answers if question.batch else answers[0]


def asked_of(query: Any, arguments: tuple[Any, ...], named: Mapping[str, Any], *, of_points: bool = True) -> Asked:
    """The questions of `exact`, `explain` and others, in whichever way they are given; `of_points`: contact points are told of, by one convention."""
    if isinstance(query, str) and not query.lstrip().startswith("{"):
        from .answering import POINTS, bound

        values = bound(pair_named(query), arguments, dict(named))
        known = POINTS[:1] if of_points else POINTS
        if values["points"] not in known:
            raise InputError(f"must be {'' if of_points else 'one of '}{', '.join(known)}", "points", value=repr(values["points"]))
        return asked(pair_named(query), values)
    if arguments or named:
        raise TypeError("arguments belong to a pair's name alone")
    if isinstance(query, Questions):
        return query.asked()
    question = query if isinstance(query, Question) else Question.from_json(query)
    return asked(pair_named(question.pair), question.arguments())
