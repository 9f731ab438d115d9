// The commands of contact-oracle.
#include "tool/commands/run_command.hpp"

namespace contact::tool {

std::vector<HeadedCommands> program_commands() {
  return {{"Judge an engine", {add_certify, add_properties, add_compare, add_exam, add_merge, add_verify, add_badge}},
          {"Ask for right answers", {add_explain, add_detect, add_serve, add_export}},
          {"Make golden files", {add_generate, add_annotate, add_convert, add_lint}},
          {"List what there is", {add_lists}},
          {"Maintain the committed golden files", {add_regenerate, add_adequacy, add_digests}},
          {"Help", {add_help, add_completion, add_man}}};
}

MakeFromZoo program_zoo() { return zoo_engine; }

}  // namespace contact::tool
