// What an engine said about one question, before anyone has judged it.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "contact/geometry.hpp"

namespace contact {

/// One thing that an answer claims: a decision, or a number of the contact.
enum class Aspect { overlap, contact, normal, point1, point2, point, points, value };
/// Their names, in the order of the enumeration: the one list for files and reports.
inline constexpr std::array<std::string_view, 8> kAspectNames{"overlap", "contact", "normal", "point1",
                                                              "point2",  "point",   "points", "value"};

/// A set of aspects.
class Aspects {
 public:
  constexpr Aspects() = default;
  constexpr Aspects(std::initializer_list<Aspect> aspects) {
    for (const Aspect aspect : aspects) add(aspect);
  }
  constexpr void add(Aspect aspect) { bits_ |= bit(aspect); }
  [[nodiscard]] constexpr bool has(Aspect aspect) const { return (bits_ & bit(aspect)) != 0; }
  [[nodiscard]] constexpr bool empty() const { return bits_ == 0; }
  /// Their names, in the order of the list.
  [[nodiscard]] std::vector<std::string_view> names() const {
    std::vector<std::string_view> found;
    for (std::size_t i = 0; i < kAspectNames.size(); ++i)
      if (has(static_cast<Aspect>(i))) found.push_back(kAspectNames[i]);
    return found;
  }
  /// Those that both sets have.
  [[nodiscard]] constexpr Aspects common(const Aspects& other) const {
    Aspects both;
    both.bits_ = bits_ & other.bits_;
    return both;
  }
  /// Those of this set that `other` lacks.
  [[nodiscard]] constexpr Aspects without(const Aspects& other) const {
    Aspects rest;
    rest.bits_ = static_cast<std::uint8_t>(bits_ & ~other.bits_);
    return rest;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(bits_);
  }
  friend constexpr bool operator==(const Aspects&, const Aspects&) = default;

 private:
  static constexpr std::uint8_t bit(Aspect aspect) {
    return static_cast<std::uint8_t>(1U << static_cast<unsigned>(aspect));
  }
  static_assert(kAspectNames.size() <= 8);
  std::uint8_t bits_ = 0;
};

/// One of several points of a contact, and how deep the shapes are in each other there, along the normal.
struct ManifoldPoint {
  Vector3 at;
  double depth;
};

/// The numbers of a claimed contact; an absent one makes no claim.
struct ContactClaim {
  std::optional<Vector3> normal;
  std::optional<Vector3> point1;
  std::optional<Vector3> point2;
  std::optional<Vector3> point;  ///< the one point of engines whose convention is `midpoint`
  std::optional<double> value;
  std::vector<ManifoldPoint> points = {};  ///< of engines whose convention is `manifold`
};

struct Claim {
  enum class Status { answered, unsupported, rejected, error, timeout, crash, missing };

  /// One that is no answer, and why.
  [[nodiscard]] static Claim without(Status status, std::string text) {
    Claim claim;
    claim.status = status;
    claim.text = std::move(text);
    return claim;
  }

  Status status = Status::answered;
  std::string text;                ///< why, for every status but `answered`
  std::optional<bool> overlap;     ///< what testIntersection answers
  bool speaks_of_contact = false;  ///< whether computeIntersection's answer is claimed at all
  std::optional<ContactClaim>
      contact;  ///< the contact; with speaks_of_contact and empty, "none within the alarm distance"

  /// Drops what it says beyond these.
  void keep(const Aspects& aspects) {
    if (!aspects.has(Aspect::overlap)) overlap.reset();
    if (!aspects.has(Aspect::contact)) {
      speaks_of_contact = false;
      contact.reset();
    }
    if (!contact) return;
    if (!aspects.has(Aspect::normal)) contact->normal.reset();
    if (!aspects.has(Aspect::point1)) contact->point1.reset();
    if (!aspects.has(Aspect::point2)) contact->point2.reset();
    if (!aspects.has(Aspect::point)) contact->point.reset();
    if (!aspects.has(Aspect::points)) contact->points.clear();
    if (!aspects.has(Aspect::value)) contact->value.reset();
  }
  /// What it says anything of.
  [[nodiscard]] Aspects says() const {
    Aspects said;
    const auto add = [&](Aspect aspect, bool is_said) {
      if (is_said) said.add(aspect);
    };
    add(Aspect::overlap, overlap.has_value());
    add(Aspect::contact, speaks_of_contact);
    if (!contact) return said;
    add(Aspect::normal, contact->normal.has_value());
    add(Aspect::point1, contact->point1.has_value());
    add(Aspect::point2, contact->point2.has_value());
    add(Aspect::point, contact->point.has_value());
    add(Aspect::points, !contact->points.empty());
    add(Aspect::value, contact->value.has_value());
    return said;
  }
};

/// The names of statuses, in the order of the enumeration: the one list for files and reports.
inline constexpr std::array<std::string_view, 7> kStatusNames{"answered", "unsupported", "rejected", "error",
                                                              "timeout",  "crash",       "missing"};
[[nodiscard]] constexpr std::string_view name(Claim::Status status) {
  return kStatusNames[static_cast<std::size_t>(status)];
}

}  // namespace contact
