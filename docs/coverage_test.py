#!/usr/bin/env python3
"""docs/coverage.md says of every rule of the specification what tests it, and says so truly:   coverage_test.py TOOL"""
import fnmatch
import json
import re
import subprocess
import sys
import unittest
from pathlib import Path

TOOL = Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else sys.exit(__doc__)
ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "docs"), str(ROOT / "src/component")]
import pages  # noqa: E402
from sofa_map_test import tests_in_the_source_tree  # noqa: E402

COLUMNS = ("asked", "mutants", "laws", "tests")  # families have a slash, flags have none
RULES = re.findall(r'<a id="(rule-[\w-]+)"></a>', pages.prose((ROOT / "docs/specification.md").read_text(encoding="utf-8")))
PAGE = (ROOT / "docs/coverage.md").read_text(encoding="utf-8")


def rows(page):
    """The rule of each row, and the names in each of its columns."""
    lines = [[cell.strip() for cell in line.split("|")[1:-1]] for line in page.splitlines() if line.startswith("| [")]
    return [(re.search(r"\(specification\.md#(rule-[\w-]+)\)", first)[1], dict(zip(COLUMNS, (re.findall(r"`([^`]+)`", cell) for cell in rest), strict=True)))
            for first, *rest in lines]


def listed(*words):
    """The lines of JSON that a command prints."""
    out = subprocess.run([TOOL, *words], text=True, capture_output=True, check=True).stdout
    return [json.loads(line) for line in out.splitlines()]


def known_tests():
    """Those of C++ and of Python, as the page names them."""
    found = tests_in_the_source_tree()
    for file in [file for folder in ("tool", "golden", "engines", "docs", "proptests") for file in (ROOT / folder).rglob("*_test.py")]:
        name = ""
        for kind, word in re.findall(r"^(class| +def) (\w+)", file.read_text(encoding="utf-8"), re.MULTILINE):
            name = word if kind == "class" else name
            found.add(f"{file.stem}.{name}.{word}")
    for file in (ROOT / "python" / "tests").glob("test_*.py"):
        found |= {f"{file.stem}.{word}" for word in re.findall(r"^def (test_\w+)", file.read_text(encoding="utf-8"), re.MULTILINE)}
    return found


class Coverage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.rows = rows(PAGE)
        cls.families = {file.relative_to(ROOT / "golden").as_posix().removesuffix(".jsonl").removesuffix(".f32")
                        for file in (ROOT / "golden").glob("*_*/*.jsonl")}
        cls.laws = {line.split()[0] for line in subprocess.run([TOOL, "properties", "--list"], text=True, capture_output=True,
                                                               check=True).stdout.splitlines() if line[:1].isalpha()}
        cls.flags = {entry["flag"] for entry in listed("families", "--json") if "flag" in entry}
        cls.kills = {}
        for file in json.loads((ROOT / "golden/adequacy.json").read_text())["files"]:
            cls.kills.setdefault(file["path"].removesuffix(".jsonl").removesuffix(".f32"), set()).update(file["kills"])

    def asked_by(self, row):
        """The families of a row, patterns put in full."""
        return {family for pattern in row["asked"] for family in fnmatch.filter(self.families, pattern)}

    def test_every_rule_has_one_row(self):
        self.assertGreater(len(RULES), 50)
        self.assertEqual(sorted(rule for rule, _ in self.rows), sorted(RULES))

    def test_every_rule_has_a_test(self):
        self.assertIn("**Rules without a test:** none.", PAGE)
        self.assertEqual([rule for rule, row in self.rows if not any(row.values())], [])

    def test_every_name_exists(self):
        tests = known_tests()
        wrong = [f"{rule}: {name}: no such family or flag" for rule, row in self.rows for name in row["asked"]
                 if not fnmatch.filter(self.families if "/" in name else self.flags, name)]
        wrong += [f"{rule}: {name}: no such law" for rule, row in self.rows for name in row["laws"] if name not in self.laws]
        wrong += [f"{rule}: {name}: no such test" for rule, row in self.rows for name in row["tests"] if name not in tests]
        self.assertEqual(wrong, [], "\n".join(wrong))

    def test_a_mutant_against_a_rule_is_killed_by_a_family_of_the_rule(self):
        wrong = [f"{rule}: {mutant}" for rule, row in self.rows for mutant in row["mutants"]
                 if not any(mutant in self.kills.get(family, ()) for family in self.asked_by(row))]
        self.assertEqual(wrong, [], "\n".join(wrong))
        self.assertGreater(len([1 for _, row in self.rows if row["mutants"]]), 25)

    def test_every_family_flag_and_law_is_named_by_some_rule(self):
        self.assertGreater(len(self.laws), 30)
        self.assertEqual(self.laws - {name for _, row in self.rows for name in row["laws"]}, set())
        self.assertEqual(self.flags - {name for _, row in self.rows for name in row["asked"]}, set())
        self.assertEqual(self.families - {family for _, row in self.rows for family in self.asked_by(row)}, set())
        # Every family of the generator has a committed file, so none of them is left out above.
        generated = {entry["family"] for entry in listed("families", "--json") if "family" in entry}
        self.assertEqual(generated - {family.split("/")[1] for family in self.families}, set())


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
