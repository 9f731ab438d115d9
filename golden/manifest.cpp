// golden/manifest.json: every committed dataset with its digest, counts and origin.
#include "golden/manifest.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "formats/json.hpp"
#include "formats/output_file.hpp"

namespace contact::golden {

namespace {

std::string digests_text(const Digests& digests) {
  std::string text;
  for (const auto& [count, digest] : digests)
    text += fmt::format("{}\"{}\":\"{}\"", text.empty() ? "" : ",", count, digest);
  return "\"digests\":{" + text + "}";
}

}  // namespace

std::string manifest_text(const std::vector<ManifestEntry>& entries) {
  std::string text =
      fmt::format("{{\"format\":\"contact-oracle/manifest\",\"version\":1,\"generator\":{},\"files\":[\n",
                  formats::json_string(kGenerator));
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const auto& [path, file, digests, kills] = entries[i];
    const DatasetHeader& h = file.header;
    std::string flags;
    for (const auto& [flag, count] : file.flags)
      flags += fmt::format("{}\"{}\":{}", flags.empty() ? "" : ",", flag, count);
    std::string closest;
    for (const auto& [field, log2, id] : file.closest)
      closest += fmt::format(R"({}"{}":{{"log2_ulps":{},"id":"{}"}})", closest.empty() ? "" : ",", field, log2, id);
    text += fmt::format(
        R"({{"path":{},"pair":"{}","scalar":"{}","family":{},"origin":"{}","generator":{},"seed":{},"count":{},"hits":{},"flags":{{{}}},"closest":{{{}}},"sha256":"{}",{}{}}}{})",
        formats::json_string(path), name(h.pair), name(h.scalar), formats::json_string(h.family),
        path.starts_with(fmt::format("{}/", kQuickFolder)) ? "selected"
        : file.generated                                   ? "generated"
                                                           : "annotated",
        formats::json_string(h.generator), h.seed, h.count, file.hits, flags, closest, file.sha256,
        kills ? fmt::format("\"kills\":{},", *kills) : "", digests_text(digests),
        i + 1 < entries.size() ? ",\n" : "\n");
  }
  return text + "]}\n";
}

std::map<std::string, Recorded> recorded_digests(const std::filesystem::path& folder) {
  const formats::Location where{(folder / kManifestName).string(), 0};
  std::map<std::string, Recorded> recorded;
  if (!std::filesystem::exists(where.file)) return recorded;
  const auto json = formats::parse_object(formats::read_text(where.file), where);
  for (const formats::Node& file : formats::Node(json, where).at("files").items()) {
    Recorded& r = recorded[file.at("path").text()];
    const std::string pair = file.at("pair").text();
    const auto of = std::find_if(kPairs.begin(), kPairs.end(), [&](Pair p) { return name(p) == pair; });
    const std::uint64_t many = of == kPairs.end() ? kManyAnswers : many_answers(*of);
    r.generator = file.at("generator").text();
    if (const auto digests = file.find("digests"))
      for (const std::uint64_t count : {file.at("count").count(), many, kMostAnswers})
        if (const auto digest = digests->find(std::to_string(count))) r.digests[count] = digest->text();
  }
  return recorded;
}

std::map<std::string, std::uint64_t> recorded_kills(const std::filesystem::path& folder,
                                                    const std::vector<ManifestEntry>& entries) {
  const formats::Location where{(folder / kAdequacyName).string(), 0};
  std::map<std::string, std::uint64_t> kills;
  if (!std::filesystem::exists(where.file)) return kills;
  const auto json = formats::parse_object(formats::read_text(where.file), where);
  for (const formats::Node& file : formats::Node(json, where).at("files").items()) {
    const std::string path = file.at("path").text();
    const auto entry =
        std::find_if(entries.begin(), entries.end(), [&](const ManifestEntry& e) { return e.path == path; });
    if (entry == entries.end() || entry->file.sha256 != file.at("sha256").text())
      throw formats::InputError(where, "files",
                                path + " is another file now, or none (then: contact-oracle adequacy FOLDER --write)");
    kills[path] = file.at("kills").items().size();
  }
  if (kills.size() != entries.size())
    throw formats::InputError(where, "files", fmt::format("{} files are here, {} there", kills.size(), entries.size()));
  return kills;
}

void record_digests(const std::filesystem::path& folder, const std::string& path, const Digests& digests) {
  // An entry is a line of its own, and the digests are the last of it.
  std::string text = formats::read_text(folder / kManifestName);
  const std::size_t entry = text.find("{\"path\":" + formats::json_string(path) + ",");
  const std::size_t begin = text.find("\"digests\":{", entry);
  const std::size_t end = text.find('}', begin);
  if (entry == std::string::npos || end == std::string::npos || text.find('\n', entry) < end)
    throw formats::InputError({(folder / kManifestName).string(), 0}, "", "no entry with digests of " + path);
  formats::OutputFile file(folder / kManifestName);
  file.write(text.replace(begin, end + 1 - begin, digests_text(digests)));
  file.commit();
}

void check_manifest(const std::filesystem::path& folder, const std::vector<ManifestEntry>& found) {
  const std::filesystem::path path = folder / kManifestName;
  const std::string text = formats::read_text(path);
  if (text == manifest_text(found)) return;
  // Say which line is the first to differ: a file's entry is a line of its own.
  std::istringstream given(text);
  std::istringstream right(manifest_text(found));
  std::string a;
  std::string b;
  std::size_t line = 0;
  do {
    ++line;
    a.clear();
    b.clear();
    std::getline(given, a);
    std::getline(right, b);
  } while (a == b && (given || right));
  throw formats::InputError(
      {path.string(), line}, "",
      fmt::format("the manifest says {}\n  the files say {}", a.empty() ? "nothing" : a, b.empty() ? "nothing" : b));
}

}  // namespace contact::golden
