// Production beside its peers, on the same pairs: how long, and how often wrong on committed questions. Neither alarm
// nor contact distance, which peers do not have; half of the pairs hits, in no order. Peers and the functions of one
// pair read and write arrays of structures, the batch kernels structures of arrays.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <map>
#include <tuple>

#include "golden/dataset.hpp"
#include "golden/families.hpp"
#include "golden/right_case.hpp"
#include "oracle/judge/judge.hpp"
#include "peers/peers.hpp"
#include "peers/scenes.hpp"
#include "places.hpp"
#include "plain_batch.hpp"
#include "questions.hpp"

namespace contact::bench {
namespace {

constexpr Distances kNone{.alarm = 0, .contact = 0};

std::vector<PeerAnswer>& answers(std::size_t size) {
  static std::map<std::size_t, std::vector<PeerAnswer>> made;
  return made.try_emplace(size, size).first->second;
}

/// What a table of the page is about: a kind of pairs, and the names of its decisions and contacts there.
template <class A, class B>
struct Subject {
  const char* test;
  const char* compute;
};
constexpr std::tuple kSubjects{Subject<Ball, Ball>{"test", "compute"}, Subject<Box, Box>{"boxes", nullptr},
                               Subject<Ball, Box>{"sphere_cube_test", "sphere_cube_compute"}};
/// Measured in the second level cache alone, one pair after the other.
constexpr std::tuple kOthers{Subject<Ball, Capsule>{"sphere_capsule_test", "sphere_capsule_compute"},
                             Subject<Capsule, Capsule>{"capsule_capsule_test", "capsule_capsule_compute"},
                             Subject<Ball, Triangle>{"sphere_triangle_test", "sphere_triangle_compute"},
                             Subject<Ray, Ball>{"ray_sphere_test", "ray_sphere_compute"},
                             Subject<Ball, Plane>{"sphere_plane_test", "sphere_plane_compute"},
                             Subject<Capsule, Plane>{"capsule_plane_test", "capsule_plane_compute"},
                             Subject<Ray, Triangle>{"ray_triangle_test", "ray_triangle_compute"},
                             Subject<Triangle, Line>{"triangle_line_test", "triangle_line_compute"}};

std::vector<std::uint8_t>& hits(std::size_t size) {
  static std::map<std::size_t, std::vector<std::uint8_t>> made;
  return made.try_emplace(size, size).first->second;
}

/// What a library has of a kind, on the questions that pairs(size) has.
template <class Kind, class Pairs>
void register_loops(const Loops<Kind>& loops, const std::string& row, const Place& place, Pairs pairs,
                    const char* test_name = "test", const char* compute_name = "compute") {
  if (loops.test)
    at_place(row + test_name, place, [test = loops.test, pairs](std::size_t n) { test(pairs(n), hits(n).data()); });
  if (loops.compute)
    at_place(row + compute_name, place,
             [compute = loops.compute, pairs](std::size_t n) { compute(pairs(n), answers(n).data()); });
}

template <class A, class B>
void register_times(const Subject<A, B>& subject, const Peer& peer, bool everywhere) {
  for (const Place& place : std::span(kPlaces).first(peer.slow || !everywhere ? 1 : kPlaces.size()))
    register_loops(peer.of<Two<A, B>>(), "Peer/" + peer.name + "/", place, one_by_one<A, B>, subject.test,
                   subject.compute);
}

/// The questions of a family, of "generic" such as scenes have, about half of which overlap.
const std::vector<Convexes>& of_family(Pair pair, const std::string& family, std::size_t size) {
  static std::map<std::tuple<Pair, std::string, std::size_t>, std::vector<Convexes>> made;
  std::vector<Convexes>& all = made[{pair, family, size}];
  while (all.size() < size)
    all.push_back(std::get<Convexes>(
        golden::generate_query(pair, *golden::find_family(pair, family), Scalar::binary64, 1, all.size()).shapes));
  return all;
}
std::span<const Convexes> boxes(std::size_t size) { return of_family(Pair::obb_obb, "generic", size); }

/// Hulls of twelve corners beside each other, about half of which overlap; beside spheres, capsules and planes as adapters take them: along an axis.
enum class Beside { hull, sphere, capsule, plane };
const std::vector<Convexes>& hulls(Beside beside, std::size_t size) {
  static std::map<std::pair<Beside, std::size_t>, std::vector<Convexes>> made;
  std::vector<Convexes>& all = made[{beside, size}];
  Uniform uniform(1);
  while (all.size() < size) {
    const Convex hull{uniform.hull()};
    const Vector3 at = uniform.hull().vertices[0];
    if (beside == Beside::hull)
      all.push_back({hull, {uniform.hull()}});
    else if (beside == Beside::sphere)
      all.push_back({{Ball{at, 2}}, hull});
    else if (beside == Beside::capsule)
      all.push_back({{Capsule{at, at + Vector3(0, 5, 0), 2}}, hull});
    else
      all.push_back({hull, {Plane{{0, 0, 1}, at[2] - 5}}});
  }
  return all;
}
void register_times_of_hulls(const Peer& peer) {
  constexpr Place kPlace{kPlaces[0].name, 512};  // of two hulls as long as 4096 of others
  for (const auto& [name, beside] : {std::pair("hull_hull", Beside::hull),
                                     {"sphere_hull", Beside::sphere},
                                     {"capsule_hull", Beside::capsule},
                                     {"hull_plane", Beside::plane}}) {
    if (beside == Beside::plane && !peer.hulls.has_planes) continue;
    register_loops<Convexes>(peer.hulls, "Peer/" + peer.name + "/" + name + "_", kPlace,
                             [beside = beside](std::size_t n) { return std::span(hulls(beside, n)); });
  }
}

/// What shapes in special positions cost production.
void register_times_of_families(const Peer& ours) {
  constexpr Place kPlace{kPlaces[0].name, 512};
  for (const auto& [name, pair] : {std::pair("obb_obb", Pair::obb_obb), {"hull_hull", Pair::hull_hull}})
    for (const char* family : {"generic", "deep", "near_touching", "touching", "parallel", "flat", "nested", "ties"})
      register_loops(ours.of<Convexes>(), std::string("Special/") + name + "/" + family + "/", kPlace,
                     [pair = pair, family](std::size_t n) { return std::span(of_family(pair, family, n)); });
}

template <class A, class B>
void register_times_of_scenes(const Peer& peer, const std::vector<Scene<A, B>>& scenes) {
  const auto& compute = peer.of<Two<A, B>>().compute;
  if (!compute || peer.slow) return;
  for (const Scene<A, B>& scene : scenes) {
    std::vector<Two<A, B>> pairs;
    Uniform uniform(1);
    while (pairs.size() < kPlaces[0].pairs) pairs.push_back(scene.make(uniform));
    at_place("Scene/" + peer.name + "/" + scene.name, kPlaces[0],
             [compute, pairs](std::size_t n) { compute(pairs, answers(n).data()); });
  }
}

template <class A, class B>
void register_batch_times(const Subject<A, B>& subject, bool everywhere) {
  const std::string plain = "Peer/plain double, vectors/";
  const std::string ours = "Peer/ours, batch/";
  for (const Place& place : std::span(kPlaces).first(everywhere ? kPlaces.size() : 1)) {
    at_place(plain + subject.test, place, [](std::size_t n) {
      auto& q = generic<A, B>(n);
      plain_test(q.pairs(), 0, q.hit.data());
    });
    at_place(ours + subject.test, place, [](std::size_t n) {
      auto& q = generic<A, B>(n);
      batch::test(q.a(), q.b(), 0, q.hit);
    });
    if constexpr (batch::Computes<A, B>) {
      at_place(plain + subject.compute, place, [](std::size_t n) {
        auto& q = generic<A, B>(n);
        plain_compute(q.pairs(), kNone, q.rows());
      });
      at_place(ours + subject.compute, place, [](std::size_t n) {
        auto& q = generic<A, B>(n);
        batch::compute(q.a(), q.b(), kNone, q.contacts());
      });
    }
  }
}

/// The batch kernels as a peer: one pair a call.
struct OneInBatch {
  static bool test(const Balls& p) {
    std::uint8_t hit = 0;
    batch::test_sphere_sphere(side(p.a), side(p.b), 0, {&hit, 1});
    return hit != 0;
  }
  static bool compute(const Balls& p, Contact& out) {
    batch::PairState state{};
    const auto at = [](Vector3& v) {
      return std::array{std::span(&v[0], 1), std::span(&v[1], 1), std::span(&v[2], 1)};
    };
    batch::compute_sphere_sphere(side(p.a), side(p.b), {.alarm = 0, .contact = 0},
                                 {at(out.normal), at(out.point1), at(out.point2), {&out.value, 1}, {&state, 1}});
    return state != batch::PairState::miss;
  }

 private:
  static batch::BallColumns side(const Ball& ball) {
    return {{&ball.center[0], 1}, {&ball.center[1], 1}, {&ball.center[2], 1}, {&ball.radius, 1}};
  }
};

/// What a peer says, as a claim under its conventions.
Claim claim_of(const Peer& peer, const Balls& balls) {
  Claim claim;
  try {
    std::uint8_t hit = 0;
    const Loops<Balls>& loops = peer.of<Balls>();
    loops.test({&balls, 1}, &hit);
    claim.overlap = hit != 0;
    if (!loops.compute) return claim;
    PeerAnswer answer{};
    loops.compute({&balls, 1}, &answer);
    claim.speaks_of_contact = true;
    if (!answer.hit) return claim;
    claim.contact = ContactClaim{answer.contact.normal, {}, {}, {}, answer.contact.value};
    const Points points = peer.conventions.points;
    if (points == Points::midpoint) {
      claim.contact->point = answer.contact.point1;
    } else if (points == Points::nearest_surface) {
      claim.contact->point1 = answer.contact.point1;
      claim.contact->point2 = answer.contact.point2;
    }
  } catch (const std::exception& error) {
    claim.status = Claim::Status::error;
    claim.text = error.what();
  }
  return claim;
}

/// Counts, not times: what the judge of `certify` says of a peer's answers to the balls of a committed file.
void count_wrong_answers(benchmark::State& state, const Peer& peer, const std::string& family) {
  golden::DatasetReader reader(std::filesystem::path(CONTACT_GOLDEN_DIR) / "sphere_sphere" / (family + ".jsonl"),
                               golden::is_made);
  int asked = 0;
  int wrong_decisions = 0;
  int fields = 0;
  int wrong_fields = 0;
  for ([[maybe_unused]] auto _ : state)
    while (const auto c = reader.next()) {
      const Query query{Pair::sphere_sphere, *c->query.balls(), {.alarm = 0, .contact = 0}};
      const oracle::Verdict verdict = oracle::judge(query, oracle::truth_of(query), claim_of(peer, *query.balls()),
                                                    {Scalar::binary64, peer.conventions, {}});
      ++asked;
      wrong_decisions +=
          verdict.status != Claim::Status::answered || verdict.missed_hit() || verdict.false_hit() ? 1 : 0;
      for (const auto& field : verdict.fields) {
        if (!field) continue;
        ++fields;
        wrong_fields += field->grade >= oracle::Grade::beyond_bound ? 1 : 0;
      }
    }
  state.counters["asked"] = asked;
  state.counters["wrong decisions"] = wrong_decisions;
  state.counters["fields"] = fields;
  state.counters["wrong fields"] = wrong_fields;
}

[[maybe_unused]] const bool registered = [] {
  std::apply([](const auto&... subject) { (register_batch_times(subject, true), ...); }, kSubjects);
  std::apply([](const auto&... subject) { (register_batch_times(subject, false), ...); }, kOthers);
  std::vector<Peer> all;
  for (auto* peers : {own_peers, fcl_peers, bullet_peers, ode_peers, ccd_peers, cgal_peers, gmp_peers})
    for (Peer& peer : peers()) {
      std::apply([&](const auto&... subject) { (register_times(subject, peer, true), ...); }, kSubjects);
      std::apply([&](const auto&... subject) { (register_times(subject, peer, false), ...); }, kOthers);
      register_loops(peer.of<Convexes>(), "Peer/" + peer.name + "/obb_obb_", kPlaces[0], boxes);
      register_times_of_hulls(peer);
      std::apply([&](const auto&... scenes) { (register_times_of_scenes(peer, scenes), ...); },
                 std::tie(kScenesOfBalls, kScenesOfPlanes, kScenesOfCapsulesAndPlanes, kScenesOfCapsules,
                          kScenesOfTwoCapsules, kScenesOfTriangles, kScenesOfRays));
      all.push_back(std::move(peer));
    }
  register_times_of_families(all[1]);
  all.push_back(make_peer("ours, batch", {}, false, std::make_shared<OneInBatch>()));
  for (const Peer& peer : all)
    for (const char* family :
         {"generic", "near_touching", "touching", "far_from_origin", "extreme_scale", "coincident"})
      benchmark::RegisterBenchmark(
          ("Wrong/" + peer.name + "/" + family).c_str(),
          [peer, family](benchmark::State& state) { count_wrong_answers(state, peer, family); })
          ->Iterations(1)
          ->Repetitions(1);
  return true;
}();

}  // namespace
}  // namespace contact::bench
