#!/usr/bin/env python3
"""What ./run does before it installs packages and before it builds, with programs that only write down what they are told:   packages_test.py"""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
# Each writes down its words and what it reads, so that a question to the user would be seen to be asked.
TOLD = '#!/bin/sh\necho "$(basename "$0") $*" >> "{told}"\nif [ -t 0 ] || [ -n "$(cat)" ]; then echo "asked" >> "{told}"; fi\n'
SIZES = """case "$*" in *--print-uris*)
  echo "0 upgraded, 12 newly installed, 0 to remove and 3 not upgraded."
  echo "Need to get 34.5 MB/40.1 MB of archives."
  echo "After this operation, 210 MB of additional disk space will be used."
  echo "'http://example.org/coq.deb' coq.deb 123 SHA256:0" ;;
esac
"""


class Packages(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        shutil.copy(ROOT / "run", self.folder)
        (self.folder / "cmake").mkdir()
        (self.folder / "cmake" / "packages.txt").write_text("# the list\nalpha\nbeta  # why\n")
        (self.folder / "cmake" / "build-packages.txt").write_text("# for tests\ngamma\n")
        (self.folder / "bin").mkdir()
        self.told = self.folder / "told.txt"
        self.program("apt-get", TOLD.format(told=self.told) + SIZES)
        self.program("dpkg-query", '#!/bin/sh\nprintf "ii  alpha\\n"\n')

    def program(self, name, text):
        path = self.folder / "bin" / name
        path.write_text(text)
        path.chmod(0o755)

    def prove(self, user):
        """./run prove, which installs and then ends for want of the proofs."""
        self.program("id", f"#!/bin/sh\necho {user}\n")
        environment = {**os.environ, "PATH": f"{self.folder / 'bin'}:/usr/bin:/bin"}
        done = subprocess.run([self.folder / "run", "prove", "--list"], input="y\n" * 9, capture_output=True, text=True, timeout=60,
                              env=environment)
        self.assertEqual(done.returncode, 2, done.stderr)
        return done.stderr, self.told.read_text().splitlines() if self.told.exists() else []

    def test_what_is_missing_and_how_large_it_is_is_said_before_it_is_installed(self):
        said, told = self.prove(0)
        self.assertEqual(said.splitlines()[:4], [
            "contact-oracle needs these packages: beta coq gappa libcoq-flocq libcoq-gappa", "  12 newly installed",
            "  Need to get 34.5 MB/40.1 MB of archives.", "  After this operation, 210 MB of additional disk space will be used."])
        self.assertEqual([next(word for word in one.split() if word in ("update", "--print-uris", "-qq")) for one in told],
                         ["update", "--print-uris", "-qq"])
        self.assertIn("install", told[2].split())
        self.assertNotIn("alpha", " ".join(told))

    def built(self, command, units=40):
        """What is installed, how CMake is called, and what is said, where ./run builds so many units."""
        cache = 'echo "CONTACT_TESTS:BOOL=OFF" > build/release/CMakeCache.txt'
        for name, text in {"id": "echo 0", "apt-get": f'echo "$@" >> "{self.told}"', "cmake": f'echo "cmake $@" >> "{self.told}"; {cache}',
                           "ninja": f'for i in $(seq {units}); do echo "g++ -O1 -o $i.o -c $i.cpp"; done', "nproc": "echo 2"}.items():
            self.program(name, f"#!/bin/sh\n{text}\n")
        (self.folder / "build/release").mkdir(parents=True, exist_ok=True)
        self.told.unlink(missing_ok=True)
        done = subprocess.run([self.folder / "run", command], stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=60,
                              env={**os.environ, "PATH": f"{self.folder / 'bin'}:/usr/bin:/bin"})
        told = self.told.read_text().splitlines()
        installed = {word for line in told if line.startswith("install") for word in line.split()}
        return installed & {"beta", "gamma"}, [line for line in told if line.startswith("cmake")], done.stderr

    def test_the_program_alone_is_built_without_the_tests_and_what_these_need(self):
        installed, cmake, said = self.built("certify")
        self.assertEqual((installed, cmake), ({"beta"}, ["cmake --preset release -DCONTACT_TESTS=OFF"]))
        self.assertRegex(said, r"(?m)^building contact-certify: about 11 processor minutes, by the clock 6$")
        # Once the program is built the tests are configured all the same.
        (self.folder / "build/release/build.ninja").touch()
        installed, cmake, said = self.built("build")
        self.assertEqual((installed, cmake), ({"beta", "gamma"}, ["cmake --preset release -DCONTACT_TESTS=ON"]))
        self.assertIn("building all: about 11 processor minutes", said)

    def test_the_python_package_is_built_without_the_tests(self):
        (self.folder / "cmake" / "python-packages.txt").write_text("delta\n")
        installed, cmake, _ = self.built("python")
        self.assertEqual(installed, {"beta"})
        self.assertEqual(cmake[0], "cmake --preset release -DCONTACT_TESTS=OFF -DPython3_EXECUTABLE=/usr/bin/python3")
        self.assertEqual(set(cmake[1:]), {"cmake --preset release -DCONTACT_TESTS=OFF"})

    def test_a_build_of_moments_is_not_announced(self):
        self.assertNotIn("processor minutes", self.built("certify", 2)[2])

    def test_nothing_waits_for_an_answer(self):
        self.program("sudo", TOLD.format(told=self.told) + 'while [ "$1" != apt-get ] && [ $# -gt 0 ]; do shift; done\n[ $# -eq 0 ] || exec "$@"\n')
        for user in (0, 1000):
            with self.subTest(user):
                self.told.unlink(missing_ok=True)
                _, told = self.prove(user)
                self.assertNotIn("asked", told)
                self.assertEqual(sum(one.startswith("apt-get") for one in told), 3)
                asked_as_root = [one for one in told if one.startswith("sudo")]
                self.assertEqual(len(asked_as_root), 3 if user else 0, told)  # true, update, install
                self.assertTrue(all(one.startswith("sudo -n ") for one in asked_as_root), told)
                self.assertTrue(all("DEBIAN_FRONTEND=noninteractive" in one for one in asked_as_root[1:]), told)

    def test_a_sudo_that_wants_a_password_is_not_asked_and_the_command_is_named(self):
        self.program("sudo", f'{TOLD.format(told=self.told)}exit 1\n')
        said, told = self.prove(1000)
        self.assertEqual(told, ["sudo -n true"])
        self.assertIn("sudo apt-get install --no-install-recommends beta coq gappa libcoq-flocq libcoq-gappa", said)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[1:]])
