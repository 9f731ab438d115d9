// How long detection between whole models takes.
#include "contact/detect.hpp"

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "contact/discrete_intersection.hpp"

namespace contact {
namespace {

constexpr Distances kDistances{.alarm = 0.4, .contact = 0};

/// n balls, radii 0.3 to 0.6, with their centres uniform in a cube of volume n: each has about nine contacts with the
/// balls of another such model at kDistances, and half of nine in its own, whatever n is.
SphereCollisionModel cloud(Index n, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> coordinate(0, std::cbrt(static_cast<double>(n)));
  std::uniform_real_distribution<double> radius(0.3, 0.6);
  Eigen::MatrixX3d centers(n, 3);
  Eigen::VectorXd radii(n);
  for (Index i = 0; i < n; ++i) {
    for (int axis = 0; axis < 3; ++axis) centers(i, axis) = coordinate(random);
    radii[i] = radius(random);
  }
  return {"cloud", std::move(centers), std::move(radii)};
}

/// Per element of one model, whatever the number of models.
void count(benchmark::State& state, Index n, std::size_t contacts) {
  using benchmark::Counter;
  const auto elements = static_cast<double>(n);
  state.counters["contacts"] = static_cast<double>(contacts);
  state.counters["contacts/element"] = static_cast<double>(contacts) / elements;
  state.counters["time/element"] =
      Counter(elements, Counter::kIsIterationInvariantRate | Counter::kInvert, Counter::OneK::kIs1000);
}

/// `contacts_between(intersection, a, b)` counts the contacts of two models.
template <class Detect>
void between_two_models(benchmark::State& state, Detect contacts_between) {
  const Index n = state.range(0);
  const SphereCollisionModel a = cloud(n, 1);
  const SphereCollisionModel b = cloud(n, 2);
  const ProximityIntersection intersection(kDistances);
  std::size_t contacts = 0;
  for ([[maybe_unused]] auto _ : state) contacts = contacts_between(intersection, a, b);
  count(state, n, contacts);
}

void detect_between_two_models(benchmark::State& state) {
  between_two_models(state, [](const auto&... asked) { return detect(asked...)->size(); });
}
BENCHMARK(detect_between_two_models)->RangeMultiplier(10)->Range(1000, 100000)->Unit(benchmark::kMillisecond);
BENCHMARK(detect_between_two_models)->Arg(1000000)->Iterations(1)->Unit(benchmark::kMillisecond);

void detect_streamed_between_two_models(benchmark::State& state) {
  between_two_models(state, [](const auto&... asked) {
    std::size_t contacts = 0;
    detect_streamed(asked..., [&](std::span<const OutputVector> some) {
      for (const OutputVector& run : some) contacts += run.size();
    });
    return contacts;
  });
}
BENCHMARK(detect_streamed_between_two_models)->RangeMultiplier(10)->Range(1000, 100000)->Unit(benchmark::kMillisecond);
BENCHMARK(detect_streamed_between_two_models)->Arg(1000000)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace contact
