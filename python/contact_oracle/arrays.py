"""Arrays of any library: read as NumPy's, in place where they can be, and given back as the library's own."""
from __future__ import annotations

import sys
from collections.abc import Iterable
from typing import Any

import numpy as np

Array = np.ndarray[Any, np.dtype[Any]]

# What libraries raise where an array of theirs cannot be read.
UNREADABLE = (ValueError, TypeError, RuntimeError, OverflowError, BufferError)


def numpy_array(value: Any) -> Array:
    """The value as an array of NumPy; raises one of `UNREADABLE` where it is none, or is on another device."""
    if not isinstance(value, np.ndarray) and not hasattr(value, "__array__") and hasattr(value, "__dlpack__"):
        return np.from_dlpack(value)
    return np.asarray(value)


def library_of(values: Iterable[Any]) -> Any:
    """The library that arrays among some values are of; None where that is NumPy, or one that gives no arrays to others.

    An array says so itself, as the array API standard has it; PyTorch's do not, and the module of their type does.

    >>> import numpy
    >>> library_of([numpy.zeros(3), 1.0, (2, 3)]) is None
    True
    """
    found = {}
    for value in values:
        if isinstance(value, (np.ndarray, np.generic)) or not hasattr(value, "__dlpack__"):
            continue
        library = value.__array_namespace__() if hasattr(value, "__array_namespace__") else sys.modules.get(type(value).__module__.partition(".")[0])
        if hasattr(library, "from_dlpack"):
            found[library.__name__] = library
    if len(found) > 1:
        raise TypeError(f"arrays of {' and of '.join(sorted(found))} do not go together")
    return next(iter(found.values()), None)


def in_library(library: Any, array: Any) -> Any:
    """The array as one of a library, which takes it over where it lies."""
    if library is None:
        return array
    array = np.asarray(array)
    if not array.flags.writeable:  # a part of an array of a library whose arrays never change; DLPack cannot say so
        array = array.copy()
    # Not every library that is about takes or gives truth values by DLPack.
    return library.from_dlpack(array.view(np.uint8)) != 0 if array.dtype == bool else library.from_dlpack(array)
