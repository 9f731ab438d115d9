// Help: what --help, --help-all and the command `help` print.
#include "tool/commands/help.hpp"

#include <fmt/format.h>

#include <CLI/Formatter.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <sstream>
#include <string_view>
#include <vector>

#include "formats/input_error.hpp"
#include "tool/commands/commands.hpp"
#include "tool/commands/usage.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {
namespace {

constexpr std::size_t kWidth = 80;
constexpr std::size_t kCommandColumn = 14;
constexpr std::size_t kOptionColumn = 26;

/// What a newcomer needs first.
constexpr std::array<std::string_view, 6> kMostUsed{"certify", "properties", "explain",
                                                    "compare", "generate",   "engines"};

/// Text in lines of at most kWidth, each but the first behind so many spaces.
std::string wrapped(const std::string& text, std::size_t indent) {
  std::string out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!out.empty()) out += "\n" + std::string(indent, ' ');
    std::size_t column = indent;
    std::istringstream words(line);
    for (std::string word; words >> word;) {
      if (column > indent && column + 1 + word.size() > kWidth) {
        out += "\n" + std::string(indent, ' ');
        column = indent;
      }
      if (column > indent) out += " ";
      column += word.size() + (column > indent ? 1 : 0);
      out += word;
    }
  }
  return out;
}

/// A name and what is said of it, in two columns.
std::string entry(const std::string& name, const std::string& about, std::size_t column) {
  const std::string left = "  " + name;
  const bool fits = left.size() + 2 <= column;
  return fmt::format("{}{}{}\n", left, fits ? std::string(column - left.size(), ' ') : "\n" + std::string(column, ' '),
                     wrapped(about, column));
}

std::string list(const std::string& title, const std::vector<const CLI::App*>& commands) {
  std::string text = fmt::format("\n{}:\n", title);
  for (const CLI::App* command : commands)
    text += entry(command->get_name(), description_of(*command).first, kCommandColumn);
  return text;
}

class HelpFormatter : public CLI::FormatterBase {
 public:
  std::string make_help(const CLI::App* app, std::string /*name*/, CLI::AppFormatMode mode) const override {
    const bool whole_program = app->get_parent() == nullptr;
    const auto [first, rest] = description_of(*app);
    std::string text = wrapped(first, 0) + "\n";
    if (!rest.empty()) text += wrapped(rest, 0) + "\n";
    text += fmt::format("\nUsage: {}\n", wrapped(synopsis(*app), 7));
    const bool has_many = app->get_subcommands({}).size() > kMostUsed.size();
    if (whole_program && has_many && mode != CLI::AppFormatMode::All)
      text += most_used(*app);
    else
      for (const CommandGroup& group : command_groups(*app)) text += list(group.title, group.commands);
    for (const OptionGroup& group : option_groups(*app)) {
      text += fmt::format("\n{}:\n", group.title);
      for (const OptionUsage& option : group.options) text += entry(option.text(), option.about, kOptionColumn);
    }
    text += "\nEvery command takes --quiet and --color, wherever they stand.\n";
    if (whole_program) text += exits();
    if (!app->get_footer().empty()) text += "\n" + app->get_footer() + "\n";
    return text;
  }

 private:
  static std::string most_used(const CLI::App& app) {
    std::vector<const CLI::App*> commands;
    for (const std::string_view name : kMostUsed) commands.push_back(find_command(app, std::string(name)));
    std::size_t all = 0;
    for (const CommandGroup& group : command_groups(app)) all += group.commands.size();
    return list("The commands that are used most", commands) +
           fmt::format(
               "\ncontact-oracle help all       lists all {} commands\n"
               "contact-oracle help COMMAND   the options of one; COMMAND --help is the same\n",
               all);
  }

  static std::string exits() {
    std::string text = "\nExit status:\n";
    for (const auto& [status, meaning] : exit_meanings())
      text += entry(std::to_string(status), std::string(meaning), 7);
    return text;
  }
};

}  // namespace

std::shared_ptr<CLI::FormatterBase> help_formatter() { return std::make_shared<HelpFormatter>(); }

void add_help(CLI::App& app, int& exit) {
  auto* command = app.add_subcommand("help", "This help, that of a command, or with `all` every command");
  auto names = std::make_shared<std::vector<std::string>>();
  command->add_option("command", *names, "A command, or all")->type_name("COMMAND");
  command->callback([&app, names, &exit] {
    const CLI::App* about = &app;
    const bool all = *names == std::vector<std::string>{"all"};
    if (!all)
      for (const std::string& name : *names) {
        about = find_command(*about, name);
        if (about == nullptr)
          throw formats::InputError(
              {"help", 0}, "",
              fmt::format("no command '{}'; `contact-oracle help all` lists them", fmt::join(*names, " ")));
      }
    fmt::print("{}", HelpFormatter().make_help(about, "", all ? CLI::AppFormatMode::All : CLI::AppFormatMode::Normal));
    exit = kCertified;
  });
}

}  // namespace contact::tool
