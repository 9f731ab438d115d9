// Exams: questions without answers, made from a key that is used once.
#include "tool/run/exam.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "formats/json.hpp"
#include "formats/sha256.hpp"
#include "golden/columns.hpp"
#include "golden/query_id.hpp"
#include "tool/run/date.hpp"
#include "tool/run/process.hpp"
#include "tool/run/profiles.hpp"

namespace contact::tool {
namespace {

using formats::Node;

constexpr std::string_view kExamFormat = "contact-oracle/exam";
constexpr std::string_view kKeyFormat = "contact-oracle/exam-key";
constexpr std::size_t kDigits = 64;

bool is_digest(const std::string& text) {
  return text.size() == kDigits && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

std::string sources_text(const std::vector<Source>& sources) {
  std::string text;
  for (const Source& s : sources)
    text += fmt::format(R"({}{{"pair":"{}","scalar":"{}","family":"{}","count":{}}})", text.empty() ? "" : ",",
                        name(s.pair), name(s.scalar), s.family, s.count);
  return "[" + text + "]";
}

/// The version, of those from 1 to `last`.
std::uint64_t require_format(const Node& node, std::string_view format, std::uint64_t last) {
  if (const Node found = node.at("format"); found.text() != format)
    found.refuse(fmt::format("expected \"{}\"", format));
  const Node version = node.at("version");
  if (version.count() < 1 || version.count() > last)
    version.refuse(last == 1 ? "this program reads version 1"
                             : fmt::format("this program reads versions 1 to {}", last));
  return version.count();
}

std::vector<Source> read_sources(const Node& node, std::uint64_t seed) {
  std::vector<Source> sources;
  for (const Node& one : node.items()) {
    one.allow_only({"pair", "scalar", "family", "count"});
    const Pair pair = golden::read_pair(one.at("pair"));
    const std::string family = one.at("family").text();
    const golden::Family* generator = golden::find_family(pair, family);
    if (generator == nullptr) one.at("family").refuse("this program has no such generator");
    const std::uint64_t count = one.at("count").count();
    if (count == 0) one.at("count").refuse("a family without a question");
    sources.push_back({pair, golden::read_scalar(one.at("scalar")), family, count, std::nullopt, generator, seed});
  }
  if (sources.empty()) node.refuse("an exam has questions");
  return sources;
}

}  // namespace

std::string digest_at(const Node& node) {
  const std::string text = node.text();
  if (!is_digest(text)) node.refuse("expected 64 hexadecimal digits");
  return text;
}

namespace {

std::string profile_text(const std::string& profile) {
  return profile.empty() ? "null" : formats::json_string(profile);
}

}  // namespace

std::string commitment_of(const std::vector<Source>& sources, const ExamTerms& terms) {
  const std::string more = terms.commits_to_nothing_else
                               ? ""
                               : fmt::format(R"("issued":"{}","profile":{},"published":{},)", terms.issued,
                                             profile_text(terms.profile), terms.asked_for_line);
  return formats::Sha256()
      .add(fmt::format(R"({{{}"generator":{},"seed":{},"nonce":"{}","sources":{}}})", more,
                       formats::json_string(golden::kGenerator), sources.front().seed, terms.nonce,
                       sources_text(sources)))
      .hex();
}

namespace {

constexpr std::string_view kLineBegin = "contact-oracle exam: commitment ";
constexpr std::string_view kLineMiddle = " questions ";

}  // namespace

std::string published_line(const std::string& commitment, const std::string& questions) {
  return fmt::format("{}{}{}{}", kLineBegin, commitment, kLineMiddle, questions);
}

PublishedLine read_published_line(std::string_view line) {
  while (!line.empty() && (line.back() == '\n' || line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
  PublishedLine read;
  if (line.size() == kLineBegin.size() + kDigits + kLineMiddle.size() + kDigits)
    read = {std::string(line.substr(kLineBegin.size(), kDigits)), std::string(line.substr(line.size() - kDigits))};
  if (!is_digest(read.commitment) || !is_digest(read.questions) ||
      published_line(read.commitment, read.questions) != line)
    throw formats::InputError({"command line", 0}, "--commitment",
                              fmt::format("expected the line that `exam new --commit` printed, got '{}{}'",
                                          line.substr(0, 60), line.size() > 60 ? "..." : ""));
  return read;
}

HeldKey::HeldKey(const std::filesystem::path& path) {
  static_cast<void>(formats::open_to_read(path, true));
  // A key that another close has written meanwhile is another file under the same name.
  for (struct stat held{}, named{}; descriptor_ < 0 || held.st_ino != named.st_ino || held.st_dev != named.st_dev;) {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor_ < 0)
      throw formats::InputError({path.string(), 0}, "", fmt::format("cannot read: {}", std::strerror(errno)));
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      const std::string why = errno == EWOULDBLOCK ? "another `exam close` holds this key: an exam is closed once"
                                                   : fmt::format("cannot be held: {}", std::strerror(errno));
      ::close(descriptor_);
      throw formats::InputError({path.string(), 0}, "used", why);
    }
    if (::fstat(descriptor_, &held) != 0 || ::stat(path.c_str(), &named) != 0) named.st_ino = held.st_ino + 1;
  }
}

HeldKey::~HeldKey() { ::close(descriptor_); }

void for_each_exam_question(const std::vector<Source>& sources, const std::string& nonce, const VisitExam& visit) {
  // Digests and places are all that is kept: questions are made again where they are asked for.
  struct Place {
    formats::Sha256::Digest order;
    std::uint32_t source;
    std::uint64_t index;
  };
  std::vector<Place> places;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    std::uint64_t index = 0;
    for_each_question(sources[s], [&](const engines::Question& question) {
      places.push_back({formats::Sha256::digest_of(nonce + question.id), static_cast<std::uint32_t>(s), index++});
    });
  }
  std::stable_sort(places.begin(), places.end(), [](const Place& x, const Place& y) { return x.order < y.order; });
  const auto alike = [](const Place& x, const Place& y) { return x.order == y.order; };
  places.erase(std::unique(places.begin(), places.end(), alike), places.end());
  for (const Place& place : places) {
    throw_if_interrupted();
    const Source& source = sources[place.source];
    const Query query = golden::generate_query(source.pair, *source.generator, source.scalar, source.seed, place.index);
    visit({golden::query_id(query), query}, source.scalar);
  }
}

ExamDigest exam_digest(const std::vector<Source>& sources, const std::string& nonce) {
  ExamDigest found;
  formats::Sha256 hash;
  for_each_exam_question(sources, nonce, [&](const engines::Question& question, Scalar scalar) {
    hash.add(golden::query_line(question.query, scalar)).add("\n");
    ++found.count;
  });
  found.sha256 = hash.hex();
  return found;
}

ExamFile::ExamFile(const std::filesystem::path& path) : form_(formats::named_arrays_form(path)), file_(path) {}

void ExamFile::write(const ExamKey& key, const ExamDigest& questions) {
  const std::string commitment = commitment_of(key.sources, key.terms);
  if (!form_) {
    std::ofstream stream(file_.temporary(), std::ios::binary | std::ios::trunc);
    stream << fmt::format(
        "{{\"format\":\"{}\",\"version\":1,\"count\":{},\"questions\":\"{}\",\"commitment\":\"{}\"}}\n", kExamFormat,
        questions.count, questions.sha256, commitment);
    for_each_exam_question(key.sources, key.terms.nonce, [&](const engines::Question& question, Scalar scalar) {
      stream << golden::query_line(question.query, scalar) << '\n';
    });
    stream.close();
    if (!stream) file_.fail(std::strerror(errno));
    return;
  }
  std::vector<golden::PlacedQuestion> placed;
  placed.reserve(questions.count);
  for_each_exam_question(key.sources, key.terms.nonce, [&](const engines::Question& question, Scalar /*scalar*/) {
    placed.push_back({question.id, static_cast<std::uint32_t>(placed.size()), question.query});
  });
  const nlohmann::json header{{"format", kExamFormat},    {"version", 1},
                              {"count", questions.count}, {"questions", questions.sha256},
                              {"commitment", commitment}, {"scalar", name(key.sources.front().scalar)}};
  golden::write_questions(file_, *form_, header, placed);
}

std::string key_text(const ExamKey& key) {
  const std::string used =
      key.used_on.empty() ? "null" : fmt::format(R"({{"on":"{}","answers":"{}"}})", key.used_on, key.used_for);
  const ExamTerms& terms = key.terms;
  const bool is_first = terms.commits_to_nothing_else;
  return fmt::format(
      "{{\"format\":\"{}\",\"version\":{},\"issued\":\"{}\",\"profile\":{},{}\"generator\":{},\"seed\":{},\"nonce\":\"{"
      "}\","
      "\n\"sources\":{},\n\"questions\":\"{}\",\"commitment\":\"{}\",\n\"used\":{}}}\n",
      kKeyFormat, is_first ? 1 : 2, terms.issued, profile_text(terms.profile),
      is_first ? "" : fmt::format("\"published\":{},", terms.asked_for_line), formats::json_string(golden::kGenerator),
      key.sources.front().seed, terms.nonce, sources_text(key.sources), key.questions,
      commitment_of(key.sources, terms), used);
}

ExamKey read_key(const std::filesystem::path& path) {
  const formats::Location where{path.string(), 0};
  const auto json = formats::parse_object(formats::read_text(path), where);
  const Node node(json, where);
  ExamKey key;
  ExamTerms& terms = key.terms;
  const std::uint64_t version = require_format(node, kKeyFormat, 2);
  terms.commits_to_nothing_else = version == 1;
  std::vector<std::string_view> keys{"format", "version", "issued",    "profile",    "generator", "seed",
                                     "nonce",  "sources", "questions", "commitment", "used"};
  if (version == 2) keys.push_back("published");
  node.allow_only(keys);
  terms.issued = node.at("issued").text();
  if (!is_date(terms.issued)) node.at("issued").refuse("expected a day, YYYY-MM-DD");
  if (const Node profile = node.at("profile"); !profile.is_null())
    terms.profile = kProfileNames[profile.one_of(kProfileNames)];
  if (version == 2) terms.asked_for_line = node.at("published").boolean();
  if (const Node generator = node.at("generator"); generator.text() != golden::kGenerator)
    generator.refuse(fmt::format("this program is {}, and makes other questions", golden::kGenerator));
  terms.nonce = digest_at(node.at("nonce"));
  key.sources = read_sources(node.at("sources"), node.at("seed").count());
  key.questions = digest_at(node.at("questions"));
  if (const Node stated = node.at("commitment"); stated.text() != commitment_of(key.sources, terms))
    stated.refuse(terms.commits_to_nothing_else
                      ? "the key was changed: its seed, nonce and families are not what it commits to"
                      : "the key was changed: its day, profile, seed, nonce and families are not what it commits to");
  if (const ExamDigest made = exam_digest(key.sources, terms.nonce); made.sha256 != key.questions)
    node.at("questions").refuse(fmt::format("the key was changed: its questions have the digest {}", made.sha256));
  if (const Node used = node.at("used"); !used.is_null()) {
    used.allow_only({"on", "answers"});
    key.used_on = used.at("on").text();
    key.used_for = used.at("answers").text();
  }
  return key;
}

namespace {

/// Whether the questions that follow are those of the header, which stands at `header`.
void require_whole(const Exam& exam, std::uint64_t count, const std::string& found, const formats::Location& header) {
  if (exam.all.size() != count)
    throw formats::InputError(header, "count",
                              fmt::format("the header says {}, and {} follow", count, exam.all.size()));
  if (found != exam.questions)
    throw formats::InputError(
        header, "questions",
        fmt::format("the header says {}, and the questions that follow have {}: the exam was changed", exam.questions,
                    found));
}

Exam read_columns(const std::filesystem::path& path, formats::ArraysForm form) {
  const formats::Location where{path.string(), 0};
  golden::QuestionColumns columns = golden::read_questions(path, form);
  const Node node(columns.header, where);
  require_format(node, kExamFormat, 1);
  node.allow_only({"format", "version", "count", "questions", "commitment", "scalar"});
  Exam exam{digest_at(node.at("commitment")), digest_at(node.at("questions")), {}};
  const Scalar scalar = golden::read_scalar(node.at("scalar"));
  formats::Sha256 hash;
  for (golden::PlacedQuestion& one : columns.questions) {
    hash.add(golden::query_line(one.query, scalar)).add("\n");
    exam.all.push_back({{std::move(one.id), one.query}, scalar});
  }
  require_whole(exam, node.at("count").count(), hash.hex(), where);
  return exam;
}

}  // namespace

Exam read_exam(const std::filesystem::path& path) {
  if (const auto form = formats::arrays_form(path)) return read_columns(path, *form);
  std::ifstream stream = formats::open_to_read(path);
  formats::Location where{path.string(), 0};
  Exam exam;
  std::uint64_t count = 0;
  formats::Sha256 hash;
  for (std::string line; formats::read_line(stream, line, where);) {
    throw_if_interrupted();
    if (stream.eof()) throw formats::InputError(where, "", "the last line has no line feed: the file is truncated");
    const auto json = formats::parse_object(line, where);
    const Node node(json, where);
    if (where.line == 1) {
      require_format(node, kExamFormat, 1);
      node.allow_only({"format", "version", "count", "questions", "commitment"});
      count = node.at("count").count();
      exam.questions = digest_at(node.at("questions"));
      exam.commitment = digest_at(node.at("commitment"));
      continue;
    }
    const golden::ReadQuery read = golden::read_query(node);
    exam.all.push_back({{golden::query_id(read.query), read.query}, read.scalar});
    hash.add(line).add("\n");
  }
  if (where.line == 0) throw formats::InputError(where, "", "empty: an exam begins with its header");
  require_whole(exam, count, hash.hex(), {path.string(), 1});
  return exam;
}

}  // namespace contact::tool
