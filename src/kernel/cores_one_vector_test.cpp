// The contact of two cores with x, y and z in one vector, and by single numbers: each says what integers do, and the first settles
// nearly all ordinary questions. (What a caller asks goes to one after the other, so that each would hide the next.)
#include "kernel/cores_one_vector.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>

#include "contact/capsule_plane.hpp"
#include "contact/ray_triangle.hpp"
#include "contact/sphere_cube.hpp"
#include "contact/sphere_plane.hpp"
#include "contact/triangle_line.hpp"
#include "kernel/contacts_for_tests.hpp"
#include "kernel/cores_stages.hpp"

namespace contact::cores_one_vector_test {
namespace {

using kernel::Filtered;

/// Real numbers, small integers, numbers of several powers, and few bits; near each other's features now and then.
struct Drawn {
  Vector3 point;
  kernel::Segment first;
  kernel::Segment second;
  std::array<Vector3, 3> vertices;
  kernel::DirectedSegment ray;
  kernel::HalfSpace plane;
  kernel::Lengths lengths;
  ContactPoints points;
};

class Draw {
 public:
  Drawn operator()(bool ordinary) {
    kind_ = ordinary ? 0 : below(5);
    Drawn q{vector(),
            {vector(), vector()},
            {vector(), vector()},
            {vector(), vector(), vector()},
            {vector(), vector(), std::abs(number())},
            {vector(), number()},
            {2 * std::abs(number()), std::abs(number()), 0, 0},
            {}};
    if (!ordinary) {
      if (below(2) == 0) q.lengths.alarm = std::abs(number());
      if (below(2) == 0) q.lengths.contact = std::abs(number());
      constexpr std::array kWhere{PointOn::nearest_surface, PointOn::center, PointOn::far_surface};
      q.points.first = kWhere[below(3)];
      q.points.second = kWhere[below(3)];
      bend(q, std::ldexp(unit(), -static_cast<int>(below(60))));
      if (below(3) == 0) scale(q, std::ldexp(1, static_cast<int>(below(600)) - 300));
    }
    if (q.ray.direction.isZero(0)) q.ray.direction = Vector3(1, 0, 0);
    if (q.plane.normal.isZero(0)) q.plane.normal = Vector3(1, 2, 0);
    return q;
  }

 private:
  std::uint64_t below(std::uint64_t end) { return random_() % end; }
  double unit() { return static_cast<double>(random_() >> 11) * 0x1p-52 - 1; }
  double number() {
    if (kind_ == 1) return static_cast<double>(below(7)) - 3;
    if (kind_ == 2) return std::ldexp(unit(), static_cast<int>(below(41)) - 20);
    if (kind_ == 3) return std::round(unit() * 64) / 16;
    if (kind_ == 4 && below(4) == 0) return 0;
    return unit() * 4;
  }
  Vector3 vector() {
    const double x = number();
    const double y = number();
    return {x, y, number()};
  }
  /// Something is parallel, near or flat, but for e.
  void bend(Drawn& q, double e) {
    const auto& v = q.vertices;
    switch (below(8)) {
      case 0:
        q.second.end = q.second.start + (q.first.end - q.first.start) * (1 + e) + Vector3(e, 0, -e);
        break;
      case 1:
        q.point = (q.first.start + q.first.end) / 2 + Vector3(e, 2 * e, e);
        break;
      case 2:
        q.vertices[2] = v[0] + (v[1] - v[0]) * 0.75 + Vector3(0, e, e);
        break;
      case 3:
        q.point = v[0] * 0.5 + v[1] * 0.25 + v[2] * 0.25 + Vector3(e, e, 0);
        break;
      case 4:
        q.second.start = q.first.start + Vector3(e, 1, e);
        break;
      case 5:
        q.plane.offset = q.plane.normal.dot(q.point) + e;
        break;
      case 6:
        q.ray.start = v[0] * 0.5 + v[1] * 0.25 + v[2] * 0.25 - q.ray.direction * (q.ray.length / 2);
        q.first.start = q.ray.start;
        q.first.end = q.ray.start + q.ray.direction;
        break;
      default:
        q.plane.normal[static_cast<int>(below(3))] = 0;
    }
  }

  /// To both ends of what plain arithmetic decides, and beyond.
  static void scale(Drawn& q, double unit) {
    for (Vector3* v : {&q.point, &q.first.start, &q.first.end, &q.second.start, &q.second.end, &q.vertices[0],
                       &q.vertices[1], &q.vertices[2], &q.ray.start, &q.ray.direction, &q.plane.normal})
      *v *= unit;
    for (double* x : {&q.lengths.radius1, &q.lengths.radius2, &q.lengths.alarm, &q.lengths.contact}) *x *= unit;
    q.plane.offset *= unit * unit;
  }

  std::mt19937_64 random_{20261127};
  std::uint64_t kind_ = 0;
};

struct Count {
  int hits = 0;
  int settled = 0;  ///< in one vector
};

template <class First, class Second>
void expect_all_stages_say_the_same(const First& first, const Second& second, const kernel::Lengths& lengths,
                                    ContactPoints points, Count& count) {
  const auto grid = grid_of(first, second, lengths);
  const auto nearest = exact_nearest(first, second, grid);
  const bool hit = is_hit(nearest, grid, lengths);
  std::optional<Contact> expected;
  if (hit) round_exactly(nearest, grid, lengths, points, kernel::kAllNumbers, expected.emplace());
  count.hits += hit ? 1 : 0;
  const auto compare = [&](bool said, const Contact& contact) {
    expect_same(said ? std::optional(contact) : std::nullopt, expected);
  };
  Contact contact{};
  compare(kernel::contact_portably(first, second, lengths, points, contact), contact);
#if defined(__x86_64__) && !defined(__FMA__)
  if (__builtin_cpu_supports("fma")) compare(kernel::contact_by_fma(first, second, lengths, points, contact), contact);
#endif
#if CONTACT_HAS_ONE_VECTOR
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return;
  const Filtered said = kernel::contact_by_one_vector(first, second, lengths, points, contact);
  if (said == Filtered::undecided) return;
  compare(said == Filtered::hit, contact);
  count.settled += hit ? 1 : 0;
#endif
}

/// What an inline call asks where plain arithmetic says that there is a hit, against integers.
template <class First, class Second, class Ask>
void expect_the_same_of_a_hit(Filtered filtered, const First& first, const Second& second,
                              const kernel::Lengths& lengths, ContactPoints points, const Ask& ask) {
  if (filtered != Filtered::hit) return;
  const auto grid = grid_of(first, second, lengths);
  Contact expected{};
  round_exactly(exact_nearest(first, second, grid), grid, lengths, points, kernel::kAllNumbers, expected);
  expect_same(ask(), std::optional(expected));
}
/// The same of a ball and boxes. Outside a box its nearest point is made of numbers of the question, and so a core by itself. Inside the
/// library out of line is asked, which other tests hold against the oracle.
void expect_the_same_of_a_ball_and_boxes(const Drawn& q, Count& count) {
  const Distances distances{q.lengths.alarm, q.lengths.contact};
  const Ball ball{q.point, q.lengths.radius1};
  for (const Vector3& center : {q.first.start, q.first.end, q.vertices[0], q.point}) {
    for (const Vector3& corner : {q.second.start, q.second.end, q.vertices[1]}) {
      const Box box{center.cwiseMin(corner), center.cwiseMax(corner)};
      const Filtered filtered = plain_decision::filter_ball_and_box(ball, box, distances.alarm);
      const auto ask = [&] { return of_hit::compute_sphere_cube(ball, box, distances, q.points); };
      const Vector3 nearest = q.point.cwiseMax(box.min).cwiseMin(box.max);
      if (nearest != q.point)
        expect_the_same_of_a_hit(filtered, q.point, kernel::Segment{nearest, nearest},
                                 {q.lengths.radius1, 0, q.lengths.alarm, q.lengths.contact}, q.points, ask);
      else if (filtered == Filtered::hit)
        expect_same(ask(), out_of_line::compute_sphere_cube(ball, box, distances, q.points));
      // In a corner three faces are as near: that is left to others.
      if (filtered != Filtered::hit || center == q.point) continue;
      ++count.hits;
      const auto left = [] { return std::optional<Contact>(); };
      count.settled += kernel::contact_of_hit(ball, box, distances.contact, q.points, left) ? 1 : 0;
    }
  }
}

void expect_the_same_of_hits(const Drawn& q, const kernel::Lengths& of_one, Count& of_ball_and_box) {
  using plain_decision::filter_pair;
  expect_the_same_of_a_ball_and_boxes(q, of_ball_and_box);
  const Distances distances{of_one.alarm, of_one.contact};
  const Plane plane{q.plane.normal, q.plane.offset};
  const Triangle triangle{q.vertices};
  const Ball ball{q.point, of_one.radius1};
  const Capsule capsule{q.first.start, q.first.end, of_one.radius1};
  const Ray ray{q.ray.start, q.ray.direction, q.ray.length};
  const Line line{q.first.start, q.first.end};
  expect_the_same_of_a_hit(filter_pair(ball, plane, of_one.alarm), q.point, q.plane, of_one, q.points,
                           [&] { return of_hit::compute_sphere_plane(ball, plane, distances, q.points); });
  expect_the_same_of_a_hit(filter_pair(capsule, plane, of_one.alarm), q.first, q.plane, of_one, q.points,
                           [&] { return of_hit::compute_capsule_plane(capsule, plane, distances, q.points); });
  const kernel::Corners corners{q.vertices};
  const kernel::Lengths none{0, 0, 0, 0};
  expect_the_same_of_a_hit(filter_pair(ray, triangle), q.ray, corners, none, {},
                           [&] { return of_hit::compute_ray_triangle(ray, triangle); });
  expect_the_same_of_a_hit(filter_pair(triangle, line), corners, q.first, none, {},
                           [&] { return of_hit::compute_triangle_line(triangle, line); });
}

std::array<Count, 9> asked(int questions, bool ordinary) {
  Draw draw;
  std::array<Count, 9> counts{};
  for (int i = 0; i < questions && !testing::Test::HasFailure(); ++i) {
    const Drawn q = draw(ordinary);
    const kernel::Corners triangle{q.vertices};
    const kernel::Lengths of_one{q.lengths.radius1, 0, q.lengths.alarm, q.lengths.contact};
    const kernel::Lengths of_second{0, q.lengths.radius1, q.lengths.alarm, q.lengths.contact};
    const kernel::Lengths none{0, 0, 0, 0};
    expect_all_stages_say_the_same(q.point, q.first, q.lengths, q.points, counts[0]);
    expect_all_stages_say_the_same(q.first, q.second, q.lengths, q.points, counts[1]);
    expect_all_stages_say_the_same(q.point, triangle, of_one, q.points, counts[2]);
    expect_all_stages_say_the_same(q.ray, q.point, of_second, q.points, counts[3]);
    expect_all_stages_say_the_same(q.point, q.plane, of_one, q.points, counts[4]);
    expect_all_stages_say_the_same(q.first, q.plane, of_one, q.points, counts[5]);
    expect_all_stages_say_the_same(q.ray, triangle, none, {}, counts[6]);
    expect_all_stages_say_the_same(triangle, q.first, none, {}, counts[7]);
    expect_the_same_of_hits(q, of_one, counts[8]);
  }
  return counts;
}

TEST(CoresInOneVector, all_stages_say_what_integers_do) {
  for (const Count& count : asked(3000, false)) EXPECT_GT(count.hits, 150);
}

TEST(CoresInOneVector, ordinary_questions_are_settled) {
  for (const Count& count : asked(2000, true)) {
    EXPECT_GT(count.hits, 50);
#if CONTACT_HAS_ONE_VECTOR
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
      EXPECT_GT(count.settled, count.hits * 95 / 100);
    }
#endif
  }
}

#if CONTACT_HAS_ONE_VECTOR
/// The share of hits of a scene that one vector settles.
template <class Make>
void expect_settled(const char* scene, const Make& ask) {
  std::mt19937_64 random(20261128);
  const auto any = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); };
  int settled = 0;
  int hits = 0;
  for (int i = 0; i < 1000; ++i) {
    const kernel::Filtered said = ask(any);
    hits += said == kernel::Filtered::miss ? 0 : 1;
    settled += said == kernel::Filtered::hit ? 1 : 0;
  }
  EXPECT_GT(hits, 200) << scene;
  EXPECT_GT(settled, hits * 9 / 10) << scene << ": " << hits;
}

TEST(CoresInOneVector, settle_scenes_along_axes) {
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) GTEST_SKIP() << "no such vectors here";
  Contact contact;
  const kernel::Lengths lengths{1, 0, 0, 0.125};
  const auto over = [&](const auto& core, const Plane& plane) {
    return contact_by_one_vector(core, kernel::HalfSpace{plane.normal, plane.offset}, lengths, {}, contact);
  };
  const auto ball = [&](const Vector3& c, const std::array<Vector3, 3>& triangle) {
    return contact_by_one_vector(c, kernel::Corners{triangle}, lengths, {}, contact);
  };
  expect_settled("a ball on a floor", [&](const auto& any) {
    const double x = any(-1, 1);
    return over(Vector3(x, any(-1, 1), any(-1, 2)), Plane{{0, 0, 2}, 0.5});
  });
  expect_settled("a capsule that lies on a floor", [&](const auto& any) {
    const double z = any(-1, 2);
    const double x = any(-1, 1);
    return over(kernel::Segment{{x, 0, z}, {any(-1, 1), 2, z}}, Plane{{0, 0, 1}, 0});
  });
  expect_settled("a ball on a ramp", [&](const auto& any) {
    const double x = any(0.5, 1.5);
    const double y = any(0.5, 1);
    return ball({x, y, any(-1, 1.5)}, {Vector3(0, 0, 0), Vector3(4, 0, 0), Vector3(0, 3, 1.75)});
  });
  expect_settled("a ball beyond an edge of a level triangle", [&](const auto& any) {
    const double x = any(1.5, 2);
    const double y = any(0.5, 1.5);
    return ball({x, y, any(-1, 1)}, {Vector3(-3, -3, 0), Vector3(3, -3, 0), Vector3(-1, 4, 0)});
  });
  expect_settled("capsules that lie on each other", [&](const auto& any) {
    const double x = any(-1, 1);
    const double y = any(-1, 1);
    const double z = any(-2, 2);
    const kernel::Segment second{{x - 2, y + any(-1, 1), z}, {x + 2, y + any(-1, 1), z}};
    return contact_by_one_vector(kernel::Segment{{-1, -3, 0}, {1, 3, 0}}, second, {1, 1, 0, 0.125}, {}, contact);
  });
  expect_settled("a line through a triangle of a floor", [&](const auto& any) {
    const std::array<Vector3, 3> floor{Vector3(-3, -3, 0), Vector3(3, -3, 0), Vector3(-1, 4, 0)};
    const double x = any(-1, 1);
    const kernel::Segment line{{x, any(-1, 1), 1}, {any(-1, 1), any(-1, 1), -0.75}};
    return contact_by_one_vector(kernel::Corners{floor}, line, {0, 0, 0, 0}, {}, contact);
  });
}
#endif

}  // namespace
}  // namespace contact::cores_one_vector_test
