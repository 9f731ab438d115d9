// Whatever answers questions: built in, or a recorded results file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "contact/contact.hpp"
#include "engines/protocol/results.hpp"
#include "oracle/judge/claim.hpp"
#include "oracle/truth/query.hpp"

namespace contact::engines {

/// A question with its id: what an engine is asked.
struct Question {
  std::string id;
  Query query;
  std::uint64_t index = 0;  ///< its place among the questions that it was read or generated with
};

/// Answers questions. Engines may be asked from several threads at once.
class Engine {
 public:
  explicit Engine(engines::EngineInfo info) : info_(std::move(info)) {}
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  virtual ~Engine() = default;

  [[nodiscard]] const engines::EngineInfo& info() const { return info_; }
  /// One claim for each question, in their order.
  [[nodiscard]] virtual std::vector<Claim> answer(std::span<const Question> questions) = 0;
  /// Whether it takes no longer for questions one by one, and needs no others beside one.
  [[nodiscard]] virtual bool answers_each_alone() const { return false; }
  /// A question that is not asked, because the engine is judged on others alone.
  virtual void pass_over(const Question& /*question*/) {}
  /// The ids of recorded answers that no question has asked for, in their order.
  [[nodiscard]] virtual std::vector<std::string> unasked() const { return {}; }
  /// How many numbers it wrote as decimals of binary32 numbers, and is judged by these.
  [[nodiscard]] virtual std::uint64_t decimals() const { return 0; }

 protected:
  /// For engines that say who they are only after they have been started.
  void set_info(engines::EngineInfo info) { info_ = std::move(info); }

 private:
  engines::EngineInfo info_;
};

/// An engine that is a function.
class FunctionEngine final : public Engine {
 public:
  using Function = std::function<std::vector<Claim>(std::span<const Question>)>;
  FunctionEngine(engines::EngineInfo info, Function function, bool each_alone = false)
      : Engine(std::move(info)), function_(std::move(function)), each_alone_(each_alone) {}
  std::vector<Claim> answer(std::span<const Question> questions) override { return function_(questions); }
  [[nodiscard]] bool answers_each_alone() const override { return each_alone_; }

 private:
  Function function_;
  bool each_alone_;
};

/// The contact-point conventions that built-in engines compute, and their names: the first of Points.
inline constexpr auto kComputedPointsNames = std::span(kPointsNames).first<3>();
static_assert(static_cast<int>(Points::nearest_surface) == static_cast<int>(PointConvention::nearest_surface) &&
              static_cast<int>(Points::center) == static_cast<int>(PointConvention::center) &&
              static_cast<int>(Points::published) == static_cast<int>(PointConvention::published));

/// An engine that is part of this program.
struct BuiltIn {
  std::string_view name;
  std::string_view about;
  Scalar scalar;
  bool on_scoreboard;  ///< whether `certify` with neither engine nor dataset judges it
  /// Answers under a contact-point convention: what computeIntersection and testIntersection say.
  std::vector<Claim> (*answer)(std::span<const Question> questions, PointConvention points);
  bool (*serves)(Pair pair);
};

[[nodiscard]] std::span<const BuiltIn> built_in_engines();

/// Before the name of an instruction set in the name of an engine.
inline constexpr std::string_view kBatchPrefix = "batch:";

/// The built-in engine of that name, or nullptr; it computes and declares the convention `points`. `batch:SET` is
/// `batch` with vectors of one instruction set, which from then on serves every batch call of the process.
[[nodiscard]] std::unique_ptr<Engine> make_built_in(std::string_view name,
                                                    PointConvention points = PointConvention::nearest_surface);

/// An engine that answers from a results file; what stands not in it is missing. Columns answer row by row, and in
/// memory that does not grow, where all questions are `rows` of one dataset; else by their ids. Throws
/// formats::InputError where there are more rows or fewer.
[[nodiscard]] std::unique_ptr<Engine> make_recorded(const std::filesystem::path& path,
                                                    std::optional<std::uint64_t> rows);
/// How many answers a results file has.
[[nodiscard]] std::uint64_t count_recorded(const std::filesystem::path& path);

/// The engine `production`.
[[nodiscard]] Claim production_answer(const Query& query, PointConvention points);
/// The engine `component`: production through DiscreteIntersection, each question as two models of one element.
[[nodiscard]] Claim component_answer(const Query& query, PointConvention points);
/// Whether both shapes of a pair have models, and these an intersector.
[[nodiscard]] bool component_serves(Pair pair);
/// Whether a pair has batch functions.
[[nodiscard]] bool batch_serves(Pair pair);
/// The engine `batch`: each question among those that stand beside it, in its own distances.
[[nodiscard]] std::vector<Claim> batch_answers(std::span<const Question> questions, PointConvention points);

/// The instruction sets that `batch` may use here, in Highway's names, best first.
[[nodiscard]] std::vector<std::string> batch_instruction_sets();
/// That one serves from now on; with an empty name the best again. Throws std::invalid_argument for one not here.
void use_batch_instruction_set(std::string_view name);

/// The points that a pair of models has under a convention.
[[nodiscard]] ContactPoints contact_points(const Query& query, PointConvention convention);

/// What an engine of ours says to a question outside the domain.
[[nodiscard]] Claim rejection(const DomainError& error);

}  // namespace contact::engines
