// Detection between whole models: candidates from an R-tree, then the intersector on each.
#define BOOST_ALLOW_DEPRECATED_HEADERS  // Boost 1.74 includes one of its own
#include "contact/detect.hpp"

#include <algorithm>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <iterator>
#include <limits>
#include <stdexcept>

#include "component/message.hpp"
#include "kernel/floating_point_environment.hpp"

namespace contact::inline CONTACT_ABI {
namespace {

namespace geometry = boost::geometry;
using Corner = geometry::model::point<double, 3, geometry::cs::cartesian>;
using BoundingBox = geometry::model::box<Corner>;
using Tree = geometry::index::rtree<std::pair<BoundingBox, Index>, geometry::index::quadratic<16>>;

/// A box for the tree, grown by `alarm`. Rounding separates no boxes that meet: it is monotone, and a bound of the
/// other box is a number that it leaves alone. Numbers beyond a quarter of the range are brought to it: what meets
/// outside still meets, and no sum inside the tree overflows.
BoundingBox bounds(const Box& box, double alarm) {
  constexpr double kMost = std::numeric_limits<double>::max() / 4;
  const auto corner = [&](auto&& at) {
    return Corner(std::clamp(at(0), -kMost, kMost), std::clamp(at(1), -kMost, kMost), std::clamp(at(2), -kMost, kMost));
  };
  return {corner([&](int axis) { return box.min[axis] - alarm; }),
          corner([&](int axis) { return box.max[axis] + alarm; })};
}

/// What an element says of itself, which a class of somebody else's may get wrong: the tree orders by these numbers.
Box bounding_box(const CollisionModel& model, Index i) {
  const Box box = model.bounding_box(i);
  for (int axis = 0; axis < 3; ++axis)
    if (!(box.min[axis] <= box.max[axis]))
      throw std::logic_error(std::string(model.type().name) + " \"" + model.getName() +
                             "\": the bounding box of element " + std::to_string(i) + " is none");
  return box;
}

Tree tree_of(const CollisionModel& model) {
  const Index size = model.getSize();
  std::vector<std::pair<BoundingBox, Index>> boxes;
  boxes.reserve(static_cast<std::size_t>(size));
  for (Index i = 0; i < size; ++i) boxes.emplace_back(bounds(bounding_box(model, i), 0), i);
  return Tree(boxes);  // packed: built whole, nearly linear
}

/// Contacts are gathered in blocks of about so many: one growing vector would be copied again and again.
constexpr std::size_t kBlock = 1 << 18;

/// So many candidates are put to the intersector together, or a few more.
constexpr std::size_t kTogether = 1024;

/// The contacts of one element: part of a block.
struct Run {
  std::size_t block = 0;
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Where `block` holds something else than what was counted. The counts are an intersector's, perhaps a plug-in's.
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

// Not inlined: what RoundToNearest sets must be set before anything is computed.
[[gnu::noinline]] std::optional<OutputVector> detected(const Intersection& intersection, const CollisionModel& model1,
                                                       const CollisionModel& model2) {
  const Distances distances{intersection.getAlarmDistance(), intersection.getContactDistance()};
  if (const auto error = outside_domain(distances)) throw std::invalid_argument(component::message(*error));
  bool swap = false;
  const ElementIntersector* intersector = intersection.findIntersector(model1, model2, swap);
  if (!intersector) return std::nullopt;

  const bool self = &model1 == &model2;
  const CollisionModel& first = swap ? model2 : model1;
  const CollisionModel& second = swap ? model1 : model2;
  const Tree tree2 = tree_of(model2);
  const std::optional<Tree> other = self ? std::nullopt : std::optional(tree_of(model1));
  const Tree& tree1 = other ? *other : tree2;

  // Elements are visited as the first model's tree holds them, neighbours after neighbours, so that the second's tree
  // and elements are in the cache; the contacts are put in order afterwards.
  OutputVector contacts;
  intersector->beginIntersect(first, second, contacts);
  std::vector<OutputVector> blocks;
  std::size_t found = 0;
  std::vector<Run> runs(tree1.size());
  std::vector<ElementPair> pairs;  // of whole elements of model1
  std::vector<std::size_t> written;
  const auto put_to_intersector = [&] {
    // The first grows as it must, since most models have few contacts; those behind it are made whole.
    if (blocks.empty())
      blocks.emplace_back();
    else if (blocks.back().size() >= kBlock)
      blocks.emplace_back().reserve(kBlock + kBlock / 8);
    OutputVector& block = blocks.back();
    std::size_t end = block.size();
    written.assign(pairs.size(), 0);
    intersector->intersectPairs(first, second, pairs, written, block, intersection);
    expect_counted(*intersector, written, end, block.size());
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      Run& run = runs[static_cast<std::size_t>(swap ? pairs[k].second : pairs[k].first)];
      if (run.begin == run.end) run = {blocks.size() - 1, end, end};
      end += written[k];
      run.end = end;
      found += written[k];
    }
    pairs.clear();
  };
  std::vector<Index> near;
  for (const auto& [box, i] : tree1) {
    near.clear();
    for (auto it = tree2.qbegin(geometry::index::intersects(bounds(bounding_box(model1, i), distances.alarm)));
         it != tree2.qend(); ++it)
      if (!self || it->second > i) near.push_back(it->second);
    std::sort(near.begin(), near.end());
    for (const Index j : near) pairs.push_back(swap ? ElementPair{j, i} : ElementPair{i, j});
    if (pairs.size() >= kTogether) put_to_intersector();
  }
  if (!pairs.empty()) put_to_intersector();
  contacts.reserve(contacts.size() + found);
  for (const Run& run : runs)
    if (run.begin != run.end)
      contacts.insert(contacts.end(), &blocks[run.block][run.begin], &blocks[run.block][run.end - 1] + 1);
  intersector->endIntersect(first, second, contacts);
  if (swap) std::transform(contacts.begin(), contacts.end(), contacts.begin(), mirrored);
  return contacts;
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

}  // namespace contact::inline CONTACT_ABI
