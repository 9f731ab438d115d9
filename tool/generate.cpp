// generate and annotate: golden files from a seeded family, or from a user's own questions.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <sstream>
#include <unordered_set>

#include "golden/dataset.hpp"
#include "golden/digest.hpp"
#include "golden/families.hpp"
#include "golden/output_file.hpp"
#include "golden/query_id.hpp"
#include "tool/commands.hpp"
#include "tool/digests.hpp"
#include "tool/process.hpp"

namespace contact::tool {
namespace {

using golden::InputError;

struct GenerateOptions {
  std::string pair;
  std::string family;
  std::string scalar = "binary64";
  std::uint64_t count = 0;
  std::uint64_t seed = 0;
  std::optional<std::string> shard;
  std::string output;
  bool digest = false;
};

golden::Shard read_shard(const std::string& text) {
  golden::Shard shard{};
  char slash = 0;
  std::istringstream stream(text);
  stream >> shard.index >> slash >> shard.of;
  if (!stream || slash != '/' || !stream.eof() || text.find('-') != std::string::npos || shard.of == 0 ||
      shard.index >= shard.of)
    throw InputError({"generate", 0}, "--shard", fmt::format("expected I/N with I below N, got '{}'", text));
  return shard;
}

/// Writes a header and the cases of `count` questions, worked out on every thread and written in order. Gives the
/// digest of their answers.
std::string write_dataset(const golden::DatasetHeader& header, const std::string& path,
                          const std::function<Query(std::uint64_t)>& question) {
  golden::OutputFile file(path);
  file.write(to_line(header) + "\n");
  golden::Sha256 digest;
  Progress progress(fmt::format("{}/{}", name(header.pair), header.family), header.count);
  for (std::uint64_t begin = 0; begin < header.count; begin += kRun) {
    throw_if_interrupted();
    std::vector<std::pair<std::string, std::string>> made(std::min<std::uint64_t>(kRun, header.count - begin));
    in_parallel(made.size(), [&](std::size_t i) {
      const golden::Case c = golden::make_case(question(begin + i), header.scalar);
      made[i] = {to_line(c) + "\n", golden::digest_bytes(c)};
    });
    for (const auto& [line, answer] : made) {
      file.write(line);
      digest.add(answer);
    }
    progress.add(made.size());
  }
  file.commit();
  return digest.hex();
}

void check_output(const std::string& command, const std::string& path) {
  if (!path.ends_with(".jsonl"))
    throw InputError({command, 0}, "-o", fmt::format("the name of a dataset ends in .jsonl, got '{}'", path));
}

void generate(const GenerateOptions& o) {
  const golden::Location where{"generate", 0};
  const auto pair = std::find_if(kPairs.begin(), kPairs.end(), [&](Pair p) { return name(p) == o.pair; });
  if (pair == kPairs.end()) {
    std::vector<std::string_view> names;
    for (const Pair p : kPairs) names.push_back(name(p));
    throw InputError(where, "--pair", fmt::format("unknown pair '{}'; known: {}", o.pair, fmt::join(names, ", ")));
  }
  const golden::Family* family = golden::find_family(*pair, o.family);
  if (family == nullptr) {
    std::vector<std::string_view> names;
    for (const golden::Family& f : golden::families_of(*pair)) names.push_back(f.name);
    throw InputError(where, "--family",
                     fmt::format("unknown family '{}' of {}; known: {}", o.family, o.pair, fmt::join(names, ", ")));
  }
  if (!o.digest || !o.output.empty()) check_output("generate", o.output);
  golden::DatasetHeader header;
  header.pair = *pair;
  header.scalar = o.scalar == name(Scalar::binary32) ? Scalar::binary32 : Scalar::binary64;
  header.family = o.family;
  header.seed = o.seed;
  header.count = o.count;
  std::uint64_t first = 0;
  if (o.shard) {
    // Shard I of N of C questions holds those from floor(I C / N) to below floor((I + 1) C / N).
    header.shard = read_shard(*o.shard);
    const auto cut = [&](std::uint64_t i) {
      return o.count / header.shard->of * i + o.count % header.shard->of * i / header.shard->of;
    };
    first = cut(header.shard->index);
    header.count = cut(header.shard->index + 1) - first;
  }
  if (o.output.empty()) {
    const golden::CommittedFile stream{header.pair, header.scalar, family};
    fmt::print("{}\n", digests_of(stream, header.seed, first, {header.count}, golden::digest_bytes).front());
    return;
  }
  const std::string digest = write_dataset(header, o.output, [&](std::uint64_t i) {
    return golden::generate_query(header.pair, *family, header.scalar, header.seed, first + i);
  });
  fmt::print("{}: {} cases\n", o.output, header.count);
  if (o.digest) fmt::print("{}\n", digest);
}

void regenerate(const std::string& folder) {
  for (const golden::CommittedFile& file : golden::committed_files()) {
    const std::filesystem::path path = std::filesystem::path(folder) / file.path();
    std::filesystem::create_directories(path.parent_path());
    golden::DatasetHeader header;
    header.pair = file.pair;
    header.scalar = file.scalar;
    header.family = file.family->name;
    header.seed = golden::kCommittedSeed;
    header.count = golden::kCommittedCount;
    write_dataset(header, path.string(), [&](std::uint64_t i) {
      return golden::generate_query(file.pair, *file.family, file.scalar, header.seed, i);
    });
  }
  fmt::print("{}: {} files of {} cases\n", folder, golden::committed_files().size(), golden::kCommittedCount);
}

struct AnnotateOptions {
  std::string input;
  std::string output;
  std::string family = "annotated";
};

void annotate(const AnnotateOptions& o) {
  check_output("annotate", o.output);
  if (o.family.empty()) throw InputError({"annotate", 0}, "--family", "a family has a name");
  if (golden::find_family(Pair::sphere_sphere, o.family) != nullptr ||
      golden::find_family(Pair::cube_cube, o.family) != nullptr)
    throw InputError({"annotate", 0}, "--family",
                     fmt::format("'{}' is a family of the generator's: choose another name", o.family));
  InputLines lines(o.input);
  golden::DatasetHeader header;
  header.family = o.family;
  std::vector<Query> queries;
  std::unordered_set<std::string> ids;
  while (lines.next()) {
    const golden::Location& where = lines.where();
    const auto json = golden::parse_object(lines.text(), where);
    const golden::Node node(json, where);
    const golden::ReadQuery read = golden::read_query(node);
    if (queries.empty()) {
      header.pair = read.query.pair;
      header.scalar = read.scalar;
    }
    if (read.query.pair != header.pair || read.scalar != header.scalar)
      throw InputError(where, read.query.pair != header.pair ? "pair" : "scalar",
                       fmt::format("one pair and one scalar a file: {} {} before, {} {} here", name(header.pair),
                                   name(header.scalar), name(read.query.pair), name(read.scalar)));
    if (!ids.insert(golden::query_line(read.query, read.scalar)).second)
      throw InputError(where, "id", "the same question stands in this file twice");
    queries.push_back(read.query);
  }
  if (queries.empty()) throw InputError(lines.where(), "", "no question in this file");
  header.count = queries.size();
  write_dataset(header, o.output, [&](std::uint64_t i) { return queries[i]; });
  fmt::print("{}: {} cases\n", o.output, header.count);
}

}  // namespace

void add_generate(CLI::App& app, int& exit) {
  auto* command = app.add_subcommand(
      "generate", "Write a golden file of a family: a pure function of pair, family, scalar, seed and index");
  auto o = std::make_shared<GenerateOptions>();
  command->add_option("--pair", o->pair, "sphere_sphere, rigid_sphere_rigid_sphere, sphere_rigid_sphere or cube_cube")
      ->required();
  command->add_option("--family", o->family, "A family; `contact-oracle families` lists them")->required();
  command->add_option("--count", o->count, "How many questions")->required()->check(kFromOne);
  command->add_option("--seed", o->seed, "The seed")->required()->check(kFromZero);
  command->add_option("--scalar", o->scalar, "binary32 or binary64")
      ->capture_default_str()
      ->check(CLI::IsMember({"binary32", "binary64"}));
  command->add_option("--shard", o->shard, "I/N: only part I (from 0) of N, itself a dataset");
  command->add_option("-o,--output", o->output, "The file, *.jsonl; may be left out with --digest");
  command->add_flag("--digest", o->digest, "Print the SHA-256 of the answers, docs/formats.md#digests");
  command->callback([o, &exit] {
    generate(*o);
    exit = kCertified;
  });
}

void add_regenerate(CLI::App& app, int& exit) {
  auto* command = app.add_subcommand(
      "regenerate", "Write anew every committed golden file that a family makes (then: lint --write-manifest)");
  auto folder = std::make_shared<std::string>("golden");
  command->add_option("folder", *folder, "Where golden/ stands")->capture_default_str();
  command->callback([folder, &exit] {
    regenerate(*folder);
    exit = kCertified;
  });
}

void add_annotate(CLI::App& app, int& exit) {
  auto* command = app.add_subcommand("annotate", "Make a golden file of your own questions (JSON lines)");
  auto o = std::make_shared<AnnotateOptions>();
  command->add_option("queries", o->input, "The questions, or - for standard input")->required();
  command->add_option("-o,--output", o->output, "The file, *.jsonl")->required();
  command->add_option("--family", o->family, "The name of the family that they make")->capture_default_str();
  command->callback([o, &exit] {
    annotate(*o);
    exit = kCertified;
  });
}

}  // namespace contact::tool
