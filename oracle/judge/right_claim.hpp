// What an engine should have claimed: the truth under its conventions.
#pragma once

#include "oracle/judge/claim.hpp"
#include "oracle/judge/judge.hpp"

namespace contact::oracle {

/// Whether the pair counts as hit for a claim whose meaning of touching is `touching`.
[[nodiscard]] bool expected_hit(const Query& query, const Truth& truth, Touching touching, Margin margin);

/// The claim that is right under a declaration: the truth, correctly rounded. Its normal is a unit vector, whatever is
/// declared.
[[nodiscard]] Claim right_claim(const Query& query, const Truth& truth, const Declaration& declared);
/// The numbers of that claim for a contact whose exact numbers these are, the question's or those of another right way.
[[nodiscard]] ContactClaim right_contact(const Query& query, const DistanceTruth& pair, const Declaration& declared);

}  // namespace contact::oracle
