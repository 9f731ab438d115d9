#!/usr/bin/env python3
"""Reports against the ones before them, and badges: python3 tool/history_test.py PATH_TO_TOOL [unittest arguments]."""
import hashlib
import json
import os
import re
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from html.parser import HTMLParser
from pathlib import Path

import cli_test
from cli_test import GOLDEN, line, run

UGLY = """</script><b x="1">&'"""  # in an engine's name
SVG = "{http://www.w3.org/2000/svg}"


class Page(HTMLParser):
    """The tables of a page as lists of rows, its lists, its titles, its commands to copy, and its data."""
    def __init__(self, text):
        super().__init__()
        self.tables, self.items, self.headings, self.commands, self.summaries, self.data, self.sources = {}, [], [], [], [], "", []
        self.into, self.rows = None, None
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.sources += [attributes[key] for key in ("src", "href") if key in attributes]
        if tag == "table":
            self.rows = self.tables[attributes["class"]] = []
        elif tag == "tr":
            self.rows.append([])
        elif tag in ("th", "td"):
            self.rows[-1].append("")
            self.into = "cell"
            if "title" in attributes:
                self.rows[-1][-1] = attributes["title"] + " | "
        elif tag in ("li", "h2", "h3", "code", "summary"):
            self.into = tag
            {"li": self.items, "code": self.commands, "summary": self.summaries}.get(tag, self.headings).append("")
        elif tag == "script" and attributes.get("class") == "history":
            self.into = "data"

    def handle_endtag(self, tag):
        self.into = None

    def handle_data(self, data):
        if self.into == "cell":
            self.rows[-1][-1] += data
        elif self.into == "data":
            self.data += data
        elif self.into:
            {"li": self.items, "code": self.commands, "summary": self.summaries}.get(self.into, self.headings)[-1] += data


class Case(cli_test.Case):
    @classmethod
    def setUpClass(cls):
        """Questions that are hits, and the right answers to them."""
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.shared = Path(folder.name)
        cls.dataset = cls.shared / "d.jsonl"
        header, *cases = (GOLDEN / "sphere_sphere" / "touching.jsonl").read_text().splitlines()
        cases = [case for case in cases if '"hit":true' in case][:60]
        cls.ids = [json.loads(case)["id"] for case in cases]
        cls.dataset.write_text("\n".join([line({**json.loads(header), "count": len(cases)}), *cases]) + "\n")
        right = cls.shared / "right.jsonl"
        if run("certify", cls.dataset, "--engine", "production", "--record", right).returncode != 0:
            raise RuntimeError("production")
        cls.right = list(map(json.loads, right.read_text().splitlines()))

    def setUp(self):
        super().setUp()
        self.folder = self.folder.resolve()
        self.page = self.folder / "page.html"

    def file(self, name, text):
        path = self.folder / name
        path.write_text(text if isinstance(text, str) else json.dumps(text))
        return path

    def answers(self, wrong=(), far=(), engine="known", version="1"):
        """A results file whose answers at the indices `wrong` miss the hit, and those `far` have a value that is far off."""
        header, *answers = map(dict, self.right)
        header["engine"] = {"name": engine, "version": version}
        answers = {answer["id"]: answer for answer in answers}
        for i in wrong:
            answers[self.ids[i]] = {"id": self.ids[i], "overlap": False, "contact": None}
        for i in far:
            answers[self.ids[i]]["contact"] = {**answers[self.ids[i]]["contact"], "value": 1e3}
        return self.file("answers.jsonl", "".join(line(one) + "\n" for one in (header, *answers.values())))

    def report(self, name, *args, **answers):
        """The file of a report on such answers."""
        path = self.folder / name
        done = run("certify", self.dataset, "--results", self.answers(**answers), "--json", path, *args)
        self.assertEqual(done.returncode, 0 if json.loads(path.read_text())["verdict"].startswith("CERTIFIED") else 1, done.stderr)
        return path

    def compare(self, *args, code):
        done = run("compare", *args)
        self.assertEqual((done.returncode, done.stderr), (code, ""), done.stdout)
        return done.stdout

    def page_of(self, *reports, code):
        self.compare(*reports, "--report", self.page, code=code)
        return Page(self.page.read_text())

    def refused(self, args, *words):
        done = run(*args)
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        for word in words:
            self.assertIn(str(word), done.stderr)
        self.assertEqual([path.name for path in self.folder.iterdir() if ".unfinished" in path.name], [])


class Steps(Case):
    def test_each_report_has_a_line_with_its_verdict_and_what_became_of_it(self):
        reports = [self.report("1.json", wrong=[3, 4], far=[7], version="1"), self.report("2.json", wrong=[3], far=[8], version="2"),
                   self.report("3.json", version="3"), self.report("4.json", version="4"), self.report("5.json", far=[7], version="5")]
        out = self.compare(*reports, code=1)
        rows = [re.split(r"  +", row) for row in out.split("\n\n")[0].splitlines()]
        self.assertEqual(rows[0], ["report", "verdict", "against the one before", "level", "failures", "wrong decisions", "correctly rounded",
                                   "lengths", "angles", "decisions"])
        rows[1].insert(2, "")
        self.assertEqual([row[:6] for row in rows[1:]],
                         [["1 known 1", "REFUTED", "", "none", "3", "2"], ["2 known 2", "REFUTED", "MIXED", "none", "2", "1"],
                          ["3 known 3", "CERTIFIED", "BETTER", "correctly-rounded", ".", "."],
                          ["4 known 4", "CERTIFIED", "NO CHANGE", "correctly-rounded", ".", "."],
                          ["5 known 5", "REFUTED", "WORSE", "decisions", "1", "."]])
        # What everyday numbers need stands in the reports themselves; two figures are rounded up.
        for path, row in zip(reports, rows[1:]):
            for measure, cell in zip(("length", "angle", "decision"), row[7:10]):
                needs = json.loads(path.read_text())["total"]["everyday"]["needs"][measure]["from"]
                self.assertTrue(needs <= float(cell) <= 1.1 * needs, (needs, cell))
        self.assertEqual(out.splitlines()[-1], "The last against the one before it: WORSE.")

    def test_the_exit_code_is_that_of_the_last_step_alone(self):
        good, bad, other = self.report("good.json"), self.report("bad.json", wrong=[1]), self.report("other.json", wrong=[2])
        for reports, code in (((good, bad, good), 0), ((bad, good, bad), 1), ((good, bad, bad), 0), ((good, bad, other), 1)):
            self.compare(*reports, code=code)
            self.compare(*reports[-2:], code=code)

    def test_two_reports_are_compared_in_the_same_words_with_and_without_a_page(self):
        for old, new, code in (({}, {"wrong": [5]}, 1), ({"wrong": [5]}, {}, 0)):
            reports = self.report("1.json", **old), self.report("2.json", **new)
            plain = self.compare(*reports, code=code)
            self.assertEqual(self.compare(*reports, "--report", self.page, code=code), f"{plain}\nReport: {self.page}\n")
            verdicts = [json.loads(path.read_text())["verdict"] for path in reports]
            self.assertEqual(plain.splitlines()[:2], ["old  " + verdicts[0], "new  " + verdicts[1]])
            self.assertEqual(plain.splitlines()[-1], "WORSE." if code else "BETTER.")

    def test_a_label_names_the_file_where_engine_and_version_do_not_differ(self):
        (self.folder / "else").mkdir()
        reports = self.report("1.json"), self.report("2.json"), self.report("3.json", version="2"), self.report("else/1.json")
        rows = self.compare(*reports, code=0).splitlines()
        self.assertEqual([row.split("  ")[0] for row in rows[1:5]],
                         [f"1 known 1 ({reports[0]})", "2 known 1 (2.json)", "3 known 2", f"4 known 1 ({reports[3]})"])

    def test_what_was_judged_by_other_demands_is_said(self):
        reports = [self.report("1.json", version="1"), self.report("2.json", "--level", "decisions", version="2"),
                   self.report("3.json", "--tolerance", "length=0.5", version="3")]
        said = ["1 known 1 was judged by bounded.", "2 known 2 was judged by decisions.",
                "3 known 3 was judged by a tolerance of length 0.5, relative 0, angle 0."]
        out = self.compare(*reports, code=0)
        page = self.page_of(*reports, code=0)
        for words in (*said, "Failures are not compared: bounded was required, and now decisions."):
            self.assertIn(words, out)
            self.assertIn(words, page.items)
        self.assertNotIn("was judged by", self.compare(*[reports[0]] * 3, code=0))
        any_false_hit, near_ones = (self.report(f"{len(within)}.json", "--level", "conservative", *within) for within in ((), ("--within", "0.5")))
        self.assertIn("2 known 1 (2.json) was judged by conservative within 0.5.", self.compare(any_false_hit, near_ones, any_false_hit, code=0))

    def test_each_step_says_whether_the_bits_are_the_same(self):
        silent = self.report("silent.json", version="0")
        same, again, other = (self.folder / f"{name}.json" for name in ("same", "again", "other"))
        for path, engine in ((same, "production"), (again, "production"), (other, "plain-double")):
            done = run("certify", self.dataset, "--engine", engine, "--determinism", "--json", path)
            self.assertEqual(done.returncode, 0 if engine == "production" else 1, done.stderr)
        bits = lambda out: [re.split(r"  +", row)[-1] for row in out.splitlines()[2:out.splitlines().index("")]]
        out = self.compare(silent, same, again, other, code=1)
        self.assertEqual(bits(out), [".", "the same", "others"])
        self.assertIn(f"2 against 1: {silent} does not say what the bits of its answers are", out)
        self.assertRegex(out, "4 against 3: The bits of the answers differ in 1 family, first in [0-9a-f]{24} in sphere_sphere/touching")
        self.assertIn("others", Page(self.page_text(silent, same, again, other)).tables["board"][4])
        self.compare(same, again, same, "--same-bits", code=0)
        self.assertIn("REFUTED: --same-bits", self.compare(silent, same, again, "--same-bits", code=1))

    def test_of_several_sources_of_one_family_each_is_compared_with_its_own(self):
        header, *cases = self.dataset.read_text().splitlines()
        halves = [self.file(f"{i}.jsonl", "\n".join([line({**json.loads(header), "count": 30}), *cases[30 * i:30 * i + 30]]) + "\n")
                  for i in (0, 1)]
        other = GOLDEN / "sphere_sphere" / "generic.jsonl"
        reports = {}
        for name, engine, files in (("both", "production", halves), ("plain", "plain-double", halves), ("first", "production", halves[:1]),
                                    ("swapped", "production", halves[::-1]), ("other", "production", [other])):
            reports[name] = self.folder / f"{name}.json"
            judged = run("certify", *files, "--engine", engine, "--fresh", 0, "--determinism", "--json", reports[name])
            self.assertEqual(judged.returncode, 1 if name == "plain" else 0)
        out = self.compare(reports["both"], reports["both"], "--same-bits", code=0)
        self.assertNotIn("report alone", out)
        self.assertIn("same bits for every question that both were asked", out)
        wrong = [json.loads(reports["plain"].read_text())["families"][i]["level"] for i in (0, 1)]
        out = self.compare(reports["both"], reports["plain"], code=1)
        for name, level in zip(("sphere_sphere/touching", "sphere_sphere/touching (2)"), wrong):
            self.assertRegex(out, rf"(?m)^{re.escape(name)}  +30  +correctly-rounded -> {level} ")
        self.assertIn("The bits of the answers differ in 2 families, first in ", out)
        self.assertIn("The bits of the answers differ in 2 families, first in questions that are others in sphere_sphere/touching.",
                      self.compare(reports["both"], reports["swapped"], code=0))
        out = self.compare(reports["both"], reports["first"], code=0)
        self.assertIn("sphere_sphere/touching (2) (30 cases) is judged in the old report alone.", out)
        rows = {row[0]: row[1:] for row in self.page_of(reports["both"], reports["plain"], reports["first"], code=0).tables["levels"][1:]}
        self.assertEqual((len(rows["touching"]), rows["touching (2)"][2]), (3, "not judged | –"))
        # As many families, and others.
        self.assertIn("REFUTED: --same-bits", self.compare(reports["first"], reports["other"], "--same-bits", code=1))

    def page_text(self, *reports):
        done = run("compare", *reports, "--report", self.page)
        self.assertEqual(done.stderr, "")
        return self.page.read_text()

    def test_a_report_that_is_none_is_refused_by_file_field_and_value_and_leaves_no_page(self):
        good = self.report("good.json")
        whole = json.loads(good.read_text())
        no_total = {key: value for key, value in whole.items() if key != "total"}
        wrong_fit = json.loads(good.read_text())
        wrong_fit["total"]["everyday"]["needs"]["angle"]["from"] = "wide"
        for name, content, words in (("version.json", {**whole, "version": 7}, ("version", "expected version 1", "7")),
                                     ("format.json", {**whole, "format": "x"}, ("format", "contact-oracle/report", '"x"')),
                                     ("total.json", no_total, ("total",)), ("fit.json", wrong_fit, ("everyday.needs.angle.from", "wide")),
                                     ("half.json", good.read_text()[:900], ())):
            path = self.file(name, content)
            with self.subTest(name):
                self.refused(("compare", good, good, path, "--report", self.page), path, *words)
                self.assertFalse(self.page.exists())
        self.refused(("compare", good, good, self.folder / "gone.json"), "gone.json", "no such file")
        self.assertEqual(run("compare", good).returncode, 2)

    def test_a_page_that_cannot_be_written_is_refused_before_any_report_is_read(self):
        good = self.report("good.json")
        for page in (self.folder / "gone" / "page.html", self.folder):
            self.refused(("compare", good, good, "absent.json", "--report", page), page)
        self.refused(("compare", good, good, "--report", good), good, "is read by this run")
        json.loads(good.read_text())
        if os.path.exists("/dev/full"):
            done = run("compare", good, good, good, "--report", "/dev/full")
            self.assertEqual(done.returncode, 2)
            self.assertIn("/dev/full", done.stderr)


class History(Case):
    def test_the_page_has_the_numbers_of_the_reports(self):
        paths = []
        for engine in ("plain-float", "plain-double", "production"):
            paths.append(self.folder / f"{engine}.json")
            done = run("certify", GOLDEN / "sphere_sphere" / "touching.jsonl", GOLDEN / "sphere_sphere" / "generic.f32.jsonl",
                       GOLDEN / "cube_cube" / "generic.f32.jsonl", "--engine", engine, "--json", paths[-1])
            # plain-float is not asked what touches: those numbers are binary64.
            self.assertEqual(done.returncode, 1 if engine == "plain-double" else 0, done.stderr)
        page = self.page_of(*paths, code=0)
        reports = [json.loads(path.read_text()) for path in paths]
        dot = lambda n: str(n) if n else "."
        self.assertEqual(page.headings[0], "Comparison of engines: plain-float, plain-double, production")
        for row, report in zip(page.tables["board"][1:], reports):
            total = report["total"]
            self.assertEqual([row[1], *row[3:6]], [report["verdict"].split(":")[0], total["level"], dot(report["failure_count"]),
                                        dot(total["missed_hits"] + total["false_hits"])])
        levels = {row[0]: row[1:] for row in page.tables["levels"][1:]}
        counts = page.tables["counts"][1:]
        for i, report in enumerate(reports):
            for family in report["families"]:
                scalar = ".f32" if family["scalar"] == "binary32" else ""
                title = f"{family['pair']}/{family['family']}{scalar}"
                row, = [row for row in counts if row[0] == title and row[1] == json.loads(page.data)["labels"][i]]
                judged = sum(field["judged"] for field in family["fields"].values())
                rounded = sum(field["correctly_rounded"] for field in family["fields"].values())
                beyond = sum(field["beyond_bound"] for field in family["fields"].values())
                lost = family["cases"] - family["answers"]["answered"]
                self.assertEqual(row[2:10], [str(family["cases"]), family["level"], dot(family["missed_hits"]), dot(family["false_hits"]),
                                             dot(family["not_finite"]), dot(lost), dot(beyond),
                                             f"{100 * rounded / judged:.2f} %" if judged else "-"])
        cell = levels["touching"]
        self.assertEqual(cell[0], "not judged | –")  # in binary64, and the engine computes in binary32
        self.assertRegex(cell[1], "cases 210, level none, missed hits [0-9]+, .*correctly rounded [0-9.]+ % \\| none$")
        self.assertRegex(cell[2], "than before: better \\| correctly-rounded ▲$")
        data = json.loads(page.data)
        self.assertEqual(data["labels"], [f"{i} {r['engine']['name']} {r['engine']['version']}" for i, r in enumerate(reports, 1)])
        charts = [chart["values"] for chart in data["charts"]]
        self.assertEqual(charts[:3], [[r["total"]["everyday"]["needs"][measure]["from"] for r in reports]
                                      for measure in ("length", "angle", "decision")])
        self.assertEqual(charts[4], [r["total"]["missed_hits"] + r["total"]["false_hits"] for r in reports])
        self.assertEqual(charts[3][2], 100)

    def test_a_page_needs_nothing_but_itself_and_is_read_without_scripts(self):
        page = self.page_of(self.report("1.json"), self.report("2.json", wrong=[1], version="2"), code=1)
        self.assertEqual(page.sources, [])
        self.assertIn("default-src 'none'", self.page.read_text())
        self.assertEqual(set(page.tables), {"board", "levels", "counts"})
        self.assertEqual(page.headings[0], "History of known")

    def test_the_questions_that_fail_newly_and_that_are_right_newly_are_named_as_explain_reads_them(self):
        reports = self.report("1.json", wrong=[3, 9]), self.report("2.json", wrong=[9, 20], version="2"), self.report("3.json", wrong=[9], version="3")
        page = self.page_of(*reports, code=0)
        self.assertEqual(page.summaries[1:-1], ["Newly failing, or worse than before: 1", "Newly right: 1", "Newly right: 1"])
        asked = [re.fullmatch(r"echo '(.*)' \| \./run explain", command)[1] for command in page.commands]
        self.assertEqual([json.loads(question)["id"] for question in asked], [self.ids[20], self.ids[3], self.ids[20]])
        done = run("explain", input="\n".join(asked) + "\n")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"<p>{self.ids[20]} touching: missed hit", self.page.read_text())

    def test_of_many_questions_some_are_named_and_the_rest_are_counted(self):
        page = self.page_of(self.report("1.json"), self.report("2.json", wrong=range(50), version="2"), code=1)
        self.assertEqual(page.summaries[1], "Newly failing, or worse than before: 50")
        self.assertEqual(len(page.commands), 20)
        self.assertIn("<p>and 30 more</p>", self.page.read_text())

    def test_a_report_of_an_older_version_names_its_questions_by_id_and_draws_no_fitness(self):
        old = json.loads(self.report("1.json", wrong=[3]).read_text())
        for failure in old["failures"]:
            for key in ("a", "b", "alarm", "contact"):
                del failure[key]
        for counts in (old["total"], *old["families"]):
            del counts["everyday"]
        page = self.page_of(self.file("old.json", old), self.report("2.json", version="2"), code=0)
        self.assertEqual((page.summaries[1], page.commands), ("Newly right: 1", []))
        self.assertIn(f"<p>{self.ids[3]} touching: missed hit", self.page.read_text())
        self.assertEqual(json.loads(page.data)["charts"][0]["values"], [None, 0])
        self.assertEqual(page.tables["board"][1][7:11], ["-"] * 4)

    def test_a_family_that_one_report_does_not_judge_is_left_empty_and_said(self):
        first, other = self.report("1.json", wrong=[3]), self.folder / "other.json"
        done = run("certify", GOLDEN / "cube_cube" / "generic.jsonl", "--engine", "production", "--json", other)
        self.assertEqual(done.returncode, 0, done.stderr)
        page = self.page_of(first, other, code=0)
        rows = {row[0]: row[1:] for row in page.tables["levels"][1:]}
        self.assertNotIn("Newly right: 1", page.summaries)  # nobody asked again
        self.assertEqual((rows["touching"][1], rows["generic"][0]), ("not judged | –",) * 2)
        self.assertIn("cube_cube/generic (210 cases) is judged in the new report alone.", page.items)
        self.assertIn("Judged in one of the two reports alone: 2", page.summaries)
        self.assertIn("2 against 1: 2 families are judged in one of the two reports alone.", self.compare(first, other, other, code=0))

    def test_an_engine_s_name_is_text_and_no_markup(self):
        page = self.page_of(self.report("1.json", engine=UGLY), self.report("2.json", engine=UGLY, wrong=[1], version=UGLY), code=1)
        self.assertEqual(page.headings[0], "History of " + UGLY)
        self.assertEqual(json.loads(page.data)["labels"], [f"1 {UGLY} 1", f"2 {UGLY} {UGLY}"])
        self.assertNotIn("<b x", self.page.read_text())
        self.assertEqual(page.tables["board"][2][0], f"2 {UGLY} {UGLY}")


class Badge(Case):
    def certificate(self, *args, code=0, **answers):
        path = self.folder / "c.json"
        done = run("certify", self.dataset, "--results", self.answers(**answers), "--certificate", path, *args)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return path

    def badge(self, certificate, *args):
        """What a badge says: to the left, to the right, its title, its colour."""
        path = self.folder / "badge.svg"
        done = run("badge", certificate, "-o", path, *args)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        root = ElementTree.fromstring(path.read_bytes())
        left, right = root.iter(SVG + "text")
        title = root.find(SVG + "title").text
        self.assertEqual((root.get("role"), root.get("aria-label")), ("img", f"{left.text}: {right.text}"))
        self.assertTrue(title.startswith(f"{left.text}: {right.text}. "), title)
        self.assertIn(f"says \"{left.text}: {right.text}\"", done.stdout)
        # Each text has its field: nothing overlaps, whatever the font.
        ends = [(float(text.get("x")), float(text.get("x")) + float(text.get("textLength"))) for text in (left, right)]
        self.assertLess(ends[0][1], ends[1][0])
        self.assertLess(ends[1][1], float(root.get("width")))
        for attribute in ("href", "src", "url(", "@import"):
            self.assertNotIn(attribute, path.read_text())
        return left.text, right.text, title, [path.get("fill") for path in root.iter(SVG + "path")][1]

    def test_a_badge_says_the_level_that_is_certified_the_engine_and_the_day(self):
        path = self.certificate(version="7")
        left, right, title, _ = self.badge(path)
        stated = json.loads(path.read_text())
        self.assertEqual((left, right), ("contact-oracle", "certified: correctly-rounded"))
        self.assertEqual(title, f"{left}: {right}. known 7, issued {stated['issued']}; 60 cases, 100 % of those given, "
                                f"published questions alone; certificate {stated['sha256'][:12]}")

    def test_what_is_refuted_is_refuted_in_another_colour(self):
        certified = self.badge(self.certificate())
        refuted = self.badge(self.certificate(wrong=[3], code=1))
        self.assertEqual(refuted[1], "refuted")
        self.assertNotEqual(refuted[3], certified[3])

    def test_a_tolerance_is_said_in_short(self):
        for tolerance, words in (("length=0.001,angle=0.01", "certified: length 0.001, angle 0.01 rad"),
                                 ("relative=1e-6,min=1e-4,max=1e4", "certified: relative 1e-06, numbers 0.0001 to 10000")):
            self.assertEqual(self.badge(self.certificate("--tolerance", tolerance, "--least-judged", 0))[1], words)
        self.assertEqual(self.badge(self.certificate("--tolerance", tolerance, code=1))[1], "too little judged")

    def test_accepted_failures_are_counted(self):
        for wrong, words in (([3], "certified: correctly-rounded but for 1 failure"), ([3, 4], "certified: correctly-rounded but for 2 failures")):
            known = self.report("known.json", wrong=wrong)
            path = self.certificate("--baseline", known, "--accept-reason", "known", "--accept-until", "2999-12-31", wrong=wrong)
            self.assertEqual(self.badge(path)[1], words)

    def test_the_text_to_the_left_may_be_another_and_every_text_is_escaped(self):
        path = self.certificate(engine=UGLY, version="\u0001\uffff é")
        left, _, title, _ = self.badge(path, "--label", UGLY + "\x02 漢字")
        self.assertEqual(left, UGLY + "\\x02 漢字")
        self.assertIn(UGLY + " \\x01\\u{ffff} é, issued", title)
        self.badge(path, "--label", b"\xff\xfe".decode("utf-8", "surrogateescape"))

    def test_what_is_no_whole_certificate_is_refused_and_leaves_no_badge(self):
        path, out = self.certificate(), self.folder / "badge.svg"
        text = path.read_text()
        for name, content, words in (("report.json", self.report("r.json").read_text(), ("format", "contact-oracle/certificate")),
                                     ("version.json", text.replace('"version":1\n', '"version":2\n'), ("version", "reads version 1")),
                                     ("changed.json", text.replace('"certified":true', '"certified":false'), ("sha256", "was changed")),
                                     ("half.json", text[:500], ()),
                                     ("form.json", self.sealed(text.replace('"accepted":[]', '"accepted": []')), ("not the canonical one",)),
                                     ("empty.json", self.sealed('{\n"format":"contact-oracle/certificate",\n"sha256":"' + "0" * 64 + '",\n"version":1\n}\n'),
                                      ("engine",))):
            with self.subTest(name):
                bad = self.file(name, content)
                self.refused(("badge", bad, "-o", out), bad, *words)
                self.assertFalse(out.exists())
        self.refused(("badge", self.folder / "gone.json", "-o", out), "gone.json", "no such file")
        self.assertEqual(run("badge", path).returncode, 2)

    @staticmethod
    def sealed(text):
        """The text with the digest that it has."""
        blank = re.sub('\n"sha256":"[0-9a-f]*"', '\n"sha256":"' + "0" * 64 + '"', text)
        return blank.replace('\n"sha256":"' + "0" * 64, '\n"sha256":"' + hashlib.sha256(blank.encode()).hexdigest())

    def test_a_badge_that_cannot_be_written_is_refused(self):
        path = self.certificate()
        for out in (self.folder / "gone" / "b.svg", self.folder):
            self.refused(("badge", path, "-o", out), out)
        self.refused(("badge", path, "-o", path), path, "is read by this run")
        if os.path.exists("/dev/full"):
            done = run("badge", path, "-o", "/dev/full")
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn("/dev/full", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
