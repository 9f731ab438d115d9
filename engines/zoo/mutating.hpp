// What mutants are made of: production's answer, the question in wide arithmetic, and edits of both.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "contact/sphere_sphere.hpp"
#include "engines/zoo/mutants.hpp"
#include "oracle/diagnosis/nearest_in_reals.hpp"
#include "oracle/truth/clamped.hpp"
#include "oracle/truth/truth.hpp"

namespace contact::engines {

/// Wide enough that a mutant is wrong by its one mistake, and not by rounding.
using Wide = long double;

using WideVector = Eigen::Matrix<Wide, 3, 1>;

/// A sphere in wide arithmetic.
struct WideBall {
  WideVector center;
  Wide radius;
};
/// The cores of two shapes at their nearest points: two spheres; of a sphere and a box the sphere, and the nearest
/// point of the box; of axes the points nearest to each other. Domain: a pair with numbers.
inline std::array<WideBall, 2> wide_balls(const Query& q) {
  const auto of = [](const Balls& balls) {
    return std::array{WideBall{balls.a.center.cast<Wide>(), balls.a.radius},
                      WideBall{balls.b.center.cast<Wide>(), balls.b.radius}};
  };
  return std::visit(
      [&]<class A, class B>(const Two<A, B>& shapes) -> std::array<WideBall, 2> {
        if constexpr (std::same_as<B, Capsule>) {
          const oracle::AxisInReals first(shapes.a);
          const oracle::AxisInReals second(shapes.b);
          const auto [s, t] = oracle::nearest_parameters(first, second);
          const oracle::Numbers p = first.at(s);
          const oracle::Numbers r = second.at(t);
          return {WideBall{{p[0], p[1], p[2]}, shapes.a.radius}, WideBall{{r[0], r[1], r[2]}, shapes.b.radius}};
        } else if constexpr (std::same_as<A, Ball> && std::same_as<B, Box>) {
          return of(at_clamped(shapes));
        } else if constexpr (std::same_as<B, Ball>) {
          return of(shapes);
        } else {
          throw std::logic_error("two boxes have no nearest points");
        }
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
/// Whether the cores meet, which leaves no direction.
inline bool coincident(const Query& q) {
  return q.has_numbers() && oracle::truth_with(q, oracle::Side::at, oracle::Side::at).degenerate();
}

/// These spheres, and what follows from them.
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
    distance = std::sqrt(D);
    reach = alarm + r1 + r2;
  }
  [[nodiscard]] Wide value() const { return distance - r1 - r2 - contact; }

  Wide r1, r2, alarm, contact;
  std::array<Wide, 3> c1, c2, d;
  Wide D, distance, reach;
};

/// Exactly: the surfaces overlap, or just touch.
inline bool overlapping(const Query& q) { return oracle::truth_of(q).at_zero != oracle::Side::beyond; }
inline bool at_edge(const Query& q) { return oracle::truth_of(q).at_alarm == oracle::Side::at; }

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
template <class Change>
void in_direction(const Query& q, Claim& claim, Change change) {
  if (claim.contact && !coincident(q)) change(*claim.contact);
}

/// The contact points that go with the normal of a contact.
inline void points_from_normal(const Query& q, ContactClaim& c) {
  c.point1 = Vector3(balls(q).a.center + balls(q).a.radius * *c.normal);
  c.point2 = Vector3(balls(q).b.center - balls(q).b.radius * *c.normal);
}

/// Another normal, and the points that go with it.
template <class Change>
void turn(const Query& q, Claim& claim, Change change) {
  in_direction(q, claim, [&](ContactClaim& c) {
    change(*c.normal);
    points_from_normal(q, c);
  });
}

/// Another decision for both claims, with the contact that the right formulas give.
void decide(const Query& query, Claim& claim, bool hit);
/// The same from a comparison in wide arithmetic, about spheres.
template <class Compare>
void decide_spheres(const Query& q, Claim& claim, Compare compare) {
  if (q.balls() != nullptr) decide(q, claim, compare(WideSpheres(q)));
}
/// And about boxes.
struct WideBox {
  Eigen::Matrix<Wide, 3, 1> min;
  Eigen::Matrix<Wide, 3, 1> max;
};
template <class Compare>
void decide_boxes(const Query& q, Claim& claim, Compare compare) {
  const auto wide = [](const Box& box) { return WideBox{box.min.cast<Wide>(), box.max.cast<Wide>()}; };
  if (q.boxes() != nullptr)
    decide(q, claim, compare(wide(q.boxes()->a), wide(q.boxes()->b), static_cast<Wide>(q.distances.alarm)));
}

/// Another value; not of a sphere whose centre is in a box, which has a formula of its own.
template <class Value>
void revalue(const Query& q, Claim& claim, Value value) {
  if (!claim.contact || (q.balls() == nullptr && coincident(q))) return;
  const WideSpheres s(q);
  const Wide other = value(s);
  // Nearest points of axes are rounded, in wide arithmetic too: what differs by that alone is no mistake.
  const Wide size =
      std::max({s.distance, s.r1 + s.r2, s.contact, std::abs(s.c1[0]), std::abs(s.c1[1]), std::abs(s.c1[2])});
  const bool is_rounding = std::abs(other - static_cast<Wide>(*claim.contact->value)) <= 1e-15L * size;
  if (q.balls() != nullptr || !is_rounding) claim.contact->value = rounded(other);
}

/// For changes of the question, which are made in it.
inline Balls* balls_of(Query& q) { return std::get_if<Balls>(&q.shapes); }
inline Boxes* boxes_of(Query& q) { return std::get_if<Boxes>(&q.shapes); }

[[nodiscard]] std::span<const Mutant> real_mutants();
[[nodiscard]] std::span<const Mutant> feature_mutants();
[[nodiscard]] std::span<const Mutant> own_mutants();
[[nodiscard]] std::span<const Mutant> precision_mutants();

}  // namespace contact::engines
