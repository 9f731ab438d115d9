// Causes that decide wrongly whether two shapes are within the alarm distance.
#include "oracle/diagnosis/formulas.hpp"

namespace contact::oracle::formulas {
namespace {

Cause decision(std::string_view id, std::string_view sentence, std::function<Said(F)> said) {
  return {.id = id, .sentence = sentence, .hit = std::move(said)};
}
/// A decision about spheres that has no opinion on boxes.
std::function<Said(F)> spheres(std::function<Said(F)> hit) {
  return [hit = std::move(hit)](F f) { return f.spheres ? hit(f) : Said(std::nullopt); };
}
Said right(F f) { return Said::hit(f.truth->hit()); }
/// A miss in some places, and right elsewhere.
Said missed_where(bool there, F f) { return there ? Said::hit(false) : right(f); }

}  // namespace

std::vector<Cause> wrong_decisions() {
  return {
      decision("squared-against-sum", "squared distance compared with a plain radius sum",
               spheres([](F f) { return Said::at_most(f.D, f.radii() + f.alarm); })),
      decision("distance-against-square", "plain distance compared with the squared radius sum",
               spheres([](F f) { return Said::at_most(f.distance, (f.radii() + f.alarm) * (f.radii() + f.alarm)); })),
      decision(
          "sum-of-squares", "squares of the radii summed, where the sum should be squared", spheres([](F f) {
            return Said::at_most(f.D, dot({f.radius[0], f.radius[1], f.alarm}, {f.radius[0], f.radius[1], f.alarm}));
          })),
      decision("alarm-squared-apart", "square of the alarm distance added to the squared radius sum",
               spheres([](F f) { return Said::at_most(f.D, f.radii() * f.radii() + f.alarm * f.alarm); })),
      decision("alarm-outside-square", "alarm distance added to the squared radius sum",
               spheres([](F f) { return Said::at_most(f.D, f.radii() * f.radii() + f.alarm); })),
      decision("radii-multiplied", "radii multiplied, where they should be added",
               spheres([](F f) { return Said::at_most(f.distance, f.radius[0] * f.radius[1] + f.alarm); })),
      decision("radii-subtracted", "radii subtracted, where they should be added",
               spheres([](F f) { return Said::at_most(f.distance, f.alarm + std::abs(f.radius[0] - f.radius[1])); })),
      decision("larger-radius-only", "only the larger radius counted",
               spheres([](F f) { return Said::at_most(f.distance, f.alarm + std::max(f.radius[0], f.radius[1])); })),
      decision("smaller-radius-only", "only the smaller radius counted",
               spheres([](F f) { return Said::at_most(f.distance, f.alarm + std::min(f.radius[0], f.radius[1])); })),
      decision("alarm-subtracted", "alarm distance subtracted, where it should be added",
               [](F f) { return within(f, -f.alarm); }),
      decision("contact-for-alarm", "contact distance used in place of the alarm distance",
               [](F f) { return within(f, f.contact); }),
      decision("contact-widens", "contact distance added to the alarm distance",
               [](F f) { return within(f, f.alarm + f.contact); }),
      decision("contact-narrows", "contact distance subtracted from the alarm distance",
               [](F f) { return within(f, f.alarm - f.contact); }),
      decision("larger-distance", "larger of alarm and contact distance used",
               [](F f) { return within(f, std::max(f.alarm, f.contact)); }),
      decision("alarm-capped", "alarm distance cut off at the smaller radius",
               spheres([](F f) { return within(f, std::min(f.alarm, std::min(f.radius[0], f.radius[1]))); })),
      {.id = "edge-open",
       .sentence = "equality not counted as a hit: < in place of <=",
       .hit = [](F f) { return missed_where(f.truth->at_alarm == Side::at, f); },
       .weight = 1.02},  // of those that explain the same the commonest
      decision("single-decision", "decisions made in single precision",
               [](F f) {
                 if (f.spheres) return Said::hit(narrow(f.distance) <= narrow(f.radii() + f.alarm));
                 bool hit = true;
                 for (const std::size_t axis : kAxes)
                   for (const std::size_t shape : {0U, 1U})
                     hit = hit &&
                           narrow(f.min[shape][axis]) <= narrow(narrow(f.max[other(shape)][axis]) + narrow(f.alarm));
                 return Said::hit(hit);
               }),
      decision("inside-missed", "a shape inside the other not counted as a hit",
               [](F f) { return missed_where(f.region == Region::inside, f); }),
      decision("radii-product", "squared distance compared with a product of radii", spheres([](F f) {
                 return Said::at_most(f.D, f.radius[0] * f.radius[1] * (f.radius[0] + f.radius[1]));
               })),
      decision("oblique-missed", "hits missed where the centres differ in all three coordinates",
               spheres([](F f) { return missed_where(f.delta[kX] != 0 && f.delta[kY] != 0 && f.delta[kZ] != 0, f); })),
      decision("large-missed", "hits of spheres with a radius of 10000 and more missed",
               spheres([](F f) { return missed_where(std::max(f.radius[0], f.radius[1]) >= 10000, f); })),
      decision("tolerance-of-coordinates", "a tolerance of a millionth of the largest coordinate widens the test",
               [](F f) {
                 Real most = 0;
                 for (const auto* vectors : {&f.center, &f.min, &f.max})
                   for (const Numbers& v : *vectors) most = std::max(most, largest_of(v));
                 return within(f, f.alarm + 1e-6L * most);
               }),
      decision("inverted", "hit and miss exchanged", [](F f) { return Said::hit(!f.truth->hit()); }),
      decision("always-hit", "always answers hit", [](F) { return Said::hit(true); }),
      decision("never-hit", "never answers hit", [](F) { return Said::hit(false); }),
      {.id = "coordinate-sum",
       .sentence = "sum of the coordinate differences used as the distance",
       .hit = spheres([](F f) { return Said::at_most(sum_of(f.delta), f.radii() + f.alarm); }),
       .value = [](F f) { return sum_of(f.delta) - f.radii() - f.contact; }},
      {.id = "largest-coordinate",
       .sentence = "largest coordinate difference used as the distance",
       .hit = spheres([](F f) { return Said::at_most(largest_of(f.delta), f.radii() + f.alarm); }),
       .value = [](F f) { return largest_of(f.delta) - f.radii() - f.contact; }},
      decision("one-axis-enough", "one axis of overlap taken for all three",
               [](F f) {
                 Real least = kInfinity;
                 for (const std::size_t axis : kAxes)
                   least = std::min(least, f.spheres ? std::abs(f.delta[axis]) - f.radii() : f.gap(axis));
                 return Said::at_most(least, f.alarm);
               }),
  };
  // No leak: the vector owns its functions, copied into it out of the list, and the list owns its own.
  // NOLINTNEXTLINE(clang-analyzer-cplusplus.NewDeleteLeaks)
}

namespace {

Cause box(std::string_view id, std::string_view sentence, std::function<Said(F)> said) {
  return decision(id, sentence, boxes(std::move(said)));
}
/// Whether a.min <= b.max + alarm on every axis, where `low` is 0; b.min <= a.max + alarm, where it is 1.
Said one_side(F f, std::size_t low) {
  Real gap = -kInfinity;
  for (const std::size_t axis : kAxes) gap = std::max(gap, f.min[low][axis] - f.max[other(low)][axis]);
  return Said::at_most(gap, f.alarm);
}
/// Both sides on every axis, without the comparison of one side on one axis.
Said all_but(F f, std::size_t low, std::size_t left_out) {
  Real gap = -kInfinity;
  for (const std::size_t axis : kAxes)
    for (const std::size_t shape : {0U, 1U})
      if (shape != low || axis != left_out) gap = std::max(gap, f.min[shape][axis] - f.max[other(shape)][axis]);
  return Said::at_most(gap, f.alarm);
}
/// The right decision about changed boxes.
std::function<Said(F)> changed(std::function<void(Facts&)> change) {
  return [change = std::move(change)](F f) {
    Facts g = f;
    change(g);
    return within(g, g.alarm);
  };
}

bool is_flat(F f) {
  return std::any_of(kAxes.begin(), kAxes.end(), [&](std::size_t axis) {
    return f.min[0][axis] == f.max[0][axis] || f.min[1][axis] == f.max[1][axis];
  });
}

/// Compares the centres of the boxes with `factor` times their extents.
Said by_extents(F f, Real factor) {
  Real most = -kInfinity;
  for (const std::size_t axis : kAxes) {
    const Real apart = std::abs((f.min[0][axis] + f.max[0][axis]) - (f.min[1][axis] + f.max[1][axis])) / 2;
    const Real extents = (f.max[0][axis] - f.min[0][axis]) + (f.max[1][axis] - f.min[1][axis]);
    most = std::max(most, apart - factor * extents);
  }
  return Said::at_most(most, f.alarm);
}

/// Whether a corner of the second box lies in the first, or also, unless `one` is set, of the first in the second.
Said by_corners(F f, bool one) {
  const auto in = [&](std::size_t a, std::size_t b) {
    return std::all_of(kAxes.begin(), kAxes.end(), [&](std::size_t axis) {
      const auto inside = [&](Real x) { return x >= f.min[b][axis] - f.alarm && x <= f.max[b][axis] + f.alarm; };
      return inside(f.min[a][axis]) || inside(f.max[a][axis]);
    });
  };
  return Said::hit(in(1, 0) || (!one && in(0, 1)));
}

/// The gaps of the boxes, and 0 on axes on which they overlap.
Numbers gaps(F f) { return {std::max(Real{0}, f.gap(kX)), std::max(Real{0}, f.gap(kY)), std::max(Real{0}, f.gap(kZ))}; }

}  // namespace

std::vector<Cause> wrong_box_decisions() {
  return {
      box("box-first-side", "of each axis only one side compared: a.min with b.max",
          [](F f) { return one_side(f, 0); }),
      box("box-second-side", "of each axis only one side compared: b.min with a.max",
          [](F f) { return one_side(f, 1); }),
      box("box-x-low", "comparison of a.min.x with b.max.x left out", [](F f) { return all_but(f, 0, kX); }),
      box("box-x-high", "comparison of b.min.x with a.max.x left out", [](F f) { return all_but(f, 1, kX); }),
      box("box-y-low", "comparison of a.min.y with b.max.y left out", [](F f) { return all_but(f, 0, kY); }),
      box("box-y-high", "comparison of b.min.y with a.max.y left out", [](F f) { return all_but(f, 1, kY); }),
      box("box-z-low", "comparison of a.min.z with b.max.z left out", [](F f) { return all_but(f, 0, kZ); }),
      box("box-z-high", "comparison of b.min.z with a.max.z left out", [](F f) { return all_but(f, 1, kZ); }),
      box("box-flat-missed", "flat boxes never hit: strict bounds or a volume",
          [](F f) { return missed_where(is_flat(f), f); }),
      box("box-corners", "boxes tested by their corners: crossing boxes missed",
          [](F f) { return by_corners(f, false); }),
      box("box-corners-one", "only the corners of the second box tested", [](F f) { return by_corners(f, true); }),
      box("box-extents-full", "full extents of the boxes used as half extents", [](F f) { return by_extents(f, 1); }),
      box("box-extents-quarter", "half extents of the boxes halved again", [](F f) { return by_extents(f, 0.25L); }),
      box("box-centres", "extents of the boxes left out: their centres compared", [](F f) { return by_extents(f, 0); }),
      box("box-euclidean", "Euclidean distance of the boxes compared with the alarm distance, not each axis",
          [](F f) { return Said::at_most(std::sqrt(dot(gaps(f), gaps(f))), f.alarm); }),
      box("box-alarm-first", "alarm distance missing where a.min is compared with b.max", changed([](Facts& f) {
            for (Real& x : f.max[0]) x += f.alarm;
            f.alarm = 0;
          })),
      box("box-alarm-second", "alarm distance missing where b.min is compared with a.max", changed([](Facts& f) {
            for (Real& x : f.max[1]) x += f.alarm;
            f.alarm = 0;
          })),
      box("box-min-min", "minimum compared with minimum", changed([](Facts& f) { f.max = f.min; })),
      box("box-max-max", "maximum compared with maximum", changed([](Facts& f) { f.min = f.max; })),
      box("box-min-zero", "minimum of the boxes taken for 0", changed([](Facts& f) { f.min = {}; })),
      box("box-centre-is-max", "centre of the boxes taken for their maximum",
          [](F f) {
            Real most = -kInfinity;
            for (const std::size_t axis : kAxes)
              most = std::max(most, std::abs(f.max[0][axis] - f.max[1][axis]) -
                                        ((f.max[0][axis] - f.min[0][axis]) + (f.max[1][axis] - f.min[1][axis])) / 2);
            return Said::at_most(most, f.alarm);
          }),
      box("box-z-extent-lost", "z extents of the boxes taken for next to nothing", changed([](Facts& f) {
            for (const std::size_t shape : {0U, 1U}) {
              const Real middle = (f.min[shape][kZ] + f.max[shape][kZ]) / 2;
              f.min[shape][kZ] = middle - 1e-3L;
              f.max[shape][kZ] = middle + 1e-3L;
            }
          })),
      box("box-gap-sum", "gaps of the axes added up", [](F f) { return Said::at_most(sum_of(gaps(f)), f.alarm); }),
      box("box-contains", "containment tested in place of overlap",
          [](F f) {
            const auto in = [&](std::size_t a, std::size_t b) {
              return std::all_of(kAxes.begin(), kAxes.end(), [&](std::size_t axis) {
                return f.min[a][axis] >= f.min[b][axis] - f.alarm && f.max[a][axis] <= f.max[b][axis] + f.alarm;
              });
            };
            return Said::hit(in(0, 1) || in(1, 0));
          }),
  };
}

}  // namespace contact::oracle::formulas
