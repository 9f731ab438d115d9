"""Answers: arrays by name, one row a question."""
from __future__ import annotations

import html
from collections.abc import Iterator
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

ROWS_SHOWN = 10


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
        return len(self.hit)

    def __bool__(self) -> bool:
        if np.ndim(self.hit) != 0:
            raise ValueError("whether several contacts are true is not one question: say .hit.any() or .hit.all()")
        return bool(self.hit)

    def __getitem__(self, index: Any) -> Contacts:
        if np.ndim(self.hit) == 0:
            raise IndexError("a single contact has no rows")
        # The shape of `hit` alone is indexed, so an index cannot reach into the coordinates.
        rows = np.arange(np.size(self.hit)).reshape(np.shape(self.hit))[index]
        taken = {}
        for name, array in self._arrays().items():
            array = np.asarray(array)
            taken[name] = array.reshape((-1, *array.shape[np.ndim(self.hit):]))[rows]
        return Contacts(**taken)

    def __iter__(self) -> Iterator[Contacts]:
        return (self[row] for row in range(len(self)))

    def to_dataframe(self) -> Any:
        """A pandas.DataFrame, one row a question, coordinates in columns of their own: ``normal_x``, ..."""
        import pandas

        columns: dict[str, Any] = {}
        for name, array in self._arrays().items():
            flat = np.asarray(array).reshape((np.size(self.hit), -1))
            columns |= {name + suffix: flat[:, axis] for axis, suffix in enumerate(("_x", "_y", "_z") if flat.shape[1] == 3 else ("",))}
        return pandas.DataFrame(columns)

    def _repr_html_(self) -> str:
        single = np.ndim(self.hit) == 0
        flat = {name: np.asarray(array).reshape((np.size(self.hit), *np.shape(array)[np.ndim(self.hit):]))
                for name, array in self._arrays().items()}
        rows = min(np.size(self.hit), ROWS_SHOWN)
        head = "".join(f"<th>{name}</th>" for name in (() if single else ("",)) + tuple(flat))
        body = "".join("<tr>" + ("" if single else f"<th>{row}</th>")
                       + "".join(f"<td>{html.escape(_text(array[row]))}</td>" for array in flat.values()) + "</tr>" for row in range(rows))
        rest = np.size(self.hit) - rows
        return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>" + (f"<p>and {rest} more</p>" if rest else "")


def _text(value: Any) -> str:
    return str(value) if np.ndim(value) == 0 else "(" + ", ".join(map(str, value)) + ")"
