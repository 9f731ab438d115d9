"""A verified reference for collision contacts, and an exact oracle that judges the answers of other engines.

One function a pair answers questions, correctly rounded:

>>> import contact_oracle
>>> contact = contact_oracle.sphere_sphere((0, 0, 0), 1.5, (1, 2, 2), 1.5, contact=0.25)
>>> contact.hit, contact.value
(True, -0.25)
>>> contact.point1
array([0.5, 1. , 1. ])

`certify` judges an engine: any function of arrays.
"""
from __future__ import annotations

from . import _core
from .answering import FUNCTIONS as _FUNCTIONS
from .answering import explain, hits
from .contacts import Contacts
from .datasets import Dataset, families, generate, profiles, read_dataset, write_dataset
from .errors import EngineError, InputError, OracleDisagreement
from .exact_answers import Exact, exact
from .gradients import Gradient, GradientFailure, GradientReport, certify_gradient, gradient
from .judging import LawReport, Report, certify, properties
from .questions import Questions
from .serving import serve
from .shapes import Capsule, Cube, Hull, Line, Obb, Plane, Question, Ray, Sphere, Triangle
from .suites import suite

globals().update(_FUNCTIONS)
PAIRS: tuple[str, ...] = tuple(_FUNCTIONS)
__version__: str = _core.version()

__all__ = [
    *_FUNCTIONS,
    "Capsule", "Contacts", "Cube", "Dataset", "EngineError", "Exact", "Gradient", "GradientFailure", "GradientReport", "Hull", "InputError", "LawReport", "Line", "Obb", "OracleDisagreement", "PAIRS",
    "Plane", "Question", "Questions", "Ray", "Report", "Sphere", "Triangle", "certify", "certify_gradient", "exact", "explain", "families", "generate", "gradient", "hits", "profiles",
    "properties", "read_dataset", "serve", "suite", "write_dataset",
]
