// What the program prints for people.
#include "tool/run/printing.hpp"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <streambuf>

namespace contact::tool {
namespace {

struct Printing {
  bool quiet = false;
  bool output_is_data = false;
  bool colours = false;
  Colour colour = Colour::automatic;
};

Printing& printing() {
  static Printing chosen;
  return chosen;
}

/// Bold, red, green and plain again: what the reports are coloured with.
constexpr std::array<std::string_view, 4> kColours{"\x1b[1m", "\x1b[31m", "\x1b[32m", "\x1b[0m"};

/// What .NET takes for a space, and so the runner of GitHub at the beginning of a line.
bool is_space(char32_t c) {
  return c == ' ' || c == 0xA0 || c == 0x1680 || (c >= 0x2000 && c <= 0x200A) || c == 0x202F || c == 0x205F ||
         c == 0x3000;
}

/// What of a text is let through, one piece after another. A character comes whole.
class Shown {
 public:
  void add(std::string_view text, std::string& to) {
    while (!text.empty()) {
      // Nearly all is plain text inside a line.
      const auto plain = [](char c) { return c >= ' ' && c <= '~' && c != '#'; };
      const auto run = line_begins_ ? text.begin() : std::find_if_not(text.begin(), text.end(), plain);
      if (const auto size = static_cast<std::size_t>(run - text.begin()); size != 0) {
        to += text.substr(0, size);
        last_ = ' ';
        text.remove_prefix(size);
        continue;
      }
      const auto colour = std::find_if(kColours.begin(), kColours.end(),
                                       [&](std::string_view c) { return printing().colours && text.starts_with(c); });
      if (colour != kColours.end()) {
        to += *colour;
        text.remove_prefix(colour->size());
        continue;
      }
      const formats::Character c = formats::first_character(text);
      const bool is_command = (line_begins_ && c.code == ':') || (last_ == '#' && c.code == '#');
      if (c.code == '\n' || c.code == '\t' || (formats::is_visible(c) && !is_command))
        to += text.substr(0, c.size);
      else
        formats::append_written_out(to, c);
      line_begins_ = c.code == '\n' || (line_begins_ && (c.code == '\t' || is_space(c.code)));
      last_ = c.code;
      text.remove_prefix(c.size);
    }
  }

 private:
  bool line_begins_ = true;
  char32_t last_ = 0;
};

/// Writes to a stream of C what people may be shown.
class Guard final : public std::streambuf {
 public:
  explicit Guard(std::FILE* to) : to_(to) {}

 protected:
  std::streamsize xsputn(const char* text, std::streamsize size) override {
    std::string out;
    shown_.add({text, static_cast<std::size_t>(size)}, out);
    return std::fwrite(out.data(), 1, out.size(), to_) == out.size() ? size : 0;
  }
  int_type overflow(int_type c) override {
    if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
    const char one = traits_type::to_char_type(c);
    return xsputn(&one, 1) == 1 ? c : traits_type::eof();
  }
  int sync() override { return std::fflush(to_) == 0 ? 0 : -1; }

 private:
  std::FILE* to_;
  Shown shown_;
};

}  // namespace

void guard_output() {
  static Guard output(stdout);
  static Guard error(stderr);
  std::cout.rdbuf(&output);
  std::cerr.rdbuf(&error);
}

std::string guarded_text(std::string_view text) {
  std::string out;
  Shown().add(text, out);
  return out;
}

void be_quiet() { printing().quiet = true; }
bool is_quiet() { return printing().quiet; }
void keep_output_for_data() { printing().output_is_data = true; }

std::ostream& words() {
  static std::ostream nowhere(nullptr);
  if (is_quiet()) return nowhere;
  return printing().output_is_data ? std::cerr : std::cout;
}

std::string cut(std::string_view message) {
  constexpr std::size_t kMost = 4096;
  if (message.size() <= kMost) return std::string(message);
  std::size_t end = kMost;
  const auto continues = [&](std::size_t i) { return (static_cast<unsigned char>(message[i]) & 0xc0) == 0x80; };
  while (end > kMost - 4 && continues(end)) --end;
  return fmt::format("{}... ({} bytes)", message.substr(0, end), message.size());
}

void say_decimals(std::uint64_t count, std::string_view whose) {
  if (count == 0 || is_quiet()) return;
  say_error(
      "{} number{} of {} {} written with fewer digits than a binary32 number has, as 14.831459 is for "
      "14.831459045410156: taken as the nearest binary32 number\n",
      count, count == 1 ? "" : "s", whose, count == 1 ? "is" : "are");
}

void choose_colour(Colour colour) { printing().colour = colour; }
Colour chosen_colour() { return printing().colour; }
void let_colours_through() { printing().colours = true; }

}  // namespace contact::tool
