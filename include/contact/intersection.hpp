// The interfaces of intersection: Intersection finds intersectors and supplies distances, ElementIntersector intersects
// two elements, and an intersector class derives from BaseIntersector.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "contact/detection_output.hpp"

namespace contact::inline CONTACT_ABI {

class Intersection;

/// Two elements, each by its index in its model.
struct ElementPair {
  Index first;
  Index second;
};

/// Intersects elements of two models of known types. Its methods are const: several threads may ask at once.
class ElementIntersector {
 public:
  ElementIntersector() = default;
  ElementIntersector(const ElementIntersector&) = delete;
  ElementIntersector& operator=(const ElementIntersector&) = delete;
  virtual ~ElementIntersector() = default;

  /// Whether the two elements can collide. It may return true for elements that do not.
  [[nodiscard]] virtual bool canIntersect(const CollisionElement& elem1, const CollisionElement& elem2,
                                          const Intersection& currentIntersection) const = 0;
  /// Called before the elements of two models are intersected. Appends to `contacts` and returns how many.
  virtual int beginIntersect(const CollisionModel& model1, const CollisionModel& model2,
                             OutputVector& contacts) const = 0;
  /// Intersects two elements. Appends to `contacts` and returns how many.
  virtual int intersect(const CollisionElement& elem1, const CollisionElement& elem2, OutputVector& contacts,
                        const Intersection& currentIntersection) const = 0;
  /// Called after the elements of two models have been intersected. Appends to `contacts` and returns how many.
  virtual int endIntersect(const CollisionModel& model1, const CollisionModel& model2,
                           OutputVector& contacts) const = 0;
  /// The name of the class that intersects, with the two model types.
  [[nodiscard]] virtual std::string name() const = 0;
  /// Intersects many pairs of elements, in their order. The result is the same as of canIntersect, then intersect, for
  /// each pair. Appends to `contacts`; written[k] is how many contacts pair k appended. Domain: `written` is as long as
  /// `pairs`.
  virtual void intersectPairs(const CollisionModel& model1, const CollisionModel& model2,
                              std::span<const ElementPair> pairs, std::span<std::size_t> written,
                              OutputVector& contacts, const Intersection& currentIntersection) const;
};

/// The base of an intersector class. It names the vector of contacts; its begin and end methods write nothing.
class BaseIntersector {
 public:
  using OutputVector = contact::OutputVector;

  int beginIntersection(const CollisionModel&, const CollisionModel&, OutputVector&) const { return 0; }
  int endIntersection(const CollisionModel&, const CollisionModel&, OutputVector&) const { return 0; }

 protected:
  ~BaseIntersector() = default;
};

/// Finds the intersector for two models, and supplies the alarm and the contact distance to it.
class Intersection {
 public:
  Intersection() = default;
  Intersection(const Intersection&) = delete;
  Intersection& operator=(const Intersection&) = delete;
  virtual ~Intersection() = default;

  /// The intersector for two models, or nullptr if there is none. `swapModels` is set to true if the elements must be
  /// given to it in reverse order, otherwise to false, also if there is no intersector.
  [[nodiscard]] virtual const ElementIntersector* findIntersector(const CollisionModel& object1,
                                                                  const CollisionModel& object2,
                                                                  bool& swapModels) const = 0;
  /// Whether there is an intersector for the models of two elements.
  [[nodiscard]] bool isSupported(const CollisionElement& elem1, const CollisionElement& elem2) const;

  /// Whether pairs that do not touch yet are reported. If this is false, both distances are 0.
  [[nodiscard]] virtual bool useProximity() const { return false; }
  [[nodiscard]] virtual double getAlarmDistance() const { return 0; }
  [[nodiscard]] virtual double getContactDistance() const { return 0; }
  /// These two have no effect if useProximity() is false.
  virtual void setAlarmDistance(double) {}
  virtual void setContactDistance(double) {}
};

}  // namespace contact::inline CONTACT_ABI
