#!/usr/bin/env python3
"""Answers as columns, of engines that answer many questions at once: python3 tool/answers_test.py PATH_TO_TOOL [unittest
arguments]. A small engine in NumPy makes them, from questions as columns."""
import hashlib
import json
import math
import sys
import unittest

import h5py
import numpy

from cli_test import Case

FAMILY = ("--pair", "sphere_sphere", "--family", "generic", "--seed", 5)


def spheres(questions, number="f8"):
    """The formula in NumPy, in numbers of one kind."""
    def column(name):
        return questions[name].astype(number)
    c1, c2, r1, r2 = (column(name) for name in ("a/center", "b/center", "a/radius", "b/radius"))
    with numpy.errstate(all="ignore"):
        delta = c2 - c1
        distance = numpy.sqrt(delta[:, 0] ** 2 + delta[:, 1] ** 2 + delta[:, 2] ** 2)
        normal = delta / distance[:, None]
        return {"hit": distance <= column("alarm") + r1 + r2, "normal": normal, "point1": c1 + r1[:, None] * normal,
                "point2": c2 - r2[:, None] * normal, "value": distance - (r1 + r2) - column("contact")}


def load(path):
    if path.suffix == ".npz":
        with numpy.load(path) as file:
            return {name: file[name] for name in file.files}
    found = {}
    with h5py.File(path, "r") as file:
        file.visititems(lambda name, item: found.update({name: item[:]}) if isinstance(item, h5py.Dataset) else None)
    return found


def save(path, columns, header=None):
    if path.suffix == ".npz":
        numpy.savez(path, **columns, **({} if header is None else {"header": json.dumps(header)}))
        return path
    with h5py.File(path, "w") as file:
        for name, column in columns.items():
            file[name] = column
        if header is not None:
            file.attrs["header"] = json.dumps(header)
    return path


class Answers(Case):
    def questions(self, form="npz", count=100, family=FAMILY):
        path = self.folder / f"questions.{form}"
        self.holds("generate", *family, "--count", count, "-o", path)
        return path, load(path)

    def answers(self, columns, header=None, form="npz"):
        return save(self.folder / f"answers.{form}", columns, header)

    def both(self, count=100):
        """A dataset, its questions, and right columns."""
        path, questions = self.questions(count=count)
        return path, questions, {"id": questions["id"], **spheres(questions)}


class Rows(Answers):
    def test_answers_in_either_form_are_judged_as_those_over_a_pipe(self):
        path, questions, columns = self.both()
        lines = [{"format": "contact-oracle/results", "version": 1, "engine": {"name": "numpy", "version": "1"}, "scalar": "binary64",
                  "pairs": ["sphere_sphere"]}]
        for i in range(len(columns["hit"])):
            hit = bool(columns["hit"][i])
            contact = {name: columns[name][i].tolist() for name in ("normal", "point1", "point2", "value")}
            lines.append({"id": questions["id"][i].decode(), "overlap": hit, "contact": contact if hit else None})
        of_lines = self.certify_json(path, "--results", self.file("answers.jsonl", lines))
        self.assertRegex(of_lines["verdict"], "^CERTIFIED")
        self.assertGreater(of_lines["total"]["hits"], 20)
        header = {"engine": {"name": "numpy", "version": "1"}}
        for form in ("npz", "h5"):
            for given in (columns, {name: column for name, column in columns.items() if name != "id"}):
                found = self.certify_json(path, "--results", self.answers(given, header, form))
                for key in ("verdict", "level", "total", "families", "fields", "fitness"):
                    self.assertEqual(found.get(key), of_lines.get(key), (form, key))
                self.assertEqual(found["engine"], header["engine"])

    def test_the_numbers_columns_have_are_the_engines(self):
        path, questions = self.questions(family=("--pair", "sphere_sphere", "--family", "generic", "--seed", 5, "--scalar", "binary32"))
        found = self.certify_json(path, "--results", self.answers(spheres(questions, "f4")), "--level", "bounded")
        self.assertEqual((found["scalar"], found["engine"]["name"]), ("binary32", "answers"))
        self.assertRegex(found["verdict"], "^CERTIFIED: answers reaches bounded on all 100")
        mixed = spheres(questions, "f4")
        self.refused(("certify", path, "--results", self.answers({**mixed, "value": mixed["value"].astype("f8")})), "/value: has numbers of another size")
        self.refused(("certify", path, "--results", self.answers(mixed, {"scalar": "binary64"})), "scalar: the columns have 32-bit numbers")

    def test_what_the_columns_claim_is_judged_and_no_more(self):
        path, questions, columns = self.both()
        hit = {"hit": columns["hit"]}
        # Decisions alone.
        found = self.certify_json(path, "--results", self.answers(hit), "--level", "decisions")
        self.assertRegex(found["verdict"], "^CERTIFIED")
        self.assertEqual(found["claims"], ["overlap", "contact"])
        found = self.certify_json(path, "--results", self.answers({"overlap": columns["hit"]}), "--level", "decisions")
        self.assertEqual(found["claims"], ["overlap"])
        # Only numbers: a row without any says that there is no contact.
        value = numpy.where(columns["hit"], columns["value"], numpy.nan)
        found = self.certify_json(path, "--results", self.answers({"value": value}), "--level", "bounded")
        self.assertRegex(found["verdict"], "^CERTIFIED")
        self.assertEqual(found["claims"], ["contact", "value"])
        # A NaN that stands beside numbers, or in a contact, is a claim.
        row = int(numpy.flatnonzero(columns["hit"])[2])
        for also in ({}, hit):
            broken = {**also, "normal": numpy.where(columns["hit"][:, None], columns["normal"], numpy.nan), "value": value.copy()}
            broken["value"][row] = numpy.nan
            self.refuted("certify", path, "--results", self.answers(broken))
        # The one point of a middle says its convention itself.
        middle = (columns["point1"] + columns["point2"]) / 2
        self.certified(path, {**hit, "point": middle}, "--tolerance", "length=1e-12")

        # So do several points: here the deepest, which a row of NaN follows.
        places = numpy.stack([columns["point1"], numpy.full((len(columns["hit"]), 3), numpy.nan)], 1)
        depths = numpy.stack([-columns["value"] - questions["contact"], numpy.full(len(columns["hit"]), numpy.nan)], 1)
        several = {**hit, "normal": columns["normal"], "points": places, "depths": depths}
        found = self.certify_json(path, "--results", self.answers(several), "--tolerance", "length=1e-12,angle=1e-12")
        self.assertRegex(found["verdict"], "^CERTIFIED")
        self.assertEqual((found["claims"], found["conventions"]["most_points"]), (["overlap", "contact", "normal", "points"], 2))
        self.assertEqual(found["total"]["fields"]["points"]["bounded"], int(columns["hit"].sum()))
        places[row, 1], depths[row, 1] = places[row, 0] + [0, 0, 1], depths[row, 0]
        self.refuted("certify", path, "--results", self.answers(several), "--tolerance", "length=1e-12,angle=1e-12")
        self.refused(("certify", path, "--results", self.answers({**hit, "points": places})), "/points: points and depths go together")
        self.refused(("certify", path, "--results", self.answers({**several, "depths": depths[:, :1]})), "has 2 a row")
        self.refused(("certify", path, "--results", self.answers({**several, "points": places[:, :, :2]})), "/points: expected a shape of")

    def certified(self, path, columns, *more, header=None):
        return self.holds("certify", path, "--results", self.answers(columns, header), *more)

    def test_one_wrong_answer_is_found(self):
        path, questions, columns = self.both()
        row = int(numpy.flatnonzero(columns["hit"])[7])
        for name, value in (("hit", False), ("value", 1e3), ("point1", 5.0)):
            with self.subTest(name):
                wrong = columns[name].copy()
                wrong[row] = value
                out = self.refuted("certify", path, "--results", self.answers({**columns, name: wrong}))
                self.assertIn(questions["id"][row].decode(), out)

    def test_a_row_may_be_unsupported(self):
        path, questions, columns = self.both()
        unsupported = numpy.zeros(100, bool)
        unsupported[[3, 50]] = True
        given = {**columns, "unsupported": unsupported}
        self.refuted("certify", path, "--results", self.answers(given))
        self.assertIn("98 judged cases", self.certified(path, given, "--allow-unsupported"))

    def test_the_header_declares(self):
        path, questions, columns = self.both()
        turned = {**columns, "normal": -columns["normal"]}
        self.refuted("certify", path, "--results", self.answers(turned))
        self.certified(path, turned, header={"conventions": {"normal": "second-to-first"}})
        self.assertIn("CERTIFIED within length", self.certified(path, columns, header={"tolerance": {"length": 1e-12, "angle": 1e-12}}))
        for header, words in (({"pairs": ["cone_cone"]}, "pairs"), ({"colour": 1}, "colour"), ({"format": "other"}, "format: "), ({"version": 2}, "version: "),
                              ({"claims": ["colour"]}, "claims")):
            with self.subTest(header):
                self.refused(("certify", path, "--results", self.answers(columns, header)), f"{self.folder}/answers.npz: ", words)


class Refusals(Answers):
    def test_columns_that_are_wrong_are_refused_by_name(self):
        path, questions, columns = self.both()
        fewer = {name: column[:-1] for name, column in columns.items()}
        swapped = columns["id"].copy()
        swapped[[10, 11]] = swapped[[11, 10]]
        two = columns["hit"].astype("u1")
        two[9] = 2
        for name, (given, *words) in {
                "unknown": ({**columns, "norml": columns["normal"]}, "/norml: unknown; answers have the columns id, hit, overlap, contact, "),
                "none": ({"id": columns["id"]}, "no column claims anything"),
                "fewer rows": (fewer, "has 99 rows, and the dataset 100 questions"),
                "one column shorter": ({**columns, "value": columns["value"][:-1]}, "/value: has 99 rows, and "),
                "another order": ({**columns, "id": swapped}, "row 10: /id: is ", "rows stand in the order of the questions"),
                "no id": ({**columns, "id": numpy.array([b"x" * 24] * 100)}, "row 0: /id: expected the 24 hexadecimal digits"),
                "short ids": ({**columns, "id": columns["id"].astype("S12")}, "/id: expected texts of 24 bytes, got 12"),
                "a column too many": ({**columns, "value": columns["value"][:, None]}, "/value: expected a shape of (100), got (100, 1)"),
                "two coordinates": ({**columns, "normal": columns["normal"][:, :2].copy()}, "/normal: expected a shape of (100, 3), got (100, 2)"),
                "no truth value": ({**columns, "hit": two}, "row 9: /hit: expected 0 or 1, got 2"),
                "numbers for truth": ({**columns, "hit": columns["hit"].astype("f8")}, "/hit: expected truth values, got 64-bit"),
                "half": ({**columns, "value": columns["value"].astype("f2")}, "/value: "),
        }.items():
            for form in ("npz", "h5"):
                with self.subTest(name, form=form):
                    if form == "h5" and name == "half":
                        words = ["/value: expected 64-bit or 32-bit IEEE numbers, got values of another kind"]
                    self.refused(("certify", path, "--results", self.answers(given, form=form)), f"{self.folder}/answers.{form}: ", *words)

    def test_a_dataset_is_no_answer_and_answers_are_no_dataset(self):
        path, questions, columns = self.both()
        self.refused(("certify", path, "--results", path), f"{path}: /", "unknown")
        answers = self.answers(columns, {"format": "contact-oracle/results", "version": 1})
        self.refused(("certify", answers), f"{answers}: ")
        # In a folder answers that say what they are lie beside the questions.
        self.assertIn("100 judged cases", self.holds("certify", self.folder, "--engine", "production"))

    def test_rows_cut_short_are_refused(self):
        path, questions, columns = self.both(count=9000)
        answers = self.answers(columns)
        good = answers.read_bytes()
        at = good.rindex(b"\x93NUMPY") + 3000
        # A changed bit is another answer: the archive's checksum alone tells.
        for content in (good[:-1], good[:len(good) // 2], good[:at] + bytes([good[at] ^ 64]) + good[at + 1:]):
            answers.write_bytes(content)
            self.refused(("certify", path, "--results", answers), f"{answers}: ", "cannot read")

    def test_determinism_cannot_be_asked_of_columns(self):
        path, questions, columns = self.both()
        self.refused(("certify", path, "--results", self.answers(columns), "--determinism"), "--determinism")


class Ids(Answers):
    """Several datasets, and exams: answers are found by their ids."""

    def test_answers_to_several_datasets_are_found_by_id_in_any_order(self):
        paths, columns = [], []
        for seed in (1, 2):
            path = self.folder / f"q{seed}.npz"
            self.holds("generate", "--pair", "sphere_sphere", "--family", "generic", "--seed", seed, "--count", 50, "-o", path)
            questions = load(path)
            paths.append(path)
            columns.append({"id": questions["id"], **spheres(questions)})
        order = numpy.random.default_rng(1).permutation(100)
        together = {name: numpy.concatenate([one[name] for one in columns])[order] for name in columns[0]}
        self.assertIn("all 100 judged cases", self.holds("certify", *paths, "--results", self.answers(together)))
        less = {name: column[1:] for name, column in together.items()}
        self.assertIn("1 missing", self.refuted("certify", *paths, "--results", self.answers(less)))
        twice = {name: numpy.concatenate([column, column[:1]]) for name, column in together.items()}
        self.refused(("certify", *paths, "--results", self.answers(twice)), "row 100: /id: this question is answered twice")
        without = {name: column for name, column in together.items() if name != "id"}
        self.refused(("certify", *paths, "--results", self.answers(without)), "/id: missing: without ids the rows answer the questions of one dataset")

    def test_a_certificate_of_columns_is_verified_and_every_change_found(self):
        path, questions, columns = self.both()
        answers, certificate = self.answers(columns), self.folder / "c.json"
        self.holds("certify", path, "--results", answers, "--certificate", certificate)
        self.assertIn("100 recorded answers, judged again", self.holds("verify", certificate))
        self.assertEqual(json.loads(certificate.read_text())["answers"]["sha256"], hashlib.sha256(answers.read_bytes()).hexdigest())
        value = columns["value"].copy()
        value[3] = math.nextafter(value[3], 9)
        self.answers({**columns, "value": value})
        self.assertIn("/answers/sha256", self.refuted("verify", certificate))

    def test_an_exam_is_set_answered_and_closed_in_columns(self):
        for form in ("npz", "h5"):
            with self.subTest(form):
                exam, key, certificate = (self.folder / f"{form}{name}" for name in (f"-exam.{form}", "-key.json", "-c.json"))
                self.holds("exam", "new", "-o", exam, "--key", key, "--pair", "sphere_sphere,cube_cube", "--count", 20)
                found = load(exam)
                self.assertEqual({name.split("/")[0] for name in found} - {"header"}, {"sphere_sphere", "cube_cube"})
                self.assertFalse(any("expect" in name or "exact" in name for name in found))
                questions = {name.split("/", 1)[1]: column for name, column in found.items() if name.startswith("sphere_sphere/")}
                places = numpy.concatenate([found["sphere_sphere/place"], found["cube_cube/place"]])
                self.assertEqual(sorted(places), list(range(len(places))))
                header = {"engine": {"name": "numpy", "version": "1"}, "pairs": ["sphere_sphere"]}
                answers = self.answers({"id": questions["id"], **spheres(questions)}, header, form)
                done = self.refuted("exam", "close", "--key", key, "--exam", exam, "--results", answers, "--certificate", certificate)
                self.assertIn("REFUTED: numpy 1", done)
                self.holds("verify", certificate, "--exam", exam)
                self.refused(("exam", "close", "--key", key, "--results", answers), "closed once")

    def test_an_exam_in_columns_is_that_in_lines_and_takes_no_change(self):
        exam, key, answers = self.folder / "exam.npz", self.folder / "key.json", self.folder / "a.jsonl"
        self.holds("exam", "new", "-o", exam, "--key", key, "--pair", "sphere_plane", "--family", "generic", "--count", 30)
        self.assertIn("30 of 30 questions answered", self.holds("exam", "take", exam, "-o", answers, "--engine", "production"))
        good = load(exam)
        radius, order = good["sphere_plane/a/radius"].copy(), good["sphere_plane/place"][::-1].copy()
        radius[7] += 1
        header = json.loads(good["header"].item())
        for name, (columns, *words) in {
                "a number": ({**good, "sphere_plane/a/radius": radius}, "row 7: /sphere_plane/id: the question has the id"),
                "the order": ({**good, "sphere_plane/place": order}, "questions: the header says"),
                "a row less": ({key: column[:-1] if column.ndim else column for key, column in good.items()}, "count: the header says 30, and 29 follow"),
                "a column less": ({key: column for key, column in good.items() if "place" not in key}, "/sphere_plane/place: missing"),
                "a column more": ({**good, "cone/id": good["sphere_plane/id"]}, "/cone: unknown"),
                "the commitment": ({**good, "header": json.dumps({**header, "commitment": "0"})}, "commitment: expected 64 hexadecimal digits"),
        }.items():
            with self.subTest(name):
                path = self.folder / "changed.npz"
                numpy.savez(path, **columns)
                self.refused(("exam", "take", path, "-o", self.folder / "b.jsonl", "--engine", "production"), f"{path}: ", *words)
        numpy.savez(self.folder / "changed.npz", **{**good, "header": json.dumps({**header, "commitment": "0" * 64})})
        self.refused(("exam", "close", "--key", key, "--exam", self.folder / "changed.npz", "--results", answers), "commitment: is not that of the key")
        self.holds("exam", "close", "--key", key, "--exam", exam, "--results", answers)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
