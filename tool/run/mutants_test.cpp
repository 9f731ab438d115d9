// Every mutant against the committed golden files: told why it is refuted.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "engines/zoo/mutants.hpp"
#include "tool/run/pipeline.hpp"

namespace contact::tool {
namespace {

// Every mutant and question in the campaign, and each mistake with two points and with one; else these, in turns.
const bool kEvery = std::getenv("CONTACT_EVERY_QUESTION") != nullptr;
const std::size_t kStep = kEvery ? 1 : 480;         // of the mutants one
const std::size_t kStepOfPlanted = kEvery ? 1 : 3;  // of the mistakes that were reported
const std::size_t kStepOfFiles = kEvery ? 1 : 12;   // of the files about which plain arithmetic is asked everything
const std::uint64_t kQuestions = kEvery ? golden::kCommittedCount : 42;  // of a file: all classes take their turn
const std::uint64_t kOfConvexes =
    kEvery ? 20 : 3;  // of any two convex shapes, whose causes are asked of the exact truth

/// The mutants that are asked.
std::vector<engines::Mutant> asked() {
  std::vector<engines::Mutant> some;
  for (std::size_t i = 0; i < engines::mutants().size(); i += kStep) some.push_back(engines::mutants()[i]);
  return some;
}

/// Each of them over the first questions of every generated file, in one pass.
const std::vector<Subject>& judged() {
  static const std::vector<Subject> all = [] {
    std::vector<Subject> subjects;
    for (const engines::Mutant& m : asked()) {
      subjects.push_back({engines::make_mutant(m.id), {}});
      subjects.back().report.engine = subjects.back().engine->info();
    }
    Stop never;
    Oracles oracles;
    for (const golden::CommittedFile& file : golden::committed_files())
      judge_source({file.pair, file.scalar, std::string(file.family->name),
                    is_convex(file.pair) ? kOfConvexes : kQuestions, std::nullopt, file.family, golden::kCommittedSeed},
                   subjects, never, oracles);
    return subjects;
  }();
  return all;
}

/// The mutants whose first diagnosis is another than the expected one, and why that is as it should be.
const std::map<std::string_view, std::string_view> kOtherwiseDiagnosed{
    {"box-euclidean", "so few boxes are near each other's corners that 42 questions of a file do not refute it"},
    {"box-x-twice", "y left out explains nearly the same questions"},
    {"coal-points-collapsed", "its other mistake, one point for both spheres, explains more and is named first"},
    {"triangle-face-dropped", "so few of the triangles are small that 42 questions of a file show one wrong answer"},
    {"narrowed-1e-12", "no question of so few lies between the two tolerances: 1e-14 is named"},
};

TEST(Mutants, the_first_diagnosis_of_at_least_95_in_100_names_the_mistake) {
  std::size_t right = 0;
  const std::vector<engines::Mutant> mutants = asked();
  for (std::size_t i = 0; i < mutants.size(); ++i) {
    const engines::Mutant& m = mutants[i];
    const auto found = judged()[i].report.why.findings();
    const bool named = !found.empty() && found.front().cause == m.cause;
    right += named ? 1 : 0;
    if (!named && !kOtherwiseDiagnosed.contains(m.id))
      ADD_FAILURE() << m.id << " should be diagnosed as " << m.cause << ", and is as\n  "
                    << (found.empty() ? "nothing" : std::string(found.front().cause) + ": " + found.front().sentence);
  }
  EXPECT_GE(right * 100, mutants.size() * 95);
  RecordProperty("right", std::to_string(right) + " of " + std::to_string(mutants.size()));
}

/// Asks engines the first questions of a file.
void ask(const golden::CommittedFile& file, std::uint64_t questions, std::vector<Subject>& engines) {
  Stop never;
  Oracles oracles;
  judge_source({file.pair, file.scalar, std::string(file.family->name), questions, std::nullopt, file.family,
                golden::kCommittedSeed},
               engines, never, oracles);
}
Subject subject_of(std::unique_ptr<engines::Engine> engine) {
  Subject subject{std::move(engine), {}};
  subject.report.engine = subject.engine->info();
  return subject;
}

/// A mistake that users of public engines reported, as an engine of one pair makes it.
struct Planted {
  std::string_view mutant;
  Pair pair;
  std::string_view cause;
};
const std::vector<Planted> kPlanted{
    {"mujoco-in-box-depth", Pair::sphere_cube, "sphere-box-depth-missing"},
    {"cglm-below-min-face", Pair::sphere_cube, "sphere-box-max-for-both"},
    {"trimesh-coplanar-face", Pair::sphere_cube, "sphere-box-coplanar-face"},
    {"open3d-ray-parity", Pair::sphere_cube, "sphere-box-sign-by-parity"},
    {"cyclone-capsule-radius", Pair::sphere_capsule, "capsule-radius-missing"},
    {"mjx-segment-1e-6", Pair::sphere_capsule, "parameter-divided-by-length-plus-1e-6"},
    {"stride-caps-in-length", Pair::sphere_capsule, "capsule-caps-in-length"},
    {"simple-collider-caps-added", Pair::capsule_capsule, "capsule-caps-added"},
    {"fcl-capsule-origin", Pair::capsule_capsule, "capsule-from-middle"},
    {"sceneview-segment-sign", Pair::capsule_capsule, "segments-offset-reversed"},
    {"rdk-segment-sign", Pair::capsule_capsule, "segments-first-term-sign"},
    {"line2point-sign", Pair::capsule_capsule, "segments-second-term-sign"},
    {"segments-w-of-first", Pair::capsule_capsule, "segments-offset-of-first"},
    {"segments-w-of-second", Pair::capsule_capsule, "segments-offset-of-second"},
    {"meshes-jl-clamps-alone", Pair::capsule_capsule, "parameters-clamped-alone"},
    {"godot-parallel-nan", Pair::capsule_capsule, "parallel-not-finite"},
    {"mjx-capsule-capsule", Pair::capsule_capsule, "segments-plus-1e-6"},
    {"newton-capsule-capsule", Pair::capsule_capsule, "segments-plus-1e-6"},
    {"three-mesh-bvh-weights", Pair::sphere_triangle, "triangle-weights-rotated"},
    {"sdf-barycentric-sign", Pair::sphere_triangle, "triangle-weight-negated"},
    {"trimesh-obtuse-vertex", Pair::sphere_triangle, "triangle-vertex-by-signs"},
    {"triangle-face-dropped", Pair::sphere_triangle, "triangle-face-dropped-1e-4"},
    {"parry-flat-triangle-zero", Pair::sphere_triangle, "triangle-flat-zero"},
    {"parry-flat-triangle-nan", Pair::sphere_triangle, "triangle-flat-not-finite"},
    {"wicked-ray-from-inside", Pair::ray_sphere, "ray-from-inside-missed"},
    {"collision-rs-ray-direction", Pair::ray_sphere, "ray-direction-unit"},
    {"bevy-plane-not-divided", Pair::sphere_plane, "plane-decision-not-divided"},
    {"byro-capsule-midpoint", Pair::capsule_plane, "capsule-around-start"},
    {"crossing-determinant-1e-6", Pair::ray_triangle, "crossing-determinant-1e-6"},
    {"crossing-infinite-line", Pair::triangle_line, "crossing-without-ends"},
};

/// An engine with one midpoint in the place of two points, where `midpoint` is set.
class Pointing final : public engines::Engine {
 public:
  Pointing(std::unique_ptr<engines::Engine> engine, bool midpoint)
      : Engine(declaring(engine->info(), midpoint)), engine_(std::move(engine)), midpoint_(midpoint) {}

  std::vector<Claim> answer(std::span<const engines::Question> questions) override {
    std::vector<Claim> claims = engine_->answer(questions);
    for (Claim& claim : claims) {
      if (!claim.contact || !midpoint_) continue;
      claim.contact->point = Vector3(*claim.contact->point1 / 2 + *claim.contact->point2 / 2);
      claim.contact->point1.reset();
      claim.contact->point2.reset();
    }
    return claims;
  }

 private:
  static engines::EngineInfo declaring(engines::EngineInfo info, bool midpoint) {
    if (midpoint) info.declared.conventions.points = Points::midpoint;
    return info;
  }
  std::unique_ptr<engines::Engine> engine_;
  bool midpoint_;
};

TEST(Mutants, a_mistake_that_was_reported_is_named_in_the_first_line_of_the_pair_that_it_is_about) {
  for (const Pair pair : kPairs) {
    std::vector<Subject> subjects;
    std::vector<Planted> planted;
    for (std::size_t i = 0; i < kPlanted.size(); ++i)
      for (const bool midpoint : {false, true}) {
        const Planted& p = kPlanted[i];
        if (p.pair != pair || i % kStepOfPlanted != 0 || (!kEvery && midpoint != (i % 2 == 1))) continue;
        auto engine = engines::make_mutant(p.mutant);
        ASSERT_NE(engine, nullptr) << p.mutant;
        subjects.push_back(subject_of(std::make_unique<Pointing>(std::move(engine), midpoint)));
        planted.push_back(p);
      }
    if (planted.empty()) continue;
    for (const golden::CommittedFile& file : golden::committed_files())
      if (file.pair == pair) ask(file, std::min(2 * kQuestions, golden::kCommittedCount), subjects);
    for (std::size_t i = 0; i < planted.size(); ++i) {
      const auto found = subjects[i].report.why.findings();
      ASSERT_FALSE(found.empty()) << planted[i].mutant;
      EXPECT_EQ(found.front().cause, planted[i].cause) << planted[i].mutant << ": " << found.front().sentence;
    }
  }
}

/// What is true of plain arithmetic, in any of the golden files.
const std::set<std::string_view> kTrueOfPlainDouble{"rounding",          "square-range",      "sum-range",
                                                    "normal-not-finite", "answer-not-finite", "points-not-finite",
                                                    "value-not-finite"};
const std::set<std::string_view> kTrueOfPlainFloat{"rounding-single",   "single-decision",   "square-range",
                                                   "sum-range",         "normal-not-finite", "answer-not-finite",
                                                   "points-not-finite", "value-not-finite"};

TEST(Mutants, plain_arithmetic_is_never_told_of_a_mistake_that_it_does_not_make) {
  std::size_t told = 0;
  // Each family alone; of two convex shapes, whose families are small, all of a pair together.
  std::map<std::string, std::vector<golden::CommittedFile>> together;
  for (const golden::CommittedFile& file : golden::committed_files())
    if (!file.family->outside_domain)
      together[is_convex(file.pair) ? fmt::format("{} {}", name(file.pair), name(file.scalar)) : file.path()].push_back(
          file);
  std::size_t at = 0;
  for (const auto& [title, files] : together) {
    if (at++ % kStepOfFiles != 0) continue;
    const golden::CommittedFile& file = files.front();
    std::vector<Subject> subjects;
    for (const char* name : {"plain-double", "plain-float"})
      subjects.push_back(subject_of(engines::make_built_in(name)));
    for (const golden::CommittedFile& each : files)
      ask(each, is_convex(each.pair) ? 2 * kOfConvexes : golden::kCommittedCount, subjects);
    for (const Subject& subject : subjects) {
      const auto found = subject.report.why.findings();
      if (found.empty()) continue;
      ++told;
      const auto& allowed =
          subject.report.engine.declared.scalar == Scalar::binary32 ? kTrueOfPlainFloat : kTrueOfPlainDouble;
      // Of rays in a triangle's plane, where plain arithmetic divides by 0, it misses all.
      const bool misses_all = found.front().cause == "never-hit" && file.pair == Pair::cast_triangle;
      EXPECT_TRUE(found.front().cause.empty() || allowed.contains(found.front().cause) || misses_all)
          << subject.report.engine.name << " in " << title << ": " << found.front().sentence;
    }
  }
  EXPECT_GT(told, 100U / kStepOfFiles);
}

}  // namespace
}  // namespace contact::tool
