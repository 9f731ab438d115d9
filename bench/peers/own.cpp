// What the peers are held against: plain double as upstream has it, and production, one pair after the other.
#include <cmath>

#include "contact/cube_cube.hpp"
#include "contact/sphere_sphere.hpp"
#include "peers/peers.hpp"

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
  static bool test_boxes(const Boxes& p) {
    return p.a.min[0] <= p.b.max[0] && p.b.min[0] <= p.a.max[0] && p.a.min[1] <= p.b.max[1] &&
           p.b.min[1] <= p.a.max[1] && p.a.min[2] <= p.b.max[2] && p.b.min[2] <= p.a.max[2];
  }
};

struct Production {
  static bool test(const Balls& p) { return test_sphere_sphere(p.a, p.b, 0); }
  static bool compute(const Balls& p, Contact& out) {
    const std::optional<Contact> contact = compute_sphere_sphere(p.a, p.b, {.alarm = 0, .contact = 0});
    if (contact) out = *contact;
    return contact.has_value();
  }
  static bool test_boxes(const Boxes& p) { return test_cube_cube(p.a, p.b, 0); }
};

}  // namespace

std::vector<Peer> own_peers() {
  return {make_peer("plain double", {}, false, std::make_shared<Plain>()),
          make_peer("ours, scalar", {}, false, std::make_shared<Production>())};
}

}  // namespace contact::bench
