// Numbers out of input become integers, or are refused by file, line, field and value.
#include "formats/whole_number.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

namespace contact::formats {
namespace {

template <class To>
void expect_none(std::initializer_list<double> numbers) {
  for (const double x : numbers) EXPECT_FALSE(whole_number<To>(x).has_value()) << x;
}

TEST(WholeNumber, of_a_double_is_the_integer_that_it_is_and_no_other) {
  EXPECT_EQ(whole_number<int>(2147483647.0), 2147483647);
  EXPECT_EQ(whole_number<int>(-2147483648.0), -2147483647 - 1);
  EXPECT_EQ(whole_number<int>(-0.0), 0);
  expect_none<int>({2147483648.0, -2147483649.0, 3e9, 4e9, 1e300, -1e300, 0.5, -0.5, 1e-300,
                    std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                    std::numeric_limits<double>::quiet_NaN()});
  // The largest double below 2^64, and 2^64, to which the largest integer would round.
  EXPECT_EQ(whole_number<std::uint64_t>(0x1.fffffffffffffp63), 0xfffffffffffff800U);
  expect_none<std::uint64_t>({0x1p64, -1.0});
  EXPECT_EQ(whole_number<std::int64_t>(-0x1p63), std::numeric_limits<std::int64_t>::min());
  expect_none<std::int64_t>({0x1p63});
}

TEST(WholeNumber, of_an_integer_is_the_same_integer) {
  EXPECT_EQ(whole_number<std::uint32_t>(std::uint64_t{0xffffffff}), 0xffffffffU);
  EXPECT_FALSE(whole_number<std::uint32_t>(std::uint64_t{1} << 32).has_value());
  EXPECT_FALSE(whole_number<std::uint32_t>(std::int64_t{-1}).has_value());
  EXPECT_FALSE(whole_number<std::int64_t>(std::numeric_limits<std::uint64_t>::max()).has_value());
}

TEST(WholeNumber, of_a_text_is_all_of_it) {
  EXPECT_EQ(whole_number<std::uint64_t>(std::string_view("18446744073709551615")), 18446744073709551615U);
  EXPECT_EQ(whole_number<int>(std::string_view("-7")), -7);
  for (const std::string_view text : {"", " 1", "1 ", "+1", "-", "-1", "1.0", "1e3", "0x1", "18446744073709551616"})
    EXPECT_FALSE(whole_number<std::uint64_t>(text).has_value()) << text;
}

TEST(WholeNumber, that_is_none_is_refused_by_file_line_field_and_value) {
  const Location where{"scene.scn", 7};
  EXPECT_EQ(require_whole_number<int>(3.0, where, "n", 1, 3), 3);
  for (const double x : {0.0, 4.0})
    EXPECT_THROW(static_cast<void>(require_whole_number<int>(x, where, "n", 1, 3)), InputError);
  try {
    static_cast<void>(require_whole_number<int>(3e9, where, "group"));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(
        error.what(),
        std::string("scene.scn:7: group: expected a whole number from -2147483648 to 2147483647, got 3000000000"));
  }
}

}  // namespace
}  // namespace contact::formats
