// Mistakes about boxes and capsules: another point taken for the nearest one, another way out of a box.
#include <Eigen/Geometry>

#include "engines/zoo/mutating.hpp"

namespace contact::engines {
namespace {

/// The answer for two spheres at other points, in wide arithmetic; the right answer where these are the right points.
void answer_at(const Query& q, Claim& claim, const WideVector& p, const WideVector& r,
               std::optional<Wide> radius2 = {}) {
  const std::array<WideBall, 2> right = wide_balls(q);
  const WideBall& a = right[0];
  const WideBall& b = right[1];
  const Wide moved = (p - a.center).norm() + (r - b.center).norm();
  if (!radius2 && moved <= 1e-17L * (a.center.norm() + b.center.norm())) return;
  const Wide r2 = radius2.value_or(b.radius);
  const WideVector d = r - p;
  const Wide distance = d.norm();
  decide(q, claim, distance <= a.radius + r2 + static_cast<Wide>(q.distances.alarm));
  in_contact(claim, [&](ContactClaim& c) {
    if (distance > 0) c.normal = Vector3((d / distance).cast<double>());
    const WideVector n = c.normal->cast<Wide>();
    c.point1 = Vector3((p + a.radius * n).cast<double>());
    c.point2 = Vector3((r - r2 * n).cast<double>());
    c.value = rounded(distance - a.radius - r2 - static_cast<Wide>(q.distances.contact));
  });
}

/// An axis, from + t along.
struct Axis {
  WideVector from;
  WideVector along;

  explicit Axis(const Ball& ball) : from(ball.center.cast<Wide>()), along(WideVector::Zero()) {}
  explicit Axis(const Capsule& capsule)
      : from(capsule.start.cast<Wide>()), along(capsule.end.cast<Wide>() - capsule.start.cast<Wide>()) {}
  [[nodiscard]] WideVector at(Wide t) const { return from + t * along; }
  [[nodiscard]] Wide length2() const { return along.squaredNorm(); }
  /// The parameter of a point's foot on the line.
  [[nodiscard]] Wide foot(const WideVector& c) const { return length2() > 0 ? (c - from).dot(along) / length2() : 0; }
  [[nodiscard]] Wide clamped_foot(const WideVector& c) const { return std::clamp(foot(c), Wide{0}, Wide{1}); }
};

/// Calls change(first axis, second axis) of a question about capsules.
template <class Change>
void of_axes(const Query& q, Change change) {
  std::visit(
      [&]<class A, class B>(const Two<A, B>& shapes) {
        if constexpr (std::same_as<B, Capsule>) change(Axis(shapes.a), Axis(shapes.b));
      },
      q.shapes);
}
/// The same of a sphere and a capsule, with the centre.
template <class Change>
void of_center_and_axis(const Query& q, Change change) {
  if (q.pair == Pair::sphere_capsule) of_axes(q, [&](const Axis& a, const Axis& b) { change(a.from, b); });
}
/// The same of two capsules, neither of them a sphere.
template <class Change>
void of_two_axes(const Query& q, Change change) {
  if (q.pair != Pair::capsule_capsule) return;
  of_axes(q, [&](const Axis& a, const Axis& b) {
    if (a.length2() > 0 && b.length2() > 0) change(a, b);
  });
}
/// s and t of the lines, where they are not parallel.
std::optional<std::array<Wide, 2>> on_lines(const Axis& a, const Axis& b) {
  const WideVector w = b.from - a.from;
  const WideVector n = a.along.cross(b.along);
  const Wide n2 = n.squaredNorm();
  if (!(n2 > 0)) return std::nullopt;
  return std::array{w.cross(b.along).dot(n) / n2, w.cross(a.along).dot(n) / n2};
}
Wide unit_clamp(Wide t) { return std::clamp(t, Wide{0}, Wide{1}); }

/// Where axes whose determinant is below a limit count as parallel: from the start of the first.
void parallel_below(const Query& q, Claim& claim, Wide limit) {
  of_two_axes(q, [&](const Axis& a, const Axis& b) {
    const Wide determinant = a.along.cross(b.along).squaredNorm();  // |u|^2 |v|^2 - (u.v)^2
    if (!(determinant < limit && determinant > 0)) return;
    const Wide t = b.clamped_foot(a.from);
    answer_at(q, claim, a.at(a.clamped_foot(b.at(t))), b.at(t));
  });
}

/// Changes the capsules of a question, one after the other.
template <class Change>
void each_capsule(Query& q, Change change) {
  std::visit(
      [&]<class A, class B>(Two<A, B>& shapes) {
        if constexpr (std::same_as<A, Capsule>) change(shapes.a);
        if constexpr (std::same_as<B, Capsule>) change(shapes.b);
      },
      q.shapes);
}
/// An axis `factor` times as long, around its middle.
void stretch(Capsule& capsule, double factor) {
  const Vector3 middle = capsule.start / 2 + capsule.end / 2;
  const Vector3 half = factor * (capsule.end / 2 - capsule.start / 2);
  capsule.start = middle - half;
  capsule.end = middle + half;
}

const BallAndBox* in_box(const Query& q) { return std::get_if<BallAndBox>(&q.shapes); }
BallAndBox* in_box(Query& q) { return std::get_if<BallAndBox>(&q.shapes); }
/// Whether a centre is in a box, with a depth above 0.
bool is_inside(const Query& q) {
  return in_box(q) != nullptr && coincident(q) &&
         !oracle::truth_with(q, oracle::Side::at, oracle::Side::at).coincident();
}
/// The depth of a centre below a face.
Wide depth_below(const BallAndBox& shapes, Eigen::Index axis, bool is_min) {
  const Wide c = shapes.a.center[axis];
  return is_min ? c - static_cast<Wide>(shapes.b.min[axis]) : static_cast<Wide>(shapes.b.max[axis]) - c;
}
/// Out of the box through another face.
void leave_by(const Query& q, Claim& claim, Eigen::Index axis, bool is_min) {
  const BallAndBox& shapes = *in_box(q);
  in_contact(claim, [&](ContactClaim& c) {
    c.normal = Vector3(Vector3::Unit(axis) * (is_min ? 1.0 : -1.0));
    c.point1 = Vector3(shapes.a.center + shapes.a.radius * *c.normal);
    c.point2 = shapes.a.center;
    (*c.point2)[axis] = is_min ? shapes.b.min[axis] : shapes.b.max[axis];
    c.value = rounded(-shapes.a.radius - depth_below(shapes, axis, is_min) - static_cast<Wide>(q.distances.contact));
  });
}
/// The face that `better` prefers by depth, of those that `allowed` names.
template <class Allowed, class Better>
void leave_by_best(const Query& q, Claim& claim, Allowed allowed, Better better) {
  if (!is_inside(q)) return;
  std::optional<std::pair<Eigen::Index, bool>> best;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    for (const bool is_min : {true, false})
      if (allowed(axis, is_min) &&
          (!best || better(depth_below(*in_box(q), axis, is_min), depth_below(*in_box(q), best->first, best->second))))
        best = {axis, is_min};
  leave_by(q, claim, best->first, best->second);
}
/// Another point of the box.
template <class PointOf>
void other_point_of_box(const Query& q, Claim& claim, PointOf point_of, std::optional<Wide> radius2 = {}) {
  const BallAndBox* shapes = in_box(q);
  if (shapes == nullptr) return;
  const WideVector c = shapes->a.center.cast<Wide>();
  answer_at(q, claim, c, point_of(c, shapes->b.min.cast<Wide>().eval(), shapes->b.max.cast<Wide>().eval()), radius2);
}
/// A box `factor` times as large, around its middle.
void resize(Query& q, double factor) {
  if (BallAndBox* shapes = in_box(q)) {
    Box& box = shapes->b;
    const Vector3 middle = box.min / 2 + box.max / 2;
    const Vector3 half = factor * (box.max / 2 - box.min / 2);
    box = {middle - half, middle + half};
  }
}

const std::array kFeatures{
    // Capsules.
    Mutant{"mjx-segment-1e-6", "the parameter of the foot is divided by |u|^2 + 1e-6, against a division by 0",
           "parameter-divided-by-length-plus-1e-6", nullptr,
           [](const Query& q, Claim& claim) {
             of_center_and_axis(q, [&](const WideVector& c, const Axis& axis) {
               const Wide t = (c - axis.from).dot(axis.along) / (axis.length2() + 1e-6L);
               answer_at(q, claim, c, axis.at(unit_clamp(t)));
             });
           },
           "https://github.com/google-deepmind/mujoco/blob/main/mjx/mujoco/mjx/_src/math.py"},
    Mutant{"sofa-capsule-clamps-alone", "both parameters are clamped, each alone", "parameters-clamped-alone", nullptr,
           [](const Query& q, Claim& claim) {
             of_two_axes(q, [&](const Axis& a, const Axis& b) {
               if (const auto at = on_lines(a, b))
                 answer_at(q, claim, a.at(unit_clamp((*at)[0])), b.at(unit_clamp((*at)[1])));
             });
           },
           "https://github.com/sofa-framework/sofa/blob/master/applications/plugins/CollisionOBBCapsule/src/"
           "CollisionOBBCapsule/detection/intersection/CapsuleIntTool.inl"},
    Mutant{"sofa-capsule-determinant", "axes count as parallel where an unscaled determinant is below 1e-15",
           "parallel-within-1e-15", nullptr, [](const Query& q, Claim& claim) { parallel_below(q, claim, 1e-15L); },
           "https://github.com/sofa-framework/sofa/blob/master/applications/plugins/CollisionOBBCapsule/src/"
           "CollisionOBBCapsule/detection/intersection/CapsuleIntTool.inl"},
    Mutant{"sofa-ray-pythagoras", "the squared distance is |w|^2 - t^2 with t clamped to the length",
           "distance-by-clamped-pythagoras", nullptr,
           [](const Query& q, Claim& claim) {
             of_center_and_axis(q, [&](const WideVector& c, const Axis& axis) {
               if (!(axis.length2() > 0) || axis.foot(c) <= 1) return;  // within the length both are the same
               const WideVector w = c - axis.from;
               const Wide t = std::sqrt(axis.length2());
               const Wide distance = std::sqrt(std::max(Wide{0}, w.squaredNorm() - t * t));
               const WideSpheres right(q);
               decide(q, claim, distance <= right.reach);
               in_contact(claim,
                          [&](ContactClaim& k) { k.value = rounded(distance - right.r1 - right.r2 - right.contact); });
             });
           },
           "https://github.com/sofa-framework/sofa/tree/master/Sofa/Component/Collision/Detection/Intersection"},
    Mutant{"capsule-not-clamped", "the foot is taken on the line, however long the axis is", "capsule-as-line", nullptr,
           [](const Query& q, Claim& claim) {
             of_center_and_axis(
                 q, [&](const WideVector& c, const Axis& axis) { answer_at(q, claim, c, axis.at(axis.foot(c))); });
             of_two_axes(q, [&](const Axis& a, const Axis& b) {
               if (const auto at = on_lines(a, b)) answer_at(q, claim, a.at((*at)[0]), b.at((*at)[1]));
             });
           }},
    Mutant{"capsule-start-only", "a capsule is the sphere at its start", "capsule-by-start",
           [](Query& q) { each_capsule(q, [](Capsule& c) { c.end = c.start; }); }},
    Mutant{"capsule-middle-only", "a capsule is the sphere in its middle", "capsule-by-middle",
           [](Query& q) { each_capsule(q, [](Capsule& c) { c.start = c.end = Vector3(c.start / 2 + c.end / 2); }); }},
    Mutant{"capsule-ends-only", "the ends of both axes are tried, and nothing between", "capsule-by-ends", nullptr,
           [](const Query& q, Claim& claim) {
             of_axes(q, [&](const Axis& a, const Axis& b) {
               std::array<Wide, 2> best{0, 0};
               for (const Wide s : {Wide{0}, Wide{1}})
                 for (const Wide t : {Wide{0}, Wide{1}})
                   if ((b.at(t) - a.at(s)).squaredNorm() < (b.at(best[1]) - a.at(best[0])).squaredNorm()) best = {s, t};
               answer_at(q, claim, a.at(best[0]), b.at(best[1]));
             });
           }},
    Mutant{"capsule-second-clamp", "where the second parameter is clamped the first is not computed again",
           "second-clamp-missing", nullptr,
           [](const Query& q, Claim& claim) {
             of_two_axes(q, [&](const Axis& a, const Axis& b) {
               const auto at = on_lines(a, b);
               if (!at) return;
               const WideVector p = a.at(unit_clamp((*at)[0]));
               answer_at(q, claim, p, b.at(b.clamped_foot(p)));
             });
           }},
    Mutant{"capsule-no-edge-edge",
           "ends are tried against axes, and never the side of one against the side of the other",
           "ends-against-axes-only", nullptr,
           [](const Query& q, Claim& claim) {
             of_two_axes(q, [&](const Axis& a, const Axis& b) {
               std::optional<std::array<WideVector, 2>> best;
               const auto attempt = [&](const WideVector& p, const WideVector& r) {
                 if (!best || (r - p).squaredNorm() < ((*best)[1] - (*best)[0]).squaredNorm()) best = {p, r};
               };
               for (const Wide end : {Wide{0}, Wide{1}}) attempt(a.at(end), b.at(b.clamped_foot(a.at(end))));
               for (const Wide end : {Wide{0}, Wide{1}}) attempt(a.at(a.clamped_foot(b.at(end))), b.at(end));
               if (on_lines(a, b)) answer_at(q, claim, (*best)[0], (*best)[1]);
             });
           }},
    Mutant{"capsule-projection-undivided",
           "the projection on the axis is taken for the parameter, as if its length were 1", "direction-not-divided",
           nullptr,
           [](const Query& q, Claim& claim) {
             of_center_and_axis(q, [&](const WideVector& c, const Axis& axis) {
               answer_at(q, claim, c, axis.at(unit_clamp((c - axis.from).dot(axis.along))));
             });
           }},
    Mutant{"capsule-determinant-1e-6", "axes count as parallel where an unscaled determinant is below 1e-6",
           "parallel-within-1e-6", nullptr, [](const Query& q, Claim& claim) { parallel_below(q, claim, 1e-6L); }},
    Mutant{"capsule-half-length", "half of the length is taken for the length", "half-length-for-length",
           [](Query& q) { each_capsule(q, [](Capsule& c) { stretch(c, 0.5); }); }},
    Mutant{"capsule-double-length", "the length is taken for its half", "length-for-half-length",
           [](Query& q) { each_capsule(q, [](Capsule& c) { stretch(c, 2); }); }},

    // A sphere and a box.
    Mutant{"box-corner-only", "the nearest corner is taken for the nearest point", "box-nearest-corner", nullptr,
           [](const Query& q, Claim& claim) {
             other_point_of_box(q, claim, [](const WideVector& c, const WideVector& min, const WideVector& max) {
               WideVector corner = max;
               for (Eigen::Index i = 0; i < 3; ++i)
                 if (c[i] - min[i] < max[i] - c[i]) corner[i] = min[i];
               return corner;
             });
           }},
    Mutant{"box-middle-only", "the middle of the box is taken for the nearest point", "box-middle", nullptr,
           [](const Query& q, Claim& claim) {
             other_point_of_box(q, claim, [](const WideVector&, const WideVector& min, const WideVector& max) {
               return WideVector((min + max) / 2);
             });
           }},
    Mutant{"box-max-only", "the centre is clamped to the upper bounds alone", "box-lower-bound-ignored", nullptr,
           [](const Query& q, Claim& claim) {
             other_point_of_box(q, claim, [](const WideVector& c, const WideVector&, const WideVector& max) {
               return WideVector(c.cwiseMin(max));
             });
           }},
    Mutant{"box-min-only", "the centre is clamped to the lower bounds alone", "box-upper-bound-ignored", nullptr,
           [](const Query& q, Claim& claim) {
             other_point_of_box(q, claim, [](const WideVector& c, const WideVector& min, const WideVector&) {
               return WideVector(c.cwiseMax(min));
             });
           }},
    Mutant{"box-half-size", "half of the size is taken for the size", "box-half-for-size",
           [](Query& q) { resize(q, 0.5); }},
    Mutant{"box-double-size", "the size is taken for its half", "box-size-for-half", [](Query& q) { resize(q, 2); }},
    Mutant{"box-bounding-sphere", "the box is taken for the sphere around it", "box-as-sphere", nullptr,
           [](const Query& q, Claim& claim) {
             if (const BallAndBox* shapes = in_box(q))
               other_point_of_box(
                   q, claim,
                   [](const WideVector&, const WideVector& min, const WideVector& max) {
                     return WideVector((min + max) / 2);
                   },
                   (shapes->b.max.cast<Wide>() - shapes->b.min.cast<Wide>()).norm() / 2);
           }},
    Mutant{"box-minkowski-box", "the box is blown up by the reach, and its corners stay sharp",
           "box-corners-not-rounded", nullptr,
           [](const Query& q, Claim& claim) {
             if (in_box(q) == nullptr) return;
             const WideSpheres s(q);
             const Wide widest = std::max({std::abs(s.d[0]), std::abs(s.d[1]), std::abs(s.d[2])});
             if (widest < s.reach) decide(q, claim, true);
           }},
    Mutant{"box-surface-only", "a centre inside the box is no hit", "box-inside-missed", nullptr,
           [](const Query& q, Claim& claim) {
             if (is_inside(q)) decide(q, claim, false);
           }},
    Mutant{"box-no-depth", "the depth of a centre inside is left out of the value", "box-depth-ignored", nullptr,
           [](const Query& q, Claim& claim) {
             if (is_inside(q)) in_contact(claim, [&](ContactClaim& c) { c.value = rounded(WideSpheres(q).value()); });
           }},
    Mutant{"box-depth-sign", "the depth of a centre inside is added", "box-depth-added", nullptr,
           [](const Query& q, Claim& claim) {
             if (!is_inside(q)) return;
             const Wide without = WideSpheres(q).value();
             in_contact(claim, [&](ContactClaim& c) { c.value = rounded(2 * without - static_cast<Wide>(*c.value)); });
           }},
    Mutant{"box-point-stays", "the contact point of the box is a centre inside it", "box-point-inside", nullptr,
           [](const Query& q, Claim& claim) {
             if (is_inside(q)) in_contact(claim, [&](ContactClaim& c) { c.point2 = in_box(q)->a.center; });
           }},
    Mutant{"box-far-face", "a centre inside leaves through the farthest face", "box-farthest-face", nullptr,
           [](const Query& q, Claim& claim) {
             leave_by_best(
                 q, claim, [](Eigen::Index, bool) { return true; }, std::greater<>());
           }},
    Mutant{"box-x-axis-first", "a centre inside leaves along x", "box-first-axis", nullptr,
           [](const Query& q, Claim& claim) {
             leave_by_best(
                 q, claim, [](Eigen::Index axis, bool) { return axis == 0; }, std::less<>());
           }},
    Mutant{"box-max-faces", "a centre inside leaves through an upper face", "box-upper-faces-only", nullptr,
           [](const Query& q, Claim& claim) {
             leave_by_best(
                 q, claim, [](Eigen::Index, bool is_min) { return !is_min; }, std::less<>());
           }},
    Mutant{"box-outward", "the normal of a centre inside points out of the box", "box-normal-outward", nullptr,
           [](const Query& q, Claim& claim) {
             if (is_inside(q)) in_contact(claim, [](ContactClaim& c) { c.normal = Vector3(-*c.normal); });
           }},
};

}  // namespace

std::span<const Mutant> feature_mutants() { return kFeatures; }

}  // namespace contact::engines
