// The contact of two convex cores, or of one over a half-space, in numbers that bound their own error: most contacts are rounded from them.
//
// Plain double says which features are nearest, or which facet of A - B is, and its bounds prove it:
//   apart     along q - p every vertex of A outside the one feature lies before p, every one of B outside the other behind q
//   overlap   0 lies below every facet of A - B, and is nearer to one of them than to any other; facets are made by a face and a vertex, or by two edges, which the ways of
//             both make, or with a hull a polytope that grows
// Where there are several nearest points or normals, and where something is not certain, there is no contact here: the exact stage answers.
// Included by convexes_enclosed.hpp, once for each kind of processor.

#include "kernel/enclosure-inl.h"

namespace contact::kernel {
namespace CONTACT_TARGET {
inline Enclosures enclosed(const Vector3& x) { return {Enclosure(x[0]), Enclosure(x[1]), Enclosure(x[2])}; }

/// The vertices of a core, in the order of NearCore's, and its ways.
class EnclosedCorners {
 public:
  explicit EnclosedCorners(const GivenCorners& given)
      : given_(given.vertices != nullptr ? given.vertices : given.given.data()),
        orientation_(given.orientation),
        kind_(given.kind) {}

  /// To be called before corners and ways of a rotated box.
  void turn() {
    if (kind_ != Kind::obb) return;
    inverse_ = inverse();
    for (std::size_t axis = 0; axis < 3; ++axis) columns_[axis] = column(axis);
  }
  [[nodiscard]] Enclosures operator()(std::size_t k) const {
    if (kind_ == Kind::points) return enclosed(given_[k]);
    if (kind_ == Kind::box) return enclosed({given_[k & 1][0], given_[k >> 1 & 1][1], given_[k >> 2 & 1][2]});
    const auto half = [&](std::size_t axis) { return k >> axis & 1 ? extent(axis) : -extent(axis); };
    const std::array<double, 3> halves{half(0), half(1), half(2)};
    Enclosures corner;
    for (std::size_t i = 0; i < 3; ++i)
      corner[i] = Enclosure(given_[0][static_cast<Eigen::Index>(i)]) +
                  inverse_ * sum_of_multiples<3>(halves, {columns_[0][i], columns_[1][i], columns_[2][i]});
    return corner;
  }
  /// From one corner to another.
  [[nodiscard]] Enclosures way(std::size_t from, std::size_t to) const {
    if (kind_ == Kind::points) return given_difference(given_[to], given_[from]);
    if (!std::has_single_bit(from ^ to)) return (*this)(to) - (*this)(from);
    const auto axis = static_cast<std::size_t>(std::countr_zero(from ^ to));
    if (kind_ == Kind::box) {
      Enclosures along{};  // exactly 0 on the other axes
      along[axis] = (*this)(to)[axis] - (*this)(from)[axis];
      return along;
    }
    return (2 * (from < to ? extent(axis) : -extent(axis)) * inverse_) * columns_[axis];
  }
  /// A vector of any length along a way of NearCore.
  [[nodiscard]] Enclosures along(std::size_t way_of_near) const {
    if (kind_ == Kind::points) return way(way_of_near / 2, way_of_near / 2 + (way_of_near == 1 ? 2 : 1));
    if (kind_ == Kind::obb) return columns_[way_of_near];
    Enclosures axis{};
    axis[way_of_near] = Enclosure(1);
    return axis;
  }
  /// A face: its unit normal, and a point, beyond which it lies so far.
  struct Face {
    Enclosures normal;
    Vector3 from;
    double beyond;
  };
  /// The face of a box that faces along a way, or against it, or the one of a triangle. Nothing where it has none. Needs no turn().
  [[nodiscard]] std::optional<Face> face(std::size_t way_of_near, double sign) const {
    if (kind_ == Kind::box) {
      Face found{{}, given_[sign > 0], 0};
      found.normal[way_of_near] = Enclosure(sign);
      return found;
    }
    if (kind_ == Kind::obb) return Face{(sign * inverse()) * column(way_of_near), given_[0], extent(way_of_near)};
    const Enclosures n = sign * cross(way(0, 1), way(0, 2));
    const Enclosure N = dot(n, n);
    if (!N.is_clear()) return std::nullopt;
    return Face{reciprocal(root(N)) * n, given_[0], 0};
  }

 private:
  using Kind = GivenCorners::Kind;
  [[nodiscard]] double extent(std::size_t axis) const { return given_[1][static_cast<Eigen::Index>(axis)]; }
  /// 1 / |q|^2
  [[nodiscard]] Enclosure inverse() const { return reciprocal(sum_of_given_products<4>(orientation_, orientation_)); }
  /// |q|^2 times a column of the rotation.
  [[nodiscard]] Enclosures column(std::size_t axis) const {
    const std::size_t next = (axis + 1) % 3;
    const std::size_t last = (axis + 2) % 3;
    const double w = orientation_[3];
    const double x = orientation_[axis];
    const double y = orientation_[next];
    const double z = orientation_[last];
    Enclosures of;
    of[axis] = sum_of_given_products<4>({w, x, y, z}, {w, x, -y, -z});
    of[next] = twice(sum_of_given_products<2>({x, w}, {y, z}));
    of[last] = twice(sum_of_given_products<2>({x, w}, {z, -y}));
    return of;
  }

  const Vector3* given_;
  const Quaternion& orientation_;
  Kind kind_;
  Enclosure inverse_;
  std::array<Enclosures, 3> columns_;
};

/// A core by its corners, nearly and in enclosures.
template <class Near>
struct CornersOf {
  const Near& near;
  EnclosedCorners corners;
};

/// A vertex, an edge, a triangle or a side of a box, by its corners: those next to the first one come before the one across.
struct CornerSet {
  std::array<std::size_t, 4> at{};
  std::size_t size = 0;

  [[nodiscard]] std::size_t dimension() const { return std::min<std::size_t>(size, 3) - 1; }
  [[nodiscard]] bool has(std::size_t k) const {
    return std::find(at.begin(), at.begin() + size, k) != at.begin() + size;
  }
  [[nodiscard]] Enclosures way(const EnclosedCorners& corners, std::size_t k) const {
    return corners.way(at[0], at[k]);
  }
};

/// The corners that lie farthest along a direction, or nearly: a way that was walked is off by some 2^-25. Nothing where they make no feature.
template <class Near>
[[nodiscard]] std::optional<CornerSet> farthest_set(const Near& core, const NearSimplex::Vector& way) {
  std::array<double, std::same_as<Near, NearCore> ? 8 : kMostVertices> along;
  const NearSimplex::Vector first = core.corner(0);
  double most = 0;
  double size = 0;
  for (std::size_t k = 0; k < core.count; ++k) {
    const NearSimplex::Vector from_first = near::difference(core.corner(k), first);
    along[k] = near::dot(way, from_first);
    most = std::max(most, along[k]);
    size = std::max(size, near::largest(from_first));
  }
  const double least = most - 0x1p-22 * size * near::largest(way);
  CornerSet set;
  for (std::size_t k = 0; k < core.count; ++k) {
    if (!(along[k] >= least)) continue;
    if (set.size == 4) return std::nullopt;
    set.at[set.size++] = k;
  }
  const auto is_one_bit = [&](std::size_t i, std::size_t j) { return std::has_single_bit(set.at[i] ^ set.at[j]); };
  bool is_box = false;
  if constexpr (std::same_as<Near, NearCore>) is_box = core.is_box();
  const bool is_one = set.size == 1 || (set.size == 2 && (!is_box || is_one_bit(0, 1))) || (set.size == 3 && !is_box) ||
                      (set.size == 4 && is_box && is_one_bit(0, 1) && is_one_bit(0, 2) && is_one_bit(1, 3));
  return is_one ? std::optional(set) : std::nullopt;
}

/// A direction, and how far the sum of its components may be off.
struct NearWay {
  NearSimplex::Vector way;
  double off;

  explicit NearWay(const Enclosures& x) : way{x[0].high, x[1].high, x[2].high}, off(0) {
    for (const Enclosure& each : x) off += 0x1p-52 * std::abs(each.high) + each.radius;
  }
};
/// Whether every corner outside of a set lies before its first one, along a direction or against it.
/// The difference of two corners is off by 2 error, and by u of its size, at most 2 `size`; its product with the way by 3 u of that. What is used is at least twice as wide.
template <class Near>
[[nodiscard]] bool are_others_before(const Near& core, const CornerSet& set, const NearWay& along, double sign) {
  const auto& [way, off] = along;
  const double sum = std::abs(way[0]) + std::abs(way[1]) + std::abs(way[2]);
  const double bound = sum * (4 * core.error + 0x1p-47 * core.size) + off * 8 * core.size;
  const NearSimplex::Vector from = core.corner(set.at[0]);
  std::uint64_t others = ~std::uint64_t{0};
  for (std::size_t k = 0; k < set.size; ++k) others &= ~(std::uint64_t{1} << set.at[k]);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < core.count; ++k) {
    const double before = sign * near::dot(way, near::difference(from, core.corner(k)));
    if (others >> k & 1) least = std::min(least, before);
  }
  return least > bound;
}

/// Whether the foot of a point lies inside a face.
[[nodiscard]] inline bool is_over(const Enclosures& u, const Enclosures& w, bool is_parallelogram,
                                  const Enclosures& r) {
  const Enclosure uu = dot(u, u);
  const Enclosure uw = dot(u, w);
  const Enclosure ww = dot(w, w);
  const Enclosure ru = dot(r, u);
  const Enclosure rw = dot(r, w);
  const Enclosure of_u = ru * ww - rw * uw;
  const Enclosure of_w = rw * uu - ru * uw;
  const Enclosure whole = uu * ww - uw * uw;
  if (!of_u.is_positive() || !of_w.is_positive()) return false;
  return is_parallelogram ? (whole - of_u).is_positive() && (whole - of_w).is_positive()
                          : (whole - (of_u + of_w)).is_positive();
}

/// A contact by the nearest points, the normal and the distance, which is below 0 where the cores overlap.
class EnclosedContact {
 public:
  EnclosedContact(const Enclosures& p, const Enclosures& q, const Enclosures& normal, const Enclosure& distance,
                  const Lengths& lengths)
      : p_(p),
        q_(q),
        normal_(normal),
        distance_(distance),
        radii_(two_sum(lengths.radius1, lengths.radius2), 0),
        contact_(lengths.contact) {}

  [[nodiscard]] NearSide side(double alarm) const {
    const Enclosure past = distance_ - (radii_ + Enclosure(alarm));
    return past.is_positive() ? NearSide::miss : (-past).is_positive() ? NearSide::hit : NearSide::unknown;
  }
  [[nodiscard]] Approximation normal(std::size_t axis) const { return normal_[axis].approximation(); }
  [[nodiscard]] Approximation point1(std::size_t axis, double signed_radius) const {
    return beside(p_[axis], axis, signed_radius);
  }
  [[nodiscard]] Approximation point2(std::size_t axis, double signed_radius) const {
    return beside(q_[axis], axis, signed_radius);
  }
  [[nodiscard]] Approximation value() const { return (distance_ - (radii_ + Enclosure(contact_))).approximation(); }
  [[nodiscard]] static constexpr bool is_unique() { return true; }

 private:
  [[nodiscard]] Approximation beside(const Enclosure& core, std::size_t axis, double signed_radius) const {
    return signed_radius == 0 ? core.approximation() : (core + signed_radius * normal_[axis]).approximation();
  }

  Enclosures p_;
  Enclosures q_;
  Enclosures normal_;
  Enclosure distance_;
  Enclosure radii_;
  double contact_;
};

/// A feature of each core, of which no other point is as near.
class TwoSets {
 public:
  TwoSets(const EnclosedCorners& a, const CornerSet& f, const EnclosedCorners& b, const CornerSet& g)
      : a_(a), f_(f), b_(b), g_(g) {}

  /// Nearest points that surely lie inside both, and the way between.
  struct Nearest {
    Enclosures p;
    Enclosures q;
    Enclosures delta;
  };
  [[nodiscard]] std::optional<Nearest> nearest() const {
    if (f_.size == 1) return of_point(a_(f_.at[0]), b_, g_);
    if (g_.size > 1) return of_edges();
    auto found = of_point(b_(g_.at[0]), a_, f_);
    if (!found) return std::nullopt;
    return Nearest{found->q, found->p, -found->delta};
  }

 private:
  static std::optional<Nearest> of_point(const Enclosures& p, const EnclosedCorners& corners, const CornerSet& set) {
    const Enclosures o = corners(set.at[0]);
    if (set.size == 1) return Nearest{p, o, o - p};
    const Enclosures r = p - o;
    const Enclosures u = set.way(corners, 1);
    if (set.size == 2) {
      const Enclosure part = dot(r, u);
      const Enclosure whole = dot(u, u);
      if (!whole.is_clear() || !part.is_positive() || !(whole - part).is_positive()) return std::nullopt;
      const Enclosures foot = (part * reciprocal(whole)) * u;
      return Nearest{p, o + foot, foot - r};
    }
    const Enclosures w = set.way(corners, 2);
    const Enclosures n = cross(u, w);
    const Enclosure N = dot(n, n);
    if (!N.is_clear() || !is_over(u, w, set.size == 4, r)) return std::nullopt;
    const Enclosures delta = -((dot(r, n) * reciprocal(N)) * n);
    return Nearest{p, p + delta, delta};
  }
  [[nodiscard]] std::optional<Nearest> of_edges() const {
    if (f_.size != 2 || g_.size != 2) return std::nullopt;
    const Enclosures from = a_(f_.at[0]);
    const Enclosures to = b_(g_.at[0]);
    const Enclosures u = f_.way(a_, 1);
    const Enclosures w = g_.way(b_, 1);
    const Enclosures d = to - from;
    const Enclosures n = cross(u, w);
    const Enclosure N = dot(n, n);
    if (!N.is_clear()) return std::nullopt;
    const Enclosure s = dot(cross(d, w), n);
    const Enclosure t = dot(cross(d, u), n);
    for (const Enclosure& part : {s, t})
      if (!part.is_positive() || !(N - part).is_positive()) return std::nullopt;
    const Enclosure inverse = reciprocal(N);
    return Nearest{from + (s * inverse) * u, to + (t * inverse) * w, (dot(d, n) * inverse) * n};
  }

  const EnclosedCorners& a_;
  const CornerSet& f_;
  const EnclosedCorners& b_;
  const CornerSet& g_;
};

/// A feature of each core.
struct Features {
  CornerSet f;
  CornerSet g;
};
/// Those that lie farthest along a way, and against it. Nothing where they would have many nearest points.
template <class A, class B>
[[nodiscard]] std::optional<Features> features_along(const A& a, const B& b, const NearSimplex::Vector& way) {
  const auto f = farthest_set(a, way);
  const auto g = farthest_set(b, {-way[0], -way[1], -way[2]});
  if (!f || !g || f->dimension() + g->dimension() > 2) return std::nullopt;
  return Features{*f, *g};
}
/// The contact of cores that are apart, by their features that face each other.
template <class A, class B>
[[nodiscard]] std::optional<EnclosedContact> contact_between(const CornersOf<A>& a, const CornersOf<B>& b,
                                                             const Features& features, const Lengths& lengths) {
  const auto& [f, g] = features;
  const auto nearest = TwoSets(a.corners, f, b.corners, g).nearest();
  if (!nearest) return std::nullopt;
  const auto& [p, q, delta] = *nearest;
  const Enclosure D = dot(delta, delta);
  const NearWay along(delta);
  if (!D.is_clear() || !are_others_before(a.near, f, along, 1) || !are_others_before(b.near, g, along, -1))
    return std::nullopt;
  const Enclosure distance = root(D);
  return EnclosedContact(p, q, reciprocal(distance) * delta, distance, lengths);
}
/// The contact of cores that overlap, at the facet of A - B that is nearest to 0, which faces along `facing`, about, and is made by a face and a vertex or by two edges.
/// The foot of 0 lies inside of it, for a ball about 0 that touches its plane touches no other.
template <class A, class B>
[[nodiscard]] std::optional<EnclosedContact> contact_at_facet(const CornersOf<A>& a, const CornersOf<B>& b,
                                                              const Features& features,
                                                              const NearSimplex::Vector& facing,
                                                              const Lengths& lengths) {
  const auto& [f, g] = features;
  if (f.dimension() + g.dimension() != 2) return std::nullopt;
  const Enclosures u = f.size > 1 ? f.way(a.corners, 1) : g.way(b.corners, 1);
  const Enclosures w = f.size > 2 ? f.way(a.corners, 2) : g.way(b.corners, f.size > 1 ? 1 : 2);
  const Enclosures n = cross(u, w);
  const Enclosure N = dot(n, n);
  const NearWay along(n);
  const double sign = near::dot(along.way, facing) > 0 ? 1 : -1;
  if (!N.is_clear() || !are_others_before(a.near, f, along, sign) || !are_others_before(b.near, g, along, -sign))
    return std::nullopt;
  const Enclosure inverse = sign * reciprocal(root(N));
  const Enclosures normal = inverse * n;
  const Enclosures from = a.corners(f.at[0]);
  const Enclosures to = b.corners(g.at[0]);
  const Enclosures between = to - from;
  const Enclosure distance = dot(normal, between);  // below 0
  if (g.size == 1) return EnclosedContact(to - distance * normal, to, normal, distance, lengths);
  const Enclosures p = f.size == 1 ? from : from + (inverse * dot(cross(between, w), normal)) * u;
  return EnclosedContact(p, p + distance * normal, normal, distance, lengths);
}
/// The contact of cores that overlap, by corners of B - A around 0.
template <class A, class B>
[[nodiscard]] std::optional<EnclosedContact> contact_inside(const CornersOf<A>& a, const CornersOf<B>& b, double error,
                                                            const std::array<NearSimplex::Vector, 4>& around,
                                                            const Lengths& lengths) {
  const NearPolytope polytope(a.near, b.near, error, around);
  const NearPolytope::Face& nearest = polytope.nearest();
  const auto features = features_along(a.near, b.near, nearest.normal);
  if (!features) return std::nullopt;
  // Two corners of A - B may be the same in double; either is as far off.
  const auto is_of_facet = [&](const NearSimplex::Vector& corner) {
    const auto& [f, g] = *features;
    for (std::size_t i = 0; i < f.size; ++i)
      for (std::size_t k = 0; k < g.size; ++k)
        if (near::difference(a.near.corner(f.at[i]), b.near.corner(g.at[k])) == corner) return true;
    return false;
  };
  if (!polytope.is_surely_nearest(nearest, is_of_facet)) return std::nullopt;
  return contact_at_facet(a, b, *features, nearest.normal, lengths);
}

/// How far a product of a way of a core and a direction may be off: the way by 2 e, and what is used is twice as wide.
[[nodiscard]] inline double off_along(const NearCore& core, const NearWay& along) {
  const auto& [way, off] = along;
  return (std::abs(way[0]) + std::abs(way[1]) + std::abs(way[2])) * (4 * core.error + 0x1p-48 * core.size) +
         off * 8 * core.size;
}
/// The corner that surely lies farthest along sign * a direction, or nothing. If `edge` is a way of the core, all those that differ by it lie there, and this is the
/// first of them.
[[nodiscard]] inline std::optional<std::size_t> surely_farthest(const NearCore& core, const NearWay& along, double sign,
                                                                std::size_t edge = 3) {
  const double off = off_along(core, along);
  const auto ahead = [&](std::size_t way) { return sign * near::dot(along.way, core.ways[way]); };
  if (core.is_triangle()) {
    // Its ways lead from its first corner to the others, and between these.
    const std::array<double, 3> at{0, ahead(0), ahead(1)};
    const std::size_t best =
        edge == 3 ? static_cast<std::size_t>(std::max_element(at.begin(), at.end()) - at.begin()) : edge / 2;
    const std::size_t other = edge == 3 ? best : edge == 1 ? 2 : best + 1;
    for (std::size_t k = 0; k < 3; ++k)
      if (k != best && k != other && !(std::min(at[best], at[other]) - at[k] > off)) return std::nullopt;
    return best;
  }
  std::size_t corner = 0;
  for (std::size_t way = 0; way < core.directions(); ++way) {
    if (way == edge) continue;
    const double more = ahead(way);
    if (!(std::abs(more) > off)) return std::nullopt;
    if (more > 0) corner |= std::size_t{1} << way;
  }
  return corner;
}

/// The contact of cores that overlap, at the facet of A - B that 0 is nearest to, of a face of `faced` and a vertex of the other.
[[nodiscard]] inline std::optional<EnclosedContact> contact_at_face(CornersOf<NearCore>& faced,
                                                                    CornersOf<NearCore>& other, bool is_a,
                                                                    const NearFacet& facet, const Lengths& lengths) {
  // The third way of a box. From A to B, so out of A and into B.
  const auto face = faced.corners.face(3 - facet.axis.u - facet.axis.w, facet.is_back == is_a ? -1 : 1);
  if (!face) return std::nullopt;
  const auto deepest = surely_farthest(other.near, NearWay(face->normal), -1);
  if (!deepest) return std::nullopt;
  other.corners.turn();
  const Enclosures x = other.corners(*deepest);
  const Enclosure depth = Enclosure(face->beyond) - dot(face->normal, x - enclosed(face->from));
  const Enclosures out = x + depth * face->normal;
  return is_a ? EnclosedContact(out, x, face->normal, -depth, lengths)
              : EnclosedContact(x, out, -face->normal, -depth, lengths);
}
/// The same of two edges.
[[nodiscard]] inline std::optional<EnclosedContact> contact_at_edges(CornersOf<NearCore>& a, CornersOf<NearCore>& b,
                                                                     const NearFacet& facet, const Lengths& lengths) {
  a.corners.turn();
  b.corners.turn();
  const Enclosures u = a.corners.along(facet.axis.u);
  const Enclosures w = b.corners.along(facet.axis.w);
  const double sign = facet.is_back ? -1 : 1;
  const Enclosures n = sign * cross(u, w);
  const Enclosure N = dot(n, n);
  const NearWay along(n);
  const auto f = surely_farthest(a.near, along, 1, facet.axis.u);
  const auto g = surely_farthest(b.near, along, -1, facet.axis.w);
  if (!N.is_clear() || !f || !g) return std::nullopt;
  const Enclosures from = a.corners(*f);
  const Enclosures between = b.corners(*g) - from;
  const Enclosure inverse = reciprocal(root(N));
  const Enclosures normal = inverse * n;
  const Enclosure distance = dot(normal, between);  // below 0
  const Enclosures p = from + ((sign * inverse) * dot(cross(between, w), normal)) * u;
  return EnclosedContact(p, p + distance * normal, normal, distance, lengths);
}
[[nodiscard]] inline std::optional<EnclosedContact> contact_overlapping(CornersOf<NearCore>& a, CornersOf<NearCore>& b,
                                                                        const NearFacet& facet,
                                                                        const Lengths& lengths) {
  if (facet.axis.of_a && facet.axis.of_b) return contact_at_edges(a, b, facet, lengths);
  if (facet.axis.of_a) return contact_at_face(a, b, true, facet, lengths);
  return contact_at_face(b, a, false, facet, lengths);
}

/// The contact of a rotated box over a half-space, at the one vertex that is lowest.
[[nodiscard]] inline EnclosedContact contact_over(const EnclosedCorners& box, std::size_t lowest, const Plane& plane,
                                                  const Lengths& lengths) {
  const Enclosures n = -enclosed(plane.normal);
  const Enclosures p = box(lowest);
  const Enclosure inverse = reciprocal(root(dot(n, n)));
  const Enclosure distance = -((dot(n, p) + Enclosure(plane.offset)) * inverse);
  const Enclosures normal = inverse * n;
  return EnclosedContact(p, p + distance * normal, normal, distance, lengths);
}

/// near_side() of two cores, compiled for the same processors.
template <class A, class B>
[[nodiscard]] NearSide side_of(const A& a, const B& b, double alarm) {
  return near_side(a, b, alarm);
}

inline Certain rounded(const std::optional<EnclosedContact>& found, NearSide side, const Lengths& lengths,
                       ContactPoints points, Contact& contact) {
  if (!found) return {side};
  if (side == NearSide::unknown) side = found->side(lengths.alarm);
  return {side, side == NearSide::hit ? round_certain(*found, lengths, points, contact) : kAllNumbers};
}
/// Domain of `in_range`: nothing that is computed in enclosures overflows.
template <class A, class B>
[[nodiscard]] Certain certain(const A& near_a, const GivenCorners& given_a, const B& near_b,
                              const GivenCorners& given_b, bool in_range, const Lengths& lengths, ContactPoints points,
                              Contact& contact) {
  CornersOf<A> a{near_a, EnclosedCorners(given_a)};
  CornersOf<B> b{near_b, EnclosedCorners(given_b)};
  const NearScale scale(a.near, b.near, lengths.alarm);
  if (!scale.holds()) return {NearSide::unknown};
  if constexpr (kHaveWays<A, B>) {
    std::optional<NearFacet> facet;
    const NearSide side = with_depths(a.near, b.near, scale, [&](auto& depths) {
      const NearSide found = depths.side(scale.reach);
      if (found == NearSide::hit) facet = depths.least();
      return found;
    });
    if (side == NearSide::miss) return {side};
    if (side == NearSide::hit) {
      if (!in_range || !facet) return {side};
      return rounded(contact_overlapping(a, b, *facet, lengths), side, lengths, points, contact);
    }
  }
  const NearAnswer near = walk(a.near, b.near, scale, true);
  if (near.side == NearSide::miss || !in_range || !(near.way || near.around)) return {near.side};
  a.corners.turn();
  b.corners.turn();
  std::optional<EnclosedContact> found;
  if (near.around)
    found = contact_inside(a, b, scale.error, *near.around, lengths);
  else if (const auto features = features_along(a.near, b.near, *near.way))
    found = contact_between(a, b, *features, lengths);
  return rounded(found, near.side, lengths, points, contact);
}
[[nodiscard]] inline Certain certain(const NearCore& box, const GivenCorners& given, const Plane& plane, bool in_range,
                                     const Lengths& lengths, ContactPoints points, Contact& contact) {
  const NearLowest lowest(box, near::vector(plane.normal));
  const NearSide side = lowest.side(plane, box.radius, lengths.alarm);
  const auto corner = lowest.corner();
  if (side == NearSide::miss || !in_range || !corner) return {side};
  EnclosedCorners corners(given);
  corners.turn();
  return rounded(contact_over(corners, *corner, plane, lengths), side, lengths, points, contact);
}
}  // namespace CONTACT_TARGET
}  // namespace contact::kernel
