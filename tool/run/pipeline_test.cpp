// Production broken on purpose is refuted with the right field named, and oracles that differ stop a run.
#include "tool/run/pipeline.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <mutex>
#include <set>
#include <thread>

#include "contact/cube_cube.hpp"
#include "contact/sphere_sphere.hpp"
#include "golden/agreement.hpp"
#include "golden/query_id.hpp"
#include "golden/right_case.hpp"
#include "tool/reports/table.hpp"
#include "tool/run/fresh.hpp"
#include "tool/run/parts.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {
namespace {

/// Production with one thing changed in its claims.
class Broken final : public engines::Engine {
 public:
  using Change = std::function<void(const Query&, Claim&)>;
  explicit Broken(Change change, const oracle::Declaration& declared = {},
                  std::map<Pair, Conventions> pair_conventions = {})
      : Engine({"broken", "1", {kPairs.begin(), kPairs.end()}, declared, std::move(pair_conventions)}),
        production_(engines::make_built_in("production")),
        change_(std::move(change)) {}

  std::vector<Claim> answer(std::span<const engines::Question> questions) override {
    std::vector<Claim> claims = production_->answer(questions);
    for (std::size_t i = 0; i < questions.size(); ++i) change_(questions[i].query, claims[i]);
    return claims;
  }

 private:
  std::unique_ptr<engines::Engine> production_;
  Change change_;
};

/// The report on what an engine answers to the questions of some sources, in a run of so many.
Report report_on(std::unique_ptr<engines::Engine> engine, const std::vector<Source>& sources, std::uint64_t run = 0) {
  std::vector<Subject> subjects;
  subjects.push_back({std::move(engine), {}});
  subjects.front().report.engine = subjects.front().engine->info();
  Stop never;
  Oracles oracles;
  for (const Source& source : sources) judge_source(source, subjects, never, oracles, run);
  return std::move(subjects.front().report);
}

Source source_of(const std::filesystem::path& path) {
  const golden::DatasetHeader header = golden::dataset_header(path);
  return {header.pair, header.scalar, header.family, header.count, path};
}

/// A golden file in binary64 as a source.
Source committed(Pair pair, const std::string& family) {
  return source_of(std::filesystem::path(CONTACT_SOURCE_DIR) / "golden" / std::string(name(pair)) /
                   (family + ".jsonl"));
}

/// Questions about two spheres as a generator makes them, from the given one on.
Source generated(std::string_view family, std::uint64_t count, std::uint64_t seed, std::uint64_t first = 0) {
  return {Pair::sphere_sphere,
          Scalar::binary64,
          std::string(family),
          count,
          std::nullopt,
          golden::find_family(Pair::sphere_sphere, family),
          seed,
          first};
}

/// The report on every committed file of a pair, the invalid ones aside.
Report judged(Pair pair, Broken::Change change, const oracle::Declaration& declared = {},
              const std::map<Pair, Conventions>& pair_conventions = {}) {
  std::vector<Source> sources;
  for (const auto& path :
       golden::dataset_files({std::filesystem::path(CONTACT_SOURCE_DIR) / "golden" / std::string(name(pair))}))
    if (Source source = source_of(path); source.family != "invalid") sources.push_back(std::move(source));
  return report_on(std::make_unique<Broken>(std::move(change), declared, pair_conventions), sources);
}

/// Which of "overlap", "contact", "normal", ... are wrong, as one text.
std::string wrong_fields(const Report& report) {
  std::string text;
  for (const auto& [field, n] : report.why.wrong()) text += (text.empty() ? "" : " ") + field;
  return text;
}

void in_contact(Claim& claim, const std::function<void(ContactClaim&)>& change) {
  if (claim.contact) change(*claim.contact);
}

TEST(Certify, UnbrokenProductionIsCorrectlyRoundedOnEverySphereFile) {
  const Report report = judged(Pair::sphere_sphere, [](const Query&, Claim&) {});
  EXPECT_TRUE(report.certified());
  EXPECT_EQ(report.level_but_accepted(), Level::correctly_rounded);
  EXPECT_GE(report.judged(), 12U * 2 * 200);
}

TEST(Certify, ANormalOfTheWrongSignIsRefutedAndItsConventionNamed) {
  const Report report = judged(Pair::sphere_sphere, [](const Query&, Claim& claim) {
    in_contact(claim, [](ContactClaim& c) { c.normal = -*c.normal; });
  });
  EXPECT_FALSE(report.certified());
  // Where the centres coincide any unit normal is right, and the points must then go with it: those few are wrong too.
  EXPECT_EQ(wrong_fields(report), "normal point1 point2");
  EXPECT_GT(report.why.wrong().at("normal"), 5 * report.why.wrong().at("point1"));
  const std::vector<std::string> lines = report.why.lines();
  ASSERT_FALSE(lines.empty());
  EXPECT_TRUE(lines[0].starts_with("normal points from second to first")) << lines[0];
  const auto names_convention = [](const std::string& line) {
    return line.find("normal = second-to-first") != std::string::npos;
  };
  EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), names_convention));
}

// What a verdict rests on.

TEST(Verdict, WhereNoNumberIsClaimedTheLevelIsDecisionsAndTheVerdictNamesWhatIsNot) {
  oracle::Declaration declared;
  declared.claims = Aspects{Aspect::overlap};
  Report report = judged(
      Pair::sphere_sphere, [](const Query&, Claim&) {}, declared);
  EXPECT_EQ(report.level_but_accepted(), Level::decisions);
  EXPECT_FALSE(report.certified());
  EXPECT_NE(report.sentence().find("no number was judged"), std::string::npos) << report.sentence();
  EXPECT_NE(report.sentence().find("Not claimed, so not judged: contact, normal, point1, point2, value."),
            std::string::npos)
      << report.sentence();
  report.required = Level::decisions;
  EXPECT_TRUE(report.certified());
}

TEST(Verdict, BoxesThatAnEngineAlwaysHitsAreConservative) {
  const Report wrong = judged(Pair::cube_cube, [](const Query&, Claim& claim) { claim.overlap = true; });
  EXPECT_EQ(wrong.level_but_accepted(), Level::conservative);
  EXPECT_FALSE(wrong.certified());
}

TEST(Verdict, AHundredPercentIsAll) {
  EXPECT_EQ(percent(9'999, 10'000, "{:.3g}"), "99.9 %");
  EXPECT_EQ(percent(99'999, 100'000, "{:.4g}"), "99.99 %");
  EXPECT_EQ(percent(99'999, 100'000, "{:.2f}"), "99.99 %");
  EXPECT_EQ(percent(9'999, 10'000, "{:.1f}"), "99.9 %");
  EXPECT_EQ(percent(99'949, 100'000, "{:.3g}"), "99.9 %");
  EXPECT_EQ(percent(100'000, 100'000, "{:.4g}"), "100 %");
  EXPECT_EQ(percent(2, 3, "{:.4g}"), "66.67 %");
}

TEST(Verdict, TwoFiguresAreNeverLessThanWhatTheyAreMadeOf) {
  for (int exponent = -307; exponent < 300; ++exponent)
    for (int figures = 10; figures < 100; ++figures) {
      const double exact = std::strtod(fmt::format("{}e{}", figures, exponent - 1).c_str(), nullptr);
      EXPECT_EQ(rounded_up(exact), fmt::format("{}.{}e{:+03d}", figures / 10, figures % 10, exponent));
      const double above = std::nextafter(exact, std::numeric_limits<double>::infinity());
      const double up = std::strtod(rounded_up(above).c_str(), nullptr);
      EXPECT_GE(up, above) << rounded_up(above);
      EXPECT_LE(up, 1.11 * exact) << rounded_up(above);
    }
}

// Whether it rests on enough.

TEST(Verdict, TooFewJudgedCasesAreNoCertificate) {
  // Of 210 questions those with no number above the limit, fewer with each.
  std::uint64_t enough = 0;
  std::uint64_t few = 0;
  for (double most = 4; most < 20; most *= 1.1) {
    oracle::Declaration declared;
    declared.conventions.scale_max = most;
    Report report = report_on(std::make_unique<Broken>([](const Query&, Claim&) {}, declared),
                              {committed(Pair::sphere_sphere, "generic")});
    const FamilyReport all = report.total();
    if (all.cases == 0) continue;
    EXPECT_EQ(report.certified(), all.cases >= kLeastJudged && all.decided.both()) << report.sentence();
    enough += report.certified() ? 1 : 0;
    if (all.cases >= kLeastJudged) continue;
    ++few;
    EXPECT_NE(report.sentence().find("of 210 given are fewer than 10"), std::string::npos) << report.sentence();
    report.least_judged = 1;
    EXPECT_EQ(report.certified(), all.decided.both());
    report.least_judged = 0;
    EXPECT_TRUE(report.certified());
  }
  EXPECT_GT(enough, 0U);
  EXPECT_GT(few, 0U);
}

// Fresh questions.

/// An engine that answers as production does where it knows the question, and else as it is told.
class Knowing final : public engines::Engine {
 public:
  Knowing(const std::vector<Source>& sources, Claim otherwise)
      : Engine({"knowing", "1", {kPairs.begin(), kPairs.end()}, {}, {}}),
        production_(engines::make_built_in("production")),
        otherwise_(std::move(otherwise)) {
    for (const Source& source : sources)
      for_each_question(source, [&](const engines::Question& question) { known_.insert(question.id); });
  }

  std::vector<Claim> answer(std::span<const engines::Question> questions) override {
    std::vector<Claim> claims = production_->answer(questions);
    for (std::size_t i = 0; i < questions.size(); ++i)
      if (!known_.contains(questions[i].id)) claims[i] = otherwise_;
    return claims;
  }

 private:
  std::unique_ptr<engines::Engine> production_;
  Claim otherwise_;
  std::set<std::string> known_;
};

Report judged_with_fresh(std::unique_ptr<engines::Engine> engine, std::vector<Source> sources, const AskedFresh& asked,
                         std::uint64_t cut_into = 1) {
  for (Source& source : fresh_beside(sources, asked)) sources.push_back(std::move(source));
  std::vector<Subject> subjects;
  subjects.push_back({std::move(engine), {}});
  Report& report = subjects.front().report;
  report.engine = subjects.front().engine->info();
  report.fresh = fresh_of(sources, false);
  std::vector<Report> reports{report};
  Stop never;
  Oracles oracles;
  if (cut_into == 1) merge(reports, judge_part(sources, subjects, never, oracles), true);
  for (std::uint64_t i = 0; i < cut_into && cut_into != 1; ++i)
    merge(reports, unpack(pack(judge_part(cut(sources, {i, cut_into}), subjects, never, oracles))), i == 0);
  return std::move(reports.front());
}

const std::vector<Source>& published() {
  static const std::vector<Source> files{committed(Pair::sphere_sphere, "generic"),
                                         committed(Pair::sphere_sphere, "touching"),
                                         committed(Pair::sphere_sphere, "upstream")};
  return files;
}
constexpr AskedFresh kFortyTwo{60, golden::kCommittedSeed};  // the seed of the files themselves

TEST(Fresh, WhoKnowsPublishedAnswersAloneIsRefutedAndTheSentenceSaysSo) {
  Claim miss;
  miss.overlap = false;
  miss.speaks_of_contact = true;
  const auto cheat = [&] { return std::make_unique<Knowing>(published(), miss); };
  const Report alone = judged_with_fresh(cheat(), published(), {0, 0});
  EXPECT_TRUE(alone.certified());
  EXPECT_TRUE(alone.sentence().ends_with(" On published questions alone: --fresh 0 left fresh ones out."))
      << alone.sentence();
  const Report report = judged_with_fresh(cheat(), published(), kFortyTwo);
  EXPECT_FALSE(report.certified());
  EXPECT_EQ(report.total().missed_hits, 0U);
  EXPECT_EQ(report.total().cases, 210U + 210U + 891U);
  EXPECT_EQ(report.fresh_total().cases, 120U);  // upstream was recorded, and no generator makes it
  EXPECT_EQ(report.fresh_total().missed_hits, report.fresh_total().hits);
  EXPECT_EQ(report.fresh_failures, report.fresh_total().hits);
  EXPECT_EQ(report.level_but_accepted(), Level::none);
  EXPECT_EQ(report.total().level(false), Level::correctly_rounded);
  EXPECT_TRUE(
      report.sentence().starts_with(fmt::format("REFUTED: knowing 1 is right on published questions alone: on 1311 "
                                                "judged cases (100 % of those given) it reaches "
                                                "correctly-rounded, and does not reach bounded on 120 fresh ones (seed "
                                                "42; no generator makes upstream): {} missed "
                                                "hits, no number was judged. It rests on ",
                                                report.fresh_total().hits)))
      << report.sentence();
}

TEST(Fresh, WhoIsRightOnBothIsCertified) {
  const Report report = judged_with_fresh(engines::make_built_in("production"), published(), kFortyTwo);
  EXPECT_TRUE(report.certified());
  EXPECT_NE(
      report.sentence().find("on all 1311 judged cases (100 % of those given) and on all 120 fresh ones (seed 42; no "
                             "generator makes upstream); bounded was required."),
      std::string::npos)
      << report.sentence();
  EXPECT_NE(report.sentence().find(fmt::format("value; of fresh questions on {} hits and {} misses.",
                                               report.fresh_total().hits, 120 - report.fresh_total().hits)),
            std::string::npos)
      << report.sentence();
}

TEST(Fresh, NoSeedBringsBackWhatAFileHolds) {
  std::set<std::string> known;
  for (const Source& source : published())
    for_each_question(source, [&](const engines::Question& question) { known.insert(question.id); });
  const std::vector<Source> fresh = fresh_beside(published(), kFortyTwo);
  ASSERT_EQ(fresh.size(), 2U);
  for (const Source& source : fresh)
    for_each_question(source, [&](const engines::Question& question) { EXPECT_FALSE(known.contains(question.id)); });
}

TEST(Fresh, ARunInPartsGivesTheSameBytes) {
  const auto report = [](std::uint64_t of) {
    return json_text(
        judged_with_fresh(engines::make_built_in("plain-double"), {published()[0], published()[1]}, {25, 7}, of));
  };
  const std::string whole = report(1);
  EXPECT_EQ(report(3), whole);
  EXPECT_EQ(report(64), whole);
}

TEST(Certify, APairIsJudgedByItsOwnConventions) {
  const auto reversed = [](const Query&, Claim& claim) {
    in_contact(claim, [](ContactClaim& c) { *c.normal = -*c.normal; });
  };
  Conventions own;
  own.normal = NormalDirection::second_to_first;
  EXPECT_TRUE(judged(Pair::sphere_cube, reversed, {}, {{Pair::sphere_cube, own}}).certified());
  EXPECT_FALSE(judged(Pair::sphere_cube, reversed, {}, {{Pair::sphere_sphere, own}}).certified());
}

TEST(Certify, BoxesThatAnEngineCannotTakeAreNotAskedAndCountedAndNoFamilyIsMadeOfThem) {
  oracle::Declaration declared;
  declared.scalar = Scalar::binary32;
  declared.conventions.shapes = ShapesAs::centered;
  declared.conventions.scale_max = 1e30;
  std::atomic<std::uint64_t> asked = 0;
  const Report report = judged(
      Pair::sphere_cube,
      [&](const Query& query, Claim&) {
        ++asked;
        EXPECT_FALSE(oracle::not_served(query, declared));
      },
      declared);
  oracle::Declaration any;
  any.scalar = Scalar::binary32;
  const Report all = judged(
      Pair::sphere_cube, [](const Query&, Claim&) {}, any);
  EXPECT_EQ(asked, report.total().cases);
  EXPECT_EQ(asked + report.skipped_cases(), all.total().cases + all.skipped_cases());
  EXPECT_GT(2 * asked, all.total().cases);
  std::map<std::size_t, int> reasons;  // of each file
  for (const Skipped& skipped : report.skipped) ++reasons[skipped.source];
  EXPECT_TRUE(std::any_of(reasons.begin(), reasons.end(), [](const auto& of) { return of.second == 2; }));
  for (const FamilyReport& family : report.families) EXPECT_GE(family.cases, 20U) << family.family;
}

TEST(Verdict, SaysWhereOneAnswerWouldHaveBeenRightThroughout) {
  FamilyReport family;
  Verdict hit;
  hit.overlap = oracle::Decision::right;
  hit.overlap_expected = true;
  Verdict miss = hit;
  miss.overlap_expected = false;
  EXPECT_FALSE(family.one_answer());
  family.add(hit, hit.level(), "a", true, std::nullopt);
  EXPECT_EQ(family.one_answer(), "hit");
  FamilyReport other;
  other.add(miss, miss.level(), "b", false, std::nullopt);
  EXPECT_EQ(other.one_answer(), "miss");
  other.merge(family);
  EXPECT_FALSE(other.one_answer());
  // One answer of two claims: always an overlap and never a contact.
  FamilyReport mixed;
  hit.contact = oracle::Decision::right;
  hit.contact_expected = false;
  mixed.add(hit, hit.level(), "c", true, std::nullopt);
  EXPECT_EQ(mixed.one_answer(), "the same");

  Report report;
  family.cases = 1;
  report.families.push_back(family);
  EXPECT_NE(report.sentence().find("An engine that always says hit decides every question right."), std::string::npos)
      << report.sentence();
}

/// What plain double does wrong in generated questions of two families, from the given one on, in a run of so many.
oracle::Diagnosis diagnosis_of_plain_double(std::uint64_t first, std::uint64_t count, std::uint64_t run = 0) {
  return report_on(engines::make_built_in("plain-double"),
                   {generated("near_touching", count, 5, first), generated("coincident", count, 5, first)}, run)
      .why;
}

TEST(Certify, OfALargeRunAFewRightAnswersNameTheSameMistakes) {
  const auto of_source = diagnosis_of_plain_double(0, 4000).findings();
  const auto of_run = diagnosis_of_plain_double(0, 4000, 10'000'000).findings();
  ASSERT_FALSE(of_run.empty());
  ASSERT_EQ(of_run.size(), of_source.size());
  for (std::size_t i = 0; i < of_run.size(); ++i) {
    EXPECT_EQ(of_run[i].cause, of_source[i].cause);
    EXPECT_EQ(of_run[i].explained, of_source[i].explained);
  }
}

TEST(Certify, ALargeRunOfRightAnswersIsNotComparedWithMistakes) {
  struct Run {
    std::uint64_t each;
    std::uint64_t sources;
    bool told;  ///< how many questions the run has
  };
  // Of the last every second answer would be too many: 37 of each source.
  for (const auto& [each, sources, told] : {Run{4200, 8, false}, Run{4200, 8, true}, Run{73, 890, true}}) {
    ASSERT_GT(each * sources, oracle::Diagnosis::kPostponed);
    std::vector<Source> all;
    for (std::uint64_t seed = 0; seed < sources; ++seed) all.push_back(generated("generic", each, seed));
    const Report report = report_on(engines::make_built_in("production"), all, told ? each * sources : 0);
    EXPECT_EQ(report.why.compares_at_once(), !told) << sources << " sources of " << each;
  }
}

TEST(Certify, OfALargeRunASampleOfTheWrongClaimsNamesTheSameMistakes) {
  constexpr std::uint64_t kCount = 4000;
  oracle::Diagnosis few = diagnosis_of_plain_double(0, kCount);
  const oracle::Diagnosis second = diagnosis_of_plain_double(kCount, kCount);
  const oracle::Diagnosis third = diagnosis_of_plain_double(2 * kCount, kCount);
  oracle::Diagnosis forwards = few;
  forwards.merge(second);
  forwards.merge(third);
  oracle::Diagnosis backwards = third;
  backwards.merge(second);
  backwards.merge(few);
  EXPECT_EQ(forwards.lines(), backwards.lines());
  const auto of_few = few.findings();
  const auto of_all = forwards.findings();
  ASSERT_EQ(of_few.size(), of_all.size());
  for (std::size_t i = 0; i < of_all.size(); ++i) {
    EXPECT_EQ(of_all[i].cause, of_few[i].cause);
    EXPECT_NEAR(static_cast<double>(of_all[i].explained) / static_cast<double>(3 * of_few[i].explained), 1, 0.05);
    EXPECT_EQ(of_few[i].sentence.find("about"), std::string::npos) << of_few[i].sentence;
    EXPECT_NE(of_all[i].sentence.find("explains about"), std::string::npos) << of_all[i].sentence;
  }
}

TEST(Certify, TouchingTakenForApartIsRefutedAsMissedHits) {
  const Report report = judged(Pair::sphere_sphere, [](const Query& query, Claim& claim) {
    if (oracle::truth_of(query).at_alarm == oracle::Side::at) {
      claim.overlap = false;
      claim.contact.reset();
    }
  });
  EXPECT_FALSE(report.certified());
  EXPECT_EQ(wrong_fields(report), "contact overlap");
  EXPECT_EQ(report.total().false_hits, 0U);
  EXPECT_GE(report.total().missed_hits, 400U);
  EXPECT_GT(report.total().margins.size(), 20U);
  for (const auto& [margin, decisions] : report.total().margins)
    EXPECT_EQ(decisions.wrong, margin.side == 0 ? decisions.claimed : 0);
}

TEST(Certify, ErrorsAreCountedByTheirPowerOfTwo) {
  EXPECT_EQ(power_of(1), 0);
  EXPECT_EQ(power_of(-1.99), 0);
  EXPECT_EQ(power_of(2), 1);
  EXPECT_EQ(power_of(0.49), -2);
  EXPECT_EQ(power_of(1e300), kFarthestPower);
  EXPECT_EQ(power_of(std::numeric_limits<double>::infinity()), kFarthestPower);
  EXPECT_EQ(power_of(std::numeric_limits<double>::denorm_min()), -kFarthestPower);
  // A binary64 normal is measured in ulps of 1, which are 2^-52.
  const Report report = judged(Pair::sphere_sphere, [](const Query& query, Claim& claim) {
    in_contact(claim, [&](ContactClaim& c) {
      if (query.balls()->a.center != query.balls()->b.center) (*c.normal)[0] += 3 * std::ldexp(1, -42);
    });
  });
  const FieldCount normal = report.total().fields[0];
  ASSERT_EQ(normal.errors.size(), 1U);
  EXPECT_EQ(normal.errors.begin()->first, 11);
  EXPECT_EQ(normal.errors.begin()->second, normal.at(Grade::beyond_bound));
  EXPECT_GT(normal.at(Grade::beyond_bound), 1000U);
}

TEST(Certify, TheRadiusOfTheWrongSphereIsRefutedInPoint2) {
  const Report report = judged(Pair::sphere_sphere, [](const Query& query, Claim& claim) {
    in_contact(claim,
               [&](ContactClaim& c) { c.point2 = query.balls()->b.center - query.balls()->a.radius * *c.normal; });
  });
  EXPECT_FALSE(report.certified());
  EXPECT_EQ(wrong_fields(report), "point2");
}

TEST(Certify, AContactDistanceTakenTwiceIsRefutedInValue) {
  const Report report = judged(Pair::sphere_sphere, [](const Query& query, Claim& claim) {
    in_contact(claim, [&](ContactClaim& c) { c.value = *c.value - query.distances.contact; });
  });
  EXPECT_FALSE(report.certified());
  EXPECT_EQ(wrong_fields(report), "value");
}

TEST(Certify, AValueRoundedTwiceIsCertifiedAtBoundedAndRefutedAtCorrectlyRounded) {
  const Report report = judged(Pair::sphere_sphere, [](const Query&, Claim& claim) {
    // Through a format two bits shorter and back: the double rounding of a narrower intermediate.
    in_contact(claim, [](ContactClaim& c) {
      int exponent = 0;
      const double m = std::frexp(*c.value, &exponent);
      const double rounded = std::ldexp(std::nearbyint(std::ldexp(m, 51)), exponent - 51);
      if (std::isfinite(rounded)) c.value = rounded;
    });
  });
  EXPECT_EQ(report.level_but_accepted(), Level::bounded);
  const FieldCount value = report.total().fields[static_cast<std::size_t>(Field::value)];
  EXPECT_GT(value.at(Grade::bounded), 1000U);
  EXPECT_EQ(report.total().fields[static_cast<std::size_t>(Field::normal)].judged(),
            report.total().fields[static_cast<std::size_t>(Field::normal)].at(Grade::correctly_rounded));
}

TEST(Certify, OpenBoxesAreRefutedAsMissedHits) {
  const Report report = judged(Pair::cube_cube, [](const Query& query, Claim& claim) {
    if (oracle::truth_of(query).at_alarm == oracle::Side::at) claim.overlap = false;
  });
  EXPECT_FALSE(report.certified());
  EXPECT_EQ(wrong_fields(report), "overlap");
}

TEST(Certify, AnUnsupportedAnswerNeverPassesUnlessAllowed) {
  Report report = judged(Pair::cube_cube, [](const Query& query, Claim& claim) {
    if (query.distances.alarm > 0) {
      claim = {};
      claim.status = Claim::Status::unsupported;
    }
  });
  EXPECT_FALSE(report.certified());
  report.allow_unsupported = true;
  EXPECT_TRUE(report.certified());
  EXPECT_LT(report.judged(), report.total().cases);
  // Whole families are left out (every alarm_edge has an alarm distance): that is no failure in JUnit either.
  EXPECT_EQ(junit_text(report).find("<failure"), std::string::npos);
}

TEST(Certify, NothingJudgedNeverCertifies) { EXPECT_FALSE(Report{}.certified()); }

TEST(Certify, OraclesThatDifferAreAnOracleFault) {
  const Query query{Pair::sphere_sphere, Balls{{{0, 0, 0}, 1.5}, {{1, 2, 2}, 1.5}}, {0, 0.25}};
  const oracle::RoundedAnswer exact = oracle::rounded_answer(oracle::truth_of(query), Scalar::binary64);
  oracle::RoundedAnswer second = oracle::interval_answer(query, Scalar::binary64);
  EXPECT_NO_THROW(golden::require_agreement(query, exact, second, Scalar::binary64));
  second.expected.contact->value = std::nextafter(second.expected.contact->value, 0.0);
  EXPECT_THROW(golden::require_agreement(query, exact, second, Scalar::binary64), golden::OracleFault);
  second = oracle::interval_answer(query, Scalar::binary64);
  second.at_zero = -1;
  EXPECT_THROW(golden::require_agreement(query, exact, second, Scalar::binary64), golden::OracleFault);
}

TEST(Sample, has_every_question_of_a_small_source_and_all_where_all_are_wanted) {
  const std::string outside = "0001";  // a multiple of no n but 1
  for (const oracle::Stage stage : {oracle::Stage::double_double, oracle::Stage::interval, oracle::Stage::exact}) {
    EXPECT_TRUE(is_checked(Check::sample, kWhole, outside, stage));
    EXPECT_FALSE(is_checked(Check::sample, kWhole + 1, outside, stage));
    EXPECT_TRUE(is_checked(Check::all, kWhole + 1, outside, stage));
    EXPECT_TRUE(is_checked(Check::sample, kWhole + 1, "0000", stage));
  }
  EXPECT_TRUE(is_checked(Check::sample, kWhole + 1, "0010", oracle::Stage::interval));
  EXPECT_FALSE(is_checked(Check::sample, kWhole + 1, "0010", oracle::Stage::double_double));
}

TEST(Sample, of_a_large_source_is_one_in_1024_and_of_the_hard_questions_one_in_16) {
  const golden::Family& generic = *golden::find_family(Pair::cube_cube, "generic");
  constexpr std::uint64_t kCount = 50'000;
  std::uint64_t quick = 0;
  std::uint64_t hard = 0;
  for (std::uint64_t i = 0; i < kCount; ++i) {
    const std::string id = golden::query_id(golden::generate_query(Pair::cube_cube, generic, Scalar::binary64, 3, i));
    quick += is_checked(Check::sample, kCount, id, oracle::Stage::double_double) ? 1 : 0;
    hard += is_checked(Check::sample, kCount, id, oracle::Stage::exact) ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(quick), kCount / 1024.0, 25);  // 3.6 standard deviations
  EXPECT_NEAR(static_cast<double>(hard), kCount / 16.0, 200);
}

/// What is said of an engine that is wrong about some points, by so many threads.
std::string report_by(std::size_t threads, bool fail_fast) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  std::vector<Subject> subjects;
  std::atomic<bool> waited = threads == 1;
  subjects.push_back({std::make_unique<Broken>([&](const Query& query, Claim& claim) {
                        // Long enough for other threads to be done with what comes later.
                        if (!waited.exchange(true)) std::this_thread::sleep_for(std::chrono::milliseconds(100));
                        if (query.distances.contact > 0.9)
                          in_contact(claim, [](ContactClaim& c) { c.point1 = 2 * *c.point1; });
                      }),
                      {}});
  subjects.front().report.engine = subjects.front().engine->info();
  Stop stop;
  stop.at_first_failure = fail_fast;
  Oracles oracles;
  constexpr std::uint64_t kCount = 6000;  // more than a sample has in full
  for (const std::string_view family : {"generic", "touching"})
    judge_source(generated(family, kCount, 11), subjects, stop, oracles);
  if (!fail_fast) {
    EXPECT_EQ(oracles.decided.answers[0] + oracles.decided.answers[1] + oracles.decided.answers[2], 2 * kCount);
    EXPECT_GT(oracles.checked, 0U);
    EXPECT_LT(oracles.checked, kCount);
  }
  EXPECT_FALSE(subjects.front().report.certified());
  return json_text(subjects.front().report);
}

/// Production that keeps how many questions it is asked at a time.
class Counting final : public engines::Engine {
 public:
  Counting(bool alone, std::multiset<std::size_t>& sizes)
      : Engine(engines::make_built_in("production")->info()), alone_(alone), sizes_(sizes) {}
  std::vector<Claim> answer(std::span<const engines::Question> questions) override {
    const std::scoped_lock lock(mutex_);
    sizes_.insert(questions.size());
    return production_->answer(questions);
  }
  [[nodiscard]] bool answers_each_alone() const override { return alone_; }

 private:
  std::unique_ptr<engines::Engine> production_ = engines::make_built_in("production");
  bool alone_;
  std::mutex mutex_;
  std::multiset<std::size_t>& sizes_;
};

TEST(Pipeline, of_a_small_source_many_questions_at_once_go_to_who_needs_them_and_few_to_others) {
  const auto sizes_of = [](std::vector<bool> engines) {
    std::multiset<std::size_t> sizes;
    std::vector<Subject> subjects;
    for (const bool alone : engines) {
      subjects.push_back({std::make_unique<Counting>(alone, sizes), {}});
      subjects.back().report.engine = subjects.back().engine->info();
    }
    Stop never;
    Oracles oracles;
    judge_source(generated("generic", 40, 1), subjects, never, oracles);
    return sizes;
  };
  EXPECT_EQ(sizes_of({false}), (std::multiset<std::size_t>{32, 8}));
  EXPECT_EQ(sizes_of({true}).count(2), 20U);
  EXPECT_EQ(sizes_of({true, false}).count(32), 2U);
  EXPECT_TRUE(engines::make_built_in("plain-double")->answers_each_alone());
  EXPECT_FALSE(engines::make_built_in("batch")->answers_each_alone());
}

TEST(Pipeline, a_report_does_not_depend_on_the_threads) {
  const std::string one = report_by(1, false);
  EXPECT_EQ(one, report_by(2, false));
  EXPECT_EQ(one, report_by(5, false));
  const std::string first = report_by(1, true);
  EXPECT_NE(one, first);
  EXPECT_EQ(first, report_by(5, true));
}

/// What a dataset is refused with, by so many threads; each line of it is one question of the family, some with
/// changes.
std::string refusal_by(std::size_t threads,
                       const std::map<std::uint64_t, std::pair<std::string, std::string>>& changes) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  const auto path = std::filesystem::temp_directory_path() / fmt::format("contact-pipeline-test-{}.jsonl", threads);
  constexpr std::uint64_t kCount = 300;
  golden::DatasetHeader header;
  header.family = "generic";
  header.seed = 5;
  header.count = kCount;
  {
    std::ofstream file(path);
    file << to_line(header) << '\n';
    for (std::uint64_t i = 0; i < kCount; ++i) {
      std::string line = to_line(golden::make_case(
          golden::generate_query(header.pair, *golden::find_family(header.pair, header.family), header.scalar, 5, i),
          header.scalar));
      if (const auto change = changes.find(i); change != changes.end()) {
        const auto& [from, to] = change->second;
        line.replace(line.find(from), from.size(), to);
      }
      file << line << '\n';
    }
  }
  std::string refusal;
  try {
    static_cast<void>(report_on(engines::make_built_in("production"), {source_of(path)}));
  } catch (const formats::InputError& error) {
    refusal = error.what();
  }
  std::filesystem::remove(path);
  return refusal.substr(std::min(refusal.size(), refusal.find(".jsonl")));
}

TEST(Pipeline, a_dataset_is_refused_for_its_first_fault_whatever_the_threads) {
  const std::pair<std::string, std::string> wrong_hit{R"("expect":{"hit":)", R"("expect":{"hit":1)"};
  const std::pair<std::string, std::string> wrong_distance{R"("distance2":"0x)", R"("distance2":"0x1)"};
  for (const std::size_t threads : {std::size_t{1}, std::size_t{5}}) {
    EXPECT_EQ(refusal_by(threads, {}), "");
    // The reader meets line 102 long before line 72 is judged, and that one is named.
    const std::string refusal = refusal_by(threads, {{70, wrong_distance}, {100, wrong_hit}});
    EXPECT_TRUE(refusal.starts_with(".jsonl:72: exact.distance2: the file says 0x1")) << refusal;
  }
}

}  // namespace
}  // namespace contact::tool
