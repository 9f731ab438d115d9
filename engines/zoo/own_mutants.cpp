// Our formulas changed in one place: every operator, sign, operand, constant, radius and margin in turn.
#include <vector>

#include "engines/engine.hpp"
#include "engines/zoo/mutating.hpp"

namespace contact::engines {
namespace {

using S = const WideSpheres&;

template <auto hits>
void decisions(const Query& q, Claim& claim) {
  decide_spheres(q, claim, hits);
}
template <auto hits>
void box_decisions(const Query& q, Claim& claim) {
  decide_boxes(q, claim, hits);
}
template <auto value>
void values(const Query& q, Claim& claim) {
  revalue(q, claim, value);
}
template <auto change>
void normals(const Query& q, Claim& claim) {
  turn(q, claim, [&](Vector3& n) { change(n, WideSpheres(q)); });
}

/// What the contact point of one sphere is made of; `out` is the normal out of it, to the other sphere.
struct Surface {
  Vector3 center;
  Vector3 other_center;
  Vector3 out;
  double radius;
  double other_radius;
  double alarm;
  double contact;
};
enum Which { kFirst = 1, kSecond = 2, kBoth = 3 };
template <Which which, auto point>
void points(const Query& q, Claim& claim) {
  in_contact(claim, [&](ContactClaim& c) {
    const auto& [a, b] = balls(q);
    const auto& [alarm, contact] = q.distances;
    if ((which & kFirst) != 0) c.point1 = point({a.center, b.center, *c.normal, a.radius, b.radius, alarm, contact});
    if ((which & kSecond) != 0)
      c.point2 = point({b.center, a.center, Vector3(-*c.normal), b.radius, a.radius, alarm, contact});
  });
}
/// The right point, but for the centre's coordinate on an axis.
template <int axis>
Vector3 centre_on(const Surface& s) {
  Vector3 point = s.center + s.radius * s.out;
  point[axis] = s.center[axis];
  return point;
}
/// But for the sign of the normal's component.
template <int axis>
Vector3 mirrored_on(const Surface& s) {
  return s.center + s.radius * (s.out - 2 * s.out[axis] * Vector3::Unit(axis));
}
/// Whether boxes overlap, but for one comparison that is left out: of the first box's min, or of the second's.
template <int axis, bool first>
bool without(const WideBox& a, const WideBox& b, Wide alarm) {
  bool hit = true;
  for (int k = 0; k < 3; ++k)
    hit = hit && ((first && k == axis) || a.min[k] <= b.max[k] + alarm) &&
          ((!first && k == axis) || b.min[k] <= a.max[k] + alarm);
  return hit;
}

// The decision about spheres: D <= (alarm + r1 + r2)^2.
const std::array kSphereDecisions{
    Mutant{"decision-first-radius-missing", "r1 left out of the reach", "first-radius-missing", nullptr,
           decisions<[](S s) { return s.distance <= s.alarm + s.r2; }>},
    Mutant{"decision-second-radius-missing", "r2 left out of the reach", "second-radius-missing", nullptr,
           decisions<[](S s) { return s.distance <= s.alarm + s.r1; }>},
    Mutant{"decision-second-radius-for-both", "r2 in the place of r1", "second-radius-for-both", nullptr,
           decisions<[](S s) { return s.distance <= s.alarm + 2 * s.r2; }>},
    Mutant{"decision-radii-missing", "both radii left out of the reach", "radii-missing", nullptr,
           decisions<[](S s) { return s.distance <= s.alarm; }>},
    Mutant{"decision-radii-subtracted", "- in the place of + between the radii", "radii-subtracted", nullptr,
           decisions<[](S s) { return s.distance <= s.alarm + std::abs(s.r1 - s.r2); }>},
    Mutant{"decision-radii-multiplied", "* in the place of + between the radii", "radii-multiplied", nullptr,
           decisions<[](S s) { return s.distance <= s.alarm + s.r1 * s.r2; }>},
    Mutant{"decision-radii-doubled", "diameters in the place of radii", "radii-doubled", nullptr,
           decisions<[](S s) { return s.distance <= s.alarm + 2 * (s.r1 + s.r2); }>},
    Mutant{"decision-radii-halved", "half radii", "radii-halved", nullptr,
           decisions<[](S s) { return s.distance <= s.alarm + (s.r1 + s.r2) / 2; }>},
    Mutant{"decision-larger-radius", "the larger radius alone", "larger-radius-only", nullptr,
           decisions<[](S s) { return s.distance <= s.alarm + std::max(s.r1, s.r2); }>},
    Mutant{"decision-smaller-radius", "the smaller radius alone", "smaller-radius-only", nullptr,
           decisions<[](S s) { return s.distance <= s.alarm + std::min(s.r1, s.r2); }>},
    Mutant{"decision-sum-of-squares", "squares summed in the place of the squared sum", "sum-of-squares", nullptr,
           decisions<[](S s) { return s.D <= s.alarm * s.alarm + s.r1 * s.r1 + s.r2 * s.r2; }>},
    Mutant{"decision-alarm-squared-apart", "the alarm distance squared by itself", "alarm-squared-apart", nullptr,
           decisions<[](S s) { return s.D <= (s.r1 + s.r2) * (s.r1 + s.r2) + s.alarm * s.alarm; }>},
    Mutant{"decision-alarm-outside-square", "the alarm distance outside the square", "alarm-outside-square", nullptr,
           decisions<[](S s) { return s.D <= (s.r1 + s.r2) * (s.r1 + s.r2) + s.alarm; }>},
    Mutant{"decision-distance-against-square", "the root taken on one side alone", "distance-against-square", nullptr,
           decisions<[](S s) { return s.distance <= s.reach * s.reach; }>},
    Mutant{"decision-alarm-subtracted", "- in the place of + before the alarm distance", "alarm-subtracted", nullptr,
           decisions<[](S s) { return s.distance <= s.r1 + s.r2 - s.alarm; }>},
    Mutant{"decision-contact-widens", "the contact distance added to the reach", "contact-widens", nullptr,
           decisions<[](S s) { return s.distance <= s.reach + s.contact; }>},
    Mutant{"decision-contact-narrows", "the contact distance subtracted from the reach", "contact-narrows", nullptr,
           decisions<[](S s) { return s.distance <= s.reach - s.contact; }>},
    Mutant{"decision-larger-distance", "the larger of alarm and contact distance", "larger-distance", nullptr,
           decisions<[](S s) { return s.distance <= s.r1 + s.r2 + std::max(s.alarm, s.contact); }>},
    Mutant{"decision-coordinate-sum", "the sum of the differences in the place of the length", "coordinate-sum",
           nullptr, decisions<[](S s) { return std::abs(s.d[0]) + std::abs(s.d[1]) + std::abs(s.d[2]) <= s.reach; }>},
    Mutant{"decision-largest-coordinate", "the largest difference in the place of the length", "largest-coordinate",
           nullptr, decisions<[](S s) {
             return std::max({std::abs(s.d[0]), std::abs(s.d[1]), std::abs(s.d[2])}) <= s.reach;
           }>},
    Mutant{"decision-x-missing", "x left out of D", "x-ignored", nullptr,
           decisions<[](S s) { return std::hypot(s.d[1], s.d[2]) <= s.reach; }>},
    Mutant{"decision-y-missing", "y left out of D", "y-ignored", nullptr,
           decisions<[](S s) { return std::hypot(s.d[2], s.d[0]) <= s.reach; }>},
    Mutant{"decision-z-missing", "z left out of D", "z-ignored", nullptr,
           decisions<[](S s) { return std::hypot(s.d[0], s.d[1]) <= s.reach; }>},
    Mutant{kAlwaysHit, "a hit whatever is asked, its numbers right", "always-hit", nullptr,
           [](const Query& q, Claim& claim) { decide(q, claim, true); }},
    Mutant{kAlwaysMiss, "no hit whatever is asked", "never-hit", nullptr,
           [](const Query& q, Claim& claim) { decide(q, claim, false); }},
    Mutant{"decision-inverted", "> in the place of <=", "inverted", nullptr,
           [](const Query& q, Claim& claim) { decide(q, claim, !claim.overlap.value()); }},
    Mutant{"decision-open", "< in the place of <=", "edge-open", nullptr,
           [](const Query& q, Claim& claim) {
             if (at_edge(q)) decide(q, claim, false);
           }},
    Mutant{"decision-open-overlap", "< in the overlap test alone", "edge-open", nullptr,
           [](const Query& q, Claim& claim) {
             if (at_edge(q)) claim.overlap = false;
           }},
    Mutant{"decision-open-at-alarm", "< at an alarm distance alone", "edge-open", nullptr,
           [](const Query& q, Claim& claim) {
             if (q.distances.alarm > 0 && at_edge(q)) decide(q, claim, false);
           }},
    Mutant{"decision-coincident-missed", "spheres of one centre do not hit", "never-hit", nullptr,
           [](const Query& q, Claim& claim) {
             if (coincident(q)) decide(q, claim, false);
           }},
    Mutant{"decision-overlap-without-alarm", "the alarm distance left out of the overlap test alone", "alarm-ignored",
           nullptr,
           [](const Query& q, Claim& claim) {
             if (!overlapping(q)) claim.overlap = false;
           }},
};

// Numbers of the question, in every formula.
const std::array kNumbers{
    Mutant{"alarm-doubled", "the alarm distance counted for each shape", "alarm-doubled",
           [](Query& q) { q.distances.alarm *= 2; }},
    Mutant{"alarm-halved", "half the alarm distance for both shapes together", "alarm-halved",
           [](Query& q) { q.distances.alarm /= 2; }},
    Mutant{"distances-exchanged", "alarm and contact distance exchanged", "distances-exchanged",
           [](Query& q) { std::swap(q.distances.alarm, q.distances.contact); }},
    Mutant{"contact-ignored", "the contact distance ignored", "contact-ignored",
           [](Query& q) { q.distances.contact = 0; }},
    Mutant{"contact-doubled", "the contact distance counted for each sphere", "contact-doubled",
           [](Query& q) { q.distances.contact *= 2; }},
    Mutant{"contact-halved", "half the contact distance", "contact-halved", [](Query& q) { q.distances.contact /= 2; }},
    Mutant{"second-radius-for-both", "r2 in the place of r1 everywhere", "second-radius-for-both",
           change<Balls>([](Balls& b) { b.a.radius = b.b.radius; })},
    Mutant{"first-radius-zero", "r1 taken for 0 everywhere", "first-radius-missing",
           [](Query& q) { for_each_radius(q, [](double& r, int which) { r = which == 0 ? 0 : r; }); }},
    Mutant{"second-radius-zero", "r2 taken for 0 everywhere", "second-radius-missing",
           [](Query& q) { for_each_radius(q, [](double& r, int which) { r = which == 1 ? 0 : r; }); }},
    Mutant{"radii-zero", "spheres taken for points", "radii-missing",
           [](Query& q) { for_each_radius(q, [](double& r, int) { r = 0; }); }},
    Mutant{"radii-doubled", "diameters given for radii", "radii-doubled",
           [](Query& q) { for_each_radius(q, [](double& r, int) { r *= 2; }); }},
    Mutant{"radii-halved", "radii taken for diameters", "radii-halved",
           [](Query& q) { for_each_radius(q, [](double& r, int) { r /= 2; }); }},
    Mutant{"radii-exchanged", "r1 and r2 exchanged", "radii-exchanged",
           change<Balls>([](Balls& b) { std::swap(b.a.radius, b.b.radius); })},
    Mutant{"delta-x-zero", "x left out of delta", "x-ignored",
           change<Balls>([](Balls& b) { b.a.center[0] = b.b.center[0]; })},
    Mutant{"delta-x-added", "+ in the place of - in x of delta", "x-added",
           change<Balls>([](Balls& b) { b.a.center[0] = -b.a.center[0]; })},
    Mutant{"delta-y-zero", "y left out of delta", "y-ignored",
           change<Balls>([](Balls& b) { b.a.center[1] = b.b.center[1]; })},
    Mutant{"delta-y-added", "+ in the place of - in y of delta", "y-added",
           change<Balls>([](Balls& b) { b.a.center[1] = -b.a.center[1]; })},
    Mutant{"delta-z-zero", "z left out of delta", "z-ignored",
           change<Balls>([](Balls& b) { b.a.center[2] = b.b.center[2]; })},
    Mutant{"delta-z-added", "+ in the place of - in z of delta", "z-added",
           change<Balls>([](Balls& b) { b.a.center[2] = -b.a.center[2]; })},
    Mutant{"delta-added", "+ in the place of - in delta", "centres-added",
           change<Balls>([](Balls& b) { b.a.center = Vector3(-b.a.center); })},
    Mutant{"delta-first-missing", "the first centre left out of delta", "first-centre-ignored",
           change<Balls>([](Balls& b) { b.a.center = Vector3::Zero(); })},
    Mutant{"delta-second-missing", "the second centre left out of delta", "second-centre-ignored",
           change<Balls>([](Balls& b) { b.b.center = Vector3::Zero(); })},
    Mutant{"delta-axes-crossed", "the index of the second centre off by one", "axes-crossed",
           change<Balls>([](Balls& b) { b.b.center = Vector3(b.b.center[1], b.b.center[2], b.b.center[0]); })},
    Mutant{"delta-x-twice", "x used in the place of y", "x-twice", change<Balls>([](Balls& b) {
             b.a.center[1] = b.a.center[0];
             b.b.center[1] = b.b.center[0];
           })},
    Mutant{"first-sphere-twice", "the first sphere against itself", "first-shape-twice",
           change<Balls>([](Balls& b) { b.b = b.a; })},
};

// The value: sqrt(D) - (r1 + r2) - contact.
const std::array kValues{
    Mutant{"value-first-radius-missing", "r1 not subtracted", "first-radius-missing", nullptr,
           values<[](S s) { return s.value() + s.r1; }>},
    Mutant{"value-second-radius-missing", "r2 not subtracted", "second-radius-missing", nullptr,
           values<[](S s) { return s.value() + s.r2; }>},
    Mutant{"value-first-radius-for-both", "r1 subtracted twice", "first-radius-for-both", nullptr,
           values<[](S s) { return s.distance - 2 * s.r1 - s.contact; }>},
    Mutant{"value-second-radius-for-both", "r2 subtracted twice", "second-radius-for-both", nullptr,
           values<[](S s) { return s.distance - 2 * s.r2 - s.contact; }>},
    Mutant{"value-radii-added", "+ in the place of - before the radii", "value-radii-added", nullptr,
           values<[](S s) { return s.distance + s.r1 + s.r2 - s.contact; }>},
    Mutant{"value-first-radius-added", "+ in the place of - before r1", "value-first-radius-added", nullptr,
           values<[](S s) { return s.distance + s.r1 - s.r2 - s.contact; }>},
    Mutant{"value-second-radius-added", "+ in the place of - before r2", "value-second-radius-added", nullptr,
           values<[](S s) { return s.distance - s.r1 + s.r2 - s.contact; }>},
    Mutant{"value-larger-radius", "the larger radius alone subtracted", "value-larger-radius", nullptr,
           values<[](S s) { return s.distance - std::max(s.r1, s.r2) - s.contact; }>},
    Mutant{"value-radii-halved", "half the radii subtracted", "radii-halved", nullptr,
           values<[](S s) { return s.distance - (s.r1 + s.r2) / 2 - s.contact; }>},
    Mutant{"value-contact-ignored", "the contact distance not subtracted", "contact-ignored", nullptr,
           values<[](S s) { return s.value() + s.contact; }>},
    Mutant{"value-contact-added", "+ in the place of - before the contact distance", "contact-added", nullptr,
           values<[](S s) { return s.value() + 2 * s.contact; }>},
    Mutant{"value-alarm-subtracted", "the alarm distance subtracted too", "value-less-alarm", nullptr,
           values<[](S s) { return s.value() - s.alarm; }>},
    Mutant{"value-alarm-for-contact", "the alarm distance subtracted in the place of the contact distance",
           "value-alarm-for-contact", nullptr, values<[](S s) { return s.distance - s.r1 - s.r2 - s.alarm; }>},
    Mutant{"value-alarm-added", "the alarm distance added", "value-plus-alarm", nullptr,
           values<[](S s) { return s.value() + s.alarm; }>},
    Mutant{"value-distance", "nothing subtracted from the distance", "value-is-distance", nullptr,
           values<[](S s) { return s.distance; }>},
    Mutant{"value-depth", "the opposite sign", "value-depth", nullptr, values<[](S s) { return -s.value(); }>},
    Mutant{"value-depth-less-contact", "a depth, less the contact distance", "value-depth-plus-contact", nullptr,
           values<[](S s) { return s.r1 + s.r2 - s.distance - s.contact; }>},
    Mutant{"value-depth-without-contact", "a depth without the contact distance", "value-depth-without-contact",
           nullptr, values<[](S s) { return s.r1 + s.r2 - s.distance; }>},
    Mutant{"value-unsigned", "the absolute value", "value-unsigned", nullptr,
           values<[](S s) { return std::abs(s.value()); }>},
    Mutant{"value-squared-distance", "the root not taken", "value-squared-distance", nullptr,
           values<[](S s) { return s.D - s.r1 - s.r2 - s.contact; }>},
    Mutant{"value-difference-of-squares", "the root taken nowhere", "value-difference-of-squares", nullptr,
           values<[](S s) { return s.D - (s.r1 + s.r2) * (s.r1 + s.r2) - s.contact; }>},
    Mutant{"value-squared", "the result squared", "value-squared", nullptr,
           values<[](S s) { return s.value() * s.value(); }>},
    Mutant{"value-not-negative", "cut off below at 0", "value-not-negative", nullptr,
           values<[](S s) { return std::max(Wide{0}, s.value()); }>},
    Mutant{"value-zero", "0 in the place of the value", "value-zero", nullptr, values<[](S) { return Wide{0}; }>},
    Mutant{"value-minus-one", "-1 in the place of the value", "value-minus-one", nullptr,
           values<[](S) { return Wide{-1}; }>},
    Mutant{"value-plus-one", "off by one", "value-plus-one", nullptr, values<[](S s) { return s.value() + 1; }>},
    Mutant{"value-halved", "halved", "value-halved", nullptr, values<[](S s) { return s.value() / 2; }>},
    Mutant{"value-doubled", "doubled", "value-doubled", nullptr, values<[](S s) { return s.value() * 2; }>},
    Mutant{"value-largest-coordinate", "the largest difference in the place of the length", "largest-coordinate",
           nullptr, values<[](S s) {
             return std::max({std::abs(s.d[0]), std::abs(s.d[1]), std::abs(s.d[2])}) - s.r1 - s.r2 - s.contact;
           }>},
    Mutant{"value-x-missing", "x left out of the distance", "x-ignored", nullptr,
           values<[](S s) { return std::hypot(s.d[1], s.d[2]) - s.r1 - s.r2 - s.contact; }>},
    Mutant{"value-y-missing", "y left out of the distance", "y-ignored", nullptr,
           values<[](S s) { return std::hypot(s.d[2], s.d[0]) - s.r1 - s.r2 - s.contact; }>},
    Mutant{"value-z-missing", "z left out of the distance", "z-ignored", nullptr,
           values<[](S s) { return std::hypot(s.d[0], s.d[1]) - s.r1 - s.r2 - s.contact; }>},
};

// The normal: delta / sqrt(D), and the points with it.
const std::array kNormals{
    Mutant{"normal-x-negated", "the sign of x", "normal-x-negated", nullptr,
           normals<[](Vector3& n, S) { n[0] = -n[0]; }>},
    Mutant{"normal-x-zero", "x missing", "normal-x-zero", nullptr, normals<[](Vector3& n, S) { n[0] = 0; }>},
    Mutant{"normal-y-negated", "the sign of y", "normal-y-negated", nullptr,
           normals<[](Vector3& n, S) { n[1] = -n[1]; }>},
    Mutant{"normal-y-zero", "y missing", "normal-y-zero", nullptr, normals<[](Vector3& n, S) { n[1] = 0; }>},
    Mutant{"normal-z-negated", "the sign of z", "normal-z-negated", nullptr,
           normals<[](Vector3& n, S) { n[2] = -n[2]; }>},
    Mutant{"normal-z-zero", "z missing", "normal-z-zero", nullptr, normals<[](Vector3& n, S) { n[2] = 0; }>},
    Mutant{"normal-unsigned", "the signs lost", "normal-unsigned", nullptr,
           normals<[](Vector3& n, S) { n = Vector3(n.cwiseAbs()); }>},
    Mutant{"normal-xy-exchanged", "x and y exchanged", "normal-xy-exchanged", nullptr,
           normals<[](Vector3& n, S) { std::swap(n[0], n[1]); }>},
    Mutant{"normal-yz-exchanged", "y and z exchanged", "normal-yz-exchanged", nullptr,
           normals<[](Vector3& n, S) { std::swap(n[1], n[2]); }>},
    Mutant{"normal-xz-exchanged", "x and z exchanged", "normal-xz-exchanged", nullptr,
           normals<[](Vector3& n, S) { std::swap(n[0], n[2]); }>},
    Mutant{"normal-rotated", "the index off by one", "normal-rotated", nullptr,
           normals<[](Vector3& n, S) { n = Vector3(n[2], n[0], n[1]); }>},
    Mutant{"normal-snapped", "the nearest axis in the place of the direction", "normal-snapped", nullptr,
           normals<[](Vector3& n, S) {
             Eigen::Index most = 0;
             n.cwiseAbs().maxCoeff(&most);
             const double sign = n[most] < 0 ? -1 : 1;
             n = Vector3::Zero();
             n[most] = sign;
           }>},
    Mutant{"normal-always-x", "always the x axis", "normal-always-x", nullptr,
           normals<[](Vector3& n, S) { n = Vector3(1, 0, 0); }>},
    Mutant{"normal-always-y", "always the y axis", "normal-always-y", nullptr,
           normals<[](Vector3& n, S) { n = Vector3(0, 1, 0); }>},
    Mutant{"normal-always-minus-y", "always against the y axis", "normal-always-minus-y", nullptr,
           normals<[](Vector3& n, S) { n = Vector3(0, -1, 0); }>},
    Mutant{"normal-always-z", "always the z axis", "normal-always-z", nullptr,
           normals<[](Vector3& n, S) { n = Vector3(0, 0, 1); }>},
    Mutant{"normal-from-smaller", "from the smaller sphere to the larger", "normal-from-smaller", nullptr,
           normals<[](Vector3& n, S s) {
             if (s.r2 < s.r1) n = Vector3(-n);
           }>},
    Mutant{"normal-over-square", "divided by D", "normal-over-square", nullptr,
           normals<[](Vector3& n, S s) { n /= rounded(s.distance); }>},
    Mutant{"normal-over-radii", "divided by the radius sum", "normal-over-radii", nullptr,
           normals<[](Vector3& n, S s) { n *= rounded(s.distance / (s.r1 + s.r2)); }>},
    Mutant{"normal-over-reach", "divided by the reach", "normal-over-reach", nullptr,
           normals<[](Vector3& n, S s) { n *= rounded(s.distance / s.reach); }>},
    Mutant{"normal-over-coordinate-sum", "divided by the sum of the components", "normal-over-coordinate-sum", nullptr,
           normals<[](Vector3& n, S) { n /= n.lpNorm<1>(); }>},
    Mutant{"normal-over-largest", "divided by the largest component", "normal-over-largest", nullptr,
           normals<[](Vector3& n, S) { n /= n.lpNorm<Eigen::Infinity>(); }>},
    Mutant{"normal-too-long", "a ten-thousandth too long", "normal-wrong-length", nullptr,
           normals<[](Vector3& n, S) { n *= 1.0001; }>},
    Mutant{"normal-halved", "of length 1/2", "normal-wrong-length", nullptr, normals<[](Vector3& n, S) { n /= 2; }>},
    Mutant{"normal-zero", "zero everywhere", "normal-zero", nullptr,
           [](const Query&, Claim& claim) { in_contact(claim, [](ContactClaim& c) { c.normal = Vector3::Zero(); }); }},
    Mutant{"normal-reversed-deep", "reversed where one sphere lies inside the other", "delta-reversed", nullptr,
           [](const Query& q, Claim& claim) {
             in_direction(q, claim, [&](ContactClaim& c) {
               const WideSpheres s(q);
               if (q.balls() != nullptr && s.distance <= std::abs(s.r1 - s.r2)) c.normal = Vector3(-*c.normal);
             });
           }},
};

// The contact points: c1 + r1 n and c2 - r2 n.
const std::array kPoints{
    Mutant{"point1-far-side", "the sign before the normal (first)", "points-far-side", nullptr,
           points<kFirst, [](const Surface& s) { return Vector3(s.center - s.radius * s.out); }>},
    Mutant{"points-far-side", "the sign before the normal", "points-far-side", nullptr,
           points<kBoth, [](const Surface& s) { return Vector3(s.center - s.radius * s.out); }>},
    Mutant{"point1-centre", "the radius left out (first)", "points-at-centre", nullptr,
           points<kFirst, [](const Surface& s) { return Vector3(s.center); }>},
    Mutant{"point2-centre", "the radius left out (second)", "points-at-centre", nullptr,
           points<kSecond, [](const Surface& s) { return Vector3(s.center); }>},
    Mutant{"points-centre", "the radius left out", "points-at-centre", nullptr,
           points<kBoth, [](const Surface& s) { return Vector3(s.center); }>},
    Mutant{"point1-other-radius", "the radius of the other sphere (first)", "radii-exchanged", nullptr,
           points<kFirst, [](const Surface& s) { return Vector3(s.center + s.other_radius * s.out); }>},
    Mutant{"point2-other-radius", "the radius of the other sphere (second)", "radii-exchanged", nullptr,
           points<kSecond, [](const Surface& s) { return Vector3(s.center + s.other_radius * s.out); }>},
    Mutant{"points-other-radius", "the radius of the other sphere", "radii-exchanged", nullptr,
           points<kBoth, [](const Surface& s) { return Vector3(s.center + s.other_radius * s.out); }>},
    Mutant{"point1-other-centre", "the centre of the other sphere (first)", "points-from-other-centre", nullptr,
           points<kFirst, [](const Surface& s) { return Vector3(s.other_center + s.radius * s.out); }>},
    Mutant{"point2-other-centre", "the centre of the other sphere (second)", "points-from-other-centre", nullptr,
           points<kSecond, [](const Surface& s) { return Vector3(s.other_center + s.radius * s.out); }>},
    Mutant{"points-other-centre", "the centre of the other sphere", "points-from-other-centre", nullptr,
           points<kBoth, [](const Surface& s) { return Vector3(s.other_center + s.radius * s.out); }>},
    Mutant{"point1-local", "the centre left out (first)", "points-local", nullptr,
           points<kFirst, [](const Surface& s) { return Vector3(s.radius * s.out); }>},
    Mutant{"point2-local", "the centre left out (second)", "points-local", nullptr,
           points<kSecond, [](const Surface& s) { return Vector3(s.radius * s.out); }>},
    Mutant{"points-local", "the centre left out", "points-local", nullptr,
           points<kBoth, [](const Surface& s) { return Vector3(s.radius * s.out); }>},
    Mutant{"points-negated", "the sign of the whole point", "points-world-negated", nullptr,
           points<kBoth, [](const Surface& s) { return Vector3(-(s.center + s.radius * s.out)); }>},
    Mutant{"point1-past-alarm", "the alarm distance added to the radius (first)", "points-past-alarm", nullptr,
           points<kFirst, [](const Surface& s) { return Vector3(s.center + (s.radius + s.alarm) * s.out); }>},
    Mutant{"point2-past-alarm", "the alarm distance added to the radius (second)", "points-past-alarm", nullptr,
           points<kSecond, [](const Surface& s) { return Vector3(s.center + (s.radius + s.alarm) * s.out); }>},
    Mutant{"points-past-alarm", "the alarm distance added to the radius", "points-past-alarm", nullptr,
           points<kBoth, [](const Surface& s) { return Vector3(s.center + (s.radius + s.alarm) * s.out); }>},
    Mutant{"point1-past-contact", "the contact distance added to the radius (first)", "points-past-contact", nullptr,
           points<kFirst, [](const Surface& s) { return Vector3(s.center + (s.radius + s.contact) * s.out); }>},
    Mutant{"point2-past-contact", "the contact distance added to the radius (second)", "points-past-contact", nullptr,
           points<kSecond, [](const Surface& s) { return Vector3(s.center + (s.radius + s.contact) * s.out); }>},
    Mutant{"points-past-contact", "the contact distance added to the radius", "points-past-contact", nullptr,
           points<kBoth, [](const Surface& s) { return Vector3(s.center + (s.radius + s.contact) * s.out); }>},
    Mutant{"point1-below-contact", "the contact distance subtracted from the radius (first)", "points-below-contact",
           nullptr,
           points<kFirst, [](const Surface& s) { return Vector3(s.center + (s.radius - s.contact) * s.out); }>},
    Mutant{"point2-below-contact", "the contact distance subtracted from the radius (second)", "points-below-contact",
           nullptr,
           points<kSecond, [](const Surface& s) { return Vector3(s.center + (s.radius - s.contact) * s.out); }>},
    Mutant{"points-below-contact", "the contact distance subtracted from the radius", "points-below-contact", nullptr,
           points<kBoth, [](const Surface& s) { return Vector3(s.center + (s.radius - s.contact) * s.out); }>},
    Mutant{"point1-double-radius", "the diameter in the place of the radius (first)", "radii-doubled", nullptr,
           points<kFirst, [](const Surface& s) { return Vector3(s.center + 2 * s.radius * s.out); }>},
    Mutant{"point2-double-radius", "the diameter in the place of the radius (second)", "radii-doubled", nullptr,
           points<kSecond, [](const Surface& s) { return Vector3(s.center + 2 * s.radius * s.out); }>},
    Mutant{"points-double-radius", "the diameter in the place of the radius", "radii-doubled", nullptr,
           points<kBoth, [](const Surface& s) { return Vector3(s.center + 2 * s.radius * s.out); }>},
    Mutant{"point1-half-radius", "half the radius (first)", "radii-halved", nullptr,
           points<kFirst, [](const Surface& s) { return Vector3(s.center + s.radius / 2 * s.out); }>},
    Mutant{"point2-half-radius", "half the radius (second)", "radii-halved", nullptr,
           points<kSecond, [](const Surface& s) { return Vector3(s.center + s.radius / 2 * s.out); }>},
    Mutant{"points-half-radius", "half the radius", "radii-halved", nullptr,
           points<kBoth, [](const Surface& s) { return Vector3(s.center + s.radius / 2 * s.out); }>},
    Mutant{"point1-origin", "the point never written (first)", "points-zero", nullptr,
           points<kFirst, [](const Surface& s) { return Vector3(0 * s.center); }>},
    Mutant{"point2-origin", "the point never written (second)", "points-zero", nullptr,
           points<kSecond, [](const Surface& s) { return Vector3(0 * s.center); }>},
    Mutant{"points-origin", "the point never written", "points-zero", nullptr,
           points<kBoth, [](const Surface& s) { return Vector3(0 * s.center); }>},
    Mutant{"points-x-centre", "x of the centre", "points-x-centre", nullptr, points<kBoth, centre_on<0>>},
    Mutant{"points-x-mirrored", "the sign before x of the normal", "points-x-mirrored", nullptr,
           points<kBoth, mirrored_on<0>>},
    Mutant{"points-y-centre", "y of the centre", "points-y-centre", nullptr, points<kBoth, centre_on<1>>},
    Mutant{"points-y-mirrored", "the sign before y of the normal", "points-y-mirrored", nullptr,
           points<kBoth, mirrored_on<1>>},
    Mutant{"points-z-centre", "z of the centre", "points-z-centre", nullptr, points<kBoth, centre_on<2>>},
    Mutant{"points-z-mirrored", "the sign before z of the normal", "points-z-mirrored", nullptr,
           points<kBoth, mirrored_on<2>>},
    Mutant{
        "points-exchanged", "each point given for the other", "points-exchanged", nullptr,
        [](const Query&, Claim& claim) { in_contact(claim, [](ContactClaim& c) { std::swap(c.point1, c.point2); }); }},
    Mutant{"points-first-twice", "the first point given for both", "points-exchanged", nullptr,
           [](const Query&, Claim& claim) { in_contact(claim, [](ContactClaim& c) { c.point2 = c.point1; }); }},
    Mutant{"points-second-twice", "the second point given for both", "points-exchanged", nullptr,
           [](const Query&, Claim& claim) { in_contact(claim, [](ContactClaim& c) { c.point1 = c.point2; }); }},
    Mutant{"points-middle", "the middle of both given for each", "points-middle", nullptr,
           [](const Query&, Claim& claim) {
             in_contact(claim, [](ContactClaim& c) {
               const Vector3 middle = 0.5 * *c.point1 + 0.5 * *c.point2;
               c.point1 = c.point2 = middle;
             });
           }},
    Mutant{"points-not-unit", "delta in the place of the normal in the points alone", "points-not-unit", nullptr,
           [](const Query& q, Claim& claim) {
             in_direction(q, claim, [&](ContactClaim& c) {
               const Vector3 delta = balls(q).b.center - balls(q).a.center;
               c.point1 = Vector3(balls(q).a.center + balls(q).a.radius * delta);
               c.point2 = Vector3(balls(q).b.center - balls(q).b.radius * delta);
             });
           }},
};

// The decision about boxes: a.min <= b.max + alarm and b.min <= a.max + alarm on every axis.
const std::array kBoxDecisions{
    Mutant{"box-x-missing", "x left out", "x-ignored",
           change<Boxes>([](Boxes& b) { b.a.min[0] = b.a.max[0] = b.b.min[0] = b.b.max[0] = 0; })},
    Mutant{"box-x-low-missing", "a.min.x <= b.max.x + alarm left out", "box-x-low", nullptr,
           box_decisions<without<0, true>>},
    Mutant{"box-x-high-missing", "b.min.x <= a.max.x + alarm left out", "box-x-high", nullptr,
           box_decisions<without<0, false>>},
    Mutant{"box-y-missing", "y left out", "y-ignored",
           change<Boxes>([](Boxes& b) { b.a.min[1] = b.a.max[1] = b.b.min[1] = b.b.max[1] = 0; })},
    Mutant{"box-y-low-missing", "a.min.y <= b.max.y + alarm left out", "box-y-low", nullptr,
           box_decisions<without<1, true>>},
    Mutant{"box-y-high-missing", "b.min.y <= a.max.y + alarm left out", "box-y-high", nullptr,
           box_decisions<without<1, false>>},
    Mutant{"box-z-missing", "z left out", "z-ignored",
           change<Boxes>([](Boxes& b) { b.a.min[2] = b.a.max[2] = b.b.min[2] = b.b.max[2] = 0; })},
    Mutant{"box-z-low-missing", "a.min.z <= b.max.z + alarm left out", "box-z-low", nullptr,
           box_decisions<without<2, true>>},
    Mutant{"box-z-high-missing", "b.min.z <= a.max.z + alarm left out", "box-z-high", nullptr,
           box_decisions<without<2, false>>},
    Mutant{"box-first-side", "b.min never compared with a.max", "box-first-side", nullptr,
           box_decisions<[](const WideBox& a, const WideBox& b, Wide alarm) {
             return (a.min.array() <= b.max.array() + alarm).all();
           }>},
    Mutant{"box-second-side", "a.min never compared with b.max", "box-second-side", nullptr,
           box_decisions<[](const WideBox& a, const WideBox& b, Wide alarm) {
             return (b.min.array() <= a.max.array() + alarm).all();
           }>},
    Mutant{"box-one-axis-enough", "|| in the place of && between the axes", "one-axis-enough", nullptr,
           box_decisions<[](const WideBox& a, const WideBox& b, Wide alarm) {
             return ((a.min.array() <= b.max.array() + alarm) && (b.min.array() <= a.max.array() + alarm)).any();
           }>},
    Mutant{"box-alarm-subtracted", "- in the place of + before the alarm distance", "alarm-subtracted", nullptr,
           box_decisions<[](const WideBox& a, const WideBox& b, Wide alarm) {
             return ((a.min.array() <= b.max.array() - alarm) && (b.min.array() <= a.max.array() - alarm)).all();
           }>},
    Mutant{"box-alarm-first-missing", "the alarm distance missing beside b.max", "box-alarm-first", nullptr,
           box_decisions<[](const WideBox& a, const WideBox& b, Wide alarm) {
             return ((a.min.array() <= b.max.array()) && (b.min.array() <= a.max.array() + alarm)).all();
           }>},
    Mutant{"box-alarm-second-missing", "the alarm distance missing beside a.max", "box-alarm-second", nullptr,
           box_decisions<[](const WideBox& a, const WideBox& b, Wide alarm) {
             return ((a.min.array() <= b.max.array() + alarm) && (b.min.array() <= a.max.array())).all();
           }>},
    Mutant{"box-alarm-halved", "half the alarm distance", "alarm-halved",
           [](Query& q) {
             if (q.boxes() != nullptr) q.distances.alarm /= 2;
           }},
    Mutant{"box-contact-for-alarm", "the contact distance in the place of the alarm distance", "contact-for-alarm",
           [](Query& q) {
             if (q.boxes() != nullptr) q.distances.alarm = q.distances.contact;
           }},
    Mutant{"box-contact-widens", "the contact distance added to the alarm distance", "contact-widens",
           [](Query& q) {
             if (q.boxes() != nullptr) q.distances.alarm += q.distances.contact;
           }},
    Mutant{"box-inverted", "the answer negated", "inverted", nullptr,
           box_decisions<[](const WideBox& a, const WideBox& b, Wide alarm) {
             return !(((a.min.array() <= b.max.array() + alarm) && (b.min.array() <= a.max.array() + alarm)).all());
           }>},
    Mutant{"box-max-max", "max compared with max", "box-max-max", change<Boxes>([](Boxes& b) {
             b.a.min = b.a.max;
             b.b.min = b.b.max;
           })},
    Mutant{"box-centres", "the extents left out", "box-centres", nullptr,
           box_decisions<[](const WideBox& a, const WideBox& b, Wide alarm) {
             return (((a.min + a.max) / 2 - (b.min + b.max) / 2).array().abs() <= alarm).all();
           }>},
    Mutant{"box-extents-quarter", "half extents halved again", "box-extents-quarter", nullptr,
           box_decisions<[](const WideBox& a, const WideBox& b, Wide alarm) {
             return (((a.min + a.max) / 2 - (b.min + b.max) / 2).array().abs() <=
                     ((a.max - a.min) + (b.max - b.min)).array() / 4 + alarm)
                 .all();
           }>},
    Mutant{"box-euclidean", "the distance of the boxes in the place of each axis", "box-euclidean", nullptr,
           box_decisions<[](const WideBox& a, const WideBox& b, Wide alarm) {
             return (a.min - b.max).cwiseMax(b.min - a.max).cwiseMax(Wide{0}).stableNorm() <= alarm;
           }>},
    Mutant{"box-gap-sum", "the gaps added up", "box-gap-sum", nullptr,
           box_decisions<[](const WideBox& a, const WideBox& b, Wide alarm) {
             return (a.min - b.max).cwiseMax(b.min - a.max).cwiseMax(Wide{0}).sum() <= alarm;
           }>},
    Mutant{"box-corners-one", "the corners of the second box alone", "box-corners-one", nullptr,
           box_decisions<[](const WideBox& a, const WideBox& b, Wide alarm) {
             return (((b.min.array() >= a.min.array() - alarm) && (b.min.array() <= a.max.array() + alarm)) ||
                     ((b.max.array() >= a.min.array() - alarm) && (b.max.array() <= a.max.array() + alarm)))
                 .all();
           }>},
    Mutant{"box-contains", "containment in the place of overlap", "box-contains", nullptr,
           box_decisions<[](const WideBox& a, const WideBox& b, Wide alarm) {
             return ((a.min.array() >= b.min.array() - alarm) && (a.max.array() <= b.max.array() + alarm)).all() ||
                    ((b.min.array() >= a.min.array() - alarm) && (b.max.array() <= a.max.array() + alarm)).all();
           }>},
    Mutant{"box-inside-missed", "a box inside the other does not hit", "inside-missed", nullptr,
           [](const Query& q, Claim& claim) {
             if (q.boxes() == nullptr || at_edge(q)) return;
             const auto& [a, b] = *q.boxes();
             const auto in = [](const Box& x, const Box& y) {
               return (x.min.array() >= y.min.array()).all() && (x.max.array() <= y.max.array()).all();
             };
             if (in(a, b) || in(b, a)) decide(q, claim, false);
           }},
    Mutant{"box-axes-crossed", "the index of the second box off by one", "axes-crossed", change<Boxes>([](Boxes& b) {
             b.b.min = Vector3(b.b.min[1], b.b.min[2], b.b.min[0]);
             b.b.max = Vector3(b.b.max[1], b.b.max[2], b.b.max[0]);
           })},
    Mutant{"box-x-twice", "x used in the place of y", "x-twice", change<Boxes>([](Boxes& b) {
             for (Box* box : {&b.a, &b.b}) {
               box->min[1] = box->min[0];
               box->max[1] = box->max[0];
             }
           })},
};

// A sphere against a box: the nearest point of the box, and the way out of it.
const std::array kBallAndBox{
    Mutant{"in-box-depth-added", "+ in the place of - before the depth of a centre in the box",
           "sphere-box-depth-added", nullptr,
           [](const Query& q, Claim& claim) {
             in_box(q, claim, [&](const BallAndBox& s, ContactClaim& c) {
               c.value = rounded(depth_of_cores(s) - static_cast<Wide>(s.a.radius) - q.distances.contact);
             });
           }},
    Mutant{"in-box-farthest-face", "the largest depth of a centre in the box in the place of the least",
           "sphere-box-farthest-face", nullptr,
           with(leave_by,
                [](const auto& below_min, const auto& below_max) {
                  Face farthest{0, true};
                  Wide most = below_min[0];
                  for (Eigen::Index axis = 0; axis < 3; ++axis)
                    for (const bool is_min : {true, false})
                      if (const Wide depth = (is_min ? below_min : below_max)[axis]; depth > most) {
                        farthest = {axis, is_min};
                        most = depth;
                      }
                  return farthest;
                })},
    Mutant{"in-box-opposite-face", "the other face of the right axis", "sphere-box-opposite-face", nullptr,
           with(leave_by,
                [](const auto& below_min, const auto& below_max) {
                  Face nearest{0, true};
                  below_min.cwiseMin(below_max).minCoeff(&nearest.axis);
                  nearest.is_min = below_min[nearest.axis] > below_max[nearest.axis];
                  return nearest;
                })},
    Mutant{"in-box-first-face", "a centre in the box always leaves it by min.x", "sphere-box-first-face", nullptr,
           with(leave_by,
                [](const auto&, const auto&) {
                  return Face{0, true};
                })},
    Mutant{"in-box-normal-reversed", "the normal of a centre inside the box points out of it, and point1 goes with it",
           "sphere-box-normal-outward", nullptr,
           with(in_box,
                [](const BallAndBox& s, ContactClaim& c) {
                  if (depth_of_cores(s) == 0) return;
                  c.normal = Vector3(-*c.normal);
                  c.point1 = Vector3(s.a.center + s.a.radius * *c.normal);
                })},
    Mutant{"in-box-point2-centre", "the second point is not moved to the face", "sphere-box-point-in-box", nullptr,
           with(in_box, [](const BallAndBox& s, ContactClaim& c) { c.point2 = s.a.center; })},
    Mutant{"box-normal-to-middle", "the normal points to the middle of the box, and the points go with it",
           "sphere-box-normal-to-middle", nullptr,
           [](const Query& q, Claim& claim) {
             const BallAndBox* s = ball_and_box_of(q);
             if (s == nullptr || !claim.contact) return;
             const Vector3 apart = middle_of(s->b) - s->a.center;
             if (!(apart.stableNorm() > 0) || !std::isfinite(apart.stableNorm())) return;
             claim.contact->normal = Vector3(apart.stableNormalized());
             claim.contact->point1 = Vector3(s->a.center + s->a.radius * *claim.contact->normal);
           }},
    Mutant{"box-bounding-sphere", "the box taken for the sphere through its corners", "sphere-box-bounding-sphere",
           nullptr,
           [](const Query& q, Claim& claim) {
             const BallAndBox* s = ball_and_box_of(q);
             if (s == nullptr) return;
             const double radius =
                 std::min((s->b.max / 2 - s->b.min / 2).stableNorm(), std::numeric_limits<double>::max());
             claim = production_answer({Pair::sphere_sphere, Balls{s->a, {middle_of(s->b), radius}}, q.distances},
                                       PointConvention::nearest_surface);
           }},
    Mutant{"box-middle", "the extents of the box left out", "sphere-box-middle",
           rebox([](const Vector3&, Box& box) { box = resized(box, 0); })},
    Mutant{"box-extents-doubled", "full extents of the box taken for half extents", "sphere-box-extents-full",
           rebox([](const Vector3&, Box& box) { box = resized(box, 2); })},
    Mutant{"box-extents-halved", "half extents of the box halved again", "sphere-box-extents-halved",
           rebox([](const Vector3&, Box& box) { box = resized(box, 0.5); })},
    Mutant{"box-min-missing", "the centre clamped to max alone", "sphere-box-max-alone",
           rebox([](const Vector3&, Box& box) { box.min.setConstant(-std::numeric_limits<double>::max()); })},
    Mutant{"box-max-missing", "the centre clamped to min alone", "sphere-box-min-alone",
           rebox([](const Vector3&, Box& box) { box.max.setConstant(std::numeric_limits<double>::max()); })},
};

}  // namespace

std::span<const Mutant> own_mutants() {
  static const std::vector<Mutant> all = [] {
    std::vector<Mutant> list;
    for (const std::span<const Mutant> some :
         {std::span<const Mutant>(kSphereDecisions), std::span<const Mutant>(kNumbers),
          std::span<const Mutant>(kValues), std::span<const Mutant>(kNormals), std::span<const Mutant>(kPoints),
          std::span<const Mutant>(kBoxDecisions), std::span<const Mutant>(kBallAndBox)})
      list.insert(list.end(), some.begin(), some.end());
    return list;
  }();
  return all;
}

}  // namespace contact::engines
