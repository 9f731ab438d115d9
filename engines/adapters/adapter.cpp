// The three functions of contact_engine.h around an adapter's declaration() and answer().
#include "engines/adapters/adapter.hpp"

#include <exception>

namespace {
using namespace contact::adapters;

/// The two shapes of each contact_pair.
constexpr Kind kKinds[][2] = {
    {Kind::sphere, Kind::sphere},   {Kind::sphere, Kind::sphere},    {Kind::sphere, Kind::sphere},
    {Kind::box, Kind::box},         {Kind::sphere, Kind::box},       {Kind::sphere, Kind::capsule},
    {Kind::capsule, Kind::capsule}, {Kind::sphere, Kind::triangle},  {Kind::ray, Kind::sphere},
    {Kind::sphere, Kind::plane},    {Kind::capsule, Kind::plane},    {Kind::ray, Kind::triangle},
    {Kind::triangle, Kind::line},   {Kind::ray, Kind::sphere},       {Kind::ray, Kind::box},
    {Kind::ray, Kind::capsule},     {Kind::ray, Kind::triangle},     {Kind::ray, Kind::plane},
    {Kind::obb, Kind::obb},         {Kind::sphere, Kind::obb},       {Kind::capsule, Kind::box},
    {Kind::capsule, Kind::obb},     {Kind::capsule, Kind::triangle}, {Kind::box, Kind::obb},
    {Kind::box, Kind::triangle},    {Kind::obb, Kind::triangle},     {Kind::triangle, Kind::triangle},
    {Kind::box, Kind::plane},       {Kind::obb, Kind::plane},        {Kind::triangle, Kind::plane},
    {Kind::sphere, Kind::hull},     {Kind::capsule, Kind::hull},     {Kind::box, Kind::hull},
    {Kind::obb, Kind::hull},        {Kind::triangle, Kind::hull},    {Kind::hull, Kind::hull},
    {Kind::hull, Kind::plane}};

/// How many numbers each kind has; those of a hull come with the questions.
constexpr std::size_t kWidths[] = {4, 6, 7, 9, 7, 4, 6, 10};
}  // namespace

int32_t contact_engine_interface() { return CONTACT_ENGINE_INTERFACE; }

const char* contact_engine_declaration() {
  static const std::string text = declaration();
  return text.c_str();
}

int32_t contact_engine_answer(const contact_questions* questions, contact_answers* answers) {
  const auto pair = static_cast<contact_pair>(questions->pair);
  const auto [a, b] = kKinds[pair];
  const auto width_of = [&](Kind kind) {
    return kind == Kind::hull ? static_cast<std::size_t>(questions->width) : kWidths[static_cast<std::size_t>(kind)];
  };
  for (std::size_t i = 0; i < questions->count; ++i) {
    Answer said(*answers, i);
    try {
      answer({pair,
              {a, questions->a + i * width_of(a)},
              {b, questions->b + i * width_of(b)},
              questions->alarm[i],
              questions->contact[i]},
             said);
    } catch (const std::exception&) {
      answers->said[i] = CONTACT_ERROR;
    }
  }
  return 0;
}
