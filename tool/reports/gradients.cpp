// The derivatives of a contact's numbers, as a table for people and as JSON.
#include "tool/reports/gradients.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "formats/json.hpp"
#include "oracle/gradient/gradient.hpp"

namespace contact::tool {
namespace {

using oracle::Derivative;
using oracle::Gradient;
using oracle::kDifferentiated;

constexpr std::string_view kNoDistance = "not told of a pair without a distance";
constexpr std::size_t kNamed = 4;  // derivatives that a reason is said of by name

/// Where the numbers of a field stand among the outputs.
std::pair<std::size_t, std::size_t> outputs_of(std::size_t field) {
  return field == 0 ? std::pair<std::size_t, std::size_t>(0, 1) : std::pair(3 * field - 2, 3 * field + 1);
}
std::string name_of(std::size_t output) {
  const std::size_t field = (output + 2) / 3;
  return field == 0 ? "value" : fmt::format("{}[{}]", kDifferentiated[field], output - outputs_of(field).first);
}

std::string or_null(const std::optional<double>& x) { return x ? formats::number(*x) : "null"; }

/// What stands in the table: a number, those from below and above, or a dash.
std::string cell(const Derivative& x) {
  const auto short_number = [](const std::optional<double>& number) {
    return number ? std::isfinite(*number) ? fmt::format("{:.6g}", *number) : formats::number(*number) : "";
  };
  if (x.number) return short_number(x.number);
  if (!x.sides[0] && !x.sides[1]) return "-";
  return short_number(x.sides[0]) + "|" + short_number(x.sides[1]);
}

}  // namespace

std::string gradient_text(const Query& query, const oracle::Truth& truth) {
  const auto gradient = oracle::gradient(query, truth);
  if (!gradient) return fmt::format("\n  derivatives: {}\n", kNoDistance);
  std::vector<std::vector<std::string>> rows{{"derivatives"}};
  rows[0].insert(rows[0].end(), kDifferentiated.begin(), kDifferentiated.end());
  std::map<std::string_view, std::vector<std::string>> undefined;
  for (std::size_t k = 0; k < gradient->by.size(); ++k) {
    auto& row = rows.emplace_back(std::vector{"by " + gradient->by[k]});
    for (std::size_t field = 0; field < kDifferentiated.size(); ++field) {
      std::vector<std::string> cells;
      for (auto [output, end] = outputs_of(field); output < end; ++output) {
        const Derivative& x = gradient->derivatives[k][output];
        cells.push_back(cell(x));
        if (!x.number) undefined[x.undefined].push_back(fmt::format("{} by {}", name_of(output), gradient->by[k]));
      }
      row.push_back(cells.size() == 1 ? cells[0] : fmt::format("({})", fmt::join(cells, ", ")));
    }
  }
  std::string text = "\n";
  std::array<std::size_t, 5> widths{};
  for (const auto& row : rows)
    for (std::size_t column = 0; column < row.size(); ++column)
      widths[column] = std::max(widths[column], row[column].size());
  for (const auto& row : rows) {
    std::string line = "  ";
    for (std::size_t column = 0; column < row.size(); ++column)
      line += fmt::format("{:<{}}", row[column], widths[column] + 2);
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  for (const auto& [why, all] : undefined) {
    const auto named =
        std::vector(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(kNamed, all.size())));
    text += fmt::format("  no derivative: {}: {}{}\n", why, fmt::join(named, ", "),
                        all.size() > kNamed ? fmt::format(" and {} more", all.size() - kNamed) : "");
  }
  if (!undefined.empty()) text += "  x|y is the derivative from below and that from above; - is none.\n";
  return text;
}

std::string gradient_json(const Query& query, const oracle::Truth& truth) {
  const auto gradient = oracle::gradient(query, truth);
  if (!gradient)
    return fmt::format(R"({{"value":null,"normal":null,"point1":null,"point2":null,"undefined":"{}"}})", kNoDistance);
  std::vector<std::string> fields;
  std::vector<std::string> undefined;
  for (std::size_t field = 0; field < kDifferentiated.size(); ++field) {
    std::vector<std::string> rows;
    for (auto [output, end] = outputs_of(field); output < end; ++output) {
      std::vector<std::string> row;
      for (std::size_t k = 0; k < gradient->by.size(); ++k) {
        const Derivative& x = gradient->derivatives[k][output];
        row.push_back(or_null(x.number));
        if (x.number) continue;
        const bool has_side = x.sides[0] || x.sides[1];
        undefined.push_back(
            fmt::format(R"({{"of":"{}","by":"{}","undefined":"{}"{}}})", name_of(output), gradient->by[k], x.undefined,
                        has_side ? fmt::format(R"(,"sides":[{},{}])", or_null(x.sides[0]), or_null(x.sides[1])) : ""));
      }
      rows.push_back(fmt::format("[{}]", fmt::join(row, ",")));
    }
    fields.push_back(fmt::format(R"("{}":{})", kDifferentiated[field],
                                 rows.size() == 1 ? rows[0] : fmt::format("[{}]", fmt::join(rows, ","))));
  }
  return fmt::format("{{{}{}}}", fmt::join(fields, ","),
                     undefined.empty() ? "" : fmt::format(R"(,"nulls":[{}])", fmt::join(undefined, ",")));
}

}  // namespace contact::tool
