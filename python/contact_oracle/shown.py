"""What a notebook shows, as HTML, and figures where matplotlib is installed."""
from __future__ import annotations

import html
import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from .arrays import Array, numpy_array
from .errors import InputError
from .pairs import rows_of_rotation

if TYPE_CHECKING:
    from .shapes import Question, Shape

ROWS_SHOWN = 10


def table(columns: Mapping[str, Any], batch: int = 1) -> str:
    """The first rows of some arrays, whose first `batch` axes are those of rows; where there are none, the one that there is."""
    arrays = {name: numpy_array(array) for name, array in columns.items()}
    count = math.prod(next(iter(arrays.values())).shape[:batch])
    arrays = {name: array.reshape((count, *array.shape[batch:])) for name, array in arrays.items()}
    if batch:
        arrays = {"": np.arange(count), **arrays}
    head = "".join(f"<th>{name}</th>" for name in arrays)
    body = "".join("<tr>" + "".join(f"<td>{html.escape(_text(array[row]))}</td>" for array in arrays.values()) + "</tr>" for row in range(min(count, ROWS_SHOWN)))
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>" + (f"<p>and {count - ROWS_SHOWN} more</p>" if count > ROWS_SHOWN else "")


def _text(value: Any) -> str:
    return str(value) if np.ndim(value) == 0 else "(" + ", ".join(map(str, np.ravel(value))) + ")"


def text(words: object) -> str:
    """As a terminal shows it."""
    return f"<pre>{html.escape(str(words))}</pre>"


def _axes(**how: Any) -> Any:
    # A figure of its own, not pyplot's: nothing is opened, and nothing has to be closed.
    try:
        from matplotlib.figure import Figure
    except ImportError:
        raise InputError("figures need matplotlib, which is not installed") from None
    return Figure(figsize=(7, 5), layout="constrained").add_subplot(**how)


DIRECTIONS = ("normal", "direction", "orientation")


def _parts(shape: Shape) -> dict[str, Array]:
    """The fields of a shape, directions of length 1, and with them the lengths that they are units of."""
    parts = {name: np.asarray(value, float) for name, value in vars(shape).items()}
    for name in set(parts) & set(DIRECTIONS):
        largest = np.abs(parts[name]).max()
        parts[name] = parts[name] / largest
        length = np.linalg.norm(parts[name])
        parts[name] = parts[name] / length
        with np.errstate(over="ignore"):
            if name == "direction":
                parts["length"] = parts["length"] * largest * length
            elif name == "normal":
                parts["offset"] = parts["offset"] / largest / length
    return parts


def _farthest(parts: Mapping[str, Array], way: Array) -> Array:
    """The points of a shape that are farthest in some directions (..., 3): where its surface is seen from there."""
    if "extents" in parts:
        turn = np.array(rows_of_rotation(parts["orientation"]))  # of length 1
        return np.asarray(parts["center"] + (parts["extents"] * np.sign(way @ turn)) @ turn.T)
    if "min" in parts:
        return np.where(way > 0, parts["max"], parts["min"])
    if "vertices" in parts:
        corners = parts["vertices"]
    elif "direction" in parts:
        corners = parts["origin"] + np.outer(np.array([0, parts["length"]]), parts["direction"])
    else:
        corners = np.stack([parts["center"]] if "center" in parts else [parts["start"], parts["end"]])
    return np.asarray(corners[np.argmax(way @ corners.T, axis=-1)] + parts.get("radius", 0) * way)


def figure_of_case(question: Question) -> Any:
    """A matplotlib Figure of both shapes, with contact points and normal where there is a contact."""
    axes = _axes(projection="3d")
    shapes = {"a": _parts(question.a), "b": _parts(question.b)}
    # Axes of matplotlib fail at the ends of the exponents. What may be endless is drawn as far as the numbers of the rest reach.
    largest = max(np.abs(value).max() for parts in shapes.values() for name, value in parts.items() if name not in (*DIRECTIONS, "length")) or 1.0
    unit = 1.0 if 1e-9 < largest < 1e9 else 10.0 ** np.floor(np.log10(largest))
    shapes = {side: {name: value if name in DIRECTIONS else np.minimum(value, 4 * largest if largest < 1e300 else largest) / unit if name == "length" else value / unit
                     for name, value in parts.items()} for side, parts in shapes.items()}
    # No circle of directions goes along an axis, so that each finds one corner of a box.
    around, up = np.meshgrid(np.linspace(0.05, 0.05 + 2 * np.pi, 49), np.linspace(-np.pi / 2, np.pi / 2, 26))
    ways = np.stack([np.cos(up) * np.cos(around), np.cos(up) * np.sin(around), np.sin(up)], axis=-1)
    meshes = {side: _farthest(parts, ways) for side, parts in shapes.items() if "offset" not in parts}
    if "b" not in meshes:
        points = meshes["a"].reshape((-1, 3))
        middle, size = points.mean(axis=0), max(np.ptp(points, axis=0).max(), largest / unit * 1e-6)
        normal, offset = shapes["b"]["normal"], shapes["b"]["offset"]
        first = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
        first /= np.linalg.norm(first)
        s, t = (grid[..., np.newaxis] for grid in np.meshgrid(*[np.linspace(-size, size, 9)] * 2))
        meshes["b"] = middle + (offset - middle @ normal) * normal + s * first + t * np.cross(normal, first)
    for (side, mesh), colour in zip(meshes.items(), ("tab:blue", "tab:orange")):
        axes.plot_wireframe(*np.moveaxis(mesh, -1, 0), color=colour, linewidth=0.5, label=f"{side}: {type(getattr(question, side)).__name__}")
    answer = question.answer()
    if answer.hit and answer.normal is not None:
        length = max(np.ptp(mesh.reshape((-1, 3)), axis=0).max() for mesh in meshes.values()) / 4
        axes.scatter(*np.stack([answer.point1, answer.point2]).T.astype(float) / unit, color="black", label="contact points")
        axes.quiver(*answer.point1.astype(float) / unit, *answer.normal, length=length, color="tab:red", label="normal")
    axes.set(title=f"{question.pair}: " + ("a miss" if not answer.hit else "a hit" if answer.value is None else f"value {float(answer.value)!r}"),
             **{f"{name}label": name if unit == 1 else f"{name} in {unit:g}" for name in "xyz"})
    axes.set_aspect("equal")
    axes.legend()
    return axes.figure


def figure_of_errors(fields: Mapping[str, Any], title: str) -> Any:
    """A matplotlib Figure: how many claims of each field are how far off, in powers of two of an ulp of the field's scale."""
    axes = _axes()
    used = [power for field in fields.values() for power, _ in field["errors"]] or [0]
    right, no_number = min(used) - 2, max(used) + 2
    width = 0.8 / len(fields)
    for place, (name, field) in enumerate(fields.items()):
        bars = {right: field["correctly_rounded"], **dict(field["errors"]), no_number: field["not_finite"]}
        axes.bar(np.array(list(bars)) + width * place, list(bars.values()), width, align="edge", label=name)
    powers = range(min(used), max(used) + 1, (max(used) - min(used)) // 12 + 1)
    axes.set_xticks([right + 0.4, *powers, no_number + 0.4], ["right", *(f"$2^{{{power}}}$" for power in powers), "not\nfinite"])
    axes.set(title=title, xlabel="error in ulps of the field's scale: right, or from one power of two to the next", ylabel="claims", yscale="symlog")
    axes.set_ylim(bottom=0)
    axes.legend()
    return axes.figure
