// The names that golden files use, of flags and of the family that has no answers; what a flag says is golden/flags.hpp's.
#pragma once

#include <array>
#include <string_view>

namespace contact::golden {

/// The family of questions that must be refused. Its files hold such questions and no others, and are judged only when named.
inline constexpr std::string_view kInvalidFamily = "invalid";
/// The one flag of a question outside the domain.
inline constexpr std::string_view kInvalidFlag = "Invalid";

struct Flag {
  std::string_view name;
  std::string_view meaning;
  std::string_view breaks;  ///< what goes wrong in engines where this holds
};

/// Every flag, in the order in which a case lists them.
inline constexpr std::array kFlags{
    Flag{"Touching", "exactly touching, alarm distance 0",
         "strict comparisons; a rounded square root beside the radii"},
    Flag{"AlarmEdge", "exactly at an alarm distance above 0",
         "the margin added twice, not at all, or compared strictly"},
    Flag{"NearBoundary", "up to 8 ulps from the decision's boundary, not on it",
         "squared comparisons in plain arithmetic; absolute tolerances; single precision inside"},
    Flag{"PlainWrong", "plain arithmetic in the file's scalar decides wrongly",
         "every engine that computes as the seed prints"},
    Flag{"ContactEdge", "value within 8 ulps of its scale of zero",
         "the sign of value; cancellation in distance - radii - contact"},
    Flag{"Coincident",
         "one centre for both spheres, a centre on a box, a triangle, a ray or a capsule's axis, or axes that meet",
         "0/0 for the normal, points that are not finite"},
    Flag{"NearlyCoincident", "centres apart by less than a 2^20th of the radii, or by subnormal numbers",
         "an absolute epsilon below which the normal becomes a fixed axis; squares that underflow"},
    Flag{"BelowPlane", "the lowest point of a centre or an axis is on a plane, or below it",
         "the size of a distance for the distance; a plane taken for a sheet with two sides"},
    Flag{"CrossingEdge", "a segment ends on a triangle, or crosses it in its boundary",
         "strict bounds, and bounds with a tolerance; an edge that two triangles share and neither has"},
    Flag{"FromInside", "a ray begins in the shape that it is cast at, or on it",
         "a hit from inside taken for a miss; the way out taken for the way in"},
    Flag{"Grazing", "a ray touches a sphere or the side of a capsule, and goes by",
         "a discriminant of 0, which rounding makes negative; strict comparisons with it"},
    Flag{"ManyNormals", "a ray hits an edge or a corner, where more than one normal is right",
         "an edge that two triangles share and neither has; 0/0 in a slab"},
    Flag{"EndsAtSurface", "a ray ends where it first hits",
         "strict comparisons with the length, and lengths that are counted in another unit than t"},
    Flag{"Containment", "one shape lies inside the other", "depth from the wrong side; boundaries taken for solids"},
    Flag{"Overlap", "two cores overlap, and how deep is an answer like any other",
         "axes of edges that are not tried; the depth along the first axis, or from the wrong side"},
    Flag{"ZeroRadius", "a sphere or a capsule of radius 0", "divisions by a radius; strict overlap tests"},
    Flag{"Flat",
         "a box without thickness on an axis, a capsule or a ray without length, or a triangle or a hull without an "
         "inside",
         "overlap by volume; strict bounds; divisions by a squared length"},
    Flag{"ManyNearest", "more than one pair of points is nearest, as of parallel capsules side by side",
         "determinants of 0 or nearly; a contact point that jumps from one end to the other"},
    Flag{"OneAxis", "the centres differ in one coordinate only", "zeros that are not zero; normals that are not exact"},
    Flag{"FarFromOrigin", "coordinates 2^8 times the reach (of a box: its distances) and more",
         "coordinates stored in a smaller format; tolerances that grow with the coordinates"},
    Flag{"SquareOverflow", "a squared length exceeds the scalar's range",
         "infinite or NaN where the answer is finite; hits from inf <= inf"},
    Flag{"SquareUnderflow", "the square of a difference that is not zero falls below the normal range",
         "a distance of zero between spheres that are apart; normals of the wrong length"},
    Flag{"ReachOverflow", "alarm + r1 + r2, or max + alarm, exceeds the largest finite number",
         "an infinite reach that hits everything"},
    Flag{"ResultOverflow", "a number of the answer rounds to infinity", "NaN from inf - inf"},
    Flag{"HardToRound", "a number of the answer lies within 2^-20 ulp of a rounding boundary, not on it",
         "arithmetic of any one precision, and of two that agree; a result rounded twice"},
    Flag{"Tie", "a number of the answer lies exactly half way between two neighbours",
         "ties away from zero; a second rounding; loops that refine until the answer is clear"},
    Flag{"Subnormal", "a number of the question is subnormal in the file's scalar",
         "flush-to-zero modes; reciprocals that overflow"},
    Flag{kInvalidFlag, "a number lies outside the domain", "answers where there is no question"},
};

}  // namespace contact::golden
