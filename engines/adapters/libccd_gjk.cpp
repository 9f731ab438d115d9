// libccd: GJK, and its EPA for the depth.
#include "engines/adapters/libccd.hpp"

namespace contact::adapters {

// Beyond the scale products of three differences overflow, and libccd follows pointers that it never set.
std::string declaration() { return ccd_declaration("libccd-gjk", R"(,"scale":{"min":0,"max":1e100})"); }
void answer(const Question& q, Answer& said) { ccd_answer(ccdGJKPenetration, q, said); }

}  // namespace contact::adapters
