// The engines with mistakes, by name.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "engines/zoo/mutants.hpp"
#include "engines/zoo/unsteady.hpp"
#include "formats/input_error.hpp"
#include "tool/commands/engine_options.hpp"
#include "tool/commands/run_command.hpp"

namespace contact::tool {
namespace {

/// How many letters to add, drop or change to make one word of another.
std::size_t edits(std::string_view x, std::string_view y) {
  std::vector<std::size_t> row(y.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < x.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < y.size(); ++j) {
      const std::size_t changed = diagonal + (x[i] == y[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, diagonal + 1, row[j] + 1});
    }
  }
  return row.back();
}

std::unique_ptr<engines::Engine> mutant(std::string_view id) {
  if (auto engine = engines::make_mutant(id)) return engine;
  std::vector<std::pair<std::size_t, std::string_view>> near;
  for (const engines::Mutant& m : engines::mutants()) near.emplace_back(edits(id, m.id), m.id);
  std::stable_sort(near.begin(), near.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
  throw formats::InputError(
      {"command line", 0}, "",
      fmt::format("unknown mutant '{}'; near it: {}, {}, {}; `contact-oracle engines --mutants` lists all {}", id,
                  near.at(0).second, near.at(1).second, near.at(2).second, engines::mutants().size()));
}

std::unique_ptr<engines::Engine> unsteady(const std::string& id) {
  std::vector<std::string_view> ids;
  for (const engines::Unsteady& one : engines::unsteady_engines()) ids.push_back(one.id);
  static_cast<void>(index_of(ids, id, "unsteady engine"));
  return engines::make_unsteady(id);
}

}  // namespace

std::unique_ptr<engines::Engine> zoo_engine(const std::string& name) {
  if (name.starts_with(engines::kMutantPrefix)) return mutant(name.substr(engines::kMutantPrefix.size()));
  return unsteady(name.substr(engines::kUnsteadyPrefix.size()));
}

}  // namespace contact::tool
