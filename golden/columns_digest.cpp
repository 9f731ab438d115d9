// The digest of a dataset's columns, as they come block by block: docs/formats.md#the-digest-of-the-columns.
#include "golden/columns_digest.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <bit>
#include <cstring>
#include <nlohmann/json.hpp>

namespace contact::golden {
namespace {

static_assert(std::endian::native == std::endian::little, "values are hashed as they are in memory");

std::string_view type_name(const formats::ArrayType& type) {
  switch (type.kind) {
    case formats::ArrayType::Kind::real:
      return type.size == sizeof(double) ? "float64" : "float32";
    case formats::ArrayType::Kind::byte:
      return "uint8";
    case formats::ArrayType::Kind::bits:
      return "uint32";
    default:
      return "text";
  }
}

}  // namespace

void ColumnsDigest::add(std::size_t column, const formats::ArrayType& type, const std::vector<char>& rows) {
  Column& one = columns_[column];
  one.type = type;
  one.rows += rows.size() / type.row_size();
  if (type.kind != formats::ArrayType::Kind::text) {
    one.hash.add({rows.data(), rows.size()});
    return;
  }
  one.texts.clear();
  for (std::size_t at = 0; at < rows.size(); at += type.size)
    one.texts.append(rows.data() + at, strnlen(rows.data() + at, type.size)).push_back('\0');
  one.hash.add(one.texts);
}

std::string ColumnsDigest::hex(const nlohmann::json& header,
                               const std::map<std::string, std::vector<std::string>>& lists) const {
  std::map<std::string, std::string> lines;
  const auto put = [&](const std::string& name, std::string_view type, const std::vector<std::uint64_t>& shape,
                       const formats::Sha256& hash) {
    lines[name] = fmt::format("{} {} {} {}\n", name, type, fmt::join(shape, "x"), hash.hex());
  };
  for (std::size_t i = 0; i < columns_.size(); ++i)
    put(names_[i], type_name(columns_[i].type), columns_[i].type.shape(columns_[i].rows), columns_[i].hash);
  for (const auto& [name, texts] : lists) {
    formats::Sha256 hash;
    for (const std::string& text : texts) hash.add(text).add({"\0", 1});
    put(name, "text", {texts.size()}, hash);
  }
  formats::Sha256 whole;
  whole.add(header.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)).add("\n");
  for (const auto& [name, line] : lines) whole.add(line);
  return whole.hex();
}

}  // namespace contact::golden
