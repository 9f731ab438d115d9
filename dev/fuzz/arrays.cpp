// A .npz whose arrays hold anything: refused as a dataset, or read as what it was made of; and as answers refused or
// read. (Bytes that are no ZIP archive are libzip's to refuse; fuzzing those would be fuzzing it.)
#include <zip.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "engines/protocol/result_columns.hpp"
#include "formats/input_error.hpp"
#include "fuzz/cases_in_form.hpp"
#include "fuzz/fuzz.hpp"

namespace contact::fuzz::arrays {
namespace {

using Members = std::vector<std::pair<std::string, std::string>>;

Members members_of(const std::filesystem::path& path) {
  Members members;
  zip_t* zip = zip_open(path.c_str(), ZIP_RDONLY, nullptr);
  for (zip_int64_t i = 0; i < zip_get_num_entries(zip, 0); ++i) {
    const auto index = static_cast<zip_uint64_t>(i);
    zip_stat_t stat;
    zip_stat_index(zip, index, 0, &stat);
    std::string bytes(stat.size, '\0');
    zip_file_t* member = zip_fopen_index(zip, index, 0);
    zip_fread(member, bytes.data(), bytes.size());
    zip_fclose(member);
    members.emplace_back(stat.name, std::move(bytes));
  }
  zip_discard(zip);
  return members;
}

void write(const std::filesystem::path& path, const Members& members) {
  zip_t* zip = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr);
  for (const auto& [name, bytes] : members) {
    const zip_int64_t index =
        zip_file_add(zip, name.c_str(), zip_source_buffer(zip, bytes.data(), bytes.size(), 0), ZIP_FL_OVERWRITE);
    zip_set_file_compression(zip, static_cast<zip_uint64_t>(index), ZIP_CM_STORE, 0);
  }
  zip_close(zip);
}

/// A file of some cases, its members and its lines.
struct Made {
  explicit Made(bool invalid) {
    const Temporary file("made.npz");
    lines = write_columns(file.path(), formats::ArraysForm::npz, Pair::sphere_sphere, invalid, 3);
    members = members_of(file.path());
  }

  Members members;
  std::vector<std::string> lines;
};

/// An .npy file of version 2 that is its header alone.
std::string with_head(std::string_view head) {
  std::string file("\x93NUMPY\x02\x00", 8);
  for (int shift = 0; shift < 32; shift += 8) file.push_back(static_cast<char>((head.size() >> shift) & 0xff));
  return file.append(head);
}

constexpr std::array kAnswers{"hit.npy",   "overlap.npy", "contact.npy", "normal.npy",
                              "value.npy", "id.npy",      "header.npy"};

void try_input(Bytes bytes) {
  static const std::array made{Made(false), Made(true)};
  if (bytes.size() < 2) return;
  const Made& from = made[bytes[0] % made.size()];
  Members members = from.members;
  auto& [name, content] = members[bytes[1] % members.size()];
  std::string changed(text_of(bytes.subspan(2)));
  // The beginning of a true array makes a true one of what follows.
  if (!changed.empty() && changed.front() == '+') changed = content.substr(0, 256) + changed.substr(1);
  // What follows * is the header of an array, whose length is told right.
  if (!changed.empty() && changed.front() == '*') changed = with_head(std::string_view(changed).substr(1));
  const bool same = changed == content;
  content = changed;
  const Temporary file("changed.npz");
  write(file.path(), members);
  try {
    require(lines_of(file.path()) == from.lines, "changed rows pass for whole");
  } catch (const formats::InputError& error) {
    require(!same, std::string("a whole file is refused: ") + error.what());
  }

  Members answers{{kAnswers[bytes[1] % kAnswers.size()], changed}};
  if (bytes[0] % 3 != 0) answers.emplace_back("point.npy", from.members.back().second);
  write(file.path(), answers);
  try {
    engines::ResultColumns columns(file.path(), formats::ArraysForm::npz);
    for (std::uint64_t row = 0; row < columns.rows(); ++row) {
      static_cast<void>(columns.claim(row));
      if (columns.has_ids()) static_cast<void>(columns.id(row));
    }
  } catch (const formats::InputError&) {
  }
}

const Target target("arrays", try_input);

}  // namespace
}  // namespace contact::fuzz::arrays
