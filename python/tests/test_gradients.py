"""Exact derivatives, and the judge of derivatives: a right formula, and the ways in which people go wrong."""
import types

import numpy as np
import pytest

import contact_oracle
from contact_oracle import EngineError, InputError, certify_gradient
from contact_oracle.gradients import FIELDS


class Dual:
    """Numbers and their derivatives, as automatic differentiation computes them: what a `where` leaves out is multiplied by 0."""

    def __init__(self, at, by):
        self.at, self.by = np.asarray(at, float), by

    @staticmethod
    def lift(x, like):
        return x if isinstance(x, Dual) else Dual(np.broadcast_to(x, like.at.shape), np.zeros_like(like.by))

    def __add__(self, other):
        other = Dual.lift(other, self)
        return Dual(self.at + other.at, self.by + other.by)

    def __mul__(self, other):
        other = Dual.lift(other, self)
        return Dual(self.at * other.at, self.at[:, None] * other.by + other.at[:, None] * self.by)

    def __sub__(self, other):
        return self + Dual.lift(other, self) * -1.0

    def __truediv__(self, other):
        at = self.at / other.at
        return Dual(at, (self.by - at[:, None] * other.by) / other.at[:, None])

    def sqrt(self):
        root = np.sqrt(self.at)
        return Dual(root, 0.5 / root[:, None] * self.by)

    def clip(self, low, high):
        inside = (self.at >= low) & (self.at <= high)
        return Dual(np.clip(self.at, low, high), np.where(inside[:, None], self.by, 0))

    def constant(self):
        return Dual(self.at, np.zeros_like(self.by))


def where(mask, x, y):
    x, y = (Dual.lift(z, x if isinstance(x, Dual) else y) for z in (x, y))
    return Dual(np.where(mask, x.at, y.at), mask[:, None] * x.by + ~mask[:, None] * y.by)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def differentiated(formula):
    """The engine that a formula for a sphere and a capsule is."""
    def engine(questions):
        names = ("center1", "radius1", "start2", "end2", "radius2")
        width = {name: questions[name][0].size for name in names}
        total, begin, arguments = sum(width.values()), 0, {}
        for name in names:
            columns = questions[name].reshape((len(questions), -1)).astype(float).T
            arguments[name] = [Dual(x, np.tile(np.eye(total)[begin + k], (len(questions), 1))) for k, x in enumerate(columns)]
            begin += width[name]
        with np.errstate(all="ignore"):
            outputs = formula(types.SimpleNamespace(**arguments), questions)
        found, begin = {}, 0
        for name in names:
            for field, components in outputs.items():
                by = np.stack([x.by[:, begin:begin + width[name]] for x in components], axis=1)
                shape = (len(questions), *(() if field == "value" else (3,)), *questions[name].shape[1:])
                found.setdefault(field, {})[name] = by.reshape(shape)
            begin += width[name]
        return found
    return engine


def sphere_capsule(mistake=""):
    @differentiated
    def formula(q, questions):
        center, start, end = q.center1, q.start2, q.end2
        axis = [e - s for e, s in zip(end, start)]
        length2 = dot(axis, axis)
        along = dot([c - s for c, s in zip(center, start)], axis)
        share = along / where(length2.at > 0, length2, 1.0)
        if mistake == "where":
            share = where(length2.at > 0, along / length2, 0.0)
        share = share.clip(0, 1)
        if mistake == "constant share":
            share = share.constant()
        nearest = [s + share * a for s, a in zip(start, axis)]
        if mistake == "constant point":
            nearest = [x.constant() for x in nearest]
        delta = [n - c for n, c in zip(nearest, center)]
        square = dot(delta, delta)
        apart = square.at > 0
        safe = where(apart, square, 1.0)
        if mistake == "norm at 0":
            distance = square.sqrt()
        elif mistake == "where at 0":
            distance = where(apart, square.sqrt(), 0.0)
        elif mistake == "number in the root":
            distance = (square + 1e-6).sqrt()
        else:
            distance = where(apart, safe.sqrt(), 0.0)
        normal = [where(apart, d / (distance if mistake == "norm at 0" else safe.sqrt()), axis) for d, axis in zip(delta, (1.0, 0.0, 0.0))]
        value = distance - q.radius1[0] - q.radius2[0] - questions.contact
        if mistake == "clamp":
            value = value.clip(0, np.inf)
        return {"value": [value], "normal": normal, "point1": [c + q.radius1[0] * n for c, n in zip(center, normal)],
                "point2": [x - q.radius2[0] * n for x, n in zip(nearest, normal)]}
    formula.__name__ = mistake or "right"
    return formula


def test_a_right_formula_is_certified_on_every_family():
    report = certify_gradient(sphere_capsule(), "sphere_capsule", seed=1)
    assert report.certified and not report.unclaimed, str(report)
    assert report.judged > 5000 and report.undefined > 300 and report.questions > 100
    assert str(report).startswith("CERTIFIED: right: derivatives of sphere_capsule")


@pytest.mark.parametrize("mistake, families, words", [
    ("norm at 0", ["on_axis"], "not finite where the cores meet: a root"),
    ("where at 0", ["on_axis"], "not finite where the cores meet: a root"),
    ("where", ["zero_length"], "not finite where the cores are apart: a branch that a `where`"),
    ("clamp", ["generic"], "0 by every number, also where it moves: a clamp"),
    ("constant point", ["generic"], "by the second shape are 0: its nearest point is taken for a constant"),
    ("constant share", ["generic"], "the place on an edge or a face is held fixed"),
    ("number in the root", ["generic"], "the derivative of sqrt(D + 1e-06)")])
def test_a_mistake_is_refuted_and_named(mistake, families, words):
    report = certify_gradient(sphere_capsule(mistake), "sphere_capsule", families, seed=1, relative=1e-9)
    assert not report.certified
    assert any(words in line for line in report.diagnosis), str(report)
    assert len(report.diagnosis) == 1, str(report)
    failure = report.failures[0]
    assert failure.line.startswith("{") and failure.line in str(report) and contact_oracle.explain(failure.line)


def test_the_derivatives_of_one_question_have_the_shapes_of_its_arguments():
    found = contact_oracle.gradient("sphere_sphere", (0, 0, 0), 1.5, (1, 2, 2), 1.5, contact=0.25)
    n = np.array([1, 2, 2]) / 3
    across = (np.eye(3) - np.outer(n, n)) / 3
    assert found.value["radius1"] == -1 and found.value["center1"] == pytest.approx(-n) and found.value["center2"] == pytest.approx(n)
    assert found.normal["center2"] == pytest.approx(across) and not found.normal["radius2"].any()
    assert found.point1["radius1"] == pytest.approx(n) and found.point1["center1"] == pytest.approx(np.eye(3) - 1.5 * across)
    assert found.point2["radius2"] == pytest.approx(-n) and found.point2["center1"] == pytest.approx(1.5 * across)
    assert set(np.ravel(found.why["normal"]["center1"])) == {""} and np.isnan(found.sides["normal"]["center1"]).all()


def test_kinks_and_edges_of_the_domain_say_why_and_have_their_sides():
    corner = contact_oracle.gradient("sphere_cube", [(0, 2, 0), (0.5, 2, 0)], [0, 1], (-1, -1, -1), (0, 1, 1))
    assert np.isnan(corner.normal["center1"][0, 0, 0]) and not np.isnan(corner.normal["center1"][1]).any()
    assert corner.why["normal"]["center1"][0, 0, 0].startswith("the nearest features change here")
    assert list(corner.sides["normal"]["center1"][0, 0, 0]) == [0, -1] and list(corner.value["center1"][0]) == [0, 1, 0]
    assert "edge of its domain" in corner.why["value"]["radius1"][0] and corner.value["radius1"][1] == -1
    assert np.isnan(corner.sides["value"]["radius1"][0, 0]) and corner.sides["value"]["radius1"][0, 1] == -1
    along = contact_oracle.gradient("capsule_capsule", (0, 0, 0), (2, 0, 0), 1, (0, 3, 0), (2, 3, 0), 1)
    assert along.why["point1"]["radius1"][0] == "many pairs of points are nearest" and along.value["radius1"] == -1


@pytest.mark.parametrize("pair", [pair for pair, of in contact_oracle.pairs.PAIRS.items() if of.numbers == "distance"])
def test_exact_derivatives_are_certified_for_every_pair(pair):
    def engine(questions):
        found = contact_oracle.gradient(questions)
        return {name: {argument: np.nan_to_num(by) for argument, by in getattr(found, name).items()} for name in FIELDS}

    questions = contact_oracle.generate(pair, "generic", 3, seed=2)
    report = certify_gradient(engine, pair, questions=questions)
    assert report.certified and not report.unclaimed and report.judged > 100 and report.last_bit == 0, str(report)
    assert report.questions == len(questions) and not certify_gradient(lambda q: {"value": {}}, pair, questions=questions)


def test_numbers_of_binary32_have_their_own_tolerance():
    def engine(questions):
        delta = questions.center2 - questions.center1
        normal = delta / np.linalg.norm(delta, axis=1, keepdims=True)
        assert normal.dtype == np.float32
        normal *= np.float32(1 + 1e-4)
        return None, (-normal, -np.ones_like(questions.radius1), normal, -np.ones_like(questions.radius2))

    report = certify_gradient(engine, "sphere_sphere", "generic", scalar="binary32", seed=1)
    assert report.certified and report.relative == 1e-3
    assert not certify_gradient(engine, "sphere_sphere", "generic", scalar="binary32", seed=1, relative=1e-5)


def test_what_the_last_bit_of_a_question_does_is_allowed_and_no_more():
    # The centres are 2^-20 apart, at 1: the last bit of one turns the normal by 2^-32, and 8 of two by 2^-28.
    questions = contact_oracle.Questions("sphere_sphere", {"center1": [[1.0, 0, 0]], "radius1": [1.0], "center2": [[1.0, 2.0**-20, 0]], "radius2": [1.0]})

    def judged(turned):
        return certify_gradient(lambda q: {"value": {"center2": np.array([[turned, 1.0, 0]])}}, "sphere_sphere", questions=questions, relative=1e-12,
                                scale=(1e-7, 1e4))

    assert judged(0).certified and judged(0).last_bit == 0
    assert judged(2.0**-29).certified and judged(2.0**-29).last_bit == 1
    assert judged(2.0**-27).failure_count == 1


def test_tensors_are_taken_without_their_gradients():
    class Tensor:
        requires_grad = True

        def __init__(self, array):
            self.array = array

        def detach(self):
            return self.array

    def engine(questions):
        normal = questions.center2 - questions.center1
        normal = normal / np.linalg.norm(normal, axis=1, keepdims=True)
        return Tensor(normal), {"center1": Tensor(-normal), "center2": Tensor(normal)}

    report = certify_gradient(engine, "sphere_sphere", "generic", seed=1)
    assert report.certified and report.unclaimed == ["radius1", "radius2"] and "none was claimed by radius1, radius2" in str(report)


def test_an_engine_may_write_into_its_questions():
    def engine(questions):
        normal = questions.center2
        normal -= questions.center1
        normal /= np.linalg.norm(normal, axis=1, keepdims=True)
        return None, {"center2": normal}

    assert certify_gradient(engine, "sphere_sphere", "generic", seed=1)
    questions = contact_oracle.generate("sphere_sphere", "generic", 20, seed=1)
    before = questions.center2.copy()
    assert certify_gradient(engine, "sphere_sphere", questions=questions) and (questions.center2 == before).all()


def test_where_there_is_no_derivative_finite_numbers_pass_and_others_are_asked_for():
    questions = contact_oracle.Questions("sphere_sphere", {"center1": [[0.0, 0, 0]], "radius1": [1.0], "center2": [[0.0, 0, 0]], "radius2": [1.0]})

    def engine(at):
        return lambda q: (None, {"center2": np.full((1, 3), at), "radius1": np.array([-1.0])})

    assert certify_gradient(engine(0.3), "sphere_sphere", questions=questions).undefined == 3
    refuted = certify_gradient(engine(np.nan), "sphere_sphere", questions=questions)
    assert not refuted and "which a step would carry on" in refuted.failures[0].what and refuted.failure_count == 3
    assert certify_gradient(engine(np.nan), "sphere_sphere", questions=questions, kinks="any")


def test_bad_input_is_named():
    with pytest.raises(InputError, match="has no distance"):
        certify_gradient(sphere_capsule(), "ray_triangle")
    with pytest.raises(InputError, match="no derivatives are told"):
        contact_oracle.gradient("cube_cube", (0, 0, 0), (1, 1, 1), (0, 0, 0), (1, 1, 1))
    with pytest.raises(InputError, match="kinks: must be finite or any"):
        certify_gradient(sphere_capsule(), "sphere_capsule", kinks="none")
    for named in (*(dict(relative=number) for number in (np.nan, np.inf, -1, "1e-6")), *(dict(scale=pair) for pair in (1, (2, 1), (np.nan, 1), (-1, 1), (1, 2, 3))),
                  *(dict(questions=some) for some in ([], "cheese", contact_oracle.generate("sphere_capsule", "generic", 3)))):
        with pytest.raises(InputError, match=f"{next(iter(named))}: must be"):
            certify_gradient(lambda questions: (None, {"radius1": np.zeros(len(questions))}), "sphere_sphere", **{**dict(families="generic", seed=1), **named})
    assert not certify_gradient(lambda questions: (None, {"radius1": np.zeros(len(questions))}), "sphere_sphere", "generic", count=0)
    for answer, words in ((3, "a pair of values and derivatives"), ((0, (1, 2)), "one of each of center1"), ((0, {"center3": 0}), "no argument 'center3'"),
                          ({"value": {"center1": np.zeros(3)}}, r"shape \(20, 3\)"), ({"value": {"radius1": np.zeros(20, int)}}, "int64")):
        with pytest.raises(EngineError, match=words):
            certify_gradient(lambda q, answer=answer: answer, "sphere_sphere", "generic", seed=1)
    with pytest.raises(EngineError, match="raised ZeroDivisionError"):
        certify_gradient(lambda q: 1 / 0, "sphere_sphere", "generic", seed=1)


def test_the_scale_is_that_of_numbers_of_the_same_kind():
    # The derivatives by a normal of length 1000 are a thousandth of those by the centre.
    questions = contact_oracle.Questions("sphere_plane", {"center1": [[0.0, 2, 0]], "radius1": [1.0], "normal2": [[0.0, 1000, 0]], "offset2": [0.0]})
    exact = contact_oracle.gradient(questions)

    def judged(field, argument, by):
        return certify_gradient(lambda q: {field: {argument: getattr(exact, field)[argument] + by}}, "sphere_plane", questions=questions, relative=1e-6)

    assert judged("point1", "center1", 9e-7) and not judged("point1", "center1", 2e-6)
    assert exact.normal["normal2"].any() and judged("normal", "normal2", 9e-10) and not judged("normal", "normal2", 2e-9)
    assert not exact.normal["center1"].any() and judged("normal", "center1", 4e-7) and not judged("normal", "center1", 6e-7)  # of 1 / 2


def test_beside_a_kink_by_the_last_bit_either_side_is_right():
    for x, allowed in ((1 + 2.0**-52, True), (1 + 2.0**-40, False)):
        questions = contact_oracle.Questions("sphere_cube", {"center1": [[x, 2.0, 0]], "radius1": [1.0], "min2": [[-1.0, -1, -1]], "max2": [[1.0, 1, 1]]})
        assert contact_oracle.gradient(questions).normal["center1"][0, 0, 0] == pytest.approx(-1)
        over_the_face = np.zeros((1, 3, 3))
        report = certify_gradient(lambda q, by=over_the_face: {"normal": {"center1": by}}, "sphere_cube", questions=questions, kinks="any")
        assert report.certified == allowed and report.last_bit == allowed


def test_a_mistake_without_a_name_gets_none():
    def engine(questions):
        found = contact_oracle.gradient(questions)
        return None, {argument: 0.9 * by for argument, by in found.value.items()}

    report = certify_gradient(engine, "sphere_capsule", "generic", seed=1)
    assert not report and report.diagnosis == []
