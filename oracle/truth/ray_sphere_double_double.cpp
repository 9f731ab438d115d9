// A ray and a sphere in pairs of doubles.
#include "oracle/truth/double_double_segments.hpp"

namespace contact::oracle {

std::optional<RoundedAnswer> double_double_answer(const RayAndBall& shapes, Distances distances, Scalar scalar) {
  const auto& [a, b] = shapes;
  constexpr int kMost = 40;  // of two factors, so that their product is short
  if (!in_short_range({a.origin, b.center}) || !in_range(a.direction, kMost) || !in_range(a.length, kMost))
    return std::nullopt;
  DoubleDoubleSegment ray{a.origin, exactly(a.direction), exactly(a.origin), a.length == 0};
  for (std::size_t i = 0; i < 3; ++i) {
    ray.along[i] = DoubleDouble{a.length} * ray.along[i];
    ray.end[i] = ray.end[i] + ray.along[i];
  }
  auto nearest = foot(b.center, ray);
  if (nearest)
    nearest = DoubleDoubleNearest{nearest->q, nearest->p, {-nearest->delta[0], -nearest->delta[1], -nearest->delta[2]}};
  return case_of_apart(nearest, 0, b.radius, distances, scalar);
}

}  // namespace contact::oracle
