// Causes about the half-space below a plane: another plane taken for it, or the side that is inside it forgotten.
#include "oracle/diagnosis/formulas.hpp"

namespace contact::oracle::formulas {
namespace {

constexpr std::size_t kPlane = 1;

const Plane* plane_of(F f) {
  return std::visit(
      []<class A, class B>(const Two<A, B>& shapes) -> const Plane* {
        if constexpr (std::same_as<B, Plane>) return &shapes.b;
        return nullptr;
      },
      f.query.shapes);
}
bool is_below(F f) { return plane_of(f) != nullptr && f.distance < 0; }

/// The normal is up, of length 1, n = -up.
Numbers up(F f) { return times(-1, *f.inward); }
Real length_of(const Plane& plane) {
  const Numbers n = numbers_of(plane.normal);
  const Real size = largest_of(n);
  const Numbers shorter = times(1 / size, n);
  return size * std::sqrt(dot(shorter, shorter));
}

/// Another plane with the same normal: of the offset, divided by a length, and that length.
Cause at_offset(std::string_view id, std::string_view sentence, Real (*change)(Real offset, Real length)) {
  return edit(id, sentence, [change](Facts& f) {
    const Plane* plane = plane_of(f);
    if (plane == nullptr) return;
    const Real length = length_of(*plane);
    const Real s = dot(up(f), f.nearest[0]) - change(Real{plane->offset} / length, length);
    f.nearest[kPlane] = along(f.nearest[0], -s, up(f));
    f.settle();
  });
}

}  // namespace

std::vector<Cause> wrong_planes() {
  return {
      edit("plane-normal-not-divided", "the normal of a plane taken for a unit vector",
           [](Facts& f) {
             const Plane* plane = plane_of(f);
             if (plane == nullptr) return;
             const Numbers normal = numbers_of(plane->normal);
             f.distance = dot(normal, f.nearest[0]) - plane->offset;
             f.n = times(-1, normal);
             f.nearest[kPlane] = along(f.nearest[0], f.distance, f.n);
           }),
      decision("plane-decision-not-divided",
               "decision of a plane by its normal as if that were a unit vector: the radius in other units",
               [](F f) {
                 const Plane* plane = plane_of(f);
                 if (plane == nullptr) return right_decision(f);
                 return Said::at_most(f.distance * length_of(*plane), f.radius[0] + f.alarm);
               }),
      at_offset("plane-offset-not-divided", "the normal of a plane divided by its length, and the offset not",
                [](Real offset, Real length) { return offset * length; }),
      at_offset("plane-offset-negative", "the offset of a plane with the other sign: normal . x + offset = 0",
                [](Real offset, Real /*length*/) { return -offset; }),
      at_offset("plane-offset-ignored", "a plane taken for the one through the origin",
                [](Real /*offset*/, Real /*length*/) { return Real{0}; }),
      decision("plane-constant-sign", "decision by |normal . c + offset|: the other sign, and either side of the plane",
               [](F f) {
                 const Plane* plane = plane_of(f);
                 if (plane == nullptr) return right_decision(f);
                 const Real offset = Real{plane->offset} / length_of(*plane);
                 return Said::at_most(std::abs(dot(up(f), f.nearest[0]) + offset), f.radius[0] + f.alarm);
               }),
      edit("plane-two-sided", "a plane taken for a sheet: what is below is as far from it as what is above",
           [](Facts& f) {
             if (!is_below(f)) return;
             f.inward = up(f);
             f.settle();
           }),
      points("plane-point-mirrored", "contact point of a plane mirrored at the centre where that is below",
             [](F f, std::size_t shape) {
               return where(shape == kPlane && is_below(f), along(f.nearest[0], -f.distance, f.n));
             }),
      decision("plane-below-missed", "centres below a plane never hit",
               [](F f) { return missed_where(is_below(f), f); }),
      value("plane-depth-missing", "value below a plane without the depth of the centre",
            [](F f) { return where(is_below(f), -f.radii() - f.contact); }),
      edit("plane-other-end", "the higher end of a capsule taken for the lower",
           [](Facts& f) {
             const auto* shapes = std::get_if<CapsuleAndPlane>(&f.query.shapes);
             if (shapes == nullptr) return;
             const Numbers start = numbers_of(shapes->a.start);
             const Numbers end = numbers_of(shapes->a.end);
             const Real rise = dot(up(f), along(end, -1, start));
             if (f.nearest[0] != start && f.nearest[0] != end) return;  // level: the middle
             const Numbers other = f.nearest[0] == start ? end : start;
             const Real s = f.distance + std::abs(rise);
             f.nearest = {other, along(other, -s, up(f))};
             f.settle();
           }),
  };
}

}  // namespace contact::oracle::formulas
