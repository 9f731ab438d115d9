// An engine that answers from a results file.
#include <algorithm>
#include <atomic>

#include "engines/engine.hpp"

namespace contact::engines {
namespace {

class RecordedEngine final : public Engine {
 public:
  explicit RecordedEngine(engines::Results results) : Engine(std::move(results.engine)) {
    for (auto& [id, claim] : results.claims) recorded_.try_emplace(id, std::move(claim));
  }

  std::vector<Claim> answer(std::span<const Question> questions) override {
    std::vector<Claim> claims;
    claims.reserve(questions.size());
    for (const Question& question : questions) {
      const auto it = recorded_.find(question.id);
      if (it != recorded_.end()) {
        it->second.asked = true;
        claims.push_back(it->second.claim);
      } else {
        claims.emplace_back();
        claims.back().status = Claim::Status::missing;
        claims.back().text = "the results file has no answer to this question";
      }
    }
    return claims;
  }

  void pass_over(const Question& question) override {
    if (const auto it = recorded_.find(question.id); it != recorded_.end()) it->second.asked = true;
  }

  [[nodiscard]] std::vector<std::string> unasked() const override {
    std::vector<std::string> ids;
    for (const auto& [id, answer] : recorded_)
      if (!answer.asked) ids.push_back(id);
    std::sort(ids.begin(), ids.end());
    return ids;
  }

 private:
  struct Recorded {
    explicit Recorded(Claim given) : claim(std::move(given)) {}
    Claim claim;
    std::atomic<bool> asked = false;
  };
  std::unordered_map<std::string, Recorded> recorded_;
};

}  // namespace

std::unique_ptr<Engine> make_recorded(engines::Results results) {
  return std::make_unique<RecordedEngine>(std::move(results));
}

}  // namespace contact::engines
