// Small models, contacts as text, and what the oracle expects: shared by the tests of this folder.
#pragma once

#include <array>
#include <cstddef>
#include <cstdio>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "component/model_of.hpp"
#include "contact/capsule_model.hpp"
#include "contact/cube_model.hpp"
#include "contact/detection_output.hpp"
#include "contact/intersection.hpp"
#include "contact/intersector_map.hpp"
#include "contact/line_model.hpp"
#include "contact/plane_model.hpp"
#include "contact/ray_model.hpp"
#include "contact/sphere_model.hpp"
#include "contact/triangle_model.hpp"
#include "kernel/floating_point_environment.hpp"

namespace contact::component {

inline Eigen::MatrixX3d centers_of(const std::vector<Ball>& balls) {
  Eigen::MatrixX3d centers(static_cast<Index>(balls.size()), 3);
  for (std::size_t i = 0; i < balls.size(); ++i) centers.row(static_cast<Index>(i)) = balls[i].center.transpose();
  return centers;
}

inline Eigen::VectorXd radii_of(const std::vector<Ball>& balls) {
  Eigen::VectorXd radii(static_cast<Index>(balls.size()));
  for (std::size_t i = 0; i < balls.size(); ++i) radii[static_cast<Index>(i)] = balls[i].radius;
  return radii;
}

/// The orientation that turns nothing, `count` times.
inline Eigen::MatrixX4d upright(Index count) {
  Eigen::MatrixX4d orientations = Eigen::MatrixX4d::Zero(count, 4);
  orientations.col(3).setOnes();
  return orientations;
}

inline SphereCollisionModel spheres(std::string name, const std::vector<Ball>& balls) {
  return {std::move(name), centers_of(balls), radii_of(balls)};
}

inline RigidSphereModel rigid_spheres(std::string name, const std::vector<Ball>& balls) {
  return {std::move(name), centers_of(balls), upright(static_cast<Index>(balls.size())), radii_of(balls)};
}

/// A model of these shapes, as it is and not behind a pointer.
template <class Model, class Shape>
Model model_as(std::string name, const std::vector<Shape>& all) {
  return std::move(static_cast<Model&>(*model_of(std::move(name), std::span(all))));
}
inline CubeCollisionModel cubes(std::string name, const std::vector<Box>& boxes) {
  return model_as<CubeCollisionModel>(std::move(name), boxes);
}
inline CapsuleCollisionModel capsules(std::string name, const std::vector<Capsule>& all) {
  return model_as<CapsuleCollisionModel>(std::move(name), all);
}
inline TriangleCollisionModel triangles(std::string name, const std::vector<Triangle>& all) {
  return model_as<TriangleCollisionModel>(std::move(name), all);
}
inline RayCollisionModel rays(std::string name, const std::vector<Ray>& all) {
  return model_as<RayCollisionModel>(std::move(name), all);
}
inline LineCollisionModel lines(std::string name, const std::vector<Line>& all) {
  return model_as<LineCollisionModel>(std::move(name), all);
}
inline PlaneCollisionModel planes(std::string name, const std::vector<Plane>& all) {
  return model_as<PlaneCollisionModel>(std::move(name), all);
}

/// A double as the hexadecimal number that it is: equal texts mean equal bits, -0 and +0 told apart.
inline std::string text(double x) {
  const kernel::RoundToNearest environment;  // the system's printf compares numbers, which may trap
  std::array<char, 40> digits{};
  std::snprintf(digits.data(), digits.size(), "%a", x);
  return digits.data();
}

inline std::string text(const Vector3& v) { return "(" + text(v[0]) + " " + text(v[1]) + " " + text(v[2]) + ")"; }

inline std::string text(const CollisionElement& element) {
  return element.getCollisionModel().getName() + "[" + std::to_string(element.getIndex()) + "]";
}

/// A contact on one line, every number to the last bit. Models by name: no address is in it.
inline std::string text(const DetectionOutput& output) {
  return text(output.elem.first) + " " + text(output.elem.second) + " id " + std::to_string(output.id) + " normal " +
         text(output.normal) + " points " + text(output.point[0]) + " " + text(output.point[1]) + " value " +
         text(output.value) + " deltaT " + text(output.deltaT);
}

inline std::vector<std::string> text(const OutputVector& contacts) {
  std::vector<std::string> lines;
  lines.reserve(contacts.size());
  for (const DetectionOutput& contact : contacts) lines.push_back(text(contact));
  return lines;
}

/// A contact that is nothing but its elements and its number.
inline DetectionOutput numbered_contact(const CollisionElement& first, const CollisionElement& second,
                                        DetectionOutput::ContactId id) {
  return {.elem = {first, second},
          .id = id,
          .point = {Vector3::Zero(), Vector3::Zero()},
          .normal = Vector3::UnitX(),
          .value = 0};
}

/// Answers with its number, as the contact's id, and leaves the elements as they came.
class Press : public BaseIntersector {
 public:
  static constexpr std::string_view kName = "Press";
  explicit Press(int number) : number_(number) {}

  template <class E1, class E2>
  bool testIntersection(const E1&, const E2&, const Intersection&) const {
    return number_ > 0;
  }
  template <class E1, class E2>
  int computeIntersection(const E1& elem1, const E2& elem2, OutputVector& contacts, const Intersection&) const {
    contacts.push_back(numbered_contact(elem1, elem2, number_));
    return 1;
  }

 private:
  int number_;
};

/// Supplies distances and nothing else: what a test takes from `currentIntersection`.
class Current : public Intersection {
 public:
  explicit Current(double alarm, double contact = 0) : distances_{alarm, contact} {}
  [[nodiscard]] const ElementIntersector* findIntersector(const CollisionModel&, const CollisionModel&,
                                                          bool&) const override {
    return nullptr;
  }
  [[nodiscard]] double getAlarmDistance() const override { return distances_.alarm; }
  [[nodiscard]] double getContactDistance() const override { return distances_.contact; }

 private:
  Distances distances_;
};

/// What an Error says that `call` throws; nothing where it throws none.
template <class Error, class Call>
std::string what_of(Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

template <class Call>
std::string refusal(Call&& call) {
  return what_of<InvalidModel>(std::forward<Call>(call));
}

}  // namespace contact::component
