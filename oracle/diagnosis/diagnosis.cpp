// Why answers are wrong: the conventions under which they would be right, and the causes that explain them.
#include "oracle/diagnosis/diagnosis.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <span>
#include <unordered_map>
#include <utility>

#include "oracle/diagnosis/formulas.hpp"
#include "oracle/truth/default_environment.hpp"

namespace contact::oracle {
namespace {

using formulas::along;
using formulas::numbers_of;
using formulas::side;

/// A cause loses this part of its score where right claims contradict it in every place that it does not explain: so
/// little only decides between causes that explain about as much, and a mistake made in one place can still be named.
constexpr double kElsewhere = 0.05;
/// A cause that explains less than one in fifty of the wrong claims may agree with them by chance, so it is not named.
constexpr double kOneInByChance = 50;
/// One wrong answer, which is two claims, is no evidence for a formula.
constexpr double kOneAnswer = 2;
/// What comes before the engine's own arithmetic explains one in so many of the wrong claims alone.
constexpr double kOneInByEvidence = 25;
/// A tenth of the wrong claims may lack a cause without a finding that says so: few engines are explained to the last.
constexpr std::uint64_t kOneInUnexplained = 10;
/// A convention is named if half of the wrong fields are right under it, for an engine that follows it does so mostly.
constexpr std::uint64_t kOneInConvention = 2;
/// Six sentences are read, and the first explain the most.
constexpr std::size_t kMostFindings = 6;

std::string_view name(Aspect aspect) { return kAspectNames[static_cast<std::size_t>(aspect)]; }

bool is_right(const std::optional<FieldVerdict>& field) { return field && field->grade <= Grade::bounded; }
bool is_wrong(const std::optional<FieldVerdict>& field) { return field && field->grade > Grade::bounded; }
bool is_wrong(Decision d) { return d == Decision::missed_hit || d == Decision::false_hit; }

Real ulp_of(Real x, Scalar scalar) {
  const Format format = format_of(scalar);
  const int exponent = x == 0 || !std::isfinite(x) ? format.min_exponent : std::ilogb(x);
  return std::ldexp(Real{1}, std::max(exponent, format.min_exponent) - format.precision + 1);
}

constexpr Aspects kPointAspects{Aspect::point1, Aspect::point2, Aspect::point, Aspect::points};

/// Whether anything is wrong now that was not wrong before.
bool newly_wrong(const Verdict& before, const Verdict& now) {
  return (is_wrong(now.overlap) && !is_wrong(before.overlap)) || (is_wrong(now.contact) && !is_wrong(before.contact)) ||
         std::any_of(kFields.begin(), kFields.end(),
                     [&](Field field) { return !is_wrong(before.at(field)) && is_wrong(now.at(field)); });
}

Numbers middle_of(const Numbers& x, const Numbers& y) { return formulas::times(0.5L, along(x, 1, y)); }

/// A claim of one aspect as numbers, in the default conventions.
struct Claimed {
  Aspect aspect;
  bool right;
  Numbers numbers{};
  Real scale = 0;  ///< the bound counts ulps of it; 0 for decisions
  Real bound = 0;
  std::optional<Numbers> truth{};  ///< what is right; nothing for decisions, and where several directions are
  Real noise = 0;                  ///< what roundings to the engine's own format may do to the numbers
};

Real largest_difference(const Numbers& x, const Numbers& y) {
  Real most = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!std::isfinite(x[i] - y[i])) return formulas::kInfinity;
    most = std::max(most, std::abs(x[i] - y[i]));
  }
  return most;
}
/// A formula is met by chance by whoever is off by as much as it. One that gives what was claimed is nearer to that
/// than the truth is, so many times.
constexpr Real kNearer = 4;
/// An engine with a mistake rounds, too: where a mistake shows beyond roundings, so many times, its formula is met
/// within them.
constexpr Real kBeyondNoise = 4;

enum class Match { no_opinion, agrees, differs };

Match match(const Said& said, const Claimed& claimed, Scalar scalar) {
  if (said.kind == Said::Kind::no_opinion) return Match::no_opinion;
  if (said.kind == Said::Kind::anything) return claimed.right ? Match::no_opinion : Match::agrees;
  if (claimed.scale == 0) return said.numbers[0] == claimed.numbers[0] ? Match::agrees : Match::differs;
  Real largest = claimed.scale;
  for (const Real x : said.numbers)
    if (std::isfinite(x)) largest = std::max(largest, std::abs(x));
  const bool shows = claimed.truth && said.least == 0 && said.tolerance == 0 &&
                     largest_difference(said.numbers, *claimed.truth) >= kBeyondNoise * claimed.noise;
  const Real tolerance =
      std::max({said.tolerance, claimed.bound * ulp_of(largest, scalar), shows ? claimed.noise : Real{0}});
  const Real limit = std::ldexp(Real{1}, format_of(scalar).max_exponent + 1);
  bool same = true;
  bool any_not_finite = false;
  bool wants_not_finite = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Real said_i = said.numbers[i];
    const Real claimed_i = claimed.numbers[i];
    wants_not_finite = wants_not_finite || std::isnan(said_i);
    any_not_finite = any_not_finite || !std::isfinite(claimed_i);
    if (std::isinf(claimed_i))
      same = same && std::abs(said_i) >= limit / 2 && (said_i > 0) == (claimed_i > 0);
    else
      same = same && std::abs(said_i - claimed_i) <= tolerance;
  }
  if (wants_not_finite) return any_not_finite ? Match::agrees : Match::differs;
  if (!same) return Match::differs;
  if (claimed.right || any_not_finite) return Match::agrees;
  const Real off = largest_difference(claimed.numbers, said.numbers);
  if (said.tolerance > 0) return off >= said.least ? Match::agrees : Match::no_opinion;
  const bool is_nearer = !claimed.truth || kNearer * off <= largest_difference(claimed.numbers, *claimed.truth);
  return is_nearer ? Match::agrees : Match::no_opinion;
}

/// The claims of an answer that the judge has judged.
std::vector<Claimed> claimed_of(const Facts& f, const Claim& claim, const Declaration& declared,
                                const Verdict& verdict) {
  std::vector<Claimed> all;
  const auto decision = [&](Aspect aspect, Decision d, bool hit) {
    if (d != Decision::unclaimed) all.push_back({aspect, !is_wrong(d), {hit ? Real{1} : Real{0}, 0, 0}});
  };
  decision(Aspect::overlap, verdict.overlap, claim.overlap.value_or(false));
  decision(Aspect::contact, verdict.contact, claim.contact.has_value());
  if (!claim.contact) return all;
  const ContactClaim& said = *claim.contact;
  const auto field = [&](Aspect aspect, Field which, const Numbers& numbers, Real scale, double bound,
                         const Numbers& truth, Real noise) {
    const auto& judged = verdict.at(which);
    // What the inputs' last bit may do has no other cause.
    if (!judged || judged->last_bit) return;
    all.push_back({aspect, is_right(judged), numbers, scale, bound, std::nullopt, noise});
    if (f.has_direction() || aspect == Aspect::value) all.back().truth = truth;
  };
  const Real turned = formulas::turned(f, 0);
  const auto moved = [&](std::size_t shape) { return formulas::loss(f, 0) * f.condition + f.radius[shape] * turned; };
  const std::array right{formulas::surface(f, 0), formulas::surface(f, 1)};
  constexpr Real kLeast = std::numeric_limits<Real>::min();  // a scale of 0 stands for a decision
  const std::array scales{std::max(f.scale[0], kLeast), std::max(f.scale[1], kLeast)};
  if (f.said_normal) field(Aspect::normal, Field::normal, *f.said_normal, 1, declared.bounds.normal, f.n, turned);
  if (said.point1)
    field(Aspect::point1, Field::point1, numbers_of(*said.point1), scales[0], declared.bounds.point, right[0],
          moved(0));
  if (said.point2)
    field(Aspect::point2, Field::point2, numbers_of(*said.point2), scales[1], declared.bounds.point, right[1],
          moved(1));
  if (said.point)
    field(Aspect::point, Field::point, numbers_of(*said.point), std::max(scales[0], scales[1]), declared.bounds.point,
          middle_of(right[0], right[1]), std::max(moved(0), moved(1)));
  if (said.value) {
    Real value = *said.value;
    if (declared.conventions.value == ValueKind::depth) value = -value;
    if (!declared.conventions.value_less_contact) value -= f.contact;
    const Real scale = std::max({std::abs(f.distance), f.radii(), f.contact, kLeast});
    field(Aspect::value, Field::value, {value, 0, 0}, scale, declared.bounds.value, {formulas::right_value(f), 0, 0},
          formulas::apart(f, 0));
  }
  return all;
}

const Said& said_of(const Predictions& said, Aspect aspect) {
  static const Said nothing(std::nullopt);
  switch (aspect) {
    case Aspect::overlap:
    case Aspect::contact:
      return said.hit;
    case Aspect::normal:
      return said.normal;
    case Aspect::point1:
      return said.point[0];
    case Aspect::point2:
      return said.point[1];
    case Aspect::value:
      return said.value;
    case Aspect::point:
      return said.midpoint;
    case Aspect::points:  // which of those that are right, no formula knows
      return nothing;
  }
  return nothing;
}

bool is_point(Aspect aspect) { return kPointAspects.has(aspect); }
/// The contact point to which the claimed normal leads, or the midpoint.
Said following(const Facts& f, Aspect aspect) {
  const auto from = [&](std::size_t shape) {
    return along(f.nearest[shape], side(shape) * f.radius[shape], *f.said_normal);
  };
  if (aspect == Aspect::point) return middle_of(from(0), from(1));
  return from(aspect == Aspect::point1 ? 0 : 1);
}

/// The normal that an answer claims, first to second.
std::optional<Numbers> said_normal(const Claim& claim, const Conventions& conventions) {
  if (!claim.contact || !claim.contact->normal) return std::nullopt;
  const bool first = conventions.normal == NormalDirection::first_to_second;
  return numbers_of(first ? *claim.contact->normal : Vector3(-*claim.contact->normal));
}

/// Causes without a formula.
constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kOtherCauses{
    {{"accepts-nan", "accepts NaN"},
     {"accepts-infinity", "accepts infinity"},
     {"accepts-inverted", "accepts a box turned inside out"},
     {"accepts-negative", "accepts a negative radius, extent, length or distance"},
     {"accepts-vertices", "accepts a hull without vertices, or of too many"},
     {"accepts-zero", "accepts a direction, normal or quaternion of zeros"},
     {"no-answer", "gives no answer"}}};

/// Which of these an answer to a question outside the domain is.
std::string_view accepted_by(const Query& query) {
  bool nan = false;
  bool infinite = false;
  for_each_number(query, [&](const std::string&, double x) {
    nan = nan || std::isnan(x);
    infinite = infinite || std::isinf(x);
  });
  if (nan) return "accepts-nan";
  if (infinite) return "accepts-infinity";
  std::string_view cause;
  for_each_field(query, [&, broken = outside_domain(query)->field]<class Value>(const std::string& field, const Value&,
                                                                                FieldKind kind) {
    if (!broken.starts_with(field)) return;
    cause = kind == FieldKind::length   ? "accepts-negative"
            : has_free_length(kind)     ? "accepts-zero"
            : AnyNumberOfVectors<Value> ? "accepts-vertices"
                                        : "accepts-inverted";
  });
  return cause;
}

/// The causes that are the arithmetic of the engine's own format.
std::bitset<kMostCauses> own_arithmetic() {
  std::bitset<kMostCauses> own;
  for (std::size_t c = 0; c < causes().size(); ++c) own[c] = causes()[c].arithmetic == Cause::Arithmetic::own;
  return own;
}

std::uint64_t rounded(double n) { return static_cast<std::uint64_t>(std::llround(std::max(n, 0.0))); }

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i)
    text += (i == 0 ? "" : i + 1 == parts.size() ? " and " : ", ") + parts[i];
  return text;
}

}  // namespace

std::vector<Explanation> explain_wrong(const Query& query, const Truth& truth, const Claim& claim,
                                       const Declaration& declared, const Verdict& verdict,
                                       const Expectation* rounded) {
  const DefaultEnvironment environment;
  std::vector<Explanation> found;
  if (verdict.status != Claim::Status::answered || verdict.level() <= Level::bounded) return found;

  // Tries one alternative. It explains the fields that it turns from wrong to right.
  const auto attempt = [&](std::string_view convention, std::string_view value, auto change) {
    Declaration other = declared;
    change(other.conventions);
    if (other.conventions == declared.conventions) return;
    const Verdict under = judge(query, truth, claim, other, rounded, Detail::grades);
    const auto note = [&](std::string_view field) {
      found.push_back({std::string(field), std::string(convention), std::string(value)});
    };
    const auto decision = [&](std::string_view field, Decision as_declared, Decision otherwise) {
      if (as_declared != Decision::right && as_declared != Decision::unclaimed && otherwise == Decision::right)
        note(field);
    };
    decision("overlap", verdict.overlap, under.overlap);
    decision("contact", verdict.contact, under.contact);
    for (const Field field : kFields) {
      if (verdict.at(field) && !is_right(verdict.at(field)) && !verdict.at(field)->last_bit &&
          is_right(under.at(field)))
        note(name(field));
      if (verdict.missing.has(aspect(field)) && !under.missing.has(aspect(field)) && !newly_wrong(verdict, under))
        note(name(field));
    }
  };

  // To judge anew is exact and slow, so only what could turn a field right is tried.
  const bool decisions = is_wrong(verdict.overlap) || is_wrong(verdict.contact);
  const bool points = std::any_of(kFields.begin(), kFields.end(), [&](Field field) {
    return kPointAspects.has(aspect(field)) && is_wrong(verdict.at(field));
  });
  const bool directions = is_wrong(verdict.at(Field::normal)) || (points && truth.degenerate());
  const auto every = [&]<class E>(std::string_view convention, const auto& names, E Conventions::*chosen) {
    for (std::size_t i = 0; i < names.size(); ++i)
      attempt(convention, names[i], [&](Conventions& c) { c.*chosen = static_cast<E>(i); });
  };
  if (directions) {
    every("normal", std::span(kNormalDirectionNames).first(static_cast<std::size_t>(NormalDirection::none)),
          &Conventions::normal);
    attempt("normal_unit", "false", [](Conventions& c) { c.normal_unit = false; });
  }
  const bool numbers = directions || points || is_wrong(verdict.at(Field::value));
  if (is_convex(query.pair) && numbers) every("depth", kDepthOfNames, &Conventions::depth);
  const Aspects said = claim.says();
  const bool missing_points = !verdict.missing.common(kPointAspects).empty();
  if (points || (missing_points && !said.common(kPointAspects).empty()))
    every("points", std::span(kPointsNames).first(static_cast<std::size_t>(Points::none)), &Conventions::points);
  else if (missing_points)
    attempt("points", "none", [](Conventions& c) { c.points = Points::none; });
  if (verdict.missing.has(Aspect::normal))
    attempt("normal", "none", [](Conventions& c) { c.normal = NormalDirection::none; });
  if (verdict.missing.has(Aspect::value)) attempt("value", "none", [](Conventions& c) { c.value = ValueKind::none; });
  if (is_wrong(verdict.at(Field::value)))
    for (const bool less : {true, false})
      for (const ValueKind kind : {ValueKind::signed_distance, ValueKind::depth})
        attempt("value",
                std::string(kValueKindNames[static_cast<std::size_t>(kind)]) +
                    (less ? " less contact" : " without contact"),
                [&](Conventions& c) {
                  c.value = kind;
                  c.value_less_contact = less;
                });
  if (decisions) {
    every("touching_overlap", kTouchingNames, &Conventions::touching_overlap);
    every("touching_contact", kTouchingNames, &Conventions::touching_contact);
    every("margin", kMarginNames, &Conventions::margin);
  }
  if (truth.degenerate()) every("coincident", kCoincidentNames, &Conventions::coincident);
  return found;
}

void Diagnosis::count(std::uint64_t key, const Place& place, bool right, const Set& agree, const Set& differ,
                      std::uint64_t weight) {
  const auto add = [&](auto& all, const Set& of) {
    std::vector<std::uint64_t>& counts = all[place];
    counts.resize(causes().size());
    for (std::size_t i = 0; i < counts.size(); ++i) counts[i] += of[i] ? weight : 0;
  };
  const bool is_decision = place.aspect == Aspect::overlap || place.aspect == Aspect::contact;
  if (right) {
    add(contradicted_, differ);
    if (is_decision) add(upheld_, agree);
    return;
  }
  if (is_decision) add(denied_, differ);
  ++wrong_[std::string(name(place.aspect))];
  add_wrong({key, place, agree}, 1);
}

void Diagnosis::add_wrong(const Wrong& wrong, std::uint64_t n) {
  // The sample holds the smallest claims, in whatever order they come: one of those is never the last of more.
  sample_[wrong] += n;
  if (sample_.size() > kSample) sample_.erase(std::prev(sample_.end()));
}

bool Diagnosis::Place::is_sound() const {
  return static_cast<std::size_t>(aspect) < kAspectNames.size() && static_cast<std::size_t>(pair) < kPairs.size() &&
         static_cast<std::size_t>(region) < kRegionNames.size();
}

bool Diagnosis::is_sound() const {
  const std::array counts{&contradicted_, &upheld_, &denied_};
  const std::array by_pair{&answered_, &silent_};
  return std::all_of(by_pair.begin(), by_pair.end(),
                     [](const auto* of) {
                       return std::all_of(of->begin(), of->end(), [](const auto& entry) {
                         return static_cast<std::size_t>(entry.first) < kPairs.size();
                       });
                     }) &&
         std::all_of(outside_.begin(), outside_.end(),
                     [](const auto& entry) {
                       return std::any_of(kOtherCauses.begin(), kOtherCauses.end(),
                                          [&](const auto& cause) { return cause.first == entry.first; });
                     }) &&
         std::all_of(sample_.begin(), sample_.end(),
                     [&](const auto& entry) {
                       const auto& [place, by] = std::tie(entry.first.place, entry.first.by);
                       return place.is_sound() && (by >> causes().size()).none() &&
                              wrong_.contains(std::string(name(place.aspect)));
                     }) &&
         std::all_of(counts.begin(), counts.end(), [](const auto* of) {
           return std::all_of(of->begin(), of->end(), [](const auto& entry) {
             return entry.first.is_sound() && entry.second.size() == causes().size();
           });
         });
}

bool Diagnosis::is_sampled() const {
  const auto sum = [](const auto& counts) {
    return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0},
                           [](std::uint64_t n, const auto& entry) { return n + entry.second; });
  };
  return sum(sample_) < sum(wrong_);
}

std::vector<Diagnosis::Alike> Diagnosis::alike() const {
  std::map<Aspect, double> sampled;
  for (const auto& [wrong, n] : sample_) sampled[wrong.place.aspect] += static_cast<double>(n);
  std::map<Place, std::unordered_map<Set, double>> sets;
  for (const auto& [wrong, n] : sample_) {
    const std::uint64_t all = wrong_.at(std::string(name(wrong.place.aspect)));
    sets[wrong.place][wrong.by] += static_cast<double>(n) * static_cast<double>(all) / sampled[wrong.place.aspect];
  }
  std::vector<Alike> found;
  for (const auto& [place, by_set] : sets)
    for (const auto& [by, n] : by_set) found.push_back({place, by, n});
  return found;
}

void Diagnosis::add(std::uint64_t key, const Query& query, const Truth& truth, const Claim& claim,
                    const Declaration& declared, const Verdict& verdict, const Expectation* rounded,
                    std::uint64_t weight) {
  if (verdict.status != Claim::Status::answered) {
    ++silent_[query.pair];
    return;
  }
  ++answered_[query.pair];
  for (const std::string_view aspect : verdict.missing.names()) ++missing_[std::string(aspect)];
  if (weight == 0) return;
  if (!compares_at_once() && verdict.level() <= Level::bounded) {
    postpone(query, truth, claim, declared, weight);
    return;
  }
  compare(key, query, truth, claim, declared, verdict, rounded, weight);
  if (!wrong_.empty()) settle();
}

void Diagnosis::postpone(const Query& query, const Truth& truth, const Claim& claim, const Declaration& declared,
                         std::uint64_t weight) {
  // One copy of a declaration serves all that are judged by it, as a rule.
  const bool known = !postponed_.empty() && *postponed_.back().declared == declared;
  postponed_.push_back({query, truth.at_alarm, truth.at_zero, claim,
                        known ? postponed_.back().declared : std::make_shared<const Declaration>(declared), weight});
}

void Diagnosis::settle() {
  for (const Postponed& p : std::exchange(postponed_, {})) compare(p);
}

void Diagnosis::compare(const Postponed& p) {
  const Truth truth = truth_with(p.query, p.at_alarm, p.at_zero);
  // No key: a right claim stands in no sample.
  compare(0, p.query, truth, p.claim, *p.declared, judge(p.query, truth, p.claim, *p.declared), nullptr, p.weight);
}

void Diagnosis::compare(std::uint64_t key, const Query& query, const Truth& truth, const Claim& claim,
                        const Declaration& declared, const Verdict& verdict, const Expectation* rounded,
                        std::uint64_t weight) {
  const DefaultEnvironment environment;
  const Facts facts(query, truth, declared.scalar, said_normal(claim, declared.conventions));
  const std::vector<Claimed> claimed = claimed_of(facts, claim, declared, verdict);
  const auto all = causes();
  std::vector<Set> agree(claimed.size());
  std::vector<Set> differ(claimed.size());
  const auto normal =
      std::find_if(claimed.begin(), claimed.end(), [](const Claimed& c) { return c.aspect == Aspect::normal; });
  const bool wrong_normal = normal != claimed.end() && !normal->right;
  for (std::size_t c = 0; c < all.size(); ++c) {
    const Predictions said = predict(all[c], facts);
    for (std::size_t i = 0; i < claimed.size(); ++i) {
      const Match found = match(said_of(said, claimed[i].aspect), claimed[i], declared.scalar);
      agree[i][c] = found == Match::agrees;
      differ[i][c] = found == Match::differs;
    }
  }
  // A point that follows a wrong normal is wrong for the same cause.
  if (wrong_normal)
    for (std::size_t i = 0; i < claimed.size(); ++i) {
      const Aspect aspect = claimed[i].aspect;
      if (claimed[i].right || !is_point(aspect)) continue;
      if (match(following(facts, aspect), claimed[i], declared.scalar) == Match::agrees)
        agree[i] |= agree[static_cast<std::size_t>(normal - claimed.begin())];
    }
  for (std::size_t i = 0; i < claimed.size(); ++i)
    count(key, {claimed[i].aspect, query.pair, facts.region}, claimed[i].right, agree[i], differ[i], weight);
  for (const Explanation& e : explain_wrong(query, truth, claim, declared, verdict, rounded)) ++explanations_[e];
}

std::string_view sentence_of(std::string_view cause) {
  for (const auto& [id, sentence] : kOtherCauses)
    if (id == cause) return sentence;
  return causes()[cause_index(cause)].sentence;
}

void Diagnosis::add_outside_domain(const Query& query) { ++outside_[std::string(accepted_by(query))]; }

void Diagnosis::merge(const Diagnosis& other) {
  const auto add_up = [](auto& mine, const auto& others) {
    for (const auto& [key, n] : others) mine[key] += n;
  };
  add_up(explanations_, other.explanations_);
  add_up(missing_, other.missing_);
  add_up(wrong_, other.wrong_);
  add_up(outside_, other.outside_);
  add_up(silent_, other.silent_);
  add_up(answered_, other.answered_);
  for (const auto& [wrong, n] : other.sample_) add_wrong(wrong, n);
  const auto add_counts = [](Counts& mine, const Counts& others) {
    for (const auto& [place, counts] : others) {
      std::vector<std::uint64_t>& all = mine[place];
      all.resize(counts.size());
      for (std::size_t i = 0; i < counts.size(); ++i) all[i] += counts[i];
    }
  };
  add_counts(contradicted_, other.contradicted_);
  add_counts(upheld_, other.upheld_);
  add_counts(denied_, other.denied_);
  for (const Postponed& p : other.postponed_)
    if (compares_at_once())
      compare(p);
    else
      postponed_.push_back(p);
  if (at_once_ || !wrong_.empty()) settle();
}

double Diagnosis::beyond_chance(std::size_t cause, const Place& place, double explained) const {
  const auto count = [&](const auto& all) {
    const auto found = all.find(place);
    return found == all.end() ? 0 : static_cast<double>(found->second[cause]);
  };
  // Numbers are not met by chance: see `match`. An arithmetic says of no decision which it is.
  if (causes()[cause].arithmetic != Cause::Arithmetic::none) return explained;
  if (place.aspect != Aspect::overlap && place.aspect != Aspect::contact) return explained;
  // A formula that has nothing to do with the mistake turns right decisions over as often as wrong ones; where none are
  // right, every other.
  const double against = count(contradicted_);
  const double rate = (against + 0.5) / (against + count(upheld_) + 1);
  // Some claims are wrong by the mistake, and all of those explained; the others at that rate.
  return (explained - rate * (explained + count(denied_))) / (1 - rate);
}

std::vector<std::map<Diagnosis::Place, double>> Diagnosis::shares(std::span<const Alike> wrong) const {
  std::vector<std::map<Place, double>> explained(causes().size());
  for (const Alike& w : wrong)
    for (std::size_t c = 0; c < explained.size(); ++c)
      if (w.by[c]) explained[c][w.place] += w.n;
  for (std::size_t c = 0; c < explained.size(); ++c)
    for (auto& [place, n] : explained[c]) n = std::max(0.0, beyond_chance(c, place, n)) / n;
  return explained;
}

Gain Diagnosis::gain(std::size_t cause, std::span<const Alike> wrong, std::span<const std::size_t> left,
                     const std::map<Place, double>& share) const {
  std::map<Place, double> explained;
  for (const std::size_t i : left)
    if (wrong[i].by[cause]) explained[wrong[i].place] += wrong[i].n;
  const Cause& formula = causes()[cause];
  const bool says_points = formula.edit || formula.point;
  std::set<Place> places;
  Gain gain;
  for (const auto& [place, n] : explained) {
    const auto counts = contradicted_.find(place);
    const double against = counts == contradicted_.end() ? 0 : static_cast<double>(counts->second[cause]);
    const double score = std::min(n - against, n * share.at(place));
    // A cause that says nothing of points explains those that follow a wrong normal, and these only with the normal.
    if (score <= 0 ||
        (is_point(place.aspect) && !says_points && !places.contains({Aspect::normal, place.pair, place.region})))
      continue;
    places.insert(place);
    gain.covered += n;
    gain.score += score;
  }
  // An arithmetic shows in numbers: of an engine that gives some it explains no decisions alone.
  const auto is_number = [](const Place& place) {
    return place.aspect != Aspect::overlap && place.aspect != Aspect::contact;
  };
  if (formula.arithmetic == Cause::Arithmetic::coarse && std::none_of(places.begin(), places.end(), is_number) &&
      std::any_of(contradicted_.begin(), contradicted_.end(), [&](const auto& of) { return is_number(of.first); }))
    return {};
  if (places.empty()) return gain;
  double elsewhere = 0;
  double against = 0;
  for (const auto& [place, counts] : contradicted_) {
    if (places.contains(place)) continue;
    ++elsewhere;
    if (counts[cause] > 0) ++against;
  }
  if (elsewhere > 0) gain.score *= 1 - kElsewhere * against / elsewhere;
  gain.score *= formula.weight;
  for (const std::size_t i : left)
    if (wrong[i].by[cause] && places.contains(wrong[i].place)) gain.elements.push_back(i);
  return gain;
}

std::string Diagnosis::sentence(std::size_t cause, std::span<const Alike> wrong,
                                std::span<const std::size_t> explained) const {
  std::map<Place, double> places;
  for (const std::size_t i : explained) places[wrong[i].place] += wrong[i].n;
  std::map<Aspect, double> by_aspect;
  std::set<Pair> pairs;
  std::set<Region> regions;
  for (const auto& [place, n] : places) {
    by_aspect[place.aspect] += n;
    pairs.insert(place.pair);
    regions.insert(place.region);
  }
  // Regions and pairs are named where the mistake could have been made in others and was not.
  const auto contradicted = [&](auto is_elsewhere) {
    return std::any_of(contradicted_.begin(), contradicted_.end(), [&](const auto& entry) {
      return by_aspect.contains(entry.first.aspect) && entry.second[cause] > 0 && is_elsewhere(entry.first);
    });
  };
  std::string text(causes()[cause].sentence);
  std::vector<std::string> parts;
  if (contradicted([&](const Place& p) { return pairs.contains(p.pair) && !regions.contains(p.region); })) {
    for (const Region r : regions) parts.emplace_back(kRegionNames[static_cast<std::size_t>(r)]);
    text += ", " + joined(parts);
  }
  parts.clear();
  if (contradicted([&](const Place& p) { return !pairs.contains(p.pair); })) {
    for (const Pair p : pairs) parts.emplace_back(name(p));
    text += ", in " + joined(parts);
  }
  parts.clear();
  for (const auto& [aspect, n] : by_aspect) {
    const std::string what(name(aspect));
    parts.push_back(std::to_string(rounded(n)) + " of " + std::to_string(wrong_.at(what)) + " wrong " + what +
                    " claims");
  }
  return text + (is_sampled() ? ": explains about " : ": explains ") + joined(parts);
}

std::vector<Finding> Diagnosis::findings() const {
  std::vector<Finding> found;
  for (const auto& [cause, n] : outside_)
    found.push_back(
        {cause, std::string(sentence_of(cause)) + ": " + std::to_string(n) + " answers where there is no question", n});
  std::stable_sort(found.begin(), found.end(),
                   [](const Finding& x, const Finding& y) { return x.explained > y.explained; });
  for (const auto& [pair, n] : silent_)
    found.push_back({"no-answer",
                     std::string(sentence_of("no-answer")) + (answered_.contains(pair) ? ", sometimes, in " : ", in ") +
                         std::string(name(pair)) + ": " + std::to_string(n) + " questions",
                     n});
  std::uint64_t all = 0;
  for (const auto& [aspect, n] : wrong_) all += n;
  const std::vector<Alike> wrong = alike();
  const auto share = shares(wrong);
  // What roundings to the engine's own format may have done is no evidence for anything else. So what explains more
  // than that comes first, and explains the rest with it.
  const Set own = own_arithmetic();
  auto rest = static_cast<double>(all);
  std::vector<Alike> left = wrong;
  const auto choose = [&](double one_in, const GainOf& gain_of) {
    const CoverLimits limits{kMostFindings - std::min(found.size(), kMostFindings), static_cast<double>(all), one_in};
    std::vector<bool> taken(left.size());
    for (const Choice& choice : greedy_cover(left.size(), causes().size(), gain_of, limits)) {
      double covered = 0;
      for (const std::size_t i : choice.gain.elements) covered += left[i].n, taken[i] = true;
      found.push_back({std::string(causes()[choice.candidate].id),
                       sentence(choice.candidate, left, choice.gain.elements), rounded(covered)});
      rest -= covered;
    }
    std::size_t i = 0;
    std::erase_if(left, [&](const Alike&) { return taken[i++]; });
  };
  choose(kOneInByEvidence, [&](std::size_t cause, std::span<const std::size_t> among) -> Gain {
    if (causes()[cause].arithmetic == Cause::Arithmetic::own) return {};
    std::vector<std::size_t> evidence;
    for (const std::size_t i : among)
      if ((left[i].by & own).none()) evidence.push_back(i);
    Gain by_evidence = gain(cause, left, evidence, share[cause]);
    if (by_evidence.covered <= kOneAnswer) return {};
    if (by_evidence.score > 0) by_evidence.elements = gain(cause, left, among, share[cause]).elements;
    return by_evidence;
  });
  choose(kOneInByChance,
         [&](std::size_t cause, std::span<const std::size_t> among) { return gain(cause, left, among, share[cause]); });
  if (const std::uint64_t n = rounded(rest); n * kOneInUnexplained > all)
    found.push_back({"",
                     (is_sampled() ? "about " : "") + std::to_string(n) + " of " + std::to_string(all) +
                         " wrong claims fit no known mistake",
                     n});
  return found;
}

std::vector<std::string> Diagnosis::lines() const {
  std::vector<std::string> sentences;
  for (const Finding& f : findings()) sentences.push_back(f.sentence);
  // The convention that makes most of the wrong fields right.
  const auto right_under = [&](const std::string& field, std::uint64_t n) -> std::string {
    const std::pair<const Explanation, std::uint64_t>* best = nullptr;
    for (const auto& entry : explanations_)
      if (entry.first.field == field && (best == nullptr || entry.second > best->second)) best = &entry;
    if (best == nullptr || best->second * kOneInConvention < n) return {};
    return std::to_string(best->second) + " of " + std::to_string(n) +
           " wrong answers are right under the convention " + best->first.convention + " = " + best->first.value;
  };
  for (const auto& [field, n] : wrong_)
    if (const std::string how = right_under(field, n + missing(field)); !how.empty())
      sentences.push_back(field + ": " + how);
  for (const auto& [field, n] : missing_) {
    const std::string how = wrong_.contains(field) ? "" : right_under(field, n);
    sentences.push_back(field + ": missing in " + std::to_string(n) + " answers to hits; " +
                        (how.empty() ? "an engine that never gives it says so by \"claims\"" : how));
  }
  return sentences;
}

}  // namespace contact::oracle
