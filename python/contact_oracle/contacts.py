"""Answers: arrays by name, one row a question."""
from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from .arrays import in_library, library_of, numpy_array
from .shown import table


@dataclass(frozen=True, eq=False)
class Contacts:
    """Whether shapes touch, and where. Rows of misses are NaN. Two boxes have ``hit`` alone; the rest is None.

    hit         (N,) bool, the alarm distance included
    normal      (N, 3) of length 1, from the first shape to the second
    point1      (N, 3) the contact point of the first shape
    point2      (N, 3) the contact point of the second shape
    value       (N,) signed distance of the surfaces, less the contact distance
    degenerate  (N,) bool, where there is no direction and the normal is an agreement
    unique      (N,) bool, false where many points are nearest

    A single question has arrays without the first axis.

    Numbers are of the scalar and arrays of the library of those that asked (docs/python.md#arrays); lengths are in their unit.
    TypeError for the length of a single one, ValueError for the truth of several.

    >>> import contact_oracle
    >>> contacts = contact_oracle.sphere_sphere((0, 0, 0), 1, [(2, 0, 0), (5, 0, 0)], 1)
    >>> contacts.hit, contacts[0].value
    (array([ True, False]), 0.0)
    """

    hit: Any
    normal: Any = None
    point1: Any = None
    point2: Any = None
    value: Any = None
    degenerate: Any = None
    unique: Any = None

    def _arrays(self) -> dict[str, Any]:
        return {field.name: getattr(self, field.name) for field in fields(self) if getattr(self, field.name) is not None}

    def __len__(self) -> int:
        if np.ndim(self.hit) == 0:
            raise TypeError("a single contact has no length")
        return int(self.hit.shape[0])

    def __bool__(self) -> bool:
        if np.ndim(self.hit) != 0:
            raise ValueError("whether several contacts are true is not one question: say .hit.any() or .hit.all()")
        return bool(self.hit)

    def __getitem__(self, index: Any) -> Contacts:
        if np.ndim(self.hit) == 0:
            raise IndexError("a single contact has no rows")
        # The shape of `hit` alone is indexed, so an index cannot reach into the coordinates.
        batch = numpy_array(self.hit).shape
        rows = np.arange(math.prod(batch)).reshape(batch)[index]
        library = library_of([self.hit])
        taken = {}
        for name, given in self._arrays().items():
            array = numpy_array(given)
            taken[name] = in_library(library, array.reshape((-1, *array.shape[len(batch):]))[rows])
        return Contacts(**taken)

    def __iter__(self) -> Iterator[Contacts]:
        return (self[row] for row in range(len(self)))

    def to_dataframe(self) -> Any:
        """A pandas.DataFrame, one row a question, coordinates in columns of their own: ``normal_x``, ..."""
        import pandas

        columns: dict[str, Any] = {}
        batch = np.ndim(self.hit)
        for name, given in self._arrays().items():
            array = numpy_array(given)
            flat = array.reshape((math.prod(array.shape[:batch]), math.prod(array.shape[batch:])))
            columns |= {name + suffix: flat[:, axis] for axis, suffix in enumerate(("_x", "_y", "_z") if flat.shape[1] == 3 else ("",))}
        return pandas.DataFrame(columns)

    def _repr_html_(self) -> str:
        return table(self._arrays(), np.ndim(self.hit))
