// The kernels of all kinds of pairs that have Feet, and the hits of two balls.
#ifndef HWY_TARGET_INCLUDE  // else one of those of batch_vectors.cpp
#define HWY_TARGET_INCLUDE "kernel/batch_cores.cpp"
#endif
#include "kernel/batch_targets.hpp"
// foreach_target.h includes this file once a target, so it comes before the rest.
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "kernel/batch_balls-inl.h"
#include "kernel/batch_crossing-inl.h"
#include "kernel/batch_over_plane-inl.h"
#include "kernel/batch_point_segment-inl.h"
#include "kernel/batch_sphere_cube-inl.h"
#include "kernel/batch_ways-inl.h"

HWY_BEFORE_NAMESPACE();
namespace contact::kernel {
namespace HWY_NAMESPACE {

#define CONTACT_KERNELS(name, A, B)                                                                               \
  batch::Count test_##name(const PairColumns<A, B>& pairs, double alarm, std::uint8_t* hit) {                     \
    return test_cores(pairs, alarm, hit);                                                                         \
  }                                                                                                               \
  batch::Count compute_##name(const PairColumns<A, B>& pairs, const ContactQuestion& question,                    \
                              const ContactRows& out) {                                                           \
    return compute_cores(pairs, question, out);                                                                   \
  }                                                                                                               \
  batch::Count hits_##name(const PairColumns<A, B>& pairs, const ContactQuestion& question, std::uint32_t* index, \
                           const ContactRows& out) {                                                              \
    return compute_hits_cores(pairs, question, index, out);                                                       \
  }
CONTACT_CORES(CONTACT_KERNELS)
#undef CONTACT_KERNELS
batch::Count hits_sphere_sphere(const SpherePairs& pairs, const ContactQuestion& question, std::uint32_t* index,
                                const ContactRows& out) {
  return compute_hits_cores(pairs, question, index, out);
}
#define CONTACT_FIND_CORES(name, A, B) \
  bool cores_of_##name(const PairColumns<A, B>& pairs, CoreColumns& to) { return cores_of_strip(pairs, to); }
CONTACT_CORES_APART(CONTACT_FIND_CORES)
#undef CONTACT_FIND_CORES

}  // namespace HWY_NAMESPACE
}  // namespace contact::kernel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace contact::kernel {

#define CONTACT_DISPATCH(name, A, B)                                                                 \
  HWY_EXPORT(test_##name);                                                                           \
  HWY_EXPORT(compute_##name);                                                                        \
  HWY_EXPORT(hits_##name);                                                                           \
  batch::Count test_vectors(const PairColumns<A, B>& pairs, double alarm, std::uint8_t* hit) {       \
    return HWY_DYNAMIC_DISPATCH(test_##name)(pairs, alarm, hit);                                     \
  }                                                                                                  \
  batch::Count compute_vectors(const PairColumns<A, B>& pairs, const ContactQuestion& question,      \
                               const ContactRows& out) {                                             \
    return HWY_DYNAMIC_DISPATCH(compute_##name)(pairs, question, out);                               \
  }                                                                                                  \
  batch::Count compute_hits_vectors(const PairColumns<A, B>& pairs, const ContactQuestion& question, \
                                    std::uint32_t* index, const ContactRows& out) {                  \
    return HWY_DYNAMIC_DISPATCH(hits_##name)(pairs, question, index, out);                           \
  }
CONTACT_CORES(CONTACT_DISPATCH)
#undef CONTACT_DISPATCH
HWY_EXPORT(hits_sphere_sphere);
batch::Count compute_hits_vectors(const SpherePairs& pairs, const ContactQuestion& question, std::uint32_t* index,
                                  const ContactRows& out) {
  return HWY_DYNAMIC_DISPATCH(hits_sphere_sphere)(pairs, question, index, out);
}
#define CONTACT_FIND_CORES(name, A, B)                               \
  HWY_EXPORT(cores_of_##name);                                       \
  bool find_cores(const PairColumns<A, B>& pairs, CoreColumns& to) { \
    return HWY_DYNAMIC_DISPATCH(cores_of_##name)(pairs, to);         \
  }
CONTACT_CORES_APART(CONTACT_FIND_CORES)
#undef CONTACT_FIND_CORES

}  // namespace contact::kernel
#endif  // HWY_ONCE
