// Vertices, edges and faces by the places of their corners, and those of the shapes that always have the same.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace contact::oracle {

/// A vertex, an edge or a face of a core, by the places of its corners among the core's vertices: one of them, those next to it, and of a
/// parallelogram the one across.
struct Feature {
  std::size_t size;
  std::array<std::size_t, 4> places;

  [[nodiscard]] std::span<const std::size_t> corners() const { return std::span(places).first(size); }
  [[nodiscard]] std::size_t dimension() const { return std::min<std::size_t>(size - 1, 2); }
  [[nodiscard]] bool is_parallelogram() const { return size == 4; }
  [[nodiscard]] bool has(std::size_t vertex) const {
    return std::find(corners().begin(), corners().end(), vertex) != corners().end();
  }
};

namespace features {

constexpr Feature vertex(std::size_t v) { return {1, {v}}; }
constexpr Feature edge(std::size_t v, std::size_t w) { return {2, {v, w}}; }

inline constexpr std::array kPoint{vertex(0)};
inline constexpr std::array kSegment{vertex(0), vertex(1), edge(0, 1)};
inline constexpr std::array kTriangle{
    vertex(0), vertex(1), vertex(2), edge(0, 1), edge(1, 2), edge(2, 0), Feature{3, {0, 1, 2}}};
/// Of so many vertices, none of which lies between the others: one, two or three.
constexpr std::span<const Feature> of_simplex(std::size_t vertices) {
  if (vertices == 1) return kPoint;
  if (vertices == 2) return kSegment;
  return kTriangle;
}
/// Bit i of a corner's place says whether it is at the upper end of axis i. Of the faces the lower one comes before the upper one.
inline constexpr std::array kBox = [] {
  std::array<Feature, 26> all{};
  std::size_t size = 0;
  for (std::size_t corner = 0; corner < 8; ++corner) all[size++] = vertex(corner);
  for (std::size_t axis = 1; axis < 8; axis *= 2)
    for (std::size_t corner = 0; corner < 8; ++corner)
      if ((corner & axis) == 0) all[size++] = edge(corner, corner | axis);
  for (std::size_t axis = 1; axis < 8; axis *= 2) {
    const std::size_t u = axis == 1 ? 2 : 1;
    const std::size_t v = axis == 4 ? 2 : 4;
    for (const std::size_t corner : {std::size_t{0}, axis})
      all[size++] = {4, {corner, corner | u, corner | v, corner | u | v}};
  }
  return all;
}();

}  // namespace features

}  // namespace contact::oracle
