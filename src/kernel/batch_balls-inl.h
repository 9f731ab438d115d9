// Many pairs of balls of which the hits alone are asked, and what else comes to balls: their contacts are those of
// batch_sphere_sphere.cpp.
#if defined(CONTACT_KERNEL_BATCH_BALLS_INL_H) == defined(HWY_TARGET_TOGGLE)  // once a target
#ifdef CONTACT_KERNEL_BATCH_BALLS_INL_H
#undef CONTACT_KERNEL_BATCH_BALLS_INL_H
#else
#define CONTACT_KERNEL_BATCH_BALLS_INL_H
#endif

#include "kernel/batch_cores-inl.h"

#if HWY_HAVE_FLOAT64  // else nothing is here, and no attribute for it
HWY_BEFORE_NAMESPACE();
namespace contact::kernel {
namespace HWY_NAMESPACE {

#if HWY_NATIVE_FMA
/// The contacts of a strip; columns and rows have room for whole vectors. Returns how many needed exact arithmetic.
std::size_t contacts_with_balls(const SpherePairs& pairs, const ContactQuestion& question, const ContactRows& out);
/// The same where the second balls are points.
std::size_t contacts_with_points(const SpherePairs& pairs, const ContactQuestion& question, const ContactRows& out);
#endif

template <>
struct Feet<Ball, Ball> {
  V d2, radii;

  HWY_INLINE Feet(const SpherePairs& pairs, std::size_t i) {
    const Loaded in(pairs, i);
    d2 = squared_length(hn::Sub(in.bx, in.ax), hn::Sub(in.by, in.ay), hn::Sub(in.bz, in.az));
    radii = hn::Add(in.ar, in.br);
  }
  HWY_INLINE void filter(double alarm, M& hit, M& miss) const {
    kernel::HWY_NAMESPACE::filter(d2, hn::Add(radii, all(alarm)), hit, miss);
  }

#if HWY_NATIVE_FMA
  /// The second half begins with the question.
  HWY_INLINE void find_cores(CoreColumns& /*to*/, std::size_t /*i*/) const {}
  static void contacts(const Strip<Ball, Ball>& of) {
    of.left.exact = contacts_with_balls(of.pairs, of.question, of.out);
    const batch::PairState* const state = of.out.state;
    const auto misses = std::count(state, state + of.pairs.size, batch::PairState::miss);
    of.left.hits = of.pairs.size - static_cast<std::size_t>(misses);
  }
#endif
};

}  // namespace HWY_NAMESPACE
}  // namespace contact::kernel
HWY_AFTER_NAMESPACE();
#endif  // HWY_HAVE_FLOAT64

#endif  // once a target
