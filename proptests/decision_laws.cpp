// Hits and misses: the exact decision, what touches, and what must stay a hit.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "oracle/diagnosis/nearest_in_reals.hpp"
#include "proptests/law_functions.hpp"

namespace contact::proptests {
namespace {

/// A power of two that every range holds, the one next to 1.
double unit_length(const Range& range) { return std::ldexp(1.0, std::clamp(0, range.bottom, range.top)); }

/// One step of the grid that every number of a question lies on: the largest power of two that divides them all.
double grid_step(const Query& query, const Range& range) {
  double step = std::ldexp(1.0, range.top);
  for_each_number(query, [&](const std::string&, double x) {
    while (std::fmod(x, step) != 0) step /= 2;
  });
  return step;
}

/// The question and one that is just beyond: by one step of the grid, so that plain arithmetic is exact, or by one ulp
/// for boxes of an engine that is held to correct rounding.
Questions touching_and_beyond(const Trial& trial, const Subject& subject) {
  Query beyond = trial.query;
  const double step = grid_step(trial.query, subject.range);
  if (beyond.has_distance()) {
    std::vector<double*> lengths = radii_of(beyond);
    lengths.push_back(&beyond.distances.alarm);
    const auto last = std::find_if(lengths.rbegin(), lengths.rend(), [](const double* x) { return *x > 0; });
    if (last == lengths.rend()) return {};
    **last -= step;
    return {trial.query, beyond};
  }
  const auto moved = [&](double x, int direction) {
    return subject.correctly_rounded ? subject.range.moved(x, direction) : x + direction * step;
  };
  auto& [a, b] = std::get<Boxes>(beyond.shapes);
  const double alarm = beyond.distances.alarm;
  for (int axis = 0; axis < 3; ++axis) {
    if (b.min[axis] - a.max[axis] == alarm && a.max[axis] + alarm == b.min[axis]) {
      b.min[axis] = moved(b.min[axis], 1);
      b.max[axis] = std::max(b.max[axis], b.min[axis]);
      return {trial.query, beyond};
    }
    if (a.min[axis] - b.max[axis] == alarm && a.min[axis] - alarm == b.max[axis]) {
      b.max[axis] = moved(b.max[axis], -1);
      b.min[axis] = std::min(b.max[axis], b.min[axis]);
      return {trial.query, beyond};
    }
  }
  return {};
}

}  // namespace

Questions touching(const Trial& trial, const Subject& subject) {
  return trial.query.distances.alarm == 0 ? touching_and_beyond(trial, subject) : Questions{};
}
Questions at_the_alarm_distance(const Trial& trial, const Subject& subject) {
  return trial.query.distances.alarm > 0 ? touching_and_beyond(trial, subject) : Questions{};
}

Questions each_axis_alone(const Trial& trial, const Subject& subject) {
  const Boxes& boxes = *trial.query.boxes();
  const double wide = unit_length(subject.range);
  Questions questions{trial.query};
  for (int axis = 0; axis < 3; ++axis) {
    const Box everywhere{Vector3::Constant(-wide), Vector3::Constant(wide)};
    Boxes alone{everywhere, everywhere};
    alone.a.min[axis] = boxes.a.min[axis];
    alone.a.max[axis] = boxes.a.max[axis];
    alone.b.min[axis] = boxes.b.min[axis];
    alone.b.max[axis] = boxes.b.max[axis];
    questions.push_back({Pair::cube_cube, alone, trial.query.distances});
  }
  return questions;
}

Questions one_inside_the_other(const Trial& trial, const Subject&) {
  const auto& [a, b] = *trial.query.boxes();
  const bool inside = (b.min.array() > a.min.array()).all() && (b.max.array() < a.max.array()).all();
  return inside ? Questions{trial.query} : Questions{};
}

Questions alarm_grown(const Trial& trial, const Subject& subject) {
  Query grown = trial.query;
  grown.distances.alarm = std::max(subject.range.moved(grown.distances.alarm, 1), trial.change.length);
  return {trial.query, grown};
}

namespace {

template <class Shape>
constexpr bool kCanGrow =
    kHasRadius<Shape> || !(std::same_as<Shape, Line> || requires(Shape shape) { shape.vertices; });

}  // namespace

bool can_grow(Pair pair) {
  return of_shapes(pair, []<class A, class B>() { return kCanGrow<A> || kCanGrow<B>; });
}

Questions size_grown(const Trial& trial, const Subject& subject) {
  Query grown = trial.query;
  const double length = trial.change.length;
  const int choice = trial.change.choice;
  const auto grow = [&]<class Shape>(Shape& shape) {
    if constexpr (std::same_as<Shape, Box>) {
      const int axis = choice / 2 % 3;
      if (choice / 6 % 2 == 0)
        shape.min[axis] = std::min(subject.range.moved(shape.min[axis], -1), -length);
      else
        shape.max[axis] = std::max(subject.range.moved(shape.max[axis], 1), length);
    } else if constexpr (std::derived_from<Shape, Ray>) {
      shape.length = std::max(subject.range.moved(shape.length, 1), length);
    } else if constexpr (std::same_as<Shape, Plane>) {
      shape.offset = std::max(subject.range.moved(shape.offset, 1), length);
    } else if constexpr (std::same_as<Shape, Obb>) {
      const int axis = choice / 2 % 3;
      shape.extents[axis] = std::max(subject.range.moved(shape.extents[axis], 1), length);
    } else if constexpr (requires { shape.radius; }) {
      shape.radius = std::max(subject.range.moved(shape.radius, 1), length);
    }
  };
  const auto [a, b] = two_shapes(grown);
  const auto can_grow_of = []<class Shape>(const Shape* /*shape*/) { return kCanGrow<Shape>; };
  const bool first = !std::visit(can_grow_of, b) || (std::visit(can_grow_of, a) && choice % 2 == 0);
  std::visit([&](auto* shape) { grow(*shape); }, first ? a : b);
  return {trial.query, grown};
}

Questions across_a_common_edge(const Trial& trial, const Subject& subject) {
  const auto& [drawn, one] = std::get<CastAt<Triangle>>(trial.query.shapes);
  const auto& v = one.vertices;
  // The other triangle lies opposite; the ray goes through the edge, as near as it can.
  const Triangle other{{v[1], v[0], subject.range.rounded(v[0] + v[1] - v[2])}};
  Cast ray = drawn;
  ray.direction = subject.range.rounded(v[0] + (1 + trial.change.choice % 7) / 8.0 * (v[1] - v[0]) - ray.origin);
  ray.length = 2;
  // Thin triangles, and rays along them, have no room on either side of the edge.
  for (const Triangle& triangle : {one, other}) {
    const oracle::CrossingInReals x(RayAndTriangle{ray, triangle});
    const oracle::Real size = std::max((x.v[1] - x.v[0]).stableNorm(), (x.v[2] - x.v[0]).stableNorm());
    const oracle::Real least = std::min((x.v[1] - x.v[0]).stableNorm(), (x.v[2] - x.v[0]).stableNorm());
    if (!(x.sine > 0.125L) || !(least > size / 16) || !(x.along.stableNorm() < 16 * size)) return {};
    if (!(std::abs(x.through()) > 0.125L * x.along.stableNorm())) return {};
    for (const Vector3& p : triangle.vertices)  // nor has an edge of a few ulps
      if (!(p.cwiseAbs().maxCoeff() < 1024 * size)) return {};
  }
  const auto asked = [&](const Triangle& triangle) {
    return Query{Pair::cast_triangle, CastAt<Triangle>{ray, triangle}, trial.query.distances};
  };
  return {asked(one), asked(other)};
}

Outcome check_common_edge(const Case& c) {
  if (!c.truth(0).hit() && !c.truth(1).hit()) return Outcome::vacuous();
  if (says_hit(c.claims[0]) || says_hit(c.claims[1])) return {};
  return Outcome::violated("the ray goes through between two triangles that have an edge in common");
}

Outcome check_decisions(const Case& c) {
  for (std::size_t i = 0; i < c.queries.size(); ++i) {
    const auto verdict = oracle::judge(c.queries[i], c.truth(i), c.claims[i], c.subject.info.declared);
    if (c.subject.tolerance() && verdict.at(oracle::Measure::decision).within) continue;
    const auto wrong = [&](oracle::Decision decision, std::string_view what) -> std::optional<std::string> {
      if (decision == oracle::Decision::missed_hit)
        return fmt::format("question {} is a hit, and the engine says no {}", i + 1, what);
      if (decision == oracle::Decision::false_hit)
        return fmt::format("question {} is a miss, and the engine says {}", i + 1, what);
      return std::nullopt;
    };
    if (auto why = wrong(verdict.overlap, "overlap")) return Outcome::violated(*why);
    if (auto why = wrong(verdict.contact, "contact")) return Outcome::violated(*why);
  }
  return {};
}

Outcome check_touching(const Case& c) {
  return c.truth(0).at_alarm == oracle::Side::at && c.truth(1).at_alarm == oracle::Side::beyond ? check_decisions(c)
                                                                                                : Outcome::vacuous();
}

Outcome check_test_agrees(const Case& c) {
  const Conventions& declared = c.subject.info.declared.conventions;
  const Claim& claim = c.claims[0];
  if (!claim.overlap || !claim.speaks_of_contact || undecided(c, 0)) return Outcome::vacuous();
  if (declared.touching_overlap != declared.touching_contact && c.truth(0).at_zero == oracle::Side::at)
    return Outcome::vacuous();
  if (declared.coincident == Coincident::no_contact && coincident(c, 0)) return Outcome::vacuous();
  if (*claim.overlap == claim.contact.has_value()) return {};
  return Outcome::violated(*claim.overlap ? "an overlap without a contact" : "a contact without an overlap");
}

Outcome check_each_axis(const Case& c) {
  if (undecided(c, 0)) return Outcome::vacuous();
  const bool all = says_hit(c.claims[1]) && says_hit(c.claims[2]) && says_hit(c.claims[3]);
  if (says_hit(c.claims[0]) == all) return {};
  return Outcome::violated(fmt::format("{} in space, and {} axis by axis", says_hit(c.claims[0]) ? "a hit" : "a miss",
                                       all ? "a hit on each" : "a miss on one"));
}

Outcome check_grown(const Case& c) {
  if (undecided(c, 0) || undecided(c, 1)) return Outcome::vacuous();
  const bool small = says_hit(c.claims[0]);
  const bool large = says_hit(c.claims[1]);
  if (!small && large) return Outcome::vacuous();  // says nothing
  if (small && !large) return Outcome::violated("a hit becomes a miss by growing");
  return {};
}

}  // namespace contact::proptests
