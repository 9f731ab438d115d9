// Is a golden file well formed, canonical to the byte, and is every expectation right?
#include "golden/lint.hpp"
#include "formats/sha256.hpp"

#include <algorithm>

#include "golden/families.hpp"
#include "golden/query_id.hpp"
#include "golden/right_case.hpp"
#include "oracle/truth/exact_truth.hpp"

namespace contact::golden {
namespace {

/// The closest number of a field so far.
struct Candidate {
  Closest closest{};
  oracle::Rational ulps{};
};

void keep_closest(std::vector<Candidate>& all, const oracle::FieldDistance& found, const std::string& id) {
  const auto at = std::find_if(all.begin(), all.end(), [&](const auto& c) { return c.closest.field == found.field; });
  if (at->closest.id.empty() || found.ulps < at->ulps) *at = {{found.field, found.log2, id}, found.ulps};
}

}  // namespace

void check_canonical(const DatasetReader& reader, const std::string& expected) {
  const std::string& text = reader.text();
  if (text == expected) return;
  const auto column = std::mismatch(text.begin(), text.end(), expected.begin(), expected.end()).first - text.begin();
  throw formats::InputError(reader.where(), "",
                            fmt::format("not in canonical form from column {}: expected ...{}", column + 1,
                                        expected.substr(static_cast<std::size_t>(column), 60)));
}

LintedFile lint(const std::filesystem::path& path, bool generated, const std::function<void()>& after_case) {
  DatasetReader reader(path, is_made);
  const DatasetHeader& h = reader.header();
  LintedFile linted{h, find_family(h.pair, h.family) != nullptr, 0, {}, {}, {}, {}};
  for (const Flag& flag : kFlags) linted.flags.emplace_back(flag.name, 0);
  std::vector<Candidate> closest;
  for (const std::string_view field : {"value", "normal", "point1", "point2"})
    closest.emplace_back().closest.field = field;
  formats::Sha256 hash;
  formats::Sha256 answers;
  const auto canonical = [&](const std::string& expected) {
    check_canonical(reader, expected);
    hash.add(expected).add("\n");
  };
  canonical(to_line(reader.header()));

  while (const auto c = reader.next()) {
    if (reader.repeats() != 0 && !generated)
      throw formats::InputError(reader.where(), "id", "the same question stands in this file twice: " + c->id);
    if (c->rejected) {
      check_rejection(*c, reader.where());
    } else {
      const oracle::Truth truth = oracle::truth_of(c->query);
      check_case(*c, reader.header().scalar, truth, reader.where());
      for (const auto& distance : oracle::rounding_distances(truth, reader.header().scalar))
        keep_closest(closest, distance, c->id);
    }
    const Case right = make_case(c->query, reader.header().scalar);
    if (c->flags != right.flags)
      throw formats::InputError(
          reader.where(), "flags",
          fmt::format("the file says [{}], true are [{}]", fmt::join(c->flags, ","), fmt::join(right.flags, ",")));
    canonical(to_line(right));
    answers.add(digest_bytes(right));
    linted.hits += right.expect.hit ? 1 : 0;
    for (auto& [flag, count] : linted.flags)
      count += static_cast<std::uint64_t>(std::count(right.flags.begin(), right.flags.end(), flag));
    after_case();
  }
  std::erase_if(linted.flags, [](const auto& flag) { return flag.second == 0; });
  for (Candidate& each : closest)
    if (!each.closest.id.empty()) linted.closest.push_back(std::move(each.closest));
  linted.sha256 = hash.hex();
  linted.answers = answers.hex();
  return linted;
}

}  // namespace contact::golden
