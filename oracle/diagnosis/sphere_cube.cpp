// What can go wrong about a sphere and a solid box alone: the nearest point of the box, and the way out of it.
#include "oracle/diagnosis/formulas.hpp"

namespace contact::oracle::formulas {
namespace {

constexpr std::size_t kBox = 1;

const Numbers& center(F f) { return f.nearest[0]; }
Real reach(F f) { return f.radius[0] + f.alarm; }
Numbers middle(F f) { return times(0.5L, along(f.min[kBox], 1, f.max[kBox])); }
Real length(const Numbers& v) { return std::sqrt(dot(v, v)); }

/// Calls of(c, min, max) for each axis.
template <class Of>
Numbers each_axis(F f, Of of) {
  Numbers made{};
  for (const std::size_t axis : kAxes) made[axis] = of(center(f)[axis], f.min[kBox][axis], f.max[kBox][axis]);
  return made;
}
bool within_box(F f, const Numbers& point) {
  return std::all_of(kAxes.begin(), kAxes.end(), [&](std::size_t axis) {
    return f.min[kBox][axis] <= point[axis] && point[axis] <= f.max[kBox][axis];
  });
}
bool sphere_in_box(F f) {
  const Numbers r{f.radius[0], f.radius[0], f.radius[0]};
  return within_box(f, along(center(f), -1, r)) && within_box(f, along(center(f), 1, r));
}

/// The right decision about another point of the box in the place of the nearest.
Cause decided_by(std::string_view id, std::string_view sentence, std::function<Numbers(F)> point) {
  return decision(id, sentence, [point = std::move(point)](F f) {
    return Said::at_most(length(along(point(f), -1, center(f))), reach(f));
  });
}
/// A face of the box, and how deep the centre lies below it.
struct Face {
  std::size_t axis;
  bool is_min;
  Real at;
  Real depth;
};
Face face(F f, std::size_t axis, bool is_min) {
  const Real at = (is_min ? f.min : f.max)[kBox][axis];
  return {axis, is_min, at, is_min ? center(f)[axis] - at : at - center(f)[axis]};
}
/// The first of all faces, x before y before z and min before max, that none other is `before`.
template <class Before>
Face first_face(F f, Before before) {
  Face first = face(f, kX, true);
  for (const std::size_t axis : kAxes)
    for (const bool is_min : {true, false})
      if (const Face other = face(f, axis, is_min); before(other, first)) first = other;
  return first;
}
Face nearest_face(F f) {
  return first_face(f, [](const Face& x, const Face& y) { return x.depth < y.depth; });
}

/// `said` of a centre that is in the box; no opinion where it is outside.
Said in_box(F f, const Said& said) { return where(f.D == 0, said); }
Cause value_in_box(std::string_view id, std::string_view sentence, std::function<Real(F)> said) {
  return value(id, sentence, [said = std::move(said)](F f) { return in_box(f, said(f)); });
}
/// The normal of a sphere that leaves the box by a face.
Numbers into_box(const Face& by) {
  Numbers n{};
  n[by.axis] = by.is_min ? 1 : -1;
  return n;
}
/// Whether of two faces the first is nearer, or as near and the one that was said.
bool is_better(F f, const Face& x, const Face& y) {
  return x.depth < y.depth || (x.depth == y.depth && f.said_normal == into_box(x));
}
/// The right answer about another box, which changes on each axis by change(c, min, max).
Cause about(std::string_view id, std::string_view sentence, std::function<void(Real, Real&, Real&)> change) {
  return edit(id, sentence, [change = std::move(change)](Facts& f) {
    for (const std::size_t axis : kAxes) change(center(f)[axis], f.min[kBox][axis], f.max[kBox][axis]);
    f.nearest[kBox] = each_axis(f, [](Real c, Real min, Real max) { return std::min(std::max(c, min), max); });
    f.depth = 0;
    f.settle();
    if (f.D > 0) return;
    const Face by = first_face(f, [&](const Face& x, const Face& y) { return is_better(f, x, y); });
    f.depth = by.depth;
    f.distance = -by.depth;
    f.n = by.depth > 0 ? into_box(by) : f.n;
    f.nearest[kBox][by.axis] = by.at;
  });
}
/// Changes a box around its middle.
std::function<void(Real, Real&, Real&)> resized(Real factor) {
  return [factor](Real /*c*/, Real& min, Real& max) {
    const Real middle = (min + max) / 2;
    const Real half = factor * (max - min) / 2;
    min = middle - half;
    max = middle + half;
  };
}
/// The opposite; of several faces that are nearest, of the one that was said.
Numbers outward(F f) {
  for (const std::size_t axis : kAxes)
    for (const bool is_min : {true, false}) {
      const Face by = face(f, axis, is_min);
      if (by.depth <= f.depth && f.said_normal == times(-1, into_box(by))) return *f.said_normal;
    }
  return times(-1, f.n);
}

/// A centre in the box leaves it by a chosen face.
Cause leaves_by(std::string_view id, std::string_view sentence, std::function<Face(F)> choose) {
  return {.id = id,
          .sentence = sentence,
          .normal = [=](F f) { return in_box(f, into_box(choose(f))); },
          .point = [=](F f, std::size_t shape) -> Said {
            if (f.D > 0) return std::nullopt;
            const Face by = choose(f);
            if (shape == 0) return along(center(f), f.radius[0], into_box(by));
            Numbers foot = center(f);
            foot[by.axis] = by.at;
            return foot;
          },
          .value = [=](F f) { return in_box(f, -f.radii() - choose(f).depth - f.contact); }};
}

/// Whether the centre is outside, and in the plane of a face that is not the nearest.
bool in_plane_of_face(F f) {
  return f.D > 0 && std::any_of(kAxes.begin(), kAxes.end(), [&](std::size_t axis) {
           return center(f)[axis] == f.min[kBox][axis] || center(f)[axis] == f.max[kBox][axis];
         });
}
/// The distance of the centre with the sign that a ray from it gives: less than 0 where it goes through an odd number
/// of faces, (1, 1, 1) its direction. Through an edge it goes through two.
Real by_parity(F f) {
  int crossed = 0;
  for (const std::size_t axis : kAxes)
    for (const bool is_min : {true, false}) {
      const Real t = (is_min ? f.min : f.max)[kBox][axis] - center(f)[axis];
      if (t < 0) continue;
      Numbers there = along(center(f), t, {1, 1, 1});
      there[axis] = (is_min ? f.min : f.max)[kBox][axis];
      crossed += within_box(f, there) ? 1 : 0;
    }
  return crossed % 2 == 0 ? std::abs(f.distance) : -std::abs(f.distance);
}
/// Decision and value by another distance.
Cause by_distance(std::string_view id, std::string_view sentence, std::function<Real(F)> distance) {
  return {.id = id,
          .sentence = sentence,
          .hit = [=](F f) { return Said::at_most(distance(f), reach(f)); },
          .value = [=](F f) { return Said(distance(f) - f.radii() - f.contact); }};
}

}  // namespace

bool one_inside_the_other(F f, const BallAndBox& /*shapes*/) {
  const Numbers farthest =
      each_axis(f, [](Real c, Real min, Real max) { return std::max(std::abs(min - c), std::abs(max - c)); });
  return sphere_in_box(f) || length(farthest) <= f.radius[0];
}

std::vector<Cause> wrong_about(const BallAndBox* /*kind*/) {
  return {
      value_in_box("sphere-box-depth-missing", "depth of a centre in the box left out of the value",
                   [](F f) { return -f.radii() - f.contact; }),
      value_in_box("sphere-box-depth-added", "depth of a centre in the box added to the value: a positive distance",
                   [](F f) { return f.depth - f.radii() - f.contact; }),
      leaves_by("sphere-box-farthest-face", "centre in the box leaves it by the farthest face, not by the nearest",
                [](F f) { return first_face(f, [](const Face& x, const Face& y) { return x.depth > y.depth; }); }),
      leaves_by("sphere-box-opposite-face", "centre in the box leaves it by the face opposite the nearest",
                [](F f) {
                  const Face nearest = nearest_face(f);
                  return face(f, nearest.axis, !nearest.is_min);
                }),
      leaves_by(
          "sphere-box-face-by-offset",
          "centre in the box leaves it on the axis on which it is farthest from the middle, not by the nearest face",
          [](F f) {
            const Numbers apart = along(center(f), -1, middle(f));
            std::size_t most = 0;
            for (const std::size_t axis : kAxes)
              if (std::abs(apart[axis]) > std::abs(apart[most])) most = axis;
            return face(f, most, apart[most] < 0);
          }),
      leaves_by("sphere-box-first-face", "centre in the box always leaves it by the same face: min.x",
                [](F f) { return face(f, kX, true); }),
      {.id = "sphere-box-normal-outward",
       .sentence = "normal of a centre inside the box points out of it",
       .normal = [](F f) { return where(f.depth > 0, outward(f)); }},
      {.id = "sphere-box-middle-not-finite",
       .sentence = "normal and points NaN or infinite where the centre is the middle of the box",
       .normal = [](F f) { return where(center(f) == middle(f), kNotFinite); },
       .point = [](F f, std::size_t) { return where(center(f) == middle(f), kNotFinite); }},
      points("sphere-box-point-in-box", "contact point of the box left at the centre of the sphere, inside",
             [](F f, std::size_t shape) { return where(shape == kBox && f.D == 0, center(f)); }),
      by_distance("sphere-box-coplanar-face",
                  "the sign of the distance taken from a face in whose plane the centre lies: a distance of 0",
                  [](F f) { return in_plane_of_face(f) ? Real{0} : f.distance; }),
      by_distance("sphere-box-sign-by-parity",
                  "the sign of the distance taken from a ray along (1, 1, 1) that goes through an edge", by_parity),
      decision("sphere-box-inside-missed", "sphere wholly inside the box not counted as a hit",
               [](F f) { return missed_where(sphere_in_box(f), f); }),
      decision("sphere-box-middle-in-sphere", "centre in the box a hit only where the middle of the box is in reach",
               [](F f) {
                 return f.D > 0 ? right_decision(f) : Said::at_most(length(along(middle(f), -1, center(f))), reach(f));
               }),
      {.id = "sphere-box-normal-to-middle",
       .sentence = "normal points to the middle of the box, not to its nearest point",
       .normal = [](F f) -> Said {
         const Numbers apart = along(middle(f), -1, center(f));
         if (length(apart) == 0) return std::nullopt;
         return times(1 / length(apart), apart);
       }},
      points("sphere-box-point-local", "contact point of the box relative to its middle, not in world coordinates",
             [](F f, std::size_t shape) { return where(shape == kBox, along(f.nearest[kBox], -1, middle(f))); }),
      edit("sphere-box-bounding-sphere", "box taken for the sphere through its corners",
           [](Facts& f) {
             f.radius[kBox] = length(along(f.max[kBox], -1, f.min[kBox])) / 2;
             f.nearest[kBox] = middle(f);
             f.depth = 0;
             f.settle();
           }),
      about("sphere-box-middle", "box taken for its middle: extents left out", resized(0)),
      about("sphere-box-corner", "distance taken to the nearest corner: faces and edges left out",
            [](Real c, Real& min, Real& max) {
              const bool low = c < (min + max) / 2;
              (low ? max : min) = low ? min : max;
            }),
      about("sphere-box-extents-full", "full extents of the box used as half extents", resized(2)),
      about("sphere-box-extents-halved", "half extents of the box halved again", resized(0.5L)),
      about("sphere-box-min-for-middle", "min of the box taken for its middle",
            [](Real /*c*/, Real& min, Real& max) {
              const Real half = (max - min) / 2;
              min -= half;
              max -= half;
            }),
      about("sphere-box-max-alone", "centre clamped to max alone: the box has no min",
            [](Real /*c*/, Real& min, Real& /*max*/) { min = -kInfinity; }),
      about("sphere-box-min-alone", "centre clamped to min alone: the box has no max",
            [](Real /*c*/, Real& /*min*/, Real& max) { max = kInfinity; }),
      decided_by("sphere-box-corner-by-side", "distance taken to a corner: min, or max where the centre is beyond it",
                 [](F f) { return each_axis(f, [](Real c, Real min, Real max) { return c > max ? max : min; }); }),
      decided_by(
          "sphere-box-max-for-both", "centre below min clamped to max",
          [](F f) { return each_axis(f, [](Real c, Real min, Real max) { return c < min || c > max ? max : c; }); }),
      decision("sphere-box-near-faces", "distance to a face counted from inside as well, where the sphere reaches it",
               [](F f) {
                 const Numbers apart = each_axis(f, [&](Real c, Real min, Real max) {
                   return c - min <= reach(f) ? c - min : max - c <= reach(f) ? c - max : Real{0};
                 });
                 return Said::at_most(length(apart), reach(f));
               }),
      decision("sphere-box-outermost", "box tested by its corners, and the sphere by its outermost point on each side",
               [](F f) {
                 bool hit = length(each_axis(f, [](Real c, Real min, Real max) {
                              return std::min(std::abs(min - c), std::abs(max - c));
                            })) <= reach(f);
                 for (const std::size_t axis : kAxes)
                   for (const int sign : {-1, 1}) {
                     Numbers outermost = center(f);
                     outermost[axis] += sign * reach(f);
                     hit = hit || within_box(f, outermost);
                   }
                 return Said::hit(hit);
               }),
      decision("sphere-box-integer-middle", "middle of the box cut off to integers",
               [](F f) {
                 const Numbers apart = each_axis(f, [](Real c, Real min, Real max) {
                   return std::max(Real{0}, std::abs(c - std::trunc((min + max) / 2)) - (max - min) / 2);
                 });
                 return Said::at_most(length(apart), reach(f));
               }),
  };
}

}  // namespace contact::oracle::formulas
