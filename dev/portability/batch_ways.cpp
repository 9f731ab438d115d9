// Answers by the batch kernels. A call has one alarm and one contact distance and every generated question its own, so
// each is asked among its neighbours, in a place of the vector that changes from question to question.
#include <algorithm>
#include <stdexcept>

#include "dev/portability/ways.hpp"
#include "golden/answer_bytes.hpp"
#include "golden/production.hpp"
#include "kernel/batch.hpp"
#include "kernel/batch_pairs.hpp"

namespace contact::golden {
namespace {

constexpr std::size_t kWindow = 11;  // more than the widest vector has, and no multiple of a width

[[noreturn]] void differ() { throw std::runtime_error("functions of many pairs say different things of one"); }

template <class A, class B>
Expectation expectation(std::span<const Query, kWindow> window, std::size_t place) {
  batch::Pairs<A, B> pairs(kWindow);
  for (std::size_t i = 0; i < kWindow; ++i) pairs.set(i, std::get<Two<A, B>>(window[i].shapes));
  const Distances distances = window[place].distances;
  pairs.test(distances.alarm);
  Expectation found{pairs.hit()[place] != 0, std::nullopt};
  if constexpr (batch::Computes<A, B>) {
    pairs.compute(distances);
    found.contact = pairs.contact(place);
    const std::span hits(pairs.index().data(), pairs.compute_hits(distances).hits);
    const auto row = std::find(hits.begin(), hits.end(), place);
    Expectation compacted{row != hits.end(), std::nullopt};
    if (compacted.hit) compacted.contact = pairs.contact(static_cast<std::size_t>(row - hits.begin()));
    if (found.hit != found.contact.has_value() || digest_bytes(found) != digest_bytes(compacted)) differ();
  }
  return found;
}

void answer(std::span<const Query> run, std::string& bytes) {
  std::vector<const Query*> inside;
  for (const Query& query : run)
    if (!outside_domain(query)) inside.push_back(&query);
  std::size_t next = 0;
  for (const Query& query : run) {
    if (const auto error = outside_domain(query)) {
      bytes += digest_bytes(*error);
      continue;
    }
    const std::size_t place = next % kWindow;
    std::vector<Query> window;
    for (std::size_t i = 0; i < kWindow; ++i)
      window.push_back(*inside[(next + inside.size() * kWindow + i - place) % inside.size()]);
    ++next;
    const std::span<const Query, kWindow> whole(window);
    bytes += std::visit(
        [&]<class A, class B>(const Two<A, B>&) {
          if constexpr (batch::Decides<A, B>)
            return digest_bytes(expectation<A, B>(whole, place));
          else  // a pair without functions for many: one at a time
            return production_bytes(query);
        },
        query.shapes);
  }
}

}  // namespace

std::vector<Way> batch_ways() {
  std::vector<Way> ways;
  for (const std::string& set : kernel::instruction_sets())
    ways.push_back({"batch_" + set, [set](std::span<const Query> run, std::string& bytes) {
                      kernel::use_instruction_set(set);
                      answer(run, bytes);
                    }});
  return ways;
}

}  // namespace contact::golden
