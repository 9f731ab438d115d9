// A command line as a whole, and the commands that it may call: main and the lists of commands see nothing of the parser.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace contact::engines {
class Engine;
}

namespace contact::tool {

/// Parses a command line, does what it says and returns the exit code; what is wrong with its options is told on
/// standard error. Throws what a command throws: formats::InputError, golden::OracleFault, engines::HarnessInvalid,
/// Interrupted.
int run_command(int argc, const char* const* argv);

/// Commands that stand under a heading, unless they say under which.
struct HeadedCommands {
  std::string heading;
  std::vector<void (*)(CLI::App& app, int& exit)> adds;
};
/// Those of this program: all, or `certify` alone.
[[nodiscard]] std::vector<HeadedCommands> program_commands();

/// The engine mutant:ID or unsteady:ID. Throws formats::InputError, with the names near to it, where there is none.
[[nodiscard]] std::unique_ptr<engines::Engine> zoo_engine(const std::string& name);
/// `zoo_engine`, or nullptr where this program is built without these engines.
using MakeFromZoo = std::unique_ptr<engines::Engine> (*)(const std::string& name);
[[nodiscard]] MakeFromZoo program_zoo();

void add_adequacy(CLI::App& app, int& exit);
void add_badge(CLI::App& app, int& exit);
void add_compare(CLI::App& app, int& exit);
void add_detect(CLI::App& app, int& exit);
void add_digests(CLI::App& app, int& exit);
void add_exam(CLI::App& app, int& exit);
void add_explain(CLI::App& app, int& exit);
void add_export(CLI::App& app, int& exit);
void add_generate(CLI::App& app, int& exit);
void add_regenerate(CLI::App& app, int& exit);
void add_annotate(CLI::App& app, int& exit);
void add_convert(CLI::App& app, int& exit);
void add_certify(CLI::App& app, int& exit);
void add_serve(CLI::App& app, int& exit);
void add_properties(CLI::App& app, int& exit);
void add_lint(CLI::App& app, int& exit);
void add_merge(CLI::App& app, int& exit);
void add_verify(CLI::App& app, int& exit);
void add_lists(CLI::App& app, int& exit);  ///< engines, pairs, families
void add_help(CLI::App& app, int& exit);
void add_completion(CLI::App& app, int& exit);
void add_man(CLI::App& app, int& exit);

}  // namespace contact::tool
