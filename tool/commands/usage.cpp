// What the parser knows of the commands and their options.
#include "tool/commands/usage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "tool/run/process.hpp"

namespace contact::tool {
namespace {

constexpr std::string_view kOwnGroup = "Options";  // CLI11's, of what has no other

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, at);) parts.push_back(part);
  return parts;
}

/// CLI11 writes what it knows of a value as "TEXT:{a,b}", "UINT:1..", "FLOAT:SECONDS" or "FILE".
void read_value(const CLI::Option& option, OptionUsage& usage) {
  const std::string type = option.get_type_name();
  const std::size_t colon = std::min(type.find(':'), type.size());
  const std::string rule = type.substr(std::min(colon + 1, type.size()));
  usage.value = type.substr(0, colon);
  if (rule.starts_with('{') && rule.ends_with('}')) usage.choices = split(rule.substr(1, rule.size() - 2), ',');
  if (usage.value == "TEXT") usage.value = upper(option.get_lnames().empty() ? "FILE" : option.get_lnames().front());
  if (usage.value == "UINT" || usage.value == "INT") usage.value = "N";
  if (usage.value == "FLOAT") usage.value = rule.empty() ? "NUMBER" : rule;
}

bool shown(const CLI::Option& option) { return !option.get_group().empty(); }

}  // namespace

std::string OptionUsage::value_text() const {
  if (value.empty()) return "";
  const std::string one = several && delimiter != '\0' ? fmt::format("{}{}...", value, delimiter) : value;
  return may_stand_alone ? fmt::format("{}[{}{}]", joint == "=" ? "" : " ", joint == "=" ? "=" : "", one) : joint + one;
}

std::string OptionUsage::text() const {
  return names.empty() ? value : fmt::format("{}{}", fmt::join(names, ","), value_text());
}

OptionUsage usage_of(const CLI::Option& option) {
  OptionUsage usage;
  for (const std::string& name : option.get_snames()) usage.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) usage.names.push_back("--" + name);
  const bool is_flag = option.get_items_expected_max() == 0;
  if (!is_flag || !option.get_type_name().empty()) read_value(option, usage);
  usage.may_stand_alone = !usage.value.empty() && option.get_items_expected_min() == 0;
  if (is_flag) usage.joint = "=";
  usage.several = option.get_items_expected_max() > 1;
  usage.delimiter = option.get_delimiter();
  usage.about = option.get_description();
  const std::string fallback = usage.may_stand_alone ? "" : option.get_default_str();
  std::vector<std::string> notes;
  if (!usage.choices.empty()) notes.push_back(fmt::format("{}", fmt::join(usage.choices, ", ")));
  if (!fallback.empty())
    notes.push_back(usage.choices.empty() ? fmt::format("default: {}", fallback) : "default " + fallback);
  if (!notes.empty()) usage.about += fmt::format(" ({})", fmt::join(notes, "; "));
  if (usage.names.empty()) usage.value = upper(option.get_name(true));
  return usage;
}

std::vector<OptionGroup> option_groups(const CLI::App& command) {
  std::vector<OptionGroup> groups;
  for (const CLI::Option* option : command.get_options()) {
    if (!shown(*option)) continue;
    const std::string title = option->get_positional() ? "Arguments" : option->get_group();
    auto group = std::find_if(groups.begin(), groups.end(), [&](const OptionGroup& g) { return g.title == title; });
    if (group == groups.end()) group = groups.insert(groups.end(), {title, {}});
    group->options.push_back(usage_of(*option));
    if (!option->get_positional() && option->get_required()) group->options.back().about += " (required)";
  }
  const auto rank = [](const OptionGroup& g) { return g.title == "Arguments" ? 0 : g.title == kOwnGroup ? 2 : 1; };
  std::stable_sort(groups.begin(), groups.end(),
                   [&](const OptionGroup& x, const OptionGroup& y) { return rank(x) < rank(y); });
  return groups;
}

std::vector<CommandGroup> command_groups(const CLI::App& app) {
  std::vector<CommandGroup> groups;
  for (const CLI::App* command : app.get_subcommands({})) {
    if (command->get_group().empty()) continue;
    const std::string title = command->get_group() == "Subcommands" ? "Commands" : command->get_group();
    auto group = std::find_if(groups.begin(), groups.end(), [&](const CommandGroup& g) { return g.title == title; });
    if (group == groups.end()) group = groups.insert(groups.end(), {title, {}});
    group->commands.push_back(command);
  }
  return groups;
}

const CLI::App* find_command(const CLI::App& app, const std::string& name) {
  const auto commands = app.get_subcommands([&](const CLI::App* command) { return command->get_name() == name; });
  return commands.empty() ? nullptr : commands.front();
}

std::string full_name(const CLI::App& command) {
  return command.get_parent() == nullptr ? command.get_name()
                                         : full_name(*command.get_parent()) + " " + command.get_name();
}

std::string synopsis(const CLI::App& command) {
  std::string text = full_name(command);
  if (!command.get_subcommands([](const CLI::App*) { return true; }).empty()) text += " COMMAND";
  text += " [OPTIONS]";
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_positional() || !shown(*option)) continue;
    const OptionUsage usage = usage_of(*option);
    const std::string one = usage.value + (usage.several ? "..." : "");
    text += option->get_required() ? " " + one : fmt::format(" [{}]", one);
  }
  return text;
}

std::pair<std::string, std::string> description_of(const CLI::App& command) {
  const std::string text = command.get_description();
  const std::size_t end = std::min(text.find('\n'), text.size());
  return {text.substr(0, end), text.substr(std::min(end + 1, text.size()))};
}

const std::vector<ExitMeaning>& exit_meanings() {
  static const std::vector<ExitMeaning> meanings{
      {kCertified, "certified, or what was asked holds"},
      {kRefuted, "refuted"},
      {kBadInput, "bad usage or bad input"},
      {kHarnessInvalid, "harness invalid: the engine did not start, broke the protocol or never answered"},
      {kOracleFault, "oracle fault: the oracles disagree with each other"},
      {kInterrupted, "interrupted; nothing was written"}};
  return meanings;
}

}  // namespace contact::tool
