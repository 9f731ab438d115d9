// From a seed to a random stream: the one step of the generator that needs SHA-256.
#include <span>

#include "formats/sha256.hpp"
#include "golden/families.hpp"
#include "golden/query_id.hpp"

namespace contact::golden {

Random::Key Random::key(std::string_view pair, std::string_view family, std::string_view scalar, std::uint64_t seed) {
  formats::Sha256 hash;
  hash.add("contact-oracle/1|").add(pair).add("|").add(family).add("|").add(scalar).add("|").add(std::to_string(seed));
  const auto digest = hash.digest();
  return key(std::span(digest).first<16>());
}

Query generate_query(Pair pair, const Family& family, Scalar scalar, std::uint64_t seed, std::uint64_t index) {
  return generate_query(pair, family, scalar, Random::key(name(pair), family.name, name(scalar), seed), index);
}

}  // namespace contact::golden
