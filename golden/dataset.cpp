// The golden contact file: header, cases, their canonical text, and a strict reader that streams.
#include "golden/dataset.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "formats/whole_number.hpp"
#include "golden/answer_bytes.hpp"
#include "golden/columns.hpp"
#include "golden/dataset_writer.hpp"
#include "golden/names.hpp"
#include "golden/query_id.hpp"
#include "golden/quick_case.hpp"

namespace contact::golden {
namespace {

constexpr std::string_view kFormat = "contact-oracle/dataset";
constexpr std::string_view kResultsFormat = "contact-oracle/results";
constexpr std::uint64_t kVersion = 1;
// Repeated questions are looked for in files of up to this many cases; beyond, their ids would not fit in little
// memory.
constexpr std::uint64_t kRepeatsLookedFor = 1'000'000;
// A report has some kilobytes for each file.
constexpr std::size_t kMostFiles = 100'000;

constexpr std::array<std::string_view, 2> kScalarNames{name(Scalar::binary32), name(Scalar::binary64)};

template <AShape Shape>
void append(std::string& text, const Shape& shape) {
  char before = '{';
  for_each_field(shape, [&](const auto& field, const auto& value) {
    text += before;
    text += '"';
    text += field.name;
    text += "\":";
    formats::append_number(text, value);
    before = ',';
  });
  text += '}';
}

void append_inputs(std::string& text, const Query& query) {
  std::visit(
      [&](const auto& shapes) {
        text += R"("a":)";
        append(text, shapes.a);
        text += R"(,"b":)";
        append(text, shapes.b);
      },
      query.shapes);
  text += R"(,"alarm":)";
  formats::append_number(text, query.distances.alarm);
  text += R"(,"contact":)";
  formats::append_number(text, query.distances.contact);
}

void append_expect(std::string& text, const Case& c) {
  if (c.rejected) {
    text += R"({"rejected":)" + formats::json_string(*c.rejected) + '}';
    return;
  }
  text += c.expect.hit ? R"({"hit":true)" : R"({"hit":false)";
  if (c.expect.hit && c.expect.contact) {
    const Contact& k = *c.expect.contact;
    text += k.degenerate ? R"(,"degenerate":true)" : R"(,"degenerate":false)";
    if (!k.unique) text += R"(,"unique":false)";
    text += R"(,"normal":)";
    formats::append_number(text, k.normal);
    text += R"(,"point1":)";
    formats::append_number(text, k.point1);
    text += R"(,"point2":)";
    formats::append_number(text, k.point2);
    text += R"(,"value":)";
    formats::append_number(text, k.value);
  }
  text += '}';
}

void append_exact(std::string& text, const Case& c) {
  const oracle::Witness& w = c.exact;
  if (!c.query.has_numbers()) {
    text += R"({"gap":[")" + w.gap[0] + R"(",")" + w.gap[1] + R"(",")" + w.gap[2] + R"("]})";
    return;
  }
  if (is_cast(c.query.pair)) {
    text += w.cast ? R"({"t":[")" + (*w.cast)[0] + R"(",")" + (*w.cast)[1] + R"("]})" : R"({"t":null})";
    return;
  }
  if (is_crossing(c.query.pair)) {
    if (w.crossing) {
      const auto& [x, y, z] = *w.crossing;
      text += R"({"crossing":[")" + x + R"(",")" + y + R"(",")" + z + R"("]})";
    } else {
      text += R"({"crossing":null})";
    }
    return;
  }
  text += R"({"distance2":")" + w.distance2 + (w.depth2.empty() ? "" : R"(","depth2":")" + w.depth2) +
          (w.below ? R"(","below":true,"reach":")" : R"(","reach":")") + w.reach + R"(","margin_ulps":)";
  formats::append_number(text, w.margin_ulps);
  text += '}';
}

/// "expect":...,"exact":... as both kinds of line end with it.
void append_answer(std::string& text, const Case& c) {
  text += R"("expect":)";
  append_expect(text, c);
  if (!c.rejected) {
    text += R"(,"exact":)";
    append_exact(text, c);
  }
  text += '}';
}

template <AShape Shape>
void read(const formats::Node& node, Shape& shape) {
  node.allow_only(field_names_of(shape));
  for_each_field(shape, [&](const auto& field, auto& value) {
    if constexpr (std::same_as<std::remove_reference_t<decltype(value)>, double>)
      value = node.at(field.name).number();
    else if constexpr (std::same_as<std::remove_reference_t<decltype(value)>, Vector3>)
      value = node.at(field.name).vector();
    else if constexpr (std::same_as<std::remove_reference_t<decltype(value)>, Quaternion>)
      value = node.at(field.name).quaternion();
    else if constexpr (AnyNumberOfVectors<decltype(value)>)
      value = node.at(field.name).vectors();
    else
      node.at(field.name).vectors(value);
  });
}

void check_domain(const Query& query, const formats::Location& where) {
  if (const auto error = outside_domain(query))
    throw formats::InputError(where, error->field,
                              fmt::format("{}, got {}", error->rule, formats::number(error->value)));
}

void check_representable(const Query& query, const formats::Location& where) {
  bool all = true;  // names take time to make
  for_each_number_unnamed(query, [&](double x) { all = all && static_cast<double>(static_cast<float>(x)) == x; });
  if (all) return;
  for_each_number(query, [&](const std::string& field, double x) {
    if (std::isfinite(x) && (std::abs(x) > static_cast<double>(std::numeric_limits<float>::max()) ||
                             static_cast<double>(static_cast<float>(x)) != x))
      throw formats::InputError(where, field,
                                fmt::format("not a binary32 number in a binary32 file, got {}", formats::number(x)));
  });
}

void check_id(const Query& query, const std::string& id, const formats::Location& where) {
  if (const auto digits = query_id_digits(query); id != std::string_view(digits.data(), digits.size()))
    throw formats::InputError(
        where, "id", fmt::format("the id of this question is {}, got {}", query_id(query), formats::json_string(id)));
}

Expectation read_expectation(const formats::Node& node, Pair pair) {
  Expectation expect;
  expect.hit = node.at("hit").boolean();
  if (!expect.hit || !has_numbers(pair)) {
    node.allow_only({"hit"});
    return expect;
  }
  node.allow_only({"hit", "degenerate", "unique", "normal", "point1", "point2", "value"});
  const auto unique = node.find("unique");
  if (unique && unique->boolean()) unique->refuse("only false stands here: without it the nearest points are unique");
  expect.contact = Contact{node.at("normal").vector(), node.at("point1").vector(),      node.at("point2").vector(),
                           node.at("value").number(),  node.at("degenerate").boolean(), !unique};
  return expect;
}

oracle::Witness read_witness(const formats::Node& node, Pair pair) {
  oracle::Witness w;
  const auto read_all = [&](std::string_view key, auto& to) {
    const auto numbers = node.at(key).items();
    if (numbers.size() != to.size())
      node.at(key).refuse(to.size() == 3 ? "expected three exact numbers" : "expected two exact numbers");
    for (std::size_t i = 0; i < to.size(); ++i) to[i] = numbers[i].text();
  };
  if (!has_numbers(pair)) {
    node.allow_only({"gap"});
    read_all("gap", w.gap);
  } else if (is_cast(pair)) {
    node.allow_only({"t"});
    if (!node.at("t").is_null()) read_all("t", w.cast.emplace());
  } else if (is_crossing(pair)) {
    node.allow_only({"crossing"});
    if (!node.at("crossing").is_null()) read_all("crossing", w.crossing.emplace());
  } else {
    if (has_plane(pair))
      node.allow_only({"distance2", "below", "reach", "margin_ulps"});
    else if (is_convex(pair))
      node.allow_only({"distance2", "depth2", "reach", "margin_ulps"});
    else
      node.allow_only({"distance2", "reach", "margin_ulps"});
    const auto below = node.find("below");
    if (below && !below->boolean()) below->refuse("only true stands here: without it nothing is below the plane");
    w = {node.at("distance2").text(), node.at("reach").text(), node.at("margin_ulps").number(), {}, below.has_value()};
    if (const auto depth2 = node.find("depth2")) w.depth2 = depth2->text();
  }
  return w;
}

}  // namespace

std::string inputs_text(const Query& query) {
  std::string text;
  append_inputs(text, query);
  return text;
}

Query read_inputs(const formats::Node& line, Pair pair) {
  const formats::Node a = line.at("a");
  const formats::Node b = line.at("b");
  Query query = zero_query(pair);
  query.distances = {line.at("alarm").number(), line.at("contact").number()};
  std::visit(
      [&](auto& shapes) {
        read(a, shapes.a);
        read(b, shapes.b);
      },
      query.shapes);
  return query;
}

Shard read_shard(const std::string& text, const formats::Location& where, const std::string& option) {
  const std::string_view words = text;
  const std::size_t slash = std::min(words.find('/'), words.size());
  const auto index = formats::whole_number<std::uint64_t>(words.substr(0, slash));
  const auto of = formats::whole_number<std::uint64_t>(words.substr(std::min(slash + 1, words.size())));
  if (!index || !of || *index >= *of)
    throw formats::InputError(where, option, fmt::format("expected I/N with I below N, got '{}'", text));
  return {*index, *of};
}

std::string to_line(const DatasetHeader& h) {
  return fmt::format(
      R"({{"format":"{}","version":{},"pair":"{}","scalar":"{}","family":{},"seed":{},"count":{},"generator":{},"points":"nearest_surface"{}}})",
      kFormat, kVersion, name(h.pair), name(h.scalar), formats::json_string(h.family), h.seed, h.count,
      formats::json_string(h.generator),
      h.shard ? fmt::format(R"(,"shard":[{},{}])", h.shard->index, h.shard->of) : "");
}

std::string to_line(const Case& c) {
  std::string text;
  text.reserve(1024);
  text += R"({"id":")" + c.id + R"(",)";
  append_inputs(text, c.query);
  text += R"(,"flags":[)";
  for (const std::string& flag : c.flags) {
    if (&flag != &c.flags.front()) text += ',';
    text += formats::json_string(flag);
  }
  text += "],";
  append_answer(text, c);
  return text;
}

std::string query_line(const Query& query, Scalar scalar) {
  return fmt::format(R"({{"id":"{}","pair":"{}","scalar":"{}",{}}})", query_id(query), name(query.pair), name(scalar),
                     inputs_text(query));
}

std::string digest_bytes(const Case& c) { return c.rejected ? *c.rejected + '\0' : digest_bytes(c.expect); }

std::string answer_line(const Case& c) {
  std::string text = R"({"id":")" + c.id + R"(",)";
  append_answer(text, c);
  return text;
}

Pair read_pair(const formats::Node& node) { return kPairs[node.one_of(kPairNames)]; }
Scalar read_scalar(const formats::Node& node) { return static_cast<Scalar>(node.one_of(kScalarNames)); }

/// The first pair whose first shape has a field that the question's first shape names; `otherwise` where none does.
Pair pair_by_fields(const formats::Node& line, Pair otherwise) {
  for (const Pair pair : kPairs)
    if (std::visit(
            [&](const auto& shapes) {
              const auto names = field_names_of(shapes.a);
              return std::any_of(names.begin(), names.end(),
                                 [&](auto name) { return line.at("a").find(name).has_value(); });
            },
            description(pair).zeros()))
      return pair;
  return otherwise;
}

ReadQuery read_query(const formats::Node& line, const DatasetHeader* file) {
  // What a case, a protocol message or a worst case carries beside its question is passed over, not guessed at.
  line.allow_only({"id", "pair", "scalar", "a", "b", "alarm", "contact", "flags", "expect", "exact", "op", "seq"});
  Pair pair = file != nullptr ? file->pair : Pair::sphere_sphere;
  if (const auto given = line.find("pair"))
    pair = read_pair(*given);
  else if (file == nullptr)
    pair = pair_by_fields(line, pair);
  const auto scalar = line.find("scalar");
  ReadQuery read{read_inputs(line, pair), scalar            ? read_scalar(*scalar)
                                          : file != nullptr ? file->scalar
                                                            : Scalar::binary64};
  check_domain(read.query, line.where());
  if (read.scalar == Scalar::binary32) {
    // A dataset's numbers are written as binary64, so that every reader reads the same; a person's as whoever wrote it did.
    if (file == nullptr)
      for_each_number(read.query, [&](const std::string&, double& x) {
        if (const auto meant = formats::written_for_binary32(x)) {
          x = *meant;
          ++read.decimals;
        }
      });
    check_representable(read.query, line.where());
  }
  if (const auto id = line.find("id")) check_id(read.query, id->text(), line.where());
  return read;
}

DatasetHeader read_header(const formats::Node& node) {
  DatasetHeader header;
  if (const formats::Node format = node.at("format"); format.text() != kFormat)
    format.refuse(fmt::format("expected \"{}\"", kFormat));
  if (const formats::Node version = node.at("version"); version.count() != kVersion)
    version.refuse(fmt::format("this program reads version {}", kVersion));
  node.allow_only({"format", "version", "pair", "scalar", "family", "seed", "count", "generator", "points", "shard"});
  header.pair = read_pair(node.at("pair"));
  header.scalar = read_scalar(node.at("scalar"));
  header.family = node.at("family").text();
  if (header.family.empty()) node.at("family").refuse("expected a name");
  header.seed = node.at("seed").count();
  header.count = node.at("count").count();
  header.generator = node.at("generator").text();
  if (const formats::Node points = node.at("points"); points.text() != "nearest_surface")
    points.refuse("expected \"nearest_surface\"");
  if (const auto shard = node.find("shard")) {
    const auto parts = shard->items();
    if (parts.size() != 2 || parts[1].count() == 0 || parts[0].count() >= parts[1].count())
      shard->refuse("expected [I,N] with I below N");
    header.shard = Shard{parts[0].count(), parts[1].count()};
  }
  return header;
}

Case read_case(const formats::Node& line, const DatasetHeader& header) {
  line.allow_only({"id", "a", "b", "alarm", "contact", "flags", "expect", "exact"});
  Case c{line.at("id").text(), read_inputs(line, header.pair), {}, {}, std::nullopt, {}};
  for (const formats::Node& flag : line.at("flags").items()) c.flags.push_back(flag.text());
  const formats::Node expect = line.at("expect");
  if (header.family == kInvalidFamily) {
    expect.allow_only({"rejected"});
    c.rejected = expect.at("rejected").text();
  } else {
    if (const auto rejected = expect.find("rejected"))
      rejected->refuse("a question outside the domain stands in a file of the family invalid");
    c.expect = read_expectation(expect, header.pair);
    c.exact = read_witness(line.at("exact"), header.pair);
  }
  return c;
}

Case read_case(std::string_view line, const DatasetHeader& header, const formats::Location& where) {
  if (auto c = quick_case(line, header)) return *std::move(c);
  const auto json = formats::parse_object(line, where);
  return read_case(formats::Node(json, where), header);
}

namespace {

/// What every source asks of a case.
void check_sound(const Case& c, Scalar scalar, const formats::Location& where) {
  if (scalar == Scalar::binary32) check_representable(c.query, where);
  check_id(c.query, c.id, where);
  if (c.rejected) return;
  check_domain(c.query, where);
  const auto exact = [&](const std::string& field, const std::string& text) {
    if (!oracle::is_exact_string(text))
      throw formats::InputError(
          where, "exact." + field,
          fmt::format("expected an exact number such as \"-0x1abdp-12\", got {}", formats::json_string(text)));
  };
  if (is_crossing(c.query.pair)) {
    for (std::size_t axis = 0; c.exact.crossing && axis < 3; ++axis)
      if (c.expect.hit || !(*c.exact.crossing)[axis].empty())  // a column has empty texts for a miss
        exact(fmt::format("crossing[{}]", axis), (*c.exact.crossing)[axis]);
  } else if (is_cast(c.query.pair)) {
    for (std::size_t i = 0; c.exact.cast && i < 2; ++i)
      if (c.expect.hit || !(*c.exact.cast)[i].empty())  // as above
        exact(fmt::format("t[{}]", i), (*c.exact.cast)[i]);
  } else if (c.query.has_numbers()) {
    exact("distance2", c.exact.distance2);
    exact("reach", c.exact.reach);
  } else {
    for (std::size_t axis = 0; axis < 3; ++axis) exact(fmt::format("gap[{}]", axis), c.exact.gap[axis]);
  }
}

/// Whether a case has nothing of what check_sound refuses.
bool is_sound(const Case& c, Scalar scalar) {
  try {
    check_sound(c, scalar, {});
    return true;
  } catch (const formats::InputError&) {
    return false;
  }
}

/// Lines that stand in one text, each with its line feed.
class LineBlock final : public CaseBlock {
 public:
  LineBlock(const DatasetHeader& header, formats::Location first, formats::Lines lines)
      : CaseBlock(header, std::move(first), lines.ends.size()), lines_(std::move(lines)) {
    lines_.text.resize(lines_.text.size() + formats::Lines::kRoom);
  }

  std::string text(std::uint64_t i, const Case& /*c*/) const override { return std::string(lines_.line(i)); }

 private:
  Case parse(std::uint64_t i) const override { return read_case(lines_.line(i), header(), where(i)); }

  formats::Lines lines_;
};

class JsonLines final : public CaseSource {
 public:
  explicit JsonLines(const std::filesystem::path& path) : lines_(path) {
    file_ = path.string();
    const formats::Lines first = lines_.next(1);
    const formats::Location where{file_, 1};
    if (first.ends.empty()) throw formats::InputError({file_, 0}, "", "empty: a dataset begins with its header");
    header_text_ = first.line(0);
    const auto json = formats::parse_object(header_text_, where);
    header_ = read_header(formats::Node(json, where));
  }

  std::unique_ptr<CaseBlock> next(std::uint64_t most) override {
    const formats::Location first{file_, lines_.passed() + 1};
    formats::Lines lines = lines_.next(most);
    if (lines.ends.empty()) return nullptr;
    return std::make_unique<LineBlock>(header_, first, std::move(lines));
  }
  bool skip(std::uint64_t n) override {
    for (; n != 0; --n)
      if (lines_.next(1).ends.empty()) return false;
    return true;
  }

 private:
  formats::LineReader lines_;
};

}  // namespace

Case CaseBlock::read(std::uint64_t i) const {
  Case c = parse(i);
  // Almost every case is sound, and its place takes time to write down.
  if (!is_sound(c, header_.scalar)) check_sound(c, header_.scalar, where(i));
  return c;
}

std::size_t SeenIds::place(const std::vector<Key>& keys, const Key& key) {
  std::size_t at = key.first & (keys.size() - 1);
  while (keys[at].taken && (keys[at].first != key.first || keys[at].second != key.second))
    at = (at + 1) & (keys.size() - 1);
  return at;
}

void SeenIds::make_room(std::size_t places) {
  std::vector<Key> larger(places);
  for (const Key& old : keys_)
    if (old.taken) larger[place(larger, old)] = old;
  keys_ = std::move(larger);
}

void SeenIds::expect(std::size_t count) {
  if (const std::size_t places = std::bit_ceil(2 * count); places > keys_.size()) make_room(places);
}

SeenIds::Key::Key(std::string_view id)
    : first(id_digits(id, 0, 16)), second(static_cast<std::uint32_t>(id_digits(id, 16, 8))), taken(true) {}

bool SeenIds::insert(const Key& key) {
  if (2 * size_ >= keys_.size()) make_room(2 * keys_.size());
  Key& there = keys_[place(keys_, key)];
  if (there.taken) return false;
  there = key;
  ++size_;
  return true;
}

DatasetHeader dataset_header(const std::filesystem::path& path) {
  return DatasetReader(path, [](const DatasetHeader&, std::uint64_t, std::string_view) { return false; }).header();
}

DatasetReader::DatasetReader(const std::filesystem::path& path, IsMade is_made) : is_made_(is_made) {
  if (const auto form = formats::arrays_form(path))
    source_ = open_columns(path, *form);
  else if (const auto named = formats::named_arrays_form(path))
    throw formats::InputError({path.string(), 0}, "",
                              fmt::format("no {} file, or one without its beginning", name(*named)));
  else
    source_ = std::make_unique<JsonLines>(path);
  where_ = {source_->file(), 1};
  text_ = source_->header_text();
}

std::unique_ptr<CaseBlock> DatasetReader::next_block(std::uint64_t most) {
  const std::uint64_t left = header().count - passed_;
  const auto refuse = [&](const std::string& what) {
    throw formats::InputError({source_->file(), 1}, "count",
                              fmt::format("the header says {}, the file holds {}", header().count, what));
  };
  // Behind the last case one is asked for that must not be there.
  auto block = source_->next(left == 0 ? 1 : std::min(most, left));
  if (left == 0 && block) refuse("more cases");
  if (left != 0 && !block) refuse(fmt::format("{} cases", passed_));
  if (block) passed_ += block->size();
  return block;
}

void DatasetReader::skip(std::uint64_t n) {
  n = std::min(n, header().count - passed_);
  if (source_->skip(n))
    passed_ += n;
  else
    throw formats::InputError({source_->file(), 1}, "count",
                              fmt::format("the header says {}, the file holds fewer cases", header().count));
}

std::optional<Case> DatasetReader::next() {
  constexpr std::uint64_t kAtOnce = 64;
  if (!block_ || in_block_ == block_->size()) {
    block_ = next_block(kAtOnce);
    in_block_ = 0;
    if (!block_) {
      accepted_all();
      return std::nullopt;
    }
  }
  const std::uint64_t i = in_block_++;
  where_ = block_->where(i);
  Case c = block_->read(i);
  text_ = block_->text(i, c);
  accept(c, SeenIds::Key(c.id), passed_ - block_->size() + i, *block_, i, text_);
  return c;
}

void DatasetReader::accept(const Case& c, const SeenIds::Key& key, std::uint64_t index, const CaseBlock& block,
                           std::uint64_t i, std::string_view text) {
  if (!text.empty()) source_->saw(text);
  const DatasetHeader& h = header();
  if (c.rejected && !outside_domain(c.query))
    throw formats::InputError(
        block.where(i), "expect.rejected",
        fmt::format("the question is inside the domain, got {}", formats::json_string(*c.rejected)));
  if (h.count > kRepeatsLookedFor) return;
  ids_.expect(h.count);
  if (ids_.insert(key)) return;
  if (!is_made_(h, index, c.id))
    throw formats::InputError(block.where(i), "id",
                              fmt::format("the same question stands in this file twice, got \"{}\"", c.id));
  ++repeats_;
}

namespace {

/// Whether a file is to be read as a dataset: whatever does not say that it is a results file, so that a damaged one is
/// refused, not passed over.
bool is_dataset(const std::filesystem::path& path) {
  try {
    formats::Location where{path.string(), 0};
    std::optional<std::string> text;
    if (const auto form = formats::arrays_form(path)) {
      text = formats::open_arrays(path, *form)->header_text();
    } else {
      std::ifstream stream = formats::open_to_read(path);
      if (!formats::read_line(stream, text.emplace(), where)) return true;
    }
    if (!text) return true;
    const auto header = formats::parse_object(*text, where);
    const auto format = formats::Node(header, where).find("format");
    return !format || format->text() != kResultsFormat;
  } catch (const formats::InputError&) {
    return true;
  }
}

}  // namespace

std::vector<std::filesystem::path> dataset_files(const std::vector<std::filesystem::path>& paths, bool quick_too) {
  std::vector<std::filesystem::path> files;
  for (const auto& path : paths) {
    if (!std::filesystem::exists(path)) throw formats::InputError({path.string(), 0}, "", "no such file or folder");
    if (!std::filesystem::is_directory(path)) {
      files.push_back(path);
      continue;
    }
    std::vector<std::filesystem::path> found;
    for (auto it = std::filesystem::recursive_directory_iterator(path); it != end(it); ++it) {
      const auto& entry = *it;
      if (!quick_too && entry.path().filename() == kQuickFolder) it.disable_recursion_pending();
      // A link that leads nowhere and a pipe are found too: their reader refuses them, and nobody takes the rest for
      // all.
      std::error_code dangling;
      if (!entry.is_directory(dangling) && names_dataset(entry.path()) &&
          (!entry.is_regular_file(dangling) || is_dataset(entry.path())))
        found.push_back(entry.path());
      if (files.size() + found.size() > kMostFiles)
        throw formats::InputError(
            {path.string(), 0}, "",
            fmt::format("more than {} datasets, each with a place in the report; `convert` joins the shards "
                        "of one",
                        kMostFiles));
    }
    if (found.empty())
      throw formats::InputError({path.string(), 0}, "", "no dataset (*.jsonl, *.h5, *.npz) in this folder");
    std::sort(found.begin(), found.end());
    files.insert(files.end(), found.begin(), found.end());
  }
  return files;
}

}  // namespace contact::golden
