// Whatever answers questions: built in, or a recorded results file.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "golden/results.hpp"
#include "oracle/claim.hpp"
#include "oracle/query.hpp"

namespace contact::engines {

/// A question with its id: what an engine is asked.
struct Question {
  std::string id;
  Query query;
};

/// Answers questions. Engines may be asked from several threads at once.
class Engine {
 public:
  explicit Engine(golden::EngineInfo info) : info_(std::move(info)) {}
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  virtual ~Engine() = default;

  [[nodiscard]] const golden::EngineInfo& info() const { return info_; }
  /// One claim for each question, in their order.
  [[nodiscard]] virtual std::vector<Claim> answer(std::span<const Question> questions) = 0;
  /// Recorded answers that no question has asked for.
  [[nodiscard]] virtual std::uint64_t unasked() const { return 0; }

 protected:
  /// For engines that say who they are only after they have been started.
  void set_info(golden::EngineInfo info) { info_ = std::move(info); }

 private:
  golden::EngineInfo info_;
};

/// An engine that is part of this program.
struct BuiltIn {
  std::string_view name;
  std::string_view about;
  Scalar scalar;
  /// Answers under a contact-point convention: what computeIntersection and testIntersection say.
  Claim (*answer)(const Query& query, Points points);
};

[[nodiscard]] std::span<const BuiltIn> built_in_engines();

/// The built-in engine of that name, or nullptr. `points` other than nearest_surface make it compute and declare
/// another convention (center and published only).
[[nodiscard]] std::unique_ptr<Engine> make_built_in(std::string_view name, Points points = Points::nearest_surface);

/// An engine that answers from a results file; what stands not in it is missing.
[[nodiscard]] std::unique_ptr<Engine> make_recorded(golden::Results results);

/// The contact points of a pair under one of the conventions that the production class offers.
[[nodiscard]] ContactPoints contact_points(const Query& query, Points points);

}  // namespace contact::engines
