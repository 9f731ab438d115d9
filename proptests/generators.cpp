// Generators of questions for the laws.
#include "proptests/generators.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <ostream>
#include <string>
#include <tuple>

#include "contact/pair_functions.hpp"
#include "golden/dataset.hpp"
#include "golden/families.hpp"
#include "oracle/truth/exact.hpp"

namespace contact {

void showValue(const Query& query, std::ostream& out) { out << golden::query_line(query, Scalar::binary64); }

}  // namespace contact

namespace contact::proptests {
namespace {

double largest(Scalar scalar) {
  return scalar == Scalar::binary32 ? static_cast<double>(std::numeric_limits<float>::max())
                                    : std::numeric_limits<double>::max();
}

rc::Gen<std::uint64_t> bits() { return full_size(rc::gen::arbitrary<std::uint64_t>()); }

/// A number made of 64 random bits.
template <class Make>
rc::Gen<double> from_bits(const Range& range, Make make) {
  return rc::gen::map(bits(), [range, make](std::uint64_t word) {
    const double x = range.fitted(make(range, word >> 1));
    return (word & 1) == 0 ? x : -x;
  });
}

/// A full significand of the scalar from the topmost of 63 bits: in [1,2).
double significand(const Range& range, std::uint64_t word) {
  const int precision = format_of(range.scalar).precision;
  const std::uint64_t digits = (word >> (64 - precision)) | (std::uint64_t{1} << (precision - 1));
  return std::ldexp(static_cast<double>(digits), 1 - precision);
}

}  // namespace

rc::Gen<std::vector<double>> numbers(std::size_t count, rc::Gen<double> number) {
  return rc::gen::container<std::vector<double>>(count, std::move(number));
}

Range::Range(Scalar of, double least_magnitude, double most_magnitude)
    : scalar(of), least(least_magnitude), most(std::min(most_magnitude, largest(of))) {
  const Format format = format_of(scalar);
  bottom = format.min_exponent - format.precision + 1;
  if (least > 0) {
    int exponent = 0;
    const double digits = std::frexp(least, &exponent);
    bottom = std::max(bottom, digits == 0.5 ? exponent - 1 : exponent);
  }
  top = most == largest(scalar) ? format.max_exponent : std::ilogb(most) - 1;
  top = std::max(top, bottom);
}

bool Range::contains(double x) const {
  return x == 0 || (std::abs(x) >= least && std::abs(x) <= most && rounded(x) == x);
}

bool Range::contains(const Query& query) const {
  bool all = !outside_domain(query);
  for_each_number(query, [&](const std::string&, double x) { all = all && contains(x); });
  return all;
}

double Range::rounded(double x) const {
  const double finite = std::clamp(x, -largest(scalar), largest(scalar));
  return scalar == Scalar::binary32 ? static_cast<double>(static_cast<float>(finite)) : finite;
}

Vector3 Range::rounded(const Vector3& v) const {
  return v.unaryExpr([&](double x) { return std::isfinite(x) ? rounded(x) : 0.0; });
}

double Range::fitted(double x) const {
  if (x == 0 || !std::isfinite(x)) return 0;
  const int exponent = std::ilogb(x);
  const int span = top - bottom + 1;
  const int steps = exponent < bottom ? (bottom - exponent + span - 1) / span : -((exponent - bottom) / span);
  return rounded(std::ldexp(x, steps * span));
}

double Range::moved(double x, int ulps) const {
  for (; ulps != 0; ulps += ulps > 0 ? -1 : 1) {
    const double next = ulps > 0 ? oracle::next_up(x, scalar) : oracle::next_down(x, scalar);
    if (std::isfinite(next)) x = next;
  }
  return x;
}

rc::Gen<int> integer(int least, int most) { return full_size(rc::gen::inRange(least, most + 1)); }

rc::Gen<double> any_bits(const Range& range) {
  return from_bits(range, [](const Range& r, std::uint64_t word) {
    const int exponent =
        r.bottom + static_cast<int>((word & 0xffff) % static_cast<std::uint64_t>(r.top - r.bottom + 1));
    return std::ldexp(significand(r, word), exponent);
  });
}

rc::Gen<double> subnormal(const Range& range) {
  return from_bits(range, [](const Range& r, std::uint64_t word) {
    if (r.least > 0) return std::ldexp(significand(r, word), r.bottom);
    const int digits = format_of(r.scalar).precision - 1 - static_cast<int>(word % 8 == 0 ? (word >> 3) % 20 : 0);
    return std::ldexp(static_cast<double>(word >> (63 - digits)), r.bottom);
  });
}

rc::Gen<double> extreme(const Range& range) {
  const Format format = format_of(range.scalar);
  const int lowest = format.min_exponent - format.precision + 1;
  std::vector<double> ends{0};
  for (const int exponent :
       {0, lowest, format.min_exponent, lowest / 2, lowest * 450 / 1074, format.max_exponent / 2 - 11,
        format.max_exponent / 2, format.max_exponent, range.bottom, range.top})
    if (range.contains(std::ldexp(1.0, exponent))) ends.push_back(std::ldexp(1.0, exponent));
  ends.push_back(range.rounded(range.most));
  return rc::gen::map(rc::gen::tuple(rc::gen::elementOf(ends), integer(-1, 1), integer(0, 1)),
                      [range](const std::tuple<double, int, int>& parts) {
                        const auto& [end, ulps, negative] = parts;
                        const double moved = range.moved(end, ulps);
                        const double x = range.contains(moved) ? moved : end;
                        return negative == 0 ? x : -x;
                      });
}

rc::Gen<double> huge(const Range& range) {
  return from_bits(range, [](const Range& r, std::uint64_t word) {
    return std::ldexp(significand(r, word), std::max(r.bottom, r.top - static_cast<int>(word % 3)));
  });
}

rc::Gen<double> small_dyadic(const Range& range) {
  // Around 1 where the range holds 2^-8 to 2^12, else around its middle.
  const bool around_one = range.bottom <= -8 && range.top >= 12;
  const int middle = around_one ? 0 : (range.bottom + range.top) / 2 - 2;
  const int reach = around_one ? 8 : std::clamp((range.top - range.bottom - 4) / 2, 0, 8);
  return rc::gen::map(rc::gen::pair(integer(-12, 12), integer(-reach, reach)),
                      [range, middle](const std::pair<int, int>& parts) {
                        return range.fitted(std::ldexp(static_cast<double>(parts.first), middle + parts.second));
                      });
}

rc::Gen<double> beside_dyadic(const Range& range) {
  return rc::gen::map(rc::gen::pair(small_dyadic(range), integer(-2, 2)), [range](const std::pair<double, int>& parts) {
    const double x = range.moved(parts.first, parts.second);
    return range.contains(x) ? x : parts.first;
  });
}

rc::Gen<double> ordinary(const Range& range) {
  return from_bits(range, [](const Range& r, std::uint64_t word) {
    const int precision = format_of(r.scalar).precision;
    return std::ldexp(static_cast<double>(word >> (63 - precision)), 3 - precision);  // below 8
  });
}

rc::Gen<double> any_number(const Range& range) {
  return rc::gen::oneOf(any_bits(range), subnormal(range), extreme(range), huge(range), small_dyadic(range),
                        beside_dyadic(range), ordinary(range));
}

Query query_of(Pair pair, const std::vector<double>& numbers) {
  Query query = zero_query(pair);
  std::size_t k = 0;
  for_each_field(query, [&](const std::string& /*field*/, auto& value, FieldKind kind) {
    for_each_number_in(value, [&](double& x) {
      x = k < numbers.size() ? numbers[k++] : 0;
      if (kind == FieldKind::length) x = std::abs(x);
    });
    for_each_vector(value, [&](Vector3& v) {
      if (kind == FieldKind::direction && v.isZero(0)) v = Vector3(1, 2, -2);
    });
    if constexpr (std::same_as<std::remove_cvref_t<decltype(value)>, Quaternion>)
      if (std::all_of(value.begin(), value.end(), [](double x) { return x == 0; })) value = {0, 0, 0, 1};
  });
  for_each_shape(query, []<class Shape>(Shape& shape) {
    if constexpr (std::same_as<Shape, Box>) shape = {shape.min.cwiseMin(shape.max), shape.min.cwiseMax(shape.max)};
  });
  return query;
}

rc::Gen<Query> made_of(Pair pair, rc::Gen<double> number) {
  std::size_t count = 0;
  const Query zeros = zero_query(pair);
  for_each_number(zeros, [&](const std::string&, double) { ++count; });
  if (!has_numbers(pair)) --count;  // no contact distance, which says nothing there
  return rc::gen::map(numbers(count, std::move(number)),
                      [pair](const std::vector<double>& drawn) { return query_of(pair, drawn); });
}

std::vector<double*> radii_of(Query& query) {
  std::vector<double*> radii;
  for_each_shape(query, [&](auto& shape) {
    if constexpr (requires { shape.radius; }) radii.push_back(&shape.radius);
  });
  return radii;
}

rc::Gen<Query> nearly_touching(const Range& range, rc::Gen<Query> laid) {
  return rc::gen::map(rc::gen::tuple(std::move(laid), integer(-2, 2), integer(0, 2), integer(0, 1)),
                      [range](const std::tuple<Query, int, int, int>& parts) {
                        auto [query, ulps, quarters, by_alarm] = parts;
                        Query cores = query;
                        for (double* radius : radii_of(cores)) *radius = 0;
                        cores.distances = {std::numeric_limits<double>::max(), 0};
                        const auto contact = std::visit(
                            [&](const auto& shapes) { return contact_of(shapes, cores.distances); }, cores.shapes);
                        if (!contact || !std::isfinite(contact->value)) return query;
                        const double distance = range.rounded(std::max(0.0, contact->value));
                        const double part = range.rounded(quarters * distance / 4);
                        const std::vector<double*> radii = radii_of(query);
                        if (radii.empty()) {
                          query.distances.alarm = std::max(0.0, range.moved(distance, ulps));
                          return query;
                        }
                        query.distances.alarm = 0;
                        *radii.back() = 0;
                        (by_alarm == 1 || radii.size() == 1 ? query.distances.alarm : *radii.back()) = part;
                        *radii.front() = std::max(0.0, range.moved(range.rounded(distance - part), ulps));
                        return query;
                      });
}

rc::Gen<Query> at_every_scale(Pair pair, const Range& range, const LaidOut& laid, rc::Gen<Query> touching) {
  const auto near = [&](rc::Gen<double> number) { return nearly_touching(range, laid(std::move(number))); };
  return rc::gen::weightedOneOf<Query>({{1, made_of(pair, any_number(range))},
                                        {1, made_of(pair, any_bits(range))},
                                        {1, made_of(pair, subnormal(range))},
                                        {1, made_of(pair, extreme(range))},
                                        {1, made_of(pair, huge(range))},
                                        {1, made_of(pair, ordinary(range))},
                                        {2, made_of(pair, small_dyadic(range))},
                                        {2, laid(any_number(range))},
                                        {2, laid(ordinary(range))},
                                        {4, laid(small_dyadic(range))},
                                        {1, near(any_bits(range))},
                                        {1, near(subnormal(range))},
                                        {2, std::move(touching)},
                                        {3, near(small_dyadic(range))},
                                        {3, near(ordinary(range))}});
}

rc::Gen<Query> queries(Pair pair, const Range& range) {
  const rc::Gen<Query> made = std::visit(
      [&]<class Kind>(const Kind&) {
        if constexpr (std::same_as<Kind, Convexes>)
          return queries(pair, static_cast<const Kind*>(nullptr), range);
        else
          return queries(static_cast<const Kind*>(nullptr), range);
      },
      description(pair).zeros());
  return rc::gen::map(made, [pair](Query query) {
    query.pair = pair;
    return query;
  });
}

rc::Gen<Query> bad_queries(Pair pair, const Range& range) {
  return rc::gen::map(rc::gen::pair(queries(pair, range), integer(0, 1'000'000)),
                      [](const std::pair<Query, int>& parts) {
                        Query query = parts.first;
                        golden::Random random({}, static_cast<std::uint64_t>(parts.second));
                        golden::spoil(query, random);
                        return query;
                      });
}

std::optional<Vector3> exact_middle(const Vector3& start, const Vector3& end) {
  const Vector3 middle = start / 2 + end / 2;
  for (int axis = 0; axis < 3; ++axis)
    if (oracle::Rational(2) * oracle::Rational(middle[axis]) !=
        oracle::Rational(start[axis]) + oracle::Rational(end[axis]))
      return std::nullopt;
  return middle;
}

std::vector<Query> sample(const rc::Gen<Query>& gen, int count) {
  rc::Random random(20);
  std::vector<Query> queries;
  for (int i = 0; i < count; ++i) {
    const rc::Random here = random.split();
    queries.push_back(gen(here, rc::kNominalSize).value());
  }
  return queries;
}

}  // namespace contact::proptests
