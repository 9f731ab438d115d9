// How often each mask of some source files came out true and false, by its place there.
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string_view>
#include <tuple>

#if !defined(__clang__)
#include <source_location>
#endif

namespace contact::kernel::tiny {

struct Place {
  const char* file;
  unsigned line;
  unsigned column;
};

#if defined(__clang__)
#define CONTACT_HERE                                                                                     \
  ::contact::kernel::tiny::Place {                                                                       \
    __builtin_FILE(), static_cast<unsigned>(__builtin_LINE()), static_cast<unsigned>(__builtin_COLUMN()) \
  }
#else
inline constexpr Place place_of(std::source_location here = std::source_location::current()) {
  return {here.file_name(), static_cast<unsigned>(here.line()), static_cast<unsigned>(here.column())};
}
#define CONTACT_HERE ::contact::kernel::tiny::place_of()
#endif

class Places {
 public:
  void count(Place place, bool is) {
    Outcomes& outcomes = of(place.file).counts[place.line % kLines][place.column % kColumns];
    ++(is ? outcomes.yes : outcomes.no);
  }
  /// A constant that the short numbers do not hold.
  [[noreturn]] static void refuse(double x) {
    std::fprintf(stderr, "%a needs more bits than there are\n", x);
    std::abort();
  }

  struct Outcomes {
    std::uint64_t yes = 0;
    std::uint64_t no = 0;
  };
  /// By the file's name without its folder, the line and the column.
  [[nodiscard]] std::map<std::tuple<std::string_view, unsigned, unsigned>, Outcomes> reached() const {
    std::map<std::tuple<std::string_view, unsigned, unsigned>, Outcomes> all;
    for (const File& file : files_) {
      if (file.name == nullptr) break;
      const std::string_view path = file.name;
      for (unsigned line = 0; line < kLines; ++line)
        for (unsigned column = 0; column < kColumns; ++column)
          if (const Outcomes& outcomes = file.counts[line][column]; outcomes.yes + outcomes.no != 0)
            all[{path.substr(path.rfind('/') + 1), line, column}] = outcomes;
    }
    return all;
  }

 private:
  static constexpr unsigned kLines = 512;
  static constexpr unsigned kColumns = 128;
  struct File {
    const char* name = nullptr;
    std::array<std::array<Outcomes, kColumns>, kLines> counts{};
  };

  File& of(const char* name) {
    for (File& file : files_) {
      if (file.name == nullptr) file.name = name;
      if (file.name == name || std::strcmp(file.name, name) == 0) return file;
    }
    std::fprintf(stderr, "%s is one file too many\n", name);
    std::abort();
  }

  std::array<File, 8> files_{};
};

}  // namespace contact::kernel::tiny
