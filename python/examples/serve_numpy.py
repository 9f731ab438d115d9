"""A script that is an engine: contact-oracle certify --engine-command "python3 serve_numpy.py" """
import numpy as np

import contact_oracle


def spheres(questions):
    delta = questions.center2 - questions.center1
    distance = np.sqrt((delta * delta).sum(axis=1))
    with np.errstate(invalid="ignore"):
        normal = delta / distance[:, np.newaxis]
    radii = questions.radius1 + questions.radius2
    return {"hit": distance <= radii + questions.alarm, "normal": normal, "point1": questions.center1 + questions.radius1[:, np.newaxis] * normal,
            "point2": questions.center2 - questions.radius2[:, np.newaxis] * normal, "value": distance - radii - questions.contact}


contact_oracle.serve({"sphere_sphere": spheres}, name="numpy", version="1")
