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

std::string cut(std::string_view message) {
  constexpr std::size_t kMost = 4096;
  if (message.size() <= kMost) return std::string(message);
  std::size_t end = kMost;
  const auto continues = [&](std::size_t i) { return (static_cast<unsigned char>(message[i]) & 0xc0) == 0x80; };
  while (end > kMost - 4 && continues(end)) --end;
  return fmt::format("{}... ({} bytes)", message.substr(0, end), message.size());
}

void choose_colour(Colour colour) { printing().colour = colour; }
Colour chosen_colour() { return printing().colour; }

}  // namespace contact::tool
