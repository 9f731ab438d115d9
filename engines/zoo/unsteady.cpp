// Engines whose answers depend on what they should not depend on.
#include "engines/zoo/unsteady.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include "formats/program.hpp"

namespace contact::engines {
namespace {

constexpr std::array kUnsteady{
    Unsteady{"order", "a value depends on the question before: a start from the last answer"},
    Unsteady{"batch", "a value depends on how many questions are asked at once: another sum for another width"},
    Unsteady{"time", "a value depends on the clock: a budget of time that ends an iteration"},
    Unsteady{"threads", "a value is kept where all threads write: scratch memory that is shared"},
    Unsteady{"process", "a value depends on the process: an address that is hashed"},
};

double ulps_above(double x, unsigned ulps) {
  for (; ulps > 0; --ulps) x = std::nextafter(x, std::numeric_limits<double>::infinity());
  return x;
}

class UnsteadyEngine final : public Engine {
 public:
  UnsteadyEngine(std::string_view id, EngineInfo info) : Engine(std::move(info)), id_(id) {}

  std::vector<Claim> answer(std::span<const Question> questions) override {
    std::vector<Claim> claims;
    claims.reserve(questions.size());
    for (const Question& question : questions) {
      claims.push_back(production_answer(question.query, PointConvention::nearest_surface));
      if (claims.back().contact && claims.back().contact->value)
        claims.back().contact->value = disturbed(*claims.back().contact->value, questions.size());
    }
    return claims;
  }

 private:
  [[nodiscard]] double disturbed(double value, std::size_t at_once) {
    if (id_ == "order") return ulps_above(value, before_.exchange(value) > value ? 1 : 0);
    if (id_ == "batch") return ulps_above(value, at_once > 64 ? 1 : 0);
    if (id_ == "time")
      return ulps_above(value, (std::chrono::steady_clock::now().time_since_epoch().count() / 1000) % 2 == 0 ? 1 : 0);
    if (id_ == "process") return ulps_above(value, static_cast<unsigned>(getpid()) % 7);
    // Whoever writes between is whose value comes back.
    before_ = value;
    std::this_thread::yield();
    return before_;
  }

  std::string_view id_;
  std::atomic<double> before_ = 0;
};

}  // namespace

std::span<const Unsteady> unsteady_engines() { return kUnsteady; }

std::unique_ptr<Engine> make_unsteady(std::string_view id) {
  const auto it = std::find_if(kUnsteady.begin(), kUnsteady.end(), [&](const Unsteady& one) { return one.id == id; });
  if (it == kUnsteady.end()) return nullptr;
  EngineInfo info;
  info.name = std::string(kUnsteadyPrefix) + std::string(id);
  info.version = formats::version();
  return std::make_unique<UnsteadyEngine>(it->id, std::move(info));
}

}  // namespace contact::engines
