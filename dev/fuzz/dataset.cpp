// A golden file of any bytes is refused or read; what is read is written again as it stood.
#include "golden/dataset.hpp"

#include <nlohmann/json.hpp>
#include "formats/input_error.hpp"
#include "fuzz/cases_in_form.hpp"
#include "fuzz/fuzz.hpp"

namespace contact::fuzz::dataset {
namespace {

void try_input(Bytes bytes) {
  if (text_of(bytes).starts_with("\x89HDF")) return;  // columns have a target of their own
  const MemoryFile file(text_of(bytes));
  try {
    golden::DatasetReader reader(file.path(), none_is_made);
    std::uint64_t cases = 0;
    while (const auto c = reader.next()) {
      ++cases;
      const std::string line = golden::to_line(*c);
      const formats::Location where{"written", 1};
      const auto json = formats::parse_object(line, where);
      const golden::Case again = golden::read_case(formats::Node(json, where), reader.header());
      require(golden::to_line(again) == line, "a case that is read is written otherwise the second time: " + line);
    }
    require(cases == reader.header().count, "the header's count is not that of the cases");
  } catch (const formats::InputError&) {
  }
}

const Target target("dataset", try_input);

}  // namespace
}  // namespace contact::fuzz::dataset
