// The entry that libFuzzer calls and, where it is not linked, a program that tries the files it is given.
#include "fuzz/fuzz.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <vector>

namespace contact::fuzz {

namespace {

using TryInput = void (*)(Bytes);

/// Those of this program, by their names.
std::map<std::string_view, TryInput>& targets() {
  static std::map<std::string_view, TryInput> all;
  return all;
}

}  // namespace

Target::Target(std::string_view name, TryInput try_input) { targets().emplace(name, try_input); }

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

Temporary::Temporary(const std::string& name)
    : path_(std::filesystem::temp_directory_path() / ("fuzz-" + std::to_string(::getpid()) + "-" + name)) {}

namespace {

using Buffer = std::vector<std::uint8_t>;

// Changes of single bytes make no input much longer or deeper, and a reader that calls itself for each character or for
// each bracket fails at nothing else.

/// Whether so many more of the byte at `at` are more of a text. Elsewhere a byte is a choice of the target, or a part
/// of a number.
bool is_in_text(Bytes bytes, std::size_t at) {
  const auto prints = [&](std::size_t i) { return i >= bytes.size() || (bytes[i] >= 0x20 && bytes[i] < 0x7f); };
  return bytes.size() >= 16 && prints(at) && prints(at + 1) && (at == 0 || prints(at - 1));
}

Buffer put_in(Bytes bytes, std::size_t at, std::string_view piece, std::size_t times) {
  Buffer longer(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
  for (std::size_t i = 0; i < times; ++i) longer.insert(longer.end(), piece.begin(), piece.end());
  longer.insert(longer.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at), bytes.end());
  return longer;
}

/// The byte at `at`, so many more times.
Buffer lengthened(Bytes bytes, std::size_t at, std::size_t times) {
  return put_in(bytes, at, text_of(bytes).substr(at, 1), times);
}

/// What begins at `at`, an object or an array of JSON or an element of XML that has nothing in it, so many deeper, and
/// as well-formed as it was. Nothing where no such thing begins or it has no end.
Buffer nested(Bytes bytes, std::size_t at, std::size_t times) {
  const std::string_view text = text_of(bytes);
  std::size_t end = at;
  std::string_view open = "<Node>";
  std::string_view close = "</Node>";
  if (text[at] == '<') {
    end = text.find('>', at);
    if (end == std::string_view::npos || text[end - 1] != '/') return {};
  } else if (text[at] == '{' || text[at] == '[') {
    std::size_t depth = 0;
    for (; end < text.size(); ++end) {
      depth += text[end] == '{' || text[end] == '[' ? 1 : 0;
      if ((text[end] == '}' || text[end] == ']') && --depth == 0) break;
    }
    if (end == text.size()) return {};
    open = text[at] == '{' ? R"({"a":)" : "[";
    close = text[at] == '{' ? "}" : "]";
  } else {
    return {};
  }
  const Buffer closed = put_in(bytes, end + 1, close, times);
  return put_in(closed, at, open, times);
}

}  // namespace
}  // namespace contact::fuzz

#ifdef CONTACT_LIBFUZZER

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto try_input = contact::fuzz::targets().begin()->second;
  try_input({data, size});
  return 0;
}

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

/// One change in eight lengthens or nests; the others are libFuzzer's.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  using namespace contact::fuzz;
  if (size == 0 || seed % 8 != 0) return LLVMFuzzerMutate(data, size, max_size);
  const Bytes bytes(data, size);
  const std::size_t times = std::size_t{1} << (seed >> 4) % 17;
  std::size_t at = (seed >> 8) % size;
  Buffer changed;
  if ((seed >> 3) % 2 == 0) {
    if (is_in_text(bytes, at)) changed = lengthened(bytes, at, times);
  } else {
    for (at = text_of(bytes).find_first_of("[{<", at); at < size && changed.empty();
         at = text_of(bytes).find_first_of("[{<", at + 1))
      changed = nested(bytes, at, times);
  }
  if (changed.empty() || changed.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::copy(changed.begin(), changed.end(), data);
  return changed.size();
}

#else

namespace contact::fuzz {
namespace {

struct Tried {
  std::size_t files = 0;
  std::size_t changed = 0;
  std::size_t longer = 0;
  std::size_t deeper = 0;
};

void try_changes(Buffer bytes, TryInput try_input, Tried& tried) {
  constexpr std::size_t kChanges = 24;
  for (std::size_t k = 0; k < kChanges; ++k) {
    const std::size_t at = bytes.size() * k / kChanges;
    try_input({bytes.data(), at});
    const std::uint8_t before = bytes[at];
    bytes[at] = static_cast<std::uint8_t>(before ^ (1U << (k % 8)));
    try_input(bytes);
    bytes[at] = before;
    tried.changed += 2;
  }
}

void try_longer(Bytes bytes, TryInput try_input, Tried& tried) {
  constexpr std::size_t kPlaces = 4;
  constexpr std::size_t kTimes = 40'000;
  for (std::size_t k = 0; k < kPlaces; ++k) {
    const std::size_t at = bytes.size() * (2 * k + 1) / (2 * kPlaces);
    if (!is_in_text(bytes, at)) continue;
    try_input(lengthened(bytes, at, kTimes));
    ++tried.longer;
  }
}

/// Of each kind of bracket the first and the last.
void try_deeper(Bytes bytes, TryInput try_input, Tried& tried) {
  const std::string_view text = text_of(bytes);
  for (const char open : {'{', '[', '<'})
    for (const std::size_t at :
         {text.find(open),
          text.find("/>") == std::string_view::npos ? text.rfind(open) : text.rfind(open, text.rfind("/>"))})
      for (const std::size_t times : {9U, 20'000U}) {
        if (at == std::string_view::npos) continue;
        const Buffer deep = nested(bytes, at, times);
        if (deep.empty()) continue;
        try_input(deep);
        ++tried.deeper;
      }
}

}  // namespace
}  // namespace contact::fuzz

// TARGET FOLDER..: every file in the folders; those that have a name are cut short, changed in single bytes, lengthened and nested
// too: found ones are changes of others already.
int main(int argc, char** argv) {
  using namespace contact::fuzz;
  if (argc < 2 || targets().count(argv[1]) == 0) {
    std::fprintf(stderr, "usage: %s TARGET FOLDER..; the targets:", argv[0]);
    for (const auto& [name, of] : targets()) std::fprintf(stderr, " %s", std::string(name).c_str());
    std::fprintf(stderr, "\n");
    return 2;
  }
  const TryInput try_input = targets().at(argv[1]);
  Tried tried;
  for (int i = 2; i < argc; ++i)
    for (const auto& entry : std::filesystem::directory_iterator(argv[i])) {
      if (!entry.is_regular_file()) continue;
      std::ifstream file(entry.path(), std::ios::binary);
      const Buffer bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
      ++tried.files;
      try_input(bytes);
      if (bytes.empty() || entry.path().parent_path().filename() == "found") continue;
      try_changes(bytes, try_input, tried);
      try_longer(bytes, try_input, tried);
      try_deeper(bytes, try_input, tried);
    }
  std::printf("%zu files, and inputs made of them: %zu changed, %zu longer, %zu deeper\n", tried.files, tried.changed,
              tried.longer, tried.deeper);
  return tried.files == 0 ? 1 : 0;
}

#endif
