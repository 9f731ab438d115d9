#!/usr/bin/env python3
"""Faults on purpose: python3 tool/faults_test.py PATH_TO_TOOL [--times N] [--seed S] [unittest arguments].

Killed, interrupted, cut off from disk or reader at random moments, fed what has no end: nothing half-written is taken for whole, no
verdict is wrong, memory stays bounded, and a message names what is wrong. Without --times N it is a quick run: some of the commands
that are drawn, once. The table at the end says what came of the tries. With CONTACT_MPIRUN, a command that starts four processes, PATH_TO_TOOL is contact-oracle-mpi
and the processes of a cluster are killed too. Root alone mounts small and read-only disks."""
import argparse
import collections
import contextlib
import hashlib
import json
import os
import random
import re
import resource
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

from cluster import after_a_death
from published import published

arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
arguments.add_argument("tool")
arguments.add_argument("--times", type=int, default=1)
arguments.add_argument("--seed", type=int)
OPTIONS, REST = arguments.parse_known_args()
if OPTIONS.seed is None:  # a quick run is always the same
    OPTIONS.seed = random.SystemRandom().randrange(1 << 32) if OPTIONS.times > 1 else 1
TOOL, TIMES = os.path.abspath(OPTIONS.tool), OPTIONS.times
MPIRUN = shlex.split(os.environ.get("CONTACT_MPIRUN", ""))
ROOT = Path(__file__).resolve().parent.parent
GOLDEN = ROOT / "golden"
FLAT = GOLDEN / "cube_cube" / "flat.jsonl"
# A shell that runs this in its background ignores it, and so would every process that is started here.
signal.signal(signal.SIGINT, signal.default_int_handler)
IS_ROOT = os.geteuid() == 0
SANITIZED = b"__asan_init" in Path(TOOL).read_bytes()
# MPI itself never gives back some memory, and what a killed sanitizer says is no matter.
ENVIRONMENT = {**os.environ, "SOURCE_DATE_EPOCH": "1700000000", "ASAN_OPTIONS": os.environ.get("ASAN_OPTIONS", "") + ":detect_leaks=0"}
UNFINISHED = re.compile(r"\.[0-9a-f]{8}\.unfinished$")
MEGABYTE = 1 << 20
SIZE = 1 if TIMES == 1 else 4  # of the work that is disturbed
TALLY = collections.defaultdict(collections.Counter)  # fault: outcome: how often
PEAK = collections.defaultdict(float)  # fault: megabytes

# What a run may write, from the folder it stands in; the files that are its result; its exit status.
FRESH = ("certify", "--engine", "plain-double", "--pair", "sphere_sphere", "--family", "touching,generic", "--seed", "7")
REPORTS = ("--json", "r.json", "--report", "r.html", "--junit", "r.xml", "--markdown", "r.md")
COMMANDS = {
    "generate": (("generate", "--pair", "sphere_sphere", "--family", "touching", "--count", str(800 * SIZE), "--seed", "7", "-o", "g.jsonl"), ["g.jsonl"], 0),
    "generate (HDF5)": (("generate", "--pair", "sphere_sphere", "--family", "generic", "--count", str(800 * SIZE), "--seed", "7", "-o", "g.h5"), ["g.h5"], 0),
    "convert": (("convert", "in/big.jsonl", "-o", "c.h5"), ["c.h5"], 0),
    "certify": ((*FRESH, "--generate", str(1500 * SIZE), *REPORTS), ["r.json", "r.html", "r.xml", "r.md"], 1),
    "certify --certificate": (("certify", "in/touching.jsonl", "--engine", "plain-double", "--fresh", "0", "--certificate", "k.json"), ["k.json", "k.answers.jsonl"], 1),
    "certify --parts": ((*FRESH, "--generate", str(1500 * SIZE), "--parts", "p", "--shards", "16", *REPORTS), ["r.json", "r.html", "r.xml", "r.md"], 1),
    "merge": (("merge", "in/parts", *REPORTS), ["r.json", "r.html", "r.xml", "r.md"], 1),
}


def tool(*args, by=(), **options):
    options = {"capture_output": True, "text": True, "errors": "replace", "timeout": 600, "cwd": ROOT, "env": ENVIRONMENT, **options}
    return subprocess.run([*by, TOOL, *published(args)], **options)


def measured(*args, feed=None, **options):
    """The exit status, standard error and the most memory of a run, in megabytes; feed(write) gives it its standard input."""
    with tempfile.TemporaryFile() as err:
        process = subprocess.Popen([TOOL, *published(args)], stdin=subprocess.PIPE if feed else subprocess.DEVNULL, cwd=ROOT,
                                   stdout=subprocess.DEVNULL, stderr=err, env=ENVIRONMENT, **options)
        late = threading.Timer(300, process.kill)
        late.start()
        if feed:
            with contextlib.suppress(BrokenPipeError), process.stdin:
                feed(process.stdin.write)
        _, status, used = os.wait4(process.pid, 0)
        late.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
        err.seek(0)
        return process.returncode, err.read().decode(errors="replace"), used.ru_maxrss / 1024


class Inputs:
    """A folder with what the commands read, and what those that are tried write where nothing goes wrong."""

    @classmethod
    def make(cls):
        cls.folder, cls.whole, cls.seconds = Path(tempfile.mkdtemp(prefix="contact-faults-")), {}, {}
        (cls.folder / "in").mkdir()
        (cls.folder / "disk").mkdir()
        shutil.copy(GOLDEN / "sphere_sphere" / "touching.jsonl", cls.folder / "in")
        for code, args in enumerate((
                ("generate", "--pair", "cube_cube", "--family", "nested", "--count", str(3000 * SIZE), "--seed", "1", "-o", "in/big.jsonl"),
                (*FRESH, "--generate", str(800 * SIZE), "--parts", "in/parts", "--shards", "32"))):
            assert tool(*args, cwd=cls.folder).returncode == code, args

    @classmethod
    def know(cls, name):
        """What a command writes, and how long it takes; to be called where no work is begun."""
        if name in cls.whole:
            return
        args, outputs, code = COMMANDS[name]
        with work() as place:
            start = time.monotonic()
            done = tool(*args, cwd=place)
            cls.seconds[name] = time.monotonic() - start
            assert done.returncode == code, (name, done.returncode, done.stderr)
            cls.whole[name] = {output: (place / output).read_bytes() for output in outputs}


@contextlib.contextmanager
def work():
    """An empty folder, always of one name and place, on a disk of its own or not: a certificate tells where its dataset is, seen from there."""
    place = Inputs.folder / "disk" / "work"
    place.mkdir()
    (place / "in").symlink_to(Inputs.folder / "in")
    try:
        yield place
    finally:
        shutil.rmtree(place)


class Case(unittest.TestCase):
    longMessage = True

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.random = random.Random(f"{OPTIONS.seed} {self.id()}")

    def some(self, of, most=2):
        """All of them, or in a quick run as many as it has time for."""
        return self.random.sample(list(of), most) if TIMES == 1 else list(of)

    def file(self, name, content):
        (self.folder / name).write_text(content)
        return self.folder / name

    def refused(self, fault, args, *words, most=80, **options):
        """Exit status 2, one short line with every one of the words, and bounded memory."""
        code, said, megabytes = measured(*args, **options)
        self.assertEqual((code, len(said.splitlines())), (2, 1), said[:500])
        for word in words:
            self.assertIn(str(word), said)
        self.assertLess(len(said), 1500)
        if not SANITIZED:
            self.assertLess(megabytes, most, said)
        PEAK[fault] = max(PEAK[fault], megabytes)
        TALLY[fault]["refused"] += 1

    def old_outputs(self, place, name):
        """In half of the tries there is something already where a command writes."""
        for output in COMMANDS[name][1]:  # what an earlier try in the same place left
            (place / output).unlink(missing_ok=True)
        old = {output: b"old\n" for output in COMMANDS[name][1]} if self.random.random() < 0.5 else {}
        for output, content in old.items():
            (place / output).write_bytes(content)
        return old

    def assert_whole_or_as_before(self, place, name, old, killed=False):
        """Every output is whole or what it was; how many are whole. Nothing else is there but finished parts and, after a kill,
        what says by its name that it is unfinished."""
        outputs, whole = COMMANDS[name][1], 0
        for output in outputs:
            found = (place / output).read_bytes() if (place / output).exists() else None
            whole += found == Inputs.whole[name][output]
            if found != Inputs.whole[name][output]:
                self.assertEqual(found, old.get(output), f"{output} of {name} is neither whole nor as it was")
        rest = [path for path in place.rglob("*") if path.name not in outputs and path.name not in ("in", "p")]
        for path in rest:
            self.assertTrue(path.suffix == ".part" or killed and UNFINISHED.search(path.name), f"{path} is left of {name}")
        return whole, any(UNFINISHED.search(path.name) for path in rest)

    def assert_goes_on(self, place, name):
        """The same command, run again, takes nothing for a result that a killed run left, and leaves nothing beside it."""
        args, outputs, code = COMMANDS[name]
        datasets = [output for output in outputs if output.endswith((".jsonl", ".h5")) and output.startswith(("g", "c"))]
        if datasets and not (place / datasets[0]).exists():
            done = tool("lint", ".", cwd=place)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn("no dataset", done.stderr)
        kept = {path: path.read_bytes() for path in place.rglob("*") if path.suffix == ".part" or UNFINISHED.search(path.name)}
        done = tool(*args, cwd=place)
        self.assertEqual(done.returncode, code, done.stderr)
        for path, content in kept.items():
            self.assertEqual(path.read_bytes(), content)
            if UNFINISHED.search(path.name):
                path.unlink()
        self.assertEqual(self.assert_whole_or_as_before(place, name, {}), (len(outputs), False))


def wait_until_signals_are_caught(process):
    """Before that a signal itself ends it; a program of ours catches them before it does anything."""
    deadline = time.monotonic() + 300
    while not int(re.search(r"SigCgt:\s+([0-9a-f]+)", Path(f"/proc/{process.pid}/status").read_text())[1], 16) >> (signal.SIGTERM - 1) & 1:
        assert process.poll() is None and time.monotonic() < deadline, "ended, or catches no signals"
        time.sleep(0.002)


def started(*args, **options):
    return subprocess.Popen([TOOL, *published(args)], **{"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE,
                                               "text": True, "start_new_session": True, "env": ENVIRONMENT, **options})


class Prepared(Case):
    """With the inputs, which a class makes once."""

    @classmethod
    def setUpClass(cls):
        Inputs.make()
        cls.addClassCleanup(shutil.rmtree, Inputs.folder)

    def some(self, of, most=2):
        names = super().some(of, most)
        for name in names:
            Inputs.know(name)
        return names

    def tries(self, names=COMMANDS):
        for name in self.some(names):
            for _ in range(TIMES):
                yield name

    @staticmethod
    def until_disturbed(name, place, again, run):
        """What run() gives: the process that was disturbed, and more. On a busy machine the first of a name may be done before it is disturbed."""
        for _ in range(50):
            process, *more = run()
            if again or process.returncode != COMMANDS[name][2]:
                break
            shutil.rmtree(place / "p", ignore_errors=True)
        return process, *more

    def moment(self, first, seconds):
        """Where a run is disturbed: the first time early, so that it is disturbed for certain; then at any time, the end included."""
        time.sleep(0 if first else self.random.uniform(0, seconds))


class Stopped(Prepared):
    def test_a_run_that_is_killed_leaves_what_was_there_or_the_whole(self):
        for name in self.tries():
            with self.subTest(name), work() as place:
                for again in range(2):  # the second time with what a killed run has left already
                    def killed():
                        old = self.old_outputs(place, name)
                        process = started(*COMMANDS[name][0], cwd=place)
                        self.moment(not again, 1.1 * Inputs.seconds[name])
                        with contextlib.suppress(ProcessLookupError):  # it was done
                            os.killpg(process.pid, signal.SIGKILL)
                        process.communicate()
                        return process, old
                    process, old = self.until_disturbed(name, place, again, killed)
                    self.assertIn(process.returncode, (-signal.SIGKILL, COMMANDS[name][2]) if again else (-signal.SIGKILL,))
                    whole, left = self.assert_whole_or_as_before(place, name, old, killed=True)
                self.assert_goes_on(place, name)
                TALLY[f"kill -9: {name}"]["as before, something unfinished beside it" if left and not whole else
                                          "whole" if whole == len(COMMANDS[name][1]) else "some outputs whole" if whole else "as before"] += 1

    def test_a_run_that_is_interrupted_leaves_nothing_unfinished(self):
        for name in self.tries():
            with self.subTest(name), work() as place:
                for again, number in enumerate((signal.SIGTERM, signal.SIGINT, signal.SIGHUP)):
                    def interrupted():
                        old = self.old_outputs(place, name)
                        process = started(*COMMANDS[name][0], cwd=place)
                        wait_until_signals_are_caught(process)
                        self.moment(not again, Inputs.seconds[name])
                        process.send_signal(number)
                        return process, old, *process.communicate(timeout=300)
                    process, old, out, err = self.until_disturbed(name, place, again, interrupted)
                    # What takes no time at all, as a merge, may be done before the signal has come.
                    may_be_done = again or Inputs.seconds[name] < 0.5
                    self.assertIn(process.returncode, (130, COMMANDS[name][2]) if may_be_done else (130,), err)
                    if process.returncode == 130:
                        self.assertIn("interrupted", err)
                        if name != "certify --certificate":  # which is written when the verdict has been told
                            self.assertNotRegex(out, "CERTIFIED|REFUTED")
                    self.assert_whole_or_as_before(place, name, old)
                    TALLY["SIGTERM, SIGINT, SIGHUP"]["interrupted" if process.returncode == 130 else "done"] += 1
                    for output in COMMANDS[name][1]:
                        (place / output).unlink(missing_ok=True)
                self.assert_goes_on(place, name)

    def test_a_run_whose_reader_goes_ends_and_leaves_nothing_unfinished(self):
        for name in self.tries():
            for again in range(2):
                with self.subTest(name, again=again), work() as place:
                    def without_reader():
                        old = self.old_outputs(place, name)
                        process = started(*COMMANDS[name][0], cwd=place)
                        self.moment(not again, Inputs.seconds[name])
                        process.stdout.close()
                        process.wait(timeout=300)
                        with process.stderr:
                            return process, old, process.stderr.read()
                    process, old, err = self.until_disturbed(name, place, again, without_reader)
                    self.assertIn(process.returncode, (2, COMMANDS[name][2]) if again else (2,))
                    if process.returncode == 2:
                        self.assertRegex(err, "cannot write")
                    self.assert_whole_or_as_before(place, name, old)
                    TALLY["standard output closed"]["refused" if process.returncode == 2 else "done"] += 1
        question = b'{"a":{"center":[0,0,0],"radius":1},"b":{"center":[1,2,2],"radius":1},"alarm":0,"contact":0}\n'

        def endless(write):
            while True:
                write(question * 100)
        reader, writer = os.pipe()
        os.close(reader)
        process = subprocess.Popen([TOOL, "explain"], stdin=subprocess.PIPE, stdout=writer, stderr=subprocess.PIPE, env=ENVIRONMENT)
        os.close(writer)
        with contextlib.suppress(BrokenPipeError), process.stdin:
            endless(process.stdin.write)
        self.assertEqual(process.wait(timeout=300), 2)
        with process.stderr:
            self.assertIn(b"standard output: cannot write", process.stderr.read())
        TALLY["standard output closed"]["refused"] += 1

    def test_an_ignored_signal_stays_ignored(self):
        name = "generate"
        Inputs.know(name)
        with work() as place:
            process = started(*COMMANDS[name][0], cwd=place, preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
            time.sleep(Inputs.seconds[name] / 2)
            process.send_signal(signal.SIGHUP)
            self.assertEqual(process.communicate(timeout=300)[1], "")
            self.assertEqual(process.returncode, 0)
            self.assertEqual(self.assert_whole_or_as_before(place, name, {})[0], 1)

    def test_an_engine_does_not_outlive_a_killed_run(self):
        for _ in range(TIMES):
            engine = self.folder / f"engine-{self.random.random()}.py"
            shutil.copy(ROOT / "docs/examples/engines/plain.py", engine)
            process = started("certify", "--generate", "100000", "--pair", "sphere_sphere", "--family", "generic", "--seed", "1",
                              "--engine-command", f"{sys.executable} {engine}", "--json", self.folder / "r.json")
            running = lambda: subprocess.run(["pgrep", "-f", engine.name], capture_output=True, text=True).stdout.split()
            deadline = time.monotonic() + 300
            while len(running()) < 2 and time.monotonic() < deadline:
                time.sleep(0.05)
            self.assertGreaterEqual(len(running()), 2, "the engine did not start")  # the host and the engine
            time.sleep(self.random.uniform(0, 0.5))
            process.kill()
            process.communicate()
            while running() and time.monotonic() < deadline:
                time.sleep(0.05)
            self.assertEqual((running(), (self.folder / "r.json").exists()), ([], False))
            TALLY["kill -9: host of an engine's process"]["the engine ended too"] += 1


def watching(processes, of):
    """Whether so many processes have begun, each with the thread that watches its parent."""
    with contextlib.suppress(FileNotFoundError):
        return len(processes) == of and all(len(os.listdir(f"/proc/{pid}/task")) > 1 for pid in processes)
    return False


@unittest.skipUnless(MPIRUN, "no contact-oracle-mpi: Boost.MPI was not found")
class Cluster(Prepared):
    def test_a_cluster_of_which_a_process_is_killed_leaves_what_was_there_or_the_whole(self):
        # Each of four processes works slower than one alone, and all of them start slowly.
        for name in self.tries(("generate", "certify", "certify --parts")):
            with self.subTest(name), work() as place:
                for victim in ("mpirun", "a process"):
                    old = self.old_outputs(place, name)
                    process = subprocess.Popen([*MPIRUN, TOOL, *COMMANDS[name][0]], cwd=place, env=ENVIRONMENT, text=True, start_new_session=True,
                                               stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
                    ranks = lambda: [int(pid) for pid in subprocess.run(["pgrep", "-fx", re.escape(" ".join([TOOL, *COMMANDS[name][0]]))],
                                                                        capture_output=True, text=True).stdout.split()]
                    deadline = time.monotonic() + 300
                    # From the first thing that it does on, each watches its parent; one whose parent went before cannot know.
                    while not watching(ranks(), 4) and process.poll() is None and time.monotonic() < deadline:
                        time.sleep(0.02)
                    self.assertTrue(ranks(), "no process has started")
                    early = TIMES == 1 or self.random.random() < 0.2
                    self.moment(early, 1 + Inputs.seconds[name])
                    with contextlib.nullcontext() if early else contextlib.suppress(ProcessLookupError, IndexError):
                        os.kill(process.pid if victim == "mpirun" else self.random.choice(ranks()), signal.SIGKILL)
                    out, err = after_a_death(process, ranks)
                    while ranks() and time.monotonic() < deadline:
                        time.sleep(0.05)
                    self.assertEqual(ranks(), [], "processes outlive their cluster")
                    done = process.returncode == COMMANDS[name][2]
                    self.assertFalse(early and done, "nothing was killed")
                    whole, _ = self.assert_whole_or_as_before(place, name, old, killed=True)
                    if not done:
                        self.assertNotIn(process.returncode, (0, 1), err)
                        if re.search("CERTIFIED|REFUTED", out):  # killed when all was said and done
                            self.assertEqual(whole, len(COMMANDS[name][1]))
                    elif victim != "mpirun":
                        self.assertEqual(whole, len(COMMANDS[name][1]), err)
                    TALLY[f"kill -9: {victim} of four"]["done" if done else "no result, and said so" if whole < len(COMMANDS[name][1]) else "whole, and said so"] += 1
                self.assert_goes_on(place, name)


class Disks(Prepared):
    @contextlib.contextmanager
    def disk(self, *options):
        place = Inputs.folder / "disk"
        if not IS_ROOT or subprocess.run(["mount", "-t", "tmpfs", *options, "tmpfs", place], capture_output=True).returncode != 0:
            self.skipTest("only root can mount a disk")
        try:
            yield place
        finally:
            subprocess.run(["umount", place], check=True)

    def room(self, size):
        """Too little for so many bytes; where there are many tries, sometimes enough."""
        return int((0.5 if TIMES == 1 else self.random.uniform(0, 1.2)) * size)

    def check(self, fault, name, place, old, done, too_little, *words):
        self.assertIn(done.returncode, (2,) if too_little else (2, COMMANDS[name][2]), done.stderr)
        whole, _ = self.assert_whole_or_as_before(place, name, old)
        if done.returncode == 2:
            self.assertRegex(done.stderr, r"cannot write: .*(" + "|".join(words) + ")|cannot write to file")
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        else:
            self.assertEqual(whole, len(COMMANDS[name][1]))
        TALLY[fault]["refused" if done.returncode == 2 else "it was large enough"] += 1

    def test_a_full_disk(self):
        for name in self.some(COMMANDS):
            args = COMMANDS[name][0]
            size = sum(map(len, Inputs.whole[name].values()))
            for _ in range(TIMES):
                room = max(8192, self.room(size))
                with self.subTest(name, room=room), self.disk("-o", f"size={room}"), work() as place:
                    old = self.old_outputs(place, name)
                    self.check("disk full", name, place, old, tool(*args, cwd=place), room < 0.9 * size, "No space left on device")

    def test_a_file_that_may_not_grow(self):
        for name in self.some(COMMANDS):
            args = COMMANDS[name][0]
            size = max(map(len, Inputs.whole[name].values()))
            for _ in range(TIMES):
                limit = self.room(size)
                with self.subTest(name, limit=limit), work() as place:
                    old = self.old_outputs(place, name)
                    done = tool(*args, cwd=place, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
                    self.check("file size limited", name, place, old, done, limit < size, "File too large")

    def test_a_read_only_disk_and_a_folder_of_somebody_else(self):
        for name in self.some(COMMANDS):
            args = COMMANDS[name][0]
            with self.subTest(name), self.disk() as disk, work() as place:
                old = self.old_outputs(place, name)
                subprocess.run(["mount", "-o", "remount,ro", disk], check=True)
                done = tool(*args, cwd=place)
                subprocess.run(["mount", "-o", "remount,rw", disk], check=True)
                self.assertEqual(done.returncode, 2)
                self.assertRegex(done.stderr, r"cannot write: Read-only file system|no folder, and none can be made here")
                self.assert_whole_or_as_before(place, name, old)
                TALLY["read-only disk"]["refused"] += 1
            with self.subTest(name), work() as place:
                old = self.old_outputs(place, name)
                Inputs.folder.chmod(0o755)
                done = tool(*args, cwd=place, by=["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups", "--inh-caps=-all"])
                self.assertEqual(done.returncode, 2)
                self.assertRegex(done.stderr, r"cannot write: Permission denied|no folder, and none can be made here")
                self.assert_whole_or_as_before(place, name, old)
                TALLY["folder without the right to write"]["refused"] += 1

    def test_a_device_that_fails(self):
        for args in (("certify", FLAT, "--results"), ("certify", FLAT, "--baseline"), ("explain",), ("detect",), ("verify",), ("merge",), ("lint",)):
            with self.subTest(args[0]):
                self.refused("device that fails", (*args, "/proc/self/mem"), "/proc/self/mem", "cannot read")

    def test_standard_output_on_a_full_disk(self):
        with open("/dev/full", "w") as full:
            for name in self.some(COMMANDS):
                args = COMMANDS[name][0]
                with self.subTest(name), work() as place:
                    done = tool(*args, cwd=place, capture_output=False, stdout=full, stderr=subprocess.PIPE)
                    self.assertEqual(done.returncode, 2)
                    self.assertIn("cannot write", done.stderr)
                    self.assert_whole_or_as_before(place, name, {})
                    TALLY["standard output on a full disk"]["refused"] += 1


class Together(Prepared):
    def test_runs_at_once_on_one_output_write_one_whole_of_theirs(self):
        for _ in range(TIMES):
            with work() as place:
                runs = [started("generate", "--pair", "sphere_sphere", "--family", "touching", "--count", str(400 * SIZE), "--seed", str(seed),
                                "-o", "g.jsonl", cwd=place) for seed in range(4)]
                victim = self.random.randrange(8)
                time.sleep(self.random.uniform(0, 1))
                if victim < 4:
                    runs[victim].kill()
                for i, process in enumerate(runs):
                    _, err = process.communicate(timeout=300)
                    self.assertIn(process.returncode, (0, -signal.SIGKILL) if i == victim else (0,), err)
                self.assertEqual(tool("lint", "--generated", place / "g.jsonl").returncode, 0)
                left = [path.name for path in place.iterdir() if path.name not in ("in", "g.jsonl")]
                self.assertTrue(len(left) <= (victim < 4) and all(map(UNFINISHED.search, left)), left)
                TALLY["four runs at once on one output"]["one of theirs, whole"] += 1

    def test_runs_at_once_on_one_folder_of_parts_say_the_same(self):
        name = "certify --parts"
        Inputs.know(name)
        for _ in range(TIMES):
            with work() as place:
                names = [(*FRESH, "--generate", str(1500 * SIZE), "--parts", "p", "--shards", "16", "--json", f"{i}.json") for i in range(3)]
                for process in [started(*args, cwd=place) for args in names]:
                    _, err = process.communicate(timeout=300)
                    self.assertEqual(process.returncode, 1, err)
                for i in range(3):
                    self.assertEqual((place / f"{i}.json").read_bytes(), Inputs.whole[name]["r.json"])
                self.assertEqual([path for path in (place / "p").iterdir() if path.suffix != ".part"], [])
                TALLY["three runs at once on one folder of parts"]["the same report"] += 1

    def test_two_outputs_of_one_run_have_two_names(self):
        (self.folder / "link.json").symlink_to("x.json")
        for second in ("x.json", "./x.json", "link.json"):
            self.refused("two outputs of one name", ("certify", FLAT, "--json", self.folder / "x.json", "--junit", self.folder / second),
                         "x.json", "another output of that name")
            self.assertEqual([path.name for path in self.folder.iterdir()], ["link.json"])


class Descriptors(Case):
    def test_a_run_that_may_open_few_files_ends_as_it_should_or_says_so(self):
        command = f"{TOOL} serve"
        for most in (*range(6, 20), 256):
            with self.subTest(most):
                done = tool("certify", FLAT, "--fresh", 0, "--engine-command", command,
                            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_NOFILE, (most, most)))
                if most < 20 and done.returncode != 0:  # opening an input, or starting the engine
                    self.assertIn(done.returncode, (2, 3), done.stderr)
                    self.assertRegex(done.stderr, "(?i)too many open files")
                    TALLY["few files may be open"]["refused"] += 1
                else:
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.assertIn("CERTIFIED", done.stdout)
                    TALLY["few files may be open"]["done"] += 1


class Links(Case):
    def test_outputs_that_are_links(self):
        (self.folder / "real").mkdir()
        for name, to, code in (("there", "real/a.json", 0), ("dangling", "real/b.json", 0), ("chain", "dangling2", 0), ("loop", "loop2", 2),
                               ("nowhere", "gone/x.json", 2), ("folder", "real", 2), ("null", "/dev/null", 0), ("full", "/dev/full", 2)):
            (self.folder / name).symlink_to(to)
        (self.folder / "dangling2").symlink_to("real/c.json")
        (self.folder / "loop2").symlink_to("loop")
        self.file("real/a.json", "old\n")
        for name, lands, code, words in (("there", "real/a.json", 0, ""), ("dangling", "real/b.json", 0, ""), ("chain", "real/c.json", 0, ""),
                                         ("loop", None, 2, "Too many levels of symbolic links"), ("nowhere", None, 2, "No such file or directory"),
                                         ("folder", None, 2, "it is a directory"), ("null", None, 0, ""), ("full", None, 2, "No space left on device")):
            with self.subTest(name):
                done = tool("certify", FLAT, "--json", self.folder / name)
                self.assertEqual(done.returncode, code, done.stderr)
                self.assertIn(words, done.stderr)
                self.assertTrue((self.folder / name).is_symlink())
                if lands:
                    self.assertEqual(json.loads((self.folder / lands).read_text())["verdict"][:9], "CERTIFIED")
                TALLY["outputs that are links"]["written where it leads" if code == 0 else "refused"] += 1
        self.assertEqual([path for path in self.folder.rglob("*") if UNFINISHED.search(path.name)], [])

    def test_inputs_in_a_folder_that_are_links_are_followed_or_refused_and_never_passed_over(self):
        for name, make, *words in (("dangling", lambda path: path.symlink_to("/nowhere/x"), "no such file"),
                                   ("a loop", lambda path: path.symlink_to(path.name), "Too many levels of symbolic links"),
                                   ("a pipe", os.mkfifo, "not a regular file")):
            for command in ("certify", "lint"):
                with self.subTest(name, command=command), tempfile.TemporaryDirectory() as folder:
                    shutil.copy(FLAT, folder)
                    path = Path(folder) / "zz.jsonl"
                    make(path)
                    self.refused("inputs that are links or pipes", (command, folder), path, *words)
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "around").symlink_to(".")  # a folder in itself
            (Path(folder) / "flat.jsonl").symlink_to(FLAT)
            done = tool("certify", folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("all 210 judged cases", done.stdout)


class Endless(Prepared):
    """What has no end, or claims to be larger than any memory."""

    HEADER = FLAT.read_text().splitlines(True)[0]

    def readers(self):
        """Every reader of lines and of whole files, what stands before the endless line, and the most memory in megabytes."""
        part = next((Inputs.folder / "in" / "parts").glob("*.part")).read_bytes().split(b"\n")[0].decode() + "\n"
        results = (GOLDEN / "recorded/sofa-2a278d8/sphere_sphere.jsonl").read_text().splitlines(True)[0]
        scene = (ROOT / "docs/examples/scenes/drops.jsonl").read_text().splitlines(True)[0]
        for name, args, head, place, most in (
                ("dataset", ("certify",), self.HEADER, ":2: ", 80), ("dataset's header", ("lint",), "", ":1: ", 80),
                ("results", ("certify", FLAT, "--results"), results, ":2: ", 80), ("questions", ("explain",), "", ":1: ", 80),
                ("questions to annotate", ("annotate", "-o", self.folder / "a.jsonl"), "", ":1: ", 80),
                ("scene", ("detect",), scene, ":2: ", 700), ("part", ("merge",), part, "", 700), ("part's header", ("merge",), "", ":1: ", 700),
                ("baseline", ("certify", FLAT, "--baseline"), "", "", 700), ("certificate", ("verify",), "", "", 700)):
            yield name, args, head, place, most

    def test_a_line_of_a_gigabyte_is_refused_before_it_is_read(self):
        # One that stops at its limit and one that reads as far as a whole file may go: the others are for the campaign.
        for name, args, head, place, most in self.readers():
            if TIMES == 1 and name not in ("dataset", "questions", "part"):
                continue
            for filled in ("\0", "x") if TIMES > 1 else ("\0",):
                with self.subTest(name, filled=filled):
                    path = self.file("long.jsonl", head)
                    if filled == "\0":  # of which none needs a disk
                        os.truncate(path, len(head) + (1 << 30))
                    else:
                        with path.open("a") as file:
                            for _ in range(1 << 10):
                                file.write(filled * MEGABYTE)
                    self.refused("lines of a gigabyte", (*args, path), f"{path}{place}", "more than", "bytes", most=most)

    def test_a_pipe_that_never_ends(self):
        for args in (("explain",), ("serve",), ("annotate", "-", "-o", self.folder / "a.jsonl"), ("detect", "-"))[:2 if TIMES == 1 else 4]:
            with self.subTest(args[0]):
                def feed(write):
                    for _ in range(1 << 10):
                        write(b"[" * MEGABYTE)
                self.refused("lines of a gigabyte", args, "-:1: a line of more than", most=700, feed=feed)

    def test_what_is_as_long_as_it_may_be_is_read_in_bounded_memory(self):
        # Just below the limits: the worst that a parser can make of a line are many small values.
        for name, args, text, words in (("question", ("explain",), '{"a":[' + "0," * (MEGABYTE // 2 - 8) + "0]}", "a: expected an object"),
                                        ("key", ("explain",), '{"' + "k" * (MEGABYTE - 100) + '":1}', "unknown key"),
                                        ("repeated key", ("explain",), '{"' + "k" * 1000 + '":1,"' + "k" * 1000 + '":1}', "twice in one object"),
                                        ("token", ("explain",), '{"a":"' + "k" * (MEGABYTE - 100), "malformed JSON"),
                                        ("number", ("explain",), '{"a":' + "9" * (MEGABYTE - 100) + "}", "")):
            with self.subTest(name):
                self.refused("the longest lines", (*args, self.file("long.jsonl", text + "\n")), "long.jsonl:1: ", words, most=120)

    def test_json_a_million_deep(self):
        for opening in ('{"a":', "["):
            for name, args, head, place, most in self.readers():
                with self.subTest(name, opening=opening):
                    deep = opening * (150_000 if opening == '{"a":' else 1_000_000)
                    self.refused("deep JSON", (*args, self.file("deep.jsonl", head + deep + "\n")), self.folder / "deep.jsonl", most=150)

    def test_more_files_than_a_report_has_room_for(self):
        one = self.folder / "one.jsonl"
        self.assertEqual(tool("generate", "--pair", "cube_cube", "--family", "generic", "--count", 1, "--seed", 1, "-o", one).returncode, 0)
        base = tempfile.TemporaryDirectory(dir="/dev/shm" if os.access("/dev/shm", os.W_OK) else None)
        self.addCleanup(base.cleanup)
        most = 100_000
        few = 2000 if TIMES == 1 else most

        def link(which):
            for i in which:
                os.makedirs(f"{base.name}/{i // 1000}", exist_ok=True)
                os.symlink(one, f"{base.name}/{i // 1000}/{i}.jsonl")
        link(range(few))
        for args in (("certify",), ("lint",)):
            code, said, megabytes = measured(*args, base.name)
            self.assertEqual((code, said), (0, ""))
            if not SANITIZED:
                self.assertLess(megabytes, 60 + few * 0.006)
            PEAK[f"{few:,} files"] = max(PEAK[f"{few:,} files"], megabytes)
            TALLY[f"{few:,} files"]["right"] += 1
        if TIMES == 1:
            return
        many = 1_000_000
        link(range(few, many))
        for args in (("certify",), ("lint",)):
            self.refused(f"{many:,} files", (*args, base.name), base.name, f"more than {most} datasets")


class Columns(Case):
    """Small files of HDF5 that ask for much memory, or for what is not in them."""

    def setUp(self):
        super().setUp()
        try:
            import h5py
            import numpy
        except ImportError:
            self.skipTest("no h5py here")
        self.h5py, self.numpy = h5py, numpy
        self.good = self.folder / "good.h5"
        made = tool("generate", "--pair", "cube_cube", "--family", "nested", "--count", "5000", "--seed", "7", "-o", self.good)
        self.assertEqual(made.returncode, 0, made.stderr)

    def test_bombs(self):
        h5py, numpy = self.h5py, self.numpy
        most = 8 if TIMES > 1 else 1

        def anew(path, **how):
            """The column as it was, but stored in another way; h5py's own name for the ways."""
            def change(file):
                old = file[path]
                data, attributes = old[:], dict(old.attrs)
                del file[path]
                file.create_dataset(path, **{"data": data, **how}).attrs.update(attributes)
            return change

        def inflating(path, megabytes):
            """A chunk that says it holds 4096 rows, and inflates to so many megabytes."""
            import zlib

            def change(file):
                packer = zlib.compressobj(9)
                packed = b"".join([*(packer.compress(bytes(MEGABYTE)) for _ in range(megabytes)), packer.flush()])
                shape, dtype = file[path].shape, file[path].dtype
                del file[path]
                column = file.create_dataset(path, shape, dtype, chunks=(4096, *shape[1:]), compression="gzip")
                column.id.write_direct_chunk((0,) * len(shape), packed)
                column.id.write_direct_chunk((4096,) + (0,) * (len(shape) - 1), packed)
            return change

        def declared(count):
            """Rows without end that are nowhere, each the same right question."""
            def change(file):
                columns = []
                file.visititems(lambda name, item: columns.append(name) if isinstance(item, h5py.Dataset) else None)
                file.attrs["count"] = numpy.uint64(count)
                for name in columns:
                    first, attributes, shape = file[name][0], dict(file[name].attrs), file[name].shape
                    del file[name]
                    value = first if numpy.ndim(first) == 0 else first[0]
                    file.create_dataset(name, (count, *shape[1:]), file[name].dtype if name in file else numpy.asarray(first).dtype,
                                        chunks=(4096, *shape[1:]), fillvalue=value, compression="gzip").attrs.update(attributes)
            return change

        def nested(file):
            group = file
            for _ in range(400 * most):
                group = group.create_group("a" * 1000)

        def attributes(file):
            for i in range(500 * most):
                file.attrs[f"x{i}"] = 0

        def virtual(file):
            del file["alarm"]
            layout = h5py.VirtualLayout((5000,), "<f8")
            layout[:] = h5py.VirtualSource(str(self.good), "contact", (5000,))
            file.create_virtual_dataset("alarm", layout)

        def linked(make):
            def change(file):
                del file["alarm"]
                file["alarm"] = make()
            return change

        def around(file):
            file["a/around"] = file["/"]

        table = {
            "a chunk that inflates without end": (inflating("id", 300 * most), "/id", "more than its"),
            "numbers that inflate without end": (inflating("a/min", 300 * most), "/a/min", "more than its"),
            "a chunk that inflates to much": (inflating("id", 100), "id: "),
            "a chunk larger than memory": (anew("alarm", maxshape=(None,), chunks=(most << 23,), compression="gzip"), "/alarm", "more than 33554432 bytes"),
            "10^12 rows that are nowhere": (declared(1 << 40), "not stored"),
            "2^63 rows": (lambda file: file.attrs.__setitem__("count", numpy.uint64(1 << 63)), ""),
            "a filter that is none of ours": (anew("alarm", chunks=True, compression="lzf"), "/alarm", "filters"),
            "two filters of one kind": (anew("alarm", chunks=True, scaleoffset=3), "/alarm", "filters"),
            "hundreds of groups, one in the other": (nested, "more than 256"),
            "a group in itself": (around, "/a/around"),
            "hundreds of attributes": (attributes, "more than 64"),
            "a long text": (lambda file: file.attrs.__setitem__("family", numpy.bytes_(b"x" * 60000)), "sha256"),
            "4096 numbers for one": (lambda file: file.attrs.create("seed", numpy.zeros(4096, "u8")), "short list"),
            "a virtual column": (virtual, "/alarm", "chunks"),
            "a column of another file": (linked(lambda: h5py.ExternalLink(str(self.good), "contact")), "/alarm"),
            "a link": (linked(lambda: h5py.SoftLink("/contact")), "/alarm"),
            "a link to itself": (linked(lambda: h5py.SoftLink("/alarm")), "/alarm"),
        }
        for name, (change, *words) in table.items():
            path = self.folder / "bomb.h5"
            shutil.copy(self.good, path)
            # Elsewhere: what this process had in memory before counts as its children's.
            if (maker := os.fork()) == 0:
                with contextlib.suppress(BaseException):
                    with h5py.File(path, "r+") as file:
                        change(file)
                    os._exit(0)
                os._exit(1)
            self.assertEqual(os.waitpid(maker, 0)[1], 0, name)
            for args in self.some((("certify", path), ("lint", "--generated", path), ("convert", path, "-o", self.folder / "x.jsonl")), 1):
                with self.subTest(name, command=args[0]):
                    self.refused("hostile HDF5", args, path, *words, most=400)


class Parts(Case):
    """Parts of a run whose digest is right, and whose bytes are anything."""

    def test_bytes_that_no_run_wrote_under_the_digest_that_they_have(self):
        path = self.folder / "part-0-of-1.part"
        self.assertEqual(tool(*FRESH, "--generate", 50, "--parts", self.folder, "--shards", 1).returncode, 1)
        line, _, good = path.read_bytes().partition(b"\n")
        head, _, _ = line.decode().rpartition(',"bytes":')
        run = head[head.index('"run":') + len('"run":'):]

        def write(content):
            digest = hashlib.sha256(f"0/1{run}".encode() + content).hexdigest()
            path.write_bytes(f'{head},"bytes":{len(content)},"sha256":"{digest}"}}\n'.encode() + content)
        write(good)
        self.assertEqual(path.read_bytes(), line + b"\n" + good)
        # A failure's pair stands behind its id, and its question is made for that pair.
        self.assertEqual(tool("merge", path, "--json", self.folder / "r.json").returncode, 1)
        failure = json.loads((self.folder / "r.json").read_text())["failures"][0]["id"].encode()
        pairs = [match.end() for match in re.finditer(failure, good)]
        self.assertTrue(pairs)
        for at in pairs:
            write(good[:at] + b"\xff" + good[at + 1:])
            code, said, _ = measured("merge", path)
            self.assertIn((code, len(said.splitlines())), ((1, 0), (2, 1)), said[:500])
        refused = tries = 0
        for _ in range(100 if TIMES == 1 else 1000 * TIMES):
            at, kind = self.random.randrange(len(good)), self.random.choice(("size", "enumeration", "bit", "less"))
            content = bytearray(good)
            if kind == "size":  # where it is one, of more than any memory
                content[at:at + 8] = (1 << 40).to_bytes(8, "little")
            elif kind == "less":
                del content[at]
            else:
                content[at] = 255 if kind == "enumeration" else content[at] ^ 1 << self.random.randrange(8)
            write(content)
            with self.subTest(kind, at=at):
                code, said, megabytes = measured("merge", path, "--json", self.folder / "r.json", "--report", self.folder / "r.html")
                self.assertIn((code, len(said.splitlines())), ((0, 0), (1, 0), (2, 1)), said[:500])
                if not SANITIZED:
                    self.assertLess(megabytes, 80, said)
                PEAK["hostile parts"] = max(PEAK["hostile parts"], megabytes)
                TALLY["hostile parts"]["refused" if code == 2 else "merged"] += 1
            tries, refused = tries + 1, refused + (code == 2)
        # What is no part is refused; another number in its place makes another part, and nobody can tell.
        self.assertGreater(refused, tries // 10)
        self.assertLess(refused, tries)


class Clocks(Case):
    FAKE = next((str(path) for path in Path("/usr/lib").glob("*/faketime/libfaketimeMT.so.1")), "")

    def certificate(self, **environment):
        path = self.folder / "k.json"
        done = tool("certify", FLAT, "--certificate", path, env={**os.environ, **environment})
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(path.read_text())["issued"]

    def test_days_at_the_ends_of_time(self):
        for epoch, day in (("0", "1970-01-01"), ("2147483648", "2038-01-19"), ("253402300799", "9999-12-31")):
            self.assertEqual(self.certificate(SOURCE_DATE_EPOCH=epoch), day)
            # A certificate that says a day to come is refused, whatever its day was taken from.
            self.assertEqual(tool("verify", self.folder / "k.json").returncode, 0 if epoch == "0" else 2)
            TALLY["days at the ends of time"]["right"] += 1
        for epoch in ("", "-1", "253402300800", "1e9", "18446744073709551616", "x"):
            done = tool("certify", FLAT, "--certificate", self.folder / "no.json", env={**os.environ, "SOURCE_DATE_EPOCH": epoch})
            self.assertEqual(done.returncode, 2, epoch)
            self.assertIn("SOURCE_DATE_EPOCH", done.stderr)
            self.assertFalse((self.folder / "no.json").exists())
            TALLY["days that are none"]["refused"] += 1

    @unittest.skipUnless(FAKE and not SANITIZED, "no libfaketime here")
    def test_a_clock_that_jumps_changes_no_verdict(self):
        rc = self.file("clock", "+0")
        environment = {**ENVIRONMENT, "LD_PRELOAD": self.FAKE, "FAKETIME_TIMESTAMP_FILE": str(rc), "FAKETIME_NO_CACHE": "1",
                       "DONT_FAKE_MONOTONIC": "1"}  # as a set clock is: what runs on steadily does not jump
        del environment["SOURCE_DATE_EPOCH"]
        args = (*FRESH[:1], "--generate", str(500 * SIZE), *FRESH[3:], "--engine-command", f"{sys.executable} docs/examples/engines/plain.py",
                "--answer-limit", "20", "--max-time", "300")
        whole = tool(*args, "--json", self.folder / "whole.json")
        self.assertEqual(whole.returncode, 1, whole.stderr)
        for _ in range(TIMES):
            process = started(*args, "--json", str(self.folder / "r.json"), cwd=ROOT, env=environment)
            jumps = 0
            while process.poll() is None:
                other = self.file("other", self.random.choice(("+0", "-40y", "+60y", "-1d", "+1h", "-300")))
                other.replace(rc)  # at once: nobody reads half a time
                jumps += 1
                time.sleep(self.random.uniform(0.01, 0.05))
            process.communicate()
            self.assertEqual(process.returncode, whole.returncode)
            self.assertEqual((self.folder / "r.json").read_bytes(), (self.folder / "whole.json").read_bytes())
            self.assertGreater(jumps, 2)
            TALLY["the clock set while it runs"]["the same report"] += 1
        for day, expected in (("@1970-01-02 00:00:00", "1970-01-02"), ("@2038-01-20 00:00:00", "2038-01-20"), ("@2200-03-01 00:00:00", "2200-03-01")):
            done = tool("certify", FLAT, "--certificate", self.folder / "k.json",
                        env={**{k: v for k, v in os.environ.items() if k != "SOURCE_DATE_EPOCH"}, "LD_PRELOAD": self.FAKE, "FAKETIME": day, "TZ": "UTC"})
            self.assertEqual((done.returncode, json.loads((self.folder / "k.json").read_text())["issued"]), (0, expected), done.stderr)
            TALLY["days at the ends of time"]["right"] += 1


def table():
    rows = [("fault", "tried", "outcome")]
    for fault, outcomes in TALLY.items():
        said = ", ".join(outcome if len(outcomes) == 1 else f"{outcome} {count}" for outcome, count in outcomes.most_common())
        rows.append((fault, str(sum(outcomes.values())), said + (f"; {PEAK[fault]:.0f} MB at most" if fault in PEAK else "")))
    widths = [max(len(row[i]) for row in rows) for i in range(2)]
    return "\n".join(f"{row[0]:<{widths[0]}}  {row[1]:>{widths[1]}}  {row[2]}" for row in rows)


if __name__ == "__main__":
    print(f"seed {OPTIONS.seed}", flush=True)
    ran = unittest.main(argv=[sys.argv[0], *REST], exit=False, catchbreak=True)
    print(table())
    sys.exit(not ran.result.wasSuccessful())
