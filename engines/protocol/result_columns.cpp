// Answers as columns, HDF5 or NumPy's .npz.
#include "engines/protocol/result_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "golden/query_id.hpp"

namespace contact::engines {
namespace {

using formats::ArrayType;
using formats::InputError;
using Kind = ArrayType::Kind;

/// A column that such a file may have.
struct Known {
  std::string_view name;
  Kind kind;
  std::size_t across;
  std::optional<Aspect> number;  ///< of a contact
  bool is_list = false;          ///< several in a row; what is not there is NaN, at the end
};
constexpr std::array kKnown{
    Known{"id", Kind::text, 1, {}},
    Known{"hit", Kind::byte, 1, {}},
    Known{"overlap", Kind::byte, 1, {}},
    Known{"contact", Kind::byte, 1, {}},
    Known{"unsupported", Kind::byte, 1, {}},
    Known{"degenerate", Kind::byte, 1, {}},  // Production's contacts have it, and it claims nothing.
    Known{"normal", Kind::real, 3, Aspect::normal},
    Known{"point1", Kind::real, 3, Aspect::point1},
    Known{"point2", Kind::real, 3, Aspect::point2},
    Known{"point", Kind::real, 3, Aspect::point},
    Known{"points", Kind::real, 3, Aspect::points, true},
    Known{"depths", Kind::real, 1, Aspect::points, true},
    Known{"value", Kind::real, 1, Aspect::value},
};
constexpr std::size_t kBlocks = 3;  // the engine's threads ask for rows of two that stand side by side

}  // namespace

ResultColumns::ResultColumns(const std::filesystem::path& path, formats::ArraysForm form)
    : ResultColumns(path, formats::open_arrays(path, form)) {}

ResultColumns::ResultColumns(const std::filesystem::path& path, std::unique_ptr<formats::ArraysFile> arrays)
    : path_(path.string()), file_(std::move(arrays)) {
  const formats::Location whole{path_, 0};
  const auto refuse = [&](const std::string& name, const std::string& problem) {
    throw InputError(whole, "/" + name, problem);
  };
  std::vector<std::string_view> names;
  for (const Known& known : kKnown) names.push_back(known.name);
  for (const std::string& name : file_->names()) {
    if (name.find(": attribute ") != std::string::npos) continue;  // a unit, a scale: whoever writes columns has some
    const auto known = std::find_if(kKnown.begin(), kKnown.end(), [&](const Known& one) { return one.name == name; });
    if (known == kKnown.end())
      refuse(name, fmt::format("unknown; answers have the columns {}", fmt::join(names, ", ")));
    auto reader = file_->open(name);
    const ArrayType& type = reader->type();
    if (type.kind != known->kind)
      refuse(name, fmt::format("expected {}, got {}",
                               known->kind == Kind::real   ? "64-bit or 32-bit IEEE numbers"
                               : known->kind == Kind::byte ? "truth values"
                                                           : "texts",
                               type.words()));
    ArrayType expected = type;
    expected.row.assign(known->across == 1 ? 0 : 1, known->across);
    if (known->is_list) {
      const std::size_t most = type.row.empty() ? 1 : std::clamp<std::size_t>(type.row[0], 1, kMostPoints);
      if (most_points_ != 0 && most != most_points_)
        refuse(name, fmt::format("has {} a row, and the other of points and depths has {}", most, most_points_));
      most_points_ = most;
      expected.row.insert(expected.row.begin(), most);
    }
    if (type.row != expected.row)
      refuse(name, fmt::format("expected a shape of {}, got {}", expected.shape_text(reader->rows()),
                               type.shape_text(reader->rows())));
    if (known->kind == Kind::text && type.size != golden::kIdLength)
      refuse(name, fmt::format("expected texts of {} bytes, got {}", golden::kIdLength, type.size));
    if (!columns_.empty() && reader->rows() != rows_)
      refuse(name, fmt::format("has {} rows, and {} has {}", reader->rows(), columns_.front().name, rows_));
    rows_ = reader->rows();
    columns_.push_back({name, std::move(reader)});
  }
  if (columns_.empty()) throw InputError(whole, "", fmt::format("no column; answers have {}", fmt::join(names, ", ")));
  engine_ = read_engine(path);
}

const ResultColumns::Column* ResultColumns::find(std::string_view name) const {
  const auto it = std::find_if(columns_.begin(), columns_.end(), [&](const Column& one) { return one.name == name; });
  return it == columns_.end() ? nullptr : &*it;
}

EngineInfo ResultColumns::read_engine(const std::filesystem::path& path) {
  const formats::Location where{path_, 0};
  const auto text = file_->header_text();
  nlohmann::json header = text ? formats::parse_object(*text, where) : nlohmann::json::object();
  // All of it has a default here: what the columns are.
  Aspects claims;
  std::optional<std::size_t> size;
  for (const Known& known : kKnown) {
    const Column* column = find(known.name);
    if (column == nullptr) continue;
    if (known.name == "hit" || known.name == "overlap") claims.add(Aspect::overlap);
    if (known.name == "hit" || known.name == "contact" || known.number) claims.add(Aspect::contact);
    if (!known.number) continue;
    claims.add(*known.number);
    const std::size_t found = column->reader->type().size;
    if (size && *size != found)
      throw InputError(where, "/" + column->name,
                       "has numbers of another size than other columns: one engine has one scalar");
    size = found;
  }
  if (claims.empty()) throw InputError(where, "", "no column claims anything: hit, overlap, contact or a number");
  const Scalar scalar = size == sizeof(float) ? Scalar::binary32 : Scalar::binary64;
  const auto add = [&](const char* key, const nlohmann::json& value) {
    if (!header.contains(key)) header[key] = value;
  };
  add("engine", {{"name", path.stem().string()}, {"version", ""}});
  add("scalar", name(scalar));
  nlohmann::json pairs = nlohmann::json::array();
  for (const Pair pair : kPairs) pairs.push_back(name(pair));
  add("pairs", pairs);
  if (claims.has(Aspect::point))
    add("conventions", {{"points", kPointsNames[static_cast<std::size_t>(Points::midpoint)]}});
  if (claims.has(Aspect::points)) {
    if (find("points") == nullptr || find("depths") == nullptr)
      throw InputError(where, "/points", "points and depths go together");
    add("conventions",
        {{"points", kPointsNames[static_cast<std::size_t>(Points::manifold)]}, {"most_points", most_points_}});
  }
  add("claims", claims.names());
  add("format", kResultsFormat);
  add("version", kResultsVersion);
  const formats::Node node(header, where);
  check_results_format(node);
  EngineInfo info = read_engine_info(node, {"format", "version"});
  if (size == sizeof(float) && info.declared.scalar == Scalar::binary64)
    node.at("scalar").refuse("the columns have 32-bit numbers: binary32");
  return info;
}

const ResultColumns::Block& ResultColumns::block_of(std::uint64_t row) {
  const std::uint64_t first = row / formats::kArrayBlock * formats::kArrayBlock;
  const auto it = std::find_if(blocks_.begin(), blocks_.end(), [&](const Block& one) { return one.first == first; });
  if (it != blocks_.end()) return *it;
  Block block =
      blocks_.size() < kBlocks ? Block{0, std::vector<std::vector<char>>(columns_.size())} : std::move(blocks_.back());
  if (blocks_.size() == kBlocks) blocks_.pop_back();
  block.first = first;
  for (std::size_t i = 0; i < columns_.size(); ++i)
    columns_[i].reader->read(first, std::min(formats::kArrayBlock, rows_ - first), block.columns[i]);
  blocks_.push_front(std::move(block));
  return blocks_.front();
}

const char* ResultColumns::bytes(std::string_view name, std::uint64_t row) {
  const Column* column = find(name);
  if (column == nullptr) return nullptr;
  const Block& block = block_of(row);
  const auto index = static_cast<std::size_t>(column - columns_.data());
  return block.columns[index].data() + (row - block.first) * column->reader->type().row_size();
}

std::optional<bool> ResultColumns::truth(std::string_view name, std::uint64_t row) {
  const char* byte = bytes(name, row);
  if (byte == nullptr) return std::nullopt;
  if (*byte != 0 && *byte != 1)
    throw InputError(where(row), fmt::format("/{}", name),
                     fmt::format("expected 0 or 1, got {}", static_cast<unsigned char>(*byte)));
  return *byte == 1;
}

std::optional<double> ResultColumns::number(std::string_view name, std::uint64_t row, std::size_t across) {
  const char* first = bytes(name, row);
  if (first == nullptr) return std::nullopt;
  if (find(name)->reader->type().size == sizeof(float)) {
    float x = 0;
    std::memcpy(&x, first + across * sizeof x, sizeof x);
    return static_cast<double>(x);
  }
  double x = 0;
  std::memcpy(&x, first + across * sizeof x, sizeof x);
  return x;
}

std::optional<Vector3> ResultColumns::vector(std::string_view name, std::uint64_t row) {
  const auto x = number(name, row, 0);
  if (!x) return std::nullopt;
  return Vector3(*x, *number(name, row, 1), *number(name, row, 2));
}

std::string ResultColumns::id(std::uint64_t row) {
  const char* text = bytes("id", row);
  std::string found(text, strnlen(text, golden::kIdLength));
  if (!golden::is_query_id(found))
    throw InputError(where(row), "/id",
                     fmt::format("expected the {} hexadecimal digits of a question's id, got {}", golden::kIdLength,
                                 formats::json_string(found)));
  return found;
}

Claim ResultColumns::claim(std::uint64_t row) {
  if (truth("unsupported", row).value_or(false))
    return Claim::without(Claim::Status::unsupported, "the column 'unsupported' says so");
  Claim claim;
  const auto hit = truth("hit", row);
  claim.overlap = truth("overlap", row);
  if (!claim.overlap) claim.overlap = hit;
  ContactClaim numbers{vector("normal", row), vector("point1", row), vector("point2", row), vector("point", row),
                       number("value", row)};
  for (std::size_t i = 0; i < most_points_; ++i) {
    const auto place = [&](std::size_t axis) { return *number("points", row, 3 * i + axis); };
    const ManifoldPoint point{{place(0), place(1), place(2)}, *number("depths", row, i)};
    numbers.points.push_back(point);
  }
  const auto is_absent = [](const ManifoldPoint& point) {
    return std::isnan(point.depth) && point.at.array().isNaN().all();
  };
  while (!numbers.points.empty() && is_absent(numbers.points.back())) numbers.points.pop_back();
  auto has_contact = truth("contact", row);
  if (!has_contact) has_contact = hit;
  if (!has_contact) {
    // Only numbers: a row of nothing but NaN says that there is none.
    const auto says = [](const std::optional<Vector3>& v) { return v && !v->array().isNaN().all(); };
    const bool any =
        numbers.normal || numbers.point1 || numbers.point2 || numbers.point || most_points_ != 0 || numbers.value;
    if (any)
      has_contact = says(numbers.normal) || says(numbers.point1) || says(numbers.point2) || says(numbers.point) ||
                    !numbers.points.empty() || (numbers.value && !std::isnan(*numbers.value));
  }
  if (!has_contact) return claim;
  claim.speaks_of_contact = true;
  if (*has_contact) claim.contact = numbers;
  return claim;
}

}  // namespace contact::engines
