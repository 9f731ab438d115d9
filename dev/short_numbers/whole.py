#!/usr/bin/env python3
"""Every question of the grids, on numbers of few bits.   python3 whole.py TINY_KERNELS [--write]

Runs tiny_kernels on all of its grids, and asks that no answer is wrong, that every mask of the vector kernels' source comes out
true and false, and that proofs/README.md has the figures, which --write puts there.
"""

import concurrent.futures
import re
import subprocess
import sys
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "proofs/README.md"
SOURCES = ROOT / "src/kernel"
KERNELS = (
    "one pair", "filter, rounding up", "filter, rounding down", "filter, rounding to zero", "one vector",
    "batch, by division", "batch, by an estimate",
)
# Masks that one lane has always true or always false, and why.
ONE_SIDED = {
    "Eq(all(0), all(0))": "a mask of ones",
    "IfThenElse(coincident, hn::Sub(zero, less.rounded()), value)": "not computed where no lane coincides, and there is one lane",
}


def masks(counts):
    """The masks of the source that always come out the same, by their text there."""
    for (file, line, column), (yes, no) in sorted(counts.items()):
        if not yes or not no:
            text = (SOURCES / file).read_text().splitlines()[line - 1]
            name = re.search(r"\w+\($", text[:column])
            yield f"{name[0] if name else ''}{text[column:]}"


def table(totals, kinds):
    yield "| kernel | bits | questions | hit | miss | no decision | numbers settled | left | wrong |"
    yield "|---|---|---|---|---|---|---|---|---|"
    for kernel, bits, *figures in totals:
        if kernel.startswith("filter"):
            figures[4:6] = "", ""
        shown = " | ".join(f"{int(figure):,}" if figure else "" for figure in figures)
        yield f"| {kernel} | {bits} | {shown} |"
    yield ""
    yield "| questions where | settled whole by the pair, the vector, the batch | not |"
    yield "|---|---|---|"
    groups = [[kernel for kernel in KERNELS if kernel.startswith(word)] for word in ("one pair", "one vector", "batch")]
    for kind in sorted({kind for _, kind, _ in kinds}):
        cells = [[sum(kinds[kernel, kind, side] for kernel in group) for group in groups] for side in (0, 1)]
        yield f"| {kind} | " + " | ".join(", ".join(f"{count:,}" for count in side) for side in cells) + " |"


def main():
    program, *options = sys.argv[1:]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        runs = list(pool.map(lambda kernel: subprocess.run([program, "whole", kernel], capture_output=True, text=True), KERNELS))
    totals, kinds, places = [], Counter(), {}
    for run in runs:
        for line in run.stdout.splitlines():
            what, *columns = line.split("\t")
            if what == "total":
                totals.append(columns)
            elif what == "kind":
                kernel, _, kind, whole, rest = columns
                kinds[kernel, kind, 0] += int(whole)
                kinds[kernel, kind, 1] += int(rest)
            elif what == "place":
                place = columns[2], int(columns[3]), int(columns[4])
                yes, no = places.get(place, (0, 0))
                places[place] = yes + int(columns[5]), no + int(columns[6])
            elif what in ("wrong", "never"):
                print(line)
    failed = any(run.returncode for run in runs)
    if failed:
        print("an answer is wrong, or something never happened", *(run.stderr for run in runs))
    found = set(masks(places))
    for mask in found:
        if not any(mask.startswith(known) for known in ONE_SIDED):
            print(f"always the same: {mask}")
            failed = True
    for known in ONE_SIDED:
        if not any(mask.startswith(known) for mask in found):
            print(f"no longer always the same: {known}")
            failed = True
    block = "\n".join([*table(totals, kinds), "", f"{len(places)} masks of the vector kernels' source are made or used; "
                       f"{len(places) - len(found)} come out true and false. The others, with one lane:", "",
                       *(f"- `{mask}`: {why}" for mask, why in ONE_SIDED.items()), ""])
    marks = "<!-- tiny:begin -->\n", "<!-- tiny:end -->"
    page = PAGE.read_text()
    before, rest = page.split(marks[0])
    old, after = rest.split(marks[1])
    if "--write" in options:
        PAGE.write_text(before + marks[0] + block + marks[1] + after)
    elif old != block:
        print("proofs/README.md has other figures: whole.py --write")
        failed = True
    print(block)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
