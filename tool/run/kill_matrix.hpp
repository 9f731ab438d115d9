// Which mutants the golden files kill: each case that refutes one, and the fewest cases that refute them all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "golden/dataset.hpp"

namespace contact::tool {

/// How many cases must kill a mutant: one alone could go with the next change of a family.
inline constexpr std::size_t kLeastKills = 10;

/// A case, and the mutants that it kills: their places in engines::mutants(), ascending. A case kills a mutant whose
/// answer it finds worse than `bounded`, which is what `certify` requires, under the mutant's own declaration.
struct CaseKills {
  std::size_t file;
  std::string id;
  Query query;
  std::vector<std::size_t> mutants;
};

struct FileKills {
  std::string path;  ///< relative to the folder, with forward slashes
  golden::DatasetHeader header;
  std::string sha256;
  std::set<std::size_t> mutants;
};

struct KillMatrix {
  std::vector<FileKills> files;
  std::vector<CaseKills> cases;  ///< in the order of the files
};

/// Asks every mutant every question of the datasets, which lie below `folder`.
[[nodiscard]] KillMatrix kill_matrix(const std::filesystem::path& folder,
                                     const std::vector<std::filesystem::path>& datasets);

/// Places of cases that together kill whatever all of them kill, in ascending order. Greedy: the case that kills most
/// of those left is taken, the first of equals in `order`; at the end one whose kills the others have too is left out.
[[nodiscard]] std::vector<std::size_t> cover(const std::vector<CaseKills>& cases,
                                             const std::vector<std::size_t>& order);

}  // namespace contact::tool
