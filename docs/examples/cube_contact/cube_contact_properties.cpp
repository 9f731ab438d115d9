// The laws of box contacts: the plug-in against its oracle, and what swapping, scaling and turning must do.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "ask.hpp"
#include "contact/cube_cube.hpp"
#include "cube_contact_oracle.hpp"
#include "proptests/generators.hpp"

namespace contact {
namespace {

using namespace proptests;
using example::Answer;
using example::ask;
using example::bits_of;
using example::cube_contact_truth;
using example::CubeContactTruth;
using Kind = CubeContactTruth::Kind;

const Range kEvery;  // finite number
const Range kModerate(Scalar::binary64, 0x1p-60, 0x1p60);

/// The alarm distance raised to what the boxes need to meet, where plain double can tell it; and a contact distance.
rc::Gen<Query> meeting(rc::Gen<Query> gen, rc::Gen<double> length) {
  return rc::gen::map(rc::gen::tuple(std::move(gen), std::move(length), integer(0, 1)),
                      [](const std::tuple<Query, double, int>& parts) {
                        Query query = std::get<0>(parts);
                        query.distances.contact = std::abs(std::get<1>(parts));
                        const auto& [a, b] = *query.boxes();
                        const double gap = (b.min - a.max).cwiseMax(a.min - b.max).maxCoeff();
                        if (std::get<2>(parts) == 1 && std::isfinite(gap))
                          query.distances.alarm = std::max(gap, query.distances.alarm);
                        return query;
                      });
}
/// Corners on a grid of five: faces that touch, flat boxes, points, equal gaps and coincident boxes all the time.
rc::Gen<Query> boxes_on_a_small_grid(int least_exponent, int most_exponent) {
  return rc::gen::map(rc::gen::tuple(rc::gen::container<std::vector<int>>(14, integer(-2, 2)),
                                     integer(least_exponent, most_exponent), integer(0, 3)),
                      [](const std::tuple<std::vector<int>, int, int>& parts) {
                        const auto& [corners, exponent, kind] = parts;
                        std::vector<double> x;
                        for (const int corner : corners) x.push_back(std::ldexp(corner, exponent));
                        Query query = query_of(Pair::cube_cube, x);
                        query.distances = {2 * std::abs(x[12]), std::abs(x[13])};
                        auto& [a, b] = std::get<Boxes>(query.shapes);
                        if (kind == 0) b = a;
                        return query;
                      });
}
/// Boxes far apart on one, two or three axes, by up to the largest finite number: the length of the gap vector passes
/// it.
rc::Gen<Query> boxes_far_apart() {
  return rc::gen::map(
      rc::gen::tuple(numbers(6, huge(kEvery)), numbers(3, any_number(kEvery)), integer(3, 7), integer(0, 7),
                     any_number(kEvery)),
      [](const std::tuple<std::vector<double>, std::vector<double>, int, int, double>& parts) {
        const auto& [far, near, apart, reflected, contact] = parts;
        Box a;
        Box b;
        for (int k = 0; k < 3; ++k) {
          const auto i = static_cast<std::size_t>(k);
          a.min[k] = -std::abs(near[i]);
          a.max[k] = (apart & (1 << k)) != 0 ? std::min(std::abs(near[i]), 0x1p-1000) : std::abs(far[i]);
          b.min[k] = std::min(std::abs(far[i]), std::abs(far[i + 3]));
          b.max[k] = std::max(std::abs(far[i]), std::abs(far[i + 3]));
          if ((reflected & (1 << k)) == 0) continue;
          std::swap(a.min[k], a.max[k]);
          std::swap(b.min[k], b.max[k]);
          for (double* x : {&a.min[k], &a.max[k], &b.min[k], &b.max[k]}) *x = -*x;
        }
        return Query{Pair::cube_cube, Boxes{a, b}, {std::numeric_limits<double>::max(), std::abs(contact)}};
      });
}
rc::Gen<Query> questions() {
  return rc::gen::weightedOneOf<Query>(
      {{3, meeting(queries(Pair::cube_cube, kEvery), any_number(kEvery))},
       {2, meeting(made_of(Pair::cube_cube, ordinary(kEvery)), ordinary(kEvery))},
       {1, meeting(made_of(Pair::cube_cube, beside_dyadic(kEvery)), beside_dyadic(kEvery))},
       {1, meeting(made_of(Pair::cube_cube, subnormal(kEvery)), subnormal(kEvery))},
       {1, meeting(made_of(Pair::cube_cube, huge(kEvery)), huge(kEvery))},
       {5, boxes_far_apart()},
       {3, boxes_on_a_small_grid(-1074, 1020)},
       {3, boxes_on_a_small_grid(-1074, -1072)}});
}
/// Questions whose numbers and answers stay away from both ends of the range.
rc::Gen<Query> moderate_questions() {
  return rc::gen::oneOf(meeting(made_of(Pair::cube_cube, ordinary(kModerate)), ordinary(kModerate)),
                        meeting(made_of(Pair::cube_cube, small_dyadic(kModerate)), small_dyadic(kModerate)),
                        meeting(made_of(Pair::cube_cube, beside_dyadic(kModerate)), beside_dyadic(kModerate)),
                        boxes_on_a_small_grid(-20, 20));
}

Query with_boxes(const Query& query, const Box& a, const Box& b) {
  return {Pair::cube_cube, Boxes{a, b}, query.distances};
}

RC_GTEST_PROP(CubeContactLaws, every_number_is_the_oracles_to_the_bit, ()) {
  const Query query = *questions();
  RC_ASSERT(!outside_domain(query));
  const Answer answer = ask(query);
  const CubeContactTruth truth = cube_contact_truth(query);
  RC_CLASSIFY(truth.kind == Kind::gap_vector, "gap vector");
  RC_CLASSIFY(truth.kind == Kind::penetrating, "penetrating");
  RC_ASSERT(answer.test == (truth.kind != Kind::miss));
  RC_ASSERT(answer.contact.has_value() == answer.test);
  if (answer.test) RC_ASSERT(bits_of(*answer.contact) == bits_of(truth));
}

RC_GTEST_PROP(CubeContactLaws, there_is_a_contact_exactly_where_test_cube_cube_says_yes, ()) {
  const Query query = *questions();
  const bool hit = test_cube_cube(query.boxes()->a, query.boxes()->b, query.distances.alarm);
  RC_ASSERT(ask(query).test == hit);
  RC_ASSERT(ask(query).contact.has_value() == hit);
}

RC_GTEST_PROP(CubeContactLaws, swapped_boxes_mirror_the_contact_bit_for_bit_unless_the_direction_is_a_choice, ()) {
  const Query query = *questions();
  const Answer answer = ask(query);
  const Answer swapped = ask(with_boxes(query, query.boxes()->b, query.boxes()->a));
  RC_ASSERT(swapped.contact.has_value() == answer.contact.has_value());
  RC_PRE(answer.contact.has_value());
  const Contact& c = *answer.contact;
  const bool tied = cube_contact_truth(query).tied;
  RC_CLASSIFY(tied, "tied");
  const Vector3 turned = c.normal.unaryExpr([](double x) { return x == 0 ? 0.0 : -x; });
  if (tied) {
    RC_ASSERT(swapped.contact->normal == c.normal);
    RC_ASSERT(swapped.contact->value == c.value);
  } else {
    RC_ASSERT(bits_of(*swapped.contact) == bits_of(Contact{turned, c.point2, c.point1, c.value, false}));
  }
}

RC_GTEST_PROP(CubeContactLaws, a_power_of_two_scales_every_length_and_no_normal, ()) {
  const Query query = *moderate_questions();
  const int exponent = *integer(-400, 400);
  Query scaled = query;
  for_each_number(scaled, [&](const std::string&, double& x) { x = std::ldexp(x, exponent); });
  const Answer answer = ask(query);
  const Answer larger = ask(scaled);
  RC_ASSERT(larger.contact.has_value() == answer.contact.has_value());
  RC_PRE(answer.contact.has_value());
  const Contact& c = *answer.contact;
  const double factor = std::ldexp(1.0, exponent);
  RC_ASSERT(bits_of(*larger.contact) ==
            bits_of(Contact{c.normal, c.point1 * factor, c.point2 * factor, c.value * factor, false}));
}

RC_GTEST_PROP(CubeContactLaws, permuting_and_reflecting_axes_does_the_same_to_the_contact_unless_axes_are_tied, ()) {
  const Query query = *questions();
  const auto order = *rc::gen::elementOf(
      std::vector<std::array<int, 3>>{{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}});
  const std::array<bool, 3> reflected{*integer(0, 1) == 1, *integer(0, 1) == 1, *integer(0, 1) == 1};
  const auto turned = [&](const Vector3& v) {
    Vector3 result;
    for (std::size_t i = 0; i < 3; ++i) {
      const double x = v[order[i]];
      result[static_cast<Eigen::Index>(i)] = x == 0 ? 0.0 : reflected[i] ? -x : x;
    }
    return result;
  };
  const auto turned_box = [&](const Box& box) {
    const Vector3 p = turned(box.min);
    const Vector3 q = turned(box.max);
    return Box{p.cwiseMin(q), p.cwiseMax(q)};
  };
  const auto& [a, b] = *query.boxes();
  const CubeContactTruth truth = cube_contact_truth(query);
  RC_PRE(truth.kind != Kind::miss && !truth.tied);
  if (truth.kind == Kind::penetrating) {
    // Equal gaps are left out: the other way of choosing among them is another answer.
    const Query moved = with_boxes(query, turned_box(a), turned_box(b));
    const Vector3 other = cube_contact_truth(moved).normal;
    RC_PRE(other == turned(truth.normal));
  }
  const Contact c = *ask(query).contact;
  RC_ASSERT(bits_of(*ask(with_boxes(query, turned_box(a), turned_box(b))).contact) ==
            bits_of(Contact{turned(c.normal), turned(c.point1), turned(c.point2), c.value, false}));
}

RC_GTEST_PROP(CubeContactLaws, a_larger_alarm_distance_changes_no_number, ()) {
  Query query = *questions();
  const Answer answer = ask(query);
  RC_PRE(answer.contact.has_value());
  query.distances.alarm = std::max(query.distances.alarm, std::abs(*any_number(kEvery)));
  RC_ASSERT(bits_of(*ask(query).contact) == bits_of(*answer.contact));
}

// What the laws were asked: shares of a sample with a fixed seed.
TEST(CubeContactQuestions, of_a_fixed_sample_are_answered_to_the_bit_and_hold_enough_of_every_kind) {
  constexpr int kCount = 6000;
  int gap_vector = 0;
  int several_axes = 0;
  int penetrating = 0;
  int touching = 0;
  int tied = 0;
  int flat = 0;
  int coincident = 0;
  int subnormal_value = 0;
  int infinite_value = 0;
  int oblique_and_huge = 0;
  for (const Query& query : sample(questions(), kCount)) {
    ASSERT_FALSE(outside_domain(query));
    const CubeContactTruth truth = cube_contact_truth(query);
    const Answer answer = ask(query);
    ASSERT_EQ(answer.contact.has_value(), truth.kind != Kind::miss);
    if (answer.contact) {
      ASSERT_EQ(bits_of(*answer.contact), bits_of(truth)) << rc::toString(query);
    }
    const auto& [a, b] = *query.boxes();
    const bool hit = truth.kind != Kind::miss;
    const bool oblique = (truth.normal.array() != 0).count() > 1;
    gap_vector += truth.kind == Kind::gap_vector ? 1 : 0;
    several_axes += oblique ? 1 : 0;
    penetrating += truth.kind == Kind::penetrating ? 1 : 0;
    touching +=
        truth.kind == Kind::penetrating && (a.max.cwiseEqual(b.min).any() || b.max.cwiseEqual(a.min).any()) ? 1 : 0;
    tied += truth.tied ? 1 : 0;
    flat += hit && (a.min.cwiseEqual(a.max).any() || b.min.cwiseEqual(b.max).any()) ? 1 : 0;
    coincident += a.min == b.min && a.max == b.max ? 1 : 0;
    subnormal_value += hit && truth.value != 0 && std::abs(truth.value) < 0x1p-1022 ? 1 : 0;
    infinite_value += std::isinf(truth.value) ? 1 : 0;
    oblique_and_huge += oblique && (truth.point2 - truth.point1).cwiseAbs().maxCoeff() > 0x1p1021 ? 1 : 0;
  }
  const auto expect_share = [&](const char* kind, int count, double least, double most) {
    const double share = 100.0 * count / kCount;
    RecordProperty(kind, std::to_string(share) + " %");
    std::cout << kind << ": " << share << " %\n";
    EXPECT_GE(share, least) << kind;
    EXPECT_LE(share, most) << kind;
  };
  expect_share("gap vector", gap_vector, 20, 60);
  expect_share("gap vector on several axes", several_axes, 10, 60);
  expect_share("penetrating", penetrating, 15, 50);
  expect_share("touching", touching, 5, 50);
  expect_share("direction is a choice", tied, 5, 50);
  expect_share("flat box", flat, 5, 60);
  expect_share("coincident boxes", coincident, 5, 50);
  expect_share("subnormal value", subnormal_value, 5, 50);
  expect_share("infinite value", infinite_value, 0.5, 30);
  expect_share("several axes, near the largest finite number", oblique_and_huge, 2, 30);
}

}  // namespace
}  // namespace contact
