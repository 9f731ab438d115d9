// The parser of the command line: every command, and what its options may hold.
#include "tool/commands/commands.hpp"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <sstream>

#include "formats/input_error.hpp"
#include "formats/program.hpp"
#include "formats/whole_number.hpp"
#include "tool/commands/help.hpp"
#include "tool/run/cluster.hpp"
#include "tool/run/printing.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {

std::string golden_folder() {
  const std::filesystem::path& data = formats::data_folder();
  if (data.empty())
    throw formats::InputError({formats::program().string(), 0}, "",
                              "no golden files lie beside the program (share/contact-oracle): name a dataset");
  return std::filesystem::canonical(data / "golden");
}

std::string chosen_folder(const std::string& given) {
  if (!given.empty()) return given;
  if (Cluster::is_first()) say("golden files: {}\n", golden_folder());
  return golden_folder();
}

void require_folder(const std::string& command, const std::string& option, const std::string& folder) {
  if (folder.empty()) throw formats::InputError({command, 0}, option, "writes into a folder: name it");
}

void make_folder(const std::filesystem::path& folder, const std::string& option) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder, error))
    throw formats::InputError({folder.string(), 0}, option, "no folder, and none can be made here");
}

void require_apart(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs) {
  std::error_code absent;  // what is not there is not the same
  for (const std::string& output : outputs)
    for (const std::string& input : inputs)
      if (std::filesystem::equivalent(output, input, absent) && std::filesystem::is_regular_file(input, absent))
        throw formats::InputError({output, 0}, "", "is read by this run, and would be written over");
}

std::uint64_t seed_or_fresh(std::optional<std::uint64_t> given) {
  std::random_device entropy;
  return given.value_or((static_cast<std::uint64_t>(entropy()) << 20) ^ entropy());
}

void require_alone(const CLI::App& command, const std::string& option) {
  // By what they are: an option that help does not show has no name.
  const CLI::Option* alone = command.get_option(option);
  for (const CLI::Option* other : command.get_options())
    if (other->count() != 0 && other != alone)
      throw formats::InputError({command.get_name(), 0}, option,
                                fmt::format("does nothing else: {} would be ignored", other->get_name()));
}

namespace {

/// Of numbers up to 2^bits - 1.
CLI::Validator whole_number(std::string name, std::uint64_t least, int bits) {
  return CLI::Validator(
      [least, bits](const std::string& text) {
        const auto number = formats::whole_number<std::uint64_t>(text);
        if (number && *number >= least && *number <= ~std::uint64_t{0} >> (64 - bits)) return std::string();
        return fmt::format("expected a whole number from {} to 2^{} - 1, got '{}'", least, bits, text);
      },
      std::move(name));
}

}  // namespace

const CLI::Validator kFromZero = whole_number("0..", 0, 64);
const CLI::Validator kCount = whole_number("0..", 0, 32);
const CLI::Validator kFromOne = whole_number("1..", 1, 32);
const CLI::Validator kThreads = whole_number("1..", 1, 16);
const CLI::Validator kSeconds(
    [](const std::string& text) {
      char* end = nullptr;
      const double seconds = std::strtod(text.c_str(), &end);
      const bool good = end == text.c_str() + text.size() && seconds > 0 && seconds <= 1e9;
      return good ? std::string() : fmt::format("expected seconds, more than 0 and at most 1e9, got '{}'", text);
    },
    "SECONDS");
const CLI::Validator kLength(
    [](const std::string& text) {
      char* end = nullptr;
      const double length = std::strtod(text.c_str(), &end);
      const bool good = !text.empty() && end == text.c_str() + text.size() && length >= 0 && std::isfinite(length);
      return good ? std::string() : fmt::format("expected a length, a number from 0, got '{}'", text);
    },
    "LENGTH");

namespace {

/// What every command takes, wherever it stands.
void add_common_options(CLI::App& app) {
  app.add_flag_function(
      "--quiet", [](std::int64_t) { be_quiet(); },
      "Print nothing but data that was asked for: the exit status is the verdict, and errors are told all the same");
  app.add_option_function<std::string>(
         "--color",
         [](const std::string& when) {
           const auto it = std::find(kColourNames.begin(), kColourNames.end(), when);
           choose_colour(static_cast<Colour>(it - kColourNames.begin()));
         },
         "Colours on standard output: auto is at a terminal, unless NO_COLOR is set")
      ->type_name("WHEN")
      ->check(CLI::IsMember(kColourNames));
  app.fallthrough();
}

// An empty value is a variable of a script that was not set: what it was to name must not be taken for not given.

/// CLI11 takes the next word for the value of "--option=".
void refuse_options_that_end_in_an_equals_sign(const std::vector<std::string>& words) {
  for (const std::string& word : words)
    if (word.starts_with("--") && word.find('=') + 1 == word.size())
      throw formats::InputError({"command line", 0}, word.substr(0, word.size() - 1), "expected something, got ''");
}

void refuse_empty_values(CLI::App& command) {
  static const CLI::Validator something(
      [](const std::string& value) {
        return value.empty() ? std::string("expected something, got ''") : std::string();
      },
      "");
  for (CLI::Option* option : command.get_options())
    if (option->get_items_expected_max() != 0) option->transform(something);  // before other checks
  for (CLI::App* inner : command.get_subcommands({}))
    if (inner->get_name() != kCompleteName) refuse_empty_values(*inner);
}

}  // namespace

int run_command(int argc, const char* const* argv) {
  CLI::App app{
      "Verified reference and test oracle for discrete collision\n"
      "It holds collision engines against golden files and exact arithmetic, for the pairs of shapes of SOFA's "
      "DiscreteIntersection and more."};
  app.name("contact-oracle");
  app.set_version_flag("--version", "contact-oracle " + formats::version_and_commit());
  app.require_subcommand(1);
  app.formatter(help_formatter());
  add_common_options(app);
  int exit = kCertified;
  for (const HeadedCommands& headed : program_commands()) {
    const std::size_t before = app.get_subcommands({}).size();
    for (const auto add : headed.adds) add(app, exit);
    const std::vector<CLI::App*> all = app.get_subcommands({});
    for (std::size_t i = before; i < all.size(); ++i)
      if (all[i]->get_group() == "Subcommands") all[i]->group(headed.heading);
  }
  app.set_help_all_flag("--help-all", "Print every command and exit");  // of the program alone: it comes last
  app.failure_message([](const CLI::App* command, const CLI::Error& error) {
    // CLI11's message begins with the error, which quotes the command line.
    const std::string what = error.what();
    return formats::visible(what) + CLI::FailureMessage::simple(command, error).substr(what.size());
  });
  refuse_empty_values(app);
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (!words.empty() && words.front() != kCompleteName) refuse_options_that_end_in_an_equals_sign(words);
  // What CLI11 says quotes the words, which may be long.
  const auto told = [&](const CLI::Error& error) {
    std::ostringstream output;
    std::ostringstream errors;
    const int status = app.exit(error, output, errors);
    std::cout << output.str();
    std::cerr << cut(errors.str());
    return status;
  };
  try {
    app.parse(argc, argv);
  } catch (const CLI::RequiredError& error) {
    const std::vector<std::string> unknown = app.remaining();
    if (app.get_subcommands().empty() && !unknown.empty()) {
      say_error("contact-oracle: unknown command '{}'; `contact-oracle help all` lists them\n", cut(unknown.front()));
      return kBadInput;
    }
    told(error);
    return kBadInput;
  } catch (const CLI::ParseError& error) {
    return told(error) == 0 ? kCertified : kBadInput;
  }
  return exit;
}

}  // namespace contact::tool
