// Which intersector serves which pair of model types.
#include "contact/intersector_map.hpp"

#include <algorithm>
#include <iostream>
#include <limits>
#include <tuple>

namespace contact::inline CONTACT_ABI {
namespace {

std::string pair_name(const ModelType& type1, const ModelType& type2) {
  return std::string(type1.name) + "-" + std::string(type2.name);
}

}  // namespace

IntersectorMap::IntersectorMap() : sink_([](const std::string& message) { std::cerr << message << '\n'; }) {}

void IntersectorMap::insert(const ModelType& type1, const ModelType& type2,
                            std::unique_ptr<const ElementIntersector> intersector) {
  std::string name = intersector ? intersector->name() : "ignored<" + pair_name(type1, type2) + ">";
  entries_.insert_or_assign(Key{type1.id, type2.id}, Entry{std::move(name), std::move(intersector), added_++});
}

IntersectorMap::Found IntersectorMap::find(const ModelType& type1, const ModelType& type2) const {
  // Nearest first, then as given before swapped, then the last added: the smallest of these.
  using Rank = std::tuple<int, bool, std::size_t>;
  Found best;
  Rank best_rank;
  const auto consider = [&](const Key& key, int steps, bool swapped) {
    const auto it = entries_.find(key);
    if (it == entries_.end()) return;
    const Rank rank{steps, swapped, std::numeric_limits<std::size_t>::max() - it->second.added};
    if (best.entry && best_rank <= rank) return;
    best = {&it->second, swapped};
    best_rank = rank;
  };
  int steps1 = 0;
  for (const ModelType* t1 = &type1; t1; t1 = t1->base, ++steps1) {
    int steps2 = 0;
    for (const ModelType* t2 = &type2; t2; t2 = t2->base, ++steps2) {
      consider({t1->id, t2->id}, steps1 + steps2, false);
      consider({t2->id, t1->id}, steps1 + steps2, true);
    }
  }
  return best;
}

const ElementIntersector* IntersectorMap::get(const CollisionModel& model1, const CollisionModel& model2,
                                              bool& swapModels) const {
  const Found found = find(model1.type(), model2.type());
  swapModels = found.swapped && found.entry->intersector;
  if (!found.entry) report_missing(model1.type(), model2.type());
  return found.entry ? found.entry->intersector.get() : nullptr;
}

void IntersectorMap::report_missing(const ModelType& type1, const ModelType& type2) const {
  {
    const std::lock_guard lock(missing_mutex_);
    if (missing_.contains({type2.id, type1.id})) return;
    if (!missing_.insert({type1.id, type2.id}).second) return;
  }
  if (!sink_) return;
  std::string message = "contact: no intersector for " + pair_name(type1, type2) + "; there are";
  for (const std::string& name : names()) message += " " + name;
  if (entries_.empty()) message += " none";
  sink_(message);
}

std::vector<std::string> IntersectorMap::names() const {
  std::vector<const Entry*> ordered;
  ordered.reserve(entries_.size());
  for (const auto& [key, entry] : entries_) ordered.push_back(&entry);
  std::sort(ordered.begin(), ordered.end(), [](const Entry* a, const Entry* b) { return a->added < b->added; });
  std::vector<std::string> names;
  names.reserve(ordered.size());
  for (const Entry* entry : ordered) names.push_back(entry->name);
  return names;
}

}  // namespace contact::inline CONTACT_ABI
