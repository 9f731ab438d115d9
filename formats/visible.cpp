// Text from outside as people are shown it.
#include "formats/visible.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace contact::formats {
namespace {

constexpr char32_t kDelete = 0x7F;
constexpr char32_t kFirstPrintable = 0x20;

bool is_plain(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte >= kFirstPrintable && byte < kDelete;
}

struct Range {
  char32_t first;
  char32_t last;
};
/// What has no look of its own, beyond ASCII, in order. Joiners (U+200C, U+200D) and variation selectors are not here:
/// words of some languages and pictures are made with them.
constexpr std::array kHidden{
    Range{0x80, 0x9F},        // the second control characters
    Range{0xAD, 0xAD},        // soft hyphen
    Range{0x61C, 0x61C},      // mark of direction
    Range{0x180E, 0x180E},    // a space without a width
    Range{0x200B, 0x200B},    // likewise
    Range{0x200E, 0x200F},    // marks of direction
    Range{0x2028, 0x202E},    // separators of lines and paragraphs, marks of direction
    Range{0x2060, 0x206F},    // a joiner, what mathematics does not show, marks of direction
    Range{0xFDD0, 0xFDEF},    // no characters
    Range{0xFEFF, 0xFEFF},    // the mark of a byte order
    Range{0xFFF9, 0xFFFB},    // marks of annotations
    Range{0xE0000, 0xE007F},  // tags
};

/// `text` with what `is_shown` does not let through written out.
template <class IsShown>
std::string written_out(std::string_view text, IsShown is_shown) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const Character c = first_character(text.substr(at));
    if (is_shown(c))
      out += text.substr(at, c.size);
    else
      append_written_out(out, c);
    at += c.size;
  }
  return out;
}

}  // namespace

Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const char32_t first = byte(0);
  const Character none{first, 1, false};
  if (first < 0x80) return {first, 1, true};
  // Of so many bytes; what could be written with fewer is not written so.
  struct Form {
    unsigned char mask;
    unsigned char lead;
    char32_t least;
  };
  constexpr std::array kForms{Form{0xE0, 0xC0, 0x80}, Form{0xF0, 0xE0, 0x800}, Form{0xF8, 0xF0, 0x10000}};
  for (std::size_t more = 1; more <= kForms.size(); ++more) {
    const Form& form = kForms[more - 1];
    if ((first & form.mask) != form.lead) continue;
    if (text.size() <= more) return none;
    char32_t code = first & static_cast<unsigned char>(~form.mask);
    for (std::size_t i = 1; i <= more; ++i) {
      if ((byte(i) & 0xC0) != 0x80) return none;
      code = code << 6 | (byte(i) & 0x3FU);
    }
    const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
    if (code < form.least || surrogate || code > 0x10FFFF) return none;
    return {code, more + 1, true};
  }
  return none;
}

bool is_visible(const Character& c) {
  if (!c.is_text) return false;
  if (c.code < 0x80) return is_plain(static_cast<char>(c.code));
  if ((c.code & 0xFFFE) == 0xFFFE) return false;  // no characters, the last two of every plane
  const auto* range =
      std::find_if(kHidden.begin(), kHidden.end(), [&](const Range& hidden) { return c.code <= hidden.last; });
  return range == kHidden.end() || c.code < range->first;
}

void append_written_out(std::string& to, const Character& c) {
  if (!c.is_text || c.code < 0x80)
    fmt::format_to(std::back_inserter(to), "\\x{:02x}", static_cast<std::uint32_t>(c.code));
  else
    fmt::format_to(std::back_inserter(to), "\\u{{{:x}}}", static_cast<std::uint32_t>(c.code));
}

std::string visible(std::string_view text) {
  if (std::all_of(text.begin(), text.end(), is_plain)) return std::string(text);
  return written_out(text, is_visible);
}

std::string visible_lines(std::string_view text) {
  const auto is_of_lines = [](char32_t c) { return c == '\n' || c == '\t'; };
  if (std::all_of(text.begin(), text.end(),
                  [&](char c) { return is_plain(c) || is_of_lines(static_cast<unsigned char>(c)); }))
    return std::string(text);
  return written_out(text, [&](const Character& c) { return is_visible(c) || is_of_lines(c.code); });
}

std::string visible_json(std::string text) {
  // Outside of texts JSON has nothing of this but line feeds and tabs, and inside it has them written out already.
  const auto strange = [](char c) { return !is_plain(c) && c != '\n' && c != '\t'; };
  bool any = false;  // looked for without a stop, which takes a fraction of the time: there may be gigabytes of it
  for (const char c : text) any |= strange(c);
  if (!any && text.find("##") == std::string::npos) return text;
  std::string out;
  out.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const std::string_view rest = std::string_view(text).substr(at);
    const Character c = first_character(rest);
    at += c.size;
    const auto put = [&](std::uint32_t unit) { fmt::format_to(std::back_inserter(out), "\\u{:04x}", unit); };
    if (c.code == '#' && out.ends_with('#'))
      put('#');
    else if (is_visible(c) || !strange(rest.front()))
      out += rest.substr(0, c.size);
    else if (!c.is_text)
      put(0xFFFD);
    else if (c.code < 0x10000)
      put(static_cast<std::uint32_t>(c.code));
    else
      put(0xD800 + static_cast<std::uint32_t>((c.code - 0x10000) >> 10)),
          put(0xDC00 + static_cast<std::uint32_t>((c.code - 0x10000) & 0x3FF));
  }
  return out;
}

}  // namespace contact::formats
