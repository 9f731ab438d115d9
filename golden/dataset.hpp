// The golden contact file: header, cases, their canonical text, and a strict reader that streams.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <memory_resource>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "formats/json.hpp"
#include "oracle/truth/expectation.hpp"
#include "oracle/truth/query.hpp"
#include "oracle/truth/truth.hpp"

namespace contact::golden {

/// What writes these files; part of every header, so a change to the generator changes it.
inline constexpr std::string_view kGenerator = "contact-oracle 0.1.0";

struct Shard {
  std::uint64_t index;
  std::uint64_t of;
};
/// A shard from I/N. Throws formats::InputError naming the option.
[[nodiscard]] Shard read_shard(const std::string& text, const formats::Location& where, const std::string& option);

/// Part `index` of `of` of `count` questions begins with the question cut(count, index, of) and ends before the next
/// cut.
[[nodiscard]] constexpr std::uint64_t cut(std::uint64_t count, std::uint64_t index, std::uint64_t of) {
  return count / of * index + count % of * index / of;
}

struct DatasetHeader {
  Pair pair = Pair::sphere_sphere;
  Scalar scalar = Scalar::binary64;
  std::string family;
  std::uint64_t seed = 0;
  std::uint64_t count = 0;  ///< cases in this file
  std::string generator = std::string(kGenerator);
  std::optional<Shard> shard;
};

/// One line of a dataset: a question, why it is there, and its answer with exact witnesses.
struct Case {
  std::string id;
  Query query;
  std::vector<std::string> flags;
  Expectation expect;
  std::optional<std::string> rejected;  ///< the field that puts the question outside the domain, instead of expect
  oracle::Witness exact;
};

/// The case of a question: id, flags, expectation and witnesses, all from the exact oracle.
[[nodiscard]] Case make_case(const Query& query, Scalar scalar);

[[nodiscard]] std::string to_line(const DatasetHeader& header);
[[nodiscard]] std::string to_line(const Case& c);
/// The question alone, with its id, pair and scalar: the line that `explain` accepts.
[[nodiscard]] std::string query_line(const Query& query, Scalar scalar);
/// {"id","expect","exact"}, what `explain --json` prints.
[[nodiscard]] std::string answer_line(const Case& c);

/// "a":...,"b":...,"alarm":...,"contact":... of a question, and the same read back, whatever its numbers are.
[[nodiscard]] std::string inputs_text(const Query& query);
[[nodiscard]] Query read_inputs(const formats::Node& line, Pair pair);

/// A question from a line that may leave out the pair (radius means sphere_sphere, min and max cube_cube) and the
/// scalar.
struct ReadQuery {
  Query query;
  Scalar scalar;
};
/// A pair or a scalar by its name.
[[nodiscard]] Pair read_pair(const formats::Node& node);
[[nodiscard]] Scalar read_scalar(const formats::Node& node);

/// The header of a dataset, checked.
[[nodiscard]] DatasetHeader read_header(const formats::Node& node);
/// A line of a dataset, its form checked and no more.
[[nodiscard]] Case read_case(const formats::Node& line, const DatasetHeader& header);

/// Reads a user's question, a protocol query or a line of a dataset, whose answer is passed over; `file` is the header
/// that tells its pair and scalar.
[[nodiscard]] ReadQuery read_query(const formats::Node& line, const DatasetHeader* file = nullptr);

/// The cases of a file, whatever its form.
class CaseSource {
 public:
  CaseSource() = default;
  CaseSource(const CaseSource&) = delete;
  CaseSource& operator=(const CaseSource&) = delete;
  virtual ~CaseSource() = default;

  /// Goes on to the next case, unread; false after the last.
  [[nodiscard]] virtual bool advance() = 0;
  /// The case gone to. At most once a case.
  [[nodiscard]] virtual Case read() = 0;

  [[nodiscard]] const DatasetHeader& header() const { return header_; }
  [[nodiscard]] const formats::Location& where() const { return where_; }
  [[nodiscard]] const std::string& text() const { return text_; }

 protected:
  /// What every source asks of a case: the id, scalar and domain of its question, and that its exact numbers are some.
  void check(const Case& c) const;

  DatasetHeader header_;
  formats::Location where_;
  std::string text_;
};

/// Reads a dataset case by case, checking as it goes: form, domain, ids, questions that stand there twice, and at the
/// end the count. What the expectations say is checked by lint and by certify, against the oracle.
class DatasetReader {
 public:
  explicit DatasetReader(const std::filesystem::path& path);

  [[nodiscard]] const DatasetHeader& header() const { return source_->header(); }
  /// The next case, or nothing after the last. Throws formats::InputError at anything malformed.
  [[nodiscard]] std::optional<Case> next();
  /// Passes over the next n cases, or as many as there are, unread: of them only the number is checked.
  void skip(std::uint64_t n);
  /// Where the case that next() gave last stands, and its text.
  [[nodiscard]] const formats::Location& where() const { return source_->where(); }
  [[nodiscard]] const std::string& text() const { return source_->text(); }

  /// How many questions stood in the file before, as the family's generator makes them.
  [[nodiscard]] std::uint64_t repeats() const { return repeats_; }

  /// Whether a file is to be read as a dataset: whatever does not say that it is a results file.
  [[nodiscard]] static bool is_dataset(const std::filesystem::path& path);

 private:
  [[nodiscard]] bool advance();
  void check(const Case& c);

  std::unique_ptr<CaseSource> source_;
  std::uint64_t passed_ = 0;
  std::uint64_t repeats_ = 0;
  /// An id as a number, which takes a third of the memory of its text.
  struct Key {
    std::uint64_t first;
    std::uint32_t second;

    friend bool operator==(const Key&, const Key&) = default;
  };
  struct Hash {
    std::size_t operator()(const Key& key) const noexcept {
      return static_cast<std::size_t>(key.first);
    }  // SHA-256's digits
  };
  [[nodiscard]] static Key key_of(const std::string& id);
  std::unique_ptr<std::pmr::monotonic_buffer_resource> memory_ =
      std::make_unique<std::pmr::monotonic_buffer_resource>();  // a million small allocations would take longer
  std::pmr::unordered_set<Key, Hash> ids_{memory_.get()};
};

/// A folder of this name holds a selection of its neighbours' cases, for when time is short.
inline constexpr std::string_view kQuickFolder = "quick";

/// The files to read where a command is given files and folders: in a folder every dataset below it in order of name,
/// passing over other formats by their header. A folder `quick` below it would ask the same questions again: it is
/// read where it is given itself, or with `quick_too`.
[[nodiscard]] std::vector<std::filesystem::path> dataset_files(const std::vector<std::filesystem::path>& paths,
                                                               bool quick_too = false);

/// Compares what a case of the family `invalid` says with the first field outside the domain. Throws InputError.
void check_rejection(const Case& c, const formats::Location& where);

/// Whether a case says this answer and these exact numbers, word for word.
[[nodiscard]] bool says(const Case& c, const Expectation& right, const oracle::Witness& exact);

/// Compares a case with what the oracle says. Throws formats::InputError naming the field, the value found and the
/// right one.
void check_case(const Case& c, Scalar scalar, const oracle::Truth& truth, const formats::Location& where);

}  // namespace contact::golden
