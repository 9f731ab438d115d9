// Arrays by name in an HDF5 file.
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>

#include "formats/arrays.hpp"
#include "formats/hdf5.hpp"
#include "formats/hdf5_chunk.hpp"
#include "formats/input_error.hpp"

namespace contact::formats {
namespace {

using hdf5::checked;
using hdf5::Handle;
using hdf5::Lock;
using Kind = ArrayType::Kind;

constexpr unsigned kDeflate = 4;                        // 9 takes four times as long for 1 % of the size
constexpr hsize_t kLargestChunk = hsize_t{1} << 25;     // bytes; the largest of ours has 4096 exact numbers
constexpr hsize_t kMostDeflated = 1032;                 // times smaller than before is the most that deflate can make
constexpr hsize_t kLargestInflated = hsize_t{1} << 28;  // bytes that HDF5 may try to inflate a chunk to
constexpr std::size_t kChecksum = 4;                    // bytes that may be deflated beside the rows
const char* const kLabelsAttribute = "names";
const char* const kHeaderAttribute = "header";

Handle copied(hid_t type) { return {H5Tcopy(type), H5Tclose}; }

std::vector<hsize_t> shape_of(const ArrayType& type, hsize_t rows) {
  const std::vector<std::uint64_t> shape = type.shape(rows);
  return {shape.begin(), shape.end()};
}

/// Rows from `first` on in memory and in the file, given to call(type, memory space, file space).
template <class Call>
void transfer(hid_t set, hid_t type, const ArrayType& array, hsize_t first, hsize_t count, Call call) {
  const std::vector<hsize_t> size = shape_of(array, count);
  std::vector<hsize_t> start(size.size(), 0);
  start[0] = first;
  const Handle memory(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), H5Sclose);
  const Handle file(H5Dget_space(set), H5Sclose);
  checked(H5Sselect_hyperslab(file, H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr));
  checked(call(type, memory, file));
}

void read_rows(hid_t set, hid_t type, const ArrayType& array, hsize_t first, hsize_t count, std::vector<char>& bytes) {
  bytes.resize(count * array.row_size());
  transfer(set, type, array, first, count, [&](hid_t as, hid_t memory, hid_t file) {
    return H5Dread(set, as, memory, file, H5P_DEFAULT, bytes.data());
  });
}

/// What a type of the file is read as; `other` where nothing here reads it.
struct MemoryType {
  Kind kind = Kind::other;
  Handle type{};
};
MemoryType memory_type(hid_t type) {
  const auto is = [&](std::initializer_list<hid_t> types) {
    return std::any_of(types.begin(), types.end(), [&](hid_t one) { return checked(H5Tequal(type, one)) > 0; });
  };
  if (is({H5T_IEEE_F64LE, H5T_IEEE_F64BE})) return {Kind::real, copied(H5T_NATIVE_DOUBLE)};
  if (is({H5T_IEEE_F32LE, H5T_IEEE_F32BE})) return {Kind::real, copied(H5T_NATIVE_FLOAT)};
  if (is({H5T_STD_U8LE})) return {Kind::byte, copied(H5T_NATIVE_UINT8)};
  if (is({H5T_STD_U32LE})) return {Kind::bits, copied(H5T_NATIVE_UINT32)};
  // NumPy's truth values are an enumeration of one byte.
  if (H5Tget_class(type) == H5T_ENUM && H5Tget_size(type) == 1) return {Kind::byte, copied(type)};
  if (H5Tget_class(type) == H5T_STRING && checked(H5Tis_variable_str(type)) == 0 &&
      H5Tget_strpad(type) != H5T_STR_SPACEPAD)
    return {Kind::text, copied(type)};
  return {};
}

/// Whether a chunk, whose filters end in deflate or in a checksum behind it, inflates to at most `most` bytes.
bool inflates_within(hid_t set, const std::vector<hsize_t>& at, std::size_t size, std::size_t most) {
  std::vector<unsigned char> stored(size);
  std::uint32_t left_out = 0;
  checked(H5Dread_chunk(set, H5P_DEFAULT, at.data(), &left_out, stored.data()));
  std::array<unsigned char, 65536> piece;
  z_stream stream{};
  stream.next_in = stored.data();
  stream.avail_in = static_cast<unsigned>(stored.size());
  inflateInit(&stream);
  int status = Z_OK;
  while (status == Z_OK && stream.total_out <= most + kChecksum) {
    stream.next_out = piece.data();
    stream.avail_out = static_cast<unsigned>(piece.size());
    status = inflate(&stream, Z_NO_FLUSH);
  }
  inflateEnd(&stream);
  return stream.total_out <= most + kChecksum;  // what is damaged HDF5 finds
}

/// Work that reads; what HDF5 cannot read is refused with file, row and array.
template <class Work>
auto reading(const Location& where, const std::string& field, Work work) {
  const Lock lock;
  try {
    return work();
  } catch (const hdf5::Error& error) {
    throw InputError(where, field, fmt::format("cannot read: {}", error.what()));
  }
}

class Hdf5Array final : public ArrayReader {
 public:
  Hdf5Array(Location where, std::string field, Handle set, Handle type, std::vector<hsize_t> chunk,
            std::vector<hdf5::Filter> filters, bool stored_as_read, ArrayType array, std::uint64_t rows)
      : ArrayReader(std::move(array), rows),
        where_(std::move(where)),
        field_(std::move(field)),
        set_(std::move(set)),
        memory_(std::move(type)),
        chunk_(std::move(chunk)),
        filters_(std::move(filters)),
        chunk_has_rows_(stored_as_read && !chunk_.empty() &&
                        std::equal(chunk_.begin() + 1, chunk_.end(), type_row().begin())) {}

  void read(std::uint64_t first, std::uint64_t count, std::vector<char>& bytes) override {
    const Location where{where_.file, first + 1, true};
    const bool is_chunk = chunk_has_rows_ && first % chunk_[0] == 0 && count <= chunk_[0];
    // The library, which one thread uses at a time, only gives the chunk as it is stored. It gets what is damaged or
    // stored in a way that is not known here, and says what is wrong.
    reading(where, field_, [&] {
      if (!chunk_.empty()) check_chunks(first, count);
      if (is_chunk)
        read_stored(first);
      else
        read_rows(set_, memory_, type(), first, count, bytes);
    });
    if (!is_chunk) return;
    bytes.resize(chunk_[0] * type().row_size());
    const bool good = decoder_.decode(stored_, left_out_, filters_, type().size, bytes);
    bytes.resize(count * type().row_size());
    if (!good) reading(where, field_, [&] { read_rows(set_, memory_, type(), first, count, bytes); });
  }

 private:
  [[nodiscard]] const std::vector<std::uint64_t>& type_row() const { return type().row; }

  void read_stored(hsize_t first) {
    std::vector<hsize_t> at(chunk_.size(), 0);
    at[0] = first;
    hsize_t size = 0;
    checked(H5Dget_chunk_storage_size(set_, at.data(), &size));
    stored_.clear();  // which no chunk decodes from
    left_out_ = 0;
    // What deflate cannot make smaller it makes hardly larger: any other size is damage.
    if (size > 2 * chunk_[0] * type().row_size() + 4096) return;
    stored_.resize(size);
    checked(H5Dread_chunk(set_, H5P_DEFAULT, at.data(), &left_out_, stored_.data()));
  }

  /// Refuses rows that are not stored, which HDF5 would make up, and a chunk that inflates to more than its rows: HDF5
  /// would give it all the memory that it asks for.
  void check_chunks(hsize_t first, hsize_t count) const {
    std::vector<hsize_t> at(chunk_.size(), 0);
    hsize_t most = type().size;
    for (const hsize_t size : chunk_) most *= size;
    const auto next_in_row = [&] {
      for (std::size_t i = type().row.size(); i > 0; --i) {
        if ((at[i] += chunk_[i]) < type().row[i - 1]) return true;
        at[i] = 0;
      }
      return false;
    };
    for (at[0] = first / chunk_[0] * chunk_[0]; at[0] < first + count; at[0] += chunk_[0]) do {
        unsigned left_out = 0;
        haddr_t address = HADDR_UNDEF;
        hsize_t size = 0;
        checked(H5Dget_chunk_info_by_coord(set_, at.data(), &left_out, &address, &size));
        if (address == HADDR_UNDEF) throw hdf5::Error(fmt::format("the rows from {} on are not stored", at[0]));
        if (size > 2 * kLargestChunk ||
            (size * kMostDeflated > kLargestInflated && !inflates_within(set_, at, size, most)))
          throw hdf5::Error(fmt::format("the chunk of the rows from {} on is of more than its {} bytes", at[0], most));
      } while (next_in_row());
  }

  Location where_;
  std::string field_;
  Handle set_;
  Handle memory_;
  std::vector<hsize_t> chunk_;  ///< its shape; none of an array that is stored in one piece
  std::vector<hdf5::Filter> filters_;
  bool chunk_has_rows_;  ///< whole ones, as they are in memory
  std::vector<unsigned char> stored_;
  std::uint32_t left_out_ = 0;  ///< bit i: filter i
  hdf5::ChunkDecoder decoder_;
};

class Hdf5File final : public ArraysFile {
 public:
  explicit Hdf5File(const std::filesystem::path& path) : where_{path.string(), 0} {
    file_ = reading(where_, "", [&] { return hdf5::open_file(path); });
  }

  nlohmann::json header() override {
    nlohmann::json attributes = nlohmann::json::object();
    for (const std::string& one : reading(where_, "", [&] { return hdf5::attribute_names(file_); }))
      attributes[one] = reading(where_, one, [&] { return hdf5::read_attribute(file_, one); });
    return attributes;
  }

  std::optional<std::string> header_text() override {
    return reading(where_, kHeaderAttribute, [&]() -> std::optional<std::string> {
      if (checked(H5Aexists(file_, kHeaderAttribute)) == 0) return std::nullopt;
      return hdf5::read_text_attribute(file_, kHeaderAttribute);
    });
  }

  std::set<std::string> names() override {
    const std::set<std::string> found = reading(where_, "", [&] { return hdf5::object_names(file_); });
    std::set<std::string> all = found;
    for (const std::string& one : found)
      if (!one.ends_with(')'))
        reading(where_, "/" + one, [&] {
          const Handle object(H5Oopen(file_, one.c_str(), H5P_DEFAULT), H5Oclose);
          for (const std::string& attribute : hdf5::attribute_names(object))
            all.insert(fmt::format("{}: attribute {}", one, attribute));
        });
    return all;
  }

  nlohmann::json labels(const std::string& one) override {
    return reading(where_, "/" + one, [&] {
      const Handle set(H5Dopen2(file_, one.c_str(), H5P_DEFAULT), H5Dclose);
      return hdf5::read_attribute(set, kLabelsAttribute);
    });
  }

  /// Only chunks as they are stored are read one at a time.
  bool reads_in_parallel() const override { return true; }

  std::unique_ptr<ArrayReader> open(const std::string& one) override {
    const std::string field = "/" + one;
    return reading(where_, field, [&]() -> std::unique_ptr<ArrayReader> {
      const auto refuse = [&](const std::string& problem) { throw InputError(where_, field, problem); };
      Handle set(H5Dopen2(file_, one.c_str(), H5P_DEFAULT), H5Dclose);
      const Handle stored(H5Dget_type(set), H5Tclose);
      MemoryType memory = memory_type(stored);
      const Handle space(H5Dget_space(set), H5Sclose);
      std::vector<hsize_t> shape(static_cast<std::size_t>(checked(H5Sget_simple_extent_ndims(space))));
      checked(H5Sget_simple_extent_dims(space, shape.data(), nullptr));
      if (shape.empty()) refuse("expected rows, got one value");
      ArrayType type{memory.kind, H5Tget_size(stored), {shape.begin() + 1, shape.end()}};
      // Such as a part of another file would be.
      const Handle creation(H5Dget_create_plist(set), H5Pclose);
      const H5D_layout_t layout = H5Pget_layout(creation);
      if ((layout != H5D_CHUNKED && layout != H5D_CONTIGUOUS) || H5Pget_external_count(creation) != 0)
        refuse("expected chunks or one piece in this file");
      std::vector<hsize_t> chunk;
      std::vector<hdf5::Filter> filters;
      if (layout == H5D_CHUNKED) {
        chunk = chunk_of(type, creation, refuse);
        filters = filters_of(creation, refuse);
      } else if (shape.front() != 0 && H5Dget_offset(set) == HADDR_UNDEF)
        refuse("its rows are not stored");
      const bool stored_as_read = memory.kind != Kind::other && checked(H5Tequal(stored, memory.type)) > 0;
      return std::make_unique<Hdf5Array>(where_, field, std::move(set), std::move(memory.type), std::move(chunk),
                                         std::move(filters), stored_as_read, std::move(type), shape.front());
    });
  }

 private:
  /// The shape of an array's chunks. Refuses those that are large.
  template <class Refuse>
  static std::vector<hsize_t> chunk_of(const ArrayType& type, hid_t creation, Refuse refuse) {
    std::vector<hsize_t> chunk(type.row.size() + 1);
    checked(H5Pget_chunk(creation, static_cast<int>(chunk.size()), chunk.data()));
    hsize_t bytes = type.size;
    // No product of two numbers up to the largest chunk overflows.
    for (const hsize_t size : chunk)
      bytes = std::min<hsize_t>(size, kLargestChunk + 1) * std::min<hsize_t>(bytes, kLargestChunk + 1);
    if (bytes > kLargestChunk)
      refuse(fmt::format("chunks of ({}), and of more than {} bytes", fmt::join(chunk, ", "), kLargestChunk));
    return chunk;
  }
  /// The filters of its chunks. Refuses those that nobody here knows.
  template <class Refuse>
  static std::vector<hdf5::Filter> filters_of(hid_t creation, Refuse refuse) {
    constexpr std::array kFilters{H5Z_FILTER_SHUFFLE, H5Z_FILTER_DEFLATE, H5Z_FILTER_FLETCHER32};
    std::vector<hdf5::Filter> filters;
    auto next = kFilters.begin();
    for (int i = 0; i < checked(H5Pget_nfilters(creation)); ++i) {
      std::size_t none = 0;
      const auto filter =
          checked(H5Pget_filter2(creation, static_cast<unsigned>(i), nullptr, &none, nullptr, 0, nullptr, nullptr));
      next = std::find(next, kFilters.end(), filter);
      if (next == kFilters.end()) refuse("expected no filters but shuffle, deflate and Fletcher-32, in that order");
      filters.push_back(static_cast<hdf5::Filter>(next - kFilters.begin()));
      ++next;
    }
    return filters;
  }

  Location where_;
  Handle file_;
};

class Hdf5Writer final : public ArraysWriter {
 public:
  Hdf5Writer(const PendingFile& pending, std::vector<Array> arrays) : pending_(pending) {
    for (Array& array : arrays) written_.push_back({std::move(array)});
    guarded([&] {
      file_ = hdf5::create_file(pending_.temporary());
      std::set<std::string> groups;
      for (const Written& one : written_)
        for (std::size_t end = one.array.name.find('/'); end != std::string::npos;
             end = one.array.name.find('/', end + 1))
          if (const std::string group = one.array.name.substr(0, end); groups.insert(group).second)
            hdf5::create_group(file_, group);
    });
  }

  void append(std::size_t array, const ArrayType& type, const std::vector<char>& rows) override {
    guarded([&] {
      Written& one = written_[array];
      if (one.set < 0 || one.type != type) create(one, type);
      const hsize_t count = rows.size() / type.row_size();
      if (count == 0) return;
      transfer(one.set, one.memory, type, one.rows, count, [&](hid_t as, hid_t memory, hid_t file) {
        return H5Dwrite(one.set, as, memory, file, H5P_DEFAULT, rows.data());
      });
      one.rows += count;
    });
  }

  void finish(const nlohmann::json& header) override {
    guarded([&] {
      for (const auto& [key, value] : header.items()) hdf5::write_attribute(file_, key, value);
      for (Written& one : written_) one.set.close();
      file_.close();
    });
  }

 private:
  struct Written {
    Array array;
    ArrayType type{};
    Handle set{};
    Handle memory{};
    hsize_t rows = 0;
  };

  template <class Work>
  void guarded(Work work) {
    const Lock lock;
    try {
      work();
    } catch (const hdf5::Error& error) {
      pending_.fail(error.what());
    }
  }

  /// Makes an array of a type; what is in the file of it already, with narrower texts, is copied.
  void create(Written& one, const ArrayType& type) {
    const Handle narrower = std::move(one.set);
    if (narrower >= 0) checked(H5Ldelete(file_, one.array.name.c_str(), H5P_DEFAULT));
    const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    checked(H5Pset_obj_track_times(creation, false));
    if (one.array.rows != 0) {  // what has no rows has no chunks
      const std::vector<hsize_t> chunk = shape_of(type, std::min(kArrayBlock, one.array.rows));
      checked(H5Pset_chunk(creation, static_cast<int>(chunk.size()), chunk.data()));
      // Bytes of texts compress as well without, and putting an array's long padding back in order takes long.
      if (type.kind != Kind::text) checked(H5Pset_shuffle(creation));
      checked(H5Pset_deflate(creation, kDeflate));
      checked(H5Pset_fletcher32(creation));
    }
    const Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
    checked(H5Pset_chunk_cache(access, 0, 0, 1));  // whole chunks are written, once
    const std::vector<hsize_t> shape = shape_of(type, one.array.rows);
    const Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose);
    one.memory = stored_type(type);
    one.type = type;
    one.set =
        Handle(H5Dcreate2(file_, one.array.name.c_str(), one.memory, space, H5P_DEFAULT, creation, access), H5Dclose);
    if (!one.array.labels.empty()) hdf5::write_attribute(one.set, kLabelsAttribute, one.array.labels);
    if (narrower < 0) return;
    std::vector<char> rows;
    for (hsize_t first = 0; first < one.rows; first += kArrayBlock) {
      const hsize_t count = std::min<hsize_t>(kArrayBlock, one.rows - first);
      read_rows(narrower, one.memory, type, first, count, rows);
      transfer(one.set, one.memory, type, first, count, [&](hid_t as, hid_t memory, hid_t file) {
        return H5Dwrite(one.set, as, memory, file, H5P_DEFAULT, rows.data());
      });
    }
  }

  /// In the file, and in the memory of a little-endian machine, which hdf5_chunk.cpp asks for.
  static Handle stored_type(const ArrayType& type) {
    switch (type.kind) {
      case Kind::real:
        return copied(type.size == sizeof(double) ? H5T_IEEE_F64LE : H5T_IEEE_F32LE);
      case Kind::byte:
        return copied(H5T_STD_U8LE);
      case Kind::bits:
        return copied(H5T_STD_U32LE);
      default:
        return hdf5::text_type(type.size);
    }
  }

  const PendingFile& pending_;
  Handle file_;
  std::vector<Written> written_;
};

}  // namespace

std::unique_ptr<ArraysFile> open_hdf5_arrays(const std::filesystem::path& path) {
  const Lock lock;
  return std::make_unique<Hdf5File>(path);
}

std::unique_ptr<ArraysWriter> create_hdf5_arrays(const PendingFile& pending, std::vector<ArraysWriter::Array> arrays) {
  return std::make_unique<Hdf5Writer>(pending, std::move(arrays));
}

}  // namespace contact::formats
