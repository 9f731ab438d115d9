#include "dev/short_numbers/harness.hpp"

#include <bit>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "dev/short_numbers/truth.hpp"

namespace contact::kernel::tiny {
namespace {

using Long = boost::multiprecision::cpp_int;
using Fixed = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<
    1024, 1024, boost::multiprecision::signed_magnitude, boost::multiprecision::unchecked, void>>;

/// The truth of numbers of at most kFixedBits bits from the first of the largest to the last of the smallest.
constexpr int kFixedBits = 70;

/// The exponents of the last bit and the first of any number of a question that is not 0.
struct Span {
  int last = std::numeric_limits<int>::max();
  int first = std::numeric_limits<int>::min();

  void take(double x) {
    if (x == 0) return;
    const int exponent = std::ilogb(x);
    const std::uint64_t significand =
        (std::bit_cast<std::uint64_t>(x) & ((std::uint64_t{1} << 52) - 1)) | std::uint64_t{1} << 52;
    last = std::min(last, exponent - 52 + std::countr_zero(significand));
    first = std::max(first, exponent);
  }
};

/// Whether `bits` bits hold the significand of x.
bool has_bits(double x, int bits) {
  int exponent = 0;
  const double significand = std::ldexp(std::frexp(x, &exponent), bits);
  return significand == std::floor(significand);
}

std::string in_words(const Question& q) {
  std::array<char, 512> text{};
  std::snprintf(text.data(), text.size(), "(%g %g %g) %g  (%g %g %g) %g  alarm %g contact %g signs %g %g", q.balls[0],
                q.balls[1], q.balls[2], q.balls[3], q.balls[4], q.balls[5], q.balls[6], q.balls[7], q.alarm, q.contact,
                q.signs[0], q.signs[1]);
  return text.data();
}

template <class Integer>
void judge(const Question& q, const Answer& answer, const Truth<Integer>& truth, int bits, Outcome& outcome) {
  using Decision = Answer::Decision;
  const auto wrong = [&](const std::string& what) {
    ++outcome.wrong;
    if (outcome.first_wrong.size() < 10) outcome.first_wrong.push_back(what + ": " + in_words(q));
  };
  ++outcome.questions;
  ++outcome.decided[static_cast<std::size_t>(answer.decision)];
  if (answer.decision != Decision::open && truth.hit() != (answer.decision == Decision::hit)) wrong("decision");
  bool whole = answer.decision == Decision::miss;
  if (answer.decision != Decision::miss) {
    for (std::size_t k = 0; k < kNumbers; ++k) {
      const bool certain = (answer.certain >> k & 1) != 0;
      ++(certain ? outcome.settled : outcome.left)[k];
      if (certain && !truth.is_rounded(k, answer.number[k], bits)) wrong("number " + std::to_string(k));
    }
    whole = answer.decision == Decision::hit && answer.certain == (1U << kNumbers) - 1;
    if (whole && answer.degenerate != truth.coincident()) wrong("degenerate");
  }
  const auto is_of_kind = [&](const char* kind) { ++outcome.kinds[kind][whole ? 0 : 1]; };
  int zeros = 0;
  bool inexact = false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double a = q.balls[axis];
    const double b = q.balls[4 + axis];
    zeros += a == b ? 1 : 0;
    inexact = inexact || !has_bits(b - a, bits) || (b - a) + a != b;
  }
  if (zeros == 1) is_of_kind("one component 0");
  if (zeros == 2) is_of_kind("two components 0");
  if (zeros == 3) is_of_kind("centres coincide");
  if (inexact) is_of_kind("a difference is rounded");
  const double radii = q.balls[3] + q.balls[7];
  if (!has_bits(radii + q.contact, bits) || radii - q.balls[3] != q.balls[7] || radii + q.contact - radii != q.contact)
    is_of_kind("T is no number");
  if (truth.touching()) is_of_kind("touching");
  if (truth.value_is_zero()) is_of_kind("value 0");
}

}  // namespace

std::uint64_t Grid::size() const {
  std::uint64_t product = alarms.size() * contacts.size() * signs.size();
  for (const auto& numbers : balls) product *= numbers.size();
  return product;
}

void Outcome::add(const Outcome& other) {
  questions += other.questions;
  wrong += other.wrong;
  for (std::size_t i = 0; i < decided.size(); ++i) decided[i] += other.decided[i];
  for (std::size_t k = 0; k < kNumbers; ++k) {
    settled[k] += other.settled[k];
    left[k] += other.left[k];
  }
  for (const auto& [kind, counts] : other.kinds)
    for (std::size_t i = 0; i < counts.size(); ++i) kinds[kind][i] += counts[i];
  for (const auto& text : other.first_wrong)
    if (first_wrong.size() < 10) first_wrong.push_back(text);
}

Outcome ask_all(const Grid& grid, int bits, const Kernel& kernel) {
  const auto refuse_longer = [&](const std::vector<double>& numbers) {
    for (const double x : numbers)
      if (!has_bits(x, bits)) throw std::invalid_argument(grid.name + ": a number has more bits than the kernel");
  };
  for (const auto& numbers : grid.balls) refuse_longer(numbers);
  refuse_longer(grid.alarms);
  refuse_longer(grid.contacts);
  Outcome outcome;
  std::vector<Question> questions;
  std::vector<Answer> answers;
  const auto ask = [&] {
    answers.assign(questions.size(), Answer{});
    kernel(questions, answers);
    for (std::size_t i = 0; i < questions.size(); ++i) {
      const Question& q = questions[i];
      Span span;
      for (const double x : q.balls) span.take(x);
      span.take(q.alarm);
      span.take(q.contact);
      if (span.last > span.first) span.last = span.first = 0;
      if (span.first - span.last < kFixedBits)
        judge(q, answers[i], Truth<Fixed>(q, span.last), bits, outcome);
      else
        judge(q, answers[i], Truth<Long>(q, span.last), bits, outcome);
    }
    questions.clear();
  };
  constexpr std::size_t kBlock = 4096;
  for (const double alarm : grid.alarms)
    for (const double contact : grid.contacts)
      for (const auto& signs : grid.signs) {
        std::array<std::size_t, 8> at{};
        for (bool more = true; more;) {
          Question q{{}, alarm, contact, signs};
          for (std::size_t i = 0; i < at.size(); ++i) q.balls[i] = grid.balls[i][at[i]];
          questions.push_back(q);
          if (questions.size() == kBlock) ask();
          more = false;
          for (std::size_t i = at.size(); i-- > 0 && !more;) {
            more = ++at[i] < grid.balls[i].size();
            if (!more) at[i] = 0;
          }
        }
        ask();
      }
  return outcome;
}

}  // namespace contact::kernel::tiny
