// Causes that take a wrong feature of a shape for the nearest one: boxes and capsules.
#include "oracle/diagnosis/formulas.hpp"

namespace contact::oracle::formulas {
namespace {

Real clamped(Real t) { return std::clamp(t, Real{0}, Real{1}); }

/// The axes of a pair with a capsule, w from the first to the second, and the products of u, v and w.
struct Axes {
  AxisInReals first;
  AxisInReals second;
  bool both;  ///< capsules
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
};

std::optional<Axes> axes_of(F f) {
  if (const auto* shapes = std::get_if<BallAndCapsule>(&f.query->shapes))
    return Axes(AxisInReals(shapes->a), AxisInReals(shapes->b), false);
  if (const auto* shapes = std::get_if<Capsules>(&f.query->shapes))
    return Axes(AxisInReals(shapes->a), AxisInReals(shapes->b), true);
  return std::nullopt;
}

using Parameters = std::optional<std::array<Real, 2>>;

/// Other parameters on the axes; nothing leaves them as they are.
Cause on_axes(std::string_view id, std::string_view sentence, Parameters (*parameters)(const Axes&)) {
  return {.id = id, .sentence = sentence, .edit = [parameters](Facts& f) {
            const auto axes = axes_of(f);
            if (!axes) return;
            if (const auto at = parameters(*axes)) {
              f.center = {axes->first.at((*at)[0]), axes->second.at((*at)[1])};
              f.settle();
            }
          }};
}

/// Other axes: `change` makes them of the right ones.
Cause with_axes(std::string_view id, std::string_view sentence, void (*change)(AxisInReals&)) {
  return {.id = id, .sentence = sentence, .edit = [change](Facts& f) {
            auto axes = axes_of(f);
            if (!axes) return;
            change(axes->first);
            change(axes->second);
            const auto [s, t] = nearest_parameters(axes->first, axes->second);
            f.center = {axes->first.at(s), axes->second.at(t)};
            f.settle();
          }};
}

/// Another point of the box, or of a box that `change` has made of it, in place of the nearest.
Cause in_box(std::string_view id, std::string_view sentence,
             void (*change)(Facts&, const Numbers& c, Numbers& min, Numbers& max)) {
  return {.id = id, .sentence = sentence, .edit = [change](Facts& f) {
            const auto* shapes = std::get_if<BallAndBox>(&f.query->shapes);
            if (shapes == nullptr) return;
            Numbers min = numbers_of(shapes->b.min);
            Numbers max = numbers_of(shapes->b.max);
            change(f, f.center[0], min, max);
            f.settle();
          }};
}
Numbers nearest_in(const Numbers& c, const Numbers& min, const Numbers& max) {
  Numbers q = c;
  for (const std::size_t i : kAxes) q[i] = std::max(min[i], std::min(c[i], max[i]));
  return q;
}
Real half_of(const Numbers& min, const Numbers& max, std::size_t i) { return (max[i] - min[i]) / 2; }
/// A box `factor` times as large around its middle, without a depth.
void resize(Facts& f, const Numbers& c, Numbers& min, Numbers& max, Real factor) {
  for (const std::size_t i : kAxes) {
    const Real middle = (min[i] + max[i]) / 2;
    const Real half = factor * half_of(min, max, i);
    min[i] = middle - half;
    max[i] = middle + half;
  }
  f.center[1] = nearest_in(c, min, max);
  if (f.center[1] != c) f.depth = 0;
}

/// A way out of a box: along an axis, to the lower or the upper bound.
struct Way {
  Numbers normal{};
  Real depth = 0;
};
std::optional<std::array<Way, 6>> ways_out(F f) {
  const auto* shapes = std::get_if<BallAndBox>(&f.query->shapes);
  if (shapes == nullptr || f.depth == 0) return std::nullopt;
  std::array<Way, 6> ways;
  for (const std::size_t i : kAxes) {
    const auto axis = static_cast<Eigen::Index>(i);
    ways[2 * i].normal[i] = 1;
    ways[2 * i].depth = f.center[0][i] - shapes->b.min[axis];
    ways[2 * i + 1].normal[i] = -1;
    ways[2 * i + 1].depth = shapes->b.max[axis] - f.center[0][i];
  }
  return ways;
}
/// Where the centre is inside: out by another way.
Cause out_by(std::string_view id, std::string_view sentence, Way (*choose)(const std::array<Way, 6>&)) {
  const auto chosen = [choose](F f) -> std::optional<Way> {
    const auto ways = ways_out(f);
    return ways ? std::optional(choose(*ways)) : std::nullopt;
  };
  return {.id = id,
          .sentence = sentence,
          .normal =
              [chosen](F f) {
                const auto way = chosen(f);
                return way ? Said(way->normal) : Said(std::nullopt);
              },
          .point =
              [chosen](F f, std::size_t shape) {
                const auto way = chosen(f);
                if (!way) return Said(std::nullopt);
                return Said(along(f.center[0], shape == 0 ? f.radius[0] : -way->depth, way->normal));
              },
          .value =
              [chosen](F f) {
                const auto way = chosen(f);
                return way ? Said(-f.radius[0] - way->depth - f.contact) : Said(std::nullopt);
              }};
}
Way least(const std::array<Way, 6>& ways) {
  return *std::min_element(ways.begin(), ways.end(), [](const Way& x, const Way& y) { return x.depth < y.depth; });
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

/// Segments whose determinant is below a limit are taken for parallel: s = 0.
Parameters parallel_below(const Axes& x, Real limit) {
  if (!x.both || !(x.A > 0 && x.E > 0) || x.determinant >= limit || x.determinant <= 0) return std::nullopt;
  const Real t = clamped(x.foot_of_first(0));
  return {{clamped(x.foot_of_second(t)), t}};
}

}  // namespace

std::vector<Cause> wrong_features() {
  return {
      on_axes("capsule-as-line", "capsules taken for infinite cylinders: the foot is not clamped to the axis",
              [](const Axes& x) -> Parameters {
                if (!x.both) return x.E > 0 ? Parameters({{0, x.foot_of_first(0)}}) : std::nullopt;
                return x.A > 0 && x.E > 0 && x.determinant > 0 ? Parameters(x.free()) : std::nullopt;
              }),
      on_axes("capsule-by-start", "a capsule taken for a sphere at the start of its axis",
              [](const Axes&) -> Parameters {
                return {{0, 0}};
              }),
      on_axes("capsule-by-middle", "a capsule taken for a sphere in the middle of its axis",
              [](const Axes& x) -> Parameters {
                return {{x.both ? Real{0.5} : Real{0}, 0.5}};
              }),
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
      with_axes("half-length-for-length", "half of the length taken for the length: the axis is too short",
                [](AxisInReals& x) {
                  x.from = x.at(0.25L);
                  x.along = times(0.5L, x.along);
                }),
      with_axes("length-for-half-length", "the length taken for its half: the axis is too long",
                [](AxisInReals& x) {
                  x.from = x.at(-0.5L);
                  x.along = times(2, x.along);
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

      in_box("box-nearest-corner", "the nearest corner of a box taken for its nearest point",
             [](Facts& f, const Numbers& c, Numbers& min, Numbers& max) {
               for (const std::size_t i : kAxes) f.center[1][i] = c[i] < (min[i] + max[i]) / 2 ? min[i] : max[i];
               f.depth = 0;
             }),
      in_box("box-middle", "the middle of a box taken for its nearest point",
             [](Facts& f, const Numbers&, Numbers& min, Numbers& max) {
               for (const std::size_t i : kAxes) f.center[1][i] = (min[i] + max[i]) / 2;
               f.depth = 0;
             }),
      in_box("box-lower-bound-ignored", "a centre clamped to the upper bounds of a box only",
             [](Facts& f, const Numbers& c, Numbers&, Numbers& max) {
               for (const std::size_t i : kAxes) f.center[1][i] = std::min(c[i], max[i]);
             }),
      in_box("box-upper-bound-ignored", "a centre clamped to the lower bounds of a box only",
             [](Facts& f, const Numbers& c, Numbers& min, Numbers&) {
               for (const std::size_t i : kAxes) f.center[1][i] = std::max(c[i], min[i]);
             }),
      in_box("box-half-for-size", "half of the size taken for the size: the box is too small",
             [](Facts& f, const Numbers& c, Numbers& min, Numbers& max) { resize(f, c, min, max, 0.5L); }),
      in_box("box-size-for-half", "the size taken for its half: the box is too large",
             [](Facts& f, const Numbers& c, Numbers& min, Numbers& max) {
               resize(f, c, min, max, 2);
               if (f.center[1] != c || f.depth > 0) return;
               f.depth = kInfinity;
               for (const std::size_t i : kAxes) f.depth = std::min({f.depth, c[i] - min[i], max[i] - c[i]});
             }),
      in_box("box-as-sphere", "a box taken for the sphere around it",
             [](Facts& f, const Numbers&, Numbers& min, Numbers& max) {
               Real half2 = 0;
               for (const std::size_t i : kAxes) {
                 f.center[1][i] = (min[i] + max[i]) / 2;
                 half2 += half_of(min, max, i) * half_of(min, max, i);
               }
               f.radius[1] = std::sqrt(half2);
               f.depth = 0;
             }),
      {.id = "box-corners-not-rounded",
       .sentence = "a box blown up by the reach tested, and its corners and edges not rounded",
       .hit =
           [](F f) {
             if (!std::holds_alternative<BallAndBox>(f.query->shapes)) return Said(std::nullopt);
             return Said::at_most(largest_of(f.delta), f.radii() + f.alarm);
           }},
      {.id = "box-inside-missed",
       .sentence = "a centre in a box not counted as a hit",
       .hit =
           [](F f) {
             return where(std::holds_alternative<BallAndBox>(f.query->shapes),
                          Said::hit(f.truth->hit() && f.depth == 0));
           }},
      {.id = "box-depth-ignored",
       .sentence = "the depth of a centre in a box left out of the value",
       .value = [](F f) { return where(f.depth > 0, Said(right_value(f) + f.depth)); }},
      {.id = "box-depth-added",
       .sentence = "the depth of a centre in a box added to the value, where it should be subtracted",
       .value = [](F f) { return where(f.depth > 0, Said(right_value(f) + 2 * f.depth)); }},
      {.id = "box-point-inside",
       .sentence = "the contact point of a box left at a centre inside it",
       .point = [](F f, std::size_t shape) { return where(f.depth > 0 && shape == 1, Said(f.center[0])); }},
      out_by("box-farthest-face", "a centre in a box leaves through the farthest face",
             [](const std::array<Way, 6>& ways) {
               return *std::max_element(ways.begin(), ways.end(),
                                        [](const Way& x, const Way& y) { return x.depth < y.depth; });
             }),
      out_by("box-first-axis", "a centre in a box leaves along the x axis, whatever is nearer",
             [](const std::array<Way, 6>& ways) { return ways[0].depth <= ways[1].depth ? ways[0] : ways[1]; }),
      out_by("box-upper-faces-only", "a centre in a box leaves through an upper face, whatever is nearer",
             [](const std::array<Way, 6>& ways) {
               return least({ways[1], ways[1], ways[3], ways[3], ways[5], ways[5]});
             }),
      {.id = "box-normal-outward",
       .sentence = "the normal of a centre in a box points out of it",
       .normal =
           [](F f) {
             const auto ways = ways_out(f);
             return ways ? Said(times(-1, least(*ways).normal)) : Said(std::nullopt);
           }},
  };
}

}  // namespace contact::oracle::formulas
