// --json, which means the same in every command.
#include "tool/commands/json_output.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "formats/input_error.hpp"
#include "golden/dataset_writer.hpp"
#include "tool/run/printing.hpp"

namespace contact::tool {
namespace {

constexpr std::string_view kPrinted = "-";

}  // namespace

void add_json_option(CLI::App& command, std::string& where, const std::string& about, FileOfJson file) {
  const std::string all = about + ", in place of the words; with FILE written there beside them";
  const auto keep = [](const std::string& value) {
    if (value == kPrinted) keep_output_for_data();
  };
  if (file == FileOfJson::behind_equals_sign) {
    command.add_flag(fmt::format("--json{{{}}}", kPrinted), where, all)->type_name("FILE")->each(keep);
    return;
  }
  const auto set = [&where, keep](const std::string& value) {
    if (value.empty()) throw CLI::ValidationError("--json", "expected something, got ''");
    if (golden::names_dataset(value) && std::filesystem::is_regular_file(value))
      throw formats::InputError({value, 0}, "--json",
                                "is there under the name of a golden file, and would be written over");
    keep(value);
    where = value;
  };
  command.add_option_function<std::string>("--json", set, all)
      ->expected(0, 1)
      ->default_str(std::string(kPrinted))
      ->type_name("FILE");
}

JsonOutput::JsonOutput(const std::string& where) : alone_(where == kPrinted) {
  if (!alone_ && !where.empty()) file_.emplace(where);
}

void JsonOutput::write(std::string_view text) {
  // Memory that is written to for the first time takes longer than what is looked for: the last write's is used again.
  shown_ = formats::visible_json(std::move(shown_.assign(text)));
  if (alone_) fmt::print("{}", shown_);
  if (file_) file_->write(shown_);
}

void JsonOutput::commit() {
  if (file_) file_->commit();
}

}  // namespace contact::tool
