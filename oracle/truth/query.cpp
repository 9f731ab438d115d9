// What is asked of every kind of shapes, once for all that ask it.
#include "oracle/truth/query.hpp"

#include <optional>
#include <string>
#include <variant>

namespace contact {

namespace {

template <class Shape>
AnyShape any(Shape& shape) {
  return &shape;
}
AnyShape any(Convex& convex) {
  return std::visit([](auto& shape) -> AnyShape { return &shape; }, convex.shape);
}

}  // namespace

std::array<AnyShape, 2> two_shapes(Query& query) {
  return std::visit([](auto& shapes) { return std::array{any(shapes.a), any(shapes.b)}; }, query.shapes);
}

std::string shapes_of(Pair pair) {
  std::vector<std::string> names;
  const Query zeros = zero_query(pair);
  for_each_shape(zeros, [&]<class Shape>(const Shape&) {
    names.push_back((std::same_as<Shape, Cast> ? "cast " : "") + std::string(ShapeDescription<Shape>::kName));
  });
  return names[0] == names[1] ? names[0] + "s" : names[0] + " and " + names[1];
}

std::string shapes_of_kind(Pair pair) { return is_convex(pair) ? "any two convex shapes" : shapes_of(pair); }

#define CONTACT_HAS_ROOM(A, B) static_assert(kNumbersOf<A> + kNumbersOf<B> + 2 <= static_cast<int>(kMostNumbers));
CONTACT_KINDS(CONTACT_HAS_ROOM)
#undef CONTACT_HAS_ROOM

UpTo<QueryField, 8> fields_of(Query& query) {
  UpTo<QueryField, 8> fields;
  std::visit(
      [&](auto& shapes) {
        const auto add = [&](std::string_view shape, auto& of) {
          for_each_field(of, [&]<class Value>(const auto& field, Value& value) {
            if constexpr (SeveralVectors<Value> && !AnyNumberOfVectors<Value>)
              fields.add({shape, field.name, std::span(value), field.kind});
            else
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

UpTo<double*, kMostNumbers> numbers_of(Query& query) {
  UpTo<double*, kMostNumbers> numbers;
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
