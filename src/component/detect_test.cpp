// Detection between whole models: what it finds is what the exact oracle finds over all pairs, in the order documented.
#include "contact/detect.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "component/counting_new_for_tests.hpp"
#include "component/expected_for_tests.hpp"
#include "component/models_for_tests.hpp"
#include "contact/cube_cube.hpp"
#include "contact/discrete_intersection.hpp"
#include "environment/floating_point_environments.hpp"
#include "extreme_numbers.hpp"

namespace contact {
namespace {

using component::cubes;
using component::expected_contact;
using component::expected_hit;
using component::numbered_contact;
using component::Press;
using component::rigid_spheres;
using component::spheres;
using component::text;
using component::what_of;

/// Two sets of spheres and the distances to detect with.
struct Scene {
  std::string name;
  std::vector<Ball> first;
  std::vector<Ball> second;
  Distances distances;
};

/// Balls whose numbers come from `number`; radii are made non-negative.
std::vector<Ball> balls(std::size_t count, const std::function<double()>& number) {
  std::vector<Ball> all;
  for (std::size_t i = 0; i < count; ++i) {
    Ball ball;
    for (int axis = 0; axis < 3; ++axis) ball.center[axis] = number();
    ball.radius = std::abs(number());
    all.push_back(ball);
  }
  return all;
}

/// An edge^3 grid of balls one unit apart, in units of `unit`.
std::vector<Ball> grid(int edge, double radius, double unit, const Vector3& origin) {
  std::vector<Ball> all;
  for (int x = 0; x < edge; ++x)
    for (int y = 0; y < edge; ++y)
      for (int z = 0; z < edge; ++z) all.push_back({unit * (origin + Vector3(x, y, z)), unit * radius});
  return all;
}

/// Balls in a row along x, each exactly at the alarm distance of the next of the other set, or one ulp off.
Scene edge_of_alarm(std::mt19937_64& random) {
  Scene scene{"at the alarm distance", {}, {}, {0.375, 0.125}};
  for (int i = 0; i < 12; ++i) {
    const auto steps = [&](std::uint64_t n) { return std::ldexp(static_cast<double>(random() % n), -20); };
    const double x = 1000.0 * i + steps(1 << 20);
    const double r1 = steps(1 << 18);
    const double r2 = steps(1 << 18);
    double other = x + r1 + r2 + 0.375;  // exact: everything is a multiple of 2^-20
    if (i % 3 == 1) other = std::nextafter(other, kInfinity);
    if (i % 3 == 2) other = std::nextafter(other, -kInfinity);
    Ball a{{0, 0, 0}, r1};
    Ball b{{0, 0, 0}, r2};
    a.center[i % 2] = x;
    b.center[i % 2] = other;
    scene.first.push_back(a);
    scene.second.push_back(b);
  }
  return scene;
}

std::vector<Scene> scenes(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto unit = [&] { return std::ldexp(static_cast<double>(random() >> 11), -53); };
  const auto signed_unit = [&] { return 2 * unit() - 1; };
  const auto finite = [&] { return finite_of(random()); };
  const auto integer = [&](int limit) {
    return static_cast<double>(static_cast<int>(random() % static_cast<unsigned>(2 * limit + 1)) - limit);
  };
  const auto mixed_radii = [&](std::vector<Ball> all) {
    for (std::size_t i = 0; i < all.size(); ++i)
      all[i].radius = std::ldexp(unit(), i % 3 == 0 ? 1 : (i % 3 == 1 ? -60 : -6));
    return all;
  };
  std::vector<Scene> all{
      {"a grid of touching spheres", grid(3, 0.5, 1, {0, 0, 0}), grid(3, 0.5, 1, {1, 0, 0}), {0, 0}},
      {"coincident centres",
       std::vector<Ball>(4, Ball{{1, 2, 3}, 1}),
       std::vector<Ball>(5, Ball{{1, 2, 3}, 2}),
       {0, 1}},
      {"nested", {{{0, 0, 0}, 1}, {{0.5, 0, 0}, 4}, {{0, 1, 0}, 16}}, {{{0, 0, 0.25}, 2}, {{0, 0, 0}, 8}}, {0, 0.5}},
      {"huge and tiny radii", mixed_radii(balls(20, signed_unit)), mixed_radii(balls(18, signed_unit)), {0.01, 0.01}},
      {"all overlapping",
       balls(9, [&] { return 0.5 + 0.25 * unit(); }),
       balls(8, [&] { return 0.5 + 0.25 * unit(); }),
       {0, 0}},
      {"no elements at all", {}, {}, {1, 0}},
      {"no elements in the first", {}, balls(5, signed_unit), {1, 0}},
      {"no elements in the second", balls(5, signed_unit), {}, {1, 0}},
      {"one element", balls(1, signed_unit), balls(1, signed_unit), {4, 0}},
      {"subnormal",
       balls(16, [&] { return kLeast * integer(9); }),
       balls(14, [&] { return kLeast * integer(9); }),
       {kLeast, 0}},
      {"a subnormal grid", grid(3, 1, kLeast, {0, 0, 0}), grid(2, 0, kLeast, {2, 0, 0}), {0, 0}},
      {"near the largest finite number",
       balls(14, [&] { return kLargest * signed_unit() * (random() % 2 ? 1 : 0.01); }),
       balls(12, [&] { return kLargest * signed_unit() * (random() % 2 ? 1 : 0.01); }),
       {0, 0}},
      {"at the largest finite number",
       {{{kLargest, 0, 0}, kLargest}, {{kLargest, kLargest, 0}, 0}, {{0, 0, 0}, kLargest}},
       {{{-kLargest, 0, 0}, kLargest},
        {{-kLargest, 0, 0}, std::nextafter(kLargest, 0)},
        {{kLargest, kLargest, kLeast}, 0}},
       {0, 0}},
      {"larger than the range",
       balls(20, [&] { return kLargest * (0.5 + 0.5 * unit()) * (random() % 2 ? 1 : -1); }),
       balls(18, [&] { return kLargest * signed_unit(); }),
       {0, kLargest}},
      {"the largest alarm distance",
       balls(6, [&] { return kLargest * signed_unit(); }),
       balls(6, [&] { return kLargest * signed_unit(); }),
       {kLargest, kLargest}},
      {"an alarm distance larger than the scene", balls(9, signed_unit), balls(10, signed_unit), {10, 3}},
      {"alarm distance 0", balls(20, signed_unit), balls(24, signed_unit), {0, 0}},
      {"sparse",
       balls(24, [&] { return 9 * signed_unit(); }),
       balls(24, [&] { return 9 * signed_unit(); }),
       {0.25, 0.125}},
      {"raw bits", balls(16, finite), balls(16, finite), {std::abs(finite()), std::abs(finite())}},
      edge_of_alarm(random)};
  for (Scene& scene : all)
    if (scene.name == "sparse")
      for (auto* side : {&scene.first, &scene.second})
        for (Ball& ball : *side) ball.radius = 2 * unit();
  return all;
}

/// All pairs put to the oracle, in the order that detect documents.
template <class Model1, class Model2>
std::vector<std::string> all_pairs(const Model1& model1, const Model2& model2, Distances distances,
                                   bool swapped = false) {
  OutputVector contacts;
  for (Index i = 0; i < model1.getSize(); ++i)
    for (Index j = 0; j < model2.getSize(); ++j) {
      const auto ask = swapped ? component::expected_swapped<Ball, Ball> : expected_contact<Ball, Ball>;
      if (const auto contact = ask({model1, i}, model1.balls()[i], {model2, j}, model2.balls()[j], distances))
        contacts.push_back(*contact);
    }
  return text(contacts);
}

TEST(Detect, finds_what_the_oracle_finds_over_all_pairs_of_every_kind_and_scene) {
  int contacts = 0;
  int pairs = 0;
  for (const std::uint64_t seed : {1U, 2U, 3U})
    for (const Scene& scene : scenes(seed)) {
      SCOPED_TRACE(scene.name + ", seed " + std::to_string(seed));
      const ProximityIntersection component(scene.distances);
      const auto s1 = spheres("first", scene.first);
      const auto s2 = spheres("second", scene.second);
      const auto r1 = rigid_spheres("first", scene.first);
      const auto r2 = rigid_spheres("second", scene.second);
      const std::vector<std::string> expected = all_pairs(s1, s2, scene.distances);
      EXPECT_EQ(text(*detect(component, s1, s2)), expected);
      EXPECT_EQ(text(*detect(component, r1, r2)), expected);
      EXPECT_EQ(text(*detect(component, s1, r2)), expected);
      EXPECT_EQ(text(*detect(component, r1, s2)), all_pairs(r1, s2, scene.distances, true));
      contacts += static_cast<int>(expected.size());
      pairs += static_cast<int>(scene.first.size() * scene.second.size());
    }
  EXPECT_GT(contacts, 2 * pairs / 10);  // the scenes are worth asking: 20 to 70 % of all pairs meet
  EXPECT_LT(contacts, 7 * pairs / 10);
}

TEST(Detect, finds_the_same_in_every_floating_point_environment) {
  for (const Scene& scene : scenes(4)) {
    const ProximityIntersection component(scene.distances);
    const auto s = spheres("first", scene.first);
    const auto r = rigid_spheres("second", scene.second);
    const std::vector<std::string> expected = text(*detect(component, s, r));
    for (const auto& environment : floating_point_environments()) {
      std::optional<OutputVector> contacts;
      in_environment(environment, [&] { contacts = detect(component, s, r); });
      EXPECT_EQ(text(*contacts), expected) << scene.name << ", " << environment.name;
    }
  }
}

TEST(Detect, orders_contacts_by_the_index_in_the_first_model_then_in_the_second) {
  // Eight spheres at one place in each: every pair meets.
  const auto a = spheres("a", std::vector<Ball>(8, Ball{{0, 0, 0}, 1}));
  const auto b = rigid_spheres("b", std::vector<Ball>(40, Ball{{1, 0, 0}, 1}));
  const auto in_order = [](const OutputVector& contacts) {
    return std::is_sorted(contacts.begin(), contacts.end(), [](const auto& x, const auto& y) {
      return std::pair(x.elem.first.getIndex(), x.elem.second.getIndex()) <
             std::pair(y.elem.first.getIndex(), y.elem.second.getIndex());
    });
  };
  const DiscreteIntersection component;
  EXPECT_EQ(detect(component, a, b)->size(), 320U);
  EXPECT_TRUE(in_order(*detect(component, a, b)));
  EXPECT_TRUE(in_order(*detect(component, b, a)));
}

TEST(Detect, keeps_that_order_among_many_hundred_thousand_contacts) {
  const auto a = spheres("a", std::vector<Ball>(900, Ball{{0, 0, 0}, 1}));
  const auto b = spheres("b", std::vector<Ball>(700, Ball{{1, 0, 0}, 1}));
  const auto contacts = detect(DiscreteIntersection(), a, b);
  ASSERT_EQ(contacts->size(), 630000U);
  Index next = 0;
  for (const DetectionOutput& contact : *contacts) {
    ASSERT_EQ(contact.elem.first.getIndex(), next / 700);
    ASSERT_EQ(contact.elem.second.getIndex(), next % 700);
    ++next;
  }
}

TEST(Detect, of_a_model_with_itself_takes_each_pair_of_different_elements_once_the_lower_index_first) {
  for (const Scene& scene : scenes(5)) {
    SCOPED_TRACE(scene.name);
    const ProximityIntersection component(scene.distances);
    std::vector<Ball> both = scene.first;
    both.insert(both.end(), scene.second.begin(), scene.second.end());
    const auto s = spheres("s", both);
    const auto r = rigid_spheres("s", both);
    OutputVector expected;
    for (Index i = 0; i < s.getSize(); ++i)
      for (Index j = i + 1; j < s.getSize(); ++j)
        if (const auto contact = expected_contact({s, i}, both[static_cast<std::size_t>(i)], {s, j},
                                                  both[static_cast<std::size_t>(j)], scene.distances))
          expected.push_back(*contact);
    EXPECT_EQ(text(*detect(component, s)), text(expected));
    EXPECT_EQ(text(*detect(component, r)), text(expected));
    EXPECT_EQ(text(*detect(component, s, s)), text(expected)) << "the same model given twice";
  }
}

TEST(Detect, of_two_equal_models_is_not_that_of_a_model_with_itself) {
  const std::vector<Ball> two{{{0, 0, 0}, 1}, {{1, 0, 0}, 1}};
  const DiscreteIntersection component;
  EXPECT_EQ(detect(component, spheres("a", two), spheres("b", two))->size(), 4U);
  EXPECT_EQ(detect(component, spheres("a", two))->size(), 1U);
}

/// On so many threads, which take turns: each begins with work of its own, from the end.
ParallelFor on_threads(std::size_t threads) {
  return [threads](std::size_t count, const std::function<void(std::size_t)>& work) {
    std::vector<std::thread> all;
    std::vector<std::exception_ptr> errors(threads);
    for (std::size_t t = 0; t < threads; ++t)
      all.emplace_back([&, t] {
        try {
          for (std::size_t i = count; i-- > 0;)
            if (i % threads == t) work(i);
        } catch (...) {
          errors[t] = std::current_exception();
        }
      });
    for (std::thread& thread : all) thread.join();
    for (const auto& error : errors)
      if (error) std::rethrow_exception(error);
  };
}

std::vector<std::string> streamed(const Intersection& intersection, const CollisionModel& a, const CollisionModel& b,
                                  const ParallelFor& parallel_for) {
  OutputVector all;
  EXPECT_TRUE(detect_streamed(
      intersection, a, b,
      [&](std::span<const OutputVector> some) {
        for (const OutputVector& contacts : some) all.insert(all.end(), contacts.begin(), contacts.end());
      },
      parallel_for));
  return text(all);
}

TEST(Detect, streamed_gives_the_same_contacts_in_the_same_order_on_any_number_of_threads) {
  for (const Scene& scene : scenes(6)) {
    SCOPED_TRACE(scene.name);
    const ProximityIntersection component(scene.distances);
    const auto s = spheres("s", scene.first);
    const auto r = rigid_spheres("r", scene.second);
    for (const auto& [a, b] : {std::pair<const CollisionModel&, const CollisionModel&>(s, r), {r, s}, {s, s}}) {
      const std::vector<std::string> expected = text(*detect(component, a, b));
      for (const std::size_t threads : {0U, 1U, 2U, 5U})
        EXPECT_EQ(streamed(component, a, b, threads == 0 ? ParallelFor() : on_threads(threads)), expected) << threads;
    }
  }
}

TEST(Detect, streamed_keeps_the_order_among_many_thousand_elements_of_which_one_is_huge) {
  std::mt19937_64 random(8);
  const auto number = [&] { return std::ldexp(static_cast<double>(random() >> 11), -53); };
  std::vector<Ball> first = balls(30000, number);
  std::vector<Ball> second = balls(20000, number);
  for (Ball& ball : first) ball.radius *= 0.03;
  for (Ball& ball : second) ball.radius *= 0.03;
  first[17].radius = 0.4;
  second[19999].center *= 0x1p40;  // all others share a cell of the curve, and so of the next
  const auto a = spheres("a", first);
  const auto b = rigid_spheres("b", second);
  const DiscreteIntersection component;
  const OutputVector expected = *detect(component, a, b);
  EXPECT_GT(expected.size(), 30000U);
  std::size_t next = 0;
  std::size_t wrong = 0;
  detect_streamed(
      component, a, b,
      [&](std::span<const OutputVector> some) {
        for (const OutputVector& contacts : some)
          for (const DetectionOutput& contact : contacts) {
            wrong += next >= expected.size() || contact.elem != expected[next].elem ||
                             contact.value != expected[next].value || contact.normal != expected[next].normal
                         ? 1
                         : 0;
            ++next;
          }
      },
      on_threads(3));
  EXPECT_EQ(wrong, 0U);
  EXPECT_EQ(next, expected.size());
}

TEST(Detect, streamed_ends_with_what_is_thrown_and_says_where_there_is_no_intersector) {
  const auto s = spheres("s", std::vector<Ball>(900, Ball{{0, 0, 0}, 1}));
  const DiscreteIntersection component;
  for (const ParallelFor& parallel_for : {ParallelFor(), on_threads(2)}) {
    int calls = 0;
    const auto take = [&](std::span<const OutputVector>) {
      if (++calls == 2) throw std::runtime_error("enough");
    };
    EXPECT_EQ(what_of<std::runtime_error>([&] { detect_streamed(component, s, take, parallel_for); }), "enough");
    EXPECT_EQ(calls, 2);
  }
  const auto c = cubes("c", {{{0, 0, 0}, {1, 1, 1}}});
  DiscreteIntersection silent;
  silent.intersectors.setSink({});
  EXPECT_FALSE(detect_streamed(silent, s, c, [](std::span<const OutputVector>) { ADD_FAILURE(); }));
}

/// Boxes, decided as the built-in ones are, and with a contact for each hit: number 100 i + j.
class BoxContacts : public BaseIntersector {
 public:
  static constexpr std::string_view kName = "BoxContacts";
  explicit BoxContacts(DiscreteIntersection& object) {
    object.intersectors.add<CubeCollisionModel, CubeCollisionModel>(*this);
  }
  bool testIntersection(const Cube& a, const Cube& b, const Intersection& current) const {
    return test_cube_cube(a.box(), b.box(), current.getAlarmDistance());
  }
  int computeIntersection(const Cube& a, const Cube& b, OutputVector& contacts, const Intersection&) const {
    contacts.push_back(numbered_contact(a, b, 100 * a.getIndex() + b.getIndex()));
    return 1;
  }
};

std::vector<Box> boxes(const std::vector<Ball>& balls) {
  std::vector<Box> all;
  for (const Ball& ball : balls) {
    Box box{ball.center, ball.center};
    for (int axis = 0; axis < 3; ++axis)
      box.max[axis] = std::min(ball.center[axis] + (axis == 1 ? 0.5 : 1) * ball.radius, kLargest);
    all.push_back(box);
  }
  return all;
}

TEST(Detect, finds_the_boxes_that_the_oracle_finds_over_all_pairs) {
  IntersectorFactory factory;
  factory.registerCreator("BoxContacts", creator_of<BoxContacts>());
  std::size_t contacts = 0;
  std::size_t pairs = 0;
  for (const std::uint64_t seed : {6U, 7U, 8U})
    for (const Scene& scene : scenes(seed)) {
      SCOPED_TRACE(scene.name + ", seed " + std::to_string(seed));
      const ProximityIntersection component(scene.distances, PointConvention::nearest_surface, factory);
      const auto a = cubes("first", boxes(scene.first));
      const auto b = cubes("second", boxes(scene.second));
      OutputVector expected;
      for (Index i = 0; i < a.getSize(); ++i)
        for (Index j = 0; j < b.getSize(); ++j)
          if (expected_hit(a.box(i), b.box(j), scene.distances.alarm))
            expected.push_back(numbered_contact({a, i}, {b, j}, 100 * i + j));
      EXPECT_EQ(text(*detect(component, a, b)), text(expected));
      contacts += expected.size();
      pairs += scene.first.size() * scene.second.size();
      OutputVector itself;
      for (Index i = 0; i < a.getSize(); ++i)
        for (Index j = i + 1; j < a.getSize(); ++j)
          if (expected_hit(a.box(i), a.box(j), scene.distances.alarm))
            itself.push_back(numbered_contact({a, i}, {a, j}, 100 * i + j));
      EXPECT_EQ(text(*detect(component, a)), text(itself));
    }
  EXPECT_GT(contacts, pairs / 10);  // boxes reach no farther than their radius on one side
  EXPECT_LT(contacts, 7 * pairs / 10);
}

#if defined(__SSE2__)
TEST(Detect, loses_no_boxes_whose_gap_is_flushed_to_zero) {
  // The second box ends 5 of the least numbers below the first: exactly the alarm distance.
  constexpr double kFive = 5 * 0x1p-1074;
  const CubeCollisionModel first("first", Eigen::MatrixX3d::Zero(1, 3), Eigen::MatrixX3d::Ones(1, 3));
  const CubeCollisionModel second("second", Eigen::MatrixX3d::Constant(1, 3, -1),
                                  Eigen::MatrixX3d::Constant(1, 3, -kFive));
  IntersectorFactory factory;
  factory.registerCreator("BoxContacts", creator_of<BoxContacts>());
  const ProximityIntersection intersection({kFive, 0}, PointConvention::nearest_surface, factory);
  const unsigned before = _mm_getcsr();
  _mm_setcsr(before | 0x8000);  // results alone: the numbers in memory stay what they are
  const std::size_t forward = detect(intersection, first, second)->size();
  const std::size_t backward = detect(intersection, second, first)->size();
  _mm_setcsr(before);
  EXPECT_EQ(forward, 1U);
  EXPECT_EQ(backward, 1U);
}
#endif

TEST(Detect, of_cubes_alone_is_supported_and_without_contacts) {
  const auto a = cubes("a", {{{0, 0, 0}, {1, 1, 1}}});
  const auto contacts = detect(DiscreteIntersection(), a, a);
  ASSERT_TRUE(contacts.has_value());
  EXPECT_TRUE(contacts->empty());
}

/// Serves (RigidSphereModel, SphereCollisionModel) directly, and so (SphereCollisionModel, RigidSphereModel) swapped.
class Reversed : public ProximityIntersection {
 public:
  using DiscreteIntersection::computeIntersection;
  using DiscreteIntersection::testIntersection;
  explicit Reversed(Distances distances) : ProximityIntersection(distances) {
    reversed_.add<RigidSphereModel, SphereCollisionModel>(*this);
  }
  const ElementIntersector* findIntersector(const CollisionModel& a, const CollisionModel& b,
                                            bool& swap) const override {
    return reversed_.get(a, b, swap);
  }
  bool testIntersection(const RigidSphere& a, const Sphere& b, const Intersection& current) const {
    return testIntersectionSphere(a, b, current.getAlarmDistance());
  }
  int computeIntersection(const RigidSphere& a, const Sphere& b, OutputVector& contacts,
                          const Intersection& current) const {
    return computeIntersectionSphere(a, b, contacts, current.getAlarmDistance(), current.getContactDistance());
  }

 private:
  IntersectorMap reversed_;
};

/// The lines of a detection seen from the other side, in the other side's order.
std::vector<std::string> seen_from_the_other_side(OutputVector contacts) {
  std::transform(contacts.begin(), contacts.end(), contacts.begin(), mirrored);
  std::multimap<std::pair<Index, Index>, DetectionOutput> sorted;  // those of one pair stay as they were written
  for (const DetectionOutput& c : contacts)
    sorted.emplace(std::pair(c.elem.first.getIndex(), c.elem.second.getIndex()), c);
  contacts.clear();
  for (const auto& entry : sorted) contacts.push_back(entry.second);
  return text(contacts);
}

bool has_coincident_centres(const Scene& scene) {
  return std::any_of(scene.first.begin(), scene.first.end(), [&](const Ball& a) {
    return std::any_of(scene.second.begin(), scene.second.end(), [&](const Ball& b) { return a.center == b.center; });
  });
}

TEST(Detect, of_the_models_exchanged_is_mirrored_bit_for_bit_whichever_order_the_intersector_takes) {
  int compared = 0;
  for (const std::uint64_t seed : {9U, 10U})
    for (const Scene& scene : scenes(seed)) {
      SCOPED_TRACE(scene.name + ", seed " + std::to_string(seed));
      const ProximityIntersection component(scene.distances);
      const Reversed reversed(scene.distances);
      const auto s1 = spheres("s1", scene.first);
      const auto s2 = spheres("s2", scene.second);
      const auto r1 = rigid_spheres("r1", scene.first);
      const auto r2 = rigid_spheres("r2", scene.second);
      // Kinds that one intersector serves in both orders: exact, coincident centres included.
      EXPECT_EQ(text(*detect(component, r2, s1)), seen_from_the_other_side(*detect(component, s1, r2)));
      EXPECT_EQ(text(*detect(reversed, s1, r2)), seen_from_the_other_side(*detect(reversed, r2, s1)));
      // Coincident centres have the normal (1,0,0) from whichever sphere the intersector takes first.
      if (has_coincident_centres(scene)) continue;
      ++compared;
      EXPECT_EQ(text(*detect(component, s2, s1)), seen_from_the_other_side(*detect(component, s1, s2)));
      EXPECT_EQ(text(*detect(component, r2, r1)), seen_from_the_other_side(*detect(component, r1, r2)));
      EXPECT_EQ(text(*detect(reversed, s1, r2)), text(*detect(component, s1, r2)));
      EXPECT_EQ(text(*detect(reversed, r2, s1)), text(*detect(component, r2, s1)));
    }
  EXPECT_GT(compared, 20);
}

TEST(Detect, keeps_the_point_convention_of_each_kind_when_it_swaps) {
  const auto s = spheres("s", {{{0, 0, 0}, 1}});
  const auto r = rigid_spheres("r", {{{3, 4, 0}, 2}});
  const auto at = [&](PointConvention convention) {
    return detect(DiscreteIntersection(convention), r, spheres("s", {{{0, 0, 0}, 3}}))->at(0);
  };
  // distance 5, normal from the rigid sphere (-0.6, -0.8, 0)
  EXPECT_EQ(at(PointConvention::center).normal, Vector3(-0.6, -0.8, 0));
  EXPECT_EQ(at(PointConvention::center).point[0], Vector3(1.8, 2.4, 0));
  EXPECT_EQ(at(PointConvention::center).point[1], Vector3(0, 0, 0));
  EXPECT_EQ(at(PointConvention::published).point[0], Vector3(4.2, 5.6, 0));
}

/// Writes a contact before and after: number -1 and -2, of the models as it is given them.
class Bracketing : public BaseIntersector {
 public:
  static constexpr std::string_view kName = "Bracketing";
  int beginIntersection(const CollisionModel& a, const CollisionModel& b, OutputVector& contacts) const {
    contacts.push_back(numbered_contact({a, 0}, {b, 0}, -1));
    return 1;
  }
  int endIntersection(const CollisionModel& a, const CollisionModel& b, OutputVector& contacts) const {
    contacts.push_back(numbered_contact({a, 0}, {b, 0}, -2));
    return 1;
  }
  bool testIntersection(const Cube& cube, const Sphere&, const Intersection&) const { return cube.getIndex() != 1; }
  int computeIntersection(const Cube& a, const Sphere& b, OutputVector& contacts, const Intersection&) const {
    contacts.push_back(numbered_contact(a, b, 10));
    contacts.push_back(numbered_contact(a, b, 11));
    return 2;
  }
};

TEST(Detect, puts_first_what_begins_and_last_what_ends_and_keeps_each_pairs_contacts_as_written) {
  const Bracketing bracketing;
  DiscreteIntersection component;
  component.intersectors.add<CubeCollisionModel, SphereCollisionModel>(bracketing);
  const auto c = cubes("c", std::vector<Box>(3, Box{{0, 0, 0}, {1, 1, 1}}));
  const auto s = spheres("s", {{{0, 0, 0}, 1}});
  const auto numbers = [](const OutputVector& contacts) {
    std::string line;
    for (const auto& contact : contacts)
      line += text(contact.elem.first) + text(contact.elem.second) + std::to_string(contact.id) + " " +
              text(contact.normal[0]) + "; ";
    return line;
  };
  EXPECT_EQ(numbers(*detect(component, c, s)),
            "c[0]s[0]-1 0x1p+0; c[0]s[0]10 0x1p+0; c[0]s[0]11 0x1p+0; c[2]s[0]10 0x1p+0; c[2]s[0]11 0x1p+0; "
            "c[0]s[0]-2 0x1p+0; ");
  EXPECT_EQ(numbers(*detect(component, s, c)),
            "s[0]c[0]-1 -0x1p+0; s[0]c[0]10 -0x1p+0; s[0]c[0]11 -0x1p+0; s[0]c[2]10 -0x1p+0; s[0]c[2]11 -0x1p+0; "
            "s[0]c[0]-2 -0x1p+0; ");
}

/// Numbers its contacts itself: 0 and 1 for each pair.
class TwoContacts : public BaseIntersector {
 public:
  static constexpr std::string_view kName = "TwoContacts";
  bool testIntersection(const Cube&, const Sphere&, const Intersection&) const { return true; }
  int computeIntersection(const Cube& a, const Sphere& b, OutputVector& contacts, const Intersection&) const {
    for (const int id : {0, 1}) contacts.push_back(numbered_contact(a, b, id));
    return 2;
  }
};

TEST(Detect, keeps_the_numbers_that_an_intersector_gave_when_it_swaps) {
  const TwoContacts two;
  DiscreteIntersection component;
  component.intersectors.add<CubeCollisionModel, SphereCollisionModel>(two);
  const auto s = spheres("s", std::vector<Ball>(2, Ball{{0, 0, 0}, 1}));
  const auto c = cubes("c", std::vector<Box>(2, Box{{0, 0, 0}, {1, 1, 1}}));
  const OutputVector contacts = *detect(component, s, c);
  ASSERT_EQ(contacts.size(), 8U);
  for (std::size_t k = 0; k < contacts.size(); ++k) EXPECT_EQ(contacts[k].id, static_cast<std::int64_t>(k % 2)) << k;
}

/// Says of each pair that it wrote so many contacts, and writes so many of all together.
class Miscounting : public BaseIntersector {
 public:
  static constexpr std::string_view kName = "Miscounting";
  Miscounting(std::size_t said, std::size_t wrote) : said_(said), wrote_(wrote) {}
  bool testIntersection(const Sphere&, const Sphere&, const Intersection&) const { return true; }
  int computeIntersection(const Sphere&, const Sphere&, OutputVector&, const Intersection&) const { return 0; }
  bool intersectPairs(const SphereCollisionModel& a, const SphereCollisionModel& b, std::span<const ElementPair> pairs,
                      std::span<std::size_t> written, OutputVector& contacts, const Intersection&) const {
    std::fill(written.begin(), written.end(), said_);
    contacts.insert(contacts.end(), wrote_, numbered_contact({a, pairs.front().first}, {b, pairs.front().second}, 5));
    return true;
  }

 private:
  std::size_t said_;
  std::size_t wrote_;
};

TEST(Detect, refuses_an_intersector_that_wrote_another_number_of_contacts_than_it_says) {
  const auto s = spheres("s", std::vector<Ball>(3, Ball{{0, 0, 0}, 1}));  // 3 pairs
  const auto said = [&](std::size_t count, std::size_t wrote) {
    const Miscounting miscounting(count, wrote);
    DiscreteIntersection component;
    component.intersectors.add<SphereCollisionModel, SphereCollisionModel>(miscounting);
    return what_of<std::logic_error>([&] { (void)detect(component, s); });
  };
  const std::string refused =
      "Miscounting<SphereCollisionModel,SphereCollisionModel>: the numbers of contacts that it says it wrote are not "
      "those it wrote";
  EXPECT_EQ(said(2, 6), "");
  EXPECT_EQ(said(0, 0), "");
  EXPECT_EQ(said(5, 0), refused);
  EXPECT_EQ(said(1, 2), refused);
  EXPECT_EQ(said(1, 4), refused);
  EXPECT_EQ(said(0, 1), refused);
  EXPECT_EQ(said(std::numeric_limits<std::size_t>::max(), 3), refused);
  EXPECT_EQ(said(std::numeric_limits<std::size_t>::max() / 3 + 2, 3), refused) << "their sum overflows, to 3 or so";
}

/// Takes contacts back that others had written.
class Shrinking : public Miscounting {
 public:
  Shrinking() : Miscounting(0, 0) {}
  bool intersectPairs(const SphereCollisionModel&, const SphereCollisionModel&, std::span<const ElementPair>,
                      std::span<std::size_t>, OutputVector& contacts, const Intersection&) const {
    if (calls_++ > 0) contacts.clear();
    if (calls_ == 1) return false;
    return true;
  }
  int computeIntersection(const Sphere& a, const Sphere& b, OutputVector& contacts, const Intersection&) const {
    contacts.push_back(numbered_contact(a, b, 5));
    return 1;
  }

 private:
  mutable int calls_ = 0;
};

TEST(Detect, refuses_an_intersector_that_takes_contacts_back) {
  const auto s = spheres("s", std::vector<Ball>(60, Ball{{0, 0, 0}, 1}));  // more pairs than are put to it at once
  const Shrinking shrinking;
  DiscreteIntersection component;
  component.intersectors.add<SphereCollisionModel, SphereCollisionModel>(shrinking);
  EXPECT_NE(what_of<std::logic_error>([&] { (void)detect(component, s); }), "");
}

/// Two boxes, of which the second is whatever one likes.
class OddBoxes : public ModelOf<OddBoxes> {
 public:
  static constexpr std::string_view kName = "OddBoxes";
  using Element = ElementOf<OddBoxes>;
  explicit OddBoxes(Box box) : ModelOf("odd"), box_(std::move(box)) {}
  [[nodiscard]] Index getSize() const override { return 2; }
  [[nodiscard]] Box bounding_box(Index index) const override {
    return index == 1 ? box_ : Box{Vector3::Zero(), Vector3::Ones()};
  }

 private:
  Box box_;
};
TEST(Detect, refuses_a_bounding_box_that_is_none) {
  const Press intersector(5);
  DiscreteIntersection component;
  component.intersectors.add<OddBoxes, OddBoxes>(intersector);
  const auto said = [&](const Vector3& min, const Vector3& max) {
    const OddBoxes model(Box{min, max});
    return what_of<std::logic_error>([&] { (void)detect(component, model); });
  };
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const std::string refused = "OddBoxes \"odd\": the bounding box of element 1 is none";
  EXPECT_EQ(said({0, 0, 0}, {0, 1, 1}), "");
  EXPECT_EQ(said(Vector3::Constant(-kInfinity), Vector3::Constant(kInfinity)), "");
  EXPECT_EQ(said({0, kNaN, 0}, {1, 1, 1}), refused);
  EXPECT_EQ(said({0, 0, 0}, {1, 1, kNaN}), refused);
  EXPECT_EQ(said({1, 0, 0}, {0, 1, 1}), refused);
}

TEST(Detect, of_a_model_with_itself_builds_its_tree_once) {
  // Far apart: nothing but trees takes memory.
  std::vector<Ball> apart;
  for (int i = 0; i < 4000; ++i) apart.push_back({{10.0 * i, 0, 0}, 1});
  const auto a = spheres("a", apart);
  const auto b = spheres("b", apart);
  const DiscreteIntersection component;
  const auto taken_by = [](const std::function<void()>& work) {
    const std::size_t before = component::bytes_allocated();
    work();
    return component::bytes_allocated() - before;
  };
  const std::size_t one = taken_by([&] { EXPECT_TRUE(detect(component, a)->empty()); });
  const std::size_t two = taken_by([&] { (void)detect(component, a, b); });
  EXPECT_GT(one, 4000 * sizeof(Ball));
  EXPECT_LT(one, two * 7 / 10);
}

TEST(Detect, begins_and_ends_once_also_where_there_are_no_elements) {
  const Bracketing bracketing;
  DiscreteIntersection component;
  component.intersectors.add<CubeCollisionModel, SphereCollisionModel>(bracketing);
  EXPECT_EQ(detect(component, cubes("c", {}), spheres("s", {}))->size(), 2U);
}

TEST(Detect, of_an_unsupported_or_ignored_pair_is_nothing_which_is_not_the_same_as_no_contact) {
  DiscreteIntersection component;
  component.intersectors.setSink({});
  component.intersectors.ignore<RigidSphereModel, RigidSphereModel>();
  const auto c = cubes("c", {{{0, 0, 0}, {1, 1, 1}}});
  const auto s = spheres("s", {{{0, 0, 0}, 1}});
  const auto far = spheres("far", {{{9, 0, 0}, 1}});
  const auto r = rigid_spheres("r", {{{0, 0, 0}, 1}});
  EXPECT_FALSE(detect(component, c, s).has_value());
  EXPECT_FALSE(detect(component, s, c).has_value());
  EXPECT_FALSE(detect(component, r).has_value());
  ASSERT_TRUE(detect(component, s, far).has_value());
  EXPECT_TRUE(detect(component, s, far)->empty());
}

/// A component of one's own that answers spheres differently.
class Silent : public ProximityIntersection {
 public:
  using ProximityIntersection::computeIntersection;
  using ProximityIntersection::ProximityIntersection;
  int computeIntersection(const Sphere&, const Sphere&, OutputVector&, const Intersection&) const override { return 0; }
};

TEST(Detect, asks_the_methods_of_a_derived_component) {
  const auto first = spheres("first", {{{0, 0, 0}, 1}, {{9, 0, 0}, 1}});
  const auto second = spheres("second", {{{1, 0, 0}, 1}});
  EXPECT_EQ(detect(ProximityIntersection({0, 0}), first, second).value().size(), 1U);
  EXPECT_EQ(detect(Silent({0, 0}), first, second).value().size(), 0U);
}

/// Distances that ProximityIntersection would refuse.
class Careless : public DiscreteIntersection {
 public:
  explicit Careless(Distances distances) : distances_(distances) {}
  [[nodiscard]] double getAlarmDistance() const override { return distances_.alarm; }
  [[nodiscard]] double getContactDistance() const override { return distances_.contact; }

 private:
  Distances distances_;
};

TEST(Detect, refuses_distances_that_are_negative_or_not_finite) {
  const auto s = spheres("s", {{{0, 0, 0}, 1}});
  const auto refused = [&](Distances distances) {
    return what_of<std::invalid_argument>([&] { (void)detect(Careless(distances), s, s); });
  };
  EXPECT_EQ(refused({-1, 0}), "alarm = -1: must not be negative");
  EXPECT_EQ(refused({kInfinity, 0}), "alarm = inf: must be finite");
  EXPECT_EQ(refused({0, -kLeast}), "contact = -5e-324: must not be negative");
  EXPECT_EQ(refused({0, std::numeric_limits<double>::quiet_NaN()}), "contact = nan: must be finite");
  EXPECT_EQ(refused({0, 0}), "");
}

TEST(Detect, does_not_depend_on_addresses) {
  for (const Scene& scene : scenes(11)) {
    const ProximityIntersection component(scene.distances);
    // The same two models in one array, in both orders: what lies lower once lies higher the next time.
    std::vector<SphereCollisionModel> up{spheres("first", scene.first), spheres("second", scene.second)};
    std::vector<SphereCollisionModel> down{spheres("second", scene.second), spheres("first", scene.first)};
    EXPECT_EQ(text(*detect(component, up[0], up[1])), text(*detect(component, down[1], down[0]))) << scene.name;
  }
}

}  // namespace
}  // namespace contact
