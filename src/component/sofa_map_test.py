#!/usr/bin/env python3
"""docs/sofa-map.md names a test for every statement of the source, of capsules, rays and triangles, and every test that it names exists."""
import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
FOLDERS = ("src", "oracle", "golden", "engines", "tool", "proptests")
DEFINITION = re.compile(r"\b(?:TEST|TYPED_TEST|TEST_F|TEST_P|RC_GTEST_PROP)\(\s*(\w+)\s*,\s*(\w+)\s*[,)]")


def tests_in_the_source_tree():
    return {
        f"{suite}.{name}"
        for folder in FOLDERS
        for file in (ROOT / folder).rglob("*.cpp")
        for suite, name in DEFINITION.findall(file.read_text(encoding="utf-8"))
    }


def rows(section="Every statement of the source"):
    """The cells of the table's rows in a section, without its head."""
    text = (ROOT / "docs/sofa-map.md").read_text(encoding="utf-8")
    section = text.split(f"\n## {section}\n")[1].split("\n## ")[0]
    lines = [line for line in section.splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]] for line in lines[2:]]


class SofaMap(unittest.TestCase):
    def test_has_a_statement_what_holds_and_a_test_in_every_row(self):
        self.assertGreater(len(rows()), 40)
        shapes = [*rows("Capsules"), *rows("Rays and triangles")]
        self.assertGreater(len(shapes), 18)
        for row, width in [*((row, 3) for row in rows()), *((row, 4) for row in shapes)]:
            self.assertEqual(len(row), width, row)
            self.assertTrue(all(row), row)
            self.assertRegex(row[-1], r"^`\w+\.\w+`(, `\w+\.\w+`)*$", row[0])

    def test_names_tests_that_exist(self):
        known = tests_in_the_source_tree()
        self.assertGreater(len(known), 100)
        for row in [*rows(), *rows("Capsules"), *rows("Rays and triangles")]:
            for test in re.findall(r"`(\w+\.\w+)`", row[-1]):
                self.assertTrue(test in known, f"{test} is no test; it is named for: {row[0]}")


if __name__ == "__main__":
    unittest.main()
