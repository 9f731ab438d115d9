// The families of generated questions: named, seeded, each with a reason to exist.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "golden/names.hpp"
#include "golden/random.hpp"
#include "oracle/truth/query.hpp"

namespace contact::golden {

/// A named generator. Every number that it makes for binary32 is exactly representable there.
struct Family {
  std::string_view name;
  std::string_view reason;
  /// Why it is there although other families kill every mutant that it kills: mutants are mistakes that somebody
  /// thought of, and a family is there for the engine that nobody has seen. Empty where it alone kills one.
  std::string_view kept_for;
  Query (*make)(Pair pair, Scalar scalar, Random& random);
  bool every_pair = false;      ///< committed for every pair of its two shapes, else for the first of them
  bool outside_domain = false;  ///< makes questions that must be refused
  /// Why it makes nothing but hits. Empty where both answers occur, as they do wherever the family's meaning allows it.
  std::string_view hits_alone = {};
};

// The families of each kind of pairs, in files of its own; the pointer says which, and is nullptr.
#define CONTACT_DECLARE(A, B) [[nodiscard]] std::span<const Family> families_of(const Two<A, B>* kind);
CONTACT_KINDS(CONTACT_DECLARE)
#undef CONTACT_DECLARE
/// The families that make questions for a pair.
[[nodiscard]] std::span<const Family> families_of(Pair pair);
/// What is said of a family, made by the tables or recorded from elsewhere.
struct FamilyNote {
  Pair pair;  ///< the first of its two shapes
  std::string_view family;
  std::string_view why;
};
/// Families of hits alone: who always says hit is right about each of their decisions. No family is of misses alone.
[[nodiscard]] std::vector<FamilyNote> families_of_hits_alone();
/// Families that alone kill no mutant, and why they are there.
[[nodiscard]] std::vector<FamilyNote> families_kept();
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
/// How many of them are committed. Of rays that are cast there are five pairs, of any two convex shapes nineteen, whose
/// exact numbers are long; of these eight have files, and the others the same families.
[[nodiscard]] constexpr std::uint64_t committed_count(Pair pair) {
  if (!is_convex(pair)) return is_cast(pair) ? 30 : kCommittedCount;
  constexpr std::array kOnFile{Pair::obb_obb,           Pair::sphere_obb, Pair::capsule_obb, Pair::capsule_triangle,
                               Pair::triangle_triangle, Pair::obb_plane,  Pair::hull_hull,   Pair::hull_plane};
  return std::find(kOnFile.begin(), kOnFile.end(), pair) != kOnFile.end() ? 20 : 0;
}

/// Spoils one number of a question so that it lies outside the domain: the family `invalid`.
void spoil(Query& query, Random& random);

}  // namespace contact::golden
