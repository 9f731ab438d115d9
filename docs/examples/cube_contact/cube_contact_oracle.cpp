// The exact contact of two boxes, in CGAL's rationals.
#include "cube_contact_oracle.hpp"

#include <algorithm>
#include <array>

namespace example {
namespace {

using contact::Box;
using contact::Scalar;
using contact::Vector3;
using contact::oracle::Exact;
using contact::oracle::Rational;

double rounded(const Exact& x) { return contact::oracle::round_to_nearest(x, Scalar::binary64); }

/// One axis: centres and half sizes, the gap, the faces that look at each other, the middle of the common part.
struct Axis {
  Axis(double min1, double max1, double min2, double max2) {
    const Rational half(1, 2);
    const Rational h1 = (Rational(max1) - Rational(min1)) * half;
    const Rational h2 = (Rational(max2) - Rational(min2)) * half;
    const Rational m1 = Rational(min1) + h1;
    const Rational m2 = Rational(min2) + h2;
    tied = m1 == m2;
    side = m2 < m1 ? -1 : 1;
    gap = CGAL::abs(m2 - m1) - h1 - h2;
    face1 = m1 + Rational(side) * h1;
    face2 = m2 - Rational(side) * h2;
    // Sorted, the two inner ends of four bound the common part of two intervals that have one.
    std::array<Rational, 4> ends{m1 - h1, m1 + h1, m2 - h2, m2 + h2};
    std::sort(ends.begin(), ends.end());
    middle = (ends[1] + ends[2]) * half;
  }

  bool tied;
  int side;
  Rational gap, face1, face2, middle;
};

}  // namespace

CubeContactTruth cube_contact_truth(const contact::Query& query) {
  const auto& [a, b] = *query.boxes();
  const auto axis = [&, &box1 = a, &box2 = b](int k) {
    return Axis(box1.min[k], box1.max[k], box2.min[k], box2.max[k]);
  };
  const std::array axes{axis(0), axis(1), axis(2)};
  const auto most =
      std::max_element(axes.begin(), axes.end(), [](const Axis& x, const Axis& y) { return x.gap < y.gap; });
  CubeContactTruth truth{CubeContactTruth::Kind::miss, false, Vector3::Zero(), Vector3::Zero(), Vector3::Zero(), 0};
  if (most->gap > Rational(query.distances.alarm)) return truth;

  const bool apart = most->gap > Rational(0);
  truth.kind = apart ? CubeContactTruth::Kind::gap_vector : CubeContactTruth::Kind::penetrating;
  truth.tied = !apart && most->tied;
  Rational D(0);
  for (const Axis& x : axes)
    if (x.gap > Rational(0)) D = D + x.gap * x.gap;
  const Rational contact(query.distances.contact);
  truth.value = rounded(apart ? Exact(-contact, Rational(1), D) : Exact(most->gap - contact));
  for (std::size_t i = 0; i < 3; ++i) {
    const Axis& x = axes[i];
    const auto k = static_cast<Eigen::Index>(i);
    const bool along = apart ? x.gap > Rational(0) : &x == most;
    if (along) truth.normal[k] = apart ? rounded(Exact(Rational(0), Rational(x.side) * x.gap / D, D)) : x.side;
    truth.point1[k] = rounded(along ? x.face1 : x.middle);
    truth.point2[k] = rounded(along ? x.face2 : x.middle);
  }
  return truth;
}

}  // namespace example
