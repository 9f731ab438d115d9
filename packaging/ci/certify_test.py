#!/usr/bin/env python3
"""packaging/ci/certify.sh as build servers call it:   certify_test.py CONTACT-ORACLE

The program is the real one. Where a build server is asked for what a test must not do, stand-ins do it: root, the network, and a program that
ends with every exit status that there is."""
import hashlib
import json
import os
import shutil
import stat
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "packaging/ci/certify.sh"
TOOL = Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else None
PLAIN = f"{sys.executable} {ROOT}/docs/examples/engines/plain.py"
GENERIC = ROOT / "golden/sphere_sphere/generic.jsonl"
TOUCHING = ROOT / "golden/sphere_sphere/touching.jsonl"

RECORDER = """#!/usr/bin/env python3
import json, os, sys
with open(os.environ["RECORD"], "a") as record:
    record.write(json.dumps(sys.argv[1:]) + "\\n")
sys.exit(int(os.environ.get("STATUS_OF_" + sys.argv[1].upper(), 0)))
"""
# Unpacks instead of installing; the package is the last word.
APT = """#!/usr/bin/env bash
echo "$@" >>"$STANDIN/apt"
if [ "$1" = install ]; then dpkg-deb -x "${@: -1}" "$STANDIN/root"; cp "$STANDIN/root/usr/bin/contact-oracle" "$STANDIN/bin/"; fi
"""
CURL = """#!/usr/bin/env bash
echo "${@: -1}" >>"$STANDIN/curl"
while [ "$1" != -o ]; do shift; done
cp "$STANDIN/release.deb" "$2"
"""


class Script(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.bin = self.folder / "bin"
        self.bin.mkdir()

    def program(self, name, text):
        path = self.bin / name
        path.write_text(text)
        path.chmod(path.stat().st_mode | stat.S_IXUSR | stat.S_IXGRP | stat.S_IXOTH)

    def run_script(self, status, script=SCRIPT, **variables):
        names = {("CONTACT_" + name.upper() if name.islower() else name): str(value) for name, value in variables.items()}
        environment = {name: value for name, value in os.environ.items() if not name.startswith(("CONTACT_", "GITHUB_"))}
        environment |= {"PATH": f"{self.bin}:{os.environ['PATH']}", "STANDIN": str(self.folder), "RECORD": str(self.folder / "record"),
                        "GITHUB_STEP_SUMMARY": str(self.folder / "summary"), "GITHUB_OUTPUT": str(self.folder / "output"), **names}
        done = subprocess.run([str(script)], cwd=self.folder, env=environment, capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def output(self):
        return dict(line.split("=", 1) for line in (self.folder / "output").read_text().splitlines())


class Judged(Script):
    def setUp(self):
        super().setUp()
        (self.bin / "contact-oracle").symlink_to(TOOL)

    def test_a_certified_engine_ends_with_0_and_leaves_four_reports(self):
        done = self.run_script(0, engine_command=PLAIN, datasets=GENERIC)
        self.assertIn("CERTIFIED: plain-python 1", done.stdout)
        reports = self.folder / "contact-oracle-reports"
        self.assertEqual(sorted(path.name for path in reports.iterdir()), ["contacts.html", "contacts.json", "contacts.md", "contacts.xml"])
        self.assertEqual((self.folder / "summary").read_text(), (reports / "contacts.md").read_text())
        self.assertEqual(self.output(), {"status": "0", "reports": "contact-oracle-reports"})
        self.assertEqual(ElementTree.parse(reports / "contacts.xml").getroot().tag, "testsuites")

    def test_a_refuted_engine_ends_with_1_and_the_summary_says_why(self):
        self.run_script(1, engine_command=PLAIN, datasets=f"{GENERIC}\n{TOUCHING}", reports="here")
        self.assertIn("REFUTED", (self.folder / "summary").read_text())
        self.assertEqual(self.output()["status"], "1")
        self.assertTrue((self.folder / "here/contacts.html").is_file())

    def test_a_tolerance_and_more_words_reach_certify(self):
        self.run_script(0, engine_command=PLAIN, datasets=TOUCHING, tolerance="length=1e-6,relative=1e-9,angle=1e-6", arguments="--jobs\n2\n\n--determinism")
        self.assertIn("5 more ways", (self.folder / "summary").read_text())

    def test_bad_input_ends_with_2_and_the_summary_sends_to_the_log(self):
        self.run_script(2, engine_command=PLAIN, datasets=GENERIC, level="perfect")
        self.assertIn("exit status 2", (self.folder / "summary").read_text())
        self.assertFalse((self.folder / "contact-oracle-reports/contacts.xml").exists())

    def test_an_engine_that_never_answers_ends_with_3(self):
        self.run_script(3, engine_command="false", datasets=GENERIC)
        self.assertEqual(self.output()["status"], "3")

    def test_recorded_answers_are_judged(self):
        self.run_script(1, results=ROOT / "golden/recorded/sofa-2a278d8/sphere_sphere.jsonl", datasets=ROOT / "golden/sphere_sphere", family="upstream")
        self.assertIn("SOFA", (self.folder / "summary").read_text())

    def test_laws_are_asked_and_their_status_counts(self):
        self.run_script(1, engine_command=PLAIN, datasets=GENERIC, laws=100)
        self.assertIn("decision", (self.folder / "contact-oracle-reports/laws.xml").read_text())
        self.assertRegex(json.loads((self.folder / "contact-oracle-reports/contacts.json").read_text())["verdict"], "^CERTIFIED")

    def test_reports_of_an_earlier_run_do_not_pass_for_those_of_this_one(self):
        self.run_script(0, engine_command=PLAIN, datasets=GENERIC)
        (self.folder / "summary").unlink()
        self.run_script(2, engine_command=PLAIN, datasets=self.folder / "nowhere.jsonl")
        self.assertEqual(list((self.folder / "contact-oracle-reports").iterdir()), [])
        self.assertIn("judged nothing", (self.folder / "summary").read_text())


class Words(Script):
    def setUp(self):
        super().setUp()
        self.program("contact-oracle", RECORDER)

    def words(self):
        return [json.loads(line) for line in (self.folder / "record").read_text().splitlines()]

    def test_every_exit_status_is_kept(self):
        for status in (0, 1, 2, 3, 4, 130):
            self.run_script(status, engine_command="x", STATUS_OF_CERTIFY=status)
            self.assertEqual(self.output()["status"], str(status))
            self.run_script(max(status, 1), engine_command="x", laws=1, STATUS_OF_CERTIFY=status, STATUS_OF_PROPERTIES=1)

    def test_what_a_user_writes_is_one_word_and_no_command(self):
        hostile = "a'b\" $(touch gone) `touch gone`; touch gone && touch gone | x"
        self.run_script(0, engine_command=hostile, datasets=f"{hostile}\n\n two words ", level=hostile, arguments="--jobs\n$(touch gone)",
                        reports="the reports")
        reports = ["--report", "the reports/contacts.html", "--junit", "the reports/contacts.xml", "--markdown", "the reports/contacts.md",
                   "--json", "the reports/contacts.json"]
        self.assertEqual(self.words(), [["certify", hostile, "two words", "--engine-command", hostile, "--level", hostile, "--seed", "42", *reports, "--jobs",
                                         "$(touch gone)"]])
        self.assertFalse((self.folder / "gone").exists())

    def test_the_seed_is_always_the_same_where_any_is_of_use(self):
        for variables, fresh in (({}, ["--seed", "42"]), ({"seed": 7, "fresh": 20}, ["--fresh", "20", "--seed", "7"]), ({"fresh": 0}, ["--fresh", "0"]),
                                 ({"baseline": "b"}, []), ({"arguments": "--seed=3"}, []), ({"arguments": "--fresh\n0"}, [])):
            self.run_script(0, engine_command="x", **variables)
            words = self.words()[-1]
            self.assertEqual([word for word in words[words.index("x") + 1:words.index("--report")] if word not in ("--baseline", "b")], fresh, variables)
        self.run_script(0, results="x")
        self.assertNotIn("--seed", self.words()[-1])

    def test_a_folder_of_reports_is_no_second_output(self):
        self.assertIn("line feed", self.run_script(2, engine_command="x", reports="reports\nstatus=0").stderr)
        self.assertFalse((self.folder / "output").exists())

    def test_no_engine_or_two_engines_are_refused_and_nothing_is_judged(self):
        for engines in ({}, {"engine_command": ""}, {"engine_command": "x", "results": "y"}):
            done = self.run_script(2, **engines)
            self.assertIn("name one engine", done.stderr)
        self.assertFalse((self.folder / "record").exists())


@unittest.skipUnless(shutil.which("dpkg-deb"), "no dpkg-deb here")
class Installation(Script):
    """No program is there: one comes from a package."""

    def setUp(self):
        super().setUp()
        tree = self.folder / "tree"
        (tree / "DEBIAN").mkdir(parents=True)
        (tree / "DEBIAN/control").write_text("Package: contact-oracle\nVersion: 7.8.9\nArchitecture: all\nMaintainer: nobody <no@body.example>\n"
                                             "Description: records its words\n")
        (tree / "usr/bin").mkdir(parents=True)
        (tree / "usr/bin/contact-oracle").write_text(RECORDER)
        (tree / "usr/bin/contact-oracle").chmod(0o755)
        self.deb = self.folder / "release.deb"
        subprocess.run(["dpkg-deb", "--root-owner-group", "-b", tree, self.deb], check=True, capture_output=True)
        self.program("apt-get", APT)
        self.program("curl", CURL)
        self.program("sudo", '#!/bin/sh\nexec "$@"\n')
        self.assertIsNone(shutil.which("contact-oracle"), "these tests need a PATH without contact-oracle")

    def action(self):
        """The files of an action as a runner lays them out."""
        folder = self.folder / "_actions/some-owner/some-name/v7"
        (folder / "packaging/ci").mkdir(parents=True)
        shutil.copy2(SCRIPT, folder / "packaging/ci")
        (folder / "CMakeLists.txt").write_text("project(contact-oracle VERSION 7.8.9 LANGUAGES CXX\n")
        return folder

    def test_the_package_of_the_release_of_the_action_is_loaded_and_installed(self):
        folder = self.action()
        self.run_script(0, script=folder / "packaging/ci/certify.sh", engine_command="x", GITHUB_ACTION_PATH=folder,
                        GITHUB_SERVER_URL="https://server.example")
        architecture = subprocess.run(["dpkg", "--print-architecture"], check=True, capture_output=True, text=True).stdout.strip()
        self.assertEqual((self.folder / "curl").read_text(),
                         f"https://server.example/some-owner/some-name/releases/download/v7.8.9/contact-oracle_7.8.9-1_{architecture}.deb\n")
        self.assertIn("--engine-command", (self.folder / "record").read_text())

    def test_another_version_and_another_repository_can_be_named(self):
        folder = self.action()
        self.run_script(0, script=folder / "packaging/ci/certify.sh", engine_command="x", GITHUB_ACTION_PATH=folder, version="1.2.3",
                        repository="other/place")
        self.assertRegex((self.folder / "curl").read_text(), r"^https://github\.com/other/place/releases/download/v1\.2\.3/contact-oracle_1\.2\.3-1_")

    def test_a_file_is_installed_without_the_network(self):
        self.run_script(0, engine_command="x", package=self.deb)
        self.assertFalse((self.folder / "curl").exists())
        self.assertEqual([line.split()[0] for line in (self.folder / "apt").read_text().splitlines()], ["update", "install"])

    def test_a_package_with_another_digest_is_not_installed(self):
        done = self.run_script(2, engine_command="x", package=self.deb, sha256="0" * 64)
        self.assertIn("has the SHA-256", done.stderr)
        self.assertNotIn("install", (self.folder / "apt").read_text())
        self.run_script(0, engine_command="x", package=self.deb, sha256=hashlib.sha256(self.deb.read_bytes()).hexdigest())

    def test_what_cannot_be_loaded_or_installed_is_said_with_status_2(self):
        for name, words in (("apt-get", "could not install"), ("curl", "could not load")):
            self.program(name, "#!/bin/sh\n[ \"$1\" = update ]\n")
            self.assertIn(words, self.run_script(2, engine_command="x", package="https://server.example/x.deb").stderr)

    def test_where_nothing_says_which_package_it_is_bad_input(self):
        self.assertIn("which package", self.run_script(2, engine_command="x").stderr)


if __name__ == "__main__":
    unittest.main()
