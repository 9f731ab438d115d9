/* An engine that tells which rows it was given, for tests: the width as the value; of spheres or hulls against hulls the first two numbers of a and the
   first of b as the normal, and the last three of each as the points. Of a
   sphere and a plane as many points as the plane's offset. Of a capsule and a plane, for which it takes a millisecond, an error where another
   thread asks meanwhile, and points, which it does not declare there, where the plane has an offset. */
#include "contact/contact_engine.h"

#include <stdatomic.h>
#include <time.h>

static atomic_int inside;

int32_t contact_engine_interface(void) { return CONTACT_ENGINE_INTERFACE; }

const char* contact_engine_declaration(void) {
  return "{\"engine\":{\"name\":\"telling\",\"version\":\"1\"},\"scalar\":\"binary64\",\"pairs\":[\"capsule_plane\","
         "\"sphere_hull\",\"hull_hull\",\"sphere_plane\"],\"pair_conventions\":{\"sphere_plane\":{\"points\":\"manifold\","
         "\"most_points\":3}}}";
}

int32_t contact_engine_answer(const contact_questions* q, contact_answers* out) {
  const int others = atomic_fetch_add(&inside, 1);
  if (q->pair == CONTACT_CAPSULE_PLANE) nanosleep(&(struct timespec){0, 1000000}, NULL);
  for (size_t i = 0; i < q->count; ++i) {
    out->said[i] = CONTACT_SAYS_CONTACT | CONTACT_TOUCHES | CONTACT_VALUE;
    out->value[i] = q->width;
    if (q->pair == CONTACT_CAPSULE_PLANE) {
      if (q->b[4 * i + 3] != 0) out->said[i] |= CONTACT_POINTS;
      if (others != 0) out->said[i] = CONTACT_ERROR;
      continue;
    }
    if (q->pair == CONTACT_SPHERE_PLANE) {
      out->said[i] |= CONTACT_POINTS;
      out->point_count[i] = (int32_t)q->b[4 * i + 3];
      for (int32_t k = 0; k < out->point_count[i] && k < out->most_points; ++k) {
        const size_t row = i * (size_t)out->most_points + (size_t)k;
        out->points[3 * row] = q->a[4 * i];
        out->points[3 * row + 1] = q->a[4 * i + 1];
        out->points[3 * row + 2] = k;
        out->depths[row] = 10. * (double)i + k;
      }
      continue;
    }
    const size_t of_b = (size_t)q->width;
    const size_t of_a = q->pair == CONTACT_SPHERE_HULL ? 4 : of_b;
    const double* a = q->a + i * of_a;
    const double* b = q->b + i * of_b;
    out->said[i] |= CONTACT_NORMAL | CONTACT_POINT1 | CONTACT_POINT2;
    for (size_t k = 0; k < 3; ++k) {
      out->normal[3 * i + k] = k < 2 ? a[k] : b[0];
      out->point1[3 * i + k] = a[of_a - 3 + k];
      out->point2[3 * i + k] = b[of_b - 3 + k];
    }
  }
  atomic_fetch_sub(&inside, 1);
  return 0;
}
