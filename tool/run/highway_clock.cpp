// Highway's shared library times its clock for 6 ms whenever it is loaded, for benchmarks that no program here runs. A
// program's own function of that name takes the place of the library's.
#include <hwy/nanobenchmark.h>

#include <cstdint>

std::uint64_t hwy::platform::TimerResolution() { return 1; }
