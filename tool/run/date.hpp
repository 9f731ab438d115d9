// Days of the calendar, as files have them: YYYY-MM-DD, whose order as text is their order in time.
#pragma once

#include <string>

namespace contact::tool {

/// Today, in UTC.
[[nodiscard]] std::string today();
/// What a file that is written now is dated: the day of SOURCE_DATE_EPOCH where the environment has it, so that a run
/// can be repeated to the byte, else today. Throws formats::InputError where that is no number of seconds.
[[nodiscard]] std::string issue_date();
/// Whether a text is a day that the calendar has.
[[nodiscard]] bool is_date(const std::string& text);

}  // namespace contact::tool
