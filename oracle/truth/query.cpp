// What is asked of every kind of shapes, once for all that ask it.
#include "oracle/truth/query.hpp"

#include <optional>
#include <string>
#include <variant>

namespace contact {

std::string shapes_of(Pair pair) {
  return std::visit(
      []<class A, class B>(const Two<A, B>&) {
        const std::string first = (std::same_as<A, Cast> ? "cast " : "") + std::string(ShapeDescription<A>::kName);
        return std::same_as<A, B> ? first + "s" : first + " and " + std::string(ShapeDescription<B>::kName);
      },
      description(pair).zeros());
}

#define CONTACT_HAS_ROOM(A, B)                                                    \
  static_assert(std::size(kFieldNames<A>) + std::size(kFieldNames<B>) + 2 <= 8 && \
                kNumbersOf<A> + kNumbersOf<B> + 2 <= 20);
CONTACT_KINDS(CONTACT_HAS_ROOM)
#undef CONTACT_HAS_ROOM

UpTo<QueryField, 8> fields_of(Query& query) {
  UpTo<QueryField, 8> fields;
  std::visit(
      [&](auto& shapes) {
        const auto add = [&](std::string_view shape, auto& of) {
          for_each_field(of, [&](const auto& field, auto& value) {
            fields.add({shape, field.name, &value, field.kind});
          });
        };
        add("a.", shapes.a);
        add("b.", shapes.b);
      },
      query.shapes);
  fields.add({"", "alarm", &query.distances.alarm, FieldKind::length});
  fields.add({"", "contact", &query.distances.contact, FieldKind::length});
  return fields;
}

UpTo<double*, 20> numbers_of(Query& query) {
  UpTo<double*, 20> numbers;
  const auto add = [&](double& number) { numbers.add(&number); };
  std::visit([&](auto& shapes) { for_each_number(shapes.a, add), for_each_number(shapes.b, add); }, query.shapes);
  add(query.distances.alarm);
  add(query.distances.contact);
  return numbers;
}

bool inside_domain(const Query& query) {
  const auto length = [](double x) { return is_finite_by_bits(x) && !is_less_by_bits(x, 0); };
  return length(query.distances.alarm) && length(query.distances.contact) &&
         std::visit([&](const auto& shapes) { return inside_domain(shapes.a) && inside_domain(shapes.b); },
                    query.shapes);
}

std::optional<DomainError> outside_domain(const Query& query) {
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
