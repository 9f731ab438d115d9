// From which tolerance on an engine would pass, and which questions stand in the way: docs/specification.md#tolerances.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "oracle/judge/judge.hpp"

namespace contact::tool {

/// The largest of some errors, and the question that it was made on.
struct Largest {
  double off = 0;
  std::string question;  ///< a line for `explain`

  void merge(const Largest& other);
};

/// What a tolerance must allow of one measure: as a length alone, or as a share of the scale alone. An angle has no
/// scale.
struct Need {
  Largest absolute;
  Largest relative;

  void merge(const Need& other);
};

/// The needs of a run, or of a part of one.
struct Fitness {
  using Needs = std::array<Need, oracle::kMeasures.size()>;

  Needs all;
  Needs beyond_last_bit;  ///< but for answers that are no worse than the inputs' last bit
  std::array<std::uint64_t, oracle::kMeasures.size()> last_bit{};  ///< how many of those there are
  /// And wrong decisions within the rounding of an orientation, which are left out there too.
  std::uint64_t rounded = 0;
  std::uint64_t answers = 0;
  std::uint64_t never = 0;  ///< answers that no tolerance allows
  std::string never_question;
  std::uint64_t beyond = 0;  ///< answers that the declared tolerance does not allow, and these
  /// The largest of `all` by the power of ten under the question's largest number.
  std::map<int, std::array<double, oracle::kMeasures.size()>> by_scale;

  void add(const oracle::Verdict& verdict, const Query& query, Scalar scalar);
  void merge(const Fitness& other);
};

/// floor(log10) of the largest finite number of a question in magnitude; 0 where all are 0.
[[nodiscard]] int decade_of(const Query& query);

/// "length 1e-06, relative 1e-06, angle 1e-06", and the scale where it has one.
[[nodiscard]] std::string tolerance_text(const Tolerance& tolerance);
/// Two figures, rounded up, so that what is written still passes.
[[nodiscard]] std::string rounded_up(double x);
/// What an engine would need on some questions, a line each. `scale`: how an option says that it is those alone.
[[nodiscard]] std::vector<std::string> fitness_lines(std::string_view what, std::string_view scale,
                                                     const Fitness& fitness);
/// In the place of a tolerance that nobody would state: a length beyond the scale or beyond everyday numbers, an angle
/// beyond a right one.
inline constexpr std::string_view kBeyond = "beyond";
/// The least length and the least angle of it, two figures each: "." for none.
struct Fit {
  std::string length;
  std::string angle;
};
[[nodiscard]] Fit fit_of(const Fitness& fitness);
/// A question that makes a tolerance as large as it is, as a line for `explain`.
struct InTheWay {
  std::string what;
  std::string question;
};
[[nodiscard]] std::vector<InTheWay> in_the_way(const Fitness& fitness);
/// "key":{...} of a JSON report.
[[nodiscard]] std::string fitness_json(std::string_view key, const Fitness& fitness);

/// Golden files have numbers of every size, and an engine may be fit for those alone that its users have.
inline constexpr double kEverydayFrom = 1e-4;
inline constexpr double kEverydayTo = 1e4;
inline constexpr std::string_view kEveryday = "everyday numbers, from 1e-4 to 1e4 or 0";
inline constexpr std::string_view kEverydayOption = ",min=1e-4,max=1e4";
inline constexpr std::string_view kAllNumbers = "all numbers";
[[nodiscard]] bool is_everyday(const Query& query);

}  // namespace contact::tool
