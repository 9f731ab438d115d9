// The common form of an engine's answer, read in one pass over the text.
#include "engines/protocol/quick_answer.hpp"

#include <charconv>
#include <utility>

namespace contact::engines {
namespace {

/// Each function takes its piece of the text and says whether it was there in the common form.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : at_(text.data()), end_(text.data() + text.size()) {}

  [[nodiscard]] bool at_end() {
    skip_space();
    return at_ == end_;
  }

  bool take(char c) {
    skip_space();
    if (at_ == end_ || *at_ != c) return false;
    ++at_;
    return true;
  }

  bool word(std::string_view expected) {
    skip_space();
    if (!std::string_view(at_, static_cast<std::size_t>(end_ - at_)).starts_with(expected)) return false;
    at_ += expected.size();
    return true;
  }

  /// A string of letters, digits and underscores.
  bool name(std::string_view& text) {
    if (!take('"')) return false;
    const char* start = at_;
    while (at_ != end_ && (is_digit(*at_) || *at_ == '_' || (*at_ >= 'a' && *at_ <= 'z'))) ++at_;
    text = {start, static_cast<std::size_t>(at_ - start)};
    return at_ != end_ && *at_++ == '"';
  }

  bool count(std::uint64_t& n) {
    skip_space();
    const char* start = at_;
    if (!digits() || (*start == '0' && at_ - start > 1)) return false;
    if (at_ != end_ && (*at_ == '.' || *at_ == 'e' || *at_ == 'E')) return false;
    return std::from_chars(start, at_, n).ec == std::errc();
  }

  bool boolean(std::optional<bool>& value) {
    if (word("true")) value = true;
    if (!value && word("false")) value = false;
    return value.has_value();
  }

  /// A number by JSON's grammar, which from_chars alone does not hold to.
  bool number(double& x) {
    skip_space();
    const char* start = at_;
    if (at_ != end_ && *at_ == '-') ++at_;
    const char* whole = at_;
    if (!digits() || (*whole == '0' && at_ - whole > 1)) return false;
    if (at_ != end_ && *at_ == '.') {
      ++at_;
      if (!digits()) return false;
    }
    if (at_ != end_ && (*at_ == 'e' || *at_ == 'E')) {
      ++at_;
      if (at_ != end_ && (*at_ == '+' || *at_ == '-')) ++at_;
      if (!digits()) return false;
    }
    if (std::from_chars(start, at_, x).ec != std::errc()) return false;
    if (x == 0) x = 0;
    return true;
  }

  bool vector(std::optional<Vector3>& v) {
    Vector3& three = v.emplace();
    return take('[') && number(three[0]) && take(',') && number(three[1]) && take(',') && number(three[2]) && take(']');
  }

  /// An object, its keys taken by `member`.
  template <class Member>
  bool object(Member member) {
    if (!take('{')) return false;
    if (take('}')) return true;
    do {
      std::string_view key;
      if (!name(key) || !take(':') || !member(key)) return false;
    } while (take(','));
    return take('}');
  }

 private:
  static bool is_digit(char c) { return c >= '0' && c <= '9'; }
  void skip_space() {
    while (at_ != end_ && (*at_ == ' ' || *at_ == '\t' || *at_ == '\r')) ++at_;
  }
  bool digits() {
    const char* start = at_;
    while (at_ != end_ && is_digit(*at_)) ++at_;
    return at_ != start;
  }

  const char* at_;
  const char* end_;
};

}  // namespace

std::optional<Answer> quick_answer(std::string_view line) {
  Scanner text(line);
  bool is_answer = false;
  std::optional<std::uint64_t> seq;
  Claim claim;
  const auto field = [&](std::string_view key) {
    ContactClaim& contact = *claim.contact;
    // What has been said already is said twice, which is for read_answer to refuse.
    if (key == "normal") return !contact.normal && text.vector(contact.normal);
    if (key == "point1") return !contact.point1 && text.vector(contact.point1);
    if (key == "point2") return !contact.point2 && text.vector(contact.point2);
    if (key == "point") return !contact.point && text.vector(contact.point);
    return key == "value" && !contact.value && text.number(contact.value.emplace());
  };
  const auto member = [&](std::string_view key) {
    if (key == "op") {
      std::string_view op;
      return !std::exchange(is_answer, true) && text.name(op) && op == "answer";
    }
    if (key == "seq") return !seq && text.count(seq.emplace());
    if (key == "overlap") return !claim.overlap && text.boolean(claim.overlap);
    if (key != "contact" || std::exchange(claim.speaks_of_contact, true)) return false;
    if (text.word("null")) return true;
    claim.contact.emplace();
    return text.object(field);
  };
  if (!text.object(member) || !text.at_end() || !is_answer || !seq) return std::nullopt;
  return Answer{*seq, std::move(claim)};
}

}  // namespace contact::engines
