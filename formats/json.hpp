// JSON lines, read strictly and written canonically.
#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "contact/geometry.hpp"
#include "formats/input_error.hpp"

namespace contact::formats {

/// The canonical text of a number: the shortest decimal that reads back as the same binary64, integers of magnitude
/// 2^53 and more in scientific form, "NaN", "Infinity" and "-Infinity" as strings, and never -0.
[[nodiscard]] std::string number(double x);
[[nodiscard]] std::string number(const Vector3& v);
void append_number(std::string& text, double x);
void append_number(std::string& text, const Vector3& v);
void append_number(std::string& text, std::span<const Vector3> all);
void append_number(std::string& text, const Quaternion& q);
/// The binary32 number that a decimal was written for, as C++ and JavaScript write one: to as many digits as the decimal
/// has it is the decimal. 14.831459 was written for 14.831459045410156. Nothing where x is itself a binary32 number, or
/// was written for none.
[[nodiscard]] std::optional<double> written_for_binary32(double x);
/// A JSON string, quoted and escaped.
[[nodiscard]] std::string json_string(std::string_view text);

/// A value inside a parsed line that knows where it stands, so that every refusal can name file, line, field and value.
class Node {
 public:
  Node(const nlohmann::json& json, const Location& where, std::string path = "")
      : json_(&json), where_(&where), path_(std::move(path)) {}

  [[nodiscard]] Node at(std::string_view key) const;
  [[nodiscard]] std::optional<Node> find(std::string_view key) const;
  /// Refuses keys that are not among `known`.
  void allow_only(std::initializer_list<std::string_view> known) const {
    allow_only(std::span(known.begin(), known.size()));
  }
  void allow_only(std::span<const std::string_view> known) const;
  [[nodiscard]] const Location& where() const { return *where_; }

  [[nodiscard]] bool is_null() const;
  [[nodiscard]] double number() const;  ///< -0 is read as +0; "NaN", "Infinity" and "-Infinity" are numbers here
  [[nodiscard]] Vector3 vector() const;
  /// As many as there is room for.
  void vectors(std::span<Vector3> all) const;
  /// From one to kMostVertices of them.
  [[nodiscard]] std::vector<Vector3> vectors() const;
  [[nodiscard]] Quaternion quaternion() const;
  [[nodiscard]] bool boolean() const;
  /// What a file or an engine calls something, made visible: nothing in it commands a terminal or breaks a line.
  [[nodiscard]] std::string text() const;
  [[nodiscard]] const std::string& raw_text() const;  ///< as it stands, such as the name of a file to open
  [[nodiscard]] std::uint64_t count() const;
  [[nodiscard]] std::vector<Node> items() const;
  /// An array of rows of `width` finite numbers each; of plain numbers where `width` is 1.
  [[nodiscard]] Eigen::MatrixXd rows(Eigen::Index width) const;
  /// The index of the text among `names`.
  [[nodiscard]] std::size_t one_of(std::span<const std::string_view> names) const;

  [[noreturn]] void refuse(const std::string& problem) const;

 private:
  [[nodiscard]] Node child(const nlohmann::json& json, const std::string& step) const;

  const nlohmann::json* json_;
  const Location* where_;
  std::string path_;
};

/// Opens a file to read; refuses with a message what is not there, no file, or not readable. Files that are read more
/// than once must be `regular`.
[[nodiscard]] std::ifstream open_to_read(const std::filesystem::path& path, bool regular = false);

inline constexpr std::size_t kLongestLine = std::size_t{1} << 20;  ///< bytes; lines here have some thousands
inline constexpr std::size_t kLargestText = std::size_t{1} << 28;  ///< bytes of what is read as a whole, as models are

/// Some lines of a file, one after the other.
struct Lines {
  static constexpr std::size_t kRoom = 64;  ///< bytes that a quick parser may read beyond a line

  std::string text;               ///< with every line feed
  std::vector<std::size_t> ends;  ///< where the line feeds are

  [[nodiscard]] std::string_view line(std::size_t i) const {
    const std::size_t begin = i == 0 ? 0 : ends[i - 1] + 1;
    return std::string_view(text).substr(begin, ends[i] - begin);
  }
};

/// Reads a file of lines, each of which ends in a line feed, the last one too. Throws InputError.
class LineReader {
 public:
  explicit LineReader(const std::filesystem::path& path);
  /// The next lines, at most so many; fewer only at the end of the file.
  [[nodiscard]] Lines next(std::uint64_t most);
  /// How many are behind.
  [[nodiscard]] std::uint64_t passed() const { return passed_; }

 private:
  std::string file_;
  std::ifstream stream_;
  std::string read_;  ///< what was read and not given, from at_ on
  std::size_t at_ = 0;
  std::uint64_t passed_ = 0;
};

/// Reads the next line as std::getline does, and counts it in `where`. A longer one, whose memory nobody could bound,
/// and a device that fails are refused.
[[nodiscard]] bool read_line(std::istream& stream, std::string& line, Location& where,
                             std::size_t longest = kLongestLine);
/// The rest of a stream; refused where it is more than `most` bytes or the device fails.
[[nodiscard]] std::string read_rest(std::istream& stream, const Location& where, std::size_t most = kLargestText);
[[nodiscard]] std::string read_text(const std::filesystem::path& path);

/// Parses one line as a JSON object. Malformed text, a repeated key or nesting deeper than any format here is refused.
[[nodiscard]] nlohmann::json parse_object(std::string_view line, const Location& where);
/// The same of an object with long arrays: each object in an array of its own is given to `take`, with the array's key
/// and its place there, as soon as it is read, and stays only where `take` says so.
using Take = std::function<bool(const std::string& key, std::size_t index, const nlohmann::json& element)>;
[[nodiscard]] nlohmann::json parse_object(std::string_view text, const Location& where, const Take& take);

}  // namespace contact::formats
