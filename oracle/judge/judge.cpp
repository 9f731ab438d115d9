// A claim held against the truth under an engine's conventions, field by field.
#include "oracle/judge/judge.hpp"

#include <algorithm>
#include <cmath>

#include "oracle/judge/manifold.hpp"
#include "oracle/judge/near_optimal.hpp"
#include "oracle/judge/off.hpp"
#include "oracle/judge/point_set.hpp"
#include "oracle/judge/right_claim.hpp"
#include "oracle/truth/core.hpp"
#include "oracle/truth/default_environment.hpp"
#include "oracle/truth/exact_truth.hpp"
#include "oracle/truth/separation.hpp"

namespace contact::oracle {
namespace {

Decision decide(bool claimed, bool expected) {
  if (claimed == expected) return Decision::right;
  return expected ? Decision::missed_hit : Decision::false_hit;
}

FieldVerdict worse(const FieldVerdict& x, const FieldVerdict& y) {
  FieldVerdict both{std::max(x.grade, y.grade), std::max(x.error, y.error), x.off};
  both.off.merge(y.off);
  return both;
}

bool is_finite(const Vector3& v) { return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]); }

Rational squared_length(const Vector3& v) {
  Rational sum(0);
  for (int axis = 0; axis < 3; ++axis) sum += Rational(v[axis]) * Rational(v[axis]);
  return sum;
}

/// The error of a claimed normal that is exactly normalised first, at `bounded` at best. Two different square roots
/// meet here, so enclosures of both are narrowed until the bound is settled; closer than 2^-4000 is equal.
FieldVerdict grade_direction(double component, const Rational& length2, const Exact& x, const Rational& unit,
                             double bound) {
  const Exact direction = CGAL::is_zero(Rational(component))
                              ? Exact(Rational(0))
                              : Exact(Rational(0), Rational(component) / length2, length2);
  for (int bits = 128;; bits *= 2) {
    const auto p = direction.enclosure(bits);
    const auto q = x.enclosure(bits);
    const Rational most = std::max(p.high - q.low, q.high - p.low) / unit;
    const Rational least = std::max(Rational(0), Rational(std::max(p.low - q.high, q.low - p.high))) / unit;
    const double error = CGAL::to_interval(most).second;
    if (most <= Rational(bound) || bits > 4000) return {Grade::bounded, error};
    if (least > Rational(bound)) return {Grade::beyond_bound, error};
  }
}

/// Judges the fields of one claimed contact. The exact numbers are made where a claimed one is not the rounded one.
class ContactJudge {
 public:
  ContactJudge(const Query& query, const Truth& truth, bool contact_expected, const ContactClaim& claim,
               const Declaration& declared, const Contact* rounded, Detail detail)
      : query_(query),
        whole_(truth),
        contact_expected_(contact_expected),
        degenerate_(!is_cast(query.pair) && (rounded != nullptr ? rounded->degenerate : exact().degenerate())),
        claim_(claim),
        declared_(declared),
        conventions_(declared.conventions),
        rounded_(rounded),
        detail_(detail) {
    // What the claim says of n, first to second, for points where the centres coincide.
    if (claims_normal())
      claimed_n_ = conventions_.normal == NormalDirection::first_to_second ? *claim.normal : -*claim.normal;
    settle_separation();
  }

  using Fields = decltype(Verdict::fields);

  /// Every field that is judged, and what it needs. Of several ways out of an overlap that are as short, an engine may
  /// have taken any: the best one counts.
  [[nodiscard]] Fields fields() {
    Fields best = fields_by_way();
    if (separation_ || degenerate_ || is_cast(query_.pair) ||
        worst_of(best) == std::pair(Grade::correctly_rounded, 0.0))
      return best;
    const DistanceTruth& reference = exact();
    if (!reference.overlaps()) return best;
    rounded_ = nullptr;
    for (std::size_t way = 1; way < reference.meeting().ways.size(); ++way) {
      other_way_ = reference.by_way(way);
      if (Fields other = fields_by_way(); worst_of(other) < worst_of(best)) best = std::move(other);
    }
    return best;
  }

 private:
  /// The worst grade of the fields, and the largest error.
  static std::pair<Grade, double> worst_of(const Fields& fields) {
    std::pair<Grade, double> worst(Grade::correctly_rounded, 0);
    for (const auto& field : fields)
      if (field) worst = {std::max(worst.first, field->grade), std::max(worst.second, field->error)};
    return worst;
  }

  [[nodiscard]] Fields fields_by_way() const {
    Fields all{normal(), point(0), point(1), midpoint(), manifold(), value()};
    if (detail_ == Detail::grades) return all;
    std::optional<ClaimedContact> claimed;  // made where a number is neither right nor nearly so
    std::optional<NearOptimal> near;
    for (const Field field : kFields) {
      auto& found = all[static_cast<std::size_t>(field)];
      if (!found || found->grade == Grade::correctly_rounded || found->grade == Grade::not_finite) continue;
      found->needs[static_cast<std::size_t>(measure_of(field))] = found->off;
      if (found->grade != Grade::beyond_bound || field == Field::points || field == Field::value || separation_)
        continue;
      if (is_cast(query_.pair)) {
        if (const auto length = beside_face(); length && field == Field::normal) take_length(*found, *length);
        continue;
      }
      if (!claimed) claimed = claimed_contact();
      if (!claimed->is_finite) continue;
      if (!near) near.emplace(query_, exact(), *claimed, tolerance(), declared_.scalar);
      if (field == Field::normal)
        take_length(*found, near->normal());
      else
        found->needs[static_cast<std::size_t>(Measure::length)].take_lesser(
            field == Field::point ? near->midpoint() : near->point(field == Field::point1 ? 0 : 1));
    }
    return all;
  }

  [[nodiscard]] std::optional<FieldVerdict> normal() const {
    if (!claims_normal()) return std::nullopt;
    const Vector3& n = claimed_n_;
    if (!is_finite(n)) return FieldVerdict{Grade::not_finite, 0};
    if (separation_) return unit_normal(n);
    // The reference's direction is one of those that are right, wherever several are, unless none is asked for.
    if (is_reference() && (!degenerate_ || conventions_.coincident != Coincident::zero_normal)) return FieldVerdict{};
    if (degenerate_) return exact().coincident() ? coincident_normal(n) : normal_out(n);
    const CastHit* cast = exact().cast();
    if (cast == nullptr) return normal_beside(n);
    if (cast->inside || cast->against) return separating_normal(n);
    const bool is_other_side = cast->either_side && dot(contact::oracle::point_of(n), cast->along) < Rational(0);
    return normal_beside(is_other_side ? Vector3(-n) : n);
  }

  /// The contact point of sphere 0 or 1.
  [[nodiscard]] std::optional<FieldVerdict> point(int sphere) const {
    const std::optional<Vector3>& p = sphere == 0 ? claim_.point1 : claim_.point2;
    const std::optional<PointOn> on = point_of(conventions_, query_, sphere);
    if (!p || !on || !claims(sphere == 0 ? Field::point1 : Field::point2)) return std::nullopt;
    if (degenerate_ && *on != PointOn::center && !knows_coincident_normal()) return std::nullopt;
    if (separation_ && is_finite(*p)) {
      const Rational radius = outward(sphere, *on) * exact().radius(sphere);
      const Point of_core = contact::oracle::point_of(*p) - radius * separation_->along();
      return bounded_at_best(root(separation_->squared_off(sphere, of_core)), exact().point_scale(sphere),
                             declared_.bounds.point, roundings() * exact().radius(sphere));
    }
    if (rounded_ != nullptr && (!degenerate_ || is_reference()) && *on == PointOn::nearest_surface &&
        *p == (sphere == 0 ? rounded_->point1 : rounded_->point2))
      return FieldVerdict{};
    if (is_references(*p, [&](int axis) { return exact().point(sphere, axis, *on); })) return FieldVerdict{};
    return grade_point(*p, exact().point_scale(sphere), exact().radius(sphere), [&](int axis) {
      return degenerate_ ? coincident_point(sphere, axis, *on) : exact().point(sphere, axis, *on);
    });
  }

  [[nodiscard]] std::optional<FieldVerdict> midpoint() const {
    if (!claim_.point || conventions_.points != Points::midpoint || !claims(Field::point)) return std::nullopt;
    if (degenerate_ && !knows_coincident_normal()) return std::nullopt;
    const Exact scale = larger_of(exact().point_scale(0), exact().point_scale(1));
    if (separation_ && is_finite(*claim_.point)) {
      const Rational half = (exact().radius(0) - exact().radius(1)) / Rational(2);
      const Point of_cores = contact::oracle::point_of(*claim_.point) - half * separation_->along();
      return bounded_at_best(root(separation_->squared_off_middle(of_cores)), scale, declared_.bounds.point,
                             roundings() * exact().radii());
    }
    if (is_references(*claim_.point, [&](int axis) { return exact().midpoint(axis); })) return FieldVerdict{};
    return grade_point(*claim_.point, scale, exact().radii() / Rational(2),
                       [&](int axis) { return degenerate_ ? coincident_midpoint(axis) : exact().midpoint(axis); });
  }

  /// Several points, along the claimed normal, or the right one where none is claimed.
  [[nodiscard]] std::optional<FieldVerdict> manifold() const {
    if (claim_.points.empty() || !claims(Field::points) || !has_manifold(query_.pair)) return std::nullopt;
    for (const ManifoldPoint& point : claim_.points)
      if (!is_finite(point.at) || !std::isfinite(point.depth)) return FieldVerdict{Grade::not_finite, 0};
    const bool by_claim = claims_normal() && is_finite(claimed_n_) && !claimed_n_.isZero(0);
    if (!by_claim && degenerate_) return std::nullopt;
    const Point n = of_length_one(by_claim ? contact::oracle::point_of(claimed_n_) : exact().along());
    const Rational slack = Rational(declared_.bounds.normal) * ulp(Rational(1), declared_.scalar);
    const Manifold manifold(query_, n, slack);
    const Exact scale = larger_of(exact().point_scale(0), exact().point_scale(1));
    FieldVerdict verdict{Grade::bounded, 0};
    Rational deepest(claim_.points.front().depth);
    for (const auto& [at, said] : claim_.points) {
      const Rational depth(said);
      deepest = std::max(deepest, depth);
      const Rational room = Rational(2) * slack * (CGAL::abs(depth) + exact().radii());
      verdict = worse(verdict, bounded_at_best(root(manifold.squared_off(contact::oracle::point_of(at), depth)), scale,
                                               declared_.bounds.point, room));
    }
    const Exact right =
        separation_ ? separation_->depth().plus(exact().radii()) : exact().value(false).scaled(Rational(-1));
    verdict =
        worse(verdict, bounded_at_best(magnitude(right.plus(-deepest)), exact().value_scale(), declared_.bounds.value,
                                       separation_ ? separation_->depth_room() : Rational(0)));
    if (claim_.points.size() > static_cast<std::size_t>(conventions_.most_points)) {
      verdict.grade = Grade::beyond_bound;
      verdict.too_many = true;
      verdict.off.merge(beyond_lengths(tolerance()));
    }
    return verdict;
  }

  [[nodiscard]] std::optional<FieldVerdict> value() const {
    if (!claim_.value || conventions_.value == ValueKind::none || !claims(Field::value)) return std::nullopt;
    if (separation_ && std::isfinite(*claim_.value)) return value_along_claim();
    if (rounded_ != nullptr &&
        ((conventions_.value == ValueKind::signed_distance && conventions_.value_less_contact) ||
         is_cast(query_.pair)) &&
        *claim_.value == rounded_->value)
      return FieldVerdict{};
    Exact x = exact().value(conventions_.value_less_contact);
    if (conventions_.value == ValueKind::depth && !is_cast(query_.pair)) x = x.scaled(Rational(-1));
    return grade(*claim_.value, x,
                 {declared_.scalar, exact().value_scale(), declared_.bounds.value, tolerance(), detail_});
  }

  /// The claimed normal of cores that overlap, where any may be said.
  void settle_separation() {
    if (conventions_.depth != DepthOf::any_separating || !is_convex(query_.pair)) return;
    if (!claims_normal() || !is_finite(claimed_n_) || claimed_n_.isZero(0)) return;
    if (!exact().overlaps()) return;
    const Point n = contact::oracle::point_of(claimed_n_);
    separation_.emplace(std::get<Convexes>(query_.shapes), conventions_.normal_unit ? n : of_length_one(n),
                        Rational(declared_.bounds.normal) * ulp(Rational(1), declared_.scalar));
  }
  /// Any normal beside its own direction, where any is right. Domain: it is not 0.
  [[nodiscard]] FieldVerdict unit_normal(const Vector3& n) const {
    const Rational length2 = squared_length(n);
    FieldVerdict verdict{Grade::bounded, 0};
    if (!conventions_.normal_unit) return verdict;
    for (int axis = 0; axis < 3; ++axis)
      verdict = worse(verdict, component(n, axis, {Rational(0), Rational(n[axis]) / length2, length2}));
    verdict.off = unit_off(contact::oracle::point_of(n), tolerance());
    return verdict;
  }
  [[nodiscard]] FieldVerdict value_along_claim() const {
    const Rational contact(query_.distances.contact);
    const Rational less = exact().radii() + (conventions_.value_less_contact ? contact : Rational(0));
    const Rational claimed(*claim_.value);
    const Rational depth = (conventions_.value == ValueKind::depth ? claimed : Rational(-claimed)) - less;
    return bounded_at_best(magnitude(separation_->depth().plus(-depth)),
                           larger_of(std::max(exact().radii(), contact), separation_->depth()), declared_.bounds.value,
                           separation_->depth_room());
  }
  /// The grade of what is so far off something right, which nobody asks to be rounded correctly.
  [[nodiscard]] FieldVerdict bounded_at_best(const Exact& off, const Exact& scale, double bound,
                                             const Rational& room) const {
    const Rational unit = ulp(scale, declared_.scalar);
    return {is_within(Rational(0), off, Rational(bound) * unit + room) ? Grade::bounded : Grade::beyond_bound,
            error_in_units(Rational(0), off, unit), length_off(off, scale, tolerance(), room)};
  }
  static Exact root(const Rational& squared) { return {Rational(0), Rational(1), squared}; }

  [[nodiscard]] const DistanceTruth& exact() const {
    if (other_way_) return *other_way_;
    return contact_expected_ ? *whole_.contact() : *whole_.distance();
  }
  [[nodiscard]] bool claims(Field field) const { return declared_.claimed().has(aspect(field)); }
  /// What is not declared is no claim: nothing else goes with it either.
  [[nodiscard]] bool claims_normal() const { return claim_.normal && claims(Field::normal); }
  [[nodiscard]] const std::optional<Tolerance>& tolerance() const { return declared_.tolerance; }
  [[nodiscard]] Off off_from(const Vector3& n, const Point& right) const {
    if (detail_ == Detail::grades) return {};
    return angle_off(contact::oracle::point_of(n), right, conventions_.normal_unit, tolerance());
  }

  /// A claimed point beside the right one, or where the nearest points are not unique, beside all of them. Where it
  /// goes with a claimed normal that was rounded, the point may be that of the normal before.
  [[nodiscard]] FieldVerdict grade_point(const Vector3& claimed, const Exact& scale, const Rational& radius,
                                         const auto& right) const {
    const bool is_exact = is_reference() && squared_length(claimed_n_) == Rational(1);
    const bool is_claimed_normals = conventions_.normal_unit && degenerate_ && knows_coincident_normal() && !is_exact;
    const Rational room = is_claimed_normals ? roundings() * radius : Rational(0);
    const PointSet set{{right(0), right(1), right(2)}, exact().spread(), room};
    const Yardstick by{declared_.scalar, scale, declared_.bounds.point, tolerance(), detail_};
    if (!exact().spread().empty() || is_claimed_normals) return grade(claimed, set, by);
    FieldVerdict verdict;
    for (int axis = 0; axis < 3; ++axis)
      verdict = worse(verdict, grade(claimed[axis], set.middle[static_cast<std::size_t>(axis)], by));
    return verdict;
  }

  /// The same contact in real numbers, as far as it is judged.
  [[nodiscard]] ClaimedContact claimed_contact() const {
    ClaimedContact claimed;
    const auto take = [&](std::optional<Point>& point, const Vector3& v) {
      if (is_finite(v))
        point = contact::oracle::point_of(v);
      else
        claimed.is_finite = false;
    };
    if (claims_normal()) take(claimed.normal, claimed_n_);
    claimed.zero_where_cores_meet = conventions_.coincident == Coincident::zero_normal;
    for (const int shape : {0, 1}) {
      const auto& point = shape == 0 ? claim_.point1 : claim_.point2;
      const std::optional<PointOn> on = point_of(conventions_, query_, shape);
      if (!point || !on || !claims(shape == 0 ? Field::point1 : Field::point2)) continue;
      take(claimed.points[static_cast<std::size_t>(shape)], *point);
      claimed.on[static_cast<std::size_t>(shape)] = *on;
    }
    if (claim_.point && conventions_.points == Points::midpoint && claims(Field::point))
      take(claimed.midpoint, *claim_.point);
    return claimed;
  }

  /// A normal needs the angle to a right one, or a length that turns positions until it is right. The angle is said
  /// unless the length is much less.
  void take_length(FieldVerdict& normal, const Off& length) const {
    constexpr double kMuchLess = 0x1p-10;  // of the scale, beside radians
    Off unit;
    if (conventions_.normal_unit && !is_zero(contact::oracle::point_of(claimed_n_)))
      unit = unit_off(contact::oracle::point_of(claimed_n_), tolerance());
    auto& angle = normal.needs[static_cast<std::size_t>(Measure::angle)];
    const bool within = angle.within || (length.within && unit.within);
    if (length.relative < kMuchLess * angle.most) {
      normal.needs[static_cast<std::size_t>(Measure::length)] = length;
      normal.needs[static_cast<std::size_t>(Measure::length)].within = true;
      angle = unit;
    }
    angle.within = within;
  }

  /// How far a ray enters a box from another face, which it enters too and which the claimed normal belongs to.
  [[nodiscard]] std::optional<Off> beside_face() const {
    const auto* shapes = std::get_if<CastAt<Box>>(&query_.shapes);
    const CastHit* cast = exact().cast();
    Eigen::Index axis = 0;
    if (shapes == nullptr || cast == nullptr || claimed_n_.cwiseAbs().maxCoeff(&axis) == 0) return std::nullopt;
    const bool is_least = claimed_n_[axis] < 0;  // the normal of a cast leads out of the box
    const double along = is_least ? shapes->a.direction[axis] : -shapes->a.direction[axis];
    if ((claimed_n_.array() != 0).count() != 1 || along <= 0) return std::nullopt;
    const double face = (is_least ? shapes->b.min : shapes->b.max)[axis];
    const Exact apart = cast->at[static_cast<std::size_t>(axis)].plus(Rational(-face));
    return length_off(magnitude(apart), cast->point_scale, tolerance());
  }

  /// A claimed normal beside the exact one.
  [[nodiscard]] FieldVerdict normal_beside(const Vector3& n) const {
    FieldVerdict verdict;
    for (int axis = 0; axis < 3; ++axis) verdict = worse(verdict, component(n, axis, exact().normal(axis)));
    verdict.off = verdict.grade == Grade::correctly_rounded ? Off{} : off_from(n, exact().along());
    return verdict;
  }

  /// A component of a claimed normal beside the exact one.
  [[nodiscard]] FieldVerdict component(const Vector3& n, int axis, const Exact& x) const {
    if (conventions_.normal_unit)
      return grade(n[axis], x, {declared_.scalar, Exact(Rational(1)), declared_.bounds.normal, {}, detail_});
    const Rational length2 = squared_length(n);
    const Rational unit = ulp(Rational(1), declared_.scalar);
    if (CGAL::is_zero(length2)) return {Grade::beyond_bound, error_in_units(Rational(0), x, unit)};
    return grade_direction(n[axis], length2, x, unit, declared_.bounds.normal);
  }

  /// Inside: the best of the shortest ways out, right within 8 roundings of a unit normal.
  [[nodiscard]] FieldVerdict normal_out(const Vector3& n) const {
    std::optional<FieldVerdict> best;
    std::optional<Off> least;
    for (const WayOut& way : exact().meeting().ways) {
      FieldVerdict verdict;
      Rational off(0);
      for (int axis = 0; axis < 3; ++axis) {
        const Rational& along = way.direction[static_cast<std::size_t>(axis)];
        verdict = worse(verdict, component(n, axis, along));
        off += (Rational(n[axis]) - along) * (Rational(n[axis]) - along);
      }
      if (conventions_.normal_unit && off <= roundings() * roundings()) return {};
      // Of length 1, a normal would be off by as much as its cosine says: off^2 = 2 - 2 cos.
      const Rational along = dot(contact::oracle::point_of(n), way.direction);
      const Rational cosine = Rational(1) - roundings() * roundings() / Rational(2);
      if (!conventions_.normal_unit && along > Rational(0) && along * along >= cosine * cosine * squared_length(n))
        return {Grade::bounded, 0};
      if (const Off off_way = off_from(n, way.direction); !least || off_way.most < least->most) least = off_way;
      if (!best || std::pair(verdict.grade, verdict.error) <= std::pair(best->grade, best->error)) best = verdict;
    }
    best->off = *least;
    return *best;
  }
  [[nodiscard]] Rational roundings() const {
    return Rational(8) * power_of_two(-format_of(declared_.scalar).precision);
  }
  /// Whether the claimed normal is the reference's.
  [[nodiscard]] bool is_reference() const {
    return conventions_.normal_unit && rounded_ != nullptr && claimed_n_ == rounded_->normal;
  }

  /// D = 0: whether a point that goes with the reference's normal is the reference's own, rounded once. That of the
  /// normal after it was rounded may be far off: a component too small for the scalar counts when it is times a large
  /// radius.
  [[nodiscard]] bool is_references(const Vector3& claimed, const auto& point) const {
    if (!degenerate_ || !is_reference()) return false;
    bool is = true;
    for (int axis = 0; is && axis < 3; ++axis) is = is_correctly_rounded(claimed[axis], point(axis), declared_.scalar);
    return is;
  }

  /// Whether a normal points against no vertex of the cores: n.w >= -8u |w| for all of their differences w, n being of
  /// length 1, or made so where it need not be.
  [[nodiscard]] bool separates(const Vector3& n) const {
    const Rational room = roundings() * roundings() * (conventions_.normal_unit ? Rational(1) : squared_length(n));
    return std::all_of(exact().meeting().apart.begin(), exact().meeting().apart.end(), [&](const Point& w) {
      Rational along(0);
      Rational length2(0);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        along += w[axis] * Rational(n[static_cast<Eigen::Index>(axis)]);
        length2 += w[axis] * w[axis];
      }
      return along >= Rational(0) || along * along <= room * length2;
    });
  }

  /// D = 0: any finite unit normal that separates is right, to 8 roundings of its squared length, or exactly zero where
  /// so declared.
  [[nodiscard]] FieldVerdict coincident_normal(const Vector3& n) const {
    const Rational length2 = squared_length(n);
    if (conventions_.coincident == Coincident::zero_normal)
      return CGAL::is_zero(length2)
                 ? FieldVerdict{}
                 : FieldVerdict{Grade::beyond_bound, error_from_unit(length2), no_direction(tolerance())};
    return separating_normal(n);
  }
  /// Any finite unit normal that points against nothing: of cores that meet, of a ray that hits an edge or a corner.
  [[nodiscard]] FieldVerdict separating_normal(const Vector3& n) const {
    const Rational length2 = squared_length(n);
    const bool right = separates(n) && (conventions_.normal_unit ? CGAL::abs(length2 - Rational(1)) <= roundings()
                                                                 : !CGAL::is_zero(length2));
    const Grade best = conventions_.normal_unit ? Grade::correctly_rounded : Grade::bounded;
    if (right) return {best, 0};
    return {Grade::beyond_bound, error_from_unit(length2),
            angle_off(contact::oracle::point_of(n), exact().meeting().apart, conventions_.normal_unit, tolerance())};
  }
  [[nodiscard]] double error_from_unit(const Rational& length2) const {
    return error_in_units(length2, Rational(1), ulp(Rational(1), declared_.scalar));
  }

  [[nodiscard]] bool knows_coincident_normal() const { return claims_normal() && is_finite(claimed_n_); }
  /// D = 0: the point that goes with the claimed normal.
  [[nodiscard]] Exact coincident_point(int sphere, int axis, PointOn on) const {
    if (!knows_coincident_normal()) return exact().point(sphere, axis, on);  // a centre
    const Rational center = exact().point_for(sphere, axis, PointOn::center, claimed_n_);
    return beside_center(center, exact().point_for(sphere, axis, on, claimed_n_) - center);
  }
  /// D = 0: the middle of the two nearest surface points that go with the claimed normal.
  [[nodiscard]] Exact coincident_midpoint(int axis) const {
    const Rational center = (exact().point_for(0, axis, PointOn::center, claimed_n_) +
                             exact().point_for(1, axis, PointOn::center, claimed_n_)) /
                            Rational(2);
    const Rational sum = exact().point_for(0, axis, PointOn::nearest_surface, claimed_n_) +
                         exact().point_for(1, axis, PointOn::nearest_surface, claimed_n_);
    return beside_center(center, sum / Rational(2) - center);
  }
  /// center + along, `along` being a multiple of the claimed normal, which is normalised exactly where it need not be
  /// unit.
  [[nodiscard]] Exact beside_center(const Rational& center, const Rational& along) const {
    const Rational length2 = squared_length(claimed_n_);
    if (conventions_.normal_unit || CGAL::is_zero(length2)) return center + along;
    return {center, along / length2, length2};
  }

  std::optional<DistanceTruth> other_way_ = {};  // before what asks exact()
  std::optional<Separation> separation_ = {};    ///< along the claimed normal, where any is right
  const Query& query_;
  const Truth& whole_;
  bool contact_expected_;
  bool degenerate_;
  const ContactClaim& claim_;
  const Declaration& declared_;
  const Conventions& conventions_;
  const Contact* rounded_;  ///< the right answer, or nullptr
  Detail detail_;
  Vector3 claimed_n_ = Vector3::Zero();
};

/// What the engine declares and this answer to a hit lacks. Of a pair without numbers an answer is one decision: both
/// are asked for only where the engine lists them.
Aspects missing_aspects(Pair pair, const Claim& claim, const Declaration& declared, bool has_numbers,
                        bool overlap_expected, bool contact_expected) {
  Aspects asked;
  if (overlap_expected && (has_numbers || declared.claims)) asked.add(Aspect::overlap);
  if (has_numbers && contact_expected) {
    asked.add(Aspect::contact);
    if (claim.contact)
      for (const Field field : kFields)
        if (field != Field::points || has_manifold(pair)) asked.add(aspect(field));
  }
  return declared.claimed().common(asked).without(claim.says());
}

/// What the fields need, by what they are measured in.
void add_needs(Verdict& verdict, const std::array<std::optional<FieldVerdict>, kFields.size()>& fields) {
  for (const auto& found : fields) {
    if (!found) continue;
    for (std::size_t measure = 0; measure < kMeasures.size(); ++measure)
      verdict.off[measure].merge(found->needs[measure]);
    verdict.no_number_beside = verdict.no_number_beside || found->grade == Grade::not_finite;
  }
}

bool is_number(const Rational& x, Scalar scalar) {
  const double rounded = round_to_nearest(Exact(x), scalar);
  return std::isfinite(rounded) && Rational(rounded) == x;
}

/// Whether a shape's centre and size are numbers of the scalar. Then half the size is one too: of a size that is an odd
/// multiple of the smallest number, the centre is none.
bool has_center_and_size(const Ball& /*ball*/, Scalar /*scalar*/) { return true; }
bool has_center_and_size(const Box& box, Scalar scalar) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(box.min[axis]) || !std::isfinite(box.max[axis])) continue;
    const Rational low(box.min[axis]);
    const Rational high(box.max[axis]);
    for (const Rational& x : {(low + high) / 2, high - low})
      if (!is_number(x, scalar)) return false;
  }
  return true;
}
/// A capsule has a direction besides, which is exact along a coordinate axis alone.
bool has_center_and_size(const Capsule& capsule, Scalar scalar) {
  const Box around{capsule.start.cwiseMin(capsule.end), capsule.start.cwiseMax(capsule.end)};
  return (capsule.start.array() != capsule.end.array()).count() <= 1 && has_center_and_size(around, scalar);
}
/// A plane has a unit normal, which again is exact along a coordinate axis alone, and lies so many units along it.
bool has_center_and_size(const Plane& plane, Scalar scalar) {
  if (!plane.normal.allFinite() || !std::isfinite(plane.offset)) return true;
  return (plane.normal.array() != 0).count() == 1 &&
         is_number(Rational(plane.offset) / Rational(plane.normal.lpNorm<Eigen::Infinity>()), scalar);
}
/// A ray has two ends, and the way between them.
bool has_center_and_size(const Ray& ray, Scalar scalar) {
  if (!ray.origin.allFinite() || !ray.direction.allFinite() || !std::isfinite(ray.length)) return true;
  for (int axis = 0; axis < 3; ++axis) {
    const Rational way = Rational(ray.length) * Rational(ray.direction[axis]);
    for (const Rational& x : {way, Rational(ray.origin[axis]) + way})
      if (!is_number(x, scalar)) return false;
  }
  return true;
}
/// Triangles, lines and hulls are taken by their corners.
bool has_center_and_size(const Line& /*line*/, Scalar /*scalar*/) { return true; }
template <class Cornered>
requires requires(Cornered shape) { shape.vertices; }
bool has_center_and_size(const Cornered& /*shape*/, Scalar /*scalar*/) { return true; }
/// A rotated box has a rotation, whose matrix is of numbers where it changes axes, as after quarter turns, and seldom else.
bool has_rotation(const Obb& box, Scalar scalar) {
  if (!std::all_of(box.orientation.begin(), box.orientation.end(), [](double x) { return std::isfinite(x); }))
    return true;
  const Obb turned{Vector3::Zero(), box.orientation, Vector3::Zero()};
  const auto core = core_of([](double x) { return Rational(x); }, turned);
  if (CGAL::is_zero(*core.over)) return true;
  return std::all_of(core.outward.begin(), core.outward.end(), [&](const Point& column) {
    return std::all_of(column.begin(), column.end(),
                       [&](const Rational& number) { return is_number(number / *core.over, scalar); });
  });
}
bool has_center_and_size(const Obb& box, Scalar scalar) {
  return !box.extents.allFinite() || std::all_of(box.extents.begin(), box.extents.end(), [&](double extent) {
    return is_number(Rational(2) * Rational(extent), scalar);
  });
}

}  // namespace

std::optional<std::string_view> not_served(const Query& query, const Declaration& declared) {
  const Conventions& c = declared.conventions;
  const auto serves = [&](const auto& scale) {
    if (scale.scale_min == 0 && !std::isfinite(scale.scale_max)) return true;
    bool within = true;
    for_each_number_unnamed(query, [&](double x) {
      if (x != 0 && std::isfinite(x))
        within = within && std::abs(x) >= scale.scale_min && std::abs(x) <= scale.scale_max;
    });
    return within;
  };
  if (!serves(c)) return "numbers outside the scale that the engine declares";
  if (declared.tolerance && !serves(*declared.tolerance)) return "numbers outside the scale of the tolerance";
  bool is_centered = true;
  if (c.shapes == ShapesAs::centered)
    for_each_shape(query, [&]<class Shape>(const Shape& shape) {
      is_centered = is_centered && has_center_and_size(shape, declared.scalar);
      // Who says that orientations are rounded is asked about all.
      if constexpr (std::same_as<Shape, Obb>)
        is_centered = is_centered && (declared.rounds_orientation || has_rotation(shape, declared.scalar));
    });
  if (!is_centered) return "shapes whose centre, size, direction or end is no number of the engine's scalar";
  return std::nullopt;
}

std::optional<PointOn> point_of(const Conventions& conventions, const Query& query, int sphere) {
  switch (conventions.points) {
    case Points::nearest_surface:
      return PointOn::nearest_surface;
    case Points::center: {
      const bool rigid = sphere == 0 ? query.first_is_rigid() : query.second_is_rigid();
      return rigid ? PointOn::nearest_surface : PointOn::center;
    }
    case Points::published:
      return PointOn::far_surface;
    case Points::first_only:
      return sphere == 0 ? std::optional(PointOn::nearest_surface) : std::nullopt;
    case Points::second_only:
      return sphere == 1 ? std::optional(PointOn::nearest_surface) : std::nullopt;
    case Points::midpoint:
    case Points::manifold:
    case Points::none:
      break;
  }
  return std::nullopt;
}

FieldVerdict grade(double claim, const Exact& x, const Yardstick& by) {
  const DefaultEnvironment environment;
  if (is_correctly_rounded(claim, x, by.scalar)) return {};
  if (!std::isfinite(claim)) return {Grade::not_finite, 0};
  const Rational unit = ulp(by.scale, by.scalar);
  const double error = error_in_units(Rational(claim), x, unit);
  const Off off = by.detail == Detail::needs ? length_off(x.plus(-Rational(claim)), by.scale, by.tolerance) : Off{};
  if (is_faithful(claim, x, by.scalar)) return {Grade::faithful, error, off};
  return {is_within(Rational(claim), x, Rational(by.bound) * unit) ? Grade::bounded : Grade::beyond_bound, error, off};
}

void Off::merge(const Off& other) {
  most = std::max(most, other.most);
  relative = std::max(relative, other.relative);
  within = within && other.within;
}
void Off::take_lesser(const Off& other) {
  most = std::min(most, other.most);
  relative = std::min(relative, other.relative);
  within = within || other.within;
}

Off Verdict::beyond_last_bit(Measure measure) const {
  if (measure == Measure::decision) return decision_last_bit || decision_rounded ? Off{} : at(measure);
  Off rest;
  bool any = false;
  for (const auto& field : fields)
    if (field) {
      const Off& need = field->needs[static_cast<std::size_t>(measure)];
      any = any || (field->last_bit && need.most > 0);
      if (!field->last_bit) rest.merge(need);
    }
  return any ? rest : at(measure);
}
bool Verdict::beyond_any() const {
  return status != Claim::Status::answered || answered_outside_domain || !missing.empty() || not_finite() ||
         no_number_beside;
}
bool Verdict::within() const {
  return !beyond_any() && std::all_of(off.begin(), off.end(), [](const Off& measure) { return measure.within; });
}

bool Verdict::not_finite() const {
  return std::any_of(fields.begin(), fields.end(), [](const auto& f) { return f && f->grade == Grade::not_finite; });
}

Level Verdict::level() const {
  if (status != Claim::Status::answered || answered_outside_domain || missed_hit() || !missing.empty())
    return Level::none;
  if (false_hit()) return Level::conservative;
  Level level = Level::correctly_rounded;
  for (const auto& field : fields) {
    if (!field) continue;
    switch (field->grade) {
      case Grade::correctly_rounded:
        break;
      case Grade::faithful:
        level = std::max(level, Level::faithful);
        break;
      case Grade::bounded:
        level = std::max(level, Level::bounded);
        break;
      case Grade::beyond_bound:
      case Grade::not_finite:
        level = std::max(level, Level::decisions);
        break;
    }
  }
  return level;
}

Verdict judge(const Query& query, const Truth& truth, const Claim& claim, const Declaration& declared,
              const Expectation* rounded, Detail detail) {
  const DefaultEnvironment environment;
  const Conventions& conventions = declared.conventions;
  Verdict verdict;
  verdict.status = claim.status;
  verdict.text = claim.text;
  bool contact_expected = expected_hit(query, truth, conventions.touching_contact, conventions.margin);
  if (conventions.coincident == Coincident::no_contact && truth.coincident()) contact_expected = false;
  verdict.has_numbers = truth.has_numbers() && contact_expected;
  if (claim.status != Claim::Status::answered) return verdict;

  // What is not declared is not judged.
  const Aspects claimed = declared.claimed();
  const bool says_overlap = claim.overlap && claimed.has(Aspect::overlap);
  const bool says_contact = claim.speaks_of_contact && claimed.has(Aspect::contact);
  const bool overlap_expected = expected_hit(query, truth, conventions.touching_overlap, conventions.margin);
  if (!says_overlap && !says_contact) {
    verdict.status = Claim::Status::error;
    verdict.text = claim.overlap || claim.speaks_of_contact ? "the answer claims nothing that the engine declares"
                                                            : "the answer makes no claim";
    return verdict;
  }
  verdict.missing =
      missing_aspects(query.pair, claim, declared, truth.has_numbers(), overlap_expected, contact_expected);
  if (says_overlap) {
    verdict.overlap = decide(*claim.overlap, overlap_expected);
    verdict.overlap_expected = overlap_expected;
  }
  if (says_contact) {
    verdict.contact = decide(claim.contact.has_value(), contact_expected);
    verdict.contact_expected = contact_expected;
  }
  const auto is_wrong = [](Decision decision) {
    return decision == Decision::missed_hit || decision == Decision::false_hit;
  };
  if (is_wrong(verdict.overlap) || is_wrong(verdict.contact)) {
    const bool by_alarm = conventions.margin != Margin::none;
    Off off = decision_off(query, truth, by_alarm, declared.tolerance);
    // Where centres that coincide have no contact, the answer changes there too.
    if (!is_wrong(verdict.overlap) && conventions.coincident == Coincident::no_contact && truth.has_distance())
      off.take_lesser(meeting_off(query, *truth.distance(), by_alarm, declared.tolerance));
    verdict.off[static_cast<std::size_t>(Measure::decision)] = off;
  }
  if (!says_contact) return verdict;
  if (!claim.contact) return verdict;
  const auto judged = [&] {
    return ContactJudge(query, truth, contact_expected, *claim.contact, declared,
                        rounded != nullptr && rounded->contact ? &*rounded->contact : nullptr, detail)
        .fields();
  };
  // A false hit that a tolerance allows has numbers, which must be right too.
  if (contact_expected && (rounded != nullptr ? rounded->contact.has_value() : truth.contact_has_numbers()))
    add_needs(verdict, verdict.fields = judged());
  else if (!contact_expected && truth.has_distance() && detail == Detail::needs)
    add_needs(verdict, judged());
  return verdict;
}

Verdict judge_outside_domain(const Claim& claim) {
  Verdict verdict;
  verdict.refused_outside_domain = claim.status == Claim::Status::rejected || claim.status == Claim::Status::error;
  if (verdict.refused_outside_domain) return verdict;
  verdict.status = claim.status;
  verdict.text = claim.text;
  verdict.answered_outside_domain = claim.status == Claim::Status::answered;
  return verdict;
}

}  // namespace contact::oracle
