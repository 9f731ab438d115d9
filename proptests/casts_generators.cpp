// Questions about rays that are cast.
#include <algorithm>
#include <cmath>
#include <vector>

#include "proptests/generators.hpp"

namespace contact::proptests {
namespace {

/// A question of a pair from numbers in its order; a length takes their size, a direction of 0 becomes another.
template <class Target>
Query cast_of(Pair pair, const std::vector<double>& numbers) {
  Query query = zero_query(pair);
  std::size_t k = 0;
  for_each_field(query, [&](const std::string& /*field*/, auto& value, FieldKind kind) {
    for_each_number_in(value, [&](double& x) {
      x = numbers[k++];
      if (kind == FieldKind::length) x = std::abs(x);
    });
    if constexpr (std::same_as<std::remove_cvref_t<decltype(value)>, Vector3>)
      if (kind == FieldKind::direction && value.isZero(0)) value = Vector3(1, 2, -2);
  });
  if constexpr (std::same_as<Target, Box>) {
    Box& box = std::get<CastAt<Box>>(query.shapes).b;
    const Box any = box;
    box = {any.min.cwiseMin(any.max), any.min.cwiseMax(any.max)};
  }
  return query;
}
template <class Target>
constexpr std::size_t kNumbers = static_cast<std::size_t>(kNumbersOf<Cast> + kNumbersOf<Target>) + 2;

template <class Target>
rc::Gen<Query> casts_from(Pair pair, rc::Gen<double> number) {
  return rc::gen::map(numbers(kNumbers<Target>, std::move(number)),
                      [pair](const std::vector<double>& x) { return cast_of<Target>(pair, x); });
}

/// The ray is laid through a place of the shape, and begins some eighths of its length before that; what is exact for
/// small integers is nearly so for other numbers. With eighths of 0 and 8 places are on the surface and the ray ends
/// there.
template <class Target>
rc::Gen<Query> casts_laid(Pair pair, const Range& range, rc::Gen<double> number) {
  const auto eighths = integer(-1, 9);
  const auto ulps = rc::gen::weightedElement<int>({{6, 0}, {1, -1}, {1, 1}});
  return rc::gen::map(
      rc::gen::pair(numbers(kNumbers<Target>, std::move(number)),
                    rc::gen::tuple(eighths, eighths, eighths, integer(0, 7), ulps)),
      [pair, range](const std::pair<std::vector<double>, std::tuple<int, int, int, int, int>>& drawn) {
        const auto [s, t, part, kind, step] = drawn.second;
        Query query = cast_of<Target>(pair, drawn.first);
        const auto in_range = [&](const Vector3& v) -> Vector3 {
          return v.unaryExpr([&](double y) { return std::isfinite(y) ? range.rounded(y) : 0.0; });
        };
        auto& [ray, shape] = std::get<CastAt<Target>>(query.shapes);
        const int axis = kind % 3;
        Vector3 at(drawn.first[0], drawn.first[1], drawn.first[2]);
        if constexpr (std::same_as<Target, Ball>) {
          at = shape.center + t / 8.0 * shape.radius * Vector3::Unit(axis);
        } else if constexpr (std::same_as<Target, Capsule>) {
          if (kind == 6) shape.end = shape.start;
          if (kind == 7) shape.radius = 0;
          at = shape.start + s / 8.0 * (shape.end - shape.start) + t / 8.0 * shape.radius * Vector3::Unit(axis);
          if (kind >= 3 && kind < 5) ray.direction[axis] = 0;
        } else if constexpr (std::same_as<Target, Box>) {
          if (kind == 6) shape.max[axis] = shape.min[axis];
          for (int i = 0; i < 3; ++i)
            at[i] = shape.min[i] + (i == axis ? s : i == (axis + 1) % 3 ? t : 3) / 8.0 * (shape.max[i] - shape.min[i]);
          if (kind >= 3 && kind < 6) ray.direction[axis] = 0;
        } else if constexpr (std::same_as<Target, Triangle>) {
          auto& v = shape.vertices;
          if (kind == 6) v[2] = in_range(v[0] + t / 4.0 * (v[1] - v[0]));
          if (kind == 7) ray.direction = in_range(s / 8.0 * (v[1] - v[0]) + t / 8.0 * (v[2] - v[0]));
          at = v[0] + s / 8.0 * (v[1] - v[0]) + (kind == 3 ? 8 - s : t) / 8.0 * (v[2] - v[0]);
        } else if (kind < 4) {
          const double offset = shape.normal.dot(at);
          if (std::isfinite(offset)) shape.offset = range.rounded(offset);
        }
        if (ray.direction.isZero(0)) ray.direction = Vector3(1, 2, -2);
        if (step != 0 && kind % 2 == 0) ray.length = 1;
        ray.origin = in_range(at - part / 8.0 * ray.length * ray.direction);
        ray.origin[axis] = range.moved(ray.origin[axis], step);
        return query;
      });
}

template <class Target>
rc::Gen<Query> casts(Pair pair, const Range& range) {
  return rc::gen::weightedOneOf<Query>({{6, casts_laid<Target>(pair, range, ordinary(range))},
                                        {6, casts_laid<Target>(pair, range, small_dyadic(range))},
                                        {1, casts_laid<Target>(pair, range, any_number(range))},
                                        {1, casts_from<Target>(pair, any_number(range))},
                                        {1, casts_from<Target>(pair, any_bits(range))},
                                        {2, casts_from<Target>(pair, small_dyadic(range))}});
}

}  // namespace

rc::Gen<Query> queries(const CastAt<Ball>* /*kind*/, const Range& range) {
  return casts<Ball>(Pair::cast_sphere, range);
}
rc::Gen<Query> queries(const CastAt<Box>* /*kind*/, const Range& range) { return casts<Box>(Pair::cast_cube, range); }
rc::Gen<Query> queries(const CastAt<Capsule>* /*kind*/, const Range& range) {
  return casts<Capsule>(Pair::cast_capsule, range);
}
rc::Gen<Query> queries(const CastAt<Triangle>* /*kind*/, const Range& range) {
  return casts<Triangle>(Pair::cast_triangle, range);
}
rc::Gen<Query> queries(const CastAt<Plane>* /*kind*/, const Range& range) {
  return casts<Plane>(Pair::cast_plane, range);
}

}  // namespace contact::proptests
