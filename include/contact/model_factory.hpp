// Makes models by the name of their type from named columns of numbers, which scene files hold.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "contact/collision_model.hpp"
#include "contact/rows.hpp"

namespace contact::inline CONTACT_ABI {

/// Columns by name, one row per element. Eigen's matrices are copied in and out.
using ModelColumns = std::map<std::string, Rows<Eigen::Dynamic>>;

/// One column that a model type is made from.
struct ModelColumn {
  std::string name;
  Index width;  ///< numbers per element
};

/// A model type that can be made by name.
struct ModelMaker {
  std::string type;
  std::vector<ModelColumn> columns;
  /// Called with exactly the declared columns. Each has its declared width, and all have the same length.
  std::function<std::unique_ptr<CollisionModel>(std::string name, const ModelColumns& columns)> make;
};

/// The model types that can be made by name: the built-in ones, and those that plug-ins register.
/// Threads     registering and making may happen at once.
class ModelFactory {
 public:
  ModelFactory();

  /// Returns false and changes nothing if this type is registered already. Throws std::invalid_argument if `maker.make`
  /// is empty.
  bool registerModel(ModelMaker maker);

  /// Throws InvalidModel if the type is unknown, if a column is missing, unknown, or of the wrong width or length, if
  /// the model itself refuses the data, or if its maker returns nullptr.
  [[nodiscard]] std::unique_ptr<CollisionModel> make(const std::string& type, std::string name,
                                                     const ModelColumns& columns) const;

  [[nodiscard]] std::vector<ModelMaker> makers() const;

  [[nodiscard]] static ModelFactory& getInstance();

 private:
  mutable std::mutex mutex_;
  std::vector<ModelMaker> makers_;
};

}  // namespace contact::inline CONTACT_ABI
