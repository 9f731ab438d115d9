// Capsules, rays and triangles, and spheres against solid cubes, as they join at run time: detection between whole
// models finds what the exact oracle finds over all pairs.
#include "contact/shape_intersectors.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "component/expected_for_tests.hpp"
#include "component/models_for_tests.hpp"
#include "contact/capsule_capsule.hpp"
#include "contact/detect.hpp"
#include "extreme_numbers.hpp"

namespace contact {
namespace {

using component::capsules;
using component::cubes;
using component::every_intersector;
using component::expected_contact;
using component::expected_swapped;
using component::lines;
using component::planes;
using component::rays;
using component::rigid_spheres;
using component::spheres;
using component::text;
using component::triangles;

/// Shapes of every kind in one place, and the distances to detect with.
struct Place {
  std::string name;
  std::vector<Ball> balls;
  std::vector<Capsule> bars;
  std::vector<Capsule> rods;
  std::vector<Box> boxes;
  std::vector<Triangle> faces;
  std::vector<Ray> beams;
  std::vector<Plane> floors;
  std::vector<Line> edges;
  Distances distances;
};

/// `reach` is how long capsules are, and how large radii and boxes.
Place place(std::string name, int count, Distances distances, const std::function<double()>& number,
            const std::function<double()>& reach) {
  Place made{std::move(name), {}, {}, {}, {}, {}, {}, {}, {}, distances};
  const auto vector = [](const auto& next) {
    const double x = next();
    const double y = next();
    const double z = next();
    return Vector3(x, y, z);
  };
  const auto finite_sum = [](const Vector3& a, const Vector3& b) -> Vector3 {
    return (a + b).cwiseMin(kLargest).cwiseMax(-kLargest);
  };
  for (int i = 0; i < count; ++i) {
    made.balls.push_back({vector(number), std::abs(reach())});
    for (auto* some : {&made.bars, &made.rods}) {
      const Vector3 start = vector(number);
      some->push_back({start, i % 7 == 0 ? start : finite_sum(start, vector(reach)), std::abs(reach()) / 2});
    }
    const Vector3 min = vector(number);
    made.boxes.push_back({min, finite_sum(min, vector(reach).cwiseAbs())});
    const Vector3 first = vector(number);
    made.faces.push_back(
        {{first, finite_sum(first, vector(reach)), i % 5 == 0 ? first : finite_sum(first, vector(reach))}});
    Vector3 direction = vector(reach) / 2;
    if (direction.isZero(0)) direction[i % 3] = 1;
    made.beams.push_back({vector(number), direction, i % 6 == 0 ? 0.0 : i % 6 / 2.0});
    // A floor or a wall, or at a slant; most of what there is lies above it.
    Vector3 normal = Vector3::Zero();
    normal[i % 3] = i % 2 == 0 ? 1 : -2;
    if (i % 4 == 3) normal += Vector3::Constant(0.5);
    made.floors.push_back({normal, -std::abs(number())});
    const Vector3 edge = vector(number);
    made.edges.push_back({edge, i % 8 == 0 ? edge : finite_sum(edge, vector(reach))});
  }
  return made;
}

std::vector<Place> places(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto signed_unit = [&] { return std::ldexp(static_cast<double>(static_cast<std::int64_t>(random())), -63); };
  const auto integer = [&](int limit) {
    return static_cast<double>(static_cast<int>(random() % static_cast<unsigned>(2 * limit + 1)) - limit);
  };
  const auto finite = [&] {
    const auto x = std::bit_cast<double>(random());
    return std::isfinite(x) ? x : signed_unit();
  };
  return {
      place(
          "sparse", 16, {0.1, 0.05}, [&] { return 1.5 * signed_unit(); }, signed_unit),
      place("long and thin", 12, {0, 0}, signed_unit, [&] { return (random() & 1) != 0 ? 4 * signed_unit() : 0.125; }),
      // Parallel, crossing and touching ones, and centres on axes and faces.
      place(
          "a small grid", 16, {0.5, 0.25}, [&] { return integer(3); }, [&] { return integer(1); }),
      place(
          "a subnormal grid", 12, {kLeast, 0}, [&] { return kLeast * integer(6); },
          [&] { return kLeast * integer(3); }),
      place(
          "near the largest finite number", 12, {0, 1}, [&] { return kLargest * signed_unit(); },
          [&] { return kLargest * signed_unit(); }),
      place("raw bits", 8, {std::abs(finite()), std::abs(finite())}, finite, finite),
      place("empty", 0, {1, 0}, signed_unit, signed_unit),
  };
}

/// All pairs put to `ask`, in the order that detect documents. `shape` gives the shape of each element.
template <class Shape1, class Shape2, class Ask>
std::vector<std::string> expected_of_all(const CollisionModel& model1, const std::vector<Shape1>& shapes1,
                                         const CollisionModel& model2, const std::vector<Shape2>& shapes2,
                                         Distances distances, Ask ask) {
  OutputVector contacts;
  const bool self = &model1 == &model2;
  for (std::size_t i = 0; i < shapes1.size(); ++i)
    for (std::size_t j = self ? i + 1 : 0; j < shapes2.size(); ++j)
      if (const auto contact =
              ask({model1, static_cast<Index>(i)}, shapes1[i], {model2, static_cast<Index>(j)}, shapes2[j], distances))
        contacts.push_back(*contact);
  return text(contacts);
}

/// What detection finds is what the oracle finds: for these two models in this order and in the other.
template <class Shape1, class Shape2>
std::size_t expect_all(const Intersection& intersection, const CollisionModel& model1,
                       const std::vector<Shape1>& shapes1, const CollisionModel& model2,
                       const std::vector<Shape2>& shapes2, Distances distances) {
  const auto expected = expected_of_all(model1, shapes1, model2, shapes2, distances, expected_contact<Shape1, Shape2>);
  EXPECT_EQ(text(detect(intersection, model1, model2).value()), expected);
  if constexpr (!std::is_same_v<Shape1, Shape2>) {
    EXPECT_EQ(text(detect(intersection, model2, model1).value()),
              expected_of_all(model2, shapes2, model1, shapes1, distances, expected_swapped<Shape2, Shape1>));
  }
  return expected.size();
}

TEST(ShapeIntersectors, find_what_the_oracle_finds_over_all_pairs_of_every_kind_in_either_order) {
  std::size_t contacts = 0;
  std::size_t crossings = 0;
  std::size_t pairs = 0;
  for (const std::uint64_t seed : {1U, 2U})
    for (const Place& at : places(seed)) {
      SCOPED_TRACE(at.name + ", seed " + std::to_string(seed));
      const ProximityIntersection intersection(at.distances, PointConvention::nearest_surface, every_intersector());
      const auto bars = capsules("bars", at.bars);
      const auto rods = capsules("rods", at.rods);
      const auto deformable = spheres("deformable", at.balls);
      const auto rigid = rigid_spheres("rigid", at.balls);
      const auto boxes = cubes("boxes", at.boxes);
      contacts += expect_all(intersection, bars, at.bars, rods, at.rods, at.distances);
      contacts += expect_all(intersection, deformable, at.balls, rods, at.rods, at.distances);
      contacts += expect_all(intersection, rigid, at.balls, rods, at.rods, at.distances);
      contacts += expect_all(intersection, deformable, at.balls, boxes, at.boxes, at.distances);
      contacts += expect_all(intersection, rigid, at.balls, boxes, at.boxes, at.distances);
      const auto faces = triangles("faces", at.faces);
      const auto beams = rays("beams", at.beams);
      contacts += expect_all(intersection, deformable, at.balls, faces, at.faces, at.distances);
      contacts += expect_all(intersection, rigid, at.balls, faces, at.faces, at.distances);
      contacts += expect_all(intersection, beams, at.beams, deformable, at.balls, at.distances);
      contacts += expect_all(intersection, beams, at.beams, rigid, at.balls, at.distances);
      const auto floors = planes("floors", at.floors);
      contacts += expect_all(intersection, deformable, at.balls, floors, at.floors, at.distances);
      contacts += expect_all(intersection, rigid, at.balls, floors, at.floors, at.distances);
      contacts += expect_all(intersection, bars, at.bars, floors, at.floors, at.distances);
      const auto edges = lines("edges", at.edges);
      crossings += expect_all(intersection, faces, at.faces, edges, at.edges, at.distances);
      crossings += expect_all(intersection, beams, at.beams, faces, at.faces, at.distances);
      expect_all(intersection, bars, at.bars, bars, at.bars, at.distances);
      pairs += 12 * at.balls.size() * at.balls.size();
    }
  EXPECT_GT(contacts, pairs / 10);
  EXPECT_GT(crossings, 10U);
  EXPECT_LT(contacts, pairs / 2);
}

TEST(ShapeIntersectors, lose_no_contact_among_many_capsules_of_every_length) {
  std::mt19937_64 random(9);
  const auto unit = [&] { return std::ldexp(static_cast<double>(random() >> 11), -53); };
  const auto many = [&] {
    std::vector<Capsule> all;
    for (int i = 0; i < 600; ++i) {
      const Vector3 start = 3 * Vector3(unit(), unit(), unit());
      const double length = i % 10 == 0 ? 3 : 0.25;
      all.push_back({start, start + length * (2 * Vector3(unit(), unit(), unit()) - Vector3::Ones()), 0.1 * unit()});
    }
    return all;
  };
  const std::vector<Capsule> first = many();
  const std::vector<Capsule> second = many();
  const Distances distances{0.125, 0.0625};
  const auto model1 = capsules("first", first);
  const auto model2 = capsules("second", second);
  const auto compute = [](const CollisionElement& e1, const Capsule& a, const CollisionElement& e2, const Capsule& b,
                          Distances d) -> std::optional<DetectionOutput> {
    const auto contact = compute_capsule_capsule(a, b, d);
    if (!contact) return std::nullopt;
    return DetectionOutput{.elem = {e1, e2},
                           .id = e2.getIndex(),  // the models are of one size
                           .point = {contact->point1, contact->point2},
                           .normal = contact->normal,
                           .value = contact->value};
  };
  const auto expected = expected_of_all(model1, first, model2, second, distances, compute);
  EXPECT_EQ(text(*detect(ProximityIntersection(distances), model1, model2)), expected);
  EXPECT_EQ(text(*detect(ProximityIntersection(distances), model1)),
            expected_of_all(model1, first, model1, first, distances, compute));
  EXPECT_GT(expected.size(), 2000U);
  EXPECT_LT(expected.size(), 60000U);
}

/// The one contact of two models of one element each.
DetectionOutput only_contact(const CollisionModel& model1, const CollisionModel& model2, Distances distances,
                             PointConvention points = PointConvention::nearest_surface) {
  return detect(ProximityIntersection(distances, points, every_intersector()), model1, model2)->at(0);
}

void expect_numbers(const DetectionOutput& contact, const Vector3& normal, const Vector3& point1, const Vector3& point2,
                    double value) {
  EXPECT_EQ(contact.normal, normal) << contact.normal.transpose();
  EXPECT_EQ(contact.point[0], point1) << contact.point[0].transpose();
  EXPECT_EQ(contact.point[1], point2) << contact.point[1].transpose();
  EXPECT_EQ(contact.value, value);
}

// (1,3,0) projects to (1,0,0) on the axis from the origin to (4,0,0), a distance of 3 = 1 + 1.5 + 0.5.
TEST(ShapeIntersectors, follow_the_point_convention_where_only_a_rigid_sphere_has_another_under_center) {
  const auto bar = capsules("bar", {{{0, 0, 0}, {4, 0, 0}, 1}});
  const auto sphere = spheres("sphere", {{{1, 3, 0}, 1.5}});
  const auto rigid = rigid_spheres("rigid", {{{1, 3, 0}, 1.5}});
  const Distances near{0.5, 0.25};
  using enum PointConvention;
  for (const CollisionModel* ball :
       {static_cast<const CollisionModel*>(&sphere), static_cast<const CollisionModel*>(&rigid)}) {
    expect_numbers(only_contact(*ball, bar, near), {0, -1, 0}, {1, 1.5, 0}, {1, 1, 0}, 0.25);
    expect_numbers(only_contact(bar, *ball, near), {0, 1, 0}, {1, 1, 0}, {1, 1.5, 0}, 0.25);
    expect_numbers(only_contact(*ball, bar, near, published), {0, -1, 0}, {1, 4.5, 0}, {1, -1, 0}, 0.25);
  }
  expect_numbers(only_contact(sphere, bar, near, center), {0, -1, 0}, {1, 3, 0}, {1, 0, 0}, 0.25);
  expect_numbers(only_contact(rigid, bar, near, center), {0, -1, 0}, {1, 1.5, 0}, {1, 0, 0}, 0.25);
  const auto rod = capsules("rod", {{{1, 3, -1}, {1, 3, 1}, 1.5}});
  expect_numbers(only_contact(bar, rod, near), {0, 1, 0}, {1, 1, 0}, {1, 1.5, 0}, 0.25);
  expect_numbers(only_contact(bar, rod, near, center), {0, 1, 0}, {1, 0, 0}, {1, 3, 0}, 0.25);
  expect_numbers(only_contact(bar, rod, near, published), {0, 1, 0}, {1, -1, 0}, {1, 4.5, 0}, 0.25);
  const auto box = cubes("box", {{{0, -2, -2}, {4, 1, 2}}});  // its face y = 1 is where the capsule's surface was
  for (const PointConvention points : {nearest_surface, center, published}) {
    const double y = points == nearest_surface ? 1.5 : points == center ? 3 : 4.5;
    expect_numbers(only_contact(sphere, box, near, points), {0, -1, 0}, {1, y, 0}, {1, 1, 0}, 0.25);
    expect_numbers(only_contact(rigid, box, near, points), {0, -1, 0}, {1, points == center ? 1.5 : y, 0}, {1, 1, 0},
                   0.25);
  }
}

// Questions that SOFA's capsule plug-in answers otherwise: docs/sofa-map.md.
TEST(ShapeIntersectors, find_the_nearest_points_that_sofas_capsules_miss) {
  // The foot of (1,0,0) on the second axis is its middle, (1.5,1.5,0): D = 2.5 < (1.5 + 0.125)^2; SOFA finds D = 5.
  const auto bar = capsules("bar", {{{0, 0, 0}, {1, 0, 0}, 0.75}});
  const auto rod = capsules("rod", {{{3, 1, 0}, {0, 2, 0}, 0.75}});
  const DetectionOutput contact = only_contact(bar, rod, {0.125, 0}, PointConvention::center);
  EXPECT_EQ(contact.point[0], Vector3(1, 0, 0));
  EXPECT_EQ(contact.point[1], Vector3(1.5, 1.5, 0));
  // A capsule of length 0 is a ball: 3-4-5 between its centre and the end (1,0,0).
  const auto drop = capsules("drop", {{{4, 4, 0}, {4, 4, 0}, 4.25}});
  expect_numbers(only_contact(bar, drop, {0, 0}, PointConvention::center), {0.6, 0.8, 0}, {1, 0, 0}, {4, 4, 0}, 0);
  // As the first, too: its only point is 1 from the foot on a bar from (0,0,0) to (4,0,0); SOFA takes the bar's end.
  const auto dot = capsules("dot", {{{1, 1, 0}, {1, 1, 0}, 0.5}});
  const auto long_bar = capsules("long bar", {{{0, 0, 0}, {4, 0, 0}, 0.5}});
  expect_numbers(only_contact(dot, long_bar, {0, 0}), {0, -1, 0}, {1, 0.5, 0}, {1, 0.5, 0}, 0);
  // Axes at a right angle, 2^-14 long, 2^-10 apart along z: parallel by a determinant of 2^-56.
  constexpr double kLength = 0x1p-14;
  const auto thin = capsules("thin", {{{0, 0, 0}, {kLength, 0, 0}, 0}});
  const auto across = capsules("across", {{{kLength / 4, -kLength / 4, 0x1p-10}, {kLength / 4, kLength, 0x1p-10}, 0}});
  expect_numbers(only_contact(thin, across, {1, 0}), {0, 0, 1}, {kLength / 4, 0, 0}, {kLength / 4, 0, 0x1p-10},
                 0x1p-10);
  // The foot is 2^-21 of the length from an end, which SOFA takes for the end: D = 10, where 9 is a hit.
  const auto end = capsules("end", {{{0, 0, 0}, {0x1p21, 0, 0}, 1}});
  const auto ball = spheres("ball", {{{1, 3, 0}, 2}});
  expect_numbers(only_contact(ball, end, {0, 0}), {0, -1, 0}, {1, 1, 0}, {1, 1, 0}, 0);
}

// What SOFA's rays and triangles answer otherwise: docs/sofa-map.md.
TEST(ShapeIntersectors, find_what_sofas_rays_and_triangles_miss) {
  // Past the end, but within the radius of it.
  const auto beam = rays("beam", {{{0, 0, 0}, {1, 0, 0}, 1}});
  const auto ahead = spheres("ahead", {{{1.5, 0, 0}, 0.75}});
  expect_numbers(only_contact(beam, ahead, {0, 0}), {1, 0, 0}, {1, 0, 0}, {0.75, 0, 0}, -0.25);
  // A direction that is no unit vector: the ray ends at 4, not at 2.
  const auto twice = rays("twice", {{{0, 0, 0}, {2, 0, 0}, 2}});
  const auto far = rigid_spheres("far", {{{7, 0, -4}, 5}});
  expect_numbers(only_contact(twice, far, {0, 0}), {0.6, 0, -0.8}, {4, 0, 0}, {4, 0, 0}, 0);
  // Beside an edge and beside a vertex, and within an alarm distance.
  const auto face = triangles("face", {{{Vector3(0, 0, 0), Vector3(4, 0, 0), Vector3(0, 4, 0)}}});
  const auto edge = spheres("edge", {{{2, -3, 4}, 5}});
  expect_numbers(only_contact(edge, face, {0, 0}), {0, 0.6, -0.8}, {2, 0, 0}, {2, 0, 0}, 0);
  const auto vertex = spheres("vertex", {{{7, 0, 4}, 4.5}});
  expect_numbers(only_contact(vertex, face, {0.5, 0.25}), {-0.6, 0, -0.8}, {4.3, 0, 0.4}, {4, 0, 0}, 0.25);
}

// SOFA's determinant of these is 2^-57, which it takes for 0; and a line that only reaches a triangle crosses it.
TEST(ShapeIntersectors, cross_triangles_of_every_size_at_their_boundary_too) {
  constexpr double kSize = 0x1p-19;
  const auto face = triangles("face", {{{Vector3(0, 0, 0), Vector3(kSize, 0, 0), Vector3(0, kSize, 0)}}});
  const auto edge = lines("edge", {{{kSize / 4, kSize / 4, kSize}, {kSize / 4, kSize / 4, 0}}});
  expect_numbers(only_contact(face, edge, {0, 0}), {0, 0, 1}, {kSize / 4, kSize / 4, 0}, {kSize / 4, kSize / 4, 0}, 0);
  expect_numbers(only_contact(edge, face, {0, 0}), {0, 0, -1}, {kSize / 4, kSize / 4, 0}, {kSize / 4, kSize / 4, 0}, 0);
  const auto beam = rays("beam", {{{kSize / 2, kSize / 2, -kSize}, {0, 0, kSize / 2}, 2}});
  expect_numbers(only_contact(beam, face, {4, 2}), {0, 0, -1}, {kSize / 2, kSize / 2, 0}, {kSize / 2, kSize / 2, 0}, 0);
}

TEST(ShapeIntersectors, of_one_model_meet_at_a_joint) {
  const auto chain = capsules("chain", {{{0, 0, 0}, {2, 0, 0}, 0.25}, {{2, 0, 0}, {2, 2, 0}, 0.25}});
  const auto contacts = detect(DiscreteIntersection(), chain);
  ASSERT_EQ(contacts->size(), 1U);  // u x v = (0,0,4)
  expect_numbers(contacts->front(), {0, 0, 1}, {2, 0, 0.25}, {2, 0, -0.25}, -0.5);
}

TEST(ShapeIntersectors,
     of_capsules_are_in_every_component_made_with_the_instance_of_the_factory_and_those_of_cubes_not) {
  const auto bar = capsules("bar", {{{0, 0, 0}, {1, 0, 0}, 1}});
  const auto box = cubes("box", {{{0, 0, 0}, {1, 1, 1}}});
  const auto sphere = spheres("sphere", {{{0, 0, 0}, 1}});
  const auto rigid = rigid_spheres("rigid", {{{0, 0, 0}, 1}});
  DiscreteIntersection component;
  const IntersectorFactory none;
  DiscreteIntersection bare(PointConvention::nearest_surface, none);
  DiscreteIntersection solid(PointConvention::nearest_surface, every_intersector());
  component.intersectors.setSink({});
  bare.intersectors.setSink({});
  solid.intersectors.setSink({});
  for (const CollisionModel* other :
       {static_cast<const CollisionModel*>(&bar), static_cast<const CollisionModel*>(&sphere),
        static_cast<const CollisionModel*>(&rigid)}) {
    EXPECT_TRUE(component.isSupported({bar, 0}, {*other, 0}));
    EXPECT_TRUE(component.isSupported({*other, 0}, {bar, 0}));
    EXPECT_FALSE(bare.isSupported({bar, 0}, {*other, 0}));
    EXPECT_FALSE(component.isSupported({*other, 0}, {box, 0}));
    EXPECT_EQ(solid.isSupported({*other, 0}, {box, 0}), other != &bar);
    EXPECT_EQ(solid.isSupported({box, 0}, {*other, 0}), other != &bar);
  }
}

TEST(ShapeIntersectors, test_as_they_compute_and_take_the_distances_from_the_current_intersection) {
  DiscreteIntersection component;
  const CapsuleDiscreteIntersection intersector(component);
  const auto bar = capsules("bar", {{{0, 0, 0}, {4, 0, 0}, 1}});
  const auto sphere = spheres("sphere", {{{1, 3, 0}, 1.5}});
  const Sphere ball(sphere, 0);
  const CapsuleElement capsule(bar, 0);
  for (const double alarm : {0.0, below(0.5), 0.5, above(0.5)}) {
    const ProximityIntersection current({alarm, 0.25});
    OutputVector contacts;
    EXPECT_EQ(intersector.testIntersection(ball, capsule, current), alarm >= 0.5);
    EXPECT_EQ(intersector.computeIntersection(ball, capsule, contacts, current), alarm >= 0.5 ? 1 : 0);
    EXPECT_EQ(contacts.size(), alarm >= 0.5 ? 1U : 0U);
  }
}

}  // namespace
}  // namespace contact
