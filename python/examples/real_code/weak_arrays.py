"""Arrays of one precision: what an engine in JAX or Warp computes in, by NumPy.

Every number with a fraction is of `NUMBER`, as is every result; Python's own numbers and whole numbers take it on where they meet one. NumPy alone
would widen a single number that meets 0.5. An array is a value: `+=` makes a new one, and an entry is no window on the array.
"""
import contextlib

import numpy as np

NUMBER = np.float64


@contextlib.contextmanager
def computing_in(number):
    """In it arrays are of this scalar; and division by zero is silent, as on a GPU."""
    global NUMBER
    before, NUMBER = NUMBER, number
    try:
        with np.errstate(all="ignore"):
            yield
    finally:
        NUMBER = before


def wrapped(result):
    if isinstance(result, (tuple, list)):
        return type(result)(map(wrapped, result))
    if isinstance(result, (np.ndarray, np.generic)):
        return np.asarray(result, NUMBER if result.dtype.kind == "f" else None).view(Array)
    return result


def array(values, dtype=None):
    """A new array of the values, which may be arrays in lists."""
    made = np.array(values, bool if dtype is bool else None)
    return wrapped(made.astype(NUMBER) if dtype is float else made)


def _is_fraction(value):
    return isinstance(value, float) or getattr(value, "dtype", np.dtype(int)).kind == "f"


class _At:
    def __init__(self, of, key=None):
        self.of, self.key = of, key

    def __getitem__(self, key):
        return _At(self.of, key)

    def set(self, value):
        made = self.of.copy()
        made[self.key] = value
        return made


class Array(np.ndarray):
    def __array_ufunc__(self, ufunc, method, *inputs, out=None, **named):
        fractions = any(map(_is_fraction, inputs))
        plain = [np.asarray(value, NUMBER if fractions else None) for value in inputs]
        return wrapped(getattr(ufunc, method)(*plain, **named))

    def __array_function__(self, function, types, arguments, named):
        return wrapped(super().__array_function__(function, types, arguments, named))

    def __getitem__(self, key):
        return wrapped(np.array(super().__getitem__(key)))

    def __setitem__(self, key, value):
        self.view(np.ndarray)[key] = value

    def __iter__(self):
        return (self[i] for i in range(len(self)))

    def dot(self, other):
        return np.dot(self, other)

    @property
    def at(self):
        return _At(self)

    # What names the left side names a new array.
    def __iadd__(self, other):
        return self + other

    def __isub__(self, other):
        return self - other

    def __imul__(self, other):
        return self * other

    def __itruediv__(self, other):
        return self / other

    def __iand__(self, other):
        return self & other
