// Bad input: one error type that names file, line, field and value.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <stdexcept>
#include <string>

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

/// Input that the reader refuses. what() is the whole message: `file:line: field: problem`.
class InputError : public std::runtime_error {
 public:
  InputError(const Location& where, const std::string& field, const std::string& problem)
      : std::runtime_error(fmt::format("{}: {}{}", where.text(), field.empty() ? "" : field + ": ", problem)) {}
};

}  // namespace contact::formats
