"""Newton's functions for pairs, from a checkout or an installed `newton`."""
import types

import numpy as np

import warp_by_numpy
import weak_arrays
from checkouts import folder_of, importing, package, stand_in
from shapes_as_theirs import NEAREST_ON_TRIANGLE, deepest, flat, geoms, manifold, nearest_on_triangle

TAKE_A_MARGIN = ("collide_plane_box", "collide_box_box")
NO_CONTACT = 1e9  # a slot without a contact has MAXVAL, 1e10


def load(path):
    source = folder_of(path, "newton/_src", "_src")
    nothing = warp_by_numpy.absent("nothing")
    rest = [stand_in("newton._src.utils.heightfield", HeightfieldData=nothing, sample_sdf_grad_heightfield=nothing),
            stand_in("newton._src.geometry.broad_phase_common", binary_search=nothing),
            stand_in("newton._src.geometry.types", GeoType=nothing, Axis=types.SimpleNamespace(X=0, Y=1, Z=2))]
    names = {"newton._src": source, "newton._src.core": source / "core", "newton._src.geometry": source / "geometry"}
    packages = [package("newton"), package("newton._src.utils"), *(package(name, folder) for name, folder in names.items())]
    with importing({**warp_by_numpy.modules(), **{each.__name__: each for each in packages + rest}}) as module:
        return types.SimpleNamespace(pairs=module("newton._src.geometry.collision_primitive"), kernels=module("newton._src.geometry.kernels"),
                                     support=module("newton._src.geometry.support_function"), vec3=module("warp").vec3, mat33=module("warp").mat33)


def _taken(newton, shape, i, kind):
    """A shape as its functions take it, in the order of their arguments."""
    position, matrix, sizes = newton.vec3(shape.positions[i]), newton.mat33(shape.matrices[i]), weak_arrays.array(shape.sizes[i], float)
    return {"sphere": lambda: [position, sizes[0]], "capsule": lambda: [position, matrix[:, 2], sizes[0], sizes[1]],
            "cube": lambda: [position, matrix, newton.vec3(sizes)], "obb": lambda: [position, matrix, newton.vec3(sizes)],
            "plane": lambda: [matrix[:, 2], position]}[kind]()


def _engine(newton, collide, several, margin):
    def engine(questions):
        number = questions.alarm.dtype.type
        kinds = questions.pair.split("_")
        shapes = [geoms(questions, which, number) for which in (1, 2)]
        order = (1, 0) if kinds[1] == "plane" else (0, 1)
        distances, positions, normals = [], [], []
        with weak_arrays.computing_in(number):
            for i in range(len(questions)):
                arguments = [each for which in order for each in _taken(newton, shapes[which], i, kinds[which])]
                distance, position, *normal = collide(*arguments, *([weak_arrays.array(questions.alarm[i], float)] if margin else []))
                distance = np.atleast_1d(np.asarray(distance))
                # Spheres over a plane have its normal; a frame's first row is one; and several contacts may share one.
                normal = np.asarray(normal[0] if normal else arguments[0])
                normal = normal[0] if collide.__name__ == "collide_plane_capsule" else normal
                distances.append(distance)
                positions.append(np.reshape(np.asarray(position), (-1, 3)))
                normals.append(np.broadcast_to(np.reshape(normal, (-1, 3)), (len(distance), 3)))
        distances, positions, normals = np.stack(distances), np.stack(positions), np.stack(normals)
        answer = manifold(distances, normals, positions, distances < NO_CONTACT) if several else deepest(distances, normals, positions)
        return {**answer, "unsupported": flat(questions), "hit": distances.min(axis=1) <= questions.alarm}
    return engine


def _of_triangles(newton, nearest):
    def engine(questions):
        with weak_arrays.computing_in(questions.alarm.dtype.type):
            points = np.stack([np.asarray(nearest([newton.vec3(vertex) for vertex in triangle], newton.vec3(center)))
                               for triangle, center in zip(questions.vertices2, questions.center1)])
        return nearest_on_triangle(questions, points)
    return engine


def engines(path):
    """By the function's name: its pair, the engine, and what its answers mean."""
    newton = load(path)
    on_plane = {"normal": "second-to-first", "points": "manifold"}
    functions = {
        "collide_sphere_sphere": ("sphere_sphere", {}),
        "collide_sphere_capsule": ("sphere_capsule", {}),
        "collide_capsule_capsule": ("capsule_capsule", {}),
        "collide_plane_sphere": ("sphere_plane", {"normal": "second-to-first"}),
        "collide_plane_capsule": ("capsule_plane", on_plane),
        "collide_plane_box": ("obb_plane", on_plane),
        "collide_sphere_box": ("sphere_cube", {}),
        "collide_capsule_box": ("capsule_obb", {}),
        "collide_box_box": ("obb_obb", {"depth": "any_separating", "points": "manifold"}),
    }
    found = {name: (pair, _engine(newton, getattr(newton.pairs, name), conventions.get("points") == "manifold", name in TAKE_A_MARGIN), conventions)
             for name, (pair, conventions) in functions.items() if hasattr(newton.pairs, name)}
    if hasattr(newton.kernels, "triangle_closest_point"):
        found["triangle_closest_point"] = ("sphere_triangle", _of_triangles(newton, lambda vertices, point: newton.kernels.triangle_closest_point(
            *vertices, point)[0]), NEAREST_ON_TRIANGLE)
    if hasattr(newton.support, "closest_point_on_triangle"):
        found["closest_point_on_triangle"] = ("sphere_triangle", _of_triangles(newton, lambda vertices, point: newton.support.closest_point_on_triangle(
            point, *vertices)), NEAREST_ON_TRIANGLE)
    return found
