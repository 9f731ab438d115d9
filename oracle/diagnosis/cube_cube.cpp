// What can go wrong about two boxes alone: decisions, axis by axis.
#include "oracle/diagnosis/formulas.hpp"

namespace contact::oracle::formulas {
namespace {

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

bool one_inside_the_other(F /*f*/, const Boxes& boxes) {
  const auto in = [](const Box& x, const Box& y) {
    return (x.min.array() >= y.min.array()).all() && (x.max.array() <= y.max.array()).all();
  };
  return in(boxes.a, boxes.b) || in(boxes.b, boxes.a);
}

std::vector<Cause> wrong_about(const Boxes* /*kind*/) {
  return {
      decision("box-first-side", "of each axis only one side compared: a.min with b.max",
               [](F f) { return one_side(f, 0); }),
      decision("box-second-side", "of each axis only one side compared: b.min with a.max",
               [](F f) { return one_side(f, 1); }),
      decision("box-x-low", "comparison of a.min.x with b.max.x left out", [](F f) { return all_but(f, 0, kX); }),
      decision("box-x-high", "comparison of b.min.x with a.max.x left out", [](F f) { return all_but(f, 1, kX); }),
      decision("box-y-low", "comparison of a.min.y with b.max.y left out", [](F f) { return all_but(f, 0, kY); }),
      decision("box-y-high", "comparison of b.min.y with a.max.y left out", [](F f) { return all_but(f, 1, kY); }),
      decision("box-z-low", "comparison of a.min.z with b.max.z left out", [](F f) { return all_but(f, 0, kZ); }),
      decision("box-z-high", "comparison of b.min.z with a.max.z left out", [](F f) { return all_but(f, 1, kZ); }),
      decision("box-flat-missed", "flat boxes never hit: strict bounds or a volume",
               [](F f) { return missed_where(is_flat(f), f); }),
      decision("box-corners", "boxes tested by their corners: crossing boxes missed",
               [](F f) { return by_corners(f, false); }),
      decision("box-corners-one", "only the corners of the second box tested", [](F f) { return by_corners(f, true); }),
      decision("box-extents-full", "full extents of the boxes used as half extents",
               [](F f) { return by_extents(f, 1); }),
      decision("box-extents-quarter", "half extents of the boxes halved again",
               [](F f) { return by_extents(f, 0.25L); }),
      decision("box-centres", "extents of the boxes left out: their centres compared",
               [](F f) { return by_extents(f, 0); }),
      decision("box-euclidean", "Euclidean distance of the boxes compared with the alarm distance, not each axis",
               [](F f) { return Said::at_most(std::sqrt(dot(gaps(f), gaps(f))), f.alarm); }),
      decision("box-alarm-first", "alarm distance missing where a.min is compared with b.max", changed([](Facts& f) {
                 for (Real& x : f.max[0]) x += f.alarm;
                 f.alarm = 0;
               })),
      decision("box-alarm-second", "alarm distance missing where b.min is compared with a.max", changed([](Facts& f) {
                 for (Real& x : f.max[1]) x += f.alarm;
                 f.alarm = 0;
               })),
      decision("box-min-min", "minimum compared with minimum", changed([](Facts& f) { f.max = f.min; })),
      decision("box-max-max", "maximum compared with maximum", changed([](Facts& f) { f.min = f.max; })),
      decision("box-min-zero", "minimum of the boxes taken for 0", changed([](Facts& f) { f.min = {}; })),
      decision("box-centre-is-max", "centre of the boxes taken for their maximum",
               [](F f) {
                 Real most = -kInfinity;
                 for (const std::size_t axis : kAxes)
                   most =
                       std::max(most, std::abs(f.max[0][axis] - f.max[1][axis]) -
                                          ((f.max[0][axis] - f.min[0][axis]) + (f.max[1][axis] - f.min[1][axis])) / 2);
                 return Said::at_most(most, f.alarm);
               }),
      decision("box-z-extent-lost", "z extents of the boxes taken for next to nothing", changed([](Facts& f) {
                 for (const std::size_t shape : {0U, 1U}) {
                   const Real middle = (f.min[shape][kZ] + f.max[shape][kZ]) / 2;
                   f.min[shape][kZ] = middle - 1e-3L;
                   f.max[shape][kZ] = middle + 1e-3L;
                 }
               })),
      decision("box-gap-sum", "gaps of the axes added up", [](F f) { return Said::at_most(sum_of(gaps(f)), f.alarm); }),
      decision("box-contains", "containment tested in place of overlap",
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
