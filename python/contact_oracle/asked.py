"""From arrays of any kind to the columns that the core reads, and from a row of the core back to the caller's array."""
from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _core
from .arrays import UNREADABLE, in_library, library_of, numpy_array
from .errors import InputError, errors_of_core
from .pairs import Array, Pair

NUMBERS = "must be binary64 or binary32 numbers, or integers"


def _numpy_array(argument: str, value: Any) -> Array:
    if isinstance(value, np.ma.MaskedArray) and np.any(np.asarray(value.mask)):
        raise InputError("must have no masked numbers", argument)
    # A detached copy would answer too, and a gradient would be zero without a word.
    if getattr(value, "requires_grad", False) is True:
        raise InputError("requires a gradient, which no answer here has; give what its detach() returns", argument)
    try:
        return numpy_array(value)
    except UNREADABLE as error:
        raise InputError(f"cannot be read as an array: {error}", argument) from error


def array_of(argument: str, value: Any) -> Array:
    """The value as an array of binary64 or binary32 in the processor's own order of bytes; not copied where it is one."""
    array = _numpy_array(argument, value)
    if array.dtype.kind == "f" and array.dtype.itemsize in (4, 8):
        return array.astype(array.dtype.newbyteorder("="), copy=False)
    if array.dtype.kind not in "iu":
        raise InputError(NUMBERS, argument, value=array.dtype)
    rounded = array.astype(np.float64)
    # The largest integers round up to 2^63 and 2^64, which are out of their type's range: compare as Python's integers.
    large = np.abs(rounded) >= 2.0**53
    for at in np.argwhere(large):
        index = tuple(map(int, at))
        if int(rounded.item(index)) != array.item(index):
            raise InputError("is no binary64 number", argument, index, array.item(index))
    return rounded


def _is_binary32(array: Array) -> Array:
    with np.errstate(over="ignore", invalid="ignore"):
        return np.asarray((array.astype(np.float32) == array) | np.isnan(array))


def _has_a_format(value: Any) -> bool:
    """Python's own numbers, and lists of them, have none: they follow the arrays beside them."""
    return hasattr(value, "__array__") or hasattr(value, "__dlpack__")


@dataclass(frozen=True)
class Asked:
    """Questions as the core reads them: `columns` are (N, *shape), binary64 or binary32 each, and `batch` is the shape that N stands for.

    library  what the answers are arrays of; None is NumPy
    """

    pair: Pair
    scalar: str
    batch: tuple[int, ...]
    columns: list[Array]
    alarm: Array
    contact: Array
    given: dict[str, Array]
    library: Any

    def answered(self, array: Any, shape: tuple[int, ...] | None = None) -> Any:
        """Rows of the core in the shape of the batch, and of their own, as the caller's kind of array."""
        array = np.asarray(array)
        array = array.reshape(self.batch + (array.shape[1:] if shape is None else shape))
        # [()] makes the arrays of a single question numbers, as NumPy's own functions do.
        return array[()] if self.library is None else in_library(self.library, array)

    @property
    def all_columns(self) -> list[Array]:
        return [*self.columns, self.alarm, self.contact]

    @contextmanager
    def naming_errors(self) -> Iterator[None]:
        """A number outside the domain is named as the caller gave it."""
        with errors_of_core():
            try:
                yield
            except _core.DomainError as error:
                raise self._input_error(*error.args) from None

    def _input_error(self, field: str, row: int, value: float, rule: str) -> InputError:
        path, *within = field.replace("]", "").split("[")
        side, _, name = path.rpartition(".")
        argument = name + {"a": "1", "b": "2", "": ""}[side]
        given = self.given[argument]
        core = len(dict(zip(self.pair.arguments, self.pair.numbers_of_a_question))[argument].shape)
        place = np.unravel_index(row, self.batch) if self.batch else ()
        own = given.shape[:given.ndim - core]
        place = tuple(place)[len(self.batch) - len(own):]
        index = tuple(0 if size == 1 else int(at) for at, size in zip(place, own)) + tuple(map(int, within))
        return InputError(rule, argument, index, value, field)


def asked(pair: Pair, values: Mapping[str, Any]) -> Asked:
    """The questions that the arguments of a pair are."""
    try:
        library = library_of(values[name] for name in pair.arguments)
    except TypeError as error:
        raise InputError(str(error)) from None
    given = {name: array_of(name, values[name]) for name in pair.arguments}
    formats = {given[name].dtype for name in pair.arguments if _has_a_format(values[name])}
    scalar = "binary32" if formats == {np.dtype(np.float32)} else "binary64"
    leading = []
    cores = []
    for name, field in zip(pair.arguments, pair.numbers_of_a_question):
        array = given[name]
        before = max(array.ndim - len(field.shape), 0)
        if not field.fits(array.shape[before:]):
            raise InputError(f"must have the shape {field.shape_text}", name, value=f"shape {array.shape}")
        leading.append(array.shape[:before])
        cores.append(array.shape[before:])
        if scalar == "binary32" and array.dtype != np.float32:
            wrong = np.argwhere(~_is_binary32(array))
            if len(wrong):
                index = tuple(map(int, wrong[0]))
                raise InputError("is no binary32 number, as the arrays beside it are; give numpy.float32 of it, or arrays of binary64",
                                 name, index, array[index])
    try:
        batch = np.broadcast_shapes(*leading)
    except ValueError:
        shapes = ", ".join(f"{name} {shape}" for name, shape in zip(pair.arguments, leading) if shape)
        raise InputError(f"numbers of questions do not go together: {shapes}") from None
    count = math.prod(batch)
    columns = [_column(given[name], batch, count, core) for name, core in zip(pair.arguments, cores)]
    return Asked(pair, scalar, batch, columns[:-2], columns[-2], columns[-1], given, library)


def _column(array: Array, batch: tuple[int, ...], count: int, core: tuple[int, ...]) -> Array:
    if array.shape != batch + core:
        array = np.broadcast_to(array, batch + core)
    return array if len(batch) == 1 else array.reshape((count, *core))
