// Causes about a ray that is cast: a root that is not the first, a test that is strict, a unit that is another.
#include "oracle/diagnosis/casts_in_reals.hpp"

#include "oracle/diagnosis/formulas.hpp"
#include "oracle/truth/exact_truth.hpp"

namespace contact::oracle::formulas {
namespace {

template <class Vector>
Numbers numbers_of_cast(const Vector& v) {
  return {v[0], v[1], v[2]};
}

/// A hit is missed in some places.
Cause missed_at(std::string_view id, std::string_view sentence, std::function<bool(F)> there) {
  return decision(id, sentence, [there = std::move(there)](F f) {
    return missed_where(is_cast(f.query.pair) && f.truth->hit() && there(f), f);
  });
}
/// What is said of a cast where it hits, and no opinion on other questions.
template <class Say>
std::function<Said(F)> of_hit(Say say) {
  return [say](F f) -> Said {
    if (!is_cast(f.query.pair) || !f.truth->hit()) return std::nullopt;
    return of_cast(f.query.shapes, [&](const auto& cast) -> std::optional<Said> { return say(f, cast); })
        .value_or(Said(std::nullopt));
  };
}
/// An answer at another t.
template <class T>
Cause at_another_t(std::string_view id, std::string_view sentence, T t) {
  return {.id = id,
          .sentence = sentence,
          .normal = of_hit([t](F f, const auto& cast) -> Said {
            const auto there = t(f, cast);
            if (!there) return std::nullopt;
            const Numbers n = numbers_of_cast(cast.normal(*there));
            return std::isfinite(sum_of(n)) ? Said(n) : Said(std::nullopt);
          }),
          .point =
              [t](F f, std::size_t) {
                return of_hit([t](F g, const auto& cast) -> Said {
                  const auto there = t(g, cast);
                  return there ? Said(numbers_of_cast(cast.at(*there))) : Said(std::nullopt);
                })(f);
              },
          .value = of_hit([t](F f, const auto& cast) -> Said {
            const auto there = t(f, cast);
            return there ? Said(*there) : Said(std::nullopt);
          })};
}

bool begins_inside(F f) { return f.truth->degenerate(); }
/// Whether so little decides that the formulas below, in Real, cannot tell.
bool is_too_near(F f) {
  constexpr int kBits = 57;
  return f.slack <= loss(f, kBits) * f.condition;
}

}  // namespace

#define CONTACT_CAST(Cast, Target)                                                       \
  bool one_inside_the_other(F /*f*/, const CastAt<Target>& /*shapes*/) { return false; } \
  std::vector<Cause> wrong_about(const CastAt<Target>* /*kind*/) { return {}; }
CONTACT_CASTS(CONTACT_CAST)
#undef CONTACT_CAST

std::vector<Cause> wrong_casts() {
  using Real = long double;
  return {
      missed_at("cast-inside-missed", "a ray that begins in a shape taken for a miss", begins_inside),
      missed_at("cast-tangent-missed", "a ray that only touches what is round taken for a miss",
                [](F f) {
                  return !begins_inside(f) && CGAL::is_zero(f.truth->cast()->entry()->half2) &&
                         (std::holds_alternative<CastAt<Ball>>(f.query.shapes) ||
                          std::holds_alternative<CastAt<Capsule>>(f.query.shapes));
                }),
      missed_at("cast-culled", "a triangle hit from one side alone",
                [](F f) {
                  const auto* shapes = std::get_if<CastAt<Triangle>>(&f.query.shapes);
                  if (shapes == nullptr) return false;
                  const CastInPlain<Real, Triangle> cast(*shapes);
                  return cast.dot(cast.normal(0), cast.d) > 0;
                }),
      missed_at("cast-slab", "a ray in the plane of a face taken for a miss: 0/0 in a slab",
                [](F f) {
                  const auto* shapes = std::get_if<CastAt<Box>>(&f.query.shapes);
                  if (shapes == nullptr) return false;
                  const auto& [ray, box] = *shapes;
                  bool in_plane = false;
                  for (int axis = 0; axis < 3; ++axis)
                    in_plane = in_plane || (ray.direction[axis] == 0 &&
                                            (ray.origin[axis] == box.min[axis] || ray.origin[axis] == box.max[axis]));
                  return in_plane;
                }),
      decision("cast-without-length", "a ray taken for one without end: its length not looked at",
               [](F f) -> Said {
                 if (!is_cast(f.query.pair) || f.truth->hit()) return right_decision(f);
                 if (is_too_near(f)) return std::nullopt;
                 const auto said = of_cast(f.query.shapes, [](const auto& cast) -> std::optional<bool> {
                   const auto t = cast.first();
                   return t && *t >= 0;
                 });
                 return Said::hit(said.value_or(false));
               }),
      decision("cast-length-as-distance", "a ray's length taken for a distance, where it counts directions",
               [](F f) -> Said {
                 if (!is_cast(f.query.pair) || begins_inside(f)) return right_decision(f);
                 if (is_too_near(f)) return std::nullopt;
                 const auto said = of_cast(f.query.shapes, [](const auto& cast) -> std::optional<bool> {
                   const auto t = cast.first();
                   return t && *t >= 0 && *t * cast.speed() <= cast.length;
                 });
                 return Said::hit(said.value_or(false));
               }),
      decision("cast-behind", "what lies behind the origin counted as hit",
               [](F f) -> Said {
                 if (!is_cast(f.query.pair) || f.truth->hit()) return right_decision(f);
                 if (is_too_near(f)) return std::nullopt;
                 const auto said = of_cast(f.query.shapes, [](const auto& cast) -> std::optional<bool> {
                   const auto t = cast.first();
                   return t && *t < 0;
                 });
                 return Said::hit(said.value_or(false));
               }),
      value("cast-value-as-distance", "value is the distance along the ray, where it counts directions",
            of_hit([](F f, const auto& cast) { return Said(f.t * cast.speed()); })),
      at_another_t("cast-far-root", "the place where a ray leaves a shape taken for the one where it enters",
                   [](F f, const auto& cast) { return begins_inside(f) ? std::optional<Real>(0) : cast.last(); }),
      at_another_t("cast-inside-far-root", "from inside, the place where a ray leaves a shape",
                   [](F f, const auto& cast) { return begins_inside(f) ? cast.last() : cast.first(); }),
  };
}

}  // namespace contact::oracle::formulas
