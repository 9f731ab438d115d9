#!/usr/bin/env python3
"""Is every change of our own code found by a test? Scores by component:  python3 dev/mutation/mutate.py [COMPONENT...]

C++ is rewritten so that all mutants are in one build, build/mutation, and CONTACT_MUTANT chooses one (mutant.hpp). Each test is run
once to record which mutants change a value during it; a mutant is then put to these tests alone, the most promising first, until one
fails. What survives is killed by a new test, or explained in explained.jsonl, one entry a mutant. docs/mutation-testing.md"""
import argparse
import collections
import contextlib
import hashlib
import json
import math
import os
import random
import re
import shlex
import signal
import subprocess
import sys
import tempfile
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
TREE = ROOT / "build" / "mutation"  # a copy of the tree, rewritten
BUILD = TREE / "build" / "release"  # as far from its tree as build/release from ours, so that ccache finds what is the same
EXPLAINED = HERE / "explained.jsonl"
PAGE = ROOT / "docs" / "mutation-testing.md"
# A mutant is put to these tests thousands of times: fewer questions than they ask otherwise.
ENVIRONMENT = {"CONTACT_BATCH_QUESTIONS": "80"}
KINDS = 4  # mutants a place, at most: mutant.hpp

COMPONENTS = {
    "kernel": ["src/kernel/plane_cores.cpp", "src/kernel/plane_cores.hpp",
               "src/kernel/crossing_cores.cpp", "src/kernel/crossing_cores.hpp",
               "src/kernel/casts.cpp", "src/kernel/convexes.cpp",
               "src/kernel/convexes_enclosed-inl.h", "src/kernel/convexes_enclosed.hpp", "src/kernel/convexes_filter.hpp",
               "src/kernel/enclosure-inl.h", "src/kernel/expanding_polytope.hpp",
               "src/kernel/core_pairs.cpp", "src/kernel/core_pairs.hpp", "src/kernel/cores.cpp", "src/kernel/cores_double_double.hpp",
               "src/kernel/cores_one_vector.hpp", "src/kernel/cores_stages.hpp", "src/kernel/simple_points.hpp", "src/kernel/segment_cores.cpp", "src/kernel/segment_cores.hpp",
               "src/kernel/triangle_cores.cpp", "src/kernel/triangle_cores.hpp",
               "src/kernel/cube_cube.cpp", "src/kernel/exact.cpp", "src/kernel/exact.hpp", "src/kernel/exact_sum.cpp",
               "src/kernel/double_double-inl.h", "src/kernel/fixed_integer.hpp", "src/kernel/floating_point_environment.hpp",
               "src/kernel/sphere_cube.cpp", "src/kernel/sphere_sphere.cpp", "src/kernel/sphere_sphere_double_double.hpp", "include/contact/plain_cores.hpp", "include/contact/plain_decision.hpp",
               "src/kernel/sphere_sphere_formula-inl.h", "src/kernel/sphere_sphere_one_vector-inl.h",
               "src/kernel/sphere_sphere_one_vector.hpp", "src/kernel/sphere_sphere_scaled.hpp", "src/kernel/sum_of_two-inl.h"],
    "batch": ["src/kernel/batch.cpp", "src/kernel/batch.hpp", "src/kernel/batch_arithmetic-inl.h", "src/kernel/batch_columns-inl.h",
              "src/kernel/batch_cores.cpp", "src/kernel/batch_cores-inl.h", "src/kernel/batch_crossing-inl.h",
              "src/kernel/batch_over_plane-inl.h", "src/kernel/batch_point_segment-inl.h", "src/kernel/batch_ways-inl.h",
              "src/kernel/batch_cube_cube.cpp", "src/kernel/batch_finishing-inl.h", "src/kernel/batch_lifted-inl.h", "src/kernel/batch_near_touching-inl.h",
              "src/kernel/batch_balls-inl.h", "src/kernel/batch_scalar.cpp", "src/kernel/batch_sphere_cube-inl.h", "src/kernel/batch_sphere_sphere.cpp",
              "src/kernel/batch_targets.cpp"],
    "oracle": ["oracle/gradient/gradient.cpp", "oracle/gradient/germ.hpp", "oracle/gradient/gradient.hpp", "oracle/truth/casts.cpp", "oracle/truth/casts.hpp", "oracle/truth/clamped.hpp", "oracle/truth/core.hpp", "oracle/truth/cores.cpp",
               "oracle/truth/cores.hpp", "oracle/truth/crossings.cpp", "oracle/truth/crossings.hpp",
               "oracle/truth/double_double.hpp", "oracle/truth/double_double_convexes.cpp", "oracle/truth/double_double_crossings.cpp",
               "oracle/truth/double_double_nearest.hpp", "oracle/truth/double_double_oracle.cpp", "oracle/truth/double_double_planes.cpp",
               "oracle/truth/double_double_segments.cpp", "oracle/truth/double_double_segments.hpp",
               "oracle/truth/exact.cpp", "oracle/truth/exact.hpp", "oracle/truth/exact_pairs.cpp", "oracle/truth/exact_truth.cpp",
               "oracle/truth/exact_truth.hpp", "oracle/truth/expectation.hpp", "oracle/truth/grid.hpp", "oracle/truth/interval.hpp", "oracle/truth/interval_rough.hpp",
               "oracle/truth/interval_casts.cpp", "oracle/truth/interval_convexes.cpp", "oracle/truth/interval_cores.cpp",
               "oracle/truth/interval_cores.hpp", "oracle/truth/interval_crossings.cpp",
               "oracle/truth/interval_oracle.cpp", "oracle/truth/query.cpp", "oracle/truth/query.hpp", "oracle/truth/quick_witness.cpp", "oracle/truth/separation.cpp",
               "oracle/truth/sphere_cube_double_double.cpp", "oracle/truth/sphere_sphere_double_double.cpp",
               "oracle/truth/sphere_triangle_double_double.cpp", "oracle/truth/staged_oracle.cpp", "oracle/truth/staged_oracle.hpp",
               "oracle/truth/truth.cpp", "oracle/truth/truth.hpp", "oracle/truth/witness.cpp"],
    "judge": ["oracle/judge/certain.cpp", "oracle/judge/conditioning.cpp", "oracle/judge/declaration.hpp", "oracle/judge/judge.cpp", "oracle/judge/judge.hpp", "oracle/judge/manifold.cpp", "oracle/judge/near_optimal.cpp", "oracle/judge/off.cpp", "oracle/judge/point_set.cpp", "oracle/judge/right_claim.cpp", "oracle/judge/verdict.hpp"],
    "diagnosis": ["oracle/diagnosis/pairs.cpp", "oracle/diagnosis/wrong_planes.cpp", "oracle/diagnosis/wrong_crossings.cpp",
                  "oracle/diagnosis/casts.cpp", "oracle/diagnosis/convexes.cpp", "oracle/diagnosis/casts_in_reals.hpp",
                  "oracle/diagnosis/cube_cube.cpp", "oracle/diagnosis/sphere_cube.cpp", "oracle/diagnosis/sphere_triangle.cpp", "oracle/diagnosis/cover.cpp", "oracle/diagnosis/cover.hpp", "oracle/diagnosis/diagnosis.cpp", "oracle/diagnosis/diagnosis.hpp",
                  "oracle/diagnosis/formulas.hpp", "oracle/diagnosis/hypotheses.cpp", "oracle/diagnosis/hypotheses.hpp",
                  "oracle/diagnosis/nearest_in_reals.hpp", "oracle/diagnosis/wrong_arithmetic.cpp", "oracle/diagnosis/wrong_decisions.cpp",
                  "oracle/diagnosis/wrong_convexes.cpp", "oracle/diagnosis/wrong_features.cpp", "oracle/diagnosis/wrong_fields.cpp",
                  "oracle/diagnosis/wrong_inputs.cpp"],
    "lint": ["golden/lint.cpp", "golden/right_case.cpp", "tool/commands/lint.cpp"],
    "verify": ["golden/verify.py"],
}
TARGETS = ["kernel_test", "batch_test", "oracle_test", "golden_test", "engines_test", "contact-oracle"]
# What the rewritten code calls stands after these lines.
HOOKS = [
    ("namespace hn = hwy::HWY_NAMESPACE;", "mutant_vectors.hpp"),
    ('#define CONTACT_LANES [[gnu::always_inline, gnu::target("avx2,fma")]] inline', "mutant_intrinsics.hpp"),
    ("/// A constant in every lane.", "mutant_masks.hpp"),
    ("// On these lanes:", "mutant_lanes.hpp"),
]
# Highway's vectors are parsed twice: what is compiled for AVX-512 alone, and what for all others.
VECTOR_PARSES = [["-march=haswell", "-DHWY_COMPILE_ONLY_STATIC"], ["-march=skylake-avx512", "-DHWY_COMPILE_ONLY_STATIC"]]


def say(*words):
    print(*words, file=sys.stderr, flush=True)


def output(command, **options):
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, **options)
    if done.returncode != 0:
        sys.exit(f"{shlex.join(map(str, command))}: exit status {done.returncode}\n{done.stdout[-4000:]}{done.stderr[-4000:]}")
    return done.stdout


def write(path, text):
    """Writes a file that differs; never through a link."""
    data = text if isinstance(text, bytes) else text.encode()
    if path.exists() and path.read_bytes() == data:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    path.unlink(missing_ok=True)
    path.write_bytes(data)


# What there is to change.


def keyed(entries):
    """Gives each mutant its name: file, line as it stands there, change, and which of several such."""
    count = collections.Counter()
    for entry in entries:
        key = entry["file"], entry["line"], entry["change"]
        count[key] += 1
        entry["nth"] = count[key]
    return entries


def name(entry):
    return "|".join((entry["file"], entry["line"], entry["change"], str(entry["nth"])))


def python_mutants(component, file):
    import python_mutants as python
    text = (ROOT / file).read_text()
    lines = text.splitlines()
    return keyed([{"component": component, "file": file, "at": c.line, "line": lines[c.line - 1].strip(), "change": c.what, "text": c.text}
                  for c in python.changes(text)])


class Schemata:
    """The tree with every place of the C++ files rewritten."""

    def __init__(self, files):
        self.files = files
        self.record = TREE / "places.json"

    def fingerprint(self, used):
        digest = hashlib.sha256()
        for path in sorted([*(ROOT / f for f in used), HERE / "cpp_mutants.py"]):
            digest.update(path.read_bytes())
        return digest.hexdigest()

    def make(self):
        """The mutants, by number, after the tree was written. What did not change is not done again."""
        listed = output(["git", "-C", ROOT, "ls-files", "-co", "--exclude-standard"]).splitlines()
        rewritten = {f for files in self.files.values() for f in files}
        for file in listed:
            source, target = ROOT / file, TREE / file
            if file in rewritten or not source.is_file():
                continue
            if not target.exists() or not os.path.samefile(source, target):
                target.parent.mkdir(parents=True, exist_ok=True)
                target.unlink(missing_ok=True)
                os.link(source, target)
        used = sorted(rewritten)
        if self.record.exists():
            old = json.loads(self.record.read_text())
            if old["fingerprint"] == self.fingerprint(used):
                return old["places"]
        for file in used:
            write(TREE / file, (ROOT / file).read_bytes())
        self.configure()
        places = self.rewrite()
        self.record.write_text(json.dumps({"fingerprint": self.fingerprint(used), "places": places}))
        return places

    def configure(self):
        output(["cmake", "--preset", "release", "-DCONTACT_UNITY=OFF", f"-DCMAKE_PROJECT_INCLUDE={HERE}/build.cmake"], cwd=TREE)

    def commands(self):
        """How each file is compiled, as a list of words without the output."""
        found = {}
        for entry in json.loads((BUILD / "compile_commands.json").read_text()):
            file = Path(entry["file"]).resolve()
            if file.is_relative_to(TREE) and file.suffix == ".cpp":
                words = shlex.split(entry["command"])
                while not re.search(r"(g\+\+|clang\+\+)[-\d]*$", words[0]):
                    words.pop(0)
                at = words.index("-o")
                found.setdefault(file.relative_to(TREE).as_posix(), words[:at] + words[at + 2:])
        return found

    def rewrite(self):
        from clang.cindex import Index, TranslationUnit
        from cpp_mutants import Rewriter
        index, commands = Index.create(), self.commands()
        files = [f for group in self.files.values() for f in group]
        rewriters = {f: Rewriter(TREE / f, (ROOT / f).read_text()) for f in files}
        units = [f for f in files if f.endswith(".cpp")]
        parsed_in = {}  # a header's places are those of the first file that includes it
        for file in units:
            arguments = [w for w in commands[file][1:] if w not in ("-c", file) and not w.endswith(".cpp")
                         and not w.startswith(("-fno-cx-", "-fexcess-precision"))]  # unknown to libclang
            for more in VECTOR_PARSES if "foreach_target" in rewriters[file].text else [[]]:
                say("parsing", file, *more)
                unit = index.parse(str(TREE / file), [*arguments, *more, "-w"], options=TranslationUnit.PARSE_DETAILED_PROCESSING_RECORD)
                errors = [d for d in unit.diagnostics if d.severity >= 3]
                if errors:
                    sys.exit(f"libclang: {errors[0]}")
                included = {str(Path(i.include.name).resolve()) for i in unit.get_includes()}
                for other, rewriter in rewriters.items():
                    if other == file or (str(rewriter.path.resolve()) in included and not other.endswith(".cpp")
                                         and parsed_in.setdefault(other, file) == file):
                        rewriter.visit_unit(unit)
        number = 0
        for rewriter in rewriters.values():
            number += -number % 128  # room, so that a place more in one file does not change all others
            for place in sorted(rewriter.places.values(), key=lambda p: (p.start, -p.end)):
                place.number = number
                number += 1
        dropped = self.validate(rewriters, commands)
        component = {f: c for c, group in self.files.items() for f in group}
        mutants = []
        for file, rewriter in rewriters.items():
            lines = rewriter.text.splitlines()
            for place in sorted(rewriter.places.values(), key=lambda p: p.number):
                at = rewriter.text.count("\n", 0, place.replaced[0][0] if place.replaced else place.start)
                mutants += [{"component": component[file], "file": file, "at": at + 1, "line": lines[at].strip(), "change": change,
                             "id": KINDS * place.number + i, **({"dropped": True} if place.number in dropped else {})}
                            for i, change in enumerate(place.changes)]
        return keyed(mutants)

    def validate(self, rewriters, commands):
        """Leaves out the places that the compiler refuses, such as where a constant is needed."""
        # Those refused before are refused again: compiling takes longest.
        memory = TREE / "refused.json"
        before = set(json.loads(memory.read_text())) if memory.exists() else set()
        key = {p.number: f"{f}|{p.start}|{r.text[p.start:p.end]}|{p.function}" for f, r in rewriters.items() for p in r.places.values()}
        dropped, checked = {number for number, text in key.items() if text in before}, set()
        units = [f for f in rewriters if f.endswith(".cpp")]
        for _ in range(12):
            for file, rewriter in rewriters.items():
                self.write(file, rewriter, dropped)
            refused = set()
            for unit in [u for u in units if u not in checked]:
                words = [w for w in commands[unit] if w != "-c"]
                done = subprocess.run([*words, "-fsyntax-only", "-w"], capture_output=True, text=True, cwd=BUILD)
                found = {self.place_at(Path(path), int(line), int(column))
                         for path, line, column in re.findall(r"^(\S+?):(\d+):(\d+):\s+(?:fatal error|error|required from|\s*in .constexpr)",
                                                              done.stderr, re.M)} - {None}
                say("compiling", unit, f"{len(found - dropped)} places refused" if done.returncode else "")
                if done.returncode == 0:
                    checked.add(unit)
                elif not found - dropped:
                    sys.exit(f"{unit} cannot be compiled:\n{done.stderr[:3000]}")
                refused |= found
            dropped |= refused
            for number in refused:
                say("refused:", key[number])
            memory.write_text(json.dumps(sorted({key[number] for number in dropped})))
            if not refused:
                return dropped
        sys.exit("places are still refused after twelve attempts")

    def write(self, file, rewriter, dropped):
        text = rewriter.rewritten(dropped)
        path = TREE / file
        for line, include in HOOKS:
            if line in text:
                at = text[:text.index(line)].count("\n") + 2
                text = text.replace(line, f'{line}\n#include "{HERE}/{include}"\n#line {at} "{path}"', 1)
        system = "" if file.endswith(".cpp") else "#pragma GCC system_header\n"
        write(path, f'{system}#include "{HERE}/mutant.hpp"\n#line 1 "{path}"\n{text}')

    def place_at(self, path, line, column):
        """The place nearest to where the compiler complains."""
        if not path.resolve().is_relative_to(TREE):
            return None
        text = path.read_text()
        text = text[text.index(f'#line 1 "{path.resolve()}"') if f'#line 1 "{path.resolve()}"' in text else 0:].split("\n", 1)[1]
        text = re.sub(r'\n#include "[^"\n]*/mutant_\w+\.hpp"\n#line[^\n]*', "", text)
        lines = text.splitlines()
        if line > len(lines):
            return None
        found = [(abs(m.start() - column + 1), int(m[1])) for m in re.finditer(r"mutan?t?e?d?::[\w:<>]+\((\d+)[,)]", lines[line - 1])]
        return min(found)[1] if found else None

    def build(self):
        say("building", *TARGETS)
        done = subprocess.run(["ninja", "-C", BUILD, f"-j{os.environ.get('JOBS', os.cpu_count())}", *TARGETS], stdout=sys.stderr)
        if done.returncode:
            sys.exit("the rewritten tree cannot be built")


# What they are put to.


def tests_of_cpp():
    """Commands by name: every GoogleTest test on its own, and some of the program's."""
    tool = BUILD / "contact-oracle"
    found = {}
    for program, suites in (("src/kernel/kernel_test", "*"), ("src/kernel/batch_test", "*"), ("oracle/oracle_test", "*"), ("golden/golden_test", "*"),
                            ("engines/engines_test", "Mutants.*")):
        suite = ""
        for line in output([BUILD / program, "--gtest_list_tests", f"--gtest_filter={suites}"]).splitlines():
            if not line.startswith(" "):
                suite = line.split()[0]
            else:
                test = suite + line.split()[0]
                found[f"{Path(program).name} {test}"] = [BUILD / program, f"--gtest_filter={test}", "--gtest_brief=1"]
    golden = TREE / "golden"
    for pair in ("sphere_sphere", "rigid_sphere_rigid_sphere", "sphere_rigid_sphere", "cube_cube"):
        for kind in ("", ".invalid"):
            if (path := golden / "quick" / f"{pair}{kind}.jsonl").exists():
                found[f"lint quick/{path.name}"] = [tool, "lint", path]
        found[f"certify quick/{pair}"] = [tool, "certify", golden / "quick" / f"{pair}.jsonl", "--fresh", "0", "--engine", "production", "--check", "all",
                                          "--family", "quick", "--level", "correctly-rounded"]
        found[f"lint {pair}"] = [tool, "lint", golden / pair]
        found[f"certify {pair}"] = [tool, "certify", golden / pair, "--fresh", "0", "--engine", "production", "--check", "all", "--level", "correctly-rounded"]
    found["lint golden"] = [tool, "lint", golden]  # with its manifest
    found["digests"] = [tool, "digests", golden]
    found["digests --production"] = [tool, "digests", golden, "--production"]
    script = TREE / "tool" / "cli_test.py"
    found |= {f"cli_test {test}": [sys.executable, script, tool, "-f", test] for test in unittests(
        script, {"BadDatasets", "Generate", "Adequacy", "Annotate", "Explain", "Outputs"})}
    return found


def tests_of_python():
    script = TREE / "golden" / "verify_test.py"
    tool = BUILD / "contact-oracle"
    found = {f"verify.py {folder}": [sys.executable, TREE / "golden" / "verify.py", TREE / "golden" / folder] for folder in ("quick", "cube_cube")}
    # Broken changes verify.py's text itself, and would miss what it looks for.
    return found | {f"verify_test {test}": [sys.executable, script, tool, "-f", test] for test in unittests(script, {"Right", "Wrong"})}


def unittests(script, wanted=None):
    """The tests of a Python file, Class.test each, of the wanted classes."""
    found, current = [], None
    for line in script.read_text().splitlines():
        if m := re.match(r"class (\w+)", line):
            current = m[1]
        elif (m := re.match(r"    def (test_\w+)", line)) and (wanted is None or current in wanted):
            found.append(f"{current}.{m[1]}")
    return found


class Hung(Exception):
    pass


RUNNING, INTERRUPTED = set(), threading.Event()


def run(command, processor, clock, environment):
    """The exit status, and the processor's seconds; killed with all that it started when it takes more of those, or more by the clock, or
    when all is interrupted. The clock is for what sleeps: it also tells how busy the machine is."""
    if INTERRUPTED.is_set():
        raise KeyboardInterrupt
    limits = [f"--as={8 << 30}", "--core=0", f"--cpu={math.ceil(processor)}:{math.ceil(processor) + 5}"]
    process = subprocess.Popen(["prlimit", *limits, *map(str, command)], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL, cwd=TREE, env={**os.environ, **ENVIRONMENT, **environment}, start_new_session=True)
    RUNNING.add(process)
    late = threading.Event()

    def stop():
        late.set()
        os.killpg(process.pid, signal.SIGKILL)

    alarm = threading.Timer(clock, stop)
    alarm.start()
    try:
        # Its number stays its own until it is waited for below, so that nothing else is killed.
        os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT)
        alarm.cancel()
        alarm.join()
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if INTERRUPTED.is_set():
            raise KeyboardInterrupt
        if late.is_set() or process.returncode == -signal.SIGXCPU:
            raise Hung
        return process.returncode, usage.ru_utime + usage.ru_stime
    finally:
        alarm.cancel()
        RUNNING.discard(process)
        if process.returncode is None:  # interrupted while it was waited for
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()


def side_by_side(work, items):
    """What work gives for each, as it is done; an interruption ends what runs, whose outcome is nobody's."""
    with ThreadPoolExecutor(int(os.environ.get("JOBS", os.cpu_count()))) as pool:
        try:
            yield from pool.map(work, items)
        except KeyboardInterrupt:
            INTERRUPTED.set()
            for process in list(RUNNING):
                with contextlib.suppress(ProcessLookupError):
                    os.killpg(process.pid, signal.SIGKILL)
            pool.shutdown(cancel_futures=True)
            raise


def stamp(command):
    """What a test's outcome depends on: the program's bytes, and the script's."""
    digest = hashlib.sha256(repr(ENVIRONMENT).encode() * ("batch_test" in str(command[0])))
    for word in map(str, command):
        digest.update(word.encode())
        if Path(word).is_file() and not word.endswith(".jsonl"):
            digest.update(str((Path(word).stat().st_mtime_ns, Path(word).stat().st_size)).encode())
    return digest.hexdigest()[:16]


def recorded(tests, folder, most, kills_cpp=True):
    """Seconds of each test, of a processor and by the clock, and which mutants change a value during it; kept until its program changes.
    A test that fails is left out."""
    folder.mkdir(parents=True, exist_ok=True)

    def one(entry):
        i, (test, command) = entry
        file = folder / f"{hashlib.sha256(test.encode()).hexdigest()[:16]}.json"
        old = json.loads(file.read_text()) if file.exists() else {}
        if old.get("stamp") == stamp(command) and "clock" in old and not ("slow" in str(old["status"]) and most > old["most"]):
            return old
        say(f"{i + 1}/{len(tests)}", test)
        start, seconds, reached = time.monotonic(), most, {}
        try:
            status, seconds = run(command, most, 10 * most, {})
        except Hung:
            status = "slow"
        clock = time.monotonic() - start
        if status == 0 and kills_cpp:
            with tempfile.TemporaryDirectory() as place:
                try:
                    status, _ = run(command, 20 * most, 200 * most, {"CONTACT_MUTANTS_REACHED": f"{place}/reached"})
                except Hung:
                    status = "slow while recording"
                for path in Path(place).iterdir():
                    for id, what in enumerate(path.read_bytes()):
                        if what:
                            now = reached.get(id, 0)
                            reached[id] = what if now in (0, 3) or what == 2 else now
        new = {"stamp": stamp(command), "test": test, "status": status, "seconds": seconds, "clock": clock, "most": most,
               "reached": "".join(f"{id}:{what} " for id, what in sorted(reached.items()))}
        file.write_text(json.dumps(new))
        return new

    found = {}
    for (test, command), entry in zip(tests.items(), side_by_side(one, enumerate(tests.items()))):
        if entry["status"] == 0:
            reached = dict(map(int, pair.split(":")) for pair in entry["reached"].split())
            found[test] = {"command": command, "seconds": entry["seconds"], "clock": entry["clock"], "reached": reached, "stamp": entry["stamp"]}
        else:
            say(f"left out: {test} ({entry['status']})")
    return found


class Runner:
    """Mutants against tests, with what came of it in a file that grows."""

    def __init__(self, path):
        self.path, self.results = path, {}
        if path.exists():
            for line in path.read_text().splitlines():
                entry = json.loads(line)
                self.results[entry["name"]] = entry
        self.kills = collections.Counter()
        self.runs = collections.Counter()
        self.by_file = collections.defaultdict(collections.Counter)

    def settle(self, mutant, tests):
        """The outcome of one mutant, from the file where nothing that it rests on has changed."""
        mine = {t: e for t, e in tests.items() if "id" not in mutant or e["reached"].get(mutant["id"]) == 2}
        source = source_of(mutant["file"])
        old = self.results.get(name(mutant))
        survived = {}
        if old and old["source"] == source:
            if old["outcome"] == "killed":
                return old
            survived = old.get("survived", {})
        todo = sorted((t for t in mine if survived.get(t) != mine[t]["stamp"]), key=lambda t: self.cost(t, mine[t], mutant["file"]))
        if old and old["source"] == source and not todo:
            return self.store(mutant, source, old["outcome"] if mine else self.unreached(mutant, tests), {t: mine[t]["stamp"] for t in mine}, quiet=True)
        for test in todo:
            entry = mine[test]
            self.runs[test] += 1
            outcome = "survived"
            try:
                status, _ = run(entry["command"], max(5, 20 * entry["seconds"]), max(60, 20 * entry["clock"]),
                                {"CONTACT_MUTANT": str(mutant["id"])} if "id" in mutant else {})
                if status != 0:
                    outcome = "killed"
            except Hung:
                outcome = "killed"
            if outcome == "killed":
                self.kills[test] += 1
                self.by_file[mutant["file"]][test] += 1
                return self.store(mutant, source, "killed", {}, test)
            survived[test] = entry["stamp"]
        return self.store(mutant, source, "survived" if mine else self.unreached(mutant, tests), {t: mine[t]["stamp"] for t in mine})

    def cost(self, test, entry, file):
        """Seconds over the chance that it kills, as far as it has shown."""
        chance = (self.by_file[file][test] + 0.5) / (self.runs[test] + 2)
        return (entry["clock"] + 0.01) / chance

    @staticmethod
    def unreached(mutant, tests):
        what = {e["reached"].get(mutant["id"], 0) for e in tests.values()}
        return "unchanged" if 1 in what else "no mutant" if 3 in what else "unreached"

    def store(self, mutant, source, outcome, survived, test=None, quiet=False):
        entry = {"name": name(mutant), "source": source, "outcome": outcome, "survived": survived, "test": test}
        if not quiet or self.results.get(entry["name"], {}).get("outcome") != outcome:
            with self.path.open("a") as out:
                out.write(json.dumps(entry) + "\n")
        self.results[entry["name"]] = entry
        return entry


def settle(runner, mutant, tests):
    if "text" not in mutant:
        return runner.settle(mutant, tests["cpp"])
    file = TREE / mutant["file"]
    write(file, mutant["text"])
    try:
        return runner.settle(mutant, tests["python"])
    finally:
        write(file, (ROOT / mutant["file"]).read_bytes())


# What came of it.


def explanations():
    """Why a mutant is no mistake, by its name."""
    found = {}
    for number, line in enumerate(EXPLAINED.read_text().splitlines() if EXPLAINED.exists() else [], 1):
        entry = json.loads(line)
        for change in entry["change"] if isinstance(entry["change"], list) else [entry["change"]]:
            for nth in entry.get("nth", [1]):
                found["|".join((entry["file"], entry["line"], change, str(nth)))] = (number, entry["why"])
    return found


def write_page(mutants):
    """The table of every outcome that is recorded of the sources as they are; where there is none here, what the page has."""
    results, why = Runner(TREE / "results.jsonl").results, explanations()
    rows, text = [HEADING], PAGE.read_text()
    for component, files in COMPONENTS.items():
        all_ = [m for m in mutants if m["component"] == component and not m.get("dropped")]
        sources = {f: source_of(f) for f in files}
        known = [m for m in all_ if name(m) in results and results[name(m)]["source"] == sources[m["file"]]
                 and results[name(m)]["outcome"] != "no mutant"]
        killed = sum(results[name(m)]["outcome"] == "killed" for m in known)
        explained = sum(results[name(m)]["outcome"] != "killed" and name(m) in why for m in known)
        if not known:
            judged, killed, explained = map(int, re.search(rf"^{component} +\d+ +(\d+) +(\d+) +(\d+)", text, re.M).groups())
        rows.append(row(component, len(all_), len(known) or judged, killed, explained))
    PAGE.write_text(re.sub(r"(<!-- scores:begin -->\n```text\n).*?(```\n<!-- scores:end -->)", lambda m: m[1] + table(rows) + "\n" + m[2], text,
                           flags=re.S))
    print(table(rows))


HEADING = ("component", "mutants", "judged", "killed", "explained", "left", "of all", "of mistakes")


def row(component, mutants, judged, killed, explained):
    shares = (f"{100 * killed / max(of, 1):.1f} %" for of in (judged, judged - explained))
    return (component, *map(str, (mutants, judged, killed, explained, judged - killed - explained)), *shares)


def source_of(file):
    return hashlib.sha256((ROOT / file).read_bytes()).hexdigest()[:16]


def table(rows):
    widths = [max(map(len, column)) for column in zip(*rows)]
    return "\n".join("  ".join(cell.ljust(w) if i == 0 else cell.rjust(w) for i, (cell, w) in enumerate(zip(row, widths))).rstrip()
                     for row in rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("components", nargs="*", metavar="COMPONENT", help=f"of {', '.join(COMPONENTS)} (default: all)")
    parser.add_argument("--sample", type=int, metavar="N", help="N mutants of each component, drawn with the seed")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--most", type=float, default=30, metavar="SECONDS", help="tests that take longer, of a processor, are left out (default: 30)")
    parser.add_argument("--survivors", action="store_true", help="only those that survived before, against what is new")
    parser.add_argument("--only", metavar="REGEX", help="mutants whose name has it")
    parser.add_argument("--write", action="store_true", help="what is known so far into docs/mutation-testing.md, and no mutant is run")
    options = parser.parse_args()
    wanted = options.components or list(COMPONENTS)
    if unknown := [c for c in wanted if c not in COMPONENTS]:
        parser.error(f"no such component: {', '.join(unknown)}; there are {', '.join(COMPONENTS)}")

    TREE.mkdir(parents=True, exist_ok=True)
    schemata = Schemata({c: files for c, files in COMPONENTS.items() if files[0].endswith(".cpp")})
    mutants = schemata.make()
    if options.write:
        write_page(mutants + python_mutants("verify", "golden/verify.py"))
        return 0
    schemata.build()
    cpp = [c for c in wanted if c in schemata.files]
    tests = {"cpp": recorded(tests_of_cpp(), TREE / "reached", options.most) if cpp else {}}
    if "verify" in wanted:
        write(TREE / "golden/verify.py", (ROOT / "golden/verify.py").read_bytes())
        tests["python"] = recorded(tests_of_python(), TREE / "reached", options.most, False)
        mutants = mutants + python_mutants("verify", "golden/verify.py")

    runner = Runner(TREE / "results.jsonl")
    why = explanations()
    rows = [HEADING]
    left, names, interrupted = [], {name(m) for m in mutants}, False
    for component in wanted:
        all_ = sorted((m for m in mutants if m["component"] == component and not m.get("dropped")), key=name)
        if component in schemata.files:
            # What no types know is no mutant.
            all_ = [m for m in all_ if not any(e["reached"].get(m["id"]) == 3 for e in tests["cpp"].values())
                    or any(e["reached"].get(m["id"]) in (1, 2) for e in tests["cpp"].values())]
        if options.only:
            all_ = [m for m in all_ if re.search(options.only, name(m))]
        if options.survivors:
            all_ = [m for m in all_ if runner.results.get(name(m), {}).get("outcome", "killed") != "killed"]
        # A larger sample holds every smaller one.
        if options.sample is not None:
            random.Random(options.seed).shuffle(all_)
        chosen = all_[:options.sample]
        count = collections.Counter()
        # verify.py's are written in its place, one at a time.
        outcomes = (side_by_side if component in schemata.files else map)(lambda m: settle(runner, m, tests), [] if interrupted else chosen)
        for i, mutant in enumerate(chosen):
            try:
                outcome = next(outcomes, None)
            except KeyboardInterrupt:
                outcome, interrupted = None, True
            if outcome is None:
                break
            count["judged"] += 1
            killed = outcome["outcome"] == "killed"
            count["killed"] += killed
            if name(mutant) in why:
                if killed:
                    say(f"explained and killed: {EXPLAINED.name}:{why[name(mutant)][0]}: {name(mutant)}")
                else:
                    count["explained"] += 1
            elif not killed:
                left.append((mutant, outcome["outcome"]))
            if sys.stderr.isatty() or i % 100 == 99:
                end = "\r" if sys.stderr.isatty() else "\n"
                print(f"{component}: {i + 1} of {len(chosen)}, {count['killed']} killed", end=end, file=sys.stderr, flush=True)
        rows.append(row(component, len(all_), count["judged"], count["killed"], count["explained"]))
    for mutant, outcome in sorted(left, key=lambda one: (one[0]["file"], one[0]["at"])):
        print(f"{mutant['file']}:{mutant['at']}: {mutant['change']} ({mutant['nth']}) {outcome}: {mutant['line']}")
    stale = [key for key in why if key not in names and key.split("|")[0] in {f for c in wanted for f in COMPONENTS[c]}]
    for key in stale:
        print(f"stale: {EXPLAINED.name}:{why[key][0]}: there is no such mutant any more: {key}")
    print(table(rows))
    return 130 if interrupted else 1 if left or stale else 0


if __name__ == "__main__":
    sys.path.insert(0, str(HERE))
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(130)
