// adequacy: do the golden files kill every mutant, what does each family add, and which few cases are enough?
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>

#include "engines/zoo/mutants.hpp"
#include "formats/json.hpp"
#include "formats/output_file.hpp"
#include "formats/sha256.hpp"
#include "golden/families.hpp"
#include "golden/manifest.hpp"
#include "golden/query_id.hpp"
#include "golden/right_case.hpp"
#include "tool/commands/commands.hpp"
#include "tool/reports/table.hpp"
#include "tool/run/kill_matrix.hpp"
#include "tool/run/printing.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {
namespace {

constexpr std::string_view kFormat = "contact-oracle/adequacy";

/// What a family kills, of all pairs and scalars.
struct FamilyKills {
  std::set<std::size_t> mutants;
  std::vector<std::size_t> unique;  ///< those that no other family kills
};
using Families = std::map<std::pair<std::string, std::string>, FamilyKills>;

Families families_of(const KillMatrix& matrix) {
  Families families;
  for (const FileKills& file : matrix.files)
    families[{shapes_of_kind(file.header.pair), file.header.family}].mutants.insert(file.mutants.begin(),
                                                                                    file.mutants.end());
  std::map<std::size_t, int> killers;
  for (const auto& [name, family] : families)
    for (const std::size_t m : family.mutants) ++killers[m];
  for (auto& [name, family] : families)
    std::copy_if(family.mutants.begin(), family.mutants.end(), std::back_inserter(family.unique),
                 [&](std::size_t m) { return killers[m] == 1; });
  return families;
}

std::vector<std::vector<std::size_t>> killers_of(const KillMatrix& matrix) {
  std::vector<std::vector<std::size_t>> killers(engines::mutants().size());
  for (std::size_t i = 0; i < matrix.cases.size(); ++i)
    for (const std::size_t m : matrix.cases[i].mutants) killers[m].push_back(i);
  return killers;
}

/// The fewest cases that kill all, as datasets: text and kills by path. Those in binary64 come first where it does not
/// matter; what lies outside the domain is a file of its own, since it is judged only when named.
struct QuickFile {
  golden::DatasetHeader header;
  std::vector<Query> queries;
  std::set<std::size_t> mutants;

  [[nodiscard]] std::string text() const {
    std::string lines = to_line(header) + "\n";
    for (const Query& query : queries) lines += to_line(golden::make_case(query, header.scalar)) + "\n";
    return lines;
  }
};
using QuickFiles = std::map<std::string, QuickFile>;

/// Its place in the list of mutants.
std::size_t place_of(std::string_view mutant) {
  const auto all = engines::mutants();
  return static_cast<std::size_t>(
      std::find_if(all.begin(), all.end(), [&](const engines::Mutant& m) { return m.id == mutant; }) - all.begin());
}

/// The cases, and among what they kill, as if it were a mutant of its own, each engine that always answers alike and
/// serves one pair alone: those of every pair must refute it.
std::vector<CaseKills> with_constant_engines_of_a_pair(const KillMatrix& matrix) {
  const std::size_t constant[] = {place_of(engines::kAlwaysHit), place_of(engines::kAlwaysMiss)};
  std::vector<CaseKills> cases = matrix.cases;
  for (CaseKills& c : cases)
    for (const std::size_t m : constant)
      if (std::find(c.mutants.begin(), c.mutants.end(), m) != c.mutants.end())
        c.mutants.push_back(engines::mutants().size() * (1 + static_cast<std::size_t>(c.query.pair)) + m);
  return cases;
}

QuickFiles quick_files(const KillMatrix& matrix) {
  std::vector<std::size_t> order(matrix.cases.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto header_of = [&](std::size_t i) -> const golden::DatasetHeader& {
    return matrix.files[matrix.cases[i].file].header;
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return header_of(i).scalar > header_of(j).scalar; });
  QuickFiles files;
  for (const std::size_t i : cover(with_constant_engines_of_a_pair(matrix), order)) {
    const golden::DatasetHeader& h = header_of(i);
    const bool invalid = h.family == golden::kInvalidFamily;
    QuickFile& file = files[fmt::format("{}/{}{}{}.jsonl", golden::kQuickFolder, name(h.pair),
                                        invalid ? ".invalid" : "", h.scalar == Scalar::binary32 ? ".f32" : "")];
    file.header.pair = h.pair;
    file.header.scalar = h.scalar;
    file.header.family = invalid ? golden::kInvalidFamily : golden::kQuickFolder;
    file.queries.push_back(matrix.cases[i].query);
    file.mutants.insert(matrix.cases[i].mutants.begin(), matrix.cases[i].mutants.end());
    file.header.count = file.queries.size();
  }
  return files;
}

template <class Places>
std::string ids(const Places& places) {
  std::string text;
  for (const std::size_t m : places) text += fmt::format("{}\"{}\"", text.empty() ? "" : ",", engines::mutants()[m].id);
  return "[" + text + "]";
}

std::string adequacy_text(const KillMatrix& matrix, const QuickFiles& quick) {
  const auto lines = [](const std::vector<std::string>& all) { return fmt::format("{}\n", fmt::join(all, ",\n")); };
  std::map<std::string, std::string> files;
  const auto add = [&](const std::string& path, const std::string& sha256, const std::set<std::size_t>& mutants) {
    files[path] =
        fmt::format(R"({{"path":{},"sha256":"{}","kills":{}}})", formats::json_string(path), sha256, ids(mutants));
  };
  for (const FileKills& file : matrix.files) add(file.path, file.sha256, file.mutants);
  for (const auto& [path, file] : quick) add(path, formats::Sha256().add(file.text()).hex(), file.mutants);
  std::vector<std::string> file_lines;
  for (const auto& [path, line] : files) file_lines.push_back(line);

  std::vector<std::string> mutant_lines;
  const auto killers = killers_of(matrix);
  for (std::size_t m = 0; m < killers.size(); ++m) {
    std::string only;
    if (killers[m].size() == 1) {
      const CaseKills& c = matrix.cases[killers[m].front()];
      only = fmt::format(R"(,"only":{{"path":{},"id":"{}"}})", formats::json_string(matrix.files[c.file].path), c.id);
    }
    mutant_lines.push_back(
        fmt::format(R"({{"id":"{}","cases":{}{}}})", engines::mutants()[m].id, killers[m].size(), only));
  }

  std::vector<std::string> family_lines;
  for (const auto& [name, family] : families_of(matrix))
    family_lines.push_back(fmt::format(R"({{"shapes":"{}","family":{},"kills":{},"unique":{}}})", name.first,
                                       formats::json_string(name.second), family.mutants.size(), ids(family.unique)));
  return fmt::format("{{\"format\":\"{}\",\"version\":1,\"files\":[\n{}],\"mutants\":[\n{}],\"families\":[\n{}]}}\n",
                     kFormat, lines(file_lines), lines(mutant_lines), lines(family_lines));
}

/// What is not as it should be, a sentence each.
std::vector<std::string> complaints(const KillMatrix& matrix) {
  std::vector<std::string> found;
  const auto killers = killers_of(matrix);
  for (std::size_t m = 0; m < killers.size(); ++m) {
    const std::string_view id = engines::mutants()[m].id;
    if (killers[m].size() < kLeastKills)
      found.push_back(fmt::format("{} cases kill {}, and {} should", killers[m].size(), id, kLeastKills));
  }
  const auto hits_alone = golden::families_of_hits_alone();
  for (const FileKills& file : matrix.files) {
    const golden::DatasetHeader& h = file.header;
    if (h.family == golden::kInvalidFamily) continue;  // it asks for a refusal, and no decision
    const bool listed = std::any_of(hits_alone.begin(), hits_alone.end(), [&](const golden::FamilyNote& f) {
      return kind_of(f.pair) == kind_of(h.pair) && f.family == h.family;
    });
    if (!file.mutants.contains(place_of(engines::kAlwaysMiss)))
      found.push_back(fmt::format("{} has no hit: an engine that always says miss is right on all of it", file.path));
    if (!listed && !file.mutants.contains(place_of(engines::kAlwaysHit)))
      found.push_back(
          fmt::format("{} has no miss: an engine that always says hit is right on all of it, and golden/families.cpp "
                      "gives no reason for it",
                      file.path));
    if (listed && file.mutants.contains(place_of(engines::kAlwaysHit)))
      found.push_back(fmt::format("{} has misses, and golden/families.cpp gives a reason why it has none", file.path));
  }
  const auto kept = golden::families_kept();
  for (const auto& [key, family] : families_of(matrix)) {
    const auto& name = key;  // what a lambda may capture
    const bool reason = std::any_of(kept.begin(), kept.end(), [&](const golden::FamilyNote& note) {
      return shapes_of_kind(note.pair) == name.first && note.family == name.second;
    });
    if (family.unique.empty() && !reason)
      found.push_back(
          fmt::format("{} {} kills nothing that no other family kills, and golden/families.cpp gives no reason for it",
                      name.first, name.second));
    if (!family.unique.empty() && reason)
      found.push_back(fmt::format("{} {} kills what no other family kills, {}: take its reason out of its table",
                                  name.first, name.second, ids(family.unique)));
  }
  return found;
}

std::string table_of(const KillMatrix& matrix, const QuickFiles& quick) {
  Table table;
  table.row({"file", "cases", "kills"});
  for (const FileKills& file : matrix.files)
    table.row({file.path, std::to_string(file.header.count), std::to_string(file.mutants.size())});
  for (const auto& [path, file] : quick)
    table.row({path, std::to_string(file.queries.size()), std::to_string(file.mutants.size())});
  Table families;
  families.row({"family", "kills", "alone"});
  for (const auto& [name, family] : families_of(matrix))
    families.row({fmt::format("{} {}", name.first, name.second), std::to_string(family.mutants.size()),
                  std::to_string(family.unique.size())});
  const auto killers = killers_of(matrix);
  const auto alive = static_cast<std::size_t>(
      std::count_if(killers.begin(), killers.end(), [](const auto& cases) { return cases.empty(); }));
  std::size_t chosen = 0;
  for (const auto& [path, file] : quick) chosen += file.queries.size();
  std::string text = table.text() + "\n" + families.text() + "\n";
  for (std::size_t m = 0; m < killers.size(); ++m)
    if (killers[m].size() == 1)
      text += fmt::format("{} is killed by {} alone\n", engines::mutants()[m].id, matrix.cases[killers[m].front()].id);
  return text + fmt::format("{} of {} mutants are killed, all of them by {} of the {} cases\n", killers.size() - alive,
                            killers.size(), chosen, matrix.cases.size());
}

/// The files in quick/ that an earlier run wrote, with their digests, as its adequacy.json lists them.
std::map<std::string, std::string> written_before(const std::filesystem::path& folder) {
  std::map<std::string, std::string> written;
  const formats::Location where{(folder / golden::kAdequacyName).string(), 0};
  if (!std::filesystem::exists(where.file)) return written;
  const auto json = formats::parse_object(formats::read_text(where.file), where);
  const formats::Node node(json, where);
  if (const formats::Node format = node.at("format"); format.text() != kFormat)
    format.refuse(fmt::format("expected \"{}\"", kFormat));
  for (const formats::Node& file : node.at("files").items())
    if (std::filesystem::path(file.at("path").text()).parent_path() == golden::kQuickFolder)
      written[file.at("path").text()] = file.at("sha256").text();
  return written;
}

/// Writes over, and removes, what an earlier run wrote, and nothing else.
void write(const std::filesystem::path& folder, const QuickFiles& quick, const std::string& adequacy) {
  const auto before = written_before(folder);
  for (const auto& [path, file] : quick)
    if (std::filesystem::exists(folder / path) && !before.contains(path) &&
        formats::read_text(folder / path) != file.text())
      throw formats::InputError(
          {(folder / path).string(), 0}, "",
          fmt::format("would be written over, and {} does not list it: move it away", golden::kAdequacyName));
  for (const auto& [path, digest] : before)
    if (!quick.contains(path) && std::filesystem::is_regular_file(folder / path) &&
        formats::Sha256().add(formats::read_text(folder / path)).hex() == digest)
      std::filesystem::remove(folder / path);
  make_folder(folder / golden::kQuickFolder);
  const auto put = [&](const std::string& path, const std::string& text) {
    formats::OutputFile file(folder / path);
    file.write(text);
    file.commit();
  };
  for (const auto& [path, file] : quick) put(path, file.text());
  put(std::string(golden::kAdequacyName), adequacy);
}

/// Refuses what stands in the folder where it is not what would be written.
void check(const std::filesystem::path& folder, const QuickFiles& quick, const std::string& adequacy) {
  const auto compare = [&](const std::string& path, const std::string& right) {
    const std::string found = formats::read_text(folder / path);
    if (found == right) return;
    const auto differs = std::mismatch(right.begin(), right.end(), found.begin(), found.end()).first;
    const auto lines = std::count(right.begin(), differs, '\n');
    auto begin = differs;
    while (begin != right.begin() && *(begin - 1) != '\n') --begin;
    const std::string expected(begin, std::find(begin, right.end(), '\n'));
    throw formats::InputError(
        {(folder / path).string(), static_cast<std::size_t>(lines) + 1}, "",
        fmt::format("not what the mutants say: expected {:.200}", expected.empty() ? "no more" : expected));
  };
  for (const auto& [path, file] : quick) compare(path, file.text());
  compare(std::string(golden::kAdequacyName), adequacy);
  if (quick.empty()) return;
  // A dataset beside them is judged where the folder is named.
  for (const auto& path : golden::dataset_files({folder / golden::kQuickFolder}))
    if (!quick.contains(path.lexically_relative(folder).generic_string()))
      throw formats::InputError({path.string(), 0}, "", "not one of the files that the mutants ask for");
}

bool adequacy(const std::filesystem::path& folder, bool to_write) {
  if (std::filesystem::exists(folder) && !std::filesystem::is_directory(folder))
    throw formats::InputError({folder.string(), 0}, "", "is no folder");
  const KillMatrix matrix = kill_matrix(folder, golden::dataset_files({folder}));
  const QuickFiles quick = quick_files(matrix);
  const std::string text = adequacy_text(matrix, quick);
  words() << table_of(matrix, quick);
  if (to_write)
    write(folder, quick, text);
  else
    check(folder, quick, text);
  const auto wrong = complaints(matrix);
  for (const std::string& sentence : wrong) say("NOT ADEQUATE: {}\n", sentence);
  return wrong.empty();
}

/// The table of reasons, on a page of the site.
void print_reasons() {
  fmt::print("<!-- reasons:begin -->\n| shapes | family | why it is there |\n|---|---|---|\n");
  for (const golden::FamilyNote& f : golden::families_kept())
    fmt::print("| {} | `{}` | {} |\n", shapes_of_kind(f.pair), f.family, f.why);
  fmt::print("<!-- reasons:end -->\n");
}

}  // namespace

void add_adequacy(CLI::App& app, int& exit) {
  struct AdequacyOptions {
    std::string folder;
    bool write = false;
    bool table = false;
  };
  auto* command = app.add_subcommand("adequacy", "Which mutants golden files kill, and which few cases are enough");
  auto o = std::make_shared<AdequacyOptions>();
  command->add_option("folder", o->folder, fmt::format("A folder of golden files (default: {})", kCommitted))
      ->type_name("FOLDER");
  command->add_flag("--write", o->write, "Write adequacy.json and quick/ instead of checking them");
  command->add_flag("--table", o->table, "The table of reasons on the site")->group("");
  command->callback([o, command, &exit] {
    exit = kCertified;
    if (o->table) {
      require_alone(*command, "--table");
      print_reasons();
      return;
    }
    if (o->write) require_folder("adequacy", "--write", o->folder);
    if (!adequacy(chosen_folder(o->folder), o->write)) exit = kRefuted;
  });
}

}  // namespace contact::tool
