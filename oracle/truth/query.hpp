// A question: pair kind, two shapes, alarm and contact distance. Plain data, shared by every floor.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "contact/domain.hpp"
#include "contact/pairs.hpp"

namespace contact {

inline constexpr auto kPairs = [] {
  std::array<Pair, std::size(kPairTable)> pairs{};
  for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i] = kPairTable[i].pair;
  return pairs;
}();
inline constexpr auto kPairNames = [] {
  std::array<std::string_view, std::size(kPairTable)> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = kPairTable[i].name;
  return names;
}();

/// The kind of a pair: its place among the alternatives of Shapes.
[[nodiscard]] inline std::size_t kind_of(Pair pair) { return description(pair).zeros().index(); }
/// The first pair of every kind.
[[nodiscard]] inline std::vector<Pair> pairs_of_kinds() {
  std::vector<Pair> first(std::variant_size_v<Shapes>);
  for (std::size_t i = kPairs.size(); i-- > 0;) first[kind_of(kPairs[i])] = kPairs[i];
  return first;
}
/// What a pair's shapes are called together: "spheres" where both are the same, else "sphere and point". A ray that is
/// cast is called so.
[[nodiscard]] std::string shapes_of(Pair pair);
/// The same of all pairs of its kind.
[[nodiscard]] std::string shapes_of_kind(Pair pair);

/// The number format that answers are rounded to.
enum class Scalar { binary32, binary64 };
inline constexpr std::array kScalars{Scalar::binary64, Scalar::binary32};

[[nodiscard]] constexpr std::string_view name(Scalar scalar) {
  return scalar == Scalar::binary32 ? "binary32" : "binary64";
}

/// Radix 2, `precision` significant bits, normal numbers from 2^min_exponent, all numbers below 2^(max_exponent + 1).
struct Format {
  int precision;
  int min_exponent;
  int max_exponent;
};
[[nodiscard]] constexpr Format format_of(Scalar scalar) {
  return scalar == Scalar::binary32 ? Format{24, -126, 127} : Format{53, -1022, 1023};
}

struct Query {
  Pair pair;
  Shapes shapes;
  Distances distances;

  /// The two shapes where they are spheres, or boxes; else nullptr.
  [[nodiscard]] const Balls* balls() const { return std::get_if<Balls>(&shapes); }
  [[nodiscard]] const Boxes* boxes() const { return std::get_if<Boxes>(&shapes); }
  [[nodiscard]] bool has_numbers() const { return contact::has_numbers(pair); }
  [[nodiscard]] bool has_distance() const { return contact::has_distance(pair); }
  [[nodiscard]] bool first_is_rigid() const { return description(pair).first_is_rigid; }
  [[nodiscard]] bool second_is_rigid() const { return description(pair).second_is_rigid; }
};

/// A question of a pair, every number 0: to be filled in.
[[nodiscard]] inline Query zero_query(Pair pair) { return {pair, description(pair).zeros(), {0, 0}}; }

/// A field of a question: "a." or "b." and its name, where its value stands, and what it is. Code that asks every field or number
/// crosses here from the many kinds of shapes to five types of value, and so is compiled for these alone: an array of vectors is a span.
struct QueryField {
  std::string_view shape;
  std::string_view name;
  std::variant<double*, Vector3*, std::span<Vector3>, Quaternion*, std::vector<Vector3>*> value;
  FieldKind kind;
};

/// How many numbers a field has, along each of its axes: none of a number, one of a vector, two of several vectors.
template <FieldValue Value>
[[nodiscard]] std::vector<std::uint64_t> extents_of(const Value& value) {
  if constexpr (std::same_as<Value, double>)
    return {};
  else if constexpr (SeveralVectors<Value>)
    return {value.size(), 3};
  else
    return {static_cast<std::uint64_t>(value.size())};
}

/// As many as a question can have, of which the first `size` are there.
template <class Element, std::size_t kMost>
struct UpTo {
  std::array<Element, kMost> elements;
  std::size_t size = 0;

  void add(const Element& element) { elements[size++] = element; }
  [[nodiscard]] const Element* begin() const { return elements.data(); }
  [[nodiscard]] const Element* end() const { return elements.data() + size; }
};

/// The fields of a question in the canonical order: a, b, alarm, contact.
[[nodiscard]] UpTo<QueryField, 8> fields_of(Query& query);
/// Its numbers in that order.
inline constexpr std::size_t kMostNumbers = 2 * static_cast<std::size_t>(kNumbersOf<Hull>) + 2;
[[nodiscard]] UpTo<double*, kMostNumbers> numbers_of(Query& query);

template <class Value>
concept AQuery = std::same_as<std::remove_const_t<Value>, Query>;
/// What is constant where the question is.
template <AQuery AnyQuery, class Value>
using Within = std::conditional_t<std::is_const_v<AnyQuery>, const Value, Value>;

/// Calls visit(field, value&) for every field of a question in the canonical order.
template <AQuery AnyQuery, class Visit>
void for_each_query_field(AnyQuery& query, Visit&& visit) {
  for (const QueryField& field : fields_of(const_cast<Query&>(query)))
    std::visit(
        [&]<class Value>(Value value) {
          if constexpr (std::is_pointer_v<Value>) {
            visit(field, static_cast<Within<AnyQuery, std::remove_pointer_t<Value>>&>(*value));
          } else {
            std::span<Within<AnyQuery, Vector3>> vectors = value;
            visit(field, vectors);
          }
        },
        field.value);
}

/// Calls visit("a.center", value&, kind) for every field.
template <AQuery AnyQuery, class Visit>
void for_each_field(AnyQuery& query, Visit&& visit) {
  for_each_query_field(query, [&](const QueryField& field, auto& value) {
    visit(std::string(field.shape) + std::string(field.name), value, field.kind);
  });
}

/// Calls visit(value&) for every field: names take time to make.
template <AQuery AnyQuery, class Visit>
void for_each_value(AnyQuery& query, Visit&& visit) {
  for_each_query_field(query, [&](const QueryField& /*field*/, auto& value) { visit(value); });
}

/// Calls visit("a.center[0]", number&) for every number of a question in that order.
template <AQuery AnyQuery, class Visit>
void for_each_number(AnyQuery& query, Visit&& visit) {
  for_each_field(query, [&](const std::string& field, auto& value, FieldKind /*kind*/) {
    int k = 0;
    for_each_number_in(value, [&](auto& number) { visit(field + place_in(value, k++), number); });
  });
}

/// The same without names, which take time to make.
template <AQuery AnyQuery, class Visit>
void for_each_number_unnamed(AnyQuery& query, Visit&& visit) {
  for (double* number : numbers_of(const_cast<Query&>(query))) visit(static_cast<Within<AnyQuery, double>&>(*number));
}

/// A shape of a question, of whatever type; of one that the pair says, that.
template <class... Shapes>
std::variant<Shapes*..., Ray*, Cast*, Line*> any_of(const std::variant<Shapes...>& convex);
using AnyShape = decltype(any_of(Convex::shape));
[[nodiscard]] std::array<AnyShape, 2> two_shapes(Query& query);
/// Calls visit(shape&) for both, first and second. Code that asks every shape crosses here from the kinds of pairs.
template <AQuery AnyQuery, class Visit>
void for_each_shape(AnyQuery& query, Visit&& visit) {
  for (const AnyShape& any : two_shapes(const_cast<Query&>(query)))
    std::visit([&]<class Shape>(Shape* shape) { visit(static_cast<Within<AnyQuery, Shape>&>(*shape)); }, any);
}

/// Whether every number of a question lies inside the domain.
[[nodiscard]] bool inside_domain(const Query& query);

/// The first number of a question that lies outside the domain, or nothing.
[[nodiscard]] std::optional<DomainError> outside_domain(const Query& query);

}  // namespace contact
