// Capsules, a model type of one's own: everything within a radius of a segment.
#pragma once

#include "contact/collision_model.hpp"

namespace example {

/// Units       one length unit throughout.
/// Domain      finite end points p and q; finite radii >= 0; as many of each. p = q is a ball. Anything else throws
///             InvalidModel.
class CapsuleModel : public contact::ModelOf<CapsuleModel> {
 public:
  static constexpr std::string_view kName = "CapsuleModel";
  using Element = class Capsule;

  CapsuleModel(std::string name, Eigen::MatrixX3d p, Eigen::MatrixX3d q, Eigen::VectorXd radii);

  [[nodiscard]] contact::Index getSize() const override { return radii_.size(); }
  [[nodiscard]] contact::Box bounding_box(contact::Index index) const override;
  [[nodiscard]] contact::Vector3 p(contact::Index index) const { return p_.row(index).transpose(); }
  [[nodiscard]] contact::Vector3 q(contact::Index index) const { return q_.row(index).transpose(); }
  [[nodiscard]] double radius(contact::Index index) const { return radii_[index]; }

 private:
  Eigen::MatrixX3d p_;
  Eigen::MatrixX3d q_;
  Eigen::VectorXd radii_;
};

/// A handle to one capsule.
class Capsule : public contact::ElementOf<CapsuleModel> {
 public:
  using ElementOf::ElementOf;

  [[nodiscard]] contact::Capsule shape() const {
    const CapsuleModel& model = getCollisionModel();
    return {model.p(getIndex()), model.q(getIndex()), model.radius(getIndex())};
  }
};

}  // namespace example
