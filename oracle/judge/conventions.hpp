// What an engine declares about the meaning of its answers. The first value of each enumeration is the default.
#pragma once

#include <array>
#include <limits>
#include <string_view>

#include "oracle/judge/claim.hpp"

namespace contact {

enum class NormalDirection { first_to_second, second_to_first, none };
enum class Points { nearest_surface, center, published, midpoint, first_only, second_only, manifold, none };
enum class ValueKind { signed_distance, depth, none };
enum class Touching { closed, open };
enum class Margin { inclusive, exclusive, none };
enum class Coincident { any_unit_normal, zero_normal, no_contact };
enum class ShapesAs { given, centered };
enum class DepthOf { least, any_separating };

// The names of the values, in the order of the enumerations: the one list for files, help and documentation.
inline constexpr std::array<std::string_view, 3> kNormalDirectionNames{"first-to-second", "second-to-first", "none"};
inline constexpr std::array<std::string_view, 8> kPointsNames{"nearest_surface", "center",      "published", "midpoint",
                                                              "first_only",      "second_only", "manifold",  "none"};
inline constexpr std::array<std::string_view, 3> kValueKindNames{"signed", "depth", "none"};
inline constexpr std::array<std::string_view, 2> kTouchingNames{"closed", "open"};
inline constexpr std::array<std::string_view, 3> kMarginNames{"inclusive", "exclusive", "none"};
inline constexpr std::array<std::string_view, 3> kCoincidentNames{"any_unit_normal", "zero_normal", "no_contact"};
inline constexpr std::array<std::string_view, 2> kShapesAsNames{"given", "centered"};
inline constexpr std::array<std::string_view, 2> kDepthOfNames{"least", "any_separating"};

/// Of one contact.
inline constexpr int kMostPoints = 64;

struct Conventions {
  NormalDirection normal = NormalDirection::first_to_second;
  bool normal_unit = true;
  Points points = Points::nearest_surface;
  ValueKind value = ValueKind::signed_distance;
  bool value_less_contact = true;
  Touching touching_overlap = Touching::closed;  ///< equality at alarm 0, for the overlap claim
  Touching touching_contact = Touching::closed;  ///< equality at alarm 0, for the contact claim
  Margin margin = Margin::inclusive;             ///< equality at alarm > 0; none: alarm is not looked at
  Coincident coincident = Coincident::any_unit_normal;
  ShapesAs shapes = ShapesAs::given;  ///< centered: by centre, direction, size and ends; not_served
  int most_points = 8;                ///< of a manifold, from 1 to kMostPoints
  DepthOf depth = DepthOf::least;     ///< any_separating: of two convex shapes that overlap, along the claimed normal
  double scale_min = 0;  ///< every non-zero |input| that the engine claims to serve lies in [scale_min, scale_max]
  double scale_max = std::numeric_limits<double>::infinity();

  friend bool operator==(const Conventions&, const Conventions&) = default;
};

/// What an answer with a contact says under these conventions: both decisions, and the normal, the points and the value
/// that they speak of.
[[nodiscard]] constexpr Aspects spoken_of(const Conventions& conventions) {
  Aspects spoken{Aspect::overlap, Aspect::contact};
  if (conventions.normal != NormalDirection::none) spoken.add(Aspect::normal);
  if (conventions.points <= Points::published || conventions.points == Points::first_only) spoken.add(Aspect::point1);
  if (conventions.points <= Points::published || conventions.points == Points::second_only) spoken.add(Aspect::point2);
  if (conventions.points == Points::midpoint) spoken.add(Aspect::point);
  if (conventions.points == Points::manifold) spoken.add(Aspect::points);
  if (conventions.value != ValueKind::none) spoken.add(Aspect::value);
  return spoken;
}

/// What an engine promises in the units of whoever asks: a value or a coordinate may be off by `length` and `relative`
/// times its field's scale, a normal by `angle`, and a decision wrong within `length` and `relative` times the reach of
/// where it changes. Each is finite and >= 0.
struct Tolerance {
  double length = 0;
  double relative = 0;
  double angle = 0;      ///< radians
  double scale_min = 0;  ///< as those of Conventions: the promise is for no other questions
  double scale_max = std::numeric_limits<double>::infinity();

  friend bool operator==(const Tolerance&, const Tolerance&) = default;
};

/// Declared error bounds, in ulps of the scales of docs/specification.md#judging; 1 to 64.
struct DeclaredBounds {
  double value = 8;
  double normal = 8;
  double point = 8;

  friend bool operator==(const DeclaredBounds&, const DeclaredBounds&) = default;
};

}  // namespace contact
