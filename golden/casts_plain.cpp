// Rays that are cast, in plain arithmetic.
#include "golden/plain.hpp"
#include "oracle/diagnosis/casts_in_reals.hpp"

namespace contact::golden {
namespace {

template <class Real, class Target>
std::optional<Contact> plain_cast(const CastAt<Target>& shapes) {
  const oracle::CastInPlain<Real, Target> cast(shapes);
  const auto widened = [](const std::array<Real, 3>& v) -> Vector3 {
    return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
  };
  if (cast.begins_inside()) {
    const Vector3 o = widened(cast.o);
    return Contact{widened(cast.divided(cast.d, -cast.speed())), o, o, 0, true};
  }
  const auto t = cast.first();
  if (!t || !(*t >= 0 && *t <= cast.length)) return std::nullopt;
  const Vector3 x = widened(cast.at(*t));
  return Contact{widened(cast.normal(*t)), x, x, static_cast<double>(*t), false};
}
template <class Target>
std::optional<Contact> plain_cast(const CastAt<Target>& shapes, Scalar scalar) {
  return scalar == Scalar::binary32 ? plain_cast<float>(shapes) : plain_cast<double>(shapes);
}

}  // namespace

#define CONTACT_CAST(Cast, Target)                                                                           \
  bool plain_overlap(const CastAt<Target>& shapes, Distances /*distances*/, Scalar scalar) {                 \
    return plain_cast(shapes, scalar).has_value();                                                           \
  }                                                                                                          \
  std::optional<Contact> plain_contact(const CastAt<Target>& shapes, Distances /*distances*/, Scalar scalar, \
                                       ContactPoints /*points*/) {                                           \
    return plain_cast(shapes, scalar);                                                                       \
  }
CONTACT_CASTS(CONTACT_CAST)
#undef CONTACT_CAST

}  // namespace contact::golden
