// merge: the parts of a run, judged anywhere, make the report that one run would have made.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <filesystem>
#include <map>
#include <memory>

#include "formats/input_error.hpp"
#include "tool/commands/commands.hpp"
#include "tool/reports/report_files.hpp"
#include "tool/run/parts.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {
namespace {

struct MergeOptions {
  std::vector<std::string> paths;
  ReportOptions reports;
};

using formats::InputError;

/// The files of parts among what is given: a folder gives those in it.
std::vector<std::filesystem::path> part_files(const std::vector<std::string>& given) {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path path : given) {
    if (!std::filesystem::is_directory(path)) {
      files.push_back(path);
      continue;
    }
    const std::size_t before = files.size();
    for (const auto& entry : std::filesystem::directory_iterator(path))
      if (entry.path().extension() == ".part") files.push_back(entry.path());
    if (files.size() == before) throw InputError({path.string(), 0}, "", "no part of a run (*.part) in this folder");
    std::sort(files.begin() + static_cast<std::ptrdiff_t>(before), files.end());
  }
  return files;
}

int merge_parts(const MergeOptions& options) {
  const std::vector<std::filesystem::path> paths = part_files(options.paths);
  const ReportOptions& out = options.reports;
  require_apart({out.html, out.json, out.junit, out.markdown}, {paths.begin(), paths.end()});
  ReportFiles files(out);
  // First all are read and compared, one at a time; then merged in their order.
  std::map<std::uint64_t, std::filesystem::path> parts;
  std::vector<Report> reports;
  std::string run;
  std::uint64_t of = 0;
  for (const auto& path : paths) {
    throw_if_interrupted();
    const PartFile file = read_part(path);
    if (parts.empty()) {
      run = file.run;
      of = file.part.of;
      reports.push_back(report_of(file));
    }
    const std::string first = parts.empty() ? "" : parts.begin()->second.string();
    require_run(file, run, first);
    const formats::Location where{path.string(), 1};
    if (file.part.of != of)
      throw InputError(where, "part", fmt::format("one of {} parts here, one of {} in {}", file.part.of, of, first));
    const auto [there, is_new] = parts.emplace(file.part.index, path);
    if (!is_new)
      throw InputError(where, "part",
                       fmt::format("part {} stands in {} already", file.part.index, there->second.string()));
  }
  if (parts.size() != of) {
    constexpr std::size_t kNamed = 20;
    std::vector<std::uint64_t> missing;  // the first of them: nobody has room for all of which a part may tell
    for (std::uint64_t i = 0; i < of && missing.size() < kNamed; ++i)
      if (!parts.contains(i)) missing.push_back(i);
    throw InputError({options.paths.front(), 0}, "",
                     fmt::format("{} of {} parts missing: {}", of - parts.size(), of, fmt::join(missing, ", ")));
  }
  for (const auto& [index, path] : parts) merge(reports, read_part(path).content, index == 0);
  files.write(reports);
  return files.print(reports, false);
}

}  // namespace

void add_merge(CLI::App& app, int& exit) {
  auto* command = app.add_subcommand("merge", "The report of a run from the parts that certify --shard left");
  auto options = std::make_shared<MergeOptions>();
  command->add_option("parts", options->paths, "Parts, or folders of them")->required();
  add_report_options(*command, options->reports);
  command->callback([options, &exit] { exit = merge_parts(*options); });
}

}  // namespace contact::tool
