// Text from outside as people are shown it: a file, an engine or a command line may hold what commands a terminal,
// breaks a line where none ends, turns it around or is not seen at all.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace contact::formats {

/// `text` on one line, with all that is not plainly seen written out: control characters and bytes that are no UTF-8 as
/// \x1b, marks of direction, separators of lines and other characters without a look of their own as \u{202e}. The rest
/// stays as it is, a backslash too, so that done twice it is done once.
[[nodiscard]] std::string visible(std::string_view text);
/// The same of several lines: line feeds and tabs stay.
[[nodiscard]] std::string visible_lines(std::string_view text);
/// JSON with the same characters written as \u202e, which read back as what they are, and no two # in a row: a log is
/// looked through for ##[commands].
[[nodiscard]] std::string visible_json(std::string text);

/// The first character of a text that is not empty.
struct Character {
  char32_t code = 0;
  std::size_t size = 1;  ///< bytes
  bool is_text = false;  ///< else its first byte begins no character of UTF-8
};
[[nodiscard]] Character first_character(std::string_view text);
[[nodiscard]] bool is_visible(const Character& character);
/// \x1b, \u{202e}
void append_written_out(std::string& to, const Character& character);

}  // namespace contact::formats
