// Writing a dataset case by case, as JSON lines or as columns.
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "golden/dataset.hpp"

namespace contact::golden {

/// A dataset on its way to a file, which appears whole by commit() or not at all.
class DatasetWriter {
 public:
  DatasetWriter() = default;
  DatasetWriter(const DatasetWriter&) = delete;
  DatasetWriter& operator=(const DatasetWriter&) = delete;
  virtual ~DatasetWriter() = default;

  /// The next case. `line` is to_line(c), which a caller may work out on several threads.
  virtual void write(const Case& c, std::string_view line) = 0;
  /// Precondition: as many cases were written as the header says.
  virtual void commit() = 0;
};

/// Whether a name is one that a dataset can have: it ends in .jsonl, .h5 or .npz.
[[nodiscard]] bool names_dataset(const std::filesystem::path& path);

/// The form is what the name ends in: .h5 and .npz are columns, anything else JSON lines.
[[nodiscard]] std::unique_ptr<DatasetWriter> create_dataset(const std::filesystem::path& path,
                                                            const DatasetHeader& header);

}  // namespace contact::golden
