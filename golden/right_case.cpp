// The right case of a question, from the exact oracle; and whether a case that stands somewhere is that one.
#include "golden/right_case.hpp"

#include <fmt/format.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "golden/families.hpp"
#include "golden/flags.hpp"
#include "golden/query_id.hpp"

namespace contact::golden {
namespace {

std::string text_of(bool x) { return x ? "true" : "false"; }

/// The text of one field of an expectation, as named by first_difference.
std::string field_text(const Expectation& e, const std::string& field) {
  if (field == "hit" || field == "contact") return text_of(e.hit);
  const Contact& c = *e.contact;
  if (field == "degenerate") return text_of(c.degenerate);
  if (field == "unique") return text_of(c.unique);
  if (field == "value") return formats::number(c.value);
  const Vector3& v = field.starts_with("normal") ? c.normal : field.starts_with("point1") ? c.point1 : c.point2;
  return formats::number(v[field[field.size() - 2] - '0']);
}

/// The exact numbers of a case by their names, as texts. The binding does not compile with a member of Witness that is
/// not listed here.
std::vector<std::pair<std::string, std::string>> texts_of(const oracle::Witness& w) {
  const auto& [distance2, reach, margin_ulps, gap, below, crossing, cast, depth2] = w;
  std::vector<std::pair<std::string, std::string>> texts{{"distance2", distance2},
                                                         {"depth2", depth2},
                                                         {"below", text_of(below)},
                                                         {"reach", reach},
                                                         {"margin_ulps", formats::number(margin_ulps)}};
  const auto add = [&](std::string_view key, const auto& numbers) {
    for (std::size_t i = 0; i < numbers.size(); ++i) texts.emplace_back(fmt::format("{}[{}]", key, i), numbers[i]);
  };
  add("gap", gap);
  add("crossing", crossing.value_or(std::array<std::string, 3>{}));
  add("t", cast.value_or(std::array<std::string, 2>{}));
  return texts;
}

}  // namespace

Case make_case(const Query& query, Scalar scalar) {
  Case c{query_id(query), query, {}, {}, std::nullopt, {}};
  if (const auto error = outside_domain(query)) {
    c.flags = {std::string(kInvalidFlag)};
    c.rejected = error->field;
    return c;
  }
  const oracle::Truth truth = oracle::truth_of(query);
  c.expect = oracle::expectation(truth, scalar);
  c.exact = oracle::witness(truth, scalar);
  c.flags = flags_of(query, truth, scalar, c.expect, c.exact.margin_ulps);
  return c;
}

bool is_made(const DatasetHeader& h, std::uint64_t index, std::string_view id) {
  const Family* family = find_family(h.pair, h.family);
  return family != nullptr && (h.shard || query_id(generate_query(h.pair, *family, h.scalar, h.seed, index)) == id);
}

void check_rejection(const Case& c, const formats::Location& where) {
  const std::string field = outside_domain(c.query)->field;
  if (*c.rejected != field)
    throw formats::InputError(
        where, "expect.rejected",
        fmt::format("the file says {}, the first field outside the domain is {}", *c.rejected, field));
}

bool says(const Case& c, const Expectation& right, const oracle::Witness& exact) {
  const auto same = [](const Contact& x, const Contact& y) {
    return x.degenerate == y.degenerate && x.unique == y.unique && x.normal == y.normal && x.point1 == y.point1 &&
           x.point2 == y.point2 && x.value == y.value;
  };
  return c.expect.hit == right.hit && c.expect.contact.has_value() == right.contact.has_value() &&
         (!right.contact || same(*c.expect.contact, *right.contact)) && c.exact == exact;
}

void check_case(const Case& c, Scalar scalar, const oracle::Truth& truth, const formats::Location& where) {
  const Expectation right = oracle::expectation(truth, scalar);
  if (const auto field = first_difference(c.expect, right))
    throw formats::InputError(where, "expect." + *field,
                              fmt::format("the file says {}, the exact answer rounds to {}",
                                          field_text(c.expect, *field), field_text(right, *field)));
  const auto found = texts_of(c.exact);
  const auto expected = texts_of(oracle::witness(truth, scalar));
  const auto said = [](const std::string& text) { return text.empty() ? "nothing" : text; };
  for (std::size_t i = 0; i < found.size(); ++i)
    if (found[i] != expected[i])
      throw formats::InputError(
          where, "exact." + found[i].first,
          fmt::format("the file says {}, exact is {}", said(found[i].second), said(expected[i].second)));
}

}  // namespace contact::golden
