// What all right answers to a question have in common.
#include "oracle/judge/certain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "oracle/judge/off.hpp"
#include "oracle/judge/right_claim.hpp"
#include "oracle/truth/default_environment.hpp"
#include "oracle/truth/exact_truth.hpp"
#include "oracle/truth/staged_oracle.hpp"

namespace contact::oracle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Whoever compares a normal in binary64 divides it by its length, and rounds some ten times.
constexpr double kRoundings = 0x1p-49;
/// Shapes are moved by so many tolerances to see whether the answer jumps: far enough for several moves at once, and so
/// little that a jump is told from what follows a move, by twice as much at most.
constexpr std::array kMoves{16.0, 1.0, 0x1p-4};
constexpr double kFollows = 2;

double rounded_up(const Rational& x) { return CGAL::to_interval(x).second; }
double in_binary64(const Exact& x) { return round_to_nearest(x, Scalar::binary64); }
/// 2^-p
double unit_roundoff(Scalar scalar) { return std::ldexp(1.0, -format_of(scalar).precision); }
double largest_number(Scalar scalar) { return next_down(kInfinity, scalar); }

/// Where a number of all right answers lies.
struct Reach {
  double low;
  double high;

  void add(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
};
/// The same of a field's numbers, with what is allowed beside them.
struct FieldReach {
  std::vector<Reach> numbers;
  double allowed = 0;
};

Near near_to(const Reach& reach, double allowed, Scalar scalar) {
  const double middle = reach.low == reach.high ? reach.low : reach.low / 2 + reach.high / 2;
  const double beside = std::max(reach.high - middle, middle - reach.low);
  const double size = std::max(std::abs(reach.low), std::abs(reach.high));
  if (!(size <= largest_number(scalar))) return {middle, kInfinity};
  // A number that is rounded as well as can be is right whatever is allowed; what is expected has been rounded too.
  const Exact reached{Rational(size)};
  const double rounding = rounded_up(ulp(reached, scalar) / Rational(2));
  const double own = rounded_up(ulp(reached, Scalar::binary64) * Rational(2));
  return {middle, std::nextafter(beside + std::max(allowed, rounding) + own, kInfinity)};
}

/// How far some numbers of the answer jump where the shapes move by some tolerances.
struct Jump {
  bool normal = false;
  std::array<std::array<Reach, 3>, 2> feet{};  ///< of the nearest points of both cores
};

class Gathering {
 public:
  Gathering(const Query& query, const DistanceTruth& contact, const Declaration& declared)
      : query_(query), contact_(contact), declared_(declared), is_cast_(contact.cast() != nullptr) {
    any_ = is_cast_ ? contact.cast()->inside || contact.cast()->against
                    : contact.coincident() && declared.conventions.coincident != Coincident::zero_normal;
    add(contact);
    // Of several ways out that are as short, an engine may have taken any.
    if (!is_cast_ && contact.meets() && !contact.coincident())
      for (std::size_t way = 1; way < contact.meeting().ways.size(); ++way) add(contact.by_way(way));
    if (is_cast_ && contact.cast()->either_side && !normals_.empty())
      normals_.push_back(Vector3::Zero() - normals_.front());
    for (const int shape : {0, 1}) points_[index(shape)].allowed = beside_point(shape);
    points_[2].allowed = std::max(points_[0].allowed, points_[1].allowed);
    value_.allowed = beside(contact.value_scale(), declared.bounds.value, Rational(0));
    if (any_) turn_round();
  }

  /// Adds what else is right within a tolerance, as the answer jumps there.
  void add_jumps() {
    const double size = std::max(in_binary64(contact_.point_scale(0)), in_binary64(contact_.point_scale(1)));
    const double step = declared_.tolerance->length + declared_.tolerance->relative * size;
    if (any_ || step == 0) return;
    const bool has_direction = !is_cast_ && !has_plane(query_.pair) && has_distance(query_.pair);
    const double distance = has_direction ? std::abs(in_binary64(contact_.core_distance())) : size;
    const Jump jump = jump_of(size, distance, step);
    for (const int shape : {0, 1})
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Reach& way = jump.feet[index(shape)][axis];
        widen(points_[index(shape)], axis, way.low, way.high);
        widen(points_[2], axis, way.low, way.high);
      }
    // A length turns a normal as well as an angle does, and where the cores are as near as that, all the way round.
    if (jump.normal || (has_direction && distance <= 4 * kMoves.front() * step)) {
      any_ = true;
      turn_round();
    } else if (has_direction) {
      turn_ = std::asin(step / distance);
    }
  }

  [[nodiscard]] Certain gathered() const {
    Certain all;
    all.hit = true;
    if (!any_) all.normals = normals_;
    all.normal_allowed = normal_allowed();
    for (const FieldReach* field : {&points_[0], &points_[1], &points_[2], &value_})
      for (const Reach& reach : field->numbers) all.numbers.push_back(near_to(reach, field->allowed, declared_.scalar));
    return all;
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  /// What is allowed beside a number of this scale. A point that goes with a claimed normal has room for its rounding.
  [[nodiscard]] double beside(const Exact& scale, double bound, const Rational& room) const {
    if (const auto& t = declared_.tolerance)
      return rounded_up(Rational(t->length) + Rational(t->relative) * scale.enclosure(64).high + room);
    return rounded_up(Rational(bound) * ulp(scale, declared_.scalar) + room);
  }
  [[nodiscard]] double beside_point(int shape) const {
    const Rational room = Rational(8 * unit_roundoff(declared_.scalar)) * contact_.radius(shape);
    return beside(contact_.point_scale(shape), declared_.bounds.point, contact_.degenerate() ? room : Rational(0));
  }

  static void widen(FieldReach& field, std::size_t axis, double low, double high) {
    if (field.numbers.empty()) return;
    field.numbers[axis].low += low;
    field.numbers[axis].high += high;
  }
  /// Any normal is right, so that a point may lie anywhere around its core.
  void turn_round() {
    for (const int shape : {0, 1}) {
      const double across = 2 * in_binary64(Exact(contact_.radius(shape)));
      points_[index(shape)].allowed += across;
      points_[2].allowed += across;
    }
  }

  void add(const DistanceTruth& way) {
    Declaration in_binary64_too = declared_;
    in_binary64_too.scalar = Scalar::binary64;
    const ContactClaim claim = right_contact(query_, way, in_binary64_too);
    if (claim.normal) normals_.push_back(*claim.normal);
    add(points_[0], claim.point1, way.spread());
    add(points_[1], claim.point2, way.spread());
    add(points_[2], claim.point, way.spread());
    if (claim.value) value_.numbers = {{*claim.value, *claim.value}};  // every way is as long
  }
  static void add(FieldReach& field, const std::optional<Vector3>& point, const Spread& spread) {
    if (!point) return;
    const bool is_first = field.numbers.empty();
    for (int axis = 0; axis < 3; ++axis) {
      const double x = (*point)[axis];
      if (is_first) field.numbers.push_back({x, x});
      Reach& reach = field.numbers[index(axis)];
      reach.add(x);
      for (const Point& far : spread) reach.add(x + in_binary64(Exact(far[index(axis)])));
    }
  }

  [[nodiscard]] double normal_allowed() const {
    const double u = unit_roundoff(declared_.scalar);
    if (const auto& t = declared_.tolerance) {
      const double angle = std::max(t->angle, turn_);
      return (angle < std::numbers::pi ? std::max(2 * std::sin(angle / 2), 2 * u) : 2) + kRoundings;
    }
    const double component = declared_.bounds.normal * 2 * u + 0x1p-53;
    return compares_directions(declared_) ? std::sqrt(3) * component + kRoundings : component;
  }

  /// Where the answer jumps to where a number of a shape is moved by some times `step`, or where a turn moves by as much
  /// what is `size` away.
  [[nodiscard]] Jump jump_of(double size, double distance, double step) const {
    Jump jump;
    const double farthest = kMoves.front() * step;
    const StagedAnswer here = staged_answer(reaching(query_, distance, farthest), Scalar::binary64);
    const auto look = [&](const Query& moved, double by) {
      const Query asked = reaching(moved, distance, farthest);
      if (!inside_domain(asked)) return;
      const StagedAnswer there = staged_answer(asked, Scalar::binary64);
      if (!there.expected.contact) return;
      const Contact& contact = *there.expected.contact;
      const double turned = (contact.normal - here.expected.contact->normal).norm();
      jump.normal = jump.normal || !(turned <= std::max(declared_.tolerance->angle, kFollows * by / distance)) ||
                    (contact.degenerate && has_distance(query_.pair));
      for (const int shape : {0, 1}) {
        const Vector3 way = foot(contact, shape) - foot(*here.expected.contact, shape);
        if (way.cwiseAbs().maxCoeff() <= kFollows * by) continue;
        for (int axis = 0; axis < 3; ++axis) jump.feet[index(shape)][index(axis)].add(way[axis]);
      }
    };
    Query moved = query_;
    for_each_field(moved, [&](const std::string& field, auto& value, FieldKind kind) {
      if (field == "alarm" || field == "contact" || kind == FieldKind::offset) return;
      double unit = 1;
      if (has_free_length(kind)) {
        unit = 0;
        for_each_number_in(value, [&](const double& x) { unit = std::max(unit, std::abs(x)); });
        unit /= size;
      }
      for_each_number_in(value, [&](double& x) {
        const double before = x;
        for (const double times : kMoves)
          for (const double by : {-times * step, times * step}) {
            x = before + by * unit;
            look(moved, std::abs(by));
          }
        x = before;
      });
    });
    return jump;
  }
  /// The same question with an alarm distance that makes a hit of it, moved or not; the largest number where that is not enough.
  [[nodiscard]] static Query reaching(Query query, double distance, double by) {
    if (has_distance(query.pair))
      query.distances.alarm = std::min(std::max(query.distances.alarm, 2 * distance + 4 * kFollows * by),
                                       std::numeric_limits<double>::max());
    return query;
  }
  [[nodiscard]] Vector3 foot(const Contact& contact, int shape) const {
    const double radius = in_binary64(Exact(contact_.radius(shape)));
    return shape == 0 ? Vector3(contact.point1 - radius * contact.normal)
                      : Vector3(contact.point2 + radius * contact.normal);
  }

  const Query& query_;
  const DistanceTruth& contact_;
  const Declaration& declared_;
  bool is_cast_;
  bool any_;         ///< any normal is right
  double turn_ = 0;  ///< by which angle a length turns a normal
  std::vector<Vector3> normals_;
  std::array<FieldReach, 3> points_{};  ///< point1, point2 and point
  FieldReach value_{};
};

/// Whether the tolerance allows either decision.
bool either_is_right(const Query& query, const Truth& truth, const Declaration& declared) {
  if (!declared.tolerance) return false;
  const Conventions& c = declared.conventions;
  const bool by_alarm = c.margin != Margin::none;
  if (decision_off(query, truth, by_alarm, declared.tolerance).within) return true;
  return c.coincident != Coincident::any_unit_normal && truth.has_distance() &&
         meeting_off(query, *truth.distance(), by_alarm, declared.tolerance).within;
}

}  // namespace

Certain certain(const Query& query, const Declaration& declared) {
  const DefaultEnvironment environment;
  Certain all;
  if (not_served(query, declared)) {
    all.left_out = "no question for an engine that declares this scale or these shapes";
    return all;
  }
  const StagedAnswer staged = staged_answer(query, declared.scalar);
  if (either_is_right(query, staged.truth, declared)) {
    all.left_out = "either decision is within the tolerance";
    return all;
  }
  const Claim claim = right_claim(query, staged.truth, declared);
  if (!claim.speaks_of_contact) all.hit = *claim.overlap;
  if (!claim.contact) return all;
  Gathering gathering(query, *staged.truth.contact(), declared);
  if (declared.tolerance) gathering.add_jumps();
  all = gathering.gathered();
  if (!std::all_of(all.numbers.begin(), all.numbers.end(), [&](const Near& number) {
        return std::abs(number.expected) + number.allowed <= largest_number(declared.scalar);
      }))
    all.left_out = "a number of the answer may be beyond the range of the scalar";
  return all;
}

bool compares_directions(const Declaration& declared) {
  return declared.tolerance.has_value() || !declared.conventions.normal_unit;
}

double unit_allowed(const Declaration& declared) {
  if (!declared.conventions.normal_unit) return std::numeric_limits<double>::max();
  const double rounding = 4 * unit_roundoff(declared.scalar);
  return (declared.tolerance ? std::max(declared.tolerance->angle, rounding) : rounding) + kRoundings;
}

}  // namespace contact::oracle
