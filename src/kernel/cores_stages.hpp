// A question about two cores, asked of the fast stage and, where that leaves something open, of the exact one. A kind
// of core has find_nearest and in_short_range for the first, exact_nearest and grid_of for the second.
#pragma once

#include "kernel/cores_double_double.hpp"
#include "kernel/floating_point_environment.hpp"

namespace contact::kernel {

/// What the fast stage computes of two kinds of core.
template <class First, class Second>
struct FastStage {
  using Nearest = ApproximateNearest;
  using OfContact = ApproximateContact;
};
template <class First, class Second>
using FastContact = std::optional<typename FastStage<First, Second>::OfContact>;

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

/// The decision of the filter, else of the contact's numbers, else the exact one.
template <class First, class Second>
[[gnu::always_inline]] inline bool settled(Filtered filtered, const FastContact<First, Second>& fast,
                                           const First& first, const Second& second, const Lengths& lengths) {
  if (filtered == Filtered::undecided && fast && fast->holds()) filtered = fast->filtered(lengths.alarm);
  return filtered == Filtered::undecided ? decide_exactly(first, second, lengths) : filtered == Filtered::hit;
}

template <class First, class Second>
[[gnu::always_inline]] inline bool contact_inline(const First& first, const Second& second, const Lengths& lengths,
                                                  ContactPoints points, Contact& contact) {
  const bool in_range = in_short_range(first) && in_short_range(second) && in_short_range(lengths);
  const Filtered filtered = in_range ? plain_filtered(first, second, lengths) : Filtered::undecided;
  if (filtered == Filtered::miss) return false;
  typename FastStage<First, Second>::Nearest nearest;
  FastContact<First, Second> fast;
  if (in_range && find_nearest(first, second, nearest)) fast.emplace(nearest, lengths);
  if (!settled(filtered, fast, first, second, lengths)) return false;
  const unsigned open = fast && fast->holds() ? round_certain(*fast, lengths, points, contact) : kAllNumbers;
  if (open != 0) round_open(first, second, lengths, points, open, contact);
  return true;
}

template <class First, class Second>
[[gnu::always_inline]] inline bool decide_inline(const First& first, const Second& second, const Lengths& lengths) {
  const bool in_range = in_short_range(first) && in_short_range(second) && in_short_range(lengths);
  const Filtered filtered = in_range ? plain_filtered(first, second, lengths) : Filtered::undecided;
  if (filtered != Filtered::undecided) return filtered == Filtered::hit;
  typename FastStage<First, Second>::Nearest nearest;
  FastContact<First, Second> fast;
  if (in_range && find_nearest(first, second, nearest)) fast.emplace(nearest, lengths);
  return settled(filtered, fast, first, second, lengths);
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

/// Their contact.
template <class First, class Second>
std::optional<Contact> contact_between(const First& first, const Second& second, const Lengths& lengths,
                                       ContactPoints points) {
  const RoundToNearest environment;
  std::optional<Contact> contact(std::in_place, Unset());
  bool hit = false;
#if defined(__x86_64__) && !defined(__FMA__)
  if (__builtin_cpu_supports("fma"))
    hit = contact_by_fma(first, second, lengths, points, *contact);
  else
#endif
    hit = contact_portably(first, second, lengths, points, *contact);
  if (!hit) contact.reset();
  return contact;
}

}  // namespace contact::kernel
