#!/usr/bin/env python3
"""Writes the inputs that fuzzing begins with, from committed golden files: python3 dev/fuzz/make_corpus.py

What a campaign found to fail is added by hand under a name that says what it was, and is not written by this."""
import json
import struct
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
CORPUS = Path(__file__).resolve().parent / "corpus"
QUICK = ROOT / "golden/quick"


# The kinds of pairs in the order of CONTACT_KINDS, include/contact/pairs.hpp; others in the list are of two spheres.
KINDS = ("sphere_sphere", "cube_cube", "sphere_cube")


def put(target, name, content):
    path = CORPUS / target / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content if isinstance(content, bytes) else content.encode())


def numbers(shape):
    return [*shape["center"], shape["radius"]] if "center" in shape else [*shape["min"], *shape["max"]]


def npy(kind, shape, rows):
    """An array as NumPy stores it."""
    head = f"{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}".encode().ljust(117) + b"\n"
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(head)) + head + rows


def main():
    questions = []
    for path in sorted(QUICK.rglob("*.jsonl")):
        header, *lines = path.read_text().splitlines()
        if "invalid" not in path.stem:
            questions += [(json.loads(header), json.loads(line)) for line in lines]
    for i, (header, case) in enumerate(questions):
        of_kinds = all(("center" in shape) or ("min" in shape) for shape in (case["a"], case["b"]))
        if header["scalar"] == "binary64" and of_kinds:
            kind = KINDS.index(header["pair"]) << 56 if header["pair"] in KINDS else 0
            values = [*numbers(case["a"]), *numbers(case["b"]), case["alarm"], case["contact"]]
            put("bits", case["id"], struct.pack(f"<Q{len(values)}d", kind, *values))
        question = {key: case[key] for key in ("a", "b", "alarm", "contact")} | {"pair": header["pair"]}
        if i % 3 == 0:
            put("explain", case["id"], json.dumps(question | {"scalar": header["scalar"]}))
            put("protocol", f"query-{case['id']}", json.dumps({"op": "query", "seq": i + 1, **question}))
    for name in ("sphere_sphere/touching", "sphere_sphere/invalid", "sphere_sphere/upstream", "cube_cube/generic.f32"):
        header, *lines = (ROOT / "golden" / f"{name}.jsonl").read_text().splitlines()
        put("dataset", name.replace("/", "-"), "\n".join([json.dumps(json.loads(header) | {"count": 2}, separators=(",", ":")),
                                                             *lines[:2], ""]))
    for i, path in enumerate(sorted((ROOT / "golden/recorded").rglob("*.jsonl"))[:2]):
        put("results", f"recorded-{i}", "\n".join([*path.read_text().splitlines()[:3], ""]))
    hello = {"op": "hello", "protocol": 1, "engine": {"name": "an engine", "version": "1"}, "scalar": "binary64",
             "pairs": ["sphere_sphere"], "conventions": {"points": "midpoint", "touching_contact": "open"}, "bounds": {"normal": 16}}
    contact = {"normal": [1, 0, 0], "point1": [0.5, 0, 0], "point2": ["NaN", 0, 0], "value": "-Infinity"}
    put("protocol", "hello", json.dumps(hello))
    put("protocol", "answers", "\n".join(map(json.dumps, (
        {"op": "answer", "seq": 1, "overlap": True, "contact": contact}, {"op": "answer", "seq": 2, "contact": None},
        {"op": "answer", "seq": 3, "error": "no"}, {"op": "answer", "seq": 4, "unsupported": True}, {"op": "stop"}))))
    result = {key: hello[key] for key in ("engine", "scalar", "pairs", "conventions", "bounds")}
    put("results", "made", "\n".join(map(json.dumps, (
        {"format": "contact-oracle/results", "version": 1, **result}, {"id": "0" * 24, "overlap": True, "contact": contact}))))
    entry = json.loads((ROOT / "golden/manifest.json").read_text())
    put("manifest", "of-one-file", json.dumps(entry | {"files": entry["files"][:1]}))
    put("manifest", "of-none", f'{{"format":"contact-oracle/manifest","version":1,"generator":"{entry["generator"]}","files":[\n]}}\n')
    adequacy = json.loads((ROOT / "golden/adequacy.json").read_text())
    put("manifest", "adequacy", json.dumps({k: (v[:2] if isinstance(v, list) else v) for k, v in adequacy.items()})[:4000])
    for path in sorted((ROOT / "docs/examples/scenes").iterdir()):
        put("scene", path.name.replace(".", "-"), path.read_text())
    node = '<Node name="n"><MechanicalObject position="0 0 {}"/><SphereCollisionModel group="{}"/></Node>'
    put("scene", "groups", "<Node>" + "".join(node.format(i, g) for i, g in enumerate((1, "1 2", -2147483648, 3000000000, 1e300, 0.5))) + "</Node>")
    put("scene", "links", '<Node><SphereLoader name="l" filename="/dev/zero"/><MechanicalObject position="@[-1].position"/>'
                          '<SphereCollisionModel listRadius="@l.listRadius"/><SubCollisionPipeline collisionModels="@[-1] @/l @../x"/></Node>')
    put("scene", "grid", '<Node><RegularGridTopology n="3 3 3"/><MechanicalObject/><SphereCollisionModel radius="0.25" selfCollision="1"/></Node>')
    put("scene", "mapped-and-nested", '<Node><MechanicalObject template="Rigid3"/>' + '<Node><MechanicalObject/><IdentityMapping/>' * 40
                                      + '<SphereCollisionModel/>' + '</Node>' * 41)
    for change in ([0, 0, 0], [0, 40, 7], [9, 3, 8], [4, 100, 200], [1, 1, 6, 30, 20, 9]):
        put("certificate", "-".join(map(str, change)), bytes(change))
    put("certificate", "text", '{"format":"contact-oracle/certificate","version":1,"sha256":"' + "0" * 64 + '"}\n')
    for change in ([0], [1, 0, 0], [0, 9, 3, 0, 7, 4, 255, 240, 0], [0, 5, 1, 2, 1, 1, 2], [2, 0, 2, 0, 4], [1, 12, 4, 0, 3, 2, 65, 66]):
        put("columns", "-".join(map(str, change)), bytes(change))
    # Which file and which array of it, then what that becomes; + stands for the beginning of a true one.
    for name, which, array in (("numbers", (0, 3), npy("<f8", "(3, 3)", struct.pack("<9d", *range(9)))),
                               ("hits", (1, 0), npy("|b1", "(3,)", b"\1\0\1")),
                               ("wide-texts", (1, 5), npy("<U24", "(2,)", ("0123456789abcdef01234567" * 2).encode("utf-32-le"))),
                               ("header", (2, 6), npy("|S2", "()", b"{}")),
                               ("rows-beyond-memory", (0, 4), npy("<f4", "(4611686018427387904, 3)", b"")),
                               ("rows-of-a-true-array", (0, 4), b"+" + bytes(72)),
                               ("no-array", (0, 1), b"PK"),
                               ("header-of-another-order", (0, 0), b"*{'shape': (3, 3), 'fortran_order': False, 'descr': '<f8'}"),
                               ("long-kind", (0, 0), b"*{'descr': '" + b"<" * 28000 + b"'}"),
                               ("long-shape", (0, 0), b"*{'descr': '<f8', 'fortran_order': False, 'shape': (" + b"1, " * 9000 + b"), }"),
                               ("version-two", (0, 2), b"\x93NUMPY\x02\x00\x20\x00\x00\x00{'descr': '<u4', 'shape': (1,)  }")):
        put("arrays", name, bytes(which) + array)


if __name__ == "__main__":
    main()
