// Mistakes about a segment that crosses a triangle.
#include "engines/zoo/mutating.hpp"

namespace contact::engines {
namespace {

using Crossing = oracle::CrossingInReals;

/// Calls change(crossing) of a question about one.
template <class Change>
void of_crossing(const Query& q, Change change) {
  if (const auto* ray = std::get_if<RayAndTriangle>(&q.shapes)) change(Crossing(*ray));
  if (const auto* line = std::get_if<TriangleAndLine>(&q.shapes)) change(Crossing(*line));
}
/// A miss becomes a hit where `crosses` says so of the place where the line goes through the plane, if it does.
constexpr auto also_crossing = [](const Query& q, Claim& claim, auto crosses) {
  of_crossing(q, [&](const Crossing& x) {
    if (!claim.overlap.value_or(true) && x.through() != 0 && crosses(x)) decide(q, claim, true);
  });
};
/// And a hit a miss.
constexpr auto not_crossing = [](const Query& q, Claim& claim, auto there) {
  of_crossing(q, [&](const Crossing& x) {
    if (claim.overlap.value_or(false) && there(x)) decide(q, claim, false);
  });
};
constexpr auto is_crossed_inside = [](const Crossing& x) {
  return std::min({x.inside(0, x.at), x.inside(1, x.at), x.inside(2, x.at)}) >= 0;
};
constexpr auto is_within_segment = [](const Crossing& x) { return x.part() >= 0 && x.part() <= 1; };
/// Another contact.
constexpr auto in_crossing = [](const Query& q, Claim& claim, auto change) {
  of_crossing(q, [&](const Crossing& x) { in_contact(claim, [&](ContactClaim& c) { change(x, c); }); });
};

const std::array kCrossings{
    Mutant{"crossing-infinite-line", "a segment is the line through it", "crossing-without-ends", nullptr,
           with(also_crossing, is_crossed_inside), "https://github.com/g-truc/glm/issues/998"},
    Mutant{"crossing-without-end", "a segment has a start and no end", "crossing-without-end", nullptr,
           with(also_crossing, [](const Crossing& x) { return is_crossed_inside(x) && x.part() >= 0; })},
    Mutant{"crossing-of-plane", "a triangle is its plane", "crossing-of-plane", nullptr,
           with(also_crossing, is_within_segment)},
    Mutant{"crossing-of-parallelogram", "the sum of the barycentric coordinates is not looked at",
           "crossing-of-parallelogram", nullptr,
           with(also_crossing,
                [](const Crossing& x) {
                  return is_within_segment(x) && x.inside(0, x.at) >= 0 && x.inside(2, x.at) >= 0 &&
                         x.inside(1, x.at) >= x.inside(1, x.v[1] + x.v[2] - x.v[0]);
                })},
    Mutant{
        "sofa-crossing-not-tested", "testIntersection says yes to every segment and triangle", "crossing-not-tested",
        nullptr,
        [](const Query& q, Claim& claim) {
          if (is_crossing(q.pair) && claim.overlap) claim.overlap = true;
        },
        "https://github.com/sofa-framework/sofa/blob/master/Sofa/Component/Collision/Detection/Intersection/src/sofa/"
        "component/collision/detection/intersection/MeshDiscreteIntersection.cpp"},
    Mutant{"sofa-crossing-determinant", "a determinant up to 2.2e-16 is 0, whatever the units",
           "crossing-determinant-2e-16", nullptr,
           with(not_crossing, [](const Crossing& x) { return std::abs(x.determinant()) <= 0x1p-52L; }),
           "https://github.com/sofa-framework/sofa/blob/master/Sofa/framework/Type/src/sofa/type/Mat.h"},
    Mutant{"crossing-determinant-1e-6", "a determinant below 1e-6 is 0, whatever the units",
           "crossing-determinant-1e-6", nullptr,
           with(not_crossing, [](const Crossing& x) { return std::abs(x.determinant()) < 1e-6L; }),
           "https://github.com/jbikker/tinybvh/pull/283"},
    Mutant{"crossing-open", "a segment that ends on the triangle, or goes through its boundary, does not cross it",
           "crossing-open", nullptr,
           [](const Query& q, Claim& claim) {
             not_crossing(q, claim, [&](const Crossing& x) {
               const oracle::Truth truth = oracle::truth_of(q);
               return truth.hit() && x.slack() <= 1e-18L * x.start.cwiseAbs().maxCoeff();
             });
           }},
    Mutant{"crossing-culled", "a triangle is crossed from one side alone", "crossing-culled", nullptr,
           with(not_crossing, [](const Crossing& x) { return x.through() > 0; })},
    Mutant{"crossing-normal-against", "the normal is turned against the segment", "crossing-normal-against", nullptr,
           with(in_crossing,
                [](const Crossing& x, ContactClaim& c) {
                  if (x.through() * x.turn > 0) c.normal = Vector3(-*c.normal);
                })},
    Mutant{"crossing-normal-along", "the normal is the direction of the segment", "crossing-normal-along", nullptr,
           with(in_crossing, [](const Crossing& x,
                                ContactClaim& c) { c.normal = Vector3(x.along.stableNormalized().cast<double>()); })},
    Mutant{"crossing-points-at-start", "the contact points are the start of the segment", "crossing-points-at-start",
           nullptr,
           with(in_crossing,
                [](const Crossing& x, ContactClaim& c) { c.point1 = c.point2 = Vector3(x.start.cast<double>()); })},
    Mutant{"crossing-value-along", "the value is the length along the segment", "crossing-value-along", nullptr,
           with(in_crossing,
                [](const Crossing& x, ContactClaim& c) { c.value = rounded(x.part() * x.along.stableNorm()); })},
};

}  // namespace

std::span<const Mutant> crossing_mutants() { return kCrossings; }

}  // namespace contact::engines
