/* Preloaded into a program, sets its floating-point environment before anything of it runs, its own constructors
   included: CONTACT_ENVIRONMENT names it. Threads inherit it from the one that makes them. */
#include <fenv.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

__attribute__((constructor)) static void set_environment(void) {
  static const struct {
    const char* name;
    int mode;
  } modes[] = {
      {"to nearest", FE_TONEAREST}, {"upward", FE_UPWARD}, {"downward", FE_DOWNWARD}, {"toward zero", FE_TOWARDZERO}};
  const char* wanted = getenv("CONTACT_ENVIRONMENT");
  if (wanted == NULL) return;
  const char* flushing = strstr(wanted, ", flushing");
  const size_t length = flushing == NULL ? strlen(wanted) : (size_t)(flushing - wanted);
  for (size_t i = 0; i < sizeof modes / sizeof *modes; ++i)
    if (strlen(modes[i].name) == length && strncmp(modes[i].name, wanted, length) == 0 &&
        fesetround(modes[i].mode) == 0) {
#ifdef __SSE2__
      if (flushing != NULL) _mm_setcsr(_mm_getcsr() | 0x8040); /* flush-to-zero and denormals-are-zero */
      return;
#else
      if (flushing == NULL) return;
#endif
    }
  fprintf(stderr, "no such floating-point environment here: '%s'\n", wanted);
  abort();
}
