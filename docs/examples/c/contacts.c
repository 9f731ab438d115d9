/* Spheres against a plane, many at once, in C.   cc contacts.c $(pkg-config --cflags --libs contact-oracle-c) */
#include <contact/contact.h>
#include <stdio.h>

int main(void) {
  const contact_sphere spheres[3] = {{{0, 0, 0.5}, 1}, {{1, 0, 1}, 1}, {{2, 0, 3}, 1}};
  const contact_plane floor = {{0, 0, 1}, 0}; /* what lies below z = 0 */
  const contact_plane floors[3] = {floor, floor, floor};

  uint8_t state[3];
  double value[3], point1[3][3];
  contact_contacts out = {0}; /* what stays NULL is not written */
  out.state = state;
  out.value = value;
  out.point1 = point1[0];

  size_t hits = 0;
  const int32_t status =
      contact_compute_sphere_plane(3, spheres, floors, 0.0, 0.0, CONTACT_POINTS_NEAREST_SURFACE, &out, &hits);
  if (status != CONTACT_OK) {
    fprintf(stderr, "%s: %s\n", contact_status_text(status), contact_last_error());
    return 1;
  }
  printf("contact-oracle %s: %d hits\n", contact_version(), (int)hits);
  for (int i = 0; i < 3; ++i) {
    if (state[i] == CONTACT_STATE_MISS)
      printf("sphere %d: none\n", i);
    else
      printf("sphere %d: value %g at (%g, %g, %g)\n", i, value[i], point1[i][0], point1[i][1], point1[i][2]);
  }
  return 0;
}
