// The one list of laws: the report, docs/properties.md and JUnit use it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "proptests/law_functions.hpp"

namespace contact::proptests {
namespace {

using Reason = std::optional<std::string>;
using Info = const Conventions&;

Info conventions(const Subject& s) { return s.info.declared.conventions; }

// Why a law is not asked of an engine about a pair: what it declares leaves the law nothing to ask.
Reason never(const Subject&) { return std::nullopt; }
Reason without_margin(const Subject& s) {
  if (conventions(s).margin == Margin::none)
    return "the engine declares margin none: it does not look at the alarm distance";
  return std::nullopt;
}
/// The first reason that there is.
template <Reason (*... reasons)(const Subject&)>
Reason any_of(const Subject& s) {
  Reason found;
  static_cast<void>(((found = reasons(s)).has_value() || ...));
  return found;
}
/// It takes every one of these aspects.
template <Aspect... aspects>
Reason without(const Subject& s) {
  for (const Aspect aspect : {aspects...})
    if (!s.claims(aspect)) return fmt::format("the engine claims no {}", Aspects{aspect}.names().front());
  return std::nullopt;
}
/// It takes one of these.
template <Aspect... aspects>
Reason without_any(const Subject& s) {
  if ((s.claims(aspects) || ...)) return std::nullopt;
  return fmt::format("the engine claims neither {}", fmt::join(Aspects{aspects...}.names(), " nor "));
}
constexpr auto without_value = without<Aspect::value>;
constexpr auto without_both_decisions = without<Aspect::overlap, Aspect::contact>;
constexpr auto without_numbers =
    without_any<Aspect::normal, Aspect::point1, Aspect::point2, Aspect::point, Aspect::value>;
constexpr auto without_place = without_any<Aspect::point1, Aspect::point2, Aspect::value>;
Reason without_unit_normal(const Subject& s) {
  if (!conventions(s).normal_unit) return "the engine declares normals that are not unit";
  return without<Aspect::normal>(s);
}
Reason without_coincidence(const Subject& s) {
  // That there is no contact is something to ask for too.
  return conventions(s).coincident == Coincident::no_contact ? without<Aspect::contact>(s) : without_numbers(s);
}
/// A point that lies on a shape of the pair as `lies` wants it.
template <bool (*lies)(PointOn on, bool is_round)>
Reason without_point(const Subject& s) {
  Query query = zero_query(s.pair);
  for (const int shape : {0, 1}) {
    const auto on = oracle::point_of(conventions(s), query, shape);
    bool is_round = false;
    int which = 0;
    for_each_shape(query,
                   [&]<class Shape>(const Shape&) { is_round = which++ == shape ? kHasRadius<Shape> : is_round; });
    if (on && lies(*on, is_round) && s.claims(shape == 0 ? Aspect::point1 : Aspect::point2)) return std::nullopt;
  }
  return fmt::format("the engine, with points {}, claims no such point of a {}",
                     kPointsNames[static_cast<std::size_t>(conventions(s).points)], name(s.pair));
}
bool lies_anywhere(PointOn /*on*/, bool /*is_round*/) { return true; }
/// A point in the middle is on no side, nor is one of a shape without radius.
bool lies_on_a_side(PointOn on, bool is_round) { return is_round && on != PointOn::center; }
constexpr auto without_surface_points = without_point<lies_anywhere>;
constexpr auto without_near_side = without_point<lies_on_a_side>;
Reason without_span(const Subject& s) {
  if (auto why = without_unit_normal(s)) return why;
  return without<Aspect::point1, Aspect::point2, Aspect::value>(s);
}
/// A law that asks about another pair too: one that means the same there.
Reason without_pair(const Subject& s, Pair other) {
  if (s.serves_alike(other)) return std::nullopt;
  if (s.info.serves(other)) return fmt::format("what the engine says of a {} means something else", name(other));
  return fmt::format("the law asks about a {} too, which the engine does not serve", name(other));
}
Reason without_several_sphere_kinds(const Subject& s) {
  if (std::count_if(s.alike.begin(), s.alike.end(),
                    [&](Pair p) { return kind_of(p) == kind_of(Pair::sphere_sphere); }) < 2)
    return "the engine serves one kind of sphere pair, or means something else by each";
  return std::nullopt;
}
Reason without_plane_pair(const Subject& s) {
  for (const Pair pair : kPairs)
    if (has_plane(pair) && s.serves_alike(pair)) return std::nullopt;
  return "the law asks about a shape and a plane too, of which the engine serves none that means the same";
}
Reason without_spheres(const Subject& s) { return without_pair(s, Pair::sphere_sphere); }
Reason without_simpler_pair(const Subject& s) { return without_pair(s, pair_without_length(s.pair)); }
Reason without_correct_rounding(const Subject& s) {
  if (!s.correctly_rounded) return "not asked for: --level correctly-rounded";
  return without_numbers(s);
}
Reason with_correct_rounding(const Subject& s) {
  if (s.correctly_rounded) return "held to correct rounding instead";
  return without_numbers(s);
}

template <Pair... of>
bool is_one_of(Pair pair) {
  return ((kind_of(pair) == kind_of(of)) || ...);
}

// Where a law's questions come from.
rc::Gen<Query> asked_of(Pair pair, rc::Gen<Query> drawn) {
  return rc::gen::map(std::move(drawn), [pair](Query query) {
    query.pair = pair;
    return query;
  });
}
rc::Gen<Query> coincident_shapes(Pair pair, const Range& range) {
  const auto drawn = [&](rc::Gen<double> number) {
    return is_one_of<Pair::sphere_cube>(pair) ? sphere_on_box(range, std::move(number))
                                              : spheres_coincident(range, std::move(number), true);
  };
  return asked_of(pair, rc::gen::oneOf(drawn(any_number(range)), drawn(small_dyadic(range))));
}
template <bool by_alarm>
rc::Gen<Query> touching_shapes(Pair pair, const Range& range) {
  return asked_of(pair, is_one_of<Pair::cube_cube>(pair)     ? boxes_touching(range, by_alarm)
                        : is_one_of<Pair::sphere_cube>(pair) ? sphere_touching_box(range, by_alarm)
                                                             : spheres_touching(range, by_alarm));
}
rc::Gen<Query> spheres_in_boxes(Pair /*pair*/, const Range& range) {
  return rc::gen::oneOf(sphere_in_box(range, any_number(range)), sphere_in_box(range, small_dyadic(range)),
                        sphere_in_box(range, ordinary(range)));
}
/// Where a law is about depths, of a sphere and a box half the questions have one.
rc::Gen<Query> with_depths(Pair pair, const Range& range) {
  if (!is_one_of<Pair::sphere_cube>(pair)) return queries(pair, range);
  return rc::gen::oneOf(queries(pair, range), spheres_in_boxes(pair, range));
}
rc::Gen<Query> nested_boxes(Pair pair, const Range& range) {
  return rc::gen::map(queries(pair, range), [](Query query) {
    auto& [a, b] = std::get<Boxes>(query.shapes);
    // Six numbers of both boxes in order: the outer two are the first box's.
    for (int axis = 0; axis < 3; ++axis) {
      std::array<double, 4> x{a.min[axis], a.max[axis], b.min[axis], b.max[axis]};
      std::sort(x.begin(), x.end());
      a.min[axis] = x[0];
      b.min[axis] = x[1];
      b.max[axis] = x[2];
      a.max[axis] = x[3];
    }
    query.distances.alarm = 0;
    return query;
  });
}

/// Whether one of the two shapes of a pair is one of these.
template <class... Shapes>
bool has_one_of(Pair pair) {
  return of_shapes(pair, []<class A, class B>() { return kIsOneOf<A, Shapes...> || kIsOneOf<B, Shapes...>; });
}

bool are_alike(Pair pair) {
  return of_shapes(pair, []<class A, class B>() { return std::same_as<A, B>; });
}
// A new pair has the laws of `kAll`, and those of `kDistance` and `kAlike` if they concern it.
constexpr About kAll{"any shapes", [](Pair) { return true; }};
constexpr About kDistance{"shapes with a distance", has_distance};
constexpr About kAlike{"two alike", are_alike};
constexpr About kHits{"shapes with a distance, or a ray that is cast",
                      [](Pair pair) { return has_distance(pair) || is_cast(pair); }};
constexpr About kCast{"a ray that is cast", is_cast};
constexpr About kCastAtTriangle{"a ray that is cast at a triangle", is_one_of<Pair::cast_triangle>};
constexpr About kOverlapping{"any two convex shapes", [](Pair pair) { return is_convex(pair) && !has_plane(pair); }};
constexpr About kCrossing{"a segment and a triangle", is_crossing};
constexpr About kCorners{"a capsule, a triangle, a line or a hull", has_one_of<Capsule, Triangle, Line, Hull>};
constexpr About kLong{"a capsule, a triangle or a ray, and a distance",
                      [](Pair pair) { return has_distance(pair) && pair_without_length(pair) != pair; }};
constexpr About kGrowing{"any shapes but a triangle and a line", can_grow};
constexpr About kSpheres{"spheres", is_one_of<Pair::sphere_sphere>};
constexpr About kCubes{"cubes", is_one_of<Pair::cube_cube>};
constexpr About kSphereCube{"a sphere and a cube", is_one_of<Pair::sphere_cube>};
constexpr About kBeforeSphere{"spheres, or of a sphere and a cube", is_one_of<Pair::sphere_sphere, Pair::sphere_cube>};
constexpr About kSpheresAndCubes{"spheres and cubes",
                                 is_one_of<Pair::sphere_sphere, Pair::cube_cube, Pair::sphere_cube>};
constexpr About kCut{"a box, a capsule, a triangle, a line or a hull",
                     has_one_of<Box, Obb, Capsule, Line, Triangle, Hull>};
constexpr About kCutAtPoint{"a box along the axes, a capsule, a triangle or a hull, and a distance", [](Pair pair) {
                              return has_distance(pair) && has_one_of<Box, Capsule, Triangle, Hull>(pair);
                            }};
constexpr About kSphereFirst{"a sphere and any shape, and a distance", [](Pair pair) {
                               return has_distance(pair) &&
                                      of_shapes(pair, []<class A, class>() { return std::same_as<A, Ball>; });
                             }};
constexpr About kTurning{"any shapes but a cube", [](Pair pair) { return !has_one_of<Box>(pair); }};
constexpr bool kNo = false;
constexpr auto kBits = Exactness::bits;
constexpr auto kReals = Exactness::reals;
constexpr auto kTogether = Asking::together;

// In order: where several are violated, the earlier one names the mistake better.
constexpr std::array kLaws{
    Law{"answers", "Every question inside the domain gets an answer; one to a hit has every declared field.",
        "not unsupported, rejected, error, crash, timeout or missing; no missing field",
        "what is not answered cannot be right; every other law leaves such questions out", kBits, kAll, kNo,
        Asking::whatever_comes, never, queries, itself, check_answers},
    Law{"survives_bad_input", "A question outside the domain neither crashes nor hangs the engine.",
        "NaN, infinities, negative lengths, inverted boxes: not crash, timeout or missing",
        "a simulation that has gone wrong sends such numbers, and what follows must be an error that can be seen",
        kBits, kAll, kNo, Asking::whatever_comes, never, bad_queries, itself_if_bad, check_survives_bad_input},
    Law{"refuses_bad_input", "A question outside the domain is refused.", "rejected or error",
        "an answer to NaN is believed; asked only when named, as `certify` asks the family `invalid`", kBits, kAll,
        true, Asking::whatever_comes, never, bad_queries, itself_if_bad, check_refuses_bad_input},
    Law{"repeatable", "The same question gets the same answer again, whatever was asked in between.",
        "answer(q) = answer(q) in q, others, q", "state left behind by one question makes a run impossible to repeat",
        kBits, kAll, kNo, kTogether, never, queries, itself_among_others, check_repeatable},
    Law{"batch", "A batch of questions gets the answers that each gets alone, in any order.",
        "answer([q1, q2, ...]) = [answer(q1), answer(q2), ...]",
        "vector code and its remainder loop, threads and caches answer alike or nobody can tell which is right", kBits,
        kAll, kNo, Asking::together_and_one_by_one, never, queries, with_others, check_batch},
    Law{"coincident",
        "Coincident centres, or a centre on the surface of a box, give an answer without NaN, its normal as declared.",
        "D = 0: abs(n.n - 1) <= 8u and n points against no part of the box, or n = 0, or no contact; no number is NaN",
        "0/0 is the best known mistake of all: SOFA answers NaN", kReals, kBeforeSphere, kNo, kTogether,
        without_coincidence, coincident_shapes, itself_if_coincident, check_coincident},
    Law{"finite", "Where the truth is finite, so is the answer.",
        "D > 0, or a centre inside: no NaN, and no infinity but a rounded one",
        "squares overflow from 2^512 and vanish below 2^-537", kReals, kHits, kNo, kTogether, without_numbers, queries,
        itself, check_finite},
    Law{"nested", "A box strictly inside another overlaps it, flat or not.", "a.min < b.min <= b.max < a.max: hit",
        "tests by corners or faces miss a box that is wholly inside", kReals, kCubes, kNo, kTogether, never,
        nested_boxes, one_inside_the_other, check_decisions},
    Law{"each_axis", "Two boxes overlap where they overlap on each axis alone.",
        "hit(a, b) = hit_x and hit_y and hit_z; left out within the bound unless held to correct rounding",
        "an axis forgotten or compared with another is seen at once", kBits, kCubes, kNo, kTogether, never, queries,
        each_axis_alone, check_each_axis},
    Law{"sphere_kinds", "A Sphere and a RigidSphere with the same centre and radius have the same contacts.",
        "the three sphere pairs: same hit, value, normal and, but for `center`, points; allowances as for `swap`",
        "three intersectors with one formula are three chances to mistype it", kBits, kSpheres, kNo, kTogether,
        without_several_sphere_kinds, queries, other_sphere_kinds, check_sphere_kinds},
    Law{"swap", "Swapped shapes have the same hit and value, the normal turned round and the points exchanged.",
        "hit, value same; n' = -n; point1' = point2, point2' = point1; coincident normals and points left out; numbers "
        "within twice the bound, hits left out within the bound, unless held to correct rounding",
        "which model comes first is an accident of bookkeeping", kBits, kAlike, kNo, kTogether, never, queries, swapped,
        check_swapped},
    Law{"point_box", "A box that is one point is a sphere without radius.",
        "min = max = p: same contact as with the sphere (p, 0); allowances as for `swap`",
        "two functions that meet in one question must agree there", kBits, kSphereCube, kNo, kTogether, without_spheres,
        queries, point_box, check_same_contact},
    Law{"corners",
        "The order of a capsule's or a line's ends, and of a triangle's or a hull's vertices, changes nothing, nor "
        "does "
        "one more vertex of a hull between two others.",
        "same hit and contact; the normal of a crossing is turned round where two vertices change places; the vertex "
        "half way where that is exact, else one of the two again; allowances as for `swap`",
        "which corner is told first is an accident; catches a parameter clamped, an edge asked in one order alone, or "
        "a "
        "vertex forgotten",
        kBits, kCorners, kNo, kTogether, never, queries, corners_exchanged, check_corners},
    Law{"without_length",
        "A capsule without length is a sphere, a ray without length and a triangle in one place are one without "
        "radius.",
        "same contact as with the sphere; allowances as for `swap`",
        "two functions that meet in one question must agree there; catches divisions by a length", kBits, kLong, kNo,
        kTogether, without_simpler_pair, queries, without_length, check_same_contact},
    Law{"turn", "Axes permuted and reflected permute and reflect the answer.",
        "answer(P q) = P answer(q), P a signed permutation; allowances as for `swap`",
        "no direction in space is special; catches a component mistyped", kBits, kAll, kNo, kTogether, never, queries,
        turned, check_turned},
    Law{"unit_normal", "The normal has unit length.",
        "abs(n.n - 1) <= 4 bound ulp(1), the bound 1 where held to correct rounding",
        "a normal of another length scales every force", kReals, kHits, kNo, kTogether, without_unit_normal, queries,
        itself, check_unit_normal},
    Law{"scale", "A power of two scales points and value and changes nothing else.",
        "answer(2^k q) = 2^k answer(q), the normal same; subnormal numbers left out; allowances as for `swap`",
        "a metre is no better than a millimetre: catches absolute tolerances and lengths compared with squares", kBits,
        kAll, kNo, kTogether, never, queries, scaled, check_scaled},
    Law{"translate", "An exact translation leaves hit, value and normal, and moves the points along.",
        "q + t exact in the scalar; points within the bounds as reals; allowances as for `swap`",
        "the origin is an accident: catches expanded squares such as c1.c1 - 2 c1.c2 + c2.c2", kBits, kAll, kNo,
        kTogether, never, queries, translated, check_translated},
    Law{"rotate",
        "A scene turned by a quaternion of small integers, and as many times as long as its squared length, is "
        "answered so.",
        "answer(N R q) = N R answer(q), normals R n, N R of integers, where N R q is exact: about each axis by the "
        "angle of a triangle 3, 4, 5 (N = 5), and about others (N = 3, 7, 9, 25); to the bounds of both; hits left "
        "out within the bound, unless held to correct rounding",
        "between the axes space is no other: catches what is right along axes alone", kReals, kTurning, kNo, kTogether,
        never, queries, rotated, check_rotated},
    Law{"touching", "Shapes that touch exactly are a hit, or as declared; just beyond they are none.",
        "integers times 2^k, where plain arithmetic is exact: sqrt(D) = r1 + r2 as declared, one step less is a miss; "
        "boxes "
        "one ulp apart are a miss",
        "< for <= cannot be excused by rounding", kReals, kSpheresAndCubes, kNo, kTogether, never,
        touching_shapes<false>, touching, check_touching},
    Law{"alarm_edge", "Shapes exactly at the alarm distance are a hit, or as declared; just beyond they are none.",
        "as `touching`, with sqrt(D) = alarm + r1 + r2 and alarm > 0",
        "the alarm distance counts once, and its edge belongs to it", kReals, kSpheresAndCubes, kNo, kTogether,
        without_margin, touching_shapes<true>, at_the_alarm_distance, check_touching},
    Law{"test_agrees", "There is a contact exactly where there is an overlap.",
        "overlap = contact exists, as declared; left out within the bound unless held to correct rounding",
        "testIntersection and computeIntersection are two functions, and callers trust that they agree", kBits, kHits,
        kNo, kTogether, without_both_decisions, queries, itself, check_test_agrees},
    Law{"alarm_growth", "A hit stays a hit when the alarm distance grows.",
        "alarm <= alarm': hit(q) implies hit(q'); left out within the bound unless held to correct rounding",
        "a larger alarm distance asks for more, never for less", kReals, kAll, kNo, kTogether, without_margin, queries,
        alarm_grown, check_grown},
    Law{"size_growth", "A hit stays a hit when a radius or a box grows.",
        "a' contains a: hit(a, b) implies hit(a', b); allowance as for `alarm_growth`", "more matter touches no less",
        kReals, kGrowing, kNo, kTogether, never, queries, size_grown, check_grown},
    Law{"alarm_changes_no_number",
        "The alarm distance decides whether there is a contact, and changes no number of it.",
        "alarm to alarm', both hits: same contact; within twice the bound unless held to correct rounding",
        "the alarm distance is a threshold, not part of the geometry", kBits, kDistance, kNo, kTogether,
        any_of<without_margin, without_numbers>, queries, other_alarm, check_other_alarm},
    Law{"value_grows_with_distance", "The value never falls when the shapes move apart.",
        "D <= D': value <= value', to the bounds of both unless held to correct rounding",
        "penetration is negative: catches a value without its sign", kReals, kBeforeSphere, kNo, kTogether,
        without_value, queries, farther, check_farther},
    Law{"size_lowers_value", "The value never rises when a radius or a box grows.",
        "a' contains a: value' <= value, to the bounds of both unless held to correct rounding",
        "more matter is no farther away, and deeper where it is inside: catches a depth with the wrong sign", kReals,
        kDistance, kNo, kTogether, without_value, with_depths, size_grown, check_lower_value},
    Law{"halves", "Of a shape cut in two, the nearer half has the contact of the whole.",
        "a box is cut anywhere, a rotated box in the middle, others between two vertices, in the middle where that is "
        "exact; hit(whole) = hit(half) or hit(other); value(whole) <= value(half), and the contact is that of a half "
        "that has the same nearest points; allowances as for `swap`",
        "what lies farther away has no influence: catches middles, corners, bounding spheres, and searches that end "
        "too early",
        kBits, kCut, kNo, kTogether, never, queries, halves, check_halves},
    Law{"contact_distance", "The contact distance changes the value alone, by as much as it changes.",
        "value' - value = contact - contact' (0 where declared so) to the bounds of both; hit, normal and points same",
        "counted twice or not at all it moves every rest position", kReals, kDistance, kNo, kTogether, without_numbers,
        queries, other_contact, check_other_contact},
    Law{"direction", "The normal points from the first shape to the second, or as declared.",
        "n . delta > 0, delta from core to core", "a normal that points back pulls together what it should push apart",
        kReals, kDistance, kNo, kTogether, without<Aspect::normal>, queries, itself, check_direction},
    Law{"own_surface", "Each contact point lies a radius from its own core, or on it as declared.",
        "abs(abs(point_i - p_i) - r_i) <= 2 bound ulp(scale), p_i nearest in the core",
        "exchanged points give torques about the wrong body", kReals, kDistance, kNo, kTogether, without_surface_points,
        queries, itself, check_own_surface},
    Law{"near_side", "Each contact point lies on the side of its shape that faces the other, or as declared.",
        "(point1 - p1) . delta > 0, (point2 - p2) . delta < 0; a radius of 0 left out",
        "the published formula has a sign lost: its points lie on the far sides", kReals, kDistance, kNo, kTogether,
        without_near_side, queries, itself, check_near_side},
    Law{"radius", "A larger radius lowers the value by as much, and leaves the normal and the other shape's point.",
        "value' - value = r - r' to the bounds of both; allowances as for `swap`",
        "a radius counts once, and is a length", kReals, kDistance, kNo, kTogether, without_numbers, queries,
        radius_grown, check_larger_radius},
    Law{"way_out", "A centre inside a box leaves it by the nearest face.",
        "value = -(r + the least of c - min and max - c) - contact, to the bound",
        "by any other face a sphere is thrown through the box", kReals, kSphereCube, kNo, kTogether, without_value,
        spheres_in_boxes, itself_if_inside, check_way_out},
    Law{"parts", "Shapes that overlap are parted along the normal by what the value says.",
        "max n.a - min n.b over the vertices <= depth abs(n), the depth -(value + contact + r1 + r2); to the bounds of "
        "value and "
        "normal",
        "a normal that leads out somewhere else leaves them in each other: catches an axis of SAT that was not tried, "
        "and EPA that ended early",
        kReals, kOverlapping, kNo, kTogether, without_unit_normal, queries, itself, check_parts},
    Law{"crossing",
        "Where a segment crosses a triangle both points are one, which lies in the box around each, and the value is "
        "0.",
        "point1 = point2, each coordinate between the least and the largest of the segment, and of the triangle; value "
        "= 0; to the bounds",
        "a point that one shape alone has is not where they meet", kReals, kCrossing, kNo, kTogether, without_place,
        queries, itself, check_crossing},
    Law{"common_edge", "A ray through an edge that two triangles have in common hits at least one of them.",
        "v and w on either side of an edge, the ray as near to a point of it as its numbers allow: hit(v) or hit(w)",
        "between two triangles of a mesh nothing falls through: catches strict bounds, and bounds with a tolerance",
        kReals, kCastAtTriangle, kNo, kTogether, never, queries, across_a_common_edge, check_common_edge},
    Law{"direction_length", "A direction 2^k times as long makes t 2^-k of it, and changes nothing else.",
        "answer(o, 2^k d, 2^-k l): same hit, normal and points, 2^-k value; allowances as for `swap`",
        "a direction need not be a unit vector, and t and the length count it: catches t as a distance", kBits, kCast,
        kNo, kTogether, never, queries, direction_lengthened, check_direction_lengthened},
    Law{"there_and_back", "A ray that comes back from its end hits what it hit.",
        "hit(o, d, l) = hit(o + l d, -d, l), where the end is exact; left out within the bound unless held to correct "
        "rounding",
        "a ray is a segment: catches rays from inside that miss, and sides that are not seen", kBits, kCast, kNo,
        kTogether, never, queries, there_and_back, check_there_and_back},
    Law{"onto_point", "A sphere about the engine's own point of the other shape is as deep in it as its radius.",
        "answer(q) = p2 on b: value(ball(p2, r), b) = -r - contact; to the bounds of point and value",
        "what is said of one question must hold in the next: catches what is wrong where a centre lies on a surface, "
        "which few questions hit",
        kReals, kSphereFirst, kNo, kTogether, without<Aspect::point2, Aspect::value>, queries, itself, check_onto_point,
        onto_point},
    Law{"tangent_plane",
        "The plane through the engine's own point, square to its own normal, touches the shape that the point is of.",
        "answer(q) = n, p1 on a: value(a, {x: n.x >= n.p1 - d}) = -d - contact; to the bounds of all three, and what "
        "the normal's bound moves over the breadth of a",
        "no part of a shape is farther out than its contact point: catches a normal and a point that do not belong "
        "together",
        kReals, kDistance, kNo, kTogether,
        any_of<without_unit_normal, without_surface_points, without_value, without_plane_pair>, queries, itself,
        check_tangent_plane, tangent_plane},
    Law{"cut_at_point",
        "A capsule, a triangle or a box that is cut at the engine's own point, or a hull with it as one more vertex, "
        "has the same value.",
        "answer(q) = p on b: value(a, b') = value(a, b), b' the part of b to p, or with it; cores apart; to the bounds "
        "of both values and of the point",
        "a corner in the nearest point is where regions meet: catches a region that is chosen by rounding, and a foot "
        "that is clamped to the wrong one",
        kReals, kCutAtPoint, kNo, kTogether, any_of<without_surface_points, without_value>, queries, itself,
        check_cut_at_point, cut_at_point},
    Law{"span",
        "The way from the first point to the second is the value, without the contact distance, along the normal.",
        "point2 - point1 = (value + contact) n to the bounds of all four; radii added where points are not the nearest",
        "normal, points and value are one geometry told four times", kReals, kDistance, kNo, kTogether, without_span,
        queries, itself, check_span},
    Law{"decision", "Every hit and every miss is the exact decision.",
        "overlap and contact exist iff sqrt(D) <= alarm + r1 + r2, or as declared, decided exactly; every level asks "
        "it",
        "near touching a rounded comparison is a coin toss that two engines toss differently", kReals, kAll, kNo,
        kTogether, never, queries, itself, check_decisions},
    Law{"correctly_rounded", "Every number is the exact real rounded once.",
        "equal to the exact real rounded to nearest, ties to even; only with --level correctly-rounded",
        "then there is one right answer, and golden files compare bit for bit", kBits, kHits, kNo, kTogether,
        without_correct_rounding, queries, itself, check_correctly_rounded},
    Law{"bounds", "Every number is within the engine's declared bounds.",
        "abs(claim - exact) <= bound ulp(scale); docs/specification.md#scales-and-ulps",
        "what an engine declares is what its users count on", kReals, kHits, kNo, kTogether, with_correct_rounding,
        queries, itself, check_bounds},
};

}  // namespace

Subject::Subject(const engines::EngineInfo& engine, Pair of, bool held_to_correct_rounding)
    : info(engine), pair(of), correctly_rounded(held_to_correct_rounding) {
  info.declared = engine.declared_for(pair);
  for (const Pair other : engine.pairs)
    if (engine.declared_for(other) == info.declared) alike.push_back(other);
  const Conventions& own = info.declared.conventions;
  const Tolerance promised = info.declared.tolerance.value_or(Tolerance{});
  range = Range(info.declared.scalar, std::max(own.scale_min, promised.scale_min),
                std::min(own.scale_max, promised.scale_max));
}

double Subject::bound(oracle::Field field) const {
  if (correctly_rounded) return 1;
  const DeclaredBounds& bounds = info.declared.bounds;
  return field == Field::normal ? bounds.normal : field == Field::value ? bounds.value : bounds.point;
}

std::span<const Law> laws() { return kLaws; }

const Law* find_law(std::string_view name) {
  const auto it = std::find_if(kLaws.begin(), kLaws.end(), [&](const Law& law) { return law.name == name; });
  return it == kLaws.end() ? nullptr : &*it;
}

std::string law_table() {
  std::string text = "| law | pairs | what holds | formula | why it matters | |\n|---|---|---|---|---|---|\n";
  for (const Law& law : kLaws)
    text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", law.name, law.about.pairs, law.sentence, law.formula,
                        law.reason, kExactnessNames[static_cast<std::size_t>(law.exactness)]);
  return text;
}

}  // namespace contact::proptests
