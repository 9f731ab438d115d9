// What a rewritten file calls in the place of its operators, constants, conditions, returns and statements: the same,
// but for the one mutant that CONTACT_MUTANT names. All mutants are in one program, so that none is compiled on its
// own.
//
// Mutant 4 place + variant is the variant-th change of a place. With CONTACT_MUTANTS_REACHED=FILE nothing is changed,
// and at exit FILE.PID gets a byte a mutant: 0 never executed, 1 it would have changed no value, 2 it would have, 3 no
// such mutant for these types. A test during which it would have changed no value cannot kill it.
#pragma once
#pragma GCC system_header

#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

namespace mutant {

inline constexpr unsigned kMost = 1u << 16;
inline constexpr unsigned kVariants = 4;
enum : unsigned char { kUnreached, kUnchanged, kChanged, kNone };

// A place is of interest where place - least <= span: one comparison, for one place or for all.
inline unsigned least = ~0u;
inline unsigned span = 0;
inline unsigned chosen = 0;
inline bool recording = false;
inline unsigned char* reached = nullptr;
inline std::string* file = nullptr;

inline void write_reached() {
  if (std::FILE* out = std::fopen((*file + "." + std::to_string(getpid())).c_str(), "wb")) {
    std::fwrite(reached, 1, kMost, out);
    std::fclose(out);
  }
}

// Before any other initialization, once, whatever file comes first.
__attribute__((constructor(101))) static void start() {
  static bool started = false;
  if (started || reached != nullptr || least != ~0u) return;
  started = true;
  if (const char* name = std::getenv("CONTACT_MUTANTS_REACHED")) {
    recording = true;
    reached = static_cast<unsigned char*>(std::calloc(kMost, 1));
    file = new std::string(name);
    least = 0;
    span = ~0u;
    std::atexit(write_reached);
  } else if (const char* id = std::getenv("CONTACT_MUTANT")) {
    const auto number = static_cast<unsigned>(std::strtoul(id, nullptr, 10));
    least = number / kVariants;
    chosen = number % kVariants;
  }
}

inline bool on(unsigned place) { return __builtin_expect(place - least <= span, 0); }

inline void note(unsigned place, unsigned variant, unsigned char what) {
  unsigned char& now = reached[place * kVariants + variant];
  if (now == kUnreached || now == kNone || what == kChanged) now = what;
}

template <class T>
bool same(const T& x, const T& y) {
  if constexpr (std::is_arithmetic_v<T>)
    return std::memcmp(&x, &y, sizeof x) == 0;
  else
    return false;  // not looked at: it may have changed
}

/// What a place gives under the chosen mutant, or `right` while recording. `wrong` are functions, one a variant, that
/// return void where the types know no such operation.
template <class R, class... Wrong>
[[gnu::noinline]] R pick(unsigned place, const R& right, const Wrong&... wrong) {
  unsigned variant = 0;
  if (recording) {
    (..., [&] {
      if constexpr (std::is_void_v<decltype(wrong())>)
        note(place, variant, kNone);
      else if constexpr (std::is_arithmetic_v<R>)
        note(place, variant, same<R>(right, wrong()) ? kUnchanged : kChanged);
      else
        note(place, variant, kChanged);
      ++variant;
    }());
    return right;
  }
  std::optional<R> result;
  (..., [&] {
    if constexpr (!std::is_void_v<decltype(wrong())>)
      if (variant == chosen) result.emplace(wrong());
    ++variant;
  }());
  return result ? *result : right;
}

namespace runtime {
#define MUTANT_FUNCTION inline
#define MUTANT_ON(place) ::mutant::on(place)
#include "mutant_operators.hpp"
#undef MUTANT_FUNCTION
#undef MUTANT_ON
}  // namespace runtime

// For constexpr functions: what the compiler evaluates is never changed.
namespace constant {
#define MUTANT_FUNCTION constexpr
#define MUTANT_ON(place) (!std::is_constant_evaluated() && ::mutant::on(place))
#include "mutant_operators.hpp"
#undef MUTANT_FUNCTION
#undef MUTANT_ON
}  // namespace constant

}  // namespace mutant
