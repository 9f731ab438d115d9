#!/usr/bin/env python3
"""Code in the documentation is code that is compiled.

In docs/*.md and README.md, a code block preceded by <!-- from FILE --> occurs word for word in FILE.
"""

import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = [*sorted((ROOT / "docs").glob("*.md")), ROOT / "README.md"]
MARK = re.compile(r"<!-- from (\S+) -->\n(.*\n)", re.MULTILINE)
EXCERPT = re.compile(r"<!-- from (\S+) -->\n```\w*\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def problems(page):
    """What is wrong with the excerpts of a page, given as text."""
    found = [f"<!-- from {file} --> is not followed by a code block" for file, line in MARK.findall(page)
             if not line.startswith("```")]
    for file, code in EXCERPT.findall(page):
        source = ROOT / file
        if not source.is_file():
            found.append(f"there is no file {file}")
        elif not code.strip() or code not in source.read_text(encoding="utf-8"):
            found.append(f"this is not in {file}:\n{code}")
    return found


class Documentation(unittest.TestCase):
    def test_excerpts_occur_in_the_files_they_are_from(self):
        for page in PAGES:
            with self.subTest(page=page.name):
                self.assertEqual(problems(page.read_text(encoding="utf-8")), [])

    def test_every_code_block_of_the_page_on_intersectors_is_an_excerpt(self):
        page = (ROOT / "docs/intersectors.md").read_text(encoding="utf-8")
        blocks = len(re.findall(r"^```(?:cpp|cmake)$", page, re.MULTILINE))
        self.assertGreater(blocks, 0)
        self.assertEqual(len(EXCERPT.findall(page)), blocks)

    def test_a_wrong_excerpt_is_found(self):
        here = "docs/examples/docs_test.py"
        block = "<!-- from {} -->\n```python\n{}\n```\n"
        self.assertEqual(problems(block.format(here, "import pathlib\nimport re")), [])
        self.assertIn("is not in", problems(block.format(here, "import pathlib\nimport ren"))[0])
        self.assertIn("is not in", problems(block.format(here, ""))[0])
        self.assertIn("no file", problems(block.format("docs/examples/none.cpp", "x"))[0])
        self.assertIn("not followed", problems(f"<!-- from {here} -->\n\n```python\nimport re\n```\n")[0])


if __name__ == "__main__":
    unittest.main()
