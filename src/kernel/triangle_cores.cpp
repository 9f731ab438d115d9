// The point of a triangle nearest to a point, in integers.
#include "kernel/triangle_cores.hpp"

namespace contact::kernel {

Grid grid_of(const Vector3& c, const Corners& triangle, const Lengths& lengths) {
  const auto& [x, y, z] = triangle.vertices;
  return Grid{c[0],
              c[1],
              c[2],
              x[0],
              x[1],
              x[2],
              y[0],
              y[1],
              y[2],
              z[0],
              z[1],
              z[2],
              lengths.radius1,
              lengths.radius2,
              lengths.alarm,
              lengths.contact};
}

ExactNearest exact_nearest(const Vector3& c, const Corners& triangle, const Grid& grid) {
  const IntegerVector zero{0, 0, 0};
  const IntegerVector p = on_grid(grid, c);
  std::array<IntegerVector, 3> v;
  std::array<IntegerVector, 3> w;
  for (std::size_t k = 0; k < 3; ++k) {
    v[k] = on_grid(grid, triangle.vertices[k]);
    w[k] = v[k] - p;
  }
  const IntegerVector n = cross(v[1] - v[0], v[2] - v[0]);
  const auto on_edge = [&](std::size_t from, std::size_t to) {
    return exact_nearest(ExactSegment{p, zero}, ExactSegment{v[from], v[to] - v[from]});
  };
  ExactNearest nearest{};
  if (n == zero) {
    // All of it lies on its longest edge.
    std::size_t longest = 0;
    const auto length2 = [&](std::size_t k) {
      const IntegerVector edge = v[kNextVertex[k]] - v[k];
      return dot(edge, edge);
    };
    for (const std::size_t k : {1U, 2U})
      if (length2(k) > length2(longest)) longest = k;
    nearest = on_edge(longest, kNextVertex[longest]);
  } else {
    std::array<bool, 3> is_beyond{};
    for (std::size_t k = 0; k < 3; ++k) is_beyond[k] = dot(n, cross(w[k], w[kNextVertex[k]])) < 0;
    if (is_beyond == std::array{false, false, false}) {
      const Integer N = dot(n, n);
      nearest = {{p[0] * N, p[1] * N, p[2] * N}, combined(N, p, dot(n, w[0]), n), N, true, {}};
    } else {
      // The edges of a corner: the one whose foot the point is not before, else the other.
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const std::size_t ahead = kNextVertex[corner];
        const std::size_t back = kNextVertex[ahead];
        if (!is_beyond[corner]) continue;
        const bool of_both = is_beyond[back];  // the edge from `back` to the corner
        const bool before = of_both && dot(zero - w[corner], v[ahead] - v[corner]) <= 0;
        nearest = before ? on_edge(corner, back) : on_edge(corner, ahead);
        if (of_both) break;
      }
    }
  }
  if (nearest.p == nearest.q) nearest.agreed = agreed_normal(n, v[1] == v[0] ? v[2] - v[0] : v[1] - v[0]);
  return nearest;
}

}  // namespace contact::kernel
