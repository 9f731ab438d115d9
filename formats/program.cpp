#include "formats/program.hpp"

#include <system_error>

#include "contact_commit.hpp"

namespace contact::formats {

namespace fs = std::filesystem;

std::string_view version() { return CONTACT_VERSION; }

std::string version_and_commit() {
  std::string text(version());
  if (const std::string_view commit = CONTACT_COMMIT; !commit.empty()) text += " (commit " + std::string(commit) + ")";
  return text;
}

fs::path program() {
  std::error_code absent;
  const fs::path found = fs::read_symlink("/proc/self/exe", absent);
  return absent ? "contact-oracle" : found;
}

const fs::path& data_folder() {
  static const fs::path found = [] {
    const fs::path beside = program().parent_path();
    std::error_code absent;
    for (const fs::path& prefix : {beside, beside.parent_path()})
      if (fs::path folder = prefix / "share" / "contact-oracle"; fs::is_directory(folder, absent)) return folder;
    return fs::path();
  }();
  return found;
}

}  // namespace contact::formats
