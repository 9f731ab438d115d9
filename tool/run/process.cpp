// What a command has of its process: signals, standard input, a progress bar.
#include "tool/run/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/time.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <iostream>

#include "engines/hosts/child_process.hpp"
#include "formats/json.hpp"
#include "formats/output_file.hpp"
#include "tool/run/printing.hpp"

namespace contact::tool {
namespace {

volatile std::sig_atomic_t interrupted = 0;
volatile std::sig_atomic_t looks = 0;  ///< how often the command was looked after since
void (*look_besides)() = nullptr;

// A command that is told to end has this long to do it by itself: some places look seldom, or wait for a pipe.
constexpr int kLookEveryMicroseconds = 200'000;
constexpr int kLastLook = 4;

/// The command goes on all the same: it is ended from here, as it would have ended, with nothing half-written.
[[noreturn]] void end_now() {
  formats::remove_unfinished();
  engines::kill_children();
  constexpr std::string_view kSaid = "contact-oracle: interrupted\n";
  static_cast<void>(!::write(STDERR_FILENO, kSaid.data(), kSaid.size()));
  ::_exit(kInterrupted);
}

void on_signal(int signal) {
  if (signal == SIGALRM) {
    looks = looks + 1;
    if (looks >= kLastLook) end_now();
    return;  // a read that began just after somebody had looked comes back
  }
  interrupted = 1;
  const itimerval often{{0, kLookEveryMicroseconds}, {0, kLookEveryMicroseconds}};
  ::setitimer(ITIMER_REAL, &often, nullptr);
}

constexpr int kBarWidth = 30;
constexpr std::chrono::milliseconds kRedraw{100};

}  // namespace

void occupy_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) == -1 && errno == EBADF)
      static_cast<void>(
          ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY));  // the lowest number is free
}

void catch_signals() {
  // Without SA_RESTART, so that a command waiting for its input ends too.
  struct sigaction action {};
  action.sa_handler = on_signal;
  sigaction(SIGALRM, &action, nullptr);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);  // nohup and a shell's & have their reasons
  }
  // A reader that is gone and a file that may not grow are errors of the write, so that what is unfinished is removed.
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
}

void look_for_interruptions_by(void (*look)()) { look_besides = look; }

bool is_interrupted() { return interrupted != 0; }

void throw_if_interrupted() {
  if (is_interrupted()) throw Interrupted();
  if (look_besides != nullptr) look_besides();
  // What nobody reads any more is not worked out to its end, which may never come.
  if (ferror_unlocked(stdout) != 0) throw formats::InputError({"standard output", 0}, "", "cannot write");
}

InputLines::InputLines(const std::string& path, std::size_t longest)
    : longest_(longest),
      file_(path == "-" ? std::ifstream() : formats::open_to_read(path)),
      stream_(path == "-" ? std::cin : file_),
      where_{path, 0} {}

bool InputLines::next() {
  const bool read = formats::read_line(stream_, line_, where_, longest_);
  throw_if_interrupted();
  return read;
}

Progress::Progress(std::string label, std::uint64_t total)
    : label_(std::move(label)), total_(total), visible_(::isatty(STDERR_FILENO) == 1 && total > 0 && !is_quiet()) {}

Progress::~Progress() {
  if (visible_) fmt::print(stderr, "\r\033[K");
}

void Progress::add(std::uint64_t n) {
  done_ += n;
  const auto now = std::chrono::steady_clock::now();
  if (!visible_ || now - drawn_ < kRedraw) return;
  drawn_ = now;
  draw();
}

void Progress::draw() {
  const double share = static_cast<double>(done_) / static_cast<double>(total_);
  const int full = static_cast<int>(share * kBarWidth);
  fmt::print(stderr, "\r\033[K{} [{:=<{}}{: <{}}] {:3.0f} %  {} of {}", label_, "", full, "", kBarWidth - full,
             share * 100, done_, total_);
  std::fflush(stderr);
}

void in_parallel(std::size_t n, const std::function<void(std::size_t)>& work) {
  tbb::parallel_for(std::size_t{0}, n, [&](std::size_t i) {
    throw_if_interrupted();
    work(i);
  });
}

}  // namespace contact::tool
