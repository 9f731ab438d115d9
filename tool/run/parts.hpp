// A run cut into parts: judged anywhere, kept in files, merged to the report of the whole run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tool/run/pipeline.hpp"

namespace contact::tool {

/// The SHA-256 of a file's bytes, in hexadecimal.
[[nodiscard]] std::string digest_of_file(const std::filesystem::path& path);

/// What one part found, of each subject.
struct Part {
  std::vector<Findings> found;
  std::vector<std::vector<std::string>> unasked;  ///< recorded answers that no question of this part asked for
};

/// The questions of part I of N, of all sources one after another: those from floor(I C / N) to below
/// floor((I + 1) C / N) of C. Every part has every source, if with no question, so that parts merge source by source.
[[nodiscard]] std::vector<Source> cut(std::vector<Source> sources, golden::Shard part);

/// Judges the questions of `sources`. The subjects' reports have no findings, before and after.
[[nodiscard]] Part judge_part(const std::vector<Source>& sources, std::vector<Subject>& subjects, Stop& stop,
                              Oracles& oracles);

/// Adds what the next part found, or the first, to the reports of its subjects.
void merge(std::vector<Report>& reports, Part part, bool first);

/// The bytes of a part, and the part of those bytes: for files and between the processes of a cluster.
[[nodiscard]] std::string pack(Part part);
[[nodiscard]] Part unpack(const std::string& bytes);

/// What is judged, and how: the same text for every part of a run and for no other run. Datasets are known by their
/// SHA-256.
[[nodiscard]] std::string run_text(const std::vector<Source>& sources, const Report& report);

/// A part in a file: a line of JSON that says of which run it is, and a digest; then the packed part.
struct PartFile {
  std::filesystem::path path;
  golden::Shard part;
  std::string run;  ///< what run_text said
  Part content;
};

[[nodiscard]] std::filesystem::path part_name(golden::Shard part);  ///< part-3-of-64.part
void write_part(const std::filesystem::path& path, golden::Shard part, const std::string& run,
                const std::string& bytes);
/// Throws formats::InputError where the file is not whole, not of this version, or no part.
[[nodiscard]] PartFile read_part(const std::filesystem::path& path);
/// Throws formats::InputError, saying what differs, where a part is of another run.
void require_run(const PartFile& file, const std::string& run, const std::string& whose);
/// A report without findings, of the run that a part belongs to.
[[nodiscard]] Report report_of(const PartFile& file);

}  // namespace contact::tool
