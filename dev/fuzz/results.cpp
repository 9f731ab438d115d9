// A results file of any bytes is refused or read; what is read is written again as it stood.
#include "engines/protocol/results.hpp"

#include "formats/input_error.hpp"
#include "fuzz/fuzz.hpp"

namespace contact::fuzz::results {
namespace {

void try_input(Bytes bytes) {
  const MemoryFile file(text_of(bytes));
  try {
    const engines::Results results = engines::read_results(file.path());
    std::string text = engines::to_line(results.engine) + "\n";
    for (const auto& [id, claim] : results.claims) text += engines::to_line(id, claim) + "\n";
    const MemoryFile copy(text);
    engines::Results again;
    try {
      again = engines::read_results(copy.path());
    } catch (const formats::InputError& error) {
      fail(std::string("what is written of a results file is refused: ") + error.what());
    }
    require(engines::to_line(again.engine) == engines::to_line(results.engine), "the engine is written otherwise");
    require(again.claims.size() == results.claims.size(), "a claim is lost");
    for (const auto& [id, claim] : results.claims)
      require(engines::to_line(id, again.claims.at(id)) == engines::to_line(id, claim), "a claim changes: " + id);
  } catch (const formats::InputError&) {
  }
}

const Target target("results", try_input);

}  // namespace
}  // namespace contact::fuzz::results
