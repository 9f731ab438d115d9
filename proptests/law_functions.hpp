// The functions that the laws are made of, by what they are about; laws.cpp puts them together.
#pragma once

#include "proptests/comparing.hpp"

namespace contact::proptests {

using Questions = std::vector<Query>;

// asking_laws.cpp: whether and how an engine answers.
Questions itself(const Trial& trial, const Subject& subject);
Questions itself_if_coincident(const Trial& trial, const Subject& subject);
Questions itself_if_inside(const Trial& trial, const Subject& subject);
Questions itself_if_bad(const Trial& trial, const Subject& subject);
Questions itself_among_others(const Trial& trial, const Subject& subject);
Questions with_others(const Trial& trial, const Subject& subject);
Outcome check_answers(const Case& c);
Outcome check_survives_bad_input(const Case& c);
Outcome check_refuses_bad_input(const Case& c);
Outcome check_repeatable(const Case& c);
Outcome check_batch(const Case& c);

// decision_laws.cpp: hits and misses.
Questions touching(const Trial& trial, const Subject& subject);
Questions at_the_alarm_distance(const Trial& trial, const Subject& subject);
Questions each_axis_alone(const Trial& trial, const Subject& subject);
Questions one_inside_the_other(const Trial& trial, const Subject& subject);
Questions alarm_grown(const Trial& trial, const Subject& subject);
/// Whether a shape of a pair has a size of its own: all but a triangle and a line.
bool can_grow(Pair pair);
Questions size_grown(const Trial& trial, const Subject& subject);
Questions across_a_common_edge(const Trial& trial, const Subject& subject);
Outcome check_common_edge(const Case& c);
Outcome check_decisions(const Case& c);
Outcome check_touching(const Case& c);
Outcome check_test_agrees(const Case& c);
Outcome check_each_axis(const Case& c);
Outcome check_grown(const Case& c);

// number_laws.cpp: the numbers of a contact.
Questions radius_grown(const Trial& trial, const Subject& subject);
Questions farther(const Trial& trial, const Subject& subject);
Questions other_alarm(const Trial& trial, const Subject& subject);
Questions other_contact(const Trial& trial, const Subject& subject);
Outcome check_coincident(const Case& c);
Outcome check_finite(const Case& c);
Outcome check_unit_normal(const Case& c);
Outcome check_direction(const Case& c);
Outcome check_own_surface(const Case& c);
Outcome check_near_side(const Case& c);
Outcome check_span(const Case& c);
Outcome check_farther(const Case& c);
Outcome check_lower_value(const Case& c);
Outcome check_way_out(const Case& c);
Outcome check_parts(const Case& c);
Outcome check_crossing(const Case& c);
Outcome check_larger_radius(const Case& c);
Outcome check_halves(const Case& c);
Outcome check_rotated(const Case& c);
Outcome check_other_alarm(const Case& c);
Outcome check_other_contact(const Case& c);
Outcome check_correctly_rounded(const Case& c);
Outcome check_bounds(const Case& c);

// derived_laws.cpp: the next question, made of the answer to the last.
Questions onto_point(const Trial& trial, const Subject& subject, const Claim& claim);
Questions tangent_plane(const Trial& trial, const Subject& subject, const Claim& claim);
Questions cut_at_point(const Trial& trial, const Subject& subject, const Claim& claim);
Outcome check_onto_point(const Case& c);
Outcome check_tangent_plane(const Case& c);
Outcome check_cut_at_point(const Case& c);

// symmetry_laws.cpp: what moving, turning and scaling must do.
Questions swapped(const Trial& trial, const Subject& subject);
Questions turned(const Trial& trial, const Subject& subject);
Questions rotated(const Trial& trial, const Subject& subject);
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
Questions translated(const Trial& trial, const Subject& subject);
Questions scaled(const Trial& trial, const Subject& subject);
Questions point_box(const Trial& trial, const Subject& subject);
Questions halves(const Trial& trial, const Subject& subject);
Questions corners_exchanged(const Trial& trial, const Subject& subject);
/// The pair that a pair is where its capsules, triangles and rays have no length: itself where there are none.
Pair pair_without_length(Pair pair);
Questions direction_lengthened(const Trial& trial, const Subject& subject);
Questions there_and_back(const Trial& trial, const Subject& subject);
Questions without_length(const Trial& trial, const Subject& subject);
Questions other_sphere_kinds(const Trial& trial, const Subject& subject);
Outcome check_swapped(const Case& c);
Outcome check_turned(const Case& c);
Outcome check_translated(const Case& c);
Outcome check_scaled(const Case& c);
Outcome check_same_contact(const Case& c);
Outcome check_corners(const Case& c);
Outcome check_direction_lengthened(const Case& c);
Outcome check_there_and_back(const Case& c);
Outcome check_sphere_kinds(const Case& c);

}  // namespace contact::proptests
