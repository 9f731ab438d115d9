// The families of questions about two capsules.
#include "golden/capsules.hpp"

namespace contact::golden {
namespace capsule_capsule_families {
namespace {

constexpr Pair kPair = Pair::capsule_capsule;

/// Parallel segments: beside each other, in one point or in a line, meeting or not; some of them nearly.
template <class Real>
TwoSegments<Real> parallel(Random& random) {
  enum class Kind { beside, nearly, in_a_point, in_line, overlapping, along_an_axis };
  const auto kind = static_cast<Kind>(random.turn(6));
  std::array<Feature, 2> features{Feature::side, Feature::side};
  if (kind == Kind::in_a_point || kind == Kind::in_line)
    features = {static_cast<Feature>(random.turn(2, 6)), static_cast<Feature>(random.turn(2, 12))};
  auto [s, frame, distance] = on_frame<Real, kPair>(
      random, features, kind == Kind::in_line ? Lie::in_line : Lie::parallel, kind == Kind::overlapping);
  if (kind == Kind::nearly) {
    Real& x = (*s.ends()[random.index(4)])[random.index(3)];
    x = ulps_away(x, random.chance(2) ? 1 : -1);
  }
  if (kind == Kind::along_an_axis) {
    s = beside<Real, kPair>(random);
    const std::size_t along = random.index(3);
    for (Segment<Real>* segment : {&s.a, &s.b})
      for (std::size_t i = 0; i < 3; ++i)
        if (i != along) segment->end[i] = segment->start[i];
  }
  if (kind == Kind::overlapping) {
    share_radii(s, random, random.uniform(Real{0.5}, Real{6}));
  } else if (kind == Kind::along_an_axis || random.chance(2)) {
    reach_or_not(s, random);
  } else {
    reach_exactly(s, random, distance);
    if (random.turn(5) == kMissing) s.a.radius = ulps_away(s.a.radius, -1);
  }
  return s;
}

constexpr std::array kFamilies{
    Family{"generic", "two capsules, each end and the side of one beside each of the other in turn",
           "ordinary numbers: what fails here fails its users, and other families do not say so",
           made<generic<double, kPair>, generic<float, kPair>>, false},
    Family{"touching",
           "exactly touching at ends and sides in every combination, by integers on orthogonal frames; half searched "
           "for squares that round apart; a "
           "fifth one ulp short",
           "a strict comparison, or any tolerance, shows in every case and not by chance",
           made<touching<double, kPair>, touching<float, kPair>>, false},
    Family{"near_touching", "up to 4 ulps from touching, most of them searched for wrong decisions of plain arithmetic",
           "plain arithmetic decides most of it wrongly: how often is an engine's measure",
           made<near_touching<double, kPair>, near_touching<float, kPair>>, false},
    Family{"alarm_edge", "exactly at the alarm distance and up to 4 ulps beside it",
           "alarm, contact and radii differ: no two of them can be confused unseen",
           made<alarm_edge<double, kPair>, alarm_edge<float, kPair>>, false},
    Family{"region_edge", "an end at right angles to the way between two axes, exactly or one ulp beside",
           "where a foot is clamped, or one ulp before it, decides which formula is taken",
           made<region_edge<double, kPair>, region_edge<float, kPair>>, false},
    Family{"zero_length",
           "one capsule or both spheres, ulps long or of subnormal length; a fifth with one axis for both",
           "a division of 0 by 0, or by what is added to avoid it",
           made<zero_length<double, kPair>, zero_length<float, kPair>>, false},
    Family{
        "on_axis",
        "axes that meet in their middles, at ends or in a part of their length; a fifth one ulp apart, without radii",
        "no direction: what an engine does instead, under whichever convention it declares",
        made<on_axis<double, kPair>, on_axis<float, kPair>>, false},
    Family{"parallel",
           "parallel axes beside each other, in one point or in a line, either way round; a sixth of them nearly so",
           "more than one nearest point, or a division by nearly 0 where there is but one",
           made<parallel<double>, parallel<float>>, false},
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
           "four points and two radii: a check of one shape forgets the other",
           spoiled<generic<double, kPair>, generic<float, kPair>>, false, true},
};

}  // namespace
}  // namespace capsule_capsule_families

std::span<const Family> families_of(const Capsules* /*kind*/) { return capsule_capsule_families::kFamilies; }

}  // namespace contact::golden
