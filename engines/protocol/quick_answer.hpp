// The common form of an engine's answer, read in one pass over the text.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "oracle/judge/claim.hpp"

namespace contact::engines {

struct Answer {
  std::uint64_t seq;
  Claim claim;
};

/// The answer in a line of the form {"op":"answer","seq":1,"overlap":true,"contact":{...}}, keys in any order, every
/// number written as one. Nothing for any other line: read_answer then reads it, or refuses it with a message. What
/// this reads, read_answer reads the same. The line stays as it is, in more room.
[[nodiscard]] std::optional<Answer> quick_answer(std::string& line);

}  // namespace contact::engines
