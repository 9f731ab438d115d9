// libccd: Minkowski portal refinement.
#include "engines/adapters/libccd.hpp"

namespace contact::adapters {

std::string declaration() { return ccd_declaration("libccd", ""); }
void answer(const Question& q, Answer& said) { ccd_answer(ccdMPRPenetration, q, said); }

}  // namespace contact::adapters
