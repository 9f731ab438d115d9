// What swapping, turning, moving and scaling must do to an answer.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "oracle/truth/cores.hpp"
#include "proptests/law_functions.hpp"

namespace contact::proptests {
namespace {

/// Calls edit(v) for every point of a question: centres, corners, vertices; or for its directions too.
template <class Edit>
void for_each_point(Query& query, Edit edit, bool directions = false) {
  for_each_field(query, [&](const std::string&, auto& value, FieldKind kind) {
    if (kind == FieldKind::point || (directions && kind == FieldKind::direction)) for_each_vector(value, edit);
  });
}

Vector3 first_vector(Query query) {
  std::optional<Vector3> first;
  for_each_point(query, [&](const Vector3& v) { first = first.value_or(v); });
  return *first;
}

Vector3 turned(const Change& change, const Vector3& v) {
  Vector3 result;
  for (std::size_t i = 0; i < 3; ++i)
    result[static_cast<Eigen::Index>(i)] = (change.reflected[i] ? -1 : 1) * v[change.order[i]];
  return result;
}

/// A claim with its vectors and its value edited.
template <class Vectors>
ContactClaim carried_over(const ContactClaim& claim, Vectors vectors) {
  ContactClaim result = claim;
  for (auto* v : {&result.normal, &result.point1, &result.point2, &result.point})
    if (*v) **v = vectors(**v);
  return result;
}

/// The exponent of the last binary digit of a number other than 0.
int last_digit(double x) {
  int exponent = 0;
  const double digits = std::ldexp(std::frexp(x, &exponent), 53);
  int zeros = 0;
  while (std::fmod(std::ldexp(digits, -zeros), 2) == 0) ++zeros;
  return exponent - 53 + zeros;
}

/// x + y in the range and without rounding.
std::optional<double> exact_sum(const Range& range, double x, double y) {
  const double sum = x + y;
  const double back = sum - x;
  const bool exact = std::isfinite(sum) && (x - (sum - back)) + (y - back) == 0;
  return exact && range.contains(sum) ? std::optional(sum) : std::nullopt;
}

Outcome compared(const Case& c, const ContactClaim* wanted, std::initializer_list<Field> fields, int exponent = 0) {
  if (auto why = different_decisions(c, 0, 1)) return Outcome::violated(*why);
  if (wanted == nullptr || c.contact(1) == nullptr) return {};
  if (auto why = different_numbers(c, 0, 1, *wanted, fields, exponent)) return Outcome::violated(*why);
  return {};
}

}  // namespace

Questions swapped(const Trial& trial, const Subject&) {
  Query other = trial.query;
  const bool swappable = std::visit(
      []<class A, class B>(Two<A, B>& shapes) {
        bool alike = std::same_as<A, B>;
        if constexpr (std::same_as<A, Convex>) alike = shapes.a.shape.index() == shapes.b.shape.index();
        if constexpr (std::same_as<A, B>)
          if (alike) std::swap(shapes.a, shapes.b);
        return alike;
      },
      other.shapes);
  if (!swappable) return {};
  return {trial.query, other};
}

Outcome check_swapped(const Case& c) {
  if (c.contact(0) == nullptr) return compared(c, nullptr, {});
  ContactClaim wanted = *c.contact(0);
  // A sphere and a rigid sphere exchange their shapes, not their kinds: a centre stays with its kind.
  const bool points =
      c.subject.info.declared.conventions.points != Points::center || c.queries[0].pair != Pair::sphere_rigid_sphere;
  if (wanted.normal) wanted.normal = Vector3(-*wanted.normal);
  if (points) {
    std::swap(wanted.point1, wanted.point2);
  } else {
    wanted.point1.reset();
    wanted.point2.reset();
  }
  if (coincident(c, 0)) return compared(c, &wanted, {Field::value});
  return compared(c, &wanted, {Field::normal, Field::value, Field::point1, Field::point2, Field::point});
}

namespace {

template <class Number>
using Four = std::array<Number, 4>;
/// The quaternion that turns by r, and then by p.
template <class Number>
Four<Number> product(const Four<Number>& p, const Four<Number>& r) {
  return {p[3] * r[0] + p[0] * r[3] + p[1] * r[2] - p[2] * r[1], p[3] * r[1] - p[0] * r[2] + p[1] * r[3] + p[2] * r[0],
          p[3] * r[2] + p[0] * r[1] - p[1] * r[0] + p[2] * r[3], p[3] * r[3] - p[0] * r[0] - p[1] * r[1] - p[2] * r[2]};
}

/// Another number in the place of x; whether it is one of the range.
bool put(double& x, const Rational& wanted, const Range& range) {
  x = CGAL::to_double(wanted);
  return std::isfinite(x) && Rational(x) == wanted && range.contains(x);
}

/// Turns a box further; whether its numbers are those of the range.
bool turn(Quaternion& q, const Quaternion& by, const Range& range) {
  const auto exactly = [](const Quaternion& p) {
    return Four<Rational>{Rational(p[0]), Rational(p[1]), Rational(p[2]), Rational(p[3])};
  };
  const Four<Rational> right = product(exactly(by), exactly(q));
  bool exact = true;
  for (std::size_t i = 0; i < 4; ++i) exact = put(q[i], right[i], range) && exact;
  return exact;
}

/// The quaternion of a change of axes, or where that reflects, of the change and a reflection in a point, in which boxes
/// are the same.
Quaternion quaternion_of(const Change& change) {
  const Vector3 x = turned(change, Vector3::UnitX());
  const Vector3 y = turned(change, Vector3::UnitY());
  const double sign = x.cross(y).dot(turned(change, Vector3::UnitZ()));
  // Of the quaternions with components -1, 0 and 1, one turns as the change does.
  Quaternion by{};
  for (int code = 0; code < 81; ++code) {
    const Quaternion p{static_cast<double>(code % 3 - 1), static_cast<double>(code / 3 % 3 - 1),
                       static_cast<double>(code / 9 % 3 - 1), static_cast<double>(code / 27 - 1)};
    const double size = p[0] * p[0] + p[1] * p[1] + p[2] * p[2] + p[3] * p[3];
    const auto image = [&](const Vector3& v) {
      const Quaternion r = product<double>(product<double>(p, {v[0], v[1], v[2], 0}), {-p[0], -p[1], -p[2], p[3]});
      return Vector3(r[0], r[1], r[2]);
    };
    if (size > 0 && image(Vector3::UnitX()) == size * sign * x && image(Vector3::UnitY()) == size * sign * y) by = p;
  }
  return by;
}

}  // namespace

Questions turned(const Trial& trial, const Subject& subject) {
  Query other = trial.query;
  for_each_point(
      other, [&](Vector3& v) { v = turned(trial.change, v); }, true);
  bool exact = true;
  for_each_shape(other, [&]<class Shape>(Shape& shape) {
    if constexpr (std::same_as<Shape, Box>) shape = {shape.min.cwiseMin(shape.max), shape.min.cwiseMax(shape.max)};
    if constexpr (std::same_as<Shape, Obb>)
      exact = turn(shape.orientation, quaternion_of(trial.change), subject.range) && exact;
  });
  return exact ? Questions{trial.query, other} : Questions{};
}

const Rotation& rotation_of(const Change& change) {
  // About each axis by the angle of a triangle with sides 3, 4 and 5, and turns that leave no axis where it is.
  static constexpr std::array<Rotation, 8> kRotations{{{{1, 0, 0, 2}},
                                                       {{0, 1, 0, 2}},
                                                       {{0, 0, 1, 2}},
                                                       {{1, 1, 1, 0}},
                                                       {{1, -1, 0, 1}},
                                                       {{1, 1, 1, 2}},
                                                       {{2, 0, 1, 2}},
                                                       {{1, 2, 2, 4}}}};
  return kRotations[static_cast<std::size_t>(change.choice) % kRotations.size()];
}

std::array<std::array<int, 3>, 3> Rotation::matrix() const {
  const auto& [x, y, z, w] = by;
  // size() I + 2 w [u] + 2 [u]^2, u being (x, y, z) and [u] its cross product.
  return {{{size() - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
           {2 * (x * y + z * w), size() - 2 * (x * x + z * z), 2 * (y * z - x * w)},
           {2 * (x * z - y * w), 2 * (y * z + x * w), size() - 2 * (x * x + y * y)}}};
}

int Rotation::widest() const {
  int most = 0;
  for (const auto& row : matrix()) most = std::max(most, std::abs(row[0]) + std::abs(row[1]) + std::abs(row[2]));
  return most;
}

std::array<Rational, 3> rotated(const Change& change, const Vector3& v) {
  const auto rows = rotation_of(change).matrix();
  std::array<Rational, 3> result;
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = Rational(rows[i][0]) * Rational(v[0]) + Rational(rows[i][1]) * Rational(v[1]) +
                Rational(rows[i][2]) * Rational(v[2]);
  return result;
}

Questions rotated(const Trial& trial, const Subject& subject) {
  Query other = trial.query;
  const Rotation& rotation = rotation_of(trial.change);
  bool exact = true;
  const auto times = [&](double& x, int by) { exact = put(x, Rational(by) * Rational(x), subject.range) && exact; };
  for_each_shape(other, [&]<class Shape>(Shape& shape) {
    for_each_field(shape, [&]<class Value>(const auto& field, Value& value) {
      if constexpr (std::same_as<Value, Quaternion>) {
        Quaternion by{};
        std::copy(rotation.by.begin(), rotation.by.end(), by.begin());
        exact = turn(value, by, subject.range) && exact;
      } else if (field.kind == FieldKind::length || field.kind == FieldKind::offset) {
        // A ray's length counts its direction; a plane's offset is a length times its normal's.
        const int size = rotation.size();
        const int by = field.kind == FieldKind::offset ? size * size : std::derived_from<Shape, Ray> ? 1 : size;
        for_each_number_in(value, [&](double& x) { times(x, by); });
      } else {
        for_each_vector(value, [&](Vector3& v) {
          const auto wanted = rotated(trial.change, v);
          for (std::size_t axis = 0; axis < 3; ++axis)
            exact = put(v[static_cast<Eigen::Index>(axis)], wanted[axis], subject.range) && exact;
        });
      }
    });
  });
  times(other.distances.alarm, rotation.size());
  times(other.distances.contact, rotation.size());
  return exact ? Questions{trial.query, other} : Questions{};
}

namespace {

bool is_reflection(const Change& change) {
  const auto image = [&](int axis) { return turned(change, Vector3::Unit(axis)); };
  return image(0).cross(image(1)).dot(image(2)) < 0;
}

}  // namespace

Outcome check_turned(const Case& c) {
  if (c.contact(0) == nullptr) return compared(c, nullptr, {});
  ContactClaim wanted = carried_over(*c.contact(0), [&](const Vector3& v) { return turned(c.trial.change, v); });
  // The normal of a crossing goes by the order of the vertices, which a reflection turns round.
  if (is_crossing(c.queries[0].pair) && wanted.normal && is_reflection(c.trial.change))
    *wanted.normal = -*wanted.normal;
  if (coincident(c, 0)) return compared(c, &wanted, {Field::value});
  return compared(c, &wanted, {Field::normal, Field::value, Field::point1, Field::point2, Field::point});
}

namespace {

/// A plane moves by its offset; whether exactly.
bool moved_planes(const Range& range, Query& query, int axis, double shift) {
  bool exact = true;
  for_each_shape(query, [&]<class Shape>(Shape& shape) {
    if constexpr (std::same_as<Shape, Plane>) {
      const double way = shape.normal[axis] * shift;
      if (shape.normal[axis] == 0) return;
      // What is so small may have lost digits that no double holds.
      if (std::fma(shape.normal[axis], shift, -way) != 0 || !range.contains(way) || std::abs(way) < 0x1p-900)
        return void(exact = false);
      const auto sum = exact_sum(range, shape.offset, way);
      exact = sum.has_value();
      if (sum) shape.offset = *sum;
    }
  });
  return exact;
}

}  // namespace

Questions translated(const Trial& trial, const Subject& subject) {
  Query other = trial.query;
  bool moved = false;
  for (int axis = 0; axis < 3; ++axis) {
    // Steps of the grid that the coordinates of this axis lie on, at most 2^20 of them.
    const int steps = trial.change.steps[static_cast<std::size_t>(axis)];
    if (steps == 0) continue;
    int grid = subject.range.top + 1;
    for_each_point(other, [&](const Vector3& v) { grid = v[axis] == 0 ? grid : std::min(grid, last_digit(v[axis])); });
    if (grid > subject.range.top) grid = std::clamp(0, subject.range.bottom, subject.range.top);
    const double shift = std::ldexp(static_cast<double>(steps), grid + trial.change.choice % 20);
    bool exact = true;
    Query candidate = other;
    for_each_point(candidate, [&](Vector3& v) {
      const auto sum = exact_sum(subject.range, v[axis], shift);
      exact = exact && sum.has_value();
      if (sum) v[axis] = *sum;
    });
    exact = exact && moved_planes(subject.range, candidate, axis, shift);
    if (exact) other = candidate;
    moved = moved || exact;
  }
  return moved ? Questions{trial.query, other} : Questions{};
}

Outcome check_translated(const Case& c) {
  const Outcome outcome = compared(c, c.contact(0), {Field::normal, Field::value});
  if (outcome.kind != Outcome::Kind::holds || c.contact(0) == nullptr || c.contact(1) == nullptr) return outcome;
  if (coincident(c, 0)) return outcome;
  // Points move along, as exact reals.
  const Vector3 from = first_vector(c.queries[0]);
  const Vector3 to = first_vector(c.queries[1]);
  const auto check = [&](const std::optional<Vector3>& before, const std::optional<Vector3>& after, Field field) {
    if (!c.subject.claims(field) || !before || !after || !before->allFinite() || !after->allFinite()) return Outcome{};
    const Rational error = allowance(c, 0, field) + allowance(c, 1, field);
    for (int axis = 0; axis < 3; ++axis) {
      const Rational shift = Rational(to[axis]) - Rational(from[axis]);
      if (CGAL::abs(Rational((*after)[axis]) - Rational((*before)[axis]) - shift) > error)
        return Outcome::violated(std::string(name(field)) + " " + text(*before) + " moved to " + text(*after) +
                                 ", and not with its shapes");
    }
    return Outcome{};
  };
  for (const auto& [member, field] : {std::pair{&ContactClaim::point1, Field::point1},
                                      {&ContactClaim::point2, Field::point2},
                                      {&ContactClaim::point, Field::point}})
    if (Outcome moved = check(c.contact(0)->*member, c.contact(1)->*member, field); moved.kind != Outcome::Kind::holds)
      return moved;
  return outcome;
}

Questions scaled(const Trial& trial, const Subject& subject) {
  // The drawn exponent brought to where every number stays in the range without rounding.
  int least = -5000;
  int most = 5000;
  for_each_number(trial.query, [&](const std::string&, double x) {
    if (x == 0) return;
    const int last = subject.range.least > 0 ? std::ilogb(x) : last_digit(x);
    least = std::max(least, subject.range.bottom - last);
    most = std::min(most, subject.range.top - std::ilogb(x));
  });
  if (least == -5000 || least > most) return {};
  const int exponent = std::clamp(trial.change.exponent, least, most);
  if (exponent == 0) return {};
  Query other = trial.query;
  for_each_field(other, [&](const std::string&, auto& value, FieldKind kind) {
    if (!has_free_length(kind)) for_each_number_in(value, [&](double& x) { x = std::ldexp(x, exponent); });
  });
  return {trial.query, other};
}

Outcome check_scaled(const Case& c) {
  if (c.contact(0) == nullptr) return compared(c, nullptr, {});
  int exponent = 0;
  std::vector<double> before;
  for_each_number(c.queries[0], [&](const std::string&, double x) { before.push_back(x); });
  std::size_t i = 0;
  for_each_number(c.queries[1], [&](const std::string&, double x) {
    if (x != 0) exponent = std::ilogb(x) - std::ilogb(before[i]);
    ++i;
  });
  ContactClaim wanted = *c.contact(0);
  const auto by_exponent = [&](double& x) { x = std::ldexp(x, exponent); };
  for (auto* v : {&wanted.point1, &wanted.point2, &wanted.point})
    if (*v)
      for (int axis = 0; axis < 3; ++axis) by_exponent((**v)[axis]);
  if (wanted.value) by_exponent(*wanted.value);
  if (coincident(c, 0)) return compared(c, &wanted, {Field::value}, exponent);
  return compared(c, &wanted, {Field::normal, Field::value, Field::point1, Field::point2, Field::point}, exponent);
}

Questions point_box(const Trial& trial, const Subject&) {
  Query point = trial.query;
  auto& [ball, box] = std::get<BallAndBox>(point.shapes);
  box.max = box.min;
  return {point, {Pair::sphere_sphere, Balls{ball, {box.min, 0}}, point.distances}};
}

namespace {

/// The orders of three vertices but the one they are in: two that go round, then three that exchange two.
constexpr std::array<std::array<std::size_t, 3>, 5> kOrders{{{1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}}};
std::size_t order_of(const Change& change) { return static_cast<std::size_t>(change.choice) % kOrders.size(); }

/// Half way between two points where that is exact, else the first of them.
Vector3 between(const Range& range, const Vector3& x, const Vector3& y) {
  Vector3 middle;
  for (int axis = 0; axis < 3; ++axis) {
    const auto sum = exact_sum(range, x[axis], y[axis]);
    if (!sum || !range.contains(*sum / 2) || *sum / 2 * 2 != *sum) return x;
    middle[axis] = *sum / 2;
  }
  return middle;
}

/// The sphere that a shape without extent is.
Ball as_ball(const Ball& ball) { return ball; }
Ball as_ball(const Capsule& capsule) { return {capsule.start, capsule.radius}; }
Ball as_ball(const Triangle& triangle) { return {triangle.vertices[0], 0}; }
Ball as_ball(const Ray& ray) { return {ray.origin, 0}; }

void shrink_to_a_point(Capsule& capsule) { capsule.end = capsule.start; }
void shrink_to_a_point(Triangle& triangle) { triangle.vertices.fill(triangle.vertices[0]); }
void shrink_to_a_point(Ray& ray) { ray.length = 0; }
template <class Shape>
void shrink_to_a_point(Shape& /*shape*/) {}

/// A question of shapes without length, asked of the spheres that these are.
Query of_spheres(const Query& point) {
  Query simpler = point;
  std::visit(
      [&](const auto& shapes) {
        if constexpr (requires { as_ball(shapes.a), as_ball(shapes.b); }) {
          simpler = {Pair::sphere_sphere, Balls{as_ball(shapes.a), as_ball(shapes.b)}, point.distances};
        } else if constexpr (requires { as_ball(shapes.a), shapes.b.normal; }) {
          simpler = {Pair::sphere_plane, BallAndPlane{as_ball(shapes.a), shapes.b}, point.distances};
        }
      },
      point.shapes);
  return simpler;
}

}  // namespace

Pair pair_without_length(Pair pair) {
  const Pair simpler = of_spheres(zero_query(pair)).pair;
  return kind_of(simpler) == kind_of(pair) ? pair : simpler;
}

Questions corners_exchanged(const Trial& trial, const Subject& subject) {
  Query other = trial.query;
  const auto exchange = [&]<class Shape>(Shape& shape) {
    if constexpr (std::same_as<Shape, Capsule> || std::same_as<Shape, Line>) std::swap(shape.start, shape.end);
    if constexpr (std::same_as<Shape, Triangle>) {
      const Triangle before = shape;
      for (std::size_t i = 0; i < 3; ++i) shape.vertices[i] = before.vertices[kOrders[order_of(trial.change)][i]];
    }
    if constexpr (std::same_as<Shape, Hull>) {
      auto& vertices = shape.vertices;
      const auto first = static_cast<std::size_t>(trial.change.choice) % vertices.size();
      if (vertices.size() < kMostVertices) vertices.push_back(between(subject.range, vertices[first], vertices.back()));
      std::rotate(vertices.begin(), vertices.begin() + static_cast<std::ptrdiff_t>(first) + 1, vertices.end());
    }
  };
  for_each_shape(other, exchange);
  return {trial.query, other};
}

Outcome check_corners(const Case& c) {
  if (c.contact(0) == nullptr || coincident(c, 0)) return compared(c, nullptr, {});
  ContactClaim wanted = *c.contact(0);
  // The normal of a crossing goes by the order of the vertices.
  if (is_crossing(c.queries[0].pair) && wanted.normal && order_of(c.trial.change) >= 2)
    *wanted.normal = -*wanted.normal;
  return compared(c, &wanted, {Field::normal, Field::value, Field::point1, Field::point2, Field::point});
}

namespace {

/// The ray of a question about one that is cast.
Cast& cast_of(Query& query) {
  return std::visit(
      []<class A, class B>(Two<A, B>& shapes) -> Cast& {
        if constexpr (std::same_as<A, Cast>) return shapes.a;
        throw std::logic_error("no ray is cast");
      },
      query.shapes);
}
int lengthened_by(const Change& change) { return 1 + std::abs(change.exponent) % 40; }

}  // namespace

Questions direction_lengthened(const Trial& trial, const Subject& subject) {
  Query other = trial.query;
  Cast& ray = cast_of(other);
  const int exponent = lengthened_by(trial.change);
  bool exact = true;
  const auto by = [&](double& x, int power) {
    const double before = x;
    x = std::ldexp(x, power);
    exact = exact && subject.range.contains(x) && std::ldexp(x, -power) == before;
  };
  for (int axis = 0; axis < 3; ++axis) by(ray.direction[axis], exponent);
  by(ray.length, -exponent);
  return exact ? Questions{trial.query, other} : Questions{};
}

Outcome check_direction_lengthened(const Case& c) {
  if (c.contact(0) == nullptr || coincident(c, 0)) return compared(c, nullptr, {});
  const int exponent = -lengthened_by(c.trial.change);
  ContactClaim wanted = *c.contact(0);
  if (wanted.value) wanted.value = std::ldexp(*wanted.value, exponent);
  const Outcome outcome = compared(c, &wanted, {Field::normal, Field::point1, Field::point2, Field::point});
  if (outcome.kind != Outcome::Kind::holds || c.contact(1) == nullptr) return outcome;
  if (auto why = different_numbers(c, 0, 1, wanted, {Field::value}, exponent)) return Outcome::violated(*why);
  return outcome;
}

Questions there_and_back(const Trial& trial, const Subject& subject) {
  Query other = trial.query;
  Cast& ray = cast_of(other);
  for (int axis = 0; axis < 3; ++axis) {
    const double way = ray.length * ray.direction[axis];
    if (std::fma(ray.length, ray.direction[axis], -way) != 0 || (way != 0 && std::abs(way) < 0x1p-900)) return {};
    const auto end = exact_sum(subject.range, ray.origin[axis], way);
    if (!end) return {};
    ray.origin[axis] = *end;
  }
  ray.direction = -ray.direction;
  return {trial.query, other};
}

Outcome check_there_and_back(const Case& c) { return compared(c, nullptr, {}); }

Questions without_length(const Trial& trial, const Subject&) {
  Query point = trial.query;
  std::visit([](auto& shapes) { shrink_to_a_point(shapes.a), shrink_to_a_point(shapes.b); }, point.shapes);
  return {point, of_spheres(point)};
}

namespace {

/// Cuts a shape in two, in place and in another. Whether it is exactly both together.
bool cut(Box& box, Box& other, const Change& change, const Range& /*range*/) {
  const int axis = change.choice / 2 % 3;
  const double length = change.choice / 6 % 2 == 0 ? change.length : -change.length;
  box.max[axis] = other.min[axis] = std::clamp(length, box.min[axis], box.max[axis]);
  return true;
}
bool cut(Obb& box, Obb& other, const Change& change, const Range& range) {
  const int axis = change.choice / 2 % 3;
  Obb one = box;
  bool exact = put(one.extents[axis], Rational(box.extents[axis]) / Rational(2), range);
  Obb two = one;
  Obb way = one;
  way.extents = one.extents[axis] * Vector3::Unit(axis);
  const oracle::Point end = oracle::exact_core(way).vertices.front();
  for (int i = 0; i < 3; ++i) {
    const Rational& to = end[static_cast<std::size_t>(i)];
    exact =
        put(one.center[i], to, range) && put(two.center[i], Rational(2) * Rational(box.center[i]) - to, range) && exact;
  }
  if (exact) box = one, other = two;
  return exact;
}
template <class Long>
requires requires(Long shape) { shape.start; }
bool cut(Long& shape, Long& other, const Change& /*change*/, const Range& range) {
  shape.end = other.start = between(range, shape.start, shape.end);
  return true;
}
/// Where what is between two vertices takes the place of the one, and of the other: of a point of the whole one of both
/// has no more than half.
template <class Spanned>
requires requires(Spanned shape) { shape.vertices; }
bool cut(Spanned& shape, Spanned& other, const Change& change, const Range& range) {
  const auto first = static_cast<std::size_t>(change.choice / 2) % shape.vertices.size();
  const std::size_t second = (first + 1) % shape.vertices.size();
  shape.vertices[first] = other.vertices[second] = between(range, shape.vertices[first], shape.vertices[second]);
  return true;
}
template <class Shape>
bool cut(Shape& /*shape*/, Shape& /*other*/, const Change& /*change*/, const Range& /*range*/) {
  return false;
}

}  // namespace

Questions halves(const Trial& trial, const Subject& subject) {
  Query half = trial.query;
  Query other = trial.query;
  const auto [a, b] = two_shapes(half);
  const auto [c, d] = two_shapes(other);
  const auto in_two = [&](const auto& shape, const auto& same) {
    return std::visit(
        [&]<class Shape>(Shape* s) { return cut(*s, *std::get<Shape*>(same), trial.change, subject.range); }, shape);
  };
  const bool is_cut = trial.change.choice % 2 == 0 ? in_two(a, c) || in_two(b, d) : in_two(b, d) || in_two(a, c);
  return is_cut ? Questions{trial.query, half, other} : Questions{};
}

Outcome check_same_contact(const Case& c) {
  if (c.contact(0) == nullptr || coincident(c, 0)) return compared(c, nullptr, {});
  return compared(c, c.contact(0), {Field::normal, Field::value, Field::point1, Field::point2, Field::point});
}

Questions other_sphere_kinds(const Trial& trial, const Subject& subject) {
  Questions questions;
  for (const Pair pair : kPairs) {
    if (kind_of(pair) != kind_of(Pair::sphere_sphere) || !subject.serves_alike(pair)) continue;
    questions.push_back(trial.query);
    questions.back().pair = pair;
  }
  return questions;
}

Outcome check_sphere_kinds(const Case& c) {
  for (std::size_t j = 1; j < c.queries.size(); ++j) {
    if (auto why = different_decisions(c, 0, j)) return Outcome::violated(*why);
    if (c.contact(0) == nullptr || c.contact(j) == nullptr) continue;
    const bool centers = c.subject.info.declared.conventions.points == Points::center;
    if (auto why = different_numbers(c, 0, j, *c.contact(0), {Field::value})) return Outcome::violated(*why);
    if (coincident(c, 0)) continue;
    if (auto why = different_numbers(c, 0, j, *c.contact(0), {Field::normal, Field::point}))
      return Outcome::violated(*why);
    if (centers) continue;
    if (auto why = different_numbers(c, 0, j, *c.contact(0), {Field::point1, Field::point2}))
      return Outcome::violated(*why);
  }
  return {};
}

}  // namespace contact::proptests
