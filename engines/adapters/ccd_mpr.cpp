// libccd: Minkowski portal refinement.
#include "engines/adapters/ccd.hpp"

namespace contact::adapters {

std::string declaration() { return ccd_declaration("ccd-mpr"); }
void answer(const Question& q, Answer& said) { ccd_answer(ccdMPRPenetration, q, said); }

}  // namespace contact::adapters
