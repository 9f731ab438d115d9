// Arrays by name in a file of NumPy's: a ZIP archive with an .npy file for each.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <zip.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "formats/arrays.hpp"
#include "formats/input_error.hpp"
#include "formats/json.hpp"
#include "formats/whole_number.hpp"

namespace contact::formats {
namespace {

using Kind = ArrayType::Kind;

static_assert(std::endian::native == std::endian::little, "arrays are written as they are in memory");

constexpr std::string_view kNpy = ".npy";
constexpr std::string_view kMagic = "\x93NUMPY";
constexpr std::size_t kLongestHeader = 65536;  // bytes
constexpr zip_int64_t kMostMembers = 512;      // more than any file here has
constexpr std::string_view kHeaderMember = "header";
constexpr std::string_view kLabelsEnd = ".names";  // behind an array's name: its labels
constexpr std::size_t kCharacter = 4;              // bytes of one in an array of NumPy's `U` texts

std::string message(zip_error_t* error) { return zip_error_strerror(error); }

struct CloseMember {
  void operator()(zip_file_t* member) const { zip_fclose(member); }
};
using Member = std::unique_ptr<zip_file_t, CloseMember>;

/// An archive that is read; members may be read by turns, by one thread at a time.
class Archive {
 public:
  explicit Archive(const std::filesystem::path& path) : where_{path.string(), 0} {
    int code = 0;
    zip_ = zip_open(path.c_str(), ZIP_RDONLY, &code);
    if (zip_ != nullptr) return;
    zip_error_t error;
    zip_error_init_with_code(&error, code);
    const std::string why = message(&error);
    zip_error_fini(&error);
    throw InputError(where_, "", "cannot read: " + why);
  }
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;
  ~Archive() { zip_discard(zip_); }

  [[nodiscard]] const Location& where() const { return where_; }
  /// The names of the arrays.
  [[nodiscard]] std::vector<std::string> arrays() const {
    const zip_int64_t count = zip_get_num_entries(zip_, 0);
    if (count > kMostMembers) throw InputError(where_, "", fmt::format("more than {} members", kMostMembers));
    std::vector<std::string> names;
    for (zip_int64_t i = 0; i < count; ++i) {
      const char* found = zip_get_name(zip_, static_cast<zip_uint64_t>(i), ZIP_FL_ENC_GUESS);
      std::string one = found == nullptr ? "" : found;
      if (!one.ends_with(kNpy)) throw InputError(where_, "/" + one, "is no .npy file");
      one.resize(one.size() - kNpy.size());
      if (std::find(names.begin(), names.end(), one) != names.end())
        throw InputError(where_, "/" + one, "is there twice");
      names.push_back(std::move(one));
    }
    return names;
  }
  [[nodiscard]] zip_stat_t stat(const std::string& name) const {
    zip_stat_t found;
    if (zip_stat(zip_, (name + std::string(kNpy)).c_str(), 0, &found) != 0)
      throw InputError(where_, "/" + name, "missing");
    return found;
  }
  [[nodiscard]] Member open(const std::string& name) const {
    static_cast<void>(stat(name));
    Member member(zip_fopen(zip_, (name + std::string(kNpy)).c_str(), 0));
    if (!member) throw InputError(where_, "/" + name, "cannot read: " + message(zip_get_error(zip_)));
    return member;
  }

 private:
  Location where_;
  zip_t* zip_ = nullptr;
};

/// What the first bytes of an .npy file say.
struct Npy {
  ArrayType type;
  std::vector<std::uint64_t> shape;
  bool is_wide = false;     ///< texts have four bytes a character
  std::size_t rows_at = 0;  ///< where they begin in the file
};

/// The header of an .npy file: a dictionary of Python's of three entries, in any order. Its length is a file's, so it
/// is read from its beginning to its end, with nothing to come back to.
///   {'descr': '<f8', 'fortran_order': False, 'shape': (3, 3), }
class HeaderText {
 public:
  struct Stated {
    std::string_view descr;
    bool by_columns = false;
    std::vector<std::string_view> shape;  ///< digits
  };

  explicit HeaderText(std::string_view text) : rest_(text) {}

  /// Nothing where it is of another form.
  std::optional<Stated> read() {
    Stated stated;
    std::set<std::string_view> keys;
    if (!take("{")) return std::nullopt;
    while (!take("}")) {
      const auto key = quoted();
      if (!key || !keys.insert(*key).second || !take(":")) return std::nullopt;
      if (*key == "descr") {
        const auto descr = quoted();
        if (!descr) return std::nullopt;
        stated.descr = *descr;
      } else if (*key == "fortran_order") {
        stated.by_columns = take("True");
        if (!stated.by_columns && !take("False")) return std::nullopt;
      } else if (*key != "shape" || !read_shape(stated.shape)) {
        return std::nullopt;
      }
      if (take(",")) continue;
      if (!take("}")) return std::nullopt;
      break;
    }
    skip_space();
    return rest_.empty() && keys.size() == 3 ? std::optional(stated) : std::nullopt;
  }

 private:
  void skip_space() { rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\n\r"), rest_.size())); }
  bool take(std::string_view word) {
    skip_space();
    if (!rest_.starts_with(word)) return false;
    rest_.remove_prefix(word.size());
    return true;
  }
  std::string_view before(std::size_t end) {
    const std::string_view text = rest_.substr(0, end);
    rest_.remove_prefix(text.size());
    return text;
  }
  std::optional<std::string_view> quoted() {
    const char quote = take("'") ? '\'' : take("\"") ? '"' : '\0';
    const std::size_t end = rest_.find(quote);
    if (quote == '\0' || end == std::string_view::npos) return std::nullopt;
    const std::string_view text = before(end);
    rest_.remove_prefix(1);
    return text;
  }
  bool read_shape(std::vector<std::string_view>& shape) {
    if (!take("(")) return false;
    while (!take(")")) {
      skip_space();
      shape.push_back(before(rest_.find_first_not_of("0123456789")));
      if (shape.back().empty()) return false;
      static_cast<void>(take("L"));  // as Python 2 wrote it
      if (take(",")) continue;
      return take(")");
    }
    return true;
  }

  std::string_view rest_;
};

/// The length of texts of NumPy's kinds S and U: |S24, <U24.
std::optional<std::size_t> characters(std::string_view descr) {
  constexpr std::size_t kMostDigits = 7;
  if (descr.size() < 3 || descr.size() > 2 + kMostDigits || (descr[0] != '|' && descr[0] != '<') ||
      (descr[1] != 'S' && descr[1] != 'U'))
    return std::nullopt;
  return formats::whole_number<std::size_t>(descr.substr(2));
}

/// A member that is read from its beginning to its end.
class Stream {
 public:
  Stream(const Archive& archive, std::string name) : archive_(archive), name_(std::move(name)) { begin(); }

  [[nodiscard]] std::string field() const { return "/" + name_; }
  [[noreturn]] void refuse(const std::string& problem) const { throw InputError(archive_.where(), field(), problem); }

  void read(char* bytes, std::size_t size) {
    while (size > 0) {
      const zip_int64_t got = zip_fread(member_.get(), bytes, size);
      if (got < 0) refuse("cannot read: " + message(zip_file_get_error(member_.get())));
      if (got == 0) refuse("is truncated");
      bytes += got;
      at_ += static_cast<std::uint64_t>(got);
      size -= static_cast<std::size_t>(got);
    }
  }
  void go_to(std::uint64_t at) {
    if (at == at_) return;
    // Only what is not compressed can be read from anywhere.
    if (archive_.stat(name_).comp_method == ZIP_CM_STORE &&
        zip_fseek(member_.get(), static_cast<zip_int64_t>(at), SEEK_SET) == 0) {
      at_ = at;
      return;
    }
    if (at < at_) begin();
    for (std::vector<char> passed(std::min<std::uint64_t>(at - at_, 1 << 20)); at_ < at;)
      read(passed.data(), std::min<std::uint64_t>(at - at_, passed.size()));
  }
  /// Where all was read in turn the library compares the checksum at the end.
  void end() {
    char none = 0;
    if (zip_fread(member_.get(), &none, 1) < 0) refuse("cannot read: " + message(zip_file_get_error(member_.get())));
  }

  Npy head() {
    constexpr std::size_t kBefore = kMagic.size() + 2;
    std::string first(kBefore, '\0');
    if (archive_.stat(name_).size < kBefore + 4) refuse("is no .npy file");
    read(first.data(), first.size());
    const auto version = static_cast<unsigned char>(first[kMagic.size()]);
    if (!first.starts_with(kMagic) || version < 1 || version > 3) refuse("is no .npy file of version 1 to 3");
    std::array<unsigned char, 4> length{};
    const std::size_t digits = version == 1 ? 2 : 4;
    read(reinterpret_cast<char*>(length.data()), digits);
    std::uint32_t size = 0;
    std::memcpy(&size, length.data(), sizeof size);
    if (size > kLongestHeader || archive_.stat(name_).size < at_ + size) refuse("is no .npy file");
    std::string text(size, '\0');
    read(text.data(), size);
    Npy npy = parsed(text);
    npy.rows_at = at_;
    std::uint64_t bytes = npy.type.size * (npy.is_wide ? kCharacter : 1);
    for (const std::uint64_t n : npy.shape)
      if (__builtin_mul_overflow(bytes, n, &bytes)) refuse("is no .npy file");
    if (const std::uint64_t there = archive_.stat(name_).size; there != npy.rows_at + bytes)
      refuse(fmt::format("has {} bytes, and its rows take {}", there - npy.rows_at, bytes));
    return npy;
  }

 private:
  void begin() {
    member_ = archive_.open(name_);
    at_ = 0;
  }

  Npy parsed(const std::string& text) const {
    const std::optional<HeaderText::Stated> stated = HeaderText(text).read();
    if (!stated) refuse("has a header that is not NumPy's");
    const std::string_view descr = stated->descr;
    const bool by_columns = stated->by_columns;
    Npy npy;
    for (const std::string_view digits : stated->shape) {
      const auto n = formats::whole_number<std::uint64_t>(digits);
      if (!n) refuse("has a shape beyond any memory");
      npy.shape.push_back(*n);
    }
    if (by_columns && npy.shape.size() > 1)
      refuse("is stored by columns (Fortran order): numpy.ascontiguousarray stores it by rows");
    npy.type = {Kind::other, 1, {}};
    if (npy.shape.size() > 1) npy.type.row.assign(npy.shape.begin() + 1, npy.shape.end());
    if (descr == "<f8" || descr == "<f4") {
      npy.type.kind = Kind::real;
      npy.type.size = descr == "<f8" ? sizeof(double) : sizeof(float);
    } else if (descr == "|b1" || descr == "|u1") {
      npy.type.kind = Kind::byte;
    } else if (descr == "<u4") {
      npy.type.kind = Kind::bits;
      npy.type.size = sizeof(std::uint32_t);
    } else if (const auto size = characters(descr)) {
      npy.type.kind = Kind::text;
      npy.is_wide = descr[1] == 'U';
      npy.type.size = *size;
      if (npy.type.size == 0) refuse("has texts of no length");
    } else {
      refuse(
          fmt::format("has values of NumPy's kind '{}'; known here: float64, float32, bool, uint8, uint32, bytes "
                      "and texts, in the order of bytes of this processor",
                      descr));
    }
    return npy;
  }

  const Archive& archive_;
  std::string name_;
  Member member_;
  std::uint64_t at_ = 0;
};

/// `U` texts become bytes; what is not ASCII becomes a byte that no text here has.
void narrow(const std::vector<char>& wide, std::vector<char>& bytes) {
  bytes.resize(wide.size() / kCharacter);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::uint32_t character = 0;
    std::memcpy(&character, wide.data() + i * kCharacter, kCharacter);
    bytes[i] = character < 0x80 ? static_cast<char>(character) : '\x7f';
  }
}

class NpzArray final : public ArrayReader {
 public:
  NpzArray(std::shared_ptr<Archive> archive, std::unique_ptr<Stream> stream, const Npy& npy)
      : ArrayReader(npy.type, npy.shape.front()), archive_(std::move(archive)), stream_(std::move(stream)), npy_(npy) {}

  void read(std::uint64_t first, std::uint64_t count, std::vector<char>& bytes) override {
    const std::size_t row = type().row_size() * (npy_.is_wide ? kCharacter : 1);
    std::vector<char>& into = npy_.is_wide ? wide_ : bytes;
    into.resize(count * row);
    stream_->go_to(npy_.rows_at + first * row);
    stream_->read(into.data(), into.size());
    if (first + count == rows()) stream_->end();
    if (npy_.is_wide) narrow(wide_, bytes);
  }

 private:
  std::shared_ptr<Archive> archive_;  // the stream reads from it
  std::unique_ptr<Stream> stream_;
  Npy npy_;
  std::vector<char> wide_;
};

class NpzFile final : public ArraysFile {
 public:
  explicit NpzFile(const std::filesystem::path& path) : archive_(std::make_shared<Archive>(path)) {
    for (const std::string& one : archive_->arrays()) arrays_.insert(one);
  }

  nlohmann::json header() override {
    const auto text = header_text();
    if (!text) throw InputError(archive_->where(), "/" + std::string(kHeaderMember), "missing");
    return parse_object(*text, {archive_->where().file, 0});
  }

  std::optional<std::string> header_text() override {
    if (!arrays_.contains(std::string(kHeaderMember))) return std::nullopt;
    const auto texts = texts_of(std::string(kHeaderMember));
    if (texts.size() != 1) throw InputError(archive_->where(), "/" + std::string(kHeaderMember), "expected one text");
    return texts.front();
  }

  std::set<std::string> names() override {
    std::set<std::string> all;
    for (const std::string& one : arrays_) {
      if (one == kHeaderMember) continue;
      for (std::size_t end = one.find('/'); end != std::string::npos; end = one.find('/', end + 1))
        all.insert(one.substr(0, end));
      all.insert(one.ends_with(kLabelsEnd) ? labelled(one.substr(0, one.size() - kLabelsEnd.size())) : one);
    }
    return all;
  }

  nlohmann::json labels(const std::string& one) override { return texts_of(one + std::string(kLabelsEnd)); }

  std::unique_ptr<ArrayReader> open(const std::string& one) override {
    auto stream = std::make_unique<Stream>(*archive_, one);
    const Npy npy = stream->head();
    if (npy.shape.empty()) stream->refuse("expected rows, got one value");
    return std::make_unique<NpzArray>(archive_, std::move(stream), npy);
  }

 private:
  /// A short array of texts, or one.
  std::vector<std::string> texts_of(const std::string& one) const {
    Stream stream(*archive_, one);
    const Npy npy = stream.head();
    std::uint64_t count = 1;
    for (const std::uint64_t n : npy.shape) count *= n;
    if (npy.type.kind != Kind::text || npy.shape.size() > 1 || count > kLongestHeader ||
        count * npy.type.size > kLongestHeader)
      stream.refuse("expected a text or a short list of texts");
    std::vector<char> bytes(count * npy.type.size * (npy.is_wide ? kCharacter : 1));
    stream.read(bytes.data(), bytes.size());
    stream.end();
    if (npy.is_wide) narrow(std::vector<char>(bytes), bytes);
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < count; ++i)
      texts.emplace_back(bytes.data() + i * npy.type.size, strnlen(bytes.data() + i * npy.type.size, npy.type.size));
    return texts;
  }

  std::shared_ptr<Archive> archive_;
  std::set<std::string> arrays_;
};

constexpr std::size_t kFewNumbers = 9;  // in a row: what has more is mostly padding, and is deflated as texts are
constexpr std::size_t kHead = 256;      // bytes of the beginning of every .npy file that is written

/// It: the widest type and shape have room.
std::string npy_head(std::string_view descr, const std::vector<std::uint64_t>& shape) {
  std::string dictionary = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}{}), }}", descr,
                                       fmt::join(shape, ", "), shape.size() == 1 ? "," : "");
  constexpr std::size_t kDictionary = kHead - kMagic.size() - 4;
  dictionary.resize(kDictionary - 1, ' ');
  return fmt::format("{}{}{}{}\n", kMagic, std::string_view("\x01\x00", 2),
                     std::string{static_cast<char>(kDictionary & 0xff), static_cast<char>(kDictionary >> 8)},
                     dictionary);
}

std::string descr_of(const ArrayType& type) {
  switch (type.kind) {
    case Kind::real:
      return type.size == sizeof(double) ? "<f8" : "<f4";
    case Kind::byte:
      return "|u1";
    case Kind::bits:
      return "<u4";
    default:
      return fmt::format("|S{}", type.size);
  }
}

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// Rows of different arrays come by turns, and a ZIP archive has one member behind the other: each array waits in a
/// file without a name beside the archive.
class NpzWriter final : public ArraysWriter {
 public:
  NpzWriter(const PendingFile& pending, std::vector<Array> arrays) : pending_(pending) {
    for (Array& array : arrays) waiting_.push_back({std::move(array)});
  }

  void append(std::size_t array, const ArrayType& type, const std::vector<char>& rows) override {
    Waiting& one = waiting_[array];
    if (!one.rows) one.rows = nameless();
    if (one.written != 0 && one.type != type) widen(one, type);
    one.type = type;
    put(one.rows.get(), rows.data(), rows.size());
    one.written += rows.size() / type.row_size();
  }

  void finish(const nlohmann::json& header) override {
    int code = 0;
    zip_t* zip = zip_open(pending_.temporary().c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code);
    if (zip == nullptr) pending_.fail(std::strerror(errno));
    const auto require = [&](bool good) {
      if (good) return;
      const std::string why = message(zip_get_error(zip));
      zip_discard(zip);
      pending_.fail(why);
    };
    std::vector<std::string> kept;  // what the archive is made from when it is closed
    kept.reserve(2 * waiting_.size() + 1);
    const auto add = [&](const std::string& name, zip_source_t* source, bool compress) {
      const zip_int64_t index = zip_file_add(zip, (name + std::string(kNpy)).c_str(), source, ZIP_FL_ENC_UTF_8);
      if (index < 0) zip_source_free(source);
      require(index >= 0);
      const auto at = static_cast<zip_uint64_t>(index);
      require(zip_set_file_compression(zip, at, compress ? ZIP_CM_DEFLATE : ZIP_CM_STORE, 1) == 0);
      constexpr zip_uint16_t kFirstDay = 1 << 5 | 1;  // 1980-01-01: the same bytes on any day
      require(zip_file_set_dostime(zip, at, 0, kFirstDay, 0) == 0);
    };
    const auto add_texts = [&](const std::string& name, const std::vector<std::string>& texts, bool list) {
      std::size_t width = 1;
      for (const std::string& text : texts) width = std::max(width, text.size());
      std::string bytes = npy_head(fmt::format("|S{}", width),
                                   list ? std::vector<std::uint64_t>{texts.size()} : std::vector<std::uint64_t>{});
      for (const std::string& text : texts) bytes.append(text).append(width - text.size(), '\0');
      kept.push_back(std::move(bytes));
      add(name, zip_source_buffer(zip, kept.back().data(), kept.back().size(), 0), true);
    };
    add_texts(std::string(kHeaderMember), {header.dump()}, false);
    for (Waiting& one : waiting_) {
      const std::string head = npy_head(descr_of(one.type), one.type.shape(one.written));
      std::rewind(one.rows.get());
      put(one.rows.get(), head.data(), head.size());
      if (std::fflush(one.rows.get()) != 0) pending_.fail(std::strerror(errno));
      std::rewind(one.rows.get());  // the library reads from where the file stands
      zip_source_t* source = zip_source_filep(zip, one.rows.get(), 0, -1);
      require(source != nullptr);
      static_cast<void>(one.rows.release());  // the archive closes it
      add(one.array.name, source, one.type.kind == Kind::text || one.type.across() > kFewNumbers);
      if (!one.array.labels.empty())
        add_texts(one.array.name + std::string(kLabelsEnd), one.array.labels.get<std::vector<std::string>>(), true);
    }
    require(zip_close(zip) == 0);
    // The library has put another file in the temporary's place.
    const int descriptor = ::open(pending_.temporary().c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0 || ::fsync(descriptor) != 0) pending_.fail(std::strerror(errno));
    ::close(descriptor);
  }

 private:
  struct Waiting {
    Array array;
    ArrayType type{};
    File rows{};
    std::uint64_t written = 0;
  };

  [[nodiscard]] File nameless() const {
    const std::string name = pending_.temporary().string() + ".rows";
    const int descriptor = ::open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (descriptor < 0) pending_.fail(std::strerror(errno));
    ::unlink(name.c_str());
    File file(::fdopen(descriptor, "w+b"));
    if (!file) pending_.fail(std::strerror(errno));
    const std::string room(kHead, '\0');  // the shape is known already, and not how wide texts become
    put(file.get(), room.data(), room.size());
    return file;
  }
  void put(std::FILE* file, const char* bytes, std::size_t size) const {
    if (std::fwrite(bytes, 1, size, file) != size) pending_.fail(std::strerror(errno));
  }
  void widen(Waiting& one, const ArrayType& type) const {
    if (std::fflush(one.rows.get()) != 0) pending_.fail(std::strerror(errno));
    if (std::fseek(one.rows.get(), kHead, SEEK_SET) != 0) pending_.fail(std::strerror(errno));
    File wider = nameless();
    std::vector<char> text(one.type.size);
    std::vector<char> padded(type.size);
    while (std::fread(text.data(), 1, text.size(), one.rows.get()) == text.size()) {
      std::copy(text.begin(), text.end(), padded.begin());
      put(wider.get(), padded.data(), padded.size());
    }
    one.rows = std::move(wider);
  }

  const PendingFile& pending_;
  std::vector<Waiting> waiting_;
};

}  // namespace

std::unique_ptr<ArraysFile> open_npz(const std::filesystem::path& path) { return std::make_unique<NpzFile>(path); }

std::unique_ptr<ArraysWriter> create_npz(const PendingFile& pending, std::vector<ArraysWriter::Array> arrays) {
  return std::make_unique<NpzWriter>(pending, std::move(arrays));
}

}  // namespace contact::formats
