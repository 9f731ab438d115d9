// Where a ray first hits a shape, in integers.
//
// The origin o, the shape and t d are on one grid; d is D on a grid of its own, and t counts in the quotient of their
// units: t d = s D. Where the ray enters, s = (p - sqrt(q)) / a, a root of
//   sphere     |w + s D|^2 = r^2                      w = o - c
//   capsule    |u x (w + s D)|^2 = r^2 |u|^2          about its axis u, else that of the sphere around one of its ends
//   box, triangle, plane                              linear: q = 0
// so that t, the coordinates of the point and those of the normal are all (c + e / sqrt(q)) / over in integers, which
// round_sum rounds.
#include "contact/casts.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "contact/pair_functions.hpp"
#include "kernel/cores.hpp"
#include "kernel/floating_point_environment.hpp"

namespace contact::inline CONTACT_ABI {
namespace {

using namespace kernel;

const std::array<IntegerVector, 3> kAxes{IntegerVector{1, 0, 0}, IntegerVector{0, 1, 0}, IntegerVector{0, 0, 1}};

/// Where a ray enters a shape.
struct Entry {
  Integer p = 0;  ///< s = (p - sqrt(q)) / a
  Integer q = 0;
  Integer a = 1;  ///< > 0; 0 for a ray that never does
  /// The normal: (base + s turn) / over where over is not 0, else along / |along|.
  IntegerVector along{};
  IntegerVector base{};
  IntegerVector turn{};
  Integer over = 0;
  bool inside = false;  ///< the origin lies in the shape
};
Entry miss() {
  Entry entry;
  entry.a = 0;
  return entry;
}
Entry from_inside() {
  Entry entry;
  entry.inside = true;
  return entry;
}
Entry at(Integer p, Integer a, IntegerVector along) {
  Entry entry;
  entry.p = std::move(p);
  entry.a = std::move(a);
  entry.along = std::move(along);
  return entry;
}

/// A question on its grids.
template <class Shape>
struct On {
  Grid grid;       ///< of points and lengths
  Grid direction;  ///< of the direction
  IntegerVector o;
  IntegerVector D;
  const Shape& shape;

  On(const Ray& ray, const Shape& b, const Grid& points)
      : grid(points),
        direction{ray.direction[0], ray.direction[1], ray.direction[2]},
        o(on_grid(grid, ray.origin)),
        D(on_grid(direction, ray.direction)),
        shape(b) {}
  [[nodiscard]] IntegerVector point(const Vector3& v) const { return on_grid(grid, v); }
};

/// Of the directions that point along none of some vectors, each divided by the sum of the absolute values of its
/// components, the lexicographically greatest. In an octant they are a cone with edges, each of which lies in two
/// planes: across one of the vectors, or of the coordinates.
IntegerVector greatest_against(std::span<const IntegerVector> vectors) {
  std::vector<IntegerVector> planes(kAxes.begin(), kAxes.end());
  planes.insert(planes.end(), vectors.begin(), vectors.end());
  IntegerVector greatest = kNowhere;
  const auto is_greater = [&](const IntegerVector& n) { return greatest == kNowhere || is_preferred(n, greatest); };
  for (std::size_t i = 0; i < planes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const IntegerVector n = cross(planes[i], planes[j]);
      if (n == kNowhere) continue;
      for (const IntegerVector& turned : {n, kNowhere - n}) {
        bool is_right = true;
        for (const IntegerVector& w : vectors) is_right = is_right && dot(turned, w).sign() <= 0;
        if (is_right && is_greater(turned)) greatest = turned;
      }
    }
  return greatest;
}

/// The sphere of radius r around the end of w; of none the normal is along `point`.
Entry enter_ball(const IntegerVector& w, const IntegerVector& D, const Integer& r, const IntegerVector& point) {
  const Integer C = dot(w, w) - r * r;
  if (C.sign() <= 0) return from_inside();
  const Integer B = dot(w, D);
  if (B.sign() >= 0) return miss();
  Entry entry;
  entry.a = dot(D, D);
  entry.q = B * B - entry.a * C;
  if (entry.q.sign() < 0) return miss();
  entry.p = -B;
  entry.along = point;
  entry.base = w;
  entry.turn = D;
  entry.over = r;
  return entry;
}

/// The capsule of radius r around the segment from a start to start + u; w from there to the origin.
Entry enter_capsule(const IntegerVector& w, const IntegerVector& u, const IntegerVector& D, const Integer& r) {
  const Integer U = dot(u, u);
  const Integer level = dot(u, w);  // 0 beside the start, U beside the end
  const auto around_end = [&](bool at_end) {
    const std::array<IntegerVector, 1> rest{at_end ? kNowhere - u : u};
    const IntegerVector normal = r.is_zero() ? greatest_against(rest) : kNowhere;
    return enter_ball(at_end ? w - u : w, D, r, normal);
  };
  const IntegerVector across = cross(u, w);
  const Integer C = dot(across, across) - r * r * U;
  if (C.sign() <= 0) {  // the line through the axis is this near, or it is no line
    if (level.sign() > 0 && level < U) return from_inside();
    return around_end(level.sign() > 0);
  }
  const IntegerVector turning = cross(u, D);
  const Integer A = dot(turning, turning);
  const Integer B = dot(turning, across);
  if (B.sign() >= 0) return miss();
  Integer q = B * B - A * C;
  if (q.sign() < 0) return miss();
  // Where it enters the cylinder: level + s rise, A times.
  const Integer rise = dot(u, D);
  const Integer rational = A * level - B * rise;
  const auto past = [&](const Integer& limit) {  // the sign of x - rise sqrt(q)
    const Integer x = rational - limit;
    const int other = rise.sign() * q.sign();
    if (x.sign() != other) return x.sign() > other ? 1 : -1;
    return other * Integer(x * x).compare(rise * rise * q);
  };
  const int beside_start = past(0);
  const int beside_end = past(A * U);
  if (beside_start < 0) return around_end(false);
  if (beside_end > 0) return around_end(true);
  Entry entry;
  entry.p = -B;
  entry.a = A;
  if (r.is_zero()) {
    std::vector<IntegerVector> rest;
    if (beside_start > 0) rest.push_back(kNowhere - u);
    if (beside_end < 0) rest.push_back(u);
    entry.along = greatest_against(rest);
    return entry;
  }
  entry.q = std::move(q);
  entry.base = combined(U, w, -level, u);
  entry.turn = combined(U, D, -rise, u);
  entry.over = U * r;
  return entry;
}

Grid grid_of(const Ray& a, const Ball& b) {
  return Grid{a.origin[0], a.origin[1], a.origin[2], b.center[0], b.center[1], b.center[2], b.radius};
}
Entry enter(const On<Ball>& on) {
  return enter_ball(on.o - on.point(on.shape.center), on.D, on.grid(on.shape.radius), kAxes[0]);
}

Grid grid_of(const Ray& a, const Capsule& b) {
  return Grid{a.origin[0], a.origin[1], a.origin[2], b.start[0], b.start[1],
              b.start[2],  b.end[0],    b.end[1],    b.end[2],   b.radius};
}
Entry enter(const On<Capsule>& on) {
  const IntegerVector start = on.point(on.shape.start);
  return enter_capsule(on.o - start, on.point(on.shape.end) - start, on.D, on.grid(on.shape.radius));
}

Grid grid_of(const Ray& a, const Box& b) {
  return Grid{a.origin[0], a.origin[1], a.origin[2], b.min[0], b.min[1], b.min[2], b.max[0], b.max[1], b.max[2]};
}
/// Between the two planes of each axis: in at the last, out at the first.
Entry enter(const On<Box>& on) {
  const IntegerVector low = on.point(on.shape.min);
  const IntegerVector high = on.point(on.shape.max);
  bool inside = true;
  Integer in = 0;
  Integer in_over = 0;  // 0 for none yet
  Integer out = 0;
  Integer out_over = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Integer to_low = low[i] - on.o[i];
    const Integer to_high = high[i] - on.o[i];
    const bool between = to_low.sign() <= 0 && to_high.sign() >= 0;
    inside = inside && between;
    if (on.D[i].is_zero()) {
      if (!between) return miss();
      continue;
    }
    const bool up = on.D[i].sign() > 0;
    const Integer over = abs(on.D[i]);
    const Integer first = up ? to_low : -to_high;
    const Integer last = up ? to_high : -to_low;
    if (in_over.is_zero() || first * in_over > in * over) in = first, in_over = over;
    if (out_over.is_zero() || last * out_over < out * over) out = last, out_over = over;
  }
  if (inside) return from_inside();
  if (in.sign() <= 0 || in * out_over > out * in_over) return miss();
  // Of the faces there: x, y, z, then against z, y, x.
  const auto is_on = [&](std::size_t i, const Integer& face) {
    return on.o[i] * in_over + in * on.D[i] == face * in_over;
  };
  for (std::size_t i = 0; i < 3; ++i)
    if (is_on(i, high[i])) return at(in, in_over, kAxes[i]);
  for (std::size_t i = 3; i-- > 0;)
    if (is_on(i, low[i])) return at(in, in_over, kNowhere - kAxes[i]);
  return miss();  // not reached: the entry is on a face
}

Grid grid_of(const Ray& a, const Triangle& b) {
  const auto& [x, y, z] = b.vertices;
  return Grid{x[0], x[1], x[2], y[0], y[1], y[2], z[0], z[1], z[2], a.origin[0], a.origin[1], a.origin[2]};
}
/// Through the inside where the plane is not along the ray; else through the first of the edges, which are capsules of
/// radius 0.
Entry enter(const On<Triangle>& on) {
  std::array<IntegerVector, 3> w;
  for (std::size_t k = 0; k < 3; ++k) w[k] = on.point(on.shape.vertices[k]) - on.o;
  const IntegerVector n = cross(w[1] - w[0], w[2] - w[0]);
  const Integer through = dot(n, on.D);
  const Integer height = dot(n, w[0]);
  Entry entry = miss();
  if (!through.is_zero()) {
    const int sign = through.sign();
    if (sign * height.sign() < 0) return miss();
    bool on_edge = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const int beside = sign * dot(on.D, cross(w[k], w[(k + 1) % 3])).sign();
      if (beside < 0) return miss();
      on_edge = on_edge || beside == 0;
    }
    if (height.is_zero()) return from_inside();
    const Integer& first = n[0].is_zero() ? n[1].is_zero() ? n[2] : n[1] : n[0];
    entry = at(sign * height, abs(through), first.sign() > 0 ? n : kNowhere - n);
    if (!on_edge) return entry;
  } else {
    if (!height.is_zero()) return miss();
    bool inside = n != kNowhere;
    for (std::size_t k = 0; inside && k < 3; ++k) inside = dot(n, cross(w[k], w[(k + 1) % 3])).sign() >= 0;
    if (inside) return from_inside();
    for (std::size_t k = 0; k < 3; ++k) {
      const Entry along = enter_capsule(kNowhere - w[k], w[(k + 1) % 3] - w[k], on.D, 0);
      if (along.inside) return along;
      if (!along.a.is_zero() && (entry.a.is_zero() || along.p * entry.a < entry.p * along.a))
        entry = at(along.p, along.a, kNowhere);
    }
    if (entry.a.is_zero()) return entry;
  }
  // Away from the rest of the triangle: from X to every vertex.
  std::array<IntegerVector, 3> rest;
  for (std::size_t k = 0; k < 3; ++k) rest[k] = combined(entry.a, w[k], -entry.p, on.D);
  entry.along = greatest_against(rest);
  return entry;
}

Grid grid_of(const Ray& a, const Plane& b) {
  return Grid({a.origin[0], a.origin[1], a.origin[2]},
              Grid{b.offset}.exponent() - Grid{b.normal[0], b.normal[1], b.normal[2]}.exponent());
}
Entry enter(const On<Plane>& on) {
  const Grid of_normal{on.shape.normal[0], on.shape.normal[1], on.shape.normal[2]};
  const Grid of_offset{on.shape.offset};
  const IntegerVector n = on_grid(of_normal, on.shape.normal);
  const int finer = of_offset.exponent() - (on.grid.exponent() + of_normal.exponent());
  const Integer height = dot(n, on.o) - (of_offset(on.shape.offset) << static_cast<unsigned>(finer));
  if (height.sign() <= 0) return from_inside();
  const Integer rise = dot(n, on.D);
  return rise.sign() >= 0 ? miss() : at(height, -rise, n);
}

/// t <= length.
template <class Shape>
bool is_reached(const Entry& entry, const On<Shape>& on, double length) {
  if (entry.a.is_zero() || entry.inside) return entry.inside;
  // sqrt(q) >= p - a length, both in the finer one of two units
  const Grid of_length{length};
  const int shift = of_length.exponent() + on.direction.exponent() - on.grid.exponent();
  const auto up = static_cast<unsigned>(std::max(shift, 0));
  const auto down = static_cast<unsigned>(std::max(-shift, 0));
  const Integer short_of = (entry.p << down) - ((entry.a * of_length(length)) << up);
  return short_of.sign() <= 0 || short_of * short_of <= entry.q << (2 * down);
}

template <class Shape>
Contact contact_at(const Entry& entry, const On<Shape>& on, const Ray& ray) {
  Contact contact{};
  contact.degenerate = entry.inside;
  const auto unit = [&](const IntegerVector& n) {
    const Integer square = dot(n, n);
    for (std::size_t i = 0; i < 3; ++i) contact.normal[static_cast<Eigen::Index>(i)] = round_sum(0, n[i], square, 0);
  };
  if (entry.inside) {
    unit(kNowhere - on.D);
    contact.point1 = contact.point2 = ray.origin.array() + 0.0;
    contact.value = 0;
    return contact;
  }
  const Integer& over = entry.over;
  const Integer D = entry.q.is_zero() ? Integer(1) : entry.q;
  // (rational a + (p - sqrt(q)) factor) / (a over)
  const auto rounded = [&](const Integer& rational, const Integer& factor, int exponent, const Integer& under) {
    return round_sum(rational * entry.a + entry.p * factor, -factor * entry.q, D, exponent, entry.a * under);
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    if (!over.is_zero()) contact.normal[axis] = rounded(entry.base[i], entry.turn[i], 0, over);
    contact.point1[axis] = rounded(on.o[i], on.D[i], on.grid.exponent(), 1);
  }
  if (over.is_zero()) unit(entry.along);
  contact.point2 = contact.point1;
  contact.value = rounded(0, 1, on.grid.exponent() - on.direction.exponent(), 1);
  return contact;
}

// Behind calls that are not inlined: what RoundToNearest sets must be set before anything is computed.
template <class Shape>
[[gnu::noinline]] bool decide_portably(const Ray& a, const Shape& b) {
  const On<Shape> on(a, b, grid_of(a, b));
  return is_reached(enter(on), on, a.length);
}
template <class Shape>
[[gnu::noinline]] std::optional<Contact> compute_portably(const Ray& a, const Shape& b) {
  const On<Shape> on(a, b, grid_of(a, b));
  const Entry entry = enter(on);
  if (!is_reached(entry, on, a.length)) return std::nullopt;
  return contact_at(entry, on, a);
}

template <class Shape>
bool test_cast(const Ray& a, const Shape& b) {
  const RoundToNearest environment;
  return decide_portably(a, b);
}
template <class Shape>
std::optional<Contact> compute_cast(const Ray& a, const Shape& b) {
  const RoundToNearest environment;
  return compute_portably(a, b);
}

}  // namespace

#define CONTACT_CAST(name, Shape)                                                                                     \
  bool test_cast_##name(const Ray& a, const Shape& b) { return test_cast(a, b); }                                     \
  std::optional<Contact> compute_cast_##name(const Ray& a, const Shape& b) { return compute_cast(a, b); }             \
  bool is_hit(const CastAt<Shape>& shapes, Distances /*distances*/) { return test_cast(shapes.a, shapes.b); }         \
  std::optional<Contact> contact_of(const CastAt<Shape>& shapes, Distances /*distances*/, ContactPoints /*points*/) { \
    return compute_cast(shapes.a, shapes.b);                                                                          \
  }
CONTACT_CAST(sphere, Ball)
CONTACT_CAST(cube, Box)
CONTACT_CAST(capsule, Capsule)
CONTACT_CAST(triangle, Triangle)
CONTACT_CAST(plane, Plane)
#undef CONTACT_CAST

}  // namespace contact::inline CONTACT_ABI
