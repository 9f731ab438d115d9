// A chunk of HDF5 as it is stored: checksum, deflate and shuffle taken off, on any thread (libdeflate).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace contact::formats::hdf5 {

/// What a chunk went through when it was written, in this order.
enum class Filter { shuffle, deflate, fletcher32 };

/// HDF5's Fletcher-32 of bytes: of 16-bit words, the first byte of each the higher one.
[[nodiscard]] std::uint32_t fletcher32(const unsigned char* bytes, std::size_t size);

class ChunkDecoder {
 public:
  /// Gives `bytes`, as many as it has, what a stored chunk of values of `size` bytes holds. Bit i of `left_out`: filter
  /// i was not applied. False where that is not what is stored, and `bytes` are anything.
  [[nodiscard]] bool decode(const std::vector<unsigned char>& stored, std::uint32_t left_out,
                            const std::vector<Filter>& filters, std::size_t size, std::vector<char>& bytes);

 private:
  struct Free {
    void operator()(void* inflater) const;
  };
  std::unique_ptr<void, Free> inflater_;
  std::vector<char> shuffled_;
};

}  // namespace contact::formats::hdf5
