#!/usr/bin/env python3
"""Help, manual pages and completion, and the options that mean the same in every command:
python3 tool/usage_test.py PATH_TO_TOOL [unittest arguments]."""
import json
import os
import pty
import re
import select
import shutil
import subprocess
import sys
import time
import unittest
from pathlib import Path

import cli_test
from cli_test import GOLDEN, ROOT, SPHERES, TOOL, answers_to, committed, run, text

FLAT = GOLDEN / "cube_cube" / "flat.jsonl"
TOUCHING = GOLDEN / "sphere_sphere" / "touching.jsonl"
SCENE = [{"format": "contact-oracle/scene", "version": 1, "alarm": 0.5, "contact": 0.25},
         {"model": "SphereCollisionModel", "name": "one", "centers": [[0, 0, 0], [9, 0, 0]], "radii": [1.5, 1]},
         {"model": "SphereCollisionModel", "name": "other", "centers": [[1, 2, 2]], "radii": [1.5]}]
MOST_USED = ["certify", "properties", "explain", "compare", "generate", "engines"]
HEADINGS = {
    "Judge an engine": ["certify", "properties", "compare", "exam", "merge", "verify", "badge"],
    "Ask for right answers": ["explain", "detect", "serve", "export"],
    "Make golden files": ["generate", "annotate", "convert", "lint"],
    "List what there is": ["engines", "pairs", "families"],
    "Maintain the committed golden files": ["regenerate", "adequacy", "digests"],
    "Help": ["help", "completion", "man"]}
COMMANDS = [command for commands in HEADINGS.values() for command in commands]
PAGES = [*([one] for one in COMMANDS), *(["exam", one] for one in ("new", "take", "close"))]


def sections(page):
    """The names that stand in the first column of a help page, by heading."""
    found = {}
    for one in page.splitlines():
        if one.endswith(":") and not one.startswith(" "):
            found[one[:-1]] = heading = []
        elif (name := re.match(r"  ([^ ,=[]+)", one)) and one[2] != " " and found:
            heading.append(name[1])
    return found


class Case(cli_test.Case):
    def help(self, *command):
        return self.holds(*command, "--help")


class Help(Case):
    def test_the_first_page_shows_what_is_used_most_and_how_to_see_all(self):
        page = self.help()
        self.assertEqual(sections(page)["The commands that are used most"], MOST_USED)
        self.assertNotIn("adequacy", page)
        listed = page.split("used most:\n")[1].split("\n\n")[0].splitlines()
        self.assertEqual(len(listed), len(MOST_USED))  # one line each
        for word in ("contact-oracle help all ", "contact-oracle help COMMAND ", "--quiet", "--color", "oracle fault"):
            self.assertIn(word, page)
        self.assertLess(len(page.splitlines()), 40)
        self.assertEqual(self.holds("help"), page)

    def test_every_command_stands_under_one_heading(self):
        page = self.holds("--help-all")
        found = sections(page)
        self.assertEqual({heading: found.get(heading) for heading in HEADINGS}, HEADINGS)
        self.assertIn(f"lists all {len(COMMANDS)} commands", self.help())
        self.assertEqual(self.holds("help", "all"), page)

    def test_the_program_for_a_verdict_has_that_command_and_no_other(self):
        def said(*words):
            done = subprocess.run([Path(TOOL).with_name("contact-certify"), *words], capture_output=True, text=True, timeout=60)
            return done.returncode, done.stdout or done.stderr
        status, page = said("--help")
        self.assertEqual((status, {heading: names for heading, names in sections(page).items() if heading in HEADINGS}),
                         (0, {"Judge an engine": ["certify"], "Help": ["help"]}))
        self.assertEqual(said("help", "all"), said("--help-all"))
        self.assertEqual(said("certify", "--help"), (0, self.help("certify")))
        self.assertEqual(said("explain"), (2, "contact-oracle: unknown command 'explain'; `contact-oracle help all` lists them\n"))

    def test_the_options_of_certify_stand_under_headings(self):
        found = sections(self.help("certify"))
        self.assertEqual(list(found), ["Arguments", "Engine", "Questions", "What passes", "Reports", "Long runs", "Options"])
        for heading, options in {"Engine": ["--engine", "--engine-command", "--engine-library", "--results"],
                                 "Questions": ["--family", "--failures-of", "--generate"],
                                 "What passes": ["--level", "--tolerance", "--profile", "--allow-unsupported", "--determinism", "--baseline"],
                                 "Reports": ["--report", "--json", "--junit", "--markdown", "--certificate", "--record"],
                                 "Long runs": ["--fail-fast", "--max-time", "--parts", "--shards", "--shard"]}.items():
            self.assertLessEqual(set(options), set(found[heading]), heading)

    def test_every_page_is_narrow_says_no_path_of_this_machine_and_comes_in_two_ways(self):
        for page in PAGES:
            with self.subTest(page):
                said = self.help(*page)
                self.assertEqual(self.holds("help", *page), said)
                self.assertNotIn(str(ROOT), said)
                self.assertIn(f"Usage: contact-oracle {' '.join(page)}", said)
                own = said.split("A scene is JSON lines")[0]
                self.assertLessEqual(max(map(len, own.splitlines())), 80)
        self.refused(("help", "nonesuch"), "nonesuch")
        self.refused(("help", "exam", "nonesuch"), "exam nonesuch")

    def test_an_unknown_command_is_named_behind_options_too(self):
        self.refused(("--quiet", "nonesuch", "x"), "unknown command 'nonesuch'", "help all")


class Json(Case):
    """--json alone prints JSON and no words; --json=FILE writes the same into a file, and the words are printed."""

    def setUp(self):
        super().setUp()
        lines = committed("sphere_sphere/touching.jsonl", 0, 5)
        self.dataset = self.file("d.jsonl", lines)
        self.query = self.file("q.jsonl", [SPHERES])
        self.parts = self.folder / "parts"
        self.holds("certify", self.dataset, "--engine", "production", "--parts", self.parts, "--shards", 2)
        self.results, self.scene = self.file("r.jsonl", answers_to(lines)), self.file("scene.jsonl", SCENE)

    def commands(self):
        """Each command that has --json, with arguments for it, and whether the file may stand behind a space."""
        return [(("certify", self.dataset, "--results", self.results), True), (("merge", self.parts), True),
                (("properties", "--cases", 3, "--seed", 5), True), (("explain", self.query), False), (("detect", self.scene), False),
                (("engines",), False), (("engines", "--mutants"), False), (("pairs",), False), (("families",), False)]

    def test_each_command_that_has_it_is_looked_at_here(self):
        have = [page for page in PAGES if re.search(r"(?m)^  --json\b", self.help(*page))]
        looked_at = {args[0] for args, _ in self.commands()}
        self.assertEqual([page for page in have if page[0] not in looked_at], [["exam", "close"]])
        for args, _ in self.commands():
            self.assertIn([args[0]], have)
        self.assertIn("--json [FILE]", self.help("exam", "close"))

    def test_it_means_the_same_in_each(self):
        for args, spaced in self.commands():
            with self.subTest(args):
                words = self.holds(*args)
                alone = self.holds(*args, "--json")
                for one in [alone] if args[0] in ("certify", "merge", "properties") else alone.splitlines():
                    self.assertIsInstance(json.loads(one), dict)
                self.assertEqual(self.holds(args[0], "--json=-", *args[1:]), alone)
                for spelling in [["--json={}"], *([["--json", "{}"]] if spaced else [])]:
                    path = self.folder / "out.json"
                    self.assertEqual(self.holds(*args, *(one.format(path) for one in spelling)), words)
                    self.assertEqual(path.read_text(), alone)
                    path.unlink()

    def test_what_is_no_json_goes_to_standard_error(self):
        done = run("certify", "--family", "flat", "--engine", "production", "--json", "--report", self.folder / "r.html")
        self.assertEqual(done.returncode, 0)
        self.assertTrue(json.loads(done.stdout)["certified"])
        self.assertEqual(done.stderr, f"golden files: {GOLDEN}\n\nReport: {self.folder / 'r.html'}\n")

    def test_a_question_behind_it_is_a_question_and_no_file_to_write(self):
        before = self.query.read_bytes()
        self.assertEqual(self.holds("explain", "--json", self.query), self.holds("explain", self.query, "--json"))
        self.assertEqual(self.holds("detect", "--json", self.scene), self.holds("detect", self.scene, "--json"))
        self.assertEqual(self.query.read_bytes(), before)
        self.refused(("explain", self.query, f"--json={self.query}"), self.query, "would be written over")

    def test_a_dataset_behind_it_is_not_written_over_by_a_report(self):
        before = self.dataset.read_bytes()
        for command in ("certify", "properties"):
            self.refused((command, "--engine", "production", "--json", self.dataset), self.dataset, "would be written over", one_line=False)
        self.assertEqual(self.dataset.read_bytes(), before)

    def test_the_refutation_of_an_engine_is_its_exit_status(self):
        done = run("certify", TOUCHING, "--engine", "plain-double", "--json")
        self.assertEqual((done.returncode, done.stderr, json.loads(done.stdout)["certified"]), (1, "", False))


class Quiet(Case):
    def test_no_command_prints_words_and_the_exit_status_is_the_same(self):
        out = self.folder / "out.jsonl"
        known, other = self.folder / "known.json", self.folder / "other.json"
        self.refuted("certify", TOUCHING, "--engine", "plain-double", "--json", known)
        self.holds("certify", TOUCHING, "--engine", "production", "--json", other)
        certificate = self.folder / "c.json"
        self.holds("certify", FLAT, "--engine", "production", "--certificate", certificate)
        exam, key, answers = (self.folder / name for name in ("e.jsonl", "k.json", "a.jsonl"))
        self.holds("certify", FLAT, "--engine", "production", "--parts", self.folder / "p", "--shards", 2)
        table = [(1, "certify", TOUCHING, "--engine", "plain-double"), (0, "certify", "--family", "flat", "--engine", "production"),
                 (0, "certify", "--generate", 2, "--family", "flat"), (1, "certify", TOUCHING, "--failures-of", known, "--engine", "plain-double"),
                 (0, "properties", "--cases", 3), (1, "compare", other, known), (0, "exam", "new", "-o", exam, "--key", key, "--count", 1),
                 (0, "exam", "take", exam, "-o", answers), (0, "exam", "close", "--key", key, "--results", answers),
                 (0, "merge", self.folder / "p"), (0, "verify", certificate), (0, "badge", certificate, "-o", self.folder / "b.svg"),
                 (0, "detect", self.file("scene.jsonl", SCENE)), (0, "generate", "--pair", "cube_cube", "--family", "flat", "--count", 2, "--seed", 1, "-o", out),
                 (0, "annotate", self.file("q.jsonl", [SPHERES]), "-o", out),
                 (0, "export", "--language", "c", "--pair", "cube_cube", "-o", self.folder / "t.c"), (0, "convert", FLAT, "-o", out), (0, "lint", FLAT)]
        for status, *args in table:
            for words in ((*args, "--quiet"), ("--quiet", *args)) if args[0] in ("certify", "lint") else ((args[0], "--quiet", *args[1:]),):
                with self.subTest(words):
                    done = run(*words)
                    self.assertEqual((done.returncode, done.stdout, done.stderr), (status, "", ""))
        for path in (out, answers, self.folder / "b.svg"):
            self.assertTrue(path.exists(), path)
        # The rest maintain files, which takes longer, or print what they are asked for, which is no word too many.
        self.assertEqual({args[0] for _, *args in table} ^ set(COMMANDS),
                         {"explain", "serve", "engines", "pairs", "families", "regenerate", "adequacy", "digests", "help", "completion", "man"})

    def test_data_that_was_asked_for_is_printed(self):
        question = text([SPHERES])
        for args in (("explain",), ("explain", "--json"), ("pairs",), ("families", "--json"), ("completion", "bash")):
            with self.subTest(args):
                self.assertEqual(self.holds(*args, "--quiet", stdin=question), self.holds(*args, stdin=question))
        made = ("generate", "--pair", "cube_cube", "--family", "flat", "--count", 3, "--seed", 1, "--digest")
        self.assertEqual(self.holds(*made, "-o", self.folder / "x.jsonl", "--quiet"), self.holds(*made))
        self.assertTrue(json.loads(self.holds("certify", FLAT, "--engine", "production", "--json", "--quiet"))["certified"])

    def test_errors_are_told(self):
        self.refused(("certify", self.folder / "gone.jsonl", "--quiet"), "gone.jsonl")
        self.refused(("certify", "--quiet", "--nonesuch"), "--nonesuch", one_line=False)


class Colour(Case):
    ARGS = ("certify", TOUCHING, "--engine", "plain-double")

    def test_always_and_never_are_obeyed_wherever_they_stand(self):
        plain = self.refuted(*self.ARGS)
        environment = {**os.environ, "NO_COLOR": "1"}
        for args in (("--color", "always", *self.ARGS), (*self.ARGS, "--color=always"), ("certify", "--color", "always", *self.ARGS[1:])):
            done = run(*args, env=environment)
            self.assertEqual(done.returncode, 1)
            self.assertIn("\x1b[31m", done.stdout)
            self.assertEqual(re.sub(r"\x1b\[[0-9;]*m", "", done.stdout), plain)
        for when in ("auto", "never"):
            self.assertEqual(self.refuted(*self.ARGS, "--color", when), plain)
        self.refused((*self.ARGS, "--color", "sometimes"), "sometimes", "auto", one_line=False)


# What is typed, and what may come next: all of it, or with more behind.
TYPED = [
    (["cer"], ["certify"]), (["exam", ""], ["new", "take", "close"]), (["certify", "--le"], ["--level", "--least-judged"]),
    (["certify", "--level", "con"], ["conservative"]), (["certify", "--level=con"], ["--level=conservative"]),
    (["generate", "--pair", "sphere_c"], ["sphere_cube", "sphere_capsule"]), (["certify", "--generate", "5", "--pair", "cube_cube,ray_s"], ["cube_cube,ray_sphere"]),
    (["generate", "--family", "touching_no"], []), (["certify", "--family", "touching,flat_t", ], []),
    (["certify", "--engine", "publ"], ["published"]), (["certify", "--engine", "mutant:rapier-coincident-"], ["mutant:rapier-coincident-nan"]),
    (["certify", "--engine", "uns"], ["unsteady:"]), (["properties", "--law", "touc"], ["touching"]), (["--color", "al"], ["always"]),
    (["certify", "--color", "ne"], ["never"]), (["certify", "--qui"], ["--quiet"]), (["help", "verif"], ["verify"]), (["man", "b"], ["badge"]),
    (["completion", "z"], ["zsh"]), (["exam", "take", "--engine-c"], ["--engine-command"]), (["digests", "--count", "100"], ["10000", "1000000"]),
]


class Completion(Case):
    def complete(self, *words):
        return [one.split("\t")[0] for one in self.holds("complete", "--", *words).splitlines()]

    def test_what_may_come_next_is_what_the_parser_knows(self):
        for words, right in TYPED:
            with self.subTest(words):
                self.assertEqual(self.complete(*words), right)
        self.assertEqual(self.complete(""), COMMANDS)
        listed = {json.loads(one).get("family") for one in self.holds("families", "--json").splitlines()} - {None}
        self.assertEqual(set(self.complete("certify", "--family", "")), listed)
        engines = {json.loads(one)["name"] for one in self.holds("engines", "--json").splitlines()}
        self.assertEqual(set(self.complete("certify", "--engine", "mutant:")), {one for one in engines if one.startswith("mutant:")})
        self.assertEqual(set(self.complete("certify", "--engine", "")), {one for one in engines if ":" not in one} | {"mutant:", "unsteady:"})

    def test_every_option_that_help_shows_is_completed_and_no_other(self):
        common = {"--help", "--help-all", "--version", "--quiet", "--color"}
        for page in PAGES:
            with self.subTest(page):
                shown = set(re.findall(r"(?m)^  (?:-[a-z],)?(--[a-z-]+)", self.help(*page)))
                self.assertEqual(set(self.complete(*page, "--")) - common, shown - common)

    def test_files_and_folders_are_left_to_the_shell(self):
        for words, right in ((["certify", ""], [":files"]), (["certify", "--json", ""], [":files"]), (["certify", "--baseline", "x"], [":files"]),
                             (["certify", "--parts", ""], [":folders"]), (["generate", "--all", ""], [":folders"]), (["certify", "--report=x"], [":files"]),
                             (["explain", "--json=x"], [":files"]), (["certify", "--", "--le"], [":files"]), (["certify", "--jobs", ""], []),
                             (["certify", "--fail-fast", "x"], [":files"]), (["lint", "a.jsonl", "b"], [":files"]), (["engines", ""], [])):
            with self.subTest(words):
                self.assertEqual(self.complete(*words), right)

    def environment(self):
        return {**os.environ, "PATH": f"{os.path.dirname(TOOL)}:{os.environ['PATH']}", "TERM": "dumb", "HOME": str(self.folder)}

    def script(self, shell):
        if shutil.which(shell) is None:
            self.skipTest(f"no {shell} here: Debian's package {shell}")
        return self.file(f"script.{shell}", self.holds("completion", shell))

    def test_bash_has_the_same_answers(self):
        script = self.script("bash")
        cut = lambda word: re.findall(r"[=:]|[^=:]+", word) or [""]  # as readline does
        for words, right in TYPED:
            pieces = [piece for word in ["contact-oracle", *words] for piece in cut(word)]
            done = subprocess.run(["bash", "--norc", "-c", 'source "$1"; shift; complete -p contact-oracle; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); '
                                   'COMP_WORDBREAKS=" =:"; _contact_oracle; for one in "${COMPREPLY[@]}"; do echo "$one"; done', "bash", script, *pieces],
                                  capture_output=True, text=True, env=self.environment(), timeout=300)
            self.assertEqual((done.returncode, done.stderr), (0, ""), words)
            registered, *found = done.stdout.splitlines()
            self.assertEqual(registered, "complete -F _contact_oracle contact-oracle")
            # Readline puts it in the place of what stands behind the last = or :.
            kept = re.match(r"(.*[=:])?", words[-1])[0]
            self.assertEqual([kept + one for one in found], right, words)

    def typed(self, shell, set_up, keys):
        """What stands on the line of an interactive shell when keys were typed, among them tabs."""
        try:
            pid, terminal = pty.fork()
        except OSError as error:
            self.skipTest(f"no terminal can be made here: {error}")
        if pid == 0:
            os.chdir(self.folder)
            os.execvpe(shell[0], shell, self.environment())
        self.addCleanup(os.waitpid, pid, 0)
        self.addCleanup(os.kill, pid, 9)
        self.addCleanup(os.close, terminal)
        said = b""

        def wait_for(pattern):
            nonlocal said
            deadline = time.monotonic() + 300
            while not (found := re.search(pattern, said)):
                self.assertLess(time.monotonic(), deadline, said)
                if select.select([terminal], [], [], 1)[0]:
                    said += os.read(terminal, 65536)
            said = said[found.end():]
            return found
        os.write(terminal, f"{set_up}\necho re''ady\n".encode())
        wait_for(rb"ready\r?\n")
        os.write(terminal, keys.encode() + b"\x18\x18")
        return wait_for(rb"<<(.*?)>>")[1].decode()

    def test_a_tab_completes_in_bash(self):
        script = self.script("bash")
        (self.folder / "some file.jsonl").write_text("")
        set_up = f"""PS1='$ '; source {script}; bind -x '"\\C-x\\C-x": echo "<<$READLINE_LINE>>"'"""
        for keys, right in (("contact-oracle certi\t", "contact-oracle certify "), ("contact-oracle certify --level=cor\t", "contact-oracle certify --level=correctly-rounded "),
                            ("contact-oracle certify --engine mutant:rapier-coincident-n\t", "contact-oracle certify --engine mutant:rapier-coincident-nan "),
                            ("contact-oracle lint some\t", r"contact-oracle lint some\ file.jsonl "), ("contact-oracle certify --engine uns\t", "contact-oracle certify --engine unsteady:")):
            with self.subTest(keys):
                self.assertEqual(self.typed(["bash", "--norc", "--noprofile", "-i"], set_up, keys), right)

    def test_a_tab_completes_in_zsh(self):
        script = self.script("zsh")
        (self.folder / "some file.jsonl").write_text("")
        show = "show() { print -r -- \"<<$BUFFER>>\" }; zle -N show; bindkey '^X^X' show"
        set_up = f"PS1='$ '; autoload -U compinit; compinit -u -D; source {script}; {show}"
        for keys, right in (("contact-oracle certi\t", "contact-oracle certify "), ("contact-oracle certify --level=cor\t", "contact-oracle certify --level=correctly-rounded "),
                            ("contact-oracle certify --engine mutant:rapier-coincident-n\t", "contact-oracle certify --engine mutant:rapier-coincident-nan "),
                            ("contact-oracle lint some\t", r"contact-oracle lint some\ file.jsonl "), ("contact-oracle certify --engine uns\t", "contact-oracle certify --engine unsteady:")):
            with self.subTest(keys):
                self.assertEqual(self.typed(["zsh", "-f", "-i"], set_up, keys), right)
        # As it is installed: a file that zsh loads by its name.
        (self.folder / "functions").mkdir()
        script.rename(self.folder / "functions" / "_contact-oracle")
        set_up = f"PS1='$ '; fpath=({self.folder}/functions $fpath); autoload -U compinit; compinit -u -D; {show}"
        self.assertEqual(self.typed(["zsh", "-f", "-i"], set_up, "contact-oracle certify --lev\t"), "contact-oracle certify --level ")

    def test_fish_has_the_same_answers(self):
        script = self.script("fish")
        (self.folder / "some.jsonl").write_text("")
        (self.folder / "someplace").mkdir()
        for words, right in [*TYPED, (["lint", "som"], ["some.jsonl", "someplace/"]), (["certify", "--parts", "som"], ["someplace/"]),
                             (["certify", "--report=some."], ["--report=some.jsonl"])]:
            done = subprocess.run(["fish", "--no-config", "-c", f"source {script}; complete -C 'contact-oracle {' '.join(words)}'"],
                                  capture_output=True, text=True, env=self.environment(), timeout=300, cwd=self.folder)
            self.assertEqual((done.returncode, done.stderr), (0, ""), words)
            found = [one.split("\t")[0] for one in done.stdout.splitlines()]
            self.assertEqual(sorted(found), sorted(right), words)

    def test_another_shell_is_refused(self):
        self.refused(("completion", "tcsh"), "tcsh", one_line=False)


class Manual(Case):
    def page(self, *command, **variables):
        environment = {key: value for key, value in os.environ.items() if key != "SOURCE_DATE_EPOCH"}
        return self.holds("man", *command, env={**environment, **variables})

    def test_every_page_has_every_option_of_its_command_and_passes_the_readers_checks(self):
        dated = {"SOURCE_DATE_EPOCH": "1600000000"}
        for command in [(), *((one,) for one in COMMANDS)]:
            with self.subTest(command):
                page = self.page(*command, **dated)
                title = "-".join(["contact-oracle", *command]).upper().replace("-", r"\-")
                self.assertTrue(page.startswith(f'.TH "{title}" "1" "2020-09-13" "contact\\-oracle '), page[:200])
                self.assertNotIn(str(ROOT), page)
                pages = [command] if command != ("exam",) else [("exam", one) for one in ("new", "take", "close")]
                for shown in re.findall(r"(?m)^  ((?:-[a-z],)?--[a-z-]+)", "".join(map(lambda one: self.help(*one), pages))):
                    for option in shown.split(","):
                        self.assertIn(rf"\fB{option}\fR".replace("-", r"\-"), page)
                if shutil.which("mandoc"):
                    done = subprocess.run(["mandoc", "-T", "lint", "-W", "warning"], input=page, capture_output=True, text=True, timeout=300)
                    self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
                if shutil.which("groff"):
                    done = subprocess.run(["groff", "-man", "-T", "utf8", "-ww", "-z"], input=page, capture_output=True, text=True, timeout=300)
                    self.assertEqual((done.returncode, done.stderr), (0, ""))
        if not shutil.which("mandoc") and not shutil.which("groff"):
            self.skipTest("neither mandoc nor groff here: Debian's package mandoc")

    def test_a_page_is_the_same_every_day(self):
        page = self.page("certify")
        self.assertIn(' "1" "" "', page.splitlines()[0])
        self.assertEqual(self.page("certify"), page)
        changed = self.page("certify", SOURCE_DATE_EPOCH="1600000000").splitlines()
        self.assertEqual(changed[1:], page.splitlines()[1:])

    def test_all_pages_are_written_at_once(self):
        pages = self.folder / "pages"
        self.assertEqual(self.holds("man", "--all", pages, "--quiet"), "")
        self.assertEqual({path.name: path.read_text() for path in pages.iterdir()},
                         {"-".join(["contact-oracle", *command]) + ".1": self.page(*command) for command in [(), *((one,) for one in COMMANDS)]})

    def test_what_has_no_page_is_refused(self):
        self.refused(("man", "nonesuch"), "nonesuch")
        self.refused(("man", "complete"), "complete")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
