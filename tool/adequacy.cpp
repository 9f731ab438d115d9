// adequacy: do the golden files kill every mutant, what does each family add, and which few cases are enough?
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <numeric>
#include <sstream>

#include "engines/mutants.hpp"
#include "golden/families.hpp"
#include "golden/json.hpp"
#include "golden/manifest.hpp"
#include "golden/output_file.hpp"
#include "golden/query_id.hpp"
#include "tool/commands.hpp"
#include "tool/kill_matrix.hpp"
#include "tool/process.hpp"
#include "tool/table.hpp"

namespace contact::tool {
namespace {

struct Reason {
  std::string_view shapes;
  std::string_view family;
  std::string_view why;
};
/// Why a family is there that kills no mutant which no other family kills. The mutants are mistakes that somebody
/// thought of, most of them so plain that any question near them does; a family is there for the engine that nobody has
/// seen.
constexpr std::array kReasons{
    Reason{"spheres", "generic", "ordinary numbers: what fails here fails its users, and other families do not say so"},
    Reason{"spheres", "touching", "a strict comparison, or any tolerance, shows in every case and not by chance"},
    Reason{"spheres", "near_touching", "plain arithmetic decides most of it wrongly: how often is an engine's measure"},
    Reason{"spheres", "alarm_edge", "alarm, contact and both radii differ: no two of them can be confused unseen"},
    Reason{"spheres", "contact_edge", "the sign of the value is at stake in every case, and in few others"},
    Reason{"spheres", "coincident",
           "no direction: what an engine does instead, under whichever convention it declares"},
    Reason{"spheres", "near_coincident", "an absolute epsilon of any size; the mutants have a few sizes"},
    Reason{"spheres", "containment", "depths greater than a radius, for engines that stop at a surface"},
    Reason{"spheres", "zero_radius",
           "points are spheres: special cases for a radius of zero, which no mutant has in full"},
    Reason{"spheres", "far_from_origin", "coordinates that a smaller format, or a tolerance that grows, cannot hold"},
    Reason{"spheres", "extreme_scale", "overflow and underflow depend on an engine's own order of operations"},
    Reason{"spheres", "hard_to_round",
           "one rounding too many shows here and hardly anywhere else; mutants are wrong by more"},
    Reason{"spheres", "hardest",
           "the closest numbers known: for who computes with more digits and takes them for enough"},
    Reason{"spheres", "one_axis",
           "the answer is known at sight, on every axis and side: the first questions for a new engine"},
    Reason{"spheres", "upstream", "compiled SOFA was asked these questions, and its answers are recorded"},
    Reason{"cubes", "generic", "ordinary boxes: what fails here fails its users, and other families do not say so"},
    Reason{"cubes", "separated", "far from every edge: a wrong answer is a wrong axis or side, and no rounding"},
    Reason{"cubes", "touching", "a strict comparison on any one axis and side shows in many cases and not by chance"},
    Reason{"cubes", "alarm_edge", "searched for what plain sums decide wrongly: how often is an engine's measure"},
    Reason{"cubes", "flat", "overlap by volume on any axis; besides upstream's it alone refutes box-euclidean"},
    Reason{"cubes", "nested", "for engines that compare corners, edges or faces, and not extents"},
    Reason{"cubes", "identical", "no difference at all: for engines that take a box for itself and skip it"},
    Reason{"cubes", "far_from_origin", "the alarm distance is lost in a sum, on every axis and side"},
    Reason{"cubes", "upstream", "compiled SOFA was asked these questions, and its answers are recorded"}};

std::string_view shapes_of(Pair pair) { return pair == Pair::cube_cube ? "cubes" : "spheres"; }

/// What a family kills, of all pairs and scalars.
struct FamilyKills {
  std::set<std::size_t> mutants;
  std::vector<std::size_t> unique;  ///< those that no other family kills
};
using Families = std::map<std::pair<std::string_view, std::string>, FamilyKills>;

Families families_of(const KillMatrix& matrix) {
  Families families;
  for (const FileKills& file : matrix.files)
    families[{shapes_of(file.header.pair), file.header.family}].mutants.insert(file.mutants.begin(),
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

QuickFiles quick_files(const KillMatrix& matrix) {
  std::vector<std::size_t> order(matrix.cases.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto header_of = [&](std::size_t i) -> const golden::DatasetHeader& {
    return matrix.files[matrix.cases[i].file].header;
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return header_of(i).scalar > header_of(j).scalar; });
  QuickFiles files;
  for (const std::size_t i : cover(matrix.cases, order)) {
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
        fmt::format(R"({{"path":{},"sha256":"{}","kills":{}}})", golden::json_string(path), sha256, ids(mutants));
  };
  for (const FileKills& file : matrix.files) add(file.path, file.sha256, file.mutants);
  for (const auto& [path, file] : quick) add(path, golden::Sha256().add(file.text()).hex(), file.mutants);
  std::vector<std::string> file_lines;
  for (const auto& [path, line] : files) file_lines.push_back(line);

  std::vector<std::string> mutant_lines;
  const auto killers = killers_of(matrix);
  for (std::size_t m = 0; m < killers.size(); ++m) {
    std::string only;
    if (killers[m].size() == 1) {
      const CaseKills& c = matrix.cases[killers[m].front()];
      only = fmt::format(R"(,"only":{{"path":{},"id":"{}"}})", golden::json_string(matrix.files[c.file].path), c.id);
    }
    mutant_lines.push_back(
        fmt::format(R"({{"id":"{}","cases":{}{}}})", engines::mutants()[m].id, killers[m].size(), only));
  }

  std::vector<std::string> family_lines;
  for (const auto& [name, family] : families_of(matrix))
    family_lines.push_back(fmt::format(R"({{"shapes":"{}","family":{},"kills":{},"unique":{}}})", name.first,
                                       golden::json_string(name.second), family.mutants.size(), ids(family.unique)));
  return fmt::format(
      "{{\"format\":\"contact-oracle/"
      "adequacy\",\"version\":1,\"files\":[\n{}],\"mutants\":[\n{}],\"families\":[\n{}]}}\n",
      lines(file_lines), lines(mutant_lines), lines(family_lines));
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
  for (const auto& [key, family] : families_of(matrix)) {
    const auto& name = key;  // what a lambda may capture
    const bool reason = std::any_of(kReasons.begin(), kReasons.end(),
                                    [&](const Reason& r) { return r.shapes == name.first && r.family == name.second; });
    if (family.unique.empty() && !reason)
      found.push_back(
          fmt::format("{} {} kills nothing that no other family kills, and tool/adequacy.cpp gives no reason "
                      "for it",
                      name.first, name.second));
    if (!family.unique.empty() && reason)
      found.push_back(
          fmt::format("{} {} kills what no other family kills, {}: take its reason out of tool/adequacy.cpp",
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

void write(const std::filesystem::path& folder, const QuickFiles& quick, const std::string& adequacy) {
  const std::filesystem::path below = folder / golden::kQuickFolder;
  std::filesystem::create_directories(below);
  for (const auto& entry : std::filesystem::directory_iterator(below))
    if (!quick.contains(entry.path().lexically_relative(folder).generic_string()))
      std::filesystem::remove(entry.path());
  const auto put = [&](const std::string& path, const std::string& text) {
    golden::OutputFile file(folder / path);
    file.write(text);
    file.commit();
  };
  for (const auto& [path, file] : quick) put(path, file.text());
  put(std::string(golden::kAdequacyName), adequacy);
}

/// Refuses what stands in the folder where it is not what would be written.
void check(const std::filesystem::path& folder, const QuickFiles& quick, const std::string& adequacy) {
  const auto compare = [&](const std::string& path, const std::string& right) {
    std::istringstream expected(right);
    std::ifstream found = golden::open_to_read(folder / path);
    std::string a;
    std::string b;
    for (std::size_t line = 1; std::getline(expected, b); ++line)
      if (!std::getline(found, a) || a != b)
        throw golden::InputError({(folder / path).string(), line}, "",
                                 fmt::format("not what the mutants say: expected {:.200}", b));
  };
  for (const auto& [path, file] : quick) compare(path, file.text());
  compare(std::string(golden::kAdequacyName), adequacy);
}

bool adequacy(const std::filesystem::path& folder, bool to_write) {
  const KillMatrix matrix = kill_matrix(folder, golden::dataset_files({folder}));
  const QuickFiles quick = quick_files(matrix);
  const std::string text = adequacy_text(matrix, quick);
  fmt::print("{}", table_of(matrix, quick));
  if (to_write)
    write(folder, quick, text);
  else
    check(folder, quick, text);
  const auto wrong = complaints(matrix);
  for (const std::string& sentence : wrong) fmt::print("NOT ADEQUATE: {}\n", sentence);
  return wrong.empty();
}

/// The table of docs/golden.md, which a test compares with this.
void print_reasons() {
  fmt::print("<!-- reasons:begin -->\n| shapes | family | why it is there |\n|---|---|---|\n");
  for (const Reason& r : kReasons) fmt::print("| {} | `{}` | {} |\n", r.shapes, r.family, r.why);
  fmt::print("<!-- reasons:end -->\n");
}

}  // namespace

void add_adequacy(CLI::App& app, int& exit) {
  struct Options {
    std::string folder = golden_folder();
    bool write = false;
    bool table = false;
  };
  auto* command = app.add_subcommand(
      "adequacy", "Which mutants do the golden files kill, what does each family add, and which few cases are enough?");
  auto o = std::make_shared<Options>();
  command->add_option("folder", o->folder, "A folder of golden files")->capture_default_str();
  command->add_flag("--write", o->write, "Write adequacy.json and quick/ instead of checking them");
  command->add_flag("--table", o->table, "The table of docs/golden.md")->group("");
  command->callback([o, &exit] {
    exit = kCertified;
    if (o->table)
      print_reasons();
    else if (!adequacy(o->folder, o->write))
      exit = kRefuted;
  });
}

}  // namespace contact::tool
