// The engine `batch`: production through its functions for many pairs, in vectors.
#include "contact/batch.hpp"

#include <algorithm>
#include <array>

#include "engines/engine.hpp"
#include "kernel/batch.hpp"

namespace contact::engines {
namespace {

constexpr std::size_t kTogether = 16;  // pairs in a call: the widest vectors twice

template <std::size_t kColumns>
using Columns = std::array<std::array<double, kTogether>, kColumns>;

/// The numbers of a shape, in order, into columns from `first` on.
template <std::size_t kColumns, class Shape>
void put(Columns<kColumns>& columns, std::size_t first, std::size_t lane, const Shape& shape) {
  for_each_number(shape, [&](double x) { columns[first++][lane] = x; });
}

/// The lane of the k-th question: with its neighbours in the others, or itself where they are of other shapes.
template <class Shapes, std::size_t kColumns>
std::size_t fill(Columns<kColumns>& columns, std::span<const Question> questions, std::size_t k) {
  const std::size_t first = k / kTogether * kTogether;
  for (std::size_t lane = 0; lane < kTogether; ++lane) {
    const Query* neighbour = first + lane < questions.size() ? &questions[first + lane].query : nullptr;
    if (neighbour == nullptr || !std::holds_alternative<Shapes>(neighbour->shapes) || !inside_domain(*neighbour))
      neighbour = &questions[k].query;
    const auto& shapes = std::get<Shapes>(neighbour->shapes);
    put(columns, 0, lane, shapes.a);
    put(columns, kColumns / 2, lane, shapes.b);
  }
  return k - first;
}

Claim boxes_claim(std::span<const Question> questions, std::size_t k) {
  Columns<12> columns{};
  const std::size_t lane = fill<Boxes>(columns, questions, k);
  const auto side = [&](std::size_t at) {
    return batch::BoxColumns{{columns[at], columns[at + 1], columns[at + 2]},
                             {columns[at + 3], columns[at + 4], columns[at + 5]}};
  };
  std::array<std::uint8_t, kTogether> hit{};
  batch::test_cube_cube(side(0), side(6), questions[k].query.distances.alarm, hit);
  Claim claim;
  claim.overlap = hit[lane] != 0;
  return claim;
}

/// The decision of `test`; the contact of `compute` and `compute_hits` in turn.
Claim balls_claim(std::span<const Question> questions, std::size_t k, ContactPoints points) {
  Columns<8> columns{};
  const std::size_t lane = fill<Balls>(columns, questions, k);
  const batch::BallColumns a{columns[0], columns[1], columns[2], columns[3]};
  const batch::BallColumns b{columns[4], columns[5], columns[6], columns[7]};
  const Distances distances = questions[k].query.distances;

  Columns<10> out{};
  std::array<batch::PairState, kTogether> state{};
  const batch::ContactColumns contacts{
      {out[0], out[1], out[2]}, {out[3], out[4], out[5]}, {out[6], out[7], out[8]}, out[9], state};
  std::size_t row = lane;
  if (k % 2 == 0) {
    batch::compute_sphere_sphere(a, b, distances, contacts, points);
  } else {
    std::array<std::uint32_t, kTogether> index{};
    const auto hits =
        index.begin() +
        static_cast<std::ptrdiff_t>(batch::compute_sphere_sphere_hits(a, b, distances, index, contacts, points).hits);
    row = static_cast<std::size_t>(std::find(index.begin(), hits, lane) - index.begin());
    if (row == static_cast<std::size_t>(hits - index.begin())) row = kTogether;
  }

  std::array<std::uint8_t, kTogether> hit{};
  batch::test_sphere_sphere(a, b, distances.alarm, hit);
  Claim claim;
  claim.overlap = hit[lane] != 0;
  claim.speaks_of_contact = true;
  if (row != kTogether && state[row] != batch::PairState::miss) {
    const auto vector = [&](std::size_t at) { return Vector3(out[at][row], out[at + 1][row], out[at + 2][row]); };
    claim.contact = {vector(0), vector(3), vector(6), std::nullopt, out[9][row]};
  }
  return claim;
}

}  // namespace

std::vector<std::string> batch_instruction_sets() { return kernel::instruction_sets(); }

void use_batch_instruction_set(std::string_view name) { kernel::use_instruction_set(name); }

std::vector<Claim> batch_answers(std::span<const Question> questions, PointConvention points) {
  std::vector<Claim> claims;
  claims.reserve(questions.size());
  for (std::size_t k = 0; k < questions.size(); ++k) {
    const Query& query = questions[k].query;
    if (const auto error = outside_domain(query))
      claims.push_back(rejection(*error));
    else
      claims.push_back(query.boxes() != nullptr   ? boxes_claim(questions, k)
                       : query.balls() != nullptr ? balls_claim(questions, k, contact_points(query, points))
                                                  : production_answer(query, points));  // one at a time
  }
  return claims;
}

}  // namespace contact::engines
