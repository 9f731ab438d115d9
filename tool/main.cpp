// contact-oracle: the command line.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cfenv>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <optional>

#include "engines/subprocess.hpp"
#include "golden/input_error.hpp"
#include "tool/cluster.hpp"
#include "tool/commands.hpp"
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

namespace {

int run(int argc, char** argv) {
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

}  // namespace
}  // namespace contact::tool

namespace contact::tool {
namespace {

/// Everything from the command line to the exit code, with whatever goes wrong told on standard error.
int guarded(int argc, char** argv) {
  try {
    const int exit = run(argc, argv);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      throw golden::InputError({"standard output", 0}, "", "cannot write");
    return exit;
  } catch (const golden::InputError& error) {
    fmt::print(stderr, "contact-oracle: {}\n", error.what());
    return kBadInput;
  } catch (const OracleFault& error) {
    fmt::print(stderr, "contact-oracle: ORACLE FAULT: {}\n", error.what());
    return kOracleFault;
  } catch (const engines::HarnessInvalid& error) {
    fmt::print(stderr, "contact-oracle: harness invalid: {}\n", error.what());
    return kHarnessInvalid;
  } catch (const Interrupted& error) {
    fmt::print(stderr, "contact-oracle: {}\n", error.what());
    return kInterrupted;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "contact-oracle: not enough memory\n");
    return kBadInput;
  } catch (const std::exception& error) {
    fmt::print(stderr, "contact-oracle: {}\n", error.what());
    return kBadInput;
  }
}

}  // namespace
}  // namespace contact::tool

int main(int argc, char** argv) {
  using namespace contact;
  // Before main only others can have changed it, such as a library that was built with -ffast-math. Threads inherit it.
  std::fesetenv(FE_DFL_ENV);
  tool::catch_signals();
  std::optional<tool::Cluster> cluster;
  try {
    cluster.emplace(argc, argv);
  } catch (const golden::InputError& error) {
    fmt::print(stderr, "contact-oracle: {}\n", error.what());
    return tool::kBadInput;
  }
  const int exit = tool::guarded(argc, argv);
  // A process that fails would leave the others waiting for it. One that merely refutes has nobody waiting.
  if (exit > tool::kRefuted) tool::Cluster::end_all(exit);
  return exit;
}
