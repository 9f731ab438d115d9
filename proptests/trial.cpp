// What a law is tried on, and the steps towards one that a person can read.
#include "proptests/trial.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

namespace contact::proptests {
namespace {

/// x as an odd integer times a power of two.
struct Odd {
  double digits;
  int exponent;
};
Odd odd(double x) {
  if (!std::isfinite(x)) return {x, -53};  // no integer holds it
  int exponent = 0;
  const auto whole = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
  const int zeros = std::countr_zero(static_cast<std::uint64_t>(whole));
  return {std::ldexp(static_cast<double>(whole), -zeros), exponent - 53 + zeros};
}

std::int64_t difficulty(double x) {
  if (x == 0) return 0;
  const int exponent = odd(x).exponent;
  return 4 + 4 * significant_bits(x) + (exponent < 0 ? -2 * exponent : exponent) + (x < 0 ? 1 : 0);
}

/// The first pair of the same two shapes.
Pair plain_pair(Pair pair) { return is_convex(pair) ? pair : pairs_of_kinds()[kind_of(pair)]; }

std::int64_t difficulty(const Query& query) {
  std::int64_t sum = query.pair == plain_pair(query.pair) ? 0 : 1;
  for_each_number(query, [&](const std::string&, double x) { sum += difficulty(x); });
  if (const Balls* balls = query.balls();
      balls != nullptr && balls->a.radius == balls->b.radius && balls->a.radius != 0)
    sum -= difficulty(balls->a.radius) / 2;  // the second of two equal radii is read at a glance
  return sum;
}

std::int64_t difficulty(const Change& change) {
  std::int64_t sum = std::abs(change.exponent) + difficulty(change.length) + change.choice;
  for (std::size_t i = 0; i < 3; ++i)
    sum += std::abs(change.steps[i]) + (change.order[i] == static_cast<int>(i) ? 0 : 1) + (change.reflected[i] ? 1 : 0);
  return sum;
}

/// x with at most `bits` significant bits, by one of three ways to round.
double with_bits(double x, int bits, double (*round)(double)) {
  if (x == 0) return x;
  int exponent = 0;
  const double digits = std::frexp(x, &exponent);
  return std::ldexp(round(std::ldexp(digits, bits)), exponent - bits);
}

constexpr std::array<double (*)(double), 3> kRoundings{[](double x) { return std::nearbyint(x); },
                                                       [](double x) { return std::floor(x); },
                                                       [](double x) { return std::ceil(x); }};

/// Numbers to try instead of x, the boldest first.
std::vector<double> easier_numbers(double x) {
  if (x == 0) return {};
  if (!std::isfinite(x)) return {0, 1, -1};
  std::vector<double> found{0, 1, -1, -x};
  for (const auto round : kRoundings) found.push_back(round(x));
  const int bits = significant_bits(x);
  const double binade = std::ldexp(1.0, -std::ilogb(x));
  found.push_back(x * binade);
  for (const int fewer : {1, 2, 3, bits / 2, bits - 1})
    if (fewer > 0 && fewer < bits)
      for (const auto round : kRoundings) found.push_back(with_bits(x, fewer, round));
  found.insert(found.end(), {std::trunc(x / 2), x - 1, x + 1, x / 2, x * 2});
  return found;
}

/// b - a, where that is exact.
bool subtract_exactly(double& b, double a) {
  const double difference = b - a;
  const double back = b - difference;
  const bool exact = std::isfinite(difference) && back == a && difference + a == b && (b - back) - difference == 0;
  b = difference;
  return exact;
}

class Easier {
 public:
  Easier(const Trial& trial, const Range& range) : trial_(trial), range_(range), most_(difficulty(trial)) {}

  std::vector<Trial> all() {
    changes();
    whole_question();
    each_number();
    return std::move(found_);
  }

 private:
  void add(const Trial& trial) {
    if (difficulty(trial) < most_ && range_.contains(trial.query)) found_.push_back(trial);
  }
  void add(const Query& query) { add({query, trial_.change, trial_.others}); }
  template <class Edit>
  void with_change(Edit edit) {
    Trial trial = trial_;
    edit(trial.change);
    add(trial);
  }
  template <class Edit>
  void with_numbers(Edit edit) {
    Query query = trial_.query;
    for_each_number(query, [&](const std::string&, double& x) { x = edit(x); });
    add(query);
  }

  void changes() {
    with_change([](Change& c) { c = {}; });
    if (!trial_.others.empty()) {
      add({trial_.query, trial_.change, {}});
      add({trial_.query, trial_.change, {trial_.others.front()}});
      add({trial_.query, trial_.change, {trial_.others.back()}});
    }
    with_change([](Change& c) { c.order = {0, 1, 2}; });
    with_change([](Change& c) { c.steps = {}; });
    with_change([](Change& c) { c.choice = 0; });
    for (std::size_t i = 0; i < 3; ++i) {
      with_change([&](Change& c) { c.reflected[i] = false; });
      with_change([&](Change& c) { c.steps[i] = 0; });
      with_change([&](Change& c) { c.steps[i] = 1; });
      with_change([&](Change& c) { std::swap(c.order[i], c.order[(i + 1) % 3]); });
    }
    for (const int exponent :
         {0, 1, trial_.change.exponent / 2, trial_.change.exponent - 1, trial_.change.exponent + 1})
      with_change([&](Change& c) { c.exponent = exponent; });
    for (const double length : easier_numbers(trial_.change.length))
      if (length >= 0 && range_.contains(length)) with_change([&](Change& c) { c.length = length; });
  }

  /// Steps that keep what the numbers of a question have to do with each other.
  void whole_question() {
    const Query& query = trial_.query;
    Query plain = query;
    plain.pair = plain_pair(query.pair);
    add(plain);
    int largest = -2000;
    int smallest = 2000;
    for_each_number(query, [&](const std::string&, double x) {
      if (x == 0 || !std::isfinite(x)) return;
      largest = std::max(largest, std::ilogb(x));
      smallest = std::min(smallest, odd(x).exponent);
    });
    if (largest == -2000) return;
    // All to the size of 1, all to integers, half way there.
    for (const int exponent : {-largest, -smallest, 3 - largest, -largest / 2, largest > 0 ? -1 : 1})
      if (exponent != 0) with_numbers([&](double x) { return range_.rounded(std::ldexp(x, exponent)); });
    const Balls* balls = query.balls();
    if (balls != nullptr) first_center_to_origin(query, *balls);
    const Vector3 first = first_point(query);
    for (int axis = 0; axis < 3; ++axis) moved_to_origin(axis, first[axis]);
    if (balls != nullptr) other_radii(query, *balls);
    // A common grid, and few digits at once.
    for (const int digits : {1, 2, 4, 8, 16, 24, 40})
      with_numbers(
          [&](double x) { return std::ldexp(std::nearbyint(std::ldexp(x, digits - largest)), largest - digits); });
    for (const int digits : {1, 2, 4, 8, 16, 32})
      with_numbers([&](double x) { return with_bits(x, digits, kRoundings[0]); });
  }

  void first_center_to_origin(const Query& query, const Balls& balls) {
    Query origin = query;
    auto& moved = std::get<Balls>(origin.shapes);
    bool exact = true;
    for (int axis = 0; axis < 3; ++axis) exact = subtract_exactly(moved.b.center[axis], balls.a.center[axis]) && exact;
    moved.a.center.setZero();
    if (exact) add(origin);
  }

  void other_radii(const Query& query, const Balls& balls) {
    const auto with = [&](double first, double second, double alarm) {
      Query other = query;
      auto& [a, b] = std::get<Balls>(other.shapes);
      a.radius = first;
      b.radius = second;
      other.distances.alarm = alarm;
      add(other);
    };
    const double alarm = query.distances.alarm;
    const double sum = balls.a.radius + balls.b.radius;
    with(balls.a.radius, balls.a.radius, alarm);
    with(balls.b.radius, balls.b.radius, alarm);
    with(0, sum, alarm);
    with(sum, 0, alarm);
    with(sum / 2, sum / 2, alarm);
    with(balls.a.radius, balls.b.radius + alarm, 0);
    with(balls.a.radius + alarm, balls.b.radius, 0);
    with(0, 0, sum + alarm);
  }

  /// The first point of the first shape that has one.
  static Vector3 first_point(const Query& query) {
    std::optional<Vector3> first;
    for_each_field(query, [&](const std::string&, const auto& value, FieldKind /*kind*/) {
      if constexpr (std::same_as<std::remove_cvref_t<decltype(value)>, Vector3>)
        if (!first) first = value;
    });
    return first.value_or(Vector3::Zero());
  }

  /// One coordinate of everything less `origin`, where that is exact.
  void moved_to_origin(int axis, double origin) {
    if (origin == 0) return;
    Query query = trial_.query;
    bool exact = true;
    const auto move = [&](double& x) { exact = subtract_exactly(x, origin) && exact; };
    for_each_value(query, [&](auto& value) { for_each_vector(value, [&](Vector3& v) { move(v[axis]); }); });
    if (exact) add(query);
  }

  void each_number() {
    Query query = trial_.query;
    std::vector<double*> numbers;
    for_each_number(query, [&](const std::string&, double& x) { numbers.push_back(&x); });
    std::vector<std::vector<double>> candidates;
    std::size_t longest = 0;
    for (const double* x : numbers) {
      candidates.push_back(easier_numbers(*x));
      longest = std::max(longest, candidates.back().size());
    }
    for (std::size_t step = 0; step < longest; ++step)
      for (std::size_t i = numbers.size(); i-- > 0;) {
        if (step >= candidates[i].size()) continue;
        const double before = std::exchange(*numbers[i], range_.rounded(candidates[i][step]));
        add(query);
        *numbers[i] = before;
      }
  }

  const Trial& trial_;
  const Range& range_;
  std::int64_t most_;
  std::vector<Trial> found_;
};

}  // namespace

int significant_bits(double x) {
  if (x == 0 || !std::isfinite(x)) return 0;
  return std::ilogb(odd(x).digits) + 1;
}

std::int64_t difficulty(const Trial& trial) {
  std::int64_t sum = difficulty(trial.query) + difficulty(trial.change);
  for (const Query& other : trial.others) sum += 10 + difficulty(other);
  return sum;
}

std::vector<Trial> easier(const Trial& trial, const Range& range) { return Easier(trial, range).all(); }

rc::Shrinkable<Trial> shrinkable(const Trial& trial, const Range& range) {
  return rc::shrinkable::shrinkRecur(trial,
                                     [range](const Trial& t) { return rc::seq::fromContainer(easier(t, range)); });
}

rc::Gen<Change> changes(const Range& range) {
  const std::vector<std::array<int, 3>> orders{{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  return rc::gen::map(
      rc::gen::tuple(integer(-2100, 2100), rc::gen::elementOf(orders), integer(0, 7),
                     rc::gen::container<std::vector<int>>(3, integer(-9, 9)), any_number(range), integer(0, 59)),
      [](const std::tuple<int, std::array<int, 3>, int, std::vector<int>, double, int>& parts) {
        const auto& [exponent, order, signs, steps, length, choice] = parts;
        Change change;
        change.exponent = exponent;
        change.order = order;
        change.length = std::abs(length);
        change.choice = choice;
        for (std::size_t i = 0; i < 3; ++i) {
          change.reflected[i] = (signs >> i & 1) == 1;
          change.steps[i] = steps[i];
        }
        return change;
      });
}

}  // namespace contact::proptests
