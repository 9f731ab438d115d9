// Questions about any two convex shapes: drawn from any numbers, and laid out so that features face each other, with boxes that are turned exactly.
#include <algorithm>

#include "golden/families.hpp"
#include "proptests/generators.hpp"

namespace contact::proptests {
namespace {

/// Boxes that are turned as one of few, so that their vertices are short numbers too.
Query turned_exactly(Query query, std::size_t which) {
  static constexpr std::array<Quaternion, 5> kTurns{
      {{0, 0, 0, 1}, {1, 1, 1, 1}, {1, 0, 0, 1}, {0, 0, 1, 0}, {1, 2, 2, 0}}};
  for_each_shape(query, [&]<class Shape>(Shape& shape) {
    if constexpr (std::same_as<Shape, Obb>) shape.orientation = kTurns[which++ % kTurns.size()];
  });
  return query;
}
/// The second shape about the first point of the first one: they overlap.
Query about_one_place(Query query) {
  std::optional<Vector3> from;
  std::optional<Vector3> to;
  int which = 0;
  for_each_shape(query, [&](const auto& shape) {
    for_each_point(shape, [&](const Vector3& v) {
      auto& first = which == 0 ? from : to;
      if (!first) first = v;
    });
    ++which;
  });
  if (!from || !to) return query;
  const Vector3 by = *from - *to;
  Query moved = query;
  which = 0;
  for_each_shape(moved, [&](auto& shape) {
    if (which++ == 0) return;
    for_each_point(shape, [&](Vector3& v) { v += by; });
  });
  return moved;
}

/// What a family of golden files makes.
rc::Gen<Query> of_a_family(Pair pair, const Range& range, std::string_view name) {
  return rc::gen::map(integer(0, 1'000'000), [pair, range, name](int index) {
    Query query = golden::generate_query(pair, *golden::find_family(pair, name), range.scalar, 1,
                                         static_cast<std::uint64_t>(index));
    return range.contains(query) ? query : query_of(pair, {});
  });
}

}  // namespace

rc::Gen<Query> queries(Pair pair, const Convexes* /*kind*/, const Range& range) {
  const LaidOut laid = [pair, range](rc::Gen<double> number) {
    return rc::gen::map(rc::gen::tuple(made_of(pair, std::move(number)), integer(0, 1000), integer(0, 2)),
                        [range](const std::tuple<Query, int, int>& parts) {
                          const auto& [drawn, which, how] = parts;
                          const Query query = how == 0 ? drawn : turned_exactly(drawn, static_cast<std::size_t>(which));
                          const Query placed = how == 2 ? about_one_place(query) : query;
                          return range.contains(placed) ? placed : query;
                        });
  };
  return at_every_scale(
      pair, range, laid,
      rc::gen::oneOf(of_a_family(pair, range, "touching"), of_a_family(pair, range, "alarm_edge"),
                     of_a_family(pair, range, "near_tied_depths"), of_a_family(pair, range, "nested")));
}

}  // namespace contact::proptests
