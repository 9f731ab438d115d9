#!/usr/bin/env python3
"""packaging/release.py in small repositories of its own:   release_test.py

The script is the real one. What it calls, ./run packages, .ci/run and sbom.py, is a few lines, so that each doubt can be made."""
import hashlib
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from datetime import datetime, timezone
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
TODAY = datetime.now(timezone.utc).strftime("%Y-%m-%d")
FILES = {
    "CMakeLists.txt": "project(contact-oracle VERSION 0.9.0 LANGUAGES CXX\n",
    "vcpkg.json": '{\n  "name": "contact-oracle",\n  "version": "0.9.0"\n}\n',
    "packaging/vcpkg/contact-oracle/vcpkg.json": '{\n  "version": "0.9.0"\n}\n',
    "python/pyproject.toml": '[project]\nname = "contact-oracle"\nversion = "0.9.0"\n',
    "CITATION.cff": f'cff-version: 1.2.0\nversion: 0.9.0\ndate-released: "{TODAY}"\n',
    "CHANGELOG.md": f"# Changelog\n\n## Unreleased\n\n## 0.9.0 ({TODAY})\n\n- It is there.\n\n## 0.8.0 (2020-01-01)\n\n- Before.\n",
    "packaging/debian/changelog": "contact-oracle (0.9.0-1) unstable; urgency=medium\n",
    ".gitignore": "/build/\n",
    ".ci/allowed-skips.txt": "# none\n",
    ".ci/run": "#!/bin/sh\nmkdir -p build\ncp reports/*.xml build/\n",
    "run": "#!/bin/sh\n[ \"$1\" = packages ] || exit 2\nmkdir -p build/packages/out\necho bytes >build/packages/out/contact-oracle_0.9.0-1_amd64.deb\n",
    "packaging/sbom.py": "import json, sys\nfrom pathlib import Path\nnames = [path.name for path in Path(sys.argv[5]).glob('*.deb')]\n"
                         "Path(sys.argv[3]).write_text(json.dumps({'name': 'contact-oracle-0.9.0', 'packages': [{'packageFileName': name} for name in names]}))\n",
}


def report(*cases, failures=0, tests=None, timestamp=None):
    timestamp = timestamp or datetime.now().isoformat(timespec="seconds")
    return (f'<testsuite name="x" tests="{len(cases) if tests is None else tests}" failures="{failures}" disabled="0" skipped="0" timestamp="{timestamp}">'
            + "".join(f'<testcase name="{name}" status="{status}"/>' for name, status in cases) + "</testsuite>\n")


class Release(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.root = self.folder / "repository"
        (self.folder / "keys").mkdir(mode=0o700)
        person = {f"GIT_{who}_{what}": value for who in ("AUTHOR", "COMMITTER") for what, value in (("NAME", "a"), ("EMAIL", "a@b.example"))}
        self.environment = {**os.environ, **person, "GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_NOSYSTEM": "1", "GNUPGHOME": str(self.folder / "keys")}
        for name in (".ci/skips.py", "packaging/release.py"):
            (self.root / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, self.root / name)
        for name, text in FILES.items():
            self.write(name, text)
        for name in ("run", ".ci/run"):
            (self.root / name).chmod(0o755)
        self.write("reports/readers-tests.xml", report(("core", "run"), timestamp="2100-01-01T00:00:00"))
        self.write("reports/release-tests.xml", report(("one", "run"), ("two", "run"), timestamp="2100-01-01T00:00:00"))
        self.git("init", "--quiet", "--initial-branch=main")
        self.commit()

    def write(self, name, text):
        (self.root / name).parent.mkdir(parents=True, exist_ok=True)
        (self.root / name).write_text(text)

    def edit(self, name, old, new):
        text = (self.root / name).read_text()
        self.assertIn(old, text)
        self.write(name, text.replace(old, new))
        self.commit()

    def git(self, *words):
        return subprocess.run(["git", *words], cwd=self.root, env=self.environment, check=True, capture_output=True, text=True).stdout.strip()

    def commit(self):
        self.git("add", "--all")
        self.git("commit", "--quiet", "--message", "x")

    def release(self, status, *words):
        done = subprocess.run([sys.executable, self.root / "packaging/release.py", *(words or ("0.9.0",))], cwd=self.folder, env=self.environment,
                              capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def doubt(self, pattern, *words):
        """A dry run, which asks the same as a release, has this one doubt."""
        said = self.release(1, "0.9.0", *words, "--dry-run").stderr
        self.assertRegex(said, r"\Arelease: .*" + pattern)
        self.assertEqual(said.count("release: "), 1, said)

    def nothing(self):
        self.assertEqual(self.git("tag"), "")
        self.assertEqual(list((self.root / "build").glob("*release-*/")), [])


class Done(Release):
    def test_a_dry_run_without_a_doubt_says_so_and_does_nothing(self):
        self.assertIn("no doubts; a release would run .ci/run,", self.release(0, "0.9.0", "--dry-run").stdout)
        self.nothing()
        self.assertFalse((self.root / "build").exists())

    def test_a_release_has_packages_notes_a_bill_digests_and_an_unsigned_tag_and_says_what_is_left(self):
        done = self.release(0)
        folder = self.root / "build/release-0.9.0"
        self.assertEqual(sorted(path.name for path in folder.iterdir()),
                         ["NOTES.md", "SHA256SUMS", "contact-oracle-0.9.0.spdx.json", "contact-oracle_0.9.0-1_amd64.deb"])
        self.assertEqual((folder / "NOTES.md").read_text(), "- It is there.\n")
        subprocess.run(["sha256sum", "--check", "--strict", "SHA256SUMS"], cwd=folder, check=True, capture_output=True)
        self.assertEqual(len((folder / "SHA256SUMS").read_text().splitlines()), 3)
        self.assertEqual(self.git("cat-file", "-t", "v0.9.0"), "tag")
        self.assertNotIn("BEGIN PGP SIGNATURE", self.git("cat-file", "tag", "v0.9.0"))
        self.assertIn("NOT signed", done.stdout)
        self.assertIn("git push origin main v0.9.0", done.stdout)
        self.assertIn("there is a tag v0.9.0", self.release(1).stderr)

    @unittest.skipUnless(shutil.which("gpg"), "no gpg here")
    def test_where_a_key_is_the_tag_and_the_digests_are_signed(self):
        subprocess.run(["gpg", "--batch", "--passphrase", "", "--quick-generate-key", "a <a@b.example>", "ed25519", "sign", "never"],
                       env=self.environment, check=True, capture_output=True)
        self.addCleanup(subprocess.run, ["gpgconf", "--kill", "gpg-agent"], env=self.environment, check=True)
        done = self.release(0)
        self.assertIn("are signed with", done.stdout)
        self.git("verify-tag", "v0.9.0")
        folder = self.root / "build/release-0.9.0"
        subprocess.run(["gpg", "--verify", folder / "SHA256SUMS.asc", folder / "SHA256SUMS"], env=self.environment, check=True, capture_output=True)

    def test_finished_reports_take_the_place_of_continuous_integration(self):
        self.edit(".ci/run", "#!/bin/sh", "#!/bin/sh\nexit 1")
        self.assertIn(".ci/run ended with 1", self.release(1).stderr)
        self.nothing()
        self.release(0, "0.9.0", "--tested", self.root / "reports/readers-tests.xml", self.root / "reports/release-tests.xml")


class Doubts(Release):
    def test_of_the_usage(self):
        for words in (("0.9",), ("v0.9.0",), ("0.9.0", "--publish")):
            self.assertIn("usage:", self.release(2, *words).stderr)

    def test_a_change_or_an_unknown_file(self):
        self.write("stray", "")
        self.doubt("not committed")
        (self.root / "stray").unlink()
        self.write("run", "")
        self.doubt("not committed")

    def test_another_branch(self):
        self.git("checkout", "--quiet", "-b", "other")
        self.doubt("the branch is other, not main")

    def test_another_version_in_any_place(self):
        for name in ("CMakeLists.txt", "vcpkg.json", "python/pyproject.toml", "CITATION.cff", "packaging/debian/changelog",
                     "packaging/vcpkg/contact-oracle/vcpkg.json"):
            with self.subTest(name):
                self.edit(name, "0.9.0", "0.9.1")
                self.doubt(f"{name}: the version is 0.9.1, not 0.9.0")
                self.edit(name, "0.9.1", "0.9.0")
        self.assertRegex(self.release(1, "0.8.0").stderr, "the version is 0.9.0, not 0.8.0")

    def test_a_release_stops_at_the_first_doubt_and_a_dry_run_tells_every_one(self):
        self.edit("vcpkg.json", "0.9.0", "0.9.1")
        self.write("stray", "")
        said = self.release(1, "0.9.0", "--dry-run")
        self.assertEqual(len(said.stderr.splitlines()), 2, said.stderr)
        self.assertIn("2 doubts;", said.stdout)
        self.assertRegex(self.release(1).stderr, r"\Arelease: the tree has changes.*\n\Z")
        self.nothing()

    def test_a_changelog_without_the_section_or_text_or_with_another_date(self):
        for old, new, pattern in ((f"## 0.9.0 ({TODAY})\n\n- It is there.\n\n", "", "the version is 0.8.0"), ("- It is there.\n", "", "nothing in it"),
                                  (f"0.9.0 ({TODAY})", "0.9.0 (2020-02-02)", "has the date 2020-02-02"), (f"0.9.0 ({TODAY})", "0.9.0", "has the date None"),
                                  ("## Unreleased\n", "## Unreleased\n\n- New.\n", "Unreleased, or something is in it"),
                                  ("## Unreleased\n", "", "no section Unreleased")):
            with self.subTest(pattern):
                self.write("CHANGELOG.md", FILES["CHANGELOG.md"])
                self.edit("CHANGELOG.md", old, new)
                said = self.release(1).stderr
                self.assertRegex(said, r"\Arelease: CHANGELOG.md: .*" + pattern)
                self.nothing()

    def test_a_citation_of_another_day(self):
        self.edit("CITATION.cff", TODAY, "2020-02-02")
        self.doubt("date-released is 2020-02-02")

    def test_reports_that_are_old_or_cut_short_or_of_failures_or_skips(self):
        later = "2100-01-01T00:00:00"
        for text, pattern in ((report(("one", "run"), timestamp="2020-01-01T00:00:00"), "before the last commit"),
                              (report(("one", "run"), ("two", "fail"), failures=1, timestamp=later), "1 tests failed: two"),
                              (report(("one", "run"), failures=1, timestamp=later), "tests failed"),
                              (report(("one", "run"), tests=2, timestamp=later), "1 tests, of 2"), (report(timestamp=later), "0 tests"),
                              (report(("one", "notrun"), timestamp=later), "skipped, and .* does not allow it: one")):
            with self.subTest(pattern):
                path = self.folder / "report.xml"
                path.write_text(text)
                self.doubt(pattern, "--tested", path)
        self.doubt("no such report", "--tested", self.folder / "nowhere.xml")


class Builds(Release):
    def refused(self, pattern):
        self.assertRegex(self.release(1).stderr, pattern)
        self.nothing()

    def test_two_builds_that_differ_by_their_folder(self):
        self.edit("run", "echo bytes", "pwd")
        self.refused("two builds of one commit differ: contact-oracle_0.9.0-1_amd64.deb")

    def test_the_second_build_has_no_cache_of_the_compiler(self):
        self.edit("run", "echo bytes", "test \"$CCACHE_DISABLE\" = 1 && echo bytes")
        self.release(0)

    def test_a_build_that_fails_or_makes_no_package(self):
        self.edit("run", "mkdir", "exit 3\nmkdir")
        self.refused("run packages ended with 3")
        self.edit("run", "exit 3\n", "")
        self.edit("run", ".deb", ".tar.gz")
        self.refused("made no Debian package")

    def test_a_package_of_another_version(self):
        self.edit("run", "0.9.0", "0.8.0")
        self.refused("not the version in its name: contact-oracle_0.8.0-1_amd64.deb")

    def test_a_bill_of_materials_that_lacks_a_package_or_is_refused(self):
        self.edit("packaging/sbom.py", "in names", "in []")
        self.refused("spdx.json says nothing of contact-oracle_0.9.0-1_amd64.deb")
        self.write("packaging/sbom.py", "import sys\nsys.exit('under the GPL')\n")
        self.commit()
        self.refused("ended with 1\nunder the GPL")

    def test_a_release_that_is_there_is_not_written_over(self):
        self.release(0)
        self.git("tag", "--delete", "v0.9.0")
        before = hashlib.sha256((self.root / "build/release-0.9.0/SHA256SUMS").read_bytes()).hexdigest()
        self.assertIn("is there already", self.release(1).stderr)
        self.assertEqual(hashlib.sha256((self.root / "build/release-0.9.0/SHA256SUMS").read_bytes()).hexdigest(), before)


if __name__ == "__main__":
    unittest.main()
