// Digests of a generator's answers, worked out on every thread and in order, in constant memory.
#include "tool/run/digests.hpp"

#include <algorithm>

#include "formats/sha256.hpp"
#include "golden/agreement.hpp"
#include "golden/answer_bytes.hpp"
#include "golden/query_id.hpp"
#include "tool/run/pipeline.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {

std::vector<std::string> digests_of(const golden::CommittedFile& stream, std::uint64_t seed, std::uint64_t first,
                                    const std::vector<std::uint64_t>& counts, AnswerBytes answer) {
  const golden::Random::Key key =
      golden::Random::key(name(stream.pair), stream.family->name, name(stream.scalar), seed);
  Progress progress(stream.path(), counts.back());
  formats::Sha256 hash;
  std::vector<std::string> digests;
  std::uint64_t done = 0;
  for (const std::uint64_t count : counts) {
    while (done < count) {
      throw_if_interrupted();
      std::vector<std::string> answers(std::min<std::uint64_t>(kRun, count - done));
      in_parallel(answers.size(), [&](std::size_t i) {
        const Query query = golden::generate_query(stream.pair, *stream.family, stream.scalar, key, first + done + i);
        answers[i] = answer(query, stream.scalar);
      });
      for (const std::string& bytes : answers) hash.add(bytes);
      done += answers.size();
      progress.add(answers.size());
    }
    digests.push_back(hash.hex());
  }
  return digests;
}

std::string oracle_bytes(const Query& query, Scalar scalar) {
  if (const auto error = outside_domain(query)) return golden::digest_bytes(*error);
  const oracle::StagedAnswer staged = oracle::staged_answer(query, scalar);
  if (is_checked(Check::sample, golden::kMostAnswers, golden::query_id(query), staged.stage))
    golden::check_stage(query, oracle::truth_of(query), staged, scalar);
  return golden::digest_bytes(staged.expected);
}

golden::Digests renewed_digests(const golden::CommittedFile& stream, const golden::Recorded& recorded, Most most) {
  using golden::kMostAnswers;
  const std::uint64_t many = golden::many_answers(stream.pair);
  const auto first = [&](const std::vector<std::uint64_t>& counts) {
    return digests_of(stream, golden::kCommittedSeed, 0, counts, oracle_bytes);
  };
  golden::Digests digests{{many, first({many}).front()}};
  const auto before = recorded.digests.find(many);
  const auto kept = recorded.digests.find(kMostAnswers);
  const bool same = recorded.generator == golden::kGenerator && before != recorded.digests.end() &&
                    before->second == digests[many] && kept != recorded.digests.end();
  if (same && most != Most::anew)
    digests.insert(*kept);
  else if (most != Most::keep)
    digests[kMostAnswers] = first({kMostAnswers}).front();
  return digests;
}

}  // namespace contact::tool
