// Text from outside comes out visible, whatever it holds.
#include "formats/visible.hpp"

#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>
#include <string>

namespace contact::formats {
namespace {

/// A code point in UTF-8, by the table of RFC 3629; a surrogate likewise, which is no UTF-8.
std::string utf8(char32_t c) {
  const auto more = [&](int bits) { return static_cast<char>(0x80 | (c >> bits & 0x3F)); };
  if (c < 0x80) return {static_cast<char>(c)};
  if (c < 0x800) return {static_cast<char>(0xC0 | c >> 6), more(0)};
  if (c < 0x10000) return {static_cast<char>(0xE0 | c >> 12), more(6), more(0)};
  return {static_cast<char>(0xF0 | c >> 18), more(12), more(6), more(0)};
}

TEST(Visible, text_that_is_plainly_seen_stays) {
  for (const char* text : {"", " ", "plain text, \\x1b too", "Größe 漢字 Δ₀ ✓", "می‌خواهم", "👩‍🔬"}) {
    EXPECT_EQ(visible(text), text);
    EXPECT_EQ(visible_lines(text), text);
  }
}

TEST(Visible, what_commands_turns_breaks_or_hides_is_written_out) {
  EXPECT_EQ(visible("\x1b[31m\r\n\t\x7f"), R"(\x1b[31m\x0d\x0a\x09\x7f)");
  EXPECT_EQ(visible(std::string("a\0b", 3)), R"(a\x00b)");
  EXPECT_EQ(visible("\u009b31m \u0085 \u202e \u2066 \u200f \u061c \u2028\u2029 \ufeff \u00ad"),
            R"(\u{9b}31m \u{85} \u{202e} \u{2066} \u{200f} \u{61c} \u{2028}\u{2029} \u{feff} \u{ad})");
  EXPECT_EQ(visible("\uffff \U0001fffe \U000e0041"), R"(\u{ffff} \u{1fffe} \u{e0041})");
  EXPECT_EQ(visible_lines("one\n\ttwo\r\x1b"), "one\n\ttwo\\x0d\\x1b");
}

TEST(Visible, bytes_that_are_no_utf8_are_written_out_one_by_one) {
  for (const auto& [bytes, shown] : {std::pair{"\xff", R"(\xff)"},
                                     {"a\xc3", R"(a\xc3)"},
                                     {"\xc3z", R"(\xc3z)"},
                                     {"\x80", R"(\x80)"},
                                     {"\xc0\xaf", R"(\xc0\xaf)"},
                                     {"\xe0\x80\x9b", R"(\xe0\x80\x9b)"},
                                     {"\xed\xa0\x80", R"(\xed\xa0\x80)"},
                                     {"\xf4\x90\x80\x80", R"(\xf4\x90\x80\x80)"},
                                     {"\xf8\x88\x80\x80\x80", R"(\xf8\x88\x80\x80\x80)"}})
    EXPECT_EQ(visible(bytes), shown);
}

TEST(Visible, every_code_point_is_read_as_it_was_written_and_shown_once_and_for_all) {
  std::size_t written_out = 0;
  for (char32_t c = 0; c <= 0x10FFFF; ++c) {
    const std::string text = utf8(c);
    const Character read = first_character(text);
    const bool surrogate = c >= 0xD800 && c <= 0xDFFF;
    ASSERT_EQ(read.is_text, !surrogate) << std::uint32_t{c};
    if (!surrogate) {
      ASSERT_TRUE(read.code == c && read.size == text.size()) << std::uint32_t{c};
    }
    const std::string shown = visible(text);
    written_out += shown != text ? 1 : 0;
    ASSERT_EQ(visible(shown), shown) << std::uint32_t{c};
    ASSERT_EQ(shown == text, is_visible(read)) << std::uint32_t{c};
  }
  // 32 control characters, DEL and 32 more; the others by the table, surrogates, and what is no character.
  constexpr std::size_t kMarks = 1 + 1 + 1 + 1 + 2 + 7 + 16 + 1 + 3 + 128;
  EXPECT_EQ(written_out, 32 + 1 + 32 + kMarks + 2048 + 32 + 2 * 17);
}

TEST(Visible, json_reads_back_as_what_it_was) {
  const std::string text = "##[error] \u009b\u202e\u2028\ufeff \U000e0041 ü ### \x7f";
  const std::string json = nlohmann::json({{"a\u202e", text}}).dump(1, '\t');
  const std::string shown = visible_json(json);
  EXPECT_EQ(nlohmann::json::parse(shown), nlohmann::json::parse(json));
  EXPECT_EQ(visible_lines(shown), shown);
  EXPECT_EQ(shown.find("##"), std::string::npos);
  EXPECT_EQ(visible_json("{\"a\":\"\xff\"}"), R"({"a":"\ufffd"})");
}

}  // namespace
}  // namespace contact::formats
