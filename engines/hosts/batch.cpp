// The engine `batch`: production through its functions for many pairs, in vectors.
#include <algorithm>

#include "engines/engine.hpp"
#include "kernel/batch.hpp"
#include "kernel/batch_pairs.hpp"

namespace contact::engines {
namespace {

constexpr std::size_t kTogether = 16;  // pairs in a call: the widest vectors twice

/// The k-th question among its neighbours, or itself where they are of other shapes; its decision is that of `test`,
/// its contact that of `compute` and `compute_hits` in turn.
template <class A, class B>
Claim claim_of(std::span<const Question> questions, std::size_t k, ContactPoints points) {
  const std::size_t first = k / kTogether * kTogether;
  batch::Pairs<A, B> pairs(kTogether);
  for (std::size_t lane = 0; lane < kTogether; ++lane) {
    const Query* neighbour = first + lane < questions.size() ? &questions[first + lane].query : nullptr;
    if (neighbour == nullptr || !std::holds_alternative<Two<A, B>>(neighbour->shapes) || !inside_domain(*neighbour))
      neighbour = &questions[k].query;
    pairs.set(lane, std::get<Two<A, B>>(neighbour->shapes));
  }
  const std::size_t lane = k - first;
  const Distances distances = questions[k].query.distances;
  Claim claim;
  pairs.test(distances.alarm);
  claim.overlap = pairs.hit()[lane] != 0;
  if constexpr (batch::Computes<A, B>) {
    claim.speaks_of_contact = true;
    std::optional<Contact> contact;
    if (k % 2 == 0) {
      pairs.compute(distances, points);
      contact = pairs.contact(lane);
    } else {
      const std::span hits(pairs.index().data(), pairs.compute_hits(distances, points).hits);
      const auto row = std::find(hits.begin(), hits.end(), lane);
      if (row != hits.end()) contact = pairs.contact(static_cast<std::size_t>(row - hits.begin()));
    }
    if (contact) claim.contact = {contact->normal, contact->point1, contact->point2, std::nullopt, contact->value};
  }
  return claim;
}

/// Calls visit with the shapes of a question where they have batch functions.
template <class Visit>
bool if_batched(const Shapes& shapes, const Visit& visit) {
  return std::visit(
      [&]<class A, class B>(const Two<A, B>& two) {
        if constexpr (batch::Decides<A, B>) visit(two);
        return batch::Decides<A, B>;
      },
      shapes);
}

}  // namespace

bool batch_serves(Pair pair) {
  return if_batched(description(pair).zeros(), [](const auto&) {});
}

std::vector<std::string> batch_instruction_sets() { return kernel::instruction_sets(); }

void use_batch_instruction_set(std::string_view name) { kernel::use_instruction_set(name); }

std::vector<Claim> batch_answers(std::span<const Question> questions, PointConvention points) {
  std::vector<Claim> claims;
  claims.reserve(questions.size());
  for (std::size_t k = 0; k < questions.size(); ++k) {
    const Query& query = questions[k].query;
    if (const auto error = outside_domain(query)) {
      claims.push_back(rejection(*error));
      continue;
    }
    const bool served = if_batched(query.shapes, [&]<class A, class B>(const Two<A, B>&) {
      claims.push_back(claim_of<A, B>(questions, k, contact_points(query, points)));
    });
    if (!served) claims.push_back(production_answer(query, points));  // declared not to be: who asks all the same
  }
  return claims;
}

}  // namespace contact::engines
