// The component in many threads at once. This program is built with ThreadSanitizer: a race fails it.
#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "component/models_for_tests.hpp"
#include "contact/detect.hpp"
#include "contact/discrete_intersection.hpp"
#include "contact/model_factory.hpp"

namespace contact {
namespace {

using component::cubes;
using component::rigid_spheres;
using component::spheres;
using component::text;

constexpr int kThreads = 8;

/// Calls work(0 .. kThreads - 1), all at once.
template <class Work>
void in_threads(Work work) {
  std::atomic<int> waiting = kThreads;
  std::vector<std::thread> threads;
  threads.reserve(kThreads);
  for (int i = 0; i < kThreads; ++i)
    threads.emplace_back([&, i] {
      --waiting;
      while (waiting > 0) std::this_thread::yield();
      work(i);
    });
  for (std::thread& thread : threads) thread.join();
}

class Droplets : public ModelOf<Droplets, SphereCollisionModel> {
 public:
  static constexpr std::string_view kName = "Droplets";
  using ModelOf::ModelOf;
};

TEST(Threads, look_up_supported_swapped_derived_and_missing_pairs_at_once) {
  const auto s = spheres("s", {{{0, 0, 0}, 1}});
  const auto r = rigid_spheres("r", {{{0, 0, 0}, 1}});
  const auto c = cubes("c", {{{0, 0, 0}, {1, 1, 1}}});
  const Droplets d("d", Eigen::MatrixX3d::Zero(1, 3), Eigen::VectorXd::Ones(1));
  for (int round = 0; round < 20; ++round) {
    DiscreteIntersection component;
    std::mutex mutex;  // a sink is called by whichever thread misses a pair
    std::multiset<std::string> messages;
    component.intersectors.setSink([&](const std::string& message) {
      const std::lock_guard lock(mutex);
      messages.insert(message.substr(0, message.find(';')));
    });
    std::atomic<int> wrong = 0;
    in_threads([&](int) {
      for (int i = 0; i < 20; ++i) {
        bool swap = true;
        wrong += !component.findIntersector(s, r, swap) || swap;
        wrong += !component.findIntersector(r, s, swap) || !swap;
        wrong += !component.findIntersector(r, d, swap) || !swap;
        wrong += component.findIntersector(c, s, swap) || swap;
        wrong += component.findIntersector(c, r, swap) || swap;
        wrong += component.findIntersector(d, c, swap) || swap;
        wrong += component.isSupported({c, 0}, {s, 0});
      }
    });
    EXPECT_EQ(wrong, 0);
    EXPECT_EQ(messages,
              (std::multiset<std::string>{"contact: no intersector for CubeCollisionModel-RigidSphereModel",
                                          "contact: no intersector for CubeCollisionModel-SphereCollisionModel",
                                          "contact: no intersector for Droplets-CubeCollisionModel"}));
  }
}

TEST(Threads, detect_at_once_with_one_component) {
  std::vector<Ball> balls;
  balls.reserve(60);
  for (int i = 0; i < 60; ++i) balls.push_back({{0.37 * i, 0.11 * (i % 7), 0.05 * (i % 3)}, 0.3});
  const auto s = spheres("s", balls);
  const auto r = rigid_spheres("r", balls);
  const ProximityIntersection component({.alarm = 0.125, .contact = 0.0625});
  const auto forward = text(*detect(component, s, r));
  const auto backward = text(*detect(component, r, s));
  const auto itself = text(*detect(component, s));
  ASSERT_GT(forward.size(), 100U);
  std::atomic<int> wrong = 0;
  in_threads([&](int) {
    wrong += text(*detect(component, s, r)) != forward;
    wrong += text(*detect(component, r, s)) != backward;
    wrong += text(*detect(component, s)) != itself;
  });
  EXPECT_EQ(wrong, 0);
}

TEST(Threads, share_one_detection) {
  std::vector<Ball> balls;
  balls.reserve(20000);
  for (int i = 0; i < 20000; ++i) balls.push_back({{0.37 * (i % 200), 0.41 * (i / 200), 0.05 * (i % 3)}, 0.3});
  const auto s = spheres("s", balls);
  const auto r = rigid_spheres("r", balls);
  const ProximityIntersection component({.alarm = 0.125, .contact = 0.0625});
  std::size_t contacts = 0;
  detect_streamed(
      component, r, s,
      [&](std::span<const OutputVector> some) {
        for (const OutputVector& run : some) contacts += run.size();
      },
      [](std::size_t count, const std::function<void(std::size_t)>& work) {
        std::atomic<std::size_t> next = 0;
        in_threads([&](int) {
          for (std::size_t i = next++; i < count; i = next++) work(i);
        });
      });
  EXPECT_EQ(contacts, detect(component, r, s)->size());
  EXPECT_GT(contacts, balls.size());
}

/// For two deformable spheres; counts those alive.
class Idle : public BaseIntersector {
 public:
  static constexpr std::string_view kName = "Idle";
  explicit Idle(DiscreteIntersection& object) {
    object.intersectors.add<SphereCollisionModel, SphereCollisionModel>(*this);
  }
  bool testIntersection(const Sphere&, const Sphere&, const Intersection&) const { return false; }
  int computeIntersection(const Sphere&, const Sphere&, OutputVector&, const Intersection&) const { return 0; }
};

TEST(Threads, register_creators_while_others_make_components) {
  IntersectorFactory factory;
  std::atomic<int> registered = 0;
  std::atomic<int> wrong = 0;
  in_threads([&](int thread) {
    for (int i = 0; i < 30; ++i) {
      if (thread % 2 == 0) {
        // Every name is tried by two threads, and one of them has it.
        registered += factory.registerCreator(std::to_string(thread / 4) + "." + std::to_string(i), creator_of<Idle>());
      } else {
        const std::size_t before = factory.names().size();
        const DiscreteIntersection component(PointConvention::nearest_surface, factory);
        const std::size_t after = factory.names().size();
        wrong += component.intersectors.names().size() != 4 || after < before;
      }
    }
  });
  EXPECT_EQ(registered, 60);
  EXPECT_EQ(factory.names().size(), 60U);
  EXPECT_EQ(wrong, 0);
}

TEST(Threads, register_model_types_while_others_make_models) {
  ModelFactory factory;
  std::atomic<int> registered = 0;
  std::atomic<int> wrong = 0;
  in_threads([&](int thread) {
    for (int i = 0; i < 30; ++i) {
      if (thread % 2 == 0) {
        registered += factory.registerModel({std::to_string(i), {}, [](std::string name, const ModelColumns&) {
                                               return std::make_unique<CubeCollisionModel>(
                                                   std::move(name), Eigen::MatrixX3d(0, 3), Eigen::MatrixX3d(0, 3));
                                             }});
      } else {
        const auto model = factory.make("CubeCollisionModel", "c",
                                        {{"min", Eigen::MatrixXd::Zero(2, 3)}, {"max", Eigen::MatrixXd::Ones(2, 3)}});
        wrong += model->getSize() != 2;
      }
    }
  });
  EXPECT_EQ(registered, 30);
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace contact
