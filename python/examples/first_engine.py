"""Two spheres in NumPy, as they are often written, and what the judge says of them.

    python3 first_engine.py
"""
import numpy as np

import contact_oracle


def spheres(questions):
    delta = questions.center2 - questions.center1
    distance = np.sqrt((delta * delta).sum(axis=1))
    reach = questions.radius1 + questions.radius2
    return {"hit": distance < reach + questions.alarm, "value": distance - reach - questions.contact}


if __name__ == "__main__":
    report = contact_oracle.certify(spheres, "sphere_sphere", ["generic", "touching"], seed=1)
    print(report.verdict, *report.diagnosis, sep="\n")
    print(contact_oracle.certify(spheres, "sphere_sphere", ["generic", "touching"], seed=1, profile="robotics").verdict)
