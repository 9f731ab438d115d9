// serve: answers the engine protocol on standard input and output.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "engines/hosts/library.hpp"
#include "engines/protocol/protocol.hpp"
#include "tool/commands/commands.hpp"
#include "tool/commands/engine_options.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {
namespace {

constexpr std::size_t kTogether = 256;  // questions that have arrived are answered together, up to so many

/// What has been asked and not been answered.
class Asked {
 public:
  explicit Asked(engines::Engine& engine) : engine_(engine) {}

  void add(std::uint64_t seq, const Query& query) {
    seqs_.push_back(seq);
    questions_.push_back({"", query});
  }
  [[nodiscard]] bool full() const { return questions_.size() >= kTogether; }
  void answer() {
    if (questions_.empty()) return;
    const std::vector<Claim> claims = engine_.answer(questions_);
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
  engines::Engine& engine_;
  std::vector<std::uint64_t> seqs_;
  std::vector<engines::Question> questions_;
};

void serve(engines::Engine& engine) {
  std::ios::sync_with_stdio(false);
  InputLines lines("-");
  Asked asked(engine);
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
  };
  auto options = std::make_shared<ServeOptions>();
  auto* engine = command->add_option("--engine", options->engine, "A built-in engine")->capture_default_str();
  command->add_option("--engine-library", options->library, "A shared library with the interface of contact_engine.h")
      ->excludes(engine);
  command->callback([options, &exit] {
    const auto served = options->library.empty() ? built_in(options->engine, PointConvention::nearest_surface)
                                                 : engines::make_library(options->library);
    serve(*served);
    exit = kCertified;
  });
}

}  // namespace contact::tool
