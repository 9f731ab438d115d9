// The numbers of a contact: finite, unit, in the right place, and changed by nothing but what changes
// them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "oracle/truth/clamped.hpp"
#include "oracle/truth/cores.hpp"
#include "oracle/truth/exact_truth.hpp"
#include "proptests/law_functions.hpp"

namespace contact::proptests {
namespace {

using oracle::Grade;
using Vector = std::array<Rational, 3>;

Vector exact(const Vector3& v) { return {Rational(v[0]), Rational(v[1]), Rational(v[2])}; }
Rational dot(const Vector& x, const Vector& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
Vector minus(const Vector& x, const Vector& y) { return {x[0] - y[0], x[1] - y[1], x[2] - y[2]}; }
/// The nearest points of the cores of question i, and its radii.
const oracle::Cores& cores(const Case& c, std::size_t i) { return c.truth(i).distance()->cores(); }
/// From the first shape to the second: into a half-space, also from below its plane.
Vector delta(const Case& c) {
  if (const auto& plane = cores(c, 0).half_space) return plane->inward;
  return minus(cores(c, 0).nearest[1], cores(c, 0).nearest[0]);
}
Vector3 rounded(const Vector& v) { return {CGAL::to_double(v[0]), CGAL::to_double(v[1]), CGAL::to_double(v[2])}; }

oracle::Verdict judged(const Case& c, std::size_t i) {
  return oracle::judge(c.queries[i], c.truth(i), c.claims[i], c.subject.info.declared);
}

/// Whether question i has a contact with a direction, and the engine gave one.
bool has_contact(const Case& c, std::size_t i) {
  return c.contact(i) != nullptr && c.truth(i).contact() != nullptr && !c.truth(i).coincident();
}
/// And no core is inside the other.
bool has_distance(const Case& c, std::size_t i) {
  return has_contact(c, i) && c.truth(i).has_distance() && !c.truth(i).distance()->meets();
}

/// Whether a number is not as right as the engine must be.
bool is_beyond(const Case& c, const oracle::FieldVerdict& verdict) {
  return c.subject.tolerance() ? !verdict.off.within || verdict.grade == Grade::not_finite
                               : verdict.grade > Grade::bounded;
}

const std::optional<Vector3>& point(const ContactClaim& claim, int shape) {
  return shape == 0 ? claim.point1 : claim.point2;
}
/// How far a point may be off, in each coordinate.
Rational point_error(const Case& c, int sphere) { return point_allowance(c, 0, sphere); }

bool finite(const std::optional<Vector3>& v) { return v && v->allFinite(); }

}  // namespace

Questions farther(const Trial& trial, const Subject& subject) {
  Query near = trial.query;
  const auto* ball_and_box = std::get_if<BallAndBox>(&near.shapes);
  const Balls spheres = ball_and_box != nullptr ? at_clamped(*ball_and_box) : *near.balls();
  // An alarm distance that both are within, so that both have a contact.
  const Vector3 apart = spheres.b.center - spheres.a.center;
  const double enough = subject.range.rounded(4 * apart.cwiseAbs().maxCoeff());
  // Out of a box there is more than one way.
  if (!apart.allFinite() || (ball_and_box != nullptr && apart.isZero(0))) return {};
  if (subject.range.contains(enough)) near.distances.alarm = std::max(near.distances.alarm, enough);
  Query far = near;
  const int axis = trial.change.choice % 3;
  const double step = std::max(std::abs(apart[axis]), 1.0) * (1 + trial.change.choice / 3 % 4) / 4;
  double& x =
      (ball_and_box != nullptr ? std::get<BallAndBox>(far.shapes).a : std::get<Balls>(far.shapes).a).center[axis];
  const double before = x;
  x = subject.range.rounded(apart[axis] >= 0 ? x - step : x + step);
  if (x == before) return {};
  return {near, far};
}

Questions radius_grown(const Trial& trial, const Subject& subject) {
  Query grown = trial.query;
  const std::vector<double*> radii = radii_of(grown);
  if (radii.empty()) return {};
  double& radius = *radii[static_cast<std::size_t>(trial.change.choice) % radii.size()];
  radius = std::max(subject.range.moved(radius, 1), trial.change.length);
  return {trial.query, grown};
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
  if (c.contact(0) == nullptr) return no_contact ? Outcome{} : Outcome::vacuous();
  const auto& normal = verdict.at(Field::normal);
  if (normal && is_beyond(c, *normal))
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
  const Rational error = allowance(c, 0, Field::normal);
  if (CGAL::abs(dot(n, n) - Rational(1)) <= (c.subject.tolerance() ? error : Rational(Rational(4) * error))) return {};
  return Outcome::violated(fmt::format("the normal {} has length {}", text(*c.contact(0)->normal),
                                       text(c.contact(0)->normal->stableNorm())));
}

Outcome check_direction(const Case& c) {
  if (!has_distance(c, 0) || !finite(c.contact(0)->normal)) return Outcome::vacuous();
  const Vector3 n = first_to_second(c.subject.info.declared.conventions, *c.contact(0)->normal);
  if (CGAL::is_positive(dot(exact(n), delta(c)))) return {};
  return Outcome::violated(
      fmt::format("the normal {} does not point from the {}", text(*c.contact(0)->normal),
                  n == *c.contact(0)->normal ? "first shape to the second" : "second shape to the first"));
}

Outcome check_own_surface(const Case& c) {
  // Where many points are nearest, nobody knows which of them an engine's point belongs to.
  if (!has_distance(c, 0) || !cores(c, 0).spread.empty()) return Outcome::vacuous();
  bool any = false;
  for (const int sphere : {0, 1}) {
    const auto on = point_of(c.subject.info.declared.conventions, c.queries[0], sphere);
    const auto& p = point(*c.contact(0), sphere);
    if (!on || !finite(p)) continue;
    any = true;
    const auto shape = static_cast<std::size_t>(sphere);
    const Vector& own = cores(c, 0).nearest[shape];
    const Rational radius = *on == PointOn::center ? Rational(0) : cores(c, 0).radius[shape];
    const Rational error = Rational(2) * point_error(c, sphere);
    const Vector arm = minus(exact(*p), own);
    const Rational least = std::max(Rational(0), Rational(radius - error));
    const Rational most = radius + error;
    const Rational length2 = dot(arm, arm);
    if (length2 < least * least || length2 > most * most)
      return Outcome::violated(fmt::format("point{} {} lies {} from the nearest point {} of its core, and not {}",
                                           sphere + 1, text(*p), text((*p - rounded(own)).stableNorm()),
                                           text(rounded(own)), text(CGAL::to_double(radius))));
  }
  return any ? Outcome{} : Outcome::vacuous();
}

Outcome check_near_side(const Case& c) {
  if (!has_distance(c, 0)) return Outcome::vacuous();
  bool any = false;
  for (const int sphere : {0, 1}) {
    const auto on = point_of(c.subject.info.declared.conventions, c.queries[0], sphere);
    const auto& p = point(*c.contact(0), sphere);
    const auto shape = static_cast<std::size_t>(sphere);
    if (!on || *on == PointOn::center || !finite(p) ||
        cores(c, 0).radius[shape] <= Rational(4) * point_error(c, sphere))
      continue;
    any = true;
    Rational along = dot(minus(exact(*p), cores(c, 0).nearest[shape]), delta(c));
    if ((sphere == 1) != (*on == PointOn::far_surface)) along = -along;
    if (!CGAL::is_positive(along))
      return Outcome::violated(fmt::format("point{} {} lies on the side of its shape that faces {}", sphere + 1,
                                           text(*p),
                                           *on == PointOn::far_surface ? "the other shape" : "away from the other"));
  }
  return any ? Outcome{} : Outcome::vacuous();
}

Outcome check_span(const Case& c) {
  if (!has_contact(c, 0) || parts_anywhere(c, 0)) return Outcome::vacuous();
  const Conventions& declared = c.subject.info.declared.conventions;
  const ContactClaim& claim = *c.contact(0);
  const auto on1 = point_of(declared, c.queries[0], 0);
  const auto on2 = point_of(declared, c.queries[0], 1);
  if (!on1 || !on2 || !finite(claim.point1) || !finite(claim.point2) || !finite(claim.normal) || !claim.value ||
      !std::isfinite(*claim.value) || declared.value == ValueKind::none)
    return Outcome::vacuous();
  // sqrt(D) - (r1 + r2) as the value has it; a point that is not on the near side is one or two radii farther back.
  Rational length = signed_distance(c, 0, *claim.value);
  const auto back = [](PointOn on, const Rational& radius) {
    return Rational(on == PointOn::nearest_surface ? 0 : on == PointOn::center ? 1 : 2) * radius;
  };
  length += back(*on1, cores(c, 0).radius[0]) + back(*on2, cores(c, 0).radius[1]);
  const Vector n = exact(first_to_second(declared, *claim.normal));
  const Vector span = minus(exact(*claim.point2), exact(*claim.point1));
  const Rational error = Rational(2) * (point_error(c, 0) + point_error(c, 1) + value_error(c, 0) +
                                        allowance(c, 0, Field::normal) * CGAL::abs(length));
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (CGAL::abs(span[axis] - length * n[axis]) > error)
      return Outcome::violated(fmt::format("point2 - point1 is {}, and the value along the normal says {}",
                                           text(*claim.point2 - *claim.point1),
                                           text(Vector3(CGAL::to_double(length * n[0]), CGAL::to_double(length * n[1]),
                                                        CGAL::to_double(length * n[2])))));
  return {};
}

namespace {

/// Whether the value of `low` is at most that of `high`, to the bounds of both unless held to correct rounding.
Outcome in_order(const Case& c, std::size_t low, std::size_t high, std::string_view by) {
  if (c.contact(low) == nullptr || c.contact(high) == nullptr) return Outcome::vacuous();
  if (parts_anywhere(c, low) || parts_anywhere(c, high)) return Outcome::vacuous();
  const auto& first = c.contact(low)->value;
  const auto& second = c.contact(high)->value;
  if (!first || !second || std::isnan(*first) || std::isnan(*second)) return Outcome::vacuous();
  const bool depth = c.subject.info.declared.conventions.value == ValueKind::depth;
  const double less = depth ? -*first : *first;
  const double more = depth ? -*second : *second;
  if (less <= more) return {};
  if (!c.subject.correctly_rounded) {
    if (std::isinf(less) || std::isinf(more)) return Outcome::vacuous();
    if (Rational(less) - Rational(more) <= value_error(c, low) + value_error(c, high)) return {};
  }
  return Outcome::violated(fmt::format("the value {} becomes {} by {}", text(*(low == 0 ? first : second)),
                                       text(*(low == 0 ? second : first)), by));
}

}  // namespace

Outcome check_farther(const Case& c) { return in_order(c, 0, 1, "moving the shapes apart"); }

Outcome check_lower_value(const Case& c) { return in_order(c, 1, 0, "growing a shape"); }

Outcome check_halves(const Case& c) {
  const auto says = [](bool hit) { return hit ? "a hit" : "a miss"; };
  if (!undecided(c, 0) && !undecided(c, 1) && !undecided(c, 2) &&
      says_hit(c.claims[0]) != (says_hit(c.claims[1]) || says_hit(c.claims[2])))
    return Outcome::violated(
        fmt::format("{} in one piece, and {} in two", says(says_hit(c.claims[0])), says(!says_hit(c.claims[0]))));
  const oracle::DistanceTruth* whole = c.truth(0).contact();
  if (whole == nullptr || c.contact(0) == nullptr) return {};
  for (const std::size_t half : {1U, 2U}) {
    const oracle::DistanceTruth* truth = c.truth(half).contact();
    if (truth == nullptr || c.contact(half) == nullptr) continue;
    if (Outcome less = in_order(c, 0, half, "cutting a shape in two"); less.kind == Outcome::Kind::violated)
      return less;
    if (whole->overlaps() || coincident(c, 0) || coincident(c, half) ||
        whole->cores().nearest != truth->cores().nearest)
      continue;
    if (auto why = different_numbers(c, 0, half, *c.contact(0),
                                     {Field::normal, Field::value, Field::point1, Field::point2, Field::point}))
      return Outcome::violated(*why);
  }
  return {};
}

Outcome check_rotated(const Case& c) {
  if (auto why = different_decisions(c, 0, 1)) return Outcome::violated(*why);
  if (c.contact(0) == nullptr || c.contact(1) == nullptr || parts_anywhere(c, 0)) return {};
  const auto before = finite_value(c, 0);
  const auto after = finite_value(c, 1);
  const Rotation& rotation = rotation_of(c.trial.change);
  const Rational times(is_cast(c.queries[0].pair) ? 1 : rotation.size());
  if (before && after &&
      CGAL::abs(Rational(*after) - times * Rational(*before)) > value_error(c, 1) + times * value_error(c, 0))
    return Outcome::violated(fmt::format("the value {} becomes {}, and should be {}", text(*before), text(*after),
                                         text(CGAL::to_double(times * Rational(*before)))));
  if (coincident(c, 0)) return {};
  for (const auto& [member, field, times_as_long] : {std::tuple{&ContactClaim::normal, Field::normal, rotation.size()},
                                                     {&ContactClaim::point1, Field::point1, 1},
                                                     {&ContactClaim::point2, Field::point2, 1},
                                                     {&ContactClaim::point, Field::point, 1}}) {
    const auto& old = c.contact(0)->*member;
    const auto& now = c.contact(1)->*member;
    if (!c.subject.claims(field) || !finite(old) || !finite(now) || may_jump(c, 0, field)) continue;
    const Rational error =
        Rational(times_as_long) * allowance(c, 1, field) + Rational(rotation.widest()) * allowance(c, 0, field);
    const Vector wanted = rotated(c.trial.change, *old);
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (CGAL::abs(Rational(times_as_long) * exact(*now)[axis] - wanted[axis]) > error)
        return Outcome::violated(
            fmt::format("{} {} becomes {}, and is not turned with its shapes", name(field), text(*old), text(*now)));
  }
  return {};
}

Outcome check_way_out(const Case& c) {
  const auto value = finite_value(c, 0);
  if (!value) return Outcome::vacuous();
  const auto& [ball, box] = std::get<BallAndBox>(c.queries[0].shapes);
  Rational depth = Rational(ball.center[0]) - Rational(box.min[0]);
  for (int axis = 0; axis < 3; ++axis)
    depth = std::min({depth, Rational(Rational(ball.center[axis]) - Rational(box.min[axis])),
                      Rational(Rational(box.max[axis]) - Rational(ball.center[axis]))});
  const Rational claimed = -signed_distance(c, 0, *value) - Rational(ball.radius);
  if (CGAL::abs(claimed - depth) <= value_error(c, 0)) return {};
  return Outcome::violated(fmt::format("the value {} says a depth of {}, and the nearest face is {} away", text(*value),
                                       text(CGAL::to_double(claimed)), text(CGAL::to_double(depth))));
}

Outcome check_parts(const Case& c) {
  const auto value = finite_value(c, 0);
  if (!value || !finite(c.contact(0)->normal) || !c.truth(0).distance()->overlaps()) return Outcome::vacuous();
  const oracle::DistanceTruth& truth = *c.truth(0).distance();
  const Vector n = exact(first_to_second(c.subject.info.declared.conventions, *c.contact(0)->normal));
  if (oracle::is_zero(n)) return Outcome::violated("the normal of an overlap is 0");
  const auto& shapes = std::get<Convexes>(c.queries[0].shapes);
  const auto farthest = [&](const Convex& shape, const Vector& along) {
    Rational most = dot(oracle::exact_core(shape).vertices[0], along);
    for (const Vector& x : oracle::exact_core(shape).vertices) most = std::max(most, dot(x, along));
    return most;
  };
  // The second core moved by so much along the normal does not overlap the first, and no less will do than the depth.
  const Rational out = -signed_distance(c, 0, *value) - truth.radii();
  const Rational along = farthest(shapes.a, n) + farthest(shapes.b, minus({Rational(0), Rational(0), Rational(0)}, n));
  const Rational length2 = dot(n, n);
  // A normal that is turned a little reaches farther, by so much of how far points of the two lie from each other.
  Rational across(0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Vector e{Rational(0), Rational(0), Rational(0)};
    e[axis] = Rational(1);
    const Vector back = minus({Rational(0), Rational(0), Rational(0)}, e);
    across += std::max(Rational(farthest(shapes.a, e) + farthest(shapes.b, back)),
                       Rational(farthest(shapes.a, back) + farthest(shapes.b, e)));
  }
  const Rational error = Rational(2) * value_error(c, 0) + Rational(2) * allowance(c, 0, Field::normal) * across;
  if (along <= Rational(0) || along * along <= (out + error) * (out + error) * length2) return {};
  return Outcome::violated(fmt::format("moved apart by the depth {} along the normal {}, the shapes overlap still",
                                       text(CGAL::to_double(out)), text(*c.contact(0)->normal)));
}

Outcome check_crossing(const Case& c) {
  if (c.contact(0) == nullptr || !c.truth(0).hit()) return Outcome::vacuous();
  const ContactClaim& claim = *c.contact(0);
  // Where the segment is, and where the triangle: the least and the largest of each coordinate.
  std::array<std::vector<Vector>, 2> corners;
  const auto add_triangle = [&](const Triangle& triangle) {
    for (const Vector3& v : triangle.vertices) corners[1].push_back(exact(v));
  };
  if (const auto* asked = std::get_if<RayAndTriangle>(&c.queries[0].shapes)) {
    Vector end = exact(asked->a.origin);
    for (std::size_t axis = 0; axis < 3; ++axis)
      end[axis] += Rational(asked->a.length) * Rational(asked->a.direction[static_cast<Eigen::Index>(axis)]);
    corners[0] = {exact(asked->a.origin), end};
    add_triangle(asked->b);
  } else {
    const auto& [triangle, line] = std::get<TriangleAndLine>(c.queries[0].shapes);
    corners[0] = {exact(line.start), exact(line.end)};
    add_triangle(triangle);
  }
  const Rational off = allowance(c, 0, Field::point1);
  for (const auto& point : {claim.point1, claim.point2}) {
    if (!finite(point)) continue;
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const std::vector<Vector>& of : corners) {
        const auto [least, largest] = std::minmax_element(
            of.begin(), of.end(), [&](const Vector& x, const Vector& y) { return x[axis] < y[axis]; });
        const Rational x((*point)[static_cast<Eigen::Index>(axis)]);
        if (x < (*least)[axis] - off || x > (*largest)[axis] + off)
          return Outcome::violated(fmt::format("the point {} lies beside the {}", text(*point),
                                               &of == corners.data() ? "segment" : "triangle"));
      }
  }
  if (finite(claim.point1) && finite(claim.point2))
    for (int axis = 0; axis < 3; ++axis)
      if (CGAL::abs(Rational((*claim.point1)[axis]) - Rational((*claim.point2)[axis])) > 2 * off)
        return Outcome::violated(fmt::format("the points are {} and {}, and the shapes meet in one",
                                             text(*claim.point1), text(*claim.point2)));
  const auto value = finite_value(c, 0);
  if (value && CGAL::abs(Rational(*value)) > value_error(c, 0))
    return Outcome::violated(fmt::format("the value is {}, and the shapes meet", text(*value)));
  return {};
}

Outcome check_larger_radius(const Case& c) {
  if (c.contact(0) == nullptr || c.contact(1) == nullptr) return Outcome::vacuous();
  const bool first = cores(c, 0).radius[0] != cores(c, 1).radius[0];
  if (!coincident(c, 0))
    if (auto why = different_numbers(c, 0, 1, *c.contact(0), {Field::normal, first ? Field::point2 : Field::point1}))
      return Outcome::violated(*why);
  const auto before = finite_value(c, 0);
  const auto after = finite_value(c, 1);
  if (!before || !after) return {};
  const Rational lower = signed_distance(c, 0, *before) - signed_distance(c, 1, *after);
  const Rational larger = cores(c, 1).radius[0] + cores(c, 1).radius[1] - cores(c, 0).radius[0] - cores(c, 0).radius[1];
  if (CGAL::abs(lower - larger) <= value_error(c, 0) + value_error(c, 1)) return {};
  return Outcome::violated(fmt::format("the value goes from {} to {} where a radius grows by {}", text(*before),
                                       text(*after), text(CGAL::to_double(larger))));
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
  if (CGAL::abs(Rational(*after) - Rational(*before) - change) > value_error(c, 0) + value_error(c, 1))
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
  if (c.subject.tolerance()) {
    if (verdict.at(oracle::Measure::length).within && verdict.at(oracle::Measure::angle).within) return {};
    for (const Field field : oracle::kFields)
      if (const auto& f = verdict.at(field); f && !f->off.within)
        return Outcome::violated(fmt::format("{} is {} off, beyond the tolerance", name(field), text(f->off.most)));
    return Outcome::violated("a number of a contact that is none is beyond the tolerance");
  }
  for (const Field field : oracle::kFields)
    if (const auto& f = verdict.at(field); f && f->too_many)
      return Outcome::violated(fmt::format("{} are more than the declared {}", name(field),
                                           c.subject.info.declared.conventions.most_points));
    else if (f && f->grade == Grade::beyond_bound)
      return Outcome::violated(fmt::format("{} is {:.3g} ulps of its scale off, beyond the declared {:g}", name(field),
                                           f->error,
                                           field == Field::normal  ? c.subject.info.declared.bounds.normal
                                           : field == Field::value ? c.subject.info.declared.bounds.value
                                                                   : c.subject.info.declared.bounds.point));
  return {};
}

}  // namespace contact::proptests
