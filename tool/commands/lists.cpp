// engines and families: what there is.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "engines/adapters.hpp"
#include "engines/engine.hpp"
#include "engines/zoo/mutants.hpp"
#include "engines/zoo/unsteady.hpp"
#include "golden/families.hpp"
#include "golden/flags.hpp"
#include "oracle/diagnosis/diagnosis.hpp"
#include "tool/commands/commands.hpp"
#include "tool/commands/json_output.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {
namespace {

using Json = nlohmann::ordered_json;

/// A list in words, and where it is wanted as JSON, one object a line.
class Listed {
 public:
  explicit Listed(const std::string& json) : json_(json) {}

  void json(const Json& line) {
    if (json_.wanted()) json_.write(line.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
  }
  template <class... Args>
  void words(fmt::format_string<Args...> format, Args&&... args) const {
    if (!json_.alone()) fmt::print(format, std::forward<Args>(args)...);
  }
  void commit() { json_.commit(); }

 private:
  JsonOutput json_;
};

/// As JSON the mutants are among them; in words they are counted, or with `every_mutant` listed.
void list_engines(Listed& list, bool every_mutant) {
  for (const engines::BuiltIn& e : engines::built_in_engines()) {
    list.json({{"name", e.name}, {"scalar", name(e.scalar)}, {"about", e.about}});
    list.words("{:<18}{}  {}\n", e.name, name(e.scalar), e.about);
  }
  for (const engines::Adapter& a : engines::adapters()) {
    const auto command = engines::command_of(a);
    list.json({{"name", a.name},
               {"scalar", name(a.scalar)},
               {"about", a.about},
               {"command", command ? Json(*command) : Json()}});
    list.words("{:<18}{}  {}{}\n", a.name, name(a.scalar), a.about,
               command ? "" : ": not here, ./run engines installs it");
  }
  for (const engines::Mutant& m : engines::mutants()) {
    const std::string full_name = fmt::format("{}{}", engines::kMutantPrefix, m.id);
    list.json({{"name", full_name},
               {"scalar", name(Scalar::binary64)},
               {"about", m.about},
               {"origin", engines::kOriginNames[static_cast<std::size_t>(m.origin)]},
               {"diagnosis", oracle::sentence_of(m.cause)},
               {"source", m.source}});
    if (every_mutant) list.words("{:<40}{}\n", full_name, m.about);
  }
  if (every_mutant)
    for (const engines::Unsteady& one : engines::unsteady_engines())
      list.words("{:<40}{}\n", fmt::format("{}{}", engines::kUnsteadyPrefix, one.id), one.about);
  else
    list.words(
        "{:<18}{} engines with one mistake each, docs/bug-zoo.md; --mutants lists them\n"
        "{:<18}{} engines that --determinism refutes, listed with them\n",
        "mutant:ID", engines::mutants().size(), "unsteady:ID", engines::unsteady_engines().size());
}

/// Families, then flags.
void list_families(Listed& list) {
  for (const Pair pair : pairs_of_kinds()) {
    list.words("{}{}\n", pair == kPairs.front() ? "" : "\n", shapes_of_kind(pair));
    for (const golden::Family& f : golden::families_of(pair)) {
      Json line{{"family", f.name}, {"shapes", shapes_of_kind(pair)}, {"reason", f.reason}};
      if (!f.hits_alone.empty()) line["hits_alone"] = f.hits_alone;
      list.json(line);
      list.words("  {:<17}{}{}\n", f.name, f.reason,
                 f.hits_alone.empty() ? "" : fmt::format(" (hits alone: {})", f.hits_alone));
    }
  }
  list.words("\nflags\n");
  for (const golden::Flag& f : golden::kFlags) {
    list.json({{"flag", f.name}, {"meaning", f.meaning}, {"breaks", f.breaks}});
    list.words("  {:<17}{}\n", f.name, f.meaning);
  }
}

/// The pairs, and what their shapes are made of.
void list_pairs(Listed& list) {
  for (const Pair pair : kPairs) {
    const auto described = [&]<class Shape>(const Shape& shape) {
      Json fields = Json::object();
      for_each_field(shape, [&]<class Value>(const auto& field, const Value& /*value*/) {
        const bool many = SeveralVectors<Value> || (std::same_as<Value, Vector3> && field.kind == FieldKind::length);
        fields[std::string(field.name)] =
            std::string(kFieldKindNames[static_cast<std::size_t>(field.kind)]) + (many ? "s" : "");
      });
      return Json{{"shape", ShapeDescription<Shape>::kName}, {"fields", fields}};
    };
    std::vector<Json> both;
    const Query zeros = zero_query(pair);
    for_each_shape(zeros, [&](const auto& shape) { both.push_back(described(shape)); });
    const bool numbers = has_numbers(pair);
    list.json({{"pair", name(pair)}, {"a", both[0]}, {"b", both[1]}, {"numbers", numbers}});
    list.words("{:<27}{}{}\n", name(pair), shapes_of(pair), numbers ? "" : ", whose contacts have no numbers");
  }
}

/// The tables of docs/formats.md, which a test compares with this.
void print_tables() {
  fmt::print("<!-- families:begin -->\n| shapes | family | why it exists |\n|---|---|---|\n");
  for (const Pair pair : pairs_of_kinds())
    for (const golden::Family& f : golden::families_of(pair))
      fmt::print("| {} | `{}` | {} |\n", shapes_of_kind(pair), f.name, f.reason);
  fmt::print(
      "<!-- families:end -->\n<!-- hits-alone:begin -->\n| shapes | family | why all are hits |\n|---|---|---|\n");
  for (const golden::FamilyNote& f : golden::families_of_hits_alone())
    fmt::print("| {} | `{}` | {} |\n", shapes_of_kind(f.pair), f.family, f.why);
  fmt::print("<!-- hits-alone:end -->\n<!-- flags:begin -->\n| flag | what is true | what breaks |\n|---|---|---|\n");
  for (const golden::Flag& f : golden::kFlags) fmt::print("| `{}` | {} | {} |\n", f.name, f.meaning, f.breaks);
  fmt::print("<!-- flags:end -->\n");
}

/// Text for a cell of a Markdown table.
std::string table_cell(std::string_view text) {
  std::string cell;
  for (const char c : text) cell += c == '|' || c == '*' ? std::string{'\\', c} : std::string(1, c);
  return cell;
}

/// The table of mutants, a page of the site.
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
  const auto add = [&](const std::string& name, const std::string& about, void (*list)(Listed&)) {
    auto* command = app.add_subcommand(name, about);
    auto json = std::make_shared<std::string>();
    add_json_option(*command, *json, "One JSON object a line");
    command->callback([json, list, &exit] {
      Listed listed(*json);
      list(listed);
      listed.commit();
      exit = kCertified;
    });
  };
  auto* engines = app.add_subcommand("engines", "The engines that can be certified by name");
  auto engines_json = std::make_shared<std::string>();
  auto every_mutant = std::make_shared<bool>(false);
  add_json_option(*engines, *engines_json, "One JSON object a line, mutants included");
  engines->add_flag("--mutants", *every_mutant, "Also the engines with one mistake each");
  auto table = std::make_shared<bool>(false);
  engines->add_flag("--table", *table, "The table of mutants on the site")->group("");
  engines->callback([=, &exit] {
    if (*table) {
      require_alone(*engines, "--table");
      print_mutants();
    } else {
      Listed listed(*engines_json);
      list_engines(listed, *every_mutant);
      listed.commit();
    }
    exit = kCertified;
  });
  add("pairs", "The pairs of shapes that can be asked about", list_pairs);
  add("families", "The families of generated questions, and the flags of cases", list_families);
  auto* tables = app.add_subcommand("tables", "The tables of families, on the site, and of flags, in docs/formats.md");
  tables->group("");
  tables->callback([&exit] {
    print_tables();
    exit = kCertified;
  });
}

}  // namespace contact::tool
