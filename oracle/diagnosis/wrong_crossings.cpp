// Causes about a segment that crosses a triangle: a bound forgotten, or one too many.
#include "oracle/diagnosis/formulas.hpp"

namespace contact::oracle::formulas {
namespace {

std::optional<CrossingInReals> crossing_of(F f) {
  if (const auto* ray = std::get_if<RayAndTriangle>(&f.query.shapes)) return CrossingInReals(*ray);
  if (const auto* line = std::get_if<TriangleAndLine>(&f.query.shapes)) return CrossingInReals(*line);
  return std::nullopt;
}

/// A hit where `crosses` says so of the place where the line goes through the plane, if it does.
Cause crosses_where(std::string_view id, std::string_view sentence, bool (*crosses)(const CrossingInReals&)) {
  return decision(id, sentence, [crosses](F f) {
    const auto crossing = crossing_of(f);
    if (!crossing) return right_decision(f);
    return Said::hit(crossing->through() != 0 && crosses(*crossing));
  });
}
/// A hit is missed in some places.
Cause missed_at(std::string_view id, std::string_view sentence, bool (*there)(const CrossingInReals&)) {
  return decision(id, sentence, [there](F f) {
    const auto crossing = crossing_of(f);
    return missed_where(crossing && there(*crossing), f);
  });
}
bool is_in_triangle(const CrossingInReals& x) {
  return std::min({x.inside(0, x.at), x.inside(1, x.at), x.inside(2, x.at)}) >= 0;
}
bool is_on_segment(const CrossingInReals& x) { return x.part() >= 0 && x.part() <= 1; }

}  // namespace

std::vector<Cause> wrong_crossings() {
  return {
      crosses_where("crossing-without-ends", "a segment taken for the line through it: its ends not looked at",
                    is_in_triangle),
      crosses_where("crossing-without-end", "a segment taken for one without end: only its start looked at",
                    [](const CrossingInReals& x) { return is_in_triangle(x) && x.part() >= 0; }),
      crosses_where("crossing-of-plane", "a triangle taken for its plane", is_on_segment),
      crosses_where("crossing-of-parallelogram", "a triangle taken for the parallelogram of its first two edges",
                    [](const CrossingInReals& x) {
                      const CrossingInReals::Vector far = x.v[1] + x.v[2] - x.v[0];
                      const auto inside = [&](const CrossingInReals::Vector& from, const CrossingInReals::Vector& to) {
                        return x.n.dot((to - from).cross(x.at - from)) >= 0;
                      };
                      return is_on_segment(x) && inside(x.v[0], x.v[1]) && inside(x.v[1], far) && inside(far, x.v[2]) &&
                             inside(x.v[2], x.v[0]);
                    }),
      decision("crossing-not-tested", "testIntersection says yes to every segment and triangle",
               [](F f) { return is_crossing(f.query.pair) ? Said::hit(true) : right_decision(f); }),
      missed_at("crossing-open", "a segment that ends on a triangle, or goes through its boundary, does not cross it",
                [](const CrossingInReals& x) {
                  return std::min({x.inside(0, x.at), x.inside(1, x.at), x.inside(2, x.at)}) <=
                             1e-17L * x.v[0].cwiseAbs().maxCoeff() ||
                         x.slack() <= 1e-17L * x.start.cwiseAbs().maxCoeff();
                }),
      missed_at("crossing-culled", "a triangle crossed from one side alone",
                [](const CrossingInReals& x) { return x.through() > 0; }),
      missed_at("crossing-determinant-1e-6", "a determinant below 1e-6 taken for 0, whatever the units",
                [](const CrossingInReals& x) { return std::abs(x.determinant()) < 1e-6L; }),
      missed_at("crossing-determinant-2e-16", "a determinant below 2.2e-16 taken for 0, whatever the units",
                [](const CrossingInReals& x) { return std::abs(x.determinant()) <= 0x1p-52L; }),
      {.id = "crossing-normal-against",
       .sentence = "normal turned against the segment, and not by the order of the vertices",
       .normal = [](F f) -> Said {
         const auto crossing = crossing_of(f);
         if (!crossing) return std::nullopt;
         return crossing->through() * crossing->turn > 0 ? times(-1, f.n) : f.n;
       }},
      {.id = "crossing-normal-along",
       .sentence = "normal along the segment, and not across the triangle",
       .normal = [](F f) -> Said {
         const auto crossing = crossing_of(f);
         if (!crossing) return std::nullopt;
         const CrossingInReals::Vector d = crossing->along.stableNormalized();
         return Numbers{d[0], d[1], d[2]};
       }},
      points("crossing-points-at-start", "contact points at the start of the segment",
             [](F f, std::size_t) -> Said {
               const auto crossing = crossing_of(f);
               if (!crossing) return std::nullopt;
               return Numbers{crossing->start[0], crossing->start[1], crossing->start[2]};
             }),
      value("crossing-value-along", "length along the segment for the value, which is 0",
            [](F f) -> Said {
              const auto crossing = crossing_of(f);
              if (!crossing) return std::nullopt;
              return crossing->part() * crossing->along.stableNorm();
            }),
  };
}

}  // namespace contact::oracle::formulas
