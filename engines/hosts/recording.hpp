// An engine whose answers are kept as they are given: what a results file is made from.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "engines/engine.hpp"

namespace contact::engines {

/// Asks another engine and keeps what it says, in memory. Where a question is asked twice and answered in two ways,
/// answer() throws formats::InputError: a results file holds one answer to a question.
class Recording final : public Engine {
 public:
  explicit Recording(std::unique_ptr<Engine> engine);

  [[nodiscard]] std::vector<Claim> answer(std::span<const Question> questions) override;
  [[nodiscard]] std::vector<std::string> unasked() const override { return engine_->unasked(); }
  [[nodiscard]] std::uint64_t decimals() const override { return engine_->decimals(); }

  /// The other engine.
  [[nodiscard]] Engine& recorded() { return *engine_; }
  /// How many questions were answered.
  [[nodiscard]] std::size_t answers() const;
  /// The results file, its answers in the order of their ids, whatever the order in which they came. A question that
  /// got no answer (a crash, a timeout) stands not in it.
  [[nodiscard]] std::string results() const;

 private:
  std::unique_ptr<Engine> engine_;
  std::mutex mutex_;
  std::map<std::string, std::string> lines_;  ///< by id; empty where there was no answer
};

}  // namespace contact::engines
