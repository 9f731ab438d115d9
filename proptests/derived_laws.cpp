// Questions made of the engine's own answer to the last: what it said of one must hold in the next.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "oracle/truth/exact_truth.hpp"
#include "proptests/law_functions.hpp"

namespace contact::proptests {
namespace {

/// The pair of a shape and a plane.
template <class Shape>
constexpr std::optional<Pair> pair_over_plane() {
  for (const Pair pair : kPairs)
    if (of_shapes(pair, []<class A, class B>() { return std::same_as<A, Shape> && std::same_as<B, Plane>; }))
      return pair;
  return std::nullopt;
}

/// Which of the two shapes a law is about.
std::size_t shape_chosen(const Trial& trial) { return static_cast<std::size_t>(trial.change.choice) % 2; }

/// The claimed point of a shape, where it is a number and lies on its surface, on the side of the other.
const Vector3* surface_point(const Query& query, const Claim& claim, const Subject& subject, std::size_t shape) {
  const Field field = shape == 0 ? Field::point1 : Field::point2;
  const auto on = point_of(subject.info.declared.conventions, query, static_cast<int>(shape));
  if (on != PointOn::nearest_surface || !subject.claims(field) || !claim.contact) return nullptr;
  const auto& point = shape == 0 ? claim.contact->point1 : claim.contact->point2;
  return point && point->allFinite() ? &*point : nullptr;
}
/// The claimed normal as it points out of a shape.
std::optional<Vector3> way_out_of(const Claim& claim, const Subject& subject, std::size_t shape) {
  if (!subject.claims(Field::normal) || !claim.contact || !claim.contact->normal) return std::nullopt;
  const Vector3 n = first_to_second(subject.info.declared.conventions, *claim.contact->normal);
  if (!n.allFinite()) return std::nullopt;
  return shape == 0 ? n : Vector3(-n);
}
double largest(const Vector3& v) { return v.cwiseAbs().maxCoeff(); }
/// No less than how far two points of a core are from each other.
template <class Shape>
double breadth(const Shape& shape) {
  if constexpr (std::same_as<Shape, Obb>) {
    return 2 * shape.extents.sum();
  } else {
    std::optional<std::array<Vector3, 2>> box;
    for_each_point(shape, [&](const Vector3& v) {
      if (!box) box = {v, v};
      box = {(*box)[0].cwiseMin(v), (*box)[1].cwiseMax(v)};
    });
    return box ? ((*box)[1] - (*box)[0]).sum() : 0;
  }
}
Rational exact_dot(const Vector3& x, const Vector3& y) {
  Rational sum(0);
  for (int axis = 0; axis < 3; ++axis) sum += Rational(x[axis]) * Rational(y[axis]);
  return sum;
}
/// How far a point may be from where it should be.
Rational off(const Case& c, std::size_t shape) { return Rational(2) * point_allowance(c, 0, static_cast<int>(shape)); }
/// A contact that question 2 must have, and does not, or nothing.
std::optional<Outcome> missing(const Case& c) {
  if (c.contact(1) != nullptr) return std::nullopt;
  // Where cores meet an engine may declare that there is none.
  if (!c.claims[1].speaks_of_contact || undecided(c, 1) || coincident(c, 1) || !c.truth(1).hit())
    return Outcome::vacuous();
  return Outcome::violated("question 2, made of the contact of question 1, has none");
}

bool cut(Capsule& capsule, const Vector3& at, int choice) {
  (choice % 2 == 0 ? capsule.start : capsule.end) = at;
  return true;
}
template <class Shape>
requires requires(Shape shape) { shape.vertices; }
bool cut(Shape& shape, const Vector3& at, int choice) {
  shape.vertices[static_cast<std::size_t>(choice) % shape.vertices.size()] = at;
  return true;
}
bool cut(Box& box, const Vector3& at, int choice) {
  for (int axis = 0; axis < 3; ++axis) {
    const double corner = (choice >> axis & 1) == 0 ? box.min[axis] : box.max[axis];
    box.min[axis] = std::min(corner, at[axis]);
    box.max[axis] = std::max(corner, at[axis]);
  }
  return true;
}
bool cut(Hull& hull, const Vector3& at, int /*choice*/) {
  if (hull.vertices.size() >= kMostVertices) return false;
  hull.vertices.push_back(at);
  return true;
}

}  // namespace

Questions onto_point(const Trial& trial, const Subject& subject, const Claim& claim) {
  Query next = trial.query;
  const auto shapes = two_shapes(next);
  auto* const* ball = std::get_if<Ball*>(&shapes[0]);
  const Vector3* point = surface_point(trial.query, claim, subject, 1);
  if (ball == nullptr || point == nullptr || !((*ball)->radius > 0)) return {};
  (*ball)->center = *point;
  return {next};
}

Outcome check_onto_point(const Case& c) {
  if (parts_anywhere(c, 1) || !c.truth(0).hit()) return Outcome::vacuous();
  Query asked = c.queries[1];
  const Rational radius(std::get<Ball*>(two_shapes(asked)[0])->radius);
  if (radius <= off(c, 1)) return Outcome::vacuous();
  if (auto outcome = missing(c)) return *outcome;
  const auto value = finite_value(c, 1);
  if (!value) return Outcome::vacuous();
  if (CGAL::abs(signed_distance(c, 1, *value) + radius) <= off(c, 1) + value_error(c, 1)) return {};
  return Outcome::violated(
      fmt::format("about the point {} that the engine says is on the other shape, a sphere with the radius {} has the "
                  "value {}",
                  text(*c.contact(0)->point2), text(CGAL::to_double(radius)), text(*value)));
}

Questions tangent_plane(const Trial& trial, const Subject& subject, const Claim& claim) {
  const std::size_t which = shape_chosen(trial);
  const Vector3* point = surface_point(trial.query, claim, subject, which);
  const auto out = way_out_of(claim, subject, which);
  if (point == nullptr || !out || out->isZero(0)) return {};
  Query asked = trial.query;
  return std::visit(
      [&]<class Shape>(Shape* shape) -> Questions {
        if constexpr (constexpr auto over_plane = pair_over_plane<Shape>(); over_plane.has_value()) {
          const Pair pair = *over_plane;
          if (!subject.serves_alike(pair)) return {};
          // Not where the plane touches, but a good way inside, so that there is a contact.
          const double inside = std::max(largest(*point), breadth(*shape)) / 4;
          if (!std::isfinite(inside) || !std::isfinite(out->stableNorm())) return {};
          const Rational offset = Rational(inside) - exact_dot(*out, *point);
          const Plane plane{-*out, subject.range.rounded(CGAL::to_double(offset))};
          return {{pair, of_a_kind(*shape, plane), trial.query.distances}};
        } else {
          return {};
        }
      },
      two_shapes(asked)[which]);
}

Outcome check_tangent_plane(const Case& c) {
  const std::size_t which = shape_chosen(c.trial);
  if (coincident(c, 0) || parts_anywhere(c, 0) || !c.truth(0).hit()) return Outcome::vacuous();
  if (auto outcome = missing(c)) return *outcome;
  const auto value = finite_value(c, 1);
  if (!value) return Outcome::vacuous();
  Query asked = c.queries[1];
  const auto shapes = two_shapes(asked);
  const Plane& plane = *std::get<Plane*>(shapes[1]);
  const Vector3& point = *surface_point(c.queries[0], c.claims[0], c.subject, which);
  // What the plane, as it has been rounded, leaves of the shape on its other side.
  const double length = plane.normal.stableNorm();
  const Rational height = (exact_dot(plane.normal, point) - Rational(plane.offset)) / Rational(length);
  const Rational across(std::visit([](const auto* shape) { return breadth(*shape); }, shapes[0]));
  const Rational error = value_error(c, 1) + off(c, which) + Rational(4) * allowance(c, 0, Field::normal) * across +
                         CGAL::abs(height) * Rational(0x1p-50);
  if (CGAL::abs(signed_distance(c, 1, *value) - height) <= error) return {};
  return Outcome::violated(
      fmt::format("over the plane of the engine's normal {} beyond the engine's point {}, the shape that both are of "
                  "has the value {}",
                  text(CGAL::to_double(height)), text(point), text(*value)));
}

Questions cut_at_point(const Trial& trial, const Subject& subject, const Claim& claim) {
  Query next = trial.query;
  const std::size_t which = shape_chosen(trial);
  const Vector3* point = surface_point(trial.query, claim, subject, which);
  if (point == nullptr) return {};
  const bool done = std::visit(
      [&]<class Shape>(Shape* shape) {
        if constexpr (requires { cut(*shape, *point, 0); }) {
          Vector3 at = *point;
          if constexpr (kHasRadius<Shape>) {
            const auto out = way_out_of(claim, subject, which);
            if (!out && shape->radius > 0) return false;
            if (out) at -= shape->radius * *out;
          }
          for (double& x : at) x = subject.range.rounded(x);
          return cut(*shape, at, trial.change.choice / 2);
        } else {
          return false;
        }
      },
      two_shapes(next)[which]);
  return done ? Questions{next} : Questions{};
}

Outcome check_cut_at_point(const Case& c) {
  if (!c.truth(0).hit() || coincident(c, 0) || c.truth(0).distance()->meets()) return Outcome::vacuous();
  if (auto outcome = missing(c)) return *outcome;
  const auto before = finite_value(c, 0);
  const auto after = finite_value(c, 1);
  if (!before || !after) return Outcome::vacuous();
  const std::size_t which = shape_chosen(c.trial);
  const Rational& radius = c.truth(0).distance()->cores().radius[which];
  const Rational error = value_error(c, 0) + value_error(c, 1) + Rational(2) * off(c, which) +
                         Rational(4) * radius * allowance(c, 0, Field::normal);
  if (CGAL::abs(signed_distance(c, 0, *before) - signed_distance(c, 1, *after)) <= error) return {};
  return Outcome::violated(fmt::format("the value goes from {} to {} where a corner comes to the engine's own point",
                                       text(*before), text(*after)));
}

}  // namespace contact::proptests
