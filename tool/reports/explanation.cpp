// The exact answer to a question, in words and numbers, beside what plain double arithmetic would have said.
#include "tool/reports/explanation.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>

#include "golden/dataset.hpp"
#include "golden/plain.hpp"
#include "golden/query_id.hpp"
#include "oracle/truth/exact_truth.hpp"

namespace contact::tool {
namespace {

using formats::number;
using oracle::Exact;
using oracle::Rational;

constexpr std::size_t kLongestExact = 40;  // digits of an exact number that a person still reads

std::string vector(const Vector3& v) { return fmt::format("({}, {}, {})", number(v[0]), number(v[1]), number(v[2])); }

/// An exact number for a person: its decimal value, and the dyadic string where that is short.
std::string exactly(const Rational& x) {
  const std::string dyadic = oracle::exact_string(x);
  const double rounded = oracle::round_to_nearest(x, Scalar::binary64);
  const bool is_double = std::isfinite(rounded) && Rational(rounded) == x;
  const std::string decimal = std::isfinite(rounded) ? number(rounded) : "beyond the range of binary64";
  return fmt::format("{} {}{}", is_double ? "=" : "~", decimal,
                     dyadic.size() <= kLongestExact ? fmt::format("  (exactly {})", dyadic) : "");
}

/// The same of a number that may have no dyadic string.
std::string roughly(const Exact& x) {
  const double rounded = oracle::round_to_nearest(x, Scalar::binary64);
  if (!std::isfinite(rounded)) return "~ beyond the range of binary64";
  return fmt::format("{} {}", x.compare(Rational(rounded)) == CGAL::EQUAL ? "=" : "~", number(rounded));
}

/// Where the exact real lies beside its rounding.
std::string neighbourhood(const Exact& x, double rounded, Scalar scalar) {
  if (!std::isfinite(rounded)) return "beyond the largest finite number";
  const auto side = x.compare(Rational(rounded));
  if (side == CGAL::EQUAL) return "exactly";
  const double offset = oracle::error_in_units(Rational(rounded), x, oracle::ulp(x, scalar));
  return fmt::format("{} {:.6g} ulp {}", offset == 0.5 ? "about" : "exact real", offset,
                     side == CGAL::LARGER ? "above" : "below");
}

std::string relation(oracle::Side side, double alarm) {
  if (side == oracle::Side::within) return alarm > 0 ? "within the alarm distance" : "overlapping";
  if (side == oracle::Side::beyond) return alarm > 0 ? "beyond the alarm distance" : "apart";
  return alarm > 0 ? "exactly at the alarm distance, which counts" : "exactly touching, which counts";
}

std::string plain_double_says(const Query& query, bool hit) {
  const bool plain = golden::plain_overlap(query, Scalar::binary64);
  return fmt::format("  plain double arithmetic says {}{}\n", plain ? "hit" : "miss", plain == hit ? "" : ": WRONG");
}

/// What is said of a normal where there is no distance.
std::string meeting_text(const Query& query, const oracle::DistanceTruth& truth) {
  const oracle::Meeting& meeting = truth.meeting();
  if (query.balls() != nullptr)
    return "  The centres coincide: the normal is (1,0,0) by agreement, and any unit normal is right for another "
           "engine.\n";
  if (truth.coincident()) {
    const auto [meet, part] =
        is_convex(query.pair)                 ? std::pair("The cores touch", "them")
        : query.pair == Pair::capsule_capsule ? std::pair("The axes meet", "the axes")
        : query.pair == Pair::sphere_capsule  ? std::pair("The centre lies on the axis", "the axis")
        : query.pair == Pair::ray_sphere      ? std::pair("The centre lies on the ray", "the ray")
        : query.pair == Pair::sphere_triangle ? std::pair("The centre lies on the triangle", "it")
                                              : std::pair("The centre lies on the box", "the box");
    return fmt::format(
        "  {}: the normal is by agreement, and any that points against no part of {} is right for another engine.\n",
        meet, part);
  }
  const std::string part = truth.overlaps() ? "facet of A - B" : "face";
  const std::string way = fmt::format(
      "  The normal leads out through {}.\n",
      meeting.ways.size() == 1 ? fmt::format("the nearest {}", part)
                               : fmt::format("the first of {} nearest of the {}; each is right", meeting.ways.size(),
                                             truth.overlaps() ? "facets of A - B" : "faces"));
  if (truth.overlaps()) return way;
  Rational depth(0);  // along an axis
  for (std::size_t i = 0; i < 3; ++i) depth += CGAL::abs(meeting.ways[0].first[i] - meeting.ways[0].nearest[i]);
  return fmt::format("  The centre is inside, {} deep.", exactly(depth).substr(2)) + way.substr(1);
}

/// "  a         center (0, 0, 0), radius 1", and so for b.
std::string shapes_text(const Query& query) {
  std::string text;
  const auto add = [&](char label, const auto& shape) {
    std::string fields;
    for_each_field(shape, [&](const auto& field, const auto& value) {
      fields += fmt::format("{}{} ", fields.empty() ? "" : ", ", field.name);
      if constexpr (std::same_as<std::remove_cvref_t<decltype(value)>, double>)
        fields += number(value);
      else if constexpr (std::same_as<std::remove_cvref_t<decltype(value)>, Quaternion>)
        fields +=
            fmt::format("({}, {}, {}, {})", number(value[0]), number(value[1]), number(value[2]), number(value[3]));
      else {
        std::string_view between;
        for_each_vector(
            value, [&](const Vector3& v) { fields += fmt::format("{}{}", std::exchange(between, " "), vector(v)); });
      }
    });
    text += fmt::format("  {}         {}\n", label, fields);
  };
  char label = 'a';
  for_each_shape(query, [&](const auto& shape) { add(label++, shape); });
  return text;
}

/// Each number of a contact: rounded, where the exact real lies beside that, and what plain double says.
std::string numbers_text(const Query& query, const oracle::DistanceTruth& t, const Contact& c, Scalar scalar) {
  const auto plain = golden::plain_contact(query, Scalar::binary64);
  std::string text = fmt::format("\n  {:<10}{:<26}{:<36}{}\n", "", fmt::format("rounded to {}", name(scalar)),
                                 "the exact real lies", "plain double says");
  const auto row = [&](const std::string& field, const Exact& x, double rounded, std::optional<double> said) {
    std::string beside = "no contact";
    if (said)
      beside = number(*said) + (*said == rounded ? ""
                                : std::isfinite(*said)
                                    ? fmt::format("  (off by {:.3g} ulp)",
                                                  oracle::error_in_units(Rational(*said), x, oracle::ulp(x, scalar)))
                                    : "  (not finite)");
    text += fmt::format("  {:<10}{:<26}{:<36}{}\n", field, number(rounded), neighbourhood(x, rounded, scalar), beside);
  };
  const auto said = [&](auto member, int axis) { return plain ? std::optional((*plain.*member)[axis]) : std::nullopt; };
  for (int axis = 0; axis < 3; ++axis)
    row(fmt::format("normal[{}]", axis), t.normal(axis), c.normal[axis], said(&Contact::normal, axis));
  for (int axis = 0; axis < 3; ++axis)
    row(fmt::format("point1[{}]", axis), t.point(0, axis, PointOn::nearest_surface), c.point1[axis],
        said(&Contact::point1, axis));
  for (int axis = 0; axis < 3; ++axis)
    row(fmt::format("point2[{}]", axis), t.point(1, axis, PointOn::nearest_surface), c.point2[axis],
        said(&Contact::point2, axis));
  row("value", t.value(true), c.value, plain ? std::optional(plain->value) : std::nullopt);
  return text;
}

std::string distance_text(const Query& query, const oracle::Truth& truth, Scalar scalar) {
  const oracle::DistanceTruth& t = *truth.distance();
  std::string text = shapes_text(query);
  text += fmt::format("  distances alarm {}, contact {}\n\n", number(query.distances.alarm),
                      number(query.distances.contact));
  const bool of_centers = query.balls() != nullptr;
  if (!of_centers)
    for (const int shape : {0, 1}) {
      Vector3 nearest;
      for (int axis = 0; axis < 3; ++axis)
        nearest[axis] = oracle::round_to_nearest(t.point(shape, axis, PointOn::center), scalar);
      text += fmt::format("  {}         nearest in {}     {}\n", "pq"[shape], "ab"[shape], vector(nearest));
    }
  text += fmt::format("  D         {:<15}  {}\n", of_centers ? "|b - a|^2" : "|q - p|^2", exactly(t.distance2()));
  const bool over_plane = t.cores().half_space.has_value();
  if (over_plane)
    text += fmt::format("  s         signed distance  {}sqrt(D){}\n", t.below() ? "-" : "",
                        t.below() ? ", since p is below the plane" : "");
  if (t.overlaps()) text += fmt::format("  d         depth            {}\n", roughly(t.depth()));
  text += fmt::format("  distance  {:<15}  {}\n",
                      over_plane     ? "s - r1"
                      : t.overlaps() ? "-d - r1 - r2"
                                     : "sqrt(D) - r1 - r2",
                      roughly(t.value(false)));
  text += fmt::format("  reach     alarm + r1 + r2  {}\n", exactly(t.reach()));
  text += fmt::format("  reach^2                    {}\n", exactly(t.reach() * t.reach()));
  text += fmt::format("  margin    {:<7} - reach  {} ulps of reach ({})\n\n",
                      over_plane     ? "s"
                      : t.overlaps() ? "-d"
                                     : "sqrt(D)",
                      number(oracle::round_to_nearest(t.margin(scalar), Scalar::binary64)), name(scalar));
  text += fmt::format(
      "  {}: {}.  {}\n",
      t.below() ? "s < 0 <= reach"
      : t.overlaps()
          ? "D = 0, and the cores overlap"
          : fmt::format("D {} reach^2",
                        "<=>"[static_cast<std::size_t>(CGAL::compare(t.distance2(), t.reach() * t.reach()) + 1)]),
      relation(truth.at_alarm, query.distances.alarm), truth.hit() ? "HIT" : "MISS");
  text += plain_double_says(query, truth.hit());
  if (!truth.hit()) return text;

  const Contact c = *oracle::expectation(truth, scalar).contact;
  if (c.degenerate || t.overlaps()) text += meeting_text(query, t);
  if (!c.unique)
    text += fmt::format("  {}, and more than one pair of points is nearest: the reference takes the middle.\n",
                        is_convex(query.pair) ? "An edge or a face lies along another"
                        : over_plane          ? "The axis goes along the plane"
                                              : "The axes are parallel");
  return text + numbers_text(query, t, c, scalar);
}

/// The numbers of a crossing.
std::string crossing_text(const Query& query, const oracle::Truth& truth, Scalar scalar) {
  std::string text = shapes_text(query) + "\n";
  if (!truth.hit())
    return text +
           "  The segment does not cross the triangle: it passes by, ends before it, or goes along its plane.  MISS\n"
           "  A crossing is decided without a distance: there is none to tell.\n" +
           plain_double_says(query, false);
  const auto& at = *truth.crossing()->at();
  for (std::size_t axis = 0; axis < 3; ++axis) text += fmt::format("  X[{}]      {}\n", axis, exactly(at[axis]));
  text += "\n  The segment crosses the triangle at X.  HIT\n" + plain_double_says(query, true);
  return text + numbers_text(query, *truth.contact(), *oracle::expectation(truth, scalar).contact, scalar);
}

/// The numbers of a ray that is cast.
std::string cast_text(const Query& query, const oracle::Truth& truth, Scalar scalar) {
  std::string text = shapes_text(query) + "\n";
  if (!truth.hit())
    return text +
           "  No point of the ray lies in the shape: it passes by, ends before it, or begins behind it.  MISS\n" +
           plain_double_says(query, false);
  const oracle::CastHit& hit = *truth.contact()->cast();
  const auto end = [&](const oracle::LineEnd& at, char sign) {
    return CGAL::is_zero(at.half2)
               ? exactly(at.middle)
               : fmt::format("= m {} sqrt(h), m {}, h {}", sign, exactly(at.middle), exactly(at.half2));
  };
  const auto rounded = [](const Exact& x) { return number(oracle::round_to_nearest(x, Scalar::binary64)); };
  if (!hit.inside) text += fmt::format("  t         {}\n", end(*truth.cast()->entry(), '-'));
  if (const auto& exit = truth.cast()->exit())
    text += fmt::format("  The line leaves the shape at t ~ {}  ({})\n", rounded(exit->last()), end(*exit, '+'));
  else
    text += "  The line does not leave the shape.\n";
  text += fmt::format("\n  {}  HIT\n", hit.inside ? "The origin lies in the shape."
                                                  : "o + t d is the first point of the ray in the shape.");
  text += plain_double_says(query, true);
  if (hit.inside)
    text += "  The normal is against the direction by agreement, and any unit normal is right for another engine.\n";
  else if (hit.either_side)
    text += "  The normal turned round is as right.\n";
  else if (hit.against)
    text += "  It hits an edge or a corner: any normal that points away from the shape is right for another engine.\n";
  return text + numbers_text(query, *truth.contact(), *oracle::expectation(truth, scalar).contact, scalar);
}

std::string gaps_text(const Query& query, const oracle::Truth& truth) {
  std::string text = shapes_text(query);
  text += fmt::format("  alarm     {}\n\n", number(query.distances.alarm));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Rational& gap = truth.gaps()->gap()[axis];
    const auto side = CGAL::sign(gap - truth.gaps()->alarm());
    text += fmt::format("  {}  gap {}: {} the alarm distance\n", "xyz"[axis], exactly(gap),
                        side == CGAL::NEGATIVE ? "below"
                        : side == CGAL::ZERO   ? "exactly"
                                               : "ABOVE");
  }
  text += fmt::format("\n  {}.  {}\n", relation(truth.at_alarm, query.distances.alarm), truth.hit() ? "HIT" : "MISS");
  return text + plain_double_says(query, truth.hit());
}

}  // namespace

std::optional<double> distance(const oracle::Truth& truth, Scalar scalar) {
  if (!truth.has_distance()) return std::nullopt;
  return oracle::round_to_nearest(truth.distance()->value(false), scalar);
}

std::string explanation(const Query& query, const oracle::Truth& truth, Scalar scalar) {
  return fmt::format("{} {}\n{}", name(query.pair), golden::query_id(query),
                     is_cast(query.pair)       ? cast_text(query, truth, scalar)
                     : is_crossing(query.pair) ? crossing_text(query, truth, scalar)
                     : truth.has_distance()    ? distance_text(query, truth, scalar)
                                               : gaps_text(query, truth));
}

}  // namespace contact::tool
