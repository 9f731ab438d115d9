// Highway's functions on single numbers: the lanes of one pair. Included where double_double-inl.h is to be, with
// CONTACT_LANES.
namespace hn {

template <class T>
CONTACT_LANES T Add(T a, T b) {
  return a + b;
}
template <class T>
CONTACT_LANES T Sub(T a, T b) {
  return a - b;
}
template <class T>
CONTACT_LANES T Mul(T a, T b) {
  return a * b;
}
template <class T>
CONTACT_LANES T Abs(T a) {
  return a < 0 ? -a : a;
}
template <class T>
CONTACT_LANES T Max(T a, T b) {
  return a > b ? a : b;
}
template <class T>
CONTACT_LANES T MulAdd(T a, T b, T c) {
  using std::fma;
  return fma(a, b, c);
}
template <class T>
CONTACT_LANES T MulSub(T a, T b, T c) {
  return MulAdd(a, b, -c);
}
template <class T>
CONTACT_LANES T NegMulAdd(T a, T b, T c) {
  return MulAdd(-a, b, c);
}
template <class T>
CONTACT_LANES T NegMulSub(T a, T b, T c) {
  return MulAdd(-a, b, -c);
}

}  // namespace hn
