// A table at a terminal: the first column to the left, the others to the right.
#pragma once

#include <fmt/color.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace contact::tool {

/// A count in a cell.
[[nodiscard]] inline std::string or_dot(std::uint64_t n) { return n == 0 ? "." : std::to_string(n); }

/// "99.5 %" of a whole, which is not 0, the number as `form` writes it, as "{:.3g}". Only the whole is 100 %: a part
/// that would round to it is the largest number below.
[[nodiscard]] inline std::string percent(std::uint64_t part, std::uint64_t whole, std::string_view form) {
  const auto written = [&](double share) { return fmt::format(fmt::runtime(form), share); };
  const auto is_all = [](const std::string& text) { return std::strtod(text.c_str(), nullptr) >= 100; };
  std::string text = written(100.0 * static_cast<double>(part) / static_cast<double>(whole));
  if (part < whole && is_all(text))
    for (double less = 1; !is_all(written(100 - less)); less /= 10) text = written(100 - less);
  return text + " %";
}

class Table {
 public:
  void row(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  [[nodiscard]] const std::vector<std::vector<std::string>>& rows() const { return rows_; }

  /// Leaves out the columns that hold nothing but ".", or nothing, below their head.
  void drop_empty_columns() {
    for (std::size_t column = rows_.front().size(); column-- > 1;) {
      const auto empty = [&](const auto& row) { return row[column] == "." || row[column].empty(); };
      if (!std::all_of(rows_.begin() + 1, rows_.end(), empty)) continue;
      for (auto& row : rows_) row.erase(row.begin() + static_cast<std::ptrdiff_t>(column));
    }
  }

  /// `style`: how a cell is printed, from the head of its column and its text; without it everything is plain.
  using Style = std::function<fmt::text_style(const std::string& head, const std::string& cell)>;
  [[nodiscard]] std::string text(const Style& style = {}) const {
    std::vector<std::size_t> widths;
    for (const auto& row : rows_) {
      widths.resize(std::max(widths.size(), row.size()));
      for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    }
    std::string text;
    for (const auto& row : rows_) {
      // Spaces are added outside of a cell's style, and none behind the last cell that says something.
      std::string line;
      std::string spaces;
      for (std::size_t i = 0; i < row.size(); ++i) {
        const std::string padding(widths[i] - row[i].size(), ' ');
        spaces += i == 0 ? "" : "  " + padding;
        if (!row[i].empty()) {
          line += spaces + (style ? fmt::format(style(rows_.front()[i], row[i]), "{}", row[i]) : row[i]);
          spaces.clear();
        }
        if (i == 0) spaces += padding;
      }
      text += line + "\n";
    }
    return text;
  }

 private:
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace contact::tool
