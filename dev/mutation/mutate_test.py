#!/usr/bin/env python3
"""Does mutate.py make the mutants that it should, and find out which of them live?  python3 dev/mutation/mutate_test.py

On a small program of each language."""
import collections
import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import unittest.mock
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import mutate
import python_mutants

try:
    from clang.cindex import Index, TranslationUnit
    from cpp_mutants import Rewriter
except ImportError:
    Index = None

CLAMP = """#include <algorithm>

constexpr int kLimit = 3;
static_assert(kLimit == 3);

int clamp(int x) {
  if (x > kLimit && x != 7) return kLimit;
  x += 1;
  return std::max(x, 0);
}
"""
ASK = "int clamp(int);\nint main() { return clamp(9) == 3 && clamp(4) == 3 && clamp(7) == 8 && clamp(-5) == 0 ? 0 : 1; }\n"
# Each mutant, and whether those questions find it. Without an x of 3, > and >= are the same to them; 7 + 1 or - 1 is found by 7.
MUTANTS = collections.Counter({
    ("> becomes >=", False): 1, ("> becomes <=", True): 1, ("operand of && left out", True): 2, ("!= becomes ==", True): 1,
    ("kLimit becomes kLimit + 1", True): 2, ("kLimit becomes kLimit - 1", True): 1, ("kLimit becomes kLimit - 1", False): 1,
    ("7 becomes 7 + 1", True): 1, ("7 becomes 7 - 1", True): 1, ("+= becomes -=", True): 1, ("statement left out", True): 1,
    ("1 becomes 1 + 1", True): 1, ("1 becomes 1 - 1", True): 1, ("std::max becomes std::min", True): 1,
    ("0 becomes 0 + 1", True): 1, ("0 becomes 0 - 1", True): 1, ("return 0 or nothing", True): 2})

PROGRAM = '''"""A docstring."""
def largest(numbers, least=0):
    for x in numbers:
        if x > least and not x == 9:
            least = x
    return least
'''
# A shell that runs this in its background ignores it, and so would every process that is started here.
signal.signal(signal.SIGINT, signal.default_int_handler)


class Python(unittest.TestCase):
    def test_each_change_of_a_small_program_is_made_once(self):
        found = collections.Counter(c.what for c in python_mutants.changes(PROGRAM))
        self.assertEqual(found, collections.Counter({
            "0 becomes 1": 1, "0 becomes -1": 1, "> becomes >=": 1, "> becomes <=": 1, "operand 1 of and left out": 1,
            "operand 2 of and left out": 1, "not left out": 1, "== becomes !=": 1, "9 becomes 10": 1, "9 becomes 8": 1, "return None": 1}))

    def test_a_changed_program_differs_in_that_change_alone(self):
        texts = {c.what: c.text for c in python_mutants.changes(PROGRAM)}
        self.assertEqual(texts["> becomes >="].replace("x >= least", "x > least"), texts["0 becomes 1"].replace("least=1", "least=0"))
        self.assertEqual(len(set(texts.values())), len(texts))
        for text in texts.values():
            compile(text, "changed", "exec")


class Names(unittest.TestCase):
    def test_the_files_of_the_components_are_there_and_none_of_their_folders_is_forgotten(self):
        listed = [file for files in mutate.COMPONENTS.values() for file in files]
        self.assertEqual([file for file in listed if not (mutate.ROOT / file).is_file()], [])
        there = {str(path.relative_to(mutate.ROOT)) for folder in ("src/kernel", "oracle/truth", "oracle/judge", "oracle/diagnosis")
                 for path in (mutate.ROOT / folder).glob("*.cpp") if not path.name.endswith("_test.cpp")}
        # What stands in for the vectors where there is no Highway is not built here, and what only includes them has no line of its own.
        self.assertEqual(there - set(listed), {"src/kernel/batch_no_vectors.cpp", "src/kernel/batch_vectors.cpp"})

    def test_equal_lines_are_told_apart_and_a_changed_line_has_another_name(self):
        entry = {"file": "a.cpp", "line": "x += 1;", "change": "+= becomes -="}
        first, second = mutate.keyed([dict(entry), dict(entry)])
        self.assertNotEqual(mutate.name(first), mutate.name(second))
        self.assertNotEqual(mutate.name(first), mutate.name(mutate.keyed([{**entry, "line": "x += 2;"}])[0]))

    def test_every_explanation_can_be_read_and_says_why(self):
        for text, (_, why) in mutate.explanations().items():
            self.assertEqual(len(text.split("|")) >= 4, True, text)
            self.assertGreater(len(why), 20, text)


POPEN = subprocess.Popen


@unittest.mock.patch("mutate.TREE", HERE)  # where runs stand
class Runs(unittest.TestCase):
    def test_what_takes_too_long_is_killed_with_all_that_it_started(self):
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaises(mutate.Hung):
                mutate.run(["sh", "-c", f"(sleep 2; touch {folder}/late) & wait"], 60, 0.2, {})
            time.sleep(2.5)
            self.assertEqual(os.listdir(folder), [])

    def test_what_takes_too_much_of_a_processor_is_killed_however_long_it_may_take_by_the_clock(self):
        with self.assertRaises(mutate.Hung):
            mutate.run(["sh", "-c", "while :; do :; done"], 1, 600, {})

    def test_to_sleep_takes_nothing_of_a_processor(self):
        status, seconds = mutate.run(["sh", "-c", "sleep 1.5; exit 3"], 1, 600, {})
        self.assertEqual((status, seconds < 1), (3, True))

    def test_an_interruption_of_the_one_that_waits_leaves_neither_process_nor_alarm(self):
        threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
        started = []
        with unittest.mock.patch("mutate.subprocess.Popen", lambda *a, **k: started.append(POPEN(*a, **k)) or started[-1]):
            with self.assertRaises(KeyboardInterrupt):
                mutate.run(["sleep", 600], 60, 600, {})
        self.assertEqual((started[0].returncode, mutate.RUNNING), (-signal.SIGKILL, set()))
        for thread in threading.enumerate():
            if isinstance(thread, threading.Timer):
                thread.join(60)
                self.assertFalse(thread.is_alive())

    def test_an_interruption_ends_what_runs_and_nobody_counts_its_outcome(self):
        threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
        outcomes = []
        try:
            with self.assertRaises(KeyboardInterrupt):
                for status, _ in mutate.side_by_side(lambda seconds: mutate.run(["sleep", seconds], 60, 60, {}), [0, 30, 30, 30]):
                    outcomes.append(status)
        finally:
            mutate.INTERRUPTED.clear()
        self.assertEqual((outcomes, mutate.RUNNING), ([0], set()))


@unittest.skipIf(Index is None, "Python's libclang is not there (python3-clang-14)")
class Cpp(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name).resolve()
        self.path = self.folder / "clamp.cpp"
        self.path.write_text(CLAMP)
        (self.folder / "ask.cpp").write_text(ASK)
        unit = Index.create().parse(str(self.path), ["-std=c++20"], options=TranslationUnit.PARSE_DETAILED_PROCESSING_RECORD)
        self.assertEqual([str(d) for d in unit.diagnostics], [])
        self.rewriter = Rewriter(self.path, CLAMP)
        self.rewriter.visit_unit(unit)
        for number, place in enumerate(self.rewriter.places.values()):
            place.number = number
        self.path.write_text(f'#include "{HERE}/mutant.hpp"\n{self.rewriter.rewritten()}')
        self.program = self.folder / "ask"
        subprocess.run(["g++", "-std=c++20", "-w", self.path, self.folder / "ask.cpp", "-o", self.program], check=True)
        self.mutants = {mutate.KINDS * p.number + i: change for p in self.rewriter.places.values() for i, change in enumerate(p.changes)}

    def status(self, **environment):
        return subprocess.run([self.program], env=environment).returncode

    def test_the_mutants_of_a_small_program_are_these_and_die_where_its_questions_tell(self):
        self.assertEqual(self.status(), 0)
        self.assertEqual(collections.Counter((change, self.status(CONTACT_MUTANT=str(id)) != 0) for id, change in self.mutants.items()), MUTANTS)

    def test_while_recording_nothing_is_changed_and_what_changes_no_value_lives(self):
        self.assertEqual(self.status(CONTACT_MUTANTS_REACHED=str(self.folder / "reached")), 0)
        data = next(self.folder.glob("reached.*")).read_bytes()
        self.assertEqual({data[id] for id in self.mutants}, {1, 2})
        for id, change in self.mutants.items():
            if data[id] == 1:
                self.assertEqual(self.status(CONTACT_MUTANT=str(id)), 0, change)
        self.assertEqual(set(data[max(self.mutants) + mutate.KINDS:]), {0})

    def test_a_constant_that_the_compiler_needs_is_left_alone(self):
        text = self.path.read_text()
        self.assertIn("constexpr int kLimit = 3;\nstatic_assert(kLimit == 3);", text)


if __name__ == "__main__":
    unittest.main()
