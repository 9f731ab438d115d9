"""What goes wrong, told apart by whose mistake it is: the caller's, the engine's or the oracle's."""
from __future__ import annotations

import contextlib
from collections.abc import Iterator

from . import _core


class InputError(ValueError):
    """An argument or a file cannot be used.

    argument  the argument's name, such as ``center1``; None where a file is at fault
    index     where in the argument as it was given, a tuple; None where all of it is at fault
    value     what stands there
    rule      what it breaks
    field     the same place in the words of files, such as ``a.center[1]``; None where there is none

    >>> import contact_oracle
    >>> try:
    ...     contact_oracle.sphere_sphere((0, 0, 0), [1, -1], (1, 0, 0), 1)
    ... except contact_oracle.InputError as error:
    ...     error.argument, error.index, error.value, error.rule, error.field
    ('radius1', (1,), -1.0, 'must not be negative', 'a.radius')
    """

    def __init__(self, rule: str, argument: str | None = None, index: tuple[int, ...] | None = None, value: object = None,
                 field: str | None = None) -> None:
        place = "" if argument is None else argument + (f"[{', '.join(map(str, index))}]" if index else "")
        got = "" if value is None else f", got {value}"
        super().__init__(f"{place}: {rule}{got}" if place else f"{rule}{got}")
        self.rule, self.argument, self.index, self.value, self.field = rule, argument, index, value, field


class EngineError(RuntimeError):
    """The engine raised, ended, or gave something that is no answer.

    pair  the pair it was asked
    line  the first question it was asked then, a line for ``explain``; None where it was not asked yet

    >>> import contact_oracle
    >>> try:
    ...     contact_oracle.certify(lambda questions: {"hit": 1 / 0}, "cube_cube", "touching")
    ... except contact_oracle.EngineError as error:
    ...     error.pair, type(error.__cause__)
    ('cube_cube', <class 'ZeroDivisionError'>)
    """

    def __init__(self, message: str, pair: str | None = None, line: str | None = None) -> None:
        super().__init__(message if line is None else f"{message}\n  first question  {line}")
        self.pair, self.line = pair, line


class OracleDisagreement(RuntimeError):
    """Two oracles differ. No engine is to blame: please report it.

    >>> import contact_oracle
    >>> issubclass(contact_oracle.OracleDisagreement, RuntimeError)
    True
    """


@contextlib.contextmanager
def errors_of_core() -> Iterator[None]:
    """The core's exceptions become those of this module. A number outside the domain is named as in files; `asked` knows it better."""
    try:
        yield
    except _core.DomainError as error:
        field, _, value, rule = error.args
        raise InputError(rule, field, None, value, field) from None
    except InputError:
        raise
    except ValueError as error:  # BadInput, and what the core says of an argument
        raise InputError(str(error)) from None
    except _core.OracleFault as error:
        raise OracleDisagreement(str(error)) from None
