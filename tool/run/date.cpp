// Days of the calendar, as files have them.
#include "tool/run/date.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "formats/input_error.hpp"
#include "formats/whole_number.hpp"

namespace contact::tool {
namespace {

std::string date_of(std::chrono::sys_days day) {
  const std::chrono::year_month_day date(day);
  return fmt::format("{:04}-{:02}-{:02}", static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                     static_cast<unsigned>(date.day()));
}

}  // namespace

std::string today() { return date_of(std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now())); }

std::string issue_date() {
  const char* epoch = std::getenv("SOURCE_DATE_EPOCH");
  if (epoch == nullptr) return today();
  constexpr std::int64_t kLastSecond = 253402300799;  // of the year 9999
  const auto seconds = formats::whole_number<std::int64_t>(std::string_view(epoch));
  if (!seconds || *seconds < 0 || *seconds > kLastSecond)
    throw formats::InputError({"environment", 0}, "SOURCE_DATE_EPOCH",
                              fmt::format("expected seconds since 1970, got '{}'", epoch));
  return date_of(std::chrono::floor<std::chrono::days>(std::chrono::sys_seconds(std::chrono::seconds(*seconds))));
}

bool is_date(const std::string& text) {
  if (text.size() != 10 || text[4] != '-' || text[7] != '-') return false;
  const std::string_view whole = text;
  const auto year = formats::whole_number<unsigned>(whole.substr(0, 4));
  const auto month = formats::whole_number<unsigned>(whole.substr(5, 2));
  const auto day = formats::whole_number<unsigned>(whole.substr(8, 2));
  return year && month && day &&
         std::chrono::year_month_day(std::chrono::year(static_cast<int>(*year)), std::chrono::month(*month),
                                     std::chrono::day(*day))
             .ok();
}

}  // namespace contact::tool
