// Rays that are cast at shapes, in intervals: along the ray, from piece to piece of what is convex. No quotient is
// formed before the last, so that what is exact stays exact.
//   sphere, capsule        the squared distance from the axis, less r^2, is a parabola beside each part of it, and
//   convex box, plane, triangle   in each of some half-spaces from some t on, or up to some t: the last to begin, the
//   first to end
#include <algorithm>
#include <cstddef>
#include <vector>

#include "oracle/truth/interval_cores.hpp"

namespace contact::oracle {
namespace casts {
namespace {

const RoundedAnswer kMiss{1, 1, {}};

/// A ray, and how its answer is rounded.
struct IntervalRay {
  IntervalRay(const Ray& ray, Scalar s, mpfr_prec_t bits)
      : scalar(s),
        precision(bits),
        o(triple(bits, ray.origin)),
        d(triple(bits, ray.direction)),
        length(bits, ray.length) {}

  [[nodiscard]] Interval number(double x) const { return {precision, x}; }
  [[nodiscard]] Triple point(const Vector3& v) const { return triple(precision, v); }
  [[nodiscard]] Triple zero() const { return point(Vector3::Zero()); }

  Scalar scalar;
  mpfr_prec_t precision;
  Triple o;
  Triple d;
  Interval length;
};

Triple negative(const Triple& x) { return difference(difference(x, x), x); }

Vector3 rounded_unit(const IntervalRay& ray, const Triple& along) {
  const Interval length = (along[0].squared() + along[1].squared() + along[2].squared()).root();
  return rounded(ray.scalar, [&](std::size_t i) { return along[i] / length; });
}
RoundedAnswer hit(const Vector3& normal, const Vector3& point, double value, bool inside) {
  RoundedAnswer answer{-1, -1, {true, std::nullopt}};
  answer.expected.contact = Contact{normal, point, point, value, inside};
  return answer;
}
RoundedAnswer from_inside(const IntervalRay& ray) {
  const Vector3 point = rounded(ray.scalar, [&](std::size_t i) { return ray.o[i]; });
  return hit(rounded_unit(ray, negative(ray.d)), point, 0, true);
}
/// At t = part / over, over > 0.
RoundedAnswer hit_at(const IntervalRay& ray, const Interval& part, const Interval& over, const Vector3& normal) {
  const Vector3 point = rounded(ray.scalar, [&](std::size_t i) { return (ray.o[i] * over + part * ray.d[i]) / over; });
  return hit(normal, point, settled((part / over).rounded(ray.scalar)), false);
}

/// Of the directions along none of some ways, each divided by the sum of the absolute values of its components, the
/// lexicographically greatest: each octant's corners, the way beyond each way cut off.
Triple greatest_along_none(const IntervalRay& ray, const std::vector<Triple>& ways) {
  std::vector<Triple> corners;
  for (int octant = 0; octant < 8; ++octant) {
    std::vector<Triple> polygon;
    for (int axis = 0; axis < 3; ++axis)
      polygon.push_back(ray.point(Vector3::Unit(axis) * ((octant >> axis & 1) != 0 ? -1 : 1)));
    for (const Triple& way : ways) {
      std::vector<Triple> left;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Triple& here = polygon[i];
        const Triple& next = polygon[(i + 1) % polygon.size()];
        const Interval past_here = dot(here, way);
        const Interval past_next = dot(next, way);
        const int side = sign_of(past_here);
        if (side <= 0) left.push_back(here);
        if (side * sign_of(past_next) >= 0) continue;
        // Between the two, on the boundary: a sum with weights above 0.
        const Interval a = side > 0 ? past_here : ray.number(0) - past_here;
        const Interval b = side > 0 ? ray.number(0) - past_next : past_next;
        left.push_back({here[0] * b + next[0] * a, here[1] * b + next[1] * a, here[2] * b + next[2] * a});
      }
      polygon.swap(left);
    }
    for (const Triple& corner : polygon) corners.push_back(corner);
  }
  const auto magnitude = [&](const Interval& x) { return sign_of(x) < 0 ? ray.number(0) - x : x; };
  const auto size = [&](const Triple& n) { return magnitude(n[0]) + magnitude(n[1]) + magnitude(n[2]); };
  std::size_t greatest = 0;
  for (std::size_t k = 1; k < corners.size(); ++k) {
    const Interval here = size(corners[k]);
    const Interval best = size(corners[greatest]);
    for (std::size_t i = 0; i < 3; ++i) {
      const int order = sign_of(corners[k][i] * best - corners[greatest][i] * here);
      if (order > 0) greatest = k;
      if (order != 0) break;
    }
  }
  return corners[greatest];
}

/// A t^2 + 2 B t + C, which is <= 0 in the shape; A >= 0.
struct Parabola {
  Interval A;
  Interval B;
  Interval C;

  [[nodiscard]] Interval discriminant() const { return B.squared() - A * C; }
  /// At n / m, m > 0, times m^2; and half of its slope there, times m.
  [[nodiscard]] Interval at(const Interval& n, const Interval& m) const {
    const Interval middle = B * n * m;
    return A * n.squared() + middle + middle + C * m.squared();
  }
  [[nodiscard]] Interval slope_at(const Interval& n, const Interval& m) const { return A * n + B * m; }
};

/// The first t of a parabola that falls at the origin and is above 0 there: (-B - sqrt(B^2 - A C)) / A.
struct FirstRoot {
  Interval part;
  Interval over;
};
std::optional<FirstRoot> first_root(const IntervalRay& ray, const Parabola& f) {
  const Interval D = f.discriminant();
  if (sign_of(D) < 0) return std::nullopt;
  const Interval before = ray.number(0) - f.B;
  const Interval short_of = before - ray.length * f.A;
  if (sign_of(short_of) > 0 && sign_of(short_of.squared() - D) > 0) return std::nullopt;
  return FirstRoot{before - D.root(), f.A};
}

/// The normal is (base + t turn) / size.
Vector3 normal_at(const IntervalRay& ray, const FirstRoot& t, const Triple& base, const Triple& turn,
                  const Interval& size) {
  return rounded(ray.scalar, [&](std::size_t i) { return (base[i] * t.over + t.part * turn[i]) / (t.over * size); });
}
/// From a point of the ray to some others, t.over times.
std::vector<Triple> ways_from(const IntervalRay& ray, const FirstRoot& t, std::initializer_list<Vector3> others) {
  std::vector<Triple> ways;
  for (const Vector3& other : others) {
    const Triple w = difference(ray.point(other), ray.o);
    ways.push_back(
        {w[0] * t.over - t.part * ray.d[0], w[1] * t.over - t.part * ray.d[1], w[2] * t.over - t.part * ray.d[2]});
  }
  return ways;
}

Parabola around(const IntervalRay& ray, const Triple& w, const Interval& radius) {
  return {dot(ray.d, ray.d), dot(ray.d, w), dot(w, w) - radius.squared()};
}

RoundedAnswer answer(const IntervalRay& ray, const Ball& ball) {
  const Interval radius = ray.number(ball.radius);
  const Triple w = difference(ray.o, ray.point(ball.center));
  const Parabola f = around(ray, w, radius);
  if (sign_of(f.C) <= 0) return from_inside(ray);
  if (sign_of(f.B) >= 0) return kMiss;
  const auto t = first_root(ray, f);
  if (!t) return kMiss;
  const Vector3 normal =
      ball.radius == 0 ? rounded_unit(ray, greatest_along_none(ray, {})) : normal_at(ray, *t, w, ray.d, radius);
  return hit_at(ray, t->part, t->over, normal);
}

RoundedAnswer answer(const IntervalRay& ray, const Capsule& capsule) {
  enum Beside { start, axis, end };
  const Interval radius = ray.number(capsule.radius);
  const Triple w = difference(ray.o, ray.point(capsule.start));
  const Triple u = difference(ray.point(capsule.end), ray.point(capsule.start));
  const Interval U = dot(u, u);
  const Interval level = dot(u, w);
  const Interval rise = dot(u, ray.d);
  const auto parabola = [&](Beside beside) -> Parabola {
    if (beside != axis) return around(ray, beside == start ? w : difference(w, u), radius);
    const Triple across = cross(u, w);
    const Triple turning = cross(u, ray.d);
    return {dot(turning, turning), dot(turning, across), dot(across, across) - radius.squared() * U};
  };
  int beside = sign_of(level) <= 0 ? start : sign_of(level - U) >= 0 ? end : axis;
  const Parabola first = parabola(static_cast<Beside>(beside));
  if (sign_of(first.C) <= 0) return from_inside(ray);
  if (sign_of(first.B) >= 0) return kMiss;
  const int step = sign_of(rise);
  const Interval speed = step < 0 ? ray.number(0) - rise : rise;
  // On to the next part while it neither hits nor rises where this one ends.
  while (step > 0 ? beside != end : step < 0 && beside != start) {
    const bool to_start = step > 0 ? beside == start : beside == axis;
    const Interval up = to_start ? ray.number(0) - level : U - level;
    const Interval ends = step > 0 ? up : ray.number(0) - up;
    const Parabola f = parabola(static_cast<Beside>(beside));
    if (sign_of(f.at(ends, speed)) <= 0 || sign_of(f.slope_at(ends, speed)) >= 0) break;
    beside += step;
  }
  const auto t = first_root(ray, parabola(static_cast<Beside>(beside)));
  if (!t) return kMiss;
  const auto normal = [&]() -> Vector3 {
    if (capsule.radius == 0)
      return rounded_unit(ray, greatest_along_none(ray, ways_from(ray, *t, {capsule.start, capsule.end})));
    if (beside != axis) return normal_at(ray, *t, beside == start ? w : difference(w, u), ray.d, radius);
    const auto across = [&](const Triple& v, const Interval& along) {
      return Triple{U * v[0] - along * u[0], U * v[1] - along * u[1], U * v[2] - along * u[2]};
    };
    return normal_at(ray, *t, across(w, level), across(ray.d, rise), U * radius);
  };
  return hit_at(ray, t->part, t->over, normal());
}

/// n.x <= offset.
struct HalfSpace {
  Triple n;
  Interval offset;
};
HalfSpace behind(const Triple& n, const Triple& point) { return {n, dot(n, point)}; }

struct Clipped {
  bool inside;
  FirstRoot t;
};
/// Where a ray is in all of some half-spaces first; nothing where it never is.
std::optional<Clipped> clipped(const IntervalRay& ray, const std::vector<HalfSpace>& all) {
  bool inside = true;
  std::optional<FirstRoot> begin;
  std::optional<FirstRoot> end;
  const auto later = [](const FirstRoot& x, const FirstRoot& y) {
    return sign_of(x.part * y.over - y.part * x.over) > 0;
  };
  for (const HalfSpace& half : all) {
    const Interval depth = half.offset - dot(half.n, ray.o);
    const Interval rate = dot(half.n, ray.d);
    const int out = sign_of(rate);
    const bool is_in = sign_of(depth) >= 0;
    inside = inside && is_in;
    if (!is_in && out >= 0) return std::nullopt;
    if (out == 0) continue;
    const Interval none = ray.number(0);
    const FirstRoot t = out > 0 ? FirstRoot{depth, rate} : FirstRoot{none - depth, none - rate};
    auto& side = out > 0 ? end : begin;
    if (!side || later(out > 0 ? *side : t, out > 0 ? t : *side)) side.emplace(t);
  }
  if (inside) return Clipped{true, {ray.number(0), ray.number(1)}};
  if (end && later(*begin, *end)) return std::nullopt;
  if (sign_of(begin->part - ray.length * begin->over) > 0) return std::nullopt;
  return Clipped{false, *begin};
}
bool is_on(const IntervalRay& ray, const FirstRoot& t, const HalfSpace& half) {
  return sign_of((half.offset - dot(half.n, ray.o)) * t.over - dot(half.n, ray.d) * t.part) == 0;
}
/// The normal is that of the first boundary that the point is on.
RoundedAnswer answer_among(const IntervalRay& ray, const std::vector<HalfSpace>& all) {
  const auto found = clipped(ray, all);
  if (!found) return kMiss;
  if (found->inside) return from_inside(ray);
  const auto face = std::find_if(all.begin(), all.end(), [&](const HalfSpace& h) { return is_on(ray, found->t, h); });
  return hit_at(ray, found->t.part, found->t.over, rounded_unit(ray, face->n));
}

RoundedAnswer answer(const IntervalRay& ray, const Box& box) {
  std::vector<HalfSpace> faces;  // the lexicographically greatest normals first
  for (int axis = 0; axis < 3; ++axis) faces.push_back(behind(ray.point(Vector3::Unit(axis)), ray.point(box.max)));
  for (int axis = 3; axis-- > 0;) faces.push_back(behind(ray.point(-Vector3::Unit(axis)), ray.point(box.min)));
  return answer_among(ray, faces);
}
RoundedAnswer answer(const IntervalRay& ray, const Plane& plane) {
  return answer_among(ray, {{ray.point(plane.normal), ray.number(plane.offset)}});
}

RoundedAnswer answer(const IntervalRay& ray, const Triangle& triangle) {
  const auto vertex = [&](std::size_t k) { return ray.point(triangle.vertices[k % 3]); };
  std::vector<HalfSpace> all;
  const auto on_plane = [&](const Triple& n, const Triple& point) {
    all.push_back(behind(n, point));
    all.push_back(behind(negative(n), point));
  };
  const Triple n = cross(difference(vertex(1), vertex(0)), difference(vertex(2), vertex(0)));
  if (!is_zero(n)) {
    on_plane(n, vertex(0));
    for (std::size_t k = 0; k < 3; ++k)
      all.push_back(behind(cross(difference(vertex(k + 1), vertex(k)), n), vertex(k)));
  } else {
    // On a line, or one point.
    const Triple first = difference(vertex(1), vertex(0));
    const Triple u = is_zero(first) ? difference(vertex(2), vertex(0)) : first;
    for (int axis = 0; axis < 3; ++axis) {
      const Triple unit = ray.point(Vector3::Unit(axis));
      on_plane(is_zero(u) ? unit : cross(u, unit), vertex(0));
    }
    std::size_t low = 0;
    std::size_t high = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      if (sign_of(dot(u, difference(vertex(k), vertex(low)))) < 0) low = k;
      if (sign_of(dot(u, difference(vertex(k), vertex(high)))) > 0) high = k;
    }
    if (!is_zero(u)) {
      all.push_back(behind(u, vertex(high)));
      all.push_back(behind(negative(u), vertex(low)));
    }
  }
  const auto found = clipped(ray, all);
  if (!found) return kMiss;
  if (found->inside) return from_inside(ray);
  const auto& [x, y, z] = triangle.vertices;
  return hit_at(ray, found->t.part, found->t.over,
                rounded_unit(ray, greatest_along_none(ray, ways_from(ray, found->t, {x, y, z}))));
}

}  // namespace
}  // namespace casts

template <class Target>
RoundedAnswer answer_of_cast(const CastAt<Target>& shapes, Scalar scalar, mpfr_prec_t precision) {
  return casts::answer(casts::IntervalRay(shapes.a, scalar, precision), shapes.b);
}

#define CONTACT_CAST(Cast, Target) template RoundedAnswer answer_of_cast(const CastAt<Target>&, Scalar, mpfr_prec_t);
CONTACT_CASTS(CONTACT_CAST)
#undef CONTACT_CAST

}  // namespace contact::oracle
