// Vectors of pairs out of columns, and of numbers, flags and states into them.
#if defined(CONTACT_KERNEL_BATCH_COLUMNS_INL_H) == defined(HWY_TARGET_TOGGLE)  // once a target
#ifdef CONTACT_KERNEL_BATCH_COLUMNS_INL_H
#undef CONTACT_KERNEL_BATCH_COLUMNS_INL_H
#else
#define CONTACT_KERNEL_BATCH_COLUMNS_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "kernel/batch.hpp"

#if HWY_HAVE_FLOAT64  // else nothing is here, and no attribute for it
HWY_BEFORE_NAMESPACE();
namespace contact::kernel {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<double>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

constexpr std::size_t kMostLanes = HWY_MAX_BYTES / sizeof(double);

template <class T = V>
HWY_INLINE T all(double x) {
  return hn::Set(D(), x);
}

HWY_INLINE void store_flags(M flags, std::uint8_t* to) {
  const hn::Rebind<std::uint8_t, D> bytes;
  const hn::RebindToUnsigned<D> words;
  const auto ones = hn::IfThenElseZero(hn::RebindMask(words, flags), hn::Set(words, 1));
  hn::StoreU(hn::TruncateTo(bytes, ones), bytes, to);
}

/// One byte a lane: 0, 1 for a hit, 2 for a degenerate one.
HWY_INLINE void store_states(M hit, M degenerate, batch::PairState* to) {
  const hn::Rebind<std::uint8_t, D> bytes;
  const hn::RebindToUnsigned<D> words;
  const auto one = hn::Set(words, 1);
  const auto states = hn::Add(hn::IfThenElseZero(hn::RebindMask(words, hit), one),
                              hn::IfThenElseZero(hn::RebindMask(words, degenerate), one));
  hn::StoreU(hn::TruncateTo(bytes, states), bytes, reinterpret_cast<std::uint8_t*>(to));
}

/// The lanes of a mask as bits, lane 0 lowest.
HWY_INLINE unsigned bits_of(M mask) {
  HWY_ALIGN std::uint8_t bytes[kMostLanes < 8 ? 8 : kMostLanes] = {};
  hn::StoreMaskBits(D(), mask, bytes);
  return bytes[0];
}

/// A vector of pairs.
struct Loaded {
  V ax, ay, az, ar, bx, by, bz, br;

  HWY_INLINE Loaded(const SpherePairs& pairs, std::size_t i) {
    const D d;
    ax = hn::LoadU(d, pairs.a[0] + i);
    ay = hn::LoadU(d, pairs.a[1] + i);
    az = hn::LoadU(d, pairs.a[2] + i);
    ar = hn::LoadU(d, pairs.a[3] + i);
    bx = hn::LoadU(d, pairs.b[0] + i);
    by = hn::LoadU(d, pairs.b[1] + i);
    bz = hn::LoadU(d, pairs.b[2] + i);
    br = hn::LoadU(d, pairs.b[3] + i);
  }
};

/// The last pairs of columns, filled up to a vector with copies of the last one.
template <class A, class B>
struct Padded {
  static constexpr std::size_t kFirst = kNumbersOf<A>;
  static constexpr std::size_t kSecond = kNumbersOf<B>;
  std::size_t count;
  double numbers[kFirst + kSecond][kMostLanes];
  PairColumns<A, B> pairs;

  Padded(const PairColumns<A, B>& whole, std::size_t begin) : count(whole.size - begin), pairs{{}, {}, count} {
    for (std::size_t column = 0; column < kFirst + kSecond; ++column) {
      const double*& to = column < kFirst ? pairs.a[column] : pairs.b[column - kFirst];
      const double* from = column < kFirst ? whole.a[column] : whole.b[column - kFirst];
      for (std::size_t lane = 0; lane < kMostLanes; ++lane)
        numbers[column][lane] = from[std::min(begin + lane, whole.size - 1)];
      to = numbers[column];
    }
  }
  Padded(const Padded&) = delete;
  Padded& operator=(const Padded&) = delete;
};

/// The ten numbers of contacts.
struct ContactLanes {
  V nx, ny, nz, px, py, pz, rx, ry, rz, value;

  HWY_INLINE static ContactLanes load(const ContactRows& from, std::size_t i) {
    const auto at = [&](std::size_t k) HWY_ATTR { return hn::LoadU(D(), from.number[k] + i); };
    return {at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7), at(8), at(9)};
  }
  HWY_INLINE void store(const ContactRows& out, std::size_t i) const {
    const D d;
    hn::StoreU(nx, d, out.number[0] + i);
    hn::StoreU(ny, d, out.number[1] + i);
    hn::StoreU(nz, d, out.number[2] + i);
    hn::StoreU(px, d, out.number[3] + i);
    hn::StoreU(py, d, out.number[4] + i);
    hn::StoreU(pz, d, out.number[5] + i);
    hn::StoreU(rx, d, out.number[6] + i);
    hn::StoreU(ry, d, out.number[7] + i);
    hn::StoreU(rz, d, out.number[8] + i);
    hn::StoreU(value, d, out.number[9] + i);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace contact::kernel
HWY_AFTER_NAMESPACE();
#endif  // HWY_HAVE_FLOAT64

#endif  // once a target
