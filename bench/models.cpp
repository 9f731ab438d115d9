// How long it takes to find every contact of a set of balls with itself: ours beside the peers' broad and narrow
// phases.
#include <benchmark/benchmark.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <map>
#include <random>
#include <tuple>

#include "contact/detect.hpp"
#include "contact/discrete_intersection.hpp"
#include "peers/models.hpp"

namespace contact::bench {
namespace {

/// Radii 0.4 to 0.8.
///   uniform     centres uniform in a cube of volume n
///   clustered   heaps of a hundred, each as dense as that in its middle, far apart
///   one huge    uniform, but the first ball reaches a quarter of the way through
std::vector<Ball> scene(const std::string& name, std::size_t n) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> part(0, 1);
  std::normal_distribution<double> normal;
  const double edge = std::cbrt(static_cast<double>(n));
  std::vector<Ball> balls(n);
  Vector3 heap = Vector3::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    Ball& ball = balls[i];
    ball.radius = 0.4 + 0.4 * part(random);
    for (int axis = 0; axis < 3; ++axis) ball.center[axis] = edge * part(random);
    if (name != "clustered") continue;
    if (i % 100 == 0) heap = 8 * ball.center;
    for (int axis = 0; axis < 3; ++axis) ball.center[axis] = heap[axis] + 2 * normal(random);
  }
  if (name == "one huge") balls[0] = {Vector3::Constant(edge / 2), edge / 4};
  return balls;
}

struct Asked {
  std::vector<Ball> balls;
  SphereCollisionModel model;
};
const Asked& asked(const std::string& name, std::size_t n) {
  static std::map<std::pair<std::string, std::size_t>, Asked> made;
  const auto key = std::pair(name, n);
  if (const auto found = made.find(key); found != made.end()) return found->second;
  std::vector<Ball> balls = scene(name, n);
  Eigen::MatrixX3d centers(n, 3);
  Eigen::VectorXd radii(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    centers.row(row) = balls[i].center.transpose();
    radii[row] = balls[i].radius;
  }
  return made.emplace(key, Asked{std::move(balls), {name, std::move(centers), std::move(radii)}}).first->second;
}

void count(benchmark::State& state, std::size_t n, std::size_t contacts) {
  using benchmark::Counter;
  state.counters["contacts"] = static_cast<double>(contacts);
  state.counters["time/element"] =
      Counter(static_cast<double>(n), Counter::kIsIterationInvariantRate | Counter::kInvert, Counter::OneK::kIs1000);
}

void ours(benchmark::State& state, const std::string& name, std::size_t n, bool threads) {
  const SphereCollisionModel& model = asked(name, n).model;
  ParallelFor parallel_for;
  if (threads)
    parallel_for = [](std::size_t size, const std::function<void(std::size_t)>& work) {
      tbb::parallel_for(std::size_t{0}, size, work);
    };
  std::size_t contacts = 0;
  for ([[maybe_unused]] auto _ : state) {
    contacts = 0;
    const auto take = [&](std::span<const OutputVector> some) {
      for (const OutputVector& run : some) contacts += run.size();
    };
    detect_streamed(DiscreteIntersection(), model, take, parallel_for);
  }
  count(state, n, contacts);
}

void theirs(benchmark::State& state, const WorldPeer& peer, const std::string& name, std::size_t n, bool again) {
  static std::map<std::tuple<std::string, std::string, std::size_t>, std::unique_ptr<World>> made;
  auto& world = made[{peer.name, name, n}];
  if (!world) world = peer.make(asked(name, n).balls);
  if (again && !world->is_built()) world->from_nothing();
  std::size_t contacts = 0;
  for ([[maybe_unused]] auto _ : state) {
    if (!again) {
      state.PauseTiming();
      world->forget();
      state.ResumeTiming();
    }
    contacts = again ? world->again() : world->from_nothing();
  }
  count(state, n, contacts);
}

[[maybe_unused]] const bool registered = [] {
  for (const char* name : {"uniform", "clustered", "one huge"})
    for (const std::size_t n : {std::size_t{10000}, std::size_t{100000}}) {
      const auto add = [&](const std::string& subject, const auto& run) {
        auto* made =
            benchmark::RegisterBenchmark(("Models/" + subject + "/" + name + "/" + std::to_string(n)).c_str(), run);
        made->Unit(benchmark::kMillisecond)->Iterations(n > 10000 ? 1 : 2);
        return made;
      };
      const std::string scene = name;
      add("ours", [=](benchmark::State& state) { ours(state, scene, n, false); });
      add("ours, all threads", [=](benchmark::State& state) { ours(state, scene, n, true); })->UseRealTime();
      for (const WorldPeer& peer : {fcl_world(), bullet_world()})
        for (const bool again : {false, true})
          add(peer.name + (again ? ", again" : ""),
              [=](benchmark::State& state) { theirs(state, peer, scene, n, again); });
    }
  return true;
}();

}  // namespace
}  // namespace contact::bench
