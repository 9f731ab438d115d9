// Fresh questions: what a run on published ones asks besides, so that to know their answers is not enough.
// docs/specification.md#fresh-questions.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tool/run/pipeline.hpp"

namespace contact::tool {

/// How many of every family are asked where nobody says. The built-in engines of the scoreboard know no published
/// answer, so that it asks fewer.
inline constexpr std::uint64_t kFreshEach = 100;
inline constexpr std::uint64_t kFreshOfScoreboard = 10;

/// The index of the first fresh question of a family. Generated datasets begin with 0 and end far below it, so that no
/// seed brings back what a dataset of the same seed holds.
inline constexpr std::uint64_t kFreshFrom = std::uint64_t{1} << 32;

/// The fresh questions beside datasets, or beside what everybody may generate: of each pair, scalar and family once,
/// where a generator makes that family.
[[nodiscard]] std::vector<Source> fresh_beside(const std::vector<Source>& published, const AskedFresh& asked);

/// What a run on these sources says of fresh questions. `recorded`: its answers were recorded before.
[[nodiscard]] std::optional<Fresh> fresh_of(const std::vector<Source>& sources, bool recorded);

/// The sources that are not fresh, in their order: those that come first.
[[nodiscard]] std::vector<Source> published_of(const std::vector<Source>& sources);

}  // namespace contact::tool
