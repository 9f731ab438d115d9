// A callable of Python as an engine, held against the oracle.
#include "python/src/certify.hpp"

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>

#include "engines/protocol/result_columns.hpp"
#include "formats/visible.hpp"
#include "golden/dataset.hpp"
#include "golden/families.hpp"
#include "oracle/truth/default_environment.hpp"
#include "python/src/columns.hpp"
#include "python/src/lock.hpp"
#include "tool/reports/report.hpp"
#include "tool/run/determinism.hpp"
#include "tool/run/fresh.hpp"
#include "tool/run/parts.hpp"
#include "tool/run/printing.hpp"
#include "tool/run/process.hpp"
#include "tool/run/profiles.hpp"

namespace contact::python {
namespace {

using engines::EngineInfo;
using engines::Question;
using formats::InputError;
using formats::Node;
using nlohmann::json;
using tool::Source;

constexpr std::size_t kTogether = 1 << 16;  // questions in a call

/// A floating-point environment while it lives.
class Environment {
 public:
  explicit Environment(const std::fenv_t& environment) {
    std::fegetenv(&before_);
    std::fesetenv(&environment);
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;
  ~Environment() { std::fesetenv(&before_); }

 private:
  std::fenv_t before_;
};

/// Asks the callable, in its caller's floating-point environment, and keeps what it answered to the questions that it
/// was asked ahead of time.
class CallableEngine final : public engines::Engine {
 public:
  CallableEngine(py::function ask, const std::fenv_t& environment, std::string header, EngineInfo info)
      : Engine(std::move(info)), ask_(std::move(ask)), environment_(environment), header_(std::move(header)) {}
  ~CallableEngine() override {
    const WithLock python_lock;
    ask_ = py::function();
  }

  std::vector<Claim> answer(std::span<const Question> questions) override {
    std::vector<Claim> claims(questions.size());
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < questions.size(); ++i) {
      const auto kept = kept_.find(questions[i].id);
      if (kept != kept_.end())
        claims[i] = kept->second;
      else
        open.push_back(i);
    }
    // One pair a call.
    while (!open.empty()) {
      std::vector<std::size_t> alike;
      std::vector<std::size_t> other;
      for (const std::size_t i : open)
        (questions[i].query.pair == questions[open.front()].query.pair ? alike : other).push_back(i);
      std::vector<Question> asked;
      for (const std::size_t i : alike) asked.push_back(questions[i]);
      std::vector<Claim> answers = ask(asked);
      for (std::size_t k = 0; k < alike.size(); ++k) claims[alike[k]] = std::move(answers[k]);
      open = std::move(other);
    }
    return claims;
  }

  /// Asks all questions of a source that the engine serves, many at once.
  void ask_ahead(const Source& source) {
    std::vector<Question> block;
    const auto flush = [&] {
      std::vector<Claim> answers = ask(block);
      for (std::size_t i = 0; i < block.size(); ++i) kept_.insert_or_assign(block[i].id, std::move(answers[i]));
      block.clear();
    };
    const oracle::Declaration declared = info().declared_for(source.pair);
    RowCount rows(fmt::format("asked: {}/{}", name(source.pair), source.family), source.count);
    tool::for_each_question(source, [&](const Question& question) {
      rows.add();
      if (oracle::not_served(question.query, declared)) return;
      block.push_back(question);
      if (block.size() == kTogether) flush();
    });
    if (!block.empty()) flush();
  }
  void forget() { kept_.clear(); }

 private:
  /// Questions of one pair.
  std::vector<Claim> ask(std::span<const Question> questions) {
    const WithLock python_lock;
    const Pair pair = questions.front().query.pair;
    const Scalar scalar = info().declared.scalar;
    Query widest = zero_query(pair);
    for (const Question& question : questions) widen(widest, question.query);
    QuestionColumns columns(widest, scalar, questions.size());
    for (std::size_t i = 0; i < questions.size(); ++i) {
      columns.set(i, questions[i].query);
      columns.set_id(i, questions[i].id);
    }
    const auto answers =
        py::cast<py::dict>(call(py::make_tuple(std::string(name(pair)), std::string(name(scalar)), columns.arrays())));
    engines::ResultColumns found("answers", arrays_in_memory("answers", answers, header_));
    if (found.rows() != questions.size())
      throw InputError({"answers", 0}, "",
                       fmt::format("have {} rows, and {} questions were asked", found.rows(), questions.size()));
    {
      // What the columns claim is known when the first come; later ones may not claim less.
      const std::lock_guard lock(mutex_);
      if (!said_) {
        said_ = true;
        set_info(found.engine());
      }
    }
    std::vector<Claim> claims;
    claims.reserve(questions.size());
    for (std::size_t i = 0; i < questions.size(); ++i) claims.push_back(found.claim(i));
    return claims;
  }

  [[nodiscard]] py::object call(const py::tuple& arguments) const {
    const Environment of_the_caller(environment_);
    PyObject* answers = unless_python_ends([&] { return PyObject_CallObject(ask_.ptr(), arguments.ptr()); });
    if (answers == nullptr) throw py::error_already_set();
    return py::reinterpret_steal<py::object>(answers);
  }

  py::function ask_;
  std::fenv_t environment_;
  std::string header_;
  std::mutex mutex_;
  bool said_ = false;
  std::unordered_map<std::string, Claim> kept_;
};

/// What an engine declares.
EngineInfo info_of(const std::string& header) {
  const formats::Location where{"engine", 0};
  const json all = formats::parse_object(header, where);
  return engines::read_engine_info(Node(all, where), {});
}

std::vector<Source> sources_of(const std::string& text) {
  const formats::Location where{"sources", 0};
  const json all = json::parse(text);
  std::vector<Source> sources;
  for (const Node& one : Node(all, where).items()) {
    if (const auto dataset = one.find("dataset")) {
      const std::filesystem::path path = dataset->raw_text();
      const golden::DatasetHeader h = golden::dataset_header(path);
      sources.push_back({h.pair, h.scalar, h.family, h.count, path});
      continue;
    }
    const Pair pair = golden::read_pair(one.at("pair"));
    const std::string family = one.at("family").text();
    const golden::Family* generator = golden::find_family(pair, family);
    if (generator == nullptr) one.at("family").refuse(fmt::format("{} has no such generator", name(pair)));
    sources.push_back({pair, golden::read_scalar(one.at("scalar")), family, one.at("count").count(), std::nullopt,
                       generator, one.at("seed").count()});
  }
  return sources;
}

}  // namespace

py::dict certify(const py::function& ask, const std::string& engine, const std::string& sources_text,
                 const std::string& options) {
  std::fenv_t of_the_caller;
  std::fegetenv(&of_the_caller);
  const oracle::DefaultEnvironment environment;
  const formats::Location where{"options", 0};
  const json all = formats::parse_object(options, where);
  const Node o(all, where);
  o.allow_only({"level", "tolerance", "profile", "allow_unsupported", "check", "determinism", "within", "least_judged",
                "fresh"});
  std::vector<Source> sources = sources_of(sources_text);
  if (const auto fresh = o.find("fresh"))
    for (Source& source : tool::fresh_beside(sources, {fresh->at("each").count(), fresh->at("seed").count()}))
      sources.push_back(std::move(source));
  auto owned = std::make_unique<CallableEngine>(ask, of_the_caller, engine, info_of(engine));
  CallableEngine& callable = *owned;
  std::vector<tool::Subject> subjects;
  subjects.push_back({std::move(owned), {}});
  tool::Oracles oracles;
  if (const auto check = o.find("check")) oracles.check = static_cast<tool::Check>(check->one_of(tool::kCheckNames));
  std::vector<tool::Report> reports;
  {
    const WithoutLock no_lock;
    for (const Source& source : sources)
      if (tool::engine_takes(callable.info(), source.pair, source.scalar)) callable.ask_ahead(source);
    tool::Report& report = subjects.front().report;
    report.engine = callable.info();
    if (const auto level = o.find("level")) {
      report.required = static_cast<oracle::Level>(level->one_of(oracle::kLevelNames));
      report.engine.declared.tolerance.reset();
    }
    if (const auto tolerance = o.find("tolerance"))
      report.engine.declared.tolerance = engines::read_tolerance(*tolerance);
    if (const auto profile = o.find("profile"))
      report.engine.declared.tolerance = tool::kProfiles[profile->one_of(tool::kProfileNames)].tolerance;
    if (const auto allow = o.find("allow_unsupported")) report.allow_unsupported = allow->boolean();
    if (const auto within = o.find("within")) {
      report.within = within->number();
      if (!(*report.within >= 0 && std::isfinite(*report.within))) within->refuse("expected a finite length from 0");
    }
    if (const auto least = o.find("least_judged")) report.least_judged = least->count();
    report.fresh = tool::fresh_of(sources, false);
    tool::Stop stop;
    reports.push_back(report);
    merge(reports, judge_part(sources, subjects, stop, oracles), true);
    if (const auto again = o.find("determinism"); again && again->boolean()) {
      callable.forget();
      reports.front().repeats = tool::ask_again(tool::published_of(sources), callable, reports.front().engine, {});
    }
  }
  const tool::Report& report = reports.front();
  if (report.judged() == 0) {
    const std::vector<std::string> why = report.left_out();
    throw InputError(
        {"certify", 0}, "",
        fmt::format("no case was judged; {}", why.empty() ? "there is none" : fmt::format("{}", fmt::join(why, "; "))));
  }
  py::dict found;
  found["exit"] = static_cast<int>(report.harness_invalid() ? tool::kHarnessInvalid
                                   : report.certified()     ? tool::kCertified
                                                            : tool::kRefuted);
  found["json"] = formats::visible_json(json_text(report));
  found["html"] = html_text(reports);
  found["text"] = tool::guarded_text(terminal_text(report, false));
  found["junit"] = junit_text(report);
  found["markdown"] = markdown_text(report);
  return found;
}

bool is_within(const std::string& engine, const std::string& question, const std::string& answer) {
  const formats::Location of_question{"question", 0};
  const json asked = formats::parse_object(question, of_question);
  const Query query = golden::read_query(Node(asked, of_question)).query;
  const formats::Location of_answer{"answer", 0};
  const json said = formats::parse_object(answer, of_answer);
  const oracle::Declaration declared = info_of(engine).declared_for(query.pair);
  return oracle::judge(query, oracle::truth_of(query), engines::read_claim(Node(said, of_answer)), declared).within();
}

}  // namespace contact::python
