// Which elements of a tree are near which of another: boxes and balls by eights, in vectors.
//
//   boxes   on every axis   min1 <= max2  and  min2 <= max1
//   balls   (x2 - x1)^2 + (y2 - y1)^2 + (z2 - z1)^2 <= (r2 + (r1 + alarm))^2 (1 + 2^-40) + 2^-1000
//
// The margin of balls makes up for every rounding: both sides are right to a part of 2^-48, and to 2^-1072 where they
// are subnormal. A difference or a square beyond the range is infinite, and so is then the right side of balls that
// meet. So whatever meets is found, and the kernel decides.
#ifdef CONTACT_HAS_HIGHWAY
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "component/near.cpp"
#include "kernel/batch_targets.hpp"
// foreach_target.h includes this file once a target, so it comes before the rest.
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#else
#define HWY_BEFORE_NAMESPACE() static_assert(true)
#define HWY_AFTER_NAMESPACE() static_assert(true)
#define HWY_NAMESPACE without_vectors
#define HWY_INLINE inline
#define HWY_HAVE_FLOAT64 0
#define HWY_ONCE 1
#endif

#include <algorithm>
#include <bit>

#include "component/near.hpp"

HWY_BEFORE_NAMESPACE();
namespace contact::component {
namespace HWY_NAMESPACE {

/// A box, or a ball with its reach: its radius and the alarm distance.
struct AskingBox {
  double min[3];
  double max[3];
};
struct AskingBall {
  double center[3];
  double reach;
};

#if HWY_HAVE_FLOAT64

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<double, kTogether>;
using V = hn::Vec<D>;

/// The lanes where `within(lane)` holds, for the vectors that make up a block.
template <class Within>
HWY_INLINE unsigned lanes(const Within& within) {
  const D d;
  const std::size_t width = hn::Lanes(d);
  unsigned bits = 0;
  for (std::size_t lane = 0; lane < kTogether; lane += width) {
    std::uint8_t some[8] = {};
    hn::StoreMaskBits(d, within(lane), some);
    bits |= static_cast<unsigned>(some[0]) << lane;
  }
  return bits;
}

HWY_INLINE unsigned meeting(const BoxBlock& block, const AskingBox& box) {
  const D d;
  return lanes([&](std::size_t lane) HWY_ATTR {
    const auto axis = [&](std::size_t k) HWY_ATTR {
      return hn::And(hn::Le(hn::LoadU(d, block.min[k].data() + lane), hn::Set(d, box.max[k])),
                     hn::Ge(hn::LoadU(d, block.max[k].data() + lane), hn::Set(d, box.min[k])));
    };
    return hn::And(axis(0), hn::And(axis(1), axis(2)));
  });
}

HWY_INLINE unsigned meeting(const BallBlock& block, const AskingBall& ball) {
  const D d;
  return lanes([&](std::size_t lane) HWY_ATTR {
    const auto square = [&](std::size_t k) HWY_ATTR {
      const V delta = hn::Sub(hn::LoadU(d, block.center[k].data() + lane), hn::Set(d, ball.center[k]));
      return hn::Mul(delta, delta);
    };
    const V distance2 = hn::Add(hn::Add(square(0), square(1)), square(2));
    const V reach = hn::Add(hn::LoadU(d, block.radius.data() + lane), hn::Set(d, ball.reach));
    const V most = hn::Mul(hn::Mul(reach, reach), hn::Set(d, 1 + 0x1p-40));
    return hn::Le(distance2, hn::Add(most, hn::Set(d, 0x1p-1000)));
  });
}

#else  // no vectors of doubles

inline unsigned meeting(const BoxBlock& block, const AskingBox& box) {
  unsigned bits = 0;
  for (std::size_t lane = 0; lane < kTogether; ++lane) {
    bool within = true;
    for (std::size_t k = 0; k < 3; ++k)
      within = within && block.min[k][lane] <= box.max[k] && block.max[k][lane] >= box.min[k];
    bits |= static_cast<unsigned>(within) << lane;
  }
  return bits;
}

inline unsigned meeting(const BallBlock& block, const AskingBall& ball) {
  unsigned bits = 0;
  for (std::size_t lane = 0; lane < kTogether; ++lane) {
    double distance2 = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double delta = block.center[k][lane] - ball.center[k];
      distance2 += delta * delta;
    }
    const double reach = block.radius[lane] + ball.reach;
    bits |= static_cast<unsigned>(distance2 <= reach * reach * (1 + 0x1p-40) + 0x1p-1000) << lane;
  }
  return bits;
}

#endif

/// Ascending. Few are put where as many are less: no branch to be mistaken about.
void sort(std::uint32_t* begin, std::size_t size, std::uint32_t* to) {
  constexpr std::size_t kFew = 48;
  if (size > kFew) {
    std::copy(begin, begin + size, to);
    std::sort(to, to + size);
    return;
  }
  for (std::size_t i = 0; i < size; ++i) {
    std::uint32_t less = 0;
    for (std::size_t j = 0; j < size; ++j) less += begin[j] < begin[i] ? 1 : 0;
    to[less] = begin[i];
  }
}

HWY_INLINE AskingBox box_in(const BoxBlock& block, std::size_t lane, double alarm) {
  AskingBox box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.min[axis] = block.min[axis][lane] - alarm;
    box.max[axis] = block.max[axis][lane] + alarm;
  }
  return box;
}
HWY_INLINE AskingBall ball_in(const BallBlock& block, std::size_t lane, double alarm) {
  return {{block.center[0][lane], block.center[1][lane], block.center[2][lane]}, block.radius[lane] + alarm};
}

/// A box that meets the bounding box of every ball that meets this one: the margin pays for the sums' roundings.
HWY_INLINE AskingBox box_around(const AskingBall& ball) {
  AskingBox box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double c = ball.center[axis];
    const double margin = ((c < 0 ? -c : c) * 0x1p-50 + ball.reach * 0x1p-50) + 0x1p-1000;
    box.min[axis] = (c - ball.reach) - margin;
    box.max[axis] = (c + ball.reach) + margin;
  }
  return box;
}

void find(const Search& search, std::size_t first_block, std::size_t last_block, std::uint32_t list,
          std::vector<std::uint32_t>& elements) {
  const BoxTree& asking = search.asking;
  const BoxTree& asked = search.asked;
  const bool balls = !asking.balls.empty();
  const std::size_t top = asked.levels.size() - 1;
  const LargeVector<BoxBlock>& above = asked.levels[1];
  struct Node {
    std::size_t level;
    std::size_t block;
  };
  std::vector<Node> open;
  std::vector<std::size_t> blocks;  // of levels[1], that any of those who ask together may need
  std::vector<std::uint32_t> found;
  for (std::size_t b = first_block; b < last_block; ++b) {
    AskingBox boxes[kTogether];
    AskingBall ball[kTogether];
    AskingBox all{};
    unsigned asks = 0;
    for (unsigned left = asking.used(b); left != 0; left &= left - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(left));
      const std::uint32_t i = asking.element[b * kTogether + lane];
      if (i < search.first || i >= search.last) continue;
      if (balls) {
        ball[lane] = ball_in(asking.balls[b], lane, search.alarm);
        boxes[lane] = box_around(ball[lane]);
      } else {
        boxes[lane] = box_in(asking.levels[0][b], lane, search.alarm);
      }
      for (std::size_t axis = 0; axis < 3; ++axis) {
        all.min[axis] = asks == 0 ? boxes[lane].min[axis] : std::min(all.min[axis], boxes[lane].min[axis]);
        all.max[axis] = asks == 0 ? boxes[lane].max[axis] : std::max(all.max[axis], boxes[lane].max[axis]);
      }
      asks |= 1U << lane;
    }
    if (asks == 0) continue;
    if (search.found.load(std::memory_order_relaxed) > search.most) return;

    blocks.clear();
    open.push_back({top, 0});
    while (!open.empty()) {
      const Node node = open.back();
      open.pop_back();
      if (node.level == 1) {
        blocks.push_back(node.block);
        continue;
      }
      for (unsigned bits = meeting(asked.levels[node.level][node.block], all); bits != 0; bits &= bits - 1)
        open.push_back({node.level - 1, node.block * kTogether + static_cast<std::size_t>(std::countr_zero(bits))});
    }
    found.resize(std::max(found.size(), blocks.size() * kTogether * kTogether));
    for (; asks != 0; asks &= asks - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(asks));
      const std::uint32_t i = asking.element[b * kTogether + lane];
      std::uint32_t* end = found.data();
      for (const std::size_t block : blocks)
        for (unsigned bits = meeting(above[block], boxes[lane]); bits != 0; bits &= bits - 1) {
          const std::size_t below = block * kTogether + static_cast<std::size_t>(std::countr_zero(bits));
          unsigned hits = asked.used(below);
          hits &= balls ? meeting(asked.balls[below], ball[lane]) : meeting(asked.levels[0][below], boxes[lane]);
          for (; hits != 0; hits &= hits - 1) {
            *end = asked.element[below * kTogether + static_cast<std::size_t>(std::countr_zero(hits))];
            end += !search.self || *end > i ? 1 : 0;
          }
        }
      const auto count = static_cast<std::size_t>(end - found.data());
      search.near[i - search.first] = {elements.size(), static_cast<std::uint32_t>(count), list};
      if (count == 0) continue;
      elements.resize(elements.size() + count);
      sort(found.data(), count, elements.data() + (elements.size() - count));
      search.found.fetch_add(count, std::memory_order_relaxed);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace contact::component
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace contact::component {

#ifdef CONTACT_HAS_HIGHWAY
HWY_EXPORT(find);
#endif

void find_near(const Search& search, std::size_t first_block, std::size_t last_block, std::uint32_t list,
               std::vector<std::uint32_t>& elements) {
#ifdef CONTACT_HAS_HIGHWAY
  HWY_DYNAMIC_DISPATCH(find)(search, first_block, last_block, list, elements);
#else
  without_vectors::find(search, first_block, last_block, list, elements);
#endif
}

}  // namespace contact::component
#endif  // HWY_ONCE
