"""The types of the package. The functions of the pairs are made from the core's description; a test compares them with these."""
from numpy.typing import ArrayLike

from .answering import explain as explain
from .answering import hits as hits
from .contacts import Contacts as Contacts
from .datasets import Dataset as Dataset
from .datasets import families as families
from .datasets import generate as generate
from .datasets import profiles as profiles
from .datasets import read_dataset as read_dataset
from .datasets import write_dataset as write_dataset
from .errors import EngineError as EngineError
from .errors import InputError as InputError
from .errors import OracleDisagreement as OracleDisagreement
from .exact_answers import Exact as Exact
from .exact_answers import exact as exact
from .judging import LawReport as LawReport
from .judging import Report as Report
from .judging import certify as certify
from .judging import properties as properties
from .questions import Questions as Questions
from .serving import serve as serve
from .shapes import Capsule as Capsule
from .shapes import Cube as Cube
from .shapes import Line as Line
from .shapes import Obb as Obb
from .shapes import Plane as Plane
from .shapes import Question as Question
from .shapes import Ray as Ray
from .shapes import Sphere as Sphere
from .shapes import Triangle as Triangle
from .suites import suite as suite

__version__: str
__all__: list[str]
PAIRS: tuple[str, ...]

def sphere_sphere(center1: ArrayLike, radius1: ArrayLike, center2: ArrayLike, radius2: ArrayLike, *,
                  alarm: ArrayLike = ..., contact: ArrayLike = ..., points: str = ...) -> Contacts: ...
def rigid_sphere_rigid_sphere(center1: ArrayLike, radius1: ArrayLike, center2: ArrayLike, radius2: ArrayLike, *,
                              alarm: ArrayLike = ..., contact: ArrayLike = ..., points: str = ...) -> Contacts: ...
def sphere_rigid_sphere(center1: ArrayLike, radius1: ArrayLike, center2: ArrayLike, radius2: ArrayLike, *,
                        alarm: ArrayLike = ..., contact: ArrayLike = ..., points: str = ...) -> Contacts: ...
def cube_cube(min1: ArrayLike, max1: ArrayLike, min2: ArrayLike, max2: ArrayLike, *,
              alarm: ArrayLike = ..., contact: ArrayLike = ..., points: str = ...) -> Contacts: ...
def sphere_cube(center1: ArrayLike, radius1: ArrayLike, min2: ArrayLike, max2: ArrayLike, *,
                alarm: ArrayLike = ..., contact: ArrayLike = ..., points: str = ...) -> Contacts: ...
def sphere_capsule(center1: ArrayLike, radius1: ArrayLike, start2: ArrayLike, end2: ArrayLike, radius2: ArrayLike, *,
                   alarm: ArrayLike = ..., contact: ArrayLike = ..., points: str = ...) -> Contacts: ...
def capsule_capsule(start1: ArrayLike, end1: ArrayLike, radius1: ArrayLike, start2: ArrayLike, end2: ArrayLike, radius2: ArrayLike, *,
                    alarm: ArrayLike = ..., contact: ArrayLike = ..., points: str = ...) -> Contacts: ...
def sphere_triangle(center1: ArrayLike, radius1: ArrayLike, vertices2: ArrayLike, *,
                    alarm: ArrayLike = ..., contact: ArrayLike = ..., points: str = ...) -> Contacts: ...
def ray_sphere(origin1: ArrayLike, direction1: ArrayLike, length1: ArrayLike, center2: ArrayLike, radius2: ArrayLike, *,
               alarm: ArrayLike = ..., contact: ArrayLike = ..., points: str = ...) -> Contacts: ...
def sphere_plane(center1: ArrayLike, radius1: ArrayLike, normal2: ArrayLike, offset2: ArrayLike, *,
                 alarm: ArrayLike = ..., contact: ArrayLike = ..., points: str = ...) -> Contacts: ...
def capsule_plane(start1: ArrayLike, end1: ArrayLike, radius1: ArrayLike, normal2: ArrayLike, offset2: ArrayLike, *,
                  alarm: ArrayLike = ..., contact: ArrayLike = ..., points: str = ...) -> Contacts: ...
def ray_triangle(origin1: ArrayLike, direction1: ArrayLike, length1: ArrayLike, vertices2: ArrayLike, *,
                 alarm: ArrayLike = ..., contact: ArrayLike = ..., points: str = ...) -> Contacts: ...
def triangle_line(vertices1: ArrayLike, start2: ArrayLike, end2: ArrayLike, *,
                  alarm: ArrayLike = ..., contact: ArrayLike = ..., points: str = ...) -> Contacts: ...
def cast_sphere(origin1: ArrayLike, direction1: ArrayLike, length1: ArrayLike, center2: ArrayLike, radius2: ArrayLike, *,
                alarm: ArrayLike = ..., contact: ArrayLike = ..., points: str = ...) -> Contacts: ...
def cast_cube(origin1: ArrayLike, direction1: ArrayLike, length1: ArrayLike, min2: ArrayLike, max2: ArrayLike, *,
              alarm: ArrayLike = ..., contact: ArrayLike = ..., points: str = ...) -> Contacts: ...
def cast_capsule(origin1: ArrayLike, direction1: ArrayLike, length1: ArrayLike, start2: ArrayLike, end2: ArrayLike, radius2: ArrayLike, *,
                 alarm: ArrayLike = ..., contact: ArrayLike = ..., points: str = ...) -> Contacts: ...
def cast_triangle(origin1: ArrayLike, direction1: ArrayLike, length1: ArrayLike, vertices2: ArrayLike, *,
                  alarm: ArrayLike = ..., contact: ArrayLike = ..., points: str = ...) -> Contacts: ...
def cast_plane(origin1: ArrayLike, direction1: ArrayLike, length1: ArrayLike, normal2: ArrayLike, offset2: ArrayLike, *,
               alarm: ArrayLike = ..., contact: ArrayLike = ..., points: str = ...) -> Contacts: ...
def obb_obb(center1: ArrayLike, orientation1: ArrayLike, extents1: ArrayLike,
            center2: ArrayLike, orientation2: ArrayLike, extents2: ArrayLike, *,
            alarm: ArrayLike = ..., contact: ArrayLike = ..., points: str = ...) -> Contacts: ...
def sphere_obb(center1: ArrayLike, radius1: ArrayLike, center2: ArrayLike, orientation2: ArrayLike, extents2: ArrayLike, *,
               alarm: ArrayLike = ..., contact: ArrayLike = ..., points: str = ...) -> Contacts: ...
def capsule_cube(start1: ArrayLike, end1: ArrayLike, radius1: ArrayLike, min2: ArrayLike, max2: ArrayLike, *,
                 alarm: ArrayLike = ..., contact: ArrayLike = ..., points: str = ...) -> Contacts: ...
def capsule_obb(start1: ArrayLike, end1: ArrayLike, radius1: ArrayLike,
                center2: ArrayLike, orientation2: ArrayLike, extents2: ArrayLike, *,
                alarm: ArrayLike = ..., contact: ArrayLike = ..., points: str = ...) -> Contacts: ...
def capsule_triangle(start1: ArrayLike, end1: ArrayLike, radius1: ArrayLike, vertices2: ArrayLike, *,
                     alarm: ArrayLike = ..., contact: ArrayLike = ..., points: str = ...) -> Contacts: ...
def cube_obb(min1: ArrayLike, max1: ArrayLike, center2: ArrayLike, orientation2: ArrayLike, extents2: ArrayLike, *,
             alarm: ArrayLike = ..., contact: ArrayLike = ..., points: str = ...) -> Contacts: ...
def cube_triangle(min1: ArrayLike, max1: ArrayLike, vertices2: ArrayLike, *,
                  alarm: ArrayLike = ..., contact: ArrayLike = ..., points: str = ...) -> Contacts: ...
def obb_triangle(center1: ArrayLike, orientation1: ArrayLike, extents1: ArrayLike, vertices2: ArrayLike, *,
                 alarm: ArrayLike = ..., contact: ArrayLike = ..., points: str = ...) -> Contacts: ...
def triangle_triangle(vertices1: ArrayLike, vertices2: ArrayLike, *,
                      alarm: ArrayLike = ..., contact: ArrayLike = ..., points: str = ...) -> Contacts: ...
def cube_plane(min1: ArrayLike, max1: ArrayLike, normal2: ArrayLike, offset2: ArrayLike, *,
               alarm: ArrayLike = ..., contact: ArrayLike = ..., points: str = ...) -> Contacts: ...
def obb_plane(center1: ArrayLike, orientation1: ArrayLike, extents1: ArrayLike, normal2: ArrayLike, offset2: ArrayLike, *,
              alarm: ArrayLike = ..., contact: ArrayLike = ..., points: str = ...) -> Contacts: ...
def triangle_plane(vertices1: ArrayLike, normal2: ArrayLike, offset2: ArrayLike, *,
                   alarm: ArrayLike = ..., contact: ArrayLike = ..., points: str = ...) -> Contacts: ...
