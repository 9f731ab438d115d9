#!/usr/bin/env python3
"""The pages hold what they show:   pages_test.py TOOL

A line before a block of code says what becomes of it:

    <!-- from FILE -->           it stands in FILE word for word
    <!-- run -->                 it is run. Of a block of text the first lines, "$ COMMAND", are run and the rest is what they print together;
                                 "..." stands for some lines. A block of sh is a script.
    <!-- run: exit 1 0 -->       the same, with the exit status of each command or of the script; without it they are all 0
    <!-- not run: REASON -->     it is not, and this is why

The blocks of a page are run one after the other in a folder of their own, which looks like the repository; ./run is TOOL there."""
import concurrent.futures
import os
import re
import shlex
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOL = Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else sys.exit(__doc__)
ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "docs"), str(ROOT / "docs/site")]
import pages  # noqa: E402

TEXTS = {pages.name_of(page): page.read_text(encoding="utf-8") for page in pages.pages()}
BLOCK = re.compile(r"^([^\n]*)\n```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
RUN = re.compile(r"<!-- run(?:: exit ([\d ]+))? -->")
FROM = re.compile(r"<!-- from (\S+) -->")
# What stands between "begin" and "end" is written or compared by another test.
MARKED = re.compile(rf"{RUN.pattern}|{FROM.pattern}|<!-- not run: .+ -->|<!-- python -->|<!-- [\w-]+:begin -->")
NAVIGATION = TEXTS["docs/site/index.md"]


def blocks(text):
    """The code blocks of a page: the line before, the language, the code."""
    return BLOCK.findall(text)


def commands_of(code):
    """The commands of a block of text, and what they print."""
    found = re.match(r"((?:\$ (?:.*[\\|]\n)*.*\n)*)((?s:.*))", code)
    return re.findall(r"^\$ ((?:.*[\\|]\n)*.*)\n", found[1], re.MULTILINE), found[2]


def wrong_excerpts(text):
    """What is wrong with the excerpts of a page."""
    found = []
    for mark, _, code in blocks(text):
        if not (source := FROM.fullmatch(mark)):
            continue
        file = ROOT / source[1]
        if not file.is_file():
            found.append(f"there is no file {source[1]}")
        elif not code.strip() or code not in file.read_text(encoding="utf-8"):
            found.append(f"this is not in {source[1]}:\n{code}")
    return found


def stray_marks(text):
    """Marks that no block of code follows, or one that cannot be run."""
    marked = [mark for mark, language, code in blocks(text)
              if FROM.fullmatch(mark) or RUN.fullmatch(mark) and (language == "sh" or language == "text" and commands_of(code)[0])]
    return len([line for line in text.splitlines() if FROM.fullmatch(line) or RUN.fullmatch(line)]) - len(marked)


def unmarked(text):
    """The commands that a page shows and of which nobody knows whether they work."""
    found = [code for mark, language, code in blocks(text)
             if (language in ("sh", "bash", "console") or language in ("", "text") and code.startswith("$ ")) and not MARKED.fullmatch(mark)]
    outside = pages.FENCE.sub("", text)
    return found + re.findall(r"^    +(?:\$ )?(?:\./run|(?:sudo )?(?:contact-oracle|python3|pip|mpirun|cmake|ctest|apt|apt-get|git|curl)) .*$", outside, re.MULTILINE)


def navigation():
    """The pages of each part of the site's navigation."""
    return {caption: re.findall(r"^(?:.* <)?([^\s>]+)>?$", names, re.MULTILINE)
            for caption, names in re.findall(r"^:caption: (.*)\n\n((?:.+\n)+?)```", NAVIGATION, re.MULTILINE)}


def users():
    """The pages that users read."""
    import build
    placed = {build.place(ROOT / name).with_suffix("").as_posix(): name for name in TEXTS if not name.startswith(".github")}
    return [placed[name] for caption, names in navigation().items() if "maintainers" not in caption for name in names if name in placed]


class Folder:
    """Looks like the repository: what is written there goes to no one else."""

    def __init__(self, folder):
        self.place, programs = Path(folder) / "contact-oracle", Path(folder) / "programs"
        for made in (self.place / "build", programs):
            made.mkdir(parents=True)
        for entry in ROOT.iterdir():
            if entry.name not in ("build", "run", ".git"):
                (self.place / entry.name).symlink_to(entry)
        for name, program in ((self.place / "run", TOOL), (programs / "contact-oracle", TOOL), (programs / "python3", sys.executable)):
            name.write_text(f'#!/bin/sh\nexec {shlex.quote(str(program))} "$@"\n')
            name.chmod(0o755)
        self.environment = {**os.environ, "PATH": f"{programs}:{os.environ['PATH']}", "PYTHONPATH": str(TOOL.parent / "python")}

    def run(self, script):
        return subprocess.run(["bash", "-euo", "pipefail", "-c", script], text=True, capture_output=True, cwd=self.place, timeout=60,
                              env=self.environment)


def run_page(text):
    """What is wrong with the blocks of a page that are run: a message each."""
    found = []
    with tempfile.TemporaryDirectory() as folder:
        place = Folder(folder)
        for mark, language, code in blocks(text):
            if not (run := RUN.fullmatch(mark)):
                continue
            commands, output = commands_of(code) if language == "text" else ([code], None)
            done = [place.run(command) for command in commands]
            wanted = [int(status) for status in run[1].split()] if run[1] else [0] * len(commands)
            said = "\n".join(f"$ {command}\n{one.stdout}{one.stderr}" for command, one in zip(commands, done))
            if (ended := [one.returncode for one in done]) != wanted:
                found.append(f"exit {ended}, and not {wanted}:\n{said}")
            pattern = "".join("(?:.*\n)*?" if line == "...\n" else re.escape(line) for line in (output or "").splitlines(True))
            if output is not None and not re.fullmatch(pattern, "".join(one.stdout for one in done)):
                found.append(f"{output}\nis not what is printed:\n{said}")
    return found


class Pages(unittest.TestCase):
    def test_excerpts_occur_in_the_files_they_are_from(self):
        self.assertEqual({name: wrong for name, text in TEXTS.items() if (wrong := wrong_excerpts(text))}, {})

    def test_every_mark_has_its_block(self):
        self.assertEqual([name for name, text in TEXTS.items() if stray_marks(text)], [])

    def test_every_code_block_of_the_page_on_intersectors_is_an_excerpt(self):
        code = [mark for mark, language, _ in blocks(TEXTS["docs/intersectors.md"]) if language in ("cpp", "cmake")]
        self.assertGreater(len(code), 0)
        self.assertEqual([mark for mark in code if not FROM.fullmatch(mark)], [])

    def test_the_build_files_are_yaml(self):
        try:
            import yaml
        except ImportError:
            self.skipTest("Python has no YAML here")
        files = [yaml.safe_load(code) for text in TEXTS.values() for _, language, code in blocks(text) if language == "yaml"]
        github, gitlab = [file for file in files if "jobs" in file], [file for file in files if "contacts" in file]
        self.assertTrue(github and gitlab)
        self.assertEqual([step for file in github for job in file["jobs"].values() for step in job["steps"] if not step.keys() & {"uses", "run"}], [])
        lines = [line for file in gitlab for key in ("before_script", "script") for line in file["contacts"].get(key, [])]
        self.assertTrue(lines and all(isinstance(line, str) for line in lines))

    def test_every_link_leads_somewhere(self):
        self.assertEqual({name: wrong for name, text in TEXTS.items() if (wrong := pages.broken(ROOT / name, text))}, {})
        self.assertGreater(sum(len(pages.links(text)) for text in TEXTS.values()), 500)

    def test_every_page_is_in_the_navigation_of_the_site_and_once(self):
        import build
        placed = {build.place(ROOT / name).with_suffix("").as_posix() for name in TEXTS if not name.startswith(".github")} | build.TABLES.keys()
        named = [name for names in navigation().values() for name in names]
        self.assertEqual(sorted(named), sorted(placed - {"index"}))

    def test_the_first_page_of_the_repository_lists_every_page_of_the_documentation(self):
        # Findings have a list of their own.
        linked = {pages.name_of(pages.split(ROOT / name, link[1])[0]) for name in ("README.md", "docs/findings/README.md")
                  for link in pages.links(TEXTS[name]) if not pages.SCHEME.match(link[1])}
        self.assertEqual([name for name in TEXTS if name.startswith("docs/") and not name.startswith("docs/site/") and name not in linked], [])

    def test_the_table_of_the_scoreboard_is_that_of_its_data(self):
        import build
        data = build.scoreboard.read()
        shown = TEXTS["docs/scoreboard.md"].split(build.scoreboard.BEGIN)[1].split(build.scoreboard.END)[0]
        self.assertEqual(shown.splitlines(), build.scoreboard.page_table(data).splitlines())
        self.assertGreater(len(build.scoreboard.tables(data).splitlines()), 1000)

    def test_every_command_that_users_read_is_run_or_says_why_not(self):
        wrong = [f"{name}:\n{one}" for name in users() for one in unmarked(TEXTS[name])]
        self.assertEqual(wrong, [], "\n".join(wrong))

    def test_what_they_show_is_what_is_printed(self):
        shown = {name: text for name, text in TEXTS.items() if any(RUN.fullmatch(mark) for mark, *_ in blocks(text))}
        self.assertGreater(len(shown), 5)
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            for name, wrong in zip(shown, pool.map(run_page, shown.values())):
                with self.subTest(name):
                    self.assertEqual(wrong, [], "\n".join(wrong))


class Mistakes(unittest.TestCase):
    """What the checks above are for is found."""

    def test_a_wrong_excerpt(self):
        here = "docs/pages_test.py"
        block = "<!-- from {} -->\n```python\n{}\n```\n"
        self.assertEqual(wrong_excerpts(block.format(here, "import re\nimport shlex")), [])
        self.assertIn("is not in", wrong_excerpts(block.format(here, "import re\nimport shle"))[0])
        self.assertIn("is not in", wrong_excerpts(block.format(here, ""))[0])
        self.assertIn("no file", wrong_excerpts(block.format("docs/examples/none.cpp", "x"))[0])

    def test_a_mark_without_its_block(self):
        self.assertEqual(stray_marks("<!-- run -->\n```text\n$ true\n```\n<!-- from x -->\n```c\n```\n"), 0)
        for stray in ("<!-- from x -->\n\n```python\n```\n", "<!-- run -->\n\n```sh\n```\n", "<!-- run -->\n```text\ntrue\n```\n"):
            self.assertEqual(stray_marks(stray), 1, stray)

    def test_a_block_that_prints_or_ends_otherwise(self):
        block = "<!-- run{} -->\n```text\n$ echo one; echo two\n$ sh -c 'exit {}'\n{}```\n"
        self.assertEqual(run_page(block.format("", 0, "one\ntwo\n")), [])
        self.assertEqual(run_page(block.format(": exit 0 3", 3, "...\ntwo\n")), [])
        self.assertIn("is not what is printed", run_page(block.format("", 0, "two\n"))[0])
        self.assertIn("exit [0, 3], and not [0, 0]", run_page(block.format("", 3, "one\ntwo\n"))[0])
        self.assertIn("exit [1], and not [0]", run_page("<!-- run -->\n```sh\nfalse\ntrue\n```\n")[0])

    def test_a_command_that_nobody_runs(self):
        for shown in ("```sh\n./run certify\n```\n", "```text\n$ ./run\n```\n", "    ./run certify\n", "    contact-oracle lint x\n"):
            self.assertEqual(len(unmarked("text\n\n" + shown)), 1, shown)
        for marked in ("<!-- run -->\n```sh\n./run\n```\n", "<!-- not run: it takes an hour -->\n```sh\n./run\n```\n", "```text\nVERDICT\n```\n"):
            self.assertEqual(unmarked("text\n\n" + marked), [], marked)
        self.assertEqual(len(unmarked("<!-- not run:  -->\n```sh\n./run\n```\n")), 1)

    def test_a_link_that_leads_nowhere(self):
        page = ROOT / "docs/golden.md"
        for good in ("formats.md#digests", "#its-own", "examples/engines", "https://example.org/a", "../README.md"):
            self.assertEqual(pages.broken(page, f"# Its own\n\n[text]({good})\n"), [], good)
        for bad in ("format.md", "formats.md#digest", "#own", "../../elsewhere.md", "https://", "htps://example.org"):
            self.assertEqual(len(pages.broken(page, f"# Its own\n\n![text]({bad})\n")), 1, bad)
        self.assertEqual(pages.broken(page, "```text\n[text](nowhere.md)\n```\n`[text](nowhere.md)`\n"), [])
        self.assertEqual(pages.anchors("# A `b` [c d](e.md)!\n# A\n# A\n<a id=\"x\"></a>\n```sh\n# No\n```\n"), ["x", "a-b-c-d", "a", "a-1"])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
