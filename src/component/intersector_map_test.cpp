// Which intersector serves which pair of model types: as given, swapped, derived, replaced, ignored and missing.
#include "contact/intersector_map.hpp"

#include <gtest/gtest.h>

#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "component/models_for_tests.hpp"

namespace contact {
namespace {

using component::Current;
using component::Press;

/// A model of one element that is nothing but its type.
class Fruit : public CollisionModel {
 public:
  explicit Fruit(std::string name = "fruit") : CollisionModel(std::move(name)) {}
  [[nodiscard]] Index getSize() const override { return 1; }
  [[nodiscard]] Box bounding_box(Index) const override { return {Vector3::Zero(), Vector3::Zero()}; }
};

class Apples : public ModelOf<Apples, Fruit> {
 public:
  static constexpr std::string_view kName = "Apples";
  using Element = ElementOf<Apples>;
};
class GreenApples : public ModelOf<GreenApples, Apples> {
 public:
  static constexpr std::string_view kName = "GreenApples";
};
class SourApples : public ModelOf<SourApples, GreenApples> {
 public:
  static constexpr std::string_view kName = "SourApples";
};
class UndeclaredApples : public Apples {};
class Pears : public ModelOf<Pears, Fruit> {
 public:
  static constexpr std::string_view kName = "Pears";
  using Element = ElementOf<Pears>;
};
class WinterPears : public ModelOf<WinterPears, Pears> {
 public:
  static constexpr std::string_view kName = "WinterPears";
};
class Plums : public ModelOf<Plums, Fruit> {
 public:
  static constexpr std::string_view kName = "Plums";
  using Element = ElementOf<Plums>;
};

/// A map that keeps what it is told is missing.
struct Listening {
  IntersectorMap map;
  std::vector<std::string> messages;

  Listening() {
    map.setSink([this](const std::string& message) { messages.push_back(message); });
  }
};

/// Which press serves the models, with its sign reversed where it takes them swapped; 0 where none does.
int served(const IntersectorMap& map, const CollisionModel& model1, const CollisionModel& model2) {
  bool swap = false;
  const ElementIntersector* intersector = map.get(model1, model2, swap);
  if (!intersector) return 0;
  OutputVector contacts;
  intersector->intersect({model1, 0}, {model2, 0}, contacts, Current(0));
  const auto number = static_cast<int>(contacts.at(0).id);
  return swap ? -number : number;
}

bool swap_flag(const IntersectorMap& map, const CollisionModel& model1, const CollisionModel& model2, bool before) {
  bool swap = before;
  (void)map.get(model1, model2, swap);
  return swap;
}

TEST(IntersectorMap, finds_what_was_added_in_the_order_of_the_models) {
  Listening l;
  const Press one(1);
  l.map.add<Apples, Pears>(one);
  EXPECT_EQ(served(l.map, Apples(), Pears()), 1);
  EXPECT_FALSE(swap_flag(l.map, Apples(), Pears(), true));
  EXPECT_EQ(l.messages, std::vector<std::string>{});
}

TEST(IntersectorMap, finds_it_for_the_reverse_order_and_says_to_swap) {
  Listening l;
  const Press one(1);
  l.map.add<Apples, Pears>(one);
  EXPECT_EQ(served(l.map, Pears(), Apples()), -1);
  EXPECT_TRUE(swap_flag(l.map, Pears(), Apples(), false));
  EXPECT_EQ(l.messages, std::vector<std::string>{});
}

TEST(IntersectorMap, never_swaps_two_models_of_one_type) {
  Listening l;
  const Press one(1);
  l.map.add<Apples, Apples>(one);
  EXPECT_FALSE(swap_flag(l.map, Apples(), Apples(), true));
}

TEST(IntersectorMap, keeps_an_entry_for_each_order) {
  Listening l;
  const Press one(1);
  const Press two(2);
  l.map.add<Apples, Pears>(one);
  l.map.add<Pears, Apples>(two);
  EXPECT_EQ(served(l.map, Apples(), Pears()), 1);
  EXPECT_EQ(served(l.map, Pears(), Apples()), 2);
}

TEST(IntersectorMap, sets_the_flag_to_false_where_there_is_no_entry) {
  Listening l;
  EXPECT_FALSE(swap_flag(l.map, Apples(), Pears(), true)) << "the first time";
  EXPECT_FALSE(swap_flag(l.map, Apples(), Pears(), true)) << "and when the pair is known to be missing";
  EXPECT_EQ(served(l.map, Apples(), Pears()), 0);
}

TEST(IntersectorMap, takes_a_derived_class_that_has_not_declared_itself_for_its_base) {
  Listening l;
  const Press one(1);
  l.map.add<Apples, Pears>(one);
  EXPECT_EQ(served(l.map, UndeclaredApples(), Pears()), 1);
  EXPECT_EQ(served(l.map, Pears(), UndeclaredApples()), -1);
}

TEST(IntersectorMap, serves_a_derived_model_by_its_bases_intersector) {
  Listening l;
  const Press one(1);
  l.map.add<Apples, Pears>(one);
  EXPECT_EQ(served(l.map, GreenApples(), Pears()), 1);
  EXPECT_EQ(served(l.map, SourApples(), WinterPears()), 1);
  EXPECT_EQ(served(l.map, WinterPears(), SourApples()), -1);
  EXPECT_EQ(l.messages, std::vector<std::string>{});
}

TEST(IntersectorMap, does_not_serve_a_base_by_a_derived_models_intersector) {
  Listening l;
  const Press one(1);
  l.map.add<GreenApples, Pears>(one);
  EXPECT_EQ(served(l.map, Apples(), Pears()), 0);
}

TEST(IntersectorMap, prefers_a_derived_models_own_entry_whenever_it_was_added) {
  const Press one(1);
  const Press two(2);
  Listening own_last;
  own_last.map.add<Apples, Pears>(one);
  own_last.map.add<GreenApples, Pears>(two);
  Listening own_first;
  own_first.map.add<GreenApples, Pears>(two);
  own_first.map.add<Apples, Pears>(one);
  for (const Listening* l : {&own_last, &own_first}) {
    EXPECT_EQ(served(l->map, GreenApples(), Pears()), 2);
    EXPECT_EQ(served(l->map, Pears(), GreenApples()), -2);
    EXPECT_EQ(served(l->map, Apples(), Pears()), 1);
  }
}

TEST(IntersectorMap, prefers_a_nearer_entry_that_swaps_to_a_farther_one_that_does_not) {
  Listening l;
  const Press one(1);
  const Press two(2);
  l.map.add<Apples, Pears>(one);
  l.map.add<Pears, GreenApples>(two);
  EXPECT_EQ(served(l.map, GreenApples(), Pears()), -2);
  EXPECT_EQ(served(l.map, Pears(), GreenApples()), 2);
}

TEST(IntersectorMap, picks_the_nearest_entry_for_a_model_two_steps_down) {
  Listening l;
  const Press one(1);
  const Press two(2);
  l.map.add<GreenApples, Pears>(two);
  l.map.add<Apples, Pears>(one);
  EXPECT_EQ(served(l.map, SourApples(), Pears()), 2);
  EXPECT_EQ(served(l.map, Pears(), SourApples()), -2);
}

TEST(IntersectorMap, counts_the_steps_up_both_lineages_together) {
  Listening l;
  const Press one(1);
  const Press two(2);
  l.map.add<SourApples, Pears>(one);    // 0 + 1 from (SourApples, WinterPears)
  l.map.add<Apples, WinterPears>(two);  // 2 + 0
  EXPECT_EQ(served(l.map, SourApples(), WinterPears()), 1);
  EXPECT_EQ(served(l.map, WinterPears(), SourApples()), -1);
}

TEST(IntersectorMap, takes_the_order_as_given_before_the_swapped_one_at_equal_distance) {
  Listening l;
  const Press one(1);
  const Press two(2);
  l.map.add<GreenApples, Pears>(one);
  l.map.add<WinterPears, Apples>(two);  // added last, and still not asked for (apples, pears)
  EXPECT_EQ(served(l.map, GreenApples(), WinterPears()), 1);
  EXPECT_EQ(served(l.map, WinterPears(), GreenApples()), 2);
}

TEST(IntersectorMap, takes_the_entry_added_last_at_equal_distance_and_order) {
  const Press one(1);
  const Press two(2);
  Listening a;
  a.map.add<GreenApples, Pears>(one);
  a.map.add<Apples, WinterPears>(two);
  EXPECT_EQ(served(a.map, GreenApples(), WinterPears()), 2);
  EXPECT_EQ(served(a.map, WinterPears(), GreenApples()), -2);
  Listening b;
  b.map.add<Apples, WinterPears>(two);
  b.map.add<GreenApples, Pears>(one);
  EXPECT_EQ(served(b.map, GreenApples(), WinterPears()), 1);
  EXPECT_EQ(served(b.map, WinterPears(), GreenApples()), -1);
}

TEST(IntersectorMap, decides_between_a_type_and_its_base_for_two_models_of_one_type_as_for_any) {
  Listening l;
  const Press one(1);
  l.map.add<Apples, GreenApples>(one);
  EXPECT_EQ(served(l.map, GreenApples(), GreenApples()), 1) << "as given before swapped";
  EXPECT_EQ(served(l.map, GreenApples(), Apples()), -1);
}

TEST(IntersectorMap, replaces_the_entry_for_the_same_types_in_the_same_order) {
  Listening l;
  const Press one(1);
  const Press two(2);
  const Press three(3);
  l.map.add<Apples, Pears>(one);
  l.map.add<Pears, Plums>(three);
  l.map.add<Apples, Pears>(two);
  EXPECT_EQ(served(l.map, Apples(), Pears()), 2);
  EXPECT_EQ(served(l.map, Pears(), Apples()), -2);
  EXPECT_EQ(l.map.names(), (std::vector<std::string>{"Press<Pears,Plums>", "Press<Apples,Pears>"}));
}

TEST(IntersectorMap, is_silent_about_an_ignored_pair_in_either_order) {
  Listening l;
  l.map.ignore<Apples, Pears>();
  EXPECT_EQ(served(l.map, Apples(), Pears()), 0);
  EXPECT_EQ(served(l.map, WinterPears(), GreenApples()), 0);
  EXPECT_FALSE(swap_flag(l.map, Apples(), Pears(), true));
  EXPECT_FALSE(swap_flag(l.map, Pears(), Apples(), true));
  EXPECT_EQ(l.messages, std::vector<std::string>{});
  EXPECT_EQ(l.map.names(), std::vector<std::string>{"ignored<Apples-Pears>"});
}

TEST(IntersectorMap, ignores_a_derived_pair_whose_base_is_served_and_serves_an_ignored_one_again) {
  Listening l;
  const Press one(1);
  l.map.add<Apples, Pears>(one);
  l.map.ignore<GreenApples, Pears>();
  EXPECT_EQ(served(l.map, GreenApples(), Pears()), 0);
  EXPECT_EQ(served(l.map, Apples(), Pears()), 1);
  l.map.add<GreenApples, Pears>(one);
  EXPECT_EQ(served(l.map, GreenApples(), Pears()), 1);
}

TEST(IntersectorMap, reports_a_missing_pair_once_in_whichever_order_it_is_asked_for) {
  Listening l;
  const Press one(1);
  l.map.add<Apples, Apples>(one);
  l.map.ignore<Apples, Pears>();
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(served(l.map, Plums(), WinterPears()), 0);
    EXPECT_EQ(served(l.map, WinterPears(), Plums()), 0);
  }
  EXPECT_EQ(l.messages, std::vector<std::string>{"contact: no intersector for Plums-WinterPears; there are "
                                                 "Press<Apples,Apples> ignored<Apples-Pears>"});
}

TEST(IntersectorMap, reports_every_missing_pair_of_types) {
  Listening l;
  (void)served(l.map, Plums(), Plums());
  (void)served(l.map, Plums(), Pears());
  (void)served(l.map, Plums(), WinterPears());
  EXPECT_EQ(l.messages.size(), 3U);
  EXPECT_EQ(l.messages.front(), "contact: no intersector for Plums-Plums; there are none");
}

TEST(IntersectorMap, serves_a_pair_that_was_missing_once_an_entry_is_added_in_either_order) {
  const Press one(1);
  Listening as_asked;
  EXPECT_EQ(served(as_asked.map, Apples(), Pears()), 0);
  as_asked.map.add<Apples, Pears>(one);
  EXPECT_EQ(served(as_asked.map, Apples(), Pears()), 1);
  Listening reverse;
  EXPECT_EQ(served(reverse.map, Apples(), Pears()), 0);
  reverse.map.add<Pears, Apples>(one);
  EXPECT_EQ(served(reverse.map, Apples(), Pears()), -1);
  EXPECT_EQ(served(reverse.map, Pears(), Apples()), 1);
}

TEST(IntersectorMap, serves_a_pair_that_was_missing_once_an_entry_for_its_bases_is_added) {
  Listening l;
  const Press one(1);
  EXPECT_EQ(served(l.map, SourApples(), WinterPears()), 0);
  l.map.add<Pears, Apples>(one);
  EXPECT_EQ(served(l.map, SourApples(), WinterPears()), -1);
}

TEST(IntersectorMap, keeps_remembering_the_missing_pairs_that_an_entry_does_not_serve) {
  Listening l;
  const Press one(1);
  (void)served(l.map, Plums(), Plums());
  l.map.add<Apples, Pears>(one);
  (void)served(l.map, Plums(), Plums());
  EXPECT_EQ(l.messages.size(), 1U);
}

TEST(IntersectorMap, writes_of_missing_pairs_to_standard_error_by_default) {
  const IntersectorMap map;
  std::ostringstream captured;
  std::streambuf* const before = std::cerr.rdbuf(captured.rdbuf());
  (void)served(map, Apples(), Pears());
  std::cerr.rdbuf(before);
  EXPECT_EQ(captured.str(), "contact: no intersector for Apples-Pears; there are none\n");
}

TEST(IntersectorMap, an_empty_sink_is_silence) {
  IntersectorMap map;
  map.setSink({});
  std::ostringstream captured;
  std::streambuf* const before = std::cerr.rdbuf(captured.rdbuf());
  EXPECT_EQ(served(map, Apples(), Pears()), 0);
  std::cerr.rdbuf(before);
  EXPECT_EQ(captured.str(), "");
}

TEST(IntersectorMap, a_sink_may_itself_look_up) {
  IntersectorMap map;
  int told = 0;
  map.setSink([&](const std::string&) {
    ++told;
    (void)served(map, Apples(), Pears());
    (void)served(map, Plums(), Plums());
  });
  EXPECT_EQ(served(map, Apples(), Pears()), 0);
  EXPECT_EQ(told, 2);
}

TEST(MemberElementIntersector, hands_the_elements_to_its_object_and_names_class_and_models) {
  Listening l;
  const Press one(1);
  const Press none(0);
  l.map.add<Apples, Pears>(one);
  l.map.add<Apples, Plums>(none);
  const Apples apples;
  const Pears pears;
  bool swap = false;
  const ElementIntersector* intersector = l.map.get(apples, pears, swap);
  ASSERT_NE(intersector, nullptr);
  EXPECT_EQ(intersector->name(), "Press<Apples,Pears>");
  EXPECT_TRUE(intersector->canIntersect({apples, 0}, {pears, 0}, Current(0)));
  EXPECT_FALSE(l.map.get(apples, Plums(), swap)->canIntersect({apples, 0}, {pears, 0}, Current(0)));
  OutputVector contacts;
  EXPECT_EQ(intersector->beginIntersect(apples, pears, contacts), 0);
  EXPECT_EQ(intersector->endIntersect(apples, pears, contacts), 0);
  EXPECT_TRUE(contacts.empty());
  EXPECT_EQ(intersector->intersect({apples, 0}, {pears, 0}, contacts, Current(0)), 1);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].elem.first, CollisionElement(apples, 0));
  EXPECT_EQ(contacts[0].elem.second, CollisionElement(pears, 0));
}

}  // namespace
}  // namespace contact
