// The families of questions about two axis-aligned boxes.
#include "golden/common_families.hpp"

namespace contact::golden {
namespace cube_cube_families {
namespace {

template <class Real>
struct Cubes : Described<Real, Pair::cube_cube> {
  using Shapes = Cubes;
  using Limits = std::numeric_limits<Real>;
  Triple<Real> min1{};
  Triple<Real> max1{};
  Triple<Real> min2{};
  Triple<Real> max2{};

  [[nodiscard]] Query query(Pair pair) const {
    return {pair, Boxes{{widened(min1), widened(max1)}, {widened(min2), widened(max2)}}, this->distances()};
  }
  [[nodiscard]] std::array<Triple<Real>*, 4> points() { return {&min1, &max1, &min2, &max2}; }
  void scale(int e) { lift(e, min1, max1, min2, max2, this->alarm, this->contact); }
  void swap_boxes() {
    std::swap(min1, min2);
    std::swap(max1, max2);
  }

  static Shapes generic(Random& random) {
    Shapes c;
    for (std::size_t i = 0; i < 3; ++i) {
      c.min1[i] = random.uniform<Real>(-10, 6);
      c.max1[i] = c.min1[i] + random.uniform<Real>(2, 14);
      c.min2[i] = random.uniform<Real>(-10, 6);
      c.max2[i] = c.min2[i] + random.uniform<Real>(2, 14);
    }
    random_distances(c, random);
    return c;
  }

  /// The second box overlaps the first on every axis.
  static Shapes overlapping(Random& random) {
    Shapes c = generic(random);
    for (std::size_t i = 0; i < 3; ++i) {
      c.min2[i] = random.uniform(c.min1[i], c.max1[i]);
      c.max2[i] = c.min2[i] + random.uniform<Real>(1, 9);
    }
    return c;
  }

  /// Puts the second box on one side of the first along an axis, its near face at `face(max of the first)`. The other
  /// side is the same with every coordinate of that axis negated.
  template <class Face>
  static void place(Shapes& c, std::size_t axis, bool below, Face face) {
    const Real size = c.max2[axis] - c.min2[axis];
    c.min2[axis] = face(c.max1[axis]);
    c.max2[axis] = c.min2[axis] + size;
    if (!below) return;
    for (Triple<Real>* v : c.points()) (*v)[axis] = -(*v)[axis];
    std::swap(c.min1[axis], c.max1[axis]);
    std::swap(c.min2[axis], c.max2[axis]);
  }

  static Shapes separated(Random& random) {
    Shapes c = overlapping(random);
    const auto first = static_cast<std::size_t>(random.turn(3));
    const int axes = 1 + random.turn(3, 6);  // how many axes separate
    for (int k = 0; k < axes; ++k)
      place(c, (first + static_cast<std::size_t>(k)) % 3, k == 0 ? random.turn(2, 3) == 1 : random.chance(2),
            [&](Real max) { return max + c.alarm + random.uniform<Real>(1, 8); });
    if (random.turn(5) < 3) return c;
    for (std::size_t i = 0; i < 3; ++i) c.alarm = std::max({c.alarm, c.min1[i] - c.max2[i], c.min2[i] - c.max1[i]});
    c.alarm += random.uniform<Real>(1, 8);
    return c;
  }

  static Shapes touching(Random& random) {
    Shapes c = overlapping(random);
    c.alarm = 0;
    const auto first = static_cast<std::size_t>(random.turn(3));
    const int axes = 1 + random.turn(3, 6);   // 1 a face, 2 an edge, 3 a corner
    const int ulps = random.turn(3, 18) - 1;  // one axis one ulp inside, exactly touching, or one ulp apart
    for (int k = 0; k < axes; ++k)
      place(c, (first + static_cast<std::size_t>(k)) % 3, k == 0 ? random.turn(2, 3) == 1 : random.chance(2),
            [&](Real max) { return ulps_away(max, k == 0 ? ulps : 0); });
    return c;
  }

  static Shapes alarm_edge(Random& random) {
    const auto axis = static_cast<std::size_t>(random.turn(3));
    const bool below = random.turn(2, 3) == 1;
    const bool exact = random.turn(3, 6) == 0;  // max + alarm without rounding
    const int ulps = random.turn(3, 18) - 1;
    const bool swapped = random.chance(2);
    const auto make = [&] {
      Shapes c = overlapping(random);
      c.alarm = random.uniform<Real>(Real{0.0078125}, Real{1});
      if (exact) {
        c.max1[axis] = static_cast<Real>(random.between(-64, 64)) / Real{8};
        c.min1[axis] = c.max1[axis] - random.uniform<Real>(1, 4);
        c.alarm = static_cast<Real>(random.between(1, 64)) / Real{8};
      }
      place(c, axis, below, [&](Real max) { return ulps_away(max + c.alarm, ulps); });
      if (swapped) c.swap_boxes();
      return c;
    };
    return exact ? make() : searched(random, make);
  }

  static Shapes flat(Random& random) {
    Shapes c = random.chance(2) ? overlapping(random) : generic(random);
    const int mask = 1 + random.turn(7);  // which axes have no thickness
    for (std::size_t i = 0; i < 3; ++i)
      if ((mask >> i & 1) != 0) {
        if (random.turn(3, 7) != 1) c.max1[i] = c.min1[i];
        if (random.turn(3, 7) != 0) c.max2[i] = c.min2[i];
        if (random.chance(3)) {  // exactly in one plane, or exactly an alarm distance from it
          c.alarm = static_cast<Real>(random.between(0, 8)) / Real{4};
          c.min1[i] = c.max1[i] = static_cast<Real>(random.between(-8, 8));
          c.min2[i] = c.max2[i] = c.max1[i] + (random.chance(2) ? c.alarm : Real{0});
        }
      }
    if (random.chance(2)) c.swap_boxes();
    return c;
  }

  static Shapes nested(Random& random) {
    Shapes c = generic(random);
    for (std::size_t i = 0; i < 3; ++i) {
      const Real u = random.uniform(c.min1[i], c.max1[i]);
      const Real v = random.uniform(c.min1[i], c.max1[i]);
      c.min2[i] = random.chance(5) ? c.min1[i] : std::min(u, v);
      c.max2[i] = random.chance(5) ? c.max1[i] : std::max(u, v);
    }
    if (random.turn(2) == 1) c.swap_boxes();
    return c;
  }

  static Shapes identical(Random& random) {
    Shapes c = generic(random);
    if (random.turn(4) == 3) c.max1 = c.min1;
    c.min2 = c.min1;
    c.max2 = c.max1;
    return c;
  }

  static Shapes far_from_origin(Random& random) {
    const Real most = far_away<Real>(random);
    Shapes c = random.turn(2) == 0 ? generic(random) : alarm_edge(random);
    move_anywhere(c, random, most);
    return c;
  }

  static Shapes extreme_scale(Random& random) {
    constexpr Real kTiny = Limits::denorm_min();
    Shapes c;
    switch (random.turn(6)) {
      case 0:  // near the largest finite numbers: max + alarm overflows
        c = overlapping(random);
        c.scale(Limits::max_exponent - 6);
        for (std::size_t i = 0; i < 3; ++i)
          c.max1[i] = Limits::max() * (random.chance(2) ? Real{1} : random.uniform(Real{0.875}, Real{1}));
        for (std::size_t i = 0; i < 3; ++i) {
          c.min2[i] = random.uniform(std::max(c.min1[i], Real{0}), Limits::max());
          c.max2[i] = Limits::max();
        }
        c.alarm = random.chance(2) ? Limits::max() : random.uniform(Real{0}, Limits::max());
        return c;
      case 1: {  // subnormal numbers throughout
        for (std::size_t i = 0; i < 3; ++i) {
          c.min1[i] = static_cast<Real>(random.between(-20, 20)) * kTiny;
          c.max1[i] = c.min1[i] + static_cast<Real>(random.between(0, 20)) * kTiny;
          c.min2[i] = static_cast<Real>(random.between(-20, 20)) * kTiny;
          c.max2[i] = c.min2[i] + static_cast<Real>(random.between(0, 20)) * kTiny;
        }
        c.alarm = static_cast<Real>(random.between(0, 10)) * kTiny;
        return c;
      }
      case 2: {  // an alarm distance that the sum loses: only the exact comparison sees it
        c = overlapping(random);
        const auto axis = random.index(3);
        c.alarm = std::ldexp(Real{1}, -random.between(60, -Limits::min_exponent - 4));
        const int ulps = random.between(-1, 1);
        place(c, axis, random.chance(2), [&](Real max) { return ulps_away(max, ulps); });
        return c;
      }
      case 3:  // every number of a magnitude of its own
        for (std::size_t i = 0; i < 3; ++i)
          for (const auto& [low, high] : {std::pair{&c.min1[i], &c.max1[i]}, std::pair{&c.min2[i], &c.max2[i]}}) {
            const auto any = [&] {
              return random.with_sign(random.magnitude<Real>(Limits::min_exponent, Limits::max_exponent - 2));
            };
            const Real u = any();
            const Real v = any();
            *low = std::min(u, v);
            *high = std::max(u, v);
          }
        c.alarm = std::ldexp(Real{1}, random.between(Limits::min_exponent, Limits::max_exponent - 2));
        return c;
      case 4: {  // apart on one axis, and max + alarm overflows on another: an infinite sum hits nothing
        c = overlapping(random);
        c.scale(Limits::max_exponent - 6);
        const auto axis = random.index(3);
        c.alarm = Limits::max() * random.uniform(Real{0.125}, Real{0.25});
        c.max1[axis] = Limits::max() * random.uniform(Real{0.96875}, Real{1});
        const auto other = (axis + 1 + random.index(2)) % 3;
        const Real beyond = c.alarm + Limits::max() * random.uniform(Real{0.0625}, Real{0.125});
        place(c, other, random.chance(2), [&](Real max) { return max + beyond; });
        if (random.chance(2)) c.swap_boxes();
        return c;
      }
      default:  // ordinary shapes, far up or far down the scale
        c = random.chance(2) ? alarm_edge(random) : touching(random);
        c.scale(random.chance(2) ? Limits::max_exponent - 8 : Limits::min_exponent + Limits::digits + 8);
        return c;
    }
  }
};

using D = Cubes<double>;
using F = Cubes<float>;
using Rows = CommonRows<D, F>;

constexpr Family kFamilies[] = {
    {"generic", "ordinary boxes: the bulk of what an engine meets",
     "ordinary boxes: what fails here fails its users, and other families do not say so", made<D::generic, F::generic>},
    {"separated",
     "clearly apart on one, two or three axes, on every side: each axis alone must decide; two fifths "
     "within the alarm distance all the same",
     "far from every edge: a wrong answer is a wrong axis or side, and no rounding", made<D::separated, F::separated>},
    {"touching", "face, edge and corner in contact on every axis and side, and one ulp beside it",
     "a strict comparison on any one axis and side shows in many cases and not by chance",
     made<D::touching, F::touching>},
    {"alarm_edge", "one ulp around the alarm distance where max + alarm rounds, searched for wrong decisions",
     "searched for what plain sums decide wrongly: how often is an engine's measure",
     made<D::alarm_edge, F::alarm_edge>},
    {"flat", "zero thickness on one to three axes: a flat box still touches",
     "overlap by volume on any axis; besides upstream's it alone refutes box-euclidean", made<D::flat, F::flat>},
    {"nested", "one box inside the other, sharing faces or not",
     "for engines that compare corners, edges or faces, and not extents", made<D::nested, F::nested>, false, false,
     "a box and what is inside it overlap"},
    {"identical", "a box and its copy, flat ones included",
     "no difference at all: for engines that take a box for itself and skip it", made<D::identical, F::identical>,
     false, false, "a box overlaps itself"},
    {"far_from_origin", "small gaps between large coordinates: the alarm distance is lost in the sum",
     "the alarm distance is lost in a sum, on every axis and side", made<D::far_from_origin, F::far_from_origin>},
    {"extreme_scale", "sums that overflow, alarm distances that vanish in a sum, subnormal and mixed magnitudes", "",
     made<D::extreme_scale, F::extreme_scale>},
    Rows::invalid("each number in turn NaN or infinite, a box inverted, a distance negative: it must be refused", ""),
};

}  // namespace
}  // namespace cube_cube_families

std::span<const Family> families_of(const Boxes* /*kind*/) { return cube_cube_families::kFamilies; }

}  // namespace contact::golden
