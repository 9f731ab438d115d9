// The families of questions about a sphere and a triangle.
#include "golden/triangles.hpp"

namespace contact::golden {
namespace sphere_triangle_families {
namespace {

constexpr std::array kFamilies{
    Family{"generic", "a sphere beside each vertex, each edge and the face in turn, on either side",
           "ordinary numbers: what fails here fails its users, and other families do not say so",
           made<generic_triangle<double>, generic_triangle<float>>, false},
    Family{"touching",
           "exactly touching at a vertex, an edge or the face, by integers on orthogonal frames; half searched for "
           "squares that round apart; a fifth one ulp short",
           "a strict comparison, or any tolerance, shows in every case and not by chance",
           made<touching_triangle<double>, touching_triangle<float>>, false},
    Family{"near_touching", "up to 4 ulps from touching, most of them searched for wrong decisions of plain arithmetic",
           "plain arithmetic decides most of it wrongly: how often is an engine's measure",
           made<near_touching_triangle<double>, near_touching_triangle<float>>, false},
    Family{"alarm_edge", "exactly at the alarm distance and up to 4 ulps beside it",
           "alarm, contact and radius differ: no two of them can be confused unseen",
           made<alarm_edge_of_triangle<double>, alarm_edge_of_triangle<float>>, false},
    Family{"region_edge", "the foot on the plane exactly on a vertex or an edge, or one ulp beside it",
           "which feature is nearest is decided by a sign that is 0 or nearly so",
           made<region_edge_of_triangle<double>, region_edge_of_triangle<float>>, false},
    Family{"aligned",
           "the foot on the plane in line with a vertex or an edge, along an axis or a diagonal; half of them inside",
           "who counts the edges that a ray in the plane crosses, to find the face, counts two or none at a vertex",
           made<aligned_triangle<double>, aligned_triangle<float>>, false},
    Family{"thin", "slivers, needles, three points on a line, two points and one; a fifth of the centres on a vertex",
           "a normal of length 0, or of rounding errors alone", made<thin_triangle<double>, thin_triangle<float>>,
           false},
    Family{"on_triangle", "the centre on the face, an edge or a vertex; a fifth one ulp beside it, without a radius",
           "no direction: what an engine does instead, under whichever convention it declares",
           made<on_triangle<double>, on_triangle<float>>, false},
    Family{"ties",
           "the value, or a nearest point in the middle of an edge, half way between two numbers or just beside",
           "rounding twice, or away from even; and a result that no number of digits decides",
           made<ties_of_triangle<double>, ties_of_triangle<float>>, false},
    Family{"units", "ordinary questions in units from 2^-24 to 2^24: metres, inches, micrometres",
           "an absolute epsilon, of a length, an area or a determinant, is small in one unit alone",
           made<triangle_in_other_units<double>, triangle_in_other_units<float>>, false},
    Family{"far_from_origin", "small distances between large coordinates: cancellation, coarse contact points",
           "coordinates that a smaller format, or a tolerance that grows, cannot hold",
           made<far_triangle<double>, far_triangle<float>>, false},
    Family{"extreme_scale", "squares that overflow or underflow, mixed magnitudes, subnormal numbers",
           "overflow and underflow depend on an engine's own order of operations",
           made<extreme_triangle<double>, extreme_triangle<float>>, false},
    Family{kInvalidFamily, "each number in turn NaN or infinite, the radius negative: it must be refused",
           "nine numbers of three points: a check of one of them forgets the others",
           spoiled<generic_triangle<double>, generic_triangle<float>>, false, true},
};

}  // namespace
}  // namespace sphere_triangle_families

std::span<const Family> families_of(const BallAndTriangle* /*kind*/) { return sphere_triangle_families::kFamilies; }

}  // namespace contact::golden
