// engines and families: what there is.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <memory>

#include "engines/engine.hpp"
#include "golden/families.hpp"
#include "golden/flags.hpp"
#include "golden/json.hpp"
#include "tool/commands.hpp"
#include "tool/process.hpp"

namespace contact::tool {
namespace {

using golden::json_string;

void list_engines(bool json) {
  for (const engines::BuiltIn& e : engines::built_in_engines())
    if (json)
      fmt::print("{{\"name\":{},\"scalar\":\"{}\",\"about\":{}}}\n", json_string(e.name), name(e.scalar),
                 json_string(e.about));
    else
      fmt::print("{:<14}{}  {}\n", e.name, name(e.scalar), e.about);
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
  add("engines", "The engines that can be certified by name", list_engines);
  add("families", "The families of generated questions, and the flags of cases", list_families);
  auto* tables = app.add_subcommand("tables", "The tables of families and flags in docs/formats.md");
  tables->group("");
  tables->callback([&exit] {
    print_tables();
    exit = kCertified;
  });
}

}  // namespace contact::tool
