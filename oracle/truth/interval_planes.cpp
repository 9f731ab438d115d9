// A segment over a plane in intervals, with the length of the normal as a root. The lowest point is the mean of all
// ends that no other is below; its foot comes without the distance, so that nothing cancels:
//   foot_i = (o n_i + sum over j of n_j (n_j p_i - n_i p_j)) / N
#include "oracle/truth/interval_planes.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace contact::oracle {
RoundedAnswer answer_over_plane(std::initializer_list<Vector3> ends, double radius, const Plane& plane,
                                Distances distances, Scalar scalar, mpfr_prec_t precision) {
  const auto number = [&](double x) { return Interval(precision, x); };
  const Triple n = triple(precision, plane.normal);
  const Interval offset = number(plane.offset);
  const Interval N = dot(n, n);
  const Interval length = N.root();

  std::vector<Vector3> lowest;
  for (const Vector3& end : ends) {
    const auto lies_above = [&](const Vector3& other) {
      return sign_of(dot(n, triple(precision, end)) - dot(n, triple(precision, other))) > 0;
    };
    const auto is_same = [&](const Vector3& other) { return other == end; };
    if (std::none_of(ends.begin(), ends.end(), lies_above) && std::none_of(lowest.begin(), lowest.end(), is_same))
      lowest.push_back(end);
  }
  // p times their number, which is 1 or 2.
  const Triple first = triple(precision, lowest.front());
  const Triple second = triple(precision, lowest.size() == 1 ? Vector3::Zero().eval() : lowest.back());
  const Triple sum{first[0] + second[0], first[1] + second[1], first[2] + second[2]};
  const Interval count = number(static_cast<double>(lowest.size()));

  const Interval height = dot(n, first) - offset;  // of all of them
  const Interval r = number(radius);
  const auto side = [&](const Interval& reach) { return sign_of(height - reach * length); };
  const Interval reach = number(distances.alarm) + r;
  RoundedAnswer answer{side(reach), side(r), {}, margin_of(height / length - reach, reach, scalar)};
  answer.expected.hit = answer.at_alarm <= 0;
  if (!answer.expected.hit) return answer;

  Contact contact{};
  contact.degenerate = false;
  contact.unique = lowest.size() == 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    contact.normal[axis] = settled(((number(0) - n[i]) / length).rounded(scalar));
    contact.point1[axis] = settled(((sum[i] - count * r * n[i] / length) / count).rounded(scalar));
    const auto part = [&](std::size_t j) { return n[j] * (n[j] * sum[i] - n[i] * sum[j]); };
    const Interval foot = count * offset * n[i] + (part((i + 1) % 3) + part((i + 2) % 3));
    contact.point2[axis] = settled((foot / (count * N)).rounded(scalar));
  }
  contact.value = settled((height / length - (r + number(distances.contact))).rounded(scalar));
  answer.expected.contact = contact;
  return answer;
}

}  // namespace contact::oracle
