// Collision models: whole sets of elements of one kind, and how they refuse data.
#include "contact/collision_model.hpp"

#include "component/message.hpp"

namespace contact::inline CONTACT_ABI {

const ModelType& CollisionModel::static_type() {
  static const ModelType type{kName, ModelId(typeid(CollisionModel), "contact::CollisionModel"), nullptr};
  return type;
}

void CollisionModel::refuse(const std::optional<DomainError>& error) const {
  if (error) refuse(component::message(*error));
}

void CollisionModel::refuse(const std::string& problem) const {
  throw InvalidModel(std::string(type().name) + " \"" + name_ + "\": " + problem);
}

}  // namespace contact::inline CONTACT_ABI
