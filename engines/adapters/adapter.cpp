// The three functions of contact_engine.h around an adapter's declaration() and answer().
#include "engines/adapters/adapter.hpp"

#include <exception>

namespace {
using namespace contact::adapters;
}

int32_t contact_engine_interface() { return CONTACT_ENGINE_INTERFACE; }

const char* contact_engine_declaration() {
  static const std::string text = declaration();
  return text.c_str();
}

int32_t contact_engine_answer(const contact_questions* questions, contact_answers* answers) {
  const bool boxes = questions->pair == CONTACT_CUBE_CUBE;
  for (std::size_t i = 0; i < questions->count; ++i) {
    const std::size_t row = i * static_cast<std::size_t>(questions->width);
    Answer said(*answers, i);
    try {
      answer({boxes, questions->a + row, questions->b + row, questions->alarm[i]}, said);
    } catch (const std::exception&) {
      answers->said[i] = CONTACT_ERROR;
    }
  }
  return 0;
}
