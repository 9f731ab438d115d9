// A scene: whole collision models read from JSON lines.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "contact/model_factory.hpp"
#include "tool/run/sofa_scene.hpp"

namespace contact::tool {

struct Scene {
  std::optional<double> alarm;    ///< absent where no header gives one
  std::optional<double> contact;  ///< likewise
  std::vector<std::unique_ptr<const CollisionModel>> models;
  std::vector<MeetingRules> rules;  ///< one a model; those of other files have none
  LeftOut left_out;                 ///< of scenes of SOFA, with file and line
};

/// Reads scene files ("-" for standard input; a .scn file is a scene of SOFA) into one scene, the models in the order
/// of files and lines. Throws InputError at anything malformed: among others two models of one name, a distance that
/// two headers give different values, and no model at all.
[[nodiscard]] Scene read_scene(const std::vector<std::string>& paths, const ModelFactory& factory);

/// The lines of a scene as documentation shows them: a header, and one model of every type that the factory makes.
[[nodiscard]] std::string scene_form(const ModelFactory& factory);

}  // namespace contact::tool
