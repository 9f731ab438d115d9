// The options that choose the engine.
#include "tool/commands/engine_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <vector>

#include "engines/adapters.hpp"
#include "engines/hosts/subprocess.hpp"
#include "engines/zoo/mutants.hpp"
#include "engines/zoo/unsteady.hpp"
#include "formats/program.hpp"
#include "tool/commands/commands.hpp"
#include "tool/commands/run_command.hpp"

namespace contact::tool {
namespace {

std::unique_ptr<engines::Engine> subprocess(const EngineOptions& options, std::vector<std::string> words,
                                            std::function<void()> check) {
  const auto milliseconds = [](double seconds) {
    return std::chrono::milliseconds(static_cast<std::int64_t>(seconds * 1000));
  };
  engines::SubprocessOptions process;
  process.command = std::move(words);
  process.processes = std::max<std::size_t>(options.jobs, 1);
  process.start = milliseconds(options.start_limit);
  process.answer = milliseconds(options.answer_limit);
  process.check = std::move(check);
  return engines::make_subprocess(process);
}

/// This program again, which calls a library.
std::vector<std::string> library_words(const EngineOptions& options, const std::vector<std::string>& more) {
  std::vector<std::string> words{formats::program().string(), "serve", "--engine-library", options.library};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

}  // namespace

void add_engine_options(CLI::App& command, EngineOptions& options, bool recorded) {
  options.parsed = &command;
  const Heading heading(command, "Engine");
  auto* engine =
      command.add_option("--engine", options.engine, "An engine by name; `contact-oracle engines` lists them");
  auto* program = command
                      .add_option("--engine-command", options.command,
                                  "An engine in any language: a program that speaks the engine protocol, with its "
                                  "arguments; split as a shell splits words, without a shell")
                      ->type_name("\"CMD ARGS\"");
  auto* library = command
                      .add_option("--engine-library", options.library,
                                  "An engine as a shared library with the interface of contact/contact_engine.h")
                      ->type_name("FILE");
  std::vector<CLI::Option*> choices{engine, program, library};
  if (recorded)
    choices.push_back(
        command
            .add_option("--results", options.results,
                        "A results file: the recorded answers of an engine, JSON lines or columns (*.h5, *.npz)")
            ->type_name("FILE"));
  for (auto* one : choices)
    for (auto* other : choices)
      if (one != other) one->excludes(other);
  command.add_option("--points", options.points, "Contact points that a built-in engine computes")
      ->capture_default_str()
      ->check(CLI::IsMember(engines::kComputedPointsNames));
  command.add_option("--jobs", options.jobs, "Threads, and engine processes (default: a thread a core, one process)")
      ->check(kThreads);
  command.add_option("--start-limit", options.start_limit, "Seconds until an engine's hello")
      ->capture_default_str()
      ->check(kSeconds);
  command.add_option("--answer-limit", options.answer_limit, "Seconds until an engine's next answer")
      ->capture_default_str()
      ->check(kSeconds);
}

void require_used(const EngineOptions& options, bool threads) {
  const bool process =
      !options.command.empty() || !options.library.empty() || engines::find_adapter(options.engine) != nullptr;
  const auto refuse_if = [&](bool idle, const std::string& option, std::string_view why) {
    if (idle && options.parsed->count(option) != 0)
      throw formats::InputError({"command line", 0}, option, std::string(why));
  };
  refuse_if(process || !options.results.empty() || options.engine.starts_with(engines::kMutantPrefix), "--points",
            "chooses the points of a built-in engine that is no mutant; any other computes those that it declares");
  for (const char* limit : {"--start-limit", "--answer-limit"})
    refuse_if(!process, limit, "is for an engine in a process of its own, and this one is in none");
  refuse_if(!process && !threads, "--jobs", "is the number of engine processes here, and this engine is in none");
}

PointConvention computed_points(const EngineOptions& options) {
  return static_cast<PointConvention>(index_of(engines::kComputedPointsNames, options.points, "convention"));
}

std::unique_ptr<engines::Engine> built_in(const std::string& name, PointConvention points) {
  if (name.starts_with(engines::kMutantPrefix) || name.starts_with(engines::kUnsteadyPrefix)) {
    if (const MakeFromZoo make = program_zoo()) return make(name);
    throw formats::InputError(
        {"command line", 0}, "",
        fmt::format("'{}' is not in contact-certify, which has no engines with mistakes: ask contact-oracle", name));
  }
  if (name.starts_with(engines::kBatchPrefix)) {
    const std::vector<std::string> sets = engines::batch_instruction_sets();
    static_cast<void>(index_of(sets, name.substr(engines::kBatchPrefix.size()), "instruction set of this processor"));
    return engines::make_built_in(name, points);
  }
  std::vector<std::string_view> names;
  for (const engines::BuiltIn& e : engines::built_in_engines()) names.push_back(e.name);
  for (const engines::Adapter& a : engines::adapters()) names.push_back(a.name);
  names.emplace_back("mutant:ID");
  names.emplace_back("unsteady:ID");
  static_cast<void>(index_of(names, name, "engine"));
  if (auto engine = engines::make_built_in(name, points)) return engine;
  throw formats::InputError({"command line", 0}, "", fmt::format("engine '{}' is an adapter, and not built in", name));
}

std::vector<OtherHost> other_hosts(const EngineOptions& options, const std::function<void()>& check) {
  std::vector<OtherHost> hosts;
  const bool process = !options.command.empty() || engines::find_adapter(options.engine) != nullptr;
  if (!process && options.library.empty()) return hosts;
  EngineOptions several = options;
  several.jobs = kThreadsThatAsk;
  hosts.push_back({fmt::format("by {} processes", kThreadsThatAsk), make_engine(several, check)});
  if (!options.library.empty())
    hosts.push_back(
        {fmt::format("from {} threads of a process", kThreadsThatAsk),
         subprocess(options, library_words(options, {"--threads", std::to_string(kThreadsThatAsk)}), check)});
  return hosts;
}

std::unique_ptr<engines::Engine> make_engine(const EngineOptions& options, std::function<void()> check) {
  if (!options.results.empty()) return engines::make_recorded(options.results, options.rows);
  if (!options.command.empty()) {
    std::vector<std::string> words;
    try {
      words = engines::split_words(options.command);
    } catch (const std::invalid_argument& error) {
      throw formats::InputError({"--engine-command", 0}, "", error.what());
    }
    if (words.empty()) throw formats::InputError({"--engine-command", 0}, "", "names no program");
    return subprocess(options, std::move(words), std::move(check));
  }
  if (!options.library.empty()) {
    if (!std::filesystem::is_regular_file(options.library))
      throw formats::InputError({options.library, 0}, "",
                                std::filesystem::exists(options.library) ? "is no file" : "no such file");
    // This program again, so that a crash of the library is the other's end.
    return subprocess(options, library_words(options, {}), std::move(check));
  }
  if (const engines::Adapter* adapter = engines::find_adapter(options.engine)) {
    if (auto words = engines::command_of(*adapter)) return subprocess(options, std::move(*words), std::move(check));
    throw formats::InputError({"command line", 0}, "",
                              fmt::format("engine '{}' is not here; ./run engines installs it", adapter->name));
  }
  return built_in(options.engine.empty() ? "production" : options.engine, computed_points(options));
}

}  // namespace contact::tool
