// Bad input: one error type that names file, line, field and value.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "formats/visible.hpp"

namespace contact::formats {

/// A place in a file: a line, or a row of columns that are counted from 0. Line 0 means the file as a whole.
struct Location {
  std::string file;
  std::size_t line = 0;
  bool is_row = false;  ///< `line` is the number of a row and one more

  [[nodiscard]] std::string text() const {
    if (line == 0) return file;
    return is_row ? fmt::format("{}: row {}", file, line - 1) : fmt::format("{}:{}", file, line);
  }
};

/// Input that the reader refuses. what() is the whole message: `file:line: field: problem`, which is one visible line
/// whatever the file has in it, and what `below` has to say, a line each.
class InputError : public std::runtime_error {
 public:
  InputError(const Location& where, const std::string& field, const std::string& problem,
             const std::vector<std::string>& below = {})
      : std::runtime_error(message(where, field, problem, below)) {}

 private:
  static std::string message(const Location& where, const std::string& field, const std::string& problem,
                             const std::vector<std::string>& below) {
    std::string text = visible(fmt::format("{}: {}{}", where.text(), field.empty() ? "" : field + ": ", problem));
    for (const std::string& line : below) text += "\n" + visible(line);
    return text;
  }
};

}  // namespace contact::formats
