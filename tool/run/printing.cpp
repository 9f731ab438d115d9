// What the program prints for people.
#include "tool/run/printing.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <system_error>

namespace contact::tool {
namespace {

struct Printing {
  bool quiet = false;
  bool output_is_data = false;
  Colour colour = Colour::automatic;
};

Printing& printing() {
  static Printing chosen;
  return chosen;
}

}  // namespace

void be_quiet() { printing().quiet = true; }
bool is_quiet() { return printing().quiet; }
void keep_output_for_data() { printing().output_is_data = true; }

std::FILE* words() {
  if (!is_quiet()) return printing().output_is_data ? stderr : stdout;
  static std::FILE* const nowhere = std::fopen("/dev/null", "w");
  if (nowhere == nullptr) throw std::system_error(errno, std::generic_category(), "/dev/null");
  return nowhere;
}

void say_decimals(std::uint64_t count, std::string_view whose) {
  if (count == 0 || is_quiet()) return;
  fmt::print(stderr,
             "{} number{} of {} {} written with fewer digits than a binary32 number has, as 14.831459 is for "
             "14.831459045410156: taken as the nearest binary32 number\n",
             count, count == 1 ? "" : "s", whose, count == 1 ? "is" : "are");
}

void choose_colour(Colour colour) { printing().colour = colour; }
Colour chosen_colour() { return printing().colour; }

}  // namespace contact::tool
