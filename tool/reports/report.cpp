// What a run found: counts and worst cases by family and field, and the verdict.
#include "tool/reports/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "golden/dataset.hpp"
#include "oracle/judge/right_claim.hpp"

namespace contact::tool {
namespace {

constexpr std::array<std::string_view, 7> kStatusNames{"answered", "unsupported", "rejected", "error",
                                                       "timeout",  "crash",       "missing"};

constexpr std::array<std::string_view, 7> kStatusPlurals{"answered", "unsupported", "rejected", "errors",
                                                         "timeouts", "crashes",     "missing"};

std::string count(std::uint64_t n, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

std::uint64_t sum(const auto& counts) { return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}); }

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
  if (family == "total") return family;
  return family_title(pair, family, scalar);
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

Level FamilyReport::level_but_accepted(bool allow_unsupported) const {
  const bool any_number = all_fields().judged() != 0;
  for (std::size_t i = levels.size(); i-- > 0;) {
    const bool left_out = allow_unsupported && static_cast<Level>(i) == Level::none;
    if (levels[i] != accepted_levels[i] + (left_out ? with(Claim::Status::unsupported) : 0))
      return std::max(static_cast<Level>(i), any_number ? Level::correctly_rounded : Level::decisions);
  }
  return Level::none;
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

void FamilyReport::add(const Verdict& verdict, const std::string& id, bool hit,
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
  for (std::size_t i = 0; i < decisions.size(); ++i)
    if (expected[i]) decisions[i].add(*expected[i]);
  with_numbers += verdict.has_numbers ? 1 : 0;
  incomplete += verdict.missing.empty() ? 0 : 1;
  for (std::size_t i = 0; i < missing.size(); ++i) missing[i] += verdict.missing.has(static_cast<Aspect>(i)) ? 1 : 0;
  ++levels[static_cast<std::size_t>(verdict.level())];
  if (!margin || (verdict.overlap == oracle::Decision::unclaimed && verdict.contact == oracle::Decision::unclaimed))
    return;
  Decisions& there = margins[*margin];
  ++there.claimed;
  there.wrong += verdict.missed_hit() || verdict.false_hit() ? 1 : 0;
}

bool FamilyReport::within_tolerance(bool allow_unsupported) const {
  const bool no_number = with_numbers != 0 && all_fields().judged() == 0;
  return fitness.beyond == accepted + (allow_unsupported ? with(Claim::Status::unsupported) : 0) && !no_number &&
         judged(allow_unsupported) != 0;
}

void FamilyReport::add_fitness(const Verdict& verdict, const Query& query) {
  fitness.add(verdict, query, scalar);
  if (is_everyday(query)) everyday.add(verdict, query, scalar);
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
  not_finite += other.not_finite;
  outside_domain += other.outside_domain;
  refused += other.refused;
  accepted += other.accepted;
  for (std::size_t i = 0; i < statuses.size(); ++i) statuses[i] += other.statuses[i];
  for (std::size_t i = 0; i < fields.size(); ++i) fields[i].merge(other.fields[i]);
  decided.merge(other.decided);
  for (std::size_t i = 0; i < decisions.size(); ++i) decisions[i].merge(other.decisions[i]);
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
    return fmt::format("{}: {}", kStatusNames[static_cast<std::size_t>(verdict.status)],
                       formats::visible(verdict.text));
  if (verdict.answered_outside_domain) return "an answer outside the domain";
  if (verdict.missed_hit() || verdict.false_hit()) {
    const oracle::Off& off = verdict.at(oracle::Measure::decision);
    return fmt::format("{} hit, {} from where the answer changes{}", verdict.missed_hit() ? "missed" : "false",
                       rounded_up(off.most), verdict.decision_last_bit ? " (no worse than the inputs' last bit)" : "");
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
  Claim rejection;
  rejection.status = Claim::Status::rejected;
  rejection.text = outside_domain(query)->field;
  return rejection;
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
  const std::size_t room = std::min(kMostFailures - failures.size(), later.failures.size());
  failures.insert(failures.end(), later.failures.begin(), later.failures.begin() + static_cast<std::ptrdiff_t>(room));
  gone.insert(later.gone.begin(), later.gone.end());
  unreached += later.unreached;
  if (stopped.empty()) stopped = later.stopped;
  why.merge(later.why);
}

FamilyReport Report::total() const {
  FamilyReport all;
  all.family = "total";
  for (const FamilyReport& family : families) all.merge(family);
  return all;
}

std::uint64_t Report::skipped_cases() const {
  return std::accumulate(skipped.begin(), skipped.end(), std::uint64_t{0},
                         [](auto n, const Skipped& s) { return n + s.cases; });
}

bool Report::harness_invalid() const {
  const FamilyReport all = total();
  return all.cases > unreached &&
         all.with(Claim::Status::answered) + all.with(Claim::Status::rejected) + all.with(Claim::Status::unsupported) ==
             0;
}

std::string Report::who() const {
  return formats::visible(engine.version.empty() ? engine.name : engine.name + " " + engine.version);
}

Aspects Report::not_claimed() const {
  const Conventions& conventions = engine.declared.conventions;
  Aspects all{Aspect::overlap, Aspect::contact};
  if (total().with_numbers != 0) {
    all.add(Aspect::normal);
    all.add(Aspect::value);
    if (conventions.points != Points::midpoint) {
      all.add(Aspect::point1);
      all.add(Aspect::point2);
    }
  }
  return all.without(engine.declared.claimed());
}

std::string Report::rests_on() const {
  const FamilyReport all = total();
  std::vector<std::string> numbers;
  for (const Field field : oracle::kFields)
    if (const auto n = all.fields[static_cast<std::size_t>(field)].judged(); n != 0)
      numbers.push_back(fmt::format("{} {}", n, name(field)));
  std::string text =
      fmt::format("It rests on {} and {}{}, {}.", count(all.decided.hits, "hit", "hits"),
                  count(all.decided.misses, "miss", "misses"),
                  all.refused == 0 ? "" : fmt::format(" decided, on {}", count(all.refused, "refusal", "refusals")),
                  numbers.empty() ? "and on no number" : fmt::format("and on numbers: {}", fmt::join(numbers, ", ")));
  if (const Aspects left = not_claimed(); !left.empty())
    text += fmt::format(" Not claimed, so not judged: {}.", fmt::join(left.names(), ", "));
  if (repeats && repeats->same())
    text += fmt::format(" Asked in {} more ways, it gave the same bits.", repeats->ways.size());
  if (const auto one = all.one_answer())
    text += fmt::format(" An engine that always says {} decides all of it right.", *one);
  return text;
}

bool Report::certified() const {
  if (repeats && !repeats->same()) return false;
  return tolerance() ? total().within_tolerance(allow_unsupported) : total().reaches(required, allow_unsupported);
}

bool Report::fails(const Verdict& verdict) const {
  return tolerance() ? !verdict.within() : verdict.level() > required;
}

std::vector<std::string> Report::diagnosis() const {
  return tolerance() && certified() ? std::vector<std::string>() : why.lines();
}

std::vector<std::string> Report::fitness() const {
  const FamilyReport all = total();
  std::vector<std::string> lines;
  if (all.with_numbers != 0 && all.all_fields().judged() == 0)
    lines.emplace_back("no number was judged, so no tolerance certifies it: what follows is of its decisions");
  const auto add = [&](std::string_view what, std::string_view scale, const Fitness& of) {
    if (of.answers != 0)
      for (std::string& line : fitness_lines(what, scale, of)) lines.push_back(std::move(line));
  };
  add(kEveryday, kEverydayOption, all.everyday);
  add(kAllNumbers, "", all.fitness);
  return lines;
}

std::vector<InTheWay> Report::in_the_way() const {
  const FamilyReport all = total();
  std::vector<InTheWay> found = tool::in_the_way(all.everyday);
  return found.empty() ? tool::in_the_way(all.fitness) : found;
}

std::string Report::demand() const {
  return tolerance() ? "within " + tolerance_text(*tolerance()) : std::string(name(required));
}

std::string Report::sentence() const {
  const FamilyReport all = total();
  if (all.cases == 0) return fmt::format("NOTHING JUDGED: no case was left for {}.", who());
  const double share = 100.0 * static_cast<double>(judged()) / static_cast<double>(all.cases + skipped_cases());
  const std::string of =
      fmt::format("{} ({:.3g} % of those given)", count(judged(), "judged case", "judged cases"), share);
  const auto but_for = [&](std::string_view what) {
    return all.accepted == 0 ? std::string() : fmt::format("{}", what);
  };
  if (certified() && tolerance())
    return fmt::format("CERTIFIED {}{}: {}, on all {}{}. {}", demand(),
                       but_for(fmt::format(" but for {}", count(all.accepted, "failure", "failures"))), who(), of,
                       but_for(" but those that the baseline accepts"), rests_on());
  if (certified())
    return fmt::format("CERTIFIED{}: {} reaches {} on all {}{}; {} was required{}. {}",
                       but_for(fmt::format(" but for {}", count(all.accepted, "failure", "failures"))), who(),
                       name(level_but_accepted()), of, but_for(" but those that the baseline accepts"), name(required),
                       level_but_accepted() > required ? ", and these questions have no numbers" : "", rests_on());
  if (harness_invalid())
    return fmt::format("HARNESS INVALID: {} never gave an answer that claims something, on {}.", who(), of);
  std::vector<std::string> reasons;
  if (all.missed_hits != 0) reasons.push_back(count(all.missed_hits, "missed hit", "missed hits"));
  if (all.false_hits != 0) reasons.push_back(count(all.false_hits, "false hit", "false hits"));
  for (std::size_t i = 1; i < kStatusNames.size(); ++i)
    if (all.statuses[i] != 0 && !(allow_unsupported && i == static_cast<std::size_t>(Claim::Status::unsupported)))
      reasons.push_back(count(all.statuses[i], kStatusNames[i], kStatusPlurals[i]));
  if (all.incomplete != 0) {
    std::vector<std::string> lacking;
    for (std::size_t i = 0; i < all.missing.size(); ++i)
      if (all.missing[i] != 0) lacking.push_back(fmt::format("{} {}", all.missing[i], kAspectNames[i]));
    reasons.push_back(
        fmt::format("{} ({})", count(sum(all.missing), "missing field", "missing fields"), fmt::join(lacking, ", ")));
  }
  if (all.outside_domain != 0)
    reasons.push_back(count(all.outside_domain, "answer outside the domain", "answers outside the domain"));
  if (all.not_finite != 0) reasons.push_back(count(all.not_finite, "answer not finite", "answers not finite"));
  for (const Field field : oracle::kFields) {
    const FieldCount& c = all.fields[static_cast<std::size_t>(field)];
    // Grades and levels begin alike: a grade below the required level is what the field lacks.
    for (const Grade grade : {Grade::beyond_bound, Grade::bounded, Grade::faithful})
      if (c.at(grade) != 0 && static_cast<int>(grade) > static_cast<int>(std::min(required, Level::bounded)))
        reasons.push_back(
            fmt::format("{} {} {}", c.at(grade), name(field),
                        grade == Grade::beyond_bound ? "beyond the bound" : fmt::format("only {}", name(grade))));
  }
  if (tolerance()) reasons = {count(all.fitness.beyond, "answer beyond it", "answers beyond it")};
  if ((tolerance() || required < Level::decisions) && all.with_numbers != 0 && all.all_fields().judged() == 0)
    reasons.emplace_back("no number was judged");
  if (repeats && !repeats->same()) reasons.emplace_back("other answers when it was asked again");
  const std::string beyond =
      !accepted ? ""
                : fmt::format(", {} more than the {} that the baseline accepts",
                              count(failure_count + unreached - all.accepted, "failure", "failures"), all.accepted);
  const bool meets = tolerance() ? all.within_tolerance(allow_unsupported) : all.reaches(required, allow_unsupported);
  const std::string is_short =
      tolerance() ? "is not " + demand() + "," : fmt::format("does not reach {}", name(required));
  return fmt::format("REFUTED: {} {} on {}{}: {}. {}", who(), meets ? "is not deterministic" : is_short, of, beyond,
                     fmt::join(reasons, ", "), rests_on());
}

std::vector<std::string> Report::baseline_lines() const {
  if (!accepted) return {};
  constexpr std::size_t kShown = 20;
  std::vector<std::string> lines{fmt::format("{} accepts {}; {} met again, {} gone", formats::visible(accepted->path),
                                             count(accepted->failures, "failure", "failures"), total().accepted,
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
    if (std::find(told.begin(), told.end(), first.why) != told.end()) continue;
    told.push_back(first.why);
    std::uint64_t alike = 0;
    std::uint64_t cases = 0;
    for (const Skipped& s : skipped)
      if (s.why == first.why) ++alike, cases += s.cases;
    const std::string more = alike == 1 ? "" : fmt::format(" and {} more", alike - 1);
    lines.push_back(fmt::format("{}{} ({} cases): {}", first.what, more, cases, first.why));
  }
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
    return fmt::format(
        R"("cases":{},"judged":{},"accepted":{},"hits":{},"decided":{{"hits":{},"misses":{}}},"one_answer":{},"missed_hits":{},"false_hits":{},"outside_domain":{},"refused":{},"not_finite":{},"incomplete":{},"missing_fields":{{{}}},"level":"{}","answers":{{{}}},"fields":{{{}}},"margins":[{}],{})",
        f.cases, f.judged(report.allow_unsupported), f.accepted, f.hits, f.decided.hits, f.decided.misses,
        one ? json_string(*one) : "null", f.missed_hits, f.false_hits, f.outside_domain, f.refused, f.not_finite,
        f.incomplete, missing, name(f.level(report.allow_unsupported)), statuses, fields, margins,
        fitness_json("fitness", f.fitness) + "," + fitness_json("everyday", f.everyday));
  };
  std::string families;
  for (const FamilyReport& f : report.families)
    families += fmt::format("{}{{\"pair\":\"{}\",\"scalar\":\"{}\",\"family\":{},{}}}", families.empty() ? "" : ",\n",
                            name(f.pair), name(f.scalar), json_string(f.family), family_text(f));
  std::string skipped;
  for (const Skipped& s : report.skipped)
    skipped += fmt::format("{}{{\"what\":{},\"why\":{},\"cases\":{}}}", skipped.empty() ? "" : ",", json_string(s.what),
                           json_string(s.why), s.cases);
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
  for (const Failure& f : std::span(report.failures).first(with_failures ? report.failures.size() : 0))
    failures +=
        fmt::format(R"({}{{"id":"{}","pair":"{}","scalar":"{}","family":{},"level":"{}","what":{}{}{}}})",
                    failures.empty() ? "" : ",\n", f.id, name(f.pair), name(f.scalar), json_string(f.family),
                    name(f.level), json_string(f.what), f.question ? "," + golden::inputs_text(*f.question) : "",
                    f.accepted ? R"(,"accepted":true)" : "");
  std::string baseline;
  if (report.accepted) {
    std::string gone;
    for (const std::string& id : report.gone) gone += fmt::format("{}\"{}\"", gone.empty() ? "" : ",", id);
    baseline =
        fmt::format(R"("baseline":{{"file":{},"accepts":{},"met":{},"gone":[{}]}},{})",
                    json_string(report.accepted->path), report.accepted->failures, report.total().accepted, gone, "\n");
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
  return fmt::format(
      "{{\"format\":\"contact-oracle/"
      "report\",\"version\":1,\"engine\":{{\"name\":{},\"version\":{}}},\"scalar\":\"{}\",\"conventions\":{},"
      "{}\"bounds\":{{\"value\":{},\"normal\":{},\"point\":{}}},\"claims\":[{}],\"not_claimed\":[{}],"
      "\"required\":\"{}\",\"tolerance\":{},\"certified\":{},\"verdict\":{},"
      "\"diagnosis\":[{}],\"causes\":[{}],\n\"total\":{{{}}},"
      "\n\"families\":[\n{}],\n\"skipped\":[{}],\n\"unknown_answers\":[{}],\n\"not_reached\":{},\n{}\"worst\":[{}],"
      "\n\"in_the_way\":[{}],\n\"failure_count\":{},\"failures\":[\n{}]{}}}\n",
      json_string(report.engine.name), json_string(report.engine.version), name(report.engine.declared.scalar),
      engines::conventions_text(report.engine.declared.conventions), engines::pair_conventions_text(report.engine),
      number(bounds.value), number(bounds.normal), number(bounds.point), names(report.engine.declared.claimed()),
      names(report.not_claimed()), name(report.required),
      report.tolerance() ? engines::tolerance_object(*report.tolerance()) : "null", report.certified(),
      json_string(report.sentence()), diagnosis, causes, family_text(report.total()), families, skipped, unknown,
      report.unreached, baseline, worst, standing, report.failure_count, failures,
      report.repeats ? ",\n\"determinism\":" + report.repeats->json() : "");
}

}  // namespace contact::tool
