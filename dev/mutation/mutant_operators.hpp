// The functions of mutant.hpp, which includes this twice: at run time alone, and constexpr.

// Two operands. A change exists where it compiles and gives what converts to the same type.
#define MUTANT_WRONG(expression)                                                               \
  [&]<class X_, class Y_>(const X_& x, const Y_& y) {                                          \
    if constexpr (requires { static_cast<R>(expression); }) return static_cast<R>(expression); \
  }
#define MUTANT_BINARY2(name, op, op1, op2)                                            \
  template <class A, class B>                                                         \
  MUTANT_FUNCTION auto name(unsigned place, const A& a, const B& b) {                 \
    using R = std::decay_t<decltype(a op b)>;                                         \
    if (MUTANT_ON(place))                                                             \
      return pick<R>(                                                                 \
          place, static_cast<R>(a op b), [&] { return MUTANT_WRONG(x op1 y)(a, b); }, \
          [&] { return MUTANT_WRONG(x op2 y)(a, b); });                               \
    return static_cast<R>(a op b);                                                    \
  }
#define MUTANT_BINARY(name, op, op1)                                                                                  \
  template <class A, class B>                                                                                         \
  MUTANT_FUNCTION auto name(unsigned place, const A& a, const B& b) {                                                 \
    using R = std::decay_t<decltype(a op b)>;                                                                         \
    if (MUTANT_ON(place)) return pick<R>(place, static_cast<R>(a op b), [&] { return MUTANT_WRONG(x op1 y)(a, b); }); \
    return static_cast<R>(a op b);                                                                                    \
  }
MUTANT_BINARY2(lt, <, <=, >=)
MUTANT_BINARY2(le, <=, <, >)
MUTANT_BINARY2(gt, >, >=, <=)
MUTANT_BINARY2(ge, >=, >, <)
MUTANT_BINARY(eq, ==, !=)
MUTANT_BINARY(ne, !=, ==)
MUTANT_BINARY(add, +, -)
MUTANT_BINARY(sub, -, +)
MUTANT_BINARY(shl, <<, >>)
MUTANT_BINARY(shr, >>, <<)
MUTANT_BINARY(bit_and, &, |)
MUTANT_BINARY(bit_or, |, &)
MUTANT_BINARY(bit_xor, ^, |)
MUTANT_BINARY(div, /, *)

// A division by an integer 0 ends the program: while recording it must not happen.
#define MUTANT_DIVIDE(name, op, op1)                                    \
  template <class A, class B>                                           \
  MUTANT_FUNCTION auto name(unsigned place, const A& a, const B& b) {   \
    using R = std::decay_t<decltype(a op b)>;                           \
    if (MUTANT_ON(place))                                               \
      return pick<R>(place, static_cast<R>(a op b), [&] {               \
        if constexpr (std::is_integral_v<B>)                            \
          if (recording && b == 0) return static_cast<R>((a op b) + 1); \
        return MUTANT_WRONG(x op1 y)(a, b);                             \
      });                                                               \
    return static_cast<R>(a op b);                                      \
  }
MUTANT_DIVIDE(mul, *, /)
MUTANT_DIVIDE(mod, %, /)

// Compound assignment.
#define MUTANT_ASSIGN(name, op, op1)                          \
  template <class A, class B>                                 \
  MUTANT_FUNCTION A& name(unsigned place, A& a, const B& b) { \
    if (MUTANT_ON(place)) {                                   \
      const bool exists = [](auto& x, const auto& y) {        \
        return requires { x op1 y; };                         \
      }(a, b);                                                \
      if (recording)                                          \
        note(place, 0, exists ? kChanged : kNone);            \
      else if (chosen == 0)                                   \
        if constexpr (requires { a op1 b; }) {                \
          a op1 b;                                            \
          return a;                                           \
        }                                                     \
    }                                                         \
    a op b;                                                   \
    return a;                                                 \
  }
MUTANT_ASSIGN(add_to, +=, -=)
MUTANT_ASSIGN(sub_from, -=, +=)
MUTANT_ASSIGN(mul_by, *=, +=)
MUTANT_ASSIGN(div_by, /=, *=)
MUTANT_ASSIGN(shl_by, <<=, >>=)
MUTANT_ASSIGN(shr_by, >>=, <<=)
MUTANT_ASSIGN(or_with, |=, &=)
MUTANT_ASSIGN(and_with, &=, |=)

#define MUTANT_UNARY(name, op, wrong)                                                                             \
  template <class A>                                                                                              \
  MUTANT_FUNCTION auto name(unsigned place, const A& a) {                                                         \
    using R = std::decay_t<decltype(op a)>;                                                                       \
    if (MUTANT_ON(place)) return pick<R>(place, static_cast<R>(op a), [&] { return MUTANT_WRONG(wrong)(a, a); }); \
    return static_cast<R>(op a);                                                                                  \
  }
MUTANT_UNARY(negative, -, x)
MUTANT_UNARY(negation, !, x)
MUTANT_UNARY(complement, ~, x)

#define MUTANT_STEP(name, op, op1)                \
  template <class A>                              \
  MUTANT_FUNCTION A& name(unsigned place, A& a) { \
    if (MUTANT_ON(place)) {                       \
      if constexpr (requires { op1 a; }) {        \
        if (recording)                            \
          note(place, 0, kChanged);               \
        else if (chosen == 0)                     \
          return op1 a;                           \
      } else if (recording)                       \
        note(place, 0, kNone);                    \
    }                                             \
    return op a;                                  \
  }
MUTANT_STEP(increment, ++, --)
MUTANT_STEP(decrement, --, ++)

/// A condition that is true where it is false.
template <class A>
MUTANT_FUNCTION bool condition(unsigned place, const A& a) {
  const bool right = static_cast<bool>(a);
  if (MUTANT_ON(place)) return pick<bool>(place, right, [&] { return !right; });
  return right;
}
/// An operand of && that is left out, and one of ||.
template <class A>
MUTANT_FUNCTION bool conjunct(unsigned place, const A& a) {
  const bool right = static_cast<bool>(a);
  if (MUTANT_ON(place)) return pick<bool>(place, right, [] { return true; });
  return right;
}
template <class A>
MUTANT_FUNCTION bool disjunct(unsigned place, const A& a) {
  const bool right = static_cast<bool>(a);
  if (MUTANT_ON(place)) return pick<bool>(place, right, [] { return false; });
  return right;
}

/// A literal or a named constant.
template <class A>
MUTANT_FUNCTION A constant_of(unsigned place, A a) {
  if (MUTANT_ON(place)) {
    if constexpr (std::is_same_v<A, bool>)
      return pick<A>(
          place, a, [&] { return !a; }, [] {});
    else if constexpr (std::is_integral_v<A>)
      return pick<A>(
          place, a, [&] { return static_cast<A>(a + 1); }, [&] { return static_cast<A>(a - 1); });
    else if constexpr (std::is_floating_point_v<A>)
      return pick<A>(
          place, a, [&] { return a == 0 ? A(1) : A(0); }, [&] { return a == 0 ? A(-1) : a * 1024; });
  }
  return a;
}

/// What is returned: 0, false for true, or nothing.
template <class A>
MUTANT_FUNCTION std::remove_cvref_t<A> returned(unsigned place, A&& a) {
  using R = std::remove_cvref_t<A>;
  if (MUTANT_ON(place)) {
    if constexpr (std::is_same_v<R, bool>) {
      return pick<R>(place, a, [&] { return !a; });
    } else if constexpr (std::is_default_constructible_v<R> && !std::is_pointer_v<R>) {
      if (recording) {
        bool changed = true;
        if constexpr (std::is_arithmetic_v<R>) changed = !same<R>(a, R{});
        note(place, 0, changed ? kChanged : kUnchanged);
      } else if (chosen == 0) {
        return R{};
      }
    } else if (recording) {
      note(place, 0, kNone);
    }
  }
  return std::forward<A>(a);
}

/// Whether a statement is executed.
MUTANT_FUNCTION bool keep(unsigned place) {
  if (MUTANT_ON(place)) return pick<bool>(place, true, [] { return false; });
  return true;
}

// Functions that have a near relative.
template <class A>
MUTANT_FUNCTION A least_of(unsigned place, const A& a, const std::type_identity_t<A>& b) {
  if (MUTANT_ON(place)) return pick<A>(place, std::min(a, b), [&] { return std::max(a, b); });
  return std::min(a, b);
}
template <class A>
MUTANT_FUNCTION A greatest_of(unsigned place, const A& a, const std::type_identity_t<A>& b) {
  if (MUTANT_ON(place)) return pick<A>(place, std::max(a, b), [&] { return std::min(a, b); });
  return std::max(a, b);
}
template <class A>
inline auto magnitude(unsigned place, A a) {
  using R = decltype(std::abs(a));
  if (::mutant::on(place)) return pick<R>(place, std::abs(a), [&] { return static_cast<R>(a); });
  return std::abs(a);
}
inline double fused(unsigned place, double a, double b, double c) {
  if (::mutant::on(place))
    return pick<double>(
        place, std::fma(a, b, c), [&] { return std::fma(a, b, -c); },
        [&] {
          volatile double product = a * b;
          return product + c;
        });
  return std::fma(a, b, c);
}

#undef MUTANT_WRONG
#undef MUTANT_BINARY2
#undef MUTANT_BINARY
#undef MUTANT_DIVIDE
#undef MUTANT_ASSIGN
#undef MUTANT_UNARY
#undef MUTANT_STEP
