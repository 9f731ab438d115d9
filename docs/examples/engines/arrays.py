"""An engine in NumPy that answers a file: python3 arrays.py QUESTIONS.npz ANSWERS.npz"""
import json
import sys

import numpy

with numpy.load(sys.argv[1]) as q:
    delta = q["b/center"] - q["a/center"]
    radii = q["a/radius"] + q["b/radius"]
    distance = numpy.sqrt((delta * delta).sum(axis=1))
    with numpy.errstate(invalid="ignore"):
        normal = delta / distance[:, None]
    answers = {
        "id": q["id"],
        "hit": distance <= q["alarm"] + radii,
        "normal": normal,
        "point1": q["a/center"] + q["a/radius"][:, None] * normal,
        "point2": q["b/center"] - q["b/radius"][:, None] * normal,
        "value": distance - radii - q["contact"],
    }
header = {"engine": {"name": "arrays", "version": "1"}, "pairs": ["sphere_sphere"]}
numpy.savez(sys.argv[2], header=json.dumps(header), **answers)
