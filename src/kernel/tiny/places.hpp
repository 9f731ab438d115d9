// How often each mask of a source came out true and false, by its place there.
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <utility>

#if !defined(__clang__)
#include <source_location>
#endif

namespace contact::kernel::tiny {

/// A line and a column.
struct Place {
  unsigned line;
  unsigned column;
};

#if defined(__clang__)
#define CONTACT_HERE \
  ::contact::kernel::tiny::Place { static_cast<unsigned>(__builtin_LINE()), static_cast<unsigned>(__builtin_COLUMN()) }
#else
inline constexpr Place place_of(std::source_location here = std::source_location::current()) {
  return {static_cast<unsigned>(here.line()), static_cast<unsigned>(here.column())};
}
#define CONTACT_HERE ::contact::kernel::tiny::place_of()
#endif

class Places {
 public:
  void count(Place place, bool is) {
    Outcomes& outcomes = counts_[place.line % kLines][place.column % kColumns];
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
  [[nodiscard]] std::map<std::pair<unsigned, unsigned>, Outcomes> reached() const {
    std::map<std::pair<unsigned, unsigned>, Outcomes> all;
    for (unsigned line = 0; line < kLines; ++line)
      for (unsigned column = 0; column < kColumns; ++column)
        if (const Outcomes& outcomes = counts_[line][column]; outcomes.yes + outcomes.no != 0)
          all[{line, column}] = outcomes;
    return all;
  }

 private:
  static constexpr unsigned kLines = 2048;
  static constexpr unsigned kColumns = 128;
  std::array<std::array<Outcomes, kColumns>, kLines> counts_{};
};

}  // namespace contact::kernel::tiny
