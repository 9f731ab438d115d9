// What is true of two cores that overlap where they are parted along a claimed direction.
#include "oracle/truth/separation.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>

#include "oracle/truth/cores.hpp"
#include "oracle/truth/default_environment.hpp"

namespace contact::oracle {
namespace {

Rational squared_distance_of_hulls(const std::vector<Point>& p, const std::vector<Point>& q) {
  ExactCore first = exact_hull(p);
  ExactCore second = exact_hull(q);
  enclose_in_range(first, second);
  return squared_distance(first, second);
}

}  // namespace

std::vector<Separation::Corner> Separation::corners_along(std::vector<Point> vertices, const Point& n,
                                                          const Rational& slack) {
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());  // of a flat box
  std::vector<Corner> corners;
  for (const Point& x : vertices) {
    Rational missing(0);
    for (const Point& y : vertices) missing = std::max(missing, Rational(dot(n, y - x) - slack * size_of(y - x)));
    corners.push_back({x, missing});
  }
  std::stable_sort(corners.begin(), corners.end(),
                   [](const Corner& x, const Corner& y) { return x.missing < y.missing; });
  return corners;
}

Separation::Separation(const Convexes& shapes, const Point& n, const Rational& slack)
    : along_(n), depth_(Rational(0)), depth_room_(0) {
  const DefaultEnvironment environment;
  const std::vector<Point> a = exact_core(shapes.a).vertices;
  const std::vector<Point> b = exact_core(shapes.b).vertices;
  corners_ = {corners_along(a, n, slack), corners_along(b, Rational(-1) * n, slack)};
  Rational height = dot(n, a[0] - b[0]);
  for (const Point& x : a)
    for (const Point& y : b) {
      height = std::max(height, Rational(dot(n, x - y)));
      depth_room_ = std::max(depth_room_, Rational(slack * size_of(x - y)));
    }
  depth_ = Exact(Rational(0), height / dot(n, n), dot(n, n));
}

Rational Separation::squared_off(int shape, const Point& x) const {
  const DefaultEnvironment environment;
  std::optional<Rational> least;
  std::vector<Point> face;
  const auto& corners = corners_[static_cast<std::size_t>(shape)];
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Rational& missing = corners[k].missing;
    if (least && missing * missing >= *least) break;
    face.push_back(corners[k].at);
    if (k + 1 < corners.size() && corners[k + 1].missing == missing) continue;
    const Rational off = std::max(Rational(missing * missing), squared_distance_of_hulls({x}, face));
    least = least ? std::min(*least, off) : off;
  }
  return *least;
}

Rational Separation::squared_off_middle(const Point& x) const {
  const DefaultEnvironment environment;
  std::vector<Rational> all;
  for (const auto& corners : corners_)
    for (const Corner& corner : corners) all.push_back(corner.missing);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  std::optional<Rational> least;
  for (const Rational& missing : all) {
    if (least && missing * missing >= *least) break;
    // x is as far from the middles of P and Q as half of what P is from 2 x - Q.
    std::array<std::vector<Point>, 2> faces;
    for (std::size_t shape = 0; shape < 2; ++shape)
      for (const Corner& corner : corners_[shape])
        if (corner.missing <= missing) faces[shape].push_back(shape == 0 ? corner.at : Rational(2) * x - corner.at);
    const Rational off =
        std::max(Rational(missing * missing), Rational(squared_distance_of_hulls(faces[0], faces[1]) / Rational(4)));
    least = least ? std::min(*least, off) : off;
  }
  return *least;
}

}  // namespace contact::oracle
