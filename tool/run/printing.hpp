// What the program prints for people, beside the data that it was asked for: where it goes, and whether in colour.
#pragma once

#include <array>
#include <cstdio>
#include <string>
#include <string_view>

namespace contact::tool {

/// Leaves out all words for people and every progress bar; errors are told all the same.
void be_quiet();
[[nodiscard]] bool is_quiet();
/// Keeps standard output for data: words for people go to standard error.
void keep_output_for_data();
/// Where words for people go.
[[nodiscard]] std::FILE* words();

/// A message as it is told: what quotes a whole file is cut, not within a character.
[[nodiscard]] std::string cut(std::string_view message);

enum class Colour { automatic, always, never };
inline constexpr std::array<std::string_view, 3> kColourNames{"auto", "always", "never"};
void choose_colour(Colour colour);
[[nodiscard]] Colour chosen_colour();

}  // namespace contact::tool
