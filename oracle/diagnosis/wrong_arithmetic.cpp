// Causes that compute too coarsely. They stand last, and what the vague ones explain counts for less.
#include "oracle/diagnosis/formulas.hpp"
#include "oracle/truth/exact_truth.hpp"

namespace contact::oracle::formulas {
namespace {

constexpr double kToleranceWeight = 0.92;
constexpr double kSmallToleranceWeight = 0.95;
/// A formula about near decisions has to explain nearly all of them, for what rounds explains all.
constexpr double kOwnFormatWeight = 0.93;

Real largest_number(F f) { return std::ldexp(Real{1}, format_of(f.scalar).max_exponent + 1); }

/// Whether a product does that engines make of their shapes: of three differences, of squares, of the normal with a point.
bool products_out_of_range(F f) {
  const Real smallest = std::ldexp(Real{1}, format_of(f.scalar).min_exponent);
  const auto lost = [&](Real x) { return x != 0 && (std::abs(x) < smallest || std::abs(x) >= largest_number(f)); };
  const auto of_triangle = [&](const Triangle& t) {
    const auto edge = [&](std::size_t k) {
      return along(numbers_of(t.vertices[(k + 1) % 3]), -1, numbers_of(t.vertices[k]));
    };
    const Numbers u = edge(0);
    const Numbers v = edge(1);
    const Numbers n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    return lost(dot(n, n)) || lost(dot(u, u)) || lost(dot(v, v));
  };
  const auto of_plane = [&](const Plane& plane) {
    const Numbers n = numbers_of(plane.normal);
    return std::any_of(kAxes.begin(), kAxes.end(),
                       [&](std::size_t axis) { return lost(n[axis] * n[axis]) || lost(n[axis] * f.nearest[0][axis]); });
  };
  const auto of_convex = [&]<class Shape>(const Shape& shape) {
    if constexpr (std::same_as<Shape, Triangle>) return of_triangle(shape);
    if constexpr (std::same_as<Shape, Plane>) return of_plane(shape);
    // Of a rotated box the squares of its quaternion; of what a number has a square, its size: axes are crossed.
    const auto lost_square = [&](double x) { return lost(Real{x} * Real{x}); };
    bool found = false;
    for_each_field(shape, [&](const auto& field, const auto& value) {
      if (field.kind != FieldKind::point) for_each_number_in(value, [&](double x) { found = found || lost_square(x); });
    });
    return found;
  };
  return std::visit(
      [&]<class A, class B>(const Two<A, B>& shapes) {
        if constexpr (std::same_as<A, Convex>)
          return std::visit(of_convex, shapes.a.shape) || std::visit(of_convex, shapes.b.shape);
        if constexpr (std::same_as<A, Cast>) {
          // d.d, w.d and w.w, and products of two of them.
          const Numbers d = numbers_of(shapes.a.direction);
          const Numbers w = along(f.nearest[0], -1, numbers_of(shapes.a.origin));
          const Real dd = dot(d, d);
          const Real ww = dot(w, w);
          return lost(dd) || lost(ww) || lost(dd * ww) || lost(dd * dd * ww * ww);
        }
        if constexpr (std::same_as<B, Plane>) return of_plane(shapes.b);
        if constexpr (std::same_as<A, Capsule> && std::same_as<B, Capsule>) {
          const Numbers u = AxisInReals(shapes.a).along;
          const Numbers v = AxisInReals(shapes.b).along;
          return lost(dot(u, u) * dot(v, v)) || lost(dot(u, v) * dot(u, v));
        }
        if constexpr (std::same_as<A, Ball> && std::same_as<B, Triangle>) return of_triangle(shapes.b);
        if constexpr (std::same_as<Two<A, B>, RayAndTriangle> || std::same_as<Two<A, B>, TriangleAndLine>) {
          const CrossingInReals crossing(shapes);
          const CrossingInReals::Vector n = (crossing.v[1] - crossing.v[0]).cross(crossing.v[2] - crossing.v[0]);
          return lost(n.squaredNorm()) || lost(n.dot(crossing.direction)) ||
                 lost(n.dot(crossing.start - crossing.v[0])) ||
                 std::any_of(kAxes.begin(), kAxes.end(), [&](std::size_t axis) {
                   const auto i = static_cast<Eigen::Index>(axis);
                   return lost(n[i]) || lost(n[i] * crossing.direction[i]);
                 });
        }
        return false;
      },
      f.query.shapes);
}
/// Whether a square leaves the range of the engine's own format, so that everything computed from it is lost.
bool squares_out_of_range(F f) {
  if (!f.has_numbers()) return false;
  const Real smallest = std::ldexp(Real{1}, format_of(f.scalar).min_exponent);
  const auto lost = [&](Real x) { return x != 0 && (x * x < smallest || x * x >= largest_number(f)); };
  if (products_out_of_range(f)) return true;
  return lost(std::sqrt(f.D)) || lost(f.radii() + f.alarm) || std::any_of(f.delta.begin(), f.delta.end(), lost);
}
bool sums_out_of_range(F f) {
  return !f.has_numbers() && std::any_of(kAxes.begin(), kAxes.end(), [&](std::size_t axis) {
    return std::max(f.max[0][axis], f.max[1][axis]) + f.alarm >= largest_number(f);
  });
}

/// Near decisions are rounded first; only a tolerance that is no larger than roundings may show in them alone.
double weight_of(Real tolerance) { return tolerance < 1e-13L ? kSmallToleranceWeight : kToleranceWeight; }
Cause widened(std::string_view id, std::string_view sentence, Real by) {
  return {
      .id = id, .sentence = sentence, .hit = [by](F f) { return within(f, f.alarm + by); }, .weight = weight_of(by)};
}
Cause narrowed(std::string_view id, std::string_view sentence, Real by) {
  return {.id = id,
          .sentence = sentence,
          .hit = [by](F f) { return f.truth->at_alarm == Side::at ? Said::hit(false) : within(f, f.alarm - by); },
          .weight = weight_of(by)};
}

/// A normal along an axis, where the centres are so near. Engines differ in the axis, so the one that was said counts.
Cause coincident_within(std::string_view id, std::string_view sentence, Real size) {
  return normal(id, sentence, [size](F f) -> Said {
    if (f.distance > size || !f.said_normal || f.depth > 0 || is_decided_by_a_point(f)) return std::nullopt;
    const Numbers& said = *f.said_normal;
    return largest_of(said) == 1 && sum_of(said) == 1 ? said : Numbers{1, 0, 0};
  });
}

/// Inputs and intermediate results are rounded several times: eight roundings are the allowance.
constexpr Real kRoundings = 8;
/// An arithmetic is seldom right to so many bits more than it has.
constexpr int kBitsByChance = 6;
int kept(F f, int bits) { return bits == 0 ? format_of(f.scalar).precision - 1 : bits; }
/// The largest number that a question is computed with.
Real largest_in(F f) {
  Real most = f.radii() + f.alarm + f.contact + std::abs(f.distance);
  for (const auto* vectors : {&f.nearest, &f.min, &f.max})
    for (const Numbers& v : *vectors) most = std::max(most, largest_of(v));
  return most;
}

/// Whether shapes that overlap are parted along the engine's normal as soon as along the best, but for roundings.
bool takes_another_way(F f) { return f.depth > 0 && is_convex(f.query.pair) && f.detour <= loss(f, 0) * f.condition; }
/// Whether faces of two convex shapes lie along each other: roundings take a point out of the polygon that they share.
bool has_many_points(F f) { return is_convex(f.query.pair) && !f.truth->distance()->spread().empty(); }

/// A normal of length 1, as engines make it that divide.
bool is_unit(const std::optional<Numbers>& n) { return n && std::abs(dot(*n, *n) - 1) < 1e-5L; }

/// Numbers rounded to `bits` bits, which are all of the engine's format where it is its `own`. Errors have a size:
/// what roundings to the engine's own format do they explain themselves, and an arithmetic of few bits makes hardly any
/// error that is far smaller.
Cause rounded(std::string_view id, std::string_view sentence, int bits, double weight, bool own = false) {
  const auto serves = [=](F f) { return own ? bits == kept(f, 0) : bits < kept(f, 0); };
  const auto least = [=](Real scale, Real own_format) {
    return own ? Real{0} : std::max(own_format, std::ldexp(scale, -bits - 1 - kBitsByChance));
  };
  const auto moved = [](F f, std::size_t shape, int of_bits) {
    return loss(f, of_bits) * f.condition + f.radius[shape] * turned(f, of_bits);
  };
  return {.id = id,
          .sentence = sentence,
          .hit = [=](F f) { return where(serves(f) && from_edge(f) <= apart(f, bits), Said::anything()); },
          .normal = [=](F f) -> Said {
            if (!serves(f)) return std::nullopt;
            if (own && takes_another_way(f)) return Said::anything();
            if (f.has_direction()) return {f.n, turned(f, bits), least(1, turned(f, 0))};
            return where(own && is_unit(f.said_normal), Said::anything());  // a difference that should be 0, and is not
          },
          .point = [=](F f, std::size_t shape) -> Said {
            if (!serves(f) || !f.has_direction()) return std::nullopt;
            if (own && (takes_another_way(f) || has_many_points(f))) return Said::anything();
            return {surface(f, shape), moved(f, shape, bits), least(f.scale[shape], moved(f, shape, 0))};
          },
          .value = [=](F f) -> Said {
            if (!serves(f)) return std::nullopt;
            const Real scale = std::max({std::abs(f.distance), f.radii(), f.contact});
            return {{right_value(f), 0, 0}, apart(f, bits) * f.per_length, least(scale, apart(f, 0) * f.per_length)};
          },
          .weight = weight,
          .arithmetic = own ? Cause::Arithmetic::own : Cause::Arithmetic::coarse};
}

}  // namespace

Real loss(F f, int bits) { return kRoundings * std::ldexp(largest_in(f), -kept(f, bits)); }
Real turned(F f, int bits) {
  // The normal of a triangle does not depend on who crosses it; a way out of a box lies along an axis.
  if (is_decided_by_a_point(f)) return kRoundings * std::ldexp(1 / f.sine, -kept(f, bits));
  return f.D > 0 ? loss(f, bits) * f.condition / std::abs(f.distance) : 0;
}
Real apart(F f, int bits) {
  // Points that stray along axes that are nearly parallel do so by the condition, and the way between them by as much
  // as the sine of the axes' angle is less.
  const bool axes = std::holds_alternative<Capsules>(f.query.shapes);
  return loss(f, bits) * (axes ? std::sqrt(f.condition) : f.condition);
}
Real from_edge(F f) {
  if (is_decided_by_a_point(f)) return f.slack;
  return f.has_distance() ? std::abs(f.distance - (f.radii() + f.alarm)) : std::abs(f.widest_gap() - f.alarm);
}

// Tolerances of the sizes that people choose. The smallest that explains an error is the one to name.
#define CONTACT_TOLERANCE(size)                                                               \
  widened("tolerance-" #size, "an absolute tolerance of " #size " widens the test", size##L), \
      narrowed("tolerance-minus-" #size, "an absolute tolerance of " #size " narrows the test", size##L)

std::vector<Cause> wrong_arithmetic() {
  const auto lost_square = [](F f, std::size_t = 0) { return where(squares_out_of_range(f), Said::anything()); };
  return {
      {.id = "square-range",
       .sentence = "squares overflow or underflow",
       .hit = lost_square,
       .normal = lost_square,
       .point = lost_square,
       .value = lost_square,
       .weight = kOwnFormatWeight,
       .arithmetic = Cause::Arithmetic::own},
      {.id = "sum-range",
       .sentence = "a sum overflows",
       .hit = [](F f) { return where(sums_out_of_range(f), Said::anything()); },
       .weight = kOwnFormatWeight,
       .arithmetic = Cause::Arithmetic::own},
      CONTACT_TOLERANCE(1e-15),
      CONTACT_TOLERANCE(1e-14),
      CONTACT_TOLERANCE(1e-12),
      CONTACT_TOLERANCE(1e-10),
      CONTACT_TOLERANCE(1e-9),
      CONTACT_TOLERANCE(1e-8),
      CONTACT_TOLERANCE(1e-7),
      CONTACT_TOLERANCE(1e-6),
      CONTACT_TOLERANCE(1e-5),
      CONTACT_TOLERANCE(1e-4),
      CONTACT_TOLERANCE(1e-3),
      CONTACT_TOLERANCE(1e-2),
      coincident_within("centres-within-1e-19", "centres within an absolute 1e-19 taken for coincident", 1.09e-19L),
      coincident_within("centres-within-1e-15", "centres within an absolute 1e-15 taken for coincident", 1e-15L),
      coincident_within("centres-within-1e-12", "centres within an absolute 1e-12 taken for coincident", 1e-12L),
      coincident_within("centres-within-1e-9", "centres within an absolute 1e-9 taken for coincident", 1e-9L),
      coincident_within("centres-within-1e-6", "centres within an absolute 1e-6 taken for coincident", 1e-6L),
      coincident_within("centres-within-1e-3", "centres within an absolute 1e-3 taken for coincident", 1e-3L),
      rounded("rounding", "intermediate results rounded: wrong in the last bits", 52, kOwnFormatWeight, true),
      rounded("rounding-single", "computes in single precision: wrong in its last bits", 23, kOwnFormatWeight, true),
      rounded("single-precision", "computes in single precision", 23, 0.5),
      rounded("five-digits", "right to about five digits only", 18, 0.4),
      rounded("four-digits", "right to about four digits only, as an estimate of a reciprocal square root is", 15,
              0.35),
      rounded("three-digits", "right to about three digits only", 11, 0.3),
  };
}
#undef CONTACT_TOLERANCE

}  // namespace contact::oracle::formulas
