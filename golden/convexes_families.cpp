// The families of questions about any two convex shapes. Each is made once for all pairs: a feature of one shape faces a feature of the other.
//
// Numbers are made in double by + - * / sqrt and powers of two, and rounded to the scalar of the file, so every platform makes the same.
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "golden/making.hpp"

namespace contact::golden {
namespace convexes_families {
namespace {

/// Quaternions that turn integers to integers.
constexpr std::array<Quaternion, 8> kExactTurns{{{0, 0, 0, 1},
                                                 {1, 1, 1, 1},
                                                 {1, 0, 0, 1},
                                                 {0, -1, 0, 1},
                                                 {0, 0, 0.5, 0.5},
                                                 {0, 0, 3, 0},
                                                 {0.25, -0.25, 0.25, -0.25},
                                                 {1, 1, 0, 0}}};

double rounded(double x, Scalar scalar) {
  if (scalar == Scalar::binary64) return x;
  const double most = static_cast<double>(std::numeric_limits<float>::max());
  return static_cast<double>(static_cast<float>(std::clamp(x, -most, most)));
}
double stepped(double x, int ulps, Scalar scalar) {
  return scalar == Scalar::binary64 ? ulps_away(x, ulps) : static_cast<double>(ulps_away(static_cast<float>(x), ulps));
}
/// A question in the file's scalar; what has become 0 and must not be points along an axis.
Query settled(Query query, Scalar scalar) {
  for_each_field(query, [&](const std::string&, auto& value, FieldKind kind) {
    bool is_zero = true;
    for_each_number_in(value, [&](double& x) {
      x = rounded(x, scalar);
      is_zero = is_zero && x == 0;
    });
    bool first = true;
    if (is_zero && has_free_length(kind))
      for_each_number_in(value, [&](double& x) { x = std::exchange(first, false) ? 1 : 0; });
  });
  return query;
}

Vector3 vector(Random& random, double most) {
  const auto [x, y, z] = triple<double>(random, -most, most);
  return {x, y, z};
}
Quaternion quaternion(Random& random) {
  Quaternion q{};
  for (double& x : q) x = random.uniform(-1.0, 1.0);
  return q;
}

/// A number from `least` to 1, times 2^-from to 2^-to. (Two draws in the arguments of one call would come in the order
/// of the compiler.)
double small(Random& random, int from, int to, double least) {
  const int exponent = -random.between(from, to);
  return std::ldexp(random.uniform(least, 1.0), exponent);
}

/// How a shape is made: of ordinary numbers about a place, or of integers.
struct Making {
  Random& random;
  bool in_integers = false;
  double size = 1;

  double length() const {
    return in_integers ? static_cast<double>(random.between(1, 6)) : size * random.uniform(0.25, 1.0);
  }
  Vector3 point() const {
    if (!in_integers) return vector(random, size);
    Vector3 v;
    for (int i = 0; i < 3; ++i) v[i] = static_cast<double>(random.between(-6, 6));
    return v;
  }
  void make(Ball& ball) const { ball = {point(), length()}; }
  void make(Capsule& capsule) const { capsule = {point(), point(), length()}; }
  void make(Box& box) const {
    const Vector3 low = point();
    box.min = low;
    for (int i = 0; i < 3; ++i) box.max[i] = low[i] + length();
  }
  void make(Obb& box) const {
    box.center = point();
    box.orientation = in_integers ? kExactTurns[random.index(kExactTurns.size())] : quaternion(random);
    for (int i = 0; i < 3; ++i) box.extents[i] = length();
  }
  void make(Hull& hull) const {
    const bool is_round = !in_integers && random.chance(32);  // as many points as there may be, on a sphere
    hull.vertices.resize(is_round ? kMostVertices : in_integers ? 1 + random.index(8) : 4 + random.index(9));
    for (Vector3& v : hull.vertices) {
      v = point();
      if (is_round) v *= size / std::sqrt(std::max(v.squaredNorm(), 0x1p-20));
    }
    hull.radius = random.chance(2) ? 0 : length();
  }
  void make(Plane& plane) const { plane = {vector(random, 1), random.uniform(-1.0, 1.0)}; }
  template <class Shape>
  void make(Shape& shape) const {
    for_each_point(shape, [&](Vector3& v) { v = point(); });
  }
};

/// Moves a shape; a half-space by its offset.
template <class Shape>
void move(Shape& shape, const Vector3& by) {
  if constexpr (std::same_as<Shape, Plane>)
    shape.offset += (shape.normal[0] * by[0] + shape.normal[1] * by[1]) + shape.normal[2] * by[2];
  else
    for_each_point(shape, [&](Vector3& v) { v += by; });
}
void move_second(Query& query, const Vector3& by) {
  std::visit([&](auto* shape) { move(*shape, by); }, two_shapes(query)[1]);
}
/// The second shape where it is a half-space, else nullptr.
Plane* plane_of(Query& query) { return std::get_if<Plane>(&std::get<Convexes>(query.shapes).b.shape); }
/// Moves the second shape away; a half-space so many normals back.
void part(Query& query, double normals, const Vector3& by) {
  const Plane* plane = plane_of(query);
  move_second(query, plane != nullptr ? Vector3(-normals * plane->normal) : by);
}
/// One in five misses.
bool misses(Random& random) { return random.turn(5) == kMissing; }
/// One in five misses for certain.
void part_some(Query& query, Random& random, double normals, const Vector3& by) {
  if (!misses(random)) return;
  part(query, normals, by);
  query.distances.alarm = 0;
}

void distances(Query& query, Random& random) {
  query.distances = {any_or_none<double>(random, 1), any_or_none<double>(random, 0.5)};
}

/// Two shapes of ordinary numbers, so far from each other.
Query apart(Pair pair, Random& random, double far, double size = 1) {
  Query query = zero_query(pair);
  const Making making{random, false, size};
  for_each_shape(query, [&](auto& shape) { making.make(shape); });
  move_second(query, far * vector(random, 1));
  return query;
}

/// How far from each other, farther where one is a hull, which has a radius and many corners, or nearer where one is a triangle, which meets others seldom.
double spread(Pair pair, double of_solids) {
  if (has_hull(pair)) return of_solids * 2;
  return name(pair).find("triangle") == std::string_view::npos ? of_solids : of_solids / 2;
}

// ---- features that face each other, in integers ----

/// The vertices of a core in integers, whose boxes are turned by a quaternion of kExactTurns: what is computed is exact.
template <class Shape>
std::vector<Vector3> vertices(const Shape& shape) {
  std::vector<Vector3> all;
  for_each_point(shape, [&](const Vector3& v) { all.push_back(v); });
  return all;
}
template <class Corner>
std::vector<Vector3> corners(Corner corner) {
  std::vector<Vector3> all;
  for (int k = 0; k < 8; ++k) all.push_back(corner(Vector3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1)));
  return all;
}
std::vector<Vector3> vertices(const Box& box) {
  return corners([&](const Vector3& side) {
    Vector3 x;
    for (int i = 0; i < 3; ++i) x[i] = side[i] > 0 ? box.max[i] : box.min[i];
    return x;
  });
}
std::vector<Vector3> vertices(const Obb& box) {
  const auto& [x, y, z, w] = box.orientation;
  const double N = x * x + y * y + z * z + w * w;
  const std::array<Vector3, 3> columns{
      Vector3(w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)),
      Vector3(2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)),
      Vector3(2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z)};
  return corners([&](const Vector3& side) {
    Vector3 corner = box.center;
    for (int k = 0; k < 3; ++k) corner += (side[k] * box.extents[k] / N) * columns[static_cast<std::size_t>(k)];
    return corner;
  });
}

/// Shapes in integers, the second one beyond the first in a direction d, and so many d from it, where a corner faces a corner, or if d is an axis, a face a
/// face. Their distance is so many |d|, which is an integer.
struct Facing {
  Query query;
  double distance = 0;
  Vector3 d = Vector3::Zero();
};
Facing facing(Pair pair, Random& random, int gap) {
  Facing found{zero_query(pair)};
  const Making making{random, true};
  for_each_shape(found.query, [&](auto& shape) { making.make(shape); });
  Vector3 d = Vector3::Zero();
  double length = 1;
  if (random.chance(2)) {
    d[static_cast<Eigen::Index>(random.index(3))] = random.chance(2) ? 1 : -1;
  } else {
    const Quadruple q = quadruple(random, 2);
    for (int i = 0; i < 3; ++i) d[i] = static_cast<double>(q.delta[static_cast<std::size_t>(i)]);
    length = static_cast<double>(q.d);
  }
  found.distance = gap * length;
  found.d = d;
  const auto farthest = [](const std::vector<Vector3>& of, const Vector3& along) {
    std::pair<double, Vector3> best{along.dot(of[0]), of[0]};
    for (const Vector3& x : of)
      if (along.dot(x) > best.first) best = {along.dot(x), x};
    return best.second;
  };
  const auto both = two_shapes(found.query);
  const Vector3 from = farthest(std::visit([](auto* shape) { return vertices(*shape); }, both[0]), d) + gap * d;
  std::visit(
      [&]<class Shape>(Shape* shape) {
        if constexpr (std::same_as<Shape, Plane>)
          *shape = {-d, -d.dot(from)};
        else
          move(*shape, from - farthest(vertices(*shape), -d));
      },
      both[1]);
  return found;
}

/// The radii that a question has.
std::vector<double*> radii(Query& query) {
  std::vector<double*> all;
  for_each_shape(query, [&]<class Shape>(Shape& shape) {
    if constexpr (kHasRadius<Shape>) all.push_back(&shape.radius);
  });
  return all;
}
double sum_of_radii(Query query) {
  double sum = 0;
  for (const double* radius : radii(query)) sum += *radius;
  return sum;
}
/// Cuts them to what there is of a distance, and says what they leave.
double fit_radii(Query& query, double left) {
  for (double* radius : radii(query)) left -= (*radius = std::min(*radius, left));
  return left;
}
/// The distance of the cores, below 0 where they overlap: that of the shapes without radii.
double core_distance(Query query) {
  for (double* radius : radii(query)) *radius = 0;
  query.distances = {std::numeric_limits<double>::max(), 0};
  const auto contact = contact_of(std::get<Convexes>(query.shapes), query.distances);
  return contact ? contact->value : std::numeric_limits<double>::infinity();
}
void scale(Query& query, int exponent) {
  for_each_field(query, [&](const std::string&, auto& value, FieldKind kind) {
    if (!has_free_length(kind)) for_each_number_in(value, [&](double& x) { x = std::ldexp(x, exponent); });
  });
}

// ---- families ----

Query generic(Pair pair, Scalar scalar, Random& random) {
  Query query = apart(pair, random, random.turn(3) == 0 ? 0.25 : spread(pair, 1.5));
  distances(query, random);
  part_some(query, random, 8, {8, 1, 0});
  return settled(std::move(query), scalar);
}

/// Takes what lies nearest of the second shape, seen along d, to the next number away from the first.
void recede(Query& query, const Vector3& d, Scalar scalar) {
  Eigen::Index axis = 0;
  d.cwiseAbs().maxCoeff(&axis);
  std::visit(
      [&]<class Shape>(Shape* shape) {
        if constexpr (std::same_as<Shape, Plane>) shape->offset = stepped(shape->offset, -1, scalar);
        if constexpr (std::same_as<Shape, Box>) {
          double& side = (d[axis] > 0 ? shape->min : shape->max)[axis];
          side = stepped(side, d[axis] > 0 ? 1 : -1, scalar);
        }
        if constexpr (requires { shape->vertices; }) {
          double least = std::numeric_limits<double>::infinity();
          for (const Vector3& v : shape->vertices) least = std::min(least, d.dot(v));
          for (Vector3& v : shape->vertices)
            if (d.dot(v) == least) v[axis] = stepped(v[axis], d[axis] > 0 ? 1 : -1, scalar);
        }
        if constexpr (std::same_as<Shape, Obb>) {
          // Shorter along the axis that leads to the first shape most.
          const auto corner = vertices(*shape);
          std::array<double, 3> along{};
          for (std::size_t k = 0; k < 3; ++k)
            along[k] =
                std::abs(d.dot(corner[std::size_t{1} << k] - corner[0])) / shape->extents[static_cast<Eigen::Index>(k)];
          const auto most = std::max_element(along.begin(), along.end()) - along.begin();
          shape->extents[most] = stepped(shape->extents[most], -1, scalar);
        }
      },
      two_shapes(query)[1]);
}

Query touching(Pair pair, Scalar scalar, Random& random) {
  const bool are_round = sum_of_radii(facing(pair, random, 0).query) > 0;
  Facing found = facing(pair, random, are_round ? random.between(0, 3) : 0);
  // The radii make up the distance: the last one gets what is left.
  const double left = fit_radii(found.query, found.distance);
  const auto all = radii(found.query);
  double* last = all.empty() ? nullptr : all.back();
  if (last != nullptr) *last += left;
  found.query.distances.contact = random.chance(2) ? 0.25 : 0;
  if (misses(random)) {
    if (last != nullptr && *last > 0)
      *last = stepped(*last, -1, scalar);
    else
      recede(found.query, found.d, scalar);
  }
  return settled(std::move(found.query), scalar);
}

/// The alarm distance is what the radii leave of the distance, or a step less or more.
Query alarm_edge(Pair pair, Scalar scalar, Random& random) {
  Facing found = facing(pair, random, random.between(1, 4));
  fit_radii(found.query, found.distance - static_cast<double>(random.between(1, 3)) / 4);
  const double alarm = found.distance - sum_of_radii(found.query);
  const auto turn = random.turn(5);
  found.query.distances = {stepped(alarm,
                                   turn == kMissing ? -1
                                   : turn == 0      ? 1
                                                    : 0,
                                   scalar),
                           random.chance(2) ? static_cast<double>(random.between(0, 3)) / 4 : 0};
  return settled(std::move(found.query), scalar);
}

/// Where the distance is what alarm and radii are together, as near as numbers can say.
Query near_touching(Pair pair, Scalar scalar, Random& random) {
  Query query{};
  for (int tries = 0;; ++tries) {
    query = settled(apart(pair, random, 3), scalar);
    const double distance = core_distance(query);
    if ((!(distance > 0) || !std::isfinite(distance)) && tries < 64) continue;
    double left = std::max(distance, 0.0);
    for (double* radius : radii(query)) {
      *radius = rounded(random.chance(3) ? 0.0 : left * random.uniform(0.0, 1.0), scalar);
      left -= *radius;
    }
    query.distances.alarm = std::max(0.0, stepped(rounded(left, scalar), random.between(-1, 1), scalar));
    if (tries >= 32 || random.chance(4) || fools_plain(query, scalar)) return settled(query, scalar);
  }
}

Query deep(Pair pair, Scalar scalar, Random& random) {
  Query query = apart(pair, random, 0.25, 1);
  if (const Plane* plane = plane_of(query)) move_second(query, plane->normal * 2);
  distances(query, random);
  if (misses(random)) return settled(generic(pair, scalar, random), scalar);
  return settled(std::move(query), scalar);
}

/// Turns boxes by one of kExactTurns, and puts the second shape so that two ways out are as long, or nearly.
Query near_tied_depths(Pair pair, Scalar scalar, Random& random) {
  Facing found = facing(pair, random, 0);
  Query query = found.query;
  const auto depth = static_cast<double>(random.between(1, 3));
  Vector3 back = Vector3::Zero();
  for (int i = 0; i < 3; ++i) back[i] = found.d[i] > 0 ? -depth : found.d[i] < 0 ? depth : 0;
  move_second(query, misses(random) ? Vector3(64, 64, 64) : back);
  if (Plane* plane = plane_of(query); plane != nullptr && misses(random)) plane->offset = -128;
  std::vector<double*> numbers;
  for_each_number(query, [&](const std::string& name, double& x) {
    if (!name.starts_with("a.orientation") && !name.starts_with("b.orientation") && x != 0) numbers.push_back(&x);
  });
  if (!random.chance(3) && !numbers.empty()) {
    double& x = *numbers[random.index(numbers.size())];
    x = stepped(x, random.between(-1, 1), scalar);
  }
  return settled(std::move(query), scalar);
}

/// Both boxes turned alike, or by a little more; a capsule or a triangle along an edge.
Query parallel(Pair pair, Scalar scalar, Random& random) {
  Query query = apart(pair, random, 0.75);
  distances(query, random);
  const double off = random.chance(2) ? 0 : small(random, 4, 52, 0.0);
  Quaternion turn = random.chance(2) ? kExactTurns[random.index(kExactTurns.size())] : quaternion(random);
  Vector3 along = Vector3::Zero();
  along[static_cast<Eigen::Index>(random.index(3))] = 1;
  for_each_shape(query, [&]<class Shape>(Shape& shape) {
    if constexpr (std::same_as<Shape, Obb>) {
      shape.orientation = turn;
      turn[random.index(4)] += off;
      const auto corner = vertices(shape);
      along = corner[1] - corner[0];
    }
    if constexpr (std::same_as<Shape, Capsule>) shape.end = shape.start + along + off * vector(random, 1);
    if constexpr (requires { shape.vertices; }) shape.vertices[1] = shape.vertices[0] + along + off * vector(random, 1);
    if constexpr (std::same_as<Shape, Plane>) shape.normal = along + off * vector(random, 1);
  });
  if (misses(random)) {
    query.distances.alarm = 0;
    move_second(query, plane_of(query) != nullptr ? Vector3(-16 * along) : Vector3(16, 16, 16));
  }
  return settled(std::move(query), scalar);
}

Query flat(Pair pair, Scalar scalar, Random& random) {
  Query query = random.chance(2) ? facing(pair, random, random.between(-1, 0)).query : apart(pair, random, 0.5);
  for_each_shape(query, [&]<class Shape>(Shape& shape) {
    if (random.chance(4)) return;
    const auto axis = static_cast<Eigen::Index>(random.index(3));
    if constexpr (std::same_as<Shape, Obb>) {
      shape.extents[axis] = random.chance(3) ? std::ldexp(1.0, -random.between(20, 60)) : 0;
      if (random.chance(4)) shape.extents[(axis + 1) % 3] = 0;
    }
    if constexpr (std::same_as<Shape, Box>) {
      shape.max[axis] = shape.min[axis];
      if (random.chance(4)) shape.max[(axis + 1) % 3] = shape.min[(axis + 1) % 3];
    }
    if constexpr (std::same_as<Shape, Hull>) {
      // In a plane, on a line, in one place, or with a point that is there twice and one between others.
      const std::uint64_t how = random.index(4);
      for (Vector3& v : shape.vertices)
        for (Eigen::Index other = 0; other < 3; ++other)
          if (how < 3 && (how == 0 ? other == axis : how == 1 ? other != axis : true))
            v[other] = shape.vertices[0][other];
      shape.vertices.resize(std::min(shape.vertices.size(), kMostVertices - 2));
      shape.vertices.push_back(shape.vertices[0]);
      if (how == 3) shape.vertices.push_back(shape.vertices[0] / 2 + shape.vertices[1] / 2);
    }
    if constexpr (std::same_as<Shape, Capsule>)
      shape.end = random.chance(2) ? shape.start : shape.start + Vector3::Unit(axis);
    if constexpr (requires { shape.vertices; } && !std::same_as<Shape, Hull>)
      shape.vertices[2] = random.chance(2) ? shape.vertices[1] : shape.vertices[0] / 2 + shape.vertices[1] / 2;
  });
  distances(query, random);
  part_some(query, random, 64, {64, 64, 64});
  return settled(std::move(query), scalar);
}

/// One in the other, about one centre or nearly.
Query nested(Pair pair, Scalar scalar, Random& random) {
  Query query = zero_query(pair);
  const bool in_integers = random.chance(2);
  double size = random.chance(2) ? 0.25 : 2;
  for_each_shape(query, [&]<class Shape>(Shape& shape) {
    Making{random, in_integers, size}.make(shape);
    size = size < 1 ? 2 : 0.25;
    if constexpr (!std::same_as<Shape, Plane>) {
      Vector3 sum = Vector3::Zero();
      const auto all = vertices(shape);
      for (const Vector3& x : all) sum += x;
      move(shape, -sum / static_cast<double>(all.size()) +
                      (random.chance(2) ? Vector3::Zero().eval() : vector(random, 0.125)));
    }
  });
  part_some(query, random, 64, {64, 64, 64});
  return settled(std::move(query), scalar);
}

Query orientations(Pair pair, Scalar scalar, Random& random) {
  Query query = apart(pair, random, spread(pair, 1));
  const auto little = [&] { return small(random, 1, scalar == Scalar::binary32 ? 30 : 60, 0.5); };
  const int range = scalar == Scalar::binary32 ? 120 : 1000;
  for_each_shape(query, [&]<class Shape>(Shape& shape) {
    if constexpr (std::same_as<Shape, Obb>) {
      Quaternion& q = shape.orientation;
      switch (random.turn(7)) {
        case 0:
          q = kExactTurns[random.index(kExactTurns.size())];
          break;
        case 1:
          q = {little(), -little(), little(), 1};  // nearly not turned
          break;
        case 2:
          q = {0, 0, 1, 1 + little()};  // nearly by a quarter
          break;
        case 3:
          for (double& x : q) x = std::ldexp(x, -range);
          break;
        case 4:
          for (double& x : q) x = std::ldexp(x, range);
          break;
        case 5:
          q = {std::ldexp(1.0, -range), 0, 0, std::ldexp(1.0, range)};  // of numbers that differ as much as they can
          break;
        default:
          q[random.index(4)] = 0;
      }
    }
  });
  distances(query, random);
  part_some(query, random, 64, {64, 64, 64});
  return settled(std::move(query), scalar);
}

/// Faces that lie along each other, in numbers of which the middle of two is half way between two neighbours.
Query ties(Pair pair, Scalar scalar, Random& random) {
  Facing found = facing(pair, random, random.between(-1, 2));
  Query query = found.query;
  const double far = std::ldexp(1.0, format_of(scalar).precision);
  Vector3 by = Vector3::Constant(far);
  for (const int i : {1, 0}) by[i] *= static_cast<double>(random.between(0, 2));
  for_each_field(query, [&](const std::string&, auto& value, FieldKind kind) {
    if (kind == FieldKind::direction || kind == FieldKind::orientation) return;
    for_each_number_in(value, [&](double& x) { x *= 2; });
  });
  for_each_shape(query, [&]<class Shape>(Shape& shape) {
    move(shape, by);
    // What is odd stands between two numbers there.
    if constexpr (kHasRadius<Shape>) shape.radius = std::max(0.0, shape.radius - (random.chance(2) ? 1 : 0));
    if constexpr (std::same_as<Shape, Obb>)
      for (double& extent : shape.extents) extent -= random.chance(2) ? 1 : 0;
  });
  query.distances = {static_cast<double>(random.between(0, 8)), static_cast<double>(random.between(0, 1)) / 2};
  part_some(query, random, 4 * far, {4 * far, 0, 0});
  return settled(std::move(query), scalar);
}

Query far_from_origin(Pair pair, Scalar scalar, Random& random) {
  Query query = random.chance(2) ? generic(pair, scalar, random) : facing(pair, random, random.between(-1, 1)).query;
  Vector3 by = vector(random, 1);
  by *= std::ldexp(1.0, random.between(9, scalar == Scalar::binary32 ? 20 : 44));
  Vector3 whole;
  for (int i = 0; i < 3; ++i) whole[i] = rounded(by[i], Scalar::binary32);
  for_each_shape(query, [&](auto& shape) { move(shape, whole); });
  return settled(std::move(query), scalar);
}

Query extreme_scale(Pair pair, Scalar scalar, Random& random) {
  Query query = random.chance(2) ? generic(pair, scalar, random) : facing(pair, random, random.between(-1, 1)).query;
  const Format format = format_of(scalar);
  scale(query,
        random.chance(2) ? format.max_exponent - 12 : random.between(format.min_exponent - 8, format.min_exponent / 2));
  if (random.chance(4))
    for_each_shape(query, [&]<class Shape>(Shape& shape) {
      if constexpr (std::same_as<Shape, Plane>) shape.normal *= std::ldexp(1.0, format.min_exponent / 2);
    });
  return settled(std::move(query), scalar);
}

Query invalid(Pair pair, Scalar scalar, Random& random) {
  Query query = generic(pair, scalar, random);
  spoil(query, random);
  return query;
}

/// A row of the table. No mutant is made for one of these families alone.
constexpr Family row(std::string_view name, std::string_view reason, Query (*make)(Pair, Scalar, Random&),
                     bool outside_domain = false) {
  return {name, reason, "no mutant is made for it alone: it is where axes of SAT and features of GJK change",
          make, true,   outside_domain};
}
constexpr Family kFamilies[] = {
    row("generic", "ordinary shapes, apart and in each other", generic),
    row("touching", "a feature of one shape exactly on a feature of the other: corners, edges, faces", touching),
    row("near_touching", "as near to touching as numbers say, searched for what plain arithmetic decides wrongly",
        near_touching),
    row("alarm_edge", "exactly at an alarm distance above 0, and a step less", alarm_edge),
    row("deep", "centres close to each other: a depth as long as the shapes", deep),
    row("near_tied_depths", "two facets as deep as each other, or one ulp apart", near_tied_depths),
    row("parallel", "faces and edges along each other, exactly and nearly: the axis of two edges vanishes", parallel),
    row("flat", "boxes without thickness, needles, triangles in a line, capsules in a point", flat),
    row("nested", "one shape in the other, about one centre", nested),
    row("orientations", "quaternions that are exact, tiny, huge, nearly none, nearly a quarter turn", orientations),
    row("ties", "faces along each other whose middle is half way between two numbers", ties),
    row("far_from_origin", "far away, where coordinates are coarse", far_from_origin),
    row("extreme_scale", "the largest and the smallest numbers", extreme_scale),
    row("invalid", "numbers outside the domain", invalid, true),
};

}  // namespace
}  // namespace convexes_families

std::span<const Family> families_of(const Convexes* /*kind*/) { return convexes_families::kFamilies; }

}  // namespace contact::golden
