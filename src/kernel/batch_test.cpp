// The batch API: every instruction set that is at hand gives the bits of the functions of one pair and of the oracle,
// on questions of every family and on those that only vectors can get wrong.
//
// CONTACT_BATCH_QUESTIONS sets how many questions a family makes, CONTACT_BATCH_SEED which ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "contact/pair_functions.hpp"
#include "contact/sphere_sphere.hpp"
#include "environment/floating_point_environments.hpp"
#include "golden/families.hpp"
#include "kernel/batch.hpp"
#include "kernel/batch_cores.hpp"
#include "kernel/batch_pairs.hpp"
#include "kernel/sphere_sphere_numbers.hpp"
#include "oracle/truth/staged_oracle.hpp"

namespace contact {
namespace {

std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
  const char* given = std::getenv(name);
  return given ? std::strtoull(given, nullptr, 10) : otherwise;
}

#ifdef CONTACT_SANITIZED
constexpr std::uint64_t kUsually = 25;  // of each family; with sanitizers a question takes some twenty times as long
#else
constexpr std::uint64_t kUsually = 80;
#endif
const std::uint64_t kQuestions = from_environment("CONTACT_BATCH_QUESTIONS", kUsually);
const std::uint64_t kSeed = from_environment("CONTACT_BATCH_SEED", 7);

/// Runs a piece of a test with one instruction set after the other.
void for_each_instruction_set(const std::function<void()>& work) {
  for (const std::string& name : kernel::instruction_sets()) {
    SCOPED_TRACE(name);
    kernel::use_instruction_set(name);
    work();
    if (testing::Test::HasFailure()) break;
  }
  kernel::use_instruction_set("");
}

/// The kinds of pairs that have batch functions.
#define CONTACT_TYPE(name, A, B) , Two<A, B>
template <class... Kinds>
struct TypesOf;
template <class... Kinds>
struct TypesOf<void, Kinds...> {
  using Contacts = testing::Types<Kinds...>;
};
using KindsWithContacts = TypesOf<void CONTACT_BATCH_CONTACTS(CONTACT_TYPE)>::Contacts;
using Kinds = TypesOf<void CONTACT_BATCH_PAIRS(CONTACT_TYPE)>::Contacts;
#undef CONTACT_TYPE

/// The first pair of a kind.
template <class Kind>
Pair pair_of() {
  return pairs_of_kinds()[Shapes(Kind{}).index()];
}

struct PairNames {
  template <class Kind>
  static std::string GetName(int /*index*/) {
    return std::string(name(pair_of<Kind>()));
  }
};

template <class Kind>
using Many = std::vector<Kind>;

template <class A, class B>
batch::Pairs<A, B> in_columns(const Many<Two<A, B>>& shapes) {
  batch::Pairs<A, B> pairs(shapes.size());
  for (std::size_t i = 0; i < shapes.size(); ++i) pairs.set(i, shapes[i]);
  return pairs;
}

/// A row of an answer as bits: ten numbers and the state.
using Row = std::array<std::uint64_t, 11>;

Row row_of(Contact contact, batch::PairState state) {
  Row bits{};
  for (std::size_t k = 0; k < 10; ++k) bits[k] = std::bit_cast<std::uint64_t>(batch::number_of(contact, k));
  bits[10] = static_cast<std::uint64_t>(state);
  return bits;
}
Row row_of(const std::optional<Contact>& contact) {
  if (!contact) return {};
  return row_of(*contact, batch::state_of(*contact));
}
template <class A, class B>
Row row_of(const batch::Pairs<A, B>& pairs, std::size_t row) {
  return row_of(pairs.numbers(row), pairs.state()[row]);
}

template <class A, class B>
std::string words(const Two<A, B>& shapes, Distances distances) {
  std::string text;
  const auto add = [&](double x) {
    char buffer[40];
    std::snprintf(buffer, sizeof buffer, "%a ", x);
    text += buffer;
  };
  for_each_number(shapes.a, add);
  for_each_number(shapes.b, add);
  add(distances.alarm);
  add(distances.contact);
  return text;
}

/// The numbers of two balls by the stages that share no formula with the vectors.
void expect_stages_agree(const Balls& balls, Distances distances, ContactPoints points, const Contact& contact) {
  Contact otherwise = contact;
  kernel::round_numbers(balls.a, balls.b, distances.contact, points, kernel::kAllNumbers, otherwise);
  EXPECT_EQ(row_of(contact), row_of(otherwise)) << words(balls, distances);
}
template <class A, class B>
void expect_stages_agree(const Two<A, B>& /*shapes*/, Distances, ContactPoints, const Contact& /*contact*/) {}

/// What the function of one pair says.
template <class Kind>
Row expected_row(const Kind& shapes, Distances distances, ContactPoints points) {
  const auto contact = contact_of(shapes, distances, points);
  if (contact) expect_stages_agree(shapes, distances, points, *contact);
  return row_of(contact);
}

/// What the oracle says, where it knows the convention and has such an alarm distance.
template <class Kind>
void expect_oracle_agrees(const Row& row, const Kind& shapes, Distances distances, ContactPoints points) {
  if (points.first != PointOn::nearest_surface || points.second != PointOn::nearest_surface) return;
  if (!std::isfinite(distances.alarm)) return;
  const Expectation expected = oracle::staged_answer({pair_of<Kind>(), shapes, distances}, Scalar::binary64).expected;
  EXPECT_EQ(row, row_of(expected.contact)) << words(shapes, distances);
}

/// Every instruction set answers all pairs as the functions of one pair do; returns the pairs that the best one left to
/// them.
template <class A, class B>
std::size_t expect_same_bits(const Many<Two<A, B>>& shapes, Distances distances, ContactPoints points = {}) {
  const std::size_t size = shapes.size();
  std::vector<std::uint8_t> decisions;
  for (const Two<A, B>& two : shapes) decisions.push_back(is_hit(two, distances) ? 1 : 0);
  const auto hit_count = static_cast<std::size_t>(std::count(decisions.begin(), decisions.end(), 1));
  std::vector<Row> expected;
  std::vector<std::uint32_t> hits;
  if constexpr (batch::Computes<A, B>)
    for (std::size_t i = 0; i < size; ++i) {
      expected.push_back(expected_row(shapes[i], distances, points));
      expect_oracle_agrees(expected.back(), shapes[i], distances, points);
      if (expected[i][10] != 0) hits.push_back(static_cast<std::uint32_t>(i));
      EXPECT_EQ(decisions[i] != 0, expected[i][10] != 0);
    }
  std::size_t exact = 0;
  bool best = true;
  for_each_instruction_set([&] {
    auto pairs = in_columns(shapes);
    EXPECT_EQ(pairs.test(distances.alarm).hits, hit_count);
    for (std::size_t i = 0; i < size; ++i) EXPECT_EQ(pairs.hit()[i], decisions[i]) << words(shapes[i], distances);
    if constexpr (batch::Computes<A, B>) {
      const batch::Count count = pairs.compute(distances, points);
      EXPECT_EQ(count.hits, hits.size());
      if (best) exact = count.exact;
      best = false;
      for (std::size_t i = 0; i < size; ++i)
        EXPECT_EQ(row_of(pairs, i), expected[i]) << i << ": " << words(shapes[i], distances);
      auto compact = in_columns(shapes);
      ASSERT_EQ(compact.compute_hits(distances, points).hits, hits.size());
      for (std::size_t k = 0; k < hits.size(); ++k) {
        EXPECT_EQ(compact.index()[k], hits[k]);
        EXPECT_EQ(row_of(compact, k), expected[hits[k]]) << words(shapes[hits[k]], distances);
      }
    }
  });
  return exact;
}

template <class Kind>
const Kind& shapes_of(const Query& query) {
  return std::get<Kind>(query.shapes);
}

/// Questions one after the other, each with its own distances for itself and those that follow it: a number of pairs
/// that fills no vector.
template <class Kind>
void expect_same_bits_with_followers(const std::vector<Query>& queries, ContactPoints points = {}) {
  constexpr std::size_t kFollowers = 10;
  for (std::size_t k = 0; k < queries.size() && !testing::Test::HasFailure(); ++k) {
    Many<Kind> shapes;
    for (std::size_t j = 0; j <= kFollowers; ++j) shapes.push_back(shapes_of<Kind>(queries[(k + j) % queries.size()]));
    expect_same_bits(shapes, queries[k].distances, points);
  }
}

std::vector<Query> questions_of(Pair pair, const golden::Family& family, Scalar scalar,
                                std::uint64_t count = kQuestions) {
  std::vector<Query> queries;
  for (std::uint64_t i = 0; i < count; ++i) queries.push_back(golden::generate_query(pair, family, scalar, kSeed, i));
  return queries;
}

template <class Kind>
class Batch : public testing::Test {};
TYPED_TEST_SUITE(Batch, Kinds, PairNames);

TYPED_TEST(Batch, gives_the_bits_of_one_pair_on_every_family) {
  for (const golden::Family& family : golden::families_of(pair_of<TypeParam>())) {
    if (family.outside_domain) continue;
    for (const Scalar scalar : kScalars) {
      SCOPED_TRACE(std::string(family.name) + " " + std::string(name(scalar)));
      const std::vector<Query> queries = questions_of(pair_of<TypeParam>(), family, scalar);
      expect_same_bits_with_followers<TypeParam>(queries);
      EXPECT_TRUE(std::any_of(queries.begin(), queries.end(),
                              [](const Query& query) { return is_hit(shapes_of<TypeParam>(query), query.distances); }));
    }
  }
}

/// A shape of which all points are at `point` and all lengths are 0; a half-space on the far side of it.
template <class Shape>
Shape shape_at(const Vector3& point) {
  Shape shape = zero_shape<Shape>();
  for_each_field(shape, [&](const auto& field, auto& value) {
    if (field.kind == FieldKind::point) for_each_vector(value, [&](Vector3& v) { v = point; });
    if (field.kind == FieldKind::direction) for_each_vector(value, [&](Vector3& v) { v = -point.cwiseSign(); });
    if (field.kind == FieldKind::offset)
      for_each_number_in(value, [&](double& x) { x = -point.lpNorm<Eigen::Infinity>(); });
  });
  return shape;
}
template <class A, class B>
void put_apart(const Vector3& half, Two<A, B>& shapes) {
  shapes = {shape_at<A>(half), shape_at<B>(-half)};
}

TYPED_TEST(Batch, an_infinite_alarm_distance_is_no_limit) {
  constexpr double kMost = std::numeric_limits<double>::max();
  const std::array<Vector3, 6> halves{Vector3(kMost, 0, 0),         Vector3(0, -kMost, 0), Vector3(0, 0, kMost),
                                      Vector3(kMost, kMost, kMost), Vector3(1, 0, 0),      Vector3(1, 2, -3)};
  Many<TypeParam> shapes(19);
  for (std::size_t i = 0; i < shapes.size(); ++i) put_apart(halves[i % halves.size()], shapes[i]);
  const Distances distances{std::numeric_limits<double>::infinity(), 0};
  const bool counts = !is_crossing(pair_of<TypeParam>());
  for (const TypeParam& two : shapes) EXPECT_EQ(is_hit(two, distances), counts) << words(two, distances);
  expect_same_bits(shapes, distances);
}

/// A question of a test's own family.
using Make = Query (*)(golden::Random&);

std::vector<Query> questions_of(const char* family, Make make) {
  std::vector<Query> queries;
  for (std::uint64_t i = 0; i < kQuestions; ++i) {
    golden::Random random(golden::Random::key("sphere_sphere", family, "binary64", kSeed), i);
    queries.push_back(make(random));
  }
  return queries;
}

double any_magnitude(golden::Random& random, int low, int high) {
  return random.with_sign(random.magnitude<double>(low, high));
}

/// Touching but for products of d's components that underflow: a square or a cross product that comes out 0 must not be
/// taken for a proof.
Query underflowing(golden::Random& random) {
  Ball a{{0, 0, 0}, 0.5};
  Ball b{{0, 0, 0}, 0.5};
  const auto axis = static_cast<Eigen::Index>(random.below(3));
  b.center[axis] = random.with_sign(1.0);
  const double tiny = random.with_sign(std::ldexp(1.0, -random.between(400, 1074)));
  switch (random.turn(5)) {
    case 0:
      b.center[(axis + 1) % 3] = tiny;
      break;
    case 1:  // the exact difference has a low part that is tiny
      a.center[axis] = tiny;
      break;
    case 2:
      b.radius += std::ldexp(1.0, -60);
      b.center[(axis + 2) % 3] = tiny;
      a.radius = std::abs(tiny);
      break;
    case 3:
      a.radius = 1;
      b.radius = std::abs(tiny);
      b.center[(axis + 1) % 3] = tiny;
      break;
    default:
      a.center[(axis + 1) % 3] = tiny;
      a.radius = 1;
      b.radius = 0;
  }
  const double far = std::ldexp(1.0, random.chance(2) ? 0 : random.between(-60, 400));
  a.center *= far;
  b.center *= far;
  a.radius *= far;
  b.radius *= far;
  return {Pair::sphere_sphere, Balls{a, b}, {0, 0}};
}

/// Coincident centres, and T a sum of three numbers about half way between two doubles.
Query coincident_near_a_tie(golden::Random& random) {
  const Vector3 center(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
  const double r = random.uniform(1.0, 2.0);
  double half = 0x1p-53;
  if (random.chance(3)) half += std::ldexp(1.0, -random.between(54, 106));
  if (random.chance(3)) half -= std::ldexp(1.0, -random.between(55, 106));
  const double least = random.chance(4) ? 0 : std::ldexp(random.uniform(1.0, 2.0), -random.between(90, 200));
  return {Pair::sphere_sphere, Balls{{center, r}, {center, half}}, {0, least}};
}

/// Touching up to 2^-107 .. 2^-158 of the distance: T is the distance's leading bits in three numbers, the last of
/// which is cut. What the near path's sums lose is of the same size.
Query touching_beyond_two_numbers(golden::Random& random) {
  using Real =
      boost::multiprecision::number<boost::multiprecision::cpp_bin_float<400, boost::multiprecision::digit_base_2>,
                                    boost::multiprecision::et_off>;
  Balls balls{};
  Real D = 0;
  for (int k = 0; k < 3; ++k) {
    balls.a.center[k] = random.uniform(-0.001, 0.001);
    balls.b.center[k] = random.uniform(-1.0, 1.0);
    const Real d = Real(balls.b.center[k]) - Real(balls.a.center[k]);
    D += d * d;
  }
  Real rest = sqrt(D);
  const auto lower = [&rest] {
    auto part = static_cast<double>(rest);
    if (Real(part) > rest) part = std::nextafter(part, 0.0);
    rest -= Real(part);
    return part;
  };
  balls.a.radius = lower();
  balls.b.radius = lower();
  double last = lower();
  const std::uint64_t cut = (std::uint64_t{1} << random.between(0, 52)) - 1;
  last = std::bit_cast<double>(std::bit_cast<std::uint64_t>(last) & ~cut);
  if (random.chance(2)) last = std::nextafter(last, 1.0);
  return {Pair::sphere_sphere, balls, {last, last}};
}

/// Centres on a line along an axis, a distance of 54 bits apart, and a value half way between two doubles, or beside
/// that.
Query one_axis_at_a_tie(golden::Random& random) {
  const auto axis = static_cast<Eigen::Index>(random.below(3));
  const double side = random.with_sign(1.0);
  Balls balls{};
  for (int k = 0; k < 3; ++k) balls.a.center[k] = balls.b.center[k] = random.uniform(-1.0, 1.0);
  balls.a.center[axis] = side * random.with_sign(0x1p-53);
  balls.b.center[axis] = side * random.uniform(1.0, 1.5);
  const double small = std::ldexp(static_cast<double>(random.below(4)), -52);
  balls.a.radius = random.chance(2) ? small : 0.25 + small;
  if (random.chance(2)) balls.b.radius = std::ldexp(1.0, -random.between(2, 120));
  return {Pair::sphere_sphere, balls, {2, random.chance(2) ? 0 : small}};
}

/// A contact point near a coordinate plane: nearly all of it cancels, all but 2^-bits.
Query near_a_plane(golden::Random& random, int bits) {
  Ball a{{}, random.uniform(0.5, 2.0)};
  Ball b{{}, random.uniform(0.5, 2.0)};
  Vector3 delta;
  for (int k = 0; k < 3; ++k) {
    a.center[k] = random.uniform(-1.0, 1.0);
    delta[k] = random.uniform(-1.0, 1.0);
  }
  const Vector3 n = delta / std::sqrt(delta.dot(delta));
  const auto axis = static_cast<Eigen::Index>(random.below(3));
  a.center[axis] = -a.radius * n[axis] * (1 + random.with_sign(std::ldexp(1.0, -bits)));
  b.center = a.center + delta;
  return {Pair::sphere_sphere, Balls{a, b}, {random.uniform(0.0, 1.0), random.uniform(0.0, 1.0)}};
}
Query near_a_plane(golden::Random& random) { return near_a_plane(random, random.between(15, 60)); }
/// Where what is left is as small as what the quick way loses.
Query nearer_a_plane(golden::Random& random) { return near_a_plane(random, random.between(44, 53)); }

/// Every number of a magnitude of its own, zeros of both signs among them.
Query anything(golden::Random& random) {
  const auto any = [&](bool sign) {
    if (random.chance(5)) return sign && random.chance(2) ? -0.0 : 0.0;
    const double x = any_magnitude(random, -1074, 1022);
    return sign ? x : std::abs(x);
  };
  const auto ball = [&] {
    Ball made;
    for (int k = 0; k < 3; ++k) made.center[k] = any(true);
    made.radius = any(false);
    return made;
  };
  const Ball a = ball();
  const Ball b = ball();
  const double alarm = any(false);
  return {Pair::sphere_sphere, Balls{a, b}, {alarm, any(false)}};
}

/// Whole numbers on a small grid: touching, coincident, in a plane, along an axis, and ties of every kind.
Query on_a_grid(golden::Random& random) {
  const double unit = std::ldexp(1.0, random.chance(2) ? 0 : random.between(-1070, 1000));
  const auto ball = [&] {
    Ball made;
    for (int k = 0; k < 3; ++k) made.center[k] = random.with_sign(static_cast<double>(random.below(4)) * unit);
    made.radius = static_cast<double>(random.below(4)) * unit;
    return made;
  };
  Ball a = ball();
  const Ball b = ball();
  if (random.chance(3)) a.radius += std::ldexp(unit, -52);
  const double alarm = static_cast<double>(random.below(3)) * unit;
  return {Pair::sphere_sphere, Balls{a, b}, {alarm, random.chance(2) ? alarm : 0.1 * unit}};
}

/// The surfaces within a few ulps of the alarm distance, and of the contact distance, at any scale, d_y and d_z of any
/// size beside d_x.
Query touching_at_any_scale(golden::Random& random) {
  Ball a{{}, random.uniform(0.5, 2.0)};
  Ball b{{}, random.uniform(0.0, 2.0)};
  Vector3 delta{random.uniform(-1.0, 1.0), any_magnitude(random, -70, 0), any_magnitude(random, -70, 0)};
  for (int k = 0; k < 3; ++k) a.center[k] = random.with_sign(random.uniform(0.0, 1.0));
  b.center = a.center + delta;
  delta = b.center - a.center;
  const double length = std::sqrt(delta.dot(delta));
  a.radius = length * random.unit<double>();
  b.radius = length - a.radius;
  double alarm = 0;
  if (random.chance(2)) {
    alarm = b.radius * random.unit<double>();
    b.radius -= alarm;
  }
  for (int ulps = random.between(0, 3); ulps > 0; --ulps)
    b.radius = std::nextafter(b.radius, random.chance(2) ? 1e300 : 0);
  const double contact = random.chance(2) ? alarm : 0;
  const double scale = std::ldexp(1.0, random.chance(2) ? 0 : random.between(-900, 900));
  a.center *= scale;
  b.center *= scale;
  return {Pair::sphere_sphere,
          Balls{{a.center, a.radius * scale}, {b.center, b.radius * scale}},
          {alarm * scale, contact * scale}};
}

/// Ordinary pairs where the numbers of the answer lose bits to the bottom of the range, or are lost themselves.
Query at_the_bottom(golden::Random& random) {
  const double scale = std::ldexp(1.0, -random.between(890, 1074));
  const auto ball = [&] {
    Ball made;
    for (int k = 0; k < 3; ++k) made.center[k] = random.uniform(-4.0, 4.0) * scale;
    made.radius = random.uniform(0.0, 4.0) * scale;
    return made;
  };
  const Ball a = ball();
  const Ball b = ball();
  const double alarm = random.uniform(0.0, 4.0) * scale;
  return {Pair::sphere_sphere, Balls{a, b}, {alarm, random.uniform(0.0, 4.0) * scale}};
}

/// Where sums of lengths, differences of coordinates and the answer itself pass the largest finite number.
Query at_the_top(golden::Random& random) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  const auto length = [&] { return random.chance(2) ? kLargest : random.uniform(0.0, 1.0) * kLargest; };
  const auto ball = [&] {
    Ball made{{0, 0, 0}, length()};
    for (int k = 0; k < 3; ++k)
      if (random.chance(2)) made.center[k] = random.with_sign(length());
    return made;
  };
  const Ball a = ball();
  Ball b = ball();
  if (random.chance(2)) b.center = a.center;
  const double alarm = random.chance(2) ? 0 : length();
  return {Pair::sphere_sphere, Balls{a, b}, {alarm, random.chance(2) ? alarm : length()}};
}

/// Ordinary pairs whose normal has components as small as numbers are.
Query small_component(golden::Random& random) {
  Balls balls{{{}, random.uniform(0.5, 2.0)}, {{}, random.uniform(0.5, 2.0)}};
  for (int k = 0; k < 3; ++k) {
    balls.a.center[k] = random.chance(2) ? 0 : any_magnitude(random, -1074, 0);
    balls.b.center[k] = random.chance(2) ? random.uniform(-2.0, 2.0) : any_magnitude(random, -1074, 0);
  }
  return {Pair::sphere_sphere, balls, {random.uniform(0.0, 4.0), random.uniform(0.0, 1.0)}};
}

/// Ordinary pairs and a contact distance that may be nothing beside them, or everything.
Query any_contact_distance(golden::Random& random) {
  Balls balls{{{}, random.uniform(0.5, 2.0)}, {{}, random.uniform(0.5, 2.0)}};
  for (int k = 0; k < 3; ++k) balls.b.center[k] = random.uniform(-2.0, 2.0);
  return {Pair::sphere_sphere, balls, {4, std::abs(any_magnitude(random, -1074, 1023))}};
}

const std::pair<const char*, Make> kFamiliesForVectors[] = {
    {"underflowing", underflowing},
    {"one_axis_at_a_tie", one_axis_at_a_tie},
    {"near_a_plane", near_a_plane},
    {"nearer_a_plane", nearer_a_plane},
    {"coincident_near_a_tie", coincident_near_a_tie},
    {"touching_beyond_two_numbers", touching_beyond_two_numbers},
    {"anything", anything},
    {"at_the_bottom", at_the_bottom},
    {"at_the_top", at_the_top},
    {"on_a_grid", on_a_grid},
    {"touching_at_any_scale", touching_at_any_scale},
    {"small_component", small_component},
    {"any_contact_distance", any_contact_distance}};

// Questions of a kind out of one of two balls.

Balls of_kind(const Balls& balls, golden::Random& /*random*/, const Balls* /*kind*/) { return balls; }

/// The first ball, and a box whose nearest point is the second one's centre, or which has the first one's in it.
BallAndBox of_kind(const Balls& balls, golden::Random& random, const BallAndBox* /*kind*/) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  BallAndBox made{balls.a, {balls.b.center, balls.b.center}};
  const bool inside = random.chance(4);
  for (int k = 0; k < 3; ++k) {
    const double center = balls.a.center[k];
    const double bound = balls.b.center[k];
    const double size = random.chance(3) ? 0 : random.chance(2) ? balls.b.radius : std::abs(bound - center);
    const double beyond = std::clamp(center < bound ? bound + size : bound - size, -kLargest, kLargest);
    const double other = inside ? std::clamp(center + (center - bound), -kLargest, kLargest)
                         : center == bound && random.chance(2) ? std::min(center + size, kLargest)
                                                               : beyond;
    made.b.min[k] = std::min(bound, other);
    made.b.max[k] = std::max(bound, other);
  }
  return made;
}

/// A capsule of a ball: the point nearest to another one is its centre, as an end or within, or its axis leads through.
Capsule of_ball(const Ball& ball, const Vector3& other, golden::Random& random) {
  static constexpr double kLargest = std::numeric_limits<double>::max();
  const auto finite = [](double x) { return std::clamp(x, -kLargest, kLargest); };
  const Vector3& q = ball.center;
  Capsule made{q, q, ball.radius};
  const int way = random.between(0, 3);
  const auto first = static_cast<Eigen::Index>(random.below(3));
  const Eigen::Index second = (first + 1) % 3;
  for (Eigen::Index k = 0; k < 3 && way == 1; ++k) made.end[k] = finite(q[k] + finite(q[k] - other[k]));  // straight on
  if (way == 2) made.start[second] = finite(q[second] + ball.radius);  // along an axis
  if (way == 3) {                                                      // across the distance
    const double to_first = finite(q[second] - other[second]);
    const double to_second = finite(other[first] - q[first]);
    made.start[first] = finite(q[first] - to_first);
    made.start[second] = finite(q[second] - to_second);
    made.end[first] = finite(q[first] + to_first);
    made.end[second] = finite(q[second] + to_second);
  }
  return made;
}
BallAndCapsule of_kind(const Balls& balls, golden::Random& random, const BallAndCapsule* /*kind*/) {
  return {balls.a, of_ball(balls.b, balls.a.center, random)};
}
Capsules of_kind(const Balls& balls, golden::Random& random, const Capsules* /*kind*/) {
  const Capsule first = of_ball(balls.a, balls.b.center, random);
  return {first, of_ball(balls.b, balls.a.center, random)};
}

double finite(double x) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  return std::isnan(x) ? 0 : std::clamp(x, -kLargest, kLargest);
}
Vector3 finite(const Vector3& v) { return {finite(v[0]), finite(v[1]), finite(v[2])}; }
/// A ball that reaches as far as both, for shapes without a radius.
Ball with_both_radii(const Balls& balls) { return {balls.a.center, finite(balls.a.radius + balls.b.radius)}; }
/// A vector that is not zero, of any length.
Vector3 direction(Vector3 v, golden::Random& random) {
  const double scale = std::ldexp(1.0, random.chance(2) ? 0 : random.between(-3, 3));
  if (v == Vector3::Zero()) v[static_cast<Eigen::Index>(random.below(3))] = random.with_sign(1.0);
  if (random.chance(4)) {  // along an axis
    const double length = std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]);
    v.setZero();
    v[static_cast<Eigen::Index>(random.below(3))] = random.with_sign(random.chance(2) ? 1 : finite(length));
  }
  const Vector3 scaled = finite(Vector3(scale * v));
  return scaled == Vector3::Zero() ? v : scaled;
}
/// The triangle of a capsule's axis and another corner, which may be on it.
Triangle of_axis(const Capsule& capsule, const Vector3& other, golden::Random& random) {
  const Vector3 corner = random.chance(3) ? other : random.chance(2) ? capsule.start : finite(Vector3(-other));
  Triangle made{{capsule.start, capsule.end, corner}};
  std::swap(made.vertices[0], made.vertices[random.below(3)]);
  return made;
}
Ray of_axis(const Capsule& capsule, golden::Random& random) {
  const Vector3 along = finite(Vector3(capsule.end - capsule.start));
  if (along == Vector3::Zero()) return {capsule.start, {0, 0, random.with_sign(1.0)}, 0};
  return {capsule.start, along, random.chance(2) ? 1 : random.uniform(0.0, 2.0)};
}
Plane below(const Vector3& above, const Vector3& on, golden::Random& random) {
  const Vector3 normal = direction(finite(Vector3(above - on)), random);
  return {normal, finite(normal.dot(on))};
}

BallAndTriangle of_kind(const Balls& balls, golden::Random& random, const BallAndTriangle* /*kind*/) {
  const Capsule axis = of_ball(balls.b, balls.a.center, random);
  return {with_both_radii(balls), of_axis(axis, balls.a.center, random)};
}
RayAndBall of_kind(const Balls& balls, golden::Random& random, const RayAndBall* /*kind*/) {
  const Capsule axis = of_ball(balls.b, balls.a.center, random);
  return {of_axis(axis, random), with_both_radii(balls)};
}
BallAndPlane of_kind(const Balls& balls, golden::Random& random, const BallAndPlane* /*kind*/) {
  return {with_both_radii(balls), below(balls.a.center, balls.b.center, random)};
}
CapsuleAndPlane of_kind(const Balls& balls, golden::Random& random, const CapsuleAndPlane* /*kind*/) {
  const Plane plane = below(balls.a.center, balls.b.center, random);
  return {of_ball(with_both_radii(balls), balls.b.center, random), plane};
}
RayAndTriangle of_kind(const Balls& balls, golden::Random& random, const RayAndTriangle* /*kind*/) {
  const Capsule through = of_ball(balls.a, balls.b.center, random);
  const Capsule axis = of_ball(balls.b, balls.a.center, random);
  return {of_axis(through, random), of_axis(axis, balls.a.center, random)};
}
TriangleAndLine of_kind(const Balls& balls, golden::Random& random, const TriangleAndLine* /*kind*/) {
  const Capsule through = of_ball(balls.a, balls.b.center, random);
  const Capsule axis = of_ball(balls.b, balls.a.center, random);
  return {of_axis(axis, balls.a.center, random), {through.start, through.end}};
}

template <class Kind>
std::vector<Query> of_kind(std::vector<Query> queries) {
  golden::Random random(golden::Random::key("sphere_sphere", "of_kind", "binary64", kSeed), 0);
  for (Query& query : queries) {
    query.shapes = of_kind(*query.balls(), random, static_cast<const Kind*>(nullptr));
    query.pair = pair_of<Kind>();
  }
  return queries;
}

/// Of all families, so that one vector holds pairs that take different ways.
Query of_any_family(golden::Random& random) {
  return kFamiliesForVectors[random.below(std::size(kFamiliesForVectors))].second(random);
}

template <class Kind>
class BatchOfContacts : public testing::Test {};
TYPED_TEST_SUITE(BatchOfContacts, KindsWithContacts, PairNames);

TYPED_TEST(BatchOfContacts, gives_the_bits_of_one_pair_where_vectors_are_on_their_own) {
  for (const auto& [name, make] : kFamiliesForVectors) {
    SCOPED_TRACE(name);
    expect_same_bits_with_followers<TypeParam>(of_kind<TypeParam>(questions_of(name, make)));
  }
}

TEST(BatchSphereSphere, sees_what_breaks_a_tie_however_far_below_it) {
  // The distance is 1 + 2^-52 and 2^-53, half way between two doubles; the radius takes next to nothing from it.
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {1.0, -1.0}) {
      Many<Balls> spheres;
      for (int k = 50; k < 330; ++k) {
        Balls balls{};
        balls.a.center.setZero();
        balls.b.center.setZero();
        balls.a.center[axis] = -side * 0x1p-53;
        balls.b.center[axis] = side * (1 + 0x1p-52);
        balls.a.radius = 0;
        balls.b.radius = std::ldexp(1.0, -k);
        spheres.push_back(balls);
      }
      expect_same_bits(spheres, {2, 0});
    }
}

TYPED_TEST(BatchOfContacts, gives_the_bits_of_one_pair_where_those_of_a_vector_differ) {
  expect_same_bits_with_followers<TypeParam>(of_kind<TypeParam>(questions_of("of_any_family", of_any_family)));
}

TYPED_TEST(BatchOfContacts, puts_points_where_the_convention_says) {
  for (const PointOn first : {PointOn::nearest_surface, PointOn::center, PointOn::far_surface})
    for (const PointOn second : {PointOn::nearest_surface, PointOn::center, PointOn::far_surface})
      for (const golden::Family& family : golden::families_of(pair_of<TypeParam>()))
        if (!family.outside_domain)
          expect_same_bits_with_followers<TypeParam>(
              questions_of(pair_of<TypeParam>(), family, Scalar::binary64, std::min<std::uint64_t>(kQuestions / 5, 20)),
              {first, second});
}

TYPED_TEST(BatchOfContacts, is_right_for_every_number_of_pairs) {
  const golden::Family& generic = *golden::find_family(pair_of<TypeParam>(), "generic");
  Many<TypeParam> shapes;
  Distances distances{};
  for (const Query& query : questions_of(pair_of<TypeParam>(), generic, Scalar::binary64, 40)) {
    expect_same_bits(shapes, distances);
    shapes.push_back(shapes_of<TypeParam>(query));
    distances = query.distances;
  }
  for (const Query& query : questions_of(pair_of<TypeParam>(), generic, Scalar::binary64, 1500))
    shapes.push_back(shapes_of<TypeParam>(query));
  expect_same_bits(shapes, distances);
}

TEST(BatchSphereSphere, leaves_few_pairs_to_exact_arithmetic) {
  kernel::use_instruction_set("");
  if (!kernel::vectors_compute_contacts()) GTEST_SKIP() << "no fused multiply-add in vectors here";
  const auto share = [](const char* family, Distances distances, bool hits_alone = false) {
    Many<Balls> spheres;
    for (std::uint64_t i = 0; i < 2000; ++i) {
      const Query query = golden::generate_query(Pair::sphere_sphere, *golden::find_family(Pair::sphere_sphere, family),
                                                 Scalar::binary64, kSeed, i);
      const Balls& balls = *query.balls();
      if (!hits_alone || test_sphere_sphere(balls.a, balls.b, query.distances.alarm)) spheres.push_back(balls);
    }
    return static_cast<double>(expect_same_bits(spheres, distances)) / static_cast<double>(spheres.size());
  };
  for (const Distances distances : {Distances{0, 0}, Distances{0.25, 0.25}, Distances{0.5, 0.0625}}) {
    SCOPED_TRACE(std::to_string(distances.alarm) + " " + std::to_string(distances.contact));
    EXPECT_LE(share("generic", distances), 0.0);
    EXPECT_LE(share("near_touching", distances), 0.01);
    EXPECT_LE(share("touching", distances), 0.05);
    EXPECT_LE(share("far_from_origin", distances), 0.01);
    EXPECT_LE(share("containment", distances), 0.01);
    EXPECT_LE(share("coincident", distances), 0.01);
    // Those that just miss have radii as small as their distance, and are another thing.
    EXPECT_LE(share("near_coincident", distances, true), 0.05);
    EXPECT_LE(share("near_coincident", distances), 0.15);
  }
}

/// The share of a family's questions that the best vectors leave to the function of one pair.
template <class Kind>
double share_left(const char* family, Distances distances) {
  Many<Kind> shapes;
  for (const Query& query :
       questions_of(pair_of<Kind>(), *golden::find_family(pair_of<Kind>(), family), Scalar::binary64, 2000))
    shapes.push_back(shapes_of<Kind>(query));
  return static_cast<double>(expect_same_bits(shapes, distances)) / static_cast<double>(shapes.size());
}

TEST(BatchSphereCube, leaves_few_pairs_to_exact_arithmetic) {
  kernel::use_instruction_set("");
  if (!kernel::vectors_compute_contacts()) GTEST_SKIP() << "no fused multiply-add in vectors here";
  // With the last, sums of two numbers are none.
  for (const Distances distances : {Distances{0, 0}, Distances{0.5, 0.0625}, Distances{1e200, 0.0625}}) {
    SCOPED_TRACE(std::to_string(distances.alarm) + " " + std::to_string(distances.contact));
    EXPECT_LE(share_left<BallAndBox>("generic", distances), 0.0);
    EXPECT_LE(share_left<BallAndBox>("near_touching", distances), 0.02);
    EXPECT_LE(share_left<BallAndBox>("flat", distances), 0.02);
    EXPECT_LE(share_left<BallAndBox>("on_boundary", distances), 0.01);
    EXPECT_LE(share_left<BallAndBox>("inside", distances), 0.75);
  }
}

#define CONTACT_TYPE(name, A, B) , Two<A, B>
template <class Kind>
class BatchOfCores : public testing::Test {};
TYPED_TEST_SUITE(BatchOfCores, TypesOf<void CONTACT_CORES(CONTACT_TYPE)>::Contacts, PairNames);
#undef CONTACT_TYPE

TYPED_TEST(BatchOfCores, leaves_few_pairs_to_exact_arithmetic) {
  kernel::use_instruction_set("");
  if (!kernel::vectors_compute_contacts()) GTEST_SKIP() << "no fused multiply-add in vectors here";
  constexpr bool kOverPlane = std::same_as<TypeParam, BallAndPlane> || std::same_as<TypeParam, CapsuleAndPlane>;
  constexpr std::array<std::pair<const char*, double>, 6> kMost{{{"generic", 0},
                                                                 {"units", 0.01},
                                                                 {"alarm_edge", 0.06},
                                                                 {"far_from_origin", kOverPlane ? 0.17 : 0.15},
                                                                 {"along_axes", 0.25},
                                                                 {"thin", 0.55}}};
  for (const Distances distances : {Distances{0, 0}, Distances{0.5, 0.0625}})
    for (const auto& [family, most] : kMost) {
      if (golden::find_family(pair_of<TypeParam>(), family) == nullptr) continue;
      EXPECT_LE(share_left<TypeParam>(family, distances), most) << family << " " << distances.alarm;
    }
}

using KindsWithDistance = testing::Types<BallAndCapsule, Capsules, BallAndTriangle, RayAndBall>;
template <class A, class B>
kernel::PairColumns<A, B> pair_columns(const Two<A, B>* /*kind*/) {
  return {};
}

template <class Kind>
class BatchOfDistances : public testing::Test {};
TYPED_TEST_SUITE(BatchOfDistances, KindsWithDistance, PairNames);

using Real =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<600, boost::multiprecision::digit_base_2>,
                                  boost::multiprecision::et_off>;
using RealVector = std::array<Real, 3>;

RealVector difference(const Vector3& b, const Vector3& a) {
  return {Real(b[0]) - a[0], Real(b[1]) - a[1], Real(b[2]) - a[2]};
}
Real dot(const RealVector& a, const RealVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Real length(const RealVector& a) { return sqrt(dot(a, a)); }
Real clamped(const Real& t) { return std::clamp(t, Real(0), Real(1)); }

/// Of w + t v - s u, s and t from 0 to 1, the shortest: s u, and the way.
std::pair<RealVector, RealVector> shortest(const RealVector& w, const RealVector& u, const RealVector& v) {
  std::pair<RealVector, RealVector> best;
  bool first = true;
  const auto take = [&](const Real& s, const Real& t) {
    std::pair<RealVector, RealVector> found;
    for (std::size_t k = 0; k < 3; ++k) {
      found.first[k] = s * u[k];
      found.second[k] = w[k] + t * v[k] - s * u[k];
    }
    if (first || length(found.second) < length(best.second)) best = found;
    first = false;
  };
  const Real A = dot(u, u);
  const Real B = dot(u, v);
  const Real E = dot(v, v);
  // The least of all: each end with its foot, and where the lines are nearest.
  for (const int end : {0, 1}) {
    take(end, E == 0 ? Real(0) : clamped((end * B - dot(v, w)) / E));
    take(A == 0 ? Real(0) : clamped((end * B + dot(u, w)) / A), end);
  }
  const Real det = A * E - B * B;
  if (det != 0) {
    const Real s = (dot(u, w) * E - B * dot(v, w)) / det;
    const Real t = (B * dot(u, w) - A * dot(v, w)) / det;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) take(s, t);
  }
  return best;
}

const RealVector kNoWay{0, 0, 0};
RealVector cross(const RealVector& a, const RealVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// The point of the first core nearest to the second one, less its start, and from there to the nearest point.
std::pair<RealVector, RealVector> nearest(const Capsules& two) {
  const auto& [a, b] = two;
  return shortest(difference(b.start, a.start), difference(a.end, a.start), difference(b.end, b.start));
}
std::pair<RealVector, RealVector> nearest(const BallAndCapsule& two) {
  const auto& [a, b] = two;
  return shortest(difference(b.start, a.center), kNoWay, difference(b.end, b.start));
}
/// From the ball to the ray.
std::pair<RealVector, RealVector> nearest(const RayAndBall& two) {
  const auto& [a, b] = two;
  RealVector along;
  for (std::size_t k = 0; k < 3; ++k) along[k] = Real(a.length) * a.direction[static_cast<Eigen::Index>(k)];
  return shortest(difference(a.origin, b.center), kNoWay, along);
}
std::pair<RealVector, RealVector> nearest(const BallAndTriangle& two) {
  const auto& v = two.b.vertices;
  std::pair<RealVector, RealVector> best;
  bool first = true;
  const auto take = [&](const RealVector& way) {
    if (first || length(way) < length(best.second)) best = {kNoWay, way};
    first = false;
  };
  for (std::size_t k = 0; k < 3; ++k)
    take(shortest(difference(v[k], two.a.center), kNoWay, difference(v[(k + 1) % 3], v[k])).second);
  // Over the face: n.(w_k x w_(k+1)) >= 0 for every edge.
  const RealVector n = cross(difference(v[1], v[0]), difference(v[2], v[0]));
  bool inside = dot(n, n) != 0;
  for (std::size_t k = 0; k < 3; ++k)
    inside = inside && dot(n, cross(difference(v[k], two.a.center), difference(v[(k + 1) % 3], two.a.center))) >= 0;
  if (inside) {
    const Real t = dot(n, difference(v[0], two.a.center)) / dot(n, n);
    take({t * n[0], t * n[1], t * n[2]});
  }
  return best;
}

// Two of the kind of numbers from -1 to 1, made small, or nearly parallel, or thin.
void make_special(BallAndCapsule& two, double small, golden::Random& random) {
  if (random.chance(4)) two.b.end = two.b.start + small * two.b.end;
}
void make_special(Capsules& two, double small, golden::Random& random) {
  if (random.chance(4)) two.b.end = two.b.start + small * two.b.end;
  if (random.chance(4)) two.a.end = two.a.start + small * two.a.end;
  const double slant = std::ldexp(1.0, -random.between(0, 12));
  if (random.chance(3)) two.b.end = two.b.start + (two.a.end - two.a.start) + slant * two.b.end;
}
void make_special(RayAndBall& two, double small, golden::Random& random) {
  two.a.length = std::abs(two.a.length);
  if (random.chance(4)) two.a.direction *= small;
}
void make_special(BallAndTriangle& two, double small, golden::Random& random) {
  auto& v = two.b.vertices;
  const double slant = std::ldexp(1.0, -random.between(0, 12));
  if (random.chance(3)) v[2] = v[0] + random.uniform(-1.0, 2.0) * (v[1] - v[0]) + slant * v[2];
  if (random.chance(4)) two.a.center = v[0] + small * two.a.center;
}

void make_point(Ball& ball, const Vector3& at, double radius) { ball = {at, radius}; }
void make_point(Capsule& capsule, const Vector3& at, double radius) { capsule = {at, at, radius}; }

TYPED_TEST(BatchOfDistances, finds_cores_within_their_errors) {
  golden::Random random(golden::Random::key("distances", "cores", "binary64", kSeed), 0);
  constexpr std::size_t kVectors = 64;  // pairs, of every vector length
  for (std::uint64_t round = 0; round < kQuestions; ++round) {
    Many<TypeParam> shapes(kVectors);
    for (TypeParam& two : shapes) {
      for_each_number(two.a, [&](double& x) { x = random.uniform(-1.0, 1.0); });
      for_each_number(two.b, [&](double& x) { x = random.uniform(-1.0, 1.0); });
      make_special(two, std::ldexp(1.0, -random.between(0, 30)), random);
    }
    auto pairs = pair_columns(static_cast<const TypeParam*>(nullptr));
    std::vector<std::vector<double>> columns(pairs.a.size() + pairs.b.size());
    for (const TypeParam& two : shapes) {
      std::size_t k = 0;
      const auto put = [&](double x) { columns[k++].push_back(x); };
      for_each_number(two.a, put);
      for_each_number(two.b, put);
    }
    pairs.size = kVectors;
    for (std::size_t k = 0; k < columns.size(); ++k)
      (k < pairs.a.size() ? pairs.a[k] : pairs.b[k - pairs.a.size()]) = columns[k].data();
    for_each_instruction_set([&] {
      static kernel::CoreColumns cores;
      if (!kernel::find_cores(pairs, cores)) return;
      std::size_t found = 0;
      for (std::size_t i = 0; i < kVectors; ++i) {
        if (!std::isfinite(cores.d_error[i])) continue;
        ++found;
        const auto [p, d] = nearest(shapes[i]);
        RealVector d_off;
        for (std::size_t k = 0; k < 3; ++k) {
          d_off[k] = d[k] - cores.d[2 * k][i] - cores.d[2 * k + 1][i];
          if constexpr (std::same_as<TypeParam, Capsules>) {
            const Real at = p[k] + shapes[i].a.start[static_cast<Eigen::Index>(k)];
            const Real own = 0x1p-100 * abs(at);  // of its magnitude: kCoreEta covers it
            EXPECT_LE(abs(at - cores.p[2 * k][i] - cores.p[2 * k + 1][i]), cores.p_error[i] + own);
          }
        }
        EXPECT_LE(length(d_off), cores.d_error[i]) << words(shapes[i], {});
      }
      EXPECT_GE(found, kVectors - 4);
    });
    if (testing::Test::HasFailure()) break;
  }
}

using KindsOfCapsules = testing::Types<BallAndCapsule, Capsules>;
template <class Kind>
class BatchOfCapsules : public testing::Test {};
TYPED_TEST_SUITE(BatchOfCapsules, KindsOfCapsules, PairNames);

TYPED_TEST(BatchOfCapsules, decides_where_the_square_of_an_axis_alone_overflows) {
  Many<TypeParam> shapes;
  for (const double length : {0x1p300, 0x1p510, 0x1.1p511, 0x1.4p511, 0x1p512, 0x1p1000, 0x1p1023}) {
    TypeParam two;
    make_point(two.a, {0, 1.5, 0}, 1);
    two.b = {{-length, 0, 0}, {length * 0.99, 0, 0}, 1};
    shapes.push_back(two);
    two.b.radius = 0.25;
    shapes.push_back(two);
  }
  expect_same_bits(shapes, {0, 0});
}

void put_in_plane(Ball& ball, Eigen::Index axis, double at) { ball.center[axis] = at; }
void put_in_plane(Capsule& capsule, Eigen::Index axis, double at) { capsule.start[axis] = capsule.end[axis] = at; }

TYPED_TEST(BatchOfCapsules, leaves_no_pair_for_lying_in_a_plane) {
  kernel::use_instruction_set("");
  if (!kernel::vectors_compute_contacts()) GTEST_SKIP() << "no fused multiply-add in vectors here";
  const golden::Family& generic = *golden::find_family(pair_of<TypeParam>(), "generic");
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    for (const double at : {0.0, 0.1}) {
      Many<TypeParam> shapes;
      for (const Query& query : questions_of(pair_of<TypeParam>(), generic, Scalar::binary64, 500)) {
        shapes.push_back(shapes_of<TypeParam>(query));
        put_in_plane(shapes.back().a, axis, at);
        put_in_plane(shapes.back().b, axis, at);
      }
      // Axes that cross in a plane meet, and have no direction of their own.
      const std::size_t most = std::is_same_v<TypeParam, Capsules> ? 50 : 0;
      EXPECT_LE(expect_same_bits(shapes, {0.5, 0.0625}), most);
    }
}

TYPED_TEST(Batch, does_not_depend_on_the_callers_floating_point_environment) {
  Many<TypeParam> shapes;
  for (const golden::Family& family : golden::families_of(pair_of<TypeParam>()))
    if (!family.outside_domain)
      for (const Query& query : questions_of(pair_of<TypeParam>(), family, Scalar::binary64, 20))
        shapes.push_back(shapes_of<TypeParam>(query));
  const Distances distances{0.25, 0.125};
  const auto ask = [&](auto& pairs) {
    pairs.test(distances.alarm);
    if constexpr (requires { pairs.compute(distances); }) pairs.compute(distances);
  };
  auto expected = in_columns(shapes);
  ask(expected);
  for (const auto& environment : floating_point_environments()) {
    SCOPED_TRACE(environment.name);
    auto actual = in_columns(shapes);
    int rounding = 0;
    in_environment(environment, [&] {
      ask(actual);
      rounding = std::fegetround();
    });
    EXPECT_EQ(rounding, environment.rounding);
    EXPECT_EQ(actual.hit(), expected.hit());
    if constexpr (requires { actual.compute(distances); }) {
      for (std::size_t i = 0; i < shapes.size(); ++i)
        EXPECT_EQ(row_of(actual, i), row_of(expected, i)) << words(shapes[i], distances);
    }
  }
}

TYPED_TEST(BatchOfContacts, counts_every_pair_that_it_left_to_the_function_of_one_pair) {
  using Pairs = decltype(in_columns(Many<TypeParam>()));
  using Call = std::size_t (*)(Pairs, Distances);
  const Call decided = [](Pairs pairs, Distances distances) { return pairs.test(distances.alarm).exact; };
  const Call computed = [](Pairs pairs, Distances distances) { return pairs.compute(distances).exact; };
  const Call of_hits = [](Pairs pairs, Distances distances) { return pairs.compute_hits(distances).exact; };
  std::vector<Query> queries;
  for (const auto& [name, make] : {std::pair<const char*, Make>{"anything", anything},
                                   {"at_the_top", at_the_top},
                                   {"underflowing", underflowing}}) {
    std::vector<Query> all = questions_of(name, make);
    all.resize(std::min<std::size_t>(all.size() / 3, 40));  // asked hundreds of times each
    for (const Query& query : of_kind<TypeParam>(std::move(all))) queries.push_back(query);
  }
  for_each_instruction_set([&] {
    for (const Call call : {decided, computed, of_hits}) {
      std::size_t left = 0;
      for (const Query& query : queries) {
        Many<TypeParam> shapes{shapes_of<TypeParam>(query)};
        const std::size_t of_one = call(in_columns(shapes), query.distances);
        ASSERT_LE(of_one, 1U) << words(shapes[0], query.distances);
        left += of_one;
        for (std::size_t n = 2; n <= 19; ++n) {
          shapes.push_back(shapes[0]);
          EXPECT_EQ(call(in_columns(shapes), query.distances), n * of_one)
              << n << " of " << words(shapes[0], query.distances);
        }
      }
      EXPECT_GT(left, 0U);
    }
  });
}

using Span = std::span<const double>;
constexpr std::array kBallColumns{"x", "y", "z", "radius"};
constexpr std::array kBoxColumns{"min x", "min y", "min z", "max x", "max y", "max z"};
constexpr std::array kCapsuleColumns{"start x", "start y", "start z", "end x", "end y", "end z", "radius"};
constexpr std::array kTriangleColumns{"vertices[0] x", "vertices[0] y", "vertices[0] z",
                                      "vertices[1] x", "vertices[1] y", "vertices[1] z",
                                      "vertices[2] x", "vertices[2] y", "vertices[2] z"};
constexpr std::array kPlaneColumns{"normal x", "normal y", "normal z", "offset"};
constexpr std::array kRayColumns{"origin x",    "origin y",    "origin z", "direction x",
                                 "direction y", "direction z", "length"};
constexpr std::array kLineColumns{"start x", "start y", "start z", "end x", "end y", "end z"};
constexpr const auto& names_of(const batch::TriangleColumns*) { return kTriangleColumns; }
constexpr const auto& names_of(const batch::PlaneColumns*) { return kPlaneColumns; }
constexpr const auto& names_of(const batch::RayColumns*) { return kRayColumns; }
constexpr const auto& names_of(const batch::LineColumns*) { return kLineColumns; }
constexpr const auto& names_of(const batch::CapsuleColumns*) { return kCapsuleColumns; }
constexpr const auto& names_of(const batch::BallColumns*) { return kBallColumns; }
constexpr const auto& names_of(const batch::BoxColumns*) { return kBoxColumns; }

/// Columns of two places each, but for one of one place.
template <class Columns>
Columns short_at(std::size_t short_column) {
  static const std::vector<double> two(2);
  std::array<Span, sizeof(Columns) / sizeof(Span)> all;
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = Span(two).first(k == short_column ? 1 : 2);
  return std::bit_cast<Columns>(all);
}
constexpr std::size_t kNone = 77;

void expect_refused(const std::string& column, const std::function<void()>& call) {
  try {
    call();
    ADD_FAILURE() << "accepted: " << column;
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("column " + column + " holds 1 "), std::string::npos) << error.what();
  }
}

template <class A, class B>
void expect_names_of_short_columns(const Two<A, B>& /*kind*/) {
  using First = batch::ColumnsOf<A>;
  using Second = batch::ColumnsOf<B>;
  std::vector<std::uint8_t> hit(2);
  const auto& first = names_of(static_cast<const First*>(nullptr));
  const auto& second = names_of(static_cast<const Second*>(nullptr));
  for (std::size_t k = 1; k < first.size(); ++k)  // a's first tells the length
    expect_refused(std::string("a.") + first[k],
                   [&] { batch::test(short_at<First>(k), short_at<Second>(kNone), 0, hit); });
  for (std::size_t k = 0; k < second.size(); ++k)
    expect_refused(std::string("b.") + second[k],
                   [&] { batch::test(short_at<First>(kNone), short_at<Second>(k), 0, hit); });
  expect_refused("hit",
                 [&] { batch::test(short_at<First>(kNone), short_at<Second>(kNone), 0, std::span(hit).first(1)); });
}

TYPED_TEST(Batch, names_the_column_that_is_too_short) { expect_names_of_short_columns(TypeParam{}); }

template <class A, class B>
void expect_names_of_short_outputs(const Two<A, B>& /*kind*/) {
  const auto a = short_at<batch::ColumnsOf<A>>(kNone);
  const auto b = short_at<batch::ColumnsOf<B>>(kNone);
  std::vector<double> numbers(2);
  std::vector<batch::PairState> states(2);
  std::vector<std::uint32_t> index(2);
  const std::span<double> two(numbers);
  const batch::ContactColumns whole{{two, two, two}, {two, two, two}, {two, two, two}, two, states};
  const auto refuses = [&](const std::string& column, const batch::ContactColumns& out) {
    expect_refused(column, [&] { batch::compute(a, b, {0, 0}, out); });
    expect_refused(column, [&] { batch::compute_hits(a, b, {0, 0}, index, out); });
  };
  const std::array kOutputs{"normal", "point1", "point2"};
  for (std::size_t column = 0; column < 9; ++column) {
    batch::ContactColumns out = whole;
    auto& vector = column < 3 ? out.normal : column < 6 ? out.point1 : out.point2;
    vector[column % 3] = two.first(1);
    refuses(std::string(kOutputs[column / 3]) + " " + std::string(1, "xyz"[column % 3]), out);
  }
  batch::ContactColumns out = whole;
  out.value = two.first(1);
  refuses("value", out);
  out = whole;
  out.state = out.state.first(1);
  refuses("state", out);
  expect_refused("index", [&] { batch::compute_hits(a, b, {0, 0}, std::span(index).first(1), whole); });
}

TYPED_TEST(BatchOfContacts, names_the_output_that_is_too_short) { expect_names_of_short_outputs(TypeParam{}); }

}  // namespace
}  // namespace contact
