// The component, and the words of the C interface, in every floating-point environment, exceptions unmasked too: they are
// the same, and what traps would end this program.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "component/models_for_tests.hpp"
#include "contact/contact.h"
#include "contact/cube_cube.hpp"
#include "contact/detect.hpp"
#include "contact/discrete_intersection.hpp"
#include "contact/exact_sum.hpp"
#include "contact/model_factory.hpp"
#include "contact/shape_intersectors.hpp"
#include "environment/floating_point_environments.hpp"
#include "extreme_numbers.hpp"

namespace contact {
namespace {

using namespace component;

/// Boxes that meet have a contact, so that detect has something to do.
class TouchingBoxes : public BaseIntersector {
 public:
  static constexpr std::string_view kName = "TouchingBoxes";
  bool testIntersection(const Cube& a, const Cube& b, const Intersection& current) const {
    return test_cube_cube(a.box(), b.box(), current.getAlarmDistance());
  }
  int computeIntersection(const Cube& a, const Cube& b, OutputVector& contacts, const Intersection&) const {
    contacts.push_back(numbered_contact(a, b, 7));
    contacts.back().value = a.box().max[0] - b.box().min[0];  // arithmetic of somebody else's, called by detect
    return 1;
  }
};

std::string lines(const std::optional<OutputVector>& contacts) {
  std::string all;
  for (const std::string& line : text(contacts.value())) all += line + "\n";
  return all;
}

/// The first line that differs, of either.
std::string first_difference(const std::string& a, const std::string& b) {
  std::istringstream lines_a(a);
  std::istringstream lines_b(b);
  std::string line_a;
  std::string line_b;
  while (std::getline(lines_a, line_a), std::getline(lines_b, line_b))
    if (line_a != line_b) break;
  return line_a + "\n" + line_b + "\n";
}

std::string box_text(const Box& box) { return text(box.min) + text(box.max) + "\n"; }

/// All that the component can be asked, of numbers with every exception's occasion.
std::string everything(const std::vector<Ball>& balls, const std::vector<Box>& boxes, Distances distances) {
  std::string said;
  ProximityIntersection component({0, 0});
  const SolidCubeDiscreteIntersection solid_cubes(component);
  component.setAlarmDistance(distances.alarm);
  component.setContactDistance(distances.contact);
  const TouchingBoxes box_contacts;
  component.intersectors.add<CubeCollisionModel, CubeCollisionModel>(box_contacts);
  auto s = spheres("s", balls);
  auto r = rigid_spheres("r", balls);
  auto c = cubes("c", boxes);
  std::vector<Capsule> between;  // neighbours
  for (std::size_t i = 0; i < balls.size(); ++i)
    between.push_back({balls[i].center, balls[(i + 1) % balls.size()].center, balls[i].radius});
  auto k = capsules("k", between);
  k.setEnds(centers_of(balls), centers_of({balls.rbegin(), balls.rend()}));
  s.setCenters(centers_of(balls));
  r.setFrames(centers_of(balls), upright(static_cast<Index>(balls.size())));
  c.setParentOf(0, boxes[0].min, boxes[0].max, {0.1, kLeast, 0}, kLeast);
  said += lines(detect(component, s, r)) + lines(detect(component, r, s)) + lines(detect(component, s)) +
          lines(detect(component, c)) + lines(detect(component, c, c)) + lines(detect(component, k)) +
          lines(detect(component, s, k)) + lines(detect(component, k, r)) + lines(detect(component, c, s));
  for (Index i = 0; i < k.getSize(); ++i) said += box_text(k.bounding_box(i));
  OutputVector contacts;
  for (Index i = 0; i < s.getSize(); ++i) {
    const Sphere a(s, i);
    const RigidSphere b(r, (i + 1) % r.getSize());
    said += box_text(s.bounding_box(i)) + text(r.frame(i).center) + text(a.getContactPointByNormal({0.6, 0, -0.8})) +
            text(b.getContactPointByNormal({0.6, 0, -0.8}, PointConvention::published));
    said += component.testIntersection(a, b, component) ? "meet\n" : "apart\n";
    component.computeIntersection(a, b, contacts, component);
  }
  for (const DetectionOutput& contact : contacts) said += text(contact) + text(mirrored(contact)) + "\n";
  for (Index i = 0; i < c.getSize(); ++i) {
    const Cube a(c, i);
    said += component.testIntersection(a, a, component) ? "may touch itself " : "cannot ";
    said += component.testIntersection(a, {c, 0}, component) ? "meet\n" : "apart\n";
  }
  said += refusal([&] { s.setCenters(Eigen::MatrixX3d::Constant(s.getSize(), 3, kInfinity)); });
  said += refusal([&] { r.setFrames(centers_of(balls), Eigen::MatrixX4d::Constant(s.getSize(), 4, kLargest)); });
  said += refusal([&] { r.setFrames(centers_of(balls), Eigen::MatrixX4d::Constant(s.getSize(), 4, 0.1)); });
  said += refusal([&] { c.setParentOf(0, {0, kLeast, 0}, {0, 0, 0}); });
  said += refusal([&] { k.setEnds(centers_of(balls), Eigen::MatrixX3d::Constant(k.getSize(), 3, -kInfinity)); });
  said += refusal([&] {
    (void)ModelFactory::getInstance().make("SphereCollisionModel", "m", {{"centers", centers_of(balls)}});
  });
  said += what_of<std::invalid_argument>([&] { component.setAlarmDistance(-kLeast); });
  said += text(rounded_sum({0.1, kLeast, kLargest}, -3)) + std::to_string(sign_of_sum({0.1, -kLeast, -0.1}));
  return said;
}

TEST(Component, says_the_same_in_every_floating_point_environment_and_nothing_traps) {
  const std::vector<std::vector<Ball>> all{
      {{{0, 0, 0}, 0.1}, {{0.1, 0.7, -3}, 3.1}, {{1, 2, 2}, 1.5}, {{1, 2, 2}, 0.3}},
      {{{kLeast, 0, 0}, kLeast}, {{0, 3 * kLeast, 0}, 5 * kLeast}, {{1, kLeast, 0}, 1}, {{0, 0, 0}, 0.5}},
      {{{kLargest, 0, 0}, kLargest}, {{-kLargest, kLargest, 1}, 0x1p1000}, {{0x1p-1000, 0, 0}, 0x1p-600}}};
  const std::vector<Box> boxes{
      {{0, 0, 0}, {0.1, 1, 1}}, {{0.3, 0, 0}, {1, 1, 1}}, {{kLeast, -kLargest, 0}, {2 * kLeast, kLargest, 0.7}}};
  for (std::size_t i = 0; i < all.size(); ++i)
    for (const Distances distances : {Distances{0.2, 0.1}, Distances{kLeast, 0}, Distances{kLargest, kLargest}}) {
      const std::string expected = everything(all[i], boxes, distances);
      for (const FloatingPointEnvironment& environment : floating_point_environments()) {
        std::string said;
        in_environment(environment, [&] { said = everything(all[i], boxes, distances); });
        EXPECT_TRUE(said == expected) << first_difference(said, expected) << i << ", " << distances.alarm << ", "
                                      << environment.name;
      }
    }
}

TEST(CInterface, names_the_number_that_it_refuses_in_every_floating_point_environment) {
  const contact_sphere ball{{0, 0, 0}, 1};
  const contact_sphere negative{{0, 0, 0}, -kLeast};
  const contact_hull long_one{ball.center, (std::size_t{1} << 60) + 1, 0};  // no double is its count
  std::uint8_t hit = 7;
  const std::vector<std::pair<std::function<int()>, std::string>> cases{
      {[&] { return contact_test_sphere_sphere(1, &negative, &ball, 0, &hit, nullptr); },
       "a[0].radius = -5e-324: must not be negative"},
      {[&] { return contact_test_sphere_hull(1, &ball, &long_one, 0, &hit, nullptr); },
       "b[0].vertices = 1152921504606846976: must be from 1 to 64 points"}};
  for (const auto& [ask, words] : cases)
    for (const FloatingPointEnvironment& environment : floating_point_environments()) {
      int status = -1;
      in_environment(environment, [&, &asked = ask] { status = asked(); });
      EXPECT_EQ(status, CONTACT_OUTSIDE_DOMAIN) << environment.name;
      EXPECT_EQ(contact_last_error(), words) << environment.name;
    }
  EXPECT_EQ(hit, 7);
}

}  // namespace
}  // namespace contact
