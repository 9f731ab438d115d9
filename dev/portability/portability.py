#!/usr/bin/env python3
"""The same bits everywhere: builds production's answers for every platform and holds their digests against the manifest's.

Each platform's program writes the bytes of its answers, docs/formats.md#digests; they are hashed here, so that nothing of
the program under test has a say in the comparison. docs/portability.md
"""
import argparse
import hashlib
import json
import os
import platform as machine
import re
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MANY, MOST = 10_000, 1_000_000


@dataclass(frozen=True)
class Platform:
    compiler: str
    options: str
    emulator: str = ""  # qemu's name of the architecture, where the program is not for this machine
    processor: str = ""  # CMake's name of it
    hostile: str = ""  # more options, which the build must undo

    @property
    def folder(self):
        return f"hostile_{Path(self.compiler).name}" if self.hostile else "".join(c if c.isalnum() else "_" for c in f"{self.compiler} {self.options}")


NATIVE = ["-O0", "-O2", "-O3 -march=native"]
QUICK = ["-O0", "-O3 -march=native"]
# Everything that lets a compiler change values. A parent project and the command line both ask for it.
HOSTILE = {
    "gcc": "-Ofast -ffast-math -funsafe-math-optimizations -fassociative-math -freciprocal-math -ffinite-math-only -fno-signed-zeros "
           "-fno-trapping-math -fno-math-errno -fsingle-precision-constant -fcx-limited-range -ffp-contract=fast",
    "clang": "-Ofast -ffp-model=fast -ffast-math -funsafe-math-optimizations -fassociative-math -freciprocal-math -ffinite-math-only "
             "-fno-signed-zeros -fno-honor-nans -fno-honor-infinities -fapprox-func -fno-math-errno -fdenormal-fp-math=positive-zero "
             "-ffp-contract=fast"}
# One line a platform: that is all that another one needs.
FOREIGN = [
    Platform("i686-linux-gnu-g++", "-O2 -msse2 -mfpmath=sse", "i386", "i686"),
    Platform("aarch64-linux-gnu-g++", "-O2", "aarch64", "aarch64"),
    Platform("arm-linux-gnueabihf-g++", "-O2", "arm", "arm"),
    Platform("riscv64-linux-gnu-g++", "-O2", "riscv64", "riscv64"),
    Platform("powerpc64le-linux-gnu-g++", "-O2", "ppc64le", "ppc64le"),
    Platform("s390x-linux-gnu-g++", "-O2", "s390x", "s390x"),
]


class Failure(Exception):
    """Something that a platform cannot do; its text says what."""


def output(command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise Failure(f"{' '.join(map(str, command))}: exit status {done.returncode}\n"
                      f"{done.stdout[-4000:]}{done.stderr[-4000:]}")
    return done.stdout


def emulator(name):
    for program in (f"qemu-{name}-static", f"qemu-{name}"):
        if shutil.which(program):
            return program
    raise Failure(f"no qemu-{name}-static and no qemu-{name}")


def built(platform, folder, jobs):
    """The command that runs the platform's program."""
    build = folder / platform.folder
    settings = {"CONTACT_ANSWERS": "ON", "CMAKE_BUILD_TYPE": "", "CMAKE_CXX_COMPILER": platform.compiler,
                "CMAKE_CXX_FLAGS": f"{platform.options} {platform.hostile}".strip()}
    if platform.hostile:
        settings["CMAKE_PROJECT_INCLUDE"] = Path(__file__).resolve().parent / "hostile_parent.cmake"
    if platform.emulator:
        settings |= {"CMAKE_SYSTEM_NAME": "Linux", "CMAKE_SYSTEM_PROCESSOR": platform.processor}
        # Highway, which the batch kernels need, is packaged as a shared library alone; nothing else needs any of that processor's.
        if not Path(f"/usr/lib/{platform.compiler.removesuffix('-g++')}/libhwy.so").exists():
            settings |= {"CMAKE_EXE_LINKER_FLAGS": "-static", "CMAKE_DISABLE_FIND_PACKAGE_hwy": "ON"}
    output(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", *(f"-D{key}={value}" for key, value in settings.items())])
    output(["cmake", "--build", build, "--parallel", str(jobs), "--target", "answers"])
    program = str(build / "dev" / "portability" / "answers")
    return [emulator(platform.emulator), program] if platform.emulator else [program]


def stream_key(entry):
    """docs/formats.md#the-generator"""
    text = f"contact-oracle/1|{entry['pair']}|{entry['family']}|{entry['scalar']}|{entry['seed']}"
    return hashlib.sha256(text.encode()).hexdigest()[:32]


def digest(command, entry, count, way):
    arguments = [*command, entry["path"], stream_key(entry), str(count), way]
    sha256 = hashlib.sha256()
    with subprocess.Popen(arguments, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as answers:
        while block := answers.stdout.read(1 << 20):
            sha256.update(block)
        complaint = answers.stderr.read().decode(errors="replace").strip()
    return sha256.hexdigest() if answers.returncode == 0 else f"exit status {answers.returncode} ({complaint})"


def compare(platform, command, way, manifest, counts, jobs):
    """How many digests are right, and a line for each that is not. Of streams whose answers take long the manifest has digests of few:
    of each the longest is asked for that is no longer than a count, without counts the shortest."""
    asked = []
    right, wrong = 0, []
    for stream in output([*command, "--streams"]).split():
        lengths = sorted(map(int, manifest.get(stream, {}).get("digests", {})))
        chosen = {max(fit) for count in counts if (fit := [n for n in lengths if n <= count])} if counts else set(lengths[:1])
        asked += [(stream, count) for count in sorted(chosen)]
        if not chosen:
            wrong.append(f"{stream}: the manifest has no digest of its answers that is as short")
    if not asked:
        raise Failure("the program answers no stream of the manifest")
    with ThreadPoolExecutor(jobs) as pool:
        found = pool.map(lambda one: digest(command, manifest[one[0]], one[1], way), asked)
        for (stream, count), value in zip(asked, found):
            recorded = manifest[stream]["digests"][str(count)]
            if value == recorded:
                right += 1
            else:
                wrong.append(f"{stream}: the manifest says {recorded} for {count} answers, {platform.compiler} "
                             f"{platform.options}, {way}, gives {value}")
    return right, wrong


def version(compiler):
    """A compiler's name and version, as its first line has it."""
    words = output([compiler, "--version"]).splitlines()[0].split()
    return next(f"{'clang' if 'clang' in words else 'gcc'} {word}" for word in reversed(words) if word[0].isdigit())


def print_table(rows):
    widths = [max(map(len, column)) for column in zip(*rows)]
    for row in rows:
        print("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip())


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("count", nargs="?", type=int, choices=(MANY, MOST), default=MANY,
                        help="questions a stream on this machine; 1000000 where the manifest has that digest")
    parser.add_argument("--compilers", default="g++,clang++", help="for this machine")
    parser.add_argument("--quick", action="store_true", help="this machine alone, at -O0 and at -O3 -march=native")
    parser.add_argument("--few", action="store_true", help="as many questions of a stream as its committed file has")
    parser.add_argument("--hostile", action="store_true", help="this machine alone, with every option that lets a compiler change values")
    parser.add_argument("--only", default="", metavar="REGEX", help="the platforms with it in their compiler and options")
    parser.add_argument("--build", type=Path, default=ROOT / "build" / "portability", help="where to build")
    parser.add_argument("--manifest", type=Path, default=ROOT / "golden" / "manifest.json")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    options = parser.parse_args()

    manifest = {entry["path"]: entry for entry in json.loads(options.manifest.read_text())["files"]}
    platforms = [Platform(compiler, flags) for compiler in options.compilers.split(",")
                 for flags in (QUICK if options.quick else NATIVE)]
    if options.hostile:
        platforms = [Platform(compiler, "-march=native", hostile=HOSTILE[version(compiler).split()[0]])
                     for compiler in options.compilers.split(",")]
    elif not options.quick:
        platforms += FOREIGN
    platforms = [one for one in platforms if re.search(options.only, f"{one.compiler} {one.options}")]

    if not platforms:
        parser.error(f"no platform has {options.only} in its compiler and options")

    rows, complaints = [], []
    for one in platforms:
        counts = [] if options.few else [MANY] if one.emulator else sorted({MANY, options.count})
        row = ["?", one.options + (" and hostile" if one.hostile else ""), one.compiler, "-", "-", "-", "cannot be told"]
        print(f"{one.compiler} {one.options}", end=" ... ", file=sys.stderr, flush=True)
        try:
            row[0] = version(one.compiler)
            row[2] = (output([one.compiler, "-dumpmachine"]).split("-")[0] + (", qemu" if one.emulator else ""))
            command = built(one, options.build.resolve(), options.jobs)
            ways = output([*command, "--ways"]).split()
            for way in ways[:2] if options.quick or options.hostile else ways:  # one pair, and the best instruction set
                right, wrong = compare(one, command, way, manifest, counts, options.jobs)
                complaints += wrong
                rows.append([*row[:3], way, str(counts[-1]) if counts else "few", str(right), f"{len(wrong)} WRONG" if wrong else "."])
                print(f"{way}: {right} right, {len(wrong)} wrong", file=sys.stderr, flush=True)
        except (Failure, OSError) as failure:
            complaints.append(f"{one.compiler} {one.options}: {failure}")
            rows.append(row)
            print(row[-1], file=sys.stderr, flush=True)
    print("".join(complaint + "\n" for complaint in complaints), end="")
    print_table([["compiler", "options", "architecture", "way", "questions", "right", "wrong"], *rows])
    if complaints:
        print(f"\nNOT the same bits everywhere: {len(complaints)} differences or platforms that cannot be told")
        return 1
    print(f"\nthe same bits everywhere, on {machine.platform()}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
