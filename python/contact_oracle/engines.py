"""Between the judge and an engine: questions as arrays, answers in any of the forms that an engine may give, and its own process."""
from __future__ import annotations

import multiprocessing
import traceback
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from .arrays import UNREADABLE, numpy_array
from .datasets import generate
from .errors import EngineError, InputError
from .pairs import PAIRS, Array, number_of, pair_named
from .questions import Questions

Engine = Callable[[Questions], Any]

# docs/formats.md#answers-in-columns
NUMBERS = {"normal": (3,), "point1": (3,), "point2": (3,), "point": (3,), "points": (3,), "depths": (), "value": ()}
# Several in a row; what is not there is NaN, at the end. The depths are those of the points, and no claim of their own.
LISTS = ("points", "depths")
MOST_POINTS = 64
CLAIMS = tuple(name for name in NUMBERS if name != "depths")
TRUTHS = ("hit", "overlap", "contact", "unsupported")
# These claim nothing, and an answer of this package has them.
SILENT = ("degenerate", "unique")


def questions_of(pair: str, scalar: str, columns: Mapping[str, Any]) -> Questions:
    """Questions from arrays under the names of columns, ``a/center``."""
    description = pair_named(pair)
    number = number_of(scalar)
    arrays = {name: np.asarray(columns[column], number) for name, column in zip(description.arguments, description.columns)}
    return Questions(pair, arrays, scalar)


def _named(answers: Any) -> dict[str, Any]:
    if isinstance(answers, Mapping):
        found = dict(answers)
        unknown = [name for name in found if name not in NUMBERS and name not in TRUTHS and name not in SILENT]
        if unknown:
            raise EngineError(f"an answer has no {unknown[0]!r}; it has {', '.join((*TRUTHS, *NUMBERS))}")
    else:
        found = {name: getattr(answers, name) for name in (*TRUTHS, *NUMBERS) if hasattr(answers, name)}
    found = {name: value for name, value in found.items() if value is not None and name not in SILENT}
    if not found:
        raise EngineError(f"no answer: give a dict or an object with some of {', '.join((*TRUTHS, *NUMBERS))}, got {type(answers).__name__}")
    return found


def _array(name: str, value: Any) -> Array:
    # A gradient is of no interest here, so a tensor that has one is taken without it.
    if getattr(value, "requires_grad", False) is True and hasattr(value, "detach"):
        value = value.detach()
    try:
        return numpy_array(value)
    except UNREADABLE as error:
        raise EngineError(f"{name} cannot be read as an array: {error}") from error


def answers_of(answers: Any, count: int, scalar: str) -> dict[str, Array]:
    """An engine's answers as arrays under the names of columns, of the engine's scalar, each with a row a question."""
    checked = {}
    for name, value in _named(answers).items():
        array = _array(name, value)
        if name in TRUTHS:
            if array.dtype.kind != "b" and not (array.dtype.kind in "iu" and np.isin(array, (0, 1)).all()):
                raise EngineError(f"{name} must be truth values, got {array.dtype}")
            checked[name] = array.astype(bool)
        else:
            checked[name] = _numbers(name, array, scalar)
        shape: tuple[int | str, ...] = (count, *NUMBERS.get(name, ()))
        if name in LISTS:
            most = array.shape[1] if array.ndim > 1 else 0
            shape = (count, most if 1 <= most <= MOST_POINTS else f"from 1 to {MOST_POINTS}", *NUMBERS[name])
        if array.shape != shape:
            raise EngineError(f"{name} must have the shape {shape}, a row a question, got {array.shape}")
    if len({checked[name].shape[1] if name in checked else 0 for name in LISTS}) > 1:
        raise EngineError("points and depths go together: each point has a depth")
    return checked


def _numbers(name: str, array: Array, scalar: str) -> Array:
    if array.dtype.kind != "f" or array.dtype.itemsize not in (4, 8):
        raise EngineError(f"{name} must be binary64 or binary32 numbers, got {array.dtype}")
    if scalar == "binary64":
        return array.astype(np.float64)
    # Rounding them here would be arithmetic that the engine does not do.
    if array.dtype.itemsize != 4:
        raise EngineError(f"{name} is binary64, and the engine's scalar is binary32; give float32, or scalar='binary64'")
    return array.astype(np.float32)


def is_unsupported(answers: Any) -> bool:
    return answers is None or answers is NotImplemented


@dataclass
class Asking:
    """The function that the judge calls. An engine that raises is not asked again: the judge stops with its exception."""

    engine: Engine

    def __call__(self, pair: str, scalar: str, columns: Mapping[str, Any]) -> dict[str, Array]:
        questions = questions_of(pair, scalar, columns)
        try:
            answers = self.engine(questions)
            if is_unsupported(answers):
                return unsupported(len(questions))
            return answers_of(answers, len(questions), scalar)
        except NotImplementedError:
            return unsupported(len(questions))
        except EngineError as error:
            raise EngineError(f"{pair}: {error}", pair, first_line(questions)) from error.__cause__
        except Exception as error:
            raise EngineError(f"{pair}: the engine raised {type(error).__name__}: {error}", pair, first_line(questions)) from error


def unsupported(count: int) -> dict[str, Array]:
    """No answer to any question. The core passes over the claims of such rows, but wants some."""
    return {"unsupported": np.ones(count, bool), "hit": np.zeros(count, bool)}


def claims_of(ask: Asking, pairs: tuple[str, ...], scalar: str) -> list[str] | None:
    """What every answer of an engine has, by its answers to one question of each pair; None where it answers none.

    The core would take what the first answers have for what all have, also where those are of two boxes.
    """
    claimed: list[list[str]] = []
    numbers: list[set[str]] = []
    for pair in pairs:
        questions = generate(pair, "generic", 1, scalar=scalar)
        answers = ask(pair, scalar, dict(zip(pair_named(pair).columns, dict(**questions).values())))
        if "unsupported" in answers and answers["unsupported"].all():
            continue
        claimed.append([*(name for name in ("overlap", "contact") if name in answers or "hit" in answers)])
        if pair_named(pair).numbers != "none":
            numbers.append({name for name in CLAIMS if name in answers})
    if not claimed:
        return None
    decisions = [name for name in ("overlap", "contact") if all(name in names for names in claimed)]
    return decisions + [name for name in CLAIMS if numbers and all(name in names for names in numbers)]


def points_of(claims: Iterable[str]) -> dict[str, str]:
    """The convention that points have by their names: one point can only be the middle, several are a manifold."""
    return {"points": "midpoint"} if "point" in claims else {"points": "manifold"} if "points" in claims else {}


def first_line(questions: Questions) -> str | None:
    return str(questions[0]) if len(questions) else None


def by_pair(engine: Engine | Mapping[str, Engine]) -> tuple[Engine, tuple[str, ...] | None]:
    """An engine, and the pairs that it names: a dict has a function for each of its pairs."""
    if not isinstance(engine, Mapping):
        if not callable(engine):
            raise InputError("must be a function of questions, or a dict of them by pair", "engine", value=type(engine).__name__)
        return engine, None
    for pair in engine:
        pair_named(pair)
    return _ByPair(dict(engine)), tuple(pair for pair in PAIRS if pair in engine)


@dataclass
class _ByPair:
    engines: dict[str, Engine]

    def __call__(self, questions: Questions) -> Any:
        engine = self.engines.get(questions.pair)
        return None if engine is None else engine(questions)


def _serve(connection: Any, engine: Engine) -> None:
    """The engine's process: answers until it is told to stop."""
    while (asked := connection.recv()) is not None:
        pair, scalar, arrays = asked
        try:
            answers = engine(Questions(pair, arrays, scalar))
            reply: tuple[str, Any] = ("answers", None if is_unsupported(answers) else answers_of(answers, len(arrays["alarm"]), scalar))
        except NotImplementedError:
            reply = ("answers", None)
        except EngineError as error:
            reply = ("no answer", str(error))
        except Exception as error:
            reply = ("raised", f"{type(error).__name__}: {error}\n{traceback.format_exc()}")
        connection.send(reply)


class Isolated:
    """An engine in a process of its own: what ends the process, or hangs it, ends no other."""

    def __init__(self, engine: Engine, limit: float | None) -> None:
        context = multiprocessing.get_context("spawn")
        self._limit = limit
        self._connection, theirs = context.Pipe()
        self._process = context.Process(target=_serve, args=(theirs, engine), daemon=True)
        try:
            self._process.start()
        except Exception as error:  # pickle raises its own kinds beside Python's
            raise InputError(f"cannot be sent to another process: {error}", "engine") from error
        theirs.close()

    def __call__(self, questions: Questions) -> Any:
        try:
            self._connection.send((questions.pair, questions.scalar, dict(**questions)))
            if not self._connection.poll(self._limit):
                raise EngineError(f"the engine's process gave no answer within {self._limit} seconds")
            kind, reply = self._connection.recv()
        except (EOFError, BrokenPipeError, ConnectionResetError):
            self._process.join()
            raise EngineError(f"the engine's process ended, {_how_ended(self._process.exitcode)}") from None
        if kind == "raised":
            raise EngineError(f"the engine raised {reply}")
        if kind == "no answer":
            raise EngineError(reply)
        return reply

    def __enter__(self) -> Isolated:
        return self

    def __exit__(self, *_: Any) -> None:
        try:
            self._connection.send(None)
            self._process.join(1)
        except OSError:
            pass
        if self._process.is_alive():
            self._process.kill()
        self._process.join()
        self._connection.close()


def _how_ended(code: int | None) -> str:
    return f"by signal {-code}" if code is not None and code < 0 else f"with exit status {code}"
