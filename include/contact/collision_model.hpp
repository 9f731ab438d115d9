// Collision models: whole sets of elements of one kind, their run-time type, and light handles to one element.
#pragma once

#include <Eigen/Core>
#include <concepts>
#include <stdexcept>
#include <string>
#include <string_view>
#include <typeindex>

#include "contact/domain.hpp"
#include "contact/geometry.hpp"

namespace contact {

/// The index of an element in its model, from 0.
using Index = Eigen::Index;

/// A model's data are refused on entry: which model, which number, and the rule that it breaks.
class InvalidModel : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// What a model is at run time, and what it derives from. One object a class; `id` tells classes apart, also across
/// shared libraries.
struct ModelType {
  std::string_view name;
  std::type_index id;
  const ModelType* base;  ///< nullptr for CollisionModel itself
};

/// A named set of elements of one kind. Elements refer to their model by address: it must outlive them and stay put.
class CollisionModel {
 public:
  /// Marks the class whose type `static_type` describes.
  using Model = CollisionModel;
  static constexpr std::string_view kName = "CollisionModel";
  [[nodiscard]] static const ModelType& static_type();

  virtual ~CollisionModel() = default;

  [[nodiscard]] virtual const ModelType& type() const { return static_type(); }
  [[nodiscard]] virtual Index getSize() const = 0;
  [[nodiscard]] const std::string& getName() const { return name_; }

  /// A box that contains the element; detect finds candidates by it. Never too small, in any rounding mode.
  [[nodiscard]] virtual Box bounding_box(Index index) const = 0;

 protected:
  explicit CollisionModel(std::string name) : name_(std::move(name)) {}
  CollisionModel(const CollisionModel&) = default;
  CollisionModel(CollisionModel&&) = default;
  CollisionModel& operator=(const CollisionModel&) = default;
  CollisionModel& operator=(CollisionModel&&) = default;

  /// Throws InvalidModel, naming this model, where there is an error.
  void refuse(const std::optional<DomainError>& error) const;
  [[noreturn]] void refuse(const std::string& problem) const;

 private:
  std::string name_;
};

/// Declares the type of a model class: `class Droplets : public ModelOf<Droplets, SphereCollisionModel>` with a member
/// `static constexpr std::string_view kName`. A class that derives from a model without declaring itself is that model
/// to every intersector.
template <class Self, class Base = CollisionModel>
class ModelOf : public Base {
 public:
  using Base::Base;
  using Model = Self;
  [[nodiscard]] static const ModelType& static_type() {
    static const ModelType type{Self::kName, typeid(Self), &Base::static_type()};
    return type;
  }
  [[nodiscard]] const ModelType& type() const override { return static_type(); }
};

/// A class that has declared its own type and names the handle of its elements.
template <class M>
concept DeclaredModel = std::derived_from<M, CollisionModel> && std::same_as<typename M::Model, M>;

/// A handle to one element: model and index. Two handles are equal when they mean the same element of the same model.
class CollisionElement {
 public:
  CollisionElement(const CollisionModel& model, Index index) : model_(&model), index_(index) {}

  [[nodiscard]] const CollisionModel& getCollisionModel() const { return *model_; }
  [[nodiscard]] Index getIndex() const { return index_; }

  friend bool operator==(const CollisionElement&, const CollisionElement&) = default;

 private:
  const CollisionModel* model_;
  Index index_;
};

/// A handle that knows its model's class.
template <class M>
class ElementOf : public CollisionElement {
 public:
  ElementOf(const M& model, Index index) : CollisionElement(model, index) {}
  /// Domain: the element's model is an M, as IntersectorMap has established.
  explicit ElementOf(const CollisionElement& element) : CollisionElement(element) {}

  [[nodiscard]] const M& getCollisionModel() const {
    return static_cast<const M&>(CollisionElement::getCollisionModel());
  }
};

}  // namespace contact
