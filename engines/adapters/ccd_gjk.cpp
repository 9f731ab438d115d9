// libccd: GJK, and its EPA for the depth.
#include "engines/adapters/ccd.hpp"

namespace contact::adapters {

std::string declaration() { return ccd_declaration("ccd-gjk"); }
void answer(const Question& q, Answer& said) { ccd_answer(ccdGJKPenetration, q, said); }

}  // namespace contact::adapters
