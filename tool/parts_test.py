#!/usr/bin/env python3
"""A run cut into parts says what the whole run says: python3 tool/parts_test.py PATH_TO_TOOL [unittest arguments].

With CONTACT_MPIRUN in the environment, a command that starts four processes, PATH_TO_TOOL is contact-oracle-mpi, and the tests of
a cluster run too."""
import filecmp
import json
import os
import re
import resource
import shlex
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import cli_test
from cli_test import ROOT, TOOL, run
from cluster import after_a_death
from published import published

MPIRUN = shlex.split(os.environ.get("CONTACT_MPIRUN", ""))
# Every kind of finding: missed and false hits, numbers that are off, not finite, skipped for their scalar and scale.
GOLDEN = [f"golden/{name}.jsonl" for name in ("sphere_sphere/extreme_scale", "sphere_sphere/extreme_scale.f32",
                                              "sphere_sphere/touching.f32", "cube_cube/touching.f32")]
FLOAT = ["certify", *GOLDEN, "--engine", "plain-float"]
WHOLES = tempfile.TemporaryDirectory()
FRESH = ["certify", "--engine", "plain-double", "--pair", "sphere_sphere", "--seed", "7"]
HULLS = ["certify", "--engine", "plain-double", "--pair", "sphere_hull", "--seed", "7", "--family", "touching,ties"]


class Case(cli_test.Case):
    def report(self, name, *args, code=None, **options):
        """The JSON report of a run and what it printed."""
        path = self.folder / f"{name}.json"
        done = run(*args, "--json", path, "--report", path.with_suffix(".html"), **options)
        self.assertTrue(path.exists(), done.stderr)
        if code is not None:
            self.assertEqual(done.returncode, code, done.stderr)
        return path, done

    wholes = {}  # by its arguments: the reports of a run in one piece, and what it printed

    def whole(self, args):
        key = tuple(map(str, args))
        if key not in self.wholes:
            path = Path(WHOLES.name) / f"{len(self.wholes)}.json"
            self.wholes[key] = path, run(*args, "--json", path, "--report", path.with_suffix(".html"))
        path, printed = self.wholes[key]
        self.assertTrue(path.exists(), printed.stderr)
        self.assertEqual(printed.returncode, 0 if json.loads(path.read_text())["certified"] else 1, printed.stderr)
        return path, printed

    def assert_same(self, args, *others, **options):
        whole, printed = self.whole(args)
        for i, other in enumerate(others):
            with self.subTest(other):
                path, done = self.report(i, *other, code=printed.returncode, **options)
                self.assertEqual(path.read_bytes(), whole.read_bytes())
                self.assertEqual(path.with_suffix(".html").read_bytes(), whole.with_suffix(".html").read_bytes())
                # `merge` draws no questions, and so tells no seed.
                said = lambda run: re.sub(r"^seed 7\n|\nReport: .*\n$", "", run.stdout)
                self.assertEqual(said(done), said(printed))
        return json.loads(whole.read_bytes())

    def refused(self, args, *words, code=2, **options):
        done = run(*args, **options)
        self.assertEqual((done.returncode, re.sub(r"seed \d+\n", "", done.stdout)), (code, ""), done.stderr)
        for word in words:
            self.assertIn(str(word), done.stderr)
        self.assertNotIn("terminate called", done.stderr)


class Parts(Case):
    def parts(self, args, of, name="parts"):
        folder = self.folder / name
        for i in range(of):
            done = run(*args, "--parts", folder, "--shard", f"{i}/{of}")
            right = {0: "nothing is wrong", 1: "not all is right"}.get(done.returncode, done.stderr)
            self.assertRegex(done.stdout, rf"part {i} of {of}: \d+ questions judged, and {right}; `merge` gives the verdict")
        return folder

    def test_parts_merge_to_the_report_of_the_whole_run(self):
        for args in (FLOAT, ["certify", *GOLDEN, "--engine", "published", "--level", "correctly-rounded"],
                     ["certify", *GOLDEN, "--engine", "production"],
                     [*HULLS, "--generate", "20"],  # failures of questions with any number of vertices
                     [*FRESH, "--generate", "200", "--family", "extreme_scale,touching"]):
            for of in (1, 3, 64, 700) if args == FLOAT else (9,):  # also parts of a question or none
                with self.subTest(args=args, of=of):
                    folder = self.folder / f"{of}{args[-1]}"
                    report = self.assert_same(args, [*args, "--parts", folder, "--shards", of], ["merge", folder])
                    self.assertEqual(len(list(folder.glob("*.part"))), of)
        self.assertEqual(report["total"]["cases"], 800)

    def test_parts_judged_apart_and_named_in_any_order_merge_as_well(self):
        folder = self.parts(FLOAT, 4)
        parts = sorted(folder.iterdir(), reverse=True)
        report = self.assert_same(FLOAT, ["merge", *parts], [*FLOAT, "--parts", folder, "--shards", 4])
        # What the numbers are of: every kind of finding is there.
        total = report["total"]
        self.assertTrue(total["missed_hits"] and total["false_hits"] and total["not_finite"] and report["skipped"])
        self.assertEqual(report["failure_count"], len(report["failures"]))
        self.assertTrue(report["diagnosis"] and report["worst"])

    def test_what_a_baseline_accepts_and_what_no_question_asked_for_are_told_alike(self):
        accepted, _ = self.report("accepted", *FLOAT, code=1)
        results = self.folder / "results.jsonl"
        lines = (ROOT / "golden/recorded/sofa-2a278d8/sphere_sphere.jsonl").read_text().splitlines(True)
        results.write_text("".join(lines) + lines[1].replace(json.loads(lines[1])["id"], "0" * 24))
        recorded = ["certify", "golden/sphere_sphere/upstream.jsonl", "--results", results]
        for name, args in (("baseline", [*FLOAT, "--baseline", accepted]), ("recorded", recorded)):
            folder = self.folder / name
            report = self.assert_same(args, [*args, "--parts", folder, "--shards", 9], ["merge", folder])
        self.assertEqual(report["unknown_answers"], ["0" * 24])

    def test_an_interrupted_run_goes_on_from_its_finished_parts(self):
        folder = self.folder / "parts"
        args = [*FRESH, "--generate", "2000", "--family", "generic,touching"]
        for stop in (signal.SIGINT, signal.SIGKILL):
            process = subprocess.Popen([TOOL, *published(args), "--parts", folder], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            before = len(list(folder.glob("*.part"))) if folder.exists() else 0
            deadline = time.monotonic() + 300
            while not folder.exists() or len(list(folder.glob("*.part"))) < before + 8:
                self.assertLess(time.monotonic(), deadline)
                time.sleep(0.01)
            process.send_signal(stop)
            process.communicate(timeout=300)
            self.assertEqual(process.returncode, 130 if stop == signal.SIGINT else -signal.SIGKILL)
        kept = {path: path.stat().st_mtime_ns for path in folder.glob("*.part")}
        self.assertLess(len(kept), 64)
        self.assert_same(args, [*args, "--parts", folder])
        for path, written in kept.items():
            self.assertEqual(path.stat().st_mtime_ns, written, "a finished part was judged again")

    def test_a_part_that_ran_out_of_time_is_not_kept(self):
        folder = self.folder / "parts"
        args = [*FRESH, "--generate", "100000", "--family", "generic"]
        _, done = self.report("late", *args, "--parts", folder, "--shards", 2, "--max-time", "0.2", code=1)
        self.assertIn("not reached, and missing: the time was up", done.stdout)
        self.assertEqual(list(folder.glob("*.part")), [])

    def test_what_cannot_be_the_whole_is_refused_by_name(self):
        folder = self.parts(FLOAT, 3)
        part = [folder / f"part-{i}-of-3.part" for i in range(3)]
        self.refused(("merge", part[0], part[2]), "1 of 3 parts missing: 1")
        self.refused(("merge", *part, part[1]), part[1], "part 1 stands in", "already")
        part[1].chmod(0)
        if os.geteuid() != 0:
            self.refused(("merge", folder), part[1], "cannot read")
        part[1].chmod(0o644)
        other = {"engine": ["certify", *GOLDEN, "--engine", "plain-double"], "required": [*FLOAT, "--level", "decisions"],
                 "sources": ["certify", GOLDEN[0], "--engine", "plain-float"]}
        for field, args in other.items():
            stranger = self.parts(args, 3, field) / "part-1-of-3.part"
            self.refused(("merge", part[0], stranger, part[2]), stranger, f"run/{field}", "a part of another run")
        # Of very many, the first that are missing are named: nobody has room for a list of all.
        one = self.folder / "one"
        self.assertEqual(run(*FLOAT, "--parts", one, "--shard", "1/1000000000000").returncode, 0)
        self.refused(("merge", one), f"999999999999 of 1000000000000 parts missing: {', '.join(str(i) for i in range(21) if i != 1)}\n")
        odd = self.parts(FLOAT, 4, "four") / "part-1-of-4.part"
        self.refused(("merge", part[0], odd, part[2]), odd, "one of 4 parts here, one of 3 in")
        (folder / "part-3-of-4.part").write_bytes(b"")
        self.refused(("merge", folder), "part-3-of-4.part", "empty")
        self.refused(("merge", self.folder / "none"), "none", "no such file")
        (self.folder / "empty").mkdir()
        self.refused(("merge", self.folder / "empty"), "no part of a run")
        self.refused(("merge", "golden/sphere_sphere/touching.jsonl"), "format", 'expected "contact-oracle/part"')

    def test_a_damaged_part_is_refused_wherever_it_is_read(self):
        folder = self.parts(FLOAT, 2)
        path = folder / "part-1-of-2.part"
        whole = path.read_bytes()
        head = whole.index(b"\n")
        for at in (head // 2, head - 3, head + 1, head + 1 + (len(whole) - head) // 2, len(whole) - 1):
            for bad in (whole[:at], whole[:at] + bytes([whole[at] ^ 1]) + whole[at + 1:]):
                path.write_bytes(bad)
                self.refused(("merge", folder), path)
                self.refused((*FLOAT, "--parts", folder, "--shards", 2), path)
        path.write_bytes(whole + b"x")
        self.refused(("merge", folder), path, "bytes", "has grown")
        path.write_bytes(whole.replace(b'"part":[1,2]', b'"part":[0,2]', 1))
        self.refused(("merge", path, path), path, "sha256", "damaged")
        version = json.loads(whole[:head])["version"]
        path.write_bytes(whole.replace(b'"version":%d' % version, b'"version":%d' % (version + 1), 1))
        self.refused(("merge", folder), path, "version", f"reads version {version}")

    def test_a_folder_of_another_run_is_not_gone_on_with(self):
        folder = self.parts([*FRESH, "--generate", "50"], 2)
        again = [*FRESH[:-1], "8", "--generate", "50", "--parts", folder, "--shards", 2]
        self.refused(again, "part-0-of-2.part", "run/sources", "what is asked for now")

    def test_a_full_disk_is_told_and_leaves_no_part(self):
        folder = self.folder / "parts"
        self.refused((*FLOAT, "--parts", folder, "--shards", 2), "part-0-of-2.part", "cannot write",
                     preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000)), restore_signals=False)
        self.assertEqual(list(folder.iterdir()), [])
        (self.folder / "file").write_text("")
        self.refused((*FLOAT, "--parts", self.folder / "file"), "file", "--parts", "no folder")

    def test_what_makes_no_sense_in_parts_is_refused(self):
        folder = self.folder / "parts"
        self.refused((*FLOAT, "--parts", folder, "--fail-fast"), "--fail-fast")
        self.refused(("certify", "--parts", folder), "--parts", "give the engine")
        self.refused((*FLOAT, "--shard", "0/2"), "--parts")
        self.refused((*FLOAT, "--parts", folder, "--shard", "2/2"), "--shard", "I below N", "2/2")
        self.refused((*FLOAT, "--parts", folder, "--shards", "0"), "--shards")
        self.refused(("certify", "--generate", "2", "--pair", "cube_cube", "--family", "flat", "--seed", "1", "--engine", "production", "--parts", self.folder / "none",
                      "--shards", "65"), "--shards: 65 parts are more than the 4 questions")
        self.assertFalse((self.folder / "none").exists())
        self.refused(("certify", "--generate", "5", "--parts", folder), "--seed")

    @unittest.skipIf(MPIRUN, "this program knows MPI")
    def test_processes_of_a_program_without_mpi_do_not_do_the_work_four_times(self):
        self.refused(FLOAT, "knows nothing of MPI", "contact-oracle-mpi", env={**os.environ, "OMPI_COMM_WORLD_SIZE": "4"})

    @unittest.skipIf(b"__asan_init" in Path(TOOL).read_bytes(), "a sanitizer keeps what is freed for a while")
    def test_memory_does_not_grow_with_the_questions(self):
        def most(count):
            done = run(*FRESH, "--family", "touching", "--generate", count, "--stats")
            return int(re.search(r"(\d+) MB at most", done.stderr)[1])
        # Half of the answers fail here, and all failures are listed, but no more than 100,000.
        self.assertLess(most(5000), most(500) + 30)


@unittest.skipUnless(MPIRUN, "no contact-oracle-mpi: Boost.MPI was not found")
class Cluster(Case):
    def setUp(self):
        super().setUp()
        # What MPI itself never gives back is not ours to find.
        before = os.environ.get("ASAN_OPTIONS", "")
        os.environ["ASAN_OPTIONS"] = f"{before}:detect_leaks=0"
        self.addCleanup(os.environ.__setitem__, "ASAN_OPTIONS", before)

    def test_four_processes_write_the_report_of_one(self):
        fresh = [*FRESH, "--generate", "1200", "--family", "generic,touching"]
        for args in (FLOAT, fresh):
            one, done = self.report("one", *args)
            path, four = self.report("four", *args, by=MPIRUN)
            said = lambda run: re.sub(r"\nReport: .*\n$", "", run.stdout)
            self.assertEqual((four.returncode, said(four)), (done.returncode, said(done)), four.stderr)
            for suffix in (".json", ".html"):
                self.assertEqual(path.with_suffix(suffix).read_bytes(), one.with_suffix(suffix).read_bytes())

    def test_four_processes_generate_the_file_of_one(self):
        args = ["generate", "--pair", "sphere_sphere", "--family", "near_touching", "--count", "9000", "--seed", "3", "-o"]
        self.assertEqual(run(*args, self.folder / "one.jsonl").returncode, 0)
        done = run(*args, self.folder / "four.jsonl", by=MPIRUN)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.count("9000 cases"), 1)
        self.assertTrue(filecmp.cmp(self.folder / "one.jsonl", self.folder / "four.jsonl", shallow=False))

    def test_four_processes_print_one_digest(self):
        args = ["generate", "--pair", "sphere_sphere", "--family", "near_touching", "--count", "50", "--seed", "3", "--digest"]
        done = run(*args, by=MPIRUN)
        self.assertEqual((done.returncode, done.stdout), (0, run(*args).stdout), done.stderr)

    def left(self, but=None):
        """What stands in the folder. mpirun kills after a second whoever has not ended, so that what the first process was writing may
        stay under its temporary name, which nothing reads."""
        return [p.name for p in self.folder.iterdir() if p != but and p.suffix != ".unfinished"]

    def test_the_death_of_a_process_is_told_and_nothing_is_taken_for_whole(self):
        folder, path = self.folder / "parts", self.folder / "report.json"
        args = [*FRESH, "--generate", "2000", "--family", "generic,touching"]
        process = subprocess.Popen([*MPIRUN, TOOL, *published(args), "--parts", folder, "--json", path], cwd=ROOT, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        deadline = time.monotonic() + 300
        while not folder.exists() or len(list(folder.glob("*.part"))) < 8:
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)
        ranks = lambda: subprocess.run(["pgrep", "-f", f"^{TOOL} .*{folder}"], capture_output=True, text=True).stdout.split()
        self.assertEqual(len(ranks()), 4)
        os.kill(int(ranks()[-1]), signal.SIGKILL)
        out, err = after_a_death(process, ranks)
        self.assertNotIn(process.returncode, (0, 1), "a certificate or a refutation although a process died")
        self.assertRegex(err, r"signal 9|Killed")
        self.assertNotIn("CERTIFIED", out)
        self.assertEqual(self.left(but=folder), [], "half a report was left")
        # What the four had finished is gone on from, by one.
        kept = {p: p.stat().st_mtime_ns for p in folder.glob("*.part")}
        self.assertLess(len(kept), 64)
        whole = self.report("whole", *args)[0]
        resumed = self.report("resumed", *args, "--parts", folder)[0]
        self.assertTrue(filecmp.cmp(whole, resumed, shallow=False))
        for p, written in kept.items():
            self.assertEqual(p.stat().st_mtime_ns, written)

    def test_bad_input_and_an_interruption_end_all_processes(self):
        done = run("certify", "golden/none.jsonl", by=MPIRUN)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("no such file", done.stderr)
        done = run("certify", "--generate", "10", by=MPIRUN)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("--seed", done.stderr)
        path = self.folder / "report.json"
        process = subprocess.Popen([*MPIRUN, TOOL, *FRESH, "--generate", "100000", "--json", path], cwd=ROOT,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        time.sleep(2)
        process.send_signal(signal.SIGINT)
        out, _ = process.communicate(timeout=300)
        self.assertEqual(process.returncode, 1)  # mpirun's own: what is printed and written tells that it is no verdict
        self.assertNotRegex(out, b"REFUTED|CERTIFIED")
        self.assertEqual(self.left(), [])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
