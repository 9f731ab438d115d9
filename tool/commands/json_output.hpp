// --json, which means the same in every command: alone it prints JSON in place of the words for people, and with a file
// it writes that file beside them.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "formats/output_file.hpp"

namespace contact::tool {

/// Whether the file may also stand behind a space, as it did in reports before --json could stand alone. Where a
/// command has other arguments that may be files, it could not be told from these.
enum class FileOfJson { behind_equals_sign, behind_space_too };

/// Adds --json, which sets `where` to a file's name, or to "-" for standard output.
void add_json_option(CLI::App& command, std::string& where, const std::string& about,
                     FileOfJson file = FileOfJson::behind_equals_sign);

/// Where the JSON goes. A file is opened at once, so that a name that cannot be written is refused before the work, and
/// is there when it is whole.
class JsonOutput {
 public:
  explicit JsonOutput(const std::string& where);

  [[nodiscard]] bool wanted() const { return alone_ || file_; }
  /// Whether it is printed, in place of the words for people.
  [[nodiscard]] bool alone() const { return alone_; }
  void write(std::string_view text);
  void commit();

 private:
  bool alone_;
  std::optional<formats::OutputFile> file_;
  std::string shown_;  ///< what was written last
};

}  // namespace contact::tool
