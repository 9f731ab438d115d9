// The right case of a question, from the exact oracle; and whether a case that stands somewhere is that one.
#include "golden/right_case.hpp"

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
  const oracle::Witness witness = oracle::witness(truth, scalar);
  const auto compare = [&](const std::string& field, const std::string& found, const std::string& expected) {
    if (found != expected)
      throw formats::InputError(where, "exact." + field, fmt::format("the file says {}, exact is {}", found, expected));
  };
  compare("distance2", c.exact.distance2, witness.distance2);
  compare("below", text_of(c.exact.below), text_of(witness.below));
  compare("reach", c.exact.reach, witness.reach);
  compare("margin_ulps", formats::number(c.exact.margin_ulps), formats::number(witness.margin_ulps));
  for (std::size_t axis = 0; axis < 3; ++axis)
    compare(fmt::format("gap[{}]", axis), c.exact.gap[axis], witness.gap[axis]);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto coordinate = [axis](const oracle::Witness& w) { return w.crossing ? (*w.crossing)[axis] : "null"; };
    compare(fmt::format("crossing[{}]", axis), coordinate(c.exact), coordinate(witness));
  }
}

}  // namespace contact::golden
