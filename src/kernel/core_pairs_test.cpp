// The pairs that two cores answer: each stage by itself, and production, say what integers do, in every floating-point
// environment; and with x, y and z in one vector nearly all ordinary questions are settled. (What a caller asks goes to one
// stage after the other, so that each would hide the next.)
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "contact/shapes.hpp"
#include "contact/sphere_cube.hpp"
#include "kernel/contacts_for_tests.hpp"
#include "kernel/cores_one_vector.hpp"
#include "kernel/cores_stages.hpp"

namespace contact::core_pairs_test {
namespace {

using kernel::Filtered;

struct Drawn {
  Ball ball;
  Capsule first;
  Capsule second;
  Triangle triangle;
  Ray ray;
  Plane plane;
  Line line;
  Distances distances;
  ContactPoints points;
};

/// Real numbers, small integers, numbers of several powers, and few bits; near each other's features now and then.
class Draw {
 public:
  Drawn operator()(bool ordinary) {
    kind_ = ordinary ? 0 : below(5);
    const double radius = 2 * std::abs(number());
    Drawn q{{vector(), radius},
            {vector(), vector(), radius},
            {vector(), vector(), std::abs(number())},
            {{vector(), vector(), vector()}},
            {vector(), vector(), std::abs(number())},
            {vector(), number()},
            {vector(), vector()},
            {0, 0},
            {}};
    if (!ordinary) {
      if (below(2) == 0) q.distances.alarm = std::abs(number());
      if (below(2) == 0) q.distances.contact = std::abs(number());
      constexpr std::array kWhere{PointOn::nearest_surface, PointOn::center, PointOn::far_surface};
      q.points.first = kWhere[below(3)];
      q.points.second = kWhere[below(3)];
      bend(q, static_cast<double>(below(5)) / 4, below(3) == 0 ? 0 : std::ldexp(unit(), -static_cast<int>(below(60))));
    }
    if (q.ray.direction.isZero(0)) q.ray.direction = Vector3(1, 0, 0);
    if (q.plane.normal.isZero(0)) q.plane.normal = Vector3(1, 2, 0);
    if (!ordinary && below(3) == 0) scale(q);
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
  /// Something is parallel, near, level, flat or without length, but for e; `part` says where along it.
  void bend(Drawn& q, double part, double e) {
    auto& v = q.triangle.vertices;
    const Vector3 off(e, 2 * e, -e);
    const Vector3 edge = v[1] - v[0];
    const Vector3 inside = v[0] + part * 0.5 * (edge + (v[2] - v[0]));
    const auto axis = static_cast<int>(below(3));
    switch (below(12)) {
      case 0:
        q.second.end = q.second.start + (q.first.end - q.first.start) * ((part - 0.25) * (1 + e)) + off;
        break;
      case 1:
        q.ball.center = q.second.start + part * (q.second.end - q.second.start) + off;
        q.second.start = q.first.start + part * (q.first.end - q.first.start) + off;
        break;
      case 2:
        v[2] = v[0] + 2 * part * edge + off;
        break;
      case 3:
        q.ball.center = inside + off;
        break;
      case 4:
        q.ball.center = v[0] + part * edge + edge.cross(v[2] - v[0]) + off;
        break;
      case 5:
        q.plane.offset = q.plane.normal.dot(below(2) == 0 ? q.ball.center : q.first.start) + e;
        break;
      case 6:
        q.ray.origin = inside - q.ray.direction * (q.ray.length * part);
        q.line.end = inside + (inside - q.line.start) * part + off;
        break;
      case 7:
        q.plane.normal[axis] = 0;
        break;
      case 8:
        q.plane.normal = Vector3::Unit(axis) * (below(2) == 0 ? -3 : 1);
        q.first.end[axis] = q.first.start[axis] + e;
        break;
      case 9:
        (below(2) == 0 ? q.first.end : q.first.start) = q.first.start + off;
        q.second.end = q.second.start;
        q.ray.length = std::abs(e);
        break;
      case 10:
        q.ball.center = q.ray.origin + part * q.ray.length * q.ray.direction + off;
        break;
      default:
        q.ray.direction.normalize();
        q.plane.normal.normalize();
    }
  }

  /// To both ends of what plain arithmetic decides, and of all numbers; directions by themselves.
  void scale(Drawn& q) {
    constexpr std::array kEnds{0x1p-1074, 0x1p-1060, 0x1p-540, 0x1p900};
    const double unit = below(2) == 0 ? kEnds[below(4)] : std::ldexp(1, static_cast<int>(below(600)) - 300);
    const double of_directions = std::ldexp(1, static_cast<int>(below(3)) * 40 - 40);
    const auto scale_one = [&](auto& shape) {
      for_each_field(shape, [&](const auto& field, auto& value) {
        const double by = field.kind == FieldKind::direction ? of_directions
                          : field.kind == FieldKind::offset  ? unit * of_directions
                                                             : unit;
        for_each_number_in(value, [&](double& x) { x *= by; });
      });
    };
    const auto scale_all = [&](auto&... shapes) { (scale_one(shapes), ...); };
    scale_all(q.ball, q.first, q.second, q.triangle, q.ray, q.plane, q.line);
    q.ray.length /= of_directions;
    q.distances.alarm *= unit;
    q.distances.contact *= unit;
  }

  std::mt19937_64 random_{20261127};
  std::uint64_t kind_ = 0;
};

struct Count {
  int hits = 0;
  int settled = 0;  ///< in one vector
  int open = 0;     ///< in plain arithmetic
};

/// Each stage by itself, and production: of integers alone comes what is expected.
template <class A, class B>
void expect_all_stages_say_the_same(const A& a, const B& b, Distances distances, ContactPoints points, Count& count) {
  const auto& first = kernel::core_of(a);
  const auto& second = kernel::core_of(b);
  const kernel::Lengths lengths = kernel::lengths_of(a, b, distances);
  const auto expected = computed_exactly(a, b, distances, points);
  count.hits += expected ? 1 : 0;
  count.open += plain_filtered(first, second, lengths) == Filtered::undecided ? 1 : 0;
  const auto& [said_contact, said_hit] = said(a, b, distances, points);
  expect_same(said_contact, expected);
  EXPECT_EQ(said_hit, expected.has_value());
  const auto compare = [&](bool hit, const Contact& contact) {
    expect_same(hit ? std::optional(contact) : std::nullopt, expected);
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
  count.settled += expected ? 1 : 0;
#endif
}

template <auto kFirst, auto kSecond>
struct Of {
  static const auto& first(const Drawn& q) { return q.*kFirst; }
  static const auto& second(const Drawn& q) { return q.*kSecond; }
  /// Of crossings no distance counts.
  static Distances distances(const Drawn& q) {
    const bool crosses = requires { plain_decision::filter_pair(first(q), second(q)); };
    return crosses ? Distances{0, 0} : q.distances;
  }
};
template <class Pair>
struct CorePairs : testing::Test {
  static Count asked(int questions, bool ordinary) {
    Draw draw;
    Count count;
    for (int i = 0; i < questions && !testing::Test::HasFailure(); ++i) {
      const Drawn q = draw(ordinary);
      expect_all_stages_say_the_same(Pair::first(q), Pair::second(q), Pair::distances(q), q.points, count);
    }
    return count;
  }
};
using Pairs = testing::Types<Of<&Drawn::ball, &Drawn::second>, Of<&Drawn::first, &Drawn::second>,
                             Of<&Drawn::ball, &Drawn::triangle>, Of<&Drawn::ray, &Drawn::ball>,
                             Of<&Drawn::ball, &Drawn::plane>, Of<&Drawn::first, &Drawn::plane>,
                             Of<&Drawn::ray, &Drawn::triangle>, Of<&Drawn::triangle, &Drawn::line>>;
TYPED_TEST_SUITE(CorePairs, Pairs);

TYPED_TEST(CorePairs, say_what_integers_do_in_all_stages) {
  const Count count = this->asked(20000, false);
  EXPECT_GT(count.hits, 1000);
  EXPECT_GT(count.open, 1000);
  EXPECT_LT(count.open, 12000);
}

TYPED_TEST(CorePairs, are_settled_in_one_vector_where_they_are_ordinary) {
  const Count count = this->asked(2000, true);
  EXPECT_GT(count.hits, 50);
#if CONTACT_HAS_ONE_VECTOR
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    EXPECT_GT(count.settled, count.hits * 95 / 100);
  }
#endif
}

TYPED_TEST(CorePairs, are_the_same_in_every_floating_point_environment) {
  Draw draw;
  std::vector<Drawn> asked;
  for (int i = 0; i < 600; ++i) asked.push_back(draw(false));
  expect_same_in_every_environment(asked, [](const Drawn& q, bool traps) {
    return said(TypeParam::first(q), TypeParam::second(q), TypeParam::distances(q), q.points, traps);
  });
}

/// A hit of a ball and a box against cores: outside a box its nearest point is made of numbers of the question, and so a core by
/// itself. Inside the library out of line is asked, which other tests hold against the oracle.
Count asked_of_balls_and_boxes(int questions, bool ordinary) {
  Draw draw;
  Count count;
  for (int i = 0; i < questions && !testing::Test::HasFailure(); ++i) {
    const Drawn q = draw(ordinary);
    for (const Vector3& center : {q.first.start, q.first.end, q.triangle.vertices[0], q.ball.center}) {
      for (const Vector3& corner : {q.second.start, q.second.end, q.triangle.vertices[1]}) {
        const Box box{center.cwiseMin(corner), center.cwiseMax(corner)};
        if (plain_decision::filter_ball_and_box(q.ball, box, q.distances.alarm) != Filtered::hit) continue;
        const Vector3 nearest = q.ball.center.cwiseMax(box.min).cwiseMin(box.max);
        expect_same(of_hit::compute_sphere_cube(q.ball, box, q.distances, q.points),
                    nearest != q.ball.center
                        ? computed_exactly(q.ball, Capsule{nearest, nearest, 0}, q.distances, q.points)
                        : out_of_line::compute_sphere_cube(q.ball, box, q.distances, q.points));
        // In a corner three faces are as near: that is left to others.
        if (center == q.ball.center) continue;
        ++count.hits;
        const auto left = [] { return std::optional<Contact>(); };
        count.settled += kernel::contact_of_hit(q.ball, box, q.distances.contact, q.points, left) ? 1 : 0;
      }
    }
  }
  return count;
}
TEST(CoresInOneVector, say_of_balls_in_boxes_what_integers_do) {
  EXPECT_GT(asked_of_balls_and_boxes(3000, false).hits, 150);
  [[maybe_unused]] const Count ordinary = asked_of_balls_and_boxes(2000, true);
#if CONTACT_HAS_ONE_VECTOR
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    EXPECT_GT(ordinary.settled, ordinary.hits * 95 / 100);
  }
#endif
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
}  // namespace contact::core_pairs_test
