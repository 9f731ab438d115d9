#!/usr/bin/env python3
"""The program as it is installed, and after its tree was moved: python3 tool/install_test.py BUILD [unittest arguments]."""
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from published import published

BUILD = os.path.abspath(sys.argv[1]) if len(sys.argv) > 1 else sys.exit(__doc__)
ROOT = Path(__file__).resolve().parent.parent


def run(*command, **options):
    return subprocess.run(published(command), **{"capture_output": True, "text": True, "timeout": 600, **options})


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.empty = Path(scratch.name, "empty")
        cls.empty.mkdir()
        first = Path(scratch.name, "first")
        installed = run("cmake", "--install", BUILD, "--component", "program", "--prefix", first)
        assert installed.returncode == 0, installed.stderr
        cls.prefix = Path(scratch.name, "a place of its own")
        first.rename(cls.prefix)
        cls.program = cls.prefix / "bin" / "contact-oracle"
        cls.data = cls.prefix / "share" / "contact-oracle"

    def ask(self, *arguments):
        return run(self.program, *arguments, cwd=self.empty)

    def test_every_golden_file_of_the_manifest_is_there_byte_for_byte(self):
        for file in json.loads((ROOT / "golden" / "manifest.json").read_text())["files"]:
            with self.subTest(file["path"]):
                self.assertEqual(hashlib.sha256((self.data / "golden" / file["path"]).read_bytes()).hexdigest(), file["sha256"])
        self.assertEqual([path.name for path in (self.data / "golden").rglob("*.[ch]pp")], [])

    def test_a_verdict_rests_on_the_golden_files_beside_the_program(self):
        done = self.ask("certify", "--engine", "production", "--family", "touching", "--level", "correctly-rounded")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"golden files: {self.data / 'golden'}\n", done.stdout)
        self.assertIn("CERTIFIED", done.stdout)

    def test_a_question_is_found_by_its_id(self):
        with (ROOT / "golden/capsule_plane/touching.jsonl").open() as file:
            wanted = json.loads(file.readlines()[1])["id"]
        done = self.ask("explain", wanted[:16])
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"capsule_plane {wanted}\n", done.stdout)

    def test_an_adapter_of_the_examples_is_judged(self):
        done = self.ask("certify", self.data / "golden/sphere_sphere/touching.jsonl", "--engine-command",
                        f"{sys.executable} '{self.data / 'examples/plain.py'}'")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("REFUTED: plain-python", done.stdout)

    def test_a_link_to_the_program_does(self):
        link = self.empty / "oracle"
        link.symlink_to(self.program)
        self.addCleanup(link.unlink)
        done = run(link, "certify", "--engine", "production", "--family", "touching", cwd="/")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_without_its_data_the_program_says_what_is_missing(self):
        alone = self.empty / "alone"
        alone.mkdir()
        self.addCleanup(shutil.rmtree, alone)
        shutil.copy(self.program, alone / "contact-oracle")
        done = run(alone / "contact-oracle", "certify")
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr, f"contact-oracle: {alone / 'contact-oracle'}: no golden files lie beside the program "
                                      "(share/contact-oracle): name a dataset\n")
        dataset = self.data / "golden/cube_cube/touching.jsonl"
        self.assertEqual(run(alone / "contact-oracle", "certify", dataset).returncode, 0)
        self.assertEqual(run(alone / "contact-oracle", "--help").returncode, 0)
        self.assertEqual(run(alone / "contact-oracle", "certify", "--help").returncode, 0)

    def test_the_version_names_the_commit(self):
        version = re.search(r"^project\(contact-oracle VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(), re.MULTILINE)[1]
        commit = run("git", "-C", ROOT, "rev-parse", "--short=12", "HEAD").stdout.strip() if (ROOT / ".git").exists() else ""
        expected = f"contact-oracle {version}" + (f" (commit {commit})" if commit else "")
        done = self.ask("--version")
        self.assertEqual((done.returncode, done.stdout.strip()), (0, expected))

    def test_no_path_of_the_checkout_is_left(self):
        for path in (path for path in self.prefix.rglob("*") if path.is_file()):
            self.assertNotIn(os.fsencode(ROOT) + b"/", path.read_bytes(), path)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
