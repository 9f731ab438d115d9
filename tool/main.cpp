// contact-oracle: the command line.
#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

#include <cfenv>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <optional>
#include <system_error>

#include "engines/hosts/subprocess.hpp"
#include "formats/input_error.hpp"
#include "golden/agreement.hpp"
#include "tool/commands/run_command.hpp"
#include "tool/run/cluster.hpp"
#include "tool/run/printing.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {
namespace {

/// What is visible already, and may have several lines.
void tell(std::string_view message) { std::cerr << "contact-oracle: " << cut(message) << "\n"; }

/// Exact numbers are up to megabytes long. What they give back is kept: the C library would return each to the system, and ask for it again.
void keep_freed_memory() {
#ifdef __GLIBC__
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
#endif
}

int told(const Interrupted& error) {
  say_error("contact-oracle: {}\n", cut(error.what()));
  return kInterrupted;
}

/// Everything from the command line to the exit code, with whatever goes wrong told on standard error.
int guarded(int argc, char** argv) {
  try {
    const int exit = run_command(argc, argv);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      throw formats::InputError({"standard output", 0}, "", "cannot write");
    return exit;
  } catch (const formats::InputError& error) {
    // Opening or reading what a signal ended says no more than that it failed.
    if (is_interrupted()) return told(Interrupted());
    tell(error.what());
    return kBadInput;
  } catch (const golden::OracleFault& error) {
    tell(fmt::format("ORACLE FAULT: {}", error.what()));
    return kOracleFault;
  } catch (const engines::HarnessInvalid& error) {
    say_error("contact-oracle: harness invalid: {}\n", cut(error.what()));
    return kHarnessInvalid;
  } catch (const Interrupted& error) {
    return told(error);
  } catch (const std::bad_alloc&) {
    tell("not enough memory");
    return kBadInput;
  } catch (const std::filesystem::filesystem_error& error) {
    const std::string path = error.path1().empty() ? "the working folder" : error.path1().native();
    say_error("contact-oracle: {}: {}\n", cut(path), error.code().message());
    return kBadInput;
  } catch (const std::system_error& error) {
    std::ferror(stdout) != 0 ? tell("standard output: cannot write")
                             : say_error("contact-oracle: {}\n", cut(error.what()));
    return kBadInput;
  } catch (const std::exception& error) {
    say_error("contact-oracle: {}\n", cut(error.what()));
    return kBadInput;
  } catch (...) {  // nothing of ours: a library's or a plug-in's
    tell("harness invalid: a library threw something that is no std::exception");
    return kHarnessInvalid;
  }
}

}  // namespace
}  // namespace contact::tool

int main(int argc, char** argv) {
  using namespace contact;
  // Before main only others can have changed it, such as a library that was built with -ffast-math. Threads inherit it.
  std::fesetenv(FE_DFL_ENV);
  tool::occupy_standard_streams();
  tool::keep_freed_memory();
  tool::catch_signals();
  tool::guard_output();
  std::optional<tool::Cluster> cluster;
  try {
    cluster.emplace(argc, argv);
  } catch (const formats::InputError& error) {
    tool::tell(error.what());
    return tool::kBadInput;
  }
  const int exit = tool::guarded(argc, argv);
  // A process that fails would leave the others waiting for it. One that merely refutes has nobody waiting.
  if (exit > tool::kRefuted) tool::Cluster::end_all(exit);
  return exit;
}
