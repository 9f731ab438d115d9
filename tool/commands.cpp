// The parser of the command line: every command, and what its options may hold.
#include "tool/commands.hpp"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdio>
#include <filesystem>

#include "tool/process.hpp"

namespace contact::tool {

std::string golden_folder() { return std::filesystem::is_directory("golden") ? "golden" : CONTACT_GOLDEN_DIR; }

namespace {

CLI::Validator whole_number(std::string name, bool zero_allowed) {
  return CLI::Validator(
      [zero_allowed](const std::string& text) {
        const bool digits = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
        const bool zero = text.find_first_not_of('0') == std::string::npos;
        if (digits && (zero_allowed || !zero)) return std::string();
        return fmt::format("expected a whole number from {}, got '{}'", zero_allowed ? 0 : 1, text);
      },
      std::move(name));
}

}  // namespace

const CLI::Validator kFromZero = whole_number("0..", true);
const CLI::Validator kFromOne = whole_number("1..", false);
const CLI::Validator kSeconds(
    [](const std::string& text) {
      double seconds = 0;
      const bool good = CLI::detail::lexical_cast(text, seconds) && seconds > 0 && seconds <= 1e9;
      return good ? std::string() : fmt::format("expected seconds, more than 0 and at most 1e9, got '{}'", text);
    },
    "SECONDS");

int run_command(int argc, const char* const* argv) {
  CLI::App app{
      "Verified reference and test oracle for discrete collision between cubes and spheres (SOFA's "
      "DiscreteIntersection).\n"
      "Exit: 0 certified or holds, 1 refuted, 2 bad usage or input, 3 harness invalid, 4 oracle fault."};
  app.name("contact-oracle");
  app.set_version_flag("--version", std::string("contact-oracle ") + CONTACT_VERSION);
  app.require_subcommand(1);
  int exit = kCertified;
  add_certify(app, exit);
  add_compare(app, exit);
  add_explain(app, exit);
  add_generate(app, exit);
  add_regenerate(app, exit);
  add_annotate(app, exit);
  add_convert(app, exit);
  add_serve(app, exit);
  add_properties(app, exit);
  add_lint(app, exit);
  add_merge(app, exit);
  add_verify(app, exit);
  add_digests(app, exit);
  add_adequacy(app, exit);
  add_detect(app, exit);
  add_lists(app, exit);
  try {
    app.parse(argc, argv);
  } catch (const CLI::RequiredError& error) {
    if (argc > 1 && argv[1][0] != '-' && app.get_subcommands().empty()) {
      fmt::print(stderr, "contact-oracle: unknown command '{}'; --help lists them\n", argv[1]);
      return kBadInput;
    }
    app.exit(error);
    return kBadInput;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kCertified : kBadInput;
  }
  return exit;
}

}  // namespace contact::tool
