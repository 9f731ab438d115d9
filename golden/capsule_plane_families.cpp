// The families of questions about a capsule and a plane.
#include "golden/planes.hpp"

namespace contact::golden {
namespace capsule_plane_families {
namespace {

constexpr Pair kPair = Pair::capsule_plane;

constexpr std::array kFamilies{
    Family{"generic",
           "a capsule over a plane, its start and its end lower in turn, some of them below it; normals of length 1, "
           "of any length, along an axis",
           "ordinary numbers: what fails here fails its users, and other families do not say so",
           made<generic_over_plane<double, kPair>, generic_over_plane<float, kPair>>, false},
    Family{"touching",
           "exactly touching with the start, the end, and all along, by integers on orthogonal frames; half searched "
           "for what plain arithmetic decides wrongly; a fifth one ulp short",
           "a strict comparison, or any tolerance, shows in every case and not by chance",
           made<touching_plane<double, kPair>, touching_plane<float, kPair>>, false},
    Family{"near_touching", "up to 4 ulps from touching, most of them searched for wrong decisions of plain arithmetic",
           "plain arithmetic decides most of it wrongly: how often is an engine's measure",
           made<near_touching_plane<double, kPair>, near_touching_plane<float, kPair>>, false},
    Family{"alarm_edge", "exactly at the alarm distance and up to 4 ulps beside it",
           "alarm, contact and radius differ: no two of them can be confused unseen",
           made<alarm_edge_of_plane<double, kPair>, alarm_edge_of_plane<float, kPair>>, false},
    Family{"below_plane", "on the plane and below it; a fifth over it by an ulp of the offset, without a radius",
           "the distance is signed: who takes its size, or a plane for a sheet with two sides, is right above it",
           made<below_plane<double, kPair>, below_plane<float, kPair>>, false},
    Family{"normal_length",
           "normals that are not of length 1, along axes too; most so long or so short that the squared length leaves "
           "the range",
           "a normal taken for a unit vector; a length of 0 or infinity where the plane is an ordinary one",
           made<length_of_normal<double, kPair>, length_of_normal<float, kPair>>, false},
    Family{
        "parallel",
        "along the plane exactly and in whichever direction, an ulp off, and off by what a cross product is rounded by",
        "which end is lower is decided by a sign that is 0 or nearly so, and the contact jumps with it",
        made<along_plane<double, kPair>, along_plane<float, kPair>>, false},
    Family{"zero_length", "capsules of length 0, ulps long or of subnormal length",
           "a direction of 0, and a middle that is none",
           made<no_length_over_plane<double, kPair>, no_length_over_plane<float, kPair>>, false},
    Family{"ties",
           "the value, a surface point or the middle of a capsule along the plane half way between two numbers or just "
           "beside",
           "rounding twice, or away from even; and a result that no number of digits decides",
           made<ties_over_plane<double, kPair>, ties_over_plane<float, kPair>>, false},
    Family{"units", "ordinary questions in units from 2^-24 to 2^24: metres, inches, micrometres",
           "an absolute epsilon is small in one unit alone",
           made<plane_in_other_units<double, kPair>, plane_in_other_units<float, kPair>>, false},
    Family{"far_from_origin", "small distances between large coordinates and a large offset",
           "cancellation in the product less the offset; coarse contact points",
           made<far_over_plane<double, kPair>, far_over_plane<float, kPair>>, false},
    Family{"extreme_scale", "products that overflow or underflow, mixed magnitudes, subnormal numbers",
           "overflow and underflow depend on an engine's own order of operations",
           made<extreme_over_plane<double, kPair>, extreme_over_plane<float, kPair>>, false},
    Family{kInvalidFamily, "each number in turn NaN or infinite, a length negative, the normal 0: it must be refused",
           "a normal of 0: a check of the numbers one by one forgets it",
           spoiled<generic_over_plane<double, kPair>, generic_over_plane<float, kPair>>, false, true},
};

}  // namespace
}  // namespace capsule_plane_families

std::span<const Family> families_of(const CapsuleAndPlane* /*kind*/) { return capsule_plane_families::kFamilies; }

}  // namespace contact::golden
