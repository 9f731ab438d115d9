// Many pairs at once: the batch kernels beside plain double arithmetic with the same vectors, on data in the second
// level cache, in the third, and in memory; half of the pairs hits, in no order. Ratios hold within one run:
//   build/bench/bench/bench --benchmark_filter=Batch --benchmark_repetitions=9
//   --benchmark_enable_random_interleaving=true
#include "contact/batch.hpp"

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

#include "contact/sphere_sphere.hpp"
#include "kernel/batch.hpp"
#include "places.hpp"
#include "plain_batch.hpp"
#include "uniform.hpp"

#ifdef CONTACT_BENCH_FAMILIES
#include "golden/families.hpp"
#endif

namespace contact::bench {
namespace {

constexpr Distances kDistances{.alarm = 0.25, .contact = 0.125};

/// Columns in one piece of memory, each at the start of a cache line and no two at the same place in a page: loads that
/// look like recent stores to the processor would measure the allocator.
template <std::size_t kColumns>
class Columns {
 public:
  explicit Columns(std::size_t size) : memory_(kColumns * (size + kStagger) + kLine) {
    const auto address = reinterpret_cast<std::uintptr_t>(memory_.data());
    const std::size_t skip = (kLine - address / sizeof(double) % kLine) % kLine;
    for (std::size_t k = 0; k < kColumns; ++k)
      columns_[k] = std::span(memory_).subspan(skip + k * (size + kStagger), size);
  }
  [[nodiscard]] std::span<double> operator[](std::size_t k) const { return columns_[k]; }

 private:
  static constexpr std::size_t kLine = 8;      // doubles
  static constexpr std::size_t kStagger = 24;  // three lines: 18 columns spread over a page
  std::vector<double> memory_;
  std::array<std::span<double>, kColumns> columns_;
};

/// Questions and room for answers.
struct Spheres {
  Columns<18> columns;
  std::array<std::span<double>, 8> in;
  std::array<std::span<double>, 10> out;
  std::vector<batch::PairState> state;
  std::vector<std::uint8_t> hit;
  std::vector<std::uint32_t> index;
  Distances distances = kDistances;

  explicit Spheres(std::size_t size) : columns(size), state(size), hit(size), index(size) {
    for (std::size_t k = 0; k < 8; ++k) in[k] = columns[k];
    for (std::size_t k = 0; k < 10; ++k) out[k] = columns[8 + k];
  }
  void set(std::size_t i, const Ball& a, const Ball& b) {
    for (std::size_t k = 0; k < 3; ++k) {
      in[k][i] = a.center[static_cast<Eigen::Index>(k)];
      in[4 + k][i] = b.center[static_cast<Eigen::Index>(k)];
    }
    in[3][i] = a.radius;
    in[7][i] = b.radius;
  }
  [[nodiscard]] batch::BallColumns a() const { return {in[0], in[1], in[2], in[3]}; }
  [[nodiscard]] batch::BallColumns b() const { return {in[4], in[5], in[6], in[7]}; }
  [[nodiscard]] batch::ContactColumns contacts() {
    return {{out[0], out[1], out[2]}, {out[3], out[4], out[5]}, {out[6], out[7], out[8]}, out[9], state};
  }
  [[nodiscard]] kernel::SpherePairs pairs() const {
    return {{in[0].data(), in[1].data(), in[2].data(), in[3].data()},
            {in[4].data(), in[5].data(), in[6].data(), in[7].data()},
            in[0].size()};
  }
  [[nodiscard]] kernel::ContactRows rows() {
    kernel::ContactRows rows{};
    for (std::size_t k = 0; k < 10; ++k) rows.number[k] = out[k].data();
    rows.state = state.data();
    return rows;
  }
};

Spheres make_spheres(std::size_t size) {
  Uniform uniform(1);
  Spheres spheres(size);
  for (std::size_t i = 0; i < size; ++i) {
    const Ball a = uniform.ball();
    spheres.set(i, a, uniform.ball());
  }
  return spheres;
}

/// The one set of questions of a size that is alive.
Spheres& generic_spheres(std::size_t size) {
  static std::map<std::size_t, Spheres> made;
  const auto found = made.find(size);
  return found != made.end() ? found->second : made.emplace(size, make_spheres(size)).first->second;
}

struct Cubes {
  Columns<12> in;
  std::vector<std::uint8_t> hit;

  explicit Cubes(std::size_t size) : in(size), hit(size) {}
  [[nodiscard]] batch::BoxColumns side(std::size_t k) const {
    return {{in[k], in[k + 1], in[k + 2]}, {in[k + 3], in[k + 4], in[k + 5]}};
  }
  [[nodiscard]] kernel::BoxPairs pairs() const {
    kernel::BoxPairs pairs{{}, {}, hit.size()};
    for (std::size_t k = 0; k < 6; ++k) {
      pairs.a[k] = in[k].data();
      pairs.b[k] = in[6 + k].data();
    }
    return pairs;
  }
};

Cubes& generic_cubes(std::size_t size) {
  static std::map<std::size_t, Cubes> made;
  if (const auto found = made.find(size); found != made.end()) return found->second;
  Uniform uniform(2);
  Cubes cubes(size);
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t side = 0; side < 2; ++side) {
      const Box box = uniform.box();
      for (std::size_t k = 0; k < 3; ++k) {
        cubes.in[6 * side + k][i] = box.min[static_cast<Eigen::Index>(k)];
        cubes.in[6 * side + 3 + k][i] = box.max[static_cast<Eigen::Index>(k)];
      }
    }
  return made.emplace(size, std::move(cubes)).first->second;
}

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

/// Pairs of a family that make their hits with no alarm distance.
Spheres family_spheres(const std::string& name) {
  Spheres spheres(kFamilyPairs);
  spheres.distances = {0, 0};
  const golden::Family* family = golden::find_family(Pair::sphere_sphere, name);
  for (std::size_t i = 0; i < kFamilyPairs; ++i) {
    const Query query = golden::generate_query(Pair::sphere_sphere, *family, Scalar::binary64, 1, i);
    spheres.set(i, query.balls()->a, query.balls()->b);
  }
  return spheres;
}

void register_family(const std::string& label, Spheres made) {
  benchmark::RegisterBenchmark(
      ("Family/compute/" + label).c_str(), [spheres = std::move(made)](benchmark::State& state) mutable {
        kernel::use_instruction_set("");
        batch::Count last;
        for ([[maybe_unused]] auto _ : state)
          last = batch::compute_sphere_sphere(spheres.a(), spheres.b(), spheres.distances, spheres.contacts());
        count(state, kFamilyPairs);
        state.counters["hits"] = static_cast<double>(last.hits) / kFamilyPairs;
        state.counters["exact"] = static_cast<double>(last.exact) / kFamilyPairs;
      });
}

void register_families() {
  for (const golden::Family& family : golden::families_of(Pair::sphere_sphere))
    if (!family.outside_domain) register_family(std::string(family.name), family_spheres(std::string(family.name)));
  Spheres uniform = make_spheres(kFamilyPairs);
  for (auto& column : uniform.in)
    for (double& x : column) x *= 0x1p-830;
  uniform.distances = {kDistances.alarm * 0x1p-830, kDistances.contact * 0x1p-830};
  register_family("uniform_scale_1e-250", std::move(uniform));
}
#endif

/// The generic pairs as an array of structures.
const std::vector<PlainPair>& plain_pairs(std::size_t size) {
  static std::map<std::size_t, std::vector<PlainPair>> made;
  std::vector<PlainPair>& pairs = made[size];
  if (pairs.empty())
    for (std::size_t i = 0; i < size; ++i)
      pairs.push_back({generic_spheres(size).pairs().first(i), generic_spheres(size).pairs().second(i)});
  return pairs;
}

template <class Compute>
void call_one_by_one(std::size_t size, Compute compute) {
  for (const PlainPair& pair : plain_pairs(size)) {
    auto contact = compute(pair.a, pair.b, kDistances);
    benchmark::DoNotOptimize(contact);
  }
}

[[maybe_unused]] const bool registered = [] {
  beside_plain(
      "test",
      [](std::size_t n) {
        Spheres& s = generic_spheres(n);
        batch::test_sphere_sphere(s.a(), s.b(), kDistances.alarm, s.hit);
      },
      [](std::size_t n) {
        Spheres& s = generic_spheres(n);
        plain_test_sphere_sphere(s.pairs(), kDistances.alarm, s.hit.data());
      });
  beside_plain(
      "compute",
      [](std::size_t n) {
        Spheres& s = generic_spheres(n);
        batch::compute_sphere_sphere(s.a(), s.b(), kDistances, s.contacts());
      },
      [](std::size_t n) {
        Spheres& s = generic_spheres(n);
        plain_compute_sphere_sphere(s.pairs(), kDistances, s.rows());
      });
  beside_plain(
      "hits",
      [](std::size_t n) {
        Spheres& s = generic_spheres(n);
        batch::compute_sphere_sphere_hits(s.a(), s.b(), kDistances, s.index, s.contacts());
      },
      [](std::size_t n) {
        Spheres& s = generic_spheres(n);
        plain_compute_sphere_sphere_hits(s.pairs(), kDistances, s.index.data(), s.rows());
      });
  beside_plain(
      "cubes",
      [](std::size_t n) {
        Cubes& c = generic_cubes(n);
        batch::test_cube_cube(c.side(0), c.side(6), kDistances.alarm, c.hit);
      },
      [](std::size_t n) {
        Cubes& c = generic_cubes(n);
        plain_test_cube_cube(c.pairs(), kDistances.alarm, c.hit.data());
      });
  at_every_place("Scalar/compute/plain_loop", [](std::size_t n) {
    static std::map<std::size_t, std::vector<PlainContact>> made;
    std::vector<PlainContact>& contacts = made[n];
    contacts.resize(n);
    plain_compute_scalar(plain_pairs(n).data(), n, kDistances, contacts.data());
  });
  at_every_place("Scalar/compute/plain", [](std::size_t n) { call_one_by_one(n, &plain_contact_of_pair); });
  at_every_place("Scalar/compute/ours", [](std::size_t n) {
    call_one_by_one(
        n, [](const Ball& a, const Ball& b, Distances distances) { return compute_sphere_sphere(a, b, distances); });
  });
#ifdef CONTACT_BENCH_FAMILIES
  register_families();
#endif
  return true;
}();

}  // namespace
}  // namespace contact::bench
