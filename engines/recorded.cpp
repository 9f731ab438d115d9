// An engine that answers from a results file.
#include <algorithm>
#include <atomic>

#include "engines/engine.hpp"

namespace contact::engines {
namespace {

class RecordedEngine final : public Engine {
 public:
  explicit RecordedEngine(golden::Results results) : Engine(results.engine), claims_(std::move(results.claims)) {}

  std::vector<Claim> answer(std::span<const Question> questions) override {
    std::vector<Claim> claims;
    claims.reserve(questions.size());
    for (const Question& question : questions) {
      const auto it = claims_.find(question.id);
      if (it != claims_.end()) {
        ++asked_;
        claims.push_back(it->second);
      } else {
        claims.emplace_back();
        claims.back().status = Claim::Status::missing;
        claims.back().text = "the results file has no answer to this question";
      }
    }
    return claims;
  }

  [[nodiscard]] std::uint64_t unasked() const override {
    return claims_.size() - std::min<std::uint64_t>(claims_.size(), asked_);
  }

 private:
  std::unordered_map<std::string, Claim> claims_;
  std::atomic<std::uint64_t> asked_ = 0;
};

}  // namespace

std::unique_ptr<Engine> make_recorded(golden::Results results) {
  return std::make_unique<RecordedEngine>(std::move(results));
}

}  // namespace contact::engines
