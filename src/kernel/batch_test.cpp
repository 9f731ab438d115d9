// The batch API: every instruction set that is at hand gives the bits of the functions of one pair and of the oracle,
// on questions of every family and on those that only vectors can get wrong.
//
// CONTACT_BATCH_QUESTIONS sets how many questions a family makes, CONTACT_BATCH_SEED which ones.
#include "contact/batch.hpp"

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

#include "contact/cube_cube.hpp"
#include "contact/sphere_sphere.hpp"
#include "environment/floating_point_environments.hpp"
#include "golden/families.hpp"
#include "kernel/batch.hpp"
#include "kernel/sphere_sphere_numbers.hpp"
#include "oracle/truth/staged_oracle.hpp"

namespace contact {
namespace {

std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
  const char* given = std::getenv(name);
  return given ? std::strtoull(given, nullptr, 10) : otherwise;
}

const std::uint64_t kQuestions = from_environment("CONTACT_BATCH_QUESTIONS", 150);
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

struct Spheres {
  std::array<std::vector<double>, 4> a;
  std::array<std::vector<double>, 4> b;

  void push_back(const Balls& balls) {
    for (std::size_t k = 0; k < 3; ++k) {
      a[k].push_back(balls.a.center[static_cast<Eigen::Index>(k)]);
      b[k].push_back(balls.b.center[static_cast<Eigen::Index>(k)]);
    }
    a[3].push_back(balls.a.radius);
    b[3].push_back(balls.b.radius);
  }
  [[nodiscard]] std::size_t size() const { return a[0].size(); }
  [[nodiscard]] batch::BallColumns first() const { return {a[0], a[1], a[2], a[3]}; }
  [[nodiscard]] batch::BallColumns second() const { return {b[0], b[1], b[2], b[3]}; }
  [[nodiscard]] Balls operator[](std::size_t i) const {
    return {{{a[0][i], a[1][i], a[2][i]}, a[3][i]}, {{b[0][i], b[1][i], b[2][i]}, b[3][i]}};
  }
};

/// A row of an answer as bits: ten numbers and the state.
using Row = std::array<std::uint64_t, 11>;

struct Contacts {
  explicit Contacts(std::size_t size) : state(size, batch::PairState{77}) {
    for (auto& column : number) column.assign(size, std::numeric_limits<double>::quiet_NaN());
  }
  [[nodiscard]] batch::ContactColumns columns() {
    auto& n = number;
    return {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]}, n[9], state};
  }
  [[nodiscard]] Row row(std::size_t i) const {
    Row bits{};
    for (std::size_t k = 0; k < number.size(); ++k) bits[k] = std::bit_cast<std::uint64_t>(number[k][i]);
    bits[10] = static_cast<std::uint64_t>(state[i]);
    return bits;
  }

  std::array<std::vector<double>, 10> number;
  std::vector<batch::PairState> state;
};

Row row_of(const Contact& contact) {
  Row bits{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    bits[k] = std::bit_cast<std::uint64_t>(contact.normal[axis]);
    bits[3 + k] = std::bit_cast<std::uint64_t>(contact.point1[axis]);
    bits[6 + k] = std::bit_cast<std::uint64_t>(contact.point2[axis]);
  }
  bits[9] = std::bit_cast<std::uint64_t>(contact.value);
  bits[10] = contact.degenerate ? 2 : 1;
  return bits;
}

std::string words(const Balls& balls, Distances distances) {
  std::string text;
  const auto add = [&](double x) {
    char buffer[40];
    std::snprintf(buffer, sizeof buffer, "%a ", x);
    text += buffer;
  };
  for (const Ball& ball : {balls.a, balls.b}) {
    for (int k = 0; k < 3; ++k) add(ball.center[k]);
    add(ball.radius);
  }
  add(distances.alarm);
  add(distances.contact);
  return text;
}

/// What the function of one pair says; its numbers are those of the stages that share no formula with the vectors.
Row expected_row(const Balls& balls, Distances distances, ContactPoints points) {
  const auto contact = compute_sphere_sphere(balls.a, balls.b, distances, points);
  if (!contact) return {};
  Contact otherwise = *contact;
  kernel::round_numbers(balls.a, balls.b, distances.contact, points, kernel::kAllNumbers, otherwise);
  EXPECT_EQ(row_of(*contact), row_of(otherwise)) << words(balls, distances);
  return row_of(*contact);
}

/// What the oracle says, where it knows the convention.
void expect_oracle_agrees(const Row& row, const Balls& balls, Distances distances, ContactPoints points) {
  if (points.first != PointOn::nearest_surface || points.second != PointOn::nearest_surface) return;
  const Expectation expected =
      oracle::staged_answer({Pair::sphere_sphere, balls, distances}, Scalar::binary64).expected;
  EXPECT_EQ(row, expected.hit ? row_of(*expected.contact) : Row{}) << words(balls, distances);
}

/// Every instruction set answers all pairs as the functions of one pair do; returns the pairs that the best one left to
/// them.
std::size_t expect_same_bits(const Spheres& spheres, Distances distances, ContactPoints points = {}) {
  const std::size_t size = spheres.size();
  std::vector<Row> expected;
  std::vector<std::uint32_t> hits;
  for (std::size_t i = 0; i < size; ++i) {
    expected.push_back(expected_row(spheres[i], distances, points));
    expect_oracle_agrees(expected.back(), spheres[i], distances, points);
    if (expected[i][10] != 0) hits.push_back(static_cast<std::uint32_t>(i));
    EXPECT_EQ(test_sphere_sphere(spheres[i].a, spheres[i].b, distances.alarm), expected[i][10] != 0);
  }
  std::size_t exact = 0;
  bool best = true;
  for_each_instruction_set([&] {
    std::vector<std::uint8_t> decisions(size, 77);
    EXPECT_EQ(batch::test_sphere_sphere(spheres.first(), spheres.second(), distances.alarm, decisions).hits,
              hits.size());
    Contacts dense(size);
    const batch::Count count =
        batch::compute_sphere_sphere(spheres.first(), spheres.second(), distances, dense.columns(), points);
    EXPECT_EQ(count.hits, hits.size());
    if (best) exact = count.exact;
    best = false;
    for (std::size_t i = 0; i < size; ++i) {
      EXPECT_EQ(decisions[i], expected[i][10] != 0 ? 1 : 0) << words(spheres[i], distances);
      EXPECT_EQ(dense.row(i), expected[i]) << i << ": " << words(spheres[i], distances);
    }
    Contacts compact(size);
    std::vector<std::uint32_t> index(size, 77);
    ASSERT_EQ(batch::compute_sphere_sphere_hits(spheres.first(), spheres.second(), distances, index, compact.columns(),
                                                points)
                  .hits,
              hits.size());
    for (std::size_t k = 0; k < hits.size(); ++k) {
      EXPECT_EQ(index[k], hits[k]);
      EXPECT_EQ(compact.row(k), expected[hits[k]]) << words(spheres[hits[k]], distances);
    }
  });
  return exact;
}

/// Questions one after the other, each with its own distances for itself and those that follow it: a number of pairs
/// that fills no vector.
template <class Ask>
void each_with_its_followers(const std::vector<Query>& queries, const Ask& ask) {
  constexpr std::size_t kFollowers = 10;
  for (std::size_t k = 0; k < queries.size() && !testing::Test::HasFailure(); ++k) {
    Spheres spheres;
    for (std::size_t j = 0; j <= kFollowers; ++j) spheres.push_back(*queries[(k + j) % queries.size()].balls());
    ask(spheres, queries[k].distances);
  }
}

std::vector<Query> questions_of(Pair pair, const golden::Family& family, Scalar scalar) {
  std::vector<Query> queries;
  for (std::uint64_t i = 0; i < kQuestions; ++i)
    queries.push_back(golden::generate_query(pair, family, scalar, kSeed, i));
  return queries;
}

TEST(BatchSphereSphere, gives_the_bits_of_one_pair_on_every_family) {
  for (const golden::Family& family : golden::families_of(Pair::sphere_sphere)) {
    if (family.outside_domain) continue;
    for (const Scalar scalar : kScalars) {
      SCOPED_TRACE(std::string(family.name) + " " + std::string(name(scalar)));
      each_with_its_followers(
          questions_of(Pair::sphere_sphere, family, scalar),
          [](const Spheres& spheres, Distances distances) { expect_same_bits(spheres, distances); });
    }
  }
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

/// Of all families, so that one vector holds pairs that take different ways.
Query of_any_family(golden::Random& random) {
  return kFamiliesForVectors[random.below(std::size(kFamiliesForVectors))].second(random);
}

TEST(BatchSphereSphere, gives_the_bits_of_one_pair_where_vectors_are_on_their_own) {
  for (const auto& [name, make] : kFamiliesForVectors) {
    SCOPED_TRACE(name);
    each_with_its_followers(questions_of(name, make),
                            [](const Spheres& spheres, Distances distances) { expect_same_bits(spheres, distances); });
  }
}

TEST(BatchSphereSphere, sees_what_breaks_a_tie_however_far_below_it) {
  // The distance is 1 + 2^-52 and 2^-53, half way between two doubles; the radius takes next to nothing from it.
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {1.0, -1.0}) {
      Spheres spheres;
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

TEST(BatchSphereSphere, gives_the_bits_of_one_pair_where_those_of_a_vector_differ) {
  each_with_its_followers(questions_of("of_any_family", of_any_family),
                          [](const Spheres& spheres, Distances distances) { expect_same_bits(spheres, distances); });
}

TEST(BatchSphereSphere, puts_points_where_the_convention_says) {
  for (const PointOn first : {PointOn::nearest_surface, PointOn::center, PointOn::far_surface})
    for (const PointOn second : {PointOn::nearest_surface, PointOn::center, PointOn::far_surface})
      for (const char* family :
           {"generic", "coincident", "one_axis", "zero_radius", "near_coincident", "hard_to_round", "extreme_scale"}) {
        std::vector<Query> queries =
            questions_of(Pair::sphere_sphere, *golden::find_family(Pair::sphere_sphere, family), Scalar::binary64);
        queries.resize(std::min<std::size_t>(queries.size(), 30));
        each_with_its_followers(queries, [&](const Spheres& spheres, Distances distances) {
          expect_same_bits(spheres, distances, {first, second});
        });
      }
}

TEST(BatchSphereSphere, is_right_for_every_number_of_pairs) {
  const golden::Family& generic = *golden::find_family(Pair::sphere_sphere, "generic");
  Spheres spheres;
  Distances distances{};
  for (std::uint64_t i = 0; i < 40; ++i) {
    expect_same_bits(spheres, distances);
    const Query query = golden::generate_query(Pair::sphere_sphere, generic, Scalar::binary64, kSeed, i);
    spheres.push_back(*query.balls());
    distances = query.distances;
  }
  for (std::uint64_t i = 0; i < 1500; ++i)
    spheres.push_back(*golden::generate_query(Pair::sphere_sphere, generic, Scalar::binary64, kSeed, i).balls());
  expect_same_bits(spheres, distances);
}

TEST(BatchSphereSphere, leaves_few_pairs_to_exact_arithmetic) {
  kernel::use_instruction_set("");
  if (!kernel::vectors_compute_contacts()) GTEST_SKIP() << "no fused multiply-add in vectors here";
  const auto share = [](const char* family, Distances distances, bool hits_alone = false) {
    Spheres spheres;
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

TEST(BatchSphereSphere, does_not_depend_on_the_callers_floating_point_environment) {
  std::vector<Query> queries;
  for (const golden::Family& family : golden::families_of(Pair::sphere_sphere))
    if (!family.outside_domain)
      for (std::uint64_t i = 0; i < 20; ++i)
        queries.push_back(golden::generate_query(Pair::sphere_sphere, family, Scalar::binary64, kSeed, i));
  Spheres spheres;
  for (const Query& query : queries) spheres.push_back(*query.balls());
  const Distances distances{0.25, 0.125};
  const std::size_t size = spheres.size();
  Contacts expected(size);
  batch::compute_sphere_sphere(spheres.first(), spheres.second(), distances, expected.columns());
  std::vector<std::uint8_t> expected_hits(size);
  batch::test_sphere_sphere(spheres.first(), spheres.second(), distances.alarm, expected_hits);
  for (const auto& environment : floating_point_environments()) {
    SCOPED_TRACE(environment.name);
    Contacts actual(size);
    std::vector<std::uint8_t> hits(size);
    int rounding = 0;
    in_environment(environment, [&] {
      batch::compute_sphere_sphere(spheres.first(), spheres.second(), distances, actual.columns());
      batch::test_sphere_sphere(spheres.first(), spheres.second(), distances.alarm, hits);
      rounding = std::fegetround();
    });
    EXPECT_EQ(rounding, environment.rounding);
    EXPECT_EQ(hits, expected_hits);
    for (std::size_t i = 0; i < size; ++i) EXPECT_EQ(actual.row(i), expected.row(i)) << words(spheres[i], distances);
  }
}

struct CubePairs {
  std::array<std::vector<double>, 6> a;
  std::array<std::vector<double>, 6> b;

  void push_back(const Boxes& boxes) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      a[k].push_back(boxes.a.min[axis]);
      a[3 + k].push_back(boxes.a.max[axis]);
      b[k].push_back(boxes.b.min[axis]);
      b[3 + k].push_back(boxes.b.max[axis]);
    }
  }
  [[nodiscard]] batch::BoxColumns first() const { return {{a[0], a[1], a[2]}, {a[3], a[4], a[5]}}; }
  [[nodiscard]] batch::BoxColumns second() const { return {{b[0], b[1], b[2]}, {b[3], b[4], b[5]}}; }
};

TEST(BatchCubeCube, decides_as_one_pair_on_every_family) {
  constexpr std::size_t kFollowers = 10;
  for (const golden::Family& family : golden::families_of(Pair::cube_cube)) {
    if (family.outside_domain) continue;
    for (const Scalar scalar : kScalars) {
      SCOPED_TRACE(std::string(family.name) + " " + std::string(name(scalar)));
      const std::vector<Query> queries = questions_of(Pair::cube_cube, family, scalar);
      std::size_t hits = 0;
      for (std::size_t k = 0; k < queries.size() && !HasFailure(); ++k) {
        const double alarm = queries[k].distances.alarm;
        CubePairs cubes;
        std::vector<std::uint8_t> expected;
        for (std::size_t j = 0; j <= kFollowers; ++j) {
          const Boxes& boxes = *queries[(k + j) % queries.size()].boxes();
          cubes.push_back(boxes);
          expected.push_back(test_cube_cube(boxes.a, boxes.b, alarm) ? 1 : 0);
          hits += expected.back();
        }
        for_each_instruction_set([&] {
          std::vector<std::uint8_t> actual(expected.size(), 77);
          const batch::Count count = batch::test_cube_cube(cubes.first(), cubes.second(), alarm, actual);
          EXPECT_EQ(actual, expected) << "question " << k;
          EXPECT_EQ(count.hits, static_cast<std::size_t>(std::count(expected.begin(), expected.end(), 1)));
        });
      }
      EXPECT_GT(hits, 0U);
    }
  }
}

TEST(BatchSphereSphere, counts_every_pair_that_it_left_to_the_function_of_one_pair) {
  using Call = std::size_t (*)(const Spheres&, Distances);
  const Call decided = [](const Spheres& spheres, Distances distances) {
    std::vector<std::uint8_t> hits(spheres.size());
    return batch::test_sphere_sphere(spheres.first(), spheres.second(), distances.alarm, hits).exact;
  };
  const Call computed = [](const Spheres& spheres, Distances distances) {
    Contacts contacts(spheres.size());
    return batch::compute_sphere_sphere(spheres.first(), spheres.second(), distances, contacts.columns()).exact;
  };
  const Call of_hits = [](const Spheres& spheres, Distances distances) {
    Contacts contacts(spheres.size());
    std::vector<std::uint32_t> index(spheres.size());
    return batch::compute_sphere_sphere_hits(spheres.first(), spheres.second(), distances, index, contacts.columns())
        .exact;
  };
  for_each_instruction_set([&] {
    for (const Call call : {decided, computed, of_hits}) {
      std::size_t left = 0;
      std::vector<Query> queries = questions_of("anything", anything);
      for (const auto& [name, make] :
           {std::pair<const char*, Make>{"at_the_top", at_the_top}, {"underflowing", underflowing}})
        for (const Query& query : questions_of(name, make)) queries.push_back(query);
      for (const Query& query : queries) {
        Spheres spheres;
        spheres.push_back(*query.balls());
        const std::size_t of_one = call(spheres, query.distances);
        ASSERT_LE(of_one, 1U);
        left += of_one;
        for (std::size_t n = 2; n <= 19; ++n) {
          spheres.push_back(*query.balls());
          EXPECT_EQ(call(spheres, query.distances), n * of_one)
              << n << " of " << words(*query.balls(), query.distances);
        }
      }
      EXPECT_GT(left, 0U);
    }
  });
}

TEST(Batch, names_the_column_that_is_too_short) {
  const std::vector<double> two(2);
  const std::vector<double> one(1);
  const auto refuses = [](const std::string& column, const std::function<void()>& call) {
    try {
      call();
      ADD_FAILURE() << "accepted: " << column;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find("column " + column + " holds 1 "), std::string::npos) << error.what();
    }
  };
  std::vector<std::uint8_t> hit(2);
  const std::array kBallColumns{"x", "y", "z", "radius"};
  const std::array kBoxColumns{"min x", "min y", "min z", "max x", "max y", "max z"};
  for (std::size_t side = 0; side < 2; ++side) {
    const std::string name = side == 0 ? "a." : "b.";
    for (std::size_t column = side == 0 ? 1 : 0; column < kBallColumns.size(); ++column) {  // a.x tells the length
      std::array<std::array<std::span<const double>, 4>, 2> c{{{two, two, two, two}, {two, two, two, two}}};
      c[side][column] = one;
      refuses(name + kBallColumns[column], [&] {
        batch::test_sphere_sphere({c[0][0], c[0][1], c[0][2], c[0][3]}, {c[1][0], c[1][1], c[1][2], c[1][3]}, 0, hit);
      });
    }
    for (std::size_t column = side == 0 ? 1 : 0; column < kBoxColumns.size(); ++column) {
      std::array<batch::BoxColumns, 2> c;
      c.fill({{two, two, two}, {two, two, two}});
      (column < 3 ? c[side].min[column] : c[side].max[column - 3]) = one;
      refuses(name + kBoxColumns[column], [&] { batch::test_cube_cube(c[0], c[1], 0, hit); });
    }
  }
  const batch::BallColumns balls{two, two, two, two};
  refuses("hit", [&] { batch::test_sphere_sphere(balls, balls, 0, std::span(hit).first(1)); });
  refuses("hit", [&] {
    batch::test_cube_cube({{two, two, two}, {two, two, two}}, {{two, two, two}, {two, two, two}}, 0,
                          std::span(hit).first(1));
  });
  Contacts contacts(2);
  std::vector<std::uint32_t> index(2);
  const auto compute = [&](const batch::ContactColumns& out) {
    batch::compute_sphere_sphere(balls, balls, {0, 0}, out);
  };
  const std::array kOutputs{"normal", "point1", "point2"};
  for (std::size_t column = 0; column < 9; ++column) {
    batch::ContactColumns out = contacts.columns();
    auto& vector = column < 3 ? out.normal : column < 6 ? out.point1 : out.point2;
    vector[column % 3] = vector[column % 3].first(1);
    refuses(std::string(kOutputs[column / 3]) + " " + std::string(1, "xyz"[column % 3]), [&] { compute(out); });
  }
  batch::ContactColumns out = contacts.columns();
  out.value = out.value.first(1);
  refuses("value", [&] { compute(out); });
  out = contacts.columns();
  out.state = out.state.first(1);
  refuses("state", [&] { compute(out); });
  refuses("index", [&] {
    batch::compute_sphere_sphere_hits(balls, balls, {0, 0}, std::span(index).first(1), contacts.columns());
  });
}

}  // namespace
}  // namespace contact
