// Chunks as HDF5 stores them are read as HDF5 reads them, and damaged ones are not.
#include "formats/hdf5_chunk.hpp"

#include <gtest/gtest.h>
#include <hdf5.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace contact::formats::hdf5 {
namespace {

/// A file of one chunk, of values that are opaque bytes.
struct Stored {
  std::vector<unsigned char> bytes;
  std::uint32_t left_out = 0;
};

Stored stored(const std::vector<char>& values, std::size_t size, const std::vector<Filter>& filters) {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("chunk-" + std::to_string(::getpid()) + ".h5");
  const hsize_t count = values.size() / size;
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t type = H5Tcreate(H5T_OPAQUE, size);
  const hid_t space = H5Screate_simple(1, &count, nullptr);
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_chunk(creation, 1, &count);
  for (const Filter filter : filters) {
    if (filter == Filter::shuffle) H5Pset_shuffle(creation);
    if (filter == Filter::deflate) H5Pset_deflate(creation, 4);
    if (filter == Filter::fletcher32) H5Pset_fletcher32(creation);
  }
  const hid_t set = H5Dcreate2(file, "x", type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
  EXPECT_GE(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
  EXPECT_GE(H5Dflush(set), 0);
  Stored found;
  const hsize_t at = 0;
  hsize_t length = 0;
  EXPECT_GE(H5Dget_chunk_storage_size(set, &at, &length), 0);
  found.bytes.resize(length);
  EXPECT_GE(H5Dread_chunk(set, H5P_DEFAULT, &at, &found.left_out, found.bytes.data()), 0);
  H5Dclose(set);
  H5Pclose(creation);
  H5Sclose(space);
  H5Tclose(type);
  H5Fclose(file);
  std::filesystem::remove(path);
  return found;
}

std::vector<char> values(std::size_t bytes, unsigned kinds) {
  std::vector<char> made;
  std::uint64_t state = 1;
  for (std::size_t i = 0; i < bytes; ++i) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    made.push_back(static_cast<char>((state >> 56) % kinds));
  }
  return made;
}

const std::vector<std::vector<Filter>> kOrders{
    {},
    {Filter::shuffle},
    {Filter::deflate},
    {Filter::fletcher32},
    {Filter::shuffle, Filter::deflate},
    {Filter::deflate, Filter::fletcher32},
    {Filter::shuffle, Filter::deflate, Filter::fletcher32},
};

TEST(Hdf5Chunk, IsReadAsHdf5ReadsItWhateverItWentThrough) {
  for (const std::size_t size : {1U, 2U, 3U, 4U, 8U, 24U})
    for (const std::size_t count : {1U, 2U, 7U, 511U, 512U, 513U, 4096U})
      // Of 256 kinds deflate makes nothing smaller, and HDF5 leaves it out.
      for (const unsigned kinds : {1U, 3U, 256U})
        for (const std::vector<Filter>& filters : kOrders) {
          const std::vector<char> right = values(count * size, kinds);
          const Stored chunk = stored(right, size, filters);
          std::vector<char> found(right.size());
          ChunkDecoder decoder;
          EXPECT_TRUE(decoder.decode(chunk.bytes, chunk.left_out, filters, size, found))
              << size << " x " << count << ", " << kinds << ", " << filters.size();
          EXPECT_EQ(found, right);
        }
}

TEST(Hdf5Chunk, OfWhichABitIsAnotherIsNotRead) {
  const std::vector<Filter>& filters = kOrders.back();
  const std::vector<char> right = values(8 * 100, 3);
  const Stored good = stored(right, 8, filters);
  ChunkDecoder decoder;
  std::vector<char> found(right.size());
  for (std::size_t at = 0; at < good.bytes.size(); ++at) {
    std::vector<unsigned char> bad = good.bytes;
    bad[at] = static_cast<unsigned char>(bad[at] ^ 1 << at % 8);
    EXPECT_FALSE(decoder.decode(bad, 0, filters, 8, found)) << at;
  }
}

TEST(Hdf5Chunk, OfAnotherLengthIsNotRead) {
  for (const std::vector<Filter>& filters : kOrders) {
    const std::vector<char> right = values(8 * 100, 3);
    const Stored good = stored(right, 8, filters);
    ChunkDecoder decoder;
    for (const std::size_t size : {right.size() - 8, right.size() + 8}) {
      std::vector<char> found(size);
      EXPECT_FALSE(decoder.decode(good.bytes, 0, filters, 8, found)) << size;
    }
    std::vector<char> found(right.size());
    for (std::size_t length = 0; length < good.bytes.size(); ++length)
      EXPECT_FALSE(decoder.decode({good.bytes.begin(), good.bytes.begin() + static_cast<std::ptrdiff_t>(length)}, 0,
                                  filters, 8, found))
          << length;
  }
}

}  // namespace
}  // namespace contact::formats::hdf5
