// Many pairs at once: the batch kernels beside plain double arithmetic with the same vectors, on data in the second
// level cache, in the third, and in memory; half of the pairs hits, in no order. Ratios hold within one run:
//   build/release/bench/bench --benchmark_filter=Batch --benchmark_repetitions=9
//   --benchmark_enable_random_interleaving=true

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "kernel/batch.hpp"
#include "places.hpp"
#include "plain_batch.hpp"
#include "questions.hpp"

#ifdef CONTACT_BENCH_FAMILIES
#include "golden/families.hpp"
#endif

namespace contact::bench {
namespace {

constexpr Distances kDistances{.alarm = 0.25, .contact = 0.125};

/// Registers a kernel and its plain counterpart with every instruction set.
template <class Ours, class Plain>
void beside_plain(const std::string& name, Ours ours, Plain plain) {
  for (const std::string& set : kernel::instruction_sets()) {
    at_every_place("Batch/" + name + "/ours/" + set, ours, set);
    at_every_place("Batch/" + name + "/plain/" + set, plain, set);
  }
}

#ifdef CONTACT_BENCH_FAMILIES
constexpr std::size_t kFamilyPairs = 1 << 12;

using Spheres = Questions<Ball, Ball>;

/// Pairs of a family that make their hits with no alarm distance.
Spheres family_spheres(const std::string& name) {
  Spheres spheres(kFamilyPairs);
  const golden::Family* family = golden::find_family(Pair::sphere_sphere, name);
  for (std::size_t i = 0; i < kFamilyPairs; ++i) {
    const Query query = golden::generate_query(Pair::sphere_sphere, *family, Scalar::binary64, 1, i);
    spheres.set(i, *query.balls());
  }
  return spheres;
}

void register_family(const std::string& label, Spheres made, Distances distances) {
  benchmark::RegisterBenchmark(
      ("Family/compute/" + label).c_str(), [spheres = std::move(made), distances](benchmark::State& state) mutable {
        kernel::use_instruction_set("");
        batch::Count last;
        for ([[maybe_unused]] auto _ : state)
          last = batch::compute_sphere_sphere(spheres.a(), spheres.b(), distances, spheres.contacts());
        count(state, kFamilyPairs);
        state.counters["hits"] = static_cast<double>(last.hits) / kFamilyPairs;
        state.counters["exact"] = static_cast<double>(last.exact) / kFamilyPairs;
      });
}

void register_families() {
  for (const golden::Family& family : golden::families_of(Pair::sphere_sphere))
    if (!family.outside_domain)
      register_family(std::string(family.name), family_spheres(std::string(family.name)), {0, 0});
  Spheres uniform = make_questions<Ball, Ball>(kFamilyPairs);
  for (std::size_t k = 0; k < Spheres::kIn; ++k)
    for (double& x : uniform.columns[k]) x *= 0x1p-830;
  register_family("uniform_scale_1e-250", std::move(uniform),
                  {kDistances.alarm * 0x1p-830, kDistances.contact * 0x1p-830});
}
#endif

template <class A, class B>
void register_decisions(const std::string& name) {
  beside_plain(
      name,
      [](std::size_t n) {
        auto& q = generic<A, B>(n);
        batch::test(q.a(), q.b(), kDistances.alarm, q.hit);
      },
      [](std::size_t n) {
        auto& q = generic<A, B>(n);
        plain_test(q.pairs(), kDistances.alarm, q.hit.data());
      });
}

/// Contacts, and the hits alone, each beside plain double.
template <class A, class B>
void register_contacts(const std::string& of) {
  beside_plain(
      of + "compute",
      [](std::size_t n) {
        auto& q = generic<A, B>(n);
        batch::compute(q.a(), q.b(), kDistances, q.contacts());
      },
      [](std::size_t n) {
        auto& q = generic<A, B>(n);
        plain_compute(q.pairs(), kDistances, q.rows());
      });
  beside_plain(
      of + "hits",
      [](std::size_t n) {
        auto& q = generic<A, B>(n);
        batch::compute_hits(q.a(), q.b(), kDistances, q.index, q.contacts());
      },
      [](std::size_t n) {
        auto& q = generic<A, B>(n);
        plain_compute_hits(q.pairs(), kDistances, q.index.data(), q.rows());
      });
}

[[maybe_unused]] const bool registered = [] {
  register_decisions<Ball, Ball>("test");
  register_contacts<Ball, Ball>("");
  register_decisions<Ball, Box>("sphere_cube_test");
  register_contacts<Ball, Box>("sphere_cube_");
  register_decisions<Ball, Capsule>("sphere_capsule_test");
  register_contacts<Ball, Capsule>("sphere_capsule_");
  register_decisions<Capsule, Capsule>("capsules_test");
  register_contacts<Capsule, Capsule>("capsules_");
  register_decisions<Box, Box>("cubes");
#ifdef CONTACT_BENCH_FAMILIES
  register_families();
#endif
  return true;
}();

}  // namespace
}  // namespace contact::bench
