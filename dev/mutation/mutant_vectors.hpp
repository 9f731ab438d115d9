// The same for Highway's functions. Included once an instruction set, inside contact::kernel::HWY_NAMESPACE, after
// `hn`.
namespace mutated {

template <class R>
HWY_INLINE bool same_lanes(R x, R y) {
  using Doubles = hn::ScalableTag<double>;
  if constexpr (std::is_same_v<R, hn::Mask<Doubles>>) {
    HWY_ALIGN std::uint8_t a[64] = {};
    HWY_ALIGN std::uint8_t b[64] = {};
    hn::StoreMaskBits(Doubles(), x, a);
    hn::StoreMaskBits(Doubles(), y, b);
    return std::memcmp(a, b, sizeof a) == 0;
  } else if constexpr (std::is_same_v<R, hn::Vec<Doubles>>) {
    HWY_ALIGN double a[HWY_MAX_BYTES / sizeof(double)] = {};
    HWY_ALIGN double b[HWY_MAX_BYTES / sizeof(double)] = {};
    hn::StoreU(x, Doubles(), a);
    hn::StoreU(y, Doubles(), b);
    return std::memcmp(a, b, sizeof a) == 0;
  } else if constexpr (std::is_arithmetic_v<R>) {
    return x == y;
  } else {
    return false;
  }
}

template <class R>
HWY_NOINLINE R pick(unsigned place, R right, R wrong0, R wrong1, R wrong2, unsigned variants) {
  if (!::mutant::recording) {
    if (::mutant::chosen >= variants) return right;
    return ::mutant::chosen == 0 ? wrong0 : ::mutant::chosen == 1 ? wrong1 : wrong2;
  }
  for (unsigned i = 0; i < variants; ++i) {
    const bool same = same_lanes<R>(right, i == 0 ? wrong0 : i == 1 ? wrong1 : wrong2);
    ::mutant::note(place, i, same ? ::mutant::kUnchanged : ::mutant::kChanged);
  }
  return right;
}

#define MUTANT_VECTOR1(name, right, wrong)                                         \
  template <class A>                                                               \
  HWY_INLINE auto name(unsigned place, A a) {                                      \
    using R = decltype(right);                                                     \
    if (::mutant::on(place)) return pick<R>(place, right, wrong, wrong, wrong, 1); \
    return right;                                                                  \
  }
#define MUTANT_VECTOR2(name, wrong0, wrong1, wrong2, variants)                                        \
  template <class A, class B>                                                                         \
  HWY_INLINE auto name(unsigned place, A a, B b) {                                                    \
    using R = decltype(hn::name(a, b));                                                               \
    if (::mutant::on(place)) return pick<R>(place, hn::name(a, b), wrong0, wrong1, wrong2, variants); \
    return hn::name(a, b);                                                                            \
  }
#define MUTANT_VECTOR3(name, wrong0, wrong1, variants)                                                   \
  template <class A, class B, class C>                                                                   \
  HWY_INLINE auto name(unsigned place, A a, B b, C c) {                                                  \
    using R = decltype(hn::name(a, b, c));                                                               \
    if (::mutant::on(place)) return pick<R>(place, hn::name(a, b, c), wrong0, wrong1, wrong1, variants); \
    return hn::name(a, b, c);                                                                            \
  }

MUTANT_VECTOR1(Neg, hn::Neg(a), a)
MUTANT_VECTOR1(Abs, hn::Abs(a), a)
MUTANT_VECTOR1(Not, hn::Not(a), a)
MUTANT_VECTOR2(Add, hn::Sub(a, b), a, b, 1)
MUTANT_VECTOR2(Sub, hn::Add(a, b), a, b, 1)
MUTANT_VECTOR2(Mul, hn::Add(a, b), a, b, 1)
MUTANT_VECTOR2(Div, hn::Mul(a, b), a, b, 1)
MUTANT_VECTOR2(Min, hn::Max(a, b), a, b, 1)
MUTANT_VECTOR2(Max, hn::Min(a, b), a, b, 1)
MUTANT_VECTOR2(Lt, hn::Le(a, b), hn::Ge(a, b), hn::Ge(a, b), 2)
MUTANT_VECTOR2(Le, hn::Lt(a, b), hn::Gt(a, b), hn::Gt(a, b), 2)
MUTANT_VECTOR2(Gt, hn::Ge(a, b), hn::Le(a, b), hn::Le(a, b), 2)
MUTANT_VECTOR2(Ge, hn::Gt(a, b), hn::Lt(a, b), hn::Lt(a, b), 2)
MUTANT_VECTOR2(Eq, hn::Ne(a, b), hn::Ne(a, b), hn::Ne(a, b), 1)
MUTANT_VECTOR2(Ne, hn::Eq(a, b), hn::Eq(a, b), hn::Eq(a, b), 1)
MUTANT_VECTOR2(And, hn::Or(a, b), a, b, 3)
MUTANT_VECTOR2(Or, hn::And(a, b), a, b, 3)
MUTANT_VECTOR2(AndNot, hn::And(a, b), b, b, 2)
MUTANT_VECTOR3(MulAdd, hn::NegMulAdd(a, b, c), hn::MulSub(a, b, c), 2)
MUTANT_VECTOR3(MulSub, hn::MulAdd(a, b, c), hn::NegMulSub(a, b, c), 2)
MUTANT_VECTOR3(NegMulAdd, hn::MulAdd(a, b, c), hn::NegMulSub(a, b, c), 2)
MUTANT_VECTOR3(NegMulSub, hn::MulSub(a, b, c), hn::NegMulAdd(a, b, c), 2)
MUTANT_VECTOR3(IfThenElse, b, c, 2)

template <class A, class B>
HWY_INLINE B IfThenElseZero(unsigned place, A mask, B b) {
  if (::mutant::on(place)) return pick<B>(place, hn::IfThenElseZero(mask, b), b, b, b, 1);
  return hn::IfThenElseZero(mask, b);
}
template <class T, class M_>
HWY_INLINE bool AllTrue(unsigned place, T d, M_ mask) {
  const bool right = hn::AllTrue(d, mask);
  if (::mutant::on(place)) return pick<bool>(place, right, !right, right, right, 1);
  return right;
}
template <class T, class M_>
HWY_INLINE bool AllFalse(unsigned place, T d, M_ mask) {
  const bool right = hn::AllFalse(d, mask);
  if (::mutant::on(place)) return pick<bool>(place, right, !right, right, right, 1);
  return right;
}

#undef MUTANT_VECTOR1
#undef MUTANT_VECTOR2
#undef MUTANT_VECTOR3

}  // namespace mutated
