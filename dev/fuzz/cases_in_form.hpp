// Cases in the form of golden files, with numbers that nobody computed: who reads columns does not ask whether they are right.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "golden/columns.hpp"
#include "golden/dataset.hpp"
#include "golden/names.hpp"
#include "golden/query_id.hpp"

namespace contact::fuzz {

/// So many cases of a pair whose contacts have a distance or, of two boxes, no numbers; or of questions that are to be refused.
[[nodiscard]] inline std::vector<golden::Case> cases_in_form(Pair pair, bool invalid, std::uint64_t count) {
  std::vector<golden::Case> cases;
  for (std::uint64_t i = 0; i < count; ++i) {
    golden::Case c{{}, zero_query(pair), {}, {}, std::nullopt, {}};
    double number = static_cast<double>(i) + 0.1;  // each is one more, so that a box's maxima lie above its minima
    for_each_number_unnamed(c.query, [&](double& x) { x = number += 1; });
    c.query.distances = {0.5, invalid ? -0.25 : 0.25};
    c.id = golden::query_id(c.query);
    if (invalid) {
      c.flags = {std::string(golden::kInvalidFlag)};
      c.rejected = outside_domain(c.query)->field;
    } else {
      if (i % 2 != 0) c.flags = {std::string(golden::kFlags.front().name)};
      c.expect.hit = i % 2 == 0;
      if (!has_numbers(pair)) {
        c.exact.gap = {"-0x1p0", "0x3p-4", "0x0p0"};
      } else {
        if (c.expect.hit) c.expect.contact = Contact{{1, 0, 0}, {number, 0, -1}, {0.1, 0, number}, -0.1, false, i != 0};
        c.exact = {"0x1p0", "0x3p0", 0.5, {}};
      }
    }
    cases.push_back(std::move(c));
  }
  return cases;
}

/// For a reader: nobody makes questions here, so that one that stands twice is refused.
[[nodiscard]] inline bool none_is_made(const golden::DatasetHeader& /*header*/, std::uint64_t /*index*/,
                                       std::string_view /*id*/) {
  return false;
}

/// Writes them as columns into a file, and says what lines they are.
[[nodiscard]] inline std::vector<std::string> write_columns(const std::filesystem::path& path, formats::ArraysForm form,
                                                            Pair pair, bool invalid, std::uint64_t count) {
  golden::DatasetHeader header;
  header.pair = pair;
  header.family = invalid ? golden::kInvalidFamily : "made";
  header.count = count;
  std::vector<std::string> lines;
  const auto writer = golden::create_columns(path, form, header);
  for (const golden::Case& c : cases_in_form(pair, invalid, count)) {
    lines.push_back(golden::to_line(c));
    writer->write(c, lines.back());
  }
  writer->commit();
  return lines;
}

/// The lines of a file's cases. Behind the last their digest has been compared.
[[nodiscard]] inline std::vector<std::string> lines_of(const std::filesystem::path& path) {
  golden::DatasetReader reader(path, none_is_made);
  std::vector<std::string> lines;
  while (reader.next()) lines.push_back(reader.text());
  return lines;
}

}  // namespace contact::fuzz
