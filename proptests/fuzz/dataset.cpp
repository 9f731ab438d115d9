// A golden file of any bytes is refused or read; what is read is written again as it stood.
#include "golden/dataset.hpp"

#include "fuzz/fuzz.hpp"
#include "golden/input_error.hpp"

namespace contact::fuzz {

void try_input(Bytes bytes) {
  if (text_of(bytes).starts_with("\x89HDF")) return;  // columns have a target of their own
  const MemoryFile file(text_of(bytes));
  try {
    golden::DatasetReader reader(file.path());
    std::uint64_t cases = 0;
    while (const auto c = reader.next()) {
      ++cases;
      const std::string line = golden::to_line(*c);
      const golden::Location where{"written", 1};
      const auto json = golden::parse_object(line, where);
      const golden::Case again = golden::read_case(golden::Node(json, where), reader.header());
      require(golden::to_line(again) == line, "a case that is read is written otherwise the second time: " + line);
    }
    require(cases == reader.header().count, "the header's count is not that of the cases");
  } catch (const golden::InputError&) {
  }
}

}  // namespace contact::fuzz
