// The program itself: its version, and the files that belong to it, which lie beside it wherever it is moved.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace contact::formats {

/// The version of the project, as "0.2.0".
[[nodiscard]] std::string_view version();

/// The version and, where it is known, the commit: "0.2.0 (commit 0123456789ab)".
[[nodiscard]] std::string version_and_commit();

/// The file of this process's program, without links; its name alone where the system does not tell (no /proc).
[[nodiscard]] std::filesystem::path program();

/// The folder of the golden files (`golden`) and schemas (`schema`): share/contact-oracle beside the program, as in a
/// build, or one folder up, as where it is installed. An empty path where there is neither.
[[nodiscard]] const std::filesystem::path& data_folder();

}  // namespace contact::formats
