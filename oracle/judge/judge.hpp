// A claim held against the truth under an engine's conventions, field by field. docs/specification.md#judging is the
// law.
#pragma once

#include <optional>
#include <string_view>

#include "contact/contact.hpp"
#include "oracle/judge/claim.hpp"
#include "oracle/judge/declaration.hpp"
#include "oracle/judge/verdict.hpp"
#include "oracle/truth/expectation.hpp"
#include "oracle/truth/truth.hpp"

namespace contact::oracle {

class Exact;

/// Why an engine that declares this cannot be asked a question, or nothing: a number beyond its scale or its
/// tolerance's, or a box, capsule, plane or ray whose centre, size, direction or end is no number of its scalar, so
/// that whoever asks would have to round. NaN and infinities do not count.
[[nodiscard]] std::optional<std::string_view> not_served(const Query& query, const Declaration& declared);

/// Where the contact point of a sphere (0 or 1) should lie; nothing where the conventions claim none.
[[nodiscard]] std::optional<PointOn> point_of(const Conventions& conventions, const Query& query, int sphere);

/// Grades alone, or also what tolerance each number needs, which takes much longer where it is wrong.
enum class Detail { grades, needs };

/// Domain: the question is inside the domain.
/// `detail` is what is needed of the numbers.
/// `rounded` is the truth correctly rounded to the declared scalar, where that is known already: a number that equals
/// it need not be compared exactly.
[[nodiscard]] Verdict judge(const Query& query, const Truth& truth, const Claim& claim, const Declaration& declared,
                            const Expectation* rounded = nullptr, Detail detail = Detail::needs);

/// A question outside the domain: refusing it (or failing) is right, any answer is wrong.
[[nodiscard]] Verdict judge_outside_domain(const Claim& claim);

/// What a number is measured by.
struct Yardstick {
  Scalar scalar;
  const Exact& scale;  ///< its ulp is the unit of the error
  double bound;        ///< in those
  std::optional<Tolerance> tolerance{};
  Detail detail = Detail::needs;
};
/// The grade of one claimed number.
[[nodiscard]] FieldVerdict grade(double claim, const Exact& x, const Yardstick& by);

}  // namespace contact::oracle
