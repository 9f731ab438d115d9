// generate, annotate, convert: golden files from a seeded family, a user's own questions, or other golden files.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <unordered_set>

#include "formats/sha256.hpp"
#include "golden/dataset.hpp"
#include "golden/dataset_writer.hpp"
#include "golden/families.hpp"
#include "golden/lint.hpp"
#include "golden/query_id.hpp"
#include "golden/right_case.hpp"
#include "tool/commands/commands.hpp"
#include "tool/run/cluster.hpp"
#include "tool/run/digests.hpp"
#include "tool/run/printing.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {
namespace {

using formats::InputError;
using golden::check_canonical;

struct GenerateOptions {
  std::string pair;
  std::string family;
  std::string scalar = std::string(name(Scalar::binary64));
  std::uint64_t count = 0;
  std::uint64_t seed = 0;
  std::optional<std::string> shard;
  bool resume = false;
  std::string output;
  bool digest = false;
  std::string all;  ///< folder
};

/// A bar for what one dataset, or many, are made of.
Progress progress_of(const std::string& label, std::uint64_t cases) {
  return Progress(label, Cluster::is_first() ? cases : 0);
}

/// Writes the cases of `count` questions, worked out on every thread of every process and written in order by the
/// first. Gives it the digest of their answers.
std::string write_dataset(const golden::DatasetHeader& header, const std::string& path,
                          const std::function<Query(std::uint64_t)>& question, Progress& progress) {
  const auto writer = Cluster::is_first() ? golden::create_dataset(path, header) : nullptr;
  formats::Sha256 digest;
  const auto work = [&](std::uint64_t run) {
    const std::uint64_t begin = run * kRun;
    std::vector<std::string> lines(std::min<std::uint64_t>(kRun, header.count - begin));
    in_parallel(lines.size(), [&](std::size_t i) {
      lines[i] = to_line(golden::make_case(question(begin + i), header.scalar)) + "\n";
    });
    return fmt::format("{}", fmt::join(lines, ""));
  };
  Cluster::in_order((header.count + kRun - 1) / kRun, work, [&](std::uint64_t /*run*/, std::string text) {
    const std::size_t size = text.size();
    text.resize(size + formats::Lines::kRoom);
    for (std::size_t begin = 0, end = 0; begin < size; begin = end + 1, progress.add(1)) {
      end = text.find('\n', begin);
      const std::string_view line = std::string_view(text).substr(begin, end - begin);
      const golden::Case c = golden::read_case(line, header, {path, 0});
      writer->write(c, line);
      digest.add(golden::digest_bytes(c));
    }
  });
  if (writer != nullptr) writer->commit();
  return digest.hex();
}

/// What is printed at the end of a command whose work processes share: once.
template <class... Args>
void say_once(fmt::format_string<const Args&...> format, const Args&... args) {
  if (Cluster::is_first()) say(format, args...);
}

void check_output(const std::string& command, const std::string& path) {
  if (!golden::names_dataset(path))
    throw InputError({command, 0}, "-o",
                     fmt::format("the name of a dataset ends in .jsonl, .h5 or .npz, got '{}'", path));
}

/// Refuses a file that is not the whole of what would be written: what stands there is never written over unasked.
/// Gives the digest of its answers.
std::string check_finished(const golden::DatasetHeader& header, const std::string& path,
                           const std::function<Query(std::uint64_t)>& question, Progress& progress) {
  golden::DatasetReader reader(path, golden::is_made);
  if (const auto found = to_line(reader.header()), expected = to_line(header); found != expected)
    throw InputError(
        {path, 0}, "",
        fmt::format("--resume found another dataset: its header is {}, and the one to write has {}", found, expected));
  formats::Sha256 digest;
  for (std::uint64_t i = 0; const auto c = reader.next(); ++i) {
    throw_if_interrupted();
    if (c->id != golden::query_id(question(i)))
      throw InputError(reader.where(), "id",
                       fmt::format("--resume found a question that does not belong there: {}", c->id));
    check_canonical(reader, to_line(*c));
    digest.add(golden::digest_bytes(*c));
    progress.add(1);
  }
  return digest.hex();
}

void generate_one(const GenerateOptions& o) {
  const formats::Location where{"generate", 0};
  for (const auto& [option, value] : {std::pair("--pair", o.pair), {"--family", o.family}})
    if (value.empty()) throw InputError(where, option, "missing, and only --all does without it");
  const Pair pair = named(kPairs, o.pair);
  const golden::Family* family = golden::find_family(pair, o.family);
  if (family == nullptr) {
    std::vector<std::string_view> names;
    for (const golden::Family& f : golden::families_of(pair)) names.push_back(f.name);
    throw InputError(where, "--family",
                     fmt::format("unknown family '{}' of {}; known: {}", o.family, o.pair, fmt::join(names, ", ")));
  }
  if (o.output.empty() && !o.digest)
    throw InputError(where, "--output", "missing, and only --digest does without a file");
  if (o.output.empty() && o.resume) throw InputError(where, "--resume", "keeps a file: name it, --output");
  if (!o.output.empty()) check_output("generate", o.output);
  golden::DatasetHeader header;
  header.pair = pair;
  header.scalar = named(kScalars, o.scalar);
  header.family = o.family;
  header.seed = o.seed;
  header.count = o.count;
  std::uint64_t first = 0;
  if (o.shard) {
    const golden::Shard shard = golden::read_shard(*o.shard, where, "--shard");
    header.shard = shard;
    first = golden::cut(o.count, shard.index, shard.of);
    header.count = golden::cut(o.count, shard.index + 1, shard.of) - first;
  }
  if (o.output.empty()) {
    // Nothing is shared among processes here, and what is printed is data.
    if (!Cluster::is_first()) return;
    const golden::CommittedFile stream{header.pair, header.scalar, family};
    fmt::print("{}\n", digests_of(stream, header.seed, first, {header.count}, oracle_bytes).front());
    return;
  }
  const auto question = [&](std::uint64_t i) {
    return golden::generate_query(header.pair, *family, header.scalar, header.seed, first + i);
  };
  Progress progress = progress_of(fmt::format("{}/{}", o.pair, o.family), header.count);
  const bool kept = o.resume && std::filesystem::exists(o.output);
  const std::string digest =
      kept ? check_finished(header, o.output, question, progress) : write_dataset(header, o.output, question, progress);
  say_once("{}: {} cases{}\n", o.output, header.count, kept ? ", kept as they stand there" : "");
  if (o.digest && Cluster::is_first()) fmt::print("{}\n", digest);
}

/// Refuses a file that something else made, as far as its header tells: it would be lost.
void require_own(const std::filesystem::path& path, golden::DatasetHeader own) {
  if (!std::filesystem::exists(path)) return;
  const golden::DatasetHeader found = golden::dataset_header(path);
  own.generator = found.generator;  // another version of this program
  if (to_line(found) != to_line(own))
    throw InputError({path.string(), 1}, "",
                     fmt::format("not what would be written, which begins with {}: move it away", to_line(own)));
}

/// Writes every one of these files below a folder: a whole set, laid out as the committed one. A file is there whole or
/// not at all, and with `resume` one that is there is kept.
void write_set(const std::string& folder, const std::vector<golden::CommittedFile>& files, std::uint64_t seed,
               const std::function<std::uint64_t(Pair)>& count, bool resume) {
  std::uint64_t all = 0;
  for (const golden::CommittedFile& file : files) all += count(file.pair);
  const auto header_of = [&](const golden::CommittedFile& file) {
    golden::DatasetHeader header;
    header.pair = file.pair;
    header.scalar = file.scalar;
    header.family = file.family->name;
    header.seed = seed;
    header.count = count(file.pair);
    return header;
  };
  const auto path_of = [&](const golden::CommittedFile& file) { return std::filesystem::path(folder) / file.path(); };
  for (const golden::CommittedFile& file : files) require_own(path_of(file), header_of(file));
  Progress progress = progress_of(folder, all);
  std::size_t kept = 0;
  for (const golden::CommittedFile& file : files) {
    const std::filesystem::path path = path_of(file);
    const golden::DatasetHeader header = header_of(file);
    const auto question = [&](std::uint64_t i) {
      return golden::generate_query(file.pair, *file.family, file.scalar, seed, i);
    };
    if (resume && std::filesystem::exists(path)) {
      static_cast<void>(check_finished(header, path.string(), question, progress));
      ++kept;
      continue;
    }
    make_folder(path.parent_path());
    static_cast<void>(write_dataset(header, path.string(), question, progress));
  }
  const std::uint64_t first = files.empty() ? 0 : count(files.front().pair);
  const bool are_alike = all == first * files.size();
  say_once("{}: {} files {} {} cases{}\n", folder, files.size(), are_alike ? "of" : "with", are_alike ? first : all,
           kept == 0 ? "" : fmt::format(", {} of them kept as they stand there", kept));
}

/// Every family of every pair, in both scalars.
std::vector<golden::CommittedFile> every_file() {
  std::vector<golden::CommittedFile> files;
  for (const Pair pair : kPairs)
    for (const golden::Family& family : golden::families_of(pair))
      for (const Scalar scalar : kScalars) files.push_back({pair, scalar, &family});
  return files;
}

void generate(const GenerateOptions& o) {
  if (o.all.empty())
    generate_one(o);
  else
    write_set(
        o.all, every_file(), o.seed, [&](Pair) { return o.count; }, o.resume);
}

struct AnnotateOptions {
  std::string input;
  std::string output;
  std::string family = "annotated";
};

void annotate(const AnnotateOptions& o) {
  check_output("annotate", o.output);
  require_apart({o.output}, {o.input});
  if (o.family.empty()) throw InputError({"annotate", 0}, "--family", "a family has a name");
  if (std::any_of(kPairs.begin(), kPairs.end(),
                  [&](Pair pair) { return golden::find_family(pair, o.family) != nullptr; }))
    throw InputError({"annotate", 0}, "--family",
                     fmt::format("'{}' is a family of the generator's: choose another name", o.family));
  InputLines lines(o.input);
  golden::DatasetHeader header;
  header.family = formats::visible(o.family);
  std::vector<Query> queries;
  std::unordered_set<std::string> ids;
  std::uint64_t decimals = 0;
  while (lines.next()) {
    const formats::Location& where = lines.where();
    const auto json = formats::parse_object(lines.text(), where);
    const formats::Node node(json, where);
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
    decimals += read.decimals;
  }
  if (queries.empty()) throw InputError(lines.where(), "", "no question in this file");
  header.count = queries.size();
  Progress progress = progress_of(o.output, header.count);
  static_cast<void>(write_dataset(
      header, o.output, [&](std::uint64_t i) { return queries[i]; }, progress));
  say_once("{}: {} cases\n", o.output, header.count);
  say_decimals(decimals, "the questions");
}

struct ConvertOptions {
  std::vector<std::string> inputs;
  std::string output;
};

/// The header of the whole whose shards these are, and the shards in order. Throws InputError naming the file that does
/// not belong.
golden::DatasetHeader merged_header(std::vector<std::string>& shards) {
  std::map<std::uint64_t, std::pair<std::string, golden::DatasetHeader>> found;
  std::optional<golden::DatasetHeader> whole;
  std::uint64_t of = 0;
  for (const std::string& path : shards) {
    const golden::DatasetHeader header = golden::dataset_header(path);
    const auto refuse = [&](const std::string& problem) { throw InputError({path, 0}, "shard", problem); };
    if (!header.shard) refuse("several files are joined only where they are the shards of one dataset");
    golden::DatasetHeader alike = header;
    alike.shard.reset();
    alike.count = 0;
    if (!whole) {
      whole = alike;
      of = header.shard->of;
    }
    if (to_line(alike) != to_line(*whole) || header.shard->of != of)
      refuse(fmt::format("not of the same dataset as {}", shards.front()));
    const auto [there, is_new] = found.emplace(header.shard->index, std::pair(path, header));
    if (!is_new) refuse(fmt::format("shard {}/{} is in {} already", header.shard->index, of, there->second.first));
  }
  shards.clear();
  for (std::uint64_t index = 0; index < of; ++index) {
    const auto shard = found.find(index);
    if (shard == found.end())
      throw InputError({"convert", 0}, "",
                       fmt::format("shard {}/{} of {}/{} is missing", index, of, name(whole->pair), whole->family));
    shards.push_back(shard->second.first);
    whole->count += shard->second.second.count;
  }
  for (const auto& [index, shard] : found)
    if (const auto& [path, header] = shard;
        header.count != golden::cut(whole->count, index + 1, of) - golden::cut(whole->count, index, of))
      throw InputError({path, 0}, "count",
                       fmt::format("{} cases are not shard {}/{} of {}", header.count, index, of, whole->count));
  return *whole;
}

void convert(ConvertOptions o) {
  check_output("convert", o.output);
  require_apart({o.output}, o.inputs);
  const golden::DatasetHeader header =
      o.inputs.size() == 1 ? golden::dataset_header(o.inputs.front()) : merged_header(o.inputs);
  const auto writer = golden::create_dataset(o.output, header);
  Progress progress(o.output, header.count);
  for (const std::string& path : o.inputs) {
    golden::DatasetReader reader(path, golden::is_made);
    check_canonical(reader, to_line(reader.header()));
    while (const auto c = reader.next()) {
      throw_if_interrupted();
      check_canonical(reader, to_line(*c));
      writer->write(*c, reader.text());
      progress.add(1);
    }
  }
  writer->commit();
  say_once("{}: {} cases\n", o.output, header.count);
}

}  // namespace

void add_convert(CLI::App& app, int& exit) {
  auto* command = app.add_subcommand("convert",
                                     "A golden file in another form, or all its shards as one\n"
                                     "The forms are JSON lines, HDF5 and NumPy's .npz.");
  auto o = std::make_shared<ConvertOptions>();
  command->add_option("datasets", o->inputs, "A golden file, or all shards of one in any order")->required();
  command->add_option("-o,--output", o->output, "The file, *.jsonl, *.h5 or *.npz")->type_name("FILE")->required();
  command->callback([o, &exit] {
    convert(*o);
    exit = kCertified;
  });
}

void add_generate(CLI::App& app, int& exit) {
  auto* command =
      app.add_subcommand("generate",
                         "Make golden files: questions of a family, with their exact answers\n"
                         "A pure function of pair, family, scalar, seed and index. With --all every family of "
                         "every pair in both scalars: FOLDER/PAIR/FAMILY.jsonl, and .f32.jsonl in binary32.");
  auto o = std::make_shared<GenerateOptions>();
  auto* all = command->add_option("--all", o->all, "A whole set, into this folder")->type_name("FOLDER");
  command->add_option("--pair", o->pair, "The pair of shapes")->excludes(all)->check(CLI::IsMember(names_of(kPairs)));
  command->add_option("--family", o->family, "A family; `contact-oracle families` lists them")->excludes(all);
  command->add_option("--count", o->count, "How many questions, with --all of each family")
      ->required()
      ->check(kFromOne);
  command->add_option("--seed", o->seed, "The seed")->required()->check(kFromZero);
  command->add_option("--scalar", o->scalar, "The number format that answers are rounded to")
      ->capture_default_str()
      ->excludes(all)
      ->check(CLI::IsMember(names_of(kScalars)));
  command->add_option("--shard", o->shard, "Only part I (from 0) of N, itself a dataset")
      ->type_name("I/N")
      ->excludes(all);
  command->add_flag("--resume", o->resume, "Keep a file that is there already and whole; refuse it if damaged");
  command->add_option("-o,--output", o->output, "The file, *.jsonl, *.h5 or *.npz; may be left out with --digest")
      ->type_name("FILE")
      ->excludes(all);
  command->add_flag("--digest", o->digest, "Print the SHA-256 of the answers, docs/formats.md#digests")->excludes(all);
  command->callback([o, &exit] {
    generate(*o);
    exit = kCertified;
  });
}

void add_regenerate(CLI::App& app, int& exit) {
  auto* command = app.add_subcommand("regenerate",
                                     "Write anew every committed golden file that a family makes\n"
                                     "Then lint --write-manifest makes the manifest.");
  auto folder = std::make_shared<std::string>();
  command->add_option("folder", *folder, "The folder of golden files that is written")->type_name("FOLDER")->required();
  command->callback([folder, &exit] {
    write_set(*folder, golden::committed_files(), golden::kCommittedSeed, golden::committed_count, false);
    exit = kCertified;
  });
}

void add_annotate(CLI::App& app, int& exit) {
  auto* command = app.add_subcommand("annotate", "Make a golden file of your own questions (JSON lines)");
  auto o = std::make_shared<AnnotateOptions>();
  command->add_option("queries", o->input, "The questions, or - for standard input")->required();
  command->add_option("-o,--output", o->output, "The file, *.jsonl, *.h5 or *.npz")->type_name("FILE")->required();
  command->add_option("--family", o->family, "The name of the family that they make")
      ->type_name("NAME")
      ->capture_default_str();
  command->callback([o, &exit] {
    annotate(*o);
    exit = kCertified;
  });
}

}  // namespace contact::tool
