#!/usr/bin/env python3
"""What prove.py must refuse.   python3 proofs/prove_test.py [--coq]

Faults are planted in a copy of bounds.json, the scripts and the constants: every proved bound one unit of its last digit
smaller, links that do not hold, a hypothesis that takes another's number, a constant of C++ below what is proved. With
--coq a wrong hint too, by which Gappa "proves" what is not so, and a lemma without a proof.
"""

import contextlib
import io
import json
import math
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import unittest.mock
from concurrent.futures import ThreadPoolExecutor
from fractions import Fraction
from pathlib import Path

import prove


def answer(folder, *arguments):
    """prove.py's exit status on a folder, and what it said."""
    said = io.StringIO()
    with contextlib.redirect_stderr(said), contextlib.redirect_stdout(said):
        status = prove.main(["--folder", str(folder), *arguments])
    return status, said.getvalue()


class Case(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        shutil.copy(prove.HERE / "bounds.json", self.folder)
        for name in ("scripts", "coq"):
            shutil.copytree(prove.HERE / name, self.folder / name)

    def edit(self, name, old, new):
        path = self.folder / name
        text = path.read_text()
        self.assertEqual(text.count(old), 1, f"{old} stands once in {name}")
        path.write_text(text.replace(old, new))

    def refused(self, words, *arguments):
        status, said = answer(self.folder, *arguments)
        self.assertEqual(status, 1, said)
        self.assertIn(words, said)


class TightCampaign(Case):
    """Whether each printed bound is the least of as many digits."""

    def test_a_bound_one_unit_of_its_last_digit_smaller_is_not_proved(self):
        data = json.loads((self.folder / "bounds.json").read_text())
        scripts = {path.stem: prove.Script(path) for path in (self.folder / "scripts").glob("*.g")}

        def tight(bound):
            digits = re.match(r"[0-9.]+(?= )", bound["value"])
            if digits is None or " + " in bound["value"]:
                return None  # a power of two, printed without digits
            decimals = len(digits[0].partition(".")[2])
            smaller = f"{float(digits[0]) - 10**-decimals:.{decimals}f}"
            folder = Path(tempfile.mkdtemp(dir=self.folder))
            changed = [dict(other, value=other["value"].replace(digits[0], smaller, 1)) if other is bound else other
                       for other in data["bounds"]]
            (folder / "bounds.json").write_text(json.dumps(dict(data, bounds=changed)))
            try:
                prove.gappa(scripts[bound["proved_by"].removesuffix(".g")], prove.Table(folder), folder)
            except prove.ProofError:
                return None
            return bound["name"]

        with ThreadPoolExecutor() as pool:
            proved = [bound for bound in data["bounds"] if bound.get("proved_by", "").endswith(".g")]
            self.assertGreater(len(proved), 60)
            loose = [name for name in pool.map(tight, proved) if name]
        self.assertEqual(loose, [])


class Planted(Case):
    def test_a_folder_without_a_fault_is_proved(self):
        status, said = answer(self.folder)
        self.assertEqual(status, 0, said)

    def test_a_link_that_does_not_hold_is_refused(self):
        self.edit("bounds.json", '"value_of_s + point_underflow <= uncancelled_sum"', '"uncancelled_sum <= value_of_s"')
        self.refused("link fails: uncancelled_sum <= value_of_s")

    def test_a_hypothesis_with_the_number_of_another_is_refused(self):
        self.edit("scripts/tau.g", "|z - 1| <= @recip_root@", "|z - 1| <= @tau@")
        self.refused("link fails")

    def test_a_hypothesis_with_a_number_of_its_own_is_refused(self):
        self.edit("scripts/tau.g", "|e| <= @u@", "|e| <= 1b-54")
        self.refused("has a number of its own")

    def test_a_bound_that_its_script_does_not_conclude_is_refused(self):
        self.edit("scripts/tau.g", "<= @tau@", "<= @rho@")
        self.refused("tau.g does not conclude tau")

    def test_a_circle_is_refused(self):
        self.edit("scripts/recip_root.g", "|e2| <= @u@", "|e2| <= @u@ /\\ |rho| <= @rho@")
        self.refused("a circle")

    def test_a_script_that_there_is_not_is_refused(self):
        self.refused("no script is named roots", "--only", "roots")

    def planted_constants(self):
        """Each constant of C++ with what is proved to suffice, in a copy of the sources that may be edited."""
        table = prove.Table(self.folder)
        sources = self.folder / "sources"
        for side in table.constants:
            for file in {row["in"] for row in side["rows"]} | {side["header"]}:
                (sources / file).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(prove.ROOT / file, sources / file)
        rows = list(table.rows())
        with unittest.mock.patch.object(prove, "ROOT", sources):
            for row, _, needed in rows:
                path = sources / row["in"]
                text = path.read_text()

                def plant(value):
                    definition = rf"(constexpr double {row['constant']} = )[^;]*"
                    found, count = re.subn(definition, rf"\g<1>{prove.hexadecimal(value)}", text)
                    self.assertEqual(count, 1)
                    path.write_text(found)

                yield row, needed, plant, table, path
                path.write_text(text)

    def test_a_constant_one_step_below_what_is_proved_is_refused(self):
        count = 0
        for row, needed, plant, table, _ in self.planted_constants():
            with self.subTest(constant=row["constant"], needs=row["needs"]):
                step = Fraction(math.ulp(float(needed)))
                plant(needed - step)
                with self.assertRaisesRegex(prove.ProofError, row["constant"]):
                    table.check_constants()
                count += 1
        self.assertGreater(count, 25)

    @unittest.skipIf(shutil.which("g++") is None, "no compiler")
    def test_a_constant_one_step_below_what_is_proved_does_not_compile(self):
        for row, needed, plant, _, path in self.planted_constants():
            if path.name != "batch_bounds.hpp":
                continue
            with self.subTest(constant=row["constant"], needs=row["needs"]):
                plant(needed - Fraction(math.ulp(float(needed))))
                command = ["g++", "-std=c++20", "-fsyntax-only", "-x", "c++", f"-I{path.parents[1]}", str(path)]
                compiled = subprocess.run(command, capture_output=True, text=True)
                self.assertIn("static assertion failed", compiled.stderr)

    def test_a_header_that_says_something_else_is_refused(self):
        self.edit("bounds.json", '"name": "filter_gap", "value": "5.0002 u"', '"name": "filter_gap", "value": "5.0003 u"')
        self.refused("is not what bounds.json says")


class PlantedForCoq(Planted):
    """Slower: Gappa takes a hint for granted, Coq does not."""

    def test_a_wrong_hint_is_refused(self):
        # The rounding of tau is left out: Gappa proves a smaller bound from it.
        self.edit("scripts/root.g", "1 + sl - exact -> tau * e1 - dr", "1 + sl - exact -> - dr")
        status, said = answer(self.folder, "--only", "root")
        self.assertEqual(status, 0, said)
        self.refused("Coq refuses the proof", "--coq", "--only", "root")

    def test_a_lemma_without_a_proof_is_refused(self):
        self.edit("coq/Weights.v", "apply Rabs_le_inv in HS. split; apply Rabs_le; lra.\nQed.", "Admitted.")
        with self.assertRaisesRegex(prove.ProofError, "not proved"):
            prove.lemma_files([self.folder / "coq" / "Weights.v"], self.folder)


if __name__ == "__main__":
    if shutil.which("gappa") is None or ("--coq" in sys.argv and shutil.which("coqc") is None):
        print("gappa or coqc is not installed: nothing was tested", file=sys.stderr)
        sys.exit(prove.SKIPPED)
    unittest.main(argv=[word for word in sys.argv if word != "--coq"],
                  defaultTest="PlantedForCoq" if "--coq" in sys.argv else "Planted")
