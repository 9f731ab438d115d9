// The same for the functions on the lanes of one pair, one_pair_lanes-inl.h and its like. Included where these are,
// with CONTACT_LANES.
namespace mutated {

template <class R>
CONTACT_LANES R pick_lanes(unsigned place, R right, R wrong0, R wrong1, unsigned variants) {
  if (!::mutant::recording) return ::mutant::chosen >= variants ? right : ::mutant::chosen == 0 ? wrong0 : wrong1;
  for (unsigned i = 0; i < variants; ++i)
    ::mutant::note(
        place, i,
        std::memcmp(&right, i == 0 ? &wrong0 : &wrong1, sizeof right) == 0 ? ::mutant::kUnchanged : ::mutant::kChanged);
  return right;
}
template <class T>
CONTACT_LANES T negative(T x) {
  return hn::Sub(hn::Sub(x, x), x);
}

#define MUTANT_LANES2(name, wrong)                                                                                \
  template <class T>                                                                                              \
  CONTACT_LANES T name(unsigned place, T a, T b) {                                                                \
    return ::mutant::on(place) ? pick_lanes<T>(place, hn::name(a, b), wrong, hn::name(a, b), 1) : hn::name(a, b); \
  }
#define MUTANT_LANES3(name, wrong0, wrong1)                                                                      \
  template <class T>                                                                                             \
  CONTACT_LANES T name(unsigned place, T a, T b, T c) {                                                          \
    return ::mutant::on(place) ? pick_lanes<T>(place, hn::name(a, b, c), wrong0, wrong1, 2) : hn::name(a, b, c); \
  }
MUTANT_LANES2(Add, hn::Sub(a, b))
MUTANT_LANES2(Sub, hn::Add(a, b))
MUTANT_LANES2(Mul, hn::Add(a, b))
MUTANT_LANES2(Max, (a > b ? b : a))
MUTANT_LANES3(MulAdd, hn::MulAdd(negative(a), b, c), hn::MulSub(a, b, c))
MUTANT_LANES3(MulSub, hn::MulAdd(a, b, c), hn::MulSub(negative(a), b, c))
MUTANT_LANES3(NegMulAdd, hn::MulAdd(a, b, c), hn::MulSub(negative(a), b, c))
MUTANT_LANES3(NegMulSub, hn::MulSub(a, b, c), hn::MulAdd(negative(a), b, c))

#undef MUTANT_LANES2
#undef MUTANT_LANES3

}  // namespace mutated
