// The peers: other libraries' answers about two spheres or two boxes, called as their users call them.
#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "contact/contact.hpp"
#include "contact/geometry.hpp"
#include "oracle/judge/conventions.hpp"
#include "oracle/truth/query.hpp"

namespace contact::bench {

/// What a peer writes for a pair; a number that it does not give is left alone. `contact.point1` alone where the
/// convention is one point.
struct PeerAnswer {
  Contact contact;
  bool hit;
};

/// A library, with loops over many pairs in which its call is inlined. What it does not do is empty.
struct Peer {
  std::string name;
  Conventions conventions;
  bool slow = false;  ///< measured in the second level cache alone
  std::function<void(std::span<const Balls>, std::uint8_t*)> test;
  std::function<void(std::span<const Balls>, PeerAnswer*)> compute;
  std::function<void(std::span<const Boxes>, std::uint8_t*)> test_boxes;
};

/// `one` has the members test(balls) -> bool, compute(balls, Contact&) -> bool, test_boxes(boxes) -> bool, or some of
/// them; it is made once, and keeps what a user would keep between calls.
template <class One>
Peer make_peer(std::string name, const Conventions& conventions, bool slow, std::shared_ptr<One> one) {
  Peer peer{std::move(name), conventions, slow, {}, {}, {}};
  if constexpr (requires(const Balls& balls) { one->test(balls); })
    peer.test = [one](std::span<const Balls> pairs, std::uint8_t* hit) {
      for (const Balls& pair : pairs) *hit++ = one->test(pair) ? 1 : 0;
    };
  if constexpr (requires(const Balls& balls, Contact& contact) { one->compute(balls, contact); })
    peer.compute = [one](std::span<const Balls> pairs, PeerAnswer* out) {
      for (const Balls& pair : pairs) {
        out->hit = one->compute(pair, out->contact);
        ++out;
      }
    };
  if constexpr (requires(const Boxes& boxes) { one->test_boxes(boxes); })
    peer.test_boxes = [one](std::span<const Boxes> pairs, std::uint8_t* hit) {
      for (const Boxes& pair : pairs) *hit++ = one->test_boxes(pair) ? 1 : 0;
    };
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
