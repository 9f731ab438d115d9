// What a command has of its process: exit codes, signals, standard input, a progress bar, threads.
#pragma once

#include <chrono>
#include <cstdint>
#include <fstream>
#include <functional>
#include <istream>
#include <stdexcept>
#include <string>
#include <vector>

#include "formats/json.hpp"

namespace contact::tool {

/// The exit codes of contract: certified, refuted, bad input, harness invalid, oracle fault; and an interruption.
enum Exit { kCertified = 0, kRefuted = 1, kBadInput = 2, kHarnessInvalid = 3, kOracleFault = 4, kInterrupted = 130 };

/// Opens what is closed of standard input, output and error: files and pipes that are opened later would take its number,
/// and what is printed would go there. Printing fails as before.
void occupy_standard_streams();

/// SIGINT or SIGTERM arrived. Thrown from the work itself, so that temporary files are removed on the way out.
struct Interrupted : std::runtime_error {
  explicit Interrupted(const std::string& what = "interrupted; nothing was written") : std::runtime_error(what) {}
};
/// A command that a signal does not stop within a second, because it looks nowhere or waits for a pipe, is ended: what
/// it has not committed is removed, and its child processes are ended.
void catch_signals();
[[nodiscard]] bool is_interrupted();
/// Throws Interrupted, or InputError where standard output could not be written.
void throw_if_interrupted();
/// Has throw_if_interrupted call `look` too, which throws where somebody else who has the process caught a signal.
void look_for_interruptions_by(void (*look)());

/// The lines of a file, or of standard input for "-".
class InputLines {
 public:
  explicit InputLines(const std::string& path, std::size_t longest = formats::kLongestLine);
  /// Reads the next line; false after the last.
  [[nodiscard]] bool next();
  [[nodiscard]] const std::string& text() const { return line_; }
  [[nodiscard]] const formats::Location& where() const { return where_; }

 private:
  std::size_t longest_;
  std::ifstream file_;
  std::istream& stream_;
  std::string line_;
  formats::Location where_;
};

/// A progress bar on standard error; nothing where that is not a terminal.
class Progress {
 public:
  Progress(std::string label, std::uint64_t total);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  void add(std::uint64_t n);

 private:
  void draw();

  std::string label_;
  std::uint64_t total_;
  std::uint64_t done_ = 0;
  bool visible_;
  std::chrono::steady_clock::time_point drawn_;
};

/// Questions are worked on in runs of this many: enough for every thread, little in memory.
inline constexpr std::size_t kRun = 1024;

/// work(i) for i in 0 .. n - 1 on every thread; the first exception comes back, an interruption among them.
void in_parallel(std::size_t n, const std::function<void(std::size_t)>& work);

}  // namespace contact::tool
