// What all right answers to a question have in common: what a test can hold an engine to that cannot ask the judge.
#pragma once

#include <string_view>
#include <vector>

#include "oracle/judge/declaration.hpp"

namespace contact::oracle {

/// A number in binary64, and how far from it one that the judge accepts may be, both rounded up.
struct Near {
  double expected;
  double allowed;
};

struct Certain {
  std::string_view left_out;  ///< why nothing can be said, or empty
  bool hit = false;
  // Of a hit with numbers:
  std::vector<Near> numbers;     ///< of point1, point2, point and value, as far as they are claimed
  std::vector<Vector3> normals;  ///< those that are right; none: any unit vector may be
  double normal_allowed = 0;     ///< how far a normal may be from one of them, as compares_directions says
};

/// What an engine that declares this must answer, at the level `bounded` or within the declared tolerance. Where many
/// points are right, a coordinate may lie anywhere between the least and the largest of them. So whatever the judge
/// accepts agrees with it, and not all that agrees with it is right.
///
/// With a tolerance some questions are left out, as either decision is right there; and normals and points at which the
/// answer jumps (docs/specification.md#where-the-answer-jumps) are found by asking about shapes that are moved by some
/// tolerances: they may be those of a moved one too.
[[nodiscard]] Certain certain(const Query& query, const Declaration& declared);

/// Whether claimed normals are divided by their length first, so that the length of the difference counts. Else the
/// components are compared as they are.
[[nodiscard]] bool compares_directions(const Declaration& declared);
/// By how much the length of a claimed normal may differ from 1, where several normals or directions are compared;
/// infinite where it says nothing.
[[nodiscard]] double unit_allowed(const Declaration& declared);

}  // namespace contact::oracle
