// The families of generated questions: named, seeded, each with a reason to exist.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "golden/random.hpp"
#include "oracle/query.hpp"

namespace contact::golden {

/// A named generator. Every number that it makes for binary32 is exactly representable there.
struct Family {
  std::string_view name;
  std::string_view reason;
  Query (*make)(Pair pair, Scalar scalar, Random& random);
  bool spheres;                 ///< for sphere pairs, else for cubes
  bool every_sphere_kind;       ///< committed for the two rigid kinds too, which share the mathematics
  bool outside_domain = false;  ///< makes questions that must be refused
};

/// The family that makes them. Its files hold such questions and no others, and are judged only when named.
inline constexpr std::string_view kInvalidFamily = "invalid";

[[nodiscard]] std::span<const Family> sphere_families();
[[nodiscard]] std::span<const Family> cube_families();
/// The families that make questions for a pair.
[[nodiscard]] std::span<const Family> families_of(Pair pair);
/// The family of that name for a pair, or nullptr.
[[nodiscard]] const Family* find_family(Pair pair, std::string_view name);

/// One question: a pure function of its arguments, the same on every platform.
[[nodiscard]] Query generate_query(Pair pair, const Family& family, Scalar scalar, Random::Key key,
                                   std::uint64_t index);
/// The same with the key of pair, family, scalar and seed.
[[nodiscard]] Query generate_query(Pair pair, const Family& family, Scalar scalar, std::uint64_t seed,
                                   std::uint64_t index);

/// A file of golden/ that a family makes; the rest of golden/ is annotated from recorded questions.
struct CommittedFile {
  Pair pair;
  Scalar scalar;
  const Family* family;

  [[nodiscard]] std::string path() const;  ///< below golden/
};
[[nodiscard]] std::vector<CommittedFile> committed_files();
inline constexpr std::uint64_t kCommittedSeed = 42;
inline constexpr std::uint64_t kCommittedCount = 210;  ///< a multiple of the classes that take turns, over 200

/// Spoils one number of a question so that it lies outside the domain: the family `invalid`.
void spoil(Query& query, Random& random);

}  // namespace contact::golden
