// What an engine said about one question, before anyone has judged it.
#pragma once

#include <optional>
#include <string>

#include "contact/geometry.hpp"

namespace contact {

/// The numbers of a claimed contact; an absent one makes no claim.
struct ContactClaim {
  std::optional<Vector3> normal;
  std::optional<Vector3> point1;
  std::optional<Vector3> point2;
  std::optional<Vector3> point;  ///< the one point of engines whose convention is `midpoint`
  std::optional<double> value;
};

struct Claim {
  enum class Status { answered, unsupported, rejected, error, timeout, crash, missing };

  Status status = Status::answered;
  std::string text;                ///< why, for every status but `answered`
  std::optional<bool> overlap;     ///< what testIntersection answers
  bool speaks_of_contact = false;  ///< whether computeIntersection's answer is claimed at all
  std::optional<ContactClaim>
      contact;  ///< the contact; with speaks_of_contact and empty, "none within the alarm distance"
};

}  // namespace contact
