// Writing a dataset case by case, as JSON lines or as columns.
#include "golden/dataset_writer.hpp"

#include "formats/output_file.hpp"
#include "golden/columns.hpp"

namespace contact::golden {
namespace {

class LinesWriter : public DatasetWriter {
 public:
  LinesWriter(const std::filesystem::path& path, const DatasetHeader& header) : file_(path) {
    file_.write(to_line(header) + "\n");
  }

  void write(const Case& /*c*/, std::string_view line) override {
    file_.write(line);
    file_.write("\n");
  }

  void commit() override { file_.commit(); }

 private:
  formats::OutputFile file_;
};

}  // namespace

bool names_dataset(const std::filesystem::path& path) {
  return path.extension() == ".jsonl" || formats::named_arrays_form(path);
}

std::unique_ptr<DatasetWriter> create_dataset(const std::filesystem::path& path, const DatasetHeader& header) {
  if (const auto form = formats::named_arrays_form(path)) return create_columns(path, *form, header);
  return std::make_unique<LinesWriter>(path, header);
}

}  // namespace contact::golden
