"""What `suite` makes: a test function for pytest, which the plugin asks once for each family and each law."""
from __future__ import annotations

import functools
import json
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from .errors import EngineError
from .judging import LEAST_JUDGED, certify_sources, pairs_of
from .pairs import scalar_named

if TYPE_CHECKING:
    import pytest

GOLDEN_COUNT = 200
GOLDEN_SEED = 42
FRESH = 50
SHOWN = 3


@dataclass(frozen=True)
class Suite:
    """What `suite` was asked for."""

    pairs: tuple[str, ...]
    families: tuple[str, ...] | None
    laws: tuple[str, ...] | None
    scalar: str
    count: int


@dataclass(frozen=True)
class Case:
    """One test: a family of golden cases, or a law."""

    suite: Suite
    kind: str
    id: str
    pairs: tuple[str, ...] = ()
    source: Mapping[str, Any] | None = None
    law: str | None = None


def suite(pairs: str | Iterable[str] | None = None, families: str | Iterable[str] | None = None, laws: str | Iterable[str] | bool = True, *,
          scalar: str = "binary64", count: int = GOLDEN_COUNT) -> Callable[..., None]:
    """The tests of an engine for pytest: assign it to a name that begins with ``test_``, beside a session fixture `contact_engine`.

    pairs      what the engine serves; all pairs
    families   of the golden cases; all in the domain. ``()`` for none
    laws       their names; True for all that are about the pairs, False for none
    scalar     what the engine computes in
    count      how many golden cases of each family, where they are generated

    InputError where there is no such pair, family or law. docs/python.md#test-with-pytest has a whole file.

    >>> import contact_oracle
    >>> test_contacts = contact_oracle.suite("cube_cube", ["generic", "touching"], laws=False)
    >>> test_contacts.__name__
    'test_contacts'
    """
    def named(names: str | Iterable[str]) -> tuple[str, ...]:
        return (names,) if isinstance(names, str) else tuple(names)

    asked = Suite(pairs_of(pairs, None), None if families is None else named(families),
                  None if laws is True else () if laws is False else named(laws), scalar_named(scalar), count)

    def test_contacts(contact_case: Case, contact_engine: Any, contact_conventions: Any, contact_tolerance: Any, contact_level: Any,
                      contact_bounds: Any, contact_claims: Any, contact_least_judged: Any, request: pytest.FixtureRequest) -> None:
        declared = {"conventions": contact_conventions, "bounds": contact_bounds, "claims": contact_claims}
        try:
            if contact_case.kind == "law":
                _test_law(contact_case, contact_engine, declared, contact_tolerance, request.config)
            else:
                _test_golden(contact_case, contact_engine, declared, contact_tolerance, contact_level, contact_least_judged)
        except EngineError as error:
            # The engine's own trace is the cause; ours would only stand before it.
            raise error.with_traceback(None)

    test_contacts.contact_suite = asked  # type: ignore[attr-defined]
    return test_contacts


def _test_golden(case: Case, engine: Any, declared: Mapping[str, Any], tolerance: Any, level: str,
                 least_judged: int | None) -> None:
    import pytest

    # A family alone may have few questions that the engine serves; the verdict is that of the suite. But who says hit every time is
    # conservative in every family.
    if least_judged is None:
        least_judged = LEAST_JUDGED if level == "conservative" else 0
    report = certify_sources(engine, case.pairs, [dict(case.source or {})], scalar=case.suite.scalar, level=level,
                             fresh=FRESH, seed=GOLDEN_SEED, tolerance=tolerance, least_judged=least_judged, **declared)
    if report.certified:
        return
    lines = [report.verdict, *report.diagnosis]
    for worst in report.worst[:SHOWN]:
        lines += ["", worst["what"], f"  question  {_text(worst['query'])}", f"  expected  {_text(worst.get('right'))}",
                  f"  got       {_text(worst.get('claimed'))}"]
    pytest.fail("\n".join(lines), pytrace=False)


def _test_law(case: Case, engine: Any, declared: Mapping[str, Any], tolerance: Any, config: pytest.Config) -> None:
    import pytest

    laws = pytest.importorskip("contact_oracle.laws", reason="the laws need Hypothesis")
    seed = config.getoption("--contact-seed")
    # Said after the exception is done with: pytest shows one that comes while another is handled under it, and so a failure twice.
    say: Callable[[], Any] | None = None
    try:
        laws.check(case.law, engine, case.suite.pairs, scalar=case.suite.scalar, examples=config.getoption("--contact-max-examples"), seed=seed,
                   conventions=declared["conventions"], ulps=largest_bound(declared["bounds"]), tolerance=tolerance)
    except laws.NotAsked as why:
        say = functools.partial(pytest.skip, str(why))
    except AssertionError as error:
        say = functools.partial(pytest.fail, f"{error}\n\nagain with --contact-seed {seed}", pytrace=False)
    except EngineError:
        raise
    except Exception as error:
        raise EngineError(f"{case.law}: the engine raised {type(error).__name__}: {error}") from error
    if say is not None:
        say()


def largest_bound(bounds: Mapping[str, float] | None) -> float | None:
    return max(bounds.values(), default=None) if bounds else None


def _text(value: Any) -> str:
    return json.dumps(value, separators=(",", ":"))
