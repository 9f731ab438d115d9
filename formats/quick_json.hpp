// JSON in its common form, read in one pass (simdjson). Whoever finds another form asks json.hpp, which says what is
// wrong.
#pragma once

#include <simdjson.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "contact/geometry.hpp"
#include "formats/json.hpp"

namespace contact::formats::quick {

using simdjson::ondemand::value;
template <class T>
using Result = simdjson::simdjson_result<T>;

// Each function takes a value and says whether it was there in the common form.

/// Whether a number has more than 19 digits from the first that is not 0. simdjson 3.0.1 counts the point of 0.1234 as
/// one of the zeros before them, and reads 0. and 20 digits as another number.
inline bool has_too_many_digits(std::string_view number) {
  constexpr std::size_t kShortest = 22;  // 0. and 20 digits
  if (number.size() < kShortest) return false;
  number = number.substr(0, number.find_first_of("eE"));
  number.remove_prefix(std::min(number.find_first_of("123456789"), number.size()));
  return std::count_if(number.begin(), number.end(), [](char c) { return c >= '0' && c <= '9'; }) > 19;
}

inline bool read(Result<value> node, double& x) {
  value number;
  if (node.get(number) != simdjson::SUCCESS || has_too_many_digits(number.raw_json_token())) return false;
  if (number.get_double().get(x) != simdjson::SUCCESS) return false;
  if (x == 0) x = 0;  // -0 is read as +0
  return true;
}

inline bool read(Result<value> node, bool& x) { return node.get_bool().get(x) == simdjson::SUCCESS; }
inline bool read(Result<value> node, std::uint64_t& n) { return node.get_uint64().get(n) == simdjson::SUCCESS; }

inline bool read(Result<value> node, std::string& text) {
  std::string_view view;
  if (node.get_string().get(view) != simdjson::SUCCESS) return false;
  // Whether other characters are shown as they are, the careful reader knows.
  if (!std::all_of(view.begin(), view.end(), [](char c) { return c >= 0x20 && c < 0x7f; })) return false;
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

inline bool read(Result<value> node, Vector3& v) {
  Eigen::Index axis = 0;
  return read_array(node, [&](Result<value> each) { return axis < 3 && read(each, v[axis++]); }) && axis == 3;
}

/// So many of something: vectors, or texts.
template <class Element, std::size_t N>
bool read(Result<value> node, std::array<Element, N>& all) {
  std::size_t i = 0;
  return read_array(node, [&](Result<value> each) { return i < N && read(each, all[i++]); }) && i == N;
}

/// From one to as many as a hull may have vertices.
template <class Element>
bool read(Result<value> node, std::vector<Element>& all) {
  all.clear();
  return read_array(node,
                    [&](Result<value> each) { return all.size() < kMostVertices && read(each, all.emplace_back()); }) &&
         !all.empty();
}
inline bool read(Result<value> node, std::vector<std::string>& texts) {
  return read_array(node, [&](Result<value> each) { return read(each, texts.emplace_back()); });
}

/// The members of an object in the order in which they come, each taken by member(key, value).
template <class Object, class Member>
bool read_members(Object& object, Member member) {
  for (Result<simdjson::ondemand::field> field : object) {
    simdjson::ondemand::raw_json_string key;
    if (field.key().get(key) != simdjson::SUCCESS || !member(key, field.value())) return false;
  }
  return true;
}

template <class Member>
bool read_object(Result<value> node, Member member) {
  simdjson::ondemand::object object;
  return node.get_object().get(object) == simdjson::SUCCESS && read_members(object, member);
}

static_assert(Lines::kRoom >= simdjson::SIMDJSON_PADDING);

/// A line that is one object, its members taken as they come. Lines::kRoom bytes behind it can be read.
template <class Member>
bool read_line(std::string_view line, Member member) {
  static thread_local simdjson::ondemand::parser parser;
  simdjson::ondemand::document document;
  simdjson::ondemand::object object;
  return parser.iterate(simdjson::padded_string_view(line.data(), line.size(), line.size() + Lines::kRoom))
                 .get(document) == simdjson::SUCCESS &&
         document.get_object().get(object) == simdjson::SUCCESS && read_members(object, member) &&
         document.current_location().error() == simdjson::OUT_OF_BOUNDS;  // nothing follows
}

/// The same of a text, which grows by the room.
template <class Member>
bool read_line(std::string& line, Member member) {
  if (line.capacity() < line.size() + Lines::kRoom) line.reserve(line.size() * 2 + 512);
  return read_line(std::string_view(line), member);
}

}  // namespace contact::formats::quick
