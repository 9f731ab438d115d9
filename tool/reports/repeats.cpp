// What came of asking an engine again.
#include "tool/reports/repeats.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "formats/json.hpp"

namespace contact::tool {

bool Repeats::same() const {
  return std::all_of(ways.begin(), ways.end(), [](const Way& way) { return way.differ == 0; });
}

std::vector<std::string> Repeats::lines() const {
  std::vector<std::string> lines;
  for (const Way& way : ways)
    lines.push_back(way.differ == 0 ? fmt::format("{}: the same {} answers", way.how, way.asked)
                                    : fmt::format("{}: {} of {} answers differ, the first to {}: {}, and before {}",
                                                  way.how, way.differ, way.asked, way.question, way.now, way.before));
  lines.push_back(fmt::format("SHA-256 of the answers: {}", sha256));
  return lines;
}

std::string Repeats::json() const {
  using formats::json_string;
  std::string all;
  for (const Way& way : ways) {
    const std::string first =
        way.differ == 0 ? "" : fmt::format(R"(,"question":{},"before":{},"now":{})", way.question, way.before, way.now);
    all += fmt::format(R"({}{{"how":{},"asked":{},"differ":{}{}}})", all.empty() ? "" : ",", json_string(way.how),
                       way.asked, way.differ, first);
  }
  std::string sources;
  for (const SourceDigest& one : digests)
    sources += fmt::format(R"({}{{"pair":"{}","scalar":"{}","family":{},"answers":{},"sha256":"{}","each":"{}"}})",
                           sources.empty() ? "" : ",\n", name(one.pair), name(one.scalar), json_string(one.family),
                           one.answers, one.sha256, one.each);
  return fmt::format(R"({{"ways":[{}],"sha256":"{}","sources":[{}]}})", all, sha256, sources);
}

}  // namespace contact::tool
