// What engines say on paper: claims and declarations in JSON, and the results file that records them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "formats/json.hpp"
#include "oracle/judge/claim.hpp"
#include "oracle/judge/judge.hpp"

namespace contact::engines {

/// Who answers, and what it declares.
struct EngineInfo {
  std::string name;
  std::string version;
  std::vector<Pair> pairs{kPairs.begin(), kPairs.end()};
  oracle::Declaration declared;
  /// The pairs whose answers mean something else, in the order of the pairs, and what.
  std::map<Pair, Conventions> pair_conventions{};

  [[nodiscard]] bool serves(Pair pair) const;
  /// What answers about a pair are judged by.
  [[nodiscard]] oracle::Declaration declared_for(Pair pair) const;
};

/// "engine", "scalar", "pairs", "conventions", "pair_conventions", "bounds", "claims" and "tolerance" of a results
/// header or a hello message, which has no other keys than these and those `beside` them.
[[nodiscard]] EngineInfo read_engine_info(const formats::Node& node, std::initializer_list<std::string_view> beside);
[[nodiscard]] Tolerance read_tolerance(const formats::Node& node);
[[nodiscard]] std::string tolerance_object(const Tolerance& tolerance);
[[nodiscard]] std::string conventions_text(const Conventions& conventions);
/// "pair_conventions":{...}, or nothing where every pair has the same.
[[nodiscard]] std::string pair_conventions_text(const EngineInfo& engine);
/// `,"rounds":["orientation"]` where that is declared, else nothing.
[[nodiscard]] std::string rounds_text(const EngineInfo& engine);
/// The same written, without braces, and the header of a results file.
[[nodiscard]] std::string engine_text(const EngineInfo& engine);
[[nodiscard]] std::string to_line(const EngineInfo& engine);

/// Puts the binary32 numbers in the place of decimals that were written for them, where the scalar is binary32; how many
/// there were.
std::uint64_t settle_decimals(Claim& claim, Scalar scalar);
/// The claim of an answer or of a results line; keys other than the claim's own are the caller's to check.
[[nodiscard]] Claim read_claim(const formats::Node& node);
/// ,"overlap":...,"contact":... of a claim, and one line of a results file.
[[nodiscard]] std::string claim_text(const Claim& claim);
/// The same as an object of its own, which is {} where nothing is claimed.
[[nodiscard]] std::string claim_object(const Claim& claim);
[[nodiscard]] std::string to_line(const std::string& id, const Claim& claim);

inline constexpr std::string_view kResultsFormat = "contact-oracle/results";
inline constexpr std::uint64_t kResultsVersion = 1;
/// Throws formats::InputError where a header says that it is of another format or version.
void check_results_format(const formats::Node& header);

/// A results file, whole: JSON lines, or columns with ids.
struct Results {
  EngineInfo engine;
  std::unordered_map<std::string, Claim> claims;
  std::uint64_t decimals = 0;  ///< settle_decimals of all
};
[[nodiscard]] Results read_results(const std::filesystem::path& path);

}  // namespace contact::engines
