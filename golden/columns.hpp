// A dataset as columns, HDF5 or .npz: docs/formats.md#columns.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "formats/arrays.hpp"
#include "golden/dataset.hpp"
#include "golden/dataset_writer.hpp"

namespace contact::golden {

/// Both hold a block of rows in memory at a time, so their memory does not grow with the file.
[[nodiscard]] std::unique_ptr<CaseSource> open_columns(const std::filesystem::path& path, formats::ArraysForm form);
[[nodiscard]] std::unique_ptr<DatasetWriter> create_columns(const std::filesystem::path& path, formats::ArraysForm form,
                                                            const DatasetHeader& header);

/// A question of an exam, and its place there.
struct PlacedQuestion {
  std::string id;
  std::uint32_t place;
  Query query;
};
/// Questions without answers as columns: a group for each pair, whose rows are in the order of their places.
void write_questions(const formats::PendingFile& pending, formats::ArraysForm form, const nlohmann::json& header,
                     const std::vector<PlacedQuestion>& questions);
struct QuestionColumns {
  nlohmann::json header;
  std::vector<PlacedQuestion> questions;  ///< in the order of their places
};
/// Throws formats::InputError where the file holds anything else, or an id is not that of its question.
[[nodiscard]] QuestionColumns read_questions(const std::filesystem::path& path, formats::ArraysForm form);

/// The longest text of an exact number in a file of that scalar: of one with the unit of an input (reach, gap) for
/// power 1, of one with the unit of its square (distance2) for power 2.
///   Every input is a multiple of u = 2^(min_exponent - precision + 1) below 2^(max_exponent + 1), a difference of two
///   below 2^(max_exponent + 2). D is the sum of three squares of differences, reach a sum of three inputs; both, and a
///   gap, are so below 4 (2^(max_exponent + 2))^power and multiples of u^power. Four bits make a digit. The rest is
///   the sign, 0x, p, and an exponent of up to five characters.
[[nodiscard]] constexpr std::size_t longest_exact(int power, Scalar scalar) {
  const Format f = format_of(scalar);
  const int bits = power * (f.max_exponent + 2 - (f.min_exponent - f.precision + 1)) + 2;
  return static_cast<std::size_t>((bits + 3) / 4 + 9);
}
/// That of D. As a quotient it is at most (w.n)^2 / n.n with n = u x v, each of w, u and v a difference: sums of degree
/// 6 and 4, with three and two bits more than above; with a plane it is (n.p - o)^2 / n.n, of less, and a coordinate
/// of a crossing is (n.d a + n.w d) / n.d, of degrees 4 and 3. A corner of a rotated box is of degree 3 over one of 2, so
/// that over one denominator w, u and v are of degree 5 over 4.
[[nodiscard]] constexpr std::size_t longest_distance2(Pair pair, Scalar scalar) {
  if (!has_quotients(pair)) return longest_exact(2, scalar);
  if (is_convex(pair) && !has_plane(pair)) return longest_exact(30, scalar) + 1 + longest_exact(28, scalar) + 1;
  return longest_exact(6, scalar) + 1 + longest_exact(4, scalar) + 1;
}
/// That of t's two numbers where a ray is cast: B / A and (B^2 - A C) / A^2 with A = |u x d|^2, of degree 4, and below
/// 2^4 times what the numbers of an input allow; so both of the second are of degree 9 at most.
[[nodiscard]] constexpr std::size_t longest_cast(Scalar scalar) { return 2 * (longest_exact(9, scalar) + 1); }

}  // namespace contact::golden
