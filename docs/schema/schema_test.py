#!/usr/bin/env python3
"""Do the schemas say what the program reads and writes?  python3 docs/schema/schema_test.py PATH_TO_TOOL"""
import copy
import functools
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tool"))
from published import published  # noqa: E402

try:
    from jsonschema import Draft202012Validator
except ImportError:
    system = "/usr/bin/python3"  # where Debian's package is, whatever Python comes first here
    if "--again" not in sys.argv and os.path.exists(system):
        os.execv(system, [system, *sys.argv, "--again"])
    sys.exit("the schemas cannot be checked: install python3-jsonschema, version 4.0 or newer, which knows draft 2020-12")

TOOL = os.path.abspath(sys.argv[1]) if len(sys.argv) > 1 else sys.exit(__doc__)
SCHEMAS = Path(__file__).resolve().parent
ROOT = SCHEMAS.parent.parent
GOLDEN = ROOT / "golden"
SHAPES = {"any two convex shapes": "convex", "spheres": "sphere_rigid_sphere", "cubes": "cube_cube", "sphere and cube": "sphere_cube",
          "sphere and capsule": "sphere_capsule", "capsules": "capsule_capsule",
          "sphere and triangle": "sphere_triangle", "ray and sphere": "ray_sphere",
          "sphere and plane": "sphere_plane", "capsule and plane": "capsule_plane",
          "ray and triangle": "ray_triangle", "triangle and line": "triangle_line",
          **{f"cast ray and {shape}": f"cast_{shape}" for shape in ("sphere", "cube", "capsule", "triangle", "plane")}}
COMMON = json.loads((SCHEMAS / "common.json").read_text())["$defs"]


@functools.cache
def validator(reference):
    """Of a schema, or of a part of it such as dataset.json#/$defs/header."""
    schema = {"$ref": f"{SCHEMAS.as_uri()}/{reference}"}
    try:
        from referencing import Registry, Resource
    except ImportError:  # before jsonschema 4.18
        return Draft202012Validator(schema)
    resources = [(path.as_uri(), Resource.from_contents(json.loads(path.read_text()))) for path in SCHEMAS.glob("*.json")]
    return Draft202012Validator(schema, registry=Registry().with_resources(resources).crawl())


def run(*args, **options):
    return subprocess.run([TOOL, *published(args)], capture_output=True, text=True, timeout=600, cwd=ROOT, **options)


def refuted(*args):
    done = run(*args)
    if done.returncode != 1:
        raise AssertionError(f"exit status {done.returncode}, and 1 was expected: {args}\n{done.stderr}")


def lines_of(path):
    return [json.loads(line) for line in path.read_text().splitlines()]


def form_of(value):
    """Keys and kinds of values, of strings whether they are digits, names or words for numbers."""
    if isinstance(value, dict):
        return tuple((key, form_of(one)) for key, one in value.items())
    if isinstance(value, list):
        return tuple(map(form_of, value))
    if isinstance(value, str):
        return re.sub("-?0x[0-9a-f]+p-?[0-9]+|[0-9a-f]+", "0", value)
    return "truth" if isinstance(value, bool) else "nothing" if value is None else "number"


class Case(unittest.TestCase):
    maxDiff = 2000

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def valid(self, reference, *values):
        check = validator(reference)
        for value in values:
            for error in check.iter_errors(value):
                self.fail(f"{reference}: {error.json_path}: {error.message}\n{json.dumps(value)[:400]}")

    def lines_valid(self, schema, path, part="case", most=None, step=1):
        """The header and all lines, or one in `step`; of a file that one program wrote, so many of a form show the same."""
        header, *lines = path.read_text().splitlines()
        header, lines = json.loads(header), list(map(json.loads, lines[::step]))
        self.valid(f"{schema}#/$defs/header", header)
        forms = {}
        for one in lines:
            forms.setdefault(form_of(one), []).append(one)
        self.valid(f"{schema}#/$defs/{part}", *(one for alike in forms.values() for one in alike[:most]))
        self.valid(schema, header, *lines[:1])  # the schema itself tells the header from the others


class Accepted(Case):
    def test_the_schemas_are_schemas_of_draft_2020_12(self):
        for path in SCHEMAS.glob("*.json"):
            schema = json.loads(path.read_text())
            self.assertEqual(schema["$schema"], "https://json-schema.org/draft/2020-12/schema")
            Draft202012Validator.check_schema(schema)

    def test_every_reference_leads_somewhere(self):
        for path in SCHEMAS.glob("*.json"):
            for reference in re.findall(r'"\$ref": "([^"]*)"', path.read_text()):
                file, _, name = reference.partition("#/$defs/")
                self.assertIn(name, json.loads((SCHEMAS / (file or path.name)).read_text())["$defs"], reference)

    def test_every_committed_file_is_valid(self, most=1, step=16):
        datasets = results = 0
        for path in sorted(GOLDEN.rglob("*.jsonl")):
            with self.subTest(path.name):
                if "recorded" in path.parts:
                    self.lines_valid("results.json", path, "answer", most, step)
                    results += 1
                else:
                    self.lines_valid("dataset.json", path, "case", most, step)
                    datasets += 1
        self.assertTrue(datasets > 60 and results == 4, (datasets, results))
        for name in ("manifest.json", "adequacy.json"):
            self.valid(name, json.loads((GOLDEN / name).read_text()))

    def test_what_the_program_makes_of_every_family_is_valid(self):
        self.assertEqual(run("generate", "--all", self.folder / "set", "--count", 1, "--seed", 2**64 - 1).returncode, 0)
        shard = ("--family", "flat", "--pair", "cube_cube", "--count", 7, "--seed", 1, "--shard", "1/2", "-o", self.folder / "shard.jsonl")
        self.assertEqual(run("generate", *shard).returncode, 0)
        made = list(self.folder.rglob("*.jsonl"))
        self.assertGreater(len(made), 400)
        for path in made:
            self.lines_valid("dataset.json", path, most=1)
        self.assertEqual(run("lint", "--generated", "--write-manifest", self.folder).returncode, 0)
        self.valid("manifest.json", json.loads((self.folder / "manifest.json").read_text()))

    def few(self):
        """Questions of both scalars and of every outcome, and few: each failure is a line of a report."""
        made = []
        for name in ("coincident", "invalid", "touching.f32", "upstream"):
            header, *cases = (GOLDEN / "sphere_sphere" / f"{name}.jsonl").read_text().splitlines()
            made.append(self.folder / f"{name}.jsonl")
            made[-1].write_text("\n".join([re.sub(r'"count":\d+', '"count":24', header), *cases[:24], ""]))
        return made

    def test_reports_are_valid_whatever_the_verdict(self):
        report, older, few = self.folder / "report.json", self.folder / "older.json", self.few()
        table = {
            "production": (0, ["--engine", "production"]),
            "refuted": (1, ["--engine", "plain-double", "--level", "correctly-rounded"]),
            "binary32": (1, ["--engine", "plain-float"]),
            "another convention": (1, ["--engine", "published"]),
            "ended early": (1, ["--engine", "plain-double", "--fail-fast"]),
            "outside the domain": (1, ["--engine", "plain-double", "--family", "invalid"]),
            "recorded": (1, ["--results", GOLDEN / "recorded" / "sofa-2a278d8" / "sphere_sphere.jsonl"]),
            "a tolerance": (1, ["--engine", "plain-double", "--tolerance", "relative=1e-9,max=1e9"]),
            "asked again": (0, ["--engine", "production", "--determinism"]),
            "other bits": (1, ["--engine", "unsteady:order", "--determinism"]),
        }
        for name, (code, options) in table.items():
            with self.subTest(name):
                done = run("certify", *few, *options, "--json", report)
                self.assertEqual(done.returncode, code, done.stderr)
                self.valid("report.json", json.loads(report.read_text()))
                self.assertEqual("determinism" in json.loads(report.read_text()), "--determinism" in options)
        refuted("certify", *few, "--engine", "plain-double", "--json", older)
        done = run("certify", *few, "--engine", "plain-double", "--baseline", older, "--json", report)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("baseline", json.loads(report.read_text()))
        self.valid("report.json", json.loads(report.read_text()))

    def test_certificates_are_valid_whatever_the_engine(self):
        path, known, few = self.folder / "certificate.json", self.folder / "known.json", self.few()
        one = GOLDEN / "sphere_sphere" / "touching.jsonl"
        refuted("certify", one, "--engine", "plain-double", "--json", known)
        plain = f"{sys.executable} {ROOT / 'docs' / 'examples' / 'engines' / 'plain.py'}"
        table = {
            "production": (0, [*few, GOLDEN / "cube_cube" / "flat.jsonl", "--engine", "production"]),
            "binary32, and much left out": (1, [*few, "--engine", "plain-float"]),
            "a command": (1, [*few, "--engine-command", plain]),
            "recorded": (1, [*few, "--results", GOLDEN / "recorded" / "sofa-2a278d8" / "sphere_sphere.jsonl"]),
            "generated": (0, ["--generate", 3, "--seed", 2**64 - 1]),
            "a tolerance": (0, [one, "--engine", "production", "--tolerance", "length=1e-9,max=1e9"]),
            "asked again": (0, [one, "--engine", "production", "--determinism"]),
            "accepted": (0, [one, "--engine", "plain-double", "--baseline", known, "--accept-reason", "known",
                             "--accept-until", "2999-12-31"]),
        }
        for name, (code, options) in table.items():
            with self.subTest(name):
                done = run("certify", *options, "--certificate", path)
                self.assertEqual(done.returncode, code, done.stderr)
                self.valid("certificate.json", json.loads(path.read_text()))
        self.assertTrue(json.loads(path.read_text())["accepted"])

    def exam(self, *options):
        """An exam, its key before and after it is closed, and its certificate."""
        exam, key, answers, certificate = (self.folder / name for name in ("exam.jsonl", "key.json", "answers.jsonl", "c.json"))
        keys = []
        for args in (["new", "-o", exam, "--key", key, "--count", 2, *options], ["take", exam, "-o", answers, "--engine", "production"],
                     ["close", "--key", key, "--results", answers, "--certificate", certificate]):
            done = run("exam", *args)
            self.assertEqual(done.returncode, 0, done.stderr + done.stdout[-500:])
            keys.append(json.loads(key.read_text()))
        return exam, keys, json.loads(certificate.read_text())

    def test_exams_and_their_keys_and_certificates_are_valid(self):
        for options in ([], ["--profile", "game", "--pair", "sphere_cube"]):
            exam, keys, certificate = self.exam(*options)
            self.lines_valid("exam.json", exam, "question")
            self.valid("exam-key.json", *keys)
            self.assertEqual([key["used"] is None for key in keys], [True, True, False])
            self.valid("certificate.json", certificate)
            self.assertIn("exam", certificate)
            (self.folder / "key.json").unlink()

    def test_both_sides_of_the_protocol_are_valid(self):
        recording = self.folder / "questions.jsonl"
        script = f"import sys, subprocess; p = subprocess.Popen([{TOOL!r}, 'serve'], stdin=subprocess.PIPE, text=True)\n" \
                 f"with open({str(recording)!r}, 'w') as copy:\n" \
                 " for line in sys.stdin: copy.write(line); copy.flush(); p.stdin.write(line); p.stdin.flush()"
        engine = self.folder / "engine.py"
        engine.write_text(script)
        done = run("certify", GOLDEN / "quick", "--family", "quick,invalid", "--engine-command", f"{sys.executable} {engine}")
        self.assertEqual(done.returncode, 0, done.stderr + done.stdout[-500:])
        asked = lines_of(recording)
        self.assertTrue({"hello", "query"} <= {message["op"] for message in asked})
        self.valid("protocol.json#/$defs/host", *asked)
        answered = run("serve", input=recording.read_text())
        said = [json.loads(line) for line in answered.stdout.splitlines()]
        self.assertTrue(any("rejected" in message for message in said))
        self.valid("protocol.json#/$defs/engine", *said)
        self.valid("protocol.json", *asked[:5], *said[:5])


class EveryLineCampaign(Case):
    """The lines of committed files whose form is that of another."""

    def test_every_line_of_every_committed_file_is_valid(self):
        Accepted.test_every_committed_file_is_valid(self, most=None, step=1)


class Names(Case):
    def test_families_and_flags_are_the_programs(self):
        listed = [json.loads(line) for line in run("families", "--json").stdout.splitlines()]
        for shapes, pair in SHAPES.items():
            name = {"spheres": "sphere", "cubes": "cube"}.get(shapes, pair) + "_family"
            self.assertEqual(COMMON[name]["enum"], [one["family"] for one in listed if one.get("shapes") == shapes])
        self.assertEqual(COMMON["flag"]["enum"], [one["flag"] for one in listed if "flag" in one])

    def test_pairs_and_shapes_are_the_programs(self):
        pairs = [json.loads(line) for line in run("pairs", "--json").stdout.splitlines()]
        self.assertEqual(COMMON["pair"]["enum"], [one["pair"] for one in pairs])
        kinds = {"point": "vector", "points": "three_vectors", "direction": "vector", "length": "length",
                 "offset": "number", "orientation": "quaternion", "lengths": "lengths"}
        any_kinds = {"point": "any_vector", "points": "any_three_vectors", "direction": "any_vector", "length": "any_number",
                     "offset": "any_number", "orientation": "any_quaternion", "lengths": "any_vector"}
        shapes = {shape["shape"]: shape["fields"] for one in pairs for shape in (one["a"], one["b"])}
        self.assertIn("sphere", shapes)
        for name, fields in shapes.items():
            for prefix, kind in (("", kinds), ("any_", any_kinds)):
                if name == "hull":
                    kind = {**kind, "points": prefix + "vertices"}
                schema = COMMON[prefix + name]
                self.assertEqual(schema["required"], list(fields))
                self.assertEqual({key: value["$ref"].rsplit("/")[-1] for key, value in schema["properties"].items()},
                                 {key: kind[value] for key, value in fields.items()})

    def test_pairs_and_conventions_are_those_of_production(self):
        hello = json.loads(run("serve", input='{"op":"hello","protocol":1}\n{"op":"stop"}\n').stdout.splitlines()[0])
        self.assertEqual(COMMON["pair"]["enum"], hello["pairs"])
        conventions = COMMON["conventions"]["properties"]
        self.assertEqual({*conventions} - {"scale", "most_points"}, {*hello["conventions"]})
        for key, default in hello["conventions"].items():
            if isinstance(default, str):
                self.assertEqual(conventions[key]["enum"][0], default)
        self.assertEqual({*COMMON["bounds"]["properties"]}, {*hello["bounds"]})

    def test_the_program_knows_exactly_the_names_of_conventions_and_levels(self):
        answers = self.folder / "answers.jsonl"
        header = lines_of(GOLDEN / "recorded" / "sofa-2a278d8" / "cube_cube.jsonl")[0]
        for key, schema in COMMON["conventions"]["properties"].items():
            if "enum" not in schema:
                continue
            answers.write_text(json.dumps({**header, "conventions": {key: "nonesuch"}}) + "\n")
            done = run("certify", GOLDEN / "cube_cube" / "flat.jsonl", "--results", answers)
            self.assertIn("expected one of " + ", ".join(schema["enum"]) + ", got", done.stderr)
        answers.write_text(json.dumps({**header, "rounds": ["nonesuch"]}) + "\n")
        done = run("certify", GOLDEN / "cube_cube" / "flat.jsonl", "--results", answers)
        self.assertIn("expected one of " + ", ".join(COMMON["rounds"]["items"]["enum"]) + ", got", done.stderr)
        done = run("certify", GOLDEN / "cube_cube" / "flat.jsonl", "--level", "nonesuch")
        for level in COMMON["level"]["enum"][:-1]:
            self.assertIn(level, done.stderr)


class Refused(Case):
    def check(self, reference, value, table):
        self.valid(reference, value)
        check = validator(reference)
        for name, (path, new) in table.items():
            with self.subTest(f"{reference}: {name}"):
                wrong = copy.deepcopy(value)
                *outer, last = path
                place = wrong
                for key in outer:
                    place = place[key]
                if new is None:
                    del place[last]
                else:
                    place[last] = new
                self.assertFalse(check.is_valid(wrong), json.dumps(wrong)[:400])

    def test_typical_mistakes_in_datasets(self):
        header, *cases = lines_of(GOLDEN / "sphere_sphere" / "alarm_edge.jsonl")
        self.check("dataset.json", header, {
            "format": (["format"], "contact-oracle/data"), "version": (["version"], 2), "pair": (["pair"], "cone_cone"),
            "scalar": (["scalar"], "half"), "count as text": (["count"], "7"), "negative count": (["count"], -1),
            "fraction of a count": (["count"], 1.5), "seed missing": (["seed"], None), "points": (["points"], "center"),
            "unknown key": (["colour"], 7), "shard of one": (["shard"], [1]),
        })
        hit = next(case for case in cases if case["expect"]["hit"])
        miss = next(case for case in cases if not case["expect"]["hit"])
        for reference in ("dataset.json", "dataset.json#/$defs/case"):
            self.check(reference, hit, {
                "short id": (["id"], hit["id"][:-1]), "capital id": (["id"], "A" * 24), "id missing": (["id"], None),
                "two coordinates": (["a", "center"], [1, 2]), "negative radius": (["b", "radius"], -1),
                "NaN": (["a", "center", 0], "NaN"), "text for a number": (["alarm"], "0"), "infinite": (["contact"], "Infinity"),
                "unknown flag": (["flags"], ["Shiny"]), "a flag twice": (["flags"], ["Touching", "Touching"]),
                "flag Invalid": (["flags"], ["Invalid"]), "flags missing": (["flags"], None), "hit as number": (["expect", "hit"], 1),
                "a miss with a contact": (["expect", "hit"], False), "value missing": (["expect", "value"], None),
                "NaN expected": (["expect", "value"], "NaN"), "long normal": (["expect", "normal"], [2, 0, 0]),
                "infinite normal": (["expect", "normal", 0], "Infinity"), "degenerate": (["expect", "degenerate"], "no"),
                "even mantissa": (["exact", "distance2"], "0x8p0"), "capital digits": (["exact", "reach"], "0xABp0"),
                "leading zero": (["exact", "reach"], "0x01p0"), "negative zero": (["exact", "reach"], "-0x0p0"),
                "positive sign": (["exact", "reach"], "0x1p+1"), "zero with an exponent": (["exact", "reach"], "0x0p1"),
                "number for text": (["exact", "reach"], 3), "exact missing": (["exact"], None), "gap": (["exact", "gap"], []),
                "unknown key": (["colour"], 7), "unknown inner key": (["a", "mass"], 7), "box before a ball": (["a"], {
                    "min": [0, 0, 0], "max": [1, 1, 1]}), "half-space first": (["a"], {"normal": [0, 0, 1], "offset": 0}),
            })
        self.check("dataset.json", miss, {"a contact": (["expect", "value"], 1), "hit": (["expect", "hit"], True)})
        cubes = lines_of(GOLDEN / "cube_cube" / "touching.jsonl")[1]
        self.check("dataset.json", cubes, {
            "two gaps": (["exact", "gap"], ["0x0p0"] * 2), "a gap no text": (["exact", "gap", 0], 0),
            "reach": (["exact", "reach"], "0x0p0"),
            "a contact": (["expect", "value"], 1), "radius": (["a", "radius"], 1), "max missing": (["b", "max"], None),
        })
        invalid = lines_of(GOLDEN / "sphere_sphere" / "invalid.jsonl")[1]
        self.check("dataset.json", invalid, {
            "unknown field": (["expect", "rejected"], "a.mass"), "answered": (["expect", "hit"], True), "flags": (["flags"], []),
            "other text": (["a", "center", 0], "nan"), "a witness": (["exact"], {}), "no text": (["expect", "rejected"], 1),
        })

    def test_typical_mistakes_in_results(self):
        header, *answers = lines_of(GOLDEN / "recorded" / "sofa-2a278d8" / "sphere_sphere.jsonl")
        self.valid("results.json", {**header, "conventions": {"scale": {"min": 0, "max": "Infinity"}}, "bounds": {"value": 1.5},
                                     "pair_conventions": {"sphere_cube": {"points": "midpoint"}}})
        self.check("results.json", {**header, "bounds": {"value": 8}, "pair_conventions": {}}, {
            "pair": (["pair_conventions", "cone_cone"], {}), "a pair's convention": (["pair_conventions", "cube_cube"], {"points": "centre"}),
            "engine": (["engine"], "SOFA"), "version": (["engine", "version"], None), "pairs": (["pairs"], ["cone_cone"]),
            "convention": (["conventions", "points"], "centre"), "unknown convention": (["conventions", "colour"], "red"),
            "unit as text": (["conventions", "normal_unit"], "true"), "bound too small": (["bounds", "value"], 0.5),
            "bound too large": (["bounds", "value"], 65), "unknown bound": (["bounds", "point1"], 8),
            "scale without max": (["conventions", "scale"], {"min": 0}), "scalar missing": (["scalar"], None),
        })
        self.check("results.json", {**header, "rounds": ["orientation"]}, {"unknown rounding": (["rounds", 0], "radius")})
        self.check("results.json", {**header, "tolerance": {"length": 1e-6, "relative": 0, "angle": 1e-3, "scale": {"min": 0, "max": 9}}}, {
            "negative length": (["tolerance", "length"], -1), "more than half a turn": (["tolerance", "angle"], 3.2),
            "unknown measure": (["tolerance", "width"], 1), "infinite": (["tolerance", "relative"], "Infinity"),
            "half a scale": (["tolerance", "scale"], {"min": 0})})
        hit = next(answer for answer in answers if answer.get("contact"))
        self.valid("results.json", *({"id": hit["id"], **says} for says in (
            {"overlap": True}, {"contact": None}, {"contact": {}}, {"unsupported": "why"}, {"rejected": "alarm"}, {"error": "text"})))
        self.check("results.json", hit, {
            "overlap as number": (["overlap"], 1), "unknown key": (["hit"], True), "contact as text": (["contact"], "none"),
            "unknown field": (["contact", "depth"], 1), "short normal": (["contact", "normal"], [1, 0]),
            "value as text": (["contact", "value"], "1"), "a claim and an error": (["error"], "text"),
            "a claim and unsupported": (["unsupported"], "why"), "id missing": (["id"], None), "id": (["id"], "1"),
        })
        self.check("results.json", {"id": hit["id"], "error": "text"}, {
            "two reasons": (["rejected"], "alarm"), "a reason and a claim": (["overlap"], True), "no text": (["error"], 7)})

    def test_typical_mistakes_in_messages(self):
        question = {"op": "query", "seq": 1, "pair": "sphere_sphere", "a": {"center": [0, 0, "NaN"], "radius": -1},
                    "b": {"center": [0, 0, 0], "radius": 1}, "alarm": 0, "contact": 0}
        self.check("protocol.json#/$defs/host", question, {
            "op": (["op"], "ask"), "seq": (["seq"], -1), "seq as text": (["seq"], "1"), "pair missing": (["pair"], None),
            "unknown key": (["id"], "1"), "shape of another pair": (["pair"], "cube_cube"), "no number": (["alarm"], True)})
        self.check("protocol.json#/$defs/host", {"op": "hello", "protocol": 1}, {
            "another version": (["protocol"], 2), "version missing": (["protocol"], None), "unknown key": (["name"], "x")})
        self.check("protocol.json#/$defs/host", {"op": "stop"}, {"unknown key": (["now"], True), "op": (["op"], "halt")})
        hello = json.loads(run("serve", input='{"op":"hello","protocol":1}\n{"op":"stop"}\n').stdout.splitlines()[0])
        self.check("protocol.json#/$defs/engine", hello, {
            "another version": (["protocol"], 2), "engine": (["engine", "name"], None), "pairs": (["pairs"], "cube_cube"),
            "scalar": (["scalar"], "double"), "unknown key": (["speed"], 7), "bound": (["bounds", "normal"], 0)})
        self.check("protocol.json#/$defs/engine", {"op": "answer", "seq": 1, "overlap": True, "contact": None}, {
            "seq missing": (["seq"], None), "op": (["op"], "reply"), "unknown key": (["hit"], True),
            "a claim and an error": (["error"], "text"), "overlap": (["overlap"], "yes")})

    def test_typical_mistakes_in_a_manifest(self):
        manifest = json.loads((GOLDEN / "manifest.json").read_text())
        manifest["files"] = manifest["files"][:2]
        entry = ["files", 0]
        self.check("manifest.json", manifest, {
            "digest": ([*entry, "sha256"], "0" * 63), "flag": ([*entry, "flags", "Shiny"], 1),
            "no case of a flag": ([*entry, "flags", "Flat"], 0),
            "closest id": ([*entry, "closest"], {"value": {"log2_ulps": -9, "id": "1"}}),
            "closest field": ([*entry, "closest"], {"depth": {"log2_ulps": -9, "id": "0" * 24}}),
            "closest distance": ([*entry, "closest"], {"value": {"log2_ulps": 0, "id": "0" * 24}}),
            "family": ([*entry, "family"], "coincident"), "origin": ([*entry, "origin"], "found"), "hits": ([*entry, "hits"], None),
            "path": ([*entry, "path"], "x.json"), "unknown key": ([*entry, "colour"], 7), "version": (["version"], 2),
            "a file twice": (["files", 1], manifest["files"][0]), "negative kills": ([*entry, "kills"], -1),
            "digest of answers": ([*entry, "digests", "10000"], "0" * 63), "of no count": ([*entry, "digests", "many"], "0" * 64),
            "digests": ([*entry, "digests"], None)})

    def test_typical_mistakes_in_an_adequacy_file(self):
        adequacy = json.loads((GOLDEN / "adequacy.json").read_text())
        for key in ("files", "mutants", "families"):
            adequacy[key] = adequacy[key][:2]
        self.check("adequacy.json", adequacy, {
            "a kill twice": (["files", 0, "kills"], ["x", "x"]), "no digest": (["files", 0, "sha256"], None),
            "a mutant's name": (["mutants", 0, "id"], "mutant:x"), "kills": (["mutants", 0, "cases"], "1"),
            "one case that is not named": (["mutants", 0, "cases"], 1), "shapes": (["families", 0, "shapes"], "cones"),
            "unique": (["families", 0, "unique"], 7), "unknown key": (["colour"], 7)})

    def test_typical_mistakes_in_a_report(self):
        path = self.folder / "report.json"
        refuted("certify", GOLDEN / "sphere_sphere" / "coincident.jsonl", "--engine", "plain-double", "--json", path)
        report = json.loads(path.read_text())
        self.assertTrue(report["failures"] and report["worst"])
        self.check("report.json", report, {
            "format": (["format"], "contact-oracle/results"), "level": (["required"], "none"), "certified": (["certified"], "yes"),
            "verdict": (["verdict"], None), "total": (["total", "cases"], -1), "family": (["families", 0, "pair"], None),
            "answers": (["total", "answers", "missing"], None), "unknown field": (["total", "fields", "depth"], {}),
            "grade": (["total", "fields", "value", "faithful"], None), "id": (["failures", 0, "id"], "x"),
            "accepted": (["failures", 0, "accepted"], "no"), "level of a failure": (["failures", 0, "level"], "good"),
            "half a question": (["failures", 0, "b"], None), "no shape": (["failures", 0, "a"], {"radius": 1}),
            "query": (["worst", 0, "query", "alarm"], None), "claimed and not": (["worst", 0, "claimed", "error"], "text"),
            "nothing right": (["worst", 0, "right"], None), "bound": (["bounds", "value"], 0.5),
            "power": (["total", "fields", "value", "errors"], [[65, 1]]), "no error": (["total", "fields", "value", "errors"], [[1, 0]]),
            "side": (["total", "margins", 0, 0], 2), "half a margin": (["total", "margins", 0], [0, 0, 1]), "count": (["failure_count"], "1"),
            "scalar": (["scalar"], "double"), "conventions": (["conventions", "colour"], 7)})
        self.valid("report.json", {**report, "added": 7})

    def test_typical_mistakes_in_a_certificate(self):
        path, known = self.folder / "certificate.json", self.folder / "known.json"
        options = [GOLDEN / "sphere_sphere" / "touching.jsonl", "--engine", "plain-double"]
        refuted("certify", *options, "--json", known)
        done = run("certify", *options, "--baseline", known, "--accept-reason", "known", "--accept-until", "2999-12-31",
                   "--certificate", path)
        self.assertEqual(done.returncode, 0, done.stderr)
        source, family = ["questions", "sources", 0], ["found", "families", 0]
        self.check("certificate.json", json.loads(path.read_text()), {
            "format": (["format"], "contact-oracle/report"), "digest": (["sha256"], "0" * 63), "day": (["issued"], "today"),
            "unknown key": (["colour"], 7), "rounding": (["environment", "rounding"], "up"), "environment": (["environment"], None),
            "stage": (["oracle", "decided", "guess"], 1), "kind": (["engine", "kind"], "magic"),
            "a command of none": (["engine", "command"], "python3"), "a file without a name": (["engine", "files", 0], {"sha256": "0" * 64}),
            "no source": (["questions", "sources"], []), "a seed of a dataset": ([*source, "seed"], 7),
            "digest of a dataset": ([*source, "sha256"], None), "digest of questions": ([*source, "questions"], None),
            "answers": (["answers", "sha256"], None), "required": (["found", "required"], "none"), "share": (["found", "share_judged"], 1),
            "grade": ([*family, "fields", "value", "grade"], "good"), "level": ([*family, "level"], None),
            "unknown count": ([*family, "colour"], 7), "crashes": (["found", "total", "answers", "crash"], 0),
            "no reason": (["accepted", 0, "reason"], ""), "no day": (["accepted", 0, "expires"], None)})

    def test_typical_mistakes_in_an_exam_its_key_and_its_certificate(self):
        exam, keys, certificate = Accepted.exam(self, "--pair", "sphere_sphere", "--family", "generic")
        header, question, _ = lines_of(exam)
        self.check("exam.json", header, {
            "format": (["format"], "contact-oracle/dataset"), "count": (["count"], -1), "digest": (["questions"], "0" * 63),
            "no commitment": (["commitment"], None), "a family": (["family"], "generic")})
        self.check("exam.json", question, {
            "an answer": (["expect"], {"hit": False}), "no pair": (["pair"], None), "id": (["id"], "1"), "negative alarm": (["alarm"], -1),
            "no number": (["a", "radius"], "NaN"), "flags": (["flags"], [])})
        self.check("exam-key.json", keys[-1], {
            "seed": (["seed"], -1), "short nonce": (["nonce"], "0" * 63), "profile": (["profile"], "sport"), "no source": (["sources"], []),
            "no question": (["sources", 0, "count"], 0), "outside the domain": (["sources", 0, "family"], "invalid"),
            "day": (["used", "on"], "today"), "no digest of answers": (["used", "answers"], None), "not said": (["used"], None),
            "unknown key": (["colour"], 7)})
        self.check("certificate.json", certificate, {
            "no nonce": (["exam", "nonce"], None), "digest": (["exam", "questions"], "x"), "seed": (["exam", "seed"], 7)})

    def test_typical_mistakes_in_what_came_of_asking_again(self):
        path = self.folder / "report.json"
        refuted("certify", self.FEW_QUESTIONS, "--engine", "unsteady:order", "--determinism", "--json", path)
        report = json.loads(path.read_text())
        different = next(i for i, way in enumerate(report["determinism"]["ways"]) if way["differ"])
        same = next(i for i, way in enumerate(report["determinism"]["ways"]) if not way["differ"])
        way, source = ["determinism", "ways", different], ["determinism", "sources", 0]
        self.check("report.json", report, {
            "no question": ([*way, "question"], None), "no answer": ([*way, "now"], None), "half an id": ([*source, "each"], "0" * 31),
            "a question of the same": (["determinism", "ways", same, "question"], report["determinism"]["ways"][different]["question"]),
            "digest": (["determinism", "sha256"], None), "count": ([*source, "answers"], -1)})

    FEW_QUESTIONS = GOLDEN / "sphere_sphere" / "touching.jsonl"


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(word for word in sys.argv[2:] if word != "--again")])
