// What the peers are held against: plain double as upstream has it, and production, one pair after the other.
#include <cmath>

#include "contact/pair_functions.hpp"
#include "peers/peers.hpp"
#include "plain_batch.hpp"

namespace contact::bench {
namespace {

struct Plain {
  static double distance2(const Balls& p, Vector3& delta) {
    delta = p.b.center - p.a.center;
    return delta[0] * delta[0] + delta[1] * delta[1] + delta[2] * delta[2];
  }
  static bool test(const Balls& p) {
    Vector3 delta;
    const double reach = p.a.radius + p.b.radius;
    return distance2(p, delta) <= reach * reach;
  }
  static bool compute(const Balls& p, Contact& out) {
    Vector3 delta;
    const double d2 = distance2(p, delta);
    const double reach = p.a.radius + p.b.radius;
    if (!(d2 <= reach * reach)) return false;
    const double s = std::sqrt(d2);
    const Vector3 n(delta[0] / s, delta[1] / s, delta[2] / s);
    out = {n, p.a.center + p.a.radius * n, p.b.center - p.b.radius * n, s - reach, false};
    return true;
  }
  static bool test(const Boxes& p) {
    return p.a.min[0] <= p.b.max[0] && p.b.min[0] <= p.a.max[0] && p.a.min[1] <= p.b.max[1] &&
           p.b.min[1] <= p.a.max[1] && p.a.min[2] <= p.b.max[2] && p.b.min[2] <= p.a.max[2];
  }
  static Balls at_nearest(const BallAndBox& p) { return {p.a, {p.a.center.cwiseMax(p.b.min).cwiseMin(p.b.max), 0}}; }
  static bool test(const BallAndBox& p) { return test(at_nearest(p)); }
  static bool compute(const BallAndBox& p, Contact& out) {
    const Balls balls = at_nearest(p);
    if (balls.a.center != balls.b.center) return compute(balls, out);
    plain_contact_inside(p.a, p.b, 0, out);
    return true;
  }
};

struct Production {
  template <class A, class B>
  static bool test(const Two<A, B>& p) {
    return is_hit(p, {.alarm = 0, .contact = 0});
  }
  template <class Shape>
  static bool compute(const Two<Ball, Shape>& p, Contact& out) {
    const std::optional<Contact> contact = contact_of(p, {.alarm = 0, .contact = 0});
    if (contact) out = *contact;
    return contact.has_value();
  }
};

}  // namespace

std::vector<Peer> own_peers() {
  return {make_peer("plain double", {}, false, std::make_shared<Plain>()),
          make_peer("ours, scalar", {}, false, std::make_shared<Production>())};
}

}  // namespace contact::bench
