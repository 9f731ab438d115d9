// The golden contact file: header, cases, their canonical text, and a strict reader that streams.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/json.hpp"
#include "oracle/truth/expectation.hpp"
#include "oracle/truth/query.hpp"
#include "oracle/truth/witness.hpp"

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

[[nodiscard]] std::string to_line(const DatasetHeader& header);
[[nodiscard]] std::string to_line(const Case& c);
/// The question alone, with its id, pair and scalar: the line that `explain` accepts.
[[nodiscard]] std::string query_line(const Query& query, Scalar scalar);
/// {"id","expect","exact"}, what `explain --json` prints.
[[nodiscard]] std::string answer_line(const Case& c);
/// The bytes of its answer in a digest, golden/answer_bytes.hpp.
[[nodiscard]] std::string digest_bytes(const Case& c);

/// "a":...,"b":...,"alarm":...,"contact":... of a question, and the same read back, whatever its numbers are.
[[nodiscard]] std::string inputs_text(const Query& query);
[[nodiscard]] Query read_inputs(const formats::Node& line, Pair pair);

/// A question from a line that may leave out the pair (radius means sphere_sphere, min and max cube_cube) and the
/// scalar.
struct ReadQuery {
  Query query;
  Scalar scalar;
  /// Numbers of a binary32 question that were written as decimals of binary32 numbers: the question has these.
  std::uint64_t decimals = 0;
};
/// A pair or a scalar by its name.
[[nodiscard]] Pair read_pair(const formats::Node& node);
[[nodiscard]] Scalar read_scalar(const formats::Node& node);

/// The header of a dataset, checked.
[[nodiscard]] DatasetHeader read_header(const formats::Node& node);
/// A line of a dataset, its form checked and no more.
[[nodiscard]] Case read_case(const formats::Node& line, const DatasetHeader& header);
/// The same of its text, behind which formats::Lines::kRoom bytes can be read.
[[nodiscard]] Case read_case(std::string_view line, const DatasetHeader& header, const formats::Location& where);

/// Reads a user's question, a protocol query or a line of a dataset, whose answer is passed over; `file` is the header
/// that tells its pair and scalar.
[[nodiscard]] ReadQuery read_query(const formats::Node& line, const DatasetHeader* file = nullptr);

/// Consecutive cases as a file has them, to be read on any thread.
class CaseBlock {
 public:
  CaseBlock(const DatasetHeader& header, formats::Location first, std::uint64_t size)
      : header_(header), first_(std::move(first)), size_(size) {}
  CaseBlock(const CaseBlock&) = delete;
  CaseBlock& operator=(const CaseBlock&) = delete;
  virtual ~CaseBlock() = default;

  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// Where case i stands.
  [[nodiscard]] formats::Location where(std::uint64_t i) const { return {first_.file, first_.line + i, first_.is_row}; }
  /// Case i. Throws formats::InputError at anything malformed: its form, the id, scalar and domain of its question, and
  /// that its exact numbers are some.
  [[nodiscard]] Case read(std::uint64_t i) const;
  /// Its line, canonical or not, and of columns the canonical one.
  [[nodiscard]] virtual std::string text(std::uint64_t i, const Case& c) const = 0;

 protected:
  [[nodiscard]] virtual Case parse(std::uint64_t i) const = 0;
  [[nodiscard]] const DatasetHeader& header() const { return header_; }
  [[nodiscard]] const formats::Location& first() const { return first_; }

 private:
  const DatasetHeader& header_;
  formats::Location first_;
  std::uint64_t size_;
};

/// The cases of a file, whatever its form. Its blocks are valid as long as it is.
class CaseSource {
 public:
  CaseSource() = default;
  CaseSource(const CaseSource&) = delete;
  CaseSource& operator=(const CaseSource&) = delete;
  virtual ~CaseSource() = default;

  [[nodiscard]] const DatasetHeader& header() const { return header_; }
  [[nodiscard]] const std::string& file() const { return file_; }
  /// The line of the header, as it stands there.
  [[nodiscard]] const std::string& header_text() const { return header_text_; }
  /// Goes on to the next cases, at most so many and no more than the header says; nullptr after the last.
  [[nodiscard]] virtual std::unique_ptr<CaseBlock> next(std::uint64_t most) = 0;
  /// Passes over cases, unread; false where there are not so many.
  [[nodiscard]] virtual bool skip(std::uint64_t n) = 0;
  /// Whether a whole file says something of the texts of its cases, and whether nothing else covers what they say. It
  /// is told each in turn, and the end of them.
  [[nodiscard]] virtual bool has_digest_of_texts() const { return false; }
  [[nodiscard]] virtual bool wants_texts() const { return false; }
  virtual void saw(std::string_view /*text*/) {}
  virtual void saw_all() {}

 protected:
  DatasetHeader header_;
  std::string file_;
  std::string header_text_;
};

/// Questions that were seen, by their ids.
class SeenIds {
 public:
  /// An id as a number, which takes a third of the memory of its text.
  struct Key {
    std::uint64_t first = 0;
    std::uint32_t second = 0;
    bool taken = false;

    Key() = default;
    /// Domain: an id that is right, so 24 hexadecimal digits.
    explicit Key(std::string_view id);
  };

  /// Makes room for so many at once, which costs less than growing to it.
  void expect(std::size_t count);
  /// Whether it is new.
  bool insert(const Key& key);
  /// Says that a key will be inserted soon: memory takes longer to answer than all the rest.
  void prefetch(const Key& key) const { __builtin_prefetch(&keys_[key.first & (keys_.size() - 1)], 1); }

 private:
  /// The place of a key, or the free one where it belongs: its first digits are a digest's, and say where to look.
  [[nodiscard]] static std::size_t place(const std::vector<Key>& keys, const Key& key);
  void make_room(std::size_t places);
  std::vector<Key> keys_ = std::vector<Key>(1024);  ///< a power of two of them, half of them free at least
  std::size_t size_ = 0;
};

/// Whether the generator that a header names makes the question of this id at this place, counted from 0: a generator may
/// repeat itself. Who has the generators gives golden/right_case.hpp's.
using IsMade = bool (*)(const DatasetHeader& header, std::uint64_t index, std::string_view id);

/// Reads a dataset case by case, checking as it goes: form, domain, ids, questions that stand there twice, and at the
/// end the count and the digest. What the expectations say is checked by lint and by certify, against the oracle.
class DatasetReader {
 public:
  DatasetReader(const std::filesystem::path& path, IsMade is_made);

  [[nodiscard]] const DatasetHeader& header() const { return source_->header(); }
  /// The next case, or nothing after the last. Throws formats::InputError at anything malformed.
  [[nodiscard]] std::optional<Case> next();
  /// Passes over the next n cases, or as many as there are, unread: of them only the number is checked.
  void skip(std::uint64_t n);
  /// Where the case that next() gave last stands, and its text; before the first, of the header.
  [[nodiscard]] const formats::Location& where() const { return where_; }
  [[nodiscard]] const std::string& text() const { return text_; }

  /// For readers on many threads: the next cases, at most so many, which any of them may read; nullptr after the last.
  /// Whoever reads them gives each to `accept`, one thread in the order of the file, and then calls `accepted_all`.
  /// Columns have a digest of all texts, one after the other: it is checked where `accept` is given them. Only a file
  /// without a digest of the columns themselves needs that.
  [[nodiscard]] std::unique_ptr<CaseBlock> next_block(std::uint64_t most);
  /// Refuses a question that stood in the file before. `index`: its place in the file, from 0.
  void accept(const Case& c, const SeenIds::Key& key, std::uint64_t index, const CaseBlock& block, std::uint64_t i,
              std::string_view text = {});
  void accepted_all() { source_->saw_all(); }
  [[nodiscard]] bool has_digest_of_texts() const { return source_->has_digest_of_texts(); }
  [[nodiscard]] bool wants_texts() const { return source_->wants_texts(); }
  void prefetch(const SeenIds::Key& key) const { ids_.prefetch(key); }

  /// How many questions stood in the file before, as the family's generator makes them.
  [[nodiscard]] std::uint64_t repeats() const { return repeats_; }

 private:
  IsMade is_made_;
  std::unique_ptr<CaseSource> source_;
  std::unique_ptr<CaseBlock> block_;  ///< of next()
  std::uint64_t in_block_ = 0;
  formats::Location where_;
  std::string text_;
  std::uint64_t passed_ = 0;  ///< cases that are behind, in blocks or not
  std::uint64_t repeats_ = 0;
  SeenIds ids_;
};

/// The header alone, checked.
[[nodiscard]] DatasetHeader dataset_header(const std::filesystem::path& path);

/// A folder of this name holds a selection of its neighbours' cases, for when time is short.
inline constexpr std::string_view kQuickFolder = "quick";

/// The files to read where a command is given files and folders: in a folder every dataset below it in order of name,
/// passing over other formats by their header. A folder `quick` below it would ask the same questions again: it is
/// read where it is given itself, or with `quick_too`.
[[nodiscard]] std::vector<std::filesystem::path> dataset_files(const std::vector<std::filesystem::path>& paths,
                                                               bool quick_too = false);

}  // namespace contact::golden
