// digests: do the answers to many more questions than are committed still have the digests of the manifest?
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <memory>

#include "golden/production.hpp"
#include "tool/commands/commands.hpp"
#include "tool/run/digests.hpp"
#include "tool/run/printing.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {

namespace {

struct DigestsOptions {
  std::string folder;
  std::uint64_t count = golden::kManyAnswers;
  bool production = false;
  bool write = false;
  bool force = false;
};

std::string production_bytes(const Query& query, Scalar) { return golden::production_bytes(query); }

void write(const DigestsOptions& o) {
  const auto recorded = golden::recorded_digests(o.folder);
  const Most most = o.count < golden::kMostAnswers ? Most::keep : o.force ? Most::anew : Most::fill;
  std::size_t written = 0;
  try {
    for (const golden::CommittedFile& stream : golden::committed_files()) {
      const auto file = recorded.find(stream.path());
      if (file == recorded.end())
        throw formats::InputError({o.folder, 0}, "", fmt::format("the manifest does not list {}", stream.path()));
      golden::Digests digests = renewed_digests(stream, file->second, most);
      digests.insert(file->second.digests.begin(), file->second.digests.lower_bound(golden::many_answers(stream.pair)));
      golden::record_digests(o.folder, stream.path(), digests);
      ++written;
    }
  } catch (const Interrupted&) {
    throw Interrupted(fmt::format("interrupted; {} files are done, and will not be done again", written));
  }
  say("{}: digests of {} generators' answers\n", o.folder, written);
}

/// Whether every recorded digest is what the answers give, and that of many answers is recorded.
bool check(const DigestsOptions& o) {
  const auto recorded = golden::recorded_digests(o.folder);
  std::size_t right = 0;
  std::size_t wrong = 0;
  for (const golden::CommittedFile& stream : golden::committed_files()) {
    if (o.production && !golden::production_answers(stream)) continue;
    std::vector<std::uint64_t> counts;
    const auto file = recorded.find(stream.path());
    const golden::Digests none;
    const golden::Digests& digests = file == recorded.end() ? none : file->second.digests;
    for (const std::uint64_t count : {golden::many_answers(stream.pair), golden::kMostAnswers}) {
      if (count > o.count) continue;
      if (digests.contains(count)) {
        counts.push_back(count);
        continue;
      }
      // That of the most answers is made where there is time for it.
      if (count < golden::kMostAnswers) ++wrong;
      say("{}: no digest of {} answers\n", stream.path(), count);
    }
    if (counts.empty()) continue;
    const auto found =
        digests_of(stream, golden::kCommittedSeed, 0, counts, o.production ? production_bytes : oracle_bytes);
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const bool same = digests.at(counts[i]) == found[i];
      ++(same ? right : wrong);
      if (!same)
        say("{}: the manifest says {} for {} answers, {} gives {}\n", stream.path(), digests.at(counts[i]), counts[i],
            o.production ? "production" : "the oracle", found[i]);
    }
  }
  say("{} digests right, {} wrong or missing\n", right, wrong);
  return wrong == 0;
}

}  // namespace

void add_digests(CLI::App& app, int& exit) {
  auto* command =
      app.add_subcommand("digests",
                         "Whether the manifest's digests are those of the answers\n"
                         "They are of the answers to the first 10000, or 1000000, questions of every generator.");
  auto o = std::make_shared<DigestsOptions>();
  command->add_option("folder", o->folder, fmt::format("A folder with a manifest (default: {})", kCommitted))
      ->type_name("FOLDER");
  command->add_option("--count", o->count, "10000, or 1000000: both are looked at")
      ->capture_default_str()
      ->check(CLI::IsMember({golden::kManyAnswers, golden::kMostAnswers}));
  auto* production =
      command->add_flag("--production", o->production,
                        "Ask production instead of the exact oracle, where it rounds to the file's scalar");
  auto* write_flag =
      command->add_flag("--write", o->write,
                        "Write the digests; of 1000000 answers only where they are missing or the generator changed");
  write_flag->excludes(production);
  command->add_flag("--force", o->force, "With --write and --count 1000000: all of them anew")->needs(write_flag);
  command->callback([o, &exit] {
    if (o->write) require_folder("digests", "--write", o->folder);
    if (o->force && o->count < golden::kMostAnswers)
      throw formats::InputError({"digests", 0}, "--force",
                                fmt::format("is for the digests of {0} answers: --count {0}", golden::kMostAnswers));
    o->folder = chosen_folder(o->folder);
    if (!std::filesystem::exists(std::filesystem::path(o->folder) / golden::kManifestName))
      throw formats::InputError({o->folder, 0}, "", fmt::format("no {} in this folder", golden::kManifestName));
    if (o->write) write(*o);
    exit = o->write || check(*o) ? kCertified : kRefuted;
  });
}

}  // namespace contact::tool
