// The identity of a question: the beginning of a SHA-256.
#include "golden/query_id.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <concepts>
#include <cstring>

#include "formats/sha256.hpp"
#include "golden/answer_bytes.hpp"

namespace contact::golden {
namespace {

constexpr std::size_t kLongestName = [] {
  std::size_t longest = 0;
  for (const std::string_view name : kPairNames) longest = std::max(longest, name.size());
  return longest;
}();
/// The longest name, one zero byte, the numbers of the two shapes that have most of them, how many vertices each has, and two distances.
#define CONTACT_NUMBERS(A, B) kNumbersOf<A> + kNumbersOf<B>,
constexpr std::size_t kLongestCanonical =
    kLongestName + 1 + 8 * (4 + static_cast<std::size_t>(std::max({CONTACT_KINDS(CONTACT_NUMBERS)})));
#undef CONTACT_NUMBERS

}  // namespace

std::array<char, kIdLength> query_id_digits(const Query& query) {
  // No text on the way: every question of a run has its id computed and compared.
  std::array<unsigned char, kLongestCanonical> bytes;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  auto at = std::copy(name(query.pair).begin(), name(query.pair).end(), bytes.begin());
  *at++ = 0;
  const auto put = [&](double x) {
    std::uint64_t bits = canonical_bits(x);
    if constexpr (std::endian::native == std::endian::little) bits = __builtin_bswap64(bits);  // the first byte first
    std::memcpy(at, &bits, sizeof bits);
    at += sizeof bits;
  };
  if (has_hull(query.pair))
    for_each_value(query, [&]<class Value>(const Value& value) {
      if constexpr (AnyNumberOfVectors<Value>) put(static_cast<double>(value.size()));
      for_each_number_in(value, put);
    });
  else
    for_each_number_unnamed(query, put);
  const auto digest = formats::Sha256::digest_of(
      {reinterpret_cast<const char*>(bytes.data()), static_cast<std::size_t>(at - bytes.begin())});
  std::array<char, kIdLength> id;
  for (std::size_t i = 0; i < id.size(); ++i) id[i] = "0123456789abcdef"[digest[i / 2] >> (i % 2 == 0 ? 4 : 0) & 15];
  return id;
}

std::string query_id(const Query& query) {
  const auto id = query_id_digits(query);
  return {id.data(), id.size()};
}

bool is_query_id(std::string_view text) {
  return text.size() == kIdLength && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

std::uint64_t id_digits(std::string_view id, std::size_t first, std::size_t count) {
  const std::string_view digits = id.substr(first, count);
  std::uint64_t number = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), number, 16);
  return number;
}

}  // namespace contact::golden
