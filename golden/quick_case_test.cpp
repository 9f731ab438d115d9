// The quick reader of cases reads what the careful one reads, and leaves everything else to it.
#include "golden/quick_case.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

namespace contact::golden {
namespace {

std::filesystem::path golden() { return std::filesystem::path(CONTACT_SOURCE_DIR) / "golden"; }

/// What the careful reader makes of a line, written canonically; nothing where it refuses.
std::optional<std::string> carefully(const std::string& line, const DatasetHeader& header) {
  try {
    const formats::Location where{"case", 0};
    const auto json = formats::parse_object(line, where);
    return to_line(read_case(formats::Node(json, where), header));
  } catch (const formats::InputError&) {
    return std::nullopt;
  }
}

std::optional<std::string> quickly(std::string line, const DatasetHeader& header) {
  const std::string before = line;
  line.reserve(line.size() + formats::Lines::kRoom);
  const auto c = quick_case(line, header);
  EXPECT_EQ(line, before);
  return c ? std::optional(to_line(*c)) : std::nullopt;
}

struct File {
  DatasetHeader header;
  std::vector<std::string> lines;
};

/// The committed files, their lines without the header.
std::vector<File> files() {
  std::vector<File> all;
  for (const auto& path : dataset_files({golden()})) {
    File file{dataset_header(path), {}};
    std::ifstream stream(path);
    std::string line;
    std::getline(stream, line);
    while (std::getline(stream, line)) file.lines.push_back(line);
    all.push_back(std::move(file));
  }
  return all;
}

TEST(QuickCase, reads_nearly_every_committed_line_as_the_careful_reader_does) {
  std::size_t read = 0;
  std::size_t all = 0;
  for (const File& file : files()) {
    if (file.header.family == "invalid") continue;
    for (const std::string& line : file.lines) {
      ++all;
      if (const auto quick = quickly(line, file.header)) {
        ++read;
        ASSERT_EQ(quick, carefully(line, file.header)) << line;
        ASSERT_EQ(quick, line);
      }
    }
  }
  EXPECT_GT(all, 10000U);
  EXPECT_GT(read, all * 98 / 100);  // the others hold an infinite number, which is a text
}

TEST(QuickCase, leaves_the_family_invalid_to_the_careful_reader) {
  std::size_t left = 0;
  for (const File& file : files()) {
    if (file.header.family != "invalid") continue;
    for (const std::string& line : file.lines) EXPECT_EQ(quickly(line, file.header), std::nullopt);
    left += file.lines.size();
  }
  EXPECT_GT(left, 500U);
}

const std::string kLine =
    R"({"id":"7827fbcb904c1b0d7baa72b0","a":{"center":[0,0,0],"radius":1.5},"b":{"center":[1,2,2],"radius":1.5},)"
    R"("alarm":0,"contact":0.25,"flags":["Touching"],"expect":{"hit":true,"degenerate":false,)"
    R"("normal":[0.3333333333333333,0.6666666666666666,0.6666666666666666],"point1":[0.5,1,1],"point2":[0.5,1,1],)"
    R"("value":-0.25},"exact":{"distance2":"0x9p0","reach":"0x3p0","margin_ulps":0}})";

std::string with(const std::string& from, const std::string& to) {
  std::string line = kLine;
  const auto at = line.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return line.replace(at, from.size(), to);
}

TEST(QuickCase, reads_the_worked_example) {
  ASSERT_EQ(quickly(kLine, {}), kLine);
  EXPECT_EQ(quickly(with(R"("alarm":0)", R"( "alarm" : -0.0 )"), {}), kLine);
}

TEST(QuickCase, leaves_what_is_malformed_to_the_reader_that_says_why) {
  for (const auto& [from, to] :
       std::vector<std::pair<std::string, std::string>>{{"0.25,", "0.25"},
                                                        {"0.25,", "0.25,,"},
                                                        {"0.25", "00.25"},
                                                        {"0.25", ".25"},
                                                        {"0.25", "+0.25"},
                                                        {"0.25", "0.25e"},
                                                        {"0.25", "1e999"},
                                                        {"0.25", "0x1"},
                                                        {"0.25", "inf"},
                                                        {"0.25", "true"},
                                                        {"0.25", "0.25 1"},
                                                        {R"("alarm":0)", R"("alarm":0,"alarm":0)"},
                                                        {R"("alarm":0)", R"("alarms":0)"},
                                                        {R"("alarm":0,)", ""},
                                                        {R"("flags":["Touching"],)", ""},
                                                        {R"("radius":1.5)", R"("radius":1.5,"radius":1.5)"},
                                                        {"[1,2,2]", "[1,2]"},
                                                        {"[1,2,2]", "[1,2,2,2]"},
                                                        {"[1,2,2]", "[1,2,2"},
                                                        {"true", "truely"},
                                                        {"true", "1"},
                                                        {"0x9p0", "0x9\x01p0"},
                                                        {"0x9p0", "0x9\xffp0"},
                                                        {"0x9p0", "0x9\\qp0"},
                                                        {R"(,"margin_ulps":0)", ""},
                                                        {R"("margin_ulps":0}})", R"("margin_ulps":0}}})"},
                                                        {R"("margin_ulps":0}})", R"("margin_ulps":0}} {})"},
                                                        {R"("margin_ulps":0}})", R"("margin_ulps":0})"},
                                                        {R"("expect":{"hit":true)", R"("expect":{"hit":false)"}}) {
    EXPECT_EQ(quickly(with(from, to), {}), std::nullopt) << to;
    EXPECT_EQ(carefully(with(from, to), {}), std::nullopt) << to;
  }
}

TEST(QuickCase, leaves_rare_forms_to_the_careful_reader) {
  for (const auto& [from, to] :
       std::vector<std::pair<std::string, std::string>>{{R"("alarm":0,"contact":0.25)", R"("contact":0.25,"alarm":0)"},
                                                        {R"("alarm")", R"("\u0061larm")"},
                                                        {R"("margin_ulps":0)", R"("margin_ulps":"Infinity")"}}) {
    EXPECT_EQ(quickly(with(from, to), {}), std::nullopt) << to;
    EXPECT_TRUE(carefully(with(from, to), {})) << to;
  }
}

// simdjson 3.0.1 reads 0.20020459733272703688 as 0.0157...: digits that overflow, one more than it counts.
TEST(QuickCase, reads_no_number_of_20_digits_as_another) {
  for (const std::string digits : {"0.20020459733272703688", "0.18446744073709551616", "0.00020020459733272703688",
                                   "0.99999999999999999999", "2.0020459733272703688", "0.20020459733272703688e-5"}) {
    const std::string line = with(R"("contact":0.25)", R"("contact":)" + digits);
    if (const auto quick = quickly(line, {})) {
      EXPECT_EQ(quick, carefully(line, {})) << line;
    }
  }
  const std::string ordinary = with(R"("contact":0.25)", R"("contact":0.00012345678901234567)");
  EXPECT_EQ(quickly(ordinary, {}), carefully(ordinary, {}));
  EXPECT_TRUE(quickly(ordinary, {}));
}

TEST(QuickCase, never_differs_from_the_careful_reader_on_a_damaged_line) {
  std::mt19937_64 random(42);
  constexpr std::string_view kPieces = "\"{}[],:.-+eE0123456789 \t\rtrufalsn\\x\x01\x80";
  const std::vector<File> all = files();
  int read = 0;
  int refused = 0;
  for (int i = 0; i < 30000; ++i) {
    const File& file = all[random() % all.size()];
    std::string line = file.lines[random() % file.lines.size()];
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
    const auto quick = quickly(line, file.header);
    const auto careful = carefully(line, file.header);
    refused += careful ? 0 : 1;
    if (!quick) continue;
    ++read;
    ASSERT_EQ(quick, careful) << line;
  }
  EXPECT_GT(read, 10000);
  EXPECT_GT(refused, 5000);
}

}  // namespace
}  // namespace contact::golden
