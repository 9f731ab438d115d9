#!/usr/bin/env python3
"""Certificates hold, and no change of them or of what they are of stays unfound:
python3 tool/certificate_test.py PATH_TO_TOOL [unittest arguments]."""
import copy
import hashlib
import json
import os
import re
import shutil
import sys
import unittest
from pathlib import Path

import cli_test
from cli_test import GOLDEN, PLAIN, ROOT, line, run

PAST, FUTURE = "1600000000", "2999-12-31"  # 2020-09-13


def issued_in_the_past():
    return {**os.environ, "SOURCE_DATE_EPOCH": PAST}


def layout(value, whole=False):
    """The canonical text, written down once more: docs/formats.md#certificates."""
    if isinstance(value, dict):
        feed = "\n" if whole else ""
        inner = ",".join(f"{feed}{line(key)}:{layout(value[key])}" for key in sorted(value))
        return "{" + inner + ("\n}\n" if whole else "}")
    if isinstance(value, list) and value and isinstance(value[0], dict):
        return "[" + ",".join("\n" + layout(one) for one in value) + "]"
    return json.dumps(value, separators=(",", ":"), sort_keys=True, ensure_ascii=False)


def sealed(text):
    """A certificate's text with the digest that it has."""
    blank = re.sub('\n"sha256":"[0-9a-f]*"', '\n"sha256":"' + "0" * 64 + '"', text)
    return blank.replace('\n"sha256":"' + "0" * 64, '\n"sha256":"' + hashlib.sha256(blank.encode()).hexdigest())


class Case(cli_test.Case):
    def setUp(self):
        super().setUp()
        self.folder = self.folder.resolve()
        self.path = self.folder / "c.json"
        self.answers = self.folder / "c.answers.jsonl"

    def certify(self, *args, code=0, **options):
        done = run("certify", *args, "--certificate", self.path, **options)
        self.assertEqual(done.returncode, code, done.stderr + done.stdout[-600:])
        return json.loads(self.path.read_text())

    def small(self):
        """A certificate of right answers to two questions, a dataset of their own, everything in one folder."""
        self.dataset = self.folder / "d.jsonl"
        header, *cases = (GOLDEN / "sphere_sphere" / "generic.jsonl").read_text().splitlines()
        hits = [case for case in cases if '"hit":true' in case][:2]
        self.dataset.write_text("\n".join([line({**json.loads(header), "count": len(hits)}), *hits]) + "\n")
        self.engine = self.folder / "engine.py"
        shutil.copy(PLAIN, self.engine)
        return self.certify(self.dataset, "--engine-command", f"python3 {self.engine}")

    def holds(self, *words, args=(), path=None):
        done = run("verify", path or self.path, *args)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        for word in ("HOLDS", *words):
            self.assertIn(word, done.stdout)
        return done.stdout

    def refuted(self, *words, args=()):
        done = run("verify", self.path, *args)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertEqual(done.stderr, "")
        for word in ("REFUTED", *words):
            self.assertIn(word, done.stdout)
        return done.stdout

    def refused(self, *words, args=()):
        done = run("verify", self.path, *args)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        for word in words:
            self.assertIn(str(word), done.stderr)

    def put(self, certificate, keys, value):
        """Writes a copy of the certificate in which one value is another, with the digest that it then has."""
        changed = copy.deepcopy(certificate)
        *outer, last = keys
        place = changed
        for key in outer:
            place = place[key]
        place[last] = value
        self.path.write_text(sealed(layout(changed, whole=True)))


class Holds(Case):
    def test_a_word_of_the_command_that_is_no_name_of_a_file_loses_no_certificate(self):
        self.small()
        command = f"python3 {self.engine} {'x' * 300}"
        self.assertEqual(self.certify(self.dataset, "--engine-command", command)["engine"]["command"], command)
        self.holds()
        done = run("certify", self.dataset, "--engine-command", os.fsdecode(b"python3 plain.py \xff"), "--certificate", self.path)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("--engine-command: is not UTF-8", done.stderr)

    def test_production_on_committed_files(self):
        folders = [GOLDEN / pair for pair in ("cube_cube", "ray_triangle", "sphere_sphere")]
        certificate = self.certify(*folders, "--family", "generic,touching", "--engine", "production", "--level", "correctly-rounded")
        self.holds("CERTIFIED: production", "reaches correctly-rounded", args=("--level", "correctly-rounded"))
        found = certificate["found"]
        self.assertEqual((found["certified"], found["share_judged"]), (True, "100 %"))
        # Boxes have no numbers, so decisions are all that an engine can get right there.
        self.assertEqual({(f["level"], f["pair"] == "cube_cube") for f in found["families"]},
                         {("correctly-rounded", False), ("decisions", True)})
        self.assertEqual({field["grade"] for f in found["families"] for field in f["fields"].values()},
                         {"correctly-rounded"})
        manifest = {entry["path"]: entry["sha256"] for entry in json.loads((GOLDEN / "manifest.json").read_text())["files"]}
        self.assertGreaterEqual(len(certificate["questions"]["sources"]), 10)
        for source in certificate["questions"]["sources"]:
            self.assertEqual(source["sha256"], manifest[source["file"]])
        self.assertGreater(certificate["oracle"]["put_to_all_oracles"], 2000)

    def test_an_engine_in_a_process_of_its_own(self):
        certificate = self.certify("golden/sphere_sphere/generic.jsonl", "--engine-command", f"python3 {PLAIN}")
        self.holds("CERTIFIED: plain-python", "1 of the engine's files", "the engine's program python3")
        self.assertEqual(certificate["engine"]["bounds"], {"value": 4, "normal": 4, "point": 4})
        self.assertEqual([f["sha256"] for f in certificate["engine"]["files"] if "file" in f],
                         [hashlib.sha256(PLAIN.read_bytes()).hexdigest()])

    def test_an_adapter_is_bound_by_its_own_files(self):
        here = [e for e in map(json.loads, run("engines", "--json").stdout.splitlines()) if e.get("command")]
        if not here:
            self.skipTest("no adapter's engine is here; ./run engines installs them")
        for engine in (here[0], here[-1]):
            with self.subTest(engine["name"]):
                path = self.folder / f"{engine['name']}.json"
                # Numbers and pairs of which every engine serves some.
                done = run("certify", "golden/sphere_sphere/generic.jsonl", "golden/sphere_sphere/generic.f32.jsonl",
                           "golden/cube_cube/generic.jsonl", "--engine", engine["name"], "--start-limit", 60, "--certificate", path)
                certificate = json.loads(path.read_text())
                self.assertEqual((done.returncode, done.stderr), (0 if certificate["found"]["certified"] else 1, ""))
                stated = certificate["engine"]
                self.assertEqual(stated["kind"], "adapter")
                bound = {Path(os.path.normpath(path.parent / f["file"])): f["sha256"] for f in stated["files"]}
                self.assertEqual(bound.pop(Path(engine["command"][-1])), hashlib.sha256(Path(engine["command"][-1]).read_bytes()).hexdigest())
                self.assertEqual([file.name for file in bound], ["package-lock.json"] if engine["command"][0] == "node" else [])
                self.assertEqual(run("verify", path).returncode, 0)

    def test_a_refuted_engine_has_a_certificate_that_says_so_and_never_passes_for_a_level(self):
        certificate = self.certify("golden/sphere_sphere/touching.jsonl", "--engine", "plain-double", code=1)
        self.assertFalse(certificate["found"]["certified"])
        self.holds("REFUTED: plain-double")
        self.refuted("REFUTED: bounded was required, and the certificate is of none", args=("--level", "bounded"))

    def test_a_level_is_demanded_of_what_would_be_certified_at_it(self):
        # Right answers that are too few to say anything, and boxes, of which no level asks for numbers.
        results = self.folder / "hits.jsonl"
        dataset = GOLDEN / "sphere_sphere" / "generic.jsonl"
        self.certify(dataset, "--engine", "production", "--fresh", 0)
        answers = list(map(json.loads, self.answers.read_text().splitlines()))
        hits = [a if a.get("overlap", True) else {"id": a["id"], "unsupported": "a miss"} for a in answers]
        results.write_text("".join(line(a) + "\n" for a in hits))
        self.certify(dataset, "--results", results, "--allow-unsupported", code=1)
        self.holds("TOO LITTLE JUDGED: ")
        for level in ("bounded", "decisions"):
            self.refuted(f"REFUTED: {level} was required, and what was judged is no certificate: always hit is right in all of them",
                         args=("--level", level))
        self.certify(GOLDEN / "cube_cube" / "generic.jsonl", "--engine", "production")
        self.holds("reaches decisions", args=("--level", "bounded"))
        # More than an engine reaches may have been required of it.
        self.certify(dataset, "--engine", "plain-double", "--level", "correctly-rounded", "--seed", 7, code=1)
        self.holds("REFUTED: plain-double", args=("--level", "bounded"))
        self.refuted("REFUTED: faithful was required, and the certificate is of bounded.", args=("--level", "faithful"))

    def test_recorded_answers_are_bound_where_they_are(self):
        results = GOLDEN / "recorded" / "sofa-2a278d8" / "sphere_sphere.jsonl"
        certificate = self.certify("golden/sphere_sphere", "--family", "upstream", "--results", results, code=1)
        self.assertFalse(self.answers.exists())
        self.assertEqual(certificate["answers"]["sha256"], hashlib.sha256(results.read_bytes()).hexdigest())
        self.assertEqual(certificate["engine"]["kind"], "recorded")
        self.holds("SOFA DiscreteIntersection")

    def test_generated_questions(self):
        args = ("--generate", 20, "--seed", 7, "--pair", "sphere_sphere,cube_cube", "--engine", "plain-float")
        certificate = self.certify(*args, code=1)
        self.holds("plain-float")
        self.assertNotIn("folder", certificate["questions"])
        self.assertEqual({s["seed"] for s in certificate["questions"]["sources"]}, {7})
        for key, value in (("seed", 8), ("count", 19), ("family", "touching"), ("scalar", "binary32")):
            with self.subTest(key):
                self.put(certificate, ("questions", "sources", 0, key), value)
                self.refuted("/questions/sources/0/questions")

    def test_the_questions_digest_is_of_lines_for_explain(self):
        certificate = self.certify("golden/cube_cube/touching.f32.jsonl")
        header, *cases = map(json.loads, (GOLDEN / "cube_cube" / "touching.f32.jsonl").read_text().splitlines())
        text = ""
        for raw in (GOLDEN / "cube_cube" / "touching.f32.jsonl").read_text().splitlines()[1:]:
            inputs = raw[raw.index('"a":'):raw.index(',"flags"')]
            text += f'{{"id":"{json.loads(raw)["id"]}","pair":"cube_cube","scalar":"binary32",{inputs}}}\n'
        self.assertEqual(certificate["questions"]["sources"][0]["questions"], hashlib.sha256(text.encode()).hexdigest())
        self.assertEqual(len(cases), header["count"])

    def test_the_same_run_writes_the_same_bytes_whatever_the_threads(self):
        args = ("golden/sphere_sphere", "--family", "generic,touching,extreme_scale", "--engine", "plain-float")
        self.certify(*args, "--jobs", 1, code=1, env=issued_in_the_past())
        first = self.path.read_bytes(), self.answers.read_bytes()
        certificate = self.certify(*args, "--jobs", 4, code=1, env=issued_in_the_past())
        self.assertEqual((self.path.read_bytes(), self.answers.read_bytes()), first)
        self.assertEqual(certificate["issued"], "2020-09-13")
        self.assertEqual(self.path.read_text(), sealed(layout(certificate, whole=True)))

    def test_columns(self):
        columns = self.folder / "d.h5"
        self.assertEqual(run("convert", GOLDEN / "sphere_sphere" / "generic.jsonl", "-o", columns).returncode, 0)
        self.certify(columns)
        self.holds()
        changed = bytearray(columns.read_bytes())
        changed[len(changed) // 2] ^= 1
        columns.write_bytes(changed)
        self.refuted("/questions/sources/0/sha256")

    def test_crashes_are_missing_also_where_an_error_would_be_right(self):
        engine = self.folder / "engine.py"
        engine.write_text(PLAIN.read_text().replace("        try:\n", "        if message['alarm'] == 'NaN': sys.exit(3)\n"
                                                    "        try:\n"))
        certificate = self.certify("golden/sphere_sphere/invalid.jsonl", "--family", "invalid", "--engine-command",
                                   f"python3 {engine}", code=1)
        self.assertGreater(certificate["found"]["total"]["answers"]["missing"], 0)
        self.assertEqual(certificate["found"]["total"]["level"], "none")
        self.holds("missing")

    def test_it_holds_elsewhere_with_its_files_and_with_their_places_given(self):
        self.small()
        other = self.folder / "elsewhere"
        other.mkdir()
        for file in (self.path, self.answers, self.dataset):
            shutil.move(file, other)
        self.holds("the engine's file engine.py: not here", path=other / "c.json")
        for file in ("c.json", "d.jsonl"):
            shutil.move(other / file, self.folder)
        self.refused("c.answers.jsonl", "no such file")
        self.holds(args=("--results", other / "c.answers.jsonl"))
        shutil.move(self.dataset, other)
        self.refused("d.jsonl", "no such file", args=("--results", other / "c.answers.jsonl"))
        for dataset in (other, other / "d.jsonl"):
            self.holds(args=("--results", other / "c.answers.jsonl", "--dataset", dataset))

    def test_names_may_be_relative_to_where_one_stands(self):
        (self.folder / "golden" / "cube_cube").mkdir(parents=True)
        shutil.copy(GOLDEN / "cube_cube" / "flat.jsonl", self.folder / "golden" / "cube_cube")
        for name in ("new.json", "new.json", "golden/../new.json", "golden/in.json"):  # absent, and then there
            with self.subTest(name):
                self.assertEqual(run("certify", "golden", "--certificate", name, cwd=self.folder).returncode, 0)
                certificate = json.loads((self.folder / name).read_text())
                inside = name == "golden/in.json"
                self.assertEqual(certificate["questions"]["folder"], "cube_cube" if inside else "golden/cube_cube")
                self.assertEqual(certificate["answers"]["file"], Path(name).stem + ".answers.jsonl")
                for path, cwd in ((name, self.folder), (self.folder / name, ROOT)):
                    self.assertEqual(run("verify", path, cwd=cwd).returncode, 0)

    def test_answers_can_be_recorded_without_a_certificate(self):
        recorded = self.folder / "r.jsonl"
        done = run("certify", "golden/sphere_sphere/generic.jsonl", "--engine", "plain-double", "--record", recorded)
        self.assertIn(f"Answers: {recorded}", done.stdout)
        again = run("certify", "golden/sphere_sphere/generic.jsonl", "--results", recorded)
        self.assertEqual(done.stdout.splitlines()[:6], again.stdout.splitlines()[:6])
        ids = [json.loads(one)["id"] for one in recorded.read_text().splitlines()[1:]]
        self.assertEqual((len(ids), ids), (210, sorted(ids)))


class OneByte(Case):
    """A change of a byte is found, and told by what it is a change of."""

    EVERY = False

    def sweep(self, path, step, check):
        original = path.read_bytes()
        places = range(0, len(original), 1 if self.EVERY else step)
        codes = {1: 0, 2: 0}
        for place in places:
            changed = bytearray(original)
            changed[place] ^= 1 << place % 7  # never the top bit: text stays ASCII, and may well stay JSON
            path.write_bytes(changed)
            done = run("verify", self.path)
            with self.subTest(path=path.name, byte=place):
                self.assertIn(done.returncode, (1, 2), done.stdout + done.stderr)
                self.assertNotIn("HOLDS", done.stdout)
                check(done)
            codes[done.returncode] += 1
        path.write_bytes(original)
        self.holds()
        print(f"{path.name}: {len(places)} of {len(original)} bytes changed, one at a time; "
              f"{codes[1]} refuted, {codes[2]} refused", file=sys.stderr)
        return codes

    def test_of_a_certificate(self):
        self.small()
        codes = self.sweep(self.path, 37, lambda done: self.assertRegex(done.stdout + done.stderr, r"/sha256|c\.json"))
        self.assertTrue(codes[1] and codes[2])

    def test_of_a_dataset(self):
        self.small()
        codes = self.sweep(self.dataset, 61, lambda done: self.assertIn("/questions/sources/0/sha256", done.stdout))
        self.assertFalse(codes[2])

    def test_of_the_answers(self):
        self.small()
        codes = self.sweep(self.answers, 61, lambda done: self.assertIn("/answers/sha256", done.stdout))
        self.assertFalse(codes[2])

    def test_of_the_certificate_of_production_and_its_files(self):
        self.certify("golden/cube_cube", "golden/sphere_sphere/touching.jsonl")
        self.holds()
        text = self.path.read_bytes()
        for i in range(20):
            place = len(text) * (2 * i + 1) // 40
            self.path.write_bytes(text[:place] + bytes([text[place] ^ 1]) + text[place + 1:])
            done = run("verify", self.path)
            self.assertIn(done.returncode, (1, 2))
            self.assertTrue(done.stdout + done.stderr)


class EveryByteCampaign(OneByte):
    """The bytes between those that `OneByte` changes."""

    EVERY = True


class Resealed(Case):
    """With the certificate's digest made anew, whatever can be derived is found all the same, by its place."""

    def test_the_layout_is_the_canonical_one(self):
        certificate = self.small()
        self.put(certificate, ("version",), 1)
        self.holds()

    def test_what_can_be_derived(self):
        certificate = self.small()
        self.assertIn("normal", certificate["found"]["families"][0]["fields"])
        table = [
            (("found", "certified"), not certificate["found"]["certified"]),
            (("found", "level_but_accepted"), "correctly-rounded"), (("found", "given"), 3),
            (("found", "share_judged"), "99 %"), (("found", "total", "level"), "faithful"),
            (("found", "total", "missed_hits"), 7), (("found", "families", 0, "level"), "correctly-rounded"),
            (("found", "families", 0, "judged"), 1), (("found", "families", 0, "hits"), 0),
            (("found", "families", 0, "answers", "answered"), 1), (("found", "families", 0, "family"), "touching"),
            (("found", "families", 0, "fields", "normal", "grade"), "beyond bound"),
            (("found", "families", 0, "fields", "normal", "worst_ulps"), 0.125),
            (("oracle", "version"), "99.0.0"), (("oracle", "put_to_all_oracles"), 0), (("oracle", "decided", "exact"), 77),
            (("engine", "name"), "another"), (("engine", "version"), "2"), (("engine", "scalar"), "binary32"),
            (("engine", "pairs", 0), "cube_cube"), (("engine", "conventions", "points"), "center"),
            (("engine", "bounds", "value"), 64), (("answers", "count"), 1), (("answers", "to_no_question"), 1),
            (("questions", "sources", 0, "count"), 3), (("questions", "sources", 0, "seed"), 3),
            (("questions", "sources", 0, "questions"), "0" * 64), (("added",), 7), (("engine", "added"), "text"),
        ]
        for keys, value in table:
            with self.subTest(keys):
                self.put(certificate, keys, value)
                out = self.refuted("/" + "/".join(map(str, keys)))
                self.assertIn(f"stated   {line(value)}", out)

    def test_another_version_of_the_oracle_is_told_by_both_versions(self):
        certificate = self.small()
        self.put(certificate, ("oracle", "version"), "0.0.9")
        self.refuted('/oracle/version\n  stated   "0.0.9"\n  derived  "' + certificate["oracle"]["version"])

    def test_a_part_left_out(self):
        certificate = self.small()
        for keys in (("found", "families"), ("found", "skipped"), ("accepted",), ("environment",), ("sha256",)):
            with self.subTest(keys):
                changed = copy.deepcopy(certificate)
                place = changed if len(keys) == 1 else changed[keys[0]]
                del place[keys[-1]]
                self.path.write_text(sealed(layout(changed, whole=True)))
                self.assertIn(run("verify", self.path).returncode, (1, 2))

    def test_other_spaces_and_another_order_of_keys(self):
        certificate = self.small()
        text = layout(certificate, whole=True)
        for changed in (text.replace('"found":{', '"found": {'), text + "\n", text.replace("\n]", "]"),
                        text.replace('"format":"contact-oracle/certificate",\n', "").replace(
                            "{\n", '{\n"format":"contact-oracle/certificate",\n', 1)):
            if changed == text:
                continue
            self.path.write_text(sealed(changed))
            self.refuted("not the canonical one")

    def test_wrong_answers_that_are_bound_anew(self):
        certificate = self.small()
        header, *lines = self.answers.read_text().splitlines()
        wrong = {**json.loads(lines[0]), "overlap": not json.loads(lines[0])["overlap"]}
        self.answers.write_text("\n".join([header, line(wrong), *lines[1:]]) + "\n")
        self.refuted("/answers/sha256", "not judged again")
        self.put(certificate, ("answers", "sha256"), hashlib.sha256(self.answers.read_bytes()).hexdigest())
        self.refuted("/found/certified", "/found/total/level")

    def test_a_wrong_dataset_that_is_bound_anew(self):
        certificate = self.small()
        text = self.dataset.read_text().replace('"hit":true', '"hit":false', 1)
        self.dataset.write_text(text)
        self.put(certificate, ("questions", "sources", 0, "sha256"), hashlib.sha256(text.encode()).hexdigest())
        self.refused("d.jsonl:2")

    def test_what_is_stated_and_not_checked_is_said(self):
        certificate = self.small()
        self.put(certificate, ("environment", "processor"), "abacus")
        self.holds("stated, not checked: the environment and the day of issue")

    def test_what_cannot_be_derived_has_its_form(self):
        certificate = self.small()
        for keys, value, words in ((("issued",), "2020-13-01", "issued: expected a day"), (("issued",), "9999-12-31", "issued: a day to come"),
                                   (("engine", "kind"), "oracle", "engine.kind: expected one of adapter, built-in, command"),
                                   (("engine", "kind"), "library", "engine.kind: a command line belongs to"),
                                   (("engine", "files", 0, "sha256"), "0" * 63, "sha256: expected 64 hexadecimal digits"),
                                   (("engine", "files", 0, "sha256"), "G" * 64, "sha256: expected 64 hexadecimal digits")):
            with self.subTest(keys=keys, value=value):
                self.put(certificate, keys, value)
                self.refused(words)

    def test_the_engines_file_is_checked_where_it_is(self):
        self.small()
        self.engine.write_text(self.engine.read_text() + "# changed\n")
        self.refuted("/engine/files/1/sha256")
        self.engine.unlink()
        self.holds("stated, not checked: the engine's file engine.py: not here")


class Damaged(Case):
    def test_a_truncated_certificate(self):
        self.small()
        text = self.path.read_bytes()
        for size in (0, 1, len(text) // 2, len(text) - 3):
            self.path.write_bytes(text[:size])
            self.refused("c.json")
        self.path.write_bytes(text[:-1])
        self.refuted("/sha256")

    def test_truncated_and_missing_files(self):
        self.small()
        for path, pointer in ((self.dataset, "/questions/sources/0/sha256"), (self.answers, "/answers/sha256")):
            whole = path.read_bytes()
            for size in (0, len(whole) // 2, len(whole) - 1):
                path.write_bytes(whole[:size])
                self.refuted(pointer)
            path.unlink()
            self.refused(path.name, "no such file")
            path.write_bytes(whole)
        self.path.unlink()
        self.refused("c.json", "no such file")

    def test_what_is_no_certificate(self):
        for text in ("", "{}", "[1]", "7\n", '{"format":"contact-oracle/report","version":1}', "\0" * 100):
            self.path.write_text(text)
            self.refused("c.json")
        certificate = self.small()
        self.put(certificate, ("version",), 2)
        self.refused("version")


class Accepted(Case):
    """Failures that a certificate accepts, for a reason and until a day."""

    ARGS = ("golden/sphere_sphere/touching.jsonl", "--engine", "plain-double")

    def setUp(self):
        super().setUp()
        self.known = self.folder / "known.json"
        self.assertEqual(run("certify", *self.ARGS, "--json", self.known).returncode, 1)
        self.report = json.loads(self.known.read_text())
        self.count = self.report["failure_count"]
        self.assertGreater(self.count, 50)

    def write(self, **keys):
        self.known.write_text(json.dumps({**self.report, **keys}))

    def test_without_a_reason_or_a_day_there_is_no_certificate(self):
        for keys in ({}, {"reason": "plain arithmetic"}, {"expires": FUTURE}):
            self.write(**keys)
            done = run("certify", *self.ARGS, "--baseline", self.known, "--certificate", self.path)
            self.assertEqual(done.returncode, 2)
            self.assertIn("why a failure is accepted and until when", done.stderr)
            self.assertFalse(self.path.exists() or self.answers.exists())
            self.assertEqual(run("certify", *self.ARGS, "--baseline", self.known).returncode, 0)

    def test_reasons_and_days_are_stated_a_failures_own_before_the_reports_before_the_command_lines(self):
        self.write(reason="plain arithmetic", expires=FUTURE)
        certificate = self.certify(*self.ARGS, "--baseline", self.known)
        self.assertTrue(certificate["found"]["certified"])
        self.assertEqual(certificate["found"]["total"]["level"], "none")
        self.assertEqual({(a["reason"], a["expires"]) for a in certificate["accepted"]}, {("plain arithmetic", FUTURE)})
        self.assertEqual([a["id"] for a in certificate["accepted"]], [f["id"] for f in self.report["failures"]])
        self.holds(f"CERTIFIED but for {self.count} failures")
        self.report["failures"][0].update(reason="its own", expires="2998-01-01")
        self.write(reason="plain arithmetic")
        accepted = self.certify(*self.ARGS, "--baseline", self.known, "--accept-reason", "late", "--accept-until",
                                FUTURE)["accepted"]
        self.assertEqual([(a["reason"], a["expires"]) for a in accepted[:2]],
                         [("its own", "2998-01-01"), ("plain arithmetic", FUTURE)])
        self.holds()
        self.write()
        strange = self.certify(*self.ARGS, "--baseline", self.known, "--accept-reason", os.fsdecode(b"\xff"), "--accept-until", FUTURE)["accepted"]
        self.assertEqual((strange[0]["reason"], strange[1]["reason"]), ("its own", r"\xff"))

    def test_what_has_expired_is_accepted_no_more(self):
        self.write(reason="plain arithmetic", expires="2020-12-31")
        done = run("certify", *self.ARGS, "--baseline", self.known)
        self.assertEqual(done.returncode, 1)
        self.assertIn("was accepted until 2020-12-31: plain arithmetic", done.stderr)
        self.certify(*self.ARGS, "--baseline", self.known, env=issued_in_the_past())
        out = self.refuted("/accepted/0/expires", "expired: today is 2")
        self.assertIn(f"{self.count} statements differ", out)
        self.assertNotIn("/found", out)

    def test_the_last_day_counts(self):
        self.write(reason="plain arithmetic", expires="2020-09-13")
        self.certify(*self.ARGS, "--baseline", self.known, env=issued_in_the_past())
        self.write(reason="plain arithmetic", expires="2020-09-12")
        self.certify(*self.ARGS, "--baseline", self.known, env=issued_in_the_past(), code=1)

    def test_what_is_accepted_must_fail_and_what_fails_must_be_listed(self):
        self.write(reason="plain arithmetic", expires=FUTURE)
        certificate = self.certify(*self.ARGS, "--baseline", self.known)
        self.put(certificate, ("accepted",), certificate["accepted"][1:])
        self.refuted("/found/certified", "/found/total/accepted")
        header, *cases = map(json.loads, (GOLDEN / "sphere_sphere" / "touching.jsonl").read_text().splitlines())
        right = next(c["id"] for c in cases if c["id"] not in {a["id"] for a in certificate["accepted"]})
        self.put(certificate, ("accepted", 0, "id"), right)
        self.refuted("/accepted/0/id")
        self.put(certificate, ("accepted", 0, "level"), "correctly-rounded")
        self.refuted("/found/total/accepted")
        self.put(certificate, ("accepted", 0, "expires"), "someday")
        self.refuted("/accepted/0/expires")

    def test_a_question_that_failed_in_both_scalars_is_accepted_as_bad_as_the_worse(self):
        first = self.report["failures"][0]
        self.assertEqual(first["level"], "none")
        self.report["failures"].insert(0, {**first, "level": "decisions"})
        self.write(failure_count=self.count + 1)
        self.assertEqual(run("certify", *self.ARGS, "--baseline", self.known).returncode, 0)

    def test_what_is_no_day_and_no_reason_is_refused(self):
        for keys, word in (({"expires": "2027-02-29"}, "YYYY-MM-DD"), ({"expires": "soon"}, "YYYY-MM-DD"),
                           ({"expires": 7}, "expires"), ({"reason": ""}, "reason"), ({"reason": ["x"]}, "reason")):
            self.write(**keys)
            done = run("certify", *self.ARGS, "--baseline", self.known)
            self.assertEqual(done.returncode, 2)
            self.assertIn(word, done.stderr)
        self.write()
        done = run("certify", *self.ARGS, "--baseline", self.known, "--accept-until", "2027-13-01")
        self.assertEqual(done.returncode, 2)
        self.assertIn("YYYY-MM-DD", done.stderr)


class Fresh(Case):
    """A certificate that tells of fresh questions too."""

    def fresh(self, *args, code=0):
        return self.certify("golden/sphere_sphere/generic.jsonl", "golden/sphere_sphere/touching.jsonl", "--fresh", 15, "--seed", 7, *args, code=code)

    def test_the_answers_to_fresh_questions_are_judged_again_and_a_seed_repeats_the_bytes(self):
        certificate = self.fresh()
        first = self.path.read_bytes(), self.answers.read_bytes()
        sources = certificate["questions"]["sources"]
        self.assertEqual([(s["family"], s["count"], s.get("seed"), s.get("fresh")) for s in sources],
                         [("generic", 210, None, None), ("touching", 210, None, None), ("generic", 15, 7, True), ("touching", 15, 7, True)])
        found = certificate["found"]
        self.assertEqual((found["total"]["judged"], found["given"]), (420, 420))
        self.assertEqual([found["fresh"][key] for key in ("each", "seed", "given")], [15, 7, 30])
        self.assertEqual(found["fresh"]["total"]["judged"], 30)
        self.holds("the questions of 2 sources, 30 fresh ones and 450 recorded answers", "and on all 30 fresh ones (seed 7)")
        self.fresh()
        self.assertEqual((self.path.read_bytes(), self.answers.read_bytes()), first)
        moved = self.folder / "moved.jsonl"
        shutil.copy("golden/sphere_sphere/generic.jsonl", moved)
        self.certify(moved, "--fresh", 15, "--seed", 7)
        self.holds(args=["--dataset", moved])

    def test_what_was_changed_is_found_whatever_digest_it_has(self):
        certificate = self.fresh("--engine", "plain-double", code=1)
        self.holds()
        table = [(("questions", "sources", 3, "seed"), 8, "/questions/sources/3/seed"),
                 (("questions", "sources", 3, "count"), 14, "/questions/sources/3/count"),
                 (("questions", "sources", 2, "questions"), "0" * 64, "/questions/sources/2/questions"),
                 (("found", "fresh", "seed"), 8, "/found/fresh/seed"), (("found", "fresh", "each"), 14, "/found/fresh/each"),
                 (("found", "fresh", "total", "missed_hits"), 0, "/found/fresh/total/missed_hits"),
                 (("found", "fresh"), None, "/found/fresh")]
        for keys, value, where in table:
            with self.subTest(keys):
                self.put(certificate, keys, value)
                self.refuted(where)
        for key, value in (("seed", 8), ("count", 14)):
            changed = copy.deepcopy(certificate)
            changed["found"]["fresh"]["each" if key == "count" else key] = value
            for source in changed["questions"]["sources"][2:]:
                source[key] = value
            self.path.write_text(sealed(layout(changed, whole=True)))
            self.refuted("/questions/sources/2/questions")
        # A family where it fails cannot be left out.
        changed = copy.deepcopy(certificate)
        del changed["questions"]["sources"][3]
        self.path.write_text(sealed(layout(changed, whole=True)))
        self.refuted("/questions/sources/-\n  stated   nothing")
        # Nor can an answer be mended, or taken away.
        ids = {json.loads(answer)["id"] for answer in self.answers.read_text().splitlines()[1:]}
        for file in ("generic", "touching"):
            ids -= {json.loads(case)["id"] for case in (GOLDEN / "sphere_sphere" / f"{file}.jsonl").read_text().splitlines()[1:]}
        self.assertEqual(len(ids), 30)
        lines = [answer for answer in self.answers.read_text().splitlines(True) if json.loads(answer).get("id") not in sorted(ids)[:1]]
        self.answers.write_text("".join(lines))
        changed = copy.deepcopy(certificate)
        changed["answers"]["sha256"] = hashlib.sha256("".join(lines).encode()).hexdigest()
        changed["answers"]["count"] -= 1
        self.path.write_text(sealed(layout(changed, whole=True)))
        self.refuted("/found/fresh/total/answers/missing")

    def test_without_them_it_says_so(self):
        certificate = self.certify("golden/sphere_sphere/touching.jsonl")
        self.assertEqual(certificate["found"]["fresh"], {"each": 0, "none": "--fresh 0 left fresh ones out"})
        self.holds("On published questions alone: --fresh 0 left fresh ones out.")


class NotWritten(Case):
    def refuse(self, *args, words=(), code=2, **options):
        done = run("certify", *args, "--certificate", self.path, **options)
        self.assertEqual(done.returncode, code, done.stdout[-300:])
        for word in words:
            self.assertIn(word, done.stderr)
        self.assertEqual([path.name for path in self.folder.glob("c.*")], [])

    def test_runs_that_no_certificate_can_tell_of(self):
        one = "golden/sphere_sphere/touching.jsonl"
        self.refuse(words=["one engine's"])
        self.refuse(one, "--parts", self.folder / "parts", words=["a run in parts keeps no answers"])
        self.refuse(one, "--fail-fast", words=["--fail-fast"])
        self.refuse(one, "--max-time", 10, words=["--max-time"])
        self.refuse(one, "--record", self.path, words=["two files"])
        self.refuse(one, "--results", self.answers, "--record", self.folder / "r", words=["--record"])
        self.refuse(one, env={**os.environ, "SOURCE_DATE_EPOCH": "soon"}, words=["SOURCE_DATE_EPOCH"])
        self.refuse("golden/sphere_sphere/touching.jsonl", "--engine-command", "python3 -c pass", code=3)
        self.refuse(one, "--engine", "plain-float", words=["no case was judged"])

    def test_a_place_that_cannot_be_written_is_refused_before_the_work(self):
        done = run("certify", GOLDEN, "--certificate", self.folder / "none" / "c.json")
        self.assertEqual((done.returncode, done.stdout), (2, ""))

    def test_a_name_that_it_cannot_state_is_refused_before_the_work(self):
        name = os.fsdecode(b"\xff")
        (self.folder / name).mkdir()
        inside, within = self.folder / f"{name}.jsonl", self.folder / name / "d.jsonl"
        for path in (inside, within):
            shutil.copy(GOLDEN / "sphere_sphere" / "touching.jsonl", path)
        recorded = self.folder / f"{name}.answers.jsonl"
        one = "golden/sphere_sphere/touching.jsonl"
        self.assertEqual(run("certify", one, "--fresh", 0, "--engine", "production", "--record", recorded).returncode, 0)
        engine = self.folder / name / "engine.py"
        shutil.copy(PLAIN, engine)
        for args, options in ((("--engine", "production", inside), {}), (("--engine", "production", within), {}), ((one, "--results", recorded), {}),
                              ((GOLDEN / "sphere_sphere" / "touching.jsonl", "--engine-command", "python3 engine.py"), {"cwd": self.folder / name})):
            with self.subTest(args):
                done = run("certify", *args, "--fresh", 0, "--certificate", self.path, **options)
                self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
                self.assertIn("is not UTF-8, so no certificate can state it", done.stderr)
                self.assertEqual(list(self.folder.glob("c.*")), [])
        # A certificate sees its files from where it lies.
        self.path = self.folder / name / "c.json"
        self.certify("--engine", "production", within, "--fresh", 0)
        self.holds()

    def test_an_engine_that_answers_one_question_in_two_ways(self):
        engine = self.folder / "engine.py"
        engine.write_text(PLAIN.read_text().replace(
            "        reply = {\"op\"", "        message['alarm'] += int(message['seq']) * 1e-3\n        reply = {\"op\""))
        twice = self.folder / "twice.jsonl"
        shutil.copy(GOLDEN / "sphere_sphere" / "touching.jsonl", twice)
        self.refuse(twice, "golden/sphere_sphere/touching.jsonl", "--engine-command", f"python3 {engine}",
                    words=["one question, two answers"])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
