// The README's example, checked by hand: delta (1,2,2), distance 3, so the value is 3 - 3 - 0.25.
#include <cstdio>

#include "contact/sphere_sphere.hpp"

int main() {
  const contact::Ball a{{0, 0, 0}, 1.5};
  const contact::Ball b{{1, 2, 2}, 1.5};
  if (const auto contact = contact::compute_sphere_sphere(a, b, {.alarm = 0, .contact = 0.25})) {
    std::printf("value %g\n", contact->value);
    return contact->value == -0.25 ? 0 : 1;
  }
  return 1;
}
