// The families of questions about a sphere and a capsule.
#include "golden/capsules.hpp"

namespace contact::golden {
namespace sphere_capsule_families {
namespace {

constexpr Pair kPair = Pair::sphere_capsule;

constexpr std::array kFamilies{
    Family{"generic", "a sphere beside either end of the axis and beside its side, each in turn",
           "ordinary numbers: what fails here fails its users, and other families do not say so",
           made<generic<double, kPair>, generic<float, kPair>>, false},
    Family{"touching",
           "exactly touching at an end or the side, by integers on orthogonal frames; half searched for squares that "
           "round apart; a "
           "fifth one ulp short",
           "a strict comparison, or any tolerance, shows in every case and not by chance",
           made<touching<double, kPair>, touching<float, kPair>>, false},
    Family{"near_touching", "up to 4 ulps from touching, most of them searched for wrong decisions of plain arithmetic",
           "plain arithmetic decides most of it wrongly: how often is an engine's measure",
           made<near_touching<double, kPair>, near_touching<float, kPair>>, false},
    Family{"alarm_edge", "exactly at the alarm distance and up to 4 ulps beside it",
           "alarm, contact and radii differ: no two of them can be confused unseen",
           made<alarm_edge<double, kPair>, alarm_edge<float, kPair>>, false},
    Family{"region_edge", "the foot of the centre exactly on an end of the axis, or one ulp beside it",
           "where a foot is clamped, or one ulp before it, decides which formula is taken",
           made<region_edge<double, kPair>, region_edge<float, kPair>>, false},
    Family{"zero_length",
           "capsules that are spheres, ulps long or of subnormal length; a fifth with one centre for both",
           "a division of 0 by 0, or by what is added to avoid it",
           made<zero_length<double, kPair>, zero_length<float, kPair>>, false},
    Family{"on_axis", "the centre on the axis, inside it or at an end; a fifth one ulp beside it, without radii",
           "no direction: what an engine does instead, under whichever convention it declares",
           made<on_axis<double, kPair>, on_axis<float, kPair>>, false},
    Family{"ties",
           "the value, or a nearest point in the middle of an axis, half way between two numbers or just beside",
           "rounding twice, or away from even; and a result that no number of digits decides",
           made<ties<double, kPair>, ties<float, kPair>>, false},
    Family{
        "along_axes",
        "capsules along the coordinate axes, their middles and half lengths numbers too; two of three near touching, "
        "most of these searched",
        "engines that take a capsule by middle, direction and length can be asked no other without rounding",
        made<along_axes<double, kPair>, along_axes<float, kPair>>, false},
    Family{"units", "ordinary questions in units from 2^-24 to 2^24: metres, inches, micrometres",
           "an absolute epsilon, of a length, a squared length or a determinant, is small in one unit alone",
           made<other_units<double, kPair>, other_units<float, kPair>>, false},
    Family{"far_from_origin", "small distances between large coordinates: cancellation, coarse contact points",
           "coordinates that a smaller format, or a tolerance that grows, cannot hold",
           made<far_from_origin<double, kPair>, far_from_origin<float, kPair>>, false},
    Family{"extreme_scale", "squares that overflow or underflow, mixed magnitudes, subnormal numbers",
           "overflow and underflow depend on an engine's own order of operations",
           made<extreme_scale<double, kPair>, extreme_scale<float, kPair>>, false},
    Family{kInvalidFamily, "each number in turn NaN or infinite, a length negative: it must be refused",
           "an axis of two points: a check of one of them forgets the other",
           spoiled<generic<double, kPair>, generic<float, kPair>>, false, true},
};

}  // namespace
}  // namespace sphere_capsule_families

std::span<const Family> families_of(const BallAndCapsule* /*kind*/) { return sphere_capsule_families::kFamilies; }

}  // namespace contact::golden
