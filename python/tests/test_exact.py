"""Exact numbers, explanations, questions and files."""
import json
import os
from decimal import Decimal, getcontext
from fractions import Fraction

import numpy as np
import pytest

import contact_oracle
from contact_oracle import InputError, Question, Questions, Sphere
from contact_oracle.exact_answers import decimal, fraction, root_less
from contact_oracle.pairs import PAIRS


def test_exact_strings_are_fractions():
    assert fraction("-0x1abdp-12") == Fraction(-0x1ABD, 4096)
    assert fraction("0x1p2/0x3") == Fraction(4, 3)
    assert fraction("0x0p0") == 0
    assert fraction("0x3p1100") == 3 * Fraction(2) ** 1100


@pytest.mark.parametrize("square, less, digits", [
    (Fraction(2), Fraction(0), 50), (Fraction(2), Fraction(14142135623730951, 10**16), 30), (Fraction(10**40 + 1), Fraction(10**20), 25),
    (Fraction(1, 3), Fraction(1, 2), 40), (Fraction(2) ** -2000, Fraction(0), 20), (Fraction(3) * Fraction(2) ** 2001, Fraction(1), 60)])
def test_roots_are_rounded_once_whatever_cancels(square, less, digits):
    getcontext().prec = 2000
    precise = (Decimal(square.numerator) / Decimal(square.denominator)).sqrt() - Decimal(less.numerator) / Decimal(less.denominator)
    getcontext().prec = digits
    assert root_less(square, less, digits) == +precise
    getcontext().prec = 28
    assert decimal(Fraction(1, 8)) == Decimal("0.125")


def test_exact_numbers_of_one_question():
    answer = contact_oracle.exact("sphere_sphere", (0, 0, 0), 1.5, (1, 2, 2), 1.5, contact=0.25)
    assert (answer.distance2, answer.reach, answer.margin(), answer.margin_ulps) == (9, 3, 0, 0)
    assert answer.hit and not answer.degenerate and answer.unique and answer.flags == ("Touching",)
    assert answer.distance(5) == 3 and answer.value() == Decimal("-0.25") and answer.id == "7827fbcb904c1b0d7baa72b0"
    assert answer.gap is None and answer.crossing is None


def test_exact_numbers_of_each_kind_of_pair():
    boxes = contact_oracle.exact("cube_cube", (0, 0, 0), (1, 1, 1), (1.5, 0, 0), (2, 1, 1))
    assert boxes.gap == (Fraction(1, 2), -1, -1) and not boxes.hit
    with pytest.raises(AttributeError, match="no distance"):
        boxes.distance()
    crossing = contact_oracle.exact("triangle_line", ((0, 0, 0), (4, 0, 0), (0, 4, 0)), (1, 1, 1), (2, 1, -2))
    assert crossing.crossing == (Fraction(4, 3), 1, 0) and crossing.distance2 is None
    below = contact_oracle.exact("sphere_plane", (0, 0, -2), 1, (0, 0, 1), 0)
    assert below.below and below.distance() == -2 and below.margin() == -3 and below.value() == -3
    inside = contact_oracle.exact("sphere_cube", (0.25, 0.5, 0.5), 1.5, (0, 0, 0), (1, 1, 1), contact=0.25)
    assert inside.degenerate and inside.value() == -2 and inside.distance() == 0 and inside.margin() == -1.5
    beside = contact_oracle.exact("sphere_capsule", (0, 1, 0), 0, (0, 0, 0), (1, 1, 1), 0)
    assert beside.distance2 == Fraction(2, 3)
    cut = contact_oracle.exact("triangle_triangle", ((0, 0, 0), (4, 0, 0), (0, 4, 0)), ((1, 1, -1), (1, 1, 2), (-1, -1, 5)))
    assert cut.distance2 == 0 and cut.depth2 == 1 and cut.distance() == cut.value() == -1 and not cut.degenerate
    several = contact_oracle.exact("sphere_sphere", np.zeros((2, 3)), 1, (1, 1, 0), [1, 2])
    assert [answer.reach for answer in several] == [2, 3]
    cast = contact_oracle.exact("cast_sphere", (0, 0, 0), (2, 0, 0), 5, (6, 0, 0), 1)
    assert cast.hit and cast.t == (3, Fraction(1, 4)) and cast.distance2 is None
    assert contact_oracle.exact("cast_sphere", (0, 0, 0), (2, 0, 0), 2, (6, 0, 0), 1).t is None


@pytest.mark.parametrize("pair", [pair for pair in PAIRS if PAIRS[pair].numbers == "distance"])
def test_values_are_those_of_the_answers(pair):
    for answer in contact_oracle.generate(pair, "generic", 20, seed=2).exact():
        if answer.hit and not (answer.degenerate and pair != "sphere_cube"):
            assert float(answer.value(400)) == float(answer.expect["value"])


def test_questions_are_explained_however_they_are_given():
    line = '{"a":{"center":[0,0,0],"radius":0.5},"b":{"center":[1,1e-9,0],"radius":0.5},"alarm":0,"contact":0}'
    text = contact_oracle.explain(line)
    assert "MISS" in text and "D > reach^2" in text
    assert contact_oracle.explain("sphere_sphere", (0, 0, 0), 0.5, (1, 1e-9, 0), 0.5) == text
    assert contact_oracle.explain(json.loads(line)) == text
    assert contact_oracle.explain(Question.from_json(line)) == text
    assert contact_oracle.explain(Question.from_json(line).as_questions()) == text
    two = contact_oracle.explain("sphere_sphere", (0, 0, 0), 0.5, [(1, 0, 0), (2, 0, 0)], 0.5)
    assert two.count("sphere_sphere ") == 2
    with pytest.raises(InputError, match="a.radius"):
        contact_oracle.explain(line.replace("0.5", "-0.5", 1))
    with pytest.raises(InputError, match="b.size"):
        contact_oracle.explain(line.replace('"radius":0.5},"al', '"size":0.5},"al'))
    with pytest.raises(TypeError):
        contact_oracle.explain(line, 1)


BALL = {"center": [0, 0, 0], "radius": 1}


@pytest.mark.parametrize("question, words", [
    ({"a": BALL}, "b: must be a sphere, with center, radius, got None"), ({"b": BALL}, "a: must be a sphere"), ({"a": 5, "b": BALL}, "a: must be a sphere"),
    ({"a": {"min": [0, 0, 0]}, "b": BALL}, "a.max: is missing"), ({"a": {"center": [0, 0, 0]}, "b": BALL}, "a.radius: is missing"),
    ({"a": {**BALL, "size": 1}, "b": BALL}, "a.size: is no part of a sphere"), ({"a": {**BALL, "radius": None}, "b": BALL}, "a.radius: must be numbers, got None"),
    ({"a": {**BALL, "radius": 10**400}, "b": BALL}, "a.radius: must be numbers"), ({"a": BALL, "b": BALL, "alarm": "wide"}, "alarm: must be numbers, got 'wide'"),
    ({"a": {**BALL, "center": [0, 0]}, "b": BALL}, "a.center: must be numbers of the shape .3., got .0, 0."),
    ({"a": {**BALL, "radius": [1]}, "b": BALL}, "a.radius: must be one number"), ({"a": BALL, "b": BALL, "alarm": [1]}, "alarm: must be one number"),
    ({"a": {**BALL, "radius": True}, "b": BALL}, "a.radius: must be numbers, got True"), ({"a": {**BALL, "radius": "1.5"}, "b": BALL}, "a.radius: must be numbers"),
    ({"pair": "sphere_hull", "a": BALL, "b": {"vertices": [[0, 0, 0], [1, 1]], "radius": 0}}, "b.vertices: must be numbers of the shape .V, 3., V from 1 to 64"),
    ({"pair": "sphere_hull", "a": BALL, "b": {"vertices": [], "radius": 0}}, "b.vertices: must be numbers of the shape"),
    ({"pair": ["sphere_sphere"], "a": BALL, "b": BALL}, "pair: must be one of"), ({"a": BALL, "b": BALL, "scalar": "half"}, "scalar: must be binary64 or binary32"),
    ("{", "question: cannot be read: "), (None, "question: must be a line or a dict, got None")])
def test_what_is_no_question_is_named(question, words):
    for read in (contact_oracle.exact, contact_oracle.gradient, Question.from_json, *([contact_oracle.explain] if question != "{" else [])):
        with pytest.raises(InputError, match=words):
            read(question)


def test_a_line_that_is_nested_too_deep_is_refused():
    for read in (contact_oracle.exact, contact_oracle.explain, Question.from_json):
        with pytest.raises(InputError):
            read('{"a":' * 100_000)


def test_what_is_told_of_one_convention_alone_takes_no_other():
    arguments = ("sphere_sphere", (0, 0, 0), 1, (1, 0, 0), 1)
    for ask in (contact_oracle.exact, contact_oracle.explain, contact_oracle.gradient):
        assert ask(*arguments, points="nearest_surface")
        with pytest.raises(InputError, match="points: must be nearest_surface, got 'center'"):
            ask(*arguments, points="center")
    assert contact_oracle.hits(*arguments, points="center")
    with pytest.raises(InputError, match="points: must be one of nearest_surface"):
        contact_oracle.hits(*arguments, points="middle")


def test_a_question_is_a_line_and_back():
    question = Question("sphere_sphere", Sphere((0.0, 0.1, 5e-324), 1.0), Sphere((1.0, float("inf"), float("nan")), 2.0), 0.5)
    assert '"Infinity","NaN"' in str(question)
    assert str(Question.from_json(str(question))) == str(question)
    for pair in PAIRS:
        for one in contact_oracle.generate(pair, "generic", 3, seed=1, scalar="binary32"):
            assert Question.from_json(str(one)) == one
            assert one.answer().hit == one.exact().hit


def test_generated_questions_are_arrays():
    questions = contact_oracle.generate("sphere_capsule", "generic", 10, seed=1)
    assert questions.pair == "sphere_capsule" and len(questions) == 10 and questions.family == "generic"
    assert list(questions.keys()) == ["center1", "radius1", "start2", "end2", "radius2", "alarm", "contact"]
    assert questions.start2 is questions["start2"] and questions.start2.shape == (10, 3)
    assert (contact_oracle.sphere_capsule(**questions).hit == questions.answer().hit).all()
    assert len(questions[2:5]) == 3 and (questions[[7]].radius1 == questions.radius1[7]).all()
    assert questions[-1] == list(questions)[9]
    with pytest.raises(IndexError):
        questions[10]
    with pytest.raises(AttributeError, match="have no 'min1'"):
        questions.min1
    later = contact_oracle.generate("sphere_capsule", "generic", 5, seed=1, first=5)
    assert (later.center1 == questions.center1[5:]).all()
    assert contact_oracle.generate("cube_cube", "generic", 1, scalar="binary32").min1.dtype == np.float32
    assert "sphere_capsule, binary64, family generic" in repr(questions)
    for wrong in (dict(pair="x"), dict(family="x"), dict(scalar="x")):
        with pytest.raises(InputError):
            contact_oracle.generate(**{**dict(pair="cube_cube", family="generic", count=1), **wrong})
    for name, number in (("count", -1), ("count", 2.5), ("seed", -1), ("seed", 2**64), ("first", "1")):
        with pytest.raises(InputError, match=f"{name}: must be a whole number from 0 to"):
            contact_oracle.generate(**{**dict(pair="cube_cube", family="generic", count=1), name: number})
    assert len(contact_oracle.generate("cube_cube", "generic", np.int64(3), np.uint8(1))) == 3
    last = contact_oracle.generate("cube_cube", "generic", 1, first=2**64 - 1)
    assert (last.min1 != contact_oracle.generate("cube_cube", "generic", 1, first=0).min1).any()
    with pytest.raises(InputError, match="first: is too large"):
        contact_oracle.generate("cube_cube", "generic", 2, first=2**64 - 1)


def test_questions_of_ones_own():
    questions = Questions("sphere_sphere", dict(center1=np.zeros((2, 3)), radius1=1, center2=(1, 0, 0), radius2=1))
    assert len(questions) == 2 and questions.radius2.shape == (2,) and questions.answer().value.tolist() == [-1, -1]
    with pytest.raises(InputError, match="radius2: is missing"):
        Questions("sphere_sphere", dict(center1=np.zeros((2, 3)), radius1=1, center2=(1, 0, 0)))
    with pytest.raises(InputError, match="min1: is no argument of sphere_sphere"):
        Questions("sphere_sphere", dict(center1=np.zeros((2, 3)), radius1=1, center2=(1, 0, 0), radius2=1, min1=0))
    pytest.importorskip("pandas")
    assert list(questions.to_dataframe())[:4] == ["center1[0]", "center1[1]", "center1[2]", "radius1"]


@pytest.mark.parametrize("ending", ["jsonl", "npz", "h5"])
@pytest.mark.parametrize("scalar", ["binary64", "binary32"])
def test_a_dataset_is_written_and_read(tmp_path, ending, scalar):
    questions = contact_oracle.generate("capsule_capsule", "generic", 20, seed=4, scalar=scalar)
    path = tmp_path / f"mine.{ending}"
    contact_oracle.write_dataset(path, questions)
    dataset = contact_oracle.read_dataset(path)
    assert dataset.scalar == scalar and dataset.header["count"] == 20 and len(dataset) == 20
    for name in questions.keys():
        assert dataset[name].tobytes() == questions[name].tobytes()
    right = questions.answer()
    assert (dataset.expect.hit == right.hit).all() and dataset.expect.value.tobytes() == right.value.tobytes()
    assert dataset.expect.hit.dtype == bool and "exact/reach" in dataset.columns
    single = list(questions)[:2]
    contact_oracle.write_dataset(path, single, family="mine")
    assert contact_oracle.read_dataset(path).header["family"] == "mine"


@pytest.mark.parametrize("ending", ["jsonl", "npz", "h5"])
def test_what_no_reader_takes_is_not_written(tmp_path, ending):
    path = tmp_path / f"mine.{ending}"
    question = contact_oracle.generate("sphere_sphere", "generic", 1)[0]
    with pytest.raises(InputError, match="row 1: the same question is written already"):
        contact_oracle.write_dataset(path, [question, question])
    with pytest.raises(InputError, match="a family has a name"):
        contact_oracle.write_dataset(path, question, family="")
    assert not list(tmp_path.iterdir())


def test_a_file_may_have_any_name(tmp_path):
    path = os.fsdecode(os.fsencode(tmp_path) + b"/\xff.jsonl")
    contact_oracle.write_dataset(path, contact_oracle.generate("sphere_sphere", "generic", 3))
    assert len(contact_oracle.read_dataset(path)) == 3
    with pytest.raises(InputError, match="datasets: has a name that no report can state"):
        contact_oracle.certify(lambda questions: questions.answer(), "sphere_sphere", datasets=path)
    with pytest.raises(InputError, match="no such file"):
        contact_oracle.read_dataset(path + "x")


@pytest.mark.parametrize("pair", PAIRS)
def test_a_dataset_has_every_column_of_the_file(tmp_path, pair):
    contact_oracle.write_dataset(tmp_path / "mine.npz", contact_oracle.generate(pair, "generic", 60, seed=4))
    columns = contact_oracle.read_dataset(tmp_path / "mine.npz").columns
    with np.load(tmp_path / "mine.npz") as file:
        named = {name for name in file.files if name.startswith(("exact/", "expect/"))}
        for name in named:
            np.testing.assert_array_equal(columns[name], file[name], name)
    # Where one pair of points alone can be nearest, the file does not say so.
    assert {name for name in columns if name.startswith(("exact/", "expect/"))} - named <= {"expect/unique"}


def test_golden_files_are_read(golden):
    dataset = contact_oracle.read_dataset(golden / "sphere_sphere" / "touching.jsonl")
    assert (dataset.answer().hit == dataset.expect.hit).all()
    invalid = contact_oracle.read_dataset(golden / "sphere_sphere" / "invalid.jsonl")
    assert invalid.expect is None


def test_a_bad_file_is_named(tmp_path):
    path = tmp_path / "bad.jsonl"
    path.write_text("{}\n")
    with pytest.raises(InputError, match="bad.jsonl"):
        contact_oracle.read_dataset(path)
    with pytest.raises(InputError, match="missing.jsonl"):
        contact_oracle.read_dataset(tmp_path / "missing.jsonl")
