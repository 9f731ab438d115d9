/* An engine in a shared library that sets the floating-point environment when it is loaded and again at every answer,
   and leaves it so. It says back the numbers that it is asked with, and as the value what 1 + 2^-60 is where it
   computes. */
#include <fenv.h>

#include "contact/contact_engine.h"

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

static void change(void) {
  fesetround(FE_UPWARD);
#ifdef __SSE2__
  _mm_setcsr(_mm_getcsr() | 0x8040); /* flush-to-zero and denormals-are-zero */
#endif
}

__attribute__((constructor)) static void loaded(void) { change(); }

int32_t contact_engine_interface(void) { return CONTACT_ENGINE_INTERFACE; }

const char* contact_engine_declaration(void) {
  return "{\"engine\":{\"name\":\"changing\",\"version\":\"1\"},\"scalar\":\"binary64\",\"pairs\":[\"sphere_sphere\"]}";
}

int32_t contact_engine_answer(const contact_questions* q, contact_answers* answers) {
  for (size_t i = 0; i < q->count; ++i) {
    volatile double one = 1;
    answers->value[i] = one + 0x1p-60; /* before it is set again: as the last call left it */
    for (size_t k = 0; k < 3; ++k) {
      answers->point1[3 * i + k] = q->a[4 * i + k];
      answers->point2[3 * i + k] = q->b[4 * i + k];
    }
    answers->said[i] = CONTACT_SAYS_CONTACT | CONTACT_TOUCHES | CONTACT_POINT1 | CONTACT_POINT2 | CONTACT_VALUE;
  }
  change();
  return 0;
}
