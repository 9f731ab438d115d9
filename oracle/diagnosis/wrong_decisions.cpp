// Causes that decide wrongly whether two shapes are within the alarm distance.
#include "oracle/diagnosis/formulas.hpp"

namespace contact::oracle::formulas {
std::vector<Cause> wrong_decisions() {
  return {
      decision("squared-against-sum", "squared distance compared with a plain radius sum",
               of_distance([](F f) { return Said::at_most(f.D, f.radii() + f.alarm); })),
      decision("distance-against-square", "plain distance compared with the squared radius sum", of_distance([](F f) {
                 return Said::at_most(f.distance, (f.radii() + f.alarm) * (f.radii() + f.alarm));
               })),
      decision(
          "sum-of-squares", "squares of the radii summed, where the sum should be squared", of_distance([](F f) {
            return Said::at_most(f.D, dot({f.radius[0], f.radius[1], f.alarm}, {f.radius[0], f.radius[1], f.alarm}));
          })),
      decision("alarm-squared-apart", "square of the alarm distance added to the squared radius sum",
               of_distance([](F f) { return Said::at_most(f.D, f.radii() * f.radii() + f.alarm * f.alarm); })),
      decision("alarm-outside-square", "alarm distance added to the squared radius sum",
               of_distance([](F f) { return Said::at_most(f.D, f.radii() * f.radii() + f.alarm); })),
      decision("radii-multiplied", "radii multiplied, where they should be added",
               of_distance([](F f) { return Said::at_most(f.distance, f.radius[0] * f.radius[1] + f.alarm); })),
      decision("radii-subtracted", "radii subtracted, where they should be added", of_distance([](F f) {
                 return Said::at_most(f.distance, f.alarm + std::abs(f.radius[0] - f.radius[1]));
               })),
      decision("larger-radius-only", "only the larger radius counted", of_distance([](F f) {
                 return Said::at_most(f.distance, f.alarm + std::max(f.radius[0], f.radius[1]));
               })),
      decision("smaller-radius-only", "only the smaller radius counted", of_distance([](F f) {
                 return Said::at_most(f.distance, f.alarm + std::min(f.radius[0], f.radius[1]));
               })),
      decision("alarm-subtracted", "alarm distance subtracted, where it should be added",
               [](F f) { return within(f, -f.alarm); }),
      decision("contact-for-alarm", "contact distance used in place of the alarm distance",
               [](F f) { return within(f, f.contact); }),
      decision("contact-widens", "contact distance added to the alarm distance",
               [](F f) { return within(f, f.alarm + f.contact); }),
      decision("contact-narrows", "contact distance subtracted from the alarm distance",
               [](F f) { return within(f, f.alarm - f.contact); }),
      decision("larger-distance", "larger of alarm and contact distance used",
               [](F f) { return within(f, std::max(f.alarm, f.contact)); }),
      decision("alarm-capped", "alarm distance cut off at the smaller radius",
               of_distance([](F f) { return within(f, std::min(f.alarm, std::min(f.radius[0], f.radius[1]))); })),
      {.id = "edge-open",
       .sentence = "equality not counted as a hit: < in place of <=",
       .hit = [](F f) { return missed_where(f.truth->at_alarm == Side::at, f); },
       .weight = 1.02},  // of those that explain the same the commonest
      {.id = "single-decision",
       .sentence = "decisions made in single precision",
       .hit =
           [](F f) {
             if (is_decided_by_a_point(f)) return right_decision(f);
             if (f.has_distance()) return Said::hit(narrow(f.distance) <= narrow(f.radii() + f.alarm));
             bool hit = true;
             for (const std::size_t axis : kAxes)
               for (const std::size_t shape : {0U, 1U})
                 hit = hit && narrow(f.min[shape][axis]) <= narrow(narrow(f.max[other(shape)][axis]) + narrow(f.alarm));
             return Said::hit(hit);
           },
       .weight = 0.92},  // near decisions are rounded first
      decision("inside-missed", "a shape inside the other not counted as a hit",
               [](F f) { return missed_where(f.region == Region::inside, f); }),
      decision("radii-product", "squared distance compared with a product of radii", of_distance([](F f) {
                 return Said::at_most(f.D, f.radius[0] * f.radius[1] * (f.radius[0] + f.radius[1]));
               })),
      decision("oblique-missed", "hits missed where the centres differ in all three coordinates", of_distance([](F f) {
                 return missed_where(f.delta[kX] != 0 && f.delta[kY] != 0 && f.delta[kZ] != 0, f);
               })),
      decision("large-missed", "hits of spheres with a radius of 10000 and more missed",
               of_distance([](F f) { return missed_where(std::max(f.radius[0], f.radius[1]) >= 10000, f); })),
      {.id = "tolerance-of-coordinates",
       .sentence = "a tolerance of a millionth of the largest coordinate widens the test",
       .hit =
           [](F f) {
             Real most = 0;
             for (const auto* vectors : {&f.nearest, &f.min, &f.max})
               for (const Numbers& v : *vectors) most = std::max(most, largest_of(v));
             return within(f, f.alarm + 1e-6L * most);
           },
       .weight = 0.92},  // near decisions are rounded first
      decision("inverted", "hit and miss exchanged", [](F f) { return Said::hit(!f.truth->hit()); }),
      decision("always-hit", "always answers hit", [](F) { return Said::hit(true); }),
      decision("never-hit", "never answers hit", [](F) { return Said::hit(false); }),
      {.id = "coordinate-sum",
       .sentence = "sum of the coordinate differences used as the distance",
       .hit = of_distance([](F f) { return Said::at_most(sum_of(f.delta), f.radii() + f.alarm); }),
       .value = [](F f) { return sum_of(f.delta) - f.radii() - f.contact; }},
      {.id = "largest-coordinate",
       .sentence = "largest coordinate difference used as the distance",
       .hit = of_distance([](F f) { return Said::at_most(largest_of(f.delta), f.radii() + f.alarm); }),
       .value = [](F f) { return largest_of(f.delta) - f.radii() - f.contact; }},
      decision("one-axis-enough", "one axis of overlap taken for all three",
               [](F f) {
                 if (is_decided_by_a_point(f)) return right_decision(f);
                 Real least = kInfinity;
                 for (const std::size_t axis : kAxes)
                   least = std::min(least, f.has_distance() ? std::abs(f.delta[axis]) - f.radii() : f.gap(axis));
                 return Said::at_most(least, f.alarm);
               }),
  };
  // No leak: the vector owns its functions, copied into it out of the list, and the list owns its own.
  // NOLINTNEXTLINE(clang-analyzer-cplusplus.NewDeleteLeaks)
}

}  // namespace contact::oracle::formulas
