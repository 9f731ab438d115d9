// Collision models: whole sets of elements of one kind, their run-time type, and light handles to one element.
#pragma once

#include <compare>
#include <concepts>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <typeinfo>

#include "contact/domain.hpp"
#include "contact/geometry.hpp"

namespace contact::inline CONTACT_ABI {

/// A model refuses its data. The message names the model, the number, and the rule that the number breaks.
class InvalidModel : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// The name by which several libraries, each with its own copy of the header, know that they mean one model class:
///   static constexpr ModelIdentity<Mine> kIdentity{"org.example.Mine/1"};
/// Change the text whenever you change the class. No other class may have the same text, not even a derived one.
template <class M>
struct ModelIdentity {
  std::string_view text;
};

/// Tells model classes apart. If two plug-ins each have a class of the same name, these are two classes, unless both
/// declare the same ModelIdentity.
class ModelId {
 public:
  ModelId(const std::type_info& type, std::string_view identity)
      : identity_(identity), type_(identity.empty() ? &type : nullptr) {}
  friend bool operator==(const ModelId&, const ModelId&) = default;
  friend bool operator<(const ModelId& a, const ModelId& b) {
    if (a.identity_ != b.identity_) return a.identity_ < b.identity_;
    return std::less<>()(a.type_, b.type_);
  }

 private:
  std::string_view identity_;
  /// Compared by its address, because type_index treats classes of the same name as one class. The address is the same
  /// exactly where the linker has one class, and a plug-in is linked with nothing but itself.
  const std::type_info* type_;
};

/// What a model is at run time, and what it derives from.
struct ModelType {
  std::string_view name;
  ModelId id;
  const ModelType* base;  ///< nullptr for CollisionModel itself
};

/// A named set of elements of one kind. Elements hold the address of their model, so it must outlive them and not move.
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

  /// A box that contains the element. `detect` finds candidates by it, so it must never be too small, in any rounding
  /// mode.
  [[nodiscard]] virtual Box bounding_box(Index index) const = 0;

 protected:
  explicit CollisionModel(std::string name) : name_(std::move(name)) {}
  CollisionModel(const CollisionModel&) = default;
  CollisionModel(CollisionModel&&) = default;
  CollisionModel& operator=(const CollisionModel&) = default;
  CollisionModel& operator=(CollisionModel&&) = default;

  /// Throws InvalidModel, which names this model, if there is an error.
  void refuse(const std::optional<DomainError>& error) const;
  [[noreturn]] void refuse(const std::string& problem) const;

 private:
  std::string name_;
};

/// Declares the type of a model class: `class Droplets : public ModelOf<Droplets, SphereCollisionModel>` with a member
/// `static constexpr std::string_view kName`. If a class derives from a model and does not declare its own type, every
/// intersector treats it as that model.
template <class Self, class Base = CollisionModel>
class ModelOf : public Base {
 public:
  using Base::Base;
  using Model = Self;
  /// Hidden, because otherwise a program and its plug-ins would share one copy of the variable inside, also where they
  /// mean different classes of the same name.
  [[nodiscard, gnu::visibility("hidden")]] static const ModelType& static_type() {
    static const ModelType type{Self::kName, ModelId(typeid(Self), identity()), &Base::static_type()};
    return type;
  }
  [[nodiscard]] const ModelType& type() const override { return static_type(); }

 private:
  /// The identity that the class itself declares; an inherited one does not count.
  static constexpr std::string_view identity() {
    if constexpr (requires { requires std::same_as<decltype(Self::kIdentity), const ModelIdentity<Self>>; })
      return Self::kIdentity.text;
    else
      return {};
  }
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
  /// Domain: the element's model is an M. IntersectorMap has made sure of this.
  explicit ElementOf(const CollisionElement& element) : CollisionElement(element) {}

  [[nodiscard]] const M& getCollisionModel() const {
    return static_cast<const M&>(CollisionElement::getCollisionModel());
  }
};

}  // namespace contact::inline CONTACT_ABI
