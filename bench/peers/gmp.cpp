// GMP: exact decisions with rational numbers; roots, which rationals lack, with floating point of 256 bits.
#include <gmpxx.h>

#include <array>

#include "peers/peers.hpp"

namespace contact::bench {
namespace {

constexpr mp_bitcnt_t kBits = 256;

struct Gmp {
  static bool decide(const Balls& p, std::array<mpq_class, 3>& delta, mpq_class& d2, mpq_class& reach) {
    for (int k = 0; k < 3; ++k) {
      mpq_class& d = delta[static_cast<std::size_t>(k)];
      d = mpq_class(p.b.center[k]) - mpq_class(p.a.center[k]);
      d2 += d * d;
    }
    reach = mpq_class(p.a.radius) + mpq_class(p.b.radius);
    return d2 <= reach * reach;
  }
  static bool test(const Balls& p) {
    std::array<mpq_class, 3> delta;
    mpq_class d2;
    mpq_class reach;
    return decide(p, delta, d2, reach);
  }
  static bool compute(const Balls& p, Contact& out) {
    std::array<mpq_class, 3> delta;
    mpq_class d2;
    mpq_class reach;
    if (!decide(p, delta, d2, reach)) return false;
    const mpf_class s = sqrt(mpf_class(d2, kBits));
    out.degenerate = s == 0;
    for (int k = 0; k < 3; ++k) {
      const mpf_class d(delta[static_cast<std::size_t>(k)], kBits);
      const mpf_class n = s == 0 ? mpf_class(k == 0 ? 1 : 0, kBits) : mpf_class(d / s, kBits);
      out.normal[k] = n.get_d();
      out.point1[k] = mpf_class(p.a.center[k] + p.a.radius * n, kBits).get_d();
      out.point2[k] = mpf_class(p.b.center[k] - p.b.radius * n, kBits).get_d();
    }
    out.value = mpf_class(s - mpf_class(reach, kBits), kBits).get_d();
    return true;
  }
  static bool test(const Boxes& p) {
    for (int k = 0; k < 3; ++k)
      if (mpq_class(p.a.min[k]) > mpq_class(p.b.max[k]) || mpq_class(p.b.min[k]) > mpq_class(p.a.max[k])) return false;
    return true;
  }
};

}  // namespace

std::vector<Peer> gmp_peers() {
  return {make_peer("GMP rationals", {.margin = Margin::none}, true, std::make_shared<Gmp>())};
}

}  // namespace contact::bench
