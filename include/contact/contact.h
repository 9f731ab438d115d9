/* The reference in C: exact decisions and correctly rounded contacts of many pairs of shapes, or of one. For every
   language that can call C. Nothing here needs C++ or a library; link contact::c, or what `pkg-config contact-oracle-c`
   says. docs/library.md. */
#ifndef CONTACT_CONTACT_H
#define CONTACT_CONTACT_H

#include <stddef.h>
#include <stdint.h>

#include "contact/version.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Shapes. Each but the hull is nothing but doubles, without gaps: an array of n spheres is an array of n rows of 4
   doubles, and so on for NumPy, Julia, Fortran and C#. Rows have the order of the canonical bytes, as those of
   contact_engine.h. Alignment: that of double. */
typedef struct contact_sphere { /* 4 doubles */
  double center[3];
  double radius; /* >= 0 */
} contact_sphere;
typedef struct contact_cube { /* 6 doubles; an axis-aligned box */
  double min[3];
  double max[3]; /* >= min on every axis */
} contact_cube;
typedef struct contact_capsule { /* 7 doubles: the points within `radius` of a segment */
  double start[3];
  double end[3];
  double radius; /* >= 0 */
} contact_capsule;
typedef struct contact_triangle { /* 9 doubles */
  double vertices[3][3];
} contact_triangle;
typedef struct contact_plane { /* 4 doubles: the half-space normal . x <= offset */
  double normal[3];            /* not zero, of any length */
  double offset;
} contact_plane;
typedef struct contact_ray { /* 7 doubles: the segment from origin to origin + length direction */
  double origin[3];
  double direction[3]; /* not zero, of any length */
  double length;       /* >= 0, counts directions */
} contact_ray;
typedef struct contact_obb { /* 10 doubles: a box that is turned about its centre */
  double center[3];
  double orientation[4]; /* the quaternion x, y, z, w: not zero, of any length */
  double extents[3];     /* >= 0: half its lengths */
} contact_obb;
typedef struct contact_hull { /* no row of doubles: the points within `radius` of the convex hull of some points */
  const double* vertices;     /* `count` rows of 3; repeated, inner, coplanar and collinear ones are allowed */
  size_t count;               /* 1 to 64 */
  double radius;              /* >= 0 */
} contact_hull;
typedef struct contact_line { /* 6 doubles: the segment between two points */
  double start[3];
  double end[3];
} contact_line;

/* What a pair turned out to be. */
enum contact_state {
  CONTACT_STATE_MISS = 0,       /* farther apart than the alarm distance: every number is 0 */
  CONTACT_STATE_CONTACT = 1,    /* within it */
  CONTACT_STATE_DEGENERATE = 2, /* a contact without a direction of its own, as of spheres whose centres coincide */
  CONTACT_STATE_MANY = 3,       /* a contact of which many points are nearest, as of capsules side by side */
  CONTACT_STATE_DEGENERATE_AND_MANY = 4
};

/* Where contact points lie. */
enum contact_points {
  CONTACT_POINTS_NEAREST_SURFACE = 0,
  CONTACT_POINTS_CENTER = 1,   /* as compiled SOFA has it: the centre of a sphere, the surface point of a rigid one */
  CONTACT_POINTS_PUBLISHED = 2 /* on the far sides, as SOFA's published description has it */
};

/* Room for `count` contacts, packed: normal, point1 and point2 have rows of 3 (x, y, z). What is NULL is not written. */
typedef struct contact_contacts {
  uint8_t* state; /* count: enum contact_state */
  double* normal; /* count rows of 3: a unit vector from the first shape to the second */
  double* point1; /* count rows of 3: on the first shape */
  double* point2; /* count rows of 3: on the second */
  double* value;  /* count: signed distance of the surfaces, less the contact distance */
} contact_contacts;

/* What a function returns. */
enum contact_status {
  CONTACT_OK = 0,
  CONTACT_NULL_POINTER = 1,   /* an array is NULL, and its count is not 0 */
  CONTACT_OUTSIDE_DOMAIN = 2, /* a number is not finite, or breaks a rule of its shape */
  CONTACT_UNKNOWN_POINTS = 3, /* `points` is none of enum contact_points */
  CONTACT_OUT_OF_MEMORY = 4,
  CONTACT_FAILED = 5 /* what should not happen; please report it */
};

/* For each pair, contact_test_PAIR and contact_compute_PAIR: of row i of `a` with row i of `b`, for every i below
   `count`. One pair is an array of one. `hits` may be NULL; else it becomes the number of pairs within the alarm
   distance.
     test      hit[i] = 1 where the two are within `alarm` of each other, else 0
     compute   row i of `out` is their contact; `points` is one of enum contact_points
   Where a ray or a line crosses a triangle, and where a ray is cast, there is no distance, and neither `alarm` nor
   `contact` has a say.
   Units       one length unit throughout; normals are unit vectors.
   Domain      finite; `alarm` and `contact` >= 0, and what stands beside the shapes above. Subnormals and the largest
               finite numbers are included. All of it is checked before anything is written: CONTACT_OUTSIDE_DOMAIN, and
               contact_last_error() names the row. Arrays that are written overlap neither each other nor what is read.
   Decision    exact: touching counts.
   Error       every number is the exact real rounded once to nearest, ties to even (0.5 ulp); beyond the largest finite
               number it is infinite, as IEEE 754 rounds. Every zero is +0.
   Environment any rounding mode, flush-to-zero and denormals-are-zero, exceptions unmasked: the answer is the same, and
               the caller's environment is as it was.
   Threads     any number of calls at once, on outputs of their own. No C++ exception leaves a function, and none calls
               back.
   Source      contact/sphere_sphere.hpp and its like, which say what holds for each pair; docs/specification.md.
   Evidence    src/c/contact_test.py compares the bits with every golden file. */
#define CONTACT_C_TEST(PAIR, A, B) \
  int32_t contact_test_##PAIR(size_t count, const A* a, const B* b, double alarm, uint8_t* hit, size_t* hits);
#define CONTACT_C_PAIR(PAIR, A, B)                                                                                   \
  CONTACT_C_TEST(PAIR, A, B)                                                                                         \
  int32_t contact_compute_##PAIR(size_t count, const A* a, const B* b, double alarm, double contact, int32_t points, \
                                 const contact_contacts* out, size_t* hits);
CONTACT_C_PAIR(sphere_sphere, contact_sphere, contact_sphere)
CONTACT_C_PAIR(rigid_sphere_rigid_sphere, contact_sphere, contact_sphere)
CONTACT_C_PAIR(sphere_rigid_sphere, contact_sphere, contact_sphere)
CONTACT_C_TEST(cube_cube, contact_cube, contact_cube) /* a decision and no numbers, as in SOFA */
CONTACT_C_PAIR(sphere_cube, contact_sphere, contact_cube)
CONTACT_C_PAIR(sphere_capsule, contact_sphere, contact_capsule)
CONTACT_C_PAIR(capsule_capsule, contact_capsule, contact_capsule)
CONTACT_C_PAIR(sphere_triangle, contact_sphere, contact_triangle)
CONTACT_C_PAIR(ray_sphere, contact_ray, contact_sphere)
CONTACT_C_PAIR(sphere_plane, contact_sphere, contact_plane)
CONTACT_C_PAIR(capsule_plane, contact_capsule, contact_plane)
CONTACT_C_PAIR(ray_triangle, contact_ray, contact_triangle)
CONTACT_C_PAIR(triangle_line, contact_triangle, contact_line)
CONTACT_C_PAIR(cast_sphere, contact_ray, contact_sphere) /* where a ray first hits: the value counts its directions */
CONTACT_C_PAIR(cast_cube, contact_ray, contact_cube)
CONTACT_C_PAIR(cast_capsule, contact_ray, contact_capsule)
CONTACT_C_PAIR(cast_triangle, contact_ray, contact_triangle)
CONTACT_C_PAIR(cast_plane, contact_ray, contact_plane)
CONTACT_C_PAIR(obb_obb, contact_obb, contact_obb) /* any two convex shapes, from here on */
CONTACT_C_PAIR(sphere_obb, contact_sphere, contact_obb)
CONTACT_C_PAIR(capsule_cube, contact_capsule, contact_cube)
CONTACT_C_PAIR(capsule_obb, contact_capsule, contact_obb)
CONTACT_C_PAIR(capsule_triangle, contact_capsule, contact_triangle)
CONTACT_C_PAIR(cube_obb, contact_cube, contact_obb)
CONTACT_C_PAIR(cube_triangle, contact_cube, contact_triangle)
CONTACT_C_PAIR(obb_triangle, contact_obb, contact_triangle)
CONTACT_C_PAIR(triangle_triangle, contact_triangle, contact_triangle)
CONTACT_C_PAIR(cube_plane, contact_cube, contact_plane)
CONTACT_C_PAIR(obb_plane, contact_obb, contact_plane)
CONTACT_C_PAIR(triangle_plane, contact_triangle, contact_plane)
CONTACT_C_PAIR(sphere_hull, contact_sphere, contact_hull)
CONTACT_C_PAIR(capsule_hull, contact_capsule, contact_hull)
CONTACT_C_PAIR(cube_hull, contact_cube, contact_hull)
CONTACT_C_PAIR(obb_hull, contact_obb, contact_hull)
CONTACT_C_PAIR(triangle_hull, contact_triangle, contact_hull)
CONTACT_C_PAIR(hull_hull, contact_hull, contact_hull)
CONTACT_C_PAIR(hull_plane, contact_hull, contact_plane)
#undef CONTACT_C_TEST
#undef CONTACT_C_PAIR

/* A status in words. Never NULL; valid for ever. */
const char* contact_status_text(int32_t status);

/* What was wrong with the last call on this thread that did not return CONTACT_OK, such as "a[7].radius = -1: must not
   be negative". Never NULL; valid until this thread's next such call. */
const char* contact_last_error(void);

/* CONTACT_VERSION_STRING as the library was built. */
const char* contact_version(void);

#ifdef __cplusplus
}
#endif

#endif
