// The flags of a case: facts about a question, derived from the exact answer, that say why it is worth asking.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "oracle/truth/query.hpp"
#include "oracle/truth/truth.hpp"

namespace contact::golden {

struct Flag {
  std::string_view name;
  std::string_view meaning;
  std::string_view breaks;  ///< what goes wrong in engines where this holds
  bool (*holds)(const Query& query, const oracle::Truth& truth, Scalar scalar);
};

/// Every flag, in the order in which a case lists them.
[[nodiscard]] std::span<const Flag> flags();

/// The names of the flags that hold. Domain: the question is inside the domain.
[[nodiscard]] std::vector<std::string> flags_of(const Query& query, const oracle::Truth& truth, Scalar scalar);

/// The one flag of a question outside the domain.
inline constexpr std::string_view kInvalidFlag = "Invalid";

}  // namespace contact::golden
