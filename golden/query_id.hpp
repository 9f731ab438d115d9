// The identity of a question: the beginning of a SHA-256.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "oracle/truth/query.hpp"

namespace contact::golden {

/// The first 24 hexadecimal digits of SHA-256 over the pair's name in ASCII, one zero byte, and every number as
/// big-endian binary64 in the canonical order.
[[nodiscard]] std::string query_id(const Query& query);
inline constexpr std::size_t kIdLength = 24;
/// The same without memory of its own, for whoever only compares it.
[[nodiscard]] std::array<char, kIdLength> query_id_digits(const Query& query);
/// Whether a text could be the id of some question.
[[nodiscard]] bool is_query_id(std::string_view text);

/// `count` of an id's digits, 16 at most, from `first` on, as a number.
[[nodiscard]] std::uint64_t id_digits(std::string_view id, std::size_t first, std::size_t count);

}  // namespace contact::golden
