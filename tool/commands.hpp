// The commands of contact-oracle, one file each. Each adds itself to the parser and sets `exit` when it runs.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <string>
#include <vector>

namespace contact::tool {

void add_adequacy(CLI::App& app, int& exit);
void add_compare(CLI::App& app, int& exit);
void add_detect(CLI::App& app, int& exit);
void add_digests(CLI::App& app, int& exit);
void add_explain(CLI::App& app, int& exit);
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
void add_lists(CLI::App& app, int& exit);  ///< engines, families

/// Parses a command line, does what it says and returns the exit code; what is wrong with its options is told on
/// standard error. Throws what a command throws: golden::InputError, OracleFault, engines::HarnessInvalid, Interrupted.
int run_command(int argc, const char* const* argv);

/// Validators for whole numbers from 0 and from 1; CLI11 would let -1 wrap around.
extern const CLI::Validator kFromZero;
extern const CLI::Validator kFromOne;
/// For seconds: above 0. CLI11's own message spells out the largest double.
extern const CLI::Validator kSeconds;

/// The committed golden files: golden/ here, or where the program was built from.
[[nodiscard]] std::string golden_folder();

}  // namespace contact::tool
