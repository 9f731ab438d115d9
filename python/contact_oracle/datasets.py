"""Questions from the generator and from files."""
from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from . import _core
from .contacts import Contacts
from .errors import InputError, errors_of_core
from .pairs import Array, number_of, pair_named, scalar_named
from .questions import Questions, joined
from .shapes import Question


def families(pair: str) -> list[dict[str, Any]]:
    """The families of a pair: dicts with ``name``, ``reason`` and ``outside_domain``, which is true of questions that must be refused.

    InputError where there is no such pair.

    >>> import contact_oracle
    >>> [family["name"] for family in contact_oracle.families("cube_cube")][:2]
    ['generic', 'separated']
    """
    return list(_core.families(pair_named(pair).name))


def profiles() -> list[dict[str, Any]]:
    """The tolerances that have names.

    Dicts with ``name``, ``reason``, ``length`` in the user's unit, ``relative``, ``angle`` in radians, and ``scale``, the least and the largest number.

    >>> import contact_oracle
    >>> [profile["name"] for profile in contact_oracle.profiles()]
    ['game', 'robotics', 'metrology']
    """
    return list(_core.profiles())


def family_named(pair: str, family: str) -> str:
    known = [entry["name"] for entry in families(pair)]
    if family not in known:
        raise InputError(f"must be one of {', '.join(known)}", "family", value=repr(family))
    return family


def _in_scalar(columns: Iterable[Any], scalar: str) -> list[Array]:
    return [np.asarray(column, number_of(scalar)) for column in columns]


def generate(pair: str, family: str, count: int, seed: int = 0, scalar: str = "binary64", *, first: int = 0) -> Questions:
    """Questions of a family: a pure function of its arguments, the same on every machine and as the command's.

    first      the index of the first question; question i is the same whatever else is generated

    InputError where a name is unknown, or a number is none from 0 to 2^64 - 1.

    >>> import contact_oracle
    >>> contact_oracle.generate("sphere_sphere", "touching", 100, seed=1)
    <100 questions of sphere_sphere, binary64, family touching>
    """
    family_named(pair, family)
    for name, number in (("count", count), ("seed", seed), ("first", first)):
        if not isinstance(number, (int, np.integer)) or not 0 <= number < 2**64:
            raise InputError("must be a whole number from 0 to 2^64 - 1", name, value=repr(number))
    if int(first) + int(count) > 2**64:
        raise InputError("is too large: no question has an index from 2^64 on", "first", value=repr(first))
    with errors_of_core():
        columns, alarm, contact = _core.generate(pair, family, count, seed, scalar_named(scalar), first)
    return Questions(pair, dict(zip(pair_named(pair).arguments, _in_scalar([*columns, alarm, contact], scalar))), scalar, family)


class Dataset(Questions):
    """The questions of a file, with their right answers.

    header   the file's header, a dict
    expect   the right answers, `Contacts`
    flags    for each question the names of what is true of it
    columns  every other column of the file by its name there, such as ``exact/distance2``

    >>> import contact_oracle, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     contact_oracle.write_dataset(f"{folder}/mine.npz", contact_oracle.generate("sphere_sphere", "touching", 3))
    ...     dataset = contact_oracle.read_dataset(f"{folder}/mine.npz")
    >>> len(dataset), dataset.header["family"], bool(dataset.expect.hit.all())
    (3, 'own', True)
    """

    header: dict[str, Any]
    expect: Contacts | None
    flags: list[tuple[str, ...]]
    columns: dict[str, Array]

    def __init__(self, header: Mapping[str, Any], columns: Mapping[str, Any]) -> None:
        pair, scalar = pair_named(header["pair"]), header["scalar"]
        arrays = dict(zip(pair.arguments, _in_scalar((columns[name] for name in pair.columns), scalar)))
        super().__init__(pair.name, arrays, scalar, header.get("family"))
        self.header = dict(header)
        self.flags = [tuple(names) for names in columns.get("flags", ())]
        self.columns = {name: np.asarray(column) for name, column in columns.items() if name != "flags"}
        self.expect = self._expect()

    def _expect(self) -> Contacts | None:
        if "expect/hit" not in self.columns:
            return None
        number = number_of(self.scalar)
        found = {name: self.columns[f"expect/{name}"] for name in Contacts.__dataclass_fields__ if f"expect/{name}" in self.columns}
        return Contacts(**{name: array.astype(bool if name in ("hit", "degenerate", "unique") else number) for name, array in found.items()})


def read_dataset(path: str | os.PathLike[str]) -> Dataset:
    """A dataset in any form: JSON lines, .h5 or .npz.

    InputError where the file is not there or is no dataset.

    >>> import contact_oracle
    >>> contact_oracle.read_dataset("nowhere.jsonl")
    Traceback (most recent call last):
      ...
    contact_oracle.errors.InputError: nowhere.jsonl: cannot read: no such file
    """
    with errors_of_core():
        header, columns = _core.read_dataset(os.fsencode(path))
    return Dataset(json.loads(header), columns)


def write_dataset(path: str | os.PathLike[str], questions: Questions | Question | Iterable[Question], family: str = "own") -> None:
    """Questions of one's own, with their right answers, as a golden dataset; the end of the name says in which form.

    family     any name but those of the generator, whose questions `generate` makes

    InputError where a question is outside the domain or stands there twice, or the name ends otherwise; then nothing is written.

    >>> import contact_oracle
    >>> contact_oracle.write_dataset("mine.txt", contact_oracle.generate("sphere_sphere", "touching", 3))
    Traceback (most recent call last):
      ...
    contact_oracle.errors.InputError: the name of a dataset ends in .jsonl, .h5 or .npz, got 'mine.txt'
    """
    batch = joined(questions)
    question = batch.asked()
    with question.naming_errors():
        _core.write_dataset(os.fsencode(path), batch.pair, batch.scalar, family, question.columns,
                            question.alarm, question.contact)
