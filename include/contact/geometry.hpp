// The shapes of a question: balls, axis-aligned boxes and the two distances that SOFA's Intersection carries.
#pragma once

#include <Eigen/Core>

namespace contact {

using Vector3 = Eigen::Vector3d;

/// A solid sphere. `radius` >= 0; one length unit for everything in a question.
struct Ball {
  Vector3 center;
  double radius;
};

/// An axis-aligned box, SOFA's Cube. `min` <= `max` on every axis; equality makes a flat box.
struct Box {
  Vector3 min;
  Vector3 max;
};

/// The distances of SOFA's Intersection: pairs up to `alarm` apart are reported, and a contact's value is less
/// `contact`.
struct Distances {
  double alarm;
  double contact;
};

}  // namespace contact
