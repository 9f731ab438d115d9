// Which models of a scene are put to each other: those that may meet, and are near.
//
// Models under the same rules are a class. Classes whose boxes are near each other, and whose rules let them meet, have
// their models compared, box by box; the trees of detection find both. So a thousand models of one node, which never
// meet each other, are one question.
#include "tool/run/near_models.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <span>
#include <tuple>

#include "contact/cube_model.hpp"
#include "contact/detect.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {
namespace {

constexpr std::size_t kMostNear = 50'000'000;  // pairs, of eight bytes

/// Takes every candidate for a contact: candidates are what is asked for.
class NearElements final : public ElementIntersector {
 public:
  bool canIntersect(const CollisionElement&, const CollisionElement&, const Intersection&) const override {
    return true;
  }
  int beginIntersect(const CollisionModel&, const CollisionModel&, OutputVector&) const override { return 0; }
  int intersect(const CollisionElement& first, const CollisionElement& second, OutputVector& contacts,
                const Intersection&) const override {
    const Vector3 none = Vector3::Zero();
    contacts.push_back({.elem = {first, second}, .id = 0, .point = {none, none}, .normal = none, .value = 0});
    return 1;
  }
  int endIntersect(const CollisionModel&, const CollisionModel&, OutputVector&) const override { return 0; }
  std::string name() const override { return "NearElements"; }
};

class WithinAlarm final : public Intersection {
 public:
  explicit WithinAlarm(double alarm) : alarm_(alarm) {}
  const ElementIntersector* findIntersector(const CollisionModel&, const CollisionModel&, bool& swap) const override {
    swap = false;
    return &candidates_;
  }
  bool useProximity() const override { return true; }
  double getAlarmDistance() const override { return alarm_; }

 private:
  double alarm_;
  NearElements candidates_;
};

const Box kNothing{Vector3::Constant(std::numeric_limits<double>::max()),
                   Vector3::Constant(std::numeric_limits<double>::lowest())};

void add(Box& box, const Box& more) {
  box.min = box.min.cwiseMin(more.min);
  box.max = box.max.cwiseMax(more.max);
}

/// Finite, as a model's boxes are: what has no bounds reaches to the last number. An element's box that is none makes
/// it all of space, so that detection comes to say so.
Box box_around(const CollisionModel& model) {
  Box all = kNothing;
  for (Index i = 0; i < model.getSize(); ++i) {
    const Box box = model.bounding_box(i);
    if (!(box.min.array() <= box.max.array()).all()) return {kNothing.max, kNothing.min};
    add(all, {box.min.cwiseMax(kNothing.max), box.max.cwiseMin(kNothing.min)});
  }
  return all;
}

CubeCollisionModel boxes_of(std::span<const std::uint32_t> which, const std::vector<Box>& boxes) {
  const auto size = static_cast<Index>(which.size());
  Eigen::MatrixX3d min(size, 3);
  Eigen::MatrixX3d max(size, 3);
  for (Index i = 0; i < size; ++i) {
    min.row(i) = boxes[which[static_cast<std::size_t>(i)]].min.transpose();
    max.row(i) = boxes[which[static_cast<std::size_t>(i)]].max.transpose();
  }
  return {"boxes", min, max};
}

/// Calls take(i, k) for the boxes `first[i]` and `second[k]` that are near; with one list, for each two of it once.
template <class Take>
void for_each_near(std::span<const std::uint32_t> first, std::span<const std::uint32_t> second,
                   const std::vector<Box>& boxes, const Intersection& within, const Take& take) {
  const CubeCollisionModel one = boxes_of(first, boxes);
  const auto taken = [&](std::span<const OutputVector> some) {
    throw_if_interrupted();
    for (const OutputVector& contacts : some)
      for (const DetectionOutput& c : contacts)
        take(static_cast<std::size_t>(c.elem.first.getIndex()), static_cast<std::size_t>(c.elem.second.getIndex()));
  };
  if (first.data() == second.data())
    detect_streamed(within, one, taken, in_parallel);
  else
    detect_streamed(within, one, boxes_of(second, boxes), taken, in_parallel);
}

class Search {
 public:
  Search(const Scene& scene, const Intersection& intersection, bool self)
      : scene_(scene), intersection_(intersection), self_(self), within_(intersection.getAlarmDistance()) {}

  NearModels found() {
    if (scene_.models.size() > std::numeric_limits<std::uint32_t>::max())
      throw formats::InputError({"detect", 0}, "", "more than 2^32 - 1 models");
    sort_by_type();
    sort_by_rules();
    list_without();
    find_near();
    found_.listed = scene_.models.size() > NearModels::kFew ? found_.near : all_that_meet();
    return std::move(found_);
  }

 private:
  using Which = std::vector<std::uint32_t>;

  struct Class {
    const MeetingRules* rules;
    Which members;
    Box box = kNothing;
    bool is_empty = true;  ///< no member has an element
  };

  [[nodiscard]] const CollisionModel& model(std::uint32_t i) const { return *scene_.models[i]; }
  [[nodiscard]] bool meets_itself(std::uint32_t i) const { return self_ || scene_.rules[i].self_collision; }
  [[nodiscard]] bool has_intersector(std::uint32_t i, std::uint32_t k) const {
    return intersectors_[type_[i] * types_.size() + type_[k]];
  }
  void keep(std::uint32_t i, std::uint32_t k) {
    if (i > k) std::swap(i, k);
    if (!has_intersector(i, k)) return;
    if (found_.near.size() == kMostNear)
      throw formats::InputError(
          {"detect", 0}, "",
          fmt::format("more than {} pairs of models are near each other: give fewer models at a time", kMostNear));
    found_.near.push_back({i, k});
  }

  /// Whether two models have an intersector is a matter of their types.
  void sort_by_type() {
    std::map<ModelId, std::uint32_t> places;
    for (std::uint32_t i = 0; i < scene_.models.size(); ++i) {
      const auto [at, is_new] = places.try_emplace(model(i).type().id, static_cast<std::uint32_t>(types_.size()));
      if (is_new) types_.emplace_back();
      type_.push_back(at->second);
      types_[at->second].push_back(i);
    }
    intersectors_.resize(types_.size() * types_.size());
    const bool some_meet_themselves = self_ || std::any_of(scene_.rules.begin(), scene_.rules.end(),
                                                           [](const MeetingRules& r) { return r.self_collision; });
    for (std::size_t t = 0; t < types_.size(); ++t)
      for (std::size_t u = t; u < types_.size(); ++u) {
        if (t == u && types_[t].size() == 1 && !some_meet_themselves) continue;  // nobody asks
        bool swap = false;
        const bool has =
            intersection_.findIntersector(model(types_[t].front()), model(types_[u].back()), swap) != nullptr;
        intersectors_[t * types_.size() + u] = intersectors_[u * types_.size() + t] = has;
      }
  }

  /// A node says something only of models that are not alone in it.
  void sort_by_rules() {
    std::map<std::string_view, std::size_t> in_node;
    for (const MeetingRules& rules : scene_.rules) ++in_node[rules.node];
    using Key = std::tuple<std::string_view, bool, bool, const std::set<int>&, const std::set<std::string>*>;
    std::map<Key, std::size_t> places;
    const auto models = static_cast<std::uint32_t>(scene_.models.size());
    for (std::uint32_t i = 0; i < models; ++i) {
      throw_if_interrupted();
      const MeetingRules& rules = scene_.rules[i];
      const bool alone = rules.node.empty() || in_node[rules.node] == 1;
      const auto [at, is_new] =
          places.try_emplace(Key(alone ? std::string_view() : rules.node, rules.simulated,
                                 !alone && rules.self_collision, rules.groups, rules.pipelines.get()),
                             classes_.size());
      if (is_new) classes_.push_back({&rules, {}, kNothing, true});
      boxes_.push_back(box_around(model(i)));
      Class& of = classes_[at->second];
      of.members.push_back(i);
      if (model(i).getSize() == 0) continue;
      of.is_empty = false;
      add(of.box, boxes_.back());
    }
  }
  /// Of different models, one of each class.
  [[nodiscard]] bool classes_meet(const Class& first, const Class& second) const {
    // Alone in its node, so that none is of one node with it: other models of its class are elsewhere.
    const bool elsewhere = &first == &second && first.members.size() > 1 &&
                           scene_.rules[first.members[0]].node != scene_.rules[first.members[1]].node;
    if (!elsewhere) return may_meet(*first.rules, *second.rules);
    MeetingRules rules = *first.rules;
    rules.node.clear();
    return may_meet(rules, rules);
  }

  /// Those of a class that have an element.
  [[nodiscard]] Which with_elements(const Class& of) const {
    Which which;
    std::copy_if(of.members.begin(), of.members.end(), std::back_inserter(which),
                 [&](std::uint32_t i) { return model(i).getSize() != 0; });
    return which;
  }

  void find_near() {
    for (std::uint32_t i = 0; i < scene_.models.size(); ++i)
      if (meets_itself(i) && model(i).getSize() != 0) keep(i, i);
    std::vector<Which> members;
    std::vector<Box> class_boxes;
    std::vector<const Class*> classes;
    for (const Class& one : classes_) {
      if (one.is_empty) continue;
      members.push_back(with_elements(one));
      class_boxes.push_back(one.box);
      classes.push_back(&one);
    }
    // Each class has the smaller ones near it in one list, so that its tree is made once.
    std::vector<Which> smaller(classes.size());
    Which every(classes.size());
    for (std::uint32_t c = 0; c < every.size(); ++c) every[c] = c;
    for_each_near(every, every, class_boxes, within_, [&](std::size_t c, std::size_t d) {
      if (!classes_meet(*classes[c], *classes[d])) return;
      if (members[c].size() == 1 && members[d].size() == 1) return keep(members[c][0], members[d][0]);
      if (members[c].size() < members[d].size()) std::swap(c, d);
      smaller[c].insert(smaller[c].end(), members[d].begin(), members[d].end());
    });
    for (std::size_t c = 0; c < classes.size(); ++c) {
      const Which& own = members[c];
      if (own.size() > 1 && classes_meet(*classes[c], *classes[c]))
        for_each_near(own, own, boxes_, within_, [&](std::size_t i, std::size_t k) { keep(own[i], own[k]); });
      if (!smaller[c].empty())
        for_each_near(own, smaller[c], boxes_, within_,
                      [&](std::size_t i, std::size_t k) { keep(own[i], smaller[c][k]); });
    }
    std::sort(found_.near.begin(), found_.near.end());
  }

  [[nodiscard]] bool meet(std::uint32_t i, std::uint32_t k) const {
    return i == k ? meets_itself(i) : may_meet(scene_.rules[i], scene_.rules[k]);
  }

  std::vector<ModelPair> all_that_meet() const {
    std::vector<ModelPair> all;
    const auto models = static_cast<std::uint32_t>(scene_.models.size());
    for (std::uint32_t i = 0; i < models; ++i)
      for (std::uint32_t k = i; k < models; ++k)
        if (meet(i, k) && has_intersector(i, k)) all.push_back({i, k});
    return all;
  }

  void list_without() {
    // How many of each type and class: whether they meet is the same for all of these.
    std::vector<std::map<const Class*, std::uint64_t>> of_type(types_.size());
    for (const Class& one : classes_)
      for (const std::uint32_t i : one.members) ++of_type[type_[i]][&one];
    for (std::size_t t = 0; t < types_.size(); ++t)
      for (std::size_t u = t; u < types_.size(); ++u) {
        if (intersectors_[t * types_.size() + u]) continue;
        if (t == u)
          for (const std::uint32_t i : types_[t]) found_.without_all += meets_itself(i) ? 1 : 0;
        for (const auto& [c, n] : of_type[t])
          for (const auto& [d, m] : of_type[u]) {
            if (t == u && std::less<>()(d, c)) continue;
            throw_if_interrupted();
            if (c == d && t == u && n == 1) continue;
            if (classes_meet(*c, *d)) found_.without_all += c == d && t == u ? n * (n - 1) / 2 : n * m;
          }
      }
    const std::uint64_t most = std::min<std::uint64_t>(found_.without_all, NearModels::kMostWithout);
    for (std::uint32_t i = 0; found_.without.size() < most; ++i) {
      throw_if_interrupted();
      std::vector<ModelPair> own;
      for (std::size_t t = 0; t < types_.size(); ++t) {
        if (intersectors_[type_[i] * types_.size() + t]) continue;
        std::size_t kept = 0;
        for (auto k = std::lower_bound(types_[t].begin(), types_[t].end(), i); k != types_[t].end() && kept < most; ++k)
          if (meet(i, *k)) {
            own.push_back({i, *k});
            ++kept;
          }
      }
      std::sort(own.begin(), own.end());
      own.resize(std::min<std::size_t>(own.size(), most - found_.without.size()));
      found_.without.insert(found_.without.end(), own.begin(), own.end());
    }
  }

  const Scene& scene_;
  const Intersection& intersection_;
  bool self_;
  WithinAlarm within_;
  std::vector<std::uint32_t> type_;  ///< of each model
  std::vector<Which> types_;         ///< the models of each type
  std::vector<char> intersectors_;   ///< whether two types have one
  std::vector<Class> classes_;
  std::vector<Box> boxes_;  ///< of each model
  NearModels found_;
};

}  // namespace

NearModels near_models(const Scene& scene, const Intersection& intersection, bool self) {
  return Search(scene, intersection, self).found();
}

}  // namespace contact::tool
