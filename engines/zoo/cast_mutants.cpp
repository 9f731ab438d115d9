// Mistakes about a ray that is cast.
#include "engines/zoo/mutating.hpp"

namespace contact::engines {
namespace {

/// Whether `there` holds of a question about one, in wide arithmetic.
template <class There>
bool where_cast(const Query& q, There there) {
  return oracle::of_cast(q.shapes, [&](const auto& cast) -> std::optional<bool> { return there(cast); })
      .value_or(false);
}
/// A hit becomes a miss.
template <class There>
void not_hit(const Query& q, Claim& claim, There there) {
  if (is_cast(q.pair) && claim.overlap.value_or(false) && there()) decide(q, claim, false);
}
/// A miss becomes a hit.
constexpr auto also_hit = [](const Query& q, Claim& claim, auto there) {
  if (is_cast(q.pair) && !claim.overlap.value_or(true) && where_cast(q, there)) decide(q, claim, true);
};
/// An answer at another t.
constexpr auto at_another_t = [](const Query& q, Claim& claim, auto t) {
  if (!is_cast(q.pair) || !claim.contact) return;
  const auto other = oracle::of_cast(q.shapes, [&](const auto& cast) -> std::optional<ContactClaim> {
    const std::optional<Wide> there = t(cast);
    if (!there) return std::nullopt;
    const auto vector = [](const auto& v) { return Vector3(rounded(v[0]), rounded(v[1]), rounded(v[2])); };
    const Vector3 at = vector(cast.at(*there));
    return ContactClaim{vector(cast.normal(*there)), at, at, std::nullopt, rounded(*there)};
  });
  if (other && *other->value != *claim.contact->value) claim.contact = other;
};

const std::array kCasts{
    Mutant{"cast-from-inside", "a ray that begins in a shape misses it", "cast-inside-missed", nullptr,
           [](const Query& q, Claim& claim) { not_hit(q, claim, [&] { return coincident(q); }); }},
    Mutant{"cast-tangent-missed", "a ray that only touches what is round misses it", "cast-tangent-missed", nullptr,
           [](const Query& q, Claim& claim) {
             not_hit(q, claim, [&] {
               const oracle::Truth truth = oracle::truth_of(q);
               return truth.hit() && !coincident(q) && (*oracle::witness(truth, Scalar::binary64).cast)[1] == "0x0p0" &&
                      (std::holds_alternative<CastAt<Ball>>(q.shapes) ||
                       std::holds_alternative<CastAt<Capsule>>(q.shapes));
             });
           }},
    Mutant{"cast-culled", "a triangle is hit from one side alone", "cast-culled", nullptr,
           [](const Query& q, Claim& claim) {
             const auto* shapes = std::get_if<CastAt<Triangle>>(&q.shapes);
             if (shapes == nullptr) return;
             const oracle::CastInPlain<Wide, Triangle> cast(*shapes);
             not_hit(q, claim, [&] { return cast.dot(cast.normal(0), cast.d) > 0; });
           }},
    Mutant{"cast-slab", "a ray in the plane of a face misses the box: 0/0 in a slab", "cast-slab", nullptr,
           [](const Query& q, Claim& claim) {
             const auto* shapes = std::get_if<CastAt<Box>>(&q.shapes);
             if (shapes == nullptr) return;
             const auto& [ray, box] = *shapes;
             bool in_plane = false;
             for (int axis = 0; axis < 3; ++axis)
               in_plane = in_plane || (ray.direction[axis] == 0 &&
                                       (ray.origin[axis] == box.min[axis] || ray.origin[axis] == box.max[axis]));
             not_hit(q, claim, [&] { return in_plane; });
           }},
    Mutant{"cast-without-length", "a ray has no end", "cast-without-length", nullptr,
           with(also_hit, [](const auto& cast) { return cast.first().value_or(-1) >= 0; })},
    Mutant{"cast-behind", "what lies behind the origin is hit", "cast-behind", nullptr,
           with(also_hit, [](const auto& cast) { return cast.first().value_or(1) < 0; })},
    Mutant{"cast-length-as-distance", "a ray's length is a distance and does not count directions",
           "cast-length-as-distance", nullptr,
           [](const Query& q, Claim& claim) {
             if (!is_cast(q.pair) || coincident(q)) return;
             const bool hit = where_cast(q, [](const auto& cast) {
               const Wide t = cast.first().value_or(-1);
               return t >= 0 && t * cast.speed() <= cast.length;
             });
             if (hit != claim.overlap) decide(q, claim, hit);
           }},
    Mutant{"cast-value-as-distance", "the value is the distance along the ray and does not count directions",
           "cast-value-as-distance", nullptr,
           [](const Query& q, Claim& claim) {
             if (!is_cast(q.pair)) return;
             in_contact(claim, [&](ContactClaim& c) {
               c.value = oracle::of_cast(q.shapes, [&](const auto& cast) -> std::optional<double> {
                 return rounded(static_cast<Wide>(*c.value) * cast.speed());
               });
             });
           }},
    Mutant{"cast-far-root", "the answer is where the ray leaves the shape", "cast-far-root", nullptr,
           with(at_another_t,
                [](const auto& cast) -> std::optional<Wide> {
                  return cast.begins_inside() ? std::nullopt : cast.last();
                })},
    Mutant{"cast-inside-far-root", "from inside the answer is where the ray leaves the shape", "cast-inside-far-root",
           nullptr,
           with(at_another_t,
                [](const auto& cast) -> std::optional<Wide> {
                  return cast.begins_inside() ? cast.last() : std::nullopt;
                })},
};

}  // namespace

std::span<const Mutant> cast_mutants() { return kCasts; }

}  // namespace contact::engines
