// The kernels of many pairs in vectors, as one file: Highway is read once an instruction set for them all.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernel/batch_vectors.cpp"
#include "kernel/batch_targets.hpp"
// foreach_target.h includes this file once a target, so it comes before the rest.
#include <hwy/foreach_target.h>

#include "kernel/batch_cores.cpp"
#include "kernel/batch_cube_cube.cpp"
#include "kernel/batch_sphere_sphere.cpp"
