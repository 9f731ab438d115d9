// Bad input: one error type that names file, line, field and value.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <stdexcept>
#include <string>

namespace contact::golden {

/// A place in a file; line 0 means the file as a whole.
struct Location {
  std::string file;
  std::size_t line = 0;
};

/// Input that the reader refuses. what() is the whole message: `file:line: field: problem`.
class InputError : public std::runtime_error {
 public:
  InputError(const Location& where, const std::string& field, const std::string& problem)
      : std::runtime_error(fmt::format("{}{}: {}{}", where.file, where.line == 0 ? "" : fmt::format(":{}", where.line),
                                       field.empty() ? "" : field + ": ", problem)) {}
};

}  // namespace contact::golden
