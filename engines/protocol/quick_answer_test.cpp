// The quick reader of answers reads what the careful one reads, and leaves everything else to it.
#include "engines/protocol/quick_answer.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "engines/protocol/protocol.hpp"

namespace contact::engines {
namespace {

/// What the careful reader makes of a line, written canonically; nothing where it refuses.
std::optional<std::string> carefully(const std::string& line) {
  try {
    const formats::Location where{"answer", 0};
    const auto json = formats::parse_object(line, where);
    const formats::Node message(json, where);
    if (op_of(message) != "answer") return std::nullopt;
    return answer_message(seq_of(message), read_answer(message));
  } catch (const formats::InputError&) {
    return std::nullopt;
  }
}

std::optional<std::string> quickly(std::string line) {
  const auto answer = quick_answer(line);
  return answer ? std::optional(answer_message(answer->seq, answer->claim)) : std::nullopt;
}

const std::vector<std::string> kCommon{
    R"({"op":"answer","seq":1,"overlap":true})",
    R"({"op":"answer","seq":18446744073709551615,"overlap":false,"contact":null})",
    R"({"op":"answer","seq":7})",
    R"({"op":"answer","seq":1,"contact":{"value":1e-400}})",
    R"( { "seq" : 3 , "contact" : { } , "op" : "answer" } )",
    R"({"op":"answer","seq":2,"overlap":true,"contact":{"normal":[1,0,-0],"point1":[0.5,1e22,-2.5E-3],)"
    R"("point2":[1e-320,12345678901234567890,0.1],"value":-0.0}})",
    R"({"op":"answer","seq":2,"contact":{"normal":[0,0,1],"depths":[1e-3],"points":[[0.1,2,-3]],"value":-1e-3}})",
    R"({"op":"answer","seq":2,"contact":{"points":[[0,1,2],[3,4,5]],"depths":[0.5,-1]}})",
    R"({"op":"answer","seq":2,"contact":{"value":0.30000000000000004,"point":[9007199254740993,1,1.7976931348623157e308]}})"};

const std::vector<std::string> kOthers{"",
                                       "{}",
                                       "[]",
                                       R"({"op":"answer"})",
                                       R"({"seq":1,"overlap":true})",
                                       R"({"op":"hello","seq":1})",
                                       R"({"op":"answer","seq":01})",
                                       R"({"op":"answer","seq":-1})",
                                       R"({"op":"answer","seq":1.0})",
                                       R"({"op":"answer","seq":1e3})",
                                       R"({"op":"answer","seq":18446744073709551616})",
                                       R"({"op":"answer","seq":1,"seq":1})",
                                       R"({"op":"answer","op":"answer","seq":1})",
                                       R"({"op":"answer","seq":1,"overlap":true,"overlap":true})",
                                       R"({"op":"answer","seq":1,"overlap":1})",
                                       R"({"op":"answer","seq":1,"overlap":truely})",
                                       R"({"op":"answer","seq":1,"contact":null,"contact":{}})",
                                       R"({"op":"answer","seq":1,"contact":{"value":1,"value":1}})",
                                       R"({"op":"answer","seq":1,"contact":{"normal":[1,2]}})",
                                       R"({"op":"answer","seq":1,"contact":{"normal":[1,2,3,4]}})",
                                       R"({"op":"answer","seq":1,"contact":{"value":+1}})",
                                       R"({"op":"answer","seq":1,"contact":{"value":01}})",
                                       R"({"op":"answer","seq":1,"contact":{"value":1.}})",
                                       R"({"op":"answer","seq":1,"contact":{"value":.5}})",
                                       R"({"op":"answer","seq":1,"contact":{"value":1e}})",
                                       R"({"op":"answer","seq":1,"contact":{"value":inf}})",
                                       R"({"op":"answer","seq":1,"contact":{"value":nan}})",
                                       R"({"op":"answer","seq":1,"contact":{"value":0x10}})",
                                       R"({"op":"answer","seq":1,"contact":{"value":1e999}})",
                                       R"({"op":"answer","seq":1,"contact":{"depth":1}})",
                                       R"({"op":"answer","seq":1,"contact":{"points":[],"depths":[]}})",
                                       R"({"op":"answer","seq":1,"contact":{"points":[[1,2,3]]}})",
                                       R"({"op":"answer","seq":1,"contact":{"depths":[1]}})",
                                       R"({"op":"answer","seq":1,"contact":{"points":[[1,2,3]],"depths":[1,2]}})",
                                       R"({"op":"answer","seq":1,"contact":{"points":[[1,2]],"depths":[1]}})",
                                       R"({"op":"answer","seq":1,"overlap":true,})",
                                       R"({"op":"answer","seq":1,"overlap":true}})",
                                       R"({"op":"answer","seq":1,"overlap":true} x)",
                                       R"({"op":"answer","seq":1,"maybe":true})"};

TEST(QuickAnswer, reads_the_common_form_as_the_careful_reader_does) {
  for (const std::string& line : kCommon) {
    ASSERT_TRUE(carefully(line)) << line;
    EXPECT_EQ(quickly(line), carefully(line)) << line;
  }
}

TEST(QuickAnswer, leaves_what_is_malformed_to_the_reader_that_says_why) {
  for (const std::string& line : kOthers) {
    EXPECT_EQ(quickly(line), std::nullopt) << line;
    EXPECT_EQ(carefully(line), std::nullopt) << line;
  }
}

TEST(QuickAnswer, leaves_rare_forms_to_the_careful_reader) {
  for (const char* rest : {R"("error":"boom")", R"("unsupported":"why")", R"("rejected":"alarm")",
                           R"("contact":{"value":"NaN"})", R"("overl\u0061p":true)"}) {
    const std::string line = fmt::format(R"({{"op":"answer","seq":1,{}}})", rest);
    EXPECT_EQ(quickly(line), std::nullopt) << line;
    EXPECT_TRUE(carefully(line)) << line;
  }
}

TEST(QuickAnswer, never_differs_from_the_careful_reader_on_a_damaged_line) {
  std::mt19937_64 random(42);
  constexpr std::string_view kPieces = "\"{}[],:.-+eE0123456789 \t\rtrufalsn\\x\x01\x80";
  int read = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string line = kCommon[random() % kCommon.size()];
    for (std::uint64_t n = random() % 3; n-- > 0;) {
      const std::size_t at = random() % line.size();
      const char piece = kPieces[random() % kPieces.size()];
      if (random() % 3 == 0)
        line.erase(at, 1);
      else if (random() % 2 == 0)
        line.insert(at, 1, piece);
      else
        line[at] = piece;
    }
    if (const auto quick = quickly(line)) {
      ++read;
      EXPECT_EQ(quick, carefully(line)) << line;
    }
  }
  EXPECT_GT(read, 5000);
}

}  // namespace
}  // namespace contact::engines
