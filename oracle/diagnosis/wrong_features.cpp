// Causes that take a wrong point of an axis for the nearest one: capsules, beside planes too, and rays.
#include "oracle/diagnosis/formulas.hpp"

namespace contact::oracle::formulas {
namespace {

Real clamped(Real t) { return std::clamp(t, Real{0}, Real{1}); }

/// The axes of a pair with a capsule or a ray, a sphere's centre before it; w from the first to the second, and the
/// products of u, v and w.
struct Axes {
  AxisInReals first;
  AxisInReals second;
  bool both;            ///< capsules
  bool turned = false;  ///< of a ray, which is the first shape
  Real direction = 1;   ///< its length
  Real A, B, E, C, F;
  Real determinant;  ///< A E - B^2, without its cancellation

  Axes(const AxisInReals& a, const AxisInReals& b, bool are_both) : first(a), second(b), both(are_both) {
    const Numbers w = formulas::along(b.from, -1, a.from);
    A = dot(a.along, a.along);
    B = dot(a.along, b.along);
    E = dot(b.along, b.along);
    C = dot(a.along, w);
    F = dot(b.along, w);
    const Numbers& u = a.along;
    const Numbers& v = b.along;
    const Numbers n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    determinant = dot(n, n);
  }
  /// The parameters on the lines, where these are neither points nor parallel.
  [[nodiscard]] std::array<Real, 2> free() const {
    return {(C * E - B * F) / determinant, (B * C - A * F) / determinant};
  }
  [[nodiscard]] Real foot_of_first(Real s) const { return (B * s - F) / E; }
  [[nodiscard]] Real foot_of_second(Real t) const { return (B * t + C) / A; }
  void take(Facts& f, Real s, Real t) const {
    std::array points{first.at(s), second.at(t)};
    if (turned) std::swap(points[0], points[1]);
    if (is_same_point(points[0], f.nearest[0]) && is_same_point(points[1], f.nearest[1])) return;
    f.nearest = points;
    f.settle();
  }
};

std::optional<Axes> axes_of(F f) {
  if (const auto* shapes = std::get_if<BallAndCapsule>(&f.query.shapes))
    return Axes(AxisInReals(shapes->a), AxisInReals(shapes->b), false);
  if (const auto* shapes = std::get_if<Capsules>(&f.query.shapes))
    return Axes(AxisInReals(shapes->a), AxisInReals(shapes->b), true);
  if (const auto* shapes = std::get_if<RayAndBall>(&f.query.shapes)) {
    Axes axes(AxisInReals(shapes->b), AxisInReals(shapes->a), false);
    axes.turned = true;
    const Numbers direction = numbers_of(shapes->a.direction);
    axes.direction = std::sqrt(dot(direction, direction));
    return axes;
  }
  return std::nullopt;
}

using Parameters = std::optional<std::array<Real, 2>>;

/// Another point of a capsule over a plane: its axis, and the parameter of the lowest point.
void take_over_plane(Facts& f, const CapsuleAndPlane& shapes, const AxisInReals& axis, Real t) {
  f.nearest[0] = axis.at(t);
  f.nearest[1] = PlaneInReals(shapes.b).foot(f.nearest[0]);
  f.settle();
}

/// Other parameters on the axes; nothing leaves them as they are. `over_plane` is that of a capsule over a plane.
Cause on_axes(std::string_view id, std::string_view sentence, Parameters (*parameters)(const Axes&),
              std::optional<Real> over_plane = {}) {
  return {.id = id, .sentence = sentence, .edit = [parameters, over_plane](Facts& f) {
            const auto* shapes = std::get_if<CapsuleAndPlane>(&f.query.shapes);
            if (shapes != nullptr && over_plane) take_over_plane(f, *shapes, AxisInReals(shapes->a), *over_plane);
            const auto axes = axes_of(f);
            if (!axes) return;
            if (const auto at = parameters(*axes)) axes->take(f, (*at)[0], (*at)[1]);
          }};
}

/// Other axes: `change` makes them of the right ones and their radii. A ray's is one only of what concerns all axes.
Cause with_axes(std::string_view id, std::string_view sentence, void (*change)(AxisInReals&, Real radius),
                bool of_rays = false) {
  return {.id = id, .sentence = sentence, .edit = [change, of_rays](Facts& f) {
            if (const auto* shapes = std::get_if<CapsuleAndPlane>(&f.query.shapes)) {
              AxisInReals axis(shapes->a);
              change(axis, f.radius[0]);
              take_over_plane(f, *shapes, axis, lowest_parameter(axis, PlaneInReals(shapes->b)));
            }
            auto axes = axes_of(f);
            if (!axes || (axes->turned && !of_rays)) return;
            if (axes->both) change(axes->first, f.radius[0]);
            change(axes->second, f.radius[1]);
            const auto [s, t] = nearest_parameters(axes->first, axes->second);
            axes->take(f, s, t);
          }};
}
/// An axis that is longer by `by` at each end; one that would be shorter than nothing is its middle.
void lengthen(AxisInReals& x, Real by) {
  const Real length = std::sqrt(dot(x.along, x.along));
  if (!(length > 0)) return;
  const Real part = std::max(by / length, Real{-0.5});
  x.from = x.at(-part);
  x.along = times(1 + 2 * part, x.along);
}

/// The nearest points of two segments as Ericson finds them, from products with the difference of their starts: `c` of
/// the first direction, `f` of the second. What is wrong about the products is wrong about the points, as is a wrong
/// sign of theirs where the parameters begin.
Parameters by_products(const Axes& x, Real c, Real f, Real sign_in_s = 1, Real sign_in_t = 1) {
  if (!x.both || !(x.A > 0 && x.E > 0)) return std::nullopt;
  Real s = x.determinant > 0 ? clamped((x.B * f - sign_in_s * c * x.E) / x.determinant) : 0;
  const Real t = (x.B * s + sign_in_t * f) / x.E;
  if (t < 0) s = clamped(-c / x.A);
  if (t > 1) s = clamped((x.B - c) / x.A);
  return {{s, clamped(t)}};
}
/// The nearest points of two segments as Brax, MJX, Newton and MuJoCo Warp find them: of the lines, from the middles
/// of the segments, and then of one on the other. Each division has 1e-6 in its denominator.
void with_a_millionth(Facts& f) {
  constexpr Real kMillionth = 1e-6L;
  const auto axes = axes_of(f);
  if (!axes || !axes->both) return;
  const Axes& x = *axes;
  const Real lengths[2] = {std::sqrt(x.A), std::sqrt(x.E)};
  const Numbers u = x.A > 0 ? times(1 / lengths[0], x.first.along) : Numbers{};
  const Numbers v = x.E > 0 ? times(1 / lengths[1], x.second.along) : Numbers{};
  const Numbers w = along(x.first.at(0.5L), -1, x.second.at(0.5L));
  const Real uv = dot(u, v);
  const Real sine2 = x.A > 0 && x.E > 0 ? x.determinant / (x.A * x.E) : 1;
  const Real s = (uv * dot(v, w) - dot(u, w)) / (sine2 + kMillionth);
  const auto on = [](Real part, Real length) { return length > 0 ? clamped(part / length + 0.5L) : Real{0}; };
  const Numbers on_first = x.first.at(on(s, lengths[0]));
  const Numbers on_second = x.second.at(on(dot(v, w) + s * uv, lengths[1]));
  const auto foot = [](const AxisInReals& axis, const Numbers& point) {
    return axis.at(clamped(dot(along(point, -1, axis.from), axis.along) / (dot(axis.along, axis.along) + kMillionth)));
  };
  using Points = std::array<Numbers, 2>;
  const std::array ways{Points{foot(x.first, on_second), on_second}, Points{on_first, foot(x.second, on_first)}};
  std::array<Real, 2> apart{};
  std::array<Real, 2> turned{};
  for (std::size_t i = 0; i < 2; ++i) {
    const Numbers d = along(ways[i][1], -1, ways[i][0]);
    apart[i] = dot(d, d);
    const Numbers from_said = along(times(1 / std::sqrt(apart[i]), d), -1, f.said_normal.value_or(Numbers{}));
    turned[i] = dot(from_said, from_said);
  }
  // Both are as far, but for roundings, where no end is nearest: then an engine takes the one that its normal is of.
  constexpr Real kAlike = 1e-5L;
  const bool alike = f.said_normal && std::abs(apart[0] - apart[1]) <= kAlike * std::max(apart[0], apart[1]);
  f.nearest = ways[(alike ? turned[0] < turned[1] : apart[0] < apart[1]) ? 0 : 1];
  f.settle();
}

/// The distance of a sphere from a capsule by Pythagoras with a clamped t, squared.
std::optional<Real> by_pythagoras(F f) {
  const auto axes = axes_of(f);
  if (!axes || axes->both || !(axes->E > 0)) return std::nullopt;
  const Numbers w = along(axes->first.from, -1, axes->second.from);
  const Real length = std::sqrt(axes->E);
  const Real t = std::clamp(dot(w, axes->second.along) / length, Real{0}, length);
  return std::max(Real{0}, dot(w, w) - t * t);
}

bool are_parallel(F f) {
  const auto axes = axes_of(f);
  return axes && axes->both && axes->determinant == 0;
}

/// Segments whose determinant is below a limit are taken for parallel: s = 0.
Parameters parallel_below(const Axes& x, Real limit) {
  if (!x.both || !(x.A > 0 && x.E > 0) || x.determinant >= limit || x.determinant <= 0) return std::nullopt;
  const Real t = clamped(x.foot_of_first(0));
  return {{clamped(x.foot_of_second(t)), t}};
}

}  // namespace

std::vector<Cause> wrong_features() {
  return {
      edit("segments-plus-1e-6",
           "1e-6 added to both denominators of the nearest points of segments, 1 - (u.v)^2 and |u|^2",
           with_a_millionth),
      on_axes("segments-offset-reversed", "the difference of the segments' starts with the other sign in every product",
              [](const Axes& x) { return by_products(x, x.C, x.F); }),
      on_axes("segments-first-term-sign", "one sign wrong in the first parameter of two segments: b f + c e",
              [](const Axes& x) { return by_products(x, -x.C, -x.F, -1, 1); }),
      on_axes("segments-second-term-sign", "one sign wrong in the second parameter of two segments: b s - f",
              [](const Axes& x) { return by_products(x, -x.C, -x.F, 1, -1); }),
      on_axes("segments-offset-of-first", "the start of the first segment taken for the difference of both",
              [](const Axes& x) {
                return by_products(x, dot(x.first.along, x.first.from), dot(x.second.along, x.first.from));
              }),
      on_axes("segments-offset-of-second", "the start of the second segment taken for the difference of both",
              [](const Axes& x) {
                return by_products(x, -dot(x.first.along, x.second.from), -dot(x.second.along, x.second.from));
              }),
      with_axes("capsule-caps-in-length", "the caps of a capsule counted in its length: the axis is too short",
                [](AxisInReals& x, Real radius) { lengthen(x, -radius); }),
      with_axes("capsule-caps-added", "the caps of a capsule added to its length: the axis is too long",
                [](AxisInReals& x, Real radius) { lengthen(x, radius); }),
      with_axes("capsule-from-middle", "a capsule begins in its middle, and is not centred there",
                [](AxisInReals& x, Real) { x.from = x.at(0.5L); }),
      with_axes("capsule-around-start", "a capsule centred on the start of its axis",
                [](AxisInReals& x, Real) { x.from = x.at(-0.5L); }),
      {.id = "ray-from-inside-missed",
       .sentence = "a ray that starts inside the sphere never hits it",
       .hit =
           [](F f) {
             const auto* shapes = std::get_if<RayAndBall>(&f.query.shapes);
             if (shapes == nullptr) return right_decision(f);
             const Numbers w = along(numbers_of(shapes->b.center), -1, numbers_of(shapes->a.origin));
             return missed_where(dot(w, w) <= f.radius[1] * f.radius[1], f);
           }},
      {.id = "parallel-not-finite",
       .sentence = "NaN or infinite numbers where segments are parallel, or a point",
       .normal = [](F f) { return where(are_parallel(f), kNotFinite); },
       .point = [](F f, std::size_t) { return where(are_parallel(f), kNotFinite); },
       .value = [](F f) { return where(are_parallel(f), Said(kNaN)); }},
      on_axes("capsule-as-line", "capsules taken for infinite cylinders: the foot is not clamped to the axis",
              [](const Axes& x) -> Parameters {
                if (!x.both) return x.E > 0 ? Parameters({{0, x.foot_of_first(0)}}) : std::nullopt;
                return x.A > 0 && x.E > 0 && x.determinant > 0 ? Parameters(x.free()) : std::nullopt;
              }),
      on_axes(
          "capsule-by-start", "a capsule taken for a sphere at the start of its axis",
          [](const Axes&) -> Parameters {
            return {{0, 0}};
          },
          0),
      on_axes(
          "capsule-by-middle", "a capsule taken for a sphere in the middle of its axis",
          [](const Axes& x) -> Parameters {
            return {{x.both ? Real{0.5} : Real{0}, 0.5}};
          },
          0.5L),
      on_axes("capsule-by-ends", "only the ends of an axis tried, and no point between them",
              [](const Axes& x) -> Parameters {
                std::array<Real, 2> best{};
                Real least = kInfinity;
                for (const Real s : {0, 1})
                  for (const Real t : {0, 1}) {
                    const Numbers d = along(x.second.at(t), -1, x.first.at(s));
                    if (dot(d, d) < least) least = dot(d, d), best = {s, t};
                  }
                return best;
              }),
      on_axes("parameter-divided-by-length-plus-1e-6",
              "1e-6 added to the squared length that the parameter is divided by",
              [](const Axes& x) -> Parameters {
                return x.both ? std::nullopt : Parameters({{0, clamped(-x.F / (x.E + 1e-6L))}});
              }),
      on_axes("parameters-clamped-alone", "both parameters clamped, and neither computed again from the other",
              [](const Axes& x) -> Parameters {
                if (!x.both || !(x.A > 0 && x.E > 0 && x.determinant > 0)) return std::nullopt;
                const auto [s, t] = x.free();
                return {{clamped(s), clamped(t)}};
              }),
      on_axes("second-clamp-missing", "the first parameter not computed again where the second is clamped",
              [](const Axes& x) -> Parameters {
                if (!x.both || !(x.A > 0 && x.E > 0 && x.determinant > 0)) return std::nullopt;
                const Real s = clamped(x.free()[0]);
                return {{s, clamped(x.foot_of_first(s))}};
              }),
      on_axes("ends-against-axes-only", "only ends and their feet tried, and not the feet of both axes on each other",
              [](const Axes& x) -> Parameters {
                if (!x.both || !(x.A > 0 && x.E > 0)) return std::nullopt;
                std::array<Real, 2> best{};
                Real least_of_all = kInfinity;
                const auto attempt = [&](Real s, Real t) {
                  const Numbers d = along(x.second.at(t), -1, x.first.at(s));
                  if (dot(d, d) < least_of_all) least_of_all = dot(d, d), best = {s, t};
                };
                for (const Real end : {0, 1}) attempt(end, clamped(x.foot_of_first(end)));
                for (const Real end : {0, 1}) attempt(clamped(x.foot_of_second(end)), end);
                return best;
              }),
      on_axes("direction-not-divided", "the projection on the axis not divided by the axis's squared length",
              [](const Axes& x) -> Parameters {
                return x.both ? std::nullopt : Parameters({{0, clamped(-x.F)}});
              }),
      on_axes("parallel-within-1e-15", "axes with a determinant below 1e-15 taken for parallel, whatever the units",
              [](const Axes& x) { return parallel_below(x, 1e-15L); }),
      on_axes("parallel-within-1e-6", "axes with a determinant below 1e-6 taken for parallel, whatever the units",
              [](const Axes& x) { return parallel_below(x, 1e-6L); }),
      with_axes(
          "half-length-for-length", "half of the length taken for the length: the axis is too short",
          [](AxisInReals& x, Real) {
            x.from = x.at(0.25L);
            x.along = times(0.5L, x.along);
          },
          true),
      with_axes(
          "length-for-half-length", "the length taken for its half: the axis is too long",
          [](AxisInReals& x, Real) {
            x.from = x.at(-0.5L);
            x.along = times(2, x.along);
          },
          true),
      on_axes("ray-without-end", "a ray taken for one without end",
              [](const Axes& x) -> Parameters {
                return x.turned && x.E > 0 ? Parameters({{0, std::max(Real{0}, x.foot_of_first(0))}}) : std::nullopt;
              }),
      on_axes("ray-direction-normalised", "the length of a ray counted in its unit, and not in directions",
              [](const Axes& x) -> Parameters {
                if (!x.turned || !(x.E > 0)) return std::nullopt;
                return {{0, std::clamp(x.foot_of_first(0), Real{0}, 1 / x.direction)}};
              }),
      on_axes("ray-direction-unit", "the direction of a ray taken for a unit vector",
              [](const Axes& x) -> Parameters {
                if (!x.turned || !(x.E > 0)) return std::nullopt;
                return {{0, clamped(x.foot_of_first(0) * x.direction * x.direction)}};
              }),
      {.id = "distance-by-clamped-pythagoras",
       .sentence = "squared distance taken for |w|^2 - t^2 with a clamped t: no distance past an end",
       .hit =
           [](F f) {
             const auto D = by_pythagoras(f);
             return D ? Said::at_most(std::sqrt(*D), f.radii() + f.alarm) : Said(std::nullopt);
           },
       .value =
           [](F f) {
             const auto D = by_pythagoras(f);
             return D ? Said(std::sqrt(*D) - f.radii() - f.contact) : Said(std::nullopt);
           }},
  };
}

}  // namespace contact::oracle::formulas
