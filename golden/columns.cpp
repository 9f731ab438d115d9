// A dataset as columns, HDF5 or .npz: docs/formats.md#columns.
#include "golden/columns.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <exception>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "formats/arrays.hpp"
#include "formats/sha256.hpp"
#include "golden/columns_digest.hpp"
#include "golden/names.hpp"
#include "golden/query_id.hpp"

namespace contact::golden {
namespace {

using formats::ArraysForm;
using formats::ArrayType;
using Kind = ArrayType::Kind;

constexpr std::uint64_t kBlock = formats::kArrayBlock;
constexpr std::size_t kFirstWidth = 32;  // of a column of exact numbers, doubled until its longest text has room
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
const char* const kDigest = "sha256";                 // of the rows as JSON lines
const char* const kColumnsDigest = "columns_sha256";  // of the header and the columns themselves
const char* const kFlagsColumn = "flags";
const char* const kFlagsList = "flags.names";  // of the list, where the digest has it
constexpr std::size_t kMostFlags = 32;

/// Of the longest name of a number of a pair, or of a sphere's.
std::size_t rejected_length(Pair pair) {
  std::size_t longest = std::string_view("a.center[0]").size();
  Query zeros = zero_query(pair);
  for_each_value(zeros, []<class Value>(Value& value) {
    if constexpr (AnyNumberOfVectors<Value>) value.resize(kMostVertices, Vector3::Zero());
  });
  for_each_number(std::as_const(zeros),
                  [&](const std::string& field, double) { longest = std::max(longest, field.size()); });
  return longest;
}

/// A case as a row has it: with a contact, of kNone where there is none, and with the flags as bits.
struct Row {
  Case c;
  std::uint32_t flags = 0;

  explicit Row(const DatasetHeader& h) : c{{}, zero_query(h.pair), {}, {}, {}, {}} {
    if (h.family == kInvalidFamily) c.rejected = "";
    if (is_crossing(h.pair)) c.exact.crossing.emplace();
    if (is_cast(h.pair)) c.exact.cast.emplace();
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
  if constexpr (requires { std::remove_cvref_t<Visit>::kByPlace; })
    for_each_value(c.query, [&](auto& value) { visit("", value, 0); });
  else
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
  if (is_cast(h.pair)) return visit("exact/t", *c.exact.cast, longest_cast(h.scalar));
  if (is_crossing(h.pair)) return visit("exact/crossing", *c.exact.crossing, longest_distance2(h.pair, h.scalar));
  visit("exact/distance2", c.exact.distance2, longest_distance2(h.pair, h.scalar));
  if (has_plane(h.pair))
    visit("exact/below", c.exact.below, 0);
  else if (is_convex(h.pair))
    visit("exact/depth2", c.exact.depth2, longest_distance2(h.pair, h.scalar));
  visit("exact/reach", c.exact.reach, longest_exact(1, h.scalar));
  visit("exact/margin_ulps", c.exact.margin_ulps, 0);
}

/// What the values of a column are, and how wide its texts may become.
struct Type {
  ArrayType array;
  std::size_t widest;

  /// Whether a file has texts as wide as its longest.
  [[nodiscard]] bool grows() const { return array.kind == Kind::text && widest > kFirstWidth; }
  [[nodiscard]] std::string words() const {
    return grows() ? fmt::format("texts of up to {} bytes", widest) : array.words();
  }
};

template <FieldValue Value>
Type type_of(const Value& value, std::size_t /*width*/) {
  return {{Kind::real, sizeof(double), extents_of(value)}, 0};
}
Type type_of(const std::vector<Vector3>& /*value*/, std::size_t /*width*/) {
  return {{Kind::real, sizeof(double), {kMostVertices, 3}}, 0};
}
Type type_of(const bool& /*value*/, std::size_t /*width*/) { return {{Kind::byte, 1}, 0}; }
Type type_of(const std::uint32_t& /*value*/, std::size_t /*width*/) { return {{Kind::bits, sizeof(std::uint32_t)}, 0}; }
Type type_of(const std::string& /*value*/, std::size_t width) {
  return {{Kind::text, std::min(width, kFirstWidth)}, width};
}
template <std::size_t N>
Type type_of(const std::array<std::string, N>& v, std::size_t width) {
  Type type = type_of(v[0], width);
  type.array.row = {N};
  return type;
}

/// One column with the rows of one block.
struct Column {
  std::string path;
  Type type;
  std::vector<char> rows{};
  std::shared_ptr<formats::ArrayReader> reader{};
  std::size_t row_size = 0;  ///< bytes, where it is read

  /// Gives texts in memory more room.
  void widen(std::size_t width) {
    const std::size_t size = type.array.size;
    std::vector<char> wider(rows.size() / size * width);
    for (std::size_t i = 0; i * size < rows.size(); ++i)
      std::copy_n(rows.data() + i * size, size, wider.data() + i * width);
    rows = std::move(wider);
    type.array.size = width;
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

std::vector<std::string> names_of(const std::vector<Column>& columns) {
  std::vector<std::string> names;
  for (const Column& column : columns) names.push_back(column.path);
  return names;
}

std::string where_written(const Column& column) { return "/" + column.path; }

/// Puts the values of a row at the ends of the columns.
class Encoder {
 public:
  Encoder(std::vector<Column>& columns, const std::filesystem::path& path, std::uint64_t row)
      : next_(columns.begin()), where_{path.string(), row + 1, true} {}

  /// No path is asked for, which takes time to make.
  static constexpr bool kByPlace = true;
  void operator()(std::string_view, const double& x, std::size_t) { put(x), ++next_; }
  template <class Vectors>
  void operator()(std::string_view, const Vectors& vectors, std::size_t) {
    for_each_number_in(vectors, [&](double x) { put(x); });
    ++next_;
  }
  /// Rows of kNone behind the last are not there.
  void operator()(std::string_view, const std::vector<Vector3>& vectors, std::size_t) {
    if (vectors.empty() || vectors.size() > kMostVertices || vectors.back().array().isNaN().all())
      throw formats::InputError(
          where_, where_written(*next_),
          fmt::format("expected from 1 to {} points, the last not all NaN, which says here that there is none",
                      kMostVertices));
    for_each_number_in(vectors, [&](double x) { put(x); });
    for (std::size_t k = 3 * vectors.size(); k < 3 * kMostVertices; ++k) put(kNone);
    ++next_;
  }
  void operator()(std::string_view, const bool& x, std::size_t) { next_++->rows.push_back(x ? 1 : 0); }
  void operator()(std::string_view, const std::uint32_t& x, std::size_t) { append(&x, sizeof x), ++next_; }
  void operator()(std::string_view, const std::string& text, std::size_t) { put(text), ++next_; }
  template <std::size_t N>
  void operator()(std::string_view, const std::array<std::string, N>& texts, std::size_t) {
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
    if (text.size() > next_->type.array.size) next_->widen(std::min(widest, std::bit_ceil(text.size())));
    append(text.data(), text.size());
    next_->rows.resize(next_->rows.size() + next_->type.array.size - text.size());
  }

  std::vector<Column>::iterator next_;
  formats::Location where_;
};

/// Gives a row the values that stand at one place of the columns: row `row` behind the `first`, in a message.
class Decoder {
 public:
  Decoder(const std::vector<Column>& columns, std::size_t at, const formats::Location& first, std::uint64_t row)
      : next_(columns.begin()), at_(at), first_(first), row_(row) {}

  static constexpr bool kByPlace = true;
  void operator()(std::string_view, double& x, std::size_t) { x = number_at(0), ++next_; }
  template <class Vectors>
  void operator()(std::string_view, Vectors& vectors, std::size_t) {
    std::size_t k = 0;
    for_each_number_in(vectors, [&](double& x) { x = number_at(k++); });
    ++next_;
  }
  void operator()(std::string_view, std::vector<Vector3>& vectors, std::size_t) {
    std::size_t count = 3 * kMostVertices;
    while (count > 0 && std::isnan(number_at(count - 1))) --count;
    vectors.resize((count + 2) / 3);
    if (vectors.empty()) refuse("expected a point at least, got NaN alone");
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
  template <std::size_t N>
  void operator()(std::string_view, std::array<std::string, N>& texts, std::size_t) {
    for (std::size_t i = 0; i < N; ++i) texts[i] = text_at(i);
    ++next_;
  }

 private:
  [[nodiscard]] const char* bytes(std::size_t across) const {
    return next_->rows.data() + at_ * next_->row_size + across * next_->type.array.size;
  }
  [[nodiscard]] double number_at(std::size_t across) const {
    double x = 0;
    std::memcpy(&x, bytes(across), sizeof x);
    return x == 0 ? 0.0 : x;
  }
  [[nodiscard]] std::string_view text_at(std::size_t across) const {
    const char* begin = bytes(across);
    const std::size_t size = next_->type.array.size;
    const std::string_view text(begin, strnlen(begin, size));
    // A column is as wide as its longest text could be, and nearly all of it is padding.
    if (const char* padding = begin + text.size(); text.size() + 1 < size)
      if (std::memcmp(padding, padding + 1, size - text.size() - 1) != 0) refuse("text after the end of the text");
    // Every text of a row is a name or a number: none needs a character that JSON would have to escape.
    bool strange = false;  // without a way out of the loop it is done for many characters at once
    for (const char c : text) strange |= c <= ' ' || c > '~' || c == '"' || c == '\\';
    if (strange) refuse("a character that no text here has, in " + formats::json_string(text));
    return text;
  }
  [[noreturn]] void refuse(const std::string& problem) const {
    throw formats::InputError({first_.file, first_.line + row_, true}, where_written(*next_), problem);
  }

  std::vector<Column>::const_iterator next_;
  std::size_t at_;
  const formats::Location& first_;
  std::uint64_t row_;
};

nlohmann::json flag_names() {
  nlohmann::json names = nlohmann::json::array();
  for (const Flag& flag : kFlags) names.push_back(flag.name);
  return names;
}

class ColumnsWriter : public DatasetWriter {
 public:
  ColumnsWriter(const std::filesystem::path& path, ArraysForm form, const DatasetHeader& header)
      : path_(path), header_(header), pending_(path), columns_(columns_of(header)), digest_(names_of(columns_)) {
    hash_.add(to_line(header_)).add("\n");
    std::vector<formats::ArraysWriter::Array> arrays;
    for (const Column& column : columns_)
      arrays.push_back({column.path, header_.count, column.path == kFlagsColumn ? flag_names() : nlohmann::json()});
    arrays_ = formats::create_arrays(pending_, form, std::move(arrays));
  }

  void write(const Case& c, std::string_view line) override {
    Row row(header_);
    row.c = c;
    if (!c.expect.contact) row.clear_contact();
    if (is_crossing(header_.pair) && !c.exact.crossing) row.c.exact.crossing.emplace();
    if (is_cast(header_.pair) && !c.exact.cast) row.c.exact.cast.emplace();
    row.flags = bits(c);
    for_each_column(header_, row, Encoder(columns_, path_, rows_));
    hash_.add(line).add("\n");
    if (++rows_ % kBlock == 0) flush();
  }

  void commit() override {
    flush();
    auto header = nlohmann::json::parse(to_line(header_));
    header[kDigest] = hash_.hex();
    header[kColumnsDigest] = digest_.hex(header, {{kFlagsList, flag_names().get<std::vector<std::string>>()}});
    arrays_->finish(header);
    pending_.commit();
  }

 private:
  [[nodiscard]] std::uint32_t bits(const Case& c) const {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < kFlags.size(); ++i)
      if (std::find(c.flags.begin(), c.flags.end(), kFlags[i].name) != c.flags.end()) bits |= std::uint32_t{1} << i;
    for (const std::string& flag : c.flags)
      if (std::none_of(kFlags.begin(), kFlags.end(), [&](const Flag& f) { return f.name == flag; }))
        throw formats::InputError({path_.string(), rows_ + 1, true}, "/flags", "undeclared flag " + flag);
    return bits;
  }

  void flush() {
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      arrays_->append(i, columns_[i].type.array, columns_[i].rows);
      digest_.add(i, columns_[i].type.array, columns_[i].rows);
      columns_[i].rows.clear();
    }
  }

  std::filesystem::path path_;
  DatasetHeader header_;
  formats::PendingFile pending_;
  std::vector<Column> columns_;
  std::unique_ptr<formats::ArraysWriter> arrays_;
  formats::Sha256 hash_;
  ColumnsDigest digest_;
  std::uint64_t rows_ = 0;
};

/// Opens a column of a file. Throws InputError where it is not of its kind and shape.
void open_column(Column& column, formats::ArraysFile& file, std::optional<std::uint64_t> rows,
                 const formats::Location& where) {
  column.reader = file.open(column.path);
  const auto refuse = [&](const std::string& problem) {
    throw formats::InputError(where, where_written(column), problem);
  };
  const ArrayType& found = column.reader->type();
  ArrayType& expected = column.type.array;
  if (found.kind == Kind::text && column.type.grows() && found.size <= column.type.widest) expected.size = found.size;
  if (found.kind != expected.kind || found.size != expected.size) refuse("expected " + column.type.words());
  const std::uint64_t count = rows.value_or(column.reader->rows());
  if (found.row != expected.row || column.reader->rows() != count)
    refuse(fmt::format("expected a shape of {}, got {}", expected.shape_text(count),
                       found.shape_text(column.reader->rows())));
  column.row_size = expected.row_size();
}

/// Rows of a file in memory: what several blocks share.
struct Loaded {
  std::vector<Column> columns;
  const std::vector<std::string>& flag_names;
};

class RowBlock final : public CaseBlock {
 public:
  RowBlock(const DatasetHeader& header, const formats::Location& first, std::uint64_t size,
           std::shared_ptr<const Loaded> loaded, std::size_t at)
      : CaseBlock(header, first, size), loaded_(std::move(loaded)), at_(at) {}

  std::string text(std::uint64_t /*i*/, const Case& c) const override { return to_line(c); }

 private:
  Case parse(std::uint64_t i) const override {
    Row row(header());
    for_each_column(header(), row, Decoder(loaded_->columns, at_ + i, first(), i));
    const std::vector<std::string>& names = loaded_->flag_names;
    if (names.size() < kMostFlags && row.flags >> names.size() != 0)
      throw formats::InputError(where(i), "/flags", fmt::format("a bit without a name, in {:#x}", row.flags));
    for (std::size_t k = 0; k < names.size(); ++k)
      if ((row.flags >> k & 1) != 0) row.c.flags.push_back(names[k]);
    settle_contact(row.c, i);
    return std::move(row.c);
  }

  /// A miss has no contact, and its row says so in every column of it.
  void settle_contact(Case& c, std::uint64_t i) const {
    if (!c.rejected && c.expect.hit && has_numbers(header().pair)) return;
    const Contact& k = *c.expect.contact;
    const auto none = [&](const char* field, bool is_none) {
      if (!is_none) throw formats::InputError(where(i), field, "a miss has no contact");
    };
    none("/expect/degenerate", !k.degenerate);
    none("/expect/unique", k.unique);
    none("/expect/normal", k.normal.array().isNaN().all());
    none("/expect/point1", k.point1.array().isNaN().all());
    none("/expect/point2", k.point2.array().isNaN().all());
    none("/expect/value", std::isnan(k.value));
    c.expect.contact.reset();
    const auto reset = [&](const char* field, auto& texts) {
      if (!texts) return;
      none(field, *texts == std::remove_cvref_t<decltype(*texts)>{});
      texts.reset();
    };
    reset("/exact/crossing", c.exact.crossing);
    reset("/exact/t", c.exact.cast);
  }

  std::shared_ptr<const Loaded> loaded_;
  std::size_t at_;
};

class ColumnsSource final : public CaseSource {
 public:
  ColumnsSource(const std::filesystem::path& path, ArraysForm form)
      : whole_{path.string(), 0}, arrays_(formats::open_arrays(path, form)) {
    file_ = path.string();
    stated_ = arrays_->header();
    digest_ = formats::Node(stated_, whole_).at(kDigest).text();
    if (const auto digest = formats::Node(stated_, whole_).find(kColumnsDigest)) {
      columns_digest_ = digest->text();
      stated_.erase(kColumnsDigest);
    }
    nlohmann::json header = stated_;
    header.erase(kDigest);
    header_ = read_header(formats::Node(header, whole_));
    columns_ = columns_of(header_);
    check_names();
    for (Column& column : columns_) open(column);
    digest_of_columns_.emplace(names_of(columns_));
    for (std::size_t i = 0; i < columns_.size(); ++i) digest_of_columns_->add(i, columns_[i].type.array, {});
    header_text_ = to_line(header_);
    hash_.add(header_text_).add("\n");
  }

  std::unique_ptr<CaseBlock> next(std::uint64_t most) override {
    if (passed_ == header_.count) return nullptr;
    if (!loaded_ || passed_ >= first_ + kBlock) load(passed_ / kBlock * kBlock);
    const std::uint64_t size = std::min({most, header_.count - passed_, first_ + kBlock - passed_});
    auto block = std::make_unique<RowBlock>(header_, formats::Location{file_, passed_ + 1, true}, size, loaded_,
                                            passed_ - first_);
    passed_ += size;
    return block;
  }
  bool skip(std::uint64_t n) override {
    const bool enough = n <= header_.count - passed_;
    passed_ += std::min(n, header_.count - passed_);
    if (loaded_ && passed_ >= first_ + kBlock) loaded_.reset();
    return enough;
  }

  [[nodiscard]] bool wants_texts() const override { return !columns_digest_; }
  [[nodiscard]] bool has_digest_of_texts() const override { return true; }
  void saw(std::string_view text) override {
    hash_.add(text).add("\n");
    ++hashed_;
  }
  void saw_all() override {
    // Either digest is of the whole file, so it says nothing where rows were passed over.
    if (columns_digest_ && added_ == header_.count)
      if (const std::string found = digest_of_columns_->hex(stated_, {{kFlagsList, flag_names_}});
          found != *columns_digest_)
        throw formats::InputError(
            whole_, kColumnsDigest,
            fmt::format("the file says {}, its header and columns have {}", *columns_digest_, found));
    if (hashed_ == header_.count && hash_.hex() != digest_)
      throw formats::InputError(whole_, kDigest,
                                fmt::format("the file says {}, its rows as JSON lines have {}", digest_, hash_.hex()));
  }

 private:
  /// Whether the file holds the groups and columns of such a dataset, and nothing else.
  void check_names() const {
    std::set<std::string> expected;
    for (const Column& column : columns_) {
      expected.insert(formats::group_of(column.path));
      expected.insert(column.path);
    }
    const std::set<std::string> found = arrays_->names();
    for (const std::string& name : expected)
      if (!found.contains(name)) throw formats::InputError(whole_, "/" + name, "missing");
    for (const std::string& name : found)
      if (!expected.contains(name) && name != formats::labelled(kFlagsColumn))
        throw formats::InputError(whole_, "/" + name,
                                  fmt::format("unknown; known here: /{}", fmt::join(expected, ", /")));
  }

  void open(Column& column) {
    open_column(column, *arrays_, header_.count, whole_);
    if (column.path != kFlagsColumn) return;
    const nlohmann::json names = arrays_->labels(column.path);
    const formats::Location& where = whole_;
    for (const formats::Node& name : formats::Node(names, where, "/flags: attribute names").items())
      flag_names_.push_back(name.text());
    if (flag_names_.size() > kMostFlags)
      throw formats::InputError(whole_, where_written(column), fmt::format("more than {} names", kMostFlags));
  }

  void load(std::uint64_t first) {
    // What no block uses any more has its memory already.
    auto used = std::find_if(pool_.begin(), pool_.end(), [](const auto& one) { return one.use_count() == 1; });
    if (used == pool_.end()) used = pool_.insert(used, std::make_shared<Loaded>(Loaded{columns_, flag_names_}));
    std::atomic_thread_fence(std::memory_order_acquire);  // whoever used it has done so
    const std::shared_ptr<Loaded> loaded = *used;
    const std::uint64_t count = std::min(kBlock, header_.count - first);
    const bool in_turn = columns_digest_ && first == added_;
    std::vector<std::exception_ptr> errors(columns_.size());
    const auto read = [&](std::size_t i) {
      try {
        Column& column = loaded->columns[i];
        column.reader->read(first, count, column.rows);
        if (in_turn) digest_of_columns_->add(i, column.type.array, column.rows);
      } catch (...) {
        errors[i] = std::current_exception();
      }
    };
    if (arrays_->reads_in_parallel())
      // Whoever waits here for the other columns takes up nothing else meanwhile.
      tbb::this_task_arena::isolate([&] { tbb::parallel_for(std::size_t{0}, columns_.size(), read); });
    else
      for (std::size_t i = 0; i < columns_.size(); ++i) read(i);
    for (const std::exception_ptr& error : errors)
      if (error) std::rethrow_exception(error);
    if (in_turn) added_ += count;
    loaded_ = loaded;
    first_ = first;
  }

  formats::Location whole_;
  std::unique_ptr<formats::ArraysFile> arrays_;
  nlohmann::json stated_;  ///< the header as it stands there, without the digest of the columns
  std::string digest_;
  std::optional<std::string> columns_digest_;
  std::vector<Column> columns_;  ///< without rows
  std::vector<std::string> flag_names_;
  std::shared_ptr<const Loaded> loaded_;
  std::vector<std::shared_ptr<Loaded>> pool_;  ///< what was loaded, and may be again with other rows
  std::uint64_t first_ = 0;                    ///< row of what is loaded
  std::uint64_t passed_ = 0;                   ///< rows in blocks, or passed over
  formats::Sha256 hash_;
  std::uint64_t hashed_ = 0;
  std::optional<ColumnsDigest> digest_of_columns_;
  std::uint64_t added_ = 0;  ///< rows that are in it
};

/// Calls visit as for_each_column does.
template <class Visit>
void for_each_question_column(PlacedQuestion& question, Visit&& visit) {
  const std::string group = std::string(name(question.query.pair)) + "/";
  visit(group + "id", question.id, kIdLength);
  visit(group + "place", question.place, 0);
  for_each_field(question.query, [&](std::string path, auto& value, FieldKind /*kind*/) {
    std::replace(path.begin(), path.end(), '.', '/');
    visit(group + path, value, 0);
  });
}

std::vector<Column> question_columns(Pair pair) {
  std::vector<Column> columns;
  PlacedQuestion none{"", 0, zero_query(pair)};
  for_each_question_column(none, [&](std::string_view path, const auto& value, std::size_t width) {
    columns.push_back({std::string(path), type_of(value, width)});
  });
  return columns;
}

}  // namespace

void write_questions(const formats::PendingFile& pending, ArraysForm form, const nlohmann::json& header,
                     const std::vector<PlacedQuestion>& questions) {
  std::vector<std::vector<Column>> groups;
  std::vector<formats::ArraysWriter::Array> arrays;
  for (const Pair pair : kPairs) {
    const auto is_here = [&](const PlacedQuestion& one) { return one.query.pair == pair; };
    const auto rows = static_cast<std::uint64_t>(std::count_if(questions.begin(), questions.end(), is_here));
    if (rows == 0) continue;
    groups.push_back(question_columns(pair));
    for (const Column& column : groups.back()) arrays.push_back({column.path, rows});
    std::uint64_t row = 0;
    for (PlacedQuestion one : questions)
      if (is_here(one)) for_each_question_column(one, Encoder(groups.back(), "", row++));
  }
  const auto writer = formats::create_arrays(pending, form, std::move(arrays));
  std::size_t array = 0;
  for (const std::vector<Column>& columns : groups)
    for (const Column& column : columns) writer->append(array++, column.type.array, column.rows);
  writer->finish(header);
}

QuestionColumns read_questions(const std::filesystem::path& path, ArraysForm form) {
  const formats::Location whole{path.string(), 0};
  const auto file = formats::open_arrays(path, form);
  QuestionColumns found{file->header(), {}};
  const std::set<std::string> names = file->names();
  std::set<std::string> known;
  for (const Pair pair : kPairs) {
    if (!names.contains(std::string(name(pair)))) continue;
    known.insert(std::string(name(pair)));
    std::vector<Column> columns = question_columns(pair);
    std::optional<std::uint64_t> rows;
    for (Column& column : columns) {
      if (!names.contains(column.path)) throw formats::InputError(whole, where_written(column), "missing");
      for (std::size_t end = column.path.find('/'); end != std::string::npos; end = column.path.find('/', end + 1))
        known.insert(column.path.substr(0, end));
      known.insert(column.path);
      open_column(column, *file, rows, whole);
      rows = column.reader->rows();
    }
    formats::Location where{path.string(), 0, true};
    for (std::uint64_t first = 0; first < *rows; first += kBlock) {
      const std::uint64_t count = std::min(kBlock, *rows - first);
      for (Column& column : columns) column.reader->read(first, count, column.rows);
      for (std::uint64_t row = 0; row < count; ++row) {
        where.line = first + row + 1;
        PlacedQuestion one{"", 0, zero_query(pair)};
        for_each_question_column(one, Decoder(columns, row, where, 0));
        if (const std::string id = query_id(one.query); id != one.id)
          throw formats::InputError(where, fmt::format("/{}/id", name(pair)),
                                    fmt::format("the question has the id {}, got {}", id, one.id));
        found.questions.push_back(std::move(one));
      }
    }
  }
  for (const std::string& name : names)
    if (!known.contains(name))
      throw formats::InputError(whole, "/" + name, "unknown; an exam has a group for each pair");
  std::sort(found.questions.begin(), found.questions.end(),
            [](const PlacedQuestion& x, const PlacedQuestion& y) { return x.place < y.place; });
  return found;
}

std::unique_ptr<CaseSource> open_columns(const std::filesystem::path& path, ArraysForm form) {
  return std::make_unique<ColumnsSource>(path, form);
}

std::unique_ptr<DatasetWriter> create_columns(const std::filesystem::path& path, ArraysForm form,
                                              const DatasetHeader& header) {
  return std::make_unique<ColumnsWriter>(path, form, header);
}

}  // namespace contact::golden
