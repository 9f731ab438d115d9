// The README's example, checked by hand: delta (1,2,2), distance 3, so the value is 3 - 3 - 0.25. Then a plug-in.
#include <algorithm>
#include <cstdio>

#include "contact/plugin.hpp"
#include "contact/sphere_sphere.hpp"

int main(int, char** arguments) {
  const contact::Ball a{{0, 0, 0}, 1.5};
  const contact::Ball b{{1, 2, 2}, 1.5};
  const auto contact = contact::compute_sphere_sphere(a, b, {.alarm = 0, .contact = 0.25});
  if (!contact || contact->value != -0.25) return 1;
  std::printf("value %g\n", contact->value);
  contact::load_plugin(arguments[1]);
  const auto makers = contact::ModelFactory::getInstance().makers();
  return std::any_of(makers.begin(), makers.end(), [](const auto& m) { return m.type == "CapsuleModel"; }) ? 0 : 1;
}
