// golden/manifest.json: every committed dataset with its digest, counts and origin.
#include "golden/manifest.hpp"

#include <fstream>
#include <sstream>

#include "golden/families.hpp"

namespace contact::golden {

std::string manifest_text(const std::vector<ManifestEntry>& entries) {
  std::string text = fmt::format(
      "{{\"format\":\"contact-oracle/manifest\",\"version\":1,\"generator\":{},\"files\":[\n", json_string(kGenerator));
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const auto& [path, file] = entries[i];
    const DatasetHeader& h = file.header;
    std::string flags;
    for (const auto& [flag, count] : file.flags)
      flags += fmt::format("{}\"{}\":{}", flags.empty() ? "" : ",", flag, count);
    std::string closest;
    for (const auto& [distance, id] : file.closest)
      closest += fmt::format(R"({}"{}":{{"log2_ulps":{},"id":"{}"}})", closest.empty() ? "" : ",", distance.field,
                             distance.log2, id);
    text += fmt::format(
        R"({{"path":{},"pair":"{}","scalar":"{}","family":{},"origin":"{}","generator":{},"seed":{},"count":{},"hits":{},"flags":{{{}}},"closest":{{{}}},"sha256":"{}"}}{})",
        json_string(path), name(h.pair), name(h.scalar), json_string(h.family),
        find_family(h.pair, h.family) ? "generated" : "annotated", json_string(h.generator), h.seed, h.count, file.hits,
        flags, closest, file.sha256, i + 1 < entries.size() ? ",\n" : "\n");
  }
  return text + "]}\n";
}

void check_manifest(const std::filesystem::path& folder, const std::vector<ManifestEntry>& found) {
  const std::filesystem::path path = folder / kManifestName;
  std::ifstream stream = open_to_read(path);
  std::ostringstream text;
  text << stream.rdbuf();
  if (text.str() == manifest_text(found)) return;
  // Say which line is the first to differ: a file's entry is a line of its own.
  std::istringstream given(text.str());
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
  throw InputError(
      {path.string(), line}, "",
      fmt::format("the manifest says {}\n  the files say {}", a.empty() ? "nothing" : a, b.empty() ? "nothing" : b));
}

}  // namespace contact::golden
