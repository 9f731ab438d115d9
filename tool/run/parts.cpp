// A run cut into parts: judged anywhere, kept in files, merged to the report of the whole run.
#include "tool/run/parts.hpp"
#include "formats/sha256.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cereal/archives/portable_binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/bitset.hpp>
#include <cereal/types/map.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/set.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "engines/protocol/results.hpp"
#include "formats/output_file.hpp"
#include "golden/query_id.hpp"
#include "tool/run/process.hpp"

// Cereal's own readers of text and vectors make room for as many entries as a file states. These make it as entries
// come, so that a file asks for no more memory than it has bytes for.
namespace cereal {

template <class Archive>
void save(Archive& archive, const std::string& text) {
  archive(make_size_tag(static_cast<size_type>(text.size())), binary_data(text.data(), text.size()));
}

template <class Archive>
void load(Archive& archive, std::string& text) {
  size_type left = 0;
  archive(make_size_tag(left));
  text.clear();
  while (left > 0) {
    const auto now = static_cast<std::size_t>(std::min<size_type>(left, 1 << 16));
    text.resize(text.size() + now);
    archive(binary_data(text.data() + text.size() - now, now));
    left -= now;
  }
}

template <class Archive, class T>
void save(Archive& archive, const std::vector<T>& entries) {
  archive(make_size_tag(static_cast<size_type>(entries.size())));
  for (const T& entry : entries) archive(entry);
}

template <class Archive, class T>
void load(Archive& archive, std::vector<T>& entries) {
  size_type left = 0;
  archive(make_size_tag(left));
  for (entries.clear(); left > 0; --left) archive(entries.emplace_back());
}

/// What is neither true nor false must not become a bool.
inline void load(PortableBinaryInputArchive& archive, bool& value) {
  std::uint8_t byte = 0;
  archive(byte);
  if (byte > 1) throw Exception("neither true nor false");
  value = byte == 1;
}

}  // namespace cereal

// How Cereal walks through what others declare.
namespace contact::oracle {

template <class Archive>
void serialize(Archive& archive, Off& off) {
  archive(off.most, off.relative, off.within);
}

template <class Archive>
void serialize(Archive& archive, FieldVerdict& v) {
  archive(v.grade, v.error, v.off, v.needs, v.last_bit, v.too_many);
}

template <class Archive>
void serialize(Archive& archive, Verdict& v) {
  archive(v.status, v.text, v.overlap, v.contact, v.answered_outside_domain, v.refused_outside_domain, v.missing,
          v.overlap_expected, v.contact_expected, v.has_numbers, v.decision_last_bit, v.decision_rounded,
          v.no_number_beside, v.fields, v.off);
}

}  // namespace contact::oracle

namespace contact::tool {

template <class Archive>
void serialize(Archive& archive, Largest& l) {
  archive(l.off, l.question);
}

template <class Archive>
void serialize(Archive& archive, Need& n) {
  archive(n.absolute, n.relative);
}

template <class Archive>
void serialize(Archive& archive, Fitness& f) {
  archive(f.all, f.beyond_last_bit, f.last_bit, f.rounded, f.answers, f.never, f.never_question, f.beyond, f.by_scale);
}

template <class Archive>
void serialize(Archive& archive, FieldCount& c) {
  archive(c.grades, c.worst, c.worst_id, c.errors);
}

template <class Archive>
void serialize(Archive& archive, MarginBin& m) {
  archive(m.side, m.power);
}

template <class Archive>
void serialize(Archive& archive, Decisions& d) {
  archive(d.claimed, d.wrong);
}

template <class Archive>
void serialize(Archive& archive, Sides& s) {
  archive(s.hits, s.misses);
}

template <class Archive>
void serialize(Archive& archive, FamilyReport& f) {
  archive(f.source, f.pair, f.scalar, f.family, f.cases, f.hits, f.missed_hits, f.false_hits, f.outside_domain,
          f.refused, f.not_finite, f.accepted, f.statuses, f.fields, f.decided, f.decisions, f.with_numbers,
          f.incomplete, f.missing, f.levels, f.accepted_levels, f.margins, f.fitness, f.everyday, f.fresh,
          f.farthest_false_hit, f.said, f.askable);
}

template <class Archive>
void serialize(Archive& archive, Skipped& s) {
  archive(s.what, s.why, s.cases, s.source, s.fresh);
}

/// A question is made for its pair, so that the pair is looked at before the rest.
inline void refuse_unknown(Pair pair) {
  if (static_cast<std::size_t>(pair) >= kPairs.size()) throw cereal::Exception("no such pair");
}

/// Numbers and not text, as there may be a hundred thousand of them.
template <class Archive>
void save(Archive& archive, const Failure& f) {
  archive(f.id, f.pair, f.scalar, f.family, f.level, f.what, f.accepted, f.fresh);
  for_each_number(*f.question, [&](const std::string&, double x) { archive(x); });
}

template <class Archive>
void load(Archive& archive, Failure& f) {
  archive(f.id, f.pair, f.scalar, f.family, f.level, f.what, f.accepted, f.fresh);
  refuse_unknown(f.pair);
  f.question = zero_query(f.pair);
  for_each_number(*f.question, [&](const std::string&, double& x) { archive(x); });
}

template <class Archive>
void save(Archive& archive, const WorstCase& w) {
  archive(golden::query_line(w.query, w.scalar), w.query.pair, w.scalar, engines::to_line("", w.claim), w.verdict);
}

template <class Archive>
void load(Archive& archive, WorstCase& w) {
  std::string query;
  std::string claim;
  Pair pair{};
  archive(query, pair, w.scalar, claim, w.verdict);
  refuse_unknown(pair);
  const formats::Location where{"a worst case", 0};
  const auto question = formats::parse_object(query, where);
  w.query = golden::read_inputs(formats::Node(question, where), pair);
  const auto answer = formats::parse_object(claim, where);
  w.claim = engines::read_claim(formats::Node(answer, where));
}

template <class Archive>
void serialize(Archive& archive, Findings& f) {
  archive(f.sources, f.families, f.skipped, f.worst, f.failures, f.failure_count, f.fresh_failures, f.gone, f.unreached,
          f.stopped, f.why);
}

template <class Archive>
void serialize(Archive& archive, Part& p) {
  archive(p.found, p.unasked);
}

namespace {

constexpr std::string_view kFormat = "contact-oracle/part";
constexpr std::uint64_t kVersion = 5;

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

std::string pack(const Part& part) {
  std::ostringstream stream;
  cereal::PortableBinaryOutputArchive archive(stream);
  archive(part);
  return std::move(stream).str();
}

Part unpack(const std::string& bytes) {
  std::istringstream stream(bytes);
  cereal::PortableBinaryInputArchive archive(stream);
  Part part;
  archive(part);
  if (part.found.size() != part.unasked.size() ||
      !std::all_of(part.found.begin(), part.found.end(), [](const Findings& f) { return is_sound(f); }))
    throw cereal::Exception("it tells of what there is not");
  for (Findings& found : part.found) make_visible(found);
  if (stream.peek() != std::istringstream::traits_type::eof()) throw cereal::Exception("more than a part");
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
    if (file.content.found.size() != 1) throw cereal::Exception("not the findings of one engine");
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
