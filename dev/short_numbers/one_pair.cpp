// The filter and the fast stage of one pair on short numbers, and one pair in one vector of them.
#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "dev/short_numbers/kernels.hpp"
#include "dev/short_numbers/tiny.hpp"
#include "kernel/batch_bounds.hpp"
#include "kernel/sphere_sphere_double_double.hpp"
#include "kernel/sphere_sphere_filter.hpp"

namespace contact::kernel::tiny {
namespace {

template <class Real>
struct BallOf {
  Real center[3];  // indexed by signed numbers, as Eigen's
  Real radius;
};

template <class Real>
struct DistancesOf {
  Real alarm;
  Real contact;
};

template <class Real>
BallOf<Real> ball(const Question& q, std::size_t first) {
  return {{q.balls[first], q.balls[first + 1], q.balls[first + 2]}, q.balls[first + 3]};
}

template <class Real>
Answer::Decision decide(const Question& q) {
  const auto a = ball<Real>(q, 0);
  const auto b = ball<Real>(q, 4);
  switch (filter(a, b, squared_distance(a, b), Real(q.alarm))) {
    case Filtered::hit:
      return Answer::Decision::hit;
    case Filtered::miss:
      return Answer::Decision::miss;
    case Filtered::undecided:
      break;
  }
  return Answer::Decision::open;
}

/// The numbers are asked of every pair that is not plainly a miss: production asks for them where exact arithmetic says
/// so, too.
template <int kBits>
void answer_one_pair(const std::vector<Question>& questions, std::vector<Answer>& answers) {
  using Real = Tiny<kBits>;
  for (std::size_t i = 0; i < questions.size(); ++i) {
    const Question& q = questions[i];
    Answer& answer = answers[i];
    answer.decision = decide<Real>(q);
    const auto a = ball<Real>(q, 0);
    const auto b = ball<Real>(q, 4);
    const auto pair = DoubleDoublePairOf<Real>::of(a, b, DistancesOf<Real>{q.alarm, q.contact});
    if (!pair) continue;
    const auto take = [&answer](const ApproximationOf<Real>& number, std::size_t k) {
      if (const auto certain = number.rounded()) {
        answer.number[k] = static_cast<double>(*certain);
        answer.certain |= 1U << k;
      }
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
      take(pair->normal(axis), axis);
      take(pair->point(a.center[axis], q.signs[0] * a.radius, axis), 3 + axis);
      take(pair->point(b.center[axis], q.signs[1] * b.radius, axis), 6 + axis);
    }
    take(pair->value(), 9);
  }
}

template <int kBits, Rounding kRounding>
void answer_filter(const std::vector<Question>& questions, std::vector<Answer>& answers) {
  for (std::size_t i = 0; i < questions.size(); ++i) answers[i].decision = decide<Tiny<kBits, kRounding>>(questions[i]);
}

template <int... kBits>
std::vector<NamedKernel> one_pair_kernels(std::integer_sequence<int, kBits...> /*bits*/) {
  std::vector<NamedKernel> all;
  (all.push_back({"one pair", kBits, answer_one_pair<kBits>, kBits % 2 == 0}), ...);
  all.push_back({"filter, rounding up", 6, answer_filter<6, Rounding::up>, true, false});
  all.push_back({"filter, rounding down", 6, answer_filter<6, Rounding::down>, true, false});
  all.push_back({"filter, rounding to zero", 6, answer_filter<6, Rounding::to_zero>, true, false});
  return all;
}

/// One pair in one vector of four short numbers.
namespace one_vector {

constexpr int kBits = 24;
using Number = Tiny<kBits>;
using bounds = FastBounds<Number>;
using Ball = BallOf<Number>;
struct Contact {
  std::array<Number, 10> number;
  bool degenerate;
};
struct Axes {
  std::array<Number, 4> lane;
};
using Mask = int;
struct Every {};

template <class Lane>
Axes each(Lane lane) {
  return {{lane(0), lane(1), lane(2), lane(3)}};
}
template <class Lane>
Mask where(Lane lane) {
  return static_cast<int>(lane(0)) | static_cast<int>(lane(1)) << 1 | static_cast<int>(lane(2)) << 2 |
         static_cast<int>(lane(3)) << 3;
}

#define CONTACT_LANES inline
#include "kernel/one_pair_lanes-inl.h"
namespace hn {
Axes Add(const Axes& a, const Axes& b) {
  return each([&](std::size_t i) { return a.lane[i] + b.lane[i]; });
}
Axes Sub(const Axes& a, const Axes& b) {
  return each([&](std::size_t i) { return a.lane[i] - b.lane[i]; });
}
Axes Mul(const Axes& a, const Axes& b) {
  return each([&](std::size_t i) { return a.lane[i] * b.lane[i]; });
}
Axes MulAdd(const Axes& a, const Axes& b, const Axes& c) {
  return each([&](std::size_t i) { return fma(a.lane[i], b.lane[i], c.lane[i]); });
}
Axes MulSub(const Axes& a, const Axes& b, const Axes& c) {
  return each([&](std::size_t i) { return fma(a.lane[i], b.lane[i], -c.lane[i]); });
}
Axes Abs(const Axes& x) {
  return each([&](std::size_t i) { return abs(x.lane[i]); });
}
Mask Eq(const Axes& a, const Axes& b) {
  return where([&](std::size_t i) { return a.lane[i] == b.lane[i]; });
}
Mask Ge(const Axes& a, const Axes& b) {
  return where([&](std::size_t i) { return a.lane[i] >= b.lane[i]; });
}
Mask And(Mask a, Mask b) { return a & b; }
Mask Or(Mask a, Mask b) { return a | b; }
}  // namespace hn

template <class T>
T all(Number x) {
  if constexpr (std::is_same_v<T, Number>)
    return x;
  else
    return {{x, x, x, x}};
}
Number x_of(const Axes& a) { return a.lane[0]; }
Number y_of(const Axes& a) { return a.lane[1]; }
Number z_of(const Axes& a) { return a.lane[2]; }
Number reciprocal_root(Number x) { return 1 / sqrt(x); }
Axes masked_multiply_add(Every /*mask*/, const Axes& a, const Axes& b, const Axes& c) { return hn::MulAdd(a, b, c); }
Mask and_equal(Mask mask, const Axes& a, const Axes& b) { return hn::And(mask, hn::Eq(a, b)); }
Axes with_last(const Axes& x, Number last) { return {{x.lane[0], x.lane[1], x.lane[2], last}}; }
int bits_of(Mask mask) { return mask; }
Axes load(const Ball& x) { return {{x.center[0], x.center[1], x.center[2], x.radius}}; }
void store(const Axes& normal, const Axes& point1, const Axes& point2_and_value, bool degenerate, Contact& contact) {
  for (std::size_t i = 0; i < 3; ++i) {
    contact.number[i] = normal.lane[i];
    contact.number[3 + i] = point1.lane[i];
  }
  for (std::size_t i = 0; i < 4; ++i) contact.number[6 + i] = point2_and_value.lane[i];
  contact.degenerate = degenerate;
}

#include "kernel/sphere_sphere_one_vector-inl.h"
#undef CONTACT_LANES

/// As production: where the filter says hit, all numbers or none.
void answer(const std::vector<Question>& questions, std::vector<Answer>& answers) {
  for (std::size_t i = 0; i < questions.size(); ++i) {
    const Question& q = questions[i];
    Answer& answer = answers[i];
    answer.decision = decide<Number>(q);
    const auto a = ball<Number>(q, 0);
    const auto b = ball<Number>(q, 4);
    const Number D = squared_distance(a, b);
    Contact contact{};
    if (answer.decision != Answer::Decision::hit || !(D > bounds::kLeast) ||
        !contact_of_hit(a, b, D, q.contact, q.signs[0] * a.radius, q.signs[1] * b.radius, contact))
      continue;
    for (std::size_t k = 0; k < kNumbers; ++k) answer.number[k] = static_cast<double>(contact.number[k]);
    answer.certain = (1U << kNumbers) - 1;
    answer.degenerate = contact.degenerate;
  }
}

}  // namespace one_vector
}  // namespace

std::vector<NamedKernel> one_pair_kernels() { return one_pair_kernels(std::integer_sequence<int, 5, 6, 7, 8>()); }

std::vector<NamedKernel> one_vector_kernels() { return {{"one vector", one_vector::kBits, one_vector::answer}}; }

}  // namespace contact::kernel::tiny
