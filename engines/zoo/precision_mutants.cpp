// Arithmetics that are too coarse: the right formulas with roundings, estimates and tolerances of their own.
#include <bit>
#include <cstdint>

#include "engines/engine.hpp"
#include "engines/zoo/mutating.hpp"

namespace contact::engines {
namespace {

using Three = std::array<double, 3>;

/// Decides spheres in an arithmetic of its own, on numbers scaled by a power of two so that no square leaves the range.
template <auto hits>
void rounded_decisions(const Query& q, Claim& claim) {
  if (!q.has_distance()) return;
  const WideSpheres s(q);
  if (s.distance < 0) return;  // below a plane: squares have no sign, which is another mistake
  int exponent = 0;
  std::frexp(std::max({std::abs(s.d[0]), std::abs(s.d[1]), std::abs(s.d[2]), s.reach}), &exponent);
  const auto scaled = [&](Wide x) { return rounded(std::ldexp(x, -exponent)); };
  const Three d{scaled(s.d[0]), scaled(s.d[1]), scaled(s.d[2])};
  decide(q, claim, hits(d, scaled(s.r1), scaled(s.r2), scaled(s.alarm)));
}

/// Everything that production is told, rounded to float first.
void narrow_question(Query& q) {
  const Query asked = q;
  for_each_number(q, [](const std::string&, double& x) {
    const double narrow = narrowed(x);
    x = std::isfinite(narrow) ? narrow : x;
  });
  if (outside_domain(q)) q = asked;  // a direction that has become 0
}

Vector3 narrowed(const Vector3& v) {
  Vector3 narrow;
  for (int axis = 0; axis < 3; ++axis) narrow[axis] = engines::narrowed(v[axis]);
  return std::isfinite(narrow.sum()) ? narrow : v;
}

/// 1 / sqrt(x) by a table of `bits` bits, as processors estimate it: cut off, not rounded.
double estimate(Wide x, int bits) {
  int exponent = 0;
  const Wide root = std::frexp(1 / std::sqrt(x), &exponent);
  return rounded(std::ldexp(std::floor(std::ldexp(root, bits)), exponent - bits));
}

template <auto root>
void normals_by(const Query& q, Claim& claim) {
  if (is_cast(q.pair)) return;  // the length of its normal is the root of nothing
  in_direction(q, claim, [&](ContactClaim& c) {
    const WideSpheres s(q);
    const Wide r = root(s.D);
    c.normal = Vector3(rounded(s.d[0] * r), rounded(s.d[1] * r), rounded(s.d[2] * r));
    points_from_normal(q, c);
  });
}

/// The reciprocal root by its bits and one step of Newton's.
Wide by_bits(Wide D) {
  int exponent = 0;
  Wide m = std::frexp(D, &exponent);
  if (exponent % 2 != 0) {
    m *= 2;
    --exponent;
  }
  const auto x = static_cast<float>(m);
  const float y = std::bit_cast<float>(0x5f3759dfU - (std::bit_cast<std::uint32_t>(x) >> 1U));
  return std::ldexp(static_cast<Wide>(y * (1.5F - 0.5F * x * y * y)), -exponent / 2);
}

/// The contact of production where the squares of the plain formulas stay in double's range; else what they give.
void plain_squares(const Query& q, Claim& claim) {
  if (!q.has_distance() || has_plane(q.pair)) return;  // a distance from a plane is no root of a square
  const Vector3 d = balls(q).b.center - balls(q).a.center;
  const double D = d.squaredNorm();
  const double reach = balls(q).a.radius + balls(q).b.radius + q.distances.alarm;
  const double reach2 = reach * reach;
  constexpr double kSmallest = std::numeric_limits<double>::min();
  const bool in_range = std::isfinite(D) && std::isfinite(reach2) && (D >= kSmallest || coincident(q)) &&
                        (reach2 >= kSmallest || reach == 0);
  if (in_range) return;
  decide(q, claim, D <= reach2);
  in_direction(q, claim, [&](ContactClaim& c) {
    const double distance = std::sqrt(D);
    c.normal = Vector3(d / distance);
    points_from_normal(q, c);
    c.value = distance - (balls(q).a.radius + balls(q).b.radius) - q.distances.contact;
  });
}

template <class Decide>
void decide_in_float(const Query& q, Claim& claim, Decide hits) {
  if (const Boxes* b = q.boxes()) {
    bool hit = true;
    for (int axis = 0; axis < 3; ++axis)
      hit = hit && single(b->a.min[axis]) <= single(b->b.max[axis]) + single(q.distances.alarm) &&
            single(b->b.min[axis]) <= single(b->a.max[axis]) + single(q.distances.alarm);
    decide(q, claim, hit);
  } else {
    decide_spheres(q, claim, hits);
  }
}

#define CONTACT_WIDENED(size) [](Query& q) { q.distances.alarm += size; }
#define CONTACT_NARROWED(size)                                                            \
  [](const Query& q, Claim& claim) {                                                      \
    if (q.has_distance())                                                                 \
      decide_spheres(q, claim, [&](const WideSpheres& s) {                                \
        return claim.overlap.value() && s.distance - s.reach <= -static_cast<Wide>(size); \
      });                                                                                 \
    else                                                                                  \
      decide_boxes(q, claim, [&](const WideBox& a, const WideBox& b, Wide alarm) {        \
        const Wide gap = (a.min - b.max).cwiseMax(b.min - a.max).maxCoeff();              \
        return claim.overlap.value() && gap - alarm <= -(size);                           \
      });                                                                                 \
  }
#define CONTACT_GUARDED(size) [](const Query& q, Claim& claim) { guard(q, claim, size, {0, 1, 0}); }

const std::array kPrecision{
    Mutant{"float-inputs", "the question is rounded to float, the rest is exact", "inputs-single", narrow_question},
    Mutant{"float-answer", "every number of the answer is rounded to float", "single-precision", nullptr,
           [](const Query&, Claim& claim) {
             in_contact(claim, [](ContactClaim& c) {
               c.normal = narrowed(*c.normal);
               c.point1 = narrowed(*c.point1);
               c.point2 = narrowed(*c.point2);
               const double value = engines::narrowed(*c.value);
               if (std::isfinite(value)) c.value = value;
             });
           }},
    Mutant{"float-value", "the value is rounded to float", "single-precision", nullptr,
           [](const Query&, Claim& claim) {
             in_contact(claim, [](ContactClaim& c) {
               const double value = engines::narrowed(*c.value);
               if (std::isfinite(value)) c.value = value;
             });
           }},
    Mutant{"float-normal", "the normal is rounded to float, and the points go with it", "single-precision", nullptr,
           with(turn, [](Vector3& n) { n = narrowed(n); })},
    Mutant{"float-points", "the points are rounded to float", "single-precision", nullptr,
           [](const Query&, Claim& claim) {
             in_contact(claim, [](ContactClaim& c) {
               c.point1 = narrowed(*c.point1);
               c.point2 = narrowed(*c.point2);
             });
           }},
    Mutant{"float-decision", "both decisions are made in float", "single-decision", nullptr,
           [](const Query& q, Claim& claim) {
             decide_in_float(q, claim, [](const WideSpheres& s) {
               return static_cast<float>(s.distance) <= static_cast<float>(s.reach);
             });
           }},
    Mutant{"float-distance", "the distance of the centres is rounded to float before the value", "single-precision",
           nullptr,
           with(revalue,
                [](const WideSpheres& s) {
                  const auto narrow = static_cast<Wide>(static_cast<float>(s.distance));
                  return std::isfinite(narrow) ? narrow - s.r1 - s.r2 - s.contact : s.value();
                })},

    // Roundings in another order: nearly always right, and wrong in the last bit at the edge.
    Mutant{"plain-order", "squares and sums each rounded to double", "rounding", nullptr,
           rounded_decisions<[](const Three& d, double r1, double r2, double alarm) {
             const double reach = (r1 + r2) + alarm;
             return d[0] * d[0] + d[1] * d[1] + d[2] * d[2] <= reach * reach;
           }>},
    Mutant{"fused-sum", "products fused into the sum of squares", "rounding", nullptr,
           rounded_decisions<[](const Three& d, double r1, double r2, double alarm) {
             const double reach = (r1 + r2) + alarm;
             return std::fma(d[2], d[2], std::fma(d[1], d[1], d[0] * d[0])) <= reach * reach;
           }>},
    Mutant{"fused-compare", "the squared reach fused into the comparison", "rounding", nullptr,
           rounded_decisions<[](const Three& d, double r1, double r2, double alarm) {
             const double reach = (r1 + r2) + alarm;
             return std::fma(-reach, reach, d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) <= 0;
           }>},
    Mutant{"sum-from-the-end", "the squares summed from z", "rounding", nullptr,
           rounded_decisions<[](const Three& d, double r1, double r2, double alarm) {
             const double reach = (r1 + r2) + alarm;
             return d[0] * d[0] + (d[1] * d[1] + d[2] * d[2]) <= reach * reach;
           }>},
    Mutant{"reach-from-alarm", "the reach summed from the alarm distance", "rounding", nullptr,
           rounded_decisions<[](const Three& d, double r1, double r2, double alarm) {
             const double reach = (alarm + r1) + r2;
             return d[0] * d[0] + d[1] * d[1] + d[2] * d[2] <= reach * reach;
           }>},
    Mutant{"root-compared", "the rounded distance compared with the rounded reach", "rounding", nullptr,
           rounded_decisions<[](const Three& d, double r1, double r2, double alarm) {
             return std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) <= (r1 + r2) + alarm;
           }>},
    Mutant{"difference-compared", "the rounded value compared with the alarm distance", "rounding", nullptr,
           rounded_decisions<[](const Three& d, double r1, double r2, double alarm) {
             return std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) - (r1 + r2) <= alarm;
           }>},
    Mutant{"square-expanded", "the square of the reach multiplied out", "rounding", nullptr,
           rounded_decisions<[](const Three& d, double r1, double r2, double alarm) {
             const double radii = r1 + r2;
             return d[0] * d[0] + d[1] * d[1] + d[2] * d[2] <= radii * radii + 2 * radii * alarm + alarm * alarm;
           }>},
    Mutant{"quotient-compared", "a quotient of squares compared with 1", "rounding", nullptr,
           rounded_decisions<[](const Three& d, double r1, double r2, double alarm) {
             const double reach = (r1 + r2) + alarm;
             const double D = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
             return reach == 0 ? D == 0 : D / (reach * reach) <= 1;
           }>},
    Mutant{"box-difference", "the rounded gap of boxes compared with the alarm distance", "rounding", nullptr,
           [](const Query& q, Claim& claim) {
             if (q.boxes() == nullptr) return;
             const auto& [a, b] = *q.boxes();
             decide(q, claim,
                    (a.min - b.max).maxCoeff() <= q.distances.alarm && (b.min - a.max).maxCoeff() <= q.distances.alarm);
           }},
    Mutant{"box-plain", "max + alarm rounded to double", "rounding", nullptr,
           [](const Query& q, Claim& claim) {
             if (q.boxes() == nullptr) return;
             const auto& [a, b] = *q.boxes();
             decide(q, claim,
                    (a.min.array() <= b.max.array() + q.distances.alarm).all() &&
                        (b.min.array() <= a.max.array() + q.distances.alarm).all());
           }},

    // Estimates of a reciprocal square root.
    Mutant{"rsqrt-12", "the normal by an estimate of 12 bits", "normal-wrong-length", nullptr,
           normals_by<[](Wide D) { return static_cast<Wide>(estimate(D, 12)); }>},
    Mutant{"rsqrt-23", "the normal by a reciprocal root in float", "normal-wrong-length", nullptr,
           normals_by<[](Wide D) { return static_cast<Wide>(estimate(D, 23)); }>},
    Mutant{"rsqrt-bits", "the normal by the bits of the number and one step of Newton's", "normal-wrong-length",
           nullptr, normals_by<by_bits>},
    Mutant{"rsqrt-value", "the value by an estimate of 12 bits", "four-digits", nullptr,
           with(revalue,
                [](const WideSpheres& s) {
                  return s.D > 0 ? s.D * static_cast<Wide>(estimate(s.D, 12)) - s.r1 - s.r2 - s.contact : s.value();
                })},

    Mutant{"normal-square-plus-1e-12", "1e-12 added to the square that the root is taken of",
           "normal-square-plus-1e-12", nullptr, normals_by<[](Wide D) { return 1 / std::sqrt(D + 1e-12L); }>},
    Mutant{"float-nearest-point", "the nearest point of the box is rounded to float", "single-precision", nullptr,
           [](const Query& q, Claim& claim) {
             const BallAndBox* s = ball_and_box_of(q);
             if (s == nullptr || coincident(q)) return;
             const Vector3 nearest = narrowed(balls(q).b.center);
             if (nearest != s->a.center && std::isfinite(nearest.sum()))
               claim = production_answer({Pair::sphere_sphere, Balls{s->a, {nearest, 0}}, q.distances},
                                         PointConvention::nearest_surface);
           }},

    // The range of squares.
    Mutant{"squares-in-double", "squares that overflow or vanish", "square-range", nullptr, plain_squares},
    Mutant{"box-sum-overflows", "max + alarm overflows, and everything hits", "sum-range", nullptr,
           [](const Query& q, Claim& claim) {
             decide_boxes(q, claim, [&](const WideBox& a, const WideBox& b, Wide alarm) {
               const bool over = std::isinf(rounded(std::max(a.max.maxCoeff(), b.max.maxCoeff()) + alarm));
               return over ? true : claim.overlap.value();
             });
           }},

    // Absolute tolerances.
    Mutant{"tolerance-1e-15", "an absolute 1e-15 added to the reach", "tolerance-1e-15", CONTACT_WIDENED(1e-15)},
    Mutant{"tolerance-1e-12", "an absolute 1e-12 added to the reach", "tolerance-1e-12", CONTACT_WIDENED(1e-12)},
    Mutant{"tolerance-1e-9", "an absolute 1e-9 added to the reach", "tolerance-1e-9", CONTACT_WIDENED(1e-9)},
    Mutant{"tolerance-1e-6", "an absolute 1e-6 added to the reach", "tolerance-1e-6", CONTACT_WIDENED(1e-6)},
    Mutant{"tolerance-1e-3", "an absolute 1e-3 added to the reach", "tolerance-1e-3", CONTACT_WIDENED(1e-3)},
    Mutant{"narrowed-1e-12", "an absolute 1e-12 subtracted from the reach", "tolerance-minus-1e-12", nullptr,
           CONTACT_NARROWED(1e-12)},
    Mutant{"narrowed-1e-9", "an absolute 1e-9 subtracted from the reach", "tolerance-minus-1e-9", nullptr,
           CONTACT_NARROWED(1e-9)},
    Mutant{"narrowed-1e-6", "an absolute 1e-6 subtracted from the reach", "tolerance-minus-1e-6", nullptr,
           CONTACT_NARROWED(1e-6)},
    Mutant{"centres-within-1e-9", "centres within an absolute 1e-9 count as coincident", "centres-within-1e-9", nullptr,
           CONTACT_GUARDED(1e-9L)},
    Mutant{"centres-within-1e-6", "centres within an absolute 1e-6 count as coincident", "centres-within-1e-6", nullptr,
           CONTACT_GUARDED(1e-6L)},
    Mutant{"centres-within-1e-3", "centres within an absolute 1e-3 count as coincident", "centres-within-1e-3", nullptr,
           CONTACT_GUARDED(1e-3L)},
};

}  // namespace

std::span<const Mutant> precision_mutants() { return kPrecision; }

}  // namespace contact::engines
