// golden/manifest.json: every committed dataset with its digest, counts and origin.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "golden/lint.hpp"

namespace contact::golden {

inline constexpr std::string_view kManifestName = "manifest.json";

/// One entry of the manifest.
struct ManifestEntry {
  std::string path;  ///< relative to the manifest, with forward slashes
  LintedFile file;
};

[[nodiscard]] std::string manifest_text(const std::vector<ManifestEntry>& entries);

/// Compares the manifest of a folder with what was found there: the same files, each entry the same to the byte. Throws
/// InputError naming what differs.
void check_manifest(const std::filesystem::path& folder, const std::vector<ManifestEntry>& found);

}  // namespace contact::golden
