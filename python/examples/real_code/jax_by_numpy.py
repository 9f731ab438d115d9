"""As much of `jax` and `jax.numpy` as functions about shapes ask of it, in NumPy: no tracing and no compiler, one question at a time.

XLA may add the terms of a sum in another order and may fuse a product with a sum; NumPy rounds each operation. So last bits can differ from those of
JAX, and nothing else.
"""
import dataclasses
import functools
import types

import numpy as np

import weak_arrays
from weak_arrays import Array, array, wrapped


def _names(tree):
    return [field.name for field in dataclasses.fields(tree)]


def tree_map(function, tree, *others):
    """The function of each leaf; None has none."""
    if tree is None:
        return None
    if isinstance(tree, (tuple, list)):
        return type(tree)(tree_map(function, *leaves) for leaves in zip(tree, *others))
    if isinstance(tree, dict):
        return {key: tree_map(function, tree[key], *(other[key] for other in others)) for key in tree}
    if dataclasses.is_dataclass(tree):
        return dataclasses.replace(tree, **{name: tree_map(function, *(getattr(each, name) for each in (tree, *others))) for name in _names(tree)})
    return function(tree, *others)


def _rows(tree, axes):
    """What of the tree is mapped over: how many rows it has (None: it is the same for all), and the function that takes one."""
    if axes is None or tree is None:
        return None, lambda i: tree
    if isinstance(axes, int):
        leaves = []
        tree_map(leaves.append, tree)
        return np.shape(leaves[0])[axes], lambda i: tree_map(lambda leaf: wrapped(np.take(leaf, i, axis=axes)), tree)
    if dataclasses.is_dataclass(axes):
        parts = {name: _rows(getattr(tree, name), getattr(axes, name)) for name in _names(tree)}
        counts = [count for count, _ in parts.values() if count is not None]
        return counts[0] if counts else None, lambda i: dataclasses.replace(tree, **{name: row(i) for name, (_, row) in parts.items()})
    raise NotImplementedError(f"in_axes {axes!r}")


def vmap(function, in_axes=0):
    @functools.wraps(function)
    def mapped(*arguments):
        axes = in_axes if isinstance(in_axes, (tuple, list)) else [in_axes] * len(arguments)
        rows = [_rows(argument, axis) for argument, axis in zip(arguments, axes)]
        count = next(count for count, _ in rows if count is not None)
        results = [function(*(row(i) for _, row in rows)) for i in range(count)]
        return tree_map(lambda *leaves: wrapped(np.stack(leaves)), results[0], *results[1:])
    return mapped


def _where(condition, yes, no):
    return wrapped(np.where(condition, yes, no))


def _dot(a, b, precision=None):
    return wrapped(np.dot(a, b))


class _Numpy(types.ModuleType):
    """`jax.numpy`: NumPy's functions, whose numbers are of the one precision."""
    ndarray, bool_ = Array, np.bool_
    array = asarray = staticmethod(array)
    where, dot = staticmethod(_where), staticmethod(_dot)
    linalg = types.SimpleNamespace(norm=lambda x, axis=None: wrapped(np.linalg.norm(x, axis=axis)))

    @property
    def float32(self):
        return weak_arrays.NUMBER

    def __getattr__(self, name):
        found = getattr(np, name)
        if isinstance(found, type) or not callable(found):
            return found
        return lambda *arguments, **named: wrapped(found(*arguments, **named))


def modules():
    """The modules by the names under which they are imported."""
    jax = types.ModuleType("jax")
    jax.numpy = _Numpy("jax.numpy")
    jax.Array, jax.vmap = Array, vmap
    jax.jit = lambda function=None, **named: function if function is not None else lambda decorated: decorated
    jax.tree_util = types.SimpleNamespace(tree_map=tree_map, register_pytree_with_keys=lambda *_: None, GetAttrKey=str)
    jax.lax = types.SimpleNamespace(Precision=types.SimpleNamespace(HIGH=None, HIGHEST=None))
    jax.typing = types.SimpleNamespace(ArrayLike=object)
    return {"jax": jax, "jax.numpy": jax.numpy}
