// Answers by the batch kernels. A call has one alarm and one contact distance and every generated question its own, so
// each is asked among its neighbours, in a place of the vector that changes from question to question.
#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>

#include "contact/batch.hpp"
#include "dev/portability/ways.hpp"
#include "golden/answer_bytes.hpp"
#include "golden/production.hpp"
#include "kernel/batch.hpp"

namespace contact::golden {
namespace {

constexpr std::size_t kWindow = 11;  // more than the widest vector has, and no multiple of a width

template <std::size_t Columns>
using Numbers = std::array<std::array<double, kWindow>, Columns>;

[[noreturn]] void differ() { throw std::runtime_error("functions of many pairs say different things of one"); }

bool cubes_hit(std::span<const Query, kWindow> window, std::size_t place) {
  std::array<Numbers<6>, 2> sides{};
  for (std::size_t i = 0; i < kWindow; ++i) {
    const Boxes& boxes = *window[i].boxes();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto at = static_cast<Eigen::Index>(axis);
      sides[0][axis][i] = boxes.a.min[at];
      sides[0][3 + axis][i] = boxes.a.max[at];
      sides[1][axis][i] = boxes.b.min[at];
      sides[1][3 + axis][i] = boxes.b.max[at];
    }
  }
  const auto columns = [](const Numbers<6>& n) { return batch::BoxColumns{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}}; };
  std::array<std::uint8_t, kWindow> hit{};
  batch::test_cube_cube(columns(sides[0]), columns(sides[1]), window[place].distances.alarm, hit);
  return hit[place] != 0;
}

Expectation spheres(std::span<const Query, kWindow> window, std::size_t place) {
  std::array<Numbers<4>, 2> sides{};
  for (std::size_t i = 0; i < kWindow; ++i)
    for (std::size_t side = 0; side < 2; ++side) {
      const Ball& ball = side == 0 ? window[i].balls()->a : window[i].balls()->b;
      for (std::size_t axis = 0; axis < 3; ++axis) sides[side][axis][i] = ball.center[static_cast<Eigen::Index>(axis)];
      sides[side][3][i] = ball.radius;
    }
  const auto columns = [](const Numbers<4>& n) { return batch::BallColumns{n[0], n[1], n[2], n[3]}; };
  const batch::BallColumns a = columns(sides[0]);
  const batch::BallColumns b = columns(sides[1]);
  const Distances distances = window[place].distances;

  struct Room {
    Numbers<10> numbers{};
    std::array<batch::PairState, kWindow> state{};
    batch::ContactColumns columns() {
      auto& n = numbers;
      return {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]}, n[9], state};
    }
    [[nodiscard]] Contact contact(std::size_t row) const {
      const auto vector = [&](std::size_t first) {
        return Vector3(numbers[first][row], numbers[first + 1][row], numbers[first + 2][row]);
      };
      return {vector(0), vector(3), vector(6), numbers[9][row], state[row] == batch::PairState::degenerate};
    }
  };
  Room dense;
  batch::compute_sphere_sphere(a, b, distances, dense.columns());
  std::array<std::uint8_t, kWindow> hit{};
  batch::test_sphere_sphere(a, b, distances.alarm, hit);
  Room hits;
  std::array<std::uint32_t, kWindow> index{};
  const std::size_t count = batch::compute_sphere_sphere_hits(a, b, distances, index, hits.columns()).hits;

  const bool is_hit = dense.state[place] != batch::PairState::miss;
  const std::span<const std::uint32_t> indices(index.data(), count);
  const auto row = std::find(indices.begin(), indices.end(), place);
  if (is_hit != (hit[place] != 0) || is_hit != (row != indices.end())) differ();
  if (!is_hit) return {false, std::nullopt};
  const Expectation found{true, dense.contact(place)};
  const Expectation compacted{true, hits.contact(static_cast<std::size_t>(row - indices.begin()))};
  if (digest_bytes(found) != digest_bytes(compacted)) differ();
  return found;
}

void answer(std::span<const Query> run, std::string& bytes) {
  std::vector<const Query*> inside;
  for (const Query& query : run)
    if (!outside_domain(query)) inside.push_back(&query);
  std::size_t next = 0;
  for (const Query& query : run) {
    if (const auto error = outside_domain(query)) {
      bytes += digest_bytes(*error);
      continue;
    }
    const std::size_t place = next % kWindow;
    std::vector<Query> window;
    for (std::size_t i = 0; i < kWindow; ++i)
      window.push_back(*inside[(next + inside.size() * kWindow + i - place) % inside.size()]);
    ++next;
    const std::span<const Query, kWindow> whole(window);
    if (query.boxes() != nullptr)
      bytes += digest_bytes(Expectation{cubes_hit(whole, place), std::nullopt});
    else if (query.balls() != nullptr)
      bytes += digest_bytes(spheres(whole, place));
    else  // a pair without functions for many: one at a time
      bytes += production_bytes(query);
  }
}

}  // namespace

std::vector<Way> batch_ways() {
  std::vector<Way> ways;
  for (const std::string& set : kernel::instruction_sets())
    ways.push_back({"batch_" + set, [set](std::span<const Query> run, std::string& bytes) {
                      kernel::use_instruction_set(set);
                      answer(run, bytes);
                    }});
  return ways;
}

}  // namespace contact::golden
