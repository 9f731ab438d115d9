// An engine that throws what CONTACT_THROWS says, or declares nothing, for tests.
#include <cstdlib>
#include <stdexcept>
#include <string_view>

#include "contact/contact_engine.h"

namespace {

bool is(std::string_view how) {
  const char* const said = std::getenv("CONTACT_THROWS");
  return said != nullptr && said == how;
}

}  // namespace

int32_t contact_engine_interface() {
  if (is("interface")) throw 7;
  return CONTACT_ENGINE_INTERFACE;
}

const char* contact_engine_declaration() {
  if (is("int")) throw 7;
  if (is("exception")) throw std::runtime_error("no");
  return is("null") ? nullptr
                    : R"({"engine":{"name":"throwing","version":"1"},"scalar":"binary64","pairs":["sphere_sphere"]})";
}

int32_t contact_engine_answer(const contact_questions*, contact_answers*) {
  if (is("answer-int")) throw 7;
  throw std::runtime_error("no");
}
