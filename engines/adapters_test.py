#!/usr/bin/env python3
"""Every adapter whose engine is here asks it in the right way: on small integers, where no engine has an excuse. Those that
are wrong all the same are named. And those that are not here, or do not start, say so.

    adapters_test.py contact-oracle"""
import json
import os
import random
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tool"))
sys.path.insert(0, str(Path(__file__).resolve().parent))
import scoreboard  # noqa: E402
from published import published  # noqa: E402

TOOL = sys.argv[1]
# Their own tolerances are larger than 8 ulps: these are held to their decisions alone.
TOLERANT = {"bullet-gjk", "bullet-gjk-float", "libccd", "libccd-gjk", "bullet-mpr-float", "mujoco-convex", "havok", "jolt", "physx"}
# These claim no number, so decisions are all that they can show.
DECIDING = {"cgal-epick", "eigen", "fcl-distance", "three"}
# Their hulls have no radius, and they say so of one that has.
SHARP = {"cannon", "fcl", "fcl-distance", "havok", "jolt", "mujoco", "mujoco-js", "ode"}
# Wrong even here, as engines/findings.json tells of each: held to their decisions, and known to be no better.
WRONG = {"sphere_beside_box": {"cannon"},
         "sphere_capsule": {"ammo"}, "capsule_capsule": {"fcl", "rapier"},
         "sphere_in_box": {"ammo", "bullet", "bullet-float", "dart", "mujoco", "ode", "oimo"},
         "sphere_beside_triangle": {"fcl", "ode"},
         # Of rapier those after a quarter turn, of which the numbers of a unit quaternion are rounded.
         "obb_obb": {"mujoco", "rapier"}, "cube_obb": {"mujoco"},
         "capsule_cube": {"ammo", "fcl", "rapier"}, "capsule_obb": {"ammo", "fcl", "rapier"}, "capsule_triangle": {"ammo", "fcl", "rapier"},
         # MPR of libccd goes round a ball in steps; MuJoCo's meshes are in single precision.
         "sphere_hull": {"cannon", "fcl", "mujoco", "mujoco-js", "ode"}, "sphere_round_hull": {"rapier"},
         "hull_hull": {"mujoco", "mujoco-js"}, "hull_plane": {"mujoco", "mujoco-js"}}
# And these even in their decisions.
WRONG_DECISIONS = {"sphere_behind_triangle": {"ode"}, "sphere_plane": {"rapier"}, "capsule_plane": {"rapier"},
                   "cube_plane": {"rapier"}, "obb_plane": {"rapier"}, "triangle_plane": {"rapier"}, "hull_plane": {"rapier"},
                   "ray_from_sphere": {"bullet", "bullet-float", "mujoco"}}
LEVELS = ("correctly-rounded", "faithful", "bounded", "decisions", "conservative", "none")
# What people write into their build files.
NAMES = {"fcl", "bullet", "ode", "libccd", "mujoco"}


def run(*arguments, stdin=None, tool=TOOL, **options):
    return subprocess.run([tool, *published(arguments)], input=stdin, capture_output=True, text=True, timeout=300, **options)


def listed(tool=TOOL):
    made = run("engines", "--json", tool=tool)
    return [e for e in map(json.loads, made.stdout.splitlines()) if "command" in e]


class Scoreboard(unittest.TestCase):
    def test_an_engine_is_timed_on_a_question_of_a_pair_that_it_serves(self):
        of = [scoreboard.usual_question(pairs) for pairs in (["obb_obb"], ["cube_cube", "obb_obb"], ["cube_cube", "sphere_sphere"])]
        self.assertEqual([query["pair"] for query in of], ["obb_obb", "cube_cube", "sphere_sphere"])
        for query, answer in zip(of, scoreboard.conversation([TOOL, "serve"], of)):
            self.assertIn("overlap", answer, query)

    def test_an_answer_that_claims_nothing_is_shown_with_what_it_says(self):
        for key in ("unsupported", "rejected", "error"):
            self.assertEqual(scoreboard.shown({"op": "answer", "seq": 1, key: "a reason"}), "no answer: a reason")


class Adapters(unittest.TestCase):
    """Some questions of each file, in which those that are wrong are seen to be, and of one scalar: those of binary32 are for every engine."""
    most, scalars = 16, ("binary32",)

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        # Centres 5, 3 and sqrt(50) apart; neither these nor the alarm distance make any pair touch.
        spheres = [{"pair": "sphere_sphere", "a": {"center": [1, 2, 3], "radius": i}, "alarm": alarm, "contact": 0.5,
                    "b": {"center": [1 + x, 2 + y, 3 + z], "radius": j}}
                   for x, y, z in ([3, 4, 0], [-1, 2, -2], [7, 0, 1]) for i in (1, 2) for j in (1.25, 3.5) for alarm in (0, 1)]
        boxes = [{"pair": "cube_cube", "a": {"min": [0, 0, 0], "max": [2, 2, 2]}, "alarm": alarm, "contact": 0,
                  "b": {"min": [i, j, 0], "max": [i + 1, j + 1, 1]}} for i in (-4, -0.5, 1, 2.5) for j in (-0.5, 1, 5) for alarm in (0, 1)]
        # The centre beside a face, an edge and a corner, 3, 5 and 3 from it, and a quarter inside; again nothing touches.
        box = {"min": [0, -2, 0], "max": [2, 4, 8]}
        mixed = {name: [{"pair": "sphere_cube", "a": {"center": center, "radius": i}, "alarm": alarm, "contact": 0.5, "b": box}
                        for center in centers for i in (1, 3.5, 7) for alarm in (0, 1)]
                 for name, centers in (("sphere_beside_box", ([-3, 1, 2], [-3, 8, 3], [3, 6, -2])), ("sphere_in_box", ([0.25, 1, 3],)))}
        # Capsules along each axis, from either end, 5 beside the middle and 3 beyond an end; two of them also crosswise.
        def capsule(axis, middle, way, radius):
            ends = [[x + (sign * way if i == axis else 0) for i, x in enumerate(middle)] for sign in (-1, 1)]
            return {"start": ends[0], "end": ends[1], "radius": radius}

        def turned(x, axis):
            return x[-axis:] + x[:-axis] if axis else x

        places = [(axis, *(turned(x, axis) for x in x_first)) for axis in range(3)
                  for x_first in (([1, 1, 2], [0, 4, 6]), ([1, 1, 2], [6, 2, 4]), ([1, 1, 2], [-4, 0, 4]))]
        mixed["sphere_capsule"] = [
            {"pair": "sphere_capsule", "a": {"center": center, "radius": i}, "alarm": alarm, "contact": 0.5,
             "b": capsule(axis, middle, way, j)}
            for axis, middle, center in places for way in (3, -3) for i, j in ((1, 1.25), (2, 3.5), (1, 3.5)) for alarm in (0, 1)]
        mixed["capsule_capsule"] = [
            {"pair": "capsule_capsule", "a": capsule(axis, [0, 0, 0], way, i), "alarm": alarm, "contact": 0.5,
             "b": capsule((axis + turn) % 3, turned(middle, axis), 2, j)}
            for axis in range(3) for turn, middle in ((1, [1, 1, 3]), (2, [4, 1, 4])) for way in (2, -2)
            for i, j in ((1, 1.25), (2, 3.5)) for alarm in (0, 1)]
        # Over either side of a triangle, 3 from it, and beside an edge and a corner, 5 and 7 from them.
        triangle = {"vertices": [[0, 0, 0], [4, 0, 0], [0, 4, 0]]}
        for name, centers in (("sphere_triangle", ([1, 1, 3],)), ("sphere_behind_triangle", ([1, 1, -3],)),
                              ("sphere_beside_triangle", ([2, -3, 4], [-2, -3, 6]))):
            mixed[name] = [{"pair": "sphere_triangle", "a": {"center": center, "radius": i}, "alarm": alarm, "contact": 0.5, "b": triangle}
                           for center in centers for i in (1.5, 3.5, 6.5) for alarm in (0, 1)]
        # Beside a ray, 3 from it, and beyond either end, 5 from it; one that holds the origin of the ray.
        for name, spheres_ in (("ray_sphere", [([3, 0, 4], r) for r in (1.5, 3.5)] + [([0, 4, 11], r) for r in (1.5, 3.5, 6.5)]
                                + [([-3, 0, -4], r) for r in (1.5, 3.5)]), ("ray_from_sphere", [([3, 0, 4], 6.5)])):
            mixed[name] = [
                {"pair": "ray_sphere", "a": {"origin": [1, 2, 3], "direction": turned([0, 0, 2], axis), "length": 4}, "alarm": 0,
                 "contact": 0.5, "b": {"center": [x + y for x, y in zip([1, 2, 3], turned(center, axis))], "radius": r}}
                for axis in range(3) for center, r in spheres_]
        # 3 over planes and 2 under them, whose normals have the length 1 or 2.
        planes = [(axis, sign * length, {"normal": turned([0, 0, sign * length], axis), "offset": 4 * length})
                  for axis in range(3) for sign in (1, -1) for length in (1, 2)]
        mixed["sphere_plane"] = [
            {"pair": "sphere_plane", "a": {"center": turned([1, 2, (4 + d) * (1 if way > 0 else -1)], axis), "radius": i},
             "alarm": alarm, "contact": 0.5, "b": plane}
            for axis, way, plane in planes for d in (3, -2) for i in (1.5, 3.5) for alarm in (0, 1)]
        mixed["capsule_plane"] = [
            {"pair": "capsule_plane", "a": {end: turned([1, 2, (4 + d + up) * (1 if way > 0 else -1)], axis)
                                            for end, up in zip(ends, (0, 4))} | {"radius": i},
             "alarm": alarm, "contact": 0.5, "b": plane}
            for axis, way, plane in planes for ends in (("start", "end"), ("end", "start")) for d in (3, -2) for i in (1.5, 3.5)
            for alarm in (0, 1)]
        # Through the inside of a triangle from either side, past it, and not as far as it.
        lines = [([1, 1, 3], [1, 1, -5]), ([1, 1, -5], [1, 1, 3]), ([3, 3, 3], [3, 3, -5]), ([1, 1, 3], [1, 1, 1]), ([-1, 0, 3], [3, 2, -3])]
        mixed["triangle_line"] = [{"pair": "triangle_line", "a": triangle, "b": {"start": start, "end": end}, "alarm": 0, "contact": 0}
                                  for start, end in lines]
        mixed["ray_triangle"] = [
            {"pair": "ray_triangle", "a": {"origin": start, "direction": [(y - x) / 2 for x, y in zip(start, end)], "length": 2},
             "b": triangle, "alarm": 0, "contact": 0} for start, end in lines]
        # Boxes after quarter turns and thirds of a turn: 3 apart, and a quarter in each other where one way out is the shortest.
        turns = ([0, 0, 0, 1], [1, 1, 1, 1], [0, 0, 2, 2], [-1, 0, 0, 1])
        sizes = ([2, 4, 8], [8, 2, 4], [4, 2, 8], [2, 8, 4])  # half lengths along the axes of space of a box of 2, 4, 8
        def rotated(i, center):
            return {"center": center, "orientation": turns[i], "extents": [2, 4, 8]}

        # Each turn beside itself and the next. Exact answers of two such boxes take milliseconds: the alarm distances take turns.
        beside = [(i, j % 4, axis, gap) for i in range(4) for j in (i, i + 1) for axis in range(3) for gap in (3, -0.25)]
        mixed["obb_obb"] = [
            {"pair": "obb_obb", "a": rotated(i, [1, 2, 3]), "alarm": (i + axis) % 2, "contact": 0.5,
             "b": rotated(j, [x + (sizes[i][k] + sizes[j][k] + gap if k == axis else 0.5) for k, x in enumerate((1, 2, 3))])}
            for i, j, axis, gap in beside]
        mixed["sphere_obb"] = [
            {"pair": "sphere_obb", "a": {"center": [x + (sizes[i][k] + 3 if k == axis else 0.5) for k, x in enumerate((1, 2, 3))], "radius": r},
             "alarm": alarm, "contact": 0.5, "b": rotated(i, [1, 2, 3])}
            for i in range(4) for axis in range(3) for r in (1, 3.5) for alarm in (0, 1)]
        mixed["obb_plane"] = [
            {"pair": "obb_plane", "a": rotated(i, [1, 2, 3]), "alarm": alarm, "contact": 0.5,
             "b": {"normal": turned([0, 0, 2], axis), "offset": 2 * ([1, 2, 3][(2 + axis) % 3] - sizes[i][(2 + axis) % 3] - gap)}}
            for i in range(4) for axis in range(3) for gap in (3, -0.25) for alarm in (0, 1)]
        # The same boxes as cubes, and what has its nearest end or corner beside the middle of a face: 3 apart, or a quarter in it.
        def cube(i, center):
            return {corner: [x + sign * size for x, size in zip(center, sizes[i])] for corner, sign in (("min", -1), ("max", 1))}

        def pointed(axis, at, up):
            """A triangle whose first corner is `at`, and whose others are `up` from it along the axis."""
            return {"vertices": [at, [x + (up if k == axis else 3) for k, x in enumerate(at)],
                                 [x + (up if k == axis else -2) for k, x in enumerate(at)]]}

        middle = [1, 2, 3]
        mixed["cube_obb"] = [
            {"pair": "cube_obb", "a": cube(i, middle), "alarm": alarm, "contact": 0.5,
             "b": rotated(j, [x + (sizes[i][k] + sizes[j][k] + gap if k == axis else 0.5) for k, x in enumerate(middle)])}
            for i, j, axis, gap in beside if j == (i + 1) % 4 for alarm in (0, 1)]
        faces = [(i, axis, gap, [x + (sizes[i][k] + gap if k == axis else 0.5) for k, x in enumerate(middle)])
                 for i in (0, 1) for axis in range(3) for gap in (3, -0.25)]
        for name, box in (("cube", cube), ("obb", rotated)):
            mixed[f"capsule_{name}"] = [
                {"pair": f"capsule_{name}", "b": box(i, middle), "alarm": alarm, "contact": 0.5,
                 "a": {"start": at, "end": [x + (2 if k == axis else 0) for k, x in enumerate(at)], "radius": r}}
                for i, axis, gap, at in faces if gap > 0 for r in (1, 3.5) for alarm in (0, 1)]
            mixed[f"{name}_triangle"] = [{"pair": f"{name}_triangle", "a": box(i, middle), "b": pointed(axis, at, 4), "alarm": alarm, "contact": 0.5}
                                         for i, axis, gap, at in faces for alarm in (0, 1)]
        mixed["capsule_triangle"] = [
            {"pair": "capsule_triangle", "a": {"start": [1, 1, 3], "end": [1, 1, 7], "radius": r}, "alarm": alarm, "contact": 0.5, "b": triangle}
            for r in (1, 3.5) for alarm in (0, 1)]
        wide = {"vertices": [[-8, -8, 0], [8, -8, 0], [0, 8, 0]]}
        mixed["triangle_triangle"] = [{"pair": "triangle_triangle", "a": wide, "b": pointed(2, [0, 0, gap], 4), "alarm": alarm, "contact": 0.5}
                                      for gap in (3, -0.25) for alarm in (0, 1)]
        below = {axis: {"normal": turned([0, 0, 2], axis), "offset": 2} for axis in range(3)}
        mixed["cube_plane"] = [
            {"pair": "cube_plane", "a": cube(i, [1 + (sizes[i][k] + gap if k == (2 + axis) % 3 else 0) for k in range(3)]), "alarm": alarm,
             "contact": 0.5, "b": below[axis]} for i in range(4) for axis in range(3) for gap in (3, -0.25) for alarm in (0, 1)]
        mixed["triangle_plane"] = [
            {"pair": "triangle_plane", "a": pointed((2 + axis) % 3, turned([1, 2, 1 + gap], axis), 4), "alarm": alarm, "contact": 0.5, "b": below[axis]}
            for axis in range(3) for gap in (3, -0.25) for alarm in (0, 1)]
        # The same boxes by their corners, and beside them a point with three others behind it. A radius where an engine has one.
        def hull(points, radius=0):
            return {"vertices": points, "radius": radius}

        def corners(box):
            return [[box["max" if k >> i & 1 else "min"][i] for i in range(3)] for k in range(8)]

        boxes_by_corners = [hull(corners(cube(i, middle))) for i in range(4)]
        mixed["sphere_hull"] = [{**q, "pair": "sphere_hull", "b": boxes_by_corners[i // 12]} for i, q in enumerate(mixed["sphere_obb"])]
        mixed["sphere_round_hull"] = [{**q, "b": {**q["b"], "radius": (q["a"]["radius"] - 1) / 2}} for q in mixed["sphere_hull"]]
        mixed["hull_hull"] = [{"pair": "hull_hull", "a": boxes_by_corners[i], "alarm": alarm, "contact": 0.5,
                               "b": hull([*pointed(axis, at, 4)["vertices"], [x + (6 if k == axis else k) for k, x in enumerate(at)]])}
                              for i, axis, gap, at in faces for alarm in (0, 1)]
        mixed["hull_plane"] = [{**q, "pair": "hull_plane", "a": hull(corners(q["a"]))} for q in mixed["cube_plane"]]
        cls.files = {}
        for name, questions in {"spheres": spheres, "boxes": boxes, **mixed}.items():
            if cls.most and len(questions) > cls.most:
                questions = random.Random(f"{name}1").sample(questions, cls.most)
            for scalar in cls.scalars:
                path = cls.folder / f"{name}.{scalar}.jsonl"
                asked = "".join(json.dumps({**q, "scalar": scalar}) + "\n" for q in questions)
                made = run("annotate", "-", "--family", name, "-o", path, stdin=asked)
                assert made.returncode == 0, made.stderr
                cls.files.setdefault(name, []).append(path)
        # The program looks for its adapters beside itself: here it has none.
        cls.alone = cls.folder / "contact-oracle"
        shutil.copy(TOOL, cls.alone)

    def test_every_engine_here_is_right_where_arithmetic_is_exact(self):
        for engine in listed():
            name = engine["name"]
            with self.subTest(name):
                if not engine["command"]:
                    self.skipTest(f"{name} is not here; ./run engines installs it")
                wrong = {family for family, engines in WRONG.items() if name in engines}
                blind = {family for family, engines in WRONG_DECISIONS.items() if name in engines}
                report = self.folder / "report.json"
                asked = (files for family, files in self.files.items() if family != "sphere_round_hull" or name not in SHARP)
                made = run("certify", *(file for files in asked for file in files), "--engine", name, "--level", "decisions",
                           "--json", report, "--start-limit", 60)
                self.assertEqual((made.returncode, made.stderr), (1 if blind else 0, ""), made.stdout)
                worst = {}
                for one in json.loads(report.read_text())["families"]:
                    # Where no number was judged, decisions are all that there is to be right in.
                    level = "bounded" if one["level"] == "decisions" and not one["fields"] else one["level"]
                    worst[one["family"]] = max(worst.get(one["family"], 0), LEVELS.index(level))
                for family, level in worst.items():
                    least = "decisions" if name in TOLERANT | DECIDING or family in wrong else "bounded"
                    if family not in blind:
                        self.assertLessEqual(level, LEVELS.index(least), f"{family}\n{made.stdout}")
                for family in wrong | blind:
                    self.assertGreater(worst[family], LEVELS.index("bounded" if family in wrong else "decisions"), f"{name} is right now: {family}")

    def test_every_engine_is_asked_the_pairs_that_it_has_a_function_for(self):
        boxes_alone = {"bullet-box", "bullet-box-float"}
        no_capsules = {"cannon", "cannon-aabb", "dart", "eigen", "oimo", "simbody", "three"} | boxes_alone
        names = {engine["name"] for engine in listed()}
        convex = {"bullet", "bullet-float", "bullet-gjk", "bullet-gjk-float", "fcl", "fcl-distance", "libccd", "libccd-gjk", "ode"}
        bullets = {"bullet", "bullet-float", "bullet-gjk", "bullet-gjk-float"}
        npm = {"ammo", "havok", "jolt", "physx", "rapier"}  # these have triangles, and cannon, mujoco-js, oimo and three boxes
        without = {"sphere_sphere": {"cannon-aabb", "eigen"} | boxes_alone, "sphere_cube": {"cannon-aabb", "simbody"} | boxes_alone,
                   "sphere_capsule": no_capsules, "capsule_capsule": no_capsules,
                   # fcl-distance has a function, which sets no distance where they penetrate: docs/scoreboard.md.
                   "sphere_triangle": names - {"bullet", "bullet-float", "bullet-gjk", "bullet-gjk-float", "cgal-epick", "fcl", "havok", "jolt",
                                               "libccd", "libccd-gjk", "ode", "physx", "rapier", "three"},
                   "sphere_plane": names - {"ammo", "bullet", "bullet-float", "cannon", "cgal-epick", "eigen", "fcl", "jolt", "mujoco",
                                            "mujoco-js", "ode", "rapier", "simbody", "three"},
                   "capsule_plane": names - {"ammo", "bullet", "bullet-float", "cgal-epick", "fcl", "jolt", "mujoco", "mujoco-js", "ode",
                                             "rapier"},
                   # Most others cast rays along a unit direction, which whoever asks would have to round.
                   "ray_sphere": names - {"bullet", "bullet-float", "cgal-epick", "jolt", "mujoco", "rapier"},
                   "ray_triangle": names - {"bullet", "bullet-float", "cgal-epick", "jolt", "rapier"},
                   "triangle_line": names - {"bullet", "bullet-float", "cgal-epick", "jolt"},
                   "sphere_obb": names - convex - npm - {"cannon", "mujoco-js", "oimo", "three", "dart", "mujoco", "mujoco-convex", "bullet-mpr-float"},
                   "capsule_triangle": names - convex - npm - {"three"}, "obb_triangle": names - convex - npm,
                   "cube_triangle": names - convex - npm - {"cgal-epick", "three"},
                   "triangle_triangle": names - convex - npm - {"cgal-epick"} | {"ode"},  # it has a function, which ends the process
                   **{pair: names - convex - npm - {"cannon", "mujoco-js", "oimo", "three", "bullet-box", "bullet-box-float", "bullet-mpr-float", "dart", "mujoco", "mujoco-convex"}
                      for pair in ("obb_obb", "cube_obb")},
                   "capsule_cube": names - convex - npm - {"mujoco", "mujoco-convex", "mujoco-js", "bullet-mpr-float", "three"},
                   "capsule_obb": names - convex - npm - {"mujoco", "mujoco-convex", "mujoco-js", "bullet-mpr-float"},
                   # Debian's MuJoCo 2.2.2 has meshes, and its mesh of a triangle has no volume.
                   **{pair: names - bullets - npm - {"fcl", "fcl-distance", "libccd", "libccd-gjk", "ode", "cannon", "mujoco", "mujoco-js"}
                      for pair in ("sphere_hull", "cube_hull", "obb_hull", "hull_hull")},
                   "capsule_hull": names - bullets - npm - {"fcl", "fcl-distance", "libccd", "libccd-gjk", "ode", "mujoco", "mujoco-js"},
                   # ODE's process would end.
                   "triangle_hull": names - bullets - npm - {"fcl", "fcl-distance", "libccd", "libccd-gjk"},
                   "hull_plane": names - {"ammo", "bullet", "bullet-float", "cannon", "fcl", "jolt", "mujoco", "mujoco-js", "ode", "rapier"},
                   "obb_plane": names - {"ammo", "bullet", "bullet-float", "cannon", "fcl", "jolt", "mujoco", "mujoco-js", "ode", "rapier", "simbody"},
                   "cube_plane": names - {"ammo", "bullet", "bullet-float", "cannon", "cgal-epick", "fcl", "jolt", "mujoco", "mujoco-js", "ode", "rapier",
                                          "simbody"},
                   "triangle_plane": names - {"ammo", "bullet", "bullet-float", "cannon", "cgal-epick", "fcl", "jolt", "ode", "rapier"}}
        for engine in listed():
            if not engine["command"]:
                continue
            hello = subprocess.run(engine["command"], input='{"op":"hello","protocol":1}\n{"op":"stop"}\n', capture_output=True,
                                   text=True, check=True, timeout=300)
            pairs = json.loads(hello.stdout.splitlines()[0])["pairs"]
            for pair, those in without.items():
                self.assertEqual(pair in pairs, engine["name"] not in those, engine["name"])

    def test_the_list_says_of_every_engine_whether_it_is_here(self):
        for tool in (TOOL, self.alone):
            engines, lines = listed(tool), run("engines", tool=tool).stdout.splitlines()
            self.assertLessEqual(NAMES, {e["name"] for e in engines})
            for engine in engines:
                line, = (line for line in lines if line.split()[0] == engine["name"])
                self.assertEqual(engine["command"] is None, line.endswith("not here, ./run engines installs it"), line)

    def test_an_engine_that_is_not_here_is_refused_with_what_installs_it(self):
        made = run("certify", *self.files["spheres"], "--engine", "fcl", tool=self.alone)
        self.assertEqual((made.returncode, made.stdout), (2, ""), made.stderr)
        self.assertIn("engine 'fcl' is not here; ./run engines installs it", made.stderr)

    def test_an_adapter_that_does_not_load_is_an_engine_that_does_not_start(self):
        library = self.folder / "engines" / "ode.so"
        library.parent.mkdir()
        library.write_text("no library")
        made = run("certify", *self.files["spheres"], "--engine", "ode", tool=self.alone)
        self.assertEqual(made.returncode, 3, made.stdout)
        self.assertIn("ode.so", made.stderr)

    def test_an_engine_of_node_without_node_does_not_start(self):
        here = [e["name"] for e in listed() if e["command"] and e["command"][0] == "node"]
        if not here:
            self.skipTest("no engine of npm is here; ./run engines installs them")
        made = run("certify", *self.files["spheres"], "--engine", here[0], env={**os.environ, "PATH": str(self.folder)})
        self.assertEqual(made.returncode, 3, made.stdout)
        self.assertIn("node", made.stderr)


class AdaptersCampaign(Adapters):
    """All of these questions, and to engines of binary64 in that scalar too."""
    most, scalars = None, ("binary64", "binary32")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
