// The answer to a question about two shapes, and the named conventions for its contact points.
#pragma once

#include "contact/geometry.hpp"

namespace contact::inline CONTACT_ABI {

/// One contact. `normal` is a unit vector from the first shape to the second, points are in world coordinates.
struct Contact {
  Vector3 normal;
  Vector3 point1;
  Vector3 point2;
  double value;  ///< signed distance of the surfaces, less the contact distance
  /// The cores meet: two centres coincide, one lies in a box or on an axis, two axes cross. There is no distance. The
  /// specification says what the normal is then.
  bool degenerate;
  /// Whether only one point of each core is nearest to the other. Else the points are one choice of many, as of
  /// parallel capsules side by side.
  bool unique = true;
};

/// Where a contact point of one shape lies, n being the unit normal from the first shape to the second, c1 and c2 the
/// nearest points of the cores, which of spheres are the centres, and r1 and r2 the radii about these.
enum class PointOn {
  nearest_surface,  ///< c1 + r1 n on the first shape, c2 - r2 n on the second
  center,           ///< c1 and c2
  far_surface       ///< c1 - r1 n and c2 + r2 n, the formula as it was published
};

/// A contact-point convention for both shapes of a pair.
struct ContactPoints {
  PointOn first = PointOn::nearest_surface;
  PointOn second = PointOn::nearest_surface;
};

/// The contact-point conventions that have a name: ours, compiled SOFA's, and the one in SOFA's published description.
enum class PointConvention { nearest_surface, center, published };

/// Whether a sphere belongs to a deformable body or to a rigid one. Only the convention `center` tells them apart.
enum class SphereKind { deformable, rigid };

/// Where a convention puts the contact point of a sphere of this kind.
[[nodiscard]] constexpr PointOn point_on(PointConvention convention, SphereKind kind) {
  switch (convention) {
    case PointConvention::center:
      return kind == SphereKind::rigid ? PointOn::nearest_surface : PointOn::center;
    case PointConvention::published:
      return PointOn::far_surface;
    case PointConvention::nearest_surface:
      break;
  }
  return PointOn::nearest_surface;
}

}  // namespace contact::inline CONTACT_ABI
