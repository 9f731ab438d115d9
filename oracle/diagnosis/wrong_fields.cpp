// Causes that give a wrong number of the contact: normals, points, values.
#include "oracle/diagnosis/formulas.hpp"

namespace contact::oracle::formulas {
namespace {

Numbers with(Numbers v, std::size_t axis, Real x) {
  v[axis] = x;
  return v;
}
std::function<Said(F)> always(const Numbers& said) {
  return [said](F) { return said; };
}
/// The components of the normal in another order.
std::function<Said(F)> reordered(std::size_t x, std::size_t y, std::size_t z) {
  return [=](F f) { return Numbers{f.n[x], f.n[y], f.n[z]}; };
}
/// A normal whose length is so many ulps from 1 has unit length.
constexpr Real kUnitUlps = 64;
/// The surface point, `by` outside its sphere.
Numbers lifted(F f, std::size_t sphere, Real by) {
  return along(f.nearest[sphere], side(sphere) * (f.radius[sphere] + by), f.n);
}

}  // namespace

std::vector<Cause> wrong_normals() {
  return {
      {.id = "normal-not-finite", .sentence = "normal is NaN or infinite", .normal = always(kNotFinite)},
      {.id = "normal-zero", .sentence = "normal is zero", .normal = always({})},
      normal("normal-not-unit", "normal is the difference of the centres, not divided by its length",
             [](F f) { return f.delta; }),
      normal("normal-over-square", "normal divided by the squared distance",
             [](F f) { return times(1 / f.D, f.delta); }),
      normal("normal-over-radii", "normal divided by the radius sum, not by the distance",
             [](F f) { return times(1 / f.radii(), f.delta); }),
      normal("normal-over-reach", "normal divided by the reach, not by the distance",
             [](F f) { return times(1 / (f.radii() + f.alarm), f.delta); }),
      normal("normal-over-coordinate-sum", "normal divided by the sum of its components",
             [](F f) { return times(1 / sum_of(f.n), f.n); }),
      normal("normal-over-largest", "normal divided by its largest component",
             [](F f) { return times(1 / largest_of(f.n), f.n); }),
      normal("normal-plus-1e-6", "normal divided by the distance plus 1e-6",
             [](F f) { return times(1 / (std::sqrt(f.D) + 1e-6L), f.delta); }),
      normal("normal-square-plus-1e-12", "normal divided by the root of the squared distance plus 1e-12",
             [](F f) { return times(1 / std::sqrt(f.D + 1e-12L), f.delta); }),
      normal("normal-x-negated", "x of the normal negated", [](F f) { return with(f.n, kX, -f.n[kX]); }),
      normal("normal-y-negated", "y of the normal negated", [](F f) { return with(f.n, kY, -f.n[kY]); }),
      normal("normal-z-negated", "z of the normal negated", [](F f) { return with(f.n, kZ, -f.n[kZ]); }),
      normal("normal-x-zero", "x of the normal missing", [](F f) { return with(f.n, kX, 0); }),
      normal("normal-y-zero", "y of the normal missing", [](F f) { return with(f.n, kY, 0); }),
      normal("normal-z-zero", "z of the normal missing", [](F f) { return with(f.n, kZ, 0); }),
      normal("normal-unsigned", "components of the normal without their signs",
             [](F f) {
               return Numbers{std::abs(f.n[0]), std::abs(f.n[1]), std::abs(f.n[2])};
             }),
      normal("normal-xy-exchanged", "x and y of the normal exchanged", reordered(1, 0, 2)),
      normal("normal-yz-exchanged", "y and z of the normal exchanged", reordered(0, 2, 1)),
      normal("normal-xz-exchanged", "x and z of the normal exchanged", reordered(2, 1, 0)),
      normal("normal-rotated", "components of the normal moved on by one axis", reordered(2, 0, 1)),
      normal("normal-snapped", "normal turned to the nearest axis",
             [](F f) {
               std::size_t most = 0;
               for (const std::size_t axis : kAxes)
                 if (std::abs(f.n[axis]) > std::abs(f.n[most])) most = axis;
               return with({}, most, f.n[most] < 0 ? -1 : 1);
             }),
      normal("normal-always-x", "normal always (1, 0, 0)", always({1, 0, 0})),
      normal("normal-always-y", "normal always (0, 1, 0)", always({0, 1, 0})),
      normal("normal-always-minus-y", "normal always (0, -1, 0)", always({0, -1, 0})),
      normal("normal-always-z", "normal always (0, 0, 1)", always({0, 0, 1})),
      normal("normal-to-positive-x", "normal turned so that its x is positive, whichever sphere comes first",
             [](F f) { return f.n[kX] < 0 ? times(-1, f.n) : f.n; }),
      normal("normal-from-smaller", "normal points from the smaller sphere to the larger, whichever comes first",
             [](F f) { return where(f.has_distance(), f.radius[0] > f.radius[1] ? times(-1, f.n) : f.n); }),
      {.id = "normal-wrong-length",
       .sentence = "normal has the right direction and not unit length",
       .normal = [](F f) -> Said {
         if (!f.said_normal) return std::nullopt;
         const Real length = std::sqrt(dot(*f.said_normal, *f.said_normal));
         if (!(length > 0 && std::isfinite(length))) return std::nullopt;
         if (std::abs(length - 1) <= std::ldexp(kUnitUlps, -format_of(f.scalar).precision)) return std::nullopt;
         return f.region == Region::coincident ? *f.said_normal : times(length, f.n);
       },
       .weight = 0.85},  // whatever the length is
  };
}

std::vector<Cause> wrong_points() {
  return {
      points("points-far-side", "contact point on the far side of its sphere",
             [](F f, std::size_t s) { return along(f.nearest[s], -side(s) * f.radius[s], f.n); }),
      points("points-at-centre", "contact point at the centre of its sphere",
             [](F f, std::size_t s) { return f.nearest[s]; }),
      points("points-exchanged", "contact point of one sphere given for the other",
             [](F f, std::size_t s) { return surface(f, other(s)); }),
      points("points-middle", "one contact point for both spheres, half way between the surfaces",
             [](F f, std::size_t) { return times(0.5L, along(surface(f, 0), 1, surface(f, 1))); }),
      points("points-centre-middle", "contact point half way between the centres, radii ignored",
             [](F f, std::size_t) { return along(f.nearest[0], 0.5L, f.delta); }),
      points("points-behind", "contact point half a centre distance behind the first sphere",
             [](F f, std::size_t) { return along(f.nearest[0], -0.5L, f.delta); }),
      points("points-weighted", "contact point between the centres in the ratio of the radii, on neither surface",
             [](F f, std::size_t) { return along(f.nearest[0], f.radius[0] / f.radii(), f.delta); }),
      points("points-not-unit", "contact point uses a normal that is not divided by its length",
             [](F f, std::size_t s) { return along(f.nearest[s], side(s) * f.radius[s], f.delta); }),
      points("points-from-other-centre", "contact point starts from the centre of the other sphere",
             [](F f, std::size_t s) { return along(f.nearest[other(s)], side(s) * f.radius[s], f.n); }),
      points("points-local", "contact point relative to its own centre, not in world coordinates",
             [](F f, std::size_t s) { return times(side(s) * f.radius[s], f.n); }),
      points("points-world-negated", "contact point negated",
             [](F f, std::size_t s) { return times(-1, surface(f, s)); }),
      points("points-past-alarm", "contact point lifted off the surface by the alarm distance",
             [](F f, std::size_t s) { return lifted(f, s, f.alarm); }),
      points("points-past-contact", "contact point lifted off the surface by the contact distance",
             [](F f, std::size_t s) { return lifted(f, s, f.contact); }),
      points("points-below-contact", "contact point sunk below the surface by the contact distance",
             [](F f, std::size_t s) { return lifted(f, s, -f.contact); }),
      points("points-past-half-value", "contact point moved by half the distance of the surfaces",
             [](F f, std::size_t s) { return lifted(f, s, signed_distance(f)); }),
      points("points-x-centre", "x of the contact point is that of the centre",
             [](F f, std::size_t s) { return with(surface(f, s), kX, f.nearest[s][kX]); }),
      points("points-y-centre", "y of the contact point is that of the centre",
             [](F f, std::size_t s) { return with(surface(f, s), kY, f.nearest[s][kY]); }),
      points("points-z-centre", "z of the contact point is that of the centre",
             [](F f, std::size_t s) { return with(surface(f, s), kZ, f.nearest[s][kZ]); }),
      points("points-x-mirrored", "x of the contact point on the far side",
             [](F f, std::size_t s) { return with(surface(f, s), kX, 2 * f.nearest[s][kX] - surface(f, s)[kX]); }),
      points("points-y-mirrored", "y of the contact point on the far side",
             [](F f, std::size_t s) { return with(surface(f, s), kY, 2 * f.nearest[s][kY] - surface(f, s)[kY]); }),
      points("points-z-mirrored", "z of the contact point on the far side",
             [](F f, std::size_t s) { return with(surface(f, s), kZ, 2 * f.nearest[s][kZ] - surface(f, s)[kZ]); }),
      points("points-zero", "contact point is the origin", [](F, std::size_t) { return Numbers{}; }),
      {.id = "points-not-finite",
       .sentence = "contact point is NaN or infinite",
       .point = [](F, std::size_t) { return kNotFinite; }},
  };
}

std::vector<Cause> wrong_values() {
  return {
      value("value-is-distance", "value is the distance of the centres: radii and contact distance left out",
            [](F f) { return f.distance; }),
      value("value-depth", "value has the opposite sign: a depth", [](F f) { return -right_value(f); }),
      value("value-depth-plus-contact", "value is a depth: radius sum less distance, contact distance subtracted",
            [](F f) { return -signed_distance(f) - f.contact; }),
      value("value-depth-without-contact", "value is a depth without the contact distance",
            [](F f) { return -signed_distance(f); }),
      value("value-unsigned", "value without its sign", [](F f) { return std::abs(right_value(f)); }),
      value("value-squared-distance", "squared distance in the value, its root not taken",
            [](F f) { return f.D - f.radii() - f.contact; }),
      value("value-difference-of-squares", "value is a difference of squares",
            [](F f) { return f.D - f.radii() * f.radii() - f.contact; }),
      value("value-squared", "value squared", [](F f) { return right_value(f) * right_value(f); }),
      value("value-less-alarm", "alarm distance subtracted from the value",
            [](F f) { return right_value(f) - f.alarm; }),
      value("value-alarm-for-contact", "alarm distance subtracted from the value in place of the contact distance",
            [](F f) { return signed_distance(f) - f.alarm; }),
      value("value-plus-alarm", "alarm distance added to the value", [](F f) { return right_value(f) + f.alarm; }),
      value("value-radii-added", "radii added to the value, where they should be subtracted",
            [](F f) { return f.distance + f.radii() - f.contact; }),
      value("value-first-radius-added", "radius of the first sphere added to the value, where it should be subtracted",
            [](F f) { return f.distance + f.radius[0] - f.radius[1] - f.contact; }),
      value("value-second-radius-added",
            "radius of the second sphere added to the value, where it should be subtracted",
            [](F f) { return f.distance - f.radius[0] + f.radius[1] - f.contact; }),
      value("value-larger-radius", "only the larger radius subtracted from the value",
            [](F f) { return f.distance - std::max(f.radius[0], f.radius[1]) - f.contact; }),
      {.id = "value-contact-per-sphere",
       .sentence = "contact distance subtracted once for each sphere",
       .value = [](F f) { return right_value(f) - f.contact; },
       .weight = 0.98},  // of those that explain the same the rarer
      value("value-not-negative", "value cut off at zero: no depth",
            [](F f) { return std::max(Real{0}, right_value(f)); }),
      value("value-not-positive", "value cut off at zero: no gap",
            [](F f) { return std::min(Real{0}, right_value(f)); }),
      value("value-zero", "value always 0", [](F) { return Real{0}; }),
      value("value-one", "value always 1", [](F) { return Real{1}; }),
      value("value-minus-one", "value always -1: a sentinel", [](F) { return Real{-1}; }),
      {.id = "value-bool",
       .sentence = "value is a comparison, 0 or 1",
       .value = [](F f) { return Real(signed_distance(f) > 0 ? 1 : 0); },
       .weight = 0.98},
      value("value-plus-one", "1 added to the value", [](F f) { return right_value(f) + 1; }),
      value("value-plus-two", "2 added to the value", [](F f) { return right_value(f) + 2; }),
      value("value-less-margin", "a fixed margin of 0.04 subtracted from the value",
            [](F f) { return right_value(f) - 0.04L; }),
      value("value-halved", "value halved", [](F f) { return right_value(f) / 2; }),
      value("value-doubled", "value doubled", [](F f) { return right_value(f) * 2; }),
      value("value-not-finite", "value is NaN or infinite", [](F) { return kNaN; }),
      value("value-containment", "value of a sphere inside the other measured from its far side",
            [](F f) { return f.distance - std::abs(f.radius[0] - f.radius[1]) - f.contact; }),
      {.id = "answer-not-finite",
       .sentence = "normal, points and value are NaN or infinite",
       .normal = always(kNotFinite),
       .point = [](F, std::size_t) { return kNotFinite; },
       .value = [](F) { return kNaN; }},
  };
}

}  // namespace contact::oracle::formulas
