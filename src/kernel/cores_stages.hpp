// A question about two cores, asked of the fast stage and, where that leaves something open, of the exact one. A kind
// of core has find_nearest and in_short_range for the first, exact_nearest and grid_of for the second.
#pragma once

#include "kernel/cores_double_double.hpp"
#include "kernel/cores_one_vector.hpp"
#include "kernel/floating_point_environment.hpp"
#include "kernel/simple_points.hpp"

namespace contact::kernel {

template <class First, class Second>
[[gnu::noinline]] bool decide_exactly(const First& first, const Second& second, const Lengths& lengths) {
  const auto grid = grid_of(first, second, lengths);
  return is_hit(exact_nearest(first, second, grid), grid, lengths);
}

template <class First, class Second>
[[gnu::noinline]] void round_open(const First& first, const Second& second, const Lengths& lengths,
                                  ContactPoints points, unsigned open, Contact& contact) {
  const auto grid = grid_of(first, second, lengths);
  round_exactly(exact_nearest(first, second, grid), grid, lengths, points, open, contact);
}

/// Of cores whose nearest points are simple and do not meet: a miss, or a hit and its contact; else neither.
template <class First, class Second>
[[gnu::noinline]] Filtered contact_at_simple_points([[maybe_unused]] const First& first,
                                                    [[maybe_unused]] const Second& second,
                                                    [[maybe_unused]] const Lengths& lengths,
                                                    [[maybe_unused]] ContactPoints points,
                                                    [[maybe_unused]] Contact& contact) {
  if constexpr (MayBeSimple<First, Second>) {
    SimplePoints at;
    if (!simple_points(first, second, at) || at.p == at.q) return Filtered::undecided;
    if (!contact_of_balls({at.p, lengths.radius1}, {at.q, lengths.radius2}, {lengths.alarm, lengths.contact}, points,
                          contact))
      return Filtered::miss;
    contact.unique = at.unique;
    return Filtered::hit;
  }
  return Filtered::undecided;
}
template <class First, class Second>
[[gnu::noinline]] Filtered decide_at_simple_points([[maybe_unused]] const First& first,
                                                   [[maybe_unused]] const Second& second,
                                                   [[maybe_unused]] const Lengths& lengths) {
  if constexpr (MayBeSimple<First, Second>) {
    SimplePoints at;
    if (!simple_points(first, second, at)) return Filtered::undecided;
    return decide_balls({at.p, lengths.radius1}, {at.q, lengths.radius2}, lengths.alarm) ? Filtered::hit
                                                                                         : Filtered::miss;
  }
  return Filtered::undecided;
}

/// Asks of the numbers of a contact, `ask(fast)`, where the fast stage has them. (Without std::optional, whose constructors are
/// functions of their own to gcc: each fused multiply-add would be a call there.)
template <class First, class Second, class Ask>
[[gnu::always_inline]] inline void with_fast_stage(const First& first, const Second& second, const Lengths& lengths,
                                                   const Ask& ask) {
  if (!(in_short_range(first) && in_short_range(second) && in_short_range(lengths))) return;
  typename FastStage<First, Second>::Nearest nearest;
  if (!find_nearest(first, second, nearest)) return;
  const typename FastStage<First, Second>::OfContact fast(nearest, lengths);
  if (fast.holds()) ask(fast);
}

template <class First, class Second>
[[gnu::always_inline]] inline bool contact_inline(const First& first, const Second& second, const Lengths& lengths,
                                                  ContactPoints points, Contact& contact) {
  Filtered filtered = plain_filtered(first, second, lengths);
  if (filtered == Filtered::miss) return false;
  const Filtered simple = contact_at_simple_points(first, second, lengths, points, contact);
  if (simple != Filtered::undecided) return simple == Filtered::hit;
  unsigned open = kAllNumbers;
  with_fast_stage(first, second, lengths, [&](const auto& fast) {
    if (filtered == Filtered::undecided) filtered = fast.filtered(lengths.alarm);
    if (filtered != Filtered::miss) open = round_certain(fast, lengths, points, contact);
  });
  if (filtered == Filtered::undecided)
    filtered = decide_exactly(first, second, lengths) ? Filtered::hit : Filtered::miss;
  if (filtered == Filtered::miss) return false;
  if (open != 0) open = settle_foot(first, second, open, contact);
  if (open != 0) round_open(first, second, lengths, points, open, contact);
  return true;
}

template <class First, class Second>
[[gnu::always_inline]] inline bool decide_inline(const First& first, const Second& second, const Lengths& lengths) {
  Filtered filtered = plain_filtered(first, second, lengths);
  if (filtered == Filtered::undecided) filtered = decide_at_simple_points(first, second, lengths);
  if (filtered == Filtered::undecided)
    with_fast_stage(first, second, lengths, [&](const auto& fast) { filtered = fast.filtered(lengths.alarm); });
  return filtered == Filtered::undecided ? decide_exactly(first, second, lengths) : filtered == Filtered::hit;
}

// Behind calls that are not inlined: what RoundToNearest sets must be set before anything is computed.

template <class First, class Second>
[[gnu::noinline, gnu::flatten]] bool contact_portably(const First& first, const Second& second, const Lengths& lengths,
                                                      ContactPoints points, Contact& contact) {
  return contact_inline(first, second, lengths, points, contact);
}
template <class First, class Second>
[[gnu::noinline, gnu::flatten]] bool decide_portably(const First& first, const Second& second, const Lengths& lengths) {
  return decide_inline(first, second, lengths);
}

#if defined(__x86_64__) && !defined(__FMA__)
// The same bits: std::fma is an instruction here, and a call above.
template <class First, class Second>
[[gnu::noinline, gnu::flatten, gnu::target("fma")]] bool contact_by_fma(const First& first, const Second& second,
                                                                        const Lengths& lengths, ContactPoints points,
                                                                        Contact& contact) {
  return contact_inline(first, second, lengths, points, contact);
}
template <class First, class Second>
[[gnu::noinline, gnu::flatten, gnu::target("fma")]] bool decide_by_fma(const First& first, const Second& second,
                                                                       const Lengths& lengths) {
  return decide_inline(first, second, lengths);
}
#endif

/// Whether two cores with these lengths are within the alarm distance, in any floating-point environment.
template <class First, class Second>
bool decide(const First& first, const Second& second, const Lengths& lengths) {
  const RoundToNearest environment;
#if defined(__x86_64__) && !defined(__FMA__)
  if (__builtin_cpu_supports("fma")) return decide_by_fma(first, second, lengths);
#endif
  return decide_portably(first, second, lengths);
}

#if CONTACT_HAS_ONE_VECTOR
template <class First, class Second>
concept HasOneVector = requires(const First& first, const Second& second, const Lengths& lengths, Contact& contact) {
  one_vector::contact_of(first, second, lengths, ContactPoints{}, contact);
};
/// A miss, a hit whose contact is settled, or neither.
template <class First, class Second>
[[gnu::noinline, gnu::flatten, gnu::target("avx2,fma")]] Filtered contact_by_one_vector(
    const First& first, const Second& second, const Lengths& lengths, ContactPoints points, Contact& contact) {
  return one_vector::contact_of(first, second, lengths, points, contact);
}
#endif

/// Whether there is a contact, and it.
template <class First, class Second>
bool contact_of_pair(const First& first, const Second& second, const Lengths& lengths, ContactPoints points,
                     Contact& contact) {
#if CONTACT_HAS_ONE_VECTOR
  if constexpr (HasOneVector<First, Second>)
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
      const Filtered said = contact_by_one_vector(first, second, lengths, points, contact);
      if (said != Filtered::undecided) return said == Filtered::hit;
    }
#endif
#if defined(__x86_64__) && !defined(__FMA__)
  if (__builtin_cpu_supports("fma")) return contact_by_fma(first, second, lengths, points, contact);
#endif
  return contact_portably(first, second, lengths, points, contact);
}

/// Their contact.
template <class First, class Second>
std::optional<Contact> contact_between(const First& first, const Second& second, const Lengths& lengths,
                                       ContactPoints points) {
  const RoundToNearest environment;
  std::optional<Contact> contact(std::in_place, Unset());
  if (!contact_of_pair(first, second, lengths, points, *contact)) contact.reset();
  return contact;
}

#if CONTACT_HAS_ONE_VECTOR
template <class A, class B>
[[gnu::noinline, gnu::flatten, gnu::target("avx2,fma")]] bool hit_by_one_vector(const A& a, const B& b,
                                                                                double contact_distance,
                                                                                ContactPoints points,
                                                                                Contact& contact) {
  return one_vector::contact_of_hit(a, b, contact_distance, points, contact);
}
#endif
/// The contact of shapes that plain arithmetic says there is one of: in one vector, or by `otherwise`.
template <class A, class B, class Otherwise>
std::optional<Contact> contact_of_hit([[maybe_unused]] const A& a, [[maybe_unused]] const B& b,
                                      [[maybe_unused]] double contact_distance, [[maybe_unused]] ContactPoints points,
                                      const Otherwise& otherwise) {
  std::optional<Contact> contact(std::in_place, Unset());
#if CONTACT_HAS_ONE_VECTOR
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    const RoundToNearest environment;
    if (hit_by_one_vector(a, b, contact_distance, points, *contact)) return contact;
  }
#endif
  contact = otherwise();
  return contact;
}

}  // namespace contact::kernel
