// The filter and the fast stage of one pair on short numbers, and one pair in one vector of them.
#include <array>
#include <cstddef>
#include <utility>

#include "kernel/sphere_sphere_double_double.hpp"
#include "kernel/sphere_sphere_filter.hpp"
#include "kernel/sphere_sphere_one_vector.hpp"
#include "kernel/tiny/kernels.hpp"
#include "kernel/tiny/tiny.hpp"

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

#if CONTACT_HAS_ONE_VECTOR

/// Four short numbers for one_vector::Doubles.
template <int kBits>
struct Tinies {
  using Real = Tiny<kBits>;
  struct V {
    std::array<Real, 4> lane;
    Real operator[](std::size_t i) const { return lane[i]; }
    friend V operator+(V a, V b) {
      return each([&](std::size_t i) { return a[i] + b[i]; });
    }
    friend V operator-(V a, V b) {
      return each([&](std::size_t i) { return a[i] - b[i]; });
    }
    friend V operator*(V a, V b) {
      return each([&](std::size_t i) { return a[i] * b[i]; });
    }
  };
  using M = int;
  struct Contact {
    std::array<Real, 12> number;
    bool degenerate;
  };

  template <class Lane>
  static V each(Lane lane) {
    return {{lane(0), lane(1), lane(2), lane(3)}};
  }
  template <class Lane>
  static M where(Lane lane) {
    return static_cast<int>(lane(0)) | static_cast<int>(lane(1)) << 1 | static_cast<int>(lane(2)) << 2 |
           static_cast<int>(lane(3)) << 3;
  }

  static V load(const BallOf<Real>& x) { return {{x.center[0], x.center[1], x.center[2], x.radius}}; }
  static void store(V x, Contact& contact, std::size_t first) {
    for (std::size_t i = 0; i < 4; ++i) contact.number[first + i] = x[i];
  }
  static V all(Real x) { return {{x, x, x, x}}; }
  static V with_last(V x, Real last) { return {{x[0], x[1], x[2], last}}; }
  static V magnitude(V x) {
    return each([&](std::size_t i) { return abs(x[i]); });
  }
  static V multiply_add(V a, V b, V c) {
    return each([&](std::size_t i) { return fma(a[i], b[i], c[i]); });
  }
  static V multiply_subtract(V a, V b, V c) {
    return each([&](std::size_t i) { return fma(a[i], b[i], -c[i]); });
  }
  static Real root_of(Real x) { return sqrt(x); }
  static M equal(V a, V b) {
    return where([&](std::size_t i) { return a[i] == b[i]; });
  }
  static M at_least(V a, V b) {
    return where([&](std::size_t i) { return a[i] >= b[i]; });
  }
  static M both(M a, M b) { return a & b; }
  static M either(M a, M b) { return a | b; }
  static int bits(M mask) { return mask; }
};

/// As production: where the filter says hit, all numbers or none.
template <int kBits>
[[gnu::target("avx2,fma")]] void answer_one_vector(const std::vector<Question>& questions,
                                                   std::vector<Answer>& answers) {
  using Real = Tiny<kBits>;
  for (std::size_t i = 0; i < questions.size(); ++i) {
    const Question& q = questions[i];
    Answer& answer = answers[i];
    answer.decision = decide<Real>(q);
    const auto a = ball<Real>(q, 0);
    const auto b = ball<Real>(q, 4);
    const Real D = squared_distance(a, b);
    typename Tinies<kBits>::Contact contact{};
    if (answer.decision != Answer::Decision::hit || !(D > PlainBounds<Real>::kLeast) ||
        !one_vector::contact_of_hit<Tinies<kBits>>(a, b, D, Real(q.contact), q.signs[0] * a.radius,
                                                   q.signs[1] * b.radius, contact))
      continue;
    for (std::size_t k = 0; k < kNumbers; ++k) answer.number[k] = static_cast<double>(contact.number[k]);
    answer.certain = (1U << kNumbers) - 1;
    answer.degenerate = contact.degenerate;
  }
}

#endif

}  // namespace

std::vector<NamedKernel> one_pair_kernels() { return one_pair_kernels(std::integer_sequence<int, 5, 6, 7, 8>()); }

std::vector<NamedKernel> one_vector_kernels() {
#if CONTACT_HAS_ONE_VECTOR
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    return {{"one vector", 24, answer_one_vector<24>}};
#endif
  return {};
}

}  // namespace contact::kernel::tiny
