// golden/manifest.json: every committed dataset with its digest, counts and origin.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "golden/lint.hpp"

namespace contact::golden {

inline constexpr std::string_view kManifestName = "manifest.json";
inline constexpr std::string_view kAdequacyName = "adequacy.json";

/// For each number of questions the digest of the answers to so many, golden/answer_bytes.hpp.
using Digests = std::map<std::uint64_t, std::string>;
/// Beside that of the file's own answers a generated file has those of its generator's first so many.
inline constexpr std::uint64_t kManyAnswers = 10'000;
/// Of the answers of a pair; of any two convex shapes each takes ten times as long.
[[nodiscard]] constexpr std::uint64_t many_answers(Pair pair) {
  return is_convex(pair) ? kManyAnswers / 10 : kManyAnswers;
}
inline constexpr std::uint64_t kMostAnswers = 1'000'000;

/// One entry of the manifest.
struct ManifestEntry {
  std::string path;  ///< relative to the manifest, with forward slashes
  LintedFile file;
  Digests digests;
  std::optional<std::uint64_t> kills{};  ///< how many mutants it kills, where that is known
};

[[nodiscard]] std::string manifest_text(const std::vector<ManifestEntry>& entries);

/// What a folder's manifest holds that its files do not tell: by path the generator and the digests. Nothing where
/// there is no manifest.
struct Recorded {
  std::string generator;
  Digests digests;
};
[[nodiscard]] std::map<std::string, Recorded> recorded_digests(const std::filesystem::path& folder);

/// How many mutants each file kills, from a folder's adequacy.json, which must be about these very files. Nothing where
/// there is none.
[[nodiscard]] std::map<std::string, std::uint64_t> recorded_kills(const std::filesystem::path& folder,
                                                                  const std::vector<ManifestEntry>& entries);

/// Puts other digests into the entry of a file.
void record_digests(const std::filesystem::path& folder, const std::string& path, const Digests& digests);

/// Compares the manifest of a folder with what was found there: the same files, each entry the same to the byte. Throws
/// formats::InputError naming what differs.
void check_manifest(const std::filesystem::path& folder, const std::vector<ManifestEntry>& found);

}  // namespace contact::golden
