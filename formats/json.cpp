// JSON lines, read strictly and written canonically.
#include "formats/json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

namespace contact::formats {
namespace {

constexpr int kDeepest = 8;                  // no format of this project nests deeper
constexpr double kFirstScientific = 0x1p53;  // some readers take longer integers for 64-bit ones
constexpr std::size_t kLongestEcho = 60;     // of a refused value in a message

constexpr std::size_t kLongestProblem = 300;  // of a parser's message, which quotes what it read last

std::string shortened(std::string text, std::size_t longest = kLongestEcho) {
  if (text.size() > longest) text = text.substr(0, longest) + "...";
  return text;
}

}  // namespace

void append_number(std::string& text, double x) {
  if (std::isnan(x)) {
    text += "\"NaN\"";
  } else if (std::isinf(x)) {
    text += x > 0 ? "\"Infinity\"" : "\"-Infinity\"";
  } else if (x == 0) {
    text += '0';
  } else {
    std::array<char, 32> digits{};
    const bool scientific = std::abs(x) >= kFirstScientific;
    const auto end =
        scientific ? std::to_chars(digits.data(), digits.data() + digits.size(), x, std::chars_format::scientific).ptr
                   : std::to_chars(digits.data(), digits.data() + digits.size(), x).ptr;
    text.append(digits.data(), end);
  }
}

namespace {

template <class Elements>
void append_array(std::string& text, const Elements& all) {
  char before = '[';
  for (const auto& each : all) {
    text += before;
    append_number(text, each);
    before = ',';
  }
  text += ']';
}

}  // namespace

void append_number(std::string& text, const Vector3& v) { append_array(text, v); }
void append_number(std::string& text, std::span<const Vector3> all) { append_array(text, all); }
void append_number(std::string& text, const Quaternion& q) { append_array(text, q); }

std::string number(double x) {
  std::string text;
  append_number(text, x);
  return text;
}

std::string number(const Vector3& v) {
  std::string text;
  append_number(text, v);
  return text;
}

std::optional<double> written_for_binary32(double x) {
  constexpr double kFirstThatRoundsToInfinity = 0x1.ffffffp127;
  if (!(std::abs(x) < kFirstThatRoundsToInfinity)) return std::nullopt;
  const auto nearest = static_cast<double>(static_cast<float>(x));
  if (nearest == x) return std::nullopt;
  std::array<char, 32> text;
  const auto write = [&](double number, auto... digits) {
    return std::string_view(
        text.data(),
        std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::scientific, digits...).ptr);
  };
  const std::string_view shortest = write(x);
  const std::string_view significand = shortest.substr(0, shortest.find('e'));
  const auto digits =
      std::count_if(significand.begin(), significand.end(), [](char c) { return c >= '0' && c <= '9'; });
  const std::string_view written = write(nearest, static_cast<int>(digits) - 1);
  double read = 0;
  std::from_chars(written.data(), written.data() + written.size(), read);
  return read == x ? std::optional(nearest) : std::nullopt;
}

std::string json_string(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::ifstream open_to_read(const std::filesystem::path& path, bool regular) {
  const Location where{path.string(), 0};
  using std::filesystem::file_type;
  std::error_code error;
  const file_type type = std::filesystem::status(path, error).type();
  if (type == file_type::not_found) throw InputError(where, "", "cannot read: no such file");
  if (error) throw InputError(where, "", "cannot read: " + error.message());
  if (type == file_type::directory) throw InputError(where, "", "cannot read: it is a directory");
  if (regular && type != file_type::regular)
    throw InputError(where, "", "not a regular file, and it is read more than once");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw InputError(where, "", fmt::format("cannot read: {}", std::strerror(errno)));
  return stream;
}

namespace {

void require_read(const std::istream& stream, const Location& where) {
  if (stream.bad()) throw InputError({where.file, 0}, "", fmt::format("cannot read: {}", std::strerror(errno)));
}

}  // namespace

LineReader::LineReader(const std::filesystem::path& path) : file_(path.string()), stream_(open_to_read(path, true)) {}

Lines LineReader::next(std::uint64_t most) {
  constexpr std::size_t kPiece = std::size_t{1} << 18;
  Lines lines;
  std::size_t from = at_;  // where the next line feed is looked for
  std::size_t begin = at_;
  const auto refuse = [&](const std::string& problem) {
    throw InputError({file_, static_cast<std::size_t>(passed_ + lines.ends.size()) + 1}, "", problem);
  };
  while (lines.ends.size() < most) {
    const auto* feed = static_cast<const char*>(std::memchr(read_.data() + from, '\n', read_.size() - from));
    if (feed != nullptr) {
      const auto end = static_cast<std::size_t>(feed - read_.data());
      if (end - begin > kLongestLine) refuse(fmt::format("a line of more than {} bytes", kLongestLine));
      lines.ends.push_back(end - at_);
      from = begin = end + 1;
      continue;
    }
    if (read_.size() - begin > kLongestLine) refuse(fmt::format("a line of more than {} bytes", kLongestLine));
    // What was given goes, and what follows comes.
    read_.erase(0, at_);
    begin -= at_;
    from = read_.size();
    at_ = 0;
    read_.resize(from + kPiece);
    stream_.read(read_.data() + from, static_cast<std::streamsize>(kPiece));
    read_.resize(from + static_cast<std::size_t>(stream_.gcount()));
    require_read(stream_, {file_, 0});
    if (read_.size() > from) continue;
    if (begin != read_.size()) refuse("the last line has no line feed: the file is truncated");
    break;
  }
  lines.text.reserve(begin - at_ + Lines::kRoom);
  lines.text.assign(read_, at_, begin - at_);
  at_ = begin;
  passed_ += lines.ends.size();
  return lines;
}

bool read_line(std::istream& stream, std::string& line, Location& where, std::size_t longest) {
  std::array<char, 8192> piece;
  line.clear();
  for (bool more = true; more;) {
    stream.getline(piece.data(), piece.size());
    const auto read = static_cast<std::size_t>(stream.gcount());
    const bool ended = stream.good() && read != 0;  // by a line feed, which is counted
    line.append(piece.data(), read - (ended ? 1 : 0));
    if (line.size() > longest)
      throw InputError({where.file, where.line + 1}, "", fmt::format("a line of more than {} bytes", longest));
    more = stream.fail() && !stream.eof() && !stream.bad() && read != 0;
    if (more) stream.clear();
  }
  require_read(stream, where);
  if (stream.eof() && !line.empty()) stream.clear(std::ios::eofbit);
  if (stream.fail()) return false;
  ++where.line;
  return true;
}

std::string read_rest(std::istream& stream, const Location& where, std::size_t most) {
  std::string text;
  std::array<char, 65536> piece;
  while (stream.read(piece.data(), piece.size()) || stream.gcount() > 0) {
    text.append(piece.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() > most) throw InputError(where, "", fmt::format("more than {} bytes", most));
  }
  require_read(stream, where);
  return text;
}

std::string read_text(const std::filesystem::path& path) {
  std::ifstream stream = open_to_read(path);
  return read_rest(stream, {path.string(), 0});
}

namespace {

constexpr int kNumberOverflow = 406;  // the library's error

/// Where the library stops in a line that it does not read to its end: "a.center[2]".
std::string place_of_stop(std::string_view line) {
  struct Level {
    bool is_array = false;
    std::string key;
    std::size_t index = 0;
  };
  std::vector<Level> levels;
  using Event = nlohmann::json::parse_event_t;
  const auto follow = [&](int /*depth*/, Event event, const nlohmann::json& parsed) {
    if (event == Event::object_start || event == Event::array_start) {
      levels.push_back({event == Event::array_start, {}, 0});
    } else if (event == Event::key) {
      levels.back().key = parsed.get<std::string>();
    } else {
      if (event != Event::value) levels.pop_back();
      if (!levels.empty()) ++levels.back().index;
    }
    return true;
  };
  const nlohmann::json ignored = nlohmann::json::parse(line, follow, false);  // its errors are known
  std::string place;
  for (const Level& level : levels)
    place += level.is_array  ? fmt::format("[{}]", level.index)
             : place.empty() ? shortened(level.key)
                             : "." + shortened(level.key);
  return place;
}

}  // namespace

nlohmann::json parse_object(std::string_view line, const Location& where) { return parse_object(line, where, {}); }

nlohmann::json parse_object(std::string_view line, const Location& where, const Take& take) {
  std::vector<std::set<std::string>> open;
  std::string outermost;  // the last key of the object itself
  std::size_t index = 0;  // in the array under it
  const auto check = [&](int depth, nlohmann::json::parse_event_t event, nlohmann::json& parsed) {
    if (depth > kDeepest) throw InputError(where, "", "nested deeper than any format here");
    if (event == nlohmann::json::parse_event_t::object_start) open.emplace_back();
    if (event == nlohmann::json::parse_event_t::object_end) open.pop_back();
    if (event == nlohmann::json::parse_event_t::key && !open.back().insert(parsed.get<std::string>()).second)
      throw InputError(where, shortened(parsed.get<std::string>()), "the key stands twice in one object");
    if (!take) return true;
    if (event == nlohmann::json::parse_event_t::key && depth == 1) {
      outermost = parsed.get<std::string>();
      index = 0;
    }
    // An object at depth 2 stands in an array under that key, or under a key of an object there.
    if (event == nlohmann::json::parse_event_t::object_end && depth == 2 && open.size() == 1)
      return take(outermost, index++, parsed);
    return true;
  };
  // The library takes it for the end.
  if (line.find('\0') != std::string_view::npos) throw InputError(where, "", "malformed JSON: it has a NUL byte");
  try {
    nlohmann::json parsed = nlohmann::json::parse(line, check);
    if (!parsed.is_object()) throw InputError(where, "", "expected a JSON object, got " + shortened(parsed.dump()));
    return parsed;
  } catch (const nlohmann::json::exception& error) {
    const std::string text = shortened(
        error.what(), kLongestProblem);  // "[json.exception.parse_error.101] parse error at ...": the tag is noise
    const auto tag = text.find("] ");
    if (error.id == kNumberOverflow) {
      const std::string number = text.substr(text.find('\'') + 1);  // "number overflow parsing '1e400'"
      throw InputError(where, place_of_stop(line),
                       "expected a number that binary64 has, got " + shortened(number.substr(0, number.find('\''))));
    }
    throw InputError(where, "", "malformed JSON: " + text.substr(tag == std::string::npos ? 0 : tag + 2));
  }
}

Node Node::child(const nlohmann::json& json, const std::string& step) const {
  const std::string& name = step.size() > kLongestEcho ? shortened(step) : step;
  return {json, *where_, name.starts_with('[') || path_.empty() ? path_ + name : path_ + "." + name};
}

Node Node::at(std::string_view key) const {
  if (auto found = find(key)) return *found;
  throw InputError(*where_, path_.empty() ? std::string(key) : path_ + "." + std::string(key), "missing");
}

std::optional<Node> Node::find(std::string_view key) const {
  if (!json_->is_object()) refuse("expected an object");
  const auto it = json_->find(key);
  if (it == json_->end()) return std::nullopt;
  return child(*it, std::string(key));
}

void Node::allow_only(std::span<const std::string_view> known) const {
  if (!json_->is_object()) refuse("expected an object");
  for (const auto& [key, value] : json_->items())
    if (std::find(known.begin(), known.end(), key) == known.end())
      child(value, key).refuse(fmt::format("unknown key; known here: {}", fmt::join(known, ", ")));
}

bool Node::is_null() const { return json_->is_null(); }

double Node::number() const {
  if (json_->is_number()) {
    const double x = json_->get<double>();
    return x == 0 ? 0.0 : x;
  }
  if (json_->is_string()) {
    const auto& text = json_->get_ref<const std::string&>();
    if (text == "NaN") return std::numeric_limits<double>::quiet_NaN();
    if (text == "Infinity") return std::numeric_limits<double>::infinity();
    if (text == "-Infinity") return -std::numeric_limits<double>::infinity();
  }
  refuse("expected a number");
}

Vector3 Node::vector() const {
  if (!json_->is_array() || json_->size() != 3) refuse("expected three numbers");
  const auto parts = items();
  return {parts[0].number(), parts[1].number(), parts[2].number()};
}

void Node::vectors(std::span<Vector3> all) const {
  if (!json_->is_array() || json_->size() != all.size())
    refuse(fmt::format("expected {} points of three numbers each",
                       all.size() == 3 ? "three" : std::to_string(all.size())));
  const auto parts = items();
  std::transform(parts.begin(), parts.end(), all.begin(), [](const Node& part) { return part.vector(); });
}

std::vector<Vector3> Node::vectors() const {
  if (!json_->is_array() || json_->empty() || json_->size() > kMostVertices)
    refuse(fmt::format("expected from 1 to {} points of three numbers each", kMostVertices));
  std::vector<Vector3> all;
  for (const Node& each : items()) all.push_back(each.vector());
  return all;
}

Quaternion Node::quaternion() const {
  if (!json_->is_array() || json_->size() != 4) refuse("expected four numbers, a quaternion x, y, z, w");
  const auto parts = items();
  return {parts[0].number(), parts[1].number(), parts[2].number(), parts[3].number()};
}

bool Node::boolean() const {
  if (!json_->is_boolean()) refuse("expected true or false");
  return json_->get<bool>();
}

std::string Node::text() const { return visible(raw_text()); }

const std::string& Node::raw_text() const {
  if (!json_->is_string()) refuse("expected a string");
  return json_->get_ref<const std::string&>();
}

std::uint64_t Node::count() const {
  if (!json_->is_number_unsigned()) refuse("expected a whole number from 0");
  return json_->get<std::uint64_t>();
}

std::vector<Node> Node::items() const {
  if (!json_->is_array()) refuse("expected an array");
  std::vector<Node> nodes;
  for (std::size_t i = 0; i < json_->size(); ++i) nodes.push_back(child((*json_)[i], fmt::format("[{}]", i)));
  return nodes;
}

Eigen::MatrixXd Node::rows(Eigen::Index width) const {
  if (!json_->is_array()) refuse("expected an array");
  Eigen::MatrixXd numbers(static_cast<Eigen::Index>(json_->size()), width);
  for (std::size_t i = 0; i < json_->size(); ++i) {
    const nlohmann::json& row = (*json_)[i];
    // There may be millions of rows: a path is spelt out only for what is refused.
    const auto here = [&] { return child(row, fmt::format("[{}]", i)); };
    if (width != 1 && (!row.is_array() || row.size() != static_cast<std::size_t>(width)))
      here().refuse(fmt::format("expected {} numbers", width));
    for (Eigen::Index k = 0; k < width; ++k) {
      const nlohmann::json& entry = width == 1 ? row : row[static_cast<std::size_t>(k)];
      if (!entry.is_number())
        (width == 1 ? here() : here().child(entry, fmt::format("[{}]", k))).refuse("expected a finite number");
      numbers(static_cast<Eigen::Index>(i), k) = Node(entry, *where_).number();
    }
  }
  return numbers;
}

std::size_t Node::one_of(std::span<const std::string_view> names) const {
  const auto it = std::find(names.begin(), names.end(), text());
  if (it == names.end()) refuse(fmt::format("expected one of {}", fmt::join(names, ", ")));
  return static_cast<std::size_t>(it - names.begin());
}

void Node::refuse(const std::string& problem) const {
  const std::string value = shortened(json_->dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  throw InputError(*where_, path_, fmt::format("{}, got {}", problem, value));
}

}  // namespace contact::formats
