// What came of asking an engine again.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "oracle/truth/query.hpp"

namespace contact::tool {

/// One way in which all questions were asked again.
struct Way {
  std::string how{};
  std::uint64_t asked = 0;
  std::uint64_t differ = 0;  ///< answers that are not those of the first time
  std::string question{};    ///< the first of them: a line for `explain`
  std::string before{};      ///< its answers, as objects
  std::string now{};
};

/// The answers of the first time to the questions of a source.
struct SourceDigest {
  Pair pair;
  Scalar scalar;
  std::string family;
  std::uint64_t answers = 0;
  std::string sha256{};  ///< of "id claim" and a line feed for each, as a results file has them
  /// Of the first kMostSingle: the id, and 8 hexadecimal digits of the SHA-256 of its line.
  std::string each{};
};
inline constexpr std::uint64_t kMostSingle = 100'000;

struct Repeats {
  std::vector<Way> ways;
  std::vector<SourceDigest> digests;
  std::string sha256;  ///< of all answers in their order

  [[nodiscard]] bool same() const;
  /// A line a way.
  [[nodiscard]] std::vector<std::string> lines() const;
  /// {...} of a JSON report.
  [[nodiscard]] std::string json() const;
};

}  // namespace contact::tool
