#!/usr/bin/env python3
"""What no compiler tells of the sources: comments that a formatter broke, and stages of the oracle that include each other:   sources_test.py"""
import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FOLDERS = ("bench", "dev", "docs", "engines", "formats", "golden", "include", "oracle", "proptests", "python", "src", "tool")
COMMENT = re.compile(r"\s*(?P<mark>///?<?)(?P<space> *)(?P<text>\S.*)")
BLOCK = re.compile(r"^( *)/\*.*?\*/", re.MULTILINE | re.DOTALL)
HEADINGS = "Units|Domain|Decision|Error|Degenerate|Unique|Points|Environment|Threads|Result|Source|Evidence"


def sources():
    return [path for folder in FOLDERS for path in (ROOT / folder).rglob("*")
            if path.suffix in (".h", ".hpp", ".cpp", ".c", ".in") and "node_modules" not in path.parts]


def by_lines(block):
    """A comment of C that begins a line, as one of C++."""
    indent = len(block[1]) + 2
    return "\n".join("//" + line[indent:] for line in block[0].removesuffix("*/").rstrip(" ").split("\n"))


def broken_comments(text):
    """Lines of comments that a formatter broke anew: words left behind, and headings that ran into a sentence."""
    lines = [COMMENT.fullmatch(line) for line in BLOCK.sub(by_lines, text).split("\n")]
    found = []
    for i, line in enumerate(lines):
        if not line:
            continue
        if re.search(rf"[.;,)] +(?:{HEADINGS})(?: {{3,}}\S|$)", line["text"]):
            found.append((i + 1, "a heading in the middle of a line"))
        before, after = lines[i - 1] if i else None, lines[i + 1] if i + 1 < len(lines) else None
        if not before or not after or not before["mark"] == line["mark"] == after["mark"]:
            continue
        words = len(line["text"].split())
        if words <= 3 and len(after["space"]) >= len(line["space"]) + 6:
            found.append((i + 1, "words left behind: the lines after these are further in"))
        if words <= 2 and before["space"] == line["space"] == after["space"] and re.match(r"[a-z]", after["text"]) and not re.search(r"[.:;,?!)]$", line["text"]):
            found.append((i + 1, "words left behind: the sentence goes on in the next line"))
    return found


class Comments(unittest.TestCase):
    def test_the_formatter_left_every_comment_as_it_was_written(self):
        self.assertIn("ReflowComments: false", (ROOT / ".clang-format").read_text(encoding="utf-8"))
        files = sources()
        self.assertGreater(len(files), 300)
        self.assertEqual([(str(path.relative_to(ROOT)), *said) for path in files for said in broken_comments(path.read_text(encoding="utf-8"))], [])

    def test_each_kind_is_found(self):
        for text in ("/// Units       of a length that need not\n/// be\n///             of length 1.", "//   a row, whose numbers are of\n//   the\n//            question",
                     "/// once, as kRounding says. Domain      2 <= kBits", "// a sentence that was broken, and\n// then\n// went on", "/* It has no say. Domain\n   finite. */",
                     "  /* It has a say. Units       one length\n     unit. */"):
            self.assertEqual(len(broken_comments(text)), 1, text)
        for text in ("/// Units       of a length that need not\n///             be of length 1.", "/// Decision    exact.\n/// Units       none.",
                     "/// One sentence.\n/// Another.\n/// third", "// The rows:\n//   a   first\n//   b   second", "int x;  // one\n// two\n// three.",
                     "/* It has a say.\n   Units       of a length that need not\n               be of length 1. */"):
            self.assertEqual(broken_comments(text), [], text)


class Stages(unittest.TestCase):
    """docs/oracle-stages.md: no stage of the oracle shares code with another. The staged oracle joins them, and the witness is none."""

    def test_no_stage_includes_another(self):
        stages = {"double_double": [], "interval": [], "exact": []}
        for path in sorted((ROOT / "oracle/truth").iterdir()):
            if path.suffix in (".cpp", ".hpp") and not re.search(r"_test$|^staged_oracle|witness$|^grid$", path.stem):
                stages[next((stage for stage in ("double_double", "interval") if stage in path.stem), "exact")].append(path)
        includes = {path.name: set(re.findall(r'#include "oracle/truth/(\w+\.hpp)"', path.read_text(encoding="utf-8")))
                    for files in stages.values() for path in files}
        for stage, files in stages.items():
            self.assertGreater(len(files), 8)
            headers = {path.name for path in files if path.suffix == ".hpp"}
            # Plain structs, where the vertices of a shape are, the guard of the environment, the proved bounds and the clamp are of no
            # stage's arithmetic.
            headers -= {"query.hpp", "core.hpp", "expectation.hpp", "rounded_answer.hpp", "default_environment.hpp", "proved_bounds.hpp", "clamped.hpp", "truth.hpp"}
            for other, theirs in stages.items():
                if other != stage:
                    self.assertEqual([(path.name, include) for path in theirs for include in sorted(includes[path.name] & headers)], [], f"{other} includes {stage}")


if __name__ == "__main__":
    unittest.main()
