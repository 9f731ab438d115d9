#!/usr/bin/env python3
"""detect reads the collision part of SOFA's scenes. Every expected number is worked out by hand, in its comment:

    sofa_scene_test.py contact-oracle"""
import json
import math
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOL = sys.argv[1]
ROOT = Path(__file__).resolve().parents[1]


class SofaScene(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def scene(self, *lines, name="s.scn"):
        path = self.folder / name
        path.write_text("\n".join(['<Node name="root">', *lines, "</Node>"]) + "\n")
        return path

    def detect(self, *args):
        return subprocess.run([TOOL, "detect", *map(str, args)], capture_output=True, text=True, timeout=120, check=False)

    def contacts(self, *args):
        done = self.detect(*args, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        header, *lines = map(json.loads, done.stdout.splitlines())
        return header, lines, done.stderr

    def refused(self, *words, lines):
        done = self.detect(self.scene(*lines))
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        for word in words:
            self.assertIn(word, done.stderr)

    def centers(self, *lines, of="/a/spheres"):
        """Where a model's spheres are: the points under `center` of contacts with one that is as large as all."""
        probe = ('<Node name="probe"><MechanicalObject/><SphereCollisionModel name="all" radius="1000"/></Node>',)
        header, found, said = self.contacts(self.scene(*lines, *probe), "--points", "center")
        self.assertEqual((header["points"], said), ("center", ""))
        return [c["point1"] for c in found if c["first"]["model"] == of and c["second"]["model"] == "/probe/all"]

    # One node of particles; (x,y,z) as the comments say.
    def state(self, attributes, spheres=""):
        return f'<Node name="a"><MechanicalObject {attributes}/><SphereCollisionModel name="spheres" {spheres}/></Node>'

    def test_the_marbles_are_where_their_scene_says(self):
        # Bed: x and z in -3, -1, 1, 3, y = 0, radius 1. Marbles at (-1,1.75,-1) r 0.5, (1,1.75,-1) r 0.25, (-1,1.75,1.5) r 0.375.
        # The rod's frame (1,3,1) with ends (-1,-1.5,0) and (1,-1.5,0): (0,1.5,1) and (2,1.5,1), r 0.5.
        #   marble 0 over ball (-1,0,-1): 1.75 - 1.5 = 0.25 > 0.125: none. marble 1: 0.5 apart: none
        #   marble 2 over (-1,0,1): sqrt(1.75^2 + 0.5^2) = 1.820 - 1.375 > 0.125: none
        #   ends over (-1,0,1) and (1,0,1), or (1,0,1) and (3,0,1): sqrt(1 + 1.5^2) = sqrt 3.25 = 1.803 - 1.5 > 0.125: none
        #   marble 2 and end 0: (1,-0.25,-0.5): sqrt(1 + 0.0625 + 0.25) = 1.146 - 0.875 > 0.125: none
        # With alarm 0.25 marble 0 alone is within reach.
        done = self.detect(ROOT / "docs/examples/scenes/marbles.scn")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("alarm 0.125, contact 0.0625", done.stdout)
        header, found, _ = self.contacts(ROOT / "docs/examples/scenes/marbles.scn", "--alarm", 0.25)
        self.assertNotIn("no_intersector", header)
        self.assertEqual(found, [{"first": {"model": "/Bed/balls", "index": 5}, "second": {"model": "/Marbles/marbles", "index": 0},
                                  "id": 5, "normal": [0, 1, 0], "point1": [-1, 1, -1], "point2": [-1, 1.25, -1], "value": 0.1875}])

    def test_positions_are_scaled_turned_and_moved_in_that_order(self):
        self.assertEqual(self.centers(self.state('position="1 2 3  4 5 6" scale3d="2 1 -1" translation="0.5 0 1"')),
                         [[2.5, 2, -2], [8.5, 5, -5]])
        self.assertEqual(self.centers(self.state('position="1 2 3" scale="2" dx="1"')), [[3, 4, 6]])
        # A quarter turn about z takes (1,2,3) to (-2,1,3); translation2 comes last.
        [found] = self.centers(self.state('position="1 2 3" rotation="0 0 90" translation="10 0 0" rotation2="0 0 90" translation2="0 0 1"'))
        for x, y in zip(found, [-1, 8, 4]):  # (-2,1,3) -> (8,1,3) -> (-1,8,3) -> (-1,8,4)
            self.assertAlmostEqual(x, y, delta=1e-14)
        # About x, then y: (0,1,0) goes to (0,0,1), and that to (1,0,0).
        [found] = self.centers(self.state('position="0 1 0" rotation="90 90 0"'))
        for x, y in zip(found, [1, 0, 0]):
            self.assertAlmostEqual(x, y, delta=1e-15)

    def test_a_letter_of_its_own_is_single_precision_in_sofa(self):
        [found] = self.centers(self.state('position="0 0 0" dx="0.1" dy="0.5"'))
        self.assertEqual(found, [0.10000000149011612, 0.5, 0])  # float(0.1)
        self.assertEqual(self.centers(self.state('position="0 0 0" translation="0.1 0.5 0"')), [[0.1, 0.5, 0]])

    def test_mapped_states_follow_those_above(self):
        # A quarter turn about y takes (1,0,0) to (0,0,-1); its quaternion is (0, sqrt(1/2), 0, sqrt(1/2)).
        half = math.sqrt(0.5)
        rigid = f'<MechanicalObject template="Rigid3d" position="5 6 7  0 {half!r} 0 {half!r}"/>'
        child = '<Node name="b"><MechanicalObject position="1 0 0"/><SphereCollisionModel name="spheres"/><{}/></Node>'
        [found] = self.centers('<Node name="a">', rigid, child.format("RigidMapping"), "</Node>", of="/a/b/spheres")
        for x, y in zip(found, [5, 6, 6]):
            self.assertAlmostEqual(x, y, delta=1e-14)
        above = '<MechanicalObject position="1 1 1  2 2 2" translation="1 0 0"/>'
        self.assertEqual(self.centers('<Node name="a">', above, child.format("IdentityMapping"), "</Node>", of="/a/b/spheres"),
                         [[2, 1, 1], [3, 2, 2]])
        self.assertEqual(self.centers('<Node name="a">', above, child.format("BarycentricMapping"), "</Node>", of="/a/b/spheres"), [[1, 0, 0]])
        # Without a state of its own a node has that of the one above.
        self.assertEqual(self.centers('<Node name="a">', above, '<Node name="b"><SphereCollisionModel name="spheres"/></Node>', "</Node>",
                                      of="/a/b/spheres"), [[2, 1, 1], [3, 2, 2]])

    def test_spheres_come_from_a_loader_and_points_from_a_grid(self):
        (self.folder / "share/mesh").mkdir(parents=True)
        (self.folder / "share/mesh/two.sph").write_text("sph 1.0\n#nums 2\nsphe 1 1 2 3 0.5\nsphe 2 4 5 6 0.25\n")
        scene = self.scene('<Node name="a">', '<SphereLoader name="two" filename="mesh/two.sph" translation="0 0 1"/>',
                           '<MechanicalObject position="@[-1].position"/>', '<SphereCollisionModel name="spheres" listRadius="@two.listRadius"/>',
                           "</Node>", '<Node name="b"><MechanicalObject position="1 2 5  4 5 7.5"/><SphereCollisionModel name="others" radius="0.5"/></Node>')
        _, found, said = self.contacts(scene)
        # (1,2,4) r 0.5 and (1,2,5) r 0.5 touch; (4,5,7) r 0.25 and (4,5,7.5) r 0.5 overlap by 0.25.
        self.assertEqual([(c["first"]["index"], c["second"]["index"], c["value"]) for c in found], [(0, 0, 0), (1, 1, -0.25)])
        self.assertEqual(said, "")
        grid = '<Node name="a"><RegularGridTopology n="2 1 3" min="0 4 0" max="1 6 4"/><MechanicalObject/><SphereCollisionModel name="spheres"/></Node>'
        self.assertEqual(self.centers(grid), [[x, 5, z] for z in (0, 2, 4) for x in (0, 1)])

    def test_the_distances_are_those_of_the_first_intersection_component(self):
        for line, distances in (("<DiscreteIntersection/>", (0, 0)), ("", (0, 0)), ("<MinProximityIntersection/>", (1, 0.5)),
                                ('<ExactDiscreteIntersection alarmDistance="0.5"/>', (0.5, 0)),
                                ('<RecordingIntersection/><MinProximityIntersection alarmDistance="2" contactDistance="1"/>', (2, 1))):
            header, _, said = self.contacts(self.scene(line, self.state('position="0 0 0"')))
            self.assertEqual(((header["alarm"], header["contact"]), said), (distances, ""), line)
        header, _, said = self.contacts(self.scene('<LocalMinDistance alarmDistance="3" contactDistance="2"/>', self.state("")))
        self.assertEqual((header["alarm"], header["contact"]), (3, 2))
        self.assertIn("s.scn:2: LocalMinDistance gives its distances alone", said)

    def pairs(self, *lines):
        return [line.split()[:2] for line in self.detect(self.scene(*lines)).stdout.splitlines() if line.startswith("/")]

    def test_models_meet_as_sofa_lets_them(self):
        node = '<Node name="{0}"><MechanicalObject/><SphereCollisionModel name="s" {1}/></Node>'
        two = lambda first, second: self.pairs(node.format("a", first), node.format("b", second))
        meet, apart = [["/a/s", "/b/s"]], []
        self.assertEqual(two("", ""), meet)
        self.assertEqual(two('group="1 2"', 'group="2 3"'), apart)
        self.assertEqual(two('group="1 2"', 'group="3"'), meet)
        self.assertEqual(two('group="1"', ""), meet)
        self.assertEqual(two('simulated="0"', 'simulated="false"'), apart)
        self.assertEqual(two('simulated="0"', ""), meet)
        self.assertEqual(two('selfCollision="1"', ""), [["/a/s", "/a/s"], ["/a/s", "/b/s"]])
        beside = '<Node name="a"><MechanicalObject/><SphereCollisionModel name="s" {}/><SphereCollisionModel name="t" {}/></Node>'
        self.assertEqual(self.pairs(beside.format("", "")), apart)
        self.assertIn(["/a/s", "/a/t"], self.pairs(beside.format('selfCollision="1"', 'selfCollision="1"')))

    def test_models_meet_only_within_a_pipeline(self):
        node = '<Node name="{0}">{1}<MechanicalObject/><SphereCollisionModel name="s"/></Node>'
        plain = [node.format(name, "") for name in "abc"]
        everyone = [["/a/s", "/b/s"], ["/a/s", "/c/s"], ["/b/s", "/c/s"]]
        self.assertEqual(self.pairs(*plain), everyone)
        self.assertEqual(self.pairs("<CollisionPipeline/>", *plain), everyone)
        # One for each of two nodes, and none for the third.
        self.assertEqual(self.pairs(node.format("a", "<CollisionPipeline/>"), node.format("b", "<DefaultPipeline/>"), plain[2]), [])
        two = self.detect(self.scene(node.format("a", "<CollisionPipeline/>"), node.format("b", "<CollisionPipeline/>"))).stdout
        self.assertIn("2 models, and no pair of them meets in SOFA", two)
        # One around two nodes, whose models are then /x/a/s and /x/b/s.
        self.assertEqual(self.pairs('<Node name="x"><CollisionPipeline/>', plain[0], plain[1], "</Node>", plain[2]), [["/x/a/s", "/x/b/s"]])
        # One that names its models.
        named = '<SubCollisionPipeline collisionModels="@{} @{}"/>'
        self.assertEqual(self.pairs(*plain, named.format("/a/s", "b/s"), named.format("b/s", "c/s")), [["/a/s", "/b/s"], ["/b/s", "/c/s"]])
        # The roots of two files are one.
        other = self.scene("<CollisionPipeline/>", plain[1], name="o.scn")
        self.assertIn("/a/s  ", self.detect(self.scene("<CollisionPipeline/>", plain[0]), other).stdout)

    def test_a_model_without_a_name_is_named_as_sofa_names_it(self):
        two = '<Node name="a"><MechanicalObject/><SphereCollisionModel selfCollision="1"/><SphereCollisionModel selfCollision="1"/></Node>'
        self.assertEqual(self.pairs(two)[1], ["/a/SphereCollisionModel1", "/a/SphereCollisionModel2"])

    def test_what_is_not_read_is_named_by_file_and_line(self):
        _, _, said = self.contacts(self.scene(self.state(""), '<TriangleCollisionModel name="t"/>', "<CubeCollisionModel/>",
                                              '<include href="more.xml"/>', '<SphereCollisionModel name="x" active="0"/>',
                                              '<Node name="c"><MeshTopology filename="x.obj"/><MechanicalObject/>', '<SphereCollisionModel name="y"/></Node>'))
        for line, words in enumerate(("TriangleCollisionModel 't' is not read: only spheres", "CubeCollisionModel is not read: SOFA makes its boxes around other models",
                                      "include is not read: give 'more.xml'", "SphereCollisionModel 'x' is not read: active"), start=3):
            self.assertIn(f"s.scn:{line}: {words}", said)
        self.assertIn("s.scn:8: SphereCollisionModel 'y' is not read: its positions are those of a MeshTopology", said)
        self.assertEqual(len(said.splitlines()), 5)
        self.refused("no model is read", "s.scn:2: TriangleCollisionModel", lines=["<TriangleCollisionModel/>"])
        self.refused("no model is read", "RigidMapping has the attribute initialPoints",
                     lines=['<MechanicalObject template="Rigid3"/>', '<Node><MechanicalObject/><SphereCollisionModel/><RigidMapping initialPoints="1 0 0"/></Node>'])

    def test_what_is_wrong_is_refused_with_file_line_field_and_value(self):
        self.refused("s.scn:2: position: 4 numbers are no rows of 3", lines=[self.state('position="0 0 0 1"')])
        self.refused("s.scn:3: position: expected finite numbers, got '0-1'", lines=["", self.state('position="0 0-1 0"')])
        self.refused("s.scn:2: radius: expected a number, got '1 2'", lines=[self.state("", 'radius="1 2"')])
        self.refused("s.scn:2: simulated: expected 0, 1, true or false, got 'no'", lines=[self.state("", 'simulated="no"')])
        self.refused("s.scn:2: alarmDistance: must not be negative, got -1", lines=['<MinProximityIntersection alarmDistance="-1"/>'])
        self.refused("s.scn:2: ", "radii", "-1", lines=[self.state("", 'radius="-1"')])
        self.refused("s.scn:3: name: the model at", "s.scn:2 has the name /a/spheres too", lines=[self.state(""), self.state("")])
        self.refused("s.scn:3: not well-formed XML", lines=["<Node>"])
        (self.folder / "two.sph").write_text("sph 1.0\nsphe 1 2\n")
        self.refused("two.sph:2: sphe: expected an index and 4 numbers, got 'sphe 1 2'",
                     lines=['<SphereLoader filename="two.sph"/>', '<MechanicalObject position="@[-1].position"/>', "<SphereCollisionModel/>"])
        done = self.detect(self.folder / "gone.scn")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("gone.scn: cannot be read", done.stderr)

    def test_scenes_of_both_kinds_are_one(self):
        other = self.folder / "o.jsonl"
        other.write_text('{"format":"contact-oracle/scene","version":1,"alarm":1,"contact":0.5}\n'
                         '{"model":"SphereCollisionModel","name":"o","centers":[[0,0,2]],"radii":[1]}\n')
        _, found, _ = self.contacts(self.scene("<MinProximityIntersection/>", self.state("")), other)
        self.assertEqual([(c["first"]["model"], c["second"]["model"], c["value"]) for c in found], [("/a/spheres", "o", -0.5)])
        done = self.detect(self.scene(self.state("")), other)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("alarm: another scene says 0", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
