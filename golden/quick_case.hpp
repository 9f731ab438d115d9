// The common form of a dataset's line, read in one pass (simdjson).
#pragma once

#include <optional>
#include <string_view>

#include "golden/dataset.hpp"

namespace contact::golden {

/// The case in a line as this project writes it: the keys in their order and none else, every number written as one.
/// Nothing for any other line: read_case then reads it, or refuses it with a message. What this reads, read_case reads
/// the same. The parser looks at formats::Lines::kRoom bytes behind the line, which can be read.
[[nodiscard]] std::optional<Case> quick_case(std::string_view line, const DatasetHeader& header);

}  // namespace contact::golden
