// A question: pair kind, two shapes, alarm and contact distance. Plain data, shared by every floor.
#pragma once

#include <array>
#include <concepts>
#include <iterator>
#include <optional>
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
[[nodiscard]] inline std::string shapes_of(Pair pair) {
  return std::visit(
      []<class A, class B>(const Two<A, B>&) {
        const std::string first = (std::same_as<A, Cast> ? "cast " : "") + std::string(ShapeDescription<A>::kName);
        return std::same_as<A, B> ? first + "s" : first + " and " + std::string(ShapeDescription<B>::kName);
      },
      description(pair).zeros());
}

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

/// Calls visit("a.center", value&, kind) for every field of a question in the canonical order: a, b, alarm, contact.
template <class AnyQuery, class Visit>
requires std::same_as<std::remove_const_t<AnyQuery>, Query>
void for_each_field(AnyQuery& query, Visit&& visit) {
  std::visit(
      [&](auto& shapes) {
        const auto shape = [&](const std::string& prefix, auto& s) {
          for_each_field(
              s, [&](const auto& field, auto& value) { visit(prefix + std::string(field.name), value, field.kind); });
        };
        shape("a.", shapes.a);
        shape("b.", shapes.b);
      },
      query.shapes);
  visit(std::string("alarm"), query.distances.alarm, FieldKind::length);
  visit(std::string("contact"), query.distances.contact, FieldKind::length);
}

/// Calls visit(value&) for every field in that order: names take time to make.
template <class Visit>
void for_each_value(Query& query, Visit&& visit) {
  const auto value_of = [&](const auto& /*field*/, auto& value) { visit(value); };
  std::visit([&](auto& shapes) { for_each_field(shapes.a, value_of), for_each_field(shapes.b, value_of); },
             query.shapes);
  visit(query.distances.alarm);
  visit(query.distances.contact);
}

/// Calls visit("a.center[0]", number&) for every number of a question in that order.
template <class AnyQuery, class Visit>
requires std::same_as<std::remove_const_t<AnyQuery>, Query>
void for_each_number(AnyQuery& query, Visit&& visit) {
  for_each_field(query, [&](const std::string& field, auto& value, FieldKind /*kind*/) {
    int k = 0;
    for_each_number_in(value, [&](auto& number) { visit(field + place_in(value, k++), number); });
  });
}

/// The same without names, which take time to make.
template <class Visit>
void for_each_number_unnamed(const Query& query, Visit&& visit) {
  std::visit([&](const auto& shapes) { for_each_number(shapes.a, visit), for_each_number(shapes.b, visit); },
             query.shapes);
  visit(query.distances.alarm);
  visit(query.distances.contact);
}

/// Whether every number of a question lies inside the domain.
[[nodiscard]] inline bool inside_domain(const Query& query) {
  const auto length = [](double x) { return is_finite_by_bits(x) && !is_less_by_bits(x, 0); };
  return length(query.distances.alarm) && length(query.distances.contact) &&
         std::visit([&](const auto& shapes) { return inside_domain(shapes.a) && inside_domain(shapes.b); },
                    query.shapes);
}

/// The first number of a question that lies outside the domain, or nothing.
[[nodiscard]] inline std::optional<DomainError> outside_domain(const Query& query) {
  if (inside_domain(query)) return std::nullopt;
  return std::visit(
      [&](const auto& shapes) -> std::optional<DomainError> {
        if (auto error = outside_domain("a", shapes.a)) return error;
        if (auto error = outside_domain("b", shapes.b)) return error;
        return outside_domain(query.distances);
      },
      query.shapes);
}

}  // namespace contact
