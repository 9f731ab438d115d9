// A manifest of any bytes, and a table of what the files kill: refused or read, and never taken for another folder's.
#include "golden/manifest.hpp"

#include <fstream>

#include "formats/input_error.hpp"
#include "fuzz/fuzz.hpp"

namespace contact::fuzz::manifest {
namespace {

/// A folder of this process.
const std::filesystem::path& folder() {
  static const TemporaryFolder made("manifest");
  return made.path();
}

template <class Read>
void try_to(Read&& read) {
  try {
    read();
  } catch (const formats::InputError&) {
  }
}

void try_input(Bytes bytes) {
  for (const std::string_view name : {golden::kManifestName, golden::kAdequacyName})
    std::ofstream(folder() / name, std::ios::binary)
        .write(text_of(bytes).data(), static_cast<std::streamsize>(bytes.size()));
  try_to([] { static_cast<void>(golden::recorded_digests(folder())); });
  try_to([] { static_cast<void>(golden::recorded_kills(folder(), {})); });
  try_to([&] {
    golden::check_manifest(folder(), {});
    require(text_of(bytes) == golden::manifest_text({}), "a manifest of other bytes counts as the empty one");
  });
}

const Target target("manifest", try_input);

}  // namespace
}  // namespace contact::fuzz::manifest
