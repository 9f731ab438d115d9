// The same for the masks of one pair in one vector. Included inside contact::kernel::one_vector, after its `hn`.
#include "mutant_lanes.hpp"
namespace mutated {

#define MUTANT_MASK(name, wrong0, wrong1, wrong2, variants)                                                \
  CONTACT_LANES Mask name(unsigned place, Axes a, Axes b) {                                                \
    return ::mutant::on(place) ? Mask{pick(place, hn::name(a, b).lanes, wrong0, wrong1, wrong2, variants)} \
                               : hn::name(a, b);                                                           \
  }
MUTANT_MASK(And, ::_mm256_or_pd(a.lanes, b.lanes), a.lanes, b.lanes, 3)
MUTANT_MASK(Or, ::_mm256_and_pd(a.lanes, b.lanes), a.lanes, b.lanes, 3)
MUTANT_MASK(Eq, ::_mm256_cmp_pd(a.lanes, b.lanes, _CMP_NEQ_OQ), a.lanes, a.lanes, 1)
MUTANT_MASK(Ge, ::_mm256_cmp_pd(a.lanes, b.lanes, _CMP_GT_OQ), ::_mm256_cmp_pd(a.lanes, b.lanes, _CMP_LT_OQ), a.lanes,
            2)
#undef MUTANT_MASK
CONTACT_LANES Axes Abs(unsigned place, Axes x) {
  return ::mutant::on(place) ? Axes{pick(place, hn::Abs(x).lanes, x.lanes, x.lanes, x.lanes, 1)} : hn::Abs(x);
}

}  // namespace mutated
