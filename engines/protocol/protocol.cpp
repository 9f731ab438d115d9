// The engine protocol on paper.
#include "engines/protocol/protocol.hpp"

#include <fmt/format.h>

#include "golden/dataset.hpp"

namespace contact::engines {

std::string hello_line() { return fmt::format(R"({{"op":"hello","protocol":{}}})", kProtocol); }

std::string hello_line(const EngineInfo& engine) {
  return fmt::format(R"({{"op":"hello","protocol":{},{}}})", kProtocol, engine_text(engine));
}

std::string query_message(std::uint64_t seq, const Query& query) {
  return fmt::format(R"({{"op":"query","seq":{},"pair":"{}",{}}})", seq, name(query.pair), golden::inputs_text(query));
}

std::string answer_message(std::uint64_t seq, const Claim& claim) {
  return fmt::format(R"({{"op":"answer","seq":{}{}}})", seq, claim_text(claim));
}

std::string op_of(const formats::Node& message) { return message.at("op").text(); }

EngineInfo read_hello(const formats::Node& message) {
  if (const formats::Node op = message.at("op"); op.text() != "hello") op.refuse("expected \"hello\"");
  if (const formats::Node protocol = message.at("protocol"); protocol.count() != kProtocol)
    protocol.refuse(fmt::format("this program speaks protocol {}", kProtocol));
  return read_engine_info(message, {"op", "protocol"});
}

std::uint64_t seq_of(const formats::Node& message) { return message.at("seq").count(); }

Claim read_answer(const formats::Node& message) {
  message.allow_only({"op", "seq", "overlap", "contact", "unsupported", "rejected", "error"});
  return read_claim(message);
}

Query read_question(const formats::Node& message) {
  message.allow_only({"op", "seq", "pair", "a", "b", "alarm", "contact"});
  return golden::read_inputs(message, golden::read_pair(message.at("pair")));
}

}  // namespace contact::engines
