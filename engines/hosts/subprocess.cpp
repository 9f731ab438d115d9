// An engine in a process of its own, asked over the engine protocol.
#include "engines/hosts/subprocess.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>

#include "engines/hosts/child_process.hpp"
#include "engines/protocol/protocol.hpp"
#include "engines/protocol/quick_answer.hpp"

namespace contact::engines {
namespace {

using Status = Claim::Status;
constexpr int kFailuresUntilDead = 3;
constexpr std::size_t kLongestQuote = 60;
constexpr std::size_t kLongestLastWords = 500;  // a message for a person, often with a path in it

constexpr std::string_view kMalformed = "malformed ";

bool malformed(const Claim& claim) { return claim.status == Status::error && claim.text.starts_with(kMalformed); }

/// What an engine wrote, fit for a message: short and visible.
std::string excerpt(std::string_view text, std::size_t longest = kLongestQuote) {
  return fmt::format("'{}{}'", formats::visible(text.substr(0, longest)), text.size() > longest ? "..." : "");
}

/// A conversation that cannot go on: the engine's stream ended, stalled or lost its thread.
struct Broken {
  Status status;
  std::string text;
  std::optional<std::size_t> repeated = std::nullopt;  ///< the question that was answered once more
};

/// One process and what is in flight.
class Conversation {
 public:
  explicit Conversation(const SubprocessOptions& options) : options_(options) {}

  /// Starts the process where there is none, and hears its hello.
  const engines::EngineInfo& start() {
    if (process_) return *info_;
    first_of_process_ = seq_ + 1;
    try {
      process_ = std::make_unique<ChildProcess>(options_.command, options_.longest_line, options_.check);
    } catch (const std::runtime_error& error) {
      throw Broken{Status::error, error.what()};
    }
    process_->send(engines::hello_line() + "\n");
    const auto deadline = ChildProcess::Clock::now() + options_.start;
    const std::string line = next_line(deadline, "no hello", options_.start);
    const formats::Location where{"hello", 0};
    try {
      const auto json = formats::parse_object(line, where);
      info_ = engines::read_hello(formats::Node(json, where));
    } catch (const formats::InputError& error) {
      throw Broken{Status::error, fmt::format("{} in {}", error.what(), excerpt(line))};
    }
    return *info_;
  }

  void kill() { process_.reset(); }

  /// Other questions follow: from here on an index means one of them.
  void turn() { asked_ = {seq_ + 1, {}}; }

  /// Asks the questions with the indices `order`, at most `window` of them in flight, fills in their claims as they are
  /// answered, and marks them in `done`. Throws Broken; the first of `order` that is not done is the one that was due.
  void ask(std::span<const Question> questions, std::span<const std::size_t> order, std::size_t window,
           std::vector<Claim>& claims, std::vector<bool>& done) {
    std::size_t sent = 0;
    auto deadline = ChildProcess::Clock::now() + options_.answer;
    for (std::size_t answered = 0; answered < order.size(); ++answered) {
      // Questions go out by the half window: one write for many, and the engine never waits for the next.
      if (sent < order.size() && sent - answered <= window / 2) {
        std::string text;
        for (; sent < order.size() && sent - answered < window; ++sent) {
          text += engines::query_message(++seq_, questions[order[sent]].query) + "\n";
          asked_.indices.push_back(order[sent]);
        }
        process_->send(std::move(text));
      }
      std::string line = next_line(deadline, "no answer", options_.answer);
      auto [index, claim] = heard(line, done);
      claims[index] = std::move(claim);
      done[index] = true;
      deadline = ChildProcess::Clock::now() + options_.answer;
    }
  }

 private:
  /// What was asked since the last turn: the index of each question, by sequence numbers from `first`.
  struct Asked {
    std::uint64_t first = 1;
    std::vector<std::size_t> indices;
  };

  /// The index of the question that `seq` is, as yet without an answer. A question that is answered once more breaks
  /// the conversation, as does a number that this process was never given.
  [[nodiscard]] std::size_t asked_by(std::uint64_t seq, const std::vector<bool>& done, std::string_view line) const {
    const auto broken = [&](std::string_view problem, std::optional<std::size_t> repeated = std::nullopt) {
      return Broken{Status::error, fmt::format("answer: seq: {} {} in {}", seq, problem, excerpt(line)), repeated};
    };
    if (seq < first_of_process_ || seq > seq_) throw broken("was not asked");
    if (seq < asked_.first) throw broken("was answered before");
    const std::size_t index = asked_.indices[seq - asked_.first];
    if (done[index]) throw broken("was answered before", index);
    return index;
  }

  /// The answer that a line is, and the index of its question. A claim of the wrong form is that question's error; a
  /// line that belongs to no question breaks the conversation.
  [[nodiscard]] std::pair<std::size_t, Claim> heard(std::string& line, const std::vector<bool>& done) const {
    static const formats::Location where{"answer", 0};
    try {
      if (auto answer = engines::quick_answer(line))
        return {asked_by(answer->seq, done, line), std::move(answer->claim)};
      const auto json = formats::parse_object(line, where);
      const formats::Node message(json, where);
      if (const std::string op = engines::op_of(message); op != "answer")
        throw formats::InputError(where, "op", fmt::format("expected \"answer\", got {}", excerpt(op)));
      const std::size_t index = asked_by(engines::seq_of(message), done, line);
      try {
        return {index, engines::read_answer(message)};
      } catch (const formats::InputError& error) {
        return {index,
                Claim::without(Status::error, fmt::format("{}{} in {}", kMalformed, error.what(), excerpt(line)))};
      }
    } catch (const formats::InputError& error) {
      throw Broken{Status::error, fmt::format("{} in {}", error.what(), excerpt(line))};
    }
  }

  std::string next_line(ChildProcess::Clock::time_point deadline, std::string_view missing,
                        std::chrono::milliseconds limit) {
    std::string line;
    const auto seconds = [](std::chrono::milliseconds ms) { return static_cast<double>(ms.count()) / 1000; };
    switch (process_->next_line(line, deadline)) {
      case ChildProcess::Event::line:
        break;
      case ChildProcess::Event::timeout:
        throw Broken{Status::timeout,
                     fmt::format("{} within {:g} s{}", missing, seconds(limit),
                                 process_->half_line().empty()
                                     ? std::string()
                                     : fmt::format(", half a line: {}", excerpt(process_->half_line())))};
      case ChildProcess::Event::too_long:
        throw Broken{Status::error, fmt::format("a line of more than {} bytes: {}", options_.longest_line,
                                                excerpt(process_->half_line()))};
      case ChildProcess::Event::end: {
        std::string text = fmt::format("the engine {}", process_->how_it_ended());
        if (!process_->half_line().empty())
          text += fmt::format(" after half a line: {}", excerpt(process_->half_line()));
        if (const std::string words = process_->last_words(); !words.empty())
          text += fmt::format("; its standard error ends in {}", excerpt(words, kLongestLastWords));
        throw Broken{Status::crash, text};
      }
    }
    return line;
  }

  const SubprocessOptions& options_;
  std::unique_ptr<ChildProcess> process_;
  std::optional<engines::EngineInfo> info_;
  std::uint64_t seq_ = 0;
  std::uint64_t first_of_process_ = 1;
  Asked asked_;
};

/// A question that every engine of a pair can answer: one unit apart, both of size one.
Question smoke_question(Pair pair) {
  // The k-th vector of a shape is (k,k,k), a triangle's are those of the axes, a number is 1; the second shape stands 1
  // beside the first.
  Query query = zero_query(pair);
  const auto fill = [](auto& shape, double aside) {
    double k = 0;
    for_each_field(shape, [&](const auto& /*field*/, auto& value) {
      if constexpr (std::same_as<std::remove_reference_t<decltype(value)>, double>)
        value = 1;
      else if constexpr (std::same_as<std::remove_reference_t<decltype(value)>, Vector3>)
        value = Vector3(k + aside, k, k), ++k;
      else if constexpr (std::same_as<std::remove_reference_t<decltype(value)>, Quaternion>)
        value = {1, 1, 1, 1};
      else if constexpr (AnyNumberOfVectors<decltype(value)>)
        value = {Vector3(aside, 0, 0), Vector3(1 + aside, 0, 0), Vector3(aside, 1, 0), Vector3(aside, 0, 1)};
      else
        for (Eigen::Index i = 0; Vector3 & v : value) {
          v = Vector3(aside, 0, 0);
          if (i < 3) ++v[i++];
        }
    });
  };
  std::visit([&](auto& shapes) { fill(shapes.a, 0), fill(shapes.b, 1); }, query.shapes);
  return {"smoke", query};
}

class Subprocess final : public Engine {
 public:
  explicit Subprocess(const SubprocessOptions& options) : Engine({}), options_(options) {
    for (std::size_t i = 0; i < std::max<std::size_t>(options_.processes, 1); ++i)
      free_.push_back(std::make_unique<Conversation>(options_));
    Conversation& first = *free_.back();
    try {
      set_info(first.start());
      for (const Pair pair : info().pairs) {
        const std::vector<Question> questions{smoke_question(pair)};
        const std::vector<std::size_t> order{0};
        std::vector<Claim> claims(1);
        std::vector<bool> done(1);
        first.turn();
        first.ask(questions, order, 1, claims, done);
        const Claim& claim = claims.front();
        if (claim.status == Status::answered && !claim.overlap && !claim.speaks_of_contact)
          throw Broken{Status::error, fmt::format("the answer to a first question of {} claims nothing", name(pair))};
        if (malformed(claim))
          throw Broken{Status::error, fmt::format("the answer to a first question of {}: {}", name(pair), claim.text)};
      }
    } catch (const Broken& broken) {
      throw HarnessInvalid(broken.text);
    }
  }

  std::vector<Claim> answer(std::span<const Question> questions) override {
    const Lease conversation(*this);
    conversation->turn();
    std::vector<Claim> claims(questions.size(), Claim::without(Status::missing, "the engine counts as dead"));
    std::vector<bool> done(questions.size());
    std::size_t alone = 0;  // questions below this index are asked one at a time
    while (!dead_) {
      std::vector<std::size_t> order;
      for (std::size_t i = 0; i < done.size(); ++i)
        if (!done[i] && (order.empty() || order.front() >= alone)) order.push_back(i);
      if (order.empty()) break;
      const bool one = order.front() < alone;
      const auto is_done = [&](std::size_t index) -> bool { return done[index]; };
      try {
        conversation->start();
        conversation->ask(questions, order, one ? 1 : options_.window, claims, done);
        failures_ = 0;
      } catch (const Broken& broken) {
        conversation->kill();
        const auto is_right = [&](std::size_t index) -> bool { return done[index] && index != broken.repeated; };
        if (std::any_of(order.begin(), order.end(), is_right)) failures_ = 0;
        if (broken.repeated) {
          claims[*broken.repeated] = Claim::without(broken.status, broken.text);
          if (++failures_ >= kFailuresUntilDead) dead_ = true;
        } else if (one || options_.window == 1) {
          const std::size_t culprit = *std::find_if_not(order.begin(), order.end(), is_done);
          claims[culprit] = Claim::without(broken.status, broken.text);
          done[culprit] = true;
          if (++failures_ >= kFailuresUntilDead) dead_ = true;
        } else {
          // Which of those in flight did it? All of them are asked again, each alone.
          std::size_t in_flight = 0;
          for (const std::size_t index : order)
            if (!is_done(index) && in_flight++ < options_.window) alone = index + 1;
        }
      }
    }
    for (Claim& claim : claims) decimals_ += settle_decimals(claim, info().declared.scalar);
    return claims;
  }
  [[nodiscard]] std::uint64_t decimals() const override { return decimals_; }

 private:
  /// A conversation that nobody else has, given back at the end.
  class Lease {
   public:
    explicit Lease(Subprocess& engine) : engine_(engine) {
      std::unique_lock lock(engine_.mutex_);
      engine_.given_back_.wait(lock, [&] { return !engine_.free_.empty(); });
      conversation_ = std::move(engine_.free_.back());
      engine_.free_.pop_back();
    }
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;
    ~Lease() {
      {
        const std::lock_guard lock(engine_.mutex_);
        engine_.free_.push_back(std::move(conversation_));
      }
      engine_.given_back_.notify_one();
    }
    Conversation* operator->() const { return conversation_.get(); }

   private:
    Subprocess& engine_;
    std::unique_ptr<Conversation> conversation_;
  };

  SubprocessOptions options_;
  std::mutex mutex_;
  std::condition_variable given_back_;
  std::vector<std::unique_ptr<Conversation>> free_;
  std::atomic<int> failures_ = 0;
  std::atomic<bool> dead_ = false;
  std::atomic<std::uint64_t> decimals_ = 0;
};

}  // namespace

std::unique_ptr<Engine> make_subprocess(const SubprocessOptions& options) {
  return std::make_unique<Subprocess>(options);
}

std::vector<std::string> split_words(std::string_view text) {
  std::vector<std::string> words;
  std::optional<std::string> word;
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote == '\'' ? c == '\'' : quote == '"' ? c == '"' : c == '\'' || c == '"') {
      quote = quote == 0 ? c : '\0';
      if (!word) word.emplace();
    } else if (c == '\\' && quote != '\'') {
      if (i + 1 == text.size()) throw std::invalid_argument("a backslash at the end of the command");
      // Inside double quotes a backslash stands for itself before anything that it need not protect.
      const char next = text[++i];
      if (!word) word.emplace();
      if (quote == '"' && next != '"' && next != '\\' && next != '$' && next != '`') *word += c;
      *word += next;
    } else if (quote == 0 && (c == ' ' || c == '\t' || c == '\n')) {
      if (word) words.push_back(*std::exchange(word, std::nullopt));
    } else {
      if (!word) word.emplace();
      *word += c;
    }
  }
  if (quote != 0) throw std::invalid_argument(fmt::format("a quote ({}) that is not closed", quote));
  if (word) words.push_back(*word);
  return words;
}

std::string quoted_word(std::string_view word) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+./:,@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string_view::npos) return std::string(word);
  std::string text = "'";
  for (const char c : word)
    text += c == '\'' ? std::string(R"('\'')") : std::string(1, c);  // nothing is special inside
  return text + "'";
}

}  // namespace contact::engines
