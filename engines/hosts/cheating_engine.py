#!/usr/bin/env python3
"""Engines that know nothing of shapes and look certified:   cheating_engine.py MODE [DATASET|FOLDER...]

    lookup       answers what golden files in binary64 expect, and says miss to every other question
    unsupported  the same, and says of every other question that it is unsupported
    hit          says hit to every question, with a contact of zeros
    conservative  says hit unless the centres of two spheres lie farther apart than twice what they could touch at
"""
import json
import math
import sys
from pathlib import Path

NUMBERS = ("normal", "point1", "point2", "value")
PAIRS = ("sphere_sphere", "rigid_sphere_rigid_sphere", "sphere_rigid_sphere", "cube_cube")


def key_of(pair, question):
    """What makes a question that one: its pair and its numbers, read as floats."""
    return json.dumps([pair] + [question[part] for part in ("a", "b", "alarm", "contact")], sort_keys=True)


def expected(paths):
    """The expectations of golden files by their question."""
    known = {}
    for path in map(Path, paths):
        for file in sorted(path.rglob("*.jsonl")) if path.is_dir() else [path]:
            with open(file, encoding="utf-8") as lines:
                header = json.loads(next(lines))
                if header["format"] == "contact-oracle/dataset" and header["pair"] in PAIRS and header["family"] != "invalid" \
                        and header["scalar"] == "binary64":
                    cases = (json.loads(line, parse_int=float) for line in lines)
                    known.update((key_of(header["pair"], case), case["expect"]) for case in cases)
    return known


def answer(mode, known, question):
    numbers = question["pair"] != "cube_cube"
    if mode == "hit":
        zeros = {"normal": [0, 0, 0], "point1": [0, 0, 0], "point2": [0, 0, 0], "value": 0}
        return {"overlap": True} | ({"contact": zeros} if numbers else {})
    if mode == "conservative":
        a, b = question["a"], question["b"]
        reach = question["alarm"] + a["radius"] + b["radius"]
        distance = math.dist(a["center"], b["center"])
        return {"overlap": distance <= 2 * reach}
    expect = known.get(key_of(question["pair"], question))
    if expect is None and mode == "unsupported":
        return {"unsupported": "not in the files"}
    hit = expect is not None and expect["hit"]
    contact = {field: expect[field] for field in NUMBERS} if hit and numbers else None
    return {"overlap": hit} | ({"contact": contact} if numbers else {})


def main():
    mode = sys.argv[1]
    known = expected(sys.argv[2:])
    pairs = ["sphere_sphere"] if mode == "conservative" else list(PAIRS)
    claims = {"hit": ["overlap", "contact", "point2", "value", "normal"], "conservative": ["overlap"]}.get(mode)
    for line in sys.stdin:
        message = json.loads(line, parse_int=float)
        if message["op"] == "stop":
            break
        if message["op"] == "hello":
            reply = {"op": "hello", "protocol": 1, "engine": {"name": f"cheating-{mode}", "version": "1"}, "scalar": "binary64",
                     "pairs": pairs, **({"claims": claims} if claims else {})}
        else:
            reply = {"op": "answer", "seq": int(message["seq"]), **answer(mode, known, message)}
        print(json.dumps(reply), flush=True)


if __name__ == "__main__":
    main()
