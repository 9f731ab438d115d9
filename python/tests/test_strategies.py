"""Strategies and laws: what they make lies in the domain, touches where it says so, and shrinks."""
import random
import warnings

import pytest

hypothesis = pytest.importorskip("hypothesis")

import engines
import every_example
import numpy as np
from hypothesis import HealthCheck, find, given, settings
from hypothesis import strategies as st

import contact_oracle
from contact_oracle import Cube, InputError, Question, Questions, Ray, Sphere, laws, strategies
from contact_oracle.pairs import PAIRS
from contact_oracle.shapes import SHAPES

FEW = settings(max_examples=every_example.of(30), deadline=None, suppress_health_check=list(HealthCheck), database=None, derandomize=True)
DISTANCES = [pair for pair in PAIRS if PAIRS[pair].numbers == "distance"]


def test_every_shape_has_a_strategy():
    assert set(strategies.OF_SHAPE) == set(SHAPES) == {shape for pair in PAIRS.values() for shape in pair.shapes}
    for pair in PAIRS.values():
        for side, shape in zip("ab", pair.shapes):
            assert list(SHAPES[shape].__dataclass_fields__) == [field.name for field in pair.fields if field.side == side]


@pytest.mark.parametrize("largest", [1e4, None])
@pytest.mark.parametrize("scalar", ["binary64", "binary32"])
@pytest.mark.parametrize("pair", PAIRS)
def test_questions_lie_in_the_domain(pair, scalar, largest):
    @FEW
    @given(strategies.questions(pair, scalar, largest))
    def check(question):
        assert question.answer().hit == question.exact().hit

    check()


@pytest.mark.parametrize("scalar", ["binary64", "binary32"])
@pytest.mark.parametrize("pair", PAIRS)
def test_touching_questions_touch(pair, scalar):
    @settings(FEW, max_examples=every_example.of(150))
    @given(strategies.touching(pair, scalar))
    def check(question):
        exact = question.exact()
        assert exact.hit
        if PAIRS[pair].numbers == "distance":
            assert exact.margin() == 0 and not exact.degenerate
        elif PAIRS[pair].numbers == "none":
            assert max(exact.gap) == question.alarm
        elif PAIRS[pair].numbers == "cast":
            assert {"EndsAtSurface", "Grazing", "FromInside", "ManyNormals"} & set(exact.flags)
        else:
            assert "CrossingEdge" in exact.flags

    check()


@pytest.mark.parametrize("pair", [*DISTANCES, "cube_cube"])
def test_near_touching_questions_are_hits_and_misses(pair):
    both = set()

    @settings(FEW, max_examples=every_example.of(100))
    @given(strategies.near_touching(pair))
    def check(question):
        exact = question.exact()
        both.add(exact.hit)
        if exact.margin_ulps is not None:
            assert abs(exact.margin_ulps) <= 8

    check()
    assert both == {True, False}


@pytest.mark.parametrize("bounds, word", [(dict(largest=1.0, smallest=2.0), "largest"), (dict(largest=-1.0), "largest"), (dict(largest=float("nan")), "largest"),
                                          (dict(smallest=-1.0), "smallest"), (dict(smallest=float("nan")), "smallest"), (dict(smallest=float("inf")), "smallest")])
def test_bounds_that_leave_no_number_are_refused(bounds, word):
    """Zeros were left, and of them nearly every law holds."""
    for strategy in (strategies.numbers, strategies.lengths, strategies.spheres, strategies.obbs):
        with pytest.raises(InputError, match=f"{word}: must"):
            strategy(**bounds)


def test_the_largest_number_is_one_of_the_scalar():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for largest, last in ((1e300, np.finfo(np.float32).max), (0.1, np.nextafter(np.float32(0.1), np.float32(0)))):
            assert find(strategies.lengths("binary32", largest), lambda x: x >= float(last), random=random.Random(1)) == float(last)


def test_laws_are_not_asked_of_zeros_alone():
    for scale in ({"min": 0.125, "max": 4.0}, {"min": 1.0, "max": 1e4}):
        with pytest.raises(laws.NotAsked, match="the scale is too narrow"):
            laws.check("repeatable", engines.right, ("sphere_sphere",), examples=3, conventions={"scale": scale})
    laws.check("repeatable", engines.right, ("sphere_sphere",), examples=3, conventions={"scale": {"min": 1e-4, "max": 1e4}})


def test_a_right_engine_obeys_where_numbers_end():
    """A value of -2 times the radius is infinite, and so is a point that is turned or scaled."""
    ball = Sphere((0.0, 0.0, 0.0), 1.7e308)
    questions = [Question("sphere_sphere", ball, ball), Question("sphere_sphere", ball, Sphere((0.0, 0.0, 1e308), 1.0))]
    ray = Question("cast_sphere", Ray((0.0, 0.0, 0.0), (1.0, 2.0, 2.0), float(np.finfo(np.float32).max)), Sphere((1.0, 2.0, 2.5), 1.0), scalar="binary32")
    laws.rotate(engines.right, ray, (0, 0, 1, 2))
    apart = [Cube((sign * 1.7e308, 0.0, 0.0), (sign * 1.7e308, 0.0, 0.0)) for sign in (-1, 1)]
    for question in (*questions, Question("cube_cube", *apart)):
        for ulps in (0.0, 8.0):
            laws.decision(engines.right, question, ulps=ulps)
            with pytest.raises(AssertionError, match="decision: a "):
                laws.decision(lambda asked, right=question.answer().hit: {"hit": np.array([not right])}, question, ulps=ulps)
    drawn = {"growth": 1.0, "by": (1.0, 0.0, 0.0), "axes": (1, 2, 0), "signs": (1, 1, 1), "quaternion": (0, 0, 1, 2), "exponent": -2, "which": 2, "corner": 0}
    suited = set()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for question in questions:
            for name, law in laws.LAWS.items():
                try:
                    law.check(engines.right, question, **{key: drawn[key] for key in law.draws or ()})
                    suited.add(name)
                except hypothesis.errors.UnsatisfiedAssumption:
                    pass
    assert {"repeatable", "scale", "swap", "turn", "bounds"} <= suited


def test_near_touching_has_no_crossings():
    with pytest.raises(InputError):
        strategies.near_touching("ray_triangle")


def test_questions_of_a_family():
    first = find(strategies.family("sphere_sphere", "touching"), lambda question: True, settings=FEW)
    assert first == contact_oracle.generate("sphere_sphere", "touching", 1)[0]
    with pytest.raises(InputError):
        strategies.family("sphere_sphere", "cheese")


def test_questions_shrink_to_simple_numbers():
    question = find(strategies.questions("sphere_sphere"), lambda question: question.exact().hit and question.a.radius > 1, settings=settings(FEW, max_examples=2000))
    assert question.a.center == question.b.center and question.alarm == question.contact == 0 and question.a.radius <= 2


def test_types_have_strategies():
    strategies._register()

    @FEW
    @given(st.from_type(Sphere), st.from_type(Question))
    def check(sphere, question):
        assert sphere.radius >= 0 and question.pair in PAIRS

    check()


@pytest.mark.parametrize("scalar", ["binary64", "binary32"])
@pytest.mark.parametrize("name", laws.LAWS)
def test_a_right_engine_obeys(name, scalar):
    laws.check(name, engines.right, tuple(PAIRS), scalar=scalar, examples=every_example.of(100), seed=1)


@pytest.mark.parametrize("name", [name for name in laws.LAWS if name not in ("translate", "contact_distance")])
def test_a_right_engine_obeys_bit_for_bit(name):
    laws.check(name, engines.right, tuple(PAIRS), examples=every_example.of(100), seed=2, ulps=0)


@pytest.mark.parametrize("name", [name for name in laws.LAWS if name != "decision" and laws.LAWS[name].concerns("sphere_sphere")])
def test_plain_arithmetic_obeys_all_but_the_decisions(name):
    laws.check(name, engines.plain_spheres_or_first_axis, ("sphere_sphere",), examples=every_example.of(300), seed=3)


TOLERANCE = {"length": 1e-9, "relative": 1e-12, "angle": 1e-6}


def off_by(times):
    """Every number nearly as far off as `times` the tolerance allows, one way or the other; half of the decisions that it allows either way."""
    def engine(questions):
        side = np.where(np.sin(1e3 * sum(questions[name].reshape(len(questions), -1).sum(axis=1) for name in questions.keys())) > 0, 1.0, -1.0)
        farther = Questions(questions.pair, {**questions, "alarm": questions.alarm + np.maximum(side, 0) * 0.9e-9}, questions.scalar)
        right = farther.answer()
        if right.value is None:
            return {"hit": right.hit}
        off = side * times * 0.99e-9
        return {"hit": right.hit, "normal": right.normal, "value": right.value + off,
                **{name: getattr(right, name) + off[:, np.newaxis] * (0, 1, 0) for name in ("point1", "point2")}}

    return engine


@pytest.mark.parametrize("name", laws.LAWS)
def test_laws_forgive_what_a_tolerance_forgives(name):
    laws.check(name, off_by(1), tuple(PAIRS), examples=every_example.of(60), seed=4, tolerance=TOLERANCE)


def test_laws_forgive_nothing_beyond_a_tolerance():
    with pytest.raises(AssertionError, match="bounds: a number is beyond the tolerance"):
        laws.check("bounds", off_by(2), tuple(PAIRS), examples=60, seed=4, tolerance=TOLERANCE)
    with pytest.raises(AssertionError, match="bounds: "):
        laws.check("bounds", off_by(1), tuple(PAIRS), examples=60, seed=4)
    for name in ("swap", "turn", "contact_distance"):
        with pytest.raises(AssertionError, match=f"^{name}: "):
            laws.check(name, MISTAKES[name], ("sphere_sphere",), examples=100, seed=1, tolerance=TOLERANCE)


def worse(**changes):
    def engine(questions):
        right = questions.answer()
        answers = {"hit": right.hit, "normal": right.normal, "point1": right.point1, "point2": right.point2, "value": right.value}
        return {**answers, **{name: change(questions, answers) for name, change in changes.items()}}

    return engine


MISTAKES = {
    "decision": worse(hit=lambda q, a: a["hit"] & (a["value"] + q.contact - q.alarm != 0)),
    "bounds": worse(value=lambda q, a: a["value"] * (1 + 1e-9) + 1e-9), "swap": worse(point1=lambda q, a: a["point2"] * 2),
    "scale": worse(value=lambda q, a: a["value"] + 1), "translate": worse(value=lambda q, a: a["value"] + q.center1[:, 0]),
    "turn": worse(normal=lambda q, a: a["normal"] * np.array([1, 1, -1])), "unit_normal": worse(normal=lambda q, a: a["normal"] * 1.001),
    "finite": worse(value=lambda q, a: a["value"] * np.nan), "alarm_growth": worse(hit=lambda q, a: a["hit"] & (q.alarm == 0)),
    "alarm_changes_no_number": worse(value=lambda q, a: a["value"] - q.alarm), "contact_distance": worse(value=lambda q, a: a["value"] - q.contact),
    "size_growth": worse(hit=lambda q, a: a["hit"] & (q.radius1 < 5)),
    "rotate": worse(value=lambda q, a: np.abs(q.center2 - q.center1).max(axis=1) - q.radius1 - q.radius2 - q.contact),
    "onto_point": worse(value=lambda q, a: a["value"] + q.radius1 * is_near(np.linalg.norm(q.center2 - q.center1, axis=1), q.radius2)),
}


def is_near(length, other):
    return np.abs(length - other) <= 1e-9 * np.maximum(length, other)


@pytest.mark.parametrize("name", every_example.some(MISTAKES))
def test_a_mistake_violates_its_law(name):
    with pytest.raises(AssertionError, match=rf'^{name}: .*\n  question 1  \{{"pair":"sphere_sphere".*\n    expected  .*\n    got       \{{"overlap"'):
        laws.check(name, MISTAKES[name], ("sphere_sphere",), examples=300, seed=1)


def test_a_mistake_at_the_ends_of_a_capsule_violates_the_law_that_cuts_it_there():
    def at_an_end(questions):
        right = questions.answer()
        core = right.point2 + questions.radius2[:, np.newaxis] * right.normal
        size = 1 + np.abs(core).max(axis=1)
        at = np.minimum(*(np.linalg.norm(core - end, axis=1) for end in (questions.start2, questions.end2))) <= 1e-9 * size
        return {"hit": right.hit, "normal": right.normal, "point2": right.point2, "value": right.value + size * at}

    with pytest.raises(AssertionError, match="^cut_at_point: value is"):
        laws.check("cut_at_point", at_an_end, ("sphere_capsule",), examples=300, seed=1)


def test_a_law_about_another_meaning_is_not_asked():
    with pytest.raises(laws.NotAsked, match="the engine declares value depth"):
        laws.check("contact_distance", engines.right, ("sphere_sphere",), conventions={"value": "depth"})
    with pytest.raises(laws.NotAsked, match="about none of cube_cube"):
        laws.check("bounds", engines.right, ("cube_cube",))


def test_laws_ask_what_the_engine_serves():
    asked = []

    def engine(questions):
        asked.append(questions)
        return questions.answer()

    laws.check("scale", engine, ("sphere_capsule",), examples=50, seed=1, conventions={"scale": {"min": 1e-3, "max": 1e3}})
    for questions in asked:
        for name in questions.keys():
            size = abs(questions[name][questions[name] != 0])
            assert ((size >= 1e-3) & (size <= 1e3)).all()


def test_an_unsteady_engine_is_not_repeatable():
    state = [0.0]

    def unsteady(questions):
        state[0] += 1
        return {"hit": np.ones(len(questions), bool), "value": np.full(len(questions), state[0])}

    with pytest.raises(AssertionError, match="repeatable"):
        laws.repeatable(unsteady, Question("sphere_sphere", Sphere((0.0,) * 3, 1.0), Sphere((0.0,) * 3, 1.0)))
