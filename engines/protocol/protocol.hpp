// The engine protocol on paper: the messages that host and engine exchange, a JSON object a line.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "engines/protocol/results.hpp"
#include "oracle/truth/query.hpp"

namespace contact::engines {

inline constexpr std::uint64_t kProtocol = 1;

/// {"op":"hello","protocol":1}, and the same with what an engine declares.
[[nodiscard]] std::string hello_line();
[[nodiscard]] std::string hello_line(const EngineInfo& engine);
/// {"op":"query","seq":1,"pair":...}. NaN and infinities, which only the family `invalid` asks, are strings.
[[nodiscard]] std::string query_message(std::uint64_t seq, const Query& query);
/// {"op":"answer","seq":1,...}
[[nodiscard]] std::string answer_message(std::uint64_t seq, const Claim& claim);

/// A message's "op".
[[nodiscard]] std::string op_of(const formats::Node& message);
/// What an engine declares in its hello. Throws formats::InputError, also where it speaks another version.
[[nodiscard]] EngineInfo read_hello(const formats::Node& message);
/// The "seq" of an answer or a query.
[[nodiscard]] std::uint64_t seq_of(const formats::Node& message);
/// The claim of an answer.
[[nodiscard]] Claim read_answer(const formats::Node& message);
/// The question of a query, whatever its numbers are.
[[nodiscard]] Query read_question(const formats::Node& message);

}  // namespace contact::engines
