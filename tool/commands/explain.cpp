// explain: questions from a file, from a person, or by their id, and the exact answer to each.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>

#include "golden/agreement.hpp"
#include "golden/columns.hpp"
#include "golden/dataset.hpp"
#include "golden/dataset_writer.hpp"
#include "golden/query_id.hpp"
#include "golden/right_case.hpp"
#include "tool/commands/commands.hpp"
#include "tool/commands/json_output.hpp"
#include "tool/reports/explanation.hpp"
#include "tool/reports/gradients.hpp"
#include "tool/run/pipeline.hpp"
#include "tool/run/printing.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {
namespace {

constexpr std::size_t kFewestDigits = 4;  // of an id that is cut short: fewer are likelier a slip
constexpr std::size_t kShownIds = 5;

struct ExplainOptions {
  std::string input = "-";
  std::string in;
  std::string json;
  bool gradient = false;
};

/// Prints what the oracles say of one question after another.
class Explained {
 public:
  explicit Explained(const ExplainOptions& o) : json_(o.json), gradient_(o.gradient) {}

  void add(const Query& query, Scalar scalar) {
    if (const auto error = outside_domain(query)) {
      print(query, scalar,
            fmt::format("{} {}\n  outside the domain: {}: {}, got {}; an engine has to refuse it\n", name(query.pair),
                        golden::query_id(query), error->field, error->rule, formats::number(error->value)));
      return;
    }
    const oracle::Truth truth = oracle::truth_of(query);
    golden::require_agreement(query, oracle::rounded_answer(truth, scalar), oracle::interval_answer(query, scalar),
                              scalar);
    std::string said = json_.alone() ? "" : explanation(query, truth, scalar);
    if (gradient_ && !json_.alone()) said += gradient_text(query, truth);
    print(query, scalar, said, distance(truth, scalar), gradient_ && json_.wanted() ? gradient_json(query, truth) : "");
  }
  [[nodiscard]] bool any() const { return any_; }
  void commit() { json_.commit(); }

 private:
  void print(const Query& query, Scalar scalar, const std::string& said, std::optional<double> distance = {},
             const std::string& gradient = "") {
    if (json_.wanted()) {
      std::string line = golden::answer_line(golden::make_case(query, scalar));
      if (!gradient.empty()) line.insert(line.size() - 2, fmt::format(R"(,"gradient":{})", gradient));
      if (distance) {
        line.pop_back();
        line += fmt::format(R"(,"distance":{}}})", formats::number(*distance));
      }
      json_.write(line + "\n");
    }
    if (!json_.alone()) std::cout << (any_ ? "\n" : "") << said;
    any_ = true;
  }

  JsonOutput json_;
  bool gradient_;
  bool any_ = false;
};

void explain_lines(const ExplainOptions& o) {
  InputLines lines(o.input);
  std::optional<golden::DatasetHeader> header;
  Explained explained(o);
  std::uint64_t decimals = 0;
  while (lines.next()) {
    const auto parsed = formats::parse_object(lines.text(), lines.where());
    const formats::Node node(parsed, lines.where());
    if (node.find("format")) {  // a whole dataset: its header tells pair and scalar
      header = golden::read_header(node);
      continue;
    }
    const golden::ReadQuery read = golden::read_query(node, header ? &*header : nullptr);
    explained.add(read.query, read.scalar);
    decimals += read.decimals;
  }
  if (!explained.any()) throw formats::InputError(lines.where(), "", "no question given: expected JSON lines");
  explained.commit();
  say_decimals(decimals, "the questions");
}

bool begins_an_id(const std::string& text) {
  return text.size() >= kFewestDigits && text.size() <= golden::kIdLength &&
         text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

/// The questions whose id begins with some digits, each once in a scalar.
class Lookup {
 public:
  /// `no_file`: what is said first where nothing is found.
  Lookup(std::string digits, std::string no_file) : digits_(std::move(digits)), no_file_(std::move(no_file)) {}

  void add(const std::string& id, const Query& query, Scalar scalar, const std::string& where) {
    if (!id.starts_with(digits_)) return;
    ids_.insert(id);
    if (std::any_of(found_.begin(), found_.end(), [&](const Found& f) { return f.id == id && f.scalar == scalar; }))
      return;
    if (ids_.size() == 1) found_.push_back({id, query, scalar, where});
  }

  /// Looks into a report or a golden file, or every golden file below a folder.
  void look_into(const std::filesystem::path& path) {
    if (!std::filesystem::is_directory(path) && !golden::names_dataset(path)) {
      const SavedReport report = read_report(path);
      std::vector<Failure> failures = report.failures;
      failures.insert(failures.end(), report.fresh_failures.begin(), report.fresh_failures.end());
      for (const Failure& f : failures)
        if (f.question)
          add(f.id, *f.question, f.scalar,
              fmt::format("{}, failures of {}", path.string(), family_title(f.pair, f.family, f.scalar)));
        else if (f.id.starts_with(digits_))
          throw formats::InputError(
              {path.string(), 0}, "failures",
              fmt::format("lists {} without its question, as older versions did; without --in it is "
                          "looked for in the golden files",
                          f.id));
      if (report.failure_count != report.failures.size())
        beside_ = fmt::format("; it lists {} of {} failures", report.failures.size(), report.failure_count);
      return;
    }
    for (const auto& file : golden::dataset_files({path})) {
      if (!may_hold(file)) continue;
      golden::DatasetReader reader(file, golden::is_made);
      while (const auto c = reader.next()) {
        throw_if_interrupted();
        add(c->id, c->query, reader.header().scalar, reader.where().text());
      }
    }
  }

  /// False where no text in a file of JSON lines begins with the digits: most golden files need not be parsed.
  [[nodiscard]] bool may_hold(const std::filesystem::path& file) const {
    std::ifstream in(file, std::ios::binary);
    if (in.peek() != '{') return true;
    const std::string sought = '"' + digits_;
    const std::boyer_moore_horspool_searcher search(sought.begin(), sought.end());
    std::string bytes(std::size_t{1} << 20, '\0');
    for (std::size_t kept = 0; in.good();) {
      throw_if_interrupted();
      in.read(bytes.data() + kept, static_cast<std::streamsize>(bytes.size() - kept));
      const auto end = bytes.begin() + static_cast<std::ptrdiff_t>(kept) + in.gcount();
      if (std::search(bytes.begin(), end, search) != end) return true;
      const auto size = static_cast<std::size_t>(end - bytes.begin());
      if (std::memchr(bytes.data(), '\\', size) != nullptr) return true;  // a character may be written otherwise
      kept = std::min(size, sought.size() - 1);
      std::copy(end - static_cast<std::ptrdiff_t>(kept), end, bytes.begin());
    }
    return false;
  }

  /// Explains the one question that was found.
  void explain(const std::string& where, const ExplainOptions& o) const {
    if (ids_.empty())
      throw formats::InputError({where, 0}, "",
                                fmt::format("{}no question whose id begins with {}{}", no_file_, digits_, beside_));
    if (ids_.size() > 1)
      throw formats::InputError(
          {where, 0}, "",
          fmt::format(
              "{} questions have ids that begin with {}: {}{}", ids_.size(), digits_,
              fmt::join(ids_.begin(),
                        std::next(ids_.begin(), static_cast<std::ptrdiff_t>(std::min(kShownIds, ids_.size()))), ", "),
              ids_.size() > kShownIds ? ", ..." : ""));
    Explained explained(o);
    for (const Found& f : found_) {
      if (!is_quiet()) say_error("found in {}\n", f.where);
      explained.add(f.query, f.scalar);
    }
    explained.commit();
  }

 private:
  struct Found {
    std::string id;
    Query query;
    Scalar scalar;
    std::string where;
  };
  std::string digits_;
  std::string no_file_;
  std::string beside_;
  std::set<std::string> ids_;
  std::vector<Found> found_;  ///< of the first id
};

void explain(const ExplainOptions& o) {
  require_apart({o.json}, {o.input, o.in});
  const bool is_id = begins_an_id(o.input);
  if (!o.in.empty() && !is_id)
    throw formats::InputError(
        {"explain", 0}, "--in",
        fmt::format("is where an id is looked for: expected {} to {} hexadecimal digits, got '{}'", kFewestDigits,
                    golden::kIdLength, o.input));
  if (o.in.empty() && (!is_id || std::filesystem::exists(o.input))) return explain_lines(o);
  const std::string where = o.in.empty() ? golden_folder() : o.in;
  Lookup lookup(o.input, o.in.empty() ? fmt::format("no file '{}', and ", o.input) : "");
  lookup.look_into(where);
  lookup.explain(where, o);
}

}  // namespace

void add_explain(CLI::App& app, int& exit) {
  auto* command = app.add_subcommand("explain",
                                     "The exact answer to a question, in words and numbers\n"
                                     "Questions are JSON lines, or one is named by its id, which reports print.");
  auto o = std::make_shared<ExplainOptions>();
  command
      ->add_option("questions", o->input,
                   "A file of questions, - for standard input, or the id of a question: its first digits are enough")
      ->capture_default_str();
  command
      ->add_option("--in", o->in,
                   fmt::format("Where an id is looked for: a report of certify --json, a golden file or a folder of "
                               "them (default: {})",
                               kCommitted))
      ->type_name("FILE");
  command->add_flag(
      "--gradient", o->gradient,
      "Also the derivatives of value, normal and points by each number of both shapes, and why where there is none");
  add_json_option(*command, o->json, "One {\"id\",\"expect\",\"exact\"} line a question");
  command->callback([o, &exit] {
    explain(*o);
    exit = kCertified;
  });
}

}  // namespace contact::tool
