// Any two convex shapes in plain arithmetic, as engines have it: the axes that may part two polytopes, each divided by its length, then where none does,
// the least of their depths; else the nearest of vertices and faces, and of edges.
#include <algorithm>
#include <bitset>
#include <cmath>
#include <utility>

#include "golden/plain_segments.hpp"

namespace contact::golden {
namespace convexes_plain {
namespace {

template <class Real>
Triple<Real> less(const Triple<Real>& x, const Triple<Real>& y) {
  return moved(x, Real{-1}, y);
}
template <class Real>
Triple<Real> times(Real k, const Triple<Real>& x) {
  return moved({}, k, x);
}

/// A polytope with few vertices.
template <class Real>
struct Mesh {
  std::vector<Triple<Real>> vertices{};
  std::vector<std::array<std::size_t, 2>> edges{};
  std::vector<std::vector<std::size_t>> faces{};  ///< in order round about
  Real radius{};

  void add(const Ball& ball) {
    vertices = {in_scalar<Real>(ball.center)};
    radius = static_cast<Real>(ball.radius);
  }
  void add(const Capsule& capsule) {
    vertices = {in_scalar<Real>(capsule.start), in_scalar<Real>(capsule.end)};
    edges = {{0, 1}};
    radius = static_cast<Real>(capsule.radius);
  }
  void add(const Triangle& triangle) {
    for (const Vector3& v : triangle.vertices) vertices.push_back(in_scalar<Real>(v));
    edges = {{0, 1}, {1, 2}, {2, 0}};
    faces = {{0, 1, 2}};
  }
  void add(const Box& box) {
    const Triple<Real> low = in_scalar<Real>(box.min);
    const Triple<Real> high = in_scalar<Real>(box.max);
    add_box([&](std::size_t corner) {
      Triple<Real> x{};
      for (std::size_t i = 0; i < 3; ++i) x[i] = corner >> i & 1 ? high[i] : low[i];
      return x;
    });
  }
  void add(const Obb& box) {
    const auto q = [&](std::size_t i) { return static_cast<Real>(box.orientation[i]); };
    const Real s = 2 / (q(0) * q(0) + q(1) * q(1) + q(2) * q(2) + q(3) * q(3));
    const std::array<Triple<Real>, 3> columns{
        Triple<Real>{1 - s * (q(1) * q(1) + q(2) * q(2)), s * (q(0) * q(1) + q(2) * q(3)),
                     s * (q(0) * q(2) - q(1) * q(3))},
        Triple<Real>{s * (q(0) * q(1) - q(2) * q(3)), 1 - s * (q(0) * q(0) + q(2) * q(2)),
                     s * (q(1) * q(2) + q(0) * q(3))},
        Triple<Real>{s * (q(0) * q(2) + q(1) * q(3)), s * (q(1) * q(2) - q(0) * q(3)),
                     1 - s * (q(0) * q(0) + q(1) * q(1))}};
    const Triple<Real> extents = in_scalar<Real>(box.extents);
    add_box([&](std::size_t corner) {
      Triple<Real> x = in_scalar<Real>(box.center);
      for (std::size_t i = 0; i < 3; ++i) x = moved(x, corner >> i & 1 ? extents[i] : -extents[i], columns[i]);
      return x;
    });
  }
  /// Three vertices make a face where no other lies beyond them, or by no more than rounding does. Where more than
  /// kMostOnFace lie there, the face is the polygon of all: of 64 vertices in a plane there are 41664 threes, and 4
  /// million pairs of edges.
  template <HullOfVertices Shape>
  void add(const Shape& hull) {
    for (const Vector3& v : hull.vertices)
      if (const Triple<Real> x = in_scalar<Real>(v); std::find(vertices.begin(), vertices.end(), x) == vertices.end())
        vertices.push_back(x);
    radius = static_cast<Real>(radius_of(hull));
    const std::size_t n = vertices.size();
    const auto add_face = [&](std::vector<std::size_t> face) {
      for (std::size_t k = 0; k < face.size(); ++k) {
        const std::size_t next = face[(k + 1) % face.size()];
        const std::array edge{std::min(face[k], next), std::max(face[k], next)};
        if (std::find(edges.begin(), edges.end(), edge) == edges.end()) edges.push_back(edge);
      }
      faces.push_back(std::move(face));
    };
    std::vector<VertexSet> polygons;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j)
        for (std::size_t k = j + 1; k < n; ++k) {
          const auto has_all = [&](const VertexSet& on) { return on[i] && on[j] && on[k]; };
          if (std::any_of(polygons.begin(), polygons.end(), has_all)) continue;
          const std::optional<VertexSet> on = face_through(i, j, k);
          if (!on) continue;
          std::vector<std::size_t> face;
          if (on->count() > kMostOnFace) {
            polygons.push_back(*on);
            face = round_about(*on, normal(i, j, k));
          }
          add_face(face.size() < 3 ? std::vector{i, j, k} : std::move(face));
        }
    if (faces.empty())
      for (std::size_t k = 1; k < n; ++k) edges.push_back({0, k});
  }
  void add(const Plane& /*plane*/) {}

  [[nodiscard]] Triple<Real> way(const std::array<std::size_t, 2>& edge) const {
    return less(vertices[edge[1]], vertices[edge[0]]);
  }
  [[nodiscard]] Triple<Real> normal(std::size_t i, std::size_t j, std::size_t k) const {
    return cross(less(vertices[j], vertices[i]), less(vertices[k], vertices[i]));
  }
  [[nodiscard]] Triple<Real> normal(const std::vector<std::size_t>& face) const {
    return normal(face[0], face[face.size() / 3], face[face.size() * 2 / 3]);
  }
  /// The least and the largest n.x, and the middle of the vertices that are about there.
  struct Range {
    Real least;
    Real most;
  };
  [[nodiscard]] Range along(const Triple<Real>& n) const {
    Range found{dot(n, vertices[0]), dot(n, vertices[0])};
    for (const Triple<Real>& x : vertices) {
      const Real at = dot(n, x);
      found = {std::min(found.least, at), std::max(found.most, at)};
    }
    return found;
  }
  [[nodiscard]] Triple<Real> middle(const Triple<Real>& n) const {
    const Real most = along(n).most;
    Triple<Real> sum{};
    Real count = 0;
    for (const Triple<Real>& x : vertices)
      if (most - dot(n, x) <= std::abs(most) * 4 * std::numeric_limits<Real>::epsilon())
        sum = moved(sum, Real{1}, x), ++count;
    return times(1 / count, sum);
  }

 private:
  using VertexSet = std::bitset<kMostVertices>;
  // Up to so many the threes are 560 at most, and the face of each three is what small engines have.
  static constexpr std::size_t kMostOnFace = 16;

  /// The vertices that lie on the face of three, or nothing where these make none.
  [[nodiscard]] std::optional<VertexSet> face_through(std::size_t i, std::size_t j, std::size_t k) const {
    const Triple<Real> n = normal(i, j, k);
    const Real length = std::sqrt(dot(n, n));
    if (!(length > 0)) return std::nullopt;
    bool above = false;
    bool below = false;
    VertexSet on;
    for (std::size_t at = 0; at < vertices.size(); ++at) {
      const Triple<Real> from = less(vertices[at], vertices[i]);
      const Real height = dot(n, from);
      const Real rounding = 8 * std::numeric_limits<Real>::epsilon() * length * std::sqrt(dot(from, from));
      above = above || height > rounding;
      below = below || height < -rounding;
      if (above && below) return std::nullopt;
      on[at] = !(std::abs(height) > rounding);
    }
    return on;
  }
  /// The corners of a face in order: its hull, seen along the largest component of its normal.
  [[nodiscard]] std::vector<std::size_t> round_about(const VertexSet& on, const Triple<Real>& n) const {
    std::size_t along = 0;
    for (std::size_t axis = 1; axis < 3; ++axis)
      if (std::abs(n[axis]) > std::abs(n[along])) along = axis;
    const std::size_t u = (along + 1) % 3;
    const std::size_t v = (along + 2) % 3;
    std::vector<std::size_t> all;
    for (std::size_t at = 0; at < vertices.size(); ++at)
      if (on[at]) all.push_back(at);
    std::sort(all.begin(), all.end(), [&](std::size_t x, std::size_t y) {
      return std::pair(vertices[x][u], vertices[x][v]) < std::pair(vertices[y][u], vertices[y][v]);
    });
    std::vector<std::size_t> corners;
    const auto add = [&](std::size_t first, std::size_t next) {
      const auto turns_back = [&] {
        const Triple<Real>& o = vertices[corners[corners.size() - 2]];
        const Triple<Real> x = less(vertices[corners.back()], o);
        const Triple<Real> y = less(vertices[next], o);
        return x[u] * y[v] - x[v] * y[u] <= 0;
      };
      while (corners.size() > first + 1 && turns_back()) corners.pop_back();
      corners.push_back(next);
    };
    for (const std::size_t at : all) add(0, at);
    const std::size_t last = corners.size() - 1;
    for (std::size_t at = all.size() - 1; at-- > 0;) add(last, all[at]);
    corners.pop_back();
    return corners;
  }
  template <class Corner>
  void add_box(Corner corner) {
    for (std::size_t k = 0; k < 8; ++k) vertices.push_back(corner(k));
    for (std::size_t bit = 1; bit < 8; bit *= 2) {
      const std::size_t u = bit == 1 ? 2 : 1;
      const std::size_t v = bit == 4 ? 2 : 4;
      for (std::size_t k = 0; k < 8; ++k)
        if ((k & bit) == 0) edges.push_back({k, k | bit});
      for (const std::size_t k : {std::size_t{0}, bit}) faces.push_back({k, k | u, k | u | v, k | v});
    }
  }
};

template <class Real>
struct Nearest {
  Triple<Real> p{};
  Triple<Real> q{};
  Triple<Real> n{};
  Real distance = std::numeric_limits<Real>::infinity();
};

/// A vertex over the inside of a face. `turned` says that the face is the first shape's.
template <class Real>
void try_face(const Triple<Real>& x, const Mesh<Real>& of, const std::vector<std::size_t>& face, bool turned,
              Nearest<Real>& best) {
  const Triple<Real> n = of.normal(face);
  const Real length2 = dot(n, n);
  if (!(length2 > 0)) return;
  for (std::size_t k = 0; k < face.size(); ++k) {
    const Triple<Real>& from = of.vertices[face[k]];
    const Triple<Real>& to = of.vertices[face[(k + 1) % face.size()]];
    if (dot(n, cross(less(to, from), less(x, from))) < 0) return;
  }
  const Real height = dot(n, less(x, of.vertices[face[0]])) / length2;
  const Triple<Real> foot = moved(x, -height, n);
  const Real distance = std::abs(height) * std::sqrt(length2);
  if (!(distance < best.distance)) return;
  best = turned ? Nearest<Real>{foot, x, {}, distance} : Nearest<Real>{x, foot, {}, distance};
}

template <class Real>
Nearest<Real> nearest(const Mesh<Real>& a, const Mesh<Real>& b) {
  // What parts them least.
  Nearest<Real> deep;
  Real least = std::numeric_limits<Real>::infinity();
  bool is_parted = a.faces.empty() && b.faces.empty();
  const auto try_axis = [&](const Triple<Real>& axis) {
    const Real length = std::sqrt(dot(axis, axis));
    constexpr Real kTooShort = std::numeric_limits<Real>::epsilon();
    if (!(length > kTooShort)) return;
    const Triple<Real> n = times(1 / length, axis);
    const auto of_a = a.along(n);
    const auto of_b = b.along(n);
    const auto try_way = [&](Real depth, Real sign) {
      is_parted = is_parted || depth <= 0;
      if (depth < least) least = depth, deep.n = times(sign, n);
    };
    try_way(of_a.most - of_b.least, 1);
    try_way(of_b.most - of_a.least, -1);
  };
  for (const auto* mesh : {&a, &b})
    for (const auto& face : mesh->faces) try_axis(mesh->normal(face));
  for (const auto& e : a.edges)
    for (const auto& f : b.edges) try_axis(cross(a.way(e), b.way(f)));
  if (!is_parted && deep.n != Triple<Real>{}) {
    const Triple<Real> of_a = a.middle(deep.n);
    const Triple<Real> of_b = b.middle(times(Real{-1}, deep.n));
    const bool a_is_one = a.vertices.size() == 1 || b.faces.size() == 6;
    deep.p = a_is_one ? of_a : moved(of_b, least, deep.n);
    deep.q = moved(deep.p, -least, deep.n);
    deep.distance = -least;
    return deep;
  }
  Nearest<Real> best;
  const auto segment = [](const Mesh<Real>& of, std::size_t from, std::size_t to) {
    return Segment<Real>{of.vertices[from], of.vertices[to], 0};
  };
  const auto segments = [&](const Mesh<Real>& of) {
    std::vector<Segment<Real>> all;
    for (const auto& edge : of.edges) all.push_back(segment(of, edge[0], edge[1]));
    if (all.empty()) all.push_back(segment(of, 0, 0));
    return all;
  };
  for (const Segment<Real>& e : segments(a))
    for (const Segment<Real>& f : segments(b)) {
      const NearestPoints<Real> found = nearest_points(e, f);
      const Triple<Real> delta = less(found.q, found.p);
      if (const Real distance = std::sqrt(dot(delta, delta)); distance < best.distance)
        best = {found.p, found.q, {}, distance};
    }
  for (const Triple<Real>& x : a.vertices)
    for (const auto& face : b.faces) try_face(x, b, face, false, best);
  for (const Triple<Real>& x : b.vertices)
    for (const auto& face : a.faces) try_face(x, a, face, true, best);
  const Triple<Real> delta = less(best.q, best.p);
  best.n = best.distance > 0          ? times(1 / best.distance, delta)
           : deep.n != Triple<Real>{} ? deep.n
                                      : Triple<Real>{1, 0, 0};
  return best;
}

template <class Real>
std::optional<Contact> contact_of_meshes(const Convexes& shapes, Distances distances, ContactPoints points) {
  Mesh<Real> a;
  Mesh<Real> b;
  std::visit([&](const auto& shape) { a.add(shape); }, shapes.a.shape);
  std::visit([&](const auto& shape) { b.add(shape); }, shapes.b.shape);
  Nearest<Real> found;
  if (const auto* plane = std::get_if<Plane>(&shapes.b.shape)) {
    const Triple<Real> normal = in_scalar<Real>(plane->normal);
    const Real length = std::sqrt(dot(normal, normal));
    found.n = times(-1 / length, normal);
    found.p = a.middle(found.n);
    found.distance = -dot(found.n, found.p) - static_cast<Real>(plane->offset) / length;
    found.q = moved(found.p, found.distance, found.n);
  } else {
    found = nearest(a, b);
  }
  if (!(found.distance <= static_cast<Real>(distances.alarm) + a.radius + b.radius)) return std::nullopt;
  const bool meets = found.distance == 0 && !std::holds_alternative<Plane>(shapes.b.shape);
  return Contact{widened(found.n), widened(moved(found.p, outward(points.first, a.radius), found.n)),
                 widened(moved(found.q, -outward(points.second, b.radius), found.n)),
                 static_cast<double>(found.distance - (a.radius + b.radius) - static_cast<Real>(distances.contact)),
                 meets};
}

}  // namespace
}  // namespace convexes_plain

std::optional<Contact> plain_contact(const Convexes& shapes, Distances distances, Scalar scalar, ContactPoints points) {
  return scalar == Scalar::binary32 ? convexes_plain::contact_of_meshes<float>(shapes, distances, points)
                                    : convexes_plain::contact_of_meshes<double>(shapes, distances, points);
}
bool plain_overlap(const Convexes& shapes, Distances distances, Scalar scalar) {
  return plain_contact(shapes, distances, scalar, {}).has_value();
}

}  // namespace contact::golden
