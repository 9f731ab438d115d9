// Engines in shared libraries: the rows that they are given.
#include "engines/hosts/library.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace contact::engines {
namespace {

Question question(Pair pair, const Shapes& shapes) { return {"0", {pair, shapes, {0, 0}}}; }

TEST(Library, is_given_rows_as_wide_as_the_largest_hull_which_repeat_the_last_vertex) {
  const auto engine = make_library(CONTACT_TELLING_LIBRARY);
  const Hull point{{{7, 8, 9}}, 0.5};
  const Hull triangle{{{1, 2, 3}, {4, 5, 6}, {-1, -2, -3}}, 0.25};
  const Ball ball{{10, 11, 12}, 13};
  const auto claims = engine->answer(std::vector{
      question(Pair::hull_hull, Convexes{{point}, {triangle}}),
      question(Pair::hull_hull, Convexes{{triangle}, {point}}), question(Pair::sphere_hull, Convexes{{ball}, {point}}),
      question(Pair::sphere_hull, Convexes{{ball}, {Hull{}}}),  // outside the domain
      question(Pair::capsule_plane, CapsuleAndPlane{{{0, 0, 0}, {1, 0, 0}, 1}, {{0, 0, 1}, 0}})});
  ASSERT_EQ(claims.size(), 5U);
  const auto expect = [&](std::size_t i, double width, const Vector3& normal, const Vector3& point1,
                          const Vector3& point2) {
    ASSERT_TRUE(claims[i].contact) << i;
    EXPECT_EQ(claims[i].contact->value, width) << i;
    EXPECT_EQ(claims[i].contact->normal, normal) << i;
    EXPECT_EQ(claims[i].contact->point1, point1) << i;
    EXPECT_EQ(claims[i].contact->point2, point2) << i;
  };
  expect(0, 11, {1, 0.5, 3}, {7, 8, 9}, {-1, -2, -3});
  expect(1, 11, {3, 0.25, 1}, {-1, -2, -3}, {7, 8, 9});
  expect(2, 5, {10, 11, 1}, {11, 12, 13}, {7, 8, 9});
  expect(3, 5, {10, 11, 0}, {11, 12, 13}, {0, 0, 0});
  ASSERT_TRUE(claims[4].contact);
  EXPECT_EQ(claims[4].contact->value, 7);
}

TEST(Library, says_several_points_and_how_many) {
  const auto engine = make_library(CONTACT_TELLING_LIBRARY);
  const auto asked = [](double offset) {
    return question(Pair::sphere_plane, BallAndPlane{{{1, 2, 3}, 4}, {{0, 0, 1}, offset}});
  };
  // As many as the plane's offset, of 3 that are declared.
  const auto claims = engine->answer(std::vector{asked(1), asked(3), asked(0), asked(4), asked(-1)});
  ASSERT_EQ(claims.size(), 5U);
  for (const std::size_t i : {0U, 1U}) {
    ASSERT_TRUE(claims[i].contact) << i;
    const auto& points = claims[i].contact->points;
    ASSERT_EQ(points.size(), i == 0 ? 1U : 3U);
    for (std::size_t k = 0; k < points.size(); ++k) {
      EXPECT_EQ(points[k].at, Vector3(1, 2, static_cast<double>(k)));
      EXPECT_EQ(points[k].depth, static_cast<double>(10 * i + k));
    }
  }
  for (const std::size_t i : {2U, 3U, 4U}) {
    EXPECT_EQ(claims[i].status, Claim::Status::error) << i;
    EXPECT_NE(claims[i].text.find("a contact has 1 to 3 points"), std::string::npos) << claims[i].text;
  }
}

Question over_plane(double offset) {
  return question(Pair::capsule_plane, CapsuleAndPlane{{{0, 0, 0}, {1, 0, 0}, 1}, {{0, 0, 1}, offset}});
}

TEST(Library, that_says_points_of_a_pair_without_a_manifold_is_told_so) {
  const Claim claim = make_library(CONTACT_TELLING_LIBRARY)->answer(std::vector{over_plane(1)}).front();
  EXPECT_EQ(claim.status, Claim::Status::error);
  EXPECT_NE(claim.text.find("no manifold"), std::string::npos) << claim.text;
}

TEST(Library, is_not_asked_about_pairs_that_it_does_not_declare) {
  const Question ray = question(Pair::ray_sphere, RayAndBall{{{0, 0, 0}, {1, 0, 0}, 1}, {{0, 0, 0}, 1}});
  const auto claims = make_library(CONTACT_TELLING_LIBRARY)->answer(std::vector{ray, over_plane(0), ray, ray});
  ASSERT_EQ(claims.size(), 4U);
  for (const std::size_t i : {0U, 2U, 3U}) EXPECT_EQ(claims[i].status, Claim::Status::unsupported) << i;
  EXPECT_EQ(claims[1].status, Claim::Status::answered);
}

TEST(Library, is_asked_by_one_thread_at_a_time) {
  const auto engine = make_library(CONTACT_TELLING_LIBRARY);
  std::vector<int> errors(4);
  std::vector<std::thread> threads;
  for (int& mine : errors)
    threads.emplace_back([&] {
      for (int i = 0; i < 20; ++i)
        if (engine->answer(std::vector{over_plane(0)}).front().status == Claim::Status::error) ++mine;
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(errors, std::vector<int>(4));
}

}  // namespace
}  // namespace contact::engines
