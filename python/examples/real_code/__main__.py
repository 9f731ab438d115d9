"""The functions of MJX, Newton and trimesh, run as they are in somebody's checkout, each certified in both precisions.

    python3 real_code --mjx MUJOCO --newton NEWTON --trimesh TRIMESH [--function NAME] [--count N] [--seed S] [--report FOLDER]

A checkout is a clone, or a folder in which the package is installed. Neither JAX nor Warp need be there: jax_by_numpy.py and warp_by_numpy.py stand
in for as much of them as these functions ask. binary64 is judged by the profile robotics (a hundredth of a millimetre), binary32 by the profile game (a millimetre): a
function that passes does what it should within them, on sizes of its profile. Exit status 1 where one is refuted.
"""
import argparse
import sys
from pathlib import Path

import contact_oracle
import numpy as np

import of_mjx
import of_newton
import of_trimesh
from checkouts import NotThere

ENGINES = {"mjx": of_mjx, "newton": of_newton, "trimesh": of_trimesh}
PROFILES = {"binary64": "robotics", "binary32": "game"}
# As the profiles leave out: what nobody meets who works in metres.
LEFT_OUT = {"extreme_scale", "hard_to_round"}
# What takes arrays is asked more: the others are called once a question, in Python.
AT_A_TIME = {"trimesh": 50}


def judged(name, function, engine, scalar, count, seed):
    """The report on one function in one scalar."""
    pair, answers, conventions = engine
    families = [each["name"] for each in contact_oracle.families(pair) if not each["outside_domain"] and each["name"] not in LEFT_OUT]
    points = {} if "points" in conventions else {"points": "midpoint"}
    rounds = ["orientation"] if "obb" in pair else None
    with np.errstate(all="ignore"):  # questions beyond the profile's sizes are asked too, and are not judged
        return contact_oracle.certify(answers, pair, families, count=count, seed=seed, scalar=scalar, profile=PROFILES[scalar],
                                      conventions={**points, "value_less_contact": False, **conventions}, rounds=rounds, name=f"{name}:{function}",
                                      allow_unsupported=True)


def told(report):
    """What to say of a report: the verdict, what the wrong answers have in common, and a question to begin with."""
    lines = [report.verdict]
    if not report.certified:
        lines += [f"  {line}" for line in report.diagnosis[:3]]
        first = report.failures[0]
        lines += [f"  {first['what']}: ", f"    {first['line']}"]
    return "\n".join(lines)


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ENGINES:
        parser.add_argument(f"--{name}", metavar="PATH", help=f"a checkout of {name}" + (" (that of MuJoCo)" if name == "mjx" else ""))
    parser.add_argument("--function", action="append", help="ask this function alone; may be given again")
    parser.add_argument("--count", type=int, default=20, help="questions of each family (20; of trimesh, which takes arrays, 50 times as many)")
    parser.add_argument("--seed", type=int, default=1, help="of the questions (1)")
    parser.add_argument("--report", type=Path, metavar="FOLDER", help="write the HTML report on each there")
    options = parser.parse_args(arguments)
    asked = {name: path for name in ENGINES if (path := getattr(options, name))}
    if not asked:
        parser.error("name a checkout: --mjx, --newton or --trimesh")
    try:
        served = {name: ENGINES[name].engines(path) for name, path in asked.items()}
    except (NotThere, ImportError, AttributeError) as missing:
        print(f"real_code: {missing}", file=sys.stderr)  # the last two: a checkout that asks more of the stand-ins than is there
        return 2
    chosen = [(name, function, engine) for name, engines in served.items() for function, engine in engines.items()
              if not options.function or function in options.function]
    if not chosen:
        parser.error(f"no function to judge; there are {', '.join(function for engines in served.values() for function in engines) or 'none'}")
    held = True
    for name, function, engine in chosen:
        for scalar in PROFILES:
            report = judged(name, function, engine, scalar, options.count * AT_A_TIME.get(name, 1), options.seed)
            held &= report.certified
            print(f"{name} {function}, {engine[0]}, {scalar}: {told(report)}", flush=True)
            if options.report:
                options.report.mkdir(parents=True, exist_ok=True)
                report.to_html(options.report / f"{name}-{function}-{scalar}.html")
    return 0 if held else 1


if __name__ == "__main__":
    sys.exit(main())
