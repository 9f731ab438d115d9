// What the program prints for people, beside the data that it was asked for: where it goes, and whether in colour.
#pragma once

#include <fmt/format.h>

#include <array>
#include <concepts>
#include <cstdint>
#include <iostream>
#include <string>
#include <string_view>

#include "formats/visible.hpp"

namespace contact::tool {

/// Puts a guard before std::cout and std::cerr. Whatever is written to them, nothing commands a terminal, turns or
/// hides text, or is a command to what reads the logs of continuous integration: a colon at the beginning of a line
/// (::error::) and ## anywhere (##[error]) are written out. A guard cannot tell a line feed of ours from another, which
/// say() can. Data that was asked for, JSON, golden files and answers, goes to stdout past the guard.
void guard_output();
/// A text as the guard lets it through, for those who print it elsewhere.
[[nodiscard]] std::string guarded_text(std::string_view text);

/// Leaves out all words for people and every progress bar; errors are told all the same.
void be_quiet();
[[nodiscard]] bool is_quiet();
/// Keeps standard output for data: words for people go to standard error.
void keep_output_for_data();
/// Where words for people go. Precondition of what is written: every line feed in it is ours.
[[nodiscard]] std::ostream& words();

/// What say() prints of a value: of a text one visible line, whatever is in it.
[[nodiscard]] inline std::string as_said(const std::convertible_to<std::string_view> auto& text) {
  return formats::visible(text);
}
template <class T>
[[nodiscard]] const T& as_said(const T& value) {
  return value;
}

template <class... Args>
void say_on(std::ostream& stream, fmt::string_view format, const Args&... args) {
  const auto print = [&](const auto&... said) { stream << fmt::vformat(format, fmt::make_format_args(said...)); };
  print(as_said(args)...);
}
/// Says it in words(), or as an error. Only `format` has line feeds; of what `args` hold each stays on its line.
template <class... Args>
void say(fmt::format_string<const Args&...> format, const Args&... args) {
  say_on(words(), format, args...);
}
template <class... Args>
void say_error(fmt::format_string<const Args&...> format, const Args&... args) {
  say_on(std::cerr, format, args...);
}

/// A message as it is told: what quotes a whole file is cut, not within a character.
[[nodiscard]] std::string cut(std::string_view message);
/// Says on standard error how many numbers were written as decimals of binary32 numbers, of which there may be none.
void say_decimals(std::uint64_t count, std::string_view whose);

enum class Colour { automatic, always, never };
inline constexpr std::array<std::string_view, 3> kColourNames{"auto", "always", "never"};
void choose_colour(Colour colour);
[[nodiscard]] Colour chosen_colour();
/// Lets the colours of the reports through the guard.
void let_colours_through();

}  // namespace contact::tool
