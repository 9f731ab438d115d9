/* An engine as a shared library: the C interface that contact-oracle certifies it by (--engine-library FILE.so).
   The library runs in a process of its own, so that a crash is a verdict and not the end of the run. It is asked by one
   thread at a time. Nothing here needs C++ or a library; export the three functions at the end. */
#ifndef CONTACT_ENGINE_H
#define CONTACT_ENGINE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Changes whenever something below does, but for what is added at an end. */
#define CONTACT_ENGINE_INTERFACE 1

enum contact_pair {
  CONTACT_SPHERE_SPHERE = 0,
  CONTACT_RIGID_SPHERE_RIGID_SPHERE = 1,
  CONTACT_SPHERE_RIGID_SPHERE = 2,
  CONTACT_CUBE_CUBE = 3,
  CONTACT_SPHERE_CUBE = 4,
  CONTACT_SPHERE_CAPSULE = 5,
  CONTACT_CAPSULE_CAPSULE = 6,
  CONTACT_SPHERE_TRIANGLE = 7,
  CONTACT_RAY_SPHERE = 8,
  CONTACT_SPHERE_PLANE = 9,
  CONTACT_CAPSULE_PLANE = 10,
  CONTACT_RAY_TRIANGLE = 11,
  CONTACT_TRIANGLE_LINE = 12,
  CONTACT_CAST_SPHERE = 13, /* a is a ray that is cast, here and below */
  CONTACT_CAST_CUBE = 14,
  CONTACT_CAST_CAPSULE = 15,
  CONTACT_CAST_TRIANGLE = 16,
  CONTACT_CAST_PLANE = 17,
  CONTACT_OBB_OBB = 18,
  CONTACT_SPHERE_OBB = 19,
  CONTACT_CAPSULE_CUBE = 20,
  CONTACT_CAPSULE_OBB = 21,
  CONTACT_CAPSULE_TRIANGLE = 22,
  CONTACT_CUBE_OBB = 23,
  CONTACT_CUBE_TRIANGLE = 24,
  CONTACT_OBB_TRIANGLE = 25,
  CONTACT_TRIANGLE_TRIANGLE = 26,
  CONTACT_CUBE_PLANE = 27,
  CONTACT_OBB_PLANE = 28,
  CONTACT_TRIANGLE_PLANE = 29,
  CONTACT_SPHERE_HULL = 30,
  CONTACT_CAPSULE_HULL = 31,
  CONTACT_CUBE_HULL = 32,
  CONTACT_OBB_HULL = 33,
  CONTACT_TRIANGLE_HULL = 34,
  CONTACT_HULL_HULL = 35,
  CONTACT_HULL_PLANE = 36
};

/* Questions of one pair kind, as arrays with one row a question. */
typedef struct contact_questions {
  size_t count;
  int32_t pair;  /* enum contact_pair */
  int32_t width; /* numbers of a shape of a: 4 for spheres and planes, 6 for cubes and lines, 7 for capsules and rays, 9
                    for triangles, 10 for rotated boxes; b is as wide as its own. Where a or b is a hull, 2 + 3 n: those
                    of a hull, n being the most vertices that one of these questions has */
  const double*
      a; /* count rows: centre and radius; min and max; start, end and radius; centre, quaternion and extents. A hull:
            the number of its vertices, radius, then n vertices: beyond its own the last one again, so that an engine
            may take all n */
  const double* b;
  const double* alarm;   /* count */
  const double* contact; /* count */
} contact_questions;

/* What an answer says: a sum of these. A field that the declaration claims and that an answer to a hit does not say is
   a missing field, which refutes the engine. */
enum contact_said {
  CONTACT_SAYS_OVERLAP = 1, /* whether the pair is within the alarm distance ... */
  CONTACT_OVERLAPS = 2,     /* ... it is */
  CONTACT_SAYS_CONTACT = 4, /* whether there is a contact ... */
  CONTACT_TOUCHES = 8,      /* ... there is, with the numbers that the rest of the sum names */
  CONTACT_NORMAL = 16,
  CONTACT_POINT1 = 32,
  CONTACT_POINT2 = 64,
  CONTACT_MIDPOINT = 128, /* point1 holds the one point of the convention `midpoint` */
  CONTACT_VALUE = 256,
  CONTACT_UNSUPPORTED = 512, /* instead of an answer */
  CONTACT_REJECTED = 1024,   /* instead of an answer: the input is outside the domain */
  CONTACT_ERROR = 2048,      /* instead of an answer */
  CONTACT_POINTS = 4096      /* several points, of the convention `manifold` */
};

/* Answers, as arrays with one row a question; every `said` is 0 when it is handed over. */
typedef struct contact_answers {
  uint32_t* said; /* count: sums of enum contact_said */
  double* normal; /* count rows of 3, and so on */
  double* point1;
  double* point2;
  double* value; /* count */
  /* The convention `manifold`: how many points, their places and how deep the shapes are in each other at each. */
  int32_t most_points;  /* the declaration's, 8 without one */
  int32_t* point_count; /* count: 1 to most_points */
  double* points;       /* count rows of most_points x 3 */
  double* depths;       /* count rows of most_points */
} contact_answers;

/* CONTACT_ENGINE_INTERFACE as the library was built. */
int32_t contact_engine_interface(void);

/* What the engine declares, as the hello message of the protocol without "op" and "protocol":
   {"engine":{"name":"mine","version":"1"},"scalar":"binary64","pairs":["sphere_sphere"]}
   "claims":["overlap","contact","value"] in it says which fields the engine gives; without it, all of its conventions.
   "rounds":["orientation"] says that the library makes a matrix or a unit quaternion of a rotated box's orientation.
 */
const char* contact_engine_declaration(void);

/* Fills in one answer a question. 0, or anything else for an error of all of them. */
int32_t contact_engine_answer(const contact_questions* questions, contact_answers* answers);

#ifdef __cplusplus
}
#endif

#endif
