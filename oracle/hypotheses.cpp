// Mistakes that engines make, each as a formula that says what an engine with that mistake would answer.
#include "oracle/hypotheses.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace contact::oracle {
namespace {

using F = const Facts&;
constexpr std::size_t kX = 0;
constexpr std::size_t kY = 1;
constexpr std::size_t kZ = 2;
constexpr std::array kAxes{kX, kY, kZ};
constexpr Real kNaN = std::numeric_limits<Real>::quiet_NaN();

Numbers numbers_of(const Vector3& v) { return {v[0], v[1], v[2]}; }

Numbers along(const Numbers& from, Real factor, const Numbers& v) {
  return {from[0] + factor * v[0], from[1] + factor * v[1], from[2] + factor * v[2]};
}
Numbers times(Real factor, const Numbers& v) { return along({}, factor, v); }
Numbers with(Numbers v, std::size_t axis, Real x) {
  v[axis] = x;
  return v;
}
Real dot(const Numbers& v, const Numbers& w) { return v[0] * w[0] + v[1] * w[1] + v[2] * w[2]; }
Real sum_of(const Numbers& v) { return std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]); }
Real largest_of(const Numbers& v) { return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])}); }

/// Which way contact point `sphere` lies from its centre along the normal.
Real side(std::size_t sphere) { return sphere == 0 ? 1 : -1; }
Numbers surface(F f, std::size_t sphere) { return along(f.center[sphere], side(sphere) * f.radius[sphere], f.n); }
std::size_t other(std::size_t sphere) { return 1 - sphere; }

/// Whether the pair is within `alarm`, the gaps of boxes taken axis by axis.
Said within(F f, Real alarm) {
  return f.spheres ? Said::at_most(f.distance, f.radii() + alarm) : Said::at_most(f.widest_gap(), alarm);
}

/// A decision about spheres, or about boxes, alone.
std::function<Said(F)> spheres(std::function<Said(F)> hit) {
  return [hit = std::move(hit)](F f) { return f.spheres ? hit(f) : Said(std::nullopt); };
}
std::function<Said(F)> boxes(std::function<Said(F)> hit) {
  return [hit = std::move(hit)](F f) { return f.spheres ? Said(std::nullopt) : hit(f); };
}

/// An axis that decides nothing.
void ignore(Facts& f, std::size_t axis) {
  f.delta[axis] = 0;
  constexpr Real kEverywhere = std::numeric_limits<Real>::infinity();
  for (std::size_t shape : {0U, 1U}) {
    f.min[shape][axis] = -kEverywhere;
    f.max[shape][axis] = kEverywhere;
  }
  f.settle_from_delta();
}

/// a.min <= b.max + alarm on every axis, or the other way round.
Said one_side(F f, std::size_t low) {
  Real gap = -std::numeric_limits<Real>::infinity();
  for (const std::size_t axis : kAxes) gap = std::max(gap, f.min[low][axis] - f.max[other(low)][axis]);
  return Said::at_most(gap, f.alarm);
}
/// All comparisons but one: a.min <= b.max + alarm on one axis.
Said all_but(F f, std::size_t low, std::size_t left_out) {
  Real gap = -std::numeric_limits<Real>::infinity();
  for (const std::size_t axis : kAxes)
    for (const std::size_t shape : {0U, 1U})
      if (shape != low || axis != left_out) gap = std::max(gap, f.min[shape][axis] - f.max[other(shape)][axis]);
  return Said::at_most(gap, f.alarm);
}

bool is_flat(F f) {
  return std::any_of(kAxes.begin(), kAxes.end(), [&](std::size_t axis) {
    return f.min[0][axis] == f.max[0][axis] || f.min[1][axis] == f.max[1][axis];
  });
}

/// Boxes by their centres and extents, these taken `factor` times.
Said by_extents(F f, Real factor) {
  Real most = -std::numeric_limits<Real>::infinity();
  for (const std::size_t axis : kAxes) {
    const Real apart = std::abs((f.min[0][axis] + f.max[0][axis]) - (f.min[1][axis] + f.max[1][axis])) / 2;
    const Real extents = (f.max[0][axis] - f.min[0][axis]) + (f.max[1][axis] - f.min[1][axis]);
    most = std::max(most, apart - factor * extents);
  }
  return Said::at_most(most, f.alarm);
}

/// Whether a corner of one box lies in the other, or where `one` alone is tested, of the second in the first.
Said by_corners(F f, bool one) {
  const auto in = [&](std::size_t of, std::size_t box) {
    return std::all_of(kAxes.begin(), kAxes.end(), [&](std::size_t axis) {
      const auto inside = [&](Real x) { return x >= f.min[box][axis] - f.alarm && x <= f.max[box][axis] + f.alarm; };
      return inside(f.min[of][axis]) || inside(f.max[of][axis]);
    });
  };
  return Said::hit(in(1, 0) || (!one && in(0, 1)));
}

Real euclidean_gap(F f) {
  Numbers gaps{};
  for (const std::size_t axis : kAxes) gaps[axis] = std::max(Real{0}, f.gap(axis));
  return std::sqrt(dot(gaps, gaps));
}

Said opposite(const Said& said) { return said.kind == Said::Kind::numbers ? Said::hit(said.numbers[0] == 0) : said; }
Said right(F f) { return Said::hit(f.truth->hit()); }
/// `said` in some places; elsewhere no opinion.
Said where(bool there, const Said& said) { return there ? said : Said(std::nullopt); }

/// Whether squares in the engine's own format leave its range, so that whatever follows is lost.
bool squares_out_of_range(F f) {
  if (!f.spheres) return false;
  const Format format = format_of(f.scalar);
  const Real largest = std::ldexp(Real{1}, format.max_exponent + 1);
  const Real smallest = std::ldexp(Real{1}, format.min_exponent);
  const auto lost = [&](Real x) { return x != 0 && (x * x < smallest || x * x >= largest); };
  return lost(f.distance) || lost(f.radii() + f.alarm) ||
         std::any_of(kAxes.begin(), kAxes.end(), [&](std::size_t axis) { return lost(f.delta[axis]); });
}

/// What rounding every number to `bits` bits, 0 for the engine's own, can do to an answer: some roundings of what goes
/// in and comes between.
Real loss(F f, int bits) {
  Real most = f.radii() + f.alarm + f.contact + f.distance;
  for (const Numbers& c : f.center) most = std::max(most, largest_of(c));
  for (const std::size_t axis : kAxes)
    for (const std::size_t shape : {0U, 1U})
      most = std::max({most, std::abs(f.min[shape][axis]), std::abs(f.max[shape][axis])});
  return 8 * std::ldexp(most, -(bits == 0 ? format_of(f.scalar).precision - 1 : bits));
}
/// How far the pair is from the edge of the decision.
Real from_edge(F f) {
  return f.spheres ? std::abs(f.distance - (f.radii() + f.alarm)) : std::abs(f.widest_gap() - f.alarm);
}

/// An arithmetic in which every number carries an error of some roundings to `bits` bits.
Cause arithmetic(std::string_view id, std::string_view sentence, int bits, double weight) {
  return {.id = id,
          .sentence = sentence,
          .hit = [bits](F f) { return where(from_edge(f) <= loss(f, bits), Said::anything()); },
          .normal =
              [bits](F f) {
                return where(f.distance > 0, Said(f.n, f.distance > 0 ? loss(f, bits) / f.distance : Real{0}));
              },
          .point =
              [bits](F f, std::size_t sphere) {
                const Real turned = f.distance > 0 ? f.radius[sphere] * loss(f, bits) / f.distance : Real{0};
                return where(f.distance > 0, Said(surface(f, sphere), loss(f, bits) + turned));
              },
          .value =
              [bits](F f) {
                return Said({f.distance - f.radii() - f.contact, 0, 0}, loss(f, bits));
              },
          .weight = weight};
}

/// A normal alone.
Cause normal(std::string_view id, std::string_view sentence, std::function<Said(F)> said) {
  // Where the centres coincide any unit normal is right: formulas say nothing there.
  return {.id = id, .sentence = sentence, .normal = [said = std::move(said)](F f) {
            return where(f.region != Region::coincident, said(f));
          }};
}
/// Contact points alone.
Cause points(std::string_view id, std::string_view sentence, std::function<Said(F, std::size_t)> said) {
  return {.id = id, .sentence = sentence, .point = std::move(said)};
}
Cause value(std::string_view id, std::string_view sentence, std::function<Said(F)> said) {
  return {.id = id, .sentence = sentence, .value = std::move(said)};
}
Cause decision(std::string_view id, std::string_view sentence, std::function<Said(F)> said) {
  return {.id = id, .sentence = sentence, .hit = std::move(said)};
}
/// A number of the question is taken wrongly, in every formula or in some.
Cause edit(std::string_view id, std::string_view sentence, std::function<void(Facts&)> change) {
  return {.id = id, .sentence = sentence, .edit = std::move(change)};
}

Real signed_distance(F f) { return f.distance - f.radii(); }
Real right_value(F f) { return signed_distance(f) - f.contact; }
Real narrow(Real x) { return static_cast<Real>(static_cast<float>(x)); }

std::vector<Cause> all_causes() {
  std::vector<Cause> all{
      // Numbers of the question taken wrongly.
      edit("first-radius-for-both", "radius of the first sphere used for both",
           [](Facts& f) { f.radius[1] = f.radius[0]; }),
      edit("second-radius-for-both", "radius of the second sphere used for both",
           [](Facts& f) { f.radius[0] = f.radius[1]; }),
      edit("first-radius-missing", "radius of the first sphere left out", [](Facts& f) { f.radius[0] = 0; }),
      edit("second-radius-missing", "radius of the second sphere left out", [](Facts& f) { f.radius[1] = 0; }),
      edit("radii-missing", "radii left out", [](Facts& f) { f.radius = {}; }),
      edit("radii-doubled", "radii counted twice",
           [](Facts& f) {
             f.radius = {2 * f.radius[0], 2 * f.radius[1]};
           }),
      edit("radii-halved", "radii halved",
           [](Facts& f) {
             f.radius = {f.radius[0] / 2, f.radius[1] / 2};
           }),
      edit("radii-exchanged", "radii of the two spheres exchanged",
           [](Facts& f) { std::swap(f.radius[0], f.radius[1]); }),
      edit("radii-squared", "squares of the radii in place of the radii",
           [](Facts& f) {
             f.radius = {f.radius[0] * f.radius[0], f.radius[1] * f.radius[1]};
           }),
      edit("alarm-ignored", "alarm distance ignored", [](Facts& f) { f.alarm = 0; }),
      edit("alarm-doubled", "alarm distance counted twice", [](Facts& f) { f.alarm *= 2; }),
      edit("alarm-halved", "alarm distance halved", [](Facts& f) { f.alarm /= 2; }),
      edit("contact-ignored", "contact distance ignored", [](Facts& f) { f.contact = 0; }),
      edit("contact-doubled", "contact distance counted twice", [](Facts& f) { f.contact *= 2; }),
      edit("contact-halved", "contact distance halved", [](Facts& f) { f.contact /= 2; }),
      edit("contact-added", "contact distance added to the value, where it should be subtracted",
           [](Facts& f) { f.contact = -f.contact; }),
      edit("distances-exchanged", "alarm distance and contact distance exchanged",
           [](Facts& f) { std::swap(f.alarm, f.contact); }),
      edit("first-shape-twice", "first shape compared with itself",
           [](Facts& f) {
             f.center[1] = f.center[0];
             f.radius[1] = f.radius[0];
             f.min[1] = f.min[0];
             f.max[1] = f.max[0];
             f.settle();
           }),
      normal("delta-reversed", "normal points from second to first", [](F f) { return times(-1, f.n); }),
      {.id = "pair-swapped",
       .sentence = "answer of the swapped pair given without being swapped back",
       .normal = [](F f) { return where(f.region != Region::coincident, times(-1, f.n)); },
       .point = [](F f, std::size_t s) { return surface(f, other(s)); }},
      edit("x-ignored", "x coordinates left out", [](Facts& f) { ignore(f, kX); }),
      edit("y-ignored", "y coordinates left out", [](Facts& f) { ignore(f, kY); }),
      edit("z-ignored", "z coordinates left out", [](Facts& f) { ignore(f, kZ); }),
      edit("x-added", "x coordinates of the centres added, where they should be subtracted",
           [](Facts& f) {
             f.delta[kX] = f.center[1][kX] + f.center[0][kX];
             f.settle_from_delta();
           }),
      edit("y-added", "y coordinates of the centres added, where they should be subtracted",
           [](Facts& f) {
             f.delta[kY] = f.center[1][kY] + f.center[0][kY];
             f.settle_from_delta();
           }),
      edit("z-added", "z coordinates of the centres added, where they should be subtracted",
           [](Facts& f) {
             f.delta[kZ] = f.center[1][kZ] + f.center[0][kZ];
             f.settle_from_delta();
           }),
      edit("centres-added", "centres added, where they should be subtracted",
           [](Facts& f) {
             f.delta = along(f.center[1], 1, f.center[0]);
             f.settle_from_delta();
           }),
      edit("first-centre-ignored", "centre of the first sphere taken for the origin",
           [](Facts& f) {
             f.delta = f.center[1];
             f.settle_from_delta();
           }),
      edit("second-centre-ignored", "centre of the second sphere taken for the origin",
           [](Facts& f) {
             f.delta = times(-1, f.center[0]);
             f.settle_from_delta();
           }),
      edit("axes-crossed", "coordinates of different axes compared with each other",
           [](Facts& f) {
             for (const std::size_t axis : kAxes) f.delta[axis] = f.center[1][(axis + 1) % 3] - f.center[0][axis];
             std::rotate(f.min[1].begin(), f.min[1].begin() + 1, f.min[1].end());
             std::rotate(f.max[1].begin(), f.max[1].begin() + 1, f.max[1].end());
             f.settle_from_delta();
           }),
      edit("x-twice", "x coordinates used in place of the y coordinates",
           [](Facts& f) {
             f.delta[kY] = f.delta[kX];
             for (const std::size_t shape : {0U, 1U}) {
               f.min[shape][kY] = f.min[shape][kX];
               f.max[shape][kY] = f.max[shape][kX];
             }
             f.settle_from_delta();
           }),
      edit("inputs-single", "inputs rounded to single precision",
           [](Facts& f) {
             for (Numbers* v : {&f.center[0], &f.center[1], &f.min[0], &f.min[1], &f.max[0], &f.max[1]})
               for (Real& x : *v) x = narrow(x);
             for (Real* x : {&f.radius[0], &f.radius[1], &f.alarm, &f.contact}) *x = narrow(*x);
             f.settle();
           }),

      // Decisions.
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
       .hit = [](F f) { return f.truth->at_alarm == CGAL::ZERO ? Said::hit(false) : right(f); },
       .weight = 1.02},  // the commonest of those that explain the same
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
               [](F f) { return f.region == Region::inside ? Said::hit(false) : right(f); }),
      decision("radii-product", "squared distance compared with a product of radii", spheres([](F f) {
                 return Said::at_most(f.D, f.radius[0] * f.radius[1] * (f.radius[0] + f.radius[1]));
               })),
      decision("oblique-missed", "hits missed where the centres differ in all three coordinates", spheres([](F f) {
                 return f.delta[0] != 0 && f.delta[1] != 0 && f.delta[2] != 0 ? Said::hit(false) : right(f);
               })),
      decision("large-missed", "hits of spheres with a radius of 10000 and more missed",
               spheres([](F f) { return std::max(f.radius[0], f.radius[1]) >= 10000 ? Said::hit(false) : right(f); })),
      decision("tolerance-of-coordinates", "a tolerance of a millionth of the largest coordinate widens the test",
               [](F f) {
                 Real most = 0;
                 for (const auto* vectors : {&f.center, &f.min, &f.max})
                   for (const Numbers& v : *vectors) most = std::max(most, largest_of(v));
                 return within(f, f.alarm + 1e-6L * most);
               }),
      decision("inverted", "hit and miss exchanged", [](F f) { return opposite(right(f)); }),
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
                 Real least = std::numeric_limits<Real>::infinity();
                 for (const std::size_t axis : kAxes)
                   least = std::min(least, f.spheres ? std::abs(f.delta[axis]) - f.radii() : f.gap(axis));
                 return Said::at_most(least, f.alarm);
               }),
      decision("box-first-side", "of each axis only one side compared: a.min with b.max",
               boxes([](F f) { return one_side(f, 0); })),
      decision("box-second-side", "of each axis only one side compared: b.min with a.max",
               boxes([](F f) { return one_side(f, 1); })),
      decision("box-x-low", "comparison of a.min.x with b.max.x left out",
               boxes([](F f) { return all_but(f, 0, kX); })),
      decision("box-x-high", "comparison of b.min.x with a.max.x left out",
               boxes([](F f) { return all_but(f, 1, kX); })),
      decision("box-y-low", "comparison of a.min.y with b.max.y left out",
               boxes([](F f) { return all_but(f, 0, kY); })),
      decision("box-y-high", "comparison of b.min.y with a.max.y left out",
               boxes([](F f) { return all_but(f, 1, kY); })),
      decision("box-z-low", "comparison of a.min.z with b.max.z left out",
               boxes([](F f) { return all_but(f, 0, kZ); })),
      decision("box-z-high", "comparison of b.min.z with a.max.z left out",
               boxes([](F f) { return all_but(f, 1, kZ); })),
      decision("box-flat-missed", "flat boxes never hit: strict bounds or a volume",
               boxes([](F f) { return is_flat(f) ? Said::hit(false) : right(f); })),
      decision("box-corners", "boxes tested by their corners: crossing boxes missed",
               boxes([](F f) { return by_corners(f, false); })),
      decision("box-corners-one", "only the corners of the second box tested",
               boxes([](F f) { return by_corners(f, true); })),
      decision("box-extents-full", "full extents of the boxes used as half extents",
               boxes([](F f) { return by_extents(f, 1); })),
      decision("box-extents-quarter", "half extents of the boxes halved again",
               boxes([](F f) { return by_extents(f, 0.25L); })),
      decision("box-centres", "extents of the boxes left out: their centres compared",
               boxes([](F f) { return by_extents(f, 0); })),
      decision("box-euclidean", "Euclidean distance of the boxes compared with the alarm distance, not each axis",
               boxes([](F f) { return Said::at_most(euclidean_gap(f), f.alarm); })),
      decision("box-alarm-first", "alarm distance missing where a.min is compared with b.max", boxes([](F f) {
                 Facts g = f;
                 for (Real& x : g.max[0]) x += f.alarm;
                 return Said::at_most(g.widest_gap(), 0);
               })),
      decision("box-alarm-second", "alarm distance missing where b.min is compared with a.max", boxes([](F f) {
                 Facts g = f;
                 for (Real& x : g.max[1]) x += f.alarm;
                 return Said::at_most(g.widest_gap(), 0);
               })),
      decision("box-min-min", "minimum compared with minimum", boxes([](F f) {
                 Facts g = f;
                 g.max = g.min;
                 return Said::at_most(g.widest_gap(), f.alarm);
               })),
      decision("box-max-max", "maximum compared with maximum", boxes([](F f) {
                 Facts g = f;
                 g.min = g.max;
                 return Said::at_most(g.widest_gap(), f.alarm);
               })),
      decision("box-min-zero", "minimum of the boxes taken for 0", boxes([](F f) {
                 Facts g = f;
                 g.min = {};
                 return Said::at_most(g.widest_gap(), f.alarm);
               })),
      decision("box-centre-is-max", "centre of the boxes taken for their maximum", boxes([](F f) {
                 Real most = -std::numeric_limits<Real>::infinity();
                 for (const std::size_t axis : kAxes)
                   most =
                       std::max(most, std::abs(f.max[0][axis] - f.max[1][axis]) -
                                          ((f.max[0][axis] - f.min[0][axis]) + (f.max[1][axis] - f.min[1][axis])) / 2);
                 return Said::at_most(most, f.alarm);
               })),
      decision("box-z-extent-lost", "z extents of the boxes taken for next to nothing", boxes([](F f) {
                 Facts g = f;
                 for (const std::size_t shape : {0U, 1U}) {
                   const Real middle = (f.min[shape][kZ] + f.max[shape][kZ]) / 2;
                   g.min[shape][kZ] = middle - 1e-3L;
                   g.max[shape][kZ] = middle + 1e-3L;
                 }
                 return Said::at_most(g.widest_gap(), f.alarm);
               })),
      decision("box-gap-sum", "gaps of the axes added up", boxes([](F f) {
                 Real s = 0;
                 for (const std::size_t axis : kAxes) s += std::max(Real{0}, f.gap(axis));
                 return Said::at_most(s, f.alarm);
               })),
      decision("box-contains", "containment tested in place of overlap", boxes([](F f) {
                 const auto in = [&](std::size_t of, std::size_t box) {
                   return std::all_of(kAxes.begin(), kAxes.end(), [&](std::size_t axis) {
                     return f.min[of][axis] >= f.min[box][axis] - f.alarm &&
                            f.max[of][axis] <= f.max[box][axis] + f.alarm;
                   });
                 };
                 return Said::hit(in(0, 1) || in(1, 0));
               })),

      // Normals.
      {.id = "normal-not-finite",
       .sentence = "normal is NaN or infinite",
       .normal =
           [](F) {
             return Numbers{kNaN, kNaN, kNaN};
           }},
      {.id = "normal-zero", .sentence = "normal is zero", .normal = [](F) { return Numbers{}; }},
      normal("normal-not-unit", "normal is the difference of the centres, not divided by its length",
             [](F f) { return f.delta; }),
      normal("normal-over-square", "normal divided by the squared distance",
             [](F f) { return times(1 / f.D, f.delta); }),
      normal("normal-over-radii", "normal divided by the radius sum, not by the distance",
             [](F f) { return times(1 / f.radii(), f.delta); }),
      normal("normal-over-reach", "normal divided by the reach, not by the distance",
             [](F f) { return times(1 / (f.radii() + f.alarm), f.delta); }),
      normal("normal-over-coordinate-sum", "normal divided by the sum of its components",
             [](F f) { return times(1 / sum_of(f.delta), f.delta); }),
      normal("normal-over-largest", "normal divided by its largest component",
             [](F f) { return times(1 / largest_of(f.delta), f.delta); }),
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
      normal("normal-xy-exchanged", "x and y of the normal exchanged",
             [](F f) {
               return Numbers{f.n[1], f.n[0], f.n[2]};
             }),
      normal("normal-yz-exchanged", "y and z of the normal exchanged",
             [](F f) {
               return Numbers{f.n[0], f.n[2], f.n[1]};
             }),
      normal("normal-xz-exchanged", "x and z of the normal exchanged",
             [](F f) {
               return Numbers{f.n[2], f.n[1], f.n[0]};
             }),
      normal("normal-rotated", "components of the normal moved on by one axis",
             [](F f) {
               return Numbers{f.n[2], f.n[0], f.n[1]};
             }),
      normal("normal-snapped", "normal turned to the nearest axis",
             [](F f) {
               std::size_t most = 0;
               for (const std::size_t axis : kAxes)
                 if (std::abs(f.n[axis]) > std::abs(f.n[most])) most = axis;
               return with({}, most, f.n[most] < 0 ? -1 : 1);
             }),
      normal("normal-always-x", "normal always (1, 0, 0)",
             [](F) {
               return Numbers{1, 0, 0};
             }),
      normal("normal-always-y", "normal always (0, 1, 0)",
             [](F) {
               return Numbers{0, 1, 0};
             }),
      normal("normal-always-minus-y", "normal always (0, -1, 0)",
             [](F) {
               return Numbers{0, -1, 0};
             }),
      normal("normal-always-z", "normal always (0, 0, 1)",
             [](F) {
               return Numbers{0, 0, 1};
             }),
      normal("normal-to-positive-x", "normal turned so that its x is positive, whichever sphere comes first",
             [](F f) { return f.n[kX] < 0 ? times(-1, f.n) : f.n; }),
      normal("normal-from-smaller", "normal points from the smaller sphere to the larger, whichever comes first",
             [](F f) { return f.radius[0] > f.radius[1] ? times(-1, f.n) : f.n; }),
      {.id = "normal-wrong-length",
       .sentence = "normal has the right direction and not unit length",
       .normal = [](F f) -> Said {
         if (!f.said_normal) return std::nullopt;
         const Real length = std::sqrt(dot(*f.said_normal, *f.said_normal));
         if (!(length > 0 && std::isfinite(length))) return std::nullopt;
         return f.region == Region::coincident ? *f.said_normal : times(length, f.n);
       }},

      // Contact points.
      points("points-far-side", "contact point on the far side of its sphere",
             [](F f, std::size_t s) { return along(f.center[s], -side(s) * f.radius[s], f.n); }),
      points("points-at-centre", "contact point at the centre of its sphere",
             [](F f, std::size_t s) { return f.center[s]; }),
      points("points-exchanged", "contact point of one sphere given for the other",
             [](F f, std::size_t s) { return surface(f, other(s)); }),
      points("points-middle", "one contact point for both spheres, half way between the surfaces",
             [](F f, std::size_t) { return times(0.5L, along(surface(f, 0), 1, surface(f, 1))); }),
      points("points-centre-middle", "contact point half way between the centres, radii ignored",
             [](F f, std::size_t) { return along(f.center[0], 0.5L, f.delta); }),
      points("points-behind", "contact point half a centre distance behind the first sphere",
             [](F f, std::size_t) { return along(f.center[0], -0.5L, f.delta); }),
      points("points-weighted", "contact point between the centres in the ratio of the radii, on neither surface",
             [](F f, std::size_t) { return along(f.center[0], f.radius[0] / f.radii(), f.delta); }),
      points("points-not-unit", "contact point uses a normal that is not divided by its length",
             [](F f, std::size_t s) { return along(f.center[s], side(s) * f.radius[s], f.delta); }),
      points("points-from-other-centre", "contact point starts from the centre of the other sphere",
             [](F f, std::size_t s) { return along(f.center[other(s)], side(s) * f.radius[s], f.n); }),
      points("points-local", "contact point relative to its own centre, not in world coordinates",
             [](F f, std::size_t s) { return times(side(s) * f.radius[s], f.n); }),
      points("points-world-negated", "contact point negated",
             [](F f, std::size_t s) { return times(-1, surface(f, s)); }),
      points("points-past-alarm", "contact point lifted off the surface by the alarm distance",
             [](F f, std::size_t s) { return along(f.center[s], side(s) * (f.radius[s] + f.alarm), f.n); }),
      points("points-past-contact", "contact point lifted off the surface by the contact distance",
             [](F f, std::size_t s) { return along(f.center[s], side(s) * (f.radius[s] + f.contact), f.n); }),
      points("points-below-contact", "contact point sunk below the surface by the contact distance",
             [](F f, std::size_t s) { return along(f.center[s], side(s) * (f.radius[s] - f.contact), f.n); }),
      points("points-past-half-value", "contact point moved by half the distance of the surfaces",
             [](F f, std::size_t s) { return along(f.center[s], side(s) * (f.radius[s] + signed_distance(f)), f.n); }),
      points("points-x-centre", "x of the contact point is that of the centre",
             [](F f, std::size_t s) { return with(surface(f, s), kX, f.center[s][kX]); }),
      points("points-y-centre", "y of the contact point is that of the centre",
             [](F f, std::size_t s) { return with(surface(f, s), kY, f.center[s][kY]); }),
      points("points-z-centre", "z of the contact point is that of the centre",
             [](F f, std::size_t s) { return with(surface(f, s), kZ, f.center[s][kZ]); }),
      points("points-x-mirrored", "x of the contact point on the far side",
             [](F f, std::size_t s) { return with(surface(f, s), kX, 2 * f.center[s][kX] - surface(f, s)[kX]); }),
      points("points-y-mirrored", "y of the contact point on the far side",
             [](F f, std::size_t s) { return with(surface(f, s), kY, 2 * f.center[s][kY] - surface(f, s)[kY]); }),
      points("points-z-mirrored", "z of the contact point on the far side",
             [](F f, std::size_t s) { return with(surface(f, s), kZ, 2 * f.center[s][kZ] - surface(f, s)[kZ]); }),
      points("points-zero", "contact point is the origin", [](F, std::size_t) { return Numbers{}; }),
      {.id = "points-not-finite",
       .sentence = "contact point is NaN or infinite",
       .point =
           [](F, std::size_t) {
             return Numbers{kNaN, kNaN, kNaN};
           }},

      // Values.
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
      value("value-contact-per-sphere", "contact distance subtracted once for each sphere",
            [](F f) { return right_value(f) - f.contact; }),
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

      // Arithmetic: vague, so last.
      {.id = "square-range",
       .sentence = "squares overflow or underflow",
       .hit = [](F f) { return where(squares_out_of_range(f), Said::anything()); },
       .normal = [](F f) { return where(squares_out_of_range(f), Said::anything()); },
       .point = [](F f, std::size_t) { return where(squares_out_of_range(f), Said::anything()); },
       .value = [](F f) { return where(squares_out_of_range(f), Said::anything()); },
       .weight = 0.5},
      {.id = "sum-range",
       .sentence = "a sum overflows",
       .hit = boxes([](F f) {
         const Real largest = std::ldexp(Real{1}, format_of(f.scalar).max_exponent + 1);
         const bool over = std::any_of(kAxes.begin(), kAxes.end(), [&](std::size_t axis) {
           return std::max(f.max[0][axis], f.max[1][axis]) + f.alarm >= largest;
         });
         return where(over, Said::anything());
       }),
       .weight = 0.5},
  };
  // Tolerances of the sizes that people choose; the smallest that explains an error is the one to name.
  struct Tolerance {
    std::string_view add_id, add, subtract_id, subtract;
    Real size;
  };
#define CONTACT_TOLERANCE(size)                                                                         \
  Tolerance {                                                                                           \
    "tolerance-" #size, "an absolute tolerance of " #size " widens the test", "tolerance-minus-" #size, \
        "an absolute tolerance of " #size " narrows the test", size##L                                  \
  }
  for (const Tolerance& t :
       {CONTACT_TOLERANCE(1e-15), CONTACT_TOLERANCE(1e-14), CONTACT_TOLERANCE(1e-12), CONTACT_TOLERANCE(1e-10),
        CONTACT_TOLERANCE(1e-9), CONTACT_TOLERANCE(1e-8), CONTACT_TOLERANCE(1e-7), CONTACT_TOLERANCE(1e-6),
        CONTACT_TOLERANCE(1e-5), CONTACT_TOLERANCE(1e-4), CONTACT_TOLERANCE(1e-3), CONTACT_TOLERANCE(1e-2)}) {
    all.push_back({.id = t.add_id,
                   .sentence = t.add,
                   .hit = [size = t.size](F f) { return within(f, f.alarm + size); },
                   .weight = 0.95});
    all.push_back(
        {.id = t.subtract_id,
         .sentence = t.subtract,
         .hit = [size = t.size](
                    F f) { return f.truth->at_alarm == CGAL::ZERO ? Said::hit(false) : within(f, f.alarm - size); },
         .weight = 0.95});
  }
#undef CONTACT_TOLERANCE
  // The axis that a guard falls back to differs from engine to engine.
  const auto guard = [](std::string_view id, std::string_view sentence, Real size) {
    return Cause{.id = id, .sentence = sentence, .normal = [size](F f) -> Said {
                   if (f.region == Region::coincident || f.distance > size || !f.said_normal) return std::nullopt;
                   const Numbers& said = *f.said_normal;
                   return largest_of(said) == 1 && sum_of(said) == 1 ? said : Numbers{1, 0, 0};
                 }};
  };
  all.push_back(guard("centres-within-1e-19", "centres within an absolute 1e-19 taken for coincident", 1.09e-19L));
  all.push_back(guard("centres-within-1e-15", "centres within an absolute 1e-15 taken for coincident", 1e-15L));
  all.push_back(guard("centres-within-1e-12", "centres within an absolute 1e-12 taken for coincident", 1e-12L));
  all.push_back(guard("centres-within-1e-9", "centres within an absolute 1e-9 taken for coincident", 1e-9L));
  all.push_back(guard("centres-within-1e-6", "centres within an absolute 1e-6 taken for coincident", 1e-6L));
  all.push_back(guard("centres-within-1e-3", "centres within an absolute 1e-3 taken for coincident", 1e-3L));
  all.push_back(arithmetic("rounding", "intermediate results rounded: wrong in the last bits", 0, 0.7));
  all.push_back(arithmetic("single-precision", "computes in single precision", 23, 0.5));
  all.push_back(arithmetic("five-digits", "right to about five digits only", 18, 0.4));
  all.push_back(arithmetic("four-digits",
                           "right to about four digits only, as an estimate of a reciprocal square root is", 15, 0.35));
  all.push_back(arithmetic("three-digits", "right to about three digits only", 11, 0.3));
  return all;
  // No leak: `all` owns its functions, copied into it out of a list of initializers, and the list owned its own.
  // NOLINTNEXTLINE(clang-analyzer-cplusplus.NewDeleteLeaks)
}

}  // namespace

Facts::Facts(const Query& query, const Truth& true_of_it, Scalar engine_scalar, std::optional<Numbers> normal_said)
    : truth(&true_of_it),
      scalar(engine_scalar),
      spheres(query.balls() != nullptr),
      region(Region::beyond),
      alarm(query.distances.alarm),
      contact(query.distances.contact),
      said_normal(normal_said) {
  bool inside = false;
  bool coincident = false;
  if (const Balls* balls = query.balls()) {
    center = {numbers_of(balls->a.center), numbers_of(balls->b.center)};
    radius = {balls->a.radius, balls->b.radius};
    settle();
    inside = distance <= std::abs(radius[0] - radius[1]);
    coincident = truth->spheres->degenerate();
  } else {
    const auto& [a, b] = *query.boxes();
    min = {numbers_of(a.min), numbers_of(b.min)};
    max = {numbers_of(a.max), numbers_of(b.max)};
    const auto in = [](const Box& x, const Box& y) {
      return (x.min.array() >= y.min.array()).all() && (x.max.array() <= y.max.array()).all();
    };
    inside = in(a, b) || in(b, a);
  }
  if (truth->at_alarm == CGAL::POSITIVE) return;
  if (coincident)
    region = Region::coincident;
  else if (truth->at_alarm == CGAL::ZERO)
    region = alarm == 0 ? Region::touching : Region::at_alarm;
  else if (truth->at_zero != CGAL::NEGATIVE)
    region = Region::near;
  else
    region = inside ? Region::inside : Region::overlapping;
}

void Facts::settle() {
  if (!spheres) return;
  delta = along(center[1], -1, center[0]);
  settle_from_delta();
}

void Facts::settle_from_delta() {
  D = dot(delta, delta);
  distance = std::sqrt(D);
  n = D > 0 ? times(1 / distance, delta) : said_normal.value_or(Numbers{});
}

Real Facts::gap(std::size_t axis) const { return std::max(min[0][axis] - max[1][axis], min[1][axis] - max[0][axis]); }
Real Facts::widest_gap() const { return std::max({gap(0), gap(1), gap(2)}); }

Said Said::at_most(Real x, Real y) {
  const Real near = 16 * std::numeric_limits<Real>::epsilon() * std::max(std::abs(x), std::abs(y));
  if (!(std::abs(x - y) > near)) return std::nullopt;
  return hit(x < y);
}

std::span<const Cause> causes() {
  static const std::vector<Cause> all = all_causes();
  return all;
}

std::size_t cause_index(std::string_view id) {
  const auto all = causes();
  const auto it = std::find_if(all.begin(), all.end(), [&](const Cause& c) { return c.id == id; });
  if (it == all.end()) throw std::out_of_range("no cause '" + std::string(id) + "'");
  return static_cast<std::size_t>(it - all.begin());
}

Predictions predict(const Cause& cause, const Facts& facts) {
  Predictions said;
  if (cause.edit) {
    Facts f = facts;
    cause.edit(f);
    said.hit = within(f, f.alarm);
    if (!f.spheres) return said;
    said.value = right_value(f);
    if (f.D == 0) f.n = facts.n;  // no direction: whichever was said
    if (facts.D > 0) said.normal = f.n;
    if (facts.D > 0 || f.D == 0) said.point = {surface(f, 0), surface(f, 1)};
    return said;
  }
  if (cause.hit) said.hit = cause.hit(facts);
  if (!facts.spheres) return said;
  if (cause.normal) said.normal = cause.normal(facts);
  if (cause.point) said.point = {cause.point(facts, 0), cause.point(facts, 1)};
  if (cause.value) said.value = cause.value(facts);
  return said;
}

}  // namespace contact::oracle
