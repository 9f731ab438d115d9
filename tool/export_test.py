#!/usr/bin/env python3
"""Standalone tests in every language: a right engine passes, a wrong one and none at all fail, by the count that is known here.
python3 tool/export_test.py PATH_TO_TOOL [unittest arguments]. What is right comes from `explain`, which knows nothing of them."""
import contextlib
import io
import json
import math
import re
import shutil
import subprocess
import sys
import unittest

import cli_test
from cli_test import PAIRS, line, run, text

STRICT = ["-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Werror"]
NOT_FILLED_IN = "NOT FILLED IN: write the call of your engine into the function engine() of this file\n"
FIELDS = ("normal", "point1", "point2", "point")
# What is filled in: the answers come on standard input, one a line: 1 or 0, and the 13 numbers of an answer in its order.
C_BODY = """  double x[14];
  int i;
  (void)question;
  for (i = 0; i < 14; ++i)
    if (scanf("%lf", &x[i]) != 1) return 0;
  {0}hit = x[0] > 0;
  for (i = 0; i < 3; ++i) {{
    {0}normal[i] = (real)x[1 + i];
    {0}point1[i] = (real)x[4 + i];
    {0}point2[i] = (real)x[7 + i];
    {0}point[i] = (real)x[10 + i];
  }}
  {0}value = (real)x[13];
  return 1;
"""
C_EMPTY = "  (void)question;\n  (void)answer;\n  return {};\n"
PYTHON_BODY = """    hit, *x = map(float, sys.stdin.readline().split())
    return {"hit": hit > 0, "normal": x[0:3], "point1": x[3:6], "point2": x[6:9], "point": x[9:12], "value": x[12]}
"""
JS_BODY = """  engine.lines ??= require('fs').readFileSync(0, 'utf8').split('\\n');
  const [hit, ...x] = engine.lines.shift().split(' ').map(Number);
  const three = (i) => x.slice(i, i + 3);
  return {hit: hit > 0, normal: three(0), point1: three(3), point2: three(6), point: three(9), value: x[12]};
"""
RUST_BODY = """    let mut text = String::new();
    std::io::stdin().read_line(&mut text).unwrap();
    let x: Vec<Real> = text.split_whitespace().map(|x| x.parse().unwrap()).collect();
    let three = |i: usize| [x[i], x[i + 1], x[i + 2]];
    Some(Answer { hit: x[0] > 0.0, normal: three(1), point1: three(4), point2: three(7), point: three(10), value: x[13] })
"""
# The program that a language needs, the name of a file, what makes a program of it, what stands there to be filled in, and what is.
LANGUAGES = {
    "c": ("gcc", "t.c", ["gcc", "-std=c99", *STRICT, "t.c", "-lm", "-o", "t"], C_EMPTY.format(0), C_BODY.format("answer->")),
    "cpp": ("g++", "t.cpp", ["g++", "-std=c++17", *STRICT, "t.cpp", "-o", "t"], C_EMPTY.format("false"),
            C_BODY.format("answer.").replace("scanf", "std::scanf")),
    "cuda": ("g++", "t.cu", ["g++", "-std=c++17", *STRICT, "-x", "c++", "t.cu", "-o", "t"], C_EMPTY.format("false"),
             C_BODY.format("answer.").replace("scanf", "std::scanf")),
    "python": ("python3", "t.py", None, "    return None\n", PYTHON_BODY),
    "js": ("node", "t.js", None, "  return undefined;\n", JS_BODY),
    "rust": ("rustc", "t.rs", ["rustc", "-D", "warnings", "t.rs", "-o", "t"], "    None\n}\n// ---", RUST_BODY + "}\n// ---"),
}


def numbers_of(value):
    if isinstance(value, (list, dict)):
        return [x for one in (value.values() if isinstance(value, dict) else value) for x in numbers_of(one)]
    return [float(value)] if isinstance(value, (int, float)) and not isinstance(value, bool) else []


def answer_of(expect):
    """An answer of the default conventions, of what `explain` expects."""
    answer = {key: value for key, value in expect.items() if key in ("hit", "normal", "point1", "point2", "value")}
    return {**answer, "point": [math.nan] * 3}


def plain(answer):
    """An answer as one line of numbers."""
    values = [x for field in FIELDS for x in answer.get(field, [0, 0, 0])] + [answer.get("value", 0)]
    return " ".join(map(repr, [float(answer["hit"]), *map(float, values)]))


def off_by(question):
    """More than any tolerance of the level `bounded` in this question."""
    return 1e-320 + 1e-3 * max(map(abs, numbers_of([question["a"], question["b"], question["alarm"], question["contact"]])))


class Case(cli_test.Case):
    def export(self, language, *args):
        path = self.folder / LANGUAGES[language][1]
        self.holds("export", "--language", language, *args, "-o", path)
        return path

    def asked(self, *args):
        """A Python file, as a module: its questions, what `explain` expects of each, and a function that has an engine checked."""
        module = {"__name__": "standalone"}
        exec(self.export("python", *args).read_text(), module)
        questions = []

        def ask(engine):
            module["engine"] = engine
            told = io.StringIO()
            with contextlib.redirect_stdout(told):
                status = module["main"]()
            return status, told.getvalue()

        ask(lambda question: questions.append(question) or {"hit": True})
        expects = [json.loads(one)["expect"] for one in self.holds("explain", "-", "--json", stdin=text(questions)).splitlines()]
        self.assertEqual(len(expects), len(questions))

        def answered(answers):
            rest = iter(answers)
            return ask(lambda question: next(rest))

        return questions, expects, answered

    def count(self, told):
        """How many answers a run calls wrong, which the lines that it prints bear out."""
        status, output = told
        if status == 0:
            self.assertRegex(output, r"^\w+: all \d+ questions answered right\n$")
            return 0
        self.assertEqual(status, 1)
        wrong = int(re.search(r"\w+: (\d+) of \d+ questions answered wrong\n$", output)[1])
        self.assertEqual(output.count("WRONG {"), wrong)
        return wrong


class Pairs(Case):
    def test_right_answers_to_every_pair_pass_and_wrong_numbers_and_decisions_do_not(self):
        for pair in PAIRS:
            with self.subTest(pair):
                questions, expects, answered = self.asked("--pair", pair, "--count", 36)
                right = list(map(answer_of, expects))
                hits = [expect["hit"] for expect in expects]
                self.assertEqual(answered(right), (0, f"{pair}: all {len(right)} questions answered right\n"))
                self.assertTrue(0 < sum(hits) < len(hits))
                self.assertEqual(self.count(answered([{**one, "hit": not one["hit"]} for one in right])), len(right))
                if pair == "cube_cube":
                    continue

                def changed(change):
                    return [change(dict(one), off_by(question)) if one["hit"] else one for one, question in zip(right, questions)]

                def value(one, off):
                    return {**one, "value": one["value"] + off + 1e-3 * abs(one["value"])}

                def normal(one, off):
                    return {**one, "normal": [-x for x in one["normal"]]}

                def point(one, off):
                    return {**one, "point2": [x + off for x in one["point2"]]}

                self.assertEqual(self.count(answered(changed(value))), sum(hits))
                sure = [e["hit"] and not e["degenerate"] and e.get("unique", True) for e in expects]
                # Of what overlaps or is cast, a normal that is turned round may be right too: a triangle is hit from both of its sides.
                is_simple = PAIRS.index(pair) < PAIRS.index("cast_sphere")
                for change in (normal, point):
                    wrong = self.count(answered(changed(change)))
                    if pair == "cast_triangle" and change == normal:
                        self.assertEqual(wrong, 0)
                        continue
                    self.assertLessEqual(wrong, sum(hits))
                    self.assertGreaterEqual(wrong, sum(sure) if is_simple else 1)

    def test_a_wrong_answer_is_told_with_its_question_which_explain_reads(self):
        _, expects, answered = self.asked("--pair", "sphere_sphere", "--family", "generic", "--count", 12)
        answers = list(map(answer_of, expects))
        at = next(i for i, expect in enumerate(expects) if expect["hit"])
        answers[at]["value"] += 1
        status, output = answered(answers)
        self.assertEqual(status, 1)
        question, problem, summary = output.splitlines()
        self.assertEqual(json.loads(self.holds("explain", "-", "--json", stdin=question.removeprefix("WRONG ") + "\n"))["expect"], expects[at])
        self.assertRegex(problem, rf"^    value: expected {expects[at]['value']!r} within \S+, got {answers[at]['value']!r}$")
        self.assertEqual(summary, "sphere_sphere: 1 of 12 questions answered wrong")

    def test_a_number_may_be_off_by_the_bound_and_no_more(self):
        for scalar, digits in (("binary64", 53), ("binary32", 24)):
            questions, expects, answered = self.asked("--pair", "sphere_sphere", "--family", "generic", "--count", 30, "--scalar", scalar)
            answers = list(map(answer_of, expects))
            self.assertEqual(answered(answers)[0], 0)
            for ulps, is_right in ((7, True), (12, False)):
                moved = []
                for question, answer in zip(questions, answers):
                    a, b = question["a"], question["b"]
                    scale = max(math.dist(a["center"], b["center"]), a["radius"] + b["radius"], question["contact"])
                    ulp = 2.0 ** (math.frexp(scale)[1] - digits)
                    moved.append({**answer, "value": answer["value"] + ulps * ulp} if answer["hit"] else answer)
                self.assertEqual(self.count(answered(moved)), 0 if is_right else sum(one["hit"] for one in answers))

    def test_another_answer_that_is_as_right_passes(self):
        # Where centres coincide, any unit vector is right, and another vector is not.
        questions, expects, answered = self.asked("--pair", "sphere_sphere", "--family", "coincident", "--count", 20)
        self.assertTrue(all(expect["degenerate"] for expect in expects if expect["hit"]))
        for length, is_right in ((1, True), (1.001, False)):
            answers = []
            for question, expect in zip(questions, expects):
                n = [0, 0.6 * length, -0.8 * length]
                a, b = question["a"], question["b"]
                answers.append({**expect, "normal": n, "point1": [c + a["radius"] * x for c, x in zip(a["center"], n)],
                                "point2": [c - b["radius"] * x for c, x in zip(b["center"], n)]})
            self.assertEqual(answered(answers)[0] == 0, is_right)
        # A box in the middle of another may leave it on either side.
        questions, expects, answered = self.asked("--pair", "sphere_cube", "--family", "inside,on_boundary", "--count", 40)
        turned = 0
        answers = []
        for question, expect in zip(questions, expects):
            answer = answer_of(expect)
            if expect["hit"] and expect["degenerate"]:
                c, (low, high) = question["a"]["center"], (question["b"]["min"], question["b"]["max"])
                depths = {(axis, sign): c[axis] - low[axis] if sign > 0 else high[axis] - c[axis] for axis in range(3) for sign in (1, -1)}
                least = min(depths.values())
                axis, sign = [way for way in depths if depths[way] == least][-1]
                n = [sign * (i == axis) for i in range(3)]
                if least > 0 and n != expect["normal"]:
                    turned += 1
                    foot = [(low if sign > 0 else high)[i] if i == axis else c[i] for i in range(3)]
                    answer |= {"normal": n, "point1": [x + question["a"]["radius"] * y for x, y in zip(c, n)], "point2": foot}
            answers.append(answer)
        self.assertGreater(turned, 0)
        self.assertEqual(answered(answers)[0], 0, answered(answers)[1])


class Conventions(Case):
    def judged(self, args, change, pair="sphere_sphere", families="generic", count=24):
        """Has the answers of the default conventions checked as they are, and changed to what these conventions ask for: how many are
        wrong, and of how many hits."""
        questions, expects, answered = self.asked("--pair", pair, "--family", families, "--count", count, *args)
        answers = list(map(answer_of, expects))
        changed = [change(question, dict(answer)) if answer["hit"] else answer for question, answer in zip(questions, answers)]
        return self.count(answered(changed)), self.count(answered(answers)), sum(answer["hit"] for answer in answers)

    def test_each_asks_for_the_numbers_that_it_means(self):
        def middle(q, one):
            return {**one, "point": [x / 2 + y / 2 for x, y in zip(one["point1"], one["point2"])], "point1": None, "point2": None}

        def far(q, one):
            return {**one, **{f"point{i}": [c - side * q[s]["radius"] * n for c, n in zip(q[s]["center"], one["normal"])]
                              for i, s, side in ((1, "a", 1), (2, "b", -1))}}

        for args, change in ((("--normal", "second-to-first"), lambda q, one: {**one, "normal": [-x for x in one["normal"]]}),
                             (("--value", "depth"), lambda q, one: {**one, "value": -one["value"]}),
                             (("--value-less-contact", "false"), lambda q, one: {**one, "value": one["value"] + q["contact"]}),
                             (("--points", "center"), lambda q, one: {**one, "point1": q["a"]["center"], "point2": q["b"]["center"]}),
                             (("--points", "midpoint"), middle), (("--points", "published"), far)):
            with self.subTest(args):
                wrong, as_they_are, hits = self.judged(args, change)
                self.assertEqual(wrong, 0)
                self.assertGreater(as_they_are, hits / 2)  # all that the convention changes: a contact distance may be 0
        nothing = {"normal": None, "point1": None, "point2": None, "value": None}
        for args, change in ((("--normal", "none", "--points", "none", "--value", "none"), lambda q, one: {**one, **nothing}),
                             (("--points", "first_only"), lambda q, one: {**one, "point2": None}),
                             (("--points", "second_only"), lambda q, one: {**one, "point1": None}),
                             (("--normal-unit", "false"), lambda q, one: {**one, "normal": [7 * x for x in one["normal"]]})):
            with self.subTest(args):
                self.assertEqual(self.judged(args, change)[:2], (0, 0))
        self.assertEqual(self.judged((), lambda q, one: {**one, "normal": [7 * x for x in one["normal"]]})[0::2],
                         (self.judged((), lambda q, one: one)[2],) * 2)

    def test_decisions_at_the_limit_and_where_centres_coincide_are_as_they_say(self):
        def none(q, one):
            return {"hit": False}

        self.assertEqual(self.judged(("--coincident", "zero_normal"),
                                     lambda q, one: {**one, "normal": [0, 0, 0], "point1": q["a"]["center"], "point2": q["b"]["center"]},
                                     families="coincident")[0], 0)
        wrong, as_they_are, hits = self.judged(("--coincident", "no_contact"), none, families="coincident")
        self.assertEqual((wrong, as_they_are), (0, hits))
        closed = self.judged(("--touching", "open", "--margin", "exclusive"), lambda q, one: one, families="touching")
        self.assertEqual(closed[1], closed[2])  # all that just touch are hits elsewhere
        self.assertEqual(self.judged(("--margin", "none"), lambda q, one: one, families="touching")[0], 0)

    def test_a_tolerance_is_what_is_allowed(self):
        args = ("--tolerance", "length=1e-3,angle=1e-2")
        for share, is_right in ((0.9, True), (1.1, False)):
            def moved(q, one, share=share):
                return {**one, "value": one["value"] - 1e-3 * share, "point1": [x + 1e-3 * share for x in one["point1"]]}

            def turned(q, one, share=share):
                n = one["normal"]
                axis = min(range(3), key=lambda i: abs(n[i]))
                across = [(i == axis) - n[axis] * n[i] for i in range(3)]
                size = math.hypot(*across)
                return {**one, "normal": [math.cos(1e-2 * share) * x + math.sin(1e-2 * share) * y / size for x, y in zip(n, across)]}

            for change in (moved, turned):
                with self.subTest(share=share, change=change.__name__):
                    wrong, as_they_are, hits = self.judged(args, change, pair="sphere_plane", count=40)
                    self.assertEqual((wrong, as_they_are), (0 if is_right else hits, 0))
        # What is as near to the other decision is left out, which here is all of it.
        self.refused(("export", "--language", "c", "--pair", "sphere_sphere", "--family", "touching", "--tolerance", "relative=1e-9",
                      "-o", self.folder / "t.c"), "either decision is within the tolerance")
        self.assertFalse((self.folder / "t.c").exists())

    def test_where_the_answer_jumps_that_of_shapes_within_the_tolerance_passes(self):
        for pair, families in (("capsule_capsule", "parallel,ties"), ("sphere_cube", "inside,region_edge"), ("obb_obb", "deep,near_tied_depths"),
                               ("sphere_triangle", "on_triangle,region_edge"), ("cast_cube", "through_edge,ties"), ("triangle_line", "generic")):
            tolerance = 1e-6
            questions, _, answered = self.asked("--pair", pair, "--family", families, "--count", 40,
                                                "--tolerance", f"length={tolerance},relative={tolerance},angle=1e-2")
            moved = []
            for i, question in enumerate(questions):
                near = json.loads(line(question))
                place = next(one for one in (near["a"].get(name) for name in ("start", "center", "origin", "vertices")) if one)
                place = place[i % 3] if isinstance(place[0], list) else place
                place[i % 3] += tolerance * (1 if i % 2 else -1) / 2
                near["alarm"] += 1  # a hit that is moved stays one
                moved.append(near)
            expects = [json.loads(one)["expect"] for one in self.holds("explain", "-", "--json", stdin=text(moved)).splitlines()]
            self.assertEqual(len(expects), len(questions))
            # The decisions are those of the questions as they stand.
            first = [json.loads(one)["expect"]["hit"] for one in self.holds("explain", "-", "--json", stdin=text(questions)).splitlines()]
            answers = [answer_of(expect) if hit else {"hit": False} for expect, hit in zip(expects, first)]
            with self.subTest(pair):
                self.assertEqual(answered(answers)[0], 0, answered(answers)[1])


class Filled(Case):
    def run_file(self, language, stdin):
        _, file, build, _, _ = LANGUAGES[language]
        if build:
            command = [self.folder / "t"]
        else:
            command = [sys.executable if language == "python" else "node", self.folder / file]
        return subprocess.run(command, input=stdin, capture_output=True, text=True, timeout=300, cwd=self.folder)

    def build(self, language):
        if command := LANGUAGES[language][2]:
            done = subprocess.run(command, capture_output=True, text=True, timeout=300, cwd=self.folder)
            self.assertEqual((done.returncode, done.stderr), (0, ""))

    def check(self, language, pairs, scalar="binary64"):
        program, _, _, empty, body = LANGUAGES[language]
        if not shutil.which(program):
            self.skipTest(f"no {program} here")
        for i, pair in enumerate(pairs):
            with self.subTest(pair):
                args = ("--pair", pair, "--count", 30, "--scalar", scalar)
                _, expects, _ = self.asked(*args)
                answers = list(map(answer_of, expects))
                path = self.export(language, *args)
                if i == 0:
                    self.build(language)
                    done = self.run_file(language, "")
                    self.assertEqual((done.returncode, done.stdout, done.stderr), (1, NOT_FILLED_IN, ""))
                source = path.read_text()
                self.assertEqual(source.count(empty), 1)
                path.write_text(source.replace(empty, body))
                self.build(language)
                done = self.run_file(language, text(map(plain, answers)))
                self.assertEqual((done.returncode, done.stdout, done.stderr), (0, f"{pair}: all 30 questions answered right\n", ""))
                sure = [i for i, e in enumerate(expects) if e["hit"] and (len(e) == 1 or (not e["degenerate"] and e.get("unique", True)))]
                first, second, third = sure[:3]
                answers[first]["hit"] = False
                if "value" in answers[first]:
                    answers[second]["normal"] = [-x for x in answers[second]["normal"]]
                    answers[third]["value"] = answers[third]["value"] * 1.01 + 1
                    problems, wrong = ["    hit: expected", "    normal: expected", "    value: expected"], 3
                else:
                    problems, wrong = ["    hit: expected"], 1
                done = self.run_file(language, text(map(plain, answers)))
                self.assertEqual((done.returncode, done.stderr), (1, ""))
                told = done.stdout.splitlines()
                self.assertEqual([one[:len(problem)] for one, problem in zip(told[1::2], problems)], problems)
                self.assertEqual(told[-1], f"{pair}: {wrong} of 30 questions answered wrong")
                questions = [one.removeprefix("WRONG ") for one in told[:-1:2]]
                again = [json.loads(one)["expect"] for one in self.holds("explain", "-", "--json", stdin=text(questions)).splitlines()]
                self.assertEqual(again, [expects[i] for i in (first, second, third)[:wrong]])


class Languages(Filled):
    def test_c(self):
        self.check("c", ("sphere_capsule", "cube_cube", "hull_hull"))

    def test_cpp(self):
        self.check("cpp", ("sphere_obb", "capsule_hull"), "binary32")

    def test_cuda(self):
        self.check("cuda", ("triangle_line", "hull_plane"))

    def test_python(self):
        self.check("python", ("cast_sphere", "cube_cube", "triangle_hull"))

    def test_js(self):
        self.check("js", ("sphere_triangle", "cube_cube", "hull_hull"))


class Rust(Filled):  # apart: where there is no compiler, it may be skipped
    def test_rust(self):
        self.check("rust", ("capsule_plane", "hull_hull"))


class Usage(Case):
    ARGS = ("--language", "c", "--pair", "sphere_sphere", "--count", 9)

    def test_a_file_is_the_same_every_time_and_says_how_to_make_it_again(self):
        path = self.folder / "t.c"
        said = self.holds("export", *self.ARGS, "--points", "center", "-o", path)
        self.assertRegex(said, r"t\.c: 9 questions, \d of them hits; fill in its function engine\(\)\n")
        first = path.read_text()
        self.assertNotIn(str(self.folder), first)
        head = " ".join(first.split("*/")[0].replace("*", " ").split())
        again = re.search(r"Made by contact-oracle \S+ contact-oracle (.*? -o FILE) ", head)[1].replace("FILE", "t.c")
        self.holds(*again.split(), cwd=self.folder)
        self.assertEqual(path.read_text(), first)

    def test_what_cannot_be_asked_is_refused_and_leaves_no_file(self):
        path = self.folder / "t.c"
        for more, words in ((("--family", "nonesuch"), ("--family", "nonesuch", "generic")), (("--family", "invalid"), ("invalid", "answer")),
                            (("--tolerance", "length=-1"), ("tolerance",)), (("--count", "0"), ("--count",)), (("--points", "middle"), ("--points",)),
                            (("--points", "manifold"), ("--points", "manifold", "certify"))):
            with self.subTest(more):
                self.refused(("export", *self.ARGS[:4], *more, "-o", path), *words, one_line=False)
                self.assertFalse(path.exists())
        self.refused(("export", "--language", "cobol", *self.ARGS[2:], "-o", path), "cobol", one_line=False)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
