// What an engine should have claimed: the truth under its conventions.
#include "oracle/judge/right_claim.hpp"

#include <bit>
#include <cstdint>

#include "oracle/judge/manifold.hpp"
#include "oracle/truth/default_environment.hpp"
#include "oracle/truth/exact_truth.hpp"

namespace contact::oracle {

bool expected_hit(const Query& query, const Truth& truth, Touching touching, Margin margin) {
  // By the bits, for either zero: a comparison may take a subnormal number for 0.
  if (margin == Margin::none || std::bit_cast<std::uint64_t>(query.distances.alarm) << 1 == 0)
    return touching == Touching::closed ? truth.at_zero != Side::beyond : truth.at_zero == Side::within;
  return margin == Margin::inclusive ? truth.at_alarm != Side::beyond : truth.at_alarm == Side::within;
}

ContactClaim right_contact(const Query& query, const DistanceTruth& pair, const Declaration& declared) {
  const DefaultEnvironment environment;
  const Conventions& conventions = declared.conventions;
  ContactClaim contact;
  const auto vector = [&](auto exact) {
    Vector3 v;
    for (int axis = 0; axis < 3; ++axis) v[axis] = round_to_nearest(exact(axis), declared.scalar);
    return v;
  };
  Vector3 normal = vector([&](int axis) { return pair.normal(axis); });
  const bool zero = pair.coincident() && conventions.coincident == Coincident::zero_normal;
  if (zero) normal = Vector3::Zero();
  const auto point = [&](int sphere) -> std::optional<Vector3> {
    const std::optional<PointOn> on = point_of(conventions, query, sphere);
    if (!on) return std::nullopt;
    return vector([&](int axis) { return pair.point(sphere, axis, zero ? PointOn::center : *on); });
  };
  contact.point1 = point(0);
  contact.point2 = point(1);
  if (conventions.points == Points::midpoint)
    contact.point = vector([&](int axis) { return zero ? pair.point(0, axis, PointOn::center) : pair.midpoint(axis); });
  // One point will do, where the shapes are deepest in each other.
  if (conventions.points == Points::manifold && has_manifold(query.pair))
    contact.points.push_back(
        {vector([&](int axis) { return pair.point(0, axis, zero ? PointOn::center : PointOn::nearest_surface); }),
         round_to_nearest(pair.value(false).scaled(Rational(-1)), declared.scalar)});
  if (conventions.normal == NormalDirection::first_to_second) contact.normal = normal;
  if (conventions.normal == NormalDirection::second_to_first)
    contact.normal = Vector3::Zero() - normal;  // +0 where a zero is negated
  const Exact value = pair.value(conventions.value_less_contact);
  if (conventions.value != ValueKind::none)
    contact.value = round_to_nearest(
        conventions.value == ValueKind::depth && !is_cast(query.pair) ? value.scaled(Rational(-1)) : value,
        declared.scalar);
  return contact;
}

Claim right_claim(const Query& query, const Truth& truth, const Declaration& declared) {
  const DefaultEnvironment environment;
  const Conventions& conventions = declared.conventions;
  Claim claim;
  claim.overlap = expected_hit(query, truth, conventions.touching_overlap, conventions.margin);
  if (!truth.has_numbers()) return claim;
  claim.speaks_of_contact = true;
  if (!expected_hit(query, truth, conventions.touching_contact, conventions.margin)) return claim;
  if (truth.contact() == nullptr) return claim;
  const DistanceTruth& pair = *truth.contact();
  if (pair.coincident() && conventions.coincident == Coincident::no_contact) return claim;
  claim.contact = right_contact(query, pair, declared);
  return claim;
}

}  // namespace contact::oracle
