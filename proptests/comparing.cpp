// Two answers held against each other as an engine's declaration allows.
#include "proptests/comparing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "formats/json.hpp"
#include "oracle/diagnosis/nearest_in_reals.hpp"
#include "oracle/judge/off.hpp"
#include "oracle/truth/casts.hpp"
#include "oracle/truth/exact_truth.hpp"

namespace contact::proptests {
namespace {

constexpr int kScaleBits = 64;

/// | sqrt(D) - reach | within four times the value's bound: an engine may decide by squares, and square its reach.
bool distance_undecided(const Case& c, const oracle::DistanceTruth& truth, bool alarm_counts) {
  const Rational& reach = alarm_counts ? truth.reach() : truth.radii();
  const Rational unit = oracle::ulp(oracle::Exact(reach), c.subject.info.declared.scalar);
  const oracle::Exact distance(Rational(0), Rational(1), truth.distance2());
  return oracle::is_within(reach, distance, Rational(4 * c.subject.bound(Field::value)) * unit);
}

/// An end, or the place where the line goes through the plane, lies so near to the boundary that the roundings of an
/// engine may tell otherwise: eight times the value's bound, more where the segment or the triangle is slanted or thin.
bool crossing_undecided(const Case& c, std::size_t i) {
  double scale = 0;
  for_each_number(c.queries[i], [&](const std::string&, double x) { scale = std::max(scale, std::abs(x)); });
  const double ulp =
      oracle::round_to_nearest(oracle::ulp(Rational(scale), c.subject.info.declared.scalar), Scalar::binary64);
  const auto is_near = [&](const oracle::CrossingInReals& x) {
    const oracle::Real slant =
        std::abs(x.through()) / std::max(x.along.stableNorm(), std::numeric_limits<oracle::Real>::min());
    return x.slack() * x.sine * slant <= 8 * c.subject.bound(Field::value) * oracle::Real{ulp};
  };
  if (const auto* ray = std::get_if<RayAndTriangle>(&c.queries[i].shapes))
    return is_near(oracle::CrossingInReals(*ray));
  return is_near(oracle::CrossingInReals(std::get<TriangleAndLine>(c.queries[i].shapes)));
}

/// Whether a ray that is cast comes so near to the other decision that the roundings of an engine may tell otherwise:
/// sixty-four times the value's bound, more where a small shape is far away, a triangle slanted or thin.
bool cast_undecided(const Case& c, std::size_t i) {
  double scale = 0;
  for_each_field(c.queries[i], [&](const std::string&, const auto& value, FieldKind kind) {
    if (kind == FieldKind::point) for_each_number_in(value, [&](double x) { scale = std::max(scale, std::abs(x)); });
  });
  return std::visit(
      [&]<class A, class B>(const Two<A, B>& shapes) {
        if constexpr (std::same_as<A, Cast>) {
          double times = 1;
          if constexpr (requires { shapes.b.radius; }) {
            scale = std::max(scale, shapes.b.radius);
            times += scale / shapes.b.radius;
          }
          if constexpr (std::same_as<B, Triangle>) {
            const oracle::CrossingInReals x(RayAndTriangle{shapes.a, shapes.b});
            times /= static_cast<double>(x.sine * std::abs(x.through()) / x.along.stableNorm());
          }
          if constexpr (std::same_as<B, Plane>)
            times += std::abs(shapes.b.offset) / (scale * shapes.b.normal.stableNorm());
          if (!(times < 1e100)) return true;
          const oracle::Exact off = oracle::distance_to_change(shapes, c.truth(i).hit());
          const Rational unit = oracle::ulp(Rational(scale), c.subject.info.declared.scalar);
          return oracle::is_within(Rational(0), off, Rational(64 * c.subject.bound(Field::value) * times) * unit);
        }
        return false;
      },
      c.queries[i].shapes);
}

/// Whether more than one normal is right where a ray hits.
bool has_many_normals(const Case& c, std::size_t i) {
  const oracle::CastHit* hit =
      c.truth(i).cast() != nullptr && c.truth(i).contact() != nullptr ? c.truth(i).contact()->cast() : nullptr;
  return hit != nullptr && (hit->inside || hit->either_side || hit->against);
}

/// On some axis | gap - alarm | within the value's bound, at the largest number that it is computed from.
bool cubes_undecided(const Case& c, const oracle::GapTruth& truth, bool alarm_counts, const Query& query) {
  const Boxes& boxes = *query.boxes();
  double scale = alarm_counts ? query.distances.alarm : 0;
  for (const Box* box : {&boxes.a, &boxes.b})
    scale = std::max({scale, box->min.cwiseAbs().maxCoeff(), box->max.cwiseAbs().maxCoeff()});
  const Rational most =
      Rational(c.subject.bound(Field::value)) * oracle::ulp(Rational(scale), c.subject.info.declared.scalar);
  return std::any_of(truth.gap().begin(), truth.gap().end(), [&](const Rational& gap) {
    return CGAL::abs(gap - (alarm_counts ? truth.alarm() : Rational(0))) <= most;
  });
}

/// The length whose ulp is the unit of a field's errors.
oracle::Exact scale_of(const Case& c, std::size_t i, Field field) {
  if (field == Field::normal) return Rational(1);
  const oracle::DistanceTruth* truth = c.truth(i).cast() != nullptr ? c.truth(i).contact() : c.truth(i).distance();
  if (truth != nullptr)
    return field == Field::value ? truth->value_scale()
                                 : oracle::larger_of(truth->point_scale(0), truth->point_scale(1));
  double largest = 0;  // of a crossing or a cast, which need not be one
  for_each_number(c.queries[i], [&](const std::string&, double x) { largest = std::max(largest, std::abs(x)); });
  return Rational(largest);
}

/// Domain: a normal only where there is no tolerance.
Rational allowance_at(const Case& c, const oracle::Exact& scale, Field field) {
  if (const auto& tolerance = c.subject.tolerance())
    return Rational(tolerance->length) + Rational(tolerance->relative) * scale.enclosure(kScaleBits).high;
  return Rational(c.subject.bound(field)) * oracle::ulp(scale, c.subject.info.declared.scalar);
}

struct Component {
  std::string name;
  double got;
  double wanted;
  double before;
};

/// The claimed numbers of a field in three claims, component by component.
std::vector<Component> components(Field field, const ContactClaim& got, const ContactClaim& wanted,
                                  const ContactClaim& before) {
  const auto vector = [&](const auto& member) {
    std::vector<Component> found;
    if (got.*member && wanted.*member && before.*member)
      for (int axis = 0; axis < 3; ++axis)
        found.push_back({fmt::format("{}[{}]", name(field), axis), (*(got.*member))[axis], (*(wanted.*member))[axis],
                         (*(before.*member))[axis]});
    return found;
  };
  switch (field) {
    case Field::normal:
      return vector(&ContactClaim::normal);
    case Field::point1:
      return vector(&ContactClaim::point1);
    case Field::point2:
      return vector(&ContactClaim::point2);
    case Field::point:
      return vector(&ContactClaim::point);
    case Field::points:  // an engine may take any of those that are right
      return {};
    case Field::value:
      break;
  }
  if (!got.value || !wanted.value || !before.value) return {};
  return {{"value", *got.value, *wanted.value, *before.value}};
}

}  // namespace

bool undecided(const Case& c, std::size_t i) {
  if (c.subject.correctly_rounded) return false;
  const bool alarm_counts = c.subject.info.declared.conventions.margin != Margin::none;
  const oracle::Truth& truth = c.truth(i);
  if (c.subject.tolerance())
    return oracle::decision_off(c.queries[i], truth, alarm_counts, c.subject.tolerance()).within;
  if (truth.crossing() != nullptr) return crossing_undecided(c, i);
  if (truth.cast() != nullptr) return cast_undecided(c, i);
  return truth.has_distance() ? distance_undecided(c, *truth.distance(), alarm_counts)
                              : cubes_undecided(c, *truth.gaps(), alarm_counts, c.queries[i]);
}

std::optional<std::string> different_decisions(const Case& c, std::size_t i, std::size_t j) {
  if (undecided(c, i) || undecided(c, j)) return std::nullopt;
  const auto said = [](bool yes, std::string_view what) { return fmt::format("{}{}", yes ? "" : "no ", what); };
  const Claim& x = c.claims[i];
  const Claim& y = c.claims[j];
  if (x.overlap && y.overlap && *x.overlap != *y.overlap)
    return fmt::format("{} for question {}, {} for question {}", said(*x.overlap, "overlap"), i + 1,
                       said(*y.overlap, "overlap"), j + 1);
  if (x.speaks_of_contact && y.speaks_of_contact && x.contact.has_value() != y.contact.has_value())
    return fmt::format("{} for question {}, {} for question {}", said(x.contact.has_value(), "contact"), i + 1,
                       said(y.contact.has_value(), "contact"), j + 1);
  return std::nullopt;
}

std::optional<std::string> different_numbers(const Case& c, std::size_t i, std::size_t j, const ContactClaim& wanted,
                                             std::initializer_list<Field> fields, int exponent) {
  if (parts_anywhere(c, i) || parts_anywhere(c, j)) return std::nullopt;
  const bool exactly = c.subject.correctly_rounded;
  const double normal = std::ldexp(1.0, format_of(c.subject.info.declared.scalar).min_exponent);
  for (const Field field : fields) {
    if (!c.subject.claims(field)) continue;
    if (may_jump(c, i, field) || (field == Field::normal && may_jump(c, j, field))) continue;
    const int scaled = field == Field::normal ? 0 : exponent;
    for (const Component& x : components(field, *c.contact(j), wanted, *c.contact(i))) {
      if (x.got == x.wanted || std::isnan(x.got) || std::isnan(x.wanted)) continue;
      if (exactly && scaled != 0 &&
          (!std::isfinite(x.before) || !std::isfinite(x.wanted) || std::abs(x.before) < normal ||
           std::abs(x.wanted) < normal || std::abs(x.got) < normal))
        continue;
      if (!exactly) {
        if (!std::isfinite(x.got) || !std::isfinite(x.wanted)) continue;
        const Rational factor = oracle::power_of_two(scaled);
        const Rational most = std::max(allowance(c, j, field), Rational(allowance(c, i, field) * factor));
        if (!std::isfinite(x.before)) continue;
        const Rational expected = scaled == 0 ? Rational(x.wanted) : Rational(Rational(x.before) * factor);
        const Rational off = CGAL::abs(Rational(x.got) - expected);
        if (off <= Rational(2) * most) continue;
      }
      return fmt::format("{} of question {} is {}, and question {} makes it {}", x.name, j + 1, text(x.got), i + 1,
                         text(x.wanted));
    }
  }
  return std::nullopt;
}

bool may_jump(const Case& c, std::size_t i, Field field) {
  if (field == Field::normal) return has_many_normals(c, i);
  if (field == Field::value || !c.truth(i).has_distance()) return false;
  const oracle::Spread& spread = c.truth(i).distance()->spread();
  return c.subject.correctly_rounded ? spread.size() > 2 : !spread.empty();
}

bool says_hit(const Claim& claim) {
  return claim.overlap.value_or(false) || (claim.speaks_of_contact && claim.contact);
}

bool coincident(const Case& c, std::size_t i) {
  if (c.truth(i).degenerate()) return true;
  const oracle::DistanceTruth* distance = c.truth(i).distance();
  // Of facets that are as near, or by rounding may seem so, each question may be answered with another.
  return distance != nullptr && distance->overlaps() &&
         (distance->meeting().ways.size() > 1 || !c.subject.correctly_rounded);
}

bool parts_anywhere(const Case& c, std::size_t i) {
  return c.subject.info.declared.conventions.depth == DepthOf::any_separating && c.truth(i).has_distance() &&
         c.truth(i).distance()->overlaps();
}

Rational allowance(const Case& c, std::size_t i, Field field) {
  if (const auto& tolerance = c.subject.tolerance(); tolerance && field == Field::normal) {
    // Turned by the angle, and longer or shorter by as much.
    const Rational angle(tolerance->angle);
    return (Rational(2) + angle) * angle;
  }
  return allowance_at(c, scale_of(c, i, field), field);
}

Rational point_allowance(const Case& c, std::size_t i, int shape) {
  return allowance_at(c, c.truth(i).distance()->point_scale(shape), Field::point1);
}

Vector3 first_to_second(const Conventions& conventions, const Vector3& normal) {
  return conventions.normal == NormalDirection::first_to_second ? normal : Vector3(-normal);
}

Rational signed_distance(const Case& c, std::size_t i, double value) {
  const Conventions& declared = c.subject.info.declared.conventions;
  Rational distance(value);
  if (declared.value == ValueKind::depth) distance = -distance;
  if (declared.value_less_contact) distance += Rational(c.queries[i].distances.contact);
  return distance;
}
std::optional<double> finite_value(const Case& c, std::size_t i) {
  if (!c.subject.claims(Field::value) || c.contact(i) == nullptr) return std::nullopt;
  const auto& value = c.contact(i)->value;
  return value && std::isfinite(*value) ? value : std::nullopt;
}
Rational value_error(const Case& c, std::size_t i) {
  const Rational error = allowance(c, i, Field::value);
  const auto value = finite_value(c, i);
  if (!value) return error;
  const Rational rounding = oracle::ulp(Rational(std::abs(*value)), c.subject.info.declared.scalar) / Rational(2);
  return std::max(error, rounding);
}

std::string text(double x) { return formats::number(x); }
std::string text(const Vector3& v) { return formats::number(v); }

}  // namespace contact::proptests
