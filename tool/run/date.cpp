// Days of the calendar, as files have them.
#include "tool/run/date.hpp"

#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "formats/input_error.hpp"

namespace contact::tool {
namespace {

std::string date_of(std::chrono::sys_days day) {
  const std::chrono::year_month_day date(day);
  return fmt::format("{:04}-{:02}-{:02}", static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                     static_cast<unsigned>(date.day()));
}

/// All of a text as a whole number from 0; false where it is anything else.
bool read_number(std::string_view text, std::uint64_t& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

std::string today() { return date_of(std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now())); }

std::string issue_date() {
  const char* epoch = std::getenv("SOURCE_DATE_EPOCH");
  if (epoch == nullptr) return today();
  constexpr std::uint64_t kLastSecond = 253402300799;  // of the year 9999
  std::uint64_t seconds = 0;
  if (!read_number(epoch, seconds) || seconds > kLastSecond)
    throw formats::InputError({"environment", 0}, "SOURCE_DATE_EPOCH",
                              fmt::format("expected seconds since 1970, got '{}'", epoch));
  return date_of(std::chrono::floor<std::chrono::days>(
      std::chrono::sys_seconds(std::chrono::seconds(static_cast<std::int64_t>(seconds)))));
}

bool is_date(const std::string& text) {
  if (text.size() != 10 || text[4] != '-' || text[7] != '-') return false;
  std::uint64_t year = 0;
  std::uint64_t month = 0;
  std::uint64_t day = 0;
  const std::string_view whole = text;
  if (!read_number(whole.substr(0, 4), year) || !read_number(whole.substr(5, 2), month) ||
      !read_number(whole.substr(8, 2), day))
    return false;
  return std::chrono::year_month_day(std::chrono::year(static_cast<int>(year)),
                                     std::chrono::month(static_cast<unsigned>(month)),
                                     std::chrono::day(static_cast<unsigned>(day)))
      .ok();
}

}  // namespace contact::tool
