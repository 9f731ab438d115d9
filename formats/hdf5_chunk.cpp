// A chunk of HDF5 as it is stored: checksum, deflate and shuffle taken off, on any thread (libdeflate).
#include "formats/hdf5_chunk.hpp"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <new>
#include <span>

namespace contact::formats::hdf5 {
namespace {

static_assert(std::endian::native == std::endian::little, "the first byte of a value is its lowest");

constexpr std::size_t kChecksum = 4;

/// Values of twice the size, of their lower and their upper halves.
template <class Half, class Whole>
void join(const char* lower, const char* upper, char* values, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    Half low = 0;
    Half high = 0;
    std::memcpy(&low, lower + i * sizeof low, sizeof low);
    std::memcpy(&high, upper + i * sizeof high, sizeof high);
    const auto value = static_cast<Whole>(low | static_cast<Whole>(Whole{high} << (8 * sizeof high)));
    std::memcpy(values + i * sizeof value, &value, sizeof value);
  }
}

/// Values whose first bytes stand first, then their second ones and so on. What is left over stands behind them.
void unshuffle(const char* from, std::size_t size, std::vector<char>& to) {
  const std::size_t count = to.size() / size;
  if (size == 8 || size == 4) {
    // Some at a time, so that what is joined in two or three steps stays near.
    constexpr std::size_t kAtOnce = 512;
    std::array<char, 8 * kAtOnce> pairs;
    std::array<char, 8 * kAtOnce> fours;
    for (std::size_t first = 0; first < count; first += kAtOnce) {
      const std::size_t n = std::min(kAtOnce, count - first);
      for (std::size_t k = 0; k < size; k += 2)
        join<std::uint8_t, std::uint16_t>(from + k * count + first, from + (k + 1) * count + first,
                                          pairs.data() + k * kAtOnce, n);
      char* const out = to.data() + first * size;
      if (size == 4) {
        join<std::uint16_t, std::uint32_t>(pairs.data(), pairs.data() + 2 * kAtOnce, out, n);
        continue;
      }
      for (std::size_t k = 0; k < size; k += 4)
        join<std::uint16_t, std::uint32_t>(pairs.data() + k * kAtOnce, pairs.data() + (k + 2) * kAtOnce,
                                           fours.data() + k * kAtOnce, n);
      join<std::uint32_t, std::uint64_t>(fours.data(), fours.data() + 4 * kAtOnce, out, n);
    }
  } else {
    for (std::size_t k = 0; k < size; ++k)
      for (std::size_t i = 0; i < count; ++i) to[i * size + k] = from[k * count + i];
  }
  std::copy(from + count * size, from + to.size(), to.data() + count * size);
}

}  // namespace

std::uint32_t fletcher32(const unsigned char* bytes, std::size_t size) {
  constexpr std::size_t kAtOnce = 360;  // 65535 (1 + ... + 360) is below 2^32
  constexpr std::uint64_t kModulus = 65535;
  std::uint64_t first = 0;
  std::uint64_t second = 0;
  // Carries are added at the lower end: a sum that is not 0 never becomes 0.
  const auto folded = [](std::uint64_t sum) { return sum == 0 ? 0 : (sum - 1) % kModulus + 1; };
  for (std::size_t words = size / 2; words > 0;) {
    const std::size_t n = std::min(words, kAtOnce);
    std::uint32_t sum = 0;
    std::uint32_t weighted = 0;
    for (std::size_t i = 0; i < n; ++i) {
      std::uint16_t word = 0;
      std::memcpy(&word, bytes + 2 * i, sizeof word);
      const std::uint32_t x = static_cast<std::uint16_t>(word << 8 | word >> 8);
      sum += x;
      weighted += static_cast<std::uint32_t>(n - i) * x;
    }
    second = folded(second + n * first + weighted);
    first = folded(first + sum);
    bytes += 2 * n;
    words -= n;
  }
  if (size % 2 != 0) {
    first = folded(first + (std::uint64_t{*bytes} << 8));
    second = folded(second + first);
  }
  return static_cast<std::uint32_t>(second << 16 | first);
}

void ChunkDecoder::Free::operator()(void* inflater) const {
  libdeflate_free_decompressor(static_cast<libdeflate_decompressor*>(inflater));
}

bool ChunkDecoder::decode(const std::vector<unsigned char>& stored, std::uint32_t left_out,
                          const std::vector<Filter>& filters, std::size_t size, std::vector<char>& bytes) {
  const auto applied = [&](Filter filter) {
    const auto found = std::find(filters.begin(), filters.end(), filter);
    return found != filters.end() && (left_out >> (found - filters.begin()) & 1) == 0;
  };
  std::span<const unsigned char> rest(stored);
  if (applied(Filter::fletcher32)) {
    if (rest.size() < kChecksum) return false;
    rest = rest.first(rest.size() - kChecksum);
    std::uint32_t sum = 0;
    std::memcpy(&sum, rest.data() + rest.size(), sizeof sum);
    if (sum != fletcher32(rest.data(), rest.size())) return false;
  }
  const bool is_shuffled = applied(Filter::shuffle) && size > 1;
  if (is_shuffled) shuffled_.resize(bytes.size());
  std::vector<char>& to = is_shuffled ? shuffled_ : bytes;
  if (applied(Filter::deflate)) {
    if (!inflater_) inflater_.reset(libdeflate_alloc_decompressor());
    if (!inflater_) throw std::bad_alloc();
    if (libdeflate_zlib_decompress(static_cast<libdeflate_decompressor*>(inflater_.get()), rest.data(), rest.size(),
                                   to.data(), to.size(), nullptr) != LIBDEFLATE_SUCCESS)
      return false;
  } else {
    if (rest.size() != to.size()) return false;
    std::memcpy(to.data(), rest.data(), rest.size());
  }
  if (is_shuffled) unshuffle(shuffled_.data(), size, bytes);
  return true;
}

}  // namespace contact::formats::hdf5
