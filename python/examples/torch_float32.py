"""Spheres in PyTorch, in single precision on the processor: judged in the scalar that it computes in.

    python3 torch_float32.py
"""
import torch

import contact_oracle


def spheres(questions):
    center1, radius1, center2, radius2, alarm, contact = (torch.from_numpy(array) for array in dict(**questions).values())
    delta = center2 - center1
    distance = torch.linalg.vector_norm(delta, dim=1)
    normal = delta / distance[:, None]
    radii = radius1 + radius2
    return {"hit": distance <= radii + alarm, "normal": normal, "point1": center1 + radius1[:, None] * normal,
            "point2": center2 - radius2[:, None] * normal, "value": distance - radii - contact}


if __name__ == "__main__":
    report = contact_oracle.certify(spheres, "sphere_sphere", ["generic", "far_from_origin"], scalar="binary32", seed=1,
                                    name="torch", version=torch.__version__.replace("+", "-"))
    print(report)
    print("Fit for everyday numbers from", report.fitness["everyday"]["needs"])
