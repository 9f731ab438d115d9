"""Exact derivatives of contacts, and a judge of those that an engine computes: docs/gradients.md."""
from __future__ import annotations

import math
import secrets
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from . import _core
from .asked import Asked
from .engines import _array, first_line
from .errors import EngineError, InputError
from .exact_answers import asked_of
from .judging import _name_of, generated_sources
from .pairs import Array, Pair, number_of, pair_named, scalar_named
from .questions import Questions, joined
from .shapes import Question
from .shown import text

FIELDS = {"value": slice(0, 1), "normal": slice(1, 4), "point1": slice(4, 7), "point2": slice(7, 10)}
COUNT = 20
RELATIVE = {"binary64": 1e-6, "binary32": 1e-3}
EVERYDAY = (1e-4, 1e4)  # docs/specification.md#rule-fitness
LAST_BITS = 8  # so often what the inputs' last bit does is allowed, as a bound is so many ulps
MOST_FAILURES = 50  # that are asked again with other last bits; further ones are counted as they stand

Engine = Callable[[Questions], Any]


@dataclass(frozen=True)
class Gradient:
    """The derivatives of a contact's numbers, exact and rounded once to binary64; NaN where there is none.

    value, normal, point1, point2   by each argument of the pair's function: ``gradient.normal["center1"]`` is (N, 3, 3), the derivative
                                    of the component by the coordinate
    why      the same with texts: why there is none, else empty. What begins with "not told" may exist
    sides    the same with a last axis of two: the derivatives from below and from above, where there is none and these are known

    A single question has arrays without the first axis.

    >>> import contact_oracle
    >>> found = contact_oracle.gradient("sphere_plane", (1, 2, 3), 1, (0, 0, 2), 0)
    >>> found.value["center1"], found.point2["center1"][0], found.why["value"]["radius1"]
    (array([0., 0., 1.]), array([1., 0., 0.]), '')
    """

    value: dict[str, Any]
    normal: dict[str, Any]
    point1: dict[str, Any]
    point2: dict[str, Any]
    why: dict[str, dict[str, Any]]
    sides: dict[str, dict[str, Any]]


def _widths(columns: Iterable[Array]) -> list[int]:
    return [math.prod(column.shape[1:]) for column in columns]


def _by_argument(question: Asked, name: str, array: Array) -> dict[str, Any]:
    """Of the derivatives by all numbers those of one field, by argument."""
    found = {}
    begin = 0
    for argument, column, width in zip(question.pair.arguments, question.columns, _widths(question.columns)):
        part = array[:, FIELDS[name], begin:begin + width]
        begin += width
        rows = () if name == "value" else (3,)
        shape = rows + column.shape[1:] + array.shape[3:]
        found[argument] = part.reshape(question.batch + shape)[()] if array.dtype == object else question.answered(part, shape)
    return found


def _gradients(question: Asked) -> dict[str, Any]:
    with question.naming_errors():
        return _core.gradients(question.pair.name, question.columns, question.alarm, question.contact)


def gradient(query: Any, /, *arguments: Any, **named: Any) -> Gradient:
    """The exact derivatives of value, normal and points by every number of both shapes, of hits and misses.

    query      a pair's name, with its arguments after it as its function takes them; or a line for ``explain``, a dict like one,
               a `Question` or `Questions`

    >>> import contact_oracle
    >>> found = contact_oracle.gradient("sphere_sphere", (0, 0, 0), 1.0, (0, 0, 4), 1.0)
    >>> found.value["center2"], found.value["radius1"]
    (array([0., 0., 1.]), -1.0)
    >>> found = contact_oracle.gradient("sphere_sphere", (0, 0, 0), 1.0, (0, 0, 0), 1.0)
    >>> found.value["center2"][0], found.sides["value"]["center2"][0], found.why["value"]["center2"][0]
    (nan, array([-1.,  1.]), 'the cores meet, and the derivatives from below and above differ')
    """
    question = asked_of(query, arguments, named)
    arrays = _gradients(question)
    texts = np.array(arrays["reasons"], object)[arrays["why"]]
    return Gradient(**{name: _by_argument(question, name, arrays["derivatives"]) for name in FIELDS},
                    why={name: _by_argument(question, name, texts) for name in FIELDS},
                    sides={name: _by_argument(question, name, arrays["sides"]) for name in FIELDS})


@dataclass(frozen=True)
class GradientFailure:
    """A derivative that is wrong: ``of`` which number, ``by`` which, what was ``claimed`` and is ``right`` (NaN: there is none).

    >>> import contact_oracle
    >>> def wrong(questions):
    ...     return None, {"radius1": -2 * np.ones(len(questions))}
    >>> report = contact_oracle.certify_gradient(wrong, "sphere_sphere", "generic", seed=1)
    >>> failure = report.failures[0]
    >>> failure.of, failure.by, failure.claimed, failure.right, failure.what
    ('value', 'radius1', -2.0, -1.0, 'wrong')
    """

    line: str
    of: str
    by: str
    claimed: float
    right: float
    what: str

    def __str__(self) -> str:
        right = "" if math.isnan(self.right) else f", right is {self.right!r}"
        return f"{self.of} by {self.by}: {self.what}: {self.claimed!r}{right}\n    {self.line}"


@dataclass
class GradientReport:
    """What the judge says of derivatives.

    certified       whether every derivative that was judged is right
    questions       how many were asked
    judged          how many derivatives were compared with exact ones
    undefined       how many were claimed where there is none, and are finite
    not_told        how many were claimed where the oracle does not tell
    last_bit        how many are beyond the tolerance and no worse than the inputs' last bits, and so allowed
    claimed         how many were claimed where one exists or surely none does
    failure_count   how many of these are wrong; `failures` has some
    diagnosis       what the wrong ones have in common
    unclaimed       the arguments by which no derivative was claimed

    >>> import contact_oracle
    >>> def wrong(questions):
    ...     return None, {"radius1": -2 * np.ones(len(questions))}
    >>> report = contact_oracle.certify_gradient(wrong, "sphere_sphere", "generic", seed=1)
    >>> report.certified, report.failure_count == report.judged == report.questions
    (False, True)
    """

    name: str
    pair: str
    seed: int | None
    relative: float
    questions: int = 0
    claimed: int = 0
    judged: int = 0
    undefined: int = 0
    not_told: int = 0
    last_bit: int = 0
    failure_count: int = 0
    failures: list[GradientFailure] = field(default_factory=list)
    diagnosis: list[str] = field(default_factory=list)
    unclaimed: list[str] = field(default_factory=list)

    @property
    def certified(self) -> bool:
        """Whether some derivatives were judged and none is wrong."""
        return self.judged > 0 and self.failure_count == 0

    def __bool__(self) -> bool:
        return self.certified

    @property
    def verdict(self) -> str:
        """The verdict in one sentence."""
        of = f"{self.name}: derivatives of {self.pair}, {self.questions} questions" + ("" if self.seed is None else f" (seed {self.seed})")
        if self.judged == 0:
            return f"REFUTED: {of}: none was judged"
        rest = f"; {self.undefined} were finite where there is none, {self.not_told} not told, {self.last_bit} no worse than the inputs' last bits"
        if self.failure_count:
            return f"REFUTED: {of}: {self.failure_count} of {self.claimed} are wrong by more than {self.relative:g} of their scale, or not finite{rest}"
        without = f"; none was claimed by {', '.join(self.unclaimed)}" if self.unclaimed else ""
        return f"CERTIFIED: {of}: all {self.judged} are within {self.relative:g} of their scale{rest}{without}"

    def _repr_html_(self) -> str:
        return text(self)

    def __str__(self) -> str:
        return "\n".join([self.verdict, *(f"  {line}" for line in self.diagnosis), *(f"  {failure}" for failure in self.failures[:5])])


class _Batch:
    """Questions, their exact derivatives and those that an engine claims, as arrays over (question, output, number)."""

    def __init__(self, questions: Questions, claims: Mapping[str, Any]) -> None:
        self.questions, self.pair = questions, pair_named(questions.pair)
        self.asked = questions.asked()
        self.widths = _widths(self.asked.columns)
        arrays = _gradients(self.asked)
        self.exact: Array = arrays["derivatives"]
        reasons = np.array(arrays["reasons"], object)
        self.why = reasons[arrays["why"]]
        told = np.array([text != "no such vertex" and not text.startswith("not told") for text in reasons])[arrays["why"]]
        self.claimed = np.full(self.exact.shape, np.nan)
        self.is_claimed = np.zeros(self.exact.shape, bool)
        for name, by in claims.items():
            self._claim(name, by)
        self.exists = self.is_claimed & (arrays["why"] == 0) & np.isfinite(self.exact)
        self.undefined = self.is_claimed & told & (arrays["why"] != 0)
        self.not_told = self.is_claimed & ~told & (self.why != "no such vertex")
        self.scale = self._scale()

    def _claim(self, name: str, by: Any) -> None:
        rows = () if name == "value" else (3,)
        begin = 0
        for argument, column, width in zip(self.pair.arguments, self.asked.columns, self.widths):
            if (given := by.get(argument)) is not None:
                array = _array(f"{name} by {argument}", given)
                shape = (len(self.questions), *rows, *column.shape[1:])
                if array.shape != shape or array.dtype.kind != "f":
                    raise EngineError(f"{name} by {argument} must be numbers of the shape {shape}, got {array.dtype} {array.shape}")
                part = (slice(None), FIELDS[name], slice(begin, begin + width))
                self.claimed[part] = array.reshape((len(self.questions), len(rows) and 3 or 1, width))
                self.is_claimed[part] = True
            begin += width

    def _groups(self) -> Array:
        """What number of each belongs together: points and lengths, and each field of another kind."""
        kinds = [0 if of.kind in ("point", "points") or of.name in ("radius", "extents") else 1 + k for k, of in enumerate(self.pair.fields)]
        return np.repeat(kinds, self.widths)

    def _scale(self) -> Array:
        """The largest derivative of a field by any number of the same kind; where all are 0, what is natural: a share of the sizes."""
        scale = np.zeros(self.exact.shape)
        groups = self._groups()
        numbers = np.abs(np.nan_to_num(np.concatenate([column.reshape((len(self.questions), -1)) for column in self.asked.columns], axis=1, dtype=np.float64)))
        size = numbers[:, groups == 0].max(axis=1)
        for group in np.unique(groups):
            of = groups == group
            own = numbers[:, of].max(axis=1) if group else size
            for name, rows in FIELDS.items():
                largest = np.abs(np.nan_to_num(self.exact[:, rows][:, :, of])).max(axis=(1, 2))
                natural = np.divide(1 if name == "normal" else size, own, out=np.ones(len(own)), where=own > 0)
                scale[:, rows, of] = np.where(largest > 0, largest, natural)[:, np.newaxis, np.newaxis]
        return scale

    def name_of(self, output: int) -> str:
        name = next(name for name, rows in FIELDS.items() if rows.start <= output < rows.stop)
        return name if name == "value" else f"{name}[{output - FIELDS[name].start}]"

    def argument_of(self, number: int) -> str:
        for argument, column, width in zip(self.pair.arguments, self.asked.columns, self.widths):
            if number < width:
                return argument + "".join(f"[{k}]" for k in np.unravel_index(number, column.shape[1:]))
            number -= width
        raise IndexError(number)

    def last_bits(self, row: int, scalar: str) -> Array:
        """How much the last bit of each number of a question changes its derivatives, all together: infinite where one has no derivative then."""
        columns = dict(zip(self.pair.arguments, (column[row] for column in self.asked.columns)))
        neighbours, of = [], []
        for name, column in columns.items():
            for index in np.ndindex(*column.shape):
                number = number_of(scalar)(column[index])
                for towards in (-np.inf, np.inf):
                    moved = np.array(column)
                    moved[index] = np.nextafter(number, number_of(scalar)(towards))
                    near = {**columns, name: moved}
                    boxes = [(near["min" + side], near["max" + side]) for side in "12" if "min" + side in near]
                    if number != 0 and not np.isnan(number) and all((low <= high).all() for low, high in boxes):
                        neighbours.append(near)
                        of.append((name, index))
        effect = np.zeros(self.exact.shape[1:])
        if neighbours:
            asked = Questions(self.questions.pair, {name: np.stack([one[name] for one in neighbours]) for name in columns})
            change = np.abs(_gradients(asked.asked())["derivatives"] - self.exact[row])
            change[np.isnan(change)] = np.inf
            for which in dict.fromkeys(of):
                effect += change[[k for k, other in enumerate(of) if other == which]].max(axis=0)
        return effect


def _claims(answer: Any, pair: Pair) -> dict[str, dict[str, Any]]:
    """What an engine returned as derivatives by field and argument."""
    if isinstance(answer, Mapping) and answer and all(name in FIELDS for name in answer):
        fields = dict(answer)
    elif isinstance(answer, Sequence) and len(answer) == 2:
        fields = {"value": answer[1]}  # as jax.value_and_grad returns them
    else:
        raise EngineError(f"derivatives are a pair of values and derivatives, or a dict of {', '.join(FIELDS)}; got {type(answer).__name__}")
    names = [of.argument for of in pair.fields]
    found = {}
    for name, by in fields.items():
        if not isinstance(by, Mapping):
            if not isinstance(by, Sequence) or len(by) != len(names):
                raise EngineError(f"the derivatives of {name} are a dict by argument, or one of each of {', '.join(names)}")
            by = dict(zip(names, by))
        unknown = [argument for argument in by if argument not in names]
        if unknown:
            raise EngineError(f"{pair.name} has no argument {unknown[0]!r}; it has {', '.join(names)}")
        found[name] = dict(by)
    return found


def _everyday(questions: Questions, scale: tuple[float, float], hits_only: bool) -> Questions:
    """Those whose numbers are of such a magnitude, or 0; where none are, after a power of two has scaled them. The two distances move no derivative."""
    if len(questions) == 0:
        return questions
    fields = pair_named(questions.pair).fields
    scaled = [of for of in fields if of.kind not in ("direction", "orientation") and of.name != "length" or of.name == "direction"]
    arrays: dict[str, Array] = dict(**questions)
    sizes = np.abs(np.concatenate([arrays[of.argument].reshape((len(questions), -1)) for of in scaled if of.kind != "direction"], axis=1).astype(np.float64))
    largest = np.nan_to_num(sizes).max(axis=1)
    exponent = np.where((largest > scale[1]) | (largest < scale[0]), np.frexp(scale[1])[1] // 2 - np.frexp(largest)[1], 0)
    for of in scaled:
        array = arrays[of.argument]
        with np.errstate(under="ignore"):
            arrays[of.argument] = np.ldexp(array, exponent.reshape((-1, *(1,) * (array.ndim - 1))))
    for name in ("alarm", "contact"):
        arrays[name] = np.where(exponent == 0, arrays[name], np.zeros_like(arrays[name]))
    keep = np.ones(len(questions), bool)
    for of in fields:
        size = np.abs(arrays[of.argument].reshape((len(questions), -1)).astype(np.float64))
        keep &= (np.isnan(size) | (size == 0) | ((size >= scale[0]) & (size <= scale[1]))).all(axis=1)
    found = Questions(questions.pair, {name: array[keep] for name, array in arrays.items()}, questions.scalar, questions.family)
    if hits_only:
        hits = found[found.answer().hit]
        assert isinstance(hits, Questions)
        return hits
    return found


def _diagnosis(batch: _Batch, wrong: Array) -> Iterator[str]:
    """What wrong derivatives have in common, the surest first."""
    finite = np.isfinite(batch.claimed)
    meets = np.char.startswith(batch.why.astype(str), "the cores meet").any(axis=(1, 2))
    if (wrong & ~finite)[meets].any() and not (wrong & ~finite)[~meets].any():
        yield ("not finite where the cores meet: a root, or the norm of a vector, is differentiated at 0, where infinity times 0 is NaN; "
               "it also spoils the derivatives that exist there, as those by radii")
    if (wrong & ~finite)[~meets].any():
        yield ("not finite where the cores are apart: a branch that a `where` or `select` does not take is differentiated all the same, and 0 times its infinity is NaN; "
               "give that branch arguments that do no harm")
    core = [of.name != "radius" for of in batch.pair.fields]
    of_core = np.repeat(core, batch.widths)
    sides = np.repeat([of.side for of in batch.pair.fields], batch.widths)
    off = wrong & finite & batch.exists
    zero = batch.is_claimed[:, 0] & (batch.claimed[:, 0] == 0)
    if (off[:, 0].any(axis=1) & zero.all(axis=1)).any():
        yield "the value's derivative is 0 by every number, also where it moves: a clamp (max, clip, relu) is in the way, and has the derivative 0 there"
    for side, name in (("a", "first"), ("b", "second")):
        mine = of_core & (sides == side)
        bad = off[:, 0, mine].any(axis=1)
        if bad.any() and zero[bad][:, mine].all() and not zero[bad][:, ~mine].all(axis=1).any():
            yield f"the value's derivatives by the {name} shape are 0: its nearest point is taken for a constant (stop_gradient, detach)"
    of_value = (off[:, 0] & of_core).any(axis=1)
    if of_value.any():
        some = np.flatnonzero(of_value)[:MOST_FAILURES]
        squares = []
        for row, answer in zip(some, batch.questions[some].exact()):
            mine = batch.exists[row, 0] & of_core
            claimed, right = batch.claimed[row, 0, mine], batch.exact[row, 0, mine]
            if not right.any():
                continue
            share = float(np.dot(claimed, right) / np.dot(right, right))
            apart = np.abs(claimed - share * right).max() <= 1e-3 * abs(1 - share) * np.abs(right).max()
            if apart and 0 < share < 1 and answer.distance2:
                squares.append(float(answer.distance2) * (1 / share**2 - 1))
        if 2 * len(squares) > len(some) and max(squares) <= 1.05 * min(squares):
            yield f"the derivative of sqrt(D + {np.median(squares):.2g}) in the place of sqrt(D): a number under the root that keeps it from 0"
    if off[:, 1:].any() and batch.is_claimed[:, 0].any() and not off[:, 0].any():
        yield "the value's derivatives are right and those of normal or points are not: the place on an edge or a face is held fixed (stop_gradient on a parameter), which the value alone forgives"


def certify_gradient(engine: Engine, pair: str, families: str | Iterable[str] | None = None, *, questions: Questions | Question | Iterable[Question] | None = None,
                     count: int = COUNT, seed: int | None = None, scalar: str = "binary64", relative: float | None = None, scale: tuple[float, float] = EVERYDAY,
                     hits_only: bool = False, kinks: str = "finite", name: str | None = None) -> GradientReport:
    """Judges the derivatives that an engine computes: docs/gradients.md.

    engine     a function of `Questions` that returns ``(value, derivatives)``, as ``jax.value_and_grad`` does, or a dict of derivatives by field:
               value, normal, point1, point2. Derivatives are a dict by argument, or a tuple in their order; those of the value have the shape of the
               argument, the others (N, 3, ...). What is absent is not judged
    families   what is asked; all of the pair that lie in the domain
    questions  in the place of families
    count      how many questions of each family, from `seed`: a random one where it is None
    relative   how far a derivative may be off, as a share of the largest one of the same field by numbers of the same kind; 1e-6, of binary32 1e-3
    scale      numbers of another magnitude are not asked, but 0 is. Questions that are larger or smaller in all are scaled by a power of two first
    hits_only  leave out misses, whose derivatives are those of the distance
    kinks      finite: where there is no derivative a claim must be finite; any: it may be anything

    A derivative that is off by no more than 8 times what the last bits of the question's numbers do to it is right too.

    >>> import contact_oracle
    >>> def planes(questions):
    ...     normal = questions.normal2 / np.linalg.norm(questions.normal2, axis=1, keepdims=True)
    ...     return None, {"center1": normal, "radius1": np.full(len(questions), -1.0)}
    >>> report = contact_oracle.certify_gradient(planes, "sphere_plane", "generic", seed=1)
    >>> report.certified, report.unclaimed
    (True, ['normal2', 'offset2'])
    """
    description = pair_named(pair)
    if description.numbers != "distance":
        raise InputError("has no distance, and no derivatives are told of it", "pair", value=pair)
    if kinks not in ("finite", "any"):
        raise InputError("must be finite or any", "kinks", value=repr(kinks))
    relative = RELATIVE[scalar_named(scalar)] if relative is None else relative
    # Nothing is more than no number, and everything would be right.
    if not (isinstance(relative, (int, float, np.number)) and 0 <= relative < math.inf):
        raise InputError("must be a finite number from 0", "relative", value=repr(relative))
    if not (isinstance(scale, (tuple, list)) and len(scale) == 2 and 0 <= scale[0] <= scale[1]):
        raise InputError("must be the least and the largest number, from 0", "scale", value=repr(scale))
    if questions is None:
        seed = secrets.randbits(32) if seed is None else seed
        from .datasets import generate

        asked = [generate(pair, source["family"], count, seed, scalar) for source in generated_sources([pair], families, scalar, seed, count)]
    else:
        asked, seed = [joined(questions)], None
        scalar = asked[0].scalar
        if asked[0].pair != pair:
            raise InputError(f"must be of {pair}", "questions", value=asked[0].pair)
    report = GradientReport(_name_of(engine, name), pair, seed, relative)
    seen: set[str] = set()
    confirmed = 0
    for every in asked:
        some = _everyday(every, scale, hits_only)
        if len(some) == 0:
            continue
        try:
            # Its own copy: what it changes in place is not what it is judged by.
            arrays: dict[str, Array] = dict(**some)
            given = Questions(pair, {argument: array.copy() for argument, array in arrays.items()}, scalar, some.family)
            batch = _Batch(some, _claims(engine(given), description))
        except (EngineError, InputError):
            raise
        except Exception as error:
            raise EngineError(f"{pair}: the engine raised {type(error).__name__}: {error}", pair, first_line(some)) from error
        finite = np.isfinite(batch.claimed)
        broken = ~finite & (batch.exists | (batch.undefined if kinks == "finite" else False))
        miss = np.abs(np.where(finite, batch.claimed, 0) - np.nan_to_num(batch.exact))
        off = batch.exists & finite & (miss > relative * batch.scale)
        for row in np.flatnonzero(off.any(axis=(1, 2))):
            if confirmed >= MOST_FAILURES:
                break
            room = relative * batch.scale[row] + LAST_BITS * batch.last_bits(row, scalar)
            allowed = off[row] & (miss[row] <= room)
            report.last_bit += int(allowed.sum())
            off[row] &= ~allowed
            confirmed += bool(off[row].any())
        wrong = broken | off
        report.questions += len(some)
        report.claimed += int((batch.exists | batch.undefined).sum())
        report.judged += int(batch.exists.sum())
        report.undefined += int((batch.undefined & finite).sum())
        report.not_told += int(batch.not_told.sum())
        report.failure_count += int(wrong.sum())
        seen.update(argument for argument, claimed in zip(description.arguments, np.split(batch.is_claimed.any(axis=(0, 1)), np.cumsum(batch.widths)[:-1]))
                    if claimed.any())
        for row, output, number in np.argwhere(wrong)[:max(0, MOST_FAILURES - len(report.failures))]:
            place = (row, output, number)
            what = ("not finite where the derivative exists" if broken[place] and batch.exists[place] else
                    f"not finite where there is no derivative ({batch.why[place]}), which a step would carry on" if broken[place] else "wrong")
            report.failures.append(GradientFailure(str(some[int(row)]), batch.name_of(int(output)), batch.argument_of(int(number)), float(batch.claimed[place]),
                                                   float(batch.exact[place]), what))
        if wrong.any():
            report.diagnosis += [line for line in _diagnosis(batch, wrong) if line not in report.diagnosis]
    report.unclaimed = [of.argument for of in description.fields if of.argument not in seen]
    return report
