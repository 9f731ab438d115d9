// The elements of a model in the order of space, and a tree of boxes over them.
#include "component/box_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "kernel/floating_point_environment.hpp"

namespace contact::component {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kPart = 8192;  // elements that a thread takes at a time

/// What an element says of itself, which a class of somebody else's may get wrong: the tree orders by these numbers.
Box bounding_box(const CollisionModel& model, Index i) {
  Box box = model.bounding_box(i);
  for (int axis = 0; axis < 3; ++axis)
    if (!(box.min[axis] <= box.max[axis]))
      throw std::logic_error(std::string(model.type().name) + " \"" + model.getName() +
                             "\": the bounding box of element " + std::to_string(i) + " is none");
  return box;
}

/// Numbers beyond a quarter of the range are brought to it where elements are put in order: no difference overflows.
double in_range(double x) {
  constexpr double kMost = std::numeric_limits<double>::max() / 4;
  return std::clamp(x, -kMost, kMost);
}
Vector3 middle(const Box& box) {
  Vector3 middle;
  for (int axis = 0; axis < 3; ++axis) middle[axis] = 0.5 * in_range(box.min[axis]) + 0.5 * in_range(box.max[axis]);
  return middle;
}
Vector3 middle(const Ball& ball) {
  return {in_range(ball.center[0]), in_range(ball.center[1]), in_range(ball.center[2])};
}
double extent(const Ball& ball) { return ball.radius; }
double extent(const Box& box) {
  double most = 0;
  for (int axis = 0; axis < 3; ++axis) most = std::max(most, in_range(box.max[axis]) - in_range(box.min[axis]));
  return most;
}

/// An element and its key: the class of its size above, its cell on the curve below.
struct Keyed {
  std::uint32_t key;
  std::uint32_t element;
};
constexpr unsigned kAxisBits = 9;
constexpr unsigned kCells = 1 << kAxisBits;

/// Every third bit, from nine.
std::uint32_t spread(std::uint32_t x) {
  x = (x | x << 16) & 0x030000ff;
  x = (x | x << 8) & 0x0300f00f;
  x = (x | x << 4) & 0x030c30c3;
  return (x | x << 2) & 0x09249249;
}

/// A cube around middles, cut into cells, which a curve goes through (Morton's: G. M. Morton, A computer oriented
/// geodetic data base, 1966).
class Cells {
 public:
  void add(const Vector3& at) {
    low_ = low_.cwiseMin(at);
    high_ = high_.cwiseMax(at);
  }
  void add(const Cells& more) {
    low_ = low_.cwiseMin(more.low_);
    high_ = high_.cwiseMax(more.high_);
  }
  /// Whether all middles are one point; then cells tell nothing apart.
  [[nodiscard]] bool is_point() const { return !(edge() > 0); }
  [[nodiscard]] double edge() const { return (high_ - low_).maxCoeff(); }
  /// The least and the greatest middle on the longest axis are in different cells.
  [[nodiscard]] std::uint32_t key(const Vector3& at, double edge) const {
    std::uint32_t key = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double part = (at[axis] - low_[axis]) / edge;  // 0 .. 1
      key |= spread(std::min(static_cast<std::uint32_t>(part * kCells), kCells - 1)) << axis;
    }
    return key;
  }

 private:
  Vector3 low_ = Vector3::Constant(kInfinity);
  Vector3 high_ = Vector3::Constant(-kInfinity);
};

/// Elements up to eight times as large as the middle one are of class 0, those up to 64 times of class 1, and so on.
class SizeClasses {
 public:
  template <class Shape>
  SizeClasses(std::size_t size, const Shape& shape) {
    constexpr std::size_t kSome = 1000;
    std::vector<double> some;
    for (std::size_t i = 0; i < size; i += std::max<std::size_t>(1, size / kSome)) some.push_back(extent(shape(i)));
    const auto half = some.begin() + static_cast<std::ptrdiff_t>(some.size() / 2);
    std::nth_element(some.begin(), half, some.end());
    double bound = *half;
    for (double& b : bounds_) b = bound *= 8;
  }
  [[nodiscard]] std::uint32_t of(double size) const {
    std::uint32_t c = 0;
    for (const double bound : bounds_) c += size > bound ? 1 : 0;
    return c;
  }

 private:
  std::array<double, 7> bounds_{};
};

/// By key, then by element, as those of equal keys stand already: digits from the last, or comparisons where these are
/// few.
void sort_by_key(Keyed* begin, std::size_t size, LargeVector<Keyed>& room) {
  if (size < 256) {
    std::sort(begin, begin + size,
              [](const Keyed& a, const Keyed& b) { return std::pair(a.key, a.element) < std::pair(b.key, b.element); });
    return;
  }
  constexpr unsigned kDigit = 11;
  room.resize(std::max(room.size(), size));
  Keyed* from = begin;
  Keyed* to = room.data();
  for (unsigned shift = 0; shift < 32; shift += kDigit) {
    std::array<std::uint32_t, 1 << kDigit> at{};
    for (std::size_t i = 0; i < size; ++i) ++at[from[i].key >> shift & (at.size() - 1)];
    std::uint32_t sum = 0;
    for (std::uint32_t& count : at) sum += std::exchange(count, sum);
    for (std::size_t i = 0; i < size; ++i) to[at[from[i].key >> shift & (at.size() - 1)]++] = from[i];
    std::swap(from, to);
  }
  if (from != begin) std::copy_n(from, size, begin);
}

/// Sorts the elements along a curve through space; shape(i) is that of an element. Where many share a cell, a curve
/// through that cell follows.
template <class Shape>
LargeVector<Keyed> sorted(std::size_t size, const Shape& shape, const ParallelFor& parallel_for) {
  LargeVector<Keyed> all(size);
  if (all.empty()) return all;
  const SizeClasses classes(size, shape);
  std::vector<Cells> parts((size + kPart - 1) / kPart);
  for_parts(size, kPart, parallel_for, [&](std::size_t begin, std::size_t end) {
    Cells cells;
    for (std::size_t i = begin; i < end; ++i) cells.add(middle(shape(i)));
    parts[begin / kPart] = cells;
  });
  Cells whole;
  for (const Cells& part : parts) whole.add(part);
  const double edge = whole.is_point() ? 1 : whole.edge();
  for_parts(size, kPart, parallel_for, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& its = shape(i);
      all[i] = {classes.of(extent(its)) << 3 * kAxisBits | whole.key(middle(its), edge), static_cast<std::uint32_t>(i)};
    }
  });
  LargeVector<Keyed> room;
  sort_by_key(all.data(), all.size(), room);

  // Each time the first and the last on the longest axis part, so this ends.
  std::vector<std::pair<std::size_t, std::size_t>> ranges{{0, all.size()}};
  while (!ranges.empty()) {
    const auto [first, last] = ranges.back();
    ranges.pop_back();
    for (std::size_t begin = first, end = first; begin < last; begin = end) {
      while (end < last && all[end].key == all[begin].key) ++end;
      if (end - begin <= kTogether) continue;
      Cells cell;
      for (std::size_t i = begin; i < end; ++i) cell.add(middle(shape(all[i].element)));
      if (cell.is_point()) continue;
      const double width = cell.edge();
      for (std::size_t i = begin; i < end; ++i) all[i].key = cell.key(middle(shape(all[i].element)), width);
      sort_by_key(all.data() + begin, end - begin, room);
      ranges.emplace_back(begin, end);
    }
  }
  return all;
}

void set_box(BoxBlock& block, std::size_t lane, const Box& box) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    block.min[axis][lane] = box.min[static_cast<Index>(axis)];
    block.max[axis][lane] = box.max[static_cast<Index>(axis)];
  }
}
/// Meets nothing, not even a box without bounds.
const Box kEmpty{Vector3::Constant(kNaN), Vector3::Constant(kNaN)};

Box around(const BoxBlock& block) {
  Box box = kEmpty;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double& min = box.min[static_cast<Index>(axis)];
    double& max = box.max[static_cast<Index>(axis)];
    for (std::size_t lane = 0; lane < kTogether; ++lane) {
      if (std::isnan(min) || block.min[axis][lane] < min) min = block.min[axis][lane];
      if (std::isnan(max) || block.max[axis][lane] > max) max = block.max[axis][lane];
    }
  }
  return box;
}

/// A box that contains the ball, as box_around of a model: the margin pays for every rounding.
Box box_of(const Ball& ball) {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const double c = ball.center[axis];
    const double margin = (std::abs(c) * 0x1p-50 + ball.radius * 0x1p-50) + 0x1p-1000;
    box.min[axis] = (c - ball.radius) - margin;
    box.max[axis] = (c + ball.radius) + margin;
  }
  return box;
}

std::size_t blocks(std::size_t n) { return (n + kTogether - 1) / kTogether; }

}  // namespace

void for_parts(std::size_t n, std::size_t part, const ParallelFor& parallel_for,
               const std::function<void(std::size_t, std::size_t)>& work) {
  const std::size_t parts = (n + part - 1) / part;
  const auto one = [&](std::size_t p) {
    const kernel::RoundToNearest environment;
    work(p * part, std::min(n, (p + 1) * part));
  };
  if (parallel_for && parts > 1) {
    parallel_for(parts, one);
    return;
  }
  for (std::size_t p = 0; p < parts; ++p) one(p);
}

namespace {

/// Sets the elements of the tree, in their order, and the two lowest levels. put(place, element, block, lane) keeps
/// the element where it belongs and sets its box in the block.
template <class Put>
void set_elements(BoxTree& tree, const LargeVector<Keyed>& order, const ParallelFor& parallel_for, const Put& put) {
  tree.element.resize(tree.size);
  tree.levels[1].resize(std::max<std::size_t>(1, blocks(blocks(tree.size))));
  constexpr std::size_t kOfABlock = kTogether * kTogether;  // elements under one block of levels[1]
  static_assert(kPart % kOfABlock == 0);
  for_parts(tree.levels[1].size() * kOfABlock, kPart, parallel_for, [&](std::size_t begin, std::size_t end) {
    for (std::size_t first = begin; first < end; first += kTogether) {
      BoxBlock block;
      for (std::size_t lane = 0; lane < kTogether; ++lane) {
        const std::size_t place = first + lane;
        if (place < tree.size) {
          tree.element[place] = order[place].element;
          put(place, order[place].element, block, lane);
        } else {
          set_box(block, lane, kEmpty);
        }
      }
      if (first < tree.size && !tree.levels[0].empty()) tree.levels[0][first / kTogether] = block;
      set_box(tree.levels[1][first / kOfABlock], first / kTogether % kTogether, around(block));
    }
  });
}

void set_balls(BoxTree& tree, const BallArray& balls, const ParallelFor& parallel_for) {
  tree.balls.resize(blocks(tree.size));
  const auto shape = [&](std::size_t i) { return balls[static_cast<Index>(i)]; };
  set_elements(tree, sorted(tree.size, shape, parallel_for), parallel_for,
               [&](std::size_t place, std::size_t element, BoxBlock& box_block, std::size_t lane) {
                 const Ball ball = shape(element);
                 BallBlock& block = tree.balls[place / kTogether];
                 for (std::size_t axis = 0; axis < 3; ++axis)
                   block.center[axis][lane] = ball.center[static_cast<Index>(axis)];
                 block.radius[lane] = ball.radius;
                 set_box(box_block, lane, box_of(ball));
               });
}

void set_boxes(BoxTree& tree, const CollisionModel& model, const ParallelFor& parallel_for) {
  LargeVector<Box> boxes(tree.size);
  std::vector<std::exception_ptr> errors((tree.size + kPart - 1) / kPart);
  for_parts(tree.size, kPart, parallel_for, [&](std::size_t begin, std::size_t end) {
    try {
      for (std::size_t i = begin; i < end; ++i) boxes[i] = bounding_box(model, static_cast<Index>(i));
    } catch (...) {
      errors[begin / kPart] = std::current_exception();
    }
  });
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);

  tree.levels[0].resize(blocks(tree.size));
  const auto shape = [&](std::size_t i) -> const Box& { return boxes[i]; };
  set_elements(tree, sorted(tree.size, shape, parallel_for), parallel_for,
               [&](std::size_t, std::size_t element, BoxBlock& block, std::size_t lane) {
                 set_box(block, lane, boxes[element]);
               });
}

}  // namespace

BoxTree tree_of(const CollisionModel& model, const BallArray* balls, const ParallelFor& parallel_for) {
  BoxTree tree;
  tree.size = static_cast<std::size_t>(model.getSize());
  tree.levels.resize(2);
  if (balls != nullptr)
    set_balls(tree, *balls, parallel_for);
  else
    set_boxes(tree, model, parallel_for);
  while (tree.levels.back().size() > 1) {
    const LargeVector<BoxBlock>& below = tree.levels.back();
    LargeVector<BoxBlock> level(blocks(below.size()));
    for (std::size_t b = 0; b < level.size() * kTogether; ++b)
      set_box(level[b / kTogether], b % kTogether, b < below.size() ? around(below[b]) : kEmpty);
    tree.levels.push_back(std::move(level));
  }
  return tree;
}

}  // namespace contact::component
