// The exact answer to a question, and its correct rounding.
#include "oracle/truth/truth.hpp"

#include <algorithm>

#include "oracle/truth/default_environment.hpp"
#include "oracle/truth/exact_truth.hpp"

namespace contact::oracle {
namespace {

const ExactTruth& made(const Query& query, std::shared_ptr<ExactTruth>& exact) {
  if (!exact) {
    const DefaultEnvironment environment;
    exact = std::make_shared<ExactTruth>(exact_truth(query.shapes, query.distances));
  }
  return *exact;
}

Meet meet(const Query& query) {
  const DefaultEnvironment environment;
  return cores_meet(query.shapes);
}

}  // namespace

Truth::Truth(const Query& query) : at_alarm(Side::at), at_zero(Side::at), query_(query) {
  std::visit(
      [&](const auto& numbers) {
        at_alarm = numbers.at_alarm();
        at_zero = numbers.at_zero();
      },
      made(query_, exact_).numbers);
}

bool Truth::degenerate() const {
  if (exact_ && has_distance()) return distance()->degenerate();
  return meet(query_) != Meet::no;
}
bool Truth::coincident() const {
  if (exact_ && has_distance()) return distance()->coincident();
  return meet(query_) == Meet::touching;
}

const ExactTruth& Truth::exact() const { return made(query_, exact_); }
const DistanceTruth* Truth::distance() const {
  return has_distance() ? std::get_if<DistanceTruth>(&exact().numbers) : nullptr;
}
const GapTruth* Truth::gaps() const { return has_numbers() ? nullptr : std::get_if<GapTruth>(&exact().numbers); }
const CrossingTruth* Truth::crossing() const {
  return is_crossing(query_.pair) ? std::get_if<CrossingTruth>(&exact().numbers) : nullptr;
}
const CastTruth* Truth::cast() const {
  return is_cast(query_.pair) ? std::get_if<CastTruth>(&exact().numbers) : nullptr;
}
const DistanceTruth* Truth::contact() const {
  if (!hit()) return nullptr;
  if (const CastTruth* c = cast()) return c->entry() ? &c->contact() : nullptr;  // a hit that is presumed
  const CrossingTruth* crossed = crossing();
  if (crossed == nullptr) return distance();
  return crossed->at() ? &crossed->contact() : nullptr;  // a hit that is presumed
}

Expectation expectation(const Truth& truth, Scalar scalar) {
  Expectation expected{truth.hit(), std::nullopt};
  if (truth.contact() == nullptr) return expected;
  const DistanceTruth& exact = *truth.contact();
  Contact contact{};
  contact.degenerate = exact.degenerate();
  contact.unique = exact.spread().empty();
  for (int axis = 0; axis < 3; ++axis) {
    contact.normal[axis] = round_to_nearest(exact.normal(axis), scalar);
    contact.point1[axis] = round_to_nearest(exact.point(0, axis, PointOn::nearest_surface), scalar);
    contact.point2[axis] = round_to_nearest(exact.point(1, axis, PointOn::nearest_surface), scalar);
  }
  contact.value = round_to_nearest(exact.value(true), scalar);
  expected.contact = contact;
  return expected;
}

double margin_ulps(const Truth& truth, Scalar scalar) {
  return round_to_nearest(truth.distance()->margin(scalar), Scalar::binary64);
}

std::vector<FieldNumber> numbers(const DistanceTruth& truth) {
  std::vector<FieldNumber> all{{"value", truth.value(true)}};
  for (int axis = 0; axis < 3; ++axis) all.push_back({"normal", truth.normal(axis)});
  for (int axis = 0; axis < 3; ++axis) all.push_back({"point1", truth.point(0, axis, PointOn::nearest_surface)});
  for (int axis = 0; axis < 3; ++axis) all.push_back({"point2", truth.point(1, axis, PointOn::nearest_surface)});
  return all;
}

std::vector<FieldDistance> rounding_distances(const Truth& truth, Scalar scalar) {
  std::vector<FieldDistance> least;
  if (truth.contact() == nullptr) return least;
  for (const auto& [field, number] : numbers(*truth.contact())) {
    const Boundary boundary = nearest_boundary(number, scalar);
    const Rational ulps = distance_in_ulps(number, boundary);
    if (CGAL::is_zero(ulps)) continue;  // a tie
    const bool first = least.empty() || least.back().field != field;
    if (!first && least.back().ulps <= ulps) continue;
    if (!first) least.pop_back();
    least.push_back({field, ulps, floor_log2(number.plus(-boundary.at)) - floor_log2(boundary.ulp)});
  }
  return least;
}

Witness witness_of(const ExactTruth& truth) {
  Witness w;
  if (const auto* distance = std::get_if<DistanceTruth>(&truth.numbers)) {
    w.distance2 = exact_string(distance->distance2());
    if (distance->overlaps()) w.depth2 = exact_string(distance->meeting().depth2);
    w.reach = exact_string(distance->reach());
    w.below = distance->below();
  } else if (const auto* crossing = std::get_if<CrossingTruth>(&truth.numbers)) {
    if (!crossing->at()) return w;
    const auto& [x, y, z] = *crossing->at();
    w.crossing = {exact_string(x), exact_string(y), exact_string(z)};
  } else if (const auto* cast = std::get_if<CastTruth>(&truth.numbers)) {
    if (cast->entry()) w.cast = {exact_string(cast->entry()->middle), exact_string(cast->entry()->half2)};
  } else {
    const auto& gap = std::get<GapTruth>(truth.numbers).gap();
    std::transform(gap.begin(), gap.end(), w.gap.begin(), exact_string);
  }
  return w;
}

Witness witness(const Truth& truth, Scalar scalar) {
  Witness w = witness_of(truth.exact());
  if (truth.has_distance()) w.margin_ulps = margin_ulps(truth, scalar);
  return w;
}

}  // namespace contact::oracle
