// The families of questions about a triangle and a line.
#include "golden/crossings.hpp"

namespace contact::golden {
namespace triangle_line_families {
namespace {

constexpr Pair kPair = Pair::triangle_line;

constexpr std::array kFamilies{
    Family{"generic", "through a triangle, and two in five past an edge or short of the plane",
           "ordinary numbers: what fails here fails its users, and other families do not say so",
           made<generic_crossing<double, kPair>, generic_crossing<float, kPair>>, false},
    Family{"through_boundary", "through an edge or a vertex exactly, by integers; a fifth one step outside",
           "strict bounds, or any tolerance: an edge that two triangles share belongs to both",
           made<boundary_crossing<double, kPair>, boundary_crossing<float, kPair>>, false},
    Family{"end_on_triangle", "a start or an end on the triangle exactly, by integers; a fifth one step short",
           "what just reaches the plane, which a strict comparison misses",
           made<end_on_triangle<double, kPair>, end_on_triangle<float, kPair>>, false},
    Family{"near_boundary",
           "some steps from the boundary, most of them searched for wrong decisions of plain arithmetic",
           "plain arithmetic decides most of it wrongly: how often is an engine's measure",
           made<near_boundary<double, kPair>, near_boundary<float, kPair>>, false},
    Family{"along_plane", "in the plane of the triangle exactly, and most with ends a step above and below it",
           "a determinant of 0, or nearly: parallel is no crossing, and one step off it may be",
           made<along_triangle<double, kPair>, along_triangle<float, kPair>>, false},
    Family{"thin",
           "triangles without an inside and segments without length, which nothing crosses; half of them slivers",
           "a normal of length 0, or of rounding errors alone",
           made<thin_crossing<double, kPair>, thin_crossing<float, kPair>>, false},
    Family{"ties", "a coordinate of the crossing half way between two numbers or just beside",
           "rounding twice, or away from even; and a result that no number of digits decides",
           made<ties_of_crossing<double, kPair>, ties_of_crossing<float, kPair>>, false},
    Family{"units", "ordinary questions in units from 2^-24 to 2^24: metres, inches, micrometres",
           "an absolute epsilon of a determinant is small in one unit alone",
           made<crossing_in_other_units<double, kPair>, crossing_in_other_units<float, kPair>>, false},
    Family{"far_from_origin", "small triangles between large coordinates",
           "coordinates that a smaller format, or a tolerance that grows, cannot hold",
           made<far_crossing<double, kPair>, far_crossing<float, kPair>>, false},
    Family{"extreme_scale",
           "products that overflow or underflow, an axis much longer than the others, subnormal numbers",
           "overflow and underflow depend on an engine's own order of operations",
           made<extreme_crossing<double, kPair>, extreme_crossing<float, kPair>>, false},
    Family{kInvalidFamily, "each number in turn NaN or infinite, a distance negative: it must be refused",
           "fifteen numbers of five points: a check of one of them forgets the others",
           spoiled<generic_crossing<double, kPair>, generic_crossing<float, kPair>>, false, true},
};

}  // namespace
}  // namespace triangle_line_families

std::span<const Family> families_of(const TriangleAndLine* /*kind*/) { return triangle_line_families::kFamilies; }

}  // namespace contact::golden
