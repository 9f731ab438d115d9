// A standalone test: one source file with questions and what is right, which needs nothing of this project.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "oracle/judge/certain.hpp"
#include "oracle/judge/declaration.hpp"
#include "oracle/truth/query.hpp"

namespace contact::tool {

enum class Language { c, cpp, python, js, rust, cuda };
inline constexpr std::array<std::string_view, 6> kLanguageNames{"c", "cpp", "python", "js", "rust", "cuda"};

struct CertainQuestion {
  Query query;
  oracle::Certain certain;
  std::string family;
};

struct Standalone {
  Language language;
  Pair pair;
  oracle::Declaration declared;
  std::vector<std::string> about;  ///< what it was made from, for the head
  std::vector<CertainQuestion> questions;
};

/// The text of the file. Domain: at least one question.
[[nodiscard]] std::string standalone_test(const Standalone& test);

}  // namespace contact::tool
