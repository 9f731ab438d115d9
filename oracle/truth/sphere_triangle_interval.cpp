// A sphere and a triangle in intervals, by active sets: the nearest point of the line or plane through some of the
// vertices is the triangle's where it is no farther than them along any edge (Karush, Kuhn and Tucker; the problem
// is convex).
//   w_k = v_k - c     p = sum of l_k w_k / over, l_k >= 0
//   nearest where p.(w_k - w_i) >= 0 for all k, i of those used
#include <cstddef>
#include <vector>

#include "oracle/truth/interval_segments.hpp"

namespace contact::oracle {
namespace {

Triple scaled(const Interval& k, const Triple& x) { return {k * x[0], k * x[1], k * x[2]}; }
Triple sum(const Triple& x, const Triple& y) { return {x[0] + y[0], x[1] + y[1], x[2] + y[2]}; }

/// A point of the plane of the triangle, from c: p / over, over > 0; and a vertex that it is made of.
struct Candidate {
  Triple p;
  Interval over;
  std::size_t of;
};

class SeenTriangle {
 public:
  SeenTriangle(const Vector3& c, const Triangle& triangle, mpfr_prec_t precision)
      : precision_(precision), c_(triple(precision, c)) {
    for (const Vector3& v : triangle.vertices) w_.push_back(difference(triple(precision, v), c_));
  }

  [[nodiscard]] IntervalNearest nearest() const {
    for (const Candidate& x : candidates())
      if (is_nearest(x)) {
        const Triple u = edge(0, 1);
        const Triple v = edge(0, 2);
        const Triple p = scaled(x.over, c_);
        return {p, sum(p, x.p), x.over, agreed_normal(cross(u, v), sign_of(dot(u, u)) == 0 ? v : u, precision_), true};
      }
    throw Undecided{};  // none of them is it: never with signs that are settled
  }

 private:
  [[nodiscard]] Triple edge(std::size_t from, std::size_t to) const { return difference(w_[to], w_[from]); }
  [[nodiscard]] Interval number(double x) const { return {precision_, x}; }

  [[nodiscard]] std::vector<Candidate> candidates() const {
    std::vector<Candidate> all;
    for (std::size_t k = 0; k < 3; ++k) all.push_back({w_[k], number(1), k});
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      const Triple u = edge(k, next);
      const Interval over = dot(u, u);
      if (sign_of(over) == 0) continue;
      const Interval towards_next = number(0) - dot(w_[k], u);
      const Interval towards_k = dot(w_[next], u);
      if (sign_of(towards_next) >= 0 && sign_of(towards_k) >= 0)
        all.push_back({sum(scaled(towards_k, w_[k]), scaled(towards_next, w_[next])), over, k});
    }
    const Triple n = cross(edge(0, 1), edge(0, 2));
    const Interval over = dot(n, n);
    if (sign_of(over) == 0) return all;
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) inside = inside && sign_of(dot(n, cross(w_[k], w_[(k + 1) % 3]))) >= 0;
    if (inside) all.push_back({scaled(dot(n, w_[0]), n), over, 0});
    return all;
  }

  [[nodiscard]] bool is_nearest(const Candidate& x) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (sign_of(dot(x.p, w_[k]) - dot(x.p, w_[x.of])) < 0) return false;
    return true;
  }

  mpfr_prec_t precision_;
  Triple c_;
  std::vector<Triple> w_;
};

}  // namespace

RoundedAnswer interval_answer(const BallAndTriangle& shapes, Distances distances, Scalar scalar,
                              mpfr_prec_t precision) {
  const auto& [ball, triangle] = shapes;
  return answer_of_nearest(SeenTriangle(ball.center, triangle, precision).nearest(), Interval(precision, ball.radius),
                           Interval(precision, 0), distances, scalar, precision);
}

}  // namespace contact::oracle
