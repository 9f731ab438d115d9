// Production broken on purpose is refuted with the right field named, and oracles that differ stop a run.
#include "tool/pipeline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "contact/cube_cube.hpp"
#include "contact/sphere_sphere.hpp"
#include "tool/process.hpp"

namespace contact::tool {
namespace {

/// Production with one thing changed in its claims.
class Broken final : public engines::Engine {
 public:
  using Change = std::function<void(const Query&, Claim&)>;
  explicit Broken(Change change)
      : Engine({"broken", "1", {kPairs.begin(), kPairs.end()}, {}}),
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

/// The report on every committed file of a pair, the invalid ones aside.
Report judged(Pair pair, Broken::Change change) {
  std::vector<Subject> subjects;
  subjects.push_back({std::make_unique<Broken>(std::move(change)), {}});
  subjects.front().report.engine = subjects.front().engine->info();
  Stop never;
  for (const auto& path :
       golden::dataset_files({std::filesystem::path(CONTACT_SOURCE_DIR) / "golden" / std::string(name(pair))})) {
    const golden::DatasetHeader header = golden::DatasetReader(path).header();
    if (header.family != "invalid")
      judge_source({header.pair, header.scalar, header.family, header.count, path}, subjects, never);
  }
  return std::move(subjects.front().report);
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
  EXPECT_EQ(report.level(), Level::correctly_rounded);
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

TEST(Certify, TouchingTakenForApartIsRefutedAsMissedHits) {
  const Report report = judged(Pair::sphere_sphere, [](const Query& query, Claim& claim) {
    if (oracle::truth_of(query).at_alarm == CGAL::ZERO) {
      claim.overlap = false;
      claim.contact.reset();
    }
  });
  EXPECT_FALSE(report.certified());
  EXPECT_EQ(wrong_fields(report), "contact overlap");
  EXPECT_EQ(report.total().false_hits, 0U);
  EXPECT_GE(report.total().missed_hits, 400U);
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
  EXPECT_EQ(report.level(), Level::bounded);
  const FieldCount value = report.total().fields[static_cast<std::size_t>(Field::value)];
  EXPECT_GT(value.at(Grade::bounded), 1000U);
  EXPECT_EQ(report.total().fields[static_cast<std::size_t>(Field::normal)].judged(),
            report.total().fields[static_cast<std::size_t>(Field::normal)].at(Grade::correctly_rounded));
}

TEST(Certify, OpenBoxesAreRefutedAsMissedHits) {
  const Report report = judged(Pair::cube_cube, [](const Query& query, Claim& claim) {
    if (oracle::truth_of(query).at_alarm == CGAL::ZERO) claim.overlap = false;
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
  const oracle::Truth truth = oracle::truth_of(query);
  oracle::RoundedAnswer second = oracle::interval_answer(query, Scalar::binary64);
  EXPECT_NO_THROW(require_agreement(query, truth, second, Scalar::binary64));
  second.expected.contact->value = std::nextafter(second.expected.contact->value, 0.0);
  EXPECT_THROW(require_agreement(query, truth, second, Scalar::binary64), OracleFault);
  second = oracle::interval_answer(query, Scalar::binary64);
  second.at_zero = -1;
  EXPECT_THROW(require_agreement(query, truth, second, Scalar::binary64), OracleFault);
}

}  // namespace
}  // namespace contact::tool
