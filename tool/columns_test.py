#!/usr/bin/env python3
"""Datasets as columns in HDF5 and .npz, shards and resuming, as a user meets them: python3 tool/columns_test.py
PATH_TO_TOOL [unittest arguments]. They are read and damaged by h5py and NumPy, which know nothing of this program."""
import copy
import hashlib
import json
import math
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import time
import unittest
import warnings
import zipfile

import h5py
import numpy

from cli_test import GOLDEN, ROOT, SPHERES, TOOL, Case, line

# The digest of columns as the page has it, in Python.
PAGE = {}
exec((ROOT / "docs" / "formats.md").read_text().split("<!-- columns-digest:begin -->\n```python")[1].split("```")[0], PAGE)

NOISE = random.Random(1).randbytes(5000)
SPHERE_FAMILY = ("--pair", "sphere_sphere", "--family", "touching", "--seed", 7)
CUBE_FAMILY = ("--pair", "cube_cube", "--family", "alarm_edge", "--seed", 7, "--scalar", "binary32")


def number(value):
    return float(value) if isinstance(value, str) else value


def same(x, y):
    return x == y or math.isnan(x) and math.isnan(y)


def read(path):
    """Header, columns and the names of the flags of either form."""
    if path.suffix == ".npz":
        with numpy.load(path) as file:
            columns = {name: file[name] for name in file.files}
        header = json.loads(columns.pop("header").item().decode())
        return header, columns, [name.decode() for name in columns.pop("flags.names")]
    with h5py.File(path, "r") as file:
        columns = {}
        file.visititems(lambda name, item: columns.update({name: item[:]}) if isinstance(item, h5py.Dataset) else None)
        header = {key: value.decode() if isinstance(value, bytes) else value for key, value in file.attrs.items()}
        return header, columns, [name.decode() for name in file["flags"].attrs["names"]]


def tell(path, *without, **keys):
    """Changes the header of a file of either form: it has no longer some keys, and others have these values."""
    if path.suffix == ".npz":
        with numpy.load(path) as file:
            columns = {name: file[name] for name in file.files}
        header = {key: value for key, value in json.loads(columns["header"].item()).items() if key not in without}
        numpy.savez(path, **{**columns, "header": numpy.bytes_(json.dumps({**header, **keys}).encode())})
    else:
        with h5py.File(path, "r+") as file:
            for key in without:
                file.attrs.pop(key, None)
            for key, value in keys.items():
                file.attrs[key] = numpy.uint64(value) if isinstance(value, int) else numpy.bytes_(value.encode())


def seal(path):
    """Gives a file of either form the digest that its columns have, as whoever changed it might."""
    tell(path, columns_sha256=PAGE["of_npz" if path.suffix == ".npz" else "of_hdf5"](path))


class Columns(Case):
    def generate(self, name, *more, count=40, family=SPHERE_FAMILY):
        path = self.folder / name
        self.holds("generate", *family, "--count", count, "-o", path, *more)
        return path

    def convert(self, *inputs, to):
        self.holds("convert", *inputs, "-o", self.folder / to)
        return self.folder / to


class Form(Columns):
    def test_another_reader_finds_in_every_column_what_the_lines_say(self):
        for source in ("sphere_sphere/generic.jsonl", "sphere_sphere/extreme_scale.f32.jsonl",
                       "cube_cube/touching.jsonl", "cube_cube/invalid.f32.jsonl", "sphere_sphere/invalid.jsonl"):
            with self.subTest(source):
                lines = (GOLDEN / source).read_bytes()
                header, *cases = map(json.loads, lines.splitlines())
                for form in ("h5", "npz"):
                    self.check(self.convert(GOLDEN / source, to=f"x.{form}"), lines, header, copy.deepcopy(cases))

    def check(self, path, lines, header, cases):
        attributes, columns, names = read(path)
        self.assertEqual(attributes.pop("columns_sha256"), PAGE[f"of_{'npz' if path.suffix == '.npz' else 'hdf5'}"](path))
        self.assertEqual(attributes.pop("sha256"), hashlib.sha256(lines).hexdigest())
        self.assertEqual(attributes, header)
        compared = set()

        def compare(path, row, value):
            compared.add(path)
            there = columns[path][row]
            if isinstance(value, list) and isinstance(value[0], str) and "x" in value[0]:
                self.assertEqual([one.decode() for one in there], value, path)
            elif isinstance(value, list):
                self.assertTrue(all(map(same, there, map(number, value))), (path, row, there, value))
            elif isinstance(there, bytes):
                self.assertEqual(there.decode(), value, path)
            else:
                self.assertTrue(same(there, number(value)), (path, row, there, value))

        nothing = {"degenerate": False, **{field: ["NaN"] * 3 for field in ("normal", "point1", "point2")}, "value": "NaN"}
        for row, case in enumerate(cases):
            flags = case.pop("flags")
            self.assertEqual([name for bit, name in enumerate(names) if columns["flags"][row] >> bit & 1], flags)
            if case["expect"] == {"hit": False} and "center" in case["a"]:
                case["expect"].update(nothing)
            for key, value in case.items():
                for inner, one in value.items() if isinstance(value, dict) else (("", value),):
                    compare(f"{key}/{inner}".rstrip("/"), row, one)
        self.assertEqual(compared | {"flags"}, set(columns))
        for name, column in columns.items():
            self.assertEqual(len(column), len(cases), name)

    def test_a_hull_has_the_vertices_before_those_of_nan(self):
        lines = self.generate("a.jsonl", family=("--pair", "hull_hull", "--family", "flat", "--seed", 7))
        _, *cases = map(json.loads, lines.read_text().splitlines())
        for form in ("h5", "npz"):
            path = self.convert(lines, to=f"a.{form}")
            attributes, columns, _ = read(path)
            self.assertEqual(attributes["columns_sha256"], PAGE["of_npz" if form == "npz" else "of_hdf5"](path))
            for shape in "ab":
                vertices = columns[f"{shape}/vertices"]
                self.assertEqual(vertices.shape, (len(cases), 64, 3))
                there = [row[~numpy.isnan(row).all(axis=1)].tolist() for row in vertices]
                self.assertEqual(there, [case[shape]["vertices"] for case in cases])
                self.assertGreater(len({len(one) for one in there}), 3)
            self.assertEqual(self.convert(path, to="b.jsonl").read_bytes(), lines.read_bytes())
            self.assertLess(path.stat().st_size, len(cases) * 1500)
        for change, *words in ((lambda v: v.__setitem__((3, slice(None)), math.nan), "row 3: /a/vertices: expected a point at least, got NaN alone"),
                               (lambda v: v.__setitem__((3, 0, 1), math.nan), "row 3: id: "),
                               (lambda v: v.__setitem__((3, 63), 0.0), "row 3: id: ")):
            with h5py.File(shutil.copy(self.folder / "a.h5", self.folder / "c.h5"), "r+") as file:
                vertices = file["a/vertices"][:]
                change(vertices)
                file["a/vertices"][:] = vertices
            self.refused(("lint", "--generated", self.folder / "c.h5"), *words)
            self.refused(("convert", self.folder / "c.h5", "-o", self.folder / "c.jsonl"), *words)

    def test_all_forms_hold_the_same_to_the_byte_and_the_content_tells_them_apart(self):
        # More than one chunk of rows, and fewer; texts of extreme numbers become wider than those before them.
        for family, form, count in ((SPHERE_FAMILY, "h5", 4100), (CUBE_FAMILY, "h5", 500), (SPHERE_FAMILY, "npz", 500), (CUBE_FAMILY, "npz", 4100),
                                    (("--pair", "sphere_sphere", "--family", "extreme_scale", "--seed", 7), "npz", 500)):
            lines = self.generate("a.jsonl", family=family, count=count)
            columns = self.generate(f"a.{form}", family=family, count=count)
            self.assertEqual(self.convert(lines, to=f"b.{form}").read_bytes(), columns.read_bytes())
            self.assertEqual(self.convert(columns, to="b.jsonl").read_bytes(), lines.read_bytes())
            self.assertLess(columns.stat().st_size, lines.stat().st_size / 2)
            shutil.copy(columns, self.folder / "misnamed.jsonl")
            self.holds("lint", "--generated", self.folder / "misnamed.jsonl")
            self.assertEqual(self.convert(self.folder / "misnamed.jsonl", to="c.jsonl").read_bytes(), lines.read_bytes())

    def test_what_others_store_in_another_way_is_read(self):
        for path in (self.generate("a.npz"), self.generate("a.h5")):
            with self.subTest(path.suffix):
                lines, header = self.convert(path, to="a.jsonl").read_bytes(), read(path)[0]
                if path.suffix == ".npz":
                    with numpy.load(path) as file:
                        columns = {name: file[name] for name in file.files}
                    columns["id"] = columns["id"].astype("U")
                    numpy.savez_compressed(path, **{**columns, "header": json.dumps(header)})
                else:
                    with h5py.File(path, "r+") as file:
                        for name in ("alarm", "id"):
                            data = file[name][:]
                            del file[name]
                            file[name] = data  # in one piece
                self.assertEqual(self.convert(path, to="b.jsonl").read_bytes(), lines)

    def test_commands_take_any_form(self):
        (self.folder / "columns").mkdir()
        for name in ("touching", "generic", "invalid"):
            self.convert(GOLDEN / "sphere_sphere" / f"{name}.jsonl", to=f"columns/{name}.h5")
        listed = [str(GOLDEN / "sphere_sphere" / f"{name}.jsonl") for name in ("generic", "invalid", "touching")]
        self.assertEqual(self.holds("lint", self.folder / "columns"), self.holds("lint", *listed).replace("1 files", "3 files"))
        for engine in ("plain-double", "production"):
            kept = ("total", "families", "verdict", "level", "fields", "failures")
            of_lines, of_columns = (self.certify_json(*where, "--engine", engine) for where in (listed, [self.folder / "columns"]))
            self.assertEqual({key: of_lines.get(key) for key in kept}, {key: of_columns.get(key) for key in kept})
        queries = self.file("q.jsonl", [SPHERES])
        self.holds("annotate", queries, "-o", self.folder / "q.h5")
        self.holds("annotate", queries, "-o", self.folder / "r.jsonl")
        self.assertEqual(self.convert(self.folder / "q.h5", to="s.jsonl").read_text(), (self.folder / "r.jsonl").read_text())

    def test_lines_that_are_not_canonical_are_not_converted(self):
        header, first, *rest = self.generate("a.jsonl", count=3).read_text().splitlines()
        path = self.file("b.jsonl", [header, first.replace(",", ", ", 1), *rest])
        for target in ("c.h5", "c.jsonl"):
            self.refused(("convert", path, "-o", self.folder / target), f"{path}:2: not in canonical form")
        path = self.file("b.jsonl", [header, line({**json.loads(first), "flags": ["Shiny"]}), *rest])
        self.refused(("convert", path, "-o", self.folder / "c.h5"), "row 0: /flags: undeclared flag Shiny")


class Damage(Columns):
    def setUp(self):
        super().setUp()
        self.good = self.generate("good.h5", family=("--pair", "sphere_sphere", "--family", "alarm_edge", "--seed", 7))
        self.path = self.folder / "d.h5"

    def damaged(self, change):
        shutil.copy(self.good, self.path)
        with h5py.File(self.path, "r+") as file:
            change(file)
        return self.path

    turn = 0

    def refused_in_turn(self, *words):
        """By one of the commands that read datasets: they share the reader, and each has its turn."""
        Damage.turn += 1
        self.refused(self.readers()[Damage.turn % 3], *words)

    def readers(self):
        return ("lint", "--generated", self.path), ("certify", self.path), ("convert", self.path, "-o", self.folder / "x.jsonl")

    def test_a_file_of_another_shape_is_refused_where_it_is_wrong(self):
        def replaced(path, **other):
            def change(file):
                data, attributes = file[path][:], dict(file[path].attrs)
                del file[path]
                file.create_dataset(path, **{"data": data, "chunks": True, **{k: v(data) if callable(v) else v for k, v in other.items()}})
                file[path].attrs.update(attributes)
            return change

        def attribute(key, value):
            return lambda file: file.attrs.__setitem__(key, value)

        def linked(file):
            del file["alarm"]
            file["alarm"] = h5py.ExternalLink(str(self.good), "contact")

        external = str(self.folder / "raw")
        table = {
            "column missing": (lambda file: file.__delitem__("exact/reach"), "/exact/reach: missing"),
            "group missing": (lambda file: file.__delitem__("b"), "/b: missing"),
            "unknown column": (lambda file: file.create_dataset("expect/colour", data=[1]), "/expect/colour: unknown"),
            "unknown group": (lambda file: file.create_group("c"), "/c: unknown"),
            "unknown attribute": (attribute("colour", numpy.uint64(7)), "colour: unknown"),
            "attribute of a column": (lambda file: file["alarm"].attrs.__setitem__("unit", b"m"), "/alarm: attribute unit: unknown"),
            "attribute missing": (lambda file: file.attrs.__delitem__("seed"), "seed: missing"),
            "digest missing": (lambda file: file.attrs.__delitem__("sha256"), "sha256: missing"),
            "digest a number": (attribute("sha256", numpy.uint64(7)), "sha256: expected a string"),
            "digest of columns a number": (attribute("columns_sha256", numpy.uint64(7)), "columns_sha256: expected a string"),
            "wrong version": (attribute("version", numpy.uint64(2)), "version: ", "2"),
            "wrong format": (attribute("format", numpy.bytes_(b"other")), "format: ", "other"),
            "wrong pair": (attribute("pair", numpy.bytes_(b"cone_cone")), "pair: ", "cone_cone"),
            "another pair": (attribute("pair", numpy.bytes_(b"cube_cube")), "/a/max: missing"),
            "wrong shard": (attribute("shard", numpy.array([2, 2], numpy.uint64)), "shard: ", "[2,2]"),
            "count a text": (attribute("count", numpy.bytes_(b"40")), "count: ", "40"),
            "count too small": (attribute("count", numpy.uint64(39)), "/id: ", "(39)", "(40)"),
            "text of no fixed length": (attribute("family", "touching"), "family: ", "fixed length"),
            "numbers too narrow": (replaced("alarm", dtype="f4"), "/alarm: expected 64-bit IEEE numbers"),
            "numbers for a text": (replaced("id", data=numpy.zeros(40)), "/id: expected texts of 24 bytes"),
            "text too wide": (replaced("id", dtype="S25"), "/id: expected texts of 24 bytes"),
            "column too short": (replaced("contact", data=lambda data: data[:-1]), "/contact: ", "(39)"),
            "two coordinates": (replaced("a/center", data=lambda data: data[:, :2]), "/a/center: ", "(40, 3)", "(40, 2)"),
            "values elsewhere": (replaced("alarm", chunks=None, external=[(external, 0, 320)]), "/alarm: expected chunks"),
            "a link to another file": (linked, "/alarm: missing"),
            "flags without names": (lambda file: file["flags"].attrs.__delitem__("names"), "/flags: ", "names"),
        }
        for name, (change, *words) in table.items():
            with self.subTest(name):
                self.damaged(change)
                self.refused_in_turn(f"{self.path}: ", *words)

    def test_a_value_that_is_wrong_is_refused_with_its_row(self):
        with h5py.File(self.good, "r") as file:
            hits = file["expect/hit"][:]
        hit, miss = int(numpy.flatnonzero(hits)[3]), int(numpy.flatnonzero(hits == 0)[3])

        def value(path, row, new, axis=None):
            def change(file):
                file[path][(row,) if axis is None else (row, axis)] = new
            return change
        for name, (change, row, *words) in {
                "id": (value("id", 17, b"0" * 24), 17, "id: ", "0" * 24),
                "other question": (value("alarm", 17, 123.5), 17, "id: "),
                "no truth value": (value("expect/hit", hit, 2), hit, "/expect/hit: expected 0 or 1, got 2"),
                "bit without a name": (value("flags", 5, 1 << 31), 5, "/flags: ", "0x80000000"),
                "contact of a miss": (value("expect/value", miss, 0.5), miss, "/expect/value: a miss has no contact"),
                "normal of a miss": (value("expect/normal", miss, 0.5, 1), miss, "/expect/normal: "),
                "text after its end": (value("exact/reach", 9, b"0x1p0\0x"), 9, "/exact/reach: "),
                "no dyadic text": (value("exact/reach", 9, b'0x1p0"'), 9, "/exact/reach: "),
        }.items():
            with self.subTest(name):
                self.damaged(change)
                self.refused_in_turn(f"{self.path}: row {row}: ", *words)
        for name, (change, row, *words) in {
                "expectation": (value("expect/point1", hit, 0.5, 1), hit, "expect.point1[1]: the file says 0.5"),
                "witness": (value("exact/distance2", 9, b"0x7p-3"), 9, "exact.distance2: ", "0x7p-3"),
                "hit": (value("expect/hit", miss, 1), miss, "expect."),
        }.items():
            with self.subTest(name):
                self.damaged(change)
                self.refused(("lint", self.path), f"{self.path}: row {row}: ", *words)
                convert = ("convert", self.path, "-o", self.folder / "x.jsonl")
                self.refused(convert, f"{self.path}: columns_sha256: the file says")
                seal(self.path)
                done = self.refused(convert, f"{self.path}: sha256: the file says")
                with h5py.File(self.path, "r+") as file:  # whoever made the mistake may have made the digest too
                    file.attrs["sha256"] = numpy.bytes_(done.stderr.split()[-1].encode())
                seal(self.path)
                self.refused(("certify", self.path), f"{self.path}: row {row}: ", *words)

    def test_an_npz_that_is_wrong_is_refused_where_it_is(self):
        self.good = self.generate("good.npz", family=("--pair", "sphere_sphere", "--family", "alarm_edge", "--seed", 7))
        self.path = self.folder / "d.npz"
        with numpy.load(self.good) as file:
            good = {name: file[name] for name in file.files}
        header = json.loads(good["header"].item())

        def other(name, value):
            return {**good, name: value}

        def without(name):
            return {key: value for key, value in good.items() if key != name}

        def changed(name, row, value):
            column = good[name].copy()
            column[row] = value
            return other(name, column)

        def told(**change):
            return other("header", json.dumps({**header, **change}))
        miss = int(numpy.flatnonzero(good["expect/hit"] == 0)[3])
        for name, (columns, *words) in {
                "column missing": (without("exact/reach"), "/exact/reach: missing"),
                "unknown column": (other("expect/colour", good["alarm"]), "/expect/colour: unknown"),
                "header missing": (without("header"), "/header: missing"),
                "header no JSON": (other("header", "{"), "d.npz"),
                "a list of headers": (other("header", ["{}", "{}"]), "/header: expected one text"),
                "numbers for a header": (other("header", numpy.zeros(3)), "/header: expected a text"),
                "flags without names": (without("flags.names"), "/flags.names: missing"),
                "wrong version": (told(version=2), "version: ", "2"),
                "wrong pair": (told(pair="cube_cube"), "/a/max: missing"),
                "count too small": (told(count=39), "/id: ", "(39)", "(40)"),
                "another seed": (told(seed=8), "columns_sha256: "),
                "numbers too narrow": (other("alarm", good["alarm"].astype("f4")), "/alarm: expected 64-bit IEEE numbers"),
                "whole numbers": (other("alarm", good["alarm"].astype("i8")), "/alarm: has values of NumPy's kind '<i8'"),
                "numbers of another processor": (other("alarm", good["alarm"].astype(">f8")), "/alarm: has values of NumPy's kind '>f8'"),
                "objects": (other("alarm", good["alarm"].astype(object)), "/alarm: has values of NumPy's kind '|O'"),
                "by columns": (other("a/center", numpy.asfortranarray(good["a/center"])), "/a/center: is stored by columns", "ascontiguousarray"),
                "two coordinates": (other("a/center", good["a/center"][:, :2].copy()), "/a/center: ", "(40, 3)", "(40, 2)"),
                "one value": (other("alarm", numpy.float64(3)), "/alarm: expected rows, got one value"),
                "column too short": (other("contact", good["contact"][:-1]), "/contact: ", "(39)"),
                "text too wide": (other("id", good["id"].astype("S25")), "/id: expected texts of 24 bytes"),
                "other question": (changed("alarm", 17, 123.5), "row 17: id: "),
                "no truth value": (changed("expect/hit", 5, 2), "row 5: /expect/hit: expected 0 or 1, got 2"),
                "contact of a miss": (changed("expect/value", miss, 0.5), f"row {miss}: /expect/value: a miss has no contact"),
        }.items():
            with self.subTest(name):
                numpy.savez(self.path, **columns)
                self.refused_in_turn(f"{self.path}: ", *words)
        for name, value in (("expect/value", 0.5), ("exact/reach", b"0x7p-3")):
            numpy.savez(self.path, **changed(name, int(numpy.flatnonzero(good["expect/hit"])[3]), value))
            self.refused(("lint", self.path), f"{self.path}: row ", name.replace("/", "."))

    def test_a_damaged_archive_is_refused(self):
        self.good = self.generate("good.npz", count=300)
        self.path = self.folder / "d.npz"
        good = self.good.read_bytes()
        with zipfile.ZipFile(self.good) as file:
            members = {one.filename: file.read(one) for one in file.infolist()}
            alarm = file.getinfo("alarm.npy")
        inside = good.index(b"\x93NUMPY", alarm.header_offset) + 256 + 8 * 150 + 6  # of a number, by the checksum alone

        def archive(members, also=()):
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # two of one name
                with zipfile.ZipFile(self.path, "w") as file:
                    for name, content in (*members.items(), *also):
                        file.writestr(name, content)

        for name, content, words in (("empty", b"", "no .npz file"), ("noise", NOISE, "no .npz file"), ("beginning", good[:100], "cannot read"),
                                     ("half", good[:len(good) // 2], "cannot read"), ("last byte", good[:-1], "cannot read"),
                                     ("a bit", good[:inside] + bytes([good[inside] ^ 1]) + good[inside + 1:], "")):
            with self.subTest(name):
                self.path.write_bytes(content)
                self.refused_in_turn(f"{self.path}: ", words)
        head = members["alarm.npy"][:256]
        for name, alarm, words in (("no magic", b"x" * 3000, "/alarm: is no .npy file"), ("nothing", b"", "/alarm: is no .npy file"),
                                   ("rows missing", members["alarm.npy"][:-8], "/alarm: has 2392 bytes, and its rows take 2400"),
                                   ("rows without end", head.replace(b"(300,)", b"(%d,)" % 2**62), "/alarm: "),
                                   ("a shape beyond numbers", head.replace(b"(300,)", b"(%d,)" % 10**30), "/alarm: has a shape beyond any memory"),
                                   ("a long header", b"\x93NUMPY\x02\x00\xff\xff\xff\xff" + bytes(300), "/alarm: is no .npy file")):
            with self.subTest(name):
                archive({**members, "alarm.npy": alarm})
                self.refused_in_turn(f"{self.path}: ", words)
        archive(members, [("alarm.npy", members["alarm.npy"])])
        self.refused_in_turn(f"{self.path}: /alarm: is there twice")
        archive({**members, "readme.txt": "x"})
        self.refused_in_turn(f"{self.path}: /readme.txt: is no .npy file")

    def test_a_file_that_was_changed_is_refused_by_the_digest_of_its_columns(self):
        family = ("--pair", "sphere_sphere", "--family", "touching", "--seed", 7)
        certify, convert = ("certify", "--engine", "production"), ("convert", "-o", self.folder / "x.jsonl")
        for path, count in ((self.generate("a.h5", count=40, family=family), 40), (self.generate("b.h5", count=4100, family=family), 4100),
                            (self.generate("a.npz", count=40, family=family), 40), (self.generate("b.npz", count=4100, family=family), 4100)):
            _, good, names = read(path)
            header = json.loads(numpy.load(path)["header"].item()) if path.suffix == ".npz" else None
            last = count - 1
            hits = numpy.flatnonzero(good["expect/hit"])

            def change(columns=(), **keys):
                """Writes the file with other rows and another header."""
                rows = dict(columns)
                changed = self.folder / f"changed{path.suffix}"
                if header is None:
                    shutil.copy(path, changed)
                    with h5py.File(changed, "r+") as file:
                        for name, value in rows.items():
                            file[name][:] = value
                else:
                    numpy.savez(changed, **{**good, **rows}, header=json.dumps(header), **{"flags.names": numpy.array(names, "S")})
                tell(changed, **keys)
                return changed

            def other(name, row, value):
                column = good[name].copy()
                column[row] = value
                return {name: column}

            def swapped(first, second):
                order = numpy.arange(count)
                order[[first, second]] = order[[second, first]]
                return {name: column[order] for name, column in good.items()}
            for name, changed in {
                    "a number": other("exact/margin_ulps", last, 7.5), "a number of the first row": other("exact/margin_ulps", 0, 7.5),
                    "the sign of a zero": other("alarm", last, -0.0),
                    "a text": other("exact/reach", last, b"0x7p-3"), "a truth value": other("expect/degenerate", hits[-1], 1),
                    "flags": other("flags", last, good["flags"][last] ^ 1), "a pair of rows": swapped(3, last)}.items():
                if count > 4096 and name not in ("a number", "flags", "a pair of rows"):
                    continue  # what of a row is wrong matters where all rows are one chunk
                with self.subTest(name, path=path.name):
                    target = change(changed)
                    # Nothing else is wrong in some, so that nothing but the digest can say so.
                    alone = name in ("flags", "the sign of a zero", "a pair of rows")
                    words = ("columns_sha256: the file says ", ", its header and columns have ") if alone else ()
                    for command in (certify, (*certify, "--jobs", 2), convert):
                        self.refused((*command, target), f"{target}: ", *words)
            for key, value in (("seed", 8), ("generator", "another 0.1.0"), ("sha256", "0" * 64), ("columns_sha256", "0" * 64)):
                with self.subTest(key, path=path.name):
                    target = change(**{key: value})
                    for command in (certify, (*certify, "--jobs", 2), convert):
                        self.refused((*command, target), f"{target}: columns_sha256: the file says ", ", its header and columns have ")
            with self.subTest("as it was", path=path.name):
                target = change()
                self.holds("lint", "--generated", target)
                self.holds(*certify, target)

    def test_a_file_without_the_digest_of_its_columns_is_compared_with_that_of_its_lines(self):
        for path in (self.generate(name, count=4100, family=CUBE_FAMILY) for name in ("a.h5", "a.npz")):
            lines = self.convert(path, to="a.jsonl").read_bytes()
            with self.subTest(path.name):
                tell(path, "columns_sha256")
                self.holds("certify", path, "--engine", "production")
                self.holds("lint", "--generated", path)
                self.assertEqual(self.convert(path, to="b.jsonl").read_bytes(), lines)
                tell(path, seed=8)
                for args in (("certify", path), ("certify", path, "--jobs", 2), ("lint", "--generated", path), ("convert", path, "-o", self.folder / "c.jsonl")):
                    self.refused(args, f"{path}: sha256: the file says ")

    def test_the_digest_of_the_lines_is_compared_where_that_is_asked_for(self):
        other = "0" * 64
        for path in (self.generate(name, count=4100, family=CUBE_FAMILY) for name in ("a.h5", "a.npz")):
            with self.subTest(path.name):
                tell(path, sha256=other)
                seal(path)
                for args in (("lint", "--generated", path), ("convert", path, "-o", self.folder / "x.jsonl"), ("certify", path, "--check", "all")):
                    self.refused(args, f"{path}: sha256: the file says {other}")
                self.holds("certify", path, "--engine", "production")

    def test_what_is_no_hdf5_or_a_piece_of_it_is_refused(self):
        good = self.good.read_bytes()
        for name, content, words in (("empty", b"", "no HDF5 file"), ("lines", (GOLDEN / "cube_cube/flat.jsonl").read_bytes(), "no HDF5 file"),
                                     ("noise", NOISE, "no HDF5 file"), ("beginning", good[:8], "cannot read"),
                                     ("half", good[:len(good) // 2], "truncated"), ("last byte", good[:-1], "truncated"),
                                     ("zeros", good[:2000] + bytes(len(good) - 2000), "")):
            with self.subTest(name):
                self.path.write_bytes(content)
                self.refused_in_turn(f"{self.path}: ", words)


class DamageCampaign(Damage):
    """What `Damage` asks of one command in turn, of all three."""

    def refused_in_turn(self, *words):
        for args in self.readers():
            with self.subTest(args[0]):
                self.refused(args, *words)


class Shards(Columns):
    def shards(self, n, ending=lambda i: "jsonl", count=40, family=SPHERE_FAMILY, name="shard"):
        return [self.generate(f"{name}{i}.{ending(i)}", "--shard", f"{i}/{n}", count=count, family=family) for i in range(n)]

    def test_all_shards_in_any_order_and_form_become_the_whole(self):
        for family in (SPHERE_FAMILY, CUBE_FAMILY):
            lines, columns = (self.generate(f"whole.{ending}", family=family) for ending in ("jsonl", "h5"))
            zero, one, two, *rest = self.shards(7, lambda i: ("jsonl", "h5")[i % 2], family=family)
            order = [*rest, two, zero, one]
            self.assertEqual(self.convert(*order, to="merged.jsonl").read_bytes(), lines.read_bytes())
            self.assertEqual(self.convert(*order, to="merged.h5").read_bytes(), columns.read_bytes())
            # More shards than cases: some hold none.
            few = self.shards(5, lambda i: ("jsonl", "h5")[i % 2], count=3, family=family, name="few")
            self.assertEqual(self.convert(*few, to="merged.jsonl").read_bytes(),
                             self.generate("three.jsonl", count=3, family=family).read_bytes())

    def test_a_shard_alone_stays_a_shard(self):
        shard = self.shards(3)[1]
        self.assertEqual(self.convert(self.convert(shard, to="x.h5"), to="y.jsonl").read_bytes(), shard.read_bytes())

    def test_shards_that_do_not_make_one_dataset_are_refused_by_name(self):
        good, target = self.shards(3), self.folder / "whole.jsonl"

        def refused(shards, *words):
            self.refused(("convert", *shards, "-o", target), *words)

        def other(shard="1/3", seed=7, scalar="binary64", count=40):
            return self.generate("other.jsonl", "--shard", shard, "--scalar", scalar, count=count,
                                 family=[*SPHERE_FAMILY[:4], "--seed", seed])
        refused(good[:2], "shard 2/3", "missing")
        refused([good[0], good[2]], "shard 1/3", "missing")
        refused([*good, good[1]], good[1], "shard 1/3", "already")
        refused([*good, self.folder / "gone.jsonl"], "gone.jsonl", "no such file")
        refused([good[0], self.generate("all.jsonl"), good[2]], "all.jsonl: shard: ")
        for change in ({"seed": 8}, {"scalar": "binary32"}, {"shard": "1/4"}):
            with self.subTest(change):
                refused([good[0], path := other(**change), good[2]], f"{path}: shard: not of the same dataset as {good[0]}")
        refused([good[0], other(count=44), good[2]], ": count: ", "of 42")
        content = good[1].read_bytes()
        for name, damage, words in (("cut", content[:-30], "truncated"), ("a line less", b"".join(content.splitlines(True)[:-1]), "count"),
                                    ("noise", b"\x00\x01", "")):
            with self.subTest(name):
                good[1].write_bytes(damage)
                refused(good, good[1], words)

    def test_a_resumed_generation_keeps_what_is_whole_and_refuses_what_is_not(self):
        for ending in ("jsonl", "h5", "npz"):
            args = ("generate", *SPHERE_FAMILY, "--count", 40, "--resume", "-o", self.folder / f"x.{ending}", "--shard", "1/3")
            path = args[-3]
            self.assertNotIn("kept", self.holds(*args))
            first, made = path.read_bytes(), path.stat()
            self.assertIn(f"{path}: 13 cases, kept", self.holds(*args))
            self.assertEqual((path.stat().st_ino, path.stat().st_mtime_ns), (made.st_ino, made.st_mtime_ns))
            for name, content in {"cut": first[:-20], "empty": b"", "flipped": first[:len(first) // 2] + b"~" + first[len(first) // 2 + 1:],
                                  "of another": self.generate(f"o.{ending}", "--shard", "2/3").read_bytes()}.items():
                with self.subTest(name, ending=ending):
                    path.write_bytes(content)
                    self.refused(args, path)
                    self.assertEqual(path.read_bytes(), content)
            self.holds(*(word for word in args if word != "--resume"))
            self.assertEqual(path.read_bytes(), first)
        # Questions that are somebody else's under the right header.
        lines, others = (self.generate(f"{seed}.jsonl", family=[*SPHERE_FAMILY[:4], "--seed", seed]).read_text().splitlines() for seed in (7, 8))
        path = self.file("7.jsonl", [lines[0], *others[1:]])
        self.refused(("generate", *SPHERE_FAMILY, "--count", 40, "--resume", "-o", path), f"{path}:2: id: ")


class Outputs(Columns):
    GENERATE = ("generate", "--pair", "sphere_sphere", "--family", "generic", "--seed", 1, "--count")

    def test_a_full_disk_is_reported_and_leaves_no_file(self):
        source = self.generate("source.jsonl", count=9000)
        for limit, form in ((0, "h5"), (3000, "h5"), (100_000, "h5"), (500_000, "h5"), (3000, "npz"), (300_000, "npz")):
            def no_room():
                resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
            for args in (("convert", source), *([(*self.GENERATE, 9000)] if limit == 100_000 else [])):
                with self.subTest(args[0], limit=limit, form=form):
                    target = self.folder / f"x.{form}"
                    self.refused((*args, "-o", target), f"{target}: cannot write: ", "File too large", preexec_fn=no_room,
                                 restore_signals=False)
                    self.assertEqual(list(self.folder.iterdir()), [source])

    @unittest.skipUnless(hasattr(os, "geteuid") and os.geteuid() == 0, "only root can mount a small disk")
    def test_a_small_disk_that_fills_up_is_reported_and_leaves_no_file(self):
        disk = self.folder / "disk"
        disk.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=256k", "tmpfs", disk], capture_output=True).returncode != 0:
            self.skipTest("no right to mount")
        self.addCleanup(subprocess.run, ["umount", disk], check=True)
        for ending in ("h5", "jsonl", "npz"):
            self.refused((*self.GENERATE, 9000, "-o", disk / f"x.{ending}"), "cannot write: ", "No space left on device")
            self.assertEqual(list(disk.iterdir()), [])

    def test_an_output_that_cannot_be_written_is_refused_by_name(self):
        (self.folder / "folder.h5").mkdir()
        os.mkfifo(self.folder / "pipe.h5")
        for name, word in (("gone/x.h5", "No such file"), ("folder.h5", "directory"), ("pipe.h5", "regular")):
            for args in ((*self.GENERATE, 3), ("convert", GOLDEN / "cube_cube/flat.jsonl")):
                self.refused((*args, "-o", self.folder / name), name, "cannot write", word)
        self.refused(("convert", GOLDEN / "cube_cube/flat.jsonl", "-o", self.folder / "x.txt"), "x.txt", ".jsonl, .h5 or .npz")

    def test_an_interruption_leaves_what_was_there(self):
        big = self.generate("big.h5", count=60000, family=("--pair", "cube_cube", "--family", "nested", "--seed", 1))
        target = self.folder / "x.h5"
        for args in ((*self.GENERATE, 20000000), ("convert", big)):
            for old in (None, b"old\n"):
                target.unlink(missing_ok=True)
                if old:
                    target.write_bytes(old)
                before = sorted(self.folder.iterdir())
                process = subprocess.Popen([TOOL, *map(str, args), "-o", target], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
                deadline = time.monotonic() + 300
                while len(list(self.folder.iterdir())) == len(before) and time.monotonic() < deadline:
                    time.sleep(0.01)
                process.send_signal(signal.SIGINT)
                out, err = process.communicate(timeout=300)
                self.assertEqual((process.returncode, out), (130, ""), args[0])
                self.assertIn("interrupted", err)
                self.assertEqual(sorted(self.folder.iterdir()), before)
                self.assertEqual(target.read_bytes() if old else None, old)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
