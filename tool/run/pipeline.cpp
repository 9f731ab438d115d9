// The pipeline: questions -> engines -> judge -> reports.
#include "tool/run/pipeline.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_pipeline.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <map>

#include "golden/agreement.hpp"
#include "golden/query_id.hpp"
#include "golden/right_case.hpp"
#include "oracle/judge/conditioning.hpp"
#include "oracle/truth/quick_witness.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {
namespace {

constexpr std::uint64_t kSlice = 32;          // questions that one thread takes at a time
constexpr std::uint64_t kLeastCompared = 16;  // right answers of a source that a diagnosis hears at least
// Right answers of a run that it hears: as many as wait for a wrong one, less one for each of 4096 sources, whose share is rounded up.
constexpr std::uint64_t kMostCompared = oracle::Diagnosis::kPostponed - 4096;

struct Item {
  const engines::Question& question;
  const golden::Case* expected;  ///< of a dataset
};

/// Some questions on their way: read one after another, asked and judged on any thread, merged one after another.
struct Slice {
  std::uint64_t first;                         ///< index of its first question in the whole source
  std::uint64_t count;                         ///< questions that it stands for
  std::unique_ptr<golden::CaseBlock> block{};  ///< of a dataset
  std::vector<engines::Question> questions{};  ///< read or generated where they are asked
  std::vector<golden::Case> cases{};           ///< of those that were read, as their keys and texts
  std::vector<golden::SeenIds::Key> keys{};
  std::vector<std::string> texts{};  ///< where the file says something of them
  bool with_texts = false;
  std::vector<Findings> found{};
  oracle::StageCounts decided{};
  std::uint64_t checked = 0;
  bool asked_all = false;
  bool failed = false;         ///< the first subject, where that ends the run
  std::exception_ptr error{};  ///< thrown when its turn comes, so that the first in order is what a run ends with

  [[nodiscard]] Item item(std::size_t i) const { return {questions[i], cases.empty() ? nullptr : &cases[i]}; }
  [[nodiscard]] formats::Location where(const Item& item) const { return block->where(item.question.index - first); }
};

/// Reads or counts the questions of a source, some at a time.
class Questions {
 public:
  explicit Questions(const Source& source, Check check = Check::sample, std::uint64_t slice = kSlice)
      : source_(source), slice_(slice) {
    if (!source.dataset || source.count == 0) return;
    reader_.emplace(*source.dataset, golden::is_made);
    with_texts_ = reader_->wants_texts() || (check == Check::all && reader_->has_digest_of_texts());
    reader_->skip(source.first);
  }

  /// The next slice; nothing behind the last question.
  [[nodiscard]] std::optional<Slice> next() {
    Slice slice{source_.first + asked_, 0};
    try {
      throw_if_interrupted();
      const std::uint64_t most = std::min(slice_, source_.count - asked_);
      if (!reader_) {
        slice.count = most;
      } else if (most != 0 || source_.first + asked_ == reader_->header().count) {
        // Behind the last case the reader compares what it read with what the header says.
        slice.block = reader_->next_block(most);
        if (slice.block) slice.count = slice.block->size();
        slice.with_texts = with_texts_;
      }
    } catch (...) {
      slice.error = std::current_exception();
      slice.count = std::max<std::uint64_t>(slice.count, 1);
    }
    asked_ += slice.count;
    if (slice.count == 0) return std::nullopt;
    return slice;
  }

  /// What only the whole file tells of the cases of a slice. To be called in their order, whoever reads them.
  void accept(const Slice& slice) {
    for (const auto& key : slice.keys) reader_->prefetch(key);
    for (std::size_t i = 0; i < slice.keys.size(); ++i)
      reader_->accept(slice.cases[i], slice.keys[i], slice.first + i, *slice.block, i,
                      with_texts_ ? slice.texts[i] : std::string_view());
  }
  void accepted_all() {
    if (reader_) reader_->accepted_all();
  }

 private:
  const Source& source_;
  std::uint64_t slice_;
  std::optional<golden::DatasetReader> reader_;
  bool with_texts_ = false;
  std::uint64_t asked_ = 0;
};

/// Of a small source every thread has some questions, of which one may take as long as all others; but an engine that is
/// asked through a pipe gets many at once.
std::uint64_t slice_for(const Source& source, const std::vector<Subject>& subjects) {
  const bool alone =
      std::all_of(subjects.begin(), subjects.end(), [](const Subject& s) { return s.engine->answers_each_alone(); });
  return alone ? std::clamp(source.count / 16, std::uint64_t{1}, kSlice) : kSlice;
}

/// Makes the questions of a slice: read, generated, or of a list.
void make_items(const Source& source, Slice& slice) {
  slice.questions.reserve(slice.count);
  if (slice.block) {
    slice.cases.reserve(slice.count);
    slice.keys.reserve(slice.count);
    for (std::uint64_t i = 0; i < slice.count; ++i) {
      const golden::Case& c = slice.cases.emplace_back(slice.block->read(i));
      slice.keys.emplace_back(c.id);
      if (slice.with_texts) slice.texts.push_back(slice.block->text(i, c));
      slice.questions.push_back({c.id, c.query, slice.first + i});
    }
    return;
  }
  for (std::uint64_t index = slice.first; index < slice.first + slice.count; ++index) {
    const Query query = source.listed
                            ? source.listed->at(index)
                            : golden::generate_query(source.pair, *source.generator, source.scalar, source.seed, index);
    slice.questions.push_back({golden::query_id(query), query, index});
  }
}

/// What the oracles say of a question, in one scalar.
struct Rounded {
  Scalar scalar;
  Expectation expected;
  std::optional<MarginBin> margin;  ///< of spheres
};

/// The same exactly, and in each scalar that matters.
struct Agreed {
  oracle::Truth truth;
  std::vector<Rounded> rounded;
  mutable oracle::LastBits last_bits = {};  ///< found where an engine is first judged by them

  [[nodiscard]] const Rounded& in(Scalar scalar) const {
    return *std::find_if(rounded.begin(), rounded.end(), [&](const Rounded& r) { return r.scalar == scalar; });
  }
};

std::optional<MarginBin> margin_of(const oracle::StagedAnswer& staged, Scalar scalar) {
  if (!staged.truth.has_distance()) return std::nullopt;
  const int side = static_cast<int>(staged.truth.at_alarm);
  if (side == 0) return MarginBin{};
  const std::optional<double> size = staged.margin.of_its_size();
  return MarginBin{side, power_of(size ? *size : oracle::margin_ulps(staged.truth, scalar))};
}

/// The exact truth of a question, made where it is first asked for.
class ExactOnce {
 public:
  explicit ExactOnce(const Query& query) : query_(query) {}
  const oracle::Truth& beside(const oracle::StagedAnswer& staged) {
    if (staged.stage == oracle::Stage::exact) return staged.truth;
    if (!truth_) truth_.emplace(query_);
    return *truth_;
  }

 private:
  const Query& query_;
  std::optional<oracle::Truth> truth_;
};

/// A dataset's case against the stages; what they do not confirm is for the exact oracle to word. Exact texts that no stage makes are compared
/// where the question is checked, and where the first stage did not answer.
void check_expectation(const Item& item, const oracle::StagedAnswer& staged, Scalar scalar, bool is_checked,
                       ExactOnce& exact, const Slice& slice) {
  const Query& query = item.question.query;
  const std::optional<double> margin = staged.margin.rounded();
  if (margin || !query.has_distance()) {
    std::optional<oracle::Witness> witness = oracle::quick_witness(query);
    if (!witness && (is_checked || staged.stage != oracle::Stage::double_double))
      witness = oracle::witness(exact.beside(staged), scalar);
    if (!witness) witness = item.expected->exact;
    witness->margin_ulps = margin.value_or(0);
    if (golden::says(*item.expected, staged.expected, *witness)) return;
  }
  golden::check_case(*item.expected, scalar, exact.beside(staged), slice.where(item));
  // The exact oracle bears the file out: then so must the stage. Of what is checked the caller asks that.
  if (!is_checked && staged.stage != oracle::Stage::exact)
    golden::check_stage(query, exact.beside(staged), staged, scalar);
}

Agreed agreed_truth(const Item& item, const Source& source, const std::vector<Scalar>& scalars, Check check,
                    Slice& slice) {
  const Query& query = item.question.query;
  ExactOnce exact(query);
  std::optional<Agreed> agreed;
  for (const Scalar scalar : scalars) {
    oracle::StagedAnswer staged = oracle::staged_answer(query, scalar);
    slice.decided.add(staged.stage);
    const bool checked = is_checked(check, source.fresh ? kWhole + 1 : source.size(), item.question.id, staged.stage);
    if (item.expected && scalar == source.scalar) check_expectation(item, staged, scalar, checked, exact, slice);
    if (checked) {
      golden::check_stage(query, exact.beside(staged), staged, scalar);
      ++slice.checked;
    }
    const std::optional<MarginBin> margin = margin_of(staged, scalar);
    // What is checked is the exact truth: its numbers are there already.
    if (!agreed) agreed.emplace(Agreed{checked ? exact.beside(staged) : std::move(staged.truth), {}});
    agreed->rounded.push_back({scalar, std::move(staged.expected), margin});
  }
  return *std::move(agreed);
}

/// How much an answer counts in the diagnosis. What is wrong always counts. Of a large source, and in a large run,
/// every n-th right answer speaks for n: what a hypothesis says of it costs more than all the rest.
std::uint64_t weight_of(std::uint64_t index, std::uint64_t size, std::uint64_t run, Level level) {
  const std::uint64_t of_run = (run + kMostCompared - 1) / kMostCompared;
  const std::uint64_t n = std::max({std::uint64_t{1}, size / kWhole, std::min(of_run, size / kLeastCompared)});
  if (level > Level::bounded) return 1;
  return index % n == 0 ? n : 0;
}

void judge_one(const Item& item, const std::optional<Agreed>& agreed, const Source& source, const Claim& claim,
               const Subject& subject, const oracle::Declaration& declared, std::uint64_t run, Findings& found) {
  const auto& [id, query, index] = item.question;
  const Report& report = subject.report;
  const Baseline* baseline = subject.baseline.get();
  const oracle::Truth* truth = agreed ? &agreed->truth : nullptr;
  const Rounded* in_scalar = agreed ? &agreed->in(declared.scalar) : nullptr;
  const Expectation* rounded = agreed ? &in_scalar->expected : nullptr;
  Verdict verdict =
      agreed ? oracle::judge(query, *truth, claim, declared, rounded) : oracle::judge_outside_domain(claim);
  if (agreed) oracle::mark_last_bit(query, *truth, declared, verdict, agreed->last_bits);
  const Level level = report.level_of(verdict);
  // An engine that knows no alarm distance decides at another margin.
  const bool decides_there = declared.conventions.margin != Margin::none || query.distances.alarm == 0;
  found.families.front().add(verdict, level, id, truth != nullptr && truth->hit(),
                             agreed && decides_there ? in_scalar->margin : std::nullopt);
  found.families.front().add_fitness(verdict, query);
  const bool fails = report.fails(verdict);
  const bool accepted = fails && baseline != nullptr && baseline->accepts(id, level);
  // What is right speaks against a hypothesis as what is wrong speaks for one.
  if (truth != nullptr && !accepted)
    found.why.add(golden::id_digits(id, 0, 16), query, *truth, claim, declared, verdict, rounded,
                  weight_of(index, source.size(), run, level));
  if (verdict.answered_outside_domain && !accepted) found.why.add_outside_domain(query);
  if (!fails) {
    if (baseline != nullptr && baseline->lists(id)) found.gone.insert(id);
    return;
  }
  if (report.allow_unsupported && verdict.status == Claim::Status::unsupported) return;
  const WorstCase worst{query, source.scalar, claim, verdict};
  found.add(Failure{id, query.pair, source.scalar, source.family, level, worst.what(), accepted, "", "", query,
                    source.fresh});
  if (accepted)
    found.families.front().accept(level);
  else
    found.add(worst);
}

/// Why an engine's declaration excludes a whole source, or nothing.
std::optional<std::string> excluded(Pair pair, Scalar scalar, const engines::EngineInfo& engine) {
  if (!engine.serves(pair)) return fmt::format("the engine does not serve {}", name(pair));
  if (engine.declared.scalar == Scalar::binary32 && scalar == Scalar::binary64)
    return std::string("binary64 numbers, and the engine computes in binary32");
  return std::nullopt;
}

}  // namespace

void for_each_question(const Source& source, const std::function<void(const engines::Question&)>& visit) {
  Questions questions(source);
  while (auto slice = questions.next()) {
    if (slice->error) std::rethrow_exception(slice->error);
    make_items(source, *slice);
    questions.accept(*slice);
    for (const engines::Question& question : slice->questions) visit(question);
  }
  questions.accepted_all();
}

bool engine_takes(const engines::EngineInfo& engine, Pair pair, Scalar scalar) {
  return !excluded(pair, scalar, engine);
}

bool is_checked(Check check, std::uint64_t size, const std::string& id, oracle::Stage stage) {
  if (check == Check::all || size <= kWhole) return true;
  return golden::id_digits(id, 0, 4) % (stage == oracle::Stage::double_double ? kOneIn : kHardOneIn) == 0;
}

void Stop::check() const {
  throw_if_interrupted();
  if (late()) throw TimeUp{};
}

namespace {

/// A source on its way through the subjects that it concerns. Slices come to be merged in the order in which they were
/// read, and the first that fails ends the run: those before it are all asked, and what is found in those behind it is
/// left out, so that nothing depends on the threads.
class Judging {
 public:
  Judging(const Source& source, std::vector<Subject>& subjects, Stop& stop, Oracles& oracles, std::uint64_t run)
      : source_(source),
        stop_(stop),
        oracles_(oracles),
        run_(run),
        questions_(source, oracles.check, slice_for(source, subjects)) {
    none_.pair = source.pair;
    none_.scalar = source.scalar;
    none_.family = source.family;
    none_.fresh = source.fresh;
    for (Subject& subject : subjects) take(subject);
    compared_at_once_ = std::vector<std::atomic<bool>>(judged_.size());
    for (std::size_t s = 0; s < judged_.size(); ++s) compared_at_once_[s] = judged_[s]->report.why.compares_at_once();
    first_ends_the_run_ = stop.at_first_failure && !judged_.empty() && judged_.front() == &subjects.front();
  }

  void judge_all() {
    // A few slices a thread, so that reading goes on while others are asked.
    const std::size_t on_their_way =
        4 * tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    using Way = std::shared_ptr<Slice>;
    tbb::parallel_pipeline(
        on_their_way,
        tbb::make_filter<void, Way>(tbb::filter_mode::serial_in_order, [&](tbb::flow_control& flow) {
          Way slice = read();
          if (!slice) flow.stop();
          return slice;
        }) & tbb::make_filter<Way, Way>(tbb::filter_mode::parallel, [&](Way slice) {
          judge(*slice);
          return slice;
        }) & tbb::make_filter<Way, void>(tbb::filter_mode::serial_in_order, [&](const Way& slice) { merge(*slice); }));
    if (error_) std::rethrow_exception(error_);
    if (stop_.why.empty()) questions_.accepted_all();
    if (stop_.late() && stop_.why.empty()) stop_.why = "the time was up";
    for (Subject* subject : judged_) {
      subject->report.unreached += source_.count - reached_;
      subject->report.families.back().add_unreached(source_.count - reached_);
      subject->report.stopped = stop_.why;
    }
  }

 private:
  /// A subject is judged, or passes the whole source over.
  void take(Subject& subject) {
    const engines::EngineInfo& engine = subject.engine->info();
    none_.source = subject.report.sources++;
    if (const auto why = excluded(source_.pair, source_.scalar, engine)) {
      const std::string what = source_.dataset ? formats::visible(source_.dataset->string()) : title();
      subject.report.skipped.push_back({what, *why, source_.count, none_.source, source_.fresh});
      return;
    }
    judged_.push_back(&subject);
    subject.report.families.push_back(none_);
    if (std::find(scalars_.begin(), scalars_.end(), engine.declared.scalar) == scalars_.end())
      scalars_.push_back(engine.declared.scalar);
  }
  [[nodiscard]] std::string title() const { return fmt::format("{}/{}", name(source_.pair), source_.family); }

  /// The next slice; nothing behind the last, or where no more are wanted.
  std::shared_ptr<Slice> read() {
    auto slice = all_read_ || over_ ? std::nullopt : questions_.next();
    if (!slice) return nullptr;
    all_read_ = slice->error != nullptr;
    return std::make_shared<Slice>(*std::move(slice));
  }

  void judge(Slice& slice) {
    if (slice.error || over_ || stop_.late()) return;
    try {
      throw_if_interrupted();
      ask(slice);
    } catch (const TimeUp&) {
    } catch (...) {
      slice.error = std::current_exception();
    }
  }

  void ask(Slice& slice) {
    make_items(source_, slice);
    Findings nothing;
    nothing.families.push_back(none_);
    slice.found.assign(judged_.size(), nothing);
    const std::vector<std::optional<Agreed>> truths = truths_of(slice);
    for (std::size_t s = 0; s < judged_.size(); ++s) ask_subject(*judged_[s], slice, truths, slice.found[s], s);
    const auto is_new = [](const Failure& f) { return !f.accepted; };
    slice.failed =
        first_ends_the_run_ && std::any_of(slice.found[0].failures.begin(), slice.found[0].failures.end(), is_new);
    slice.asked_all = true;
  }

  /// What is true of each question; nothing of those outside the domain.
  std::vector<std::optional<Agreed>> truths_of(Slice& slice) {
    std::vector<std::optional<Agreed>> truths;
    truths.reserve(slice.questions.size());
    for (std::size_t i = 0; i < slice.questions.size(); ++i) {
      const Item item = slice.item(i);
      const bool outside = !inside_domain(item.question.query);
      if (outside && item.expected) golden::check_rejection(*item.expected, slice.where(item));
      truths.push_back(outside ? std::nullopt
                               : std::optional(agreed_truth(item, source_, scalars_, oracles_.check, slice)));
    }
    return truths;
  }

  void ask_subject(Subject& subject, const Slice& slice, const std::vector<std::optional<Agreed>>& truths,
                   Findings& found, std::size_t which) {
    if (compared_at_once_[which]) found.why.compare_at_once();
    const oracle::Declaration declared = subject.report.engine.declared_for(source_.pair);
    std::vector<std::size_t> served;
    std::map<std::string_view, std::uint64_t> left_out;
    for (std::size_t i = 0; i < slice.questions.size(); ++i) {
      if (truths[i]) found.families.front().askable.add(truths[i]->truth.hit());
      if (const auto why = oracle::not_served(slice.questions[i].query, declared)) {
        ++left_out[*why];
        subject.engine->pass_over(slice.questions[i]);
      } else {
        served.push_back(i);
      }
    }
    for (const auto& [why, count] : left_out)
      found.skipped.push_back({title(), std::string(why), count, none_.source, source_.fresh});
    const bool all = served.size() == slice.questions.size();
    std::vector<engines::Question> asked;
    if (!all)
      for (const std::size_t i : served) asked.push_back(slice.questions[i]);
    const std::vector<Claim> claims = subject.engine->answer(all ? slice.questions : asked);
    for (std::size_t k = 0; k < served.size(); ++k)
      judge_one(slice.item(served[k]), truths[served[k]], source_, claims[k], subject, declared, run_, found);
  }

  void merge(Slice& slice) {
    if (error_ || !stop_.why.empty()) return;
    try {
      questions_.accept(slice);
    } catch (...) {
      slice.error = std::current_exception();
    }
    if (slice.error) {
      error_ = slice.error;
      over_ = true;
      return;
    }
    progress_.add(slice.count);
    if (!slice.asked_all) return;
    reached_ += slice.count;
    for (std::size_t s = 0; s < judged_.size(); ++s) {
      judged_[s]->report.merge(slice.found[s]);
      compared_at_once_[s] = judged_[s]->report.why.compares_at_once();
    }
    oracles_.decided.merge(slice.decided);
    oracles_.checked += slice.checked;
    if (slice.failed) stop_.why = "the first failure ended the run";
    if (stop_.late()) stop_.why = "the time was up";
    if (!stop_.why.empty()) over_ = true;
  }

  const Source& source_;
  Stop& stop_;
  Oracles& oracles_;
  std::uint64_t run_;
  Questions questions_;
  Progress progress_{title(), source_.count};
  FamilyReport none_;  ///< a report of this source in which nothing is judged yet
  std::vector<Subject*> judged_;
  std::vector<Scalar> scalars_{source_.scalar};
  /// Whether right answers are compared with the causes where they are judged: on any thread, not where all are merged.
  std::vector<std::atomic<bool>> compared_at_once_;
  bool first_ends_the_run_ = false;
  bool all_read_ = !stop_.why.empty();
  std::atomic<bool> over_ = false;  ///< nothing more is merged
  std::uint64_t reached_ = 0;
  std::exception_ptr error_;  ///< thrown behind the pipeline, which loses what is on its way when one is thrown in it
};

}  // namespace

void judge_source(const Source& source, std::vector<Subject>& subjects, Stop& stop, Oracles& oracles,
                  std::uint64_t run) {
  Judging(source, subjects, stop, oracles, run).judge_all();
}

}  // namespace contact::tool
