/* An engine in C as a shared library for contact-oracle: spheres and boxes in plain double arithmetic. */
#include <math.h>

#include "contact/contact_engine.h"

int32_t contact_engine_interface(void) { return CONTACT_ENGINE_INTERFACE; }

const char* contact_engine_declaration(void) {
  return "{\"engine\":{\"name\":\"plain-library\",\"version\":\"1\"},\"scalar\":\"binary64\","
         "\"pairs\":[\"sphere_sphere\",\"cube_cube\"],\"conventions\":{\"scale\":{\"min\":1e-100,\"max\":1e100}},"
         "\"bounds\":{\"value\":4,\"normal\":4,\"point\":4}}";
}

static uint32_t boxes(const double* a, const double* b, double alarm) {
  for (int i = 0; i < 3; ++i)
    if (a[i] > b[3 + i] + alarm || b[i] > a[3 + i] + alarm) return CONTACT_SAYS_OVERLAP;
  return CONTACT_SAYS_OVERLAP | CONTACT_OVERLAPS;
}

static uint32_t spheres(const double* a, const double* b, double alarm, double contact, double* normal, double* point1,
                        double* point2, double* value) {
  const double delta[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const double distance2 = delta[0] * delta[0] + delta[1] * delta[1] + delta[2] * delta[2];
  const double reach = a[3] + b[3] + alarm;
  if (distance2 > reach * reach) return CONTACT_SAYS_OVERLAP | CONTACT_SAYS_CONTACT;
  const double distance = sqrt(distance2);
  for (int i = 0; i < 3; ++i) {
    normal[i] = distance > 0 ? delta[i] / distance : i == 0;
    point1[i] = a[i] + a[3] * normal[i];
    point2[i] = b[i] - b[3] * normal[i];
  }
  *value = distance - (a[3] + b[3]) - contact;
  return CONTACT_SAYS_OVERLAP | CONTACT_OVERLAPS | CONTACT_SAYS_CONTACT | CONTACT_TOUCHES | CONTACT_NORMAL |
         CONTACT_POINT1 | CONTACT_POINT2 | CONTACT_VALUE;
}

int32_t contact_engine_answer(const contact_questions* q, contact_answers* answers) {
  for (size_t i = 0; i < q->count; ++i) {
    const double* a = q->a + i * (size_t)q->width;
    const double* b = q->b + i * (size_t)q->width;
    answers->said[i] = q->pair == CONTACT_CUBE_CUBE
                           ? boxes(a, b, q->alarm[i])
                           : spheres(a, b, q->alarm[i], q->contact[i], answers->normal + 3 * i, answers->point1 + 3 * i,
                                     answers->point2 + 3 * i, answers->value + i);
  }
  return 0;
}
