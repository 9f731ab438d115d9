// lint: are golden files well formed, canonical, and is every expectation right?
#include "golden/lint.hpp"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <memory>

#include "formats/output_file.hpp"
#include "golden/manifest.hpp"
#include "tool/commands/commands.hpp"
#include "tool/run/digests.hpp"
#include "tool/run/printing.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {
namespace {

struct LintOptions {
  std::vector<std::string> paths;
  bool generated = false;
  bool write_manifest = false;
};

bool is_of(const golden::DatasetHeader& h, const golden::CommittedFile& stream) {
  return h.pair == stream.pair && h.scalar == stream.scalar && h.family == stream.family->name &&
         h.seed == golden::kCommittedSeed && !h.shard;
}

golden::LintedFile lint_file(const std::filesystem::path& path, bool generated) {
  Progress progress(path.filename().string(), golden::dataset_header(path).count);
  golden::LintedFile file = golden::lint(path, generated, [&] {
    throw_if_interrupted();
    progress.add(1);
  });
  if (file.header.count == 0 && !file.header.shard)
    throw formats::InputError({path.string(), 1}, "count", "a golden file holds at least one case, got 0");
  return file;
}

/// Completes the entries of a folder's manifest. The digests of a generator's answers are made anew where it is
/// written, but for the one that takes long; else `contact-oracle digests` is what looks at them.
void add_what_files_do_not_tell(std::vector<golden::ManifestEntry>& entries, const std::string& folder, bool write) {
  const auto recorded = golden::recorded_digests(folder);
  const auto kills = golden::recorded_kills(folder, entries);
  const auto streams = golden::committed_files();
  for (golden::ManifestEntry& entry : entries) {
    const auto it = recorded.find(entry.path);
    const golden::Recorded old = it == recorded.end() ? golden::Recorded{} : it->second;
    const auto stream = std::find_if(streams.begin(), streams.end(), [&](const golden::CommittedFile& s) {
      return s.path() == entry.path && is_of(entry.file.header, s);
    });
    if (stream != streams.end()) entry.digests = write ? renewed_digests(*stream, old, Most::keep) : old.digests;
    entry.digests[entry.file.header.count] = entry.file.answers;
    if (const auto killed = kills.find(entry.path); killed != kills.end()) entry.kills = killed->second;
  }
}

void lint(const LintOptions& o) {
  std::uint64_t cases = 0;
  std::size_t files = 0;
  for (const std::string& path : o.paths)
    if (o.write_manifest && std::filesystem::exists(path) && !std::filesystem::is_directory(path))
      throw formats::InputError({path, 0}, "--write-manifest", "is for folders");
  for (const std::string& path : o.paths) {
    // The files of one argument are worked on side by side; a folder with a manifest must agree with it.
    const auto found = golden::dataset_files({path}, true);
    std::vector<golden::ManifestEntry> entries(found.size());
    in_parallel(found.size(), [&](std::size_t i) {
      const auto relative =
          std::filesystem::is_directory(path) ? found[i].lexically_relative(path) : found[i].filename();
      entries[i] = {relative.generic_string(), lint_file(found[i], o.generated), {}};
    });
    for (const golden::ManifestEntry& entry : entries) cases += entry.file.header.count;
    files += entries.size();
    const std::filesystem::path manifest = std::filesystem::path(path) / golden::kManifestName;
    if (!o.write_manifest && !std::filesystem::exists(manifest)) continue;
    add_what_files_do_not_tell(entries, path, o.write_manifest);
    if (o.write_manifest) {
      formats::OutputFile file(manifest);
      file.write(golden::manifest_text(entries));
      file.commit();
    } else {
      golden::check_manifest(path, entries);
    }
  }
  say("{} cases in {} files: well formed, canonical, every expectation right\n", cases, files);
}

}  // namespace

void add_lint(CLI::App& app, int& exit) {
  auto* command = app.add_subcommand(
      "lint", "Whether golden files are well formed, and every expectation right\nA folder's manifest is checked too.");
  auto o = std::make_shared<LintOptions>();
  command->add_option("datasets", o->paths, "Golden files or folders")->required();
  command->add_flag("--generated", o->generated, "Allow a generated file to repeat a question");
  command->add_flag("--write-manifest", o->write_manifest, "Write the manifest of each folder instead of checking it");
  command->callback([o, &exit] {
    lint(*o);
    exit = kCertified;
  });
}

}  // namespace contact::tool
