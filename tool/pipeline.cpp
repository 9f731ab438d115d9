// The pipeline: questions -> engines -> judge -> reports.
#include "tool/pipeline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "golden/query_id.hpp"
#include "tool/process.hpp"

namespace contact::tool {
namespace {

constexpr std::size_t kSlice = 32;  // questions that one thread takes at a time

struct Item {
  engines::Question question;
  std::optional<golden::Case> expected;
  golden::Location where;
};

/// Reads or makes the questions of a source, some at a time.
class Questions {
 public:
  explicit Questions(const Source& source) : source_(source) {
    if (!source.dataset || source.count == 0) return;
    reader_.emplace(*source.dataset);
    reader_->skip(source.first);
  }

  [[nodiscard]] std::vector<Item> next() {
    std::vector<Item> items;
    for (; items.size() < kRun && asked_ < source_.count; ++asked_) {
      if (reader_) {
        auto c = reader_->next();
        if (!c) break;
        items.push_back({{c->id, c->query}, std::move(c), reader_->where()});
      } else {
        const std::uint64_t index = source_.first + asked_;
        const Query query =
            golden::generate_query(source_.pair, *source_.generator, source_.scalar, source_.seed, index);
        items.push_back({{golden::query_id(query), query},
                         std::nullopt,
                         {fmt::format("{}, seed {}, index {}", source_.family, source_.seed, index), 0}});
      }
    }
    // Behind the last case the reader compares what it read with what the header says.
    if (items.empty() && reader_ && source_.first + asked_ == reader_->header().count) (void)reader_->next();
    return items;
  }

 private:
  const Source& source_;
  std::optional<golden::DatasetReader> reader_;
  std::uint64_t asked_ = 0;
};

/// What both oracles say of a question: exactly, and rounded to each scalar that matters.
struct Agreed {
  oracle::Truth truth;
  std::vector<std::pair<Scalar, Expectation>> rounded;

  [[nodiscard]] const Expectation* in(Scalar scalar) const {
    const auto it = std::find_if(rounded.begin(), rounded.end(), [&](const auto& r) { return r.first == scalar; });
    return it == rounded.end() ? nullptr : &it->second;
  }
};

Agreed agreed_truth(const Item& item, const Source& source, const std::vector<Scalar>& scalars) {
  const Query& query = item.question.query;
  oracle::Truth truth = oracle::truth_of(query);
  if (item.expected) golden::check_case(*item.expected, source.scalar, truth, item.where);
  Agreed agreed{std::move(truth), {}};
  for (const Scalar scalar : scalars) {
    oracle::RoundedAnswer second = oracle::interval_answer(query, scalar);
    require_agreement(query, agreed.truth, second, scalar);
    agreed.rounded.emplace_back(scalar, std::move(second.expected));
  }
  return agreed;
}

/// Whether every number other than 0 lies within the scale that an engine declares; NaN and infinities do not count.
bool within_scale(const Query& query, const Conventions& conventions) {
  bool within = true;
  for_each_number(query, [&](const std::string&, double x) {
    if (x != 0 && std::isfinite(x))
      within = within && std::abs(x) >= conventions.scale_min && std::abs(x) <= conventions.scale_max;
  });
  return within;
}

void judge_one(const Item& item, const std::optional<Agreed>& agreed, const Source& source, const Claim& claim,
               const Subject& subject, Findings& found) {
  const auto& [id, query] = item.question;
  const Report& report = subject.report;
  const Baseline* baseline = subject.baseline.get();
  const oracle::Declaration& declared = report.engine.declared;
  const oracle::Truth* truth = agreed ? &agreed->truth : nullptr;
  const Expectation* rounded = agreed ? agreed->in(declared.scalar) : nullptr;
  const Verdict verdict =
      agreed ? oracle::judge(query, *truth, claim, declared, rounded) : oracle::judge_outside_domain(claim);
  const Level level = verdict.level();
  found.families.front().add(verdict, id, truth != nullptr && truth->hit());
  const bool accepted = level > report.required && baseline != nullptr && baseline->accepts(id, level);
  // What is right speaks against a hypothesis as what is wrong speaks for one.
  if (truth != nullptr && !accepted) found.why.add(query, *truth, claim, declared, verdict, rounded);
  if (verdict.answered_outside_domain && !accepted) found.why.add_outside_domain(query);
  if (level <= report.required) {
    if (baseline != nullptr && baseline->lists(id)) found.gone.insert(id);
    return;
  }
  if (report.allow_unsupported && verdict.status == Claim::Status::unsupported) return;
  const WorstCase worst{query, source.scalar, verdict};
  found.add(Failure{id, query.pair, source.scalar, source.family, level, worst.what(), accepted});
  if (accepted)
    found.families.front().accept(level);
  else
    found.add(worst);
}

/// Why an engine's declaration excludes a whole source, or nothing.
std::optional<std::string> excluded(const Source& source, const golden::EngineInfo& engine) {
  if (!engine.serves(source.pair)) return fmt::format("the engine does not serve {}", name(source.pair));
  if (engine.declared.scalar == Scalar::binary32 && source.scalar == Scalar::binary64)
    return std::string("binary64 numbers, and the engine computes in binary32");
  return std::nullopt;
}

}  // namespace

void require_agreement(const Query& query, const oracle::Truth& truth, const oracle::RoundedAnswer& second,
                       Scalar scalar) {
  const auto differs = first_difference(oracle::expectation(truth, scalar), second.expected);
  if (differs || second.at_alarm != static_cast<int>(truth.at_alarm) ||
      second.at_zero != static_cast<int>(truth.at_zero))
    throw OracleFault(fmt::format("the exact oracle and the interval oracle differ in {} ({})\n{}",
                                  differs.value_or("the decision"), name(scalar), golden::query_line(query, scalar)));
}

void Stop::check() const {
  throw_if_interrupted();
  if (late()) throw TimeUp{};
}

void judge_source(const Source& source, std::vector<Subject>& subjects, Stop& stop) {
  std::vector<Subject*> judged;
  std::vector<Scalar> scalars{source.scalar};
  FamilyReport none;
  none.pair = source.pair;
  none.scalar = source.scalar;
  none.family = source.family;
  for (Subject& subject : subjects) {
    const golden::EngineInfo& engine = subject.engine->info();
    none.source = subject.report.sources++;
    if (const auto why = excluded(source, engine)) {
      const std::string what =
          source.dataset ? source.dataset->string() : fmt::format("{}/{}", name(source.pair), source.family);
      subject.report.skipped.push_back({what, *why, source.count, none.source});
      continue;
    }
    judged.push_back(&subject);
    subject.report.families.push_back(none);
    if (std::find(scalars.begin(), scalars.end(), engine.declared.scalar) == scalars.end())
      scalars.push_back(engine.declared.scalar);
  }
  Questions questions(source);
  Progress progress(fmt::format("{}/{}", name(source.pair), source.family), source.count);
  std::uint64_t reached = 0;
  while (stop.why.empty()) {
    const std::vector<Item> items = questions.next();
    if (items.empty()) break;
    throw_if_interrupted();
    const std::size_t slices = (items.size() + kSlice - 1) / kSlice;
    Findings nothing;
    nothing.families.push_back(none);
    std::vector<std::vector<Findings>> found(slices, std::vector<Findings>(judged.size(), nothing));
    // A slice that is not asked is not reached. The first that fails ends the run: those before it are all asked, and
    // what is found in those behind it is left out, so that the report does not depend on the threads.
    std::vector<char> asked_all(slices);
    std::atomic<std::size_t> failed = slices;  // the first slice that does
    const auto ask = [&](std::size_t slice) {
      const std::span<const Item> mine =
          std::span(items).subspan(slice * kSlice, std::min(kSlice, items.size() - slice * kSlice));
      std::vector<std::optional<Agreed>> truths;
      for (const Item& item : mine) {
        const bool outside = outside_domain(item.question.query).has_value();
        if (outside && item.expected) golden::check_rejection(*item.expected, item.where);
        truths.push_back(outside ? std::nullopt : std::optional(agreed_truth(item, source, scalars)));
      }
      for (std::size_t s = 0; s < judged.size(); ++s) {
        std::vector<engines::Question> asked;
        std::vector<std::size_t> which;
        for (std::size_t i = 0; i < mine.size(); ++i) {
          if (!within_scale(mine[i].question.query, judged[s]->report.engine.declared.conventions)) continue;
          asked.push_back(mine[i].question);
          which.push_back(i);
        }
        if (asked.size() < mine.size())
          found[slice][s].skipped.push_back({fmt::format("{}/{}", name(source.pair), source.family),
                                             "numbers outside the scale that the engine declares",
                                             mine.size() - asked.size(), none.source});
        const std::vector<Claim> claims = judged[s]->engine->answer(asked);
        for (std::size_t k = 0; k < asked.size(); ++k)
          judge_one(mine[which[k]], truths[which[k]], source, claims[k], *judged[s], found[slice][s]);
      }
      const auto is_new = [](const Failure& f) { return !f.accepted; };
      if (stop.at_first_failure && !judged.empty() && judged.front() == &subjects.front() &&
          std::any_of(found[slice][0].failures.begin(), found[slice][0].failures.end(), is_new))
        for (std::size_t before = failed; slice < before && !failed.compare_exchange_weak(before, slice);) {
        }
      asked_all[slice] = 1;
    };
    in_parallel(slices, [&](std::size_t slice) {
      if (slice > failed || stop.late()) return;
      try {
        ask(slice);
      } catch (const TimeUp&) {
      }
    });
    for (std::size_t i = 0; i < slices; ++i) {
      if (asked_all[i] == 0 || i > failed) continue;
      reached += std::min(kSlice, items.size() - i * kSlice);
      for (std::size_t s = 0; s < judged.size(); ++s) judged[s]->report.merge(found[i][s]);
    }
    if (failed < slices) stop.why = "the first failure ended the run";
    if (stop.late()) stop.why = "the time was up";
    progress.add(items.size());
  }
  for (Subject* subject : judged) {
    subject->report.unreached += source.count - reached;
    subject->report.families.back().add_unreached(source.count - reached);
    subject->report.stopped = stop.why;
  }
}

}  // namespace contact::tool
