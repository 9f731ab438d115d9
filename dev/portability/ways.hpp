// The ways of answering whose bytes are held against the same digests.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "oracle/truth/query.hpp"

namespace contact::golden {

/// A way of answering a run of questions of one pair: their bytes are appended in order.
struct Way {
  std::string name;
  std::function<void(std::span<const Query> run, std::string& bytes)> answer;
};

/// Many pairs at once, a way for every instruction set of the kernels that this processor has.
[[nodiscard]] std::vector<Way> batch_ways();

}  // namespace contact::golden
