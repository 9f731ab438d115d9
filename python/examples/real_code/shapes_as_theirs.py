"""Questions as engines take them: a capsule by its middle, an axis and half its length, a rotated box by its matrix, a plane by a unit normal.
Each is computed in double precision, and rounded once to the engine's scalar."""
from dataclasses import dataclass

import numpy as np


@dataclass
class Geoms:
    """N shapes of one kind: where they are, how they are turned, and their sizes in the engine's order (radius and half length; half lengths)."""
    positions: np.ndarray
    matrices: np.ndarray
    sizes: np.ndarray

    def rounded(self, number):
        return Geoms(self.positions.astype(number), self.matrices.astype(number), self.sizes.astype(number))

    @property
    def axes(self):
        return self.matrices[:, :, 2]


def _along(directions):
    """Matrices whose third column is the direction, of length 1: z where it has none."""
    lengths = np.linalg.norm(directions, axis=1, keepdims=True)
    z = np.where(lengths > 0, directions / np.where(lengths > 0, lengths, 1), [0.0, 0.0, 1.0])
    least = np.eye(3)[np.argmin(np.abs(z), axis=1)]
    x = np.cross(least, z)
    x /= np.linalg.norm(x, axis=1, keepdims=True)
    return np.stack([x, np.cross(z, x), z], axis=2)


def _turned(quaternions):
    """Matrices of quaternions x, y, z, w of any length."""
    q = quaternions / np.abs(quaternions).max(axis=1, keepdims=True)
    x, y, z, w = (q / np.linalg.norm(q, axis=1, keepdims=True)).T
    return np.stack([np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)], axis=1),
                     np.stack([2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)], axis=1),
                     np.stack([2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)], axis=1)], axis=1)


def geoms(questions, which, number):
    """The first or the second shapes of the questions; which is 1 or 2."""
    kind = [name for name in questions.pair.split("_") if name != "rigid"][which - 1]
    part = lambda name: np.asarray(questions[f"{name}{which}"], np.float64)
    unturned = lambda count: np.broadcast_to(np.eye(3), (count, 3, 3))
    nothing = np.zeros(len(questions))
    if kind == "sphere":
        made = Geoms(part("center"), unturned(len(questions)), np.stack([part("radius"), nothing, nothing], axis=1))
    elif kind == "capsule":
        way = part("end") - part("start")
        half = np.linalg.norm(way, axis=1) / 2
        made = Geoms(part("start") + way / 2, _along(way), np.stack([part("radius"), half, nothing], axis=1))
    elif kind == "cube":
        made = Geoms((part("min") + part("max")) / 2, unturned(len(questions)), (part("max") - part("min")) / 2)
    elif kind == "obb":
        made = Geoms(part("center"), _turned(part("orientation")), part("extents"))
    elif kind == "plane":
        normal = part("normal")
        made = Geoms(normal * (part("offset") / (normal * normal).sum(axis=1))[:, np.newaxis], _along(normal), np.zeros((len(questions), 3)))
    else:
        raise KeyError(kind)
    return made.rounded(number)


def flat(questions):
    """Of which questions a box has no thickness or a capsule no length: the compilers of these engines refuse such a shape, or nobody means it."""
    none = np.zeros(len(questions), bool)
    for which in (1, 2):
        if f"extents{which}" in questions.keys():
            none |= (questions[f"extents{which}"] == 0).any(axis=1)
        if f"min{which}" in questions.keys():
            none |= (questions[f"min{which}"] == questions[f"max{which}"]).any(axis=1)
        if f"start{which}" in questions.keys():
            none |= (questions[f"start{which}"] == questions[f"end{which}"]).all(axis=1)
    return none


def deepest(values, normals, points):
    """Of some contacts of each question (N x M) the deepest, as the answer of the package's engines."""
    rows, which = np.arange(len(values)), np.argmin(values, axis=1)
    return {"value": values[rows, which], "normal": normals[rows, which], "point": points[rows, which]}


def manifold(values, normals, points, there):
    """All contacts that are there: the deepest gives value and normal."""
    of = deepest(np.where(there, values, np.inf), normals, points)
    hidden = np.array(np.nan, values.dtype)
    order = np.argsort(~there, axis=1, kind="stable")
    rows = np.arange(len(values))[:, np.newaxis]
    there = there[rows, order]
    return {"value": of["value"], "normal": of["normal"], "points": np.where(there[:, :, np.newaxis], points[rows, order], hidden),
            "depths": np.where(there, -values[rows, order], hidden)}


def nearest_on_triangle(questions, nearest):
    """The answer of an engine that says which point of a triangle is nearest to a sphere's centre (N x 3). It claims no normal."""
    delta = nearest - questions.center1
    value = np.sqrt((delta * delta).sum(axis=1)) - questions.radius1
    return {"hit": value <= questions.alarm, "value": value, "point2": nearest}


NEAREST_ON_TRIANGLE = {"normal": "none", "points": "second_only"}
