// Digests of a generator's answers, worked out on every thread and in order, in constant memory.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "golden/families.hpp"
#include "golden/manifest.hpp"

namespace contact::tool {

/// The bytes of an answer, golden::digest_bytes of it.
using AnswerBytes = std::string (*)(const Query& query, Scalar scalar);

/// The oracle's, by its stages; a sample of the questions is put to all oracles (docs/oracle-stages.md).
[[nodiscard]] std::string oracle_bytes(const Query& query, Scalar scalar);

/// The digest of the answers to the first counts[0] questions from number `first`, to the first counts[1], and so on.
/// Domain: `counts` ascend.
[[nodiscard]] std::vector<std::string> digests_of(const golden::CommittedFile& stream, std::uint64_t seed,
                                                  std::uint64_t first, const std::vector<std::uint64_t>& counts,
                                                  AnswerBytes answer);

/// What becomes of the digest of the most answers, which takes long: kept where the generator's version and the digest
/// of many answers are what they were, and otherwise left out (keep) or made (fill), or made in any case (anew).
enum class Most { keep, fill, anew };

/// The digests of a committed file's generator, by the oracle: that of many answers always.
[[nodiscard]] golden::Digests renewed_digests(const golden::CommittedFile& stream, const golden::Recorded& recorded,
                                              Most most);

}  // namespace contact::tool
