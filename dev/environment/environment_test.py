#!/usr/bin/env python3
"""Everything once more in another floating-point environment: python3 environment_test.py BUILD [--whole] [unittest arguments].

A preloaded library sets it before main, in all threads: four rounding modes, each also with subnormal numbers flushed. The quick
selection asks the program; --whole runs the test programs too."""
import json
import os
import random
import re
import signal
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tool"))
from published import published  # noqa: E402

BUILD = Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else sys.exit(__doc__)
WHOLE = "--whole" in sys.argv and not sys.argv.remove("--whole")
ROOT = Path(__file__).resolve().parents[2]
TOOL = BUILD / "contact-oracle"
PRELOADED, CHANGING = BUILD / "dev/environment/set_environment.so", BUILD / "dev/environment/changing_engine.so"
# All eight, or each mode once and flushing with half of them.
ENVIRONMENTS = [mode + flushing for flushing in ("", ", flushing") for mode in ("to nearest", "upward", "downward", "toward zero")
                if WHOLE or bool(flushing) == (mode in ("to nearest", "downward"))]
SEED = random.SystemRandom().randrange(1 << 32) if WHOLE else 1
GOLDEN = [f"golden/{name}.jsonl" for name in (
    "sphere_sphere/extreme_scale", "sphere_sphere/touching.f32", "sphere_sphere/hardest", "cube_cube/touching", "cube_cube/extreme_scale.f32")]

# What a test program cannot ask in another environment, and why.
NOT_ASKED = {
    "src/kernel/kernel_test": {
        "DoubleDoublePair.*": "steps of the kernels, called beneath the guard that sets the environment",
        "OneVector.*": "the same",
        "SphereSphereFilter.*": "what these tests expect they compute in plain doubles",
        "CubeCube.decides_as_integers_do_in_every_floating_point_environment": "the same; it sets all environments itself",
        "RoundSum.lies_between_its_rounding_boundaries_for_random_and_nearly_cancelling_sums": "the same",
        "RoundRootLess.lies_between_its_rounding_boundaries_for_random_and_nearly_cancelling_differences": "the same"},
    "oracle/oracle_test": {
        "DefaultEnvironment.*": "sets all environments itself",
        "DoubleDouble.*": "steps of the double-double stage, called beneath the guard that sets the environment",
        "RoundToNearest.rounds_a_double_to_binary32_as_a_conversion_does": "the conversion is the environment's",
        "RoundToNearest.rounds_once_among_the_subnormals": "makes rationals of subnormal numbers, which flushing takes for 0",
        "Ulp.is_the_smallest_subnormal_from_zero_to_the_smallest_normal_numbers": "the same",
        "NearestBoundary.is_the_middle_of_two_neighbours_on_the_nearer_side": "the same",
        "Truth.of_the_worked_example": "a third is computed in plain doubles"},
}


def run(program, *args, environment=None, **options):
    variables = {**os.environ, "SOURCE_DATE_EPOCH": "1700000000"}
    if environment:
        variables |= {"LD_PRELOAD": str(PRELOADED), "CONTACT_ENVIRONMENT": environment}
    return subprocess.run([program, *published(args)], capture_output=True, text=True, cwd=ROOT, timeout=3000, **{"env": variables, **options})


class Environment(unittest.TestCase):
    longMessage = True

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_the_preloaded_library_sets_what_it_is_told(self):
        program = "import sys; one, tiny, least = 1.0, 2.0 ** -60, 2.0 ** -1022; print(one + tiny > one, -one - tiny < -one, one - tiny < one, least / 2 == 0)"
        for environment in ENVIRONMENTS:
            mode, _, flushing = environment.partition(", ")
            expected = [mode == "upward", mode == "downward", mode in ("downward", "toward zero"), bool(flushing)]
            self.assertEqual(run(sys.executable, "-c", program, environment=environment).stdout.split(), [str(x) for x in expected], environment)
        self.assertEqual(run("true", environment="sideways").returncode, -signal.SIGABRT)

    def same_everywhere(self, *args, code=0, output=None, **options):
        """The same status, words and file in every environment."""
        def said(environment):
            path = self.folder / "output"
            done = run(TOOL, *args, *((output, path) if output else ()), environment=environment, **options)
            self.assertEqual(done.returncode, code, done.stderr)
            return done.returncode, done.stdout, done.stderr, path.read_bytes() if output else b""
        expected = said(None)
        for environment in ENVIRONMENTS:
            with self.subTest(args[0], environment=environment):
                self.assertEqual(said(environment), expected)
        return expected

    def test_verdicts(self):
        for engine in ("production", "component", "plain-double"):
            self.same_everywhere("certify", *GOLDEN, "--engine", engine, "--level", "correctly-rounded", output="--json",
                                 code=int(engine == "plain-double"))
        self.same_everywhere("certify", "--generate", 100 if WHOLE else 1, "--seed", SEED, "--check", "all", "--level", "correctly-rounded", output="--json")

    def test_certificates(self):
        for environment in ENVIRONMENTS:
            done = run(TOOL, "certify", GOLDEN[0], "--certificate", self.folder / "k.json", environment=environment)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(run(TOOL, "verify", self.folder / "k.json").returncode, 0)
            stated = json.loads((self.folder / "k.json").read_text())["environment"]
            self.assertEqual([stated[key] for key in ("rounding", "subnormal_results", "subnormal_inputs")], ["to nearest", "kept", "kept"])

    def test_golden_files_and_their_digests(self):
        for pair, family in (("sphere_sphere", "extreme_scale"), ("sphere_sphere", "touching"), ("cube_cube", "extreme_scale")):
            for scalar in ("binary64", "binary32"):
                self.generated(pair, family, scalar)
        self.same_everywhere("lint", *GOLDEN)

    def generated(self, pair, family, scalar):
        contents = set()
        for environment in (None, *ENVIRONMENTS):
            path = self.folder / "g.jsonl"
            done = run(TOOL, "generate", "--pair", pair, "--family", family, "--count", 200, "--seed", SEED, "--scalar", scalar, "-o", path, environment=environment)
            self.assertEqual(done.returncode, 0, done.stderr)
            contents.add(path.read_bytes())
        self.assertEqual(len(contents), 1, f"{pair} {family} {scalar} of seed {SEED}")

    def test_words_and_laws(self):
        for path in GOLDEN[:1] if not WHOLE else GOLDEN:
            self.same_everywhere("explain", path)
        self.same_everywhere("properties", "--seed", SEED, "--cases", 200 if WHOLE else 4)

    def test_an_engine_that_changes_it_keeps_its_own_and_hears_its_questions_right(self):
        random_bits = random.Random(SEED)
        numbers = [0.1, 0.3, 4.35, 1e22, 1.7e-310, 5e-324, 1 / 3, 2.2250738585072014e-308, *(
            abs(x) for x in (struct.unpack(">d", random_bits.randbytes(8))[0] for _ in range(3000)) if x == x and abs(x) < 1e308)]
        messages = [{"op": "hello", "protocol": 1}] + [
            {"op": "query", "seq": i + 1, "pair": "sphere_sphere", "a": {"center": [x, -x, 0.7], "radius": 1}, "b": {"center": [0.1, x, 1e-320], "radius": 2},
             "alarm": 0, "contact": 0} for i, x in enumerate(numbers)] + [{"op": "stop"}]
        for environment in (None, *(ENVIRONMENTS if WHOLE else ENVIRONMENTS[-2:])):
            done = run(TOOL, "serve", "--engine-library", CHANGING, environment=environment, input="".join(json.dumps(m) + "\n" for m in messages))
            self.assertEqual(done.returncode, 0, done.stderr)
            answers = [json.loads(line)["contact"] for line in done.stdout.splitlines()[1:]]
            self.assertEqual(len(answers), len(numbers))
            for x, answer in zip(numbers, answers):
                self.assertEqual((answer["point1"], answer["point2"]), ([x, -x, 0.7], [0.1, x, 1e-320]))
                self.assertEqual(answer["value"], 1 + 2 ** -52, "the library's own mode was not kept")

    def test_an_engine_that_changes_it_gets_the_verdict_that_it_gets_otherwise(self):
        args = ("certify", "golden/sphere_sphere/generic.jsonl", "--engine-library", CHANGING)
        self.assertEqual(run(TOOL, *args).returncode, 1)
        if WHOLE:
            self.same_everywhere(*args, code=1)


@unittest.skipUnless(WHOLE, "only with --whole")
class Programs(unittest.TestCase):
    def test_programs(self):
        for program, left_out in NOT_ASKED.items():
            everything = run(BUILD / program, "--gtest_brief=1")
            self.assertEqual(everything.returncode, 0, everything.stdout[-1000:])
            for environment in ENVIRONMENTS:
                with self.subTest(program, environment=environment):
                    done = run(BUILD / program, "--gtest_brief=1", f"--gtest_filter=-{':'.join(left_out)}", environment=environment)
                    self.assertEqual(done.returncode, 0, done.stdout[-2000:])
                    print(f"{program} {environment}: {re.search('[0-9]+ tests', done.stdout)[0]}", flush=True)


if __name__ == "__main__":
    print(f"seed {SEED}", flush=True)
    unittest.main()
