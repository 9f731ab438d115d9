#!/usr/bin/env python3
"""The command line as a user meets it: python3 tool/cli_test.py PATH_TO_TOOL [unittest arguments].

The environment variable CONTACT_PLUGINS names the two example plug-ins to test with, capsule:cube_contact."""
import copy
import hashlib
import json
import math
import os
import pty
import re
import resource
import shlex
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree as ElementTree
from fractions import Fraction
from pathlib import Path

from published import published

TOOL = os.path.abspath(sys.argv[1]) if len(sys.argv) > 1 else sys.exit(__doc__)
ROOT = Path(__file__).resolve().parent.parent
GOLDEN = ROOT / "golden"
RECORDED = GOLDEN / "recorded" / "sofa-2a278d8"
LEVELS = ["correctly-rounded", "faithful", "bounded", "decisions", "conservative", "none"]
PAIRS = ("sphere_sphere", "rigid_sphere_rigid_sphere", "sphere_rigid_sphere", "cube_cube", "sphere_cube", "sphere_capsule",
         "capsule_capsule", "sphere_triangle", "ray_sphere", "sphere_plane", "capsule_plane", "ray_triangle",
         "triangle_line", "cast_sphere", "cast_cube", "cast_capsule", "cast_triangle", "cast_plane", "obb_obb", "sphere_obb",
         "capsule_cube", "capsule_obb", "capsule_triangle", "cube_obb", "cube_triangle", "obb_triangle", "triangle_triangle", "cube_plane",
         "obb_plane", "triangle_plane", "sphere_hull", "capsule_hull", "cube_hull", "obb_hull", "triangle_hull", "hull_hull", "hull_plane")
CONVEXES = PAIRS[18:]
COMMITTED = tuple(pair for pair in PAIRS if (GOLDEN / pair).exists())
SOFA_PAIRS = PAIRS[:4]  # of DiscreteIntersection
SPHERES = {"a": {"center": [0, 0, 0], "radius": 1.5}, "b": {"center": [1, 2, 2], "radius": 1.5}, "alarm": 0, "contact": 0.25}
CUBES = {"a": {"min": [0, 0, 0], "max": [1, 1, 1]}, "b": {"min": [1, 0, 0], "max": [2, 1, 1]}, "alarm": 0.5, "contact": 0}
PLAIN = ROOT / "docs" / "examples" / "engines" / "plain.py"
# An engine that answers the question it is tried with, and then claims nothing.
SILENT = """import json, sys
asked = 0
for line in sys.stdin:
    message = json.loads(line)
    if message["op"] == "hello":
        print(json.dumps({"op": "hello", "protocol": 1, "engine": {"name": "silent", "version": "1"}, "scalar": "binary64",
                          "pairs": ["sphere_sphere"]}), flush=True)
    elif message["op"] == "query":
        asked += 1
        claim = {"overlap": True, "contact": None} if asked == 1 else {}
        print(json.dumps({"op": "answer", "seq": message["seq"], **claim}), flush=True)
"""
# What `serve` says, but for the pairs of its hello.
ONLY = """import json, subprocess, sys
serve = subprocess.Popen([sys.argv[1], "serve"], stdout=subprocess.PIPE)
hello = json.loads(serve.stdout.readline())
print(json.dumps({**hello, "pairs": sys.argv[2:]}), flush=True)
while data := serve.stdout.read1():
    sys.stdout.buffer.write(data)
    sys.stdout.buffer.flush()
"""
# A shell that runs this in its background ignores it, and so would every process that is started here.
signal.signal(signal.SIGINT, signal.default_int_handler)
SPHERES_ID, CUBES_ID = "7827fbcb904c1b0d7baa72b0", "39f8ccec244e593cfa1b7ad5"
SPHERES_EXPECT = ('"expect":{"hit":true,"degenerate":false,"normal":[0.3333333333333333,0.6666666666666666,'
                  '0.6666666666666666],"point1":[0.5,1,1],"point2":[0.5,1,1],"value":-0.25},'
                  '"exact":{"distance2":"0x9p0","reach":"0x3p0","margin_ulps":0}}')


def run(*args, stdin="", by=(), **options):
    options = {"input": stdin, "capture_output": True, "text": True, "timeout": 600, "cwd": ROOT, **options}
    return subprocess.run([*by, TOOL, *published(args)], **options)


def wait_until_signals_are_caught(process):
    """Before that a signal itself ends it; a program of ours catches them before it does anything."""
    deadline = time.monotonic() + 300
    while True:
        status = Path(f"/proc/{process.pid}/status").read_text()
        if int(re.search(r"SigCgt:\s+([0-9a-f]+)", status)[1], 16) >> (signal.SIGTERM - 1) & 1:
            return
        if process.poll() is not None or time.monotonic() > deadline:
            raise AssertionError(f"ended, or catches no signals: {process.args}")
        time.sleep(0.005)


def line(value):
    return json.dumps(value, separators=(",", ":"))


def text(lines):
    return "".join((one if isinstance(one, str) else line(one)) + "\n" for one in lines)


def committed(path, first=0, count=None):
    """Header and cases of a committed file, or of a slice of it."""
    header, *cases = map(json.loads, (GOLDEN / path).read_text().splitlines())
    cases = cases[first:None if count is None else first + count]
    return [{**header, "count": len(cases)}, *cases]


def put(lines, path, value, at=1):
    """A copy of the lines in which one value, named by its keys, is another; a function makes it from the old one."""
    lines = copy.deepcopy(lines)
    *outer, last = path
    place = lines[at]
    for key in outer:
        place = place[key]
    place[last] = value(place[last]) if callable(value) else value
    return lines


def next_up(x):
    return math.nextafter(x, math.inf)


def exact_hit(case):
    """Hit or miss in rational arithmetic, from the inputs alone."""
    a, b, alarm = case["a"], case["b"], Fraction(case["alarm"])
    if "min" in a:
        return all(max(Fraction(a["min"][i]) - Fraction(b["max"][i]), Fraction(b["min"][i]) - Fraction(a["max"][i])) <= alarm
                   for i in range(3))
    distance2 = sum((Fraction(p) - Fraction(q)) ** 2 for p, q in zip(a["center"], b["center"]))
    return distance2 <= (alarm + Fraction(a["radius"]) + Fraction(b["radius"])) ** 2


def identified(lines, at=1):
    """A copy in which one case has the id of the question that it asks."""
    case = lines[at]
    words = [case["a"], case["b"], {"": case["alarm"]}, {"": case["contact"]}]
    numbers = [float(x) for word in words for value in word.values() for x in flat(value)]
    packed = b"".join(b"\x7f\xf8" + bytes(6) if math.isnan(x) else struct.pack(">d", x + 0.0) for x in numbers)
    return put(lines, ["id"], hashlib.sha256(lines[0]["pair"].encode() + b"\0" + packed).hexdigest()[:24], at)


def flat(value):
    return value if isinstance(value, list) else [value]


def recorded_counts(pair, lines):
    """Missed hits, false hits and answers with a field that is no number where the truth is one, from the files."""
    answers = {a["id"]: a for a in map(json.loads, (RECORDED / f"{pair}.jsonl").read_text().splitlines()[1:])}
    missed = false = not_finite = 0
    for case in lines[1:]:
        answer, hit = answers[case["id"]], exact_hit(case)
        says = [answer["overlap"]] + ([answer["contact"] is not None] if "contact" in answer else [])
        missed += hit and not all(says)
        false += not hit and any(says)
        if hit and answer.get("contact"):
            not_finite += any(isinstance(claim, str) and claim != right for field, value in answer["contact"].items()
                              for claim, right in zip(flat(value), flat(case["expect"][field])))
    return {"missed_hits": missed, "false_hits": false, "not_finite": not_finite}


def without_distance(answer):
    """What explain --json says beyond a golden file is the distance."""
    return {key: value for key, value in answer.items() if key != "distance"}


def answers_to(lines, **header):
    """A results file that answers every case with what it expects."""
    first = {"format": "contact-oracle/results", "version": 1, "engine": {"name": "test", "version": "1"},
             "scalar": lines[0]["scalar"], "pairs": [lines[0]["pair"]], "conventions": {}, **header}
    answers = []
    for case in lines[1:]:
        expect = case["expect"]
        answers.append({"id": case["id"], "overlap": expect["hit"]})
        if "min" not in case["a"]:
            answers[-1]["contact"] = ({key: expect[key] for key in ("normal", "point1", "point2", "value")}
                                      if expect["hit"] else None)
    return [first, *answers]


class Case(unittest.TestCase):
    longMessage = True
    maxDiff = 2000

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def file(self, name, lines):
        path = self.folder / name
        path.write_text(lines if isinstance(lines, str) else text(lines))
        return path

    def holds(self, *args, **options):
        done = run(*args, **options)
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout[-800:])
        return done.stdout

    def refuted(self, *args):
        done = run(*args)
        self.assertEqual((done.returncode, done.stderr), (1, ""), done.stdout[-800:])
        self.assertNotIn("\nCERTIFIED", done.stdout)
        return done.stdout

    def refused(self, args, *words, one_line=True, **options):
        """Exit code 2, a message with every one of the words, no verdict, and not a file more than before."""
        before = sorted(self.folder.rglob("*"))
        done = run(*args, **options)
        self.assertEqual(done.returncode, 2, done.stdout[-400:] + done.stderr)
        for word in words:
            self.assertIn(str(word), done.stderr)
        if one_line:
            self.assertTrue(done.stderr.startswith("contact-oracle: "), done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertNotEqual(done.stderr, "")
        self.assertNotIn("CERTIFIED", done.stdout)
        self.assertEqual(sorted(self.folder.rglob("*")), before)
        return done

    def interrupted(self, args, once=wait_until_signals_are_caught, by=signal.SIGINT):
        """What a command says on standard output and standard error that a signal ends. Its input stays open."""
        with subprocess.Popen([TOOL, *map(str, args)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
            try:
                once(process)
                process.send_signal(by)
                self.assertEqual(process.wait(timeout=300), 130)
                return process.communicate()
            finally:
                process.kill()

    def files_are(self, count):
        """Waits until so many stand in the folder."""
        deadline = time.monotonic() + 300
        while len(list(self.folder.iterdir())) < count and time.monotonic() < deadline:
            time.sleep(0.02)

    def reports(self):
        return [word for name in ("json", "junit", "report", "markdown") for word in (f"--{name}", self.folder / f"out.{name}")]

    def certify_json(self, *args):
        path = self.folder / "report.json"
        done = run("certify", *args, "--json", path)
        self.assertEqual(done.stderr, "")
        report = json.loads(path.read_text())
        self.assertEqual(done.returncode, 0 if report["certified"] else 1)
        return report

    def annotated(self, *queries):
        path = self.folder / "annotated.jsonl"
        self.holds("annotate", "-", "-o", path, stdin=text(queries))
        return path


def readme(name):
    """A block of the README."""
    page = (ROOT / "README.md").read_text()
    return page.split(f"<!-- {name}:begin -->")[1].split(f"<!-- {name}:end -->")[0].strip().removeprefix("```text\n").removesuffix("```")


class Documentation(Case):
    def test_the_readme_shows_what_explain_says(self):
        shell, shown = readme("explain").split("./run explain\n")
        self.assertEqual(self.holds("explain", stdin=shell.split("'")[1] + "\n"), shown)

    def stands(self, page, *args):
        """What a command prints, and that is more than a heading, stands on a page."""
        table, text = self.holds(*args), (ROOT / "docs" / page).read_text()
        self.assertGreater(len(table.splitlines()), 3)
        self.assertIn(table, text)
        return text

    def test_the_tables_of_families_and_flags_are_the_programs(self):
        page = (ROOT / "docs" / "formats.md").read_text()
        families, *tables = re.split(r"(?<=:end -->)\n", self.holds("tables").strip())
        self.assertGreater(len(tables), 1)
        for table in tables:
            self.assertGreater(len(table.splitlines()), 4)
            self.assertIn(table, page)
        # The site shows the table of families; the page sends its readers to the list, which has the same.
        listed = [json.loads(line) for line in self.holds("families", "--json").splitlines()]
        self.assertEqual(re.findall(r"(?m)^\| ([^|]+) \| `(\w+)` \| ", families), [(one["shapes"], one["family"]) for one in listed if "family" in one])

    def test_the_version_is_that_of_the_source(self):
        # packaging/repository_test.py looks at the other places. The generator has a number of its own, which changes with what it makes.
        version = self.holds("--version").split()[1]
        self.assertEqual(re.search(r"(?m)^project\(contact-oracle VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())[1], version)

    def test_the_picture_of_the_pairs_is_drawn_from_what_explain_says(self):
        drawn = self.folder / "pairs.svg"
        subprocess.run([sys.executable, ROOT / "docs" / "draw_pairs.py", TOOL, drawn], check=True, timeout=300)
        self.assertEqual(drawn.read_text(), (ROOT / "docs" / "pairs.svg").read_text())
        for pair in PAIRS:
            self.assertIn(f">{pair}<" if "rigid" not in pair else "<svg", drawn.read_text(), pair)

    def test_the_table_of_laws_is_the_programs(self):
        self.stands("properties.md", "properties", "--table")

    def test_what_public_engines_did_wrong_is_a_mutant_or_listed_with_the_reason_why_it_is_none(self):
        mutants = self.holds("engines", "--table")
        others = (ROOT / "docs/bug-zoo.md").read_text().split("## What cannot happen here")[1]
        real = re.findall(r"(?m)^\| `([a-z0-9-]+)` \| \[real\]\(https://", mutants)
        reasons = re.findall(r"(?m)^\| `([a-z0-9-]+)` \| \[[^|]*\]\(https://[^|]*\) \| [^|]{10,} \|$", others)
        self.assertEqual((len(set(real + reasons)), len(real) + len(reasons)), (154, 154))

    def test_mutants_are_counted_listed_and_refused_with_the_names_near_by(self):
        self.assertRegex(self.holds("engines"), r"(?m)^mutant:ID +[0-9]{3} engines")
        self.assertIn("\nmutant:rapier-coincident-nan ", self.holds("engines", "--mutants"))
        listed = [json.loads(one) for one in self.holds("engines", "--json").splitlines()]
        self.assertGreaterEqual(sum(one["name"].startswith("mutant:") for one in listed), 150)
        self.assertTrue(all(one["about"] and one["diagnosis"] for one in listed if "origin" in one))
        self.refused(["certify", "--engine", "mutant:rapier-coincidence-nan"], "rapier-coincident-nan")

    def test_a_mutant_is_refuted_and_its_mistake_named(self):
        for mutant, words in (("rapier-coincident-nan", "normal is NaN or infinite, where the centres coincide"),
                              ("bytearena-fixture-a-twice", "radius of the first sphere used for both"),
                              ("contact-ignored", "contact distance ignored")):
            out = self.refuted("certify", *(GOLDEN / "sphere_sphere" / f"{family}.jsonl" for family in ("coincident", "generic", "touching")),
                               "--engine", f"mutant:{mutant}")
            self.assertIn(f"Diagnosis:\n  {words}", out)

    def test_the_scene_in_the_help_is_the_one_on_the_page(self):
        page = (ROOT / "docs" / "formats.md").read_text()
        form = self.holds("detect", "--help").split("docs/formats.md#scenes.\n\n")[1].rstrip()
        self.assertEqual(len(form.splitlines()), 9)
        self.assertIn(form, page)


class Scoreboard(Case):
    """certify without an argument, which is asked for once: a copy of the program with a few golden files beside it."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.golden = Path(folder.name).resolve() / "share" / "contact-oracle" / "golden"
        for name in ("sphere_sphere/generic.f32.jsonl", "sphere_sphere/touching.jsonl", "sphere_sphere/touching.f32.jsonl", "cube_cube/touching.jsonl"):
            (cls.golden / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(GOLDEN / name, cls.golden / name)
        tool = Path(folder.name) / "bin" / "contact-oracle"
        tool.parent.mkdir()
        shutil.copy(TOOL, tool)
        cls.board = cls.printed(tool)

    @staticmethod
    def printed(tool):
        done = subprocess.run([tool, *published(["certify"])], capture_output=True, text=True, timeout=600)
        if (done.returncode, done.stderr) != (0, ""):
            raise AssertionError(done.stderr or done.stdout)
        return done.stdout

    def test_the_scoreboard_certifies_production_and_refutes_plain_arithmetic_and_the_printed_formula(self):
        out = self.board
        rows = {row.split()[0]: row.split()[1:3] for row in out.splitlines()[2:6]}
        self.assertEqual(rows["production"], ["certified", "correctly-rounded"])
        for engine in ("plain-double", "plain-float", "published"):
            self.assertEqual(rows[engine][0], "REFUTED")
            self.assertRegex(out, rf"(?m)^REFUTED: {engine} ")
        self.assertRegex(out, r"(?m)^CERTIFIED: production .* correctly-rounded")

    def test_the_golden_files_of_the_program_are_used_wherever_it_runs_and_named(self):
        (self.folder / "golden" / "cube_cube").mkdir(parents=True)
        self.file("golden/cube_cube/flat.jsonl", committed("cube_cube/flat.jsonl", 0, 3))
        report = self.folder / "r.json"
        out = self.holds("certify", "--engine", "production", "--family", "nested", "--json", report, cwd=self.folder)
        self.assertEqual(out.splitlines()[0], f"golden files: {GOLDEN}")
        self.assertEqual(json.loads(report.read_text())["total"]["cases"], 740)
        out = self.holds("certify", "golden", "--engine", "production", "--json", report, cwd=self.folder)
        self.assertNotIn("golden files", out)
        self.assertEqual(json.loads(report.read_text())["total"]["cases"], 3)
        self.assertTrue(self.board.startswith(f"golden files: {self.golden}\n"))

    def test_that_production_is_judged_where_no_engine_is_named_is_said(self):
        said = "no engine is named: production is judged\n"
        flat = GOLDEN / "cube_cube" / "flat.jsonl"
        self.assertTrue(self.holds("certify", flat).startswith(said))
        self.assertTrue(self.holds("certify", "--generate", 2, "--pair", "cube_cube", "--seed", 1).startswith("seed 1\n" + said))
        self.assertNotIn(said, self.holds("certify", flat, "--engine", "production") + self.board)


class Certify(Case):
    def test_production_is_correctly_rounded_on_committed_files_of_every_pair(self):
        families = ("generic", "hardest", "ties", "touching", "through_edge", "upstream")
        files = [path for pair in COMMITTED for path in (GOLDEN / pair).glob("*.jsonl") if path.name.split(".")[0] in families]
        self.assertEqual({path.parent.name for path in files}, set(COMMITTED))
        self.assertIn(" reaches correctly-rounded on all ", self.holds("certify", *files, "--level", "correctly-rounded"))

    def test_the_published_formula_is_refuted_and_the_diagnosis_names_its_convention(self):
        self.assertIn("points = published", self.refuted("certify", GOLDEN / "sphere_sphere" / "generic.jsonl", "--engine", "published"))

    def test_the_published_formula_is_right_under_its_own_convention(self, folder="golden/quick"):
        out = self.holds("certify", folder, "--engine", "published", "--points", "published", "--level", "correctly-rounded")
        self.assertIn("\nCERTIFIED: published", out)

    def test_the_component_is_right_under_every_convention_that_it_computes(self):
        # `center` alone tells a rigid sphere from a deformable one.
        for points in ("nearest_surface", "center", "published"):
            with self.subTest(points):
                out = self.holds("certify", *(GOLDEN / pair / "generic.jsonl" for pair in COMMITTED), "--engine", "component",
                                 "--points", points, "--level", "correctly-rounded")
                self.assertIn("\nCERTIFIED: component", out)
        self.assertIn("\nCERTIFIED: component", self.holds("certify", "golden", "--engine", "component", "--family", "invalid"))

    def test_batches_are_right_with_every_instruction_set_and_convention(self):
        sets = run("certify", "golden", "--engine", "batch:none").stderr.split("known: ")[1].strip().split(", ")
        for engine in ["batch", *(f"batch:{name}" for name in sets)]:
            with self.subTest(engine):
                out = self.holds("certify", "golden/quick", "--engine", engine, "--level", "correctly-rounded")
                self.assertIn(f"\nCERTIFIED: {engine}", out)
        for points in ("center", "published"):
            out = self.holds("certify", *(GOLDEN / pair / "generic.jsonl" for pair in COMMITTED), "--engine", "batch",
                             "--points", points, "--level", "correctly-rounded")
            self.assertIn("\nCERTIFIED: batch", out)

    def test_recorded_answers_of_sofa_are_refuted_with_the_counts_that_the_files_hold(self):
        for pair in SOFA_PAIRS:
            with self.subTest(pair):
                dataset = f"{pair}/upstream.jsonl"
                args = ("certify", GOLDEN / dataset, "--family", "upstream", "--results", RECORDED / f"{pair}.jsonl")
                self.refuted(*args, *self.reports())
                total = json.loads((self.folder / "out.json").read_text())["total"]
                lines = committed(dataset)
                counts = recorded_counts(pair, lines)
                self.assertEqual({key: total[key] for key in counts}, counts)
                self.assertGreater(sum(counts.values()), 0)
                self.assertEqual(total["cases"], len(lines) - 1)
                self.assertEqual(total["hits"], sum(map(exact_hit, lines[1:])))

    def test_plain_double_arithmetic_fails_exactly_as_the_recorded_answers_of_sofa_do(self):
        report = self.certify_json("golden", "--family", "upstream", "--engine", "plain-double", "--points", "center")
        families = {family["pair"]: family for family in report["families"]}
        self.assertEqual(set(families), set(SOFA_PAIRS))
        for pair in SOFA_PAIRS:
            sofa = self.certify_json(GOLDEN / pair / "upstream.jsonl", "--results", RECORDED / f"{pair}.jsonl")
            self.assertEqual(families[pair], sofa["families"][0])

    def test_the_reports_are_well_formed_and_agree_with_the_exit_code(self):
        for engine, code in (("production", 0), ("plain-double", 1)):
            with self.subTest(engine):
                done = run("certify", GOLDEN / "sphere_sphere" / "coincident.jsonl", GOLDEN / "cube_cube" / "generic.jsonl",
                           "--engine", engine, *self.reports())
                self.assertEqual((done.returncode, done.stderr), (code, ""))
                report = json.loads((self.folder / "out.json").read_text())
                self.assertEqual(report["certified"], code == 0)
                self.assertEqual(report["verdict"], done.stdout.split("\n\n")[-2].strip())
                suite = ElementTree.parse(self.folder / "out.junit").getroot().find("testsuite")
                failures = suite.findall("testcase/failure")
                self.assertEqual(len(failures), 0 if code == 0 else 2)  # one family, and the verdict
                self.assertEqual((suite.get("failures"), suite.get("tests")), (str(len(failures)), "3"))
                html = (self.folder / "out.report").read_text()
                self.assertIn("<html", html)
                self.assertIn(engine, html)
                markdown = (self.folder / "out.markdown").read_text()
                self.assertIn(report["verdict"], markdown)
                rows = [row.split("|") for row in markdown.splitlines() if row.startswith("| ")]
                self.assertEqual({len(row) for row in rows}, {16})
                self.assertEqual([row[1].replace("\\", "").strip() for row in rows],
                                 ["family", "sphere_sphere/coincident", "cube_cube/generic", "total"])
                self.assertEqual(rows[3][2].strip(), str(report["total"]["cases"]))
                self.assertEqual("worst cases" in markdown, code == 1)

    def test_every_claim_of_a_field_is_in_one_class_and_every_case_in_one_answer(self):
        # plain-double's points have a component that is no number beside others that are far off; the last normal of the
        # zoo is right but for its length, by no error at all.
        folder = self.folder / "golden"
        folder.mkdir()
        lines = committed("sphere_sphere/coincident.jsonl")
        scaled = answers_to(lines, engine={"name": "scaled", "version": "1"}, conventions={"normal_unit": False})
        for answer in scaled[1:]:
            answer["contact"]["normal"] = [2 * x for x in answer["contact"]["normal"]]
        results = ("--results", self.file("scaled.jsonl", scaled))
        ugly = [("golden/quick", GOLDEN / "sphere_sphere" / "coincident.jsonl", GOLDEN / "sphere_sphere" / "coincident.f32.jsonl", "--engine", engine)
                for engine in ("plain-double", "plain-float", "mutant:rapier-coincident-nan")]
        classes = dict.fromkeys(("errors", "not_finite", "bounded"), 0)
        for args in (*ugly, (GOLDEN / "sphere_sphere" / "coincident.jsonl", *results), ("golden", "--engine", "plain-double", "--family", "invalid")):
            with self.subTest(args):
                report = self.certify_json(*args)
                for counts in (report["total"], *report["families"]):
                    self.assertEqual(sum(counts["answers"].values()), counts["cases"])
                    for name, field in counts["fields"].items():
                        wrong = sum(n for _, n in field["errors"])
                        self.assertEqual(wrong, field["faithful"] + field["bounded"] + field["beyond_bound"], name)
                        self.assertEqual(field["correctly_rounded"] + wrong + field["not_finite"], field["judged"], name)
                        self.assertEqual((float(field["worst_ulps"]) > 0) <= (wrong > 0), True, name)
                        for key in classes:
                            classes[key] += wrong if key == "errors" else field[key]
                for key, sums in report["total"].items():
                    if isinstance(sums, int):
                        self.assertEqual(sums, sum(family[key] for family in report["families"]), key)
        self.assertGreater(min(classes.values()), 0, classes)

    def test_a_case_that_is_wrong_in_two_ways_is_one_wrong_case_on_the_page(self):
        # Where the centres coincide this engine declares an overlap and no contact, and says the opposite of both.
        lines = committed("sphere_sphere/coincident.jsonl", 0, 40)
        answers = answers_to(lines, conventions={"coincident": "no_contact"})
        for answer in answers[1:]:
            answer["overlap"] = False
        page = self.folder / "page.html"
        self.refuted("certify", self.file("d.jsonl", lines), "--results", self.file("r.jsonl", answers), "--report", page,
                     "--json", self.folder / "r.json")
        total = json.loads((self.folder / "r.json").read_text())["total"]
        self.assertEqual((total["cases"], total["missed_hits"], total["false_hits"]), (40, 40, 40))
        self.assertRegex(page.read_text(), r'<td class=g3 title="of 40 cases 40 missed hits, 40 false hits, 0 with missing fields, 0 without[^"]*">40</td>')

    def test_the_invalid_family_is_judged_only_when_named_and_then_in_full(self):
        folder = GOLDEN / "cube_cube"
        families = {family["family"] for family in self.certify_json(folder)["families"]}
        self.assertIn("generic", families)
        self.assertNotIn("invalid", families)
        self.assertIn("\nCERTIFIED", self.holds("certify", "golden", "--family", "invalid"))
        self.refuted("certify", "golden", "--family", "invalid", "--engine", "plain-double")
        report = self.certify_json(folder, "--family", "invalid")
        self.assertEqual((report["total"]["cases"], report["skipped"]), (420, []))

    def test_a_run_that_judges_nothing_is_never_certified_and_says_so(self):
        binary64 = GOLDEN / "sphere_sphere" / "generic.jsonl"
        done = run("certify", binary64, "--engine", "plain-float")
        self.assertEqual(done.returncode, 2)
        self.assertIn("NOTHING JUDGED", done.stdout)
        self.assertIn("no case was judged", done.stderr)
        empty = self.file("none.jsonl", [{**committed("sphere_sphere/generic.jsonl", 0, 1)[0], "count": 0}])
        for path in (empty, GOLDEN / "sphere_sphere" / "invalid.jsonl"):
            with self.subTest(path.name):
                self.refused(("certify", path), path, one_line=False)

    def test_generated_questions_are_certified_and_the_seed_is_printed(self):
        out = self.holds("certify", "--generate", 5, "--seed", 7, "--pair", "cube_cube", "--family", "generic,touching")
        self.assertIn("seed 7\n", out)
        self.assertIn("20 judged cases", out)

    def test_the_report_is_coloured_at_a_terminal_alone_and_says_the_same(self):
        def at_terminal(*args, **variables):
            try:
                master, slave = pty.openpty()
            except OSError as error:
                self.skipTest(f"no terminal can be made here: {error}")
            environment = {key: value for key, value in os.environ.items() if key != "NO_COLOR"}
            process = subprocess.Popen([TOOL, *published(args)], stdout=slave, stderr=subprocess.DEVNULL, cwd=ROOT,
                                       env={**environment, "TERM": "xterm", **variables})
            os.close(slave)
            said = b""
            try:
                while more := os.read(master, 65536):
                    said += more
            except OSError:  # the other end is closed
                pass
            os.close(master)
            process.wait()
            return said.decode().replace("\r\n", "\n")
        for engine in ("plain-double", "production"):
            args = ("certify", GOLDEN / "sphere_sphere" / "touching.jsonl", GOLDEN / "cube_cube" / "touching.jsonl", "--engine", engine)
            plain = run(*args).stdout
            self.assertNotIn("\x1b", plain)
            coloured = at_terminal(*args)
            self.assertIn("\x1b[31m" if engine == "plain-double" else "\x1b[32m", coloured)
            self.assertEqual(re.sub(r"\x1b\[[0-9;]*m", "", coloured), plain)
            for variables in ({"NO_COLOR": "1"}, {"TERM": "dumb"}):
                self.assertEqual(at_terminal(*args, **variables), plain)
                self.assertEqual(at_terminal(*args, "--color", "always", **variables), coloured)
            self.assertEqual(at_terminal(*args, "--color", "never"), plain)

    def test_the_report_at_a_terminal_is_short_and_the_worst_comes_first(self):
        report = self.folder / "report.json"
        fresh = ("--generate", 1, "--seed", 3)
        out = self.refuted("certify", *fresh, "--engine", "plain-double", "--json", report)
        whole = json.loads(report.read_text())
        rows = out.split("\n\n")[1].splitlines()
        self.assertGreater(len(whole["families"]), 60)
        self.assertLess(len(rows), 60)  # a line a pair, and little beside
        self.assertLess(max(map(len, rows)), 170)
        ranks = [LEVELS.index(row.split()[-1]) for row in rows[1:] if row.split()[1].isdigit() and "total" not in row]
        self.assertGreater(len(ranks), 5)
        self.assertEqual(ranks, sorted(ranks, reverse=True))
        # What has no row of its own is added up: the columns still hold every case.
        number = lambda row: int(re.split(r"  +", row)[1])
        self.assertEqual(sum(map(number, rows[1:-1])), whole["total"]["cases"])
        self.assertEqual(number(rows[-1]), whole["total"]["cases"])
        rows = self.holds("certify", *fresh, "--engine", "production").split("\n\n")[1].splitlines()
        self.assertEqual([row.split(" ")[0] for row in rows], ["family", *PAIRS, "total"])


class ScoreboardCampaign(Scoreboard):
    """The same on all committed files, as the README shows it."""

    @classmethod
    def setUpClass(cls):
        cls.golden, cls.board = GOLDEN, cls.printed(TOOL)

    def test_the_readme_shows_what_the_program_prints(self):
        board = readme("scoreboard")
        self.assertEqual(len(board.splitlines()), 5)
        self.assertIn(board, self.board)


class WholeGoldenCampaign(Case):
    """What golden/quick and the families' own digests leave out: every committed question."""

    def test_the_published_formula_is_right_under_its_own_convention(self):
        Certify.test_the_published_formula_is_right_under_its_own_convention(self, "golden")

    def test_production_is_correctly_rounded_on_every_committed_file(self):
        self.assertIn(" reaches correctly-rounded on all ", self.holds("certify", GOLDEN, "--level", "correctly-rounded"))

    def test_the_committed_files_pass_lint(self):
        self.assertIn("every expectation right", self.holds("lint", "golden"))

    def test_the_committed_files_are_what_their_families_make(self):
        self.holds("regenerate", self.folder)
        digests = {one["path"]: one["sha256"] for one in json.loads((GOLDEN / "manifest.json").read_text())["files"]}
        made = sorted(path.relative_to(self.folder) for path in self.folder.rglob("*.jsonl"))
        self.assertGreater(len(made), 50)
        for path in made:
            content = (self.folder / path).read_bytes()
            self.assertEqual(content, (GOLDEN / path).read_bytes(), path)
            self.assertEqual(hashlib.sha256(content).hexdigest(), digests[str(path)], path)


class EveryFamilyCampaign(Case):
    """More questions of each family than the one that is linted every day."""

    def test_every_family_of_every_pair_passes_lint(self):
        Generate.passes_lint(self, 20)


class KnownFailures(Case):
    """Runs of recorded answers with some of them made wrong, against the report of an earlier run."""
    def setUp(self):
        super().setUp()
        header, *cases = committed("sphere_sphere/touching.jsonl")
        self.lines = [{**header, "count": 100}, *[case for case in cases if case["expect"]["hit"]][:100]]
        self.dataset = self.file("d.jsonl", self.lines)
        self.ids = [case["id"] for case in self.lines[1:]]

    def certify(self, wrong, *more, report="now.json", far=()):
        """Certifies answers of which those at the indices `wrong` miss the hit and those `far` have a wrong value."""
        answers = answers_to(self.lines, engine={"name": "known", "version": "1"})
        for i in wrong:
            answers[1 + i] = {"id": self.ids[i], "overlap": False, "contact": None}
        for i in far:
            answers[1 + i] = put(answers, ["contact", "value"], 1e9, 1 + i)[1 + i]
        return run("certify", self.dataset, "--results", self.file("r.jsonl", answers), "--json", self.folder / report, *more)

    def now(self, report="now.json"):
        return json.loads((self.folder / report).read_text())

    def before(self, wrong, **more):
        self.assertEqual(self.certify(wrong, report="old.json", **more).returncode, 1)
        return self.folder / "old.json"

    def test_a_report_lists_every_failure_once_with_the_level_that_it_reaches(self):
        self.before([3, 50], far=[7])
        self.assertEqual(self.now("old.json")["failure_count"], 3)
        self.assertEqual([(f["id"], f["level"], re.split(" off|,", f["what"])[0]) for f in self.now("old.json")["failures"]],
                         [(self.ids[3], "none", "missed hit"), (self.ids[7], "decisions", "value"),
                          (self.ids[50], "none", "missed hit")])
        self.assertEqual({f["family"] for f in self.now("old.json")["failures"]}, {"touching"})

    def test_failures_that_the_baseline_lists_are_accepted_and_the_verdict_says_so(self):
        old = self.before([3, 50], far=[7])
        done = self.certify([3, 50], "--baseline", old, "--junit", self.folder / "out.junit", far=[7])
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout[-900:])
        self.assertIn("CERTIFIED but for 3 failures", done.stdout)
        self.assertIn("accepts 3 failures; 3 met again, 0 gone", done.stdout)
        self.assertNotIn("<failure", (self.folder / "out.junit").read_text())
        self.assertEqual((self.now()["certified"], self.now()["total"]["accepted"], self.now()["total"]["level"]),
                         (True, 3, "none"))
        self.assertTrue(all(f["accepted"] for f in self.now()["failures"]))

    def test_a_new_failure_is_refuted_and_named_and_one_that_is_gone_is_named(self):
        old = self.before([3, 50])
        done = self.certify([50, 60], "--baseline", old)
        self.assertEqual((done.returncode, done.stderr), (1, ""))
        self.assertIn("1 failure more than the 1 that the baseline accepts", done.stdout)
        self.assertIn(f"{self.ids[60]} is new: missed hit", done.stdout)
        self.assertIn(f"{self.ids[3]} is right now", done.stdout)
        self.assertEqual(self.now()["baseline"], {"file": str(old), "accepts": 2, "met": 1, "gone": [self.ids[3]]})
        self.assertEqual(self.now()["worst"][0]["query"]["id"], self.ids[60])  # the accepted one is not news

    def test_a_failure_that_became_worse_is_not_accepted_and_one_that_became_better_is(self):
        self.assertEqual(self.certify([7], "--baseline", self.before([], far=[7])).returncode, 1)
        self.assertEqual(self.certify([], "--baseline", self.before([7]), far=[7]).returncode, 0)

    def test_a_run_of_accepted_failures_alone_is_not_certified(self):
        every = range(len(self.ids) - 1)  # one answer claims a contact, lest the harness be invalid
        one = self.file("one.jsonl", [{**self.lines[0], "count": 1}, self.lines[1]])
        old = self.before(every)
        says = "judged case (100 % of those given): no answer is left but failures that the baseline accepts. "
        self.assertIn(f" on 1 {says}", self.refuted("certify", one, "--results", self.folder / "r.jsonl", "--baseline", old))
        # Beside a family that is right they are no failure, in JUnit either.
        generic = committed("sphere_sphere/generic.jsonl", 0, 9)
        with (self.folder / "r.jsonl").open("a") as results:
            results.write(text(answers_to(generic)[1:]))
        out = self.holds("certify", one, self.file("generic.jsonl", generic), "--results", self.folder / "r.jsonl",
                         "--baseline", old, "--junit", self.folder / "out.junit")
        self.assertIn("CERTIFIED but for 1 failure:", out)
        self.assertNotIn("<failure", (self.folder / "out.junit").read_text())

    def test_nor_is_it_within_a_tolerance(self):
        boxes = committed("cube_cube/generic.jsonl", 0, 12)
        wrong = answers_to(boxes)
        for answer in wrong[1:]:
            answer["overlap"] = not answer["overlap"]
        known = self.folder / "known.json"
        command = ("certify", self.file("b.jsonl", boxes), "--results", self.file("w.jsonl", wrong), "--tolerance", "length=0")
        self.refuted(*command, "--json", known)
        out = self.refuted(*command, "--baseline", known)
        self.assertIn(" on 12 judged cases (100 % of those given): no answer is left but failures that the baseline accepts. ", out)
        self.assertIn("CERTIFIED within length 0, relative 0, angle 0 but for 11 failures: ", self.holds(
            *command[:3], self.file("r.jsonl", [*wrong[:12], answers_to(boxes)[12]]), *command[4:], "--baseline", known))

    def test_the_failures_of_a_report_are_asked_again_and_nothing_else(self):
        old = self.before([3, 50], far=[7])
        again = ("certify", "--results", self.folder / "r.jsonl", "--failures-of", old, "--json", self.folder / "now.json")
        self.certify([50])
        out = self.refuted(*again)
        self.assertTrue(out.startswith(f"asked again: 3 of the 3 failures in {old}, and nothing else\n"), out[:200])
        self.assertEqual((self.now()["total"]["cases"], [f["id"] for f in self.now()["failures"]]), (3, [self.ids[50]]))
        self.certify([], report="whole.json")
        self.assertIn("3 judged cases", self.holds(*again))
        # With datasets those of the failures that stand there are asked, older reports' among them.
        few = self.file("few.jsonl", [{**self.lines[0], "count": 10}, *self.lines[1:11]])
        self.holds(*again, few)
        self.assertEqual(self.now()["total"]["cases"], 2)
        older = json.loads(old.read_text())
        for f in older["failures"]:
            for key in ("a", "b", "alarm", "contact"):
                del f[key]
        old.write_text(json.dumps(older))
        self.holds(*again, few)
        self.assertEqual(self.now()["total"]["cases"], 2)
        self.refused(again, old, "without its question", "datasets")
        self.refused((*again, GOLDEN / "cube_cube" / "flat.jsonl"), old, "none that stands in these datasets")
        self.refused((*again, few, "--family", "generic"), old, "generic")
        self.refused((*again, few, "--parts", self.folder / "p"), "--failures-of", "--parts")
        self.refused((*again[:-2], few, "--certificate", self.folder / "c.json"), "--failures-of", "certificate")
        self.refused((*again[:-2], few, "--json", old), old, "would be written over")
        self.refused(("certify", "--failures-of", self.folder / "whole.json"), "whole.json", "nothing failed")

    def test_failures_of_generated_questions_outside_the_domain_too_are_asked_again(self):
        report, again = self.folder / "report.json", self.folder / "again.json"
        self.refuted("certify", "--generate", 5, "--seed", 5, "--family", "invalid,touching", "--engine", "plain-float", "--json", report)
        before = json.loads(report.read_text())
        self.refuted("certify", "--engine", "plain-float", "--failures-of", report, "--json", again)
        after = json.loads(again.read_text())
        self.assertEqual(after["failures"], before["failures"])
        self.assertEqual(after["total"]["cases"], before["failure_count"])
        self.assertEqual({f["family"] for f in after["failures"]}, {"invalid", "touching"})
        self.assertEqual({f["scalar"] for f in after["failures"]}, {"binary32"})

    def test_a_baseline_that_is_none_is_refused(self):
        old = self.before([3])
        report = self.now("old.json")
        for name, changed, words in (("other.json", {**report, "engine": {"name": "else", "version": "1"}}, ("engine.name", "'else'")),
                                     ("more.json", {**report, "failure_count": 2}, ("failures", "lists 1 of 2")),
                                     ("v.json", {**report, "version": 2}, ("version", "expected version 1")),
                                     ("f.json", {**report, "format": "x"}, ("format", "certify --json")),
                                     ("n.json", {**report, "failures": [7]}, ("failures[0]", "expected an object")),
                                     ("l.json", put([report], ["failures", 0, "level"], "good", 0)[0],
                                      ("failures[0].level", "good"))):
            path = self.file(name, json.dumps(changed))
            with self.subTest(name):
                self.refused(("certify", self.dataset, "--results", self.folder / "r.jsonl", "--baseline", path), path, *words)
        for path in (self.folder / "absent.json", self.dataset, self.file("half.json", old.read_text()[:-40])):
            with self.subTest(path.name):
                self.refused(("certify", self.dataset, "--results", self.folder / "r.jsonl", "--baseline", path), path)
        self.refused(("certify", "--baseline", old), "give the engine")

    def test_compare_names_what_became_better_and_worse_and_its_exit_code_says_whether_anything_is_worse(self):
        self.before([3, 50])
        for wrong, far, verdict, code, words in (
                ([3, 50], [], "NO CHANGE", 0, []),
                ([50], [], "BETTER", 0, ["2 -> 1", f"{self.ids[3]} touching: missed hit", "Failures gone: 1"]),
                ([3, 50, 60], [], "WORSE", 1, ["2 -> 3", f"{self.ids[60]} touching: missed hit", "New or worse failures: 1"]),
                ([50, 60], [], "MIXED", 1, ["Failures gone: 1", "New or worse failures: 1"]),
                ([], [], "BETTER", 0, ["none -> correctly-rounded", "2 -> 0"]),
                ([3], [50], "MIXED", 1, ["0 -> 1", "2 -> 1"])):
            with self.subTest(verdict):
                self.assertEqual(self.certify(wrong, far=far).returncode, int(bool(wrong or far)))
                done = run("compare", self.folder / "old.json", self.folder / "now.json")
                self.assertEqual((done.returncode, done.stderr), (code, ""), done.stdout)
                self.assertEqual(done.stdout.splitlines()[-1].split(".")[0].split(":")[0].split(" that")[0], verdict)
                for word in words:
                    self.assertIn(word, done.stdout)

    def test_compare_names_a_failure_that_became_worse(self):
        self.before([3], far=[50])
        self.assertEqual(self.certify([50], far=[3]).returncode, 1)
        done = run("compare", self.folder / "old.json", self.folder / "now.json")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stdout, f"{self.ids[50]} touching: missed hit, 0 from where the answer changes .*, and was: value off by ")

    def test_compare_says_what_it_cannot_compare(self):
        self.before([3])
        self.assertEqual(self.certify([3], "--level", "decisions").returncode, 1)
        done = run("compare", self.folder / "old.json", self.folder / "now.json")
        self.assertIn("Failures are not compared: bounded was required, and now decisions.", done.stdout)
        other = self.folder / "other.json"
        self.holds("certify", GOLDEN / "cube_cube" / "generic.jsonl", "--json", other)
        out = self.holds("compare", self.folder / "old.json", other)
        self.assertIn("cube_cube/generic (210 cases) is judged in the new report alone.", out)
        self.assertIn("sphere_sphere/touching (100 cases) is judged in the old report alone.", out)
        # What fails in a family that nobody judged before, or judges now, did not become worse or better.
        for reports in (self.folder / "old.json", other), (other, self.folder / "old.json"):
            out = self.holds("compare", *reports)
            self.assertTrue(out.endswith("\nNO CHANGE that counts.\n"), out)
            self.assertNotIn(self.ids[3], out)
        self.refused(("compare", self.dataset, other), self.dataset)
        self.refused(("compare", other, self.folder / "absent.json"), "absent.json")

    def test_a_run_that_stops_at_the_first_failure_counts_the_rest_as_missing_whatever_the_threads(self):
        reports = []
        for jobs in (1, 2):
            done = self.certify([40, 90], "--fail-fast", "--jobs", jobs)
            self.assertEqual((done.returncode, done.stderr), (1, ""))
            self.assertIn("the first failure ended the run", done.stdout)
            reports.append(self.now())
        self.assertEqual(reports[0], reports[1])
        self.assertEqual((reports[0]["failure_count"], reports[0]["failures"][0]["id"]), (1, self.ids[40]))
        self.assertEqual(reports[0]["total"]["cases"], 100)
        self.assertEqual(reports[0]["not_reached"], reports[0]["total"]["answers"]["missing"])
        self.assertIn(reports[0]["not_reached"], range(1, 60))
        self.assertEqual(self.certify([], "--fail-fast").returncode, 0)
        self.assertEqual(self.certify([40], "--fail-fast", "--baseline", self.before([40])).returncode, 0)

    def test_what_is_not_reached_in_time_is_missing_and_never_a_pass(self):
        report = self.folder / "r.json"
        done = run("certify", "--generate", 10**7, "--seed", 1, "--max-time", 1, "--json", report)
        self.assertEqual((done.returncode, done.stderr), (1, ""))
        total = json.loads(report.read_text())["total"]
        self.assertIn("the time was up", done.stdout)
        self.assertGreater(total["answers"]["missing"], 10**7)
        self.assertGreater(total["answers"]["answered"], 0)
        self.assertFalse(json.loads(report.read_text())["certified"])
        hanging = f"{sys.executable} {ROOT / 'engines' / 'hosts' / 'misbehaving_engine.py'} 'always hangs'"
        done = run("certify", self.dataset, "--engine-command", hanging, "--answer-limit", 300, "--max-time", 1)
        self.assertEqual((done.returncode, done.stderr), (1, ""))
        self.assertIn("100 cases were not reached", done.stdout)
        none = self.certify([], "--max-time", "1e-9")
        self.assertEqual(none.returncode, 1, "an engine that was asked nothing is no invalid harness")
        self.assertIn("100 cases were not reached", none.stdout)
        self.assertEqual(self.certify([], "--max-time", 600).returncode, 0)
        for option in ("--max-time", "--start-limit", "--answer-limit"):
            for seconds in ("0", "-1", "nan", "1e300", "soon"):
                self.refused(("certify", option, seconds), option, f"got '{seconds}'", one_line=False)


CHEATING = ROOT / "engines" / "hosts" / "cheating_engine.py"


def cheating(*words):
    return "--engine-command", shlex.join([sys.executable, str(CHEATING), *map(str, words)])


class RestsOnEnough(Case):
    """What is right and yet no certificate: docs/specification.md#what-a-verdict-rests-on."""

    FILES = [GOLDEN / "sphere_sphere" / f"{family}.jsonl" for family in ("generic", "alarm_edge")]

    def test_who_knows_published_answers_alone_is_refuted(self):
        looks_up = ("certify", *self.FILES, *cheating("lookup", *self.FILES))
        out = self.holds(*looks_up, "--fresh", 0)
        self.assertRegex(out, "CERTIFIED: .* on all 420 judged cases .* On published questions alone: --fresh 0 left fresh ones out.\n")
        forms = {form: self.folder / f"out.{form}" for form in ("json", "junit", "markdown", "report")}
        out = self.refuted(*looks_up, "--seed", 5, *[word for form in forms.items() for word in (f"--{form[0]}", form[1])])
        self.assertIn("fresh questions: 100 of each family, seed 5\n", out)
        report = json.loads(forms["json"].read_text())
        asked = report["fresh"]
        self.assertEqual((asked["each"], asked["seed"], asked["given"], asked["total"]["cases"]), (100, 5, 200, 200))
        self.assertEqual((report["total"]["level"], report["failure_count"], report["failures"]), ("correctly-rounded", 0, []))
        self.assertEqual(asked["failure_count"], asked["total"]["missed_hits"])
        self.assertEqual(len(asked["failures"]), asked["total"]["hits"])
        self.assertEqual([family["cases"] for family in report["families"] + asked["families"]], [210, 210, 100, 100])
        says = (f"is right on published questions alone: on 420 judged cases (100 % of those given) it reaches correctly-rounded, and does not "
                f"reach bounded on 200 fresh ones (seed 5): {asked['failure_count']} missed hits, no number was judged.")
        for form, path in forms.items():
            self.assertTrue(says in path.read_text(), form)
        # What failed can be asked again, and explained.
        self.refuted("certify", *cheating("lookup"), "--failures-of", forms["json"])
        self.holds("certify", "--failures-of", forms["json"], "--level", "correctly-rounded")
        self.assertEqual(run("explain", asked["failures"][0]["id"], "--in", forms["json"]).returncode, 0)

    def test_who_answers_nothing_else_is_not_certified(self):
        out = self.refuted("certify", *self.FILES, *cheating("unsupported", *self.FILES), "--allow-unsupported", "--seed", 5)
        self.assertIn("TOO LITTLE JUDGED", out)
        self.assertIn("it answers 0 of 200 fresh questions, and 420 of 420 published ones", out)

    def test_a_new_seed_is_drawn_and_printed_and_repeats_the_report(self):
        command = ("certify", GOLDEN / "sphere_sphere" / "generic.f32.jsonl", "--engine", "plain-float", "--fresh", 30, "--json", self.folder / "r.json")
        seeds, reports = [], []
        for _ in range(2):
            out = run(*command).stdout
            seeds.append(re.search(r"^fresh questions: 30 of each family, seed (\d+)$", out, re.M)[1])
            reports.append((self.folder / "r.json").read_text())
        self.assertNotEqual(*seeds)
        self.assertNotEqual(*reports)
        self.holds(*command, "--seed", seeds[0])
        self.assertEqual((self.folder / "r.json").read_text(), reports[0])

    def test_with_a_baseline_the_questions_are_those_of_the_baseline(self):
        command = ("certify", *self.FILES, "--engine", "plain-double")
        known = self.folder / "known.json"
        self.refuted(*command, "--fresh", 50, "--seed", 11, "--json", known)
        fresh = json.loads(known.read_text())["fresh"]
        self.assertGreater(fresh["failure_count"], 0)
        report = self.folder / "r.json"
        done = subprocess.run([TOOL, *map(str, command), "--baseline", known, "--json", report], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertEqual([json.loads(report.read_text())["fresh"][key] for key in ("each", "seed", "failure_count")],
                         [50, 11, fresh["failure_count"]])
        self.refuted(*command, "--baseline", known, "--seed", 12)

    def test_a_few_fresh_questions_that_ask_for_no_number_take_nothing_from_the_level(self):
        report = self.folder / "r.json"
        for seed in range(1, 20):
            out = self.holds("certify", self.FILES[0], "--fresh", 1, "--seed", seed, "--json", report)
            if json.loads(report.read_text())["fresh"]["total"]["hits"] == 0:
                break
        self.assertIn("of fresh questions on 0 hits and 1 miss.", out)
        self.assertIn(" reaches correctly-rounded on all 210 judged cases ", out)
        self.assertIn(" and on numbers: ", out)
        self.assertNotIn("have no numbers", out)

    def test_who_always_says_hit_is_not_conservative(self):
        always = ("certify", *self.FILES, "--level", "conservative", "--fresh", 0, *cheating("hit"))
        out = self.refuted(*always, "--json", self.folder / "r.json")
        self.assertIn("That is no certificate: its overlap is hit every time; its contact is hit every time. --least-judged 0 asks for less.", out)
        total = json.loads((self.folder / "r.json").read_text())["total"]
        self.assertIn(f"It rests on {total['decided']['hits']} hits and {total['decided']['misses']} misses, and on no number. "
                      f"{total['false_hits']} of {total['decided']['misses']} misses were called hits, the farthest ", out)
        self.assertIn("\nCERTIFIED: ", self.holds(*always, "--least-judged", 0))
        # Of questions that are all hits, every right answer is one.
        hits = committed("sphere_sphere/generic.jsonl", 0, 210)
        hits = [hits[0]] + [case for case in hits[1:] if case["expect"]["hit"]]
        hits[0]["count"] = len(hits) - 1
        self.holds("certify", self.file("hits.jsonl", hits), "--level", "conservative", *cheating("hit"))

    def test_what_fails_on_the_same_fresh_questions_alone_is_worse_and_on_others_is_not_compared(self):
        right, wrong, other = (self.folder / f"{name}.json" for name in ("right", "wrong", "other"))
        self.holds("certify", *self.FILES, "--seed", 5, "--json", right)
        looks_up = ("certify", *self.FILES, *cheating("lookup", *self.FILES))
        self.refuted(*looks_up, "--seed", 5, "--json", wrong)
        self.refuted(*looks_up, "--seed", 6, "--json", other)
        failures = json.loads(wrong.read_text())["fresh"]["failure_count"]
        out = self.refuted("compare", right, wrong)
        self.assertIn(f"New or worse failures: {failures}\n", out)
        self.assertTrue(out.endswith("\nWORSE.\n"), out)
        self.assertIn(f"Failures gone: {failures}\n", self.holds("compare", wrong, right))
        out = self.holds("compare", right, other)
        self.assertIn("Failures on fresh questions are not compared: the reports asked others.\n", out)
        self.assertTrue(out.endswith("\nNO CHANGE that counts.\n"), out)

    def test_a_case_that_one_decision_should_miss_and_the_other_hit_is_a_miss_that_may_be_called_a_hit(self):
        lines = committed("sphere_sphere/touching.jsonl")
        touching = [case for case in lines[1:] if case["exact"]["margin_ulps"] == 0 and case["alarm"] == 0]
        lines = [{**lines[0], "count": len(touching)}, *touching]
        answers = answers_to(lines, conventions={"touching_overlap": "open"})
        out = self.holds("certify", self.file("d.jsonl", lines), "--results", self.file("r.jsonl", answers), "--level", "conservative",
                         "--least-judged", 0)
        self.assertIn(f" {len(touching)} of {len(touching)} misses were called hits, the farthest 0 from where the answer changes.", out)

    def test_a_conservative_engine_says_how_far_it_goes_and_may_be_bounded(self):
        report = self.folder / "r.json"
        careful = ("certify", self.FILES[0], "--level", "conservative", *cheating("conservative"), "--json", report, "--seed", 3)
        self.holds(*careful)
        said = json.loads(report.read_text())
        farthest = max((said["total"]["farthest_false_hit"], said["fresh"]["total"]["farthest_false_hit"]), key=lambda one: one["from"])
        self.assertIn("misses were called hits, and ", said["verdict"])
        self.holds("explain", "-", stdin=line(farthest["query"]))
        self.assertIn(" was allowed.", self.holds(*careful, "--within", repr(farthest["from"])))
        out = self.refuted(*careful, "--within", repr(math.nextafter(farthest["from"], 0)))
        self.assertEqual(json.loads(report.read_text())["failure_count"] + json.loads(report.read_text())["fresh"]["failure_count"], 1, out)

    def test_what_does_not_go_together_is_refused(self):
        one, known = self.FILES[0], self.folder / "known.json"
        self.holds("certify", one, "--engine", "plain-double", "--fresh", 0, "--json", known)
        for words, why in (((one, "--fresh", 0, "--seed", 1), "--seed chooses fresh questions, and none is asked: --fresh is 0"),
                           ((one, "--engine", "plain-double", "--baseline", known, "--seed", 1), "the baseline was made with none"),
                           (("--generate", 10, "--fresh", 10), "--generate asks nothing but such"),
                           (("--failures-of", known, "--fresh", 10), "--failures-of asks what failed before and nothing else"),
                           (("--failures-of", known, "--seed", 10), "--failures-of asks those that failed before"),
                           ((one, "--results", RECORDED / "sphere_sphere.jsonl", "--fresh", 10), "recorded answers cannot be asked anything new"),
                           ((one, "--results", RECORDED / "sphere_sphere.jsonl", "--seed", 10), "none is asked of recorded answers"),
                           ((one, "--fresh", 10, "--parts", self.folder / "p"), "fresh questions in parts need --seed"),
                           ((one, "--fresh", 0, "--within", 1), "--within: is of --level conservative, which forgives false hits, and bounded is required"),
                           ((one, "--fresh", 0, "--level", "conservative", "--within", "-1"), "expected a length, a number from 0, got '-1'"),
                           ((one, "--fresh", 0, "--level", "conservative", "--within", "nan"), "expected a length")):
            with self.subTest(words):
                done = run("certify", *words)
                self.assertEqual(done.returncode, 2, done.stdout)
                self.assertIn(why, done.stderr)


class Results(Case):
    def setUp(self):
        super().setUp()
        self.lines = committed("sphere_sphere/touching.jsonl", 0, 12)
        self.dataset = self.file("d.jsonl", self.lines)
        self.answers = answers_to(self.lines)

    def args(self, answers, *more):
        return ("certify", self.dataset, "--results", self.file("r.jsonl", answers), *more)

    def test_right_answers_are_certified_at_the_strictest_level(self):
        self.assertIn("\nCERTIFIED", self.holds(*self.args(self.answers, "--level", "correctly-rounded")))

    def test_more_points_than_are_declared_are_called_so(self):
        self.lines = committed("obb_obb/generic.jsonl", 0, 40)
        self.dataset = self.file("d.jsonl", self.lines)
        answers = answers_to(self.lines)
        contact = {case["id"]: case["contact"] for case in self.lines[1:]}
        for answer in answers[1:]:
            if c := answer["contact"]:
                depth = -float(c["value"]) - float(contact[answer["id"]])
                answer["contact"] = {"normal": c["normal"], "value": c["value"], "points": 3 * [c["point1"]], "depths": 3 * [depth]}
        declared = {**answers[0], "conventions": {"points": "manifold", "most_points": 3}}
        tolerance = ("--tolerance", "length=1e-9,relative=1e-9,angle=1e-9")
        self.holds(*self.args([declared, *answers[1:]], *tolerance))
        declared["conventions"]["most_points"] = 2
        for also in (), tolerance:
            out = self.refuted(*self.args([declared, *answers[1:]], *also, "--report", self.folder / "r.html"))
            self.assertIn("points more than declared", out)
            self.assertIn("more than declared</td>", (self.folder / "r.html").read_text())
            self.assertNotIn("points off by 0", out)

    def test_one_missing_answer_is_never_certified(self):
        self.assertIn("1 missing", self.refuted(*self.args(self.answers[:-1])))

    def test_an_answer_to_no_question_asked_is_named_and_is_no_failure(self):
        unknown = "0123456789abcdef01234567"
        out = self.holds(*self.args([*self.answers, {"id": unknown, "overlap": True}], "--json", self.folder / "r.json"))
        self.assertIn(f"1 recorded answer belongs to no question asked: {unknown}\n", out)
        self.assertEqual(json.loads((self.folder / "r.json").read_text())["unknown_answers"], [unknown])
        # The same question in two files is asked twice, and hides no unknown answer.
        twin = self.file("twin.jsonl", [{**self.lines[0], "family": "generic"}, *self.lines[1:]])
        out = self.holds(*self.args([*self.answers, {"id": unknown, "overlap": True}]), twin)
        self.assertIn(unknown, out)

    def test_answers_that_claim_nothing_are_a_harness_failure(self):
        empty = [self.answers[0]] + [{"id": answer["id"]} for answer in self.answers[1:]]
        for answers in (self.answers[:1], empty):
            done = run(*self.args(answers))
            self.assertEqual(done.returncode, 3, done.stdout)
            self.assertIn("HARNESS INVALID", done.stdout)

    def test_unsupported_answers_prevent_a_certificate_unless_they_are_allowed(self):
        answers = self.answers[:-2] + [{"id": a["id"], "unsupported": "too hard"} for a in self.answers[-2:]]
        self.assertIn("2 unsupported", self.refuted(*self.args(answers)))
        self.assertIn("10 judged cases", self.holds(*self.args(answers, "--allow-unsupported")))
        few = answers[:6] + [{"id": a["id"], "unsupported": "too hard"} for a in answers[6:]]
        self.assertIn("5 judged cases of 12 given are fewer than 6", self.refuted(*self.args(few, "--allow-unsupported")))
        all_of_them = answers[:1] + [{"id": a["id"], "unsupported": "too hard"} for a in answers[1:]]
        done = run(*self.args(all_of_them, "--allow-unsupported", *self.reports()))
        self.assertEqual(done.returncode, 2)
        for report in (done.stdout, *((self.folder / f"out.{form}").read_text() for form in ("json", "junit", "markdown"))):
            self.assertIn("NOTHING JUDGED", report)
            self.assertNotIn("REFUTED", report)

    def test_an_error_a_rejection_and_an_empty_answer_are_not_right_answers(self):
        for said in ({"error": "boom"}, {"rejected": "alarm"}, {}):
            with self.subTest(said):
                self.refuted(*self.args([*self.answers[:-1], {"id": self.answers[-1]["id"], **said}]))

    def test_an_engine_may_bear_any_name(self):
        name = "<b>&\"' \x1b[31m\x01"
        answers = put(self.answers, ["engine", "name"], name, 0)
        out = self.refuted(*self.args(answers[:-1], *self.reports()))
        self.assertNotIn("<b>", (self.folder / "out.report").read_text())
        self.assertEqual(json.loads((self.folder / "out.json").read_text())["engine"]["name"], "<b>&\"' \\x1b[31m\\x01")
        with self.subTest("JUnit is well-formed XML"):
            ElementTree.parse(self.folder / "out.junit")
        with self.subTest("no escape sequence reaches the terminal"):
            self.assertNotIn("\x1b", out)
        with self.subTest("Markdown has no markup of it"):
            self.assertIn("\\<b\\>\\&", (self.folder / "out.markdown").read_text())

    def test_a_folder_may_hold_answers_as_any_program_writes_them(self):
        folder = self.folder / "both"
        folder.mkdir()
        (folder / "d.jsonl").write_text(text(self.lines))
        header, *answers = self.answers
        for name, first in (("spaced", json.dumps(header)), ("sorted", json.dumps(header, sort_keys=True)),
                            ("backwards", json.dumps(dict(reversed(header.items())), separators=(" , ", " :\t"))),
                            ("long", json.dumps({**header, "engine": {"name": "n" * 100_000, "version": "1"}})),
                            ("escaped", line(header).replace("contact-oracle/results", "contact-oracle\\/results"))):
            with self.subTest(name):
                answered = folder / "answers.jsonl"
                answered.write_text(text([first, *map(json.dumps, answers)]))
                self.assertIn("\nCERTIFIED: production", self.holds("certify", folder))
                self.assertIn("12 cases in 1 files", self.holds("lint", folder))
                self.assertIn(" on all 12 judged cases", self.holds("certify", folder, "--results", answered))
        # Any other header is a damaged dataset's.
        for first in (header | {"format": "contact-oracle/result"}, {"engine": header}, [], '{"format":"contact-oracle/results"'):
            answered.write_text(text([first if isinstance(first, str) else json.dumps(first)]))
            self.refused(("certify", folder), answered)

    def test_a_results_file_that_is_wrong_is_refused_where_it_is_wrong(self):
        right, path = self.answers, self.folder / "r.jsonl"
        hit = next(at for at in range(1, len(right)) if right[at]["contact"])
        header = lambda **change: [{**right[0], **change}, *right[1:]]
        claim = lambda **change: [*right[:hit], {**right[hit], **change}, *right[hit + 1:]]
        contact = lambda **change: claim(contact={**right[hit]["contact"], **change})
        here = f"{path}:{hit + 1}: "
        table = {
            "unknown convention": (header(conventions={"points": "middle"}), f"{path}:1: conventions.points: ", "middle"),
            "unknown rounding": (header(rounds=["radius"]), f"{path}:1: rounds[0]: ", "orientation"),
            "unknown convention key": (header(conventions={"colour": "red"}), f"{path}:1: conventions.colour: ", "red"),
            "bound above 64": (header(bounds={"value": 65}), f"{path}:1: bounds.value: ", "65"),
            "bound below 1": (header(bounds={"point": 0.5}), f"{path}:1: bounds.point: ", "0.5"),
            "wrong scale": (header(conventions={"scale": {"min": 2, "max": 1}}), f"{path}:1: conventions.scale: ", "max"),
            "wrong version": (header(version=2), f"{path}:1: version: ", "2"),
            "wrong format": (header(format="contact-oracle/dataset"), f"{path}:1: format: ", "contact-oracle/dataset"),
            "unknown pair": (header(pairs=["cone_cone"]), f"{path}:1: pairs[0]: ", "cone_cone"),
            "unknown scalar": (header(scalar="half"), f"{path}:1: scalar: ", "half"),
            "no engine": ([{k: v for k, v in right[0].items() if k != "engine"}], f"{path}:1: engine: ", "missing"),
            "answered twice": (right + right[hit:hit + 1], f"{path}:{len(right) + 1}: id: ", right[hit]["id"]),
            "id of four digits": ([*right, {"id": "8d12\\", "overlap": True}], f"{path}:{len(right) + 1}: id: ", "24 hexadecimal digits", r'"8d12\\"'),
            "overlap no boolean": (claim(overlap="yes"), here + "overlap: ", "yes"),
            "contact no object": (claim(contact=[1]), here + "contact", "[1]"),
            "normal of two": (contact(normal=[1, 0]), here + "contact.normal: ", "[1,0]"),
            "value no number": (contact(value="x"), here + "contact.value: ", '"x"'),
            "unknown field": (contact(depth=3), here + "contact.depth: ", "3"),
            "unknown key": (claim(maybe=True), here + "maybe: ", "true"),
            "claim and reason": (claim(unsupported="why"), here, "why"),
            "no id": ([right[0], {"overlap": True}], f"{path}:2: id: ", "missing"),
            "malformed": ([*right[:2], '{"id":'], f"{path}:3: ", "malformed JSON"),
            "cut": (text(right)[:-1], f"{path}:{len(right)}: ", "truncated"),
            "empty": ("", f"{path}: ", "empty"),
        }
        for name, (answers, *words) in table.items():
            with self.subTest(name):
                self.refused(self.args(answers, *self.reports()), *words)
        self.refused(("certify", self.dataset, "--results", self.folder / "gone.jsonl"), "gone.jsonl", "cannot read")


class Claims(Case):
    """What an engine declares to claim, and what its verdict then rests on."""

    def setUp(self):
        super().setUp()
        self.lines = committed("sphere_sphere/generic.jsonl", 0, 40)
        self.dataset = self.file("d.jsonl", self.lines)
        self.right = answers_to(self.lines)
        self.hits = sum(case["expect"]["hit"] for case in self.lines[1:])
        self.misses = len(self.lines) - 1 - self.hits
        self.assertGreater(min(self.hits, self.misses), 4)

    def answers(self, change=lambda contact: contact, **header):
        return [{**self.right[0], **header}] + [
            {**answer, "contact": change(answer["contact"])} if answer["contact"] else answer for answer in self.right[1:]]

    def args(self, answers, *more):
        return ("certify", self.dataset, "--results", self.file("r.jsonl", answers), *more)

    def report(self):
        return json.loads((self.folder / "out.json").read_text())

    def test_an_engine_that_answers_no_number_is_refuted_in_every_report(self):
        for level in ("correctly-rounded", "bounded", "decisions", "conservative"):
            out = self.refuted(*self.args(self.answers(lambda _: {}), "--level", level, *self.reports()))
            wants = (f"{4 * self.hits} missing fields ({self.hits} normal, {self.hits} point1, {self.hits} point2, "
                     f"{self.hits} value)")
            self.assertIn(wants, out)
            self.assertIn("# missing field: normal, point1, point2, value\n", out)
            self.assertIn('normal: missing in', out)
            for form in ("junit", "report"):
                self.assertIn(wants, (self.folder / f"out.{form}").read_text())
            self.assertIn(wants, (self.folder / "out.markdown").read_text().replace("\\", ""))
            total = self.report()["total"]
            self.assertEqual(total["missing_fields"], dict.fromkeys(("normal", "point1", "point2", "value"), self.hits))
            self.assertEqual((total["incomplete"], total["level"], total["fields"]), (self.hits, "none", {}))
            self.assertEqual(len(self.report()["failures"]), self.hits)

    def test_a_field_dropped_once_refutes(self):
        for field in ("normal", "point1", "point2", "value"):
            answers = self.answers()
            one = next(i for i, answer in enumerate(answers) if answer.get("contact"))
            answers[one] = {**answers[one], "contact": {k: v for k, v in answers[one]["contact"].items() if k != field}}
            self.assertIn(f"1 missing field (1 {field})", self.refuted(*self.args(answers, "--level", "conservative")))

    def test_a_field_that_is_not_declared_is_not_judged_and_is_named(self):
        wrong = lambda contact: {**contact, "normal": [7, 7, 7]}
        self.refuted(*self.args(self.answers(wrong)))
        declared = self.answers(wrong, claims=["overlap", "contact", "point1", "point2", "value"])
        out = self.holds(*self.args(declared, "--level", "correctly-rounded", *self.reports()))
        self.assertIn("Not claimed, so not judged: normal.", out)
        self.assertEqual(self.report()["not_claimed"], ["normal"])
        self.assertEqual(self.report()["claims"], ["overlap", "contact", "point1", "point2", "value"])
        self.assertNotIn("normal", self.report()["total"]["fields"])
        # Where centres coincide the points would go with it, as they would go with any.
        lines = committed("sphere_sphere/coincident.jsonl", 0, 20)
        also = [{**answer, "contact": wrong(answer["contact"])} for answer in answers_to(lines)[1:]]
        self.holds(*self.args([*declared, *also], self.file("c.jsonl", lines), *self.reports()))
        self.assertEqual(self.report()["total"]["fields"]["point1"]["judged"], self.hits)
        # The one point of an engine is a field too.
        no_point = self.answers(lambda contact: {key: contact[key] for key in ("normal", "value")}, conventions={"points": "midpoint"},
                                claims=["overlap", "contact", "normal", "value"])
        self.assertIn("Not claimed, so not judged: point.", self.holds(*self.args(no_point)))

    def test_a_field_that_is_claimed_of_some_pairs_alone_is_named_with_the_others(self):
        lines = committed("sphere_cube/generic.jsonl", 0, 40)
        hits = sum(case["expect"]["hit"] for case in lines[1:])
        nothing, everything = {"points": "none", "value": "none"}, {"points": "nearest_surface", "value": "signed"}
        for general, special, judged, lacks in ((everything, nothing, self.hits, "sphere_cube"), (nothing, everything, hits, "sphere_sphere")):
            answers = self.answers(pairs=["sphere_sphere", "sphere_cube"], conventions=general, pair_conventions={"sphere_cube": special})
            out = self.holds(*self.args([*answers, *answers_to(lines)[1:]], self.file("c.jsonl", lines), *self.reports()))
            self.assertIn(f"on numbers: {self.hits + hits} normal, {judged} point1, {judged} point2, {judged} value. "
                          f"Not claimed, so not judged: point1 ({lacks}), point2 ({lacks}), value ({lacks}).", out)
            self.assertEqual(self.report()["not_claimed"], ["point1", "point2", "value"])

    def test_a_normal_of_any_length_is_judged_by_its_direction(self):
        for pair, family in (("sphere_cube", "on_boundary"), ("capsule_triangle", "touching"), ("cast_cube", "through_edge")):
            lines = committed(f"{pair}/{family}.jsonl")
            answers = answers_to(lines, conventions={"normal_unit": False, "points": "none"})
            failures = {}
            for side in 1, -1:
                for length in 1, 2.0**-60, 2.0**60:
                    turned = lambda contact: {"normal": [side * length * float(x) for x in contact["normal"]], "value": contact["value"]}
                    made = [{**a, "contact": turned(a["contact"])} if a.get("contact") else a for a in answers]
                    judged = self.holds if side == 1 else self.refuted
                    judged("certify", self.file("n.jsonl", lines), "--results", self.file("r.jsonl", made), "--json", self.folder / "out.json")
                    failures.setdefault(side, []).append([f["id"] for f in self.report()["failures"]])
            self.assertEqual(failures[1], [[]] * 3, pair)
            self.assertEqual(failures[-1], [failures[-1][0]] * 3, pair)
            self.assertNotEqual(failures[-1][0], [], pair)

    def test_a_family_whose_numbers_nobody_can_judge_is_no_failure_beside_others(self):
        # Where centres coincide the points go with the normal, which is not declared.
        lines = committed("sphere_sphere/coincident.jsonl", 0, 20)
        points = lambda contact: {key: contact[key] for key in ("point1", "point2")}
        right = [*self.answers(points, claims=["overlap", "contact", "point1", "point2"]),
                 *({**answer, "contact": points(answer["contact"])} for answer in answers_to(lines)[1:])]
        out = self.holds(*self.args(right, self.file("c.jsonl", lines), *self.reports()))
        self.assertIn(f"and on numbers: {self.hits} point1, {self.hits} point2.", out)
        self.assertNotIn("<failure", (self.folder / "out.junit").read_text())
        # Alone they are a verdict on no number.
        self.assertIn("no number was judged", self.refuted("certify", self.folder / "c.jsonl", "--results", self.folder / "r.jsonl"))

    def test_the_verdict_counts_what_it_rests_on(self):
        out = self.holds(*self.args(self.answers(), *self.reports()))
        rests = (f"It rests on {self.hits} hits and {self.misses} misses, and on numbers: {self.hits} normal, "
                 f"{self.hits} point1, {self.hits} point2, {self.hits} value.")
        self.assertIn(rests, out)
        for form in ("junit", "report", "markdown"):
            self.assertIn(rests, (self.folder / f"out.{form}").read_text())
        self.assertIn(rests, self.report()["verdict"])
        self.assertEqual(self.report()["total"]["decided"], {"hits": self.hits, "misses": self.misses})
        self.assertIsNone(self.report()["total"]["one_answer"])

    def test_without_a_number_the_level_is_decisions(self):
        only = [{k: v for k, v in answer.items() if k != "contact"} for answer in self.right]
        only[0]["claims"] = ["overlap"]
        self.assertIn("no number was judged", self.refuted(*self.args(only)))
        self.assertIn("reaches decisions", self.holds(*self.args(only, "--level", "decisions")))
        boxes = committed("cube_cube/generic.jsonl", 0, 40)
        out = self.holds("certify", self.file("b.jsonl", boxes), "--results", self.file("a.jsonl", answers_to(boxes)), "--level",
                         "correctly-rounded")
        self.assertIn("reaches decisions", out)
        self.assertIn("these questions have no numbers", out)
        self.assertNotIn("reaches correctly-rounded", out)

    def test_a_run_that_one_answer_would_have_passed_says_so(self):
        for expects, says in ((True, "hit"), (False, "miss")):
            lines = [self.lines[0]] + [case for case in self.lines[1:] if case["expect"]["hit"] == expects]
            lines[0] = {**lines[0], "count": len(lines) - 1}
            out = self.holds("certify", self.file("one.jsonl", lines), "--results", self.file("a.jsonl", answers_to(lines)),
                             *self.reports())
            self.assertIn(f"An engine that always says {says} decides every question right.", out)
            self.assertEqual(self.report()["total"]["one_answer"], says)
        self.assertNotIn("An engine that always", self.holds(*self.args(self.answers())))

    def test_claims_that_cannot_be_are_refused(self):
        for claims, conventions, word in (([], {}, "claims: "), (["speed"], {}, "claims[0]: "), ("overlap", {}, "claims: "),
                                          (["point1"], {"points": "none"}, "claims[0]: "),
                                          (["overlap", "value"], {"value": "none"}, "claims[1]: ")):
            self.refused(self.args(self.answers(claims=claims, conventions=conventions)), f"{self.folder / 'r.jsonl'}:1: {word}")


class BadDatasets(Case):
    def setUp(self):
        super().setUp()
        self.spheres = committed("sphere_sphere/touching.jsonl", 0, 8)
        self.cubes = committed("cube_cube/touching.jsonl", 0, 8)
        self.path = self.folder / "d.jsonl"
        self.hit = next(at for at, case in enumerate(self.spheres) if at and case["expect"]["hit"])
        self.cube_hit = next(at for at, case in enumerate(self.cubes) if at and case["expect"]["hit"])

    def check(self, table, commands=("certify", "lint")):
        for name, (lines, *words) in table.items():
            for command in commands:
                with self.subTest(name, command=command):
                    self.file("d.jsonl", lines)
                    self.refused((command, self.path, *(self.reports() if command == "certify" else [])), *words)

    def test_a_dataset_that_cannot_be_read_is_refused_where_it_is_wrong(self):
        good, path, n = self.spheres, self.path, len(self.spheres)
        without = lambda lines, at, key: [*lines[:at], {k: v for k, v in lines[at].items() if k != key}, *lines[at + 1:]]
        f32 = committed("sphere_sphere/touching.f32.jsonl", 0, 3)
        self.check({
            "malformed": ([*good[:3], "{nonsense}", *good[4:]], f"{path}:4: ", "malformed JSON"),
            "a NUL byte": ([*good[:3], line(good[3]) + '\0{"more":1}', *good[4:]], f"{path}:4: ", "malformed JSON", "NUL"),
            "no object": ([*good[:3], "[1,2]", *good[4:]], f"{path}:4: ", "expected a JSON object", "[1,2]"),
            "a number beyond binary64": ([*good[:3], line(put(good, ["b", "center", 1], "X", 3)[3]).replace('"X"', "-1e400"), *good[4:]],
                                         f"{path}:4: b.center[1]: ", "-1e400"),
            "blank line": ([*good[:3], "", *good[4:]], f"{path}:4: ", "malformed JSON"),
            "wrong version": (put(good, ["version"], 2, 0), f"{path}:1: version: ", "2"),
            "wrong format": (put(good, ["format"], "other", 0), f"{path}:1: format: ", "other"),
            "wrong pair": (put(good, ["pair"], "cone_cone", 0), f"{path}:1: pair: ", "cone_cone"),
            "wrong scalar": (put(good, ["scalar"], "half", 0), f"{path}:1: scalar: ", "half"),
            "wrong points": (put(good, ["points"], "center", 0), f"{path}:1: points: ", "center"),
            "wrong shard": ([{**good[0], "shard": [2, 2]}, *good[1:]], f"{path}:1: shard: ", "[2,2]"),
            "negative count": (put(good, ["count"], -1, 0), f"{path}:1: count: ", "-1"),
            "family without a name": (put(good, ["family"], "", 0), f"{path}:1: family: ", '""'),
            "header key missing": (without(good, 0, "seed"), f"{path}:1: seed: ", "missing"),
            "key missing": (without(good, 2, "alarm"), f"{path}:3: alarm: ", "missing"),
            "expectation missing": (without(good, 2, "expect"), f"{path}:3: expect: ", "missing"),
            "witness missing": (without(good, 2, "exact"), f"{path}:3: exact: ", "missing"),
            "unknown key": ([*good[:2], {**good[2], "colour": 7}, *good[3:]], f"{path}:3: colour: ", "7"),
            "unknown inner key": (put(good, ["a"], lambda a: {**a, "mass": 7}, 2), f"{path}:3: a.mass: ", "7"),
            "duplicate key": ([*good[:2], line(good[2])[:-1] + ',"alarm":0}', *good[3:]], f"{path}:3: alarm: ", "twice"),
            "NaN": (identified(put(good, ["a", "center", 1], "NaN")), f"{path}:2: a.center[1]: ", "NaN"),
            "infinite alarm": (identified(put(good, ["alarm"], "Infinity")), f"{path}:2: alarm: ", "Infinity"),
            "negative radius": (identified(put(good, ["b", "radius"], -2.5)), f"{path}:2: b.radius: ", "-2.5"),
            "negative alarm": (identified(put(good, ["alarm"], -0.5)), f"{path}:2: alarm: ", "-0.5"),
            "min above max": (identified(put(self.cubes, ["a", "min", 2], 1e9)), f"{path}:2: a.min[2]: ", "1e"),
            "text for a number": (put(good, ["alarm"], "wide"), f"{path}:2: alarm: ", '"wide"'),
            "no exact number": (put(good, ["exact", "reach"], "0x3\bp0"), f"{path}:2: exact.reach: ", r'got "0x3\\x08p0"'),
            "no gap": (put(self.cubes, ["exact", "gap", 2], "3"), f"{path}:2: exact.gap[2]: ", "exact number", '"3"'),
            "two coordinates": (put(good, ["b", "center"], [1, 2]), f"{path}:2: b.center: ", "[1,2]"),
            "number too large": ([good[0], re.sub(r'"alarm":[^,]+', '"alarm":1e999', line(good[1]))], f"{path}:2: ", "1e999"),
            "wrong id": (put(good, ["id"], "0" * 24), f"{path}:2: id: ", "0" * 24, good[1]["id"]),
            "other question": (put(good, ["contact"], 123), f"{path}:2: id: ", good[1]["id"]),
            "asked twice": ([{**good[0], "count": n}, *good[1:], good[2]], f"{path}:{n + 1}: id: ", good[2]["id"], "twice"),
            "count too small": (put(good, ["count"], n - 2, 0), f"{path}:1: count: ", str(n - 2)),
            "count too large": (put(good, ["count"], n, 0), f"{path}:1: count: ", str(n), str(n - 1)),
            "a line cut out": (good[:4] + good[5:], f"{path}:1: count: ", str(n - 1), str(n - 2)),
            "last line cut": (text(good)[:-40], f"{path}:{n}: ", "truncated"),
            "no last line feed": (text(good)[:-1], f"{path}:{n}: ", "truncated"),
            "empty": ("", f"{path}: ", "empty"),
            "not binary32": (put(f32, ["a", "radius"], 0.1), f"{path}:2: a.radius: ", "binary32", "0.1"),
            "beyond binary32": (put(f32, ["b", "center", 0], 1e39), f"{path}:2: b.center[0]: ", "binary32", "1e+39"),
        })

    def test_every_field_of_an_expectation_is_checked(self):
        hit, cube = self.hit, self.cube_hit
        here, there = f"{self.path}:{hit + 1}: ", f"{self.path}:{cube + 1}: "
        spheres = lambda *path, value: put(self.spheres, path, value, hit)
        expect = self.spheres[hit]["expect"]
        table = {
            "hit": (spheres("expect", value={"hit": False}), here + "expect.hit: ", "false", "true"),
            "degenerate": (spheres("expect", "degenerate", value=True), here + "expect.degenerate: ", "true", "false"),
            "value": (spheres("expect", "value", value=next_up), here + "expect.value: ", next_up(expect["value"])),
            "distance2": (spheres("exact", "distance2", value="0x7p-3"), here + "exact.distance2: ", "0x7p-3"),
            "reach": (spheres("exact", "reach", value="0x7p-3"), here + "exact.reach: ", "0x7p-3"),
            "margin": (spheres("exact", "margin_ulps", value=0.25), here + "exact.margin_ulps: ", "0.25"),
            "cubes hit": (put(self.cubes, ["expect", "hit"], False, cube), there + "expect.hit: ", "false", "true"),
            "gap": (put(self.cubes, ["exact", "gap", 1], "0x7p-3", cube), there + "exact.gap[1]: ", "0x7p-3"),
        }
        casts = committed("cast_sphere/generic.jsonl", 0, 8)
        cast = next(at for at, case in enumerate(casts) if at and case["expect"]["hit"])
        for i in (0, 1):
            table[f"t[{i}]"] = (put(casts, ["exact", "t", i], "0x7p-3", cast), f"{self.path}:{cast + 1}: exact.t[{i}]: ", "0x7p-3")
        deep = committed("sphere_obb/deep.jsonl", 0, 20)
        at = next(at for at, case in enumerate(deep) if at and "depth2" in case["exact"])
        table["depth2"] = (put(deep, ["exact", "depth2"], "0x7p-3", at), f"{self.path}:{at + 1}: exact.depth2: ", "0x7p-3")
        for field in ("normal", "point1", "point2"):
            for axis in range(3):
                wrong = spheres("expect", field, axis, value=next_up)
                table[f"{field}[{axis}]"] = (wrong, f"{here}expect.{field}[{axis}]: ", wrong[hit]["expect"][field][axis])
        self.check(table)

    def test_the_rejection_that_an_invalid_question_expects_is_checked(self):
        lines = committed("sphere_sphere/invalid.jsonl")
        at = next(i for i, case in enumerate(lines) if i and case["a"]["radius"] == "Infinity")
        self.file("d.jsonl", put(lines, ["expect", "rejected"], "alarm", at))
        for args in (("lint", self.path), ("certify", self.path, "--family", "invalid")):
            with self.subTest(args[0]):
                self.refused(args, f"{self.path}:{at + 1}: expect.rejected: ", "alarm", "a.radius")

    def test_questions_outside_the_domain_stand_in_the_family_invalid_and_no_others_do(self):
        # Files of this family are not judged unless it is named: a question inside the domain would hide there.
        outside, inside = committed("sphere_sphere/invalid.jsonl", 0, 3), committed("sphere_sphere/generic.jsonl", 0, 3)
        path = self.path
        self.file("d.jsonl", [{**outside[0], "count": 4}, *outside[1:], inside[1]])
        for args in (("lint", path), ("certify", path, "--family", "invalid")):
            self.refused(args, f"{path}:5: expect")
        self.file("d.jsonl", [{**inside[0], "count": 4}, *inside[1:], outside[1]])
        for command in ("lint", "certify"):
            self.refused((command, path), f"{path}:5: expect.rejected: ", "family invalid")

    def test_the_same_question_twice_is_refused_under_other_flags_too(self):
        case = {**self.spheres[1], "flags": ["Flat"]}
        self.check({"other flags": ([{**self.spheres[0], "count": len(self.spheres)}, *self.spheres[1:], case],
                                    f"{self.path}:{len(self.spheres) + 1}: id: ", "twice")})

    def test_an_expectation_off_by_one_ulp_in_a_whole_committed_file_is_found(self):
        lines = committed("sphere_sphere/far_from_origin.jsonl")
        at = max(i for i, case in enumerate(lines) if i and case["expect"]["hit"])
        old = lines[at]["expect"]["point2"][0]
        self.file("d.jsonl", put(lines, ["expect", "point2", 0], next_up, at))
        self.refused(("certify", self.path, *self.reports()),
                     f"{self.path}:{at + 1}: expect.point2[0]: ", next_up(old), old)

    def test_lint_refuses_what_is_readable_but_not_canonical(self):
        good, path = list(map(line, committed("sphere_sphere/generic.jsonl", 0, 3))), self.path
        original = (GOLDEN / "sphere_sphere" / "generic.jsonl").read_text().splitlines()
        self.assertEqual(good[1:], original[1:4])
        flags = json.loads(good[1])["flags"]
        flagged = lambda *names: [good[0], line({**json.loads(good[1]), "flags": list(names)}), *good[2:]]
        case = json.loads(good[1])
        table = {
            "undeclared flag": (flagged("Shiny"), f"{path}:2: flags: ", "Shiny"),
            "untrue flag": (flagged("Coincident"), f"{path}:2: flags: ", "Coincident"),
            "non-canonical number": ([good[0], re.sub(r'("alarm":[0-9.]+)', r"\1e0", good[1]), *good[2:]],
                                     f"{path}:2: ", "canonical"),
            "key order": ([good[0], line({"a": case["a"], **case}), *good[2:]], f"{path}:2: ", "canonical"),
            "spaces": ([good[0], json.dumps(case), *good[2:]], f"{path}:2: ", "canonical",
                       f"from column {good[1].index(':') + 2}: expected ...{good[1][good[1].index(':') + 1:][:60]}\n"),
            "carriage return": ([good[0], good[1] + "\r", *good[2:]], f"{path}:2: ", "canonical"),
        }
        self.assertNotIn("Coincident", flags)
        self.check(table, ["lint"])

    def test_lint_refuses_a_file_without_a_case_and_a_manifest_of_a_file(self):
        header = {**committed("cube_cube/generic.jsonl", 0, 0)[0], "count": 0}
        self.check({"no case": ([header], f"{self.path}:1: count: ", "at least one case")}, ["lint"])
        self.file("x.jsonl", text(committed("cube_cube/generic.jsonl", 0, 210)))
        self.refused(("lint", self.folder / "x.jsonl", "--write-manifest"), "x.jsonl: --write-manifest: ", "folders")

    def test_a_manifest_has_a_generators_digests_for_what_it_made_alone(self):
        made = {"cube_cube/separated.jsonl": (), "sphere_sphere/generic.jsonl": ("--pair", "sphere_rigid_sphere"),
                "sphere_sphere/touching.jsonl": ("--pair", "sphere_sphere", "--scalar", "binary32"), "cube_cube/generic.jsonl": ("--family", "flat"),
                "cube_cube/touching.jsonl": ("--seed", 43), "cube_cube/flat.jsonl": ("--shard", "0/2"), "cube_cube/elsewhere.jsonl": ("--family", "nested")}
        for path, other in made.items():
            (self.folder / path).parent.mkdir(exist_ok=True)
            options = {"--pair": path.split("/")[0], "--family": Path(path).stem, "--seed": 42, **dict(zip(other[::2], other[1::2]))}
            self.holds("generate", "--count", 8, *(word for pair in options.items() for word in pair), "-o", self.folder / path)
        self.holds("lint", self.folder, "--write-manifest")
        self.holds("lint", self.folder)
        listed = {one["path"]: list(one["digests"]) for one in json.loads((self.folder / "manifest.json").read_text())["files"]}
        self.assertEqual(listed, {path: ["8", "10000"] if not other else ["4" if "--shard" in other else "8"] for path, other in made.items()})

    def test_a_manifest_must_agree_with_its_folder(self):
        for name in ("generic.jsonl", "touching.jsonl"):
            self.file(name, (GOLDEN / "cube_cube" / name).read_text())
        self.holds("lint", self.folder, "--write-manifest")
        self.holds("lint", self.folder)
        manifest = self.folder / "manifest.json"
        right = manifest.read_text()
        digit = re.search(r'"sha256":"([0-9a-f])', right)
        changed = right[:digit.start(1)] + format(int(digit[1], 16) ^ 1, "x") + right[digit.end(1):]
        for wrong, word in ((changed, "the manifest says"), (right.replace('"count":210', '"count":211', 1), "the manifest says"),
                            (right.replace("touching", "missing"), "the manifest says"), ("", "malformed JSON")):
            manifest.write_text(wrong)
            self.refused(("lint", self.folder), f"{manifest}:", word, one_line=False)


class BadUsage(Case):
    def test_unknown_names_are_refused_by_name(self):
        slice_of = ("certify", GOLDEN / "cube_cube" / "generic.jsonl")
        for args, *words in (
                (("certify", "golden", "--engine", "nonesuch"), "nonesuch", "production"),
                ((*slice_of, "--family", "nonesuch"), "nonesuch"),
                ((*slice_of, "--family", "generic,nonesuch"), "nonesuch"),
                (("certify", self.folder), self.folder, "no dataset"),
                (("lint", self.folder), self.folder, "no dataset"),
                (("certify", self.folder / "gone.jsonl"), "gone.jsonl", "no such file"),
                (("lint", self.folder / "gone.jsonl"), "gone.jsonl", "no such file"),
                (("explain", self.folder / "gone.jsonl"), "gone.jsonl", "cannot read"),
                *(((command, self.folder / ("x" * 300)), "x" * 300, ": File name too long") for command in ("certify", "lint", "digests")),
                (("annotate", self.folder / "gone.jsonl", "-o", self.folder / "x.jsonl"), "gone.jsonl", "cannot read")):
            with self.subTest(args[1:]):
                self.refused(args, *words)
        for args, *words in (((*slice_of, "--level", "nonesuch"), "--level", "nonesuch", "correctly-rounded"),
                             ((*slice_of, "--level", "none"), "--level", "none"),
                             (("verify", GOLDEN / "manifest.json", "--level", "none"), "--level", "none"),
                             ((*slice_of, "--points", "nonesuch"), "--points", "nonesuch", "nearest_surface"),
                             ((*slice_of, "--check", "nonesuch"), "--check", "nonesuch", "sample"),
                             (("certify", "--generate", 2, "--pair", "nonesuch"), "--pair", "nonesuch", "cube_cube")):
            with self.subTest(args[1:]):
                self.refused(args, *words, one_line=False)

    def test_one_unknown_name_among_known_ones_is_refused_too(self):
        self.refused(("certify", "--generate", 2, "--pair", "cube_cube,nonesuch"), "nonesuch", one_line=False)
        self.refused(("certify", "--generate", 2, "--pair", "cube_cube", "--family", "generic,nonesuch"), "nonesuch")

    def test_options_that_the_program_does_not_know_or_cannot_join_are_refused(self):
        for args, word in (((), "subcommand"), (("certify", "--nonesuch"), "--nonesuch"), (("certify", "--engine"), "--engine"),
                           (("certify", "--jobs", "0"), "--jobs"), (("certify", "--jobs", "many"), "--jobs"),
                           (("certify", "--seed", "one"), "--seed"), (("annotate",), "queries"),
                           *((("certify", option, 2**32), "to 2^32 - 1") for option in ("--fresh", "--generate")),
                           ((*Outputs.GENERATE, 2**64 - 1, "-o", self.folder / "x.jsonl"), "to 2^32 - 1"), (("certify", "--jobs", 2**16), "to 2^16 - 1"),
                           (("certify", "golden", "--engine", "production", "--results", "r.jsonl"), "--results"),
                           (("certify", "golden", "--generate", "3"), "--generate")):
            with self.subTest(args):
                self.refused(args, word, one_line=False)

    def test_an_option_that_would_do_nothing_is_refused(self):
        flat, other = GOLDEN / "cube_cube" / "flat.jsonl", ("--engine-command", f"{sys.executable} {PLAIN}")
        recorded = (GOLDEN / "sphere_sphere" / "upstream.jsonl", "--results", RECORDED / "sphere_sphere.jsonl")
        table = [
            (("certify", flat, *other, "--points", "published"), "--points"),
            (("certify", *recorded, "--points", "center"), "--points"),
            (("certify", flat, "--engine", "mutant:box-euclidean", "--points", "center"), "--points"),
            (("certify", flat, "--start-limit", 3), "--start-limit"), (("certify", *recorded, "--answer-limit", 3), "--answer-limit"),
            (("certify", flat, "--shards", 3), "--shards"),
            (("certify", flat, "--engine", "production", "--fresh", 0, "--parts", self.folder / "p", "--shard", "0/2", "--determinism"), "--determinism"),
            (("certify", flat, "--parts", self.folder / "p", "--shard", "0/2", "--shards", 3), "--shards"),
            *((("certify", flat, "--parts", self.folder / "p", "--shard", "0/2", f"--{name}", self.folder / "out"), f"--{name}")
              for name in ("json", "junit", "report", "markdown")),
            *((("certify", f"--{name}", self.folder / "out"), f"--{name}") for name in ("json", "junit", "markdown")),
            (("certify", "--fail-fast"), "--fail-fast"),
            (("properties", "--engine", "production", "--jobs", 2), "--jobs"), (("properties", "--start-limit", 3), "--start-limit"),
            (("properties", *other, "--points", "center"), "--points"),
            (("properties", "--list", "--engine", "production"), "--engine"), (("properties", "--list", "--seed", 1), "--seed"),
            (("generate", "--pair", "cube_cube", "--family", "flat", "--count", 3, "--seed", 1, "--digest", "--resume"), "--resume"),
            (("digests", GOLDEN, "--write", "--force"), "--count 1000000"), (("engines", "--table", "--json"), "--json"),
            (("adequacy", GOLDEN, "--table"), "--table"), (("explain", flat, "--in", GOLDEN), "--in"), (("explain", "--in", GOLDEN), "--in")]
        for args, word in table:
            with self.subTest(args):
                self.refused(args, word)

    def test_an_empty_name_is_a_variable_that_was_not_set_and_is_refused(self):
        flat = GOLDEN / "cube_cube" / "flat.jsonl"
        for option in ("--engine", "--engine-command", "--engine-library", "--results", "--level", "--family", "--json", "--baseline",
                       "--parts", "--certificate"):
            with self.subTest(option):
                self.refused(("certify", flat, option, ""), option, "''", one_line=False)
                self.refused(("certify", flat, f"{option}="), option, "''")
        self.refused(("explain", flat, "--json="), "--json", "''")
        for args in (("certify", ""), ("explain", ""), ("adequacy", ""), ("digests", ""), ("lint", ""), ("properties", "--law", ""),
                     ("annotate", "-", "-o", self.folder / "x.jsonl", "--family", "")):
            with self.subTest(args):
                self.refused(args, "''", one_line=False)

    def test_help_shows_no_option_that_its_command_refuses(self):
        self.assertIn("--results", self.holds("certify", "--help"))
        self.assertNotIn("--results", self.holds("properties", "--help"))

    def test_what_a_run_reads_is_never_written_over(self):
        lines = committed("sphere_sphere/touching.jsonl", 0, 5)
        dataset, results = self.file("d.jsonl", lines), self.file("r.jsonl", answers_to(lines))
        answers = self.file("known.answers.jsonl", lines)  # of a certificate known.json
        (self.folder / "in").mkdir()
        inside = self.file("in/d.jsonl", lines)
        link = self.folder / "link.jsonl"
        link.symlink_to(dataset)
        known, scene = self.folder / "known.json", self.file("s.jsonl", (ROOT / "docs" / "examples" / "scenes" / "drops.jsonl").read_text())
        self.holds("certify", dataset, "--results", results, "--json", known)
        parts, shards, asked = self.folder / "p", [self.folder / f"{i}.jsonl" for i in (0, 1)], self.file("q.jsonl", [SPHERES])
        self.holds("certify", dataset, "--results", results, "--parts", parts, "--shards", 1)
        for i in (0, 1):
            self.holds("generate", "--pair", "cube_cube", "--family", "flat", "--count", 4, "--seed", 1, "--shard", f"{i}/2", "-o", shards[i])
        for args, path in ((("certify", dataset, "--results", results, "--json", results), results),
                           (("certify", dataset, "--engine", "production", "--record", dataset), dataset),
                           (("certify", self.folder / "in", "--engine", "production", "--fresh", 0, "--record", inside), inside),
                           (("certify", answers, "--engine", "production", "--certificate", self.folder / "known.json"), answers),
                           (("certify", dataset, "--report", link), link),
                           (("certify", dataset, "--results", results, "--baseline", known, "--json", known), known),
                           (("detect", scene, "-o", scene), scene), (("annotate", asked, "-o", asked), asked),
                           (("convert", *shards, "-o", shards[0]), shards[0]),
                           *((("merge", given, f"--{name}", parts / "part-0-of-1.part"), parts / "part-0-of-1.part")
                             for given, name in ((parts, "json"), (parts / "part-0-of-1.part", "report")))):
            with self.subTest(args[1:]):
                before = path.read_bytes()
                self.refused(args, path, "would be written over")
                self.assertEqual(path.read_bytes(), before)

    def test_a_folder_that_is_none_is_refused_at_once_and_by_name(self):
        flat = self.file("flat.jsonl", committed("cube_cube/flat.jsonl", 0, 2))
        for args, *words in ((("adequacy", flat), flat, "no folder"), (("adequacy", flat, "--write"), flat, "no folder"),
                             (("regenerate", flat), flat, "no folder"), (("digests", self.folder), self.folder, "no manifest.json"),
                             (("digests", self.folder / "gone"), "gone", "no manifest.json"),
                             (("properties", "--save", self.folder / "gone" / "x.jsonl"), "gone/x.jsonl", "cannot write"),
                             (("properties", "--save", self.folder / "x.txt"), "x.txt", ".jsonl"),
                             (("properties", "--save", self.folder / "x.jsonl", "--json", self.folder / "x.jsonl"), "x.jsonl", "another output")):
            with self.subTest(args):
                self.refused(args, *words)

    def test_an_unknown_command_is_named(self):
        self.refused(("nonesuch",), "nonesuch", one_line=False)

    def test_generate_refuses_what_it_cannot_make(self):
        right = {"--pair": "cube_cube", "--family": "generic", "--count": 3, "--seed": 1, "-o": self.folder / "x.jsonl"}
        for key, value, *words in (("--pair", "nonesuch", "nonesuch"), ("--family", "nonesuch", "nonesuch", "generic"),
                                   ("--scalar", "half", "half", "binary64,binary32"), ("--shard", "7/7", "7/7"), ("--shard", "1/0", "1/0"),
                                   ("--shard", "-1/3", "-1/3"), ("--shard", "1", "'1'"), ("--shard", "1/3x", "1/3x"),
                                   ("--shard", "a/b", "a/b"), ("--count", "0", "--count"), ("--count", "many", "--count"),
                                   ("--seed", "x", "--seed"), ("--seed", "1e400", "--seed"), ("--seed", "-1", "-1"),
                                   ("-o", self.folder / "x.txt", "x.txt", ".jsonl"),
                                   ("-o", self.folder / "gone" / "x.jsonl", "gone/x.jsonl", "cannot write")):
            with self.subTest(option=key, value=str(value)):
                args = [word for pair in {**right, key: value}.items() for word in pair]
                self.refused(("generate", *args), *words, one_line=False)
        for key in right:
            with self.subTest(missing=key):
                args = [word for k, v in right.items() if k != key for word in (k, v)]
                self.refused(("generate", *args), {"-o": "--output"}.get(key, key), one_line=False)


class Outputs(Case):
    GENERATE = ("generate", "--pair", "sphere_sphere", "--family", "generic", "--seed", 1, "--count")
    CERTIFY = ("certify", GOLDEN / "cube_cube" / "generic.jsonl")

    def test_no_progress_is_written_where_standard_error_is_not_a_terminal_and_a_bar_where_it_is(self):
        upstream = GOLDEN / "sphere_sphere" / "upstream.jsonl"
        for args, total in ((("certify", upstream), 891), (("lint", upstream), 891),
                            (("generate", "--all", self.folder / "set", "--seed", 1, "--count", 1, "--resume"), 968)):
            self.holds(*args)
            for quiet in (False, True):
                try:
                    master, slave = pty.openpty()
                except OSError as error:
                    self.skipTest(f"no terminal can be made here: {error}")
                done = run(*args, *["--quiet"] * quiet, capture_output=False, stdout=subprocess.DEVNULL, stderr=slave)
                self.assertEqual(done.returncode, 0)
                os.close(slave)
                try:
                    bar = os.read(master, 65536)
                except OSError:  # nothing was written, and the other end is closed
                    bar = b""
                os.close(master)
                self.assertEqual(b"\r" in bar, not quiet, bar)
                # Certifying so few may be over before a number is drawn.
                done = [int(n) for n in re.findall(rf"(\d+) of {total}\b".encode(), bar)]
                self.assertTrue(all(n <= total for n in done) and (quiet or args[0] == "certify" or max(done, default=0) > 0), done)

    def test_an_output_that_cannot_be_written_is_refused_by_name(self):
        (self.folder / "folder.jsonl").mkdir()
        queries = self.file("q.jsonl", [SPHERES])
        for target, word in ((self.folder / "gone" / "x.jsonl", "No such file"), (self.folder / "folder.jsonl", "directory")):
            for args in ((*self.GENERATE, 3, "-o"), ("annotate", queries, "-o"),
                         *((*self.CERTIFY, option) for option in ("--json", "--junit", "--report"))):
                with self.subTest(args[-1], command=args[0], word=word):
                    self.refused((*args, target), target, "cannot write", word)

    def test_a_full_disk_is_reported_and_leaves_no_file(self):
        def no_room():
            resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))
        for args in ((*self.GENERATE, 500, "-o"), (*self.CERTIFY, "--json"), (*self.CERTIFY, "--report")):
            with self.subTest(args[0]):  # Python ignores SIGXFSZ, and so does its child: a write beyond the limit fails
                target = self.folder / "x.jsonl"
                self.refused((*args, target), target, "cannot write", preexec_fn=no_room, restore_signals=False)

    @unittest.skipUnless(os.path.exists("/dev/full"), "no /dev/full here")
    def test_standard_output_that_cannot_be_written_is_not_a_success(self):
        for args in (("explain", "--json"), ("explain",), self.CERTIFY):
            with self.subTest(args[0]), open("/dev/full", "w") as full:
                done = run(*args, stdin=text([SPHERES]), capture_output=False, stdout=full, stderr=subprocess.DEVNULL)
                self.assertEqual(done.returncode, 2)

    def test_a_closed_standard_stream_changes_no_file_and_ends_no_run(self):
        scene, found = ROOT / "docs/examples/scenes/bars.jsonl", self.folder / "found.jsonl"
        self.assertEqual(run("detect", scene, "-o", found, stdin=None).returncode, 0)
        right = found.read_bytes()
        for stream in (0, 1, 2):
            with self.subTest(stream):
                closed = {"preexec_fn": lambda number=stream: os.close(number), "stdin": None, "capture_output": False, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
                self.assertEqual(run("detect", scene, "-o", found, **closed).returncode, 2 if stream == 1 else 0)  # its words go there
                self.assertEqual(found.read_bytes(), right)
                asked = run("certify", GOLDEN / "sphere_sphere/touching.jsonl", "--fresh", 0, "--engine-command", shlex.join([sys.executable, str(PLAIN)]),
                            "--json", self.folder / "r.json", **closed)
                self.assertIn(asked.returncode, (1, 2))  # 2: the report could not be printed
                self.assertFalse(json.loads((self.folder / "r.json").read_text())["certified"])

    def test_files_are_written_where_nobody_reads_what_is_printed(self):
        reader, writer = os.pipe()
        os.close(reader)
        self.addCleanup(os.close, writer)
        unread = {"capture_output": False, "stdout": writer, "stderr": subprocess.PIPE}
        judged = ("certify", GOLDEN / "sphere_sphere", "--fresh", 0, "--engine", "plain-float")
        laws = ("properties", "--engine", "plain-double", "--seed", 1, "--cases", 300, "--law", "decision,touching,bounds")
        saved = ("--save", self.folder / "saved.jsonl", "--junit", self.folder / "saved.xml")
        for args, names in (((*judged, "--certificate", self.folder / "c.json"), ("c.json", "c.answers.jsonl")),
                            ((*judged, "--certificate", self.folder / "c.json", "--json"), ("c.json", "c.answers.jsonl")),
                            ((*laws, *saved), ("saved.jsonl", "saved.xml")), ((*laws, *saved, "--json"), ("saved.jsonl", "saved.xml"))):
            with self.subTest(args):
                done = run(*args, **unread)
                self.assertEqual((done.returncode, done.stderr.splitlines()[-1]), (2, "contact-oracle: standard output: cannot write"))
                for name in names:
                    (self.folder / name).unlink()

    def test_an_output_that_is_no_regular_file_is_never_replaced(self):
        fifo = self.folder / "x.jsonl"
        os.mkfifo(fifo)
        reader = os.open(fifo, os.O_RDONLY | os.O_NONBLOCK)
        self.addCleanup(os.close, reader)
        self.holds(*self.CERTIFY, "--json", fifo)
        self.assertTrue(fifo.is_fifo())
        self.assertTrue(json.loads(os.read(reader, 1 << 20))["certified"])

    def test_an_interrupted_generate_leaves_what_was_there(self):
        target = self.file("x.jsonl", "old\n")
        out, err = self.interrupted((*self.GENERATE, 20000000, "-o", target), lambda _: self.files_are(2))
        self.assertEqual(out, "")
        self.assertIn("interrupted", err)
        self.assertEqual((list(self.folder.iterdir()), target.read_text()), ([target], "old\n"))

    def test_an_interrupted_lint_ends_before_its_file_does(self):
        path = self.folder / "long.jsonl"  # it would take many times as long as the signal, however busy the machine
        self.holds("generate", "--pair", "sphere_sphere", "--family", "generic", "--count", 3000, "--seed", 1, "-o", path)
        self.assertEqual(self.interrupted(("lint", path))[0], "")

    def test_an_interruption_ends_a_command_that_waits_for_its_input(self):
        self.interrupted(("explain",))

    def test_an_interruption_ends_a_command_that_looks_nowhere_and_leaves_no_file(self):
        # A pipe that somebody holds open and writes nothing into: the read does not come back by itself.
        fifo, target = self.folder / "fifo", self.file("x.jsonl", "old\n")
        os.mkfifo(fifo)
        writer = os.open(fifo, os.O_RDWR)
        self.addCleanup(os.close, writer)

        def waiting(process):
            wait_until_signals_are_caught(process)
            time.sleep(0.1)
        unopened = self.folder / "unopened"
        os.mkfifo(unopened)
        for args in (["detect", fifo, "-o", target], ["explain", fifo], ["serve"], ["annotate", fifo, "-o", target], ["compare", unopened, unopened],
                     [*self.CERTIFY, "--report", unopened]):
            for name in ("SIGINT", "SIGTERM"):
                with self.subTest(args=args[0], signal=name):
                    self.interrupted(args, waiting, getattr(signal, name))
                    self.assertEqual((sorted(self.folder.iterdir()), target.read_text()), ([fifo, unopened, target], "old\n"))

    @unittest.skipUnless(os.environ.get("CONTACT_THROWING_LIBRARY"), "CONTACT_THROWING_LIBRARY names no library")
    def test_a_library_that_declares_nothing_or_throws_is_a_harness_failure_and_no_crash(self):
        library = os.environ["CONTACT_THROWING_LIBRARY"]
        asked = "".join(line({"op": "query", "seq": seq, "pair": "sphere_sphere", **SPHERES}) + "\n" for seq in (1, 2))
        for how, words in (("null", "returned NULL"), ("int", "contact_engine_declaration threw"), ("exception", "contact_engine_declaration threw an exception: no"),
                           ("interface", "contact_engine_interface threw")):
            for args in (["serve"], ["certify", GOLDEN / "sphere_sphere/upstream.jsonl"]):
                done = run(*args, "--engine-library", library, stdin=asked, env={**os.environ, "CONTACT_THROWS": how})
                self.assertEqual(done.returncode, 3, (how, args, done.stderr))
                self.assertIn(words, done.stderr)
        for how in ("answer", "answer-int"):
            for threads in ("1", "1000000000"):
                done = run("serve", "--engine-library", library, "--threads", threads, stdin=asked, env={**os.environ, "CONTACT_THROWS": how})
                self.assertEqual((done.returncode, done.stdout.count('"error":"contact_engine_answer threw an exception')), (0, 2), done.stderr)

    def test_a_message_that_quotes_much_is_cut(self):
        for args in (["certify", "--engine", "x" * 100_000], ["x" * 100_000], ["certify", "--" + "x" * 100_000], ["generate", "--seed", "9" * 100_000]):
            done = run(*args)
            self.assertEqual(done.returncode, 2)
            self.assertLess(len(done.stderr), 6000)
        self.assertIn("from 0 to 2^64 - 1, got '18446744073709551616'", run("generate", "--seed", 2**64).stderr)


class Generate(Case):
    def make(self, name, *more, pair="sphere_sphere", family="near_touching", count=50, seed=42):
        path = self.folder / name
        out = self.holds("generate", "--pair", pair, "--family", family, "--count", count, "--seed", seed, "-o", path, *more)
        self.assertIn(str(path), out)
        return path.read_bytes()

    def test_the_same_seed_makes_the_same_bytes_and_another_seed_others(self):
        first = self.make("a.jsonl")
        self.assertEqual(first, self.make("b.jsonl"))
        other = self.make("c.jsonl", seed=43)
        self.assertEqual(set(first.splitlines()[1:]) & set(other.splitlines()[1:]), set())

    def test_the_bodies_of_seven_shards_are_the_whole_body(self):
        body = lambda content: content.split(b"\n", 1)[1]
        for pair, scalar in (("sphere_rigid_sphere", "binary64"), ("cube_cube", "binary32")):
            whole = body(self.make("whole.jsonl", "--scalar", scalar, pair=pair, family="touching"))
            parts = [self.make(f"{i}.jsonl", "--scalar", scalar, "--shard", f"{i}/7", pair=pair, family="touching")
                     for i in range(7)]
            self.assertEqual(b"".join(map(body, parts)), whole)
            for i, part in enumerate(parts):
                self.assertEqual(json.loads(part.splitlines()[0])["shard"], [i, 7])
                self.holds("lint", "--generated", self.folder / f"{i}.jsonl")

    def test_every_family_of_every_pair_passes_lint(self):
        self.passes_lint(1)

    def passes_lint(self, count):
        self.holds("generate", "--all", self.folder / "set", "--seed", 2**64 - 1, "--count", count)
        self.holds("lint", "--generated", self.folder / "set")

    def test_a_question_that_its_generator_makes_twice_passes_lint_as_generated_alone(self):
        # Binary32's numbers at the ends of its range are few.
        made = self.make("a.jsonl", "--scalar", "binary32", family="extreme_scale", count=460, seed=72).splitlines()
        identity = json.loads(made[460])["id"]
        self.assertEqual(json.loads(made[324])["id"], identity)
        self.holds("lint", "--generated", self.folder / "a.jsonl")
        self.refused(("lint", self.folder / "a.jsonl"), "a.jsonl:461: id: ", "twice", identity)

    def test_a_shard_without_a_case_is_a_dataset_that_passes_lint(self):
        header, = self.make("none.jsonl", "--shard", "0/9", pair="cube_cube", family="flat", count=3).splitlines()
        self.assertEqual((json.loads(header)["count"], json.loads(header)["shard"]), (0, [0, 9]))
        self.holds("lint", "--generated", self.folder / "none.jsonl")

    def test_the_committed_files_are_those_of_the_manifest_and_what_no_family_makes_is_right(self):
        digests = {one["path"]: one["sha256"] for one in json.loads((GOLDEN / "manifest.json").read_text())["files"]}
        files = [path for path in GOLDEN.rglob("*.jsonl") if "recorded" not in path.parts]
        self.assertEqual({str(path.relative_to(GOLDEN)): hashlib.sha256(path.read_bytes()).hexdigest() for path in files}, digests)
        families = self.families()
        others = [path for path in files if path.name.split(".")[0] not in families.get(path.parent.name, ())]
        self.assertGreater(len(others), 20)
        self.assertIn("every expectation right", self.holds("lint", *others))

    def test_regenerate_asks_for_its_folder_and_leaves_what_it_did_not_write(self):
        (self.folder / "golden").mkdir()
        self.refused(("regenerate",), "folder", one_line=False, cwd=self.folder)
        (self.folder / "sphere_sphere").mkdir()
        mine = self.folder / "sphere_sphere" / "touching.jsonl"
        for other in (("--count", 3, "--seed", 42), ("--count", 210, "--seed", 43), ("--count", 420, "--seed", 42, "--shard", "0/2")):
            self.holds("generate", "--pair", "sphere_sphere", "--family", "touching", *other, "-o", mine)
            before = mine.read_bytes()
            self.refused(("regenerate", self.folder), mine, "move it away")
            self.assertEqual(mine.read_bytes(), before)
        mine.write_text("precious\n")
        self.refused(("regenerate", self.folder), mine)
        self.assertEqual(mine.read_text(), "precious\n")

    def test_all_makes_every_family_of_every_pair_laid_out_as_the_committed_files(self):
        whole = self.folder / "set"
        args = ("generate", "--all", whole, "--seed", 42, "--count", 3)
        families = self.families()
        out = self.holds(*args)
        made = {str(path.relative_to(whole)) for path in whole.rglob("*") if path.is_file()}
        self.assertEqual(made, {f"{pair}/{family}{end}" for pair in PAIRS for family in families[pair] for end in (".jsonl", ".f32.jsonl")})
        self.assertEqual(out, f"{whole}: {len(made)} files of 3 cases\n")
        for path in made:  # of the same seed: the committed files begin alike
            header, *cases = (whole / path).read_text().splitlines()
            self.assertEqual(json.loads(header)["count"], 3)
            if (GOLDEN / path).exists():
                self.assertEqual(cases, (GOLDEN / path).read_text().splitlines()[1:4], path)
        # What is whole is kept, what is missing is made, what is damaged or of another set is refused.
        for path in ("cube_cube/flat.jsonl", "ray_sphere/touching.f32.jsonl"):
            (whole / path).unlink()
        kept = (whole / "cube_cube" / "nested.jsonl").stat().st_mtime_ns
        self.assertEqual(self.holds(*args, "--resume"), f"{whole}: {len(made)} files of 3 cases, {len(made) - 2} of them kept as they stand there\n")
        self.assertEqual((whole / "cube_cube" / "nested.jsonl").stat().st_mtime_ns, kept)
        self.assertEqual({str(path.relative_to(whole)) for path in whole.rglob("*") if path.is_file()}, made)
        damaged = whole / "sphere_plane" / "generic.jsonl"
        damaged.write_text(damaged.read_text().replace('"hit":', '"hot":', 1))
        self.refused((*args, "--resume"), damaged)
        damaged.unlink()
        self.refused(("generate", "--all", whole, "--seed", 43, "--count", 3, "--resume"), whole, "move it away")

    def families(self):
        """The families of each pair, as the list of them and completion say."""
        listed = [json.loads(one) for one in self.holds("families", "--json").splitlines()]
        first = lambda one: "cast ray" if one["pair"].startswith("cast_") else one["a"]["shape"]
        shapes = {one["pair"]: {first(one), one["b"]["shape"]} for one in map(json.loads, self.holds("pairs", "--json").splitlines())}
        plural = {"cubes": {"cube"}, "capsules": {"capsule"}, "spheres": {"sphere"}}
        of = lambda words: plural.get(words, set(words.split(" and ")))
        has = lambda one, pair: one["shapes"] == "any two convex shapes" if pair in CONVEXES else of(one["shapes"]) == shapes[pair]
        return {pair: [one["family"] for one in listed if "family" in one and has(one, pair)] for pair in PAIRS}

    def test_all_goes_with_no_option_of_one_file(self):
        for option, value in (("--pair", "cube_cube"), ("--family", "flat"), ("--scalar", "binary32"), ("--shard", "0/2"), ("-o", "x.jsonl")):
            self.refused(("generate", "--all", self.folder / "set", "--seed", 1, "--count", 1, option, value), "--all", one_line=False)
        self.refused(("generate", "--seed", 1, "--count", 1, "--pair", "cube_cube", "-o", self.folder / "x.jsonl"), "--family", "--all")

    def test_the_manifest_lists_all_committed_files(self):
        listed = {one["path"] for one in json.loads((GOLDEN / "manifest.json").read_text())["files"]}
        files = {str(path.relative_to(GOLDEN)) for path in GOLDEN.rglob("*.jsonl")}
        self.assertEqual(listed, {path for path in files if not path.startswith("recorded/")})


class Digests(Case):
    """SHA-256 of answers: the program's, the manifest's, and those of the Python on the page."""

    def setUp(self):
        super().setUp()
        page = (ROOT / "docs" / "formats.md").read_text().split("<!-- digest:begin -->\n```python")[1].split("```")[0]
        names = {}
        exec(page, names)
        self.digest = names["digest"]
        self.manifest = json.loads((GOLDEN / "manifest.json").read_text())

    def test_python_finds_the_manifests_digest_in_every_committed_file(self):
        for one in self.manifest["files"]:
            lines = (GOLDEN / one["path"]).read_text().splitlines()
            self.assertEqual(self.digest(lines), one["digests"][str(one["count"])], one["path"])

    def test_generate_prints_the_digest_of_what_it_would_write(self):
        table = {one["path"]: one["digests"] for one in self.manifest["files"]}
        for pair, family, scalar in (("sphere_sphere", "coincident", "binary32"), ("cube_cube", "invalid", "binary64"),
                                     ("sphere_rigid_sphere", "touching", "binary64")):
            args = ("generate", "--pair", pair, "--family", family, "--scalar", scalar, "--digest")
            digests = table[f"{pair}/{family}{'.f32' * (scalar == 'binary32')}.jsonl"]
            alone = self.holds(*args, "--seed", 42, "--count", 210)
            self.assertEqual(alone, digests["210"] + "\n")
            path = self.folder / f"{family}.jsonl"
            both = self.holds(*args, "--seed", 42, "--count", 210, "-o", path)
            self.assertEqual(both, f"{path}: 210 cases\n{alone}")
            self.assertEqual(path.read_bytes(), (GOLDEN / pair / f"{family}{'.f32' * (scalar == 'binary32')}.jsonl").read_bytes())
            if family != "invalid":  # whose fields take turns, whatever the seed
                self.assertNotEqual(self.holds(*args, "--seed", 43, "--count", 210), alone)
        self.refused(("generate", "--pair", "cube_cube", "--family", "flat", "--count", 3, "--seed", 1), "-o")

    def test_a_shards_digest_is_that_of_its_own_lines(self):
        path = self.folder / "part.jsonl"
        out = self.holds("generate", "--pair", "cube_cube", "--family", "flat", "--count", 50, "--seed", 1, "--shard", "1/3",
                         "-o", path, "--digest")
        self.assertEqual(out.splitlines()[1], self.digest(path.read_text().splitlines()))

    def test_a_digest_that_the_answers_do_not_have_is_named(self):
        text = (GOLDEN / "manifest.json").read_text().splitlines(keepends=True)
        entry = next(line for line in text if '"cube_cube/flat.jsonl"' in line).rstrip(",\n") + "\n"
        right = json.loads(entry)["digests"]["10000"]
        manifest = self.folder / "manifest.json"
        for digest, verdict in ((right, "1 digests right"), ("0" * 64, f"says {'0' * 64} for 10000 answers")):
            for who in ((), ("--production",)):
                manifest.write_text(text[0] + entry.replace(right, digest) + "]}\n")
                out = self.refuted("digests", self.folder, *who)  # the other files are not there
                self.assertIn(verdict, out)
                self.assertEqual("cube_cube/flat.jsonl" in out, digest != right)

    def test_the_digest_of_a_million_goes_when_that_of_ten_thousand_changes(self):
        (self.folder / "cube_cube").mkdir()
        path = "cube_cube/separated.jsonl"
        (self.folder / path).write_bytes((GOLDEN / path).read_bytes())
        manifest = self.folder / "manifest.json"
        self.holds("lint", self.folder, "--write-manifest")
        right = json.loads(manifest.read_text())["files"][0]["digests"]
        self.assertEqual(right, {k: v for k, v in self.digests_of(path).items() if k != "1000000"})
        text = manifest.read_text().replace(right["10000"] + '"', right["10000"] + '","1000000":"' + "a" * 64 + '"')
        for stale, kept in ((text, True), (text.replace(right["10000"], "b" * 64), False),
                            (re.sub(r"contact-oracle [0-9.]+", "contact-oracle 0.0.9", text), False)):
            manifest.write_text(stale)
            self.holds("lint", self.folder, "--write-manifest")
            self.assertEqual("1000000" in json.loads(manifest.read_text())["files"][0]["digests"], kept)

    def digests_of(self, path):
        return next(one["digests"] for one in self.manifest["files"] if one["path"] == path)


class Adequacy(Case):
    def setUp(self):
        super().setUp()
        (self.folder / "cube_cube").mkdir()
        (self.folder / "cube_cube" / "flat.jsonl").write_bytes((GOLDEN / "cube_cube" / "flat.jsonl").read_bytes())
        self.out = self.refuted("adequacy", self.folder, "--write")  # one file is not enough

    def test_what_is_not_adequate_is_said_and_written_all_the_same(self):
        self.assertIn("NOT ADEQUATE: 0 cases kill rapier-coincident-nan, and 10 should", self.out)
        self.assertIn("NOT ADEQUATE: cubes flat kills what no other family kills", self.out)
        flat, quick = json.loads((self.folder / "adequacy.json").read_text())["files"]
        self.assertEqual((flat["path"], quick["path"]), ("cube_cube/flat.jsonl", "quick/cube_cube.jsonl"))
        self.assertEqual(sorted(flat["kills"]), sorted(quick["kills"]))
        self.assertEqual(flat["kills"], next(one["kills"] for one in json.loads((GOLDEN / "adequacy.json").read_text())["files"]
                                             if one["path"] == flat["path"]))
        self.assertEqual(self.refuted("adequacy", self.folder), self.out)

    def test_a_kill_too_many_is_refused_by_adequacy_and_by_lint(self):
        self.holds("lint", self.folder, "--write-manifest")
        self.holds("lint", self.folder)
        path = self.folder / "adequacy.json"
        path.write_text(path.read_text().replace('"kills":["', '"kills":["rapier-coincident-nan","', 1))
        self.refused(("adequacy", self.folder), "adequacy.json:2", "not what the mutants say", one_line=False)
        self.refused(("lint", self.folder), "manifest.json:2", one_line=False)

    def test_a_quick_case_too_few_is_refused(self):
        path = self.folder / "quick" / "cube_cube.jsonl"
        path.write_text("".join(path.read_text().splitlines(keepends=True)[:-1]))
        self.refused(("adequacy", self.folder), "quick/cube_cube.jsonl:", one_line=False)

    def test_what_stands_behind_or_beside_the_right_files_is_refused(self):
        for name in ("adequacy.json", "quick/cube_cube.jsonl"):
            path = self.folder / name
            right = path.read_text()
            for more in ("{}\n", "\n", " "):
                path.write_text(right + more)
                self.refused(("adequacy", self.folder), f"{name}:{right.count(chr(10)) + 1}: not what the mutants say: expected no more", one_line=False)
            path.write_text(right[:-1])
            self.refused(("adequacy", self.folder), f"{name}:{right.count(chr(10))}: not what the mutants say", one_line=False)
            path.write_text(right)
        beside = self.folder / "quick" / "cube_cube.f32.jsonl"
        beside.write_bytes((self.folder / "cube_cube" / "flat.jsonl").read_bytes())
        self.refused(("adequacy", self.folder), beside, "not one of the files that the mutants ask for", one_line=False)
        beside.unlink()
        self.assertEqual(self.refuted("adequacy", self.folder), self.out)

    def test_it_writes_where_it_is_told_and_over_what_it_wrote(self):
        self.refused(("adequacy", "--write"), "--write", "name it")
        quick, listed = self.folder / "quick" / "cube_cube.jsonl", self.folder / "adequacy.json"
        mine = self.file("quick/mine.txt", "precious\n")
        again = self.refuted("adequacy", self.folder, "--write")
        self.assertEqual((again, mine.read_text()), (self.out, "precious\n"))
        # What an earlier run wrote and this one would not goes, unless somebody has changed it.
        small = text(committed("sphere_sphere/generic.jsonl", 0, 1))
        files = json.loads(listed.read_text())
        for name in ("stale", "changed"):
            self.file(f"quick/{name}", small)
            files["files"].append({"path": f"quick/{name}", "sha256": hashlib.sha256(small.encode()).hexdigest(), "kills": []})
        outside = self.file("outside", small)
        files["files"].append({**files["files"][-1], "path": "quick/../outside"})
        self.file("quick/changed", small + "\n")
        listed.write_text(json.dumps(files))
        self.refuted("adequacy", self.folder, "--write")
        self.assertEqual(sorted(path.name for path in (self.folder / "quick").iterdir()), ["changed", "cube_cube.jsonl", "mine.txt"])
        self.assertEqual(outside.read_text(), small)
        # A file of this name that no run wrote stays, and is named.
        listed.unlink()
        quick.write_text("precious\n")
        self.refused(("adequacy", self.folder, "--write"), quick, "move it away")
        self.assertEqual(quick.read_text(), "precious\n")
        quick.unlink()
        listed.write_text("{}")
        self.refused(("adequacy", self.folder, "--write"), "adequacy.json", "format")

    def test_adequacy_of_other_files_is_refused(self):
        for change in (lambda path: path.write_text(path.read_text().replace('"seed":42', '"seed":43')), Path.unlink):
            change(self.folder / "cube_cube" / "flat.jsonl")
            self.refused(("lint", self.folder, "--write-manifest"), "adequacy.json", one_line=False)

    def test_a_folder_quick_is_judged_only_where_it_is_named(self):
        judged = lambda *args: json.loads(self.json_of(*args))["total"]["cases"]
        self.assertEqual(judged(self.folder), 210)
        quick = len((self.folder / "quick" / "cube_cube.jsonl").read_text().splitlines()) - 1
        self.assertEqual(judged(self.folder / "quick"), quick)
        self.assertEqual(judged(self.folder, self.folder / "quick"), 210 + quick)
        self.assertIn(f"{210 + quick} cases in 2 files", self.holds("lint", self.folder))

    def json_of(self, *paths):
        self.holds("certify", *paths, "--engine", "production", "--json", self.folder / "report.json")
        return (self.folder / "report.json").read_text()

    def test_quick_refutes_mutants_of_every_pair_and_those_outside_the_domain(self):
        for mutant in ("box-euclidean", "rp3d-sphere-first-sign", "gamemaker-nan-hits-all", "gfm-nan-contained", "bevy-corner-test"):
            self.refuted("certify", "golden/quick", "--family", "quick,invalid", "--engine", f"mutant:{mutant}")
        self.holds("certify", "golden/quick", "--family", "quick,invalid", "--level", "correctly-rounded")


class Annotate(Case):
    def test_the_worked_examples_have_their_ids_and_answers(self):
        path = self.annotated(SPHERES)
        self.assertEqual(path.read_text().splitlines()[1],
                         f'{{"id":"{SPHERES_ID}",{line(SPHERES)[1:-1]},"flags":["Touching"],{SPHERES_EXPECT}')
        self.holds("lint", path)
        path = self.annotated(CUBES)
        self.assertEqual(json.loads(path.read_text().splitlines()[1])["id"], CUBES_ID)
        self.holds("lint", path)
        self.holds("certify", path)

    def test_the_pair_is_part_of_the_id_and_the_scalar_is_not(self):
        ids = set()
        for pair in PAIRS[:3]:
            for scalar in ("binary32", "binary64"):
                path = self.annotated({"pair": pair, "scalar": scalar, **SPHERES})
                header, case = map(json.loads, path.read_text().splitlines())
                self.assertEqual((header["pair"], header["scalar"], header["count"]), (pair, scalar, 1))
                ids.add((pair, case["id"]))
        self.assertEqual(len({one for _, one in ids}), 3)
        self.assertIn(("sphere_sphere", SPHERES_ID), ids)

    def test_questions_that_do_not_go_together_are_refused(self):
        far = {**SPHERES, "alarm": 7}
        for name, second, *words in (
                ("mixed pairs", CUBES, "pair: ", "cube_cube"), ("mixed scalars", {**far, "scalar": "binary32"}, "scalar: ", "binary32"),
                ("duplicate", SPHERES, "id: ", "twice"), ("duplicate in other words", {**SPHERES, "id": SPHERES_ID}, "id: ", "twice"),
                ("wrong id", {**far, "id": SPHERES_ID}, "id: ", SPHERES_ID), ("NaN", {**far, "alarm": "NaN"}, "alarm: ", "NaN"),
                ("negative", {**far, "contact": -1}, "contact: ", "-1"), ("unknown key", {**far, "mass": 3}, "mass: ", "3"),
                ("malformed", "{", "malformed JSON")):
            with self.subTest(name):
                queries = self.file("q.jsonl", [SPHERES, second])
                self.refused(("annotate", queries, "-o", self.folder / "x.jsonl"), f"{queries}:2: ", *words)
        self.refused(("annotate", self.file("q.jsonl", ""), "-o", self.folder / "x.jsonl"), "q.jsonl", "no question")


class Explain(Case):
    def test_the_words_name_the_decision_and_the_exact_numbers(self):
        out = self.holds("explain", stdin=text([SPHERES, CUBES, {**SPHERES, "b": {"center": [9, 0, 0], "radius": 1}}]))
        for word in (SPHERES_ID, CUBES_ID, "exactly 0x9p0", "exactly 0x3p0", "exactly touching", "0.3333333333333333", "gap"):
            self.assertIn(word, out)
        self.assertEqual((out.count("  HIT\n"), out.count("  MISS\n")), (2, 1))

    def test_with_json_there_is_one_line_a_question(self):
        queries = self.file("q.jsonl", [SPHERES, CUBES])
        first, second = self.holds("explain", "--json", queries).splitlines()
        self.assertEqual(first, f'{{"id":"{SPHERES_ID}",{SPHERES_EXPECT[:-1]},"distance":0}}')
        self.assertEqual(second, f'{{"id":"{CUBES_ID}","expect":{{"hit":true}},"exact":{{"gap":["0x0p0","-0x1p0","-0x1p0"]}}}}')

    def test_the_distance_is_told_of_every_pair_that_has_one_of_misses_too(self):
        ball = lambda x, y, r: {"center": [x, y, 0], "radius": r}
        ray = {"origin": [0, 0, 0], "direction": [2, 0, 0], "length": 1}
        floor = {"normal": [0, 3, 0], "offset": 6}
        triangle = {"vertices": [[9, -1, -1], [9, 2, -1], [9, -1, 2]]}
        box = {"min": [4, -1, -1], "max": [5, 3, 1]}
        asked = {  # what is 3-4-5 or along an axis, by hand
            "sphere_sphere": (ball(0, 0, 1), ball(3, 4, 1.5), 2.5), "sphere_cube": (ball(1, 7, 0.5), box, 4.5),
            "ray_sphere": (ray, ball(5, 4, 2), 3), "sphere_plane": (ball(7, 6, 1), floor, 3),
            "sphere_triangle": (ball(0, 0, 2), triangle, 7), "ray_triangle": (ray, triangle, None), "cube_cube": (box, {"min": [7, 0, 0], "max": [8, 1, 1]}, None)}
        asked = {pair: ({"pair": pair, "a": a, "b": b, "alarm": 0, "contact": 0}, said) for pair, (a, b, said) in asked.items()}
        within = {**asked["sphere_plane"][0], "a": ball(0, 1, 1)}, -2  # below the plane, and a hit
        inside = {**asked["sphere_cube"][0], "a": ball(4.25, 1, 0.5)}, -0.75
        root = {**asked["sphere_sphere"][0], "b": ball(1, 1, 0)}, 0.41421356237309503
        for question, said in (*asked.values(), within, inside, root):
            with self.subTest(question):
                out = json.loads(self.holds("explain", "--json", stdin=text([question])))
                self.assertEqual(out.get("distance"), said)
                words = re.findall(r"(?m)^  distance  (?:s - r1|sqrt\(D\) - r1 - r2) +[=~] (\S+)$", self.holds("explain", stdin=text([question])))
                self.assertEqual([float(word) for word in words], [] if said is None else [said])
        self.assertIn("there is none to tell", self.holds("explain", stdin=text([asked["ray_triangle"][0]])))

    def test_the_derivatives_are_those_worked_out_by_hand(self):
        # n = (1,2,2)/3, D = 9: d normal = (1 - n n^T)/3 d(b - a), and the rest from point1 = a + r1 n, point2 = b - r2 n.
        n = [Fraction(1, 3), Fraction(2, 3), Fraction(2, 3)]
        one = [[Fraction(i == k) for k in range(3)] for i in range(3)]
        turn = [[(one[i][k] - n[i] * n[k]) / 3 for k in range(3)] for i in range(3)]
        r = Fraction(3, 2)
        right = {"value": [*(-x for x in n), -1, *n, -1],
                 "normal": [[*(-x for x in turn[i]), 0, *turn[i], 0] for i in range(3)],
                 "point1": [[*(one[i][k] - r * turn[i][k] for k in range(3)), n[i], *(r * turn[i][k] for k in range(3)), 0] for i in range(3)],
                 "point2": [[*(r * turn[i][k] for k in range(3)), 0, *(one[i][k] - r * turn[i][k] for k in range(3)), -n[i]] for i in range(3)]}
        out = json.loads(self.holds("explain", "--json", "--gradient", stdin=text([SPHERES])))
        self.assertEqual(out["exact"].pop("gradient"), {key: [float(x) for x in row] if key == "value" else [[float(x) for x in line] for line in row]
                                                        for key, row in right.items()})
        self.assertEqual(out, json.loads(self.holds("explain", "--json", stdin=text([SPHERES]))))
        self.assertRegex(self.holds("explain", "--gradient", stdin=text([SPHERES])),
                         r"(?m)^  by a\.center\[0\]  -0\.333333  \(-0\.296296, 0\.0740741, 0\.0740741\)  ")

    def test_where_there_is_no_derivative_it_is_said_why(self):
        corner = {"pair": "sphere_cube", "a": {"center": [0, 2, 0], "radius": 0}, "b": {"min": [-1, -1, -1], "max": [0, 1, 1]}, "alarm": 0, "contact": 0}
        same = {**SPHERES, "b": {"center": [0, 0, 0], "radius": 1}}
        axis = lambda y: {"start": [0, y, 0], "end": [2, y, 0], "radius": 1}
        parallel = {**corner, "pair": "capsule_capsule", "a": axis(0), "b": axis(3)}
        told = [json.loads(line)["exact"]["gradient"] for line in
                self.holds("explain", "--json", "--gradient", stdin=text([corner, same, parallel, CUBES])).splitlines()]
        nulls = [{(null["of"], null["by"]): (null["undefined"], null.get("sides")) for null in one.get("nulls", ())} for one in told]
        self.assertEqual(told[0]["value"], [0, 1, 0, None, 0, 0, 0, 0, -1, 0])
        self.assertEqual(nulls[0]["normal[0]", "a.center[0]"], ("the nearest features change here, and the derivatives from below and above differ", [0, -1]))
        self.assertEqual(nulls[0]["value", "a.radius"], ("the number is at the edge of its domain, so it has one side", [None, -1]))
        self.assertEqual(told[1]["value"], [None, None, None, -1, None, None, None, -1])
        self.assertEqual(nulls[1]["value", "b.center[1]"], ("the cores meet, and the derivatives from below and above differ", [-1, 1]))
        self.assertEqual(nulls[1]["normal[0]", "b.radius"], ("the cores meet, so the normal is by agreement", None))
        self.assertEqual(nulls[2]["point1[1]", "a.radius"], ("many pairs of points are nearest", None))
        self.assertEqual(nulls[2]["value", "b.start[1]"][1], [1, 0])  # it comes nearer, or the other end is now the nearest
        self.assertEqual(told[3], {"value": None, "normal": None, "point1": None, "point2": None, "undefined": "not told of a pair without a distance"})
        for one, all_nulls in zip(told[:3], nulls):  # every null says why
            rows = [one["value"], *one["normal"], *one["point1"], *one["point2"]]
            self.assertEqual(sum(x is None for row in rows for x in row), len(all_nulls))
        words = self.holds("explain", "--gradient", stdin=text([corner, CUBES]))
        self.assertIn("(0|-1, 0, 0)", words)
        self.assertIn("derivatives: not told of a pair without a distance", words)

    def test_decimals_of_binary32_numbers_are_taken_as_these(self):
        far = {**SPHERES, "scalar": "binary32", "alarm": 14.831459}
        meant = {**far, "alarm": struct.unpack("f", struct.pack("f", 14.831459))[0]}
        done = run("explain", "--json", stdin=text([far]))
        self.assertEqual((done.returncode, done.stdout), (0, self.holds("explain", "--json", stdin=text([meant]))), done.stderr)
        self.assertIn("1 number of the questions is written", done.stderr)
        path = self.folder / "decimals.jsonl"
        done = run("annotate", "-", "-o", path, "--family", "mine", stdin=text([far, {**far, "contact": 0.3}]))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("3 numbers of the questions are written", done.stderr)
        self.assertEqual(json.loads(path.read_text().splitlines()[1])["alarm"], meant["alarm"])
        self.holds("certify", path)
        # The shortest decimals that read back as the same binary32, and nine digits; of one that was computed in more digits none is taken.
        header, *answers = answers_to(committed("sphere_sphere/generic.f32.jsonl"))
        each = lambda by, x: list(map(by, x)) if isinstance(x, list) else by(x)
        results = lambda name, written: self.file(name, [header, *({**answer, "contact": answer["contact"] and {
            key: each(written, x) for key, x in answer["contact"].items()}} for answer in answers)])
        nearest = lambda x: struct.unpack("f", struct.pack("f", x))[0]
        shortest = lambda x: next(y for y in (float(f"{x:.{digits}g}") for digits in range(1, 10)) if nearest(y) == x)
        for name, written in (("shortest.jsonl", shortest), ("nine.jsonl", lambda x: float(f"{x:.9g}"))):
            done = run("certify", GOLDEN / "sphere_sphere/generic.f32.jsonl", "--results", results(name, written), "--level", "correctly-rounded")
            self.assertEqual(done.returncode, 0, done.stdout[-400:])
            self.assertRegex(done.stderr, r"^\d{3} numbers of the answers are written with fewer digits")
        beside = lambda x: x * (1 + 2**-30)
        done = run("certify", GOLDEN / "sphere_sphere/generic.f32.jsonl", "--results", results("beside.jsonl", beside), "--level", "correctly-rounded")
        self.assertEqual((done.returncode, done.stderr), (1, ""))

    def test_the_worst_cases_of_certify_can_be_explained(self):
        out = self.refuted("certify", GOLDEN / "sphere_sphere", GOLDEN / "sphere_capsule", "--family", "upstream,alarm_edge", "--engine", "plain-double")
        out = out[out.index("The worst cases"):]
        worst = re.findall(r'(?m)^ +(\{"id".*)$', out)
        decisions = out.count("# missed hit") + out.count("# false hit")
        self.assertEqual((out.count("# missed hit"), out.count("# false hit")), (2, 2))
        self.assertGreater(len(worst), decisions)
        explained = self.holds("explain", stdin=text(worst))
        for one in worst:
            self.assertIn(json.loads(one)["id"], explained)
        self.assertEqual(explained.count("WRONG"), decisions)

    def test_the_lines_of_a_dataset_can_be_explained(self):
        for pair in ("sphere_sphere", "cube_cube"):
            lines = committed(f"{pair}/generic.jsonl", 0, 5)[1:]
            out = map(json.loads, self.holds("explain", "--json", stdin=text(lines)).splitlines())
            self.assertEqual(list(map(without_distance, out)), [{key: case[key] for key in ("id", "expect", "exact")} for case in lines])

    def test_a_failure_of_a_report_is_explained_by_its_id(self):
        report = self.folder / "report.json"
        folders = [GOLDEN / pair for pair in ("sphere_sphere", "capsule_plane")]
        self.refuted("certify", *folders, "--engine", "plain-double", "--family", "touching,invalid", "--json", report)
        failures = json.loads(report.read_text())["failures"]
        cases = {(header["pair"], header["scalar"], case["id"]): case for folder in folders for path in folder.glob("*.jsonl")
                 for header, *cases in [list(map(json.loads, path.read_text().splitlines()))] for case in cases}
        shown = {family: next(f for f in failures if f["family"] == family and f["scalar"] == "binary64") for family in ("touching", "invalid")}
        for f in failures:
            case = cases[f["pair"], f["scalar"], f["id"]]
            self.assertEqual({key: f[key] for key in ("a", "b", "alarm", "contact")}, {key: case[key] for key in ("a", "b", "alarm", "contact")})
        f = shown["touching"]
        for digits in (f["id"], f["id"][:12]):
            done = run("explain", digits, "--in", report)
            self.assertEqual((done.returncode, done.stderr.splitlines()[0]), (0, f"found in {report}, failures of {f['pair']}/touching"))
            self.assertEqual(done.stdout.splitlines()[0], f"{f['pair']} {f['id']}")
        self.assertIn("WRONG", done.stdout)
        case = cases[f["pair"], "binary64", f["id"]]
        done = run("explain", f["id"], "--json", "--in", report)
        self.assertEqual(without_distance(json.loads(done.stdout.splitlines()[0])), {key: case[key] for key in ("id", "expect", "exact")})
        done = run("explain", shown["invalid"]["id"], "--in", report)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"outside the domain: {cases[shown['invalid']['pair'], 'binary64', shown['invalid']['id']]['expect']['rejected']}: ", done.stdout)

    def test_a_question_of_a_golden_file_is_explained_by_its_id(self):
        case = committed("sphere_sphere/touching.jsonl", 4, 1)[1]
        here = GOLDEN / "sphere_sphere" / "touching.jsonl"
        for where in ((), ("--in", "golden"), ("--in", here), ("--in", here.parent)):
            with self.subTest(where):
                done = run("explain", "--json", case["id"][:16], *where)
                self.assertEqual((done.returncode, without_distance(json.loads(done.stdout))), (0, {key: case[key] for key in ("id", "expect", "exact")}))
                self.assertIn("sphere_sphere/touching.jsonl:6\n", done.stderr)
        if not where:
            self.assertIn(str(GOLDEN), done.stderr)

    def test_an_id_that_is_not_there_or_is_several_is_refused(self):
        dataset = GOLDEN / "sphere_sphere" / "upstream.jsonl"
        ids = sorted(case["id"] for case in committed("sphere_sphere/upstream.jsonl")[1:])
        alike = next([x, y] for x, y in zip(ids, ids[1:]) if x[:4] == y[:4])  # 891 hashes: some are
        report = self.folder / "report.json"
        self.refuted("certify", GOLDEN / "sphere_sphere" / "touching.jsonl", "--engine", "plain-double", "--json", report)
        self.refused(("explain", "0" * 24), GOLDEN, f"no file '{'0' * 24}', and no question whose id begins with {'0' * 24}")
        self.refused(("explain", "0" * 24, "--in", report), report, "no question whose id begins with")
        self.refused(("explain", "abcd", "--in", self.folder / "gone.json"), "gone.json", "no such file")
        self.refused(("explain", "abcd", "--in", self.file("q.json", line(SPHERES))), "q.json", "format")
        for wrong in ("abc", "ABCD", "0" * 25, "xyzt"):
            self.refused(("explain", wrong), wrong, "no such file")
            self.refused(("explain", wrong, "--in", dataset), wrong, "hexadecimal")
        self.refused(("explain", alike[0][:4], "--in", dataset), f"questions have ids that begin with {alike[0][:4]}: ", *alike)
        # A file of that name is a file; a report without questions, as older versions wrote it, says so.
        self.file("abcd", line(SPHERES) + "\n")
        self.assertIn(SPHERES_ID, self.holds("explain", "abcd", cwd=self.folder))
        old = json.loads(report.read_text())
        for f in old["failures"]:
            for key in ("a", "b", "alarm", "contact"):
                del f[key]
        older = self.file("older.json", json.dumps(old))
        self.refused(("explain", old["failures"][0]["id"], "--in", older), older, "without its question")
        self.assertIn("NO CHANGE", self.holds("compare", older, report))
        self.holds("certify", GOLDEN / "sphere_sphere" / "touching.jsonl", "--engine", "plain-double", "--baseline", older)

    def test_minus_zero_is_zero(self):
        minus = {**SPHERES, "a": {"center": [-0.0, 0, -0.0], "radius": 1.5}, "alarm": -0.0}
        out = self.holds("explain", "--json", stdin=text([SPHERES, minus]))
        self.assertEqual(*out.splitlines())

    def test_integers_from_two_to_the_53rd_are_the_nearest_double(self):
        ball = lambda x: {"center": [x, 0, 0], "radius": 1}
        big = lambda x: {"a": ball(x), "b": ball(0), "alarm": 0, "contact": 0}
        out = self.holds("explain", "--json", stdin=text(map(big, (2**53, 2**53 + 1, float(2**53)))))
        self.assertEqual(len(set(out.splitlines())), 1)
        self.assertEqual(json.loads(out.splitlines()[0])["exact"]["distance2"], "0x1p106")
        case = self.annotated(big(2**64)).read_text().splitlines()[1]
        self.assertIn('"center":[1.8446744073709552e+19,0,0]', case)

    def test_a_bad_question_is_refused_with_its_line(self):
        for bad, *words in (("{", "malformed JSON"), ("", "malformed JSON"), ({**SPHERES, "alarm": "NaN"}, "alarm: ", "NaN"),
                            ("1e400", "1e400"), ('{"a":{"vertices":[[1],[{"x":0},[2,3,1e309]]]},"b":1}', "-:2: a.vertices[1][1][2]: ", "1e309"),
                            ('{"alarm":1' + "0" * 400 + "}", "-:2: alarm: ", "got 100000"),
                            ({**SPHERES, "id": CUBES_ID}, "id: ", CUBES_ID, SPHERES_ID), ({"a": SPHERES["a"]}, "b: ", "missing"),
                            ({**SPHERES, "pair": "cone_cone"}, "pair: ", "cone_cone"), ({**SPHERES, "pair": "cube_cube"}, "a.center: "),
                            ({**SPHERES, "scalar": "binary32", "alarm": 0.10000000000000002}, "alarm: ", "binary32", "0.10000000000000002")):
            with self.subTest(bad):
                self.refused(("explain", "-"), "-:2: ", *words, stdin=text([SPHERES, bad]))
        self.refused(("explain",), "no question", stdin="")


class Properties(Case):
    def violated(self, *args):
        done = run("properties", *args)
        self.assertEqual((done.returncode, done.stderr), (1, ""), done.stdout[-800:])
        return done.stdout

    def test_production_and_the_component_obey_every_law_bit_for_bit(self):
        for engine in ("production", "component"):
            out = self.holds("properties", "--engine", engine, "--level", "correctly-rounded", "--cases", 8, "--seed", 3)
            self.assertIn("every law asked holds", out)

    def test_what_production_serves_over_the_protocol_obeys_them_too(self):
        self.holds("properties", "--engine-command", f"'{TOOL}' serve", "--cases", 4, "--seed", 3)

    def test_the_same_seed_says_the_same_and_a_law_alone_repeats_what_it_did_among_all(self):
        args = ("--engine-command", f"{sys.executable} {PLAIN}", "--cases", 40, "--seed", 42)
        every = self.violated(*args)
        self.assertEqual(every, self.violated(*args))
        alone = self.violated(*args, "--law", "decision")
        block = lambda out: out.split("decision VIOLATED\n")[1].split("\n\n")[0]
        self.assertEqual(block(every), block(alone))
        self.assertEqual(block(self.in_a_shell(alone).stdout), block(alone))

    def in_a_shell(self, out):
        """What the line `again` of a violation does, as a person pastes it."""
        again = next(one for one in out.splitlines() if one.strip().startswith("again")).split("again", 1)[1]
        path = self.folder / "path"
        if not path.exists():
            path.mkdir()
            (path / "contact-oracle").symlink_to(TOOL)  # and no other of that name
        return subprocess.run(again, shell=True, cwd=ROOT, capture_output=True, text=True, timeout=300,
                              env={**os.environ, "PATH": f"{path}:{os.environ['PATH']}"})

    def test_the_line_again_has_every_option_and_is_a_line_for_a_shell(self):
        engine = self.folder / "it's $HOME" / "a \"plain\" engine.py"
        engine.parent.mkdir()
        engine.write_bytes(PLAIN.read_bytes())
        given = {"--engine-command": shlex.join([sys.executable, str(engine)]), "--level": "correctly-rounded", "--start-limit": "31",
                 "--answer-limit": "17.5", "--jobs": "2"}
        args = [word for option in given.items() for word in option]
        # With another seed so few cases may find nothing.
        out = self.violated(*args, "--cases", 40, "--seed", 42, "--law", "decision,touching", "--junit", self.folder / "laws.xml")
        again = next(one for one in out.splitlines() if one.strip().startswith("again"))
        words = dict(word.split("=", 1) for word in shlex.split(again)[3:] if "=" in word)
        self.assertEqual(words, {**given, "--cases": "40", "--seed": "42"})
        done = self.in_a_shell(out)
        self.assertEqual((done.returncode, done.stderr), (1, ""))
        block = lambda out: out.split(" VIOLATED\n")[1].split("\n\n")[0]
        self.assertEqual(block(done.stdout), block(out))
        # Every option that help shows is repeated, stated anew, or one that says where this run writes or what it lists.
        shown = set(re.findall(r"(?m)^  (--[a-z-]+)", self.holds("properties", "--help")))
        self.assertEqual(shown - set(words), {"--engine", "--engine-library", "--points", "--law", "--save", "--junit", "--json", "--list",
                                              "--tolerance", "--profile"})

    def only(self, pairs):
        """An engine that serves no other pairs than these, and answers as production does."""
        engine = self.file("only.py", ONLY)
        return shlex.join([sys.executable, str(engine), str(TOOL), *pairs])

    def test_a_law_that_the_declared_pairs_leave_nothing_to_ask_is_counted_as_skipped(self):
        xml, report = self.folder / "laws.xml", self.folder / "laws.json"
        out = self.holds("properties", "--engine-command", self.only(["capsule_plane"]), "--cases", 5, "--seed", 1, "--junit", xml, "--json", report)
        why = "the law asks about a sphere_plane too, which the engine does not serve"
        self.assertRegex(out, rf"(?m)^without_length +skipped: {why}$")
        read = json.loads(report.read_text())
        skipped = [law["law"] for law in read["laws"] if law["verdict"] == "skipped"]
        self.assertEqual((read["asked"], read["not_asked"]), (len(read["laws"]) - len(skipped), len(skipped)))
        self.assertIn(f"{read['asked']} of {len(read['laws'])} laws were asked; the others were skipped\n", out)
        suite = ElementTree.parse(xml).getroot().find("testsuite")
        self.assertEqual([case.get("name") for case in suite if case.find("skipped") is not None], skipped)
        self.assertEqual((suite.get("failures"), suite.get("skipped")), ("0", str(len(skipped))))

    def test_no_law_asked_is_no_pass(self):
        for pairs, *law in ([], ), (["sphere_capsule"], "--law", "without_length"):
            done = run("properties", "--engine-command", self.only(pairs), "--cases", 5, "--seed", 1, *law)
            self.assertEqual(done.returncode, 3, done.stdout)
            self.assertIn("nothing can be said: no law was asked", done.stdout)

    def test_a_tolerance_that_is_given_or_declared_is_what_laws_hold_an_engine_to(self):
        args = ("properties", "--cases", 100, "--seed", 42, "--law", "decision,bounds")
        plain = ("--engine-command", f"{sys.executable} {PLAIN}")
        tolerance = "length=1e-6,relative=1e-9,angle=1e-6,min=1e-3,max=1e3"
        self.assertIn("violates 1 of 2 laws", self.violated(*args[1:], *plain))
        out = self.holds(*args, *plain, "--tolerance", tolerance)
        self.assertIn(", within length 1e-06, relative 1e-09, angle 1e-06, for numbers from 0.001 to 1000\n", out)
        self.holds(*args, *plain, "--profile", "game")
        declared = {"length": 1e-6, "relative": 1e-9, "angle": 1e-6, "scale": {"min": 1e-3, "max": 1e3}}
        engine = self.file("declares.py", PLAIN.read_text().replace('"op": "hello"', f'"op": "hello", "tolerance": {declared!r}', 1))
        command = ("--engine-command", f"{sys.executable} {engine}")
        self.assertIn(", within length 1e-06", self.holds(*args, *command))
        self.assertNotIn(", within", self.violated(*args[1:], *command, "--level", "bounded"))
        self.refused((*args, "--level", "bounded", "--tolerance", tolerance), "--tolerance", one_line=False)

    def test_an_engine_that_falls_silent_has_its_report(self):
        engine = self.file("silent.py", SILENT)
        xml, report = self.folder / "laws.xml", self.folder / "laws.json"
        # A seed is drawn, and no question that it makes is answered.
        done = run("properties", "--engine-command", f"{sys.executable} {engine}", "--cases", 20, "--junit", xml, "--json", report)
        self.assertIn(f" --seed={re.search('seed ([0-9]+)', done.stdout).group(1)} ", done.stdout)
        self.assertEqual((done.returncode, done.stderr), (3, ""))  # to no question of the run did it claim anything
        self.assertRegex(done.stdout, r"(?m)^    said      \{\}$")
        questions = [q for law in json.loads(report.read_text())["laws"] for q in law.get("questions", ())]
        self.assertIn({}, [q["said"] for q in questions])
        self.assertTrue(ElementTree.parse(xml).getroot().findall("testsuite/testcase/failure"))

    def test_a_counterexample_is_a_line_for_explain(self):
        out = self.violated("--engine", "plain-double", "--seed", 1, "--law", "decision")
        question = next(one for one in out.splitlines() if one.strip().startswith("question 1  ")).strip().removeprefix("question 1  ")
        self.assertIn("plain double arithmetic says", self.holds("explain", stdin=question + "\n"))
        self.assertIn("WRONG", self.holds("explain", stdin=question + "\n"))

    def test_reports_have_one_entry_a_law(self):
        xml, report = self.folder / "laws.xml", self.folder / "laws.json"
        self.violated("--engine-command", f"{sys.executable} {PLAIN}", "--seed", 42, "--cases", 40, "--junit", xml, "--json", report)
        laws = [one.split()[0] for one in self.holds("properties", "--list").splitlines()]
        suite = ElementTree.parse(xml).getroot().find("testsuite")
        self.assertEqual([case.get("name") for case in suite], laws)
        self.assertEqual(int(suite.get("failures")), len(suite.findall("testcase/failure")))
        read = json.loads(report.read_text())
        self.assertEqual([law["law"] for law in read["laws"]], laws)
        self.assertFalse(read["holds"])
        violated = [law for law in read["laws"] if law["verdict"] == "violated"]
        self.assertEqual(len(violated), int(suite.get("failures")))
        for law in violated:
            self.assertTrue(law["questions"] and law["why"] and law["again"])

    def test_saved_counterexamples_are_golden_files_that_grow_by_what_is_new(self):
        path = self.folder / "saved.jsonl"
        args = ("--engine", "plain-double", "--seed", 1, "--cases", 300, "--law", "decision,touching", "--save", path)
        self.violated(*args)
        first = path.read_text()
        header = json.loads(first.splitlines()[0])
        self.assertEqual(header["family"], "regression")
        self.assertEqual(header["count"], len(first.splitlines()) - 1)
        self.holds("lint", path)
        self.violated(*args)
        self.assertEqual(path.read_text(), first)
        self.violated(*args[:3], 2, *args[4:])
        self.holds("lint", path)
        self.assertTrue(set(first.splitlines()[1:]) <= set(path.read_text().splitlines()[1:]))
        done = run("certify", path, "--engine", "plain-double")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.holds("certify", path, "--level", "correctly-rounded")
        before = GOLDEN / "sphere_sphere" / "generic.jsonl"
        self.refused(("properties", "--save", before), "family")

    def test_a_file_beside_saved_counterexamples_that_is_none_of_theirs_is_refused_before_the_work(self):
        beside = self.folder / "saved.cube_cube.jsonl"
        header, case = committed("cube_cube/flat.jsonl", 0, 1)
        header["family"] = "regression"
        for lines, *words in (([header], f"{beside}:1: count: "), ([{**header, "family": "other"}, case], f"{beside}:1: family: ", "other"),
                              (committed("sphere_sphere/touching.jsonl", 0, 0)[:1], f"{beside}:1: family: "),
                              ([{**header, "scalar": "binary32", "count": 0}], f"{beside}:1: scalar: ", "binary32"),
                              ([{**header, "pair": "capsule_cube", "count": 0}], f"{beside}:1: pair: ", "capsule_cube")):
            with self.subTest(words):
                beside.write_text(text(lines))
                done = self.refused(("properties", "--engine", "production", "--law", "touching", "--save", self.folder / "saved.jsonl"), *words)
                self.assertEqual(done.stdout, "")

    def test_wrong_usage_is_refused_and_a_harness_that_answers_nothing_is_invalid(self):
        self.refused(("properties", "--law", "nonsense"), "nonsense")
        self.refused(("properties", "--level", "faithful"), "faithful", one_line=False)
        self.refused(("properties", "--cases", 0), "whole number", one_line=False)
        self.refused(("properties", "--engine", "nobody"), "nobody")
        self.refused(("properties", "--results", RECORDED / "sphere_sphere.jsonl"), "--results", one_line=False)
        self.refused(("properties", "--json", self.folder / "no" / "such" / "file"), "no")
        self.assertEqual(run("properties", "--engine-command", "false").returncode, 3)

    def test_bad_input_is_asked_about_only_when_named(self):
        self.assertIn("refuses_bad_input          skipped", self.holds("properties", "--cases", 5, "--seed", 1))
        self.holds("properties", "--law", "refuses_bad_input", "--cases", 200, "--seed", 1)
        self.assertIn("refuses_bad_input", self.violated("--engine", "plain-double", "--law", "refuses_bad_input", "--seed", 1))

    def test_an_interruption_ends_it_and_leaves_no_file(self):
        path = self.folder / "laws.json"
        self.assertIn("interrupted", self.interrupted(("properties", "--cases", 1000000, "--json", path))[1])
        self.assertEqual(list(self.folder.iterdir()), [])


class Detect(Case):
    SCENES = ROOT / "docs" / "examples" / "scenes"
    DROPS, BEADS = SCENES / "drops.jsonl", SCENES / "beads.jsonl"
    HEADER = {"format": "contact-oracle/scene", "version": 1}
    # drops.jsonl, alarm 0.5, contact 0.25. By hand, D the vector between the centres:
    #   drops[0] (0,0,0) r 1      balls[0] (1,2,2) r 1.5    D (1,2,2), length 3: the radii and alarm, exactly. A contact,
    #                             surfaces 0.5 apart; less 0.25: value 0.25. Normal (1,2,2)/3, points 1 normal from the
    #                             one centre, 1.5 normal back from the other: (1,2,2)/3 and (1,2,2)/2.
    #   drops[0]                  balls[2] (0,0,-1) r 0.5   length 1, radii 1.5: 0.5 deep, value -0.75. Normal (0,0,-1),
    #                             points (0,0,-1) and (0,0,-1) + (0,0,0.5).
    #   drops[1] (4,0,0) r 0.5    balls[1] (6,0,0) r 1.75   length 2, radii 2.25: 0.25 deep, value -0.5. Normal (1,0,0),
    #                             points (4.5,0,0) and (4.25,0,0).
    #   drops[1] balls[0]         D (-3,2,2), length sqrt 17 > 4.1, radii and alarm 2.5: none
    #   drops[2] (10,0,0) r 1     balls[1]: length 4, radii and alarm 3.25: none. All others are farther still.
    # Three of each, so the id is the index in the second model.
    CONTACTS = [
        {"first": {"model": "drops", "index": 0}, "second": {"model": "balls", "index": 0}, "id": 0,
         "normal": [1 / 3, 2 / 3, 2 / 3], "point1": [1 / 3, 2 / 3, 2 / 3], "point2": [0.5, 1, 1], "value": 0.25},
        {"first": {"model": "drops", "index": 0}, "second": {"model": "balls", "index": 2}, "id": 2,
         "normal": [0, 0, -1], "point1": [0, 0, -1], "point2": [0, 0, -0.5], "value": -0.75},
        {"first": {"model": "drops", "index": 1}, "second": {"model": "balls", "index": 1}, "id": 1,
         "normal": [1, 0, 0], "point1": [4.5, 0, 0], "point2": [4.25, 0, 0], "value": -0.5},
    ]

    def ball_model(self, name="s", centers=((0, 0, 0),), radii=(1,), **more):
        return {"model": "SphereCollisionModel", "name": name, "centers": centers, "radii": radii, **more}

    def contacts(self, *args, stdin=""):
        """The header and the contacts that --json prints; whatever is said on standard error is no matter."""
        done = run("detect", *args, "--json", stdin=stdin)
        self.assertEqual(done.returncode, 0, done.stderr)
        header, *lines = map(json.loads, done.stdout.splitlines())
        return header, lines

    def test_the_example_scene_has_the_contacts_worked_out_by_hand(self):
        header, lines = self.contacts(self.DROPS)
        self.assertEqual(header, {"format": "contact-oracle/contacts", "version": 1, "alarm": 0.5, "contact": 0.25,
                                  "points": "nearest_surface", "no_intersector": [["drops", "walls"], ["balls", "walls"]]})
        self.assertEqual(lines, self.CONTACTS)

    # bars.jsonl: alarm 0.5, contact 0.25. Bars along x at y = 0 (radius 1) and y = 4 (0.5), a rod along z at (2,2.25), radius 1.
    #   bars[0] rods[0]   2.25 apart, radii 2: value 2.25 - 2 - 0.25
    #   bars[1] rods[0]   1.75 apart, radii 1.5: the same, on the other side
    #   bars[0] drops[0]  (1,-3,0) r 1.75: 3 apart, radii 2.75
    #   bars[1] drops[1]  (7,4,0) r 2.25 beyond the end (4,4,0): 3 apart, radii 2.75
    #   drops[0] floor    the face y = -4 is 1 below, radius 1.75: with --solid-cubes 0.75 deep
    BARS = ROOT / "docs/examples/scenes/bars.jsonl"
    BAR_CONTACTS = [
        {"first": {"model": "bars", "index": 0}, "second": {"model": "rods", "index": 0}, "id": 0,
         "normal": [0, 1, 0], "point1": [2, 1, 0], "point2": [2, 1.25, 0], "value": 0},
        {"first": {"model": "bars", "index": 1}, "second": {"model": "rods", "index": 0}, "id": 1,
         "normal": [0, -1, 0], "point1": [2, 3.5, 0], "point2": [2, 3.25, 0], "value": 0},
        {"first": {"model": "bars", "index": 0}, "second": {"model": "drops", "index": 0}, "id": 0,
         "normal": [0, -1, 0], "point1": [1, -1, 0], "point2": [1, -1.25, 0], "value": 0},
        {"first": {"model": "bars", "index": 1}, "second": {"model": "drops", "index": 1}, "id": 1,
         "normal": [1, 0, 0], "point1": [4.5, 4, 0], "point2": [4.75, 4, 0], "value": 0},
    ]

    def test_capsules_meet_capsules_and_spheres_and_solid_cubes_are_asked_for(self):
        header, lines = self.contacts(self.BARS)
        self.assertEqual(lines, self.BAR_CONTACTS)
        self.assertEqual(header["no_intersector"], [["bars", "floor"], ["rods", "floor"], ["drops", "floor"]])
        header, lines = self.contacts(self.BARS, "--solid-cubes")
        deep = {"first": {"model": "drops", "index": 0}, "second": {"model": "floor", "index": 0}, "id": 0,
                "normal": [0, -1, 0], "point1": [1, -4.75, 0], "point2": [1, -4, 0], "value": -1}
        self.assertEqual((lines, header["no_intersector"]), ([*self.BAR_CONTACTS, deep], [["bars", "floor"], ["rods", "floor"]]))
        # Under `center` a capsule's point is the one of its axis.
        self.assertEqual([(c["point1"], c["point2"]) for c in self.contacts(self.BARS, "--points", "center")[1]][0],
                         ([2, 0, 0], [2, 2.25, 0]))

    def test_rays_and_triangles_meet_spheres(self):
        scene = self.file("s.jsonl", [self.HEADER, self.ball_model("balls", [[1.5, 0, 0], [2, -3, 4]], [0.75, 5]),
                                      {"model": "RayCollisionModel", "name": "beam", "origins": [[0, 0, 0]], "directions": [[1, 0, 0]],
                                       "lengths": [1]},
                                      {"model": "TriangleCollisionModel", "name": "skin", "p1": [[0, 0, 0]], "p2": [[4, 0, 0]],
                                       "p3": [[0, 4, 0]]}])
        header, lines = self.contacts(scene)
        self.assertNotIn("no_intersector", header)
        self.assertIn({"first": {"model": "balls", "index": 0}, "second": {"model": "beam", "index": 0}, "id": 0,
                       "normal": [-1, 0, 0], "point1": [0.75, 0, 0], "point2": [1, 0, 0], "value": -0.25}, lines)
        self.assertIn({"first": {"model": "balls", "index": 1}, "second": {"model": "skin", "index": 0}, "id": 1,
                       "normal": [0, 0.6, -0.8], "point1": [2, 0, 0], "point2": [2, 0, 0], "value": 0}, lines)

    def test_lines_are_canonical(self):
        out = run("detect", self.DROPS, "--json").stdout.splitlines()
        self.assertEqual(out[2], '{"first":{"model":"drops","index":0},"second":{"model":"balls","index":2},"id":2,'
                                 '"normal":[0,0,-1],"point1":[0,0,-1],"point2":[0,0,-0.5],"value":-0.75}')
        self.assertEqual(out[0], line(json.loads(out[0])))

    def test_the_table_counts_contacts_and_overlaps_and_names_the_deepest(self):
        done = run("detect", self.DROPS)
        rows = [row.split() for row in done.stdout.splitlines()[3:]]
        # The first of the three contacts does not overlap: its surfaces are 0.5 apart.
        self.assertEqual(rows, [["drops", "balls", "3", "2", "drops[0]", "balls[2]", "value", "-0.75"],
                                ["drops", "walls", "no", "intersector"], ["balls", "walls", "no", "intersector"]])
        self.assertEqual(done.stdout.splitlines()[0], "alarm 0.5, contact 0.25, points nearest_surface")
        self.assertEqual(done.returncode, 0)

    def test_surfaces_that_touch_or_lie_a_contact_distance_apart_do_not_overlap(self):
        scene = self.file("s.jsonl", [self.HEADER, self.ball_model("a"), self.ball_model("b", [[2, 0, 0]])])
        row = lambda *args: self.holds("detect", scene, *args).splitlines()[3].split()
        self.assertEqual(row(), ["a", "b", "1", "0", "a[0]", "b[0]", "value", "0"])
        self.assertEqual(row("--contact", "0.5"), ["a", "b", "1", "0", "a[0]", "b[0]", "value", "-0.5"])

    def test_a_pair_without_an_intersector_is_named_once_and_is_not_a_pair_without_contacts(self):
        walls = {"model": "CubeCollisionModel", "name": "more walls", "min": [[50, 50, 50]], "max": [[51, 51, 51]]}
        scene = self.file("s.jsonl", [*self.DROPS.read_text().splitlines(), walls])
        done = run("detect", scene)
        self.assertEqual(done.returncode, 0)
        self.assertEqual([said.split(";")[0] for said in done.stderr.splitlines()],
                         ["contact: no intersector for SphereCollisionModel-CubeCollisionModel",
                          "contact: no intersector for RigidSphereModel-CubeCollisionModel"])
        rows = {tuple(row[:24].replace("more walls", "more_walls").split()[:2]): row for row in done.stdout.splitlines()[3:]}
        self.assertEqual(rows["walls", "more_walls"].split()[-2:], ["0", "0"])
        self.assertEqual(sum("no intersector" in row for row in rows.values()), 4)

    def test_self_detection_finds_each_pair_of_elements_once(self):
        # beads.jsonl: radii 0.5; (0,0,0), (1,0,0), (2,0,0), (2,1,0) touch one after the other, (2,1.75,0) is 0.25 deep
        # in the last of them; all others are at least sqrt 2 apart, or 1.75.
        _, lines = self.contacts(self.BEADS, "--self")
        pairs = [(c["first"]["index"], c["second"]["index"], c["value"]) for c in lines]
        self.assertEqual(pairs, [(0, 1, 0), (1, 2, 0), (2, 3, 0), (3, 4, -0.25)])
        self.assertEqual(lines[3]["normal"], [0, 1, 0])
        self.assertEqual((lines[3]["point1"], lines[3]["point2"]), ([2, 1.5, 0], [2, 1.25, 0]))
        self.assertEqual(self.holds("detect", self.BEADS, "--self").splitlines()[3].split(),
                         ["beads", "beads", "4", "1", "beads[3]", "beads[4]", "value", "-0.25"])
        self.assertIn("no pair: --self", self.holds("detect", self.BEADS))
        self.assertEqual(self.contacts(self.BEADS)[1], [])
        # drops.jsonl holds no contact inside drops or balls; cubes overlap without writing one. Pairs in file order.
        header, lines = self.contacts(self.DROPS, "--self")
        self.assertEqual((len(header["no_intersector"]), lines), (2, self.CONTACTS))
        table = [row.split()[:2] for row in run("detect", self.DROPS, "--self").stdout.splitlines()[3:]]
        self.assertEqual(table, [[a, b] for i, a in enumerate(("drops", "balls", "walls")) for b in ("drops", "balls", "walls")[i:]])

    def test_the_command_line_overrides_the_distances_of_the_scene(self):
        header, lines = self.contacts(self.DROPS, "--alarm", "0.25", "--contact", "0")
        self.assertEqual((header["alarm"], header["contact"]), (0.25, 0))
        self.assertEqual([c["value"] for c in lines], [-0.5, -0.25])
        header, lines = self.contacts(self.DROPS, "--alarm", "1.25")  # drops[2] and balls[1]: 4 apart, radii 2.75
        self.assertEqual((header["alarm"], header["contact"], len(lines)), (1.25, 0.25, 4))
        self.assertEqual((lines[3]["first"]["index"], lines[3]["second"]["index"], lines[3]["value"]), (2, 1, 1))

    def test_points_follow_the_convention_asked_for(self):
        points = lambda name: [(c["point1"], c["point2"]) for c in self.contacts(self.DROPS, "--points", name)[1]]
        self.assertEqual(points("nearest_surface"), [(c["point1"], c["point2"]) for c in self.CONTACTS])
        # center: a deformable sphere's is its centre. published: the far side of both, c1 - r1 n and c2 + r2 n.
        self.assertEqual(points("center")[2], ([4, 0, 0], [4.25, 0, 0]))
        self.assertEqual(points("published")[2], ([3.5, 0, 0], [7.75, 0, 0]))
        self.assertEqual(self.contacts(self.DROPS, "--points", "center")[0]["points"], "center")

    def test_models_given_the_other_way_round_give_the_contacts_mirrored(self):
        header, drops, balls, walls = self.DROPS.read_text().splitlines()
        _, lines = self.contacts("-", stdin=text([header, balls, drops]))
        minus = lambda v: [-x if x else 0 for x in v]
        mirrored = [{"first": c["second"], "second": c["first"], "id": c["first"]["index"], "normal": minus(c["normal"]),
                     "point1": c["point2"], "point2": c["point1"], "value": c["value"]} for c in self.CONTACTS]
        self.assertEqual(lines, sorted(mirrored, key=lambda c: (c["first"]["index"], c["second"]["index"])))

    def test_several_files_are_one_scene_and_standard_input_is_one_of_them(self):
        header, drops, balls, walls = self.DROPS.read_text().splitlines()
        other = self.file("balls.jsonl", [self.HEADER, balls])
        self.assertEqual(self.contacts("-", other, stdin=text([header, drops]))[1], self.CONTACTS)

    def test_models_without_an_element_are_models(self):
        empty = [self.ball_model("a", [], []), self.ball_model("b"),
                 {"model": "RigidSphereModel", "name": "c", "positions": [], "orientations": [], "radii": []},
                 {"model": "CubeCollisionModel", "name": "d", "min": [], "max": []},
                 {"model": "CubeCollisionModel", "name": "e", "min": [[0, 0, 0]], "max": [[1, 1, 1]]}]
        scene = self.file("s.jsonl", [self.HEADER, *empty])
        header, lines = self.contacts(scene, "--self")
        self.assertEqual((lines, len(header["no_intersector"])), ([], 6))

    def test_a_file_of_contacts_is_written_whole_beside_the_table(self):
        target = self.file("out.jsonl", "old\n")
        done = run("detect", self.DROPS, "-o", target)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout, run("detect", self.DROPS).stdout)
        self.assertEqual(target.read_text(), run("detect", self.DROPS, "--json").stdout)
        self.assertEqual(list(self.folder.iterdir()), [target])
        self.refused(("detect", self.file("bad.jsonl", [self.HEADER]), "-o", target), "bad.jsonl")
        self.assertIn("drops", target.read_text())

    def test_the_contacts_are_the_same_bytes_on_any_number_of_threads(self):
        # 3000 balls on a folded line, so that each meets some others far from it in the file.
        centers = [[i * 7 % 60 / 8, i * 11 % 50 / 8, i * 13 % 40 / 8] for i in range(3000)]
        scene = self.file("s.jsonl", [self.HEADER, self.ball_model("a", centers, [0.25] * 3000),
                                      self.ball_model("b", [[x + 0.125, y, z] for x, y, z in centers], [0.125] * 3000)])
        outputs = {run("detect", scene, "--self", "--json", "--jobs", jobs).stdout for jobs in (1, 2, 7)}
        self.assertEqual(len(outputs), 1)
        self.assertGreater(len(outputs.pop().splitlines()), 3000)

    def test_an_output_that_cannot_be_written_is_refused_and_a_full_disk_leaves_no_file(self):
        self.refused(("detect", self.BEADS, "-o", self.folder / "gone" / "x.jsonl"), "gone/x.jsonl", "cannot write")
        self.refused(("detect", self.BEADS, "-o", self.folder), self.folder, "directory")
        many = self.file("s.jsonl", [self.HEADER, self.ball_model("a", [[0, 0, 0]] * 20, [1] * 20)])
        self.refused(("detect", many, "--self", "-o", self.folder / "x.jsonl"), "x.jsonl", "cannot write",
                     preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000)), restore_signals=False)

    def test_an_interrupted_detection_ends_and_leaves_what_was_there(self):
        # Every one of 5000 balls in one place touches every other: far more work than the test waits for.
        scene = self.file("s.jsonl", [self.HEADER, self.ball_model("a", [[i / 5000, 0, 0] for i in range(5000)], [1] * 5000)])
        target = self.file("x.jsonl", "old\n")

        def working(_):
            self.files_are(3)
            time.sleep(0.3)
        out, err = self.interrupted(("detect", scene, "--self", "-o", target), working)
        self.assertEqual(out, "")
        self.assertIn("interrupted", err)
        self.assertEqual((sorted(self.folder.iterdir()), target.read_text()), ([scene, target], "old\n"))

    def test_what_is_printed_into_a_pipe_has_no_control_characters(self):
        for args in ((self.DROPS,), (self.DROPS, "--json"), (self.BEADS, "--self"), ("--help",)):
            done = run("detect", *args)
            self.assertEqual((done.returncode, bool(done.stdout)), (0, True))
            self.assertNotRegex(done.stdout + done.stderr, r"[\x00-\x09\x0b-\x1f\x7f]")

    def test_a_scene_that_is_wrong_is_refused_where_it_is_wrong(self):
        path, good = self.folder / "s.jsonl", self.ball_model()
        rigid = {"model": "RigidSphereModel", "name": "r", "positions": [[0, 0, 0]], "orientations": [[0, 0, 0, 1]], "radii": [1]}
        cubes = {"model": "CubeCollisionModel", "name": "c", "min": [[0, 0, 0]], "max": [[1, 1, 1]]}
        without = lambda model, key: {k: v for k, v in model.items() if k != key}
        table = {
            "malformed": ([self.HEADER, "{nonsense}"], f"{path}:2: ", "malformed JSON"),
            "cut": (text([self.HEADER, good])[:-9], f"{path}:2: ", "malformed JSON"),
            "blank line": ([self.HEADER, "", good], f"{path}:2: ", "malformed JSON"),
            "no object": ([self.HEADER, "[1,2]"], f"{path}:2: ", "expected a JSON object", "[1,2]"),
            "key twice": ([self.HEADER, line(good)[:-1] + ',"radii":[2]}'], f"{path}:2: radii: ", "twice"),
            "empty": ("", f"{path}: ", "empty"),
            "no header": ([good], f"{path}:1: format: ", "missing"),
            "wrong format": ([{**self.HEADER, "format": "contact-oracle/dataset"}, good], f"{path}:1: format: ",
                             "contact-oracle/dataset", "contact-oracle/scene"),
            "wrong version": ([{**self.HEADER, "version": 2}, good], f"{path}:1: version: ", "2"),
            "no version": ([without(self.HEADER, "version"), good], f"{path}:1: version: ", "missing"),
            "unknown header key": ([{**self.HEADER, "gravity": 9.81}, good], f"{path}:1: gravity: ", "9.81"),
            "negative alarm": ([{**self.HEADER, "alarm": -1}, good], f"{path}:1: alarm: ", "must not be negative", "-1"),
            "alarm NaN": ([{**self.HEADER, "alarm": "NaN"}, good], f"{path}:1: alarm: ", "must be finite", "NaN"),
            "contact infinite": ([{**self.HEADER, "contact": "Infinity"}, good], f"{path}:1: contact: ", "Infinity"),
            "alarm a word": ([{**self.HEADER, "alarm": "wide"}, good], f"{path}:1: alarm: ", '"wide"'),
            "no models": ([self.HEADER], f"{path}: ", "no model"),
            "no type": ([self.HEADER, without(good, "model")], f"{path}:2: model: ", "missing"),
            "unknown type": ([self.HEADER, {**good, "model": "TriangleModel"}], f"{path}:2: model: ", "TriangleModel",
                             "SphereCollisionModel, RigidSphereModel, CubeCollisionModel, CapsuleCollisionModel, "
                             "TriangleCollisionModel, RayCollisionModel, PlaneCollisionModel, LineCollisionModel"),
            "type no text": ([self.HEADER, {**good, "model": 7}], f"{path}:2: model: ", "7"),
            "no name": ([self.HEADER, without(good, "name")], f"{path}:2: name: ", "missing"),
            "empty name": ([self.HEADER, self.ball_model("")], f"{path}:2: name: ", '""'),
            "name no text": ([self.HEADER, self.ball_model(7)], f"{path}:2: name: ", "7"),
            "name of control characters": ([self.HEADER, self.ball_model("\x1b[31m")], f"{path}:2: name: ", "\\u001b[31m"),
            "a name twice": ([self.HEADER, good, rigid, good], f"{path}:4: name: ", f"{path}:2", '"s"'),
            "unknown column": ([self.HEADER, {**good, "mass": [1]}], f"{path}:2: mass: ", "[1]", "centers, radii"),
            "column of another type": ([self.HEADER, {**cubes, "radii": [1]}], f"{path}:2: radii: ", "min, max"),
            "missing column": ([self.HEADER, without(good, "radii")], f"{path}:2: radii: ", "missing"),
            "missing orientations": ([self.HEADER, without(rigid, "orientations")], f"{path}:2: orientations: ", "missing"),
            "column no array": ([self.HEADER, self.ball_model(radii=1)], f"{path}:2: radii: ", "got 1"),
            "ragged row": ([self.HEADER, self.ball_model(centers=[[0, 0, 0], [1, 2]], radii=[1, 1])],
                           f"{path}:2: centers[1]: ", "expected 3 numbers", "[1,2]"),
            "row too wide": ([self.HEADER, self.ball_model(centers=[[0, 0, 0, 1]])], f"{path}:2: centers[0]: ", "[0,0,0,1]"),
            "flat column": ([self.HEADER, self.ball_model(centers=[0, 0, 0])], f"{path}:2: centers[0]: ", "3 numbers"),
            "nested column": ([self.HEADER, self.ball_model(radii=[[1]])], f"{path}:2: radii[0]: ", "[1]"),
            "columns of two lengths": ([self.HEADER, self.ball_model(radii=[1, 2])], f"{path}:2: ", "radii", "centers", "2", "1"),
            "text for a number": ([self.HEADER, self.ball_model(centers=[[0, "x", 0]])], f"{path}:2: centers[0][1]: ", '"x"'),
            "NaN": ([self.HEADER, self.ball_model(centers=[[0, 0, "NaN"]])], f"{path}:2: centers[0][2]: ", "finite", '"NaN"'),
            "infinite radius": ([self.HEADER, self.ball_model(radii=["Infinity"])], f"{path}:2: radii[0]: ", '"Infinity"'),
            "null": ([self.HEADER, self.ball_model(radii=[None])], f"{path}:2: radii[0]: ", "null"),
            "number too large": ([self.HEADER, line(good).replace("[1]", "[1e999]")], f"{path}:2: ", "1e999"),
            "a capsule without a radius": ([self.HEADER, {"model": "CapsuleCollisionModel", "name": "c", "starts": [[0, 0, 0]],
                                                          "ends": [[1, 0, 0]]}], f"{path}:2: radii: ", "missing"),
            "a capsule's end": ([self.HEADER, {"model": "CapsuleCollisionModel", "name": "c", "starts": [[0, 0, 0]],
                                               "ends": [[0, 0, "Infinity"]], "radii": [1]}], f"{path}:2: ends[0][2]: ", "finite"),
            "a capsule's radius": ([self.HEADER, {"model": "CapsuleCollisionModel", "name": "c", "starts": [[0, 0, 0]],
                                                  "ends": [[0, 0, 1]], "radii": [-0.5]}], f"{path}:2: ",
                                   'CapsuleCollisionModel "c"', "radii[0] = -0.5", "must not be negative"),
            "a ray without a direction": ([self.HEADER, {"model": "RayCollisionModel", "name": "r", "origins": [[0, 0, 0]],
                                                         "directions": [[0, 0, 0]], "lengths": [1]}], f"{path}:2: ",
                                          'RayCollisionModel "r"', "directions[0] = 0", "must not be the zero vector"),
            "a triangle of two vertices": ([self.HEADER, {"model": "TriangleCollisionModel", "name": "t", "p1": [[0, 0, 0]],
                                                          "p2": [[1, 0, 0]]}], f"{path}:2: p3: ", "missing"),
            "negative radius": ([self.HEADER, self.ball_model("drops", [[0, 0, 0]] * 3, [1, 1, -2.5])], f"{path}:2: ",
                                'SphereCollisionModel "drops"', "radii[2] = -2.5", "must not be negative"),
            "no unit quaternion": ([self.HEADER, {**rigid, "orientations": [[0, 0, 0, 2]]}], f"{path}:2: ",
                                   "orientations[0]", "4", "unit quaternion"),
            "min above max": ([self.HEADER, {**cubes, "min": [[0, 3, 0]]}], f"{path}:2: ", "min[0][1] = 3", "max"),
        }
        for name, (lines, *words) in table.items():
            with self.subTest(name):
                self.file("s.jsonl", lines)
                self.refused(("detect", path, "-o", self.folder / "x.jsonl"), *words)
                self.refused(("detect", path, "--json"), *words)

    def test_two_scenes_that_contradict_each_other_are_refused(self):
        first = self.file("a.jsonl", [{**self.HEADER, "alarm": 0.5}, self.ball_model("a")])
        second = self.file("b.jsonl", [{**self.HEADER, "alarm": 0.25}, self.ball_model("b")])
        self.refused(("detect", first, second), f"{second}:1: alarm: ", "0.5", "0.25")
        same = self.file("c.jsonl", [self.HEADER, self.ball_model("a")])
        self.refused(("detect", first, same), f"{same}:2: name: ", f"{first}:2", '"a"')
        self.refused(("detect", first, self.folder / "gone.jsonl"), "gone.jsonl", "no such file")

    def test_options_that_are_wrong_are_refused_by_name_and_value(self):
        for args, *words in ((("--alarm", "-1"), "--alarm", "negative", "-1"), (("--alarm", "nan"), "--alarm", "nan"),
                             (("--contact", "inf"), "--contact", "inf"), (("--contact", "1e999"), "--contact", "1e999"),
                             (("--contact", "x"), "--contact", "'x'"), (("--contact", "1x"), "--contact", "'1x'"),
                             (("--points", "middle"), "--points", "middle", "nearest_surface,center,published"),
                             (("--points", "midpoint"), "--points", "midpoint"), (("--nonesuch",), "--nonesuch")):
            with self.subTest(args):
                self.refused(("detect", self.BEADS, *args), *words, one_line=False)
        self.refused(("detect",), "scenes", one_line=False)

    def test_a_plugin_that_is_none_is_refused_by_name(self):
        gone, words = self.folder / "gone.so", self.file("words.so", "no library\n")
        self.refused(("detect", self.BEADS, "--plugin", gone), gone, "cannot be loaded", "No such file")
        self.refused(("detect", "--plugin", words, self.BEADS), words, "cannot be loaded")  # one library an option
        table = subprocess.run(["ldd", TOOL], capture_output=True, text=True).stdout
        library = re.search(r"=> (/\S*libm\.so\S*)", table)
        if library:
            self.refused(("detect", self.BEADS, "--plugin", library[1]), library[1], "no plug-in", "contact_plugin_entry")

    @unittest.skipUnless(os.environ.get("CONTACT_PLUGINS"), "CONTACT_PLUGINS names no plug-ins")
    def test_plugins_bring_models_and_intersectors(self):
        capsule, cube_contact = os.environ["CONTACT_PLUGINS"].split(":")
        # A capsule along x, radius 0.5, and a ball of radius 1 above its middle, 1.25 away: 0.25 deep.
        bar = {"model": "CapsuleModel", "name": "bar", "p": [[-2, 0, 0]], "q": [[2, 0, 0]], "radii": [0.5]}
        scene = self.file("s.jsonl", [self.HEADER, bar, self.ball_model("ball", [[0, 1.25, 0]])])
        self.refused(("detect", scene), f"{scene}:2: model: ", "CapsuleModel")
        _, lines = self.contacts(scene, "--plugin", capsule, "--plugin", capsule)
        self.assertEqual(lines, [{"first": {"model": "bar", "index": 0}, "second": {"model": "ball", "index": 0}, "id": 0,
                                  "normal": [0, 1, 0], "point1": [0, 0.5, 0], "point2": [0, 0.25, 0], "value": -0.25}])
        self.refused(("detect", self.file("s.jsonl", [self.HEADER, {**bar, "radii": [-1]}]), "--plugin", capsule),
                     f"{scene}:2: ", 'CapsuleModel "bar"', "-1")
        # Two boxes, 2 long on every axis, that overlap by 0.25 on x alone: without the plug-in no contact is written.
        boxes = [{"model": "CubeCollisionModel", "name": name, "min": [[x, 0, 0]], "max": [[x + 2, 2, 2]]}
                 for name, x in (("left", 0), ("right", 1.75))]
        scene = self.file("boxes.jsonl", [self.HEADER, *boxes])
        self.assertEqual(self.contacts(scene)[1], [])
        header, lines = self.contacts(scene, "--plugin", cube_contact)
        self.assertEqual((len(lines), lines[0]["normal"], lines[0]["value"]), (1, [1, 0, 0], -0.25))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
