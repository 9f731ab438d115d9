#!/usr/bin/env python3
"""Are golden contact files right? All that they answer is derived again here, from the mathematics alone.

    python3 golden/verify.py FILE|FOLDER...     exit 0: all is right; 1: something is wrong, a line each; 2: not readable

This shares nothing with the program that wrote the files. Numbers are integers, fractions, and integer square roots with
their remainders; a float is only ever a name for 64 or 32 bits, and none is added, multiplied or rounded.
docs/formats.md says what the files mean. Why a case is there, its flags, is counted here and otherwise left to `lint`.
"""
import hashlib, json, struct, sys
from collections import Counter
from decimal import Decimal
from fractions import Fraction
from math import isfinite, isqrt
from pathlib import Path

# Significand bits; exponent of the smallest subnormal; bit pattern of infinity; struct's names of the float and of its bits.
SCALARS = {"binary64": (53, -1074, 0x7FF << 52, ">d", ">Q"), "binary32": (24, -149, 0xFF << 23, ">f", ">I")}
BALLS = [f"{s}.{x}" for s in "ab" for x in ("center[0]", "center[1]", "center[2]", "radius")] + ["alarm", "contact"]
BOXES = [f"{s}.{x}[{i}]" for s in "ab" for x in ("min", "max") for i in range(3)] + ["alarm", "contact"]
INPUTS = {"sphere_sphere": BALLS, "rigid_sphere_rigid_sphere": BALLS, "sphere_rigid_sphere": BALLS, "cube_cube": BOXES}
Written = type("Written", (str,), {})  # a number as it is spelt in the file


def spelt(value):
    """Canonical text. Of a number the shortest decimal that reads back as the same 64 bits, fixed where that is no longer."""
    if not isinstance(value, float):
        return str(value) if isinstance(value, Written) else json.dumps(value, ensure_ascii=False)
    if value == 0 or not isfinite(value):
        return "0" if value == 0 else '"NaN"' if value != value else '"Infinity"' if value > 0 else '"-Infinity"'
    decimal = Decimal(repr(value)).normalize()
    digits, exponent = f"{decimal:e}".split("e")
    scientific, fixed = f"{digits}e{int(exponent):+03d}", f"{decimal:f}"
    return scientific if abs(value) >= 2**53 or len(scientific) < len(fixed) else fixed


def leaves(value, path=""):
    """Every leaf under its path, such as expect.normal[0]."""
    if not value or not isinstance(value, (dict, list)):
        return {path: value}
    steps = [(f"{path}.{key}".lstrip("."), value[key]) for key in value] if isinstance(value, dict) else [
        (f"{path}[{i}]", entry) for i, entry in enumerate(value)]
    return {place: leaf for step, entry in steps for place, leaf in leaves(entry, step).items()}


def rounded(a, b, D, scalar):
    """The real a + b sqrt(D) to nearest, ties to even."""
    bits, least, infinity, as_float, as_bits = SCALARS[scalar]
    # In units of half the smallest subnormal the real is (p +- sqrt(q)) / r, with integers p, q and r.
    first, square = a * Fraction(2) ** (1 - least), b * b * D * Fraction(4) ** (1 - least)
    p, r = first.numerator * square.denominator, first.denominator * square.denominator
    q = square.numerator * square.denominator * first.denominator**2
    root = isqrt(q) if b > 0 else -isqrt(q - 1) - 1 if q else 0  # the largest integer up to +- sqrt(q)
    floor, rest = divmod(p + root, r)
    if floor < 0:
        return -rounded(-a, -b, D, scalar)
    drop = max(floor.bit_length() - bits, 1)  # the bits that do not fit: at least the one for halves
    kept, lost, half = floor >> drop, floor % (1 << drop), 1 << (drop - 1)
    exact = rest == 0 and root * root == q
    kept += lost > half or (lost == half and (not exact or kept % 2))
    # Bit patterns count a scalar's numbers, from 0 to infinity; 2^(bits - 1) of them share an exponent.
    return struct.unpack(as_float, struct.pack(as_bits, min(kept + ((drop - 1) << (bits - 1)), infinity)))[0]


def dyadic(x):
    """mantissa * 2^exponent, the mantissa odd."""
    twos = (x.numerator & -x.numerator).bit_length() - 1 if x else 0
    return f"{'-' * (x < 0)}{abs(x.numerator) >> twos:#x}p{twos - x.denominator.bit_length() + 1}"


def spheres(c1, r1, c2, r2, alarm, contact, scalar):
    delta = [q - p for p, q in zip(c1, c2)]
    D, reach = sum(d * d for d in delta), alarm + r1 + r2
    bits, least = SCALARS[scalar][:2]
    ulp = Fraction(2) ** max(least, reach.numerator.bit_length() - reach.denominator.bit_length() + 1 - bits if reach else least)
    exact = {"exact.distance2": dyadic(D), "exact.reach": dyadic(reach),
             "exact.margin_ulps": rounded(-reach / ulp, 1 / ulp, D, "binary64")}
    if D > reach * reach:
        return {"expect.hit": False, **exact}
    # Every number is a + b sqrt(D). The normal is delta / sqrt(D) = (delta / D) sqrt(D); where D = 0, by agreement, (1, 0, 0).
    normal = [(0, d / D) for d in delta] if D else [(1, 0), (0, 0), (0, 0)]
    parts = {"normal": normal, "point1": [(p + r1 * a, r1 * b) for p, (a, b) in zip(c1, normal)],
             "point2": [(p - r2 * a, -r2 * b) for p, (a, b) in zip(c2, normal)]}
    numbers = {f"expect.{x}[{i}]": rounded(a, b, D, scalar) for x, three in parts.items() for i, (a, b) in enumerate(three)}
    return {"expect.hit": True, "expect.degenerate": D == 0, **numbers,
            "expect.value": rounded(-(r1 + r2) - contact, 1, D, scalar), **exact}


def right_case(found, pair, scalar):
    """What should stand in a line: the leaves of its question, and of all that follows from the question."""
    inputs = {x: float(found[x]) or 0.0 for x in INPUTS[pair]}
    packed = b"".join(b"\x7f\xf8" + bytes(6) if x != x else struct.pack(">d", x) for x in inputs.values())
    case = {"id": hashlib.sha256(pair.encode() + b"\0" + packed).hexdigest()[:24], **inputs}
    outside = [x for x in inputs if not isfinite(inputs[x]) or (inputs[x] < 0 and "[" not in x)]
    outside += [x for x in inputs if ".min" in x and inputs[x] > inputs[x.replace("min", "max")]]
    if outside:  # The first is named: of a, of b, of the distances; of a box all numbers come before their order.
        return {**case, "flags[0]": "Invalid", "expect.rejected": min(outside, key=lambda x: (x[1] != ".", x[0]))}
    x = [Fraction(number) for number in inputs.values()]
    case |= {path: rounded(number, 0, 0, scalar) for path, number in zip(inputs, x)}  # a question is in the file's scalar too
    case |= {path: str(flag) for path, flag in found.items() if path.startswith("flags[")} or {"flags": []}
    if pair != "cube_cube":
        return case | spheres(x[0:3], x[3], x[4:7], x[7], x[8], x[9], scalar)
    gap = [max(x[i] - x[9 + i], x[6 + i] - x[3 + i]) for i in range(3)]  # max(min1 - max2, min2 - max1)
    return case | {"expect.hit": max(gap) <= x[12]} | {f"exact.gap[{i}]": dyadic(gap[i]) for i in range(3)}


def differences(where, right, found):
    """One line for each field in which what was found is not what is right."""
    pairs = [(x, *(spelt(side[x]) if x in side else "nothing" for side in (right, found))) for x in {**right, **found}]
    return [f"{where}: {x}: expected {expected}, got {got}" for x, expected, got in pairs if expected != got]


def check(path):
    """What is wrong in a dataset, and what a manifest should say of it. Of a results file nothing."""
    data, wrong, asked, flags, hits = path.read_bytes(), [], {}, Counter(), 0
    for at, text in enumerate(data.decode().split("\n")[:-1] if data.endswith(b"\n") else ["no line feed at the end"], 1):
        try:
            line = json.loads(text, parse_int=Written, parse_float=Written, parse_constant=lambda word: float("not " + word))
            found = leaves(line)
            if at == 1 and line["format"] == "contact-oracle/results":
                return [], {}
            if at == 1:
                header = {x: line[x] for x in ("pair", "scalar", "family", "seed", "count", "generator")}
                header |= {"seed": int(line["seed"]), "count": data.count(b"\n") - 1}
                right = {"format": "contact-oracle/dataset", "version": 1, **header, "points": "nearest_surface"}
                right |= {x: int(n) for x, n in found.items() if x.startswith("shard[")}
            else:
                right = right_case(found, header["pair"], header["scalar"])
        except (AttributeError, KeyError, TypeError, ValueError) as problem:
            raise ValueError(f"{path}:{at}: not readable: {problem!r}")
        flags.update(leaf for x, leaf in found.items() if x.startswith("flags["))
        hits += right.get("expect.hit", False)
        same = list(right) == list(found) or set(right) != set(found)  # keys too many or too few are named one by one
        same = same and json.dumps(line, separators=(",", ":"), ensure_ascii=False).replace('"', "") == text.replace('"', "")
        found |= {"form": "canonical" if same else "other spaces, order of keys, or a key twice"}
        found |= {"first asked on line": asked.setdefault(right.get("id"), at)}
        wrong += differences(f"{path}:{at}", {**right, "form": "canonical", "first asked on line": at}, found)
    return wrong, {**header, "hits": hits, "flags": dict(flags), "sha256": hashlib.sha256(data).hexdigest()}


def main(arguments):
    cases, wrong = 0, []
    for top in map(Path, arguments):
        entries, manifest = {}, top / "manifest.json"
        for path in sorted(top.rglob("*.jsonl")) if top.is_dir() else [top]:
            complaints, entry = check(path)
            cases += entry.get("count", 0)
            entries |= {path.relative_to(top).as_posix(): entry} if entry else {}
            wrong += complaints[:20] + [f"{path}: and {len(complaints) - 20} more"] * (len(complaints) > 20)
        listed = {entry.pop("path"): entry for entry in json.loads(manifest.read_text())["files"]} if manifest.exists() else entries
        for name in {**entries, **listed}:
            right, found = ({"origin": "", **side.get(name, {}), "origin": ""} for side in (entries, listed))
            wrong += differences(f"{manifest}: {name}", leaves(right), leaves(found))
    print(*wrong, f"{cases} cases: " + (f"{len(wrong)} complaints" if wrong else "all right"), sep="\n")
    return 1 if wrong or not cases else 0


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except (OSError, ValueError, KeyError) as problem:
        sys.exit(print(problem, file=sys.stderr) or 2)
