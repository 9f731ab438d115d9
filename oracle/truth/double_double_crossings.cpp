// A segment that crosses a triangle, in pairs of doubles: the signs of its coordinates there, where they are certain.
#include "oracle/truth/double_double_segments.hpp"

#include <array>
#include <cstddef>

namespace contact::oracle {

std::optional<RoundedAnswer> case_of_crossing(const Vector3& from, const DoubleDoubles& along, const Triangle& triangle,
                                              int sign, Scalar scalar) {
  const auto& [v0, v1, v2] = triangle.vertices;
  if (!in_short_range({v0, v1}) || !in_short_range({v2, v2})) return std::nullopt;
  const DoubleDoubles u = difference(v1, v0);
  const DoubleDoubles v = difference(v2, v0);
  const DoubleDoubles w = difference(from, v0);
  const DoubleDoubles n = cross(u, v);
  const DoubleDoubles turned = cross(w, along);
  // v0 + s u + t v = from + r along, times -n.along.
  const DoubleDouble all = -dot(n, along);
  const DoubleDouble s = dot(v, turned);
  const DoubleDouble t = -dot(u, turned);
  const DoubleDouble r = dot(n, w);
  const auto of_all = all.sign();
  if (!of_all) return std::nullopt;
  bool crosses = *of_all != 0;
  bool certain = true;
  for (const DoubleDouble& x : {s, t, all - s - t, r, all - r}) {
    const auto of_x = x.sign();
    certain = certain && of_x;
    if (of_x && *of_x * *of_all < 0) crosses = false;
  }
  if (crosses && !certain) return std::nullopt;
  if (!crosses) return RoundedAnswer{1, 1, {false, std::nullopt}};

  const DoubleDouble part = r * reciprocal(all);
  const DoubleDouble inverse = reciprocal(root(dot(n, n)));
  DoubleDoubleAlong contact{exactly(from), {}, {}, {}, -1, -1, false, true};
  for (std::size_t i = 0; i < 3; ++i) {
    contact.p[i] = contact.p[i] + part * along[i];
    contact.normal[i] = sign < 0 ? -n[i] * inverse : n[i] * inverse;
  }
  contact.q = contact.p;
  auto found = case_along(contact, 0, 0, {0, 0}, scalar);
  if (found) found->margin = {};  // there is no distance
  return found;
}

}  // namespace contact::oracle
