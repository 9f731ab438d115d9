// An engine in a process of its own, asked over the engine protocol.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "engines/engine.hpp"

namespace contact::engines {

/// The engine did not start, did not say hello, or could not say what it serves: there is nothing to judge.
struct HarnessInvalid : std::runtime_error {
  explicit HarnessInvalid(const std::string& what) : std::runtime_error(formats::visible(what)) {}
};

struct SubprocessOptions {
  std::vector<std::string> command;                 ///< the program and its arguments
  std::size_t processes = 1;                        ///< how many are asked at once
  std::chrono::milliseconds start{10000};           ///< from the start to the hello
  std::chrono::milliseconds answer{10000};          ///< from one answer, or from the question, to the next answer
  std::size_t window = 256;                         ///< questions in flight
  std::size_t longest_line = std::size_t{1} << 20;  ///< bytes; an answer has some hundreds
  /// Called about ten times a second while waiting; what it throws ends the wait.
  std::function<void()> check;
};

/// Starts the engine, hears its hello and asks one smoke question of each pair that it serves, whose answer is judged
/// by its form alone. Throws HarnessInvalid where that fails.
///
/// What goes wrong later is the claim of the question that it happened at: a crash, a timeout, or an error. The process
/// is then killed and started anew, and the questions that were in flight are asked one at a time, so that the one that
/// does it is found and the others are answered. After three failures in a row the engine counts as dead, and whatever
/// is asked of it is missing.
[[nodiscard]] std::unique_ptr<Engine> make_subprocess(const SubprocessOptions& options);

/// A command line split as a POSIX shell splits words: quotes and backslashes, and nothing is expanded. Throws
/// std::invalid_argument where a quote is not closed.
[[nodiscard]] std::vector<std::string> split_words(std::string_view text);
/// One word as such a shell, and split_words, read it back: quoted where it holds what they would not take as it is.
[[nodiscard]] std::string quoted_word(std::string_view word);

}  // namespace contact::engines
