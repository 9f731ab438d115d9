// The commands of contact-oracle, one file each. Each adds itself to the parser and sets `exit` when it runs.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tool/commands/run_command.hpp"

namespace contact::tool {

/// A hidden command, whose arguments are the words of another command line and may be empty.
inline constexpr const char* kCompleteName = "complete";

/// What help calls the default of golden_folder(), whose path is another on every machine.
inline constexpr std::string_view kCommitted = "the committed golden files";

/// Validators for whole numbers; CLI11 would let -1 wrap around.
extern const CLI::Validator kFromZero;  ///< of 64 bits, such as seeds
/// For how many of something, from 0 and from 1: below 2^32, where the numbers of fresh questions begin, so that no sum wraps around.
extern const CLI::Validator kCount;
extern const CLI::Validator kFromOne;
/// For how many threads: oneTBB makes room for every one before it begins.
extern const CLI::Validator kThreads;
/// For seconds: above 0. CLI11's own message spells out the largest double.
extern const CLI::Validator kSeconds;
/// For a distance: from 0.
extern const CLI::Validator kLength;

/// The seed that was given, or one that nobody chose; a command prints it, so that a run can be repeated.
[[nodiscard]] std::uint64_t seed_or_fresh(std::optional<std::uint64_t> given);

/// The names of what there is, for CLI::IsMember.
template <class All>
[[nodiscard]] std::vector<std::string> names_of(const All& all) {
  std::vector<std::string> names;
  for (const auto& one : all) names.emplace_back(name(one));
  return names;
}
/// That of them which has the name, as one has that CLI::IsMember let pass.
template <class All>
[[nodiscard]] auto named(const All& all, std::string_view text) {
  return *std::find_if(all.begin(), all.end(), [&](auto one) { return name(one) == text; });
}

/// Options that are added while it lives stand under this heading in help.
class Heading {
 public:
  Heading(CLI::App& command, const std::string& title)
      : command_(command), before_(command.option_defaults()->get_group()) {
    command_.option_defaults()->group(title);
  }
  Heading(const Heading&) = delete;
  Heading& operator=(const Heading&) = delete;
  ~Heading() { command_.option_defaults()->group(before_); }

 private:
  CLI::App& command_;
  std::string before_;
};

/// Refuses an option that stands alone where others were given beside it, which would do nothing.
void require_alone(const CLI::App& command, const std::string& option);

/// Refuses an output that is one of the files that are read: it would be lost.
void require_apart(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs);

/// The committed golden files, where the program was built from.
[[nodiscard]] std::string golden_folder();
/// The folder that a command was given, or else the committed golden files, and then a line that says so.
[[nodiscard]] std::string chosen_folder(const std::string& given);
/// Throws InputError where a command that writes into a folder was given none.
void require_folder(const std::string& command, const std::string& option, const std::string& folder);
/// Makes a folder where there is none. Throws InputError where none can be made.
void make_folder(const std::filesystem::path& folder, const std::string& option = "");

}  // namespace contact::tool
