"""As much of `warp` as functions about shapes ask of it, in Python: a kernel's function is called as it stands, on vectors that are arrays.

Warp compiles to C++ or CUDA, where a compiler may fuse a product with a sum. So last bits can differ from those of Warp, and nothing else. Its
float32 is `weak_arrays.NUMBER` here: in binary64 the formulas are judged without the roundings of single precision.
"""
import types

import numpy as np

import weak_arrays
from weak_arrays import Array, array, wrapped


def _shaped(name, shape):
    """A type of arrays of this shape: of no numbers (all 0), of one for all, of as many as there are, or of rows."""
    def made(cls, *numbers):
        if len(numbers) == 1 and np.ndim(numbers[0]) == 0:
            numbers = (np.full(shape, numbers[0]),)
        flat = np.concatenate([np.ravel(each) for each in numbers]) if numbers else np.zeros(shape)
        return array(np.reshape(flat, shape), float)

    return type(name, (Array,), {"__new__": made})


def _entry(i):
    return property(lambda self: self[i], lambda self, value: self.__setitem__(i, value))


Array.x, Array.y, Array.z = _entry(0), _entry(1), _entry(2)


class Float(Array):
    def __new__(cls, value=0.0):
        return array(value, float)


def _normalized(vector):
    length = np.sqrt(np.dot(vector, vector))
    return vector / length if length > 0 else vector * 0.0


# As warp/native/builtin.h has them, which decides what becomes of NaN: a < b ? a : b.
def _min(a, b):
    return wrapped(np.where(np.less(a, b), a, b))


def _max(a, b):
    return wrapped(np.where(np.greater(a, b), a, b))


class _Absent(type):
    """The type of what kernels that are never called here name in annotations: anything can stand in it, and nothing can be made of it."""
    def __getitem__(cls, key):
        return cls

    def __getattr__(cls, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return absent(f"{cls.__name__}.{name}")

    def __call__(cls, *arguments, **named):
        raise NotImplementedError(f"the stand-in of warp has no {cls.__name__}: warp_by_numpy.py is where it would be added")


def absent(name):
    return _Absent(name, (), {})


def _decorated(function=None, **named):
    return function if function is not None else lambda decorated: decorated


class _Warp(types.ModuleType):
    func = kernel = struct = overload = staticmethod(_decorated)
    func_native = func_replay = func_grad = staticmethod(lambda *_: lambda decorated: decorated)
    static = constant = staticmethod(lambda value: value)
    vec2, vec3, vec4 = (_shaped(f"vec{n}", (n,)) for n in (2, 3, 4))
    mat22, mat33 = _shaped("mat22", (2, 2)), _shaped("mat33", (3, 3))
    float32, int32, bool = Float, int, bool
    types = types.SimpleNamespace(vector=lambda length, dtype: _shaped("vector", (length,)), matrix=lambda shape, dtype: _shaped("matrix", shape))
    dot, cross = staticmethod(lambda a, b: wrapped(np.dot(a, b))), staticmethod(lambda a, b: wrapped(np.cross(a, b)))
    length_sq, length = staticmethod(lambda a: wrapped(np.dot(a, a))), staticmethod(lambda a: np.sqrt(wrapped(np.dot(a, a))))
    normalize = staticmethod(_normalized)
    abs, sqrt, exp = staticmethod(np.abs), staticmethod(lambda x: np.sqrt(Float(x))), staticmethod(lambda x: np.exp(Float(x)))
    min, max = staticmethod(_min), staticmethod(_max)
    clamp = staticmethod(lambda x, low, high: _min(_max(low, x), high))
    sign = staticmethod(lambda x: Float(-1.0 if x < 0 else 1.0))
    cw_mul, cw_div = staticmethod(lambda a, b: a * b), staticmethod(lambda a, b: a / b)
    transpose, matrix_from_rows = staticmethod(lambda m: wrapped(np.transpose(m))), staticmethod(lambda *rows: array(rows, float))
    where = staticmethod(lambda condition, yes, no: yes if condition else no)

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return absent(name)


def modules():
    """The module by the name under which it is imported."""
    return {"warp": _Warp("warp")}
