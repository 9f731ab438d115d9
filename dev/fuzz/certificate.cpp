// A certificate that somebody changed who knows how its digest is made: refused, or its statement holds all the same.
#include <cstdio>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <vector>

#include "formats/input_error.hpp"
#include "fuzz/fuzz.hpp"
#include "golden/dataset_writer.hpp"
#include "golden/families.hpp"
#include "golden/right_case.hpp"
#include "tool/commands/run_command.hpp"
#include "tool/reports/certificate.hpp"
#include "tool/run/process.hpp"

namespace contact::fuzz::certificate {
namespace {

using nlohmann::json;

int run(std::vector<const char*> words) {
  words.insert(words.begin(), "contact-oracle");
  return tool::run_command(static_cast<int>(words.size()), words.data());
}

/// A folder of this process with a dataset, the answers of an engine with mistakes, and their certificate.
struct Folder : TemporaryFolder {
  Folder() : TemporaryFolder("certificate") {
    if (std::freopen("/dev/null", "w", stdout) == nullptr) fail("no /dev/null");  // commands print what they found
    golden::DatasetHeader header;
    header.family = "touching";
    header.count = 4;
    const std::string dataset = path() / "touching.jsonl";
    const auto writer = golden::create_dataset(dataset, header);
    for (std::uint64_t i = 0; i < header.count; ++i) {
      const golden::Case c = golden::make_case(
          golden::generate_query(header.pair, *golden::find_family(header.pair, header.family), header.scalar, 1, i),
          header.scalar);
      writer->write(c, golden::to_line(c));
    }
    writer->commit();
    const std::string to = path() / "right.json";
    require(
        run({"certify", dataset.c_str(), "--engine", "plain-double", "--certificate", to.c_str()}) <= tool::kRefuted,
        "no certificate was made");
    std::ifstream file(to);
    text.assign(std::istreambuf_iterator<char>(file), {});
    right = json::parse(text);
    require(run({"verify", to.c_str()}) == tool::kCertified, "a right certificate does not hold");
  }

  std::string text;
  json right;
};

const Folder& folder() {
  static const Folder made;
  return made;
}

bool holds(const std::string& text) {
  const std::string path = folder().path() / "changed.json";
  std::ofstream(path, std::ios::binary).write(text.data(), static_cast<std::streamsize>(text.size()));
  try {
    return run({"verify", path.c_str()}) == tool::kCertified;
  } catch (const formats::InputError&) {
    return false;
  }
}

/// What verify says that it does not check, or what a certificate need not state in one way alone.
json checked(json statement) {
  for (const char* key : {"sha256", "issued", "environment", "engine"}) statement.erase(key);
  // An engine that answered every question is judged alike whether it had to or not: both statements are true.
  if (const auto found = statement.find("found"); found != statement.end() && found->is_object())
    found->erase("allow_unsupported");
  return statement;
}

/// What stands in the place of a value: of another kind, one more or less, or what stands elsewhere.
json instead_of(const json& value, const json& elsewhere, std::size_t kind) {
  switch (kind % 12) {
    case 0:
      return nullptr;
    case 1:
      return json::array();
    case 2:
      return json::object();
    case 3:
      return "";
    case 4:
      return -1;
    case 5:
      return 1e300;
    case 6:
      return std::uint64_t{1} << 62;
    case 7:
      return value.is_number_unsigned() ? json(value.get<std::uint64_t>() + 1) : json(1);
    case 8:
      return value.is_boolean() ? json(!value.get<bool>()) : json(true);
    case 9:
      return value.is_string() ? json(value.get<std::string>() + "x") : json("../right.json");
    case 10:
      return json::array({value, value});
    default:
      return elsewhere;
  }
}

/// How many values there are in a value, at any depth.
std::size_t places(const json& value) {
  std::size_t n = 0;
  if (value.is_structured())
    for (const json& inner : value) n += 1 + places(inner);
  return n;
}
/// The k-th of them, each before what is in it: what it stands in, and where. Domain: k < places(value).
std::pair<json*, json::iterator> place(json& value, std::size_t k) {
  for (json::iterator at = value.begin();; ++at) {
    if (k == 0) return {&value, at};
    const std::size_t inner = places(*at);
    if (k <= inner) return place(*at, k - 1);
    k -= inner + 1;
  }
}

/// The certificate with some of its values changed, each by three bytes.
json changed(Bytes bytes) {
  json statement = folder().right;
  statement.erase("sha256");
  while (!bytes.empty()) {
    const std::size_t n = places(statement);
    // A value that is put beside or into itself doubles: a few such changes are enough.
    if (n == 0 || n > 10'000) break;
    const std::size_t first = next(bytes) * 7;
    const auto [owner, at] = place(statement, (first + next(bytes)) % n);
    const std::size_t kind = next(bytes);
    const json elsewhere = *place(statement, (first * 31 + kind) % n).second;
    *at = instead_of(*at, elsewhere, kind);
    if (kind >= 192 && owner->is_object()) owner->erase(at);
  }
  return statement;
}

void try_input(Bytes bytes) {
  if (bytes.empty()) return;
  if (bytes[0] == '{') {  // the text itself
    const std::string text(text_of(bytes));
    require(!holds(text) || text == folder().text, "a certificate of other bytes holds");
    return;
  }
  const json statement = changed(bytes);
  if (!statement.is_object()) return;
  require(!holds(tool::certificate_text(statement)) || checked(statement) == checked(folder().right),
          "another statement holds: " + statement.dump());
}

const Target target("certificate", try_input);

}  // namespace
}  // namespace contact::fuzz::certificate
