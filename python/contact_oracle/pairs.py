"""The pairs: what the core says of them, and the names that their fields have as arguments."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _core
from .errors import InputError

Array = np.ndarray[Any, np.dtype[Any]]


@dataclass(frozen=True)
class Field:
    """A field of one of the two shapes of a pair."""

    name: str
    kind: str
    shape: tuple[int, ...]
    side: str

    @property
    def argument(self) -> str:
        """``center1`` for the centre of the first shape."""
        return self.name + ("1" if self.side == "a" else "2")

    @property
    def column(self) -> str:
        """``a/center``, the name in files of columns."""
        return f"{self.side}/{self.name}"


@dataclass(frozen=True)
class Pair:
    """Two kinds of shape. ``numbers`` says whether a contact has a distance, is a crossing, is where a ray hits, or has no numbers."""

    name: str
    numbers: str
    shapes: tuple[str, str]
    fields: tuple[Field, ...]

    @property
    def has_edge(self) -> bool:
        """Whether a length decides, as an alarm distance does: not of crossings, nor of rays that are cast."""
        return self.numbers not in ("crossing", "cast")

    @property
    def arguments(self) -> tuple[str, ...]:
        return (*(field.argument for field in self.fields), "alarm", "contact")

    @property
    def columns(self) -> tuple[str, ...]:
        return (*(field.column for field in self.fields), "alarm", "contact")

    @property
    def core_shapes(self) -> tuple[tuple[int, ...], ...]:
        """The shape of each argument of one question, in the order of `arguments`."""
        return (*(field.shape for field in self.fields), (), ())


def _described(entry: dict[str, Any]) -> Pair:
    fields = tuple(Field(field["name"], field["kind"], tuple(field["shape"]), side)
                   for side in ("a", "b") for field in entry[side]["fields"])
    return Pair(entry["name"], entry["numbers"], (entry["a"]["shape"], entry["b"]["shape"]), fields)


PAIRS: dict[str, Pair] = {entry["name"]: _described(entry) for entry in _core.pairs()}


def pair_named(name: str) -> Pair:
    if name not in PAIRS:
        raise InputError(f"must be one of {', '.join(PAIRS)}", "pair", value=repr(name))
    return PAIRS[name]


def scalar_named(name: str) -> str:
    if name not in ("binary64", "binary32"):
        raise InputError("must be binary64 or binary32", "scalar", value=repr(name))
    return name


def number_of(scalar: str) -> type[Any]:
    """NumPy's name of a scalar."""
    return np.float32 if scalar_named(scalar) == "binary32" else np.float64
