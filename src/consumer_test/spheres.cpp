// The example of docs/library.md as a program of its own.
#include <cstdio>

#include "contact/sphere_sphere.hpp"

int main() {
  const contact::Ball a{{0, 0, 0}, 1.5};
  const contact::Ball b{{1, 2, 2}, 1.5};
  const auto contact = contact::compute_sphere_sphere(a, b, {.alarm = 0, .contact = 0.25});
  std::printf("value %g\n", contact ? contact->value : 0.0);
}
