// Is a golden file well formed, canonical to the byte, and is every expectation right?
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "golden/dataset.hpp"

namespace contact::golden {

/// What lint saw of a file that it found right.
struct LintedFile {
  DatasetHeader header;
  std::uint64_t hits = 0;
  std::string sha256;
  std::string answers;                                       ///< the digest of its answers
  std::vector<std::pair<std::string, std::uint64_t>> flags;  ///< every flag that occurs, with its count
};

/// Checks one dataset; throws InputError at the first thing that is wrong. `generated` allows a file that its family's
/// generator made to repeat a question. `after_case` is called after each case (progress).
[[nodiscard]] LintedFile lint(const std::filesystem::path& path, bool generated,
                              const std::function<void()>& after_case);

}  // namespace contact::golden
