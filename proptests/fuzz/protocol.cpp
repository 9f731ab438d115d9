// A line of the engine protocol, from either side, is refused or read; what is read is written again as it stood.
#include "golden/protocol.hpp"

#include "fuzz/fuzz.hpp"
#include "golden/input_error.hpp"

namespace contact::fuzz {
namespace {

void try_line(std::string_view line) {
  const golden::Location where{"message", 1};
  const auto again = [&](const std::string& text, auto read) {
    try {
      const auto json = golden::parse_object(text, where);
      return read(golden::Node(json, where));
    } catch (const golden::InputError& error) {
      fail(text + " was written and is refused: " + error.what());
    }
  };
  try {
    const auto json = golden::parse_object(line, where);
    const golden::Node message(json, where);
    const std::string op = golden::op_of(message);
    if (op == "hello") {
      const std::string text = golden::hello_line(golden::read_hello(message));
      require(golden::hello_line(again(text, golden::read_hello)) == text, text);
    } else if (op == "answer") {
      const std::string text = golden::answer_message(golden::seq_of(message), golden::read_answer(message));
      require(golden::answer_message(again(text, golden::seq_of), again(text, golden::read_answer)) == text, text);
    } else if (op == "query") {
      const std::string text = golden::query_message(golden::seq_of(message), golden::read_question(message));
      require(golden::query_message(again(text, golden::seq_of), again(text, golden::read_question)) == text, text);
    }
  } catch (const golden::InputError&) {
  }
}

}  // namespace

void try_input(Bytes bytes) {
  std::string_view text = text_of(bytes);
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    try_line(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
}

}  // namespace contact::fuzz
