#!/usr/bin/env python3
"""The cases of a unittest file, one a line, as its command line takes them:   python_cases.py FILE

Class.test_name; or Class alone where its cases share what setUpClass made. The file is read and not run."""
import ast
import sys
from pathlib import Path

CLASSES = {node.name: node for node in ast.parse(Path(sys.argv[1]).read_text(encoding="utf-8")).body if isinstance(node, ast.ClassDef)}


def methods(name):
    """Those of a class and of its bases in the file."""
    node = CLASSES.get(name)
    if node is None:
        return set()
    own = {one.name for one in node.body if isinstance(one, ast.FunctionDef)}
    return own.union(*(methods(base.id) for base in node.bases if isinstance(base, ast.Name)))


for name in CLASSES:
    cases = sorted(one for one in methods(name) if one.startswith("test"))
    for case in cases[:1] if "setUpClass" in methods(name) else cases:
        print(name if "setUpClass" in methods(name) else f"{name}.{case}")
