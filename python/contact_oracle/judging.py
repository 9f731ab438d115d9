"""Verdicts: an engine is asked, the core judges, and the report says what is so."""
from __future__ import annotations

import contextlib
import functools
import html
import json
import os
import secrets
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

from . import _core
from .by_command import ask_command
from .datasets import families as families_of
from .engines import Asking, Engine, Isolated, by_pair, claims_of, points_of
from .errors import EngineError, InputError, OracleDisagreement, errors_of_core
from .pairs import PAIRS, pair_named, scalar_named
from .shapes import plain
from .shown import figure_of_errors, text

LEVELS = ("correctly-rounded", "faithful", "bounded", "decisions", "conservative")
_REACHED = (*LEVELS, "none")
COUNT = 200
FRESH = 100
LEAST_JUDGED = 10


class Report:
    """A verdict, and everything that it rests on.

    certified  whether the engine reached what was required
    level      the strictest level that every answer reaches, ``none`` included
    verdict    the verdict in one sentence
    failures   the questions that were answered wrongly: dicts with ``what`` is wrong and the ``line`` for ``explain``
    diagnosis  what the wrong answers have in common, in sentences
    fitness    the tolerance from which on the engine would pass, for ``all`` numbers and for ``everyday`` ones
    seed       what generated the questions, of files the fresh ones; None where none were generated
    data       the whole report as `docs/formats.md#reports` describes it

    >>> import contact_oracle
    >>> report = contact_oracle.certify(lambda questions: {"hit": questions.alarm >= 0}, "cube_cube", "generic", seed=1, level="decisions")
    >>> report.certified, report.level, report.failures[0]["what"][:9]
    (False, 'conservative', 'false hit')
    """

    def __init__(self, judged: Mapping[str, Any], seed: int | None) -> None:
        self._judged = dict(judged)
        self.seed = seed
        self.data: dict[str, Any] = json.loads(judged["json"])
        self.certified: bool = judged["exit"] == 0
        fresh = (self.data["fresh"] or {}).get("total")
        self.level: str = max([self.data["total"]["level"], *([fresh["level"]] if fresh and fresh["judged"] else [])], key=_REACHED.index)
        self.verdict: str = self.data["verdict"]
        self.diagnosis: list[str] = self.data["diagnosis"]

    @functools.cached_property
    def failures(self) -> list[dict[str, Any]]:
        fresh = (self.data["fresh"] or {}).get("failures", [])
        return [{**failure, "line": json.dumps({key: failure[key] for key in ("id", "pair", "scalar", "a", "b", "alarm", "contact")
                                                if key in failure}, separators=(",", ":"))} for failure in [*self.data["failures"], *fresh]]

    @property
    def failure_count(self) -> int:
        """How many questions were answered wrongly; `failures` has so many of them as a report keeps."""
        return int(self.data["failure_count"]) + int((self.data["fresh"] or {}).get("failure_count", 0))

    @property
    def worst(self) -> list[dict[str, Any]]:
        """Some failures of every kind, with what was ``claimed`` and what would be ``right``."""
        return list(self.data["worst"])

    @property
    def fitness(self) -> dict[str, Any]:
        """The tolerance from which on the engine would pass, in the unit of the questions and in radians: docs/formats.md#reports."""
        return {"all": self.data["total"].get("fitness"), "everyday": self.data["total"].get("everyday")}

    @property
    def families(self) -> list[dict[str, Any]]:
        """Counts by family."""
        return list(self.data["families"])

    def __str__(self) -> str:
        seed = "" if self.seed is None or self.data["fresh"] else f"\nGenerated from seed {self.seed}."
        return str(self._judged["text"]).rstrip("\n") + seed

    def __repr__(self) -> str:
        return f"<Report: {self.verdict}>"

    def __bool__(self) -> bool:
        return self.certified

    def _written(self, kind: str, path: str | os.PathLike[str] | None) -> str:
        text: str = self._judged[kind]
        if path is not None:
            with open(path, "w", encoding="utf-8", newline="\n") as file:
                file.write(text)
        return text

    def to_html(self, path: str | os.PathLike[str] | None = None) -> str:
        """The page, one file that loads nothing else; written to `path` where there is one."""
        return self._written("html", path)

    def to_json(self, path: str | os.PathLike[str] | None = None) -> str:
        """The report for programs, as ``contact-oracle certify --json`` writes it."""
        return self._written("json", path)

    def to_junit(self, path: str | os.PathLike[str] | None = None) -> str:
        """As JUnit, a case each family, for continuous integration; written to `path` where there is one."""
        return self._written("junit", path)

    def to_markdown(self, path: str | os.PathLike[str] | None = None) -> str:
        """As Markdown; written to `path` where there is one."""
        return self._written("markdown", path)

    def to_dataframe(self) -> Any:
        """A pandas.DataFrame, one row a family."""
        import pandas

        keys = ("pair", "scalar", "family", "cases", "judged", "hits", "missed_hits", "false_hits", "not_finite", "level")
        return pandas.DataFrame([{key: family.get(key) for key in keys} for family in self.data["families"]])

    def _repr_html_(self) -> str:
        # The page has styles and scripts of its own, which must not reach the notebook around it.
        return f'<iframe srcdoc="{html.escape(self.to_html())}" style="width:100%;height:45em;border:0"></iframe>'


    def to_figure(self) -> Any:
        """A matplotlib Figure of the errors: how many claims of each field are off by how many ulps; InputError without matplotlib."""
        return figure_of_errors(self.data["total"]["fields"], f"{self.data['engine']['name']}, {self.data['scalar']}")


class LawReport:
    """What became of each law.

    holds    whether no law is violated
    laws     dicts with ``law``, ``verdict``, and of a violated one ``sentence``, ``why`` and the shrunk ``questions``
    seed     the seed

    >>> import contact_oracle
    >>> report = contact_oracle.properties(lambda questions: {"hit": questions.alarm < 1}, "cube_cube", "swap", cases=20, seed=1)
    >>> report.holds, [law["law"] for law in report.violated], report.seed
    (True, [], 1)
    """

    def __init__(self, judged: Mapping[str, Any]) -> None:
        self._judged = dict(judged)
        self.data: dict[str, Any] = json.loads(judged["json"])
        self.holds: bool = judged["exit"] == 0
        self.seed: int = int(self.data["seed"])
        self.laws: list[dict[str, Any]] = self.data["laws"]

    @property
    def violated(self) -> list[dict[str, Any]]:
        """The laws that an answer violated."""
        return [law for law in self.laws if law["verdict"] == "violated"]

    @property
    def skipped(self) -> list[dict[str, Any]]:
        """The laws that were not asked, each with ``why``: what the engine declares leaves them nothing to ask."""
        return [law for law in self.laws if law["verdict"] == "skipped"]

    def __str__(self) -> str:
        return str(self._judged["text"]).rstrip("\n")

    def __repr__(self) -> str:
        return f"<LawReport: {len(self.violated)} of {len(self.laws) - len(self.skipped)} laws violated, " \
            f"{len(self.skipped)} not asked, seed {self.seed}>"

    def __bool__(self) -> bool:
        return self.holds

    def _repr_html_(self) -> str:
        return text(self)

    def to_json(self) -> str:
        """The report for programs, as ``contact-oracle properties --json`` would say it."""
        return str(self._judged["json"])

    def to_junit(self) -> str:
        """As JUnit, a case each law."""
        return str(self._judged["junit"])


def _declared(name: str, version: str, scalar: str, pairs: Iterable[str], conventions: Mapping[str, Any] | None,
              pair_conventions: Mapping[str, Any] | None, bounds: Mapping[str, float] | None, claims: Iterable[str] | None,
              rounds: Iterable[str] | None) -> str:
    """What an engine declares, as the header of a results file does."""
    declared: dict[str, Any] = {"engine": {"name": name, "version": version}, "scalar": scalar_named(scalar), "pairs": list(pairs)}
    optional = {"conventions": conventions, "pair_conventions": pair_conventions, "bounds": bounds,
                "claims": None if claims is None else list(claims), "rounds": None if rounds is None else list(rounds)}
    return json.dumps(plain(declared | {key: value for key, value in optional.items() if value is not None}))


def pairs_of(pairs: str | Iterable[str] | None, served: tuple[str, ...] | None) -> tuple[str, ...]:
    if pairs is None:
        return served if served is not None else tuple(PAIRS)
    named = (pairs,) if isinstance(pairs, str) else tuple(pairs)
    if not named:
        raise InputError("must name a pair", "pairs")
    return tuple(pair_named(pair).name for pair in named)


def generated_sources(pairs: Iterable[str], families: str | Iterable[str] | None, scalar: str, seed: int, count: int) -> list[dict[str, Any]]:
    """The generated questions of some pairs: all families but those outside the domain, or the named ones that a pair has."""
    pairs = tuple(pairs)
    wanted = None if families is None else (families,) if isinstance(families, str) else tuple(families)
    known = {pair: {entry["name"]: entry["outside_domain"] for entry in families_of(pair)} for pair in pairs}
    for family in wanted or ():
        if not any(family in known[pair] for pair in pairs):
            raise InputError("is a family of none of the pairs", "families", value=repr(family))
    chosen = [(pair, family) for pair in pairs for family, outside in known[pair].items()
              if (not outside if wanted is None else family in wanted)]
    return [{"pair": pair, "family": family, "scalar": scalar, "seed": seed, "count": count} for pair, family in chosen]


@contextlib.contextmanager
def _asking(engine: Engine, isolated: bool, limit: float | None) -> Iterator[Asking]:
    if not isolated:
        if limit is not None:
            raise InputError("needs isolated=True: nothing else can end an engine that hangs", "time_limit")
        yield Asking(engine)
        return
    if limit is not None and not (isinstance(limit, (int, float)) and limit > 0):
        raise InputError("must be seconds, more than 0", "time_limit", value=repr(limit))
    with Isolated(engine, limit) as process:
        yield Asking(process)


def _name_of(engine: Any, name: str | None) -> str:
    if name is not None:
        return name
    found = getattr(engine, "__name__", None) or type(engine).__name__
    return "python" if found in ("<lambda>", "dict") else str(found)


def certify(engine: Engine | Mapping[str, Engine], pairs: str | Iterable[str] | None = None, families: str | Iterable[str] | None = None,
            datasets: str | os.PathLike[str] | Iterable[str | os.PathLike[str]] | None = None, *, count: int = COUNT, seed: int | None = None,
            fresh: int = FRESH, within: float | None = None, least_judged: int = LEAST_JUDGED, scalar: str = "binary64",
            level: str = "bounded", tolerance: Mapping[str, Any] | None = None, profile: str | None = None,
            conventions: Mapping[str, Any] | None = None, pair_conventions: Mapping[str, Any] | None = None,
            bounds: Mapping[str, float] | None = None, claims: Iterable[str] | None = None,
            rounds: Iterable[str] | None = None, allow_unsupported: bool = False,
            check: str = "sample", determinism: bool = False, isolated: bool = False, time_limit: float | None = None,
            name: str | None = None, version: str = "1") -> Report:
    """Judges an engine, and says everything that the verdict rests on.

    engine            a function of `Questions` that returns a dict, `Contacts` or anything with such attributes, each array with a row
                      a question; or a dict of such functions by pair. None in the place of an answer is *unsupported*
    pairs, families   what is asked; all pairs (of a dict: its own), and all families of them that lie in the domain
    datasets          files or folders of golden files, in the place of generated questions
    count, seed       how many questions of each family, and from which seed: a random one where it is None; the report says it
    fresh             with datasets: how many new questions of each of their families are asked besides, from that seed
    within            with the level conservative: how far from where the answer changes a miss may be that is called a hit
    least_judged      how many judged cases a certificate rests on at least, hits and misses: docs/specification.md#what-a-verdict-rests-on
    scalar            binary64 or binary32: what the engine computes in; the truth is rounded to it. In binary32 the engine gets arrays of
                      float32, and must answer with such
    level             correctly-rounded, faithful, bounded, decisions or conservative
    tolerance         in the place of a level: a dict of length, relative and angle, and scale: a dict of min and max
    profile           a tolerance by its name
    conventions       what the answers mean, where it is not the default: docs/specification.md#conventions
    pair_conventions  the same for some of the pairs
    bounds            of value, normal and point, in ulps, 1 to 64; else 8
    claims            the fields that every answer to a hit has; else those that its answers to one question of each pair have
    rounds            what is rounded before the engine sees it: ["orientation"] where a rotated box gets a matrix or a unit quaternion
    allow_unsupported leave out questions that the engine answers with None
    check             sample or all: which questions every oracle is asked
    determinism       ask again in other orders and batches; every answer must have the same bits
    isolated          the engine runs in a process of its own, which may crash or hang, so it must be a function of a module, and a script
                      keeps its own calls under ``if __name__ == "__main__":``
    time_limit        seconds that an isolated engine has for each batch
    name, version     for the report; else the function's name, and 1

    Raises EngineError where the engine raises, ends or gives no answer, InputError where an argument is wrong, and OracleDisagreement.

    >>> import contact_oracle
    >>> import numpy as np
    >>> def boxes(questions):
    ...     apart = np.maximum(questions.min1 - questions.max2, questions.min2 - questions.max1)
    ...     return {"hit": (apart <= questions.alarm[:, np.newaxis]).all(axis=1)}
    >>> report = contact_oracle.certify(boxes, "cube_cube", ["generic", "touching"], seed=1, level="decisions")
    >>> report.certified, report.level
    (True, 'decisions')
    """
    _, served = by_pair(engine)
    named = pairs_of(pairs, served)
    scalar_named(scalar)
    if datasets is None:
        seed = secrets.randbits(32) if seed is None else seed
        sources = generated_sources(named, families, scalar, seed, count)
    else:
        sources = golden_sources(datasets, named, families, scalar)
        if not fresh and seed is not None:
            raise InputError("chooses fresh questions, and fresh=0 asks none", "seed")
        if fresh:
            seed = secrets.randbits(32) if seed is None else seed
    return certify_sources(engine, named, sources, seed=seed, fresh=0 if datasets is None else fresh, within=within,
                           least_judged=least_judged, scalar=scalar, level=level, tolerance=tolerance, profile=profile,
                           conventions=conventions, pair_conventions=pair_conventions, bounds=bounds, claims=claims, rounds=rounds,
                           allow_unsupported=allow_unsupported, check=check, determinism=determinism, isolated=isolated,
                           time_limit=time_limit, name=name, version=version)


def certify_sources(engine: Engine | Mapping[str, Engine], pairs: Iterable[str], sources: list[dict[str, Any]], *, seed: int | None = None,
                    fresh: int = 0, within: float | None = None, least_judged: int = LEAST_JUDGED, scalar: str = "binary64",
                    level: str = "bounded", tolerance: Mapping[str, Any] | None = None, profile: str | None = None,
                    conventions: Mapping[str, Any] | None = None, pair_conventions: Mapping[str, Any] | None = None,
                    bounds: Mapping[str, float] | None = None, claims: Iterable[str] | None = None,
                    rounds: Iterable[str] | None = None, allow_unsupported: bool = False,
                    check: str = "sample", determinism: bool = False, isolated: bool = False, time_limit: float | None = None,
                    name: str | None = None, version: str = "1") -> Report:
    """`certify` on sources as the core takes them: files, or a family with its seed."""
    if level not in LEVELS:
        raise InputError(f"must be one of {', '.join(LEVELS)}", "level", value=repr(level))
    if tolerance is not None and profile is not None:
        raise InputError("cannot stand beside a profile", "tolerance")
    if within is not None and (level != "conservative" or tolerance is not None or profile is not None):
        raise InputError("is of the level conservative, which forgives false hits", "within")
    if not sources:
        raise InputError("no question to judge: no file or family is of these pairs and this scalar")
    # A tolerance takes the place of a level, and the core is given one of the two.
    options = {"level": None if tolerance is not None or profile is not None else level, "tolerance": tolerance, "profile": profile,
               "allow_unsupported": allow_unsupported, "check": check, "determinism": determinism, "within": within,
               "least_judged": least_judged, "fresh": {"each": fresh, "seed": seed} if fresh else None}
    pairs = tuple(pairs)
    with _asking(by_pair(engine)[0], isolated, time_limit) as ask, errors_of_core():
        if claims is None:
            claims = claims_of(ask, pairs, scalar)
        claims = None if claims is None else list(claims)
        if claims is not None:
            # As docs/formats.md#answers-in-columns says of columns.
            conventions = {**points_of(claims), **(conventions or {})} or None
        declared = _declared(_name_of(engine, name), version, scalar, pairs, conventions, pair_conventions, bounds, claims, rounds)
        judged = _core.certify(ask, declared, json.dumps(plain(sources)), json.dumps(plain({key: value for key, value in options.items() if value is not None})))
    _raise_unless_judged(judged)
    return Report(judged, seed)


def _raise_unless_judged(judged: Mapping[str, Any]) -> None:
    if judged["exit"] == 2:
        raise InputError(str(judged["text"]).strip())
    if judged["exit"] == 3:
        raise EngineError(str(judged["text"]).strip())
    if judged["exit"] == 4:
        raise OracleDisagreement(str(judged["text"]).strip())


def properties(engine: Engine | Mapping[str, Engine], pairs: str | Iterable[str] | None = None, laws: str | Iterable[str] | None = None, *,
               cases: int = 1000, seed: int | None = None, scalar: str = "binary64", level: str = "bounded",
               conventions: Mapping[str, Any] | None = None, pair_conventions: Mapping[str, Any] | None = None,
               bounds: Mapping[str, float] | None = None, claims: Iterable[str] | None = None, rounds: Iterable[str] | None = None, name: str | None = None,
               version: str = "1", tolerance: Mapping[str, Any] | None = None, profile: str | None = None) -> LawReport:
    """Asks an engine every law of the command, or the named ones, and shrinks what violates them: docs/properties.md.

    The command ``contact-oracle`` asks, so it must be installed; the engine answers in this process. Arguments as of `certify`;
    `cases` are per law, and `level` is bounded or correctly-rounded; a `tolerance` or a `profile` holds in its place.

    InputError where it is not or an argument is wrong, EngineError where the engine answers nothing.

    >>> import contact_oracle
    >>> report = contact_oracle.properties(lambda questions: {"hit": questions.min1[:, 0] < 0}, "cube_cube", "swap", cases=100, seed=1)
    >>> report.holds, report.violated[0]["law"]
    (False, 'swap')
    """
    if tolerance is not None and profile is not None:
        raise InputError("cannot stand beside a profile", "tolerance")
    asked_engine, served = by_pair(engine)
    named = pairs_of(pairs, served)
    if claims is None:
        claims = claims_of(Asking(asked_engine), named, scalar_named(scalar))
    declared = json.loads(_declared(_name_of(engine, name), version, scalar, named, conventions, pair_conventions, bounds, claims, rounds))
    options = ["--cases", str(cases), "--seed", str(secrets.randbits(32) if seed is None else seed)]
    if tolerance is not None:
        declared["tolerance"] = plain(tolerance)
    else:
        options += ["--level", level] if profile is None else ["--profile", profile]
    for law in () if laws is None else (laws,) if isinstance(laws, str) else laws:
        options += ["--law", law]
    judged = ask_command("properties", options, asked_engine, declared, scalar)
    _raise_unless_judged(judged)
    return LawReport(judged)


def golden_sources(datasets: str | os.PathLike[str] | Iterable[str | os.PathLike[str]], pairs: Iterable[str],
                   families: str | Iterable[str] | None, scalar: str) -> list[dict[str, Any]]:
    """The datasets among files and in folders that are of these pairs, families and this scalar."""
    wanted = None if families is None else (families,) if isinstance(families, str) else tuple(families)
    pairs = tuple(pairs)
    paths = [os.fspath(path) for path in ([datasets] if isinstance(datasets, (str, os.PathLike)) else datasets)]
    for path in paths:
        if not os.path.exists(path):
            raise InputError("is not there", "datasets", value=path)
        try:
            path.encode()
        except UnicodeEncodeError:
            raise InputError("has a name that no report can state: it is no UTF-8", "datasets", value=repr(path)) from None
    with errors_of_core():
        found = _core.datasets(paths)
    # A binary64 engine reads every binary32 number; the other way round a question would be changed.
    return [{"dataset": path, "pair": pair, "scalar": of, "family": family} for path, pair, of, family in found
            if pair in pairs and (scalar == "binary64" or of == scalar) and (family != "invalid" if wanted is None else family in wanted)]
