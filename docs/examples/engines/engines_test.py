#!/usr/bin/env python3
"""The example engines, and engines that misbehave, as a user meets them: python3 engines_test.py TOOL FOLDER.

FOLDER holds the built examples. Independent runs go two at a time."""
import concurrent.futures
import json
import os
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import uuid
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "tool"))
from published import published  # noqa: E402

TOOL, BUILT = (Path(word).resolve() for word in sys.argv[1:3]) if len(sys.argv) > 2 else sys.exit(__doc__)
ROOT = Path(__file__).resolve().parents[3]
SOURCES = ROOT / "docs/examples/engines"
GOLDEN = ROOT / "golden"
SPHERES = sorted((GOLDEN / "sphere_sphere").glob("*.jsonl"))
EACH = 60  # of their questions: all kinds of a family take turns in fewer
NODE = shutil.which("node")
PLAIN_LIBRARY, BAD_LIBRARY = BUILT / "plain_library.so", BUILT / "misbehaving_library.so"
# What to give certify, and what to start to talk to the engine without certify.
ENGINES = {
    "plain.py": ("--engine-command", shlex.join([sys.executable, str(SOURCES / "plain.py")])),
    "plain_pipe.c": ("--engine-command", shlex.join([str(BUILT / "plain_pipe")])),
    "plain_library.c": ("--engine-library", str(PLAIN_LIBRARY)),
}
if NODE:
    ENGINES["plain.js"] = ("--engine-command", shlex.join([NODE, str(SOURCES / "plain.js")]))
# Nothing that is started for a test may outlive it; this is how it is found.
MARK = f"CONTACT_ENGINES_TEST={uuid.uuid4()}"
LIMIT = 2  # seconds until an engine's answer, where it is to be missed
START_LIMIT = 5  # until its hello, where that is
LONG = 300  # seconds that no engine takes which answers, however busy the machine
UNTIL_DEAD = 3  # failures in a row
# A shell that runs this in its background ignores it, and so would every process that is started here.
signal.signal(signal.SIGINT, signal.default_int_handler)


def marked():
    """The processes that live and descend from this test."""
    found = []
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            if MARK.encode() in (folder / "environ").read_bytes().split(b"\0"):
                found.append((folder / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace"))
        except OSError:
            pass  # gone, or somebody else's
    return found


def dead_children(pid):
    """Children of a process that have ended and that it has not waited for."""
    dead = set()
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            state, parent = (folder / "stat").read_text(errors="replace").rpartition(")")[2].split()[:2]
        except OSError:
            continue
        if state == "Z" and int(parent) == pid:
            dead.add(folder.name)
    return dead


class Run:
    """certify, run to its end."""

    def __init__(self, *args, environment=None):
        with tempfile.TemporaryDirectory() as folder:
            report = Path(folder) / "report.json"
            start = time.monotonic()
            process = subprocess.Popen([TOOL, *published(["certify", *args]), "--json", report], stdout=subprocess.PIPE,
                                       stderr=subprocess.PIPE, cwd=ROOT, env=marked_environment(environment))
            self.zombies, before = set(), set()
            while True:
                try:
                    out, err = process.communicate(timeout=0.7)
                    break
                except subprocess.TimeoutExpired:  # a child is waited for at once: two looks at the same dead one are a leak
                    now = dead_children(process.pid)
                    self.zombies |= now & before
                    before = now
                if time.monotonic() - start > LONG:  # and no exit status is as expected
                    process.kill()
            self.code = process.returncode
            self.out, self.err = out.decode(), err.decode()  # always UTF-8, whatever an engine writes
            self.report = json.loads(report.read_text()) if report.exists() else None


def marked_environment(more=None):
    name, _, value = MARK.partition("=")
    return {**os.environ, name: value, **(more or {})}


def in_pairs(work, items):
    """The results of independent calls, in order."""
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        return list(pool.map(work, items))


def cases(path):
    return [json.loads(line) for line in path.read_text().splitlines()[1:]]


def text(lines):
    return "".join(json.dumps(line) + "\n" for line in lines)


def annotated(folder, name, queries):
    path = Path(folder) / name
    subprocess.run([TOOL, "annotate", "-", "-o", path], input=text(queries), text=True, check=True, capture_output=True)
    return path


def family_of(name):
    """Family and scalar of a committed file."""
    stem = name.removesuffix(".jsonl")
    return (stem.removesuffix(".f32"), "binary32" if stem.endswith(".f32") else "binary64")


def in_scale(case):
    """Whether the examples serve a question: what they declare as their scale."""
    a, b = case["a"], case["b"]
    numbers = [*a["center"], a["radius"], *b["center"], b["radius"], case["alarm"], case["contact"]]
    return all(x == 0 or 1e-100 <= abs(x) <= 1e100 for x in numbers)


def answers(engine, questions):
    """What an engine says to questions, asked by hand over the protocol."""
    option, value = ENGINES[engine]
    command = shlex.split(value) if option == "--engine-command" else [TOOL, "serve", option, value]
    asked = [{"op": "query", "seq": seq, "pair": "sphere_sphere", **{key: case[key] for key in ("a", "b", "alarm", "contact")}}
             for seq, case in enumerate(questions, 1)]
    lines = [json.dumps(line, separators=(",", ":")) for line in [{"op": "hello", "protocol": 1}, *asked, {"op": "stop"}]]
    done = subprocess.run(command, input="\n".join(lines) + "\n", text=True, capture_output=True, check=True, timeout=300)
    # JavaScript writes large numbers as integers, and they are doubles all the same.
    hello, *said = (json.loads(line, parse_int=float) for line in done.stdout.splitlines())
    return hello, said


class NothingIsLeft(unittest.TestCase):
    maxDiff = 2000

    def tearDown(self):
        deadline = time.monotonic() + 3  # what was killed a moment ago may not be gone yet
        while marked() and time.monotonic() < deadline:
            time.sleep(0.05)
        self.assertEqual(marked(), [])


class Examples(NothingIsLeft):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        asked = [Path(folder.name) / path.name for path in SPHERES if not path.name.startswith("invalid")]
        for path in asked:
            header, *lines = (GOLDEN / "sphere_sphere" / path.name).read_text().splitlines()[:EACH + 1]
            path.write_text("\n".join([json.dumps({**json.loads(header), "count": len(lines)}, separators=(",", ":")), *lines, ""]))
        cls.questions = [(path.name, case) for path in asked for case in cases(path) if in_scale(case)]
        engines = list(ENGINES)
        said = in_pairs(lambda engine: answers(engine, [case for _, case in cls.questions]), engines)
        cls.said = dict(zip(engines, said))
        runs = in_pairs(lambda options: Run(folder.name, *options),
                        [*ENGINES.values(), ("--engine", "plain-double")])
        cls.runs = dict(zip([*engines, "plain-double"], runs))

    def test_each_is_shorter_than_60_lines(self):
        for name in ("plain.py", "plain_pipe.c", "plain_library.c", "plain.js"):
            self.assertLess(len((SOURCES / name).read_text().splitlines()), 60, name)

    @unittest.skipUnless(NODE, "there is no node here: plain.js is not certified")
    def test_the_one_in_javascript_is_among_them(self):
        self.assertIn("plain.js", ENGINES)

    def test_all_say_the_same(self):
        hello, first = self.said["plain.py"]
        self.assertEqual((hello["op"], [one["seq"] for one in first]), ("hello", list(range(1, len(self.questions) + 1))))
        self.assertGreater(len(first), 1000)
        for engine, (hello, said) in self.said.items():
            for (name, case), one, other in zip(self.questions, first, said, strict=True):
                if one != other:  # not a subtest each: there are thousands
                    self.fail(f"{engine} differs from plain.py on {case['id']} of {name}:\n{other}\n{one}")

    def test_golden_files_refute_them_exactly_where_their_decisions_are_wrong(self):
        wrong = {}
        for (name, case), one in zip(self.questions, self.said["plain.py"][1]):
            family = wrong.setdefault(family_of(name), {"missed_hits": 0, "false_hits": 0, "cases": 0})
            family["cases"] += 1
            if one["overlap"] != case["expect"]["hit"]:
                family["missed_hits" if case["expect"]["hit"] else "false_hits"] += 1
        self.assertGreater(sum(family["missed_hits"] > 0 for family in wrong.values()), 3)
        for engine in ENGINES:
            run = self.runs[engine]
            with self.subTest(engine):
                self.assertEqual((run.code, run.err), (1, ""))
                judged = {(f["family"], f["scalar"]): f for f in run.report["families"] if f["cases"]}
                self.assertEqual({name: {key: f[key] for key in ("missed_hits", "false_hits", "cases")}
                                  for name, f in judged.items()}, wrong)
                for name, family in judged.items():
                    self.assertEqual(family["answers"]["answered"], family["judged"], name)
                    self.assertEqual((family["not_finite"], sum(f["beyond_bound"] for f in family["fields"].values())), (0, 0))
                    if family["missed_hits"]:
                        self.assertEqual(family["level"], "none", name)
                    elif family["false_hits"]:
                        self.assertEqual(family["level"], "conservative", name)
                    else:
                        self.assertIn(family["level"], ("bounded", "faithful", "correctly-rounded"), name)
                total = run.report["total"]
                self.assertIn(f"{total['missed_hits']} missed hits, {total['false_hits']} false hits.", run.out.splitlines()[-1])
                self.assertTrue(run.out.splitlines()[-1].startswith("REFUTED: "), run.out[-300:])

    def test_their_figures_are_those_of_the_built_in_engine_of_the_same_arithmetic(self):
        built_in = {(f["family"], f["scalar"]): f for f in self.runs["plain-double"].report["families"]}
        for engine in ENGINES:
            compared = 0
            for family in self.runs[engine].report["families"]:
                other = built_in[family["family"], family["scalar"]]
                # Coincident centres are the one difference: the built-in engine divides 0 by 0.
                if family["cases"] == other["cases"] and family["family"] != "coincident":
                    self.assertEqual(family, other)
                    compared += 1
            self.assertGreaterEqual(compared, 18, engine)

    def test_they_are_certified_where_plain_arithmetic_is_exact(self):
        # Spheres with small integers, some of them touching: 3-4-5 and 1-2-2-3. Boxes by plain.py and the library alone.
        spheres = [{"pair": "sphere_sphere", "a": {"center": [0, 0, 0], "radius": i}, "alarm": alarm, "contact": 1,
                    "b": {"center": center, "radius": j}}
                   for center in ([3, 4, 0], [1, 2, 2], [0, 0, 0], [7, 0, 1]) for i in (1, 2) for j in (1, 3) for alarm in (0, 1)]
        boxes = [{"pair": "cube_cube", "a": {"min": [0, 0, 0], "max": [2, 2, 2]}, "alarm": alarm, "contact": 0,
                  "b": {"min": [i, j, 0], "max": [i + 1, j + 1, 1]}} for i in (-2, -1, 1, 2, 3) for j in (0, 2, 4) for alarm in (0, 1)]
        with tempfile.TemporaryDirectory() as folder:
            files = [annotated(folder, "spheres.jsonl", spheres), annotated(folder, "boxes.jsonl", boxes)]
            serve_boxes = ("plain.py", "plain_library.c")
            runs = in_pairs(lambda engine: Run(*files, *ENGINES[engine], "--level", "decisions"), ENGINES)
            for engine, run in zip(ENGINES, runs):
                with self.subTest(engine):
                    self.assertEqual((run.code, run.err), (0, ""))
                    self.assertIn("\nCERTIFIED: plain-", run.out)
                    families = {f["pair"]: f for f in run.report["families"]}
                    judged = len(spheres) + len(boxes) * (engine in serve_boxes)
                    self.assertEqual(run.report["total"]["judged"], judged)
                    self.assertGreater(families["sphere_sphere"]["hits"], 10)
                    self.assertLess(families["sphere_sphere"]["hits"], len(spheres) - 5)
                    if engine not in serve_boxes:
                        self.assertEqual([(s["why"], s["cases"]) for s in run.report["skipped"]],
                                         [("the engine does not serve cube_cube", len(boxes))])


class Misbehaving(NothingIsLeft):
    # mode: (status of the question with contact distance 13, text in the report of it)
    AT_13 = {
        "exits at 13": ("crash", "exited with status 3; its standard error ends in 'out of cheese'"),
        "is killed at 13": ("crash", "was killed by signal 6 (Aborted)"),
        "half a line, then exits at 13": ("crash", """exited with status 0 after half a line: '{"op":"answer","se'"""),
        "hangs at 13": ("timeout", f"no answer within {LIMIT} s"),
        "stops reading at 13": ("timeout", f"no answer within {LIMIT} s"),
        "half a line at 13": ("timeout", f"""no answer within {LIMIT} s, half a line: '{{"op":"answer","se'"""),
        "malformed at 13": ("error", "overlap: expected true or false, got 1"),
        "garbage at 13": ("error", "malformed JSON"),
        "invalid UTF-8 at 13": ("error", "UTF-8"),
        "endless line at 13": ("error", "a line of more than 1048576 bytes: 'xxx"),
        "floods at 13": ("error", "was answered before"),
        "repeats at 13": ("error", "was answered before"),
        "wrong seq at 13": ("error", "was not asked"),
    }
    HARMLESS = ("well behaved", "noisy", "leaves a grandchild", "backwards")
    NO_START = {
        "exits at once": "the engine exited with status 7",
        "is killed at once": "was killed by signal 11 (Segmentation fault)",
        "closes its output": "the engine closed its output",
        "says nothing": f"no hello within {START_LIMIT} s",
        "half a hello": f"""no hello within {START_LIMIT} s, half a line: '{{"op":"hello","pro'""",
        "garbage hello": "in 'Welcome to my engine 1.0!'",
        "wrong protocol": "this program speaks protocol 1, got 2",
        "unknown pair": "\"sphere_torus\"",
        "claims nothing": "claims nothing",
        "malformed smoke": "expected true or false, got \"yes\"",
    }
    DEAD = {"always exits": "crash", "always hangs": "timeout", "repeats everything": "error"}

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        # Unit spheres 0 to 3 apart: a hit up to 2. One question in the middle has the contact distance 13. There are two
        # files, so that two processes are asked at once with --jobs 2; only one of them holds the bad question.
        query = lambda i, contact=0.0: {"pair": "sphere_sphere", "a": {"center": [i // 4, 0, 0], "radius": 1}, "alarm": 0,
                                        "b": {"center": [i // 4 + i % 4, 0, 0], "radius": 1}, "contact": contact}
        cls.data = [annotated(folder.name, "one.jsonl", [query(i, 13 if i == 17 else 0) for i in range(40)]),
                    annotated(folder.name, "two.jsonl", [query(i, 1) for i in range(40)])]
        cls.bad, = (case["id"] for case in cases(cls.data[0]) if case["contact"] == 13)

    def certify(self, mode, *more, start_limit=LONG):
        command = shlex.join([sys.executable, str(ROOT / "engines/hosts/misbehaving_engine.py"), mode])
        late = "timeout" in (self.AT_13.get(mode, ("",))[0], self.DEAD.get(mode))
        return Run(*self.data, "--engine-command", command, "--start-limit", start_limit, "--answer-limit", LIMIT if late else LONG,
                   "--level", "decisions", *more)

    def judged(self, mode, run, **statuses):
        """Every question is judged; these have a status of their own, and all others are right."""
        total = run.report["total"]
        answered = 80 - sum(statuses.values())
        self.assertEqual({k: v for k, v in total["answers"].items() if v}, {"answered": answered, **statuses} if answered else statuses)
        self.assertEqual((total["judged"], total["missed_hits"], total["false_hits"]), (80, 0, 0), mode)
        self.assertEqual(run.zombies, set(), mode)
        self.assertEqual(run.err, "", mode)

    def test_one_question_that_fails_is_named_and_the_others_are_judged(self):
        table = [(mode, jobs) for mode in self.AT_13 for jobs in (1, 2)]
        runs = in_pairs(lambda row: self.certify(row[0], "--jobs", row[1]), table)
        for (mode, jobs), run in zip(table, runs):
            with self.subTest(mode, jobs=jobs):
                status, words = self.AT_13[mode]
                self.assertEqual(run.code, 1, run.out + run.err)
                self.judged(mode, run, **{status: 1})
                (worst,) = run.report["worst"]
                self.assertEqual(worst["query"]["id"], self.bad)
                self.assertTrue(worst["what"].startswith(status + ": "), worst["what"])
                self.assertIn(words, worst["what"])
                self.assertIn(words, run.out)
                self.assertRegex(run.out, rf"\nREFUTED: misbehaving {mode} .*: 1 {status}\. It rests on .*\n$")

    def test_bad_manners_alone_are_no_failure(self):
        # "backwards" answers four at a time, after the first question; a second process would hold the last three for ever.
        table = [(mode, jobs) for mode in self.HARMLESS for jobs in (1, 2) if (mode, jobs) != ("backwards", 2)]
        for (mode, jobs), run in zip(table, in_pairs(lambda row: self.certify(row[0], "--jobs", row[1]), table)):
            with self.subTest(mode, jobs=jobs):
                self.assertEqual(run.code, 0, run.out + run.err)
                self.judged(mode, run)

    def test_an_engine_that_always_fails_is_given_up(self):
        for (mode, status), run in zip(self.DEAD.items(), in_pairs(self.certify, self.DEAD)):
            with self.subTest(mode):
                self.assertEqual(run.code, 3, run.out)
                self.assertIn(f"\nHARNESS INVALID: misbehaving {mode} never gave an answer", run.out)
                self.judged(mode, run, **{status: UNTIL_DEAD, "missing": 80 - UNTIL_DEAD})

    def test_an_engine_that_dies_half_way_leaves_the_rest_missing_and_is_refuted(self):
        # Only the second file's questions make it fail: the first is answered, the second is not.
        run = self.certify("exits from 1 on")
        self.assertEqual(run.code, 1, run.out)
        self.judged("exits from 1 on", run, crash=UNTIL_DEAD, missing=40 - UNTIL_DEAD)

    def test_an_engine_that_does_not_start_is_told_at_once(self):
        def started(mode):
            hangs = self.NO_START[mode].startswith("no hello")
            return self.certify(mode, start_limit=START_LIMIT if hangs else LONG)
        for mode, run in zip(self.NO_START, in_pairs(started, self.NO_START)):
            with self.subTest(mode):
                self.assertEqual((run.code, run.out, run.report), (3, "", None), run.err)
                self.assertTrue(run.err.startswith("contact-oracle: harness invalid: "), run.err)
                self.assertIn(self.NO_START[mode], run.err)
                self.assertEqual(len(run.err.splitlines()), 1)

    def test_every_mode_is_tried(self):
        modes = set((ROOT / "engines/hosts/misbehaving_engine.py").read_text().split("mode == \"")[1:])
        modes = {mode.split('"')[0] for mode in modes} | {"well behaved"}
        self.assertEqual(modes, {*self.AT_13, *self.HARMLESS, *self.NO_START, *self.DEAD, "exits from 1 on"})

    def test_an_interruption_ends_the_run_and_the_engine(self):
        def interrupted(jobs):
            command = shlex.join([sys.executable, str(ROOT / "engines/hosts/misbehaving_engine.py"), "always hangs"])
            process = subprocess.Popen([TOOL, "certify", *self.data, "--fresh", "0", "--engine-command", command, "--jobs", str(jobs),
                                        "--answer-limit", str(2 * LONG)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=ROOT,
                                       env=marked_environment())
            while not Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text():
                self.assertIsNone(process.poll(), "ended before its engine began")
                time.sleep(0.05)
            process.send_signal(signal.SIGINT)
            return *process.communicate(timeout=LONG), process.returncode
        for jobs in (1, 2):  # one by one: each waits for the first engine that begins
            out, err, code = interrupted(jobs)  # sooner than an answer's limit
            self.assertEqual((code, out), (130, ""), err)
            self.assertIn("interrupted", err)


class Libraries(NothingIsLeft):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.data = annotated(folder.name, "data.jsonl", [
            {"pair": "sphere_sphere", "a": {"center": [0, 0, 0], "radius": 1}, "b": {"center": [i % 4, 0, 0], "radius": 1 + i // 4},
             "alarm": 0, "contact": 13 if i == 5 else 0} for i in range(24)])

    def certify(self, library, misbehaves=""):
        return Run(self.data, "--engine-library", library, "--level", "decisions", environment={"CONTACT_MISBEHAVES": misbehaves})

    def test_a_library_that_is_none_is_refused_with_the_reason(self):
        words, empty = self.folder / "words.so", self.folder / "empty.c"
        words.write_text("no library\n")
        libm = next((line.split()[2] for line in subprocess.run(["ldd", TOOL], capture_output=True, text=True).stdout.splitlines()
                     if "libm.so" in line), None)
        table = {
            (self.folder / "gone.so", ""): (2, "gone.so: no such file"),
            (words, ""): (3, "words.so: cannot be loaded: "),
            (BAD_LIBRARY, "wrong interface"): (3, "was built for engine interface 2, this is 1"),
            (BAD_LIBRARY, "no declaration"): (3, "declaration: malformed JSON"),
        }
        if libm:
            table[libm, ""] = (3, "is no engine: it exports no contact_engine_interface")
        for ((library, _), (code, message)), run in zip(table.items(), in_pairs(lambda row: self.certify(*row), table)):
            with self.subTest(message):
                self.assertEqual((run.code, run.out), (code, ""), run.err)
                self.assertIn(message, run.err)
                self.assertIn(str(library), run.err)
                self.assertEqual(len(run.err.splitlines()), 1)

    def test_a_library_that_fails_is_judged(self):
        table = {"": (0, {"answered": 24}, "\nCERTIFIED: misbehaving 1 "),
                 "crashes": (1, {"answered": 23, "crash": 1}, "crash: the engine was killed by signal 6 (Aborted)"),
                 "says error": (1, {"answered": 23, "error": 1}, "error: the library says so"),
                 "returns an error": (3, {"error": 24}, "error: contact_engine_answer returned 5")}
        for mode, run in zip(table, in_pairs(lambda mode: self.certify(BAD_LIBRARY, mode), table)):
            with self.subTest(mode):
                code, answers, words = table[mode]
                self.assertEqual((run.code, run.err), (code, ""), run.out)
                self.assertEqual({k: v for k, v in run.report["total"]["answers"].items() if v}, answers)
                self.assertIn(words, run.out)
                self.assertEqual((run.report["total"]["missed_hits"], run.report["total"]["false_hits"]), (0, 0))


class Results(unittest.TestCase):
    def test_what_is_missing_and_what_was_never_asked_is_told(self):
        data = GOLDEN / "sphere_sphere/touching.jsonl"
        asked = cases(data)
        said = [{"id": case["id"], "overlap": case["expect"]["hit"]} for case in asked]
        header = {"format": "contact-oracle/results", "version": 1, "engine": {"name": "test", "version": "1"},
                  "scalar": "binary64", "pairs": ["sphere_sphere"], "claims": ["overlap"]}
        unknown = {"id": "0123456789abcdef01234567", "overlap": True}
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "answers.jsonl"
            path.write_text(text([header, *said[:3], *said[4:]]))
            run = Run(data, "--results", path, "--level", "decisions")
            self.assertEqual((run.code, run.err), (1, ""))
            self.assertEqual([worst["query"]["id"] for worst in run.report["worst"]], [asked[3]["id"]])
            self.assertIn("1 missing", run.out)
            self.assertIn(asked[3]["id"], run.out)
            # An answer to what is not asked is no mistake, since --family asks a part; but it is told.
            path.write_text(text([header, *said, unknown]))
            run = Run(data, "--results", path, "--level", "decisions")
            self.assertEqual((run.code, run.err), (0, ""))
            self.assertRegex(run.out, r"\n  1 recorded answer belongs to no question asked: \w{24}\n")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
