// A point or a segment over a plane in plain arithmetic, as engines have it: the plane is normalised first.
#pragma once

#include "golden/plain_segments.hpp"

namespace contact::golden {

/// The lowest point of a segment over a plane, and how high that lies.
template <class Real>
struct OverPlainPlane {
  Triple<Real> n{};  ///< of length 1
  Triple<Real> p{};
  Real s{};
  bool unique = true;
  Real radius{};

  OverPlainPlane(const Segment<Real>& segment, const Plane& plane) : radius(segment.radius) {
    const Triple<Real> normal = in_scalar<Real>(plane.normal);
    const Real length = std::sqrt(dot(normal, normal));
    for (std::size_t i = 0; i < 3; ++i) n[i] = normal[i] / length;
    const Real offset = static_cast<Real>(plane.offset) / length;
    const Real start = dot(n, segment.start) - offset;
    const Real end = dot(n, segment.end) - offset;
    unique = start != end || segment.start == segment.end;
    p = end < start ? segment.end : unique ? segment.start : segment.at(Real{0.5});
    s = end < start ? end : start;
  }

  [[nodiscard]] bool overlap(Distances distances) const { return s <= radius + static_cast<Real>(distances.alarm); }
  [[nodiscard]] std::optional<Contact> contact(Distances distances, ContactPoints points) const {
    if (!overlap(distances)) return std::nullopt;
    Contact contact{widened(moved({}, Real{-1}, n)),
                    widened(moved(p, -outward(points.first, radius), n)),
                    widened(moved(p, -s, n)),
                    0,
                    false,
                    unique};
    contact.value = static_cast<double>((s - radius) - static_cast<Real>(distances.contact));
    return contact;
  }
};

/// For spheres and capsules over planes, what plain.hpp declares.
template <class Shapes>
std::optional<Contact> plain_contact_over_plane(const Shapes& shapes, Distances distances, Scalar scalar,
                                                ContactPoints points) {
  return scalar == Scalar::binary32
             ? OverPlainPlane<float>(segment_of<float>(shapes.a), shapes.b).contact(distances, points)
             : OverPlainPlane<double>(segment_of<double>(shapes.a), shapes.b).contact(distances, points);
}

}  // namespace contact::golden
