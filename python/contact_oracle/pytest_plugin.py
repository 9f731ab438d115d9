"""The pytest plugin: one test for each family of golden cases, and one for each law.

    import contact_oracle, pytest
    from my_package import my_engine

    @pytest.fixture(scope="session")
    def contact_engine():
        return my_engine

    test_contacts = contact_oracle.suite(pairs=["sphere_sphere"])

Golden cases are fixed: the same questions every time, so a known failure stays the same and can be listed. Beside those that are published each family
has some that stand in no file. Laws ask other questions every
time, unless ``--contact-seed`` says otherwise.
"""
from __future__ import annotations

import secrets
from typing import Any

import pytest

from .errors import InputError
from .judging import generated_sources, golden_sources
from .suites import GOLDEN_SEED, Case, Suite

EXAMPLES = 100

HELP = {"--contact-golden": "A folder or a file of golden cases, in the place of generated ones",
        "--contact-max-examples": f"How many questions each law of contact_oracle is asked (default: {EXAMPLES})",
        "--contact-seed": "The seed of the laws of contact_oracle (default: random, printed)",
        "--contact-xfails-file": "A file of contact tests that are expected to fail, an id a line",
        "--contact-skips-file": "A file of contact tests that are skipped, an id a line"}


def seed_of(config: pytest.Config) -> int:
    seed = config.getoption("--contact-seed")
    if seed is None:
        # Drawn once a run. A worker of pytest-xdist is told what the first process drew.
        worker = getattr(config, "workerinput", None)
        seed = worker["contact_seed"] if worker is not None else secrets.randbits(32)
        config.option.contact_seed = seed
    return int(seed)


def _from_1(text: str) -> int:
    number = int(text)
    if number < 1:
        raise ValueError(text)
    return number


_from_1.__name__ = "whole number from 1"  # as argparse says it


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("contact_oracle")
    group.addoption("--contact-golden", metavar="PATH", help=HELP["--contact-golden"])
    group.addoption("--contact-max-examples", type=_from_1, default=EXAMPLES, metavar="N", help=HELP["--contact-max-examples"])
    group.addoption("--contact-seed", type=int, default=None, metavar="S", help=HELP["--contact-seed"])
    group.addoption("--contact-xfails-file", metavar="FILE", help=HELP["--contact-xfails-file"])
    group.addoption("--contact-skips-file", metavar="FILE", help=HELP["--contact-skips-file"])


def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line("markers", "contact_golden: golden cases of a family, judged by contact_oracle")
    config.addinivalue_line("markers", "contact_law: a law of contact_oracle on random questions")


@pytest.hookimpl(optionalhook=True)  # type: ignore[misc]
def pytest_configure_node(node: Any) -> None:
    node.workerinput["contact_seed"] = seed_of(node.config)


def pytest_report_collectionfinish(config: pytest.Config, items: list[pytest.Item]) -> list[str]:
    # Who has no suite hears nothing of us.
    return [f"contact_oracle: --contact-seed={seed_of(config)}"] if any(map(_is_ours, items)) else []


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    asked = getattr(metafunc.function, "contact_suite", None)
    if asked is None or "contact_case" not in metafunc.fixturenames:
        return
    try:
        cases = [*_golden_cases(asked, metafunc.config.getoption("--contact-golden")), *_law_cases(asked)]
    except InputError as error:
        raise pytest.Collector.CollectError(f"contact_oracle.suite: {error}") from None
    marks = {"golden": pytest.mark.contact_golden, "law": pytest.mark.contact_law}
    metafunc.parametrize("contact_case", [pytest.param(case, id=case.id, marks=marks[case.kind]) for case in cases])


def _golden_cases(asked: Suite, path: str | None) -> list[Case]:
    if asked.families == ():
        return []
    if path is None:
        return [Case(asked, "golden", f"golden-{source['pair']}-{source['family']}", (source["pair"],), source)
                for source in generated_sources(asked.pairs, asked.families, asked.scalar, GOLDEN_SEED, asked.count)]
    cases = []
    for source in golden_sources(path, asked.pairs, asked.families, asked.scalar):
        suffix = "" if source["scalar"] == asked.scalar else f"-{source['scalar']}"
        cases.append(Case(asked, "golden", f"golden-{source['pair']}-{source['family']}{suffix}", (source["pair"],), source))
    if not cases:
        raise pytest.Collector.CollectError(f"--contact-golden={path}: no golden cases of {', '.join(asked.pairs)} in {asked.scalar}")
    return cases


def _law_cases(asked: Suite) -> list[Case]:
    if asked.laws == ():
        return []
    try:
        from . import laws
    except ImportError:
        # One test that is skipped and says why, so that nobody takes its absence for a pass.
        return [Case(asked, "law", "laws")]
    for name in asked.laws or ():
        if name not in laws.LAWS:
            raise pytest.Collector.CollectError(f"contact_oracle.suite: no law {name!r}; the laws are {', '.join(laws.LAWS)}")
    names = laws.laws_about(asked.pairs) if asked.laws is None else asked.laws
    return [Case(asked, "law", f"law-{name}", law=name) for name in names]


def _ids_in(path: str | None) -> dict[str, int]:
    """The ids of a file, and the lines that they stand in."""
    if path is None:
        return {}
    try:
        with open(path, encoding="utf-8") as file:
            lines = [line.split("#")[0].strip() for line in file]
    except (OSError, UnicodeDecodeError) as error:
        raise pytest.UsageError(f"{path}: {getattr(error, 'strerror', None) or error}") from None
    return {line: at for at, line in enumerate(lines, 1) if line}


def _is_ours(item: pytest.Item) -> bool:
    return hasattr(getattr(item, "function", None), "contact_suite")


def _is_named(item: pytest.Item, entry: str) -> bool:
    """By the id of the node, by all that stands before its brackets, or by what is in them."""
    callspec = getattr(item, "callspec", None)
    return item.nodeid == entry or item.nodeid.startswith(entry + "[") or callspec is not None and callspec.id == entry


@pytest.hookimpl(trylast=True)  # type: ignore[misc]
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    ours = [item for item in items if _is_ours(item)]
    if ours:
        # Drawn before the first test, which is told it.
        seed_of(config)
    for option, mark in (("--contact-xfails-file", pytest.mark.xfail), ("--contact-skips-file", pytest.mark.skip)):
        path = config.getoption(option)
        for entry, line in _ids_in(path).items():
            for item in [item for item in ours if _is_named(item, entry)]:
                # Not strict: an engine that has become better is reported as XPASS, and breaks no build.
                item.add_marker(mark(reason=f"{path}:{line}"))


@pytest.fixture(scope="session")
def contact_engine() -> Any:
    """The engine: override it."""
    pytest.fail("define a fixture contact_engine of scope session that returns your engine", pytrace=False)


@pytest.fixture(scope="session")
def contact_conventions() -> Any:
    """What the engine's answers mean: docs/specification.md#conventions."""
    return None


@pytest.fixture(scope="session")
def contact_tolerance() -> Any:
    """A dict of length, relative and angle, in the place of a level."""
    return None


@pytest.fixture(scope="session")
def contact_level() -> str:
    """What golden cases require."""
    return "bounded"


@pytest.fixture(scope="session")
def contact_least_judged() -> Any:
    """How many cases of a family must be judged, hits and misses, as of `certify`; None: 10 for the level conservative, else any number."""
    return None


@pytest.fixture(scope="session")
def contact_bounds() -> Any:
    """The bounds of value, normal and point in ulps."""
    return None


@pytest.fixture(scope="session")
def contact_claims() -> Any:
    """The fields that every answer to a hit has."""
    return None
