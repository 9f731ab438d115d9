// Answers as columns, HDF5 or NumPy's .npz, as engines have them that answer many questions at once:
// docs/formats.md#answers-in-columns.
#pragma once

#include <filesystem>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engines/protocol/results.hpp"
#include "formats/arrays.hpp"

namespace contact::engines {

/// Holds some blocks of rows in memory, so that memory does not grow with the file. One thread at a time.
class ResultColumns {
 public:
  /// Throws formats::InputError where a column is unknown, or is not of its kind and shape.
  ResultColumns(const std::filesystem::path& path, formats::ArraysForm form);
  /// The same of arrays that are in no file; `path` names them in messages.
  ResultColumns(const std::filesystem::path& path, std::unique_ptr<formats::ArraysFile> arrays);

  /// Who answers: what the header says of it, and else the file's name and what the columns claim.
  [[nodiscard]] const EngineInfo& engine() const { return engine_; }
  [[nodiscard]] std::uint64_t rows() const { return rows_; }
  [[nodiscard]] bool has_ids() const { return find("id") != nullptr; }
  /// Of a row, best asked for in about their order. Domain: row < rows(), and for id() has_ids().
  [[nodiscard]] std::string id(std::uint64_t row);
  [[nodiscard]] Claim claim(std::uint64_t row);
  /// Where a row stands.
  [[nodiscard]] formats::Location where(std::uint64_t row) const { return {path_, row + 1, true}; }

 private:
  struct Column {
    std::string name;
    std::unique_ptr<formats::ArrayReader> reader;
  };
  struct Block {
    std::uint64_t first;
    std::vector<std::vector<char>> columns;
  };

  [[nodiscard]] const Column* find(std::string_view name) const;
  [[nodiscard]] EngineInfo read_engine(const std::filesystem::path& path);
  /// The bytes of a row of a column; nullptr where the file has none.
  [[nodiscard]] const char* bytes(std::string_view name, std::uint64_t row);
  [[nodiscard]] const Block& block_of(std::uint64_t row);
  [[nodiscard]] std::optional<bool> truth(std::string_view name, std::uint64_t row);
  /// The number that stands `across` a row.
  [[nodiscard]] std::optional<double> number(std::string_view name, std::uint64_t row, std::size_t across = 0);
  [[nodiscard]] std::optional<Vector3> vector(std::string_view name, std::uint64_t row);

  std::string path_;
  std::unique_ptr<formats::ArraysFile> file_;
  std::vector<Column> columns_;
  std::uint64_t rows_ = 0;
  std::size_t most_points_ = 0;  ///< of a row, where the columns have lists of them
  EngineInfo engine_;
  std::list<Block> blocks_;  ///< the last that were asked for, the newest first
};

}  // namespace contact::engines
