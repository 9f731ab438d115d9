// The exact answer to a question: its decisions, its correct rounding, and what a golden file records beside it.
//
// The exact numbers themselves are in exact_truth.hpp, which few files need: it brings CGAL.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "oracle/truth/expectation.hpp"
#include "oracle/truth/query.hpp"
#include "oracle/truth/witness.hpp"

namespace contact::oracle {

class DistanceTruth;
class GapTruth;
class CrossingTruth;
class CastTruth;
struct ExactTruth;

/// Where a pair lies against a limit of its distance.
enum class Side { within = -1, at = 0, beyond = 1 };

/// What is exactly true of a question. Its exact numbers are made when one of them is first asked for, so an object is
/// one thread's at a time.
class Truth {
 public:
  /// Domain: every number of the question finite and inside the domain.
  explicit Truth(const Query& query);
  /// The same where both sides have been decided already: no exact number is made.
  Truth(const Query& query, Side alarm, Side zero) : at_alarm(alarm), at_zero(zero), query_(query) {}

  Side at_alarm;  ///< of the alarm distance
  Side at_zero;   ///< of an alarm distance of 0

  [[nodiscard]] bool hit() const { return at_alarm != Side::beyond; }
  /// Whether a contact of this pair has numbers.
  [[nodiscard]] bool has_numbers() const { return query_.has_numbers(); }
  /// Whether the pair has a distance.
  [[nodiscard]] bool has_distance() const { return query_.has_distance(); }
  /// The cores of the two shapes meet: two spheres have one centre, or a sphere's centre is in a box. False without
  /// numbers.
  [[nodiscard]] bool degenerate() const;
  /// They meet, and neither is inside the other: the normal is by agreement.
  [[nodiscard]] bool coincident() const;

  [[nodiscard]] const ExactTruth& exact() const;
  /// The exact numbers of a pair with a distance, of one without numbers, of a crossing, and of a ray that is
  /// cast; nullptr for the others.
  [[nodiscard]] const DistanceTruth* distance() const;
  [[nodiscard]] const GapTruth* gaps() const;
  [[nodiscard]] const CrossingTruth* crossing() const;
  [[nodiscard]] const CastTruth* cast() const;
  /// Those of the contact; nullptr where there is none, or it has no numbers.
  [[nodiscard]] const DistanceTruth* contact() const;
  /// Whether contact() gives some. Of a pair with a distance no exact number is made.
  [[nodiscard]] bool contact_has_numbers() const { return hit() && (has_distance() || contact() != nullptr); }

 private:
  Query query_;
  mutable std::shared_ptr<ExactTruth> exact_;
};

[[nodiscard]] inline Truth truth_of(const Query& query) { return Truth(query); }
[[nodiscard]] inline Truth truth_with(const Query& query, Side at_alarm, Side at_zero) {
  return {query, at_alarm, at_zero};
}

/// The correctly rounded answer.
[[nodiscard]] Expectation expectation(const Truth& truth, Scalar scalar);

/// (signed distance - reach) / ulp(reach) rounded to binary64. Domain: a pair with a distance.
[[nodiscard]] double margin_ulps(const Truth& truth, Scalar scalar);

/// The exact numbers that a golden file records beside an expectation.
[[nodiscard]] Witness witness(const Truth& truth, Scalar scalar);

}  // namespace contact::oracle
