// A dataset as columns in HDF5: docs/formats.md#columns.
#include "golden/columns.hpp"
#include "formats/sha256.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <vector>

#include "formats/hdf5.hpp"
#include "formats/output_file.hpp"
#include "golden/families.hpp"
#include "golden/flags.hpp"
#include "golden/query_id.hpp"

namespace contact::golden {
namespace {

using formats::hdf5::checked;
using formats::hdf5::Handle;
using formats::hdf5::Lock;

constexpr std::uint64_t kBlock = 4096;   // rows in a chunk of the file and in memory
constexpr unsigned kDeflate = 4;         // 9 takes four times as long for 1 % of the size
constexpr std::size_t kFirstWidth = 32;  // of a column of exact numbers, doubled until its longest text has room
/// Of the longest name of a number of a pair, or of a sphere's.
std::size_t rejected_length(Pair pair) {
  std::size_t longest = std::string_view("a.center[0]").size();
  const Query zeros = zero_query(pair);
  for_each_number(zeros, [&](const std::string& field, double) { longest = std::max(longest, field.size()); });
  return longest;
}
constexpr std::size_t kMostFlags = 32;
constexpr hsize_t kLargestChunk = hsize_t{1} << 25;     // bytes; the largest here has 4096 D, of longest_distance2
constexpr hsize_t kMostDeflated = 1032;                 // times smaller than before is the most that deflate can make
constexpr hsize_t kLargestInflated = hsize_t{1} << 28;  // bytes that HDF5 may try to inflate a chunk to
constexpr std::size_t kChecksum = 4;                    // bytes that may be deflated beside the rows
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
const char* const kDigest = "sha256";
const char* const kFlagNames = "names";

/// A case as a row has it: with a contact, of kNone where there is none, and with the flags as bits.
struct Row {
  Case c;
  std::uint32_t flags = 0;

  explicit Row(const DatasetHeader& h) : c{{}, zero_query(h.pair), {}, {}, {}, {}} {
    if (h.family == kInvalidFamily) c.rejected = "";
    if (is_crossing(h.pair)) c.exact.crossing.emplace();
    clear_contact();
  }
  void clear_contact() {
    const Vector3 none(kNone, kNone, kNone);
    c.expect.contact = Contact{none, none, none, kNone, false};
  }
};

/// Calls visit(path, value&, width of a text) for every column of such a file, in order: what there is to write, to
/// read and to declare.
template <class Visit>
void for_each_column(const DatasetHeader& h, Row& row, Visit&& visit) {
  Case& c = row.c;
  visit("id", c.id, kIdLength);
  for_each_field(c.query, [&](std::string path, auto& value, FieldKind /*kind*/) {
    std::replace(path.begin(), path.end(), '.', '/');
    visit(path, value, 0);
  });
  visit("flags", row.flags, 0);
  if (c.rejected) return visit("expect/rejected", *c.rejected, rejected_length(h.pair));
  visit("expect/hit", c.expect.hit, 0);
  if (!has_numbers(h.pair)) return visit("exact/gap", c.exact.gap, longest_exact(1, h.scalar));
  visit("expect/degenerate", c.expect.contact->degenerate, 0);
  if (may_have_many_nearest(h.pair)) visit("expect/unique", c.expect.contact->unique, 0);
  visit("expect/normal", c.expect.contact->normal, 0);
  visit("expect/point1", c.expect.contact->point1, 0);
  visit("expect/point2", c.expect.contact->point2, 0);
  visit("expect/value", c.expect.contact->value, 0);
  if (is_crossing(h.pair)) return visit("exact/crossing", *c.exact.crossing, longest_distance2(h.pair, h.scalar));
  visit("exact/distance2", c.exact.distance2, longest_distance2(h.pair, h.scalar));
  if (has_plane(h.pair)) visit("exact/below", c.exact.below, 0);
  visit("exact/reach", c.exact.reach, longest_exact(1, h.scalar));
  visit("exact/margin_ulps", c.exact.margin_ulps, 0);
}

/// What a value is in the file and in memory, and in words.
struct Type {
  Handle file;
  Handle memory;
  std::size_t size;
  std::string words;
  std::size_t widest;             ///< that texts may become
  std::vector<hsize_t> row = {};  ///< the shape of a row: none of one value, (3) of a vector, (3, 3) of three

  /// Values in a row.
  [[nodiscard]] hsize_t across() const {
    return std::accumulate(row.begin(), row.end(), hsize_t{1}, std::multiplies<>());
  }

  [[nodiscard]] bool is_text() const { return H5Tget_class(file) == H5T_STRING; }
  /// Whether a file has texts as wide as its longest.
  [[nodiscard]] bool grows() const { return is_text() && widest > kFirstWidth; }
  void set_width(std::size_t width) {
    file = formats::hdf5::text_type(width);
    memory = formats::hdf5::text_type(width);
    size = width;
  }
};

Handle copied(hid_t type) { return {H5Tcopy(type), H5Tclose}; }
Type type_of(const double& /*value*/, std::size_t /*width*/) {
  return {copied(H5T_IEEE_F64LE), copied(H5T_NATIVE_DOUBLE), 8, "64-bit IEEE numbers", 8};
}
Type type_of(const Vector3& v, std::size_t width) {
  Type type = type_of(v[0], width);
  type.row = {3};
  return type;
}
Type type_of(const std::array<Vector3, 3>& all, std::size_t width) {
  Type type = type_of(all[0], width);
  type.row = {3, 3};
  return type;
}
Type type_of(const bool& /*value*/, std::size_t /*width*/) {
  return {copied(H5T_STD_U8LE), copied(H5T_NATIVE_UINT8), 1, "8-bit unsigned integers", 1};
}
Type type_of(const std::uint32_t& /*value*/, std::size_t /*width*/) {
  return {copied(H5T_STD_U32LE), copied(H5T_NATIVE_UINT32), 4, "32-bit unsigned integers", 4};
}
Type type_of(const std::string& /*value*/, std::size_t width) {
  const std::size_t first = std::min(width, kFirstWidth);
  const std::string upto = first == width ? "" : "up to ";
  return {formats::hdf5::text_type(first), formats::hdf5::text_type(first), first,
          fmt::format("texts of {}{} bytes", upto, width), width};
}
Type type_of(const std::array<std::string, 3>& v, std::size_t width) {
  Type type = type_of(v[0], width);
  type.row = {3};
  return type;
}

/// One column with the rows of one block.
struct Column {
  std::string path;
  Type type;
  Handle dataset{};
  std::size_t created_width = 0;  ///< of the dataset, when it was created
  std::vector<char> rows{};
  std::vector<hsize_t> chunk{};  ///< the shape of those that are read

  [[nodiscard]] bool is_created() const { return dataset >= 0 && created_width == type.size; }

  [[nodiscard]] std::vector<hsize_t> shape(hsize_t height) const {
    std::vector<hsize_t> shape{height};
    shape.insert(shape.end(), type.row.begin(), type.row.end());
    return shape;
  }

  /// Reads or writes `count` rows from `first` on: transfer(dataset, type, memory space, file space, bytes).
  template <class Transfer>
  void transfer(hid_t set, hsize_t first, hsize_t count, Transfer call) {
    const std::vector<hsize_t> size = shape(count);
    std::vector<hsize_t> start(size.size(), 0);
    start[0] = first;
    const Handle memory(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), H5Sclose);
    const Handle file(H5Dget_space(set), H5Sclose);
    checked(H5Sselect_hyperslab(file, H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr));
    checked(call(set, type.memory, memory, file, rows.data()));
  }
  /// Reads rows of this column, or of one with texts of another width.
  void read(hid_t set, hsize_t first, hsize_t count) {
    rows.resize(count * type.across() * type.size);
    transfer(set, first, count, [](hid_t from, hid_t as, hid_t memory, hid_t file, char* bytes) {
      return H5Dread(from, as, memory, file, H5P_DEFAULT, bytes);
    });
  }
  void write(hsize_t first, hsize_t count) {
    transfer(dataset, first, count, [](hid_t to, hid_t as, hid_t memory, hid_t file, const char* bytes) {
      return H5Dwrite(to, as, memory, file, H5P_DEFAULT, bytes);
    });
    rows.clear();
  }

  /// Gives texts in memory more room.
  void widen(std::size_t width) {
    std::vector<char> wider(rows.size() / type.size * width);
    for (std::size_t i = 0; i * type.size < rows.size(); ++i)
      std::copy_n(rows.data() + i * type.size, type.size, wider.data() + i * width);
    rows = std::move(wider);
    type.set_width(width);
  }
};

std::vector<Column> columns_of(const DatasetHeader& header) {
  std::vector<Column> columns;
  Row row(header);
  for_each_column(header, row, [&](std::string_view path, const auto& value, std::size_t width) {
    columns.push_back({std::string(path), type_of(value, width)});
  });
  return columns;
}

std::string group_of(const std::string& path) { return path.substr(0, path.find('/')); }

std::string where_written(const Column& column) { return "/" + column.path; }

/// Puts the values of a row at the ends of the columns.
class Encoder {
 public:
  Encoder(std::vector<Column>& columns, const std::filesystem::path& path, std::uint64_t row)
      : next_(columns.begin()), where_{path.string(), row + 1, true} {}

  void operator()(std::string_view, const double& x, std::size_t) { put(x), ++next_; }
  template <class Vectors>
  void operator()(std::string_view, const Vectors& vectors, std::size_t) {
    for_each_number_in(vectors, [&](double x) { put(x); });
    ++next_;
  }
  void operator()(std::string_view, const bool& x, std::size_t) { next_++->rows.push_back(x ? 1 : 0); }
  void operator()(std::string_view, const std::uint32_t& x, std::size_t) { append(&x, sizeof x), ++next_; }
  void operator()(std::string_view, const std::string& text, std::size_t) { put(text), ++next_; }
  void operator()(std::string_view, const std::array<std::string, 3>& texts, std::size_t) {
    for (const std::string& text : texts) put(text);
    ++next_;
  }

 private:
  void append(const void* bytes, std::size_t size) {
    const char* begin = static_cast<const char*>(bytes);
    next_->rows.insert(next_->rows.end(), begin, begin + size);
  }
  void put(double x) {
    x = std::isnan(x) ? kNone : x == 0 ? 0.0 : x;
    append(&x, sizeof x);
  }
  void put(const std::string& text) {
    const std::size_t widest = next_->type.widest;
    if (text.size() > widest)
      throw formats::InputError(where_, where_written(*next_),
                                fmt::format("at most {} bytes have room, got '{}'", widest, text));
    if (text.size() > next_->type.size) next_->widen(std::min(widest, std::bit_ceil(text.size())));
    append(text.data(), text.size());
    next_->rows.resize(next_->rows.size() + next_->type.size - text.size());
  }

  std::vector<Column>::iterator next_;
  formats::Location where_;
};

/// Gives a row the values that stand at one place of the columns.
class Decoder {
 public:
  Decoder(const std::vector<Column>& columns, std::size_t at, const formats::Location& where)
      : next_(columns.begin()), at_(at), where_(where) {}

  void operator()(std::string_view, double& x, std::size_t) { x = number_at(0), ++next_; }
  template <class Vectors>
  void operator()(std::string_view, Vectors& vectors, std::size_t) {
    std::size_t k = 0;
    for_each_number_in(vectors, [&](double& x) { x = number_at(k++); });
    ++next_;
  }
  void operator()(std::string_view, bool& x, std::size_t) {
    const char byte = *bytes(0);
    if (byte != 0 && byte != 1) refuse(fmt::format("expected 0 or 1, got {}", static_cast<unsigned char>(byte)));
    x = byte == 1;
    ++next_;
  }
  void operator()(std::string_view, std::uint32_t& x, std::size_t) { std::memcpy(&x, bytes(0), sizeof x), ++next_; }
  void operator()(std::string_view, std::string& text, std::size_t) { text = text_at(0), ++next_; }
  void operator()(std::string_view, std::array<std::string, 3>& texts, std::size_t) {
    for (std::size_t axis = 0; axis < 3; ++axis) texts[axis] = text_at(axis);
    ++next_;
  }

 private:
  [[nodiscard]] const char* bytes(std::size_t across) const {
    return next_->rows.data() + (at_ * next_->type.across() + across) * next_->type.size;
  }
  [[nodiscard]] double number_at(std::size_t across) const {
    double x = 0;
    std::memcpy(&x, bytes(across), sizeof x);
    return x == 0 ? 0.0 : x;
  }
  [[nodiscard]] std::string text_at(std::size_t across) const {
    const char* begin = bytes(across);
    const std::size_t size = next_->type.size;
    std::string text(begin, strnlen(begin, size));
    // A column is as wide as its longest text could be, and nearly all of it is padding.
    if (const char* padding = begin + text.size(); text.size() + 1 < size)
      if (std::memcmp(padding, padding + 1, size - text.size() - 1) != 0) refuse("text after the end of the text");
    // Every text of a row is a name or a number: none needs a character that JSON would have to escape.
    if (std::any_of(text.begin(), text.end(), [](char c) { return c <= ' ' || c > '~' || c == '"' || c == '\\'; }))
      refuse("a character that no text here has, in " + formats::json_string(text));
    return text;
  }
  [[noreturn]] void refuse(const std::string& problem) const {
    throw formats::InputError(where_, where_written(*next_), problem);
  }

  std::vector<Column>::const_iterator next_;
  std::size_t at_;
  const formats::Location& where_;
};

class ColumnsWriter : public DatasetWriter {
 public:
  ColumnsWriter(const std::filesystem::path& path, const DatasetHeader& header)
      : path_(path), header_(header), pending_(path) {
    if (!pending_.replaceable()) pending_.fail("columns need a regular file");
    hash_.add(to_line(header_)).add("\n");
    guarded([&] { create(); });
  }

  void write(const Case& c, std::string_view line) override {
    Row row(header_);
    row.c = c;
    if (!c.expect.contact) row.clear_contact();
    if (is_crossing(header_.pair) && !c.exact.crossing) row.c.exact.crossing.emplace();
    row.flags = bits(c);
    for_each_column(header_, row, Encoder(columns_, path_, rows_));
    hash_.add(line).add("\n");
    if (++rows_ % kBlock == 0) guarded([&] { flush(); });
  }

  void commit() override {
    guarded([&] {
      flush();
      formats::hdf5::write_attribute(file_, kDigest, hash_.hex());
      for (Column& column : columns_) column.dataset.close();
      file_.close();
    });
    pending_.commit();
  }

 private:
  template <class Work>
  void guarded(Work work) {
    const Lock lock;
    try {
      work();
    } catch (const formats::hdf5::Error& error) {
      pending_.fail(error.what());
    }
  }

  void create() {
    file_ = formats::hdf5::create_file(pending_.temporary());
    const auto header = nlohmann::json::parse(to_line(header_));
    for (const auto& [key, value] : header.items()) formats::hdf5::write_attribute(file_, key, value);
    std::set<std::string> groups;
    columns_ = columns_of(header_);
    for (const Column& column : columns_)
      if (const std::string group = group_of(column.path); group != column.path && groups.insert(group).second)
        formats::hdf5::create_group(file_, group);
  }

  /// Makes the columns as wide as the rows in memory; those that are in the file already are copied.
  void create_columns() {
    for (Column& column : columns_) {
      if (column.is_created()) continue;
      const Handle narrower = std::move(column.dataset);
      if (narrower >= 0) checked(H5Ldelete(file_, column.path.c_str(), H5P_DEFAULT));
      const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
      checked(H5Pset_obj_track_times(creation, false));
      if (header_.count != 0) {  // what has no rows has no chunks
        const std::vector<hsize_t> chunk = column.shape(std::min(kBlock, header_.count));
        checked(H5Pset_chunk(creation, static_cast<int>(chunk.size()), chunk.data()));
        // Bytes of texts compress as well without, and putting a column's long padding back in order takes long.
        if (!column.type.is_text()) checked(H5Pset_shuffle(creation));
        checked(H5Pset_deflate(creation, kDeflate));
        checked(H5Pset_fletcher32(creation));
      }
      const Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
      checked(H5Pset_chunk_cache(access, 0, 0, 1));  // whole chunks are written, once
      const std::vector<hsize_t> shape = column.shape(header_.count);
      const Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose);
      column.dataset = Handle(
          H5Dcreate2(file_, column.path.c_str(), column.type.file, space, H5P_DEFAULT, creation, access), H5Dclose);
      column.created_width = column.type.size;
      if (column.path == "flags") formats::hdf5::write_attribute(column.dataset, kFlagNames, flag_names());
      if (narrower < 0) continue;
      std::vector<char> rows;
      rows.swap(column.rows);
      for (std::uint64_t first = 0; first < written_; first += kBlock) {
        column.read(narrower, first, kBlock);
        column.write(first, kBlock);
      }
      rows.swap(column.rows);
    }
  }

  static nlohmann::json flag_names() {
    nlohmann::json names = nlohmann::json::array();
    for (const Flag& flag : flags()) names.push_back(flag.name);
    return names;
  }

  [[nodiscard]] std::uint32_t bits(const Case& c) const {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < flags().size(); ++i)
      if (std::find(c.flags.begin(), c.flags.end(), flags()[i].name) != c.flags.end()) bits |= std::uint32_t{1} << i;
    for (const std::string& flag : c.flags)
      if (std::none_of(flags().begin(), flags().end(), [&](const Flag& f) { return f.name == flag; }))
        throw formats::InputError({path_.string(), rows_ + 1, true}, "/flags", "undeclared flag " + flag);
    return bits;
  }

  void flush() {
    create_columns();
    const std::uint64_t count = rows_ - written_;
    if (count == 0) return;
    for (Column& column : columns_) column.write(written_, count);
    written_ = rows_;
  }

  std::filesystem::path path_;
  DatasetHeader header_;
  formats::PendingFile pending_;
  Handle file_;
  std::vector<Column> columns_;
  formats::Sha256 hash_;
  std::uint64_t rows_ = 0;
  std::uint64_t written_ = 0;
};

/// Whether a chunk, whose filters end in deflate or in a checksum behind it, inflates to at most `most` bytes.
bool inflates_within(const Column& column, const std::vector<hsize_t>& at, std::size_t size, std::size_t most) {
  std::vector<unsigned char> stored(size);
  std::uint32_t left_out = 0;
  checked(H5Dread_chunk(column.dataset, H5P_DEFAULT, at.data(), &left_out, stored.data()));
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

/// Work that reads; what HDF5 cannot read is refused with file, row and field.
template <class Work>
auto reading(const formats::Location& where, const std::string& field, Work work) {
  const Lock lock;
  try {
    return work();
  } catch (const formats::hdf5::Error& error) {
    throw formats::InputError(where, field, fmt::format("cannot read: {}", error.what()));
  }
}

class ColumnsSource : public CaseSource {
 public:
  explicit ColumnsSource(const std::filesystem::path& path) : whole_{path.string(), 0} {
    where_ = {path.string(), 0, true};
    const Lock lock;
    file_ = reading(whole_, "", [&] { return formats::hdf5::open_file(path); });
    nlohmann::json attributes = nlohmann::json::object();
    for (const std::string& name : reading(whole_, "", [&] { return formats::hdf5::attribute_names(file_); }))
      attributes[name] = reading(whole_, name, [&] { return formats::hdf5::read_attribute(file_, name); });
    digest_ = formats::Node(attributes, whole_).at(kDigest).text();
    attributes.erase(kDigest);
    header_ = read_header(formats::Node(attributes, whole_));
    columns_ = columns_of(header_);
    check_objects();
    for (Column& column : columns_) reading(whole_, where_written(column), [&] { open(column); });
    text_ = to_line(header_);
    hash_.add(text_).add("\n");
  }

  bool advance() override {
    if (where_.line < header_.count) {
      ++where_.line;
      return true;
    }
    // The digest is of the whole file, so it says nothing where rows were passed over.
    if (hashed_ == header_.count && hash_.hex() != digest_)
      throw formats::InputError(whole_, kDigest,
                                fmt::format("the file says {}, its rows as JSON lines have {}", digest_, hash_.hex()));
    return false;
  }

  Case read() override {
    const std::uint64_t index = where_.line - 1;
    if (index < first_ || index >= first_ + loaded_) load(index / kBlock * kBlock);
    Row row(header_);
    for_each_column(header_, row, Decoder(columns_, index - first_, where_));
    check(row.c);
    if (row.flags >> flag_names_.size() != 0 && flag_names_.size() < kMostFlags)
      throw formats::InputError(where_, "/flags", fmt::format("a bit without a name, in {:#x}", row.flags));
    for (std::size_t i = 0; i < flag_names_.size(); ++i)
      if ((row.flags >> i & 1) != 0) row.c.flags.push_back(flag_names_[i]);
    settle_contact(row.c);
    text_ = to_line(row.c);
    hash_.add(text_).add("\n");
    ++hashed_;
    return std::move(row.c);
  }

 private:
  /// Whether the file holds the groups and columns of such a dataset, and nothing else.
  void check_objects() const {
    std::set<std::string> expected;
    for (const Column& column : columns_) {
      expected.insert(group_of(column.path));
      expected.insert(column.path);
    }
    const std::set<std::string> found = reading(whole_, "", [&] { return formats::hdf5::object_names(file_); });
    for (const std::string& name : expected)
      if (!found.contains(name)) throw formats::InputError(whole_, "/" + name, "missing");
    for (const std::string& name : found) {
      if (!expected.contains(name))
        throw formats::InputError(whole_, "/" + name,
                                  fmt::format("unknown; known here: /{}", fmt::join(expected, ", /")));
      reading(whole_, "/" + name, [&] {
        const Handle object(H5Oopen(file_, name.c_str(), H5P_DEFAULT), H5Oclose);
        for (const std::string& attribute : formats::hdf5::attribute_names(object))
          if (name != "flags" || attribute != kFlagNames)
            throw formats::InputError(whole_, fmt::format("/{}: attribute {}", name, attribute), "unknown");
      });
    }
  }

  void open(Column& column) {
    column.dataset = Handle(H5Dopen2(file_, column.path.c_str(), H5P_DEFAULT), H5Dclose);
    const auto refuse = [&](const std::string& problem) {
      throw formats::InputError(whole_, where_written(column), problem);
    };
    const Handle type(H5Dget_type(column.dataset), H5Tclose);
    if (const std::size_t width = H5Tget_size(type); column.type.grows() && width > 0 && width <= column.type.widest)
      column.type.set_width(width);
    if (checked(H5Tequal(type, column.type.file)) == 0) refuse("expected " + column.type.words);
    const Handle space(H5Dget_space(column.dataset), H5Sclose);
    std::vector<hsize_t> shape(static_cast<std::size_t>(checked(H5Sget_simple_extent_ndims(space))));
    checked(H5Sget_simple_extent_dims(space, shape.data(), nullptr));
    if (shape != column.shape(header_.count))
      refuse(fmt::format("expected a shape of ({}), got ({})", fmt::join(column.shape(header_.count), ", "),
                         fmt::join(shape, ", ")));
    // Such as a part of another file would be.
    const Handle creation(H5Dget_create_plist(column.dataset), H5Pclose);
    if (const H5D_layout_t layout = H5Pget_layout(creation);
        layout != (header_.count == 0 ? H5D_CONTIGUOUS : H5D_CHUNKED) || H5Pget_external_count(creation) != 0)
      refuse("expected chunks in this file");
    if (header_.count != 0) column.chunk = chunk_of(column, creation, refuse);
    if (column.path != "flags") return;
    const nlohmann::json names = formats::hdf5::read_attribute(column.dataset, kFlagNames);
    const formats::Location& where = whole_;
    for (const formats::Node& name : formats::Node(names, where, "/flags: attribute names").items())
      flag_names_.push_back(name.text());
    if (flag_names_.size() > kMostFlags) refuse(fmt::format("more than {} names", kMostFlags));
  }

  /// The shape of a column's chunks. Refuses those that are large, and filters that nobody here knows.
  template <class Refuse>
  static std::vector<hsize_t> chunk_of(const Column& column, hid_t creation, Refuse refuse) {
    std::vector<hsize_t> chunk(column.shape(0).size());
    checked(H5Pget_chunk(creation, static_cast<int>(chunk.size()), chunk.data()));
    hsize_t bytes = column.type.size;
    for (const hsize_t size : chunk) bytes = size > kLargestChunk ? kLargestChunk + 1 : bytes * size;
    if (bytes > kLargestChunk)
      refuse(fmt::format("chunks of ({}), and of more than {} bytes", fmt::join(chunk, ", "), kLargestChunk));
    constexpr std::array kFilters{H5Z_FILTER_SHUFFLE, H5Z_FILTER_DEFLATE, H5Z_FILTER_FLETCHER32};
    auto next = kFilters.begin();
    for (int i = 0; i < checked(H5Pget_nfilters(creation)); ++i) {
      std::size_t none = 0;
      const auto filter =
          checked(H5Pget_filter2(creation, static_cast<unsigned>(i), nullptr, &none, nullptr, 0, nullptr, nullptr));
      next = std::find(next, kFilters.end(), filter);
      if (next == kFilters.end()) refuse("expected no filters but shuffle, deflate and Fletcher-32, in that order");
      ++next;
    }
    return chunk;
  }

  /// Refuses rows that are not stored, which HDF5 would make up, and a chunk that inflates to more than its rows: HDF5
  /// would give it all the memory that it asks for.
  void check_chunks(const Column& column, hsize_t first, hsize_t count) const {
    std::vector<hsize_t> at(column.chunk.size(), 0);
    hsize_t most = column.type.size;
    for (const hsize_t size : column.chunk) most *= size;
    const auto next_in_row = [&] {
      for (std::size_t i = column.type.row.size(); i > 0; --i) {
        if ((at[i] += column.chunk[i]) < column.type.row[i - 1]) return true;
        at[i] = 0;
      }
      return false;
    };
    for (at[0] = first / column.chunk[0] * column.chunk[0]; at[0] < first + count; at[0] += column.chunk[0]) do {
        unsigned left_out = 0;
        haddr_t address = HADDR_UNDEF;
        hsize_t size = 0;
        checked(H5Dget_chunk_info_by_coord(column.dataset, at.data(), &left_out, &address, &size));
        if (address == HADDR_UNDEF)
          throw formats::hdf5::Error(fmt::format("the rows from {} on are not stored", at[0]));
        if (size > 2 * kLargestChunk ||
            (size * kMostDeflated > kLargestInflated && !inflates_within(column, at, size, most)))
          throw formats::hdf5::Error(
              fmt::format("the chunk of the rows from {} on is of more than its {} bytes", at[0], most));
      } while (next_in_row());
  }

  void load(std::uint64_t first) {
    loaded_ = 0;
    const std::uint64_t count = std::min(kBlock, header_.count - first);
    for (Column& column : columns_) {
      reading({where_.file, first + 1, true}, where_written(column), [&] {
        check_chunks(column, first, count);
        column.read(column.dataset, first, count);
      });
    }
    first_ = first;
    loaded_ = count;
  }

  /// A miss has no contact, and its row says so in every column of it.
  void settle_contact(Case& c) const {
    if (!c.rejected && c.expect.hit && has_numbers(header_.pair)) return;
    const Contact& k = *c.expect.contact;
    const auto none = [&](const char* field, bool is_none) {
      if (!is_none) throw formats::InputError(where_, field, "a miss has no contact");
    };
    none("/expect/degenerate", !k.degenerate);
    none("/expect/unique", k.unique);
    none("/expect/normal", k.normal.array().isNaN().all());
    none("/expect/point1", k.point1.array().isNaN().all());
    none("/expect/point2", k.point2.array().isNaN().all());
    none("/expect/value", std::isnan(k.value));
    c.expect.contact.reset();
    if (!c.exact.crossing) return;
    none("/exact/crossing", *c.exact.crossing == std::array<std::string, 3>{});
    c.exact.crossing.reset();
  }

  formats::Location whole_;
  Handle file_;
  std::string digest_;
  std::vector<Column> columns_;
  std::vector<std::string> flag_names_;
  std::uint64_t first_ = 0;
  std::uint64_t loaded_ = 0;
  formats::Sha256 hash_;
  std::uint64_t hashed_ = 0;
};

}  // namespace

bool holds_columns(const std::filesystem::path& path) {
  std::ifstream stream = formats::open_to_read(path, true);
  std::array<char, 8> first{};
  stream.read(first.data(), first.size());
  return formats::hdf5::is_hdf5({first.data(), static_cast<std::size_t>(stream.gcount())});
}

std::unique_ptr<CaseSource> open_columns(const std::filesystem::path& path) {
  return std::make_unique<ColumnsSource>(path);
}

std::unique_ptr<DatasetWriter> create_columns(const std::filesystem::path& path, const DatasetHeader& header) {
  return std::make_unique<ColumnsWriter>(path, header);
}

}  // namespace contact::golden
