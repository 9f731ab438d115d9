// Several points of one contact.
#include "oracle/judge/manifold.hpp"

#include <algorithm>
#include <concepts>

#include "oracle/judge/near_optimal.hpp"
#include "oracle/truth/default_environment.hpp"

namespace contact::oracle {
namespace {

/// What of a core can be seen by who looks along -n.
class Seen {
 public:
  Seen(const ExactCore& core, const Point& n, const Rational& slack) : core_(core), n_(n), slack_(slack) {}

  [[nodiscard]] std::vector<ExactCore> pieces() const {
    std::vector<ExactCore> all;
    const auto add = [&](const Feature& feature) {
      std::vector<Point> corners;
      for (const std::size_t corner : feature.corners()) corners.push_back(core_.vertices[corner]);
      all.push_back(exact_hull(corners));
    };
    if (!core_.outward.empty()) {
      for (std::size_t i = 0; i < core_.outward.size(); ++i)
        if (is_along(core_.outward[i])) add(core_.faces()[i]);
      return all;
    }
    Point across{};  // of what is flat
    for (const Feature& feature : core_.features) {
      if (feature.dimension() != 2) continue;
      const Point area = area_between(core_.vertices, feature.places[0], feature.places[1], feature.places[2]);
      if (is_along(area) || is_along(Rational(-1) * area)) add(feature);
      if (is_zero(across)) across = area;
    }
    if (!all.empty()) return all;
    for (const Feature& feature : core_.features)
      if (feature.dimension() == 1 && is_upper(feature, across)) add(feature);
    if (!all.empty()) return all;
    all.push_back(
        exact_hull({*std::max_element(core_.vertices.begin(), core_.vertices.end(),
                                      [&](const Point& x, const Point& y) { return dot(n_, x) < dot(n_, y); })}));
    return all;
  }

 private:
  [[nodiscard]] bool is_along(const Point& outward) const { return dot(outward, n_) > slack_ * size_of(outward); }
  /// Whether an edge of something flat that is seen from its side, or of something straight, is seen.
  [[nodiscard]] bool is_upper(const Feature& edge, const Point& across) const {
    const Point& from = core_.vertices[edge.places[0]];
    const Point way = core_.vertices[edge.places[1]] - from;
    if (is_zero(across)) return size_of(cross(way, n_)) > slack_ * size_of(way);
    Point outward = cross(way, across);
    if (dot(outward, n_) < Rational(0)) outward = Rational(-1) * outward;
    return is_along(outward) && std::all_of(core_.vertices.begin(), core_.vertices.end(),
                                            [&](const Point& x) { return dot(outward, x - from) <= Rational(0); });
  }

  const ExactCore& core_;
  const Point& n_;
  const Rational& slack_;
};

}  // namespace

bool has_manifold(Pair pair) { return has_distance(pair); }

Manifold::Manifold(const Query& query, const Point& n, const Rational& slack) : n_(n) {
  const DefaultEnvironment environment;
  std::size_t i = 0;
  for_each_shape(query, [&]<class Shape>(const Shape& shape) {
    if constexpr (std::same_as<Shape, Plane>) {
      plane_ = shape;
    } else {
      const ExactCore core = exact_core(shape);
      radius_[i] = Rational(core.radius);
      surface_[i] = Seen(core, i == 0 ? n : Rational(-1) * n, slack).pieces();
    }
    ++i;
  });
}

Rational Manifold::squared_off_surface(std::size_t shape, const Point& x) const {
  if (shape == 1 && plane_) return squared_height_over(*plane_, x);
  const ExactCore point = exact_hull({x});
  Rational least = squared_distance(point, surface_[shape].front());
  for (std::size_t i = 1; i < surface_[shape].size(); ++i)
    least = std::min(least, squared_distance(point, surface_[shape][i]));
  return least;
}

Rational Manifold::squared_off(const Point& x, const Rational& depth) const {
  const DefaultEnvironment environment;
  std::optional<Rational> best;
  for (const Rational& share : {Rational(0), Rational(1), Rational(1) / Rational(2)}) {
    // How far along n the first surface is, and how far against it the second.
    const Point first = x + (share * depth - radius_[0]) * n_;
    const Point second = x - ((Rational(1) - share) * depth - radius_[1]) * n_;
    const Rational off = std::max(squared_off_surface(0, first), squared_off_surface(1, second));
    best = best ? std::min(*best, off) : off;
  }
  return *best;
}

}  // namespace contact::oracle
