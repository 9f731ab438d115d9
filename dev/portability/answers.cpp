// Production's answers to generated questions, as the bytes that digests are taken over: what portability.py builds for
// every platform, and hashes.
//
//   answers --streams                  the committed files whose generator production answers, a line each
//   answers --ways                     the ways of answering that this program has and this processor can go
//   answers STREAM KEY COUNT WAY       the answers to the first COUNT questions. KEY in hexadecimal: the first 16 bytes
//                                      of the digest in docs/formats.md#the-generator
#include <algorithm>
#include <array>
#include <cfenv>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dev/portability/ways.hpp"
#include "golden/families.hpp"
#include "golden/production.hpp"

namespace contact::golden {
namespace {

/// Whatever gives production's bits has its place here.
std::vector<Way> ways() {
  std::vector<Way> ways{{"one_pair", [](std::span<const Query> run, std::string& bytes) {
                           for (const Query& query : run) bytes += production_bytes(query);
                         }}};
#if CONTACT_BATCH
  for (Way& way : batch_ways()) ways.push_back(std::move(way));
#endif
  return ways;
}

std::vector<CommittedFile> streams() {
  std::vector<CommittedFile> files = committed_files();
  std::erase_if(files, [](const CommittedFile& file) { return !production_answers(file); });
  return files;
}

template <class Number>
Number number(std::string_view text, int base) {
  Number x{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x, base);
  if (error != std::errc{} || end != text.data() + text.size())
    throw std::invalid_argument("not a number: " + std::string(text));
  return x;
}

Random::Key key(std::string_view text) {
  std::array<std::uint8_t, 16> bytes{};
  if (text.size() != 2 * bytes.size()) throw std::invalid_argument("a key has 32 digits");
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = number<std::uint8_t>(text.substr(2 * i, 2), 16);
  return Random::key(bytes);
}

CommittedFile stream(std::string_view path) {
  for (const CommittedFile& stream : streams())
    if (stream.path() == path) return stream;
  throw std::invalid_argument("no such stream: " + std::string(path));
}

Way way(std::string_view name) {
  for (const Way& way : ways())
    if (way.name == name) return way;
  throw std::invalid_argument("no such way: " + std::string(name));
}

void write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size()) throw std::runtime_error("cannot write");
}

void answer(const CommittedFile& stream, Random::Key key, std::uint64_t count, const Way& way) {
  constexpr std::uint64_t kRun = 512;
  std::vector<Query> run;
  std::string bytes;
  for (std::uint64_t first = 0; first < count; first += kRun) {
    run.clear();
    bytes.clear();
    for (std::uint64_t i = first; i < std::min(first + kRun, count); ++i)
      run.push_back(generate_query(stream.pair, *stream.family, stream.scalar, key, i));
    way.answer(run, bytes);
    write(bytes);
  }
}

void run(const std::vector<std::string_view>& arguments) {
  if (arguments.size() == 1 && arguments[0] == "--streams") {
    for (const CommittedFile& stream : streams()) write(stream.path() + "\n");
  } else if (arguments.size() == 1 && arguments[0] == "--ways") {
    for (const Way& way : ways()) write(way.name + "\n");
  } else if (arguments.size() == 4) {
    answer(stream(arguments[0]), key(arguments[1]), number<std::uint64_t>(arguments[2], 10), way(arguments[3]));
  } else {
    throw std::invalid_argument("answers --streams | --ways | STREAM KEY COUNT WAY");
  }
  if (std::fflush(stdout) != 0) throw std::runtime_error("cannot write");
}

}  // namespace
}  // namespace contact::golden

int main(int argc, char** argv) {
  // Families compute their questions here: what links with -Ofast flushes subnormal numbers from the start.
  std::fesetenv(FE_DFL_ENV);
  try {
    contact::golden::run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "answers: %s\n", error.what());
    return 2;
  }
  return 0;
}
