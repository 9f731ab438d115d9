// The functions of one pair as the vector kernels see them here: they note what is asked of them and settle nothing.
#include "dev/short_numbers/batch_columns.hpp"

#include <bit>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "contact/sphere_sphere.hpp"

namespace contact {
namespace {

/// What the call under way has left, by pair: the numbers of a hit, or kUndecided.
constexpr unsigned kUndecided = 1U << 31;
std::vector<unsigned> left;
bool decision_left;
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

[[noreturn]] void fail(const char* what) {
  std::fprintf(stderr, "%s\n", what);
  std::abort();
}

}  // namespace

void kernel::round_numbers(const SpherePairs& /*pairs*/, const ContactQuestion& /*question*/, std::size_t i,
                           unsigned numbers, const ContactRows& out) {
  left[i] |= numbers;
  for (std::size_t k = 0; k < ContactRows::kNumbers; ++k)
    if ((numbers >> k & 1) != 0) out.number[k][i] = kNoNumber;
}

template <>
void kernel::contact_of_one_pair(const SpherePairs& /*pairs*/, const ContactQuestion& /*question*/, std::size_t i,
                                 const ContactRows& out, std::size_t row) {
  left[i] = kUndecided;
  out.state[row] = batch::PairState::contact;
}

inline namespace CONTACT_ABI {
bool test_sphere_sphere(const Ball& /*a*/, const Ball& /*b*/, double /*alarm*/) {
  decision_left = true;
  return true;
}
}  // namespace CONTACT_ABI

namespace kernel::tiny {

void answer_columns(const std::vector<Question>& questions, std::vector<Answer>& answers, ComputeSpheres compute,
                    TestSpheres test) {
  const std::size_t size = questions.size();
  if (size == 0) return;
  std::array<std::vector<double>, 8> balls;
  for (std::size_t i = 0; i < 8; ++i)
    for (const Question& q : questions) balls[i].push_back(q.balls[i]);
  const SpherePairs pairs{{balls[0].data(), balls[1].data(), balls[2].data(), balls[3].data()},
                          {balls[4].data(), balls[5].data(), balls[6].data(), balls[7].data()},
                          size};
  const auto on = [](double sign, double towards) {
    return sign == 0 ? PointOn::center : sign == towards ? PointOn::nearest_surface : PointOn::far_surface;
  };
  const Question& first = questions.front();
  const ContactQuestion question{{first.alarm, first.contact}, {on(first.signs[0], 1), on(first.signs[1], -1)}};

  std::array<std::vector<double>, kNumbers> numbers;
  std::vector<batch::PairState> states(size);
  ContactRows rows{};
  for (std::size_t k = 0; k < kNumbers; ++k) {
    numbers[k].resize(size);
    rows.number[k] = numbers[k].data();
  }
  rows.state = states.data();

  left.assign(size, 0);
  const batch::Count count = compute(pairs, question, rows);
  std::size_t hits = 0;
  std::size_t exact = 0;
  for (std::size_t i = 0; i < size; ++i) {
    Answer& answer = answers[i];
    exact += left[i] != 0 ? 1U : 0U;
    hits += states[i] != batch::PairState::miss ? 1U : 0U;
    if (left[i] == kUndecided) continue;
    answer.decision = states[i] == batch::PairState::miss ? Answer::Decision::miss : Answer::Decision::hit;
    answer.degenerate = batch::is_degenerate(states[i]);
    for (std::size_t k = 0; k < kNumbers; ++k) {
      answer.number[k] = numbers[k][i];
      if (answer.decision == Answer::Decision::miss && std::bit_cast<std::uint64_t>(numbers[k][i]) != 0)
        fail("a number of a miss is not +0");
    }
    if (answer.decision == Answer::Decision::hit) answer.certain = ~left[i] & ((1U << kNumbers) - 1);
  }
  if (count.hits != hits || count.exact != exact) fail("compute_spheres counts what is not so");

  // A decision that one of them leaves is the other's to check: one pair at a time.
  for (std::size_t i = 0; i < size; ++i) {
    SpherePairs one = pairs;
    for (std::size_t k = 0; k < 4; ++k) {
      one.a[k] += i;
      one.b[k] += i;
    }
    one.size = 1;
    std::uint8_t hit = 0;
    decision_left = false;
    test(one, first.alarm, &hit);
    const auto said = decision_left ? Answer::Decision::open
                      : hit != 0    ? Answer::Decision::hit
                                    : Answer::Decision::miss;
    Answer& answer = answers[i];
    if (said == Answer::Decision::open || said == answer.decision) continue;
    if (answer.decision != Answer::Decision::open) fail("test_spheres and compute_spheres decide differently");
    answer.decision = said;
  }
}

}  // namespace kernel::tiny
}  // namespace contact
