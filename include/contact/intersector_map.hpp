// Which intersector serves which pair of model types, decided at run time and open to new entries.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "contact/intersection.hpp"

namespace contact::inline CONTACT_ABI {

/// An ElementIntersector that hands elements to the methods of an object of class T.
template <class Model1, class Model2, class T>
class MemberElementIntersector final : public ElementIntersector {
 public:
  using Element1 = typename Model1::Element;
  using Element2 = typename Model2::Element;

  explicit MemberElementIntersector(const T& object) : object_(&object) {}

  bool canIntersect(const CollisionElement& elem1, const CollisionElement& elem2,
                    const Intersection& currentIntersection) const override {
    return object_->testIntersection(Element1(elem1), Element2(elem2), currentIntersection);
  }
  int beginIntersect(const CollisionModel& model1, const CollisionModel& model2,
                     OutputVector& contacts) const override {
    return object_->beginIntersection(model1, model2, contacts);
  }
  int intersect(const CollisionElement& elem1, const CollisionElement& elem2, OutputVector& contacts,
                const Intersection& currentIntersection) const override {
    return object_->computeIntersection(Element1(elem1), Element2(elem2), contacts, currentIntersection);
  }
  int endIntersect(const CollisionModel& model1, const CollisionModel& model2, OutputVector& contacts) const override {
    return object_->endIntersection(model1, model2, contacts);
  }
  /// Calls T's own intersectPairs. If T has none, or if it returns false, each pair is intersected by itself.
  void intersectPairs(const CollisionModel& model1, const CollisionModel& model2, std::span<const ElementPair> pairs,
                      std::span<std::size_t> written, OutputVector& contacts,
                      const Intersection& currentIntersection) const override {
    const auto& first = static_cast<const Model1&>(model1);
    const auto& second = static_cast<const Model2&>(model2);
    if constexpr (requires {
                    {
                      object_->intersectPairs(first, second, pairs, written, contacts, currentIntersection)
                      } -> std::same_as<bool>;
                  })
      if (object_->intersectPairs(first, second, pairs, written, contacts, currentIntersection)) return;
    ElementIntersector::intersectPairs(model1, model2, pairs, written, contacts, currentIntersection);
  }
  [[nodiscard]] std::string name() const override {
    return std::string(T::kName) + "<" + std::string(Model1::kName) + "," + std::string(Model2::kName) + ">";
  }
  [[nodiscard]] const T& object() const { return *object_; }

 private:
  const T* object_;
};

/// Intersectors by the types of two models.
///
/// Lookup      finds the entry whose types are the models' own types or their bases'. The nearest entry wins (fewest
///             steps up both lineages together). At equal distance the given order of the models wins over the swapped
///             one, and then the entry that was added last.
/// Order       a new entry for the same two types in the same order replaces the old one.
/// Threads     any number of threads may look up at once while none adds. A thread that adds must be the only user.
class IntersectorMap {
 public:
  /// Receives one message for every pair of model types that has no entry, from the thread that looks it up first.
  using Sink = std::function<void(const std::string& message)>;

  /// Without a sink of your own, messages go to standard error.
  IntersectorMap();

  /// Sends elements of a Model1 and a Model2 to `object`, which must outlive the map's use. T needs a name
  /// `static constexpr std::string_view kName`, and
  ///   bool testIntersection(const E1&, const E2&, const Intersection& currentIntersection) const
  ///   int computeIntersection(const E1&, const E2&, OutputVector&, const Intersection& currentIntersection) const
  /// where E1 and E2 are Model1::Element and Model2::Element; BaseIntersector supplies the rest.
  template <class Model1, class Model2, class T>
  void add(const T& object);

  /// Says that the pair has no intersector; the map then gives no message about it.
  template <class Model1, class Model2>
  void ignore() {
    insert(Model1::static_type(), Model2::static_type(), nullptr);
  }

  /// The intersector for two models, or nullptr. `swapModels` tells whether it takes their elements in reverse order.
  /// The pointer stays valid until an entry for the same types replaces the intersector.
  [[nodiscard]] const ElementIntersector* get(const CollisionModel& model1, const CollisionModel& model2,
                                              bool& swapModels) const;

  /// Replaces the sink. With an empty sink there are no messages.
  void setSink(Sink sink) { sink_ = std::move(sink); }

  /// The names of the intersectors in the order in which their entries were added; `ignored` for ignored pairs.
  [[nodiscard]] std::vector<std::string> names() const;

 private:
  using Key = std::pair<ModelId, ModelId>;
  struct Entry {
    std::string name;
    std::unique_ptr<const ElementIntersector> intersector;  ///< nullptr: ignored
    std::size_t added;
  };
  struct Found {
    const Entry* entry = nullptr;
    bool swapped = false;
  };

  void insert(const ModelType& type1, const ModelType& type2, std::unique_ptr<const ElementIntersector> intersector);
  [[nodiscard]] Found find(const ModelType& type1, const ModelType& type2) const;
  void report_missing(const ModelType& type1, const ModelType& type2) const;

  std::map<Key, Entry> entries_;
  std::size_t added_ = 0;
  Sink sink_;
  mutable std::mutex missing_mutex_;
  mutable std::set<Key> missing_;  ///< reported already
};

template <class Model1, class Model2, class T>
void IntersectorMap::add(const T& object) {
  static_assert(DeclaredModel<Model1> && DeclaredModel<Model2>,
                "a model that intersectors are added for must declare its type: derive it from contact::ModelOf");
  constexpr bool kElements = requires {
    typename Model1::Element;
    typename Model2::Element;
  };
  static_assert(kElements, "a model that intersectors are added for must name its handle: using Element = ...");
  if constexpr (kElements) {
    using Element1 = const typename Model1::Element&;
    using Element2 = const typename Model2::Element&;
    constexpr bool kName = requires { std::string(T::kName); };
    constexpr bool kTest = requires(const T& t, Element1 e1, Element2 e2, const Intersection& current) {
      { t.testIntersection(e1, e2, current) } -> std::same_as<bool>;
    };
    constexpr bool kCompute =
        requires(const T& t, Element1 e1, Element2 e2, OutputVector& contacts, const Intersection& current) {
      { t.computeIntersection(e1, e2, contacts, current) } -> std::same_as<int>;
    };
    constexpr bool kBase = requires(const T& t, const CollisionModel& model, OutputVector& contacts) {
      { t.beginIntersection(model, model, contacts) } -> std::same_as<int>;
      { t.endIntersection(model, model, contacts) } -> std::same_as<int>;
    };
    static_assert(kName, "an intersector needs a name: static constexpr std::string_view kName");
    static_assert(kTest,
                  "an intersector needs, for the elements of both models: "
                  "bool testIntersection(const E1&, const E2&, const Intersection&) const");
    static_assert(kCompute,
                  "an intersector needs, for the elements of both models: "
                  "int computeIntersection(const E1&, const E2&, OutputVector&, const Intersection&) const");
    static_assert(
        kBase, "an intersector needs beginIntersection and endIntersection: derive it from contact::BaseIntersector");
    if constexpr (kName && kTest && kCompute && kBase)
      insert(Model1::static_type(), Model2::static_type(),
             std::make_unique<MemberElementIntersector<Model1, Model2, T>>(object));
  }
}

}  // namespace contact::inline CONTACT_ABI
