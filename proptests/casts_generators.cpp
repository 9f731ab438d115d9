// Questions about rays that are cast; about rays and lines that cross a triangle.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "proptests/generators.hpp"

namespace contact::proptests {
namespace {

/// The ray is laid through a place of the shape, and begins some eighths of its length before that; what is exact for
/// small integers is nearly so for other numbers. With eighths of 0 and 8 places are on the surface and the ray ends
/// there.
template <class Target>
rc::Gen<Query> casts_laid(Pair pair, const Range& range, rc::Gen<double> number) {
  const auto eighths = integer(-1, 9);
  const auto ulps = rc::gen::weightedElement<int>({{6, 0}, {1, -1}, {1, 1}});
  return rc::gen::map(
      rc::gen::tuple(made_of(pair, std::move(number)), eighths, eighths, eighths, integer(0, 7), ulps),
      [range](const std::tuple<Query, int, int, int, int, int>& drawn) {
        auto [query, s, t, part, kind, step] = drawn;
        auto& [ray, shape] = std::get<CastAt<Target>>(query.shapes);
        const int axis = kind % 3;
        Vector3 at = ray.origin;
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
          if (kind == 6) v[2] = range.rounded(v[0] + t / 4.0 * (v[1] - v[0]));
          if (kind == 7) ray.direction = range.rounded(s / 8.0 * (v[1] - v[0]) + t / 8.0 * (v[2] - v[0]));
          at = v[0] + s / 8.0 * (v[1] - v[0]) + (kind == 3 ? 8 - s : kind > 3 ? t / 2 : t) / 8.0 * (v[2] - v[0]);
        } else if (kind < 4) {
          const double offset = shape.normal.dot(at);
          if (std::isfinite(offset)) shape.offset = range.rounded(offset);
        }
        if (ray.direction.isZero(0)) ray.direction = Vector3(1, 2, -2);
        if (step != 0 && kind % 2 == 0) ray.length = 1;
        ray.origin = range.rounded(at - part / 8.0 * ray.length * ray.direction);
        ray.origin[axis] = range.moved(ray.origin[axis], step);
        return query;
      });
}

template <class Target>
rc::Gen<Query> casts(Pair pair, const Range& range) {
  return rc::gen::weightedOneOf<Query>({{6, casts_laid<Target>(pair, range, ordinary(range))},
                                        {6, casts_laid<Target>(pair, range, small_dyadic(range))},
                                        {1, casts_laid<Target>(pair, range, any_number(range))},
                                        {1, made_of(pair, any_number(range))},
                                        {1, made_of(pair, any_bits(range))},
                                        {2, made_of(pair, small_dyadic(range))}});
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

// Segments that cross a triangle, or pass it, are rays that are cast at it.
rc::Gen<Query> queries(const RayAndTriangle* /*kind*/, const Range& range) {
  return rc::gen::map(casts<Triangle>(Pair::cast_triangle, range), [](const Query& query) {
    const auto& [ray, triangle] = std::get<CastAt<Triangle>>(query.shapes);
    return Query{Pair::ray_triangle, RayAndTriangle{ray, triangle}, query.distances};
  });
}
rc::Gen<Query> queries(const TriangleAndLine* /*kind*/, const Range& range) {
  return rc::gen::map(casts<Triangle>(Pair::cast_triangle, range), [range](const Query& query) {
    const auto& [ray, triangle] = std::get<CastAt<Triangle>>(query.shapes);
    const Vector3 end = range.rounded(ray.origin + ray.length * ray.direction);
    return Query{Pair::triangle_line, TriangleAndLine{triangle, {ray.origin, end}}, query.distances};
  });
}

}  // namespace contact::proptests
