// Rays that are cast: the double-double stage passes all of them on to the intervals.
#include "oracle/truth/double_double_oracle.hpp"

namespace contact::oracle {

#define CONTACT_CAST(Target)                                                                                   \
  std::optional<RoundedAnswer> double_double_answer(const CastAt<Target>& /*shapes*/, Distances /*distances*/, \
                                                    Scalar /*scalar*/) {                                       \
    return std::nullopt;                                                                                       \
  }
CONTACT_CAST(Ball)
CONTACT_CAST(Box)
CONTACT_CAST(Capsule)
CONTACT_CAST(Triangle)
CONTACT_CAST(Plane)
#undef CONTACT_CAST

}  // namespace contact::oracle
