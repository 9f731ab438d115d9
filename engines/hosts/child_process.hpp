// A child process that is talked to in lines: its start, its pipes, its time limits and its end, on libuv.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace contact::engines {

/// One child with a pipe to its standard input and from its standard output and error. Used by one thread at a time.
/// The child leads a process group of its own, which is killed with it: nothing is left behind but
/// what left that group, as by setsid().
class ChildProcess {
 public:
  using Clock = std::chrono::steady_clock;

  /// What waiting for a line came to.
  enum class Event { line, end, timeout, too_long };

  /// Starts `command` (the program, found along PATH, and its arguments). Throws std::runtime_error where it cannot be.
  /// `check` is called about ten times a second while waiting; what it throws comes out of next_line.
  ChildProcess(const std::vector<std::string>& command, std::size_t longest_line, std::function<void()> check);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  /// Kills what is still there, and waits for it.
  ~ChildProcess();

  /// Queues text for the child's standard input; never blocks, whether the child reads or not.
  void send(std::string text);

  /// The next line of the child's standard output, without its line feed. `end` is the end of its output.
  [[nodiscard]] Event next_line(std::string& line, Clock::time_point deadline);

  /// What stands in the output after the last whole line.
  [[nodiscard]] const std::string& half_line() const;
  /// "exited with status 3", "was killed by signal 11 (Segmentation fault)"; waits a moment for the end that an end of
  /// output announces, then "closed its output".
  [[nodiscard]] std::string how_it_ended();
  /// The last line that it wrote to standard error, or nothing.
  [[nodiscard]] std::string last_words() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Ends every child process, in the handler of a signal that ends this one: it calls nothing that such a handler may
/// not.
void kill_children() noexcept;

}  // namespace contact::engines
