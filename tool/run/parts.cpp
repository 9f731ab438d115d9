// A run cut into parts: judged anywhere, kept in files, merged to the report of the whole run.
#include "tool/run/parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <bitset>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>
#include <type_traits>

#include "engines/protocol/results.hpp"
#include "formats/output_file.hpp"
#include "formats/sha256.hpp"
#include "golden/query_id.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {
namespace {

/// Values one after another as bytes, written or read by the same calls. A damaged archive asks for no more memory than its bytes
/// are worth: entries are made as they come.
class Archive {
 public:
  Archive() = default;  ///< writes
  explicit Archive(const std::string& bytes) : bytes_(bytes), reads_(true) {}

  [[nodiscard]] bool reads() const { return reads_; }
  /// What was written, or is left to be read.
  [[nodiscard]] std::string rest() && { return std::move(bytes_).substr(at_); }

  template <class... Ts>
  void operator()(Ts&... values) {
    (pass(values), ...);
  }

 private:
  void pass_bytes(char* data, std::size_t count) {
    if (!reads_) {
      bytes_.append(data, count);
      return;
    }
    if (count > bytes_.size() - at_) throw std::runtime_error("it ends early");
    std::memcpy(data, bytes_.data() + at_, count);
    at_ += count;
  }
  [[nodiscard]] std::uint64_t pass_count(std::uint64_t count) {
    pass(count);
    return count;
  }

  template <class T>
  void pass(T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      auto image = std::bit_cast<std::array<char, sizeof(T)>>(value);
      if constexpr (std::endian::native == std::endian::big) std::reverse(image.begin(), image.end());
      pass_bytes(image.data(), image.size());
      if constexpr (std::endian::native == std::endian::big) std::reverse(image.begin(), image.end());
      value = std::bit_cast<T>(image);
    } else if constexpr (requires { value.serialize(*this); }) {
      value.serialize(*this);
    } else {
      serialize(*this, value);
    }
  }
  /// What is neither true nor false must not become a bool.
  void pass(bool& value) {
    auto byte = static_cast<std::uint8_t>(value);
    pass(byte);
    if (byte > 1) throw std::runtime_error("neither true nor false");
    value = byte == 1;
  }
  void pass(std::string& text) {
    const std::uint64_t size = pass_count(text.size());
    if (reads_ && size > bytes_.size() - at_) throw std::runtime_error("it ends early");
    text.resize(static_cast<std::size_t>(size));
    pass_bytes(text.data(), text.size());
  }
  template <class T>
  void pass(std::vector<T>& entries) {
    std::uint64_t left = pass_count(entries.size());
    if (!reads_)
      for (T& entry : entries) pass(entry);
    else
      for (entries.clear(); left > 0; --left) pass(entries.emplace_back());
  }
  template <class T, std::size_t N>
  void pass(std::array<T, N>& entries) {
    for (T& entry : entries) pass(entry);
  }
  template <class T>
  void pass(std::optional<T>& value) {
    bool is_there = value.has_value();
    pass(is_there);
    if (reads_) value = is_there ? std::optional<T>(std::in_place) : std::nullopt;
    if (is_there) pass(*value);
  }
  template <class Key, class T, class Less>
  void pass(std::map<Key, T, Less>& entries) {
    std::uint64_t left = pass_count(entries.size());
    if (!reads_)
      for (auto& [key, value] : entries) (*this)(const_cast<Key&>(key), value);  // which writing leaves as it is
    else
      for (entries.clear(); left > 0; --left) {
        Key key{};
        pass(key);
        pass(entries[std::move(key)]);
      }
  }
  template <class T, class Less>
  void pass(std::set<T, Less>& entries) {
    std::vector<T> all(entries.begin(), entries.end());
    pass(all);
    entries = std::set<T, Less>(all.begin(), all.end());
  }
  template <std::size_t N>
  void pass(std::bitset<N>& bits) {
    for (std::size_t at = 0; at < N; at += 8) {
      std::uint8_t byte = 0;
      for (std::size_t i = at; i < std::min(N, at + 8); ++i) byte |= static_cast<std::uint8_t>(bits[i] << (i - at));
      pass(byte);
      for (std::size_t i = at; i < std::min(N, at + 8); ++i) bits[i] = (byte >> (i - at) & 1) != 0;
    }
  }

  std::string bytes_;
  std::size_t at_ = 0;
  bool reads_ = false;
};

// How an archive walks through what others declare.

void serialize(Archive& archive, oracle::Off& off) { archive(off.most, off.relative, off.within); }
void serialize(Archive& archive, oracle::FieldVerdict& v) {
  archive(v.grade, v.error, v.off, v.needs, v.last_bit, v.too_many);
}
void serialize(Archive& archive, oracle::Verdict& v) {
  archive(v.status, v.text, v.overlap, v.contact, v.answered_outside_domain, v.refused_outside_domain, v.missing,
          v.overlap_expected, v.contact_expected, v.has_numbers, v.decision_last_bit, v.decision_rounded,
          v.no_number_beside, v.fields, v.off);
}
void serialize(Archive& archive, Largest& l) { archive(l.off, l.question); }
void serialize(Archive& archive, Need& n) { archive(n.absolute, n.relative); }
void serialize(Archive& archive, Fitness& f) {
  archive(f.all, f.beyond_last_bit, f.last_bit, f.rounded, f.answers, f.never, f.never_question, f.beyond, f.by_scale);
}
void serialize(Archive& archive, FieldCount& c) { archive(c.grades, c.worst, c.worst_id, c.errors); }
void serialize(Archive& archive, MarginBin& m) { archive(m.side, m.power); }
void serialize(Archive& archive, Decisions& d) { archive(d.claimed, d.wrong); }
void serialize(Archive& archive, Sides& s) { archive(s.hits, s.misses); }
void serialize(Archive& archive, FamilyReport& f) {
  archive(f.source, f.pair, f.scalar, f.family, f.cases, f.hits, f.missed_hits, f.false_hits, f.outside_domain,
          f.refused, f.not_finite, f.accepted, f.statuses, f.fields, f.decided, f.decisions, f.with_numbers,
          f.incomplete, f.missing, f.levels, f.accepted_levels, f.margins, f.fitness, f.everyday, f.fresh,
          f.farthest_false_hit, f.said, f.askable);
}
void serialize(Archive& archive, Skipped& s) { archive(s.what, s.why, s.cases, s.source, s.fresh); }

/// A question is made for its pair, so that the pair is looked at before the rest.
void refuse_unknown(Pair pair) {
  if (static_cast<std::size_t>(pair) >= kPairs.size()) throw std::runtime_error("no such pair");
}

/// Numbers and not text, as there may be a hundred thousand of them.
void serialize(Archive& archive, Failure& f) {
  archive(f.id, f.pair, f.scalar, f.family, f.level, f.what, f.accepted, f.fresh);
  if (archive.reads()) {
    refuse_unknown(f.pair);
    f.question = zero_query(f.pair);
  }
  for_each_value(*f.question, [&]<class Value>(Value& value) {
    if constexpr (AnyNumberOfVectors<Value>) {
      std::uint64_t count = value.size();
      archive(count);
      if (count > kMostVertices) throw std::runtime_error("more vertices than a hull has");
      value.resize(static_cast<std::size_t>(count));
    }
    for_each_number_in(value, [&](double& x) { archive(x); });
  });
}

void serialize(Archive& archive, WorstCase& w) {
  std::string query;
  std::string claim;
  if (!archive.reads()) {
    query = golden::query_line(w.query, w.scalar);
    claim = engines::to_line("", w.claim);
  }
  archive(query, w.query.pair, w.scalar, claim, w.verdict);
  if (!archive.reads()) return;
  refuse_unknown(w.query.pair);
  const formats::Location where{"a worst case", 0};
  const auto question = formats::parse_object(query, where);
  w.query = golden::read_inputs(formats::Node(question, where), w.query.pair);
  const auto answer = formats::parse_object(claim, where);
  w.claim = engines::read_claim(formats::Node(answer, where));
}
void serialize(Archive& archive, Findings& f) {
  archive(f.sources, f.families, f.skipped, f.worst, f.failures, f.failure_count, f.fresh_failures, f.gone, f.unreached,
          f.stopped, f.why);
}
void serialize(Archive& archive, Part& p) { archive(p.found, p.unasked); }

constexpr std::string_view kFormat = "contact-oracle/part";
constexpr std::uint64_t kVersion = 6;

// Whether what a part tells is of kinds that there are, which become indices into their names.

template <class Enumeration>
bool is_below(Enumeration value, std::size_t count) {
  return static_cast<std::size_t>(value) < count;
}

bool is_sound(const Verdict& verdict) {
  return is_below(verdict.status, std::tuple_size_v<decltype(FamilyReport::statuses)>) &&
         std::max(verdict.overlap, verdict.contact) <= oracle::Decision::false_hit &&
         std::min(verdict.overlap, verdict.contact) >= oracle::Decision::unclaimed &&
         std::all_of(verdict.fields.begin(), verdict.fields.end(),
                     [](const auto& field) { return !field || is_below(field->grade, oracle::kGradeNames.size()); });
}

bool is_sound(const Findings& found) {
  const auto pair_and_scalar = [](Pair pair, Scalar scalar) {
    return is_below(pair, kPairs.size()) && is_below(scalar, kScalars.size());
  };
  return found.why.is_sound() &&
         std::all_of(found.families.begin(), found.families.end(),
                     [&](const FamilyReport& f) { return pair_and_scalar(f.pair, f.scalar); }) &&
         std::all_of(found.worst.begin(), found.worst.end(),
                     [&](const WorstCase& w) { return is_below(w.scalar, kScalars.size()) && is_sound(w.verdict); }) &&
         std::all_of(found.failures.begin(), found.failures.end(), [&](const Failure& f) {
           return pair_and_scalar(f.pair, f.scalar) && is_below(f.level, oracle::kLevelNames.size());
         });
}

/// The texts of a part, which are those of datasets and engines.
void make_visible(Findings& found) {
  const auto show = [](auto&... texts) { ((texts = formats::visible(texts)), ...); };
  for (FamilyReport& f : found.families) show(f.family);
  for (Skipped& s : found.skipped) show(s.what, s.why);
  for (WorstCase& w : found.worst) show(w.verdict.text);
  for (Failure& f : found.failures) show(f.id, f.family, f.what);
}

std::string digest_of(golden::Shard part, const std::string& run, const std::string& bytes) {
  return formats::Sha256().add(fmt::format("{}/{}", part.index, part.of)).add(run).add(bytes).hex();
}

}  // namespace

std::string digest_of_file(const std::filesystem::path& path) {
  auto file = formats::open_to_read(path, true);
  formats::Sha256 hash;
  std::array<char, 1 << 16> buffer;
  while (file.read(buffer.data(), buffer.size()) || file.gcount() > 0) {
    hash.add({buffer.data(), static_cast<std::size_t>(file.gcount())});
    throw_if_interrupted();
  }
  if (file.bad()) throw formats::InputError({path.string(), 0}, "", "cannot read");
  return hash.hex();
}

std::vector<Source> cut(std::vector<Source> sources, golden::Shard part) {
  std::uint64_t all = 0;
  for (const Source& source : sources) all += source.count;
  const std::uint64_t begin = golden::cut(all, part.index, part.of);
  const std::uint64_t end = golden::cut(all, part.index + 1, part.of);
  std::uint64_t before = 0;
  for (Source& source : sources) {
    const std::uint64_t first = std::clamp(begin, before, before + source.count);
    const std::uint64_t last = std::clamp(end, before, before + source.count);
    before += source.count;
    source.whole = source.count;
    source.first += first - (before - source.count);
    source.count = last - first;
  }
  return sources;
}

Part judge_part(const std::vector<Source>& sources, std::vector<Subject>& subjects, Stop& stop, Oracles& oracles) {
  std::uint64_t run = 0;
  for (const Source& source : sources) run += source.size();
  for (const Source& source : sources) judge_source(source, subjects, stop, oracles, run);
  Part part;
  for (Subject& subject : subjects) {
    part.found.push_back(std::exchange(static_cast<Findings&>(subject.report), {}));
    part.unasked.push_back(subject.engine->unasked());
  }
  return part;
}

void merge(std::vector<Report>& reports, Part part, bool first) {
  for (std::size_t s = 0; s < reports.size(); ++s) {
    Report& report = reports[s];
    report.merge(part.found[s]);
    // An answer is unasked for where no part asked for it.
    std::vector<std::string>& unasked = part.unasked[s];
    if (!first)
      std::erase_if(unasked,
                    [before = std::set<std::string>(report.unknown_answers.begin(), report.unknown_answers.end())](
                        const std::string& id) { return !before.contains(id); });
    report.unknown_answers = std::move(unasked);
  }
}

std::string pack(Part part) {
  Archive archive;
  archive(part);
  return std::move(archive).rest();
}

Part unpack(const std::string& bytes) {
  Archive archive(bytes);
  Part part;
  archive(part);
  if (part.found.size() != part.unasked.size() ||
      !std::all_of(part.found.begin(), part.found.end(), [](const Findings& f) { return is_sound(f); }))
    throw std::runtime_error("it tells of what there is not");
  for (Findings& found : part.found) make_visible(found);
  if (!std::move(archive).rest().empty()) throw std::runtime_error("more than a part");
  return part;
}

std::string run_text(const std::vector<Source>& sources, const Report& report) {
  std::string list;
  for (const Source& s : sources)
    list += fmt::format(
        R"({}{{"pair":"{}","scalar":"{}","family":{},"count":{},{}{}}})", list.empty() ? "" : ",", name(s.pair),
        name(s.scalar), formats::json_string(s.family), s.count, s.fresh ? R"("fresh":true,)" : "",
        s.dataset ? fmt::format(R"("dataset":{},"sha256":"{}")", formats::json_string(s.dataset->string()),
                                digest_of_file(*s.dataset))
                  : fmt::format(R"("generator":{},"seed":{})", formats::json_string(golden::kGenerator), s.seed));
  std::string fresh;
  if (report.fresh) {
    std::string unmade;
    for (const std::string& family : report.fresh->unmade)
      unmade += (unmade.empty() ? "" : ",") + formats::json_string(family);
    fresh = fmt::format(R"(,"fresh":{{"each":{},"seed":{},"unmade":[{}],"none":{}}})", report.fresh->each,
                        report.fresh->seed, unmade, formats::json_string(report.fresh->none));
  }
  return fmt::format(
      R"({{{},"required":"{}","within":{},"least_judged":{},"allow_unsupported":{}{}{},"sources":[{}]}})",
      engines::engine_text(report.engine), name(report.required),
      report.within ? formats::number(*report.within) : "null", report.least_judged, report.allow_unsupported, fresh,
      report.accepted ? fmt::format(R"(,"baseline":{{"file":{},"accepts":{},"sha256":"{}"}})",
                                    formats::json_string(report.accepted->path), report.accepted->failures,
                                    digest_of_file(report.accepted->path))
                      : "",
      list);
}

std::filesystem::path part_name(golden::Shard part) { return fmt::format("part-{}-of-{}.part", part.index, part.of); }

void write_part(const std::filesystem::path& path, golden::Shard part, const std::string& run,
                const std::string& bytes) {
  formats::OutputFile file(path);
  file.write(fmt::format(R"({{"format":"{}","version":{},"part":[{},{}],"run":{},"bytes":{},"sha256":"{}"}})", kFormat,
                         kVersion, part.index, part.of, run, bytes.size(), digest_of(part, run, bytes)) +
             "\n");
  file.write(bytes);
  file.commit();
}

PartFile read_part(const std::filesystem::path& path) {
  auto stream = formats::open_to_read(path, true);
  formats::Location where{path.string(), 0};
  std::string line;
  if (!formats::read_line(stream, line, where, formats::kLargestText))
    throw formats::InputError(where, "", "empty: the file is truncated");
  const auto json = formats::parse_object(line, where);
  const formats::Node node(json, where);
  if (const formats::Node format = node.at("format"); format.text() != kFormat)
    format.refuse(fmt::format("expected \"{}\", what certify --parts writes", kFormat));
  if (const formats::Node version = node.at("version"); version.count() != kVersion)
    version.refuse(fmt::format("this program reads version {}", kVersion));
  node.allow_only({"format", "version", "part", "run", "bytes", "sha256"});
  const auto numbers = node.at("part").items();
  if (numbers.size() != 2 || numbers[0].count() >= numbers[1].count()) node.at("part").refuse("expected [I,N], I < N");
  PartFile file{path, {numbers[0].count(), numbers[1].count()}, "", {}};
  // The text itself, not what a parser would write again: it is compared, and part of the digest.
  const std::size_t begin = line.find(R"("run":)") + 6;
  const std::size_t end = line.rfind(R"(,"bytes":)");
  if (!json.at("run").is_object() || end == std::string::npos || end < begin)
    throw formats::InputError(where, "run", "expected what is judged, as this program writes it");
  file.run = line.substr(begin, end - begin);
  const std::string bytes = formats::read_rest(stream, where);
  if (const formats::Node size = node.at("bytes"); size.count() != bytes.size())
    size.refuse(fmt::format("{} bytes follow: the file is truncated or has grown", bytes.size()));
  const std::string digest = digest_of(file.part, file.run, bytes);
  if (const formats::Node sha256 = node.at("sha256"); sha256.text() != digest)
    sha256.refuse("the file is damaged: its digest is " + digest);
  try {
    file.content = unpack(bytes);
    if (file.content.found.size() != 1) throw std::runtime_error("not the findings of one engine");
  } catch (const formats::InputError&) {
    throw;
  } catch (const std::exception& error) {  // of the archive: cut short, or a size that no text can have
    throw formats::InputError(where, "", fmt::format("written by another build of this program ({})", error.what()));
  }
  return file;
}

void require_run(const PartFile& file, const std::string& run, const std::string& whose) {
  if (file.run == run) return;
  const auto here = nlohmann::json::parse(file.run);
  const auto there = nlohmann::json::parse(run);
  const auto differs = nlohmann::json::diff(here, there);
  const std::string field = differs.empty() ? "" : differs.front().at("path").get<std::string>();
  const nlohmann::json::json_pointer at(field);
  const auto text = [&](const nlohmann::json& of) { return of.contains(at) ? of.at(at).dump() : "nothing"; };
  throw formats::InputError({file.path.string(), 1}, "run" + field,
                            fmt::format("a part of another run: {} here, {} in {}", text(here), text(there), whose));
}

Report report_of(const PartFile& file) {
  const formats::Location where{file.path.string(), 1};
  const auto json = formats::parse_object(file.run, where);
  const formats::Node run(json, where);
  Report report;
  report.engine = engines::read_engine_info(
      run, {"required", "within", "least_judged", "allow_unsupported", "fresh", "baseline", "sources"});
  report.required = static_cast<Level>(run.at("required").one_of(oracle::kLevelNames));
  report.allow_unsupported = run.at("allow_unsupported").boolean();
  if (const formats::Node within = run.at("within"); !within.is_null()) report.within = within.number();
  report.least_judged = run.at("least_judged").count();
  if (const auto fresh = run.find("fresh")) {
    report.fresh = Fresh{fresh->at("each").count(), fresh->at("seed").count(), {}, fresh->at("none").text()};
    for (const formats::Node& family : fresh->at("unmade").items()) report.fresh->unmade.push_back(family.text());
  }
  if (const auto baseline = run.find("baseline"))
    report.accepted = Accepted{baseline->at("file").text(), baseline->at("accepts").count()};
  return report;
}

}  // namespace contact::tool
