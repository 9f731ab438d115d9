"""Files of somebody's checkout, imported as they are: what they import and is not there is given in its place, and what a package's own
`__init__` would load besides is left out."""
import contextlib
import importlib
import importlib.machinery
import sys
import types
from pathlib import Path


class NotThere(Exception):
    """The folder holds no such checkout."""


def folder_of(path, *candidates):
    """The first of these folders under the path that is there: of a clone, or of an installed package."""
    for candidate in candidates:
        if (Path(path) / candidate).is_dir():
            return Path(path) / candidate
    raise NotThere(f"{path}: has none of {', '.join(candidates)}")


def package(name, *folders):
    """An empty package, whose parts are found in the folders."""
    made = types.ModuleType(name)
    made.__path__ = list(map(str, folders))
    made.__spec__ = importlib.machinery.ModuleSpec(name, None, is_package=True)
    return made


def stand_in(name, **holds):
    made = types.ModuleType(name)
    vars(made).update(holds)
    return made


@contextlib.contextmanager
def importing(modules, *packages):
    """In it these modules are what their names import, and these packages are found anew. Behind it all is as before, but that what was imported lives on in who holds it."""
    before = dict(sys.modules)
    tops = {name.partition(".")[0] for name in (*modules, *packages)}
    for name in [name for name in sys.modules if name.partition(".")[0] in tops]:
        del sys.modules[name]
    sys.modules.update(modules)
    try:
        yield importlib.import_module
    finally:
        for name in [name for name in sys.modules if name.partition(".")[0] in tops]:
            del sys.modules[name]
        sys.modules.update(before)
