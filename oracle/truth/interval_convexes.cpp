// Any two cores in intervals. A - B is what lies below its facets: 0 lies outside where it is above one, and else as deep as it is below the nearest.
//
// Of which vertices a facet consists is known from what it was made of, a face or two edges, and of the others by the sign of how far they are from it: in what is
// in no special position no sign is that of 0, and few digits settle it.
#include "oracle/truth/interval_cores.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "oracle/truth/interval_rough.hpp"

namespace contact::oracle {
namespace {

/// The vertices of a core that lie farthest along a direction.
using Places = std::vector<std::size_t>;
bool has(const Places& places, std::size_t k) { return std::find(places.begin(), places.end(), k) != places.end(); }

/// How far the vertices of a core lie along a direction: an interval only of those whose order a double does not tell.
class Heights {
 public:
  Heights(const IntervalCore& core, const std::vector<RoughTriple>& roughly, const Triple& n,
          const RoughTriple& rough_n)
      : core_(core), n_(n) {
    for (const RoughTriple& x : roughly) rough_.push_back(dot(rough_n, x));
    found_.resize(rough_.size());
  }
  [[nodiscard]] std::size_t size() const { return rough_.size(); }
  [[nodiscard]] const Interval& operator[](std::size_t k) const {
    if (!found_[k]) found_[k].emplace(dot(n_, core_.vertices[k]));
    return *found_[k];
  }
  /// The sign of how much farther a vertex lies than another.
  [[nodiscard]] int order(std::size_t k, std::size_t than) const {
    if (const auto known = (rough_[k] - rough_[than]).sign()) return *known;
    return sign_of((*this)[k] - (*this)[than]);
  }

 private:
  const IntervalCore& core_;
  const Triple& n_;
  std::vector<Rough> rough_;
  mutable std::vector<std::optional<Interval>> found_;
};
/// Those that lie farthest, or where `sign` is -1 least far, if `known` are all at one height.
Places farthest(const Heights& heights, int sign, const Places& known) {
  Places best = known.empty() ? Places{0} : known;
  for (std::size_t k = 0; k < heights.size(); ++k) {
    if (has(known, k) || has(best, k)) continue;
    const int order = sign * heights.order(k, best[0]);
    if (order > 0) best = {k};
    if (order == 0) best.push_back(k);
  }
  return best;
}

/// A direction that a facet of A - B may face, what lies farthest along it, and how far max N.a lies above min N.b.
struct Facing {
  Triple normal;
  Places of_a;
  Places of_b;
  Interval height;
};

class AnyTwo {
 public:
  AnyTwo(const IntervalCore& a, const IntervalCore& b, mpfr_prec_t precision)
      : a_(a), b_(b), precision_(precision), over_(number(1)) {
    // Over one denominator.
    const auto by = [](IntervalCore& core, const std::optional<Interval>& over) {
      if (!over) return;
      for (Triple& x : core.vertices) x = scaled(*over, x);
    };
    by(a_, b.over);
    by(b_, a.over);
    for (const auto* core : {&a, &b})
      if (core->over) over_ = over_ * *core->over;
    const long power = std::max(power_of(a_.vertices), power_of(b_.vertices));
    rough_a_ = rough(a_.vertices, power);
    rough_b_ = rough(b_.vertices, power);
    make_facings();
  }

  [[nodiscard]] RoundedAnswer answer(Distances distances, Scalar scalar) const {
    const Facing* least = nullptr;
    bool is_solid = false;
    for (const Facing& facing : facings_) {
      const int side = sign_of(facing.height);
      if (side < 0) return answer_of(nearest_of_cores(a_, b_, facing_each_other(), precision_), distances, scalar);
      is_solid = is_solid || is_thick(facing);
      if (is_solid && side == 0 && !is_facet(facing)) continue;
      if (least == nullptr || is_before(facing, *least)) least = &facing;
    }
    if (is_solid) return answer_meeting(*least, sign_of(least->height) == 0, distances, scalar);
    // In a plane or a line 0 may lie beside A - B.
    const IntervalNearest nearest = nearest_of_cores(a_, b_, all_features(a_, b_), precision_);
    if (!is_zero(difference(nearest.q, nearest.p))) return answer_of(nearest, distances, scalar);
    const Facing in_line{nearest.agreed, all_of(a_), all_of(b_), number(0)};
    return answer_meeting(least == nullptr ? in_line : *least, true, distances, scalar);
  }

 private:
  [[nodiscard]] Interval number(double x) const { return {precision_, x}; }
  static Places all_of(const IntervalCore& core) {
    Places all(core.vertices.size());
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = k;
    return all;
  }
  [[nodiscard]] Triple against(const Triple& n) const { return scaled(number(-1), n); }

  /// Along a direction, how far all vertices of both lie.
  struct Along {
    const Triple& normal;
    Heights a;
    Heights b;
  };
  [[nodiscard]] Along along(const Triple& n) const {
    const RoughTriple roughly = rough_direction(n);
    return {n, {a_, rough_a_, n, roughly}, {b_, rough_b_, n, roughly}};
  }
  /// What faces the direction, or with -1 its opposite.
  [[nodiscard]] Facing facing(const Along& along, int sign, const Places& in_a, const Places& in_b) const {
    const Places of_a = farthest(along.a, sign, in_a);
    const Places of_b = farthest(along.b, -sign, in_b);
    const Interval& most = along.a[of_a[0]];
    const Interval& least = along.b[of_b[0]];
    return {sign > 0 ? along.normal : against(along.normal), of_a, of_b, sign > 0 ? most - least : least - most};
  }
  /// Whether something of A - B lies below it.
  [[nodiscard]] bool is_thick(const Facing& f) const {
    return f.of_a.size() < a_.vertices.size() || f.of_b.size() < b_.vertices.size();
  }

  /// Of the faces of each, and of each two edges.
  void make_facings() {
    const auto add = [&](const Triple& n, const Places& in_a, const Places& in_b) {
      if (!is_zero(n)) facings_.push_back(facing(along(n), 1, in_a, in_b));
    };
    const auto add_faces = [&](const IntervalCore& core, bool of_a) {
      const auto add_face = [&](const Triple& n, const Feature& face) {
        const Places corners(face.corners().begin(), face.corners().end());
        of_a ? add(n, corners, {}) : add(against(n), {}, corners);
      };
      std::size_t k = 0;
      for (const Feature& face : core.features) {
        if (face.dimension() < 2) continue;
        const auto way = [&](std::size_t corner) {
          return difference(core.vertices[face.places[corner]], core.vertices[face.places[0]]);
        };
        const Triple n = cross(way(1), way(2));
        const bool is_face = !is_zero(n);  // of a flat box some are none
        if (is_face && core.outward.empty()) add_face(n, face), add_face(against(n), face);
        if (is_face && !core.outward.empty()) add_face(core.outward[k], face);
        ++k;
      }
    };
    add_faces(a_, true);
    add_faces(b_, false);
    const auto way = [](const auto& vertices, const Feature& edge) {
      return difference(vertices[edge.places[1]], vertices[edge.places[0]]);
    };
    for (const Feature* e : a_.features_of(1))
      for (const Feature* f : b_.features_of(1)) {
        // A facet that two edges make has both of them in it.
        const RoughTriple roughly = cross(way(rough_a_, *e), way(rough_b_, *f));
        Beyond of_a(a_, rough_a_, *e, roughly);
        Beyond of_b(b_, rough_b_, *f, roughly);
        const auto may_face = [&](int sign) { return !of_a.is_there(sign) && !of_b.is_there(-sign); };
        if (!may_face(1) && !may_face(-1)) continue;
        const Triple n = cross(way(a_.vertices, *e), way(b_.vertices, *f));
        if (is_zero(n)) continue;
        of_a.settle(n);
        of_b.settle(n);
        std::optional<Along> both;
        for (const int sign : {1, -1}) {
          if (!may_face(sign)) continue;
          if (!both) both.emplace(along(n));
          facings_.push_back(facing(*both, sign, edge_at(a_, *e, both->a, sign), edge_at(b_, *f, both->b, -sign)));
        }
      }
  }
  /// Whether a vertex of a hull, which has its own edges, lies farther along a normal to one of them, and whether one lies less far.
  class Beyond {
   public:
    Beyond(const IntervalCore& core, const std::vector<RoughTriple>& roughly, const Feature& edge, const RoughTriple& n)
        : core_(core), from_(edge.places[0]) {
      if (!core.own) return;
      for (std::size_t k = 0; k < roughly.size() && !(above_ && below_); ++k) {
        if (edge.has(k)) continue;
        const auto known = dot(n, difference(roughly[k], roughly[from_])).sign();
        known ? take(*known) : open_.push_back(k);
      }
    }
    /// Of those whose side no double tells; both sides are enough.
    void settle(const Triple& n) {
      for (const std::size_t k : open_)
        if (!(above_ && below_)) take(sign_of(dot(n, difference(core_.vertices[k], core_.vertices[from_]))));
    }
    [[nodiscard]] bool is_there(int sign) const { return sign > 0 ? above_ : below_; }

   private:
    void take(int sign) {
      above_ = above_ || sign > 0;
      below_ = below_ || sign < 0;
    }
    const IntervalCore& core_;
    std::size_t from_;
    bool above_ = false;
    bool below_ = false;
    Places open_;
  };
  /// The corners of the edge of a direction that lies farthest along a normal to it, or least far.
  [[nodiscard]] static Places edge_at(const IntervalCore& core, const Feature& edge, const Heights& heights, int sign) {
    const auto lies_farther = [&](std::size_t k, std::size_t than) { return sign * heights.order(k, than) > 0; };
    if (core.own) return {edge.corners().begin(), edge.corners().end()};
    if (core.outward.empty()) {  // the edges of a triangle have no other of their direction
      for (std::size_t k = 0; k < core.vertices.size(); ++k)
        if (!edge.has(k) && lies_farther(k, edge.places[0])) return {};
      return {edge.corners().begin(), edge.corners().end()};
    }
    const std::size_t bit = edge.places[0] ^ edge.places[1];  // of a box: two corners that differ in it
    std::size_t best = 0;
    for (std::size_t k = 1; k < core.vertices.size(); ++k)
      if ((k & bit) == 0 && lies_farther(k, best)) best = k;
    return {best, best | bit};
  }

  /// Whether it is a facet, and no edge or corner.
  [[nodiscard]] bool is_facet(const Facing& f) const {
    std::vector<Triple> ways;
    for (const auto& [core, places] : {std::pair(&a_, &f.of_a), std::pair(&b_, &f.of_b)})
      for (const std::size_t k : *places)
        if (Triple way = difference(core->vertices[k], core->vertices[(*places)[0]]);
            k != (*places)[0] && !is_zero(way))
          ways.push_back(std::move(way));
    return std::any_of(ways.begin(), ways.end(), [&](const Triple& way) { return !is_zero(cross(ways[0], way)); });
  }

  /// Whether the depth along it is less, or where it is as deep, whether it comes before another.
  [[nodiscard]] bool is_before(const Facing& x, const Facing& y) const {
    const Interval N = dot(x.normal, x.normal);
    const Interval M = dot(y.normal, y.normal);
    if (const int order = sign_of(x.height.squared() * M - y.height.squared() * N); order != 0) return order < 0;
    const auto size = [&](const Triple& n) {
      Interval all = number(0);
      for (const Interval& each : n) all = sign_of(each) < 0 ? all - each : all + each;
      return all;
    };
    const Interval of_x = size(x.normal);
    const Interval of_y = size(y.normal);
    for (std::size_t i = 0; i < 3; ++i)
      if (const int order = sign_of(x.normal[i] * of_y - y.normal[i] * of_x); order != 0) return order > 0;
    return false;
  }

  [[nodiscard]] RoundedAnswer answer_of(IntervalNearest nearest, Distances distances, Scalar scalar) const {
    nearest.over = nearest.over * over_;
    return answer_of_nearest(nearest, number(a_.radius), number(b_.radius), distances, scalar, precision_);
  }
  /// The features of a core that lie between some of its vertices.
  static std::vector<const Feature*> parts(const IntervalCore& core, const Places& places) {
    std::vector<const Feature*> all;
    for (const Feature& feature : core.features)
      if (std::all_of(feature.corners().begin(), feature.corners().end(),
                      [&](std::size_t k) { return has(places, k); }))
        all.push_back(&feature);
    return all;
  }

  /// What may be nearest where 0 lies outside A - B: what is nearest to it lies in a facet that it is above.
  [[nodiscard]] std::vector<FeaturePair> facing_each_other() const {
    if (std::none_of(facings_.begin(), facings_.end(), [&](const Facing& f) { return is_thick(f); }))
      return all_features(a_, b_);  // it has no facets
    // The ones that it is highest above come first: often what is nearest lies in them.
    std::vector<std::pair<double, const Facing*>> above;
    for (const Facing& f : facings_)
      if (f.height.sign().value_or(-1) < 0)
        above.emplace_back(f.height.ends().low / std::sqrt(dot(f.normal, f.normal).ends().low), &f);
    std::sort(above.begin(), above.end());
    std::vector<FeaturePair> found;
    for (const auto& [height, facing] : above)
      for (const Feature* f : parts(a_, facing->of_a))
        for (const Feature* g : parts(b_, facing->of_b))
          if (const FeaturePair pair(f, g); std::find(found.begin(), found.end(), pair) == found.end())
            found.push_back(pair);
    return found;
  }

  /// What the faces have in common that face each other, B having been moved out by `out` / N: of features of as many
  /// dimensions together as there are to share, so that in their plane or line they cross in one point.
  [[nodiscard]] IntervalCommon common(const Facing& f, const Interval& N, const Triple& out) const {
    IntervalCore a = a_;
    IntervalCore b = b_;
    for (Triple& x : a.vertices) x = scaled(N, x);
    for (Triple& x : b.vertices) x = sum(scaled(N, x), out);
    return common_of_cores(a, parts(a, f.of_a), b, parts(b, f.of_b), precision_);
  }

  [[nodiscard]] RoundedAnswer answer_meeting(const Facing& f, bool is_touching, Distances distances,
                                             Scalar scalar) const {
    const Interval r1 = number(a_.radius);
    const Interval r2 = number(b_.radius);
    const Interval reach = number(distances.alarm) + r1 + r2;
    RoundedAnswer found{is_touching ? -sign_of(reach) : -1, is_touching ? -sign_of(r1 + r2) : -1, {true, std::nullopt}};
    const Interval N = dot(f.normal, f.normal);
    const Interval length = N.root();
    const Interval distance = is_touching ? number(0) : number(0) - f.height / (length * over_);
    found.margin = margin_of(distance - reach, reach, scalar);
    const auto [p, of_p, unique] =
        common(f, N, is_touching ? Triple{number(0), number(0), number(0)} : scaled(f.height, f.normal));
    const Interval over = of_p * N * over_;
    Contact contact{};
    contact.degenerate = is_touching;
    contact.unique = unique;
    const Triple& n = f.normal;
    const auto q = [&, &p = p, &of_p = of_p](std::size_t i) {
      return is_touching ? p[i] : p[i] - of_p * f.height * n[i];
    };
    contact.normal = rounded(scalar, [&](std::size_t i) { return n[i] / length; });
    contact.point1 =
        rounded(scalar, [&, &p = p](std::size_t i) { return (p[i] + (r1 * over * n[i]) / length) / over; });
    contact.point2 = rounded(scalar, [&](std::size_t i) { return (q(i) - (r2 * over * n[i]) / length) / over; });
    const Interval less = (r1 + r2 + number(distances.contact)) * over_;
    const Interval value = ((is_touching ? number(0) : number(0) - f.height / length) - less) / over_;
    contact.value = settled(value.rounded(scalar));
    found.expected.contact = contact;
    return found;
  }

  IntervalCore a_;
  IntervalCore b_;
  mpfr_prec_t precision_;
  Interval over_;
  std::vector<RoughTriple> rough_a_;  ///< the vertices, roughly
  std::vector<RoughTriple> rough_b_;
  std::vector<Facing> facings_;
};

}  // namespace

RoundedAnswer answer_of_convexes(const IntervalCore& a, const IntervalCore& b, Distances distances, Scalar scalar,
                                 mpfr_prec_t precision) {
  return AnyTwo(a, b, precision).answer(distances, scalar);
}

}  // namespace contact::oracle
