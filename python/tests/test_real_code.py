"""The example that runs other people's functions: its stand-ins for JAX and Warp on a small checkout made here, and on real ones where the
environment names them (CONTACT_MJX, CONTACT_NEWTON, CONTACT_TRIMESH)."""
import os
import pathlib
import re
import subprocess
import sys

import pytest

EXAMPLE = pathlib.Path(__file__).resolve().parents[1] / "examples" / "real_code"

MJX = {
    "math.py": """
import jax
from jax import numpy as jp
import mujoco

def with_length(x, axis=None):
    length = jp.linalg.norm(x, axis=axis)
    return x / (length + mujoco.mjMINVAL * (length == 0.0)), length

def frame(n):
    other = jp.where(jp.abs(n[0]) < 0.5, jp.array([1.0, 0.0, 0.0]), jp.array([0.0, 1.0, 0.0]))
    b, _ = with_length(jp.cross(n, other))
    return jp.array([n, b, jp.cross(n, b)])
""",
    "dataclasses.py": """
import dataclasses
import jax

class PyTreeNode:
    def __init_subclass__(cls):
        made = dataclasses.dataclass(frozen=True)(cls)
        made.replace = dataclasses.replace
        jax.tree_util.register_pytree_with_keys(made, None, None)
""",
    "collision_types.py": """
import jax
from mujoco.mjx._src.dataclasses import PyTreeNode

class GeomInfo(PyTreeNode):
    pos: jax.Array
    mat: jax.Array
    size: jax.Array
""",
    "collision_primitive.py": """
import jax
from jax import numpy as jp
from mujoco.mjx._src import math
from mujoco.mjx._src.collision_types import GeomInfo

def collider(count):
    def wrapper(function):
        def collide(m, d, _, geom: jax.Array):
            g1, g2 = geom.T
            found = jax.vmap(function)(*(GeomInfo(d.geom_xpos[g], d.geom_xmat[g], m.geom_size[g]) for g in (g1, g2)))
            return jax.tree_util.tree_map(jp.concatenate, found) if count > 1 else found
        return collide
    return wrapper

@collider(1)
def sphere_sphere(a, b):
    n, distance = math.with_length(b.pos - a.pos)
    n = jp.where(distance == 0.0, jp.array([1.0, 0.0, 0.0]), n)
    distance = distance - (a.size[0] + b.size[0])
    distance += FAULT
    return distance, a.pos + n * (a.size[0] + 0.5 * distance), math.frame(n)

@collider(2)
def plane_capsule(plane, capsule):
    n = plane.mat[:, 2]
    ends = jp.stack([capsule.pos + capsule.mat[:, 2] * capsule.size[1] * sign for sign in (1, -1)])
    distances = jax.vmap(jp.dot, in_axes=[0, None])(ends - plane.pos, n) - capsule.size[0]
    places = jp.tile(jp.array([0.0, 0.0, 0.0]), (2, 1))
    for i in range(2):
        places = places.at[i].set(ends[i] - n * (capsule.size[0] + 0.5 * distances[i]))
    return distances, places, jp.stack([math.frame(n)] * 2)
""",
    "collision_convex.py": "from mujoco.mjx._src.types import GeomType\nBOX = GeomType.BOX\n",
}

NEWTON = {
    "core/types.py": """
import warp as wp
from warp import DeviceLike
Vec3 = list[float] | tuple[float, float, float] | wp.vec3
Transform = tuple[Vec3, float] | wp.transform
MAXVAL = 1e10
""",
    "geometry/kernels.py": """
import warp as wp
from .types import GeoType
from ..utils.heightfield import HeightfieldData
FACE = wp.constant(6)

@wp.func
def at(lock: wp.array[wp.int32], mesh: wp.uint64, where: wp.vec3):
    return wp.mesh_get(mesh)
""",
    "geometry/support_function.py": """
import warp as wp

@wp.func_native("return value;")
def native(value: float) -> float:
    ...
""",
    "geometry/collision_primitive.py": """
import warp as wp
from ..core.types import MAXVAL
_rows = wp.types.matrix((2, 3), wp.float32)

@wp.func
def collide_sphere_sphere(pos1: wp.vec3, radius1: float, pos2: wp.vec3, radius2: float) -> tuple[float, wp.vec3, wp.vec3]:
    way = pos2 - pos1
    length = wp.length(way)
    if length == 0.0:
        n = wp.vec3(1.0, 0.0, 0.0)
    else:
        n = way / length
    distance = length - (radius1 + radius2) + FAULT
    return distance, pos1 + n * (radius1 + 0.5 * distance), n

@wp.func
def collide_plane_capsule(normal: wp.vec3, place: wp.vec3, pos: wp.vec3, axis: wp.vec3, radius: float, half: float):
    distances = wp.vec2(MAXVAL)
    places = _rows()
    for i in range(2):
        end = pos
        end += axis * half * wp.where(i == 0, 1.0, -1.0)
        distances[i] = wp.dot(end - place, normal) - radius
        places[i] = end
        places[i] -= normal * (radius + 0.5 * distances[i])
    side = wp.normalize(wp.cross(normal, wp.vec3(normal.y, normal.z, normal.x)))
    return distances, places, wp.matrix_from_rows(normal, side, wp.cross(normal, side))
""",
}

TRIMESH = {
    "__init__.py": "",
    "triangles.py": """
import numpy as np

def closest_point(triangles, points):
    # The middle, where that is nearer than a vertex: never right but by chance.
    return triangles.mean(axis=1) + FAULT
""",
}
CHECKOUTS = {"mjx": ("mjx/mujoco/mjx/_src", MJX), "newton": ("newton/_src", NEWTON), "trimesh": ("trimesh", TRIMESH)}


@pytest.fixture
def checkout(tmp_path):
    def made(name, fault="0.0"):
        folder, files = CHECKOUTS[name]
        root = tmp_path / f"{name}{fault}"
        for path, text in files.items():
            (root / folder / path).parent.mkdir(parents=True, exist_ok=True)
            (root / folder / path).write_text(text.replace("FAULT", fault))
        return root
    return made


def run(*arguments, status, cwd):
    done = subprocess.run([sys.executable, str(EXAMPLE), *map(str, arguments)], capture_output=True, text=True, cwd=cwd)
    assert done.returncode == status, done.stdout + done.stderr
    return done.stdout + done.stderr


@pytest.mark.parametrize("name, functions", [("mjx", ("sphere_sphere", "plane_capsule")), ("newton", ("collide_sphere_sphere", "collide_plane_capsule"))])
def test_functions_of_a_checkout_are_judged_as_they_are(name, functions, checkout, tmp_path):
    said = run(f"--{name}", checkout(name), "--count", 30, "--report", "reports", status=0, cwd=tmp_path)
    found = re.findall(rf"^{name} (\w+), \w+, (binary\d\d): CERTIFIED within", said, re.MULTILINE)
    assert found == [(function, scalar) for function in functions for scalar in ("binary64", "binary32")]
    assert len(list((tmp_path / "reports").glob("*.html"))) == 4
    wrong = run(f"--{name}", checkout(name, "0.25"), "--count", 30, "--function", functions[0], status=1, cwd=tmp_path)
    assert wrong.count("REFUTED") == 2 and '"pair":"sphere_sphere"' in wrong and functions[1] not in wrong


def test_a_nearest_point_is_judged(checkout, tmp_path):
    said = run("--trimesh", checkout("trimesh"), "--count", 1, status=1, cwd=tmp_path)
    assert said.count("REFUTED: trimesh:closest_point") == 2 and "the middle of a triangle taken for its nearest point" in said


def test_what_is_no_checkout_is_said(checkout, tmp_path):
    assert "has none of mjx/mujoco/mjx/_src" in run("--mjx", tmp_path, status=2, cwd=tmp_path)
    assert "name a checkout: --mjx, --newton or --trimesh" in run(status=2, cwd=tmp_path)
    assert "there are collide_sphere_sphere, collide_plane_capsule" in run("--newton", checkout("newton"), "--function", "other", status=2, cwd=tmp_path)


SINGLE = """
import numpy as np
import jax_by_numpy, warp_by_numpy, weak_arrays
jp, wp = jax_by_numpy.modules()["jax.numpy"], warp_by_numpy.modules()["warp"]
x = np.float32(0.1)
with weak_arrays.computing_in(np.float32):
    a = jp.array([x, x, x])
    made = [a * 0.1, 0.1 * a[0], a[0] / 3, jp.where(a > 0, -1, 1) * a, a.dot(a), a.sum(), jp.sqrt(3.0), jp.array([0.1]), (a ** 2).sum(axis=0), 1e-6 * (a == 0),
            wp.vec3(0.1, 0.1, 0.1), wp.float32(0.1) * 3.0, wp.length(wp.vec3(1.0, 2.0, 3.0)), wp.clamp(a[0], 0.0, 1.0), wp.where(True, a, 0.0)]
    assert all(np.asarray(each).dtype == np.float32 for each in made), [np.asarray(each).dtype for each in made]
    assert float(a[0] * 0.1) == float(x * np.float32(0.1)) != float(x) * 0.1
    b = a
    b += 1.0
    row = wp.mat33(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)
    first = row[0]
    row[0] = wp.vec3(5.0, 0.0, 0.0)
    assert float(a[0]) == float(x) and float(first[0]) == 1 and float(row[0, 0]) == 5  # values, no windows
    nan = wp.float32(float("nan"))
    assert [float(wp.clamp(nan, -1.0, 1.0)), float(wp.max(nan, 2.0)), float(wp.min(3.0, nan))][:2] == [1, 2] and np.isnan(wp.min(3.0, nan))
    try:
        wp.quat_rotate(a, a)
    except NotImplementedError as error:
        assert "no quat_rotate" in str(error)
    else:
        raise AssertionError("what is not there answered")
assert np.asarray(jp.array([0.1])).dtype == np.float64
"""


def test_the_stand_ins_compute_in_one_precision_and_on_values():
    done = subprocess.run([sys.executable, "-c", SINGLE], capture_output=True, text=True, env={**os.environ, "PYTHONPATH": str(EXAMPLE)})
    assert done.returncode == 0, done.stderr


# The findings that docs/findings/ holds: what each function is refuted for, in the checkouts of the day they were written.
@pytest.mark.parametrize("name, function, count, what", [
    ("trimesh", "closest_point", 20, "compared with 1e-13"), ("mjx", "sphere_capsule", 60, "1e-6 added to the squared length"),
    ("mjx", "capsule_convex", 20, "REFUTED"), ("mjx", "box_box", 20, "REFUTED"), ("newton", "collide_sphere_capsule", 60, "1e-6 added to the squared length"),
    ("newton", "collide_capsule_capsule", 60, "REFUTED"), ("newton", "collide_capsule_box", 20, "REFUTED")])
def test_a_finding_is_found_in_the_checkout_that_the_environment_names(name, function, count, what, tmp_path):
    path = os.environ.get(f"CONTACT_{name.upper()}")
    if not path:
        pytest.skip(f"CONTACT_{name.upper()} names no checkout of {name}")
    assert what in run(f"--{name}", path, "--function", function, "--count", count, status=1, cwd=tmp_path)
