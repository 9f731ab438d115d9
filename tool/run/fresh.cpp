// Fresh questions: what a run on published ones asks besides.
#include "tool/run/fresh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <tuple>

namespace contact::tool {

std::vector<Source> fresh_beside(const std::vector<Source>& published, const AskedFresh& asked) {
  std::vector<Source> sources;
  std::set<std::tuple<Pair, Scalar, std::string>> taken;
  if (asked.each == 0) return sources;
  for (const Source& source : published) {
    const golden::Family* family = golden::find_family(source.pair, source.family);
    if (source.fresh || family == nullptr || !taken.emplace(source.pair, source.scalar, source.family).second) continue;
    Source fresh{source.pair, source.scalar, source.family, asked.each, std::nullopt, family, asked.seed, kFreshFrom};
    fresh.fresh = true;
    sources.push_back(std::move(fresh));
  }
  return sources;
}

std::optional<Fresh> fresh_of(const std::vector<Source>& sources, bool recorded) {
  Fresh fresh;
  bool published = false;
  bool made = false;  // of any family here
  for (const Source& source : sources) {
    published = published || source.fresh || source.dataset;
    if (source.fresh) {
      fresh.each = source.size();
      fresh.seed = source.seed;
    }
    if (!source.dataset) continue;
    if (golden::find_family(source.pair, source.family) != nullptr)
      made = true;
    else if (std::find(fresh.unmade.begin(), fresh.unmade.end(), source.family) == fresh.unmade.end())
      fresh.unmade.push_back(source.family);
  }
  if (!published) return std::nullopt;
  if (fresh.each == 0)
    fresh.none = recorded ? "recorded answers cannot be asked fresh ones"
                 : made   ? "--fresh 0 left fresh ones out"
                          : fmt::format("no generator makes fresh ones of {}", fmt::join(fresh.unmade, ", "));
  return fresh;
}

std::vector<Source> published_of(const std::vector<Source>& sources) {
  std::vector<Source> published;
  std::copy_if(sources.begin(), sources.end(), std::back_inserter(published),
               [](const Source& source) { return !source.fresh; });
  return published;
}

}  // namespace contact::tool
