"""Engines that the tests judge."""
import os

import numpy as np


def right(questions):
    return questions.answer()


def plain_spheres(questions):
    """The plain formula in the scalar of the questions."""
    delta = questions.center2 - questions.center1
    distance = np.sqrt((delta * delta).sum(axis=1))
    with np.errstate(invalid="ignore"):
        normal = delta / distance[:, np.newaxis]
    radii = questions.radius1 + questions.radius2
    return {"hit": distance <= radii + questions.alarm, "normal": normal, "point1": questions.center1 + questions.radius1[:, np.newaxis] * normal,
            "point2": questions.center2 - questions.radius2[:, np.newaxis] * normal, "value": distance - radii - questions.contact}


def plain_spheres_or_first_axis(questions):
    """The same, with a normal where the centres coincide."""
    answers = plain_spheres(questions)
    coincident = (questions.center1 == questions.center2).all(axis=1)
    normal = np.where(coincident[:, np.newaxis], np.array((1.0, 0.0, 0.0), answers["normal"].dtype), answers["normal"])
    return answers | {"normal": normal, "point1": questions.center1 + questions.radius1[:, np.newaxis] * normal,
                      "point2": questions.center2 - questions.radius2[:, np.newaxis] * normal}


def strict_spheres(questions):
    """Touching is a miss."""
    answers = plain_spheres_or_first_axis(questions)
    delta = questions.center2 - questions.center1
    answers["hit"] = np.sqrt((delta * delta).sum(axis=1)) < questions.radius1 + questions.radius2 + questions.alarm
    return answers


def reversed_normal(questions):
    answers = plain_spheres(questions)
    answers["normal"] = -answers["normal"]
    return answers


def twice_the_tolerance_off(questions):
    """Of a tolerance of 1e-9."""
    answers = plain_spheres_or_first_axis(questions)
    answers["value"] = answers["value"] + 2e-9
    return answers


def forgets_a_radius(questions):
    answers = plain_spheres_or_first_axis(questions)
    answers["hit"] &= answers["value"] + questions.contact + questions.radius2 <= questions.alarm
    return answers


def dies(questions):
    os._exit(7)


def hangs(questions):
    import time

    time.sleep(3600)


def raises(questions):
    raise KeyError("no such shape")
