// What the parser knows of the commands and their options, in one form for help, manual pages and completion.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace contact::tool {

/// An option, or an argument that stands without one.
struct OptionUsage {
  std::vector<std::string> names;    ///< "-o", "--output"; none of an argument
  std::string value;                 ///< "FILE"; empty where there is none
  std::string joint = " ";           ///< between name and value: "=" where nothing else will do
  bool may_stand_alone = false;      ///< without its value
  bool several = false;              ///< takes several values
  char delimiter = '\0';             ///< between several in one word
  std::vector<std::string> choices;  ///< the values that there are, where they are listed
  std::string about;

  /// "-o,--output FILE", "--json[=FILE]".
  [[nodiscard]] std::string text() const;
  /// The value behind a name: " FILE", "[=FILE]".
  [[nodiscard]] std::string value_text() const;
};
[[nodiscard]] OptionUsage usage_of(const CLI::Option& option);

/// The options that are shown, by heading, those without one last; arguments first, under "Arguments".
struct OptionGroup {
  std::string title;
  std::vector<OptionUsage> options;
};
[[nodiscard]] std::vector<OptionGroup> option_groups(const CLI::App& command);

/// The commands that are shown, by heading and in the order in which they were added.
struct CommandGroup {
  std::string title;
  std::vector<const CLI::App*> commands;
};
[[nodiscard]] std::vector<CommandGroup> command_groups(const CLI::App& app);

/// The command of an app by name, or nullptr.
[[nodiscard]] const CLI::App* find_command(const CLI::App& app, const std::string& name);
/// "contact-oracle exam new".
[[nodiscard]] std::string full_name(const CLI::App& command);
/// "contact-oracle certify [OPTIONS] [DATASETS...]".
[[nodiscard]] std::string synopsis(const CLI::App& command);
/// What a command does, in a line; and what else is to be said of it.
[[nodiscard]] std::pair<std::string, std::string> description_of(const CLI::App& command);

/// What an exit status means.
struct ExitMeaning {
  int status;
  std::string_view meaning;
};
[[nodiscard]] const std::vector<ExitMeaning>& exit_meanings();

}  // namespace contact::tool
