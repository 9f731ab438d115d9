// The point of a triangle nearest to a point: exactly, and in double-double arithmetic.
//
//   c the point     w_k = v_k - c     u = v_1 - v_0     v = v_2 - v_0     n = u x v
//   e_k = n.(w_k x w_(k+1))     edge k goes from v_k to v_(k+1)
// c lies over the inside of the triangle where every e_k > 0, and beyond edge k where e_k < 0. The nearest point lies
// on an edge that c is beyond. Beyond two edges it is not beyond the foot of both: of (c - v).a and (c - v).b, v their
// common vertex and a and b the edges from there, one at most is positive.
#pragma once

#include <array>
#include <cmath>

#include "kernel/segment_cores.hpp"

namespace contact::kernel {

/// The vertices of a triangle, as a core.
struct Corners {
  const std::array<Vector3, 3>& vertices;
};

/// Exactly.
[[nodiscard]] ExactNearest exact_nearest(const Vector3& c, const Corners& triangle, const Grid& grid);
/// The grid of a question.
[[nodiscard]] Grid grid_of(const Vector3& c, const Corners& triangle, const Lengths& lengths);

[[gnu::always_inline]] inline bool in_short_range(const Corners& triangle) {
  return in_short_range(triangle.vertices[0]) && in_short_range(triangle.vertices[1]) &&
         in_short_range(triangle.vertices[2]);
}

inline constexpr std::array<std::size_t, 3> kNextVertex{1, 2, 0};

/// A triangle seen from c, in plain arithmetic. In units of u, with the sums of components S = |u| |v| and
/// T_k = |w_k| |w_(k+1)|:
///   n, w x w  differences (1 + 1), products (1) and their difference (1)     4 S and 4 T_k, all components together
///   e_k       both (8), products and sums (3)                                11 S T_k
/// and 2 more for the factors (1 + u)^k left out, and for the rounding of the bound.
struct PlainView {
  std::array<Vector3, 3> w;
  std::array<double, 3> e;
  std::array<double, 3> error;
};

[[gnu::always_inline]] inline double sum_of_components(const Vector3& x) {
  return std::abs(x[0]) + std::abs(x[1]) + std::abs(x[2]);
}
/// From a to b. (Of components: Eigen's difference may become a function of its own where not everything is inlined.)
[[gnu::always_inline]] inline Vector3 from_to(const Vector3& a, const Vector3& b) {
  return {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
}
[[gnu::always_inline]] inline double plain_dot(const Vector3& x, const Vector3& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}
[[gnu::always_inline]] inline Vector3 plain_cross(const Vector3& x, const Vector3& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

[[gnu::always_inline]] inline PlainView plain_view(const Vector3& c, const Corners& triangle) {
  const auto& vertices = triangle.vertices;
  PlainView view{{from_to(c, vertices[0]), from_to(c, vertices[1]), from_to(c, vertices[2])}, {}, {}};
  const Vector3 u = from_to(vertices[0], vertices[1]);
  const Vector3 v = from_to(vertices[0], vertices[2]);
  const Vector3 n = plain_cross(u, v);
  const double S = 13 * DoubleDoublePair::kUnit * sum_of_components(u) * sum_of_components(v);
#pragma GCC unroll 3
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3& next = view.w[kNextVertex[k]];
    view.e[k] = plain_dot(n, plain_cross(view.w[k], next));
    view.error[k] = S * (sum_of_components(view.w[k]) * sum_of_components(next));
  }
  return view;
}

[[gnu::always_inline]] inline Filtered plain_filtered(const Vector3& c, const Corners& triangle,
                                                      const Lengths& lengths) {
  return plain_decision::filter_point_and_triangle(c, triangle.vertices, reach_of(lengths));
}

/// The product of two vectors, each component within 11 |x| |y|: products (7) and their difference (4) of
/// |x_i y_j| + |x_j y_i|, which is at most |x| |y|. All of it within 16 |x| |y|.
[[gnu::always_inline]] inline DoubleDoubles cross(const DoubleDoubles& x, const DoubleDoubles& y) {
  const auto component = [&](std::size_t i, std::size_t j) {
    return sum(product(x[i], y[j]), negative(product(x[j], y[i])));
  };
  return {component(1, 2), component(2, 0), component(0, 1)};
}

/// The foot of c on the plane of a triangle; false where that is nearly a line. With S = |u| |v| and k = S / |n| >= 1:
///   n.w_0  20 |n| |w_0| of the dot product, 16 S |w_0| of n                               36 S |w_0|
///   n.n    20 |n|^2, and 2 (16 S) |n|                                                     52 S |n|
///   t      36 S |w_0| / |n|^2, |t| 52 k and 12 |t| of the quotient; |t| <= |w_0| / |n|    100 k |w_0| / |n|
///   delta  t n: 100 k |w_0|, 11 |t| S of n and 7 |t n| of the product                     118 k |w_0|
///   q      the sum (4) of |delta| and |c|, together at most 2 |w_0| + |q|                 8 |w_0| + 4 |q|
[[gnu::always_inline]] inline bool foot_on_face(const Vector3& c, const Corners& triangle,
                                                ApproximateNearest& nearest) {
  const auto& vertices = triangle.vertices;
  const DoubleDoubles u = difference(vertices[1], vertices[0]);
  const DoubleDoubles v = difference(vertices[2], vertices[0]);
  const DoubleDoubles w = difference(vertices[0], c);
  const DoubleDoubles n = cross(u, v);
  const DoubleDouble<double> N = dot(n, n);
  const double S = length_bound(u) * length_bound(v);
  if (!(N.high > S * S * 0x1p-60)) return false;
  const DoubleDouble<double> t = quotient(dot(n, w), N);
  const double k = S / std::sqrt(N.high) * (1 + 0x1p-40);
  nearest.p = exactly(c);
  nearest.p_error = 0;
  nearest.delta_error = 122 * kUnitSquared * k * length_bound(w);
  nearest.q_error = 132 * kUnitSquared * k * length_bound(w);
#pragma GCC unroll 3
  for (std::size_t i = 0; i < 3; ++i) {
    nearest.delta[i] = product(t, n[i]);
    nearest.q[i] = sum(nearest.p[i], nearest.delta[i]);
  }
  return true;
}

/// Which feature of a triangle a point is nearest to, as far as plain arithmetic can tell: the face, the edge from one
/// vertex to another, whose ends count, or a corner.
struct NearestFeature {
  enum class Kind { unknown, face, edge, corner };
  Kind kind = Kind::unknown;
  std::size_t from = 0;
  std::size_t to = 0;
};
[[gnu::always_inline]] inline NearestFeature nearest_feature(const PlainView& view, const Corners& triangle) {
  using Kind = NearestFeature::Kind;
  const auto& vertices = triangle.vertices;
  std::array<std::size_t, 3> beyond{};
  std::size_t count = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(std::abs(view.e[k]) > view.error[k])) return {};
    if (view.e[k] < 0) beyond[count++] = k;
  }
  if (count == 0) return {Kind::face};
  if (count == 1) return {Kind::edge, beyond[0], kNextVertex[beyond[0]]};
  // Edges k and k + 1 have v_(k+1) in common; 2 and 0 have v_0.
  const std::size_t corner = beyond[0] == 0 && beyond[1] == 2 ? 0 : beyond[1];
  const std::size_t ahead = kNextVertex[corner];
  const std::size_t back = kNextVertex[ahead];
  // -w.(w' - w), of w and a difference (1 + 2), products and sums (3), each rounded: 6 u of the components' sums.
  const auto side = [&](std::size_t other) {
    const Vector3 a = from_to(vertices[corner], vertices[other]);
    const double along = -plain_dot(view.w[corner], a);
    const double bound = 7 * DoubleDoublePair::kUnit * sum_of_components(view.w[corner]) * sum_of_components(a);
    return along > bound ? 1 : along < -bound ? -1 : 0;
  };
  const int to_ahead = side(ahead);
  if (to_ahead > 0) return {Kind::edge, corner, ahead};
  const int to_back = side(back);
  if (to_back > 0) return {Kind::edge, corner, back};
  return to_ahead == 0 || to_back == 0 ? NearestFeature{} : NearestFeature{Kind::corner, corner};
}

/// The nearest points; false where plain arithmetic cannot tell which feature of the triangle it is, or the triangle is
/// nearly a line.
[[gnu::always_inline]] inline bool find_nearest(const Vector3& c, const Corners& triangle,
                                                ApproximateNearest& nearest) {
  const auto& vertices = triangle.vertices;
  const NearestFeature feature = nearest_feature(plain_view(c, triangle), triangle);
  switch (feature.kind) {
    case NearestFeature::Kind::face:
      return foot_on_face(c, triangle, nearest);
    case NearestFeature::Kind::edge:
      nearest = nearest_of(c, foot_on(Segment{vertices[feature.from], vertices[feature.to]}, c));
      return true;
    case NearestFeature::Kind::corner: {
      const Vector3& corner = vertices[feature.from];
      nearest = {exactly(c), exactly(corner), difference(corner, c), 0, 0, 0};
      return true;
    }
    default:
      return false;
  }
}

}  // namespace contact::kernel
