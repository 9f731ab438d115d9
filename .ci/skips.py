#!/usr/bin/env python3
"""What a run of ctest skipped, and why:   skips.py [--allowed FILE] REPORT..

A REPORT is what ctest --output-junit wrote. Without --allowed each skipped test is printed with its reasons. With it nothing is
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

tests = [test for report in OPTIONS.reports for test in ElementTree.parse(report).getroot().iter("testcase")]
# Whatever neither passed nor failed, and a test that is said to have passed where its own output speaks of a skip.
skipped = {test.get("name"): sorted(set(re.findall(r"skipped (['\"].*['\"])", output)))
           for test in tests for output in [test.findtext("system-out", "")]
           if test.get("status") not in ("run", "fail") or test.get("status") == "run" and re.search(r"\.\.\. skipped |\[  SKIPPED \]", output)}
said = [f"{name}: {', '.join(reasons) or 'no reason is given'}" for name, reasons in skipped.items()]
if OPTIONS.allowed is None:
    print("\n".join(said))
    sys.exit()
allowed = dict(line.split(": ", 1) for line in OPTIONS.allowed.read_text().splitlines() if line and not line.startswith("#"))
wrong = [f"skipped, and {OPTIONS.allowed} does not allow it: {one}" for name, one in zip(skipped, said)
         if not any(re.fullmatch(pattern, name) for pattern in allowed)]
wrong += [f"{OPTIONS.allowed}: there is no test {pattern}" for pattern in allowed
          if not any(re.fullmatch(pattern, test.get("name")) for test in tests)]
if not tests:
    wrong.append("no test was run")
print("\n".join(wrong), end="\n" if wrong else "", file=sys.stderr)
sys.exit(bool(wrong))
