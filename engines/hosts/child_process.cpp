// A child process that is talked to in lines, on libuv.
#include "engines/hosts/child_process.hpp"

#include <fmt/format.h>
#include <uv.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstring>
#include <deque>
#include <stdexcept>
#include <utility>

namespace contact::engines {
namespace {

constexpr std::size_t kMostLines = 4096;  // read ahead of what has been asked for; a flood waits in its pipe
constexpr std::size_t kMostWords = 4096;  // bytes of standard error that are remembered
constexpr std::uint64_t kCheckEveryMs = 100;
constexpr std::chrono::milliseconds kLastMoment{500};

/// The process groups of the children, for the handler of a signal. What finds no room here ends when its input does.
class Children {
 public:
  void add(pid_t group) { exchange(0, group); }
  void remove(pid_t group) { exchange(group, 0); }
  void kill_all() noexcept {
    for (std::atomic<pid_t>& one : groups_)
      if (const pid_t group = one.load(); group > 0) ::kill(-group, SIGKILL);
  }

 private:
  void exchange(pid_t from, pid_t to) {
    for (std::atomic<pid_t>& one : groups_) {
      pid_t expected = from;
      if (one.compare_exchange_strong(expected, to)) return;
    }
  }

  static_assert(std::atomic<pid_t>::is_always_lock_free);
  std::array<std::atomic<pid_t>, 256> groups_{};
} children;

[[noreturn]] void cannot_start(const std::string& program, int why) {
  throw std::runtime_error(fmt::format("cannot start '{}': {}", program, uv_strerror(why)));
}

}  // namespace

void kill_children() noexcept { children.kill_all(); }

struct ChildProcess::State {
  uv_loop_t loop{};
  uv_process_t process{};
  uv_pipe_t input{};
  uv_pipe_t output{};
  uv_pipe_t error{};
  uv_timer_t timer{};
  bool exited = false;
  std::int64_t status = 0;
  int signal = 0;
  bool reading = false;
  bool output_ended = false;
  bool error_ended = false;
  bool line_too_long = false;
  std::size_t longest_line = 0;
  std::deque<std::string> lines;
  std::string partial;
  std::string words;
  std::array<char, 65536> output_buffer{};
  std::array<char, 4096> error_buffer{};
  std::function<void()> check;

  explicit State(const std::string& program) {
    // A write to a child that is gone must come back as an error, not end this program.
    static const auto ignored = std::signal(SIGPIPE, SIG_IGN);
    static_cast<void>(ignored);
    if (const int why = uv_loop_init(&loop); why != 0) cannot_start(program, why);  // as where no file can be opened
    uv_pipe_init(&loop, &input, 0);
    uv_pipe_init(&loop, &output, 0);
    uv_pipe_init(&loop, &error, 0);
    uv_timer_init(&loop, &timer);
    for (void* handle : {static_cast<void*>(&input), static_cast<void*>(&output), static_cast<void*>(&error),
                         static_cast<void*>(&timer), static_cast<void*>(&process)})
      static_cast<uv_handle_t*>(handle)->data = this;
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (process.pid > 0) {
      children.remove(process.pid);
      ::kill(-process.pid, SIGKILL);
      check = nullptr;
      run_until(Clock::now() + kLastMoment * 10, [&] { return exited; });
    }
    const auto close = [](uv_handle_t* handle, void*) {
      if (uv_is_closing(handle) == 0) uv_close(handle, nullptr);
    };
    uv_walk(&loop, close, nullptr);
    uv_run(&loop, UV_RUN_DEFAULT);
    uv_loop_close(&loop);
  }

  static State& of(const void* handle) { return *static_cast<State*>(static_cast<const uv_handle_t*>(handle)->data); }

  void take(std::string_view bytes) {
    while (!bytes.empty()) {
      const auto end = bytes.find('\n');
      partial += bytes.substr(0, end);
      if (partial.size() > longest_line) {
        line_too_long = true;
        partial.resize(longest_line);
        stop_reading();
        return;
      }
      if (end == std::string_view::npos) return;
      lines.push_back(std::exchange(partial, {}));
      bytes.remove_prefix(end + 1);
    }
    if (lines.size() >= kMostLines) stop_reading();
  }

  void start_reading() {
    if (reading || output_ended || line_too_long) return;
    reading = true;
    uv_read_start(
        reinterpret_cast<uv_stream_t*>(&output),
        [](uv_handle_t* handle, std::size_t, uv_buf_t* buffer) {
          State& s = of(handle);
          *buffer = uv_buf_init(s.output_buffer.data(), static_cast<unsigned>(s.output_buffer.size()));
        },
        [](uv_stream_t* stream, ssize_t n, const uv_buf_t* buffer) {
          State& s = of(stream);
          if (n > 0) s.take({buffer->base, static_cast<std::size_t>(n)});
          if (n >= 0) return;
          s.output_ended = true;
          s.stop_reading();
        });
  }
  void stop_reading() {
    if (!reading) return;
    reading = false;
    uv_read_stop(reinterpret_cast<uv_stream_t*>(&output));
  }
  void read_errors() {
    uv_read_start(
        reinterpret_cast<uv_stream_t*>(&error),
        [](uv_handle_t* handle, std::size_t, uv_buf_t* buffer) {
          State& s = of(handle);
          *buffer = uv_buf_init(s.error_buffer.data(), static_cast<unsigned>(s.error_buffer.size()));
        },
        [](uv_stream_t* stream, ssize_t n, const uv_buf_t* buffer) {
          State& s = of(stream);
          if (n < 0) s.error_ended = true;
          if (n < 0) uv_read_stop(stream);
          if (n <= 0) return;
          s.words.append(buffer->base, static_cast<std::size_t>(n));
          if (s.words.size() > kMostWords) s.words.erase(0, s.words.size() - kMostWords);
        });
  }

  /// Runs the loop until `done` or the deadline; whether done.
  template <class Done>
  bool run_until(Clock::time_point deadline, Done done) {
    while (!done()) {
      const auto now = Clock::now();
      if (now >= deadline) return false;
      const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - now).count();
      const auto wait = std::min<std::uint64_t>(static_cast<std::uint64_t>(left), kCheckEveryMs);
      // Again and again: the loop's clock may be so late that the timer goes off before the loop begins to wait, and
      // with no other it would wait until the child says something.
      uv_timer_start(
          &timer, [](uv_timer_t*) {}, wait, wait);
      uv_run(&loop, UV_RUN_ONCE);
      if (check) check();
    }
    return true;
  }
};

ChildProcess::ChildProcess(const std::vector<std::string>& command, std::size_t longest_line,
                           std::function<void()> check)
    : state_(std::make_unique<State>(command.front())) {
  State& s = *state_;
  s.longest_line = longest_line;
  s.check = std::move(check);
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  std::array<uv_stdio_container_t, 3> pipes{};
  const auto pipe = [](uv_pipe_t& end, int way) {
    uv_stdio_container_t container{};
    container.flags = static_cast<uv_stdio_flags>(UV_CREATE_PIPE | way);
    container.data.stream = reinterpret_cast<uv_stream_t*>(&end);
    return container;
  };
  pipes[0] = pipe(s.input, UV_READABLE_PIPE);
  pipes[1] = pipe(s.output, UV_WRITABLE_PIPE);
  pipes[2] = pipe(s.error, UV_WRITABLE_PIPE);
  uv_process_options_t options{};
  options.file = arguments.front();
  options.args = arguments.data();
  options.stdio = pipes.data();
  options.stdio_count = static_cast<int>(pipes.size());
  options.flags = UV_PROCESS_DETACHED;  // a process group of its own
  options.exit_cb = [](uv_process_t* process, std::int64_t status, int signal) {
    State& state = State::of(process);
    state.exited = true;
    state.status = status;
    state.signal = signal;
  };
  if (const int error = uv_spawn(&s.loop, &s.process, &options); error != 0) {
    s.process.pid = 0;
    cannot_start(command.front(), error);
  }
  children.add(s.process.pid);
  s.start_reading();
  s.read_errors();
}

ChildProcess::~ChildProcess() = default;

void ChildProcess::send(std::string text) {
  struct Write {
    uv_write_t request{};
    std::string text;
  };
  auto* write = new Write{{}, std::move(text)};
  write->request.data = write;
  const uv_buf_t buffer = uv_buf_init(write->text.data(), static_cast<unsigned>(write->text.size()));
  const auto done = [](uv_write_t* request, int) { delete static_cast<Write*>(request->data); };
  // A child that no longer reads is found out by its missing answers.
  if (uv_write(&write->request, reinterpret_cast<uv_stream_t*>(&state_->input), &buffer, 1, done) != 0) delete write;
}

ChildProcess::Event ChildProcess::next_line(std::string& line, Clock::time_point deadline) {
  State& s = *state_;
  if (s.lines.empty()) s.start_reading();
  const bool done = s.run_until(deadline, [&] { return !s.lines.empty() || s.output_ended || s.line_too_long; });
  if (!s.lines.empty()) {
    line = std::move(s.lines.front());
    s.lines.pop_front();
    return Event::line;
  }
  if (!done) return Event::timeout;
  return s.line_too_long ? Event::too_long : Event::end;
}

const std::string& ChildProcess::half_line() const { return state_->partial; }

std::string ChildProcess::how_it_ended() {
  State& s = *state_;
  s.run_until(Clock::now() + kLastMoment, [&] { return s.exited && s.error_ended; });
  if (!s.exited) return "closed its output";
  if (s.signal != 0) return fmt::format("was killed by signal {} ({})", s.signal, strsignal(s.signal));
  return fmt::format("exited with status {}", s.status);
}

std::string ChildProcess::last_words() const {
  std::string_view words = state_->words;
  while (!words.empty() && (words.back() == '\n' || words.back() == '\r')) words.remove_suffix(1);
  const auto start = words.rfind('\n');
  return std::string(start == std::string_view::npos ? words : words.substr(start + 1));
}

}  // namespace contact::engines
