// The host of engines in processes of their own: whatever they do, each question gets its claim, in time, and nothing
// is left behind.
#include "engines/hosts/subprocess.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cctype>
#include <chrono>
#include <ostream>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "engines/hosts/child_process.hpp"

namespace contact::engines {
namespace {

using Status = Claim::Status;
using std::chrono::milliseconds;

SubprocessOptions misbehaving(const std::string& mode) {
  SubprocessOptions options;
  options.command = {CONTACT_PYTHON, std::string(CONTACT_SOURCE_DIR) + "/engines/hosts/misbehaving_engine.py", mode};
  // On a busy machine Python alone takes seconds to start, and a right answer may: only what never comes has a short limit.
  const auto hangs = [&](std::string_view words) { return mode.find(words) != std::string::npos; };
  options.start = std::chrono::minutes(5);
  options.answer = hangs("hangs") || hangs("stops reading") || hangs("half a line")
                       ? milliseconds(1500)
                       : milliseconds(std::chrono::minutes(5));
  options.window = 8;
  options.longest_line = 100000;
  return options;
}

/// Unit spheres n apart: hits up to 2. The question of index 5 has the contact distance 13.
std::vector<Question> questions(int count) {
  std::vector<Question> all;
  for (int i = 0; i < count; ++i) {
    const Query query{
        Pair::sphere_sphere, Balls{{{0, 0, 0}, 1}, {{static_cast<double>(i % 4), 0, 0}, 1}}, {0, i == 5 ? 13.0 : 0.0}};
    all.push_back({std::to_string(i), query});
  }
  return all;
}

void expect_answered(const std::vector<Claim>& claims, std::size_t i) {
  EXPECT_EQ(claims[i].status, Status::answered) << i << ": " << claims[i].text;
  EXPECT_EQ(claims[i].overlap, std::optional(i % 4 <= 2)) << i;
}

/// Nothing of this program's children is left, dead or alive.
void expect_no_children() {
  errno = 0;
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

struct Misbehaviour {
  const char* mode;
  const char* text;               ///< within that of question 5, or of the start
  Status status = Status::error;  ///< of question 5

  friend void PrintTo(const Misbehaviour& m, std::ostream* out) { *out << m.mode; }
};

/// A mode as the name of a test.
std::string as_name(const testing::TestParamInfo<const char*>& instance) {
  std::string name = instance.param;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name;
}
std::string mode_as_name(const testing::TestParamInfo<Misbehaviour>& instance) {
  return as_name({instance.param.mode, instance.index});
}

class OneBadQuestion : public testing::TestWithParam<Misbehaviour> {};

TEST_P(OneBadQuestion, is_named_and_the_others_are_answered) {
  const auto [mode, text, status] = GetParam();
  {
    const auto engine = make_subprocess(misbehaving(mode));
    const auto claims = engine->answer(questions(40));
    ASSERT_EQ(claims.size(), 40U);
    EXPECT_EQ(claims[5].status, status) << claims[5].text;
    EXPECT_NE(claims[5].text.find(text), std::string::npos) << claims[5].text;
    for (std::size_t i = 0; i < claims.size(); ++i)
      if (i != 5) expect_answered(claims, i);
  }
  expect_no_children();
}

INSTANTIATE_TEST_SUITE_P(
    Subprocess, OneBadQuestion,
    testing::Values(
        Misbehaviour{"exits at 13", "the engine exited with status 3; its standard error ends in 'out of cheese'",
                     Status::crash},
        Misbehaviour{"is killed at 13", "was killed by signal 6 (Aborted)", Status::crash},
        Misbehaviour{"hangs at 13", "no answer within 1.5 s", Status::timeout},
        Misbehaviour{"stops reading at 13", "no answer within 1.5 s", Status::timeout},
        Misbehaviour{"malformed at 13", "overlap"}, Misbehaviour{"garbage at 13", "malformed JSON"},
        Misbehaviour{"invalid UTF-8 at 13", "UTF-8"},
        Misbehaviour{"half a line at 13", "half a line: '{\"op\":\"answer\",\"se'", Status::timeout},
        Misbehaviour{"half a line, then exits at 13", "exited with status 0 after half a line", Status::crash},
        Misbehaviour{"endless line at 13", "a line of more than 100000 bytes"},
        Misbehaviour{"wrong seq at 13", "was not asked"}),
    mode_as_name);

class Survives : public testing::TestWithParam<const char*> {};

TEST_P(Survives, every_question_is_answered) {
  {
    const auto engine = make_subprocess(misbehaving(GetParam()));
    const auto claims = engine->answer(questions(40));
    for (std::size_t i = 0; i < claims.size(); ++i) expect_answered(claims, i);
  }
  expect_no_children();
}
INSTANTIATE_TEST_SUITE_P(Subprocess, Survives,
                         testing::Values("well behaved", "noisy", "backwards", "leaves a grandchild"), as_name);

TEST(Subprocess, an_answer_that_comes_twice_is_the_error_of_its_own_question) {
  for (const char* mode : {"repeats at 13", "floods at 13"})
    for (const std::size_t window : {1U, 8U, 256U}) {
      SubprocessOptions options = misbehaving(mode);
      options.window = window;
      const auto claims = make_subprocess(options)->answer(questions(40));
      EXPECT_EQ(claims[5].status, Status::error) << mode << ", window " << window;
      EXPECT_NE(claims[5].text.find("was answered before"), std::string::npos) << claims[5].text;
      for (std::size_t i = 0; i < claims.size(); ++i)
        if (i != 5) expect_answered(claims, i);
    }
  expect_no_children();
}

TEST(Subprocess, an_engine_that_answers_everything_twice_counts_as_dead) {
  const auto claims = make_subprocess(misbehaving("repeats everything"))->answer(questions(40));
  for (std::size_t i = 0; i < claims.size(); ++i)
    EXPECT_EQ(claims[i].status, i < 3 ? Status::error : Status::missing) << i << ": " << claims[i].text;
}

class NoHarness : public testing::TestWithParam<Misbehaviour> {};

TEST_P(NoHarness, is_told_at_once_and_why) {
  SubprocessOptions options = misbehaving(GetParam().mode);
  // Only those that never end their hello are to run out of time, however busy the machine.
  if (std::string_view(GetParam().mode) == "says nothing") options.start = milliseconds(700);
  if (std::string_view(GetParam().mode) == "half a hello") options.start = std::chrono::seconds(5);
  try {
    (void)make_subprocess(options);
    FAIL() << "expected HarnessInvalid";
  } catch (const HarnessInvalid& error) {
    EXPECT_NE(std::string(error.what()).find(GetParam().text), std::string::npos) << error.what();
  }
  expect_no_children();
}
INSTANTIATE_TEST_SUITE_P(Subprocess, NoHarness,
                         testing::Values(Misbehaviour{"exits at once", "the engine exited with status 7"},
                                         Misbehaviour{"says nothing", "no hello within 0.7 s"},
                                         Misbehaviour{"is killed at once", "was killed by signal 11"},
                                         Misbehaviour{"closes its output", "closed its output"},
                                         Misbehaviour{"garbage hello", "'Welcome to my engine 1.0!'"},
                                         Misbehaviour{"wrong protocol", "this program speaks protocol 1"},
                                         Misbehaviour{"unknown pair", "sphere_torus"},
                                         Misbehaviour{"half a hello", "half a line: '{\"op\":\"hello\",\"pro'"},
                                         Misbehaviour{"claims nothing", "claims nothing"},
                                         Misbehaviour{"malformed smoke", "overlap"}),
                         mode_as_name);

TEST(Subprocess, a_program_that_is_not_there_is_named) {
  SubprocessOptions options;
  options.command = {"/nowhere/engine"};
  try {
    (void)make_subprocess(options);
    FAIL();
  } catch (const HarnessInvalid& error) {
    EXPECT_STREQ(error.what(), "cannot start '/nowhere/engine': no such file or directory");
  }
}

TEST(Subprocess, after_three_failures_in_a_row_an_engine_counts_as_dead) {
  for (const auto& [mode, status] : {std::pair{"always exits", Status::crash}, {"always hangs", Status::timeout}}) {
    const auto engine = make_subprocess(misbehaving(mode));
    const auto claims = engine->answer(questions(40));
    int failed = 0;
    int missing = 0;
    for (const Claim& claim : claims) {
      failed += claim.status == status ? 1 : 0;
      missing += claim.status == Status::missing ? 1 : 0;
    }
    EXPECT_EQ(failed, 3) << mode;
    EXPECT_EQ(missing, 37) << mode;
  }
  expect_no_children();
}

TEST(Subprocess, an_engine_that_stops_reading_blocks_nobody) {
  // Far more than a pipe holds, all in flight at once.
  SubprocessOptions options = misbehaving("always hangs");
  options.window = 100000;
  const auto engine = make_subprocess(options);
  const auto claims = engine->answer(questions(5000));
  EXPECT_EQ(claims[0].status, Status::timeout);
  EXPECT_EQ(claims[4999].status, Status::missing);
}

TEST(ChildProcess, is_not_waited_for_beyond_a_deadline_however_long_nobody_looked_at_it) {
  ChildProcess silent({"sleep", "60"}, 1000, {});
  std::this_thread::sleep_for(milliseconds(300));  // as on a busy machine
  ::alarm(30);                                     // ends this program, where it is waited for until it ends
  std::string line;
  EXPECT_EQ(silent.next_line(line, ChildProcess::Clock::now() + milliseconds(200)), ChildProcess::Event::timeout);
  ::alarm(0);
}

TEST(Subprocess, waiting_can_be_interrupted) {
  struct Stop {};
  SubprocessOptions options = misbehaving("always hangs");
  options.answer = std::chrono::minutes(1);
  int checks = 0;
  options.check = [&] {
    if (++checks == 20) throw Stop{};
  };
  EXPECT_THROW((void)make_subprocess(options)->answer(questions(3)), Stop);
  expect_no_children();
}

TEST(SplitWords, splits_as_a_shell_does_and_expands_nothing) {
  using Words = std::vector<std::string>;
  EXPECT_EQ(split_words("python3 engine.py  --fast"), (Words{"python3", "engine.py", "--fast"}));
  EXPECT_EQ(split_words(R"('a b' "c d" e\ f)"), (Words{"a b", "c d", "e f"}));
  EXPECT_EQ(split_words(R"('a\b' "a\b" "a\"b" a\b)"), (Words{R"(a\b)", R"(a\b)", R"(a"b)", "ab"}));
  EXPECT_EQ(split_words(R"(x'y'"z" '' "")"), (Words{"xyz", "", ""}));
  EXPECT_EQ(split_words("$HOME *.py ~"), (Words{"$HOME", "*.py", "~"}));
  EXPECT_EQ(split_words("   "), Words{});
  EXPECT_THROW((void)split_words("'open"), std::invalid_argument);
  EXPECT_THROW((void)split_words("open\\"), std::invalid_argument);
}

TEST(QuotedWord, is_read_back_as_the_word_and_quotes_only_where_it_must) {
  for (const char* word :
       {"", "a b", "it's", "''", R"("a\b")", "$HOME", "*.py", "~", "#", "a;b", "-x=1", "\n", "!", "&|<>(){}[]?`"})
    EXPECT_EQ(split_words("x " + quoted_word(word) + " y"), (std::vector<std::string>{"x", word, "y"})) << word;
  EXPECT_EQ(quoted_word("engines/a-b_1.py:2"), "engines/a-b_1.py:2");
}

}  // namespace
}  // namespace contact::engines
