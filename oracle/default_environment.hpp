// The floating-point environment that the oracles compute in, whatever their caller has set.
#pragma once

#include <cfenv>
#include <limits>

namespace contact::oracle {

/// While it lives, sums are rounded to nearest and subnormal numbers kept; then the caller's environment is back.
///
/// Most of an oracle is integers; doubles come in where questions and claims are read and where answers are rounded.
/// Every function of the oracles' headers that touches one begins with this guard. Entering costs a few sums where
/// nothing has to be changed. Exceptions that the caller has unmasked stay so unless something has to be changed.
class DefaultEnvironment {
 public:
  DefaultEnvironment() : changed_(!is_default()) {
    if (!changed_) return;
    std::fegetenv(&before_);
    std::fesetenv(FE_DFL_ENV);
  }
  DefaultEnvironment(const DefaultEnvironment&) = delete;
  DefaultEnvironment& operator=(const DefaultEnvironment&) = delete;
  ~DefaultEnvironment() {
    if (changed_) std::fesetenv(&before_);
  }

  /// What arithmetic shows: not every way of flushing subnormal numbers can be asked for by a standard function.
  static bool is_default() {
    static volatile const double one = 1;
    static volatile const double hair = 0x1p-60;
    static volatile const double half = 0.5;
    static volatile const double least_normal = std::numeric_limits<double>::min();
    static volatile const double least = std::numeric_limits<double>::denorm_min();
    const double x = one;
    const double subnormal = least;
    return x + hair == x && x - hair == x && least_normal * half != 0 && subnormal != 0;
  }

 private:
  bool changed_;
  std::fenv_t before_;
};

}  // namespace contact::oracle
