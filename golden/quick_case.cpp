// The common form of a dataset's line, read in one pass (simdjson).
#include "golden/quick_case.hpp"

#include <span>

#include "formats/quick_json.hpp"
#include "golden/names.hpp"

namespace contact::golden {
namespace {

using formats::quick::read;
using formats::quick::Result;
using formats::quick::value;

/// Takes a member if its key is the next of `keys`, and counts.
template <class Member>
auto in_order(std::span<const std::string_view> keys, std::size_t& at, Member member) {
  return [keys, &at, member](simdjson::ondemand::raw_json_string key, Result<value> x) {
    return at < keys.size() && key == keys[at] && member(at++, x);
  };
}

/// An object with some of `keys` in their order, from the first on, each taken by `member` at its place. How many.
template <class Member>
std::optional<std::size_t> read_object(Result<value> node, std::span<const std::string_view> keys, Member member) {
  std::size_t at = 0;
  return formats::quick::read_object(node, in_order(keys, at, member)) ? std::optional(at) : std::nullopt;
}

constexpr std::array<std::string_view, 6> kExpectKeys{"hit", "degenerate", "normal", "point1", "point2", "value"};
constexpr std::string_view kUnique = "unique";
constexpr std::string_view kBelow = "below";
constexpr std::string_view kDepth2 = "depth2";
constexpr std::array<std::string_view, 3> kSphereWitnessKeys{"distance2", "reach", "margin_ulps"};
constexpr std::array<std::string_view, 1> kCubeWitnessKeys{"gap"};
constexpr std::array<std::string_view, 1> kCrossingKeys{"crossing"};
constexpr std::array<std::string_view, 1> kCastKeys{"t"};
constexpr std::array<std::string_view, 8> kCaseKeys{"id", "a", "b", "alarm", "contact", "flags", "expect", "exact"};

template <AShape Shape>
bool read(Result<value> node, Shape& shape) {
  const auto names = field_names_of(shape);
  return read_object(node, names, [&](std::size_t key, Result<value> x) {
           bool done = false;
           for_each_field(shape, [&](const auto& field, auto& to) {
             if (field.name == names[key]) done = read(x, to);
           });
           return done;
         }) == names.size();
}

bool read(Result<value> node, Expectation& expect, Pair pair) {
  Contact contact{};
  std::size_t keys = 0;
  const auto in_its_place = in_order(kExpectKeys, keys, [&](std::size_t key, Result<value> x) {
    switch (key) {
      case 0:
        return read(x, expect.hit);
      case 1:
        return read(x, contact.degenerate);
      case 2:
        return read(x, contact.normal);
      case 3:
        return read(x, contact.point1);
      case 4:
        return read(x, contact.point2);
      default:
        return read(x, contact.value);
    }
  });
  // `unique` stands between two others, and only where it is false.
  const auto member = [&](simdjson::ondemand::raw_json_string key, Result<value> x) {
    if (keys != 2 || !contact.unique || key != kUnique) return in_its_place(key, x);
    return read(x, contact.unique) && !contact.unique;
  };
  if (!formats::quick::read_object(node, member)) return false;
  if (!expect.hit || !has_numbers(pair)) return keys == 1;
  expect.contact = contact;
  return keys == kExpectKeys.size();
}

bool read(Result<value> node, oracle::Witness& exact, Pair pair) {
  if (!has_numbers(pair))
    return read_object(node, kCubeWitnessKeys, [&](std::size_t, Result<value> x) { return read(x, exact.gap); }) == 1;
  if (is_cast(pair))
    return read_object(node, kCastKeys, [&](std::size_t, Result<value> x) {
             bool is_null = false;
             if (x.is_null().get(is_null) != simdjson::SUCCESS) return false;
             return is_null || read(x, exact.cast.emplace());
           }) == 1;
  if (is_crossing(pair))
    return read_object(node, kCrossingKeys, [&](std::size_t, Result<value> x) {
             bool is_null = false;
             if (x.is_null().get(is_null) != simdjson::SUCCESS) return false;
             return is_null || read(x, exact.crossing.emplace());
           }) == 1;
  std::size_t keys = 0;
  const auto in_its_place = in_order(kSphereWitnessKeys, keys, [&](std::size_t key, Result<value> x) {
    return key == 2 ? read(x, exact.margin_ulps) : read(x, key == 0 ? exact.distance2 : exact.reach);
  });
  // `below` and `depth2` stand between two others, and only where they say something.
  const auto member = [&](simdjson::ondemand::raw_json_string key, Result<value> x) {
    if (keys == 1 && exact.depth2.empty() && is_convex(pair) && !has_plane(pair) && key == kDepth2)
      return read(x, exact.depth2) && !exact.depth2.empty();
    if (keys != 1 || exact.below || !has_plane(pair) || key != kBelow) return in_its_place(key, x);
    return read(x, exact.below) && exact.below;
  };
  return formats::quick::read_object(node, member) && keys == kSphereWitnessKeys.size();
}

}  // namespace

std::optional<Case> quick_case(std::string_view line, const DatasetHeader& header) {
  if (header.family == kInvalidFamily) return std::nullopt;
  std::optional<Case> found(Case{{}, zero_query(header.pair), {}, {}, std::nullopt, {}});
  Case& c = *found;
  std::size_t keys = 0;
  const auto member = [&](std::size_t key, Result<value> x) {
    switch (key) {
      case 0:
        return read(x, c.id);
      case 1:
      case 2:
        return std::visit([&](auto& shapes) { return key == 1 ? read(x, shapes.a) : read(x, shapes.b); },
                          c.query.shapes);
      case 3:
        return read(x, c.query.distances.alarm);
      case 4:
        return read(x, c.query.distances.contact);
      case 5:
        return read(x, c.flags);
      case 6:
        return read(x, c.expect, header.pair);
      default:
        return read(x, c.exact, header.pair);
    }
  };
  if (!formats::quick::read_line(line, in_order(kCaseKeys, keys, member)) || keys != kCaseKeys.size())
    return std::nullopt;
  return found;
}

}  // namespace contact::golden
