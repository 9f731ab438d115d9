// Whether an engine gives the same bits again.
#include "tool/run/determinism.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <functional>
#include <numeric>
#include <optional>
#include <random>
#include <thread>

#include "engines/protocol/results.hpp"
#include "formats/sha256.hpp"
#include "golden/dataset.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {
namespace {

using Block = std::span<const engines::Question>;
using Texts = std::vector<std::string>;

constexpr std::size_t kSliceAgain = 32;  // as many as the first time

Texts asked(engines::Engine& engine, Block questions) {
  Texts texts;
  texts.reserve(questions.size());
  for (const Claim& claim : engine.answer(questions)) texts.push_back(engines::claim_object(claim));
  return texts;
}

/// So many at a time.
Texts asked(engines::Engine& engine, Block questions, std::size_t together) {
  Texts texts;
  texts.reserve(questions.size());
  for (std::size_t i = 0; i < questions.size(); i += together) {
    throw_if_interrupted();
    for (std::string& text : asked(engine, questions.subspan(i, std::min(together, questions.size() - i))))
      texts.push_back(std::move(text));
  }
  return texts;
}

Texts asked_in_another_order(engines::Engine& engine, Block questions) {
  std::vector<std::size_t> order(questions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // Not std::shuffle, which is another one in every library.
  std::mt19937_64 random(questions.size());
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  std::vector<engines::Question> shuffled;
  shuffled.reserve(order.size());
  for (const std::size_t i : order) shuffled.push_back(questions[i]);
  Texts found = asked(engine, shuffled, kSliceAgain);
  Texts texts(found.size());
  for (std::size_t i = 0; i < order.size(); ++i) texts[order[i]] = std::move(found[i]);
  return texts;
}

/// Each thread asks every so many-th slice.
Texts asked_by_threads(engines::Engine& engine, Block questions) {
  constexpr std::size_t kSliceOfThread = 8;
  Texts texts(questions.size());
  std::vector<std::exception_ptr> errors(kThreadsThatAsk);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < kThreadsThatAsk; ++t)
    threads.emplace_back([&, t] {
      try {
        for (std::size_t i = t * kSliceOfThread; i < questions.size(); i += kThreadsThatAsk * kSliceOfThread) {
          throw_if_interrupted();
          Texts found = asked(engine, questions.subspan(i, std::min(kSliceOfThread, questions.size() - i)));
          std::move(found.begin(), found.end(), texts.begin() + static_cast<std::ptrdiff_t>(i));
        }
      } catch (...) {
        errors[t] = std::current_exception();
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
  return texts;
}

std::string line_of(const engines::Question& question, const std::string& text) {
  return fmt::format("{} {}\n", question.id, text);
}

using Ask = std::function<Texts(Block)>;
using Ways = std::vector<std::pair<std::string, Ask>>;

Repeats ask(const std::vector<Source>& sources, engines::Engine& engine, const engines::EngineInfo& info,
            const Ways& all) {
  Repeats repeats;
  for (const auto& [how, ask] : all) repeats.ways.push_back({how});
  formats::Sha256 whole;
  for (const Source& source : sources) {
    if (!engine_takes(info, source.pair, source.scalar)) continue;
    const oracle::Declaration declared = info.declared_for(source.pair);
    SourceDigest digest{source.pair, source.scalar, source.family};
    formats::Sha256 hash;
    Progress progress(fmt::format("again: {}/{}", name(source.pair), source.family), source.count);
    std::vector<engines::Question> block;
    const auto ask_block = [&] {
      const Texts before = asked(engine, block, kSliceAgain);
      for (std::size_t i = 0; i < block.size(); ++i) {
        const std::string line = line_of(block[i], before[i]);
        hash.add(line);
        whole.add(line);
        if (digest.answers++ < kMostSingle) digest.each += block[i].id + formats::Sha256().add(line).hex().substr(0, 8);
      }
      for (std::size_t w = 0; w < all.size(); ++w) {
        const Texts now = all[w].second(block);
        Way& way = repeats.ways[w];
        way.asked += block.size();
        for (std::size_t i = 0; i < block.size(); ++i) {
          if (now[i] == before[i] || way.differ++ != 0) continue;
          way.question = golden::query_line(block[i].query, source.scalar);
          way.before = before[i];
          way.now = now[i];
        }
      }
      progress.add(block.size());
      block.clear();
    };
    for_each_question(source, [&](const engines::Question& question) {
      if (oracle::not_served(question.query, declared)) return;
      block.push_back(question);
      if (block.size() == kTogether) ask_block();
    });
    if (!block.empty()) ask_block();
    digest.sha256 = hash.hex();
    repeats.digests.push_back(std::move(digest));
  }
  repeats.sha256 = whole.hex();
  return repeats;
}

}  // namespace

Repeats ask_again(const std::vector<Source>& sources, engines::Engine& engine, const engines::EngineInfo& info,
                  const std::vector<OtherHost>& others) {
  Ways all{{"again, in the same order", [&](Block q) { return asked(engine, q, kSliceAgain); }},
           {"in another order", [&](Block q) { return asked_in_another_order(engine, q); }},
           {"one at a time", [&](Block q) { return asked(engine, q, 1); }},
           {fmt::format("up to {} at once", kTogether), [&](Block q) { return asked(engine, q, kTogether); }}};
  for (const OtherHost& other : others)
    all.emplace_back(other.how, [&](Block q) { return asked_by_threads(*other.engine, q); });
  if (others.empty())
    all.emplace_back(fmt::format("from {} threads", kThreadsThatAsk),
                     [&](Block q) { return asked_by_threads(engine, q); });
  return ask(sources, engine, info, all);
}

Repeats ask_once(const std::vector<Source>& sources, engines::Engine& engine, const engines::EngineInfo& info) {
  return ask(sources, engine, info, {});
}

}  // namespace contact::tool
