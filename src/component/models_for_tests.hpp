// Small models, contacts as text, and what the oracle expects: shared by the tests of this folder.
#pragma once

#include <array>
#include <cstddef>
#include <cstdio>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "contact/capsule_model.hpp"
#include "contact/cube_model.hpp"
#include "contact/detection_output.hpp"
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

inline CubeCollisionModel cubes(std::string name, const std::vector<Box>& boxes) {
  Eigen::MatrixX3d min(static_cast<Index>(boxes.size()), 3);
  Eigen::MatrixX3d max(static_cast<Index>(boxes.size()), 3);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    min.row(static_cast<Index>(i)) = boxes[i].min.transpose();
    max.row(static_cast<Index>(i)) = boxes[i].max.transpose();
  }
  return {std::move(name), min, max};
}

inline CapsuleCollisionModel capsules(std::string name, const std::vector<Capsule>& all) {
  const auto count = static_cast<Index>(all.size());
  Rows<3> starts(count, 3);
  Rows<3> ends(count, 3);
  Rows<1> radii(count, 1);
  for (Index i = 0; i < count; ++i) {
    const Capsule& capsule = all[static_cast<std::size_t>(i)];
    starts.set(i, capsule.start);
    ends.set(i, capsule.end);
    radii(i) = capsule.radius;
  }
  return {std::move(name), std::move(starts), std::move(ends), std::move(radii)};
}

inline TriangleCollisionModel triangles(std::string name, const std::vector<Triangle>& all) {
  const auto count = static_cast<Index>(all.size());
  std::array<Rows<3>, 3> p{Rows<3>(count, 3), Rows<3>(count, 3), Rows<3>(count, 3)};
  for (Index i = 0; i < count; ++i)
    for (std::size_t k = 0; k < 3; ++k) p[k].set(i, all[static_cast<std::size_t>(i)].vertices[k]);
  return {std::move(name), std::move(p[0]), std::move(p[1]), std::move(p[2])};
}

inline RayCollisionModel rays(std::string name, const std::vector<Ray>& all) {
  const auto count = static_cast<Index>(all.size());
  Rows<3> origins(count, 3);
  Rows<3> directions(count, 3);
  Rows<1> lengths(count, 1);
  for (Index i = 0; i < count; ++i) {
    const Ray& ray = all[static_cast<std::size_t>(i)];
    origins.set(i, ray.origin);
    directions.set(i, ray.direction);
    lengths(i) = ray.length;
  }
  return {std::move(name), std::move(origins), std::move(directions), std::move(lengths)};
}

inline LineCollisionModel lines(std::string name, const std::vector<Line>& all) {
  const auto count = static_cast<Index>(all.size());
  Rows<3> p1(count, 3);
  Rows<3> p2(count, 3);
  for (Index i = 0; i < count; ++i) {
    p1.set(i, all[static_cast<std::size_t>(i)].start);
    p2.set(i, all[static_cast<std::size_t>(i)].end);
  }
  return {std::move(name), std::move(p1), std::move(p2)};
}

inline PlaneCollisionModel planes(std::string name, const std::vector<Plane>& all) {
  const auto count = static_cast<Index>(all.size());
  Rows<3> normals(count, 3);
  Rows<1> offsets(count, 1);
  for (Index i = 0; i < count; ++i) {
    normals.set(i, all[static_cast<std::size_t>(i)].normal);
    offsets(i) = all[static_cast<std::size_t>(i)].offset;
  }
  return {std::move(name), std::move(normals), std::move(offsets)};
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
