// Which mutants the golden files kill: each case that refutes one, and the fewest cases that refute them all.
#include "tool/run/kill_matrix.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <unordered_map>

#include "engines/engine.hpp"
#include "engines/zoo/mutants.hpp"
#include "golden/answer_bytes.hpp"
#include "golden/query_id.hpp"
#include "golden/right_case.hpp"
#include "oracle/judge/judge.hpp"
#include "tool/run/parts.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {
namespace {

using Engines = std::vector<std::unique_ptr<engines::Engine>>;

/// A text for each distinct answer. NaN and the sign of a zero are all one: no judgement depends on them.
std::string text_of(const Claim& claim) {
  std::string text{static_cast<char>(claim.status), static_cast<char>(claim.overlap ? 1 + *claim.overlap : 0),
                   static_cast<char>(claim.speaks_of_contact), static_cast<char>(claim.contact.has_value())};
  if (!claim.contact) return text;
  const ContactClaim& c = *claim.contact;
  for (const std::optional<Vector3>& v : {c.normal, c.point1, c.point2, c.point}) {
    text.push_back(static_cast<char>(v.has_value()));
    if (v)
      for (const double x : *v) golden::add_big_endian(text, x);
  }
  for (const ManifoldPoint& point : c.points) {
    for (const double x : point.at) golden::add_big_endian(text, x);
    golden::add_big_endian(text, point.depth);
  }
  text.push_back(static_cast<char>(c.value.has_value()));
  if (c.value) golden::add_big_endian(text, *c.value);
  return text;
}

/// Most mutants answer most questions alike: what is judged is each distinct answer, once for every declaration.
std::vector<std::size_t> killed_by(const golden::Case& c, const Engines& mutants) {
  const engines::Question question{c.id, c.query};
  std::optional<oracle::Truth> truth;
  if (!outside_domain(c.query)) truth = oracle::truth_of(c.query);
  struct Judged {
    const oracle::Declaration* declared;
    bool killed;
  };
  std::unordered_map<std::string, std::vector<Judged>> judged;
  std::map<Scalar, Expectation> rounded;  // a number that equals it needs no exact comparison
  const auto refutes = [&](const Claim& claim, const oracle::Declaration& declared) {
    std::vector<Judged>& known = judged[text_of(claim)];
    for (const Judged& j : known)
      if (*j.declared == declared) return j.killed;
    if (truth && !rounded.contains(declared.scalar))
      rounded[declared.scalar] = oracle::expectation(*truth, declared.scalar);
    const oracle::Verdict verdict =
        truth ? oracle::judge(c.query, *truth, claim, declared, &rounded[declared.scalar], oracle::Detail::grades)
              : oracle::judge_outside_domain(claim);
    known.push_back({&declared, verdict.level() > oracle::Level::bounded});
    return known.back().killed;
  };
  std::vector<std::size_t> kills;
  for (std::size_t m = 0; m < mutants.size(); ++m)
    if (refutes(mutants[m]->answer({&question, 1}).front(), mutants[m]->info().declared)) kills.push_back(m);
  return kills;
}

}  // namespace

KillMatrix kill_matrix(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& datasets) {
  Engines mutants;
  for (const engines::Mutant& m : engines::mutants()) mutants.push_back(engines::make_mutant(m.id));
  KillMatrix matrix;
  std::vector<golden::Case> cases;
  for (const auto& path : datasets) {
    golden::DatasetReader reader(path, golden::is_made);
    while (auto c = reader.next()) {
      matrix.cases.push_back({matrix.files.size(), c->id, c->query, {}});
      cases.push_back(std::move(*c));
    }
    matrix.files.push_back(
        {path.lexically_relative(folder).generic_string(), reader.header(), digest_of_file(path), {}});
  }
  Progress progress("mutants", cases.size());
  constexpr std::size_t kShare = kRun / 8;  // a question is put to hundreds of engines
  for (std::size_t begin = 0; begin < cases.size(); begin += kShare) {
    throw_if_interrupted();
    const std::size_t n = std::min(kShare, cases.size() - begin);
    in_parallel(n, [&](std::size_t i) { matrix.cases[begin + i].mutants = killed_by(cases[begin + i], mutants); });
    progress.add(n);
  }
  for (const CaseKills& c : matrix.cases) matrix.files[c.file].mutants.insert(c.mutants.begin(), c.mutants.end());
  return matrix;
}

std::vector<std::size_t> cover(const std::vector<CaseKills>& cases, const std::vector<std::size_t>& order) {
  std::set<std::size_t> left;
  for (const std::size_t i : order) left.insert(cases[i].mutants.begin(), cases[i].mutants.end());
  std::vector<std::size_t> taken;
  while (!left.empty()) {
    const auto gain = [&](std::size_t i) {
      return std::count_if(cases[i].mutants.begin(), cases[i].mutants.end(), [&](auto m) { return left.contains(m); });
    };
    std::size_t best = order.front();
    auto most = gain(best);
    for (const std::size_t i : order)
      if (const auto n = gain(i); n > most) {
        best = i;
        most = n;
      }
    taken.push_back(best);
    for (const std::size_t m : cases[best].mutants) left.erase(m);
  }
  std::unordered_map<std::size_t, int> killers;
  for (const std::size_t i : taken)
    for (const std::size_t m : cases[i].mutants) ++killers[m];
  std::erase_if(taken, [&](std::size_t i) {
    const auto& kills = cases[i].mutants;
    const bool spare = std::all_of(kills.begin(), kills.end(), [&](std::size_t m) { return killers[m] > 1; });
    if (spare)
      for (const std::size_t m : kills) --killers[m];
    return spare;
  });
  std::sort(taken.begin(), taken.end());
  return taken;
}

}  // namespace contact::tool
