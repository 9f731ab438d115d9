// The three functions of contact_engine.h around an adapter's declaration() and answer().
#include "engines/adapters/adapter.hpp"

#include <exception>

namespace {
using namespace contact::adapters;

/// How many numbers the shapes of each contact_pair have: first, second.
constexpr std::size_t kWidths[][2] = {{4, 4}, {4, 4}, {4, 4}, {6, 6}, {4, 6}};
}  // namespace

int32_t contact_engine_interface() { return CONTACT_ENGINE_INTERFACE; }

const char* contact_engine_declaration() {
  static const std::string text = declaration();
  return text.c_str();
}

int32_t contact_engine_answer(const contact_questions* questions, contact_answers* answers) {
  const auto pair = static_cast<contact_pair>(questions->pair);
  const auto& width = kWidths[pair];
  for (std::size_t i = 0; i < questions->count; ++i) {
    Answer said(*answers, i);
    try {
      answer({pair, questions->a + i * width[0], questions->b + i * width[1], questions->alarm[i]}, said);
    } catch (const std::exception&) {
      answers->said[i] = CONTACT_ERROR;
    }
  }
  return 0;
}
