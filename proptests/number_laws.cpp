// The numbers of a contact of two spheres: finite, unit, in the right place, and changed by nothing but what changes
// them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "oracle/truth/exact_truth.hpp"
#include "proptests/law_functions.hpp"

namespace contact::proptests {
namespace {

using oracle::Grade;
using Vector = std::array<Rational, 3>;

Vector exact(const Vector3& v) { return {Rational(v[0]), Rational(v[1]), Rational(v[2])}; }
Rational dot(const Vector& x, const Vector& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
Vector minus(const Vector& x, const Vector& y) { return {x[0] - y[0], x[1] - y[1], x[2] - y[2]}; }
Vector delta(const Query& query) { return minus(exact(query.balls()->b.center), exact(query.balls()->a.center)); }

oracle::Verdict judged(const Case& c, std::size_t i) {
  return oracle::judge(c.queries[i], c.truth(i), c.claims[i], c.subject.info.declared);
}

/// Whether question i has a contact with a direction, and the engine gave one.
bool has_contact(const Case& c, std::size_t i) {
  return c.contact(i) != nullptr && c.truth(i).has_numbers() && !coincident(c, i);
}

const std::optional<Vector3>& point(const ContactClaim& claim, int sphere) {
  return sphere == 0 ? claim.point1 : claim.point2;
}
const Ball& ball(const Query& query, int sphere) { return sphere == 0 ? query.balls()->a : query.balls()->b; }
/// How far a point may be off, in each coordinate.
Rational point_error(const Case& c, int sphere) {
  return Rational(c.subject.bound(Field::point1)) *
         oracle::ulp(c.truth(0).distance()->point_scale(sphere), c.subject.info.declared.scalar);
}

bool finite(const std::optional<Vector3>& v) { return v && v->allFinite(); }

}  // namespace

Questions farther(const Trial& trial, const Subject& subject) {
  Query near = trial.query;
  // An alarm distance that both are within, so that both have a contact.
  const Vector3 apart = near.balls()->b.center - near.balls()->a.center;
  const double enough = subject.range.rounded(4 * apart.cwiseAbs().maxCoeff());
  if (!apart.allFinite()) return {};
  if (subject.range.contains(enough)) near.distances.alarm = std::max(near.distances.alarm, enough);
  Query far = near;
  auto& [a, b] = std::get<Balls>(far.shapes);
  const int axis = trial.change.choice % 3;
  const double step = std::max(std::abs(apart[axis]), 1.0) * (1 + trial.change.choice / 3 % 4) / 4;
  double& x = b.center[axis];
  x = subject.range.rounded(apart[axis] >= 0 ? x + step : x - step);
  if (x == near.balls()->b.center[axis]) return {};
  return {near, far};
}

Questions other_alarm(const Trial& trial, const Subject&) {
  Query other = trial.query;
  other.distances.alarm = trial.change.length;
  return {trial.query, other};
}

Questions other_contact(const Trial& trial, const Subject&) {
  Query other = trial.query;
  other.distances.contact = trial.change.length;
  return {trial.query, other};
}

Outcome check_coincident(const Case& c) {
  const auto verdict = judged(c, 0);
  const bool no_contact = c.subject.info.declared.conventions.coincident == Coincident::no_contact;
  if (no_contact && verdict.contact == oracle::Decision::false_hit)
    return Outcome::violated("a contact, where the engine declares none for coincident centres");
  if (c.contact(0) == nullptr) return Outcome::vacuous();
  const auto& normal = verdict.at(Field::normal);
  if (normal && normal->grade > Grade::bounded)
    return Outcome::violated(fmt::format(
        "the normal is {}, which is not {}", text(*c.contact(0)->normal),
        c.subject.info.declared.conventions.coincident == Coincident::zero_normal ? "zero" : "a unit vector"));
  const ContactClaim& claim = *c.contact(0);
  for (const auto& point : {claim.point1, claim.point2, claim.point})
    if (point && point->hasNaN()) return Outcome::violated("a point is " + text(*point));
  if (claim.value && std::isnan(*claim.value)) return Outcome::violated("the value is NaN");
  return {};
}

Outcome check_finite(const Case& c) {
  if (!has_contact(c, 0)) return Outcome::vacuous();
  const auto verdict = judged(c, 0);
  for (const Field field : oracle::kFields)
    if (const auto& f = verdict.at(field); f && f->grade == Grade::not_finite)
      return Outcome::violated(fmt::format("{} is not finite, and the truth is", name(field)));
  return {};
}

Outcome check_unit_normal(const Case& c) {
  if (!has_contact(c, 0) || !finite(c.contact(0)->normal)) return Outcome::vacuous();
  const Vector n = exact(*c.contact(0)->normal);
  const Rational error = Rational(c.subject.bound(Field::normal)) * unit_of(c, 0, Field::normal);
  if (CGAL::abs(dot(n, n) - Rational(1)) <= Rational(4) * error) return {};
  return Outcome::violated(fmt::format("the normal {} has length {}", text(*c.contact(0)->normal),
                                       text(c.contact(0)->normal->stableNorm())));
}

Outcome check_direction(const Case& c) {
  if (!has_contact(c, 0) || !finite(c.contact(0)->normal)) return Outcome::vacuous();
  const Vector3 n = first_to_second(c.subject.info.declared.conventions, *c.contact(0)->normal);
  if (CGAL::is_positive(dot(exact(n), delta(c.queries[0])))) return {};
  return Outcome::violated(
      fmt::format("the normal {} does not point from the {}", text(*c.contact(0)->normal),
                  n == *c.contact(0)->normal ? "first centre to the second" : "second centre to the first"));
}

Outcome check_own_surface(const Case& c) {
  if (!has_contact(c, 0)) return Outcome::vacuous();
  bool any = false;
  for (const int sphere : {0, 1}) {
    const auto on = point_of(c.subject.info.declared.conventions, c.queries[0], sphere);
    const auto& p = point(*c.contact(0), sphere);
    if (!on || !finite(p)) continue;
    any = true;
    const Ball& own = ball(c.queries[0], sphere);
    const Rational radius = *on == PointOn::center ? Rational(0) : Rational(own.radius);
    const Rational error = Rational(2) * point_error(c, sphere);
    const Vector arm = minus(exact(*p), exact(own.center));
    const Rational least = std::max(Rational(0), Rational(radius - error));
    const Rational most = radius + error;
    const Rational length2 = dot(arm, arm);
    if (length2 < least * least || length2 > most * most)
      return Outcome::violated(
          fmt::format("point{} {} is {} from its sphere's centre, whose {}", sphere + 1, text(*p),
                      text((*p - own.center).stableNorm()),
                      *on == PointOn::center ? std::string("centre it should be") : "radius is " + text(own.radius)));
  }
  return any ? Outcome{} : Outcome::vacuous();
}

Outcome check_near_side(const Case& c) {
  if (!has_contact(c, 0)) return Outcome::vacuous();
  bool any = false;
  for (const int sphere : {0, 1}) {
    const auto on = point_of(c.subject.info.declared.conventions, c.queries[0], sphere);
    const auto& p = point(*c.contact(0), sphere);
    const Ball& own = ball(c.queries[0], sphere);
    if (!on || *on == PointOn::center || !finite(p) || Rational(own.radius) <= Rational(4) * point_error(c, sphere))
      continue;
    any = true;
    Rational along = dot(minus(exact(*p), exact(own.center)), delta(c.queries[0]));
    if ((sphere == 1) != (*on == PointOn::far_surface)) along = -along;
    if (!CGAL::is_positive(along))
      return Outcome::violated(fmt::format("point{} {} lies on the side of its sphere that faces {}", sphere + 1,
                                           text(*p),
                                           *on == PointOn::far_surface ? "the other sphere" : "away from the other"));
  }
  return any ? Outcome{} : Outcome::vacuous();
}

Outcome check_span(const Case& c) {
  if (!has_contact(c, 0)) return Outcome::vacuous();
  const Conventions& declared = c.subject.info.declared.conventions;
  const ContactClaim& claim = *c.contact(0);
  const auto on1 = point_of(declared, c.queries[0], 0);
  const auto on2 = point_of(declared, c.queries[0], 1);
  if (!on1 || !on2 || !finite(claim.point1) || !finite(claim.point2) || !finite(claim.normal) || !claim.value ||
      !std::isfinite(*claim.value) || declared.value == ValueKind::none)
    return Outcome::vacuous();
  // sqrt(D) - (r1 + r2) as the value has it; a point that is not on the near side is one or two radii farther back.
  Rational length(*claim.value);
  if (declared.value == ValueKind::depth) length = -length;
  if (declared.value_less_contact) length += Rational(c.queries[0].distances.contact);
  const auto back = [](PointOn on, double radius) {
    return Rational(on == PointOn::nearest_surface ? 0 : on == PointOn::center ? 1 : 2) * Rational(radius);
  };
  length += back(*on1, c.queries[0].balls()->a.radius) + back(*on2, c.queries[0].balls()->b.radius);
  const Vector n = exact(first_to_second(declared, *claim.normal));
  const Vector span = minus(exact(*claim.point2), exact(*claim.point1));
  const Rational error =
      Rational(2) *
      (point_error(c, 0) + point_error(c, 1) + Rational(c.subject.bound(Field::value)) * unit_of(c, 0, Field::value) +
       Rational(c.subject.bound(Field::normal)) * unit_of(c, 0, Field::normal) * CGAL::abs(length));
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (CGAL::abs(span[axis] - length * n[axis]) > error)
      return Outcome::violated(fmt::format("point2 - point1 is {}, and the value along the normal says {}",
                                           text(*claim.point2 - *claim.point1),
                                           text(Vector3(CGAL::to_double(length * n[0]), CGAL::to_double(length * n[1]),
                                                        CGAL::to_double(length * n[2])))));
  return {};
}

Outcome check_farther(const Case& c) {
  if (c.contact(0) == nullptr || c.contact(1) == nullptr) return Outcome::vacuous();
  const auto& near = c.contact(0)->value;
  const auto& far = c.contact(1)->value;
  if (!near || !far || std::isnan(*near) || std::isnan(*far)) return Outcome::vacuous();
  const bool depth = c.subject.info.declared.conventions.value == ValueKind::depth;
  const double low = depth ? -*near : *near;
  const double high = depth ? -*far : *far;
  if (low <= high) return {};
  if (!c.subject.correctly_rounded) {
    if (std::isinf(low) || std::isinf(high)) return Outcome::vacuous();
    const Rational error =
        Rational(c.subject.bound(Field::value)) * (unit_of(c, 0, Field::value) + unit_of(c, 1, Field::value));
    if (Rational(low) - Rational(high) <= error) return {};
  }
  return Outcome::violated(fmt::format("the value {} becomes {} by moving the centres apart", text(*near), text(*far)));
}

Outcome check_other_alarm(const Case& c) {
  if (c.contact(0) == nullptr || c.contact(1) == nullptr) return Outcome::vacuous();
  if (auto why = different_numbers(c, 0, 1, *c.contact(0),
                                   {Field::value, Field::normal, Field::point1, Field::point2, Field::point}))
    return Outcome::violated(*why);
  return {};
}

Outcome check_other_contact(const Case& c) {
  if (auto why = different_decisions(c, 0, 1)) return Outcome::violated(*why);
  if (c.contact(0) == nullptr || c.contact(1) == nullptr) return Outcome::vacuous();
  if (auto why = different_numbers(c, 0, 1, *c.contact(0), {Field::normal, Field::point1, Field::point2, Field::point}))
    return Outcome::violated(*why);
  const auto& before = c.contact(0)->value;
  const auto& after = c.contact(1)->value;
  const Conventions& declared = c.subject.info.declared.conventions;
  if (!c.subject.claims(Field::value) || !before || !after || !std::isfinite(*before) || !std::isfinite(*after))
    return {};
  Rational change = Rational(c.queries[1].distances.contact) - Rational(c.queries[0].distances.contact);
  if (!declared.value_less_contact) change = Rational(0);
  if (declared.value == ValueKind::signed_distance) change = -change;
  const Rational error =
      Rational(c.subject.bound(Field::value)) * (unit_of(c, 0, Field::value) + unit_of(c, 1, Field::value));
  if (CGAL::abs(Rational(*after) - Rational(*before) - change) > error)
    return Outcome::violated(fmt::format("the value goes from {} to {}, and should by {}", text(*before), text(*after),
                                         text(CGAL::to_double(change))));
  return {};
}

Outcome check_correctly_rounded(const Case& c) {
  const auto verdict = judged(c, 0);
  if (c.contact(0) == nullptr) return Outcome::vacuous();
  for (const Field field : oracle::kFields)
    if (const auto& f = verdict.at(field);
        f && f->grade > Grade::correctly_rounded && !(f->grade == Grade::not_finite && coincident(c, 0)))
      return Outcome::violated(f->grade == Grade::not_finite
                                   ? fmt::format("{} is not finite", name(field))
                                   : fmt::format("{} is {:.3g} ulps of its scale off", name(field), f->error));
  return {};
}

Outcome check_bounds(const Case& c) {
  const auto verdict = judged(c, 0);
  if (c.contact(0) == nullptr) return Outcome::vacuous();
  for (const Field field : oracle::kFields)
    if (const auto& f = verdict.at(field); f && f->grade == Grade::beyond_bound)
      return Outcome::violated(fmt::format("{} is {:.3g} ulps of its scale off, beyond the declared {:g}", name(field),
                                           f->error,
                                           field == Field::normal  ? c.subject.info.declared.bounds.normal
                                           : field == Field::value ? c.subject.info.declared.bounds.value
                                                                   : c.subject.info.declared.bounds.point));
  return {};
}

}  // namespace contact::proptests
