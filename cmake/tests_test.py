#!/usr/bin/env python3
"""Tests that cannot fail, as far as that can be seen without running them, and skips that pass for passes:   tests_test.py"""
import ast
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
TESTS = [path for path in ROOT.rglob("*_test.py") if "build" not in path.relative_to(ROOT).parts[:1] and "node_modules" not in path.parts]
RUNNERS = ("run", "tool", "verify", "subprocess.run")


def faults(text):
    """The kinds of test that cannot fail, with their lines."""
    found = []
    for node in ast.walk(ast.parse(text)):
        say = lambda what, at=node: found.append((at.lineno, what))
        if isinstance(node, ast.Dict):
            keys = [ast.dump(key) for key in node.keys if key is not None]
            if len(keys) > len(set(keys)):
                say("a key twice: the first value is lost")
        if isinstance(node, ast.ClassDef):
            names = [one.name for one in node.body if isinstance(one, ast.FunctionDef)]
            if len(names) > len(set(names)):
                say("a method twice: the first never runs")
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Call) and ast.unparse(node.value.func) in RUNNERS and \
                not any(key.arg == "check" for key in node.value.keywords):
            say("nobody looks at the exit status")
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr.startswith("assert") and len(node.args) > 1:
            name, first, second = node.func.attr, *node.args[:2]
            if ast.dump(first) == ast.dump(second) or isinstance(first, ast.Constant) and isinstance(second, ast.Constant):
                say("a thing compared with itself, or two constants")
            if name == "assertNotEqual" and ast.unparse(first).endswith("returncode") and ast.unparse(second) == "0":
                say("a crash is as good as a refusal")
            statuses = [one.value for one in second.elts if isinstance(one, ast.Constant)] if isinstance(second, ast.Tuple) else []
            if name == "assertIn" and ast.unparse(first).endswith("returncode") and 0 in statuses and len(statuses) > 1:
                say("right and wrong both pass")
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == "assertTrue" and isinstance(node.args[0], ast.Constant):
            say("a constant")
    return found


class CannotFail(unittest.TestCase):
    def test_no_test_is_of_a_kind_that_cannot_fail(self):
        self.assertGreater(len(TESTS), 15)
        for path in TESTS:
            with self.subTest(str(path.relative_to(ROOT))):
                self.assertEqual(faults(path.read_text(encoding="utf-8")), [])

    def test_each_kind_is_found(self):
        for text in ('{"a": 1, **more, "a": 2}', "class A:\n    def f(self): pass\n    def f(self): pass", 'run("lint")', "subprocess.run(x)",
                     "self.assertEqual(a.b(), a.b())", "self.assertEqual(1, 1)", "self.assertNotEqual(done.returncode, 0)",
                     "self.assertIn(done.returncode, (0, 1))", "self.assertTrue(True)"):
            self.assertEqual(len(faults(text)), 1, text)
        for text in ("{**a, **b}", 'done = run("lint")', "subprocess.run(x, check=True)", "self.assertIn(done.returncode, (1, 2))"):
            self.assertEqual(faults(text), [], text)

    def test_no_test_in_cpp_compares_a_thing_with_itself_or_expects_a_constant(self):
        files = [path for folder in ("docs", "engines", "golden", "oracle", "proptests", "src", "tool") for path in (ROOT / folder).rglob("*.cpp")]
        self.assertGreater(len(files), 100)
        kind = re.compile(r"(?:EXPECT|ASSERT)_(?:EQ|LE|GE)\(([\w.\->:]+), \1\)|(?:EXPECT|ASSERT)_(?:TRUE|FALSE)\((?:true|false|k\w+)\)|RC_ASSERT\((?:true|k\w+)\)")
        self.assertTrue(kind.search("EXPECT_EQ(a.b, a.b)") and kind.search("RC_ASSERT(kSeeded)") and not kind.search("EXPECT_EQ(a, ab)"))
        self.assertEqual([(str(path), said[0]) for path in files for said in kind.finditer(path.read_text(encoding="utf-8"))], [])


PROJECT = """cmake_minimum_required(VERSION 3.25)
project(toy NONE)
enable_testing()
set(Python3_EXECUTABLE "{python}")
include({cmake}/ContactPythonTest.cmake)
contact_python_test(toy_test.py EXCEPT LeftOut PROPERTIES LABELS "a;b")
contact_python_test(toy_test.py NAME whole ARGS x)
"""
TOY = """import sys, unittest
class Alone(unittest.TestCase):
    def test_passes(self): pass
    def test_skips(self): self.skipTest("no moon here")
    def test_skips_a_part(self):
        with self.subTest("part"): self.skipTest("no sun here")
class Passes(unittest.TestCase):
    def test_passes(self): pass
class LeftOut(unittest.TestCase):
    def test_fails(self): self.fail()
class TooLongCampaign(LeftOut): pass
class SkipsAndFails(unittest.TestCase):
    def test_skips(self):
        with self.subTest("part"): self.skipTest("no sun here")
    def test_fails(self): self.fail()
class Speaks(unittest.TestCase):
    def test_skips(self):
        print("a word", file=sys.stderr)
        self.skipTest("no cloud here")
@unittest.skip("no comet here")
class Whole(unittest.TestCase):
    def test_one(self): pass
class Unprepared(unittest.TestCase):
    @classmethod
    def setUpClass(cls): raise unittest.SkipTest("no ring here")
    def test_one(self): pass
class Shared(unittest.TestCase):
    @classmethod
    def setUpClass(cls): pass
class Heir(Shared):
    def test_one(self): pass
    def test_two(self): self.skipTest("no star here")
if __name__ == "__main__":
    unittest.main(argv=[word for word in sys.argv if word != "x"])
"""


class Skips(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        (cls.folder / "CMakeLists.txt").write_text(PROJECT.format(cmake=ROOT / "cmake", python=sys.executable))
        (cls.folder / "toy_test.py").write_text(TOY)
        subprocess.run(["cmake", "-S", cls.folder, "-B", cls.folder / "b"], check=True, capture_output=True)
        cls.report = cls.folder / "report.xml"
        cls.said = subprocess.run(["ctest", "--test-dir", cls.folder / "b", "-LE", "campaign", "--output-junit", cls.report],
                                  capture_output=True, text=True).stdout

    def test_each_class_is_a_test_and_a_skip_is_no_pass(self):
        ends = dict(re.findall(r"Test +#\d+: (\S+) \.+ *\**(Passed|Failed|Skipped)", self.said))
        self.assertEqual(ends, {"toy_test.Alone": "Skipped", "toy_test.Passes": "Passed", "toy_test.SkipsAndFails": "Failed",
                                "toy_test.Speaks": "Skipped", "toy_test.Whole": "Skipped", "toy_test.Unprepared": "Skipped",
                                "toy_test.Heir": "Skipped", "whole": "Failed"}, self.said)

    def test_a_class_for_the_campaign_has_its_label_alone(self):
        labelled = lambda label: re.findall(r"Test +#\d+: (\S+)", subprocess.run(
            ["ctest", "--test-dir", self.folder / "b", "-N", "-L", label], capture_output=True, text=True).stdout)
        self.assertEqual(labelled("campaign"), ["toy_test.TooLongCampaign"])
        self.assertEqual(len(labelled("^a$")), 7)
        self.assertNotIn("toy_test.TooLongCampaign", labelled("^a$"))

    def skips(self, *allowed):
        path = self.folder / "allowed"
        path.write_text("# a word\n\n" + "".join(f"{line}\n" for line in allowed))
        done = subprocess.run([sys.executable, ROOT / ".ci/skips.py", "--allowed", path, self.report], capture_output=True, text=True)
        self.assertEqual(done.stdout, "")
        return done.returncode, done.stderr

    # The cases that are skipped, and why; what speaks between its name and its skip is named by its class.
    SKIPPED = {"Alone.test_skips": "no moon here", "Alone.test_skips_a_part": "no sun here", "Speaks": "no cloud here",
               "Whole.test_one": "no comet here", "Unprepared": "no ring here", "Heir.test_two": "no star here"}

    def test_a_skip_that_nobody_allowed_is_named_with_its_reason(self):
        for name, reason in self.SKIPPED.items():
            allowed = [rf"toy_test\.{re.escape(other)}: it may be" for other in self.SKIPPED if other != name]
            code, said = self.skips(*allowed)
            self.assertEqual((code, len(said.splitlines())), (1, 1), said)
            self.assertIn(f"toy_test.{name}: '{reason}'", said)
            self.assertEqual(self.skips(*allowed, rf"toy_test\.{re.escape(name)}: this one too"), (0, ""))

    def test_to_allow_a_class_is_to_allow_none_of_its_cases(self):
        code, said = self.skips(r"toy_test\.\w+: all classes")
        self.assertEqual((code, len(said.splitlines())), (1, 4), said)

    def test_a_line_that_allows_no_test_is_named(self):
        code, said = self.skips(r"toy_test\..*: all", "gone: it was there once")
        self.assertEqual((code, len(said.splitlines())), (1, 1), said)
        self.assertIn("there is no test gone", said)

    def test_to_a_person_all_are_told(self):
        done = subprocess.run([sys.executable, ROOT / ".ci/skips.py", self.report], capture_output=True, text=True)
        self.assertEqual((done.returncode, sorted(done.stdout.splitlines())),
                         (0, sorted(f"toy_test.{name}: '{reason}'" for name, reason in self.SKIPPED.items())), done.stdout)


if __name__ == "__main__":
    unittest.main()
