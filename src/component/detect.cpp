// Detection between whole models: candidates from trees of boxes, then the intersector on each, in the order promised.
//
// 1. The elements of the first model ask the second's tree, neighbours after neighbours, so that what they need is in
//    the cache. Of each only the indices of the elements near it are kept.
// 2. Element by element, in the order of the result, these candidates are put to the intersector.
//
// Both are cut into pieces that any thread may do. Where step 1 would keep too many candidates, it takes fewer elements
// at a time. Spheres under the built-in intersectors are put to the batch kernel out of one array, without the
// intersector's columns.
#include "contact/detect.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "component/built_in.hpp"
#include "component/message.hpp"
#include "component/near.hpp"
#include "component/sphere_contacts.hpp"
#include "kernel/floating_point_environment.hpp"

namespace contact::inline CONTACT_ABI {
namespace {

using component::BoxTree;
using component::Near;

/// So many candidates are put to the intersector together.
constexpr std::size_t kPairs = 512;
/// So many times kPairs are handed out together where there are threads: enough for each, little in memory.
constexpr std::size_t kRuns = 128;
/// So many candidates are kept at a time, or as many as one element has.
constexpr std::size_t kMostKept = std::size_t{1} << 24;
/// Blocks of elements that ask in one piece.
constexpr std::size_t kBlocks = 32;

/// Where the contacts that an intersector wrote, counted from `before` to `after`, are not those that it says. The
/// counts are an intersector's, perhaps a plug-in's.
void expect_counted(const ElementIntersector& intersector, const std::vector<std::size_t>& written, std::size_t before,
                    std::size_t after) {
  std::size_t left = after < before ? 0 : after - before;
  bool right = after >= before;
  for (const std::size_t count : written) {
    right = right && count <= left;
    left -= std::min(count, left);
  }
  if (!right || left != 0)
    throw std::logic_error(intersector.name() +
                           ": the numbers of contacts that it says it wrote are not those it wrote");
}

/// A sphere model's numbers, where its class is one of ours and so has overridden nothing.
struct Spheres {
  BallArray balls;
  SphereKind kind;
};
template <class Model>
std::optional<Spheres> spheres_of(const CollisionModel& model) {
  if (typeid(model) != typeid(Model)) return std::nullopt;
  return Spheres{static_cast<const Model&>(model).balls(), Model::kKind};
}
std::optional<Spheres> spheres_of(const CollisionModel& model) {
  const auto deformable = spheres_of<SphereCollisionModel>(model);
  return deformable ? deformable : spheres_of<RigidSphereModel>(model);
}

/// The component that an intersector of spheres belongs to, where that is one of ours.
const DiscreteIntersection* built_in(const ElementIntersector& intersector) {
  const DiscreteIntersection* object = nullptr;
  const auto look = [&]<class Model1, class Model2>() {
    using Own = MemberElementIntersector<Model1, Model2, DiscreteIntersection>;
    if (const auto* own = dynamic_cast<const Own*>(&intersector)) object = &own->object();
  };
  look.template operator()<SphereCollisionModel, SphereCollisionModel>();
  look.template operator()<RigidSphereModel, RigidSphereModel>();
  look.template operator()<SphereCollisionModel, RigidSphereModel>();
  return object && component::is_built_in(*object) ? object : nullptr;
}

/// The numbers of a ball beside each other, in half a line of the cache.
struct alignas(32) Packed {
  double x, y, z, r;
};

class Detection {
 public:
  Detection(const Intersection& intersection, const CollisionModel& model1, const CollisionModel& model2,
            const ParallelFor& parallel_for)
      : intersection_(intersection), model1_(model1), model2_(model2), parallel_for_(parallel_for) {
    distances_ = {intersection.getAlarmDistance(), intersection.getContactDistance()};
    if (const auto error = outside_domain(distances_)) throw std::invalid_argument(component::message(*error));
    intersector_ = intersection.findIntersector(model1, model2, swap_);
  }

  [[nodiscard]] bool has_intersector() const { return intersector_ != nullptr; }

  OutputVector all() {
    OutputVector contacts;
    begin(contacts);
    search([&](std::size_t candidates) {
      if (spheres_ && contacts.capacity() < contacts.size() + candidates) {  // nearly all of these will be contacts
        contacts.reserve(std::max(contacts.size() + candidates, is_first_ ? 0 : 2 * contacts.capacity()));
        component::ask_for_large_pages(contacts.data(), contacts.capacity() * sizeof(DetectionOutput));
      }
      for (const Run& run : runs_) intersect(run, contacts);
    });
    intersector_->endIntersect(first(), second(), contacts);
    if (swap_) std::transform(contacts.begin(), contacts.end(), contacts.begin(), mirrored);
    return contacts;
  }

  void stream(const TakeContacts& take) {
    std::vector<OutputVector> some(1);
    const auto hand_over = [&](std::size_t count) {
      const std::span<const OutputVector> all = std::span(some).first(count);
      if (std::any_of(all.begin(), all.end(), [](const OutputVector& contacts) { return !contacts.empty(); }))
        take(all);
    };
    const auto seen_right = [&](OutputVector& contacts) {
      if (swap_) std::transform(contacts.begin(), contacts.end(), contacts.begin(), mirrored);
    };
    begin(some.front());
    seen_right(some.front());
    hand_over(1);
    some.resize(parallel_for_ ? kRuns : 1);
    search([&](std::size_t) {
      for (std::size_t from = 0; from < runs_.size(); from += some.size()) {
        const std::size_t count = std::min(some.size(), runs_.size() - from);
        component::for_parts(count, 1, parallel_for_, [&](std::size_t k, std::size_t) {
          some[k].clear();
          some[k].reserve(spheres_ ? kPairs : 0);
          intersect(runs_[from + k], some[k]);
          seen_right(some[k]);
        });
        hand_over(count);
      }
    });
    some.front().clear();
    intersector_->endIntersect(first(), second(), some.front());
    seen_right(some.front());
    hand_over(1);
  }

 private:
  /// Candidates that follow each other: from one of the element `element` on.
  struct Run {
    std::size_t element = 0;
    std::size_t candidate = 0;
    std::size_t size = 0;
  };

  [[nodiscard]] const CollisionModel& first() const { return swap_ ? model2_ : model1_; }
  [[nodiscard]] const CollisionModel& second() const { return swap_ ? model1_ : model2_; }
  [[nodiscard]] bool self() const { return &model1_ == &model2_; }

  void begin(OutputVector& contacts) {
    for (const CollisionModel* model : {&model1_, &model2_})
      if (static_cast<std::uint64_t>(model->getSize()) > std::numeric_limits<std::uint32_t>::max())
        throw std::length_error(std::string(model->type().name) + " \"" + model->getName() +
                                "\": more than 2^32 - 1 elements");
    intersector_->beginIntersect(first(), second(), contacts);
    const auto spheres1 = spheres_of(model1_);
    const auto spheres2 = spheres_of(model2_);
    const DiscreteIntersection* object = built_in(*intersector_);
    if (spheres1 && spheres2 && object) {
      spheres_ = true;
      points_ = {point_on(object->points(), (swap_ ? spheres2 : spheres1)->kind),
                 point_on(object->points(), (swap_ ? spheres1 : spheres2)->kind)};
    }
    tree2_ = component::tree_of(model2_, spheres_ ? &spheres2->balls : nullptr, parallel_for_);
    if (!self()) tree1_ = component::tree_of(model1_, spheres_ ? &spheres1->balls : nullptr, parallel_for_);
    if (!spheres_) return;
    pack(spheres2->balls, packed2_);
    if (!self()) pack(spheres1->balls, packed1_);
  }

  void pack(const BallArray& balls, component::LargeVector<Packed>& packed) const {
    packed.resize(static_cast<std::size_t>(balls.radii.size()));
    component::for_parts(packed.size(), 1 << 14, parallel_for_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const Ball ball = balls[static_cast<Index>(i)];
        packed[i] = {ball.center[0], ball.center[1], ball.center[2], ball.radius};
      }
    });
  }

  /// Calls work(candidates) with runs_ set, again and again until all elements of model1 have asked.
  template <class Work>
  void search(const Work& work) {
    const auto size = static_cast<std::size_t>(model1_.getSize());
    std::size_t together = size;
    for (std::size_t begin = 0; begin < size;) {
      const std::size_t end = std::min(size, begin + together);
      const std::optional<std::size_t> found = find(begin, end);
      if (!found) {
        together = std::max<std::size_t>(1, (end - begin) / 8);
        continue;
      }
      is_first_ = begin == 0;
      cut(*found);
      work(*found);
      begin = end;
      if (*found < kMostKept / 4) together *= 2;
    }
  }

  /// Sets near_ of the elements from `begin` to `end`, and says how many candidates that is; nothing where they are
  /// too many for more than one element.
  std::optional<std::size_t> find(std::size_t begin, std::size_t end) {
    const BoxTree& tree1 = self() ? tree2_ : tree1_;
    const std::size_t blocks = (tree1.size + component::kTogether - 1) / component::kTogether;
    lists_.resize((blocks + kBlocks - 1) / kBlocks);
    near_.resize(end - begin);
    from_ = begin;
    std::atomic<std::size_t> found = 0;
    const std::size_t most = end - begin == 1 ? std::numeric_limits<std::size_t>::max() : kMostKept;
    const component::Search search{tree1, tree2_, distances_.alarm, self(), begin, end, most, found, near_};
    component::for_parts(blocks, kBlocks, parallel_for_, [&](std::size_t first, std::size_t last) {
      const std::size_t list = first / kBlocks;
      lists_[list].clear();
      component::find_near(search, first, last, static_cast<std::uint32_t>(list), lists_[list]);
    });
    if (found > most) return std::nullopt;
    return found;
  }

  void cut(std::size_t candidates) {
    runs_.clear();
    runs_.reserve(candidates / kPairs + 1);
    std::size_t room = 0;
    for (std::size_t i = 0; i < near_.size(); ++i)
      for (std::size_t k = 0; k < near_[i].count;) {
        if (room == 0) {
          runs_.push_back({i, k, 0});
          room = kPairs;
        }
        const std::size_t taken = std::min<std::size_t>(room, near_[i].count - k);
        runs_.back().size += taken;
        room -= taken;
        k += taken;
      }
  }

  /// pair(i, j) for each candidate of a run.
  template <class Pair>
  void for_candidates(const Run& run, const Pair& pair) const {
    std::size_t left = run.size;
    std::size_t k = run.candidate;
    for (std::size_t i = run.element; left > 0; ++i, k = 0) {
      const Near& near = near_[i];
      const std::uint32_t* candidates = lists_[near.list].data() + near.begin;
      const std::size_t end = std::min<std::size_t>(near.count, k + left);
      left -= end - k;
      for (; k < end; ++k) pair(from_ + i, std::size_t{candidates[k]});
    }
  }

  // Not inlined, this and what else computes: what RoundToNearest sets must be set before.
  [[gnu::noinline]] void intersect(const Run& run, OutputVector& contacts) const {
    if (spheres_) {
      intersect_spheres(run, contacts);
      return;
    }
    std::vector<ElementPair> pairs;
    pairs.reserve(run.size);
    for_candidates(run, [&](std::size_t i, std::size_t j) {
      const auto index1 = static_cast<Index>(i);
      const auto index2 = static_cast<Index>(j);
      pairs.push_back(swap_ ? ElementPair{index2, index1} : ElementPair{index1, index2});
    });
    std::vector<std::size_t> written(pairs.size());
    const std::size_t before = contacts.size();
    intersector_->intersectPairs(first(), second(), pairs, written, contacts, intersection_);
    expect_counted(*intersector_, written, before, contacts.size());
  }

  void intersect_spheres(const Run& run, OutputVector& contacts) const {
    // Lists and balls lie anywhere in memory: they are asked for one after the other, and come together.
    std::size_t left = run.size + run.candidate;
    for (std::size_t i = run.element; left > 0; ++i) {
      const Near& near = near_[i];
      if (near.count > 0) __builtin_prefetch(lists_[near.list].data() + near.begin);
      left -= std::min<std::size_t>(near.count, left);
    }
    struct Pair {
      std::size_t i, j;
    };
    std::array<Pair, kPairs> pairs;
    std::size_t size = 0;
    for_candidates(run, [&](std::size_t i, std::size_t j) {
      __builtin_prefetch(&packed2_[j]);
      pairs[size++] = {i, j};
    });
    const component::LargeVector<Packed>& packed1 = self() ? packed2_ : packed1_;
    component::SphereContacts together;
    for (std::size_t from = 0; from < size; from += component::SphereContacts::kMost) {
      const std::size_t some = std::min(size - from, component::SphereContacts::kMost);
      for (std::size_t k = 0; k < some; ++k) {
        const auto [i, j] = pairs[from + k];
        const Packed& a = swap_ ? packed2_[j] : packed1[i];
        const Packed& b = swap_ ? packed1[i] : packed2_[j];
        together.set(k, a.x, a.y, a.z, a.r, b.x, b.y, b.z, b.r);
      }
      together.compute(some, distances_, points_, [&](std::size_t k, std::size_t row) {
        const auto [i, j] = pairs[from + k];
        const CollisionElement elem1(first(), static_cast<Index>(swap_ ? j : i));
        const CollisionElement elem2(second(), static_cast<Index>(swap_ ? i : j));
        contacts.push_back(together.contact(row, elem1, elem2, contact_id(elem1, elem2)));
      });
    }
  }

  const Intersection& intersection_;
  const CollisionModel& model1_;
  const CollisionModel& model2_;
  const ParallelFor& parallel_for_;
  Distances distances_{};
  const ElementIntersector* intersector_ = nullptr;
  bool swap_ = false;
  bool spheres_ = false;  ///< of classes of ours, under an intersector of ours
  ContactPoints points_{};
  BoxTree tree1_;  ///< empty of a model with itself
  BoxTree tree2_;
  component::LargeVector<Packed> packed1_;
  component::LargeVector<Packed> packed2_;
  // Of the elements of model1 that are looked at together:
  std::size_t from_ = 0;
  bool is_first_ = true;
  component::LargeVector<Near> near_;
  std::vector<std::vector<std::uint32_t>> lists_;
  std::vector<Run> runs_;
};

// Not inlined: what RoundToNearest sets must be set before anything is computed.
[[gnu::noinline]] std::optional<OutputVector> detected(const Intersection& intersection, const CollisionModel& model1,
                                                       const CollisionModel& model2) {
  const ParallelFor here;
  Detection detection(intersection, model1, model2, here);
  if (!detection.has_intersector()) return std::nullopt;
  return detection.all();
}

[[gnu::noinline]] bool streamed(const Intersection& intersection, const CollisionModel& model1,
                                const CollisionModel& model2, const TakeContacts& take,
                                const ParallelFor& parallel_for) {
  Detection detection(intersection, model1, model2, parallel_for);
  if (!detection.has_intersector()) return false;
  detection.stream(take);
  return true;
}

}  // namespace

std::optional<OutputVector> detect(const Intersection& intersection, const CollisionModel& model1,
                                   const CollisionModel& model2) {
  const kernel::RoundToNearest environment;
  return detected(intersection, model1, model2);
}

std::optional<OutputVector> detect(const Intersection& intersection, const CollisionModel& model) {
  return detect(intersection, model, model);
}

bool detect_streamed(const Intersection& intersection, const CollisionModel& model1, const CollisionModel& model2,
                     const TakeContacts& take, const ParallelFor& parallel_for) {
  const kernel::RoundToNearest environment;
  return streamed(intersection, model1, model2, take, parallel_for);
}

bool detect_streamed(const Intersection& intersection, const CollisionModel& model, const TakeContacts& take,
                     const ParallelFor& parallel_for) {
  return detect_streamed(intersection, model, model, take, parallel_for);
}

}  // namespace contact::inline CONTACT_ABI
