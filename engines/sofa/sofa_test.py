#!/usr/bin/env python3
"""SOFA itself, where it is: the environment variable CONTACT_SOFA names the folder where it was built or installed. The engine and
the plug-in of this folder are built against it, unless CONTACT_SOFA_BUILD names a folder where they are built already:

    sofa_test.py contact-oracle"""
import json
import os
import re
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tool"))
from published import published  # noqa: E402

TOOL = sys.argv[1]
ROOT = Path(__file__).resolve().parents[2]
RECORDED = ROOT / "golden/recorded/sofa-2a278d8"
PAIRS = ("sphere_sphere", "rigid_sphere_rigid_sphere", "sphere_rigid_sphere", "cube_cube")


def run(*arguments, stdin=None, **options):
    return subprocess.run([TOOL, *published(arguments)], input=stdin, capture_output=True, text=True, timeout=600, check=False, **options)


def bits(x):
    """A number of an answer as its bits; every NaN is one, and so is every zero."""
    return struct.pack("<d", float("nan") if x == "NaN" else float(x) + 0.0)


def claim(answer):
    contact = answer.get("contact")
    if contact:
        contact = {key: [bits(x) for x in (value if isinstance(value, list) else [value])] for key, value in contact.items()}
    return answer["overlap"], contact


class Sofa(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        sofa = os.environ.get("CONTACT_SOFA", "")
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.build = Path(os.environ.get("CONTACT_SOFA_BUILD") or cls.folder / "build")
        if not os.environ.get("CONTACT_SOFA_BUILD"):
            capsules = any(Path(sofa).glob("**/lib/libCollisionOBBCapsule.*"))
            made = subprocess.run(["cmake", "-S", ROOT / "engines/sofa", "-B", cls.build, "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={sofa}",
                                   f"-DCONTACT_SOFA_CAPSULES={capsules}"], capture_output=True, text=True, check=False)
            if "SOFA is not found" in made.stderr:
                raise unittest.SkipTest("SOFA is not found: CONTACT_SOFA is not where it was built or installed")
            assert made.returncode == 0, made.stderr
            made = subprocess.run(["cmake", "--build", cls.build], capture_output=True, text=True, check=False)
            assert made.returncode == 0, made.stdout[-4000:]
        cls.scenes = {**os.environ, "SOFA_PLUGIN_PATH": f"{cls.build}:{sofa}/lib", "LD_LIBRARY_PATH": f"{sofa}/lib"}
        cls.can_run_scenes = any(Path(sofa, "lib").glob("libSofa.Component.Collision.Response.Contact.so*"))

    def answers(self, library, *questions):
        """What an engine says, by id."""
        file = self.folder / f"{self.id()}.{library}.jsonl"
        made = run("certify", *questions, "--engine-library", self.build / f"{library}.so", "--record", file)
        self.assertEqual(made.returncode, 1, made.stderr)  # refuted: every set has questions that it fails on
        return {a["id"]: claim(a) for a in map(json.loads, file.read_text().splitlines()[1:])}

    def test_its_answers_are_the_recorded_ones_bit_for_bit_in_either_order(self):
        compared = contacts = 0
        for pair in PAIRS:
            recorded = {a["id"]: claim(a) for a in map(json.loads, (RECORDED / f"{pair}.jsonl").read_text().splitlines()[1:])}
            for library in ("sofa", "sofa-second-first"):
                with self.subTest(f"{pair} {library}"):
                    self.assertEqual(self.answers(library, ROOT / f"golden/{pair}/upstream.jsonl"), recorded)
            compared += len(recorded)
            contacts += sum(contact is not None for _, contact in recorded.values())
        self.assertEqual(compared, 2400)
        self.assertGreater(contacts, 900)

    def test_its_verdict_is_the_recorded_one(self):
        counts = lambda text: re.findall(r"^ *(?:decisions|overlap|contact|normal|point1|point2|value)\b.*$", text, re.M)
        for pair in PAIRS:
            question = ROOT / f"golden/{pair}/upstream.jsonl"
            live = run("certify", question, "--engine-library", self.build / "sofa.so")
            recorded = run("certify", question, "--results", RECORDED / f"{pair}.jsonl")
            self.assertEqual((live.returncode, counts(live.stdout)), (recorded.returncode, counts(recorded.stdout)), pair)

    def test_plain_double_answers_generated_questions_as_it_does(self):
        for pair in PAIRS:
            fresh = ("--generate", 100, "--seed", 20, "--pair", pair)
            emulated = self.folder / f"{pair}.plain.jsonl"
            made = run("certify", *fresh, "--engine", "plain-double", "--points", "center", "--record", emulated)
            self.assertEqual(made.returncode, 1, made.stderr)  # refuted: every set has questions that it fails on
            plain = {a["id"]: claim(a) for a in map(json.loads, emulated.read_text().splitlines()[1:]) if "overlap" in a}
            self.assertGreater(len(plain), 1000)
            live = self.answers("sofa", *fresh)
            self.assertEqual({i: live[i] for i in plain}, plain, pair)

    def asked(self, *queries):
        """Questions of one pair with their truth, as a file."""
        file = self.folder / f"{self.id()}.{queries[0]['pair']}.jsonl"
        made = run("annotate", "-", "--family", "asked", "-o", file, stdin="".join(json.dumps(q) + "\n" for q in queries))
        self.assertEqual(made.returncode, 0, made.stderr)
        return file

    # Small integers, where arithmetic is exact: a ray along each axis beside a sphere, 3 from it; lines through a triangle and past it.
    def test_intersectors_that_join_at_run_time_are_asked_in_the_right_way(self):
        turned = lambda x, axis: x[-axis:] + x[:-axis] if axis else x
        rays = [{"pair": "ray_sphere", "a": {"origin": [1, 2, 3], "direction": turned([0, 0, 1], axis), "length": 8},
                 "b": {"center": [x + y for x, y in zip([1, 2, 3], turned([3, 0, 4], axis))], "radius": r}} for axis in range(3) for r in (2.5, 3, 3.5)]
        triangle = {"vertices": [[0, 0, 0], [4, 0, 0], [0, 4, 0]]}
        lines = [([1, 1, 3], [1, 1, -5]), ([1, 1, -5], [1, 1, 3]), ([3, 3, 3], [3, 3, -5]), ([1, 1, 3], [1, 1, 1]), ([-1, 0, 3], [3, 2, -3])]
        crossings = [{"pair": "triangle_line", "a": triangle, "b": {"start": p, "end": q}} for p, q in lines]
        crossings += [{"pair": "ray_triangle", "a": {"origin": p, "direction": [(y - x) / 2 for x, y in zip(p, q)], "length": 2}, "b": triangle}
                      for p, q in lines]
        files = [self.asked(*({"alarm": 0, "contact": 0.5, **q} for q in rays + crossings if q["pair"] == pair))
                 for pair in ("ray_sphere", "triangle_line", "ray_triangle")]
        for library in ("sofa", "sofa-second-first"):
            made = run("certify", *files, "--engine-library", self.build / f"{library}.so", "--level", "bounded")
            self.assertEqual((made.returncode, made.stderr), (0, ""), made.stdout)

    def test_what_it_does_differently_from_the_mathematics(self):
        ball = lambda x, r: {"center": [x, 0, 0], "radius": r}
        for query, overlap, contact in (
                # Past the end of a ray: 0.5 from its end, radius 0.75.
                ({"pair": "ray_sphere", "a": {"origin": [0, 0, 0], "direction": [1, 0, 0], "length": 1}, "b": ball(1.5, 0.75)}, False, None),
                # Squares overflow: centres 2e200 apart, radii 1e200.
                ({"pair": "sphere_sphere", "a": ball(0, 1e200), "b": ball(3e200, 1e200)}, True, "NaN")):
            [(said, found)] = self.answers("sofa", self.asked({"alarm": 0, "contact": 0, **query})).values()
            self.assertEqual(said, overlap, query)
            self.assertEqual(found is None, contact is None, query)
        [(said, found)] = self.answers("sofa", self.asked({"pair": "rigid_sphere_rigid_sphere", "alarm": 0, "contact": 0, "a": ball(1, 2),
                                                           "b": ball(1, 3)})).values()
        self.assertEqual((said, found["normal"], found["value"]), (True, [bits("NaN")] * 3, [bits(-5)]))

    def numbers(self, query, library="sofa"):
        """The contact that it gives for one question, as numbers; nothing where there is none."""
        file = self.folder / f"{self.id()}.jsonl"
        made = run("certify", self.asked({"alarm": 0, "contact": 0, **query}), "--engine-library", self.build / f"{library}.so", "--record", file)
        self.assertTrue(file.is_file(), made.stderr)  # whatever the verdict
        return json.loads(file.read_text().splitlines()[1])["contact"]

    # Mat.h, equalsZero: a determinant up to 2.2e-16 counts as 0. Here it is 4e-12 times the line's length, or that of a ray's direction.
    def test_small_triangles_are_crossed_by_long_lines_and_not_by_short_ones(self):
        self.assertEqual([self.crossing(2e-6, length) is not None for length in (1, 1e-4, 1e-5, 2e-6)], [True, True, False, False])
        ray = lambda edge, length: self.numbers({"pair": "ray_triangle", "a": {"origin": [edge / 4, edge / 4, length / 2], "direction": [0, 0, -1],
                                                                               "length": length}, "b": {"vertices": [[0, 0, 0], [edge, 0, 0], [0, edge, 0]]}})
        self.assertEqual([ray(edge, 2e-6) is not None for edge in (2e-6, 1e-7, 1e-8)], [True, True, False])

    def crossing(self, edge, length):
        x = edge / 4
        return self.numbers({"pair": "triangle_line", "a": {"vertices": [[0, 0, 0], [edge, 0, 0], [0, edge, 0]]},
                             "b": {"start": [x, x, length / 2], "end": [x, x, -length / 2]}})

    # Capsules, each along an axis or in a plane, of radius 0.5 or 0.
    def test_capsules_where_they_are_built(self):
        if b'"capsule_capsule"' not in (self.build / "sofa.so").read_bytes():
            self.skipTest("SOFA is built without the plug-in CollisionOBBCapsule")
        capsule = lambda p, q, r=0.5: {"start": p, "end": q, "radius": r}
        two = lambda first, second: self.numbers({"pair": "capsule_capsule", "alarm": 10, "a": first, "b": second})
        # Side by side 3 apart, the middle of what they share; one above the other; end to end.
        right = [(capsule([0, 0, 0], [4, 0, 0]), capsule([0, 3, 0], [4, 3, 0]), ([0, 1, 0], [2, 0.5, 0], [2, 2.5, 0], 2)),
                 (capsule([-1, 0, 0], [1, 0, 0]), capsule([0, -1, 3], [0, 1, 3]), ([0, 0, 1], [0, 0, 0.5], [0, 0, 2.5], 2)),
                 (capsule([0, 0, 0], [1, 0, 0]), capsule([3, 0, 0], [7, 0, 0]), ([1, 0, 0], [1.5, 0, 0], [2.5, 0, 0], 1))]
        for first, second, found in right:
            said = two(first, second)
            self.assertEqual([said[key] for key in ("normal", "point1", "point2", "value")], list(found))
        ball = {"pair": "sphere_capsule", "a": {"center": [2, 3, 0], "radius": 1}, "b": capsule([0, 0, 0], [4, 0, 0]), "alarm": 2}
        for library in ("sofa", "sofa-second-first"):
            said = self.numbers(ball, library)
            self.assertEqual([said[key] for key in ("normal", "point1", "point2", "value")], [[0, -1, 0], [2, 2, 0], [2, 0.5, 0], 1.5])
        # What docs/sofa-map.md says of them: D = 5 and not 2.5; D = 10 and not 1; no numbers; in the middle of a short axis.
        self.assertAlmostEqual(two(capsule([0, 0, 0], [1, 0, 0]), capsule([3, 1, 0], [0, 2, 0]))["value"], 5 ** 0.5 - 1)
        self.assertAlmostEqual(two(capsule([1, 1, 0], [1, 1, 0]), capsule([0, 0, 0], [4, 0, 0]))["value"], 10 ** 0.5 - 1)
        self.assertEqual(self.numbers({"pair": "sphere_capsule", "a": {"center": [5, 0, 0], "radius": 1}, "b": capsule([0, 0, 0], [0, 0, 0])})["value"], "NaN")
        self.assertEqual(two(capsule([-1, 0, 0], [1, 0, 0]), capsule([0, -1, 0], [0, 1, 0]))["normal"], ["NaN"] * 3)
        self.assertEqual(two(capsule([0, 0, 0], [1e-4, 0, 0], 0), capsule([0, 0, 1e-4], [0, 1e-4, 1e-4], 0))["point2"], [0, 5e-5, 1e-4])

    # The plug-in, and scenes.

    def contacts(self, scene, *options):
        if not self.can_run_scenes:
            self.skipTest("SOFA is built without the modules that run scenes")
        output = self.folder / f"{self.id()}.contacts.jsonl"
        made = subprocess.run([self.build / "sofa-contacts", scene, *options, "-o", output], capture_output=True, text=True, env=self.scenes,
                              timeout=600, cwd=self.folder, check=False)
        self.assertEqual(made.returncode, 0, made.stderr)
        header, *lines = map(json.loads, output.read_text().splitlines())
        return header, lines, made.stdout.splitlines()

    def marbles(self, *intersections, name="marbles.scn"):
        """The example with other intersection components, and the plug-in that has them."""
        text = (ROOT / "docs/examples/scenes/marbles.scn").read_text()
        own = '<MinProximityIntersection alarmDistance="0.125" contactDistance="0.0625"/>'
        self.assertIn(own, text)
        scene = self.folder / name
        scene.write_text(text.replace(own, '<RequiredPlugin name="ContactOracle"/>' + "".join(intersections)))
        return scene

    def test_detect_finds_what_sofa_finds_in_the_example_scene(self):
        scene = ROOT / "docs/examples/scenes/marbles.scn"
        text = scene.read_text().replace('alarmDistance="0.125"', 'alarmDistance="0.5"')
        self.assertNotEqual(text, scene.read_text())
        wide = self.folder / "wide.scn"
        wide.write_text(text)
        header, lines, _ = self.contacts(wide)
        made = run("detect", wide, "--points", "center", "--json")
        self.assertEqual((made.returncode, made.stderr), (0, ""))
        ours = [json.loads(line) for line in made.stdout.splitlines()]
        self.assertEqual((header["alarm"], header["contact"]), (ours[0]["alarm"], ours[0]["contact"]))
        pair = lambda c: frozenset((c[side]["model"], c[side]["index"]) for side in ("first", "second"))
        self.assertEqual({pair(c) for c in lines}, {pair(c) for c in ours[1:]})
        self.assertGreater(len(lines), 3)
        values = {pair(c): c["value"] for c in ours[1:]}
        for c in lines:
            self.assertAlmostEqual(c["value"], values[pair(c)], delta=1e-15)

    def test_the_plug_in_decides_exactly_and_a_recorded_run_is_certified(self):
        exact = '<ExactDiscreteIntersection name="inner" alarmDistance="0.125" contactDistance="0.0625"/>'
        sofas = '<MinProximityIntersection name="inner" alarmDistance="0.125" contactDistance="0.0625"/>'
        for component, level in ((exact, "correctly-rounded"), (sofas, "bounded")):
            name = component.split()[0].strip("<")
            record = f'<RecordingIntersection intersection="@inner" filename="{self.folder}/{name}"/>'
            _, _, said = self.contacts(self.marbles(record, component), "--steps", "60")
            self.assertGreater(int(said[-1].split()[2]), 0, said)
            asked = []
            for queries in sorted(self.folder.glob(f"{name}.*.queries.jsonl")):
                asked.append(self.folder / f"{queries.name.split('.')[1]}.{name}.jsonl")
                made = run("annotate", queries, "--family", "simulation", "-o", asked[-1])
                self.assertEqual(made.returncode, 0, made.stderr)
            self.assertEqual(len(asked), 2)  # spheres, and the boxes around them
            made = run("certify", *asked, "--results", self.folder / f"{name}.answers.jsonl", "--level", level)
            self.assertEqual(made.returncode, 0, made.stdout + made.stderr)
            self.assertIn(f"CERTIFIED: {name}", made.stdout)

    # What a scene that runs asks for, but for its pipeline.
    MODULES = "".join(f'<RequiredPlugin name="Sofa.Component.{m}"/>' for m in
                      ("Collision.Detection.Algorithm", "Collision.Detection.Intersection", "Collision.Geometry", "StateContainer",
                       "Collision.Response.Contact", "AnimationLoop")) + '<RequiredPlugin name="ContactOracle"/><DefaultAnimationLoop/>'
    PIPELINE = "<CollisionPipeline/><BruteForceBroadPhase/><BVHNarrowPhase/><CollisionResponse/>"

    def scene(self, name, *elements):
        path = self.folder / f"{name}.scn"
        path.write_text(f'<Node name="root">{self.MODULES}{"".join(elements)}</Node>')
        return path

    def test_models_of_two_pipelines_do_not_meet(self):
        node = '<Node name="{}">{}<MechanicalObject position="1 2 3"/><SphereCollisionModel/></Node>'
        own = self.PIPELINE + "<DiscreteIntersection/>"
        for name, elements, count in (("two", (node.format("a", own), node.format("b", own)), 0), ("one", (own, node.format("a", ""), node.format("b", "")), 1)):
            scene = self.scene(name, *elements)
            _, lines, _ = self.contacts(scene)
            made = run("detect", scene, "--json")
            self.assertEqual((len(lines), len(made.stdout.splitlines()) - 1), (count, count), name)
            names = lambda found: [{c[side]["model"] for side in ("first", "second")} for c in found]
            self.assertEqual(names(lines), names(map(json.loads, made.stdout.splitlines()[1:])))

    def test_a_scene_gives_a_cube_model_no_boxes(self):
        node = '<Node name="{}"><CubeCollisionModel size="2" minBBox="0 0 0" maxBBox="1 1 1"/></Node>'
        record = f'<RecordingIntersection intersection="@inner" filename="{self.folder}/cubes"/><DiscreteIntersection name="inner"/>'
        _, lines, _ = self.contacts(self.scene("cubes", self.PIPELINE, record, node.format("a"), node.format("b")))
        self.assertEqual(lines, [])
        asked = [json.loads(line) for line in (self.folder / "cubes.cube_cube.queries.jsonl").read_text().splitlines()]
        nothing = {"min": [0, 0, 0], "max": [0, 0, 0]}
        self.assertEqual([(q["a"], q["b"]) for q in asked], [(nothing, nothing)])  # the roots of two empty trees

    def test_the_plug_in_gives_coincident_centres_a_normal(self):
        # With a quote in the name, which is no end of a text in JSON.
        spheres = '<Node name="{}"><MechanicalObject position="1 2 3"/><SphereCollisionModel name="s&quot;" radius="2"/></Node>'
        found = {}
        for component in ("DiscreteIntersection", "ExactDiscreteIntersection"):
            scene = self.scene(component, self.PIPELINE, f"<{component}/>", spheres.format("a"), spheres.format("b"))
            _, [found[component]], _ = self.contacts(scene)
        self.assertEqual(found["DiscreteIntersection"]["normal"], ["NaN"] * 3)
        self.assertEqual(found["ExactDiscreteIntersection"]["normal"], [1, 0, 0])
        self.assertEqual([found[c]["value"] for c in found], [-4, -4])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
