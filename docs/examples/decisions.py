#!/usr/bin/env python3
"""How many decisions of plain arithmetic are wrong on a golden dataset of spheres:   decisions.py FILE.npz"""
import sys

import numpy as np

golden = np.load(sys.argv[1])
x, y, z = (golden["b/center"] - golden["a/center"]).T
reach = golden["alarm"] + golden["a/radius"] + golden["b/radius"]
hit = x * x + y * y + z * z <= reach * reach
print(np.count_nonzero(hit != (golden["expect/hit"] == 1)), "of", len(hit), "decisions are wrong")
