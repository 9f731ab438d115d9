// Mistakes about the half-space below a plane.
#include <Eigen/Geometry>

#include "engines/zoo/mutating.hpp"

namespace contact::engines {
namespace {

/// A question with a plane: the lowest point of the other shape, and the plane in wide arithmetic.
struct Over {
  Wide3 p;
  Wide3 up;  ///< the normal, of length 1
  Wide length;
  Wide offset;  ///< divided by that
  Wide radius;
  Wide alarm;
  Wide contact;

  Over(const WideSpheres& s, const Plane& plane)
      : p(s.c1[0], s.c1[1], s.c1[2]), radius(s.r1), alarm(s.alarm), contact(s.contact) {
    const auto normal = plane.normal.cast<Wide>();
    length = normal.norm();
    up = normal / length;
    offset = plane.offset / length;
  }
  [[nodiscard]] Wide height() const { return up.dot(p) - offset; }
};
/// Calls change(over) of a question with a plane.
template <class Change>
void of_plane(const Query& q, Change change) {
  std::visit(
      [&]<class A, class B>(const Two<A, B>& shapes) {
        if constexpr (std::same_as<B, Plane>) change(Over(WideSpheres(q), shapes.b));
      },
      q.shapes);
}
/// Changes the plane below a ball, a capsule or a ray: of any two convex shapes their causes say nothing.
template <class Part>
constexpr auto replane(Part) {
  static_assert(std::is_empty_v<Part>);
  return [](Query& q) {
    std::visit(
        []<class A, class B>(Two<A, B>& shapes) {
          if constexpr (std::same_as<B, Plane>) Part{}(shapes.b);
        },
        q.shapes);
  };
}
/// The answer of a lowest point, a normal and a distance along it.
void answer_along(const Query& q, Claim& claim, const Over& over, const Wide3& p, const Wide3& n, Wide distance) {
  decide(q, claim, distance <= over.radius + over.alarm);
  in_contact(claim, [&](ContactClaim& c) {
    c.normal = Vector3(n.cast<double>());
    c.point1 = Vector3((p + over.radius * n).cast<double>());
    c.point2 = Vector3((p + distance * n).cast<double>());
    c.value = rounded(distance - over.radius - over.contact);
  });
}

const std::array kPlanes{
    Mutant{"bevy-plane-not-divided", "the decision takes the normal for a unit vector", "plane-decision-not-divided",
           nullptr,
           [](const Query& q, Claim& claim) {
             of_plane(q, [&](const Over& over) {
               decide(q, claim, over.height() * over.length <= over.radius + over.alarm);
             });
           },
           "https://github.com/bevyengine/bevy/pull/4035"},
    Mutant{"plane-not-divided", "the normal is taken for a unit vector", "plane-normal-not-divided", nullptr,
           [](const Query& q, Claim& claim) {
             of_plane(q, [&](const Over& over) {
               if (over.length != 1)
                 answer_along(q, claim, over, over.p, -over.length * over.up, over.height() * over.length);
             });
           }},
    Mutant{"plane-offset-not-divided", "the normal is divided by its length, and the offset is not",
           "plane-offset-not-divided", replane([](Plane& plane) {
             const double offset = rounded(plane.offset * plane.normal.cast<Wide>().norm());
             if (std::isfinite(offset)) plane.offset = offset;
           })},
    Mutant{"three-plane-constant", "the decision is |normal . c + offset|: another sign, and either side",
           "plane-constant-sign", nullptr,
           [](const Query& q, Claim& claim) {
             of_plane(q, [&](const Over& over) {
               decide(q, claim, std::abs(over.height() + 2 * over.offset) <= over.radius + over.alarm);
             });
           },
           "https://github.com/mrdoob/three.js/pull/11819"},
    Mutant{"plane-offset-sign", "the offset has the other sign: normal . x + offset = 0", "plane-offset-negative",
           replane([](Plane& plane) { plane.offset = 0 - plane.offset; })},
    Mutant{"plane-through-origin", "a plane goes through the origin", "plane-offset-ignored",
           replane([](Plane& plane) { plane.offset = 0; })},
    Mutant{"plane-two-sided", "a plane is a sheet: what is below is as far as what is above", "plane-two-sided",
           nullptr,
           [](const Query& q, Claim& claim) {
             of_plane(q, [&](const Over& over) {
               if (WideSpheres(q).distance < 0) answer_along(q, claim, over, over.p, over.up, -over.height());
             });
           }},
    Mutant{"sceneview-plane-mirrored", "below the plane, the contact point on it is mirrored at the centre",
           "plane-point-mirrored", nullptr,
           [](const Query& q, Claim& claim) {
             of_plane(q, [&](const Over& over) {
               if (!(WideSpheres(q).distance < 0)) return;
               in_contact(claim, [&](ContactClaim& c) {
                 c.point2 = Vector3((over.p + over.height() * over.up).cast<double>());
               });
             });
           },
           "https://github.com/sceneview/sceneview/issues/1097"},
    Mutant{"plane-below-missed", "a centre below the plane is never hit", "plane-below-missed", nullptr,
           [](const Query& q, Claim& claim) {
             of_plane(q, [&](const Over&) {
               if (WideSpheres(q).distance < 0) decide(q, claim, false);
             });
           }},
    Mutant{"plane-depth-missing", "below the plane the value is that on it", "plane-depth-missing", nullptr,
           [](const Query& q, Claim& claim) {
             of_plane(q, [&](const Over& over) {
               if (!(WideSpheres(q).distance < 0)) return;
               in_contact(claim, [&](ContactClaim& c) { c.value = rounded(-over.radius - over.contact); });
             });
           }},
    Mutant{"plane-other-end", "the higher end of a capsule is taken for the lower", "plane-other-end", nullptr,
           [](const Query& q, Claim& claim) {
             const auto* shapes = std::get_if<CapsuleAndPlane>(&q.shapes);
             if (shapes == nullptr) return;
             of_plane(q, [&](const Over& over) {
               const Wide3 start = shapes->a.start.cast<Wide>();
               const Wide3 end = shapes->a.end.cast<Wide>();
               if (over.p != start && over.p != end) return;
               const Wide3 other = over.p == start ? end : start;
               if (other == over.p) return;
               const Wide s = over.height() + std::abs(over.up.dot(end - start));
               answer_along(q, claim, over, other, -over.up, s);
             });
           }},
};

}  // namespace

std::span<const Mutant> plane_mutants() { return kPlanes; }

}  // namespace contact::engines
