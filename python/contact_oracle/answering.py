"""The functions of the pairs: made from the core's description, one a pair, each with its own signature and documentation."""
from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any

import numpy as np

from . import _core
from .asked import Asked, asked
from .contacts import Contacts
from .errors import InputError, errors_of_core
from .exact_answers import asked_of
from .pairs import PAIRS, Array, Pair, number_of
from .shapes import Question

POINTS = ("nearest_surface", "center", "published")


def contacts_of(question: Asked, points: str) -> Contacts:
    if points not in POINTS:
        raise InputError(f"must be one of {', '.join(POINTS)}", "points", value=repr(points))
    if question.scalar == "binary32" and points != POINTS[0]:
        raise InputError(f"must be {POINTS[0]} where the arrays are binary32", "points", value=repr(points))
    with question.naming_errors():
        answers = _core.contacts(question.pair.name, question.columns, question.alarm, question.contact, points, question.scalar)
    return Contacts(**{name: question.answered(array) for name, array in answers.items()})


def signature_of(pair: Pair) -> inspect.Signature:
    either = [inspect.Parameter(field.argument, inspect.Parameter.POSITIONAL_OR_KEYWORD, annotation="ArrayLike") for field in pair.fields]
    distances = [inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=0, annotation="ArrayLike") for name in ("alarm", "contact")]
    points = inspect.Parameter("points", inspect.Parameter.KEYWORD_ONLY, default=POINTS[0], annotation="str")
    return inspect.Signature([*either, *distances, points], return_annotation="Contacts")


def bound(pair: Pair, arguments: tuple[Any, ...], named: dict[str, Any]) -> dict[str, Any]:
    """The arguments by name, defaults filled in; a TypeError as Python's own where one is missing or unknown."""
    found = SIGNATURES[pair.name].bind(*arguments, **named)
    found.apply_defaults()
    return found.arguments


SIGNATURES = {name: signature_of(pair) for name, pair in PAIRS.items()}

_KINDS = {"point": "a point", "points": "three points", "any number": "points, where those of NaN at the end are not there", "length": "a length, 0 or more", "direction": "a direction of any length but 0",
          "orientation": "a quaternion x, y, z, w of any length but 0",
          "number": "how far along the normal, in lengths of the normal", "offset": "how far along the normal, in lengths of the normal"}
_DECISIONS = {"distance": "a contact where the distance of the cores is at most alarm + both radii, decided exactly; touching counts",
              "crossing": "a contact where the segment and the triangle have a point in common, decided exactly; ends and edges count",
              "cast": "a contact where a point of the ray lies in the shape, decided exactly; touching and ends count",
              "none": "a hit where the gap on each axis is at most alarm, decided exactly; touching counts"}
_DEGENERATE = {"distance": "where the cores meet the normal is an agreement, and `degenerate` says so",
               "crossing": "never; a segment along the triangle's plane does not cross it",
               "cast": "an origin in the shape: the value is 0, any normal is right, and `degenerate` says so",
               "none": "flat boxes and boxes that are points are boxes"}
_OVERLAPPING = "where cores touch and no deeper, the normal is an agreement, and `degenerate` says so; a depth is an ordinary hit"
_SECTIONS = {**{pair: "sphere-pairs" for pair in ("sphere_sphere", "rigid_sphere_rigid_sphere", "sphere_rigid_sphere")}, "sphere_cube": "sphere-cube-pairs", "cube_cube": "cube-pairs", "sphere_capsule": "capsule-pairs", "capsule_capsule": "capsule-pairs",
             "sphere_triangle": "triangles", "ray_sphere": "rays", "sphere_plane": "planes", "capsule_plane": "planes",
             "ray_triangle": "crossings", "triangle_line": "crossings",
             **{f"cast_{shape}": "ray-casts" for shape in ("sphere", "cube", "capsule", "triangle", "plane")}}


# As the first shape of an example each ends at x = 1, and as the second it begins at x = 3: one is 2 from the other.
_FIRST = {"sphere": "(0, 0, 0), 1", "cube": "(-1, -1, -1), (1, 1, 1)", "capsule": "(-2, 0, 0), (0.5, 0, 0), 0.5", "triangle": "[(0, -1, 0), (0, 1, 0), (1, 0, 0)]",
          "ray": "(-1, 0, 0), (1, 0, 0), 2", "obb": "(0, 0, 0), (0, 0, 0, 1), (1, 1, 1)", "hull": "[(-1, 0, 0), (0.5, 1, 0), (0.5, -1, 0), (0.5, 0, 1)], 0.5"}
_SECOND = {"sphere": "(4, 0, 0), 1", "cube": "(3, -1, -1), (5, 1, 1)", "capsule": "(3.5, 0, 0), (6, 0, 0), 0.5", "triangle": "[(3, 0, 0), (4, -1, 0), (4, 1, 0)]",
           "plane": "(-1, 0, 0), -3", "obb": "(4, 0, 0), (0, 0, 0, 1), (1, 1, 1)", "hull": "[(3.5, 0, 0), (5, 1, 0), (5, -1, 0), (5, 0, 1)], 0.5"}
_CROSSINGS = {"ray_triangle": f"(3.5, 0, 2), (0, 0, -1), 9, {_SECOND['triangle']}", "triangle_line": f"{_FIRST['triangle']}, (0.5, 0, -1), (0.5, 0, 1)"}


def example_of(pair: Pair) -> str:
    """An example with its answer, which is known without the core."""
    if pair.numbers == "crossing":
        return f">>> contact_oracle.{pair.name}({_CROSSINGS[pair.name]}).value\n0.0"
    second = _SECOND[pair.shapes[1]]
    if pair.numbers == "cast":
        return f">>> contact_oracle.{pair.name}((0, 0, 0), (1, 0, 0), 9, {second}).value\n3.0"
    answer = ".hit\nTrue" if pair.numbers == "none" else ".value\n2.0"
    return f">>> contact_oracle.{pair.name}({_FIRST[pair.shapes[0]]}, {second}, alarm=2){answer}"


def documentation_of(pair: Pair) -> str:
    first, second = (shape if shape != pair.shapes[0] or index == 0 else "another" for index, shape in enumerate(pair.shapes))
    arguments = "\n".join(f"    {field.argument:<12}{field.shape_text:<12}{', ' * field.any_number}"
                          f"{_KINDS['any number' if field.any_number else field.kind]}" for field in pair.fields)
    answers = ("``hit`` alone" if pair.numbers == "none" else
               "every number is the exact real rounded once to nearest, ties to even (0.5 ulp), to the scalar of the arrays")
    return (f"The contacts of a {first} with {second if second == 'another' else 'a ' + second}.\n\n"
            f"Arguments, batch first; they are broadcast:\n\n{arguments}\n"
            f"    {'alarm':<12}{'(...)':<12}a length, up to which shapes count as a hit\n"
            f"    {'contact':<12}{'(...)':<12}a length, which is subtracted from the value\n"
            f"    {'points':<12}{'':<12}which contact points: {', '.join(POINTS)}\n\n"
            f"Units       one length unit throughout\n"
            f"Domain      finite numbers; subnormal ones and the largest included; what is outside is an InputError\n"
            f"Scalar      binary32 where all arrays are float32, else binary64\n"
            f"Library     answers are arrays of the library that the arrays are of: NumPy, PyTorch, any of the array API with from_dlpack\n"
            f"Decision    {_DECISIONS[pair.numbers]}\n"
            f"Error       {answers}\n"
            f"Degenerate  {_DEGENERATE[pair.numbers] if pair.name in _SECTIONS else _OVERLAPPING}\n"
            f"Environment any rounding mode, flush-to-zero and denormals-are-zero: the answer to arrays is the same\n"
            f"Source      docs/specification.md#{_SECTIONS.get(pair.name, 'any-two-convex-shapes')}\n\n"
            f">>> import contact_oracle\n{example_of(pair)}\n")


def function_of(pair: Pair) -> Callable[..., Contacts]:
    def contacts(*arguments: Any, **named: Any) -> Contacts:
        values = bound(pair, arguments, named)
        return contacts_of(asked(pair, values), values["points"])

    contacts.__name__ = contacts.__qualname__ = pair.name
    contacts.__module__ = "contact_oracle"
    contacts.__doc__ = documentation_of(pair)
    contacts.__signature__ = SIGNATURES[pair.name]  # type: ignore[attr-defined]
    return contacts


FUNCTIONS = {name: function_of(pair) for name, pair in PAIRS.items()}


def hits(pair: str, *arguments: Any, **named: Any) -> Any:
    """The decisions alone, faster than contacts: an array of bool. Arguments as of the pair's function.

    >>> import contact_oracle
    >>> contact_oracle.hits("cube_cube", (0, 0, 0), (1, 1, 1), [(1, 0, 0), (2, 0, 0)], (3, 1, 1))
    array([ True, False])
    """
    question = asked_of(pair, arguments, named, of_points=False)
    with question.naming_errors():
        return question.answered(_core.hits(question.pair.name, question.columns, question.alarm, question.contact))


def explain(query: Any, /, *arguments: Any, **named: Any) -> str:
    """The answer in words, with the exact numbers behind it.

    query      a pair's name, with its arguments after it; or a line for ``explain``, a dict like one, a `Question` or `Questions`

    InputError where the question cannot be read or is outside the domain.

    >>> import contact_oracle
    >>> text = contact_oracle.explain("sphere_sphere", (0, 0, 0), 1, (1, 2, 2), 2)
    >>> next(line.strip() for line in text.splitlines() if "HIT" in line)
    'D = reach^2: exactly touching, which counts.  HIT'
    """
    if isinstance(query, Question):
        query = str(query)
    if isinstance(query, str) and query.lstrip().startswith("{") and not arguments and not named:
        # The core reads the line itself, so that what is wrong with it is said in the words of the command.
        with errors_of_core():
            return _core.explain(query)
    question = asked_of(query, arguments, named)
    from .questions import Questions

    lines = Questions(question.pair.name, dict(zip(question.pair.arguments, _in_scalar(question))), question.scalar).lines()
    with errors_of_core():
        return "\n".join(map(_core.explain, lines))


def _in_scalar(question: Asked) -> list[Array]:
    number = number_of(question.scalar)
    return [column.astype(number, copy=False) for column in question.all_columns]
