// Mistakes about capsules, rays and triangles: another point taken for the nearest one.
#include <Eigen/Geometry>

#include "engines/zoo/mutating.hpp"

namespace contact::engines {
namespace {

/// An axis, from + t along.
struct Axis {
  Wide3 from;
  Wide3 along;

  explicit Axis(const Ball& ball) : from(ball.center.cast<Wide>()), along(Wide3::Zero()) {}
  explicit Axis(const Ray& ray) : from(ray.origin.cast<Wide>()), along(Wide{ray.length} * ray.direction.cast<Wide>()) {}
  explicit Axis(const Capsule& capsule)
      : from(capsule.start.cast<Wide>()), along(capsule.end.cast<Wide>() - capsule.start.cast<Wide>()) {}
  [[nodiscard]] Wide3 at(Wide t) const { return from + t * along; }
  [[nodiscard]] Wide length2() const { return along.squaredNorm(); }
  /// The parameter of a point's foot on the line.
  [[nodiscard]] Wide foot(const Wide3& c) const { return length2() > 0 ? (c - from).dot(along) / length2() : 0; }
  [[nodiscard]] Wide clamped_foot(const Wide3& c) const { return std::clamp(foot(c), Wide{0}, Wide{1}); }
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
/// The same of a sphere and a capsule, or a ray and a sphere, with the centre.
template <class Change>
void of_center_and_axis(const Query& q, Change change) {
  if (q.pair == Pair::sphere_capsule) of_axes(q, [&](const Axis& a, const Axis& b) { change(a.from, b); });
  if (const auto* shapes = std::get_if<RayAndBall>(&q.shapes))
    change(shapes->b.center.cast<Wide>().eval(), Axis(shapes->a));
}
/// The answer at a point of an axis.
void answer_at_foot(const Query& q, Claim& claim, const Wide3& center, const Wide3& point) {
  if (std::holds_alternative<RayAndBall>(q.shapes))
    answer_at(q, claim, point, center);
  else
    answer_at(q, claim, center, point);
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
  const Wide3 w = b.from - a.from;
  const Wide3 n = a.along.cross(b.along);
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

/// An axis `factor` times as long, around its middle.
void stretch(Capsule& capsule, double factor) {
  const Vector3 middle = capsule.start / 2 + capsule.end / 2;
  const Vector3 half = factor * (capsule.end / 2 - capsule.start / 2);
  capsule.start = middle - half;
  capsule.end = middle + half;
}

/// A triangle from a centre: its vertices, its normal, and how far inside of each edge the foot on its plane lies.
struct Seen {
  Wide3 c;
  std::array<Wide3, 3> w;
  Wide3 n;
  std::array<Wide, 3> over_edge;

  explicit Seen(const BallAndTriangle& shapes) : c(shapes.a.center.cast<Wide>()) {
    for (std::size_t k = 0; k < 3; ++k) w[k] = shapes.b.vertices[k].cast<Wide>() - c;
    n = (w[1] - w[0]).cross(w[2] - w[0]);
    for (std::size_t k = 0; k < 3; ++k) over_edge[k] = n.dot(w[k].cross(w[(k + 1) % 3]));
  }
  [[nodiscard]] bool is_flat() const { return !(n.squaredNorm() > 0); }
  [[nodiscard]] bool is_over_face() const {
    return !is_flat() && *std::min_element(over_edge.begin(), over_edge.end()) >= 0;
  }
  [[nodiscard]] Wide3 foot_on_plane() const { return n * (n.dot(w[0]) / n.squaredNorm()); }
  [[nodiscard]] Wide3 foot_on_edge(std::size_t k, bool clamped) const {
    const Wide3 u = w[(k + 1) % 3] - w[k];
    const Wide t = u.squaredNorm() > 0 ? -w[k].dot(u) / u.squaredNorm() : 0;
    return w[k] + (clamped ? unit_clamp(t) : t) * u;
  }
  [[nodiscard]] static Wide3 nearest(std::initializer_list<Wide3> points) {
    return *std::min_element(points.begin(), points.end(),
                             [](const Wide3& x, const Wide3& y) { return x.squaredNorm() < y.squaredNorm(); });
  }
};
/// Calls change(seen) of a question about a triangle.
template <class Change>
void of_triangle(const Query& q, Change change) {
  if (const auto* shapes = std::get_if<BallAndTriangle>(&q.shapes)) change(Seen(*shapes));
}
/// Another nearest point, from the centre; nothing leaves it as it is.
constexpr auto other_point = [](const Query& q, Claim& claim, auto point_of) {
  of_triangle(q, [&](const Seen& seen) {
    if (const std::optional<Wide3> point = point_of(seen)) answer_at(q, claim, seen.c, seen.c + *point);
  });
};
/// A miss in some places.
constexpr auto missed = [](const Query& q, Claim& claim, auto there) {
  of_triangle(q, [&](const Seen& seen) {
    if (claim.overlap.value_or(false) && there(seen)) decide(q, claim, false);
  });
};
using Point = std::optional<Wide3>;

}  // namespace

void clamp_each_alone(const Query& q, Claim& claim) {
  of_two_axes(q, [&](const Axis& a, const Axis& b) {
    if (const auto at = on_lines(a, b)) answer_at(q, claim, a.at(unit_clamp((*at)[0])), b.at(unit_clamp((*at)[1])));
  });
}

void take_direction_for_unit(const Query& q, Claim& claim) {
  const auto* shapes = std::get_if<RayAndBall>(&q.shapes);
  if (shapes == nullptr) return;
  const Wide3 u = shapes->a.direction.cast<Wide>();
  const Wide3 origin = shapes->a.origin.cast<Wide>();
  const Wide3 c = shapes->b.center.cast<Wide>();
  const Wide t = std::clamp((c - origin).dot(u), Wide{0}, Wide{shapes->a.length});
  answer_at(q, claim, origin + t * u, c);
}

namespace {

const std::array kFeatures{
    Mutant{"mjx-segment-1e-6", "the parameter of the foot is divided by |u|^2 + 1e-6, against a division by 0",
           "parameter-divided-by-length-plus-1e-6", nullptr,
           [](const Query& q, Claim& claim) {
             of_center_and_axis(q, [&](const Wide3& c, const Axis& axis) {
               const Wide t = (c - axis.from).dot(axis.along) / (axis.length2() + 1e-6L);
               answer_at_foot(q, claim, c, axis.at(unit_clamp(t)));
             });
           },
           "https://github.com/google-deepmind/mujoco/blob/main/mjx/mujoco/mjx/_src/math.py"},
    Mutant{"sofa-capsule-clamps-alone", "both parameters are clamped, each alone", "parameters-clamped-alone", nullptr,
           clamp_each_alone,
           "https://github.com/sofa-framework/sofa/blob/master/applications/plugins/CollisionOBBCapsule/src/"
           "CollisionOBBCapsule/detection/intersection/CapsuleIntTool.inl"},
    Mutant{"sofa-capsule-determinant", "axes count as parallel where an unscaled determinant is below 1e-15",
           "parallel-within-1e-15", nullptr, [](const Query& q, Claim& claim) { parallel_below(q, claim, 1e-15L); },
           "https://github.com/sofa-framework/sofa/blob/master/applications/plugins/CollisionOBBCapsule/src/"
           "CollisionOBBCapsule/detection/intersection/CapsuleIntTool.inl"},
    Mutant{
        "sofa-ray-pythagoras", "the squared distance is |w|^2 - t^2 with t clamped to the length",
        "distance-by-clamped-pythagoras", nullptr,
        [](const Query& q, Claim& claim) {
          of_center_and_axis(q, [&](const Wide3& c, const Axis& axis) {
            if (!(axis.length2() > 0) || axis.foot(c) <= 1) return;  // within the length both are the same
            const Wide3 w = c - axis.from;
            const Wide t = std::sqrt(axis.length2());
            const Wide distance = std::sqrt(std::max(Wide{0}, w.squaredNorm() - t * t));
            const WideSpheres right(q);
            decide(q, claim, distance <= right.reach);
            in_contact(claim,
                       [&](ContactClaim& k) { k.value = rounded(distance - right.r1 - right.r2 - right.contact); });
          });
        },
        "https://github.com/sofa-framework/sofa/blob/master/Sofa/Component/Collision/Detection/Intersection/src/sofa/"
        "component/collision/detection/intersection/RayDiscreteIntersection.inl"},
    Mutant{"capsule-not-clamped", "the foot is taken on the line, however long the axis is", "capsule-as-line", nullptr,
           [](const Query& q, Claim& claim) {
             of_center_and_axis(
                 q, [&](const Wide3& c, const Axis& axis) { answer_at_foot(q, claim, c, axis.at(axis.foot(c))); });
             of_two_axes(q, [&](const Axis& a, const Axis& b) {
               if (const auto at = on_lines(a, b)) answer_at(q, claim, a.at((*at)[0]), b.at((*at)[1]));
             });
           }},
    Mutant{"capsule-start-only", "a capsule is the sphere at its start", "capsule-by-start",
           each<Capsule>([](Capsule& c) { c.end = c.start; })},
    Mutant{"capsule-middle-only", "a capsule is the sphere in its middle", "capsule-by-middle",
           each<Capsule>([](Capsule& c) { c.start = c.end = Vector3(c.start / 2 + c.end / 2); })},
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
               const Wide3 p = a.at(unit_clamp((*at)[0]));
               answer_at(q, claim, p, b.at(b.clamped_foot(p)));
             });
           }},
    Mutant{"capsule-no-edge-edge",
           "ends are tried against axes, and never the side of one against the side of the other",
           "ends-against-axes-only", nullptr,
           [](const Query& q, Claim& claim) {
             of_two_axes(q, [&](const Axis& a, const Axis& b) {
               std::optional<std::array<Wide3, 2>> best;
               const auto attempt = [&](const Wide3& p, const Wide3& r) {
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
             of_center_and_axis(q, [&](const Wide3& c, const Axis& axis) {
               answer_at_foot(q, claim, c, axis.at(unit_clamp((c - axis.from).dot(axis.along))));
             });
           }},
    Mutant{"capsule-determinant-1e-6", "axes count as parallel where an unscaled determinant is below 1e-6",
           "parallel-within-1e-6", nullptr, [](const Query& q, Claim& claim) { parallel_below(q, claim, 1e-6L); }},
    Mutant{"capsule-half-length", "half of the length is taken for the length", "half-length-for-length",
           each<Capsule>([](Capsule& c) { stretch(c, 0.5); })},
    Mutant{"capsule-double-length", "the length is taken for its half", "length-for-half-length",
           each<Capsule>([](Capsule& c) { stretch(c, 2); })},
    Mutant{"ray-endless", "a ray has no end", "ray-without-end", nullptr,
           [](const Query& q, Claim& claim) {
             if (!std::holds_alternative<RayAndBall>(q.shapes)) return;
             of_center_and_axis(q, [&](const Wide3& c, const Axis& axis) {
               answer_at_foot(q, claim, c, axis.at(std::max(Wide{0}, axis.foot(c))));
             });
           }},
    Mutant{"ray-length-in-units", "the length of a ray is counted in units, and not in directions",
           "ray-direction-normalised", change<RayAndBall>([](RayAndBall& shapes) {
             shapes.a.length = rounded(shapes.a.length / shapes.a.direction.cast<Wide>().norm());
           })},
    Mutant{
        "sofa-ray-unit-direction", "the direction of a ray is taken for a unit vector", "ray-direction-unit", nullptr,
        take_direction_for_unit,
        "https://github.com/sofa-framework/sofa/blob/master/Sofa/Component/Collision/Detection/Intersection/src/sofa/"
        "component/collision/detection/intersection/RayDiscreteIntersection.inl"},

    // A sphere and a triangle.
    Mutant{
        "sofa-triangle-face-only", "edges and vertices are ignored: a hit where the foot is on the face",
        "triangle-face-only", nullptr, with(missed, [](const Seen& seen) { return !seen.is_over_face(); }),
        "https://github.com/sofa-framework/sofa/blob/master/Sofa/Component/Collision/Detection/Intersection/src/sofa/"
        "component/collision/detection/intersection/MeshDiscreteIntersection.inl"},
    Mutant{
        "sofa-triangle-value", "the value is minus the distance of the surfaces", "triangle-value-negated", nullptr,
        [](const Query& q, Claim& claim) {
          of_triangle(q, [&](const Seen&) {
            const WideSpheres right(q);
            in_contact(claim, [&](ContactClaim& c) { c.value = rounded(right.r1 - right.distance); });
          });
        },
        "https://github.com/sofa-framework/sofa/blob/master/Sofa/Component/Collision/Detection/Intersection/src/sofa/"
        "component/collision/detection/intersection/MeshDiscreteIntersection.inl"},
    Mutant{
        "sofa-triangle-1e-5", "a face up to 1e-5 away counts as touched, whatever the units", "triangle-within-1e-5",
        nullptr,
        [](const Query& q, Claim& claim) {
          of_triangle(q, [&](const Seen& seen) {
            const WideSpheres right(q);
            if (seen.is_over_face() && right.distance <= right.reach + 1e-5L) decide(q, claim, true);
          });
        },
        "https://github.com/sofa-framework/sofa/blob/master/Sofa/Component/Collision/Detection/Intersection/src/sofa/"
        "component/collision/detection/intersection/MeshDiscreteIntersection.inl"},
    Mutant{
        "sofa-triangle-winding", "the normal is that of the vertices' order, whichever side the sphere is on",
        "triangle-normal-of-winding", nullptr,
        [](const Query& q, Claim& claim) {
          of_triangle(q, [&](const Seen& seen) {
            if (seen.is_flat()) return;
            in_direction(q, claim, [&](ContactClaim& c) { c.normal = Vector3((-seen.n.normalized()).cast<double>()); });
          });
        },
        "https://github.com/sofa-framework/sofa/blob/master/Sofa/Component/Collision/Detection/Intersection/src/sofa/"
        "component/collision/detection/intersection/MeshDiscreteIntersection.inl"},
    Mutant{"triangle-barycentric-1e-5", "a foot within 1e-5 of an edge, in barycentric coordinates, counts as beside",
           "triangle-edge-within-1e-5", nullptr,
           with(missed,
                [](const Seen& seen) {
                  const Wide least = *std::min_element(seen.over_edge.begin(), seen.over_edge.end());
                  return !seen.is_flat() && least < 1e-5L * seen.n.squaredNorm();
                })},
    Mutant{"triangle-no-vertices", "faces and edges are hit, and vertices are not", "triangle-vertices-ignored",
           nullptr,
           [](const Query& q, Claim& claim) {
             missed(q, claim, [&](const Seen& seen) {
               const Wide3 nearest = wide_balls(q)[1].center - seen.c;
               return nearest == seen.w[0] || nearest == seen.w[1] || nearest == seen.w[2];
             });
           }},
    Mutant{"triangle-back-culled", "a triangle is hit from the side of its normal alone", "triangle-one-sided", nullptr,
           with(missed, [](const Seen& seen) { return seen.n.dot(seen.w[0]) > 0; })},
    Mutant{"triangle-flat-dropped", "a triangle without an inside is never hit", "triangle-flat-missed", nullptr,
           with(missed, [](const Seen& seen) { return seen.is_flat(); })},
    Mutant{"triangle-area-1e-6", "a triangle whose doubled area is below 1e-6 is never hit", "triangle-area-1e-6",
           nullptr, with(missed, [](const Seen& seen) { return seen.n.squaredNorm() < 1e-12L; })},
    Mutant{"triangle-plane", "the foot on the plane is taken, wherever the triangle is", "triangle-as-plane", nullptr,
           [](const Query& q, Claim& claim) {
             other_point(q, claim,
                         [](const Seen& seen) { return seen.is_flat() ? Point() : Point(seen.foot_on_plane()); });
           }},
    Mutant{"triangle-edges-only", "the edges are tried, and the face is not", "triangle-as-edges", nullptr,
           with(other_point,
                [](const Seen& seen) {
                  return Point(Seen::nearest(
                      {seen.foot_on_edge(0, true), seen.foot_on_edge(1, true), seen.foot_on_edge(2, true)}));
                })},
    Mutant{"triangle-nearest-vertex", "the nearest vertex is taken for the nearest point", "triangle-as-vertices",
           nullptr,
           with(other_point,
                [](const Seen& seen) {
                  return Point(Seen::nearest({seen.w[0], seen.w[1], seen.w[2]}));
                })},
    Mutant{"triangle-centroid", "the middle is taken for the nearest point", "triangle-by-centroid", nullptr,
           with(other_point, [](const Seen& seen) { return Point((seen.w[0] + seen.w[1] + seen.w[2]) / 3); })},
    Mutant{"triangle-first-vertex", "a triangle is its first vertex", "triangle-first-vertex",
           change<BallAndTriangle>([](BallAndTriangle& shapes) { shapes.b.vertices.fill(shapes.b.vertices[0]); })},
    Mutant{"triangle-edge-lines", "beside the face, the foot is taken on the line of an edge",
           "triangle-edge-not-clamped", nullptr,
           with(other_point,
                [](const Seen& seen) {
                  if (seen.is_over_face()) return Point();
                  return Point(Seen::nearest(
                      {seen.foot_on_edge(0, false), seen.foot_on_edge(1, false), seen.foot_on_edge(2, false)}));
                })},
    Mutant{"triangle-barycentric-clamp", "barycentric coordinates are clamped one by one", "triangle-weights-clamped",
           nullptr,
           with(other_point,
                [](const Seen& seen) {
                  if (seen.is_flat()) return Point();
                  Wide3 sum = Wide3::Zero();
                  Wide all = 0;
                  for (std::size_t k = 0; k < 3; ++k) {
                    const Wide weight = std::max(seen.over_edge[(k + 1) % 3], Wide{0});
                    sum += weight * seen.w[k];
                    all += weight;
                  }
                  return Point(sum / all);
                })},
    Mutant{"triangle-two-edges", "the edge from the last vertex to the first is never tried",
           "triangle-last-edge-forgotten", nullptr,
           with(other_point,
                [](const Seen& seen) {
                  if (seen.is_over_face()) return Point();
                  return Point(Seen::nearest({seen.foot_on_edge(0, true), seen.foot_on_edge(1, true)}));
                })},
    Mutant{"triangle-plane-distance", "the value is the distance to the plane", "triangle-distance-to-plane", nullptr,
           [](const Query& q, Claim& claim) {
             of_triangle(q, [&](const Seen& seen) {
               if (seen.is_flat()) return;
               const Wide distance = std::abs(seen.n.normalized().dot(seen.w[0]));
               const WideSpheres s(q);
               in_contact(claim, [&](ContactClaim& c) {
                 if (std::abs(distance - s.distance) > 1e-15L * seen.w[0].norm())
                   c.value = rounded(distance - s.r1 - s.contact);
               });
             });
           }},
};

}  // namespace

std::span<const Mutant> feature_mutants() { return kFeatures; }

}  // namespace contact::engines
