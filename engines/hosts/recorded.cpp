// An engine that answers from a results file.
#include <algorithm>
#include <atomic>
#include <mutex>

#include "engines/engine.hpp"
#include "engines/protocol/result_columns.hpp"

namespace contact::engines {
namespace {

class RecordedEngine final : public Engine {
 public:
  explicit RecordedEngine(engines::Results results) : Engine(std::move(results.engine)), decimals_(results.decimals) {
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
        claims.push_back(Claim::without(Claim::Status::missing, "the results file has no answer to this question"));
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
  [[nodiscard]] std::uint64_t decimals() const override { return decimals_; }

 private:
  struct Recorded {
    explicit Recorded(Claim given) : claim(std::move(given)) {}
    Claim claim;
    std::atomic<bool> asked = false;
  };
  std::unordered_map<std::string, Recorded> recorded_;
  std::uint64_t decimals_;
};

/// Row i of the columns answers question i of the dataset.
class RowsEngine final : public Engine {
 public:
  explicit RowsEngine(std::unique_ptr<ResultColumns> columns)
      : Engine(columns->engine()), columns_(std::move(columns)) {}

  std::vector<Claim> answer(std::span<const Question> questions) override {
    const std::lock_guard lock(mutex_);
    std::vector<Claim> claims;
    claims.reserve(questions.size());
    for (const Question& question : questions) {
      if (columns_->has_ids())
        if (const std::string id = columns_->id(question.index); id != question.id)
          throw formats::InputError(
              columns_->where(question.index), "/id",
              fmt::format("is {}, and question {} of the dataset is {}: rows stand in the order of the questions", id,
                          question.index, question.id));
      claims.push_back(columns_->claim(question.index));
    }
    return claims;
  }

 private:
  std::mutex mutex_;
  std::unique_ptr<ResultColumns> columns_;
};

}  // namespace

std::unique_ptr<Engine> make_recorded(const std::filesystem::path& path, std::optional<std::uint64_t> rows) {
  const auto form = formats::arrays_form(path);
  if (!form || !rows) return std::make_unique<RecordedEngine>(read_results(path));
  auto columns = std::make_unique<ResultColumns>(path, *form);
  if (columns->rows() != *rows)
    throw formats::InputError(
        {path.string(), 0}, "",
        fmt::format("has {} rows, and the dataset {} questions: row i answers question i", columns->rows(), *rows));
  return std::make_unique<RowsEngine>(std::move(columns));
}

std::uint64_t count_recorded(const std::filesystem::path& path) {
  if (const auto form = formats::arrays_form(path)) return ResultColumns(path, *form).rows();
  return read_results(path).claims.size();
}

}  // namespace contact::engines
