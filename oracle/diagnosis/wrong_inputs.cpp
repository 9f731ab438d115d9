// Causes that read the question wrongly. Most change a number of it, and the right formulas give every field.
#include "oracle/diagnosis/formulas.hpp"

namespace contact::oracle::formulas {
namespace {

/// Takes an axis out of every decision.
void ignore(Facts& f, std::size_t axis) {
  f.delta[axis] = 0;
  for (const std::size_t shape : {0U, 1U}) {
    f.min[shape][axis] = -kInfinity;
    f.max[shape][axis] = kInfinity;
  }
  f.settle_from_delta();
}
/// Adds the coordinates of the centres on one axis.
void add_on(Facts& f, std::size_t axis) {
  f.delta[axis] = f.nearest[1][axis] + f.nearest[0][axis];
  f.settle_from_delta();
}

}  // namespace

std::vector<Cause> wrong_inputs() {
  return {
      edit("capsule-radius-missing", "the radius of a capsule never read",
           [](Facts& f) {
             std::visit(
                 [&]<class A, class B>(const Two<A, B>&) {
                   if constexpr (std::same_as<A, Capsule>) f.radius[0] = 0;
                   if constexpr (std::same_as<B, Capsule>) f.radius[1] = 0;
                 },
                 f.query.shapes);
           }),
      edit("hull-radius-missing", "the radius of a hull never read",
           [](Facts& f) {
             std::size_t which = 0;
             for_each_shape(f.query, [&]<class Shape>(const Shape& /*shape*/) {
               if constexpr (std::same_as<Shape, Hull>) f.radius[which] = 0;
               ++which;
             });
           }),
      edit("first-radius-for-both", "radius of the first sphere used for both",
           [](Facts& f) { f.radius[1] = f.radius[0]; }),
      edit("second-radius-for-both", "radius of the second sphere used for both",
           [](Facts& f) { f.radius[0] = f.radius[1]; }),
      edit("first-radius-missing", "radius of the first sphere left out", [](Facts& f) { f.radius[0] = 0; }),
      edit("second-radius-missing", "radius of the second sphere left out", [](Facts& f) { f.radius[1] = 0; }),
      edit("radii-missing", "radii left out", [](Facts& f) { f.radius = {}; }),
      edit("radii-doubled", "radii counted twice",
           [](Facts& f) {
             f.radius = {2 * f.radius[0], 2 * f.radius[1]};
           }),
      edit("radii-halved", "radii halved",
           [](Facts& f) {
             f.radius = {f.radius[0] / 2, f.radius[1] / 2};
           }),
      edit("radii-exchanged", "radii of the two spheres exchanged",
           [](Facts& f) { std::swap(f.radius[0], f.radius[1]); }),
      edit("radii-squared", "squares of the radii in place of the radii",
           [](Facts& f) {
             f.radius = {f.radius[0] * f.radius[0], f.radius[1] * f.radius[1]};
           }),
      edit("alarm-ignored", "alarm distance ignored", [](Facts& f) { f.alarm = 0; }),
      edit("alarm-doubled", "alarm distance counted twice", [](Facts& f) { f.alarm *= 2; }),
      edit("alarm-halved", "alarm distance halved", [](Facts& f) { f.alarm /= 2; }),
      edit("contact-ignored", "contact distance ignored", [](Facts& f) { f.contact = 0; }),
      edit("contact-doubled", "contact distance counted twice", [](Facts& f) { f.contact *= 2; }),
      edit("contact-halved", "contact distance halved", [](Facts& f) { f.contact /= 2; }),
      edit("contact-added", "contact distance added to the value, where it should be subtracted",
           [](Facts& f) { f.contact = -f.contact; }),
      edit("distances-exchanged", "alarm distance and contact distance exchanged",
           [](Facts& f) { std::swap(f.alarm, f.contact); }),
      edit("first-shape-twice", "first shape compared with itself",
           [](Facts& f) {
             f.nearest[1] = f.nearest[0];
             f.radius[1] = f.radius[0];
             f.min[1] = f.min[0];
             f.max[1] = f.max[0];
             f.settle();
           }),
      {.id = "delta-reversed",
       .sentence = "normal points from second to first",
       .normal = [](F f) { return where(f.has_direction(), times(-1, f.n)); }},
      {.id = "pair-swapped",
       .sentence = "answer of the swapped pair given without being swapped back",
       .normal = [](F f) { return where(f.has_direction(), times(-1, f.n)); },
       .point = [](F f, std::size_t s) { return surface(f, other(s)); }},
      edit("x-ignored", "x coordinates left out", [](Facts& f) { ignore(f, kX); }),
      edit("y-ignored", "y coordinates left out", [](Facts& f) { ignore(f, kY); }),
      edit("z-ignored", "z coordinates left out", [](Facts& f) { ignore(f, kZ); }),
      edit("x-added", "x coordinates of the centres added, where they should be subtracted",
           [](Facts& f) { add_on(f, kX); }),
      edit("y-added", "y coordinates of the centres added, where they should be subtracted",
           [](Facts& f) { add_on(f, kY); }),
      edit("z-added", "z coordinates of the centres added, where they should be subtracted",
           [](Facts& f) { add_on(f, kZ); }),
      edit("centres-added", "centres added, where they should be subtracted",
           [](Facts& f) {
             f.delta = along(f.nearest[1], 1, f.nearest[0]);
             f.settle_from_delta();
           }),
      edit("first-centre-ignored", "centre of the first sphere taken for the origin",
           [](Facts& f) {
             f.delta = f.nearest[1];
             f.settle_from_delta();
           }),
      edit("second-centre-ignored", "centre of the second sphere taken for the origin",
           [](Facts& f) {
             f.delta = times(-1, f.nearest[0]);
             f.settle_from_delta();
           }),
      edit("axes-crossed", "coordinates of different axes compared with each other",
           [](Facts& f) {
             for (const std::size_t axis : kAxes) f.delta[axis] = f.nearest[1][(axis + 1) % 3] - f.nearest[0][axis];
             std::rotate(f.min[1].begin(), f.min[1].begin() + 1, f.min[1].end());
             std::rotate(f.max[1].begin(), f.max[1].begin() + 1, f.max[1].end());
             f.settle_from_delta();
           }),
      edit("x-twice", "x coordinates used in place of the y coordinates",
           [](Facts& f) {
             f.delta[kY] = f.delta[kX];
             for (const std::size_t shape : {0U, 1U}) {
               f.min[shape][kY] = f.min[shape][kX];
               f.max[shape][kY] = f.max[shape][kX];
             }
             f.settle_from_delta();
           }),
      edit("inputs-single", "inputs rounded to single precision",
           [](Facts& f) {
             Query narrowed = f.query;
             for_each_number(narrowed, [](const std::string&, double& x) {
               // Through memory: GCC 12 leaves out both conversions where it makes vectors of them.
               const volatile auto single = static_cast<float>(x);
               x = static_cast<double>(single);
             });
             f.ask(std::move(narrowed));
           }),
  };
}

}  // namespace contact::oracle::formulas
