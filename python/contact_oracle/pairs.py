"""The pairs: what the core says of them, and the names that their fields have as arguments."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _core
from .arrays import Array as Array
from .errors import InputError


@dataclass(frozen=True)
class Field:
    """A field of one of the two shapes of a pair. Of a hull's vertices, `any_number`, the shape has as many as there may be."""

    name: str
    kind: str
    shape: tuple[int, ...]
    side: str
    any_number: bool = False

    @property
    def argument(self) -> str:
        """``center1`` for the centre of the first shape."""
        return self.name + ("1" if self.side == "a" else "2")

    @property
    def column(self) -> str:
        """``a/center``, the name in files of columns."""
        return f"{self.side}/{self.name}"

    def fits(self, shape: tuple[int, ...]) -> bool:
        """Whether an array of one question has such a shape."""
        if self.any_number:
            return len(shape) == 2 and 1 <= shape[0] <= self.shape[0] and shape[1:] == self.shape[1:]
        return shape == self.shape

    @property
    def shape_text(self) -> str:
        """``(..., 3)``"""
        if self.any_number:
            return f"(..., V, {self.shape[1]}), V from 1 to {self.shape[0]}"
        return f"(..., {', '.join(map(str, self.shape))})" if self.shape else "(...)"


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
    def numbers_of_a_question(self) -> tuple[Field, ...]:
        """The fields and the two distances, in the order of `arguments`."""
        return (*self.fields, Field("alarm", "length", (), ""), Field("contact", "length", (), ""))


def _described(entry: dict[str, Any]) -> Pair:
    fields = tuple(Field(field["name"], field["kind"], tuple(field["shape"]), side, field["any_number"])
                   for side in ("a", "b") for field in entry[side]["fields"])
    return Pair(entry["name"], entry["numbers"], (entry["a"]["shape"], entry["b"]["shape"]), fields)


PAIRS: dict[str, Pair] = {entry["name"]: _described(entry) for entry in _core.pairs()}


def pair_named(name: str) -> Pair:
    if not isinstance(name, str) or name not in PAIRS:
        raise InputError(f"must be one of {', '.join(PAIRS)}", "pair", value=repr(name))
    return PAIRS[name]


def scalar_named(name: str) -> str:
    if name not in ("binary64", "binary32"):
        raise InputError("must be binary64 or binary32", "scalar", value=repr(name))
    return name


def number_of(scalar: str) -> type[Any]:
    """NumPy's name of a scalar."""
    return np.float32 if scalar_named(scalar) == "binary32" else np.float64


def rows_of_rotation(quaternion: Any) -> Any:
    """The matrix of the rotation that a quaternion x, y, z, w is, times the quaternion's squared length: of integers exact."""
    x, y, z, w = quaternion
    size = x * x + y * y + z * z + w * w
    return ((size - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)), (2 * (x * y + z * w), size - 2 * (x * x + z * z), 2 * (y * z - x * w)),
            (2 * (x * z - y * w), 2 * (y * z + x * w), size - 2 * (x * x + y * y)))
