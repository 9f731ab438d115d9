// Rays that are cast: what these pairs share of the exact truth.
#pragma once

#include <concepts>
#include <variant>

#include "oracle/truth/exact_truth.hpp"

namespace contact::oracle {

/// Calls work(shapes) where a ray is cast at a shape.
template <class Work>
void if_cast(const Shapes& of_any_kind, const Work& work) {
  std::visit(
      [&]<class A, class B>(const Two<A, B>& shapes) {
        if constexpr (std::same_as<A, Cast>) work(shapes);
      },
      of_any_kind);
}

/// How far a question is from the other answer, exactly: by how much its shape would have to grow, on every side, for
/// the ray to hit it; or to shrink, for a miss. What has no inside to shrink is moved instead, past an end of the ray
/// or off its line.
template <class Target>
[[nodiscard]] Exact distance_to_change(const CastAt<Target>& shapes, bool is_hit);
template <class Target>
[[nodiscard]] CastTruth truth_of_cast(const CastAt<Target>& shapes);
/// Whether the ray begins in the shape.
template <class Target>
[[nodiscard]] bool starts_inside(const CastAt<Target>& shapes);

}  // namespace contact::oracle
