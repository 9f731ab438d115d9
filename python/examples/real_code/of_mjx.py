"""MJX's functions for pairs, from a checkout of MuJoCo or an installed `mujoco.mjx`."""
import enum
import types

import numpy as np

import jax_by_numpy
import weak_arrays
from checkouts import folder_of, importing, package, stand_in
from shapes_as_theirs import deepest, flat, geoms, manifold

GeomType = enum.Enum("GeomType", "PLANE HFIELD SPHERE CAPSULE ELLIPSOID CYLINDER BOX MESH")
KINDS = {"sphere": GeomType.SPHERE, "capsule": GeomType.CAPSULE, "cube": GeomType.BOX, "obb": GeomType.BOX, "plane": GeomType.PLANE}


def load(path):
    source = folder_of(path, "mjx/mujoco/mjx/_src", "mujoco/mjx/_src", "mjx/_src")
    implementation = type("Implementation", (), {})
    types_of_models = stand_in("mujoco.mjx._src.types", Data=object, Model=object, ConvexMesh=object, DataJAX=implementation, ModelJAX=implementation,
                               GeomType=GeomType)
    mujoco = package("mujoco")
    mujoco.mjMINVAL, mujoco.MjModel = 1e-15, object  # mjmodel.h
    scipy = stand_in("scipy", spatial=stand_in("scipy.spatial"))
    # mesh.py imports SciPy and trimesh for meshes alone.
    with importing({**jax_by_numpy.modules(), "mujoco": mujoco, "mujoco.mjx": package("mujoco.mjx"), "mujoco.mjx._src": package("mujoco.mjx._src", source),
                    "mujoco.mjx._src.types": types_of_models, "scipy": scipy, "scipy.spatial": scipy.spatial, "trimesh": stand_in("trimesh", Trimesh=object)}) as module:
        return types.SimpleNamespace(primitive=module("mujoco.mjx._src.collision_primitive"), convex=module("mujoco.mjx._src.collision_convex"),
                                     implementation=implementation)


def _contacts(mjx, collide, questions, number):
    """What the collider says of each question: distances N x M, positions and normals N x M x 3. It takes a plane before another shape."""
    kinds = [KINDS[name] for name in questions.pair.split("_")]
    shapes = [geoms(questions, which, number) for which in (1, 2)]
    if kinds[1] == GeomType.PLANE:
        kinds, shapes = kinds[::-1], shapes[::-1]
    count = len(questions)
    together = lambda name: weak_arrays.array(np.concatenate([getattr(shape, name) for shape in shapes]))
    model = types.SimpleNamespace(geom_size=together("sizes"), _impl=mjx.implementation())
    data = types.SimpleNamespace(geom_xpos=together("positions"), geom_xmat=together("matrices"), _impl=mjx.implementation())
    key = types.SimpleNamespace(types=kinds, data_ids=(-1, -1))
    distances, positions, frames = map(np.asarray, collide(model, data, key, np.stack([np.arange(count), np.arange(count) + count], axis=1)))
    return distances.reshape(count, -1), positions.reshape(count, -1, 3), frames.reshape(count, -1, 3, 3)[:, :, 0]


def _engine(mjx, collide, several, convex):
    def engine(questions):
        number = questions.alarm.dtype.type
        with weak_arrays.computing_in(number):
            distances, positions, normals = _contacts(mjx, collide, questions, number)
        # Its functions of convex shapes say 1 where there is no contact.
        there = distances <= (0 if convex else np.inf)
        answer = manifold(distances, normals, positions, there) if several else deepest(distances, normals, positions)
        return {**answer, "unsupported": flat(questions), "hit": distances.min(axis=1) <= (0 if convex else questions.alarm)}
    return engine


def engines(path):
    """By the function's name: its pair, the engine, and what its answers mean."""
    mjx = load(path)
    on_plane = {"normal": "second-to-first", "points": "manifold"}
    no_margin = {"margin": "none"}
    functions = {
        "sphere_sphere": ("sphere_sphere", mjx.primitive, {}),
        "sphere_capsule": ("sphere_capsule", mjx.primitive, {}),
        "capsule_capsule": ("capsule_capsule", mjx.primitive, {}),
        "plane_sphere": ("sphere_plane", mjx.primitive, {"normal": "second-to-first"}),
        "plane_capsule": ("capsule_plane", mjx.primitive, on_plane),
        "plane_convex": ("obb_plane", mjx.convex, {**on_plane, **no_margin}),
        "sphere_convex": ("sphere_cube", mjx.convex, no_margin),
        "capsule_convex": ("capsule_obb", mjx.convex, no_margin),
        "box_box": ("obb_obb", mjx.convex, {"depth": "any_separating", "points": "manifold", **no_margin}),
    }
    return {name: (pair, _engine(mjx, getattr(module, name), conventions.get("points") == "manifold", module is mjx.convex), conventions)
            for name, (pair, module, conventions) in functions.items() if hasattr(module, name)}
