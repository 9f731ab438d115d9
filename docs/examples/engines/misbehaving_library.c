/* A library for the tests of --engine-library: CONTACT_MISBEHAVES in the environment says how it is bad. It claims
   nothing wrong otherwise: spheres are apart or not by exact integers. Contact distance 13 is where it misbehaves. */
#include <stdlib.h>
#include <string.h>

#include "contact/contact_engine.h"

static int mode(const char* name) {
  const char* set = getenv("CONTACT_MISBEHAVES");
  return set != NULL && strcmp(set, name) == 0;
}

int32_t contact_engine_interface(void) { return CONTACT_ENGINE_INTERFACE + mode("wrong interface"); }

const char* contact_engine_declaration(void) {
  if (mode("no declaration")) return "no JSON";
  return "{\"engine\":{\"name\":\"misbehaving\",\"version\":\"1\"},\"scalar\":\"binary64\",\"pairs\":[\"sphere_"
         "sphere\"],\"claims\":[\"overlap\"]}";
}

int32_t contact_engine_answer(const contact_questions* q, contact_answers* answers) {
  for (size_t i = 0; i < q->count; ++i) {
    const double *a = q->a + 4 * i, *b = q->b + 4 * i;
    if (q->contact[i] > 12.5 && q->contact[i] < 13.5) {
      if (mode("crashes")) abort();
      if (mode("returns an error")) return 5;
      if (mode("says error")) {
        answers->said[i] = CONTACT_ERROR;
        continue;
      }
    }
    const double d[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, reach = a[3] + b[3] + q->alarm[i];
    answers->said[i] = CONTACT_SAYS_OVERLAP;
    if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] <= reach * reach) answers->said[i] |= CONTACT_OVERLAPS;
  }
  return 0;
}
