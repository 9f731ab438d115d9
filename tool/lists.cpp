// engines and families: what there is.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <memory>

#include "engines/adapters.hpp"
#include "engines/engine.hpp"
#include "engines/mutants.hpp"
#include "golden/families.hpp"
#include "golden/flags.hpp"
#include "golden/json.hpp"
#include "oracle/diagnosis.hpp"
#include "tool/commands.hpp"
#include "tool/process.hpp"

namespace contact::tool {
namespace {

using golden::json_string;

/// With --json the mutants are among them; else they are counted, or with `every_mutant` listed.
void list_engines(bool json, bool every_mutant) {
  for (const engines::BuiltIn& e : engines::built_in_engines())
    if (json)
      fmt::print("{{\"name\":{},\"scalar\":\"{}\",\"about\":{}}}\n", json_string(e.name), name(e.scalar),
                 json_string(e.about));
    else
      fmt::print("{:<18}{}  {}\n", e.name, name(e.scalar), e.about);
  for (const engines::Adapter& a : engines::adapters()) {
    const auto command = engines::command_of(a);
    if (json) {
      std::vector<std::string> words;
      for (const std::string& word : command.value_or(std::vector<std::string>{})) words.push_back(json_string(word));
      fmt::print(R"({{"name":{},"scalar":"{}","about":{},"command":{}}}{})", json_string(a.name), name(a.scalar),
                 json_string(a.about), command ? fmt::format("[{}]", fmt::join(words, ",")) : "null", "\n");
    } else {
      fmt::print("{:<18}{}  {}{}\n", a.name, name(a.scalar), a.about,
                 command ? "" : ": not here, ./run engines installs it");
    }
  }
  for (const engines::Mutant& m : engines::mutants()) {
    const std::string full_name = fmt::format("{}{}", engines::kMutantPrefix, m.id);
    if (json)
      fmt::print(R"({{"name":{},"scalar":"{}","about":{},"origin":"{}","diagnosis":{},"source":{}}}{})",
                 json_string(full_name), name(Scalar::binary64), json_string(m.about),
                 engines::kOriginNames[static_cast<std::size_t>(m.origin)], json_string(oracle::sentence_of(m.cause)),
                 json_string(m.source), "\n");
    else if (every_mutant)
      fmt::print("{:<40}{}\n", full_name, m.about);
  }
  if (!json && !every_mutant)
    fmt::print("{:<18}{} engines with one mistake each, docs/bug-zoo.md; --mutants lists them\n", "mutant:ID",
               engines::mutants().size());
}

/// With --json one object a line, families then flags.
void list_families(bool json) {
  for (const bool spheres : {true, false}) {
    const auto families = spheres ? golden::sphere_families() : golden::cube_families();
    if (!json) fmt::print("{}\n", spheres ? "sphere pairs" : "\ncube_cube");
    for (const golden::Family& f : families)
      if (json)
        fmt::print("{{\"family\":{},\"shapes\":\"{}\",\"reason\":{}}}\n", json_string(f.name),
                   spheres ? "spheres" : "cubes", json_string(f.reason));
      else
        fmt::print("  {:<17}{}\n", f.name, f.reason);
  }
  if (!json) fmt::print("\nflags\n");
  for (const golden::Flag& f : golden::flags())
    if (json)
      fmt::print("{{\"flag\":{},\"meaning\":{},\"breaks\":{}}}\n", json_string(f.name), json_string(f.meaning),
                 json_string(f.breaks));
    else
      fmt::print("  {:<17}{}\n", f.name, f.meaning);
}

/// The tables of docs/formats.md, which a test compares with this.
void print_tables() {
  fmt::print("<!-- families:begin -->\n| shapes | family | why it exists |\n|---|---|---|\n");
  for (const auto& [shapes, families] :
       {std::pair{"spheres", golden::sphere_families()}, {"cubes", golden::cube_families()}})
    for (const golden::Family& f : families) fmt::print("| {} | `{}` | {} |\n", shapes, f.name, f.reason);
  fmt::print("<!-- families:end -->\n<!-- flags:begin -->\n| flag | what is true | what breaks |\n|---|---|---|\n");
  for (const golden::Flag& f : golden::flags()) fmt::print("| `{}` | {} | {} |\n", f.name, f.meaning, f.breaks);
  fmt::print("<!-- flags:end -->\n");
}

/// Text for a cell of a Markdown table.
std::string table_cell(std::string_view text) {
  std::string cell;
  for (const char c : text) cell += c == '|' || c == '*' ? std::string{'\\', c} : std::string(1, c);
  return cell;
}

/// The table of docs/bug-zoo.md, which a test compares with this.
void print_mutants() {
  fmt::print("| id | from | what is wrong | first line of the diagnosis |\n|---|---|---|---|\n");
  for (const engines::Mutant& m : engines::mutants())
    fmt::print("| `{}` | {} | {} | {} |\n", m.id,
               m.source.empty() ? std::string(engines::kOriginNames[static_cast<std::size_t>(m.origin)])
                                : fmt::format("[real]({})", m.source),
               table_cell(m.about), oracle::sentence_of(m.cause));
}

}  // namespace

void add_lists(CLI::App& app, int& exit) {
  const auto add = [&](const std::string& name, const std::string& about, void (*list)(bool)) {
    auto* command = app.add_subcommand(name, about);
    auto json = std::make_shared<bool>(false);
    command->add_flag("--json", *json, "One JSON object a line");
    command->callback([json, list, &exit] {
      list(*json);
      exit = kCertified;
    });
  };
  auto* engines = app.add_subcommand("engines", "The engines that can be certified by name");
  auto engines_json = std::make_shared<bool>(false);
  auto every_mutant = std::make_shared<bool>(false);
  engines->add_flag("--json", *engines_json, "One JSON object a line, mutants included");
  engines->add_flag("--mutants", *every_mutant, "Also the engines with one mistake each");
  auto table = std::make_shared<bool>(false);
  engines->add_flag("--table", *table, "The table of docs/bug-zoo.md")->group("");
  engines->callback([=, &exit] {
    if (*table)
      print_mutants();
    else
      list_engines(*engines_json, *every_mutant);
    exit = kCertified;
  });
  add("families", "The families of generated questions, and the flags of cases", list_families);
  auto* tables = app.add_subcommand("tables", "The tables of families and flags in docs/formats.md");
  tables->group("");
  tables->callback([&exit] {
    print_tables();
    exit = kCertified;
  });
}

}  // namespace contact::tool
