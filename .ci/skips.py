#!/usr/bin/env python3
"""What a run of ctest skipped, and why:   skips.py [--allowed FILE] REPORT..

A REPORT is what ctest --output-junit wrote. A test of unittest is a class, file.Class, and what is skipped is a case, file.Class.case. Without --allowed each skipped test is printed with its reasons. With it nothing is
printed where every skip is allowed: FILE has lines "pattern: reason", a pattern being a regular expression that a test's whole name
must match. Exit status 1: a skip is not allowed, or a line allows none of the tests that there are."""
import argparse
import re
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
arguments.add_argument("--allowed", type=Path)
arguments.add_argument("reports", nargs="+", type=Path)
OPTIONS = arguments.parse_args()

# A case of unittest, in what -v prints: its name or setUpClass, its class, and the reason why it was skipped.
CASE = re.compile(r"^ *(\w+) \(__main__\.(\w+)(?:\.\w+)?\).*?\.\.\. ?(?:skipped (['\"].*['\"]))?", re.MULTILINE)
tests = set()
skipped = {}
for report in OPTIONS.reports:
    for test in ElementTree.parse(report).getroot().iter("testcase"):
        name, status, output = test.get("name"), test.get("status"), test.findtext("system-out", "")
        tests.add(name)
        found = 0
        for case, of, reason in CASE.findall(output):
            inner = ".".join([name.split(".")[0], of] + [case] * (case != "setUpClass"))
            tests.add(inner)
            if reason and status != "fail":
                found += 1
                skipped.setdefault(inner, set()).add(reason)
        # Whatever neither passed nor failed, and a test that is said to have passed where its own output speaks of a skip: it is itself
        # what was skipped, unless all the cases are known that unittest counted.
        counted = re.findall(r"^OK \(skipped=(\d+)", output, re.MULTILINE)
        says = re.search(r"\.\.\. skipped |\[  SKIPPED \]", output)
        if (status not in ("run", "fail") or status == "run" and (says or counted)) and counted != [str(found)]:
            skipped.setdefault(name, set()).update(re.findall(r"skipped (['\"].*['\"])", output))
said = [f"{name}: {', '.join(sorted(reasons)) or 'no reason is given'}" for name, reasons in skipped.items()]
if OPTIONS.allowed is None:
    print("\n".join(said))
    sys.exit()
allowed = dict(line.split(": ", 1) for line in OPTIONS.allowed.read_text().splitlines() if line and not line.startswith("#"))
wrong = [f"skipped, and {OPTIONS.allowed} does not allow it: {one}" for name, one in zip(skipped, said)
         if not any(re.fullmatch(pattern, name) for pattern in allowed)]
wrong += [f"{OPTIONS.allowed}: there is no test {pattern}" for pattern in allowed
          if not any(re.fullmatch(pattern, test) for test in tests)]
if not tests:
    wrong.append("no test was run")
print("\n".join(wrong), end="\n" if wrong else "", file=sys.stderr)
sys.exit(bool(wrong))
