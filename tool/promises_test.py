#!/usr/bin/env python3
"""Tolerances, what an engine is fit for, the same bits again, and exams, as a user meets them:
python3 tool/promises_test.py PATH_TO_TOOL [unittest arguments].

The environment variable CONTACT_LIBRARY names the example engine in C, a shared library."""
import copy
import hashlib
import json
import math
import os
import re
import shlex
import subprocess
import sys
import unittest
import xml.etree.ElementTree as ElementTree
from decimal import Decimal, getcontext
from fractions import Fraction
from pathlib import Path

import cli_test
from cli_test import ROOT, TOOL, line, run, text

LIBRARY = os.environ.get("CONTACT_LIBRARY", "")
GENERIC = ROOT / "golden" / "sphere_sphere" / "generic.jsonl"
TOUCHING = ROOT / "golden" / "sphere_sphere" / "touching.jsonl"
PLAIN = shlex.join([sys.executable, str(ROOT / "docs" / "examples" / "engines" / "plain.py")])
PAST = {**os.environ, "SOURCE_DATE_EPOCH": "1600000000"}  # 2020-09-13
getcontext().prec = 120  # more than any sum of a few doubles near 1 has, and more than tells roots apart


def sha256(content):
    return hashlib.sha256(content.encode()).hexdigest()


def above(x):
    return math.nextafter(x, math.inf)


def below(x):
    return math.nextafter(x, -math.inf)


def exact(string):
    """The real number that a dyadic string stands for: -0x1abp-12."""
    sign, digits, exponent = re.fullmatch(r"(-?)0x([0-9a-f]+)p(-?\d+)", string).groups()
    return (-1 if sign else 1) * int(digits, 16) * Fraction(2) ** int(exponent)


def decimal(x):
    x = Fraction(x)
    return Decimal(x.numerator) / Decimal(x.denominator)


def is_rounded_up(claimed, real):
    """Whether a double is the least one that is not below a real."""
    return Decimal(claimed) >= real > Decimal(below(claimed))


class Case(cli_test.Case):
    def ends(self, code, *args, **options):
        done = run(*args, **options)
        self.assertEqual((done.returncode, done.stderr), (code, ""), done.stdout[-800:])
        return done.stdout

    def refuted(self, *args, **options):
        printed = self.ends(1, *args, **options)
        self.assertNotIn("\nCERTIFIED", printed)
        return printed

    def refused(self, *words, args, **options):
        """Exit status 2, a message with every one of the words, no verdict, and no file that is new or another."""
        state = lambda: {path: path.read_bytes() for path in self.folder.rglob("*") if path.is_file()}
        before = state()
        done = run(*args, **options)
        self.assertEqual(done.returncode, 2, done.stdout[-400:] + done.stderr)
        for word in words:
            self.assertIn(str(word), done.stderr)
        self.assertNotIn("CERTIFIED", done.stdout)
        self.assertEqual(state(), before)

    def report(self, *args, code=0):
        path = self.folder / "report.json"
        self.ends(code, "certify", *args, "--json", path)
        return json.loads(path.read_text())

    def questions(self, count=4, hit=True):
        """A dataset of the first hits, or misses, of a golden file that have both distances."""
        header, *cases = map(json.loads, GENERIC.read_text().splitlines())
        cases = [case for case in cases if case["expect"]["hit"] == hit and case["alarm"] and case["contact"]][:count]
        self.assertEqual(len(cases), count)
        self.cases = cases
        self.dataset = self.file("dataset.jsonl", [{**header, "count": len(cases)}, *cases])

    def answers(self, change=lambda contact: None, at=1, **header):
        """A results file of right answers, one of which is changed."""
        first = {"format": "contact-oracle/results", "version": 1, "engine": {"name": "test", "version": "1"},
                 "scalar": "binary64", "pairs": ["sphere_sphere"], **header}
        said = []
        for case in self.cases:
            expect = case["expect"]
            contact = {key: copy.deepcopy(expect[key]) for key in ("normal", "point1", "point2", "value")} if expect["hit"] else None
            said.append({"id": case["id"], "overlap": expect["hit"], "contact": contact})
        said[at]["contact"] = change(said[at]["contact"]) or said[at]["contact"]
        self.said = said
        return self.file("answers.jsonl", [first, *said])

    def judged(self, results, *options, code=0):
        return self.report(self.dataset, "--results", results, *options, code=code)

    def wrong_value(self, off, **header):
        """Answers of which the second has a value that is off."""
        self.questions()
        return self.answers(lambda contact: {**contact, "value": contact["value"] + off}, **header)

    def wrong_decision(self):
        """Answers of which the second misses a hit, or says that a miss is one."""
        first, *said = map(json.loads, self.answers().read_text().splitlines())
        said[1] = {"id": said[1]["id"], "overlap": not said[1]["overlap"], "contact": None}
        return self.file("answers.jsonl", [first, *said])


class Documentation(Case):
    """What stands on a page and in the program is the same in both."""

    PAGE = (ROOT / "docs" / "certify-your-engine.md").read_text()

    def test_the_table_of_profiles_is_the_programs(self):
        rows = re.findall(r"^\| `(\w+)` \| (\S+) \| (\S+) \| (\S+) \| (\S+) to (\S+) \|", self.PAGE, re.MULTILINE)
        refused = run("certify", GENERIC, "--profile", "none")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("{" + ",".join(row[0] for row in rows) + "}", refused.stderr)
        schema = json.loads((ROOT / "docs" / "schema" / "exam-key.json").read_text())
        self.assertEqual(schema["properties"]["profile"]["enum"], [*(row[0] for row in rows), None])
        self.questions()
        results = self.answers()
        for name, *numbers in rows:
            with self.subTest(name):
                tolerance = self.judged(results, "--profile", name)["tolerance"]
                said = [tolerance["length"], tolerance["relative"], tolerance["angle"], tolerance["scale"]["min"], tolerance["scale"]["max"]]
                self.assertEqual(said, list(map(float, numbers)))

    def test_the_table_of_unsteady_engines_is_the_programs(self):
        listed = re.findall(r"^unsteady:(\w+)", self.holds("engines", "--mutants"), re.MULTILINE)
        rows = re.findall(r"^\| `unsteady:(\w+)` \|.*\| (.*) \|$", (ROOT / "docs" / "bug-zoo.md").read_text(), re.MULTILINE)
        self.assertEqual([name for name, _ in rows], listed)
        self.assertEqual(sorted(listed), sorted(UNSTEADY))
        for name, way in rows:
            self.assertIn(way, UNSTEADY[name][1])


class Tolerance(Case):
    def passes_from(self, results, key, least):
        """Just enough certifies, and the number below refutes."""
        within = self.judged(results, "--tolerance", f"{key}={least!r}")
        self.assertTrue(within["verdict"].startswith("CERTIFIED within "), within["verdict"])
        beyond = self.judged(results, "--tolerance", f"{key}={below(least)!r}", code=1)
        self.assertIn("1 answer beyond it", beyond["verdict"])

    def test_a_length_that_is_just_enough_certifies_and_the_number_below_refutes(self):
        results = self.wrong_value(1e-3)
        need = self.judged(results, code=1)["total"]["fitness"]["needs"]
        self.assertEqual(need["length"]["id"], self.cases[1]["id"])
        self.passes_from(results, "length", need["length"]["from"])
        self.passes_from(results, "relative", need["relative_length"]["from"])

    def test_what_a_value_needs_is_its_distance_from_the_exact_real(self):
        results = self.wrong_value(1e-3)
        needs = self.judged(results, code=1)["total"]["fitness"]["needs"]
        case = self.cases[1]
        a, b = case["a"], case["b"]
        numbers = json.loads(self.holds("explain", "-", "--json", input=line(case)))["exact"]
        root = decimal(exact(numbers["distance2"])).sqrt()
        radii = decimal(Fraction(a["radius"]) + Fraction(b["radius"]))
        self.assertEqual(exact(numbers["reach"]), sum(map(Fraction, (case["alarm"], a["radius"], b["radius"]))))
        off = abs(Decimal(self.said[1]["contact"]["value"]) - (root - radii - Decimal(case["contact"])))
        self.assertTrue(is_rounded_up(needs["length"]["from"], off), (needs, off))
        share = off / max(root, radii, Decimal(case["contact"]))
        self.assertLess(abs(Decimal(needs["relative_length"]["from"]) / share - 1), Decimal("1e-15"))
        self.assertGreaterEqual(Decimal(needs["relative_length"]["from"]), share)

    def test_what_a_decision_needs_is_the_distance_from_where_it_changes(self):
        for hit in (True, False):
            self.questions(hit=hit)
            results = self.wrong_decision()
            needs = self.judged(results, code=1)["total"]["fitness"]["needs"]
            numbers = self.cases[1]["exact"]
            reach = decimal(exact(numbers["reach"]))
            off = abs(decimal(exact(numbers["distance2"])).sqrt() - reach)
            with self.subTest(hit=hit):
                self.assertTrue(is_rounded_up(needs["decision"]["from"], off), (needs, off))
                self.assertEqual(needs["length"], {"from": 0})
                self.passes_from(results, "length", needs["decision"]["from"])
                self.passes_from(results, "relative", needs["relative_decision"]["from"])

    def test_a_normal_may_be_off_by_the_angle_and_by_no_more(self):
        self.questions()
        turn = 1e-3

        def turned(contact):
            x, y, z = contact["normal"]
            return {**contact, "normal": [math.cos(turn) * x - math.sin(turn) * y, math.sin(turn) * x + math.cos(turn) * y, z]}

        results = self.answers(turned)
        needs = self.judged(results, code=1)["total"]["fitness"]["needs"]
        x, y, z = self.cases[1]["expect"]["normal"]
        # About the z axis a vector turns by the angle between its two places.
        chord = 2 * math.hypot(x, y) * math.sin(turn / 2)
        self.assertLess(abs(needs["angle"]["from"] / (2 * math.asin(chord / 2)) - 1), 1e-9)
        self.passes_from(results, "angle", needs["angle"]["from"])
        self.judged(results, "--tolerance", "length=1e300,relative=1e300", code=1)  # of lengths alone

    def test_length_and_share_are_added(self):
        results = self.wrong_value(1e-3)
        needs = self.judged(results, code=1)["total"]["fitness"]["needs"]
        length, share = needs["length"]["from"], needs["relative_length"]["from"]
        self.judged(results, "--tolerance", f"length={0.6 * length!r},relative={0.41 * share!r}")
        self.judged(results, "--tolerance", f"length={0.6 * length!r},relative={0.39 * share!r}", code=1)

    def test_no_tolerance_allows_a_field_or_an_answer_that_is_missing_or_no_number(self):
        self.questions()
        wide = ("--tolerance", "length=1e300,relative=1e300,angle=3.15")
        self.judged(self.answers(), *wide)
        for what, change in {"no field": lambda contact: {key: contact[key] for key in contact if key != "value"},
                             "no number": lambda contact: {**contact, "value": "NaN"},
                             "beyond all numbers": lambda contact: {**contact, "value": "Infinity"}, "no answer": None}.items():
            results = self.answers(change or (lambda contact: None))
            if change is None:
                self.file("answers.jsonl", "".join(results.read_text().splitlines(True)[:-1]))
            with self.subTest(what):
                self.assertEqual(self.judged(results, *wide, code=1)["total"]["fitness"]["never"], 1)

    def test_a_profile_is_the_tolerance_that_its_field_asks_for(self):
        # Off by half a millimetre: good enough for a game, and for nothing that measures.
        off = self.wrong_value(5e-4)
        self.judged(off, "--profile", "game")
        self.judged(off, "--profile", "robotics", code=1)

    def test_a_tolerance_that_is_malformed_is_refused_by_the_options_name(self):
        self.questions()
        results = self.answers()
        for value in ("lenght=1", "length=-1", "relative=-1e-9", "angle=-0.1", "length=NaN", "relative=nan", "length=Infinity", "angle=inf",
                      "length=1,length=2", "angle=1,relative=1,angle=1", "length=", "length", "=1", ",", "length=1,", "length=1,,angle=1",
                      "angle=4", "length=1mm", "length=0x1", "min=2,max=1", "min=-1", "max=NaN", ""):
            with self.subTest(value):
                self.refused("--tolerance", args=["certify", self.dataset, "--results", results, "--tolerance", value])

    def test_a_key_given_twice_is_refused_also_where_it_is_a_bound_of_the_scale(self):
        self.questions()
        results = self.answers()
        for value in ("min=1e-9,min=1e-8", "max=1e9,length=1,max=1e8", "scale=3"):
            with self.subTest(value):
                self.refused("--tolerance", args=["certify", self.dataset, "--results", results, "--tolerance", value])

    def test_a_level_a_tolerance_and_a_profile_exclude_each_other(self):
        self.questions()
        base = ["certify", self.dataset, "--results", self.answers()]
        for first, second in ((("--level", "bounded"), ("--tolerance", "length=1")), (("--level", "bounded"), ("--profile", "game")),
                              (("--tolerance", "length=1"), ("--profile", "game"))):
            with self.subTest(first[0] + second[0]):
                self.refused(first[0], second[0], args=[*base, *first, *second])
        self.refused("--profile", "gam", args=[*base, "--profile", "gam"])

    def test_an_engine_may_state_its_tolerance_and_the_command_line_comes_first(self):
        stated = {"length": 1e-2, "relative": 0, "angle": 0}
        results = self.wrong_value(1e-3, tolerance=stated)
        report = self.judged(results)
        self.assertEqual(report["tolerance"], stated)
        self.assertIn("CERTIFIED within length 0.01", report["verdict"])
        self.assertIsNone(self.judged(results, "--level", "bounded", code=1)["tolerance"])
        self.assertEqual(self.judged(results, "--tolerance", "length=1e-4", code=1)["tolerance"]["length"], 1e-4)
        self.assertEqual(self.judged(results, "--profile", "robotics", code=1)["tolerance"]["length"], 1e-5)
        for tolerance in ({"length": -1}, {"length": "NaN"}, {"width": 1}, {"angle": 3.2}, {"scale": {"min": 1}}, [1]):
            with self.subTest(tolerance):
                bad = self.answers(tolerance=tolerance)
                self.refused("answers.jsonl:1", "tolerance", args=["certify", self.dataset, "--results", bad])

    def test_an_engine_in_a_process_states_its_tolerance_in_its_hello(self):
        self.questions()
        script = self.file("engine.py", Path(shlex.split(PLAIN)[1]).read_text().replace('"bounds":', '"tolerance": {"length": 0.25, "angle": 1e-9}, "bounds":', 1))
        self.assertIn("0.25", script.read_text())
        report = self.report(self.dataset, "--engine-command", shlex.join([sys.executable, str(script)]))
        self.assertEqual(report["tolerance"], {"length": 0.25, "relative": 0, "angle": 1e-9})

    def test_its_scale_leaves_questions_out_and_says_so(self):
        self.questions()
        results = self.answers()
        largest = max(abs(x) for case in self.cases for s in "ab" for x in [*case[s]["center"], case[s]["radius"]])
        whole = self.judged(results, "--tolerance", f"length=1,max={largest!r}")
        self.assertEqual((whole["total"]["judged"], whole["skipped"]), (4, []))
        report = self.judged(results, "--tolerance", f"length=1,max={below(largest)!r}")
        self.assertEqual((report["total"]["judged"], report["skipped"][0]["cases"]), (3, 1))
        self.assertIn("outside the scale of the tolerance", report["skipped"][0]["why"])
        self.assertIn("on all 3 judged cases (75 % of those given)", report["verdict"])
        self.assertNotIn("unknown", report["verdict"])
        self.assertEqual(report["unknown_answers"], [])
        self.refused(args=["certify", self.dataset, "--results", results, "--tolerance", "length=1,min=1e300"])

    def test_every_report_speaks_of_the_tolerance(self):
        results = self.wrong_value(1e-3)
        names = ("json", "junit", "markdown", "report")
        outputs = [word for name in names for word in (f"--{name}", self.folder / f"out.{name}")]
        for tolerance, code in (("length=0.01", 0), ("length=1e-4", 1)):
            printed = self.ends(code, "certify", self.dataset, "--results", results, "--tolerance", tolerance, *outputs)
            demand = f"within length {float(tolerance[7:])}, relative 0, angle 0"
            self.assertIn(f"required: {demand}", printed)
            self.assertIn(f"\nCERTIFIED {demand}: test 1" if code == 0 else f"\nREFUTED: test 1 is not {demand}", printed)
            for name in names:
                with self.subTest(f"{name} {tolerance}"):
                    self.assertIn(demand.replace("1e-04", "0.0001"), (self.folder / f"out.{name}").read_text())
            failed = ElementTree.parse(self.folder / "out.junit").getroot().iter("failure")
            self.assertEqual(len(list(failed)), 2 * code)  # the family's and the verdict's

    def test_a_failure_that_a_baseline_accepts_is_one_beyond_the_tolerance(self):
        results = self.wrong_value(1e-3)
        options = ("--tolerance", "length=1e-4")
        known = self.judged(results, *options, code=1)
        self.assertEqual([one["id"] for one in known["failures"]], [self.cases[1]["id"]])
        path = self.file("known.json", line(known))
        report = self.judged(results, *options, "--baseline", path)
        self.assertIn("CERTIFIED within length 0.0001, relative 0, angle 0 but for 1 failure", report["verdict"])
        self.assertEqual(self.judged(self.answers(), *options, "--baseline", path)["total"]["accepted"], 0)


class Jump(Case):
    """Questions whose answer jumps: docs/specification.md#where-the-answer-jumps."""

    def asked(self, question):
        """A dataset of one question, and its id."""
        path = self.folder / "d.jsonl"
        self.holds("annotate", "-", "-o", path, input=line(question))
        self.dataset = path
        return json.loads(path.read_text().splitlines()[1])["id"]

    def said(self, name, pair, contact):
        return self.file("answers.jsonl", [{"format": "contact-oracle/results", "version": 1, "engine": {"name": "test", "version": "1"},
                                            "scalar": "binary64", "pairs": [pair]}, {"id": name, "overlap": True, "contact": contact}])

    def nearly_level(self, rise):
        """A capsule over a plane whose normal is 3 long, 4 above it at its start and a third of 2 `rise` more at its end, which the
        answer takes for the lower one; and the length that this needs, in fractions."""
        start, end, radius, normal, offset = [3, 2, 1], [7, 0, 1 + rise], 0.5, [1, 2, 2], -3
        name = self.asked({"pair": "capsule_plane", "a": {"start": start, "end": end, "radius": radius},
                           "b": {"normal": normal, "offset": offset}, "alarm": 10, "contact": 0})
        height = lambda x: (sum(Fraction(n) * c for n, c in zip(normal, x)) - offset) / 3
        down = [Fraction(-n, 3) for n in normal]
        point1 = [float(Fraction(x) + Fraction(radius) * n) for x, n in zip(end, down)]
        point2 = [float(Fraction(x) + height(map(Fraction, end)) * n) for x, n in zip(end, down)]
        results = self.said(name, "capsule_plane", {"normal": [float(n) for n in down], "point1": point1, "point2": point2, "value": 3.5})
        # The points of the cores that the claimed ones stand for, and how far each is from where it should be.
        p, q = [Fraction(x) - Fraction(radius) * n for x, n in zip(point1, down)], list(map(Fraction, point2))
        along = [Fraction(y) - x for x, y in zip(start, end)]
        t = min(Fraction(1), sum((x - s) * a for x, s, a in zip(p, start, along)) / sum(a * a for a in along))
        squares = [sum((x - s - t * a) ** 2 for x, s, a in zip(p, start, along)), height(q) ** 2,
                   sum((y - x - 4 * n) ** 2 for x, y, n in zip(p, q, down))]
        return results, decimal(max(squares)).sqrt()

    def test_an_end_that_is_nearly_the_lowest_needs_what_it_is_too_high(self):
        results, need = self.nearly_level(2.0**-10)
        self.assertLess(abs(need / (Decimal(2) / 3 / 1024) - 1), Decimal("1e-9"))
        needs = self.judged(results, code=1)["total"]["fitness"]["needs"]
        self.assertTrue(is_rounded_up(needs["length"]["from"], need), (needs, need))
        Tolerance.passes_from(self, results, "length", needs["length"]["from"])
        self.judged(results, "--profile", "game")

    def test_what_is_two_thousandths_off_is_not_good_enough_for_a_game(self):
        results, need = self.nearly_level(3 * 2.0**-10)  # 1.95e-3 too high
        self.assertGreater(need, Decimal("1.9e-3"))
        self.judged(results, "--profile", "game", code=1)
        # A point or a normal beside the right one in a question that does not jump.
        name = self.asked({"a": {"center": [0, 0, 0], "radius": 1}, "b": {"center": [0, 0, 2], "radius": 0.5}, "alarm": 1, "contact": 0})
        right = {"normal": [0, 0, 1], "point1": [0, 0, 1], "point2": [0, 0, 1.5], "value": 0.5}
        turn = math.radians(2)
        self.judged(self.said(name, "sphere_sphere", right), "--profile", "game")
        for wrong in ({"point1": [2e-3, 0, 1]}, {"point2": [0, 2e-3, 1.5]}, {"normal": [math.sin(turn), 0, math.cos(turn)]}):
            with self.subTest(wrong):
                self.judged(self.said(name, "sphere_sphere", {**right, **wrong}), "--profile", "game", code=1)
        for gap, code in ((2e-3, 1), (5e-4, 0)):
            name = self.asked({"a": {"center": [0, 0, 0], "radius": 1}, "b": {"center": [0, 0, 1.5 + gap], "radius": 0.5}, "alarm": 0, "contact": 0})
            with self.subTest(gap):
                self.judged(self.said(name, "sphere_sphere", {"normal": [0, 0, 1], "point1": [0, 0, 1], "point2": [0, 0, 1 + gap], "value": gap}),
                            "--profile", "game", code=code)

    def test_game_refuses_plain_doubles_for_nothing_but_what_is_no_number(self):
        for pair, family in (("capsule_plane", "parallel"), ("ray_triangle", "along_plane"), ("triangle_line", "along_plane"), ("sphere_cube", "inside"),
                             ("sphere_triangle", "on_triangle.f32"), ("capsule_capsule", "on_axis.f32"), ("capsule_capsule", "zero_length")):
            with self.subTest(f"{pair}/{family}"):
                # Ulps refute it, so that there is something to forgive; and the tolerance forgives it.
                path = ROOT / "golden" / pair / f"{family}.jsonl"
                self.refuted("certify", path, "--engine", "plain-double")
                self.holds("certify", path, "--engine", "plain-double", "--profile", "game")
        report = self.report(ROOT / "golden" / "sphere_sphere" / "coincident.jsonl", "--engine", "plain-double", "--profile", "game", code=1)
        self.assertEqual({one["what"] for one in report["failures"]}, {"normal not finite"})


class Fitness(Case):
    def fitness(self, *args, code=1):
        return self.ends(code, "certify", *args)

    def test_what_is_said_to_pass_passes(self):
        base = [TOUCHING, "--engine", "plain-double"]
        printed = self.fitness(*base)
        options = {}
        for what in ("everyday numbers", "all numbers"):
            said = re.search(rf"^  {what}[^:]*: would pass with --tolerance (\S+?)(?:, or (\S+))?$", printed, re.MULTILINE)
            options[what] = [one for one in said.groups() if one]
            for tolerance in options[what]:
                with self.subTest(tolerance):
                    self.assertIn("CERTIFIED within", self.holds("certify", *base, "--tolerance", tolerance))
        self.assertTrue(all("min=1e-4,max=1e4" in one for one in options["everyday numbers"]), options)
        self.assertNotIn("length", "".join(options["all numbers"]))  # of numbers up to 1e18 a length says nothing
        # And the two figures are not too many: a tenth of them is too little.
        for tolerance in options["all numbers"]:
            less = re.sub(r"(length|relative)=([^,]+)", lambda m: f"{m[1]}={float(m[2]) / 10!r}", tolerance)
            self.refuted("certify", *base, "--tolerance", less)

    def test_half_a_turn_is_said_as_the_option_takes_it_and_a_length_that_no_angle_allows_is_not(self):
        self.questions()
        for factor, said in ((-1, "angle=3.15"), (10, None)):
            results = self.answers(lambda contact: {**contact, "normal": [factor * x for x in contact["normal"]]})
            printed = self.fitness(self.dataset, "--results", results)
            with self.subTest(factor):
                if said is None:
                    self.assertNotIn("would pass with --tolerance", printed)
                else:
                    self.assertIn(f"would pass with --tolerance {said}", printed)
                    self.holds("certify", self.dataset, "--results", results, "--tolerance", said)

    def test_a_right_engine_passes_with_any_tolerance(self):
        printed = self.fitness(GENERIC, "--engine", "production", code=0)
        self.assertIn("all numbers: would pass with any tolerance", printed)
        self.assertNotIn("need the largest tolerance", printed)
        self.holds("certify", GENERIC, "--engine", "production", "--tolerance", "length=0")

    def test_the_needs_of_whole_files_are_those_of_the_definition(self):
        for path in (GENERIC, TOUCHING):
            recorded = self.folder / f"{path.stem}.answers.jsonl"
            needs = self.report(path, "--engine-command", PLAIN, "--record", recorded, code=int(path == TOUCHING))["total"]["fitness"]["needs"]
            said = {one["id"]: one for one in map(json.loads, recorded.read_text().splitlines()[1:])}
            offs = {"length": (Decimal(0), ""), "relative_length": (Decimal(0), ""), "decision": (Decimal(0), ""), "relative_decision": (Decimal(0), "")}

            def take(key, off, scale, name):
                for what, x in ((key, off), (f"relative_{key}", off / scale if scale else off)):
                    offs[what] = max(offs[what], (x, name), key=lambda pair: pair[0])

            for case in map(json.loads, path.read_text().splitlines()[1:]):
                (c, r), (d, s) = ((list(map(Fraction, case[which]["center"])), Fraction(case[which]["radius"])) for which in "ab")
                distance2, reach = sum((y - x) ** 2 for x, y in zip(c, d)), Fraction(case["alarm"]) + r + s
                root = decimal(distance2).sqrt()
                answer, hit = said[case["id"]], distance2 <= reach**2
                if answer["overlap"] != hit:
                    take("decision", abs(root - decimal(reach)), decimal(reach), case["id"])
                # A false hit has numbers, and those are judged.
                if not answer["contact"] or not distance2:
                    continue
                normal = [decimal(y - x) / root for x, y in zip(c, d)]
                right = {"value": [root - decimal(r + s) - Decimal(case["contact"])], "point1": [decimal(x) + decimal(r) * n for x, n in zip(c, normal)],
                         "point2": [decimal(x) - decimal(s) * n for x, n in zip(d, normal)]}
                scales = {"value": max(root, decimal(r + s), Decimal(case["contact"])), "point1": decimal(max(*map(abs, c), r)),
                          "point2": decimal(max(*map(abs, d), s))}
                for field, exact_numbers in right.items():
                    claims = answer["contact"][field]
                    for claim, x in zip(claims if isinstance(claims, list) else [claims], exact_numbers):
                        if abs(Decimal(claim) - x) > Decimal(math.ulp(claim)) / 2 * (1 + Decimal("1e-60")):  # else correctly rounded
                            take("length", abs(Decimal(claim) - x), scales[field], case["id"])
            for key, (off, name) in offs.items():
                with self.subTest(f"{path.name} {key}"):
                    self.assertGreaterEqual(Decimal(needs[key]["from"]), off)
                    self.assertLessEqual(Decimal(needs[key]["from"]) * (1 - Decimal(2) ** -50), off)
                    self.assertEqual(needs[key].get("id", ""), name)

    def test_everyday_numbers_are_those_from_a_tenth_of_a_thousandth_to_ten_thousand(self):
        def question(x):
            return {"a": {"center": [0, 0, 0], "radius": x}, "b": {"center": [0, 0, x], "radius": x}, "alarm": 0, "contact": 0}
        numbers = [1e-4, 1e4, below(1e-4), above(1e4)]
        path = self.folder / "d.jsonl"
        self.holds("annotate", "-", "-o", path, input=text(map(question, numbers)))
        total = self.report(path, "--engine", "production")["total"]
        self.assertEqual((total["everyday"]["answers"], total["fitness"]["answers"]), (2, 4))

    def test_the_largest_error_is_listed_by_the_power_of_ten_of_the_questions_numbers(self):
        self.questions()
        results = self.wrong_value(1e-3)
        fitness = self.judged(results, code=1)["total"]["fitness"]
        case = self.cases[1]
        largest = max(abs(x) for s in "ab" for x in [*case[s]["center"], case[s]["radius"]])
        self.assertEqual(fitness["by_scale"], [[math.floor(math.log10(largest)), fitness["needs"]["length"]["from"], 0, 0]])

    def test_the_questions_in_the_way_are_lines_for_explain_and_stand_in_every_report_that_has_lines(self):
        results = self.wrong_value(1e-3)
        page, report = self.folder / "out.html", self.folder / "out.json"
        printed = self.refuted("certify", self.dataset, "--results", results, "--json", report, "--report", page)
        what, asked = re.search(r"These questions need the largest tolerance:\n  # (.*)\n  (\{.*\})\n", printed).groups()
        self.assertRegex(what, r"^a value or coordinate off by 1\.[01]e-03$")  # two figures, rounded up
        self.assertIn(self.cases[1]["id"], self.holds("explain", "-", input=asked))
        self.assertEqual(json.loads(report.read_text())["in_the_way"][0], {"what": what, "query": json.loads(asked)})
        self.assertIn("These questions need the largest tolerance", page.read_text())
        self.assertIn("id=scales", page.read_text())

    def test_an_answer_that_no_tolerance_allows_is_counted_and_named(self):
        self.questions()
        results = self.answers(lambda contact: {**contact, "value": "NaN"})
        printed = self.fitness(self.dataset, "--results", results)
        self.assertIn("all numbers: would pass with any tolerance; no tolerance allows 1 more: an answer, a field or a number is missing", printed)
        self.assertIn("# no answer, a field missing, or no number\n", printed)


class Conditioning(Case):
    def test_a_decision_that_the_last_bit_of_the_inputs_turns_is_told_apart(self):
        near = {"a": {"center": [0, 0, 0], "radius": 1}, "b": {"center": [above(2.0), 0, 0], "radius": 1}, "alarm": 0, "contact": 0}
        far = {**near, "b": {"center": [2.25, 0, 0], "radius": 1}}
        path = self.folder / "d.jsonl"
        self.holds("annotate", "-", "-o", path, input=text([near, far]))
        ids = [json.loads(one)["id"] for one in path.read_text().splitlines()[1:]]
        header = {"format": "contact-oracle/results", "version": 1, "engine": {"name": "test", "version": "1"}, "scalar": "binary64",
                  "pairs": ["sphere_sphere"], "claims": ["overlap"]}
        results = self.file("answers.jsonl", [header, *({"id": one, "overlap": True} for one in ids)])
        report = self.report(path, "--results", results, code=1)
        fitness = report["total"]["fitness"]
        self.assertEqual(report["total"]["false_hits"], 2)
        self.assertEqual(fitness["no_worse_than_last_bit"], {"length": 0, "angle": 0, "decision": 1})
        for needs in (fitness["needs"], fitness["needs_beyond_last_bit"]):
            self.assertEqual(needs["decision"]["id"], ids[1])
            self.assertTrue(0.25 <= needs["decision"]["from"] <= above(0.25), needs)  # of a root, rounded up
        what = {one["id"]: one["what"] for one in report["failures"]}
        self.assertEqual(what[ids[0]], "false hit, 4.5e-16 from where the answer changes (no worse than the inputs' last bit)")
        self.assertRegex(what[ids[1]], r"^false hit, 2\.[56]e-01 from where the answer changes$")
        self.file("answers.jsonl", [header, {"id": ids[0], "overlap": True}, {"id": ids[1], "overlap": False}])
        printed = self.refuted("certify", path, "--results", results)
        self.assertIn("all numbers, ignoring 1 decision that the last bit of an input would flip: with any tolerance", printed)

    def test_a_decision_within_the_rounding_of_an_orientation_is_told_apart_where_that_is_declared(self):
        box = {"center": [0, 0, 0], "orientation": [0, 0, 0, 1], "extents": [1, 1, 1]}
        near = {"pair": "obb_obb", "a": box, "b": {**box, "center": [2 + 1e-14, 0, 0]}, "alarm": 0, "contact": 0}
        path = self.folder / "d.jsonl"
        self.holds("annotate", "-", "-o", path, input=text([near]))
        case = json.loads(path.read_text().splitlines()[1])
        header = {"format": "contact-oracle/results", "version": 1, "engine": {"name": "test", "version": "1"}, "scalar": "binary64",
                  "pairs": ["obb_obb"], "claims": ["overlap"]}
        for rounds, excused in ((["orientation"], 1), ([], 0)):
            results = self.file("answers.jsonl", [{**header, "rounds": rounds}, {"id": case["id"], "overlap": True}])
            with self.subTest(rounds):
                report = self.report(path, "--results", results, code=1)
                self.assertEqual(report.get("rounds", []), rounds)
                fitness = report["total"]["fitness"]
                self.assertEqual((fitness["within_rounding"], fitness["no_worse_than_last_bit"]["decision"]), (excused, 0))
                self.assertEqual(fitness["needs_beyond_last_bit"]["decision"]["from"] > 0, not excused)
                self.assertEqual("(within the rounding of an orientation)" in report["failures"][0]["what"], bool(excused))
                printed = self.refuted("certify", path, "--results", results)
                line = "all numbers, ignoring 1 decision within the rounding of an orientation: with any tolerance"
                self.assertEqual(line in printed, bool(excused))

    def test_a_normal_of_centres_that_nearly_coincide_is_excused_as_far_as_the_last_bit_turns_it(self):
        near = {"a": {"center": [1, 1, 1], "radius": 1}, "b": {"center": [1 + 2.0**-40, 1, 1], "radius": 1}, "alarm": 0, "contact": 0}
        path = self.folder / "d.jsonl"
        self.holds("annotate", "-", "-o", path, input=text([near]))
        case = json.loads(path.read_text().splitlines()[1])
        header = {"format": "contact-oracle/results", "version": 1, "engine": {"name": "test", "version": "1"}, "scalar": "binary64",
                  "pairs": ["sphere_sphere"], "claims": ["normal"]}
        # Four coordinates across may move by an ulp of 1, each turning the normal by 2^-12.
        for tilt, excused in ((2.0**-11, 1), (2.0**-6, 0)):
            results = self.file("answers.jsonl", [header, {"id": case["id"], "contact": {"normal": [1, tilt, 0]}}])
            fitness = self.report(path, "--results", results, code=1)["total"]["fitness"]
            with self.subTest(tilt):
                self.assertEqual(fitness["no_worse_than_last_bit"]["angle"], excused)
                # As far as one centre moves aside, and what the normal is too long.
                self.assertTrue(tilt / 2 < fitness["needs"]["length"]["from"] * 2**40 < tilt, fitness)
                self.assertTrue(0 < fitness["needs"]["angle"]["from"] <= tilt**2 / 2, fitness)
                self.assertEqual(fitness["needs_beyond_last_bit"]["angle"]["from"] > 0, excused == 0)


SERVED = shlex.join([TOOL, "serve", "--engine", "unsteady:process"])
# What to ask, whom, and the way of asking that finds it.
UNSTEADY = {
    "order": ([TOUCHING, "--engine", "unsteady:order"], "in another order"),
    "batch": (["--generate", 300, "--pair", "sphere_sphere", "--family", "touching", "--seed", 3, "--engine", "unsteady:batch"], "up to 4096 at once"),
    "time": ([TOUCHING, "--engine", "unsteady:time"], "again, in the same order"),
    "threads": ([TOUCHING, "--engine", "unsteady:threads", "--jobs", 1], "from 4 threads"),
    # In one process it is steady.
    "process": ([TOUCHING, "--engine-command", SERVED], "by 4 processes"),
}
STEADY = ("again, in the same order", "in another order", "one at a time", "up to 4096 at once")


class Determinism(Case):
    def test_an_engine_that_gives_other_bits_is_refuted_and_the_first_question_is_a_line_for_explain(self):
        for name, (options, way) in UNSTEADY.items():
            with self.subTest(name):
                printed = self.refuted("certify", *options, "--determinism")
                self.assertRegex(printed.splitlines()[-1], "^REFUTED: unsteady:.* is not deterministic on .*: other answers when it was asked again")
                first = re.search(rf"^  {way}: [1-9]\d* of \d+ answers differ, the first to (.*)$", printed, re.MULTILINE)[1]
                question, end = json.JSONDecoder().raw_decode(first)
                self.assertIn(question["id"], self.holds("explain", "-", input=first[:end]))
                now, before = map(json.loads, re.fullmatch(r": (.*), and before (.*)", first[end:]).groups())
                self.assertNotEqual(now, before)
                self.assertEqual({**now, "contact": None}, {**before, "contact": None})

    def test_without_the_option_they_are_certified(self):
        for name, (options, _) in UNSTEADY.items():
            with self.subTest(name):
                self.assertIn("\nCERTIFIED: unsteady:", self.holds("certify", *options))

    def test_those_that_change_in_one_way_alone_are_the_same_in_the_others(self):
        for name in ("batch", "threads", "process"):
            options, way = UNSTEADY[name]
            report = self.report(*options, "--determinism", code=1)
            with self.subTest(name):
                self.assertEqual([one["how"] for one in report["determinism"]["ways"] if one["differ"]], [way])

    def test_a_right_engine_a_process_and_a_library_give_the_same_bits(self):
        engines = {"production": (["--engine", "production"], ["from 4 threads"]), "plain.py": (["--engine-command", PLAIN], ["by 4 processes"])}
        if LIBRARY:
            engines["library"] = (["--engine-library", LIBRARY], ["by 4 processes", "from 4 threads of a process"])
        for name, (options, more) in engines.items():
            with self.subTest(name):
                self.questions(20)
                report = self.report(self.dataset, *options, "--determinism")
                self.assertEqual([(one["how"], one["asked"], one["differ"]) for one in report["determinism"]["ways"]],
                                 [(how, 20, 0) for how in (*STEADY, *more)])
                self.assertIn(f"Asked in {4 + len(more)} more ways, it gave the same bits.", report["verdict"])

    @unittest.skipUnless(LIBRARY, "CONTACT_LIBRARY names no library: the engine in C is not asked again")
    def test_the_library_is_among_them(self):
        self.assertTrue(Path(LIBRARY).is_file())

    def test_the_digest_is_of_the_ids_and_answers_in_the_order_of_the_questions(self):
        self.questions(20)
        recorded = self.folder / "recorded.jsonl"
        report = self.report(self.dataset, "--engine-command", PLAIN, "--determinism", "--record", recorded)["determinism"]
        said = {one[7:31]: one for one in recorded.read_text().splitlines()[1:]}
        lines = [f"{case['id']} {{{said[case['id']][33:]}\n" for case in self.cases]
        self.assertTrue(lines[0].startswith(self.cases[0]["id"] + ' {"overlap":true,'), lines[0])
        self.assertEqual(report["sha256"], sha256("".join(lines)))
        self.assertEqual([(one["sha256"], one["each"]) for one in report["sources"]],
                         [(sha256("".join(lines)), "".join(one[:24] + sha256(one)[:8] for one in lines))])

    def test_compare_tells_whether_two_reports_have_the_same_bits(self):
        # The one became better: without the option that is no refutation.
        paths = {}
        for name, engine, code in (("production", "production", 0), ("again", "production", 0), ("order", "unsteady:order", 1)):
            paths[name] = self.folder / f"{name}.json"
            self.ends(code, "certify", TOUCHING, "--engine", engine, "--determinism", "--json", paths[name], "--record", self.folder / f"{name}.jsonl")
        printed = self.holds("compare", paths["production"], paths["again"], "--same-bits")
        self.assertIn("The reports have the same bits for every question that both were asked.", printed)
        printed = self.refuted("compare", paths["order"], paths["production"], "--same-bits")
        self.assertIn("REFUTED: --same-bits asks for the same bits, and the reports do not show them.", printed)
        self.holds("compare", paths["order"], paths["production"])
        # Which question is first says the report itself, in the order in which they were asked.
        each = [json.loads(paths[name].read_text())["determinism"]["sources"][0]["each"] for name in ("order", "production")]
        first = next(each[0][i:i + 24] for i in range(0, len(each[0]), 32) if each[0][i:i + 32] != each[1][i:i + 32])
        self.assertIn(f"The bits of the answers differ in 1 family, first in {first} in ", printed)
        self.assertIn(first, TOUCHING.read_text())

    def test_reports_that_say_nothing_of_bits_show_nothing(self):
        with_bits, without = self.folder / "with.json", self.folder / "without.json"
        self.questions(5)
        self.holds("certify", self.dataset, "--engine", "production", "--determinism", "--json", with_bits)
        self.holds("certify", self.dataset, "--engine", "production", "--json", without)
        for old, new in ((with_bits, without), (without, with_bits), (without, without)):
            with self.subTest((old.name, new.name)):
                self.assertIn("REFUTED: --same-bits", self.refuted("compare", old, new, "--same-bits"))
                self.holds("compare", old, new)
        self.assertIn(f"{without} does not say what the bits of its answers are", self.refuted("compare", with_bits, without, "--same-bits"))

    def test_questions_that_are_others_are_not_the_same_bits(self):
        paths = []
        for count in (3, 4):
            self.questions(count)
            paths.append(self.folder / f"{count}.json")
            self.holds("certify", self.dataset, "--engine", "production", "--determinism", "--json", paths[-1])
        self.refuted("compare", *paths, "--same-bits")

    def test_it_is_refused_where_nobody_can_be_asked_again(self):
        self.questions()
        results = self.answers()
        for what, options in {"a results file": [self.dataset, "--results", results], "one engine": [],
                              "--parts": [self.dataset, "--engine", "production", "--parts", self.folder / "parts"]}.items():
            with self.subTest(what):
                self.refused("--determinism", what, args=["certify", *options, "--determinism"])

    def test_every_report_says_what_came_of_asking_again(self):
        names = ("json", "markdown", "report")
        outputs = [word for name in names for word in (f"--{name}", self.folder / f"out.{name}")]
        self.refuted("certify", *UNSTEADY["order"][0], "--determinism", *outputs)
        for name in names:
            with self.subTest(name):
                self.assertRegex((self.folder / f"out.{name}").read_text(), "in another order")

    def test_a_certificate_of_an_engine_that_was_asked_again_holds(self):
        self.questions()
        path = self.folder / "certificate.json"
        for engine, dataset, code in (("production", self.dataset, 0), ("unsteady:order", TOUCHING, 1)):
            with self.subTest(engine):
                self.ends(code, "certify", dataset, "--engine", engine, "--determinism", "--certificate", path)
                self.assertEqual(json.loads(path.read_text())["found"]["same_bits"], code == 0)
                self.assertIn("HOLDS", self.holds("verify", path))

    def test_an_engine_that_answers_from_threads_is_served_and_gives_the_same_answers(self):
        self.questions(20)
        asked = [{"op": "query", "seq": seq, "pair": "sphere_sphere", **{key: case[key] for key in ("a", "b", "alarm", "contact")}}
                 for seq, case in enumerate(self.cases, 1)]
        messages = text([{"op": "hello", "protocol": 1}, *asked, {"op": "stop"}])
        one = self.holds("serve", input=messages)
        self.assertEqual(len(one.splitlines()), 21)
        self.assertEqual(self.holds("serve", "--threads", 3, input=messages), one)
        self.refused("--threads", args=["serve", "--threads", 0])


COMMITTED = ("issued", "profile", "published", "generator", "seed", "nonce", "sources")  # of a key, in this order


class Exams(Case):
    def set_exam(self, *options, name="", families="generic,touching", seed=340174611297):
        self.exam, self.key = self.folder / f"exam{name}.jsonl", self.folder / f"key{name}.json"
        seeds = [] if seed is None else ["--seed", seed]
        return self.holds("exam", "new", "-o", self.exam, "--key", self.key, "--pair", "sphere_sphere", "--family", families, "--count", 6,
                          *seeds, *options, env=PAST)

    def take(self, *engine, exam=None):
        self.taken = self.folder / "taken.jsonl"
        return self.holds("exam", "take", exam or self.exam, "-o", self.taken, *(engine or ("--engine", "production")))

    def close(self, *options, code=0):
        self.certificate = self.folder / "certificate.json"
        return self.ends(code, "exam", "close", "--key", self.key, "--results", self.taken, "--exam", self.exam,
                         "--certificate", self.certificate, *options, env=PAST)

    def closing(self, *options):
        return ["exam", "close", "--key", self.key, "--results", self.taken, *options]

    def reseal(self, change):
        """Changes the certificate, which then has the digest of what it says."""
        before = self.certificate.read_text()
        self.assertNotEqual(change(before), before)
        blank = re.sub('\n"sha256":"[0-9a-f]*"', '\n"sha256":"' + "0" * 64 + '"', change(before))
        self.certificate.write_text(blank.replace('\n"sha256":"' + "0" * 64, '\n"sha256":"' + sha256(blank)))

    def key_json(self):
        return json.loads(self.key.read_text())

    def test_an_engine_takes_an_exam_and_its_certificate_holds(self):
        engines = {"a process": ["--engine-command", PLAIN], **({"a library": ["--engine-library", LIBRARY]} if LIBRARY else {})}
        for name, engine in engines.items():
            with self.subTest(name):
                self.assertIn("12 questions of 2 families", self.set_exam(name=name[2:5]))
                self.assertIn("12 of 12 questions answered by plain-", self.take(*engine))
                printed = self.close("--tolerance", "relative=1e-15,angle=1e-15")
                self.assertIn("\nCERTIFIED within length 0, relative 1e-15, angle 1e-15: plain-", printed)
                self.assertIn(f"{self.key} is used, and its seed stands in the certificate", printed)
                self.assertIn("HOLDS", self.holds("verify", self.certificate, "--exam", self.exam))

    @unittest.skipUnless(LIBRARY, "CONTACT_LIBRARY names no library: the engine in C takes no exam")
    def test_the_library_is_among_them(self):
        self.assertTrue(Path(LIBRARY).is_file())

    def test_a_wrong_answer_refutes_and_the_certificate_says_so(self):
        self.set_exam(families="generic")
        self.take()
        header, *said = map(json.loads, self.taken.read_text().splitlines())
        wrong = next(one for one in said if one["contact"])
        wrong["contact"]["value"] += 1
        self.file("taken.jsonl", [header, *said])
        self.assertIn("REFUTED: production", self.close(code=1))
        self.assertFalse(json.loads(self.certificate.read_text())["found"]["certified"])
        self.assertIn("HOLDS", self.holds("verify", self.certificate, "--exam", self.exam))
        self.refuted("verify", self.certificate, "--level", "bounded")

    def test_an_exam_has_questions_and_neither_answers_nor_families(self):
        self.set_exam()
        header, *lines = self.exam.read_text().splitlines()
        self.assertEqual(list(json.loads(header)), ["format", "version", "count", "questions", "commitment"])
        self.assertEqual((json.loads(header)["count"], json.loads(header)["questions"]), (12, sha256("".join(one + "\n" for one in lines))))
        for one in lines:
            self.assertEqual(list(json.loads(one)), ["id", "pair", "scalar", "a", "b", "alarm", "contact"])
        for word in ("generic", "touching", "expect", str(self.key_json()["seed"])):
            self.assertNotIn(word, self.exam.read_text())

    def test_the_order_is_that_of_the_digests_of_nonce_and_id(self):
        self.set_exam()
        ids = [json.loads(one)["id"] for one in self.exam.read_text().splitlines()[1:]]
        self.assertEqual(ids, sorted(ids, key=lambda one: sha256(self.key_json()["nonce"] + one)))
        self.assertNotEqual(ids, sorted(ids))

    def test_the_commitment_is_the_digest_of_all_that_makes_the_questions(self):
        self.set_exam()
        key = self.key_json()
        committed = {name: key[name] for name in COMMITTED}
        self.assertEqual(key["commitment"], sha256(line(committed)))
        self.assertEqual(json.loads(self.exam.read_text().splitlines()[0])["commitment"], key["commitment"])

    def test_the_seed_that_is_revealed_makes_the_questions_again(self):
        self.set_exam()
        self.take()
        self.close()
        certificate = json.loads(self.certificate.read_text())
        self.assertEqual(certificate["exam"], {**{name: self.key_json()[name] for name in ("commitment", "issued", "nonce", "profile", "questions")},
                                               "published": None})
        made = set()
        for source in certificate["questions"]["sources"]:
            path = self.folder / "made.jsonl"
            self.holds("generate", "--pair", source["pair"], "--family", source["family"], "--scalar", source["scalar"], "--count", source["count"],
                       "--seed", source["seed"], "-o", path)
            made |= {json.loads(one)["id"] for one in path.read_text().splitlines()[1:]}
        self.assertEqual(made, {json.loads(one)["id"] for one in self.exam.read_text().splitlines()[1:]})

    def test_two_exams_of_one_seed_have_other_commitments_and_another_order(self):
        self.set_exam(name="1")
        first = self.exam.read_text().splitlines()
        self.set_exam(name="2")
        second = self.exam.read_text().splitlines()
        self.assertEqual(sorted(first[1:]), sorted(second[1:]))
        self.assertNotEqual(first[1:], second[1:])
        self.assertNotEqual(json.loads(first[0])["commitment"], json.loads(second[0])["commitment"])

    def test_two_exams_have_no_question_in_common(self):
        asked = []
        for name in "12":
            self.set_exam(name=name, seed=None)
            asked.append(self.exam.read_text().splitlines()[1:])
        self.assertEqual((len(asked[0]), len(asked[1]), set(asked[0]) & set(asked[1])), (12, 12, set()))

    def test_an_exam_is_closed_once(self):
        self.set_exam()
        self.take()
        self.close()
        self.assertEqual(self.key_json()["used"], {"on": "2020-09-13", "answers": sha256(self.taken.read_text())})
        self.refused("2020-09-13", sha256(self.taken.read_text()), "an exam is closed once", args=self.closing())

    def test_of_several_that_close_an_exam_at_once_one_does(self):
        self.set_exam(families="generic,touching,near_touching")
        self.take()
        for attempt in range(3):
            key = json.loads(self.key.read_text())
            closing = [subprocess.Popen([TOOL, *map(str, self.closing("--certificate", self.folder / f"c{i}.json"))], stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, text=True) for i in range(4)]
            done = [(*process.communicate(timeout=300), process.returncode) for process in closing]
            self.assertEqual(sorted(code for _, _, code in done), [0, 2, 2, 2], done)
            self.assertTrue(all("an exam is closed once" in said for _, said, code in done if code == 2), done)
            self.assertEqual(len(list(self.folder.glob("c?.json"))), 1)
            self.file(self.key.name, line({**key, "used": None}))  # a copy from before: no file can forbid it
            for path in self.folder.glob("c?.json"):
                path.unlink()

    def test_an_exam_is_held_against_the_line_that_was_published(self):
        done = run("exam", "new", "-o", self.folder / "exam.jsonl", "--key", self.folder / "key.json", "--pair", "sphere_sphere",
                   "--family", "generic", "--count", 6, "--commit", env=PAST)
        self.assertEqual(done.returncode, 0)
        self.exam, self.key = self.folder / "exam.jsonl", self.folder / "key.json"
        [said] = done.stdout.splitlines()  # nothing else, so that a tag's message can be made of it
        header = json.loads(self.exam.read_text().splitlines()[0])
        self.assertEqual(said, f"contact-oracle exam: commitment {header['commitment']} questions {header['questions']}")
        self.take()
        self.assertIn(f"the line to hold it against: {said}", self.close())
        self.assertEqual({name: json.loads(self.certificate.read_text())["exam"][name] for name in ("issued", "profile", "published")},
                         {"issued": "2020-09-13", "profile": None, "published": said})
        self.assertIn("when the line was published", self.holds("verify", self.certificate, "--commitment", said + "\n"))
        self.assertIn("whether the line that the exam commits by was published", self.holds("verify", self.certificate))
        for place, name in ((said.index("commitment ") + 11, "commitment"), (len(said) - 1, "questions")):
            other = said[:place] + ("0" if said[place] != "0" else "1") + said[place + 1:]
            self.assertIn(f"/exam/{name}", self.refuted("verify", self.certificate, "--commitment", other))
        for other in ("", "x", said[:-1], said + " x", said.upper()):
            self.refused("--commitment", args=["verify", self.certificate, "--commitment", other])
        # What it states of its key is what it commits to.
        for old, new in (('"issued":"2020-09-13","nonce"', '"issued":"2020-09-12","nonce"'), ('"profile":null', '"profile":"game"'),
                         (f'"published":"{said}"', '"published":null')):
            with self.subTest(new):
                self.reseal(lambda text: text.replace(old, new))
                self.assertIn("/exam/commitment", self.refuted("verify", self.certificate))
                self.reseal(lambda text: text.replace(new, old))
        self.reseal(lambda text: text.replace('"issued":"2020-09-13","nonce"', '"issued":"2020-09-14","nonce"'))
        self.refused("exam.issued: it was closed on 2020-09-13", args=["verify", self.certificate])

    def test_where_nothing_was_published_the_certificate_says_so(self):
        self.set_exam()
        self.take()
        self.assertIn("nothing was published before the answers", self.close())
        self.assertIsNone(json.loads(self.certificate.read_text())["exam"]["published"])
        self.assertIn("not checked: that the exam was set before its answers: nothing was published", self.holds("verify", self.certificate))
        self.certificate = self.folder / "other.json"
        self.holds("certify", GENERIC, "--engine", "production", "--certificate", self.certificate)
        self.refused("is a certificate of no exam", args=["verify", self.certificate, "--commitment",
                                                         f"contact-oracle exam: commitment {'0' * 64} questions {'0' * 64}"])

    def test_a_key_of_the_first_version_is_closed_as_ever(self):
        self.set_exam()
        self.take()
        key = {name: value for name, value in self.key_json().items() if name != "published"}
        key["commitment"] = sha256(line({name: key[name] for name in ("generator", "seed", "nonce", "sources")}))
        self.file(self.key.name, line({**key, "version": 1}))
        header, *questions = self.exam.read_text().splitlines(True)
        self.file(self.exam.name, header.replace(json.loads(header)["commitment"], key["commitment"]) + "".join(questions))
        self.close()
        self.assertEqual(sorted(json.loads(self.certificate.read_text())["exam"]), ["commitment", "nonce", "questions"])
        self.assertEqual(self.key_json(), {**key, "version": 1, "used": {"on": "2020-09-13", "answers": sha256(self.taken.read_text())}})
        self.holds("verify", self.certificate, "--exam", self.exam)

    def test_a_key_is_never_written_over(self):
        self.set_exam()
        self.refused(self.key, "is there already", args=["exam", "new", "-o", self.folder / "other.jsonl", "--key", self.key,
                                                        "--pair", "sphere_sphere", "--family", "generic", "--count", 2])
        self.take()
        for options in (["--certificate", self.key], ["--json", self.taken], ["--markdown", self.exam, "--exam", self.exam]):
            with self.subTest(options[0]):
                self.refused(args=self.closing(*options))
        self.refused(args=["exam", "take", self.exam, "-o", self.exam, "--engine", "production"])

    def test_answers_of_which_none_is_judged_leave_the_key_as_it_was(self):
        self.set_exam()
        self.assertIn("0 of 12 questions answered by plain-float", self.take("--engine", "plain-float"))
        self.refused("no case was judged", args=self.closing())
        self.take()
        header, *said = map(json.loads, self.taken.read_text().splitlines())
        self.file("taken.jsonl", [header, *({"id": one["id"], "unsupported": "too hard"} for one in said)])
        self.refused("no case was judged", args=self.closing("--allow-unsupported"))
        self.take()
        self.close()

    def test_answers_that_no_certificate_can_name_leave_the_key_as_it_was(self):
        self.set_exam()
        self.take()
        before, strange = self.key.read_bytes(), self.folder / os.fsdecode(b"\xff.jsonl")
        strange.write_bytes(self.taken.read_bytes())
        self.refused("is not UTF-8", args=["exam", "close", "--key", self.key, "--results", strange, "--certificate", self.folder / "c.json"])
        self.assertEqual(self.key.read_bytes(), before)

    def test_a_key_that_was_changed_is_refused_and_stays_as_it_was(self):
        self.set_exam()
        self.take()
        whole = self.key.read_text()
        key = json.loads(whole)
        other = "0" * 64
        more = [{**key["sources"][0], "count": 5}, key["sources"][1]]
        changes = {"issued": "2020-09-12", "profile": "game", "published": not key["published"], "seed": key["seed"] ^ 1, "nonce": other, "sources": more, "commitment": other, "questions": other,
                   "generator": "contact-oracle 0.0.0", "version": 3, "format": "contact-oracle/exam", "used": {"on": "2020-09-13"}}
        for name, value in changes.items():
            with self.subTest(name):
                self.file(self.key.name, line({**key, name: value}))
                # What the digest is of says only that it is another.
                self.refused(self.key.name, "commitment" if name in ("issued", "profile", "published", "seed", "nonce", "sources") else name,
                             args=self.closing())
        self.file(self.key.name, line({**key, "issued": "today"}))
        self.refused("issued: expected a day", args=self.closing())
        # Bound anew, it is the key of other questions, and not of this exam.
        again = {**key, "seed": key["seed"] ^ 1}
        again["commitment"] = sha256(line({name: again[name] for name in COMMITTED}))
        self.file(self.key.name, line(again))
        self.refused("questions", "the key was changed", args=self.closing())
        for length in (0, 1, len(whole) // 2, len(whole) - 2):
            with self.subTest(length):
                self.file(self.key.name, whole[:length])
                self.refused(self.key.name, args=self.closing())
        self.file(self.key.name, whole)
        self.close()

    def test_a_key_with_a_profile_that_there_is_not_is_refused(self):
        self.set_exam()
        self.take()
        self.file(self.key.name, line({**self.key_json(), "profile": "gam"}))
        self.refused("profile", args=self.closing())

    def test_an_exam_that_was_changed_is_refused(self):
        self.set_exam()
        self.take()
        lines = self.exam.read_text().splitlines(True)
        question = json.loads(lines[1])
        question["contact"] += 1
        made = {json.loads(one)["id"]: one for one in lines[1:]}
        self.assertEqual(len(made), 12)
        identified = {key: value for key, value in question.items() if key != "id"}
        new = json.loads(self.holds("explain", "-", "--json", input=line(identified)))["id"]
        changes = {"a number": ("exam.jsonl:2", [lines[0], line(question) + "\n", *lines[2:]]),
                   "a number and its id": ("was changed", [lines[0], line({**question, "id": new}) + "\n", *lines[2:]]),
                   "a line left out": ("count", [lines[0], *lines[2:]]),
                   "a line twice": ("count", [*lines, lines[-1]]),
                   "another order": ("was changed", [lines[0], lines[2], lines[1], *lines[3:]]),
                   "no header": ("exam.jsonl:1", lines[1:]), "nothing": ("empty", []),
                   "half a line": ("truncated", [*lines[:-1], lines[-1][:-1]]), "less than half": ("exam.jsonl", [*lines[:-1], lines[-1][:20]]),
                   "header": ("version", [lines[0].replace('"version":1', '"version":2'), *lines[1:]]),
                   "a key of the header": ("colour", [lines[0].replace('"version":1', '"version":1,"colour":7'), *lines[1:]]),
                   "digest": ("questions", [re.sub('"questions":"........', '"questions":"00000000', lines[0]), *lines[1:]])}
        for name, (word, changed) in changes.items():
            with self.subTest(name):
                self.file(self.exam.name, "".join(changed))
                self.refused(word, args=["exam", "take", self.exam, "-o", self.folder / "other.jsonl", "--engine", "production"])
                self.refused(word, args=self.closing("--exam", self.exam))
        # Bound anew it can be taken, and is not the key's.
        body = "".join(changes["a number and its id"][1][1:])
        header = {**json.loads(lines[0]), "questions": sha256(body)}
        self.file(self.exam.name, line(header) + "\n" + body)
        self.holds("exam", "take", self.exam, "-o", self.folder / "other.jsonl", "--engine", "production")
        self.refused("questions", "are not those of the key", args=self.closing("--exam", self.exam))
        self.file(self.exam.name, line({**json.loads(lines[0]), "commitment": "0" * 64}) + "\n" + "".join(lines[1:]))
        self.refused("commitment", "is not that of the key", args=self.closing("--exam", self.exam))

    def test_the_exam_of_another_key_is_told(self):
        self.set_exam(name="other")
        other = self.exam
        self.set_exam()
        self.take()
        self.refused("commitment", "is not that of the key", args=self.closing("--exam", other))
        self.close()
        self.assertIn("/exam/commitment", self.refuted("verify", self.certificate, "--exam", other))
        self.holds("certify", GENERIC, "--engine", "production", "--certificate", self.folder / "plain.json")
        self.refused("exam", args=["verify", self.folder / "plain.json", "--exam", other])

    def test_answers_that_change_after_the_certificate_are_found(self):
        self.set_exam()
        self.take()
        self.close()
        whole = self.taken.read_text()
        self.file("taken.jsonl", whole.replace('"overlap":true', '"overlap":null', 1))
        self.assertIn("/answers/sha256", self.refuted("verify", self.certificate, "--exam", self.exam))
        self.file("taken.jsonl", whole)
        self.holds("verify", self.certificate, "--exam", self.exam)

    def test_a_certificate_of_another_nonce_or_seed_is_found(self):
        self.set_exam()
        self.take()
        self.close()
        nonce, seed = self.key_json()["nonce"], self.key_json()["seed"]
        for name, (old, new) in {"nonce": (nonce, "0" * 64), "seed": (f'"seed":{seed}', f'"seed":{seed ^ 1}'),
                                 "commitment": (self.key_json()["commitment"], "0" * 64)}.items():
            with self.subTest(name):
                self.reseal(lambda text: text.replace(old, new))
                self.assertIn("/exam/", self.refuted("verify", self.certificate))
                self.reseal(lambda text: text.replace(new, old))
        self.holds("verify", self.certificate)

    def test_a_dataset_is_no_exam_whatever_its_certificate_says(self):
        self.certificate = self.folder / "certificate.json"
        self.holds("certify", GENERIC, "--engine", "production", "--certificate", self.certificate)
        exam = line({"commitment": "0" * 64, "nonce": "0" * 64, "questions": "0" * 64})
        self.reseal(lambda text: text.replace('\n"format"', f'\n"exam":{exam},\n"format"'))
        self.refused("exam", args=["verify", self.certificate])

    def test_a_missing_answer_is_never_certified_and_one_to_no_question_is_told(self):
        self.set_exam()
        self.take()
        lines = self.taken.read_text().splitlines(True)
        self.file("taken.jsonl", "".join(lines[:-1]))
        self.assertIn("1 answer beyond it", self.close("--tolerance", "length=1e300,angle=3.15", code=1))
        self.assertEqual(json.loads(self.certificate.read_text())["found"]["total"]["answers"]["missing"], 1)
        for length in (10, len("".join(lines)) - 2):
            self.set_exam(name=str(length))
            self.file("taken.jsonl", "".join(lines)[:length])
            self.refused("taken.jsonl", args=self.closing())
            self.assertIsNone(self.key_json()["used"])

    def test_answers_that_claim_nothing_do_not_use_up_a_key(self):
        self.set_exam()
        self.take()
        self.file("taken.jsonl", self.taken.read_text().splitlines(True)[0])
        certificate = self.folder / "certificate.json"
        done = run(*self.closing("--certificate", certificate))
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        self.assertIsNone(self.key_json()["used"])
        self.assertFalse(certificate.exists())
        self.assertNotIn("stands in the certificate", done.stdout)

    def test_an_exam_of_a_profile_is_judged_by_its_tolerance(self):
        for off, code in ((5e-4, 0), (2e-2, 1)):
            self.set_exam("--profile", "game", name=str(code), families="generic")
            self.assertEqual((self.key_json()["profile"], self.key_json()["sources"][0]["scalar"]), ("game", "binary32"))
            self.take()
            header, *said = map(json.loads, self.taken.read_text().splitlines())
            for one in said:
                if one["contact"]:
                    one["contact"]["value"] += off
            self.file("taken.jsonl", [header, *said])
            printed = self.close(code=code)
            self.assertIn("within length 0.001, relative 1e-05, angle 0.01, for numbers from 0.0001 to 10000", printed.splitlines()[-5])
            self.assertEqual(json.loads(self.certificate.read_text())["found"]["tolerance"]["length"], 1e-3)
            self.assertIn("HOLDS", self.holds("verify", self.certificate, "--exam", self.exam))

    def test_a_level_or_a_tolerance_that_is_given_comes_before_the_profiles(self):
        for name, (options, word) in {"level": (("--level", "correctly-rounded"), "reaches correctly-rounded"),
                                      "tolerance": (("--tolerance", "length=0"), "CERTIFIED within length 0, "),
                                      "profile": (("--profile", "metrology"), "CERTIFIED within length 1e-07")}.items():
            with self.subTest(name):
                self.set_exam("--profile", "game", name=name, families="generic")
                self.take()
                self.assertIn(word, self.close(*options))

    def test_a_profile_leaves_families_out_that_nobody_meets(self):
        exam, key = self.folder / "e.jsonl", self.folder / "k.json"
        listed = [one["family"] for one in map(json.loads, self.holds("families", "--json").splitlines())
                  if one.get("shapes") == "cubes"]
        for profile, out in (("game", {"extreme_scale", "hard_to_round", "invalid"}), ("metrology", {"invalid"})):
            with self.subTest(profile):
                self.holds("exam", "new", "-o", exam, "--key", key, "--pair", "cube_cube", "--profile", profile, "--count", 2)
                found = {one["family"] for one in json.loads(key.read_text())["sources"]}
                self.assertEqual(found, set(listed) - out)
                key.unlink()

    def test_what_cannot_be_asked_is_refused(self):
        exam, key = self.folder / "e.jsonl", self.folder / "k.json"
        base = ["exam", "new", "-o", exam, "--key", key]
        for word, options in {"nowhere": ["--family", "nowhere"], "--count": ["--count", 0], "--profile": ["--profile", "sport"],
                              "--pair": ["--pair", "cube_sphere"], "--scalar": ["--scalar", "binary16"]}.items():
            with self.subTest(word):
                self.refused(word, args=[*base, *options])
        self.refused(args=["exam", "new", "-o", exam, "--key", exam])
        self.refused("--key", args=["exam", "new", "-o", exam])
        self.refused(args=["exam"])

    def test_questions_outside_the_domain_are_in_no_exam(self):
        self.refused("invalid", args=["exam", "new", "-o", self.folder / "e.jsonl", "--key", self.folder / "k.json", "--pair", "sphere_sphere",
                                      "--family", "generic,invalid", "--count", 2])

    def test_an_exam_of_binary64_is_not_taken_by_an_engine_of_binary32(self):
        self.set_exam()
        self.assertIn("0 of 12 questions answered", self.take("--engine", "plain-float"))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
