// The collision part of a scene of SOFA, a .scn file.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "contact/model_factory.hpp"

namespace contact::tool {

/// Which models SOFA's pipeline lets meet, as CollisionModel::canCollideWith and the broad phase have it.
struct MeetingRules {
  std::string node;             ///< two models of one node meet only where both say `selfCollision`; empty: no rule
  std::set<int> groups;         ///< models with a group in common do not meet
  bool simulated = true;        ///< two models that are not do not meet
  bool self_collision = false;  ///< the model meets itself
  /// The pipelines that have the model; two models meet only in one that has both. Nothing where a file has no
  /// pipeline. Models with the same pipelines share the set.
  std::shared_ptr<const std::set<std::string>> pipelines{};
};
/// Of two different models.
[[nodiscard]] bool may_meet(const MeetingRules& first, const MeetingRules& second);

/// What was left out of scenes: the first hundred things in words, the others counted.
struct LeftOut {
  static constexpr std::size_t kMost = 100;

  std::vector<std::string> first;  ///< `file:line: what and why`
  std::size_t all = 0;

  [[nodiscard]] bool is_full() const { return first.size() >= kMost; }
  void add(const LeftOut& more);
  /// A line for each of the first, and one for the others.
  [[nodiscard]] std::string text() const;
};

/// What was read of a .scn file.
struct SofaScene {
  struct Model {
    std::unique_ptr<CollisionModel> model;
    MeetingRules rules;
    std::size_t line;
  };
  double alarm = 0;
  double contact = 0;
  std::vector<Model> models;
  LeftOut left_out;
};

/// Reads spheres with the positions that they have before the first step: those of the nearest MechanicalObject, given,
/// of a SphereLoader or of a RegularGridTopology, scaled, turned and moved as it says, and under an IdentityMapping or
/// a RigidMapping. A model is named by its path, `/node/child/name`. The distances are those of the first intersection
/// component. What else has to do with collisions is left out and told. Throws InputError where the file cannot be
/// read, is no XML, nests deeper than any scene, or an attribute that is read is malformed. Time and memory grow with
/// the file and with the spheres that its models have.
[[nodiscard]] SofaScene read_sofa_scene(const std::string& path, const ModelFactory& factory);

/// Whether a file is taken for a scene of SOFA: by its name's ending.
[[nodiscard]] bool is_sofa_scene(std::string_view path);

}  // namespace contact::tool
