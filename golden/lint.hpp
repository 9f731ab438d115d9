// Is a golden file well formed, canonical to the byte, and is every expectation right?
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "golden/dataset.hpp"

namespace contact::golden {

/// The case whose number of a field lies closest to a boundary of its rounding, ties apart; the first of several.
struct Closest {
  std::string_view field;
  int log2 = 0;  ///< of its distance from there in ulps, rounded down
  std::string id;
};

/// What lint saw of a file that it found right.
struct LintedFile {
  DatasetHeader header;
  bool generated = false;  ///< a family of its pair makes it
  std::uint64_t hits = 0;
  std::string sha256;
  std::string answers;                                       ///< the digest of its answers
  std::vector<std::pair<std::string, std::uint64_t>> flags;  ///< every flag that occurs, with its count
  std::vector<Closest> closest;  ///< of every field that is answered somewhere off a boundary
};

/// Refuses what the reader read last unless its text is `expected`, the canonical one.
void check_canonical(const DatasetReader& reader, const std::string& expected);

/// Checks one dataset; throws formats::InputError at the first thing that is wrong. `generated` allows a file that its
/// family's generator made to repeat a question. `after_case` is called after each case: it shows progress, and throws
/// to end the work.
[[nodiscard]] LintedFile lint(const std::filesystem::path& path, bool generated,
                              const std::function<void()>& after_case);

}  // namespace contact::golden
