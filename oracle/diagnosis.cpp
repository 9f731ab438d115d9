// Why answers are wrong: the conventions under which they would be right, and the mistakes that explain them.
#include "oracle/diagnosis.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <unordered_map>

#include "oracle/default_environment.hpp"

namespace contact::oracle {
namespace {

bool is_right(const std::optional<FieldVerdict>& field) { return field && field->grade <= Grade::bounded; }
bool is_wrong(const std::optional<FieldVerdict>& field) { return field && field->grade > Grade::bounded; }
bool is_wrong(Decision d) { return d == Decision::missed_hit || d == Decision::false_hit; }

Real ulp_of(Real x, Scalar scalar) {
  const Format format = format_of(scalar);
  const int exponent = x == 0 || !std::isfinite(x) ? format.min_exponent : std::ilogb(x);
  return std::ldexp(Real{1}, std::max(exponent, format.min_exponent) - format.precision + 1);
}

/// A claim of one aspect as numbers, in the default conventions.
struct Claimed {
  Aspect aspect;
  bool right;
  Numbers numbers{};
  Real scale = 0;  ///< whose ulp the bound counts; 0 for decisions
  Real bound = 0;
};

enum class Match { no_opinion, agrees, differs };

Match match(const Said& said, const Claimed& claimed, Scalar scalar) {
  if (said.kind == Said::Kind::no_opinion) return Match::no_opinion;
  if (said.kind == Said::Kind::anything) return claimed.right ? Match::no_opinion : Match::agrees;
  if (claimed.scale == 0) return said.numbers[0] == claimed.numbers[0] ? Match::agrees : Match::differs;
  Real largest = claimed.scale;
  for (const Real x : said.numbers)
    if (std::isfinite(x)) largest = std::max(largest, std::abs(x));
  const Real tolerance = std::max(said.tolerance, claimed.bound * ulp_of(largest, scalar));
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
  return same ? Match::agrees : Match::differs;
}

Numbers numbers_of(const Vector3& v) { return {v[0], v[1], v[2]}; }

/// Everything that an answer claims and the judge has judged.
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
  const auto field = [&](Aspect aspect, Field which, const Numbers& numbers, Real scale, double bound) {
    const auto& judged = verdict.at(which);
    if (judged) all.push_back({aspect, is_right(judged), numbers, scale, bound});
  };
  const auto largest = [](const Numbers& c, Real r) {
    return std::max({std::abs(c[0]), std::abs(c[1]), std::abs(c[2]), r, std::numeric_limits<Real>::min()});
  };
  const std::array scales{largest(f.center[0], f.radius[0]), largest(f.center[1], f.radius[1])};
  if (f.said_normal) field(Aspect::normal, Field::normal, *f.said_normal, 1, declared.bounds.normal);
  if (said.point1) field(Aspect::point1, Field::point1, numbers_of(*said.point1), scales[0], declared.bounds.point);
  if (said.point2) field(Aspect::point2, Field::point2, numbers_of(*said.point2), scales[1], declared.bounds.point);
  if (said.point)
    field(Aspect::point, Field::point, numbers_of(*said.point), std::max(scales[0], scales[1]), declared.bounds.point);
  if (said.value) {
    Real value = *said.value;
    if (declared.conventions.value == ValueKind::depth) value = -value;
    if (!declared.conventions.value_less_contact) value -= f.contact;
    const Real scale = std::max({f.distance, f.radii(), f.contact, std::numeric_limits<Real>::min()});
    field(Aspect::value, Field::value, {value, 0, 0}, scale, declared.bounds.value);
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
      break;
  }
  return nothing;
}

/// A contact point that lies where the claimed normal, which is wrong, puts it.
Said following(const Facts& f, std::size_t sphere) {
  const Real along = (sphere == 0 ? 1 : -1) * f.radius[sphere];
  Numbers p{};
  for (std::size_t i = 0; i < 3; ++i) p[i] = f.center[sphere][i] + along * (*f.said_normal)[i];
  return p;
}

/// The normal that an answer claims, first to second.
std::optional<Numbers> said_normal(const Claim& claim, const Conventions& conventions) {
  if (!claim.contact || !claim.contact->normal) return std::nullopt;
  const bool first = conventions.normal == NormalDirection::first_to_second;
  return numbers_of(first ? *claim.contact->normal : Vector3(-*claim.contact->normal));
}

/// What is wrong with answers that no formula is about.
constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kOtherCauses{
    {{"accepts-nan", "accepts NaN"},
     {"accepts-infinity", "accepts infinity"},
     {"accepts-inverted", "accepts a box turned inside out, or a negative distance"},
     {"accepts-negative", "accepts a negative radius or distance"},
     {"no-answer", "gives no answer"}}};

std::string share(std::uint64_t n, std::uint64_t of, std::string_view what) {
  return std::to_string(n) + " of " + std::to_string(of) + " wrong " + std::string(what) + " claims";
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

  // One alternative at a time; it explains a field that it turns from wrong to right.
  const auto attempt = [&](std::string_view convention, std::string_view value, auto change) {
    Declaration other = declared;
    change(other.conventions);
    if (other.conventions == declared.conventions) return;
    const Verdict under = judge(query, truth, claim, other, rounded);
    const auto note = [&](std::string_view field) {
      found.push_back({std::string(field), std::string(convention), std::string(value)});
    };
    const auto decision = [&](std::string_view field, Decision as_declared, Decision otherwise) {
      if (as_declared != Decision::right && as_declared != Decision::unclaimed && otherwise == Decision::right)
        note(field);
    };
    decision("overlap", verdict.overlap, under.overlap);
    decision("contact", verdict.contact, under.contact);
    for (const Field field : kFields)
      if (verdict.at(field) && !is_right(verdict.at(field)) && is_right(under.at(field))) note(name(field));
  };

  // Only what could turn something right is tried: judging anew is exact, and slow.
  const bool decisions = is_wrong(verdict.overlap) || is_wrong(verdict.contact);
  const bool points =
      is_wrong(verdict.at(Field::point1)) || is_wrong(verdict.at(Field::point2)) || is_wrong(verdict.at(Field::point));
  const bool directions = is_wrong(verdict.at(Field::normal)) || (points && truth.spheres->degenerate());
  const auto every = [&](std::string_view convention, const auto& names, auto set) {
    for (std::size_t i = 0; i < names.size(); ++i) attempt(convention, names[i], [&](Conventions& c) { set(c, i); });
  };
  if (directions) {
    every("normal", kNormalDirectionNames,
          [](Conventions& c, std::size_t i) { c.normal = static_cast<NormalDirection>(i); });
    attempt("normal_unit", "false", [](Conventions& c) { c.normal_unit = false; });
  }
  if (points) every("points", kPointsNames, [](Conventions& c, std::size_t i) { c.points = static_cast<Points>(i); });
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
    every("touching_overlap", kTouchingNames,
          [](Conventions& c, std::size_t i) { c.touching_overlap = static_cast<Touching>(i); });
    every("touching_contact", kTouchingNames,
          [](Conventions& c, std::size_t i) { c.touching_contact = static_cast<Touching>(i); });
    every("margin", kMarginNames, [](Conventions& c, std::size_t i) { c.margin = static_cast<Margin>(i); });
  }
  if (truth.spheres && truth.spheres->degenerate())
    every("coincident", kCoincidentNames,
          [](Conventions& c, std::size_t i) { c.coincident = static_cast<Coincident>(i); });
  return found;
}

void Diagnosis::count(std::uint64_t key, const Place& place, bool right, const Set& agree, const Set& differ,
                      std::uint64_t weight) {
  if (right) {
    std::vector<std::uint64_t>& counts = contradicted_[place];
    counts.resize(causes().size());
    for (std::size_t i = 0; i < counts.size(); ++i) counts[i] += differ[i] ? weight : 0;
    return;
  }
  ++wrong_[std::string(kAspectNames[static_cast<std::size_t>(place.aspect)])];
  add_wrong({key, place, agree}, 1);
}

void Diagnosis::add_wrong(const Wrong& wrong, std::uint64_t n) {
  // The first in order are the same whatever comes when, and none of those has ever been dropped.
  sample_[wrong] += n;
  if (sample_.size() > kSample) sample_.erase(std::prev(sample_.end()));
}

bool Diagnosis::Place::is_sound() const {
  return static_cast<std::size_t>(aspect) < kAspectNames.size() && static_cast<std::size_t>(pair) < kPairs.size() &&
         static_cast<std::size_t>(region) < kRegionNames.size();
}

bool Diagnosis::is_sound() const {
  return std::all_of(sample_.begin(), sample_.end(),
                     [&](const auto& entry) {
                       const auto& [place, by] = std::tie(entry.first.place, entry.first.by);
                       return place.is_sound() && (by >> causes().size()).none() &&
                              wrong_.contains(std::string(kAspectNames[static_cast<std::size_t>(place.aspect)]));
                     }) &&
         std::all_of(contradicted_.begin(), contradicted_.end(), [](const auto& entry) {
           return entry.first.is_sound() && entry.second.size() == causes().size();
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
    const std::uint64_t all = wrong_.at(std::string(kAspectNames[static_cast<std::size_t>(wrong.place.aspect)]));
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
  if (weight == 0) return;
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
  // What is wrong with the normal is wrong with a point that goes with it.
  if (wrong_normal)
    for (std::size_t i = 0; i < claimed.size(); ++i) {
      const Aspect aspect = claimed[i].aspect;
      if (claimed[i].right || (aspect != Aspect::point1 && aspect != Aspect::point2)) continue;
      if (match(following(facts, aspect == Aspect::point1 ? 0 : 1), claimed[i], declared.scalar) == Match::agrees)
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

void Diagnosis::add_outside_domain(const Query& query) {
  bool nan = false;
  bool infinite = false;
  for_each_number(query, [&](const std::string&, double x) {
    nan = nan || std::isnan(x);
    infinite = infinite || std::isinf(x);
  });
  ++outside_[nan             ? "accepts-nan"
             : infinite      ? "accepts-infinity"
             : query.boxes() ? "accepts-inverted"
                             : "accepts-negative"];
}

void Diagnosis::merge(const Diagnosis& other) {
  for (const auto& [e, n] : other.explanations_) explanations_[e] += n;
  for (const auto& [field, n] : other.wrong_) wrong_[field] += n;
  for (const auto& [what, n] : other.outside_) outside_[what] += n;
  for (const auto& [pair, n] : other.silent_) silent_[pair] += n;
  for (const auto& [pair, n] : other.answered_) answered_[pair] += n;
  for (const auto& [wrong, n] : other.sample_) add_wrong(wrong, n);
  for (const auto& [place, counts] : other.contradicted_) {
    std::vector<std::uint64_t>& mine = contradicted_[place];
    mine.resize(counts.size());
    for (std::size_t i = 0; i < counts.size(); ++i) mine[i] += counts[i];
  }
}

/// What one cause explains of what is left, place by place.
class Diagnosis::Gain {
 public:
  Gain(const Diagnosis& run, const std::vector<Alike>& left, std::size_t cause) : run_(run), cause_(cause) {
    for (const Alike& wrong : left)
      if (wrong.by[cause]) explained_[wrong.place] += wrong.n;
    for (const auto& [place, n] : explained_) {
      const double against = contradictions(place);
      if (n <= against || (!speaks_of(place.aspect) && !places_.contains({Aspect::normal, place.pair, place.region})))
        continue;
      places_.insert(place);
      total_ += n;
      score_ += n - against;
    }
    // A mistake that is made wherever it can be is the simpler one: what speaks against it elsewhere counts a little.
    double elsewhere = 0;
    double against = 0;
    for (const auto& [place, counts] : run.contradicted_) {
      if (places_.contains(place)) continue;
      ++elsewhere;
      if (counts[cause] > 0) ++against;
    }
    if (elsewhere > 0) score_ *= 1 - 0.05 * against / elsewhere;
    score_ *= causes()[cause].weight;
  }

  [[nodiscard]] double score() const { return score_; }
  [[nodiscard]] double total() const { return total_; }
  [[nodiscard]] bool explains(const Alike& wrong) const { return wrong.by[cause_] && places_.contains(wrong.place); }

  [[nodiscard]] std::string sentence() const {
    std::map<Aspect, double> by_aspect;
    std::set<Pair> pairs;
    std::set<Region> regions;
    for (const Place& place : places_) {
      by_aspect[place.aspect] += explained_.at(place);
      pairs.insert(place.pair);
      regions.insert(place.region);
    }
    std::string text(causes()[cause_].sentence);
    // Where it is made, if it might have been made elsewhere and was not.
    const auto elsewhere = [&](auto is_elsewhere) {
      return std::any_of(run_.contradicted_.begin(), run_.contradicted_.end(), [&](const auto& entry) {
        return by_aspect.contains(entry.first.aspect) && entry.second[cause_] > 0 && is_elsewhere(entry.first);
      });
    };
    std::vector<std::string> parts;
    if (elsewhere([&](const Place& p) { return pairs.contains(p.pair) && !regions.contains(p.region); }))
      for (const Region r : regions) parts.emplace_back(kRegionNames[static_cast<std::size_t>(r)]);
    if (!parts.empty()) text += ", " + joined(parts);
    parts.clear();
    if (elsewhere([&](const Place& p) { return !pairs.contains(p.pair); }))
      for (const Pair p : pairs) parts.emplace_back(name(p));
    if (!parts.empty()) text += ", in " + joined(parts);
    parts.clear();
    for (const auto& [aspect, n] : by_aspect) {
      const std::string_view what = kAspectNames[static_cast<std::size_t>(aspect)];
      parts.push_back(share(rounded(n), run_.wrong_.at(std::string(what)), what));
    }
    return text + (run_.is_sampled() ? ": explains about " : ": explains ") + joined(parts);
  }

 private:
  [[nodiscard]] double contradictions(const Place& place) const {
    const auto it = run_.contradicted_.find(place);
    return it == run_.contradicted_.end() ? 0 : static_cast<double>(it->second[cause_]);
  }
  /// Whether the cause says where a point is; else it explains those points that go with a wrong normal.
  [[nodiscard]] bool speaks_of(Aspect aspect) const {
    return (aspect != Aspect::point1 && aspect != Aspect::point2) || causes()[cause_].edit || causes()[cause_].point;
  }

  const Diagnosis& run_;
  std::size_t cause_;
  std::map<Place, double> explained_;
  std::set<Place> places_;
  double total_ = 0;
  double score_ = 0;
};

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
  std::vector<Alike> left = alike();
  constexpr std::size_t kMostFindings = 6;
  auto rest = static_cast<double>(all);
  while (found.size() < kMostFindings && !left.empty()) {
    std::optional<Gain> best;
    std::string_view id;
    for (std::size_t c = 0; c < causes().size(); ++c) {
      Gain gain(*this, left, c);
      if (gain.score() <= 0 || (best && gain.score() <= best->score())) continue;
      best.emplace(gain);
      id = causes()[c].id;
    }
    // A mistake that explains next to nothing explains it by chance.
    if (!best || best->total() * 50 < static_cast<double>(all)) break;
    found.push_back({std::string(id), best->sentence(), rounded(best->total())});
    rest -= best->total();
    std::erase_if(left, [&](const Alike& wrong) { return best->explains(wrong); });
  }
  if (const std::uint64_t n = rounded(rest); n * 10 > all)
    found.push_back({"",
                     (is_sampled() ? "about " : "") + std::to_string(n) + " of " + std::to_string(all) +
                         " wrong claims fit no known mistake",
                     n});
  return found;
}

std::vector<std::string> Diagnosis::lines() const {
  std::vector<std::string> sentences;
  for (const Finding& f : findings()) sentences.push_back(f.sentence);
  for (const auto& [field, n] : wrong_) {
    // Of the conventions that would make this field right, the one that explains the most; few are no explanation.
    const std::pair<const Explanation, std::uint64_t>* best = nullptr;
    for (const auto& entry : explanations_)
      if (entry.first.field == field && (best == nullptr || entry.second > best->second)) best = &entry;
    if (best == nullptr || best->second * 2 < n) continue;
    sentences.push_back(field + ": " + std::to_string(best->second) + " of " + std::to_string(n) +
                        " wrong answers are right under the convention " + best->first.convention + " = " +
                        best->first.value);
  }
  return sentences;
}

}  // namespace contact::oracle
