// The greedy cover on small sets, worked out by hand.
#include "oracle/diagnosis/cover.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <vector>

namespace contact::oracle::cover_test {
namespace {

using Elements = std::vector<std::size_t>;

constexpr std::size_t kNoLimit = 99;

/// What is left of a set, one for each element.
Gain gain_of_set(const Elements& set, std::span<const std::size_t> left) {
  Gain gain;
  std::set_intersection(set.begin(), set.end(), left.begin(), left.end(), std::back_inserter(gain.elements));
  gain.score = gain.covered = static_cast<double>(gain.elements.size());
  return gain;
}
std::vector<Choice> cover(std::size_t elements, const std::vector<Elements>& sets, const CoverLimits& limits) {
  return greedy_cover(
      elements, sets.size(),
      [&](std::size_t i, std::span<const std::size_t> left) { return gain_of_set(sets[i], left); }, limits);
}
std::vector<Choice> cover(std::size_t elements, const std::vector<Elements>& sets) {
  return cover(elements, sets, {kNoLimit, 0, 1});
}
Elements candidates(const std::vector<Choice>& chosen) {
  Elements found;
  for (const Choice& choice : chosen) found.push_back(choice.candidate);
  return found;
}

TEST(Cover, EachRoundChoosesWhatCoversMostOfTheRest) {
  // The second set is larger than the third, and smaller once the first has been chosen.
  const auto chosen = cover(8, {{0, 1, 2, 3}, {1, 2, 3, 4}, {5, 6}});
  EXPECT_EQ(candidates(chosen), (Elements{0, 2, 1}));
  EXPECT_EQ(chosen[0].gain.elements, (Elements{0, 1, 2, 3}));
  EXPECT_EQ(chosen[1].gain.elements, (Elements{5, 6}));
  EXPECT_EQ(chosen[2].gain.elements, (Elements{4}));
  EXPECT_EQ(chosen[2].gain.covered, 1);
}

TEST(Cover, OfEqualScoresTheLowestCandidateIsChosen) {
  EXPECT_EQ(candidates(cover(2, {{0}, {0, 1}, {0, 1}, {0, 1}})), (Elements{1}));
  EXPECT_EQ(candidates(cover(4, {{2, 3}, {0, 1}})), (Elements{0, 1}));
  EXPECT_EQ(candidates(cover(4, {{0, 1}, {2, 3}})), (Elements{0, 1}));
}

TEST(Cover, GreedTakesMoreThanTheFewestWhereTheLargestSetIsNoPartOfThem) {
  // The last two cover everything.
  EXPECT_EQ(candidates(cover(6, {{0, 1, 2, 3}, {0, 2, 4}, {1, 3, 5}})), (Elements{0, 1, 2}));
}

TEST(Cover, TheScoreDecidesAndNotHowMuchIsCovered) {
  const GainOf gain_of = [](std::size_t candidate, std::span<const std::size_t> left) {
    Gain gain = gain_of_set(candidate == 0 ? Elements{0, 1, 2} : Elements{0}, left);
    if (candidate == 0) gain.score = 0.5;
    return gain;
  };
  EXPECT_EQ(candidates(greedy_cover(3, 2, gain_of, {kNoLimit, 3, 3})), (Elements{1, 0})) << "1, then 2 of 3";
  EXPECT_TRUE(greedy_cover(3, 2, gain_of, {kNoLimit, 3, 2}).empty()) << "1 of 3 is less than a half";
}

TEST(Cover, WhatCoversExactlyTheLeastShareIsChosen) {
  const std::vector<Elements> sets{{0, 1, 2, 3}, {4}};
  EXPECT_EQ(cover(5, sets, {kNoLimit, 5, 5}).size(), 2U) << "1 of 5";
  EXPECT_EQ(cover(5, sets, {kNoLimit, 6, 5}).size(), 1U) << "1 of 6";
}

TEST(Cover, EndsAtTheMostChoicesAndWhereNothingIsGained) {
  const std::vector<Elements> sets{{0}, {1}, {2}};
  EXPECT_EQ(candidates(cover(4, sets)), (Elements{0, 1, 2})) << "nothing covers the fourth";
  EXPECT_EQ(candidates(cover(4, sets, {2, 0, 1})), (Elements{0, 1}));
  EXPECT_TRUE(cover(4, sets, {0, 0, 1}).empty());
  EXPECT_TRUE(cover(4, {}).empty());
  const GainOf against = [](std::size_t, std::span<const std::size_t> left) { return Gain{-1, 1, {left[0]}}; };
  EXPECT_TRUE(greedy_cover(4, 1, against, {kNoLimit, 0, 1}).empty()) << "more speaks against than for";
}

TEST(Cover, EveryRoundAsksEveryCandidateOnceForWhatIsLeft) {
  std::vector<Elements> asked;
  const auto gain_of = [&](std::size_t candidate, std::span<const std::size_t> left) {
    asked.emplace_back(left.begin(), left.end());
    return gain_of_set(candidate == 0 ? Elements{2} : Elements{0, 1}, left);
  };
  EXPECT_EQ(candidates(greedy_cover(3, 2, gain_of, {kNoLimit, 0, 1})), (Elements{1, 0}));
  EXPECT_EQ(asked, (std::vector<Elements>{{0, 1, 2}, {0, 1, 2}, {2}, {2}}));
  asked.clear();
  EXPECT_TRUE(greedy_cover(0, 2, gain_of, {kNoLimit, 0, 1}).empty());
  EXPECT_TRUE(asked.empty()) << "nothing is left to cover";
}

}  // namespace
}  // namespace contact::oracle::cover_test
