#!/usr/bin/env python3
"""Does verify.py accept what is right, and find each single thing that is wrong?  python3 golden/verify_test.py PATH_TO_TOOL"""
import contextlib
import hashlib
import io
import itertools
import json
import math
import os
import random
import re
import struct
import subprocess
import sys
import tempfile
import unittest
import unittest.mock
from fractions import Fraction
from pathlib import Path

TOOL = os.path.abspath(sys.argv[1]) if len(sys.argv) > 1 else sys.exit(__doc__)
GOLDEN = Path(__file__).resolve().parent
sys.path.insert(0, str(GOLDEN))
from verify import leaves, right_case, rounded, spelt
VERIFY = GOLDEN / "verify.py"
BALLS = {"a": {"center": [0, 0, 0], "radius": 1}, "b": {"center": [1, 2, 2], "radius": 2}, "alarm": 0, "contact": 0}
BALL = {"center": [0, 0, 0], "radius": 1}
BOX = {"min": [0, 0, 0], "max": [1, 1, 2]}
CAPSULE = {"start": [0, 0, 0], "end": [1, 1, 2], "radius": 1}
KINDS = {"sphere_sphere": (BALL, BALL), "cube_cube": (BOX, BOX), "sphere_cube": (BALL, BOX), "sphere_capsule": (BALL, CAPSULE),
         "capsule_capsule": (CAPSULE, CAPSULE), "ray_sphere": ({"origin": [0, 0, 0], "direction": [1, 1, 2], "length": 1}, BALL)}
FORM = 'form: expected "canonical", got "other keys, order or spaces"'
LARGEST = sys.float_info.max
LARGEST32 = float.fromhex("0x1.fffffep127")


def run(*command, **options):
    return subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=600, **options)


CODE = compile(VERIFY.read_text(), VERIFY, "exec")


def verify(*paths):
    """What the program says and how it ends, in this process: to start another takes longer than most files."""
    out, err = io.StringIO(), io.StringIO()
    with unittest.mock.patch.object(sys, "argv", [VERIFY, *map(str, paths)]), contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            exec(CODE, {"__name__": "__main__"})
        except SystemExit as end:
            return subprocess.CompletedProcess(paths, end.code, out.getvalue(), err.getvalue())


def question(c1, r1, c2, r2, alarm=0, contact=0, **more):
    return {**more, "a": {"center": c1, "radius": r1}, "b": {"center": c2, "radius": r2}, "alarm": alarm, "contact": contact}


def capsules(start, end, r, start2, end2, r2, alarm=0, contact=0, **more):
    return {**more, "pair": "capsule_capsule", "a": {"start": start, "end": end, "radius": r},
            "b": {"start": start2, "end": end2, "radius": r2}, "alarm": alarm, "contact": contact}


def single(x):
    """The binary32 number next to x."""
    return struct.unpack(">f", struct.pack(">f", x))[0]


def step(text, by=1, single=False):
    """The number next to the one spelt, in binary64 or in binary32, spelt as Python does (which is canonical for these)."""
    x = float(text)
    code = (">f", ">i") if single else (">d", ">q")
    bits, = struct.unpack(code[1], struct.pack(code[0], abs(x)))
    return repr(math.copysign(struct.unpack(code[0], struct.pack(code[1], bits + by))[0], x))


def from_boundary(a, b, D, scalar):
    """How far a + b sqrt(D) lies from the nearest middle of two neighbours, in ulps of the rounded; 0 only there."""
    value = rounded(a, b, D, scalar)
    as_float, as_bits = (">d", ">q") if scalar == "binary64" else (">f", ">i")
    bits, = struct.unpack(as_bits, struct.pack(as_float, abs(value)))
    last = 0x7FF << 52 if scalar == "binary64" else 0xFF << 23
    near = lambda n: Fraction(struct.unpack(as_float, struct.pack(as_bits, n))[0])
    bits = min(bits, last - 1)
    ulp = near(bits + 1) - near(bits) if bits + 1 < last else near(bits) - near(bits - 1)
    middles = [near(bits) + ulp / 2, (near(bits) + near(bits - 1)) / 2 if bits else -ulp / 2]
    sign = -1 if value < 0 or (value == 0 and a + b < 0) else 1
    distances = []
    for middle in middles:
        c = a - sign * middle  # and c + b sqrt(D) is the distance
        if c * c == b * b * D and c * b <= 0:
            return 0
        square = b * b * D  # 2^-9000 is far below all
        root = Fraction(math.isqrt(square.numerator * 4**9000 // square.denominator), 2**9000) * (1 if b > 0 else -1)
        distances.append(abs(c + root) / ulp)
    return min(distances)


def floor_log2(x):
    twos = x.numerator.bit_length() - x.denominator.bit_length()
    return twos if Fraction(2) ** twos <= x else twos - 1


def closest_of(path):
    """What the manifest says of a file, anew; of every hit whether it is flagged hard and a tie, and whether it is."""
    header, *cases = [json.loads(line) for line in path.read_text().splitlines()]
    closest, flags = {}, {}
    for case in (case for case in cases if case["expect"]["hit"]):
        (c1, r1), (c2, r2) = ((list(map(Fraction, s["center"])), Fraction(s["radius"])) for s in (case["a"], case["b"]))
        delta = [q - p for p, q in zip(c1, c2)]
        D = sum(d * d for d in delta)
        numbers = [("value", -r1 - r2 - Fraction(case["contact"]), Fraction(1))]
        for field, c, r in (("normal", [Fraction(0)] * 3, 1), ("point1", c1, r1), ("point2", c2, -r2)):
            numbers += [(field, c[i], r * delta[i] / D) for i in range(3)]
        found = [(field, from_boundary(a, b, D, header["scalar"])) for field, a, b in numbers]
        flags[case["id"]] = ("HardToRound" in case["flags"], "Tie" in case["flags"]), (
            any(0 < ulps <= Fraction(1, 2**20) for _, ulps in found), any(ulps == 0 for _, ulps in found))
        for field, ulps in found:
            if ulps and (field not in closest or ulps < closest[field][0]):
                closest[field] = ulps, case["id"]
    return {field: {"log2_ulps": floor_log2(ulps), "id": id} for field, (ulps, id) in closest.items()}, flags


class Case(unittest.TestCase):
    maxDiff = 2000

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def file(self, name, lines):
        path = self.folder / name
        path.write_bytes(lines if isinstance(lines, bytes) else "".join(one + "\n" for one in lines).encode())
        return path

    def several_faults(self, pair):
        """Questions with two numbers outside the domain each, expecting that the first of them is named."""
        shapes = [(s, *field) for s, shape in zip("ab", KINDS[pair]) for field in shape.items()]
        faults = {f"{s}.{key}": (s, key, None, -1) for s, key, value in shapes if value == 1}
        vectors = [(s, key, -math.inf if i % 2 else math.nan) for i, (s, key, value) in enumerate(shapes) if value != 1]
        faults |= {f"{s}.{key}[{axis}]": (s, key, axis, wrong) for s, key, wrong in vectors for axis in range(3)}
        order = [f"{s}.{key}" + (f"[{axis}]" if value != 1 else "") for s, key, value in shapes for axis in range(3 if value != 1 else 1)]
        faults = {path: faults[path] for path in order} | {"alarm": (None, "alarm", None, -0.5), "contact": (None, "contact", None, math.inf)}
        lines = []
        for i, (one, _) in enumerate(faults.items()):
            for other in list(faults)[i + 1:]:
                case = json.loads(json.dumps({**dict(zip("ab", KINDS[pair])), "alarm": 0, "contact": 0}))
                for shape, key, axis, value in (faults[one], faults[other]):
                    fields = case[shape] if shape else case
                    fields[key] = value if axis is None else [value if i == axis else x for i, x in enumerate(fields[key])]
                numbers = [float(x) for word in (*case["a"].values(), *case["b"].values(), case["alarm"], case["contact"])
                           for x in (word if isinstance(word, list) else [word])]
                packed = b"".join(b"\x7f\xf8" + bytes(6) if math.isnan(x) else struct.pack(">d", x) for x in numbers)
                case = {"id": hashlib.sha256(pair.encode() + b"\0" + packed).hexdigest()[:24], **case,
                        "flags": ["Invalid"], "expect": {"rejected": one}}
                lines.append(re.sub("NaN|-?Infinity", r'"\g<0>"', json.dumps(case, separators=(",", ":"))))
        header = (GOLDEN / "sphere_sphere" / "invalid.jsonl").read_text().splitlines()[0].replace('"sphere_sphere"', f'"{pair}"')
        return [re.sub(r'"count":\d+', f'"count":{len(lines)}', header), *lines]

    def accepted(self, *paths, verify=verify):
        done = verify(*paths)
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout[-1500:])
        self.assertRegex(done.stdout, r"\A[1-9]\d* cases: all right\n\Z")

    def annotated(self, *queries):
        path = self.folder / "annotated.jsonl"
        done = run(TOOL, "annotate", "-", "-o", path, input="".join(json.dumps(query) + "\n" for query in queries))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        lines = path.read_text().splitlines()
        path.unlink()
        return lines

    def finds(self, lines, *complaints):
        """Exit code 1 and these complaints, each the beginning of one, and no others; lint refuses the file as well."""
        path = self.file("wrong.jsonl", lines)
        done = verify(path)
        self.assertEqual((done.returncode, done.stderr), (1, ""), done.stdout[-800:])
        found = [one.removeprefix(f"{path}:") for one in done.stdout.splitlines()[:-1]]
        self.assertEqual(len(found), len(complaints), found)
        for complaint in complaints:
            self.assertTrue(any(one.startswith(complaint) for one in found), (found, complaint))
        self.assertEqual(run(TOOL, "lint", path).returncode, 2)


class EveryCaseCampaign(Case):
    """What `Right` sees of every file: the cases between those that it asks for, and the committed manifest."""

    def test_every_committed_file_and_the_manifest_are_accepted(self):
        self.accepted(GOLDEN)


class Right(Case):
    def test_every_sixty_fourth_case_of_every_committed_file_is_accepted(self):
        for path in GOLDEN.rglob("*.jsonl"):
            header, *cases = path.read_text().splitlines()
            if "recorded" not in path.parts:
                self.file("-".join(path.relative_to(GOLDEN).parts),
                          [re.sub(r'"count":\d+', f'"count":{len(cases[::64])}', header), *cases[::64]])
        self.assertGreater(len(list(self.folder.iterdir())), 250)
        self.accepted(self.folder, verify=lambda folder: run(sys.executable, VERIFY, folder))

    def test_the_program_is_short_enough_to_be_read_and_the_page_about_it_shows_what_it_prints(self):
        self.assertLess(len(VERIFY.read_text().splitlines()), 600)
        page = (GOLDEN.parent / "docs" / "golden.md").read_text()
        shown = re.search(r"```text\n(golden/(.*?):2: .*: expected (.*), got (.*))\n```", page)
        text = (GOLDEN / shown[2]).read_text()
        path = self.file("wrong.jsonl", text.replace(shown[3], shown[4], 1).splitlines())
        self.assertEqual(verify(path).stdout.splitlines()[0].replace(str(path), f"golden/{shown[2]}"), shown[1])

    def test_hard_questions_are_as_close_and_flagged_as_the_manifest_and_the_lines_say(self):
        manifest = {entry["path"]: entry for entry in json.loads((GOLDEN / "manifest.json").read_text())["files"]}
        for name in ("hard_to_round.jsonl", "hard_to_round.f32.jsonl", "hardest.jsonl", "hardest.f32.jsonl", "generic.jsonl"):
            with self.subTest(name):
                closest, flags = closest_of(GOLDEN / "sphere_sphere" / name)
                self.assertEqual(manifest[f"sphere_sphere/{name}"]["closest"], closest)
                for id, (given, right) in flags.items():
                    self.assertEqual(given, right, id)

    def test_the_hardest_questions_are_those_that_their_program_makes(self):
        for scalar, name in (("binary64", "hardest.jsonl"), ("binary32", "hardest.f32.jsonl")):
            made = run(sys.executable, GOLDEN / "hardest.py", scalar)
            self.assertEqual(made.returncode, 0, made.stderr)
            path = self.folder / name
            self.assertEqual(run(TOOL, "annotate", "-", "--family", "hardest", "-o", path, input=made.stdout).returncode, 0)
            self.assertEqual(path.read_bytes(), (GOLDEN / "sphere_sphere" / name).read_bytes())

    def test_letters_beyond_ascii_are_read_and_shown_as_they_are(self):
        header, *cases = (GOLDEN / "cube_cube" / "flat.jsonl").read_text().splitlines()
        self.accepted(self.file("d.jsonl", [re.sub('"generator":"[^"]*"', '"generator":"Gödel 1"', header), *cases]))
        done = verify(self.file("d.jsonl", [header.replace('"nearest_surface"', '"über"'), *cases]))
        self.assertEqual(done.stdout.splitlines()[0], f'{self.folder}/d.jsonl:1: points: expected "nearest_surface", got "über"')

    def test_a_shard_and_a_file_without_flags_are_accepted(self):
        path = self.folder / "shard.jsonl"
        made = run(TOOL, "generate", "--pair", "sphere_sphere", "--family", "generic", "--count", 9, "--seed", 2**64 - 1,
                   "--shard", "1/3", "-o", path)
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertIn('"shard":[1,3]', path.read_text())
        self.accepted(path)

    def test_of_several_numbers_outside_the_domain_the_first_is_named(self):
        for pair in KINDS:
            path = self.file(f"{pair}.jsonl", self.several_faults(pair))
            self.accepted(path)
            linted = run(TOOL, "lint", path)
            self.assertEqual(linted.returncode, 0, linted.stderr)

    def test_a_hull_of_the_corners_of_another_shape_is_answered_as_that_shape(self):
        draw, hits = random.Random(64), {True: 0, False: 0}
        core = {"capsule": lambda s: ([s["start"], s["end"]], s["radius"]), "triangle": lambda s: (s["vertices"], 0.0)}

        def as_hull(kind, shape):  # in any order, some corners again
            corners, radius = core[kind](shape)
            corners = corners + draw.choices(corners, k=draw.randrange(3))
            return {"vertices": draw.sample(corners, len(corners)), "radius": radius}

        for path in (path for pair in ("capsule_triangle", "triangle_triangle") for path in (GOLDEN / pair).glob("*.jsonl")):
            header, *cases = map(json.loads, path.read_text().splitlines())
            kinds = header["pair"].split("_")
            for case in cases[::16] if "rejected" not in cases[0]["expect"] else []:
                found = leaves(case)
                derived = lambda leaves: {x: spelt(leaf) for x, leaf in leaves.items() if x.startswith("e")}
                hits[case["expect"]["hit"]] += 1
                for pair, replaced in ((f"{kinds[0]}_hull", "b"), ("hull_hull", "ab")):
                    asked = {**case, **{s: as_hull(kind, case[s]) for s, kind in zip("ab", kinds) if s in replaced}}
                    right = right_case(leaves(asked), pair, header["scalar"])
                    self.assertEqual(derived(right), derived(found), (pair, case["id"]))
        self.assertGreater(min(hits.values()), 20, hits)

    # Random questions of this test's own, not of the program's families, so that both are asked what neither chose.
    def foreign(self, scalar, seed):
        draw = random.Random(seed)
        to = single if scalar == "binary32" else float
        largest = LARGEST32 if scalar == "binary32" else LARGEST
        bits, code, top = (23, (">I", ">f"), 255) if scalar == "binary32" else (52, (">Q", ">d"), 2047)
        pattern = lambda low, high: struct.unpack(code[1], struct.pack(
            code[0], draw.randrange(low, high) << bits | draw.getrandbits(bits)))[0]
        anything = lambda: draw.choice((-1, 1)) * pattern(0, top)
        ordinary = lambda: to(draw.uniform(-10, 10))
        tiny = lambda: draw.choice((-1, 1)) * draw.choice((pattern(0, 1), pattern(0, 3), 0.0))
        huge = lambda: draw.choice((-1, 1)) * pattern(top - 2, top)
        whole = lambda: to(draw.randrange(-2**draw.randrange(1, bits), 2**draw.randrange(1, bits)))
        kinds = (anything, ordinary, tiny, huge, whole)

        def ball_pair():
            number = draw.choice(kinds)
            kind = draw.randrange(6)
            c1 = [number() for _ in range(3)]
            if kind == 0:  # one centre for both
                return question(c1, abs(number()), c1, abs(number()), abs(number()), abs(number()))
            if kind == 1:  # Pythagorean: the distance is a number, and so are ties of what is computed from it
                m, n, scale = draw.randrange(1, 9), draw.randrange(1, 9), 2.0 ** draw.randrange(-60, 60)
                legs = [(m * m - n * n) * scale, 2 * m * n * scale, 0.0]
                half = (m * m + n * n) * scale * 2.0 ** -(bits + 1) * draw.randrange(1, 4)
                draw.shuffle(legs)
                reach = (m * m + n * n) * scale
                return question([0, 0, 0], half, legs, 0, reach, half * draw.randrange(0, 3))
            if kind == 2:  # along an axis
                c2 = list(c1)
                c2[draw.randrange(3)] = number()
            elif kind == 3:  # centres an ulp or so apart, where the first ones are finite after the step
                c2 = [to(x * (1 + draw.randrange(-2, 3) * 2.0**-bits)) for x in c1]
                c2 = [y if math.isfinite(y) else x for x, y in zip(c1, c2)]
            else:
                c2 = [draw.choice((number, draw.choice(kinds)))() for _ in range(3)]
            r1, r2 = abs(number()), abs(draw.choice(kinds)())
            far = max(abs(x - y) for x, y in zip(c1, c2))
            if draw.random() < 0.7:  # more hits than chance gives
                r1 = max(r1, to(min(far, largest)))
            return question(c1, r1, c2, r2, draw.choice((0, abs(number()))), draw.choice((0, abs(number()))))

        def box():
            sides = [sorted((draw.choice(kinds)(), draw.choice(kinds)())) for _ in range(3)]
            return {"min": [low for low, _ in sides], "max": [high for _, high in sides]}

        def box_pair():
            a, b = box(), box()
            if draw.random() < 0.4:
                axis = draw.randrange(3)
                b["min"][axis] = a["max"][axis]
                b["max"][axis] = max(b["max"][axis], b["min"][axis])
            return {"a": a, "b": b, "alarm": draw.choice((0, abs(draw.choice(kinds)()))), "contact": 0}

        def capsule_pair():
            number = draw.choice((ordinary, ordinary, *kinds, lambda: float(draw.randrange(-4, 5))))
            vector = lambda: [number() for _ in range(3)]
            start, end, start2, end2 = (vector() for _ in range(4))
            kind, factor = draw.randrange(6), draw.choice((-2.0, -1.0, 0.5, 1.0))
            along = lambda x, part: [to(max(-largest, min(c + part * (e - s), largest))) for c, s, e in zip(x, start, end)]
            if kind == 0:  # parallel, where no sum is rounded
                end2 = along(start2, factor)
            elif kind == 1:  # in a line
                start2, end2 = along(start, draw.choice((0.0, 0.5, 1.0, 2.0))), along(start, factor)
            elif kind == 2:  # crossing, or beginning in the other one
                start2 = along(start, draw.choice((0.0, 0.5, 1.0)))
            elif kind == 3:
                end, end2 = draw.choice(((start, end2), (end, start2), (start, start2)))
            ends = [[x if math.isfinite(x) else 0.0 for x in v] for v in (start, end, start2, end2)]
            r, r2 = abs(number()), abs(number())
            if draw.random() < 0.3:
                r = max(r, max(map(abs, sum(ends, []))))
            return capsules(*ends[:2], r, *ends[2:], r2, draw.choice((0, abs(number()))), draw.choice((0, abs(number()))))

        def ball_and_capsule():
            query = capsule_pair()
            return {**query, "a": {"center": query["a"]["start"], "radius": query["a"]["radius"]}, "pair": "sphere_capsule"}

        def ball_and_triangle():
            number = draw.choice((ordinary, ordinary, *kinds, lambda: float(draw.randrange(-4, 5))))
            vector = lambda: [number() for _ in range(3)]
            center, *v = (vector() for _ in range(4))
            within = lambda x: to(max(-largest, min(x, largest))) if not math.isnan(x) else 0.0
            between = lambda s, t: [within(x + s * (y - x) + t * (z - x)) for x, y, z in zip(*v)]
            kind, (s, t) = draw.randrange(7), draw.choice(((0.25, 0.25), (0.5, 0.0), (1.0, 0.0), (0.0, 0.0), (-0.5, 0.0)))
            if kind == 0:  # on the plane: on the triangle or beside it
                center = between(s, t)
            elif kind == 1:  # three points on a line, where no sum is rounded
                v[2] = between(draw.choice((-1.0, 0.5, 2.0)), 0.0)
            elif kind == 2:
                v[2] = draw.choice(v[:2])
            elif kind == 3:
                v[1] = v[2] = v[0]
            r = max(abs(number()), max(map(abs, sum(v, center)), default=0) if draw.random() < 0.3 else 0)
            draw.shuffle(v)
            return {"a": {"center": center, "radius": r}, "b": {"vertices": v}, "alarm": draw.choice((0, abs(number()))),
                    "contact": draw.choice((0, abs(number())))}

        def ray_and_ball():
            query, times = capsule_pair(), draw.choice((0.0, 0.25, 1.0, 3.0, 7.0))
            start, end = query["b"]["start"], query["b"]["end"]
            direction = [y if times == 0 or not abs(y - x) <= largest else to((y - x) / max(times, 1)) for x, y in zip(start, end)]
            return {**query, "a": {"origin": start, "direction": direction if any(direction) else [1, 2, 3], "length": times or 0},
                    "b": {"center": query["a"]["start"], "radius": query["a"]["radius"]}, "pair": "ray_sphere"}

        def hulls(pair):
            def points(most=12):
                number = draw.choice((ordinary, ordinary, *kinds, *[lambda: float(draw.randrange(-2, 3))] * 3))
                some = [[number() for _ in range(3)] for _ in range(draw.randrange(1, most + 1))]
                kind, axis = draw.randrange(4), draw.randrange(3)
                if kind == 0:  # in a plane
                    some = [[some[0][i] if i == axis else x for i, x in enumerate(point)] for point in some]
                elif kind == 1:  # on a line
                    some = [[x if i == axis else some[0][i] for i, x in enumerate(point)] for point in some]
                return some + draw.choices(some, k=draw.randrange(3))

            def shape(kind):
                (start, end, *_), r = (points(2) * 2), abs(draw.choice((0.0, ordinary())))
                three = [draw.choice(points()) for _ in range(3)]
                turn = [draw.choice((1.0, 0.0, ordinary())) for _ in range(3)]
                return {"sphere": lambda: {"center": start, "radius": r}, "capsule": lambda: {"start": start, "end": end, "radius": r},
                        "cube": lambda: {"min": list(map(min, start, end)), "max": list(map(max, start, end))},
                        "obb": lambda: {"center": start, "orientation": [*turn, 1], "extents": [abs(x) for x in end]},
                        "triangle": lambda: {"vertices": three}, "hull": lambda: {"vertices": points(), "radius": r},
                        "plane": lambda: {"normal": [*turn[:2], -2], "offset": ordinary()}}[kind]()

            a, b = map(shape, pair.split("_"))
            return {"a": a, "b": b, "alarm": draw.choice((0.0, abs(ordinary()))), "contact": draw.choice((0.0, 0.25))}

        hull_pairs = [(pair, 15, lambda pair=pair: hulls(pair)) for pair in (
            "sphere_hull", "capsule_hull", "cube_hull", "obb_hull", "triangle_hull", "hull_hull", "hull_plane")]
        for pair, count, make in (("sphere_triangle", 300, ball_and_triangle), ("ray_sphere", 200, ray_and_ball),
                                  ("sphere_sphere", 500, ball_pair), ("sphere_rigid_sphere", 150, ball_pair),
                                  ("rigid_sphere_rigid_sphere", 150, ball_pair), ("cube_cube", 200, box_pair),
                                  ("sphere_capsule", 200, ball_and_capsule), ("capsule_capsule", 400, capsule_pair), *hull_pairs):
            yield [{"pair": pair, "scalar": scalar, **make()} for _ in range(count)]

    def is_tie(self, case, bits):
        """Whether the value lies exactly half way between two numbers: its one odd numerator has a bit too many."""
        if not all("center" in case[shape] for shape in "ab"):
            return False
        (c1, r1), (c2, r2) = ((list(map(Fraction, s["center"])), Fraction(s["radius"])) for s in (case["a"], case["b"]))
        D = sum((x - y) ** 2 for x, y in zip(c1, c2))
        root = Fraction(math.isqrt(D.numerator), math.isqrt(D.denominator))
        return root * root == D and (root - r1 - r2 - Fraction(case["contact"])).numerator.bit_length() == bits + 1

    def test_what_annotate_makes_of_sixteen_hundred_foreign_questions_is_accepted_by_verify_and_lint(self):
        for scalar in ("binary64", "binary32"):
            with self.subTest(scalar):
                asked = hits = ties = infinite = many = quotients = 0
                for i, queries in enumerate(self.foreign(scalar, seed=20240229)):
                    once = {json.dumps(query): query for query in queries}  # a dataset asks no question twice
                    lines = self.annotated(*once.values())
                    self.file(f"{scalar}.{i}.jsonl", lines)
                    text = "\n".join(lines)
                    asked += len(lines) - 1
                    hits += text.count('"hit":true')
                    infinite += text.count("Infinity")
                    many += text.count('"unique":false')
                    quotients += text.count("/0x")
                    ties += sum(self.is_tie(case, 24 if scalar == "binary32" else 53) for case in map(json.loads, lines[1:])
                                if case["expect"]["hit"])
                self.accepted(*sorted(self.folder.glob(f"{scalar}.*.jsonl")))
                linted = run(TOOL, "lint", *sorted(self.folder.glob(f"{scalar}.*.jsonl")))
                self.assertEqual(linted.returncode, 0, linted.stderr)
                self.assertGreaterEqual(asked, 1580)
                self.assertTrue(0.3 < hits / asked < 0.9, hits)
                self.assertGreater(ties, 10)
                self.assertGreater(infinite, 5)
                self.assertGreater(many, 20)
                self.assertGreater(quotients, 50)


# A corruption: a name, the text of a line that becomes another text, and the complaints to expect.
class Wrong(Case):
    def corrupt(self, lines, table, at=1):
        """Each row: a regular expression with one group, its new text or a function of the old, fields (or whole complaints)."""
        self.accepted(self.file("right.jsonl", lines))
        for name, (expression, new, *fields) in table.items():
            with self.subTest(name):
                old = re.search(expression, lines[at])
                self.assertIsNotNone(old, (expression, lines[at]))
                start, end = old.span(1)
                text = lines[at][:start] + (new(old[1]) if callable(new) else new) + lines[at][end:]
                self.assertNotEqual(text, lines[at])
                self.finds([*lines[:at], text, *lines[at + 1:]], *(f"{at + 1}: {field}" for field in fields))

    # Full significands in every field.
    def spheres(self, **more):
        return self.annotated(question([0.1, 0.2, 0.3], 1.7, [1.1, -1.3, 0.9], 0.6, 0.5, 0.05, **more), BALLS)

    def by_ulps(self):
        return {f"{field}[{axis}] by {by}": (rf'"{field}":\[' + r"[^,]*," * axis + "([-0-9.e]+)", lambda x, by=by: step(x, by),
                                             f"expect.{field}[{axis}]: ")
                for field in ("normal", "point1", "point2") for axis in range(3) for by in (-1, 1)}

    def test_one_ulp_in_any_number_of_an_answer_is_found(self):
        number = r"([-0-9.e]+)"
        table = self.by_ulps()
        for by in (-1, 1):
            table[f"value by {by}"] = ('"value":' + number, lambda x, by=by: step(x, by), "expect.value: ")
            table[f"margin by {by}"] = ('"margin_ulps":' + number, lambda x, by=by: step(x, by), "exact.margin_ulps: ")
        self.corrupt(self.spheres(), table)
        f32 = {name: (expression, lambda x, name=name: step(x, int(name.split()[-1]), single=True), *fields)
               for name, (expression, _, *fields) in table.items() if "margin" not in name}
        numbers = dict(zip(("c", "r", "d", "s", "e"), map(single, (0.1, 1.7, 1.1, 0.6, 0.05))))
        lines = self.annotated(question([numbers["c"], numbers["c"] * 2, 0.375], numbers["r"], [numbers["d"], -1.25, 0.875],
                                        numbers["s"], 0.5, numbers["e"], scalar="binary32"))
        self.corrupt(lines, f32)

    def test_every_other_field_of_an_answer_of_spheres_is_checked(self):
        flip = lambda x: x[1:] if x.startswith("-") else "-" + x
        lines = self.spheres()
        points = re.search(r'"point1":(\[.*?\]),"point2":(\[.*?\])', lines[1])
        at = [f"expect.{point}[{axis}]: " for point in ("point1", "point2") for axis in range(3)]
        self.corrupt(lines, {
            "sign of normal[0]": (r'"normal":\[([^,]*)', flip, "expect.normal[0]: "),
            "sign of normal[1]": (r'"normal":\[[^,]*,([^,]*)', flip, "expect.normal[1]: "),
            "sign of value": (r'"value":([^}]*)', flip, "expect.value: "),
            "sign of the margin": (r'"margin_ulps":([^}]*)', flip, "exact.margin_ulps: "),
            "swapped points": (r'"point1":(.*),"value"', f'{points[2]},"point2":{points[1]}', *at),
            "flipped hit": (r'"hit":(true)', "false", "expect.hit: expected true, got false"),
            "hit a number": (r'"hit":(true)', "1", "expect.hit: expected true, got 1"),
            "degenerate": (r'"degenerate":(false)', "true", "expect.degenerate: expected false, got true"),
            "degenerate missing": (r'("degenerate":false,)', "", "expect.degenerate: expected false, got nothing", FORM),
            "digit of the id": (r'"id":"(.)', lambda x: format(int(x, 16) ^ 1, "x"), "id: "),
            "capital id": (r'"id":"(\w+)', str.upper, "id: "),
            "distance2": (r'"distance2":"0x[0-9a-f]*([0-9a-f])p', lambda x: format(int(x, 16) ^ 2, "x"), "exact.distance2: "),
            "exponent of distance2": (r'"distance2":"[^p]*p-(\d+)', lambda x: str(int(x) + 1), "exact.distance2: "),
            "reach": (r'"reach":"0x[0-9a-f]*([0-9a-f])p', lambda x: format(int(x, 16) ^ 2, "x"), "exact.reach: "),
            "even mantissa": (r'"reach":"(.*?)"', lambda x: "{:#x}p{}".format(int(x.split("p")[0], 16) * 2, int(x.split("p")[1]) - 1),
                              "exact.reach: "),
            "question by an ulp": (r'"contact":([\d.]+)', step, "id: "),
            "flag no text": (r'"flags":\[(.*?)\]', "7", 'flags[0]: expected "7", got 7'),
            "flags no list": (r'"flags":(\[.*?\])', '"Flat"', 'flags: expected [], got "Flat"'),
        })
        hit, miss = lines[1], self.annotated(question([0, 0, 0], 1, [3, 0, 0], 1))
        self.corrupt(miss, {"a miss with a contact": (r'"expect":(.*?),"exact"', re.search(r'"expect":(.*?),"exact"', hit)[1],
                                                      "expect.hit: ", "expect.degenerate: expected nothing, got false",
                                                      *(f"expect.{x}[{i}]: " for x in ("normal", "point1", "point2") for i in range(3)),
                                                      "expect.value: ", FORM)})

    def test_the_agreement_on_coincident_centres_is_checked(self):
        self.corrupt(self.annotated(question([1, 2, 3], 1, [1, 2, 3], 2)), {
            "another unit normal": (r'"normal":\[(1,0),0\]', "0,1", "expect.normal[0]: expected 1, got 0", "expect.normal[1]: "),
            "not degenerate": (r'"degenerate":(true)', "false", "expect.degenerate: "),
            "no normal": (r'"normal":\[(1)', '"NaN"', 'expect.normal[0]: expected 1, got "NaN"'),
        })

    # Of sides, at right angles: full significands, and a distance whose square is a quotient.
    def sides(self, **more):
        return self.annotated(capsules([0.1, 0.2, 0.3], [1.3, -0.9, 0.7], 0.6, [0.2, -1.1, 0.9], [1.1, 1.2, 1.3], 0.7, 0.5, 0.05, **more))

    def test_every_field_of_an_answer_of_capsules_is_checked(self):
        number = r"([-0-9.e]+)"
        lines = self.sides()
        self.corrupt(lines, self.by_ulps() | {
            "value": ('"value":' + number, step, "expect.value: "),
            "margin": ('"margin_ulps":' + number, step, "exact.margin_ulps: "),
            "numerator": (r'"distance2":"0x[0-9a-f]*([0-9a-f])p', lambda x: format(int(x, 16) ^ 2, "x"), "exact.distance2: "),
            "exponent": (r'"distance2":"[^p]*p(-?\d+)/', lambda x: str(int(x) + 1), "exact.distance2: "),
            "denominator": (r'"distance2":"[^"]*([0-9a-f])"', lambda x: format(int(x, 16) ^ 2, "x"), "exact.distance2: "),
            "no denominator": (r'"distance2":"[^"/]*(/0x[0-9a-f]*)"', "", "exact.distance2: "),
            "not in lowest terms": (r'"distance2":"(.*?)"', lambda x: "{:#x}p{}/{:#x}".format(*self.three_times(x)), "exact.distance2: "),
            "a denominator of 1": (r'"reach":"(.*?)"', lambda x: x + "/0x1", "exact.reach: "),
            "unique said": (r'"degenerate":false(,)', ',"unique":true,', "expect.unique: expected nothing, got true", FORM),
            "not unique": (r'"degenerate":false(,)', ',"unique":false,', "expect.unique: expected nothing, got false", FORM),
            "question by an ulp": (r'"contact":([\d.]+)', step, "id: ")})

    def three_times(self, text):
        dyadic, odd = text.split("/")
        digits, exponent = dyadic.split("p")
        return int(digits, 16) * 3, exponent, int(odd, 16) * 3

    def test_what_many_nearest_points_and_crossing_axes_agree_on_is_checked(self):
        # Side by side along half of their lengths; the middle of it is at 0.75.
        beside = self.annotated(capsules([0, 0, 0], [1, 0, 0], 0.25, [0.5, 0.5, 0], [2, 0.5, 0], 0.25))
        self.assertIn('"unique":false,"normal":[0,1,0],"point1":[0.75,0.25,0],"point2":[0.75,0.25,0]', beside[1])
        self.corrupt(beside, {
            "unique": (r'("unique":false,)', "", "expect.unique: expected false, got nothing", FORM),
            "unique true": (r'"unique":(false)', "true", "expect.unique: expected false, got true"),
            "another of the points": (r'"point1":\[(0.75)', "0.5", "expect.point1[0]: expected 0.75, got 0.5"),
        })
        crossing = self.annotated(capsules([0, 0, 0], [2, 2, 0], 1, [0, 2, 0], [2, 0, 0], 1))
        self.assertIn('"degenerate":true,"normal":[0,0,1],"point1":[1,1,1],"point2":[1,1,-1]', crossing[1])
        self.corrupt(crossing, {"the other way": (r'"normal":\[0,0,(1)', "-1", "expect.normal[2]: expected 1, got -1")})
        for along, normal in (([2, 0, 0], "[0,1,0]"), ([0, 0, 3], "[1,0,0]"), ([0, 0, 0], "[1,0,0]"), ([1, 0, 1], "[0.7071067811865476,0,-0.7071067811865476]")):
            for first, second in (([0, 0, 0], along), (along, [0, 0, 0])):
                lines = self.annotated(capsules([0, 0, 0], first, 1, [0, 0, 0], second, 0))
                self.assertIn(f'"degenerate":true,"normal":{normal}', lines[1])
                self.corrupt(lines, {"degenerate": (r'"degenerate":(true)', "false", "expect.degenerate: expected true, got false")})

    def test_cubes_are_checked(self):
        lines = self.annotated({"a": {"min": [0, 0, 0], "max": [1, 1, 1]}, "b": {"min": [1.5, 0, 0.25], "max": [2, 1, 1]},
                                "alarm": 0.5, "contact": 0})
        self.corrupt(lines, {
            "hit": (r'"hit":(true)', "false", "expect.hit: expected true, got false"),
            "gap": (r'"gap":\["(0x1p-1)"', "0x1p-2", "exact.gap[0]: expected \"0x1p-1\", got \"0x1p-2\""),
            "sign of a gap": (r'"gap":\[.*?,"(-)', "", "exact.gap[1]: "),
            "two gaps": (r'"gap":\[.*?(,"[^,]*")\]', "", "exact.gap[2]: ", FORM),
            "a contact of cubes": (r'"hit":true()', ',"value":0', "expect.value: expected nothing, got 0", FORM),
            "alarm an ulp less": (r'"alarm":(0.5)', "0.49999999999999994", "id: ", "expect.hit: expected false, got true"),
        })

    def round_one_way(self, rows, **more):
        """Of each: the question, the field, its right text, and wrong ones."""
        for name, (query, field, right, *wrong) in rows.items():
            lines = self.annotated({**query, **more})
            index = "[0]" if field == "point1" else ""
            text = rf'"{field}":\[?([^,}}\]]*)'
            with self.subTest(name):
                self.assertEqual(re.search(text, lines[1])[1], right)
            self.corrupt(lines, {f"{name}: {one}": (text, one, f"expect.{field}{index}: expected {right}, got {one}") for one in wrong})

    def test_ties_the_ends_of_the_range_and_subnormal_numbers_round_one_way_only(self):
        least, half_of_largest = 5e-324, 2.0**970
        rows = {
            "tie to even, downwards": (question([0, 0, 0], 1, [0, 0, 0], 2.0**-53), "value", "-1", "-1.0000000000000002"),
            "tie to even, upwards": (question([0, 0, 0], 1, [0, 0, 0], 3 * 2.0**-53), "value", "-1.0000000000000004",
                                     "-1.0000000000000002"),
            "tie below a power of two": (question([0, 0, 0], 0, [1, 0, 0], 0, 1, 2.0**-54), "value", "1", "0.9999999999999999"),
            "tie from Pythagoras": (question([0, 0, 0], 0, [3, 4, 0], 0, 5, 2.0**-51 * 1.25), "value", "4.999999999999999", "5"),
            "just above a tie": (question([0, 0, 0], 1, [0, 0, 0], 2.0**-53, 0, least), "value", "-1.0000000000000002", "-1"),
            "half an ulp beyond the largest": (question([LARGEST, 0, 0], half_of_largest, [LARGEST, 0, 0], 0), "point1",
                                               '"Infinity"', repr(LARGEST), '"NaN"', '"-Infinity"'),
            "nearly half an ulp beyond it": (question([LARGEST, 0, 0], math.nextafter(half_of_largest, 0), [LARGEST, 0, 0], 0),
                                             "point1", repr(LARGEST), '"Infinity"'),
            "a third of the smallest subnormal": (question([0, 0, 0], least, [1, 2, 2], 3), "point1", "0", "5e-324", "-0"),
            "the smallest subnormal": (question([0, 0, 0], least, [2, 1, 2], 3), "point1", "5e-324", "0", "1e-323"),
        }
        self.round_one_way(rows)

    def test_the_same_in_binary32(self):
        largest, half_of_largest, least = LARGEST32, 2.0**103, 2.0**-149
        rows = {
            "tie to even, downwards": (question([0, 0, 0], 1, [0, 0, 0], 2.0**-24), "value", "-1", "-1.0000001192092896"),
            "tie to even, upwards": (question([0, 0, 0], 1, [0, 0, 0], 3 * 2.0**-24), "value", "-1.000000238418579",
                                     "-1.0000001192092896"),
            "no binary32 number": (question([0, 0, 0], single(0.1), [0, 0, 0], 0), "value", "-0.10000000149011612", "-0.1"),
            "half an ulp beyond the largest": (question([largest, 0, 0], half_of_largest, [largest, 0, 0], 0), "point1",
                                               '"Infinity"', repr(largest), "3.402823669209385e+38"),
            "nearly half an ulp beyond it": (question([largest, 0, 0], single(half_of_largest * (1 - 2.0**-24)), [largest, 0, 0], 0),
                                             "point1", repr(largest), '"Infinity"'),
            "a third of the smallest subnormal": (question([0, 0, 0], least, [1, 2, 2], 3), "point1", "0", repr(least),
                                                  repr(least / 3)),
            "the smallest subnormal": (question([0, 0, 0], least, [2, 1, 2], 3), "point1", repr(least), "0", repr(least / 3 * 2)),
        }
        self.round_one_way(rows, scalar="binary32")
        lines = self.annotated(question([0, 0, 0], 1, [0, 0, 0], 0.5, scalar="binary32"))
        self.corrupt(lines, {"a question that is not binary32": (r'"radius":(0.5)', "0.1", "id: ",
                                                                 "b.radius: expected 0.10000000149011612, got 0.1",
                                                                 "expect.point2[0]: ", "expect.value: ", "exact.reach: ",
                                                                 "exact.margin_ulps: ")})

    def test_the_field_that_puts_a_question_outside_the_domain_is_checked(self):
        for pair in ("sphere_sphere", "cube_cube"):
            header, *cases = (GOLDEN / pair / "invalid.jsonl").read_text().splitlines()
            for field in sorted({json.loads(case)["expect"]["rejected"] for case in cases}):
                case = next(case for case in cases if f'"rejected":"{field}"' in case)
                other = "contact" if field != "contact" else "alarm"
                self.corrupt([header.replace(f'"count":{len(cases)}', '"count":1'), case], {
                    f"{pair} {field}": (r'"rejected":"(.*?)"', other, f'expect.rejected: expected "{field}", got "{other}"')})

    def test_text_that_is_not_canonical_is_found(self):
        lines = self.annotated(question([0.5, 0, 0], 1, [1, 0, 1e22], 2e22, 0.00001, 100000))
        self.assertIn('"alarm":1e-05,"contact":1e+05', lines[1])
        self.corrupt(lines, {
            "trailing zero": (r"(0\.5)", "0.50", "a.center[0]: expected 0.5, got 0.50"),
            "point zero": (r'"radius":(1)', "1.0", "a.radius: expected 1, got 1.0"),
            "minus zero": (r'"center":\[0.5,(0)', "-0", "a.center[1]: expected 0, got -0"),
            "long fixed form": (r'"alarm":(1e-05)', "0.00001", "alarm: expected 1e-05, got 0.00001"),
            "fixed form": (r'"contact":(1e\+05)', "100000", "contact: expected 1e+05, got 100000"),
            "short exponent": (r'"contact":(1e\+05)', "1e5", "contact: expected 1e+05, got 1e5"),
            "a large integer in digits": (r'"center":\[1,0,(1e\+22)', "1" + "0" * 22, "b.center[2]: expected 1e+22, got 1000"),
            "more digits than needed": (r"(0\.5)", "0.50000000000000001", "a.center[0]: expected 0.5, got 0.50000000000000001"),
            "a number as text": (r"(0\.5)", '"0.5"', 'a.center[0]: expected 0.5, got "0.5"'),
            "a space": (r'"alarm":()', " ", FORM),
            "a carriage return": (r"\}()$", "\r", FORM),
            "keys in another order": (r'("alarm":1e-05,"contact":1e\+05)', '"contact":1e+05,"alarm":1e-05', FORM),
            "a key twice": (r'("alarm":1e-05)', '"alarm":1e-05,"alarm":1e-05', FORM),
            "an unknown key": (r'("alarm")', '"colour":7,"alarm"', "colour: expected nothing, got 7", FORM),
            "a letter escaped": (r'"(a)larm"', r"\u0061", FORM),
        })

    def test_a_number_that_is_a_bare_word_or_a_key_with_a_dot_is_no_way_in(self):
        header, *cases = (GOLDEN / "sphere_sphere" / "invalid.jsonl").read_text().splitlines()
        case = next(case for case in cases if '"radius":"NaN"' in case)
        self.finds([header.replace(f'"count":{len(cases)}', '"count":1'), case.replace('"NaN"', "NaN")], "2: ")
        lines = self.spheres()
        flat = re.sub(r'"a":\{"center":(\[.*?\]),"radius":([^}]*)\}', r'"a.center":\1,"a.radius":\2', lines[1])
        self.assertNotEqual(flat, lines[1])
        self.assertEqual(verify(self.file("flat.jsonl", [lines[0], flat, lines[2]])).returncode, 2)

    def test_the_header_is_checked(self):
        self.corrupt(self.spheres(), {
            "count too large": (r'"count":(2)', "3", "count: expected 2, got 3"),
            "count too small": (r'"count":(2)', "1", "count: expected 2, got 1"),
            "version": (r'"version":(1)', "2", "version: expected 1, got 2"),
            "format": (r'"format":"([^"]*)"', "contact-oracle/data", 'format: expected "contact-oracle/dataset", got'),
            "points": (r'"points":"([^"]*)"', "center", 'points: expected "nearest_surface", got "center"'),
            "seed": (r'"seed":(0)', "-0", "seed: expected 0, got -0"),
            "unknown key": (r'("points")', '"colour":7,"points"', "colour: expected nothing, got 7", FORM),
        }, at=0)

    def test_questions_outside_the_domain_stand_in_the_family_invalid_and_no_others_do(self):
        header, case = (GOLDEN / "sphere_sphere" / "invalid.jsonl").read_text().splitlines()[:2]
        header = re.sub(r'"count":\d+', '"count":1', header)
        self.finds([header.replace('"invalid"', '"generic"'), case], "2: invalid: expected true, got false")
        header, case, _ = self.spheres()
        header = header.replace('"annotated"', '"invalid"').replace('"count":2', '"count":1')
        self.finds([header, case], "2: invalid: expected false, got true")

    def test_a_question_asked_twice_is_found_whatever_its_flags(self):
        header, first, second = self.spheres()
        twice = header.replace('"count":2', '"count":3')
        self.finds([twice, first, second, first], "4: first asked on line: expected 4, got 2")
        again = re.sub(r'"flags":\[.*?\]', '"flags":["Flat"]', first)
        self.finds([twice, first, second, again], "4: first asked on line: expected 4, got 2")

    def test_a_line_under_another_pair_or_scalar_is_found(self):
        lines = self.spheres()
        self.finds([lines[0].replace('"sphere_sphere"', '"sphere_rigid_sphere"'), *lines[1:]], "2: id: ", "3: id: ")
        header, *cases = lines
        done = verify(self.file("d.jsonl", [header.replace("binary64", "binary32"), *cases]))
        self.assertEqual(done.returncode, 1)
        self.assertIn("a.center[0]: expected 0.10000000149011612, got 0.1", done.stdout)

    def test_only_the_first_twenty_complaints_of_a_file_are_shown(self):
        lines = (GOLDEN / "cube_cube" / "generic.jsonl").read_text().replace('"hit":true', '"hit":false').splitlines()
        done = verify(self.file("d.jsonl", lines))
        self.assertEqual((done.returncode, len(done.stdout.splitlines())), (1, 22))
        self.assertRegex(done.stdout.splitlines()[20], r"d\.jsonl: and \d+ more$")
        right = (GOLDEN / "cube_cube" / "generic.jsonl").read_text().splitlines()
        done = verify(self.file("d.jsonl", [re.sub('"hit":(true|false)', '"hit":7', one) if i <= 20 else one for i, one in enumerate(right)]))
        self.assertEqual((done.returncode, len(done.stdout.splitlines())), (1, 21))  # all of them, and the sum

    def test_the_manifest_is_checked(self):
        for name in ("generic.jsonl", "touching.jsonl"):
            self.file(name, (GOLDEN / "cube_cube" / name).read_text().splitlines())
        self.assertEqual(run(TOOL, "lint", self.folder, "--write-manifest").returncode, 0)
        self.accepted(self.folder)
        manifest = self.folder / "manifest.json"
        right = manifest.read_text()
        for name, (expression, new, field) in {
                "digest": (r'"sha256":"(.)', lambda x: format(int(x, 16) ^ 1, "x"), "generic.jsonl: sha256: "),
                "count": (r'"count":(\d+)', "7", "generic.jsonl: count: "),
                "hits": (r'"hits":(\d+)', "7", "generic.jsonl: hits: "),
                "flag": (r'"Touching":(\d+)', "7", "touching.jsonl: flags.Touching: "),
                "seed": (r'"seed":(\d+)', "7", "generic.jsonl: seed: "),
                "file without an entry": (r'(\{"path":"touching.*\n)', "", "touching.jsonl: path: "),
                "entry without a file": (r'"path":"(touching)', "missing", "missing.jsonl: path: ")}.items():
            with self.subTest(name):
                old = re.search(expression, right)
                text = right[:old.start(1)] + (new(old[1]) if callable(new) else new) + right[old.end(1):]
                manifest.write_text(text.replace("},\n]}", "}\n]}"))
                done = verify(self.folder)
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertIn(f"{manifest}: {field}", done.stdout)

    def test_what_cannot_be_read_is_neither_right_nor_wrong(self):
        header, case, other = self.spheres()
        cut = "\n".join((header, case, other)).encode()
        for name, (content, word) in {
                "empty": (b"", "e.jsonl:1: "), "no line feed at the end": (cut, "e.jsonl:1: "), "cut": (cut[:-40], "e.jsonl:1: "),
                "no JSON": ([header, "{nonsense}"], "e.jsonl:2: "), "no object": ([header, "[1,2]"], "e.jsonl:2: "),
                "blank line": ([header, "", case], "e.jsonl:2: "), "no UTF-8": (cut + b"\xff\n", "e.jsonl:3: "),
                "nested without end": ([header, "[" * 100000], "e.jsonl:2: "),
                "a radius missing": ([header, case.replace('"radius"', '"radios"', 1)], "'a.radius'"),
                "text for a number": ([header, re.sub(r'"alarm":[^,]*', '"alarm":"wide"', case)], "wide"),
                "unknown pair": ([header.replace("sphere_sphere", "cone_cone"), case], "cone_cone"),
                "unknown scalar": ([header.replace("binary64", "half"), case], "half")}.items():
            with self.subTest(name):
                done = verify(self.file("e.jsonl", content))
                self.assertEqual((done.returncode, done.stdout), (2, ""))
                self.assertIn(word, done.stderr)
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertEqual(verify(self.folder / "gone.jsonl").returncode, 2)
        self.assertEqual(verify().returncode, 2)
        (self.folder / "none").mkdir()
        self.assertEqual(verify(self.folder / "none").returncode, 2)


def calls_wrong(program, path):
    """Whether a program that was executed complains of a file, or stumbles over it, as over a face without points; that it cannot read it is neither."""
    try:
        return bool(program["check"](path)[0])
    except (OSError, ValueError, KeyError) as problem:
        return "empty sequence" in str(problem)
    except Exception:
        return True


class Broken(Case):
    """Every eighth step, and all of them in the campaign."""
    every = 8

    def test_each_step_of_verify_matters_a_program_without_it_calls_right_files_wrong(self):
        least = {"binary64": 5e-324, "binary32": 2.0**-149}
        for scalar, small in least.items():
            bits = 53 if scalar == "binary64" else 24
            largest = LARGEST if scalar == "binary64" else LARGEST32
            lines = self.annotated(*({**query, "scalar": scalar} for query in (
                BALLS, question([0, 0, 0], 1, [3, 4, 0], 1, 3, 0.25), question([0, 0, 0], 1, [0, 0, 0], 2.0**-bits),
                question([0, 0, 0], 1, [0, 0, 0], 3 * 2.0**-bits), question([largest, 0, 0], largest, [largest, 0, 0], 0),
                question([0, 0, 0], 2 * small, [1, 2, 2], 3), question([0, 0, 0], small, [1, 1, 1], 3),
                question([2 * small, 0, 0], small, [small, -small, -small], small), question([0, 0, 0], small, [0, 0, small], small),
                question([2.0**60, 0, 0], 1, [2.0**60, 0, 0], 1, 100000))))
            self.file(f"{scalar}.jsonl", lines)
        self.file("faults.jsonl", self.several_faults("sphere_sphere"))
        for name in ("touching.jsonl", "flat.jsonl", "invalid.jsonl"):
            self.file(f"cubes.{name}", (GOLDEN / "cube_cube" / name).read_text().splitlines())
        # The committed ones of so few have no extent below 0.
        made = run(TOOL, "generate", "--pair", "obb_plane", "--family", "invalid", "--seed", 1, "--count", 200, "-o", self.folder / "boxes.invalid.jsonl")
        self.assertEqual(made.returncode, 0, made.stderr)
        self.file("spheres.invalid.jsonl", (GOLDEN / "sphere_sphere" / "invalid.jsonl").read_text().splitlines())
        # Axes level with an end, turned round, one beside a point or another; crossing, parallel, without length.
        points = ([0, 0, 0], [4, 0, 0], [1, 3, 1], [1, -2, 1], [6, 1, 2], [2, 0, 0], [-1, 2, 0], [3, 2, 0], [0, 0, 3])
        asked = {
            "capsules": [capsules(a, b, 2, c, d, i % 7 / 4, i % 3, 0.5) for i, (a, b, c, d) in enumerate(itertools.product(points, repeat=4))
                         if i % 11 == 0],
            "triangles": [{"pair": "sphere_triangle", "a": {"center": c, "radius": i % 5}, "b": {"vertices": v}, "alarm": 0, "contact": i % 3}
                          for i, (c, *v) in enumerate(itertools.product(points, repeat=4)) if i % 13 == 0],
            "rays": [{"pair": "ray_sphere", "a": {"origin": a, "direction": b if any(b) else [1, 0, 0], "length": i % 3},
                      "b": {"center": c, "radius": i % 5}, "alarm": 0, "contact": 0}
                     for i, (a, b, c) in enumerate(itertools.product(points, repeat=3))]}
        # Ends of an edge that lie beside a face, inner and repeated points, a polygon with points on its edges, a line, a point.
        bodies = [[[0, 0, 0], [4, 0, 0], [0, 4, 0], [4, 4, 0], [2, 2, 3], [2, 2, 1], [2, 0, 0]], [[0, 0, 0], [1, 2, 0], [3, 3, 0], [5, 1, 0], [2, 1, 0]],
                  [[3, 0, 2], [1, 0, 2], [2, 0, 2], [3, 0, 2]], [[1, 1, 1]], [[i % 2 * 3, i // 2 % 2 * 3, i // 4 * 3] for i in range(8)],
                  [[0, 0, 3], [3, 1, 4], [1, 3, 5], [4, 4, 7]]]
        asked["hulls"] = [{"pair": "hull_hull", "a": {"vertices": a, "radius": i % 2}, "alarm": i % 3, "contact": 0,
                           "b": {"vertices": [[x + (k == i % 3) * i / 4 for k, x in enumerate(v)] for v in b], "radius": 0.5}}
                          for i, (a, b) in enumerate(itertools.product(bodies * 2, bodies))]
        for name, queries in asked.items():
            queries = list({json.dumps(query): query for query in queries}.values())
            for i in range(0, len(queries), 64):
                self.file(f"{name}.{i}.jsonl", self.annotated(*queries[i:i + 64]))
        self.file("rays.invalid.jsonl", (GOLDEN / "ray_sphere" / "invalid.jsonl").read_text().splitlines())
        for name in ("sphere_plane/below_plane", "capsule_plane/parallel", "capsule_plane/generic", "ray_triangle/generic",
                     "ray_triangle/through_boundary", "ray_triangle/end_on_triangle", "triangle_line/through_boundary",
                     "cast_sphere/grazing", "cast_cube/through_edge", "cast_capsule/through_edge", "cast_capsule/from_inside",
                     "cast_triangle/thin", "cast_sphere/zero_radius", "cast_triangle/through_edge", "cast_plane/ends_at_surface",
                     *(f"obb_obb/{family}" for family in ("generic", "touching", "deep", "parallel", "near_tied_depths", "flat", "nested")),
                     "triangle_triangle/generic", "triangle_triangle/touching", "capsule_obb/generic", "obb_plane/parallel", "sphere_obb/touching"):
            pair, *asked = (json.loads(line) for line in (GOLDEN / f"{name}.jsonl").read_text().splitlines()[:25])
            self.file(f"{name.replace('/', '.')}.jsonl", self.annotated(*(
                {"pair": pair["pair"], **{x: case[x] for x in ("a", "b", "alarm", "contact")}} for case in asked)))
        for pair in ("sphere_plane", "ray_triangle", "obb_obb"):
            self.file(f"{pair}.invalid.jsonl", (GOLDEN / pair / "invalid.jsonl").read_text().splitlines())
        self.accepted(self.folder)
        files = sorted(self.folder.glob("*.jsonl"), key=lambda path: path.stat().st_size)
        last = files[0]
        program = VERIFY.read_text()
        for i, (right, wrong) in enumerate((
                ("D > reach * reach", "D >= reach * reach"), ("alarm + r1 + r2", "r1 + r2"), ("max(gap) <=", "max(gap) <"),
                ("lost > half", "lost >= half"), ("kept % 2))", "kept % 2 == 0))"), ("rest > 0 or ", ""), ("root * root != q or ", ""),
                ("-math.isqrt(q - 1) - 1 if q", "-math.isqrt(q) if q"),
                ("min(kept + ((drop - 1) << (bits - 1)), infinity)", "kept + ((drop - 1) << (bits - 1))"),
                ("- bits, 1)", "- bits, 2)"), ("- bits, 0)", "- bits, 1)"), ('S, "binary64")', "S, scalar)"),
                ("- contact, times", "+ contact, times"), ("c2, -r2", "c2, r2"), ("agreed=(1, 0, 0)", "agreed=(0, 1, 0)"),
                (r"\x7f\xf8", r"\x7f\xf9"), ('(x[1] != ".", x[0])', "x[0]"), ('"[" not in x and ', ""), ('".extents" in x or ', ""), (' and "offset" not in x', ""),
                ("> inputs[x.replace", ">= inputs[x.replace"), ("2**53", "2**90"), ("min(fixed", "max(fixed"),
                ("max((k & -k).bit_length() - 1, 0)", "0"), ("{up - down}", "{up + down}"), ('f"/{d:#x}" * (d > 1)', '""'),
                ("(end - level(b1)) / slope", "(end + level(b1)) / slope"), ("3 * f - 4 * g + h", "3 * f - 4 * g - h"),
                ("at(b1, v, (first + last) / 2)", "at(b1, v, first)"), ("else {\"expect.unique\": False}", "else {}"),
                ("at(b1, v, first) == at(b1, v, last)", "first == last"), ("u if any(u) else v)\n", "u)\n"), ("(4 * bend), low), high)", "(4 * bend), low), low)"),
                ("[y * y + z * z, -x * y, -x * z]", "[y * y + z * z, x * y, x * z]"), ("[0, x * x, 0]", "[0, 0, x * x]"),
                ("for n in (across, ", "for n in ("), ("if next(i for i in n if i) < 0", "if n[0] < 0"),
                ("(level(0) - 1, level(1) - level(0) + 1)", "(level(0), level(1) - level(0) + 1)"), ("level(s), 1 - s", "level(s), 1"),
                ("parting(cross(u, v), u if any(u) else v))", "parting(cross(v, v), u if any(u) else v))"),
                ("parting(cross(u, v), u if any(u) else v))", "parting(cross(u, v), u))"), ("at(x[0:3], x[3:6], x[6])", "at(x[0:3], x[3:6], 1)"),
                ('if x[2:] in (', 'if 0 and x[2:] in ('), ("if times > 0 and D", "if D"),
                ("if times < 0 else", "if times <= 0 else"), ("(dot(n, a) - offset)", "(dot(n, a) + offset)"), ("len(lowest) == 1,", "True,"),
                ("normals[a] == min(", "normals[a] >= min("), ("[-x for x in n], min", "n, min"), ("0 <= part <= 1", "0 < part <= 1"),
                ("0 <= part <= 1", "0 <= part < 1"), ("min(sides) >= 0", "min(sides) > 0"), ("sign * k / dot", "k / dot"),
                ("sign_of(t[0] - length, -1, t[1]) > 0", "sign_of(t[0] - length, -1, t[1]) >= 0"), ("h := m * m - g / a) >= 0", "h := m * m - g / a) > 0"),
                ("dot(w, w) <= r * r:", "dot(w, w) < r * r:"), ("dot(n, way) <= 0 for way", "dot(n, way) >= 0 for way"),
                ("[(0, -x / dot(d, d)) for x in d]", "[(0, x / dot(d, d)) for x in d]"), ("(slope * way[i] - d[i]) / r)", "-d[i] / r)"),
                ("] * any(u) + [(start", "] * 0 + [(start"), ("right | {\"expect.degenerate\": True}", "right"),
                ("(w * w - dot(u, u)) * i", "(w * w + dot(u, u)) * i"), ("cross(u, v), 2 * w)", "cross(u, v), w)"), ("Fraction(-1, 2))", "Fraction(0))"),
                ("planes[0] != planes[1] or ", ""), (" or not any(n)):", "):"), ("n = [side * i for i in cross(way, c)]", "n = cross(way, c)"),
                ("face, face[::-1]", "face,"), ("[len(names) // 3.0]", "[len(names) / 3]"),
                ("lifts(out, others[w], b)", "lifts(n, others[w], b)"),
                ("tuple(-i for i in n) for n in backs", "n for n in backs"), ("[*some, *others]\n", "[*some]\n"), ("around or face", "around"),
                ("for w in (*ways, *added[:k])", "for w in ways"), ("normals = faces |", "normals ="),
                ("in (1, 2, 3) for planes", "in (1, 2) for planes"),
                ("normals = [n for n in height if square[n] == min(square.values())]", "normals = list(height)"), ("Fraction(i, sum(map(abs, n))) for i in n], default", "Fraction(i) for i in n], default"),
                ("f / (f - g)", "f / (f + g)"), ("for sign in (1, -1)}", "for sign in (1,)}"),
                ("-out / unit", "out / unit"), ("deep=lowest > 0", "deep=False"), ("min(polygon) == max(polygon)", "True"),
                ("(lowest := min(height.values())) < 0", "(lowest := min(height.values())) <= 0"),
                ("corners[1:] + corners[:1]", "corners[1:]"), ("[x[6] * d for d in x[3:6]]", "x[3:6]"))):
            with self.subTest(right, becomes=wrong):
                self.assertEqual(program.count(right), 1)
                if i % self.every:
                    continue
                broken = {"__name__": "broken"}
                exec(compile(program.replace(right, wrong), "broken", "exec"), broken)
                # One file after another, until one is called wrong; the last that was often is again.
                found = next((path for path in (last, *files) if calls_wrong(broken, path)), None)
                self.assertIsNotNone(found, "it calls every file right")
                last = found


class BrokenCampaign(Broken):
    """Every step that can be left out of verify.py."""
    every = 1


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
