"""A script becomes an engine for ``contact-oracle certify --engine-command``: JSON lines on standard input and output."""
from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from .engines import NUMBERS, Engine, answers_of, by_pair, is_unsupported
from .errors import EngineError, InputError
from .pairs import PAIRS, Array, number_of, pair_named, scalar_named
from .questions import Questions, stacked
from .shapes import _json_value, json_number, plain

CHUNK = 1 << 20


def serve(engine: Engine | Mapping[str, Engine], *, name: str | None = None, version: str = "1", pairs: str | Iterable[str] | None = None,
          scalar: str = "binary64", conventions: Mapping[str, Any] | None = None, pair_conventions: Mapping[str, Any] | None = None,
          bounds: Mapping[str, float] | None = None, claims: Iterable[str] | None = None, tolerance: Mapping[str, Any] | None = None,
          rounds: Iterable[str] | None = None) -> None:
    """Answers the engine protocol until the host says stop or closes the pipe. Arguments as of `certify`.

    All questions that have arrived are one batch for each pair. What the engine, or a library in it, prints goes to standard error.

    >>> import subprocess, sys
    >>> script = "import contact_oracle; contact_oracle.serve(lambda questions: questions.answer(), pairs='sphere_sphere', name='mine')"
    >>> host = '{"op":"hello","protocol":1}\\n{"op":"stop"}\\n'
    >>> subprocess.run([sys.executable, "-c", script], input=host, capture_output=True, text=True).stdout[:64]
    '{"op":"hello","protocol":1,"engine":{"name":"mine","version":"1"'
    """
    asked_engine, served = by_pair(engine)
    if pairs is None:
        named = served if served is not None else tuple(PAIRS)
    else:
        named = tuple(pair_named(pair).name for pair in ([pairs] if isinstance(pairs, str) else pairs))
    hello = {"op": "hello", "protocol": 1, "engine": {"name": name or getattr(engine, "__name__", "python"), "version": version},
             "scalar": scalar_named(scalar), "pairs": list(named), "conventions": conventions, "pair_conventions": pair_conventions,
             "bounds": bounds, "claims": None if claims is None else list(claims), "tolerance": tolerance,
             "rounds": None if rounds is None else list(rounds)}
    Conversation(asked_engine, plain({key: value for key, value in hello.items() if value is not None}), scalar).on_standard_streams()


class Conversation:
    """What an engine says to its host."""

    def __init__(self, engine: Engine, hello: dict[str, Any], scalar: str) -> None:
        self._engine, self._hello, self._scalar = engine, hello, scalar

    def on_standard_streams(self) -> None:
        sys.stdout.flush()
        # The descriptor itself moves, so that what C and Fortran print in the engine does not break the conversation either.
        replies = os.dup(1)
        os.dup2(2, 1)
        try:
            self.converse(0, replies)
        except BrokenPipeError:
            pass  # a host that has closed wants no more answers
        finally:
            sys.stdout.flush()
            os.dup2(replies, 1)
            os.close(replies)

    def converse(self, questions: int, replies: int) -> None:
        """Answers what comes from one descriptor on another, until the host says stop or closes."""
        rest = b""
        # read gives what has arrived and waits only where nothing has: what arrived together is answered together.
        while chunk := os.read(questions, CHUNK):
            *lines, rest = (rest + chunk).split(b"\n")
            messages = [json.loads(line, parse_int=float) for line in lines if line.strip()]
            stops = next((at for at, message in enumerate(messages) if message["op"] == "stop"), len(messages))
            self._reply(replies, messages[:stops])
            if stops < len(messages):
                return

    def _reply(self, replies: int, messages: list[dict[str, Any]]) -> None:
        out: list[dict[str, Any]] = [self._hello for message in messages if message["op"] == "hello"]
        queries: dict[str, list[dict[str, Any]]] = {}
        for message in messages:
            if message["op"] == "query":
                queries.setdefault(message["pair"], []).append(message)
        for pair, asked in queries.items():
            answers = self._answers(pair, asked)
            out += [{"op": "answer", "seq": int(query["seq"]), **answer} for query, answer in zip(asked, answers)]
        data = "".join(json.dumps(reply, separators=(",", ":"), allow_nan=False) + "\n" for reply in out).encode()
        while data:
            data = data[os.write(replies, data):]

    def _answers(self, pair: str, queries: list[dict[str, Any]]) -> list[dict[str, Any]]:
        try:
            answers = self._engine(_questions(pair, queries, self._scalar))
            if is_unsupported(answers):
                return [{"unsupported": "the engine gave no answer"}] * len(queries)
            return lines_of(answers_of(answers, len(queries), self._scalar))
        except NotImplementedError as error:
            return [{"unsupported": str(error) or "not implemented"}] * len(queries)
        except Exception as error:
            if len(queries) == 1:
                return [_refusal(error)]
            # One question must not spoil the answers of those that arrived with it.
            return [self._answers(pair, [query])[0] for query in queries]


def _refusal(error: Exception) -> dict[str, Any]:
    if isinstance(error, InputError) and error.field:
        return {"rejected": error.field}
    return {"error": str(error) if isinstance(error, EngineError) else f"{type(error).__name__}: {error}"}


def _questions(pair: str, queries: list[dict[str, Any]], scalar: str) -> Questions:
    description = pair_named(pair)
    number = number_of(scalar)
    def array_of(value: Any) -> Array:
        return np.array(value, dtype=object).astype(np.float64)

    arrays: dict[str, Array] = {}
    for field in description.fields:
        values = [query[field.side][field.name] for query in queries]
        arrays[field.argument] = stacked(list(map(array_of, values))) if field.any_number else array_of(values)
    arrays |= {name: np.array([float(query[name]) for query in queries]) for name in ("alarm", "contact")}
    with np.errstate(over="ignore"):
        return Questions(pair, {name: array.astype(number) for name, array in arrays.items()}, scalar)


def lines_of(answers: Mapping[str, Array]) -> list[dict[str, Any]]:
    """Answers in columns as answers in lines: what docs/formats.md#answers-in-columns says that columns claim."""
    overlap = answers.get("overlap", answers.get("hit"))
    contact = answers.get("contact", answers.get("hit"))
    numbers = {name: array for name, array in answers.items() if name in NUMBERS}
    if "points" in numbers:  # rows of NaN at the end are not there
        there = ~(np.isnan(numbers["points"]).all(axis=2) & np.isnan(numbers["depths"]))
        several = np.where(there, np.arange(1, there.shape[1] + 1), 0).max(axis=1)
    count = len(next(iter(answers.values())))
    silent = answers.get("unsupported", np.zeros(count, bool))
    lines = []
    for row in range(count):
        line: dict[str, Any] = {}
        if silent[row]:
            lines.append({"unsupported": "the engine does not answer this question"})
            continue
        if overlap is not None:
            line["overlap"] = bool(overlap[row])
        if contact is not None or numbers:
            found = bool(contact[row]) if contact is not None else not all(np.isnan(array[row]).all() for array in numbers.values())
            if numbers:
                of_row = {name: array[row] for name, array in numbers.items()}
                if "points" in numbers:
                    of_row |= {name: of_row[name][:several[row]] for name in ("points", "depths")}
                line["contact"] = {name: json_number(value) if name == "value" else _json_value(value)
                                   for name, value in of_row.items() if len(np.atleast_1d(value))} if found else None
            elif "contact" in answers:
                line["contact"] = {} if found else None
        lines.append(line)
    return lines
