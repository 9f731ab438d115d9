// Numbers of any bits: the functions of one pair and every vector width under any floating-point environment, and all
// oracles say the same.
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "contact/pair_functions.hpp"
#include "environment/floating_point_environments.hpp"
#include "extreme_numbers.hpp"
#include "fuzz/fuzz.hpp"
#include "golden/agreement.hpp"
#include "golden/dataset.hpp"
#include "kernel/batch.hpp"
#include "kernel/batch_pairs.hpp"

namespace contact::fuzz::bits {
namespace {

/// Numbers of a question, whatever the bytes: eight bytes a number, missing ones 0.
class Numbers {
 public:
  explicit Numbers(Bytes bytes) : rest_(bytes) {}

  [[nodiscard]] std::uint64_t bits() {
    std::uint64_t value = 0;
    const std::size_t n = std::min<std::size_t>(rest_.size(), 8);
    std::memcpy(&value, rest_.data(), n);
    rest_ = rest_.subspan(n);
    return value;
  }
  /// What is not finite becomes a finite number of the same sign and fraction.
  [[nodiscard]] double any() { return finite_of(bits()); }
  [[nodiscard]] double length() { return std::abs(any()); }
  template <class Shape>
  void fill(Shape& shape) {
    for_each_field(shape, [this](const auto& field, auto& value) {
      const auto number = [&] { return field.kind == FieldKind::length ? length() : any(); };
      for_each_number_in(value, [&](double& x) { x = number(); });
    });
  }

 private:
  Bytes rest_;
};

/// Of most shapes any numbers will do.
template <class Shape>
void in_order(Shape& /*shape*/) {}
void in_order(Box& box) { box = Box{box.min.cwiseMin(box.max), box.min.cwiseMax(box.max)}; }

using Row = std::array<std::uint64_t, 11>;

Row row_of(const std::optional<Contact>& contact) {
  Row bits{};
  if (!contact) return bits;
  std::size_t k = 0;
  for (const Vector3* v : {&contact->normal, &contact->point1, &contact->point2})
    for (int axis = 0; axis < 3; ++axis) bits[k++] = std::bit_cast<std::uint64_t>((*v)[axis]);
  bits[k++] = std::bit_cast<std::uint64_t>(contact->value);
  bits[k] = contact->degenerate ? 2 : 1;
  return bits;
}

/// Zeros of either sign are one to the oracles.
Row without_signs_of_zeros(Row bits) {
  for (std::uint64_t& b : bits)
    if (b == std::uint64_t{1} << 63) b = 0;
  return bits;
}

/// Pairs of a batch: every lane of a vector and some behind the last whole one.
constexpr std::size_t kPairs = 11;

/// What stands beside the pair that is asked about: of the same shapes, with the numbers 0, 1, 2 and so on.
template <class A, class B>
Two<A, B> neighbour(Two<A, B> shapes) {
  double next = 0;
  const auto count = [&](double& number) { number = next++; };
  for_each_number(shapes.a, count);
  for_each_number(shapes.b, count);
  return shapes;
}

/// Where the pair that is asked about stands in a batch: in two lanes, since what is left to exact arithmetic is slow.
bool is_asked(std::size_t lane, std::uint64_t kind) {
  return lane == kind / 32 % kPairs || lane == kind / 32 / kPairs % kPairs;
}

/// While fuzzing, one instruction set an input, so that more of them are tried; else all.
std::vector<std::string> chosen_sets([[maybe_unused]] std::uint64_t chooser) {
  std::vector<std::string> sets = kernel::instruction_sets();
#ifdef CONTACT_LIBFUZZER
  sets = {sets[chooser % sets.size()]};
#endif
  return sets;
}

/// Production with one instruction set after the other, in an environment, held against `right`.
template <class A, class B>
void try_production(const Two<A, B>& shapes, const Query& query, const Expectation& right, std::uint64_t kind,
                    std::uint64_t chooser) {
  static const auto environments = floating_point_environments();
  const FloatingPointEnvironment& environment = environments[kind / 4 % environments.size()];
  const Two<A, B> beside = neighbour(shapes);
  for (const std::string& set : chosen_sets(chooser)) {
    kernel::use_instruction_set(set);
    std::string differs;
    bool hit = false;
    bool beside_hit = false;
    std::optional<Contact> one;
    std::optional<Contact> beside_one;
    in_environment(environment, [&] {
      hit = is_hit(shapes, query.distances);
      one = contact_of(shapes, query.distances);
      beside_hit = is_hit(beside, query.distances);
      beside_one = contact_of(beside, query.distances);
    });
    if (hit != right.hit) differs = "is_hit";
    if (without_signs_of_zeros(row_of(one)) != without_signs_of_zeros(row_of(right.contact))) differs = "contact_of";
    if constexpr (batch::Decides<A, B>) {
      batch::Pairs<A, B> pairs(kPairs);
      for (std::size_t i = 0; i < kPairs; ++i) pairs.set(i, is_asked(i, kind) ? shapes : beside);
      in_environment(environment, [&] {
        pairs.test(query.distances.alarm);
        if constexpr (batch::Computes<A, B>) pairs.compute(query.distances);
      });
      for (std::size_t i = 0; i < kPairs; ++i) {
        if ((pairs.hit()[i] != 0) != (is_asked(i, kind) ? hit : beside_hit)) differs = "batch::test";
        if constexpr (batch::Computes<A, B>)
          if (row_of(pairs.contact(i)) != row_of(is_asked(i, kind) ? one : beside_one)) differs = "batch::compute";
      }
    }
    require(differs.empty(), differs + " with " + set + ", rounding " + environment.name +
                                 ", is not what the oracles say of\n" + golden::query_line(query, Scalar::binary64));
  }
  kernel::use_instruction_set("");
}

void try_input(Bytes bytes) {
  Numbers numbers(bytes);
  const std::uint64_t kind = numbers.bits();
  // The pair by the last byte, so that inputs keep theirs when others join.
  static const std::vector<Pair> pairs = pairs_of_kinds();
  Query query = zero_query(pairs[(kind >> 56) % pairs.size()]);
  std::visit(
      [&](auto& shapes) {
        numbers.fill(shapes.a);
        numbers.fill(shapes.b);
        in_order(shapes.a);
        in_order(shapes.b);
      },
      query.shapes);
  query.distances.alarm = numbers.length();
  query.distances.contact = numbers.length();
  if (outside_domain(query)) return;
  const oracle::Truth truth = oracle::truth_of(query);
  for (const Scalar scalar : kScalars) golden::check_stage(query, truth, oracle::staged_answer(query, scalar), scalar);
  const std::size_t chooser =
      std::hash<std::string_view>{}({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  const Expectation right = oracle::expectation(truth, Scalar::binary64);
  std::visit([&](const auto& shapes) { try_production(shapes, query, right, kind, chooser); }, query.shapes);
}

const Target target("bits", try_input);

}  // namespace
}  // namespace contact::fuzz::bits
