// An engine as an adapter sees it: a declaration and one function a question; adapter.cpp makes a contact_engine.h
// library of them. C++17, since some engines' headers are no C++20. An adapter asks its engine as any user would, and
// mends nothing of what it says.
#pragma once

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "contact/contact_engine.h"

namespace contact::adapters {

enum class Kind { sphere, box, capsule, triangle, ray, plane, line, obb, hull };

/// A shape as contact_engine.h gives it, and as most engines take it: by centre, size and direction, a ray by its ends,
/// a plane by a unit normal. Nothing is rounded: a declaration with the shapes `centered` keeps away those for which
/// one of these is no number.
struct Shape {
  Shape(Kind of, const double* x) : kind(of), numbers(x) {
    if (kind == Kind::sphere || kind == Kind::box || kind == Kind::capsule) {
      if (kind != Kind::box) radius = x[kind == Kind::sphere ? 3 : 6];
      for (int i = 0; i < 3; ++i) {
        const double way = kind == Kind::sphere ? 0 : x[3 + i] - x[i];
        center[i] = x[i] + way / 2;
        size[i] = way < 0 ? -way : way;
        half[i] = size[i] / 2;
        if (kind == Kind::capsule && way != 0) axis = i;
      }
    }
    if (kind == Kind::hull) radius = x[1];
    if (kind == Kind::obb) {
      for (int i = 0; i < 3; ++i) {
        center[i] = x[i];
        half[i] = x[7 + i];
        size[i] = 2 * half[i];
      }
      // It may have any length; its squares then stay in the range.
      double largest = 0;
      for (int i = 3; i < 7; ++i) largest = std::fmax(largest, std::fabs(x[i]));
      const int exponent = largest > 0 ? std::ilogb(largest) : 0;
      double q[4];
      for (int i = 0; i < 4; ++i) q[i] = std::ldexp(x[3 + i], -exponent);
      const double squares = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
      for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) {
          // |q|^2 R = (w^2 - v.v) + 2 v v^T + 2 w [v]
          const int third = 3 - row - column;
          const double across = row == column ? 0 : ((column - row + 3) % 3 == 1 ? -1 : 1) * q[third];
          const double same = row == column ? q[3] * q[3] - (squares - q[3] * q[3]) : 0;
          turn[row][column] = (same + 2 * (q[row] * q[column] + q[3] * across)) / squares;
        }
    }
    for (int i = 0; i < 3 && kind == Kind::ray; ++i) end[i] = x[i] + x[6] * x[3 + i];
    for (int i = 0; i < 3 && kind == Kind::line; ++i) end[i] = x[3 + i];
    for (int i = 0; i < 3 && kind == Kind::plane; ++i)
      if (x[i] != 0) {
        const double length = x[i] < 0 ? -x[i] : x[i];
        axis = i;
        normal[i] = x[i] / length;
        offset = x[3] / length;
      }
  }
  /// The rotation that takes z to the axis, of which every number is 0 or 1; none where there is no axis. Of a rotated
  /// box its own.
  [[nodiscard]] double rotation(int row, int column) const {
    return kind == Kind::obb ? turn[row][column] : row == (column + axis + 1) % 3 ? 1 : 0;
  }
  [[nodiscard]] double length() const { return size[axis]; }
  [[nodiscard]] bool is_box() const { return kind == Kind::box || kind == Kind::obb; }
  /// Where a ray or a line begins.
  [[nodiscard]] const double* start() const { return numbers; }
  /// Of a triangle, or of a hull, which has so many.
  [[nodiscard]] const double* vertex(int i) const {
    return numbers + (kind == Kind::hull ? 2 : 0) + std::ptrdiff_t{3} * i;
  }
  [[nodiscard]] int vertices() const { return kind == Kind::hull ? static_cast<int>(numbers[0]) : 3; }

  Kind kind;
  const double* numbers;
  double center[3] = {};
  double radius = 0;
  double size[3] = {};
  double half[3] = {};
  int axis = 2;           ///< of a capsule, or of a plane's normal
  double end[3] = {};     ///< of a ray or a line
  double normal[3] = {};  ///< of a plane, which lies `offset` along it
  double offset = 0;
  double turn[3][3] = {};  ///< of a rotated box
};

/// One question: two shapes of the kinds that the pair names, and the two distances.
struct Question {
  contact_pair pair;
  Shape a;
  Shape b;
  double alarm;
  double contact;
};

/// The pairs of two bounded convex shapes that are of one kind in contact_engine.h, and those of one and a plane, as a
/// declaration lists them.
#define CONVEX_PAIRS                                                                                      \
  R"("obb_obb","sphere_obb","capsule_cube","capsule_obb","capsule_triangle","cube_obb","cube_triangle",)" \
  R"("obb_triangle","triangle_triangle")"
#define CONVEX_PLANE_PAIRS R"("cube_plane","obb_plane","triangle_plane")"
#define SOLID_HULL_PAIRS R"("sphere_hull","capsule_hull","cube_hull","obb_hull","hull_hull")"
#define HULL_PAIRS SOLID_HULL_PAIRS R"(,"triangle_hull")"
/// The same in a declaration's pair_conventions, for an engine that claims no points of a hull.
#define NO_POINTS_OF_HULLS                                                                             \
  R"("sphere_hull":{"points":"none"},"capsule_hull":{"points":"none"},"cube_hull":{"points":"none"},)" \
  R"("obb_hull":{"points":"none"},"hull_hull":{"points":"none"})"

/// What is said of one question; of a hit, all that the declaration claims.
class Answer {
 public:
  Answer(const contact_answers& all, std::size_t i)
      : said_(all.said + i),
        normal_(all.normal + 3 * i),
        point1_(all.point1 + 3 * i),
        point2_(all.point2 + 3 * i),
        value_(all.value + i),
        most_points_(static_cast<std::size_t>(all.most_points)),
        point_count_(all.point_count + i),
        points_(all.points + 3 * most_points_ * i),
        depths_(all.depths + most_points_ * i) {}

  void overlap(bool yes) { say(CONTACT_SAYS_OVERLAP | (yes ? CONTACT_OVERLAPS : 0)); }
  void contact(bool yes) { say(CONTACT_SAYS_CONTACT | (yes ? CONTACT_TOUCHES : 0)); }
  /// Both: for engines whose overlap test is that they find a contact.
  void hit(bool yes) {
    overlap(yes);
    contact(yes);
  }
  template <class Vector>
  void normal(const Vector& v) {
    vector(CONTACT_NORMAL, normal_, v);
  }
  template <class Vector>
  void point1(const Vector& v) {
    vector(CONTACT_POINT1, point1_, v);
  }
  template <class Vector>
  void point2(const Vector& v) {
    vector(CONTACT_POINT2, point2_, v);
  }
  /// Where one shape crosses the other, which is on both.
  template <class Vector>
  void crossing(const Vector& v) {
    point1(v);
    point2(v);
  }
  template <class Vector>
  void midpoint(const Vector& v) {
    vector(CONTACT_MIDPOINT, point1_, v);
  }
  /// One of several points, and how deep the shapes are in each other there. Domain: no more than are declared.
  template <class Vector>
  void add_point(const Vector& v, double depth) {
    const auto k = static_cast<std::size_t>(*point_count_);
    if (k == most_points_) throw std::length_error("more points than the declaration's most_points");
    vector(CONTACT_POINTS, points_ + 3 * k, v);
    depths_[k] = depth;
    ++*point_count_;
  }
  void value(double v) {
    say(CONTACT_VALUE);
    *value_ = v;
  }
  /// Instead of an answer: the engine refuses such a shape.
  void unsupported() { say(CONTACT_UNSUPPORTED); }

 private:
  void say(int what) { *said_ |= static_cast<std::uint32_t>(what); }
  template <class Vector>
  void vector(int what, double* to, const Vector& v) {
    say(what);
    // One by one: libraries index by signed and by unsigned numbers, and a literal is either.
    to[0] = static_cast<double>(v[0]);
    to[1] = static_cast<double>(v[1]);
    to[2] = static_cast<double>(v[2]);
  }

  std::uint32_t* said_;
  double* normal_;
  double* point1_;
  double* point2_;
  double* value_;
  std::size_t most_points_;
  std::int32_t* point_count_;
  double* points_;
  double* depths_;
};

// Each adapter defines these two.

/// The engine's declaration, contact_engine_declaration().
[[nodiscard]] std::string declaration();
/// What the engine says. An exception becomes the error of this question.
void answer(const Question& question, Answer& said);

}  // namespace contact::adapters
