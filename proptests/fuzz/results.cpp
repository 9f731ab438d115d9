// A results file of any bytes is refused or read; what is read is written again as it stood.
#include "golden/results.hpp"

#include "fuzz/fuzz.hpp"
#include "golden/input_error.hpp"

namespace contact::fuzz {

void try_input(Bytes bytes) {
  const MemoryFile file(text_of(bytes));
  try {
    const golden::Results results = golden::read_results(file.path());
    std::string text = golden::to_line(results.engine) + "\n";
    for (const auto& [id, claim] : results.claims) text += golden::to_line(id, claim) + "\n";
    const MemoryFile copy(text);
    golden::Results again;
    try {
      again = golden::read_results(copy.path());
    } catch (const golden::InputError& error) {
      fail(std::string("what is written of a results file is refused: ") + error.what());
    }
    require(golden::to_line(again.engine) == golden::to_line(results.engine), "the engine is written otherwise");
    require(again.claims.size() == results.claims.size(), "a claim is lost");
    for (const auto& [id, claim] : results.claims)
      require(golden::to_line(id, again.claims.at(id)) == golden::to_line(id, claim), "a claim changes: " + id);
  } catch (const golden::InputError&) {
  }
}

}  // namespace contact::fuzz
