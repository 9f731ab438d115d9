// What a run found: counts and worst cases by family and field, and the verdict.
#include "tool/reports/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "golden/dataset.hpp"
#include "oracle/judge/manifold.hpp"
#include "oracle/judge/right_claim.hpp"
#include "tool/reports/table.hpp"

namespace contact::tool {
namespace {

constexpr std::array<std::string_view, 7> kStatusPlurals{"answered", "unsupported", "rejected", "errors",
                                                         "timeouts", "crashes",     "missing"};

std::string count(std::uint64_t n, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

std::uint64_t sum(const auto& counts) { return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}); }

/// All that an answer about a pair may say: its decisions, and numbers where a right answer has any.
Aspects can_be_said(Pair pair, const Conventions& conventions, bool has_numbers) {
  Aspects all{Aspect::overlap, Aspect::contact};
  if (!has_numbers) return all;
  all.add(Aspect::normal);
  all.add(Aspect::value);
  if (conventions.points == Points::midpoint) {
    all.add(Aspect::point);
  } else if (conventions.points == Points::manifold) {
    if (oracle::has_manifold(pair)) all.add(Aspect::points);
  } else {
    all.add(Aspect::point1);
    all.add(Aspect::point2);
  }
  return all;
}

}  // namespace

int power_of(double ulps) {
  return std::isinf(ulps) ? kFarthestPower : std::clamp(std::ilogb(ulps), -kFarthestPower, kFarthestPower);
}

std::uint64_t FieldCount::judged() const { return sum(grades); }

void FieldCount::add(const oracle::FieldVerdict& verdict, const std::string& id) {
  ++grades[static_cast<std::size_t>(verdict.grade)];
  // A vector may have a component that is not finite and others that are far off: it is in one class, the worse one.
  if (verdict.grade == Grade::correctly_rounded || verdict.grade == Grade::not_finite) return;
  ++errors[power_of(verdict.error)];
  if (verdict.error > worst) {
    worst = verdict.error;
    worst_id = id;
  }
}

void FieldCount::merge(const FieldCount& other) {
  for (std::size_t i = 0; i < grades.size(); ++i) grades[i] += other.grades[i];
  for (const auto& [power, count] : other.errors) errors[power] += count;
  if (other.worst > worst) {
    worst = other.worst;
    worst_id = other.worst_id;
  }
}

std::string FamilyReport::title() const {
  if (family == "total") return fresh ? "fresh questions" : family;
  return family_title(pair, family, scalar) + (fresh ? ", fresh" : "");
}

FieldCount FamilyReport::all_fields() const {
  FieldCount all;
  for (const FieldCount& field : fields) all.merge(field);
  return all;
}

std::uint64_t FamilyReport::judged(bool allow_unsupported) const {
  return cases - (allow_unsupported ? with(Claim::Status::unsupported) : 0);
}

Level FamilyReport::level(bool allow_unsupported) const {
  FamilyReport with_accepted = *this;
  with_accepted.accepted_levels = {};
  return with_accepted.level_but_accepted(allow_unsupported);
}

std::optional<Level> FamilyReport::worst_level(bool allow_unsupported) const {
  for (std::size_t i = levels.size(); i-- > 0;) {
    const bool left_out = allow_unsupported && static_cast<Level>(i) == Level::none;
    if (levels[i] != accepted_levels[i] + (left_out ? with(Claim::Status::unsupported) : 0))
      return static_cast<Level>(i);
  }
  return std::nullopt;
}

Level FamilyReport::level_but_accepted(bool allow_unsupported) const {
  const bool any_number = all_fields().judged() != 0;
  const std::optional<Level> worst = worst_level(allow_unsupported);
  return worst ? std::max(*worst, any_number ? Level::correctly_rounded : Level::decisions) : Level::none;
}

bool FamilyReport::reaches(Level required, bool allow_unsupported) const {
  return level_but_accepted(allow_unsupported) <= (with_numbers == 0 ? std::max(required, Level::decisions) : required);
}

std::optional<std::string_view> FamilyReport::one_answer() const {
  Sides all;
  for (const Sides& sides : decisions) {
    if (sides.both()) return std::nullopt;
    all.merge(sides);
  }
  if (all.both()) return "the same";
  if (all.hits == 0 && all.misses == 0) return std::nullopt;
  return all.hits != 0 ? "hit" : "miss";
}

void FamilyReport::add(const Verdict& verdict, Level level, const std::string& id, bool hit,
                       const std::optional<MarginBin>& margin) {
  ++cases;
  hits += hit ? 1 : 0;
  missed_hits += verdict.missed_hit() ? 1 : 0;
  false_hits += verdict.false_hit() ? 1 : 0;
  not_finite += verdict.not_finite() ? 1 : 0;
  outside_domain += verdict.answered_outside_domain ? 1 : 0;
  refused += verdict.refused_outside_domain ? 1 : 0;
  ++statuses[static_cast<std::size_t>(verdict.status)];
  for (std::size_t i = 0; i < fields.size(); ++i)
    if (verdict.fields[i]) fields[i].add(*verdict.fields[i], id);
  const std::array expected{verdict.overlap_expected, verdict.contact_expected};
  if (expected[0] || expected[1]) decided.add(expected[0].value_or(false) || expected[1].value_or(false));
  const std::array judged{verdict.overlap, verdict.contact};
  for (std::size_t i = 0; i < decisions.size(); ++i) {
    if (!expected[i]) continue;
    decisions[i].add(*expected[i]);
    if (judged[i] != oracle::Decision::unclaimed)
      said[i].add(judged[i] == oracle::Decision::right ? *expected[i] : !*expected[i]);
  }
  with_numbers += verdict.has_numbers ? 1 : 0;
  incomplete += verdict.missing.empty() ? 0 : 1;
  for (std::size_t i = 0; i < missing.size(); ++i) missing[i] += verdict.missing.has(static_cast<Aspect>(i)) ? 1 : 0;
  ++levels[static_cast<std::size_t>(level)];
  if (!margin || (verdict.overlap == oracle::Decision::unclaimed && verdict.contact == oracle::Decision::unclaimed))
    return;
  Decisions& there = margins[*margin];
  ++there.claimed;
  there.wrong += verdict.missed_hit() || verdict.false_hit() ? 1 : 0;
}

bool FamilyReport::none_beyond_tolerance(bool allow_unsupported) const {
  return fitness.beyond == accepted + (allow_unsupported ? with(Claim::Status::unsupported) : 0);
}

bool FamilyReport::within_tolerance(bool allow_unsupported) const {
  const bool no_number = with_numbers != 0 && all_fields().judged() == 0;
  return none_beyond_tolerance(allow_unsupported) && !no_number && judged(allow_unsupported) != accepted;
}

void FamilyReport::add_fitness(const Verdict& verdict, const Query& query) {
  fitness.add(verdict, query, scalar);
  if (is_everyday(query)) everyday.add(verdict, query, scalar);
  if (const double off = verdict.at(oracle::Measure::decision).most;
      verdict.false_hit() && off > farthest_false_hit.off)
    farthest_false_hit = {off, golden::query_line(query, scalar)};
}

std::uint64_t FamilyReport::could_be_false_hits() const {
  // Where the conventions of the two decisions differ, the misses of the one are among those of the other.
  return std::max({decided.misses, decisions[0].misses, decisions[1].misses});
}

void FamilyReport::accept(Level level) {
  ++accepted;
  ++accepted_levels[static_cast<std::size_t>(level)];
}

void FamilyReport::add_unreached(std::uint64_t count) {
  cases += count;
  statuses[static_cast<std::size_t>(Claim::Status::missing)] += count;
  levels[static_cast<std::size_t>(Level::none)] += count;
  fitness.never += count;
  fitness.beyond += count;
}

void FamilyReport::merge(const FamilyReport& other) {
  cases += other.cases;
  hits += other.hits;
  missed_hits += other.missed_hits;
  false_hits += other.false_hits;
  farthest_false_hit.merge(other.farthest_false_hit);
  not_finite += other.not_finite;
  outside_domain += other.outside_domain;
  refused += other.refused;
  accepted += other.accepted;
  for (std::size_t i = 0; i < statuses.size(); ++i) statuses[i] += other.statuses[i];
  for (std::size_t i = 0; i < fields.size(); ++i) fields[i].merge(other.fields[i]);
  decided.merge(other.decided);
  for (std::size_t i = 0; i < decisions.size(); ++i) {
    decisions[i].merge(other.decisions[i]);
    said[i].merge(other.said[i]);
  }
  askable.merge(other.askable);
  with_numbers += other.with_numbers;
  incomplete += other.incomplete;
  for (std::size_t i = 0; i < missing.size(); ++i) missing[i] += other.missing[i];
  for (std::size_t i = 0; i < levels.size(); ++i) {
    levels[i] += other.levels[i];
    accepted_levels[i] += other.accepted_levels[i];
  }
  for (const auto& [margin, there] : other.margins) {
    margins[margin].claimed += there.claimed;
    margins[margin].wrong += there.wrong;
  }
  fitness.merge(other.fitness);
  everyday.merge(other.everyday);
}

std::string WorstCase::what() const {
  if (verdict.status != Claim::Status::answered)
    return fmt::format("{}: {}", name(verdict.status), formats::visible(verdict.text));
  if (verdict.answered_outside_domain) return "an answer outside the domain";
  if (verdict.missed_hit() || verdict.false_hit()) {
    const oracle::Off& off = verdict.at(oracle::Measure::decision);
    return fmt::format("{} hit, {} from where the answer changes{}", verdict.missed_hit() ? "missed" : "false",
                       rounded_up(off.most),
                       verdict.decision_last_bit  ? " (no worse than the inputs' last bit)"
                       : verdict.decision_rounded ? " (within the rounding of an orientation)"
                                                  : "");
  }
  if (!verdict.missing.empty()) return fmt::format("missing field: {}", fmt::join(verdict.missing.names(), ", "));
  Grade worst = Grade::correctly_rounded;
  for (const auto& f : verdict.fields)
    if (f) worst = std::max(worst, f->grade);
  std::string text;
  for (const Field field : oracle::kFields) {
    const auto& f = verdict.at(field);
    if (!f || f->grade < std::min(worst, Grade::beyond_bound)) continue;
    if (!text.empty()) text += ", ";
    text += f->grade == Grade::not_finite ? fmt::format("{} not finite", name(field))
            : f->too_many                 ? fmt::format("{} more than declared", name(field))
                                          : fmt::format("{} off by {:.4g} ulps{}", name(field), f->error,
                                        f->last_bit ? " (no worse than the inputs' last bit)" : "");
  }
  return text;
}

WorstCase::Kind WorstCase::kind() const {
  if (verdict.status != Claim::Status::answered || verdict.answered_outside_domain) return Kind::no_answer;
  if (verdict.missed_hit()) return Kind::missed_hit;
  if (verdict.false_hit()) return Kind::false_hit;
  if (!verdict.missing.empty()) return Kind::missing_field;
  return verdict.not_finite() ? Kind::not_finite : Kind::number_off;
}

Claim WorstCase::right(const oracle::Declaration& declared) const {
  if (inside_domain(query)) return oracle::right_claim(query, oracle::truth_of(query), declared);
  return Claim::without(Claim::Status::rejected, outside_domain(query)->field);
}

double WorstCase::severity() const {
  // By kind first; numbers that are off by how much.
  double error = 0;
  for (const auto& field : verdict.fields)
    if (field) error = std::max(error, field->error);
  return kind() == Kind::number_off ? std::min(error, 1e300)
                                    : std::ldexp(1e300, static_cast<int>(Kind::number_off) - static_cast<int>(kind()));
}

void Findings::add(const WorstCase& c) {
  const auto above = [](double severity, const WorstCase& w) { return severity > w.severity(); };
  worst.insert(std::upper_bound(worst.begin(), worst.end(), c.severity(), above), c);
  // Some of every kind rather than the same thing many times: the least severe of a kind that has enough goes.
  const auto of_kind = [&](const WorstCase& w) { return w.kind() == c.kind(); };
  if (static_cast<std::size_t>(std::count_if(worst.begin(), worst.end(), of_kind)) <= kWorstOfAKind) return;
  worst.erase(std::prev(std::find_if(worst.rbegin(), worst.rend(), of_kind).base()));
}

void Findings::add(Failure failure) {
  ++failure_count;
  fresh_failures += failure.fresh ? 1 : 0;
  if (failures.size() < kMostFailures) failures.push_back(std::move(failure));
}

void Findings::merge(const Findings& later) {
  sources = std::max(sources, later.sources);
  // What is there of a source is added to; what is not has its place in the order of the sources.
  const auto into = [](auto& all, const auto& from, auto key, auto add) {
    for (const auto& x : from) {
      const auto at = std::lower_bound(all.begin(), all.end(), key(x),
                                       [&](const auto& y, const auto& sought) { return key(y) < sought; });
      if (at != all.end() && key(*at) == key(x))
        add(*at, x);
      else
        all.insert(at, x);
    }
  };
  into(
      families, later.families, [](const FamilyReport& f) { return f.source; },
      [](FamilyReport& f, const FamilyReport& more) { f.merge(more); });
  into(
      skipped, later.skipped, [](const Skipped& s) { return std::pair(s.source, s.why); },
      [](Skipped& s, const Skipped& more) { s.cases += more.cases; });
  for (const WorstCase& w : later.worst) add(w);
  failure_count += later.failure_count;
  fresh_failures += later.fresh_failures;
  const std::size_t room = std::min(kMostFailures - failures.size(), later.failures.size());
  failures.insert(failures.end(), later.failures.begin(), later.failures.begin() + static_cast<std::ptrdiff_t>(room));
  gone.insert(later.gone.begin(), later.gone.end());
  unreached += later.unreached;
  if (stopped.empty()) stopped = later.stopped;
  why.merge(later.why);
}

FamilyReport Report::total_of(bool published, bool fresh_ones) const {
  FamilyReport all;
  all.family = "total";
  all.fresh = !published;
  for (const FamilyReport& family : families)
    if (family.fresh ? fresh_ones : published) all.merge(family);
  return all;
}

FamilyReport Report::total() const { return total_of(true, false); }
FamilyReport Report::fresh_total() const { return total_of(false, true); }
FamilyReport Report::all() const { return total_of(true, true); }

std::uint64_t Report::skipped_cases(bool fresh_ones) const {
  return std::accumulate(skipped.begin(), skipped.end(), std::uint64_t{0},
                         [&](auto n, const Skipped& s) { return n + (s.fresh == fresh_ones ? s.cases : 0); });
}

Level Report::level_but_accepted() const {
  const Level published = total().level_but_accepted(allow_unsupported);
  const FamilyReport asked = fresh_total();
  const std::optional<Level> least = asked.worst_level(allow_unsupported);
  if (!least) return published;
  return std::max(published, withholds_numbers(asked) ? asked.level_but_accepted(allow_unsupported) : *least);
}

bool Report::harness_invalid() const {
  const FamilyReport all = this->all();
  return all.cases > unreached &&
         all.with(Claim::Status::answered) + all.with(Claim::Status::rejected) + all.with(Claim::Status::unsupported) ==
             0;
}

std::string Report::who() const {
  return formats::visible(engine.version.empty() ? engine.name : engine.name + " " + engine.version);
}

std::map<Aspect, Report::LackingPairs> Report::not_claimed() const {
  std::map<Pair, bool> judged_pairs;  // and whether one of their right answers has numbers
  for (const FamilyReport& family : families)
    if (family.cases != 0) judged_pairs[family.pair] |= family.with_numbers != 0;
  std::map<Aspect, LackingPairs> found;
  for (const auto& [pair, has_numbers] : judged_pairs) {
    const oracle::Declaration declared = engine.declared_for(pair);
    for (std::size_t i = 0; i < kAspectNames.size(); ++i) {
      const auto aspect = static_cast<Aspect>(i);
      if (!can_be_said(pair, declared.conventions, has_numbers).has(aspect)) continue;
      LackingPairs& of_aspect = found[aspect];
      if (declared.claimed().has(aspect))
        of_aspect.all = false;
      else
        of_aspect.pairs.push_back(name(pair));
    }
  }
  std::erase_if(found, [](const auto& entry) { return entry.second.pairs.empty(); });
  return found;
}

Aspects Report::aspects_not_claimed() const {
  Aspects found;
  for (const auto& [aspect, lacking] : not_claimed()) found.add(aspect);
  return found;
}

std::string Report::rests_on() const {
  const FamilyReport all = total();
  const FamilyReport asked = fresh_total();
  // Levels beyond bounded judge no number, whatever the answers hold.
  const bool by_numbers = tolerance() || (right() ? level_but_accepted() : required) <= Level::bounded;
  std::vector<std::string> numbers;
  for (const Field field : oracle::kFields)
    if (const auto n = all.fields[static_cast<std::size_t>(field)].judged(); n != 0 && by_numbers)
      numbers.push_back(fmt::format("{} {}", n, name(field)));
  std::string text = fmt::format(
      "It rests on {} and {}{}, {}{}.", count(all.decided.hits, "hit", "hits"),
      count(all.decided.misses, "miss", "misses"),
      all.refused == 0 ? "" : fmt::format(" decided, on {}", count(all.refused, "refusal", "refusals")),
      numbers.empty() ? "and on no number" : fmt::format("and on numbers: {}", fmt::join(numbers, ", ")),
      asked.cases == 0 ? ""
                       : fmt::format("; of fresh questions on {} and {}", count(asked.decided.hits, "hit", "hits"),
                                     count(asked.decided.misses, "miss", "misses")));
  if (!tolerance() && required == Level::conservative && all.false_hits + asked.false_hits != 0) {
    const double farthest = std::max(all.farthest_false_hit.off, asked.farthest_false_hit.off);
    text += fmt::format(
        " {} of {} called hits{}, the farthest {} from where the answer changes{}.", all.false_hits,
        count(all.could_be_false_hits(), "miss was", "misses were"),
        asked.cases == 0 ? "" : fmt::format(", and {} of {} fresh ones", asked.false_hits, asked.could_be_false_hits()),
        rounded_up(farthest), within ? fmt::format("; {} was allowed", *within) : "");
  }
  std::vector<std::string> left;
  for (const auto& [aspect, lacking] : not_claimed())
    left.push_back(fmt::format("{}{}", kAspectNames[static_cast<std::size_t>(aspect)],
                               lacking.all ? "" : fmt::format(" ({})", fmt::join(lacking.pairs, ", "))));
  if (!left.empty()) text += fmt::format(" Not claimed, so not judged: {}.", fmt::join(left, ", "));
  if (repeats && repeats->same())
    text += fmt::format(" Asked in {} more ways, it gave the same bits.", repeats->ways.size());
  if (const auto one = all.one_answer())
    text += fmt::format(" An engine that always says {} decides every question right.", *one);
  if (fresh && !fresh->none.empty() && right()) text += fmt::format(" On published questions alone: {}.", fresh->none);
  return text;
}

bool Report::meets(const FamilyReport& family) const {
  return tolerance() ? family.within_tolerance(allow_unsupported) : family.reaches(required, allow_unsupported);
}

bool Report::none_fails(const FamilyReport& family) const {
  if (tolerance()) return family.none_beyond_tolerance(allow_unsupported);
  return family.worst_level(allow_unsupported).value_or(required) <= required;
}

bool Report::right() const { return !(repeats && !repeats->same()) && meets(total()) && fresh_right(); }

bool Report::withholds_numbers(const FamilyReport& asked) const {
  return asked.with_numbers != 0 && asked.all_fields().judged() == 0 && asked.with(Claim::Status::unsupported) != 0;
}

bool Report::fresh_right() const {
  const FamilyReport asked = fresh_total();
  if (asked.judged(allow_unsupported) == asked.accepted) return true;
  return none_fails(asked) && !withholds_numbers(asked);
}

std::vector<std::string> Report::falls_short() const {
  std::vector<std::string> found;
  if (least_judged == 0) return found;
  const FamilyReport all = total();
  const FamilyReport asked = fresh_total();
  const std::uint64_t given = all.cases + skipped_cases();
  const std::uint64_t least = std::min(least_judged, given / 2 + given % 2);
  if (judged() < least)
    found.push_back(
        fmt::format("{} of {} given are fewer than {}", count(judged(), "judged case", "judged cases"), given, least));
  if (const auto one = all.one_answer(); one && all.askable.both())
    found.push_back(fmt::format("{} is right in all of them, and the questions have hits and misses",
                                *one == "the same" ? std::string("one answer") : fmt::format("always {}", *one)));
  if (!tolerance() && required == Level::conservative && level_but_accepted() == Level::conservative) {
    const FamilyReport both = this->all();
    for (std::size_t i = 0; i < both.said.size(); ++i)
      if (const Sides& said = both.said[i]; said.hits + said.misses != 0 && !said.both())
        found.push_back(fmt::format("its {} is {} every time", kAspectNames[i], said.hits != 0 ? "hit" : "miss"));
  }
  // Who answers what is published and calls the rest unsupported. Of an honest engine the shares are alike: less than
  // half, by more than ten questions, is no chance.
  if (allow_unsupported && all.cases != 0 && asked.cases != 0) {
    const double expected =
        static_cast<double>(judged()) / static_cast<double>(all.cases) * static_cast<double>(asked.cases);
    if (2 * (static_cast<double>(fresh_judged()) + 10) < expected)
      found.push_back(fmt::format("it answers {} of {} fresh questions, and {} of {} published ones", fresh_judged(),
                                  asked.cases, judged(), all.cases));
  }
  return found;
}

std::string_view Report::outcome() const {
  if (!right()) return "REFUTED";
  return certified() ? "certified" : "too little";
}

Level Report::level_of(const Verdict& verdict) const {
  if (within && verdict.false_hit() && verdict.at(oracle::Measure::decision).most > *within) return Level::none;
  return verdict.level();
}

bool Report::fails(const Verdict& verdict) const {
  return tolerance() ? !verdict.within() : level_of(verdict) > required;
}

std::vector<std::string> Report::diagnosis() const {
  return tolerance() && right() ? std::vector<std::string>() : why.lines();
}

std::vector<std::string> Report::fitness() const {
  const FamilyReport all = this->all();
  std::vector<std::string> lines;
  if (all.with_numbers != 0 && all.all_fields().judged() == 0)
    lines.emplace_back("no number was judged, so no tolerance certifies it: the next lines are of its decisions alone");
  const auto add = [&](std::string_view what, std::string_view scale, const Fitness& of) {
    if (of.answers != 0)
      for (std::string& line : fitness_lines(what, scale, of)) lines.push_back(std::move(line));
  };
  add(kEveryday, kEverydayOption, all.everyday);
  add(kAllNumbers, "", all.fitness);
  return lines;
}

std::vector<InTheWay> Report::in_the_way() const {
  const FamilyReport all = this->all();
  std::vector<InTheWay> found = tool::in_the_way(all.everyday);
  return found.empty() ? tool::in_the_way(all.fitness) : found;
}

std::string Report::demand() const {
  if (tolerance()) return "within " + tolerance_text(*tolerance());
  return fmt::format("{}{}", name(required), within ? fmt::format(" within {}", *within) : "");
}

std::vector<std::string> Report::reasons(const FamilyReport& all) const {
  if (all.accepted != 0 && all.judged(allow_unsupported) == all.accepted)
    return {"no answer is left but failures that the baseline accepts"};
  if (tolerance()) {
    std::vector<std::string> found;
    if (all.fitness.beyond != 0) found.push_back(count(all.fitness.beyond, "answer beyond it", "answers beyond it"));
    if (all.with_numbers != 0 && all.all_fields().judged() == 0) found.emplace_back("no number was judged");
    return found;
  }
  std::vector<std::string> found;
  if (all.missed_hits != 0) found.push_back(count(all.missed_hits, "missed hit", "missed hits"));
  if (all.false_hits != 0) found.push_back(count(all.false_hits, "false hit", "false hits"));
  for (std::size_t i = 1; i < kStatusNames.size(); ++i)
    if (all.statuses[i] != 0 && !(allow_unsupported && i == static_cast<std::size_t>(Claim::Status::unsupported)))
      found.push_back(count(all.statuses[i], kStatusNames[i], kStatusPlurals[i]));
  if (all.incomplete != 0) {
    std::vector<std::string> lacking;
    for (std::size_t i = 0; i < all.missing.size(); ++i)
      if (all.missing[i] != 0) lacking.push_back(fmt::format("{} {}", all.missing[i], kAspectNames[i]));
    found.push_back(
        fmt::format("{} ({})", count(sum(all.missing), "missing field", "missing fields"), fmt::join(lacking, ", ")));
  }
  if (all.outside_domain != 0)
    found.push_back(count(all.outside_domain, "answer outside the domain", "answers outside the domain"));
  if (required > Level::bounded) return found;  // which judges no number
  if (all.not_finite != 0) found.push_back(count(all.not_finite, "answer not finite", "answers not finite"));
  for (const Field field : oracle::kFields) {
    const FieldCount& c = all.fields[static_cast<std::size_t>(field)];
    // Grades and levels begin alike: a grade below the required level is what the field lacks.
    for (const Grade grade : {Grade::beyond_bound, Grade::bounded, Grade::faithful})
      if (c.at(grade) != 0 && static_cast<int>(grade) > static_cast<int>(required))
        found.push_back(
            fmt::format("{} {} {}", c.at(grade), name(field),
                        grade == Grade::beyond_bound ? "beyond the bound" : fmt::format("only {}", name(grade))));
  }
  if (all.with_numbers != 0 && all.all_fields().judged() == 0) found.emplace_back("no number was judged");
  return found;
}

std::string Report::sentence() const {
  const FamilyReport published = total();
  if (judged() == 0) return fmt::format("NOTHING JUDGED: no case was left for {}.", who());
  const FamilyReport asked = fresh_total();
  const std::uint64_t accepted_here = published.accepted + asked.accepted;
  const std::string of = fmt::format("{} ({} of those given)", count(judged(), "judged case", "judged cases"),
                                     percent(judged(), published.cases + skipped_cases(), "{:.3g}"));
  const auto but_for = [&](std::string_view what) {
    return accepted_here == 0 ? std::string() : fmt::format("{}", what);
  };
  const auto fresh_ones = [&] {
    std::string text = fmt::format("{} (seed {}", count(fresh_judged(), "fresh one", "fresh ones"), fresh->seed);
    if (const std::uint64_t given = asked.cases + skipped_cases(true); given != fresh_judged())
      text += fmt::format("; of {} given", given);
    if (!fresh->unmade.empty()) text += fmt::format("; no generator makes {}", fmt::join(fresh->unmade, ", "));
    return text + ")";
  };
  const bool any_fresh = fresh && fresh->each != 0;
  const std::string and_fresh =
      !any_fresh ? "" : fmt::format(" and on {}{}", fresh_judged() == 0 ? "" : "all ", fresh_ones());
  if (right()) {
    const std::vector<std::string> lacks = falls_short();
    const std::string last = lacks.empty() ? ""
                                           : fmt::format(" That is no certificate: {}. --least-judged 0 asks for less.",
                                                         fmt::join(lacks, "; "));
    const std::string excused = but_for(fmt::format(" but for {}", count(accepted_here, "failure", "failures")));
    const std::string_view certificate = lacks.empty() ? "CERTIFIED" : "TOO LITTLE JUDGED";
    if (tolerance())
      return fmt::format("{} {}{}: {}, on all {}{}{}.{} {}", certificate, demand(), excused, who(), of, and_fresh,
                         but_for(" but those that the baseline accepts"), last, rests_on());
    return fmt::format("{}{}: {} reaches {} on all {}{}{}; {} was required{}.{} {}", certificate, excused, who(),
                       name(level_but_accepted()), of, and_fresh, but_for(" but those that the baseline accepts"),
                       demand(), level_but_accepted() > required ? ", and these questions have no numbers" : "", last,
                       rests_on());
  }
  if (harness_invalid())
    return fmt::format("HARNESS INVALID: {} never gave an answer that claims something, on {}.", who(), of);
  const std::string is_short = tolerance() ? "is not " + demand() + "," : fmt::format("does not reach {}", demand());
  const bool published_right = meets(published);
  const std::string same = repeats && !repeats->same() ? "other answers when it was asked again" : "";
  if (published_right && !fresh_right())
    return fmt::format("REFUTED: {} is right on published questions alone: on {} it {} {}, and {} on {}: {}{}. {}",
                       who(), of, tolerance() ? "is" : "reaches",
                       tolerance() ? demand() : std::string(name(published.level_but_accepted(allow_unsupported))),
                       is_short, fresh_ones(), fmt::join(reasons(asked), ", "), same.empty() ? "" : "; " + same,
                       rests_on());
  std::vector<std::string> wrong = published_right ? std::vector<std::string>() : reasons(published);
  if (!same.empty()) wrong.push_back(same);
  const std::uint64_t more = failure_count + unreached - accepted_here;
  const std::string beyond = !accepted || more == 0 ? ""
                                                    : fmt::format(", {} more than the {} that the baseline accepts",
                                                                  count(more, "failure", "failures"), accepted_here);
  const std::string there =
      !any_fresh      ? ""
      : fresh_right() ? fmt::format("; {} on {}", fresh_judged() == 0 ? "it was judged" : "it is right", fresh_ones())
                      : fmt::format("; on {}: {}", fresh_ones(), fmt::join(reasons(asked), ", "));
  return fmt::format("REFUTED: {} {} on {}{}: {}{}. {}", who(), published_right ? "is not deterministic" : is_short, of,
                     beyond, fmt::join(wrong, ", "), there, rests_on());
}

std::vector<std::string> Report::baseline_lines() const {
  if (!accepted) return {};
  constexpr std::size_t kShown = 20;
  std::vector<std::string> lines{fmt::format("{} accepts {}; {} met again, {} gone", formats::visible(accepted->path),
                                             count(accepted->failures, "failure", "failures"), all().accepted,
                                             gone.size())};
  std::size_t shown = 0;
  for (const std::string& id : gone)
    if (shown++ < kShown) lines.push_back(id + " is right now");
  if (gone.size() > kShown) lines.push_back(fmt::format("and {} more", gone.size() - kShown));
  for (shown = 0; const Failure& f : failures)
    if (!f.accepted && shown++ < kShown) lines.push_back(fmt::format("{} is new: {}", f.id, f.what));
  if (shown > kShown) lines.push_back(fmt::format("and {} more", shown - kShown));
  return lines;
}

std::vector<std::string> Report::left_out() const {
  std::vector<std::string> lines;
  // One line a reason: an engine that does not serve a pair would have one a file.
  std::vector<std::string_view> told;
  for (const Skipped& first : skipped) {
    if (first.fresh || std::find(told.begin(), told.end(), first.why) != told.end()) continue;
    told.push_back(first.why);
    std::uint64_t alike = 0;
    std::uint64_t cases = 0;
    for (const Skipped& s : skipped)
      if (s.why == first.why && !s.fresh) ++alike, cases += s.cases;
    const std::string more = alike == 1 ? "" : fmt::format(" and {} more", alike - 1);
    lines.push_back(fmt::format("{}{} ({} cases): {}", first.what, more, cases, first.why));
  }
  if (const std::uint64_t n = skipped_cases(true); n != 0)
    lines.push_back(fmt::format("{}, for the same reasons", count(n, "fresh question", "fresh questions")));
  if (unreached != 0)
    lines.push_back(
        fmt::format("{} not reached, and missing: {}", count(unreached, "case was", "cases were"), stopped));
  if (!unknown_answers.empty()) {
    constexpr std::size_t kShown = 5;
    const auto shown = std::span(unknown_answers).first(std::min(kShown, unknown_answers.size()));
    lines.push_back(
        fmt::format("{} no question asked: {}{}",
                    count(unknown_answers.size(), "recorded answer belongs to", "recorded answers belong to"),
                    fmt::join(shown, ", "), unknown_answers.size() > kShown ? ", ..." : ""));
  }
  return lines;
}

std::string json_text(const Report& report, bool with_failures) {
  using formats::json_string;
  using formats::number;
  const auto family_text = [&](const FamilyReport& f) {
    std::string statuses;
    for (std::size_t i = 0; i < kStatusNames.size(); ++i)
      statuses += fmt::format("{}\"{}\":{}", i == 0 ? "" : ",", kStatusNames[i], f.statuses[i]);
    std::string fields;
    for (const Field field : oracle::kFields) {
      const FieldCount& c = f.fields[static_cast<std::size_t>(field)];
      if (c.judged() == 0) continue;
      std::string errors;
      for (const auto& [power, n] : c.errors) errors += fmt::format("{}[{},{}]", errors.empty() ? "" : ",", power, n);
      fields += fmt::format(
          R"({}"{}":{{"judged":{},"correctly_rounded":{},"faithful":{},"bounded":{},"beyond_bound":{},"not_finite":{},"worst_ulps":{},"worst_id":{},"errors":[{}]}})",
          fields.empty() ? "" : ",", name(field), c.judged(), c.at(Grade::correctly_rounded), c.at(Grade::faithful),
          c.at(Grade::bounded), c.at(Grade::beyond_bound), c.at(Grade::not_finite), number(c.worst),
          json_string(c.worst_id), errors);
    }
    std::string margins;
    for (const auto& [margin, decisions] : f.margins)
      margins += fmt::format("{}[{},{},{},{}]", margins.empty() ? "" : ",", margin.side, margin.power,
                             decisions.claimed, decisions.wrong);
    std::string missing;
    for (std::size_t i = 0; i < f.missing.size(); ++i)
      if (f.missing[i] != 0)
        missing += fmt::format("{}\"{}\":{}", missing.empty() ? "" : ",", kAspectNames[i], f.missing[i]);
    const auto one = f.one_answer();
    const std::string farthest = f.farthest_false_hit.question.empty()
                                     ? "null"
                                     : fmt::format(R"({{"from":{},"query":{}}})", number(f.farthest_false_hit.off),
                                                   f.farthest_false_hit.question);
    return fmt::format(
        R"("cases":{},"judged":{},"accepted":{},"hits":{},"decided":{{"hits":{},"misses":{}}},"one_answer":{},"missed_hits":{},"false_hits":{},"farthest_false_hit":{},"outside_domain":{},"refused":{},"not_finite":{},"incomplete":{},"missing_fields":{{{}}},"level":"{}","answers":{{{}}},"fields":{{{}}},"margins":[{}],{})",
        f.cases, f.judged(report.allow_unsupported), f.accepted, f.hits, f.decided.hits, f.decided.misses,
        one ? json_string(*one) : "null", f.missed_hits, f.false_hits, farthest, f.outside_domain, f.refused,
        f.not_finite, f.incomplete, missing, name(f.level(report.allow_unsupported)), statuses, fields, margins,
        fitness_json("fitness", f.fitness) + "," + fitness_json("everyday", f.everyday));
  };
  std::string families;
  std::string fresh_families;
  for (const FamilyReport& f : report.families) {
    std::string& list = f.fresh ? fresh_families : families;
    list += fmt::format("{}{{\"pair\":\"{}\",\"scalar\":\"{}\",\"family\":{},{}}}", list.empty() ? "" : ",\n",
                        name(f.pair), name(f.scalar), json_string(f.family), family_text(f));
  }
  std::string skipped;
  for (const Skipped& s : report.skipped)
    if (!s.fresh)
      skipped += fmt::format("{}{{\"what\":{},\"why\":{},\"cases\":{}}}", skipped.empty() ? "" : ",",
                             json_string(s.what), json_string(s.why), s.cases);
  std::string unknown;
  for (const std::string& id : report.unknown_answers)
    unknown += fmt::format("{}\"{}\"", unknown.empty() ? "" : ",", id);
  std::string worst;
  for (const WorstCase& w : report.worst)
    worst += fmt::format(R"({}{{"what":{},"query":{},"claimed":{},"right":{}}})", worst.empty() ? "" : ",\n",
                         json_string(w.what()), golden::query_line(w.query, w.scalar), engines::claim_object(w.claim),
                         engines::claim_object(w.right(report.engine.declared_for(w.query.pair))));
  std::string standing;
  for (const InTheWay& one : report.in_the_way())
    standing += fmt::format(R"({}{{"what":{},"query":{}}})", standing.empty() ? "" : ",\n", json_string(one.what),
                            one.question);
  std::string failures;
  std::string fresh_failures;
  for (const Failure& f : std::span(report.failures).first(with_failures ? report.failures.size() : 0)) {
    std::string& list = f.fresh ? fresh_failures : failures;
    list += fmt::format(R"({}{{"id":"{}","pair":"{}","scalar":"{}","family":{},"level":"{}","what":{}{}{}}})",
                        list.empty() ? "" : ",\n", f.id, name(f.pair), name(f.scalar), json_string(f.family),
                        name(f.level), json_string(f.what), f.question ? "," + golden::inputs_text(*f.question) : "",
                        f.accepted ? R"(,"accepted":true)" : "");
  }
  std::string baseline;
  if (report.accepted) {
    std::string gone;
    for (const std::string& id : report.gone) gone += fmt::format("{}\"{}\"", gone.empty() ? "" : ",", id);
    baseline =
        fmt::format(R"("baseline":{{"file":{},"accepts":{},"met":{},"gone":[{}]}},{})",
                    json_string(report.accepted->path), report.accepted->failures, report.all().accepted, gone, "\n");
  }
  std::string diagnosis;
  for (const std::string& d : report.why.lines()) diagnosis += (diagnosis.empty() ? "" : ",") + json_string(d);
  std::string causes;
  for (const oracle::Finding& f : report.why.findings())
    causes +=
        fmt::format(R"({}{{"cause":{},"explained":{}}})", causes.empty() ? "" : ",", json_string(f.cause), f.explained);
  const DeclaredBounds& bounds = report.engine.declared.bounds;
  const auto names = [](const Aspects& aspects) {
    std::vector<std::string> quoted;
    for (const std::string_view aspect : aspects.names()) quoted.push_back(json_string(aspect));
    return fmt::format("{}", fmt::join(quoted, ","));
  };
  const auto quoted = [](const std::vector<std::string>& texts) {
    std::string list;
    for (const std::string& text : texts) list += (list.empty() ? "" : ",") + json_string(text);
    return list;
  };
  std::string fresh = "null";
  if (report.fresh && !report.fresh->none.empty())
    fresh = fmt::format(R"({{"each":0,"none":{},"unmade":[{}]}})", json_string(report.fresh->none),
                        quoted(report.fresh->unmade));
  else if (report.fresh)
    fresh = fmt::format(
        R"({{"each":{},"seed":{},"unmade":[{}],"given":{},"failure_count":{},"total":{{{}}},"families":[{}],"failures":[{}]}})",
        report.fresh->each, report.fresh->seed, quoted(report.fresh->unmade),
        report.fresh_total().cases + report.skipped_cases(true), report.fresh_failures,
        family_text(report.fresh_total()), fresh_families, fresh_failures);
  return fmt::format(
      "{{\"format\":\"contact-oracle/"
      "report\",\"version\":1,\"engine\":{{\"name\":{},\"version\":{}}},\"scalar\":\"{}\",\"conventions\":{},"
      "{}\"bounds\":{{\"value\":{},\"normal\":{},\"point\":{}}},\"claims\":[{}]{},\"not_claimed\":[{}],"
      "\"required\":\"{}\",\"within\":{},\"least_judged\":{},\"tolerance\":{},\"certified\":{},"
      "\"falls_short\":[{}],\"verdict\":{},"
      "\"diagnosis\":[{}],\"causes\":[{}],\n\"total\":{{{}}},"
      "\n\"families\":[\n{}],\n\"fresh\":{},\n\"skipped\":[{}],\n\"unknown_answers\":[{}],\n\"not_reached\":{},\n{}"
      "\"worst\":[{}],"
      "\n\"in_the_way\":[{}],\n\"failure_count\":{},\"failures\":[\n{}]{}}}\n",
      json_string(report.engine.name), json_string(report.engine.version), name(report.engine.declared.scalar),
      engines::conventions_text(report.engine.declared.conventions), engines::pair_conventions_text(report.engine),
      number(bounds.value), number(bounds.normal), number(bounds.point), names(report.engine.declared.claimed()),
      engines::rounds_text(report.engine), names(report.aspects_not_claimed()), name(report.required),
      report.within ? number(*report.within) : "null", report.least_judged,
      report.tolerance() ? engines::tolerance_object(*report.tolerance()) : "null", report.certified(),
      report.right() ? quoted(report.falls_short()) : "", json_string(report.sentence()), diagnosis, causes,
      family_text(report.total()), families, fresh, skipped, unknown, report.unreached, baseline, worst, standing,
      report.failure_count - report.fresh_failures, failures,
      report.repeats ? ",\n\"determinism\":" + report.repeats->json() : "");
}

}  // namespace contact::tool
