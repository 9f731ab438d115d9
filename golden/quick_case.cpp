// The common form of a dataset's line, read in one pass (simdjson).
#include "golden/quick_case.hpp"

#include <simdjson.h>

#include <span>

#include "golden/families.hpp"

namespace contact::golden {
namespace {

using simdjson::ondemand::value;
template <class T>
using Result = simdjson::simdjson_result<T>;

// Each function takes a value and says whether it was there in the common form.

bool read(Result<value> node, double& x) {
  if (node.get_double().get(x) != simdjson::SUCCESS) return false;
  if (x == 0) x = 0;  // -0 is read as +0
  return true;
}

bool read(Result<value> node, bool& x) { return node.get_bool().get(x) == simdjson::SUCCESS; }

bool read(Result<value> node, std::string& text) {
  std::string_view view;
  if (node.get_string().get(view) != simdjson::SUCCESS) return false;
  text = view;
  return true;
}

/// An array, its elements taken by `element`.
template <class Element>
bool read_array(Result<value> node, Element element) {
  simdjson::ondemand::array array;
  if (node.get_array().get(array) != simdjson::SUCCESS) return false;
  for (Result<value> each : array)
    if (each.error() != simdjson::SUCCESS || !element(each)) return false;
  return true;
}

bool read(Result<value> node, Vector3& v) {
  Eigen::Index axis = 0;
  return read_array(node, [&](Result<value> each) { return axis < 3 && read(each, v[axis++]); }) && axis == 3;
}

bool read(Result<value> node, std::array<std::string, 3>& texts) {
  std::size_t axis = 0;
  return read_array(node, [&](Result<value> each) { return axis < 3 && read(each, texts[axis++]); }) && axis == 3;
}

bool read(Result<value> node, std::vector<std::string>& texts) {
  return read_array(node, [&](Result<value> each) { return read(each, texts.emplace_back()); });
}

/// An object with some of `keys` in their order, from the first on, each taken by `member` at its place. How many.
template <class Object, class Member>
std::optional<std::size_t> read_members(Object& object, std::span<const std::string_view> keys, Member member) {
  std::size_t at = 0;
  for (Result<simdjson::ondemand::field> field : object) {
    simdjson::ondemand::raw_json_string key;
    if (at == keys.size() || field.key().get(key) != simdjson::SUCCESS || key != keys[at]) return std::nullopt;
    if (!member(at++, field.value())) return std::nullopt;
  }
  return at;
}

template <class Member>
std::optional<std::size_t> read_object(Result<value> node, std::span<const std::string_view> keys, Member member) {
  simdjson::ondemand::object object;
  if (node.get_object().get(object) != simdjson::SUCCESS) return std::nullopt;
  return read_members(object, keys, member);
}

constexpr std::array<std::string_view, 6> kExpectKeys{"hit", "degenerate", "normal", "point1", "point2", "value"};
constexpr std::array<std::string_view, 3> kSphereWitnessKeys{"distance2", "reach", "margin_ulps"};
constexpr std::array<std::string_view, 1> kCubeWitnessKeys{"gap"};
constexpr std::array<std::string_view, 8> kCaseKeys{"id", "a", "b", "alarm", "contact", "flags", "expect", "exact"};

template <DescribedShape Shape>
bool read(Result<value> node, Shape& shape) {
  return read_object(node, kFieldNames<Shape>, [&](std::size_t key, Result<value> x) {
           bool done = false;
           for_each_field(shape, [&](const auto& field, auto& to) {
             if (field.name == kFieldNames<Shape>[key]) done = read(x, to);
           });
           return done;
         }) == kFieldNames<Shape>.size();
}

bool read(Result<value> node, Expectation& expect, Pair pair) {
  Contact contact{};
  const auto keys = read_object(node, kExpectKeys, [&](std::size_t key, Result<value> x) {
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
  if (!expect.hit || !has_numbers(pair)) return keys == 1;
  expect.contact = contact;
  return keys == kExpectKeys.size();
}

bool read(Result<value> node, oracle::Witness& exact, Pair pair) {
  if (!has_numbers(pair))
    return read_object(node, kCubeWitnessKeys, [&](std::size_t, Result<value> x) { return read(x, exact.gap); }) == 1;
  return read_object(node, kSphereWitnessKeys, [&](std::size_t key, Result<value> x) {
           return key == 2 ? read(x, exact.margin_ulps) : read(x, key == 0 ? exact.distance2 : exact.reach);
         }) == kSphereWitnessKeys.size();
}

}  // namespace

std::optional<Case> quick_case(std::string& line, const DatasetHeader& header) {
  if (header.family == kInvalidFamily) return std::nullopt;
  static thread_local simdjson::ondemand::parser parser;
  if (line.capacity() < line.size() + simdjson::SIMDJSON_PADDING) line.reserve(line.size() * 2 + 512);
  simdjson::ondemand::document document;
  if (parser.iterate(simdjson::padded_string_view(line.data(), line.size(), line.capacity())).get(document) !=
      simdjson::SUCCESS)
    return std::nullopt;
  simdjson::ondemand::object object;
  if (document.get_object().get(object) != simdjson::SUCCESS) return std::nullopt;

  std::optional<Case> found(Case{{}, zero_query(header.pair), {}, {}, std::nullopt, {}});
  Case& c = *found;
  const auto keys = read_members(object, kCaseKeys, [&](std::size_t key, Result<value> x) {
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
  });
  // Nothing may follow.
  if (keys != kCaseKeys.size() || document.current_location().error() != simdjson::OUT_OF_BOUNDS) return std::nullopt;
  return found;
}

}  // namespace contact::golden
