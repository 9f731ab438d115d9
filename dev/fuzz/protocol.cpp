// A line of the engine protocol, from either side, is refused or read; what is read is written again as it stood.
#include "engines/protocol/protocol.hpp"

#include <nlohmann/json.hpp>
#include "formats/input_error.hpp"
#include "fuzz/fuzz.hpp"

namespace contact::fuzz::protocol {
namespace {

void try_line(std::string_view line) {
  const formats::Location where{"message", 1};
  const auto again = [&](const std::string& text, auto read) {
    try {
      const auto json = formats::parse_object(text, where);
      return read(formats::Node(json, where));
    } catch (const formats::InputError& error) {
      fail(text + " was written and is refused: " + error.what());
    }
  };
  try {
    const auto json = formats::parse_object(line, where);
    const formats::Node message(json, where);
    const std::string op = engines::op_of(message);
    if (op == "hello") {
      const std::string text = engines::hello_line(engines::read_hello(message));
      require(engines::hello_line(again(text, engines::read_hello)) == text, text);
    } else if (op == "answer") {
      const std::string text = engines::answer_message(engines::seq_of(message), engines::read_answer(message));
      require(engines::answer_message(again(text, engines::seq_of), again(text, engines::read_answer)) == text, text);
    } else if (op == "query") {
      const std::string text = engines::query_message(engines::seq_of(message), engines::read_question(message));
      require(engines::query_message(again(text, engines::seq_of), again(text, engines::read_question)) == text, text);
    }
  } catch (const formats::InputError&) {
  }
}

void try_input(Bytes bytes) {
  std::string_view text = text_of(bytes);
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    try_line(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
}

const Target target("protocol", try_input);

}  // namespace
}  // namespace contact::fuzz::protocol
