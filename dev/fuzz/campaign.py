#!/usr/bin/env python3
"""Runs libFuzzer's targets side by side and tells what came of it: python3 dev/fuzz/campaign.py BUILD [--minutes N] [TARGET...]

Inputs that reach something new are kept in BUILD/corpus, and are where the next campaign begins; what fails is in BUILD/crashes. With
--keep nothing is fuzzed: of the inputs in BUILD/corpus, the few that together reach every edge become corpus/TARGET.found.tar.xz."""
import argparse
import os
import re
import shutil
import signal
import subprocess
import sys
import tarfile
import tempfile
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

CORPUS = Path(__file__).resolve().parent / "corpus"
TARGETS = sorted(path.name for path in CORPUS.iterdir() if path.is_dir())
# Of the whole program an input reaches thirty thousand features, and to weigh inputs by how rare theirs are takes half of the time.
MORE = {"certificate": ["-entropic=0"]}
INTERRUPTED = threading.Event()
# What a target writes goes to memory where it can: on a disk the manifests' take twenty times as long.
MEMORY = "/dev/shm" if os.path.isdir("/dev/shm") else None


def found(target):
    return CORPUS / f"{target}.found.tar.xz"


def unpack_found(target, folder):
    """An archive of no inputs, as of a new target, makes no folder by itself."""
    folder.mkdir()
    shutil.unpack_archive(found(target), folder)


def anonymous(member):
    """The same inputs make the same archive, whoever packs them and when."""
    member.uid = member.gid = member.mtime = 0
    member.uname = member.gname = ""
    member.mode = 0o644
    return member


def keep(build, target):
    """Named inputs say what they are for and stay; those found, that only reach, are chosen anew."""
    with tempfile.TemporaryDirectory(dir=MEMORY) as scratch:
        chosen, before = Path(scratch, "chosen"), Path(scratch, "found")
        shutil.copytree(CORPUS / target, chosen)
        unpack_found(target, before)
        named = set(chosen.iterdir())
        run = subprocess.run([build / "dev/fuzz" / f"fuzz_{target}", "-set_cover_merge=1", "-use_counters=0", "-timeout=60",
                              "-rss_limit_mb=4096", chosen, *filter(Path.is_dir, (before, build / "corpus" / target))],
                             stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, errors="replace",
                             env=os.environ | {"TMPDIR": scratch})
        if run.returncode != 0:
            sys.exit(f"{target}: what a campaign kept could not be gone through; nothing changed\n{run.stderr[-4000:]}")
        new = sorted(set(chosen.iterdir()) - named)
        with tarfile.open(found(target), "w:xz", format=tarfile.USTAR_FORMAT) as archive:
            for path in new:
                archive.add(path, path.name, filter=anonymous)
        size = sum(path.stat().st_size for path in new)
    print(f"{target}: {len(new)} inputs, {size} bytes, beside {len(named)} that have a name")


def fuzz(build, target, seconds):
    if INTERRUPTED.is_set():
        return (target, *["-"] * 4, "not run")
    corpus, crashes = build / "corpus" / target, build / "crashes"
    corpus.mkdir(parents=True, exist_ok=True)
    crashes.mkdir(exist_ok=True)
    log = build / f"fuzz_{target}.log"
    with log.open("wb") as out, tempfile.TemporaryDirectory(dir=MEMORY) as scratch:
        unpack_found(target, Path(scratch, "found"))
        # Where memory was got is not needed while nothing fails: walking the stack at every request takes a tenth of the time.
        process = subprocess.Popen(
            [build / "dev/fuzz" / f"fuzz_{target}", f"-max_total_time={seconds:.0f}", "-rss_limit_mb=4096", "-timeout=60",
             "-max_len=131072", "-print_final_stats=1", *MORE.get(target, []), f"-artifact_prefix={crashes}/{target}-",
             corpus, CORPUS / target, Path(scratch, "found")],
            stdout=subprocess.DEVNULL, stderr=out, env={"ASAN_OPTIONS": "malloc_context_size=2"} | os.environ | {"TMPDIR": scratch})
        _, status, usage = os.wait4(process.pid, 0)
    text = log.read_text(errors="replace")
    # 72: libFuzzer was interrupted, as on a terminal all of them are.
    outcome = {0: "no failure", 72: "no failure, interrupted"}.get(os.waitstatus_to_exitcode(status), f"FAILED, {log}")
    edges = re.findall(r"cov: (\d+)", text)
    counters = re.search(r"\((\d+) inline 8-bit counters\)", text)
    runs = re.search(r"number_of_executed_units: (\d+)", text)
    return (target, runs.group(1) if runs else "?", f"{edges[-1] if edges else '?'} of {counters.group(1) if counters else '?'}",
            str(len(list(corpus.iterdir()))), f"{usage.ru_utime + usage.ru_stime:.0f}", outcome)


def main():
    arguments = argparse.ArgumentParser(description="Fuzzing, side by side", allow_abbrev=False)
    arguments.add_argument("build", type=Path)
    arguments.add_argument("--minutes", type=float, default=1, help="of each target (default: 1)")
    arguments.add_argument("--jobs", type=int, default=os.cpu_count(), help="targets at once (default: one a core)")
    arguments.add_argument("--keep", action="store_true", help="choose from what was reached before, and do not fuzz")
    arguments.add_argument("targets", nargs="*", metavar="TARGET", help=f"of {', '.join(TARGETS)} (default: all)")
    wanted = arguments.parse_intermixed_args()  # targets may follow an option
    if unknown := [t for t in wanted.targets if t not in TARGETS]:
        arguments.error(f"no such target: {', '.join(unknown)}; there are {', '.join(TARGETS)}")
    build = wanted.build.resolve()
    if wanted.keep:
        for target in wanted.targets or TARGETS:
            keep(build, target)
        return 0
    signal.signal(signal.SIGINT, lambda *_: INTERRUPTED.set())
    with ThreadPoolExecutor(wanted.jobs) as pool:
        rows = list(pool.map(lambda t: fuzz(build, t, 60 * wanted.minutes), wanted.targets or TARGETS))
    rows.insert(0, ("target", "executions", "edges reached", "inputs kept", "CPU seconds", "outcome"))
    widths = [max(len(row[i]) for row in rows) for i in range(6)]
    for row in rows:
        print("  ".join(text.ljust(width) if i in (0, 5) else text.rjust(width) for i, (text, width) in enumerate(zip(row, widths))))
    # Where only this output is left of a run: libFuzzer ends with a short input in base 64.
    failed = [row[0] for row in rows[1:] if row[5].startswith("FAILED")]
    for target in failed:
        print(f"\n{target}:", *(build / f"fuzz_{target}.log").read_text(errors="replace").splitlines()[-60:], sep="\n", file=sys.stderr)
    return 1 if failed else 130 if INTERRUPTED.is_set() else 0


if __name__ == "__main__":
    sys.exit(main())
