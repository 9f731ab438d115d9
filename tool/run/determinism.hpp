// Whether an engine gives the same bits again: docs/specification.md#determinism.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tool/reports/repeats.hpp"
#include "tool/run/pipeline.hpp"

namespace contact::tool {

/// Another way to ask the same engine, from several threads at once.
struct OtherHost {
  std::string how;  ///< "by three processes"
  std::unique_ptr<engines::Engine> engine;
};

/// Asks every question of the sources that the engine serves in turn, then again, in another order, one at a time, many
/// at once, and from several threads each of the other hosts, or where there is none the engine itself. Claims are
/// compared by the text that records them. Memory is bounded by kTogether questions of a source.
[[nodiscard]] Repeats ask_again(const std::vector<Source>& sources, engines::Engine& engine,
                                const engines::EngineInfo& info, const std::vector<OtherHost>& others);

/// The digests of what an engine answers when it is asked once.
[[nodiscard]] Repeats ask_once(const std::vector<Source>& sources, engines::Engine& engine,
                               const engines::EngineInfo& info);

inline constexpr std::size_t kTogether = 4096;  ///< questions that are shuffled, or asked in one batch
inline constexpr unsigned kThreadsThatAsk = 4;

}  // namespace contact::tool
