"""trimesh's nearest point of a triangle, from a checkout or an installed `trimesh`. It needs no stand-in: trimesh is made of NumPy."""
import sys

from checkouts import folder_of, importing
from shapes_as_theirs import NEAREST_ON_TRIANGLE, nearest_on_triangle


def engines(path):
    """By the function's name: its pair, the engine, and what its answers mean. It computes in binary64, whatever it is given."""
    sys.path.insert(0, str(folder_of(path, "trimesh").parent))
    try:
        with importing({}, "trimesh") as module:
            closest_point = module("trimesh.triangles").closest_point
    finally:
        sys.path.pop(0)
    engine = lambda questions: nearest_on_triangle(questions, closest_point(questions.vertices2, questions.center1).astype(questions.alarm.dtype))
    return {"closest_point": ("sphere_triangle", engine, NEAREST_ON_TRIANGLE)}
