// Production beside its peers, on the same pairs: how long, and how often wrong on committed questions. Neither alarm
// nor contact distance, which peers do not have; half of the pairs hits, in no order. Peers and the functions of one
// pair read and write arrays of structures, the batch kernels structures of arrays.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <map>

#include "columns.hpp"
#include "contact/batch.hpp"
#include "golden/dataset.hpp"
#include "oracle/judge/judge.hpp"
#include "peers/peers.hpp"
#include "places.hpp"
#include "plain_batch.hpp"
#include "uniform.hpp"

namespace contact::bench {
namespace {

struct Data {
  std::vector<Balls> balls;
  std::vector<Boxes> boxes;
  std::vector<PeerAnswer> answers;
  std::vector<std::uint8_t> hit;
  Columns columns{18, 0};
  Columns box_columns{12, 0};
  std::vector<batch::PairState> state;

  explicit Data(std::size_t size) : answers(size), hit(size), columns(18, size), box_columns(12, size), state(size) {
    Uniform uniform(3);
    for (std::size_t i = 0; i < size; ++i) {
      const Ball a = uniform.ball();
      balls.push_back({a, uniform.ball()});
      const Box c = uniform.box();
      boxes.push_back({c, uniform.box()});
    }
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t side = 0; side < 2; ++side) {
        const Ball& one = side == 0 ? balls[i].a : balls[i].b;
        const Box& bounds = side == 0 ? boxes[i].a : boxes[i].b;
        for (std::size_t k = 0; k < 3; ++k) {
          const auto axis = static_cast<Eigen::Index>(k);
          columns[4 * side + k][i] = one.center[axis];
          box_columns[6 * side + k][i] = bounds.min[axis];
          box_columns[6 * side + 3 + k][i] = bounds.max[axis];
        }
        columns[4 * side + 3][i] = one.radius;
      }
  }
  [[nodiscard]] batch::BallColumns side(std::size_t k) const {
    return {columns[k], columns[k + 1], columns[k + 2], columns[k + 3]};
  }
  [[nodiscard]] batch::BoxColumns box_side(std::size_t k) const {
    return {{box_columns[k], box_columns[k + 1], box_columns[k + 2]},
            {box_columns[k + 3], box_columns[k + 4], box_columns[k + 5]}};
  }
  [[nodiscard]] kernel::SpherePairs pairs() const {
    kernel::SpherePairs pairs{{}, {}, hit.size()};
    for (std::size_t k = 0; k < 4; ++k) {
      pairs.a[k] = columns[k].data();
      pairs.b[k] = columns[4 + k].data();
    }
    return pairs;
  }
  [[nodiscard]] kernel::BoxPairs box_pairs() const {
    kernel::BoxPairs pairs{{}, {}, hit.size()};
    for (std::size_t k = 0; k < 6; ++k) {
      pairs.a[k] = box_columns[k].data();
      pairs.b[k] = box_columns[6 + k].data();
    }
    return pairs;
  }
  [[nodiscard]] kernel::ContactRows rows() {
    kernel::ContactRows rows{{}, state.data()};
    for (std::size_t k = 0; k < kernel::ContactRows::kNumbers; ++k) rows.number[k] = columns[8 + k].data();
    return rows;
  }
  [[nodiscard]] batch::ContactColumns contacts() {
    return {{columns[8], columns[9], columns[10]},
            {columns[11], columns[12], columns[13]},
            {columns[14], columns[15], columns[16]},
            columns[17],
            state};
  }
};

Data& data(std::size_t size) {
  static std::map<std::size_t, Data> made;
  return made.try_emplace(size, size).first->second;
}

void register_times(const Peer& peer) {
  for (const Place& place : std::span(kPlaces).first(peer.slow ? 1 : kPlaces.size())) {
    const std::string name = "Peer/" + peer.name;
    if (peer.test)
      at_place(name + "/test", place, [=](std::size_t n) { peer.test(data(n).balls, data(n).hit.data()); });
    if (peer.compute)
      at_place(name + "/compute", place, [=](std::size_t n) { peer.compute(data(n).balls, data(n).answers.data()); });
    if (peer.test_boxes)
      at_place(name + "/boxes", place, [=](std::size_t n) { peer.test_boxes(data(n).boxes, data(n).hit.data()); });
  }
}

void register_batch_times() {
  for (const Place& place : kPlaces) {
    at_place("Peer/plain double, vectors/test", place,
             [](std::size_t n) { plain_test_sphere_sphere(data(n).pairs(), 0, data(n).hit.data()); });
    at_place("Peer/plain double, vectors/compute", place, [](std::size_t n) {
      plain_compute_sphere_sphere(data(n).pairs(), {.alarm = 0, .contact = 0}, data(n).rows());
    });
    at_place("Peer/plain double, vectors/boxes", place,
             [](std::size_t n) { plain_test_cube_cube(data(n).box_pairs(), 0, data(n).hit.data()); });
    at_place("Peer/ours, batch/test", place,
             [](std::size_t n) { batch::test_sphere_sphere(data(n).side(0), data(n).side(4), 0, data(n).hit); });
    at_place("Peer/ours, batch/compute", place, [](std::size_t n) {
      batch::compute_sphere_sphere(data(n).side(0), data(n).side(4), {.alarm = 0, .contact = 0}, data(n).contacts());
    });
    at_place("Peer/ours, batch/boxes", place,
             [](std::size_t n) { batch::test_cube_cube(data(n).box_side(0), data(n).box_side(6), 0, data(n).hit); });
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
    peer.test({&balls, 1}, &hit);
    claim.overlap = hit != 0;
    if (!peer.compute) return claim;
    PeerAnswer answer{};
    peer.compute({&balls, 1}, &answer);
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
  golden::DatasetReader reader(std::filesystem::path(CONTACT_GOLDEN_DIR) / "sphere_sphere" / (family + ".jsonl"));
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
  register_batch_times();
  std::vector<Peer> all;
  for (auto* peers : {own_peers, fcl_peers, bullet_peers, ode_peers, ccd_peers, cgal_peers, gmp_peers})
    for (Peer& peer : peers()) {
      register_times(peer);
      all.push_back(std::move(peer));
    }
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
