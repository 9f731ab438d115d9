// Mistakes that users of public engines reported about capsules, rays, triangles and boxes, each in an arithmetic of
// its own, but for the two that SOFA has too: what it shares with the formulas of oracle/diagnosis/ is the mistake alone.
#include <Eigen/Geometry>

#include "engines/zoo/mutating.hpp"

namespace contact::engines {
namespace {

template <class T>
using Vector = Eigen::Matrix<T, 3, 1>;

// Two segments, p1 + s d1 and p2 + t d2.

struct Segments {
  Wide3 p1, d1, p2, d2;

  explicit Segments(const Capsules& shapes)
      : p1(shapes.a.start.cast<Wide>()),
        d1(shapes.a.end.cast<Wide>() - p1),
        p2(shapes.b.start.cast<Wide>()),
        d2(shapes.b.end.cast<Wide>() - p2) {}
  [[nodiscard]] bool is_point() const { return d1.isZero(0) || d2.isZero(0); }
  [[nodiscard]] bool is_parallel() const { return d1.cross(d2).isZero(0); }
};
/// Ericson's products of two segments, and a sign for one term of each parameter: all 1 are right.
struct Products {
  Wide a, b, e, c, f;
  Wide sign_of_c = 1;
  Wide sign_of_f = 1;

  /// r: the difference of the starts, first less second.
  Products(const Segments& x, const Wide3& r)
      : a(x.d1.dot(x.d1)), b(x.d1.dot(x.d2)), e(x.d2.dot(x.d2)), c(x.d1.dot(r)), f(x.d2.dot(r)) {}

  [[nodiscard]] std::array<Wide, 2> parameters(Wide determinant) const {
    const auto cut = [](Wide t) { return std::min(std::max(t, Wide{0}), Wide{1}); };
    Wide s = determinant > 0 ? cut((b * f - sign_of_c * c * e) / determinant) : 0;
    Wide t = (b * s + sign_of_f * f) / e;
    if (t < 0) {
      t = 0;
      s = cut(-c / a);
    } else if (t > 1) {
      t = 1;
      s = cut((b - c) / a);
    }
    return {s, t};
  }
};
/// The answer of products that a mistake makes; right where an axis is a point.
constexpr auto by_products = [](const Query& q, Claim& claim, auto make) {
  const auto* shapes = std::get_if<Capsules>(&q.shapes);
  if (shapes == nullptr) return;
  const Segments x(*shapes);
  if (x.is_point() || x.is_parallel()) return;
  const Products made = make(x);
  const auto [s, t] = made.parameters(x.d1.cross(x.d2).squaredNorm());
  answer_at(q, claim, x.p1 + s * x.d1, x.p2 + t * x.d2);
};

/// What MJX, Newton and MuJoCo Warp do, in their arithmetic: the nearest points of the lines through the middles, cut
/// to the segments, and then the foot of each on the other segment. 1e-6 stands in every denominator.
template <class T>
void with_a_millionth(const Query& q, Claim& claim) {
  const auto* shapes = std::get_if<Capsules>(&q.shapes);
  if (shapes == nullptr) return;
  constexpr auto kMillionth = static_cast<T>(1e-6);
  struct Part {
    Vector<T> start, end, middle, direction;
    T half;
  };
  const auto part_of = [](const Capsule& capsule) {
    Part p;
    p.start = capsule.start.cast<T>();
    p.end = capsule.end.cast<T>();
    const Vector<T> u = p.end - p.start;
    const T length = std::sqrt(u.squaredNorm());
    p.direction = length == 0 ? u : Vector<T>(u / length);
    p.half = length * static_cast<T>(0.5);
    p.middle = p.start + p.direction * p.half;
    return p;
  };
  const Part a = part_of(shapes->a);
  const Part b = part_of(shapes->b);
  const Vector<T> between = a.middle - b.middle;
  const T cosine = a.direction.dot(b.direction);
  const T along_a = a.direction.dot(between);
  const T along_b = b.direction.dot(between);
  const T s = (cosine * along_b - along_a) / (1 - cosine * cosine + kMillionth);
  const T t = along_b + s * cosine;
  const auto cut = [](T x, T half) { return std::min(std::max(x, -half), half); };
  Vector<T> on_a = a.middle + a.direction * cut(s, a.half);
  Vector<T> on_b = b.middle + b.direction * cut(t, b.half);
  const auto foot = [&](const Part& p, const Vector<T>& x) {
    const Vector<T> u = p.end - p.start;
    const T parameter = (x - p.start).dot(u) / (u.dot(u) + kMillionth);
    return Vector<T>(p.start + std::min(std::max(parameter, T{0}), T{1}) * u);
  };
  const Vector<T> other_a = foot(a, on_b);
  const Vector<T> other_b = foot(b, on_a);
  if ((on_b - other_a).squaredNorm() < (on_a - other_b).squaredNorm())
    on_a = other_a;
  else
    on_b = other_b;
  const auto r1 = static_cast<T>(shapes->a.radius);
  const auto r2 = static_cast<T>(shapes->b.radius);
  const Vector<T> d = on_b - on_a;
  const T distance = std::sqrt(d.squaredNorm());
  const Vector<T> n = distance == 0 ? Vector<T>(1, 0, 0) : Vector<T>(d / distance);
  const T value = distance - (r1 + r2);
  claim.overlap = value <= static_cast<T>(q.distances.alarm);
  if (!*claim.overlap) {
    claim.contact.reset();
    return;
  }
  const Vector<T> point1 = on_a + n * r1;
  const Vector<T> point2 = on_b - n * r2;
  claim.contact = ContactClaim{Vector3(n.template cast<double>()), Vector3(point1.template cast<double>()),
                               Vector3(point2.template cast<double>()), std::nullopt,
                               static_cast<double>(value - static_cast<T>(q.distances.contact))};
}

/// A capsule with other ends: `by` beyond each of its ends, but not beyond its middle.
void lengthen(Capsule& capsule, double by) {
  const Wide3 start = capsule.start.cast<Wide>();
  const Wide3 end = capsule.end.cast<Wide>();
  const Wide length = (end - start).stableNorm();
  if (!(length > 0)) return;
  const Wide part = std::max(static_cast<Wide>(by) / length, Wide{-0.5});
  capsule.start = (start - part * (end - start)).cast<double>();
  capsule.end = (end + part * (end - start)).cast<double>();
}

// A sphere and a triangle.

struct Corners {
  Wide3 c, v0, e1, e2, n;  ///< of the centre, the first vertex, two edges and their cross product

  explicit Corners(const BallAndTriangle& shapes)
      : c(shapes.a.center.cast<Wide>()),
        v0(shapes.b.vertices[0].cast<Wide>()),
        e1(shapes.b.vertices[1].cast<Wide>() - v0),
        e2(shapes.b.vertices[2].cast<Wide>() - v0),
        n(e1.cross(e2)) {}
  [[nodiscard]] bool is_flat() const { return n.isZero(0); }
  [[nodiscard]] Wide3 at(Wide second, Wide third) const { return v0 + second * e1 + third * e2; }
  /// The coordinates of the foot on the plane, of the second vertex and the third.
  [[nodiscard]] std::array<Wide, 2> of_foot() const {
    const Wide3 w = c - v0;
    const Wide n2 = n.squaredNorm();
    return {w.cross(e2).dot(n) / n2, e1.cross(w).dot(n) / n2};
  }
  /// The coordinates of the nearest point of the three edges.
  [[nodiscard]] std::array<Wide, 2> on_edges() const {
    const std::array<std::array<Wide, 4>, 3> edges{{{0, 0, 1, 0}, {1, 0, -1, 1}, {0, 1, 0, -1}}};
    std::array<Wide, 2> best{0, 0};
    for (const auto& [x, y, dx, dy] : edges) {
      const Wide3 u = dx * e1 + dy * e2;
      const Wide along = u.squaredNorm() > 0 ? (c - at(x, y)).dot(u) / u.squaredNorm() : 0;
      const Wide t = std::min(std::max(along, Wide{0}), Wide{1});
      if ((at(x + t * dx, y + t * dy) - c).squaredNorm() < (at(best[0], best[1]) - c).squaredNorm())
        best = {x + t * dx, y + t * dy};
    }
    return best;
  }
  /// The coordinates by the regions of vertices and edges, tried one after the other, each comparison with 0 being one
  /// with `limit`; nothing where none is taken.
  [[nodiscard]] std::optional<std::array<Wide, 2>> by_regions(Wide limit) const {
    const Wide3 ap = c - v0;
    const Wide3 bp = ap - e1;
    const Wide3 cp = ap - e2;
    const Wide d1 = e1.dot(ap), d2 = e2.dot(ap), d3 = e1.dot(bp), d4 = e2.dot(bp), d5 = e1.dot(cp), d6 = e2.dot(cp);
    const auto ratio = [](Wide x, Wide y) { return y == 0 ? 0 : x / y; };
    if (d1 < limit && d2 < limit) return {{0, 0}};
    if (d3 > -limit && d4 <= d3) return {{1, 0}};
    if (d1 * d4 - d3 * d2 < limit && d1 > -limit && d3 < limit) return {{ratio(d1, d1 - d3), 0}};
    if (d6 > -limit && d5 <= d6) return {{0, 1}};
    if (d5 * d2 - d1 * d6 < limit && d2 > -limit && d6 < limit) return {{0, ratio(d2, d2 - d6)}};
    const Wide share = ratio(d4 - d3, (d4 - d3) + (d5 - d6));
    if (d3 * d6 - d5 * d4 < limit && d4 - d3 > -limit && d5 - d6 > -limit) return {{1 - share, share}};
    return std::nullopt;
  }
  [[nodiscard]] std::array<Wide, 2> nearest() const {
    if (is_flat()) return on_edges();
    const auto [second, third] = of_foot();
    return second >= 0 && third >= 0 && second + third <= 1 ? of_foot() : on_edges();
  }
};
/// The answer at a point of the triangle with these coordinates; nothing leaves it right.
constexpr auto at_coordinates = [](const Query& q, Claim& claim, auto choose) {
  const auto* shapes = std::get_if<BallAndTriangle>(&q.shapes);
  if (shapes == nullptr) return;
  const Corners corners(*shapes);
  const std::optional<std::array<Wide, 2>> chosen = choose(corners);
  if (chosen) answer_at(q, claim, corners.c, corners.at((*chosen)[0], (*chosen)[1]));
};
using Coordinates = std::optional<std::array<Wide, 2>>;
bool is_flat_triangle(const Query& q) {
  const auto* shapes = std::get_if<BallAndTriangle>(&q.shapes);
  return shapes != nullptr && Corners(*shapes).is_flat();
}

/// Every number of a contact is none.
void all_nan(Claim& claim) {
  in_contact(claim, [](ContactClaim& c) {
    c.value = std::numeric_limits<double>::quiet_NaN();
    c.normal = c.point1 = c.point2 = Vector3::Constant(*c.value);
  });
}

/// Another signed distance of a centre from a box; where it is the right one the answer is right.
constexpr auto at_signed_distance = [](const Query& q, Claim& claim, auto distance_of) {
  const BallAndBox* shapes = ball_and_box_of(q);
  if (shapes == nullptr) return;
  const WideSpheres right(q);
  const Wide distance = distance_of(*shapes, right.distance);
  if (distance == right.distance) return;
  decide(q, claim, distance <= right.reach);
  in_contact(claim, [&](ContactClaim& c) { c.value = rounded(distance - right.r1 - right.r2 - right.contact); });
};
/// How many faces of a box, their edges included, a ray from a point along (1, 1, 1) goes through.
int faces_crossed(const Vector3& from, const Box& box) {
  int crossed = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (const double at : {box.min[axis], box.max[axis]}) {
      const Wide t = static_cast<Wide>(at) - from[axis];
      if (t < 0) continue;
      bool inside = true;
      for (int other = 0; other < 3; ++other) {
        if (other == axis) continue;
        const Wide x = from[other] + t;
        inside = inside && x >= box.min[other] && x <= box.max[other];
      }
      crossed += inside ? 1 : 0;
    }
  return crossed;
}

const std::array kReported{
    // Two segments.
    Mutant{"mjx-capsule-capsule", "1e-6 is added to both denominators of the nearest points of two segments",
           "segments-plus-1e-6", nullptr, with_a_millionth<double>,
           "https://github.com/google-deepmind/mujoco/blob/main/mjx/mujoco/mjx/_src/math.py"},
    Mutant{"newton-capsule-capsule", "the same in single precision", "segments-plus-1e-6", nullptr,
           with_a_millionth<float>,
           "https://github.com/newton-physics/newton/blob/main/newton/_src/geometry/collision_primitive.py",
           Origin::real, false, Scalar::binary32},
    Mutant{"sceneview-segment-sign", "the difference of the starts has the other sign in every product",
           "segments-offset-reversed", nullptr,
           with(by_products, [](const Segments& x) { return Products(x, x.p2 - x.p1); }),
           "https://github.com/sceneview/sceneview/pull/1139"},
    Mutant{"rdk-segment-sign", "one sign of the first parameter is wrong: b f + c e", "segments-first-term-sign",
           nullptr,
           with(by_products,
                [](const Segments& x) {
                  Products products(x, x.p1 - x.p2);
                  products.sign_of_c = -1;
                  return products;
                }),
           "https://github.com/viamrobotics/rdk/pull/5088"},
    Mutant{"line2point-sign", "one sign of the second parameter is wrong: b s - f", "segments-second-term-sign",
           nullptr,
           with(by_products,
                [](const Segments& x) {
                  Products products(x, x.p1 - x.p2);
                  products.sign_of_f = -1;
                  return products;
                }),
           "https://github.com/kunalchelani/Line2Point/pull/3"},
    Mutant{"segments-w-of-first", "the start of the first segment is taken for the difference of both starts",
           "segments-offset-of-first", nullptr, with(by_products, [](const Segments& x) { return Products(x, x.p1); })},
    Mutant{"segments-w-of-second", "the start of the second segment is taken for the difference of both starts",
           "segments-offset-of-second", nullptr,
           with(by_products, [](const Segments& x) { return Products(x, -x.p2); })},
    Mutant{"meshes-jl-clamps-alone", "both parameters of the lines are clamped, and nothing is computed again",
           "parameters-clamped-alone", nullptr, clamp_each_alone,
           "https://github.com/JuliaGeometry/Meshes.jl/pull/1262"},
    Mutant{"godot-parallel-nan", "every number is NaN where two segments are parallel, or one is a point",
           "parallel-not-finite", nullptr,
           [](const Query& q, Claim& claim) {
             const auto* shapes = std::get_if<Capsules>(&q.shapes);
             if (shapes != nullptr && Segments(*shapes).is_parallel()) all_nan(claim);
           },
           "https://github.com/godotengine/godot/issues/55384"},

    // What a capsule is.
    Mutant{"cyclone-capsule-radius", "the radius of a capsule is never read", "capsule-radius-missing",
           each<Capsule>([](Capsule& c) { c.radius = 0; }), nullptr,
           "https://github.com/jbaicoianu/cyclone-physics-js/issues/3"},
    Mutant{"stride-caps-in-length", "the caps of a capsule are counted in its length", "capsule-caps-in-length",
           each<Capsule>([](Capsule& c) { lengthen(c, -c.radius); }), nullptr,
           "https://github.com/stride3d/stride/pull/2086"},
    Mutant{"simple-collider-caps-added", "the caps of a capsule are added to its length", "capsule-caps-added",
           each<Capsule>([](Capsule& c) { lengthen(c, c.radius); }), nullptr,
           "https://github.com/Weisl/simple_collider/issues/615"},
    Mutant{"fcl-capsule-origin", "a capsule begins in its middle", "capsule-from-middle", each<Capsule>([](Capsule& c) {
             const Wide3 half = (c.end.cast<Wide>() - c.start.cast<Wide>()) / 2;
             c.start = (c.start.cast<Wide>() + half).cast<double>();
             c.end = (c.end.cast<Wide>() + half).cast<double>();
           }),
           nullptr, "https://github.com/flexible-collision-library/fcl/issues/225"},
    Mutant{"byro-capsule-midpoint", "a capsule is centred on the start of its axis", "capsule-around-start",
           each<Capsule>([](Capsule& c) {
             const Wide3 half = (c.end.cast<Wide>() - c.start.cast<Wide>()) / 2;
             c.start = (c.start.cast<Wide>() - half).cast<double>();
             c.end = (c.end.cast<Wide>() - half).cast<double>();
           }),
           nullptr, "https://github.com/matiaszanolli/ByroRedux/issues/3317"},

    // A ray.
    Mutant{"wicked-ray-from-inside", "a ray that starts inside the sphere never hits it", "ray-from-inside-missed",
           nullptr,
           [](const Query& q, Claim& claim) {
             const auto* shapes = std::get_if<RayAndBall>(&q.shapes);
             if (shapes == nullptr) return;
             const Wide3 w = shapes->b.center.cast<Wide>() - shapes->a.origin.cast<Wide>();
             if (w.stableNorm() <= static_cast<Wide>(shapes->b.radius)) decide(q, claim, false);
           },
           "https://github.com/turanszkij/WickedEngine/issues/1695"},
    Mutant{"collision-rs-ray-direction", "the direction of a ray is not normalised where the projection is taken",
           "ray-direction-unit", nullptr, take_direction_for_unit, "https://github.com/rustgd/collision-rs/issues/97"},

    // A sphere and a triangle.
    Mutant{"three-mesh-bvh-weights", "each barycentric coordinate goes with the next vertex",
           "triangle-weights-rotated", nullptr,
           with(at_coordinates,
                [](const Corners& x) -> Coordinates {
                  const auto [second, third] = x.nearest();
                  return {{1 - second - third, second}};
                }),
           "https://github.com/gkjohnson/three-mesh-bvh/issues/914"},
    Mutant{"sdf-barycentric-sign", "one barycentric coordinate has the other sign", "triangle-weight-negated", nullptr,
           with(at_coordinates,
                [](const Corners& x) -> Coordinates {
                  if (x.is_flat()) return std::nullopt;
                  const auto [second, third] = x.of_foot();
                  const bool inside = -second >= 0 && third >= 0 && third - second <= 1;
                  return inside ? Coordinates({-second, third}) : x.on_edges();
                }),
           "https://github.com/sxyu/sdf/pull/12"},
    Mutant{"trimesh-obtuse-vertex", "beside the face, the vertex of the one positive coordinate is taken",
           "triangle-vertex-by-signs", nullptr,
           with(at_coordinates,
                [](const Corners& x) -> Coordinates {
                  if (x.is_flat()) return std::nullopt;
                  const auto [second, third] = x.of_foot();
                  const bool positive[3] = {1 - second - third > 0, second > 0, third > 0};
                  if (positive[0] + positive[1] + positive[2] != 1) return std::nullopt;
                  return {{positive[1] ? Wide{1} : 0, positive[2] ? Wide{1} : 0}};
                }),
           "https://github.com/mikedh/trimesh/pull/310"},
    Mutant{"triangle-face-dropped", "the face of a triangle counts for nothing where its doubled area is below 1e-4",
           "triangle-face-dropped-1e-4", nullptr,
           with(at_coordinates,
                [](const Corners& x) -> Coordinates {
                  return x.n.norm() < 1e-4L ? Coordinates(x.on_edges()) : std::nullopt;
                })},
    Mutant{"trimesh-regions-1e-13",
           "the regions of a triangle are told apart by comparisons with 1e-13, of products of two and of four lengths",
           "triangle-regions-1e-13", nullptr,
           with(at_coordinates, [](const Corners& x) { return x.by_regions(1e-13L); }),
           "https://github.com/mikedh/trimesh/blob/a513c0e2cfa6dfbd3121a6dfd8ceb002b9ef55d8/trimesh/triangles.py#L656"},
    Mutant{"parry-flat-triangle-zero", "a triangle without an inside is 0 away, wherever the sphere is",
           "triangle-flat-zero", nullptr,
           [](const Query& q, Claim& claim) {
             if (!is_flat_triangle(q)) return;
             decide(q, claim, true);
             in_contact(claim, [&](ContactClaim& c) { c.value = rounded(-WideSpheres(q).r1 - q.distances.contact); });
           },
           "https://github.com/dimforge/parry/issues/76"},
    Mutant{"parry-flat-triangle-nan", "every number of a triangle without an inside is NaN", "triangle-flat-not-finite",
           nullptr,
           [](const Query& q, Claim& claim) {
             if (is_flat_triangle(q)) all_nan(claim);
           },
           "https://github.com/dimforge/parry/pull/358"},

    // The sign of the distance from a box.
    Mutant{"trimesh-coplanar-face", "a centre in the plane of a face is 0 away from the box",
           "sphere-box-coplanar-face", nullptr,
           with(at_signed_distance,
                [](const BallAndBox& s, Wide distance) {
                  const auto c = s.a.center.array();
                  const bool in_plane = (c == s.b.min.array()).any() || (c == s.b.max.array()).any();
                  return in_plane && distance > 0 ? Wide{0} : distance;
                }),
           "https://github.com/mikedh/trimesh/issues/73"},
    Mutant{"open3d-ray-parity", "the sign of the distance is that of the number of faces that a ray goes through",
           "sphere-box-sign-by-parity", nullptr,
           with(at_signed_distance,
                [](const BallAndBox& s, Wide distance) {
                  return faces_crossed(s.a.center, s.b) % 2 == 0 ? std::abs(distance) : -std::abs(distance);
                }),
           "https://github.com/isl-org/Open3D/issues/5105"},

    // Numbers that are none.
    Mutant{"touching-all-nan", "every number is NaN where the surfaces just touch or overlap", "answer-not-finite",
           nullptr,
           [](const Query& q, Claim& claim) {
             if (claim.contact && overlapping(q)) all_nan(claim);
           }},
};

}  // namespace

std::span<const Mutant> reported_mutants() { return kReported; }

}  // namespace contact::engines
