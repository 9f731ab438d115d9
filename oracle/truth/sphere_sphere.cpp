// Two spheres, exactly: their cores are their centres.
#include <cstddef>

#include "oracle/truth/exact_truth.hpp"

namespace contact::oracle {

ExactTruth exact_truth(const Balls& balls, Distances distances) {
  Cores cores{{},
              {Rational(balls.a.radius), Rational(balls.b.radius)},
              {Rational(balls.a.center.cwiseAbs().maxCoeff()), Rational(balls.b.center.cwiseAbs().maxCoeff())}};
  for (int axis = 0; axis < 3; ++axis) {
    cores.nearest[0][static_cast<std::size_t>(axis)] = Rational(balls.a.center[axis]);
    cores.nearest[1][static_cast<std::size_t>(axis)] = Rational(balls.b.center[axis]);
  }
  return {DistanceTruth(std::move(cores), distances)};
}

Meet cores_meet(const Balls& balls) { return balls.a.center == balls.b.center ? Meet::touching : Meet::no; }

}  // namespace contact::oracle
