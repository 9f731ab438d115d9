// From which tolerance on an engine would pass, and which questions stand in the way.
#include "tool/reports/fitness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>

#include "formats/json.hpp"
#include "golden/dataset.hpp"
#include "golden/query_id.hpp"

namespace contact::tool {
namespace {

using oracle::Measure;
using oracle::Off;

std::size_t place(Measure measure) { return static_cast<std::size_t>(measure); }

/// Takes what is larger. The line of the question is made only then.
void take(Largest& largest, double off, const Query& query, Scalar scalar) {
  if (off > largest.off) largest = {off, golden::query_line(query, scalar)};
}
void take(Need& need, const Off& off, const Query& query, Scalar scalar) {
  take(need.absolute, off.most, query, scalar);
  take(need.relative, off.relative, query, scalar);
}

const Need& of(const Fitness::Needs& needs, Measure measure) { return needs[place(measure)]; }
double length_of(const Fitness::Needs& needs, Largest Need::*kind) {
  return std::max((of(needs, Measure::length).*kind).off, (of(needs, Measure::decision).*kind).off);
}

constexpr double kMostAngle = 3.15;  // that --tolerance takes; a normal's length may be off by more

/// Whether a length, or a share of the scale, is one that somebody may state: less than the field's own scale, by which
/// nothing would be right as well, and than what any everyday number is.
bool is_said(const Fitness::Needs& needs, Largest Need::*kind) {
  const double share = of(needs, Measure::length).relative.off;
  const bool beyond_its_scale = share >= 1 && std::isfinite(share);  // infinite where a scale is 0
  const double length = length_of(needs, kind);
  return std::isfinite(length) && !beyond_its_scale && (kind == &Need::relative || length <= kEverydayTo);
}

/// Half a turn with two figures would be more than the option takes. Domain: at most kMostAngle.
std::string angle_text(double angle) { return angle > 3.1 ? "3.15" : rounded_up(angle); }

/// The option that these needs ask for, with one kind of length; nothing where no such length that is said is enough.
std::optional<std::string> option(const Fitness::Needs& needs, std::string_view key, Largest Need::*kind) {
  const double angle = of(needs, Measure::angle).absolute.off;
  const double length = length_of(needs, kind);
  if (!is_said(needs, kind) || angle > kMostAngle) return std::nullopt;
  std::string text = length == 0 && angle != 0 ? "" : fmt::format("{}={}", key, rounded_up(length));
  if (angle != 0) text += fmt::format("{}angle={}", text.empty() ? "" : ",", angle_text(angle));
  return text;
}

/// "--tolerance length=1e-3,angle=0.1, or relative=1e-6,angle=0.1"
std::string options(const Fitness::Needs& needs, std::string_view scale) {
  if (length_of(needs, &Need::absolute) == 0 && of(needs, Measure::angle).absolute.off == 0) return "any tolerance";
  const auto length = option(needs, "length", &Need::absolute);
  const auto relative = option(needs, "relative", &Need::relative);
  if (!length && !relative) return "no length and no share of the scale that anybody would state";
  std::string text = fmt::format("--tolerance {}{}", length.value_or(relative.value_or("")), scale);
  if (length && relative && *length != *relative) text += fmt::format(", or {}{}", *relative, scale);
  return text;
}

/// Of a line for `explain`, which begins with it.
std::string_view id_of(std::string_view question) {
  constexpr std::string_view kBefore = R"({"id":")";
  return question.substr(kBefore.size(), golden::kIdLength);
}

std::string needs_json(const Fitness::Needs& needs) {
  const auto largest = [](const Largest& one) {
    const std::string id = one.question.empty() ? "" : formats::json_string(id_of(one.question));
    return fmt::format(R"({{"from":{}{}{}}})", formats::number(one.off), id.empty() ? "" : ",\"id\":", id);
  };
  std::string text;
  for (const Measure measure : oracle::kMeasures) {
    const Need& need = of(needs, measure);
    text += fmt::format(R"({}"{}":{})", text.empty() ? "" : ",", oracle::kMeasureNames[place(measure)],
                        largest(need.absolute));
    if (measure != Measure::angle)
      text += fmt::format(R"(,"relative_{}":{})", oracle::kMeasureNames[place(measure)], largest(need.relative));
  }
  return "{" + text + "}";
}

}  // namespace

void Largest::merge(const Largest& other) {
  if (other.off > off) *this = other;
}

void Need::merge(const Need& other) {
  absolute.merge(other.absolute);
  relative.merge(other.relative);
}

void Fitness::add(const oracle::Verdict& verdict, const Query& query, Scalar scalar) {
  ++answers;
  if (!verdict.within()) ++beyond;
  if (verdict.beyond_any()) {
    if (never++ == 0) never_question = golden::query_line(query, scalar);
    return;
  }
  std::array<double, oracle::kMeasures.size()>* here = nullptr;
  for (const Measure measure : oracle::kMeasures) {
    const Off& off = verdict.at(measure);
    if (off.most == 0) continue;
    take(all[place(measure)], off, query, scalar);
    if (here == nullptr) here = &by_scale[decade_of(query)];
    (*here)[place(measure)] = std::max((*here)[place(measure)], off.most);
    const Off rest = verdict.beyond_last_bit(measure);
    take(beyond_last_bit[place(measure)], rest, query, scalar);
    if (rest != off) ++(measure == Measure::decision && verdict.decision_rounded ? rounded : last_bit[place(measure)]);
  }
}

void Fitness::merge(const Fitness& other) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].merge(other.all[i]);
    beyond_last_bit[i].merge(other.beyond_last_bit[i]);
    last_bit[i] += other.last_bit[i];
  }
  if (never_question.empty()) never_question = other.never_question;
  rounded += other.rounded;
  answers += other.answers;
  never += other.never;
  beyond += other.beyond;
  for (const auto& [decade, most] : other.by_scale) {
    auto& here = by_scale[decade];
    for (std::size_t i = 0; i < here.size(); ++i) here[i] = std::max(here[i], most[i]);
  }
}

int decade_of(const Query& query) {
  double largest = 0;
  for_each_number_unnamed(query, [&](double x) {
    if (std::isfinite(x)) largest = std::max(largest, std::abs(x));
  });
  return largest == 0 ? 0 : static_cast<int>(std::floor(std::log10(largest)));
}

std::string rounded_up(double x) {
  if (x == 0 || !std::isfinite(x)) return fmt::format("{}", x);
  const std::string text = fmt::format("{:.1e}", x);
  if (std::strtod(text.c_str(), nullptr) >= x) return text;
  // The shorter number is below: the next one of two figures is not. It is made of the figures, as a sum with x rounds.
  const int figures = 10 * (text[0] - '0') + (text[2] - '0') + 1;
  const int exponent = std::atoi(text.c_str() + text.find('e') + 1) + figures / 100;
  return fmt::format("{}.{}e{:+03d}", figures == 100 ? 1 : figures / 10, figures % 10, exponent);
}

std::string tolerance_text(const Tolerance& t) {
  std::string text = fmt::format("length {}, relative {}, angle {}", t.length, t.relative, t.angle);
  if (t.scale_min != 0 || std::isfinite(t.scale_max))
    text += fmt::format(", for numbers from {} to {}", t.scale_min, t.scale_max);
  return text;
}

namespace {

/// What the last bit of an input explains, "10 decisions that the last bit of an input would flip", and the rounding of an orientation; empty where that is nothing.
std::string explained_by_inputs(const Fitness& fitness) {
  const auto [lengths, angles, decisions] = fitness.last_bit;
  const auto count = [](std::uint64_t n, std::string_view one) {
    return fmt::format("{} {}{}", n, one, n == 1 ? "" : "s");
  };
  std::string text = lengths == 0 ? "" : count(lengths, "length");
  if (angles != 0) text += (text.empty() ? "" : " and ") + count(angles, "normal");
  if (!text.empty()) text += " that the last bit of an input would move as far";
  if (decisions != 0)
    text += (text.empty() ? "" : ", and ") + count(decisions, "decision") + " that the last bit of an input would flip";
  if (fitness.rounded != 0)
    text +=
        (text.empty() ? "" : ", and ") + count(fitness.rounded, "decision") + " within the rounding of an orientation";
  return text;
}

}  // namespace

std::vector<std::string> fitness_lines(std::string_view what, std::string_view scale, const Fitness& fitness) {
  std::vector<std::string> lines{fmt::format("{}: would pass with {}", what, options(fitness.all, scale))};
  if (fitness.never != 0)
    lines.back() +=
        fmt::format("; no tolerance allows {} more: an answer, a field or a number is missing", fitness.never);
  if (const std::string ignored = explained_by_inputs(fitness); !ignored.empty())
    lines.push_back(fmt::format("{}, ignoring {}: with {}", what, ignored, options(fitness.beyond_last_bit, scale)));
  return lines;
}

Fit fit_of(const Fitness& fitness) {
  if (fitness.answers == 0) return {"-", "-"};
  const double length = length_of(fitness.all, &Need::absolute);
  const double angle = of(fitness.all, Measure::angle).absolute.off;
  return {length == 0                             ? "."
          : is_said(fitness.all, &Need::absolute) ? rounded_up(length)
                                                  : std::string(kBeyond),
          angle == 0                     ? "."
          : angle > std::numbers::pi / 2 ? std::string(kBeyond)
                                         : rounded_up(angle)};
}

std::vector<InTheWay> in_the_way(const Fitness& fitness) {
  constexpr std::array<std::string_view, oracle::kMeasures.size()> kWhat{
      "a value or coordinate off by {}", "a normal off by {} radians",
      "a wrong decision, {} from where the answer changes"};
  constexpr std::array<std::string_view, oracle::kMeasures.size()> kShare{
      "a value or coordinate off by {} of its scale", "",
      "a wrong decision, {} of the reach from where the answer changes"};
  std::vector<InTheWay> all;
  if (!fitness.never_question.empty())
    all.push_back({"no answer, a field missing, or no number", fitness.never_question});
  for (const Measure measure : oracle::kMeasures) {
    const Need& need = of(fitness.all, measure);
    const auto add = [&](std::string_view what, const Largest& largest) {
      const auto is_same = [&](const InTheWay& other) { return other.question == largest.question; };
      // Where the scale is 0 no share of it helps: nothing that a number could tell.
      if (!largest.question.empty() && std::isfinite(largest.off) && std::none_of(all.begin(), all.end(), is_same))
        all.push_back({fmt::format(fmt::runtime(what), rounded_up(largest.off)), largest.question});
    };
    add(kWhat[place(measure)], need.absolute);
    add(kShare[place(measure)], need.relative);
  }
  return all;
}

bool is_everyday(const Query& query) {
  bool everyday = true;
  for_each_number_unnamed(query, [&](double x) {
    everyday = everyday && (x == 0 || (std::abs(x) >= kEverydayFrom && std::abs(x) <= kEverydayTo));
  });
  return everyday;
}

std::string fitness_json(std::string_view key, const Fitness& fitness) {
  std::string by_scale;
  for (const auto& [decade, most] : fitness.by_scale)
    by_scale += fmt::format("{}[{},{},{},{}]", by_scale.empty() ? "" : ",", decade, formats::number(most[0]),
                            formats::number(most[1]), formats::number(most[2]));
  return fmt::format(
      R"("{}":{{"answers":{},"never":{},"needs":{},"no_worse_than_last_bit":{{"length":{},"angle":{},"decision":{}}},"within_rounding":{},"needs_beyond_last_bit":{},"by_scale":[{}]}})",
      key, fitness.answers, fitness.never, needs_json(fitness.all), fitness.last_bit[0], fitness.last_bit[1],
      fitness.last_bit[2], fitness.rounded, needs_json(fitness.beyond_last_bit), by_scale);
}

}  // namespace contact::tool
