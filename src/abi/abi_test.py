#!/usr/bin/env python3
"""What programs that were compiled once rely on:   abi_test.py LIBRARY COMPILER INCLUDE INCLUDE [--write] [TEST..]

LIBRARY is the shared library, COMPILER one for C, the first INCLUDE that of the source. The committed names and types are those of the
last release of this minor version. --write makes them anew: after something was added, or with a new minor version."""
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
LIBRARY, COMPILER, *INCLUDE = sys.argv[1:5]
WORDS = sys.argv[5:]
HEADER = (Path(INCLUDE[0]) / "contact/contact.h").read_text()
NAMES, TYPES = HERE / "names.x86_64.txt", HERE / "contact.x86_64.abi"
OF_ALL_PAIRS = {"contact_last_error", "contact_status_text", "contact_version"}


def output(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def names():
    """{name: kind} of all that the library shows; names of C++ are demangled, and without the version's namespace."""
    lines = [re.fullmatch(r"\S+ (\w) (.*?)(?:@@\S+)?", line) for line in output("nm", "-DC", "--defined-only", LIBRARY).splitlines()]
    return {re.sub(r"contact::v\d+(_\d+)?::", "contact::", line[2]): line[1] for line in lines if line[1] != "A"}


def committed():
    """The functions, and not what compilers make of templates and inline functions as they like."""
    return "".join(f"{name}\n" for name, kind in sorted(names().items()) if kind == "T")


def functions():
    """Those of the header."""
    pairs = re.findall(r"^CONTACT_C_(TEST|PAIR)\((\w+), contact_", HEADER, re.MULTILINE)
    return OF_ALL_PAIRS | {f"contact_test_{pair}" for _, pair in pairs} | {f"contact_compute_{pair}" for kind, pair in pairs if kind == "PAIR"}


def describe(to):
    """The types of the C interface as abidw writes them: of a pointer to each function, and of each enumeration."""
    with tempfile.TemporaryDirectory() as folder:
        source, library = Path(folder) / "described.c", Path(folder) / "described.so"
        source.write_text("#include <contact/contact.h>\n" + "".join(f"__typeof__(&{name}) type_of_{name};\n" for name in sorted(functions())) +
                          "".join(f"enum {name} type_of_{name};\n" for name in re.findall(r"^enum (\w+)", HEADER, re.MULTILINE)))
        subprocess.run([COMPILER, "-g", "-shared", "-fPIC", *(f"-I{one}" for one in INCLUDE), str(source), "-o", str(library)], check=True)
        subprocess.run(["abidw", "--no-corpus-path", "--no-comp-dir-path", "--no-show-locs", "--no-elf-needed", "--type-id-style", "hash",
                        "--out-file", str(to), str(library)], check=True)
    to.write_text(to.read_text().replace(folder, ""))


class Names(unittest.TestCase):
    def test_the_library_shows_what_its_headers_declare_and_nothing_else(self):
        shown = names()
        in_c = {name for name in shown if name.startswith("contact_")}
        self.assertEqual(in_c, functions())
        of_cpp = set(shown) - in_c
        self.assertIn("contact::test_sphere_sphere(contact::Ball const&, contact::Ball const&, double)", of_cpp)
        plain = re.compile(r"(?:(?:vtable|typeinfo|typeinfo name) for |(?:void|bool|std::optional<contact::DomainError>) )?contact::(?!kernel|component)")
        self.assertEqual([name for name in of_cpp if not plain.match(name)], [])

    def test_no_function_was_lost_and_none_joined_unnoticed(self):
        was, now = set(NAMES.read_text().splitlines()), set(committed().splitlines())
        self.assertEqual(was - now, set(), "lost: programs that were compiled with it no longer start; that takes a new minor version")
        self.assertEqual(now - was, set(), "new: write it down with --write")


@unittest.skipIf(shutil.which("abidiff") is None, "no abidiff (abigail-tools)")
class Types(unittest.TestCase):
    def test_the_types_of_the_c_interface_are_those_that_programs_were_compiled_with(self):
        with tempfile.TemporaryDirectory() as folder:
            now = Path(folder) / "now.abi"
            describe(now)
            done = subprocess.run(["abidiff", "--no-added-syms", str(TYPES), str(now)], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    if WORDS[:1] == ["--write"]:
        NAMES.write_text(committed())
        describe(TYPES)
    else:
        unittest.main(argv=[sys.argv[0], *WORDS])
