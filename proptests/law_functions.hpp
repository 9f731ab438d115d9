// The functions that the laws are made of, by what they are about; laws.cpp puts them together.
#pragma once

#include "proptests/comparing.hpp"

namespace contact::proptests {

using Questions = std::vector<Query>;
// The kinds of functions that a Law has: what to ask, what to ask next, and whether the law holds.
using Ask = Questions(const Trial& trial, const Subject& subject);
using AskNext = Questions(const Trial& trial, const Subject& subject, const Claim& claim);
using Check = Outcome(const Case& c);

// asking_laws.cpp: whether and how an engine answers.
Ask itself, itself_if_coincident, itself_if_inside, itself_if_bad, itself_among_others, with_others;
Check check_answers, check_survives_bad_input, check_refuses_bad_input, check_repeatable, check_batch;

// decision_laws.cpp: hits and misses.
Ask touching, at_the_alarm_distance, each_axis_alone, one_inside_the_other, alarm_grown;
/// Whether a shape of a pair has a size of its own: all but a triangle and a line.
bool can_grow(Pair pair);
Ask size_grown, across_a_common_edge;
Check check_common_edge, check_decisions, check_touching, check_test_agrees, check_each_axis, check_grown;

// number_laws.cpp: the numbers of a contact.
Ask radius_grown, farther, other_alarm, other_contact;
Check check_coincident, check_finite, check_unit_normal, check_direction, check_own_surface, check_near_side,
    check_span, check_farther, check_lower_value, check_way_out, check_parts, check_crossing, check_larger_radius,
    check_halves, check_rotated, check_other_alarm, check_other_contact, check_correctly_rounded, check_bounds;

// derived_laws.cpp: the next question, made of the answer to the last.
AskNext onto_point, tangent_plane, cut_at_point;
Check check_onto_point, check_tangent_plane, check_cut_at_point;

// symmetry_laws.cpp: what moving, turning and scaling must do.
Ask swapped, turned, rotated;
/// A rotation by a quaternion x, y, z, w of small integers: its matrix, times the quaternion's squared length, is of
/// integers, so that a scene so many times as long is turned exactly.
struct Rotation {
  std::array<int, 4> by;
  [[nodiscard]] constexpr int size() const { return by[0] * by[0] + by[1] * by[1] + by[2] * by[2] + by[3] * by[3]; }
  [[nodiscard]] std::array<std::array<int, 3>, 3> matrix() const;  ///< times `size`
  [[nodiscard]] int widest() const;                                ///< of its rows' sums of absolute values
};
/// The one that a change says.
const Rotation& rotation_of(const Change& change);
/// A vector turned by it, and `size` times as long.
std::array<Rational, 3> rotated(const Change& change, const Vector3& v);
Ask translated, scaled, point_box, halves, corners_exchanged;
/// The pair that a pair is where its capsules, triangles and rays have no length: itself where there are none.
Pair pair_without_length(Pair pair);
Ask direction_lengthened, there_and_back, without_length, other_sphere_kinds;
Check check_swapped, check_turned, check_translated, check_scaled, check_same_contact, check_corners,
    check_direction_lengthened, check_there_and_back, check_sphere_kinds;

}  // namespace contact::proptests
