// An engine whose answers are kept as they are given.
#include "engines/hosts/recording.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "formats/input_error.hpp"

namespace contact::engines {
namespace {

/// The line of a results file; empty for what is no answer. A crash written down as an "error" would be judged as a
/// refusal, which is right outside the domain: to leave it out keeps it wrong.
std::string line_of(const std::string& id, const Claim& claim) {
  switch (claim.status) {
    case Claim::Status::answered:
    case Claim::Status::unsupported:
    case Claim::Status::rejected:
    case Claim::Status::error:
      return to_line(id, claim);
    default:
      return "";
  }
}

}  // namespace

Recording::Recording(std::unique_ptr<Engine> engine) : Engine(engine->info()), engine_(std::move(engine)) {}

std::vector<Claim> Recording::answer(std::span<const Question> questions) {
  std::vector<Claim> claims = engine_->answer(questions);
  std::vector<std::string> lines;
  lines.reserve(claims.size());
  for (std::size_t i = 0; i < claims.size(); ++i) lines.push_back(line_of(questions[i].id, claims[i]));
  const std::lock_guard lock(mutex_);
  for (std::size_t i = 0; i < claims.size(); ++i) {
    const auto [it, is_new] = lines_.try_emplace(questions[i].id, lines[i]);
    if (!is_new && it->second != lines[i]) {
      const auto said = [](const std::string& line) { return line.empty() ? "nothing" : line; };
      throw formats::InputError({info().name, 0}, questions[i].id,
                                fmt::format("one question, two answers, and no results file can hold both: {} and {}",
                                            said(it->second), said(lines[i])));
    }
  }
  return claims;
}

std::size_t Recording::answers() const {
  return static_cast<std::size_t>(
      std::count_if(lines_.begin(), lines_.end(), [](const auto& entry) { return !entry.second.empty(); }));
}

std::string Recording::results() const {
  std::string text = to_line(info()) + "\n";
  for (const auto& [id, line] : lines_)
    if (!line.empty()) text += line + "\n";
  return text;
}

}  // namespace contact::engines
