#!/usr/bin/env python3
"""detect reads the collision part of SOFA's scenes. Every expected number is worked out by hand, in its comment:

    sofa_scene_test.py contact-oracle"""
import json
import math
import os
import resource
import sys
import unittest

import cli_test
from cli_test import ROOT, run


class SofaScene(cli_test.Case):
    def scene(self, *lines, name="s.scn"):
        path = self.folder / name
        path.write_text("\n".join(['<Node name="root">', *lines, "</Node>"]) + "\n")
        return path

    def detect(self, *args):
        return run("detect", *args)

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

    def test_what_is_not_read_is_told_a_hundred_times_and_then_counted(self):
        _, _, said = self.contacts(self.scene(self.state(""), *["<TriangleCollisionModel/>"] * 100))
        self.assertEqual((len(said.splitlines()), said.splitlines()[-1].split(":")[1]), (100, "102"))
        other = self.scene(self.state("").replace('"a"', '"b"'), *["<LineCollisionModel/>"] * 50, name="o.scn")
        done = self.detect(self.scene(self.state(""), *["<TriangleCollisionModel/>"] * 90), other)
        self.assertEqual((done.returncode, len(done.stderr.splitlines())), (0, 101))
        self.assertIn("o.scn:12: LineCollisionModel", done.stderr.splitlines()[99])
        self.assertEqual(done.stderr.splitlines()[100], "and 40 more that are not read as they stand")

    def test_a_number_that_is_no_integer_of_sofas_is_refused(self):
        for text in ("3000000000", "-2147483649", "1e300", "1.5", "1 2 4000000000"):
            self.refused("s.scn:3: group: expected a whole number from -2147483648 to 2147483647, got ",
                         lines=[self.state("", 'group="2147483647 -2147483648 1e3"'), self.state("", f'group="{text}"').replace('"a"', '"b"')])
        for text in ("3000000000 1 1", "1 0 1", "1 1.5 1", "1e300 1 1"):
            self.refused("s.scn:2: n: expected a whole number from 1 to 10000000, got ",
                         lines=[f'<Node><RegularGridTopology n="{text}"/><MechanicalObject/><SphereCollisionModel/></Node>'])
        self.refused("s.scn:2: n: expected at most 10000000 points, got 100000000",
                     lines=['<Node><RegularGridTopology n="10000 10000 1"/><MechanicalObject/><SphereCollisionModel/></Node>'])
        far = '<Node><MechanicalObject position="@[-{}].position"/><SphereCollisionModel/></Node>'
        for back in ("99999999999999999999", "4294967297", "x"):
            self.refused("no model is read", "the link leads to no component of this file", lines=[far.format(back)])

    def test_what_stands_too_deep_is_refused(self):
        # The root is one, the state in the last node one more.
        nest = lambda nodes: ["<Node>" * nodes + "<MechanicalObject/><SphereCollisionModel/>" + "</Node>" * nodes]
        self.assertEqual(self.detect(self.scene(*nest(99))).returncode, 0)
        for nodes in (100, 7000, 200_000):
            self.refused("s.scn:2: elements stand more than 100 deep in each other", lines=nest(nodes))
        self.refused("more than 100 deep", lines=["<x>" * 7000 + "</x>" * 7000])

    def test_a_mesh_that_is_a_pipe_or_a_device_is_refused(self):
        os.mkfifo(self.folder / "pipe")
        for name in ("pipe", "/dev/zero", "."):
            self.refused(f"s.scn:2: filename: is no regular file, got '{name}'",
                         lines=[f'<Node><SphereLoader filename="{name}"/><MechanicalObject position="@[-1].position"/><SphereCollisionModel/></Node>'])

    def test_a_long_value_is_cut_where_it_is_told(self):
        done = self.detect(self.scene(self.state(f'position="{"x" * 900_000}"')))
        self.assertEqual(done.returncode, 2)
        self.assertLess(len(done.stderr), 1000)

    def test_many_models_have_the_contacts_of_their_definition(self):
        # Spheres on a grid of eighths, so that squares of distances are exact in Python too; some of several in a node, some in
        # groups, some that are not simulated. More models than are listed pair by pair.
        models, lines, turn = [], [], 7
        def chance(n):
            nonlocal turn
            turn = turn * 1103515245 % 2**31 + 12345
            return (turn >> 16) % n
        for node in range(60):
            center = [chance(40) / 8 for _ in range(3)]
            group, simulated, own = chance(4), chance(5) != 0, chance(3) == 0
            lines.append(f'<Node name="n{node}"><MechanicalObject position="{center[0]} {center[1]} {center[2]}"/>')
            for k in range(1 + chance(3)):
                radius = (1 + chance(6)) / 8
                models.append((f"/n{node}/s{k}", node, center, radius, group, simulated, own))
                lines.append(f'<SphereCollisionModel name="s{k}" radius="{radius}" simulated="{int(simulated)}" selfCollision="{int(own)}"'
                             + (f' group="{group}"' if group else "") + "/>")
            lines.append("</Node>")
        self.assertGreater(len(models), 64)
        expected = []
        for i, (name, node, center, radius, group, simulated, own) in enumerate(models):
            for other in models[i + 1:]:
                apart = sum((x - y) ** 2 for x, y in zip(center, other[2])) > (radius + other[3] + 0.25) ** 2
                meet = (simulated or other[5]) and ((own and other[6]) if node == other[1] else not (group and group == other[4]))
                if meet and not apart:
                    expected.append((name, other[0]))
        self.assertGreater(len(expected), 50)
        scene = self.scene('<MinProximityIntersection alarmDistance="0.25" contactDistance="0"/>', *lines)
        _, found, _ = self.contacts(scene)
        self.assertEqual([(c["first"]["model"], c["second"]["model"]) for c in found], expected)
        table = self.detect(scene).stdout.splitlines()
        self.assertEqual([tuple(row.split()[:2]) for row in table[3:-1]], expected)
        self.assertEqual(table[-1], f"{len(models)} models; no other two of them meet in SOFA and have a contact")

    def test_a_large_scene_takes_little_time_and_memory(self):
        # Each of these took a minute of processor time or more, or gigabytes, where something was done for each pair of elements.
        def limits():
            resource.setrlimit(resource.RLIMIT_CPU, (30, 30))
            resource.setrlimit(resource.RLIMIT_DATA, (1 << 30, 1 << 30))
        one = '<SphereCollisionModel radius="0.25" {}/>'
        apart = '<Node><MechanicalObject position="{} 0 0"/><SphereCollisionModel/></Node>'
        for name, lines, models in (("in one node", ["<MechanicalObject/>", *[one.format("")] * 30_000], 30_000),
                                    ("linked", ["<MechanicalObject/>", *[one.format('listRadius="@gone.x"')] * 30_000, self.state("")], 1),
                                    ("not read", [self.state(""), *["<TriangleCollisionModel/>"] * 60_000], 1),
                                    ("apart", [apart.format(10 * i) for i in range(20_000)], 20_000)):
            done = run("detect", self.scene(*lines), "--jobs", 2, preexec_fn=limits)
            self.assertEqual(done.returncode, 0, (name, done.stderr[-300:]))
            self.assertIn(f"{models} models, and no pair" if models > 1 else "one model", done.stdout, name)

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
        self.assertIn("gone.scn: cannot read: no such file", done.stderr)

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
