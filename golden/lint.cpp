// Is a golden file well formed, canonical to the byte, and is every expectation right?
#include "golden/lint.hpp"

#include <algorithm>

#include "golden/digest.hpp"
#include "golden/flags.hpp"
#include "golden/query_id.hpp"

namespace contact::golden {

LintedFile lint(const std::filesystem::path& path, bool generated, const std::function<void()>& after_case) {
  DatasetReader reader(path);
  LintedFile linted{reader.header(), 0, {}, {}, {}};
  for (const Flag& flag : flags()) linted.flags.emplace_back(flag.name, 0);
  Sha256 hash;
  Sha256 answers;
  const auto canonical = [&](const std::string& expected) {
    hash.add(reader.text()).add("\n");
    if (reader.text() == expected) return;
    const auto differs =
        std::mismatch(reader.text().begin(), reader.text().end(), expected.begin(), expected.end()).first;
    throw InputError(
        reader.where(), "",
        fmt::format("not in canonical form from column {}: expected ...{}", differs - reader.text().begin() + 1,
                    expected.substr(static_cast<std::size_t>(differs - reader.text().begin()), 60)));
  };
  canonical(to_line(reader.header()));

  while (const auto c = reader.next()) {
    for (const std::string& flag : c->flags)
      if (std::none_of(flags().begin(), flags().end(), [&](const Flag& f) { return f.name == flag; }))
        throw InputError(reader.where(), "flags", "undeclared flag " + flag);
    if (reader.repeats() != 0 && !generated)
      throw InputError(reader.where(), "id", "the same question stands in this file twice: " + c->id);
    if (c->rejected)
      check_rejection(*c, reader.where());
    else
      check_case(*c, reader.header().scalar, oracle::truth_of(c->query), reader.where());
    const Case right = make_case(c->query, reader.header().scalar);
    if (c->flags != right.flags)
      throw InputError(
          reader.where(), "flags",
          fmt::format("the file says [{}], true are [{}]", fmt::join(c->flags, ","), fmt::join(right.flags, ",")));
    canonical(to_line(right));
    answers.add(digest_bytes(right));
    linted.hits += right.expect.hit ? 1 : 0;
    for (auto& [flag, count] : linted.flags)
      count += static_cast<std::uint64_t>(std::count(right.flags.begin(), right.flags.end(), flag));
    if (after_case) after_case();
  }
  std::erase_if(linted.flags, [](const auto& flag) { return flag.second == 0; });
  linted.sha256 = hash.hex();
  linted.answers = answers.hex();
  return linted;
}

}  // namespace contact::golden
