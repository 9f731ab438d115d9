// The digest of a dataset's columns, as they come block by block: docs/formats.md#the-digest-of-the-columns.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "formats/arrays.hpp"
#include "formats/sha256.hpp"

namespace contact::golden {

/// SHA-256 over a header and columns. Memory does not grow with the rows.
class ColumnsDigest {
 public:
  explicit ColumnsDigest(std::vector<std::string> names) : names_(std::move(names)), columns_(names_.size()) {}

  /// Appends rows to a column, in their order; columns are apart, each for one thread at a time. Once at least for
  /// each. How wide its texts are does not matter.
  void add(std::size_t column, const formats::ArrayType& type, const std::vector<char>& rows);
  /// The digest of what was added, under a header and beside lists of texts by their names.
  [[nodiscard]] std::string hex(const nlohmann::json& header,
                                const std::map<std::string, std::vector<std::string>>& lists) const;

 private:
  struct Column {
    formats::ArrayType type{};
    std::uint64_t rows = 0;
    formats::Sha256 hash{};
    std::string texts{};  ///< of one block, one behind the other
  };

  std::vector<std::string> names_;
  std::vector<Column> columns_;
};

}  // namespace contact::golden
