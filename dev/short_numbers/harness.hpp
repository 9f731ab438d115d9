// Every question of a grid to a kernel, and every answer against the truth.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace contact::kernel::tiny {

/// Two balls (x, y, z, radius each), the distances, and which way the points move along the normal.
struct Question {
  std::array<double, 8> balls;
  double alarm;
  double contact;
  std::array<double, 2> signs;  ///< point k = c_k + signs[k] r_k n
};

inline constexpr std::size_t kNumbers = 10;  ///< of a contact: normal, points, value

/// What a kernel says without exact arithmetic.
struct Answer {
  enum class Decision : std::uint8_t { hit, miss, open };
  Decision decision = Decision::open;
  bool degenerate = false;  ///< says that the centres coincide; looked at where all numbers are certain
  unsigned certain = 0;     ///< of a hit: the numbers that it settles, as bits
  std::array<double, kNumbers> number{};
};

/// Sets of numbers, one for each of a question's; the questions are all of their product.
struct Grid {
  std::string name;
  std::array<std::vector<double>, 8> balls;
  std::vector<double> alarms;
  std::vector<double> contacts;
  std::vector<std::array<double, 2>> signs;

  [[nodiscard]] std::uint64_t size() const;
};

/// What came of a grid.
struct Outcome {
  std::uint64_t questions = 0;
  std::array<std::uint64_t, 3> decided{};         ///< by Decision
  std::array<std::uint64_t, kNumbers> settled{};  ///< numbers of hits
  std::array<std::uint64_t, kNumbers> left{};
  std::map<std::string, std::array<std::uint64_t, 2>> kinds;  ///< questions of a kind: settled whole, not
  std::uint64_t wrong = 0;
  std::vector<std::string> first_wrong;

  void add(const Outcome& other);
};

/// Answers questions that share alarm, contact and signs.
using Kernel = std::function<void(const std::vector<Question>& questions, std::vector<Answer>& answers)>;

/// Asks a kernel of `bits` bits everything on a grid.
Outcome ask_all(const Grid& grid, int bits, const Kernel& kernel);

/// The grids for kernels of `bits` bits: a few seconds' worth, or all.
std::vector<Grid> grids(int bits, bool whole);

}  // namespace contact::kernel::tiny
