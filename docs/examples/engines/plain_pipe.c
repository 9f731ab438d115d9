/* An engine in C for contact-oracle: spheres in plain double arithmetic, over the engine protocol, without a library.
   It leans on what contact-oracle promises of its own lines: the keys stand in the documented order without spaces. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char* hello =
    "{\"op\":\"hello\",\"protocol\":1,\"engine\":{\"name\":\"plain-pipe\",\"version\":\"1\"},\"scalar\":\"binary64\","
    "\"pairs\":[\"sphere_sphere\"],\"conventions\":{\"scale\":{\"min\":1e-100,\"max\":1e100}},"
    "\"bounds\":{\"value\":4,\"normal\":4,\"point\":4}}";

/* {"op":"query","seq":1,"pair":"sphere_sphere","a":{"center":[x,y,z],"radius":r},"b":{...},"alarm":d,"contact":d} */
static void answer(char* line) {
  double x[10];
  const unsigned long long seq = strtoull(line + strlen("{\"op\":\"query\",\"seq\":"), &line, 10);
  for (int i = 0; i < 10; ++i) {
    char* start = line + strcspn(line, "-0123456789"); /* NaN or an infinity, given as text, is none of these */
    x[i] = strtod(start, &line);
    if (line == start || !isfinite(x[i])) {
      printf("{\"op\":\"answer\",\"seq\":%llu,\"rejected\":\"number %d\"}\n", seq, i);
      return;
    }
  }
  const double *a = x, *b = x + 4, d[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const double distance2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2], reach = a[3] + b[3] + x[8];
  if (distance2 > reach * reach) {
    printf("{\"op\":\"answer\",\"seq\":%llu,\"overlap\":false,\"contact\":null}\n", seq);
    return;
  }
  const double s = sqrt(distance2);
  const double n[3] = {s > 0 ? d[0] / s : 1, s > 0 ? d[1] / s : 0, s > 0 ? d[2] / s : 0};
  printf(
      "{\"op\":\"answer\",\"seq\":%llu,\"overlap\":true,\"contact\":{\"normal\":[%.17g,%.17g,%.17g],"
      "\"point1\":[%.17g,%.17g,%.17g],\"point2\":[%.17g,%.17g,%.17g],\"value\":%.17g}}\n",
      seq, n[0], n[1], n[2], a[0] + a[3] * n[0], a[1] + a[3] * n[1], a[2] + a[3] * n[2], b[0] - b[3] * n[0],
      b[1] - b[3] * n[1], b[2] - b[3] * n[2], s - (a[3] + b[3]) - x[9]);
}

int main(void) {
  static char buffer[1 << 20];
  size_t held = 0;
  for (ssize_t n; (n = read(STDIN_FILENO, buffer + held, sizeof buffer - held)) > 0;) {
    held += (size_t)n;
    char* line = buffer;
    for (char* end; (end = memchr(line, '\n', held - (size_t)(line - buffer))) != NULL; line = end + 1) {
      *end = '\0';
      if (strncmp(line, "{\"op\":\"stop\"", 12) == 0) return 0;
      if (strncmp(line, "{\"op\":\"hello\"", 13) == 0)
        puts(hello);
      else
        answer(line);
    }
    held -= (size_t)(line - buffer);
    memmove(buffer, line, held);
    fflush(stdout); /* whatever has arrived is answered together; never keep an answer back */
  }
}
