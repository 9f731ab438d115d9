// The entry that libFuzzer calls and, where it is not linked, a program that tries the files it is given.
#include "fuzz/fuzz.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <vector>

namespace contact::fuzz {

void fail(const std::string& what) {
  std::fprintf(stderr, "%s\n", what.c_str());
  std::abort();
}

MemoryFile::MemoryFile(std::string_view bytes) : descriptor_(memfd_create("input", 0)) {
  if (descriptor_ < 0) throw std::runtime_error("no file in memory");
  path_ = "/proc/self/fd/" + std::to_string(descriptor_);
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written <= 0) throw std::runtime_error("no room for a file in memory");
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

MemoryFile::~MemoryFile() { ::close(descriptor_); }

}  // namespace contact::fuzz

#ifdef CONTACT_LIBFUZZER

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  contact::fuzz::try_input({data, size});
  return 0;
}

#else

// Every file in the folders given, and those that have a name cut short and with single bytes changed too: found
// ones are changes of others already.
int main(int argc, char** argv) {
  std::size_t files = 0;
  std::size_t inputs = 0;
  for (int i = 1; i < argc; ++i)
    for (const auto& entry : std::filesystem::directory_iterator(argv[i])) {
      if (!entry.is_regular_file()) continue;
      std::ifstream file(entry.path(), std::ios::binary);
      std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
      ++files;
      contact::fuzz::try_input(bytes);
      const std::size_t changes = bytes.empty() || entry.path().parent_path().filename() == "found" ? 0 : 24;
      for (std::size_t k = 0; k < changes; ++k) {
        const std::size_t at = bytes.size() * k / changes;
        contact::fuzz::try_input({bytes.data(), at});
        const std::uint8_t before = bytes[at];
        bytes[at] = static_cast<std::uint8_t>(before ^ (1U << (k % 8)));
        contact::fuzz::try_input(bytes);
        bytes[at] = before;
        inputs += 2;
      }
    }
  std::printf("%zu files and %zu inputs made of them\n", files, inputs);
  return files == 0 ? 1 : 0;
}

#endif
