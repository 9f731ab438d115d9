// The causes of wrong answers: what a question looks like to a formula, and the tables put together.
#include "oracle/diagnosis/hypotheses.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "oracle/diagnosis/formulas.hpp"
#include "oracle/truth/casts.hpp"
#include "oracle/truth/cores.hpp"
#include "oracle/truth/exact_truth.hpp"

namespace contact::oracle {

namespace {

constexpr int kEnoughBits = 100;  // more than Real has

/// The number as exactly as Real holds it.
Real real(const Rational& x) {
  const double most = CGAL::to_double(x);
  return std::isfinite(most) ? static_cast<Real>(most) + static_cast<Real>(CGAL::to_double(x - Rational(most))) : most;
}
Numbers real(const Point& p) { return {real(p[0]), real(p[1]), real(p[2])}; }

/// What `Facts::condition` says of shapes.
Real condition_of(const CrossingInReals& x) {
  return x.direction.stableNorm() * (x.v[1] - x.v[0]).stableNorm() * (x.v[2] - x.v[0]).stableNorm() /
         std::abs(x.determinant());
}
template <class A, class B>
Real condition_of(const Two<A, B>& shapes) {
  if constexpr (std::same_as<Two<A, B>, Capsules>) {
    const Numbers u = AxisInReals(shapes.a).along;
    const Numbers v = AxisInReals(shapes.b).along;
    const Numbers n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const Real size = formulas::dot(u, u) * formulas::dot(v, v);
    return size > 0 ? size / formulas::dot(n, n) : 1;
  } else if constexpr (std::same_as<B, Triangle> && std::same_as<A, Ball>) {
    std::array<Numbers, 3> edge;
    Real longest2 = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      edge[k] = formulas::along(formulas::numbers_of(shapes.b.vertices[(k + 1) % 3]), -1,
                                formulas::numbers_of(shapes.b.vertices[k]));
      longest2 = std::max(longest2, formulas::dot(edge[k], edge[k]));
    }
    const auto& [u, v, w] = edge;
    const Numbers n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    return longest2 > 0 ? longest2 * longest2 / formulas::dot(n, n) : 1;
  } else if constexpr (std::constructible_from<CrossingInReals, const Two<A, B>&>) {
    return condition_of(CrossingInReals(shapes));
  } else {
    return 1;
  }
}

/// Nothing of an answer survives a larger one: 2^64 stands for infinity.
Real limited(Real grown) {
  const Real most = std::ldexp(Real{1}, 64);
  return grown >= 1 ? std::min(grown, most) : std::isnan(grown) ? most : 1;
}

/// Of a ray that is cast, what its place grows by, and its normal. The quadratic formula loses L^2 in h, the square of
/// half the way through what is round, so that t loses L (L / sqrt(h)), and sqrt(h) is r times the cosine of the angle
/// at which the ray goes in; a normal is the way from the axis, r long. `cosine` is 1 where nothing is hit.
struct CastCondition {
  Real place = 1;
  Real sine = 1;  ///< what Facts::sine is
};
template <class Target>
CastCondition condition_of_cast(const CastAt<Target>& shapes, Real largest, Real cosine) {
  if constexpr (requires { shapes.b.radius; }) {
    Real place = largest / (Real{shapes.b.radius} * cosine);
    if constexpr (std::same_as<Target, Capsule>) {
      // Nearly along the axis the quadratic formula divides by what is left of the direction across it.
      const Numbers d = formulas::numbers_of(shapes.a.direction);
      const Numbers u = AxisInReals(shapes.b).along;
      const Numbers n{d[1] * u[2] - d[2] * u[1], d[2] * u[0] - d[0] * u[2], d[0] * u[1] - d[1] * u[0]};
      if (formulas::dot(n, n) > 0) place *= formulas::dot(d, d) * formulas::dot(u, u) / formulas::dot(n, n);
    }
    return {place, Real{shapes.b.radius} / (largest * place)};
  } else if constexpr (std::same_as<Target, Triangle>) {
    const CrossingInReals crossing(RayAndTriangle{shapes.a, shapes.b});
    return {condition_of(crossing), crossing.sine};
  } else {
    return {1 / cosine, 1};
  }
}

/// The least box around the points of a shape, which is the box itself for a box.
template <class Shape>
Box bounds_of(const Shape& shape) {
  Box bounds{Vector3::Constant(std::numeric_limits<double>::infinity()),
             Vector3::Constant(-std::numeric_limits<double>::infinity())};
  for_each_field(shape, [&](const auto& /*field*/, const auto& value) {
    for_each_vector(value, [&](const Vector3& v) { bounds = {bounds.min.cwiseMin(v), bounds.max.cwiseMax(v)}; });
  });
  return bounds;
}

}  // namespace

Facts::Facts(const Query& asked, const Truth& true_of_it, Scalar engine_scalar, std::optional<Numbers> normal_said)
    : query(asked),
      truth(&true_of_it),
      scalar(engine_scalar),
      region(Region::beyond),
      alarm(0),
      contact(0),
      said_normal(normal_said) {
  read(true_of_it);
  const bool inside =
      std::visit([&](const auto& shapes) { return formulas::one_inside_the_other(*this, shapes); }, query.shapes);
  if (truth->at_alarm == Side::beyond) return;
  if (truth->coincident())
    region = Region::coincident;
  else if (truth->at_alarm == Side::at)
    region = alarm == 0 ? Region::touching : Region::at_alarm;
  else if (truth->at_zero != Side::within)
    region = Region::near;
  else
    region = inside ? Region::inside : depth > 0 || distance < 0 ? Region::core_inside : Region::overlapping;
}

void Facts::ask(Query other) {
  // What overflows stays the largest number: there is no truth about infinity.
  const double largest = std::numeric_limits<double>::max();
  for_each_number(other, [largest](const std::string&, double& x) { x = std::clamp(x, -largest, largest); });
  // Nor about NaN, a plane whose normal has become 0, or a ray that is cast without a direction.
  bool is_nothing = false;
  for_each_field(other, [&](const std::string&, const auto& value, FieldKind kind) {
    bool is_zero = has_free_length(kind);
    for_each_number_in(value, [&](double x) {
      is_zero = is_zero && x == 0;
      is_nothing = is_nothing || std::isnan(x);
    });
    is_nothing = is_nothing || is_zero;
  });
  if (is_nothing) return;
  // Most causes change no number of most questions: what is true of those is known.
  const auto before = numbers_of(query);
  const auto after = numbers_of(other);
  if (std::equal(before.begin(), before.end(), after.begin(), after.end(),
                 [](const double* x, const double* y) { return *x == *y; }))
    return;
  query = std::move(other);
  read(truth_of(query));
}

void Facts::read(const Truth& of_query) {
  alarm = query.distances.alarm;
  contact = query.distances.contact;
  const auto bound = [&](std::size_t shape, const Box& box) {
    min[shape] = formulas::numbers_of(box.min);
    max[shape] = formulas::numbers_of(box.max);
  };
  std::size_t which = 0;
  for_each_shape(query, [&](const auto& shape) { bound(which++, bounds_of(shape)); });
  const Real grown = std::visit([](const auto& shapes) { return condition_of(shapes); }, query.shapes);
  condition = limited(grown);
  read_crossing(of_query.hit());
  const DistanceTruth* exact = of_query.contact() != nullptr ? of_query.contact() : of_query.distance();
  if (exact == nullptr) return;
  const Cores& cores = exact->cores();
  for (const int shape : {0, 1}) {
    const auto i = static_cast<std::size_t>(shape);
    nearest[i] = real(cores.nearest[i]);
    radius[i] = real(cores.radius[i]);
    scale[i] = static_cast<Real>(round_to_nearest(exact->point_scale(shape), Scalar::binary64));
  }
  depth = 0;
  t = 0;
  inward.reset();
  if (const CastHit* cast = exact->cast()) {
    // A contact without a distance, as of a crossing; where many normals are right, the engine's is.
    t = static_cast<Real>(round_to_nearest(cast->t, Scalar::binary64));
    if_cast(query.shapes, [&](const auto& shapes) {
      const Numbers d = formulas::numbers_of(shapes.a.direction);
      per_length = 1 / std::sqrt(formulas::dot(d, d));
    });
    const Numbers normal = real(cast->along);
    const Numbers reference = formulas::times(1 / std::sqrt(formulas::dot(normal, normal)), normal);
    const bool is_said = said_normal && std::isfinite(formulas::sum_of(*said_normal));
    inward = (cast->inside || cast->against) && is_said ? *said_normal : reference;
    if (cast->either_side && said_normal && formulas::dot(*said_normal, reference) < 0)
      inward = formulas::times(-1, reference);
    if_cast(query.shapes, [&](const auto& shapes) {
      settle_cast(std::abs(formulas::dot(reference, formulas::numbers_of(shapes.a.direction))) * per_length);
    });
  }
  if (cores.half_space) {
    const Numbers direction = real(cores.half_space->inward);
    const Real size = formulas::largest_of(direction);  // the square of a long normal may leave the range
    const Numbers shorter = formulas::times(1 / size, direction);
    inward = formulas::times(1 / std::sqrt(formulas::dot(shorter, shorter)), shorter);
  }
  settle();
  if (!exact->meets() || exact->coincident() || exact->cast() != nullptr) return;
  // Of several ways out that are as short, an engine takes the one that its normal comes nearest to.
  depth = real(exact->depth().enclosure(kEnoughBits).low);
  distance = -depth;
  Real best = -formulas::kInfinity;
  for (const WayOut& way : exact->meeting().ways) {
    const Numbers direction = real(way.direction);
    const Numbers unit = formulas::times(1 / std::sqrt(formulas::dot(direction, direction)), direction);
    const Real along = said_normal ? formulas::dot(unit, *said_normal) : 0;
    if (!(along > best) && best > -formulas::kInfinity) continue;
    best = std::isnan(along) ? Real{0} : along;
    n = unit;
    nearest = {real(way.first), real(way.nearest)};
  }
  if (const auto* shapes = std::get_if<Convexes>(&query.shapes);
      shapes != nullptr && said_normal && !has_plane(query.pair)) {
    const auto farthest = [](const Convex& shape, const Numbers& way) {
      Real most = -formulas::kInfinity;
      for (const auto& x : exact_core(shape).vertices) most = std::max(most, formulas::dot(real(x), way));
      return most;
    };
    detour = farthest(shapes->a, *said_normal) + farthest(shapes->b, formulas::times(-1, *said_normal)) - depth;
  }
}

void Facts::read_crossing(bool hit) {
  if (!is_crossing(query.pair) && !is_cast(query.pair)) return;
  if (is_crossing(query.pair)) alarm = contact = 0;
  crosses = hit;
  const auto take = [&](const CrossingInReals& crossing) {
    slack = crossing.slack();
    sine = crossing.sine;
  };
  if_cast(query.shapes, [&](const auto& shapes) {
    slack = static_cast<Real>(round_to_nearest(distance_to_change(shapes, hit), Scalar::binary64));
  });
  settle_cast(1);
  if (const auto* ray = std::get_if<RayAndTriangle>(&query.shapes)) take(CrossingInReals(*ray));
  if (const auto* line = std::get_if<TriangleAndLine>(&query.shapes)) take(CrossingInReals(*line));
}

void Facts::settle_cast(Real cosine) {
  if_cast(query.shapes, [&](const auto& shapes) {
    Real largest = 0;
    for (const auto* vectors : {&min, &max})
      for (const Numbers& v : *vectors) largest = std::max(largest, formulas::largest_of(v));
    const CastCondition of = condition_of_cast(shapes, largest, cosine);
    condition = limited(of.place);
    sine = 1 / limited(1 / of.sine);
  });
}

void Facts::settle() {
  delta = formulas::along(nearest[1], -1, nearest[0]);
  settle_from_delta();
}

void Facts::settle_from_delta() {
  D = formulas::dot(delta, delta);
  if (inward) {
    distance = formulas::dot(delta, *inward);
    n = *inward;
    return;
  }
  if (D == 0 && depth > 0) return;
  depth = 0;
  distance = std::sqrt(D);
  n = D > 0 ? formulas::times(1 / distance, delta) : said_normal.value_or(Numbers{});
}

Real Facts::gap(std::size_t axis) const { return std::max(min[0][axis] - max[1][axis], min[1][axis] - max[0][axis]); }
Real Facts::widest_gap() const { return std::max({gap(0), gap(1), gap(2)}); }

Said Said::at_most(Real x, Real y, Real size) {
  constexpr Real kEpsilon = std::numeric_limits<Real>::epsilon();
  constexpr Real kSteps = 16;  // what roundings of a formula's steps can change, and of the numbers that it begins with
  constexpr Real kBeginnings = 2;
  const Real near = kEpsilon * std::max(kSteps * std::max(std::abs(x), std::abs(y)), kBeginnings * size);
  if (!(std::abs(x - y) > near)) return std::nullopt;
  return hit(x < y);
}

std::span<const Cause> causes() {
  static const std::vector<Cause> all = [] {
    std::vector<Cause> made;
    const auto append = [&](std::vector<Cause> table, std::size_t kind) {
      for (Cause& cause : table) {
        cause.kind = kind;
        made.push_back(std::move(cause));
      }
    };
    for (const auto table : {formulas::wrong_inputs, formulas::wrong_decisions}) append(table(), kEveryKind);
    for (const Pair pair : pairs_of_kinds())
      std::visit(
          [&](const auto& shapes) {
            append(formulas::wrong_about(static_cast<decltype(&shapes)>(nullptr)), kind_of(pair));
          },
          description(pair).zeros());
    for (const auto table :
         {formulas::wrong_features, formulas::wrong_planes, formulas::wrong_crossings, formulas::wrong_casts,
          formulas::wrong_normals, formulas::wrong_points, formulas::wrong_values, formulas::wrong_arithmetic})
      append(table(), kEveryKind);
    if (made.size() > kMostCauses) throw std::length_error("more causes than kMostCauses");
    return made;
  }();
  return all;
}

std::size_t cause_index(std::string_view id) {
  const auto all = causes();
  const auto it = std::find_if(all.begin(), all.end(), [&](const Cause& c) { return c.id == id; });
  if (it == all.end()) throw std::out_of_range("no cause '" + std::string(id) + "'");
  return static_cast<std::size_t>(it - all.begin());
}

namespace {

/// What follows for the midpoint from what is said of the contact points; of which nothing is said, that is right.
Said midpoint_of(const Facts& facts, const std::array<Said, 2>& points) {
  if (points[0].kind == Said::Kind::anything || points[1].kind == Said::Kind::anything) return Said::anything();
  if (points[0].kind != Said::Kind::numbers && points[1].kind != Said::Kind::numbers) return std::nullopt;
  Said middle = Numbers{};
  for (const std::size_t shape : {0U, 1U}) {
    const Said& point = points[shape];
    const bool is_said = point.kind == Said::Kind::numbers;
    middle.numbers = formulas::along(middle.numbers, 0.5L, is_said ? point.numbers : formulas::surface(facts, shape));
    middle.tolerance = std::max(middle.tolerance, point.tolerance);
    middle.least = std::max(middle.least, point.least / 2);
  }
  return middle;
}

Predictions predict_fields(const Cause& cause, const Facts& facts) {
  Predictions said;
  if (cause.kind != kEveryKind && cause.kind != facts.query.shapes.index()) return said;
  if (cause.edit) {
    Facts f = facts;
    cause.edit(f);
    said.hit = formulas::within(f, f.alarm);
    if (!f.has_numbers()) return said;
    said.value = formulas::right_value(f);
    if (!f.has_direction()) f.n = facts.n;  // any normal is right
    if (facts.has_direction()) said.normal = f.n;
    if (facts.has_direction() || !f.has_direction()) said.point = {formulas::surface(f, 0), formulas::surface(f, 1)};
    return said;
  }
  if (cause.hit) said.hit = cause.hit(facts);
  if (!facts.has_numbers()) return said;
  if (cause.normal) said.normal = cause.normal(facts);
  if (cause.point) said.point = {cause.point(facts, 0), cause.point(facts, 1)};
  if (cause.value) said.value = cause.value(facts);
  return said;
}

}  // namespace

Predictions predict(const Cause& cause, const Facts& facts) {
  Predictions said = predict_fields(cause, facts);
  said.midpoint = midpoint_of(facts, said.point);
  return said;
}

}  // namespace contact::oracle
