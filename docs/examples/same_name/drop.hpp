// A class that each of several plug-ins has one of, by the same name and with other contents, in a namespace that is
// everybody's. CMakeLists.txt defines DROP_SIZE; DROP_TEMPERATURE, where drops hold numbers before it; and DROP_IDENTITY,
// where plug-ins mean one class.
#pragma once

#include <string>

#include "contact/discrete_intersection.hpp"
#include "contact/plugin.hpp"

namespace example {

class Drop : public contact::ModelOf<Drop> {
 public:
  static constexpr std::string_view kName = "Drop";
#ifdef DROP_IDENTITY
  static constexpr contact::ModelIdentity<Drop> kIdentity{DROP_IDENTITY};
#endif
  using Element = contact::ElementOf<Drop>;

  explicit Drop(std::string name) : ModelOf(std::move(name)) {}
  [[nodiscard]] contact::Index getSize() const override { return 1; }
  [[nodiscard]] contact::Box bounding_box(contact::Index) const override {
    return {contact::Vector3::Zero(), contact::Vector3::Ones()};
  }

#ifdef DROP_TEMPERATURE
  double temperature[3] = {7, 8, 9};
#endif
  double size = DROP_SIZE;
};

/// One contact a pair; its value is the drop's size.
class DropIntersector : public contact::BaseIntersector {
 public:
  static constexpr std::string_view kName = "DropIntersector";
  explicit DropIntersector(contact::DiscreteIntersection& object) {
    object.intersectors.add<Drop, contact::SphereCollisionModel>(*this);
  }
  bool testIntersection(const Drop::Element&, const contact::Sphere&, const contact::Intersection&) const {
    return true;
  }
  int computeIntersection(const Drop::Element& drop, const contact::Sphere& sphere, OutputVector& contacts,
                          const contact::Intersection&) const {
    contacts.push_back({.elem = {drop, sphere},
                        .id = contact_id(drop, sphere),
                        .point = {contact::Vector3::Zero(), contact::Vector3::Zero()},
                        .normal = contact::Vector3::UnitX(),
                        .value = drop.getCollisionModel().size});
    return 1;
  }
};

}  // namespace example
