// Mistakes that public engines really made, each in front of production.
#include "engines/zoo/mutating.hpp"

namespace contact::engines {
namespace {

const Vector3 kNoNumber = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
const double kNaN = std::numeric_limits<double>::quiet_NaN();

void negate_normal(const Query& q, Claim& claim) {
  in_direction(q, claim, [](ContactClaim& c) { c.normal = Vector3(-*c.normal); });
}
/// One point for both spheres, made from the claim's two balls.
constexpr auto both_points_at = [](const Query& q, Claim& claim, auto point) {
  in_contact(claim, [&](ContactClaim& c) { c.point1 = c.point2 = Vector3(point(balls(q).a, balls(q).b)); });
};
/// Whether the question has a number that is none.
bool has_nan(const Query& q) {
  bool nan = false;
  for_each_number(q, [&](const std::string&, double x) { nan = nan || std::isnan(x); });
  return nan;
}
void answer_hit(Claim& claim, bool hit) {
  claim = {};
  claim.overlap = hit;
}
bool is_flat(const Box& box) { return (box.min.array() == box.max.array()).any(); }

const std::array kReal{
    // Coincident centres and other degenerate directions.
    Mutant{"rapier-coincident-nan", "the normal is 0/0 where the centres coincide, and the points with it",
           "normal-not-finite", nullptr,
           [](const Query& q, Claim& claim) {
             if (coincident(q)) in_contact(claim, [](ContactClaim& c) { c.normal = c.point1 = c.point2 = kNoNumber; });
           },
           "https://github.com/dimforge/rapier/pull/60"},
    Mutant{"coal-overlap-nan-normal", "the normal is left NaN wherever the spheres overlap or touch",
           "normal-not-finite", nullptr,
           [](const Query& q, Claim& claim) {
             if (claim.contact && overlapping(q)) claim.contact->normal = kNoNumber;
           },
           "https://github.com/coal-library/coal/issues/344"},
    Mutant{"fcl-coincident-zero-normal", "where the centres coincide the difference is given as it is: a zero normal",
           "normal-zero", nullptr,
           [](const Query& q, Claim& claim) {
             if (!coincident(q)) return;
             in_contact(claim, [&](ContactClaim& c) {
               c.normal = Vector3::Zero();
               points_from_normal(q, c);
             });
           },
           "https://github.com/flexible-collision-library/fcl/pull/569"},
    Mutant{"coal-zero-normal-pinned", "a zero normal where the centres coincide, demanded by the engine's own test",
           "normal-zero", nullptr,
           [](const Query& q, Claim& claim) {
             if (coincident(q)) in_contact(claim, [](ContactClaim& c) { c.normal = Vector3::Zero(); });
           },
           "https://github.com/coal-library/coal/commit/68b13b7f067432debeafbac0a5cd161ebd822635"},
    Mutant{"phaser-circle-nan", "a division by a distance of 0 makes every number NaN where the centres coincide",
           "answer-not-finite", nullptr,
           [](const Query& q, Claim& claim) {
             if (!coincident(q)) return;
             in_contact(claim, [](ContactClaim& c) {
               c.normal = c.point1 = c.point2 = kNoNumber;
               c.value = kNaN;
             });
           },
           "https://github.com/phaserjs/phaser/pull/4519"},
    Mutant{"check2d-overlap-nan", "the normal alone is NaN where the centres coincide", "normal-not-finite", nullptr,
           [](const Query& q, Claim& claim) {
             if (coincident(q)) in_contact(claim, [](ContactClaim& c) { c.normal = kNoNumber; });
           },
           "https://github.com/nenjack/check2d/issues/11"},
    Mutant{"mathgl-distance-nan", "the value is NaN wherever the spheres overlap", "value-not-finite", nullptr,
           [](const Query& q, Claim& claim) {
             if (claim.contact && overlapping(q)) claim.contact->value = kNaN;
           },
           "https://github.com/uber-web/math.gl/pull/248"},
    Mutant{"sofa-null-distance-guard", "centres within an absolute 1e-15 count as coincident: normal (1, 0, 0)",
           "centres-within-1e-15", nullptr, [](const Query& q, Claim& claim) { guard(q, claim, 1e-15L, {1, 0, 0}); },
           "https://github.com/sofa-framework/sofa/commit/250a91f0080694e8731771361ec6b17cd69959f1"},
    Mutant{"lethe-absolute-centre-eps", "centres within an absolute 1e-12 count as coincident",
           "centres-within-1e-12", nullptr, [](const Query& q, Claim& claim) { guard(q, claim, 1e-12L, {1, 0, 0}); },
           "https://github.com/chaos-polymtl/lethe/pull/719"},

    // Swapped, reversed or mis-dispatched pairs.
    Mutant{"cute-swap-no-flip", "one order of the two types is served by swapping them, and the normal stays swapped",
           "delta-reversed", nullptr,
           [](const Query& q, Claim& claim) {
             if (q.pair == Pair::sphere_rigid_sphere) negate_normal(q, claim);
           },
           "https://github.com/RandyGaul/cute_headers/issues/53"},
    Mutant{"cute-same-arg-twice", "one pair of types passes the first shape as both", "first-shape-twice",
           [](Query& q) {
             if (q.pair == Pair::sphere_rigid_sphere) balls_of(q)->b = balls_of(q)->a;
           },
           nullptr, "https://github.com/RandyGaul/cute_headers/commit/5e3a64d42c3c124338361ab3dd5b5ce0a118ee5e"},
    Mutant{"bytearena-fixture-a-twice", "the first sphere's radius is read for the second too",
           "first-radius-for-both",
           change<Balls>([](Balls& b) { b.b.radius = b.a.radius; }),
           nullptr, "https://github.com/ByteArena/box2d/pull/16"},
    Mutant{"monogame-box-vs-itself", "a box is tested against itself", "always-hit",
           [](Query& q) {
             if (auto* b = boxes_of(q)) b->a = b->b;
             // The box hits itself whatever the sphere is.
             if (ball_and_box_of(q) != nullptr) q.distances.alarm = std::numeric_limits<double>::max();
           },
           nullptr, "https://github.com/MonoGame/MonoGame/pull/3167"},
    Mutant{"echo-flip-lost", "the flag that the pair was swapped is not passed on: each point is given for the other",
           "points-exchanged", nullptr,
           [](const Query& q, Claim& claim) {
             if (q.pair == Pair::sphere_rigid_sphere)
               in_contact(claim, [](ContactClaim& c) { std::swap(c.point1, c.point2); });
           },
           "https://github.com/AustinEast/echo/pull/41"},
    Mutant{"p2-overlap-unordered", "one order of the two types ends in an exception", "no-answer", nullptr,
           [](const Query& q, Claim& claim) {
             if (q.pair != Pair::sphere_rigid_sphere) return;
             claim = Claim::without(Claim::Status::error, "type confusion");
           },
           "https://github.com/schteppe/p2.js/pull/256"},
    Mutant{"rp3d-sphere-first-sign", "the normal always starts at the rigid sphere, and the points go with it",
           "delta-reversed", nullptr,
           [](const Query& q, Claim& claim) {
             if (q.pair == Pair::sphere_rigid_sphere) turn(q, claim, [](Vector3& n) { n = Vector3(-n); });
           },
           "https://github.com/DanielChappuis/reactphysics3d/commit/5da57a96c80be764d77e38478c33b64de2d9bc34"},
    Mutant{"ifc-swap-not-undone", "overlapping pairs are answered as (b, a), and not swapped back", "pair-swapped",
           nullptr,
           [](const Query& q, Claim& claim) {
             if (!claim.contact || coincident(q) || !overlapping(q)) return;
             negate_normal(q, claim);
             std::swap(claim.contact->point1, claim.contact->point2);
           },
           "https://github.com/IfcOpenShell/IfcOpenShell/pull/8424"},
    Mutant{"fcl-normal-two-conventions", "one kind of pair has its normals from second to first", "delta-reversed",
           nullptr,
           [](const Query& q, Claim& claim) {
             if (q.pair == Pair::rigid_sphere_rigid_sphere) negate_normal(q, claim);
           },
           "https://github.com/flexible-collision-library/fcl/issues/8"},
    Mutant{"dart-bullet-normal-reversed", "the normal points from second to first", "delta-reversed", nullptr,
           negate_normal, "https://github.com/dartsim/dart/pull/763"},
    Mutant{"newton-normal-negated", "the normal is stored from second to first, and the points are made from it",
           "delta-reversed", nullptr,
           with(turn, [](Vector3& n) { n = Vector3(-n); }),
           "https://github.com/newton-physics/newton/pull/2069"},
    Mutant{"nape-arbiter-swapped", "the normal's direction follows the order in which shapes were made",
           "normal-to-positive-x", nullptr,
           [](const Query& q, Claim& claim) {
             if (claim.contact && (*claim.contact->normal)[0] < 0) negate_normal(q, claim);
           },
           "https://github.com/deltaluca/nape/issues/102"},
    Mutant{"chipmunk-circle-poly-sign", "a wrong sign puts the second point on the far side", "points-far-side", nullptr,
           [](const Query& q, Claim& claim) {
             in_contact(claim, [&](ContactClaim& c) {
               c.point2 = Vector3(balls(q).b.center + balls(q).b.radius * *c.normal);
             });
           },
           "https://github.com/slembcke/Chipmunk2D/pull/161"},
    Mutant{"godot-sphere-box-axis", "one pair has its axis reversed, and both points pushed the same way",
           "delta-reversed", nullptr,
           [](const Query& q, Claim& claim) {
             if (q.pair != Pair::sphere_rigid_sphere && q.pair != Pair::sphere_cube) return;
             in_direction(q, claim, [&](ContactClaim& c) {
               c.point2 = Vector3(balls(q).b.center + balls(q).b.radius * *c.normal);
               c.normal = Vector3(-*c.normal);
             });
           },
           "https://github.com/godotengine/godot/pull/71447"},
    Mutant{"bullet-order-1e-5", "the points move by a part in 100000", "five-digits", nullptr,
           [](const Query& q, Claim& claim) {
             in_contact(claim, [&](ContactClaim& c) {
               c.point1 = Vector3(balls(q).a.center + balls(q).a.radius * (1 + 1e-5) * *c.normal);
             });
           },
           "https://github.com/bulletphysics/bullet3/issues/888"},

    // Contact points.
    Mutant{"fcl-point-far-side", "the one contact point lies half a distance behind the first centre",
           "points-behind", nullptr,
           with(both_points_at, [](const Ball& a, const Ball& b) { return Vector3(1.5 * a.center - 0.5 * b.center); }),
           "https://github.com/flexible-collision-library/fcl/pull/14"},
    Mutant{"fcl-point-radius-weighted", "the one contact point divides the centre line by the radii", "points-weighted",
           nullptr,
           with(both_points_at, [](const Ball& x, const Ball& y) {
             const double radii = x.radius + y.radius;
             return Vector3(x.center + (radii > 0 ? x.radius / radii : 0.5) * (y.center - x.center));
           }),
           "https://github.com/flexible-collision-library/fcl/pull/87"},
    Mutant{"box2d-centre-average", "overlapping spheres have both points half way between the centres",
           "points-centre-middle", nullptr,
           [](const Query& q, Claim& claim) {
             if (claim.contact && overlapping(q))
               both_points_at(q, claim, [](const Ball& a, const Ball& b) { return Vector3(0.5 * a.center + 0.5 * b.center); });
           },
           "https://github.com/erincatto/box2d/issues/672"},
    Mutant{"cute-centre-average", "both points lie half way between the centres", "points-centre-middle", nullptr,
           with(both_points_at, [](const Ball& a, const Ball& b) { return Vector3(0.5 * a.center + 0.5 * b.center); }),
           "https://github.com/RandyGaul/cute_headers/pull/38"},
    Mutant{"coal-points-collapsed", "overlapping spheres have one point and no normal", "normal-zero", nullptr,
           [](const Query& q, Claim& claim) {
             if (!claim.contact || coincident(q) || !overlapping(q)) return;
             const Vector3 middle = 0.5 * *claim.contact->point1 + 0.5 * *claim.contact->point2;
claim.contact->point1 = claim.contact->point2 = middle;
             claim.contact->normal = Vector3::Zero();
           },
           "https://github.com/coal-library/coal/commit/c32390b28915216c49c423058c70d8decb3256e7"},
    Mutant{"coal-box-sphere-point-sign", "spheres that are apart have the second point on the far side",
           "points-far-side", nullptr,
           [](const Query& q, Claim& claim) {
             if (!claim.contact || overlapping(q)) return;
             if (q.pair == Pair::sphere_cube)  // the box comes second
               claim.contact->point1 = Vector3(balls(q).a.center - balls(q).a.radius * *claim.contact->normal);
             claim.contact->point2 = Vector3(balls(q).b.center + balls(q).b.radius * *claim.contact->normal);
           },
           "https://github.com/coal-library/coal/commit/12d7983edd44138372240c5dd6e617941ec34d89"},
    Mutant{"sofa-point-is-centre", "the point of a deformable sphere is its centre", "points-at-centre", nullptr,
           [](const Query& q, Claim& claim) {
             in_contact(claim, [&](ContactClaim& c) {
               if (!q.first_is_rigid()) c.point1 = balls(q).a.center;
               if (!q.second_is_rigid()) c.point2 = balls(q).b.center;
             });
           },
           "https://github.com/sofa-framework/sofa/issues/47"},

    // Value, depth, margins.
    Mutant{"fcl-minus-one-sentinel", "the value of every overlap is -1", "value-minus-one", nullptr,
           [](const Query& q, Claim& claim) {
             if (claim.contact && overlapping(q)) claim.contact->value = -1;
           },
           "https://github.com/flexible-collision-library/fcl/pull/172"},
    Mutant{"fcl-touching-lost", "the deepest contact starts above 0, so that exact touching has none", "edge-open",
           nullptr,
           [](const Query& q, Claim& claim) {
             if (claim.contact && at_edge(q)) claim.contact.reset();
           },
           "https://github.com/flexible-collision-library/fcl/pull/544"},
    Mutant{"fcl-radius-not-subtracted", "the radii are missing in the value", "radii-missing", nullptr,
           with(revalue, [](const WideSpheres& s) { return s.distance - s.contact; }),
           "https://github.com/flexible-collision-library/fcl/commit/fc638a2882fa1f586698f298960353beec9d1a41"},
    Mutant{"coal-distance-is-bool", "the value is a comparison: distance > r1 + r2", "value-bool", nullptr,
           with(revalue, [](const WideSpheres& s) { return Wide(s.distance > s.r1 + s.r2 ? 1 : 0); }),
           "https://github.com/coal-library/coal/commit/580334d1d62be249fef44047e897eb9621f2db44"},
    Mutant{"coal-upper-bound-lt-margin", "an early exit at a bound below the margin misses contacts", "alarm-capped",
           [](Query& q) {
             if (auto* b = balls_of(q))
               q.distances.alarm = std::min({q.distances.alarm, b->a.radius, b->b.radius});
           },
           nullptr, "https://github.com/coal-library/coal/pull/310"},
    Mutant{"coal-broadphase-no-margin", "the boxes of the broad phase lack the alarm distance", "alarm-ignored",
           [](Query& q) { q.distances.alarm = 0; }, nullptr, "https://github.com/coal-library/coal/issues/625"},
    Mutant{"sofacuda-dist-plus-two", "2 is added to the distance", "value-plus-two", nullptr,
           with(revalue, [](const WideSpheres& s) { return s.value() + 2; }),
           "https://github.com/sofa-framework/sofa/commit/77643121a655be68d73eb4225637d9833bb8844b"},
    Mutant{"sofa-rigid-radius-commented", "the radius of a rigid second sphere is missing in the value",
           "second-radius-missing", nullptr,
           [](const Query& q, Claim& claim) {
             if (q.second_is_rigid())
               revalue(q, claim, [](const WideSpheres& s) { return s.distance - s.r1 - s.contact; });
           },
           "https://github.com/sofa-framework/sofa/pull/6204"},
    Mutant{"newton-thickness-only", "thickness takes the place of radius and thickness", "radii-missing", nullptr,
           [](const Query& q, Claim& claim) {
             decide_spheres(q, claim, [](const WideSpheres& s) { return s.distance <= s.alarm; });
             revalue(q, claim, [](const WideSpheres& s) { return s.distance - s.contact; });
           },
           "https://github.com/newton-physics/newton/pull/156"},
    Mutant{"newton-radius-mismatch", "the radii are subtracted from the value twice", "radii-doubled", nullptr,
           with(revalue, [](const WideSpheres& s) { return s.value() - s.r1 - s.r2; }),
           "https://github.com/newton-physics/newton/pull/3854"},
    Mutant{"newton-boxbox-margin-lost", "boxes lose the alarm distance on the way", "alarm-ignored",
           [](Query& q) {
             if (q.boxes() != nullptr) q.distances.alarm = 0;
           },
           nullptr, "https://github.com/newton-physics/newton/pull/933"},
    Mutant{"mjx-dist-sentinel", "the value of spheres that are apart is 1", "value-one", nullptr,
           [](const Query& q, Claim& claim) {
             if (claim.contact && !overlapping(q)) claim.contact->value = 1;
           },
           "https://github.com/google-deepmind/mujoco/issues/1473"},
    Mutant{"mujoco-box-sphere-depth", "a sphere inside the other has its depth from the wrong side",
           "value-containment", nullptr,
           [](const Query& q, Claim& claim) {
             revalue(q, claim, [&](const WideSpheres& s) {
               const Wide apart = std::abs(s.r1 - s.r2);
               return q.balls() != nullptr && s.distance <= apart ? s.distance - apart - s.contact : s.value();
             });
           },
           "https://github.com/google-deepmind/mujoco/issues/2206"},
    Mutant{"tesseract-margin-doubled", "both boxes are grown by the whole alarm distance", "alarm-doubled",
           [](Query& q) {
             if (q.boxes() != nullptr) q.distances.alarm *= 2;
           },
           nullptr, "https://github.com/tesseract-robotics/tesseract/pull/1198"},
    Mutant{"avian-tight-vs-fat", "the overlap test knows the alarm distance and the contact does not",
           "alarm-ignored", nullptr,
           [](const Query& q, Claim& claim) {
             if (claim.contact && !overlapping(q)) claim.contact.reset();
           },
           "https://github.com/avianphysics/avian/pull/952"},
    Mutant{"bullet-04-margin", "a margin of 0.04 stays in the value", "value-less-margin", nullptr,
           with(revalue, [](const WideSpheres& s) { return s.value() - 0.04L; }),
           "https://github.com/jsk-ros-pkg/jsk_roseus/issues/616"},
    Mutant{"bullet-threshold-unused", "spheres are tested against another threshold than the alarm distance",
           "contact-for-alarm",
           [](Query& q) {
             if (q.balls() != nullptr) q.distances.alarm = q.distances.contact;
           },
           nullptr, "https://github.com/bulletphysics/bullet3/issues/1825"},
    Mutant{"jme-sphere-silent", "one kind of pair never reports a contact", "never-hit", nullptr,
           [](const Query& q, Claim& claim) {
             if (q.pair == Pair::sphere_sphere) claim.contact.reset();
           },
           "https://github.com/jMonkeyEngine/jmonkeyengine/issues/1029"},
    Mutant{"proximity-read-as-contact", "a pair within the alarm distance is read as touching", "value-not-positive",
           nullptr,
           with(revalue, [](const WideSpheres& s) { return std::min(Wide{0}, s.value()); }),
           "https://github.com/strands-labs/robots/issues/1781"},
    Mutant{"genesis-gjk-misses", "an iteration that does not converge misses oblique overlaps", "oblique-missed",
           nullptr,
           [](const Query& q, Claim& claim) {
             decide_spheres(q, claim, [&](const WideSpheres& s) {
               return claim.overlap.value() && (s.d[0] == 0 || s.d[1] == 0 || s.d[2] == 0);
             });
           },
           "https://github.com/Genesis-Embodied-AI/genesis-world/pull/2525"},
    Mutant{"rubeus-gap-sum", "the gap is the sum of the coordinate differences", "coordinate-sum", nullptr,
           with(revalue, [](const WideSpheres& s) {
             return std::abs(s.d[0]) + std::abs(s.d[1]) + std::abs(s.d[2]) - s.r1 - s.r2 - s.contact;
           }),
           "https://github.com/sdslabs/Rubeus/issues/58"},

    // The boolean test.
    Mutant{"collision-rs-squared-vs-linear", "the squared distance is compared with the plain sum",
           "squared-against-sum", nullptr,
           with(decide_spheres, [](const WideSpheres& s) { return s.D <= s.reach; }),
           "https://github.com/rustgd/collision-rs/pull/82"},
    Mutant{"fna-contains-typo", "a typo compares the squared distance with a product of the radii", "radii-product",
           nullptr,
           with(decide_spheres, [](const WideSpheres& s) { return s.D <= s.r1 * s.r2 * (s.r1 + s.r2); }),
           "https://github.com/FNA-XNA/FNA/pull/119"},
    Mutant{"slimdx-two-r1", "the test uses twice the first radius", "first-radius-for-both", nullptr,
           with(decide_spheres, [](const WideSpheres& s) { return s.distance <= s.alarm + 2 * s.r1; }),
           "https://github.com/slimdx/slimdx/issues/480"},
    Mutant{"bevy-mixed-strictness", "spheres are tested with < and boxes with <=", "edge-open", nullptr,
           [](const Query& q, Claim& claim) {
             if (q.has_distance() && at_edge(q)) decide(q, claim, false);
           },
           "https://github.com/bevyengine/bevy/pull/11439"},
    Mutant{"joml-touch-flip", "boxes that touch do not count", "edge-open", nullptr,
           [](const Query& q, Claim& claim) {
             if (q.boxes() != nullptr && at_edge(q)) decide(q, claim, false);
           },
           "https://github.com/JOML-CI/JOML/commit/368a866351aefd6d8f8d7cfe149046af594ef89f"},
    Mutant{"rp3d-sqrt-depth-zero", "a contact whose depth rounds to zero is lost", "rounding", nullptr,
           [](const Query& q, Claim& claim) {
             if (!claim.contact) return;
             const auto& [a, b] = balls(q);
             const double reach = a.radius + b.radius + q.distances.alarm;
             if (reach > 0 && std::isfinite(reach) && reach - rounded(WideSpheres(q).distance) == 0)
               claim.contact.reset();
           },
           "https://github.com/DanielChappuis/reactphysics3d/commit/44e1b12aaf257479611c2560281dcd529d4775f7"},
    Mutant{"newton-f32-threshold", "the test is made in single precision", "single-decision", nullptr,
           with(decide_spheres, [](const WideSpheres& s) {
             return static_cast<float>(s.distance) <= static_cast<float>(s.reach);
           }),
           "https://github.com/newton-physics/newton/issues/3233"},
    Mutant{"cgal-shell-vs-ball", "a sphere is a surface: one inside the other does not hit", "inside-missed", nullptr,
           [](const Query& q, Claim& claim) {
             decide_spheres(q, claim, [&](const WideSpheres& s) {
               if (q.balls() == nullptr) return claim.overlap.value();
               return claim.overlap.value() && (s.distance > std::abs(s.r1 - s.r2) || s.distance == 0 || at_edge(q));
             });
           },
           "https://github.com/CGAL/cgal/issues/6404"},
    Mutant{"cgal-2d-filter-from-3d", "the filter's error bound is too small: some rounded decisions are believed",
           "rounding", nullptr,
           [](const Query& q, Claim& claim) {
             decide_spheres(q, claim, [&](const WideSpheres& s) {
               const double distance = rounded(s.distance);
               const double reach = rounded(s.alarm) + (rounded(s.r1) + rounded(s.r2));
               return distance == reach ? true : claim.overlap.value();
             });
           },
           "https://github.com/CGAL/cgal/pull/8891"},
    Mutant{"bevy-corner-test", "boxes are tested by their corners", "box-corners", nullptr,
           with(decide_boxes, [](const WideBox& a, const WideBox& b, Wide alarm) {
             const auto has_corner_in = [alarm](const WideBox& of, const WideBox& box) {
               const auto in = [&](const auto& c) {
                 return (c.array() >= box.min.array() - alarm) && (c.array() <= box.max.array() + alarm);
               };
               return (in(of.min) || in(of.max)).all();
             };
             return has_corner_in(a, b) || has_corner_in(b, a);
           }),
           "https://github.com/bevyengine/bevy/issues/4478"},

    // Boxes.
    Mutant{"falcor-volume-overlap", "the common volume of boxes must be more than 0", "edge-open", nullptr,
           [](const Query& q, Claim& claim) {
             if (q.boxes() == nullptr) return;
             const auto& [a, b] = *q.boxes();
             const bool flat = q.distances.alarm == 0 && (is_flat(a) || is_flat(b));
             if (flat || at_edge(q)) decide(q, claim, false);
           },
           "https://github.com/NVIDIAGameWorks/Falcor/issues/435"},
    Mutant{"playform-flat-never", "a box of no size overlaps nothing", "box-flat-missed", nullptr,
           [](const Query& q, Claim& claim) {
             if (q.boxes() != nullptr && (is_flat(q.boxes()->a) || is_flat(q.boxes()->b))) decide(q, claim, false);
           },
           "https://github.com/bfops/playform/issues/118"},
    Mutant{"fcl-infinite-aabb", "a box starts from minus to plus the largest number, so that nothing shrinks it",
           "always-hit", nullptr,
           with(decide_boxes, [](const WideBox&, const WideBox&, Wide) { return true; }),
           "https://github.com/flexible-collision-library/fcl/issues/248"},
    Mutant{"sofa-bbox-else-if", "the minimum of a box of one element is never set, and stays the largest number",
           "never-hit", nullptr,
           with(decide_boxes, [](const WideBox&, const WideBox&, Wide) { return false; }),
           "https://github.com/sofa-framework/sofa/commit/15f432c78df351ecf04ae7c9842465c612815878"},
    Mutant{"sofa-bbox-double-return", "the bounding box is never computed, and stays infinite", "always-hit", nullptr,
           with(decide_boxes, [](const WideBox&, const WideBox&, Wide) { return true; }),
           "https://github.com/sofa-framework/sofa/pull/5589"},
    Mutant{"coal-merge-noop", "a box grown by a second corner drops the result: it is its first corner",
           "box-min-min",
           change<Boxes>([](Boxes& b) {
             b.a.max = b.a.min;
             b.b.max = b.b.min;
           }),
           nullptr, "https://github.com/coal-library/coal/commit/48ba15acba02b9d4915dcb9223e26ef41a008904"},
    Mutant{"joml-setmin-sets-max", "setting the minimum of a box sets its maximum: the minimum stays 0",
           "box-min-zero", nullptr,
           with(decide_boxes, [](const WideBox& a, const WideBox& b, Wide alarm) {
             return (b.max.array() + alarm >= 0).all() && (a.max.array() + alarm >= 0).all();
           }),
           "https://github.com/JOML-CI/JOML/commit/edf8c78033e313b6863cebf437fb79b6f8ae36d7"},
    Mutant{"raytracers-centre-is-max", "the centre of a box is min + max - min: its maximum", "box-centre-is-max",
           nullptr,
           with(decide_boxes, [](const WideBox& a, const WideBox& b, Wide alarm) {
             const auto half = (a.max - a.min).array() / 2 + (b.max - b.min).array() / 2;
             return ((a.max - b.max).array().abs() <= half + alarm).all();
           }),
           "https://github.com/athas/raytracers/issues/10"},
    Mutant{"three-radius-minus-one", "a negative radius is squared, and hits", "accepts-negative",
           nullptr,
           [](const Query& q, Claim& claim) {
             if (q.balls() != nullptr && (balls(q).a.radius < 0 || balls(q).b.radius < 0)) answer_hit(claim, true);
           },
           "https://github.com/mrdoob/three.js/issues/31187", Origin::real, true},
    Mutant{"rtiow-negative-radius-box", "the box of a negative radius is inside out, and never hits",
           "accepts-negative", nullptr,
           [](const Query& q, Claim& claim) {
             if (q.balls() != nullptr && (balls(q).a.radius < 0 || balls(q).b.radius < 0)) answer_hit(claim, false);
           },
           "https://github.com/RayTracing/raytracing.github.io/issues/532", Origin::real, true},
    Mutant{"byro-negative-half-extent", "a half extent becomes negative and is then cut off at 0.001",
           "box-z-extent-lost",
           change<Boxes>([](Boxes& b) {
             for (Box* box : {&b.a, &b.b}) {
               const double middle = box->min[2] / 2 + box->max[2] / 2;
               box->min[2] = middle - 1e-3;
               box->max[2] = middle + 1e-3;
             }
           }),
           nullptr, "https://github.com/matiaszanolli/ByroRedux/issues/2204"},
    Mutant{"unity-extents-two-meanings", "full extents of boxes are taken for half extents", "box-extents-full",
           nullptr,
           with(decide_boxes, [](const WideBox& a, const WideBox& b, Wide alarm) {
             const auto apart = ((a.min + a.max) / 2 - (b.min + b.max) / 2).array().abs();
             return (apart <= (a.max - a.min).array() + (b.max - b.min).array() + alarm).all();
           }),
           "https://github.com/Unity-Technologies/Unity.Mathematics/pull/141"},
    Mutant{"gzmath-extent-null", "a box keeps its mark for being empty after its corners were set", "never-hit", nullptr,
           with(decide_boxes, [](const WideBox&, const WideBox&, Wide) { return false; }),
           "https://github.com/gazebosim/gz-math/issues/72"},
    Mutant{"gfm-nan-contained", "every rejecting comparison with NaN is false, so that boxes with NaN hit",
           "accepts-nan", nullptr,
           [](const Query& q, Claim& claim) {
             if (q.boxes() != nullptr && has_nan(q)) answer_hit(claim, true);
           },
           "https://github.com/d-gamedev-team/gfm/issues/73", Origin::real, true},
    Mutant{"gamemaker-nan-hits-all", "a position that is NaN collides with everything", "accepts-nan", nullptr,
           [](const Query& q, Claim& claim) {
             if (q.balls() != nullptr && has_nan(q)) answer_hit(claim, true);
           },
           "https://github.com/YoYoGames/GameMaker-Bugs/issues/10446", Origin::real, true},

    // A sphere against a box.
    Mutant{"mujoco-in-box-depth", "a centre in the box has the value of one on its surface: minus the radius",
           "sphere-box-depth-missing", nullptr,
           [](const Query& q, Claim& claim) {
             in_box(q, claim, [&](const BallAndBox& s, ContactClaim& c) {
               c.value = rounded(-static_cast<Wide>(s.a.radius) - q.distances.contact);
             });
           },
           "https://github.com/google-deepmind/mujoco/issues/2206"},
    Mutant{"coal-box-sphere-inside", "a centre in the box: its normal is 0/0, and no face enters the value",
           "normal-not-finite", nullptr,
           [](const Query& q, Claim& claim) {
             in_box(q, claim, [&](const BallAndBox& s, ContactClaim& c) {
               c.normal = c.point1 = kNoNumber;
               c.point2 = s.a.center;
               c.value = rounded(-static_cast<Wide>(s.a.radius) - q.distances.contact);
             });
           },
           "https://github.com/coal-library/coal/commit/fdbffe99a85762aad2f22d1369ebba09a833d374"},
    Mutant{"tornago-inside-box-nan", "the normal is NaN where the centre is the middle of the box", "sphere-box-middle-not-finite",
           nullptr,
           with(in_box, [](const BallAndBox& s, ContactClaim& c) {
             if (s.a.center == middle_of(s.b)) c.normal = c.point1 = c.point2 = kNoNumber;
           }),
           "https://github.com/luxengine/tornago/issues/4"},
    Mutant{"cute-circle-aabb-face", "a centre in the box leaves it on the axis on which it is farthest from the middle",
           "sphere-box-face-by-offset", nullptr,
           with(leave_by, [](const auto& below_min, const auto& below_max) {
             Face face{0, true};
             (below_min - below_max).cwiseAbs().maxCoeff(&face.axis);
             face.is_min = below_min[face.axis] < below_max[face.axis];
             return face;
           }),
           "https://github.com/RandyGaul/cute_headers/issues/85"},
    Mutant{"panda-inside-missed", "a sphere wholly inside the box does not hit", "sphere-box-inside-missed", nullptr,
           [](const Query& q, Claim& claim) {
             decide_ball_and_box(q, claim, [&](const WideBallAndBox& s) {
               const bool inside = ((s.c.array() - s.r >= s.box.min.array()) && (s.c.array() + s.r <= s.box.max.array())).all();
               return claim.overlap.value() && !inside;
             });
           },
           "https://github.com/panda3d/panda3d/issues/1335"},
    Mutant{"nez-middle-in-circle", "a centre in the box hits only where the middle of the box is in reach",
           "sphere-box-middle-in-sphere", nullptr,
           [](const Query& q, Claim& claim) {
             decide_ball_and_box(q, claim, [&](const WideBallAndBox& s) {
               return coincident(q) ? (s.middle() - s.c).stableNorm() <= s.reach : claim.overlap.value();
             });
           },
           "https://github.com/prime31/Nez/pull/395"},
    Mutant{"cglm-inside-missed", "the distance is taken to a corner: to max only where the centre is beyond it",
           "sphere-box-corner-by-side", nullptr,
           with(decide_ball_and_box, [](const WideBallAndBox& s) {
             const Wide3 corner = (s.c.array() > s.box.max.array()).select(s.box.max, s.box.min);
             return (s.c - corner).stableNorm() <= s.reach;
           }),
           "https://github.com/recp/cglm/issues/179"},
    Mutant{"cglm-below-min-face", "a centre below min is clamped to max", "sphere-box-max-for-both", nullptr,
           with(decide_ball_and_box, [](const WideBallAndBox& s) {
             const auto outside = (s.c.array() < s.box.min.array()) || (s.c.array() > s.box.max.array());
             const Wide3 point = outside.select(s.box.max, s.c);
             return (s.c - point).stableNorm() <= s.reach;
           }),
           "https://github.com/recp/cglm/pull/496"},
    Mutant{"fna-box-sphere", "faces that the sphere reaches from inside count as a distance", "sphere-box-near-faces",
           nullptr,
           with(decide_ball_and_box, [](const WideBallAndBox& s) {
             Wide D = 0;
             for (int axis = 0; axis < 3; ++axis) {
               const Wide below = s.c[axis] - s.box.min[axis];
               const Wide above = s.box.max[axis] - s.c[axis];
               const Wide apart = below <= s.reach ? below : above <= s.reach ? above : 0;
               D += apart * apart;
             }
             return std::sqrt(D) <= s.reach;
           }),
           "https://github.com/FNA-XNA/FNA/pull/366"},
    Mutant{"kiwi-corner", "the sphere counts as its bounding box, so that corners are not rounded",
           "largest-coordinate", nullptr,
           with(decide_ball_and_box, [](const WideBallAndBox& s) {
             return ((s.c.array() + s.reach >= s.box.min.array()) && (s.c.array() - s.reach <= s.box.max.array())).all();
           }),
           "https://github.com/gamelab/kiwi.js/issues/163"},
    Mutant{"polytoria-closest-corner", "the nearest corner in the place of the nearest point", "sphere-box-corner",
           rebox([](const Vector3& c, Box& box) {
             const Vector3 middle = middle_of(box);
             const Vector3 corner = (c.array() / 2 < middle.array() / 2).select(box.min, box.max);
             box = {corner, corner};
           }),
           nullptr, "https://github.com/Polytoria/polytoria-game/issues/871"},
    Mutant{"macroquad-min-is-middle", "min of the box is taken for its middle", "sphere-box-min-for-middle",
           rebox([](const Vector3&, Box& box) {
             const Vector3 half = box.max / 2 - box.min / 2;
             box = {box.min - half, box.max - half};
           }),
           nullptr, "https://github.com/not-fl3/macroquad/issues/483"},
    Mutant{"raylib-integer-middle", "the middle of the box is cut off to integers", "sphere-box-integer-middle",
           nullptr,
           with(decide_ball_and_box, [](const WideBallAndBox& s) {
             const Wide3 middle = s.middle().unaryExpr([](Wide x) { return std::trunc(x); });
             const Wide3 apart = (s.c - middle).cwiseAbs() - (s.box.max - s.box.min) / 2;
             return apart.cwiseMax(Wide{0}).stableNorm() <= s.reach;
           }),
           "https://github.com/raysan5/raylib/issues/3575"},
    Mutant{"p2-outermost-points", "tested are corners of the box in the sphere, and outermost points of the sphere in the box",
           "sphere-box-outermost", nullptr,
           with(decide_ball_and_box, [](const WideBallAndBox& s) {
             const Wide3 to_corner = (s.box.min - s.c).cwiseAbs().cwiseMin((s.box.max - s.c).cwiseAbs());
             bool hit = to_corner.stableNorm() <= s.reach;
             for (int axis = 0; axis < 3; ++axis)
               for (const Wide by : {-s.reach, s.reach}) {
                 Wide3 point = s.c;
                 point[axis] += by;
                 hit = hit || ((point.array() >= s.box.min.array()) && (point.array() <= s.box.max.array())).all();
               }
             return hit;
           }),
           "https://github.com/schteppe/p2.js/issues/372"},
    Mutant{"fcl-box-point-local", "the point of the box is relative to its middle", "sphere-box-point-local", nullptr,
           [](const Query& q, Claim& claim) {
             const BallAndBox* s = ball_and_box_of(q);
             if (s != nullptr && claim.contact) claim.contact->point2 = Vector3(*claim.contact->point2 - middle_of(s->b));
           },
           "https://github.com/flexible-collision-library/fcl/issues/171"},
    Mutant{"brax-normal-plus-1e-6", "1e-6 is added to the distance that the normal is divided by", "normal-plus-1e-6",
           nullptr,
           [](const Query& q, Claim& claim) {
             in_direction(q, claim, [&](ContactClaim& c) {
               const Wide distance = WideSpheres(q).distance;
               *c.normal *= rounded(distance / (distance + 1e-6L));
             });
           },
           "https://github.com/google/brax/issues/57"},

    // Precision and scale.
    Mutant{"jolt-denormal-normalize", "a squared length up to the smallest normal float counts as zero",
           "centres-within-1e-19", nullptr, [](const Query& q, Claim& claim) { guard(q, claim, 1.084e-19L, {1, 0, 0}); },
           "https://github.com/jrouwe/JoltPhysics/commit/232fed57a52e5cd2f0259483892a087cc80507de"},
    Mutant{"glm-rsqrt-normalize", "an estimate of the reciprocal root, good to 12 bits, makes the normal",
           "normal-wrong-length", nullptr,
           with(turn, [](Vector3& n) { n *= 1 + 0x1.8p-12; }),
           "https://github.com/g-truc/glm/issues/1224"},
    Mutant{"ifclite-absolute-eps", "touching has an absolute tolerance of 1e-4", "tolerance-1e-4",
           [](Query& q) { q.distances.alarm += 1e-4; }, nullptr, "https://github.com/LTplus-AG/ifc-lite/pull/2604"},
    Mutant{"ifclite-eps-wrong-axis", "a tolerance grows with the largest coordinate, also along another axis",
           "tolerance-of-coordinates",
           [](Query& q) {
             if (const Boxes* b = q.boxes())
               q.distances.alarm += 1e-6 * std::max({b->a.min.array().abs().maxCoeff(), b->a.max.array().abs().maxCoeff(),
                                                     b->b.min.array().abs().maxCoeff(), b->b.max.array().abs().maxCoeff()});
           },
           nullptr, "https://github.com/LTplus-AG/ifc-lite/pull/2661"},
    Mutant{"libigl-norm-underflow", "squares of tiny differences vanish, and the normal is NaN", "square-range", nullptr,
           [](const Query& q, Claim& claim) {
             if (is_crossing(q.pair) || is_cast(q.pair)) return;
             in_direction(q, claim, [&](ContactClaim& c) {
               if ((balls(q).b.center - balls(q).a.center).squaredNorm() < std::numeric_limits<double>::min())
                 c.normal = kNoNumber;
             });
           },
           "https://github.com/libigl/libigl/pull/1344"},
    Mutant{"cannon-large-scale", "spheres of a radius from 10000 on pass through each other", "large-missed", nullptr,
           [](const Query& q, Claim& claim) {
             if (q.has_distance() && std::max(balls(q).a.radius, balls(q).b.radius) >= 1e4) decide(q, claim, false);
           },
           "https://github.com/schteppe/cannon.js/issues/127"},
    Mutant{"godot-jolt-axis-not-unit", "the difference of the centres is passed on where a unit vector is needed",
           "normal-not-unit", nullptr,
           [](const Query& q, Claim& claim) {
             in_direction(q, claim, [&](ContactClaim& c) { c.normal = Vector3(balls(q).b.center - balls(q).a.center); });
           },
           "https://github.com/godot-jolt/godot-jolt/pull/861"},
};

}  // namespace

std::span<const Mutant> real_mutants() { return kReal; }

}  // namespace contact::engines
