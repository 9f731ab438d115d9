// Two segments in intervals, by active sets: each of s and t is held at 0, held at 1, or free, and where the gradient's
// signs say that no step helps, the pair is nearest (Karush, Kuhn and Tucker; the problem is convex).
//   |w + t v - s u|^2 / 2 has the gradient    A s - B t - C,  E t - B s + F
//   A = u.u     B = u.v     E = v.v     C = u.w     F = v.w
#include "oracle/truth/interval_segments.hpp"

#include <cstddef>
#include <vector>

namespace contact::oracle {
namespace {

/// s / over and t / over, over > 0: no quotient is formed, so that what is exact stays exact.
struct Parameters {
  Interval s;
  Interval t;
  Interval over;
};

class Segments {
 public:
  Segments(const IntervalSegment& first, const IntervalSegment& second, mpfr_prec_t precision)
      : precision_(precision),
        a_(first.from),
        b_(second.from),
        u_(first.along),
        v_(second.along),
        w_(difference(b_, a_)),
        A_(dot(u_, u_)),
        B_(dot(u_, v_)),
        E_(dot(v_, v_)),
        C_(dot(u_, w_)),
        F_(dot(v_, w_)) {}

  /// The nearest pair; of many the middle.
  [[nodiscard]] IntervalNearest nearest() const {
    const std::vector<Parameters> ends = extremes();
    const Parameters& low = ends.front();
    const Parameters& high = ends.back();
    const bool unique = ends.size() == 1;
    const Parameters at = unique ? low
                                 : Parameters{low.s * high.over + high.s * low.over,
                                              low.t * high.over + high.t * low.over, number(2) * low.over * high.over};
    return {along(a_, at.s, u_, at.over), along(b_, at.t, v_, at.over), at.over, agreed(), unique};
  }

 private:
  static Triple along(const Triple& from, const Interval& t, const Triple& u, const Interval& over) {
    return {from[0] * over + t * u[0], from[1] * over + t * u[1], from[2] * over + t * u[2]};
  }
  [[nodiscard]] Interval number(double x) const { return {precision_, x}; }

  enum class Held { at_0, at_1, free };
  static constexpr std::array kHeld{Held::at_0, Held::at_1, Held::free};

  /// Whether a parameter lies in 0 .. 1, and whether the gradient pushes it against the end that holds it.
  static bool is_optimal(Held held, const Interval& parameter, const Interval& over, const Interval& gradient) {
    if (held == Held::free) return sign_of(parameter) >= 0 && sign_of(over - parameter) >= 0;
    return held == Held::at_0 ? sign_of(gradient) >= 0 : sign_of(gradient) <= 0;
  }

  [[nodiscard]] std::optional<Parameters> solved(Held s, Held t) const {
    const auto at = [&](Held held) { return number(held == Held::at_1 ? 1 : 0); };
    if (s != Held::free && t != Held::free) return Parameters{at(s), at(t), number(1)};
    if (s != Held::free) {
      if (sign_of(E_) == 0) return std::nullopt;
      return Parameters{at(s) * E_, B_ * at(s) - F_, E_};
    }
    if (t != Held::free) {
      if (sign_of(A_) == 0) return std::nullopt;
      return Parameters{B_ * at(t) + C_, at(t) * A_, A_};
    }
    const Interval determinant = A_ * E_ - B_ * B_;
    if (sign_of(determinant) == 0) return std::nullopt;
    return Parameters{C_ * E_ - B_ * F_, B_ * C_ - A_ * F_, determinant};
  }

  /// The nearest pair, or where many are nearest the two at the ends, by the first point.
  [[nodiscard]] std::vector<Parameters> extremes() const {
    std::vector<Parameters> found;
    for (const Held s : kHeld)
      for (const Held t : kHeld) {
        const auto at = solved(s, t);
        if (!at) continue;
        const Interval by_s = A_ * at->s - B_ * at->t - C_ * at->over;
        const Interval by_t = E_ * at->t - B_ * at->s + F_ * at->over;
        if (is_optimal(s, at->s, at->over, by_s) && is_optimal(t, at->t, at->over, by_t)) found.push_back(*at);
      }
    std::vector<Parameters> ends{found.front()};
    if (sign_of(A_) == 0) return ends;
    const auto order = [](const Parameters& x, const Parameters& y) { return sign_of(x.s * y.over - y.s * x.over); };
    std::size_t low = 0;
    std::size_t high = 0;
    for (std::size_t i = 1; i < found.size(); ++i) {
      if (order(found[i], found[low]) < 0) low = i;
      if (order(found[i], found[high]) > 0) high = i;
    }
    if (order(found[low], found[high]) == 0) return ends;
    return {found[low], found[high]};
  }

  [[nodiscard]] Triple agreed() const { return agreed_normal(cross(u_, v_), sign_of(A_) == 0 ? v_ : u_, precision_); }

  mpfr_prec_t precision_;
  Triple a_, b_, u_, v_, w_;
  Interval A_, B_, E_, C_, F_;
};

}  // namespace

IntervalSegment point_segment(const Vector3& c, mpfr_prec_t precision) {
  return {triple(precision, c), triple(precision, Vector3::Zero())};
}

IntervalSegment segment_along(const Ray& ray, mpfr_prec_t precision) {
  const Interval length(precision, ray.length);
  const Triple direction = triple(precision, ray.direction);
  return {triple(precision, ray.origin), {length * direction[0], length * direction[1], length * direction[2]}};
}
IntervalSegment segment_between(const Vector3& start, const Vector3& end, mpfr_prec_t precision) {
  const Triple from = triple(precision, start);
  return {from, difference(triple(precision, end), from)};
}

Triple agreed_normal(const Triple& across, const Triple& along, mpfr_prec_t precision) {
  const auto number = [&](double x) { return Interval(precision, x); };
  for (const Interval& x : across)
    if (const int s = sign_of(x); s != 0) return {across[0] * number(s), across[1] * number(s), across[2] * number(s)};
  const Interval length2 = dot(along, along);
  if (sign_of(length2) == 0) return {number(1), number(0), number(0)};
  if (sign_of(along[1]) == 0 && sign_of(along[2]) == 0) return {number(0), number(1), number(0)};
  return {length2 - along[0].squared(), number(0) - along[0] * along[1], number(0) - along[0] * along[2]};
}

RoundedAnswer answer_of_segments(const IntervalSegment& first, const IntervalSegment& second, double radius1,
                                 double radius2, Distances distances, Scalar scalar, mpfr_prec_t precision) {
  const Segments segments(first, second, precision);
  return answer_of_nearest(segments.nearest(), Interval(precision, radius1), Interval(precision, radius2), distances,
                           scalar, precision);
}

}  // namespace contact::oracle
