#!/usr/bin/env python3
"""The classes of cases of a unittest file, one a line:   python_cases.py FILE

The file is read and not run."""
import ast
import sys
from pathlib import Path

CLASSES = {node.name: node for node in ast.parse(Path(sys.argv[1]).read_text(encoding="utf-8")).body if isinstance(node, ast.ClassDef)}


def has_cases(name):
    """Of its own, or of a base in the file."""
    node = CLASSES.get(name)
    return node is not None and (any(isinstance(one, ast.FunctionDef) and one.name.startswith("test") for one in node.body) or
                                 any(isinstance(base, ast.Name) and has_cases(base.id) for base in node.bases))


print("\n".join(filter(has_cases, CLASSES)))
