#!/usr/bin/env python3
"""The C interface in the shared library, as other languages call it:   contact_test.py LIBRARY GOLDEN HEADER VERSION_HEADER [TEST..]

Every committed question in binary64 is asked, and the bits are compared with what the oracle expects."""
import array
import ctypes
import itertools
import json
import re
import struct
import sys
import threading
import unittest
from pathlib import Path

LIBRARY, GOLDEN, HEADER = ctypes.CDLL(sys.argv[1]), Path(sys.argv[2]), Path(sys.argv[3])
# Pairs that the generator makes questions of, and none is committed.
WITHOUT_FILES = ["capsule_cube", "capsule_hull", "cube_hull", "cube_obb", "cube_plane", "cube_triangle", "obb_hull", "obb_triangle", "sphere_hull", "triangle_hull",
                 "triangle_plane"]
SHORT = ["capsule_obb", "capsule_triangle", "hull_hull", "hull_plane", "obb_obb", "obb_plane", "sphere_obb", "triangle_triangle"]
PAIRS = sorted(folder.name for folder in GOLDEN.iterdir() if (folder / "generic.jsonl").exists() or (folder / "invalid.jsonl").exists())
FIELDS = (("normal", 3), ("point1", 3), ("point2", 3), ("value", 1))
OUTSIDE_DOMAIN = 2
LIBRARY.contact_last_error.restype = LIBRARY.contact_status_text.restype = LIBRARY.contact_version.restype = ctypes.c_char_p


class Contacts(ctypes.Structure):
    _fields_ = [("state", ctypes.c_void_p)] + [(name, ctypes.c_void_p) for name, _ in FIELDS]


class Hull(ctypes.Structure):
    """contact_hull; a count of its own may be wrong."""
    _fields_ = [("vertices", ctypes.c_void_p), ("count", ctypes.c_size_t), ("radius", ctypes.c_double)]

    def __init__(self, vertices, radius, count=None):
        self.room = array.array("d", numbers(vertices))
        super().__init__(self.room.buffer_info()[0] if vertices else None, len(vertices) if count is None else count, float(radius))


def numbers(shape):
    """The doubles of a shape in JSON, in order: of a list, of a number, or of a word such as "NaN"."""
    if isinstance(shape, dict):
        shape = list(shape.values())
    return [x for one in shape for x in numbers(one)] if isinstance(shape, list) else [float(shape)]


def address(room):
    return ctypes.c_void_p(room.buffer_info()[0]) if isinstance(room, array.array) else room


def questions(pair, family="*"):
    """(file, question) of the committed files of a pair, but those in binary32."""
    for path in sorted((GOLDEN / pair).glob(f"{family}.jsonl")):
        if not path.name.endswith(".f32.jsonl"):
            yield from ((path, json.loads(line)) for line in path.read_text().splitlines()[1:])


def rows(asked, side):
    """The shapes of a side in C."""
    if asked[0][side].keys() >= {"vertices", "radius"}:
        hulls = [Hull(**question[side]) for question in asked]
        there = (Hull * len(hulls))(*hulls)
        there.kept = hulls  # with the vertices, which C knows by their address
        return there
    return array.array("d", [x for question in asked for x in numbers(question[side])])


def test(pair, asked, alarm):
    """(status, hits, hit of each)"""
    hit, hits = array.array("B", [7] * len(asked)), ctypes.c_size_t(77)
    a, b = rows(asked, "a"), rows(asked, "b")
    status = getattr(LIBRARY, f"contact_test_{pair}")(ctypes.c_size_t(len(asked)), address(a), address(b), ctypes.c_double(alarm), address(hit),
                                                      ctypes.byref(hits))
    return status, hits.value, list(hit)


def compute(pair, asked, alarm, contact, points=0, wanted=("state", "normal", "point1", "point2", "value")):
    """(status, hits, state of each, {field: bytes of each})"""
    room = {"state": array.array("B", [7] * len(asked))} | {name: array.array("d", [7.0] * width * len(asked)) for name, width in FIELDS}
    out = Contacts(**{name: one.buffer_info()[0] for name, one in room.items() if name in wanted})
    a, b, hits = rows(asked, "a"), rows(asked, "b"), ctypes.c_size_t(77)
    status = getattr(LIBRARY, f"contact_compute_{pair}")(ctypes.c_size_t(len(asked)), address(a), address(b), ctypes.c_double(alarm),
                                                         ctypes.c_double(contact), ctypes.c_int32(points), ctypes.byref(out), ctypes.byref(hits))
    split = {name: [room[name][i * width:(i + 1) * width].tobytes() for i in range(len(asked))] for name, width in FIELDS}
    return status, hits.value, list(room["state"]), split


def expected(expect):
    """(state, {field: bytes})"""
    state = (2 if expect.get("degenerate") else 1) if expect.get("unique", True) else (4 if expect["degenerate"] else 3)
    if not expect["hit"]:
        return 0, {name: bytes(8 * width) for name, width in FIELDS}
    return state, {name: struct.pack(f"{width}d", *numbers(expect[name])) for name, width in FIELDS}


def has_numbers(pair):
    return pair != "cube_cube"


class Golden(unittest.TestCase):
    def test_every_pair_of_the_golden_files_is_in_the_header_and_no_other(self):
        self.assertGreater(len(PAIRS), 12)
        self.assertEqual(sorted(re.findall(r"^CONTACT_C_(?:TEST|PAIR)\((\w+), contact_", HEADER.read_text(), re.MULTILINE)), sorted(PAIRS + WITHOUT_FILES))

    def test_every_answer_has_the_bits_that_the_oracle_expects(self):
        asked = hits = arrays = 0
        for pair in PAIRS:
            # Those that stand together and have the same distances are one call: most are alone, some are many.
            for (path, alarm, contact), group in itertools.groupby(questions(pair), lambda one: (one[0], one[1]["alarm"], one[1]["contact"])):
                group = [question for _, question in group]
                if "rejected" in group[0]["expect"]:
                    continue
                right = [expected(one["expect"]) if has_numbers(pair) else (int(one["expect"]["hit"]), {}) for one in group]
                hit = [int(one["expect"]["hit"]) for one in group]
                self.assertEqual(test(pair, group, alarm), (0, sum(hit), hit), (path.name, group[0]["id"]))
                if has_numbers(pair):
                    status, count, states, fields = compute(pair, group, alarm, contact)
                    self.assertEqual((status, count), (0, sum(hit)), (path.name, group[0]["id"]))
                    for i, (state, numbers_of) in enumerate(right):
                        self.assertEqual((states[i], {name: fields[name][i] for name in fields}), (state, numbers_of), (path.name, group[i]["id"]))
                asked += len(group)
                hits += sum(hit)
                arrays += len(group) > 1
        self.assertGreater(asked, 29000)
        self.assertGreater(hits, 10000)
        self.assertGreater(arrays, 1000)

    def test_many_pairs_in_one_call_have_the_bits_of_one_at_a_time(self):
        for pair in PAIRS:
            some = [question for _, question in questions(pair) if "rejected" not in question["expect"]][::2]
            self.assertGreater(len(some), 100 if pair.startswith("cast_") or pair in SHORT else 600)  # files of these are short
            whole = test(pair, some, 0.25)
            self.assertEqual(whole[2], [test(pair, [one], 0.25)[2][0] for one in some])
            if has_numbers(pair):
                _, hits, states, fields = compute(pair, some, 0.25, 0.125)
                self.assertEqual(hits, sum(whole[2]))
                for i, one in enumerate(some):
                    _, _, state, alone = compute(pair, [one], 0.25, 0.125)
                    self.assertEqual((states[i], [fields[name][i] for name in fields]), (state[0], [alone[name][0] for name in alone]), (pair, i))


class Errors(unittest.TestCase):
    def test_what_is_outside_the_domain_is_refused_by_row_and_field_and_nothing_is_written(self):
        refused = 0
        for pair in PAIRS:
            good = next(question for _, question in questions(pair) if "rejected" not in question["expect"])
            for _, bad in questions(pair, "invalid"):
                field = bad["expect"]["rejected"]
                named = field if field in ("alarm", "contact") else field.replace(".", "[1].", 1)
                answers = [] if field == "contact" else [test(pair, [good, bad], float(bad["alarm"]))]
                answers += [compute(pair, [good, bad], float(bad["alarm"]), float(bad["contact"]))] if has_numbers(pair) else []
                for status, hits, states, *fields in answers:
                    refused += 1
                    self.assertEqual((status, hits, states), (OUTSIDE_DOMAIN, 77, [7, 7]), bad)
                    for one in fields:
                        self.assertEqual({x for name in one for row in one[name] for x in struct.unpack(f"{len(row) // 8}d", row)}, {7.0})
                if answers:
                    self.assertRegex(LIBRARY.contact_last_error().decode(), rf"^{re.escape(named)} = \S+: must ")
        self.assertGreater(refused, 2000)

    def test_bad_arguments_have_a_status_and_words_of_their_own(self):
        nothing, one, two = None, ctypes.c_size_t(1), array.array("d", [0.0] * 4)
        zero = ctypes.c_double(0)
        ask = LIBRARY.contact_compute_sphere_sphere
        out = Contacts()
        for arguments, status, words in (((one, nothing, address(two), zero, zero, 0, ctypes.byref(out), nothing), 1, "a is NULL"),
                                         ((one, address(two), nothing, zero, zero, 0, ctypes.byref(out), nothing), 1, "b is NULL"),
                                         ((one, address(two), address(two), zero, zero, 0, nothing, nothing), 1, "out is NULL"),
                                         ((one, address(two), address(two), zero, zero, 3, ctypes.byref(out), nothing), 3,
                                          "points = 3: must be 0, 1 or 2"),
                                         ((one, address(two), address(two), zero, zero, -1, ctypes.byref(out), nothing), 3,
                                          "points = -1: must be 0, 1 or 2")):
            self.assertEqual(ask(*arguments), status)
            self.assertEqual(LIBRARY.contact_last_error().decode(), words)
        self.assertEqual(LIBRARY.contact_test_sphere_sphere(one, address(two), address(two), zero, nothing, nothing), 1)
        self.assertEqual(LIBRARY.contact_last_error(), b"hit is NULL")
        self.assertEqual(ask(ctypes.c_size_t(0), nothing, nothing, zero, zero, 0, nothing, nothing), 0)
        self.assertEqual(ask(one, address(two), address(two), zero, zero, 0, ctypes.byref(out), nothing), 0)
        texts = [LIBRARY.contact_status_text(status) for status in range(-1, 7)]
        self.assertEqual(len(set(texts)), 7)
        self.assertEqual(texts[0], texts[-1])

    def test_the_last_error_is_the_threads_own(self):
        sphere, heard = [{"a": {"center": [0, 0, 0], "radius": 1}, "b": {"center": [0, 0, 0], "radius": -1}}], []
        self.assertEqual(test("sphere_sphere", sphere, 0)[0], OUTSIDE_DOMAIN)
        other = threading.Thread(target=lambda: heard.append(LIBRARY.contact_last_error()))
        other.start()
        other.join()
        self.assertEqual((heard, LIBRARY.contact_last_error()), ([b""], b"b[0].radius = -1: must not be negative"))


class Hulls(unittest.TestCase):
    SQUARE = [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]]
    ABOVE = {"vertices": [[1, 1, 3], [1, 1, 2], [1, 3, 5]], "radius": 0.5}

    def asked(self, *hulls):
        return [{"a": {"center": [1, 1, 5], "radius": 1}, "b": hull} for hull in hulls]

    def test_each_has_as_many_vertices_as_it_says(self):
        hulls = [{"vertices": self.SQUARE[:count], "radius": 0.25} for count in (1, 2, 4)] + [{"vertices": self.SQUARE * 16, "radius": 1}]
        status, hits, states, fields = compute("sphere_hull", self.asked(*hulls), 5, 0.5)
        value = [struct.unpack("d", one)[0] for one in fields["value"]]
        self.assertEqual((status, hits, states), (0, 4, [1, 1, 1, 1]))
        for found, right in zip(value, (27 ** 0.5 - 1.75, 26 ** 0.5 - 1.75, 3.25, 2.5), strict=True):
            self.assertAlmostEqual(found, right, 14)
        self.assertEqual(test("sphere_hull", self.asked(*hulls), 3.75), (0, 2, [0, 0, 1, 1]))

    def test_they_stand_first_and_second_and_over_planes(self):
        square = {"vertices": self.SQUARE, "radius": 0}
        _, hits, states, fields = compute("hull_hull", [{"a": square, "b": self.ABOVE}, {"a": self.ABOVE, "b": square}], 2, 0)
        self.assertEqual((hits, states), (2, [1, 1]))
        self.assertEqual([struct.unpack("3d", one) for one in fields["normal"]], [(0, 0, 1), (0, 0, -1)])
        self.assertEqual([struct.unpack("3d", one) for one in fields["point2"]], [(1, 1, 1.5), (1, 1, 0)])
        _, hits, states, fields = compute("hull_plane", [{"a": self.ABOVE, "b": {"normal": [0, 0, 2], "offset": 1}}], 2, 0)
        self.assertEqual((hits, states, struct.unpack("d", fields["value"][0])), (1, [1], (1,)))

    def test_what_is_wrong_is_named_by_row_and_vertex(self):
        bad = {**self.ABOVE, "vertices": [[1, 2, 3]] * 3 + [[1, float("nan"), 3]]}
        for hull, status, words in (({**self.ABOVE, "radius": -1}, 2, "b[1].radius = -1: must not be negative"),
                                    (bad, 2, "b[1].vertices[3][1] = nan: must be finite"),
                                    ({"vertices": [], "radius": 0}, 2, "b[1].vertices = 0: must be from 1 to 64 points"),
                                    ({**self.ABOVE, "count": 65}, 2, "b[1].vertices = 65: must be from 1 to 64 points"),
                                    ({**self.ABOVE, "count": 1 << 60}, 2, "b[1].vertices = 1152921504606846976: must be from 1 to 64 points"),
                                    ({"vertices": [], "radius": 0, "count": 3}, 1, "b[1].vertices is NULL")):
            for answer in (test, lambda *asked: compute(*asked, 0)):
                self.assertEqual(answer("sphere_hull", self.asked(self.ABOVE, hull), 1)[:3], (status, 77, [7, 7]), words)
                self.assertEqual(LIBRARY.contact_last_error().decode(), words)


class Arguments(unittest.TestCase):
    ONE = [{"a": {"center": [0, 0, 0], "radius": 1}, "b": {"center": [3, 0, 0], "radius": 1}}]

    def point(self, pair, points):
        fields = compute(pair, self.ONE, 1, 0, points)[3]
        return [struct.unpack("3d", fields[name][0])[0] for name in ("point1", "point2")]

    def test_a_convention_puts_the_points_where_it_says(self):
        self.assertEqual(self.point("sphere_sphere", 0), [1, 2])
        self.assertEqual(self.point("sphere_sphere", 1), [0, 3])
        self.assertEqual(self.point("sphere_rigid_sphere", 1), [0, 2])
        self.assertEqual(self.point("rigid_sphere_rigid_sphere", 1), [1, 2])
        self.assertEqual(self.point("sphere_sphere", 2), [-1, 4])

    def test_columns_that_nobody_wants_are_not_written(self):
        for name in ("state", "normal", "point1", "point2", "value"):
            status, hits, state, fields = compute("sphere_sphere", self.ONE, 1, 0, wanted=(name,))
            self.assertEqual((status, hits), (0, 1))
            written = {one for one in fields if fields[one][0] != struct.pack("d", 7) * (len(fields[one][0]) // 8)} | ({"state"} if state != [7] else set())
            self.assertEqual(written, {name})

    def test_the_version_is_that_of_the_header(self):
        said = re.search(r'CONTACT_VERSION_STRING "(.*)"', Path(sys.argv[4]).read_text())
        self.assertEqual(LIBRARY.contact_version().decode(), said[1])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[5:]])
