// Models by the name of their type, from named columns of numbers: what scene files hold.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "contact/collision_model.hpp"

namespace contact {

/// Columns by name, one row an element.
using ModelColumns = std::map<std::string, Eigen::MatrixXd>;

/// One column that a model type is made from.
struct ModelColumn {
  std::string name;
  Index width;  ///< numbers an element
};

/// A model type that can be made by name.
struct ModelMaker {
  std::string type;
  std::vector<ModelColumn> columns;
  /// Called with exactly the columns declared, each of its width and all of one length.
  std::function<std::unique_ptr<CollisionModel>(std::string name, const ModelColumns& columns)> make;
};

/// The model types that can be made by name: the three built-in ones, and those that plug-ins register.
/// Threads     registering and making may happen at once.
class ModelFactory {
 public:
  ModelFactory();

  /// False, and nothing happens, where that type is registered already.
  bool registerModel(ModelMaker maker);

  /// Throws InvalidModel where the type is unknown, or a column is missing, unknown, or of the wrong width or length,
  /// and where the model itself refuses the data.
  [[nodiscard]] std::unique_ptr<CollisionModel> make(const std::string& type, std::string name,
                                                     const ModelColumns& columns) const;

  [[nodiscard]] std::vector<ModelMaker> makers() const;

  [[nodiscard]] static ModelFactory& getInstance();

 private:
  mutable std::mutex mutex_;
  std::vector<ModelMaker> makers_;
};

}  // namespace contact
