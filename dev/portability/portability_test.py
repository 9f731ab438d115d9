#!/usr/bin/env python3
"""portability.py says so where bits differ: portability_test.py COMPILER FOLDER_TO_BUILD_IN [unittest arguments]."""
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

COMPILER, FOLDER = sys.argv[1:3] if len(sys.argv) > 2 else sys.exit(__doc__)
HERE = Path(__file__).resolve().parent
MANIFEST = json.loads((HERE.parents[1] / "golden/manifest.json").read_text())


def portability(*arguments):
    return subprocess.run([sys.executable, HERE / "portability.py", "--quick", "--few", "--build", FOLDER, *arguments],
                          capture_output=True, text=True)


class NoPlatform(unittest.TestCase):
    def test_a_platform_that_cannot_be_built_for_is_a_failure(self):
        run = portability("--compilers", "no-such-compiler")
        self.assertEqual(run.returncode, 1, run.stderr)
        self.assertIn("no-such-compiler", run.stdout)
        self.assertIn("cannot be told", run.stdout)

    def test_no_platform_is_no_success(self):
        self.assertEqual(portability("--only", "no such platform").returncode, 2)


class OtherBitsCampaign(unittest.TestCase):
    """The digests of a build that was made: production is built once more."""

    def test_wrong_and_missing_digests_are_named(self):
        files = {entry["path"]: entry for entry in MANIFEST["files"]}
        wrong = files["sphere_sphere/generic.jsonl"]["digests"]
        least = min(wrong, key=int)
        right, wrong[least] = wrong[least], 64 * "0"
        files["cube_cube/flat.f32.jsonl"]["digests"].clear()
        with tempfile.TemporaryDirectory() as folder:
            manifest = Path(folder) / "manifest.json"
            manifest.write_text(json.dumps({"files": list(files.values())}))
            run = portability("--compilers", COMPILER, "--only=-O0", "--manifest", manifest)
        self.assertEqual(run.returncode, 1, run.stderr)
        self.assertIn(f"sphere_sphere/generic.jsonl: the manifest says {64 * '0'} for {least} answers", run.stdout)
        self.assertIn(f"gives {right}", run.stdout)
        self.assertIn("cube_cube/flat.f32.jsonl: the manifest has no digest of its answers that is as short", run.stdout)
        self.assertIn("2 WRONG", run.stdout)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
