// How far a claim is off in the question's own units, and whether a tolerance allows it, exactly.
#include "oracle/judge/off.hpp"

#include <mpfr.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "oracle/truth/casts.hpp"
#include "oracle/truth/crossings.hpp"
#include "oracle/truth/default_environment.hpp"

namespace contact::oracle {
namespace {

constexpr int kFirstBits = 64;
constexpr int kLastBits = 4000;  // what is closer is equal
constexpr double kUnlimited = std::numeric_limits<double>::infinity();

class Mpfr {
 public:
  explicit Mpfr(int bits) { mpfr_init2(x_, bits); }
  Mpfr(const Mpfr&) = delete;
  Mpfr& operator=(const Mpfr&) = delete;
  ~Mpfr() { mpfr_clear(x_); }
  operator mpfr_ptr() { return x_; }  // NOLINT(google-explicit-constructor): it is one

 private:
  mpfr_t x_;
};

/// The angle from 0 to pi whose squared tangent is over2 / along2, above a right angle where `obtuse`.
class Angle {
 public:
  /// Domain: neither is 0.
  [[nodiscard]] static Angle between(const Point& a, const Point& b) {
    const Point across = cross(a, b);
    const Rational along = dot(a, b);
    return {dot(across, across), along * along, along < Rational(0)};
  }
  /// How far past a right angle they are, or 0.
  [[nodiscard]] static Angle past_right(const Point& a, const Point& b) {
    const Point across = cross(a, b);
    const Rational along = dot(a, b);
    if (along >= Rational(0)) return {Rational(0), Rational(1), false};
    return {along * along, dot(across, across), false};
  }

  /// Rounded up.
  [[nodiscard]] double upper() const {
    Mpfr x(kFirstBits);
    round(x, kFirstBits, MPFR_RNDU);
    return mpfr_get_d(x, MPFR_RNDU);
  }
  /// The tangent of an angle that is a double other than 0 is no root of a rational, so that some precision tells.
  [[nodiscard]] bool at_most(double angle) const {
    if (is_zero()) return angle >= 0;
    for (int bits = kFirstBits;; bits *= 2) {
      Mpfr x(bits);
      round(x, bits, MPFR_RNDU);
      if (mpfr_cmp_d(x, angle) <= 0) return true;
      round(x, bits, MPFR_RNDD);
      if (mpfr_cmp_d(x, angle) > 0) return false;
    }
  }

 private:
  Angle(Rational over2, Rational along2, bool obtuse)
      : over2_(std::move(over2)), along2_(std::move(along2)), obtuse_(obtuse) {}

  [[nodiscard]] bool is_zero() const { return CGAL::is_zero(over2_) && !obtuse_; }
  /// The angle rounded in a direction: each step is monotonous.
  void round(mpfr_ptr x, int bits, mpfr_rnd_t direction) const {
    const mpfr_rnd_t other = direction == MPFR_RNDU ? MPFR_RNDD : MPFR_RNDU;
    const mpfr_rnd_t acute = obtuse_ ? other : direction;
    if (CGAL::is_zero(along2_)) {
      mpfr_const_pi(x, direction);
      mpfr_div_2ui(x, x, 1, direction);
      return;
    }
    const Rational tangent2 = over2_ / along2_;
    mpfr_set_q(x, tangent2.mpq(), acute);
    mpfr_sqrt(x, x, acute);
    mpfr_atan(x, x, acute);
    if (!obtuse_) return;
    Mpfr pi(bits);
    mpfr_const_pi(pi, direction);
    mpfr_sub(x, pi, x, direction);
  }

  Rational over2_;
  Rational along2_;
  bool obtuse_;
};

/// error <= length + relative * scale + room, the error in an enclosure of so many bits. The two may have different
/// square roots, so both are enclosed.
template <class Enclosure>
bool allows(const Tolerance& tolerance, const Enclosure& error, const Exact& scale, const Rational& room) {
  const Rational fixed = Rational(tolerance.length) + room;
  const Rational relative(tolerance.relative);
  for (int bits = kFirstBits;; bits *= 2) {
    const Exact::Enclosure e = error(bits);
    const Exact::Enclosure s = scale.enclosure(bits);
    if (e.high <= fixed + relative * s.low || bits > kLastBits) return true;
    if (e.low > fixed + relative * s.high) return false;
  }
}

/// What is so much in all, rounded up, and the share of a scale.
Off of_most(const Exact& most, const Exact& scale, bool within) {
  const Rational least = scale.enclosure(kFirstBits).low;
  return {error_in_units(Rational(0), most, Rational(1)),
          CGAL::sign(least) == CGAL::POSITIVE ? error_in_units(Rational(0), most, least) : kUnlimited, within};
}

Off off_by(const Angle& angle, const std::optional<Tolerance>& tolerance) {
  return {angle.upper(), 0, !tolerance || angle.at_most(tolerance->angle)};
}

/// The distance at which a decision changes.
const Rational& limit_of(const Query& query, const DistanceTruth& distance, bool by_alarm) {
  return by_alarm && query.distances.alarm != 0 ? distance.reach() : distance.radii();
}

}  // namespace

Off length_off(const Exact& error, const Exact& scale, const std::optional<Tolerance>& tolerance,
               const Rational& room) {
  const DefaultEnvironment environment;
  const Exact off = magnitude(error);
  if (off.compare(room) != CGAL::LARGER) return {};
  const auto enclosure = [&](int bits) { return off.enclosure(bits); };
  return of_most(off.plus(-room), scale, !tolerance || allows(*tolerance, enclosure, scale, room));
}

Off length_off_sum(const Exact& x, const Exact& y, const Exact& scale, const std::optional<Tolerance>& tolerance) {
  const DefaultEnvironment environment;
  const auto enclosure = [&](int bits) {
    const auto p = x.enclosure(bits);
    const auto q = y.enclosure(bits);
    return Exact::Enclosure{p.low + q.low, p.high + q.high};
  };
  const Rational most = std::max(enclosure(kFirstBits).high, Rational(0));
  return of_most(most, scale, !tolerance || allows(*tolerance, enclosure, scale, Rational(0)));
}

Off beyond_lengths(const std::optional<Tolerance>& tolerance) { return {kUnlimited, kUnlimited, !tolerance}; }

Off unit_off(const Point& v, const std::optional<Tolerance>& tolerance) {
  const DefaultEnvironment environment;
  const Exact error = magnitude(Exact(Rational(-1), Rational(1), dot(v, v)));
  return {error_in_units(Rational(0), error, Rational(1)), 0,
          !tolerance || error.compare(Rational(tolerance->angle)) != CGAL::LARGER};
}

Off no_direction(const std::optional<Tolerance>& tolerance) {
  return {std::nextafter(std::numbers::pi, 4.0), 0, !tolerance || tolerance->angle > std::numbers::pi};
}

Off angle_off(const Point& claimed, const Point& right, bool unit, const std::optional<Tolerance>& tolerance) {
  const DefaultEnvironment environment;
  if (is_zero(claimed)) return no_direction(tolerance);
  Off off = off_by(Angle::between(claimed, right), tolerance);
  if (unit) off.merge(unit_off(claimed, tolerance));
  return off;
}

Off angle_off(const Point& claimed, const std::vector<Point>& apart, bool unit,
              const std::optional<Tolerance>& tolerance) {
  const DefaultEnvironment environment;
  if (is_zero(claimed)) return no_direction(tolerance);
  Off off;
  for (const Point& w : apart)
    if (!is_zero(w)) off.merge(off_by(Angle::past_right(claimed, w), tolerance));
  if (unit) off.merge(unit_off(claimed, tolerance));
  return off;
}

Off meeting_off(const Query& query, const DistanceTruth& distance, bool by_alarm,
                const std::optional<Tolerance>& tolerance) {
  const DefaultEnvironment environment;
  if (has_plane(query.pair) || (distance.meets() && !distance.coincident())) return beyond_lengths(tolerance);
  return length_off({Rational(0), Rational(1), distance.distance2()}, limit_of(query, distance, by_alarm), tolerance);
}

Off decision_off(const Query& query, const Truth& truth, bool by_alarm, const std::optional<Tolerance>& tolerance) {
  const DefaultEnvironment environment;
  const bool at_alarm = by_alarm && query.distances.alarm != 0;
  if (const DistanceTruth* distance = truth.distance()) {
    const Rational& limit = limit_of(query, *distance, by_alarm);
    return length_off(distance->beyond(limit), limit, tolerance);
  }
  if (const GapTruth* gaps = truth.gaps()) {
    const Rational limit = at_alarm ? gaps->alarm() : Rational(0);
    return length_off(gaps->widest_gap() - limit, limit, tolerance);
  }
  if (truth.cast() != nullptr) {
    Off off;
    if_cast(query.shapes, [&](const auto& shapes) {
      off = length_off(distance_to_change(shapes, truth.hit()), Rational(0), tolerance);
    });
    return off;
  }
  const auto [segment, triangle] = crossed(query);
  return length_off(Exact(Rational(0), Rational(1), distance2_to_change(segment, triangle)), Rational(0), tolerance);
}

}  // namespace contact::oracle
