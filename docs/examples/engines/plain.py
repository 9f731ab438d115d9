#!/usr/bin/env python3
"""An engine in Python for contact-oracle: spheres and boxes in plain double arithmetic, over the engine protocol."""
import json
import math
import sys

HELLO = {"op": "hello", "protocol": 1, "engine": {"name": "plain-python", "version": "1"}, "scalar": "binary64",
         "pairs": ["sphere_sphere", "cube_cube"],
         # Squares of these neither overflow nor underflow: outside of it this engine claims nothing.
         "conventions": {"normal": "first-to-second", "points": "nearest_surface", "value": "signed",
                         "scale": {"min": 1e-100, "max": 1e100}},
         "bounds": {"value": 4, "normal": 4, "point": 4}}


def spheres(a, b, alarm, contact):
    delta = [q - p for p, q in zip(a["center"], b["center"])]
    distance2 = delta[0] * delta[0] + delta[1] * delta[1] + delta[2] * delta[2]  # sum() is exacter from Python 3.12 on
    reach = a["radius"] + b["radius"] + alarm
    if distance2 > reach * reach:
        return {"overlap": False, "contact": None}
    distance = math.sqrt(distance2)
    normal = [d / distance for d in delta] if distance > 0 else [1, 0, 0]
    return {"overlap": True,
            "contact": {"normal": normal,
                        "point1": [c + a["radius"] * n for c, n in zip(a["center"], normal)],
                        "point2": [c - b["radius"] * n for c, n in zip(b["center"], normal)],
                        "value": distance - (a["radius"] + b["radius"]) - contact}}


def boxes(a, b, alarm):
    apart = any(a["min"][i] > b["max"][i] + alarm or b["min"][i] > a["max"][i] + alarm for i in range(3))
    return {"overlap": not apart}  # boxes get no contact, so nothing is claimed about one


def answer(query):
    a, b = query["a"], query["b"]
    if query["pair"] == "cube_cube":
        return boxes(a, b, query["alarm"])
    return spheres(a, b, query["alarm"], query["contact"])


for line in sys.stdin:
    message = json.loads(line, parse_int=float)  # Python's integers do not round as doubles do
    if message["op"] == "stop":
        break
    if message["op"] == "hello":
        reply = HELLO
    else:
        reply = {"op": "answer", "seq": int(message["seq"])}
        try:
            reply.update(answer(message))
        except (TypeError, OverflowError) as problem:  # a number given as text: NaN or an infinity
            reply["error"] = str(problem)
    print(json.dumps(reply), flush=True)
