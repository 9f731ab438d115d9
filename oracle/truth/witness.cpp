// The spelling of exact numbers, looked at without any arithmetic but that a fraction is a reduced one.
#include "oracle/truth/witness.hpp"

#include <gmpxx.h>

namespace contact::oracle {

namespace {

/// The value of a digit; of whatever is none, more than any base. A table, because every number of a file is looked at.
constexpr auto kDigit = [] {
  std::array<unsigned char, 256> value{};
  value.fill(255);
  for (unsigned char i = 0; i < 16; ++i) value[static_cast<unsigned char>("0123456789abcdef"[i])] = i;
  return value;
}();

}  // namespace

bool is_exact_string(std::string_view text) {
  if (text == "0x0p0") return true;
  const auto skip = [&text](char c) {
    const bool there = text.starts_with(c);
    if (there) text.remove_prefix(1);
    return there;
  };
  const auto digits = [&text](unsigned base) {
    std::size_t size = 0;
    while (size < text.size() && kDigit[static_cast<unsigned char>(text[size])] < base) ++size;
    const std::string_view taken = text.substr(0, size);
    text.remove_prefix(size);
    return taken;
  };
  // Empty where it is even, begins with 0, or is none.
  const auto odd = [&] {
    if (!skip('0') || !skip('x')) return std::string_view();
    const std::string_view integer = digits(16);
    const bool is_odd =
        !integer.empty() && integer.front() != '0' && kDigit[static_cast<unsigned char>(integer.back())] % 2 != 0;
    return is_odd ? integer : std::string_view();
  };
  skip('-');
  const std::string_view numerator = odd();
  if (numerator.empty() || !skip('p')) return false;
  const bool negative = skip('-');
  const std::string_view exponent = digits(10);
  if (exponent.empty() || (exponent.front() == '0' && (negative || exponent.size() > 1))) return false;
  if (text.empty()) return true;
  if (!skip('/')) return false;
  const std::string_view denominator = odd();
  if (denominator.empty() || denominator == "1" || !text.empty()) return false;
  return gcd(mpz_class(std::string(numerator), 16), mpz_class(std::string(denominator), 16)) == 1;
}

}  // namespace contact::oracle
