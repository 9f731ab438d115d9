// Two cores in intervals, by active sets: what is nearest of the lines or planes through a feature of each is nearest of the cores where
// no vertex lies before it along the way between (Karush, Kuhn and Tucker; the problem is convex).
//   p = a + sum of s_i u_i     q = b + sum of t_j v_j     (q - p).u_i = (q - p).v_j = 0
// No quotient is formed before the last, so that what is exact stays exact.
#include "oracle/truth/interval_cores.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace contact::oracle {
namespace {

/// p / over and q / over, over > 0.
struct Pair {
  Triple p;
  Triple q;
  Interval over;
};

/// The lexicographic order of two points over denominators.
int order(const Triple& x, const Interval& over_x, const Triple& y, const Interval& over_y) {
  for (std::size_t i = 0; i < 3; ++i)
    if (const int sign = sign_of(x[i] * over_y - y[i] * over_x); sign != 0) return sign;
  return 0;
}

class TwoCores {
 public:
  TwoCores(const IntervalCore& a, const IntervalCore& b, mpfr_prec_t precision) : a_(a), b_(b), precision_(precision) {}

  [[nodiscard]] IntervalNearest nearest(const std::vector<FeaturePair>& tried) const {
    auto [at, unique] = middle_of(optimal(tried));
    return {std::move(at.p), std::move(at.q), std::move(at.over), agreed(), unique};
  }

  /// Of features in one plane or line: the middle of what they have in common. Those of as many dimensions together as the plane has cross
  /// in one point, or do not.
  [[nodiscard]] IntervalCommon common(const std::vector<const Feature*>& of_a,
                                      const std::vector<const Feature*>& of_b) const {
    std::vector<Pair> found;
    for (std::size_t dimensions = 3; found.empty() && dimensions-- > 0;)
      for (const Feature* f : of_a)
        for (const Feature* g : of_b)
          if (f->dimension() + g->dimension() == dimensions)
            if (auto at = on_features(*f, *g)) found.push_back(*std::move(at));
    if (found.empty()) throw Undecided{};  // never with signs that are settled
    auto [at, unique] = middle_of(found);
    return {std::move(at.p), std::move(at.over), unique};
  }

 private:
  [[nodiscard]] Interval number(double x) const { return {precision_, x}; }

  /// Parts of each way, over a denominator, that lead to a point of a feature.
  static bool contains(const Feature& feature, const std::vector<Interval>& parts, std::size_t first,
                       const Interval& over) {
    for (std::size_t k = first; k < first + feature.dimension(); ++k)
      if (sign_of(parts[k]) < 0 || (feature.size != 3 && sign_of(over - parts[k]) < 0)) return false;
    return feature.size != 3 || sign_of(over - (parts[first] + parts[first + 1])) >= 0;
  }

  /// -1 where a vertex of a core lies farther along a way than a feature that is at right angles to it, 0 where one lies as far, else 1.
  static int extreme(const IntervalCore& core, const Feature& feature, const Triple& along) {
    int least = 1;
    for (std::size_t k = 0; k < core.vertices.size() && least >= 0; ++k)
      if (!feature.has(k))
        least = std::min(least, sign_of(dot(along, difference(core.vertices[feature.places[0]], core.vertices[k]))));
    return least;
  }

  /// The middle of those with the lexicographically least and greatest p.
  struct Middle {
    Pair at;
    bool unique;
  };
  [[nodiscard]] Middle middle_of(const std::vector<Pair>& found) const {
    const Pair* low = &found.front();
    const Pair* high = low;
    for (const Pair& x : found) {
      // None is compared with itself: of what is not exact not even that is settled.
      if (&x != low && order(x.p, x.over, low->p, low->over) < 0) low = &x;
      if (&x != high && order(x.p, x.over, high->p, high->over) > 0) high = &x;
    }
    if (low == high || order(low->p, low->over, high->p, high->over) == 0) return {*low, true};
    const auto middle = [&](const Triple& x, const Triple& y) {
      return sum(scaled(high->over, x), scaled(low->over, y));
    };
    return {{middle(low->p, high->p), middle(low->q, high->q), number(2) * low->over * high->over}, false};
  }

  /// What is nearest of the lines or planes through two features, if that is one pair of points of these.
  [[nodiscard]] std::optional<Pair> on_features(const Feature& f, const Feature& g) const {
    if (f.dimension() + g.dimension() > 2) return std::nullopt;
    const Triple& a = a_.vertices[f.places[0]];
    const Triple& b = b_.vertices[g.places[0]];
    const Triple w = difference(b, a);
    std::vector<Triple> ways;  // of p - q from a, then of q - p from b
    for (std::size_t k = 1; k <= f.dimension(); ++k) ways.push_back(difference(a_.vertices[f.places[k]], a));
    for (std::size_t k = 1; k <= g.dimension(); ++k) ways.push_back(difference(b, b_.vertices[g.places[k]]));
    std::vector<Interval> parts;  // w = sum of parts[k] / over ways[k], and what is across them all
    Interval over = number(1);
    if (ways.size() == 1) {
      parts.push_back(dot(w, ways[0]));
      over = dot(ways[0], ways[0]);
    } else if (ways.size() == 2) {
      const Interval A = dot(ways[0], ways[0]);
      const Interval B = dot(ways[0], ways[1]);
      const Interval E = dot(ways[1], ways[1]);
      const Interval C = dot(w, ways[0]);
      const Interval F = dot(w, ways[1]);
      parts.push_back(C * E - B * F);
      parts.push_back(F * A - B * C);
      over = A * E - B * B;
    }
    if (!ways.empty() && sign_of(over) == 0) return std::nullopt;
    if (!contains(f, parts, 0, over) || !contains(g, parts, f.dimension(), over)) return std::nullopt;
    Pair at{scaled(over, a), scaled(over, b), over};
    for (std::size_t k = 0; k < f.dimension(); ++k) at.p = sum(at.p, scaled(parts[k], ways[k]));
    for (std::size_t k = f.dimension(); k < ways.size(); ++k) at.q = difference(at.q, scaled(parts[k], ways[k]));
    return at;
  }
  /// All that are nearest of the cores: one, unless many are, and of these all ends.
  [[nodiscard]] std::vector<Pair> optimal(const std::vector<FeaturePair>& tried) const {
    std::vector<Pair> found;
    for (const auto& [f, g] : tried) {
      auto at = on_features(*f, *g);
      if (!at) continue;
      const Triple delta = difference(at->q, at->p);
      const int of_a = extreme(a_, *f, delta);
      const int of_b = of_a < 0 ? -1 : extreme(b_, *g, difference(at->p, at->q));
      if (of_b < 0) continue;
      found.push_back(*std::move(at));
      // Where nothing else lies as far, nothing else is nearest; nor where one core is a point.
      if ((of_a > 0 && of_b > 0) || a_.vertices.size() == 1 || b_.vertices.size() == 1) return {found.back()};
    }
    if (found.empty()) throw Undecided{};  // never with signs that are settled
    return found;
  }

  /// The normal of cores that touch.
  [[nodiscard]] Triple agreed() const {
    std::vector<Triple> ways;
    for (const IntervalCore* core : {&a_, &b_})
      for (std::size_t k = 1; k < core->vertices.size(); ++k)
        if (Triple along = difference(core->vertices[k], core->vertices[0]); !is_zero(along)) ways.push_back(along);
    for (std::size_t k = 1; k < ways.size(); ++k) {
      const Triple n = cross(ways[0], ways[k]);
      for (const Interval& x : n)
        if (const int sign = sign_of(x); sign != 0) return scaled(number(sign), n);
    }
    if (ways.empty()) return triple(precision_, Vector3::UnitX());
    const Triple& u = ways[0];
    if (sign_of(u[1]) == 0 && sign_of(u[2]) == 0) return triple(precision_, Vector3::UnitY());
    return {u[1].squared() + u[2].squared(), number(0) - u[0] * u[1], number(0) - u[0] * u[2]};
  }

  const IntervalCore& a_;
  const IntervalCore& b_;
  mpfr_prec_t precision_;
};

/// A face of a core with an inside, and how far a point lies below it: height / sqrt(across2).
struct Below {
  const Feature* face;
  const Triple* outward;
  Interval height;
  Interval across2;
};
std::vector<Below> below_faces(const Triple& c, const IntervalCore& solid) {
  std::vector<Below> all;
  for (std::size_t k = 0; k < solid.outward.size(); ++k) {
    const Feature& face = solid.faces()[k];
    const Triple& n = solid.outward[k];
    all.push_back({&face, &n, dot(n, difference(solid.vertices[face.places[0]], c)), dot(n, n)});
  }
  return all;
}

/// The first of the nearest.
const Below& nearest_of(const std::vector<Below>& faces) {
  const Below* least = &faces.front();
  for (const Below& face : faces)
    if (sign_of(face.height.squared() * least->across2 - least->height.squared() * face.across2) < 0) least = &face;
  return *least;
}

/// The answer for a ball whose centre lies in a core.
RoundedAnswer answer_inside(const Triple& c, const Below& face, double radius, Distances distances, Scalar scalar,
                            mpfr_prec_t precision) {
  const auto number = [&](double x) { return Interval(precision, x); };
  const Interval r = number(radius);
  const Interval reach = number(distances.alarm) + r;
  const bool is_deep = sign_of(face.height) > 0;
  RoundedAnswer answer{is_deep ? -1 : -sign_of(reach), is_deep ? -1 : -sign_of(r), {true, std::nullopt}};
  answer.margin = margin_of(number(0) - reach, reach, scalar);
  Contact contact{};
  contact.degenerate = true;
  contact.unique = true;
  const Interval length = face.across2.root();
  const Triple& n = *face.outward;
  contact.normal = rounded(scalar, [&](std::size_t i) { return (number(0) - n[i]) / length; });
  contact.point1 = rounded(scalar, [&](std::size_t i) { return c[i] - r * n[i] / length; });
  contact.point2 =
      rounded(scalar, [&](std::size_t i) { return (c[i] * face.across2 + face.height * n[i]) / face.across2; });
  contact.value = settled((number(0) - r - face.height / length - number(distances.contact)).rounded(scalar));
  answer.expected.contact = contact;
  return answer;
}

}  // namespace

std::vector<FeaturePair> all_features(const IntervalCore& a, const IntervalCore& b) {
  // Faces first: of one point and a core the first that is right is the only one.
  std::vector<FeaturePair> all;
  for (std::size_t i = a.features.size(); i-- > 0;)
    for (std::size_t j = b.features.size(); j-- > 0;) all.emplace_back(&a.features[i], &b.features[j]);
  return all;
}

IntervalNearest nearest_of_cores(const IntervalCore& a, const IntervalCore& b, const std::vector<FeaturePair>& tried,
                                 mpfr_prec_t precision) {
  return TwoCores(a, b, precision).nearest(tried);
}

IntervalCommon common_of_cores(const IntervalCore& a, const std::vector<const Feature*>& of_a, const IntervalCore& b,
                               const std::vector<const Feature*>& of_b, mpfr_prec_t precision) {
  return TwoCores(a, b, precision).common(of_a, of_b);
}

RoundedAnswer answer_of_cores(const IntervalCore& a, const IntervalCore& b, Distances distances, Scalar scalar,
                              mpfr_prec_t precision) {
  std::vector<Below> faces = below_faces(a.vertices[0], b);
  const auto is_above = [](const Below& face) { return sign_of(face.height) < 0; };
  if (!faces.empty() && std::none_of(faces.begin(), faces.end(), is_above))
    return answer_inside(a.vertices[0], nearest_of(faces), a.radius, distances, scalar, precision);
  // Of a core with an inside, what is nearest to a point outside lies in a face that the point is above.
  std::erase_if(faces, [&](const Below& face) { return !is_above(face); });
  std::vector<FeaturePair> tried;
  for (const FeaturePair& pair : all_features(a, b)) {
    const auto has_it = [&](const Below& below) {
      return std::all_of(pair.second->corners().begin(), pair.second->corners().end(),
                         [&](std::size_t corner) { return below.face->has(corner); });
    };
    if (faces.empty() || std::any_of(faces.begin(), faces.end(), has_it)) tried.push_back(pair);
  }
  return answer_of_nearest(TwoCores(a, b, precision).nearest(tried), Interval(precision, a.radius),
                           Interval(precision, b.radius), distances, scalar, precision);
}

// The length of the normal is a root. The foot of the lowest point comes without the distance, so that nothing cancels:
//   foot_i = (o n_i + sum over j of n_j (n_j p_i - n_i p_j)) / N
RoundedAnswer answer_of_cores(const IntervalCore& a, const Plane& plane, Distances distances, Scalar scalar,
                              mpfr_prec_t precision) {
  const auto number = [&](double x) { return Interval(precision, x); };
  const Triple n = triple(precision, plane.normal);
  const Interval offset = number(plane.offset);
  const Interval N = dot(n, n);
  const Interval length = N.root();

  const Triple* low = nullptr;  // of the vertices that no other is below, the least and the greatest
  const Triple* high = nullptr;
  for (const Triple& x : a.vertices) {
    const int above = low == nullptr ? -1 : sign_of(dot(n, difference(x, *low)));
    if (above > 0) continue;
    if (above < 0 || order(x, N, *low, N) < 0) low = &x;
    if (above < 0 || order(x, N, *high, N) > 0) high = &x;
  }
  const Triple twice = sum(*low, *high);
  const Interval over = a.over.value_or(number(1));
  const Interval two = number(2) * over;

  const Interval height = dot(n, *low) - offset * over;
  const Interval r = number(a.radius);
  const auto side = [&](const Interval& reach) { return sign_of(height - reach * over * length); };
  const Interval reach = number(distances.alarm) + r;
  RoundedAnswer answer{side(reach), side(r), {}, margin_of(height / (length * over) - reach, reach, scalar)};
  answer.expected.hit = answer.at_alarm <= 0;
  if (!answer.expected.hit) return answer;

  Contact contact{};
  contact.degenerate = false;
  contact.unique = order(*low, N, *high, N) == 0;
  contact.normal = rounded(scalar, [&](std::size_t i) { return (number(0) - n[i]) / length; });
  contact.point1 = rounded(scalar, [&](std::size_t i) { return (twice[i] - two * r * n[i] / length) / two; });
  contact.point2 = rounded(scalar, [&](std::size_t i) {
    const auto part = [&](std::size_t j) { return n[j] * (n[j] * twice[i] - n[i] * twice[j]); };
    return (two * offset * n[i] + (part((i + 1) % 3) + part((i + 2) % 3))) / (two * N);
  });
  contact.value = settled(((height / length - (r + number(distances.contact)) * over) / over).rounded(scalar));
  answer.expected.contact = contact;
  return answer;
}

}  // namespace contact::oracle
