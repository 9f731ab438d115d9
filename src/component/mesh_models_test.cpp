// The models of triangles, rays, lines and planes: data in and out, bounding boxes, and every refusal word for word.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "component/models_for_tests.hpp"
#include "environment/floating_point_environments.hpp"
#include "extreme_numbers.hpp"
#include "oracle/truth/exact.hpp"

namespace contact {
namespace {

using component::lines;
using component::planes;
using component::rays;
using component::refusal;
using component::triangles;

const Triangle kTriangle{{Vector3(0, 1, 2), Vector3(3, -4, 5), Vector3(-6, 7, 0)}};

TEST(TriangleModel, gives_back_what_it_was_given_and_moves_it) {
  auto model = triangles("t", {kTriangle, {{Vector3::Zero(), Vector3::Zero(), Vector3::Zero()}}});
  EXPECT_EQ(model.getSize(), 2);
  const TriangleElement triangle(model, 0);
  EXPECT_EQ(triangle.p1(), Vector3(0, 1, 2));
  EXPECT_EQ(triangle.p2(), Vector3(3, -4, 5));
  EXPECT_EQ(triangle.p3(), Vector3(-6, 7, 0));
  EXPECT_EQ(model.bounding_box(0).min, Vector3(-6, -4, 0));
  EXPECT_EQ(model.bounding_box(0).max, Vector3(3, 7, 5));
  const Eigen::MatrixX3d ones = Eigen::MatrixX3d::Ones(2, 3);
  model.setVertices(ones, 2 * ones, 3 * ones);
  EXPECT_EQ(model.triangle(1).vertices[2], Vector3(3, 3, 3));
}

TEST(TriangleModel, refuses_what_is_outside_the_domain_and_names_it) {
  const auto refused = [](std::size_t vertex, int axis, double x) {
    Triangle bad = kTriangle;
    bad.vertices[vertex][axis] = x;
    return refusal([&] { (void)triangles("skin", {kTriangle, bad}); });
  };
  EXPECT_EQ(refused(0, 1, kNaN), "TriangleCollisionModel \"skin\": p1[1][1] = nan: must be finite");
  EXPECT_EQ(refused(1, 0, kInfinity), "TriangleCollisionModel \"skin\": p2[1][0] = inf: must be finite");
  EXPECT_EQ(refused(2, 2, -kInfinity), "TriangleCollisionModel \"skin\": p3[1][2] = -inf: must be finite");
  const Eigen::MatrixX3d one = Eigen::MatrixX3d::Ones(1, 3);
  const Eigen::MatrixX3d two = Eigen::MatrixX3d::Ones(2, 3);
  EXPECT_EQ(refusal([&] { (void)TriangleCollisionModel("skin", two, one, two); }),
            "TriangleCollisionModel \"skin\": number of p2 = 1: must be that of p1, 2");
  EXPECT_EQ(refusal([&] { (void)TriangleCollisionModel("skin", two, two, one); }),
            "TriangleCollisionModel \"skin\": number of p3 = 1: must be that of p1, 2");
  auto model = triangles("skin", {kTriangle});
  EXPECT_EQ(refusal([&] { model.setVertices(two, two, two); }),
            "TriangleCollisionModel \"skin\": number of p1 = 2: must be that of triangles, 1");
  EXPECT_EQ(model.triangle(0).vertices[0], kTriangle.vertices[0]);
}

TEST(RayModel, gives_back_what_it_was_given_and_turns_it) {
  auto model = rays("r", {{{0, 1, 2}, {3, 4, 5}, 6}, {{-1, -2, -3}, {0, kLeast, 0}, 0}});
  EXPECT_EQ(model.getSize(), 2);
  const RayElement ray(model, 0);
  EXPECT_EQ(ray.origin(), Vector3(0, 1, 2));
  EXPECT_EQ(ray.direction(), Vector3(3, 4, 5));
  EXPECT_EQ(ray.l(), 6);
  const Eigen::MatrixX3d ones = Eigen::MatrixX3d::Ones(2, 3);
  model.setRays(ones, -ones);
  EXPECT_EQ(model.ray(0).direction, Vector3(-1, -1, -1));
  EXPECT_EQ(model.ray(0).length, 6);
}

TEST(RayModel, refuses_what_is_outside_the_domain_and_names_it) {
  const auto refused = [](const Ray& second) {
    return refusal([&] { (void)rays("beam", {{{0, 0, 0}, {1, 0, 0}, 1}, second}); });
  };
  EXPECT_EQ(refused({{0, kNaN, 0}, {1, 0, 0}, 1}), "RayCollisionModel \"beam\": origins[1][1] = nan: must be finite");
  EXPECT_EQ(refused({{0, 0, 0}, {1, 0, kInfinity}, 1}),
            "RayCollisionModel \"beam\": directions[1][2] = inf: must be finite");
  EXPECT_EQ(refused({{0, 0, 0}, {0, -0.0, 0}, 1}),
            "RayCollisionModel \"beam\": directions[1] = 0: must not be the zero vector");
  EXPECT_EQ(refused({{0, 0, 0}, {1, 0, 0}, -1}), "RayCollisionModel \"beam\": lengths[1] = -1: must not be negative");
  const Eigen::MatrixX3d one = Eigen::MatrixX3d::Ones(1, 3);
  const Eigen::MatrixX3d two = Eigen::MatrixX3d::Ones(2, 3);
  EXPECT_EQ(refusal([&] { (void)RayCollisionModel("beam", two, one, Eigen::VectorXd::Ones(2)); }),
            "RayCollisionModel \"beam\": number of directions = 1: must be that of origins, 2");
  EXPECT_EQ(refusal([&] { (void)RayCollisionModel("beam", two, two, Eigen::VectorXd::Ones(1)); }),
            "RayCollisionModel \"beam\": number of lengths = 1: must be that of origins, 2");
  auto model = rays("beam", {{{0, 0, 0}, {1, 0, 0}, 1}});
  EXPECT_EQ(refusal([&] { model.setRays(two, two); }),
            "RayCollisionModel \"beam\": number of origins = 2: must be that of lengths, 1");
  EXPECT_EQ(model.ray(0).origin, Vector3(0, 0, 0));
}

TEST(RayModel, its_bounding_boxes_contain_the_rays_and_not_much_more_in_every_rounding_mode) {
  std::mt19937_64 random(5);
  const auto number = [&](int exponent) {
    return std::ldexp(static_cast<double>(static_cast<std::int64_t>(random())), exponent - 63);
  };
  std::vector<Ray> all{{{kLargest, 0, 0}, {-kLargest, kLargest, kLeast}, kLargest},
                       {{kLargest, -kLargest, 0}, {1, -1, kLeast}, kLargest},
                       {{0, 0, 0}, {kLeast, -kLeast, 0}, kLeast},
                       {{1, 2, 3}, {kLargest, 1, 1}, 0}};
  for (const int exponent : {-1040, -20, 0, 500})
    for (int i = 0; i < 20; ++i)
      all.push_back({{number(exponent), number(exponent), number(exponent)},
                     {number(exponent), number(exponent - 40), number(0)},
                     std::abs(number(i))});
  const auto model = rays("r", all);
  for (const auto& environment : floating_point_environments())
    for (Index i = 0; i < model.getSize(); ++i) {
      Box box;
      in_environment(environment, [&] { box = model.bounding_box(i); });
      const Ray& ray = all[static_cast<std::size_t>(i)];
      for (int axis = 0; axis < 3; ++axis) {
        using oracle::Rational;
        const Rational origin(ray.origin[axis]);
        const Rational way = Rational(ray.length) * Rational(ray.direction[axis]);
        const Rational end = origin + way;
        const Rational low = std::min(origin, end);
        const Rational high = std::max(origin, end);
        const Rational margin =
            (CGAL::abs(origin) + CGAL::abs(way)) * oracle::power_of_two(-48) + oracle::power_of_two(-999);
        EXPECT_TRUE(box.min[axis] == -kInfinity || Rational(box.min[axis]) <= low) << i << ", " << environment.name;
        EXPECT_TRUE(box.max[axis] == kInfinity || Rational(box.max[axis]) >= high) << i << ", " << environment.name;
        EXPECT_TRUE(box.min[axis] == -kInfinity ? low <= Rational(-kLargest) * (1 - oracle::power_of_two(-40))
                                                : low - Rational(box.min[axis]) <= margin);
        EXPECT_TRUE(box.max[axis] == kInfinity ? high >= Rational(kLargest) * (1 - oracle::power_of_two(-40))
                                               : Rational(box.max[axis]) - high <= margin);
      }
    }
}

TEST(LineModel, gives_back_what_it_was_given_and_moves_it) {
  auto model = lines("l", {{{0, 1, 2}, {3, -4, 5}}, {{0, 0, 0}, {0, 0, 0}}});
  EXPECT_EQ(model.getSize(), 2);
  EXPECT_EQ(LineElement(model, 0).p1(), Vector3(0, 1, 2));
  EXPECT_EQ(LineElement(model, 0).p2(), Vector3(3, -4, 5));
  EXPECT_EQ(model.bounding_box(0).min, Vector3(0, -4, 2));
  EXPECT_EQ(model.bounding_box(0).max, Vector3(3, 1, 5));
  model.setEnds(Eigen::MatrixX3d::Ones(2, 3), Eigen::MatrixX3d::Zero(2, 3));
  EXPECT_EQ(model.line(1).start, Vector3(1, 1, 1));
}

TEST(LineModel, refuses_what_is_outside_the_domain_and_names_it) {
  EXPECT_EQ(refusal([] {
              (void)lines("cut", {{{0, kNaN, 0}, {1, 1, 1}}});
            }),
            "LineCollisionModel \"cut\": p1[0][1] = nan: must be finite");
  EXPECT_EQ(refusal([] {
              (void)lines("cut", {{{0, 0, 0}, {1, 1, -kInfinity}}});
            }),
            "LineCollisionModel \"cut\": p2[0][2] = -inf: must be finite");
  const Eigen::MatrixX3d two = Eigen::MatrixX3d::Ones(2, 3);
  EXPECT_EQ(refusal([&] { (void)LineCollisionModel("cut", two, Eigen::MatrixX3d::Ones(1, 3)); }),
            "LineCollisionModel \"cut\": number of p2 = 1: must be that of p1, 2");
  auto model = lines("cut", {{{0, 0, 0}, {1, 1, 1}}});
  EXPECT_EQ(refusal([&] { model.setEnds(two, two); }),
            "LineCollisionModel \"cut\": number of p1 = 2: must be that of lines, 1");
  EXPECT_EQ(model.line(0).end, Vector3(1, 1, 1));
}

TEST(PlaneModel, gives_back_what_it_was_given_and_moves_it) {
  auto model = planes("p", {{{0, 0, 2}, 4}, {{-1, 3, 0}, -5}});
  EXPECT_EQ(model.getSize(), 2);
  EXPECT_EQ(PlaneElement(model, 1).normal(), Vector3(-1, 3, 0));
  EXPECT_EQ(PlaneElement(model, 1).offset(), -5);
  model.setPlanes(Eigen::MatrixX3d::Ones(2, 3), Eigen::VectorXd::Constant(2, 7));
  EXPECT_EQ(model.plane(0).normal, Vector3(1, 1, 1));
  EXPECT_EQ(model.plane(0).offset, 7);
}

TEST(PlaneModel, refuses_what_is_outside_the_domain_and_names_it) {
  const auto refused = [](const Plane& second) {
    return refusal([&] { (void)planes("floor", {{{0, 0, 1}, 0}, second}); });
  };
  EXPECT_EQ(refused({{0, kNaN, 0}, 1}), "PlaneCollisionModel \"floor\": normals[1][1] = nan: must be finite");
  EXPECT_EQ(refused({{0, -0.0, 0}, 1}), "PlaneCollisionModel \"floor\": normals[1] = 0: must not be the zero vector");
  EXPECT_EQ(refused({{0, 1, 0}, -kInfinity}), "PlaneCollisionModel \"floor\": offsets[1][0] = -inf: must be finite");
  const Eigen::MatrixX3d two = Eigen::MatrixX3d::Ones(2, 3);
  EXPECT_EQ(refusal([&] { (void)PlaneCollisionModel("floor", two, Eigen::VectorXd::Ones(1)); }),
            "PlaneCollisionModel \"floor\": number of offsets = 1: must be that of normals, 2");
  auto model = planes("floor", {{{0, 0, 1}, 0}});
  EXPECT_EQ(refusal([&] { model.setPlanes(two, Eigen::VectorXd::Ones(2)); }),
            "PlaneCollisionModel \"floor\": number of normals = 2: must be that of planes, 1");
  EXPECT_EQ(model.plane(0).normal, Vector3(0, 0, 1));
}

TEST(PlaneModel, its_bounding_boxes_end_where_a_plane_along_the_axes_does_in_every_rounding_mode) {
  std::vector<Plane> all{{{0, 0, 3}, 1},
                         {{0, -3, 0}, 1},
                         {{kLeast, 0, 0}, kLargest},
                         {{kLeast, 0, 0}, -kLargest},
                         {{-kLeast, 0, 0}, kLargest},
                         {{-kLeast, 0, 0}, -kLargest},
                         {{0, kLargest, 0}, kLeast},
                         {{0, -kLargest, 0}, kLeast},
                         {{0, 0, 7}, 0},
                         {{1, 1, 0}, 5}};
  const auto model = planes("p", all);
  for (const auto& environment : floating_point_environments())
    for (Index i = 0; i < model.getSize(); ++i) {
      Box box;
      in_environment(environment, [&] { box = model.bounding_box(i); });
      const Plane& plane = all[static_cast<std::size_t>(i)];
      const bool along_axis = (plane.normal.array() != 0).count() == 1;
      for (int axis = 0; axis < 3; ++axis) {
        using oracle::Rational;
        const double n = plane.normal[axis];
        const bool bounded = along_axis && n != 0;
        EXPECT_TRUE((bounded && n < 0) || box.min[axis] == -kInfinity) << i << environment.name;
        EXPECT_TRUE((bounded && n > 0) || box.max[axis] == kInfinity) << i << environment.name;
        if (!bounded) continue;
        const double end = n > 0 ? box.max[axis] : -box.min[axis];  // as if the normal went up
        const Rational at = Rational(plane.offset) / CGAL::abs(Rational(n));
        const Rational margin = CGAL::abs(at) * oracle::power_of_two(-48) + oracle::power_of_two(-999);
        if (end == kInfinity) {
          EXPECT_GT(at + margin, Rational(kLargest)) << i << environment.name;
        } else {
          EXPECT_GE(Rational(end), at) << i << environment.name;
          EXPECT_TRUE(Rational(end) - at <= margin || end == -kLargest) << i << environment.name;
        }
      }
    }
}

}  // namespace
}  // namespace contact
