// The commands of contact-certify.
#include "tool/commands/run_command.hpp"

namespace contact::tool {

std::vector<HeadedCommands> program_commands() { return {{"Judge an engine", {add_certify}}, {"Help", {add_help}}}; }

MakeFromZoo program_zoo() { return nullptr; }

}  // namespace contact::tool
