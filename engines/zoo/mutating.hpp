// What mutants are made of: production's answer, the question in wide arithmetic, and edits of both.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <type_traits>

#include "contact/sphere_sphere.hpp"
#include "engines/zoo/mutants.hpp"
#include "oracle/diagnosis/casts_in_reals.hpp"
#include "oracle/diagnosis/nearest_in_reals.hpp"
#include "oracle/truth/clamped.hpp"
#include "oracle/truth/truth.hpp"

namespace contact::engines {

/// Wide enough that a mutant is wrong by its one mistake, and not by rounding.
using Wide = long double;
using Wide3 = Eigen::Matrix<Wide, 3, 1>;

/// A sphere in wide arithmetic.
struct WideBall {
  Wide3 center;
  Wide radius;
};
using WideBalls = std::array<WideBall, 2>;

// Two shapes with a distance are two cores, each blown up by a radius. What a new kind of them says of itself: its
// cores at their nearest points, as spheres, and how deep one core is inside the other, if it can be.
inline WideBalls at_nearest(const Balls& spheres) {
  return {WideBall{spheres.a.center.cast<Wide>(), spheres.a.radius},
          WideBall{spheres.b.center.cast<Wide>(), spheres.b.radius}};
}
/// Of a crossing both are the point where the line goes through the plane.
inline WideBalls at_nearest(const RayAndTriangle& shapes) {
  const Wide3 x = oracle::CrossingInReals(shapes).at_vector();
  return {WideBall{x, 0}, WideBall{x, 0}};
}
inline WideBalls at_nearest(const TriangleAndLine& shapes) {
  const Wide3 x = oracle::CrossingInReals(shapes).at_vector();
  return {WideBall{x, 0}, WideBall{x, 0}};
}
/// Of a ray that is cast both are the point that it hits first, or begins at.
template <class Target>
WideBalls at_nearest(const CastAt<Target>& shapes) {
  const oracle::CastInPlain<Wide, Target> cast(shapes);
  const auto t = cast.begins_inside() ? std::nullopt : cast.first();
  const auto [x, y, z] = cast.at(t.value_or(0));
  return {WideBall{{x, y, z}, 0}, WideBall{{x, y, z}, 0}};
}
inline WideBalls at_nearest(const BallAndBox& shapes) { return at_nearest(at_clamped(shapes)); }
template <class A, class B>
WideBalls at_nearest(const Two<A, B>& shapes) {
  const auto radius = [](const auto& shape) -> Wide {
    if constexpr (requires { shape.radius; }) return shape.radius;
    return 0;
  };
  const auto [p, q] = oracle::nearest_in_reals(shapes);
  return {WideBall{{p[0], p[1], p[2]}, radius(shapes.a)}, WideBall{{q[0], q[1], q[2]}, radius(shapes.b)}};
}
template <class Kind>
Wide depth_of_cores(const Kind& /*shapes*/) {
  return 0;
}
inline Wide depth_of_cores(const BallAndBox& shapes) {
  const auto c = shapes.a.center.cast<Wide>();
  const Wide depth = std::min((c - shapes.b.min.cast<Wide>()).minCoeff(), (shapes.b.max.cast<Wide>() - c).minCoeff());
  return std::max(Wide{0}, depth);
}
template <class A>
requires(!std::same_as<A, Cast>) Wide depth_of_cores(const Two<A, Plane>& shapes) {
  return std::max(Wide{0}, -oracle::PlaneInReals(shapes.b).height(oracle::nearest_in_reals(shapes)[0]));
}

#define CONTACT_SAME_SHAPES(name, A, B, numbers, ...) \
  || (Numbers::numbers != Numbers::none && std::same_as<Kind, Two<A, B>>)
/// Whether contacts of two such shapes have numbers.
template <class Kind>
inline constexpr bool kHasNumbers = false CONTACT_PAIRS(CONTACT_SAME_SHAPES);
#undef CONTACT_SAME_SHAPES

/// Of any two convex shapes both come from the exact truth, of which a mistake is a change: the cores at their nearest
/// points, and the distance of these, below 0 where they overlap.
WideBalls at_nearest_of_convexes(const Query& q);
Wide distance_of_convexes(const Query& q);

/// The cores at their nearest points, as spheres. Domain: a pair with a distance.
inline WideBalls wide_balls(const Query& q) {
  if (is_convex(q.pair)) return at_nearest_of_convexes(q);
  return std::visit(
      []<class Kind>(const Kind& shapes) -> WideBalls {
        if constexpr (kHasNumbers<Kind>) return at_nearest(shapes);
        throw std::logic_error("shapes without nearest points");
      },
      q.shapes);
}
/// The same in double.
inline Balls balls(const Query& q) {
  const auto narrow = [](const WideBall& ball) {
    return Ball{ball.center.cast<double>(), static_cast<double>(ball.radius)};
  };
  const auto [a, b] = wide_balls(q);
  return {narrow(a), narrow(b)};
}
/// The exact truth, which is asked for again and again: many mutants are put to one question.
const oracle::Truth& truth_again(const Query& q);
/// Whether the cores meet, which gives no direction.
inline bool coincident(const Query& q) { return q.has_numbers() && truth_again(q).degenerate(); }

/// These cores in wide arithmetic.
struct WideSpheres {
  explicit WideSpheres(const Query& query) : alarm(query.distances.alarm), contact(query.distances.contact) {
    const auto [a, b] = wide_balls(query);
    r1 = a.radius;
    r2 = b.radius;
    for (std::size_t i = 0; i < 3; ++i) {
      c1[i] = a.center[static_cast<Eigen::Index>(i)];
      c2[i] = b.center[static_cast<Eigen::Index>(i)];
      d[i] = c2[i] - c1[i];
    }
    D = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    const Wide depth = is_convex(query.pair)
                           ? std::max(-distance_of_convexes(query), Wide{0})
                           : std::visit([](const auto& shapes) { return depth_of_cores(shapes); }, query.shapes);
    if (depth > 0 && is_convex(query.pair) && !has_plane(query.pair)) D = 0;  // as of a centre in a box
    distance = depth > 0 ? -depth : std::sqrt(D);
    reach = alarm + r1 + r2;
  }
  [[nodiscard]] Wide value() const { return distance - r1 - r2 - contact; }

  Wide r1, r2, alarm, contact;
  std::array<Wide, 3> c1, c2, d;
  Wide D, distance, reach;  ///< the distance of cores inside each other, or below a plane, is less than 0
};

/// Exactly: the surfaces overlap, or just touch.
inline bool overlapping(const Query& q) { return truth_again(q).at_zero != oracle::Side::beyond; }
inline bool at_edge(const Query& q) { return truth_again(q).at_alarm == oracle::Side::at; }

inline double rounded(Wide x) { return static_cast<double>(x); }
inline float single(double x) {
  // Through memory: GCC 12 leaves out both conversions where it makes vectors of them.
  const volatile float narrow = static_cast<float>(x);
  return narrow;
}
inline double narrowed(double x) { return static_cast<double>(single(x)); }

/// Changes the contact of an answer that has one.
template <class Change>
void in_contact(Claim& claim, Change change) {
  if (claim.contact) change(*claim.contact);
}
/// The same where the centres are apart, so that there is a direction to be wrong about.
inline constexpr auto in_direction = [](const Query& q, Claim& claim, auto change) {
  if (claim.contact && !coincident(q)) change(*claim.contact);
};

/// The contact points that go with the normal of a contact.
inline void points_from_normal(const Query& q, ContactClaim& c) {
  c.point1 = Vector3(balls(q).a.center + balls(q).a.radius * *c.normal);
  c.point2 = Vector3(balls(q).b.center - balls(q).b.radius * *c.normal);
}

/// Another normal, and the points that go with it.
inline constexpr auto turn = [](const Query& q, Claim& claim, auto change) {
  in_direction(q, claim, [&](ContactClaim& c) {
    change(*c.normal);
    points_from_normal(q, c);
  });
};

/// Centres no farther apart than `size` get a fixed normal.
void guard(const Query& q, Claim& claim, Wide size, const Vector3& normal);

/// Another decision for both claims, with the contact that the right formulas give.
void decide(const Query& query, Claim& claim, bool hit);
/// The answer for two spheres at other points, in wide arithmetic; the right answer where these are the right points.
void answer_at(const Query& q, Claim& claim, const Wide3& p, const Wide3& r);
/// Two mistakes that several engines made: the parameters of two axes are clamped, each alone, and the direction of a ray
/// is taken for a unit vector.
void clamp_each_alone(const Query& q, Claim& claim);
void take_direction_for_unit(const Query& q, Claim& claim);
/// Another decision from a comparison in wide arithmetic, about shapes with a distance.
inline constexpr auto decide_spheres = [](const Query& q, Claim& claim, auto compare) {
  if (q.has_distance()) decide(q, claim, compare(WideSpheres(q)));
};
/// And about boxes.
struct WideBox {
  Wide3 min;
  Wide3 max;
};
inline constexpr auto decide_boxes = [](const Query& q, Claim& claim, auto compare) {
  const auto wide = [](const Box& box) { return WideBox{box.min.cast<Wide>(), box.max.cast<Wide>()}; };
  if (q.boxes() != nullptr)
    decide(q, claim, compare(wide(q.boxes()->a), wide(q.boxes()->b), static_cast<Wide>(q.distances.alarm)));
};

/// Another value.
inline constexpr auto revalue = [](const Query& q, Claim& claim, auto value) {
  if (!claim.contact || !q.has_distance()) return;
  const WideSpheres s(q);
  const Wide other = value(s);
  // Nearest points of axes are rounded, in wide arithmetic too: what differs by that alone is no mistake.
  const Wide size =
      std::max({s.distance, s.r1 + s.r2, s.contact, std::abs(s.c1[0]), std::abs(s.c1[1]), std::abs(s.c1[2])});
  const bool is_rounding = std::abs(other - static_cast<Wide>(*claim.contact->value)) <= 1e-15L * size;
  if (!has_quotients(q.pair) || !is_rounding) claim.contact->value = rounded(other);
};

// What a mutant is made of: one of the helpers of this file, or of its own, and the part that is the mistake. A part is
// a lambda that captures nothing, so that all of it is a function.
template <class Helper, class Part>
constexpr auto with(Helper, Part) {
  static_assert(std::is_empty_v<Helper> && std::is_empty_v<Part>);
  return [](const Query& q, Claim& claim) { Helper{}(q, claim, Part{}); };
}
/// Changes the shapes of a question where they are of one kind.
template <class Kind, class Part>
constexpr auto change(Part) {
  static_assert(std::is_empty_v<Part>);
  return [](Query& q) {
    if (auto* shapes = std::get_if<Kind>(&q.shapes)) Part{}(*shapes);
  };
}
/// Changes the shapes of one kind in a question, one after the other.
template <class Changed, class Part>
constexpr auto each(Part) {
  static_assert(std::is_empty_v<Part>);
  return [](Query& q) {
    for_each_shape(q, []<class Shape>(Shape& shape) {
      if constexpr (std::same_as<Shape, Changed>) Part{}(shape);
    });
  };
}

/// For changes of the question, which are made in it.
inline Balls* balls_of(Query& q) { return std::get_if<Balls>(&q.shapes); }
inline Boxes* boxes_of(Query& q) { return std::get_if<Boxes>(&q.shapes); }
inline BallAndBox* ball_and_box_of(Query& q) { return std::get_if<BallAndBox>(&q.shapes); }
inline const BallAndBox* ball_and_box_of(const Query& q) { return std::get_if<BallAndBox>(&q.shapes); }
/// Calls edit(radius, shape) for the radius of each shape that has one.
template <class Edit>
void for_each_radius(Query& q, Edit edit) {
  int which = 0;
  for_each_shape(q, [&](auto& shape) {
    if constexpr (requires { shape.radius; }) edit(shape.radius, which);
    ++which;
  });
}

// A sphere against a box.
struct WideBallAndBox {
  Wide3 c;
  WideBox box;
  Wide r;
  Wide reach;
  [[nodiscard]] Wide3 middle() const { return (box.min + box.max) / 2; }
};
/// Another decision about a sphere and a box.
inline constexpr auto decide_ball_and_box = [](const Query& q, Claim& claim, auto compare) {
  if (const BallAndBox* s = ball_and_box_of(q)) {
    const Wide r = s->a.radius;
    const WideBallAndBox wide{
        s->a.center.cast<Wide>(), {s->b.min.cast<Wide>(), s->b.max.cast<Wide>()}, r, r + q.distances.alarm};
    decide(q, claim, compare(wide));
  }
};
/// Another box in the question, beside the centre.
template <class Part>
constexpr auto rebox(Part) {
  return change<BallAndBox>([](BallAndBox& s) { Part{}(s.a.center, s.b); });
}
inline Vector3 middle_of(const Box& box) { return box.min / 2 + box.max / 2; }
inline Box resized(const Box& box, double factor) {
  const Vector3 half = factor * (box.max / 2 - box.min / 2);
  return {middle_of(box) - half, middle_of(box) + half};
}
/// Another contact of a sphere whose centre is in the box.
inline constexpr auto in_box = [](const Query& q, Claim& claim, auto change) {
  const BallAndBox* s = ball_and_box_of(q);
  if (s != nullptr && claim.contact && coincident(q)) change(*s, *claim.contact);
};
struct Face {
  Eigen::Index axis;
  bool is_min;
};
/// A sphere whose centre is in the box leaves it by the face that `choose` takes of (depths below min, depths below
/// max).
inline constexpr auto leave_by = [](const Query& q, Claim& claim, auto choose) {
  in_box(q, claim, [&](const BallAndBox& s, ContactClaim& c) {
    const Wide3 center = s.a.center.cast<Wide>();
    const Wide3 below_min = center - s.b.min.cast<Wide>();
    const Wide3 below_max = s.b.max.cast<Wide>() - center;
    const auto [axis, is_min] = choose(below_min, below_max);
    c.normal = Vector3(Vector3::Zero());
    (*c.normal)[axis] = is_min ? 1 : -1;
    c.point1 = Vector3(s.a.center + s.a.radius * *c.normal);
    c.point2 = s.a.center;
    (*c.point2)[axis] = (is_min ? s.b.min : s.b.max)[axis];
    c.value = rounded(-static_cast<Wide>(s.a.radius) - (is_min ? below_min : below_max)[axis] - q.distances.contact);
  });
};

[[nodiscard]] std::span<const Mutant> real_mutants();
[[nodiscard]] std::span<const Mutant> feature_mutants();
[[nodiscard]] std::span<const Mutant> plane_mutants();
[[nodiscard]] std::span<const Mutant> crossing_mutants();
[[nodiscard]] std::span<const Mutant> reported_mutants();
[[nodiscard]] std::span<const Mutant> cast_mutants();
[[nodiscard]] std::span<const Mutant> convex_mutants();
[[nodiscard]] std::span<const Mutant> own_mutants();
[[nodiscard]] std::span<const Mutant> precision_mutants();

}  // namespace contact::engines
