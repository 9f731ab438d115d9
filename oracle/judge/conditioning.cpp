// What the last bit of a question's numbers would have done to its answer.
#include "oracle/judge/conditioning.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "oracle/judge/off.hpp"
#include "oracle/judge/right_claim.hpp"
#include "oracle/truth/default_environment.hpp"
#include "oracle/truth/exact_truth.hpp"
#include "oracle/truth/staged_oracle.hpp"

namespace contact::oracle {

struct KnownLastBits {
  /// What an answer is made of, in binary64.
  struct Answer {
    ContactClaim contact;
    Vector3 spread = Vector3::Zero();          ///< the points may lie so far beside
    std::optional<std::array<double, 2>> any;  ///< any normal is right, and the points are so far from the cores
  };
  std::optional<Answer> here;    ///< nothing where the sum is 0
  std::vector<LastBit> numbers;  ///< of the first ones
  bool are_all = false;
  std::vector<bool> idle;  ///< numbers without an effect
};

namespace {

using Answer = KnownLastBits::Answer;

/// The right answer where the points follow from the two nearest ones.
std::optional<Answer> answer_of(const Query& query, const Declaration& declared) {
  const Conventions& conventions = declared.conventions;
  const StagedAnswer staged = staged_answer(query, Scalar::binary64);
  if (!staged.expected.contact) return std::nullopt;
  const Contact& contact = *staged.expected.contact;
  Answer answer;
  if (conventions.points == Points::center || conventions.points == Points::published) {
    Declaration rounded = declared;
    rounded.scalar = Scalar::binary64;
    rounded.conventions.margin = Margin::inclusive;
    rounded.conventions.touching_contact = Touching::closed;
    const Claim right = right_claim(query, staged.truth, rounded);
    if (!right.contact) return std::nullopt;
    answer.contact = *right.contact;
  } else {
    answer.contact = {contact.normal, contact.point1, contact.point2, Vector3(contact.point1 / 2 + contact.point2 / 2),
                      contact.value};
  }
  if (contact.degenerate || !contact.unique)
    if (const DistanceTruth* exact = staged.truth.contact()) {
      for (const Point& far : exact->spread())
        for (int axis = 0; axis < 3; ++axis)
          answer.spread[axis] = std::max(
              answer.spread[axis], std::abs(round_to_nearest(far[static_cast<std::size_t>(axis)], Scalar::binary64)));
      if (exact->coincident())
        answer.any = {round_to_nearest(exact->radius(0), Scalar::binary64),
                      round_to_nearest(exact->radius(1), Scalar::binary64)};
    }
  return answer;
}

double ulp_of(double x) { return std::nextafter(std::abs(x), std::numeric_limits<double>::infinity()) - std::abs(x); }

double angle_between(const Vector3& x, const Vector3& y) {
  constexpr double kRounding = 1e-15;  // of both normals and of this
  return std::max(0.0, std::atan2(x.cross(y).norm(), x.dot(y)) - kRounding);
}
/// Each of the two is half an ulp from the real number at most; a middle has rounded more than once.
double apart(double x, double y, int ulps) {
  return std::max(0.0, std::abs(x - y) - ulps * ulp_of(std::max(std::abs(x), std::abs(y))));
}

/// How far one answer is from another, field by field.
LastBit difference(const Answer& here, const Answer& there) {
  LastBit off;
  const auto at = [&](Field field) -> double& { return off.effect[static_cast<std::size_t>(field)]; };
  const auto point = [&](Field field, const std::optional<Vector3> ContactClaim::*member, int ulps, double radius) {
    const auto& x = here.contact.*member;
    const auto& y = there.contact.*member;
    if (!x || !y) return;
    for (int axis = 0; axis < 3; ++axis)
      at(field) = std::max(at(field), apart((*x)[axis], (*y)[axis], ulps) + there.spread[axis] + radius);
  };
  const std::array<double, 2> radii = there.any.value_or(std::array{0.0, 0.0});
  if (here.contact.normal && there.contact.normal)
    at(Field::normal) = there.any ? std::numbers::pi : angle_between(*here.contact.normal, *there.contact.normal);
  point(Field::point1, &ContactClaim::point1, 1, radii[0]);
  point(Field::point2, &ContactClaim::point2, 1, radii[1]);
  point(Field::point, &ContactClaim::point, 4, (radii[0] + radii[1]) / 2);
  if (here.contact.value && there.contact.value) at(Field::value) = apart(*here.contact.value, *there.contact.value, 1);
  return off;
}

/// Calls visit(neighbour, i) for both neighbours of number i of a question, as far as they lie inside the domain.
/// Where idle[i], it does not.
template <class Visit>
void for_each_neighbour(const Query& query, Scalar scalar, const std::vector<bool>& idle, Visit&& visit) {
  Query moved = query;
  std::size_t i = 0;
  for_each_number(moved, [&](const std::string&, double& x) {
    const double before = x;
    const bool is_idle = i < idle.size() && idle[i];
    for (const double beside : {next_up(before, scalar), next_down(before, scalar)}) {
      x = beside;
      if (before != 0 && !is_idle && inside_domain(moved)) visit(std::as_const(moved), i);
    }
    x = before;
    ++i;
  });
}

/// Whether a vertex lies so far behind another one along a normal, each component of which is off by half an ulp, that
/// it still does after the last bit of one of its numbers moved it.
///   x is the vertex, f the other one, and s the largest number of x/4 and f/4: quarters, whose differences do not
/// overflow. The last bit moves x/4 by at most 2^-23 s, that of binary32, or by a quarter of the least number above 0.
/// n.(f/4 - x/4) is off by 2^-54 * 6s by the normal, by 3 * 2^-52 s by the differences and by less than 2^-49 s by
/// products and sums; what is subnormal rounds by less than 2^-1071. Together less than (2^-23 + 2^-48) s, a quarter of
/// the least number and 2^-1071.
bool is_clearly_behind(const Vector3& vertex, const Vector3& front, const Vector3& normal, Scalar scalar) {
  constexpr double kOfSize = 0x1p-22;
  constexpr double kSubnormal = 0x1p-1070;
  const double size = std::max((vertex / 4).lpNorm<Eigen::Infinity>(), (front / 4).lpNorm<Eigen::Infinity>());
  return normal.dot(front / 4 - vertex / 4) > kOfSize * size + next_up(0, scalar) + kSubnormal;
}

/// The vertices of the two shapes' hulls; nullptr where a shape is none.
std::array<std::vector<Vector3>*, 2> hulls_of(Query& query) {
  std::array<std::vector<Vector3>*, 2> found{};
  std::size_t i = 0;
  for_each_shape(query, [&]<class Shape>(Shape& shape) {
    if constexpr (std::same_as<Shape, Hull>) found[i] = &shape.vertices;
    ++i;
  });
  return found;
}

/// Whether exactly the same points are nearest, or the same way is the shortest one out, and no other is.
bool is_same(const DistanceTruth& x, const DistanceTruth& y) {
  if (x.degenerate() || y.degenerate() || x.overlaps() != y.overlaps() || !y.spread().empty()) return false;
  if (!x.overlaps()) return x.cores().nearest == y.cores().nearest;
  return x.meeting().depth2 == y.meeting().depth2 && x.meeting().ways.size() == 1 && y.meeting().ways.size() == 1;
}

/// The question with as few vertices as it takes to have the same nearest points, or way out, of those that lie clearly behind the others
/// along the normal. None is left out where it has not one normal, and one pair of nearest points.
class FewestVertices {
 public:
  FewestVertices(const Query& query, Scalar scalar) : query_(query), truth_(query) {
    const DistanceTruth* exact = truth_.distance();
    if (exact == nullptr || exact->cast() != nullptr || exact->degenerate() || !exact->spread().empty()) return;
    Vector3 normal;
    for (int axis = 0; axis < 3; ++axis) normal[axis] = round_to_nearest(exact->normal(axis), Scalar::binary64);
    std::vector<Place> behind;
    const auto hulls = hulls_of(query_);
    for (std::size_t shape = 0; shape < hulls.size(); ++shape) {
      if (hulls[shape] == nullptr) continue;
      const std::vector<Vector3>& of = *hulls[shape];
      needed_[shape].assign(of.size(), true);
      const Vector3 out = shape == 0 ? normal : Vector3(-normal);
      const auto front = std::max_element(
          of.begin(), of.end(), [&](const Vector3& x, const Vector3& y) { return out.dot(x / 4) < out.dot(y / 4); });
      for (std::size_t k = 0; k < of.size(); ++k)
        if (is_clearly_behind(of[k], *front, out, scalar)) behind.emplace_back(shape, k);
    }
    leave_out(behind);
  }
  [[nodiscard]] bool is_needed(std::size_t shape, std::size_t k) const {
    return needed_[shape].empty() || needed_[shape][k];
  }

 private:
  using Place = std::pair<std::size_t, std::size_t>;

  /// Those that are not needed, by halves.
  void leave_out(std::span<const Place> some) {
    if (some.empty()) return;
    for (const auto& [shape, k] : some) needed_[shape][k] = false;
    if (is_enough()) return;
    for (const auto& [shape, k] : some) needed_[shape][k] = true;
    if (some.size() == 1) return;
    leave_out(some.first(some.size() / 2));
    leave_out(some.subspan(some.size() / 2));
  }
  [[nodiscard]] bool is_enough() const {
    Query fewer = query_;
    const auto hulls = hulls_of(fewer);
    for (std::size_t shape = 0; shape < hulls.size(); ++shape) {
      if (hulls[shape] == nullptr) continue;
      std::size_t k = 0;
      std::erase_if(*hulls[shape], [&](const Vector3&) { return !needed_[shape][k++]; });
    }
    const Truth truth(fewer);
    return is_same(*truth_.distance(), *truth.distance());
  }

  Query query_;
  Truth truth_;
  std::array<std::vector<bool>, 2> needed_;
};

/// The signed distance from where the decision changes; nothing of a pair that has none.
std::optional<Exact> beyond(const Query& query, const Truth& truth, const Declaration& declared) {
  const bool at_alarm = declared.conventions.margin != Margin::none && query.distances.alarm != 0;
  if (const DistanceTruth* distance = truth.distance())
    return distance->beyond(at_alarm ? distance->reach() : distance->radii());
  if (const GapTruth* gaps = truth.gaps()) return Exact(gaps->widest_gap() - (at_alarm ? gaps->alarm() : Rational(0)));
  return std::nullopt;
}

/// The largest length that a decision is computed from.
double largest_length(const Query& query, const Truth& truth) {
  double largest = 0;
  for_each_number_unnamed(query, [&](double x) { largest = std::max(largest, std::abs(x)); });
  if (const DistanceTruth* distance = truth.distance())
    for (const Exact& scale : {distance->value_scale(), distance->point_scale(0), distance->point_scale(1)})
      largest = std::max(largest, round_to_nearest(scale, Scalar::binary64));
  if (const auto* ray = std::get_if<RayAndTriangle>(&query.shapes))
    largest = std::max(largest, ray->a.length * ray->a.direction.lpNorm<Eigen::Infinity>() * 2);
  return largest;
}

/// What answer_of reads of a declaration.
Declaration read_of(const Declaration& declared) {
  Declaration read;
  read.scalar = declared.scalar;
  const Points points = declared.conventions.points;
  if (points == Points::center || points == Points::published) read.conventions = declared.conventions;
  return read;
}

KnownLastBits& known_of(const Query& query, const Declaration& declared, LastBits& known) {
  const Declaration read = read_of(declared);
  const auto found = std::find_if(known.begin(), known.end(), [&](const auto& entry) { return entry.first == read; });
  if (found != known.end()) return *found->second;
  auto added = std::make_shared<KnownLastBits>();
  added->here = answer_of(query, declared);
  if (added->here && (added->here->any || !added->here->spread.isZero(0))) added->here.reset();
  const bool is_nearest =
      declared.conventions.points != Points::center && declared.conventions.points != Points::published;
  if (added->here && is_nearest) added->idle = numbers_without_effect(query, declared.scalar);
  return *known.emplace_back(read, std::move(added)).second;
}

}  // namespace

std::vector<bool> numbers_without_effect(const Query& query, Scalar scalar) {
  const DefaultEnvironment environment;
  Query asked = query;
  const auto hulls = hulls_of(asked);
  if (hulls[0] == nullptr && hulls[1] == nullptr) return {};
  const FewestVertices fewest(query, scalar);
  std::vector<bool> idle;
  for_each_number(asked, [&](const std::string&, const double& x) {
    bool is_idle = false;
    for (std::size_t shape = 0; shape < hulls.size(); ++shape) {
      if (hulls[shape] == nullptr) continue;
      for (std::size_t k = 0; k < hulls[shape]->size(); ++k) {
        const Vector3& vertex = (*hulls[shape])[k];
        if (&x == &vertex[0] || &x == &vertex[1] || &x == &vertex[2]) is_idle = !fewest.is_needed(shape, k);
      }
    }
    idle.push_back(is_idle);
  });
  return idle;
}

namespace {

/// The effect, or what is more than enough of it: it only grows.
LastBit last_bit_until(const Query& query, const Declaration& declared, LastBits& all, const auto& is_enough) {
  const DefaultEnvironment environment;
  LastBit sum;
  KnownLastBits& known = known_of(query, declared, all);
  if (!known.here) return sum;
  const auto is_enough_with = [&](const LastBit& number) {
    for (std::size_t f = 0; f < sum.effect.size(); ++f) sum.effect[f] += number.effect[f];
    return is_enough(sum);
  };
  if (std::any_of(known.numbers.begin(), known.numbers.end(), is_enough_with) || known.are_all) return sum;
  LastBit larger;
  bool is_done = false;
  const auto end_number = [&] {
    known.numbers.push_back(larger);
    is_done = is_enough_with(std::exchange(larger, {}));
  };
  for_each_neighbour(query, declared.scalar, known.idle, [&](const Query& neighbour, std::size_t i) {
    if (is_done || i < known.numbers.size()) return;
    while (!is_done && known.numbers.size() < i) end_number();
    if (is_done) return;
    const auto there = answer_of(neighbour, declared);
    if (!there) return;  // a miss: the neighbour on the other side tells
    const LastBit off = difference(*known.here, *there);
    for (std::size_t f = 0; f < off.effect.size(); ++f) larger.effect[f] = std::max(larger.effect[f], off.effect[f]);
  });
  if (is_done) return sum;
  end_number();
  known.are_all = true;
  return sum;
}

}  // namespace

LastBit last_bit(const Query& query, const Declaration& declared) {
  LastBits none;
  return last_bit_until(query, declared, none, [](const LastBit& /*sum*/) { return false; });
}

bool last_bit_decides(const Query& query, const Truth& truth, const Declaration& declared) {
  const DefaultEnvironment environment;
  const Conventions& conventions = declared.conventions;
  const auto hit = [&](const Query& q, const Truth& t) {
    return expected_hit(q, t, conventions.touching_contact, conventions.margin);
  };
  const bool is_hit = hit(query, truth);
  // No question has so many numbers that all of their last bits together move a distance farther.
  constexpr double kMostUlps = 64;
  const double unit = std::ldexp(1.0, 1 - format_of(declared.scalar).precision);
  const Off off = decision_off(query, truth, conventions.margin != Margin::none, std::nullopt);
  if (off.most > kMostUlps * unit * largest_length(query, truth)) return false;

  const std::optional<Exact> here = beyond(query, truth, declared);
  Query all = query;
  bool decides = false;
  // Away from the decision that is right: the neighbour with the larger signed distance where it is a hit.
  std::optional<Exact::Enclosure> best;
  std::size_t number = 0;
  const std::vector<bool> idle = numbers_without_effect(query, declared.scalar);
  for_each_neighbour(query, declared.scalar, idle, [&](const Query& neighbour, std::size_t i) {
    if (decides) return;
    const Truth there = truth_of(neighbour);
    decides = hit(neighbour, there) != is_hit;
    if (!here) return;
    constexpr int kBits = 256;
    const auto moved = beyond(neighbour, there, declared)->enclosure(kBits);
    if (std::exchange(number, i) != i || !best) best = here->enclosure(kBits);
    if (is_hit ? moved.low <= best->low : moved.high >= best->high) return;
    best = moved;
    double to = 0;
    std::size_t k = 0;
    for_each_number_unnamed(neighbour, [&](double x) {
      if (k++ == i) to = x;
    });
    k = 0;
    for_each_number(all, [&](const std::string&, double& x) {
      if (k++ == i) x = to;
    });
  });
  return decides || (here && inside_domain(all) && hit(all, truth_of(all)) != is_hit);
}

double orientation_rounding(const Obb& box, Scalar scalar) {
  return kOrientationRoundings * std::ldexp(box.extents.stableNorm(), -format_of(scalar).precision);
}

bool rounding_decides(const Query& query, const Truth& truth, const Declaration& declared) {
  const DefaultEnvironment environment;
  if (!declared.rounds_orientation || !truth.has_distance()) return false;
  double moved = 0;
  bool is_turned = false;
  for_each_shape(query, [&]<class Shape>(const Shape& shape) {
    if constexpr (std::same_as<Shape, Obb>) {
      is_turned = true;
      moved += orientation_rounding(shape, declared.scalar);
    }
  });
  const bool by_alarm = declared.conventions.margin != Margin::none;
  return is_turned && decision_off(query, truth, by_alarm, std::nullopt).most <= moved;
}

void mark_last_bit(const Query& query, const Truth& truth, const Declaration& declared, Verdict& verdict,
                   LastBits& known) {
  const auto is_off = [](const auto& field) { return field && field->grade == Grade::beyond_bound; };
  if (std::any_of(verdict.fields.begin(), verdict.fields.end(), is_off)) {
    const auto mark = [&](const LastBit& bit) {
      bool are_all = true;
      for (const Field field : kFields)
        if (auto& f = verdict.fields[static_cast<std::size_t>(field)]; is_off(f)) {
          f->last_bit = f->off.most <= bit.at(field);
          are_all = are_all && f->last_bit;
        }
      return are_all;
    };
    mark(last_bit_until(query, declared, known, mark));
  }
  if (!verdict.missed_hit() && !verdict.false_hit()) return;
  verdict.decision_last_bit = last_bit_decides(query, truth, declared);
  verdict.decision_rounded = !verdict.decision_last_bit && rounding_decides(query, truth, declared);
}

}  // namespace contact::oracle
