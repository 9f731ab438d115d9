#!/usr/bin/env python3
"""Nothing that a file, an engine or a command line says commands a terminal or a log, forges a line or becomes markup:
python3 tool/foreign_text_test.py PATH_TO_TOOL [unittest arguments].

One text, made of all of NASTY, is put into every field of every format, and every output is read."""
import html.parser
import json
import re
import unicodedata
import unittest
import zipfile
import xml.etree.ElementTree as ElementTree

import certificate_test
import cli_test
from cli_test import ROOT, SPHERES, TOOL, answers_to, committed, line, run, text

# What is wrong with each is said by its name; that of lines comes first, where a field begins a line.
NASTY = {
    "a command of GitHub's runner": "::error::forged", "one in a new line": "\n::stop-commands::forged", "behind spaces": "\n \u3000\t::error::forged",
    "its older form": " ##[error]forged", "Azure's": "##vso[task.complete result=Succeeded]", "GitLab's": "\x1b[0Ksection_start:1:forged\r\x1b[0K",
    "a verdict": "\n\nHOLDS: forged\nCERTIFIED: forged\n", "a verdict over the line": "\rCERTIFIED: forged", "colour": "\x1b[32m", "a title": "\x1b]0;forged\x07",
    "the second control characters": "\u009b32m", "next line": "\u0085CERTIFIED: forged", "line separator": "\u2028CERTIFIED: forged",
    "paragraph separator": "\u2029CERTIFIED: forged", "vertical tab": "\vCERTIFIED: forged", "form feed": "\fCERTIFIED: forged",
    "right to left": "\u202egnorw", "isolate": "\u2066x", "marks": "\u200e\u200f\u061c", "byte order": "\ufeff", "invisible": "\u200b\u2060\u00ad\U000e0041",
    "backspace": "\b", "delete": "\x7f", "NUL": "\0", "bell": "\x07", "tab": "\t", "no character": "\ufffe\uffff", "C's": "%s%n{}{0}",
    "an element": "<script>alert(1)</script><b>", "an attribute": "\" onmouseover=\"alert(1)", "another": "' onmouseover='alert(1)", "an entity": "&lt;&amp;&#10;&#27;",
    "CDATA": "]]>", "a comment": "<!-- -->", "a link": "[x](http://forged) ![x](http://forged/x.png)", "an address": " https://forged www.forged.com",
    "a table": " | a | b |", "code": "``` `x`", "emphasis": "**x** __x__ ~~x~~", "a heading": "# x", "somebody": " @everyone", "a picture": ":white_check_mark:", "a formula": "$x$"}
TEXT = "".join(NASTY.values())
HARMLESS = "harmless"
SHOWN = "forged"  # what is seen of TEXT where it is printed
RUNNER = re.compile(r"^\s*::|##\[|##vso\[", re.M)
FORGED = re.compile(r"^[\W_]*(HOLDS|CERTIFIED): forged", re.M)
COLOURS = re.compile(r"\x1b\[(?:0|1|31|32)m")


def hidden(said):
    """By Unicode's own properties: controls, formats, separators of lines, and what is no character; but for the end of a line."""
    return sorted({f"U+{ord(c):04X}" for c in said if c != "\n" and (unicodedata.category(c) in ("Cc", "Cf", "Cs", "Zl", "Zp") or ord(c) & 0xFFFE == 0xFFFE)})


def put_everywhere(value, foreign, but=()):
    """A copy with every text another, but those under some keys; and how many that are."""
    if isinstance(value, str):
        return foreign, 1
    if isinstance(value, dict):
        parts = {key: (part, 0) if key in but else put_everywhere(part, foreign, but) for key, part in value.items()}
        return {key: part for key, (part, _) in parts.items()}, sum(count for _, count in parts.values())
    if isinstance(value, list):
        parts = [put_everywhere(part, foreign, but) for part in value]
        return [part for part, _ in parts], sum(count for _, count in parts)
    return value, 0


class Structure(html.parser.HTMLParser):
    """The tags of a page and the names of their attributes, and what its scripts hold."""
    def __init__(self, page):
        super().__init__()
        self.tags, self.scripts, self.inside = [], [], False
        self.feed(page)

    def handle_starttag(self, tag, attributes):
        self.tags.append((tag, *sorted(name for name, _ in attributes)))
        self.inside = dict(attributes).get("type") == "application/json"

    def handle_data(self, data):
        if self.inside:
            self.scripts.append(json.loads(data))
        self.inside = False


def markup(markdown):
    """What of Markdown is not text: marks without a backslash, pictures and calls by name."""
    markdown = re.sub(r"\\[^a-zA-Z0-9\s]|&#8203;", "\0", markdown)
    return re.findall(r"[`*_{}\[\]<>#|~&$]|!\[|@\w|:[\w+-]+:|https?://|www\.\w", re.sub(r"(?ms)^```\n.*?^```$", "", markdown))


class ForeignText(cli_test.Case):
    fields, outputs = {}, {}

    @classmethod
    def tearDownClass(cls):
        print(f"\n{len(NASTY)} nasty texts in {sum(cls.fields.values())} fields ({', '.join(f'{n} of {what}' for what, n in sorted(cls.fields.items()))}); "
              f"{sum(cls.outputs.values())} outputs read ({', '.join(f'{n} {what}' for what, n in sorted(cls.outputs.items()))})")

    def count(self, what, fields):
        self.fields[what] = self.fields.get(what, 0) + fields

    def clean(self, said, form):
        """Of any output: bytes of UTF-8 with nothing hidden in it, no command to a log, no forged line."""
        self.outputs[form] = self.outputs.get(form, 0) + 1
        said = said.decode() if isinstance(said, bytes) else said
        self.assertEqual(hidden(said.replace("\t", "") if form == "HTML" else said), [], form)  # the page's own scripts have tabs
        self.assertIsNone(FORGED.search(said), (form, said[:2000]))
        if form in ("terminal", "JSON"):
            self.assertIsNone(RUNNER.search(said), (form, said[:2000]))
        return said

    def said(self, *args, shows=True, codes=(0, 1, 2, 3), **options):
        """Runs it, reads what it says; `shows`: that the foreign text is there to be seen."""
        done = run(*args, text=False, **{"stdin": b"", **options})
        self.assertIn(done.returncode, codes, (done.stdout[-500:], done.stderr[-500:]))
        parts = [self.clean(COLOURS.sub("", part.decode()) if "--color=always" in args else part, "terminal") for part in (done.stdout, done.stderr) if part]
        if shows:
            self.assertIn(SHOWN, "".join(parts))
        if done.returncode == 2:
            self.assertRegex(parts[-1], r"\A[^\n]+\n(Run with [^\n]+\n)?\Z")
        return "".join(parts)

    def reports(self, *args, foreign, **options):
        """The files of a run with all reports, read each as what reads it reads it."""
        kinds = {"json": "json", "junit": "xml", "report": "html", "markdown": "md"}
        paths = {kind: self.folder / f"out.{end}" for kind, end in kinds.items()}
        self.said(*args, *(word for kind, path in paths.items() for word in (f"--{kind}", path)), shows=foreign == TEXT, **options)
        texts = {kind: path.read_bytes().decode() for kind, path in paths.items()}
        if foreign == TEXT:
            for kind, form in (("json", "JSON"), ("junit", "JUnit"), ("report", "HTML"), ("markdown", "Markdown")):
                self.assertIn(SHOWN, self.clean(texts[kind], form))
            self.assertEqual(hidden(json.dumps(json.loads(texts["json"]), ensure_ascii=False)), [])
            for script in Structure(texts["report"]).scripts:
                self.assertEqual(hidden(json.dumps(script, ensure_ascii=False)), [])
        return {"json": sorted(json.loads(texts["json"])), "junit": [(one.tag, sorted(one.attrib)) for one in ElementTree.fromstring(texts["junit"]).iter()],
                "report": Structure(texts["report"]).tags, "markdown": markup(texts["markdown"])}

    def alike(self, of):
        """A harmless text and the nasty one give the same tags, attributes and marks."""
        nasty, harmless = of(TEXT), of(HARMLESS)
        for form in nasty:
            with self.subTest(form):
                self.assertEqual(nasty[form], harmless[form])

    CASES = committed("sphere_sphere/touching.jsonl", count=8)

    def dataset(self, foreign, name="d.jsonl"):
        return self.file(name, [{**self.CASES[0], "family": foreign, "generator": foreign}, *self.CASES[1:]])

    def answers(self, foreign):
        header, *answers = answers_to(self.CASES, engine={"name": foreign, "version": foreign})
        said = [{"id": answers[i]["id"], key: foreign} for i, key in enumerate(("unsupported", "rejected", "error"))]
        return self.file("answers.jsonl", [header, *said, *answers[3:]])

    def engine(self):
        """An engine that misbehaves as its first argument says; without one it answers, under a nasty name."""
        program = self.folder / "engine.py"
        program.write_text(f"""import json, sys
TEXT = {TEXT!r}
mode = sys.argv[1] if sys.argv[1:] else ""
hello = {{"op": "hello", "protocol": 1, "engine": {{"name": TEXT, "version": TEXT}}, "scalar": "binary64", "pairs": ["sphere_sphere"]}}
for line in sys.stdin:
    message = json.loads(line)
    if message["op"] == "hello":
        print(json.dumps(hello | ({{TEXT: 1}} if mode == "key" else {{}})) if mode != "noise" else TEXT.replace(chr(10), ""), flush=True)
        if mode == "dies":
            sys.stderr.write(TEXT.replace(chr(10), ""))
            sys.exit(1)
    elif message["op"] == "query":
        right = {{"overlap": True, "contact": None}}
        wrong = {{"error": {{"error": TEXT}}, "answer": {{TEXT: 1}}, "op": {{"op": TEXT}}}}.get(mode, right)
        print(json.dumps({{"op": "answer", "seq": message["seq"], **(right if message["seq"] == 1 else wrong)}}), flush=True)
""")
        return program

    ENGINE = {"env": {"PATH": "/usr/bin:/bin", "PYTHONIOENCODING": "utf-8"}}

    def test_the_table_is_nasty(self):
        self.assertEqual([name for name, nasty in NASTY.items() if nasty in HARMLESS], [])
        self.assertTrue(RUNNER.search(TEXT) and FORGED.search(TEXT) and len(hidden(TEXT)) > 20, hidden(TEXT))

    def test_a_dataset_and_recorded_answers(self):
        self.count("datasets", 2)
        self.count("results", 5)
        self.alike(lambda foreign: self.reports("certify", self.dataset(foreign), "--results", self.answers(foreign), "--color=always", foreign=foreign))
        answers, dataset = self.answers(TEXT), self.dataset(TEXT)
        self.assertIn(SHOWN, self.clean(run("certify", dataset, "--results", answers, "--json", text=False, stdin=b"").stdout, "JSON"))
        self.said("lint", dataset, shows=False, codes=(2,))
        for i in range(2):
            self.said("certify", dataset, "--results", answers, "--shard", f"{i}/2", "--parts", self.folder / "parts", shows=False, codes=(0, 1))
        self.said("merge", self.folder / "parts")

    def test_columns(self):
        columns, changed = self.folder / "columns.npz", self.folder / "changed.npz"
        self.said("convert", self.dataset("known"), "-o", columns, shows=False, codes=(0,))
        with zipfile.ZipFile(columns) as file:
            members = {name: file.read(name) for name in file.namelist()}
        size = int.from_bytes(members["header.npy"][8:10], "little")
        header = json.loads(members["header.npy"][10 + size:].decode().rstrip("\0"))
        for wrong in (header | {TEXT: TEXT}, *(header | {key: TEXT} for key in ("family", "generator", "pair", "sha256", "columns_sha256"))):
            self.count("columns", 1)
            said = line(wrong).encode()
            about = f"{{'descr': '|S{len(said)}', 'fortran_order': False, 'shape': (), }}".encode()
            with zipfile.ZipFile(changed, "w") as file:
                for name, content in members.items():
                    file.writestr(name, b"\x93NUMPY\x01\x00" + len(about).to_bytes(2, "little") + about + said if name == "header.npy" else content)
            self.said("certify", changed, shows=TEXT not in (wrong["family"], wrong["generator"], wrong["sha256"]), codes=(2,))

    def test_an_engine_that_is_asked(self):
        program = self.engine()
        dataset = self.file("d.jsonl", self.CASES)
        self.count("the protocol", 7)
        for mode in ("key", "noise", "dies", "answer", "op", "error"):
            with self.subTest(mode):
                self.said("certify", dataset, "--engine-command", f"python3 {program} {mode}", codes=(1, 3), **self.ENGINE)
        self.count("command lines", 1)
        junit, report = self.folder / "laws.xml", self.folder / "laws.json"
        nasty = TEXT.replace("\0", "").replace("'", "")
        self.said("properties", "--cases", 3, "--law", "swap,alarm_growth", "--engine-command", f"python3 {program} error '{nasty}'", "--junit", junit, "--json", report,
                  **self.ENGINE)
        if junit.exists():
            ElementTree.fromstring(self.clean(junit.read_bytes(), "JUnit"))
            self.clean(report.read_bytes(), "JSON")

    def test_reports_that_are_read(self):
        self.said("certify", self.dataset("known"), "--results", self.answers("known"), "--json", self.folder / "old.json", shows=False, codes=(1,))
        report = json.loads((self.folder / "old.json").read_text())
        known = ("format", "version", "pair", "scalar", "level", "required", "id", "expires", "conventions", "needs", "tolerance", "status", "a", "b")

        def compared(foreign):
            other, fields = put_everywhere(report, foreign, known)
            for failure in other["failures"]:
                failure["reason"] = foreign
            for at, failure in enumerate(report["failures"]):
                failure["level"] = "bounded" if at else "none"
            if foreign == TEXT:
                self.count("reports", fields + len(other["failures"]))
            old, new = self.file("a.json", line(report)), self.file("b.json", line(other))
            page = self.folder / "page.html"
            self.said("compare", old, new, shows=foreign == TEXT, codes=(0, 1))
            self.said("compare", old, new, new, "--report", page, shows=foreign == TEXT, codes=(0, 1))
            if foreign == TEXT:
                self.assertIn(SHOWN, self.clean(page.read_bytes(), "HTML"))
                identifier = report["failures"][0]["id"]
                self.said("explain", identifier, "--in", new, codes=(0,))
                self.said("certify", self.dataset(HARMLESS), "--results", self.answers(TEXT), "--baseline", new)
            return {"HTML": Structure(page.read_text()).tags}
        self.alike(compared)

    def test_certificates(self):
        dataset, certificate = self.file("d.jsonl", self.CASES), self.folder / "c.json"
        self.said("certify", dataset, "--results", self.file("a.jsonl", answers_to(self.CASES)), "--certificate", certificate, shows=False, codes=(0,))
        stated = json.loads(certificate.read_text())
        stated["engine"]["files"] = [{"program": "python3", "sha256": "0" * 64}, {"file": "gone", "sha256": "0" * 64}]
        stated["engine"] |= {"command": "gone", "kind": "command"}
        used = ("format", "version", "sha256", "pair", "scalar", "level", "required", "id", "kind", "check", "level_but_accepted", "issued", "share_judged")
        everywhere, fields = put_everywhere(stated, TEXT, used)
        few = json.loads(json.dumps(stated))
        few["engine"] |= {"kind": "command", "command": TEXT, "files": [{"program": TEXT, "sha256": "0" * 64}, {"file": TEXT.replace("\0", ""), "sha256": "0" * 64}]}
        few["environment"], more = put_everywhere(stated["environment"], TEXT)
        self.count("certificates", fields + more + 3 + 1 + 2)
        for name, content in (("everywhere", everywhere), ("not derived", few), ("an unknown key", stated | {TEXT: TEXT}),
                              *((f"{key} alone", stated | {key: TEXT}) for key in ("format", "accepted"))):
            with self.subTest(name):
                certificate.write_text(certificate_test.sealed(certificate_test.layout(content, whole=True)), errors="surrogatepass")
                self.said("verify", certificate)

        def badge(foreign):
            named, _ = put_everywhere(stated, foreign, ("format", "version", "sha256", "pair", "scalar", "level", "required", "kind", "check", "level_but_accepted"))
            certificate.write_text(certificate_test.sealed(certificate_test.layout(named, whole=True)))
            picture = self.folder / "badge.svg"
            self.said("badge", certificate, "-o", picture, "--label", foreign.replace("\0", ""), shows=foreign == TEXT, codes=(0,))
            svg = picture.read_bytes().decode()
            if foreign == TEXT:
                self.count("command lines", 1)
                self.assertIn(SHOWN, self.clean(svg, "SVG"))
            return {"SVG": [(one.tag, sorted(one.attrib)) for one in ElementTree.fromstring(svg).iter()]}
        self.alike(badge)

    def test_exams(self):
        exam, key, answers = (self.folder / name for name in ("exam.jsonl", "key.json", "answers.jsonl"))
        self.said("exam", "new", "-o", exam, "--key", key, "--pair", "sphere_sphere", "--family", "generic", "--count", 4, shows=False, codes=(0,))
        header, *questions = map(json.loads, exam.read_text().splitlines())
        asked = [{"id": one["id"], "overlap": True, "contact": None} for one in questions]
        recorded = self.file("recorded.jsonl", [{"format": "contact-oracle/results", "version": 1, "engine": {"name": TEXT, "version": TEXT},
                                                 "scalar": "binary64", "pairs": ["sphere_sphere"], "conventions": {}}, *asked])
        self.said("exam", "take", exam, "-o", answers, "--engine-command", f"python3 {self.engine()}", codes=(0,), **self.ENGINE)
        self.count("exams", 4)
        for name, path, content in (("exam", exam, text([header | {TEXT: TEXT}, *questions])), ("key", key, key.read_text().replace("{", "{" + json.dumps(TEXT) + ":1,", 1)),
                                    ("issued", key, line(json.loads(key.read_text()) | {"used": {"on": TEXT, "answers": TEXT}}))):
            with self.subTest(name):
                good = path.read_text()
                path.write_text(content)
                self.said("exam", "close", "--key", key, "--results", recorded, "--exam", exam, codes=(2,))
                path.write_text(good)
        self.said("exam", "close", "--key", key, "--results", recorded, "--exam", exam, codes=(0, 1))

    def test_scenes(self):
        attribute = "".join(c for c in TEXT if c >= " " or c in "\t\n\r").replace("\ufffe", "").replace("\uffff", "")
        quoted = "".join(f"&#{ord(c)};" if c < " " or c in "<>&\"'" else c for c in attribute)
        tags = "\u009b\u202e"  # pugixml takes nearly everything for a name
        scene = self.folder / "s.scn"
        named = '<SphereCollisionModel name="{0}" listRadius="1"/>'
        scene.write_text(("""<Node name="{0}"><Node name="{0}"><MechanicalObject name="{0}" position="0 0 0"/>""" + named + """</Node>
<Node name="b"><MechanicalObject position="0 0 0" template="{0}"/>""" + named + """</Node><Node name="c"><SphereLoader name="{0}" filename="{0}"/>
<MechanicalObject src="@{0}"/>""" + named + """</Node><Node name="d"><MechanicalObject position="@{0}.{0}"/>""" + named + """</Node>
<Node name="e"><TriangleCollisionModel name="{0}"/><X{1}CollisionModel/></Node><Node name="f"><MechanicalObject position="0 0 0"/>
<SphereCollisionModel name="x" radius="@{0}"/><include href="{0}"/></Node><Node name="g"><MechanicalObject position="2 0 0"/><SphereCollisionModel name="{0}2"/></Node></Node>""").format(quoted, tags))
        self.count("scenes", 17)
        self.said("detect", scene)
        self.assertIn(SHOWN, self.clean(run("detect", scene, "--json", text=False, stdin=b"").stdout, "JSON"))
        for key in ("position", "listRadius", "group", "active", "translation"):
            self.count("scenes", 1)
            element = "MechanicalObject" if key in ("position", "translation") else "SphereCollisionModel"
            scene.write_text(f'<Node><{element} {key}="{quoted}"/><MechanicalObject/><SphereCollisionModel/></Node>')
            self.said("detect", scene, shows=False, codes=(2,))
        self.count("scenes", 1)
        scene.write_text(f'<Node><SubCollisionPipeline collisionModels="@{quoted}"/><MechanicalObject/><SphereCollisionModel/></Node>')
        self.said("detect", scene, shows=False, codes=(0,))
        model = {"model": "SphereCollisionModel", "name": "s", "centers": [[0, 0, 0]], "radii": [1]}
        header = {"format": "contact-oracle/scene", "version": 1}
        for wrong in ([header, model | {"name": TEXT}], [header, model | {"model": TEXT}], [header, model | {TEXT: 1}], [header | {TEXT: 1}, model], [header | {"format": TEXT}, model]):
            self.count("scenes", 1)
            self.said("detect", self.file("s.jsonl", wrong), codes=(2,))

    def test_what_is_refused(self):
        """Keys that are not known and values that are not expected, in each format that is left."""
        case = {"id": "0" * 24, **SPHERES}
        unknown = {TEXT: TEXT}
        for what, args, lines in (
                ("datasets", ("lint",), [self.CASES[0] | unknown, *self.CASES[1:]]), ("datasets", ("lint",), [self.CASES[0] | {"pair": TEXT}, *self.CASES[1:]]),
                ("datasets", ("lint",), [self.CASES[0], self.CASES[1] | {"flags": [TEXT]}, *self.CASES[2:]]),
                ("datasets", ("lint",), [self.CASES[0], self.CASES[1] | {"id": TEXT}, *self.CASES[2:]]),
                ("datasets", ("lint",), [self.CASES[0], self.CASES[1] | {"exact": {"distance2": TEXT, "reach": TEXT, "margin_ulps": 0}}, *self.CASES[2:]]),
                ("datasets", ("lint",), [self.CASES[0], TEXT.replace("\n", "")]),
                ("questions", ("explain",), [case | unknown]), ("questions", ("explain",), [case | {"id": TEXT}]), ("questions", ("explain",), [case | {"scalar": TEXT}]),
                ("reports", ("compare",), [{"format": TEXT}]), ("certificates", ("verify",), [{"format": TEXT}]), ("exams", ("exam", "take", "-o", self.folder / "x", "--engine", "production"), [{"format": TEXT}])):
            with self.subTest(args=args, lines=str(lines)[:80]):
                self.count(what, 1)
                path = self.file("wrong.jsonl", lines)
                self.said(*args, path, *((path,) if args == ("compare",) else ()), codes=(2,), shows=isinstance(lines[-1], dict))
        right, *answers = answers_to(self.CASES)
        for lines in ([right | unknown, *answers], [right | {"pairs": [TEXT]}, *answers], [right, answers[0] | unknown], [right, {"id": TEXT}]):
            self.count("results", 1)
            self.said("certify", self.file("d.jsonl", self.CASES), "--results", self.file("wrong.jsonl", lines), codes=(2,))
        for message in ({"op": TEXT}, {"op": "query", "seq": 1, "pair": TEXT}, {"op": "hello", "protocol": TEXT}):
            self.count("the protocol", 1)
            self.said("serve", stdin=(line(message) + "\n").encode(), codes=(2,))

    def test_command_lines_and_file_names(self):
        word = TEXT.replace("\0", "")
        for args in (("certify", "--level", word), ("certify", "--engine", word), (word,), ("certify", f"--{word}"), ("certify", "--seed", word), ("certify", "--tolerance", word),
                     ("certify", "--family", word), ("explain", word), ("lint", word), ("certify", "--engine-command", word), ("certify", "--engine-library", word),
                     ("properties", "--law", word), ("generate", "--pair", word), ("help", word), ("badge", word, "-o", "x"), ("certify", "--engine", "production", "--shard", word, "--parts", self.folder), ("compare", word, word),
                     ("detect", word), ("detect", word + ".scn"), ("merge", word), ("man", word), ("completion", word), ("verify", word), ("convert", word, "-o", "x.npz")):
            with self.subTest(args=[one if one != word else "TEXT" for one in args]):
                self.count("command lines", 1)
                self.said(*args, codes=(2, 3))
        self.count("command lines", 1)
        self.said("annotate", "-", "-o", self.folder / "family.jsonl", "--family", word, stdin=line(SPHERES).encode() + b"\n", shows=False, codes=(0,))
        self.said("lint", self.folder / "family.jsonl", shows=False, codes=(0,))
        # A name has room for 255 bytes.
        names = ["::error::forged\n::error::forged\x1b[32m\u009b\u202e\u2028", "\nCERTIFIED: forged\n\rHOLDS: forged##[error]"]
        for name in names:
            with self.subTest(name):
                path, other = self.dataset(HARMLESS, name + ".jsonl"), self.folder / (name + "2")
                answers = self.answers(HARMLESS)
                at = {"cwd": self.folder}
                self.count("file names", 9)
                self.said("certify", path.name, "--results", answers, "--report", other.name + ".html", "--json", other.name + ".json", "--junit", other.name + ".xml", **at)
                self.said("compare", other.name + ".json", other.name + ".json", "--report", other.name + ".html", codes=(0,), **at)
                self.assertIn(SHOWN, self.clean((self.folder / (other.name + ".html")).read_bytes(), "HTML"))
                self.said("explain", self.CASES[1]["id"][:8], "--in", path.name, codes=(0,), **at)
                self.said("convert", path.name, "-o", other.name + ".npz", codes=(0,), **at)
                self.said("lint", other.name + ".json", codes=(2,), **at)
                right = self.file("right.jsonl", answers_to(self.CASES))
                self.said("certify", path.name, "--results", right, "--certificate", other.name + ".c.json", codes=(0,), **at)
                self.said("verify", other.name + ".c.json", codes=(0,), **at)
                self.said("badge", other.name + ".c.json", "-o", other.name + ".svg", codes=(0,), **at)
                self.said("exam", "new", "-o", other.name + ".exam.jsonl", "--key", other.name + ".key", "--pair", "cube_cube", "--family", "flat", "--count", 1, codes=(0,), **at)


if __name__ == "__main__":
    import sys
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
