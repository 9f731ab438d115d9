// The peers: other libraries' answers about pairs of every kind, called as their users call them.
#pragma once

#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "contact/contact.hpp"
#include "contact/geometry.hpp"
#include "oracle/judge/conventions.hpp"
#include "oracle/truth/query.hpp"

namespace contact::bench {

/// Of the pairs of any two convex shapes two rotated boxes alone are asked.
inline Two<Obb, Obb> obbs(const Convexes& shapes) {
  return {std::get<Obb>(shapes.a.shape), std::get<Obb>(shapes.b.shape)};
}

/// What a peer writes for a pair; a number that it does not give is left alone. `contact.point1` alone where the
/// convention is one point.
struct PeerAnswer {
  Contact contact;
  bool hit;
};

/// Loops over many pairs of a kind in which a library's call is inlined; empty where it has none.
template <class Asked>
struct Loops {
  using Kind = Asked;
  std::function<void(std::span<const Asked>, std::uint8_t*)> test;
  std::function<void(std::span<const Asked>, PeerAnswer*)> compute;
};

template <class... Kinds>
struct LoopsOfAll;
template <class... Kinds>
struct LoopsOfAll<void, Kinds...> {
  using Type = std::tuple<Loops<Kinds>...>;
};
#define CONTACT_KIND(A, B) , Two<A, B>
using AllLoops = LoopsOfAll<void CONTACT_KINDS(CONTACT_KIND)>::Type;
#undef CONTACT_KIND

/// Pairs of a hull: a library keeps what it makes of such shapes.
struct LoopsOfHulls : Loops<Convexes> {
  bool has_planes = false;
};

struct Peer {
  std::string name;
  Conventions conventions;  ///< of its answers about two spheres
  bool slow = false;        ///< measured in the second level cache alone
  AllLoops loops;
  LoopsOfHulls hulls;

  template <class Kind>
  [[nodiscard]] const Loops<Kind>& of() const {
    return std::get<Loops<Kind>>(loops);
  }
};

template <class Kind, class One>
Loops<Kind> loops_of(std::shared_ptr<One> one) {
  Loops<Kind> loops;
  if constexpr (requires(const Kind& pair) { one->test(pair); })
    loops.test = [one](std::span<const Kind> pairs, std::uint8_t* hit) {
      for (const Kind& pair : pairs) *hit++ = one->test(pair) ? 1 : 0;
    };
  if constexpr (requires(const Kind& pair, Contact& contact) { one->compute(pair, contact); })
    loops.compute = [one](std::span<const Kind> pairs, PeerAnswer* out) {
      for (const Kind& pair : pairs) {
        out->hit = one->compute(pair, out->contact);
        ++out;
      }
    };
  return loops;
}

/// `one` has the members test(made) -> bool and compute(made, Contact&) -> bool for what One::Made is of a pair. It is made when the pairs are seen first, which
/// is not measured.
template <class One>
LoopsOfHulls loops_of_hulls(std::shared_ptr<One> one) {
  using Made = typename One::Made;
  const auto kept = std::make_shared<std::map<const Convexes*, std::deque<Made>>>();
  const auto made_of = [kept](std::span<const Convexes> pairs) -> std::deque<Made>& {
    std::deque<Made>& made = (*kept)[pairs.data()];
    if (made.empty())
      for (const Convexes& pair : pairs) made.emplace_back(pair);
    return made;
  };
  LoopsOfHulls loops;
  loops.has_planes = One::kHasPlanes;
  loops.test = [one, made_of](std::span<const Convexes> pairs, std::uint8_t* hit) {
    for (Made& made : made_of(pairs)) *hit++ = one->test(made) ? 1 : 0;
  };
  if constexpr (requires(Made & made, Contact & contact) { one->compute(made, contact); })
    loops.compute = [one, made_of](std::span<const Convexes> pairs, PeerAnswer* out) {
      for (Made& made : made_of(pairs)) {
        out->hit = one->compute(made, out->contact);
        ++out;
      }
    };
  return loops;
}

/// `one` has the members test(pair) -> bool and compute(pair, Contact&) -> bool for pairs of some kinds; it is made
/// once, and keeps what a user would keep between calls.
template <class One>
Peer make_peer(std::string name, const Conventions& conventions, bool slow, std::shared_ptr<One> one) {
  Peer peer{std::move(name), conventions, slow, {}, {}};
  std::apply([&]<class... Each>(Each&... each) { ((each = loops_of<typename Each::Kind>(one)), ...); }, peer.loops);
  if constexpr (requires { typename One::Made; }) peer.hulls = loops_of_hulls(one);
  return peer;
}

[[nodiscard]] std::vector<Peer> own_peers();  ///< plain double and production, one pair after the other
[[nodiscard]] std::vector<Peer> fcl_peers();
[[nodiscard]] std::vector<Peer> bullet_peers();
[[nodiscard]] std::vector<Peer> ode_peers();
[[nodiscard]] std::vector<Peer> ccd_peers();
[[nodiscard]] std::vector<Peer> cgal_peers();
[[nodiscard]] std::vector<Peer> gmp_peers();

}  // namespace contact::bench
