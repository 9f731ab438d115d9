// Production's functions for every kind of pair against both oracles, and what ties the kinds to each other. The laws
// of any engine, which hold for production as well, are in laws.cpp.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/detail/Configuration.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstdlib>
#include <functional>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "contact/pair_functions.hpp"
#include "oracle/truth/exact_truth.hpp"
#include "oracle/truth/interval_oracle.hpp"
#include "oracle/truth/truth.hpp"
#include "proptests/law_functions.hpp"

namespace contact::production_properties {
namespace {

using namespace proptests;
using oracle::Truth;

// The same cases everywhere, unless RC_PARAMS asks for others: a seed that nobody chose hides what it found.
[[maybe_unused]] const int kSeeded = setenv("RC_PARAMS", "seed=20 max_success=2500", 0);

// RapidCheck reads the variable once: had it done so before it was set, each run would ask others.
TEST(Questions, are_those_of_the_seed_that_is_set_here) {
  EXPECT_EQ(rc::detail::configuration().testParams, rc::detail::configFromString(std::getenv("RC_PARAMS")).testParams);
  int asked = 0;
  EXPECT_TRUE(rc::check("counts", [&] { ++asked; }));
  EXPECT_EQ(asked, rc::detail::configuration().testParams.maxSuccess);
}

/// Puts questions of a pair to a law, one in `part` of those that RC_PARAMS asks for: two turned boxes of any numbers take milliseconds
/// where all others take microseconds, and the campaign asks ten times as many.
void expect_holds(Pair pair, const std::function<void(const Query&)>& law, int part = 1) {
  auto params = rc::detail::configuration().testParams;
  params.maxSuccess /= part;
  const auto result =
      rc::detail::checkTestable([&] { law(*queries(pair, Range())); }, rc::detail::TestMetadata{}, params);
  std::ostringstream said;
  if (!result.is<rc::detail::SuccessResult>()) rc::detail::printResultMessage(result, said);
  EXPECT_EQ(said.str(), "") << name(pair);
}
/// The same of every kind of pair whose shapes the law takes; of any two convex shapes one in `part_of_convexes`.
template <class Law>
void expect_holds_for_every_kind(Law law, int part_of_convexes = 1) {
  int kinds = 0;
  for (const Pair pair : pairs_of_kinds())
    std::visit(
        [&]<class Shapes>(const Shapes&) {
          if constexpr (std::invocable<Law, const Shapes&, Distances>) {
            ++kinds;
            expect_holds(
                pair, [&](const Query& query) { law(std::get<Shapes>(query.shapes), query.distances); },
                is_convex(pair) ? part_of_convexes : 1);
          }
        },
        description(pair).zeros());
  EXPECT_GT(kinds, 0);
}

template <class A, class B>
Expectation answer(const Two<A, B>& shapes, Distances distances) {
  Expectation said{is_hit(shapes, distances), contact_of(shapes, distances)};
  RC_ASSERT(said.contact.has_value() == (said.hit && !std::same_as<A, Box>));
  if (said.contact) {
    const Contact& c = *said.contact;
    for (const Vector3& v : {c.normal, c.point1, c.point2, Vector3(c.value, 0, 0)})
      for (const double x : v) RC_ASSERT(x != 0 || !std::signbit(x));
  }
  return said;
}
Expectation answer(const Query& query) {
  return std::visit([&](const auto& shapes) { return answer(shapes, query.distances); }, query.shapes);
}

void expect_same(const Expectation& x, const Expectation& y) {
  RC_ASSERT(first_difference(x, y) == std::optional<std::string>());
}

// What the questions are: no law says much of questions of one kind alone.

template <class Shape>
bool lacks_length(const Shape& s) {
  if constexpr (kIsOneOf<Shape, Capsule, Line>) return s.start == s.end;
  if constexpr (std::same_as<Shape, Ray>) return s.length == 0;
  return false;
}
bool lacks_length(const Query& q) {
  return std::visit([](const auto& shapes) { return lacks_length(shapes.a) || lacks_length(shapes.b); }, q.shapes);
}
Vector3 area_vector(const Triangle& t) { return (t.vertices[1] - t.vertices[0]).cross(t.vertices[2] - t.vertices[0]); }

/// Along the segment where the centre is beside it: from 0 to 1.
double along(const Query& q) {
  const auto part = [](const Vector3& start, const Vector3& way, double length, const Vector3& center) {
    return way.dot(center - start) / way.squaredNorm() / length;
  };
  if (const auto* ray = std::get_if<RayAndBall>(&q.shapes))
    return part(ray->a.origin, ray->a.direction, ray->a.length, ray->b.center);
  const auto& [ball, capsule] = std::get<BallAndCapsule>(q.shapes);
  return part(capsule.start, capsule.end - capsule.start, 1, ball.center);
}

/// Which end of a capsule is lower: -1 the end, 1 the start, 0 neither.
int rise(const CapsuleAndPlane& shapes) {
  using oracle::operator-;
  const auto& [a, b] = shapes;
  return static_cast<int>(
      CGAL::sign(oracle::dot(oracle::point_of(b.normal), oracle::point_of(a.end) - oracle::point_of(a.start))));
}
bool rises(const Query& q, int sign) { return !lacks_length(q) && rise(std::get<CapsuleAndPlane>(q.shapes)) == sign; }

/// How many edges of the triangle the centre is beyond.
bool is_beyond(const Query& q, int edges) {
  const auto& [ball, triangle] = std::get<BallAndTriangle>(q.shapes);
  const Vector3 n = area_vector(triangle);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3 x = triangle.vertices[i] - ball.center;
    const Vector3 y = triangle.vertices[(i + 1) % 3] - ball.center;
    edges -= n.dot(x.cross(y)) < 0 ? 1 : 0;
  }
  return !n.isZero(0) && edges == 0;
}

/// On how many axes the centre is outside the box.
bool is_outside(const Query& q, int axes) {
  const auto& [a, b] = std::get<BallAndBox>(q.shapes);
  return ((a.center.array() < b.min.array()) || (a.center.array() > b.max.array())).count() == axes;
}

bool are_plain_boxes_hit(const Query& q) {
  const auto& [a, b] = *q.boxes();
  const double alarm = q.distances.alarm;
  return (a.min.array() <= b.max.array() + alarm).all() && (b.min.array() <= a.max.array() + alarm).all();
}

template <class Holds>
bool has_number(const Query& q, Holds holds) {
  bool found = false;
  for_each_number(q, [&](const std::string&, double x) { found = found || holds(std::abs(x)); });
  return found;
}

struct Region {
  std::string_view what;
  bool (*holds)(const Query& q, const Truth& truth);
  std::map<Pair, double> least;  ///< per cent
};
using P = Pair;
const std::vector<Region> kRegions{
    {"exactly at the alarm distance",
     [](const Query&, const Truth& t) { return t.at_alarm == oracle::Side::at; },
     {{P::sphere_sphere, 5},
      {P::cube_cube, 5},
      {P::sphere_cube, 3},
      {P::sphere_capsule, 3},
      {P::capsule_capsule, 3},
      {P::sphere_triangle, 3},
      {P::ray_sphere, 2},
      {P::sphere_plane, 5},
      {P::capsule_plane, 5}}},
    {"within 4 ulps of it",
     [](const Query&, const Truth& t) {
       return t.at_alarm != oracle::Side::at && std::abs(oracle::witness(t, Scalar::binary64).margin_ulps) <= 4;
     },
     {{P::sphere_sphere, 10}}},
    {"meeting",
     [](const Query&, const Truth& t) { return t.degenerate(); },
     {{P::sphere_sphere, 5},
      {P::sphere_capsule, 3},
      {P::capsule_capsule, 3},
      {P::sphere_triangle, 3},
      {P::ray_sphere, 2}}},
    {"hits from inside",
     [](const Query&, const Truth& t) { return t.hit() && t.degenerate(); },
     {{P::cast_sphere, 1}, {P::cast_cube, 1}, {P::cast_capsule, 1}, {P::cast_triangle, 1}, {P::cast_plane, 1}}},
    {"hits from outside",
     [](const Query&, const Truth& t) { return t.hit() && !t.degenerate(); },
     {{P::cast_sphere, 10}, {P::cast_cube, 10}, {P::cast_capsule, 10}, {P::cast_triangle, 10}, {P::cast_plane, 10}}},
    {"inside the box",
     [](const Query&, const Truth& t) { return t.degenerate() && !t.coincident(); },
     {{P::sphere_cube, 2}}},
    {"on its boundary", [](const Query&, const Truth& t) { return t.coincident(); }, {{P::sphere_cube, 2}}},
    {"beside a face", [](const Query& q, const Truth&) { return is_outside(q, 1); }, {{P::sphere_cube, 10}}},
    {"beside an edge", [](const Query& q, const Truth&) { return is_outside(q, 2); }, {{P::sphere_cube, 10}}},
    {"beside a corner", [](const Query& q, const Truth&) { return is_outside(q, 3); }, {{P::sphere_cube, 10}}},
    {"a subnormal number",
     [](const Query& q, const Truth&) { return has_number(q, [](double x) { return x != 0 && x < 0x1p-1022; }); },
     {{P::sphere_sphere, 15}, {P::cube_cube, 15}}},
    {"a huge number",
     [](const Query& q, const Truth&) { return has_number(q, [](double x) { return x > 0x1p1000; }); },
     {{P::sphere_sphere, 15}}},
    {"infinite numbers in the answer",
     [](const Query& q, const Truth&) {
       const auto contact = answer(q).contact;
       return contact && !(std::isfinite(contact->value) && contact->point1.allFinite() && contact->point2.allFinite());
     },
     {{P::sphere_sphere, 0.5}}},
    {"decided otherwise in plain double",
     [](const Query& q, const Truth& t) { return are_plain_boxes_hit(q) != t.hit(); },
     {{P::cube_cube, 1}}},
    {"a flat box",
     [](const Query& q, const Truth&) {
       const auto& [a, b] = *q.boxes();
       return (a.min.array() == a.max.array()).any() || (b.min.array() == b.max.array()).any();
     },
     {{P::cube_cube, 5}}},
    {"without length",
     [](const Query& q, const Truth&) { return lacks_length(q); },
     {{P::sphere_capsule, 3},
      {P::capsule_capsule, 3},
      {P::ray_sphere, 2},
      {P::capsule_plane, 3},
      {P::triangle_line, 0.5}}},
    {"beside the start",
     [](const Query& q, const Truth&) { return !lacks_length(q) && along(q) <= 0; },
     {{P::sphere_capsule, 10}, {P::ray_sphere, 10}}},
    {"beside the side",
     [](const Query& q, const Truth&) { return !lacks_length(q) && !(along(q) <= 0 || along(q) >= 1); },
     {{P::sphere_capsule, 10}, {P::ray_sphere, 10}}},
    {"beside the end",
     [](const Query& q, const Truth&) { return !lacks_length(q) && along(q) >= 1; },
     {{P::sphere_capsule, 10}, {P::ray_sphere, 10}}},
    {"parallel",
     [](const Query& q, const Truth&) {
       const auto& [a, b] = std::get<Capsules>(q.shapes);
       return !lacks_length(q) && (a.end - a.start).cross(b.end - b.start).isZero(0);
     },
     {{P::capsule_capsule, 5}}},
    {"several nearest points",
     [](const Query&, const Truth& t) {
       const auto contact = oracle::expectation(t, Scalar::binary64).contact;
       return contact && !contact->unique;
     },
     {{P::capsule_capsule, 2}}},
    {"without an inside",
     [](const Query& q, const Truth&) {
       const auto* ray = std::get_if<RayAndTriangle>(&q.shapes);
       return area_vector(ray != nullptr ? ray->b : std::get<BallAndTriangle>(q.shapes).b).isZero(0);
     },
     {{P::sphere_triangle, 10}, {P::ray_triangle, 4}}},
    {"over the face", [](const Query& q, const Truth&) { return is_beyond(q, 0); }, {{P::sphere_triangle, 10}}},
    {"beyond one edge", [](const Query& q, const Truth&) { return is_beyond(q, 1); }, {{P::sphere_triangle, 10}}},
    {"beyond two edges", [](const Query& q, const Truth&) { return is_beyond(q, 2); }, {{P::sphere_triangle, 5}}},
    {"below the plane",
     [](const Query&, const Truth& t) { return t.distance()->below(); },
     {{P::sphere_plane, 15}, {P::capsule_plane, 15}}},
    {"on the plane",
     [](const Query&, const Truth& t) { return CGAL::is_zero(t.distance()->distance2()); },
     {{P::sphere_plane, 2}}},
    {"a normal along an axis",
     [](const Query& q, const Truth&) { return (std::get<BallAndPlane>(q.shapes).b.normal.array() != 0).count() == 1; },
     {{P::sphere_plane, 15}}},
    {"the start is lower", [](const Query& q, const Truth&) { return rises(q, 1); }, {{P::capsule_plane, 15}}},
    {"the end is lower", [](const Query& q, const Truth&) { return rises(q, -1); }, {{P::capsule_plane, 15}}},
    {"along the plane", [](const Query& q, const Truth&) { return rises(q, 0); }, {{P::capsule_plane, 10}}},
    {"a ray along the plane",
     [](const Query& q, const Truth&) {
       const auto& [a, b] = std::get<RayAndTriangle>(q.shapes);
       return !area_vector(b).isZero(0) && area_vector(b).dot(a.direction) == 0;
     },
     {{P::ray_triangle, 2}}},
    {"a ray that ends soon after it hits",
     [](const Query& q, const Truth& t) {
       auto shapes = std::get<RayAndTriangle>(q.shapes);
       shapes.a.length /= 2;
       return t.hit() && !is_hit(shapes, q.distances);
     },
     {{P::ray_triangle, 3}}},
};

class EveryKind : public testing::TestWithParam<Pair> {};
INSTANTIATE_TEST_SUITE_P(, EveryKind, testing::ValuesIn(pairs_of_kinds()),
                         [](const auto& each) { return std::string(name(each.param)); });

TEST_P(EveryKind, equals_both_oracles_on_questions_of_every_region) {
  const Pair pair = GetParam();
  std::vector<int> counts(kRegions.size());
  int asked = 0;
  int hits = 0;
  expect_holds(
      pair,
      [&](const Query& query) {
        RC_ASSERT(!outside_domain(query));
        const Truth truth = oracle::truth_of(query);
        const Expectation said = answer(query);
        expect_same(said, oracle::expectation(truth, Scalar::binary64));
        expect_same(said, oracle::interval_answer(query, Scalar::binary64).expected);
        ++asked;
        hits += said.hit ? 1 : 0;
        for (std::size_t i = 0; i < kRegions.size(); ++i)
          counts[i] += kRegions[i].least.contains(pair) && kRegions[i].holds(query, truth) ? 1 : 0;
      },
      is_convex(pair) ? 25
      : is_cast(pair) ? 3
                      : 1);
  const auto share = [&](std::string_view what, int count) {
    RecordProperty(std::string(what), std::to_string(100.0 * count / asked) + " %");
    return 100.0 * count / asked;
  };
  const bool few_hits = is_crossing(pair) || is_cast(pair);
  const bool many_hits = !is_crossing(pair) && !is_discrete_intersections(pair);
  EXPECT_GT(share("hits", hits), few_hits ? 15 : 30);
  EXPECT_LT(share("hits", hits), many_hits ? 85 : 70);
  for (std::size_t i = 0; i < kRegions.size(); ++i) {
    const Region& region = kRegions[i];
    if (!region.least.contains(pair)) continue;
    EXPECT_GT(share(region.what, counts[i]), region.least.at(pair)) << region.what;
  }
}

// What ties the answers to different questions to each other.

/// Whether the contacts of two shapes are of one sort.
template <class A, class B>
constexpr Numbers numbers_of() {
  if (std::same_as<A, Cast>) return Numbers::cast;
  if (std::same_as<A, Box>) return Numbers::none;
  return (std::same_as<A, Ray> && std::same_as<B, Triangle>) || std::same_as<B, Line> ? Numbers::crossing
                                                                                      : Numbers::distance;
}
template <class A, class B>
constexpr bool kHasDistance = numbers_of<A, B>() == Numbers::distance;
template <class A, class B>
concept IsPair = requires(const Two<A, B>& shapes) {
  is_hit(shapes, Distances{});
};
TEST(Production, is_asked_about_shapes_of_the_sorts_that_these_tests_take_them_for) {
  for (const Pair pair : kPairs)
    std::visit([&]<class A, class B>(
                   const Two<A, B>&) { EXPECT_EQ((numbers_of<A, B>()), description(pair).numbers) << name(pair); },
               description(pair).zeros());
}

TEST(Production, counts_the_radii_and_the_alarm_distance_alike) {
  expect_holds_for_every_kind([]<class A, class B>(
      Two<A, B> shapes, Distances distances) requires(kHasDistance<A, B> && (kHasRadius<A> || kHasRadius<B>)) {
    const bool hit = is_hit(shapes, distances);
    if constexpr (kHasRadius<A>) {
      std::swap(distances.alarm, shapes.a.radius);
      RC_ASSERT(is_hit(shapes, distances) == hit);
    }
    if constexpr (kHasRadius<B>) {
      std::swap(distances.alarm, shapes.b.radius);
      RC_ASSERT(is_hit(shapes, distances) == hit);
    }
  });
}

template <class Shapes>
bool has_several_ways_out(const Shapes&) {
  return false;
}
bool has_several_ways_out(const Convexes& shapes) {
  const Truth truth = oracle::truth_of({Pair::obb_obb, shapes, {}});
  const auto& distance = *truth.distance();
  return distance.meets() && (!distance.overlaps() || distance.meeting().ways.size() > 1);
}

TEST(Production, says_the_same_whichever_shape_is_the_first) {
  expect_holds_for_every_kind(
      []<class A>(const Two<A, A>& shapes, Distances distances) {
        Expectation there = answer(shapes, distances);
        Expectation back = answer(Two<A, A>{shapes.b, shapes.a}, distances);
        // Where they meet, the normal is the same for both orders, and the points do not follow from it; of several ways
        // out that are as near, each order may take another.
        if (there.contact && back.contact) {
          if (has_several_ways_out(shapes))
            for (Contact* c : {&*there.contact, &*back.contact})
              c->normal = c->point1 = c->point2 = Vector3::Zero(), c->unique = true;
          else if (there.contact->degenerate)
            for (Contact* c : {&*there.contact, &*back.contact}) c->point1 = c->point2 = Vector3::Zero();
          else
            there.contact->normal *= -1;
          std::swap(there.contact->point1, there.contact->point2);
        }
        expect_same(there, back);
      },
      10);
}

TEST(Production, says_the_same_whichever_corner_is_the_first) {
  const Subject any({}, Pair::sphere_sphere, true);
  int asked = 0;
  for (const Pair pair : pairs_of_kinds()) {
    if (!find_law("corners")->about.includes(pair)) continue;
    ++asked;
    expect_holds(pair, [&](const Query& query) {
      Change change;
      change.choice = *integer(0, 4);
      const auto questions = corners_exchanged({query, change, {}}, any);
      Expectation wanted = answer(questions[0]);
      // The normal of a crossing goes by the order of the vertices: the last three orders turn it round.
      const bool has_vertices =
          of_shapes(pair, []<class A, class B>() { return std::same_as<A, Triangle> || std::same_as<B, Triangle>; });
      if (wanted.contact && is_crossing(pair) && has_vertices && change.choice >= 2)
        wanted.contact->normal = Vector3::Zero() - wanted.contact->normal;
      expect_same(wanted, answer(questions[1]));
    });
  }
  EXPECT_GT(asked, 6);
}

/// Two parts that a shape is cut into, where their corners are doubles.
std::optional<std::array<Box, 2>> cut(const Box& box) {
  const int axis = *integer(0, 2);
  std::array<Box, 2> parts{box, box};
  parts[0].max[axis] = parts[1].min[axis] = std::clamp(*any_number(Range()), box.min[axis], box.max[axis]);
  return parts;
}
template <class Long>
requires(kIsOneOf<Long, Capsule, Line>) std::optional<std::array<Long, 2>> cut(const Long& shape) {
  const auto middle = exact_middle(shape.start, shape.end);
  if (!middle) return std::nullopt;
  std::array<Long, 2> parts{shape, shape};
  parts[0].end = parts[1].start = *middle;
  return parts;
}
std::optional<std::array<Triangle, 2>> cut(const Triangle& triangle) {
  const auto& [v0, v1, v2] = triangle.vertices;
  const auto middle = exact_middle(v0, v1);
  if (!middle) return std::nullopt;
  return std::array<Triangle, 2>{{{{v0, *middle, v2}}, {{*middle, v1, v2}}}};
}
template <class Shape>
concept CanBeCut = requires(const Shape& shape) {
  cut(shape);
};

TEST(Production, of_two_parts_of_a_shape_lets_the_nearer_decide) {
  expect_holds_for_every_kind(
      []<class A, class B>(const Two<A, B>& shapes, Distances distances) requires(CanBeCut<A> || CanBeCut<B>) {
        const Expectation whole = answer(shapes, distances);
        std::optional<double> least;
        bool hit = false;
        const auto ask = [&](const Two<A, B>& part) {
          const Expectation said = answer(part, distances);
          hit = hit || said.hit;
          if (said.contact) least = std::min(least.value_or(said.contact->value), said.contact->value);
        };
        if constexpr (CanBeCut<B>) {
          const auto parts = cut(shapes.b);
          RC_PRE(parts.has_value());
          for (const B& part : *parts) ask({shapes.a, part});
        } else {
          const auto parts = cut(shapes.a);
          RC_PRE(parts.has_value());
          for (const A& part : *parts) ask({part, shapes.b});
        }
        RC_ASSERT(whole.hit == hit);
        // A centre inside a box is deeper in the whole than in a part.
        if (whole.contact && !(std::same_as<B, Box> && whole.contact->degenerate))
          RC_ASSERT(whole.contact->value == least);
      });
}

/// Calls visit(shape, simpler) for a shape that has shrunk, and the shape of another kind that it is now.
template <class Visit>
void for_each_simpler(Capsule shape, Visit visit) {
  shape.end = shape.start;
  visit(shape, Ball{shape.start, shape.radius});
}
template <class Visit>
void for_each_simpler(Ray shape, Visit visit) {
  shape.length = 0;
  visit(shape, Ball{shape.origin, 0});
}
template <class Visit>
void for_each_simpler(Box shape, Visit visit) {
  shape.max = shape.min;
  visit(shape, Ball{shape.min, 0});
}
template <class Visit>
void for_each_simpler(Triangle shape, Visit visit) {
  auto& v = shape.vertices;
  const auto twice = static_cast<std::size_t>(*integer(0, 2));
  v[twice] = v[(twice + 1) % 3];
  visit(shape, Capsule{v[twice], v[(twice + 2) % 3], 0});
  v.fill(v[twice]);
  visit(shape, Ball{v[twice], 0});
}
template <class Shape>
inline constexpr bool kCanShrink = kIsOneOf<Shape, Capsule, Ray, Box, Triangle>;
template <class A, class B>
Two<A, B> both(const A& a, const B& b) {
  return {a, b};
}
/// Asks of two shapes, and of what they are in other words.
template <class A, class B, class C, class D>
void expect_the_same_of_simpler(const Two<A, B>& shapes, const Two<C, D>& simpler, Distances distances) {
  if constexpr (IsPair<C, D> && numbers_of<A, B>() == numbers_of<C, D>()) {
    const Expectation said = answer(shapes, distances);
    // The way out of a box goes along an axis, and no face of it is nearer than another here.
    if (kIsOneOf<B, Box> && said.contact && (said.contact->degenerate || std::same_as<A, Cast>)) return;
    expect_same(said, answer(simpler, distances));
  }
}

TEST(Production, takes_a_shape_that_has_shrunk_for_the_simpler_one_that_it_is) {
  expect_holds_for_every_kind(
      []<class A, class B>(const Two<A, B>& shapes, Distances distances) requires(kCanShrink<A> || kCanShrink<B>) {
        if constexpr (kCanShrink<A>)
          for_each_simpler(shapes.a, [&](const auto& shrunk, const auto& simpler) {
            expect_the_same_of_simpler(both(shrunk, shapes.b), both(simpler, shapes.b), distances);
          });
        if constexpr (kCanShrink<B>)
          for_each_simpler(shapes.b, [&](const auto& shrunk, const auto& simpler) {
            expect_the_same_of_simpler(both(shapes.a, shrunk), both(shapes.a, simpler), distances);
          });
      });
}

bool is_far_from_the_ends_of_the_range(double x) {
  return x == 0 || (std::abs(x) > 0x1p-1000 && std::abs(x) < 0x1p1000);
}
/// The same shape with a direction that is some times as long.
template <class Ray>
requires(std::derived_from<Ray, contact::Ray>) Ray lengthened(Ray ray, double times) {
  ray.direction *= times;
  ray.length /= times;
  return ray;
}
Plane lengthened(const Plane& plane, double times) { return {plane.normal * times, plane.offset * times}; }
template <class Shape>
concept HasDirection = requires(const Shape& shape) {
  lengthened(shape, 2.0);
};

TEST(Production, reads_nothing_from_the_length_of_a_direction_but_t) {
  expect_holds_for_every_kind(
      []<class A, class B>(const Two<A, B>& shapes, Distances distances) requires(HasDirection<A> || HasDirection<B>) {
        const auto check = [](double x) { RC_PRE(is_far_from_the_ends_of_the_range(x)); };
        for_each_number(shapes.a, check);
        for_each_number(shapes.b, check);
        const double times = std::ldexp(1.0, *integer(-20, 20));
        Expectation said = answer(shapes, distances);
        Two<A, B> other = shapes;
        if constexpr (HasDirection<A>) {
          other.a = lengthened(shapes.a, times);
          if (std::same_as<A, Cast> && said.contact) said.contact->value /= times;
          if (said.contact) RC_PRE(is_far_from_the_ends_of_the_range(said.contact->value));
        }
        expect_same(said, answer(other, distances));
        if constexpr (HasDirection<B>)
          expect_same(said, answer(Two<A, B>{other.a, lengthened(shapes.b, times)}, distances));
      });
}

TEST(Production, of_a_longer_ray_says_what_it_said_of_the_shorter_that_hits) {
  expect_holds_for_every_kind([]<class A, class B>(
      Two<A, B> shapes, Distances distances) requires(std::derived_from<A, Ray> && !kHasDistance<A, B>) {
    const Expectation said = answer(shapes, distances);
    shapes.a.length = std::max(shapes.a.length, std::abs(*any_number(Range())));
    if (said.hit) expect_same(said, answer(shapes, distances));
  });
}

TEST(Production, leaves_nothing_outside_both_half_spaces_of_a_plane) {
  expect_holds_for_every_kind([]<class A>(const Two<A, Plane>& shapes, Distances) requires(kHasDistance<A, Plane>) {
    const Plane other{Vector3::Zero() - shapes.b.normal, 0 - shapes.b.offset};
    RC_ASSERT(is_hit(shapes, Distances{}) || is_hit(Two<A, Plane>{shapes.a, other}, Distances{}));
  });
}

TEST(Production, puts_points_of_every_convention_where_the_exact_oracle_has_them) {
  for (const Pair pair : pairs_of_kinds()) {
    if (!has_distance(pair)) continue;
    expect_holds(
        pair,
        [](const Query& query) {
          const Truth truth = oracle::truth_of(query);
          for (const PointOn on : {PointOn::nearest_surface, PointOn::center, PointOn::far_surface}) {
            const auto contact = std::visit(
                [&](const auto& shapes) {
                  return contact_of(shapes, query.distances, {on, on});
                },
                query.shapes);
            if (!contact) continue;
            for (int axis = 0; axis < 3; ++axis) {
              const auto exact = [&](int shape) {
                return oracle::round_to_nearest(truth.distance()->point(shape, axis, on), Scalar::binary64);
              };
              RC_ASSERT(contact->point1[axis] == exact(0));
              RC_ASSERT(contact->point2[axis] == exact(1));
            }
          }
        },
        pair == Pair::sphere_sphere ? 1 : 20);
  }
}

// What holds of one pair alone.

TEST(Production, of_a_capsule_over_a_plane_takes_the_lower_end_or_the_middle) {
  expect_holds_for_every_kind([](CapsuleAndPlane shapes, Distances distances) {
    Capsule& a = shapes.a;
    Plane& b = shapes.b;
    const auto of_sphere = [&](const Vector3& center) {
      return answer(BallAndPlane{{center, a.radius}, b}, distances);
    };
    RC_ASSERT(is_hit(shapes, distances) == (of_sphere(a.start).hit || of_sphere(a.end).hit));
    if (rise(shapes) != 0) expect_same(answer(shapes, distances), of_sphere(rise(shapes) < 0 ? a.end : a.start));
    // Along the plane.
    const int axis = *integer(0, 2);
    b.normal = Vector3::Unit(axis) * (b.normal[axis] == 0 ? 1 : b.normal[axis]);
    a.end[axis] = a.start[axis];
    const auto middle = exact_middle(a.start, a.end);
    RC_PRE(a.start != a.end && middle.has_value());
    Expectation sphere = of_sphere(*middle);
    if (sphere.contact) sphere.contact->unique = false;
    expect_same(answer(shapes, distances), sphere);
  });
}

TEST(Production, has_no_edge_of_a_triangle_nearer_than_the_triangle) {
  expect_holds_for_every_kind([](const BallAndTriangle& shapes, Distances distances) {
    const Expectation whole = answer(shapes, distances);
    const auto& v = shapes.b.vertices;
    for (std::size_t i = 0; i < 3; ++i) {
      const Expectation edge = answer(BallAndCapsule{shapes.a, {v[i], v[(i + 1) % 3], 0}}, distances);
      RC_ASSERT(!edge.hit || whole.hit);
      if (edge.hit) RC_ASSERT(edge.contact->value >= whole.contact->value);
    }
  });
}

TEST(Production, takes_a_ray_whose_end_is_a_point_of_doubles_for_a_capsule_without_radius) {
  expect_holds_for_every_kind([](const RayAndBall& shapes, Distances distances) {
    const auto& [a, b] = shapes;
    Vector3 end;
    for (int axis = 0; axis < 3; ++axis) {
      const double way = a.length * a.direction[axis];
      RC_PRE(std::isfinite(way) && std::fma(a.length, a.direction[axis], -way) == 0 &&
             (way == 0 || std::abs(way) > 0x1p-900));
      end[axis] = a.origin[axis] + way;
      RC_PRE(std::isfinite(end[axis]) && end[axis] - a.origin[axis] == way && end[axis] - way == a.origin[axis]);
    }
    expect_same(answer(shapes, distances),
                answer(Capsules{{a.origin, end, 0}, {b.center, b.center, b.radius}}, distances));
  });
}

TEST(Production, takes_a_line_for_a_ray_and_turns_the_normal) {
  expect_holds_for_every_kind([](const TriangleAndLine& shapes, Distances distances) {
    const auto& [a, b] = shapes;
    const Vector3 way = b.end - b.start;
    for (int axis = 0; axis < 3; ++axis)
      RC_PRE(std::isfinite(way[axis]) && way[axis] + b.start[axis] == b.end[axis] &&
             b.end[axis] - way[axis] == b.start[axis]);
    RC_PRE(!way.isZero(0));
    Expectation ray = answer(RayAndTriangle{{b.start, way, 1}, a}, distances);
    if (ray.contact) ray.contact->normal = Vector3::Zero() - ray.contact->normal;
    expect_same(answer(shapes, distances), ray);
  });
}

// A crossing in a representable point is at no distance from both shapes.
TEST(Production, has_a_crossing_in_both_shapes) {
  int asked = 0;
  expect_holds(Pair::ray_triangle, [&](const Query& query) {
    const auto& [a, b] = std::get<RayAndTriangle>(query.shapes);
    const Expectation said = answer(query);
    if (!said.hit) return;
    const auto exact = oracle::witness(oracle::truth_of(query), Scalar::binary64).crossing;
    for (const std::string& coordinate : *exact)
      if (coordinate.find('/') != std::string::npos || coordinate.size() >= 15) return;
    ++asked;
    RC_ASSERT(is_hit(RayAndBall{a, {said.contact->point1, 0}}, Distances{}));
    RC_ASSERT(is_hit(BallAndTriangle{{said.contact->point2, 0}, b}, Distances{}));
  });
  EXPECT_GT(asked, 100);
}

}  // namespace
}  // namespace contact::production_properties
