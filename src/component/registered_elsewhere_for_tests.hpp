// A model and an intersector that another source file registers while the program starts.
#pragma once

#include "contact/discrete_intersection.hpp"

namespace contact::component {

/// A model of points that touch nothing.
class Stars : public ModelOf<Stars> {
 public:
  static constexpr std::string_view kName = "Stars";
  using Element = ElementOf<Stars>;
  explicit Stars(std::string name) : ModelOf(std::move(name)) {}
  [[nodiscard]] Index getSize() const override { return 1; }
  [[nodiscard]] Box bounding_box(Index) const override { return {Vector3::Zero(), Vector3::Zero()}; }
};

/// Counts those of its kind that are alive.
class StarIntersector : public BaseIntersector {
 public:
  static constexpr std::string_view kName = "StarIntersector";
  explicit StarIntersector(DiscreteIntersection& object);
  ~StarIntersector();
  StarIntersector(const StarIntersector&) = delete;
  StarIntersector& operator=(const StarIntersector&) = delete;

  bool testIntersection(const Stars::Element&, const Sphere&, const Intersection&) const { return true; }
  int computeIntersection(const Stars::Element& star, const Sphere& sphere, OutputVector& contacts,
                          const Intersection&) const;

  static int alive();

 private:
  DiscreteIntersection* object_;
};

}  // namespace contact::component
