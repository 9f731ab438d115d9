// What this process computes on: processor, system, compiler, and the floating-point modes that it runs under.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace contact::tool {

/// {"processor","system","compiler","rounding","subnormal_results","subnormal_inputs"}, the modes found by computing.
[[nodiscard]] nlohmann::json environment();

}  // namespace contact::tool
