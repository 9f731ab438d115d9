"""The functions of the pairs: right answers, every kind of array, and refusals that name the place."""
import json
import os
import subprocess
import sys
import threading
import time
import tracemalloc
import warnings

import every_example
import numpy as np
import pytest

import contact_oracle
from contact_oracle import InputError, _core
from contact_oracle.pairs import PAIRS

THIRD = 1 / 3

# Checked by hand: docs/specification.md has most of them.
BY_HAND = {
    "sphere_sphere": (((0, 0, 0), 1.5, (1, 2, 2), 1.5), dict(contact=0.25), ((THIRD, 2 * THIRD, 2 * THIRD), (0.5, 1, 1), (0.5, 1, 1), -0.25)),
    "rigid_sphere_rigid_sphere": (((0, 0, 0), 1, (0, 0, 4), 2), dict(alarm=1), ((0, 0, 1), (0, 0, 1), (0, 0, 2), 1)),
    "sphere_rigid_sphere": (((1, 0, 0), 1, (0, 0, 0), 1), {}, ((-1, 0, 0), (0, 0, 0), (1, 0, 0), -1)),
    "cube_cube": (((0, 0, 0), (1, 1, 1), (1, 0, 0), (2, 1, 1)), {}, None),
    "sphere_cube": (((0.25, 0.5, 0.5), 1.5, (0, 0, 0), (1, 1, 1)), dict(contact=0.25), ((1, 0, 0), (1.75, 0.5, 0.5), (0, 0.5, 0.5), -2)),
    "sphere_capsule": (((0, 3, 0), 1, (-5, 0, 0), (5, 0, 0), 2), {}, ((0, -1, 0), (0, 2, 0), (0, 2, 0), 0)),
    "capsule_capsule": (((0, 0, 0), (1, 0, 0), 0.25, (0.5, 0.5, 0), (2, 0.5, 0), 0.25), dict(contact=0.125),
                        ((0, 1, 0), (0.75, 0.25, 0), (0.75, 0.25, 0), -0.125)),
    "sphere_triangle": (((2, -3, 4), 5, ((0, 0, 0), (4, 0, 0), (0, 4, 0))), {}, ((0, 0.6, -0.8), (2, 0, 0), (2, 0, 0), 0)),
    "ray_sphere": (((0, 0, 0), (1, 0, 0), 1, (1.5, 0, 0), 0.75), {}, ((1, 0, 0), (1, 0, 0), (0.75, 0, 0), -0.25)),
    "sphere_plane": (((2, 3, 5), 6, (1, 2, 2), 3), {}, ((-THIRD, -2 * THIRD, -2 * THIRD), (0, -1, 1), (THIRD, -THIRD, 5 * THIRD), -1)),
    "capsule_plane": (((0, 0, 3), (0, 0, 1), 1, (0, 0, 2), 0), {}, ((0, 0, -1), (0, 0, 0), (0, 0, 0), 0)),
    "ray_triangle": (((1, 1, 2), (0, 0, -1), 4, ((0, 0, 0), (4, 0, 0), (0, 4, 0))), {}, ((0, 0, -1), (1, 1, 0), (1, 1, 0), 0)),
    "triangle_line": ((((0, 0, 0), (4, 0, 0), (0, 4, 0)), (1, 1, 2), (1, 1, -2)), {}, ((0, 0, 1), (1, 1, 0), (1, 1, 0), 0)),
    "cast_sphere": (((0, 0, 0), (2, 0, 0), 5, (6, 0, 0), 1), dict(alarm=9, contact=1), ((-1, 0, 0), (5, 0, 0), (5, 0, 0), 2.5)),
    "cast_cube": (((0, 0, 0), (1, 1, 0), 9, (2, 0, -1), (3, 4, 1)), {}, ((-1, 0, 0), (2, 2, 0), (2, 2, 0), 2)),
    "cast_capsule": (((0, 3, 0), (0, -2, 0), 1, (-4, 0, 0), (4, 0, 0), 2), {}, ((0, 1, 0), (0, 2, 0), (0, 2, 0), 0.5)),
    "cast_triangle": (((1, 1, 2), (0, 0, -4), 1, ((0, 0, 0), (0, 4, 0), (4, 0, 0))), {}, ((0, 0, 1), (1, 1, 0), (1, 1, 0), 0.5)),
    "cast_plane": (((5, 6, 7), (0, 0, -1), 4, (0, 0, 2), 8), {}, ((0, 0, 1), (5, 6, 4), (5, 6, 4), 3)),
    # A quarter turn about z; boxes that overlap are parted along x.
    "obb_obb": (((0, 0, 0), (0, 0, 0, 1), (1, 1, 1), (2.5, 0, 0), (0, 0, 1, 1), (1, 2, 1)), dict(contact=0.25), ((1, 0, 0), (1, 0, 0), (0.5, 0, 0), -0.75)),
    "sphere_obb": (((0, 0, 3), 2, (0, 0, 0), (0, 0, 0, 2), (1, 1, 1)), {}, ((0, 0, -1), (0, 0, 1), (0, 0, 1), 0)),
    "capsule_cube": (((0, 3, 0), (0, 2, 0), 0.5, (-1, -1, -1), (1, 1, 1)), dict(alarm=1), ((0, -1, 0), (0, 1.5, 0), (0, 1, 0), 0.5)),
    "capsule_obb": (((0, 3, 0), (0, 2, 0), 0.5, (0, 0, 0), (0, 0, 1, 1), (1, 2, 3)), dict(alarm=1), ((0, -1, 0), (0, 1.5, 0), (0, 1, 0), 0.5)),
    "capsule_triangle": (((1, 1, 3), (1, 1, 1), 0.25, ((0, 0, 0), (4, 0, 0), (0, 4, 0))), dict(alarm=1), ((0, 0, -1), (1, 1, 0.75), (1, 1, 0), 0.75)),
    "cube_obb": (((0, 0, 0), (1, 1, 1), (3, 0.5, 0.5), (0, 0, 0, 1), (1, 0.25, 0.25)), dict(alarm=1), ((1, 0, 0), (1, 0.5, 0.5), (2, 0.5, 0.5), 1)),
    "cube_triangle": (((0, 0, 0), (1, 1, 1), ((2, 0.5, 0.5), (3, 0, 0), (3, 1, 0))), dict(alarm=1), ((1, 0, 0), (1, 0.5, 0.5), (2, 0.5, 0.5), 1)),
    # A third of a turn: x becomes y, y becomes z, z becomes x.
    "obb_triangle": (((0, 0, 0), (1, 1, 1, 1), (1, 2, 3), ((0, 0, 3), (1, 0, 4), (0, 1, 4))), dict(alarm=1), ((0, 0, 1), (0, 0, 2), (0, 0, 3), 1)),
    "triangle_triangle": ((((0, 0, 0), (4, 0, 0), (0, 4, 0)), ((1, 1, 1), (5, 1, 3), (1, 5, 3))), dict(alarm=1), ((0, 0, 1), (1, 1, 0), (1, 1, 1), 1)),
    "cube_plane": (((0, 0, 1), (1, 1, 2), (0, 0, 2), 1), dict(alarm=1), ((0, 0, -1), (0.5, 0.5, 1), (0.5, 0.5, 0.5), 0.5)),
    "obb_plane": (((0, 0, 2), (1, 1, 1, 1), (1, 2, 3), (0, 0, 1), 1), {}, ((0, 0, -1), (0, 0, 0), (0, 0, 1), -1)),
    "triangle_plane": ((((0, 0, 1), (4, 0, 3), (0, 4, 3)), (0, 0, 2), 0), dict(alarm=1), ((0, 0, -1), (0, 0, 1), (0, 0, 0), 1)),
    "sphere_hull": (((0, 0, 3), 1, ((1, 1, 0), (1, -1, 0), (-1, 1, 0), (-1, -1, 0), (0, 0, -1)), 0.5), dict(alarm=2),
                    ((0, 0, -1), (0, 0, 2), (0, 0, 0.5), 1.5)),
    "capsule_hull": (((0, 0, 3), (0, 0, 2), 0.25, ((0, 0, 0),), 0.5), dict(alarm=2), ((0, 0, -1), (0, 0, 1.75), (0, 0, 0.5), 1.25)),
    "cube_hull": (((0, 0, 0), (1, 1, 1), ((2, 0.5, 0.5), (3, 0, 0), (3, 1, 0)), 0.25), dict(alarm=1), ((1, 0, 0), (1, 0.5, 0.5), (1.75, 0.5, 0.5), 0.75)),
    "obb_hull": (((0, 0, 0), (1, 1, 1, 1), (1, 2, 3), ((0, 0, 3), (1, 0, 4), (0, 1, 4)), 0.5), dict(alarm=1), ((0, 0, 1), (0, 0, 2), (0, 0, 2.5), 0.5)),
    "triangle_hull": ((((0, 0, 0), (4, 0, 0), (0, 4, 0)), ((1, 1, 1), (5, 1, 3), (1, 5, 3), (2, 2, 3), (1, 1, 1)), 0), dict(alarm=1),
                      ((0, 0, 1), (1, 1, 0), (1, 1, 1), 1)),
    # The corners of a cube, and a tetrahedron whose tip is in it.
    "hull_hull": (((*((x, y, z) for x in (0, 2) for y in (0, 2) for z in (0, 2)), (1, 1, 1)), 0.25,
                   ((1.5, 1, 1), (5, 0, 0), (5, 2, 0), (5, 1, 3)), 0), {}, ((1, 0, 0), (2.25, 1, 1), (1.5, 1, 1), -0.75)),
    "hull_plane": ((((0, 0, 1), (4, 0, 3), (0, 4, 3), (1, 1, 2)), 0.5, (0, 0, 2), 0), dict(alarm=1), ((0, 0, -1), (0, 0, 0.5), (0, 0, 0), 0.5)),
}


def function(pair):
    return getattr(contact_oracle, pair)


def test_every_pair_has_an_answer_by_hand():
    assert set(BY_HAND) == set(PAIRS)


@pytest.mark.parametrize("pair", BY_HAND)
def test_a_known_answer_by_hand(pair):
    arguments, distances, right = BY_HAND[pair]
    contact = function(pair)(*arguments, **distances)
    assert contact.hit
    if right is None:
        assert contact.normal is None and contact.value is None
        return
    for name, number in zip(("normal", "point1", "point2", "value"), right):
        np.testing.assert_allclose(getattr(contact, name), number, rtol=2e-16, atol=0, err_msg=name)
        assert np.shape(getattr(contact, name)) == np.shape(number)


@pytest.mark.parametrize("scalar", ["binary64", "binary32"])
@pytest.mark.parametrize("pair", PAIRS)
def test_answers_have_the_bits_of_the_golden_cases(pair, scalar):
    for family in contact_oracle.families(pair):
        if family["outside_domain"]:
            continue
        questions = contact_oracle.generate(pair, family["name"], every_example.of(40), seed=7, scalar=scalar)
        answers = questions.answer()
        asked = questions.asked()
        ids = questions.id
        lines = _core.cases(pair, asked.columns, asked.alarm, asked.contact, scalar)
        for row, line in enumerate(lines):
            case = json.loads(line)
            expect = case["expect"]
            # What the core has read is what the arrays have.
            assert case["id"] == ids[row] and contact_oracle.Question.from_json({**case, "pair": pair, "scalar": scalar}) == questions[row]
            assert answers.hit[row] == expect["hit"]
            if PAIRS[pair].numbers == "none":
                continue
            assert answers.value.dtype == (np.float32 if scalar == "binary32" else np.float64)
            for name in ("normal", "point1", "point2", "value"):
                found = np.asarray(getattr(answers, name)[row], float)
                right = np.array([float(part) for part in np.ravel(expect[name])]).reshape(found.shape) if expect["hit"] else np.full(found.shape, np.nan)
                assert found.tobytes() == right.tobytes() or np.isnan(found).all() and not expect["hit"], (line, name, found)
            if expect["hit"]:
                assert answers.degenerate[row] == expect["degenerate"]
                assert answers.unique[row] == expect.get("unique", True)


def test_hits_are_those_of_contacts():
    questions = contact_oracle.generate("sphere_sphere", "near_touching", 500, seed=3)
    arguments = dict(**questions)
    assert (contact_oracle.hits("sphere_sphere", **arguments) == questions.answer().hit).all()
    assert contact_oracle.hits("cube_cube", (0, 0, 0), (1, 1, 1), (3, 0, 0), (4, 1, 1), alarm=2)


def test_arguments_are_broadcast():
    centers = np.zeros((2, 4, 3))
    centers[..., 0] = np.arange(8).reshape(2, 4)
    contact = contact_oracle.sphere_sphere(centers, np.ones(4), (0, 0, 0), 1, alarm=[[0], [3]])
    assert contact.hit.shape == (2, 4) and contact.normal.shape == (2, 4, 3)
    assert contact.hit.tolist() == [[True, True, True, False], [True, True, False, False]]
    assert np.isnan(contact.value[0, 3]) and contact[1, 0].value == 2
    assert contact[0].hit.shape == (4,)


def test_a_single_question_has_single_answers():
    contact = contact_oracle.sphere_sphere((0, 0, 0), 1, (1, 0, 0), 1)
    assert isinstance(contact.hit, np.bool_) and isinstance(contact.value, np.float64) and contact.normal.shape == (3,)
    assert contact
    with pytest.raises(TypeError, match="no length"):
        len(contact)


def test_several_contacts_are_no_truth_value():
    contact = contact_oracle.sphere_sphere(np.zeros((2, 3)), 1, (1, 0, 0), 1)
    assert len(contact) == 2 and len(list(contact)) == 2
    with pytest.raises(ValueError, match="hit.any"):
        bool(contact)


def test_no_question_has_no_answer():
    contact = contact_oracle.sphere_capsule(np.zeros((0, 3)), np.zeros(0), np.zeros((0, 3)), np.zeros((0, 3)), np.zeros(0))
    assert contact.hit.shape == (0,) and contact.normal.shape == (0, 3) and len(contact) == 0


@pytest.mark.parametrize("change", [lambda a: np.asfortranarray(a), lambda a: np.repeat(a, 2, axis=0)[::2], lambda a: a[::-1].copy()[::-1],
                                    lambda a: a.astype(">f8"), lambda a: a.tolist()])
def test_any_order_of_memory_gives_the_same_answers(change):
    questions = contact_oracle.generate("sphere_sphere", "generic", 50, seed=1)
    changed = {name: change(array) for name, array in dict(**questions).items()}
    answers = contact_oracle.sphere_sphere(**changed)
    assert answers.value.tobytes() == questions.answer().value.tobytes()


def test_arrays_that_cannot_be_written_are_read():
    centers = np.zeros((3, 3))
    centers.flags.writeable = False
    assert contact_oracle.sphere_sphere(centers, 1, centers, 1).degenerate.all()


def test_a_column_of_doubles_is_not_copied():
    from contact_oracle.asked import asked

    centers, radii = np.zeros((5, 3)), np.ones(5)
    question = asked(PAIRS["sphere_sphere"], dict(center1=centers, radius1=radii, center2=centers, radius2=1.0, alarm=0, contact=0))
    assert np.shares_memory(question.columns[0], centers) and np.shares_memory(question.columns[1], radii)
    assert question.columns[3].strides == (0,)


@pytest.mark.parametrize("number", [np.float64, np.float32])
def test_many_questions_need_little_more_memory_than_their_answers(number):
    count = 300_000
    centers = np.random.default_rng(1).uniform(-2, 2, (count, 3)).astype(number)
    tracemalloc.start()
    contact = contact_oracle.sphere_sphere(centers, number(0.5), np.zeros(3, number), number(1))
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 1.05 * sum(array.nbytes for array in vars(contact).values())


def test_single_precision_is_answered_in_single_precision():
    centers = np.array([[0, 0, 0]], np.float32)
    contact = contact_oracle.sphere_sphere(centers, np.float32(1), centers + np.float32(0.3), np.float32(1), alarm=0)
    assert contact.value.dtype == contact.normal.dtype == np.float32
    doubles = contact_oracle.sphere_sphere(centers, 1.0, centers + np.float32(0.3), np.float64(1))
    assert doubles.value.dtype == np.float64
    assert contact.value[0] == np.float32(doubles.value[0])


def test_single_precision_is_rounded_once():
    # The value is 1 + 3 * 2^-24 less 2^-80, and in double precision it is not less: halfway, and to even would be up.
    value = contact_oracle.sphere_sphere(np.float32([-(2.0**-24), 0, 0]), 0, np.float32([1 + 2.0**-23, 0, 0]), 0, alarm=2, contact=2.0**-80).value
    assert value == np.float32(1 + 2.0**-23) and np.float32(np.float64(1 + 3 * 2.0**-24)) == 1 + 2.0**-22
    # y of the normal is 3 * 2^-150 less 2^-447 or so, halfway between subnormal numbers in double precision.
    normal = contact_oracle.sphere_sphere(np.zeros(3, np.float32), 1, np.float32([2, 3 * 2.0**-149, 0]), 1, alarm=1).normal
    assert normal.tolist() == [1, 2.0**-149, 0] and np.float32(3 * 2.0**-150) == 2.0**-148
    # Too large for single precision, not for double precision.
    far = np.finfo(np.float32).max
    contact = contact_oracle.sphere_sphere(np.float32([-far, 0, 0]), 0, np.float32([far, 0, 0]), far, alarm=far)
    assert contact.hit and contact.value == far and contact_oracle.sphere_sphere(np.float32([far, 0, 0]), far, np.float32([far, 0, 0]), far).point1[0] == np.inf


def test_a_number_without_a_format_follows_the_arrays_where_it_can():
    centers = np.zeros((2, 3), np.float32)
    assert contact_oracle.sphere_sphere(centers, 0.5, (1, 0, 0), 0.5).value.dtype == np.float32
    with pytest.raises(InputError, match="radius1: is no binary32 number") as caught:
        contact_oracle.sphere_sphere(centers, 0.1, centers, 0.5)
    assert caught.value.argument == "radius1" and caught.value.value == 0.1
    assert contact_oracle.sphere_sphere(centers.astype(int), 0.1, centers, 0.5).value.dtype == np.float64


def test_integers_are_read_where_they_are_doubles():
    assert contact_oracle.sphere_sphere(np.zeros((1, 3), int), np.array([2]), np.array([[3, 0, 0]]), np.array([1], np.uint8)).value[0] == 0
    with pytest.raises(InputError, match=r"center1\[1, 2\]: is no binary64 number, got 9007199254740993"):
        contact_oracle.sphere_sphere([[0, 0, 0], [0, 0, 2**53 + 1]], 1, (0, 0, 0), 1)
    with pytest.raises(InputError, match="is no binary64 number"):
        contact_oracle.sphere_sphere((2**63 - 1, 0, 0), 1, (0, 0, 0), 1)


@pytest.mark.parametrize("center", [np.zeros(3, np.float16), np.zeros(3, complex), np.array([None] * 3), ["a", "b", "c"], np.zeros(3, bool),
                                    np.zeros(3, np.longdouble), np.zeros(3, "datetime64[s]"), (2**70, 0, 0), [[0, 0, 0], [0, 0]], None])
def test_what_is_no_number_is_refused(center):
    with pytest.raises(InputError, match="center1"):
        contact_oracle.sphere_sphere(center, 1, (0, 0, 0), 1)


def test_masked_numbers_are_refused():
    with pytest.raises(InputError, match="center1: must have no masked"):
        contact_oracle.sphere_sphere(np.ma.array(np.zeros(3), mask=[0, 1, 0]), 1, (0, 0, 0), 1)


@pytest.mark.parametrize("arguments, message", [
    (((0, 0), 1, (0, 0, 0), 1), r"center1: must have the shape \(..., 3\), got shape \(2,\)"),
    ((5, 1, (0, 0, 0), 1), r"center1: must have the shape"),
    ((np.zeros((2, 3)), np.ones(3), (0, 0, 0), 1), r"do not go together: center1 \(2,\), radius1 \(3,\)"),
    ((np.zeros((3, 2)), 1, (0, 0, 0), 1), "center1: must have the shape"),
])
def test_wrong_shapes_are_named(arguments, message):
    with pytest.raises(InputError, match=message):
        contact_oracle.sphere_sphere(*arguments)


def test_a_triangle_is_three_points():
    with pytest.raises(InputError, match=r"vertices2: must have the shape \(..., 3, 3\)"):
        contact_oracle.sphere_triangle((0, 0, 0), 1, np.zeros((4, 3)))


NONE = (np.nan, np.nan, np.nan)


def test_a_hull_has_as_many_vertices_as_there_are_before_nan():
    vertices = np.array([[(0, 0, 1), (0, 0, 2), (0, 0, 3)], [(0, 0, 5), (0, 0, 4), NONE], [(0, 0, 7), NONE, NONE]], float)
    contact = contact_oracle.hull_plane(vertices, [0, 1, 2], (0, 0, 1), 0, alarm=9)
    assert contact.value.tolist() == [1, 3, 5]
    assert contact_oracle.hull_plane(vertices[2], 2, (0, 0, 1), 0, alarm=9).value == 5
    assert contact_oracle.hull_plane(vertices[..., ::-1], 0, (1, 0, 0), 0, alarm=9).value.tolist() == [1, 4, 7]
    repeated = np.where(np.isnan(vertices), vertices[:, :1], vertices)
    assert contact_oracle.hull_plane(repeated, [0, 1, 2], (0, 0, 1), 0, alarm=9).value.tolist() == [1, 3, 5]
    questions = contact_oracle.Questions("hull_plane", dict(vertices1=vertices, radius1=[0, 1, 2], normal2=(0, 0, 1), offset2=0))
    for row, question in enumerate(questions):
        assert question.a == contact_oracle.Hull(tuple(map(tuple, vertices[row, :3 - row])), row)
        assert question.as_questions().id[0] == questions.id[row]


def test_hulls_of_any_numbers_of_vertices_become_one_array():
    from contact_oracle.questions import joined

    questions = contact_oracle.generate("hull_hull", "generic", 30, seed=5)
    single = list(questions)
    assert len({len(question.a.vertices) for question in single}) > 1
    assert questions.vertices1.shape == (30, max(len(question.a.vertices) for question in single), 3)
    assert joined(single).id.tolist() == questions.id.tolist() == [question.exact().id for question in single]
    assert all(contact_oracle.Question.from_json(line).exact().id == id for line, id in zip(questions.lines(), questions.id))


@pytest.mark.parametrize("vertices, words", [
    (np.zeros((65, 3)), r"must have the shape \(..., V, 3\), V from 1 to 64, got shape \(65, 3\)"), (np.zeros((0, 3)), "must have the shape"),
    (np.zeros(3), "must have the shape"), (np.zeros((4, 2)), "must have the shape"), ([NONE], r"vertices1: must be from 1 to 64 points, got 0"),
    ([NONE, (0, 0, 0)], r"vertices1\[0, 0\]: must be finite, got nan"), ([(0, 0, 0), (0, np.nan, 0)], r"vertices1\[1, 1\]: must be finite"),
    ([[(0, 0, 0)], [(0, 0, 0), (1, 1, 1)]], "vertices1: cannot be read as an array")])
def test_what_is_no_hull_is_refused(vertices, words):
    with pytest.raises(InputError, match=words):
        contact_oracle.hull_plane(vertices, 1, (0, 0, 1), 0)


def refusal(call, *arguments, **named):
    with pytest.raises(InputError) as caught:
        call(*arguments, **named)
    return caught.value


def test_a_number_outside_the_domain_is_named_as_it_was_given():
    centers = np.zeros((2, 3, 3))
    centers[1, 2, 1] = np.nan
    error = refusal(contact_oracle.sphere_sphere, centers, 1, (0, 0, 0), 1)
    assert (error.argument, error.index, error.field) == ("center1", (1, 2, 1), "a.center[1]") and np.isnan(error.value)
    assert str(error).startswith("center1[1, 2, 1]: ")

    error = refusal(contact_oracle.sphere_sphere, np.zeros((4, 3)), 1, (0, np.inf, 0), 1)
    assert (error.argument, error.index, error.value) == ("center2", (1,), np.inf)

    error = refusal(contact_oracle.sphere_sphere, np.zeros((4, 3)), 1, np.zeros((1, 3)), [[1, 2, -3, 4]])
    assert (error.argument, error.index, error.value) == ("radius2", (0, 2), -3)

    error = refusal(contact_oracle.sphere_sphere, (0, 0, 0), 1, (0, 0, 0), 1, alarm=-1)
    assert (error.argument, error.index, error.field) == ("alarm", (), "alarm")

    error = refusal(contact_oracle.cube_cube, (0, 2, 0), (1, 1, 1), (0, 0, 0), (1, 1, 1))
    assert (error.argument, error.index) == ("min1", (1,)) and "exceed" in error.rule

    error = refusal(contact_oracle.sphere_triangle, (0, 0, 0), 1, [[(0, 0, 0), (1, 0, np.nan), (0, 1, 0)]])
    assert (error.argument, error.index) == ("vertices2", (0, 1, 2))

    assert refusal(contact_oracle.sphere_plane, (0, 0, 0), 1, (0, 0, 0), 1).argument == "normal2"
    assert refusal(contact_oracle.ray_sphere, (0, 0, 0), (0, 0, 0), 1, (0, 0, 0), 1).argument == "direction1"


def test_wrong_words_are_refused():
    with pytest.raises(InputError, match="points: must be one of nearest_surface"):
        contact_oracle.sphere_sphere((0, 0, 0), 1, (0, 0, 0), 1, points="middle")
    with pytest.raises(InputError, match="pair: must be one of sphere_sphere"):
        contact_oracle.hits("sphere_donut", 1)
    with pytest.raises(TypeError, match="radius2"):
        contact_oracle.sphere_sphere((0, 0, 0), 1, (0, 0, 0))
    with pytest.raises(TypeError):
        contact_oracle.sphere_sphere((0, 0, 0), 1, (0, 0, 0), 1, 2)


def test_points_of_other_conventions():
    contact = contact_oracle.sphere_sphere((0, 0, 0), 1.5, (1, 2, 2), 1.5, points="published")
    np.testing.assert_array_equal(contact.point1, (-0.5, -1, -1))
    contact = contact_oracle.sphere_rigid_sphere((0, 0, 0), 1.5, (1, 2, 2), 1.5, points="center")
    np.testing.assert_array_equal(contact.point1, (0, 0, 0))


LONG_CALLS = ["long.answer()", "single.answer()", "contact_oracle.hits('sphere_sphere', **long)", "long.id", "contact_oracle.exact(short)",
              "contact_oracle.gradient(short)", "contact_oracle.write_dataset('interrupted.jsonl', short)", "contact_oracle.generate('hull_hull', 'generic', 9_000_000)",
              "contact_oracle.certify(lambda q: q.answer(), 'sphere_sphere', 'generic', count=9_000_000)"]


def test_ctrl_c_ends_a_long_call_at_once(tmp_path):
    """Each takes a second or far more. A process of its own has the signals, as a terminal sends them."""
    script = f"""
import os, signal, threading, time
import numpy as np
import contact_oracle

def questions(count, number):
    centers = np.random.default_rng(1).uniform(-2, 2, (count, 3)).astype(number)
    return contact_oracle.Questions("sphere_sphere", dict(center1=centers, radius1=1, center2=centers[::-1], radius2=1))

def interrupt():
    time.sleep(0.1)
    sent.append(time.perf_counter())
    os.kill(os.getpid(), signal.SIGINT)

long, single, short, sent = questions(4_000_000, "d"), questions(4_000_000, "f"), questions(300_000, "d"), []
for call in [{", ".join("lambda: " + call for call in LONG_CALLS)}]:
    thread = threading.Thread(target=interrupt)
    thread.start()
    try:
        call()
        thread.join()
        time.sleep(1)
    except KeyboardInterrupt:
        print(time.perf_counter() - sent[-1])
    thread.join()
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    after = dict(zip(LONG_CALLS, map(float, done.stdout.split()), strict=True))
    assert max(after.values()) < 0.8, after
    assert not list(tmp_path.iterdir())


def test_a_call_that_lasts_shows_a_bar_on_a_terminal_alone():
    pty = pytest.importorskip("pty")
    script = """
import os, signal, threading, time
import numpy as np
import contact_oracle

threading.Timer(1.5, os.kill, (os.getpid(), signal.SIGINT)).start()
try:
    contact_oracle.gradient("sphere_sphere", np.zeros((1_000_000, 3)), 1, (1, 2, 2), 1)
except KeyboardInterrupt:
    os.write(2, b"interrupted")
"""
    ours, theirs = pty.openpty()
    piped = subprocess.Popen([sys.executable, "-c", script], stderr=subprocess.PIPE)
    shown = subprocess.Popen([sys.executable, "-c", script], stderr=theirs)
    assert piped.communicate()[1] == b"interrupted" and shown.wait() == 0
    os.close(theirs)
    said = os.read(ours, 1 << 16)
    os.close(ours)
    # The bar is gone before anything else is said.
    assert b"sphere_sphere [" in said and b"of 1000000" in said and said.endswith(b"\r\x1b[Kinterrupted")


class OnlyDlpack:
    """What a library without NumPy's own protocol gives."""

    def __init__(self, array):
        self._array = array

    def __dlpack__(self, *args, **named):
        return self._array.__dlpack__(*args, **named)

    def __dlpack_device__(self):
        return self._array.__dlpack_device__()


def test_arrays_of_other_libraries_are_taken():
    centers = np.zeros((2, 3), np.float32)
    assert contact_oracle.sphere_sphere(OnlyDlpack(centers), 1, OnlyDlpack(centers), 1).value.dtype == np.float32


def questions_in(library, scalar):
    """The same questions and answers in NumPy's arrays and in those of another library."""
    questions = contact_oracle.generate("sphere_sphere", "touching", 40, seed=1, scalar=scalar)
    return questions, {name: library.from_dlpack(array.copy()) for name, array in dict(**questions).items()}


def same(found, right):
    """Whether arrays of another library have the numbers of NumPy's, and its format."""
    found = np.asarray(found)
    return found.dtype == right.dtype and found.shape == right.shape and found.tobytes() == right.tobytes()


@pytest.fixture(params=["torch", "numpy.array_api"])
def library(request):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # NumPy's model of the standard calls itself experimental
        return pytest.importorskip(request.param)


@pytest.mark.parametrize("scalar", ["binary64", "binary32"])
def test_answers_are_arrays_of_the_library_that_asks(library, scalar):
    questions, arguments = questions_in(library, scalar)
    right = questions.answer()
    kind = type(arguments["radius1"])
    contact = contact_oracle.sphere_sphere(**arguments)
    for name, array in vars(contact).items():
        assert type(array) is kind and same(array, getattr(right, name)), name
    assert type(contact_oracle.hits("sphere_sphere", **arguments)) is kind
    assert contact.hit.dtype == library.bool and not np.asarray(contact.hit).all()
    assert len(contact) == 40 and contact._repr_html_() == right._repr_html_()
    for rows in (3, slice(2, 30, 3), np.array([5, 1])):
        assert type(contact[rows].normal) is kind and same(contact[rows].normal, right.normal[rows])
    one = contact_oracle.sphere_sphere(arguments["center2"][0, :], 1, arguments["center2"][0, :], 1)
    assert type(one.hit) is kind and one.hit.shape == () and one.normal.shape == (3,) and bool(one)
    # NumPy's own beside them follow.
    assert type(contact_oracle.sphere_sphere(**{**arguments, "radius1": questions.radius1}).value) is kind
    assert type(contact_oracle.gradient("sphere_sphere", **arguments).value["center1"]) is kind


def test_answers_to_tensors_may_be_chosen_by_tensors():
    torch = pytest.importorskip("torch")
    questions, arguments = questions_in(torch, "binary64")
    contact = contact_oracle.sphere_sphere(**arguments)
    assert torch.equal(contact[contact.hit].value, contact.value[contact.hit])
    pandas = pytest.importorskip("pandas")
    pandas.testing.assert_frame_equal(contact.to_dataframe(), questions.answer().to_dataframe())


def test_tensors_are_not_copied():
    torch = pytest.importorskip("torch")
    from contact_oracle.arrays import in_library, numpy_array

    for number in (torch.float64, torch.float32):
        tensor = torch.arange(5, dtype=number)
        array = numpy_array(tensor)
        assert array.ctypes.data == tensor.data_ptr() == in_library(torch, array).data_ptr()


def test_questions_are_arrays_that_pytorch_takes_without_a_warning():
    torch = pytest.importorskip("torch")
    questions = contact_oracle.Questions("sphere_sphere", dict(center1=np.zeros((3, 3)), radius1=1, center2=(2, 0, 0), radius2=1))
    for array in dict(**questions).values():
        assert torch.from_numpy(array).shape == array.shape


def test_two_libraries_do_not_go_together():
    torch = pytest.importorskip("torch")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        other = pytest.importorskip("numpy.array_api")
    with pytest.raises(InputError, match="arrays of numpy.array_api and of torch do not go together"):
        contact_oracle.sphere_sphere(torch.zeros(3), 1, other.zeros(3), 1)


def test_gradients_of_tensors_are_refused():
    torch = pytest.importorskip("torch")
    centers = torch.zeros((2, 3))
    with pytest.raises(InputError, match="center1: requires a gradient"):
        contact_oracle.sphere_sphere(centers.clone().requires_grad_(), 1, centers, 1)
    with pytest.raises(InputError, match="center1"):
        contact_oracle.sphere_sphere(centers.to(torch.bfloat16), 1, centers, 1)


def test_a_million_questions():
    count = 1_000_000
    centers = np.random.default_rng(1).uniform(-2, 2, (count, 3))
    contact = contact_oracle.sphere_sphere(centers, 0.5, (0, 0, 0), 0.75)
    plain = np.sqrt((centers * centers).sum(axis=1))
    np.testing.assert_allclose(contact.value[contact.hit], plain[contact.hit] - 1.25, atol=1e-15)
    assert 0 < contact.hit.sum() < count


def test_threads_may_ask_at_once():
    questions = contact_oracle.generate("sphere_capsule", "generic", 3000, seed=5)
    right = questions.answer().value.tobytes()
    found = []
    threads = [threading.Thread(target=lambda: found.append(questions.answer().value.tobytes())) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [right] * 8


@pytest.mark.parametrize("name, count", [("contacts", 400_000), ("hits", 400_000), ("ids", 100_000), ("cases", 3000), ("gradients", 1000), ("generate", 200_000)])
def test_other_threads_run_meanwhile(name, count):
    centers = np.random.default_rng(1).uniform(-2, 2, (count, 3))
    asked = contact_oracle.Questions("sphere_sphere", dict(center1=centers, radius1=1, center2=centers[::-1], radius2=1)).asked()
    arguments = ("generic", count, 1) if name == "generate" else (asked.columns, asked.alarm, asked.contact)
    stamps, done = [], threading.Event()

    def stamp():
        while not done.wait(0.001):
            stamps.append(time.perf_counter())

    other = threading.Thread(target=stamp)
    other.start()
    for _ in range(5):  # a busy machine may give the other thread no processor in one of them
        begin = time.perf_counter()
        getattr(_core, name)("sphere_sphere", *arguments)
        end = time.perf_counter()
        # At both ends Python's objects are made.
        if meanwhile := any(begin + 0.1 * (end - begin) < at < begin + 0.8 * (end - begin) for at in stamps):
            break
    done.set()
    other.join()
    assert meanwhile


def test_contacts_are_shown_and_tabulated():
    contact = contact_oracle.sphere_sphere(np.zeros((20, 3)), 1, (1, 0, 0), 1)
    assert "and 10 more" in contact._repr_html_() and "<th>value</th>" in contact._repr_html_()
    assert "<th>hit</th>" in contact[0]._repr_html_()
    pandas = pytest.importorskip("pandas")
    frame = contact.to_dataframe()
    assert isinstance(frame, pandas.DataFrame) and list(frame)[:4] == ["hit", "normal_x", "normal_y", "normal_z"] and len(frame) == 20
    with pytest.raises(AttributeError):
        contact.hit = None
