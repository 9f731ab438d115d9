// serve: answers the engine protocol on standard input and output.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <exception>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <thread>

#include "engines/hosts/library.hpp"
#include "engines/protocol/protocol.hpp"
#include "tool/commands/commands.hpp"
#include "tool/commands/engine_options.hpp"
#include "tool/run/printing.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {
namespace {

constexpr std::size_t kTogether = 256;  // questions that have arrived are answered together, up to so many

/// What has been asked and not been answered.
class Asked {
 public:
  Asked(engines::Engine& engine, std::size_t threads) : engine_(engine), threads_(threads) {}

  void add(std::uint64_t seq, const Query& query) {
    seqs_.push_back(seq);
    questions_.push_back({"", query});
  }
  [[nodiscard]] bool full() const { return questions_.size() >= kTogether; }
  void answer() {
    if (questions_.empty()) return;
    const std::vector<Claim> claims = threads_ == 1 ? engine_.answer(questions_) : answer_by_threads();
    std::string text;
    for (std::size_t i = 0; i < claims.size(); ++i) text += engines::answer_message(seqs_[i], claims[i]) + "\n";
    write(text);
    seqs_.clear();
    questions_.clear();
  }
  static void write(const std::string& text) {
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
      throw formats::InputError({"standard output", 0}, "", "cannot write: the host is gone");
  }

 private:
  /// Each thread answers every so many-th question. What one throws comes back when all are done.
  [[nodiscard]] std::vector<Claim> answer_by_threads() {
    std::vector<Claim> claims(questions_.size());
    const std::size_t count = std::min(threads_, questions_.size());
    std::vector<std::exception_ptr> thrown(count);
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < count; ++t)
      threads.emplace_back([&, t] {
        try {
          for (std::size_t i = t; i < questions_.size(); i += count)
            claims[i] = engine_.answer(std::span(questions_).subspan(i, 1)).front();
        } catch (...) {
          thrown[t] = std::current_exception();
        }
      });
    for (std::thread& thread : threads) thread.join();
    for (const std::exception_ptr& one : thrown)
      if (one) std::rethrow_exception(one);
    return claims;
  }

  engines::Engine& engine_;
  std::size_t threads_;
  std::vector<std::uint64_t> seqs_;
  std::vector<engines::Question> questions_;
};

void serve(engines::Engine& engine, std::size_t threads) {
  std::ios::sync_with_stdio(false);
  guard_output();  // which that has taken away
  InputLines lines("-");
  Asked asked(engine, threads);
  while (lines.next()) {
    const auto json = formats::parse_object(lines.text(), lines.where());
    const formats::Node message(json, lines.where());
    const std::string op = engines::op_of(message);
    if (op == "stop") break;
    if (op == "hello") {
      if (const formats::Node protocol = message.at("protocol"); protocol.count() != engines::kProtocol)
        protocol.refuse(fmt::format("this engine speaks protocol {}", engines::kProtocol));
      Asked::write(engines::hello_line(engine.info()) + "\n");
    } else if (op == "query") {
      asked.add(engines::seq_of(message), engines::read_question(message));
      if (asked.full() || std::cin.rdbuf()->in_avail() <= 0) asked.answer();
    } else {
      message.at("op").refuse("expected hello, query or stop");
    }
  }
  asked.answer();
}

}  // namespace

void add_serve(CLI::App& app, int& exit) {
  auto* command = app.add_subcommand("serve", "Answer the engine protocol on standard input and output");
  struct ServeOptions {
    std::string engine = "production";
    std::string library;
    std::size_t threads = 1;
  };
  auto options = std::make_shared<ServeOptions>();
  auto* engine = command->add_option("--engine", options->engine, "A built-in engine")->capture_default_str();
  command->add_option("--engine-library", options->library, "A shared library with the interface of contact_engine.h")
      ->type_name("FILE")
      ->excludes(engine);
  command->add_option("--threads", options->threads, "Answer what has arrived from so many threads")
      ->capture_default_str()
      ->check(kFromOne);
  command->callback([options, &exit] {
    const auto served = options->library.empty() ? built_in(options->engine, PointConvention::nearest_surface)
                                                 : engines::make_library(options->library);
    serve(*served, options->threads);
    exit = kCertified;
  });
}

}  // namespace contact::tool
