#!/usr/bin/env python3
"""Conan's recipe with stand-ins for Conan's modules:   recipe_test.py BUILD VERSION COMPILER FLAGS

What the recipe exports is enough to configure the library with what it sets. BUILD, a build of the same sources, has been installed into
BUILD/consumer_test/installed, and stands for what would be built. The test package is built against that and run."""
import fnmatch
import importlib.util
import shutil
import subprocess
import sys
import tempfile
import types
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
BUILD, VERSION, COMPILER, FLAGS = Path(sys.argv[1]), *sys.argv[2:5]
MODULES = {"conan": ["ConanFile"], "conan.tools.build": ["check_min_cppstd", "can_run"], "conan.tools.files": ["copy", "load"],
           "conan.tools.cmake": ["CMake", "CMakeDeps", "CMakeToolchain", "cmake_layout"]}


class ConanFile:
    """The base of a recipe: what it asks is written down."""

    def __init__(self, **attributes):
        self.__dict__.update(attributes)
        self.required, self.properties = {}, {}
        self.cpp_info = types.SimpleNamespace(set_property=self.properties.__setitem__)

    def requires(self, reference, **traits):
        self.required[reference.split("/")[0]] = traits

    def run(self, command, env):
        assert env == "conanrun"
        subprocess.run([command], check=True)


class CMakeToolchain:
    def __init__(self, recipe):
        self.recipe, self.cache_variables = recipe, {}

    def generate(self):
        self.recipe.settled = [f"-D{name}={'ON' if value else 'OFF'}" for name, value in self.cache_variables.items()]


class CMake:
    """CMake itself, with what the toolchain would say."""

    def __init__(self, recipe):
        self.recipe = recipe

    def configure(self):
        self.call("-S", self.recipe.source_folder, "-B", self.recipe.build_folder, "-G", "Ninja", "--no-warn-unused-cli", f"-DCMAKE_CXX_COMPILER={COMPILER}",
                  f"-DCMAKE_C_FLAGS={FLAGS}", f"-DCMAKE_CXX_FLAGS={FLAGS}", f"-DCMAKE_PREFIX_PATH={BUILD / 'consumer_test/installed'}",
                  *self.recipe.settled)

    def build(self):
        self.call("--build", self.recipe.build_folder)

    def install(self):
        shutil.copytree(BUILD / "consumer_test/installed", self.recipe.package_folder, symlinks=True, dirs_exist_ok=True)

    @staticmethod
    def call(*arguments):
        subprocess.run(["cmake", *map(str, arguments)], check=True, stdout=subprocess.DEVNULL)


def copy(recipe, pattern, src, dst):
    """As Conan's: the pattern is matched with whole relative paths, and * with slashes too."""
    for path in Path(src).glob(f"{pattern.split('/')[0]}{'/**/*' if '/' in pattern else ''}"):
        if path.is_file() and fnmatch.fnmatch(str(path.relative_to(src)), pattern):
            to = Path(dst) / path.relative_to(src)
            to.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(path, to)


def recipe(file, **attributes):
    """An object of the one class that a recipe defines."""
    stand_ins = {"ConanFile": ConanFile, "CMake": CMake, "CMakeToolchain": CMakeToolchain, "copy": copy, "load": lambda _, path: Path(path).read_text(),
                 "CMakeDeps": lambda _: types.SimpleNamespace(generate=lambda: None), "cmake_layout": lambda _: None,
                 "check_min_cppstd": lambda _, least: None, "can_run": lambda _: True}
    for name, needed in MODULES.items():
        sys.modules[name] = types.ModuleType(name)
        sys.modules[name].__dict__.update({one: stand_ins[one] for one in needed})
    sys.modules["conan.tools"] = types.ModuleType("conan.tools")
    spec = importlib.util.spec_from_file_location("recipe", file)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    classes = [one for one in vars(module).values() if isinstance(one, type) and issubclass(one, ConanFile) and one is not ConanFile]
    assert len(classes) == 1
    return classes[0](recipe_folder=str(Path(file).parent), **attributes)


class Recipe(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(dir=BUILD))
        self.addCleanup(shutil.rmtree, self.folder)

    def test_what_is_exported_can_be_configured_as_the_recipe_says(self):
        made = recipe(HERE / "conanfile.py", export_sources_folder=self.folder / "source", source_folder=self.folder / "source",
                      build_folder=self.folder / "build", package_folder=self.folder / "package", settings=types.SimpleNamespace(os="Linux"))
        made.set_version()
        self.assertEqual((made.name, made.version), ("contact-oracle", VERSION))
        made.export_sources()
        made.requirements()
        self.assertEqual(set(made.required), {"eigen", "boost", "highway"})
        made.generate()
        CMake(made).configure()
        files = (self.folder / "build/build.ninja").read_text()
        self.assertIn("libcontact-oracle.a", files)
        self.assertNotIn("contact_tool", files)
        made.package()
        made.package_info()
        for folder in made.cpp_info.builddirs:
            self.assertTrue((self.folder / "package" / folder / "contact-oracle-config.cmake").exists())
        self.assertTrue((self.folder / "package/licenses/LICENSE").exists())
        for library in made.cpp_info.libs:
            self.assertTrue(list((self.folder / "package/lib").glob(f"lib{library}.*")))

    def test_the_test_package_runs_against_what_is_packaged(self):
        made = recipe(HERE / "test_package/conanfile.py", tested_reference_str=f"contact-oracle/{VERSION}", source_folder=HERE / "test_package",
                      build_folder=self.folder, settled=[], cpp=types.SimpleNamespace(build=types.SimpleNamespace(bindir=str(self.folder))))
        made.requirements()
        made.build()
        made.test()


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[5:]])
