// What users of a field ask of an engine, in metres and radians: tolerances and exams by name, each with its reason.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "oracle/judge/conventions.hpp"
#include "oracle/truth/query.hpp"

namespace contact::tool {

struct Profile {
  std::string_view name;
  Tolerance tolerance;
  std::string_view reason;
  // An exam's questions.
  Scalar scalar;
  std::uint64_t count;                         ///< of each family
  std::span<const std::string_view> left_out;  ///< families
};

// What nobody meets who works in metres: numbers of every size, and numbers made to be hard to round.
inline constexpr std::array<std::string_view, 3> kOutOfTheWorld{"extreme_scale", "hard_to_round", "invalid"};
inline constexpr std::array<std::string_view, 1> kOutOfTheDomain{"invalid"};

inline constexpr std::array kProfiles{
    Profile{"game",
            {1e-3, 1e-5, 1e-2, 1e-4, 1e4},
            "a millimetre and half a degree are seen by nobody, and ten kilometres away binary32 knows no less than a "
            "millimetre; from a tenth of a millimetre to ten kilometres",
            Scalar::binary32,
            100,
            kOutOfTheWorld},
    Profile{"robotics",
            {1e-5, 1e-7, 1e-4, 1e-6, 1e3},
            "a tenth of a tenth of a millimetre, to which an arm repeats; from a micrometre to a kilometre",
            Scalar::binary64,
            200,
            kOutOfTheWorld},
    Profile{"metrology",
            {1e-7, 1e-12, 1e-7, 1e-9, 1e3},
            "the least that PTB's service accepts as a maximum error of fitted geometry, 1e-4 mm and 1e-7 rad; from a "
            "nanometre to a kilometre",
            Scalar::binary64,
            500,
            kOutOfTheDomain},
};
inline constexpr auto kProfileNames = [] {
  std::array<std::string_view, kProfiles.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = kProfiles[i].name;
  return names;
}();
/// Domain: one of the names.
[[nodiscard]] inline const Profile& profile_of(std::string_view name) {
  return *std::find_if(kProfiles.begin(), kProfiles.end(), [&](const Profile& one) { return one.name == name; });
}

}  // namespace contact::tool
