"""Many questions of one pair: arrays under the names of the pair's arguments."""
from __future__ import annotations

import html
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from .asked import Asked, asked
from .contacts import Contacts
from .errors import InputError
from .pairs import Array, Field, number_of, pair_named, scalar_named
from .shown import table
from .shapes import SHAPES, Question, _from_json

if TYPE_CHECKING:
    from .exact_answers import Exact


def stacked(vertices: list[Array]) -> Array:
    """The vertices of some hulls as one array: those of fewer are filled up with NaN."""
    most = max(map(len, vertices))
    return np.stack([np.pad(some, ((0, most - len(some)), (0, 0)), constant_values=np.nan) for some in vertices])


def _there(vertices: Array) -> Array:
    """Of one hull those that are not NaN alone at the end."""
    there = np.flatnonzero(~np.isnan(vertices).all(axis=1))
    return vertices[:there[-1] + 1 if len(there) else 0]


class Questions:
    """N questions of one pair.

    The arrays are attributes, and entries: ``questions.center1`` is ``questions["center1"]``, an (N, 3) of the questions'
    scalar. ``**questions`` gives them all to the pair's function. ``questions[3]`` is one `Question`, a slice or an array of
    rows gives `Questions`.

    pair    the pair's name
    scalar  binary64 or binary32
    family  the family that made them, or None

    InputError where arrays are missing, do not go together, or are no numbers of the scalar.

    >>> import contact_oracle
    >>> questions = contact_oracle.Questions("sphere_sphere", dict(center1=[(0, 0, 0), (9, 0, 0)], radius1=1, center2=(2, 0, 0), radius2=1))
    >>> questions, questions.center2.shape, questions[1].a
    (<2 questions of sphere_sphere, binary64>, (2, 3), Sphere(center=(9.0, 0.0, 0.0), radius=1.0))
    """

    pair: str
    scalar: str
    family: str | None

    def __init__(self, pair: str, arrays: Mapping[str, Any], scalar: str | None = None, family: str | None = None) -> None:
        description = pair_named(pair)
        values = {"alarm": 0.0, "contact": 0.0, **arrays}
        for name in description.arguments:
            if name not in values:
                raise InputError("is missing", name)
        for name in values:
            if name not in description.arguments:
                raise InputError(f"is no argument of {pair}; it has {', '.join(description.arguments)}", name)
        question = asked(description, values)
        self.pair, self.family = pair, family
        self.scalar = question.scalar if scalar is None else scalar_named(scalar)
        if self.scalar == "binary32" and question.scalar != "binary32":
            raise InputError("must be arrays of binary32, as the scalar is", "arrays", value="binary64")
        number = number_of(self.scalar)
        # PyTorch warns of what cannot be written, and one number for all questions is such an array.
        self._arrays: dict[str, Array] = {name: np.require(column, number, "W") for name, column in zip(description.arguments, question.all_columns)}

    def __getattr__(self, name: str) -> Array:
        try:
            arrays: dict[str, Array] = self.__dict__["_arrays"]
            return arrays[name]
        except KeyError:
            raise AttributeError(f"questions of {self.__dict__.get('pair', 'no pair')} have no {name!r}") from None

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._arrays]

    def __getitem__(self, key: Any) -> Any:
        if isinstance(key, str):
            return self._arrays[key]
        if isinstance(key, (int, np.integer)):
            return self._question(range(len(self))[key])
        return Questions(self.pair, {name: array[key] for name, array in self._arrays.items()}, self.scalar, self.family)

    def _question(self, row: int) -> Question:
        def value(field: Field) -> Any:
            found = self._arrays[field.argument][row]
            return _from_json(_there(found) if field.any_number else found)

        pair = pair_named(self.pair)
        a, b = (SHAPES[shape](**{field.name: value(field) for field in pair.fields if field.side == side}) for side, shape in zip("ab", pair.shapes))
        return Question(self.pair, a, b, float(self.alarm[row]), float(self.contact[row]), self.scalar)

    def __len__(self) -> int:
        return len(self._arrays["alarm"])

    def __iter__(self) -> Iterator[Question]:
        return (self._question(row) for row in range(len(self)))

    def __repr__(self) -> str:
        of = f", family {self.family}" if self.family else ""
        return f"<{len(self)} questions of {self.pair}, {self.scalar}{of}>"

    def keys(self) -> Iterable[str]:
        """The names of the arrays."""
        return self._arrays.keys()

    def asked(self) -> Asked:
        """As the core reads them."""
        return asked(pair_named(self.pair), self._arrays)

    @property
    def id(self) -> Array:
        """The ids of the questions, texts of 24 hexadecimal digits."""
        question = self.asked()
        with question.naming_errors():
            ids = _core.ids(self.pair, question.columns, question.alarm, question.contact)
        return np.asarray(ids).astype("U24")

    def lines(self) -> list[str]:
        """One line for ``explain`` each."""
        return [str(question) for question in self]

    def answer(self, points: str = "nearest_surface") -> Contacts:
        """The right answers, correctly rounded to the scalar."""
        from .answering import contacts_of

        return contacts_of(self.asked(), points)

    def exact(self) -> list[Exact]:
        """The exact numbers behind the answers."""
        from .exact_answers import exact_of

        return exact_of(self.asked())

    def _repr_html_(self) -> str:
        return f"<p>{html.escape(repr(self))}</p>" + table(self._arrays)

    def to_dataframe(self) -> Any:
        """A pandas.DataFrame, one row a question, with a column for each number: ``center1[0]``, ..."""
        import pandas

        columns = {}
        for name, array in self._arrays.items():
            flat = array.reshape((len(self), -1))
            for column, index in enumerate(np.ndindex(*array.shape[1:])):
                columns[name + "".join(f"[{i}]" for i in index)] = flat[:, column]
        return pandas.DataFrame(columns)


def joined(questions: Questions | Question | Iterable[Question]) -> Questions:
    """Questions of one pair and scalar, given in any of these ways."""
    if isinstance(questions, Questions):
        return questions
    if isinstance(questions, Question):
        return questions.as_questions()
    single = list(questions)
    if not all(isinstance(question, Question) for question in single):
        raise InputError("must be questions", "questions", value=repr(questions))
    kinds = {(question.pair, question.scalar) for question in single}
    if len(kinds) != 1:
        raise InputError("must be of one pair and one scalar", "questions", value=sorted(kinds))
    rows = [question.arguments() for question in single]
    of_any_number = [field.argument for field in pair_named(single[0].pair).fields if field.any_number]
    columns = {name: [row[name] for row in rows] for name in rows[0]}
    arrays = {name: stacked(column) if name in of_any_number else np.stack(column) for name, column in columns.items()}
    return Questions(single[0].pair, arrays, single[0].scalar)
